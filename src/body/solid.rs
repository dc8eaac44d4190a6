//! Solids as closed surfaces: ball, cylinder, box, table, ground.

use super::surface::{Surface, SurfaceKind};
use crate::garment::scene::{Shape, Solid};
use nalgebra::{Point3, Rotation3, Vector3};
use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, TAU};

/// Rounding of edges, m: sharp enough to look sawn, round enough for cloth to lie over.
const BEVEL: f64 = 0.005;
/// Steps of the rounding over 45°.
const BEVEL_STEPS: u32 = 4;
/// Halvings of the icosahedron: 20 · 4⁵ triangles, 0.02 % of the radius off the true ball.
const HALVINGS: u32 = 5;
/// Corners of a cylinder's circle.
const AROUND: u32 = 128;
/// Half the width of the ground, m.
const GROUND: f64 = 20.0;

/// Makes a solid as a closed surface with outward normals, in its place in the world.
///
/// Edges of cylinders, boxes and tables are rounded by 5 mm, less on pieces thinner than 2 cm.
/// The ground is the upper face of a slab 40 m square. Sizes below 0.1 mm or above 1 km, and
/// sizes that are not numbers, are brought to the nearest size that can be made.
pub fn solid(solid: &Solid) -> Surface {
    let mut mesh = Mesh::default();
    match &solid.shape {
        Shape::Sphere { radius } => ball(&mut mesh, sane(*radius)),
        Shape::Cylinder { radius, height } => cylinder(&mut mesh, sane(*radius), sane(*height)),
        Shape::Box { size } => {
            let size = size.map(sane);
            rounded_box(&mut mesh, Vector3::new(0.0, size[1] / 2.0, 0.0), size);
        }
        Shape::Table { size, thickness } => table(&mut mesh, size.map(sane), sane(*thickness)),
        Shape::Plane => {
            let size = [2.0 * GROUND, 1.0, 2.0 * GROUND];
            rounded_box(&mut mesh, Vector3::new(0.0, -0.5, 0.0), size);
        }
    }
    let turn = Rotation3::from_euler_angles(solid.turn[0], solid.turn[1], solid.turn[2]);
    let at = Vector3::from(solid.at);
    Surface {
        name: solid.name.clone(),
        vertices: mesh.vertices.iter().map(|p| turn * p + at).collect(),
        normals: mesh.normals.iter().map(|n| turn * n).collect(),
        triangles: mesh.triangles,
        landmarks: BTreeMap::new(),
        kind: SurfaceKind::Solid,
        friction: solid.friction,
        parts: Vec::new(),
    }
}

/// A size that can be made, m.
fn sane(length: f64) -> f64 {
    if length.is_nan() { 1e-4 } else { length.clamp(1e-4, 1e3) }
}

#[derive(Default)]
struct Mesh {
    vertices: Vec<Point3<f64>>,
    normals: Vec<Vector3<f64>>,
    triangles: Vec<[u32; 3]>,
}

impl Mesh {
    fn add(&mut self, at: Vector3<f64>, normal: Vector3<f64>) -> u32 {
        self.vertices.push(Point3::from(at));
        self.normals.push(normal);
        u32::try_from(self.vertices.len() - 1).unwrap_or(u32::MAX)
    }

    /// Two triangles of a quad that is anticlockwise from outside; quads that have shrunk to a
    /// triangle give one.
    fn quad(&mut self, [a, b, c, d]: [u32; 4]) {
        for t in [[a, b, c], [a, c, d]] {
            if t[0] != t[1] && t[1] != t[2] && t[2] != t[0] {
                self.triangles.push(t);
            }
        }
    }
}

