//! What a message says to type instead, ready to be typed.

use super::document::{Document, Known};
use crate::diagnostic::{Diagnostic as Told, Span};
use gen_lsp_types::{CodeAction, CodeActionKind, Range, TextEdit, Uri, WorkspaceEdit};
use std::collections::HashMap;

/// What can be put right within a range.
pub fn actions(document: &Document, known: &Known, within: Range) -> Vec<CodeAction> {
    let text = &document.text;
    let asked = (text.offset(within.start), text.offset(within.end));
    let mut found: Vec<CodeAction> = Vec::new();
    for told in &known.study.told {
        let Some(main) = told.labels.first() else { continue };
        let Some(main) = known.now(main.span).filter(|s| s.file == known.study.root) else {
            continue;
        };
        if (main.start as usize) > asked.1 || (main.end as usize) < asked.0 {
            continue;
        }
        for (span, new, title) in remedies(document, known, told) {
            let edit = TextEdit { range: text.span(span), new_text: new };
            let changes = HashMap::from([(Uri(document.uri.clone()), vec![edit])]);
            let action = CodeAction {
                title,
                kind: Some(CodeActionKind::QuickFix),
                is_preferred: Some(true),
                edit: Some(WorkspaceEdit { changes: Some(changes), ..WorkspaceEdit::default() }),
                ..CodeAction::default()
            };
            if !found.contains(&action) {
                found.push(action);
            }
        }
    }
    found
}

/// The edits that a message suggests: the place, the new text, a title.
fn remedies(document: &Document, known: &Known, told: &Told) -> Vec<(Span, String, String)> {
    let mut found = Vec::new();
    for label in &told.labels {
        let span = known.now(label.span).filter(|span| span.file == known.study.root);
        if let Some((new, span)) = label.suggestion().zip(span) {
            found.push((span, new.to_owned(), format!("write `{new}`")));
        }
    }
    if told.code == "E0501"
        && let Some(ease) = told.help.as_deref().and_then(eased)
        && let Some(end) = told.labels.get(1).and_then(|label| known.now(label.span))
        && end.file == known.study.root
    {
        let (outline, text) = (document.outline(), &*document.text.text);
        let statement = outline.statements.iter().find(|statement| {
            outline
                .tokens
                .get(statement.tokens.clone())
                .unwrap_or(&[])
                .iter()
                .any(|token| token.end == end.end as usize)
        });
        // Behind the last edge, unless the seam takes something in already.
        let taken = statement.is_none_or(|statement| {
            statement.tokens.clone().any(|token| {
                matches!(outline.slice(text, token), "ease" | "gathered" | "stretched")
            })
        });
        if !taken {
            let at = Span { start: end.end, ..end };
            found.push((at, format!(" {ease}"), format!("take it in: `{ease}`")));
        }
    }
    found
}

/// The `ease 3mm` of a message about a seam.
fn eased(help: &str) -> Option<&str> {
    let (_, rest) = help.split_once("`ease ")?;
    let (amount, _) = rest.split_once('`')?;
    let start = help.find("`ease ")? + 1;
    help.get(start..start + "ease ".len() + amount.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ease_is_read_from_the_remedy() {
        assert_eq!(eased("follow; or have it eased in: `ease 1.2cm`"), Some("ease 1.2cm"));
        assert_eq!(eased("nothing"), None);
    }
}
