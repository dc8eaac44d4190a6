//! Where a place of a panel's plane lies among its cells and triangles.

use super::compiled::{Compiled, MeshPanel};

/// The faces of a panel, by the squares of its (u, v) plane that they reach into.
pub struct Faces<'a> {
    compiled: &'a Compiled,
    corner: [f64; 2],
    side: f64,
    count: [usize; 2],
    /// First face of each square, and one past the last square's.
    start: Vec<u32>,
    /// Faces: cells of the mesh first, triangles after them.
    faces: Vec<u32>,
}

/// Most squares along one side; a panel has no more cells than that for its grid to stand out.
const MOST: usize = 2048;

impl<'a> Faces<'a> {
    /// The faces of a panel of a mesh; none if it has no extent.
    pub fn new(compiled: &'a Compiled, panel: &MeshPanel) -> Option<Self> {
        let uv = &compiled.particles[panel.particles.range()];
        let mut low = [f64::INFINITY; 2];
        let mut high = [f64::NEG_INFINITY; 2];
        for p in uv {
            for k in 0..2 {
                low[k] = low[k].min(p[k]);
                high[k] = high[k].max(p[k]);
            }
        }
        let extent = (high[0] - low[0]).max(high[1] - low[1]);
        if !extent.is_finite() || extent <= 0.0 {
            return None;
        }
        let side = panel.cell.max(extent / MOST as f64);
        let count = [0, 1].map(|k| ((high[k] - low[k]) / side) as usize + 1);
        let mut squares =
            Faces { compiled, corner: low, side, count, start: Vec::new(), faces: Vec::new() };
        let mut entries: Vec<(usize, u32)> = Vec::new();
        let cells = panel.cells.range();
        let triangles = panel.triangles.range().map(|t| t + compiled.cells.len());
        for face in cells.chain(triangles) {
            let corners = squares.corners(face as u32);
            let a = squares.square(
                corners
                    .iter()
                    .fold([f64::INFINITY; 2], |m, p| [m[0].min(p.1[0]), m[1].min(p.1[1])]),
            );
            let b = squares.square(
                corners
                    .iter()
                    .fold([f64::NEG_INFINITY; 2], |m, p| [m[0].max(p.1[0]), m[1].max(p.1[1])]),
            );
            for j in a[1]..=b[1] {
                for i in a[0]..=b[0] {
                    entries.push((j * count[0] + i, face as u32));
                }
            }
        }
        entries.sort_unstable();
        squares.start = vec![0; count[0] * count[1] + 1];
        for (s, _) in &entries {
            squares.start[s + 1] += 1;
        }
        for s in 0..count[0] * count[1] {
            squares.start[s + 1] += squares.start[s];
        }
        squares.faces = entries.into_iter().map(|(_, f)| f).collect();
        Some(squares)
    }

    fn square(&self, p: [f64; 2]) -> [usize; 2] {
        [0, 1].map(|k| {
            // A negative or missing number becomes 0.
            (((p[k] - self.corner[k]) / self.side) as usize).min(self.count[k] - 1)
        })
    }

    /// Corners of a face with their places in the plane.
    fn corners(&self, face: u32) -> Vec<(u32, [f64; 2])> {
        let cells = self.compiled.cells.len();
        let knots: &[u32] = match (face as usize).checked_sub(cells) {
            None => &self.compiled.cells[face as usize],
            Some(t) => &self.compiled.triangles[t],
        };
        knots.iter().map(|&k| (k, self.compiled.particles[k as usize])).collect()
    }

    /// Particles and weights that give the place of (u, v), and how far outside of their face it
    /// lies (0 inside, as a share of the face).
    fn weights(&self, face: u32, p: [f64; 2]) -> (f64, Vec<(u32, f64)>) {
        let corners = self.corners(face);
        if let [a, b, c, d] = corners[..] {
            let s = (p[0] - a.1[0]) / (b.1[0] - a.1[0]);
            let t = (p[1] - a.1[1]) / (d.1[1] - a.1[1]);
            let out = [-s, s - 1.0, -t, t - 1.0].into_iter().fold(0.0, f64::max);
            let w = [(1.0 - s) * (1.0 - t), s * (1.0 - t), s * t, (1.0 - s) * t];
            return (out, [a.0, b.0, c.0, d.0].into_iter().zip(w).collect());
        }
        let [a, b, c] = [corners[0].1, corners[1].1, corners[2].1];
        let cross = |p: [f64; 2], q: [f64; 2], r: [f64; 2]| {
            (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
        };
        let whole = cross(a, b, c);
        let w = [cross(p, b, c) / whole, cross(a, p, c) / whole, cross(a, b, p) / whole];
        let out = w.into_iter().map(|w| -w).fold(0.0, f64::max);
        (out, corners.iter().map(|c| c.0).zip(w).collect())
    }

    /// Particles and weights that give the place of (u, v): those of the face that holds it, or
    /// comes nearest to it. A cell has four, in the order of its corners.
    pub fn find(&self, p: [f64; 2]) -> Option<Vec<(u32, f64)>> {
        let [i, j] = self.square(p);
        let mut best: Option<(f64, Vec<(u32, f64)>)> = None;
        let widest = self.count[0].max(self.count[1]);
        for ring in 0..=widest {
            let rows = j.saturating_sub(ring)..=(j + ring).min(self.count[1] - 1);
            for row in rows {
                for column in i.saturating_sub(ring)..=(i + ring).min(self.count[0] - 1) {
                    if row.abs_diff(j).max(column.abs_diff(i)) != ring {
                        continue;
                    }
                    let s = row * self.count[0] + column;
                    for &face in &self.faces[self.start[s] as usize..self.start[s + 1] as usize] {
                        let (out, weights) = self.weights(face, p);
                        if out.is_finite() && best.as_ref().is_none_or(|b| out < b.0) {
                            best = Some((out, weights));
                        }
                    }
                }
            }
            // One ring more than the first find, in which a nearer face may lie.
            if ring > 0 && best.is_some() {
                break;
            }
        }
        best.map(|b| b.1)
    }

    /// The same with three particles: of a cell, those of the half that holds (u, v).
    pub fn triangle(&self, p: [f64; 2]) -> Option<([u32; 3], [f64; 3])> {
        let found = self.find(p)?;
        match found[..] {
            [a, b, c, d] => {
                let (s, t) = (b.1 + c.1, c.1 + d.1);
                Some(if t <= s {
                    ([a.0, b.0, c.0], [1.0 - s, s - t, t])
                } else {
                    ([a.0, c.0, d.0], [1.0 - t, s, t - s])
                })
            }
            [a, b, c] => Some(([a.0, b.0, c.0], [a.1, b.1, c.1])),
            _ => None,
        }
    }
}
