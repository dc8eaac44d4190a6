//! The regular part of a cloth: springs, shearing cells and bending lines on the grids of the
//! panels, with the same arithmetic for every slot, row after row.
//!
//! Where an element of the cloth joins knots that stand beside each other in one grid it is kept here as a
//! number at its slot; everything else (bands, seams, folds across them) is left to the rim.

pub mod assemble;
pub mod lanes;
pub mod layout;
pub mod product;
pub mod strips;
pub mod thread;

use crate::drape::cloth::Cloth;
use lanes::LANES;
use layout::Layout;
use std::ops::Range;

/// Numbers of the stiffness at each slot: weft edge m (3) and b, warp edge m (3) and b, the cell's two
/// diagonals (3 + 3) and what holds each of them in every direction (2).
pub const STIFF: usize = 16;

/// Numbers of a symmetric block: xx, xy, xz, yy, yz, zz.
pub const BLOCK: usize = 6;

/// Rows worked on together; a weft thread of each is one lane.
pub const GROUP: usize = LANES;

/// Rows of one patch that are worked on together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Group {
    /// First of them in the layout's list.
    pub row: usize,
    /// How many, at most [`GROUP`].
    pub rows: usize,
    /// First slot.
    pub base: usize,
    /// Slots of a row.
    pub stride: usize,
    /// Number of the patch's first block of columns.
    pub block: usize,
    /// Rows of the patch before these.
    pub within: usize,
}

/// Columns of one patch that are worked on together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Block {
    /// Slot of the first of them in the first row.
    pub base: usize,
    /// Rows.
    pub rows: usize,
    /// Slots of a row.
    pub stride: usize,
    /// Where its numbers begin in a list by columns, as a number of slots.
    pub first: usize,
}

/// Rows that one thread works on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    /// Their groups.
    pub groups: Range<usize>,
    /// Their numbers.
    pub rows: Range<usize>,
    /// Their slots.
    pub slots: Range<usize>,
}

/// Columns that one thread works on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Columns {
    /// Their blocks.
    pub blocks: Range<usize>,
    /// Rows of all blocks up to the last of these.
    pub end: usize,
}

/// The regular part of a cloth.
#[derive(Clone, Debug, Default)]
pub struct Grid {
    /// Where the knots stand.
    pub layout: Layout,
    /// Groups of rows, in the order of the slots.
    pub groups: Vec<Group>,
    /// Blocks of columns.
    pub blocks: Vec<Block>,
    /// First slot of all rows.
    pub start: usize,
    /// The rows, shared out among the threads.
    pub parts: Vec<Part>,
    /// The columns, shared out among the threads.
    pub columns: Vec<Columns>,
    /// Stiffness of the weft edge from each slot to the next, N/m.
    weft: Vec<f32>,
    /// Stiffness of the warp edge from each slot to the one above, N/m.
    warp: Vec<f32>,
    /// Shear stiffness of the cell above and to the right of each slot, N/m.
    shear: Vec<f32>,
    /// Bending along the weft at each slot, N/m.
    bend_weft: Vec<f32>,
    /// Bending along the warp at each slot, N/m.
    bend_warp: Vec<f32>,
    /// Twist of the cell above and to the right, N/m.
    twist: Vec<f32>,
    /// What bending and twist put on the diagonal, N/m.
    bend_own: Vec<f32>,
    /// Stiffness of the step, [`STIFF`] numbers a slot in chunks of [`LANES`] slots.
    pub stiff: Vec<f32>,
    /// Diagonal blocks of the step, [`BLOCK`] numbers a slot in chunks of [`LANES`] slots.
    pub diagonal: Vec<f32>,
}

/// Which elements of a cloth the grid has taken up.
#[derive(Clone, Debug, Default)]
pub struct Taken {
    /// Springs.
    pub springs: Vec<bool>,
    /// Cells.
    pub cells: Vec<bool>,
    /// Terms of bending.
    pub folds: Vec<bool>,
}

