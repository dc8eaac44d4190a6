//! How light leaves a surface: which models of reflection lie over its matte ground.

use super::brdf::{Albedo, Ashikhmin, Brdf, Charlie, Model, Schlick};
use super::{Light3, Vector};
use crate::textile::fabric::{Fabric, Finish, Structure};
use crate::textile::yarn::Fibre;
use std::f32::consts::PI;

/// The look of one side of a surface, without its colour.
#[derive(Clone, Debug)]
pub struct Look {
    /// Share of the light that the ground sends on the matte way.
    pub matte: f32,
    /// Share of the matte light that comes out on the other side.
    pub passes: f32,
    /// What lies over the ground.
    pub layers: Vec<Layer>,
}

/// Light that is mirrored or scattered before it reaches the ground.
#[derive(Clone, Debug)]
pub struct Layer {
    model: Model,
    /// How much of the surface it covers.
    share: f32,
    /// Share of the cloth's own colour in it, against white.
    tint: f32,
    /// Whether its threads run along the weft.
    across: bool,
    albedo: Albedo,
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

impl Threads {
    /// A direction in the frame of the place: along the warp, along the weft, upright.
    pub fn inwards(&self, direction: &Vector) -> Vector {
        Vector::new(
            direction.dot(&self.warp),
            direction.dot(&self.weft),
            direction.dot(&self.normal),
        )
    }

    /// The way back.
    pub fn outwards(&self, own: &Vector) -> Vector {
        self.warp * own.x + self.weft * own.y + self.normal * own.z
    }
}

/// The smooth side of a fibre mirrors so much of the light straight on: a refractive index of
/// 1.54, as cellulose, keratin and polyester have it within 0.04 (W. E. Morton and J. W. S. Hearle,
/// "Physical Properties of Textile Fibres", chapter 24).
const FIBRE: f32 = 0.045;

/// The same for gilt wire, its colour apart.
const METAL: f32 = 0.75;

impl Look {
    /// A side of a fabric after a finish: the face, or the back.
    pub fn of_fabric(fabric: &Fabric, finish: Finish, back: bool) -> Self {
        // How much of each thread lies on this side, and what it is spun from.
        let (shares, fibres) = match &fabric.structure {
            Structure::Woven { weave, warp, weft } => {
                let face = weave.warp_share() as f32;
                let share = if back { 1.0 - face } else { face };
                ([share, 1.0 - share], [warp.yarn.fibre, weft.yarn.fibre])
            }
            // Loops show their legs, which run along the wales.
            Structure::Knitted { yarn, .. } => ([0.7, 0.3], [yarn.fibre, yarn.fibre]),
        };
        let knitted = matches!(fabric.structure, Structure::Knitted { .. });
        let mut layers = Vec::new();
        match finish {
            Finish::Satin => {
                // The threads that float lead; their ends and those that bind give the rest.
                let floats = usize::from(shares[1] > shares[0]);
                let gloss = Gloss::of(fibres[floats]);
                let [along, across] = gloss.spread;
                let mirrored = (FILAMENTS * gloss.reflectance).min(1.0);
                let faces = Ashikhmin::satin(mirrored, 0.62 * along, 0.85 * across);
                let share = (1.5 * gloss.share).clamp(0.5, 1.0);
                let model = Model::Ashikhmin(Box::new(faces));
                layers.push(Layer::new(model, share, gloss.tint, floats == 1));
            }
            Finish::Velvet if !back => {
                let pile = Ashikhmin::velvet(PILE, 0.75);
                let model = Model::Ashikhmin(Box::new(pile));
                layers.push(Layer::new(model, 1.0, PILE_TINT, false));
            }
            finish => {
                let left = match finish {
                    Finish::Wool => 0.4,
                    Finish::Raised => 0.15,
                    Finish::Velvet => 0.0,
                    _ => 1.0,
                };
                for k in 0..2 {
                    let gloss = Gloss::of(fibres[k]);
                    let [along, across] = gloss.spread;
                    let (share, along) = if knitted {
                        (0.6 * gloss.share, along.max(0.2))
                    } else {
                        (gloss.share, along)
                    };
                    let share = share * shares[k] * left;
                    if share > 0.0 {
                        let threads = Schlick {
                            reflectance: gloss.reflectance,
                            roughness: along * across,
                            isotropy: along / across,
                        };
                        layers.push(Layer::new(Model::Schlick(threads), share, gloss.tint, k == 1));
                    }
                }
            }
        }
        let fur = match finish {
            Finish::Matte => Some((0.08, 0.7)),
            Finish::Satin => None,
            Finish::Wool => Some((0.26, 0.6)),
            Finish::Raised => Some((0.45, 0.65)),
            Finish::Velvet if back => Some((0.12, 0.5)),
            Finish::Velvet => None,
        };
        if let Some((share, tint)) = fur {
            layers.push(Layer::new(Model::Charlie(Charlie { order: 1 }), share, tint, false));
        }
        // Light that goes in between upright fibres is caught there.
        let matte = if finish == Finish::Velvet && !back { 0.45 } else { 1.0 };
        Look { matte, passes: passes(fabric), layers }
    }

