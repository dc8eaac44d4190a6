//! From strands to the pixels of a tile: ply and fibre, the shading of a thread by its roundness
//! and by what lies over it, gaps, and the right mean colour.

use super::noise;
use super::strand::{GAP, Seen, Strand, lay};
use crate::textile::Colour;
use crate::textile::yarn::{Fibre, Twist, Yarn};
use rayon::prelude::*;

/// Samples of the field to a pixel of the tile, each way.
pub const FINE: usize = 2;

/// The field on which a tile is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Grid {
    /// Samples across.
    pub width: usize,
    /// Samples upwards.
    pub height: usize,
}

/// How the surface of a yarn looks.
#[derive(Clone, Copy, Debug)]
pub struct Look {
    /// Colour in linear light.
    pub light: [f32; 3],
    /// Strands twisted together.
    pub plies: u32,
    /// Whole turns of the twist over one tile.
    pub turns: u32,
    /// Z or S: the slope of the helix.
    pub slant: f32,
    /// Depth of the lines between plies.
    pub ply_depth: f32,
    /// Contrast of single fibres.
    pub fibre: f32,
    /// Contrast from thread to thread.
    pub uneven: f32,
}

impl Look {
    /// The look of `length` m of this yarn in this colour.
    pub fn of(yarn: &Yarn, colour: Colour, length: f64) -> Look {
        let (fibre, uneven) = match yarn.fibre {
            Fibre::Cotton | Fibre::Viscose => (0.16, 0.05),
            Fibre::Linen | Fibre::Jute => (0.24, 0.10),
            Fibre::Wool => (0.24, 0.07),
            Fibre::Silk => (0.10, 0.04),
            Fibre::Polyester | Fibre::Nylon => (0.08, 0.03),
            Fibre::Metal => (0.22, 0.08),
        };
        let turns = (yarn.twist.max(0.0) * length).min(1e5);
        Look {
            light: colour.linear().map(|value| value as f32),
            plies: yarn.plies.clamp(1, 6),
            turns: turns.round() as u32,
            slant: if yarn.direction == Twist::Z { 1.0 } else { -1.0 },
            ply_depth: if yarn.plies > 1 { 0.30 } else { 0.0 },
            fibre,
            uneven,
        }
    }
}

/// How a tile is shaded.
#[derive(Clone, Copy, Debug)]
pub struct Shading {
    /// Size of a thread, samples: the scale of the shadows.
    pub thread: f32,
    /// Depth of thread-scale shading, 0 to 1.
    pub relief: f32,
    /// Fuzz of a raised or woollen surface, 0 to 1.
    pub fuzz: f32,
}

/// Lays the strands and shades them: sRGB and opacity, top row first, `4 · width · height /
/// FINE²` bytes. `yarns` are the looks that [`Strand::yarn`] counts, `grid`
/// a multiple of [`FINE`] each way.
pub fn draw(strands: &[Strand], yarns: &[Look], grid: Grid, shading: Shading) -> Vec<u8> {
    let field = lay(strands, grid.width, grid.height);
    let heights = levels(&field);
    let near = blurred(&heights, grid, (0.45 * shading.thread) as usize);
    let wide = blurred(&heights, grid, (1.1 * shading.thread) as usize);
    let (lowest, highest) = heights
        .iter()
        .fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), &h| (low.min(h), high.max(h)));
    let depth = (0.34 * (highest - lowest)).max(1e-3);
    let mut shades = vec![0f32; field.len()];
    shades.par_chunks_mut(FINE * grid.width).enumerate().for_each(|(line, shades)| {
        let first = line * FINE * grid.width;
        for column in 0..grid.width / FINE {
            // What does not change within a pixel is found once for it.
            let place = [
                (column * FINE) as f32 / grid.width as f32,
                (line * FINE) as f32 / grid.height as f32,
            ];
            let fuzz = fuzz(place, grid, shading);
            let mut known: Option<(u32, f32)> = None;
            for sample in 0..FINE * FINE {
                let within = sample / FINE * grid.width + column * FINE + sample % FINE;
                let n = first + within;
                let seen = field[n];
                if seen.height == GAP {
                    continue;
                }
                let skin = match known {
                    Some((strand, skin)) if strand == seen.strand => skin,
                    _ => {
                        let strand = seen.strand as usize;
                        let share = seen.along / strands[strand].length;
                        skin(&yarns[strands[strand].yarn], seen.strand, share, seen.across)
                    }
                };
                known = Some((seen.strand, skin));
                let round = 1.0 - 0.5 * seen.across * seen.across;
                let over = (0.6 * (near[n] - heights[n]) + 0.7 * (wide[n] - heights[n])) / depth;
                let shadow = 1.0 - 0.75 * noise::ease(over + 0.12) + 0.12 * (-over).clamp(0.0, 1.0);
                let formed = 1.0 + shading.relief * (round * shadow - 1.0);
                shades[within] = (formed * skin * fuzz).max(0.05);
            }
        }
    });
    expose(&field, strands, yarns, &shades, grid)
}

