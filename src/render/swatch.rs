//! The atlas as it is looked at: colours in linear light, averaged over what a pixel covers.
//!
//! Every region has its own pyramid of ever smaller pictures. Each is averaged over exactly its
//! share of the finer one, round the corner for tiles, so that nothing bleeds from one region into
//! the next. Motifs are averaged in linear light. Threads are not: light that enters one thread
//! leaves through its neighbours, so that white dots between blue threads look darker and bluer
//! than their share says.
//!
//! # References
//! Yule and Nielsen 1951, "The penetration of light into paper and its effect on halftone
//! reproduction": the root of the reflectance is averaged, with n = 2 for fine dots.

use super::{Light3, tone};
use crate::mesh::compiled::{Atlas, Region};
use rayon::prelude::*;

/// Textiles are averaged in the manner of Yule and Nielsen up to this size of texel, m: light
/// wanders about as far as a thread is thick.
const WANDERS: f64 = 0.6e-3;

/// All regions of an atlas.
#[derive(Clone, Debug)]
pub struct Swatches<'a> {
    pixels: &'a [u8],
    width: usize,
    decoded: Vec<f32>,
    swatches: Vec<Option<Swatch>>,
}

/// What is seen of a textile through a small window.
#[derive(Clone, Copy, Debug)]
pub struct Sight {
    /// Mean colour of the threads in it.
    pub colour: Light3,
    /// Share of the window that they cover.
    pub cover: f32,
}

/// One region.
#[derive(Clone, Debug)]
struct Swatch {
    /// Left, top of the finest level in the atlas, pixels.
    corner: [usize; 2],
    /// Width, height of the finest level, pixels.
    extent: [usize; 2],
    /// Extent along u and v, m.
    size: [f64; 2],
    tiles: bool,
    /// Coarser levels, each half as wide and high.
    coarser: Vec<Level>,
    detail: Option<usize>,
    shot: Option<[Light3; 2]>,
    /// Whether anything shows through.
    open: bool,
}

/// One level: colours times cover, and cover, as shares of 65535.
#[derive(Clone, Debug)]
struct Level {
    extent: [usize; 2],
    texels: Vec<[u16; 4]>,
}

impl<'a> Swatches<'a> {
    /// The regions of an atlas. A region that does not lie inside the atlas is left out.
    pub fn of(atlas: &'a Atlas) -> Self {
        let decoded = (0..=255).map(tone::decoded).collect();
        let mut swatches = Swatches {
            pixels: &atlas.pixels,
            width: atlas.width as usize,
            decoded,
            swatches: Vec::new(),
        };
        let all = atlas.width as usize * atlas.height as usize * 4;
        if atlas.pixels.len() == all {
            swatches.swatches = atlas
                .regions
                .par_iter()
                .map(|region| fits(region, atlas).then(|| swatches.swatch(region)))
                .collect();
        } else {
            swatches.swatches = vec![None; atlas.regions.len()];
        }
        swatches
    }

    /// Whether the region is there.
    pub fn has(&self, region: usize) -> bool {
        self.swatches.get(region).is_some_and(Option::is_some)
    }

    /// Whether light comes through between the threads of the region.
    pub fn open(&self, region: usize) -> bool {
        self.swatches.get(region).and_then(Option::as_ref).is_some_and(|swatch| swatch.open)
    }

    /// The colours of warp and weft of a region whose colour turns with the angle.
    pub fn shot(&self, region: usize) -> Option<[Light3; 2]> {
        self.swatches.get(region)?.as_ref()?.shot
    }

    /// What is seen of the region at (`u`, `v`), m from its origin, through a window `wide` m wide.
    pub fn look(&self, region: usize, u: f64, v: f64, wide: f32) -> Sight {
        let Some(Some(swatch)) = self.swatches.get(region) else {
            return Sight { colour: Light3::repeat(0.5), cover: 1.0 };
        };
        let mut sight = self.sight(swatch, u, v, wide);
        if let Some(Some(detail)) = swatch.detail.and_then(|number| self.swatches.get(number)) {
            // Mid grey leaves the colour as it is.
            let relief = self.sight(detail, u, v, wide).colour / self.decoded[128];
            sight.colour.component_mul_assign(&relief);
        }
        sight
    }

    /// The colour of the motif at a place of a region whose threads are drawn apart from it; none
    /// where the threads bring their own colours.
    pub fn motif(&self, region: usize, u: f64, v: f64, wide: f32) -> Option<Light3> {
        let swatch = self.swatches.get(region)?.as_ref()?;
        swatch.detail?;
        Some(self.sight(swatch, u, v, wide).colour)
    }

