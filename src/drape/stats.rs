//! The account of a drape: strains, gaps, depths, speeds, verdict. Measured on the result alone.

use super::cloth::Cloth;
use super::crossing;
use super::draped::Stats;
use super::patch::Patches;
use super::skin::Skin;
use super::weld::Weld;
use crate::mesh::compiled::Compiled;
use nalgebra::Vector3;
use rayon::prelude::*;

/// Measures the result. The course (steps, seconds, speed, verdict) is left to the caller.
pub fn measure(compiled: &Compiled, x: &[Vector3<f64>], skin: &dyn Skin) -> Stats {
    let mut stats = Stats {
        name: compiled.name.clone(),
        particles: compiled.particles.len(),
        triangles: compiled.cells.len() * 2 + compiled.triangles.len(),
        seam_pairs: compiled.seams.iter().map(|s| s.pairs.len()).sum::<usize>()
            + compiled.patches.iter().map(|p| p.stitches.len()).sum::<usize>(),
        threads: rayon::current_num_threads(),
        ..Stats::default()
    };
    stats.self_intersections = crossing::count(compiled, x);
    strains(compiled, x, &mut stats);
    for pair in compiled.seams.iter().flat_map(|s| &s.pairs) {
        let [a, b] = pair.map(|p| x[p as usize]);
        stats.largest_seam_gap = stats.largest_seam_gap.max((a - b).norm());
    }
    stats.largest_seam_gap = stats.largest_seam_gap.max(patch_gap(compiled, x));
    stats.deepest_penetration = x
        .par_iter()
        .map(|x| skin.nearest(x).map_or(0.0, |n| (-n.distance).max(0.0)))
        .collect::<Vec<_>>()
        .into_iter()
        .fold(0.0, f64::max);
    stats
}

/// How much farther than layers of cloth keep apart the edge of a patch is from its place, m.
fn patch_gap(compiled: &Compiled, x: &[Vector3<f64>]) -> f64 {
    let cloth = Cloth::new(compiled, Weld::new(x.len(), std::iter::empty()));
    Patches::new(compiled, &cloth).gap(x)
}

/// Strains of the grid's edges, each counted once.
fn strains(compiled: &Compiled, x: &[Vector3<f64>], stats: &mut Stats) {
    let mut sums = [0.0; 2];
    let mut counts = [0usize; 2];
    let mut largest = [0.0f64; 2];
    for panel in &compiled.panels {
        let mut edges: Vec<([u32; 2], usize)> = panel
            .cells
            .range()
            .flat_map(|c| {
                let [a, b, c, d] = compiled.cells[c];
                [([a, b], 1), ([d, c], 1), ([b, c], 0), ([a, d], 0)]
            })
            .collect();
        edges.sort_unstable();
        edges.dedup();
        for ([a, b], family) in edges {
            let length = (x[a as usize] - x[b as usize]).norm();
            let strain = (length - panel.cell) / panel.cell;
            sums[family] += strain.abs();
            counts[family] += 1;
            largest[family] = largest[family].max(strain);
        }
    }
    stats.largest_warp_strain = largest[0];
    stats.largest_weft_strain = largest[1];
    stats.mean_warp_strain = sums[0] / counts[0].max(1) as f64;
    stats.mean_weft_strain = sums[1] / counts[1].max(1) as f64;
}
