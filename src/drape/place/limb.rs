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
    let thick = Thickness::new(wrapped, (points, radii), start, axis);
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
                let limb = thick.at(station(top - k as f64 * ROW, moved));
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
        let angle = x / r;
        start + axis * station(y, moved) + (out * libm::cos(angle) + right * libm::sin(angle)) * r
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

/// How far a limb with its hand or foot reaches from a straight line through it.
struct Thickness {
    /// Of each centimetre along the line, m.
    rows: Vec<f64>,
}

impl Thickness {
    fn new(
        wrapped: &Wrapped,
        (points, radii): (&[Point3<f64>], &[f64]),
        start: Point3<f64>,
        axis: Vector3<f64>,
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
        let mut rows: Vec<f64> = Vec::new();
        for (p, r) in all.chain(skin.map(|(p, _)| (*p, 0.0))) {
            let along = (p - start).dot(&axis);
            let away = (p - start - axis * along).norm() + r;
            let row = (along / ROW).round().max(0.0) as usize;
            if row >= rows.len() {
                rows.resize(row + 1, 0.0);
            }
            rows[row] = rows[row].max(away);
        }
        // Where nothing of it lies the limb goes on as before.
        for k in 1..rows.len() {
            if rows[k] == 0.0 {
                rows[k] = rows[k - 1];
            }
        }
        Thickness { rows }
    }

    /// Within two centimetres of a place along the line, m; at both ends the limb goes on.
    fn at(&self, station: f64) -> f64 {
        let last = self.rows.len().saturating_sub(1);
        let row = ((station / ROW).round().max(0.0) as usize).min(last);
        let near = &self.rows[row.saturating_sub(2)..(row + 3).min(self.rows.len())];
        near.iter().copied().fold(0.0, f64::max)
    }
}
