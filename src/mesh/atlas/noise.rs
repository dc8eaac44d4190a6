//! Fixed chance: numbers that depend on nothing but their place, so that every run draws the
//! same thread, and lattices of them that close round a tile.

/// A well mixed number from a seed and a place on a lattice.
pub fn hash(seed: u32, a: u32, b: u32) -> u32 {
    let mut mixed = seed.wrapping_mul(0x9e37_79b1) ^ a.wrapping_mul(0x85eb_ca77);
    mixed = (mixed ^ (mixed >> 15)).wrapping_mul(0x2c1b_3c6d) ^ b.wrapping_mul(0xc2b2_ae3d);
    mixed = (mixed ^ (mixed >> 12)).wrapping_mul(0x297a_2d39);
    mixed = (mixed ^ (mixed >> 15)).wrapping_mul(0x85eb_ca6b);
    mixed ^ (mixed >> 16)
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

/// Smooth noise along a line that closes after `period` lattice points; from −1 to 1.
pub fn line(seed: u32, x: f32, period: u32) -> f32 {
    let cell = x.floor();
    let at = |n: i64| signed(seed, n.rem_euclid(i64::from(period.max(1))) as u32, 0);
    let n = cell as i64;
    let t = ease(x - cell);
    at(n) * (1.0 - t) + at(n + 1) * t
}

/// Smooth noise over a plane that closes after `period` lattice points each way; from −1 to 1.
pub fn plane(seed: u32, x: f32, y: f32, period: [u32; 2]) -> f32 {
    let (column, row) = (x.floor(), y.floor());
    let at = |dx: i64, dy: i64| {
        let i = (column as i64 + dx).rem_euclid(i64::from(period[0].max(1))) as u32;
        let j = (row as i64 + dy).rem_euclid(i64::from(period[1].max(1))) as u32;
        signed(seed, i, j)
    };
    let (s, t) = (ease(x - column), ease(y - row));
    let low = at(0, 0) * (1.0 - s) + at(1, 0) * s;
    let high = at(0, 1) * (1.0 - s) + at(1, 1) * s;
    low * (1.0 - t) + high * t
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
