//! Writes the new text, line by line, and keeps pace with the old one, whose comments and line
//! ends it takes over.

use super::comment::Comment;
use super::line::{Cell, Edge, Kind, Line};
use crate::diagnostic::Span;

/// Blanks of one level.
pub(super) const LEVEL: usize = 4;

/// The new text so far.
pub(super) struct Pen<'t> {
    /// The old text.
    pub(super) text: &'t str,
    comments: Vec<Comment<'t>>,
    /// Comments that are written.
    used: usize,
    lines: Vec<Line<'t>>,
    line: Line<'t>,
    /// Indentation of the statement that is being written.
    indent: usize,
    /// Indentation inside each open bracket.
    brackets: Vec<usize>,
    /// Blocks on one line that are open.
    pub(super) flat: usize,
    /// Whether a blank line was asked for before the next line.
    blank_wanted: bool,
}

/// A state of the pen to go back to.
pub(super) struct Mark<'t> {
    line: Line<'t>,
}

impl<'t> Pen<'t> {
    pub(super) fn new(text: &'t str, comments: Vec<Comment<'t>>) -> Self {
        Pen {
            text,
            comments,
            used: 0,
            lines: Vec::new(),
            line: Line::default(),
            indent: 0,
            brackets: Vec::new(),
            flat: 0,
            blank_wanted: false,
        }
    }

