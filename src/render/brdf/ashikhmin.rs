//! Satin and velvet: faces whose normals are spread as the cloth spreads them.

use super::table::Table;
use super::{Brdf, face_between, fresnel, half_way, mirrored};
use crate::render::Vector;
use crate::render::sample::cosine_about;
use std::f32::consts::PI;

/// The model of M. Ashikhmin, S. Premože and P. Shirley, "A Microfacet-based BRDF Generator", 2000:
/// ρ = p(h) ⟨h·n⟩ F(k·h) / (4 g(k₁) g(k₂)) with g(k) = ∫ p(h) (h·k)₊ dω. It may be exchanged
/// and sends back no more than it gets, whatever p is.
#[derive(Clone, Debug)]
pub struct Ashikhmin {
    faces: Faces,
    /// Reflectance of a face straight on.
    reflectance: f32,
    /// ⟨h·n⟩, the mean cosine of the faces.
    mean: f32,
    /// g by direction.
    g: Table,
}

/// How the normals of the faces are spread, per steradian; they sum to 1.
#[derive(Clone, Debug)]
enum Faces {
    /// Threads that cross: exp(−tan²θ (cos²φ/σx² + sin²φ/σy²)) for each.
    Threads([Spread; 2]),
    /// Pile: exp(−cot²θ/σ²), most faces upright.
    Pile {
        /// 1/σ².
        sharp: f32,
        /// The factor that makes the sum 1.
        scale: f32,
        /// Share of the faces below each step of the height.
        below: Vec<f32>,
    },
}

/// The faces of parallel threads.
#[derive(Clone, Copy, Debug)]
struct Spread {
    /// Its share in the cloth.
    share: f32,
    /// σ along x and along y.
    sigma: [f32; 2],
    /// The factor that makes the sum 1.
    scale: f32,
}

/// Steps of height by which upright faces are chosen.
const STEPS: usize = 256;

/// Shares of the two systems of threads in the gloss of satin: those that float lie on top (the
/// same authors, section on satin).
const FLOATS: [f32; 2] = [0.7, 0.3];

impl Ashikhmin {
    /// Satin: two crossed Gaussians, 0.7 of the threads that float, which run along x, and 0.3 of
    /// those that bind. The normals of each are spread by `along` (as a slope) along its threads
    /// and by `across` across them.
    pub fn satin(reflectance: f32, along: f32, across: f32) -> Self {
        let spread = |share: f32, sigma: [f32; 2]| {
            let shape = |h: &Vector| threads(h, sigma);
            Spread { share, sigma, scale: 1.0 / whole(shape) }
        };
        let faces = Faces::Threads([
            spread(FLOATS[0], [along, across]),
            spread(FLOATS[1], [across, along]),
        ]);
        Self::of(faces, reflectance)
    }

    /// Velvet: the inverse Gaussian of width `sigma`.
    pub fn velvet(reflectance: f32, sigma: f32) -> Self {
        let sharp = 1.0 / (sigma * sigma);
        let mut below = Vec::with_capacity(STEPS + 1);
        let mut sum = 0.0;
        below.push(0.0);
        for step in 0..STEPS {
            let z = (step as f32 + 0.5) / STEPS as f32;
            sum += pile(z, sharp);
            below.push(sum);
        }
        below.iter_mut().for_each(|share| *share /= sum);
        let scale = STEPS as f32 / (sum * 2.0 * PI);
        Self::of(Faces::Pile { sharp, scale, below }, reflectance)
    }

    fn of(faces: Faces, reflectance: f32) -> Self {
        // The faces of one half sphere, once for all directions.
        let mut spread: Vec<(Vector, f32)> = Vec::new();
        half_sphere(|half, area| {
            let share = faces.share(half) * area;
            if share > 1e-9 {
                spread.push((*half, share));
            }
        });
        let mean = spread.iter().map(|(half, share)| half.z * share).sum();
        let g =
            Table::of(|k| spread.iter().map(|(half, share)| half.dot(k).max(0.0) * share).sum());
        Ashikhmin { faces, reflectance, mean, g }
    }
}

impl Faces {
    /// p(h).
    fn share(&self, half: &Vector) -> f32 {
        match self {
            Faces::Threads(both) => {
                both.iter().map(|s| s.share * s.scale * threads(half, s.sigma)).sum()
            }
            Faces::Pile { sharp, scale, .. } => scale * pile(half.z, *sharp),
        }
    }
}

