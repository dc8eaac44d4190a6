//! Operators, with their dimensions checked.

use super::Evaluator;
use super::scope::ScopeId;
use super::value::{Value, Vector};
use crate::diagnostic::{Diagnostic, Span};
use crate::syntax::tree::{BinaryOp, Expr};
use crate::units::{Dimension, Quantity};
use std::cmp::Ordering;

impl<'t> Evaluator<'t> {
    /// A value as a quantity; measures of a body are lengths. Others are told.
    pub(super) fn as_quantity(&mut self, value: Value, span: Span) -> Option<Quantity> {
        match value {
            Value::Poison => None,
            Value::Quantity(quantity) => Some(quantity),
            Value::Measure { wearer, name } => {
                self.measure_length(wearer, &name, span).map(Quantity::length)
            }
            other => {
                self.wrong(&other, "a number or a quantity", span);
                None
            }
        }
    }

    pub(super) fn negated(&mut self, value: Value, span: Span) -> Value {
        match value {
            Value::Vector(vector) => {
                let parts = vector.parts.iter().map(|part| -part).collect();
                Value::Vector(Vector { parts, ..vector })
            }
            other => match self.as_quantity(other, span) {
                Some(quantity) => Value::Quantity(Quantity { value: -quantity.value, ..quantity }),
                None => Value::Poison,
            },
        }
    }

    pub(super) fn binary(
        &mut self,
        op: BinaryOp,
        op_span: Span,
        left: &'t Expr,
        right: &'t Expr,
        scope: ScopeId,
    ) -> Value {
        if matches!(op, BinaryOp::And | BinaryOp::Or) {
            return self.logical(op, left, right, scope);
        }
        if matches!(op, BinaryOp::Equal | BinaryOp::Unequal)
            && let Some(found) = self.option_compared(op, (left, right), scope)
        {
            return found;
        }
        let a = self.eval(left, scope);
        let b = self.eval(right, scope);
        if a == Value::Poison || b == Value::Poison {
            return Value::Poison;
        }
        match (op, a, b) {
            (BinaryOp::Plus, Value::Edges(mut first), Value::Edges(second)) => {
                first.extend(second);
                Value::Edges(first)
            }
            (BinaryOp::Equal | BinaryOp::Unequal, Value::Word(a), Value::Word(b)) => {
                Value::Bool((a.word == b.word) == (op == BinaryOp::Equal))
            }
            (BinaryOp::Equal | BinaryOp::Unequal, a, b) if same_sort(&a, &b) => {
                Value::Bool((a == b) == (op == BinaryOp::Equal))
            }
            (op, a, b) => {
                let (a, b) = (marked(a), marked(b));
                match (a, b) {
                    (Value::Vector(a), Value::Vector(b)) => {
                        self.vectors(op, op_span, (a, left.span), (b, right.span))
                    }
                    (Value::Vector(a), b) => {
                        let Some(b) = self.as_quantity(b, right.span) else {
                            return Value::Poison;
                        };
                        self.scaled(op, op_span, a, b, (left.span, right.span))
                    }
                    (a, Value::Vector(b)) if op == BinaryOp::Times => {
                        let Some(a) = self.as_quantity(a, left.span) else {
                            return Value::Poison;
                        };
                        self.scaled(op, op_span, b, a, (left.span, right.span))
                    }
                    (a, b) => {
                        let Some(a) = self.as_quantity(a, left.span) else {
                            return Value::Poison;
                        };
                        let Some(b) = self.as_quantity(b, right.span) else {
                            return Value::Poison;
                        };
                        self.quantities(op, op_span, (a, left.span), (b, right.span))
                    }
                }
            }
        }
    }

