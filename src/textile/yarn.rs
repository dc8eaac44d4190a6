//! Yarn: count, plies, twist, fibre, colour.

use super::Colour;
use serde::{Deserialize, Serialize};

/// What a yarn is spun from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
#[allow(missing_docs)]
pub enum Fibre {
    Cotton,
    Silk,
    Wool,
    Linen,
    Jute,
    Viscose,
    Polyester,
    Nylon,
    Metal,
}

/// The direction of twist: the slant of the middle stroke of the letter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[allow(missing_docs)]
pub enum Twist {
    S,
    Z,
}

/// A yarn.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Yarn {
    /// Its name in the text.
    pub name: String,
    /// Mass per length of the whole yarn, kg/m (1 tex = 1e-6 kg/m).
    pub count: f64,
    /// Strands twisted together.
    pub plies: u32,
    /// Turns per metre.
    pub twist: f64,
    /// Which way it is twisted.
    pub direction: Twist,
    /// What it is spun from.
    pub fibre: Fibre,
    /// Its colour.
    pub colour: Colour,
    /// Its diameter in the cloth, m.
    pub diameter: f64,
}
