//! Creases: folds that rest at an angle.
//!
//! The bending term ½ s |Σ cᵢ xᵢ|² of a fold becomes ½ s |Σ cᵢ xᵢ − b n|² with b = 2 sin θ/2, the
//! length that the sum has at the angle of rest, and n the direction in which it then points. The
//! stiffness stays what it was; the rest is a force s b cᵢ n at each knot, in which n is taken from
//! the beginning of a step. A creased fold may lie flat on itself, so that its resistance is not
//! sharpened.

use super::bending::Fold;
use super::elastic::Places;
use nalgebra::Vector3;

/// A fold with its rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crease {
    fold: Fold,
    /// Knots of the edge along which it is folded, and of the cloth to both sides of it, so that
    /// `across` × `edge` looks out of the face.
    edge: [u32; 2],
    across: [u32; 2],
    /// b; positive where the face is folded on itself.
    rest: f64,
}

impl Crease {
    /// A crease along an edge to whose left (or right) the first of the `far` knots lies, resting
    /// at an angle, rad.
    pub fn new(fold: Fold, edge: [u32; 2], left: bool, far: [u32; 2], angle: f64) -> Self {
        let across = if left { far } else { [far[1], far[0]] };
        let angle = angle.clamp(-std::f64::consts::PI, std::f64::consts::PI);
        Crease { fold, edge, across, rest: 2.0 * libm::sin(0.5 * angle) }
    }

    /// b n: how the fold is bent at rest, given how it lies.
    fn target(&self, x: &Places) -> Vector3<f64> {
        let way = |[a, b]: [u32; 2]| x[b as usize] - x[a as usize];
        let out = way(self.across).cross(&way(self.edge));
        // While it is open its normal leads; once it is shut both sides lie on each other, have
        // no normal between them, and the way it is bent leads.
        let size = way(self.edge).norm() * self.reach();
        let sense = if self.rest < 0.0 { -1.0 } else { 1.0 };
        let lead = out * (sense / size.max(f64::MIN_POSITIVE)) + self.fold.bend(x) * 0.5;
        let long = lead.norm();
        if long < 1e-9 { Vector3::zeros() } else { lead * (self.rest.abs() / long) }
    }

    /// How far apart the knots on both sides of the edge lie while it is flat, m.
    fn reach(&self) -> f64 {
        let weight = |knot: u32| {
            let mine = self.fold.terms().filter(|(k, _)| *k == knot).map(|(_, w)| w);
            mine.sum::<f64>().abs().max(1e-9)
        };
        self.across.iter().map(|&knot| 1.0 / weight(knot)).sum()
    }

    /// What its rest adds to the energy of its fold, J.
    pub fn energy(&self, x: &Places) -> f64 {
        let target = self.target(x);
        self.fold.stiffness * (0.5 * target.norm_squared() - target.dot(&self.fold.bend(x)))
    }

    /// Adds what its rest adds to the forces, N.
    pub fn press(&self, x: &Places, force: &mut [Vector3<f64>]) {
        let target = self.target(x) * self.fold.stiffness;
        for (knot, weight) in self.fold.terms() {
            force[knot as usize] += target * weight;
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::drape::step::{Manner, Workshop};
    use crate::drape::swatch::{Nothing, fabric, irregular, rectangles};
    use crate::drape::weld::Weld;
    use crate::mesh::compiled::MeshCrease;
    use nalgebra::Vector3;

    /// A free strip without weight folds itself to its angle of rest, up or down as asked, on the
    /// grid and off it. Nothing resists: only the crease itself is stiff against it, and a strip
    /// bent at rest has no energy at all.
    #[test]
    fn a_free_strip_folds_to_its_angle_of_rest() {
        let (n, m, h) = (12, 4, 0.01);
        for (degrees, rough) in [(90.0f64, false), (-90.0, false), (150.0, false), (60.0, true)] {
            let mut compiled = rectangles(1, [n, m], h, fabric(1e-5));
            if rough {
                compiled = irregular(compiled, [n, m], h);
                // The middle line stays straight, so that it can be folded along.
                for j in 0..=m {
                    compiled.particles[j * (n + 1) + n / 2] = [0.06, j as f64 * h];
                }
            }
            for j in 0..m {
                let at = |j: usize| (j * (n + 1) + n / 2) as u32;
                let side = [at(j), at(j + 1)];
                compiled.creases.push(MeshCrease { side, angle: degrees.to_radians() });
            }
            let start: Vec<_> =
                compiled.particles.iter().map(|p| Vector3::new(p[0], p[1], 0.0)).collect();
            let weld = Weld::new(compiled.particles.len(), std::iter::empty());
            let mut shop = Workshop::new(&compiled, &[], &Nothing, weld, &start);
            let manner =
                Manner { gravity: 0.0, air: 0.0, calm: 5.0, layers: false, ..Manner::default() };
            for _ in 0..600 {
                shop.step(&manner).unwrap();
            }
            let row = 2 * (n + 1);
            let way = |a: usize, b: usize| shop.x[row + b] - shop.x[row + a];
            let (first, second) = (way(0, n / 2 - 1), way(n / 2 + 1, n));
            let turned = first.angle(&second).to_degrees();
            assert!((turned - degrees.abs()).abs() < 2.0, "{turned} for {degrees}");
            // The face looks to +z at first; folded on itself, its ends rise over the crease.
            let (left, right) = (way(n / 2, 0), way(n / 2, n));
            let up = (left + right).dot(&normal(&shop, row, n));
            assert!(up * degrees > 0.0, "{up} for {degrees}");
            assert!(shop.energy(0.0)[0] < 1e-7, "{:?}", shop.energy(0.0));
        }
    }

    /// Out of the face beside the crease.
    fn normal(shop: &Workshop<'_>, row: usize, n: usize) -> Vector3<f64> {
        let across = shop.x[row + n] - shop.x[row];
        let along = shop.x[row + n + 1 + n / 2] - shop.x[row + n / 2];
        across.cross(&along)
    }
}
