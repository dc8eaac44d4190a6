//! Expressions: names, numbers, points, choices, members.

use super::Evaluator;
use super::fields::{Arg, bare};
use super::scope::{ScopeId, What};
use super::value::{LARGEST, Value, Vector};
use super::words::Kind;
use crate::diagnostic::{Diagnostic, Span, either, spelling};
use crate::syntax::tree::{Expr, ExprKind, Name, UnaryOp};
use crate::textile::Colour;
use crate::units::{self, Dimension, Quantity};

/// Names of the library that a message lists at most.
const LISTED: usize = 32;

impl<'t> Evaluator<'t> {
    /// What an expression is worth. What is wrong in it is told; its value is then
    /// [`Value::Poison`].
    pub fn eval(&mut self, expr: &'t Expr, scope: ScopeId) -> Value {
        if !self.step(1, expr.span) {
            return Value::Poison;
        }
        let value = self.deeper(expr.span, |ev| ev.eval_kind(expr, scope));
        let value = self.bounded(value, expr.span);
        self.note_value(expr, scope, &value);
        value
    }

    /// A value, unless it is made of too many: values made of values double with every line. What
    /// is large takes its time to be handed on, so it counts as more steps.
    fn bounded(&mut self, value: Value, span: Span) -> Value {
        let bulk = match &value {
            Value::List(_) | Value::Record(_) | Value::Text(_) | Value::Edges(_) => {
                value.bulk(LARGEST + 1)
            }
            _ => return value,
        };
        if bulk > LARGEST {
            let title = value.describe(|id| self.item(id).kind);
            self.tell(
                Diagnostic::new("E0213", format!("{title} that is too large"))
                    .at(span, format!("more than {LARGEST} values"))
                    .help("values that are made of values grow fast; keep less in them"),
            );
            return Value::Poison;
        }
        if self.step(bulk as u64 / 8, span) { value } else { Value::Poison }
    }

    /// Whether a name stands for anything, here or in the library.
    pub fn knows(&self, name: &str, scope: ScopeId) -> bool {
        let library =
            |id: &ScopeId| self.scopes.get(id.0).is_some_and(|it| it.names.contains_key(name));
        self.find(scope, name).is_some() || self.libraries.values().any(library)
    }

    /// As [`Self::eval`]; a name that nobody declared is looked up in these library modules.
    pub fn eval_with(&mut self, arg: Arg<'t>, libraries: &[&str]) -> Value {
        let Some(name) = bare(arg.expr) else { return self.eval(arg.expr, arg.scope) };
        if let Some(id) = self.find(arg.scope, &name.text) {
            self.note_use(name.span, id);
            return self.binding_value(id, name.span);
        }
        for library in libraries {
            let found = self
                .libraries
                .get(*library)
                .and_then(|scope| self.scopes.get(scope.0))
                .and_then(|scope| scope.names.get(&name.text));
            if let Some(&id) = found {
                self.note_use(name.span, id);
                return self.binding_value(id, name.span);
            }
        }
        // A thing of another kind is told better by who wanted it: `silk` is a fabric.
        let elsewhere = self
            .libraries
            .values()
            .find_map(|scope| self.scopes.get(scope.0)?.names.get(&name.text).copied());
        if let Some(id) = elsewhere {
            self.note_use(name.span, id);
            return self.binding_value(id, name.span);
        }
        let mut own: Vec<String> = Vec::new();
        for library in libraries {
            if let Some(scope) = self.libraries.get(*library).and_then(|id| self.scopes.get(id.0)) {
                own.extend(scope.names.keys().cloned());
            }
        }
        let list = own.join(", ");
        let mut known = self.visible(arg.scope);
        let listed = !own.is_empty() && own.len() <= LISTED;
        known.append(&mut own);
        let near = spelling::nearest(&name.text, known.iter().map(String::as_str));
        let help = (listed && near.is_none()).then(|| format!("the library has {list}"));
        self.tell_unknown(name, &known, help);
        Value::Poison
    }

    fn tell_unknown(&mut self, name: &Name, known: &[String], help: Option<String>) {
        let message = format!("nothing here is called `{}`", name.text);
        // What was meant is looked for once, not in every turn of a loop.
        if self.was_told("E0201", name.span, &message) {
            return;
        }
        let near = spelling::nearest(&name.text, known.iter().map(String::as_str));
        if self.blind && near.is_none() {
            return;
        }
        let label = self.meant(&name.text, known.iter().map(String::as_str));
        let mut told = Diagnostic::new("E0201", message).at(name.span, label);
        told.help = help;
        self.tell(told);
    }

