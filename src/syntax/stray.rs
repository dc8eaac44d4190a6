//! The statements of a block, and what stands between and behind them: comments on things,
//! text that makes no sense, statements that share a line.

use super::grammar::{Part, Rule};
use super::mistake;
use super::reader::Reader;
use super::statement::cut_short;
use super::tree::{Block, Expr, ExprKind, Item, Name, Statement, StatementKind, UnaryOp};
use crate::diagnostic::{Diagnostic, Span};

/// What a list of statements is being made of.
#[derive(Default)]
struct Row {
    statements: Vec<Statement>,
    /// Lines of doc comment for the next statement, and where they stand.
    doc: Vec<(String, Span)>,
    /// Where the last statement, stray text included, ends.
    end: Option<usize>,
    /// Whether the last thing in `statements` is the one that ends there.
    whole: bool,
}

impl Reader<'_> {
    /// The statements of a file or a block.
    pub(super) fn statements<'t>(
        &mut self,
        parts: impl Iterator<Item = Part<'t>>,
    ) -> Vec<Statement> {
        let parts: Vec<Part> = parts.collect();
        let mut row = Row::default();
        let mut next = 0;
        while let Some(part) = parts.get(next) {
            next += 1;
            match part.as_rule() {
                Rule::doc => self.doc(&mut row, part),
                Rule::surplus => self.surplus(part),
                Rule::stray => {
                    let open = self.stray(&mut row, part.clone());
                    if open > 0 {
                        next += closing(parts.get(next..).unwrap_or_default(), open);
                    }
                }
                Rule::missing | Rule::EOI => {}
                _ => self.sound(&mut row, part.clone()),
            }
        }
        self.idle_doc(&mut row);
        row.statements
    }

    /// A statement that the grammar could read.
    fn sound(&mut self, row: &mut Row, part: Part) {
        let start = part.as_span().start();
        let own_line = part.as_rule() == Rule::property || !self.shares_line(row, start);
        if own_line {
            self.rest_told = None;
        }
        let Some(mut statement) = self.statement(part) else { return };
        if !own_line && self.rest(row, &statement) {
            row.end = Some(statement.span.end as usize);
            row.whole = false;
            return;
        }
        statement.doc = joined(std::mem::take(&mut row.doc));
        row.end = Some(statement.span.end as usize);
        row.whole = true;
        row.statements.push(statement);
    }

    /// Whether another statement stands before `start` with neither a line end nor `;` between.
    fn shares_line(&self, row: &Row, start: usize) -> bool {
        row.end.is_some_and(|end| {
            !self.slice(end, start).bytes().any(|byte| matches!(byte, b'\n' | b'\r' | b';'))
        })
    }

    /// Tells of a statement that stands on the line of the one before it; true where it is only
    /// the rest of that one.
    fn rest(&mut self, row: &mut Row, statement: &Statement) -> bool {
        if self.rest_told.is_some() {
            return true;
        }
        let start = statement.span.start as usize;
        self.rest_told = Some(start);
        let StatementKind::Line { word, phrase, block } = &statement.kind else {
            self.tell(two_on_a_line(statement.span));
            return false;
        };
        if let Some(last) = row.statements.last_mut()
            && row.whole
            && let Some(told) = mistake::apart(self.text, last.span, word)
        {
            cut_short(last, word.span);
            self.tell_instead(told, word.span);
            return true;
        }
        self.tell(two_on_a_line(word.span));
        let rest = block.is_none() && phrase.is_empty();
        if let (true, true, Some(last)) = (rest, row.whole, row.statements.last_mut()) {
            cut_short(last, word.span);
        }
        rest
    }

    /// Text that makes no sense, with a block behind it perhaps. Gives the number of brackets
    /// that it leaves open.
    fn stray(&mut self, row: &mut Row, part: Part) -> usize {
        let whole = self.span(&part);
        let start = whole.start as usize;
        let tail = self.shares_line(row, start);
        if !tail {
            self.rest_told = None;
        }
        let mut junk = None;
        let mut block = None;
        for inner in part.into_inner() {
            if inner.as_rule() == Rule::block {
                block = Some(inner);
            } else {
                junk = Some(inner);
            }
        }
        let text = junk.as_ref().map_or("", |junk| junk.as_str()).trim_end();
        let span = Span::new(self.file, start, start + text.len());
        if self.rest_told.is_none() {
            self.rest_told = Some(start);
            let before = match row.statements.last() {
                Some(last) if tail && row.whole => Some(last),
                _ => None,
            };
            let from = before
                .filter(|last| !holds_block(last))
                .map_or(start, |last| last.span.start as usize);
            let told = match (&block, text.is_empty()) {
                (Some(_), true) => Diagnostic::new("E0101", "this block belongs to nothing")
                    .at(self.place(start, start + 1), "here")
                    .help("a block stands behind its name on the same line: `panel front { … }`"),
                (block, _) => {
                    let block = block.as_ref().map(|block| self.span(block));
                    mistake::explain(self, from, span, block)
                }
            };
            self.tell(told);
        }
        let block = block.map(|block| self.block(block));
        row.end = Some(block.as_ref().map_or(span.end, |block| block.span.end) as usize);
        self.keep(row, tail, text, span, block);
        open_brackets(text)
    }

    /// Keeps of a broken statement what is clear of it.
    fn keep(&mut self, row: &mut Row, tail: bool, text: &str, span: Span, block: Option<Block>) {
        let last = match row.statements.last_mut() {
            Some(last) if tail && row.whole && !holds_block(last) => last,
            _ => {
                if let Some(mut statement) = self.guessed(text, span, block) {
                    statement.doc = joined(std::mem::take(&mut row.doc));
                    row.statements.push(statement);
                }
                row.doc.clear();
                row.whole = false;
                return;
            }
        };
        let colon = text.starts_with(':') && !text.starts_with("::");
        if let (true, StatementKind::Line { word, phrase, block }) = (colon, &last.kind)
            && phrase.is_empty()
            && block.is_none()
        {
            last.kind = StatementKind::Property {
                key: word.clone(),
                phrase: Vec::new(),
                drawing: Vec::new(),
                block: None,
            };
        }
        cut_short(last, span);
        if let Some(made) = block {
            last.span.end = made.span.end;
            if let StatementKind::Property { block, .. } | StatementKind::Line { block, .. } =
                &mut last.kind
            {
                *block = Some(made);
            }
        }
        row.whole = false;
    }

    /// What a statement that could not be read further begins with: the name of `let x`, the
    /// block of `for` and `if`. The rest of it is unread.
    fn guessed(&self, text: &str, span: Span, block: Option<Block>) -> Option<Statement> {
        let (head, rest) = text.split_once([' ', '\t'])?;
        let rest = rest.trim_start();
        let length = rest.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(rest.len());
        let text = rest.get(..length).filter(|name| !name.is_empty())?;
        let start = span.end as usize - rest.len();
        let name = Name { text: text.to_owned(), span: self.place(start, start + length) };
        let unread = Expr { span, kind: ExprKind::Unread };
        let end = block.as_ref().map_or(span.end, |block| block.span.end);
        let kind = match (head, block) {
            ("for", Some(body)) => StatementKind::For { name, over: unread, body },
            ("if", Some(then)) => StatementKind::If { condition: unread, then, otherwise: None },
            ("let" | "fn", _) => StatementKind::Let { name, value: unread },
            ("param", _) => {
                StatementKind::Param { name, kind: None, default: Some(unread), range: None }
            }
            _ => return None,
        };
        Some(Statement { span: Span { end, ..span }, doc: String::new(), kind })
    }

    fn doc(&mut self, row: &mut Row, part: &Part) {
        let span = self.span(part);
        if self.leads_line(span.start as usize) {
            let text = part.as_str().trim_start_matches('/').trim();
            row.doc.push((text.to_owned(), span));
            return;
        }
        self.tell(
            Diagnostic::new("E0108", "a `///` comment stands above what it describes")
                .at(span, "not at the end of a line")
                .help("put it on a line of its own above, or write `//` for a plain comment"),
        );
    }

    /// Doc comments with nothing behind them.
    fn idle_doc(&mut self, row: &mut Row) {
        let idle = std::mem::take(&mut row.doc);
        if let (Some((_, first)), Some((_, last))) = (idle.first(), idle.last()) {
            self.tell(
                Diagnostic::new("W0101", "this `///` comment describes nothing")
                    .at(first.to(*last), "nothing follows it")
                    .help("write `//` for a plain comment"),
            );
        }
    }

    fn surplus(&mut self, part: &Part) {
        let span = self.span(part);
        let mut told = Diagnostic::new("E0106", "this `}` closes nothing").at(span, "here");
        if let Some(last) = self.blocks.last()
            && let Some(close) = last.close
        {
            told = told
                .at(self.place(last.open, last.open + 1), "the last block opens here")
                .at(self.place(close, close + 1), "and is closed here");
        }
        self.tell(told.help("take it away, or add the `{` that it was meant to close"));
    }

    /// Takes the next item of a phrase; what it was probably meant to be together with the last
    /// one is told, and where that is clear, mended.
    pub(super) fn beside(&mut self, items: &mut Vec<Item>, item: Item) -> Option<Item> {
        let Item::Expr(next) = &item else { return Some(item) };
        if let [.., Item::Expr(before), Item::Comma(_)] = &mut items[..] {
            let Some(mended) = self.decimal_comma(before, next, true) else { return Some(item) };
            *before = mended;
            items.pop();
            return None;
        }
        let Some(Item::Expr(before)) = items.last_mut() else { return Some(item) };
        if before.kind == ExprKind::Unread && before.span.end == next.span.start {
            return None;
        }
        if let ExprKind::Path(names) = &next.kind
            && let [word] = &names[..]
            && let Some(told) = mistake::apart(self.text, before.span, word)
        {
            let word_span = word.span;
            let unread = Expr { span: before.span.to(word.span), kind: ExprKind::Unread };
            *before = match &before.kind {
                ExprKind::Number { value, unit: None } if mistake::is_unit(&word.text) => Expr {
                    span: unread.span,
                    kind: ExprKind::Number { value: *value, unit: Some(word.clone()) },
                },
                _ => unread,
            };
            self.tell_instead(told, word_span);
            return None;
        }
        if leads_with_minus(next)
            && before.span.end < next.span.start
            && matches!(
                before.kind,
                ExprKind::Number { .. }
                    | ExprKind::Group(_)
                    | ExprKind::Point(_)
                    | ExprKind::Member(..)
                    | ExprKind::Call(..)
                    | ExprKind::Index(..)
            )
        {
            let sign = Span { end: next.span.start + 1, ..next.span };
            self.tell(mistake::uneven(sign, "-"));
            before.kind = ExprKind::Unread;
            return None;
        }
        Some(item)
    }

    /// Tells of `1,5cm` and gives what was meant. In brackets `(0,5cm)` may well be a point; in a
    /// phrase it is not.
    pub(super) fn decimal_comma(
        &mut self,
        before: &Expr,
        after: &Expr,
        in_phrase: bool,
    ) -> Option<Expr> {
        let (ExprKind::Number { value, unit: None }, ExprKind::Number { unit, .. }) =
            (&before.kind, &after.kind)
        else {
            return None;
        };
        let (start, end) = (before.span.end as usize, after.span.start as usize);
        if self.slice(start, end) != "," || unit.is_none() || (*value == 0.0 && !in_phrase) {
            return None;
        }
        let span = before.span.to(after.span);
        let told = mistake::decimal_comma(self, span);
        self.tell(told);
        let digits = unit.as_ref().map_or(span.end, |unit| unit.span.start);
        let number = self.slice(span.start as usize, digits as usize).replace(',', ".");
        let kind = match number.parse() {
            Ok(value) => ExprKind::Number { value, unit: unit.clone() },
            Err(_) => ExprKind::Unread,
        };
        Some(Expr { span, kind })
    }
}

