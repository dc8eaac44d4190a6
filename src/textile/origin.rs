//! Where the measures of a fabric come from: what the text says, what a sheet says, what the yarns
//! make, and what is assumed because nobody said it.

use crate::units::Dimension;
use serde::Serialize;

/// Where a measure comes from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Origin {
    /// A property of the fabric in the text.
    Stated,
    /// Worked out from the fabric's KES-F sheet.
    Kes,
    /// Worked out from the fabric's FAST sheet.
    Fast,
    /// Worked out from the yarns that the text names.
    Yarns,
    /// Nobody said it: what such a cloth usually has.
    #[default]
    Assumed,
}

impl Origin {
    /// In one word, for tables.
    pub fn word(self) -> &'static str {
        match self {
            Origin::Stated => "stated",
            Origin::Kes => "KES-F sheet",
            Origin::Fast => "FAST sheet",
            Origin::Yarns => "from the yarns",
            Origin::Assumed => "assumed",
        }
    }
}

/// A row of a sheet as it is written.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// Of which sheet.
    pub sheet: Origin,
    /// Its name there, such as `2HB`.
    pub name: &'static str,
    /// What it measures.
    pub dimension: Dimension,
    /// Warp and weft, SI units.
    pub value: [f64; 2],
}

/// Where each measure of a fabric comes from.
#[derive(Clone, Debug, Default, PartialEq)]
#[allow(missing_docs)]
pub struct Origins {
    pub mass: Origin,
    pub thickness: Origin,
    pub bending: Origin,
    pub tensile: Origin,
    pub shear: Origin,
    pub poisson: Origin,
    pub friction: Origin,
    pub damping: Origin,
    /// All rows of its sheets, those too that the elastic cloth has no use for.
    pub readings: Vec<Reading>,
}
