//! Pieces cut as a ring or a part of one: circular skirts and cloaks (Bricis 1995, 5.3: rows along
//! rays from the waist slice).
//!
//! They begin as a cone let down from the landmark, clear of the arms. A cone is narrower than
//! the flat ring it is made of; ripples take up the difference, none at the inner edge, most at the
//! hem, so that the cloth begins nearly unstretched.

use super::Wrapped;
use super::joins::Joins;
use super::layplan::{MEETING, middle};
use super::section::Sections;
use super::trunk::mean_turn;
use crate::mesh::compiled::Compiled;
use nalgebra::{Point3, Vector3};
use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Steepest slope of the cone below the horizontal at which it is clear of the arms, rad.
const SLOPE: f64 = 0.65;
/// Number of ripples round the cone.
const RIPPLES: f64 = 10.0;
/// An edge must turn by this much to be one of a ring, rad.
const SWEEP: f64 = 2.5;

/// The ring that a piece is part of, in its drawing.
pub(super) struct Whole {
    /// Its middle, m.
    middle: [f64; 2],
    /// Radius of its inner edge, m.
    inner: f64,
    /// The angle that it sweeps, rad; 2π if it has no slit.
    sweep: f64,
    /// Where the middle of the sweep lies, as angle from the drawing's -y towards +x, rad.
    bisector: f64,
}

impl Whole {
    /// The ring of which a panel is the whole or a part of at least [`SWEEP`]; none of other shapes.
    pub fn of(compiled: &Compiled, joins: &Joins, number: usize) -> Option<Whole> {
        let panel = &compiled.panels[number];
        let at = |k: &u32| joins.drawn[*k as usize];
        if let Some(hole) = panel.loops.get(1) {
            let hole: Vec<[f64; 2]> = hole.iter().map(at).collect();
            let n = hole.len();
            let girth: f64 = (0..n).map(|k| distance(hole[k], hole[(k + 1) % n])).sum();
            let middle = middle(&hole);
            return Some(Whole { middle, inner: girth / TAU, sweep: TAU, bisector: 0.0 });
        }
        let arcs = panel
            .edges
            .iter()
            .filter_map(|edge| Arc::of(&edge.points.iter().map(at).collect::<Vec<_>>()));
        let inner = arcs.min_by(|a, b| a.radius.total_cmp(&b.radius))?;
        Some(Whole {
            middle: inner.middle,
            inner: inner.radius,
            sweep: inner.sweep,
            bisector: inner.bisector,
        })
    }

    /// Which part of the sweep, from -1/2 to 1/2, and which distance from the inner edge, m, a place
    /// has.
    fn polar(&self, [x, y]: [f64; 2]) -> (f64, f64) {
        let (dx, dy) = (x - self.middle[0], y - self.middle[1]);
        let angle = libm::atan2(dx, -dy) - self.bisector;
        let angle = angle - TAU * (angle / TAU).round();
        (angle / self.sweep, (libm::hypot(dx, dy) - self.inner).max(0.0))
    }
}

/// An edge that turns round a middle.
struct Arc {
    middle: [f64; 2],
    radius: f64,
    sweep: f64,
    bisector: f64,
}

impl Arc {
    fn of(points: &[[f64; 2]]) -> Option<Arc> {
        let n = points.len();
        if n < 5 {
            return None;
        }
        // The middle from the chords of thirds: right for arcs, and tested below.
        let [a, b, c] = [points[0], points[n / 3], points[2 * n / 3]];
        let (p, q) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
        let twice = 2.0 * (p[0] * q[1] - p[1] * q[0]);
        if twice.abs() < 1e-9 {
            return None;
        }
        let (pp, qq) = (p[0] * p[0] + p[1] * p[1], q[0] * q[0] + q[1] * q[1]);
        let middle =
            [a[0] + (q[1] * pp - p[1] * qq) / twice, a[1] + (p[0] * qq - q[0] * pp) / twice];
        let radius = distance(a, middle);
        let round = points.iter().all(|p| (distance(*p, middle) - radius).abs() < 0.02 * radius);
        let angle = |p: [f64; 2]| libm::atan2(p[0] - middle[0], -(p[1] - middle[1]));
        let turn = |w: &[[f64; 2]]| {
            let turn = angle(w[1]) - angle(w[0]);
            turn - TAU * (turn / TAU).round()
        };
        let sweep: f64 = points.windows(2).map(turn).sum();
        let bisector = angle(points[0]) + 0.5 * sweep;
        (round && sweep.abs() >= SWEEP).then_some(Arc {
            middle,
            radius,
            sweep: sweep.abs().min(TAU),
            bisector,
        })
    }
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    libm::hypot(a[0] - b[0], a[1] - b[1])
}

