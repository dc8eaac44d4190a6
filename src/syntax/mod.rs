//! Text to tree. [`parse`] never fails: what it cannot read it tells and leaves out.
//!
//! The grammar (`grammar/garment.pest`) takes any text; what makes no sense comes out of it as
//! stray text, an unclosed row, a missing or a surplus brace. From these the modules here make
//! the tree and the diagnostics. Reading takes time in proportion to the text.

mod expression;
pub mod format;
mod grammar;
mod literal;
mod lookalike;
mod mistake;
mod nesting;
mod reader;
mod statement;
mod stray;
pub mod tree;

pub(crate) use stray::two_on_a_line;

use crate::diagnostic::{Diagnostic, FileId, Span};

/// The longest text that is read, in bytes.
pub const LONGEST_TEXT: usize = 8 << 20;

/// Reads a text. The tree holds everything that could be read; the diagnostics, in the order of
/// the text, tell the rest. A statement with a part that cannot be read is kept with an
/// [`tree::ExprKind::Unread`] in its place where its shape is clear, and left out otherwise.
pub fn parse(file: FileId, text: &str) -> (tree::File, Vec<Diagnostic>) {
    if text.len() > LONGEST_TEXT {
        let told =
            Diagnostic::new("E0112", format!("this text is longer than {} MB", LONGEST_TEXT >> 20))
                .at(Span::new(file, 0, 0), "")
                .help("split it into several files and bring them together with `use`");
        return (tree::File::default(), vec![told]);
    }
    if let Some(at) = nesting::too_deep(text) {
        return (tree::File::default(), vec![nesting::told(Span::new(file, at, at + 1))]);
    }
    reader::read(file, text)
}