    /// A yarn of a fabric after a finish, seen from so near that it is round: the warp (0) or the
    /// weft (1). Its fibres run along the first direction of the place.
    pub fn of_yarn(fabric: &Fabric, finish: Finish, thread: usize) -> Self {
        let fibre = match &fabric.structure {
            Structure::Woven { warp, weft, .. } => [warp, weft][thread.min(1)].yarn.fibre,
            Structure::Knitted { yarn, .. } => yarn.fibre,
        };
        let gloss = Gloss::of(fibre);
        let [along, across] = gloss.spread;
        let (share, mirrored, fur) = match finish {
            Finish::Matte => (gloss.share, 1.0, 0.08),
            Finish::Satin => ((1.5 * gloss.share).clamp(0.5, 1.0), FILAMENTS, 0.0),
            Finish::Wool => (0.4 * gloss.share, 1.0, 0.26),
            Finish::Raised => (0.15 * gloss.share, 1.0, 0.45),
            Finish::Velvet => (0.0, 1.0, 0.45),
        };
        let mut layers = Vec::new();
        if share > 0.0 {
            // The roundness of the yarn spreads the light across it: what is left is the fibre's.
            let fibres = Schlick {
                reflectance: (mirrored * gloss.reflectance).min(1.0),
                roughness: (along * 0.6 * across).max(0.02),
                isotropy: (along / (0.6 * across)).min(1.0),
            };
            layers.push(Layer::new(Model::Schlick(fibres), share, gloss.tint, false));
        }
        if fur > 0.0 {
            layers.push(Layer::new(Model::Charlie(Charlie { order: 1 }), fur, 0.65, false));
        }
        Look { matte: 1.0, passes: passes(fabric), layers }
    }

    /// A fabric that sends all light on the matte way.
    pub fn matte(fabric: &Fabric) -> Self {
        Look { matte: 1.0, passes: passes(fabric), layers: Vec::new() }
    }

    /// The linen cover of a mannequin.
    pub fn of_body() -> Self {
        let fur = Layer::new(Model::Charlie(Charlie { order: 1 }), 0.08, 0.3, false);
        Look { matte: 0.95, passes: 0.0, layers: vec![Layer::glaze(0.2), fur] }
    }

    /// A waxed or glazed solid.
    pub fn of_solid() -> Self {
        Look { matte: 0.95, passes: 0.0, layers: vec![Layer::glaze(0.1)] }
    }

    /// What of the matte light from `light` goes to the ground and from there to `eye`: all that
    /// the layers do not send back themselves (L. Szirmay-Kalos and C. Kelemen 2001: albedos of
    /// both directions, so that the two may be exchanged and no light is made). Directions in the
    /// frame of the place; `light` may come from behind.
    pub fn ground(&self, eye: &Vector, light: &Vector) -> f32 {
        let mut left = self.matte;
        let (mut seen, mut lit, mut mean) = (0.0, 0.0, 0.0);
        for layer in &self.layers {
            seen += layer.share * layer.albedo(eye);
            lit += layer.share * layer.albedo(light);
            mean += layer.share * layer.albedo.mean();
        }
        left *= (1.0 - seen).max(0.0);
        if light.z > 0.0 {
            left *= (1.0 - lit).max(0.0) / (1.0 - mean).max(0.05);
        }
        left
    }

    /// Light that the layers send towards `eye`, as a share of the light from `light` (no cosine
    /// included), coloured. Directions in the frame of the place.
    pub fn shine(&self, colour: &Light3, eye: &Vector, light: &Vector) -> Light3 {
        let mut sum = Light3::zeros();
        for layer in &self.layers {
            let value = layer.model.value(&layer.turned(eye), &layer.turned(light));
            sum += tinted(colour, layer.tint) * (layer.share * value);
        }
        sum
    }

    /// How large a part of the directions is best chosen by the layers, not by the ground.
    pub fn glossiness(&self, eye: &Vector) -> f32 {
        let shine: f32 = self.layers.iter().map(|l| l.share * l.albedo(eye)).sum();
        (shine / (shine + self.matte)).min(0.5)
    }

    /// How densely [`Look::sample`] chooses a direction.
    pub fn density(&self, eye: &Vector, light: &Vector) -> f32 {
        let (mut sum, mut weights) = (0.0, 0.0);
        for layer in &self.layers {
            let weight = layer.share * layer.albedo(eye);
            sum += weight * layer.model.density(&layer.turned(eye), &layer.turned(light));
            weights += weight;
        }
        if weights > 0.0 { sum / weights } else { light.z.max(0.0) / PI }
    }

