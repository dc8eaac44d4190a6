//! Textiles as structures: yarns, weaves, knits, motifs, and the fabric made of them.
//!
//! A chart is the face of the cloth as it hangs before you. In memory row 0 is the bottom row of
//! the chart (the first pick, the first knitted row) and column 0 its left column.

pub mod fabric;
pub mod knit;
pub mod motif;
pub mod weave;
pub mod yarn;

use serde::{Deserialize, Serialize};

/// A colour as sRGB with alpha, 8 bits each.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Colour(pub [u8; 4]);
