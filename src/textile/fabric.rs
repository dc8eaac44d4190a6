//! A fabric: structure, yarns, mass and mechanics, all in SI units, warp and weft apart.

use super::{Colour, knit::Knit, weave::Weave, yarn::Yarn};
use serde::{Deserialize, Serialize};

/// How a fabric is made.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Structure {
    /// Warp and weft.
    Woven {
        /// The weave.
        weave: Weave,
        /// Lengthwise thread.
        warp: Thread,
        /// Crosswise thread.
        weft: Thread,
    },
    /// Loops of one yarn. Wales run along the warp direction of the panel, courses along the
    /// weft direction.
    Knitted {
        /// The chart.
        knit: Knit,
        /// The yarn.
        yarn: Yarn,
    },
}

/// A system of parallel threads.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Thread {
    /// What it is.
    pub yarn: Yarn,
    /// Distance from thread to thread, m (one over the sett).
    pub spacing: f64,
    /// Its colour in this fabric.
    pub colour: Colour,
}

/// What was done to the cloth last; it decides how light leaves it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
#[allow(missing_docs)]
pub enum Finish {
    Matte,
    Satin,
    Velvet,
    Wool,
    Raised,
}

/// A fabric. Pairs are warp, weft.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Fabric {
    /// Its name in the text.
    pub name: String,
    /// How it is made.
    pub structure: Structure,
    /// Mass per area, kg/m².
    pub mass: f64,
    /// Thickness, m.
    pub thickness: f64,
    /// Bending rigidity per width, N·m, of the cloth bent along warp, along weft.
    pub bending: [f64; 2],
    /// Tension per width and strain, N/m, along warp, along weft.
    pub tensile: [f64; 2],
    /// Shear force per width and radian of shear, N/m.
    pub shear: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// Coulomb friction, cloth on body and cloth on cloth.
    pub friction: f64,
    /// Share of critical damping in the cloth's own deformations.
    pub damping: f64,
    /// The finish.
    pub finish: Finish,
}
