//! Cloth that is longer than what it is sewn to, a flounce or a gathered skirt: it begins in waves,
//! so that its edge is as long as its partner's and the cloth itself not compressed.
//!
//! The waves are sine-generated curves, whose heading is a sine of the way along them (Langbein and
//! Leopold 1966): they keep the length of the cloth exactly.

use std::f64::consts::TAU;

/// Length of cloth in one wave, m: eight cells of the coarsest grid.
const WAVE: f64 = 0.22;
/// Steps in which a wave is added up.
const STEPS: usize = 256;
/// Cloth less than this many times as long begins without waves.
const LEAST: f64 = 1.15;
/// Greatest heading, rad: at more a wave would touch its neighbour.
const STEEPEST: f64 = 2.0;

/// Waves along cloth of some length.
#[derive(Clone, Debug)]
pub(super) struct Ripple {
    /// Length of cloth in one wave, m.
    wave: f64,
    /// Way on and to the side at each step of a wave, as shares of its length.
    table: Vec<[f64; 2]>,
}

impl Ripple {
    /// Waves by which `length` of cloth, m, goes into a `share` of it, closing round; `None` if it
    /// fits as it is.
    pub(super) fn new(length: f64, share: f64) -> Option<Ripple> {
        if !(share > 0.0 && share * LEAST < 1.0 && length > WAVE) {
            return None;
        }
        let (mut low, mut high) = (0.0, STEEPEST);
        for _ in 0..50 {
            let middle = 0.5 * (low + high);
            if table(middle)[STEPS][0] > share { low = middle } else { high = middle }
        }
        Some(Ripple { wave: length / (length / WAVE).round(), table: table(low) })
    }

    /// The share of its length that the cloth takes up.
    pub(super) fn share(&self) -> f64 {
        self.table[STEPS][0]
    }

    /// Where a place `x` along the cloth lies: how far on, and how far outwards from the innermost
    /// place of a wave, m.
    pub(super) fn at(&self, x: f64) -> [f64; 2] {
        let turns = (x / self.wave).floor();
        let t = (x / self.wave - turns) * STEPS as f64;
        let k = (t as usize).min(STEPS - 1);
        let (a, b) = (self.table[k], self.table[k + 1]);
        let on = a[0] + (t - k as f64) * (b[0] - a[0]);
        let out = a[1] + (t - k as f64) * (b[1] - a[1]);
        [(turns * self.share() + on) * self.wave, out * self.wave]
    }
}

/// One wave whose heading turns by as much as `steepest` either way. It begins at its innermost.
fn table(steepest: f64) -> Vec<[f64; 2]> {
    let mut table = vec![[0.0; 2]];
    let (mut on, mut out) = (0.0, 0.0);
    for k in 0..STEPS {
        let heading = steepest * libm::sin(TAU * (k as f64 + 0.5) / STEPS as f64);
        on += libm::cos(heading) / STEPS as f64;
        out += libm::sin(heading) / STEPS as f64;
        table.push([on, out]);
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The share is the Bessel function J0 of the steepest heading: J0(1.5211) = 0.5, so half the
    /// length; and the cloth keeps its length.
    #[test]
    fn waves_take_the_share_asked_for_and_keep_the_length() {
        let ripple = Ripple::new(3.3, 0.5).unwrap();
        assert!((ripple.share() - 0.5).abs() < 1e-9);
        assert!((table(1.521_145)[STEPS][0] - 0.5).abs() < 1e-5);
        let steps = 10_000;
        let mut length = 0.0;
        for k in 0..steps {
            let (a, b) = (3.3 * k as f64 / steps as f64, 3.3 * (k + 1) as f64 / steps as f64);
            let (p, q) = (ripple.at(a), ripple.at(b));
            length += libm::hypot(q[0] - p[0], q[1] - p[1]);
        }
        assert!((length / 3.3 - 1.0).abs() < 1e-4, "{length}");
        let [on, out] = ripple.at(3.3);
        assert!((on - 1.65).abs() < 1e-6 && out.abs() < 1e-6, "it closes after a whole round");
        assert!(Ripple::new(3.3, 0.95).is_none());
    }
}
