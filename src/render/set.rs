//! The figure divided into pieces that rays can meet, and what a ray finds where it meets one.

use super::coat;
use super::figure::{Coat, Corner, Figure};
use super::finish::{Look, Threads};
use super::hierarchy::{Hierarchy, Hit, Ray};
use super::near::{Around, Near, Strike};
use super::sample::frame;
use super::tessellate::{Patch, Piece, divide};
use super::{Light3, Vector};
use rayon::prelude::*;

/// A figure ready to be looked at.
#[derive(Debug)]
pub struct Set<'a> {
    /// What stands there.
    pub figure: &'a Figure<'a>,
    /// All its pieces.
    pub hierarchy: Hierarchy,
    parts: Vec<Part>,
    /// Cloth of which the yarns are seen.
    pub near: Near,
    /// Whether some triangles do not stop all rays: light comes through between threads, or they
    /// are shells about yarns.
    pub open: bool,
}

/// What a triangle of the hierarchy is a part of.
#[derive(Clone, Copy, Debug)]
struct Part {
    /// Number of its face.
    face: u32,
    /// Where in it.
    piece: Piece,
    /// Of the shell about yarns 1 the side of the face, −1 that of the back; 0 the cloth itself.
    side: i8,
}

/// What a ray finds at a triangle.
#[derive(Clone, Copy, Debug)]
pub enum Found {
    /// Something that stops it.
    Solid,
    /// Nothing.
    Open,
    /// A yarn in the shell that it enters.
    Yarn(Strike),
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
    /// On a yarn, what its own cloth keeps from it.
    pub around: Option<Around<'a>>,
}

/// Triangles that pieces may add up to; beyond it they stay coarser.
const MOST_PIECES: usize = 1_500_000;

impl<'a> Set<'a> {
    /// Divides the figure into pieces with edges of about `edge` m and builds the hierarchy.
    /// `pixel` is what a pixel covers, m; `seen` tells which places are in the picture.
    pub fn of(
        figure: &'a Figure<'a>,
        edge: f32,
        pixel: f32,
        seen: impl Fn(&Vector) -> bool + Sync,
    ) -> Self {
        let near = Near::of(figure, pixel);
        let parts = parts_by_coat(figure, edge);
        let lists: Vec<Vec<(Part, [Vector; 3])>> = figure
            .faces
            .par_chunks(4096)
            .enumerate()
            .map(|(chunk, faces)| {
                let mut list = Vec::new();
                for (k, face) in faces.iter().enumerate() {
                    let number = (chunk * 4096 + k) as u32;
                    let corners = face.corners.map(|c| figure.corners[c as usize]);
                    let coat = &figure.coats[face.coat as usize];
                    let flat = matches!(coat, Coat::Cloth(_)) && !figure.manner.curved;
                    let shown = corners.iter().any(|corner| seen(&corner.place));
                    let parts = if flat || !shown { 1 } else { parts[face.coat as usize] };
                    let normals = corners.map(|c| c.normal);
                    let patch = Patch::over(corners.map(|c| c.place), normals);
                    let mut add = |side: i8, piece, [a, b, c]: [Vector; 3]| {
                        if (b - a).cross(&(c - a)).norm_squared() > 1e-24 {
                            // The back of a shell looks the other way.
                            let corners = if side < 0 { [a, c, b] } else { [a, b, c] };
                            list.push((Part { face: number, piece, side }, corners));
                        }
                    };
                    let own = face.corners.iter().all(|corner| *corner < figure.cloth);
                    match near.yarns(coat).filter(|_| shown) {
                        // Between yarns the bead of an edge would be seen from within.
                        Some(_) if !own => {}
                        Some(yarns) => {
                            for side in [1, -1] {
                                let away = f32::from(side) * yarns.bodies.height;
                                let place = |u, v| patch.place_off(&normals, away, u, v);
                                divide(parts, place, |piece, at| add(side, piece, at));
                            }
                        }
                        None => patch.divide(parts, |piece, at| add(0, piece, at)),
                    }
                }
                list
            })
            .collect();
        let mut parts = Vec::new();
        let mut triangles = Vec::new();
        for (part, corners) in lists.into_iter().flatten() {
            parts.push(part);
            triangles.push(corners);
        }
        let open = figure.coats.iter().any(|coat| match coat {
            Coat::Cloth(panel) => {
                panel.surfaces.iter().any(|surface| figure.swatches.open(surface.face))
            }
            _ => false,
        });
        let open = open || near.any();
        Set { figure, hierarchy: Hierarchy::over(&triangles), parts, near, open }
    }

    /// The place of a hit. `window` is what a pixel covers there, m; none for a rough look.
    pub fn place(&self, hit: &Hit, ray: &Ray, window: Option<f32>) -> Place<'a> {
        let figure = self.figure;
        let part = &self.parts[hit.triangle as usize];
        let number = part.face;
        let face = figure.faces[number as usize];
        let corners = face.corners.map(|k| figure.corners[k as usize]);
        let [u, v] = part.shares(hit.u, hit.v);
        let w = 1.0 - u - v;
        let (at, mut flat) = self.hierarchy.place(hit);
        let mut normal = corners[0].normal * w + corners[1].normal * u + corners[2].normal * v;
        let length = normal.norm();
        normal = if length > 1e-6 { normal / length } else { flat };
        let behind = flat.dot(&ray.direction) > 0.0;
        if behind {
            flat = -flat;
        }
        let back = behind != (part.side < 0);
        if back {
            normal = -normal;
        }
        let normal = turned_to_eye(normal, &ray.direction);
        let coat = &figure.coats[face.coat as usize];
        let (colour, look, threads) = match coat {
            Coat::Plain { colour, look, .. } => (*colour, look, bare(normal)),
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
        Place { at, flat, threads, colour, look, around: None }
    }

