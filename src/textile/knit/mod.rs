//! Knits: charts of symbols, what they are as loops, and how a machine knits them.

mod chart;
pub mod knitscape;
mod machine;
mod symbol;
mod written;

pub use chart::{Chart, ChartError, Colourwork, Float, Imbalance, Placed};
pub use machine::{MachineError, panel};
pub use symbol::{Cable, Lean, Symbol};
pub use written::{Objection, Way, written};

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// A loop, seen from the face of the fabric.
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
    /// Its chart, as seen on the face.
    pub chart: Chart,
    /// Wales (stitches) per metre.
    pub wales: f64,
    /// Courses (rows) per metre.
    pub courses: f64,
}

/// Why a chart gives no knit.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum KnitError {
    /// The chart is none.
    #[error(transparent)]
    Chart(#[from] ChartError),
    /// A gauge that is not a positive number.
    #[error("the gauge must be positive")]
    Gauge,
}

impl Knit {
    /// A knit from its chart and its gauge in wales and courses per metre.
    ///
    /// # Errors
    /// [`KnitError::Gauge`].
    pub fn new(
        name: impl Into<String>,
        chart: Chart,
        wales: f64,
        courses: f64,
    ) -> Result<Knit, KnitError> {
        let sound = |gauge: f64| gauge.is_finite() && gauge > 0.0;
        if !sound(wales) || !sound(courses) {
            return Err(KnitError::Gauge);
        }
        Ok(Knit { name: name.into(), chart, wales, courses })
    }

    /// A knit of face and back loops, the bottom row first.
    ///
    /// # Errors
    /// Any [`KnitError`].
    pub fn of_loops(
        name: impl Into<String>,
        rows: Vec<Vec<Stitch>>,
        wales: f64,
        courses: f64,
    ) -> Result<Knit, KnitError> {
        let symbol = |stitch| match stitch {
            Stitch::Face => Symbol::Knit,
            Stitch::Back => Symbol::Purl,
        };
        let rows = rows.into_iter().map(|row| row.into_iter().map(symbol).collect()).collect();
        Knit::new(name, Chart::new(rows, None)?, wales, courses)
    }

    /// Stitches across one repeat.
    pub fn width(&self) -> usize {
        self.chart.width()
    }

    /// Rows in one repeat.
    pub fn height(&self) -> usize {
        self.chart.height()
    }

    /// The loops that are seen, the bottom row first.
    pub fn loops(&self) -> Vec<Vec<Stitch>> {
        (0..self.height())
            .map(|row| {
                let placed = self.chart.placed(row).into_iter();
                placed
                    .flat_map(|(symbol, _, width)| (0..width).map(move |at| symbol.stitch(at)))
                    .collect()
            })
            .collect()
    }

    /// Length of yarn in one of its stitches, m; see [`loop_length`].
    pub fn loop_length(&self) -> f64 {
        loop_length([self.wales, self.courses])
    }
}

/// Length of yarn in one stitch of relaxed plain knitting of so many wales and courses per metre, m:
/// the square root of k over the stitch density, k = 21.6 (Munden 1959, wet relaxed).
pub fn loop_length([wales, courses]: [f64; 2]) -> f64 {
    (21.6 / (wales * courses)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::{Stitch::*, *};

    #[test]
    fn bad_charts_are_told_apart() {
        let chart = |rows, gauge| Knit::of_loops("k", rows, gauge, 3000.0);
        assert_eq!(chart(vec![], 1.0), Err(ChartError::Empty.into()));
        assert_eq!(chart(vec![vec![Face]], 0.0), Err(KnitError::Gauge));
        let ragged = ChartError::Ragged { row: 2, found: 2, expected: 1 };
        assert_eq!(chart(vec![vec![Face], vec![Face, Back]], 1.0), Err(ragged.into()));
        assert_eq!(chart(vec![vec![Face; 5000]], 1.0), Err(ChartError::TooLarge.into()));
    }

    #[test]
    fn a_rib_is_a_rib_from_behind_too() {
        let rib = Knit::of_loops("rib", vec![vec![Face, Face, Back, Back]], 2400.0, 3100.0);
        let rib = rib.unwrap();
        assert_eq!(rib.chart.behind().as_ref(), Some(&rib.chart));
        assert_eq!(rib.loops(), [[Face, Face, Back, Back]]);
    }

    #[test]
    fn a_hand_knit_stitch_takes_about_two_centimetres_of_yarn() {
        // 22 × 30 per 10 cm: a stitch of 4.5 mm takes a little over four times its width.
        let plain = Knit::of_loops("plain", vec![vec![Face]], 220.0, 300.0).unwrap();
        let length = plain.loop_length();
        assert!((0.017..0.020).contains(&length), "{length}");
    }
}
