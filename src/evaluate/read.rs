//! Values where something of a kind is wanted: quantities, points, words, colours.

use super::Evaluator;
use super::fields::{Arg, bare};
use super::value::Value;
use crate::diagnostic::Diagnostic;
use crate::syntax::tree::{ExprKind, Name};
use crate::textile::Colour;
use crate::units::{Dimension, Quantity};

/// Kinds that `param a: kind` and functions name, with their dimensions.
const KINDS: &[(&str, Option<Dimension>)] = &[
    ("number", Some(Dimension::NUMBER)),
    ("length", Some(Dimension::LENGTH)),
    ("angle", Some(Dimension::ANGLE)),
    ("area", Some(Dimension::AREA)),
    ("time", Some(Dimension::TIME)),
    ("speed", Some(Dimension::SPEED)),
    ("mass", Some(Dimension::MASS)),
    ("point", None),
    ("bool", None),
    ("text", None),
    ("colour", None),
    ("color", None),
    ("edge", None),
    ("record", None),
];

/// Kinds of value that `param a: kind` and functions name.
pub fn kinds() -> impl Iterator<Item = &'static str> {
    KINDS.iter().map(|(kind, _)| *kind)
}

impl<'t> Evaluator<'t> {
    /// A quantity of the wanted dimension, in SI units; anything else is told (E0302, E0304).
    pub fn quantity(&mut self, arg: Arg<'t>, wanted: Dimension) -> Option<f64> {
        let found = self.any_quantity(arg)?;
        if found.fits(wanted) {
            return Some(found.value);
        }
        self.tell_dimension(arg, found, wanted);
        None
    }

    /// A quantity of one of several dimensions.
    pub fn quantity_of(&mut self, arg: Arg<'t>, wanted: &[Dimension]) -> Option<Quantity> {
        let found = self.any_quantity(arg)?;
        if wanted.iter().any(|dimension| found.fits(*dimension)) {
            return Some(found);
        }
        self.tell_dimension(arg, found, wanted.first().copied().unwrap_or_default());
        None
    }

    fn tell_dimension(&mut self, arg: Arg<'t>, found: Quantity, wanted: Dimension) {
        let text = self.snippet(arg.expr.span).to_owned();
        let written = if text.is_empty() { found.to_string() } else { text };
        let message = if found.dimension.is_number() {
            format!("`{}` wants {}; `{written}` has no unit", arg.of, wanted.name())
        } else {
            format!(
                "`{}` wants {}; `{written}` is {}",
                arg.of,
                wanted.name(),
                found.dimension.name()
            )
        };
        let mut told = Diagnostic::new("E0302", message)
            .at(arg.expr.span, format!("{} is wanted", wanted.name()));
        if wanted == Dimension::BENDING && found.dimension == Dimension::COUNT {
            told = told.help("`Nm` is the metric yarn count; newton metre is `N.m`");
        } else if !wanted.example().is_empty() {
            told = told.help(format!("such as {}", wanted.example()));
        }
        self.tell(told);
    }

    /// Any quantity.
    pub fn any_quantity(&mut self, arg: Arg<'t>) -> Option<Quantity> {
        let value = self.eval(arg.expr, arg.scope);
        self.as_quantity(value, arg.expr.span)
    }

    /// A quantity greater than zero.
    pub fn positive(&mut self, arg: Arg<'t>, wanted: Dimension) -> Option<f64> {
        self.within_range(arg, wanted, f64::MIN_POSITIVE, f64::MAX)
    }

