//! What a picture must show, looked at through small pictures of things made by hand.

#![allow(clippy::disallowed_methods, clippy::print_stdout)]

mod studio;

use darzi::drape::draped::{Draped, Stats};
use darzi::garment::scene::{Background, Picture, Quality, Shading, View};
use darzi::mesh::compiled::{Atlas, Compiled, Region};
use darzi::progress::Quiet;
use darzi::render::{Options, Pass, passes, render};
use darzi::textile::fabric::Finish;
use darzi::textile::yarn::Fibre;
use image::RgbaImage;
use nalgebra::Point3;

const RED: [u8; 3] = [178, 58, 48];

fn shown(dressed: &(Compiled, Draped), views: &[View], size: [u32; 2]) -> RgbaImage {
    let picture = Picture { views: views.to_vec(), size, ..Picture::default() };
    render(&dressed.0, &dressed.1, &picture, &Options::default(), &mut Quiet)
}

fn cotton() -> darzi::textile::fabric::Fabric {
    studio::fabric(Finish::Matte, Fibre::Cotton, RED)
}

/// Mean of a channel over the pixels between two points of the picture (shares of its size).
fn mean(image: &RgbaImage, from: [f32; 2], to: [f32; 2], channel: usize) -> f32 {
    let edge = |share: f32, whole: u32| (share * whole as f32) as u32;
    let (mut sum, mut count) = (0.0, 0.0);
    for y in edge(from[1], image.height())..edge(to[1], image.height()) {
        for x in edge(from[0], image.width())..edge(to[0], image.width()) {
            sum += f32::from(image.get_pixel(x, y).0[channel]);
            count += 1.0;
        }
    }
    sum / count
}

#[test]
fn the_same_bytes_on_one_thread_and_on_many() {
    let skirt = studio::skirt(cotton(), studio::woven(RED));
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| shown(&skirt, &[View::Front, View::ThreeQuarter], [120, 90]))
    };
    assert_eq!(on(1).into_raw(), on(3).into_raw());
}

#[test]
fn a_red_skirt_stands_in_the_middle_of_grey_paper() {
    let skirt = studio::skirt(cotton(), studio::woven(RED));
    let image = shown(&skirt, &[View::Front], [90, 120]);
    let (from, to) = ([0.40, 0.48], [0.60, 0.66]);
    let [red, green, blue] = [0, 1, 2].map(|channel| mean(&image, from, to, channel));
    assert!(red > 2.0 * green && red > 2.0 * blue && red > 100.0, "{red} {green} {blue}");
    let (from, to) = ([0.02, 0.02], [0.2, 0.3]);
    let [red, green, blue] = [0, 1, 2].map(|channel| mean(&image, from, to, channel));
    assert!(red > 170.0 && (red - green).abs() < 4.0 && (green - blue).abs() < 4.0);
}

#[test]
fn the_key_lamp_throws_a_soft_shadow_to_the_right() {
    let ball = studio::sheet_on_ball(cotton(), studio::woven(RED));
    let image = shown(&ball, &[View::Front], [120, 120]);
    let right = mean(&image, [0.90, 0.88], [0.98, 0.94], 1);
    let left = mean(&image, [0.02, 0.88], [0.10, 0.94], 1);
    assert!(right < left - 8.0, "{right} beside {left}");
    // Light from the walls reaches everywhere: nothing is black.
    assert!(image.pixels().all(|pixel| pixel.0.iter().any(|c| *c > 12)));
}

/// An upright sheet of 1 m facing the viewer, with `atlas` shown once all over.
fn poster(mut atlas: Atlas) -> (Compiled, Draped) {
    if let Some(region) = atlas.regions.first_mut() {
        region.size = [1.0, 1.0];
        region.tiles = false;
    }
    sheet_in_the_air(atlas)
}

fn sheet_in_the_air(atlas: Atlas) -> (Compiled, Draped) {
    let mut compiled = Compiled { fabrics: vec![cotton()], atlas, ..Compiled::default() };
    let mut positions = Vec::new();
    let rest = |s: f64, t: f64| [s, t];
    let place = |s: f64, t: f64| Point3::new(s - 0.5, 0.6 + t, 0.0);
    studio::sheet("poster", &mut compiled, &mut positions, [8, 8], rest, place);
    (compiled, Draped { positions, surfaces: Vec::new(), stats: Stats::default() })
}

