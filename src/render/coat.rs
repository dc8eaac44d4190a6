//! The colours of what covers the figure.

use super::Light3;
use super::figure::Panel;
use super::finish::Threads;
use super::hierarchy::Ray;
use super::swatch::Swatches;
use crate::mesh::compiled::Surface;

/// Nothing sends back all the light; a cloth that did would never let a fold grow dark.
pub const WHITEST: f32 = 0.94;

impl Panel {
    /// The surface that shows at a place of the panel, and the place from its origin.
    pub fn surface_at(&self, rest: [f64; 2]) -> Option<(&Surface, [f64; 2])> {
        let holds = |surface: &&Surface| match surface.area {
            Some([u0, v0, u1, v1]) => (u0..=u1).contains(&rest[0]) && (v0..=v1).contains(&rest[1]),
            None => true,
        };
        // Rounding at the very edge must not fall between two areas.
        let surface = self.surfaces.iter().find(holds).or_else(|| self.surfaces.last())?;
        let [u0, v0] = surface.area.map_or([0.0; 2], |[u0, v0, _, _]| [u0, v0]);
        Some((surface, [rest[0] - u0, rest[1] - v0]))
    }

    /// Its colour at a place, seen along the ray through a window `wide` m wide.
    pub fn colour(
        &self,
        swatches: &Swatches,
        rest: [f64; 2],
        back: bool,
        wide: f32,
        threads: &Threads,
        ray: &Ray,
    ) -> Light3 {
        let Some((surface, [u, v])) = self.surface_at(rest) else { return self.plain };
        let region = if back && swatches.has(surface.back) { surface.back } else { surface.face };
        let mut colour = swatches.look(region, u, v, wide.max(self.blur)).colour;
        if let Some([warp, weft]) = swatches.shot(region) {
            // Looked at along the weft, the crowns of the warp hide the weft between them, and
            // the other way round.
            let along_weft = ray.direction.dot(&threads.weft);
            let along_warp = ray.direction.dot(&threads.warp);
            let lean = along_weft * along_weft - along_warp * along_warp;
            let share = (0.5 + 0.75 * lean).clamp(0.05, 0.95);
            let turned = warp * share + weft * (1.0 - share);
            let even = (warp + weft) * 0.5;
            colour = colour.zip_map(&turned.zip_map(&even, |t, e| t / e.max(1e-3)), |c, f| c * f);
        }
        colour.map(|c| c.clamp(0.0, WHITEST))
    }
}
