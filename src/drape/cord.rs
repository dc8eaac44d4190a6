//! Cords: elastics, drawstrings and ties, as springs between knots that resist stretching alone.
//!
//! A cord along edges is shared out: each stretch of the edge has the same share of its length at
//! rest, so that a drawstring does not slide in its casing. Its force has a bound, so that an edge that
//! is still far from its length is drawn there gently. Cloth that is drawn together along a cord puckers
//! finer than any grid shows; there its own threads give way, and the folds stand in the cloth beside.

use super::membrane::Triangle;
use super::tension::Spring;
use super::weld::Weld;
use crate::garment::seam::CordKind;
use crate::mesh::compiled::{Compiled, MeshCord};

/// Tensile stiffness of an elastic per width, N/m: a band of 25 mm takes 7 N at half its length more.
const ELASTIC: f64 = 560.0;

/// Mass of an elastic per area, kg/m².
const ELASTIC_MASS: f64 = 0.6;

/// Tensile stiffness of a cord, N: 1 % under 2 N.
const STIFFNESS: f64 = 200.0;

/// Mass of a cord per length, kg/m: cotton of 3 mm.
const MASS: f64 = 4.0e-3;

/// Largest forces of an elastic, of a drawstring and of a tie, N.
const PULL: [f64; 3] = [10.0, 6.0, 1.0];

/// What is left of the stiffness of threads along a cord.
const PUCKERED: f64 = 0.1;

/// Lets the threads give way that run along cords.
pub fn pucker(
    compiled: &Compiled,
    weld: &Weld,
    springs: &mut [Spring],
    triangles: &mut [Triangle],
) {
    let ordered = |[a, b]: [u32; 2]| [a.min(b), a.max(b)];
    let along = compiled.cords.iter().filter(|cord| cord.kind != CordKind::Tie);
    let mut sides: Vec<[u32; 2]> = along
        .flat_map(|cord| &cord.pairs)
        .map(|pair| ordered(pair.map(|k| weld.knot[k as usize])))
        .collect();
    if sides.is_empty() {
        return;
    }
    sides.sort_unstable();
    let drawn = |side: [u32; 2]| sides.binary_search(&ordered(side)).is_ok();
    for spring in springs.iter_mut().filter(|spring| drawn(spring.ends)) {
        spring.stiffness *= PUCKERED;
    }
    for triangle in triangles {
        let [a, b, c] = triangle.corners;
        if [[a, b], [b, c], [c, a]].into_iter().any(drawn) {
            triangle.tensile = triangle.tensile.map(|k| k * PUCKERED);
        }
    }
}

/// Stiffness, mass per length and largest force of a cord: N, kg/m, N.
fn law(cord: &MeshCord) -> [f64; 3] {
    let [elastic, drawstring, tie] = PULL;
    match cord.kind {
        CordKind::Elastic => [ELASTIC * cord.width, ELASTIC_MASS * cord.width, elastic],
        CordKind::Drawstring => [STIFFNESS, MASS, drawstring],
        CordKind::Tie => [STIFFNESS, MASS, tie],
    }
}

/// A cloth of which the ties are tied.
pub fn tied(compiled: &Compiled) -> Compiled {
    let mut compiled = compiled.clone();
    compiled.cords.append(&mut compiled.ties);
    compiled
}

/// The springs of all cords; what they weigh is added to the masses of the knots, kg.
pub fn springs(compiled: &Compiled, weld: &Weld, mass: &mut [f64]) -> Vec<Spring> {
    let mut springs = Vec::new();
    for cord in &compiled.cords {
        let [stiffness, weight, most] = law(cord);
        for (pair, &rest) in cord.pairs.iter().zip(&cord.rests) {
            let ends = pair.map(|k| weld.knot[k as usize]);
            if ends[0] == ends[1] || !(rest > 0.0) {
                continue;
            }
            for end in ends {
                mass[end as usize] += 0.5 * weight * rest;
            }
            springs.push(Spring {
                ends,
                slots: None,
                rest,
                stiffness: stiffness / rest,
                warp: false,
                most: Some(most),
            });
        }
    }
    springs
}

#[cfg(test)]
mod tests {
    use super::super::step::{Manner, Workshop};
    use super::super::swatch::{Nothing, fabric, rectangles};
    use super::*;
    use crate::garment::seam::PinTarget;
    use crate::mesh::compiled::MeshPin;
    use nalgebra::Vector3;

    /// A strip of 30 x 8 cm, waved a little and held along one long edge, with a cord along the other:
    /// this comes to be no longer than said, but for what the cord's own force stretches it.
    #[test]
    fn a_cord_draws_its_edge_to_its_length() {
        let (n, m, h) = (30, 8, 0.01);
        for (kind, width, slack) in
            [(CordKind::Drawstring, 0.0, 0.02), (CordKind::Elastic, 0.025, 0.15)]
        {
            let mut compiled = rectangles(1, [n, m], h, fabric(2e-6));
            let pairs: Vec<[u32; 2]> = (0..n as u32).map(|k| [k, k + 1]).collect();
            let rests = vec![0.7 * h; n];
            let held = (0..=n).map(|i| (m * (n + 1) + i) as u32).collect();
            compiled.pins.push(MeshPin { points: held, to: PinTarget::Here });
            compiled.cords.push(MeshCord { name: String::new(), kind, width, pairs, rests });
            let waved = |p: &[f64; 2]| Vector3::new(p[0], p[1], 2e-3 * libm::sin(60.0 * p[0]));
            let start: Vec<_> = compiled.particles.iter().map(waved).collect();
            let weld = Weld::new(compiled.particles.len(), std::iter::empty());
            let mut shop = Workshop::new(&compiled, &[], &Nothing, weld, &start);
            let manner =
                Manner { gravity: 0.0, air: 0.0, calm: 5.0, layers: false, ..Manner::default() };
            for _ in 0..400 {
                shop.step(&manner).unwrap();
            }
            let row = |j: usize| -> f64 {
                let at = |i: usize| shop.x[j * (n + 1) + i];
                (0..n).map(|i| (at(i + 1) - at(i)).norm()).sum()
            };
            assert!(row(0) < 0.21 * (1.0 + slack), "{kind:?}: {}", row(0));
            assert!(row(0) > 0.5 * 0.21 && row(m) > 0.299, "{kind:?}: {} {}", row(0), row(m));
        }
    }

    /// The force of a cord is the slope of its energy, slack, taut, and where it is bounded.
    #[test]
    fn a_cord_resists_stretching_alone_and_pulls_no_harder_than_its_bound() {
        let spring = Spring {
            ends: [0, 1],
            slots: None,
            rest: 0.01,
            stiffness: 2e4,
            warp: false,
            most: Some(6.0),
        };
        let a = Vector3::new(0.1, 0.0, 0.0);
        for (length, wanted) in [(0.008, 0.0), (0.0101, 2.0), (0.05, 6.0)] {
            let b = |more: f64| a + Vector3::new(0.6, 0.8, 0.0) * (length + more);
            let (force, _) = spring.pull(&a, &b(0.0));
            let slope = (spring.energy(&a, &b(1e-7)) - spring.energy(&a, &b(-1e-7))) / 2e-7;
            assert!((force.norm() - wanted).abs() < 1e-9, "{force}");
            assert!((slope - wanted).abs() < 1e-5, "{slope}");
        }
    }
}