    /// The corners of the face that was hit, their shares in the place, and whether it is seen from
    /// behind.
    pub fn corners(&self, hit: &Hit, ray: &Ray) -> ([u32; 3], [f32; 3], bool) {
        let part = &self.parts[hit.triangle as usize];
        let [u, v] = part.shares(hit.u, hit.v);
        let (_, flat) = self.hierarchy.place(hit);
        let behind = flat.dot(&ray.direction) > 0.0;
        (self.figure.faces[part.face as usize].corners, [1.0 - u - v, u, v], behind)
    }

    /// Whether the ray, where it meets this, comes from inside a body or solid.
    pub fn leaves_body(&self, hit: &Hit, ray: &Ray) -> bool {
        let coat = self.coat(hit.triangle);
        let (_, flat) = self.hierarchy.place(hit);
        !matches!(coat, Coat::Cloth(_)) && flat.dot(&ray.direction) > 0.0
    }

    /// The face that was hit.
    pub fn face(&self, hit: &Hit) -> u32 {
        self.parts[hit.triangle as usize].face
    }

    fn coat(&self, triangle: u32) -> &Coat {
        let face = self.parts[triangle as usize].face;
        &self.figure.coats[self.figure.faces[face as usize].coat as usize]
    }

    /// What a ray finds that is looked along: at a distance at which a pixel covers `window` m.
    /// `choice` decides where threads and gaps are too fine to tell, `blend` how yarns are shown.
    pub fn found(
        &self,
        triangle: u32,
        shares: [f32; 2],
        ray: &Ray,
        window: f32,
        [choice, blend]: [f32; 2],
    ) -> Found {
        let part = &self.parts[triangle as usize];
        if part.side != 0 {
            if let Some(yarns) = self.near.yarns(self.coat(triangle)) {
                let corners = self.corners_of(part);
                let shares = part.shares(shares[0], shares[1]);
                if !part.entered(&corners, &ray.direction) {
                    return Found::Open;
                }
                if blend < yarns.share(window) {
                    let side = f32::from(part.side);
                    let strike = yarns.strike(&corners, side, shares, ray);
                    return strike.map_or(Found::Open, Found::Yarn);
                }
            }
        }
        let [u, v] = shares;
        if self.solid(triangle, u, v, &ray.direction, choice) { Found::Solid } else { Found::Open }
    }

    /// The place of a yarn that a ray meets behind a hit of its shell.
    pub fn place_on_yarn(&self, hit: &Hit, strike: &Strike, ray: &Ray, window: f32) -> Place<'_> {
        let part = &self.parts[hit.triangle as usize];
        let coat = self.coat(hit.triangle);
        let (Coat::Cloth(panel), Some(yarns)) = (coat, self.near.yarns(coat)) else {
            return self.place(hit, ray, Some(window));
        };
        let rest = strike.rest();
        let motif = panel.surface_at(rest).and_then(|(surface, [u, v])| {
            let back = part.side < 0 && self.figure.swatches.has(surface.back);
            let region = if back { surface.back } else { surface.face };
            self.figure.swatches.motif(region, u, v, yarns.bodies.pitch)
        });
        let shown = yarns.shown(strike, ray, motif, window);
        let left = self.figure.selvages.left(part.face, rest, window);
        Place {
            at: ray.origin + ray.direction * (hit.distance + strike.behind()),
            flat: shown.flat,
            threads: shown.threads,
            colour: shown.colour * left,
            look: shown.look,
            around: Some(shown.around),
        }
    }

    fn corners_of(&self, part: &Part) -> [&Corner; 3] {
        let face = self.figure.faces[part.face as usize];
        face.corners.map(|k| &self.figure.corners[k as usize])
    }

    /// Whether a thread stands at the place of a piece in the way of a ray; `choice` decides where
    /// threads and gaps are too fine to tell. A shell stops what enters it, not what leaves it.
    pub fn solid(&self, triangle: u32, u: f32, v: f32, way: &Vector, choice: f32) -> bool {
        let part = &self.parts[triangle as usize];
        let face = self.figure.faces[part.face as usize];
        let Coat::Cloth(panel) = &self.figure.coats[face.coat as usize] else { return true };
        let corners = self.corners_of(part);
        if part.side != 0 && !part.entered(&corners, way) {
            return false;
        }
        let [u, v] = part.shares(u, v).map(f64::from);
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

impl Part {
    /// Shares of the face's second and third corner from those of the triangle.
    fn shares(&self, u: f32, v: f32) -> [f32; 2] {
        if self.side < 0 { self.piece.shares(v, u) } else { self.piece.shares(u, v) }
    }

    /// Whether a ray enters the shell here.
    fn entered(&self, corners: &[&Corner; 3], way: &Vector) -> bool {
        let normal = corners[0].normal + corners[1].normal + corners[2].normal;
        normal.dot(way) * f32::from(self.side) < 0.0
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
pub fn turned_to_eye(normal: Vector, direction: &Vector) -> Vector {
    let away = normal.dot(direction);
    if away < -0.01 {
        return normal;
    }
    (normal - direction * (away + 0.01)).normalize()
}
