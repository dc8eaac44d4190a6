//! Fronts, backs and whole legs of trousers: below the fork a tube round each leg, above it one ring
//! round the trunk, as when they are being pulled up.
//!
//! The middle line of the drawing, the crease, runs down the front or the back of its leg; that of
//! a leg of one piece runs down the outside. Above the fork a piece begins at the body's middle
//! plane with its own inner edge, the rise. Legs that would reach down to the feet begin pushed up
//! above them, in folds round the outside.

use super::joins::{Joins, reach};
use super::section::{Ring, Sections};
use super::{Wrapped, centre, drawing};
use crate::body::surface::Surface;
use crate::garment::scene::Side;
use crate::mesh::compiled::Compiled;
use nalgebra::Point3;
use std::f64::consts::TAU;

/// Height of the rows whose widths are compared, m.
const ROW: f64 = 0.01;
/// Room left between pieces that meet, m.
const MEETING: f64 = 0.01;
/// How far below their places trousers begin, m: the forks pass under the crotch.
const DOWN: f64 = 0.05;
/// Length of cloth in one of the folds in which a leg is pushed up, m: many cells of a coarse grid.
const FOLD: f64 = 0.16;
/// Room between a hem and the ankle that it must not pass, m.
const ANKLE: f64 = 0.01;
/// Over this height above the fork the two tubes become one ring, m.
const JOINING: f64 = 0.12;
/// Reaches that differ by less than this are one, m.
const SAME: f64 = 1e-4;

/// A piece with its rows.
struct Piece<'a> {
    wrapped: &'a Wrapped<'a>,
    /// +1 for the wearer's left leg.
    sign: f64,
    /// How far each row reaches from the middle line of the drawing, m: of a front or a back to the
    /// outside and to the inside, of a leg of one piece to the front and to the back.
    reach: Vec<Option<[f64; 2]>>,
}

/// Whether a panel is a front or a back of a leg, or a leg of one piece that goes on above the
/// crotch.
pub(super) fn is_leg(compiled: &Compiled, wrapped: &Wrapped) -> bool {
    let Some((points, _)) = wrapped.limb() else { return false };
    let above = || {
        let places = drawing(compiled, wrapped.panel(compiled));
        places.map(|(_, [_, y])| height(wrapped, y)).fold(f64::NEG_INFINITY, f64::max)
            > points[0].y + JOINING
    };
    wrapped.landmark.starts_with("leg.")
        && match wrapped.side {
            Side::Before | Side::Behind => true,
            Side::Around => above(),
            Side::Beside => false,
        }
}

/// Lays the pieces of all legs, one body and one layer of cloth after the other.
pub(super) fn wrap(
    compiled: &Compiled,
    joins: &Joins,
    legs: &[&Wrapped],
    positions: &mut [Point3<f64>],
) {
    for members in by_layer(compiled, legs) {
        wrap_together(compiled, joins, &members, positions);
    }
}

/// The panels of each body and each of its layers of cloth, in their order.
fn by_layer<'w, 'a>(
    compiled: &Compiled,
    panels: &[&'w Wrapped<'a>],
) -> impl Iterator<Item = Vec<&'w Wrapped<'a>>> {
    let mut groups: Vec<(*const Surface, i32, Vec<&Wrapped>)> = Vec::new();
    for &panel in panels {
        let (body, layer) = (std::ptr::from_ref(panel.body), panel.panel(compiled).layer);
        match groups.iter_mut().find(|(b, l, _)| *b == body && *l == layer) {
            Some((_, _, members)) => members.push(panel),
            None => groups.push((body, layer, vec![panel])),
        }
    }
    groups.into_iter().map(|(_, _, members)| members)
}

/// Height at which a place of the drawing belongs, m.
fn height(wrapped: &Wrapped, y: f64) -> f64 {
    let level = wrapped.level.unwrap_or(wrapped.landmark);
    centre(wrapped.body, level).y + y - wrapped.anchor
}

/// How far a place of the drawing lies towards the outside of its leg, m; of a leg of one piece,
/// towards the front. Seen from outside, the right of a front is the wearer's left, the right of a
/// back the wearer's right, the right of a left leg its back.
fn outwards(wrapped: &Wrapped, sign: f64, x: f64) -> f64 {
    if wrapped.side == Side::Before { x * sign } else { -x * sign }
}

