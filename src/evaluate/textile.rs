//! Yarns, fabrics, weaves, knits and motifs, from their blocks.

use super::Evaluator;
use super::item::ItemId;
use crate::diagnostic::Diagnostic;
use crate::textile::{fabric::Fabric, knit::Knit, motif::Motif, weave::Weave, yarn::Yarn};

fn later<T>(ev: &mut Evaluator<'_>, id: ItemId) -> Option<T> {
    let item = ev.item(id);
    let told = Diagnostic::new("E0203", format!("{} cannot be used yet", item.kind.title()))
        .at(item.span, "declared here");
    ev.tell(told);
    None
}

/// A yarn.
pub(super) fn yarn(ev: &mut Evaluator<'_>, id: ItemId) -> Option<Yarn> {
    later(ev, id)
}

/// A fabric.
pub(super) fn fabric(ev: &mut Evaluator<'_>, id: ItemId) -> Option<Fabric> {
    later(ev, id)
}

/// A weave.
pub(super) fn weave(ev: &mut Evaluator<'_>, id: ItemId) -> Option<Weave> {
    later(ev, id)
}

/// A knit.
pub(super) fn knit(ev: &mut Evaluator<'_>, id: ItemId) -> Option<Knit> {
    later(ev, id)
}

/// A motif.
pub(super) fn motif(ev: &mut Evaluator<'_>, id: ItemId) -> Option<Motif> {
    later(ev, id)
}
