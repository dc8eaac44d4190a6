//! What a model sends back of even light from all round, by the direction in which it is seen.

use super::Brdf;
use super::table::Table;
use crate::render::Vector;
use crate::render::sample::Sampler;

/// Directions chosen for each figure of the table.
const PATHS: u32 = 512;

/// The albedo of a model.
#[derive(Clone, Debug)]
pub struct Albedo {
    table: Table,
    mean: f32,
}

impl Albedo {
    /// Tabulates it.
    pub fn of(model: &impl Brdf) -> Self {
        let table = Table::of(|eye| {
            let mut sum = 0.0;
            for path in 0..PATHS {
                let light = model.sample(eye, Sampler::new(0, [0, 0], path, PATHS).pair());
                let density = model.density(eye, &light);
                if light.z > 0.0 && density > 0.0 {
                    sum += model.value(eye, &light) * light.z / density;
                }
            }
            sum / PATHS as f32
        });
        let mean = table.mean();
        Albedo { table, mean }
    }

    /// Seen from a direction.
    pub fn at(&self, eye: &Vector) -> f32 {
        self.table.at(eye)
    }

    /// On average over all directions, each weighed by its cosine.
    pub fn mean(&self) -> f32 {
        self.mean
    }
}
