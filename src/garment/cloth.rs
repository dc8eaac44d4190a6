//! What is seen on a panel: its fabric throughout, or the parts of a sari.

use super::sari::Sari;
use serde::{Deserialize, Serialize};

/// What is woven, knitted or printed where on a panel.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Surface {
    /// The fabric's own structure everywhere.
    Fabric,
    /// The parts of a sari.
    Sari(Box<Sari>),
}
