//! Lines of the new text, cut into cells that may stand below each other.

use unicode_width::UnicodeWidthStr;

/// A line of the new text.
#[derive(Clone, Debug, Default)]
pub(super) struct Line<'t> {
    /// Blanks before it.
    pub(super) indent: usize,
    /// Its parts; a comment on a line of its own has one.
    pub(super) cells: Vec<Cell<'t>>,
    /// The comment at its end.
    pub(super) comment: Option<&'t str>,
    /// Blanks before that comment.
    pub(super) comment_gap: usize,
    /// Whether it is a comment on a line of its own.
    pub(super) remark: bool,
    /// Whether a blank line stands before it.
    pub(super) blank_before: bool,
}

/// A part of a line.
#[derive(Clone, Debug, Default)]
pub(super) struct Cell<'t> {
    /// Its characters.
    pub(super) text: String,
    /// What it is.
    pub(super) kind: Kind<'t>,
    /// What follows it.
    pub(super) edge: Edge<'t>,
    /// Blanks between it and the next cell.
    pub(super) gap: usize,
}

/// What a cell is. Only cells of one kind stand in one column.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Kind<'t> {
    /// Nothing that stands in columns.
    #[default]
    Plain,
    /// `let NAME`
    Let,
    /// `param NAME`
    Param,
    /// `= VALUE` of a parameter.
    Default,
    /// `key:`
    Key,
    /// What stands behind the first key of a line, or a whole `key: value` behind it.
    Property(&'t str),
    /// One of so many single values of a list.
    Entry(usize),
    /// An action or an item by its first word.
    Word(&'t str),
}

/// What follows a cell. Cells stand in one column only where the same follows them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Edge<'t> {
    /// The end of the line.
    #[default]
    End,
    /// `=`
    Equals,
    /// `in`
    In,
    /// The value of a key.
    Value,
    /// The next entry of a list.
    Column,
    /// `->`
    Arrow,
    /// A block on the same line.
    Brace,
    /// Another property.
    Next(&'t str),
}

impl Line<'_> {
    /// The columns it takes, the comment at its end left out.
    pub(super) fn width(&self) -> usize {
        let last = self.cells.len().saturating_sub(1);
        self.indent
            + self
                .cells
                .iter()
                .enumerate()
                .map(|(number, cell)| cell.width() + if number < last { cell.gap } else { 0 })
                .sum::<usize>()
    }
}

impl Cell<'_> {
    /// The columns that its text takes.
    pub(super) fn width(&self) -> usize {
        width(&self.text)
    }
}

/// The columns that a text takes on a screen.
pub(super) fn width(text: &str) -> usize {
    if text.is_ascii() { text.len() } else { text.width() }
}

/// The lines as one text.
pub(super) fn written(lines: &[Line], line_end: &str) -> String {
    let length = |line: &Line| {
        let cells = line.cells.iter().map(|cell| cell.text.len() + cell.gap).sum::<usize>();
        line.indent + cells + line.comment.map_or(0, str::len) + line.comment_gap + 4
    };
    let mut out = String::with_capacity(lines.iter().map(length).sum());
    let blanks = |out: &mut String, count| out.extend(std::iter::repeat_n(' ', count));
    for line in lines {
        if line.blank_before {
            out.push_str(line_end);
        }
        blanks(&mut out, line.indent);
        for (number, cell) in line.cells.iter().enumerate() {
            out.push_str(&cell.text);
            if number + 1 < line.cells.len() {
                blanks(&mut out, cell.gap);
            }
        }
        if let Some(comment) = line.comment {
            blanks(&mut out, line.comment_gap);
            out.push_str(comment);
        }
        out.push_str(line_end);
    }
    out
}
