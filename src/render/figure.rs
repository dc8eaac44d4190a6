//! What stands in the studio: cloth, bodies and solids as curved triangles with their coats.

use super::finish::Look;
use super::hierarchy::Ray;
use super::manner::{BLURRED, Manner, Textile};
use super::rim;
use super::selvage::Selvages;
use super::slub::Slubs;
use super::swatch::Swatches;
use super::wood::Wood;
use super::{Light3, Vector, tone};
use crate::body::surface::{Surface, SurfaceKind};
use crate::drape::draped::Draped;
use crate::garment::scene::{Shape, Solid};
use crate::mesh::compiled::{self, Compiled, MeshPanel};
use crate::textile::fabric::{Fabric, Structure};
use nalgebra::Vector3;

/// All that is shown.
#[derive(Clone, Debug)]
pub struct Figure<'a> {
    /// Corners of the triangles.
    pub corners: Vec<Corner>,
    /// Triangles, anticlockwise seen from outside, with the number of their coat.
    pub faces: Vec<Face>,
    /// What covers them.
    pub coats: Vec<Coat>,
    /// The textiles.
    pub swatches: Swatches<'a>,
    /// Seams and free edges; the triangles of cloth are the first of all.
    pub selvages: Selvages,
    /// Height of the floor, m; none under what hangs high above it.
    pub floor: Option<f32>,
    /// Whether somebody wears it.
    pub worn: bool,
    /// How cloth is shown.
    pub manner: Manner,
    /// The fabrics of the panels.
    pub fabrics: &'a [Fabric],
    /// Corners of the cloth itself; those of the beads along its edges follow.
    pub cloth: u32,
}

/// A corner of triangles.
#[derive(Clone, Copy, Debug)]
pub struct Corner {
    /// Where it is, m.
    pub place: Vector,
    /// Its normal, outwards; unit length.
    pub normal: Vector,
    /// Place in the panel along weft and warp, m; 0 for bodies and solids.
    pub rest: [f64; 2],
}

/// A triangle.
#[derive(Clone, Copy, Debug)]
pub struct Face {
    /// Numbers of its corners.
    pub corners: [u32; 3],
    /// Number of its coat.
    pub coat: u32,
}

/// What covers a triangle.
#[derive(Clone, Debug)]
pub enum Coat {
    /// A panel.
    Cloth(Panel),
    /// One colour all over.
    Plain {
        /// Whether it is a body.
        body: bool,
        /// The colour.
        colour: Light3,
        /// How light leaves it.
        look: Look,
    },
    /// Planed wood.
    Wood {
        /// How its grain runs.
        wood: Wood,
        /// How light leaves it.
        look: Look,
    },
}

/// A panel of cloth.
#[derive(Clone, Debug)]
pub struct Panel {
    /// Number of its fabric.
    pub fabric: usize,
    /// Its regions of the atlas.
    pub surfaces: Vec<compiled::Surface>,
    /// Its colour where it has no region.
    pub plain: Light3,
    /// How light leaves the face and the back.
    pub looks: [Look; 2],
    /// Its threads.
    pub slubs: Option<Slubs>,
    /// It is never seen through a narrower window than this, m.
    pub blur: f32,
}

/// Seam partners nearer than this are drawn as one, m.
const WELD: f64 = 4e-3;

/// What hangs higher above the floor than this share of its height is shown without one.
const HANGS: f32 = 0.06;

/// Places further out than this are left out, m.
const FAR: f64 = 1e3;

