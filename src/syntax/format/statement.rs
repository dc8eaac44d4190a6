//! The shapes of statement.

use super::block::Progress;
use super::line::{Edge, Kind};
use super::pen::{LEVEL, Pen};
use crate::syntax::tree::{
    Block, Expr, Formal, Item, Name, Row, Source, SourcePath, Statement, StatementKind,
};

/// What the parts of a phrase stand below.
#[derive(Clone, Copy)]
enum Columns<'t> {
    /// Nothing.
    Free,
    /// So many single values stand below those of the neighbours.
    Entries(usize),
    /// The arrow behind the first value stands below those of the same word.
    Arrow(&'t str),
}

impl<'t> Pen<'t> {
    /// A statement. Whether it stands whole on its line.
    pub(super) fn statement(&mut self, statement: &Statement) -> bool {
        if self.is_on_one_line(statement) {
            let mark = self.mark();
            self.shape(statement, true);
            if self.width() <= super::WIDEST || !holds_block(statement) {
                return true;
            }
            self.back(mark);
        }
        self.shape(statement, false);
        false
    }

    /// Whether the old text has the statement on one line, but for a block without anything in it.
    pub(super) fn is_on_one_line(&self, statement: &Statement) -> bool {
        let (start, end) = (statement.span.start as usize, statement.span.end as usize);
        let end = match &statement.kind {
            StatementKind::Property { block: Some(block), .. }
            | StatementKind::Line { block: Some(block), .. }
                if self.is_empty(block) =>
            {
                block.span.start as usize
            }
            _ => end,
        };
        !self.breaks(start, end)
    }

    /// A statement, its blocks on one line or on several.
    pub(super) fn shape(&mut self, statement: &Statement, flat: bool) {
        match &statement.kind {
            StatementKind::Use(sources) => self.sources(sources),
            StatementKind::Let { name, value } => {
                self.write("let ");
                self.copy(name.span);
                self.column(Kind::Let, Edge::Equals);
                self.equals(name.span.end as usize, value);
            }
            StatementKind::Param { name, kind, default, range } => {
                self.param(name, kind.as_ref(), default.as_ref(), range.as_ref());
            }
            StatementKind::Function { name, formals, kind, value } => {
                self.function(name, formals, kind.as_ref(), value);
            }
            StatementKind::For { name, over, body } => {
                self.write("for ");
                self.copy(name.span);
                self.write(" in ");
                self.value(over);
                self.write(" ");
                self.block(body, flat);
            }
            StatementKind::If { condition, then, otherwise } => {
                self.write("if ");
                self.value(condition);
                self.write(" ");
                self.block(then, flat);
                if let Some(otherwise) = otherwise {
                    self.write(" else ");
                    self.otherwise(otherwise, flat);
                }
            }
            StatementKind::Property { key, phrase, drawing, block } => {
                let first = self.is_fresh();
                self.copy(key.span);
                self.write(":");
                let broken = !drawing.is_empty() && !flat;
                if !broken && first && (flat || !phrase.is_empty()) {
                    self.column(Kind::Key, Edge::Value);
                } else if !broken {
                    self.write(" ");
                }
                match (drawing.is_empty(), broken) {
                    (true, _) if first => self.phrase(phrase, entries(phrase)),
                    (true, _) => self.phrase(phrase, Columns::Free),
                    (false, true) => self.drawing(key.span.end as usize, drawing),
                    (false, false) => self.rows(drawing),
                }
                if let Some(block) = block {
                    self.write(if phrase.is_empty() { "" } else { " " });
                    self.block(block, flat);
                }
            }
            StatementKind::Line { word, phrase, block } => {
                let kind = self.slice(word.span);
                self.copy(word.span);
                self.write(if let None | Some(Item::Comma(_)) = phrase.first() { "" } else { " " });
                let columns = if block.is_none() { Columns::Arrow(kind) } else { Columns::Free };
                self.phrase(phrase, columns);
                match block {
                    Some(block) if flat && phrase.len() == 1 => {
                        self.column(Kind::Word(kind), Edge::Brace);
                        self.block(block, flat);
                    }
                    Some(block) => {
                        self.write(" ");
                        self.block(block, flat);
                    }
                    None => {}
                }
            }
        }
    }

    /// Ends a cell, unless the statement stands inside a line.
    fn column(&mut self, kind: Kind<'t>, edge: Edge<'t>) {
        if self.flat == 0 {
            self.cut(kind, edge, 1);
        } else {
            self.write(" ");
        }
    }

    /// `= VALUE`; what stands before it ends at `from`.
    fn equals(&mut self, from: usize, value: &Expr) {
        self.write("=");
        self.cross(from, value.span.start as usize, " ");
        self.value(value);
    }

    fn param(
        &mut self,
        name: &Name,
        kind: Option<&Name>,
        default: Option<&Expr>,
        range: Option<&Expr>,
    ) {
        self.write("param ");
        self.copy(name.span);
        let mut end = name.span.end;
        if let Some(kind) = kind {
            self.write(": ");
            self.copy(kind.span);
            end = kind.span.end;
        }
        let mut cell = Kind::Param;
        if let Some(default) = default {
            self.column(cell, Edge::Equals);
            self.equals(end as usize, default);
            cell = Kind::Default;
        }
        if let Some(range) = range {
            self.column(cell, Edge::In);
            self.write("in ");
            self.value(range);
        }
    }

