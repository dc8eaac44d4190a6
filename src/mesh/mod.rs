//! Garment to cloth: [`compile`] cuts every panel into a regular grid of particles aligned with
//! warp and weft, a triangulated band along its edges, matched seams, and the texture atlas.
//!
//! The order of work: cut lines are measured ([`outline`]); places where a particle must lie are
//! collected ([`breakpoint`]) and carried through the seams ([`matching`]); every stretch between
//! them gets its count of steps ([`spacing`], [`grading`]); then each panel is cut by itself ([`panel`]):
//! its grid ([`lattice`]), the band along its edges ([`band`], [`triangulation`], [`improve`]).

pub mod assemble;
pub mod atlas;
pub mod band;
pub mod breakpoint;
pub mod compiled;
pub mod cord;
pub mod crease;
pub mod doubled;
pub mod grading;
pub mod improve;
pub mod json;
pub mod lattice;
pub mod limit;
pub mod locate;
pub mod matching;
pub mod outline;
pub mod panel;
pub mod patch;
pub mod plan;
pub mod sharpness;
pub mod shut;
pub mod spacing;
pub mod stitch;
pub mod triangulation;
pub mod validate;

use crate::diagnostic::Diagnostic;
use crate::garment::Garment;
use crate::garment::panel::{Loop, Panel};
use crate::geometry::crossing::first_crossing;
use crate::geometry::polygon::Place;
use compiled::Compiled;
use outline::{Outline, outlines};
use panel::Cloth;
use plan::Plan;
use rayon::prelude::*;
use spacing::{Address, Spacing};

/// The side of a grid cell where nothing else is asked for, m.
pub const DEFAULT_CELL: f64 = 8e-3;
/// No cell is smaller, m.
const FINEST_CELL: f64 = 1e-5;
/// How often steps may be shortened until every panel comes out well.
const ROUNDS: usize = 4;

/// How to compile.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Side of the grid cells of all panels, m, whatever the text asks for.
    pub cell: Option<f64>,
    /// Factor on the sides of all cells. More than 1 gives a coarser cloth of the same garment,
    /// from which a drape may start.
    pub coarsen: f64,
    /// Whether the picture of the textiles is drawn too. It takes longer than all the rest.
    pub atlas: bool,
}

impl Default for Options {
    fn default() -> Self {
        Options { cell: None, coarsen: 1.0, atlas: true }
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
    let (spacing, cloths) = cut(&plan, garment, &outlines, &cells)?;
    let mut compiled = assemble::assemble(garment, &plan, &spacing, &cells, cloths);
    stitch::stitches(garment, &mut compiled)?;
    compiled.bands = doubled::bands(garment, &compiled);
    compiled.shut = shut::folds(garment, &compiled);
    compiled.creases = crease::creases(garment, &compiled);
    if options.atlas {
        atlas::draw(garment, &mut compiled);
    }
    Ok(compiled)
}

/// Chooses the steps and cuts all panels, with shorter steps where the cloth asks for them.
fn cut(
    plan: &Plan,
    garment: &Garment,
    outlines: &[Vec<Outline>],
    cells: &[f64],
) -> Result<(Spacing, Vec<Cloth>), Vec<Diagnostic>> {
    let mut spacing = Spacing::new(&plan.rings, &plan.classes, outlines, cells);
    let mut cloths: Vec<Option<Cloth>> = vec![None; garment.panels.len()];
    let mut lines: Vec<(Vec<Vec<Place>>, Vec<Address>)> = Vec::new();
    let mut last = false;
    for round in 1.. {
        let drawn: Vec<_> = outlines
            .par_iter()
            .enumerate()
            .map(|(panel, loops)| plan.lines(panel, loops, &spacing))
            .collect();
        // Panels whose lines stay as they were keep their cloth.
        let same = |panel: usize| lines.get(panel).is_some_and(|old| *old == drawn[panel]);
        let results: Vec<(Option<Cloth>, Vec<(usize, f64)>)> = (0..drawn.len())
            .into_par_iter()
            .map(|panel| match &cloths[panel] {
                Some(cloth) if same(panel) => (Some(cloth.clone()), Vec::new()),
                _ => try_cut(&garment.panels[panel], &drawn[panel].0, cells[panel], last),
            })
            .collect();
        let mut shorter: Vec<(usize, f64)> = Vec::new();
        for (panel, (cloth, faults)) in results.into_iter().enumerate() {
            cloths[panel] = cloth;
            let addresses = &drawn[panel].1;
            let asked = faults.into_iter().filter_map(|(point, factor)| {
                addresses.get(point).map(|&address| (plan.class(address), factor))
            });
            shorter.extend(asked);
        }
        lines = drawn;
        if shorter.is_empty() || last {
            break;
        }
        shorter.sort_by(|a, b| a.0.cmp(&b.0).then(b.1.total_cmp(&a.1)));
        shorter.dedup_by_key(|asked| asked.0);
        let mut changed = false;
        for (class, factor) in shorter {
            changed |= spacing.refine(class, factor);
        }
        last = !changed || round == ROUNDS;
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
    if said.is_empty() { Ok((spacing, cloths.into_iter().flatten().collect())) } else { Err(said) }
}

/// Cuts a panel, or tells which steps of its lines, by the point where they begin, should be
/// shorter and by how much. The last time it is cut as it is.
fn try_cut(
    panel: &Panel,
    lines: &[Vec<Place>],
    cell: f64,
    last: bool,
) -> (Option<Cloth>, Vec<(usize, f64)>) {
    let faults = spacing::faults(lines);
    if !faults.crossing.is_empty() {
        let paths = |ring: &Loop| ring.pieces.iter().map(|piece| piece.path.clone()).collect();
        let loops: Vec<Vec<_>> = panel.loops.iter().map(paths).collect();
        if last || first_crossing(&loops).is_some() {
            return (None, Vec::new());
        }
    }
    let mut asked: Vec<(usize, f64)> = faults.slender;
    asked.extend(faults.crossing.iter().map(|&point| (point, 2.0)));
    if !last && !asked.is_empty() {
        return (None, asked);
    }
    let cloth = panel::cut(lines, cell);
    let asked = match &cloth {
        Some(cloth) => cloth.sharp.iter().map(|&point| (point, 1.3)).collect(),
        None => Vec::new(),
    };
    (cloth, asked)
}
