//! Paints a sari: fills and figures in the order in which they lie over each other.
//!
//! Lengths are metres of the sari: x along it from the inner end, y across it from the lower
//! edge. As a panel its warp runs up the picture: rows of pixels go down from great x to small,
//! columns from great y to small.

use super::figure::Figure;
use super::light::Code;
use super::noise;
use rayon::prelude::*;
use std::sync::Arc;

/// An upright rectangle: least x, least y, greatest x, greatest y.
pub type Rect = [f64; 4];

/// All that is painted on one sari.
#[derive(Clone, Debug, Default)]
pub struct Design {
    /// Its figures, by number.
    pub figures: Vec<Figure>,
    /// What is painted, lowest first.
    pub marks: Vec<Mark>,
}

/// One thing painted.
#[derive(Clone, Copy, Debug)]
pub enum Mark {
    /// A rectangle of one colour, linear light.
    Fill {
        /// Where.
        area: Rect,
        /// Its colour.
        light: [f32; 3],
    },
    /// A figure.
    Figure {
        /// Its number.
        figure: usize,
        /// Where and which way up.
        frame: Frame,
    },
}

/// Where a figure lies.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    /// The middle of the figure.
    pub middle: [f64; 2],
    /// The way to the right of its chart, a unit vector along x or y.
    pub right: [f64; 2],
    /// The way up its chart, along the other.
    pub up: [f64; 2],
    /// Width and height of the figure.
    pub size: [f64; 2],
}

impl Frame {
    /// The rectangle that the figure fills.
    pub fn area(&self) -> Rect {
        let half = |axis: usize| {
            (self.right[axis] * self.size[0]).abs() / 2.0
                + (self.up[axis] * self.size[1]).abs() / 2.0
        };
        let (x, y) = (half(0), half(1));
        [self.middle[0] - x, self.middle[1] - y, self.middle[0] + x, self.middle[1] + y]
    }
}

/// A rectangle of the sari as one picture.
#[derive(Clone, Debug)]
pub struct Sheet {
    /// What is painted.
    pub design: Arc<Design>,
    /// The rectangle seen.
    pub area: Rect,
    /// Whether it is seen from behind, where the figures' threads float from part to part.
    pub back: bool,
}

/// Rows of pixels painted by one task.
const BAND: usize = 16;

impl Sheet {
    /// Paints it in `pixels` across and down.
    pub fn draw(&self, pixels: [usize; 2]) -> Vec<u8> {
        let [width, height] = pixels;
        let mut picture = vec![255; 4 * width * height];
        if width == 0 || height == 0 {
            return picture;
        }
        let [x0, y0, x1, y1] = self.area;
        let step = [(x1 - x0) / height as f64, (y1 - y0) / width as f64];
        let bands = self.marks_of_bands(height, step[0]);
        let code = Code::new();
        // Picks and ends differ a little from their neighbours.
        let ends: Vec<f32> = (0..width)
            .map(|column| {
                let y = y1 - (column as f64 + 0.5) * step[1];
                1.0 + 0.012 * noise::line(0xe2d, (y / 1.3e-3) as f32, i32::MAX as u32)
            })
            .collect();
        picture.par_chunks_mut(4 * width * BAND).zip(&bands).enumerate().for_each(
            |(band, (rows, marks))| {
                let mut light = vec![[0f32; 3]; width];
                for (line, row) in rows.chunks_mut(4 * width).enumerate() {
                    let x = x1 - ((band * BAND + line) as f64 + 0.5) * step[0];
                    let pick =
                        1.0 + 0.02 * noise::line(0x91c, (x / 0.9e-3) as f32, i32::MAX as u32);
                    let cut = Cut { x, step, top: y1, ends: &ends, pick, back: self.back };
                    for &mark in marks {
                        match self.design.marks[mark] {
                            Mark::Fill { area, light: fill } => cut.fill(&mut light, area, fill),
                            Mark::Figure { figure, frame } => {
                                cut.figure(&mut light, &self.design.figures[figure], &frame);
                            }
                        }
                    }
                    for (pixel, light) in row.chunks_exact_mut(4).zip(&light) {
                        pixel[..3].copy_from_slice(&light.map(|value| code.of(value)));
                    }
                }
            },
        );
        picture
    }

