//! Creases: lines along which cloth is pressed, by `fold` and by the folds of pleats and tucks.

use super::super::Evaluator;
use super::super::fields::{Fields, Phrase};
use super::mouth::{Beneath, Cut, Form};
use super::shape::SIZE;
use super::sheet::{self, Crease, Drawn, Sheet};
use crate::diagnostic::Diagnostic;
use crate::geometry::curve;
use crate::units::Dimension;
use kurbo::{BezPath, ParamCurve, Point, Shape};
use std::f64::consts::PI;

impl<'t> Evaluator<'t> {
    /// Adds the creases of `fold` to a sheet; false if one is wrong.
    pub(super) fn creased(
        &mut self,
        fields: &Fields<'t>,
        rings: &[Vec<Drawn>],
        sheet: &mut Sheet,
    ) -> bool {
        let outline = outline_of(rings);
        let mut sound = true;
        for phrase in fields.all("fold") {
            match self.fold(phrase, &outline) {
                Some(crease) => sheet.creases.push(crease),
                None => sound = false,
            }
        }
        sound
    }

    fn fold(&mut self, phrase: &Phrase<'t>, outline: &BezPath) -> Option<Crease> {
        let angle = self.within_range(phrase.value("by")?, Dimension::ANGLE, -PI, PI);
        let (from, to) = match (phrase.value("along"), phrase.value("from"), phrase.value("to")) {
            (Some(along), None, None) => {
                let place = self.quantity_of(along, &[Dimension::LENGTH, Dimension::NUMBER])?;
                let area = outline.bounding_box();
                let up = if place.dimension.is_number() {
                    place.value * area.height()
                } else {
                    place.value
                };
                if !(0.0..=area.height()).contains(&up) {
                    self.tell(
                        Diagnostic::new("E0303", "this fold lies above or below the cloth")
                            .at(along.expr.span, "here")
                            .help("places count from the lowest point of the piece upwards: `50%`, `12cm`"),
                    );
                    return None;
                }
                let y = area.y0 + up;
                (Point::new(area.x0 - 1e-3, y), Point::new(area.x1 + 1e-3, y))
            }
            (None, Some(from), Some(to)) => {
                let (from, to) = (self.point(from), self.point(to));
                let (from, to) = (point(from?), point(to?));
                if from.distance(to) < 1e-4 {
                    self.tell(
                        Diagnostic::new("E0404", "this fold has no length").at(phrase.span, "here"),
                    );
                    return None;
                }
                (from, to)
            }
            _ => {
                self.tell(
                    Diagnostic::new("E0208", "a fold is said by its height or by two points")
                        .at(phrase.span, "here")
                        .help("`fold along 50% by 180deg` or `fold from (0, 0) to (0, 40cm) by 90deg`"),
                );
                return None;
            }
        };
        Some(Crease { span: phrase.span, from, to, angle: angle? })
    }

    /// How far from the edge the folds of a pleat or tuck are pressed, m.
    pub(super) fn pressed(&mut self, phrase: &Phrase<'t>) -> Option<f64> {
        match phrase.value("pressed") {
            Some(arg) => self.within_range(arg, Dimension::LENGTH, 0.0, SIZE),
            None => Some(f64::INFINITY),
        }
    }
}

fn point([x, y]: [f64; 2]) -> Point {
    Point::new(x, y)
}

fn outline_of(rings: &[Vec<Drawn>]) -> BezPath {
    let edges: Vec<BezPath> =
        rings.first().into_iter().flatten().map(|edge| edge.path.clone()).collect();
    sheet::closed(&edges)
}

/// The creases of a mouth on an edge, square to it and right across the piece, or as far as they
/// are pressed, m.
pub(super) fn of_mouth(edge: &Drawn, cut: &Cut, pressed: f64, rings: &[Vec<Drawn>]) -> Vec<Crease> {
    let Form::Fold { beneath } = cut.form else { return Vec::new() };
    let outline = outline_of(rings);
    let (a, b) = cut.mouth;
    let middle = 0.5 * (a + b);
    let across = curve::at(&edge.path, b).0 - curve::at(&edge.path, a).0;
    let left = curve::unit(curve::direction(across) + PI / 2.0);
    let near = curve::at(&edge.path, middle).0 + left * 1e-4;
    let inward = if outline.winding(near) != 0 { left } else { -left };
    let folds = match beneath {
        // The outer fold with the face outside, the inner one with the face inside.
        Some(Beneath::Before) => vec![(a, -PI), (middle, PI)],
        Some(Beneath::After) => vec![(b, -PI), (middle, PI)],
        None => vec![(middle, -PI)],
    };
    let creases = folds.into_iter().map(|(place, angle)| {
        let from = curve::at(&edge.path, place).0;
        let reach = across_cloth(&outline, from, from + inward * SIZE).min(pressed);
        Crease { span: cut.span, from, to: from + inward * reach, angle }
    });
    creases.filter(|crease| crease.from.distance(crease.to) > 1e-4).collect()
}

/// How far a ray from a point of the outline runs before it meets the outline again, m.
fn across_cloth(outline: &BezPath, from: Point, far: Point) -> f64 {
    let ray = kurbo::Line::new(from, far);
    let length = from.distance(far);
    outline
        .segments()
        .flat_map(|segment| segment.intersect_line(ray))
        .map(|hit| from.distance(ray.eval(hit.line_t)))
        .filter(|reach| *reach > 1e-3)
        .fold(length, f64::min)
}
