//! Shapes of panels: rectangles, discs, rings, and holes in them.

use super::super::Evaluator;
use super::super::fields::{Arg, Phrase};
use super::outline::Course;
use super::sheet::{self, Drawn};
use crate::diagnostic::{Diagnostic, Span};
use crate::geometry::curve;
use crate::units::{self, Dimension};
use kurbo::{Affine, BezPath, Point, Shape};
use std::f64::consts::{PI, TAU};

/// A pattern piece may be so large, m.
pub(super) const SIZE: f64 = 100.0;

/// A slit gapes so wide in its middle, m.
const SLIT: f64 = 1e-3;

impl<'t> Evaluator<'t> {
    /// A rectangle, disc or ring as drawn edges.
    pub(super) fn shape(&mut self, phrase: &Phrase<'t>) -> Option<Vec<Vec<Drawn>>> {
        let positive = |ev: &mut Self, arg: Option<Arg<'t>>| {
            ev.within_range(arg?, Dimension::LENGTH, 1e-4, SIZE)
        };
        let span = phrase.span;
        let edge = |name: &str, path: BezPath| Drawn { name: Some(name.to_owned()), span, path };
        let circle = |radius: f64, name: &str| {
            let mut path = curve::arc(Point::new(0.0, -radius), Point::ZERO, TAU);
            curve::end_at(&mut path, Point::new(0.0, -radius));
            vec![edge(name, path)]
        };
        match phrase.word.name {
            "rectangle" => {
                let width = positive(self, phrase.arg(0))?;
                let height = positive(self, phrase.arg(1))?;
                Some(vec![rectangle([-width / 2.0, 0.0], [width / 2.0, height], span)])
            }
            "circle" => {
                let radius = positive(self, phrase.value("radius"))?;
                Some(vec![circle(radius, "rim")])
            }
            _ => {
                let inner = positive(self, phrase.value("inner"))?;
                let outer = positive(self, phrase.value("outer"))?;
                if outer <= inner + 1e-4 {
                    self.tell(
                        Diagnostic::new("E0303", "the outer radius of a ring is the greater one")
                            .at(
                                span,
                                format!("{} and {}", units::length(inner), units::length(outer)),
                            ),
                    );
                    return None;
                }
                let sweep = match phrase.value("sweep") {
                    Some(arg) => self.within_range(arg, Dimension::ANGLE, 0.01, TAU)?,
                    None => TAU,
                };
                if sweep > TAU - 1e-6 {
                    return Some(vec![circle(outer, "outer"), circle(inner, "inner")]);
                }
                // The middle of the ring lies below the centre, as a skirt hangs.
                let from = -PI / 2.0 - sweep / 2.0;
                let at = |radius: f64, angle: f64| Point::ZERO + curve::unit(angle) * radius;
                let (a, b) = (at(inner, from), at(outer, from));
                let outer_arc = curve::arc(b, Point::ZERO, sweep);
                let c = curve::end(&outer_arc);
                let d = at(inner, from + sweep);
                let mut inner_arc = curve::arc(d, Point::ZERO, -sweep);
                curve::end_at(&mut inner_arc, a);
                Some(vec![vec![
                    edge("start", curve::line(a, b)),
                    edge("outer", outer_arc),
                    edge("end", curve::line(c, d)),
                    edge("inner", inner_arc),
                ]])
            }
        }
    }

    /// Whether a hole lies in the cloth, at least in part; one that does not is told.
    pub(super) fn within_outline(
        &mut self,
        hole: &[Drawn],
        rings: &[Vec<Drawn>],
        span: Span,
    ) -> bool {
        let Some(outline) = rings.first() else { return true };
        let outline: Vec<BezPath> = outline.iter().map(|edge| edge.path.clone()).collect();
        let outline = sheet::closed(&outline);
        let inside = hole.iter().any(|edge| {
            let half = curve::length(&edge.path) / 2.0;
            [0.0, half].iter().any(|&arc| outline.winding(curve::at(&edge.path, arc).0) != 0)
        });
        if !inside {
            self.tell(
                Diagnostic::new("E0410", "this hole lies outside the cloth")
                    .at(span, "here")
                    .help("move it to where the panel is"),
            );
        }
        inside
    }

    /// `hole slit from P to P`: as narrow a hole as can be cut; its edges are its label and 1, 2.
    fn slit(&mut self, phrase: &Phrase<'t>) -> Option<Vec<Drawn>> {
        let (Some(from), Some(to)) = (phrase.value("from"), phrase.value("to")) else {
            self.tell(
                Diagnostic::new("E0208", "a slit wants its two ends")
                    .at(phrase.span, "missing here")
                    .help("`hole slit from P to P`"),
            );
            return None;
        };
        let (a, b) = (self.point(from), self.point(to));
        let ([ax, ay], [bx, by]) = (a?, b?);
        let (a, b) = (Point::new(ax, ay), Point::new(bx, by));
        let along = b - a;
        if along.hypot() < 2.0 * SLIT {
            self.tell(Diagnostic::new("E0404", "this slit has no length").at(phrase.span, "here"));
            return None;
        }
        let across = kurbo::Vec2::new(-along.y, along.x) * (0.5 * SLIT / along.hypot());
        let middle = a.midpoint(b);
        let edge = |number: usize, from: Point, to: Point| Drawn {
            name: phrase.label.map(|label| format!("{}{number}", label.text)),
            span: phrase.span,
            path: curve::line(from, to),
        };
        Some(vec![
            edge(1, a, middle + across),
            edge(1, middle + across, b),
            edge(2, b, middle - across),
            edge(2, middle - across, a),
        ])
    }

    pub(super) fn hole(
        &mut self,
        phrase: &Phrase<'t>,
        read: Option<&super::Fields<'t>>,
        name: &str,
    ) -> Option<Vec<Drawn>> {
        if phrase.says("circle") || phrase.says("ellipse") {
            let (Some(at), Some(radius)) = (phrase.value("at"), phrase.value("radius")) else {
                self.tell(
                    Diagnostic::new("E0208", "a round hole wants `at POINT radius LENGTH`")
                        .at(phrase.span, "missing here"),
                );
                return None;
            };
            let [x, y] = self.point(at)?;
            let across = self.within_range(radius, Dimension::LENGTH, 1e-4, SIZE)?;
            let up = match phrase.values("radius").get(1) {
                Some(up) if phrase.says("ellipse") => {
                    self.within_range(*up, Dimension::LENGTH, 1e-4, SIZE)?
                }
                Some(up) => {
                    self.tell(
                        Diagnostic::new("E0207", "a circle has one radius")
                            .at(up.expr.span, "remove this, or write `ellipse`"),
                    );
                    return None;
                }
                None => across,
            };
            let turn = match phrase.value("turn") {
                Some(turn) => self.quantity(turn, Dimension::ANGLE)?,
                None => 0.0,
            };
            let unit = curve::arc(Point::new(0.0, -1.0), Point::ZERO, TAU);
            let map = Affine::translate((x, y))
                * Affine::rotate(turn)
                * Affine::scale_non_uniform(across, up);
            let mut path = curve::mapped(&unit, map);
            let from = curve::start(&path);
            curve::end_at(&mut path, from);
            let name = phrase.label.map(|label| label.text.clone());
            return Some(vec![Drawn { name, span: phrase.span, path }]);
        }
        if phrase.says("slit") {
            return self.slit(phrase);
        }
        let (Some(from), Some(read)) = (phrase.value("from"), read) else {
            self.tell(
                Diagnostic::new("E0208", "a hole wants its edges")
                    .at(phrase.span, "here")
                    .help("`hole from P { edges }`, `hole circle at P radius L`, `hole ellipse at P radius L x L` or `hole slit from P to P`"),
            );
            return None;
        };
        let start = self.point(from)?;
        self.draw(read, start, from.expr.span, &format!("a hole in `{name}`"), Course::Closed)
    }
}

/// The edges of a rectangle between two corners: bottom, end, top, start.
pub(in super::super) fn rectangle(low: [f64; 2], high: [f64; 2], span: Span) -> Vec<Drawn> {
    let corners = [
        Point::new(low[0], low[1]),
        Point::new(high[0], low[1]),
        Point::new(high[0], high[1]),
        Point::new(low[0], high[1]),
    ];
    ["bottom", "end", "top", "start"]
        .iter()
        .enumerate()
        .map(|(i, name)| Drawn {
            name: Some((*name).to_owned()),
            span,
            path: curve::line(corners[i], corners[(i + 1) % 4]),
        })
        .collect()
}
