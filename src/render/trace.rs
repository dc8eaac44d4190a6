//! Paths of light from the camera into the studio.

use super::figure::{Coat, Corner, Figure, Panel};
use super::finish::{Look, Threads};
use super::hierarchy::{Hierarchy, Hit, Ray, Stack};
use super::lamp::Lighting;
use super::sample::{Sampler, cosine_about, frame};
use super::tessellate::{Patch, Piece};
use super::{Light3, Vector};
use crate::mesh::compiled::Surface;
use rayon::prelude::*;
use std::f32::consts::PI;

/// A figure ready to be looked at.
#[derive(Debug)]
pub struct Set<'a> {
    /// What stands there.
    pub figure: &'a Figure<'a>,
    hierarchy: Hierarchy,
    pieces: Vec<(u32, Piece)>,
    /// Whether light comes through between some threads.
    open: bool,
}

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

/// Triangles that pieces may add up to; beyond it they stay coarser.
const MOST_PIECES: usize = 1_500_000;

/// Rays start this far off the surface that they leave, in m for things of a metre.
const LIFT: f32 = 4e-5;

/// What the floor sends back of the light that it gets.
const FLOOR: f32 = 0.62;

/// Nothing sends back all the light; a cloth that did would never let a fold grow dark.
const WHITEST: f32 = 0.94;

/// One path's mirrored light counts no more than this, against grain.
const BRIGHTEST: f32 = 6.0;

impl<'a> Set<'a> {
    /// Divides the figure into pieces with edges of about `edge` m and builds the hierarchy.
    pub fn of(figure: &'a Figure<'a>, edge: f32) -> Self {
        let parts = parts_by_coat(figure, edge);
        let lists: Vec<Vec<(u32, Piece, [Vector; 3])>> = figure
            .faces
            .par_chunks(4096)
            .enumerate()
            .map(|(chunk, faces)| {
                let mut list = Vec::new();
                for (k, face) in faces.iter().enumerate() {
                    let corners = face.corners.map(|c| figure.corners[c as usize]);
                    let patch = Patch::over(corners.map(|c| c.place), corners.map(|c| c.normal));
                    patch.divide(parts[face.coat as usize], |piece, [a, b, c]| {
                        if (b - a).cross(&(c - a)).norm_squared() > 1e-24 {
                            list.push(((chunk * 4096 + k) as u32, piece, [a, b, c]));
                        }
                    });
                }
                list
            })
            .collect();
        let mut pieces = Vec::new();
        let mut triangles = Vec::new();
        for (face, piece, corners) in lists.into_iter().flatten() {
            pieces.push((face, piece));
            triangles.push(corners);
        }
        let open = figure.coats.iter().any(|coat| match coat {
            Coat::Cloth(panel) => {
                panel.surfaces.iter().any(|surface| figure.swatches.open(surface.face))
            }
            _ => false,
        });
        Set { figure, hierarchy: Hierarchy::over(&triangles), pieces, open }
    }
}

/// Into how many parts the edges of the triangles of each coat are divided.
fn parts_by_coat(figure: &Figure, edge: f32) -> Vec<u8> {
    // Mean edge of the triangles of each coat: half the root of four times their mean area.
    let mut sums = vec![(0.0_f64, 0_usize); figure.coats.len()];
    for face in &figure.faces {
        let [a, b, c] = face.corners.map(|k| figure.corners[k as usize].place);
        let sum = &mut sums[face.coat as usize];
        sum.0 += f64::from((b - a).cross(&(c - a)).norm());
        sum.1 += 1;
    }
    let mut most = 6.0;
    loop {
        let parts: Vec<u8> = sums
            .iter()
            .map(|(doubled, count)| {
                let mean = (doubled / (*count).max(1) as f64).sqrt() as f32;
                (mean / edge).ceil().clamp(1.0, most) as u8
            })
            .collect();
        let total: usize = sums
            .iter()
            .zip(&parts)
            .map(|((_, count), parts)| count * usize::from(*parts) * usize::from(*parts))
            .sum();
        if total <= MOST_PIECES || most <= 1.0 {
            return parts;
        }
        most -= 1.0;
    }
}

/// One worker's way through the set.
#[derive(Debug)]
pub struct Tracer<'a> {
    set: &'a Set<'a>,
    lighting: &'a Lighting,
    stack: Stack,
    bounces: u32,
    lift: f32,
    /// Radius of the floor on which shadows fall, about this place, m.
    round: (Vector, f32),
    /// Whether there is a floor.
    floor: bool,
}

