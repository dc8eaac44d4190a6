//! `fit`: the value of a name that makes two lengths equal, found by the ITP method (Oliveira and
//! Takahashi 2020, "An Enhancement of the Bisection Method Average Performance Preserving Minmax
//! Optimality", doi 10.1145/3423597): never more than one step behind bisection, and some ten
//! steps where a length changes smoothly.

use super::super::Evaluator;
use super::super::block::Merged;
use super::super::fields::{Phrase, bare};
use super::super::item::{ItemId, State};
use super::super::value::Value;
use crate::diagnostic::{Diagnostic, Span};
use crate::units::{self, Quantity};
use kurbo::common::solve_itp;
use std::collections::BTreeMap;

/// How near the value is found, as a share of the larger end of its range; of a metre that is far
/// below a nanometre.
const EXACT: f64 = 1e-13;

/// Places at which a fit is looked at before it is narrowed down.
const LOOKS: usize = 8;

impl<'t> Evaluator<'t> {
    /// Runs the fits of a panel in order; each may use those above it.
    pub(super) fn fit_all(
        &mut self,
        id: ItemId,
        merged: &Merged<'t>,
    ) -> Option<BTreeMap<String, Quantity>> {
        let mut values: BTreeMap<String, Quantity> = BTreeMap::new();
        let has_fits = merged.statements.iter().any(|statement| {
            matches!(&statement.kind,
                crate::syntax::tree::StatementKind::Line { word, .. } if word.text == "fit")
        });
        if !has_fits {
            return Some(values);
        }
        let first = self.open_panel(id, merged, BTreeMap::new());
        let opened = self.instances.get(first.0)?;
        let fits: Vec<Phrase<'t>> = opened.fields.all("fit").cloned().collect();
        let scope = opened.fields.scope;
        self.trials.insert(scope);
        let mut ranges: Vec<(String, Quantity, Quantity, Span)> = Vec::new();
        for fit in &fits {
            let name = bare(fit.head.first()?)?.text.clone();
            let range = fit.value("in")?;
            match self.eval(range.expr, range.scope) {
                Value::Range(low, high) => ranges.push((name, low, high, range.expr.span)),
                Value::Poison => return None,
                other => {
                    self.wrong(&other, "a range", range.expr.span);
                    return None;
                }
            }
        }
        // A fit that has not run yet stands in the middle of its range.
        for (name, low, high, _) in &ranges {
            let middle = Quantity::new(0.5 * (low.value + high.value), low.dimension);
            values.insert(name.clone(), middle);
        }
        for (number, (name, low, high, span)) in ranges.iter().enumerate() {
            let found = self.fit_one(id, merged, &values, number, name, (*low, *high), *span)?;
            values.insert(name.clone(), found);
        }
        Some(values)
    }

