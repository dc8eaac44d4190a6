//! Things to look at, made by hand: a skirt with folds on a turned figure, a sheet on a ball.

use darzi::body::surface::{Surface, SurfaceKind};
use darzi::drape::draped::{Draped, Stats};
use darzi::garment::scene::{Placement, Shape, Solid};
use darzi::mesh::compiled::{self, Atlas, Compiled, MeshPanel, MeshSeam, Region, Stretch};
use darzi::textile::Colour;
use darzi::textile::fabric::{Fabric, Finish, Structure, Thread};
use darzi::textile::weave::Weave;
use darzi::textile::yarn::{Fibre, Twist, Yarn};
use nalgebra::{Point3, Vector3};
use std::f64::consts::TAU;

/// A fabric in plain weave.
pub fn fabric(finish: Finish, fibre: Fibre, colour: [u8; 3]) -> Fabric {
    let colour = Colour([colour[0], colour[1], colour[2], 255]);
    let yarn = Yarn {
        name: "yarn".to_owned(),
        count: 20e-6,
        plies: 1,
        twist: 600.0,
        direction: Twist::Z,
        fibre,
        colour,
        diameter: 0.2e-3,
    };
    let thread = Thread { yarn, spacing: 0.4e-3, colour };
    Fabric {
        name: "cloth".to_owned(),
        structure: Structure::Woven {
            weave: Weave {
                name: "plain".to_owned(),
                rows: vec![vec![true, false], vec![false, true]],
            },
            warp: thread.clone(),
            weft: thread,
        },
        mass: 0.15,
        thickness: 0.4e-3,
        bending: [1e-5; 2],
        tensile: [500.0; 2],
        shear: 30.0,
        poisson: 0.2,
        friction: 0.3,
        damping: 0.1,
        finish,
    }
}

/// An atlas of one tile: threads of a plain weave on `size` m, `colour` for the warp and a
/// little darker for the weft.
pub fn woven(colour: [u8; 3]) -> Atlas {
    let mut pixels = Vec::new();
    for y in 0..16_u32 {
        for x in 0..16_u32 {
            let warp = (x / 8 + y / 8) % 2 == 0;
            let across = f64::from(if warp { x % 8 } else { y % 8 });
            let round = (1.0 - ((across - 3.5) / 4.6).powi(2)).sqrt();
            let shade = round * if warp { 1.0 } else { 0.9 };
            pixels.extend(colour.map(|c| (f64::from(c) * shade) as u8));
            pixels.push(255);
        }
    }
    let region = Region {
        name: "cloth.face".to_owned(),
        pixels: [0, 0, 16, 16],
        size: [0.8e-3, 0.8e-3],
        tiles: true,
        detail: None,
        shot: None,
    };
    Atlas { width: 16, height: 16, pixels, regions: vec![region] }
}

