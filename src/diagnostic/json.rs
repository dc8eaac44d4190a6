//! Diagnostics for programs: one JSON object a line.

use super::place::Lines;
use super::{Diagnostic, FileId, Severity, Texts};
use serde::Serialize;
use std::collections::BTreeMap;

#[derive(Serialize)]
struct Message<'a> {
    code: &'a str,
    severity: Severity,
    message: &'a str,
    labels: Vec<Mark<'a>>,
    help: Option<&'a str>,
}

/// A label. Lines and columns count from 1, columns in characters; `start..end` are bytes.
#[derive(Serialize)]
struct Mark<'a> {
    file: &'a str,
    line: usize,
    column: usize,
    end_line: usize,
    end_column: usize,
    start: u32,
    end: u32,
    text: &'a str,
}

/// The diagnostics, each on a line of its own with a line end.
pub fn lines(diagnostics: &[Diagnostic], texts: &dyn Texts) -> String {
    let mut known: BTreeMap<FileId, Lines> = BTreeMap::new();
    let mut out = String::new();
    for diagnostic in diagnostics {
        let mut labels = Vec::with_capacity(diagnostic.labels.len());
        for label in &diagnostic.labels {
            let span = label.span;
            let text = texts.text(span.file);
            let lines = known.entry(span.file).or_insert_with(|| Lines::of(text));
            let start = lines.place(text, span.start as usize);
            let end = lines.place(text, span.end as usize);
            labels.push(Mark {
                file: texts.path(span.file),
                line: start.line,
                column: start.column,
                end_line: end.line,
                end_column: end.column,
                start: span.start,
                end: span.end,
                text: &label.text,
            });
        }
        let message = Message {
            code: &diagnostic.code,
            severity: diagnostic.severity,
            message: &diagnostic.message,
            labels,
            help: diagnostic.help.as_deref(),
        };
        // Texts and numbers alone always serialise.
        out.push_str(&serde_json::to_string(&message).unwrap_or_default());
        out.push('\n');
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostic::Span;

    struct One;

    impl Texts for One {
        fn path(&self, _: FileId) -> &str {
            "a.garment"
        }
        fn text(&self, _: FileId) -> &str {
            "let काठ = 3 cm\n"
        }
    }

    #[test]
    fn a_line_holds_places_in_characters_and_bytes() {
        let told = Diagnostic::new("E0102", "a \"unit\"").at(Span::new(FileId(0), 4, 13), "x");
        let line = lines(&[told], &One);
        let read: serde_json::Value = serde_json::from_str(&line).unwrap();
        let label = &read["labels"][0];
        assert_eq!(read["severity"], "error");
        assert_eq!(label["column"], 5);
        assert_eq!(label["end_column"], 8);
        assert_eq!(label["end"], 13);
        assert_eq!(read["help"], serde_json::Value::Null);
        assert_eq!(line.matches('\n').count(), 1);
    }
}
