//! Cloth that is so near that its yarns are seen: which it is, and what a ray meets in it.

use super::figure::{Coat, Corner, Figure, Panel};
use super::finish::{Look, Threads};
use super::hierarchy::Ray;
use super::yarn::{Bodies, Course, Met, Surface};
use super::{Light3, Vector, coat};
use rayon::prelude::*;

/// Pixels from thread to thread at which yarns begin to be shown as bodies, and from which nothing
/// else is; in between both are, mixed path by path.
const BLEND: [f32; 2] = [3.0, 6.0];

/// The yarns of all fabrics that are near.
#[derive(Debug)]
pub struct Near(Vec<Option<Yarns>>);

/// The yarns of one fabric.
#[derive(Debug)]
pub struct Yarns {
    /// As bodies.
    pub bodies: Bodies,
    /// The looks of warp and weft.
    looks: [Look; 2],
    /// How far fibres are seen.
    fibres: f32,
}

/// A yarn that a ray meets.
#[derive(Clone, Copy, Debug)]
pub struct Strike {
    met: Met,
    course: Course,
    /// Place in the panel, m.
    rest: [f64; 2],
}

/// The surroundings of a place on a yarn: what its own cloth keeps from it.
#[derive(Clone, Copy, Debug)]
pub struct Around<'a> {
    yarns: &'a Yarns,
    /// From just above the yarn.
    course: Course,
}

/// What a yarn shows where a ray meets it.
#[derive(Clone, Copy, Debug)]
pub struct Shown<'a> {
    /// The same as of other places.
    pub flat: Vector,
    /// Along the yarn, across, and outwards.
    pub threads: Threads,
    /// Own colour.
    pub colour: Light3,
    /// How light leaves it.
    pub look: &'a Look,
    /// What its own cloth keeps from it.
    pub around: Around<'a>,
}

impl Near {
    /// Of a figure, for pixels of `pixel` m.
    pub fn of(figure: &Figure, pixel: f32) -> Self {
        let mut used = vec![false; figure.fabrics.len()];
        for coat in &figure.coats {
            if let Coat::Cloth(Panel { fabric, .. }) = coat {
                if let Some(mark) = used.get_mut(*fabric) {
                    *mark = true;
                }
            }
        }
        let Some(fibres) = figure.manner.fibres else {
            return Near(used.into_iter().map(|_| None).collect());
        };
        let yarns = figure
            .fabrics
            .par_iter()
            .zip(used)
            .map(|(fabric, used)| {
                // What is nearer than the middle of the figure is larger there by a little.
                let pitch = Bodies::pitch_of(fabric) * 1.2;
                if !used || pitch <= BLEND[0] * pixel {
                    return None;
                }
                let bodies = Bodies::of(fabric)?;
                Some(Yarns { bodies, looks: figure.manner.yarn_looks(fabric), fibres })
            })
            .collect();
        Near(yarns)
    }

    /// Whether there is any.
    pub fn any(&self) -> bool {
        self.0.iter().any(Option::is_some)
    }

    /// The yarns of a coat.
    pub fn yarns(&self, coat: &Coat) -> Option<&Yarns> {
        let Coat::Cloth(panel) = coat else { return None };
        self.0.get(panel.fabric)?.as_ref()
    }
}

impl Yarns {
    /// How far yarns are shown as bodies where a pixel covers `window` m: from 0 to 1.
    pub fn share(&self, window: f32) -> f32 {
        let pixels = self.bodies.pitch / window.max(1e-9);
        let share = ((pixels - BLEND[0]) / (BLEND[1] - BLEND[0])).clamp(0.0, 1.0);
        share * share * (3.0 - 2.0 * share)
    }

    /// What a ray meets that enters the shell of a triangle of cloth, on the side that `side`
    /// names (1 the face, −1 the back), at the place with the shares `u` and `v`.
    pub fn strike(
        &self,
        corners: &[&Corner; 3],
        side: f32,
        [u, v]: [f32; 2],
        ray: &Ray,
    ) -> Option<Strike> {
        let rest = rest(corners, [u, v]);
        let mut course = course(corners, [u, v])?;
        // Far from the first thread of a long panel single precision would blur the threads.
        let tile = self.bodies.size;
        let within = |k: usize| {
            let tiles = (rest[k] / f64::from(tile[k])).floor();
            (rest[k] - tiles * f64::from(tile[k])) as f32
        };
        course.origin = Vector::new(within(0), within(1), side * self.bodies.height);
        let met = course.first(&self.bodies, &ray.direction)?;
        Some(Strike { met, course, rest })
    }