/// A sheet of `columns` × `rows` cells; `rest` and `place` take shares from 0 to 1.
pub fn sheet(
    name: &str,
    compiled: &mut Compiled,
    positions: &mut Vec<Point3<f64>>,
    [columns, rows]: [u32; 2],
    rest: impl Fn(f64, f64) -> [f64; 2],
    place: impl Fn(f64, f64) -> Point3<f64>,
) {
    let first = compiled.particles.len() as u32;
    let first_cell = compiled.cells.len() as u32;
    for j in 0..=rows {
        for i in 0..=columns {
            let (s, t) = (f64::from(i) / f64::from(columns), f64::from(j) / f64::from(rows));
            compiled.particles.push(rest(s, t));
            compiled.lattice.push([i as i32, j as i32]);
            positions.push(place(s, t));
        }
    }
    let at = |i: u32, j: u32| first + j * (columns + 1) + i;
    for j in 0..rows {
        for i in 0..columns {
            compiled.cells.push([at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
    }
    let mut outline: Vec<u32> = (0..columns).map(|i| at(i, 0)).collect();
    outline.extend((0..rows).map(|j| at(columns, j)));
    outline.extend((1..=columns).rev().map(|i| at(i, rows)));
    outline.extend((1..=rows).rev().map(|j| at(0, j)));
    let triangles = compiled.triangles.len() as u32;
    compiled.panels.push(MeshPanel {
        name: name.to_owned(),
        fabric: 0,
        cell: 0.01,
        layer: 0,
        grain: 0.0,
        placement: Placement::Led,
        particles: Stretch { start: first, end: compiled.particles.len() as u32 },
        cells: Stretch { start: first_cell, end: compiled.cells.len() as u32 },
        triangles: Stretch { start: triangles, end: triangles },
        loops: vec![outline],
        edges: Vec::new(),
        surfaces: vec![compiled::Surface { area: None, face: 0, back: 0 }],
    });
}

/// A surface of rings about the y axis: (height, radius along x, radius along z).
pub fn turned(name: &str, kind: SurfaceKind, rings: &[[f64; 3]], sides: u32) -> Surface {
    let mut surface = Surface { name: name.to_owned(), kind, ..Surface::default() };
    for [y, rx, rz] in rings {
        for k in 0..sides {
            let angle = TAU * f64::from(k) / f64::from(sides);
            surface.vertices.push(Point3::new(rx * angle.sin(), *y, rz * angle.cos()));
        }
    }
    for ring in 0..rings.len() as u32 - 1 {
        for k in 0..sides {
            let (a, b) = (ring * sides + k, ring * sides + (k + 1) % sides);
            surface.triangles.push([a, b, b + sides]);
            surface.triangles.push([a, b + sides, a + sides]);
        }
    }
    surface.normals = vec![Vector3::zeros(); surface.vertices.len()];
    for corners in &surface.triangles {
        let [a, b, c] = corners.map(|k| surface.vertices[k as usize]);
        let normal = (b - a).cross(&(c - a));
        corners.iter().for_each(|k| surface.normals[*k as usize] += normal);
    }
    for normal in &mut surface.normals {
        *normal = normal.try_normalize(1e-12).unwrap_or_else(Vector3::y);
    }
    surface
}

/// Rings drawn smoothly through stations (height, half width, half depth).
fn smooth_rings(stations: &[[f64; 3]], steps: usize) -> Vec<[f64; 3]> {
    let at = |k: isize| stations[k.clamp(0, stations.len() as isize - 1) as usize];
    let mut rings = Vec::new();
    for k in 0..stations.len() as isize - 1 {
        for step in 0..steps {
            let t = step as f64 / steps as f64;
            let [p, a, b, q] = [at(k - 1), at(k), at(k + 1), at(k + 2)];
            let mut ring = [0.0; 3];
            for c in 0..3 {
                let (m, n) = ((b[c] - p[c]) * 0.5, (q[c] - a[c]) * 0.5);
                let (t2, t3) = (t * t, t * t * t);
                ring[c] = a[c] * (2.0 * t3 - 3.0 * t2 + 1.0)
                    + m * (t3 - 2.0 * t2 + t)
                    + b[c] * (3.0 * t2 - 2.0 * t3)
                    + n * (t3 - t2);
            }
            rings.push(ring);
        }
    }
    rings.push(stations[stations.len() - 1]);
    rings
}

/// A turned figure, about as a dress form on a stand.
pub fn form() -> Surface {
    let stations = [
        [0.001, 0.0, 0.0],
        [0.001, 0.16, 0.16],
        [0.012, 0.16, 0.16],
        [0.03, 0.03, 0.03],
        [0.60, 0.022, 0.022],
        [0.72, 0.02, 0.02],
        [0.74, 0.15, 0.10],
        [0.85, 0.178, 0.128],
        [0.95, 0.160, 0.118],
        [1.05, 0.122, 0.092],
        [1.18, 0.145, 0.115],
        [1.28, 0.165, 0.125],
        [1.38, 0.170, 0.090],
        [1.44, 0.100, 0.065],
        [1.48, 0.055, 0.055],
        [1.56, 0.052, 0.052],
        [1.57, 0.048, 0.048],
        [1.575, 0.0, 0.0],
    ];
    turned("lady", SurfaceKind::Body, &smooth_rings(&stations, 5), 64)
}

/// A flared skirt of two panels on a dress form.
pub fn skirt(fabric: Fabric, atlas: Atlas) -> (Compiled, Draped) {
    let mut compiled =
        Compiled { name: "skirt".to_owned(), fabrics: vec![fabric], atlas, ..Compiled::default() };
    let mut positions = Vec::new();
    let grid = [110, 72];
    for half in 0..2 {
        let place = |s: f64, t: f64| {
            // t = 0 at the hem; the wearer's right is on the left seen from outside in front.
            let angle = (s - 0.5) * TAU / 2.0 + TAU / 2.0 * f64::from(half);
            let down = 1.0 - t;
            let flare = down * down * (3.0 - 2.0 * down);
            let wave =
                (9.0 * angle + 0.9 * (2.0 * angle).sin()).cos() + 0.35 * (5.0 * angle + 1.0).sin();
            let fold = 0.052 * flare * wave;
            let (rx, rz) =
                (0.126 + 0.19 * down.powf(0.8) + fold, 0.096 + 0.21 * down.powf(0.8) + fold);
            Point3::new(
                rx * angle.sin(),
                1.05 - 0.60 * down - 0.006 * wave * flare,
                rz * angle.cos(),
            )
        };
        let rest = |s: f64, t: f64| [(s - 0.5) * (0.4 + 0.8 * (1.0 - t)), 0.66 * t];
        let name = ["front", "back"][half as usize];
        sheet(name, &mut compiled, &mut positions, grid, rest, place);
    }
    let at = |half: u32, i: u32, j: u32| half * 111 * 73 + j * 111 + i;
    for (name, a, b) in [("left", 0, 1), ("right", 1, 0)] {
        let pairs = (0..=72).map(|j| [at(a, 110, j), at(b, 0, j)]).collect();
        compiled.seams.push(MeshSeam { name: name.to_owned(), pairs });
    }
    (compiled, Draped { positions, surfaces: vec![form()], stats: Stats::default() })
}

/// A ball of 25 cm radius on the ground under a sheet of 1 m.
pub fn sheet_on_ball(fabric: Fabric, atlas: Atlas) -> (Compiled, Draped) {
    let shape = Shape::Sphere { radius: 0.25 };
    let ball = Solid {
        name: "ball".to_owned(),
        span: Default::default(),
        shape,
        at: [0.0, 0.25, 0.0],
        turn: [0.0; 3],
        friction: None,
    };
    let mut compiled = Compiled {
        name: "handkerchief".to_owned(),
        fabrics: vec![fabric],
        atlas,
        solids: vec![ball],
        ..Compiled::default()
    };
    let mut positions = Vec::new();
    let place = |s: f64, t: f64| {
        let (x, z) = ((s - 0.5) * 0.76, (0.5 - t) * 0.76);
        let (out, angle) = (x.hypot(z), x.atan2(z));
        let bend = (out / 0.253).min(1.35);
        let left = (out - 0.253 * 1.35).max(0.0);
        let wave = 0.10 * left.sqrt() * (4.0 * angle).cos() + 0.03 * left * (9.0 * angle).sin();
        let radius = 0.253 * bend.sin() + left * 0.16 + wave.max(-0.012);
        let height = 0.25 + 0.253 * bend.cos() - left * 0.95;
        Point3::new(radius * angle.sin(), height.max(0.004), radius * angle.cos())
    };
    let rest = |s: f64, t: f64| [s * 0.76, t * 0.76];
    sheet("cloth", &mut compiled, &mut positions, [128, 128], rest, place);
    let rings: Vec<[f64; 3]> = (0..=48)
        .map(|k| {
            let angle = TAU / 2.0 * f64::from(k) / 48.0;
            [0.25 - 0.25 * angle.cos(), 0.25 * angle.sin(), 0.25 * angle.sin()]
        })
        .collect();
    let surfaces = vec![turned("ball", SurfaceKind::Solid, &rings, 96)];
    (compiled, Draped { positions, surfaces, stats: Stats::default() })
}
