//! The one layout of a text.
//!
//! [`format()`] writes the tree down again with the characters that the text has for names,
//! numbers, strings and charts. What the layout decides: indentation, blanks, which statements
//! share a line, columns of neighbouring lines. What stays the author's: comments, blank lines
//! between groups (one of several), whether a short block stands on one line, which properties
//! share a line, and where a long statement goes on in the next line.
//!
//! - A level is four blanks deep; a statement has its own line, `;` stands only in blocks on one
//!   line. Such a block stays on its line while that is not wider than [`WIDEST`].
//! - Operators stand between blanks, `..` only where an operand is itself a sum.
//! - In neighbouring lines `=` and `in` of `let` and `param`, the values behind `key:`, the `{`
//!   and the properties of like items, the `->` of seams and the columns of tables stand below
//!   each other, and so do comments at the ends of lines.
//!
//! Formatting takes time in proportion to the text, and formatting twice changes nothing more.

mod block;
mod column;
mod comment;
mod line;
mod pen;
mod statement;
mod value;

use super::parse;
use crate::diagnostic::{Diagnostic, FileId};
use pen::Pen;

/// Columns that a line with a block in it may take.
pub const WIDEST: usize = 110;

/// The text in its one layout.
///
/// # Errors
/// What is wrong with a text that has mistakes in its shape; such a text is not formatted.
pub fn format(file: FileId, text: &str) -> Result<String, Vec<Diagnostic>> {
    let (tree, told) = parse(file, text);
    if told.iter().any(Diagnostic::is_error) {
        return Err(told);
    }
    let mut pen = Pen::new(text, comment::of(text, &tree));
    pen.file(&tree.statements);
    let mut lines = pen.finish();
    column::align(&mut lines);
    Ok(line::written(&lines, line_end(text)))
}

/// How the lines of a text end: as its first one does.
fn line_end(text: &str) -> &'static str {
    match text.find(['\n', '\r']) {
        Some(at) if text[at..].starts_with("\r\n") => "\r\n",
        _ => "\n",
    }
}

#[cfg(test)]
mod tests;
