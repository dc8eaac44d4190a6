//! What is held and what is checked: `attach`, `pin`, `fix`, `check`.

use super::Evaluator;
use super::fields::{Arg, Fields, Phrase};
use super::garment::Making;
use super::panel::edge::Mark;
use super::value::Value;
use crate::diagnostic::Diagnostic;
use crate::garment::seam::{Attachment, PanelRun, Pin, PinTarget, Pinned};
use crate::syntax::tree::{BinaryOp, ExprKind};
use crate::units;

impl<'t> Evaluator<'t> {
    /// `attach`, `pin` and `fix`.
    pub(super) fn holds(&mut self, fields: &Fields<'t>, making: &mut Making) {
        for phrase in fields.all("attach") {
            let Some(to) = phrase.value("to") else { continue };
            let Some(mark) = self.landmark(to) else { continue };
            let Some(&body) = making.bodies.get(&mark.wearer) else { continue };
            let mut runs = Vec::new();
            for arg in phrase.args() {
                runs.extend(self.held_runs(arg, making).unwrap_or_default());
            }
            if !runs.is_empty() {
                making.garment.attachments.push(Attachment {
                    span: phrase.span,
                    runs,
                    body,
                    landmark: mark.name,
                });
            }
        }
        let held: Vec<&Phrase<'t>> = fields
            .phrases
            .iter()
            .filter(|phrase| matches!(phrase.word.name, "pin" | "fix"))
            .collect();
        for phrase in held {
            let Some(to) = self.pin_target(phrase, making) else { continue };
            for arg in phrase.args() {
                let value = self.eval(arg.expr, arg.scope);
                let what = match value {
                    Value::Mark(Mark { draft, piece, at }) => {
                        let panel = making.numbers.get(&(draft.item, piece)).copied();
                        panel.map(|panel| Pinned::Point { panel, at })
                    }
                    _ => self.held_runs(arg, making).map(Pinned::Runs),
                };
                if let Some(what) = what {
                    making.garment.pins.push(Pin { span: phrase.span, what, to: to.clone() });
                }
            }
        }
    }

    fn pin_target(&mut self, phrase: &Phrase<'t>, making: &Making) -> Option<PinTarget> {
        let Some(arg) = phrase.value("at") else { return Some(PinTarget::Here) };
        match self.eval(arg.expr, arg.scope) {
            Value::Measure { .. } => {
                let mark = self.landmark(arg)?;
                let body = *making.bodies.get(&mark.wearer)?;
                Some(PinTarget::Landmark { body, name: mark.name })
            }
            Value::Poison => None,
            _ => self.place_in_space(arg).map(PinTarget::Place),
        }
    }

    /// The runs of the edges named where something is held.
    pub(super) fn held_runs(&mut self, arg: Arg<'t>, making: &Making) -> Option<Vec<PanelRun>> {
        let value = self.eval(arg.expr, arg.scope);
        let edges = match value {
            Value::Poison => return None,
            Value::Edges(edges) => edges,
            other => {
                let edge = match &other {
                    Value::Item(id) | Value::Half(id, _) => {
                        making.drafts.get(id).and_then(|draft| {
                            let edge = draft.edge_names().first().copied()?;
                            Some(format!("{}.{edge}", draft.name))
                        })
                    }
                    _ => None,
                };
                let found = other.describe(|id| self.item(id).kind);
                let text = self.snippet(arg.expr.span).to_owned();
                let mut told = Diagnostic::new(
                    "E0304",
                    format!("`{text}` is {found}; `{}` wants edges", arg.of),
                )
                .at(arg.expr.span, "here");
                if let Some(edge) = edge {
                    told = told.help(format!("such as `{edge}`"));
                }
                self.tell(told);
                return None;
            }
        };
        if !self.all_on_rim(&edges, arg) {
            return None;
        }
        let mut runs = Vec::new();
        for edge in &edges {
            for found in edge.find() {
                if let Some(&panel) = making.numbers.get(&(edge.draft.item, found.piece)) {
                    runs.extend(edge.runs(&found).into_iter().map(|run| PanelRun { panel, run }));
                }
            }
        }
        Some(runs)
    }

