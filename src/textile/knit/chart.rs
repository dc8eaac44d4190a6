//! Charts: rows of symbols as seen on the face, with their colours.

use super::symbol::{Cable, Symbol};
use crate::textile::Colour;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use thiserror::Error;

/// How yarns of several colours are carried.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Colourwork {
    /// Each colour of a row runs along behind the stitches of the others.
    #[default]
    Stranded,
    /// Each patch of colour has a yarn of its own.
    Intarsia,
}

/// A chart. Row 0 is the first row knitted, column 0 the left one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Chart {
    rows: Vec<Vec<Symbol>>,
    /// The colours of the cells, where the chart says them.
    colours: Option<Vec<Vec<Option<Colour>>>>,
    /// How its colours are carried.
    pub colourwork: Colourwork,
    /// Whether it is worked in the round: every row on the face, from the right.
    pub round: bool,
}

/// Why rows make no chart.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ChartError {
    /// No rows, or rows without cells.
    #[error("a knit needs at least one row and one stitch")]
    Empty,
    /// Rows of different lengths.
    #[error("row {row} has {found} stitches, the first has {expected}")]
    Ragged {
        /// Number of the row, from 1.
        row: usize,
        /// Its cells.
        found: usize,
        /// Cells of the first row.
        expected: usize,
    },
    /// A chart beyond [`Chart::LARGEST`].
    #[error("the repeat is larger than {} stitches", Chart::LARGEST)]
    TooLarge,
    /// A cable that does not have all its columns.
    #[error("row {row} has {found} cells of the cable {}, which covers {}", Symbol::Cable(*.cable).word(), .cable.width())]
    Cable {
        /// Number of the row, from 1.
        row: usize,
        /// Cells side by side.
        found: usize,
        /// The cable.
        cable: Cable,
    },
}

/// A row that does not work what the row below leaves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Imbalance {
    /// Number of the row, from 1.
    pub row: usize,
    /// Stitches that it works.
    pub uses: usize,
    /// Stitches that the row below leaves.
    pub left: usize,
}

/// A yarn that runs behind others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Float {
    /// Number of the row, from 1.
    pub row: usize,
    /// Stitches it runs behind.
    pub stitches: usize,
    /// Its colour.
    pub colour: Option<Colour>,
}

/// A symbol in its place: which it is, its column, and the columns it covers.
pub type Placed = (Symbol, usize, usize);

impl Chart {
    /// Stitches or rows a chart may have.
    pub const LARGEST: usize = 2048;

    /// A chart from its symbols and colours, the first row knitted first.
    ///
    /// # Errors
    /// Any [`ChartError`].
    pub fn new(
        rows: Vec<Vec<Symbol>>,
        colours: Option<Vec<Vec<Option<Colour>>>>,
    ) -> Result<Chart, ChartError> {
        let expected = rows.first().map_or(0, Vec::len);
        if expected == 0 {
            return Err(ChartError::Empty);
        }
        if rows.len() > Self::LARGEST || expected > Self::LARGEST {
            return Err(ChartError::TooLarge);
        }
        for (number, row) in rows.iter().enumerate() {
            let row_number = number + 1;
            if row.len() != expected {
                return Err(ChartError::Ragged { row: row_number, found: row.len(), expected });
            }
            for run in row.chunk_by(|one, other| one == other) {
                if let Some(Symbol::Cable(cable)) = run.first() {
                    if run.len() % cable.width() != 0 {
                        let (found, cable) = (run.len(), *cable);
                        return Err(ChartError::Cable { row: row_number, found, cable });
                    }
                }
            }
        }
        let any =
            |colours: &Vec<Vec<Option<Colour>>>| colours.iter().flatten().any(Option::is_some);
        let colours = colours.filter(any);
        Ok(Chart { rows, colours, colourwork: Colourwork::default(), round: false })
    }

    /// Columns.
    pub fn width(&self) -> usize {
        self.rows.first().map_or(0, Vec::len)
    }

    /// Rows.
    pub fn height(&self) -> usize {
        self.rows.len()
    }

    /// The symbols, the first row knitted first.
    pub fn rows(&self) -> &[Vec<Symbol>] {
        &self.rows
    }

    /// The symbols of a row from the left, each cable once.
    pub fn placed(&self, row: usize) -> Vec<Placed> {
        let mut found = Vec::new();
        let Some(row) = self.rows.get(row) else { return found };
        let mut column = 0;
        while let Some(&symbol) = row.get(column) {
            let width = if let Symbol::Cable(cable) = symbol { cable.width().max(1) } else { 1 };
            found.push((symbol, column, width));
            column += width;
        }
        found
    }

