//! Grading: steps along a cut line grow by degrees beside a short stretch.
//!
//! Where a short piece stands between long ones, steps of a whole cell beside it would leave
//! needles in the cloth. Breakpoints are added beside it at growing distances.

use super::breakpoint::Rings;
use super::matching::{Classes, Match, carry_breaks};
use super::outline::Outline;
use super::spacing::Spacing;

/// Steps may be this many times as long as their neighbours.
const JUMP: f64 = 2.2;
/// From a short step to the next breakpoint, in lengths of the short step.
const GROWTH: f64 = 1.6;
/// Steps longer than this need no grading, in cells.
const LONG: f64 = 0.5;
/// From a tenth of a millimetre to half a cell of a centimetre in steps of [`GROWTH`], and some.
const ROUNDS: usize = 12;

/// Adds breakpoints until steps beside each other are of like length, and carries them through
/// the seams. `cell` are the sides of the panels' cells, m.
///
/// # Errors
/// Numbers of the seams that cannot be matched.
pub fn grade(
    rings: &mut Rings,
    seams: &mut [Option<Match>],
    outlines: &[Vec<Outline>],
    cell: &[f64],
) -> Result<Classes, Vec<usize>> {
    for _ in 0..ROUNDS {
        let classes = Classes::new(rings, seams);
        let spacing = Spacing::new(rings, &classes, outlines, cell);
        let mut added = false;
        for number in 0..rings.rings.len() {
            let ring = &rings.rings[number];
            let count = ring.breaks.len();
            let step = |interval: usize| {
                let (from, to) = ring.interval(interval);
                let class = classes.class[classes.first[number] + interval];
                (to - from) / spacing.steps(class).max(1) as f64
            };
            let mut wanted = Vec::new();
            for interval in (0..count).filter(|_| count > 1) {
                let short = step(interval);
                if short > LONG * cell[ring.panel] {
                    continue;
                }
                let beside = |neighbour: usize| {
                    let (from, to) = ring.interval(neighbour);
                    let way = (GROWTH * short).min((to - from) / 2.0);
                    (step(neighbour) > JUMP * short).then_some((from, to, way))
                };
                wanted.extend(beside((interval + 1) % count).map(|(from, _, way)| from + way));
                wanted.extend(beside((interval + count - 1) % count).map(|(_, to, way)| to - way));
            }
            let ring = &mut rings.rings[number];
            for arc in wanted {
                let before = ring.breaks.len();
                ring.settle(arc);
                added |= ring.breaks.len() > before;
            }
        }
        if !added {
            return Ok(classes);
        }
        // Graded points are met by images of their own, not by others near by.
        carry_breaks(rings, seams, |_| 0.0)?;
    }
    Ok(Classes::new(rings, seams))
}
