//! How long pictures take, in processor time, which other work on the machine leaves alone:
//! `cargo bench --bench render`
//!
//! - paths a second on the sheet of 128 × 128 particles on a ball (one lamp and the walls, up to
//!   five bounces, 900 × 1200, no smoothing), for a plain anisotropic cloth and for woven satin;
//! - a dressed figure, 1024 × 1024, woven satin, `normal`;
//! - a camera that moves from 3 m to 5 cm in 30 pictures: by how much each picture differs from
//!   the part of the one before that it shows.

#![allow(clippy::disallowed_methods, clippy::print_stdout, dead_code)]

#[path = "../tests/render/studio.rs"]
mod studio;

use darzi::drape::draped::{Draped, Stats};
use darzi::evaluate::{self, evaluate};
use darzi::garment::scene::{Background, Picture, Quality, Shading, View};
use darzi::mesh::compiled::Compiled;
use darzi::progress::Quiet;
use darzi::render::{Options, render};
use darzi::textile::fabric::Finish;
use darzi::textile::yarn::Fibre;
use darzi::world::{Memory, World};
use image::RgbaImage;
use nalgebra::Point3;
use std::time::Instant;

const RED: [u8; 3] = [178, 58, 48];

fn main() {
    paths("sheet, plain cotton", Finish::Matte, Fibre::Cotton, None);
    paths("sheet, woven satin", Finish::Satin, Fibre::Silk, Some(Shading::WovenSatin));
    let fabric = studio::fabric(Finish::Satin, Fibre::Silk, RED);
    let (compiled, draped) = studio::skirt(fabric, studio::woven(RED));
    let picture = Picture {
        views: vec![View::ThreeQuarter],
        size: [1024, 1024],
        shading: Some(Shading::WovenSatin),
        ..Picture::default()
    };
    let (seconds, wall, _) =
        timed(|| render(&compiled, &draped, &picture, &Options::of(Quality::Normal), &mut Quiet));
    println!("dressed figure, 1024 x 1024: {seconds:.1} CPU s, {wall:.1} s by the clock");
    zoom();
}

/// Time of the processor that the program has used, all threads together, s.
fn processor() -> f64 {
    // Fields 14 and 15 after the name in brackets, in hundredths of a second (`man 5 proc`).
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let fields = stat.rsplit(')').next().unwrap_or_default().split_whitespace();
    fields.skip(11).take(2).filter_map(|field| field.parse::<f64>().ok()).sum::<f64>() / 100.0
}

/// Processor time, time by the clock, and what was made.
fn timed<T>(work: impl FnOnce() -> T) -> (f64, f64, T) {
    let (start, clock) = (processor(), Instant::now());
    let made = work();
    (processor() - start, clock.elapsed().as_secs_f64(), made)
}

fn paths(name: &str, finish: Finish, fibre: Fibre, shading: Option<Shading>) {
    let fabric = studio::fabric(finish, fibre, RED);
    let (compiled, draped) = studio::sheet_on_ball(fabric, studio::woven(RED));
    let picture = Picture {
        size: [900, 1200],
        shading,
        // Without paper nothing but the paths of the figure is traced.
        background: Background::None,
        ..Picture::default()
    };
    let options = Options { paths: 16, bounces: 5, smooth: false };
    let (seconds, _, image) = timed(|| render(&compiled, &draped, &picture, &options, &mut Quiet));
    // A pixel of which four paths found nothing is left at that.
    let count: u64 = image.pixels().map(|pixel| if pixel.0[3] > 0 { 16 } else { 4 }).sum();
    let bare = image.pixels().filter(|pixel| pixel.0[3] == 0).count() * 4;
    let met = count - bare as u64;
    let rate = |paths: u64| paths as f64 / seconds / 1e6;
    println!(
        "{name}: {:.2} million paths a CPU second, of pixels with cloth or ball {:.2}",
        rate(count),
        rate(met)
    );
}

