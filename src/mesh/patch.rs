//! Patches: the particles along their edges, and the points of the host's faces to which they are
//! sewn. A host is cut on its own grid, which knows nothing of what is sewn on it.

use super::compiled::{Compiled, MeshPatch, MeshStitch};
use super::locate::Faces;
use crate::garment::Garment;
use crate::garment::seam::Patch;
use crate::geometry::curve;
use kurbo::{Affine, Point};

/// The stitches of a patch, of which the given particles lie on the sewn edges.
pub fn sewn(garment: &Garment, compiled: &Compiled, patch: &Patch, points: &[u32]) -> MeshPatch {
    let grain = |panel: usize| garment.panels.get(panel).map_or(0.0, |panel| panel.grain);
    let map = curve::turning(-grain(patch.host))
        * Affine::new(patch.map)
        * curve::turning(grain(patch.panel));
    let mut points = points.to_vec();
    points.sort_unstable();
    points.dedup();
    let faces = compiled.panels.get(patch.host).and_then(|host| Faces::new(compiled, host));
    let stitches = points.into_iter().filter_map(|particle| {
        let [u, v] = *compiled.particles.get(particle as usize)?;
        let there = map * Point::new(u, v);
        let (corners, weights) = faces.as_ref()?.triangle([there.x, there.y])?;
        Some(MeshStitch { particle, corners, weights })
    });
    MeshPatch {
        name: patch.name.clone(),
        panel: patch.panel,
        host: patch.host,
        stitches: stitches.collect(),
        map: map.as_coeffs(),
    }
}
