//! What cannot be cut: panels without an area, too large or too small for their grid.

use super::outline::Outline;
use crate::diagnostic::Diagnostic;
use crate::garment::Garment;
use crate::garment::panel::{Loop, Panel};
use kurbo::ParamCurveArea;

/// Particles of a garment at most.
pub const MOST_PARTICLES: f64 = 4e6;
/// Places in the grid under one panel at most; more are only met by long narrow panels askew to
/// their grain.
const MOST_PLACES: f64 = 4e7;

/// Signed area within a loop, m².
pub fn area(ring: &Loop) -> f64 {
    ring.pieces.iter().flat_map(|piece| piece.path.segments()).map(|s| s.signed_area()).sum()
}

/// Checks all panels against their grids, whose cells have the sides `cell` (m).
///
/// # Errors
/// E0811 too many particles, E0812 smaller than its grid, E0813 no area.
pub fn check(garment: &Garment, outlines: &[Vec<Outline>], cell: &[f64]) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    let mut all = 0.0;
    for ((panel, loops), &cell) in garment.panels.iter().zip(outlines).zip(cell) {
        let area: f64 = panel.loops.iter().map(area).sum();
        let around: f64 = loops.iter().map(|outline| outline.length).sum();
        let [width, height] = extent(panel, loops);
        if !(area > 0.0 && around > 0.0 && (area + around + width + height).is_finite()) {
            found.push(
                Diagnostic::new("E0813", format!("`{}` encloses no cloth", panel.name))
                    .at(panel.span, "this outline has no area")
                    .help("let the outline go round the cloth without folding on to itself"),
            );
            continue;
        }
        if area < 0.5 * cell * cell || width.max(height) < cell {
            found.push(
                Diagnostic::new("E0812", format!("`{}` is smaller than its grid", panel.name))
                    .at(panel.span, format!("its cells are {:.1} mm wide", cell * 1e3))
                    .help(format!("a finer grid, such as `grid: {:.1}mm`", finer(area) * 1e3)),
            );
        }
        let particles = area / (cell * cell) + around / cell;
        let places = (width / cell + 2.0) * (height / cell + 2.0);
        all += particles;
        if particles > MOST_PARTICLES || places > MOST_PLACES {
            let excess = (particles / MOST_PARTICLES).max(places / MOST_PLACES).sqrt();
            found.push(
                Diagnostic::new(
                    "E0811",
                    format!("the grid of `{}` has too many particles", panel.name),
                )
                .at(panel.span, format!("about {particles:.0} of {MOST_PARTICLES:.0}"))
                .help(format!("a coarser grid, such as `grid: {:.1}mm`", cell * excess * 1.1e3)),
            );
        }
    }
    if found.is_empty() && all > MOST_PARTICLES {
        found.push(
            Diagnostic::new("E0811", format!("`{}` has too many particles", garment.name))
                .at(garment.span, format!("about {all:.0} of {MOST_PARTICLES:.0}"))
                .help("give its panels a coarser grid"),
        );
    }
    found
}

/// A cell of which a panel of this area holds about two hundred, m.
fn finer(area: f64) -> f64 {
    (area / 200.0).sqrt()
}

/// Width and height of the box of a panel along weft and warp, m.
fn extent(panel: &Panel, loops: &[Outline]) -> [f64; 2] {
    match loops.first().filter(|_| !panel.loops.is_empty()) {
        Some(outline) => outline.extent(),
        None => [0.0; 2],
    }
}

/// The side of a cell, near `cell`, with which a rectangular panel comes out as whole cells
/// along both sides; `cell` itself where there is none within 5 % or the panel is no rectangle.
pub fn fitting_cell(panel: &Panel, outlines: &[Outline], cell: f64) -> f64 {
    let (Some(ring), Some(_)) = (panel.loops.first(), outlines.first()) else { return cell };
    let [width, height] = extent(panel, outlines);
    let full = width * height;
    let rectangle = full > 0.0 && (area(ring) - full).abs() <= 1e-9 * full;
    let (least, most) = ((width / (cell * 1.05)).ceil(), (width / (cell * 0.95)).floor());
    if !rectangle || most > 1e5 {
        return cell;
    }
    let mut best: Option<f64> = None;
    let mut count = least.max(1.0);
    while count <= most {
        let side = width / count;
        let rows = height / side;
        let nearer = best.is_none_or(|best| (side - cell).abs() < (best - cell).abs());
        if (rows - rows.round()).abs() < 1e-7 && rows >= 0.5 && nearer {
            best = Some(side);
        }
        count += 1.0;
    }
    best.unwrap_or(cell)
}
