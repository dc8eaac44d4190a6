//! Weaving Information Files (WIF 1.1), as weaving programs write them.
//!
//! The format is a text of sections with `key=value` lines. Real files depart from it in known
//! ways, and are read all the same: `Version=1.2`, sections that are there but empty, lists with
//! zeros, more shafts than are declared, keys given twice, contents that promise what is not
//! there. What contradicts itself so that nobody could weave it is refused, with section, key and
//! line.

mod colour;
mod ini;
mod number;
mod read;
mod write;

pub use read::{Place, Read, read};
pub use write::write;

use super::draft::Draft;

/// Metres as a draft keeps them: whole nanometres, so that what is written reads back the same.
pub fn nanometres(metres: f64) -> f64 {
    (metres * 1e9).round() / 1e9
}

/// Whether a number of threads, shafts or treadles may be.
fn bearable(number: u64) -> bool {
    number <= Draft::LARGEST as u64
}

#[cfg(test)]
mod tests;