    /// The colour of a cell, where the chart says it.
    pub fn colour(&self, column: usize, row: usize) -> Option<Colour> {
        self.colours.as_ref()?.get(row)?.get(column).copied().flatten()
    }

    /// The colours of all cells, in the order in which they are first reached: row by row, each
    /// from the right. None stands for the yarn of the fabric.
    pub fn palette(&self) -> Vec<Option<Colour>> {
        let cells = |row| (0..self.width()).rev().map(move |column| (column, row));
        let cells = (0..self.height()).flat_map(cells);
        self.different(cells.filter(|&(column, row)| self.rows[row][column] != Symbol::NoStitch))
    }

    /// The colours worked in a row, in the order of the hands: from the right. A stitch that is
    /// slipped is not worked.
    pub fn worked_colours(&self, row: usize) -> Vec<Option<Colour>> {
        let Some(cells) = self.rows.get(row) else { return Vec::new() };
        let worked = |column: &usize| !matches!(cells[*column], Symbol::Slip | Symbol::NoStitch);
        self.different((0..cells.len()).rev().filter(worked).map(|column| (column, row)))
    }

    /// The colours of these cells, each where it comes first.
    fn different(&self, cells: impl Iterator<Item = (usize, usize)>) -> Vec<Option<Colour>> {
        let mut known = BTreeSet::new();
        let colours = cells.map(|(column, row)| self.colour(column, row));
        colours.filter(|colour| known.insert(colour.map(|it| it.0))).collect()
    }

    /// The light that its cells send together, linear, with `yarn` where they say no colour; none
    /// where none says one.
    pub fn mean_light(&self, yarn: Colour) -> Option<[f64; 3]> {
        self.colours.as_ref()?;
        let mut sum = [0.0; 3];
        for row in 0..self.height() {
            for column in 0..self.width() {
                let light = self.colour(column, row).unwrap_or(yarn).linear();
                (0..3).for_each(|n| sum[n] += light[n]);
            }
        }
        let cells = (self.width() * self.height()) as f64;
        Some(sum.map(|light| light / cells))
    }

    /// How many there are of each symbol, cables counted once.
    pub fn counts(&self) -> BTreeMap<Symbol, usize> {
        let mut found = BTreeMap::new();
        for row in 0..self.height() {
            for (symbol, ..) in self.placed(row) {
                *found.entry(symbol).or_default() += 1;
            }
        }
        found
    }

    /// Stitches that a row works of the row below.
    pub fn uses(&self, row: usize) -> usize {
        self.rows.get(row).map_or(0, |row| row.iter().map(|symbol| symbol.uses()).sum())
    }

    /// Stitches that a row leaves to the row above.
    pub fn leaves(&self, row: usize) -> usize {
        self.rows.get(row).map_or(0, |row| row.iter().map(|symbol| symbol.leaves()).sum())
    }

    /// The rows that do not work what the row below leaves.
    pub fn imbalances(&self) -> Vec<Imbalance> {
        (1..self.height())
            .map(|row| Imbalance { row: row + 1, uses: self.uses(row), left: self.leaves(row - 1) })
            .filter(|found| found.uses != found.left)
            .collect()
    }

    /// Whether the chart can be knitted again above itself.
    pub fn closes(&self) -> bool {
        self.height() > 0 && self.uses(0) == self.leaves(self.height() - 1)
    }

    /// The longest yarn that runs behind stitches of other colours, counted round the repeat; in
    /// intarsia none does.
    pub fn longest_float(&self) -> Option<Float> {
        if self.colours.is_none() || self.colourwork == Colourwork::Intarsia {
            return None;
        }
        let mut longest: Option<Float> = None;
        for (row, cells) in self.rows.iter().enumerate() {
            let there: Vec<usize> =
                (0..cells.len()).filter(|&column| cells[column] != Symbol::NoStitch).collect();
            // Where each colour is worked first and last so far, and its longest float.
            let mut runs: BTreeMap<Option<[u8; 4]>, [usize; 3]> = BTreeMap::new();
            for (at, &column) in there.iter().enumerate() {
                if cells[column] != Symbol::Slip {
                    let colour = self.colour(column, row).map(|it| it.0);
                    let [_, last, most] = runs.entry(colour).or_insert([at, at, 0]);
                    *most = (*most).max((at - *last).saturating_sub(1));
                    *last = at;
                }
            }
            for (colour, [first, last, most]) in runs {
                let stitches = most.max(there.len() - last - 1 + first);
                if stitches > longest.map_or(0, |float| float.stitches) {
                    let colour = colour.map(Colour);
                    longest = Some(Float { row: row + 1, stitches, colour });
                }
            }
        }
        longest
    }

