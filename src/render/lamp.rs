//! What lights the figure: lamps with an extent, and a dome of sky or studio walls round it.
//!
//! Lamps stand with the camera, as in a studio where the figure turns and the lights stay.

use super::{Light3, Vector};
use crate::garment::scene::Light;
use std::f32::consts::PI;

/// What a white card in the main light sends back; the tone curve bends it to just below white.
const EXPOSURE: f32 = 1.26;

/// A rectangle that shines on one side.
#[derive(Clone, Copy, Debug)]
pub struct Lamp {
    /// Its middle, m.
    pub centre: Vector,
    /// Half of its width and half of its height, m.
    pub half: [Vector; 2],
    /// Where it shines; unit length.
    pub normal: Vector,
    /// Its radiance.
    pub radiance: Light3,
    /// Whether a flag keeps its light off the floor.
    pub flagged: bool,
}

/// Light from all round.
#[derive(Clone, Copy, Debug)]
pub struct Dome {
    /// From straight above.
    pub zenith: Light3,
    /// From the horizon.
    pub horizon: Light3,
    /// From below.
    pub nadir: Light3,
}

/// All the light there is.
#[derive(Clone, Debug)]
pub struct Lighting {
    /// The lamps.
    pub lamps: Vec<Lamp>,
    /// The dome.
    pub dome: Dome,
}

/// Light that arrives at a place from a lamp.
#[derive(Clone, Copy, Debug)]
pub struct Arrival {
    /// Towards the lamp; unit length.
    pub direction: Vector,
    /// To the lamp, m.
    pub distance: f32,
    /// Radiance over the density of the choice, without the cosine at the place.
    pub light: Light3,
}

/// The axes of a camera that looks horizontally at the middle of the figure.
#[derive(Clone, Copy, Debug)]
pub struct Stand {
    /// Middle of the figure, m.
    pub middle: Vector,
    /// Half the extent of the figure, m.
    pub extent: f32,
    /// To the right of the picture; unit length.
    pub right: Vector,
    /// From the figure to the camera, horizontal; unit length.
    pub front: Vector,
}

impl Dome {
    /// Radiance from the direction.
    pub fn radiance(&self, direction: &Vector) -> Light3 {
        let y = direction.y;
        if y >= 0.0 {
            self.horizon + (self.zenith - self.horizon) * y
        } else {
            self.horizon + (self.nadir - self.horizon) * (-y).sqrt()
        }
    }

    /// The same radiance from everywhere.
    #[cfg(test)]
    pub fn even(radiance: f32) -> Self {
        let light = Light3::repeat(radiance);
        Dome { zenith: light, horizon: light, nadir: light }
    }
}

impl Lighting {
    /// The named light about a figure.
    pub fn named(light: Light, stand: &Stand) -> Self {
        let mut lighting = match light {
            Light::Studio => Self::studio(stand),
            Light::Daylight => Self::daylight(stand),
            Light::Overcast => Self::overcast(stand),
        };
        lighting.expose(stand);
        lighting
    }

    /// A large soft key from the upper left that grazes the folds, a weak broad fill from the
    /// right, a strip from behind that draws the outline and is kept off the floor, and dim walls.
    fn studio(stand: &Stand) -> Self {
        let lamp = |at: [f32; 3], size: [f32; 2], radiance: [f32; 3]| {
            Lamp::aimed(stand, at, size, Light3::from(radiance))
        };
        let rim = lamp([3.0, 1.6, -3.2], [0.5, 1.5], [7.0, 7.0, 7.1]).flagged();
        Lighting {
            lamps: vec![
                lamp([-4.0, 3.1, 2.7], [1.35, 1.35], [10.2, 10.1, 9.95]),
                lamp([4.2, 0.9, 3.4], [1.5, 1.6], [0.50, 0.497, 0.49]),
                rim,
            ],
            dome: Dome {
                zenith: Light3::new(0.240, 0.239, 0.238),
                horizon: Light3::new(0.070, 0.0695, 0.069),
                nadir: Light3::new(0.040, 0.0393, 0.0385),
            },
        }
    }

    /// A veiled sun and a blue sky.
    fn daylight(stand: &Stand) -> Self {
        let lamp = |at: [f32; 3], size: [f32; 2], radiance: [f32; 3]| {
            Lamp::aimed(stand, at, size, Light3::from(radiance))
        };
        Lighting {
            lamps: vec![lamp([-8.5, 12.0, 10.0], [0.75, 0.75], [300.0, 285.0, 258.0])],
            dome: Dome {
                zenith: Light3::new(0.50, 0.62, 0.85),
                horizon: Light3::new(0.78, 0.83, 0.90),
                nadir: Light3::new(0.30, 0.29, 0.27),
            },
        }
    }

