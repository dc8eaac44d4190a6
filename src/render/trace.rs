//! Paths of light from the camera into the studio.

use super::figure::Coat;
use super::gouraud::CornerLight;
use super::hierarchy::{Hit, Ray, Stack};
use super::lamp::Lighting;
use super::near::Strike;
use super::sample::{Sampler, cosine_about};
use super::set::{Found, Place, Set, bare};
use super::{Light3, Vector};
use std::f32::consts::PI;

/// What one path saw.
#[derive(Clone, Copy, Debug)]
pub enum Seen {
    /// Cloth, a body or a solid.
    Figure(Seeing),
    /// The paper, behind or on the floor.
    Paper,
}

/// A look at the figure.
#[derive(Clone, Copy, Debug)]
pub struct Seeing {
    /// Own colour.
    pub colour: Light3,
    /// Matte light, as from a white surface.
    pub matte: Light3,
    /// Light mirrored and scattered by fibre ends.
    pub shine: Light3,
    /// Towards the eye's side; unit length.
    pub normal: Vector,
    /// From the eye, m.
    pub distance: f32,
}

/// Rays start this far off the surface that they leave, in m for things of a metre.
const LIFT: f32 = 4e-5;

/// What the floor sends back of the light that it gets.
const FLOOR: f32 = 0.62;

/// Shadows on the floor run out at so many half extents of the figure.
const SHADES: f32 = 1.9;

/// What is nearer to the floor than so many half extents stands on it.
const STANDS: f32 = 0.008;

/// The floor sends light back from so many half extents round the figure.
const REACHES: f32 = 6.0;

/// One path's mirrored light counts no more than this, against grain.
const BRIGHTEST: f32 = 6.0;

/// What comes mirrored from other surfaces counts no more than this.
const GLINT: f32 = 0.8;

/// One worker's way through the set.
#[derive(Debug)]
pub struct Tracer<'a> {
    set: &'a Set<'a>,
    lighting: &'a Lighting,
    stack: Stack,
    bounces: u32,
    lift: f32,
    /// The floor about this place, and half the extent of what stands there, m.
    round: (Vector, f32),
    /// Height of the floor, if there is one, m.
    floor: Option<f32>,
    /// Light at the corners, if cloth is shown by it.
    corners: Option<&'a CornerLight>,
}

impl<'a> Tracer<'a> {
    /// For a set that fills about `extent` m round `middle`.
    pub fn new(
        set: &'a Set<'a>,
        lighting: &'a Lighting,
        bounces: u32,
        middle: Vector,
        extent: f32,
    ) -> Self {
        Tracer {
            set,
            lighting,
            stack: Stack::new(),
            bounces,
            lift: LIFT * extent.max(0.25),
            round: (middle, extent),
            floor: set.figure.floor,
            corners: None,
        }
    }

    /// The same with light that was found at the corners.
    pub fn lit_at(mut self, corners: Option<&'a CornerLight>) -> Self {
        self.corners = corners;
        self
    }

    /// The same without a floor.
    #[cfg(test)]
    pub fn floating(mut self) -> Self {
        self.floor = None;
        self
    }

    /// Follows one path. `spread` is what a pixel covers at distance 1.
    pub fn path(&mut self, ray: &Ray, spread: f32, sampler: &mut Sampler) -> Seen {
        if let Some((hit, strike)) = self.looked_at(ray, spread, sampler) {
            let window = spread * hit.distance;
            let place = match &strike {
                Some(strike) => self.set.place_on_yarn(&hit, strike, ray, window),
                None => self.set.place(&hit, ray, Some(window)),
            };
            if let Some(light) = self.corners {
                let (corners, shares, behind) = self.set.corners(&hit, ray);
                return Seen::Figure(Seeing {
                    colour: place.colour,
                    matte: light.between(corners, shares, behind),
                    shine: Light3::zeros(),
                    normal: place.threads.normal,
                    distance: hit.distance,
                });
            }
            return Seen::Figure(self.seeing(ray, &place, hit.distance, sampler));
        }
        Seen::Paper
    }

    /// The first that is seen along a ray, and the yarn that is met where cloth is near.
    fn looked_at(
        &mut self,
        ray: &Ray,
        spread: f32,
        sampler: &mut Sampler,
    ) -> Option<(Hit, Option<Strike>)> {
        let set = self.set;
        if !set.near.any() {
            return Some((self.nearest(ray, sampler)?, None));
        }
        let choices = sampler.pair();
        let mut strike = None;
        let hit = set.hierarchy.nearest(ray, &mut self.stack, |triangle, u, v, distance| match set
            .found(triangle, [u, v], ray, spread * distance, choices)
        {
            Found::Open => false,
            Found::Solid => {
                strike = None;
                true
            }
            Found::Yarn(met) => {
                strike = Some(met);
                true
            }
        });
        Some((hit?, strike))
    }

