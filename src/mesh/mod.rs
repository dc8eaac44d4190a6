//! Garment to cloth: [`compile`] cuts every panel into a regular grid of particles aligned with
//! warp and weft, a triangulated band along its edges, matched seams, and the texture atlas.
//!
//! The order of work: cut lines are measured ([`outline`]); places where a particle must lie are
//! collected ([`breakpoint`]) and carried through the seams ([`matching`]); every stretch between
//! them gets its count of steps ([`spacing`]); then each panel is cut by itself ([`panel`]):
//! its grid ([`lattice`]), the band along its edges ([`band`], [`triangulation`], [`improve`]).

pub mod atlas;
pub mod band;
pub mod breakpoint;
pub mod compiled;
pub mod improve;
pub mod json;
pub mod lattice;
pub mod limit;
pub mod matching;
pub mod outline;
pub mod panel;
pub mod sharpness;
pub mod spacing;
pub mod triangulation;
pub mod validate;

use crate::diagnostic::Diagnostic;
use crate::garment::Garment;
use crate::garment::panel::Run;
use crate::garment::seam::{PanelRun, Pinned};
use crate::geometry::polygon::{Place, distance};
use breakpoint::{Rings, Walk};
use compiled::{Compiled, MeshAttachment, MeshEdge, MeshPanel, MeshPin, MeshSeam, Stretch};
use matching::{Classes, Match, Side, carry_breaks, points_of};
use outline::{Grain, Outline, outlines};
use panel::Cloth;
use rayon::prelude::*;
use spacing::{Address, Spacing};

/// The side of a grid cell where nothing else is asked for, m.
pub const DEFAULT_CELL: f64 = 8e-3;
/// No cell is smaller, m.
const FINEST_CELL: f64 = 1e-5;
/// Breakpoints of sewing partners this near to each other are sewn to each other, in cells.
const REACH: f64 = 0.15;
/// How often steps may be shortened until every panel comes out well.
const ROUNDS: usize = 6;

/// How to compile.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Side of the grid cells of all panels, m, whatever the text asks for.
    pub cell: Option<f64>,
    /// Factor on the sides of all cells. More than 1 gives a coarser cloth of the same garment,
    /// from which a drape may start; it comes without the picture of its textiles.
    pub coarsen: f64,
}

impl Default for Options {
    fn default() -> Self {
        Options { cell: None, coarsen: 1.0 }
    }
}

/// Cuts a garment.
///
/// # Errors
/// E0811 too many particles, E0812 a panel smaller than its grid, E0813 an outline without an
/// area or nearer to itself than its points, E0814 seams that cannot be matched.
pub fn compile(garment: &Garment, options: &Options) -> Result<Compiled, Vec<Diagnostic>> {
    let outlines: Vec<Vec<Outline>> = garment.panels.par_iter().map(outlines).collect();
    let cells: Vec<f64> = garment
        .panels
        .iter()
        .zip(&outlines)
        .map(|(panel, loops)| {
            let asked = options.cell.or(panel.cell).unwrap_or(DEFAULT_CELL) * options.coarsen;
            let asked = if asked.is_finite() { asked.max(FINEST_CELL) } else { DEFAULT_CELL };
            limit::fitting_cell(panel, loops, asked)
        })
        .collect();
    let found = limit::check(garment, &outlines, &cells);
    if !found.is_empty() {
        return Err(found);
    }
    let plan = Plan::new(garment, &outlines, &cells)?;
    let (spacing, cloths) = plan.cut(garment, &outlines, &cells)?;
    let mut compiled = assemble(garment, &plan, &spacing, &cells, cloths);
    if options.coarsen <= 1.0 {
        atlas::draw(garment, &mut compiled);
    }
    Ok(compiled)
}

