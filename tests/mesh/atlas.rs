//! The atlas: tiles that close on themselves, colours that are right on the mean, matrices that
//! can be read off the picture, and the same bytes always.

use darzi::diagnostic::Span;
use darzi::garment::Garment;
use darzi::garment::cloth::Surface;
use darzi::garment::panel::Panel;
use darzi::garment::sari::{Band, BandFill, Part, Repeat, Sari, Spots, Stripe};
use darzi::garment::scene::Placement;
use darzi::mesh::atlas;
use darzi::mesh::compiled::{Compiled, MeshPanel, Region, Stretch};
use darzi::textile::Colour;
use darzi::textile::fabric::{Fabric, Finish, Structure, Thread};
use darzi::textile::knit::{Knit, Stitch};
use darzi::textile::motif::Motif;
use darzi::textile::weave::Weave;
use darzi::textile::yarn::{Fibre, Twist, Yarn};
use std::path::Path;

const WHITE: [u8; 3] = [232, 228, 218];
const BLUE: [u8; 3] = [52, 70, 120];
const RED: [u8; 3] = [150, 40, 45];
const GOLD: Colour = Colour([201, 162, 62, 255]);

fn opaque([red, green, blue]: [u8; 3]) -> Colour {
    Colour([red, green, blue, 255])
}

fn yarn(tex: f64, fibre: Fibre, plies: u32, twist: f64, colour: [u8; 3]) -> Yarn {
    let count = tex * 1e-6;
    let diameter = Yarn::diameter_of(count, fibre);
    let (name, direction) = ("yarn".into(), Twist::Z);
    Yarn { name, count, plies, twist, direction, fibre, colour: opaque(colour), diameter }
}

fn fabric(name: &str, structure: Structure, finish: Finish) -> Fabric {
    Fabric {
        name: name.into(),
        mass: structure.mass(),
        thickness: structure.thickness(),
        structure,
        bending: [1e-5; 2],
        tensile: [1e3; 2],
        shear: 50.0,
        poisson: 0.25,
        friction: 0.3,
        damping: 0.02,
        finish,
    }
}

/// A woven fabric of two yarns at so many threads per cm.
fn woven(name: &str, weave: Weave, warp: (Yarn, f64), weft: (Yarn, f64)) -> Fabric {
    let thread =
        |(yarn, sett): (Yarn, f64)| Thread { colour: yarn.colour, spacing: 0.01 / sett, yarn };
    let structure = Structure::Woven { weave, warp: thread(warp), weft: thread(weft) };
    fabric(name, structure, Finish::Matte)
}

/// A knitted fabric from its chart, `.` face and `-` back, top row first; stitches and rows per
/// 10 cm.
fn knitted(name: &str, chart: &[&str], gauge: [f64; 2], yarn: Yarn) -> Fabric {
    let stitch = |c| if c == '.' { Stitch::Face } else { Stitch::Back };
    let rows = chart.iter().rev().map(|row| row.chars().map(stitch).collect()).collect();
    let knit = Knit::of_loops(name, rows, 10.0 * gauge[0], 10.0 * gauge[1]).unwrap();
    fabric(name, Structure::Knitted { knit, yarn }, Finish::Wool)
}

fn poplin() -> Fabric {
    let cotton = || yarn(14.5, Fibre::Cotton, 1, 900.0, WHITE);
    woven("poplin", Weave::plain(), (cotton(), 44.0), (cotton(), 30.0))
}

fn denim() -> Fabric {
    let warp = yarn(74.0, Fibre::Cotton, 1, 550.0, BLUE);
    let weft = yarn(60.0, Fibre::Cotton, 1, 550.0, WHITE);
    woven("denim", Weave::twill(&[3, 1], Twist::Z, 1).unwrap(), (warp, 26.0), (weft, 18.0))
}

fn stocking() -> Fabric {
    knitted("stocking", &["."], [22.0, 30.0], yarn(250.0, Fibre::Wool, 4, 180.0, RED))
}