    /// The sky of the CIE's overcast standard: the zenith three times as bright as the horizon.
    fn overcast(stand: &Stand) -> Self {
        // Most of it comes through one wide lamp overhead, which leaves less grain.
        let overhead = Lamp::aimed(stand, [-0.6, 5.0, 1.2], [3.0, 3.0], Light3::repeat(1.5));
        Lighting {
            lamps: vec![overhead],
            dome: Dome {
                zenith: Light3::new(0.72, 0.74, 0.77),
                horizon: Light3::new(0.48, 0.49, 0.51),
                nadir: Light3::new(0.24, 0.24, 0.235),
            },
        }
    }

    /// Scales all light as a photographer sets the exposure: a white card in the middle, turned
    /// half towards the camera and half towards the main lamp, is to send back [`EXPOSURE`].
    fn expose(&mut self, stand: &Stand) {
        let towards = match self.lamps.first() {
            Some(lamp) => (lamp.centre - stand.middle).normalize(),
            None => Vector::y(),
        };
        let card = (towards + stand.front).normalize();
        let sent = self.sent_by_card(&stand.middle, &card).max();
        if sent > 0.0 {
            let scale = EXPOSURE / sent;
            for lamp in &mut self.lamps {
                lamp.radiance *= scale;
            }
            self.dome.zenith *= scale;
            self.dome.horizon *= scale;
            self.dome.nadir *= scale;
        }
    }

    /// What a white matte card sends back with nothing else about: irradiance over π.
    pub fn sent_by_card(&self, place: &Vector, normal: &Vector) -> Light3 {
        let mut sum = Light3::zeros();
        for lamp in &self.lamps {
            const STEPS: usize = 8;
            for i in 0..STEPS * STEPS {
                let share = |k: usize| (k as f32 + 0.5) / STEPS as f32;
                let arrival = lamp.arrival(place, [share(i % STEPS), share(i / STEPS)]);
                let cosine = arrival.direction.dot(normal).max(0.0);
                sum += arrival.light * (cosine / (PI * (STEPS * STEPS) as f32));
            }
        }
        const RINGS: usize = 8;
        const SPOKES: usize = 16;
        for i in 0..RINGS * SPOKES {
            let pair = [
                ((i / SPOKES) as f32 + 0.5) / RINGS as f32,
                ((i % SPOKES) as f32 + 0.5) / SPOKES as f32,
            ];
            let direction = super::sample::cosine_about(normal, pair);
            sum += self.dome.radiance(&direction) / (RINGS * SPOKES) as f32;
        }
        sum
    }

    /// Chooses a lamp by what it could bring to the place, and a point on it. `weigh` says how
    /// much of the light from a direction counts there, from 0 to 1. None if no lamp counts.
    pub fn choose(
        &self,
        place: &Vector,
        pair: [f32; 2],
        choice: f32,
        weigh: impl Fn(&Vector) -> f32,
    ) -> Option<Arrival> {
        self.choose_among(|_| true, place, pair, choice, weigh)
    }

    /// The same for a place on the floor.
    pub fn choose_for_floor(&self, place: &Vector, pair: [f32; 2], choice: f32) -> Option<Arrival> {
        self.choose_among(|lamp| !lamp.flagged, place, pair, choice, |d| d.y.max(0.0))
    }

    fn choose_among(
        &self,
        burns: impl Fn(&Lamp) -> bool,
        place: &Vector,
        pair: [f32; 2],
        choice: f32,
        weigh: impl Fn(&Vector) -> f32,
    ) -> Option<Arrival> {
        let mut shares = [0.0_f32; 4];
        let mut whole = 0.0;
        for (share, lamp) in shares.iter_mut().zip(&self.lamps).filter(|(_, l)| burns(l)) {
            let to = lamp.centre - place;
            let distance = to.norm().max(1e-4);
            let direction = to / distance;
            let facing = (-direction.dot(&lamp.normal)).max(0.0);
            // A floor keeps lamps that only just show over the surface's edge.
            let counts = weigh(&direction).max(0.03);
            let strength = lamp.radiance.sum() * lamp.area() / (distance * distance);
            *share = strength * facing * counts;
            whole += *share;
        }
        if whole <= 0.0 {
            return None;
        }
        let mut left = choice * whole;
        let mut picked = None;
        for (share, lamp) in shares.iter().zip(&self.lamps) {
            if *share > 0.0 {
                picked = Some((share / whole, lamp));
                if left < *share {
                    break;
                }
                left -= share;
            }
        }
        let (chance, lamp) = picked?;
        let mut arrival = lamp.arrival(place, pair);
        arrival.light /= chance;
        Some(arrival)
    }
}