    fn logical(&mut self, op: BinaryOp, left: &'t Expr, right: &'t Expr, scope: ScopeId) -> Value {
        let a = self.eval(left, scope);
        let b = self.eval(right, scope);
        match (a, b) {
            (Value::Poison, _) | (_, Value::Poison) => Value::Poison,
            (Value::Bool(a), Value::Bool(b)) => {
                Value::Bool(if op == BinaryOp::And { a && b } else { a || b })
            }
            (Value::Bool(_), other) => self.wrong(&other, "a yes or no", right.span),
            (other, _) => self.wrong(&other, "a yes or no", left.span),
        }
    }

    fn quantities(
        &mut self,
        op: BinaryOp,
        op_span: Span,
        (a, a_span): (Quantity, Span),
        (b, b_span): (Quantity, Span),
    ) -> Value {
        let span = a_span.to(b_span);
        // A bare 0 takes the dimension of its partner.
        let dimension = if a.fits(b.dimension) {
            Some(b.dimension)
        } else if b.fits(a.dimension) {
            Some(a.dimension)
        } else {
            None
        };
        match op {
            BinaryOp::Times => {
                self.finite(Quantity::new(a.value * b.value, a.dimension.times(b.dimension)), span)
            }
            BinaryOp::Over => {
                self.finite(Quantity::new(a.value / b.value, a.dimension.over(b.dimension)), span)
            }
            BinaryOp::At => {
                if b.fits(Dimension::ANGLE) {
                    let parts = vec![a.value * libm::cos(b.value), a.value * libm::sin(b.value)];
                    return Value::Vector(Vector { dimension: a.dimension, parts });
                }
                self.tell(
                    Diagnostic::new("E0301", "after `@` stands a direction")
                        .at(b_span, self.shown(b))
                        .help("such as `5cm @ 30deg`"),
                );
                Value::Poison
            }
            _ => {
                let Some(dimension) = dimension else {
                    return self.mismatch(op, op_span, (a, a_span), (b, b_span));
                };
                let order = order(a.value, b.value);
                match op {
                    BinaryOp::Plus => {
                        self.finite(Quantity::new(a.value + b.value, dimension), span)
                    }
                    BinaryOp::Minus => {
                        self.finite(Quantity::new(a.value - b.value, dimension), span)
                    }
                    BinaryOp::To => Value::Range(
                        Quantity::new(a.value, dimension),
                        Quantity::new(b.value, dimension),
                    ),
                    BinaryOp::Equal => Value::Bool(order.is_some_and(|o| o.is_eq())),
                    BinaryOp::Unequal => Value::Bool(order.is_some_and(|o| o.is_ne())),
                    BinaryOp::Less => Value::Bool(order.is_some_and(|o| o.is_lt())),
                    BinaryOp::Greater => Value::Bool(order.is_some_and(|o| o.is_gt())),
                    BinaryOp::AtMost => Value::Bool(order.is_some_and(|o| o.is_le())),
                    BinaryOp::AtLeast => Value::Bool(order.is_some_and(|o| o.is_ge())),
                    _ => Value::Poison,
                }
            }
        }
    }

    fn mismatch(
        &mut self,
        op: BinaryOp,
        op_span: Span,
        (a, a_span): (Quantity, Span),
        (b, b_span): (Quantity, Span),
    ) -> Value {
        let verb = match op {
            BinaryOp::Plus => "be added",
            BinaryOp::Minus => "be subtracted",
            BinaryOp::To => "make a range",
            _ => "be compared",
        };
        let mut told = Diagnostic::new(
            "E0301",
            format!("{} and {} cannot {verb}", a.dimension.name(), b.dimension.name()),
        )
        .at(a_span, self.shown(a))
        .at(b_span, self.shown(b));
        if a_span == b_span {
            told.labels.truncate(1);
            told = told.at(op_span, "here");
        }
        let bare = if a.dimension.is_number() { Some(b.dimension) } else { None };
        let bare = bare.or(b.dimension.is_number().then_some(a.dimension));
        if let Some(dimension) = bare.filter(|dimension| !dimension.example().is_empty()) {
            told = told.help(format!(
                "write the unit against the number; {} is such as {}",
                dimension.name(),
                dimension.example()
            ));
        }
        self.tell(told);
        Value::Poison
    }

