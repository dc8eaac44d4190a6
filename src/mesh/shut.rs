//! Folds sewn shut: the particles beside the line that is sewn, and the points of faces on which they
//! lie when the cloth is folded. A place and its mirror image about the crease lie on each other.

use super::compiled::{Compiled, MeshPanel, MeshShut, MeshStitch};
use super::locate::Faces;
use super::outline::Grain;
use crate::garment::Garment;
use crate::garment::panel::Crease;
use crate::geometry::polygon::{Place, distance, from_to};

/// The folds sewn shut of all panels.
pub fn folds(garment: &Garment, compiled: &Compiled) -> Vec<MeshShut> {
    let mut found = Vec::new();
    for (number, (panel, mesh)) in garment.panels.iter().zip(&compiled.panels).enumerate() {
        if panel.creases.iter().all(|crease| crease.shut.is_none()) {
            continue;
        }
        let Some(faces) = Faces::new(compiled, mesh) else { continue };
        let grain = Grain::new(panel.grain);
        for crease in &panel.creases {
            let stitches = stitches(compiled, mesh, &faces, crease, grain);
            if !stitches.is_empty() {
                let face_on_face = crease.angle > 0.0;
                found.push(MeshShut { panel: number, face_on_face, stitches });
            }
        }
    }
    found
}

fn stitches(
    compiled: &Compiled,
    mesh: &MeshPanel,
    faces: &Faces<'_>,
    crease: &Crease,
    grain: Grain,
) -> Vec<MeshStitch> {
    let Some(shut) = crease.shut else { return Vec::new() };
    let from = grain.to_cloth(crease.from);
    let [across, along] = [shut.across, shut.along].map(|way| grain.to_cloth(way));
    let width = distance([0.0; 2], across);
    let length = distance([0.0; 2], along);
    if !(width > 0.0 && length > 0.0) {
        return Vec::new();
    }
    let [u, w] = [(along, length), (across, width)].map(|(way, size)| way.map(|x| x / size));
    let mut stitches: Vec<MeshStitch> = Vec::new();
    let dot = |a: Place, b: Place| a[0] * b[0] + a[1] * b[1];
    for particle in mesh.particles.range() {
        let place = compiled.particles[particle];
        let way = from_to(from, place);
        let (down, out) = (dot(way, u), dot(way, w));
        // Half a cell on both sides of the line: one particle for each step along it, more or less.
        let beside = (out - width).abs() <= 0.5 * mesh.cell && out > 0.25 * width;
        if !beside || !(0.0..=length).contains(&down) {
            continue;
        }
        let image = [0, 1].map(|k| place[k] - 2.0 * out * w[k]);
        if let Some((corners, weights)) = faces.triangle(image) {
            stitches.push(MeshStitch { particle: particle as u32, corners, weights });
        }
    }
    stitches
}
