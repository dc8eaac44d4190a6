//! Weaves as matrices of warp-up and weft-up.

use serde::{Deserialize, Serialize};

/// One repeat of a weave.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Weave {
    /// Its name in the text.
    pub name: String,
    /// `rows[pick][end]`: true where the warp end lies on the weft pick. Every row is equally
    /// long and there is at least one row and one column.
    pub rows: Vec<Vec<bool>>,
}