impl Brdf for Ashikhmin {
    fn value(&self, eye: &Vector, light: &Vector) -> f32 {
        if eye.z <= 0.0 || light.z <= 0.0 {
            return 0.0;
        }
        let Some(half) = half_way(eye, light) else { return 0.0 };
        let cosine = 0.5 * (half.dot(eye) + half.dot(light));
        self.faces.share(&half) * self.mean * fresnel(self.reflectance, cosine)
            / (4.0 * (self.g.at(eye) * self.g.at(light)))
    }

    fn density(&self, eye: &Vector, light: &Vector) -> f32 {
        let Some((half, cosine)) = face_between(eye, light) else { return 0.0 };
        let dense = match &self.faces {
            Faces::Threads(both) => {
                let cube = half.z * half.z * half.z;
                both.iter()
                    .map(|s| {
                        let [x, y] = s.sigma;
                        s.share * threads(&half, s.sigma) / (PI * x * y * cube.max(1e-9))
                    })
                    .sum::<f32>()
            }
            Faces::Pile { below, .. } => {
                let step = ((half.z * STEPS as f32) as usize).min(STEPS - 1);
                let pile = (below[step + 1] - below[step]) * STEPS as f32 / (2.0 * PI);
                return 0.5 * pile / (4.0 * cosine) + 0.5 * light.z.max(0.0) / PI;
            }
        };
        dense / (4.0 * cosine)
    }

    fn sample(&self, eye: &Vector, [first, second]: [f32; 2]) -> Vector {
        let half = match &self.faces {
            Faces::Threads([a, b]) => {
                let (spread, share) = if first < a.share {
                    (a, first / a.share)
                } else {
                    (b, (first - a.share) / b.share)
                };
                // Slopes spread like a bell (the method of Box and Muller 1958).
                let radius = (-libm::logf((1.0 - share).max(1e-9))).sqrt();
                let (sine, cosine) = libm::sincosf(2.0 * PI * second);
                let [x, y] = spread.sigma;
                Vector::new(x * radius * cosine, y * radius * sine, 1.0).normalize()
            }
            // Seen straight on, upright faces mirror what lies below the horizon: every second
            // direction is chosen evenly.
            Faces::Pile { .. } if first < 0.5 => {
                return cosine_about(&Vector::z(), [2.0 * first, second]);
            }
            Faces::Pile { below, .. } => {
                let first = 2.0 * first - 1.0;
                let step = below.partition_point(|share| *share <= first).clamp(1, STEPS) - 1;
                let width = (below[step + 1] - below[step]).max(1e-12);
                let z =
                    (step as f32 + ((first - below[step]) / width).clamp(0.0, 1.0)) / STEPS as f32;
                let flat = (1.0 - z * z).max(0.0).sqrt();
                let (sine, cosine) = libm::sincosf(2.0 * PI * second);
                Vector::new(flat * cosine, flat * sine, z)
            }
        };
        mirrored(eye, &half)
    }
}

/// exp(−tan²θ (cos²φ/σx² + sin²φ/σy²)).
fn threads(half: &Vector, [x, y]: [f32; 2]) -> f32 {
    if half.z < 1e-4 {
        return 0.0;
    }
    let (a, b) = (half.x / (half.z * x), half.y / (half.z * y));
    libm::expf(-(a * a + b * b))
}

/// exp(−cot²θ/σ²) at the height z = cos θ.
fn pile(z: f32, sharp: f32) -> f32 {
    let flat = 1.0 - z * z;
    if flat < 1e-6 { 0.0 } else { libm::expf(-z * z / flat * sharp) }
}

/// The sum of a shape over the half sphere.
fn whole(shape: impl Fn(&Vector) -> f32) -> f32 {
    let mut sum = 0.0;
    half_sphere(|half, area| sum += shape(half) * area);
    sum
}

/// Hands over directions of the half sphere with the areas that they stand for.
fn half_sphere(mut take: impl FnMut(&Vector, f32)) {
    const TILTS: usize = 64;
    const TURNS: usize = 96;
    for tilt in 0..TILTS {
        let (sine, cosine) = libm::sincosf((tilt as f32 + 0.5) / TILTS as f32 * PI / 2.0);
        let area = sine * (PI / 2.0 / TILTS as f32) * (2.0 * PI / TURNS as f32);
        for turn in 0..TURNS {
            let (s, c) = libm::sincosf((turn as f32 + 0.5) / TURNS as f32 * 2.0 * PI);
            take(&Vector::new(sine * c, sine * s, cosine), area);
        }
    }
}
