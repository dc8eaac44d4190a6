//! One panel as particles, cells and triangles.

use super::band::{Band, Role};
use super::improve::improve;
use super::lattice::{Ground, Lattice};
use super::sharpness::NarrowCorners;
use crate::geometry::polygon::{Place, signed_area, turn};

/// Corners of intact cells lie at least this many cells inside the outline.
const MARGIN: f32 = 0.7;

/// The cloth of one panel; numbers of particles begin at 0 here.
#[derive(Clone, Debug, Default)]
pub struct Cloth {
    /// (u, v), m.
    pub particles: Vec<Place>,
    /// Column and row; `i32::MIN` off the grid.
    pub lattice: Vec<[i32; 2]>,
    /// Intact cells.
    pub cells: Vec<[u32; 4]>,
    /// Triangles of the band.
    pub triangles: Vec<[u32; 3]>,
    /// The particle at each point of the outline, ring after ring.
    pub outline: Vec<u32>,
    /// Points of the outline, ring after ring, at triangles sharper than they need be.
    pub sharp: Vec<usize>,
}

/// Cuts a panel: `rings` are its cut lines as points (m), the outline anticlockwise, holes
/// clockwise; `cell` is the side of a grid cell, m. `None` when the lines cross or touch.
pub fn cut(rings: &[Vec<Place>], cell: f64) -> Option<Cloth> {
    let lattice = Lattice::over(rings.first()?, cell);
    let ground = Ground::new(lattice, rings, MARGIN);
    let scaled: Vec<Vec<Place>> = rings
        .iter()
        .map(|ring| ring.iter().map(|place| place.map(|x| x / cell)).collect())
        .collect();
    let mut band = Band::new(ground, &scaled);
    let drawn = improve(&mut band)?;

    // Particles: the grid row by row, then the rest of the outline, then the free points.
    let mut cloth = Cloth::default();
    let mut of_lattice = vec![u32::MAX; band.ground.depth.len()];
    cloth.outline = vec![u32::MAX; band.outline.len()];
    for point in band.lattice_points() {
        let particle = cloth.particles.len() as u32;
        of_lattice[point] = particle;
        let [i, j] = lattice.column_row(point);
        cloth.particles.push(lattice.place(point));
        cloth.lattice.push([i as i32, j as i32]);
        if let Some(known) = cloth.outline.get_mut(band.ground.on_outline[point] as usize) {
            *known = particle;
        }
    }
    for (place, known) in rings.iter().flatten().zip(&mut cloth.outline) {
        if *known == u32::MAX {
            *known = cloth.particles.len() as u32;
            cloth.particles.push(*place);
            cloth.lattice.push([i32::MIN; 2]);
        }
    }
    let mut of_band = Vec::with_capacity(drawn.places.len());
    for (number, (role, place)) in drawn.roles.iter().zip(&drawn.places).enumerate() {
        of_band.push(match *role {
            Role::Outline => cloth.outline[number],
            Role::Corner(point) | Role::Lattice(point) => of_lattice[point],
            Role::Loose(_) => {
                cloth.particles.push(place.map(|x| x * cell));
                cloth.lattice.push([i32::MIN; 2]);
                cloth.particles.len() as u32 - 1
            }
        });
    }
    for j in 0..lattice.count[1] - 1 {
        for i in 0..lattice.count[0] - 1 {
            if band.ground.intact[lattice.number(i, j)] {
                cloth.cells.push(band.ground.corners(i, j).map(|point| of_lattice[point]));
            }
        }
    }
    cloth.triangles = ordered(&drawn.mesh.triangles, &of_band);
    let narrow = NarrowCorners::new(&scaled);
    for corners in &drawn.mesh.triangles {
        if narrow.blames(corners.map(|k| drawn.places[k as usize])) {
            let on_outline =
                corners.iter().map(|&k| k as usize).filter(|&k| k < band.outline.len());
            cloth.sharp.extend(on_outline);
        }
    }
    whole(&cloth, rings, cell).then_some(cloth)
}

/// The triangles by their particles, each beginning with its least, in ascending order, so that
/// their order does not depend on how the band was triangulated.
fn ordered(triangles: &[[u32; 3]], of_band: &[u32]) -> Vec<[u32; 3]> {
    let mut found: Vec<[u32; 3]> = triangles
        .iter()
        .map(|corners| {
            let mut corners = corners.map(|k| of_band[k as usize]);
            let least = (0..3).min_by_key(|&k| corners[k]).unwrap_or(0);
            corners.rotate_left(least);
            corners
        })
        .collect();
    found.sort_unstable();
    found
}

/// Whether cells and triangles together have the area of the polygon, and each its right side up.
fn whole(cloth: &Cloth, rings: &[Vec<Place>], cell: f64) -> bool {
    let wanted: f64 = rings.iter().map(|ring| signed_area(ring)).sum();
    let mut area = cloth.cells.len() as f64 * cell * cell;
    for corners in &cloth.triangles {
        let [a, b, c] = corners.map(|k| cloth.particles[k as usize]);
        let double = turn(a, b, c);
        if double <= 0.0 {
            return false;
        }
        area += double / 2.0;
    }
    (area - wanted).abs() <= 1e-6 * wanted.abs() + 1e-9 * cell * cell
}
