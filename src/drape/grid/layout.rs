//! Where the knots stand in the lists of the solver: each panel's grid as a block of padded rows, loose
//! knots of the bands after them.

use super::lanes::LANES;
use crate::drape::weld::Weld;
use crate::mesh::compiled::Compiled;

/// The grid of one panel as rows of slots. Rows run along the weft, columns along the warp. A row
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
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Row {
    /// Its first slot.
    pub base: usize,
    /// Slots of it.
    pub stride: usize,
    /// Whether it is its patch's first (empty) row.
    pub first: bool,
}

/// Slots of all knots.
#[derive(Clone, Debug, Default)]
pub struct Layout {
    /// Panels' grids.
    pub patches: Vec<Patch>,
    /// All rows, patch by patch; their slots follow each other without gaps.
    pub rows: Vec<Row>,
    /// First slot of the loose knots.
    pub loose: usize,
    /// Slots in all, a guard at both ends included.
    pub slots: usize,
    /// Slot of each knot.
    pub slot: Vec<u32>,
}

impl Layout {
    /// Lays out the knots of a compiled garment. Of several lattice particles that are one knot the
    /// first gives it its place.
    pub fn new(compiled: &Compiled, weld: &Weld) -> Self {
        let mut extents = Vec::new();
        let mut widest = LANES;
        for panel in &compiled.panels {
            let mut low = [i32::MAX; 2];
            let mut high = [i32::MIN; 2];
            for at in &compiled.lattice[panel.particles.range()] {
                if at[0] == i32::MIN {
                    continue;
                }
                for k in 0..2 {
                    low[k] = low[k].min(at[k]);
                    high[k] = high[k].max(at[k]);
                }
            }
            if low[0] > high[0] {
                extents.push(None);
                continue;
            }
            let columns = high[0].abs_diff(low[0]) as usize + 1;
            let rows = high[1].abs_diff(low[1]) as usize + 1;
            let stride = columns.next_multiple_of(LANES);
            widest = widest.max(stride);
            extents.push(Some((low, rows + 2, stride)));
        }
        let guard = 2 * widest + LANES;
        let mut layout =
            Layout { slots: guard, slot: vec![u32::MAX; weld.count], ..Layout::default() };
        for (panel, extent) in compiled.panels.iter().zip(extents) {
            let Some((low, rows, stride)) = extent else { continue };
            let patch = Patch { base: layout.slots, rows, stride };
            layout.slots += rows * stride;
            layout.rows.extend((0..rows).map(|r| Row {
                base: patch.base + r * stride,
                stride,
                first: r == 0,
            }));
            for p in panel.particles.range() {
                let [i, j] = compiled.lattice[p];
                if i == i32::MIN {
                    continue;
                }
                let slot = &mut layout.slot[weld.knot[p] as usize];
                if *slot == u32::MAX {
                    let (i, j) = (i.abs_diff(low[0]) as usize, j.abs_diff(low[1]) as usize);
                    *slot = (patch.base + (j + 1) * stride + i) as u32;
                }
            }
            layout.patches.push(patch);
        }
        layout.loose = layout.slots;
        for slot in layout.slot.iter_mut().filter(|s| **s == u32::MAX) {
            *slot = layout.slots as u32;
            layout.slots += 1;
        }
        layout.slots = layout.slots.next_multiple_of(LANES) + guard;
        layout
    }

    /// Slots of one row of the patch that holds a slot; `None` for loose knots.
    pub fn stride_at(&self, slot: usize) -> Option<usize> {
        let after = self.patches.partition_point(|p| p.base <= slot);
        let patch = self.patches.get(after.checked_sub(1)?)?;
        (slot < patch.base + patch.rows * patch.stride).then_some(patch.stride)
    }
}