impl<'a> Figure<'a> {
    /// The dressed figure.
    pub fn of(compiled: &'a Compiled, draped: &Draped, manner: Manner) -> Self {
        let mut figure = Figure {
            corners: Vec::new(),
            faces: Vec::new(),
            coats: Vec::new(),
            swatches: Swatches::of(&compiled.atlas),
            selvages: Selvages::default(),
            floor: None,
            worn: draped.surfaces.iter().any(|surface| surface.kind == SurfaceKind::Body),
            manner,
            fabrics: &compiled.fabrics,
            cloth: 0,
        };
        figure.add_cloth(compiled, draped);
        let mut floor: Option<f32> = None;
        for surface in &draped.surfaces {
            let solid = compiled.solids.iter().find(|solid| solid.name == surface.name);
            if let Some(Solid { shape: Shape::Plane, at, .. }) = solid {
                floor = Some(at[1] as f32);
            } else {
                figure.add_surface(surface, solid);
            }
        }
        // Things stand on y = 0, or on the lowest point of those that reach below.
        figure.floor = floor.or_else(|| {
            let heights = figure.places().into_iter().map(|place| place.y);
            let (low, high) = heights.fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), y| {
                (low.min(y), high.max(y))
            });
            let floor = low.min(0.0);
            (low - floor < HANGS * (high - low)).then_some(floor)
        });
        figure
    }

    /// Places of the corners that triangles use.
    pub fn places(&self) -> Vec<Vector> {
        let mut used = vec![false; self.corners.len()];
        for face in &self.faces {
            for corner in face.corners {
                used[corner as usize] = true;
            }
        }
        let shown = self.corners.iter().zip(used).filter(|(_, used)| *used);
        shown.map(|(corner, _)| corner.place).collect()
    }

    /// The middle of the cloth, or of all where there is none, m.
    pub fn middle(&self) -> Vector {
        let cloth = |face: &&Face| matches!(self.coats[face.coat as usize], Coat::Cloth(_));
        let any = self.faces.iter().any(|face| cloth(&face));
        let nothing = (Vector::repeat(f32::INFINITY), Vector::repeat(f32::NEG_INFINITY));
        let (low, high) = self
            .faces
            .iter()
            .filter(|face| !any || cloth(face))
            .flat_map(|face| face.corners)
            .map(|corner| self.corners[corner as usize].place)
            .fold(nothing, |(low, high), place| (low.inf(&place), high.sup(&place)));
        if low.x <= high.x { (low + high) * 0.5 } else { Vector::zeros() }
    }

    /// How far along a ray the first triangle is, the curves of triangles left aside.
    pub fn meets(&self, ray: &Ray) -> Option<f32> {
        let mut nearest: Option<f32> = None;
        for face in &self.faces {
            let [a, b, c] = face.corners.map(|corner| self.corners[corner as usize].place);
            let (first, second) = (b - a, c - a);
            let p = ray.direction.cross(&second);
            let scale = first.dot(&p);
            if scale.abs() < 1e-12 {
                continue;
            }
            let from = ray.origin - a;
            let u = from.dot(&p) / scale;
            let q = from.cross(&first);
            let v = ray.direction.dot(&q) / scale;
            let distance = second.dot(&q) / scale;
            let inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > 0.0;
            if inside && nearest.is_none_or(|least| distance < least) {
                nearest = Some(distance);
            }
        }
        nearest
    }

    fn add_cloth(&mut self, compiled: &Compiled, draped: &Draped) {
        let count = compiled.particles.len().min(draped.positions.len());
        let mut places: Vec<Vector3<f64>> =
            draped.positions.iter().take(count).map(|place| place.coords).collect();
        let welds = weld(compiled, &mut places);
        for panel in &compiled.panels {
            self.coats.push(Coat::Cloth(self.panel(panel, compiled)));
        }
        // Cells are cut along the fold that runs through them: first by the shorter diagonal,
        // then by the one whose ends face the same way.
        let faces = cloth_faces(compiled, &places, |[a, b, c, d]| {
            let span = |p: u32, q: u32| (places[p as usize] - places[q as usize]).norm_squared();
            span(a, c) <= span(b, d)
        });
        let first_normals = cloth_normals(&places, &faces, &welds);
        let faces = cloth_faces(compiled, &places, |[a, b, c, d]| {
            let alike = |p: u32, q: u32| first_normals[p as usize].dot(&first_normals[q as usize]);
            alike(a, c) >= alike(b, d)
        });
        if self.manner.textile == Textile::Threads {
            self.selvages = Selvages::of(compiled, &faces);
        }
        let normals = cloth_normals(&places, &faces, &welds);
        let first = self.corners.len() as u32;
        for ((place, normal), rest) in places.iter().zip(normals).zip(&compiled.particles) {
            self.corners.push(Corner {
                place: place.map(|x| x as f32),
                normal: normal.map(|x| x as f32),
                rest: *rest,
            });
        }
        self.faces.extend(
            faces
                .iter()
                .map(|face| Face { corners: face.corners.map(|k| k + first), coat: face.coat }),
        );
        self.cloth = self.corners.len() as u32;
        let mut sewn = vec![false; places.len()];
        for k in compiled.seams.iter().flat_map(|seam| &seam.pairs).flatten() {
            if let Some(mark) = sewn.get_mut(*k as usize) {
                *mark = true;
            }
        }
        // Only where there is cloth to be turned.
        let mut worn = vec![false; places.len()];
        for k in faces.iter().flat_map(|face| face.corners) {
            worn[k as usize] = true;
        }
        for (sewn, worn) in sewn.iter_mut().zip(worn) {
            *sewn |= !worn;
        }
        rim::turn(compiled, &sewn, first, &mut self.corners, &mut self.faces);
    }

    fn panel(&self, panel: &MeshPanel, compiled: &Compiled) -> Panel {
        let fabric = compiled.fabrics.get(panel.fabric);
        let look = |back| match fabric {
            Some(fabric) => self.manner.look(fabric, back),
            None => Look::of_body(),
        };
        let textile = self.manner.textile;
        Panel {
            fabric: panel.fabric,
            surfaces: panel
                .surfaces
                .iter()
                .filter(|s| textile != Textile::Colour && self.swatches.has(s.face))
                .cloned()
                .collect(),
            plain: fabric.map_or(Light3::repeat(0.5), yarn_colour),
            looks: [look(false), look(true)],
            slubs: fabric.filter(|_| textile == Textile::Threads).map(Slubs::of),
            blur: if textile == Textile::Pattern { BLURRED } else { 0.0 },
        }
    }

    fn add_surface(&mut self, surface: &Surface, solid: Option<&Solid>) {
        let coat = self.coats.len() as u32;
        self.coats.push(match (surface.kind, solid.and_then(Wood::of)) {
            (SurfaceKind::Body, _) => {
                let colour = Light3::new(0.530, 0.484, 0.424);
                Coat::Plain { body: true, colour, look: Look::of_body() }
            }
            (SurfaceKind::Solid, Some(wood)) => Coat::Wood { wood, look: Look::of_solid() },
            (SurfaceKind::Solid, None) => {
                let colour = Light3::new(0.50, 0.485, 0.465);
                Coat::Plain { body: false, colour, look: Look::of_solid() }
            }
        });
        let first = self.corners.len() as u32;
        let good = |k: u32| {
            let vertex = surface.vertices.get(k as usize);
            let normal = surface.normals.get(k as usize);
            vertex.is_some_and(|place| place.iter().all(|x| x.abs() < FAR))
                && normal.is_some_and(|normal| normal.iter().all(|x| x.is_finite()))
        };
        let faces = surface.triangles.iter().filter(|corners| corners.iter().all(|k| good(*k)));
        self.faces.extend(faces.map(|corners| Face { corners: corners.map(|k| k + first), coat }));
        for (place, normal) in surface.vertices.iter().zip(&surface.normals) {
            self.corners.push(Corner {
                place: place.coords.map(|x| x as f32),
                normal: normal.map(|x| x as f32),
                rest: [0.0; 2],
            });
        }
    }
}

