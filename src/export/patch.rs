//! The faces of a panel, sorted by the textile that they show.

use crate::mesh::compiled::{Compiled, MeshPanel, Region};

/// Faces of one panel that show one region of the atlas.
pub struct Patch {
    /// Number of the region; none where the atlas holds nothing for them.
    pub region: Option<usize>,
    /// Where the region's origin lies in the panel, (u, v), m.
    pub origin: [f64; 2],
    /// Intact cells.
    pub cells: Vec<[u32; 4]>,
    /// Triangles of the bands.
    pub triangles: Vec<[u32; 3]>,
}

impl Patch {
    /// All faces as triangles, cells cut along the diagonal from their first corner.
    pub fn all_triangles(&self) -> impl Iterator<Item = [u32; 3]> + '_ {
        let halves = self.cells.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
        halves.chain(self.triangles.iter().copied())
    }

    /// Place on the region of a particle, counted in its widths and heights from its lower left
    /// corner. On tiles it goes beyond 1 as the cloth repeats.
    pub fn on_region(&self, compiled: &Compiled, particle: u32) -> [f64; 2] {
        let size = self.shown(compiled).map_or([1.0; 2], |region| region.size);
        let place = compiled.particles.get(particle as usize).copied().unwrap_or_default();
        [0, 1].map(|axis| (place[axis] - self.origin[axis]) / size[axis].max(1e-9))
    }

    /// The region, if it is there.
    pub fn shown<'a>(&self, compiled: &'a Compiled) -> Option<&'a Region> {
        compiled.atlas.regions.get(self.region?)
    }
}

/// The patches of a panel; those without a face are left out. A face belongs to the first
/// surface that holds its middle.
pub fn patches(compiled: &Compiled, panel: &MeshPanel) -> Vec<Patch> {
    let regions = if compiled.atlas.pixels.is_empty() { 0 } else { compiled.atlas.regions.len() };
    let empty = |region, origin| Patch { region, origin, cells: vec![], triangles: vec![] };
    let mut patches: Vec<Patch> = panel
        .surfaces
        .iter()
        .map(|surface| {
            let origin = surface.area.map_or([0.0; 2], |[u0, v0, ..]| [u0, v0]);
            empty((surface.face < regions).then_some(surface.face), origin)
        })
        .collect();
    // Whatever no surface holds.
    patches.push(empty(None, [0.0; 2]));
    let bare = patches.len() - 1;
    let patch_of = |corners: &[u32]| {
        let mut middle = [0.0; 2];
        for &corner in corners {
            let place = compiled.particles.get(corner as usize).copied().unwrap_or_default();
            middle = [0, 1].map(|axis| middle[axis] + place[axis] / corners.len() as f64);
        }
        let [u, v] = middle;
        let holds = |area: Option<[f64; 4]>| {
            area.is_none_or(|[u0, v0, u1, v1]| u0 <= u && u <= u1 && v0 <= v && v <= v1)
        };
        panel.surfaces.iter().position(|surface| holds(surface.area)).unwrap_or(bare)
    };
    for cell in compiled.cells.get(panel.cells.range()).unwrap_or_default() {
        patches[patch_of(cell)].cells.push(*cell);
    }
    for triangle in compiled.triangles.get(panel.triangles.range()).unwrap_or_default() {
        patches[patch_of(triangle)].triangles.push(*triangle);
    }
    patches.retain(|patch| !patch.cells.is_empty() || !patch.triangles.is_empty());
    patches
}
