//! The sheet: all views traced, each before the one paper that they share.

use super::backdrop;
use super::camera::Camera;
use super::figure::Figure;
use super::floor::Floor;
use super::gouraud::CornerLight;
use super::lamp::Lighting;
use super::layout::{Frame, Layout};
use super::pixel::Pixel;
use super::sample::Sampler;
use super::set::Set;
use super::smooth::Film;
use super::trace::Tracer;
use super::{Light3, Options, Vector, tone};
use crate::garment::scene::{Background, Picture, View};
use crate::progress::Progress;
use image::RgbaImage;
use rayon::prelude::*;

/// Edges of the pieces of curved triangles, in pixels.
const EDGE: f32 = 3.0;

/// Rows that are traced between two words on the progress.
const BAND: usize = 48;

/// A figure with the cameras that look at it.
pub struct Stage<'a> {
    /// One for each view.
    pub cameras: Vec<Camera>,
    /// Their places on the sheet.
    pub frames: Vec<Frame>,
    /// What they look at.
    pub set: Set<'a>,
    /// Pixels of the sheet.
    pub size: [u32; 2],
}

impl<'a> Stage<'a> {
    /// For a picture.
    pub fn of(figure: &'a Figure<'a>, picture: &Picture) -> Self {
        let size = picture.size.map(|n| n.max(1));
        let views = if picture.views.is_empty() { &[View::Front][..] } else { &picture.views };
        let turn = picture.turn.map(|turn| turn as f32);
        let mut cameras = Camera::around(&figure.places(), views, figure.worn, turn);
        if let Some(field) = picture.field {
            let (aim, field) = (figure.middle(), (field as f32).max(1e-4));
            for camera in &mut cameras {
                *camera = camera.close_up(&aim, field, |ray| figure.meets(ray));
            }
        }
        let Layout { frames, scale } = Layout::of(&mut cameras, views, size);
        let distance = cameras.first().map_or(1.0, |camera| camera.away);
        let pixel = distance / scale;
        // Of a picture from near by most of the figure is not seen.
        let seen = |place: &Vector| {
            let inside = |at: [f32; 2]| at.iter().all(|share| (-0.5..=1.5).contains(share));
            picture.field.is_none() || cameras.iter().any(|c| c.picture(place).is_some_and(inside))
        };
        let set = Set::of(figure, EDGE * pixel, pixel, seen);
        Stage { cameras, frames, set, size }
    }
}

/// Traces all views on to one sheet.
pub fn print(
    figure: &Figure,
    picture: &Picture,
    options: &Options,
    progress: &mut dyn Progress,
) -> RgbaImage {
    let Stage { cameras, frames, set, size } = Stage::of(figure, picture);
    let blank = || -> Vec<Light3> {
        (0..size[0] as usize * size[1] as usize)
            .into_par_iter()
            .with_min_len(4096)
            .map(|at| {
                let (x, y) = (at % size[0] as usize, at / size[0] as usize);
                let share = |n: usize, k: usize| (n as f32 + 0.5) / size[k] as f32;
                backdrop::paper(share(x, 0), share(y, 1))
            })
            .collect()
    };
    let mut paper = (picture.background == Background::Paper).then(blank);
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
        let bare = || tracer(&set, &lighting, camera, options);
        let corners =
            figure.manner.at_corners.then(|| CornerLight::found(bare, figure, camera, view as u32));
        let make = || tracer(&set, &lighting, camera, options).lit_at(corners.as_ref());
        for first in (0..rows).step_by(BAND) {
            let last = (first + BAND).min(rows);
            let band = trace_band(make, camera, view, frame, first..last, options.paths);
            film.pixels.extend(band);
            done += last - first;
            progress.share(done as f64 / all as f64, "");
        }
        if options.smooth {
            film.smooth();
        }
        if let Some(paper) = &mut paper {
            let mut floor = Floor::traced(make, camera, view as u32, frame, size);
            if options.smooth {
                floor.smooth();
            }
            floor.shade(paper, size[0] as usize);
        }
        films.push(film);
    }
    match paper {
        Some(paper) => developed(&films, &frames, paper, size),
        None => cut_out(&films, &frames, size),
    }
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
fn trace_band<'a>(
    tracer: impl Fn() -> Tracer<'a> + Sync + Send,
    camera: &Camera,
    view: usize,
    frame: &Frame,
    rows: std::ops::Range<usize>,
    paths: u32,
) -> Vec<Pixel> {
    let size = [frame[2], frame[3]];
    let width = frame[2] as usize;
    (rows.start * width..rows.end * width)
        .into_par_iter()
        .with_min_len(64)
        .map_init(tracer, |tracer, at| {
            let place = [(at % width) as u32, (at / width) as u32];
            Pixel::traced(tracer, camera, view as u32, place, size, paths.max(1))
        })
        .collect()
}

/// Hands over the pixels of all views with their numbers on the sheet.
fn each_pixel(films: &[Film], frames: &[Frame], width: usize, mut take: impl FnMut(usize, &Pixel)) {
    for (film, frame) in films.iter().zip(frames) {
        for (y, line) in film.pixels.chunks(film.size[0].max(1)).enumerate() {
            let start = (frame[1] as usize + y) * width + frame[0] as usize;
            line.iter().enumerate().for_each(|(x, pixel)| take(start + x, pixel));
        }
    }
}

/// The sheet of all views before the shaded paper.
fn developed(
    films: &[Film],
    frames: &[Frame],
    mut light: Vec<Light3>,
    size: [u32; 2],
) -> RgbaImage {
    let width = size[0] as usize;
    each_pixel(films, frames, width, |at, pixel| {
        if let Some(light) = light.get_mut(at) {
            *light = pixel.light(light);
        }
    });
    let bytes = light
        .par_iter()
        .enumerate()
        .flat_map_iter(|(at, light)| tone::developed(light, grit(at, width)))
        .collect();
    RgbaImage::from_raw(size[0], size[1], bytes).unwrap_or_default()
}

/// The sheet of all views with nothing behind them: each pixel as opaque as it is covered.
fn cut_out(films: &[Film], frames: &[Frame], size: [u32; 2]) -> RgbaImage {
    let width = size[0] as usize;
    let mut picture = RgbaImage::new(size[0], size[1]);
    each_pixel(films, frames, width, |at, pixel| {
        let (x, y) = ((at % width) as u32, (at / width) as u32);
        if pixel.cover > 0.0 && y < size[1] {
            let mut bytes = tone::developed(&pixel.own_light(), grit(at, width));
            bytes[3] = (pixel.cover * 255.0 + 0.5) as u8;
            picture.put_pixel(x, y, image::Rgba(bytes));
        }
    });
    picture
}

/// An even number from 0 to 1 for each pixel, to round with.
fn grit(at: usize, width: usize) -> f32 {
    let (x, y) = ((at % width) as u32, (at / width) as u32);
    Sampler::new(u32::MAX, [x, y], 0, 1).pair()[0]
}
