//! Pieces laid side by side in the plane before they are rolled round a body: what a seam joins at
//! its sides lies beside its partner, upright as it was drawn.

use super::joins::{Joins, Seen, reach};
use crate::mesh::compiled::Compiled;

/// Room between two pieces side by side, m.
pub(super) const MEETING: f64 = 0.01;
/// Height of the rows in which pieces are kept from lying on each other, m.
const ROW: f64 = 0.01;
/// A piece drawn this far from upright is turned, rad; one nearer stands as it was drawn, as gores
/// and side pieces do, whose seams lean.
const UPRIGHT: f64 = 0.7;

/// Most by which a led piece leans towards its partner, m/m.
const LEAN: f64 = 0.25;

/// Where a piece lies in the plane.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Lay {
    /// Which part of the way round the body the plane's x = 0 is for this piece: 0 in front,
    /// 1/2 behind.
    pub part: f64,
    /// Turn of the drawing, rad.
    pub turn: f64,
    /// Where its origin lies, m: x to the viewer's right, y the height.
    pub origin: [f64; 2],
}

impl Lay {
    /// Where a place of the drawing lies.
    pub fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let (sin, cos) = (libm::sin(self.turn), libm::cos(self.turn));
        [self.origin[0] + x * cos - y * sin, self.origin[1] + x * sin + y * cos]
    }
}

/// Whether a join is at the sides of both its panels as they lie: higher than wide.
pub(super) fn is_beside(joins: &Joins, seen: &Seen, lay: &Lay, partner: &Lay) -> bool {
    let upright = |points: &mut dyn Iterator<Item = [f64; 2]>| {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for place in points {
            for c in 0..2 {
                low[c] = low[c].min(place[c]);
                high[c] = high[c].max(place[c]);
            }
        }
        high[1] - low[1] > high[0] - low[0]
    };
    upright(&mut seen.pairs().map(|[own, _]| lay.at(joins.drawn[own])))
        && upright(&mut seen.pairs().map(|[_, other]| partner.at(joins.drawn[other])))
}

/// The turn that brings a panel's side of a join nearest to its partner's, where that lies; none if
/// the panel stands upright enough (best rotation: Kabsch 1976).
pub(super) fn turn(joins: &Joins, seen: &Seen, partner: &Lay) -> f64 {
    let own: Vec<[f64; 2]> = seen.pairs().map(|[a, _]| joins.drawn[a]).collect();
    let goal: Vec<[f64; 2]> = seen.pairs().map(|[_, b]| partner.at(joins.drawn[b])).collect();
    let (m, n) = (middle(&own), middle(&goal));
    let (mut dot, mut cross) = (0.0, 0.0);
    for (p, q) in own.iter().zip(&goal) {
        let (a, b) = ([p[0] - m[0], p[1] - m[1]], [q[0] - n[0], q[1] - n[1]]);
        dot += a[0] * b[0] + a[1] * b[1];
        cross += a[0] * b[1] - a[1] * b[0];
    }
    let turn = libm::atan2(cross, dot);
    if turn.abs() < UPRIGHT || !turn.is_finite() { 0.0 } else { turn }
}