/// Triangles of the cloth; those of panel `n` have the coat `n`. Cells for which `along` holds
/// are cut from their first corner to their third. What is not near enough to be a place of the
/// studio is left out.
fn cloth_faces(
    compiled: &Compiled,
    places: &[Vector3<f64>],
    along: impl Fn([u32; 4]) -> bool,
) -> Vec<Face> {
    let good = |k: u32| {
        let place = places.get(k as usize);
        place.is_some_and(|place| place.iter().all(|x| x.abs() < FAR))
    };
    let mut faces = Vec::new();
    for (coat, panel) in compiled.panels.iter().enumerate() {
        let mut add = |corners: [u32; 3]| faces.push(Face { corners, coat: coat as u32 });
        let cells = compiled.cells.get(panel.cells.range()).unwrap_or_default();
        for &[a, b, c, d] in cells.iter().filter(|cell| cell.iter().all(|k| good(*k))) {
            if along([a, b, c, d]) {
                add([a, b, c]);
                add([a, c, d]);
            } else {
                add([a, b, d]);
                add([b, c, d]);
            }
        }
        let band = compiled.triangles.get(panel.triangles.range()).unwrap_or_default();
        band.iter().filter(|corners| corners.iter().all(|k| good(*k))).for_each(|c| add(*c));
    }
    faces
}