/// A ball about the origin: an icosahedron, halved and blown up.
fn ball(mesh: &mut Mesh, radius: f64) {
    let g = (1.0 + 5.0_f64.sqrt()) / 2.0;
    let mut points: Vec<Vector3<f64>> = [
        [-1.0, g, 0.0],
        [1.0, g, 0.0],
        [-1.0, -g, 0.0],
        [1.0, -g, 0.0],
        [0.0, -1.0, g],
        [0.0, 1.0, g],
        [0.0, -1.0, -g],
        [0.0, 1.0, -g],
        [g, 0.0, -1.0],
        [g, 0.0, 1.0],
        [-g, 0.0, -1.0],
        [-g, 0.0, 1.0],
    ]
    .iter()
    .map(|p| Vector3::from(*p).normalize())
    .collect();
    let mut faces: Vec<[u32; 3]> = vec![
        [0, 11, 5],
        [0, 5, 1],
        [0, 1, 7],
        [0, 7, 10],
        [0, 10, 11],
        [1, 5, 9],
        [5, 11, 4],
        [11, 10, 2],
        [10, 7, 6],
        [7, 1, 8],
        [3, 9, 4],
        [3, 4, 2],
        [3, 2, 6],
        [3, 6, 8],
        [3, 8, 9],
        [4, 9, 5],
        [2, 4, 11],
        [6, 2, 10],
        [8, 6, 7],
        [9, 8, 1],
    ];
    for _ in 0..HALVINGS {
        let mut middles: BTreeMap<(u32, u32), u32> = BTreeMap::new();
        let mut finer = Vec::with_capacity(faces.len() * 4);
        for [a, b, c] in faces {
            let mut middle = |i: u32, j: u32| {
                *middles.entry((i.min(j), i.max(j))).or_insert_with(|| {
                    points.push((points[i as usize] + points[j as usize]).normalize());
                    u32::try_from(points.len() - 1).unwrap_or(u32::MAX)
                })
            };
            let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
            finer.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        faces = finer;
    }
    for normal in points {
        mesh.add(normal * radius, normal);
    }
    mesh.triangles = faces;
}

/// A cylinder about the y axis, standing on the origin, its rims rounded.
fn cylinder(mesh: &mut Mesh, radius: f64, height: f64) {
    let r = BEVEL.min(radius / 4.0).min(height / 4.0);
    // The outline from the lower pole to the upper one: rim centres, then the rounding.
    let steps = 2 * BEVEL_STEPS;
    let mut outline = Vec::new();
    for (level, first) in [(r, -FRAC_PI_2), (height - r, 0.0)] {
        for step in 0..=steps {
            let angle = first + FRAC_PI_2 * f64::from(step) / f64::from(steps);
            let (sin, cos) = (libm::sin(angle), libm::cos(angle));
            outline.push((radius - r + r * cos, level + r * sin, cos, sin));
        }
    }
    let bottom = mesh.add(Vector3::zeros(), -Vector3::y());
    let mut rings: Vec<Vec<u32>> = Vec::new();
    for (distance, level, across, up) in outline {
        let ring = (0..AROUND).map(|k| {
            let angle = TAU * f64::from(k) / f64::from(AROUND);
            let (sin, cos) = (libm::sin(angle), libm::cos(angle));
            mesh.add(
                Vector3::new(distance * cos, level, distance * sin),
                Vector3::new(across * cos, up, across * sin),
            )
        });
        rings.push(ring.collect());
    }
    let top = mesh.add(Vector3::new(0.0, height, 0.0), Vector3::y());
    for k in 0..AROUND as usize {
        let l = (k + 1) % AROUND as usize;
        for pair in rings.windows(2) {
            mesh.quad([pair[0][k], pair[1][k], pair[1][l], pair[0][l]]);
        }
        if let (Some(first), Some(last)) = (rings.first(), rings.last()) {
            mesh.triangles.push([bottom, first[k], first[l]]);
            mesh.triangles.push([top, last[l], last[k]]);
        }
    }
}

/// A box about `middle` with rounded edges: every place of a lattice on a cube is the place of
/// a smaller box plus a short unit-vector offset.
fn rounded_box(mesh: &mut Mesh, middle: Vector3<f64>, size: [f64; 3]) {
    let r = size.iter().fold(BEVEL, |r, s| r.min(s / 4.0));
    let inner = Vector3::new(size[0] / 2.0 - r, size[1] / 2.0 - r, size[2] / 2.0 - r);
    let count = 2 * (BEVEL_STEPS + 1);
    // Beyond the smaller box, in roundings: 1 at the outside, 0 at its corner.
    let beyond: Vec<f64> = (0..count)
        .map(|i| {
            let step = |n: u32| libm::tan(FRAC_PI_4 * f64::from(n) / f64::from(BEVEL_STEPS));
            if i <= BEVEL_STEPS { -step(BEVEL_STEPS - i) } else { step(i - BEVEL_STEPS - 1) }
        })
        .collect();
    let mut known: BTreeMap<[u32; 3], u32> = BTreeMap::new();
    for axis in 0..3 {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        for end in [0, count - 1] {
            for i in 0..count - 1 {
                for j in 0..count - 1 {
                    let mut vertex = |di: u32, dj: u32| {
                        let mut place = [0_u32; 3];
                        place[axis] = end;
                        place[u] = i + di;
                        place[v] = j + dj;
                        *known.entry(place).or_insert_with(|| {
                            let side = place.map(|n| if n <= BEVEL_STEPS { -1.0 } else { 1.0 });
                            let core = inner.component_mul(&Vector3::from(side));
                            let out = place.map(|n| beyond[n as usize]);
                            let normal = Vector3::from(out).normalize();
                            mesh.add(middle + core + normal * r, normal)
                        })
                    };
                    let corners = [vertex(0, 0), vertex(1, 0), vertex(1, 1), vertex(0, 1)];
                    let [a, b, c, d] = corners;
                    mesh.quad(if end == 0 { [a, d, c, b] } else { corners });
                }
            }
        }
    }
}

/// A table: a top on four legs that stand a little inside its corners.
fn table(mesh: &mut Mesh, size: [f64; 3], thickness: f64) {
    let [width, height, depth] = size;
    let thickness = thickness.min(height * 0.9);
    let middle = Vector3::new(0.0, height - thickness / 2.0, 0.0);
    rounded_box(mesh, middle, [width, thickness, depth]);
    let leg = (0.08 * width.min(depth)).clamp(0.02_f64.min(width.min(depth) / 4.0), 0.07);
    // A hair's breadth below the top, so that the pieces stay apart and each is closed.
    let tall = height - thickness - 1e-4;
    let inset = leg;
    for (x, z) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)] {
        let foot = Vector3::new(
            x * (width / 2.0 - inset - leg / 2.0),
            tall / 2.0,
            z * (depth / 2.0 - inset - leg / 2.0),
        );
        rounded_box(mesh, foot, [leg, tall, leg]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::check;
    use crate::diagnostic::Span;

    fn make(shape: Shape) -> Surface {
        solid(&Solid {
            name: "thing".into(),
            span: Span::default(),
            shape,
            at: [0.3, 0.0, -0.2],
            turn: [0.4, 0.2, -0.9],
            friction: None,
        })
    }

    #[test]
    fn every_solid_is_closed_and_faces_outwards() {
        for (shape, pieces) in [
            (Shape::Sphere { radius: 0.25 }, 1),
            (Shape::Cylinder { radius: 0.09, height: 0.2 }, 1),
            (Shape::Box { size: [1.0, 0.004, 0.5] }, 1),
            (Shape::Table { size: [1.2, 0.72, 0.8], thickness: 0.03 }, 5),
            (Shape::Plane, 1),
            (Shape::Box { size: [f64::NAN, -1.0, f64::INFINITY] }, 1),
        ] {
            let surface = make(shape.clone());
            assert_eq!(check::defects(&surface), Vec::<String>::new(), "{shape:?}");
            assert_eq!(check::euler(&surface), 2 * pieces, "{shape:?}");
            assert!(check::volume(&surface) > 0.0, "{shape:?}");
        }
    }

    #[test]
    fn volumes_are_those_of_the_shapes() {
        let ball = check::volume(&make(Shape::Sphere { radius: 0.25 }));
        let exact = 4.0 / 3.0 * std::f64::consts::PI * 0.25_f64.powi(3);
        // Facets of edge e = 1.2 r / 2⁵ lie e² / 8r inside the ball in the mean: 3e² / 8r².
        assert!((1.0 - ball / exact - 5.3e-4).abs() < 5e-5);
        let cube = check::volume(&make(Shape::Box { size: [0.4, 0.3, 0.2] }));
        // The rounding takes (1 − π/4) r² along 4 edges of each length.
        let lost = (1.0 - std::f64::consts::FRAC_PI_4) * BEVEL * BEVEL * 4.0 * 0.9;
        assert!((cube - (0.024 - lost)).abs() < 0.1 * lost);
    }
}