/// Lays a panel beside the partner of a join without lying on it: as it was placed at a `height`, or
/// leaning as the partner's side does.
pub(super) fn lay_beside(
    compiled: &Compiled,
    joins: &Joins,
    (panel, seen): (usize, &Seen),
    partner: &Lay,
    height: Option<f64>,
) -> Lay {
    let turn = if height.is_some() { 0.0 } else { turn(joins, seen, partner) };
    let mut lay = Lay { part: partner.part, turn, origin: [0.0; 2] };
    let own: Vec<[f64; 2]> = seen.pairs().map(|[a, _]| lay.at(joins.drawn[a])).collect();
    let goal: Vec<[f64; 2]> = seen.pairs().map(|[_, b]| partner.at(joins.drawn[b])).collect();
    let (m, n) = (middle(&own), middle(&goal));
    lay.origin = [n[0] - m[0], height.unwrap_or(n[1] - m[1])];
    let all: Vec<[f64; 2]> =
        compiled.panels[panel].particles.range().map(|k| lay.at(joins.drawn[k])).collect();
    let side = if middle(&all)[0] < n[0] { -1.0 } else { 1.0 };
    let low = all.iter().map(|p| p[1]).fold(f64::INFINITY, f64::min);
    let high = all.iter().map(|p| p[1]).fold(f64::NEG_INFINITY, f64::max);
    if low > high {
        return lay;
    }
    let rows = (low, ROW, ((high - low) / ROW) as usize + 2);
    // How far each row lies on the partner's.
    let over = |lay: &Lay| -> Vec<[f64; 2]> {
        let mine = reach(compiled, joins, panel, &|p| lay.at(p), rows);
        let theirs = reach(compiled, joins, seen.other, &|p| partner.at(p), rows);
        let pairs = mine.iter().zip(&theirs).enumerate();
        pairs
            .filter_map(|(k, (m, t))| {
                let (m, t) = (m.as_ref()?, t.as_ref()?);
                let over = if side > 0.0 { t[1] - m[0] } else { m[1] - t[0] };
                Some([low + k as f64 * ROW, over])
            })
            .collect()
    };
    if height.is_none() {
        let lean = (side * slope(&over(&lay))).clamp(-LEAN, LEAN);
        let (from, by) = (lay.at(middle_of(joins, seen)), libm::atan(lean));
        lay.turn -= by;
        let to = lay.at(middle_of(joins, seen));
        lay.origin = [lay.origin[0] + from[0] - to[0], lay.origin[1] + from[1] - to[1]];
    }
    let most = over(&lay).iter().map(|o| o[1]).fold(f64::NEG_INFINITY, f64::max);
    if most.is_finite() {
        lay.origin[0] += side * (most + MEETING);
    }
    lay
}

/// Middle of a panel's side of a join in its drawing, m.
fn middle_of(joins: &Joins, seen: &Seen) -> [f64; 2] {
    middle(&seen.pairs().map(|[own, _]| joins.drawn[own]).collect::<Vec<_>>())
}

/// The slope of the straight line nearest to points, second coordinate over first.
fn slope(points: &[[f64; 2]]) -> f64 {
    let m = middle(points);
    let (mut square, mut product) = (0.0, 0.0);
    for p in points {
        square += (p[0] - m[0]) * (p[0] - m[0]);
        product += (p[0] - m[0]) * (p[1] - m[1]);
    }
    if square > 0.0 { product / square } else { 0.0 }
}

/// Lays a panel above or below the partner of a join, whichever side of it the panel goes on, clear
/// of the seam by [`MEETING`].
pub(super) fn lay_below(
    compiled: &Compiled,
    joins: &Joins,
    (panel, seen): (usize, &Seen),
    partner: &Lay,
) -> Lay {
    let mut lay = Lay { turn: turn(joins, seen, partner), ..*partner };
    lay.origin = [0.0; 2];
    let own: Vec<[f64; 2]> = seen.pairs().map(|[a, _]| lay.at(joins.drawn[a])).collect();
    let goal: Vec<[f64; 2]> = seen.pairs().map(|[_, b]| partner.at(joins.drawn[b])).collect();
    let all: Vec<[f64; 2]> =
        compiled.panels[panel].particles.range().map(|k| lay.at(joins.drawn[k])).collect();
    let (m, n) = (middle(&own), middle(&goal));
    let far = |of: &[[f64; 2]], sign: f64| {
        of.iter().map(|p| sign * p[1]).fold(f64::NEG_INFINITY, f64::max) * sign
    };
    // Below: its highest stitch under the partner's lowest.
    let sign = if middle(&all)[1] < m[1] { 1.0 } else { -1.0 };
    lay.origin = [n[0] - m[0], far(&goal, -sign) - far(&own, sign) - sign * MEETING];
    lay
}

/// Mean of places in the plane.
pub(super) fn middle(points: &[[f64; 2]]) -> [f64; 2] {
    let n = points.len().max(1) as f64;
    [0, 1].map(|c| points.iter().map(|p| p[c]).sum::<f64>() / n)
}