/// A garment of one panel a fabric, and its mesh without a particle.
fn garment(fabrics: Vec<Fabric>, sari: Option<Sari>) -> (Garment, Compiled) {
    let placement = Placement::Led;
    let mut panels = Vec::new();
    let mut meshes = Vec::new();
    for (number, fabric) in fabrics.iter().enumerate() {
        let surface = match (&sari, number) {
            (Some(sari), 0) => Surface::Sari(Box::new(sari.clone())),
            _ => Surface::Fabric,
        };
        panels.push(Panel {
            name: fabric.name.clone(),
            span: Span::default(),
            fabric: number,
            grain: 0.0,
            cell: None,
            layer: 0,
            loops: vec![],
            edges: vec![],
            allowance: 0.01,
            creases: vec![],
            marks: vec![],
            notches: vec![],
            bands: vec![],
            surface,
            placement: placement.clone(),
        });
        let none = Stretch::default();
        meshes.push(MeshPanel {
            name: fabric.name.clone(),
            fabric: number,
            cell: 0.005,
            layer: 0,
            grain: 0.0,
            placement: placement.clone(),
            particles: none,
            cells: none,
            triangles: none,
            loops: vec![],
            edges: vec![],
            surfaces: vec![],
        });
    }
    let garment = Garment {
        name: "cloths".into(),
        span: Span::default(),
        fabrics,
        panels,
        seams: vec![],
        stitches: vec![],
        nearby: vec![],
        patches: vec![],
        cords: vec![],
        ties: vec![],
        bodies: vec![],
        solids: vec![],
        attachments: vec![],
        pins: vec![],
        schedule: vec![],
        pictures: vec![],
        grade: Vec::new(),
    };
    (garment, Compiled { panels: meshes, ..Compiled::default() })
}

fn drawn(fabrics: Vec<Fabric>, sari: Option<Sari>) -> Compiled {
    let (garment, mut compiled) = garment(fabrics, sari);
    atlas::draw(&garment, &mut compiled);
    compiled
}

/// One region as a picture of its own.
struct Tile<'a> {
    compiled: &'a Compiled,
    region: &'a Region,
}

impl<'a> Tile<'a> {
    fn of(compiled: &'a Compiled, name: &str) -> Tile<'a> {
        let region = compiled.atlas.regions.iter().find(|region| region.name == name).unwrap();
        Tile { compiled, region }
    }

    fn size(&self) -> [i64; 2] {
        [i64::from(self.region.pixels[2]), i64::from(self.region.pixels[3])]
    }

    /// A pixel counted from the region's left and top; beyond its sides lies the gutter.
    fn at(&self, column: i64, row: i64) -> [u8; 4] {
        let atlas = &self.compiled.atlas;
        let x = (i64::from(self.region.pixels[0]) + column) as usize;
        let y = (i64::from(self.region.pixels[1]) + row) as usize;
        let n = 4 * (y * atlas.width as usize + x);
        atlas.pixels[n..n + 4].try_into().unwrap()
    }

    fn pixels(&self) -> impl Iterator<Item = [u8; 4]> + '_ {
        let [width, height] = self.size();
        (0..height).flat_map(move |row| (0..width).map(move |column| self.at(column, row)))
    }

    /// Mean of the light, weighed by opacity.
    fn mean(&self) -> [f64; 3] {
        let mut sum = [0.0; 3];
        let mut weight = 0.0;
        for pixel in self.pixels() {
            let opacity = f64::from(pixel[3]);
            weight += opacity;
            for (sum, light) in sum.iter_mut().zip(Colour(pixel).linear()) {
                *sum += opacity * light;
            }
        }
        sum.map(|sum| sum / weight)
    }

    fn save(&self, file: &Path) {
        let [width, height] = self.size();
        let bytes: Vec<u8> = self.pixels().flatten().collect();
        let picture = image::RgbaImage::from_raw(width as u32, height as u32, bytes).unwrap();
        picture.save(file).unwrap();
    }
}

