//! Panels wrapped round an arm or a leg: sleeves with their cuffs, legs of one piece.

use super::centre;
use super::family::Limb;
use super::joins::{Joins, reach};
use super::layplan::Lay;
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
    let thickest = radii.iter().copied().fold(0.0, f64::max);
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
    let mut radius: Vec<f64> =
        wide.iter().map(|half| (2.0 * half * MEETING / TAU).max(thickest + wrapped.gap)).collect();
    for k in 0..widest {
        radius[k] = radius[widest];
    }
    for k in (0..rows - 1).rev() {
        radius[k] = radius[k].max(radius[k + 1] - 0.5 * ROW);
    }
    let at = |[x, y]: [f64; 2], moved: f64| {
        let row = (top - y) / ROW;
        let k = (row as usize).min(rows - 2);
        let t = (row - k as f64).clamp(0.0, 1.0);
        let r = radius[k] + t * (radius[k + 1] - radius[k]);
        let station = level + wrapped.anchor - y + moved;
        let angle = x / r;
        start + axis * station + (out * libm::cos(angle) + right * libm::sin(angle)) * r
    };

    let cell =
        |p: &Point3<f64>| [p.x, p.y, p.z].map(|c| (c / CLEAR).floor().clamp(-1e6, 1e6) as i32);
    let mut taken = BTreeSet::new();
    for (number, other) in compiled.panels.iter().enumerate() {
        if done[number] {
            taken.extend(other.particles.range().map(|k| cell(&positions[k])));
        }
    }
    let collides = |moved: f64| {
        places.iter().any(|(_, p)| {
            let [i, j, k] = cell(&at(*p, moved));
            (-1..=1)
                .any(|a| (-1..=1).any(|b| (-1..=1).any(|c| taken.contains(&[i + a, j + b, k + c]))))
        })
    };
    let mut moved = 0.0;
    while moved < FARTHEST && collides(moved) {
        moved += 0.01;
    }
    for (particle, place) in places {
        positions[particle] = at(place, moved);
    }
}