impl Grid {
    /// Takes up what is regular of a cloth.
    #[allow(clippy::cast_possible_truncation)]
    pub fn new(layout: Layout, cloth: &Cloth) -> (Self, Taken) {
        let n = layout.slots;
        let mut grid = Grid {
            weft: vec![0.0; n],
            warp: vec![0.0; n],
            shear: vec![0.0; n],
            bend_weft: vec![0.0; n],
            bend_warp: vec![0.0; n],
            twist: vec![0.0; n],
            bend_own: vec![0.0; n],
            stiff: vec![0.0; n * STIFF],
            diagonal: vec![0.0; n * BLOCK],
            ..Grid::default()
        };
        let slot = |knot: u32| layout.slot[knot as usize] as usize;
        let stride = |at: usize| layout.stride_at(at);
        // Sewn edges may bring elements of one panel to knots that stand in the grid of another.
        let fits = |at: usize, side: f64| layout.rows[layout.row_at(at)].cell == side;
        let mut taken = Taken {
            springs: vec![false; cloth.springs.len()],
            cells: vec![false; cloth.cells.len()],
            folds: vec![false; cloth.folds.len()],
        };
        for (c, cell) in cloth.cells.iter().enumerate() {
            let at = cell.corners.map(slot);
            let Some(s) = stride(at[0]) else { continue };
            if at[1] == at[0] + 1 && at[2] == at[0] + s + 1 && at[3] == at[0] + s {
                if grid.shear[at[0]] == 0.0 && fits(at[0], cell.side) {
                    grid.shear[at[0]] = cell.modulus as f32;
                    taken.cells[c] = true;
                }
            }
        }
        for (k, spring) in cloth.springs.iter().enumerate() {
            let [a, b] = spring.ends.map(slot);
            let (low, high) = (a.min(b), a.max(b));
            let Some(s) = stride(low) else { continue };
            let list = if !spring.warp && high == low + 1 {
                &mut grid.weft
            } else if spring.warp && high == low + s {
                &mut grid.warp
            } else {
                continue;
            };
            if list[low] == 0.0 && fits(low, spring.rest) {
                list[low] = spring.stiffness as f32;
                taken.springs[k] = true;
            }
        }
        for (k, fold) in cloth.folds.iter().enumerate() {
            let terms: Vec<(usize, f64)> = fold.terms().map(|(knot, w)| (slot(knot), w)).collect();
            match terms[..] {
                [(a, w), (m, middle), (b, _)] if middle == -2.0 * w => {
                    let (low, high) = (a.min(b), a.max(b));
                    let Some(s) = stride(m) else { continue };
                    let value = (fold.stiffness * w * w) as f32;
                    let (list, step) = if low + 1 == m && high == m + 1 {
                        (&mut grid.bend_weft, 1)
                    } else if low + s == m && high == m + s {
                        (&mut grid.bend_warp, s)
                    } else {
                        continue;
                    };
                    list[m] += value;
                    for (at, share) in [(m, 4.0), (m - step, 1.0), (m + step, 1.0)] {
                        grid.bend_own[at] += share * value;
                    }
                    taken.folds[k] = true;
                }
                [(a, w), (b, v), (c, u), (d, t)] if v == -w && u == w && t == -w => {
                    let Some(s) = stride(a) else { continue };
                    if b == a + 1 && c == a + s + 1 && d == a + s {
                        let value = (fold.stiffness * w * w) as f32;
                        grid.twist[a] += value;
                        for at in [a, b, c, d] {
                            grid.bend_own[at] += value;
                        }
                        taken.folds[k] = true;
                    }
                }
                _ => {}
            }
        }
        let mut row = 0;
        let mut first = 0;
        for patch in &layout.patches {
            for start in (0..patch.rows).step_by(GROUP) {
                grid.groups.push(Group {
                    row: row + start,
                    rows: GROUP.min(patch.rows - start),
                    base: patch.base + start * patch.stride,
                    stride: patch.stride,
                    block: grid.blocks.len(),
                    within: start,
                });
            }
            row += patch.rows;
            for column in (0..patch.stride).step_by(LANES) {
                grid.blocks.push(Block {
                    base: patch.base + column,
                    rows: patch.rows,
                    stride: patch.stride,
                    first,
                });
                first += patch.rows * LANES;
            }
        }
        grid.layout = layout;
        grid.share_out();
        (grid, taken)
    }

    /// Shares out the work among the threads at hand; the result never depends on how many.
    fn share_out(&mut self) {
        let start = self.groups.first().map_or(self.layout.loose, |g| g.base);
        let slots = self.layout.loose - start;
        self.start = start;
        self.parts = share(&self.groups, slots, |g| g.rows * g.stride)
            .into_iter()
            .map(|groups| {
                let [first, last] = [groups.start, groups.end - 1].map(|g| self.groups[g]);
                Part {
                    rows: first.row..last.row + last.rows,
                    slots: first.base..last.base + last.rows * last.stride,
                    groups,
                }
            })
            .collect();
        self.columns = share(&self.blocks, slots, |b| b.rows * LANES)
            .into_iter()
            .map(|blocks| {
                let last = self.blocks[blocks.end - 1];
                Columns { blocks, end: last.first / LANES + last.rows }
            })
            .collect();
    }
}

/// Slots below which one thread is quicker than two.
const SMALL: usize = 4096;

fn share<T>(items: &[T], slots: usize, size: impl Fn(&T) -> usize) -> Vec<Range<usize>> {
    if items.is_empty() {
        return Vec::new();
    }
    let parts = rayon::current_num_threads().min(slots / SMALL).max(1);
    let mut ranges = Vec::with_capacity(parts);
    let (mut start, mut so_far) = (0, 0);
    for (i, item) in items.iter().enumerate() {
        so_far += size(item);
        let enough = so_far * parts >= slots * (ranges.len() + 1);
        if enough && ranges.len() + 1 < parts && i + 1 < items.len() {
            ranges.push(start..i + 1);
            start = i + 1;
        }
    }
    ranges.push(start..items.len());
    ranges
}
