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
    let mut laid = Laid::new(garment, options)?;
    let cloths = cut(&mut laid, garment)?;
    let Laid { cells, plan, spacing, .. } = &laid;
    let mut compiled = assemble::assemble(garment, plan, spacing, cells, cloths);
    stitch::stitches(garment, &mut compiled);
    compiled.bands = doubled::bands(garment, &compiled);
    compiled.shut = shut::folds(garment, &compiled);
    compiled.creases = crease::creases(garment, &compiled);
    if options.atlas {
        atlas::draw(garment, &mut compiled);
    }
    Ok(compiled)
}

/// Looks for what is wrong with a garment when it is cut, without cutting it: what [`compile`]
/// refuses shows in the points along the cut lines. Only where these come too near to each other
/// is the garment cut, to see whether shorter steps keep them apart.
///
/// # Errors
/// Those of [`compile`].
pub fn examine(garment: &Garment) -> Result<(), Vec<Diagnostic>> {
    let options = Options { atlas: false, ..Options::default() };
    let laid = Laid::new(garment, &options)?;
    let crossing = |lines: &Lines| !spacing::faults(&lines.0).crossing.is_empty();
    if laid.lines.par_iter().any(crossing) { compile(garment, &options).map(drop) } else { Ok(()) }
}

/// The points along the cut lines of a panel, ring by ring, and their addresses.
type Lines = (Vec<Vec<Place>>, Vec<Address>);

/// A garment before it is cut: its cut lines measured, and the points chosen along them.
struct Laid {
    /// By panel and loop.
    outlines: Vec<Vec<Outline>>,
    /// The side of a grid cell of each panel, m.
    cells: Vec<f64>,
    plan: Plan,
    spacing: Spacing,
    /// By panel.
    lines: Vec<Lines>,
}

impl Laid {
    fn new(garment: &Garment, options: &Options) -> Result<Laid, Vec<Diagnostic>> {
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
        let spacing = Spacing::new(&plan.rings, &plan.classes, &outlines, &cells);
        let mut laid = Laid { outlines, cells, plan, spacing, lines: Vec::new() };
        laid.lines = laid.drawn();
        let found = stitch::holes(garment, &laid.lines, &laid.cells);
        if found.is_empty() { Ok(laid) } else { Err(found) }
    }

    /// The points along all cut lines with the steps as they are.
    fn drawn(&self) -> Vec<Lines> {
        let panels = self.outlines.par_iter().enumerate();
        panels.map(|(panel, loops)| self.plan.lines(panel, loops, &self.spacing)).collect()
    }
}

/// Cuts all panels, with shorter steps where the cloth asks for them.
fn cut(laid: &mut Laid, garment: &Garment) -> Result<Vec<Cloth>, Vec<Diagnostic>> {
    let mut cloths: Vec<Option<Cloth>> = vec![None; garment.panels.len()];
    // Panels whose lines stay as they were keep their cloth.
    let mut same = vec![false; garment.panels.len()];
    let mut last = false;
    for round in 1.. {
        let (lines, cells) = (&laid.lines, &laid.cells);
        let results: Vec<(Option<Cloth>, Vec<(usize, f64)>)> = (0..lines.len())
            .into_par_iter()
            .map(|panel| match &cloths[panel] {
                Some(cloth) if same[panel] => (Some(cloth.clone()), Vec::new()),
                _ => try_cut(&garment.panels[panel], &lines[panel].0, cells[panel], last),
            })
            .collect();
        let mut shorter: Vec<(usize, f64)> = Vec::new();
        for (panel, (cloth, faults)) in results.into_iter().enumerate() {
            cloths[panel] = cloth;
            let addresses = &lines[panel].1;
            let asked = faults.into_iter().filter_map(|(point, factor)| {
                addresses.get(point).map(|&address| (laid.plan.class(address), factor))
            });
            shorter.extend(asked);
        }
        if shorter.is_empty() || last {
            break;
        }
        shorter.sort_by(|a, b| a.0.cmp(&b.0).then(b.1.total_cmp(&a.1)));
        shorter.dedup_by_key(|asked| asked.0);
        let mut changed = false;
        for (class, factor) in shorter {
            changed |= laid.spacing.refine(class, factor);
        }
        last = !changed || round == ROUNDS;
        let drawn = laid.drawn();
        same = drawn.iter().zip(&laid.lines).map(|(new, old)| new == old).collect();
        laid.lines = drawn;
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
    if said.is_empty() { Ok(cloths.into_iter().flatten().collect()) } else { Err(said) }
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
