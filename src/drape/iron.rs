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

#[cfg(test)]
mod tests {
    use super::super::skin::Figures;
    use super::super::swatch::{fabric, rectangles};
    use super::*;

    /// A tube whose two sides are bound together, pushed in on one side until that side comes
    /// through the other: ironed it is round again, and as long round as it was.
    #[test]
    fn a_tube_pushed_through_itself_opens_out() {
        let compiled = rectangles(1, [24, 6], 0.02, fabric(1e-5));
        let along = |p: &[f64; 2]| p[0] / 0.48;
        let mut pairs = Vec::new();
        for (i, p) in compiled.particles.iter().enumerate() {
            let same = |q: &&(usize, &[f64; 2])| (q.1[1] - p[1]).abs() < 1e-9;
            let others: Vec<_> = compiled.particles.iter().enumerate().collect();
            let end = others.iter().filter(same).find(|q| (along(q.1) - 1.0).abs() < 1e-9);
            if along(p) < 1e-9 {
                pairs.push([i as u32, end.expect("the other side").0 as u32]);
            }
        }
        let weld = Weld::new(compiled.particles.len(), pairs.into_iter());
        let radius = 0.48 / std::f64::consts::TAU;
        let places: Vec<Vector3<f64>> = compiled
            .particles
            .iter()
            .map(|p| {
                let (sine, cosine) = (std::f64::consts::TAU * along(p)).sin_cos();
                let through = if cosine > 0.5 { 2.6 * radius * (cosine - 0.5) / 0.5 } else { 0.0 };
                Vector3::new(radius * cosine - through, p[1], radius * sine)
            })
            .collect();
        let before = crossing::count(&compiled, &places);
        assert!(before > 0);
        let skin = Figures::new(&[]);
        let (ironed, steps) = iron(&compiled, (&[], &skin), &weld, places).expect("can be moved");
        assert_eq!(crossing::count(&compiled, &ironed), 0, "of {before}");
        assert!(steps > 0);
        let strain = compiled.cells.iter().map(|[a, b, ..]| {
            let [p, q] = [a, b].map(|k| ironed[*k as usize]);
            ((p - q).norm() / 0.02 - 1.0).abs()
        });
        let worst = strain.fold(0.0, f64::max);
        assert!(worst < 0.05, "{worst}");
    }

    /// What does not cut itself is left as it lies.
    #[test]
    fn whole_cloth_is_not_ironed() {
        let compiled = rectangles(1, [4, 4], 0.02, fabric(1e-5));
        let flat: Vec<Vector3<f64>> =
            compiled.particles.iter().map(|p| Vector3::new(p[0], 0.0, p[1])).collect();
        let weld = Weld::new(compiled.particles.len(), std::iter::empty());
        let skin = Figures::new(&[]);
        let done = iron(&compiled, (&[], &skin), &weld, flat.clone()).expect("can be moved");
        assert_eq!(done, (flat, 0));
    }
}
