//! Cloth that cuts itself when its seams are closed, made smooth.
//!
//! While edges are drawn together, the cloth beside them may pass through itself, or no seam would
//! close that begins crossed; what is left are crumples along armholes and collars, in which no face
//! knows its right side. Cloth very much stiffer to bend does not crumple. As a shell that may pass
//! through itself it opens out into the smooth surface that its seams allow, and a smooth surface
//! does not cut itself; let go again it is cloth with every layer on its own side.

use super::crossing;
use super::schedule;
use super::skin::Skin;
use super::step::{Stuck, Workshop};
use super::weld::Weld;
use crate::body::surface::Surface;
use crate::mesh::compiled::Compiled;
use nalgebra::Vector3;

/// How many times stiffer to bend, one after the other, until nothing cuts itself any more.
const STIFFER: [f64; 3] = [1e2, 1e3, 1e4];

/// Gives the places of the particles of a sewn cloth, ironed until it does not cut itself, and the
/// steps that took; as they are if it does not.
///
/// # Errors
/// [`Stuck`] from the step.
pub fn iron(
    compiled: &Compiled,
    (surfaces, skin): (&[Surface], &dyn Skin),
    weld: &Weld,
    places: Vec<Vector3<f64>>,
) -> Result<(Vec<Vector3<f64>>, usize), Stuck> {
    let mut places = places;
    let mut steps = 0;
    for factor in STIFFER {
        if crossing::count(compiled, &places) == 0 {
            break;
        }
        let mut stiff = compiled.clone();
        for fabric in &mut stiff.fabrics {
            fabric.bending = fabric.bending.map(|b| b * factor);
        }
        let mut shop = Workshop::new(&stiff, surfaces, skin, weld.clone(), &places);
        steps += schedule::smooth(&mut shop)?.steps;
        places = shop.positions();
    }
    Ok((places, steps))
}
