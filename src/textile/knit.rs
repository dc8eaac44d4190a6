//! Knits as charts of loops.

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// One cell of a knit chart, seen from the face of the fabric.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Stitch {
    /// Face loop (R, knit): drawn through to the front.
    Face,
    /// Back loop (L, purl): drawn through to the back.
    Back,
}

impl Stitch {
    /// The same loop seen from the other side.
    #[must_use]
    pub fn turned(self) -> Stitch {
        match self {
            Stitch::Face => Stitch::Back,
            Stitch::Back => Stitch::Face,
        }
    }
}

/// One repeat of a knit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Knit {
    /// Its name in the text.
    pub name: String,
    /// `rows[row][wale]`, every row equally long, at least one of each.
    pub rows: Vec<Vec<Stitch>>,
    /// Wales (stitches) per metre.
    pub wales: f64,
    /// Courses (rows) per metre.
    pub courses: f64,
}

/// Why a chart gives no knit.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum KnitError {
    /// No rows, or rows without cells.
    #[error("a knit needs at least one row and one stitch")]
    Empty,
    /// Rows of different lengths.
    #[error("row {row} has {found} stitches, the first has {expected}")]
    Ragged {
        /// Number of the row, from 1.
        row: usize,
        /// Its stitches.
        found: usize,
        /// Stitches of the first row.
        expected: usize,
    },
    /// A repeat beyond [`Knit::LARGEST_REPEAT`].
    #[error("the repeat is larger than {} stitches", Knit::LARGEST_REPEAT)]
    TooLarge,
    /// A gauge that is not a positive number.
    #[error("the gauge must be positive")]
    Gauge,
}

impl Knit {
    /// Stitches or rows a repeat may have.
    pub const LARGEST_REPEAT: usize = 2048;

    /// A knit from its chart, bottom row first, with its gauge in wales and courses per metre.
    ///
    /// # Errors
    /// Any [`KnitError`].
    pub fn chart(
        name: impl Into<String>,
        rows: Vec<Vec<Stitch>>,
        wales: f64,
        courses: f64,
    ) -> Result<Knit, KnitError> {
        let expected = rows.first().map_or(0, Vec::len);
        if expected == 0 {
            return Err(KnitError::Empty);
        }
        if rows.len() > Self::LARGEST_REPEAT || expected > Self::LARGEST_REPEAT {
            return Err(KnitError::TooLarge);
        }
        for (row, stitches) in rows.iter().enumerate() {
            if stitches.len() != expected {
                return Err(KnitError::Ragged { row: row + 1, found: stitches.len(), expected });
            }
        }
        let sound = |gauge: f64| gauge.is_finite() && gauge > 0.0;
        if !sound(wales) || !sound(courses) {
            return Err(KnitError::Gauge);
        }
        Ok(Knit { name: name.into(), rows, wales, courses })
    }

    /// Stitches across one repeat.
    pub fn width(&self) -> usize {
        self.rows.first().map_or(0, Vec::len)
    }

    /// Rows in one repeat.
    pub fn height(&self) -> usize {
        self.rows.len()
    }

    /// The stitch at this wale and row of the cloth, counted round the repeat.
    pub fn stitch(&self, wale: usize, row: usize) -> Stitch {
        let row = self.rows.get(row % self.height().max(1));
        row.and_then(|row| row.get(wale % row.len().max(1))).copied().unwrap_or(Stitch::Face)
    }

    /// The chart with face and back loops changed, not mirrored.
    #[must_use]
    pub fn turned(&self) -> Knit {
        let rows = self.rows.iter().map(|row| row.iter().map(|s| s.turned()).collect()).collect();
        Knit { rows, ..self.clone() }
    }

    /// The fabric as seen from behind: loops turned, left and right exchanged.
    #[must_use]
    pub fn back(&self) -> Knit {
        let mut turned = self.turned();
        for row in &mut turned.rows {
            row.reverse();
        }
        turned
    }

    /// Length of yarn in one stitch of relaxed plain knitting, m: the square root of k over the
    /// stitch density, k = 21.6 (Munden 1959, wet relaxed).
    pub fn loop_length(&self) -> f64 {
        (21.6 / (self.wales * self.courses)).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::{Stitch::*, *};

    #[test]
    fn a_rib_is_a_rib_from_behind_too() {
        let rib = Knit::chart("rib", vec![vec![Face, Face, Back, Back]], 2400.0, 3100.0).unwrap();
        assert_eq!(rib.back().rows, rib.rows);
        let plain = Knit::chart("plain", vec![vec![Face]], 2200.0, 3000.0).unwrap();
        assert_eq!(plain.back().rows, [[Back]]);
        assert_eq!(plain.stitch(7, 9), Face);
    }

    #[test]
    fn bad_charts_are_told_apart() {
        let chart = |rows, gauge| Knit::chart("k", rows, gauge, 3000.0);
        assert_eq!(chart(vec![], 1.0), Err(KnitError::Empty));
        assert_eq!(chart(vec![vec![Face]], 0.0), Err(KnitError::Gauge));
        let ragged = KnitError::Ragged { row: 2, found: 2, expected: 1 };
        assert_eq!(chart(vec![vec![Face], vec![Face, Back]], 1.0), Err(ragged));
        assert_eq!(chart(vec![vec![Face; 5000]], 1.0), Err(KnitError::TooLarge));
    }

    #[test]
    fn a_hand_knit_stitch_takes_about_two_centimetres_of_yarn() {
        // 22 × 30 per 10 cm: a stitch of 4.5 mm takes a little over four times its width.
        let plain = Knit::chart("plain", vec![vec![Face]], 220.0, 300.0).unwrap();
        let length = plain.loop_length();
        assert!((0.017..0.020).contains(&length), "{length}");
    }
}