    /// The marks that show in each band of rows.
    fn marks_of_bands(&self, height: usize, step: f64) -> Vec<Vec<usize>> {
        let [x0, y0, x1, y1] = self.area;
        let mut bands = vec![Vec::new(); height.div_ceil(BAND)];
        for (number, mark) in self.design.marks.iter().enumerate() {
            let area = match mark {
                Mark::Fill { area, .. } => *area,
                Mark::Figure { frame, .. } => {
                    // A pixel more than the figure, for its softened outline.
                    let [a, b, c, d] = frame.area();
                    [a - step, b - step, c + step, d + step]
                }
            };
            if area[2] < x0 || area[0] > x1 || area[3] < y0 || area[1] > y1 {
                continue;
            }
            let band = |x: f64| ((x1 - x) / (step * BAND as f64)).clamp(0.0, 1e9) as usize;
            for marks in bands.iter_mut().take(band(area[0]) + 1).skip(band(area[2])) {
                marks.push(number);
            }
        }
        bands
    }
}

/// One row of pixels: a cut across the sari.
struct Cut<'a> {
    x: f64,
    step: [f64; 2],
    /// Greatest y, where column 0 begins.
    top: f64,
    ends: &'a [f32],
    pick: f32,
    back: bool,
}

impl Cut<'_> {
    /// Columns that y0 … y1 touches.
    fn columns(&self, y0: f64, y1: f64, width: usize) -> std::ops::Range<usize> {
        let column = |y: f64| ((self.top - y) / self.step[1]).clamp(0.0, width as f64);
        column(y1).floor() as usize..column(y0).ceil() as usize
    }

    fn fill(&self, row: &mut [[f32; 3]], area: Rect, light: [f32; 3]) {
        let half = self.step[0] / 2.0;
        let along = (area[2].min(self.x + half) - area[0].max(self.x - half)) / self.step[0];
        if along <= 0.0 {
            return;
        }
        for column in self.columns(area[1], area[3], row.len()) {
            let high = self.top - column as f64 * self.step[1];
            let across = (area[3].min(high) - area[1].max(high - self.step[1])) / self.step[1];
            let cover = (along.min(1.0) * across.clamp(0.0, 1.0)) as f32;
            let tone = self.pick * self.ends[column];
            mix(&mut row[column], light.map(|value| value * tone), cover);
        }
    }

    fn figure(&self, row: &mut [[f32; 3]], figure: &Figure, frame: &Frame) {
        let chart = figure.chart();
        let cells = [chart[0] as f64 / frame.size[0], chart[1] as f64 / frame.size[1]];
        // Pixel sides along the chart's own axes, in cells.
        let turned = frame.right[0].abs() < 0.5;
        let [along, across] = self.step;
        let (right, up) = if turned { (across, along) } else { (along, across) };
        let pixel = [(right * cells[0]) as f32, (up * cells[1]) as f32];
        let area = frame.area();
        let dx = self.x - frame.middle[0];
        let margin = self.step[1];
        for column in self.columns(area[1] - margin, area[3] + margin, row.len()) {
            let y = self.top - (column as f64 + 0.5) * self.step[1];
            let dy = y - frame.middle[1];
            let place = |axis: [f64; 2], n: usize| {
                ((dx * axis[0] + dy * axis[1] + frame.size[n] / 2.0) * cells[n]) as f32
            };
            let at = [place(frame.right, 0), place(frame.up, 1)];
            let shown = figure.at(at, pixel);
            let ground = &mut row[column];
            if self.back && shown.cover < 1.0 {
                // Behind, the thread passes from cell to cell over the ground.
                if let Some(light) = figure.float(at) {
                    mix(ground, light.map(|value| 0.8 * value), 0.4);
                }
            }
            if shown.depth <= 0.0 {
                continue;
            }
            // Figures are raised: a thin shadow beside them, a rounded edge within.
            let beside = noise::ease((shown.depth - 0.15) / 0.35) * (1.0 - shown.cover);
            *ground = ground.map(|value| value * (1.0 - 0.22 * beside));
            let edge = 1.0 - noise::ease((shown.depth - 0.45) / 0.4);
            let thread = noise::plane(
                0xb0c,
                (y / 3.0e-3) as f32,
                (self.x / 0.45e-3) as f32,
                [i32::MAX as u32; 2],
            );
            let dull = if self.back { 0.86 } else { 1.0 };
            let tone = dull * (1.04 - 0.16 * edge) * (1.0 + 0.09 * thread);
            mix(ground, shown.light.map(|value| value * tone), shown.cover);
        }
    }
}

/// Lays a colour over another.
fn mix(under: &mut [f32; 3], over: [f32; 3], cover: f32) {
    for (under, over) in under.iter_mut().zip(over) {
        *under += (over - *under) * cover;
    }
}
