//! Cords: stretches between particles along edges, and from place to place.

use super::compiled::MeshCord;
use crate::garment::seam::{Cord, CordKind, Tie};
use crate::geometry::polygon::{Place, distance};

/// A cord along rows of particles: every stretch of the edge gets the same share of its length.
pub fn along(cord: &Cord, lines: &[Vec<u32>], particles: &[Place]) -> MeshCord {
    let steps = lines.iter().flat_map(|line| line.windows(2));
    let pairs: Vec<[u32; 2]> = steps.map(|step| [step[0], step[1]]).collect();
    let flat: Vec<f64> = pairs
        .iter()
        .map(|pair| {
            let [a, b] = pair.map(|k| particles[k as usize]);
            distance(a, b)
        })
        .collect();
    let whole: f64 = flat.iter().sum();
    let share = if whole > 0.0 { cord.length / whole } else { 1.0 };
    MeshCord {
        name: cord.name.clone(),
        kind: cord.kind,
        width: cord.width,
        pairs,
        rests: flat.into_iter().map(|length| share * length).collect(),
    }
}

/// A cord between particles.
pub fn tied(tie: &Tie, pairs: Vec<[u32; 2]>) -> MeshCord {
    MeshCord {
        name: tie.name.clone(),
        kind: CordKind::Tie,
        width: 0.0,
        rests: vec![tie.length; pairs.len()],
        pairs,
    }
}
