//! Panels that neither text nor family places: each is laid against the neighbour it is sewn to.

use super::drawing;
use super::joins::{Joins, mean};
use crate::mesh::compiled::Compiled;
use nalgebra::{Matrix3, Point3, Vector3};

/// Lays every panel that is not `done` against those that are, as long as a seam leads to one.
/// What no seam leads to stays at the origin's plane, laid flat.
pub(super) fn follow(
    compiled: &Compiled,
    joins: &Joins,
    done: &mut [bool],
    positions: &mut [Point3<f64>],
) {
    loop {
        let mut progress = false;
        for number in 0..compiled.panels.len() {
            if done[number] {
                continue;
            }
            let led = joins.of(number).filter(|seen| done[seen.other]);
            let pairs: Vec<[usize; 2]> =
                led.flat_map(|seen| seen.pairs().collect::<Vec<_>>()).collect();
            if pairs.len() < 2 {
                continue;
            }
            lay_against(compiled, number, &pairs, joins, positions);
            done[number] = true;
            progress = true;
        }
        if !progress {
            break;
        }
    }
    for (number, panel) in compiled.panels.iter().enumerate() {
        if !done[number] {
            for (k, [x, y]) in drawing(compiled, panel) {
                positions[k] = Point3::new(x, y + 1.0, 0.5);
            }
            done[number] = true;
        }
    }
}

/// Moves panel `number` rigidly so that its seam points come near their partners and it goes on
/// where the partner ends (best rotation: Kabsch 1976).
fn lay_against(
    compiled: &Compiled,
    number: usize,
    pairs: &[[usize; 2]],
    joins: &Joins,
    positions: &mut [Point3<f64>],
) {
    let panel = &compiled.panels[number];
    let flat: Vec<Point3<f64>> =
        drawing(compiled, panel).map(|(_, [x, y])| Point3::new(x, y, 0.0)).collect();
    let first = panel.particles.range().start;
    let mut own: Vec<Point3<f64>> = pairs.iter().map(|[a, _]| flat[a - first]).collect();
    let mut goal: Vec<Point3<f64>> = pairs.iter().map(|[_, b]| positions[*b]).collect();
    // One more pair turns the panel away from its partner: own middle against the partner's
    // middle mirrored in the seam.
    let middle = mean(&flat);
    let partner = joins.owner(pairs[0][1]);
    let beyond: Vec<Point3<f64>> =
        compiled.panels[partner].particles.range().map(|k| positions[k]).collect();
    let (seam_own, seam_goal) = (mean(&own), mean(&goal));
    let away = seam_goal - mean(&beyond);
    // What several hold, a gusset, is turned by them.
    let one = pairs.iter().all(|[_, other]| joins.owner(*other) == partner);
    if one && away.norm() > 1e-9 {
        let reach = (middle - seam_own).norm();
        for _ in 0..pairs.len().div_ceil(2) {
            own.push(middle);
            goal.push(seam_goal + away.normalize() * reach);
        }
    }
    let (from, to) = (mean(&own), mean(&goal));
    let mut spread = Matrix3::zeros();
    for (a, b) in own.iter().zip(&goal) {
        spread += (b - to) * (a - from).transpose();
    }
    let svd = spread.svd(true, true);
    let (Some(u), Some(v)) = (svd.u, svd.v_t) else { return };
    let mut turn = u * v;
    if turn.determinant() < 0.0 {
        turn = u * Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, -1.0)) * v;
    }
    for (k, place) in panel.particles.range().zip(&flat) {
        positions[k] = to + turn * (place - from);
    }
}
