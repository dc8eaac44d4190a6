//! The unevenness of yarns: no thread is equally thick all along.
//!
//! Spun yarns vary in mass by some ten per cent from place to place (Uster's CV), over lengths of
//! centimetres. In the cloth that shows as fine streaks along warp and weft. Seen from afar many
//! threads fall into one pixel and their differences even out with the root of their number.

use crate::textile::fabric::{Fabric, Structure};
use crate::textile::yarn::Fibre;

/// The threads of a fabric as far as their unevenness shows.
#[derive(Clone, Copy, Debug)]
pub struct Slubs {
    /// Distance from warp to warp and from weft to weft, m.
    spacing: [f32; 2],
    /// How much light varies from thread to thread.
    strength: [f32; 2],
}

/// Length over which a thread stays alike, m.
const LENGTH: f32 = 0.028;

impl Slubs {
    /// Of a fabric.
    pub fn of(fabric: &Fabric) -> Self {
        match &fabric.structure {
            Structure::Woven { warp, weft, .. } => Slubs {
                spacing: [warp, weft].map(|thread| (thread.spacing as f32).clamp(5e-5, 0.02)),
                strength: [warp, weft].map(|thread| unevenness(thread.yarn.fibre)),
            },
            // A knit's yarn runs along the courses; its loops double every place.
            Structure::Knitted { knit, yarn } => Slubs {
                spacing: [knit.wales, knit.courses].map(|per| (1.0 / per as f32).clamp(5e-5, 0.02)),
                strength: [0.0, 0.45 * unevenness(yarn.fibre)],
            },
        }
    }

    /// Share of the light, about 1, at a place of the panel through a window `wide` m wide.
    pub fn light(&self, rest: [f64; 2], wide: f32) -> f32 {
        let mut light = 1.0;
        for (k, (spacing, strength)) in self.spacing.iter().zip(self.strength).enumerate() {
            if strength <= 0.0 {
                continue;
            }
            let (across, along) = (rest[k] as f32, rest[1 - k] as f32);
            let level = libm::log2f((wide / spacing).max(1.0)).min(8.0);
            let fine = level.floor();
            let mix = level - fine;
            let threads = |level: f32| {
                let count = libm::exp2f(level);
                let streak = noise(
                    [across / (spacing * count), along / LENGTH],
                    k as u32 * 16 + level as u32,
                );
                streak / count.sqrt()
            };
            light += strength * (threads(fine) * (1.0 - mix) + threads(fine + 1.0) * mix);
        }
        light
    }
}

/// How unevenly a fibre is spun: filaments evenly, bast fibres least so.
fn unevenness(fibre: Fibre) -> f32 {
    match fibre {
        Fibre::Cotton => 0.13,
        Fibre::Linen => 0.28,
        Fibre::Jute => 0.36,
        Fibre::Wool => 0.17,
        Fibre::Silk => 0.08,
        Fibre::Viscose => 0.07,
        Fibre::Polyester | Fibre::Nylon => 0.045,
        Fibre::Metal => 0.04,
    }
}

/// Smooth noise between −1 and 1 on a lattice of unit cells.
fn noise([x, y]: [f32; 2], seed: u32) -> f32 {
    let (i, j) = (x.floor(), y.floor());
    let ease = |t: f32| t * t * (3.0 - 2.0 * t);
    let (s, t) = (ease(x - i), ease(y - j));
    let at = |di: i32, dj: i32| {
        let (i, j) = ((i as i32).wrapping_add(di), (j as i32).wrapping_add(dj));
        let mut bits = (i as u32).wrapping_mul(0x9e37_79b1)
            ^ (j as u32).wrapping_mul(0x85eb_ca77)
            ^ seed.wrapping_mul(0xc2b2_ae3d);
        bits = (bits ^ (bits >> 15)).wrapping_mul(0x2c1b_3c6d);
        bits = (bits ^ (bits >> 13)).wrapping_mul(0x297a_2d39);
        ((bits ^ (bits >> 16)) >> 8) as f32 * (2.0 / 16_777_216.0) - 1.0
    };
    let low = at(0, 0) * (1.0 - s) + at(1, 0) * s;
    let high = at(0, 1) * (1.0 - s) + at(1, 1) * s;
    low * (1.0 - t) + high * t
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn streaks_leave_the_mean_and_fade_with_distance() {
        let slubs = Slubs { spacing: [4e-4; 2], strength: [0.2; 2] };
        let spread = |wide: f32| {
            const COUNT: usize = 20_000;
            let values: Vec<f32> = (0..COUNT)
                .map(|k| slubs.light([k as f64 * 0.000_71, k as f64 * 0.000_37], wide))
                .collect();
            let mean = values.iter().sum::<f32>() / COUNT as f32;
            let square = values.iter().map(|v| (v - mean) * (v - mean)).sum::<f32>();
            (mean, (square / COUNT as f32).sqrt())
        };
        let ((mean, near), (_, far)) = (spread(1e-4), spread(64e-4));
        assert!((mean - 1.0).abs() < 0.01, "{mean}");
        // Sixteen threads in the window: a quarter of the spread.
        assert!((far / near - 0.25).abs() < 0.06, "{near} {far}");
    }
}
