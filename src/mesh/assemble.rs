//! Panels, seams and everything held, put together as one mesh.

use super::breakpoint::Walk;
use super::compiled::{Compiled, MeshAttachment, MeshEdge, MeshPanel, MeshPin, MeshSeam, Stretch};
use super::cord;
use super::matching::points_of;
use super::outline::Grain;
use super::panel::Cloth;
use super::patch;
use super::plan::Plan;
use super::spacing::{Address, Spacing};
use crate::garment::Garment;
use crate::garment::seam::Pinned;
use crate::geometry::polygon::{Place, distance};

/// Puts the cloth of all panels together; `cells` are the sides of their grid cells, m. The
/// picture of the textiles is left empty.
pub fn assemble(
    garment: &Garment,
    plan: &Plan,
    spacing: &Spacing,
    cells: &[f64],
    cloths: Vec<Cloth>,
) -> Compiled {
    let steps = |ring: usize, interval: usize| spacing.steps(plan.class((ring, interval, 0)));
    // The particle at each step of each ring.
    let mut of_ring: Vec<Vec<u32>> = Vec::new();
    let mut compiled = Compiled { name: garment.name.clone(), ..Compiled::default() };
    for ((number, panel), cloth) in garment.panels.iter().enumerate().zip(cloths) {
        let first = compiled.particles.len() as u32;
        let stretch = |before: usize, more: usize| Stretch {
            start: before as u32,
            end: (before + more) as u32,
        };
        let mut outline = cloth.outline.iter().map(|&particle| first + particle);
        let mut loops = Vec::new();
        for loop_number in 0..panel.loops.len() {
            if let Some(ring) = plan.rings.number(number, loop_number) {
                let count = (0..plan.rings.rings[ring].breaks.len()).map(|i| steps(ring, i)).sum();
                loops.push(outline.by_ref().take(count).collect::<Vec<u32>>());
            }
        }
        of_ring.extend(loops.iter().cloned());
        compiled.panels.push(MeshPanel {
            name: panel.name.clone(),
            fabric: panel.fabric,
            cell: cells[number],
            layer: panel.layer,
            grain: panel.grain,
            placement: panel.placement.clone(),
            particles: stretch(compiled.particles.len(), cloth.particles.len()),
            cells: stretch(compiled.cells.len(), cloth.cells.len()),
            triangles: stretch(compiled.triangles.len(), cloth.triangles.len()),
            loops,
            edges: Vec::new(),
            surfaces: Vec::new(),
        });
        compiled.particles.extend(cloth.particles);
        compiled.lattice.extend(cloth.lattice);
        compiled.cells.extend(cloth.cells.iter().map(|corners| corners.map(|k| first + k)));
        compiled.triangles.extend(cloth.triangles.iter().map(|corners| corners.map(|k| first + k)));
    }
    // First step of each interval on its ring.
    let starts: Vec<Vec<usize>> = plan
        .rings
        .rings
        .iter()
        .enumerate()
        .map(|(ring, line)| {
            let mut before = 0;
            let intervals = (0..line.breaks.len()).map(|interval| {
                let start = before;
                before += steps(ring, interval);
                start
            });
            intervals.collect()
        })
        .collect();
    let particle = |(ring, interval, step): Address| of_ring[ring][starts[ring][interval] + step];
    let along = |walks: &[Walk]| {
        let mut points: Vec<u32> = walks
            .iter()
            .flat_map(|walk| points_of(walk, &plan.rings, steps))
            .map(particle)
            .collect();
        points.dedup();
        points
    };
    for (number, panel) in garment.panels.iter().enumerate() {
        let edges = panel.edges.iter().zip(&plan.edges[number]);
        compiled.panels[number].edges = edges
            .map(|(edge, walks)| MeshEdge { name: edge.name.clone(), points: along(walks) })
            .collect();
    }
    compiled.seams = garment
        .seams
        .iter()
        .zip(&plan.seams)
        .map(|(seam, matched)| {
            let pairs = matched.as_ref().map(|matched| matched.pairs(&plan.rings, steps));
            let pairs = pairs.into_iter().flatten().map(|pair| pair.map(particle)).collect();
            MeshSeam { name: seam.name.clone(), pairs }
        })
        .collect();
    compiled.attachments = garment
        .attachments
        .iter()
        .zip(&plan.attachments)
        .map(|(held, walks)| MeshAttachment {
            points: along(walks),
            body: held.body,
            landmark: held.landmark.clone(),
        })
        .collect();
    compiled.cords = garment
        .cords
        .iter()
        .zip(&plan.cords)
        .map(|(cord, walks)| {
            let lines: Vec<Vec<u32>> =
                walks.iter().map(|walk| along(std::slice::from_ref(walk))).collect();
            cord::along(cord, &lines, &compiled.particles)
        })
        .collect();
    compiled.pins = garment
        .pins
        .iter()
        .zip(&plan.pins)
        .map(|(pin, walks)| {
            let points = match &pin.what {
                Pinned::Runs(_) => along(walks),
                Pinned::Point { panel, at } => {
                    nearest(garment, &compiled, *panel, *at).into_iter().collect()
                }
            };
            MeshPin { points, to: pin.to.clone() }
        })
        .collect();
    compiled.patches = garment
        .patches
        .iter()
        .zip(&plan.patches)
        .map(|(on, walks)| patch::sewn(garment, &compiled, on, &along(walks)))
        .collect();
    compiled.fabrics = garment.fabrics.clone();
    compiled.bodies = garment.bodies.clone();
    compiled.solids = garment.solids.clone();
    compiled.schedule = garment.schedule.clone();
    compiled.pictures = garment.pictures.clone();
    compiled
}

/// The particle of a panel nearest to a place of its drawing.
pub fn nearest(garment: &Garment, compiled: &Compiled, panel: usize, at: Place) -> Option<u32> {
    let place = Grain::new(garment.panels.get(panel)?.grain).to_cloth(at);
    let range = compiled.panels.get(panel)?.particles.range();
    range
        .min_by(|&a, &b| {
            let away = |k: usize| distance(compiled.particles[k], place);
            away(a).total_cmp(&away(b))
        })
        .map(|k| k as u32)
}
