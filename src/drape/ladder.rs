//! From a coarse grid to a finer one of the same garment: places carried over panel by panel.

use crate::mesh::compiled::Compiled;
use crate::mesh::locate::Faces;
use nalgebra::Vector3;
use rayon::prelude::*;

/// Places of the particles of `fine`, from those of `coarse`. Both have the same panels; a
/// particle outside of the coarse outline (on a curve) continues the face next to it.
pub fn carry(coarse: &Compiled, places: &[Vector3<f64>], fine: &Compiled) -> Vec<Vector3<f64>> {
    let mut carried = vec![Vector3::zeros(); fine.particles.len()];
    for (from, to) in coarse.panels.iter().zip(&fine.panels) {
        let Some(faces) = Faces::new(coarse, from) else { continue };
        let range = to.particles.range();
        carried[range.clone()].par_iter_mut().zip(&fine.particles[range]).for_each(
            |(place, uv)| {
                if let Some(weights) = faces.find(*uv) {
                    *place = weights.iter().map(|(k, w)| places[*k as usize] * *w).sum();
                }
            },
        );
    }
    carried
}
