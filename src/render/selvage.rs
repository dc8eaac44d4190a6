//! What shows along the edges of a panel: the groove of a seam, the turned rim of a free edge.

use super::figure::Face;
use crate::mesh::compiled::Compiled;

/// A stretch of a panel's outline.
#[derive(Clone, Copy, Debug)]
pub struct Stretch {
    /// Its ends in the panel, m.
    ends: [[f64; 2]; 2],
    /// Whether it is sewn to another.
    sewn: bool,
}

/// The stretches that lie near each triangle of cloth.
#[derive(Clone, Debug, Default)]
pub struct Selvages {
    stretches: Vec<Stretch>,
    /// For each triangle where its own begin; those of the last end with the list.
    begins: Vec<u32>,
}

/// Half the width of the groove of a seam, m.
const GROOVE: f32 = 0.7e-3;

/// Light that the groove takes.
const GROOVE_DEPTH: f32 = 0.55;

/// Width of the rim of a free edge, m.
const RIM: f32 = 1.1e-3;

/// Light that the rim takes.
const RIM_DEPTH: f32 = 0.28;

impl Selvages {
    /// The outlines of the panels by the triangles that touch them.
    pub fn of(compiled: &Compiled, faces: &[Face]) -> Self {
        let count = compiled.particles.len();
        let mut sewn = vec![false; count];
        for &[a, b] in compiled.seams.iter().flat_map(|seam| &seam.pairs) {
            for k in [a, b] {
                if let Some(mark) = sewn.get_mut(k as usize) {
                    *mark = true;
                }
            }
        }
        // The stretches that start and end at each particle.
        let mut about: Vec<[Option<Stretch>; 2]> = vec![[None; 2]; count];
        for outline in compiled.panels.iter().flat_map(|panel| &panel.loops) {
            for (k, &from) in outline.iter().enumerate() {
                let Some(&to) = outline.get(k + 1).or_else(|| outline.first()) else { continue };
                let (from, to) = (from as usize, to as usize);
                if from >= count || to >= count || from == to {
                    continue;
                }
                let ends = [compiled.particles[from], compiled.particles[to]];
                let stretch = Stretch { ends, sewn: sewn[from] && sewn[to] };
                about[from][0] = Some(stretch);
                about[to][1] = Some(stretch);
            }
        }
        let mut selvages = Selvages::default();
        for face in faces {
            selvages.begins.push(selvages.stretches.len() as u32);
            for corner in face.corners {
                let near = about.get(corner as usize).into_iter().flatten().flatten();
                selvages.stretches.extend(near);
            }
        }
        selvages
    }

    /// Share of the light that is left at a place of a triangle, seen through a window `wide` m
    /// wide.
    pub fn left(&self, face: u32, rest: [f64; 2], wide: f32) -> f32 {
        let face = face as usize;
        let Some(&begin) = self.begins.get(face) else { return 1.0 };
        let end = self.begins.get(face + 1).map_or(self.stretches.len(), |end| *end as usize);
        let Some(near) = self.stretches.get(begin as usize..end) else { return 1.0 };
        let mut taken: f32 = 0.0;
        for stretch in near {
            let away = stretch.distance(rest) as f32;
            let (half, depth) =
                if stretch.sewn { (GROOVE, GROOVE_DEPTH) } else { (RIM, RIM_DEPTH) };
            // The groove goes on beyond the edge, on the other panel; beyond a free edge there
            // is no cloth that could be seen.
            let covered = (away + wide * 0.5).min(half) - (away - wide * 0.5).max(-half);
            taken = taken.max(depth * (covered.max(0.0) / wide.max(1e-6)).min(1.0));
        }
        1.0 - taken
    }
}

impl Stretch {
    fn distance(&self, place: [f64; 2]) -> f64 {
        let [[ax, ay], [bx, by]] = self.ends;
        let (dx, dy) = (bx - ax, by - ay);
        let (px, py) = (place[0] - ax, place[1] - ay);
        let square = dx * dx + dy * dy;
        let along = if square > 0.0 { ((px * dx + py * dy) / square).clamp(0.0, 1.0) } else { 0.0 };
        let (x, y) = (px - dx * along, py - dy * along);
        (x * x + y * y).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::garment::scene::Placement;
    use crate::mesh::compiled::{MeshPanel, MeshSeam, Stretch as Numbers};

    #[test]
    fn a_seam_is_darkest_at_the_edge_and_a_window_spreads_it() {
        let panel = MeshPanel {
            name: "front".to_owned(),
            fabric: 0,
            cell: 0.01,
            layer: 0,
            grain: 0.0,
            placement: Placement::Led,
            particles: Numbers { start: 0, end: 3 },
            cells: Numbers::default(),
            triangles: Numbers { start: 0, end: 1 },
            loops: vec![vec![0, 1, 2]],
            edges: vec![],
            surfaces: vec![],
        };
        let compiled = Compiled {
            particles: vec![[0.0, 0.0], [0.02, 0.0], [0.0, 0.02]],
            panels: vec![panel],
            seams: vec![MeshSeam { name: "side".to_owned(), pairs: vec![[0, 0], [1, 1]] }],
            ..Compiled::default()
        };
        let faces = [Face { corners: [0, 1, 2], coat: 0 }];
        let selvages = Selvages::of(&compiled, &faces);
        let at = |y: f64, wide: f32| selvages.left(0, [0.008, y], wide);
        assert!((at(0.0, 1e-4) - (1.0 - GROOVE_DEPTH)).abs() < 1e-4);
        assert!((at(0.003, 1e-4) - 1.0).abs() < 1e-4);
        // Seen through 7 mm the groove of 1.4 mm takes a fifth of its depth.
        assert!((at(0.0, 7e-3) - (1.0 - GROOVE_DEPTH / 5.0)).abs() < 0.01);
        // The other two edges are free.
        assert!((selvages.left(0, [0.0, 0.01], 1e-4) - (1.0 - RIM_DEPTH)).abs() < 1e-4);
        assert!((selvages.left(7, [0.0, 0.0], 1e-4) - 1.0).abs() < 1e-9);
    }
}