    fn sight(&self, swatch: &Swatch, u: f64, v: f64, wide: f32) -> Sight {
        let along = [u / swatch.size[0], 1.0 - v / swatch.size[1]];
        let at = along.map(|share| {
            if swatch.tiles { (share - share.floor()) as f32 } else { share.clamp(0.0, 1.0) as f32 }
        });
        let texel = (swatch.size[0] / swatch.extent[0] as f64)
            .min(swatch.size[1] / swatch.extent[1] as f64) as f32;
        let level = libm::log2f((wide / texel).max(1.0)).min(swatch.coarser.len() as f32);
        let fine = level as usize;
        let mix = level - fine as f32;
        let mut sum = self.between(swatch, fine, at);
        if mix > 0.001 {
            let coarse = self.between(swatch, fine + 1, at);
            for (a, b) in sum.iter_mut().zip(coarse) {
                *a += (b - *a) * mix;
            }
        }
        let cover = sum[3];
        let scale = if cover > 1e-4 { 1.0 / cover } else { 0.0 };
        Sight { colour: Light3::new(sum[0], sum[1], sum[2]) * scale, cover }
    }

    /// Between the four nearest texels of a level.
    fn between(&self, swatch: &Swatch, level: usize, at: [f32; 2]) -> [f32; 4] {
        let extent = match level.checked_sub(1).and_then(|k| swatch.coarser.get(k)) {
            Some(coarse) => coarse.extent,
            None => swatch.extent,
        };
        let mut low = [0; 2];
        let mut high = [0; 2];
        let mut mix = [0.0; 2];
        for axis in 0..2 {
            let place = at[axis] * extent[axis] as f32 - 0.5;
            let floor = place.floor();
            mix[axis] = place - floor;
            let last = extent[axis] as i64 - 1;
            let wrap = |k: i64| {
                let k = if swatch.tiles { k.rem_euclid(last + 1) } else { k.clamp(0, last) };
                k as usize
            };
            low[axis] = wrap(floor as i64);
            high[axis] = wrap(floor as i64 + 1);
        }
        let mut sum = [0.0; 4];
        for (x, wx) in [(low[0], 1.0 - mix[0]), (high[0], mix[0])] {
            for (y, wy) in [(low[1], 1.0 - mix[1]), (high[1], mix[1])] {
                let texel = self.texel(swatch, level, x, y);
                for (a, b) in sum.iter_mut().zip(texel) {
                    *a += b * (wx * wy);
                }
            }
        }
        sum
    }

    /// A texel as colour times cover, and cover.
    fn texel(&self, swatch: &Swatch, level: usize, x: usize, y: usize) -> [f32; 4] {
        match level.checked_sub(1).and_then(|k| swatch.coarser.get(k)) {
            Some(coarse) => {
                coarse.texels[y * coarse.extent[0] + x].map(|c| f32::from(c) * (1.0 / 65535.0))
            }
            None => {
                let at = ((swatch.corner[1] + y) * self.width + swatch.corner[0] + x) * 4;
                let [r, g, b, a] = [0, 1, 2, 3].map(|k| self.pixels[at + k]);
                let cover = f32::from(a) * (1.0 / 255.0);
                let light = |byte: u8| self.decoded[byte as usize] * cover;
                [light(r), light(g), light(b), cover]
            }
        }
    }

    /// A region with its coarser levels.
    fn swatch(&self, region: &Region) -> Swatch {
        let [left, top, width, height] = region.pixels.map(|p| p as usize);
        let mut swatch = Swatch {
            corner: [left, top],
            extent: [width, height],
            size: region.size,
            tiles: region.tiles,
            coarser: Vec::new(),
            detail: region.detail,
            shot: region.shot.map(|pair| pair.map(tone::decoded_colour)),
            open: false,
        };
        let mut extent = swatch.extent;
        while extent != [1, 1] {
            let next = extent.map(|n| n.div_ceil(2));
            let level = swatch.coarser.len();
            let texel = (0..2).map(|k| swatch.size[k] / next[k] as f64).fold(0.0, f64::max);
            let fine = texel < WANDERS;
            let columns = shares(extent[0], next[0]);
            let rows = shares(extent[1], next[1]);
            let mut texels = vec![[0; 4]; next[0] * next[1]];
            texels.par_chunks_mut(next[0]).zip(&rows).for_each(|(line, row)| {
                for (texel, column) in line.iter_mut().zip(&columns) {
                    let mut sum = [0.0; 4];
                    for &(y, wy) in row {
                        for &(x, wx) in column {
                            let part = self.texel(&swatch, level, x, y);
                            let part = if fine { root(part) } else { part };
                            for (a, b) in sum.iter_mut().zip(part) {
                                *a += b * (wx * wy);
                            }
                        }
                    }
                    let sum = if fine { square(sum) } else { sum };
                    *texel = sum.map(|c| (c * 65535.0 + 0.5) as u16);
                }
            });
            swatch.coarser.push(Level { extent: next, texels });
            extent = next;
        }
        let whole = match swatch.coarser.last() {
            Some(level) => level.texels[0][3],
            None => (self.texel(&swatch, 0, 0, 0)[3] * 65535.0) as u16,
        };
        swatch.open = whole < 65_500;
        swatch
    }
}

