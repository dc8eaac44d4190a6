//! Creases: the sides of cells and triangles that take up the folds of the cloth.
//!
//! A crease seldom runs along the grid. Every way over the cloth from face to face that crosses it
//! turns by its angle all the same if each side takes the part of the turn that is about itself:
//! a side between two faces whose middles lie on either side of the crease rests at the crease's
//! angle times the cosine between the two.

use super::compiled::{Compiled, MeshCrease, MeshPanel};
use super::outline::Grain;
use crate::garment::Garment;
use crate::geometry::polygon::{Place, from_to, turn};

/// Sides that would turn by less than this stay flat, rad.
const FLAT: f64 = 1e-2;

/// A side with the middles of the faces on it; the second is missing at the rim.
struct Side {
    ends: [u32; 2],
    middle: Place,
}

/// The creases of all panels, panel by panel and crease by crease.
pub fn creases(garment: &Garment, compiled: &Compiled) -> Vec<MeshCrease> {
    let mut found = Vec::new();
    for (panel, mesh) in garment.panels.iter().zip(&compiled.panels) {
        if panel.creases.is_empty() {
            continue;
        }
        let grain = Grain::new(panel.grain);
        let sides = sides(compiled, mesh);
        for crease in &panel.creases {
            let line = [crease.from, crease.to].map(|place| grain.to_cloth(place));
            let [x, y] = from_to(line[0], line[1]);
            let length = libm::hypot(x, y);
            if length <= 0.0 {
                continue;
            }
            for pair in sides.windows(2) {
                let [first, second] = pair else { continue };
                if first.ends != second.ends || !crosses(line, first.middle, second.middle) {
                    continue;
                }
                let [a, b] = first.ends.map(|k| compiled.particles[k as usize]);
                let [u, v] = from_to(a, b);
                let cos = (u * x + v * y).abs() / (libm::hypot(u, v) * length);
                let angle = crease.angle * cos;
                if angle.abs() >= FLAT {
                    found.push(MeshCrease { side: first.ends, angle });
                }
            }
        }
    }
    found
}

/// The sides of all cells and triangles of a panel; those of two faces stand next to each other.
fn sides(compiled: &Compiled, panel: &MeshPanel) -> Vec<Side> {
    let mut sides = Vec::new();
    let mut add = |corners: &[u32]| {
        let share = 1.0 / corners.len() as f64;
        let middle = corners.iter().fold([0.0; 2], |sum: Place, &k| {
            let place = compiled.particles[k as usize];
            [sum[0] + share * place[0], sum[1] + share * place[1]]
        });
        for (&a, &b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
            sides.push(Side { ends: [a.min(b), a.max(b)], middle });
        }
    };
    compiled.cells[panel.cells.range()].iter().for_each(|cell| add(cell));
    compiled.triangles[panel.triangles.range()].iter().for_each(|triangle| add(triangle));
    sides.sort_by_key(|side| side.ends);
    sides
}

/// Whether the way from one place to another crosses a line between its ends.
fn crosses([from, to]: [Place; 2], a: Place, b: Place) -> bool {
    // A place on the line itself counts to one side of it, so that no way slips through.
    let side = |place: Place| turn(from, to, place) >= 0.0;
    let end = |end: Place| turn(a, b, end) >= 0.0;
    side(a) != side(b) && end(from) != end(to)
}
