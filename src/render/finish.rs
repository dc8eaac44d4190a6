//! How light leaves a surface: matte, glossy along the threads, furry at grazing angles.

use super::{Light3, Vector};
use crate::textile::fabric::{Fabric, Finish, Structure};
use crate::textile::yarn::Fibre;
use std::f32::consts::PI;

/// The look of one side of a surface, without its colour.
#[derive(Clone, Copy, Debug)]
pub struct Look {
    /// Share of the light that goes the matte way.
    pub matte: f32,
    /// Share of the matte light that comes out on the other side.
    pub passes: f32,
    /// The fur of fibre ends.
    pub sheen: Sheen,
    /// The gloss of the warp and of the weft; for bodies and solids one of the two.
    pub gloss: [Gloss; 2],
}

/// Light scattered by fibres that stand off the cloth (A. Estevez and C. Kulla 2017).
#[derive(Clone, Copy, Debug, Default)]
pub struct Sheen {
    /// How much of it; 0 for none.
    pub strength: f32,
    /// Squares of the sine: 1 for broad fur, 2 for a narrow rim.
    pub order: i32,
    /// Share of the cloth's own colour in it, against white.
    pub tint: f32,
}

/// Light mirrored by the sides of parallel threads: narrow along them, wide across.
#[derive(Clone, Copy, Debug, Default)]
pub struct Gloss {
    /// Reflectance straight on; 0 for none.
    pub strength: f32,
    /// Roughness along the threads.
    pub along: f32,
    /// Roughness across the threads.
    pub across: f32,
    /// Share of the cloth's own colour in it, against white.
    pub tint: f32,
}

/// The directions of a place of a surface.
#[derive(Clone, Copy, Debug)]
pub struct Threads {
    /// Towards the side that is seen; unit length.
    pub normal: Vector,
    /// Along the warp; unit length.
    pub warp: Vector,
    /// Along the weft; unit length.
    pub weft: Vector,
}

impl Look {
    /// A side of a fabric: the face, or the back.
    pub fn of_fabric(fabric: &Fabric, back: bool) -> Self {
        // How much of each thread lies on this side, and what it is spun from.
        let (shares, fibres) = match &fabric.structure {
            Structure::Woven { weave, warp, weft } => {
                let all: usize = weave.rows.iter().map(Vec::len).sum();
                let up: usize = weave.rows.iter().flatten().filter(|up| **up).count();
                let face = if all == 0 { 0.5 } else { up as f32 / all as f32 };
                let share = if back { 1.0 - face } else { face };
                ([share, 1.0 - share], [warp.yarn.fibre, weft.yarn.fibre])
            }
            // Loops show their legs, which run along the wales.
            Structure::Knitted { yarn, .. } => ([0.7, 0.3], [yarn.fibre, yarn.fibre]),
        };
        let knitted = matches!(fabric.structure, Structure::Knitted { .. });
        let gloss = [0, 1].map(|k| {
            let mut gloss = fibre_gloss(fibres[k]);
            match fabric.finish {
                Finish::Satin => {
                    gloss.strength = gloss.strength.max(0.035) * 2.4;
                    gloss.along *= 0.62;
                    gloss.across *= 0.85;
                }
                Finish::Matte => {}
                Finish::Wool => gloss.strength *= 0.4,
                Finish::Raised => gloss.strength *= 0.15,
                Finish::Velvet => gloss.strength = 0.0,
            }
            if knitted {
                gloss.strength *= 0.6;
                gloss.along = gloss.along.max(0.45);
            }
            gloss.strength *= shares[k];
            gloss
        });
        let sheen = match fabric.finish {
            Finish::Matte => Sheen { strength: 0.08, order: 1, tint: 0.7 },
            Finish::Satin => Sheen { strength: 0.04, order: 1, tint: 0.5 },
            Finish::Wool => Sheen { strength: 0.26, order: 1, tint: 0.6 },
            Finish::Raised => Sheen { strength: 0.45, order: 1, tint: 0.65 },
            Finish::Velvet if back => Sheen { strength: 0.12, order: 1, tint: 0.5 },
            Finish::Velvet => Sheen { strength: 1.1, order: 2, tint: 0.85 },
        };
        let matte = match fabric.finish {
            Finish::Velvet if !back => 0.45,
            _ => {
                let mirrored = 1.5 * (gloss[0].strength + gloss[1].strength).min(0.4);
                1.0 - mirrored - 0.3 * sheen.strength
            }
        };
        // Transmission falls with the fibre in the way: about a quarter at 50 g/m², a tenth at
        // 150 g/m², next to nothing for denim.
        let mass = (fabric.mass as f32).clamp(0.01, 2.0);
        let passes = 0.38 * libm::expf(-mass / 0.11);
        Look { matte, passes, sheen, gloss }
    }

