//! Motifs: small charts of coloured cells, woven or printed on a ground; drawn cell by cell, by
//! paths, from pictures, or made of others.

pub mod image;
pub mod raster;
pub mod tile;

use super::Colour;
use serde::{Deserialize, Serialize};

/// A motif.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Motif {
    /// Its name in the text.
    pub name: String,
    /// `rows[row][column]`; none where the ground shows.
    pub rows: Vec<Vec<Option<Colour>>>,
    /// Width and height of one motif, m.
    pub size: [f64; 2],
}

impl Motif {
    /// Columns of the chart: the longest row.
    pub fn width(&self) -> usize {
        self.rows.iter().map(Vec::len).max().unwrap_or(0)
    }

    /// Rows of the chart.
    pub fn height(&self) -> usize {
        self.rows.len()
    }

    /// The cell in this column and row, the ground beyond the chart.
    pub fn cell(&self, column: i64, row: i64) -> Option<Colour> {
        let row = self.rows.get(usize::try_from(row).ok()?)?;
        row.get(usize::try_from(column).ok()?).copied().flatten()
    }

    /// The motif larger or smaller, the chart the same.
    #[must_use]
    pub fn scaled(&self, by: f64) -> Motif {
        Motif { size: self.size.map(|length| length * by), ..self.clone() }
    }

    /// The motif at another height, its proportions kept.
    #[must_use]
    pub fn of_height(&self, height: f64) -> Motif {
        if self.size[1] > 0.0 { self.scaled(height / self.size[1]) } else { self.clone() }
    }

    /// All woven cells in one colour: `repeat peacock in gold`.
    #[must_use]
    pub fn in_colour(&self, colour: Colour) -> Motif {
        let rows =
            self.rows.iter().map(|row| row.iter().map(|cell| cell.map(|_| colour)).collect());
        Motif { rows: rows.collect(), ..self.clone() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOLD: Colour = Colour([200, 160, 60, 255]);
    const RED: Colour = Colour([160, 20, 40, 255]);

    #[test]
    fn scaling_keeps_the_chart_and_the_proportions() {
        let rows = vec![vec![Some(GOLD), None], vec![None, Some(RED)]];
        let motif = Motif { name: "dot".into(), rows, size: [0.018, 0.014] };
        let high = motif.of_height(0.007);
        assert_eq!(high.rows, motif.rows);
        assert!((high.size[0] - 0.009).abs() < 1e-15);
        assert_eq!(motif.in_colour(RED).rows, [[Some(RED), None], [None, Some(RED)]]);
        assert_eq!(motif.cell(1, 1), Some(RED));
        assert_eq!((motif.cell(-1, 0), motif.cell(0, 2)), (None, None));
    }
}
