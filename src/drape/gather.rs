//! Edges longer than what they are sewn to. The fullness goes into folds that are finer than any grid,
//! evenly along the seam: at rest the stitched edge itself is as long as its partner, and only
//! the cloth beyond it has its own length and stands out in folds.

use crate::mesh::compiled::Compiled;
use std::collections::BTreeMap;

/// Lengths closer than this to their partner's are left as they are, as a share.
const EASY: f64 = 0.005;
/// An edge is gathered to no less than this share of its length.
const FULLEST: f64 = 0.2;

/// Shares to which stitched edges are drawn in.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Gathers(BTreeMap<[u32; 2], f64>);

impl Gathers {
    /// Compares both sides of every seam, stitch by stitch.
    pub fn new(compiled: &Compiled) -> Self {
        let length = |a: u32, b: u32| {
            let (p, q) = (compiled.particles[a as usize], compiled.particles[b as usize]);
            libm::hypot(p[0] - q[0], p[1] - q[1])
        };
        let mut panel = vec![0; compiled.particles.len()];
        for (number, p) in compiled.panels.iter().enumerate() {
            panel[p.particles.range()].fill(number);
        }
        let one = |a: u32, b: u32| panel[a as usize] == panel[b as usize];
        let mut gathers = BTreeMap::new();
        for pair in compiled.seams.iter().flat_map(|seam| seam.pairs.windows(2)) {
            let ([a, c], [b, d]) = (pair[0], pair[1]);
            if !one(a, b) || !one(c, d) {
                continue;
            }
            for ([a, b], [c, d]) in [([a, b], [c, d]), ([c, d], [a, b])] {
                let (own, partner) = (length(a, b), length(c, d));
                if partner < own * (1.0 - EASY) {
                    let share = gathers.entry([a.min(b), a.max(b)]).or_insert(1.0);
                    *share = f64::min(*share, (partner / own).max(FULLEST));
                }
            }
        }
        Gathers(gathers)
    }

    /// The share of its length to which the edge between two particles is drawn in, where it is.
    pub fn share(&self, a: u32, b: u32) -> Option<f64> {
        self.0.get(&[a.min(b), a.max(b)]).copied()
    }

    /// The corners of a face with its gathered edges drawn in about their middles.
    pub fn draw_in(&self, particles: [u32; 3], mut uv: [[f64; 2]; 3]) -> [[f64; 2]; 3] {
        for k in 0..3 {
            let m = (k + 1) % 3;
            let Some(share) = self.share(particles[k], particles[m]) else { continue };
            let (p, q) = (uv[k], uv[m]);
            for c in 0..2 {
                let by = 0.5 * (1.0 - share) * (q[c] - p[c]);
                uv[k][c] += by;
                uv[m][c] -= by;
            }
        }
        uv
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::garment::scene::Placement;
    use crate::mesh::compiled::{MeshPanel, MeshSeam, Stretch};

    /// Three stitches of a flounce twice as long as its hem.
    #[test]
    fn the_longer_side_is_drawn_in_to_the_shorter() {
        let mut mesh = Compiled::default();
        for (number, step) in [0.01, 0.02].into_iter().enumerate() {
            mesh.particles.extend((0..3).map(|k| [f64::from(k) * step, 0.0]));
            mesh.panels.push(MeshPanel {
                name: format!("p{number}"),
                fabric: 0,
                cell: 0.01,
                layer: 0,
                grain: 0.0,
                placement: Placement::Led,
                particles: Stretch { start: 3 * number as u32, end: 3 * number as u32 + 3 },
                cells: Stretch::default(),
                triangles: Stretch::default(),
                loops: Vec::new(),
                edges: Vec::new(),
                surfaces: Vec::new(),
            });
        }
        let pairs = vec![[0, 3], [1, 4], [2, 5]];
        mesh.seams.push(MeshSeam { name: "hem -> flounce".to_owned(), pairs });
        let gathers = Gathers::new(&mesh);
        assert_eq!(gathers.share(0, 1), None);
        assert!((gathers.share(5, 4).unwrap() - 0.5).abs() < 1e-12);
        let face = gathers.draw_in([3, 4, 9], [[0.0, 0.0], [0.02, 0.0], [0.01, -0.01]]);
        assert!((face[0][0] - 0.005).abs() < 1e-12 && (face[1][0] - 0.015).abs() < 1e-12);
        assert_eq!(face[2], [0.01, -0.01]);
    }
}