    /// Matte light on one side of a corner with the coat `coat`, as from a white surface, by one
    /// path.
    pub fn corner(
        &mut self,
        at: &Vector,
        normal: &Vector,
        coat: u32,
        eye: &Vector,
        sampler: &mut Sampler,
    ) -> Light3 {
        let look = match &self.set.figure.coats[coat as usize] {
            Coat::Cloth(panel) => &panel.looks[0],
            Coat::Plain { look, .. } | Coat::Wood { look, .. } => look,
        };
        let place = Place {
            at: *at,
            flat: *normal,
            threads: bare(*normal),
            colour: Light3::repeat(1.0),
            look,
            around: None,
        };
        let direction = (at - eye).normalize();
        let ray = Ray { origin: *eye, direction, reach: f32::INFINITY };
        self.seeing(&ray, &place, 1.0, sampler).matte
    }

    /// Light at a place of the figure, sent towards the eye.
    fn seeing(
        &mut self,
        ray: &Ray,
        place: &Place<'a>,
        distance: f32,
        sampler: &mut Sampler,
    ) -> Seeing {
        let (look, threads) = (place.look, &place.threads);
        let eye = seen_from(&threads.inwards(&-ray.direction));
        let (mut matte, mut shine) = (Light3::zeros(), Light3::zeros());
        let passes = look.passes;
        if let Some((direction, light)) = self.from_lamps(place, sampler) {
            let own = threads.inwards(&direction);
            let ground = look.ground(&eye, &own);
            if own.z > 0.0 {
                matte += light * (own.z * ground * (1.0 - passes) / PI);
                shine += light.component_mul(&look.shine(&place.colour, &eye, &own)) * own.z;
            } else {
                matte += light * (-own.z * ground * passes / PI);
            }
        }
        let [choice, which] = sampler.pair();
        let pair = sampler.pair();
        if choice < passes {
            let direction = cosine_about(&-threads.normal, pair);
            let light = self.arriving(place, &direction, self.bounces, sampler);
            matte += light * look.ground(&eye, &threads.inwards(&direction));
        } else {
            // On this side the ground and the layers over it choose in turn; what is found is
            // weighed by how densely both together choose it (E. Veach and L. Guibas 1995).
            let glossy = look.glossiness(&eye);
            let choice = (choice - passes) / (1.0 - passes);
            let own = if choice < glossy { look.sample(&eye, pair, which) } else { None };
            let own = own.unwrap_or_else(|| cosine_about(&Vector::z(), pair));
            if own.z > 1e-4 {
                let dense = (1.0 - glossy) * own.z / PI + glossy * look.density(&eye, &own);
                let direction = threads.outwards(&own);
                let light = self.arriving(place, &direction, self.bounces, sampler);
                let share = own.z / dense;
                matte += light * (look.ground(&eye, &own) * share / PI);
                let shone = look.shine(&place.colour, &eye, &own) * (share / (1.0 - passes));
                shine += light.component_mul(&shone).map(|c| c.min(GLINT));
            }
        }
        Seeing {
            colour: place.colour,
            matte,
            shine: shine.map(|c| c.min(BRIGHTEST)),
            normal: place.threads.normal,
            distance,
        }
    }

    /// Light from one point of one lamp over the density of its choice, if nothing is in between.
    fn from_lamps(&mut self, place: &Place, sampler: &mut Sampler) -> Option<(Vector, Light3)> {
        let (pair, [choice, _]) = (sampler.pair(), sampler.pair());
        let (normal, passes) = (place.threads.normal, place.look.passes);
        let arrival = self.lighting.choose(&place.at, pair, choice, |direction| {
            let cosine = direction.dot(&normal);
            if cosine > 0.0 { cosine * (1.0 - passes) } else { -cosine * passes }
        })?;
        if arrival.direction.dot(&normal) <= 0.0 && passes <= 0.0 {
            return None;
        }
        let ray = Ray {
            origin: self.off(place, &arrival.direction),
            direction: arrival.direction,
            reach: arrival.distance,
        };
        let mut light = arrival.light;
        if let Some(around) = &place.around {
            // What comes through a yarn from behind is not kept off by that yarn.
            if arrival.direction.dot(&normal) > 0.0 && around.keeps(&arrival.direction) {
                return None;
            }
            light *= around.gain();
        }
        (!self.blocked(&ray, sampler)).then_some((arrival.direction, light))
    }

