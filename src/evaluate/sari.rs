//! Saris and their parts, from their blocks.

use super::Evaluator;
use super::item::ItemId;
use crate::diagnostic::Diagnostic;
use crate::garment::sari::{Part, Sari};

fn later<T>(ev: &mut Evaluator<'_>, id: ItemId) -> Option<T> {
    let item = ev.item(id);
    let told = Diagnostic::new("E0203", format!("{} cannot be used yet", item.kind.title()))
        .at(item.span, "declared here");
    ev.tell(told);
    None
}

/// A part with its width (kath) or length (padar).
pub(super) fn part(ev: &mut Evaluator<'_>, id: ItemId) -> Option<(Part, Option<f64>)> {
    later(ev, id)
}

/// A sari and the item of its fabric.
pub(super) fn sari(ev: &mut Evaluator<'_>, id: ItemId) -> Option<(Sari, ItemId)> {
    later(ev, id)
}