/// Ply lines and fibres of a yarn's surface, about 1.
fn skin(look: &Look, strand: u32, share: f32, across: f32) -> f32 {
    // The angle from the top of the strand in half circumferences, by the first terms of the
    // arc sine.
    let angle = across * (1.0 + across * across * (0.19 + 0.19 * across * across)) * 0.34;
    let turned = share * look.turns as f32 * 2.0 + look.slant * angle;
    let ply = if look.ply_depth > 0.0 {
        let phase = turned * 0.5 * look.plies as f32;
        let valley = 2.0 * (phase - phase.floor() - 0.5).abs();
        // A groove is narrow, a ply is broad.
        look.ply_depth * (0.35 - valley * valley * valley)
    } else {
        0.0
    };
    const AROUND: u32 = 16;
    let cells = (look.turns / 2).max(8);
    let seed = 0x5eed ^ strand;
    let around = turned * 0.5 * AROUND as f32;
    let fibre = noise::plane(seed, around, share * cells as f32, [AROUND, cells]);
    let tone = noise::signed(0x70e, strand, 0);
    let slow = noise::line(seed ^ 0xabc, share * 5.0, 5);
    1.0 + ply + look.fibre * fibre + look.uneven * (0.7 * tone + 0.5 * slow)
}

/// Short fibres that stand off a raised surface, about 1.
fn fuzz(place: [f32; 2], grid: Grid, shading: Shading) -> f32 {
    if shading.fuzz <= 0.0 {
        return 1.0;
    }
    let cells = |samples: usize, size: f32| ((samples as f32 / size) as u32).max(1);
    let mut sum = 0.0;
    for (seed, size, weight) in [(91, 7.0, 0.5), (92, 3.0, 0.5)] {
        let period = [cells(grid.width, size), cells(grid.height, size)];
        let [x, y] = [place[0] * period[0] as f32, place[1] * period[1] as f32];
        sum += weight * noise::plane(seed, x, y, period);
    }
    1.0 + 0.35 * shading.fuzz * sum
}

/// Heights with the gaps as low as the lowest strand.
fn levels(field: &[Seen]) -> Vec<f32> {
    let mut lowest = f32::INFINITY;
    for seen in field {
        if seen.height > GAP {
            lowest = lowest.min(seen.height);
        }
    }
    let floor = if lowest.is_finite() { lowest } else { 0.0 };
    field.iter().map(|seen| seen.height.max(floor)).collect()
}

/// The mean over a square of `2 · radius + 1` samples, round the edges of the field.
fn blurred(values: &[f32], grid: Grid, radius: usize) -> Vec<f32> {
    let Grid { width, height } = grid;
    let reach = |size: usize| radius.min(size.saturating_sub(1) / 2);
    let mut across = vec![0f32; values.len()];
    across.par_chunks_mut(width).zip(values.par_chunks(width)).for_each(|(out, row)| {
        slide(reach(width), width, |n| row[n], |n, mean| out[n] = mean);
    });
    // Columns in strips, so that rows of memory are walked in order.
    let radius = reach(height);
    let span = (2 * radius + 1) as f32;
    let mut means = vec![0f32; values.len()];
    const BAND: usize = 64;
    means.par_chunks_mut(BAND * width).enumerate().for_each(|(band, rows)| {
        let first = band * BAND;
        let row = |n: usize| {
            let n = n % height;
            &across[n * width..(n + 1) * width]
        };
        let mut sums = vec![0f32; width];
        for n in 0..=2 * radius {
            let source = row(first + height + n - radius);
            sums.iter_mut().zip(source).for_each(|(sum, value)| *sum += value);
        }
        for (line, out) in rows.chunks_mut(width).enumerate() {
            out.iter_mut().zip(&sums).for_each(|(out, sum)| *out = sum / span);
            let enters = row(first + line + radius + 1);
            let leaves = row(first + line + height - radius);
            for ((sum, enters), leaves) in sums.iter_mut().zip(enters).zip(leaves) {
                *sum += enters - leaves;
            }
        }
    });
    means
}

/// The running mean round a closed line.
fn slide(
    radius: usize,
    length: usize,
    value: impl Fn(usize) -> f32,
    mut give: impl FnMut(usize, f32),
) {
    let span = (2 * radius + 1) as f32;
    let mut sum = 0.0;
    for n in 0..=2 * radius {
        sum += value((n + length - radius) % length);
    }
    for n in 0..length {
        give(n, sum / span);
        sum += value((n + radius + 1) % length) - value((n + length - radius) % length);
    }
}

/// Light of a gap against that of the yarns about it.
const GAP_LIGHT: f32 = 0.22;

/// Light above this is pressed together, so that the highlights of white yarn keep their form.
const SHOULDER: f32 = 0.86;

