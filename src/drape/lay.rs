//! Patches begin lying on their hosts, wherever those are.

use crate::drape::layers;
use crate::mesh::compiled::{Compiled, MeshPatch};
use crate::mesh::locate::Faces;
use kurbo::{Affine, Point};
use nalgebra::{Point3, Vector3};

/// Lays all patches on their hosts, one that lies on another after that one.
pub fn patches(compiled: &Compiled, positions: &mut [Point3<f64>]) {
    let mut open: Vec<&MeshPatch> = compiled.patches.iter().collect();
    while !open.is_empty() {
        let waits = |patch: &MeshPatch| open.iter().any(|other| other.panel == patch.host);
        let (later, now): (Vec<_>, Vec<_>) = open.iter().copied().partition(|patch| waits(patch));
        if now.is_empty() {
            return;
        }
        now.into_iter().for_each(|patch| lay(compiled, patch, positions));
        open = later;
    }
}

/// Lays a patch on its host, whose particles have their places, so far in front of it as layers of
/// cloth keep apart.
fn lay(compiled: &Compiled, patch: &MeshPatch, positions: &mut [Point3<f64>]) {
    let Some(host) = compiled.panels.get(patch.host) else { return };
    let Some(faces) = Faces::new(compiled, host) else { return };
    let fabric = |panel: usize| {
        compiled.panels.get(panel).and_then(|panel| compiled.fabrics.get(panel.fabric))
    };
    let thick = [patch.panel, patch.host].map(|p| fabric(p).map_or(0.0, |f| f.thickness));
    let off = layers::distance(thick[0].min(thick[1]), host.cell);
    let mut normals = vec![Vector3::zeros(); host.particles.range().len()];
    let first = host.particles.range().start;
    let cells = compiled.cells[host.cells.range()].iter();
    let halves = cells.flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
    let triangles = compiled.triangles[host.triangles.range()].iter().copied();
    for corners in halves.chain(triangles) {
        let [a, b, c] = corners.map(|k| positions[k as usize]);
        let normal = (b - a).cross(&(c - a));
        for k in corners {
            normals[k as usize - first] += normal;
        }
    }
    let map = Affine::new(patch.map);
    let Some(panel) = compiled.panels.get(patch.panel) else { return };
    for k in panel.particles.range() {
        let [u, v] = compiled.particles[k];
        let there = map * Point::new(u, v);
        let Some((corners, weights)) = faces.triangle([there.x, there.y]) else { continue };
        let (mut place, mut out) = (Vector3::zeros(), Vector3::zeros());
        for (corner, weight) in corners.into_iter().zip(weights) {
            place += positions[corner as usize].coords * weight;
            out += normals[corner as usize - first] * weight;
        }
        positions[k] = Point3::from(place + out / out.norm().max(1e-12) * off);
    }
}
