//! The sheet: its views side by side or in rows, whichever shows the figure larger.

use super::backdrop::paper;
use super::camera::{Camera, Framing};
use super::figure::Figure;
use super::floor::Floor;
use super::lamp::Lighting;
use super::pixel::Pixel;
use super::sample::Sampler;
use super::set::Set;
use super::smooth::Film;
use super::trace::Tracer;
use super::{Light3, Options, Vector, tone};
use crate::garment::scene::{Picture, View};
use crate::progress::Progress;
use image::{Rgba, RgbaImage};
use rayon::prelude::*;

/// A view's rectangle on the sheet: left, top, width, height, pixels.
pub type Frame = [u32; 4];

/// Edges of the pieces of curved triangles, in pixels.
const EDGE: f32 = 3.0;

/// Rows that are traced between two words on the progress.
const BAND: usize = 48;

/// Frames for `count` views in `columns` columns. The last row, if it is not full, is centred.
pub fn frames(count: usize, columns: usize, size: [u32; 2]) -> Vec<Frame> {
    let columns = columns.clamp(1, count.max(1));
    let rows = count.div_ceil(columns).max(1);
    let edge = |k: usize, of: usize, whole: u32| (whole as u64 * k as u64 / of as u64) as u32;
    (0..count)
        .map(|k| {
            let (row, column) = (k / columns, k % columns);
            let in_row = (count - row * columns).min(columns);
            let (left, right) =
                (edge(column, columns, size[0]), edge(column + 1, columns, size[0]));
            let free = size[0] - edge(in_row, columns, size[0]);
            let (top, bottom) = (edge(row, rows, size[1]), edge(row + 1, rows, size[1]));
            [left + free / 2, top, right - left, bottom - top]
        })
        .collect()
}

/// Frames and cameras: of all divisions into rows and columns the one with the largest scale.
fn arranged(
    places: &[Vector],
    views: &[View],
    worn: bool,
    size: [u32; 2],
) -> (Vec<Frame>, Framing) {
    let mut best: Option<(f32, Vec<Frame>, Framing)> = None;
    for columns in 1..=views.len() {
        let frames = frames(views.len(), columns, size);
        let (width, height) = frames
            .iter()
            .fold((u32::MAX, u32::MAX), |(w, h), frame| (w.min(frame[2]), h.min(frame[3])));
        if width == 0 || height == 0 {
            continue;
        }
        let framing = Framing::around(places, views, worn, width as f32 / height as f32);
        let scale = height as f32 / framing.height;
        // A hair's breadth of difference does not decide; fewer columns come first.
        if best.as_ref().is_none_or(|(most, _, _)| scale > most * 1.001) {
            best = Some((scale, frames, framing));
        }
    }
    match best {
        Some((_, frames, framing)) => (frames, framing),
        // A sheet narrower than its views: all of them in every pixel of it.
        None => {
            let frames = vec![[0, 0, size[0], size[1]]; views.len()];
            (frames, Framing::around(places, views, worn, 1.0))
        }
    }
}

/// Traces all views on to one sheet.
pub fn print(
    figure: &Figure,
    picture: &Picture,
    options: &Options,
    progress: &mut dyn Progress,
) -> RgbaImage {
    let size = picture.size.map(|n| n.max(1));
    let views = if picture.views.is_empty() { &[View::Front][..] } else { &picture.views };
    let (frames, framing) = arranged(&figure.places(), views, figure.worn, size);
    let mut sheet = RgbaImage::new(size[0], size[1]);
    for (x, y, pixel) in sheet.enumerate_pixels_mut() {
        let at = [x as f32 / size[0] as f32, y as f32 / size[1] as f32];
        *pixel = Rgba(tone::developed(&paper(at[0], at[1]), grit(x, y)));
    }
    let height = frames.first().map_or(1, |frame| frame[3]).max(1);
    let set = Set::of(figure, EDGE * framing.height / height as f32);
    let all: usize = frames.iter().map(|frame| frame[3] as usize).sum();
    let mut done = 0;
    for (view, (frame, camera)) in frames.iter().zip(&framing.cameras).enumerate() {
        let lighting = Lighting::named(picture.light, &camera.stand);
        let mut film = Film {
            size: [frame[2] as usize, frame[3] as usize],
            pixels: Vec::with_capacity(frame[2] as usize * frame[3] as usize),
        };
        let rows = frame[3] as usize;
        for first in (0..rows).step_by(BAND) {
            let last = (first + BAND).min(rows);
            let band = trace_band(&set, &lighting, camera, view, frame, first..last, options);
            film.pixels.extend(band);
            done += last - first;
            progress.share(done as f64 / all as f64, "");
        }
        let mut floor = Floor::traced(
            || tracer(&set, &lighting, camera, options),
            camera,
            view as u32,
            [frame[2], frame[3]],
        );
        if options.smooth {
            film.smooth();
            floor.smooth();
        }
        develop(&film, &floor, frame, &mut sheet);
    }
    sheet
}

