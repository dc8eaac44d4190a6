//! Textiles as structures: yarns, weaves, knits, motifs, and the fabric made of them.
//!
//! A chart is the face of the cloth as it hangs before you. In memory row 0 is the bottom row of
//! the chart (the first pick, the first knitted row) and column 0 its left column.

pub mod clo;
pub mod compound;
pub mod draft;
pub mod drawdown;
pub mod fabric;
pub mod fast;
pub mod kes;
pub mod knit;
pub mod knitout;
pub mod layers;
pub mod motif;
pub mod objection;
pub mod origin;
pub mod paper;
pub mod sett;
mod told;
pub mod twill;
pub mod weave;
pub mod wif;
pub mod yarn;

use serde::{Deserialize, Serialize};

/// A colour as sRGB with alpha, 8 bits each.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Colour(pub [u8; 4]);

impl Colour {
    /// The three colours in linear light, 0 to 1 (IEC 61966-2-1).
    pub fn linear(self) -> [f64; 3] {
        let [red, green, blue, _] = self.0;
        [red, green, blue].map(|code| {
            let value = f64::from(code) / 255.0;
            if value <= 0.04045 { value / 12.92 } else { libm::pow((value + 0.055) / 1.055, 2.4) }
        })
    }

    /// The opaque colour nearest to this linear light; values outside 0 to 1 are held there.
    pub fn from_linear(light: [f64; 3]) -> Colour {
        let [red, green, blue] = light.map(|value| {
            let value = value.clamp(0.0, 1.0);
            let coded = if value <= 0.003_130_8 {
                value * 12.92
            } else {
                1.055 * libm::pow(value, 1.0 / 2.4) - 0.055
            };
            (coded * 255.0 + 0.5) as u8
        });
        Colour([red, green, blue, 255])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_code_survives_linear_light() {
        for code in 0..=255u8 {
            let colour = Colour([code, 255 - code, 7, 255]);
            assert_eq!(Colour::from_linear(colour.linear()), colour);
        }
        assert_eq!(Colour::from_linear([f64::NAN, -1.0, 2.0]).0[1..], [0, 255, 255]);
    }
}