    /// What is shown there.
    pub fn shown(
        &self,
        strike: &Strike,
        ray: &Ray,
        motif: Option<Light3>,
        window: f32,
    ) -> Shown<'_> {
        let Strike { met, course, .. } = strike;
        let struck = &met.struck;
        let bodies = &self.bodies;
        // Fibres finer than a pixel are not told apart.
        let seen = (bodies.pitch / window.max(1e-9) / 24.0).clamp(0.0, 1.0);
        let surface = Surface::of(bodies, struck, &Vector::z(), self.fibres, self.fibres * seen);
        let flat = course.normal_outwards(&struck.normal);
        let normal = course.normal_outwards(&surface.normal);
        let normal = super::set::turned_to_eye(normal, &ray.direction);
        let way = course.outwards(&surface.way);
        let way = (way - normal * way.dot(&normal)).try_normalize(1e-6);
        let threads = match way {
            Some(way) => Threads { normal, warp: way, weft: normal.cross(&way) },
            None => super::set::bare(normal),
        };
        let yarn = bodies.yarn(struck.strand);
        let own = motif.unwrap_or_else(|| Light3::from(bodies.skins[yarn].light));
        let colour = (own * surface.light).map(|c| c.clamp(0.0, coat::WHITEST));
        let at = course.after(&ray.direction, met.distance) + struck.normal * bodies.lift();
        let around = Around { yarns: self, course: Course { origin: at, ..*course } };
        Shown { flat, threads, colour, look: &self.looks[yarn.min(1)], around }
    }
}

impl Strike {
    /// How far behind the place where the ray entered the shell it is, m.
    pub fn behind(&self) -> f32 {
        self.met.distance
    }

    /// Place in the panel of the thread that is met, m.
    pub fn rest(&self) -> [f64; 2] {
        self.rest
    }
}

impl Around<'_> {
    /// Whether another yarn of the cloth stands in the way.
    pub fn keeps(&self, direction: &Vector) -> bool {
        self.course.first(&self.yarns.bodies, direction).is_some()
    }

    /// The normal of the cloth on the side on which the place is seen.
    pub fn cloth(&self, eye: &Vector) -> Vector {
        let normal = self.course.axes[2];
        if normal.dot(eye) < 0.0 { -normal } else { normal }
    }

    /// By how much the light that comes straight from lamps is too little, see [`Bodies::gain`].
    pub fn gain(&self) -> f32 {
        self.yarns.bodies.gain
    }
}

/// The place between three corners, along weft and warp, m.
fn rest(corners: &[&Corner; 3], [u, v]: [f32; 2]) -> [f64; 2] {
    let (u, v) = (f64::from(u), f64::from(v));
    let [a, b, c] = corners;
    [0, 1].map(|k| a.rest[k] * (1.0 - u - v) + b.rest[k] * u + c.rest[k] * v)
}

/// What grows by `first` from the first corner to the second and by `second` to the third, in a
/// metre along weft and warp.
pub fn along(corners: &[&Corner; 3], first: Vector, second: Vector) -> Option<[Vector; 2]> {
    let [a, b, c] = corners;
    let [u1, v1] = [0, 1].map(|k| (b.rest[k] - a.rest[k]) as f32);
    let [u2, v2] = [0, 1].map(|k| (c.rest[k] - a.rest[k]) as f32);
    let area = u1 * v2 - u2 * v1;
    (area.abs() > 1e-14)
        .then(|| [(first * v2 - second * v1) / area, (second * u1 - first * u2) / area])
}

/// The directions of the cloth between three corners.
fn course(corners: &[&Corner; 3], [u, v]: [f32; 2]) -> Option<Course> {
    let [a, b, c] = corners;
    let [weft, warp] = along(corners, b.place - a.place, c.place - a.place)?;
    let bends = along(corners, b.normal - a.normal, c.normal - a.normal)?;
    let normal = a.normal * (1.0 - u - v) + b.normal * u + c.normal * v;
    let normal = normal.try_normalize(1e-6)?;
    Some(Course { origin: Vector::zeros(), axes: [weft, warp, normal], bends })
}