fn wrap_together(
    compiled: &Compiled,
    joins: &Joins,
    members: &[&Wrapped],
    positions: &mut [Point3<f64>],
) {
    let Some(first) = members.first() else { return };
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for member in members {
        for (_, [_, y]) in drawing(compiled, member.panel(compiled)) {
            let at = height(member, y);
            low = low.min(at);
            high = high.max(at);
        }
    }
    if low > high {
        return;
    }
    let rows = ((high - low) / ROW) as usize + 2;
    let pieces: Vec<Piece> =
        members.iter().map(|wrapped| Piece::new(compiled, joins, wrapped, low, rows)).collect();
    // The fork: where a piece first reaches farthest inwards.
    let inmost = |piece: &Piece| {
        let inner = |k: usize| piece.reach[k].map_or(f64::NEG_INFINITY, |r| piece.inner(r));
        let most = (0..rows).map(inner).fold(f64::NEG_INFINITY, f64::max);
        (0..rows).find(|k| inner(*k) > most - SAME).unwrap_or(0)
    };
    let fork = pieces.iter().map(inmost).max().unwrap_or(0);
    let course = Course::new(first, low, low + fork as f64 * ROW);
    let sections = Sections::new(first.body, low - DOWN, high - DOWN);
    let gap = members.iter().map(|m| m.gap).fold(f64::INFINITY, f64::min).max(0.005);
    // Of each row the widest leg counts for both.
    let widest = |k: usize, of: &dyn Fn([f64; 2]) -> f64| {
        let side = |sign: f64, side: Side| {
            pieces
                .iter()
                .filter(|p| p.sign == sign && p.wrapped.side == side)
                .filter_map(|p| p.reach[k])
                .map(of)
                .fold(0.0, f64::max)
        };
        let leg =
            |sign| side(sign, Side::Before) + side(sign, Side::Behind) + side(sign, Side::Around);
        f64::max(leg(1.0), leg(-1.0))
    };
    let rings: Vec<Ring> = (0..rows)
        .map(|k| {
            let section = k.min(sections.count() - 1);
            let half = widest(k.max(fork), &|[out, inner]| out + inner) + MEETING;
            let wanted = (2.0 * half - sections.girth(section)) / TAU;
            sections.ring(section, gap.max(wanted))
        })
        .collect();
    for piece in &pieces {
        let Some((points, radii)) = piece.wrapped.limb() else { continue };
        let tube = |k: usize| -> (Point3<f64>, f64) {
            let at = course.at(low + k as f64 * ROW);
            let n = points.partition_point(|p| p.y > at).clamp(1, points.len() - 1);
            let (a, b) = (points[n - 1], points[n]);
            let t = if a.y > b.y { ((a.y - at) / (a.y - b.y)).clamp(0.0, 1.0) } else { 0.0 };
            let leg = radii[n - 1] + t * (radii[n] - radii[n - 1]);
            let round = 2.0 * widest(k, &|r| r[0]).max(widest(k, &|r| r[1])) + 2.0 * MEETING;
            let radius = (leg + gap).max(round / TAU);
            let mut middle = a + (b - a) * t;
            // The two tubes stand side by side.
            middle.x = (middle.x * piece.sign).max(radius + MEETING) * piece.sign;
            (middle, radius)
        };
        let tubes: Vec<(Point3<f64>, f64)> = (0..rows).map(|k| tube(k.min(fork))).collect();
        for (particle, [x, y]) in drawing(compiled, piece.wrapped.panel(compiled)) {
            let at = height(piece.wrapped, y);
            let out = outwards(piece.wrapped, piece.sign, x);
            let row = ((at - low) / ROW).max(0.0);
            let place = |k: usize| {
                let (middle, radius) = tubes[k];
                let angle = piece.angle(out, radius);
                let (sin, cos) = (libm::sin(angle), libm::cos(angle));
                // The folds lie where the other leg is not.
                let reach = radius + course.bulge(at) * 0.5 * (1.0 + sin);
                let leg = [middle.x + piece.sign * reach * sin, middle.z + reach * cos];
                let ring = &rings[k];
                let trunk = ring.point(piece.sign * piece.walk(out, k, ring.girth()));
                let share = ((k as f64 - fork as f64) * ROW / JOINING).clamp(0.0, 1.0);
                let share = share * share * (3.0 - 2.0 * share);
                [0, 1].map(|c| leg[c] + share * (trunk[c] - leg[c]))
            };
            let k = (row as usize).min(rows - 2);
            let t = (row - k as f64).clamp(0.0, 1.0);
            let (a, b) = (place(k), place(k + 1));
            positions[particle] =
                Point3::new(a[0] + t * (b[0] - a[0]), course.at(at), a[1] + t * (b[1] - a[1]));
        }
    }
}

/// Where the heights of a leg begin.
struct Course {
    /// Height of the fork, m.
    fork: f64,
    /// Height that is left for a length of leg, as a share of it.
    share: f64,
    /// Depth of its folds, m.
    depth: f64,
}

impl Course {
    /// The course of legs that belong between the heights `low` and `fork`.
    fn new(wrapped: &Wrapped, low: f64, fork: f64) -> Self {
        let ankle = wrapped.limb().and_then(|(points, _)| points.last()).map_or(0.0, |p| p.y);
        let room = fork - DOWN - (low - DOWN).max(ankle + ANKLE);
        let share = (room / (fork - low).max(ROW)).clamp(0.5, 1.0);
        // A sine of slope a along the leg is longer than its run by a share of a²/4.
        let slope = 2.0 * (1.0 / share - 1.0).sqrt();
        Course { fork, share, depth: 2.0 * slope * share * FOLD / TAU }
    }

