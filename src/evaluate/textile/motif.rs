//! Motifs.

use super::chart::{self, Keys};
use crate::diagnostic::Diagnostic;
use crate::evaluate::Evaluator;
use crate::evaluate::fields::{Arg, bare};
use crate::evaluate::item::ItemId;
use crate::syntax::tree::{Expr, ExprKind, Item};
use crate::textile::Colour;
use crate::textile::motif::Motif;
use crate::units::Dimension;

/// A motif.
pub(in crate::evaluate) fn motif(ev: &mut Evaluator<'_>, id: ItemId) -> Option<Motif> {
    let fields = ev.open_item(id)?;
    let mut keys: Keys<Option<Colour>> = Keys::new(&[(".", None)]);
    let mut good = true;
    for line in chart::legend(ev, &fields) {
        let cell = match line.rest {
            [Item::Expr(expr)] => match bare(expr).map(|name| name.text.as_str()) {
                Some("none") => Some(None),
                _ => ev.colour(Arg { expr, scope: line.scope, of: "legend" }).map(Some),
            },
            [Item::Expr(Expr { kind: ExprKind::Unread, .. }), ..] => None,
            _ => {
                chart::unknown_meaning(ev, &line, &["none", "a colour", "a yarn"]);
                None
            }
        };
        match cell {
            Some(cell) => keys.set(&line.key.text, cell),
            None => {
                // The key is known all the same; its colour has been told of.
                good = false;
                keys.set(&line.key.text, None);
            }
        }
    }
    let known = "`.` is the ground; name the other signs in the legend: \
                 `legend { \"*\": gold }`";
    let picture = ev.required(&fields, "picture").cloned();
    let rows = picture.and_then(|picture| chart::cells(ev, &picture, &keys, known));
    let size = ev.required(&fields, "size").cloned().and_then(|size| {
        let width = size.arg(0).and_then(|arg| side(ev, arg));
        let height = size.arg(1).and_then(|arg| side(ev, arg));
        Some([width?, height?])
    });
    let (rows, size) = (rows?, size?);
    if rows.iter().flatten().all(Option::is_none) && good {
        ev.tell(
            Diagnostic::new("W0605", format!("{} shows nothing but ground", fields.title))
                .at(fields.span, "here"),
        );
    }
    good.then(|| Motif { name: ev.item(id).name.clone(), rows, size })
}

/// A side of a motif, m.
fn side<'t>(ev: &mut Evaluator<'t>, arg: Arg<'t>) -> Option<f64> {
    ev.within_range(arg, Dimension::LENGTH, 1e-4, 5.0)
}