    /// A quantity from `low` to `high`, both included.
    pub fn within_range(
        &mut self,
        arg: Arg<'t>,
        wanted: Dimension,
        low: f64,
        high: f64,
    ) -> Option<f64> {
        let value = self.quantity(arg, wanted)?;
        if (low..=high).contains(&value) {
            return Some(value);
        }
        let shown = |value: f64| Quantity::new(value, wanted).to_string();
        let allowed = if low == f64::MIN_POSITIVE && high == f64::MAX {
            "it must be more than 0".to_owned()
        } else if high == f64::MAX {
            format!("it must be at least {}", shown(low))
        } else if low == f64::MIN_POSITIVE {
            format!("more than 0 and at most {} are allowed", shown(high))
        } else {
            format!("{} to {} are allowed", shown(low), shown(high))
        };
        self.tell(
            Diagnostic::new("E0303", format!("`{}` is {}; {allowed}", arg.of, shown(value)))
                .at(arg.expr.span, "here"),
        );
        None
    }

    /// A whole number from `low` to `high`.
    pub fn whole_number(&mut self, arg: Arg<'t>, low: i64, high: i64) -> Option<i64> {
        let value = self.quantity(arg, Dimension::NUMBER)?;
        if value.fract() != 0.0 {
            self.tell(
                Diagnostic::new("E0303", format!("{value} is not a whole number"))
                    .at(arg.expr.span, "a whole number is wanted"),
            );
            return None;
        }
        if value < low as f64 || value > high as f64 {
            let allowed = if high < low {
                "there is none".to_owned()
            } else {
                format!("{low} to {high} are allowed")
            };
            self.tell(
                Diagnostic::new("E0303", format!("{value} is out of range"))
                    .at(arg.expr.span, allowed),
            );
            return None;
        }
        Some(value as i64)
    }

    /// A point of the drawing, m.
    pub fn point(&mut self, arg: Arg<'t>) -> Option<[f64; 2]> {
        let parts = self.vector_of(arg, Dimension::LENGTH, 2)?;
        Some([*parts.first()?, *parts.get(1)?])
    }

    /// A place in the world, m.
    pub fn place_in_space(&mut self, arg: Arg<'t>) -> Option<[f64; 3]> {
        let parts = self.vector_of(arg, Dimension::LENGTH, 3)?;
        Some([*parts.first()?, *parts.get(1)?, *parts.get(2)?])
    }

    /// Turns about x, y, z, rad.
    pub fn turns_in_space(&mut self, arg: Arg<'t>) -> Option<[f64; 3]> {
        let parts = self.vector_of(arg, Dimension::ANGLE, 3)?;
        Some([*parts.first()?, *parts.get(1)?, *parts.get(2)?])
    }

    /// A particle of a grid: column and row, counted from the lower left corner.
    pub fn particle(&mut self, arg: Arg<'t>) -> Option<[i32; 2]> {
        let parts = self.vector_of(arg, Dimension::NUMBER, 2)?;
        let mut node = [0; 2];
        for (number, part) in node.iter_mut().zip(&parts) {
            if part.fract() != 0.0 || part.abs() > 1e6 {
                self.tell(
                    Diagnostic::new("E0303", "particles are counted in whole numbers")
                        .at(arg.expr.span, "column and row, such as `(3, 20)`"),
                );
                return None;
            }
            *number = *part as i32;
        }
        Some(node)
    }

    fn vector_of(&mut self, arg: Arg<'t>, wanted: Dimension, count: usize) -> Option<Vec<f64>> {
        let value = self.eval(arg.expr, arg.scope);
        let (dimension, parts) = match value {
            Value::Poison => return None,
            Value::Vector(vector) if vector.fits(wanted) => (wanted, vector.parts),
            Value::Vector(vector) => (vector.dimension, vector.parts),
            Value::Mark(mark) => (Dimension::LENGTH, mark.at.to_vec()),
            other => {
                let title = if count == 2 { "a point" } else { "a place `(x, y, z)`" };
                self.wrong(&other, title, arg.expr.span);
                return None;
            }
        };
        if dimension != wanted {
            let first = Quantity::new(parts.first().copied().unwrap_or(0.0), dimension);
            self.tell_dimension(arg, first, wanted);
            return None;
        }
        if parts.len() != count {
            self.tell(
                Diagnostic::new(
                    "E0306",
                    format!("`{}` wants {count} parts, here are {}", arg.of, parts.len()),
                )
                .at(arg.expr.span, "here")
                .help(if count == 3 {
                    "places in space are `(x, y, z)`: x to the wearer's left, y up, z to the viewer"
                } else {
                    "points of the drawing are `(x, y)`"
                }),
            );
            return None;
        }
        Some(parts)
    }