/// Lets down one piece, turned towards what it is sewn to among the panels that are `done`.
pub(super) fn let_down(
    compiled: &Compiled,
    joins: &Joins,
    (wrapped, whole): (&Wrapped, &Whole),
    done: &[bool],
    positions: &mut [Point3<f64>],
) {
    let seams = || joins.of(wrapped.number).filter(|seen| done[seen.other]);
    let pairs = || seams().flat_map(|seen| seen.pairs().collect::<Vec<_>>());
    // Below what it is sewn to, at its landmark if that is nothing.
    let lowest = pairs().map(|[_, other]| positions[other].y).fold(f64::INFINITY, f64::min);
    let height = if lowest.is_finite() { lowest - MEETING } else { wrapped.height() };
    let sections = Sections::new(wrapped.body, height - 0.02, height + 0.02);
    let (k, _) = sections.at(height);
    let ring = sections.ring(k, wrapped.gap.max(0.005));
    let clear = ring.girth() / TAU;
    // A part of a ring is let down steeper, lest it be stretched.
    let cos = libm::cos(SLOPE).min(whole.sweep / TAU).max(0.0);
    let slope = libm::acos(cos).min(FRAC_PI_2);
    let (sin, cos) = (libm::sin(slope), libm::cos(slope));
    let turns: Vec<f64> = pairs()
        .map(|[own, other]| ring.share(&positions[other]) - whole.polar(joins.drawn[own]).0)
        .collect();
    let turn = mean_turn(turns.into_iter()).unwrap_or(whole.bisector / TAU);

    let slit = sides(compiled, joins, wrapped.number, whole);
    for particle in compiled.panels[wrapped.number].particles.range() {
        let (part, out) = whole.polar(joins.drawn[particle]);
        let part = slit.get(&particle).map_or(part, |side| 0.5 * side);
        // Seen from above with the front below: the drawing's -y is the front, +x the left.
        let angle = (part + turn) * TAU;
        let here = ring.point(angle / TAU * ring.girth());
        let outward = Vector3::new(libm::sin(angle), 0.0, libm::cos(angle));
        let around = clear + out * cos;
        let cloth = (whole.inner + out) * whole.sweep / TAU;
        let excess = (cloth / around - 1.0).max(0.0);
        let ripple = 2.0 * around / RIPPLES * excess.sqrt();
        let wave = ripple * libm::cos(RIPPLES * angle + PI);
        let normal = outward * sin + Vector3::y() * cos;
        positions[particle] = Point3::new(here[0], height, here[1])
            + (outward * cos - Vector3::y() * sin) * out
            + normal * wave;
    }
}

/// On which side of a slit in a whole round its particles lie, -1 or 1: the two sides are drawn in
/// one place.
fn sides(compiled: &Compiled, joins: &Joins, number: usize, whole: &Whole) -> BTreeMap<usize, f64> {
    let panel = &compiled.panels[number];
    let cells = compiled.cells[panel.cells.range()].iter().map(|c| &c[..]);
    let triangles = compiled.triangles[panel.triangles.range()].iter().map(|t| &t[..]);
    let faces: Vec<&[u32]> = cells.chain(triangles).collect();
    let part = |k: u32| whole.polar(joins.drawn[k as usize]).0;
    let doubtful = |k: u32| part(k).abs() > 0.5 - 1e-3;
    let mut sides = BTreeMap::new();
    // From face to face along the slit.
    loop {
        let before = sides.len();
        for face in &faces {
            let known = face.iter().find_map(|k| {
                if doubtful(*k) {
                    sides.get(&(*k as usize)).copied()
                } else {
                    Some(part(*k).signum())
                }
            });
            let Some(side) = known else { continue };
            for k in face.iter().filter(|k| doubtful(**k)) {
                sides.entry(*k as usize).or_insert(side);
            }
        }
        if sides.len() == before {
            return sides;
        }
    }
}
