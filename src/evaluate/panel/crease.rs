//! Creases: lines along which cloth is pressed, by `fold` and by the folds of pleats and tucks.

use super::super::Evaluator;
use super::super::fields::{Fields, Phrase};
use super::mouth::{Beneath, Cut, Form};
use super::shape::SIZE;
use super::sheet::{self, Crease, Drawn, Sheet};
use crate::diagnostic::{Diagnostic, Span};
use crate::geometry::curve;
use crate::units::{self, Dimension};
use kurbo::{BezPath, ParamCurve, Point, Shape, Vec2};
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
        Some(Crease { span: phrase.span, from, to, angle: angle?, shut: None })
    }

    /// How far from the edge the folds of a pleat or tuck are pressed, and how far they are sewn
    /// shut, m.
    pub(super) fn pressed(&mut self, phrase: &Phrase<'t>) -> Option<Pressed> {
        let pressed = match phrase.value("pressed") {
            Some(arg) => self.within_range(arg, Dimension::LENGTH, 0.0, SIZE),
            None => Some(f64::INFINITY),
        };
        let stitched = match phrase.value("stitched") {
            Some(arg) => self.within_range(arg, Dimension::LENGTH, 1e-3, SIZE),
            None => Some(0.0),
        };
        Some(Pressed { span: phrase.span, pressed: pressed?, stitched: stitched? })
    }

    /// Tells of a fold that is to be sewn farther than the cloth goes; false then.
    pub(super) fn stitched_on_cloth(&mut self, creases: &[Crease], said: &Pressed) -> bool {
        let far = |crease: &&Crease| crease.shut.is_some_and(|[_, along]| along == Vec2::ZERO);
        let Some(_) = creases.iter().find(far) else { return true };
        self.tell(
            Diagnostic::new("E0411", "these folds are sewn farther than the cloth goes")
                .at(said.span, format!("stitched {}", units::length(said.stitched)))
                .help("a fold is sewn shut from its edge down, at most to the other side of the piece"),
        );
        false
    }
}

/// How far from their edge folds are pressed and sewn shut.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pressed {
    span: Span,
    /// m.
    pressed: f64,
    /// m; none at 0.
    stitched: f64,
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
/// are pressed. The middle one is sewn shut as far as is said; where the cloth does not go so far, by
/// a line without length.
pub(super) fn of_mouth(
    edge: &Drawn,
    cut: &Cut,
    said: &Pressed,
    rings: &[Vec<Drawn>],
) -> Vec<Crease> {
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
        let whole = across_cloth(&outline, from, from + inward * SIZE);
        let shut = (place == middle && said.stitched > 0.0).then(|| {
            let beside = curve::at(&edge.path, a).0 - from;
            let across = beside - inward * beside.dot(inward);
            let fits = said.stitched <= whole + 1e-6;
            [across, if fits { inward * said.stitched } else { Vec2::ZERO }]
        });
        let to = from + inward * whole.min(said.pressed);
        Crease { span: cut.span, from, to, angle, shut }
    });
    creases
        .filter(|crease| crease.from.distance(crease.to) > 1e-4 || crease.shut.is_some())
        .collect()
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