/// A texel with the root of its colour, still times its cover.
fn root([r, g, b, cover]: [f32; 4]) -> [f32; 4] {
    let root = |c: f32| (c * cover).sqrt();
    [root(r), root(g), root(b), cover]
}

/// A texel with the square of its colour, still times its cover.
fn square([r, g, b, cover]: [f32; 4]) -> [f32; 4] {
    let square = |c: f32| if cover > 0.0 { c * c / cover } else { 0.0 };
    [square(r), square(g), square(b), cover]
}

/// Whether the region lies inside the atlas and has an extent.
fn fits(region: &Region, atlas: &Atlas) -> bool {
    let [left, top, width, height] = region.pixels.map(u64::from);
    width > 0
        && height > 0
        && left + width <= u64::from(atlas.width)
        && top + height <= u64::from(atlas.height)
        && region.size.iter().all(|extent| extent.is_finite() && *extent > 0.0)
}

/// For each of `to` texels the finer ones of `from` that it covers, with their shares.
fn shares(from: usize, to: usize) -> Vec<Vec<(usize, f32)>> {
    let scale = from as f64 / to as f64;
    (0..to)
        .map(|k| {
            let (start, end) = (k as f64 * scale, (k + 1) as f64 * scale);
            let last = (end.ceil() as usize).min(from);
            (start as usize..last)
                .map(|x| {
                    let covered = end.min((x + 1) as f64) - start.max(x as f64);
                    (x, (covered / scale) as f32)
                })
                .filter(|(_, share)| *share > 0.0)
                .collect()
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A region of 7 × 5 pixels in an atlas of 9 × 7, red to the right, green upwards.
    fn atlas(tiles: bool) -> Atlas {
        let mut pixels = vec![0; 9 * 7 * 4];
        for y in 0..5_usize {
            for x in 0..7_usize {
                let at = ((y + 1) * 9 + x + 1) * 4;
                pixels[at] = (x * 40) as u8;
                pixels[at + 1] = ((4 - y) * 60) as u8;
                pixels[at + 3] = 255;
            }
        }
        let region = Region {
            name: "linen.face".to_owned(),
            pixels: [1, 1, 7, 5],
            size: [0.007, 0.005],
            tiles,
            detail: None,
            shot: None,
        };
        Atlas { width: 9, height: 7, pixels, regions: vec![region] }
    }

    #[test]
    fn u_runs_to_the_right_and_v_upwards() {
        let atlas = atlas(false);
        let swatches = Swatches::of(&atlas);
        let right = swatches.look(0, 0.0065, 0.0005, 0.0001).colour;
        let top = swatches.look(0, 0.0005, 0.0045, 0.0001).colour;
        assert!((right.x - tone::decoded(240)).abs() < 1e-3 && right.y < 1e-3);
        assert!((top.y - tone::decoded(240)).abs() < 1e-3 && top.x < 1e-3);
    }

    #[test]
    fn from_afar_the_mean_of_the_light_is_seen() {
        let mean = (0..7).map(|x| tone::decoded(x * 40)).sum::<f32>() / 7.0;
        for tiles in [false, true] {
            let atlas = atlas(tiles);
            let swatches = Swatches::of(&atlas);
            for u in [0.0, 0.0021, 0.0069] {
                let far = swatches.look(0, u, 0.001, 0.1);
                // 16 bits a level, and half a step of rounding on each of three levels.
                assert!((far.colour.x - mean).abs() < 1e-4, "{} {mean}", far.colour.x);
                assert!((far.cover - 1.0).abs() < 1e-4);
            }
        }
        assert!(!Swatches::of(&atlas(true)).open(0));
    }

    #[test]
    fn a_tile_repeats() {
        let atlas = atlas(true);
        let swatches = Swatches::of(&atlas);
        let once = swatches.look(0, 0.0031, 0.0012, 0.001).colour;
        let again = swatches.look(0, 0.0031 - 0.021, 0.0012 + 0.010, 0.001).colour;
        assert!((once - again).norm() < 1e-4);
    }

    #[test]
    fn a_region_outside_the_atlas_is_left_out() {
        let mut atlas = atlas(true);
        atlas.regions[0].pixels = [4, 1, 7, 5];
        assert!(!Swatches::of(&atlas).has(0));
        atlas.pixels.clear();
        assert!(!Swatches::of(&atlas).has(0));
    }
}
