//! A specimen: cut by a scene of the language, of a given fabric, held where the test holds it.

use crate::diagnostic::Diagnostic;
use crate::drape::draped::{Draped, Verdict};
use crate::garment::seam::PinTarget;
use crate::mesh::compiled::{Compiled, MeshPin};
use crate::progress::Progress;
use crate::textile::fabric::Fabric;
use crate::world::{Memory, World};
use crate::{drape, evaluate, mesh};
use nalgebra::Vector3;

/// A specimen at rest.
#[derive(Clone, Debug)]
pub struct Hung {
    /// As it was cut.
    pub compiled: Compiled,
    /// As it hangs.
    pub draped: Draped,
}

/// Why a test has no result.
#[derive(Clone, Debug)]
pub enum Failure {
    /// The specimen cannot be cut.
    Cut(Vec<Diagnostic>),
    /// It did not come to rest, or the fabric is not one for this test.
    Unfit(String),
}

impl Hung {
    /// Cuts the scene `text`, whose cloth is `of cotton`, from `fabric`, holds the particles for
    /// which `held` says so by their place on the flat cloth, m along weft and warp, and lets it
    /// come to rest.
    pub(super) fn new(
        text: &str,
        fabric: &Fabric,
        held: impl Fn([f64; 2]) -> bool,
        progress: &mut dyn Progress,
    ) -> Result<Self, Failure> {
        let mut world = Memory::default();
        let root = world.take_in("laboratory", text);
        let (mut scenes, told) = evaluate::evaluate(&mut world, root, &Default::default());
        let wrong: Vec<Diagnostic> = told.into_iter().filter(Diagnostic::is_error).collect();
        let Some(mut scene) = scenes.pop().filter(|_| wrong.is_empty()) else {
            return Err(Failure::Cut(wrong));
        };
        scene.fabrics = vec![fabric.clone(); scene.fabrics.len()];
        let mut compiled = mesh::compile(&scene, &Default::default()).map_err(Failure::Cut)?;
        let points = (0..compiled.particles.len())
            .filter(|&p| held(compiled.particles[p]))
            .map(|p| p as u32)
            .collect();
        compiled.pins.push(MeshPin { points, to: PinTarget::Here });
        let draped = drape::drape(std::slice::from_ref(&compiled), &Default::default(), progress)
            .map_err(Failure::Cut)?;
        let hung = Hung { compiled, draped };
        match (&hung.draped.stats.reason, hung.draped.stats.verdict) {
            (None, Verdict::Settled) => Ok(hung),
            (Some(reason), _) => Err(Failure::Unfit(reason.clone())),
            (None, _) => Err(Failure::Unfit("the specimen did not come to rest".to_owned())),
        }
    }

    /// Mean place of the particles that `chosen` picks by their place on the flat cloth.
    pub(super) fn middle(&self, chosen: impl Fn([f64; 2]) -> bool) -> Vector3<f64> {
        let mut sum = Vector3::zeros();
        let mut count = 0.0;
        for (flat, place) in self.compiled.particles.iter().zip(&self.draped.positions) {
            if chosen(*flat) {
                sum += place.coords;
                count += 1.0;
            }
        }
        if count > 0.0 { sum / count } else { sum }
    }
}

/// A fabric of the library.
#[cfg(test)]
pub(super) fn library(name: &str) -> Fabric {
    let mut world = Memory::default();
    let root = world.take_in("laboratory", "");
    let (fabrics, _) = evaluate::catalogue::fabrics(&mut world, root, &Default::default());
    fabrics.into_iter().map(|it| it.fabric).find(|it| it.name == name).expect("in the library")
}
