//! What the paths of one pixel saw, summed and set apart: figure and paper, colour and light.

use super::camera::Camera;
use super::sample::Sampler;
use super::trace::{Seen, Tracer};
use super::{Light3, Vector};

/// One pixel.
#[derive(Clone, Copy, Debug)]
pub struct Pixel {
    /// Share of its paths that met the figure.
    pub cover: f32,
    /// Mean own colour of the figure there.
    pub colour: Light3,
    /// Mean matte light there, as from a white surface; weighed by the colours.
    pub matte: Light3,
    /// Mean light mirrored there.
    pub shine: Light3,
    /// Mean normal; not of unit length where it varies.
    pub normal: Vector,
    /// Mean distance from the eye, m.
    pub distance: f32,
    /// Variance of the mean of the matte and the mirrored light.
    pub grain: f32,
}

/// Paths that tell whether a pixel shows nothing but paper.
const BARE: u32 = 4;

impl Pixel {
    /// Follows the paths of the pixel (`x`, `y`) of a picture of `size` pixels; `view` is its
    /// number on the sheet.
    pub fn traced(
        tracer: &mut Tracer,
        camera: &Camera,
        view: u32,
        [x, y]: [u32; 2],
        size: [u32; 2],
        paths: u32,
    ) -> Self {
        let spread = (camera.window[3] - camera.window[1]) / size[1].max(1) as f32;
        let mut sum = Sum::default();
        let mut path = 0;
        while path < paths {
            let mut sampler = Sampler::new(view, [x, y], path, paths);
            let [dx, dy] = sampler.pair();
            let (dx, dy) = (tent(dx), tent(dy));
            let at_x = (x as f32 + dx) / size[0] as f32;
            let at_y = (y as f32 + dy) / size[1] as f32;
            sum.add(&tracer.path(&camera.ray(at_x, at_y), spread, &mut sampler));
            path += 1;
            if path == BARE && sum.figure == 0 {
                break;
            }
        }
        sum.mean(path)
    }

    /// The light of the finished pixel before paper of that light.
    pub fn light(&self, behind: &Light3) -> Light3 {
        self.own_light() * self.cover + behind * (1.0 - self.cover)
    }

    /// The light of what covers it.
    pub fn own_light(&self) -> Light3 {
        self.colour.component_mul(&self.matte) + self.shine
    }
}

/// A number from 0 to 1 as an offset within a pixel: a tent of two pixels' width, which keeps
/// edges smooth without blurring them.
fn tent(share: f32) -> f32 {
    let offset = if share < 0.5 {
        (2.0 * share).sqrt() - 1.0
    } else {
        1.0 - (2.0 - 2.0 * share).max(0.0).sqrt()
    };
    0.5 + 0.75 * offset
}

/// Sums over the paths of a pixel.
#[derive(Default)]
struct Sum {
    figure: u32,
    colour: Light3,
    lit: Light3,
    plain: Light3,
    shine: Light3,
    normal: Vector,
    distance: f32,
    level: f32,
    square: f32,
}

impl Sum {
    fn add(&mut self, seen: &Seen) {
        match seen {
            Seen::Figure(seeing) => {
                self.figure += 1;
                self.colour += seeing.colour;
                self.lit += seeing.colour.component_mul(&seeing.matte);
                self.plain += seeing.matte;
                self.shine += seeing.shine;
                self.normal += seeing.normal;
                self.distance += seeing.distance;
                let level = (seeing.matte + seeing.shine).sum() / 3.0;
                self.level += level;
                self.square += level * level;
            }
            Seen::Paper => {}
        }
    }

    fn mean(&self, paths: u32) -> Pixel {
        let count = (self.figure as f32).max(1.0);
        let colour = self.colour / count;
        let plain = self.plain / count;
        let lit = self.lit / count;
        // Light over colour; where there is no colour, the light alone.
        let mut matte = lit;
        for k in 0..3 {
            matte[k] = if colour[k] > 1e-4 { lit[k] / colour[k] } else { plain[k] };
        }
        let level = self.level / count;
        Pixel {
            cover: self.figure as f32 / paths.max(1) as f32,
            colour,
            matte,
            shine: self.shine / count,
            normal: self.normal / count,
            distance: self.distance / count,
            grain: (self.square / count - level * level).max(0.0) / count,
        }
    }
}
