//! Layers that cut each other are drawn apart by the line along which they do so: every end of it
//! is moved so that it becomes shorter, until nothing is left of it (Volino and Magnenat-Thalmann
//! 2006). Nothing need be known of how they came there, and of which side is the right one.

use crate::drape::hold::Pull;
use nalgebra::{Matrix3, Vector3};

type V = Vector3<f64>;

/// Least share of an edge's direction along the normal of the face it goes through: one that lies
/// nearly in the face would be sent far along it.
const UPRIGHT: f64 = 0.2;

/// Largest way that is asked for in a step, as a multiple of the distance that layers keep.
const STEP: f64 = 1.0;

/// Pulls on the knots of pairs of faces that cut each other. `stiffness` and `apart` of a knot:
/// N/m, and the distance it keeps from other layers, m.
pub(super) fn pulls(
    cuts: &[[[u32; 3]; 2]],
    x: &[V],
    stiffness: impl Fn(u32) -> f64,
    apart: impl Fn(u32) -> f64,
) -> Vec<Pull> {
    let mut pulls = Vec::new();
    for [f, g] in cuts {
        for (face, through) in [(f, g), (g, f)] {
            for k in 0..3 {
                let edge = [face[k], face[(k + 1) % 3], face[(k + 2) % 3]];
                let Some((share, weights, way)) = shorten(&edge, through, x) else { continue };
                let asked = way * (STEP * apart(edge[0]) / way.norm().max(1.0));
                let mut pull = |knot: u32, weight: f64| {
                    let stiff = stiffness(knot);
                    let block = Matrix3::from_diagonal_element(stiff * weight.abs());
                    pulls.push((knot, asked * (stiff * weight), block));
                };
                pull(edge[0], 1.0 - share);
                pull(edge[1], share);
                for (knot, weight) in through.iter().zip(weights) {
                    pull(*knot, -weight);
                }
            }
        }
    }
    pulls
}

/// Where the edge from the first to the second corner of a face goes through another face: the
/// share of the edge, the weights of the other's corners, and the movement of the edge by which
/// the line in which the two faces cut each other becomes shorter most at this end.
fn shorten(face: &[u32; 3], through: &[u32; 3], x: &[V]) -> Option<(f64, [f64; 3], V)> {
    let [p, q, r] = face.map(|k| x[k as usize]);
    let [a, b, c] = through.map(|k| x[k as usize]);
    let normal = (b - a).cross(&(c - a));
    let double = normal.norm();
    let along = q - p;
    if !(double > 1e-14 && along.norm_squared() > 1e-18) {
        return None;
    }
    let n = normal / double;
    let (above, below) = ((p - a).dot(&n), (q - a).dot(&n));
    if !(above * below < 0.0) {
        return None;
    }
    let share = above / (above - below);
    let at = p + along * share;
    let part = |u: &V, v: &V| (u - at).cross(&(v - at)).dot(&n) / double;
    let weights = [part(&b, &c), part(&c, &a), part(&a, &b)];
    if weights.iter().any(|w| !(*w >= 0.0)) {
        return None;
    }
    // The line runs from here into the face.
    let e = along.normalize();
    let line = n.cross(&(along.cross(&(r - p))));
    let inward = (r - p) - e * (r - p).dot(&e);
    let line = line * line.dot(&inward).signum();
    let line = line / line.norm().max(1e-18);
    let steep = e.dot(&n);
    let steep = steep.abs().max(UPRIGHT).copysign(steep);
    Some((share, weights, line - n * (e.dot(&line) / steep)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A pyramid whose tip has come through a table: the pulls on its edges bring the tip back, and
    /// those on the table are as large the other way.
    #[test]
    fn a_tip_is_drawn_back() {
        let x: Vec<V> = [
            (0.0, 0.0, 0.1),
            (1.0, 0.0, -1.0),
            (-0.5, 0.9, -1.0),
            (-0.5, -0.9, -1.0),
            (5.0, 0.0, 0.0),
            (-5.0, 6.0, 0.0),
            (-5.0, -6.0, 0.0),
        ]
        .map(|(x, y, z)| V::new(x, y, z))
        .into();
        let table = [4, 5, 6];
        let cuts: Vec<[[u32; 3]; 2]> =
            [[0, 1, 2], [0, 2, 3], [0, 3, 1]].map(|side| [side, table]).into();
        let pulls = pulls(&cuts, &x, |_| 1.0, |_| 0.01);
        let sum = |knots: &[u32]| -> V {
            pulls.iter().filter(|p| knots.contains(&p.0)).map(|p| p.1).sum()
        };
        let (tip, below) = (sum(&[0, 1, 2, 3]), sum(&table));
        assert!(tip.z < -1e-3 && tip.xy().norm() < 0.1 * tip.z.abs(), "{tip}");
        assert!((tip + below).norm() < 1e-12);
    }
}