    fn function(&mut self, name: &Name, formals: &[Formal], kind: Option<&Name>, value: &Expr) {
        self.write("fn ");
        self.copy(name.span);
        self.open("(");
        let mut at = self.find('(', name.span.end as usize) + 1;
        for (number, Formal { name, kind, default }) in formals.iter().enumerate() {
            self.comma(number, at, name.span);
            self.copy(name.span);
            self.write(": ");
            self.copy(kind.span);
            at = kind.span.end as usize;
            if let Some(default) = default {
                self.write(" = ");
                self.value(default);
                at = default.span.end as usize;
            }
        }
        let close = self.find(')', at);
        self.close(")", "", at, close);
        let mut end = close + 1;
        if let Some(kind) = kind {
            self.write(": ");
            self.copy(kind.span);
            end = kind.span.end as usize;
        }
        self.write(" ");
        self.equals(end, value);
    }

    /// What stands behind `else`: a block, or another `if`.
    fn otherwise(&mut self, block: &Block, flat: bool) {
        let start = block.span.start as usize;
        match &block.statements[..] {
            [only] if self.between(start, start + 1) != "{" => self.shape(only, flat),
            _ => self.block(block, flat),
        }
    }

    fn sources(&mut self, sources: &[Source]) {
        self.write("use ");
        let mut end = 0;
        for (number, source) in sources.iter().enumerate() {
            if number > 0 {
                self.comma(number, end, source.span);
            }
            self.source(source);
            end = source.span.end as usize;
        }
    }

    fn source(&mut self, source: &Source) {
        let start = source.span.start as usize;
        let (end, is_file) = match &source.from {
            SourcePath::File(path) => (path.span.end as usize, true),
            SourcePath::Path(names) => {
                (names.last().map_or(start, |name| name.span.end as usize), false)
            }
        };
        let path = self.between(start, end);
        self.write(path);
        match &source.names[..] {
            [] => {}
            [name] if is_file && !self.has_comment(name.span.start as usize) => {
                self.write("::");
                self.copy(name.span);
            }
            names => {
                self.open("::{");
                let mut at = end;
                for (number, name) in names.iter().enumerate() {
                    self.comma(number, at, name.span);
                    self.copy(name.span);
                    at = name.span.end as usize;
                }
                let close = self.find('}', at);
                self.close("}", "", at, close);
            }
        }
        if let Some(alias) = &source.alias {
            self.write(" as ");
            self.copy(alias.span);
        }
    }

    /// The items of a phrase. A line may end behind a comma or an arrow.
    fn phrase(&mut self, items: &[Item], columns: Columns<'t>) {
        let mut open = None;
        for (number, item) in items.iter().enumerate() {
            let span = item.span();
            let start = span.start as usize;
            match (open, item, columns) {
                (Some(end), Item::Comma(_), _) => self.cross(end, start, ""),
                (Some(end), _, Columns::Entries(count))
                    if self.flat == 0 && !self.breaks(end, start) =>
                {
                    self.cut(Kind::Entry(count), Edge::Column, 1);
                }
                (Some(end), ..) => self.cross(end, start, " "),
                (None, Item::Comma(_), _) => {}
                (None, Item::Arrow(_), Columns::Arrow(word)) if number == 1 => {
                    self.column(Kind::Word(word), Edge::Arrow);
                }
                (None, ..) if number > 0 => self.write(" "),
                (None, ..) => {}
            }
            match item {
                Item::Expr(value) => self.value(value),
                Item::Comma(_) | Item::Arrow(_) | Item::Equals(_) => self.copy(span),
            }
            open = may_end_line(item).then_some(span.end as usize);
        }
    }

    /// The rows of a drawing on lines of their own; its key ends at `from`.
    fn drawing(&mut self, from: usize, rows: &[Row]) {
        let indent = self.indent() + LEVEL;
        let mut progress = Progress { at: from, tight: true };
        for rows in rows.chunk_by(|row, next| row.span.end + 1 == next.span.start) {
            let Some((start, end)) = rows
                .first()
                .zip(rows.last())
                .map(|(first, last)| (first.span.start as usize - 1, last.span.end as usize + 1))
            else {
                continue;
            };
            self.end();
            self.remarks(&mut progress, start, indent);
            self.want_blank(!progress.tight && self.is_blank_between(progress.at, start));
            self.indent_line(indent);
            self.rows(rows);
            progress = Progress { at: end, tight: false };
        }
    }

    /// Rows of a drawing on one line.
    fn rows(&mut self, rows: &[Row]) {
        for row in rows {
            self.write("|");
            self.copy(row.span);
        }
        self.write("|");
    }
}

/// Whether a phrase is a list of single values, a row of a table.
fn entries<'t>(items: &[Item]) -> Columns<'t> {
    let alternate = items
        .iter()
        .enumerate()
        .all(|(number, item)| matches!(item, Item::Expr(_)) == (number % 2 == 0));
    let commas = items.iter().skip(1).step_by(2).all(|item| matches!(item, Item::Comma(_)));
    if items.len() > 2 && items.len() % 2 == 1 && alternate && commas {
        Columns::Entries(items.len() / 2 + 1)
    } else {
        Columns::Free
    }
}

/// Whether a statement has a block at its end.
fn holds_block(statement: &Statement) -> bool {
    match &statement.kind {
        StatementKind::For { .. } | StatementKind::If { .. } => true,
        StatementKind::Property { block, .. } | StatementKind::Line { block, .. } => {
            block.is_some()
        }
        _ => false,
    }
}

fn may_end_line(item: &Item) -> bool {
    matches!(item, Item::Comma(_) | Item::Arrow(_))
}

/// Whether a statement ends with a comma or an arrow, behind which a phrase would go on in the
/// next line.
pub(super) fn ends_open(statement: &Statement) -> bool {
    match &statement.kind {
        StatementKind::Property { phrase, block: None, .. }
        | StatementKind::Line { phrase, block: None, .. } => {
            phrase.last().is_some_and(may_end_line)
        }
        _ => false,
    }
}