    /// Patches of one colour that lie side by side in a row, at most: the yarns that intarsia
    /// needs at once.
    pub fn patches(&self) -> usize {
        let of = |row: usize| {
            let colours: Vec<Option<Colour>> = (0..self.width())
                .filter(|&column| self.rows[row][column] != Symbol::NoStitch)
                .map(|column| self.colour(column, row))
                .collect();
            colours.chunk_by(|one, other| one == other).count()
        };
        (0..self.height()).map(of).max().unwrap_or(0)
    }

    /// The chart several times side by side and above itself.
    ///
    /// # Errors
    /// [`ChartError::TooLarge`] where it grows beyond [`Chart::LARGEST`].
    pub fn repeated(&self, across: usize, up: usize) -> Result<Chart, ChartError> {
        let (across, up) = (across.max(1), up.max(1));
        let beyond = |count: usize, times: usize| count.saturating_mul(times) > Self::LARGEST;
        if beyond(self.width(), across) || beyond(self.height(), up) {
            return Err(ChartError::TooLarge);
        }
        fn times<T: Copy>(rows: &[Vec<T>], across: usize, up: usize) -> Vec<Vec<T>> {
            let wide: Vec<Vec<T>> = rows.iter().map(|row| row.repeat(across)).collect();
            (0..up).flat_map(|_| wide.iter().cloned()).collect()
        }
        Ok(Chart {
            rows: times(&self.rows, across, up),
            colours: self.colours.as_ref().map(|colours| times(colours, across, up)),
            ..*self
        })
    }

    /// The chart as seen from behind, where all its symbols can be.
    pub fn behind(&self) -> Option<Chart> {
        let mut rows = Vec::with_capacity(self.rows.len());
        for row in &self.rows {
            rows.push(row.iter().rev().map(|symbol| symbol.behind()).collect::<Option<Vec<_>>>()?);
        }
        let mut colours = self.colours.clone();
        colours.iter_mut().flatten().for_each(|row| row.reverse());
        Some(Chart { rows, colours, ..*self })
    }
}

#[cfg(test)]
mod tests {
    use super::super::symbol::Lean;
    use super::*;
    use Symbol::{Knit, NoStitch, Purl, Slip, YarnOver};

    const SSK: Symbol = Symbol::Together { stitches: 2, lean: Lean::Left, purl: false };
    const RED: Option<Colour> = Some(Colour([200, 0, 0, 255]));
    const BLUE: Option<Colour> = Some(Colour([0, 0, 200, 255]));

    #[test]
    fn a_row_works_what_the_row_below_leaves() {
        let lace = vec![vec![Knit; 4], vec![Knit, YarnOver, SSK, Knit], vec![Knit; 4]];
        let chart = Chart::new(lace, None).unwrap();
        assert_eq!((chart.imbalances(), chart.closes()), (vec![], true));
        let narrowing = vec![vec![Knit; 4], vec![Knit, SSK, Knit, NoStitch], vec![Knit; 4]];
        let chart = Chart::new(narrowing, None).unwrap();
        assert_eq!(chart.imbalances(), [Imbalance { row: 3, uses: 4, left: 3 }]);
        assert_eq!((chart.uses(1), chart.leaves(1)), (4, 3));
    }

    #[test]
    fn a_cable_has_all_its_columns() {
        let cable = Cable { front: 1, behind: 2, lean: Lean::Right, purl: false };
        let symbol = Symbol::Cable(cable);
        let chart = Chart::new(vec![vec![symbol, symbol, symbol, Purl]], None).unwrap();
        assert_eq!(chart.placed(0), [(symbol, 0, 3), (Purl, 3, 1)]);
        assert_eq!(chart.counts()[&symbol], 1);
        let broken = Chart::new(vec![vec![symbol, symbol, Purl, Purl]], None);
        assert_eq!(broken, Err(ChartError::Cable { row: 1, found: 2, cable }));
    }

    #[test]
    fn floats_are_counted_round_the_repeat_and_behind_slipped_stitches() {
        let colours = vec![vec![RED, BLUE, BLUE, BLUE, RED, BLUE]];
        let mut chart = Chart::new(vec![vec![Knit; 6]], Some(colours.clone())).unwrap();
        assert_eq!(chart.longest_float().unwrap().stitches, 3);
        assert_eq!(chart.palette(), [BLUE, RED]);
        let [red, _, blue] = chart.mean_light(Colour([0; 4])).unwrap();
        assert!((blue / red - 2.0).abs() < 1e-12, "four of six cells are blue");
        assert_eq!(chart.patches(), 4);
        let slipped = Chart::new(vec![vec![Knit, Slip, Slip, Slip, Slip, Slip]], Some(colours));
        assert_eq!(slipped.unwrap().longest_float().unwrap().stitches, 5);
        chart.colourwork = Colourwork::Intarsia;
        assert_eq!(chart.longest_float(), None);
    }
}