/// The fabrics of a small shop.
fn shelf() -> Vec<Fabric> {
    let wool = |colour| yarn(250.0, Fibre::Wool, 4, 180.0, colour);
    let jute = || yarn(280.0, Fibre::Jute, 1, 160.0, [176, 140, 92]);
    let silk = |tex| yarn(tex, Fibre::Silk, 1, 300.0, RED);
    let linen = |colour| yarn(40.0, Fibre::Linen, 2, 500.0, colour);
    let tweed = |colour| yarn(60.0, Fibre::Wool, 2, 400.0, colour);
    let basket: Vec<&str> = [["....----"; 4], ["----...."; 4]].concat();
    vec![
        poplin(),
        denim(),
        woven("satin", Weave::satin(8, 3).unwrap(), (silk(7.0), 90.0), (silk(10.0), 36.0)),
        woven("panama", Weave::basket(2).unwrap(), (linen(WHITE), 18.0), (linen(BLUE), 18.0)),
        woven("hessian", Weave::plain(), (jute(), 5.0), (jute(), 5.0)),
        woven(
            "tweed",
            Weave::twill(&[2, 2], Twist::S, 1).unwrap(),
            (tweed([120, 95, 70]), 14.0),
            (tweed([70, 66, 60]), 14.0),
        ),
        stocking(),
        knitted("rib", &["..--"], [24.0, 31.0], wool(WHITE)),
        knitted("garter", &[".", "-"], [20.0, 40.0], wool(WHITE)),
        knitted("basket", &basket, [22.0, 30.0], wool([90, 110, 90])),
        knitted("jersey", &["."], [140.0, 180.0], yarn(20.0, Fibre::Cotton, 1, 700.0, BLUE)),
    ]
}

/// Every tile keeps the mean colour of its yarns: cloth seen from far has the colour it should.
/// The tiles lie in the target folder afterwards, to be looked at.
#[test]
fn a_tile_has_the_mean_colour_of_its_yarns() {
    let compiled = drawn(shelf(), None);
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    for fabric in shelf() {
        let (colours, share) = match &fabric.structure {
            Structure::Woven { weave, warp, weft } => {
                ([warp.colour, weft.colour], weave.warp_share())
            }
            Structure::Knitted { yarn, .. } => ([yarn.colour; 2], 1.0),
        };
        for (side, share) in [("face", share), ("back", 1.0 - share)] {
            let tile = Tile::of(&compiled, &format!("{}.{side}", fabric.name));
            tile.save(&folder.join(format!("{}.{side}.png", fabric.name)));
            let [warp, weft] = colours.map(Colour::linear);
            let mean = tile.mean();
            // The share of warp that explains the mean best: the matrix gives it, but for float
            // threads, which spread over their neighbours, and gaps.
            let apart: f64 = (0..3).map(|n| (warp[n] - weft[n]).powi(2)).sum();
            let toward: f64 = (0..3).map(|n| (mean[n] - weft[n]) * (warp[n] - weft[n])).sum();
            let found = if apart > 0.0 { toward / apart } else { share };
            assert!((found - share).abs() < 0.22, "{} {side}: {found} for {share}", fabric.name);
            for n in 0..3 {
                let expected = found * warp[n] + (1.0 - found) * weft[n];
                // White yarn gives up a tenth, so that its lights keep their form.
                let error = (mean[n] - expected) / expected;
                assert!((-0.10..0.03).contains(&error), "{} {side} {n}: {error}", fabric.name);
            }
        }
    }
}

#[test]
fn a_tile_closes_on_itself() {
    let compiled = drawn(vec![poplin(), denim(), stocking()], None);
    for region in &compiled.atlas.regions {
        let tile = Tile::of(&compiled, &region.name);
        let [width, height] = tile.size();
        for n in 0..height {
            assert_eq!(tile.at(-1, n), tile.at(width - 1, n), "left gutter of {}", region.name);
            assert_eq!(tile.at(width, n), tile.at(0, n), "right gutter of {}", region.name);
        }
        for n in 0..width {
            assert_eq!(tile.at(n, -1), tile.at(n, height - 1), "top gutter of {}", region.name);
            assert_eq!(tile.at(n, height), tile.at(n, 0), "bottom gutter of {}", region.name);
        }
        // The step over the joint is one of the steps inside: no larger than the largest mean
        // step of any two neighbouring columns or rows.
        let step = |a: [u8; 4], b: [u8; 4]| -> i64 {
            (0..3).map(|n| (i64::from(a[n]) - i64::from(b[n])).abs()).sum()
        };
        let across = |column: i64| -> i64 {
            (0..height).map(|row| step(tile.at(column, row), tile.at(column + 1, row))).sum()
        };
        let down = |row: i64| -> i64 {
            (0..width).map(|column| step(tile.at(column, row), tile.at(column, row + 1))).sum()
        };
        assert!(across(width - 1) <= (0..width - 1).map(across).max().unwrap(), "{}", region.name);
        assert!(down(height - 1) <= (0..height - 1).map(down).max().unwrap(), "{}", region.name);
    }
}

