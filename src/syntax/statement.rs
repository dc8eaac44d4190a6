//! Statements: the shapes that the grammar tells apart.

use super::grammar::{Part, Rule};
use super::nesting::{self, LONGEST_CHOICE};
use super::reader::{Braces, Reader};
use super::tree::{
    Block, Expr, ExprKind, Formal, Item, Name, Row, Source, SourcePath, Statement, StatementKind,
};
use crate::diagnostic::{Diagnostic, Span};

/// What a property or a line is made of, after its first word.
#[derive(Default)]
struct Tail {
    phrase: Vec<Item>,
    drawing: Vec<Row>,
    block: Option<Block>,
}

impl Reader<'_> {
    /// The statement in a part, or nothing where its shape is too broken.
    pub(super) fn statement(&mut self, part: Part) -> Option<Statement> {
        let start = self.span(&part);
        let rule = part.as_rule();
        let inner = part.into_inner();
        let (kind, end) = match rule {
            Rule::use_ => self.sources(inner),
            Rule::let_ => self.let_(inner),
            Rule::param => self.param(inner),
            Rule::function => self.function(inner),
            Rule::repeat => self.repeat(inner),
            Rule::choose => self.choose(inner),
            Rule::property => self.property(inner),
            _ => self.line(inner),
        }?;
        Some(Statement { span: Span { end: end.end, ..start }, doc: String::new(), kind })
    }

    fn sources<'t>(
        &mut self,
        parts: impl Iterator<Item = Part<'t>>,
    ) -> Option<(StatementKind, Span)> {
        let mut sources = Vec::new();
        for part in parts.filter(|part| part.as_rule() == Rule::source) {
            let mut span = self.span(&part);
            let whole = span.end as usize;
            let mut from = None;
            let mut names = Vec::new();
            let mut alias = None;
            let mut renamed = false;
            for inner in part.into_inner() {
                span.end = self.span(&inner).end;
                match inner.as_rule() {
                    Rule::string => {
                        let place = self.span(&inner);
                        let text = self.string(inner);
                        from = Some(SourcePath::File(Name { text, span: place }));
                    }
                    Rule::unquoted => from = Some(SourcePath::Path(vec![self.name(&inner)])),
                    Rule::path => {
                        let names = inner.into_inner().map(|name| self.name(&name)).collect();
                        from = Some(SourcePath::Path(names));
                    }
                    Rule::kw_as => renamed = true,
                    _ if renamed => alias = Some(self.name(&inner)),
                    _ => names.push(self.name(&inner)),
                }
            }
            if !names.is_empty() && !renamed {
                span.end += self.closing_brace(span.end as usize, whole);
            }
            sources.push(Source { span, from: from?, names, alias });
        }
        let end = sources.last()?.span;
        Some((StatementKind::Use(sources), end))
    }

    /// How far behind `at`, where a list of names ends, its brace closes it; 0 where it has none.
    /// The source ends at `end`.
    fn closing_brace(&self, at: usize, end: usize) -> u32 {
        let mut rest = self.slice(at, end).trim_start();
        while rest.starts_with("//") {
            rest = rest.trim_start_matches(|c| !matches!(c, '\n' | '\r')).trim_start();
        }
        let length = end - rest.len() + 1 - at;
        if rest.starts_with('}') { u32::try_from(length).unwrap_or(0) } else { 0 }
    }

    fn let_<'t>(&mut self, parts: impl Iterator<Item = Part<'t>>) -> Option<(StatementKind, Span)> {
        let mut parts = parts.filter(|part| part.as_rule() != Rule::kw_let);
        let name = self.new_name(&parts.next()?);
        let value = self.expr(parts.next()?);
        let end = value.span;
        Some((StatementKind::Let { name, value }, end))
    }

    fn param<'t>(
        &mut self,
        parts: impl Iterator<Item = Part<'t>>,
    ) -> Option<(StatementKind, Span)> {
        let mut parts = parts.filter(|part| part.as_rule() != Rule::kw_param);
        let name = self.new_name(&parts.next()?);
        let mut end = name.span;
        let (mut kind, mut default, mut range) = (None, None, None);
        let mut ranged = false;
        for part in parts {
            match part.as_rule() {
                Rule::name => {
                    let name = self.name(&part);
                    end = name.span;
                    kind = Some(name);
                }
                Rule::kw_in => ranged = true,
                _ => {
                    let value = self.expr(part);
                    end = value.span;
                    *(if ranged { &mut range } else { &mut default }) = Some(value);
                }
            }
        }
        Some((StatementKind::Param { name, kind, default, range }, end))
    }

    fn function<'t>(
        &mut self,
        parts: impl Iterator<Item = Part<'t>>,
    ) -> Option<(StatementKind, Span)> {
        let mut parts = parts.filter(|part| part.as_rule() != Rule::kw_fn);
        let name = self.new_name(&parts.next()?);
        let mut formals = Vec::new();
        let mut kind = None;
        let mut value = None;
        for part in parts {
            match part.as_rule() {
                Rule::formal => formals.push(self.formal(part)?),
                Rule::name => kind = Some(self.name(&part)),
                _ => value = Some(self.expr(part)),
            }
        }
        let value = value?;
        let end = value.span;
        Some((StatementKind::Function { name, formals, kind, value }, end))
    }

    fn formal(&mut self, part: Part) -> Option<Formal> {
        let mut parts = part.into_inner();
        let name = self.new_name(&parts.next()?);
        let kind = self.name(&parts.next()?);
        let default = parts.next().map(|value| self.expr(value));
        Some(Formal { name, kind, default })
    }

    fn repeat<'t>(
        &mut self,
        parts: impl Iterator<Item = Part<'t>>,
    ) -> Option<(StatementKind, Span)> {
        let mut parts = parts.filter(|part| !matches!(part.as_rule(), Rule::kw_for | Rule::kw_in));
        let name = self.new_name(&parts.next()?);
        let over = self.expr(parts.next()?);
        let body = self.block(parts.next()?);
        let end = body.span;
        Some((StatementKind::For { name, over, body }, end))
    }

    fn choose<'t>(
        &mut self,
        parts: impl Iterator<Item = Part<'t>>,
    ) -> Option<(StatementKind, Span)> {
        let mut parts = parts.filter(|part| !matches!(part.as_rule(), Rule::kw_if | Rule::kw_else));
        let condition = self.expr(parts.next()?);
        let then = self.block(parts.next()?);
        let mut end = then.span;
        let mut otherwise = None;
        if let Some(part) = parts.next() {
            let block =
                if part.as_rule() == Rule::block { self.block(part) } else { self.else_if(part) };
            end = block.span;
            otherwise = Some(block);
        }
        Some((StatementKind::If { condition, then, otherwise }, end))
    }

    /// `else if` as an `if` alone in a block.
    fn else_if(&mut self, part: Part) -> Block {
        let span = self.span(&part);
        if self.choices >= LONGEST_CHOICE {
            self.tell(nesting::told(Span { end: span.start + 2, ..span }));
            return Block { span, statements: Vec::new() };
        }
        self.choices += 1;
        let statements: Vec<Statement> = self.statement(part).into_iter().collect();
        self.choices -= 1;
        Block { span: statements.first().map_or(span, |only| only.span), statements }
    }

    /// `{ … }`
    pub(super) fn block(&mut self, part: Part) -> Block {
        let whole = self.span(&part);
        let closed = part
            .clone()
            .into_inner()
            .next_back()
            .is_none_or(|last| last.as_rule() != Rule::missing);
        let open = part.as_span().start();
        let close = part.as_span().end().saturating_sub(1);
        let statements = self.statements(part.into_inner());
        self.blocks.push(Braces { open, close: closed.then_some(close) });
        self.rest_told = None;
        Block { span: whole, statements }
    }

    fn property<'t>(
        &mut self,
        mut parts: impl Iterator<Item = Part<'t>>,
    ) -> Option<(StatementKind, Span)> {
        let key = self.key(parts.next()?);
        let (tail, end) = self.tail(parts, key.span);
        let Tail { phrase, drawing, block } = tail;
        Some((StatementKind::Property { key, phrase, drawing, block }, end))
    }

    fn line<'t>(
        &mut self,
        mut parts: impl Iterator<Item = Part<'t>>,
    ) -> Option<(StatementKind, Span)> {
        let first = parts.next()?;
        let word = match first.clone().into_inner().next() {
            Some(name) => self.name(&name),
            None => self.name(&first),
        };
        let (tail, end) = self.tail(parts, word.span);
        Some((StatementKind::Line { word, phrase: tail.phrase, block: tail.block }, end))
    }

    /// What follows the first word, and where it ends.
    fn tail<'t>(&mut self, parts: impl Iterator<Item = Part<'t>>, mut end: Span) -> (Tail, Span) {
        let mut tail = Tail::default();
        for part in parts {
            match part.as_rule() {
                Rule::phrase => {
                    tail.phrase = self.phrase(part);
                    end = tail.phrase.last().map_or(end, Item::span);
                }
                Rule::drawing => {
                    tail.drawing = self.drawing(part);
                    if let Some(row) = tail.drawing.last() {
                        // The bar behind the last cells belongs to the row, if there is one.
                        let bar = row.span.end as usize;
                        end = self.place(bar, bar + usize::from(self.slice(bar, bar + 1) == "|"));
                    }
                }
                Rule::block => {
                    let block = self.block(part);
                    end = block.span;
                    tail.block = Some(block);
                }
                _ => {}
            }
        }
        (tail, end)
    }

    /// The items of a phrase; mistakes between two neighbours are told and mended.
    fn phrase(&mut self, part: Part) -> Vec<Item> {
        let mut items: Vec<Item> = Vec::new();
        for inner in part.into_inner() {
            let span = self.span(&inner);
            let sign = |length| Span { end: span.start + length, ..span };
            let item = match inner.as_rule() {
                Rule::comma => Item::Comma(sign(1)),
                Rule::arrow => Item::Arrow(sign(2)),
                Rule::equals => Item::Equals(sign(1)),
                _ => Item::Expr(self.expr(inner)),
            };
            if let Some(item) = self.beside(&mut items, item) {
                items.push(item);
            }
        }
        items
    }

    /// The rows of a drawing, top row first as in the text.
    fn drawing(&mut self, part: Part) -> Vec<Row> {
        let mut rows = Vec::new();
        for row in part.into_inner() {
            for cells in row.into_inner() {
                let span = self.span(&cells);
                if cells.as_rule() == Rule::cells {
                    rows.push(Row { text: cells.as_str().to_owned(), span });
                    continue;
                }
                let shown = self.slice(span.start as usize, span.end as usize).trim_end();
                let place =
                    Span::new(self.file, span.start as usize, span.start as usize + shown.len());
                self.tell(
                    Diagnostic::new("E0104", "a row of a chart is not closed with `|`")
                        .at(place, "here")
                        .help("a row is the text between two bars, such as `|..*..|`"),
                );
                let text = shown.trim_start_matches('|').to_owned();
                rows.push(Row { text, span: Span { start: place.start + 1, ..place } });
            }
        }
        rows
    }
}

/// Puts "could not be read" where the rest of a statement is missing, so that nobody complains
/// of what is not there.
pub(super) fn cut_short(statement: &mut Statement, at: Span) {
    let unread = Expr { span: at, kind: ExprKind::Unread };
    match &mut statement.kind {
        StatementKind::Let { value, .. } | StatementKind::Function { value, .. } => {
            *value = unread;
        }
        StatementKind::Param { default, range, .. } => match (&default, &range) {
            (_, Some(_)) => *range = Some(unread),
            (_, None) => *default = Some(unread),
        },
        StatementKind::Property { phrase, .. } | StatementKind::Line { phrase, .. } => {
            phrase.push(Item::Expr(unread));
        }
        StatementKind::Use(_) | StatementKind::For { .. } | StatementKind::If { .. } => {}
    }
}
