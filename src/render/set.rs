//! The figure divided into pieces that rays can meet, and what a ray finds where it meets one.

use super::coat;
use super::figure::{Coat, Corner, Figure};
use super::finish::{Look, Threads};
use super::hierarchy::{Hierarchy, Hit, Ray};
use super::sample::frame;
use super::tessellate::{Patch, Piece};
use super::{Light3, Vector};
use rayon::prelude::*;

/// A figure ready to be looked at.
#[derive(Debug)]
pub struct Set<'a> {
    /// What stands there.
    pub figure: &'a Figure<'a>,
    /// All its pieces.
    pub hierarchy: Hierarchy,
    pieces: Vec<(u32, Piece)>,
    /// Whether light comes through between some threads.
    pub open: bool,
}

/// A place of the figure where light arrives.
#[derive(Clone, Copy, Debug)]
pub struct Place<'a> {
    /// Where, m.
    pub at: Vector,
    /// Normal of the triangle, towards the side that is seen.
    pub flat: Vector,
    /// Directions there, by the smooth normal.
    pub threads: Threads,
    /// Own colour.
    pub colour: Light3,
    /// How light leaves it.
    pub look: &'a Look,
}

/// Triangles that pieces may add up to; beyond it they stay coarser.
const MOST_PIECES: usize = 1_500_000;

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
                    let cloth = matches!(figure.coats[face.coat as usize], Coat::Cloth(_));
                    let flat = cloth && !figure.manner.curved;
                    let parts = if flat { 1 } else { parts[face.coat as usize] };
                    let patch = Patch::over(corners.map(|c| c.place), corners.map(|c| c.normal));
                    patch.divide(parts, |piece, [a, b, c]| {
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

    /// The place of a hit. `window` is what a pixel covers there, m; none for a rough look.
    pub fn place(&self, hit: &Hit, ray: &Ray, window: Option<f32>) -> Place<'a> {
        let figure = self.figure;
        let (number, piece) = self.pieces[hit.triangle as usize];
        let face = figure.faces[number as usize];
        let corners = face.corners.map(|k| figure.corners[k as usize]);
        let [u, v] = piece.shares(hit.u, hit.v);
        let w = 1.0 - u - v;
        let (at, mut flat) = self.hierarchy.place(hit);
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
            Coat::Plain { colour, look } => (*colour, look, bare(normal)),
            Coat::Wood { wood, look } => {
                (wood.colour(&at, window.unwrap_or(0.02)), look, bare(normal))
            }
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
                let mut colour = panel.colour(&figure.swatches, rest, back, wide, &threads, ray);
                if window.is_some() {
                    let streak = panel.slubs.map_or(1.0, |slubs| slubs.light(rest, wide));
                    colour *= (streak * figure.selvages.left(number, rest, wide)).max(0.0);
                    colour = colour.map(|c| c.min(coat::WHITEST));
                }
                (colour, &panel.looks[usize::from(back)], threads)
            }
        };
        Place { at, flat, threads, colour, look }
    }

    /// The corners of the face that was hit, their shares in the place, and whether it is seen from
    /// behind.
    pub fn corners(&self, hit: &Hit, ray: &Ray) -> ([u32; 3], [f32; 3], bool) {
        let (number, piece) = self.pieces[hit.triangle as usize];
        let [u, v] = piece.shares(hit.u, hit.v);
        let (_, flat) = self.hierarchy.place(hit);
        let behind = flat.dot(&ray.direction) > 0.0;
        (self.figure.faces[number as usize].corners, [1.0 - u - v, u, v], behind)
    }

    /// Whether the ray, where it meets this, comes from inside a body or solid.
    pub fn leaves_body(&self, hit: &Hit, ray: &Ray) -> bool {
        let (number, _) = self.pieces[hit.triangle as usize];
        let coat = &self.figure.coats[self.figure.faces[number as usize].coat as usize];
        let (_, flat) = self.hierarchy.place(hit);
        !matches!(coat, Coat::Cloth(_)) && flat.dot(&ray.direction) > 0.0
    }

    /// Whether a thread stands at the place of a piece in the way of a ray; `choice` decides where
    /// threads and gaps are too fine to tell.
    pub fn solid(&self, triangle: u32, u: f32, v: f32, way: &Vector, choice: f32) -> bool {
        let (face, piece) = self.pieces[triangle as usize];
        let face = self.figure.faces[face as usize];
        let Coat::Cloth(panel) = &self.figure.coats[face.coat as usize] else { return true };
        let [u, v] = piece.shares(u, v).map(f64::from);
        let corners = face.corners.map(|k| &self.figure.corners[k as usize]);
        let [a, b, c] = corners.map(|corner| corner.rest);
        let rest = [0, 1].map(|k| a[k] * (1.0 - u - v) + b[k] * u + c[k] * v);
        let Some((surface, [u, v])) = panel.surface_at(rest) else { return true };
        if !self.figure.swatches.open(surface.face) {
            return true;
        }
        // Every layer takes a share of its own of the one number: panels apart, and what faces
        // the eye apart from what is behind.
        let layer = 2 * face.coat + u32::from(corners[0].normal.dot(way) > 0.0);
        let own = (layer.wrapping_mul(0x9e37_79b9) >> 8) as f32 * (1.0 / 16_777_216.0);
        let share = choice + own;
        self.figure.swatches.look(surface.face, u, v, 1e-3).cover > share - share.floor()
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
pub fn bare(normal: Vector) -> Threads {
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