    /// The linen cover of a mannequin.
    pub fn of_body() -> Self {
        Look {
            matte: 0.95,
            passes: 0.0,
            sheen: Sheen { strength: 0.08, order: 1, tint: 0.3 },
            gloss: [
                Gloss { strength: 0.04, along: 0.45, across: 0.45, tint: 0.0 },
                Gloss::default(),
            ],
        }
    }

    /// A waxed or glazed solid.
    pub fn of_solid() -> Self {
        Look {
            matte: 0.95,
            passes: 0.0,
            sheen: Sheen::default(),
            gloss: [
                Gloss { strength: 0.04, along: 0.32, across: 0.32, tint: 0.0 },
                Gloss::default(),
            ],
        }
    }

    /// Light sent towards `eye` beside the matte, as a share of the light from `light` (no cosine
    /// included). Directions point away from the surface.
    pub fn shine(
        &self,
        colour: &Light3,
        threads: &Threads,
        eye: &Vector,
        light: &Vector,
    ) -> Light3 {
        let (see, lit) = (threads.normal.dot(eye).max(0.02), threads.normal.dot(light));
        let mut sum = Light3::zeros();
        if lit <= 0.0 {
            return sum;
        }
        let half = (eye + light).normalize();
        if self.sheen.strength > 0.0 {
            let cosine = half.dot(&threads.normal).clamp(0.0, 1.0);
            let square = 1.0 - cosine * cosine;
            let power = if self.sheen.order > 1 { square * square } else { square };
            let density = (2.0 + 2.0 * self.sheen.order as f32) * power / (2.0 * PI);
            let shade = 1.0 / (4.0 * (lit + see - lit * see));
            sum += tinted(colour, self.sheen.tint) * (self.sheen.strength * density * shade);
        }
        for (gloss, (axis, cross)) in
            self.gloss.iter().zip([(&threads.warp, &threads.weft), (&threads.weft, &threads.warp)])
        {
            if gloss.strength > 0.0 {
                let value = gloss.value(threads, axis, cross, eye, light, &half);
                sum += tinted(colour, gloss.tint) * value;
            }
        }
        sum
    }
}

impl Gloss {
    /// The anisotropic microfacet lobe of B. Burley 2012 with the height-correlated shadowing of
    /// E. Heitz 2014.
    fn value(
        &self,
        threads: &Threads,
        axis: &Vector,
        cross: &Vector,
        eye: &Vector,
        light: &Vector,
        half: &Vector,
    ) -> f32 {
        let (a, c) = (self.along * self.along, self.across * self.across);
        let (ha, hc) = (half.dot(axis) / a, half.dot(cross) / c);
        let hn = half.dot(&threads.normal);
        let spread = ha * ha + hc * hc + hn * hn;
        let density = 1.0 / (PI * a * c * spread * spread);
        let (see, lit) = (threads.normal.dot(eye).max(0.02), threads.normal.dot(light).max(0.0));
        let reach = |d: &Vector, n: f32| {
            let (x, y) = (d.dot(axis) * a, d.dot(cross) * c);
            (x * x + y * y + n * n).sqrt()
        };
        let shade = 0.5 / (lit * reach(eye, see) + see * reach(light, lit)).max(1e-4);
        let turned = 1.0 - half.dot(eye).clamp(0.0, 1.0);
        let square = turned * turned;
        let fresnel = self.strength
            + (1.0 - self.strength) * self.strength.min(0.06) / 0.06
                * (square * square * turned)
                * 0.5;
        density * shade * fresnel
    }
}

/// A colour between white and the surface's own.
fn tinted(colour: &Light3, tint: f32) -> Light3 {
    Light3::repeat(1.0 - tint) + colour * tint
}