/// A twill in two colours, upright, a little bent.
fn cloth() -> (Compiled, Draped) {
    let text = "
yarn w20 { count: 40tex plies: 2 twist: 560turns/m S fibre: wool color: #2c3a5c }
weave serge { twill 2/2 Z }
fabric twilled {
    structure: serge
    warp: w20 at 16/cm
    weft: w20 at 15/cm color #d8c8a8
    mass: 150g/m2 thickness: 0.5mm bending: 9uN.m finish: wool
}
scene piece {
    cloth sheet of twilled { size: 1m x 1m  grid: 1cm  at: (0cm, 1m, 0cm)  facing: front }
}
";
    let mut world = Memory::new([("main.garment", text)]);
    let root = world.open("main.garment").expect("the text is there");
    let (garments, told) = evaluate(&mut world, root, &evaluate::Options::default());
    let garment = garments.first().unwrap_or_else(|| panic!("{told:?}"));
    let compiled = darzi::mesh::compile(garment, &Default::default()).expect("a square");
    let positions = compiled
        .particles
        .iter()
        .map(|[u, v]| Point3::new(*u, 1.0 + v, 0.02 * (u * 14.0).sin() + 0.01 * (v * 9.0).sin()))
        .collect();
    (compiled, Draped { positions, surfaces: Vec::new(), stats: Stats::default() })
}

/// The camera stands so many times as far from the cloth as the field is high, see
/// `render::camera`.
const AWAY: f64 = 2.8;

fn zoom() {
    const PICTURES: usize = 30;
    const SIDE: u32 = 480;
    let (compiled, draped) = cloth();
    let step = (0.05_f64 / 3.0).powf(1.0 / (PICTURES - 1) as f64);
    let mut last: Option<RgbaImage> = None;
    let (mut worst, mut sum) = (0.0_f64, 0.0);
    let (seconds, wall, ()) = timed(|| {
        for k in 0..PICTURES {
            let distance = 3.0 * step.powi(k as i32);
            let picture =
                Picture { size: [SIDE, SIDE], field: Some(distance / AWAY), ..Picture::default() };
            let image =
                render(&compiled, &draped, &picture, &Options::of(Quality::Normal), &mut Quiet);
            if let Some(last) = &last {
                let off = jump(last, &image, step);
                sum += off;
                if off > worst {
                    worst = off;
                    println!("  from {:.3} m to {distance:.3} m: {off:.2}", distance / step);
                }
            }
            last = Some(image);
        }
    });
    println!(
        "zoom from 3 m to 5 cm, {PICTURES} pictures: the largest jump is {worst:.2} of 255, the \
         mean {:.2}; {seconds:.0} CPU s, {wall:.0} s by the clock",
        sum / (PICTURES - 1) as f64
    );
}

/// The largest difference between the means of 12 × 12 fields of a picture and of the part of the
/// picture before that it shows, in steps of a byte, over the three colours: what an eye that does
/// not tell threads apart would see.
fn jump(before: &RgbaImage, after: &RgbaImage, step: f64) -> f64 {
    const FIELDS: usize = 12;
    let means = |image: &RgbaImage, share: f64| {
        let (width, height) = (f64::from(image.width()), f64::from(image.height()));
        let mut means = Vec::new();
        for row in 0..FIELDS {
            for column in 0..FIELDS {
                let edge =
                    |n: usize, whole: f64| whole * (0.5 + share * (n as f64 / FIELDS as f64 - 0.5));
                let mut sum = [0.0; 3];
                let mut count = 0.0;
                for y in edge(row, height) as u32..edge(row + 1, height) as u32 {
                    for x in edge(column, width) as u32..edge(column + 1, width) as u32 {
                        let pixel = image.get_pixel(x, y).0;
                        (0..3).for_each(|k| sum[k] += f64::from(pixel[k]));
                        count += 1.0;
                    }
                }
                means.push(sum.map(|channel| channel / f64::max(count, 1.0)));
            }
        }
        means
    };
    // The outermost tenth is left out: there the pictures end.
    let (before, after) = (means(before, 0.9 * step), means(after, 0.9));
    before
        .iter()
        .zip(&after)
        .flat_map(|(a, b)| (0..3).map(|k| (a[k] - b[k]).abs()))
        .fold(0.0, f64::max)
}