/// Two by two fields, from the top left: red, green, blue, yellow.
fn fields() -> Atlas {
    let colours = [[200, 20, 20], [20, 160, 20], [20, 20, 200], [200, 180, 20]];
    let mut pixels = Vec::new();
    for y in 0..16 {
        for x in 0..16 {
            pixels.extend(colours[y / 8 * 2 + x / 8]);
            pixels.push(255);
        }
    }
    let region = Region {
        name: "fields.face".to_owned(),
        pixels: [0, 0, 16, 16],
        size: [1.0, 1.0],
        tiles: false,
        detail: None,
        shot: None,
    };
    Atlas { width: 16, height: 16, pixels, regions: vec![region] }
}

#[test]
fn a_textile_lies_upright_and_is_mirrored_from_behind() {
    let poster = poster(fields());
    let largest = |image: &RgbaImage, x: f32, y: f32| {
        let means = [0, 1, 2].map(|c| mean(image, [x, y], [x + 0.1, y + 0.1], c));
        (0..3).max_by(|a, b| means[*a].total_cmp(&means[*b])).unwrap_or(3)
    };
    let front = shown(&poster, &[View::Front], [80, 80]);
    assert_eq!([largest(&front, 0.25, 0.25), largest(&front, 0.65, 0.25)], [0, 1]);
    assert_eq!(largest(&front, 0.25, 0.65), 2);
    let back = shown(&poster, &[View::Back], [80, 80]);
    assert_eq!([largest(&back, 0.25, 0.25), largest(&back, 0.65, 0.25)], [1, 0]);
}

#[test]
fn threads_too_fine_to_see_leave_their_mean_colour() {
    // Black and white threads of 0.4 mm against an even grey of the same mean light: half of
    // white is 188 in sRGB.
    let tile = |even: bool| {
        let mut atlas = studio::woven(RED);
        for (k, pixel) in atlas.pixels.chunks_mut(4).enumerate() {
            let byte = match (even, k % 16 < 8) {
                (true, _) => 188,
                (false, true) => 255,
                (false, false) => 0,
            };
            pixel[..3].fill(byte);
        }
        shown(&sheet_in_the_air(atlas), &[View::Front], [64, 64])
    };
    let (even, striped) = (tile(true), tile(false));
    for y in 16..48 {
        for x in 16..48 {
            let (a, b) = (even.get_pixel(x, y).0[1], striped.get_pixel(x, y).0[1]);
            // White itself is held a little below 1, which takes 3 % of its light: 3 steps.
            assert!(a.abs_diff(b) <= 5, "{a} {b}: threads alias or lose light");
        }
    }
}

#[test]
fn light_comes_through_thin_cloth_and_between_threads() {
    // Seen from the front, lit from behind by the rim lamp and the wall: a gauze of the same
    // colour as a heavy cloth lets paper and light through.
    let mut gauze = studio::woven([30, 30, 30]);
    gauze.pixels.chunks_mut(4).for_each(|pixel| pixel[3] = 64);
    let gauze = shown(&sheet_in_the_air(gauze), &[View::Front], [48, 48]);
    let dense = shown(&sheet_in_the_air(studio::woven([30, 30, 30])), &[View::Front], [48, 48]);
    let middle = |image: &RgbaImage| mean(image, [0.4, 0.4], [0.6, 0.6], 1);
    assert!(middle(&gauze) > middle(&dense) + 60.0);
}

#[test]
fn damaged_values_still_give_a_picture() {
    let (mut compiled, mut draped) = studio::skirt(cotton(), studio::woven(RED));
    draped.positions[5] = Point3::new(f64::NAN, 0.0, 0.0);
    draped.positions[9] = Point3::new(1e300, 0.0, 0.0);
    draped.positions.truncate(4000);
    compiled.cells[3] = [u32::MAX; 4];
    compiled.atlas.pixels.clear();
    compiled.panels[1].fabric = 7;
    draped.surfaces[0].normals.truncate(10);
    shown(&(compiled, draped), &[View::Front, View::Top], [40, 30]);
    let nothing = (
        Compiled::default(),
        Draped { positions: vec![], surfaces: vec![], stats: Stats::default() },
    );
    let image = shown(&nothing, &[], [0, 0]);
    assert_eq!(image.dimensions(), (1, 1));
}

#[test]
fn a_cut_out_is_transparent_beside_the_figure_and_opaque_on_it() {
    let skirt = studio::skirt(cotton(), studio::woven(RED));
    let picture = Picture { size: [60, 80], background: Background::None, ..Picture::default() };
    let image = render(&skirt.0, &skirt.1, &picture, &Options::default(), &mut Quiet);
    assert_eq!(image.get_pixel(3, 3).0[3], 0);
    assert_eq!(image.get_pixel(30, 45).0[3], 255);
    let edge = image.pixels().filter(|pixel| (1..255).contains(&pixel.0[3])).count();
    assert!(edge > 20, "the outline is soft: {edge}");
}

