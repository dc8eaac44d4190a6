//! Linear light to the bytes of sRGB, by table.

use crate::textile::Colour;

/// The code of each of 65 536 even steps of light.
pub struct Code {
    table: Vec<u8>,
}

/// Steps of the table.
const STEPS: usize = 1 << 16;

impl Code {
    /// Builds the table from the exact curve: the code changes 255 times, so the places where it
    /// does are found and the steps between them filled.
    pub fn new() -> Code {
        let mut table = Vec::with_capacity(STEPS);
        for code in 0..=255u8 {
            // Light half way, in code, to the next: where rounding turns over.
            let above = (f64::from(code) + 0.5) / 255.0;
            let light = if above <= 0.04045 {
                above / 12.92
            } else {
                libm::pow((above + 0.055) / 1.055, 2.4)
            };
            let end = if code == 255 { STEPS } else { (light * (STEPS - 1) as f64 + 0.5) as usize };
            table.resize(end.clamp(table.len(), STEPS), code);
        }
        Code { table }
    }

    /// The code of this light; what is out of 0 to 1 is held there.
    pub fn of(&self, light: f32) -> u8 {
        let step = (light * (STEPS - 1) as f32 + 0.5) as usize;
        self.table.get(step.min(STEPS - 1)).copied().unwrap_or(0)
    }
}

impl Code {
    /// A colour in linear light, single precision.
    pub fn linear(colour: Colour) -> [f32; 3] {
        colour.linear().map(|value| value as f32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_code_comes_back() {
        let code = Code::new();
        for value in 0..=255u8 {
            let light = Code::linear(Colour([value, 0, 0, 255]))[0];
            // 16 bits of even steps separate all codes but the darkest few, where two codes lie
            // within 1/3295 and a step is 1/65535: all are separate.
            assert_eq!(code.of(light), value);
        }
        assert_eq!((code.of(-1.0), code.of(7.0), code.of(f32::NAN)), (0, 255, 0));
    }
}
