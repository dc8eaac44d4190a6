//! Plain pieces of cloth for the trials, made by hand.

use super::skin::{Nearest, Skin};
use crate::garment::scene::Placement;
use crate::mesh::compiled::{Compiled, MeshPanel, Stretch};
use crate::textile::Colour;
use crate::textile::fabric::{Fabric, Finish, Structure};
use crate::textile::knit::{Knit, Stitch};
use crate::textile::yarn::{Fibre, Twist, Yarn};
use nalgebra::Vector3;

/// The fabric of `performance.md`'s scene, with the given bending.
pub fn fabric(bending: f64) -> Fabric {
    let yarn = Yarn {
        name: "yarn".to_owned(),
        count: 20e-6,
        plies: 1,
        twist: 600.0,
        direction: Twist::Z,
        fibre: Fibre::Cotton,
        colour: Colour([200, 200, 200, 255]),
        diameter: 0.2e-3,
    };
    let knit = Knit::of_loops("plain", vec![vec![Stitch::Face]], 1000.0, 1000.0).unwrap();
    Fabric {
        name: "cloth".to_owned(),
        structure: Structure::Knitted { knit, yarn },
        mass: 0.15,
        thickness: 0.4e-3,
        bending: [bending; 2],
        tensile: [1000.0; 2],
        shear: 30.0,
        poisson: 0.25,
        friction: 0.3,
        damping: 0.0,
        finish: Finish::Matte,
    }
}

/// Rectangles of n × m cells of side h side by side, each a panel.
pub fn rectangles(count: usize, cells: [usize; 2], h: f64, fabric: Fabric) -> Compiled {
    let mut compiled =
        Compiled { name: "swatch".to_owned(), fabrics: vec![fabric], ..Compiled::default() };
    let [n, m] = cells;
    for number in 0..count {
        let first = compiled.particles.len() as u32;
        let cell = compiled.cells.len() as u32;
        for j in 0..=m {
            for i in 0..=n {
                compiled.particles.push([i as f64 * h, j as f64 * h]);
                compiled.lattice.push([i as i32, j as i32]);
            }
        }
        let at = |i: usize, j: usize| first + (j * (n + 1) + i) as u32;
        for j in 0..m {
            for i in 0..n {
                compiled.cells.push([at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
            }
        }
        compiled.panels.push(MeshPanel {
            name: format!("panel{number}"),
            fabric: 0,
            cell: h,
            layer: 0,
            grain: 0.0,
            placement: Placement::Led,
            particles: Stretch { start: first, end: compiled.particles.len() as u32 },
            cells: Stretch { start: cell, end: compiled.cells.len() as u32 },
            triangles: Stretch::default(),
            loops: Vec::new(),
            edges: Vec::new(),
            surfaces: Vec::new(),
        });
    }
    compiled
}

/// Turns the cells of a swatch into band triangles of irregular shape: every inner particle is
/// moved by up to a fifth of a cell, and cells are cut along alternating diagonals.
pub fn irregular(mut compiled: Compiled, cells: [usize; 2], h: f64) -> Compiled {
    let [n, m] = cells;
    let mut seed = 12345u64;
    let mut chance = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((seed >> 33) as f64 / (1u64 << 31) as f64 - 0.5) * 0.4 * h
    };
    for j in 1..m {
        for i in 1..n {
            let p = &mut compiled.particles[j * (n + 1) + i];
            *p = [p[0] + chance(), p[1] + chance()];
        }
    }
    for (k, [a, b, c, d]) in std::mem::take(&mut compiled.cells).into_iter().enumerate() {
        if (k % n + k / n) % 2 == 0 {
            compiled.triangles.extend([[a, b, c], [a, c, d]]);
        } else {
            compiled.triangles.extend([[a, b, d], [b, c, d]]);
        }
    }
    let panel = &mut compiled.panels[0];
    panel.cells = Stretch::default();
    panel.triangles = Stretch { start: 0, end: compiled.triangles.len() as u32 };
    compiled
}

/// No skin at all.
pub struct Nothing;

impl Skin for Nothing {
    fn nearest(&self, _place: &Vector3<f64>) -> Option<Nearest> {
        None
    }
}

/// A ball.
pub struct Ball {
    pub centre: Vector3<f64>,
    pub radius: f64,
}

impl Skin for Ball {
    fn nearest(&self, place: &Vector3<f64>) -> Option<Nearest> {
        let d = place - self.centre;
        let r = d.norm();
        let normal = if r > 0.0 { d / r } else { Vector3::y() };
        Some(Nearest { distance: r - self.radius, normal, friction: None })
    }
}

/// The half space below a plane through the origin.
pub struct Slope {
    pub normal: Vector3<f64>,
}

impl Skin for Slope {
    fn nearest(&self, place: &Vector3<f64>) -> Option<Nearest> {
        Some(Nearest { distance: place.dot(&self.normal), normal: self.normal, friction: None })
    }
}