impl Lamp {
    /// A lamp at `at` (right, up, front, in extents from the middle), aimed at the middle.
    fn aimed(stand: &Stand, at: [f32; 3], half: [f32; 2], radiance: Light3) -> Self {
        let offset = stand.right * at[0] + Vector::y() * at[1] + stand.front * at[2];
        let centre = stand.middle + offset * stand.extent;
        let normal = -offset.normalize();
        let across = Vector::y().cross(&normal);
        let across = if across.norm() > 1e-3 { across.normalize() } else { stand.right };
        let up = normal.cross(&across);
        Lamp {
            centre,
            half: [across * (half[0] * stand.extent), up * (half[1] * stand.extent)],
            normal,
            radiance,
            flagged: false,
        }
    }

    /// The same with a flag that keeps its light off the floor.
    fn flagged(self) -> Self {
        Lamp { flagged: true, ..self }
    }

    /// Area, m².
    pub fn area(&self) -> f32 {
        4.0 * self.half[0].norm() * self.half[1].norm()
    }

    /// Light from the point of the lamp that the pair of shares names.
    pub fn arrival(&self, place: &Vector, pair: [f32; 2]) -> Arrival {
        let point = self.centre
            + self.half[0] * (2.0 * pair[0] - 1.0)
            + self.half[1] * (2.0 * pair[1] - 1.0);
        let to = point - place;
        let square = to.norm_squared().max(1e-8);
        let distance = square.sqrt();
        let direction = to / distance;
        let facing = (-direction.dot(&self.normal)).max(0.0);
        Arrival { direction, distance, light: self.radiance * (facing * self.area() / square) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stand() -> Stand {
        Stand {
            middle: Vector::new(0.0, 0.9, 0.0),
            extent: 0.9,
            right: Vector::x(),
            front: Vector::z(),
        }
    }

    #[test]
    fn every_named_light_exposes_a_white_card_alike() {
        for light in [Light::Studio, Light::Daylight, Light::Overcast] {
            let stand = stand();
            let lighting = Lighting::named(light, &stand);
            let towards = (lighting.lamps[0].centre - stand.middle).normalize();
            let card = (towards + stand.front).normalize();
            let sent = lighting.sent_by_card(&stand.middle, &card);
            assert!((sent.max() - EXPOSURE).abs() < 1e-3, "{light:?} {sent}");
        }
    }

    #[test]
    fn an_even_dome_is_sent_back_whole_by_a_white_card() {
        let lighting = Lighting { lamps: vec![], dome: Dome::even(1.0) };
        let sent = lighting.sent_by_card(&Vector::zeros(), &Vector::y());
        assert!((sent.x - 1.0).abs() < 1e-4);
    }

    #[test]
    fn a_lamp_chosen_at_random_brings_on_average_what_all_bring() {
        let lighting = Lighting::named(Light::Studio, &stand());
        let place = Vector::new(0.1, 1.2, 0.1);
        let normal = Vector::new(-0.6, 0.0, 0.8);
        let mut sum = 0.0;
        const PATHS: u32 = 4096;
        for path in 0..PATHS {
            let mut sampler = crate::render::sample::Sampler::new(0, [0, 0], path, PATHS);
            let (pair, [choice, _]) = (sampler.pair(), sampler.pair());
            let weigh = |d: &Vector| d.dot(&normal).max(0.0);
            if let Some(arrival) = lighting.choose(&place, pair, choice, weigh) {
                sum += arrival.light.y * arrival.direction.dot(&normal).max(0.0) / PI;
            }
        }
        let dark = Lighting { dome: Dome::even(0.0), ..lighting.clone() };
        let exact = dark.sent_by_card(&place, &normal).y;
        let mean = sum / PATHS as f32;
        assert!((mean / exact - 1.0).abs() < 0.02, "{mean} against {exact}");
    }
}
