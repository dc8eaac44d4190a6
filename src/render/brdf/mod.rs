//! How a surface sends light on, by models that bear their authors' names.
//!
//! Directions are unit vectors in the frame of the place: x along the threads, y across them, z
//! along the normal towards the side that is seen; they point away from the surface. What a model
//! gives is the light sent towards the eye as a share of the light from one direction, per
//! steradian, without the cosine of that direction and without a colour.

mod albedo;
mod ashikhmin;
mod charlie;
mod schlick;
mod table;

pub use albedo::Albedo;
pub use ashikhmin::Ashikhmin;
pub use charlie::Charlie;
pub use schlick::Schlick;

use super::Vector;
use super::sample::cosine_about;
use std::f32::consts::PI;

/// A model of reflection.
pub trait Brdf {
    /// Light sent towards `eye` as a share of that from `light`, 1/sr. Both may be exchanged; 0
    /// where either lies below the surface.
    fn value(&self, eye: &Vector, light: &Vector) -> f32;

    /// How densely [`Brdf::sample`] chooses `light`, 1/sr; it sums to 1 over all directions, those
    /// below the surface included.
    fn density(&self, _eye: &Vector, light: &Vector) -> f32 {
        light.z.max(0.0) / PI
    }

    /// A direction about as likely as it brings light to `eye`, by two even numbers from 0 to 1.
    /// It may lie below the surface, from where nothing comes.
    fn sample(&self, _eye: &Vector, pair: [f32; 2]) -> Vector {
        cosine_about(&Vector::z(), pair)
    }
}

/// One of the models.
#[derive(Clone, Debug)]
pub enum Model {
    /// Parallel threads.
    Schlick(Schlick),
    /// Satin and velvet.
    Ashikhmin(Box<Ashikhmin>),
    /// Fibre ends that stand off.
    Charlie(Charlie),
}

impl Brdf for Model {
    fn value(&self, eye: &Vector, light: &Vector) -> f32 {
        match self {
            Model::Schlick(model) => model.value(eye, light),
            Model::Ashikhmin(model) => model.value(eye, light),
            Model::Charlie(model) => model.value(eye, light),
        }
    }

    fn density(&self, eye: &Vector, light: &Vector) -> f32 {
        match self {
            Model::Schlick(model) => model.density(eye, light),
            Model::Ashikhmin(model) => model.density(eye, light),
            Model::Charlie(model) => model.density(eye, light),
        }
    }

    fn sample(&self, eye: &Vector, pair: [f32; 2]) -> Vector {
        match self {
            Model::Schlick(model) => model.sample(eye, pair),
            Model::Ashikhmin(model) => model.sample(eye, pair),
            Model::Charlie(model) => model.sample(eye, pair),
        }
    }
}

/// The share of light that a smooth face of reflectance `straight` mirrors when `cosine` is that
/// of the angle of incidence (C. Schlick 1994, equation 15).
fn fresnel(straight: f32, cosine: f32) -> f32 {
    let turned = (1.0 - cosine).clamp(0.0, 1.0);
    let square = turned * turned;
    straight + (1.0 - straight) * square * square * turned
}

/// The direction half way between two, if they are not opposite.
fn half_way(a: &Vector, b: &Vector) -> Option<Vector> {
    (a + b).try_normalize(1e-6)
}

/// The normal of the face, turned upwards, that would mirror one direction into the other, and the
/// cosine of both with it.
fn face_between(eye: &Vector, light: &Vector) -> Option<(Vector, f32)> {
    let half = half_way(eye, light)?;
    let cosine = half.dot(eye);
    (cosine > 1e-6).then(|| (if half.z < 0.0 { -half } else { half }, cosine))
}

