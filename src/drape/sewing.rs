//! Seams while they are still open: pairs that draw each other with a bounded force.

use super::weld::Weld;
use crate::garment::scene::Placement;
use crate::mesh::compiled::Compiled;
use nalgebra::Vector3;

/// Force per length of seam that draws two edges together, N/m: a hundredth of the tensile
/// stiffness of ordinary cloth, so that the panels come along without being stretched.
pub const PULL: f64 = 15.0;

/// The force grows to its full size over this distance, m.
const NEAR: f64 = 2.0e-3;

/// Pairs of knots to be sewn.
#[derive(Clone, Debug, Default)]
pub struct Sewing {
    /// Pairs that are still two knots.
    pub pairs: Vec<Stitch>,
    /// Whether sleeves are not yet set in.
    pub waiting: bool,
}

/// A pair to be sewn.
#[derive(Clone, Copy, Debug)]
pub struct Stitch {
    /// Its knots.
    pub knots: [u32; 2],
    /// Length of seam that it stands for, m.
    pub length: f64,
    /// Number of its seam.
    pub seam: usize,
    /// Where its blocks stand in the matrix.
    pub slots: [u32; 2],
    /// Whether it sets a sleeve in: joins what is placed on an arm to what is not.
    pub sets_in: bool,
}

impl Sewing {
    /// Open pairs of the seams; slots are filled in by [`Sewing::lay_out`].
    pub fn new(compiled: &Compiled, weld: &Weld) -> Self {
        let mut pairs = Vec::new();
        let on_arm = on_arms(compiled);
        for (seam, s) in compiled.seams.iter().enumerate() {
            let length = seam_length(compiled, &s.pairs) / s.pairs.len().max(1) as f64;
            for pair in &s.pairs {
                let knots = pair.map(|p| weld.knot[p as usize]);
                if knots[0] != knots[1] {
                    let [a, b] = pair.map(|p| on_arm[p as usize]);
                    let length = length.max(1e-4);
                    pairs.push(Stitch { knots, length, seam, slots: [0; 2], sets_in: a != b });
                }
            }
        }
        Sewing { pairs, waiting: false }
    }

    /// Finds the places of the pairs in the matrix.
    pub fn lay_out(&mut self, rim: &super::rim::Rim) {
        for stitch in &mut self.pairs {
            let [a, b] = stitch.knots;
            if let (Some(ab), Some(ba)) = (rim.slot(a, b), rim.slot(b, a)) {
                stitch.slots = [ab, ba];
            }
        }
    }

    /// Whether there are sleeves to be set in, and other seams that can be closed before.
    pub fn has_turns(&self) -> bool {
        self.pairs.iter().any(|s| s.sets_in) && self.pairs.iter().any(|s| !s.sets_in)
    }

    /// The pairs that are drawn together now.
    pub fn drawn(&self) -> impl Iterator<Item = &Stitch> {
        self.pairs.iter().filter(|s| !(self.waiting && s.sets_in))
    }

    /// The widest gap of those, m, and the number of its seam.
    pub fn gap(&self, x: &[Vector3<f64>]) -> (f64, usize) {
        let mut widest = (0.0, 0);
        for stitch in self.drawn() {
            let [a, b] = stitch.knots;
            let gap = (x[a as usize] - x[b as usize]).norm();
            if gap > widest.0 {
                widest = (gap, stitch.seam);
            }
        }
        widest
    }
}

impl Stitch {
    /// Stiffness of the pair, N/m, as the secant of its force; the force on the first knot is
    /// this times the way to the second.
    pub fn stiffness(&self, gap: f64, strength: f64) -> f64 {
        strength * PULL * self.length / gap.max(NEAR)
    }
}

/// Which particles belong to panels placed on an arm.
pub fn on_arms(compiled: &Compiled) -> Vec<bool> {
    let mut on_arm = vec![false; compiled.particles.len()];
    for panel in &compiled.panels {
        if let Placement::Wrapped { landmark, .. } = &panel.placement {
            on_arm[panel.particles.range()].fill(landmark.starts_with("arm."));
        }
    }
    on_arm
}

fn seam_length(compiled: &Compiled, pairs: &[[u32; 2]]) -> f64 {
    let side = |k: usize| -> f64 {
        pairs
            .windows(2)
            .map(|w| {
                let [p, q] = [w[0][k], w[1][k]].map(|p| compiled.particles[p as usize]);
                let step = ((p[0] - q[0]).powi(2) + (p[1] - q[1]).powi(2)).sqrt();
                // Where a seam passes from one panel to the next its places are not comparable.
                if step > 0.2 { 0.0 } else { step }
            })
            .sum()
    };
    0.5 * (side(0) + side(1))
}
