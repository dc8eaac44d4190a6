//! Seam allowances: cloth left beyond the cut line.

use super::super::Evaluator;
use super::super::fields::Fields;
use super::CutPiece;
use super::band::{self, Banded};
use crate::garment::panel::Corner;
use crate::units::Dimension;

/// The widest, m: hems are turned by it.
const WIDEST: f64 = 0.5;

impl<'t> Evaluator<'t> {
    /// `allowance: L` for all edges, then `allowance L on EDGE, … corner square` for some.
    pub(super) fn allowances(
        &mut self,
        fields: &Fields<'t>,
        bands: &[Banded],
    ) -> Option<Vec<(Option<String>, f64, Corner)>> {
        let mut allowances = Vec::new();
        if let Some(arg) = fields.value("allowance") {
            let width = self.within_range(arg, Dimension::LENGTH, 0.0, WIDEST)?;
            allowances.push((None, width, Corner::default()));
        }
        // What is turned up for a hem is cut on to the piece; `leave` has the last word.
        for band in bands {
            let Some(more) = band.cloth.cut_on() else { continue };
            let edges = band.edges.iter();
            allowances.extend(edges.map(|name| (Some(name.clone()), more, Corner::Mitre)));
        }
        for phrase in fields.all("leave") {
            let width = self.within_range(phrase.arg(0)?, Dimension::LENGTH, 0.0, WIDEST)?;
            let corner = match phrase.word_of("corner") {
                Some("square") => Corner::Square,
                Some("round") => Corner::Round,
                _ => Corner::Mitre,
            };
            for arg in phrase.values("on") {
                allowances.push((Some(self.name_of(arg)?.text.clone()), width, corner));
            }
        }
        Some(allowances)
    }

    /// Whether all edges of which an allowance or a band is said are edges of the piece.
    pub(super) fn allowed_edges(&mut self, fields: &Fields<'t>, pieces: &[CutPiece]) -> bool {
        let known: Vec<String> =
            pieces.iter().flat_map(|piece| &piece.edges).map(|edge| edge.name.clone()).collect();
        let mut sound = true;
        let said = fields.phrases.iter().filter(|phrase| {
            phrase.word.name == "leave" || band::BANDS.contains(&phrase.word.name)
        });
        for arg in said.flat_map(|phrase| phrase.values("on")) {
            if let Some(name) = self.name_of(arg)
                && !known.contains(&name.text)
            {
                self.no_member("this panel", name, known.iter().map(String::as_str));
                sound = false;
            }
        }
        sound
    }
}
