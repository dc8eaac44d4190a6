//! The sheet: all views traced, each before the one paper that they share.

use super::backdrop;
use super::camera::Camera;
use super::figure::Figure;
use super::floor::Floor;
use super::lamp::Lighting;
use super::layout::{Frame, Layout};
use super::pixel::Pixel;
use super::sample::Sampler;
use super::set::Set;
use super::smooth::Film;
use super::trace::Tracer;
use super::{Light3, Options, tone};
use crate::garment::scene::{Picture, View};
use crate::progress::Progress;
use image::RgbaImage;
use rayon::prelude::*;

/// Edges of the pieces of curved triangles, in pixels.
const EDGE: f32 = 3.0;

/// Rows that are traced between two words on the progress.
const BAND: usize = 48;

/// Traces all views on to one sheet.
pub fn print(
    figure: &Figure,
    picture: &Picture,
    options: &Options,
    progress: &mut dyn Progress,
) -> RgbaImage {
    let size = picture.size.map(|n| n.max(1));
    let views = if picture.views.is_empty() { &[View::Front][..] } else { &picture.views };
    let mut cameras = Camera::around(&figure.places(), views, figure.worn);
    let Layout { frames, scale } = Layout::of(&mut cameras, views, size);
    let distance = cameras.first().map_or(1.0, |c| (c.eye - c.stand.middle).norm());
    let set = Set::of(figure, EDGE * distance / scale);
    let mut paper: Vec<Light3> = (0..size[0] as usize * size[1] as usize)
        .into_par_iter()
        .with_min_len(4096)
        .map(|at| {
            let (x, y) = (at % size[0] as usize, at / size[0] as usize);
            let share = |n: usize, k: usize| (n as f32 + 0.5) / size[k] as f32;
            backdrop::paper(share(x, 0), share(y, 1))
        })
        .collect();
    let mut films = Vec::with_capacity(frames.len());
    let all: usize = frames.iter().map(|frame| frame[3] as usize).sum();
    let mut done = 0;
    for (view, (frame, camera)) in frames.iter().zip(&cameras).enumerate() {
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
        let make = || tracer(&set, &lighting, camera, options);
        let mut floor = Floor::traced(make, camera, view as u32, frame, size);
        if options.smooth {
            film.smooth();
            floor.smooth();
        }
        floor.shade(&mut paper, size[0] as usize);
        films.push(film);
    }
    developed(&films, &frames, &paper, size)
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

/// The sheet of all views before the shaded paper.
fn developed(films: &[Film], frames: &[Frame], paper: &[Light3], size: [u32; 2]) -> RgbaImage {
    let width = size[0] as usize;
    let mut light = paper.to_vec();
    for (film, frame) in films.iter().zip(frames) {
        for (y, line) in film.pixels.chunks(film.size[0].max(1)).enumerate() {
            let start = (frame[1] as usize + y) * width + frame[0] as usize;
            for (light, pixel) in light.iter_mut().skip(start).zip(line) {
                *light = pixel.light(light);
            }
        }
    }
    let bytes = light
        .par_iter()
        .enumerate()
        .flat_map_iter(|(at, light)| {
            let (x, y) = ((at % width) as u32, (at / width) as u32);
            // An even number from 0 to 1 for each pixel, to round with.
            let grit = Sampler::new(u32::MAX, [x, y], 0, 1).pair()[0];
            tone::developed(light, grit)
        })
        .collect();
    RgbaImage::from_raw(size[0], size[1], bytes).unwrap_or_default()
}