    /// Light that arrives at a place from a direction, lamps apart.
    fn arriving(
        &mut self,
        place: &Place,
        direction: &Vector,
        bounces: u32,
        sampler: &mut Sampler,
    ) -> Light3 {
        let origin = self.off(place, direction);
        let mut ray = Ray { origin, direction: *direction, reach: f32::INFINITY };
        let mut share = Light3::repeat(1.0);
        if let Some(around) = &place.around {
            let normal = &place.threads.normal;
            if direction.dot(normal) > 0.0 && around.keeps(direction) {
                // Another yarn is met. It sends on what comes to it from outside, about as much as
                // comes from there to this one.
                let cloth = around.cloth(normal);
                let into = direction.dot(&cloth).min(0.0);
                ray.direction = (direction - cloth * (2.0 * into)).normalize();
                share = place.colour;
            }
        }
        self.light_along(&ray, bounces, sampler).component_mul(&share)
    }

    /// Light that comes back along a ray, lamps apart.
    fn light_along(&mut self, ray: &Ray, bounces: u32, sampler: &mut Sampler) -> Light3 {
        let on_floor = self.on_floor(ray);
        let reach = match &on_floor {
            Some(at) => (at - ray.origin).norm(),
            None => ray.reach,
        };
        let Some(hit) = self.nearest(&Ray { reach, ..*ray }, sampler) else {
            return match on_floor {
                Some(at) => self.floor_light(at, sampler),
                None => self.lighting.dome.radiance(&ray.direction),
            };
        };
        let place = self.set.place(&hit, ray, None);
        let mut light = Light3::zeros();
        if let Some((direction, lamp)) = self.from_lamps(&place, sampler) {
            let cosine = direction.dot(&place.threads.normal);
            let share = if cosine > 0.0 { 1.0 - place.look.passes } else { place.look.passes };
            light += lamp * (cosine.abs() * share / PI);
        }
        if bounces > 1 {
            let [choice, _] = sampler.pair();
            let through = choice < place.look.passes;
            let side = if through { -place.threads.normal } else { place.threads.normal };
            let direction = cosine_about(&side, sampler.pair());
            light += self.arriving(&place, &direction, bounces - 1, sampler);
        } else {
            light += self.all_round() * 0.5;
        }
        light.component_mul(&place.colour)
    }

    /// What the dome brings to a place that sees half of it.
    fn all_round(&self) -> Light3 {
        let dome = &self.lighting.dome;
        (dome.zenith + dome.horizon * 2.0 + dome.nadir) * 0.25
    }

    /// Light sent back by the floor, its own surroundings taken as open.
    fn floor_light(&mut self, at: Vector, sampler: &mut Sampler) -> Light3 {
        let (pair, [choice, _]) = (sampler.pair(), sampler.pair());
        let mut light = self.all_round();
        if let Some(arrival) = self.lighting.choose_for_floor(&at, pair, choice) {
            let ray = Ray {
                origin: at + Vector::y() * self.lift,
                direction: arrival.direction,
                reach: arrival.distance,
            };
            if !self.blocked(&ray, sampler) {
                light += arrival.light * (arrival.direction.y.max(0.0) / PI);
            }
        }
        light * FLOOR
    }

    /// Light on the floor with the figure and, by the same numbers, without.
    pub fn light_on_floor(&mut self, at: &Vector, sampler: &mut Sampler) -> (Light3, Light3) {
        let origin = at + Vector::y() * self.lift;
        let (pair, [choice, _]) = (sampler.pair(), sampler.pair());
        let (mut arrives, mut empty) = (Light3::zeros(), Light3::zeros());
        if let Some(arrival) = self.lighting.choose_for_floor(at, pair, choice) {
            let light = arrival.light * (arrival.direction.y.max(0.0) / PI);
            empty += light;
            let ray = Ray { origin, direction: arrival.direction, reach: arrival.distance };
            if !self.blocked(&ray, sampler) {
                arrives += light;
            }
        }
        let direction = cosine_about(&Vector::y(), sampler.pair());
        let ray = Ray { origin, direction, reach: f32::INFINITY };
        empty += self.lighting.dome.radiance(&direction);
        arrives += self.light_along(&ray, 1, sampler);
        (arrives, empty)
    }

