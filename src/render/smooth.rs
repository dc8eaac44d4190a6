//! Takes the grain out of the light and leaves the edges.
//!
//! The light is filtered apart from the colours of the cloth, so that threads stay sharp: a few
//! passes of a small kernel whose taps move ever further apart ("à trous"), each tap weighed by
//! how far its normal, its distance and its light agree with the pixel's (H. Dammertz et al. 2010;
//! C. Schied et al. 2017 for the use of the variance).

use super::Light3;
use super::pixel::Pixel;
use rayon::prelude::*;

/// Half of a binomial kernel of five.
const KERNEL: [f32; 3] = [0.375, 0.25, 0.0625];

/// Passes; the taps of the last lie 2^(passes − 1) pixels apart.
const PASSES: u32 = 4;

/// Differences of light count against so many deviations of the grain.
const TOLERANCE: f32 = 3.0;

/// A picture of pixels, row by row.
pub struct Film {
    /// Width and height.
    pub size: [usize; 2],
    /// The pixels.
    pub pixels: Vec<Pixel>,
}

impl Film {
    /// Smooths the light on the figure and the shadows on the floor.
    pub fn smooth(&mut self) {
        self.even_grain();
        for pass in 0..PASSES {
            let step = 1 << pass;
            let film = &*self;
            let width = film.size[0];
            let smoothed: Vec<Pixel> = (0..film.pixels.len())
                .into_par_iter()
                .map(|at| film.pass(at % width, at / width, step))
                .collect();
            self.pixels = smoothed;
        }
    }

    /// The variance of few paths is itself uncertain: the mean of the neighbours is taken.
    fn even_grain(&mut self) {
        let film = &*self;
        let width = film.size[0];
        let evened: Vec<[f32; 2]> = (0..film.pixels.len())
            .into_par_iter()
            .map(|at| {
                let (mut sum, mut weight) = ([0.0; 2], [1e-9; 2]);
                for (pixel, share) in film.taps(at % width, at / width, 1) {
                    let shares = [share * pixel.cover, share * (1.0 - pixel.cover)];
                    for (k, grain) in [pixel.grain, pixel.shadow_grain].into_iter().enumerate() {
                        sum[k] += grain * shares[k];
                        weight[k] += shares[k];
                    }
                }
                [sum[0] / weight[0], sum[1] / weight[1]]
            })
            .collect();
        for (pixel, [grain, shadow]) in self.pixels.iter_mut().zip(evened) {
            pixel.grain = grain;
            pixel.shadow_grain = shadow;
        }
    }

    /// The pixels of the kernel about (`x`, `y`) with their shares.
    fn taps(&self, x: usize, y: usize, step: i64) -> impl Iterator<Item = (&Pixel, f32)> {
        let [width, height] = self.size.map(|n| n as i64);
        (-2..=2_i64).flat_map(move |dy| {
            (-2..=2_i64).filter_map(move |dx| {
                let (px, py) = (x as i64 + dx * step, y as i64 + dy * step);
                let inside = (0..width).contains(&px) && (0..height).contains(&py);
                let share = KERNEL[dx.unsigned_abs() as usize] * KERNEL[dy.unsigned_abs() as usize];
                inside.then(|| (&self.pixels[(py * width + px) as usize], share))
            })
        })
    }

    fn pass(&self, x: usize, y: usize, step: i64) -> Pixel {
        let mut pixel = self.pixels[y * self.size[0] + x];
        if pixel.cover > 0.0 && pixel.grain > 0.0 {
            self.smooth_figure(&mut pixel, x, y, step);
        }
        if pixel.cover < 1.0 && pixel.shadow_grain > 0.0 {
            self.smooth_floor(&mut pixel, x, y, step);
        }
        pixel
    }

    fn smooth_figure(&self, pixel: &mut Pixel, x: usize, y: usize, step: i64) {
        let level = |p: &Pixel| (p.matte + p.shine).sum() / 3.0;
        let here = level(pixel);
        let spread = TOLERANCE * pixel.grain.sqrt() + 1e-4;
        let (mut matte, mut shine) = (Light3::zeros(), Light3::zeros());
        let (mut weight, mut grain) = (0.0, 0.0);
        for (tap, share) in self.taps(x, y, step) {
            if tap.cover <= 0.0 {
                continue;
            }
            let lean = (pixel.normal - tap.normal).norm_squared();
            let depth = (pixel.distance - tap.distance) / (0.004 * pixel.distance);
            let light = (here - level(tap)) / spread;
            let edge = pixel.cover - tap.cover;
            let off = lean * 24.0 + depth * depth + light * light + edge * edge * 8.0;
            let w = share * tap.cover * falling(off);
            matte += tap.matte * w;
            shine += tap.shine * w;
            grain += tap.grain * w * w;
            weight += w;
        }
        if weight > 1e-6 {
            pixel.matte = matte / weight;
            pixel.shine = shine / weight;
            pixel.grain = grain / (weight * weight);
        }
    }

    fn smooth_floor(&self, pixel: &mut Pixel, x: usize, y: usize, step: i64) {
        let level = |p: &Pixel| p.shadow.sum() / 3.0;
        let here = level(pixel);
        let spread = TOLERANCE * pixel.shadow_grain.sqrt() + 1e-4;
        let mut shadow = Light3::zeros();
        let (mut weight, mut grain) = (0.0, 0.0);
        for (tap, share) in self.taps(x, y, step) {
            let light = (here - level(tap)) / spread;
            let w = share * (1.0 - tap.cover) * falling(light * light);
            shadow += tap.shadow * w;
            grain += tap.shadow_grain * w * w;
            weight += w;
        }
        if weight > 1e-6 {
            pixel.shadow = shadow / weight;
            pixel.shadow_grain = grain / (weight * weight);
        }
    }
}

/// Falls from 1 at 0 like a bell, by plain arithmetic.
fn falling(off: f32) -> f32 {
    let base = 1.0 / (1.0 + 0.25 * off);
    let square = base * base;
    square * square
}