/// A worker.
fn tracer<'a>(
    set: &'a Set<'a>,
    lighting: &'a Lighting,
    camera: &Camera,
    options: &Options,
) -> Tracer<'a> {
    let stand = &camera.stand;
    Tracer::new(set, lighting, options.bounces.max(1), stand.middle, stand.extent)
}

/// Traces some rows of a view.
fn trace_band(
    set: &Set,
    lighting: &Lighting,
    camera: &Camera,
    view: usize,
    frame: &Frame,
    rows: std::ops::Range<usize>,
    options: &Options,
) -> Vec<Pixel> {
    let size = [frame[2], frame[3]];
    let width = frame[2] as usize;
    (rows.start * width..rows.end * width)
        .into_par_iter()
        .with_min_len(64)
        .map_init(
            || tracer(set, lighting, camera, options),
            |tracer, at| {
                let place = [(at % width) as u32, (at / width) as u32];
                Pixel::traced(tracer, camera, view as u32, place, size, options.paths.max(1))
            },
        )
        .collect()
}

/// An even number from 0 to 1 for each pixel, to round with.
fn grit(x: u32, y: u32) -> f32 {
    Sampler::new(u32::MAX, [x, y], 0, 1).pair()[0]
}

/// 0 at the left and right edge of a view, 1 from a tenth of its width on.
fn inside(across: f32) -> f32 {
    let share = (across.min(1.0 - across) * 10.0).clamp(0.0, 1.0);
    share * share * (3.0 - 2.0 * share)
}

/// Puts a view on the sheet.
fn develop(film: &Film, floor: &Floor, frame: &Frame, sheet: &mut RgbaImage) {
    let [width, height] = film.size;
    let colours: Vec<[u8; 4]> = film
        .pixels
        .par_iter()
        .enumerate()
        .map(|(at, pixel)| {
            let (x, y) = (at % width, at / width);
            let share = |n: usize, of: usize| (n as f32 + 0.5) / of as f32;
            // One paper behind all views of a row; shadows end before the next view begins.
            let across = share(frame[0] as usize + x, sheet.width() as usize);
            let paper = paper(across, share(y, height));
            let shadow = match width < sheet.width() as usize {
                true => Light3::repeat(1.0).lerp(&floor.shadow(x, y), inside(share(x, width))),
                false => floor.shadow(x, y),
            };
            let light = pixel.light(&paper.component_mul(&shadow));
            tone::developed(&light, grit(x as u32, y as u32))
        })
        .collect();
    for (at, colour) in colours.into_iter().enumerate() {
        let (x, y) = (frame[0] + (at % width) as u32, frame[1] + (at / width) as u32);
        if x < sheet.width() && y < sheet.height() {
            sheet.put_pixel(x, y, Rgba(colour));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_cover_the_sheet_without_overlap() {
        for (count, columns, size) in
            [(4, 2, [1200, 1601]), (3, 3, [1000, 700]), (5, 3, [907, 600])]
        {
            let frames = frames(count, columns, size);
            assert_eq!(frames.len(), count);
            for (k, a) in frames.iter().enumerate() {
                assert!(a[0] + a[2] <= size[0] && a[1] + a[3] <= size[1]);
                for b in &frames[k + 1..] {
                    let apart = a[0] + a[2] <= b[0]
                        || b[0] + b[2] <= a[0]
                        || a[1] + a[3] <= b[1]
                        || b[1] + b[3] <= a[1];
                    assert!(apart, "{a:?} {b:?}");
                }
            }
            let area: u32 = frames.iter().map(|f| f[2] * f[3]).sum();
            if count % columns == 0 {
                assert_eq!(area, size[0] * size[1]);
            }
        }
    }

    #[test]
    fn tall_figures_stand_in_a_row_on_a_wide_sheet_and_in_two_rows_on_a_tall_one() {
        let person = [Vector::new(-0.35, 0.0, -0.2), Vector::new(0.35, 1.7, 0.2)];
        let views = [View::Front, View::Side, View::Back, View::ThreeQuarter];
        let rows = |size| {
            let (frames, _) = arranged(&person, &views, true, size);
            frames.iter().filter(|frame| frame[0] == 0).count()
        };
        assert_eq!(rows([2000, 1000]), 1);
        assert_eq!(rows([1200, 1600]), 2);
    }
}