    /// Yes or no.
    pub fn condition(&mut self, arg: Arg<'t>) -> Option<bool> {
        match self.eval(arg.expr, arg.scope) {
            Value::Poison => None,
            Value::Bool(yes) => Some(yes),
            other => {
                self.wrong(&other, "a yes or no", arg.expr.span);
                None
            }
        }
    }

    /// A colour: one of the text's, or a name of `std::color`, or the colour of a yarn.
    pub fn colour(&mut self, arg: Arg<'t>) -> Option<Colour> {
        match self.eval_with(arg, &["std::color", "std::yarn"]) {
            Value::Poison => None,
            Value::Colour(colour) => Some(colour),
            Value::Item(id) => match self.make(id, arg.expr.span)? {
                super::item::Made::Yarn(yarn) => Some(yarn.colour),
                _ => {
                    self.wrong(&Value::Item(id), "a colour or a yarn", arg.expr.span);
                    None
                }
            },
            other => {
                self.wrong(&other, "a colour", arg.expr.span);
                None
            }
        }
    }

    /// A bare name, not looked up.
    pub fn name_of(&mut self, arg: Arg<'t>) -> Option<&'t Name> {
        let found = bare(arg.expr);
        if found.is_none() && !matches!(arg.expr.kind, ExprKind::Unread) {
            self.tell(
                Diagnostic::new("E0201", format!("`{}` wants a name", arg.of))
                    .at(arg.expr.span, "this is no name"),
            );
        }
        found
    }

    /// A value of a kind that the text names (`length`, `angle`, `point`, …).
    pub(super) fn of_kind(&mut self, arg: Arg<'t>, kind: Option<&'t Name>) -> Value {
        let value = self.eval(arg.expr, arg.scope);
        let Some(kind) = kind else { return value };
        let Some((_, dimension)) = KINDS.iter().find(|(name, _)| *name == kind.text) else {
            let label = self.meant(&kind.text, KINDS.iter().map(|(name, _)| *name));
            self.tell(
                Diagnostic::new("E0201", format!("there is no kind `{}`", kind.text))
                    .at(kind.span, label),
            );
            return Value::Poison;
        };
        match (dimension, value) {
            (_, Value::Poison) => Value::Poison,
            (Some(dimension), value) => match self.as_quantity(value, arg.expr.span) {
                Some(quantity) if quantity.fits(*dimension) => {
                    Value::Quantity(Quantity::new(quantity.value, *dimension))
                }
                Some(quantity) => {
                    self.tell_dimension(arg, quantity, *dimension);
                    Value::Poison
                }
                None => Value::Poison,
            },
            (None, value) => {
                let fits = matches!(
                    (kind.text.as_str(), &value),
                    ("point", Value::Vector(_) | Value::Mark(_))
                        | ("bool", Value::Bool(_))
                        | ("text", Value::Text(_))
                        | ("colour" | "color", Value::Colour(_))
                        | ("edge", Value::Edges(_))
                        | ("record", Value::Record(_))
                );
                if fits {
                    value
                } else {
                    self.wrong(&value, &kind_title(&kind.text), arg.expr.span)
                }
            }
        }
    }
}

/// A kind with its article, for messages: `a length`.
pub(super) fn kind_title(kind: &str) -> String {
    let dimension = KINDS.iter().find(|(name, _)| *name == kind).and_then(|(_, found)| *found);
    match (dimension, kind) {
        (Some(dimension), _) => dimension.name().to_owned(),
        (None, "bool") => "a yes or no".to_owned(),
        (None, "edge") => "an edge".to_owned(),
        (None, kind) => format!("a {kind}"),
    }
}