/// At the middle of every crossing the picture shows the thread that the matrix puts on top.
#[test]
fn the_matrix_can_be_read_off_the_picture() {
    let cotton = |colour| yarn(30.0, Fibre::Cotton, 1, 700.0, colour);
    let weaves = [
        Weave::plain(),
        Weave::twill(&[2, 1], Twist::Z, 1).unwrap(),
        Weave::twill(&[3, 1, 1, 2], Twist::S, 1).unwrap(),
        Weave::satin(5, 2).unwrap(),
        Weave::sateen(8, 3).unwrap(),
        Weave::basket(3).unwrap(),
        Weave::matrix(vec![vec![true, true, false], vec![false, true, true]]).unwrap(),
    ];
    let fabrics: Vec<Fabric> = weaves
        .iter()
        .map(|weave| woven(&weave.name, weave.clone(), (cotton(BLUE), 24.0), (cotton(WHITE), 20.0)))
        .collect();
    let compiled = drawn(fabrics, None);
    for weave in &weaves {
        for side in ["face", "back"] {
            let tile = Tile::of(&compiled, &format!("{}.{side}", weave.name));
            let [width, height] = tile.size();
            let threads = [24.0e2, 20.0e2]
                .iter()
                .zip(tile.region.size)
                .map(|(sett, length)| (sett * length).round() as i64)
                .collect::<Vec<i64>>();
            assert_eq!(threads[0] % weave.ends() as i64, 0, "whole repeats");
            assert_eq!(threads[1] % weave.picks() as i64, 0, "whole repeats");
            for pick in 0..threads[1] {
                for end in 0..threads[0] {
                    let column = (2 * end + 1) * width / (2 * threads[0]);
                    let row = height - 1 - (2 * pick + 1) * height / (2 * threads[1]);
                    let [red, _, blue, _] = tile.at(column, row);
                    let seen = blue > red;
                    let up = weave.warp_up(end as usize, pick as usize) == (side == "face");
                    assert_eq!(seen, up, "{} {side}: end {end}, pick {pick}", weave.name);
                }
            }
        }
    }
}

#[test]
fn knit_and_purl_look_different_and_change_sides() {
    let compiled = drawn(vec![stocking()], None);
    let [face, back] = ["stocking.face", "stocking.back"].map(|name| Tile::of(&compiled, name));
    // A V is steep, a head and foot lie flat: light changes more from column to column on the
    // face, and more from row to row on the back.
    let changes = |tile: &Tile<'_>| {
        let [width, height] = tile.size();
        let red = |column: i64, row: i64| i64::from(tile.at(column % width, row % height)[0]);
        let mut sums = [0i64; 2];
        for row in 0..height {
            for column in 0..width {
                sums[0] += (red(column + 3, row) - red(column, row)).abs();
                sums[1] += (red(column, row + 3) - red(column, row)).abs();
            }
        }
        sums[0] as f64 / sums[1] as f64
    };
    assert!(changes(&face) > 1.1, "face {}", changes(&face));
    assert!(changes(&back) < 0.9, "back {}", changes(&back));
}

#[test]
fn the_atlas_has_the_same_bytes_on_one_thread_and_many() {
    let bytes = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| drawn(vec![denim(), stocking()], None).atlas.pixels)
    };
    let one = bytes(1);
    assert!(one == bytes(3), "threads change the picture");
    assert!(!one.is_empty());
}

/// A motif from its picture, top row first: `*` gold, `o` red.
fn motif(picture: &[&str], size: [f64; 2]) -> Motif {
    let cell = |c| match c {
        '*' => Some(GOLD),
        'o' => Some(opaque(RED)),
        _ => None,
    };
    let rows = picture.iter().rev().map(|row| row.chars().map(cell).collect()).collect();
    Motif { name: "motif".into(), rows, size }
}

fn part(name: &str, ground: [u8; 3]) -> Part {
    Part {
        name: name.into(),
        ground: opaque(ground),
        shot: None,
        weave: None,
        bands: vec![],
        stripes: vec![],
        repeats: vec![],
        spots: vec![],
        edges: vec![],
    }
}

const AUBERGINE: [u8; 3] = [59, 23, 66];
const GREEN: [u8; 3] = [30, 107, 79];
const MAROON: [u8; 3] = [122, 31, 61];