    fn vectors(
        &mut self,
        op: BinaryOp,
        op_span: Span,
        (a, a_span): (Vector, Span),
        (b, b_span): (Vector, Span),
    ) -> Value {
        if a.parts.len() != b.parts.len() {
            self.tell(
                Diagnostic::new("E0301", "a point of the drawing and a place in space do not mix")
                    .at(a_span, format!("{} parts", a.parts.len()))
                    .at(b_span, format!("{} parts", b.parts.len())),
            );
            return Value::Poison;
        }
        let dimension = if a.fits(b.dimension) {
            b.dimension
        } else if b.fits(a.dimension) {
            a.dimension
        } else {
            return self.mismatch(
                op,
                op_span,
                (Quantity::new(a.parts.first().copied().unwrap_or(0.0), a.dimension), a_span),
                (Quantity::new(b.parts.first().copied().unwrap_or(0.0), b.dimension), b_span),
            );
        };
        let sign = match op {
            BinaryOp::Plus => 1.0,
            BinaryOp::Minus => -1.0,
            BinaryOp::Equal | BinaryOp::Unequal => {
                let mut pairs = a.parts.iter().zip(&b.parts);
                let same = pairs.all(|(a, b)| order(*a, *b) == Some(Ordering::Equal));
                return Value::Bool(same == (op == BinaryOp::Equal));
            }
            _ => {
                self.tell(
                    Diagnostic::new("E0304", "points can be added, subtracted and compared only")
                        .at(op_span, "not this"),
                );
                return Value::Poison;
            }
        };
        let parts = a.parts.iter().zip(&b.parts).map(|(a, b)| a + sign * b).collect();
        Value::Vector(Vector { dimension, parts })
    }

    fn scaled(
        &mut self,
        op: BinaryOp,
        op_span: Span,
        vector: Vector,
        by: Quantity,
        (left, right): (Span, Span),
    ) -> Value {
        let (dimension, scale) = match op {
            BinaryOp::Times => (vector.dimension.times(by.dimension), by.value),
            BinaryOp::Over => (vector.dimension.over(by.dimension), 1.0 / by.value),
            _ => {
                self.tell(
                    Diagnostic::new("E0304", "a point and a quantity cannot be put together so")
                        .at(op_span, "here")
                        .at(left, "")
                        .at(right, "")
                        .help("to go on from a point write `P + 5cm @ 30deg` or `P + (2cm, 0)`"),
                );
                return Value::Poison;
            }
        };
        let parts: Vec<f64> = vector.parts.iter().map(|part| part * scale).collect();
        if parts.iter().all(|part| part.is_finite()) {
            Value::Vector(Vector { dimension, parts })
        } else {
            self.finite(Quantity::number(f64::NAN), left.to(right))
        }
    }
}

/// How close two values are taken to be one, as a share of both: `3/8in` is `9.525mm`, whatever
/// the last bit of their products with the units says.
const SAME: f64 = 1e-12;

/// Which of two values is greater, if they are not the same.
fn order(a: f64, b: f64) -> Option<Ordering> {
    if (a - b).abs() <= SAME * (a.abs() + b.abs()) {
        return Some(Ordering::Equal);
    }
    a.partial_cmp(&b)
}

/// Marks on panels are points where numbers are wanted.
fn marked(value: Value) -> Value {
    match value {
        Value::Mark(mark) => Value::point(mark.at),
        other => other,
    }
}

/// Values that can be compared as wholes.
fn same_sort(a: &Value, b: &Value) -> bool {
    matches!(
        (a, b),
        (Value::Text(_), Value::Text(_))
            | (Value::Bool(_), Value::Bool(_))
            | (Value::Colour(_), Value::Colour(_))
    )
}
