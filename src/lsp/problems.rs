//! Messages as the client shows them.

use super::document::{Document, Folders, text_of};
use super::study::Study;
use super::text::Text;
use crate::diagnostic::{Diagnostic as Told, FileId, Severity};
use gen_lsp_types::{
    Code, Diagnostic, DiagnosticRelatedInformation, DiagnosticSeverity, Location, Message, Range,
    Uri,
};
use std::collections::BTreeMap;

/// Messages of one text that are shown; thousands help nobody and keep the client busy.
const SHOWN: usize = 500;

/// Messages of a study by the addresses of the files they speak of; those of files that cannot
/// be opened are told at the beginning of the document.
pub fn problems(
    study: &Study,
    told: &[Told],
    folders: &Folders,
    document: &Document,
) -> BTreeMap<String, Vec<Diagnostic>> {
    let mut found: BTreeMap<String, Vec<Diagnostic>> = BTreeMap::new();
    let mut texts: BTreeMap<FileId, Text> = BTreeMap::new();
    found.insert(study.job.uri.clone(), Vec::new());
    for told in told.iter().take(SHOWN) {
        for label in &told.labels {
            let file = label.span.file;
            texts.entry(file).or_insert_with(|| text_of(study, file, &document.text));
        }
        let main = told.labels.first().map(|label| label.span.file);
        let uri = main.and_then(|file| folders.address(study, file));
        let shown = shown(told, study, folders, &texts, uri.is_some());
        found.entry(uri.unwrap_or_else(|| study.job.uri.clone())).or_default().push(shown);
    }
    found
}

fn shown(
    told: &Told,
    study: &Study,
    folders: &Folders,
    texts: &BTreeMap<FileId, Text>,
    placed: bool,
) -> Diagnostic {
    let range = |label: &crate::diagnostic::Label| {
        texts.get(&label.span.file).map_or(Range::default(), |text| text.span(label.span))
    };
    let mut message = told.message.clone();
    let main = told.labels.first();
    if let Some(label) = main.filter(|label| !label.text.is_empty()) {
        message.push_str(": ");
        message.push_str(&label.text);
    }
    if let Some(help) = &told.help {
        message.push('\n');
        message.push_str(help);
    }
    let related: Vec<DiagnosticRelatedInformation> = told
        .labels
        .iter()
        .skip(1)
        .filter_map(|label| {
            let uri = folders.address(study, label.span.file)?;
            let location = Location { uri: Uri(uri), range: range(label) };
            let message = if label.text.is_empty() { "here" } else { &label.text };
            Some(DiagnosticRelatedInformation { location, message: message.to_owned() })
        })
        .collect();
    Diagnostic {
        range: main.filter(|_| placed).map(range).unwrap_or_default(),
        severity: Some(match told.severity {
            Severity::Error => DiagnosticSeverity::Error,
            Severity::Warning => DiagnosticSeverity::Warning,
        }),
        code: Some(Code::String(told.code.clone())),
        source: Some("darzi".to_owned()),
        message: Message::String(message),
        related_information: (!related.is_empty()).then_some(related),
        ..Diagnostic::default()
    }
}
