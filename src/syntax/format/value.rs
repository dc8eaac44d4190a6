//! Values, with blanks round their operators.

use super::pen::Pen;
use crate::diagnostic::Span;
use crate::syntax::tree::{Argument, BinaryOp, Expr, ExprKind, Field, UnaryOp};

impl Pen<'_> {
    /// A value.
    pub(super) fn value(&mut self, value: &Expr) {
        let span = value.span;
        match &value.kind {
            ExprKind::Unread
            | ExprKind::Number { .. }
            | ExprKind::Colour(_)
            | ExprKind::Text(_)
            | ExprKind::Path(_) => self.copy(span),
            ExprKind::Group(inner) => {
                self.bracketed("(", ")", span.start, span, std::slice::from_ref(&**inner));
            }
            ExprKind::Point(values) => self.bracketed("(", ")", span.start, span, values),
            ExprKind::List(values) => self.bracketed("[", "]", span.start, span, values),
            ExprKind::Record(fields) => self.record(span, fields),
            ExprKind::Choice { condition, then, otherwise } => {
                for (word, part) in [("if ", condition), (" then ", then), (" else ", otherwise)] {
                    self.write(word);
                    self.value(part);
                }
            }
            ExprKind::Member(target, name) => {
                self.value(target);
                self.write(".");
                self.copy(name.span);
            }
            ExprKind::Within(target, group) => {
                self.value(target);
                self.write(".");
                self.value(group);
            }
            ExprKind::Call(target, arguments) => {
                self.value(target);
                self.arguments(target.span.end as usize, span, arguments);
            }
            ExprKind::Index(target, places, from) => {
                self.value(target);
                self.open("[");
                let mut at = self.list(target.span.end as usize + 1, places);
                if let Some(from) = from {
                    self.write(" from ");
                    self.copy(from.span);
                    at = from.span.end as usize;
                }
                self.close("]", "", at, span.end as usize - 1);
            }
            ExprKind::Unary(UnaryOp::Minus, inner) => {
                self.write("-");
                self.value(inner);
            }
            ExprKind::Unary(UnaryOp::Not, inner) => {
                self.write("not ");
                self.value(inner);
            }
            ExprKind::Binary { op, op_span, left, right } => {
                let (from, to) = (op_span.end as usize, right.span.start as usize);
                // A line may end only behind an operator with a blank before it.
                let close = is_close(*op, left, right) && !self.breaks(from, to);
                let blank = if close { "" } else { " " };
                self.value(left);
                self.write(blank);
                self.copy(*op_span);
                self.cross(from, to, blank);
                self.value(right);
            }
        }
    }

    /// Values with commas between them, in brackets of which the first stands at `open`.
    fn bracketed(&mut self, left: &str, right: &str, open: u32, whole: Span, values: &[Expr]) {
        self.open(left);
        let at = self.list(open as usize + 1, values);
        self.close(right, "", at, whole.end as usize - 1);
    }

    /// `{ width: 12cm, depth: 3cm }`
    fn record(&mut self, whole: Span, fields: &[Field]) {
        self.open("{");
        let mut at = whole.start as usize + 1;
        for (number, Field { name, value }) in fields.iter().enumerate() {
            if number > 0 {
                self.write(",");
            }
            self.cross(at, name.span.start as usize, " ");
            self.copy(name.span);
            self.write(": ");
            self.value(value);
            at = value.span.end as usize;
        }
        self.close("}", " ", at, whole.end as usize - 1);
    }

    /// Values with commas between them; `at` is the place behind the opening bracket. Gives the
    /// end of the last one.
    fn list(&mut self, mut at: usize, values: &[Expr]) -> usize {
        for (number, value) in values.iter().enumerate() {
            self.comma(number, at, value.span);
            self.value(value);
            at = value.span.end as usize;
        }
        at
    }

    fn arguments(&mut self, open: usize, whole: Span, arguments: &[Argument]) {
        self.open("(");
        let mut at = open + 1;
        for (number, Argument { name, value }) in arguments.iter().enumerate() {
            self.comma(number, at, name.as_ref().map_or(value.span, |name| name.span));
            if let Some(name) = name {
                self.copy(name.span);
                self.write(": ");
            }
            self.value(value);
            at = value.span.end as usize;
        }
        self.close(")", "", at, whole.end as usize - 1);
    }

    /// Crosses to the next part of a list, which stands at `next`; the one before ends at `at`.
    pub(super) fn comma(&mut self, number: usize, at: usize, next: Span) {
        if number > 0 {
            self.write(",");
        }
        self.cross(at, next.start as usize, if number > 0 { " " } else { "" });
    }
}

/// Whether an operator stands close to its operands: `1..6`, but `0cm .. a + 1cm`; the ratio
/// `2/1/1` of plain numbers, but `width / 2`.
fn is_close(op: BinaryOp, left: &Expr, right: &Expr) -> bool {
    match op {
        BinaryOp::To => is_single(left) && is_single(right),
        BinaryOp::Over => is_ratio(left) && is_plain(right),
        _ => false,
    }
}

fn is_single(side: &Expr) -> bool {
    !matches!(
        side.kind,
        ExprKind::Binary { .. } | ExprKind::Choice { .. } | ExprKind::Unary(UnaryOp::Not, _)
    )
}

fn is_ratio(value: &Expr) -> bool {
    match &value.kind {
        ExprKind::Binary { op: BinaryOp::Over, left, right, .. } => {
            is_ratio(left) && is_plain(right)
        }
        _ => is_plain(value),
    }
}

/// Whether a value is a number without a unit.
fn is_plain(value: &Expr) -> bool {
    matches!(value.kind, ExprKind::Number { unit: None, .. })
}
