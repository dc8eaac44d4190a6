//! Turning, mirroring and resizing of a whole drawing.

use super::super::Evaluator;
use super::super::fields::Phrase;
use super::sheet::{self, Sheet};
use crate::diagnostic::Diagnostic;
use crate::geometry::curve;
use crate::units::Dimension;
use kurbo::{Affine, Point, Shape};

/// Drawings are resized by no more than this, either way.
const MOST: f64 = 1e3;

impl<'t> Evaluator<'t> {
    /// The point behind `about`, or the origin.
    fn about(&mut self, phrase: &Phrase<'t>) -> Option<Point> {
        match phrase.value("about") {
            Some(arg) => self.point(arg).map(|[x, y]| Point::new(x, y)),
            None => Some(Point::ZERO),
        }
    }

    /// `rotate by A about P`
    pub(super) fn rotation(&mut self, phrase: &Phrase<'t>) -> Option<Affine> {
        let angle = phrase.value("by").and_then(|arg| self.quantity(arg, Dimension::ANGLE));
        let about = self.about(phrase);
        Some(Affine::rotate_about(angle?, about?))
    }

    /// `mirror about P`: left and right exchanged, about the upright line through a point.
    pub(super) fn mirroring(&mut self, phrase: &Phrase<'t>) -> Option<Affine> {
        let about = self.about(phrase)?;
        Some(curve::mirror(about, Point::new(about.x, about.y + 1.0)))
    }

    /// `scale by N x N`, `scale width L`, `scale height L`, `scale EDGE to L`, about a point.
    pub(super) fn scaling(&mut self, phrase: &Phrase<'t>, sheet: &Sheet) -> Option<Affine> {
        let area = sheet::closed(sheet.rings.first()?).bounding_box();
        let about = self.about(phrase)?;
        let wanted = |ev: &mut Self, word: &str, found: f64| -> Option<f64> {
            let arg = phrase.value(word)?;
            let low = (found / MOST).max(1e-4);
            Some(ev.within_range(arg, Dimension::LENGTH, low, found * MOST)? / found)
        };
        let [x, y] = if phrase.says("by") {
            let args = phrase.values("by");
            let mut ratio = [1.0; 2];
            for (number, ratio) in ratio.iter_mut().enumerate() {
                let arg = *args.get(number).or(args.first())?;
                *ratio = self.within_range(arg, Dimension::NUMBER, 1.0 / MOST, MOST)?;
            }
            ratio
        } else if phrase.says("width") {
            [wanted(self, "width", area.width())?, 1.0]
        } else if phrase.says("height") {
            [1.0, wanted(self, "height", area.height())?]
        } else {
            let Some(on) = phrase.value("on") else {
                self.tell(
                    Diagnostic::new("E0208", "`scale to` wants an edge to measure")
                        .at(phrase.span, "missing here")
                        .help("`scale to 36cm on waist`"),
                );
                return None;
            };
            let name = self.name_of(on)?;
            let Some(edge) = sheet.edges.iter().find(|edge| edge.name == name.text) else {
                let known: Vec<String> = sheet.edges.iter().map(|edge| edge.name.clone()).collect();
                self.no_member("this panel", name, known.iter().map(String::as_str));
                return None;
            };
            let pieces =
                edge.stretches.iter().filter_map(|s| sheet.rings.get(s.ring)?.get(s.piece));
            let length: f64 = pieces.map(curve::length).sum();
            let ratio = wanted(self, "to", length)?;
            [ratio, ratio]
        };
        let back = about.to_vec2();
        Some(Affine::translate(back) * Affine::scale_non_uniform(x, y) * Affine::translate(-back))
    }
}