fn silk() -> Fabric {
    let silk = |colour| yarn(7.3, Fibre::Silk, 3, 400.0, colour);
    woven("silk", Weave::plain(), (silk(AUBERGINE), 44.0), (silk(MAROON), 40.0))
}

/// A sari of four parts.
fn paithani() -> Sari {
    let buti = motif(&["...*...", "..***..", ".**o**.", "..***..", "...*..."], [0.018, 0.014]);
    let temple = motif(&["...*...", "..***..", ".*****.", "*******"], [0.021, 0.016]);
    let parrot = motif(
        &[
            "....***.........",
            "...**o**........",
            "..******........",
            ".*.*****........",
            "....*****.......",
            "....*******.....",
            ".....***o***....",
            ".....**ooo***...",
            "......*ooo****..",
            ".......*o*****..",
            "........*******.",
            ".........**.***.",
            "........**...***",
            ".......*.*....**",
        ],
        [0.060, 0.055],
    );
    let mut ang = part("ang", AUBERGINE);
    ang.shot = Some(opaque(MAROON));
    ang.spots =
        vec![Spots { motif: buti, pitch: [0.09, 0.09], half_drop: true, thinning: [1.0, 0.25] }];
    let mut kath = part("kath", GREEN);
    kath.repeats = vec![Repeat { motif: parrot.clone(), pitch: 0.11, flip: true }];
    kath.edges = vec![Repeat { motif: temple.in_colour(opaque(GREEN)), pitch: 0.021, flip: false }];
    kath.stripes = vec![
        Stripe { colour: GOLD, offset: 0.004, width: 0.006 },
        Stripe { colour: GOLD, offset: 0.088, width: 0.006 },
    ];
    let mut upper = part("upper", GREEN);
    upper.edges = kath.edges.clone();
    upper.stripes = vec![Stripe { colour: GOLD, offset: 0.004, width: 0.006 }];
    let mut padar = part("padar", MAROON);
    let band = |fill, length| Band { fill, length };
    padar.bands = vec![
        band(BandFill::Colour(GOLD), 0.02),
        band(BandFill::Motif(parrot.clone()), 0.14),
        band(BandFill::Colour(GOLD), 0.02),
        band(BandFill::Motif(temple.clone()), 0.05),
        band(BandFill::Motif(parrot), 0.35),
        band(BandFill::Colour(GOLD), 0.17),
    ];
    padar.edges = vec![Repeat { motif: temple, pitch: 0.021, flip: false }];
    Sari {
        name: "paithani".into(),
        length: 5.5,
        width: 1.15,
        ang,
        lower_kath: Some((kath, 0.10)),
        upper_kath: Some((upper, 0.04)),
        padar: Some((padar, 0.75)),
    }
}

/// The colour of a sari at a place of the cloth, m from its inner end and lower edge, looked up
/// as anyone who shows the panel does.
fn seen(compiled: &Compiled, [x, y]: [f64; 2], back: bool) -> [u8; 4] {
    let (u, v) = (-y, x);
    let surface = compiled.panels[0]
        .surfaces
        .iter()
        .find(|surface| {
            surface.area.is_none_or(|[u0, v0, u1, v1]| u0 <= u && u <= u1 && v0 <= v && v <= v1)
        })
        .expect("every place of the cloth shows something");
    let [u0, v0, ..] = surface.area.unwrap_or_default();
    let region = &compiled.atlas.regions[if back { surface.back } else { surface.face }];
    let tile = Tile { compiled, region };
    let [width, height] = tile.size();
    let column = (u - u0) / region.size[0] * width as f64;
    let row = height as f64 - (v - v0) / region.size[1] * height as f64;
    tile.at((column as i64).clamp(0, width - 1), (row as i64).clamp(0, height - 1))
}

/// Which of these colours it is, allowing for the unevenness of threads.
fn nearest<'a>(pixel: [u8; 4], colours: &[(&'a str, [u8; 3])]) -> &'a str {
    let distance = |colour: [u8; 3]| -> i32 {
        (0..3).map(|n| (i32::from(pixel[n]) - i32::from(colour[n])).pow(2)).sum()
    };
    colours.iter().min_by_key(|(_, colour)| distance(*colour)).unwrap().0
}

