//! How long a picture takes: a skirt on a form, 900 × 1200, at the default quality.
//! `cargo bench --bench render`

#![allow(clippy::disallowed_methods, clippy::print_stdout, dead_code)]

#[path = "../tests/render/studio.rs"]
mod studio;

use darzi::garment::scene::{Picture, View};
use darzi::progress::Quiet;
use darzi::render::{Options, render};
use darzi::textile::fabric::Finish;
use darzi::textile::yarn::Fibre;

fn main() {
    divan::main();
}

#[divan::bench(args = [[900, 1200]], sample_count = 3, sample_size = 1)]
fn skirt(size: [u32; 2]) -> image::RgbaImage {
    let colour = [178, 58, 48];
    let fabric = studio::fabric(Finish::Matte, Fibre::Cotton, colour);
    let (compiled, draped) = studio::skirt(fabric, studio::woven(colour));
    let picture = Picture { views: vec![View::ThreeQuarter], size, ..Picture::default() };
    render(&compiled, &draped, &picture, &Options::default(), &mut Quiet)
}