/// A place of the figure where light arrives.
struct Place {
    at: Vector,
    /// Normal of the triangle, towards the side that is seen.
    flat: Vector,
    threads: Threads,
    colour: Light3,
    look: Look,
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
            round: (middle, 6.0 * extent),
            floor: true,
        }
    }

    /// The same without a floor.
    #[cfg(test)]
    pub fn floating(mut self) -> Self {
        self.floor = false;
        self
    }

    /// Follows one path. `spread` is what a pixel covers at distance 1.
    pub fn path(&mut self, ray: &Ray, spread: f32, sampler: &mut Sampler) -> Seen {
        if let Some(hit) = self.nearest(ray, sampler) {
            let place = self.place(&hit, ray, Some(spread * hit.distance));
            return Seen::Figure(self.seeing(ray, &place, hit.distance, sampler));
        }
        Seen::Paper
    }

    /// Light at a place of the figure, sent towards the eye.
    fn seeing(&mut self, ray: &Ray, place: &Place, distance: f32, sampler: &mut Sampler) -> Seeing {
        let eye = -ray.direction;
        let (mut matte, mut shine) = (Light3::zeros(), Light3::zeros());
        let passes = place.look.passes;
        if let Some((direction, light)) = self.from_lamps(place, sampler) {
            let cosine = direction.dot(&place.threads.normal);
            if cosine > 0.0 {
                matte += light * (cosine * (1.0 - passes) / PI);
                let shone = place.look.shine(&place.colour, &place.threads, &eye, &direction);
                shine += light.component_mul(&shone) * cosine;
            } else {
                matte += light * (-cosine * passes / PI);
            }
        }
        let [choice, _] = sampler.pair();
        let through = choice < passes;
        let side = if through { -place.threads.normal } else { place.threads.normal };
        let direction = cosine_about(&side, sampler.pair());
        let light = self.arriving(place, &direction, self.bounces, sampler);
        matte += light;
        if !through {
            let shone = place.look.shine(&place.colour, &place.threads, &eye, &direction);
            shine += light.component_mul(&shone) * (PI / (1.0 - passes));
        }
        Seeing {
            colour: place.colour,
            matte: matte * place.look.matte,
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
        (!self.blocked(&ray, sampler)).then_some((arrival.direction, arrival.light))
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
        let ray = Ray { origin, direction: *direction, reach: f32::INFINITY };
        self.light_along(&ray, bounces, sampler)
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
        let place = self.place(&hit, ray, None);
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
        if let Some(arrival) = self.lighting.choose(&at, pair, choice, |d| d.y.max(0.0)) {
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
        if let Some(arrival) = self.lighting.choose(at, pair, choice, |d| d.y.max(0.0)) {
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

    /// 0 on the floor about the figure, 1 where shadows have run out, far away.
    pub fn openness(&self, at: &Vector) -> f32 {
        let off = at - self.round.0;
        let away = (off.x * off.x + off.z * off.z).sqrt() / self.round.1;
        let share = ((away - 0.55) / 0.45).clamp(0.0, 1.0);
        share * share * (3.0 - 2.0 * share)
    }

    /// Where the ray meets the floor, if it does within the round on which shadows fall.
    pub fn on_floor(&self, ray: &Ray) -> Option<Vector> {
        if !self.floor || ray.direction.y > -1e-6 {
            return None;
        }
        let distance = (self.set.figure.floor - ray.origin.y) / ray.direction.y;
        if distance <= 0.0 {
            return None;
        }
        let mut at = ray.origin + ray.direction * distance;
        at.y = self.set.figure.floor;
        let off = at - self.round.0;
        (off.x * off.x + off.z * off.z < self.round.1 * self.round.1).then_some(at)
    }

    fn nearest(&mut self, ray: &Ray, sampler: &mut Sampler) -> Option<Hit> {
        let set = self.set;
        if !set.open {
            return set.hierarchy.nearest(ray, &mut self.stack, |_, _, _| true);
        }
        let [choice, _] = sampler.pair();
        set.hierarchy.nearest(ray, &mut self.stack, |k, u, v| set.solid(k, u, v, choice))
    }

    fn blocked(&mut self, ray: &Ray, sampler: &mut Sampler) -> bool {
        let set = self.set;
        if !set.open {
            return set.hierarchy.blocked(ray, &mut self.stack, |_, _, _| true);
        }
        let [choice, _] = sampler.pair();
        set.hierarchy.blocked(ray, &mut self.stack, |k, u, v| set.solid(k, u, v, choice))
    }

    /// A start for a ray off the surface, on the side to which it goes.
    fn off(&self, place: &Place, direction: &Vector) -> Vector {
        let side = if direction.dot(&place.threads.normal) >= 0.0 { 1.0 } else { -1.0 };
        place.at + place.flat * (self.lift * side)
    }

    /// The place of a hit. `window` is what a pixel covers there, m; none for a rough look.
    fn place(&self, hit: &Hit, ray: &Ray, window: Option<f32>) -> Place {
        let set = self.set;
        let figure = set.figure;
        let (number, piece) = set.pieces[hit.triangle as usize];
        let face = figure.faces[number as usize];
        let corners = face.corners.map(|k| figure.corners[k as usize]);
        let [u, v] = piece.shares(hit.u, hit.v);
        let w = 1.0 - u - v;
        let (at, mut flat) = set.hierarchy.place(hit);
        let mut normal = corners[0].normal * w + corners[1].normal * u + corners[2].normal * v;
        let length = normal.norm();
        normal = if length > 1e-6 { normal / length } else { flat };
        let back = flat.dot(&ray.direction) > 0.0;
        if back {
            flat = -flat;
            normal = -normal;
        }
        let normal = turned_to_eye(normal, &ray.direction);
        let coat = &figure.coats[face.coat as usize];
        let (colour, look, threads) = match coat {
            Coat::Plain { colour, look } => (*colour, *look, bare(normal)),
            Coat::Wood { look } => (wood(&at), *look, bare(normal)),
            Coat::Cloth(panel) => {
                let threads = threads(&corners, normal);
                let rest = [0, 1].map(|k| {
                    corners[0].rest[k] * f64::from(w)
                        + corners[1].rest[k] * f64::from(u)
                        + corners[2].rest[k] * f64::from(v)
                });
                // Many paths share a pixel: each needs to cover a part of it only, more where
                // the cloth is seen at an angle.
                let slant = 0.35 / normal.dot(&ray.direction).abs().max(0.05);
                let wide = window.map_or(0.02, |window| window * slant.clamp(0.6, 3.0));
                let mut colour = figure.cloth_colour(panel, rest, back, wide, &threads, ray);
                if window.is_some() {
                    let streak = panel.slubs.map_or(1.0, |slubs| slubs.light(rest, wide));
                    colour *= (streak * figure.selvages.left(number, rest, wide)).max(0.0);
                    colour = colour.map(|c| c.min(WHITEST));
                }
                (colour, panel.looks[usize::from(back)], threads)
            }
        };
        Place { at, flat, threads, colour, look }
    }
}

impl Set<'_> {
    /// Whether a thread stands at the place of a piece; `choice` decides where threads and gaps
    /// are too fine to tell.
    fn solid(&self, triangle: u32, u: f32, v: f32, choice: f32) -> bool {
        let (face, piece) = self.pieces[triangle as usize];
        let face = self.figure.faces[face as usize];
        let Coat::Cloth(panel) = &self.figure.coats[face.coat as usize] else { return true };
        let [u, v] = piece.shares(u, v).map(f64::from);
        let [a, b, c] = face.corners.map(|k| self.figure.corners[k as usize].rest);
        let rest = [0, 1].map(|k| a[k] * (1.0 - u - v) + b[k] * u + c[k] * v);
        let Some((surface, [u, v])) = panel.surface_at(rest) else { return true };
        if !self.figure.swatches.open(surface.face) {
            return true;
        }
        // Every layer takes a share of its own of the one number.
        let share = choice + triangle as f32 * 0.618_034;
        self.figure.swatches.look(surface.face, u, v, 1e-3).cover > share - share.floor()
    }
}

impl Panel {
    /// The surface that shows at a place of the panel, and the place from its origin.
    fn surface_at(&self, rest: [f64; 2]) -> Option<(&Surface, [f64; 2])> {
        let holds = |surface: &&Surface| match surface.area {
            Some([u0, v0, u1, v1]) => (u0..=u1).contains(&rest[0]) && (v0..=v1).contains(&rest[1]),
            None => true,
        };
        // Rounding at the very edge must not fall between two areas.
        let surface = self.surfaces.iter().find(holds).or_else(|| self.surfaces.last())?;
        let [u0, v0] = surface.area.map_or([0.0; 2], |[u0, v0, _, _]| [u0, v0]);
        Some((surface, [rest[0] - u0, rest[1] - v0]))
    }
}

impl Figure<'_> {
    /// Colour of a panel at a place, seen along the ray through a window `wide` m wide.
    fn cloth_colour(
        &self,
        panel: &Panel,
        rest: [f64; 2],
        back: bool,
        wide: f32,
        threads: &Threads,
        ray: &Ray,
    ) -> Light3 {
        let Some((surface, [u, v])) = panel.surface_at(rest) else { return panel.plain };
        let region =
            if back && self.swatches.has(surface.back) { surface.back } else { surface.face };
        let mut colour = self.swatches.look(region, u, v, wide).colour;
        if let Some([warp, weft]) = self.swatches.shot(region) {
            // Looked at along the weft, the crowns of the warp hide the weft between them, and
            // the other way round.
            let along_weft = ray.direction.dot(&threads.weft);
            let along_warp = ray.direction.dot(&threads.warp);
            let lean = along_weft * along_weft - along_warp * along_warp;
            let share = (0.5 + 0.75 * lean).clamp(0.05, 0.95);
            let turned = warp * share + weft * (1.0 - share);
            let even = (warp + weft) * 0.5;
            colour = colour.zip_map(&turned.zip_map(&even, |t, e| t / e.max(1e-3)), |c, f| c * f);
        }
        colour.map(|c| c.clamp(0.0, WHITEST))
    }
}

/// Directions of warp and weft on a triangle of cloth, from its rest places.
fn threads(corners: &[Corner; 3], normal: Vector) -> Threads {
    let [a, b, c] = corners;
    let (first, second) = (b.place - a.place, c.place - a.place);
    let [u1, v1] = [0, 1].map(|k| (b.rest[k] - a.rest[k]) as f32);
    let [u2, v2] = [0, 1].map(|k| (c.rest[k] - a.rest[k]) as f32);
    let sign = if u1 * v2 - u2 * v1 < 0.0 { -1.0 } else { 1.0 };
    let weft = (first * v2 - second * v1) * sign;
    let weft = weft - normal * weft.dot(&normal);
    let length = weft.norm();
    if length < 1e-12 {
        return bare(normal);
    }
    let weft = weft / length;
    Threads { normal, weft, warp: normal.cross(&weft) }
}

/// Any directions, for surfaces without threads.
fn bare(normal: Vector) -> Threads {
    let (weft, warp) = frame(&normal);
    Threads { normal, warp, weft }
}

/// The smooth normal may lean away from the eye at the outline; it is brought back to the edge.
fn turned_to_eye(normal: Vector, direction: &Vector) -> Vector {
    let away = normal.dot(direction);
    if away < -0.01 {
        return normal;
    }
    (normal - direction * (away + 0.01)).normalize()
}

/// Planed wood: rings of a log cut along its length, drawn out along x.
fn wood(at: &Vector) -> Light3 {
    let wave = libm::sinf(at.x * 2.1 + 1.3) * 0.011 + libm::sinf(at.x * 5.7 + at.z * 3.0) * 0.004;
    let (y, z) = (at.y + 0.13 + wave, at.z + 0.31 + wave * 1.7);
    let ring = (y * y * 6.0 + z * z).sqrt() * 62.0;
    let late = 0.5 + 0.5 * libm::sinf(ring + libm::sinf(ring * 0.37) * 1.3);
    let late = late * late * late;
    Light3::new(0.47, 0.335, 0.215) * (1.0 - 0.26 * late)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::surface::{Surface as Solid, SurfaceKind};
    use crate::drape::draped::{Draped, Stats};
    use crate::mesh::compiled::Compiled;
    use crate::render::lamp::Dome;
    use nalgebra::{Point3, Vector3};

    /// A ball of radius 1 about (0, 1, 0), coarse.
    fn ball() -> Draped {
        let mut surface = Solid { kind: SurfaceKind::Solid, ..Solid::default() };
        const SIDES: u32 = 12;
        for ring in 0..=SIDES {
            for side in 0..2 * SIDES {
                let polar = f64::from(ring) * std::f64::consts::PI / f64::from(SIDES);
                let turn = f64::from(side) * std::f64::consts::PI / f64::from(SIDES);
                let (sin, cos) = polar.sin_cos();
                let normal = Vector3::new(sin * turn.sin(), -cos, sin * turn.cos());
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
        let mut figure = Figure::of(&compiled, &draped);
        let mut look = Look::of_body();
        look.matte = 1.0;
        look.sheen.strength = 0.0;
        look.gloss[0].strength = 0.0;
        figure.coats = vec![Coat::Plain { colour: Light3::repeat(1.0), look }];
        let set = Set::of(&figure, 0.05);
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
        let figure = Figure::of(&compiled, &draped);
        let set = Set::of(&figure, 0.05);
        let lighting = Lighting { lamps: vec![], dome: Dome::even(1.0) };
        let tracer = &mut Tracer::new(&set, &lighting, 1, Vector::y(), 1.0);
        for k in 0..100 {
            let x = -0.9 + 0.018 * k as f32;
            let origin = Vector::new(x, 1.13, 5.0);
            let ray = Ray { origin, direction: -Vector::z(), reach: f32::INFINITY };
            let mut sampler = Sampler::new(0, [0, 0], 0, 1);
            let hit = tracer.nearest(&ray, &mut sampler).expect("the ball is there");
            let place = tracer.place(&hit, &ray, None);
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
        let figure = Figure::of(&compiled, &draped);
        let set = Set::of(&figure, 0.2);
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