#[test]
fn the_parts_of_a_sari_lie_where_they_belong() {
    let sari = paithani();
    let compiled = drawn(vec![silk()], Some(sari.clone()));
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    for region in &compiled.atlas.regions {
        Tile { compiled: &compiled, region }.save(&folder.join(format!("{}.png", region.name)));
    }
    // Warp and weft of the shot field show half each, in linear light.
    let (warp, weft) = (opaque(AUBERGINE).linear(), opaque(MAROON).linear());
    let field = Colour::from_linear([0, 1, 2].map(|n| (warp[n] + weft[n]) / 2.0)).0;
    let field = [field[0], field[1], field[2]];
    let gold = [GOLD.0[0], GOLD.0[1], GOLD.0[2]];
    let colours =
        [("field", field), ("green", GREEN), ("gold", gold), ("maroon", MAROON), ("red", RED)];
    let at = |x, y| nearest(seen(&compiled, [x, y], false), &colours);
    // Between the spots, which lie on a grid about the middle of the field.
    assert_eq!(at(1.0, 0.57), "field");
    // The gold stripe of each border lies near its outer edge.
    assert_eq!(at(2.5, 0.007), "gold");
    assert_eq!(at(2.5, 1.15 - 0.007), "gold");
    assert_eq!(at(2.5, 0.015), "green");
    // The very corners are cloth too.
    for corner in [[0.0, 0.0], [5.5, 0.0], [0.0, 1.15], [5.5, 1.15]] {
        assert_eq!(at(corner[0], corner[1]), "green");
    }
    // Bands of the padar from the field to the end.
    assert_eq!(at(4.75 + 0.01, 0.6), "gold");
    assert_eq!(at(4.75 + 0.17, 0.6), "gold");
    assert_eq!(at(5.49, 0.6), "gold");
    // Teeth of the border stand in the field: at their foot all along, at their tip in the
    // middle of each only.
    let teeth = 5.5 / (5.5f64 / 0.021).round();
    assert_eq!(at(40.5 * teeth, 0.1 + 0.002), "green");
    assert_eq!(at(40.5 * teeth, 0.1 + 0.013), "green");
    assert_eq!(at(40.0 * teeth, 0.1 + 0.013), "field");
    assert_eq!(at(40.5 * teeth, 1.15 - 0.04 - 0.013), "green");
    // Teeth of the padar point to the field.
    let teeth = 1.01 / (1.01f64 / 0.021).round();
    assert_eq!(at(4.75 - 0.013, 0.1 + 20.5 * teeth), "gold");
    assert_eq!(at(4.75 - 0.013, 0.1 + 20.0 * teeth), "field");
}

/// Spots are all there at the padar and thin out towards the inner end.
#[test]
fn spots_thin_out_from_the_padar() {
    let mut sari = paithani();
    sari.ang.spots[0].half_drop = false;
    let compiled = drawn(vec![silk()], Some(sari));
    // 52 columns of 0.09 m in 4.75 m, 11 rows in 1.01 m.
    let middle = |n: usize, count: usize, start: f64, length: f64| {
        start + (length - count as f64 * 0.09) / 2.0 + (n as f64 + 0.5) * 0.09
    };
    let kept = |columns: std::ops::Range<usize>| {
        let places = columns.clone().flat_map(|column| (0..11).map(move |row| (column, row)));
        let count = places
            .filter(|&(column, row)| {
                let place = [middle(column, 52, 0.0, 4.75), middle(row, 11, 0.1, 1.01)];
                let [red, _, blue, _] = seen(&compiled, place, false);
                red > blue + 60
            })
            .count();
        count as f64 / (11 * columns.len()) as f64
    };
    assert!(kept(48..52) > 0.9, "{}", kept(48..52));
    // 25 % … 40 % of 110 spots, four standard deviations of √(0.33 · 0.67 / 110) either way.
    let few = kept(0..10);
    assert!((few - 0.32).abs() < 0.18, "{few}");
}

/// The bytes of a tile do not change unawares.
#[test]
fn the_atlas_of_denim_is_this_one() {
    let atlas = drawn(vec![denim()], None).atlas;
    let hash = blake3::hash(&atlas.pixels).to_hex();
    insta::assert_snapshot!(format!(
        "{} x {}\n{}\n{:?}",
        atlas.width, atlas.height, hash, atlas.regions
    ));
}