    /// `check A = B within L`, `check A < B`
    pub(super) fn checks(&mut self, fields: &Fields<'t>) {
        for phrase in fields.all("check") {
            self.within = Some((phrase.scope, self.waiting.len()));
            let Some(left) = phrase.arg(0) else { continue };
            let Some(right) = phrase.value("=") else {
                if self.condition(left) == Some(false) {
                    self.tell_failed(Diagnostic::new("E0806", "check failed"), left);
                }
                continue;
            };
            let (Some(a), Some(b)) = (self.any_quantity(left), self.any_quantity(right)) else {
                continue;
            };
            if !a.fits(b.dimension) && !b.fits(a.dimension) {
                self.tell(
                    Diagnostic::new(
                        "E0301",
                        format!(
                            "{} and {} cannot be compared",
                            a.dimension.name(),
                            b.dimension.name()
                        ),
                    )
                    .at(left.expr.span, self.shown(a))
                    .at(right.expr.span, self.shown(b)),
                );
                continue;
            }
            let slack = match phrase.value("within") {
                Some(arg) => self.quantity(arg, a.dimension),
                None => Some(1e-9 * (a.value.abs() + b.value.abs())),
            };
            let Some(slack) = slack else { continue };
            if (a.value - b.value).abs() > slack {
                let within = match phrase.says("within") {
                    true => format!(" within {}", units::Quantity::new(slack, a.dimension)),
                    false => String::new(),
                };
                self.tell(
                    Diagnostic::new("E0806", format!("check failed: {a} is not {b}{within}"))
                        .at(left.expr.span, a.to_string())
                        .at(right.expr.span, b.to_string()),
                );
            }
        }
    }

    /// `require A < B because "…"`
    pub(super) fn requirements(&mut self, fields: &Fields<'t>) {
        for phrase in fields.all("require") {
            self.within = Some((phrase.scope, self.waiting.len()));
            let Some(condition) = phrase.arg(0) else { continue };
            let because = phrase.value("because");
            if self.condition(condition) != Some(false) {
                continue;
            }
            let reason = because.map(|arg| (self.eval(arg.expr, arg.scope), arg.expr.span));
            let message = match reason {
                Some((Value::Text(text), _)) => text,
                Some((other, span)) => {
                    self.wrong(&other, "a text", span);
                    continue;
                }
                None => "this must hold, and does not".to_owned(),
            };
            self.tell_failed(Diagnostic::new("E0807", message), condition);
        }
        self.within = None;
    }

    /// Tells a condition that does not hold, with what its two sides are worth.
    fn tell_failed(&mut self, mut told: Diagnostic, mut check: Arg<'t>) {
        // Of several conditions the first that does not hold is shown.
        while let ExprKind::Binary { op: BinaryOp::And, left, right, .. } = &check.expr.kind {
            let first = Arg { expr: left, ..check };
            let failed = if self.condition(first) == Some(false) { left } else { right };
            check = Arg { expr: failed, ..check };
        }
        if let ExprKind::Binary { op, left, right, .. } = &check.expr.kind
            && !matches!(op, BinaryOp::And | BinaryOp::Or)
        {
            for side in [left, right] {
                let worth = match self.eval(side, check.scope) {
                    Value::Text(text) => Some(text),
                    Value::Word(chosen) => Some(chosen.word.clone()),
                    value @ (Value::Quantity(_) | Value::Measure { .. }) => {
                        self.as_quantity(value, side.span).map(|worth| worth.to_string())
                    }
                    _ => None,
                };
                if let Some(worth) = worth {
                    told = told.at(side.span, worth);
                }
            }
        }
        if told.labels.is_empty() {
            told = told.at(check.expr.span, "this does not hold");
        }
        self.tell(told);
    }
}
