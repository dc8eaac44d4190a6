//! Takes the grain out of the light and leaves the edges.
//!
//! The light is filtered apart from the colours of the cloth, so that threads stay sharp: a few
//! passes of a small kernel whose taps move ever further apart ("à trous"), each tap weighed by
//! how far its normal, its distance and its light agree with the pixel's (H. Dammertz et al. 2010;
//! C. Schied et al. 2017 for the use of the variance).

use super::Light3;
use super::pixel::Pixel;
use rayon::prelude::*;

/// A binomial kernel.
const KERNEL: [f32; 5] = [0.0625, 0.25, 0.375, 0.25, 0.0625];

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
    /// Smooths the light on the figure.
    pub fn smooth(&mut self) {
        self.each(Film::evened);
        for pass in 0..PASSES {
            self.each(|film, at| film.pass(at, 1 << pass));
        }
    }

    /// Replaces every pixel by what is made of it and its neighbours.
    fn each(&mut self, make: impl Fn(&Film, usize) -> Pixel + Sync) {
        let film = &*self;
        let made = (0..film.pixels.len()).into_par_iter().with_min_len(256);
        self.pixels = made.map(|at| make(film, at)).collect();
    }

    /// The variance of few paths is itself uncertain: the mean of the neighbours is taken.
    fn evened(&self, at: usize) -> Pixel {
        let (mut figure, mut shown) = (0.0, 1e-9);
        self.taps(at, 1, |tap, share| {
            figure += tap.grain * share * tap.cover;
            shown += share * tap.cover;
        });
        let mut pixel = self.pixels[at];
        pixel.grain = figure / shown;
        pixel
    }

    /// Hands over the pixels of the kernel about a pixel with their shares.
    #[inline(always)]
    fn taps(&self, at: usize, step: usize, mut take: impl FnMut(&Pixel, f32)) {
        let [width, height] = self.size;
        let (x, y) = (at % width, at / width);
        for (dy, row) in KERNEL.iter().enumerate() {
            let Some(py) = (y + dy * step).checked_sub(2 * step) else { continue };
            if py >= height {
                continue;
            }
            for (dx, column) in KERNEL.iter().enumerate() {
                let Some(px) = (x + dx * step).checked_sub(2 * step) else { continue };
                if px < width {
                    take(&self.pixels[py * width + px], row * column);
                }
            }
        }
    }

    fn pass(&self, at: usize, step: usize) -> Pixel {
        let mut pixel = self.pixels[at];
        if pixel.cover > 0.0 && pixel.grain > 0.0 {
            self.smooth_figure(&mut pixel, at, step);
        }
        pixel
    }

    fn smooth_figure(&self, pixel: &mut Pixel, at: usize, step: usize) {
        let level = |p: &Pixel| (p.matte + p.shine).sum() / 3.0;
        let here = level(pixel);
        let doubt = 1.0 / (TOLERANCE * TOLERANCE * pixel.grain + 1e-8);
        let depth = 1.0 / (0.004 * pixel.distance.max(1e-6));
        let (mut matte, mut shine) = (Light3::zeros(), Light3::zeros());
        let (mut weight, mut grain) = (0.0, 0.0);
        self.taps(at, step, |tap, share| {
            if tap.cover <= 0.0 {
                return;
            }
            let lean = (pixel.normal - tap.normal).norm_squared();
            let behind = (pixel.distance - tap.distance) * depth;
            let light = here - level(tap);
            let edge = pixel.cover - tap.cover;
            let off = lean * 24.0 + behind * behind + light * light * doubt + edge * edge * 8.0;
            let w = share * tap.cover * falling(off);
            matte += tap.matte * w;
            shine += tap.shine * w;
            grain += tap.grain * w * w;
            weight += w;
        });
        if weight > 1e-6 {
            pixel.matte = matte / weight;
            pixel.shine = shine / weight;
            pixel.grain = grain / (weight * weight);
        }
    }
}

/// Falls from 1 at 0 like a bell, by plain arithmetic.
#[inline(always)]
fn falling(off: f32) -> f32 {
    let base = 1.0 / (1.0 + 0.25 * off);
    let square = base * base;
    square * square
}