/// Breakpoints and walks of everything that runs along the cut lines.
struct Plan {
    rings: Rings,
    seams: Vec<Option<Match>>,
    attachments: Vec<Vec<Walk>>,
    pins: Vec<Vec<Walk>>,
    /// By panel and edge.
    edges: Vec<Vec<Vec<Walk>>>,
    classes: Classes,
}

fn runs(list: &[PanelRun]) -> impl Iterator<Item = (usize, Run)> + '_ {
    list.iter().map(|on| (on.panel, on.run))
}

impl Plan {
    fn new(
        garment: &Garment,
        outlines: &[Vec<Outline>],
        cells: &[f64],
    ) -> Result<Self, Vec<Diagnostic>> {
        let mut rings = Rings::new(outlines);
        let sewn: Vec<[Vec<Walk>; 2]> = garment
            .seams
            .iter()
            .map(|seam| [&seam.a, &seam.b].map(|side| rings.walks(outlines, runs(side))))
            .collect();
        let held = garment.attachments.iter().map(|held| rings.walks(outlines, runs(&held.runs)));
        let attachments = held.collect();
        let pins = garment.pins.iter().map(|pin| match &pin.what {
            Pinned::Runs(list) => rings.walks(outlines, runs(list)),
            Pinned::Point { .. } => Vec::new(),
        });
        let pins = pins.collect();
        let mut edges = Vec::new();
        for (number, panel) in garment.panels.iter().enumerate() {
            let walks = panel
                .edges
                .iter()
                .map(|edge| rings.walks(outlines, edge.runs.iter().map(|run| (number, *run))));
            edges.push(walks.collect());
        }
        let mut seams: Vec<Option<Match>> =
            sewn.into_iter().map(|[a, b]| Match::new(Side::new(a), Side::new(b))).collect();
        let reach = |number: usize| {
            let seam = garment.seams.get(number);
            let sides = seam.map(|seam| seam.a.iter().chain(&seam.b)).into_iter().flatten();
            let panels = sides.filter_map(|on| cells.get(on.panel));
            REACH * panels.copied().fold(f64::INFINITY, f64::min)
        };
        carry_breaks(&mut rings, &mut seams, reach).map_err(|numbers| {
            let seams = numbers.iter().filter_map(|&number| garment.seams.get(number));
            let said = seams.map(|seam| {
                Diagnostic::new("E0814", format!("the points of `{}` cannot be matched", seam.name))
                    .at(seam.span, "its sides share edges so that their points never come to rest")
                    .help("sew edges that do not overlap each other")
            });
            said.collect::<Vec<_>>()
        })?;
        let classes = Classes::new(&rings, &seams);
        Ok(Plan { rings, seams, attachments, pins, edges, classes })
    }

    /// The cut lines of one panel as points, and their addresses.
    fn lines(
        &self,
        panel: usize,
        outlines: &[Outline],
        spacing: &Spacing,
    ) -> (Vec<Vec<Place>>, Vec<Address>) {
        let mut lines = Vec::new();
        let mut addresses = Vec::new();
        for (number, outline) in outlines.iter().enumerate() {
            if let Some(ring) = self.rings.number(panel, number) {
                let (places, mut of_ring) =
                    spacing::points(ring, &self.rings, &self.classes, spacing, outline);
                lines.push(places);
                addresses.append(&mut of_ring);
            }
        }
        (lines, addresses)
    }

    fn class(&self, (ring, interval, _): Address) -> usize {
        self.classes.class[self.classes.first[ring] + interval]
    }