    #[allow(clippy::too_many_arguments)]
    fn fit_one(
        &mut self,
        id: ItemId,
        merged: &Merged<'t>,
        values: &BTreeMap<String, Quantity>,
        number: usize,
        name: &str,
        (low, high): (Quantity, Quantity),
        range: Span,
    ) -> Option<Quantity> {
        let at = |ev: &mut Self, value: f64| {
            let mut trial = values.clone();
            trial.insert(name.to_owned(), Quantity::new(value, low.dimension));
            ev.trial(id, merged, trial, number)
        };
        let mut spans = (range, range);
        let mut looks = Vec::with_capacity(LOOKS + 1);
        for i in 0..=LOOKS {
            let value = low.value + (high.value - low.value) * i as f64 / LOOKS as f64;
            let (left, right, places) = at(self, value)?;
            spans = places;
            looks.push((value, left, right));
        }
        let gap = |look: &(f64, f64, f64)| look.1 - look.2;
        let (first, last) = (gap(&looks[0]), gap(&looks[LOOKS]));
        let rising = last > first;
        let steady = looks.windows(2).all(|pair| {
            let change = gap(&pair[1]) - gap(&pair[0]);
            change.abs() < 1e-9 || (change > 0.0) == rising
        });
        if first * last > 0.0 && first.abs() > 1e-9 && last.abs() > 1e-9 {
            // Out of reach, unless it turns back on the way.
            let crosses = looks.windows(2).any(|pair| gap(&pair[0]) * gap(&pair[1]) <= 0.0);
            let (left_span, right_span) = spans;
            if !crosses {
                let lefts = looks.iter().map(|look| look.1);
                let least = lefts.clone().fold(f64::INFINITY, f64::min);
                let most = lefts.fold(f64::NEG_INFINITY, f64::max);
                let rights = (looks[0].2, looks[LOOKS].2);
                let asked = if (rights.0 - rights.1).abs() < 5e-6 {
                    format!("{} asked", units::length(rights.0))
                } else {
                    format!("{} to {} asked", units::length(rights.0), units::length(rights.1))
                };
                self.tell(
                    Diagnostic::new(
                        "E0405",
                        format!("no `{name}` from {low} to {high} makes these lengths equal"),
                    )
                    .at(range, "the range")
                    .at(left_span, format!("{} to {}", units::length(least), units::length(most)))
                    .at(right_span, asked)
                    .help("widen the range, or ask for another length"),
                );
                return None;
            }
        }
        if !steady {
            let (left_span, _) = spans;
            self.tell(
                Diagnostic::new("E0408", format!("more than one `{name}` may fit"))
                    .at(range, "within this range")
                    .at(left_span, "this length grows and shrinks again")
                    .help("narrow the range until the length only grows or only shrinks"),
            );
            return None;
        }
        let crossing = looks.windows(2).find(|pair| gap(&pair[0]) * gap(&pair[1]) <= 0.0);
        let Some([one, other]) = crossing else {
            // An end of the range is as good as exact.
            return Some(if first.abs() <= last.abs() { low } else { high });
        };
        let (a, b) = if one.0 <= other.0 { (one, other) } else { (other, one) };
        let sign = if gap(b) >= gap(a) { 1.0 } else { -1.0 };
        let exact = EXACT * low.value.abs().max(high.value.abs());
        let mut sound = true;
        let both = |value: f64| match at(self, value) {
            Some((left, right, _)) => sign * (left - right),
            None => {
                sound = false;
                0.0
            }
        };
        let (from, to) = (sign * gap(a), sign * gap(b));
        let root = solve_itp(both, a.0, b.0, exact, 1, 0.2 / (b.0 - a.0), from, to);
        sound.then(|| Quantity::new(root, low.dimension))
    }

    /// Both sides of a fit with these values.
    fn trial(
        &mut self,
        id: ItemId,
        merged: &Merged<'t>,
        values: BTreeMap<String, Quantity>,
        number: usize,
    ) -> Option<(f64, f64, (Span, Span))> {
        let instance = self.open_panel(id, merged, values);
        let opened = self.instances.get(instance.0)?;
        let fit = opened.fields.all("fit").nth(number)?.clone();
        let scope = opened.fields.scope;
        self.trials.insert(scope);
        let (left, right) = (fit.value("until")?, fit.value("=")?);
        let a = self.any_quantity(left);
        let b = self.any_quantity(right);
        // What was drawn for a trial is not needed any more.
        if let Some(instance) = self.instances.get_mut(instance.0) {
            instance.draft = State::Done(None);
            instance.fields.phrases.clear();
            instance.outline = None;
            instance.drawn.clear();
        }
        let (a, b) = (a?, b?);
        if self.exhausted {
            return None;
        }
        if !a.fits(b.dimension) && !b.fits(a.dimension) {
            self.tell(
                Diagnostic::new(
                    "E0301",
                    format!("{} and {} cannot be compared", a.dimension.name(), b.dimension.name()),
                )
                .at(left.expr.span, self.shown(a))
                .at(right.expr.span, self.shown(b)),
            );
            return None;
        }
        Some((a.value, b.value, (left.expr.span, right.expr.span)))
    }
}
