//! Diagnostics for editors and searches: one line a message.

use super::place::Lines;
use super::render::clean;
use super::{Diagnostic, FileId, Texts};
use std::collections::BTreeMap;
use std::fmt::Write;

/// The diagnostics, each as `file:line:column: code: text` with a line end; lines and columns
/// count from 1, columns in characters. A message without a place begins with its code.
pub fn lines(diagnostics: &[Diagnostic], texts: &dyn Texts) -> String {
    let mut known: BTreeMap<FileId, Lines> = BTreeMap::new();
    let mut out = String::new();
    for Diagnostic { code, message, labels, .. } in diagnostics {
        if let Some(span) = labels.first().map(|label| label.span) {
            let text = texts.text(span.file);
            let lines = known.entry(span.file).or_insert_with(|| Lines::of(text));
            let place = lines.place(text, span.start as usize);
            let path = clean(texts.path(span.file));
            // Writing to a string cannot fail.
            let _ = write!(out, "{path}:{}:{}: ", place.line, place.column);
        }
        let message = clean(message).replace(['\n', '\t'], " ");
        let _ = writeln!(out, "{code}: {message}");
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
            "let a = 1\nlet काठ = 3 cm\n"
        }
    }

    #[test]
    fn a_message_is_one_line() {
        let told = [
            Diagnostic::new("E0102", "a unit\nstands apart")
                .at(Span::new(FileId(0), 26, 30), "here")
                .at(Span::new(FileId(0), 0, 3), "and here")
                .help("write `3cm`"),
            Diagnostic::new("W0101", "nothing in particular"),
        ];
        assert_eq!(
            lines(&told, &One),
            "a.garment:2:11: E0102: a unit stands apart\nW0101: nothing in particular\n"
        );
    }
}