    /// Whether a value is a name that nobody declared, where besides values some words are
    /// allowed, which is told.
    pub(super) fn unknown_word(&mut self, arg: Arg<'t>, words: &[&str]) -> bool {
        let Some(name) = bare(arg.expr) else { return false };
        if self.find(arg.scope, &name.text).is_some() {
            return false;
        }
        let mut known: Vec<String> = words.iter().map(|word| (*word).to_owned()).collect();
        known.extend(self.visible(arg.scope));
        let words: Vec<String> = words.iter().map(|word| format!("`{word}`")).collect();
        let help = format!("besides values `{}` takes {}", arg.of, either(&words));
        self.tell_unknown(name, &known, Some(help));
        true
    }

    fn eval_kind(&mut self, expr: &'t Expr, scope: ScopeId) -> Value {
        match &expr.kind {
            ExprKind::Unread => Value::Poison,
            ExprKind::Number { value, unit } => self.literal(*value, unit.as_ref(), expr.span),
            ExprKind::Colour(parts) => Value::Colour(Colour(*parts)),
            ExprKind::Text(text) => self.filled(text, scope, expr.span),
            ExprKind::Group(inner) => self.eval(inner, scope),
            ExprKind::Point(parts) => self.vector(parts, scope, expr.span),
            ExprKind::List(parts) => {
                Value::List(parts.iter().map(|part| self.eval(part, scope)).collect())
            }
            ExprKind::Record(fields) => self.record(fields, scope),
            ExprKind::Choice { condition, then, otherwise } => {
                let arg = Arg { expr: condition, scope, of: "if" };
                match self.condition(arg) {
                    Some(true) => self.eval(then, scope),
                    Some(false) => self.eval(otherwise, scope),
                    None => Value::Poison,
                }
            }
            ExprKind::Path(names) => self.path(names, scope),
            ExprKind::Member(base, name) => {
                let value = self.eval(base, scope);
                self.member(value, name, base.span)
            }
            ExprKind::Within(base, inner) => {
                let value = self.eval(base, scope);
                self.within(&value, inner, base.span)
            }
            ExprKind::Call(callee, arguments) => self.call(callee, arguments, scope, expr.span),
            ExprKind::Index(base, numbers, from) => {
                self.index(base, numbers, from.as_ref(), scope, expr.span)
            }
            ExprKind::Unary(op, inner) => {
                let value = self.eval(inner, scope);
                match op {
                    UnaryOp::Minus => self.negated(value, inner.span),
                    UnaryOp::Not => match value {
                        Value::Poison => Value::Poison,
                        Value::Bool(yes) => Value::Bool(!yes),
                        other => self.wrong(&other, "a yes or no", inner.span),
                    },
                }
            }
            ExprKind::Binary { op, op_span, left, right } => {
                self.binary(*op, *op_span, left, right, scope)
            }
        }
    }

    /// A number with its unit.
    fn literal(&mut self, number: f64, unit: Option<&Name>, span: Span) -> Value {
        let Some(name) = unit else {
            return self.finite(Quantity::number(number), span);
        };
        match units::unit(&name.text) {
            Ok(unit) => match unit.quantity(number) {
                Some(quantity) => Value::Quantity(quantity),
                None => {
                    self.tell(
                        Diagnostic::new("E0310", "this number is too large, or none at all")
                            .at(span, "here"),
                    );
                    Value::Poison
                }
            },
            Err(part) => {
                let label = self.meant(&part, units::known());
                // `600/n`: a quotient written as `600/m` is.
                let help = match name.text.strip_prefix('/') {
                    Some(divisor) => format!(
                        "`/` against a number begins a unit; a quotient stands between blanks, `… / {divisor}`"
                    ),
                    None => {
                        "lengths are `mm`, `cm`, `m`, `in`; angles `deg`; masses per area `g/m2`"
                            .to_owned()
                    }
                };
                self.tell(
                    Diagnostic::new("E0307", format!("there is no unit `{part}`"))
                        .at(name.span, label)
                        .help(help),
                );
                Value::Poison
            }
        }
    }

    /// A quantity, unless it has no finite value.
    pub(super) fn finite(&mut self, quantity: Quantity, span: Span) -> Value {
        if quantity.value.is_finite() {
            return Value::Quantity(quantity);
        }
        self.tell(
            Diagnostic::new("E0310", "this has no finite value")
                .at(span, "divided by nothing, or far too large"),
        );
        Value::Poison
    }