/// The mirror image of `eye` by a face with the normal `half`.
fn mirrored(eye: &Vector, half: &Vector) -> Vector {
    half * (2.0 * eye.dot(half)) - eye
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::sample::Sampler;

    /// Every model as the looks of fabrics use it.
    fn models() -> Vec<(&'static str, Model)> {
        let schlick =
            |r, p| Model::Schlick(Schlick { reflectance: 0.05, roughness: r, isotropy: p });
        vec![
            ("schlick, rough", schlick(0.6, 0.9)),
            ("schlick, threads", schlick(0.26, 0.5)),
            ("schlick, filament", schlick(0.09, 0.36)),
            ("satin", Model::Ashikhmin(Box::new(Ashikhmin::satin(0.05, 0.16, 0.6)))),
            ("satin of metal", Model::Ashikhmin(Box::new(Ashikhmin::satin(1.0, 0.2, 0.5)))),
            ("velvet", Model::Ashikhmin(Box::new(Ashikhmin::velvet(0.05, 0.5)))),
            ("velvet, mirrored", Model::Ashikhmin(Box::new(Ashikhmin::velvet(1.0, 0.4)))),
            ("fur", Model::Charlie(Charlie { order: 1 })),
            ("rim", Model::Charlie(Charlie { order: 2 })),
        ]
    }

    fn direction(z: f32, turn: f32) -> Vector {
        let flat = (1.0 - z * z).sqrt();
        Vector::new(flat * libm::cosf(turn), flat * libm::sinf(turn), z)
    }

    fn eyes() -> impl Iterator<Item = Vector> {
        [1.0, 0.9, 0.6, 0.3, 0.12]
            .into_iter()
            .flat_map(|z| [0.0, 0.4, 1.1, 2.0].map(|turn| direction(z, turn)))
    }

    /// The sum of `what` over a sphere of directions, or over its upper half, in even steps of
    /// angle.
    fn over(whole: bool, what: impl Fn(&Vector) -> f32) -> f64 {
        const TILTS: usize = 360;
        const TURNS: usize = 440;
        let span = if whole { PI } else { PI / 2.0 };
        let mut sum = 0.0;
        for i in 0..TILTS {
            let (sine, cosine) = libm::sincosf((i as f32 + 0.5) * span / TILTS as f32);
            let mut ring = 0.0;
            for j in 0..TURNS {
                let (s, c) = libm::sincosf((j as f32 + 0.5) * 2.0 * PI / TURNS as f32);
                ring += f64::from(what(&Vector::new(sine * c, sine * s, cosine)));
            }
            sum += ring * f64::from(sine);
        }
        sum * f64::from(span) / TILTS as f64 * f64::from(2.0 * PI) / TURNS as f64
    }

    #[test]
    fn a_white_furnace_gets_back_what_each_model_says_and_no_more_than_it_gave() {
        for (name, model) in models() {
            let said = Albedo::of(&model);
            for eye in eyes() {
                let found = over(false, |light| model.value(&eye, light) * light.z) as f32;
                let said = said.at(&eye);
                assert!(
                    (found - said).abs() < 0.01 * said + 1e-4,
                    "{name} at {eye}: {found}, not {said}"
                );
                assert!(found <= 1.001, "{name} at {eye}: {found}");
            }
        }
    }

    #[test]
    fn eye_and_light_can_be_exchanged() {
        for (name, model) in models() {
            for a in eyes() {
                for b in eyes() {
                    let (to, fro) = (model.value(&a, &b), model.value(&b, &a));
                    let off = (to - fro).abs() / to.max(1e-3);
                    assert!(off < 1e-6, "{name}: {to} one way, {fro} the other");
                }
            }
        }
    }

    #[test]
    fn densities_sum_to_one() {
        for (name, model) in models() {
            // Nearer to the horizon the density has a peak that is narrower than the steps.
            for eye in eyes().filter(|eye| eye.z >= 0.3) {
                let sum = over(true, |light| model.density(&eye, light));
                assert!((sum - 1.0).abs() < 0.015, "{name} at {eye}: {sum}");
            }
        }
    }

    #[test]
    fn chosen_directions_bring_on_average_what_all_bring() {
        const PATHS: u32 = 8192;
        for (name, model) in models() {
            for eye in eyes() {
                let mut sum = 0.0;
                for path in 0..PATHS {
                    let light = model.sample(&eye, Sampler::new(0, [0, 0], path, PATHS).pair());
                    let density = model.density(&eye, &light);
                    if light.z > 0.0 && density > 0.0 {
                        sum += model.value(&eye, &light) * light.z / density;
                    }
                }
                let mean = sum / PATHS as f32;
                let all = over(false, |light| model.value(&eye, light) * light.z) as f32;
                assert!(
                    (mean - all).abs() < 0.01 * all + 1e-4,
                    "{name} at {eye}: {mean}, not {all}"
                );
            }
        }
    }

    #[test]
    fn threads_mirror_across_themselves_and_velvet_is_bright_at_its_rim() {
        let up = Vector::z();
        let (along, across) = (direction(0.8, 0.0), direction(0.8, PI / 2.0));
        for (name, model) in models().into_iter().skip(2).take(3) {
            let (along, across) = (model.value(&up, &along), model.value(&up, &across));
            // The crossed threads of a satin give 3 of 10 parts back along it.
            assert!(across > 1.5 * along, "{name}: {across} against {along}");
        }
        let velvet = Ashikhmin::velvet(0.05, 0.5);
        let rim = direction(0.2, 0.3);
        assert!(velvet.value(&rim, &rim) > 5.0 * velvet.value(&up, &up));
    }
}