    /// 0 on the floor about the figure, 1 where shadows have run out, farther away.
    pub fn openness(&self, at: &Vector) -> f32 {
        let off = at - self.round.0;
        let away = (off.x * off.x + off.z * off.z).sqrt() / (SHADES * self.round.1);
        let share = ((away - 0.4) / 0.6).clamp(0.0, 1.0);
        share * share * (3.0 - 2.0 * share)
    }

    /// Whether something stands on the floor there, or reaches into it.
    pub fn covered(&mut self, at: &Vector) -> bool {
        let origin = at + Vector::y() * self.lift;
        let ray = Ray { origin, direction: Vector::y(), reach: f32::INFINITY };
        let set = self.set;
        let hit = set.hierarchy.nearest(&ray, &mut self.stack, |_, _, _, _| true);
        hit.is_some_and(|hit| hit.distance < STANDS * self.round.1 || set.leaves_body(&hit, &ray))
    }

    /// The line on the floor at which shadows have run out; empty if there is no floor.
    pub fn rim(&self) -> Vec<Vector> {
        const POINTS: u32 = 64;
        let Some(floor) = self.floor else { return Vec::new() };
        let (middle, extent) = self.round;
        (0..POINTS)
            .map(|k| {
                let (sin, cos) = libm::sincosf(k as f32 * 2.0 * PI / POINTS as f32);
                let radius = SHADES * extent;
                Vector::new(middle.x + radius * sin, floor, middle.z + radius * cos)
            })
            .collect()
    }

    /// Where the ray meets the floor, if it does not do so very far away.
    pub fn on_floor(&self, ray: &Ray) -> Option<Vector> {
        let floor = self.floor?;
        if ray.direction.y > -1e-6 {
            return None;
        }
        let distance = (floor - ray.origin.y) / ray.direction.y;
        if distance <= 0.0 {
            return None;
        }
        let mut at = ray.origin + ray.direction * distance;
        at.y = floor;
        let off = at - self.round.0;
        let reach = REACHES * self.round.1;
        (off.x * off.x + off.z * off.z < reach * reach).then_some(at)
    }

    fn nearest(&mut self, ray: &Ray, sampler: &mut Sampler) -> Option<Hit> {
        let set = self.set;
        if !set.open {
            return set.hierarchy.nearest(ray, &mut self.stack, |_, _, _, _| true);
        }
        let [choice, _] = sampler.pair();
        set.hierarchy
            .nearest(ray, &mut self.stack, |k, u, v, _| set.solid(k, u, v, &ray.direction, choice))
    }

    fn blocked(&mut self, ray: &Ray, sampler: &mut Sampler) -> bool {
        let set = self.set;
        if !set.open {
            return set.hierarchy.blocked(ray, &mut self.stack, |_, _, _, _| true);
        }
        let [choice, _] = sampler.pair();
        set.hierarchy
            .blocked(ray, &mut self.stack, |k, u, v, _| set.solid(k, u, v, &ray.direction, choice))
    }

    /// A start for a ray off the surface, on the side to which it goes.
    fn off(&self, place: &Place, direction: &Vector) -> Vector {
        let side = if direction.dot(&place.threads.normal) >= 0.0 { 1.0 } else { -1.0 };
        place.at + place.flat * (self.lift * side)
    }
}