    /// All lines.
    pub(super) fn finish(self) -> Vec<Line<'t>> {
        self.lines
    }

    /// The characters of a place.
    pub(super) fn slice(&self, span: Span) -> &'t str {
        self.between(span.start as usize, span.end as usize)
    }

    /// The characters `from..to`.
    pub(super) fn between(&self, from: usize, to: usize) -> &'t str {
        self.text.get(from..to).unwrap_or("")
    }

    /// Whether a line ends within `from..to`.
    pub(super) fn breaks(&self, from: usize, to: usize) -> bool {
        self.between(from, to).contains(['\n', '\r'])
    }

    /// Whether a blank line lies within `from..to`.
    pub(super) fn is_blank_between(&self, from: usize, to: usize) -> bool {
        let mut ends = 0;
        let mut before = ' ';
        for c in self.between(from, to).chars() {
            ends += usize::from(c == '\n' && before != '\r' || c == '\r');
            before = c;
        }
        ends > 1
    }

    /// Begins a line that is indented by `indent`.
    pub(super) fn begin(&mut self, indent: usize) {
        self.indent = indent;
        self.line.indent = indent;
    }

    /// Indents the line otherwise than its statement.
    pub(super) fn indent_line(&mut self, indent: usize) {
        self.line.indent = indent;
    }

    /// Indentation of the statement that is being written.
    pub(super) fn indent(&self) -> usize {
        self.indent
    }

    /// Adds characters to the line.
    pub(super) fn write(&mut self, text: &str) {
        match self.line.cells.last_mut() {
            Some(cell) => cell.text.push_str(text),
            None => {
                self.line.cells.push(Cell { text: text.to_owned(), ..Cell::default() });
            }
        }
    }

    /// Adds the characters of a place to the line.
    pub(super) fn copy(&mut self, span: Span) {
        let text = self.slice(span);
        self.write(text);
    }

    /// Ends a cell of the line and begins the next behind `gap` blanks.
    pub(super) fn cut(&mut self, kind: Kind<'t>, edge: Edge<'t>, gap: usize) {
        if let Some(cell) = self.line.cells.last_mut() {
            (cell.kind, cell.edge, cell.gap) = (kind, edge, gap);
        }
        self.line.cells.push(Cell::default());
    }

    /// Takes the entries of lists on the line out of their columns: only a line with nothing but
    /// a list is the row of a table.
    pub(super) fn part_entries(&mut self) {
        for cell in &mut self.line.cells {
            if matches!(cell.kind, Kind::Entry(_)) {
                cell.kind = Kind::Plain;
            }
        }
    }

    /// The columns that the line takes so far.
    pub(super) fn width(&self) -> usize {
        self.line.width()
    }

    /// Whether the line ends with a sign so far.
    pub(super) fn ends_with(&self, sign: char) -> bool {
        self.line.cells.last().is_some_and(|cell| cell.text.ends_with(sign))
    }

    /// Whether nothing stands on the line yet.
    pub(super) fn is_fresh(&self) -> bool {
        self.line.cells.is_empty()
    }

    /// Ends the line.
    pub(super) fn end(&mut self) {
        if self.is_fresh() {
            return;
        }
        let next = Line { indent: self.line.indent, ..Line::default() };
        let mut line = std::mem::replace(&mut self.line, next);
        line.blank_before = std::mem::take(&mut self.blank_wanted) && !self.lines.is_empty();
        self.lines.push(line);
    }

    /// Asks for a blank line before the next one.
    pub(super) fn want_blank(&mut self, wanted: bool) {
        self.blank_wanted = wanted;
    }

    /// A state to go back to; only to be used while the line does not end.
    pub(super) fn mark(&self) -> Mark<'t> {
        Mark { line: self.line.clone() }
    }

    /// Goes back to a state.
    pub(super) fn back(&mut self, mark: Mark<'t>) {
        self.line = mark.line;
    }

    /// The next comment that begins before `end`.
    pub(super) fn next_comment(&mut self, end: usize) -> Option<Comment<'t>> {
        let comment = *self.comments.get(self.used)?;
        (comment.start < end).then(|| {
            self.used += 1;
            comment
        })
    }

    /// Whether a comment that is not written yet begins before `end`.
    pub(super) fn has_comment(&self, end: usize) -> bool {
        self.comments.get(self.used).is_some_and(|comment| comment.start < end)
    }

    /// The first `sign` from `at` on that stands in no comment; the end of the text if none.
    pub(super) fn find(&self, sign: char, mut at: usize) -> usize {
        for comment in &self.comments[self.used..] {
            match self.between(at, comment.start).find(sign) {
                Some(found) => return at + found,
                None if comment.start < at => {}
                None => at = comment.end,
            }
        }
        self.between(at, self.text.len()).find(sign).map_or(self.text.len(), |found| at + found)
    }

    /// Writes a comment on a line of its own.
    pub(super) fn remark(&mut self, comment: &Comment<'t>, indent: usize) {
        self.line.indent = indent;
        self.line.remark = true;
        self.write(comment.text);
        self.end();
    }

    /// Puts a comment at the end of the line before; false where there is none.
    pub(super) fn append(&mut self, comment: &Comment<'t>) -> bool {
        match self.lines.last_mut() {
            Some(line) if line.comment.is_none() && !line.remark => {
                line.comment = Some(comment.text);
                true
            }
            _ => false,
        }
    }

    /// Opens a bracket; what stands inside and goes on in other lines is indented once more.
    pub(super) fn open(&mut self, bracket: &str) {
        self.write(bracket);
        self.brackets.push(self.line.indent + LEVEL);
    }

    /// Closes a bracket behind what ends at `from`, with `blank` before it on the same line; the
    /// bracket of the old text stands at `to`.
    pub(super) fn close(&mut self, bracket: &str, blank: &str, from: usize, to: usize) {
        let inside = self.brackets.last().copied();
        let broken = self.comments_within(from, to) || self.breaks(from, to);
        self.brackets.pop();
        if broken {
            self.end();
            self.line.indent = inside.unwrap_or(LEVEL) - LEVEL;
        } else {
            self.write(blank);
        }
        self.write(bracket);
    }

    /// Crosses from the end of one part of a statement to the beginning of the next: on to the
    /// next line where the old text does so, with the comments between; by `blank` elsewhere.
    pub(super) fn cross(&mut self, from: usize, to: usize, blank: &str) {
        if self.comments_within(from, to) || self.breaks(from, to) {
            self.end();
            self.line.indent = self.inner();
        } else {
            self.write(blank);
        }
    }

    /// Indentation of the lines in which a statement goes on.
    fn inner(&self) -> usize {
        self.brackets.last().copied().unwrap_or(self.indent + LEVEL)
    }

    /// Writes the comments within `from..to` of a statement; whether there were any.
    fn comments_within(&mut self, from: usize, to: usize) -> bool {
        let mut at = from;
        let mut any = false;
        while let Some(comment) = self.next_comment(to) {
            let own = self.breaks(at, comment.start);
            self.end();
            if own || !self.append(&comment) {
                let inner = self.inner();
                self.remark(&comment, inner);
            }
            at = comment.end;
            any = true;
        }
        any
    }
}
