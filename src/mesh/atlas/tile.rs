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
    let lengths: Vec<f32> =
        strands.iter().map(|strand| strand.nodes.last().map_or(1.0, |node| node.along)).collect();
    let mut shades = vec![0f32; field.len()];
    shades.par_chunks_mut(grid.width).enumerate().for_each(|(row, shades)| {
        let first = row * grid.width;
        for (column, shade) in shades.iter_mut().enumerate() {
            let n = first + column;
            let seen = field[n];
            if seen.height == GAP {
                continue;
            }
            let strand = seen.strand as usize;
            let look = &yarns[strands[strand].yarn];
            let share = seen.along / lengths[strand];
            let skin = skin(look, seen.strand, share, seen.across);
            let round = 1.0 - 0.5 * seen.across * seen.across;
            let over = (0.6 * (near[n] - heights[n]) + 0.7 * (wide[n] - heights[n]))
                / (0.5 * shading.thread);
            let shadow = 1.0 - 0.75 * noise::ease(over + 0.12) + 0.12 * (-over).clamp(0.0, 1.0);
            let place = [column as f32 / grid.width as f32, row as f32 / grid.height as f32];
            let formed = 1.0 + shading.relief * (round * shadow - 1.0);
            *shade = (formed * skin * fuzz(place, grid, shading)).max(0.05);
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
    const AROUND: u32 = 14;
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

/// Colours, opacity, and the shades scaled so that the mean light of the tile is that of its
/// yarns by the area in which each is seen.
fn expose(
    field: &[Seen],
    strands: &[Strand],
    yarns: &[Look],
    shades: &[f32],
    grid: Grid,
) -> Vec<u8> {
    let mut count = vec![0usize; yarns.len()];
    let mut sums = vec![0f64; yarns.len()];
    for (seen, shade) in field.iter().zip(shades) {
        if seen.height > GAP {
            let yarn = strands[seen.strand as usize].yarn;
            count[yarn] += 1;
            sums[yarn] += f64::from(*shade);
        }
    }
    let covered: usize = count.iter().sum();
    let open = (field.len() - covered) as f32 / field.len().max(1) as f32;
    // Fibres that stand off the threads close small gaps.
    let gap_opacity = 1.0 - 0.85 * noise::ease((open - 0.04) / 0.12);
    let mut gap = [0f32; 3];
    let mut scale = vec![1f32; yarns.len()];
    // What the gaps lack in light, the threads carry, as far as the gaps are counted.
    let lost = open * gap_opacity * (1.0 - GAP_LIGHT) / (1.0 - open).max(0.05);
    for (yarn, look) in yarns.iter().enumerate() {
        let part = count[yarn] as f32 / covered.max(1) as f32;
        for (gap, light) in gap.iter_mut().zip(look.light) {
            *gap += GAP_LIGHT * part * light;
        }
        if sums[yarn] > 0.0 {
            scale[yarn] = (count[yarn] as f64 / sums[yarn]) as f32 * (1.0 + lost.min(0.3));
        }
    }
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
                    let yarn = strands[seen.strand as usize].yarn;
                    (yarns[yarn].light.map(|light| light * shades[at] * scale[yarn]), 1.0)
                } else {
                    (gap, gap_opacity)
                };
                opacity += cover;
                for (sum, colour) in light.iter_mut().zip(colour) {
                    *sum += cover * colour.min(1.0);
                }
            }
            let coded = light.map(|sum| code.of(sum / opacity));
            pixel[..3].copy_from_slice(&coded);
            pixel[3] = (opacity / (FINE * FINE) as f32 * 255.0 + 0.5) as u8;
        }
    });
    pixels
}
