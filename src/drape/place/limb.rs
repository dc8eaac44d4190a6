//! Panels wrapped round an arm or a leg: sleeves with their cuffs, legs of one piece.

use super::family::Limb;
use super::joins::{Joins, reach};
use super::layplan::Lay;
use super::{Wrapped, centre};
use crate::body::surface::BodyPart;
use crate::mesh::compiled::Compiled;
use nalgebra::{Point3, Vector3};
use std::collections::BTreeSet;
use std::f64::consts::TAU;

/// Room left between the edges that meet under the limb, as a share of the width.
const MEETING: f64 = 1.05;
/// Height of the rows whose widths are compared, m.
const ROW: f64 = 0.01;
/// Cloth of limbs begins at least this far from the cloth of the trunk, m.
const CLEAR: f64 = 0.015;
/// Room between a limb and cloth too narrow for the gap asked for, m. Were it farther off, its edges
/// would lie on one side of the limb and meet there.
const NARROW: f64 = 0.01;
/// Farthest way that a piece is moved along the limb to be clear of the trunk, m.
const FARTHEST: f64 = 0.25;

/// Wraps a sleeve and what is sewn on to it. It is moved outwards along the limb until it is clear
/// of the panels that are `done` already; sewing brings it back.
pub(super) fn wrap(
    compiled: &Compiled,
    joins: &Joins,
    limb: &Limb,
    done: &[bool],
    positions: &mut [Point3<f64>],
) {
    let wrapped = limb.root;
    let Some((points, radii)) = wrapped.limb() else { return };
    let (start, end) = (points[0], points[points.len() - 1]);
    let axis = (end - start).normalize();
    let lateral = if end.x >= 0.0 { Vector3::x() } else { -Vector3::x() };
    let out = (lateral - axis * lateral.dot(&axis)).normalize();
    let right = out.cross(&axis);

    // A limb of the body begins where its level lies along the axis.
    let level = wrapped.level.map_or(0.0, |name| (centre(wrapped.body, name) - start).dot(&axis));
    let course = Course::new(wrapped, (points, radii), start, [axis, out, right]);
    let own = std::iter::once((wrapped.number, Lay::default()));
    let pieces: Vec<(usize, Lay)> = own.chain(limb.led.iter().copied()).collect();
    let places: Vec<(usize, [f64; 2])> = pieces
        .iter()
        .flat_map(|(panel, lay)| {
            let range = compiled.panels[*panel].particles.range();
            range.map(|k| (k, lay.at(joins.drawn[k])))
        })
        .collect();
    let top = places.iter().map(|(_, p)| p[1]).fold(f64::NEG_INFINITY, f64::max);
    let low = places.iter().map(|(_, p)| p[1]).fold(f64::INFINITY, f64::min);
    if top < low {
        return;
    }
    let rows = ((top - low) / ROW) as usize + 2;
    let mut wide = vec![0.0_f64; rows];
    for (panel, lay) in &pieces {
        // Rows run down from the top.
        let down = |p: [f64; 2]| {
            let [x, y] = lay.at(p);
            [x, top - y]
        };
        for (wide, own) in
            wide.iter_mut().zip(reach(compiled, joins, *panel, &down, (0.0, ROW, rows)))
        {
            let Some([from, to]) = own else { continue };
            *wide = wide.max(-from).max(to);
        }
    }
    // From the top to the widest row the tube is as wide as there: a cap is part of the tube.
    let widest = (0..rows).fold(0, |best, k| if wide[k] > wide[best] { k } else { best });
    let station = |y: f64, moved: f64| level + wrapped.anchor - y + moved;
    let radii = |moved: f64| {
        let mut radius: Vec<f64> = (0..rows)
            .map(|k| {
                let (_, limb) = course.at(station(top - k as f64 * ROW, moved));
                let round = 2.0 * wide[k.max(widest)] * MEETING / TAU;
                round.max(limb + wrapped.gap.min(NARROW))
            })
            .collect();
        for k in (0..rows - 1).rev() {
            radius[k] = radius[k].max(radius[k + 1] - 0.5 * ROW);
        }
        radius
    };
    let at = |[x, y]: [f64; 2], (moved, radius): (f64, &[f64])| {
        let row = (top - y) / ROW;
        let k = (row as usize).min(rows - 2);
        let t = (row - k as f64).clamp(0.0, 1.0);
        let r = radius[k] + t * (radius[k + 1] - radius[k]);
        let along = station(y, moved);
        let k = (along / ROW).floor();
        let (a, b) = (course.at(k * ROW).0, course.at((k + 1.0) * ROW).0);
        let middle = [0, 1].map(|c| a[c] + (along / ROW - k) * (b[c] - a[c]));
        let angle = x / r;
        let [o, w] = [middle[0] + r * libm::cos(angle), middle[1] + r * libm::sin(angle)];
        start + axis * along + out * o + right * w
    };

    let cell =
        |p: &Point3<f64>| [p.x, p.y, p.z].map(|c| (c / CLEAR).floor().clamp(-1e6, 1e6) as i32);
    let mut taken = BTreeSet::new();
    for (number, other) in compiled.panels.iter().enumerate() {
        if done[number] {
            taken.extend(other.particles.range().map(|k| cell(&positions[k])));
        }
    }
    let collides = |moved: f64, radius: &[f64]| {
        places.iter().any(|(_, p)| {
            let [i, j, k] = cell(&at(*p, (moved, radius)));
            (-1..=1)
                .any(|a| (-1..=1).any(|b| (-1..=1).any(|c| taken.contains(&[i + a, j + b, k + c]))))
        })
    };
    let (mut moved, mut radius) = (0.0, radii(0.0));
    while moved < FARTHEST && collides(moved, &radius) {
        moved += 0.01;
        radius = radii(moved);
    }
    for (particle, place) in places {
        positions[particle] = at(place, (moved, &radius));
    }
}

