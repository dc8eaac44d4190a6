//! From light to the numbers of a picture.

use super::Light3;

/// Where the curve leaves the straight line; below it colours are as measured.
const KNEE: f32 = 0.62;

/// Linear light of one channel as shown: straight up to the knee, then bending so that white is
/// neared and never reached, as film does.
fn shown(light: f32) -> f32 {
    if light <= KNEE {
        return light.max(0.0);
    }
    let room = 1.0 - KNEE;
    let over = (light - KNEE) / room;
    // Slope 1 at the knee, limit 1: over / (1 + over).
    KNEE + room * over / (1.0 + over)
}

/// The sRGB value, 0 to 1, of a channel of linear light between 0 and 1 (IEC 61966-2-1).
fn curve(light: f32) -> f32 {
    let light = light.clamp(0.0, 1.0);
    if light <= 0.003_130_8 { 12.92 * light } else { 1.055 * libm::powf(light, 1.0 / 2.4) - 0.055 }
}

/// Linear light of an sRGB byte.
pub fn decoded(byte: u8) -> f32 {
    let value = f32::from(byte) / 255.0;
    if value <= 0.04045 { value / 12.92 } else { libm::powf((value + 0.055) / 1.055, 2.4) }
}

/// Linear light of an sRGB colour, without its alpha.
pub fn decoded_colour(colour: [u8; 4]) -> Light3 {
    Light3::new(decoded(colour[0]), decoded(colour[1]), decoded(colour[2]))
}

/// The pixel that shows `light`. Bright colours keep part of their hue: the curve is taken half
/// by channel and half by the brightest channel. `grit` from 0 to 1 decides what is between two
/// bytes, so that a slow fall of light shows no steps.
pub fn developed(light: &Light3, grit: f32) -> [u8; 4] {
    let most = light.max().max(1e-6);
    let scale = shown(most) / most;
    let channel = |c: f32| {
        let value = curve(0.5 * shown(c) + 0.5 * (c * scale)) * 255.0;
        (value + grit) as u8
    };
    [channel(light.x), channel(light.y), channel(light.z), 255]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_come_back_from_light() {
        for byte in 0..=255 {
            assert!((curve(decoded(byte)) * 255.0 - f32::from(byte)).abs() < 0.01);
        }
    }

    #[test]
    fn more_light_is_never_darker_and_white_is_not_burnt() {
        let mut last = 0.0;
        for step in 0..400 {
            let now = shown(step as f32 * 0.01);
            assert!(now >= last && now < 1.0);
            last = now;
        }
        // A white cloth, lit twice as bright as the meter asks, still shows form.
        assert!(developed(&Light3::repeat(1.0), 0.5)[0] < developed(&Light3::repeat(2.0), 0.5)[0]);
    }
}
