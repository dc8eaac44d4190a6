//! Fixed chance: numbers that depend on nothing but their place, so that every run draws the
//! same thread, and lattices of them that close round a tile.

/// A well mixed number from a seed and a place on a lattice.
pub fn hash(seed: u32, a: u32, b: u32) -> u32 {
    let mut mixed = seed.wrapping_mul(0x9e37_79b1)
        ^ a.wrapping_mul(0x85eb_ca77)
        ^ b.wrapping_mul(0xc2b2_ae3d).rotate_left(13);
    mixed = (mixed ^ (mixed >> 15)).wrapping_mul(0x2c1b_3c6d);
    mixed = (mixed ^ (mixed >> 12)).wrapping_mul(0x297a_2d39);
    mixed ^ (mixed >> 15)
}

/// From 0 up to, but not, 1.
pub fn chance(seed: u32, a: u32, b: u32) -> f32 {
    (hash(seed, a, b) >> 8) as f32 / 16_777_216.0
}

/// From −1 to 1, the mean 0.
pub fn signed(seed: u32, a: u32, b: u32) -> f32 {
    2.0 * chance(seed, a, b) - 1.0
}

/// Smooth step from 0 to 1 over 0 to 1.
pub fn ease(t: f32) -> f32 {
    let t = t.clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// The lattice points on both sides of `x`, counted round `period`, and how far between them `x`
/// lies.
fn between(x: f32, period: u32) -> (u32, u32, f32) {
    let cut = x as i32;
    let cell = cut.wrapping_sub(i32::from(cut as f32 > x));
    let period = period.clamp(1, i32::MAX as u32);
    let low = cell.rem_euclid(period as i32) as u32;
    let high = if low + 1 == period { 0 } else { low + 1 };
    (low, high, ease(x - cell as f32))
}

/// Smooth noise along a line that closes after `period` lattice points; from −1 to 1.
pub fn line(seed: u32, x: f32, period: u32) -> f32 {
    let (low, high, t) = between(x, period);
    signed(seed, low, 0) * (1.0 - t) + signed(seed, high, 0) * t
}

/// Smooth noise over a plane that closes after `period` lattice points each way; from −1 to 1.
pub fn plane(seed: u32, x: f32, y: f32, period: [u32; 2]) -> f32 {
    let (left, right, s) = between(x, period[0]);
    let (low, high, t) = between(y, period[1]);
    let below = signed(seed, left, low) * (1.0 - s) + signed(seed, right, low) * s;
    let above = signed(seed, left, high) * (1.0 - s) + signed(seed, right, high) * s;
    below * (1.0 - t) + above * t
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lattices_close_round_their_period() {
        for step in 0..40 {
            let x = step as f32 * 0.375;
            assert_eq!(line(3, x, 5), line(3, x + 5.0, 5));
            assert_eq!(plane(3, x, 1.25, [5, 7]), plane(3, x + 5.0, 8.25, [5, 7]));
        }
    }

    #[test]
    fn chance_is_even() {
        let n = 10_000;
        let sum: f64 = (0..n).map(|i| f64::from(chance(1, i % 100, i / 100))).sum();
        // The mean of n even numbers strays by √(1 / 12 n) = 0.0029; five times that is enough.
        assert!((sum / f64::from(n) - 0.5).abs() < 0.0145);
    }
}
