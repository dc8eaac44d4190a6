//! Light scattered by fibre ends that stand off the cloth.

use super::{Brdf, half_way};
use crate::render::Vector;
use std::f32::consts::PI;

/// Fibres that stand upright, the more of them the smaller the angle to the cloth at which they
/// are seen: a power of the sine (A. Estevez and C. Kulla, "Production Friendly Microfacet Sheen
/// BRDF", 2017) with the soft shading of D. Neubelt and M. Pettineo 2013, 1 / (4 (v + v′ − v v′)).
#[derive(Clone, Copy, Debug)]
pub struct Charlie {
    /// Squares of the sine: 1 for broad fur, 2 for a narrow rim.
    pub order: i32,
}

impl Brdf for Charlie {
    fn value(&self, eye: &Vector, light: &Vector) -> f32 {
        if eye.z <= 0.0 || light.z <= 0.0 {
            return 0.0;
        }
        let Some(half) = half_way(eye, light) else { return 0.0 };
        let square = (1.0 - half.z * half.z).max(0.0);
        let power = if self.order > 1 { square * square } else { square };
        let density = (2.0 + 2.0 * self.order as f32) * power / (2.0 * PI);
        density / (4.0 * ((eye.z + light.z) - eye.z * light.z))
    }
}
