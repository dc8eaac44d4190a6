//! The cut lines of a panel measured by arc length, in the panel's (u, v) plane.

use crate::garment::panel::{Loop, Panel};
use crate::geometry::curve::share_at;
use crate::geometry::polygon::{Place, turn};
use kurbo::{ParamCurve, ParamCurveArclen, ParamCurveDeriv, PathSeg, Shape};

/// Arc lengths are measured to this, m.
const ACCURACY: f64 = 1e-9;
/// A curve segment is measured in this many spans.
const SPANS: usize = 8;

/// The turn from the drawing to warp and weft: `drawing = rotation by grain of (u, v)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grain {
    cos: f64,
    sin: f64,
}

impl Grain {
    /// The turn for a grain angle, rad. Whole quarter turns are exact.
    pub fn new(angle: f64) -> Self {
        let quarters = angle / std::f64::consts::FRAC_PI_2;
        let nearest = quarters.round();
        if (quarters - nearest).abs() < 1e-12 {
            let (sin, cos) = match nearest.rem_euclid(4.0) as u8 {
                0 => (0.0, 1.0),
                1 => (1.0, 0.0),
                2 => (0.0, -1.0),
                _ => (-1.0, 0.0),
            };
            return Grain { cos, sin };
        }
        Grain { cos: libm::cos(angle), sin: libm::sin(angle) }
    }

    /// From the drawing to (u, v), m.
    pub fn to_cloth(self, [x, y]: Place) -> Place {
        [x * self.cos + y * self.sin, y * self.cos - x * self.sin]
    }
}

/// A loop of a panel measured by arc length from the start of its first piece.
#[derive(Clone, Debug)]
pub struct Outline {
    spans: Vec<Span>,
    /// Where each piece starts, m.
    pub pieces: Vec<f64>,
    /// Length of the whole loop, m.
    pub length: f64,
}

#[derive(Clone, Copy, Debug)]
struct Span {
    curve: PathSeg,
    /// Arc length before the span, and of it, m.
    before: f64,
    length: f64,
    /// How far the line has turned before the span, and turns in it, rad; always added up.
    turned: f64,
    turning: f64,
}

impl Outline {
    /// Measures a loop.
    pub fn new(ring: &Loop, grain: Grain) -> Self {
        let turn = kurbo::Affine::new([grain.cos, -grain.sin, grain.sin, grain.cos, 0.0, 0.0]);
        let mut outline = Outline { spans: Vec::new(), pieces: Vec::new(), length: 0.0 };
        let mut turned = 0.0;
        for piece in &ring.pieces {
            outline.pieces.push(outline.length);
            let mut heading: Option<kurbo::Vec2> = None;
            for curve in piece.path.segments() {
                let curve = turn * curve;
                let count = if matches!(curve, PathSeg::Line(_)) { 1 } else { SPANS };
                for step in 0..count {
                    let share = (step as f64 / count as f64, (step + 1) as f64 / count as f64);
                    let part = if count == 1 { curve } else { curve.subsegment(share.0..share.1) };
                    let length = part.arclen(ACCURACY / SPANS as f64);
                    // Rejects what has no length and what is not a number.
                    if length.is_nan() || length <= 1e-15 {
                        continue;
                    }
                    let (start, middle, end) = headings(part);
                    let turning = heading.map_or(0.0, |before| angle(before, start))
                        + angle(start, middle)
                        + angle(middle, end);
                    heading = Some(end);
                    let before = outline.length;
                    outline.spans.push(Span { curve: part, before, length, turned, turning });
                    turned += turning;
                    outline.length += length;
                }
            }
        }
        outline
    }

    /// Arc length of the end of a piece, m.
    pub fn piece_end(&self, piece: usize) -> f64 {
        self.pieces.get(piece + 1).copied().unwrap_or(self.length)
    }

    fn span_at(&self, arc: f64) -> Option<&Span> {
        let after = self.spans.partition_point(|span| span.before <= arc);
        self.spans.get(after.saturating_sub(1))
    }

    /// The place (u, v) at an arc length, m; `None` for a loop without any length.
    pub fn at(&self, arc: f64) -> Option<Place> {
        let span = self.span_at(arc)?;
        let along = (arc - span.before).clamp(0.0, span.length);
        let share = match span.curve {
            _ if along <= 0.0 => 0.0,
            _ if along >= span.length => 1.0,
            PathSeg::Line(_) => along / span.length,
            curve => share_at(curve, along, span.length),
        };
        let point = span.curve.eval(share);
        Some([point.x, point.y])
    }

    /// Width and height of the box around the loop along weft and warp, m.
    pub fn extent(&self) -> [f64; 2] {
        let boxes = self.spans.iter().map(|span| Shape::bounding_box(&span.curve));
        let around = boxes.reduce(|all, more| all.union(more)).unwrap_or_default();
        [around.width(), around.height()]
    }

    /// How far the line turns between two arc lengths, rad, left and right added up. Corners
    /// between pieces do not count.
    pub fn turning(&self, from: f64, to: f64) -> f64 {
        let turned = |arc: f64| {
            self.span_at(arc).map_or(0.0, |span| {
                span.turned + span.turning * ((arc - span.before) / span.length).clamp(0.0, 1.0)
            })
        };
        turned(to) - turned(from)
    }
}

fn headings(part: PathSeg) -> (kurbo::Vec2, kurbo::Vec2, kurbo::Vec2) {
    let slope = |share: f64| match part {
        PathSeg::Line(line) => line.p1 - line.p0,
        PathSeg::Quad(quad) => quad.deriv().eval(share).to_vec2(),
        PathSeg::Cubic(cubic) => cubic.deriv().eval(share).to_vec2(),
    };
    // A handle of no length has no direction at the very end.
    (slope(1e-3), slope(0.5), slope(1.0 - 1e-3))
}

/// The angle between two directions, rad; 0 where one has none.
fn angle(a: kurbo::Vec2, b: kurbo::Vec2) -> f64 {
    libm::atan2(a.cross(b).abs(), a.dot(b))
}

/// The angle inside the cloth at corner `b` of a loop that runs `a b c` with the cloth on its
/// left, rad, 0 to 2π.
pub fn corner(a: Place, b: Place, c: Place) -> f64 {
    let dot = (a[0] - b[0]) * (c[0] - b[0]) + (a[1] - b[1]) * (c[1] - b[1]);
    let angle = libm::atan2(turn(b, c, a), dot);
    if angle < 0.0 { angle + std::f64::consts::TAU } else { angle }
}

/// All loops of a panel.
pub fn outlines(panel: &Panel) -> Vec<Outline> {
    let grain = Grain::new(panel.grain);
    panel.loops.iter().map(|ring| Outline::new(ring, grain)).collect()
}