    /// A direction chosen by one of the layers, which the number `choice` picks.
    pub fn sample(&self, eye: &Vector, pair: [f32; 2], choice: f32) -> Option<Vector> {
        let weights: f32 = self.layers.iter().map(|l| l.share * l.albedo(eye)).sum();
        let mut left = choice * weights;
        let mut picked = None;
        for layer in &self.layers {
            picked = Some(layer);
            left -= layer.share * layer.albedo(eye);
            if left < 0.0 {
                break;
            }
        }
        let layer = picked?;
        Some(layer.turned(&layer.model.sample(&layer.turned(eye), pair)))
    }
}

/// Transmission falls with the fibre in the way: about a quarter at 50 g/m², a tenth at 150 g/m²,
/// next to nothing for denim.
fn passes(fabric: &Fabric) -> f32 {
    0.38 * libm::expf(-(fabric.mass as f32).clamp(0.01, 2.0) / 0.11)
}

/// Light that a float of clear filaments mirrors, against that of its outermost faces: what goes
/// in is mirrored by the faces below as well, and comes out in the same directions.
const FILAMENTS: f32 = 2.6;

/// Reflectance of the sides of a pile: light that grazes upright fibres meets one after another,
/// and most of it is sent on.
const PILE: f32 = 0.55;

/// Light that comes out of a pile has gone through dyed fibres.
const PILE_TINT: f32 = 0.95;

impl Layer {
    fn new(model: Model, share: f32, tint: f32, across: bool) -> Self {
        let albedo = Albedo::of(&model);
        Layer { model, share, tint, across, albedo }
    }

    /// The gloss of a surface that is alike all round, of the given roughness.
    fn glaze(roughness: f32) -> Self {
        let model = Schlick { reflectance: 0.04, roughness: roughness * roughness, isotropy: 1.0 };
        Layer::new(Model::Schlick(model), 1.0, 0.0, false)
    }

    /// A direction in the frame of the layer's own threads, and back.
    fn turned(&self, own: &Vector) -> Vector {
        if self.across { Vector::new(own.y, own.x, own.z) } else { *own }
    }

    fn albedo(&self, eye: &Vector) -> f32 {
        self.albedo.at(&self.turned(eye))
    }
}

/// A colour between white and the surface's own.
fn tinted(colour: &Light3, tint: f32) -> Light3 {
    Light3::repeat(1.0 - tint) + colour * tint
}

/// The gloss of a yarn.
struct Gloss {
    /// Reflectance of the smooth side of a fibre.
    reflectance: f32,
    /// Share of its surface that is smooth and lies along the yarn.
    share: f32,
    /// Spread of the normals along and across the yarn, as slopes.
    spread: [f32; 2],
    /// Share of the yarn's own colour in it.
    tint: f32,
}

impl Gloss {
    /// By its fibre.
    fn of(fibre: Fibre) -> Self {
        let (share, spread, tint) = match fibre {
            Fibre::Cotton => (0.27, [0.36, 0.72], 0.4),
            Fibre::Linen => (0.5, [0.27, 0.64], 0.4),
            Fibre::Wool => (0.3, [0.36, 0.72], 0.5),
            Fibre::Jute => (0.35, [0.36, 0.72], 0.5),
            Fibre::Silk => (1.0, [0.18, 0.49], 0.55),
            Fibre::Viscose => (0.93, [0.20, 0.52], 0.45),
            Fibre::Polyester => (0.8, [0.21, 0.52], 0.35),
            Fibre::Nylon => (0.9, [0.19, 0.49], 0.35),
            Fibre::Metal => (0.4, [0.18, 0.38], 0.95),
        };
        let reflectance = if fibre == Fibre::Metal { METAL } else { FIBRE };
        Gloss { reflectance, share, spread, tint }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::sample::{Sampler, cosine_about};
    use crate::textile::fabric::Thread;
    use crate::textile::weave::Weave;
    use crate::textile::yarn::{Twist, Yarn};

    #[test]
    fn nothing_sends_back_more_than_it_is_given() {
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
                Look::of_fabric(&fabric, finish, false)
            });
        const PATHS: u32 = 8192;
        for look in looks.into_iter().chain([Look::of_body(), Look::of_solid()]) {
            for tilt in [0.05_f32, 0.3, 0.6, 1.0] {
                let eye = Vector::new((1.0 - tilt * tilt).sqrt(), tilt * 0.0, tilt);
                let white = Light3::repeat(1.0);
                let sum: f32 = (0..PATHS)
                    .map(|path| {
                        let pair = Sampler::new(0, [0, 0], path, PATHS).pair();
                        let light = cosine_about(&Vector::z(), pair);
                        look.shine(&white, &eye, &light).x * PI + look.ground(&eye, &light)
                    })
                    .sum();
                let sent = sum / PATHS as f32;
                // Sharp lobes met by chance leave a percent or two of doubt.
                assert!(sent < 1.02 && sent > 0.4, "{sent} at {tilt} from {look:?}");
            }
        }
    }

    #[test]
    fn satin_mirrors_across_the_threads_that_float() {
        let model = Model::Ashikhmin(Box::new(Ashikhmin::satin(0.05, 0.15, 0.5)));
        let [warp, weft] = [false, true].map(|across| Look {
            matte: 0.8,
            passes: 0.0,
            layers: vec![Layer::new(model.clone(), 1.0, 0.0, across)],
        });
        let white = Light3::repeat(1.0);
        let tipped = Vector::new(0.0, 0.6, 0.8);
        let seen = |look: &Look| look.shine(&white, &Vector::z(), &tipped).x;
        assert!(seen(&warp) > 1.5 * seen(&weft));
    }
}
