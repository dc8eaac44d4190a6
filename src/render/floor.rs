//! The shadow of the figure on the floor.
//!
//! What the figure takes from the light on the floor, and what it sends back there, changes
//! slowly over the picture. It is found with many paths at every few pixels, also where the
//! figure hides the floor, and drawn out smoothly in between; the edges of the figure are no
//! matter of it. The same numbers with the figure and without leave no grain where it does nothing.

use super::camera::Camera;
use super::layout::Frame;
use super::sample::Sampler;
use super::trace::Tracer;
use super::{Light3, Vector};
use rayon::prelude::*;

/// Pixels between the places that are looked at.
const STEP: u32 = 2;

/// Paths at each.
const PATHS: u32 = 24;

/// Differences count against so many deviations of the grain.
const TOLERANCE: f32 = 3.0;

/// Light on the floor about one view's figure, at every few pixels of the sheet. It reaches
/// beyond the view's own frame as far as the shadow does.
pub struct Floor {
    /// Left and top on the sheet, pixels.
    corner: [u32; 2],
    columns: usize,
    rows: usize,
    spots: Vec<Spot>,
}

/// One place.
#[derive(Clone, Copy, Debug)]
struct Spot {
    /// Light that arrives.
    arrives: Light3,
    /// Light that would arrive were the floor empty.
    empty: Light3,
    /// Variance of the mean of the first over the second.
    grain: f32,
    /// Whether it says anything: not under a foot, where nobody looks and no light is.
    known: bool,
}

/// The paper behind, which nothing shades.
const PAPER: Spot = Spot {
    arrives: Light3::new(1.0, 1.0, 1.0),
    empty: Light3::new(1.0, 1.0, 1.0),
    grain: 0.0,
    known: true,
};

