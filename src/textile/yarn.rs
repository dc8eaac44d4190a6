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

impl Fibre {
    /// Mass per volume of a yarn as it lies in cloth, air between its fibres included, kg/m³.
    ///
    /// Cotton is Peirce's specific volume of 1.1 cm³/g (Peirce 1937); the others are the fibre's
    /// density times an estimated packing: silk 1340 × 0.75, wool 1310 × 0.45, linen
    /// 1500 × 0.65, jute 1450 × 0.6, viscose 1520 × 0.6, polyester 1380 × 0.65, nylon
    /// 1140 × 0.65. Metal is zari: flat gilt wire wound on a silk core, estimated as a whole.
    pub fn yarn_density(self) -> f64 {
        match self {
            Fibre::Cotton => 1000.0 / 1.1,
            Fibre::Silk => 1005.0,
            Fibre::Wool => 590.0,
            Fibre::Linen => 975.0,
            Fibre::Jute => 870.0,
            Fibre::Viscose => 912.0,
            Fibre::Polyester => 897.0,
            Fibre::Nylon => 741.0,
            Fibre::Metal => 3200.0,
        }
    }
}

/// The direction of twist, and of the lines of a twill: the slant of the middle stroke of the
/// letter.
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

impl Yarn {
    /// The diameter of a round yarn of this count, m: d = √(4 count / π ρ), which for cotton is
    /// Peirce's 37.4 µm · √tex. `count` in kg/m.
    pub fn diameter_of(count: f64, fibre: Fibre) -> f64 {
        (4.0 * count.max(0.0) / (std::f64::consts::PI * fibre.yarn_density())).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cotton_of_one_tex_is_peirces_37_micrometres() {
        let micrometres = Yarn::diameter_of(1e-6, Fibre::Cotton) * 1e6;
        // The table's 37.42 carries four figures.
        assert!((micrometres - 37.42).abs() < 0.005, "{micrometres}");
        let four = Yarn::diameter_of(4e-6, Fibre::Cotton) * 1e6;
        assert!((four / micrometres - 2.0).abs() < 1e-12);
    }

    #[test]
    fn wool_is_bulkier_and_metal_finer_than_cotton() {
        let of = |fibre| Yarn::diameter_of(20e-6, fibre);
        assert!(of(Fibre::Wool) > of(Fibre::Cotton));
        assert!(of(Fibre::Metal) < of(Fibre::Cotton));
        assert_eq!(Yarn::diameter_of(-1.0, Fibre::Silk), 0.0);
    }
}
