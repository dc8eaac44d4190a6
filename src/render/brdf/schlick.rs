//! The gloss of parallel threads, narrow along them and wide across.

use super::{Brdf, face_between, fresnel, half_way, mirrored};
use crate::render::Vector;
use std::f32::consts::PI;

/// One layer of the model of C. Schlick, "An Inexpensive BRDF Model for Physically-based
/// Rendering", 1994: R = S(u) G(v) G(v′) Z(t) A(w) / (4π v v′), with t = h·n, u = h·v, w the
/// cosine between the threads and the projection of the half vector h.
///
/// # Differences from the paper
/// The paper adds back the light that G keeps, spread evenly, as (1 − G(v) G(v′)) / (4π v v′);
/// its albedo grows without bound towards the horizon, so that it is left out here, and the layer
/// below gets the light instead. The numerator of Z is r, which makes ∫ Z t dω = π.
#[derive(Clone, Copy, Debug)]
pub struct Schlick {
    /// Reflectance straight on, the C of S(u) = C + (1 − C)(1 − u)⁵.
    pub reflectance: f32,
    /// r, above 0 (a mirror) up to 1 (matte).
    pub roughness: f32,
    /// p, above 0 (mirrors across the threads only) up to 1 (all round alike).
    pub isotropy: f32,
}

impl Schlick {
    /// Z(t): how many faces are tilted by the angle whose cosine is t.
    fn zenith(&self, t: f32) -> f32 {
        let r = self.roughness;
        let spread = 1.0 + (r - 1.0) * t * t;
        r / (spread * spread)
    }

    /// p² − p² w² + w² of a half vector; p where it stands upright and has no azimuth. A(w) is the
    /// root of p over this.
    fn azimuth(&self, half: &Vector) -> f32 {
        let (x, y) = (half.x * half.x, half.y * half.y);
        let flat = x + y;
        if flat < 1e-12 {
            return self.isotropy;
        }
        (self.isotropy * self.isotropy * y + x) / flat
    }
}

impl Brdf for Schlick {
    fn value(&self, eye: &Vector, light: &Vector) -> f32 {
        if eye.z <= 0.0 || light.z <= 0.0 {
            return 0.0;
        }
        let Some(half) = half_way(eye, light) else { return 0.0 };
        // The mean of both cosines, equal but for rounding, so that eye and light can change places.
        let u = 0.5 * (half.dot(eye) + half.dot(light));
        // G(v) / v = 1 / (r − r v + v).
        let seen = |v: f32| self.roughness + (1.0 - self.roughness) * v;
        let turn = (self.isotropy / self.azimuth(&half)).sqrt();
        fresnel(self.reflectance, u) * self.zenith(half.z) * turn
            / (4.0 * PI * (seen(eye.z) * seen(light.z)))
    }

    fn density(&self, eye: &Vector, light: &Vector) -> f32 {
        let Some((half, cosine)) = face_between(eye, light) else { return 0.0 };
        // Half vectors are as dense as Z(t) t, and about the normal as an even ring drawn
        // together by p along the threads.
        self.zenith(half.z) * half.z / PI * self.isotropy / self.azimuth(&half) / (4.0 * cosine)
    }

    fn sample(&self, eye: &Vector, [tilt, turn]: [f32; 2]) -> Vector {
        // The share of half vectors flatter than t is r t² / (1 − (1 − r) t²); its inverse:
        let square = tilt / (self.roughness + (1.0 - self.roughness) * tilt).max(1e-9);
        let square = square.clamp(0.0, 1.0);
        let (sine, cosine) = libm::sincosf(2.0 * PI * turn);
        let (x, y) = (self.isotropy * cosine, sine);
        let flat = (1.0 - square).sqrt() / (x * x + y * y).sqrt().max(1e-9);
        mirrored(eye, &Vector::new(x * flat, y * flat, square.sqrt()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::brdf::Albedo;

    #[test]
    fn seen_straight_on_it_sends_back_what_the_integral_says() {
        // All mirroring and alike all round, with x = t², so that v′ = 2 x − 1, and k = 1 − r:
        // ∫ from ½ to 1 of r (2 x − 1) dx / ((1 − k x)² (r + k (2 x − 1))). With y = 1 − k x and
        // c = 1 + 2 r it is r/k² ∫ (1/y² − r / (y² (c − 2 y))) dy from r to 1 − k/2.
        for r in [0.1_f64, 0.3, 0.7] {
            let (k, c) = (1.0 - r, 1.0 + 2.0 * r);
            let whole = |y: f64| {
                let parts =
                    -1.0 / (c * y) + 2.0 / (c * c) * (libm::log(y) - libm::log(c - 2.0 * y));
                -1.0 / y - r * parts
            };
            let exact = r / (k * k) * (whole(1.0 - k / 2.0) - whole(r));
            let model = Schlick { reflectance: 1.0, roughness: r as f32, isotropy: 1.0 };
            let said = f64::from(Albedo::of(&model).at(&Vector::z()));
            assert!((said / exact - 1.0).abs() < 0.01, "{said}, not {exact}, for {r}");
        }
    }
}