/// The direction of the eye in the frame of a place, held above the surface: a smooth normal may
/// lean away from it.
fn seen_from(own: &Vector) -> Vector {
    if own.z >= 0.02 { *own } else { Vector::new(own.x, own.y, 0.02).normalize() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::surface::{Surface as Solid, SurfaceKind};
    use crate::drape::draped::{Draped, Stats};
    use crate::mesh::compiled::Compiled;
    use crate::render::figure::Figure;
    use crate::render::finish::Look;
    use crate::render::lamp::Dome;
    use crate::render::manner::Manner;
    use nalgebra::{Point3, Vector3};

    /// A ball of radius 1 about (0, 1, 0), coarse.
    fn ball() -> Draped {
        let mut surface = Solid { kind: SurfaceKind::Solid, ..Solid::default() };
        const SIDES: u32 = 12;
        for ring in 0..=SIDES {
            for side in 0..2 * SIDES {
                let polar = f64::from(ring) * std::f64::consts::PI / f64::from(SIDES);
                let turn = f64::from(side) * std::f64::consts::PI / f64::from(SIDES);
                let (sin, cos) = libm::sincos(polar);
                let normal = Vector3::new(sin * libm::sin(turn), -cos, sin * libm::cos(turn));
                surface.vertices.push(Point3::from(normal + Vector3::y()));
                surface.normals.push(normal);
            }
        }
        for ring in 0..SIDES {
            for side in 0..2 * SIDES {
                let (a, b) = (ring * 2 * SIDES + side, ring * 2 * SIDES + (side + 1) % (2 * SIDES));
                surface.triangles.push([a, b, b + 2 * SIDES]);
                surface.triangles.push([a, b + 2 * SIDES, a + 2 * SIDES]);
            }
        }
        Draped { positions: vec![], surfaces: vec![surface], stats: Stats::default() }
    }

    #[test]
    fn a_white_ball_in_even_light_cannot_be_seen() {
        let (compiled, draped) = (Compiled::default(), ball());
        let mut figure = Figure::of(&compiled, &draped, Manner::of(None));
        let look = Look { matte: 1.0, passes: 0.0, layers: Vec::new() };
        figure.coats = vec![Coat::Plain { body: false, colour: Light3::repeat(1.0), look }];
        let set = Set::of(&figure, 0.05, 0.02, |_| true);
        let lighting = Lighting { lamps: vec![], dome: Dome::even(1.0) };
        let mut tracer = Tracer::new(&set, &lighting, 2, Vector::y(), 1.0).floating();
        let mut met = 0;
        for path in 0..400_u32 {
            let (x, y) = ((path % 20) as f32 / 10.0 - 1.0, (path / 20) as f32 / 10.0);
            let origin = Vector::new(x, y, 5.0);
            let ray = Ray { origin, direction: -Vector::z(), reach: f32::INFINITY };
            let mut sampler = Sampler::new(0, [0, 0], path, 400);
            if let Seen::Figure(seeing) = tracer.path(&ray, 1e-3, &mut sampler) {
                met += 1;
                let light = seeing.colour.component_mul(&seeing.matte) + seeing.shine;
                // The ball is convex: every path leaves it at once and finds a light of 1.
                assert!((light - Light3::repeat(1.0)).norm() < 1e-5, "{light}");
            }
        }
        // π / 4 of the rays of the square, less a rim.
        assert!((290..330).contains(&met), "{met}");
    }

    #[test]
    fn curved_triangles_make_the_ball_round() {
        let (compiled, draped) = (Compiled::default(), ball());
        let figure = Figure::of(&compiled, &draped, Manner::of(None));
        let set = Set::of(&figure, 0.05, 0.02, |_| true);
        let lighting = Lighting { lamps: vec![], dome: Dome::even(1.0) };
        let tracer = &mut Tracer::new(&set, &lighting, 1, Vector::y(), 1.0);
        for k in 0..100 {
            let x = -0.9 + 0.018 * k as f32;
            let origin = Vector::new(x, 1.13, 5.0);
            let ray = Ray { origin, direction: -Vector::z(), reach: f32::INFINITY };
            let mut sampler = Sampler::new(0, [0, 0], 0, 1);
            let hit = tracer.nearest(&ray, &mut sampler).expect("the ball is there");
            let place = set.place(&hit, &ray, None);
            let radius = (place.at - Vector::y()).norm();
            // Facets of 15° would lie up to 1 − cos 7.5° = 0.0086 inside; the cubic is several
            // times nearer.
            assert!((radius - 1.0).abs() < 2e-3, "{radius}");
            assert!((place.threads.normal - (place.at - Vector::y())).norm() < 0.03);
        }
    }

    #[test]
    fn the_floor_is_as_bright_as_empty_where_the_figure_is_far() {
        let (compiled, draped) = (Compiled::default(), ball());
        let figure = Figure::of(&compiled, &draped, Manner::of(None));
        let set = Set::of(&figure, 0.2, 0.02, |_| true);
        let lighting = Lighting { lamps: vec![], dome: Dome::even(1.0) };
        let mut tracer = Tracer::new(&set, &lighting, 1, Vector::y(), 1.0);
        let mut shade = |x: f32| {
            let (mut arrives, mut empty) = (0.0, 0.0);
            for path in 0..256 {
                let mut sampler = Sampler::new(0, [0, 0], path, 256);
                let at = Vector::new(x, 0.0, 0.0);
                let (with, without) = tracer.light_on_floor(&at, &mut sampler);
                arrives += with.y;
                empty += without.y;
            }
            arrives / empty
        };
        let (near, far) = (shade(0.05), shade(30.0));
        assert!(near < 0.3, "{near}");
        assert!((far - 1.0).abs() < 0.01, "{far}");
    }
}
