//! Weaves made of weaves: `upper` and `lower`, `profile`, `figure`.

use super::chart::{self, Keys};
use super::weave::{downwards, small};
use crate::diagnostic::Diagnostic;
use crate::evaluate::Evaluator;
use crate::evaluate::fields::{Arg, Fields, Phrase};
use crate::evaluate::item::Made;
use crate::evaluate::words::Kind;
use crate::syntax::tree::Item;
use crate::textile::compound::{self, Extra};
use crate::textile::weave::{Weave, WeaveError};

/// The weave that is named.
fn named<'t>(ev: &mut Evaluator<'t>, arg: Arg<'t>) -> Option<Weave> {
    let id = ev.item_named(arg, Kind::Weave)?;
    match ev.make(id, arg.expr.span)? {
        Made::Weave(weave) => Some((*weave).clone()),
        _ => None,
    }
}

/// `upper: plain`, `lower: twill_2_2`, perhaps `stitch: 4`.
pub(super) fn double<'t>(
    ev: &mut Evaluator<'t>,
    fields: &Fields<'t>,
    way: &Phrase<'t>,
) -> Option<Result<Weave, WeaveError>> {
    let upper = named(ev, way.arg(0)?);
    let lower = ev.required(fields, "lower")?.arg(0)?;
    let lower = named(ev, lower);
    let stitch = match fields.value("stitch") {
        Some(arg) => Some(small(ev, arg, 1)?),
        None => None,
    };
    Some(compound::double(&upper?, &lower?, stitch))
}

/// `profile:` with a legend, or with `turn`.
pub(super) fn profile<'t>(
    ev: &mut Evaluator<'t>,
    fields: &Fields<'t>,
    way: &Phrase<'t>,
) -> Option<Result<Weave, WeaveError>> {
    let mut weaves = Vec::new();
    let mut keys = Keys::new(&[]);
    if let Some(arg) = fields.value("turn") {
        let weave = named(ev, arg)?;
        keys.set("#", 0);
        keys.set(".", 1);
        weaves.extend(compound::turned(&weave));
    }
    let mut sound = true;
    for line in chart::legend(ev, fields) {
        let weave = match line.rest {
            [Item::Expr(expr)] => named(ev, Arg { expr, scope: line.scope, of: "legend" }),
            _ => {
                chart::unknown_meaning(ev, &line, &["a weave"]);
                None
            }
        };
        sound &= weave.is_some();
        keys.set(&line.key.text, weaves.len());
        weaves.push(weave.unwrap_or_else(Weave::plain));
    }
    if weaves.is_empty() {
        if !fields.spoils("legend") && !fields.spoils("turn") {
            let told = Diagnostic::new(
                "E0208",
                format!("{} must say which weaves its profile is made of", fields.title),
            )
            .at(way.key.span, "a profile alone is no weave")
            .help("`turn: satin_8`, or `legend { \".\": plain   \"#\": satin }`");
            ev.tell(told);
        }
        return None;
    }
    let known = "the signs of a profile are those of `legend`; with `turn` also `#` and `.`";
    let mut cells = chart::cells(ev, way, &keys, known)?;
    if downwards(fields) {
        cells.reverse();
    }
    sound.then(|| compound::profile(&cells, &weaves))
}

/// `figure:` of extra threads on a ground.
pub(super) fn figure<'t>(
    ev: &mut Evaluator<'t>,
    fields: &Fields<'t>,
    way: &Phrase<'t>,
) -> Option<Result<Weave, WeaveError>> {
    let ground = match fields.value("ground") {
        Some(arg) => named(ev, arg),
        None => Some(Weave::plain()),
    };
    let keys = Keys::new(&[("#", true), (".", false)]);
    let known = "`#`: the extra thread lies on the face; `.`: it does not";
    let mut marks = chart::cells(ev, way, &keys, known)?;
    if downwards(fields) {
        marks.reverse();
    }
    let extra = match fields.get("extra").and_then(|phrase| phrase.choice(0)) {
        Some("warp") => Extra::Warp,
        _ => Extra::Weft,
    };
    let bind = match fields.value("bind") {
        Some(arg) => Some(small(ev, arg, 2)?),
        None => None,
    };
    if !marks.iter().flatten().any(|mark| *mark) {
        ev.tell(
            Diagnostic::new("E0208", "a figure without a mark")
                .at(way.key.span, "`#` marks where it is seen")
                .help("leave the figure out, or draw it"),
        );
        return None;
    }
    Some(compound::figure(&ground?, &marks, extra, bind))
}
