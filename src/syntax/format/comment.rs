//! Comments of a text. The tree does not hold them; they are what begins with `//` outside
//! strings and charts.

use crate::diagnostic::Span;
use crate::syntax::tree::{
    Block, Expr, ExprKind, File, Formal, Item, Row, Source, SourcePath, Statement, StatementKind,
};

/// A comment, `//` or `///`, up to the end of its line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Comment<'t> {
    /// Its first byte.
    pub(super) start: usize,
    /// Its text with the slashes, without blanks at the end.
    pub(super) text: &'t str,
    /// One past its last byte, blanks at the end included.
    pub(super) end: usize,
}

impl Comment<'_> {
    /// Whether it describes what follows it.
    pub(super) fn is_doc(&self) -> bool {
        self.text.starts_with("///") && !self.text.starts_with("////")
    }
}

/// The comments of a sound text, in order.
pub(super) fn of<'t>(text: &'t str, file: &File) -> Vec<Comment<'t>> {
    let mut closed = Closed(Vec::new());
    closed.statements(&file.statements);
    closed.0.sort_unstable();
    let mut found = Vec::new();
    let mut at = 0;
    for (start, end) in closed.0.into_iter().chain([(text.len(), text.len())]) {
        while let Some(open) = text.get(at..start).and_then(|open| open.find("//")) {
            let start = at + open;
            let rest = &text[start..];
            let end = start + rest.find(['\n', '\r']).unwrap_or(rest.len());
            found.push(Comment { start, text: text[start..end].trim_end(), end });
            at = end;
        }
        at = at.max(end);
    }
    found
}

/// Stretches in which `//` begins no comment: strings and rows of charts.
struct Closed(Vec<(usize, usize)>);

impl Closed {
    fn add(&mut self, span: Span) {
        self.0.push((span.start as usize, span.end as usize));
    }

    fn statements(&mut self, statements: &[Statement]) {
        for statement in statements {
            match &statement.kind {
                StatementKind::Use(sources) => self.sources(sources),
                StatementKind::Let { value, .. } => self.value(value),
                StatementKind::Param { default, range, .. } => {
                    default.iter().chain(range).for_each(|value| self.value(value));
                }
                StatementKind::Function { formals, value, .. } => {
                    let defaults =
                        formals.iter().filter_map(|Formal { default, .. }| default.as_ref());
                    defaults.chain([value]).for_each(|value| self.value(value));
                }
                StatementKind::For { over, body, .. } => {
                    self.value(over);
                    self.block(Some(body));
                }
                StatementKind::If { condition, then, otherwise } => {
                    self.value(condition);
                    self.block(Some(then));
                    self.block(otherwise.as_ref());
                }
                StatementKind::Property { key, phrase, drawing, block } => {
                    // A string, or a name that holds no slash.
                    self.add(key.span);
                    self.phrase(phrase);
                    for Row { span, .. } in drawing {
                        self.add(*span);
                    }
                    self.block(block.as_ref());
                }
                StatementKind::Line { phrase, block, .. } => {
                    self.phrase(phrase);
                    self.block(block.as_ref());
                }
            }
        }
    }

    fn block(&mut self, block: Option<&Block>) {
        self.statements(block.map_or(&[], |block| &block.statements));
    }

    fn sources(&mut self, sources: &[Source]) {
        for source in sources {
            if let SourcePath::File(path) = &source.from {
                self.add(path.span);
            }
        }
    }

    fn phrase(&mut self, items: &[Item]) {
        for item in items {
            if let Item::Expr(value) = item {
                self.value(value);
            }
        }
    }

    fn value(&mut self, value: &Expr) {
        match &value.kind {
            ExprKind::Text(_) => self.add(value.span),
            ExprKind::Unread
            | ExprKind::Number { .. }
            | ExprKind::Colour(_)
            | ExprKind::Path(_) => {}
            ExprKind::Group(inner) | ExprKind::Member(inner, _) | ExprKind::Unary(_, inner) => {
                self.value(inner);
            }
            ExprKind::Point(values) | ExprKind::List(values) => {
                values.iter().for_each(|value| self.value(value));
            }
            ExprKind::Record(fields) => fields.iter().for_each(|field| self.value(&field.value)),
            ExprKind::Choice { condition, then, otherwise } => {
                [condition, then, otherwise].into_iter().for_each(|value| self.value(value));
            }
            ExprKind::Within(target, group) => {
                self.value(target);
                self.value(group);
            }
            ExprKind::Call(target, arguments) => {
                self.value(target);
                arguments.iter().for_each(|argument| self.value(&argument.value));
            }
            ExprKind::Index(target, places, _) => {
                self.value(target);
                places.iter().for_each(|place| self.value(place));
            }
            ExprKind::Binary { left, right, .. } => {
                self.value(left);
                self.value(right);
            }
        }
    }
}