/// Where a limb with its hand or foot lies about the straight line through it.
struct Course {
    /// Of each centimetre along the line: the middle, outwards and to the right, and how far the
    /// limb reaches from there, m.
    rows: Vec<([f64; 2], f64)>,
}

impl Course {
    fn new(
        wrapped: &Wrapped,
        (points, radii): (&[Point3<f64>], &[f64]),
        start: Point3<f64>,
        [axis, out, right]: [Vector3<f64>; 3],
    ) -> Self {
        let body = wrapped.body;
        let part = match wrapped.landmark {
            "arm.left" => Some(BodyPart::LeftArm),
            "arm.right" => Some(BodyPart::RightArm),
            "leg.left" => Some(BodyPart::LeftLeg),
            "leg.right" => Some(BodyPart::RightLeg),
            _ => None,
        };
        let skin = body.vertices.iter().zip(&body.parts).filter(|(_, p)| Some(**p) == part);
        let all = points.iter().zip(radii).map(|(p, r)| (*p, *r));
        let mut slabs: Vec<Vec<([f64; 2], f64)>> = Vec::new();
        for (p, r) in all.chain(skin.map(|(p, _)| (*p, 0.0))) {
            let off = p - start;
            let row = (off.dot(&axis) / ROW).round().max(0.0) as usize;
            if row >= slabs.len() {
                slabs.resize(row + 1, Vec::new());
            }
            slabs[row].push(([off.dot(&out), off.dot(&right)], r));
        }
        let mut rows: Vec<([f64; 2], f64)> = Vec::new();
        for slab in &slabs {
            // Where nothing of it lies the limb goes on as before.
            let Some(row) = enclose(slab).or(rows.last().copied()) else { continue };
            rows.push(row);
        }
        Course { rows }
    }

    /// Middle and reach of all within two centimetres of a place along the line, m; at both ends the
    /// limb goes on.
    fn at(&self, station: f64) -> ([f64; 2], f64) {
        let last = self.rows.len().saturating_sub(1);
        let row = ((station / ROW).round().max(0.0) as usize).min(last);
        let near = &self.rows[row.saturating_sub(2)..(row + 3).min(self.rows.len())];
        enclose(near).unwrap_or_default()
    }
}

/// The middle of discs and how far they reach from it.
fn enclose(discs: &[([f64; 2], f64)]) -> Option<([f64; 2], f64)> {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for (p, r) in discs {
        for c in 0..2 {
            low[c] = low[c].min(p[c] - r);
            high[c] = high[c].max(p[c] + r);
        }
    }
    let middle = [0, 1].map(|c| 0.5 * (low[c] + high[c]));
    let reach = |(p, r): &([f64; 2], f64)| libm::hypot(p[0] - middle[0], p[1] - middle[1]) + r;
    (!discs.is_empty()).then(|| (middle, discs.iter().map(reach).fold(0.0, f64::max)))
}