    /// `(a, b)`: parts of one dimension.
    fn vector(&mut self, parts: &'t [Expr], scope: ScopeId, span: Span) -> Value {
        let mut quantities: Vec<(Quantity, Span)> = Vec::with_capacity(parts.len());
        for part in parts {
            let value = self.eval(part, scope);
            match self.as_quantity(value, part.span) {
                Some(quantity) => quantities.push((quantity, part.span)),
                None => return Value::Poison,
            }
        }
        if quantities.len() > 3 {
            self.tell(
                Diagnostic::new("E0306", format!("a point has no {} parts", quantities.len()))
                    .at(span, "two or three are wanted"),
            );
            return Value::Poison;
        }
        let first = quantities.iter().find(|(q, _)| !q.fits(Dimension::NUMBER) || q.value != 0.0);
        let dimension = first.map_or(Dimension::NUMBER, |(q, _)| q.dimension);
        if let Some((odd, at)) = quantities.iter().find(|(q, _)| !q.fits(dimension)) {
            let (first, first_at) = first.copied().unwrap_or((*odd, *at));
            self.tell(
                Diagnostic::new(
                    "E0301",
                    format!(
                        "{} and {} do not make a point",
                        first.dimension.name(),
                        odd.dimension.name()
                    ),
                )
                .at(*at, self.shown(*odd))
                .at(first_at, self.shown(first)),
            );
            return Value::Poison;
        }
        let parts = quantities.iter().map(|(quantity, _)| quantity.value).collect();
        Value::Vector(Vector { dimension, parts })
    }

    /// A quantity with its kind, for a label: `length, 18.5 cm`.
    pub(super) fn shown(&self, quantity: Quantity) -> String {
        if quantity.dimension.is_number() {
            return format!("{quantity} has no unit");
        }
        let name = quantity.dimension.name();
        let noun = name.split_once(' ').map_or(name, |(_, noun)| noun);
        format!("{noun}, {quantity}")
    }

    fn path(&mut self, names: &'t [Name], scope: ScopeId) -> Value {
        match names {
            [name] => match self.find(scope, &name.text) {
                Some(id) => {
                    self.note_use(name.span, id);
                    self.binding_value(id, name.span)
                }
                None => {
                    let known = self.visible(scope);
                    self.tell_unknown(name, &known, None);
                    Value::Poison
                }
            },
            [library, module, name] if library.text == "std" => {
                let path = format!("std::{}", module.text);
                let Some(&inner) = self.libraries.get(&path) else {
                    let known: Vec<String> = self.libraries.keys().cloned().collect();
                    let label = self.meant(&path, known.iter().map(String::as_str));
                    self.tell(
                        Diagnostic::new("E0901", format!("there is no `{path}`"))
                            .at(module.span, label),
                    );
                    return Value::Poison;
                };
                match self.find(inner, &name.text) {
                    Some(id) => {
                        self.note_use(name.span, id);
                        self.binding_value(id, name.span)
                    }
                    None => {
                        let known = self.visible(inner);
                        let label = self.meant(&name.text, known.iter().map(String::as_str));
                        self.tell(
                            Diagnostic::new("E0901", format!("`{path}` has no `{}`", name.text))
                                .at(name.span, label),
                        );
                        Value::Poison
                    }
                }
            }
            _ => {
                let span = names.iter().fold(None, |whole: Option<Span>, name| {
                    Some(whole.map_or(name.span, |span| span.to(name.span)))
                });
                if let Some(span) = span {
                    self.tell(
                        Diagnostic::new("E0901", "this path leads nowhere")
                            .at(span, "not found")
                            .help("such as `std::fabric::denim`"),
                    );
                }
                Value::Poison
            }
        }
    }