/// Draws seam partners that have come together to their common middle, and says for each particle
/// which one stands for its group.
fn weld(compiled: &Compiled, places: &mut [Vector3<f64>]) -> Vec<u32> {
    let mut leader: Vec<u32> = (0..places.len() as u32).collect();
    fn lead(leader: &mut [u32], mut k: u32) -> u32 {
        while leader[k as usize] != k {
            let up = leader[leader[k as usize] as usize];
            leader[k as usize] = up;
            k = up;
        }
        k
    }
    for &[a, b] in compiled.seams.iter().flat_map(|seam| &seam.pairs) {
        let (Some(p), Some(q)) = (places.get(a as usize), places.get(b as usize)) else {
            continue;
        };
        if (p - q).norm() < WELD {
            let (a, b) = (lead(&mut leader, a), lead(&mut leader, b));
            // The smaller number leads, whatever the order of the seams.
            leader[a.max(b) as usize] = a.min(b);
        }
    }
    let mut sums = vec![(Vector3::zeros(), 0.0); places.len()];
    for k in 0..places.len() as u32 {
        let sum = &mut sums[lead(&mut leader, k) as usize];
        *sum = (sum.0 + places[k as usize], sum.1 + 1.0);
    }
    for k in 0..places.len() {
        let (sum, count) = sums[lead(&mut leader, k as u32) as usize];
        if count > 1.0 {
            places[k] = sum / count;
        }
    }
    leader
}

/// Normals of the particles: the mean of the faces round each by their angle there, taken over
/// all that is sewn together, except where the cloth is folded sharply along the seam.
fn cloth_normals(places: &[Vector3<f64>], faces: &[Face], leader: &[u32]) -> Vec<Vector3<f64>> {
    let mut own = vec![Vector3::zeros(); places.len()];
    for face in faces {
        let [a, b, c] = face.corners.map(|k| places[k as usize]);
        let normal = (b - a).cross(&(c - a));
        let length = normal.norm();
        if length <= 0.0 {
            continue;
        }
        for (k, [p, q, r]) in face.corners.iter().zip([[a, b, c], [b, c, a], [c, a, b]]) {
            let (to_q, to_r) = (q - p, r - p);
            let angle = libm::atan2(length, to_q.dot(&to_r));
            own[*k as usize] += normal * (angle / length);
        }
    }
    let mut sewn = vec![Vector3::zeros(); places.len()];
    for (k, normal) in own.iter().enumerate() {
        sewn[leader[k] as usize] += normal;
    }
    let unit = |v: &Vector3<f64>| {
        let length = v.norm();
        if length > 1e-12 { v / length } else { Vector3::y() }
    };
    own.iter()
        .zip(leader)
        .map(|(own, leader)| {
            let (own, sewn) = (unit(own), unit(&sewn[*leader as usize]));
            if own.dot(&sewn) > 0.5 { sewn } else { own }
        })
        .collect()
}

/// The colour of a fabric from its yarns, by how much of each lies on the face.
fn yarn_colour(fabric: &Fabric) -> Light3 {
    match &fabric.structure {
        Structure::Woven { weave, warp, weft } => {
            let all = weave.rows.iter().map(Vec::len).sum::<usize>().max(1);
            let up = weave.rows.iter().flatten().filter(|up| **up).count();
            let share = up as f32 / all as f32;
            let [warp, weft] = [warp, weft].map(|thread| tone::decoded_colour(thread.colour.0));
            warp * share + weft * (1.0 - share)
        }
        Structure::Knitted { knit, yarn } => match knit.chart.mean_light(yarn.colour) {
            Some([red, green, blue]) => Light3::new(red as f32, green as f32, blue as f32),
            None => tone::decoded_colour(yarn.colour.0),
        },
    }
}
