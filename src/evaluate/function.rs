//! Functions: those of the language, and those of the text.

use super::Evaluator;
use super::fields::{Arg, bare};
use super::scope::{ScopeId, What};
use super::value::{Value, Vector};
use crate::diagnostic::{Diagnostic, Span};
use crate::syntax::tree::{Argument, Expr, ExprKind, Formal, Name};
use crate::units::{Dimension, Quantity};

/// The language's own functions, with how they are called.
const OWN: &[(&str, &str)] = &[
    ("sin", "sin(ANGLE)"),
    ("cos", "cos(ANGLE)"),
    ("tan", "tan(ANGLE)"),
    ("atan2", "atan2(Y, X)"),
    ("sqrt", "sqrt(A)"),
    ("abs", "abs(A)"),
    ("min", "min(A, B, …)"),
    ("max", "max(A, B, …)"),
    ("round", "round(NUMBER) or round(A, STEP)"),
    ("mod", "mod(A, B)"),
    ("distance", "distance(P, Q)"),
    ("between", "between(P, Q, 30%)"),
    ("meet", "meet(P, ANGLE, Q, ANGLE): where two straight lines meet"),
    ("arc", "arc(RADIUS, ANGLE): length of an arc"),
    ("radius", "radius(ARC, ANGLE): radius of an arc of that length"),
    ("match", "match(NAME, OPTION: VALUE, OPTION: VALUE, …)"),
];

/// The language's own functions, each with how it is called.
pub fn functions() -> impl Iterator<Item = (&'static str, &'static str)> {
    OWN.iter().copied()
}

/// Deepest nesting of calls.
const CALLS: usize = 64;

impl<'t> Evaluator<'t> {
    pub(super) fn call(
        &mut self,
        callee: &'t Expr,
        arguments: &'t [Argument],
        scope: ScopeId,
        span: Span,
    ) -> Value {
        if let ExprKind::Member(base, name) = &callee.kind {
            let value = self.eval(base, scope);
            return self.method(value, name, arguments, scope, base.span);
        }
        let Some(name) = bare(callee) else {
            self.tell(
                Diagnostic::new("E0304", "this is no function").at(callee.span, "called here"),
            );
            return Value::Poison;
        };
        if let Some(id) = self.find(scope, &name.text) {
            if let What::Function { formals, kind, value } = self.bindings[id.0].what.clone() {
                let home = self.bindings[id.0].scope;
                self.note_use(name.span, id);
                return self.call_own(name, formals, kind, value, home, arguments, scope, span);
            }
            if !OWN.iter().any(|(own, _)| *own == name.text) {
                let found = self.binding_value(id, name.span);
                return self.wrong(&found, "a function", name.span);
            }
        }
        if name.text == super::choice::MATCH {
            return self.match_value(arguments, scope, span);
        }
        self.builtin(name, arguments, scope, span)
    }

    /// `edge.at(30%)`
    fn method(
        &mut self,
        value: Value,
        name: &'t Name,
        arguments: &'t [Argument],
        scope: ScopeId,
        at: Span,
    ) -> Value {
        match (value, name.text.as_str(), arguments) {
            (Value::Poison, ..) => Value::Poison,
            (Value::Edges(edges), "at", [argument]) => {
                let arg = Arg { expr: &argument.value, scope, of: "at" };
                self.edge_at(&edges, arg, at)
            }
            (value, ..) => {
                let found = value.describe(|id| self.item(id).kind);
                self.no_member(&found, name, ["at"].into_iter())
            }
        }
    }