impl Floor {
    /// The floor about the view with the number `view` in its frame on a sheet of `size` pixels.
    pub fn traced<'a>(
        tracer: impl Fn() -> Tracer<'a> + Sync + Send,
        camera: &Camera,
        view: u32,
        frame: &Frame,
        size: [u32; 2],
    ) -> Self {
        let [left, top, right, bottom] = shaded(&tracer().rim(), camera, frame, size);
        let columns = right.saturating_sub(left).div_ceil(STEP) as usize + 1;
        let rows = bottom.saturating_sub(top).div_ceil(STEP) as usize + 1;
        let spots = (0..if left < right && top < bottom { columns * rows } else { 0 })
            .into_par_iter()
            .with_min_len(32)
            .map_init(tracer, |tracer, at| {
                let place =
                    [left + (at % columns) as u32 * STEP, top + (at / columns) as u32 * STEP];
                let share =
                    |k: usize| (place[k] as f32 - frame[k] as f32) / frame[k + 2].max(1) as f32;
                let ray = camera.ray(share(0), share(1));
                let Some(at) = tracer.on_floor(&ray) else { return PAPER };
                let open = tracer.openness(&at);
                if open >= 1.0 {
                    return PAPER;
                }
                if tracer.covered(&at) {
                    return Spot { known: false, ..PAPER };
                }
                let mut sum = Sum::default();
                for path in 0..PATHS {
                    // Apart from the numbers of the pixels.
                    let spot = place.map(|n| n / STEP);
                    let mut sampler = Sampler::new(!view, spot, path, PATHS);
                    let (arrives, empty) = tracer.light_on_floor(&at, &mut sampler);
                    sum.add(arrives + (empty - arrives) * open, empty);
                }
                sum.mean()
            })
            .collect();
        Floor { corner: [left, top], columns, rows, spots }
    }

    /// Takes the grain out.
    pub fn smooth(&mut self) {
        for pass in 0..3 {
            let floor = &*self;
            let smoothed = (0..floor.spots.len())
                .into_par_iter()
                .with_min_len(256)
                .map(|at| floor.smoothed(at, 1 << pass))
                .collect();
            self.spots = smoothed;
        }
    }

    fn smoothed(&self, at: usize, step: i64) -> Spot {
        const KERNEL: [f32; 3] = [0.25, 0.5, 0.25];
        let here = self.spots[at];
        let (x, y) = ((at % self.columns) as i64, (at / self.columns) as i64);
        // What is not known takes after its neighbours, whatever they are like; and between
        // nearest neighbours nothing is sharper than the grid can show.
        let sharp = here.known && step > 1;
        let doubt = if sharp { 1.0 / (TOLERANCE * TOLERANCE * here.grain + 1e-6) } else { 0.0 };
        let (mut arrives, mut empty) = (Light3::zeros(), Light3::zeros());
        let (mut grain, mut weight) = (0.0, 0.0);
        for (dy, row) in KERNEL.iter().enumerate() {
            for (dx, column) in KERNEL.iter().enumerate() {
                let (px, py) = (x + (dx as i64 - 1) * step, y + (dy as i64 - 1) * step);
                let tap = self.spot(px, py);
                if !tap.known {
                    continue;
                }
                let off = here.shade() - tap.shade();
                let w = row * column / (1.0 + off * off * doubt);
                arrives += tap.arrives * w;
                empty += tap.empty * w;
                grain += tap.grain * w * w;
                weight += w;
            }
        }
        if weight <= 0.0 {
            return here;
        }
        Spot {
            arrives: arrives / weight,
            empty: empty / weight,
            grain: grain / (weight * weight),
            known: true,
        }
    }

    fn spot(&self, x: i64, y: i64) -> Spot {
        let column = x.clamp(0, self.columns as i64 - 1) as usize;
        let row = y.clamp(0, self.rows as i64 - 1) as usize;
        self.spots[row * self.columns + column]
    }

    /// Darkens the light on the whole sheet, row by row, where the figure shades its floor.
    pub fn shade(&self, sheet: &mut [Light3], width: usize) {
        if self.spots.is_empty() {
            return;
        }
        let [left, top] = self.corner.map(|n| n as usize);
        let high = (self.rows - 1) * STEP as usize;
        let wide = ((self.columns - 1) * STEP as usize).min(width.saturating_sub(left));
        sheet.par_chunks_mut(width.max(1)).skip(top).take(high).enumerate().for_each(
            |(y, line)| {
                for (x, light) in line.iter_mut().skip(left).take(wide).enumerate() {
                    light.component_mul_assign(&self.shadow(x, y));
                }
            },
        );
    }

    /// What is left of the light at the middle of a pixel, counted from the corner.
    fn shadow(&self, x: usize, y: usize) -> Light3 {
        let [across, down] = [x, y].map(|n| (n as f32 + 0.5) / STEP as f32);
        let (column, row) = (across.floor(), down.floor());
        let (mix, fall) = (across - column, down - row);
        let (mut left, mut weight) = (Light3::zeros(), 0.0);
        for (dx, wx) in [(0, 1.0 - mix), (1, mix)] {
            for (dy, wy) in [(0, 1.0 - fall), (1, fall)] {
                let spot = self.spot(column as i64 + dx, row as i64 + dy);
                if spot.known {
                    let w = wx * wy;
                    left += spot.arrives.zip_map(&spot.empty, |a, e| a / e.max(1e-6)) * w;
                    weight += w;
                }
            }
        }
        if weight > 1e-6 { left / weight } else { Light3::repeat(1.0) }
    }
}

/// The rectangle of the sheet, left, top, right, bottom, in which the rim of the shadow lies.
fn shaded(rim: &[Vector], camera: &Camera, frame: &Frame, size: [u32; 2]) -> [u32; 4] {
    let (mut low, mut high) = ([f32::INFINITY; 2], [f32::NEG_INFINITY; 2]);
    for share in rim.iter().filter_map(|place| camera.picture(place)) {
        for k in 0..2 {
            let at = frame[k] as f32 + share[k] * frame[k + 2] as f32;
            (low[k], high[k]) = (low[k].min(at), high[k].max(at));
        }
    }
    let clipped = |place: f32, k: usize| place.clamp(0.0, size[k] as f32) as u32;
    [clipped(low[0], 0), clipped(low[1], 1), clipped(high[0], 0), clipped(high[1], 1)]
}

impl Spot {
    fn shade(&self) -> f32 {
        self.arrives.sum() / self.empty.sum().max(1e-6)
    }
}

/// Sums over the paths of a place.
#[derive(Default)]
struct Sum {
    arrives: Light3,
    empty: Light3,
    shade: f32,
    square: f32,
}

impl Sum {
    fn add(&mut self, arrives: Light3, empty: Light3) {
        self.arrives += arrives;
        self.empty += empty;
        let shade = arrives.sum() / empty.sum().max(1e-6);
        self.shade += shade;
        self.square += shade * shade;
    }

    fn mean(&self) -> Spot {
        let count = PATHS as f32;
        let shade = self.shade / count;
        Spot {
            arrives: self.arrives / count,
            empty: self.empty / count,
            grain: (self.square / count - shade * shade).max(0.0) / count,
            known: true,
        }
    }
}