/// The gloss of a yarn by its fibre: strength, roughness along and across, tint.
fn fibre_gloss(fibre: Fibre) -> Gloss {
    let (strength, along, across, tint) = match fibre {
        Fibre::Cotton => (0.012, 0.60, 0.85, 0.4),
        Fibre::Linen => (0.022, 0.52, 0.80, 0.4),
        Fibre::Wool => (0.014, 0.60, 0.85, 0.5),
        Fibre::Jute => (0.016, 0.60, 0.85, 0.5),
        Fibre::Silk => (0.050, 0.42, 0.70, 0.55),
        Fibre::Viscose => (0.042, 0.45, 0.72, 0.45),
        Fibre::Polyester => (0.036, 0.46, 0.72, 0.35),
        Fibre::Nylon => (0.040, 0.44, 0.70, 0.35),
        Fibre::Metal => (0.300, 0.42, 0.62, 0.95),
    };
    Gloss { strength, along, across, tint }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::sample::{Sampler, cosine_about};
    use crate::textile::fabric::Thread;
    use crate::textile::weave::Weave;
    use crate::textile::yarn::{Twist, Yarn};

    #[test]
    fn nothing_shines_more_than_it_is_given() {
        let colour = crate::textile::Colour([255; 4]);
        let yarn = Yarn {
            name: "filament".to_owned(),
            count: 8e-6,
            plies: 1,
            twist: 200.0,
            direction: Twist::Z,
            fibre: Fibre::Silk,
            colour,
            diameter: 1e-4,
        };
        let thread = Thread { yarn, spacing: 2e-4, colour };
        let rows = vec![vec![true, true, true, false]];
        let looks = [Finish::Matte, Finish::Satin, Finish::Velvet, Finish::Wool, Finish::Raised]
            .map(|finish| {
                let weave = Weave { name: "satin".to_owned(), rows: rows.clone() };
                let structure =
                    Structure::Woven { weave, warp: thread.clone(), weft: thread.clone() };
                let fabric = Fabric {
                    name: "silk".to_owned(),
                    structure,
                    mass: 0.1,
                    thickness: 2e-4,
                    bending: [1e-6; 2],
                    tensile: [500.0; 2],
                    shear: 30.0,
                    poisson: 0.2,
                    friction: 0.2,
                    damping: 0.1,
                    finish,
                };
                Look::of_fabric(&fabric, false)
            });
        let threads = Threads { normal: Vector::y(), warp: Vector::z(), weft: Vector::x() };
        for look in looks.into_iter().chain([Look::of_body(), Look::of_solid()]) {
            for tilt in [0.05_f32, 0.3, 0.6, 1.0] {
                let eye = Vector::new((1.0 - tilt * tilt).sqrt(), tilt, 0.0);
                let white = Light3::repeat(1.0);
                let sum: f32 = (0..4096)
                    .map(|path| {
                        let pair = Sampler::new(0, [0, 0], path, 4096).pair();
                        let light = cosine_about(&threads.normal, pair);
                        look.shine(&white, &threads, &eye, &light).x * PI
                    })
                    .sum();
                let sent = look.matte + sum / 4096.0;
                // Fur and mirror are added to the matte light, not taken from it by angle; at
                // grazing angles that may exceed the whole by a little.
                let most = if tilt < 0.2 { 1.6 } else { 1.08 };
                assert!(sent < most, "{sent} at {tilt} from {look:?}");
            }
        }
    }

    #[test]
    fn threads_mirror_across_themselves() {
        let gloss = Gloss { strength: 0.1, along: 0.3, across: 0.7, tint: 0.0 };
        let look = Look {
            matte: 0.8,
            passes: 0.0,
            sheen: Sheen::default(),
            gloss: [gloss, Gloss::default()],
        };
        let threads = Threads { normal: Vector::y(), warp: Vector::z(), weft: Vector::x() };
        let white = Light3::repeat(1.0);
        let tipped_across = Vector::new(0.6, 0.8, 0.0);
        let tipped_along = Vector::new(0.0, 0.8, 0.6);
        let across = look.shine(&white, &threads, &Vector::y(), &tipped_across).x;
        let along = look.shine(&white, &threads, &Vector::y(), &tipped_along).x;
        assert!(across > 3.0 * along, "{across} against {along}");
    }
}