/// What is left of a yarn's light under a shade; the same for its three colours, so that the hue
/// is kept.
fn pressed(light: [f32; 3], shade: f32) -> f32 {
    let room = 1.0 - SHOULDER;
    let own = light[0].max(light[1]).max(light[2]).max(1e-6);
    let over = ((own * shade - SHOULDER) / room).max(0.0);
    ((own * shade).min(SHOULDER) + room * over / (1.0 + over)) / own
}

/// How much of each yarn is seen, by shade.
struct Census {
    /// Samples of each yarn with a shade in each hundredth.
    shades: Vec<[u32; Census::STEPS]>,
    /// Samples in which nothing is seen.
    open: usize,
    samples: usize,
}

impl Census {
    const STEPS: usize = 256;

    fn of(field: &[Seen], strands: &[Strand], shades: &[f32], yarns: usize) -> Census {
        let none = vec![[0; Census::STEPS]; yarns];
        let mut census = Census { shades: none, open: 0, samples: field.len().max(1) };
        for (seen, shade) in field.iter().zip(shades) {
            if seen.height > GAP {
                let step = ((100.0 * shade) as usize).min(Census::STEPS - 1);
                census.shades[strands[seen.strand as usize].yarn][step] += 1;
            } else {
                census.open += 1;
            }
        }
        census
    }

    /// Mean colour of the yarns by the area in which each is seen.
    fn mean(&self, yarns: &[Look]) -> [f32; 3] {
        let covered = (self.samples - self.open).max(1) as f32;
        let mut mean = [0.0; 3];
        for (look, shades) in yarns.iter().zip(&self.shades) {
            let seen: u32 = shades.iter().sum();
            for (mean, light) in mean.iter_mut().zip(look.light) {
                *mean += light * seen as f32 / covered;
            }
        }
        mean
    }

    /// The factor on all shades with which the yarns send back as much light as they would
    /// without shade, gaps counted as far as they are opaque. It is one factor for all yarns: one
    /// that lies deep stays darker than one that lies on top.
    fn scale(&self, yarns: &[Look], gap_opacity: f32) -> f32 {
        let covered = (self.samples - self.open) as f32;
        let wanted = covered + self.open as f32 * gap_opacity * (1.0 - GAP_LIGHT);
        // White yarn has no room above it for lights, and would lose its form; it gives up a
        // little of its mean instead.
        let [red, green, blue] = self.mean(yarns);
        let white = noise::ease(2.0 * red.max(green).max(blue) - 1.0);
        let wanted = wanted * (1.0 - 0.1 * white);
        let (mut low, mut high) = (0.5, 3.0);
        for _ in 0..16 {
            let middle = 0.5 * (low + high);
            let mut sum = 0.0;
            for (look, shades) in yarns.iter().zip(&self.shades) {
                for (step, &samples) in shades.iter().enumerate() {
                    let shade = middle * (step as f32 + 0.5) / 100.0;
                    sum += samples as f32 * pressed(look.light, shade);
                }
            }
            if sum < wanted { low = middle } else { high = middle }
        }
        0.5 * (low + high)
    }
}

/// Colours and opacity, the shades scaled so that the mean light of the tile is that of its
/// yarns.
fn expose(
    field: &[Seen],
    strands: &[Strand],
    yarns: &[Look],
    shades: &[f32],
    grid: Grid,
) -> Vec<u8> {
    let census = Census::of(field, strands, shades, yarns.len());
    let open = census.open as f32 / census.samples as f32;
    // Fibres that stand off the threads close small gaps.
    let gap_opacity = 1.0 - 0.85 * noise::ease((open - 0.04) / 0.12);
    let gap = census.mean(yarns).map(|light| GAP_LIGHT * light);
    let scale = census.scale(yarns, gap_opacity);
    let [width, height] = [grid.width / FINE, grid.height / FINE];
    let code = super::light::Code::new();
    let mut pixels = vec![0u8; 4 * width * height];
    pixels.par_chunks_mut(4 * width.max(1)).enumerate().for_each(|(row, line)| {
        let low = (height - 1 - row) * FINE;
        for (column, pixel) in line.chunks_exact_mut(4).enumerate() {
            let mut light = [0f32; 3];
            let mut opacity = 0.0;
            for n in 0..FINE * FINE {
                let at = (low + n / FINE) * grid.width + column * FINE + n % FINE;
                let seen = field[at];
                let (colour, cover) = if seen.height > GAP {
                    let look = &yarns[strands[seen.strand as usize].yarn];
                    let left = pressed(look.light, shades[at] * scale);
                    (look.light.map(|light| light * left), 1.0)
                } else {
                    (gap, gap_opacity)
                };
                opacity += cover;
                for (sum, colour) in light.iter_mut().zip(colour) {
                    *sum += cover * colour;
                }
            }
            let coded = light.map(|sum| code.of(sum / opacity));
            pixel[..3].copy_from_slice(&coded);
            pixel[3] = (opacity / (FINE * FINE) as f32 * 255.0 + 0.5) as u8;
        }
    });
    pixels
}