    /// Chooses the steps and cuts all panels, with shorter steps where the cloth asks for them.
    fn cut(
        &self,
        garment: &Garment,
        outlines: &[Vec<Outline>],
        cells: &[f64],
    ) -> Result<(Spacing, Vec<Cloth>), Vec<Diagnostic>> {
        let mut spacing = Spacing::new(&self.rings, &self.classes, outlines, cells);
        let mut cloths: Vec<Option<Cloth>> = vec![None; garment.panels.len()];
        let mut lines: Vec<(Vec<Vec<Place>>, Vec<Address>)> = Vec::new();
        for round in 0..=ROUNDS {
            let drawn: Vec<_> = outlines
                .par_iter()
                .enumerate()
                .map(|(panel, loops)| self.lines(panel, loops, &spacing))
                .collect();
            // Panels whose lines stay as they were keep their cloth.
            let same = |panel: usize| lines.get(panel).is_some_and(|old| *old == drawn[panel]);
            let results: Vec<(Option<Cloth>, Vec<(usize, f64)>)> = (0..drawn.len())
                .into_par_iter()
                .map(|panel| match &cloths[panel] {
                    Some(cloth) if same(panel) => (Some(cloth.clone()), Vec::new()),
                    _ => try_cut(&drawn[panel].0, cells[panel], round == ROUNDS),
                })
                .collect();
            let mut shorter: Vec<(usize, f64)> = Vec::new();
            for (panel, (cloth, faults)) in results.into_iter().enumerate() {
                cloths[panel] = cloth;
                let addresses = &drawn[panel].1;
                let asked = faults.into_iter().filter_map(|(point, factor)| {
                    addresses.get(point).map(|&address| (self.class(address), factor))
                });
                shorter.extend(asked);
            }
            lines = drawn;
            if shorter.is_empty() || round == ROUNDS {
                break;
            }
            shorter.sort_by(|a, b| a.0.cmp(&b.0).then(b.1.total_cmp(&a.1)));
            shorter.dedup_by_key(|asked| asked.0);
            for (class, factor) in shorter {
                spacing.refine(class, factor);
            }
        }
        let missing = garment.panels.iter().zip(&cloths).filter(|(_, cloth)| cloth.is_none());
        let said: Vec<Diagnostic> = missing
            .map(|(panel, _)| {
                let message = format!("the outline of `{}` comes too near to itself", panel.name);
                Diagnostic::new("E0813", message)
                    .at(panel.span, "no grid fits between its lines")
                    .help("keep lines of one panel apart, or use a finer `grid`")
            })
            .collect();
        if said.is_empty() {
            Ok((spacing, cloths.into_iter().flatten().collect()))
        } else {
            Err(said)
        }
    }
}

/// Cuts a panel, or tells which steps of its lines, by the point where they begin, should be
/// shorter and by how much. The last time it is cut as it is.
fn try_cut(lines: &[Vec<Place>], cell: f64, last: bool) -> (Option<Cloth>, Vec<(usize, f64)>) {
    let faults = spacing::faults(lines);
    let mut asked: Vec<(usize, f64)> = faults.slender;
    asked.extend(faults.crossing.iter().map(|&point| (point, 2.0)));
    if !last && !asked.is_empty() {
        return (None, asked);
    }
    if !faults.crossing.is_empty() {
        return (None, Vec::new());
    }
    let cloth = panel::cut(lines, cell);
    let asked = match &cloth {
        Some(cloth) => cloth.sharp.iter().map(|&point| (point, 1.3)).collect(),
        None => Vec::new(),
    };
    (cloth, asked)
}

fn assemble(
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
    compiled.fabrics = garment.fabrics.clone();
    compiled.bodies = garment.bodies.clone();
    compiled.solids = garment.solids.clone();
    compiled.schedule = garment.schedule.clone();
    compiled.pictures = garment.pictures.clone();
    compiled
}

/// The particle of a panel nearest to a place of its drawing.
fn nearest(garment: &Garment, compiled: &Compiled, panel: usize, at: Place) -> Option<u32> {
    let place = Grain::new(garment.panels.get(panel)?.grain).to_cloth(at);
    let range = compiled.panels.get(panel)?.particles.range();
    range
        .min_by(|&a, &b| {
            let away = |k: usize| distance(compiled.particles[k], place);
            away(a).total_cmp(&away(b))
        })
        .map(|k| k as u32)
}