    /// `value.name`
    pub(super) fn member(&mut self, value: Value, name: &'t Name, at: Span) -> Value {
        match value {
            Value::Poison => Value::Poison,
            Value::Vector(vector) => {
                let place = ["x", "y", "z"].iter().position(|axis| *axis == name.text);
                match place.and_then(|place| vector.parts.get(place)) {
                    Some(&part) => Value::Quantity(Quantity::new(part, vector.dimension)),
                    None => {
                        let axes = if vector.parts.len() == 3 { "x, y, z" } else { "x, y" };
                        self.no_member("a point", name, axes.split(", "))
                    }
                }
            }
            Value::Mark(mark) => match name.text.as_str() {
                "x" => Value::length(mark.at[0]),
                "y" => Value::length(mark.at[1]),
                _ => self.no_member("a place on a panel", name, ["x", "y"].into_iter()),
            },
            Value::Item(id) => match self.item(id).kind {
                Kind::Wearer => self.measure(id, name),
                Kind::Panel | Kind::Cloth => self.panel_member(id, None, name, at),
                Kind::Part => self.part_member(id, name, at),
                kind => {
                    let title = format!("{} `{}`", kind.noun(), self.item(id).name);
                    self.no_member(&title, name, std::iter::empty())
                }
            },
            Value::Items(ids) => self.members_of_panels(&ids, name, at),
            Value::Half(id, which) => self.panel_member(id, Some(which), name, at),
            Value::Edges(edges) => self.edge_member(edges, name, at),
            Value::List(values) => match name.text.as_str() {
                "count" => Value::number(values.len() as f64),
                _ => self.no_member("a list", name, ["count"].into_iter()),
            },
            Value::Record(fields) => self.field(&fields, name),
            Value::Measure { wearer, name: measure } => {
                // `lady.knee.left` is the same as `lady.left_knee`.
                self.measure_member(wearer, &measure, name)
            }
            other => {
                let found = other.describe(|id| self.item(id).kind);
                self.no_member(&found, name, std::iter::empty())
            }
        }
    }

    /// Tells that something has no such member (E0204).
    pub(super) fn no_member<'a>(
        &mut self,
        of: &str,
        name: &Name,
        known: impl Iterator<Item = &'a str>,
    ) -> Value {
        let known: Vec<&str> = known.collect();
        let label = self.meant(&name.text, known.iter().copied());
        let mut told =
            Diagnostic::new("E0204", format!("{of} has no `{}`", name.text)).at(name.span, label);
        if !known.is_empty() && known.len() <= 24 {
            told = told.help(format!("it has {}", known.join(", ")));
        }
        self.tell(told);
        Value::Poison
    }

    /// Tells that a value is not of the wanted kind (E0304).
    pub(super) fn wrong(&mut self, value: &Value, wanted: &str, span: Span) -> Value {
        if *value != Value::Poison {
            let found = value.describe(|id| self.item(id).kind);
            let text = self.snippet(span);
            let message = if text.is_empty() || text.len() > 60 || text.contains('\n') {
                format!("{wanted} is wanted, this is {found}")
            } else {
                format!("`{text}` is {found}")
            };
            self.tell(Diagnostic::new("E0304", message).at(span, format!("{wanted} is wanted")));
        }
        Value::Poison
    }

    /// `base[…]`: an item by its number, a part of an edge, a value of a list.
    fn index(
        &mut self,
        base: &'t Expr,
        numbers: &'t [Expr],
        from: Option<&'t Name>,
        scope: ScopeId,
        span: Span,
    ) -> Value {
        if let Some(name) = bare(base) {
            let family =
                self.find(scope, &name.text).and_then(|id| match &self.bindings[id.0].what {
                    What::Family(members) => Some((id, members.clone())),
                    _ => None,
                });
            if let Some((id, members)) = family {
                self.note_use(name.span, id);
                return self.family_members(name, &members, numbers, scope);
            }
        }
        if let Some((name, members)) = self.part_family(base, scope) {
            return self.family_members(name, &members, numbers, scope);
        }
        let value = self.eval(base, scope);
        let [number] = numbers else {
            return match value {
                Value::Poison => Value::Poison,
                _ => {
                    self.tell(
                        Diagnostic::new("E0306", "one number or range is wanted in `[ ]`")
                            .at(span, "here"),
                    );
                    Value::Poison
                }
            };
        };
        match value {
            Value::Poison => Value::Poison,
            Value::Edges(edges) => self.edge_part(edges, number, from, scope, span),
            Value::List(values) => {
                let arg = Arg { expr: number, scope, of: "a place in a list" };
                let Some(place) = self.whole_number(arg, 1, values.len() as i64) else {
                    return Value::Poison;
                };
                usize::try_from(place - 1)
                    .ok()
                    .and_then(|place| values.get(place).cloned())
                    .unwrap_or(Value::Poison)
            }
            other => self.wrong(&other, "an edge, a list or numbered panels", base.span),
        }
    }
}
