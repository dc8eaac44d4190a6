//! Where the knots stand in the lists of the solver: each panel's grid as a block of padded rows, loose
//! knots of the bands after them.

use super::lanes::LANES;
use crate::drape::weld::Weld;
use crate::mesh::compiled::Compiled;
use nalgebra::Vector3;
use std::ops::Range;

/// The grid of a panel, or of a piece of one, as rows of slots. Rows run along the weft, columns along the warp. A row
/// without knots stands before the first and after the last, so that every knot has neighbours to read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Patch {
    /// First slot of the first row.
    pub base: usize,
    /// Rows, the two empty ones included.
    pub rows: usize,
    /// Slots of a row, a multiple of [`LANES`].
    pub stride: usize,
}

/// One row of a patch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// Its first slot.
    pub base: usize,
    /// Slots of it.
    pub stride: usize,
    /// Whether it is its patch's first (empty) row.
    pub first: bool,
    /// Side of its panel's cells, m.
    pub cell: f64,
}

/// Slots of all knots.
#[derive(Clone, Debug, Default)]
pub struct Layout {
    /// Grids, panel by panel.
    pub patches: Vec<Patch>,
    /// All rows, patch by patch; their slots follow each other without gaps.
    pub rows: Vec<Row>,
    /// First slot of the loose knots.
    pub loose: usize,
    /// One past the slot of the last loose knot.
    end: usize,
    /// Slots in all, a guard at both ends included.
    pub slots: usize,
    /// Slot of each knot.
    pub slot: Vec<u32>,
}

impl Layout {
    /// Lays out the knots of a compiled garment. Of several lattice particles that are one knot the
    /// first gives it its place.
    pub fn new(compiled: &Compiled, weld: &Weld) -> Self {
        let mut pieces: Vec<(f64, Piece)> = Vec::new();
        for panel in &compiled.panels {
            let at = |p: usize| (p, compiled.lattice[p]);
            let knots: Vec<(usize, [i32; 2])> =
                panel.particles.range().map(at).filter(|(_, at)| at[0] != i32::MIN).collect();
            if !knots.is_empty() {
                divide(knots, panel.cell, &mut pieces);
            }
        }
        let widest = pieces.iter().map(|p| p.1.stride()).max().unwrap_or(LANES);
        let guard = 2 * widest + LANES;
        let mut layout =
            Layout { slots: guard, slot: vec![u32::MAX; weld.count], ..Layout::default() };
        for (cell, piece) in &pieces {
            let (rows, stride) = (piece.count[1] + 2, piece.stride());
            let patch = Patch { base: layout.slots, rows, stride };
            layout.slots += rows * stride;
            layout.rows.extend((0..rows).map(|r| Row {
                base: patch.base + r * stride,
                stride,
                first: r == 0,
                cell: *cell,
            }));
            for (particle, [i, j]) in &piece.knots {
                let slot = &mut layout.slot[weld.knot[*particle] as usize];
                if *slot == u32::MAX {
                    let (i, j) = (i.abs_diff(piece.low[0]), j.abs_diff(piece.low[1]));
                    *slot = (patch.base + (j as usize + 1) * stride + i as usize) as u32;
                }
            }
            layout.patches.push(patch);
        }
        layout.loose = layout.slots;
        for slot in layout.slot.iter_mut().filter(|s| **s == u32::MAX) {
            *slot = layout.slots as u32;
            layout.slots += 1;
        }
        layout.end = layout.slots;
        layout.slots = layout.slots.next_multiple_of(LANES) + guard;
        layout
    }

    /// Slots of the loose knots.
    pub fn loose_slots(&self) -> Range<usize> {
        self.loose..self.end
    }

    /// Brings vectors of the knots to their slots, in single precision.
    pub fn set(&self, from: &[Vector3<f64>], to: &mut [Vec<f32>; 3]) {
        for (slot, v) in self.slot.iter().zip(from) {
            for k in 0..3 {
                #[allow(clippy::cast_possible_truncation)]
                let value = v[k] as f32;
                to[k][*slot as usize] = value;
            }
        }
    }

    /// The vectors of the knots from their slots.
    pub fn get(&self, from: &[Vec<f32>; 3]) -> Vec<Vector3<f64>> {
        let at = |slot: &u32| Vector3::from_fn(|k, _| f64::from(from[k][*slot as usize]));
        self.slot.iter().map(at).collect()
    }

    /// Number of the row that holds a slot of a patch.
    pub fn row_at(&self, slot: usize) -> usize {
        self.rows.partition_point(|r| r.base <= slot).saturating_sub(1)
    }

    /// Slots of one row of the patch that holds a slot; `None` for loose knots.
    pub fn stride_at(&self, slot: usize) -> Option<usize> {
        let after = self.patches.partition_point(|p| p.base <= slot);
        let patch = self.patches.get(after.checked_sub(1)?)?;
        (slot < patch.base + patch.rows * patch.stride).then_some(patch.stride)
    }
}

/// Particles of a lattice and the rectangle of it that they take.
struct Piece {
    knots: Vec<(usize, [i32; 2])>,
    low: [i32; 2],
    count: [usize; 2],
}

impl Piece {
    fn new(knots: Vec<(usize, [i32; 2])>) -> Self {
        let (mut low, mut high) = ([i32::MAX; 2], [i32::MIN; 2]);
        for (_, at) in &knots {
            for k in 0..2 {
                low[k] = low[k].min(at[k]);
                high[k] = high[k].max(at[k]);
            }
        }
        let count = [0, 1].map(|k| high[k].abs_diff(low[k]) as usize + 1);
        Piece { knots, low, count }
    }

    fn stride(&self) -> usize {
        self.count[0].next_multiple_of(LANES)
    }
}

/// Slots for each knot from which a rectangle is too empty to be kept whole.
const EMPTY: usize = 3;

/// Longest side of a rectangle that is kept whole however empty it is.
const SHORT: usize = 4 * LANES;

/// Halves the rectangle of some particles until its parts are fairly full: a long narrow panel
/// askew to its grain would otherwise fill the memory with slots of nothing.
fn divide(knots: Vec<(usize, [i32; 2])>, cell: f64, pieces: &mut Vec<(f64, Piece)>) {
    let piece = Piece::new(knots);
    let longest = usize::from(piece.count[1] > piece.count[0]);
    let full = piece.stride() * piece.count[1] <= EMPTY * piece.knots.len();
    if full || piece.count[longest] <= SHORT {
        pieces.push((cell, piece));
        return;
    }
    let half = piece.count[longest] as u32 / 2;
    let (low, high): (Vec<_>, Vec<_>) = piece
        .knots
        .into_iter()
        .partition(|(_, at)| at[longest].abs_diff(piece.low[longest]) < half);
    for part in [low, high] {
        divide(part, cell, pieces);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drape::swatch::{fabric, rectangles};

    /// A strip of 10 × 1000 cells that runs askew through its lattice: the rectangle round it has
    /// a hundred places for each of its knots, the slots are few for each.
    #[test]
    fn a_strip_askew_takes_few_slots() {
        let mut compiled = rectangles(1, [9, 999], 0.01, fabric(1e-5));
        for [i, j] in &mut compiled.lattice {
            *i += *j;
        }
        let weld = Weld::new(compiled.particles.len(), std::iter::empty());
        let layout = Layout::new(&compiled, &weld);
        assert!(layout.slots < 12 * weld.count, "{}", layout.slots);
        let mut slots = layout.slot.clone();
        slots.sort_unstable();
        slots.dedup();
        assert_eq!(slots.len(), weld.count);
    }
}
