//! Further cloth along the edges of a piece: `hem`, `facing`, `interfacing`.

use super::super::Evaluator;
use super::super::fields::{Fields, Phrase};
use super::super::item::ItemId;
use super::super::words::Kind;
use super::slit;
use crate::diagnostic::Span;
use crate::units::Dimension;

/// The words that lay further cloth along edges.
pub(super) const BANDS: &[&str] = &["hem", "facing", "interfacing"];

/// The narrowest and the widest band, m.
const WIDTH: (f64, f64) = (1e-3, 0.5);

/// Further cloth along edges, by their names.
#[derive(Clone, Debug)]
pub struct Banded {
    /// Where it is said.
    pub span: Span,
    /// The edges.
    pub edges: Vec<String>,
    /// How far it reaches into the piece, m.
    pub width: f64,
    /// Its plies.
    pub plies: u32,
    /// Its fabric, where it is not the piece's own.
    pub fabric: Option<ItemId>,
}

impl<'t> Evaluator<'t> {
    /// All bands of a panel.
    pub(super) fn bands(&mut self, fields: &Fields<'t>) -> Option<Vec<Banded>> {
        let mut bands = Vec::new();
        for phrase in fields.phrases.iter().filter(|p| BANDS.contains(&p.word.name)) {
            let width = phrase.value("depth").or(phrase.value("width"))?;
            let width = self.within_range(width, Dimension::LENGTH, WIDTH.0, WIDTH.1)?;
            let fabric = match phrase.value("of") {
                Some(arg) => Some(self.item_among(arg, &[Kind::Fabric])?),
                None => None,
            };
            let mut edges = Vec::new();
            for arg in phrase.values("on") {
                edges.push(self.name_of(arg)?.text.clone());
            }
            bands.push(Banded { span: phrase.span, edges, width, plies: plies(phrase), fabric });
        }
        for phrase in fields.all("slit") {
            let Some(width) = phrase.value("facing") else { continue };
            let width = self.within_range(width, Dimension::LENGTH, WIDTH.0, WIDTH.1)?;
            let edges = slit::lips(phrase).into_iter().flatten().collect();
            bands.push(Banded { span: phrase.span, edges, width, plies: 1, fabric: None });
        }
        Some(bands)
    }
}

/// How many plies a band adds: a hem that is turned twice lies double.
fn plies(phrase: &Phrase<'_>) -> u32 {
    if phrase.says("double") { 2 } else { 1 }
}

/// The cloth that a hem takes beyond its edge, m.
pub(super) fn turned(phrase: &Phrase<'_>, depth: f64) -> f64 {
    depth * f64::from(plies(phrase))
}
