//! What later stages may rely on in a [`Compiled`], checked, and the facts found on the way.

use super::compiled::{Compiled, MeshPanel, Stretch};
use super::sharpness::NarrowCorners;
use crate::geometry::polygon::{Place, sharpest, signed_area, turn};
use std::collections::BTreeMap;
use thiserror::Error;

/// Cells are square to this share of their side.
const SQUARE: f64 = 4e-6;

/// What is wrong with a mesh.
#[derive(Clone, Debug, PartialEq, Error)]
#[allow(missing_docs)]
pub enum Flaw {
    #[error("the {what} of panel {panel} do not follow those before")]
    Order { panel: usize, what: &'static str },
    #[error("{what} names particle {particle}, which is not there")]
    Particle { what: &'static str, particle: u32 },
    #[error("particle {0} is not a number")]
    NotFinite(usize),
    #[error("particle {0} belongs to no cell and no triangle")]
    Unused(usize),
    #[error("cell {0} is no square of the grid")]
    NotSquare(usize),
    #[error("triangle {0} is turned over or has no area")]
    TurnedOver(usize),
    #[error("the side {0:?} is not shared as cloth shares it")]
    Side([u32; 2]),
    #[error("panel {panel}: V − E + F is {found}, and {wanted} for its loops")]
    Euler { panel: usize, found: i64, wanted: i64 },
    #[error("panel {panel} has {found} m² of cloth within {wanted} m² of outline")]
    Area { panel: usize, found: f64, wanted: f64 },
}

/// What is known of a panel's mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facts {
    /// Area of the cloth, m².
    pub area: f64,
    /// Smallest angle of all triangles, degrees; 90 where there is none.
    pub smallest_angle: f64,
    /// Triangles sharper than 20° where no narrow corner of the outline excuses them.
    pub sharp: usize,
}

/// Checks a mesh.
///
/// # Errors
/// All flaws found.
pub fn validate(compiled: &Compiled) -> Result<Vec<Facts>, Vec<Flaw>> {
    let mut flaws = Vec::new();
    stretches(compiled, &mut flaws);
    particles(compiled, &mut flaws);
    if !flaws.is_empty() {
        return Err(flaws);
    }
    let check = |(number, panel)| check_panel(compiled, number, panel, &mut flaws);
    let facts = compiled.panels.iter().enumerate().map(check).collect();
    if flaws.is_empty() { Ok(facts) } else { Err(flaws) }
}

fn stretches(compiled: &Compiled, flaws: &mut Vec<Flaw>) {
    let mut before = [0; 3];
    for (number, panel) in compiled.panels.iter().enumerate() {
        let own = [panel.particles, panel.cells, panel.triangles];
        for ((what, stretch), before) in
            ["particles", "cells", "triangles"].into_iter().zip(own).zip(&mut before)
        {
            if stretch.start != *before || stretch.end < stretch.start {
                flaws.push(Flaw::Order { panel: number, what });
            }
            *before = stretch.end;
        }
    }
    let all = [compiled.particles.len(), compiled.cells.len(), compiled.triangles.len()];
    if before.map(|end| end as usize) != all || compiled.lattice.len() != all[0] {
        flaws.push(Flaw::Order { panel: compiled.panels.len(), what: "particles" });
    }
}

/// All numbers of particles are those of their panel, or at least of some panel.
fn particles(compiled: &Compiled, flaws: &mut Vec<Flaw>) {
    let count = compiled.particles.len() as u32;
    let mut check = |what, particles: &mut dyn Iterator<Item = u32>, within: Stretch| {
        for particle in particles {
            if particle < within.start || particle >= within.end {
                flaws.push(Flaw::Particle { what, particle });
            }
        }
    };
    for panel in &compiled.panels {
        let own = panel.particles;
        let cells = compiled.cells.get(panel.cells.range()).unwrap_or_default();
        let triangles = compiled.triangles.get(panel.triangles.range()).unwrap_or_default();
        check("a cell", &mut cells.iter().flatten().copied(), own);
        check("a triangle", &mut triangles.iter().flatten().copied(), own);
        check("a loop", &mut panel.loops.iter().flatten().copied(), own);
        let edges = panel.edges.iter().flat_map(|edge| &edge.points);
        check("an edge", &mut edges.copied(), own);
    }
    let any = Stretch { start: 0, end: count };
    let pairs = compiled.seams.iter().flat_map(|seam| seam.pairs.iter().flatten());
    check("a seam", &mut pairs.copied(), any);
    let stitches = compiled.patches.iter().flat_map(|patch| &patch.stitches);
    let ends = stitches.flat_map(|s| s.corners.into_iter().chain([s.particle]));
    check("a patch", &mut ends.into_iter(), any);
    let held = compiled.attachments.iter().flat_map(|held| &held.points);
    check("an attachment", &mut held.copied(), any);
    check("a pin", &mut compiled.pins.iter().flat_map(|pin| &pin.points).copied(), any);
    for (number, place) in compiled.particles.iter().enumerate() {
        if !place.iter().all(|x| x.is_finite()) {
            flaws.push(Flaw::NotFinite(number));
        }
    }
}

fn check_panel(
    compiled: &Compiled,
    number: usize,
    panel: &MeshPanel,
    flaws: &mut Vec<Flaw>,
) -> Facts {
    let place = |particle: u32| compiled.particles[particle as usize];
    let first = panel.particles.start;
    let mut used = vec![false; panel.particles.range().len()];
    let mut facts = Facts { area: 0.0, smallest_angle: 90.0, sharp: 0 };
    let mut shared: BTreeMap<[u32; 2], i32> = BTreeMap::new();
    let mut add_side = |from: u32, to: u32, flaws: &mut Vec<Flaw>| {
        // +1 for the lower number first, −1 for the other sense; each sense only once.
        let bit = if from < to { 1 } else { 2 };
        let known = shared.entry([from.min(to), from.max(to)]).or_insert(0);
        if *known & bit != 0 {
            flaws.push(Flaw::Side([from, to]));
        }
        *known |= bit;
    };
    for cell in panel.cells.range() {
        let corners = compiled.cells[cell];
        let [i, j] = compiled.lattice[corners[0] as usize];
        let steps = [[0, 0], [1, 0], [1, 1], [0, 1]];
        let origin = place(corners[0]);
        let square = corners.iter().zip(steps).all(|(&corner, step)| {
            let there = place(corner);
            let away =
                |axis: usize| there[axis] - origin[axis] - f64::from(step[axis]) * panel.cell;
            compiled.lattice[corner as usize] == [i.wrapping_add(step[0]), j.wrapping_add(step[1])]
                && away(0).abs().max(away(1).abs()) <= SQUARE * panel.cell
        });
        if !square || i < 0 || j < 0 {
            flaws.push(Flaw::NotSquare(cell));
        }
        facts.area += panel.cell * panel.cell;
        for k in 0..4 {
            used[(corners[k] - first) as usize] = true;
            add_side(corners[k], corners[(k + 1) % 4], flaws);
        }
    }
    let rings: Vec<Vec<Place>> =
        panel.loops.iter().map(|ring| ring.iter().map(|&k| place(k)).collect()).collect();
    let narrow = NarrowCorners::new(&rings);
    for triangle in panel.triangles.range() {
        let corners = compiled.triangles[triangle];
        let [a, b, c] = corners.map(place);
        let double = turn(a, b, c);
        if double <= 0.0 {
            flaws.push(Flaw::TurnedOver(triangle));
        }
        facts.area += double / 2.0;
        let angle = libm::acos(sharpest(a, b, c)).to_degrees();
        facts.smallest_angle = facts.smallest_angle.min(angle);
        facts.sharp += usize::from(narrow.blames([a, b, c]));
        for k in 0..3 {
            used[(corners[k] - first) as usize] = true;
            add_side(corners[k], corners[(k + 1) % 3], flaws);
        }
    }
    let unused = used.iter().enumerate().filter(|(_, used)| !**used);
    flaws.extend(unused.map(|(k, _)| Flaw::Unused(first as usize + k)));
    // The sides that lie on one cell or triangle only are the loops, in their sense.
    let mut rim = 0;
    for ring in &panel.loops {
        for (&from, &to) in ring.iter().zip(ring.iter().cycle().skip(1)) {
            rim += 1;
            let bit = if from < to { 1 } else { 2 };
            if shared.get(&[from.min(to), from.max(to)]) != Some(&bit) {
                flaws.push(Flaw::Side([from, to]));
            }
        }
    }
    let open = shared.values().filter(|&&senses| senses != 3).count();
    if open != rim {
        flaws.push(Flaw::Side([u32::MAX; 2]));
    }
    let faces = panel.cells.range().len() + panel.triangles.range().len();
    let found = used.len() as i64 - shared.len() as i64 + faces as i64;
    let wanted = 2 - panel.loops.len() as i64;
    if found != wanted {
        flaws.push(Flaw::Euler { panel: number, found, wanted });
    }
    let wanted: f64 = rings.iter().map(|ring| signed_area(ring)).sum();
    if (facts.area - wanted).abs() > 2e-6 * wanted {
        flaws.push(Flaw::Area { panel: number, found: facts.area, wanted });
    }
    facts
}