/// How many of the following parts only continue a stray line that left brackets open: all up
/// to the stray line that closes them, if it is near and nothing that stands for itself comes
/// between.
fn closing(parts: &[Part], mut open: usize) -> usize {
    const NEAR: usize = 40;
    for (count, part) in parts.iter().take(NEAR).enumerate() {
        match part.as_rule() {
            Rule::stray => {
                let text = part.as_str();
                let line = text.split(['{', '}']).next().unwrap_or(text);
                let (closed, opened) = balance(line);
                if closed >= open && opened == 0 {
                    // A block behind the bracket must still be read.
                    return if text.contains('{') { count } else { count + 1 };
                }
                open = open.saturating_sub(closed) + opened;
            }
            Rule::line | Rule::property if !part.as_str().contains('{') => {}
            _ => return 0,
        }
    }
    0
}

/// Whether the first sign of a value is a minus of its own.
fn leads_with_minus(expr: &Expr) -> bool {
    match &expr.kind {
        ExprKind::Unary(UnaryOp::Minus, _) => true,
        ExprKind::Binary { left, .. } => leads_with_minus(left),
        _ => false,
    }
}

fn open_brackets(text: &str) -> usize {
    balance(text).1
}

/// Brackets closed that were not opened in the text, and opened that are not closed in it.
fn balance(text: &str) -> (usize, usize) {
    let (mut closed, mut open) = (0_usize, 0_usize);
    for byte in text.bytes() {
        match byte {
            b'(' | b'[' => open += 1,
            b')' | b']' if open > 0 => open -= 1,
            b')' | b']' => closed += 1,
            _ => {}
        }
    }
    (closed, open)
}

/// What to say of a statement on the line of the one before it.
pub(crate) fn two_on_a_line(at: Span) -> Diagnostic {
    Diagnostic::new("E0107", "a second statement begins on this line")
        .at(at, "here")
        .help("put it on a line of its own, or `;` before it")
}

fn holds_block(statement: &Statement) -> bool {
    match &statement.kind {
        StatementKind::For { .. } | StatementKind::If { .. } => true,
        StatementKind::Property { block, .. } | StatementKind::Line { block, .. } => {
            block.is_some()
        }
        _ => false,
    }
}

fn joined(doc: Vec<(String, Span)>) -> String {
    doc.into_iter().map(|(line, _)| line).collect::<Vec<_>>().join("\n")
}