    /// Where a height begins, m.
    fn at(&self, height: f64) -> f64 {
        let below = (self.fork - height).max(0.0);
        height - DOWN + below * (1.0 - self.share)
    }

    /// How far the cloth of a height stands off its tube in a fold, m.
    fn bulge(&self, height: f64) -> f64 {
        let below = (self.fork - height).max(0.0);
        0.5 * self.depth * (1.0 - libm::cos(below / FOLD * TAU))
    }
}

impl<'a> Piece<'a> {
    fn new(
        compiled: &Compiled,
        joins: &Joins,
        wrapped: &'a Wrapped<'a>,
        low: f64,
        rows: usize,
    ) -> Self {
        let sign = if centre(wrapped.body, wrapped.landmark).x < 0.0 { -1.0 } else { 1.0 };
        let at = |[x, y]: [f64; 2]| [outwards(wrapped, sign, x), height(wrapped, y)];
        let reach = reach(compiled, joins, wrapped.number, &at, (low, ROW, rows));
        let reach = reach.into_iter().map(|row| row.map(|[least, most]| [most, -least])).collect();
        Piece { wrapped, sign, reach }
    }

    /// How far a row reaches to the inside of its leg, m.
    fn inner(&self, [out, inner]: [f64; 2]) -> f64 {
        if self.wrapped.side == Side::Around { out + inner } else { inner }
    }

    /// Where round a leg a place lies, from the front over the outside, rad.
    fn angle(&self, out: f64, radius: f64) -> f64 {
        match self.wrapped.side {
            Side::Behind => 0.5 * TAU - out / radius,
            Side::Around => 0.25 * TAU - out / radius,
            Side::Before | Side::Beside => out / radius,
        }
    }

    /// How far round the trunk a place of row `k` lies, from the middle of the front over the
    /// outside of its leg, m.
    fn walk(&self, out: f64, k: usize, girth: f64) -> f64 {
        let reach = self.reach[k].unwrap_or_default();
        match self.wrapped.side {
            Side::Behind => 0.5 * girth - (out + reach[1] + 0.5 * MEETING),
            // It spans from middle to middle.
            Side::Around => {
                let whole = reach[0] + reach[1] + MEETING;
                (reach[0] - out + 0.5 * MEETING) * (0.5 * girth / whole)
            }
            Side::Before | Side::Beside => out + reach[1] + 0.5 * MEETING,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::surface::{Landmark, SurfaceKind};

    /// A leg of 80 cm from the crotch to the floor, whose ankle is at 8 cm.
    fn body() -> Surface {
        let mut body = Surface { kind: SurfaceKind::Body, ..Default::default() };
        for (name, x) in [("leg.left", 0.09), ("leg.right", -0.09)] {
            let points = vec![Point3::new(x, 0.8, 0.0), Point3::new(x, 0.08, 0.0)];
            let limb = Landmark::Limb { points, radii: vec![0.08, 0.04] };
            body.landmarks.insert(name.to_owned(), limb);
        }
        body
    }

    fn leg<'a>(body: &'a Surface, side: Side) -> Wrapped<'a> {
        Wrapped {
            number: 0,
            body,
            landmark: "leg.left",
            level: None,
            side,
            anchor: 0.0,
            gap: 0.03,
            whole: None,
        }
    }

    /// Legs that reach the floor begin with their hems over the ankles; the cloth of each fold is as
    /// long as it is drawn, to 4 %: of the sine's length the term -3a⁴/64 is left out, with a = 0.96.
    #[test]
    fn long_legs_begin_pushed_up_in_folds_of_the_right_length() {
        let body = body();
        let course = Course::new(&leg(&body, Side::Before), 0.0, 0.75);
        assert!(course.at(0.0) >= 0.08 + ANKLE - 1e-12);
        assert!((course.at(0.9) - 0.85).abs() < 1e-12, "above the fork all is let down");
        let steps = 1000;
        let along = |k: usize| 0.75 - FOLD * k as f64 / steps as f64;
        let length: f64 = (0..steps)
            .map(|k| {
                let (a, b) = (along(k), along(k + 1));
                libm::hypot(course.at(a) - course.at(b), course.bulge(a) - course.bulge(b))
            })
            .sum();
        assert!((length / FOLD - 1.0).abs() < 0.04, "{length}");
        let shorts = Course::new(&leg(&body, Side::Before), 0.5, 0.75);
        assert!(shorts.depth < 1e-6 && (shorts.at(0.5) - 0.45).abs() < 1e-12);
    }

    /// The outside of the left leg is to the right in the drawing of a front, to the left in that of
    /// a back.
    #[test]
    fn fronts_and_backs_meet_at_the_outside() {
        let body = body();
        assert!(outwards(&leg(&body, Side::Before), 1.0, 0.1) > 0.0);
        assert!(outwards(&leg(&body, Side::Behind), 1.0, -0.1) > 0.0);
        assert!(outwards(&leg(&body, Side::Before), -1.0, -0.1) > 0.0);
    }
}
