//! Points sewn to points: the particles that are meant.

use super::assemble::nearest;
use super::compiled::{Compiled, MeshNearby, MeshSeam};
use super::cord;
use super::outline::Grain;
use crate::diagnostic::Diagnostic;
use crate::garment::Garment;
use crate::geometry::polygon::{Place, distance};

/// A particle this far from the place that is meant is another one, in cells.
const FAR: f64 = 1.5;

/// Adds what is sewn point by point to the seams, and buttons to the closures.
///
/// # Errors
/// E0814 where there is no cloth at a point.
pub fn stitches(garment: &Garment, compiled: &mut Compiled) -> Result<(), Vec<Diagnostic>> {
    let mut wrong = Vec::new();
    let find = |compiled: &Compiled, pair: &[(usize, Place); 2]| {
        let found = pair.map(|(panel, at)| {
            let particle = nearest(garment, compiled, panel, at)?;
            let cut = compiled.panels.get(panel)?;
            let there = Grain::new(cut.grain).to_cloth(at);
            let place = *compiled.particles.get(particle as usize)?;
            (distance(place, there) <= FAR * cut.cell).then_some(particle)
        });
        let [a, b] = found;
        a.zip(b)
    };
    for tie in &garment.ties {
        let pairs: Option<Vec<[u32; 2]>> =
            tie.pairs.iter().map(|pair| find(compiled, pair).map(|(a, b)| [a, b])).collect();
        match pairs {
            Some(pairs) => compiled.ties.push(cord::tied(tie, pairs)),
            None => wrong.push(
                Diagnostic::new("E0814", format!("`{}` ties a hole", tie.name))
                    .at(tie.span, "there is no cloth at one of its ends"),
            ),
        }
    }
    for stitch in &garment.stitches {
        let mut pairs = Vec::new();
        for pair in &stitch.pairs {
            match find(compiled, pair) {
                Some((a, b)) => {
                    // On a coarse grid two buttons may come to one particle; one of them does.
                    let used = pairs.iter().any(|pair: &[u32; 2]| pair[0] == a || pair[1] == b);
                    if !(stitch.closure && used) {
                        pairs.push([a, b]);
                    }
                }
                None => {
                    wrong.push(
                        Diagnostic::new("E0814", format!("`{}` sews a hole", stitch.name))
                            .at(stitch.span, "there is no cloth at one of its points")
                            .help("sew at particles that have not been cut away"),
                    );
                    break;
                }
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
    if wrong.is_empty() { Ok(()) } else { Err(wrong) }
}
