//! The cantilever test (ISO 9073-7, ASTM D1388 option A): a strip is pushed over an edge until its
//! tip is seen at 41.5° below it. Half the overhang is the bending length c, and G = W g c³ the
//! flexural rigidity (Peirce 1930).
//!
//! At 41.5° the heavy elastica θ'' = −Γ (1 − s) cos θ, Γ = W g L³ / B, has Γ = 8.004: that c is half
//! the overhang is exact to 0.02 %, and G is the cloth's B.

use super::{Failure, Hung};
use crate::progress::Progress;
use crate::textile::fabric::Fabric;
use crate::textile::fast;
use serde::Serialize;

/// Angle of the slope below the edge.
pub const SLOPE: f64 = 41.5;

/// Width of the strip, m.
const WIDTH: f64 = 0.025;

/// Cells of the overhang where nothing else is asked for: the droop is then right to half a percent.
const CELLS: usize = 20;

/// Rows of cells that are held. The cloth is clamped in the middle of the last one: the turn at
/// the last row of held knots stands for the curvature of half a cell on either side of it.
const HELD: usize = 2;

/// Overhangs that are tried at most, and how near the tip must come to the slope, degrees.
const TRIALS: usize = 8;
const NEAR: f64 = 0.03;

/// Degrees by which the tip sinks when the overhang grows by the factor e, near the slope (from
/// the elastica: 30.36° at Γ = 5, 46.85° at Γ = 10).
const SINKS: f64 = 71.4;

/// Overhangs for which the apparatus is built, m.
const OVERHANGS: std::ops::RangeInclusive<f64> = 0.005..=1.0;

/// Along which threads a strip is cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
#[allow(missing_docs)]
pub enum Direction {
    Warp,
    Weft,
}

/// What is read off one strip.
#[derive(Clone, Debug, Serialize)]
pub struct Reading {
    /// Along which threads it was cut.
    pub direction: Direction,
    /// Length over the edge when the tip touches the slope, m.
    pub overhang: f64,
    /// Half the overhang, m.
    pub bending_length: f64,
    /// Flexural rigidity W g c³, N·m.
    pub rigidity: f64,
    /// What the fabric was given, N·m.
    pub given: f64,
    /// Overhangs that were tried.
    pub trials: usize,
    /// Side of a cell, m.
    pub cell: f64,
}

/// Tests a strip cut along `direction`, with cells of about `cell`, m, where that is asked for.
///
/// # Errors
/// A fabric for which the apparatus is not built; a strip that does not come to rest.
pub fn test(
    fabric: &Fabric,
    direction: Direction,
    cell: Option<f64>,
    progress: &mut dyn Progress,
) -> Result<(Reading, Hung), Failure> {
    let given = match direction {
        Direction::Warp => fabric.bending[0],
        Direction::Weft => fabric.bending[1],
    };
    // A first guess, as an operator has one; the strip itself has the last word.
    let mut overhang = 2.0 * fast::bending_length(fabric.mass, given);
    let mut last: Option<(f64, f64)> = None;
    for trials in 1..=TRIALS {
        if !OVERHANGS.contains(&overhang) {
            return Err(Failure::Unfit(format!(
                "the tip would reach the slope at an overhang of {}; the apparatus takes 5 mm to 1 m",
                crate::units::length(overhang)
            )));
        }
        let cells = cell
            .map_or(CELLS, |cell| libm::round(overhang / cell - 0.5).clamp(4.0, 400.0) as usize);
        let (angle, hung, side) = sink(fabric, direction, overhang, cells, progress)?;
        let off = SLOPE - angle;
        // By the elastica first, then by the line through the last two.
        let here = libm::log(overhang);
        let slope = match last {
            Some((there, then)) if (here - there).abs() > 1e-9 => (angle - then) / (here - there),
            _ => SINKS,
        };
        last = Some((here, angle));
        let slope = slope.clamp(0.3 * SINKS, 3.0 * SINKS);
        overhang *= libm::exp((off / slope).clamp(-0.5, 0.5));
        if off.abs() <= NEAR {
            let bending_length = overhang / 2.0;
            let rigidity = fast::rigidity(fabric.mass, bending_length);
            let reading = Reading {
                direction,
                overhang,
                bending_length,
                rigidity,
                given,
                trials,
                cell: side,
            };
            return Ok((reading, hung));
        }
    }
    Err(Failure::Unfit("the tip does not come to rest at the slope".to_owned()))
}

/// The angle, degrees, at which the tip of a strip is seen from the edge over which it hangs.
fn sink(
    fabric: &Fabric,
    direction: Direction,
    overhang: f64,
    cells: usize,
    progress: &mut dyn Progress,
) -> Result<(f64, Hung, f64), Failure> {
    let side = overhang / (cells as f64 + 0.5);
    let along = cells + HELD;
    let across = libm::round(WIDTH / side).clamp(2.0, 400.0) as usize;
    let [columns, rows] = match direction {
        Direction::Warp => [across, along],
        Direction::Weft => [along, across],
    };
    let text = format!(
        "scene cantilever {{
            cloth strip of cotton {{
                size: {:.9}m x {:.9}m   grid: {columns} x {rows}   at: (0m, 1m, 0m)   facing: up
            }}
            drape {{ settle until speed < 0.2mm/s within 30s }}
        }}",
        side * columns as f64,
        side * rows as f64,
    );
    let axis = match direction {
        Direction::Warp => 1,
        Direction::Weft => 0,
    };
    let start = -side * along as f64 / 2.0;
    let hung = Hung::new(
        &text,
        fabric,
        |flat| flat[axis] <= start + (HELD as f64 + 0.1) * side,
        progress,
    )?;
    let held = hung.middle(|flat| flat[axis] <= start + 0.1 * side);
    let tip = hung.middle(|flat| flat[axis] >= -start - 0.1 * side);
    let reach = (tip.x - held.x).abs().max((tip.z - held.z).abs()) - (HELD as f64 - 0.5) * side;
    Ok((libm::atan2(held.y - tip.y, reach).to_degrees(), hung, side))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laboratory::specimen::library;
    use crate::progress::Quiet;

    #[test]
    fn the_rigidity_of_the_fabric_comes_back_along_warp_and_weft() {
        let wool = library("wool");
        for (direction, given) in [(Direction::Warp, 0), (Direction::Weft, 1)] {
            let (it, _) = test(&wool, direction, None, &mut Quiet).expect("a result");
            println!("{it:?}");
            // c = L / 2 is exact to 0.02 %, 20 cells of overhang to half a percent of the droop.
            assert!((it.rigidity / wool.bending[given] - 1.0).abs() < 0.015, "{it:?}");
            assert!((it.rigidity - wool.mass * 9.80665 * it.overhang.powi(3) / 8.0).abs() < 1e-12);
        }
    }

    #[test]
    fn a_board_is_no_cloth_for_the_apparatus() {
        let board = Fabric { bending: [0.1; 2], mass: 0.01, ..library("wool") };
        assert!(matches!(
            test(&board, Direction::Warp, None, &mut Quiet),
            Err(Failure::Unfit(why)) if why.contains("apparatus")
        ));
    }
}
