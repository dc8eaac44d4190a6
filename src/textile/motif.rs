//! Motifs: small charts of coloured cells, woven or printed on a ground.

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
