//! Weaves as drafts: threading, tie-up, treadling, or threading and lift plan.

use super::weave::span_of;
use crate::diagnostic::{Diagnostic, Span};
use crate::evaluate::Evaluator;
use crate::evaluate::fields::{Arg, Fields, Phrase};
use crate::evaluate::value::Value;
use crate::syntax::tree::Item;
use crate::textile::weave::{Weave, WeaveError};
use crate::textile::wif;
use std::collections::BTreeSet;

/// The matrix of a draft, first pick first: an end is up where the pick lifts its shaft.
pub(super) fn drawdown<'t>(
    ev: &mut Evaluator<'t>,
    fields: &Fields<'t>,
    threading: &Phrase<'t>,
) -> Option<Vec<Vec<bool>>> {
    let shafts = numbers(ev, threading)?;
    let most = shafts.iter().copied().max().unwrap_or(0);
    let lifted: Vec<BTreeSet<usize>> = match (fields.get("liftplan"), fields.get("tieup")) {
        (Some(plan), Some(tieup)) => {
            ev.tell(
                Diagnostic::new("E0209", "a draft has a tie-up or a lift plan, not both")
                    .at(tieup.span, "here")
                    .at(plan.span, "and here"),
            );
            return None;
        }
        (Some(plan), None) => groups(ev, plan)?,
        (None, Some(tieup)) => {
            let treadles = groups(ev, tieup)?;
            let treadling = ev.required(fields, "treadling")?.clone();
            let mut lifted = Vec::new();
            for treadle in numbers(ev, &treadling)? {
                let Some(shafts) = treadles.get(treadle.wrapping_sub(1)) else {
                    ev.tell(
                        Diagnostic::new(
                            "E0606",
                            format!("treadle {treadle} is used, the tie-up has {}", treadles.len()),
                        )
                        .at(treadling.span, "here")
                        .at(tieup.span, format!("{} treadles", treadles.len())),
                    );
                    return None;
                };
                lifted.push(shafts.clone());
            }
            lifted
        }
        (None, None) if ["tieup", "liftplan"].iter().any(|word| fields.spoils(word)) => {
            return None;
        }
        (None, None) => {
            ev.tell(
                Diagnostic::new("E0208", format!("{} must be given `tieup`", fields.title))
                    .at(threading.span, "a threading alone is no weave")
                    .help(
                        "`tieup: [1, 2], [2, 3]` with `treadling: 1..2`, or `liftplan: [1, 2], …`",
                    ),
            );
            return None;
        }
    };
    let plan = fields.get("liftplan").or(fields.get("tieup"));
    for (at, shafts) in lifted.iter().enumerate() {
        if let Some(shaft) = shafts.iter().find(|shaft| **shaft > most) {
            let told = Diagnostic::new(
                "E0606",
                format!("pick {} lifts shaft {shaft}, the threading has {most}", at + 1),
            )
            .at(plan.map_or(fields.span, |plan| plan.span), "here")
            .at(threading.span, format!("{most} shafts"));
            ev.tell(told);
            return None;
        }
    }
    Some(lifted.iter().map(|up| shafts.iter().map(|shaft| up.contains(shaft)).collect()).collect())
}

/// `wif "serge.wif"`: the cloth of a weaver's file, without trailing ends and picks that do nothing.
pub(super) fn of_file<'t>(
    ev: &mut Evaluator<'t>,
    way: &Phrase<'t>,
) -> Option<Result<Weave, WeaveError>> {
    let (file, text) = ev.file_of(way)?;
    let (found, told) = wif::read(file, text);
    told.into_iter().for_each(|told| ev.tell(told));
    let draft = found?.draft;
    let (ends, picks) = draft.worked();
    if ends.max(picks) > Weave::LARGEST_REPEAT {
        return Some(Err(WeaveError::TooLarge));
    }
    let drawn = draft.drawdown().ok()?;
    let rows = (0..picks).map(|pick| (0..ends).map(|end| drawn.up(end, pick)).collect()).collect();
    Some(Weave::matrix(rows))
}

/// `1..4, 3, 2`: the numbers of threads, shafts or treadles.
fn numbers<'t>(ev: &mut Evaluator<'t>, phrase: &Phrase<'t>) -> Option<Vec<usize>> {
    let mut found = Vec::new();
    for (value, span) in values(ev, phrase)? {
        spread(ev, &value, span, &phrase.key.text, &mut found)?;
    }
    Some(found)
}

/// `[1, 2], [2, 3], 4`: a group of shafts for each pick or treadle.
fn groups<'t>(ev: &mut Evaluator<'t>, phrase: &Phrase<'t>) -> Option<Vec<BTreeSet<usize>>> {
    let mut found = Vec::new();
    for (value, span) in values(ev, phrase)? {
        let parts = match value {
            Value::List(parts) => parts.to_vec(),
            other => vec![other],
        };
        let mut group = Vec::new();
        for part in &parts {
            spread(ev, part, span, &phrase.key.text, &mut group)?;
        }
        found.push(group.into_iter().collect());
    }
    Some(found)
}

/// The values of a phrase, separated by commas.
fn values<'t>(ev: &mut Evaluator<'t>, phrase: &Phrase<'t>) -> Option<Vec<(Value, Span)>> {
    let mut found = Vec::new();
    for item in phrase.rest {
        match item {
            Item::Expr(expr) => {
                let value = ev.eval(Arg { expr, scope: phrase.scope, of: "" }.expr, phrase.scope);
                if value == Value::Poison {
                    return None;
                }
                found.push((value, expr.span));
            }
            Item::Comma(_) => {}
            other => {
                ev.tell(
                    Diagnostic::new(
                        "E0306",
                        format!("`{}` is a list with commas", phrase.key.text),
                    )
                    .at(span_of(other), "not here"),
                );
                return None;
            }
        }
    }
    if found.is_empty() {
        ev.tell(
            Diagnostic::new("E0208", format!("`{}` is empty", phrase.key.text))
                .at(phrase.span, "numbers are missing here")
                .help("such as `threading: 1..4, 3, 2`"),
        );
        return None;
    }
    Some(found)
}

/// Adds a number, or all numbers of a range, up or down.
fn spread(
    ev: &mut Evaluator<'_>,
    value: &Value,
    span: Span,
    of: &str,
    out: &mut Vec<usize>,
) -> Option<()> {
    let most = Weave::LARGEST_REPEAT as f64;
    let whole = |value: f64| {
        (value.fract() == 0.0 && (1.0..=most).contains(&value)).then_some(value as usize)
    };
    let ends = match value {
        Value::Quantity(q) if q.dimension.is_number() => whole(q.value).map(|n| (n, n)),
        Value::Range(a, b) if a.dimension.is_number() && b.dimension.is_number() => {
            whole(a.value).zip(whole(b.value))
        }
        _ => None,
    };
    let Some((from, to)) = ends else {
        ev.tell(
            Diagnostic::new("E0606", format!("`{of}` wants whole numbers from 1 to {most}"))
                .at(span, "here"),
        );
        return None;
    };
    if from <= to {
        out.extend(from..=to);
    } else {
        out.extend((to..=from).rev());
    }
    if out.len() > Weave::LARGEST_REPEAT {
        ev.tell(
            Diagnostic::new("E0606", format!("`{of}` has more than {most} numbers"))
                .at(span, "here"),
        );
        return None;
    }
    Some(())
}
