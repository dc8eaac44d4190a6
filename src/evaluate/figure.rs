//! Tables of sizes, bodies and wearers, from their blocks.

use super::Evaluator;
use super::item::ItemId;
use crate::diagnostic::Diagnostic;
use crate::garment::scene::{BodyRequest, Figure};
use std::collections::BTreeMap;

/// A table of sizes.
#[derive(Clone, Debug, PartialEq)]
pub struct Sizes {
    /// What the columns are.
    pub measures: Vec<String>,
    /// Sizes by name, with a length for each column, m.
    pub rows: Vec<(String, Vec<f64>)>,
}

/// A figure with its measures.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// The figure it starts from.
    pub figure: Figure,
    /// Measures by name, m.
    pub measures: BTreeMap<String, f64>,
    /// The table in which its sizes stand.
    pub sizes: Option<ItemId>,
}

fn later<T>(ev: &mut Evaluator<'_>, id: ItemId) -> Option<T> {
    let item = ev.item(id);
    let told = Diagnostic::new("E0203", format!("{} cannot be used yet", item.kind.title()))
        .at(item.span, "declared here");
    ev.tell(told);
    None
}

/// A table of sizes.
pub(super) fn sizes(ev: &mut Evaluator<'_>, id: ItemId) -> Option<Sizes> {
    later(ev, id)
}

/// A body.
pub(super) fn body(ev: &mut Evaluator<'_>, id: ItemId) -> Option<Body> {
    later(ev, id)
}

/// A wearer: a body with a size and single measures set.
pub(super) fn wearer(ev: &mut Evaluator<'_>, id: ItemId) -> Option<BodyRequest> {
    later(ev, id)
}
