//! Points sewn to points: the particles that are meant.

use super::Lines;
use super::assemble::nearest;
use super::compiled::{Compiled, MeshNearby, MeshSeam};
use super::cord;
use super::outline::Grain;
use crate::diagnostic::Diagnostic;
use crate::garment::Garment;
use crate::geometry::polygon::{Place, contains, distance};

/// A particle this far from the place that is meant is another one, in cells.
const FAR: f64 = 1.5;

/// What is sewn where there is no cloth (E0814), judged by the points along the cut lines of all
/// panels, whose cells have the sides `cells` (m).
pub(super) fn holes(garment: &Garment, lines: &[Lines], cells: &[f64]) -> Vec<Diagnostic> {
    let cloth_at = |&(panel, at): &(usize, Place)| {
        let (Some(cut), Some((rings, _)), Some(cell)) =
            (garment.panels.get(panel), lines.get(panel), cells.get(panel))
        else {
            return false;
        };
        let at = Grain::new(cut.grain).to_cloth(at);
        contains(rings, at)
            || rings.iter().flatten().any(|&point| distance(point, at) <= FAR * cell)
    };
    let mut wrong = Vec::new();
    for tie in garment.ties.iter().filter(|tie| !tie.pairs.iter().flatten().all(cloth_at)) {
        wrong.push(
            Diagnostic::new("E0814", format!("`{}` ties a hole", tie.name))
                .at(tie.span, "there is no cloth at one of its ends"),
        );
    }
    for stitch in garment.stitches.iter().filter(|s| !s.pairs.iter().flatten().all(cloth_at)) {
        wrong.push(
            Diagnostic::new("E0814", format!("`{}` sews a hole", stitch.name))
                .at(stitch.span, "there is no cloth at one of its points")
                .help("sew at particles that have not been cut away"),
        );
    }
    wrong
}

/// Adds what is sewn point by point to the seams, and buttons to the closures.
pub fn stitches(garment: &Garment, compiled: &mut Compiled) {
    let find = |compiled: &Compiled, pair: &[(usize, Place); 2]| {
        let [a, b] = pair.map(|(panel, at)| nearest(garment, compiled, panel, at));
        a.zip(b)
    };
    for tie in &garment.ties {
        let pairs = tie.pairs.iter().filter_map(|pair| find(compiled, pair).map(|(a, b)| [a, b]));
        let pairs = pairs.collect();
        compiled.ties.push(cord::tied(tie, pairs));
    }
    for stitch in &garment.stitches {
        let mut pairs = Vec::new();
        for pair in &stitch.pairs {
            let Some((a, b)) = find(compiled, pair) else { continue };
            // On a coarse grid two buttons may come to one particle; one of them does.
            let used = pairs.iter().any(|pair: &[u32; 2]| pair[0] == a || pair[1] == b);
            if !(stitch.closure && used) {
                pairs.push([a, b]);
            }
        }
        let made = MeshSeam { name: stitch.name.clone(), pairs };
        if stitch.closure {
            compiled.closures.push(made);
        } else {
            compiled.seams.push(made);
        }
    }
    for near in &garment.nearby {
        let side = |side: &Vec<(usize, Option<usize>)>| {
            let mut points: Vec<u32> = Vec::new();
            for &(panel, edge) in side {
                let Some(cut) = compiled.panels.get(panel) else { continue };
                match edge.and_then(|edge| cut.edges.get(edge)) {
                    Some(edge) => points.extend(&edge.points),
                    None => points.extend(cut.loops.iter().flatten()),
                }
            }
            points.sort_unstable();
            points.dedup();
            points
        };
        compiled.nearby.push(MeshNearby {
            name: near.name.clone(),
            sides: near.sides.each_ref().map(side),
            within: near.within,
        });
    }
}