    #[allow(clippy::too_many_arguments)]
    fn call_own(
        &mut self,
        name: &'t Name,
        formals: &'t [Formal],
        kind: Option<&'t Name>,
        value: &'t Expr,
        home: ScopeId,
        arguments: &'t [Argument],
        scope: ScopeId,
        span: Span,
    ) -> Value {
        if self.calling.iter().any(|called| std::ptr::eq(*called, value)) {
            self.tell(
                Diagnostic::new("E0206", format!("`{}` calls itself", name.text))
                    .at(span, "here")
                    .help("functions end; go through a range with `for` instead"),
            );
            return Value::Poison;
        }
        if self.calling.len() >= CALLS {
            self.tell(
                Diagnostic::new("E0211", "functions call each other too deep").at(span, "here"),
            );
            return Value::Poison;
        }
        if !self.step(super::CALL, span) {
            return Value::Poison;
        }
        let inner = self.new_scope(Some(home));
        let mut given: Vec<(&'t Argument, bool)> =
            arguments.iter().map(|argument| (argument, false)).collect();
        let mut sound = true;
        for (place, formal) in formals.iter().enumerate() {
            let found = given
                .iter()
                .position(|(arg, _)| arg.name.as_ref().is_some_and(|n| n.text == formal.name.text))
                .or_else(|| given.get(place).filter(|(a, _)| a.name.is_none()).map(|_| place));
            let value = match found {
                Some(place) => {
                    given[place].1 = true;
                    if let Some(said) = &given[place].0.name {
                        self.note_places(said.span, [formal.name.span]);
                    }
                    let expr = &given[place].0.value;
                    self.of_kind(Arg { expr, scope, of: &formal.name.text }, Some(&formal.kind))
                }
                None => match &formal.default {
                    Some(expr) => self.of_kind(
                        Arg { expr, scope: home, of: &formal.name.text },
                        Some(&formal.kind),
                    ),
                    None => {
                        self.tell(
                            Diagnostic::new(
                                "E0208",
                                format!("`{}` must be given `{}`", name.text, formal.name.text),
                            )
                            .at(span, "missing here")
                            .at(formal.name.span, "asked for here"),
                        );
                        sound = false;
                        Value::Poison
                    }
                },
            };
            // A formal hides nothing that the caller sees; only its home's names count.
            self.declare(inner, &formal.name.text, formal.name.span, inner, What::Given(value));
        }
        if let Some((extra, _)) = given.iter().find(|(_, used)| !used) {
            let known = formals.iter().map(|formal| formal.name.text.as_str());
            let told = match &extra.name {
                Some(unknown) => {
                    let label = self.meant(&unknown.text, known);
                    let message = format!("`{}` takes no `{}`", name.text, unknown.text);
                    Diagnostic::new("E0204", message).at(unknown.span, label)
                }
                None => {
                    let message = format!("`{}` takes {} values", name.text, formals.len());
                    Diagnostic::new("E0306", message).at(extra.value.span, "one too many")
                }
            };
            self.tell(told);
            sound = false;
        }
        if !sound {
            return Value::Poison;
        }
        self.calling.push(value);
        let result = self.of_kind(Arg { expr: value, scope: inner, of: &name.text }, kind);
        self.calling.pop();
        result
    }

    fn builtin(
        &mut self,
        name: &'t Name,
        arguments: &'t [Argument],
        scope: ScopeId,
        span: Span,
    ) -> Value {
        let Some((_, usage)) = OWN.iter().find(|(own, _)| *own == name.text) else {
            let mut known: Vec<String> = self.visible(scope);
            known.extend(OWN.iter().map(|(own, _)| (*own).to_owned()));
            let label = self.meant(&name.text, known.iter().map(String::as_str));
            let own: Vec<&str> = OWN.iter().map(|(own, _)| *own).collect();
            self.tell(
                Diagnostic::new("E0201", format!("there is no function `{}`", name.text))
                    .at(name.span, label)
                    .help(format!("the language has {}", own.join(", "))),
            );
            return Value::Poison;
        };
        if let Some(named) = arguments.iter().find_map(|argument| argument.name.as_ref()) {
            self.tell(
                Diagnostic::new("E0306", format!("`{}` has no named values", name.text))
                    .at(named.span, "here")
                    .help(*usage),
            );
            return Value::Poison;
        }
        let args: Vec<Arg<'t>> = arguments
            .iter()
            .map(|argument| Arg { expr: &argument.value, scope, of: &name.text })
            .collect();
        let wanted = match name.text.as_str() {
            "sin" | "cos" | "tan" | "sqrt" | "abs" => 1..=1,
            "round" => 1..=2,
            "min" | "max" => 1..=64,
            "between" => 3..=3,
            "meet" => 4..=4,
            _ => 2..=2,
        };
        if !wanted.contains(&args.len()) {
            self.tell(
                Diagnostic::new("E0306", format!("`{}` is not called so", name.text))
                    .at(span, format!("{} values", args.len()))
                    .help(*usage),
            );
            return Value::Poison;
        }
        self.compute(&name.text, &args, span).unwrap_or(Value::Poison)
    }

    fn compute(&mut self, name: &str, args: &[Arg<'t>], span: Span) -> Option<Value> {
        let arg = |n: usize| args.get(n).copied();
        match name {
            "sin" | "cos" | "tan" => {
                let angle = self.quantity(arg(0)?, Dimension::ANGLE)?;
                let value = match name {
                    "sin" => libm::sin(angle),
                    "cos" => libm::cos(angle),
                    _ => libm::tan(angle),
                };
                Some(self.finite(Quantity::number(value), span))
            }
            "atan2" => {
                let (y, x) = self.alike(arg(0)?, arg(1)?)?;
                let angle = libm::atan2(y.value, x.value);
                Some(Value::Quantity(Quantity::new(angle, Dimension::ANGLE)))
            }
            "sqrt" => {
                let a = self.any_quantity(arg(0)?)?;
                let Some(dimension) = a.dimension.root().filter(|_| a.value >= 0.0) else {
                    self.tell(
                        Diagnostic::new("E0310", format!("{a} has no square root"))
                            .at(arg(0)?.expr.span, self.shown(a)),
                    );
                    return None;
                };
                Some(Value::Quantity(Quantity::new(libm::sqrt(a.value), dimension)))
            }
            "abs" => {
                let a = self.any_quantity(arg(0)?)?;
                Some(Value::Quantity(Quantity { value: a.value.abs(), ..a }))
            }
            "min" | "max" => {
                let first = arg(0)?;
                let mut best = self.any_quantity(first)?;
                for other in args.iter().skip(1) {
                    let (_, next) = self.alike(first, *other)?;
                    let better = if name == "min" {
                        next.value < best.value
                    } else {
                        next.value > best.value
                    };
                    if better {
                        best = next;
                    }
                }
                Some(Value::Quantity(best))
            }
            "round" => match arg(1) {
                None => {
                    let a = self.quantity(arg(0)?, Dimension::NUMBER)?;
                    Some(Value::number(libm::round(a)))
                }
                Some(step) => {
                    let (a, step) = self.alike(arg(0)?, step)?;
                    let value = libm::round(a.value / step.value) * step.value;
                    Some(self.finite(Quantity::new(value, a.dimension), span))
                }
            },
            "mod" => {
                let (a, b) = self.alike(arg(0)?, arg(1)?)?;
                let value = a.value - b.value * libm::floor(a.value / b.value);
                Some(self.finite(Quantity::new(value, b.dimension), span))
            }
            "distance" => {
                let (p, q) = (self.point(arg(0)?)?, self.point(arg(1)?)?);
                Some(Value::length(libm::hypot(q[0] - p[0], q[1] - p[1])))
            }
            "between" => {
                let (p, q) = (self.point(arg(0)?)?, self.point(arg(1)?)?);
                let share = self.quantity(arg(2)?, Dimension::NUMBER)?;
                Some(Value::point([p[0] + (q[0] - p[0]) * share, p[1] + (q[1] - p[1]) * share]))
            }
            "meet" => {
                let (p, q) = (self.point(arg(0)?)?, self.point(arg(2)?)?);
                let a = self.quantity(arg(1)?, Dimension::ANGLE)?;
                let b = self.quantity(arg(3)?, Dimension::ANGLE)?;
                let (u, v) = ([libm::cos(a), libm::sin(a)], [libm::cos(b), libm::sin(b)]);
                let cross = u[0] * v[1] - u[1] * v[0];
                if cross.abs() < 1e-9 {
                    self.tell(
                        Diagnostic::new("E0310", "these lines do not meet")
                            .at(span, "they run side by side"),
                    );
                    return None;
                }
                let t = ((q[0] - p[0]) * v[1] - (q[1] - p[1]) * v[0]) / cross;
                Some(Value::Vector(Vector {
                    dimension: Dimension::LENGTH,
                    parts: vec![p[0] + t * u[0], p[1] + t * u[1]],
                }))
            }
            "arc" => {
                let radius = self.quantity(arg(0)?, Dimension::LENGTH)?;
                let angle = self.quantity(arg(1)?, Dimension::ANGLE)?;
                Some(self.finite(Quantity::length(radius * angle), span))
            }
            "radius" => {
                let arc = self.quantity(arg(0)?, Dimension::LENGTH)?;
                let angle = self.quantity(arg(1)?, Dimension::ANGLE)?;
                Some(self.finite(Quantity::length(arc / angle), span))
            }
            _ => None,
        }
    }

    /// Two quantities of one dimension.
    fn alike(&mut self, a: Arg<'t>, b: Arg<'t>) -> Option<(Quantity, Quantity)> {
        let first = self.any_quantity(a)?;
        let second = self.any_quantity(b)?;
        if first.fits(second.dimension) || second.fits(first.dimension) {
            return Some((first, second));
        }
        self.tell(
            Diagnostic::new(
                "E0301",
                format!(
                    "{} and {} do not go together in `{}`",
                    first.dimension.name(),
                    second.dimension.name(),
                    a.of
                ),
            )
            .at(a.expr.span, self.shown(first))
            .at(b.expr.span, self.shown(second)),
        );
        None
    }
}
