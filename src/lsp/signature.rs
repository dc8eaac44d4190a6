//! The usage line of the word or function at the cursor.

use super::clause::{self, Wanted};
use super::describe;
use super::document::{Document, Known};
use super::names;
use super::outline::Outline;
use crate::evaluate::facts::Sort as Meaning;
use crate::evaluate::words::Element;
use gen_lsp_types::{
    ActiveParameter, Documentation, ParameterInformation, ParameterInformationLabel, Position,
    SignatureHelp, SignatureInformation,
};

/// What is said of the word or call in which a place lies.
pub fn signature(
    document: &Document,
    known: Option<&Known>,
    place: Position,
) -> Option<SignatureHelp> {
    let (outline, text) = (document.outline(), &*document.text.text);
    let at = document.text.offset(place);
    let statement = outline.statements.get(outline.statement_at(at)?)?;
    let until = outline.tokens.partition_point(|token| token.start < at);
    let (label, parts, active, doc) =
        match call(document, known, &outline, statement.tokens.start, until) {
            Some(found) => found,
            None => {
                let wanted = clause::wanted(&outline, text, statement, until)?;
                let (parts, active) = parts(&wanted);
                (wanted.word.usage(), parts, active, wanted.word.help.to_owned())
            }
        };
    let parameters = parts
        .into_iter()
        .map(|part| ParameterInformation {
            label: ParameterInformationLabel::String(part),
            documentation: None,
        })
        .collect();
    let active = active.and_then(|n| u32::try_from(n).ok()).map(ActiveParameter::Int);
    Some(SignatureHelp {
        signatures: vec![SignatureInformation {
            label,
            documentation: Some(Documentation::String(doc)),
            parameters: Some(parameters),
            active_parameter: active,
        }],
        active_signature: Some(0),
        active_parameter: active,
    })
}

/// The parts of a usage line, and which of them the cursor is in.
fn parts(wanted: &Wanted) -> (Vec<String>, Option<usize>) {
    let pattern = wanted.word.read();
    let joined =
        |elements: &[Element]| elements.iter().map(clause::shown).collect::<Vec<_>>().join(" ");
    let mut parts = Vec::new();
    let mut active = None;
    if !pattern.head.is_empty() {
        if wanted.clause.is_none() {
            active = Some(0);
        }
        parts.push(joined(&pattern.head));
    }
    for clause in &pattern.clauses {
        if wanted.clause.is_some_and(|other| std::ptr::eq(other, clause)) {
            active = Some(parts.len());
        }
        let rest = joined(&clause.elements);
        let gap = if rest.is_empty() { "" } else { " " };
        parts.push(format!("{}{gap}{rest}", clause.word));
    }
    let label = wanted.word.usage();
    // Only what stands in the line as it is can be marked there.
    if parts.iter().any(|part| !label.contains(part.as_str())) {
        return (Vec::new(), None);
    }
    (parts, active)
}

type Found = (String, Vec<String>, Option<usize>, String);

/// The innermost call whose brackets are open before the token `until`.
fn call(
    document: &Document,
    known: Option<&Known>,
    outline: &Outline,
    first: usize,
    until: usize,
) -> Option<Found> {
    let text = &*document.text.text;
    let (mut depth, mut commas) = (0_usize, 0_usize);
    let mut open = None;
    for at in (first..until).rev() {
        match outline.slice(text, at) {
            ")" | "]" => depth += 1,
            "(" | "[" if depth > 0 => depth -= 1,
            "(" => {
                open = Some(at);
                break;
            }
            "," if depth == 0 => commas += 1,
            _ => {}
        }
    }
    let open = open?;
    let callee = open.checked_sub(1)?;
    let touches = outline.tokens.get(callee)?.end == outline.tokens.get(open)?.start;
    let name = outline.slice(text, callee);
    if !touches || name.is_empty() {
        return None;
    }
    let start = outline.tokens.get(callee)?.start;
    let visible = names::visible(outline, text, start);
    let own = visible.iter().find(|given| given.name == name && given.sort == Meaning::Function);
    if let Some(own) = own {
        let statement = outline.statements.get(own.statement)?;
        let span = outline.tokens.get(own.token)?;
        let span = crate::diagnostic::Span::new(Default::default(), span.start, span.end);
        let (line, doc) = describe::line_of(outline, text, span);
        let parts = names::names_before_colons(outline, text, statement)
            .into_iter()
            .map(|token| {
                format!("{}: {}", outline.slice(text, token), outline.slice(text, token + 2))
            })
            .collect();
        return Some((line, parts, Some(commas), doc));
    }
    if let Some((_, usage)) = crate::evaluate::functions().find(|(own, _)| *own == name) {
        let inside = usage.split_once('(').and_then(|(_, rest)| rest.split_once(')'));
        let parts = inside.map_or("", |(inside, _)| inside).split(", ").map(str::to_owned);
        return Some((usage.to_owned(), parts.collect(), Some(commas), String::new()));
    }
    let end = outline.tokens.get(callee)?.end;
    let definition = known?.definitions(start, end, name).into_iter().next()?;
    if definition.sort != Meaning::Function {
        return None;
    }
    let study = &known?.study;
    let text = crate::diagnostic::Texts::text(&study.desk, definition.span.file);
    let (line, doc) = describe::line_of(&super::outline::read(text), text, definition.span);
    Some((line, Vec::new(), None, doc))
}
