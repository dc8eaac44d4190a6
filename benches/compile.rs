//! How long it takes to cut panels of a million particles and to write them down.

#![allow(clippy::disallowed_methods, clippy::print_stdout)]

use darzi::diagnostic::Span;
use darzi::garment::Garment;
use darzi::garment::cloth::Surface;
use darzi::garment::panel::{Loop, Panel, Piece};
use darzi::garment::scene::Placement;
use darzi::mesh::{self, Options};
use kurbo::{BezPath, Circle, ParamCurveArclen, Rect, Shape};

fn main() {
    divan::main();
}

fn cloth(path: BezPath, cell: f64) -> Garment {
    let length = path.segments().map(|curve| curve.arclen(1e-9)).sum();
    let panel = Panel {
        name: "cloth".to_owned(),
        span: Span::default(),
        fabric: 0,
        grain: 0.3,
        cell: Some(cell),
        layer: 0,
        loops: vec![Loop { pieces: vec![Piece { path, length }] }],
        edges: Vec::new(),
        allowance: 0.01,
        creases: Vec::new(),
        marks: Vec::new(),
        notches: Vec::new(),
        bands: Vec::new(),
        surface: Surface::Fabric,
        placement: Placement::Led,
    };
    Garment {
        name: "bench".to_owned(),
        span: Span::default(),
        fabrics: Vec::new(),
        panels: vec![panel],
        seams: Vec::new(),
        stitches: Vec::new(),
        nearby: Vec::new(),
        patches: Vec::new(),
        cords: Vec::new(),
        ties: Vec::new(),
        bodies: Vec::new(),
        solids: Vec::new(),
        attachments: Vec::new(),
        pins: Vec::new(),
        schedule: Vec::new(),
        pictures: Vec::new(),
        grade: Vec::new(),
    }
}

/// A disc of a million particles.
fn disc() -> Garment {
    cloth(Circle::new((0.0, 0.0), 0.5).to_path(1e-7), (std::f64::consts::PI / 4.0).sqrt() * 1e-3)
}

/// A square of a million particles, askew to its grain.
fn square() -> Garment {
    let mut garment = cloth(Rect::new(0.0, 0.0, 1.0, 1.0).to_path(1e-9), 1e-3);
    let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
    let next = corners.iter().cycle().skip(1);
    let side = |(&from, &to)| {
        let mut path = BezPath::new();
        path.move_to(from);
        path.line_to(to);
        Piece { path, length: 1.0 }
    };
    garment.panels[0].loops[0].pieces = corners.iter().zip(next).map(side).collect();
    garment
}

#[divan::bench(sample_count = 5, sample_size = 1)]
fn cut_disc(bencher: divan::Bencher) {
    let garment = disc();
    bencher.bench(|| mesh::compile(&garment, &Options::default()));
}

#[divan::bench(sample_count = 5, sample_size = 1)]
fn cut_square_askew(bencher: divan::Bencher) {
    let garment = square();
    bencher.bench(|| mesh::compile(&garment, &Options::default()));
}

#[divan::bench(sample_count = 5, sample_size = 1)]
fn write_disc(bencher: divan::Bencher) {
    let Ok(compiled) = mesh::compile(&disc(), &Options::default()) else { return };
    bencher.bench(|| {
        let mut text = Vec::new();
        mesh::json::write(&compiled, &mut text).map(|()| text.len())
    });
}
