//! Knits as charts of loops.

use serde::{Deserialize, Serialize};

/// One cell of a knit chart, seen from the face of the fabric.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Stitch {
    /// Face loop (R, knit): drawn through to the front.
    Face,
    /// Back loop (L, purl): drawn through to the back.
    Back,
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