#[test]
fn passes_tell_distance_direction_fabric_and_strain() {
    // A flat sheet of 1 m that is drawn by 2 % along the weft, one metre up.
    let mut compiled = Compiled { fabrics: vec![cotton()], ..Compiled::default() };
    let mut positions = Vec::new();
    let rest = |s: f64, t: f64| [s, t];
    let place = |s: f64, t: f64| Point3::new(1.02 * (s - 0.5), 0.6 + t, 0.0);
    studio::sheet("sheet", &mut compiled, &mut positions, [8, 8], rest, place);
    let draped = Draped { positions, surfaces: Vec::new(), stats: Stats::default() };
    let picture = Picture { size: [64, 64], ..Picture::default() };
    let images = passes(&compiled, &draped, &picture, &Pass::ALL);
    let [depth, normal, fabric, strain] = &images[..] else { panic!("four were asked for") };
    let (depth, strain) = (depth.as_luma16().unwrap(), strain.as_luma16().unwrap());
    // The camera stands 5.6 half extents of 0.51 m away.
    assert!(depth.get_pixel(32, 32).0[0].abs_diff(28_560) < 40, "{:?}", depth.get_pixel(32, 32));
    assert!(strain.get_pixel(30, 34).0[0].abs_diff(32_768 + 200) <= 1);
    let [right, up, out] = normal.as_rgb8().unwrap().get_pixel(32, 32).0;
    assert!(right.abs_diff(128) <= 1 && up.abs_diff(128) <= 1 && out >= 254);
    let fabric = fabric.as_luma8().unwrap();
    assert_eq!([fabric.get_pixel(32, 32).0[0], fabric.get_pixel(1, 1).0[0]], [1, 0]);
    assert_eq!([depth.get_pixel(1, 1).0[0], strain.get_pixel(1, 1).0[0]], [0, 0]);
}

#[test]
fn every_way_of_shading_shows_the_cloth_in_its_colour() {
    let ball = studio::sheet_on_ball(cotton(), studio::woven(RED));
    for shading in Shading::ALL {
        if !shading.suits(&ball.0.fabrics[0].structure) {
            continue;
        }
        let picture = Picture {
            size: [80, 80],
            shading: Some(shading),
            quality: Quality::Draft,
            ..Picture::default()
        };
        let image = render(&ball.0, &ball.1, &picture, &Options::of(picture.quality), &mut Quiet);
        let red = |pixel: &&image::Rgba<u8>| {
            f32::from(pixel.0[0]) > 1.4 * f32::from(pixel.0[1]) && pixel.0[0] > 40
        };
        let shown = image.pixels().filter(red).count();
        // The cloth fills about a third of the picture.
        assert!(shown > 640, "{}: {shown} of 6400", shading.name());
    }
}

#[test]
fn threads_show_from_near_by_and_leave_the_light_as_it_was() {
    // Seen through 8 mm the threads, 0.4 mm apart, are 10 pixels wide.
    let mut atlas = studio::woven(RED);
    for pixel in atlas.pixels.chunks_mut(4) {
        pixel[..3].copy_from_slice(&RED);
    }
    let dressed = sheet_in_the_air(atlas);
    let near = |shading: Option<Shading>, field: f64| {
        let picture =
            Picture { size: [200, 200], shading, field: Some(field), ..Picture::default() };
        render(&dressed.0, &dressed.1, &picture, &Options::default(), &mut Quiet)
    };
    let (yarns, flat) = (near(None, 8e-3), near(Some(Shading::Textured), 8e-3));
    let spread = |image: &RgbaImage| {
        let mean = mean(image, [0.2, 0.2], [0.8, 0.8], 0);
        let mut sum = 0.0;
        for y in 40..160 {
            for x in 40..160 {
                sum += (f32::from(image.get_pixel(x, y).0[0]) - mean).powi(2);
            }
        }
        (mean, (sum / 14_400.0).sqrt())
    };
    let ((lit, deep), (even, _)) = (spread(&yarns), spread(&flat));
    assert!(deep > 12.0, "threads have sides: {deep}");
    // What yarns take from each other and what shows between them is a tenth or so.
    assert!((lit / even - 1.0).abs() < 0.12, "{lit} against {even}");
    // Nothing jumps where the one goes over into the other.
    let mut last: Option<f32> = None;
    for step in 0..7 {
        let image = near(None, 16e-3 * 1.25_f64.powi(step));
        let level = mean(&image, [0.2, 0.2], [0.8, 0.8], 0);
        if let Some(last) = last {
            assert!((level - last).abs() < 8.0, "{last}, then {level}");
        }
        last = Some(level);
    }
}
