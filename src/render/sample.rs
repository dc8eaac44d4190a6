//! Numbers that are spread evenly over a pixel, a lamp, a hemisphere.
//!
//! A Sobol sequence in pairs of dimensions, scrambled after Owen by hashing: L. Burley,
//! "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020. Every pixel and every pair has a
//! scramble of its own, so that a pixel's numbers depend on nothing but its place.

use super::Vector;
use std::f32::consts::PI;

/// The numbers of one path.
#[derive(Clone, Copy, Debug)]
pub struct Sampler {
    seed: u32,
    path: u32,
    pair: u32,
}

impl Sampler {
    /// Numbers of path `path` of `paths` of the pixel (`x`, `y`) of the view `view`.
    ///
    /// Blocks of 4 × 4 pixels share one sequence, each pixel with a stretch of its own, nearest
    /// pixels with neighbouring stretches: not only a pixel's paths but also those of its
    /// neighbourhood are spread evenly, so that little grain is left to be smoothed.
    pub fn new(view: u32, [x, y]: [u32; 2], path: u32, paths: u32) -> Self {
        let seed = mixed(mixed(mixed(view ^ 0x9e37_79b9) ^ (x >> 2)) ^ (y >> 2));
        let stretch = (x & 1) | (y & 1) << 1 | (x & 2) << 1 | (y & 2) << 2;
        let length = paths.clamp(1, 1 << 20).next_power_of_two();
        Sampler { seed, path: stretch * length + path, pair: 0 }
    }

    /// The next pair, each from 0 up to but not including 1.
    pub fn pair(&mut self) -> [f32; 2] {
        self.pair = self.pair.wrapping_add(1);
        let seed = mixed(self.seed ^ self.pair.wrapping_mul(0x85eb_ca6b));
        let place = scrambled(self.path, seed);
        let x = scrambled(place.reverse_bits(), mixed(seed ^ 0x68bc_21eb));
        let y = scrambled(second(place), mixed(seed ^ 0x02e5_be93));
        [share(x), share(y)]
    }
}

/// The number as a share of the whole range.
fn share(bits: u32) -> f32 {
    (bits >> 8) as f32 * (1.0 / 16_777_216.0)
}

/// The second dimension of Sobol's sequence: its matrix is Pascal's triangle modulo 2, applied
/// here as sums over the bit numbers that contain a given one.
fn second(place: u32) -> u32 {
    let mut bits = place;
    for (shift, mask) in
        [(1, 0x5555_5555), (2, 0x3333_3333), (4, 0x0f0f_0f0f), (8, 0x00ff_00ff), (16, 0x0000_ffff)]
    {
        bits ^= (bits >> shift) & mask;
    }
    bits.reverse_bits()
}

/// Owen's scramble of a binary fraction by the hash of Laine and Karras (Burley 2020, section 4).
fn scrambled(bits: u32, seed: u32) -> u32 {
    let mut x = bits.reverse_bits();
    x = x.wrapping_add(seed);
    for factor in [0x6c50_b47c_u32, 0xb82f_1e52, 0xc7af_e638, 0x8d22_f6e6] {
        x ^= x.wrapping_mul(factor);
    }
    x.reverse_bits()
}

/// Well mixed bits.
fn mixed(bits: u32) -> u32 {
    let mut x = bits;
    x = (x ^ (x >> 16)).wrapping_mul(0x7feb_352d);
    x = (x ^ (x >> 15)).wrapping_mul(0x846c_a68b);
    x ^ (x >> 16)
}

/// A direction about `normal`, as dense as its cosine with it.
pub fn cosine_about(normal: &Vector, pair: [f32; 2]) -> Vector {
    let [x, y] = disc(pair);
    let z = (1.0 - x * x - y * y).max(0.0).sqrt();
    let (side, up) = frame(normal);
    side * x + up * y + normal * z
}

/// A point of the unit disc (P. Shirley and K. Chiu 1997, concentric map).
pub fn disc(pair: [f32; 2]) -> [f32; 2] {
    let (x, y) = (2.0 * pair[0] - 1.0, 2.0 * pair[1] - 1.0);
    if x == 0.0 && y == 0.0 {
        return [0.0, 0.0];
    }
    let (radius, angle) = if x.abs() > y.abs() {
        (x, PI / 4.0 * (y / x))
    } else {
        (y, PI / 2.0 - PI / 4.0 * (x / y))
    };
    [radius * libm::cosf(angle), radius * libm::sinf(angle)]
}

/// Two unit vectors that stand on `normal` and on each other (T. Duff et al. 2017).
pub fn frame(normal: &Vector) -> (Vector, Vector) {
    let sign = if normal.z >= 0.0 { 1.0 } else { -1.0 };
    let a = -1.0 / (sign + normal.z);
    let b = normal.x * normal.y * a;
    (
        Vector::new(1.0 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x),
        Vector::new(b, sign + normal.y * normal.y * a, -normal.y),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sixteen_paths_fill_each_of_sixteen_fields_once() {
        // A (0, 2) sequence in base 2: any 4 × 4, 16 × 1 or 1 × 16 division holds one each.
        for (x, y) in [(3, 8), (100, 7)] {
            for (columns, rows) in [(4, 4), (16, 1), (1, 16), (8, 2)] {
                let mut count = [0; 16];
                for path in 0..16 {
                    let mut sampler = Sampler::new(0, [x, y], path, 16);
                    sampler.pair();
                    let [u, v] = sampler.pair();
                    let column = (u * columns as f32) as usize;
                    let row = (v * rows as f32) as usize;
                    count[row * columns + column] += 1;
                }
                assert_eq!(count, [1; 16], "{columns} × {rows}");
            }
        }
    }

    #[test]
    fn neighbours_fill_each_others_gaps() {
        let mut count = [0; 256];
        for pixel in 0..16 {
            for path in 0..16 {
                let mut sampler = Sampler::new(0, [40 + pixel % 4, 20 + pixel / 4], path, 16);
                let [u, v] = sampler.pair();
                count[(u * 16.0) as usize * 16 + (v * 16.0) as usize] += 1;
            }
        }
        assert_eq!(count, [1; 256]);
    }

    #[test]
    fn cosine_directions_have_the_mean_cosine_of_two_thirds() {
        let normal = Vector::new(0.36, 0.48, -0.8);
        let sum: f32 = (0..1024)
            .map(|path| {
                cosine_about(&normal, Sampler::new(1, [2, 3], path, 1024).pair()).dot(&normal)
            })
            .sum();
        // The integrand is smooth; 1024 evenly spread points leave an error far below 1/√1024.
        assert!((sum / 1024.0 - 2.0 / 3.0).abs() < 0.005, "{}", sum / 1024.0);
    }
}
