//! The statements of a file or a block: lines, blank lines and comments between them.

use super::line::{Edge, Kind};
use super::pen::{LEVEL, Pen};
use super::statement::ends_open;
use crate::syntax::tree::{Block, Statement, StatementKind};

/// Blanks between properties that share a line.
pub(super) const APART: usize = 3;

/// How far the old text is taken over.
pub(super) struct Progress {
    /// The end of what is written.
    pub(super) at: usize,
    /// Whether no blank line may follow: at the beginning of a block, behind a doc comment.
    pub(super) tight: bool,
}

impl<'t> Pen<'t> {
    /// All statements of a text.
    pub(super) fn file(&mut self, statements: &[Statement]) {
        self.statements(statements, 0, self.text.len(), 0, true);
    }

    /// The statements that stand in `from..to` of the old text, each with the comments before it,
    /// and the comments at the end. Properties share a line as they do in the old text where
    /// `shared` says so.
    fn statements(
        &mut self,
        statements: &[Statement],
        from: usize,
        to: usize,
        indent: usize,
        shared: bool,
    ) {
        let mut progress = Progress { at: from, tight: true };
        let mut before: Option<&Statement> = None;
        // Whether the statement before stands whole on its line.
        let mut whole = false;
        for statement in statements {
            let start = statement.span.start as usize;
            let joined =
                shared && whole && before.is_some_and(|before| self.joined(before, statement));
            if !joined {
                if before.is_some_and(ends_open) && goes_on(statement) {
                    self.write(";");
                }
                self.end();
                self.remarks(&mut progress, start, indent);
                self.want_blank(!progress.tight && self.is_blank_between(progress.at, start));
                self.begin(indent);
                whole = self.statement(statement);
            }
            before = Some(statement);
            progress = Progress { at: statement.span.end as usize, tight: false };
        }
        self.end();
        self.remarks(&mut progress, to, indent);
    }

    /// Writes a property on the line of the one before it, if the old text does so with nothing
    /// between them and the line does not grow too wide.
    fn joined(&mut self, before: &Statement, statement: &Statement) -> bool {
        let (end, start) = (before.span.end as usize, statement.span.start as usize);
        let shares = is_property(before)
            && is_property(statement)
            && self.between(end, start).bytes().all(|byte| matches!(byte, b' ' | b'\t'))
            && self.is_on_one_line(statement);
        if !shares {
            return false;
        }
        let mark = self.mark();
        let kind = self.kind(before);
        self.part_entries();
        self.next_property(kind, statement);
        self.shape(statement, true);
        let fits = self.width() <= super::WIDEST;
        if !fits {
            self.back(mark);
        }
        fits
    }

    /// Ends a cell of kind `before` ahead of a property on the same line.
    fn next_property(&mut self, before: Kind<'t>, statement: &Statement) {
        match self.kind(statement) {
            // A list of settings, or a record.
            _ if self.ends_with(',') => self.write(" "),
            Kind::Property(key) if self.flat < 2 => self.cut(before, Edge::Next(key), APART),
            _ => self.write("   "),
        }
    }

    /// What a whole statement is as a cell.
    fn kind(&self, statement: &Statement) -> Kind<'t> {
        match &statement.kind {
            StatementKind::Property { key, .. } => Kind::Property(self.slice(key.span)),
            StatementKind::Line { word, .. } => Kind::Word(self.slice(word.span)),
            _ => Kind::Plain,
        }
    }

    /// Writes the comments up to `to`: behind the line before where they stand there, on lines of
    /// their own elsewhere.
    pub(super) fn remarks(&mut self, progress: &mut Progress, to: usize, indent: usize) {
        while let Some(comment) = self.next_comment(to) {
            let own = self.breaks(progress.at, comment.start);
            if own || !self.append(&comment) {
                let blank = self.is_blank_between(progress.at, comment.start);
                self.want_blank(!progress.tight && blank);
                self.remark(&comment, indent);
                progress.tight = comment.is_doc();
            }
            progress.at = comment.end;
        }
    }

    /// Whether nothing stands in a block, no comment either.
    pub(super) fn is_empty(&self, block: &Block) -> bool {
        block.statements.is_empty() && !self.has_comment(block.span.end as usize)
    }

    /// A block, on one line or on several.
    pub(super) fn block(&mut self, block: &Block, flat: bool) {
        let (start, end) = (block.span.start as usize, block.span.end as usize);
        if self.is_empty(block) {
            self.write("{ }");
        } else if flat {
            self.write("{ ");
            self.flat += 1;
            self.on_one_line(&block.statements);
            self.flat -= 1;
            self.write(" }");
        } else {
            let indent = self.indent();
            // A block that grew too wide for one line gives each statement its own.
            let shared = self.breaks(start, end);
            self.write("{");
            self.end();
            self.statements(&block.statements, start + 1, end - 1, indent + LEVEL, shared);
            self.begin(indent);
            self.write("}");
        }
    }

    /// Statements between braces on one line.
    fn on_one_line(&mut self, statements: &[Statement]) {
        for (number, statement) in statements.iter().enumerate() {
            if let Some(before) = number.checked_sub(1).and_then(|before| statements.get(before)) {
                if is_property(statement) && needs_no_mark(before) {
                    let kind = self.kind(before);
                    self.next_property(kind, statement);
                } else {
                    self.write("; ");
                }
            }
            self.shape(statement, true);
        }
    }
}

fn is_property(statement: &Statement) -> bool {
    matches!(statement.kind, StatementKind::Property { .. })
}

/// Whether a property may follow on the same line without `;`, by the habit of the language.
fn needs_no_mark(statement: &Statement) -> bool {
    match &statement.kind {
        StatementKind::Property { .. } => true,
        StatementKind::Line { block, .. } => block.is_some(),
        _ => false,
    }
}

/// Whether a statement would be read as the rest of a phrase that ends with a comma above it.
fn goes_on(statement: &Statement) -> bool {
    matches!(statement.kind, StatementKind::Line { .. } | StatementKind::For { .. })
}
