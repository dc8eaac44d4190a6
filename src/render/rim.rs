//! The edge of cloth has a thickness: a rounded bead along every edge that is not sewn to another,
//! which flows into the face and the back.

use super::figure::{Corner, Face};
use crate::mesh::compiled::Compiled;
use crate::textile::fabric::Fabric;
use nalgebra::{Vector2, Vector3};

/// Half the height of the bead in thicknesses of the cloth: a little more than that of a raw edge.
const HIGH: f64 = 0.75;

/// Beads of very thick or of unknown cloth stay within this, m.
const HEIGHTS: [f64; 2] = [1.5e-4, 1e-3];

/// Half the outline of a bead, from the cloth over the face to the edge: way inwards, height and
/// the normal's lean outwards, in half heights.
const PROFILE: [[f64; 3]; 6] = [
    [3.4, 0.04, 0.0],
    [2.3, 0.45, -0.45],
    [1.3, 0.90, -0.20],
    [0.6, 0.95, 0.25],
    [0.12, 0.62, 0.75],
    [0.0, 0.0, 1.0],
];

/// Corners across a bead, from the face round the edge to the back.
const ROUND: usize = 2 * PROFILE.len() - 1;

/// A stretch longer than this is no edge of cloth but damage, m.
const LONGEST: f64 = 0.1;

/// Places of one edge and the directions about it.
#[derive(Clone, Copy)]
struct Knot {
    place: Vector3<f64>,
    normal: Vector3<f64>,
    /// Into the cloth.
    inwards: Vector3<f64>,
    rest: Vector2<f64>,
    rest_inwards: Vector2<f64>,
}

/// Adds the beads of all free edges to the cloth. `corners` holds one corner for each particle,
/// from `first` on; `sewn` tells which particles are sewn.
pub fn turn(
    compiled: &Compiled,
    sewn: &[bool],
    first: u32,
    corners: &mut Vec<Corner>,
    faces: &mut Vec<Face>,
) {
    for (coat, panel) in compiled.panels.iter().enumerate() {
        let high = compiled.fabrics.get(panel.fabric).map_or(HEIGHTS[0], bead);
        for outline in &panel.loops {
            bead_along(outline, sewn, first, high, coat as u32, corners, faces);
        }
    }
}

/// Half the height of the bead of a fabric, m.
fn bead(fabric: &Fabric) -> f64 {
    let high = HIGH * fabric.thickness;
    if high.is_finite() { high.clamp(HEIGHTS[0], HEIGHTS[1]) } else { HEIGHTS[0] }
}

fn bead_along(
    outline: &[u32],
    sewn: &[bool],
    first: u32,
    high: f64,
    coat: u32,
    corners: &mut Vec<Corner>,
    faces: &mut Vec<Face>,
) {
    let count = outline.len();
    if count < 3 {
        return;
    }
    let free = |k: usize| sewn.get(outline[k] as usize).is_some_and(|sewn| !sewn);
    let at = |k: usize| corners.get((first + outline[k]) as usize).copied();
    let knots: Vec<Option<Knot>> = (0..count)
        .map(|k| knot(&at((k + count - 1) % count)?, &at(k)?, &at((k + 1) % count)?))
        .collect();
    let mut rings: Vec<Option<u32>> = vec![None; count];
    for k in 0..count {
        let next = (k + 1) % count;
        // A stretch is sewn where both of its ends are.
        if !(free(k) || free(next)) {
            continue;
        }
        let (Some(a), Some(b)) = (knots[k], knots[next]) else { continue };
        if !((a.place - b.place).norm() < LONGEST) {
            continue;
        }
        let from = *rings[k].get_or_insert_with(|| ring(&a, high, corners));
        let to = *rings[next].get_or_insert_with(|| ring(&b, high, corners));
        for step in 0..ROUND as u32 - 1 {
            let quad = [from + step, to + step, to + step + 1, from + step + 1];
            faces.push(Face { corners: [quad[0], quad[2], quad[1]], coat });
            faces.push(Face { corners: [quad[0], quad[3], quad[2]], coat });
        }
    }
}

/// The directions at a place of the outline, from its neighbours.
fn knot(before: &Corner, here: &Corner, after: &Corner) -> Option<Knot> {
    let place = here.place.map(f64::from);
    let normal = here.normal.map(f64::from);
    let along = (after.place - before.place).map(f64::from);
    let sound = |v: &Vector3<f64>| v.iter().all(|c| c.is_finite());
    if !sound(&place) || !sound(&normal) || !(along.norm() < 2.0 * LONGEST) {
        return None;
    }
    let along = (along - normal * along.dot(&normal)).try_normalize(1e-9)?;
    let rest = Vector2::from(here.rest);
    let flat = Vector2::from(after.rest) - Vector2::from(before.rest);
    let flat = flat.try_normalize(1e-9)?;
    // Outlines run anticlockwise on the face: the cloth lies to their left.
    Some(Knot {
        place,
        normal,
        inwards: normal.cross(&along),
        rest,
        rest_inwards: Vector2::new(-flat.y, flat.x),
    })
}

/// Corners of a bead at a knot, from the face round the edge to the back.
fn ring(knot: &Knot, high: f64, corners: &mut Vec<Corner>) -> u32 {
    let number = corners.len() as u32;
    for step in 0..ROUND {
        let (side, at) = if step < PROFILE.len() { (1.0, step) } else { (-1.0, ROUND - 1 - step) };
        let [inwards, up, lean] = PROFILE[at];
        let place = knot.place + knot.inwards * (inwards * high) + knot.normal * (side * up * high);
        let upright = (1.0 - lean * lean).max(0.0).sqrt();
        let normal = knot.normal * (side * upright) - knot.inwards * lean;
        let rest = knot.rest + knot.rest_inwards * (inwards * high);
        corners.push(Corner {
            place: place.map(|x| x as f32),
            normal: normal.map(|x| x as f32),
            rest: [rest.x, rest.y],
        });
    }
    number
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::garment::scene::Placement;
    use crate::mesh::compiled::{MeshPanel, Stretch};
    use crate::render::Vector;

    #[test]
    fn a_free_edge_is_rounded_outwards_and_a_sewn_one_left() {
        let rest = [[0.0, 0.0], [0.05, 0.0], [0.05, 0.05], [0.0, 0.05]];
        let mut corners: Vec<Corner> = rest
            .map(|[x, y]| Corner {
                place: Vector::new(x as f32, y as f32, 0.0),
                normal: Vector::z(),
                rest: [x, y],
            })
            .to_vec();
        let panel = MeshPanel {
            name: "square".to_owned(),
            fabric: 0,
            cell: 0.01,
            layer: 0,
            grain: 0.0,
            placement: Placement::Led,
            particles: Stretch { start: 0, end: 4 },
            cells: Stretch::default(),
            triangles: Stretch::default(),
            loops: vec![vec![0, 1, 2, 3]],
            edges: vec![],
            surfaces: vec![],
        };
        let compiled = Compiled { panels: vec![panel], ..Compiled::default() };
        let mut faces = Vec::new();
        turn(&compiled, &[true, true, false, false], 0, &mut corners, &mut faces);
        // Three stretches of four are free.
        assert_eq!(faces.len(), 3 * 2 * (ROUND - 1));
        for face in &faces {
            let [a, b, c] = face.corners.map(|k| corners[k as usize]);
            let flat = (b.place - a.place).cross(&(c.place - a.place));
            assert!(flat.dot(&(a.normal + b.normal + c.normal)) > 0.0, "turned inside out");
            for corner in [a, b, c] {
                assert!((-1e-4..=0.0501).contains(&corner.place.x));
            }
        }
    }
}
