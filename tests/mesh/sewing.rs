//! Garments of a few panels, made without a text.

use darzi::diagnostic::Span;
use darzi::garment::Garment;
use darzi::garment::cloth::Surface;
use darzi::garment::panel::{Corner, Loop, NamedEdge, Panel, Piece, Run};
use darzi::garment::scene::{Phase, Placement};
use darzi::garment::seam::{PanelRun, Seam, SeamKind};
use kurbo::{BezPath, ParamCurveArclen};
use proptest::test_runner::{Config, RngSeed};

/// So many cases of a property, the same on every run; another seed looks further.
pub fn cases(count: u32) -> Config {
    Config { failure_persistence: None, rng_seed: RngSeed::Fixed(20), ..Config::with_cases(count) }
}

/// A piece of a path.
pub fn piece(path: BezPath) -> Piece {
    let length = path.segments().map(|curve| curve.arclen(1e-10)).sum();
    Piece { path, length }
}

/// A straight piece.
pub fn line(from: [f64; 2], to: [f64; 2]) -> Piece {
    let mut path = BezPath::new();
    path.move_to((from[0], from[1]));
    path.line_to((to[0], to[1]));
    piece(path)
}

/// A cubic piece.
pub fn curve(from: [f64; 2], a: [f64; 2], b: [f64; 2], to: [f64; 2]) -> Piece {
    let mut path = BezPath::new();
    path.move_to((from[0], from[1]));
    path.curve_to((a[0], a[1]), (b[0], b[1]), (to[0], to[1]));
    piece(path)
}

/// A loop of straight pieces.
pub fn polygon(corners: &[[f64; 2]]) -> Loop {
    let next = corners.iter().cycle().skip(1);
    Loop { pieces: corners.iter().zip(next).map(|(&from, &to)| line(from, to)).collect() }
}

/// A rectangle with its lower left corner at the origin.
pub fn rectangle(width: f64, height: f64) -> Loop {
    polygon(&[[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]])
}

/// A circle in one piece, anticlockwise or clockwise.
pub fn circle(centre: [f64; 2], radius: f64, anticlockwise: bool) -> Loop {
    let sweep = if anticlockwise { 1.0 } else { -1.0 } * std::f64::consts::TAU;
    let arc = kurbo::Arc::new((centre[0], centre[1]), (radius, radius), 0.0, sweep, 0.0);
    let mut path = BezPath::new();
    path.move_to((centre[0] + radius, centre[1]));
    path.extend(arc.append_iter(1e-7));
    // An arc ends where it began but for rounding.
    if let Some(kurbo::PathEl::CurveTo(.., end)) = path.elements_mut().last_mut() {
        *end = kurbo::Point::new(centre[0] + radius, centre[1]);
    }
    Loop { pieces: vec![piece(path)] }
}

/// A panel of loops; every piece of the outline is an edge named `e0`, `e1`, ….
pub fn panel(name: &str, loops: Vec<Loop>, cell: f64) -> Panel {
    let pieces = loops[0].pieces.iter().enumerate();
    let edges = pieces.map(|(number, piece)| NamedEdge {
        name: format!("e{number}"),
        span: Span::default(),
        allowance: 0.01,
        corner: Corner::default(),
        runs: vec![Run { ring: 0, piece: number, from: 0.0, to: piece.length }],
    });
    Panel {
        name: name.to_owned(),
        span: Span::default(),
        fabric: 0,
        grain: 0.0,
        cell: Some(cell),
        layer: 0,
        edges: edges.collect(),
        loops,
        allowance: 0.01,
        creases: Vec::new(),
        marks: Vec::new(),
        notches: Vec::new(),
        bands: Vec::new(),
        surface: Surface::Fabric,
        placement: Placement::Led,
    }
}

/// A whole piece of a panel's outline, with the loop or against it.
pub fn whole(panels: &[Panel], panel: usize, piece: usize, forward: bool) -> PanelRun {
    let length = panels[panel].loops[0].pieces[piece].length;
    let (from, to) = if forward { (0.0, length) } else { (length, 0.0) };
    PanelRun { panel, run: Run { ring: 0, piece, from, to } }
}

/// A plain seam.
pub fn seam(name: &str, a: Vec<PanelRun>, b: Vec<PanelRun>) -> Seam {
    Seam { name: name.to_owned(), span: Span::default(), kind: SeamKind::Plain, a, b }
}

/// A garment of panels and seams.
pub fn garment(panels: Vec<Panel>, seams: Vec<Seam>) -> Garment {
    Garment {
        name: "sample".to_owned(),
        span: Span::default(),
        fabrics: Vec::new(),
        panels,
        seams,
        stitches: Vec::new(),
        nearby: Vec::new(),
        patches: Vec::new(),
        cords: Vec::new(),
        ties: Vec::new(),
        bodies: Vec::new(),
        solids: Vec::new(),
        attachments: Vec::new(),
        pins: Vec::new(),
        schedule: vec![Phase::Run { time: 1.0, rate: 60.0, span: None }],
        pictures: Vec::new(),
        grade: Vec::new(),
    }
}
