//! Garments for the trials, put together by hand as `evaluate` would.

use darzi::diagnostic::Span;
use darzi::garment::Garment;
use darzi::garment::cloth::Surface;
use darzi::garment::panel::{Loop, NamedEdge, Panel, Piece, Run};
use darzi::garment::scene::{BodyRequest, Figure, Light, Phase, Picture, Placement, Side, View};
use darzi::garment::seam::{Attachment, PanelRun, Seam, SeamKind};
use darzi::textile::Colour;
use darzi::textile::fabric::{Fabric, Finish, Structure, Thread};
use darzi::textile::weave::Weave;
use darzi::textile::yarn::{Fibre, Twist, Yarn};
use kurbo::{BezPath, ParamCurve, ParamCurveArclen, Point};
use std::collections::BTreeMap;

/// Cotton of Bricis's table, with tensile and shear stiffness of a plain shirting.
pub fn cotton() -> Fabric {
    let yarn = |r, g, b| Yarn {
        name: "cotton".to_owned(),
        count: 25e-6,
        plies: 1,
        twist: 700.0,
        direction: Twist::Z,
        fibre: Fibre::Cotton,
        colour: Colour([r, g, b, 255]),
        diameter: 0.2e-3,
    };
    let thread =
        |r, g, b| Thread { yarn: yarn(r, g, b), spacing: 0.35e-3, colour: Colour([r, g, b, 255]) };
    Fabric {
        name: "cotton".to_owned(),
        structure: Structure::Woven {
            weave: Weave {
                name: "plain".to_owned(),
                rows: vec![vec![true, false], vec![false, true]],
            },
            warp: thread(60, 90, 150),
            weft: thread(90, 120, 180),
        },
        mass: 0.2,
        thickness: 0.5e-3,
        bending: [1.2e-5, 0.9e-5],
        tensile: [8000.0, 5000.0],
        shear: 60.0,
        poisson: 0.25,
        friction: 0.35,
        damping: 0.03,
        finish: Finish::Matte,
    }
}

/// A polygon with a name for each of its edges, anticlockwise; edge k goes from corner k to
/// the next.
pub fn polygon(name: &str, corners: &[[f64; 2]], names: &[&str], placement: Placement) -> Panel {
    let n = corners.len();
    let pieces: Vec<BezPath> = (0..n)
        .map(|k| {
            let mut path = BezPath::new();
            path.move_to(Point::from((corners[k][0], corners[k][1])));
            let q = corners[(k + 1) % n];
            path.line_to(Point::from((q[0], q[1])));
            path
        })
        .collect();
    outline(name, pieces, names, placement)
}

/// A panel from its pieces, each a named edge.
pub fn outline(name: &str, pieces: Vec<BezPath>, names: &[&str], placement: Placement) -> Panel {
    let pieces: Vec<Piece> = pieces
        .into_iter()
        .map(|path| {
            let length = path.segments().map(|s| s.arclen(1e-9)).sum();
            debug_assert!(path.segments().all(|s| s.eval(0.5).is_finite()));
            Piece { path, length }
        })
        .collect();
    let edges = names
        .iter()
        .enumerate()
        .map(|(k, name)| NamedEdge {
            name: (*name).to_owned(),
            span: Span::default(),
            runs: vec![Run { ring: 0, piece: k, from: 0.0, to: pieces[k].length }],
        })
        .collect();
    Panel {
        name: name.to_owned(),
        span: Span::default(),
        fabric: 0,
        grain: 0.0,
        cell: None,
        layer: 0,
        loops: vec![Loop { pieces }],
        edges,
        notches: Vec::new(),
        surface: Surface::Fabric,
        placement,
    }
}

/// Edge `name` of a panel, walked with or against its outline.
pub fn run(panels: &[Panel], panel: usize, name: &str, with: bool) -> PanelRun {
    let edge = panels[panel].edges.iter().find(|e| e.name == name).expect("the edge exists");
    let r = edge.runs[0];
    let run = if with { r } else { Run { from: r.to, to: r.from, ..r } };
    PanelRun { panel, run }
}

/// A seam of one edge to another.
pub fn seam(name: &str, a: PanelRun, b: PanelRun) -> Seam {
    Seam {
        name: name.to_owned(),
        span: Span::default(),
        kind: SeamKind::Plain,
        a: vec![a],
        b: vec![b],
    }
}

/// A lady of EU 38.
pub fn lady() -> BodyRequest {
    let measures = [
        ("bust", 0.88),
        ("underbust", 0.75),
        ("waist", 0.72),
        ("hip", 0.97),
        ("neck", 0.36),
        ("shoulder", 0.122),
        ("back_length", 0.41),
        ("bust_depth", 0.275),
        ("bust_gap", 0.19),
        ("upper_arm", 0.28),
        ("arm_length", 0.59),
        ("waist_to_hip", 0.20),
        ("waist_to_floor", 1.05),
        ("height", 1.68),
    ];
    BodyRequest {
        name: "lady".to_owned(),
        span: Span::default(),
        figure: Figure::Female,
        measures: measures.iter().map(|(k, v)| ((*k).to_owned(), *v)).collect::<BTreeMap<_, _>>(),
    }
}

/// The garment around panels and seams.
pub fn garment(
    name: &str,
    panels: Vec<Panel>,
    seams: Vec<Seam>,
    attachments: Vec<Attachment>,
) -> Garment {
    Garment {
        name: name.to_owned(),
        span: Span::default(),
        fabrics: vec![cotton()],
        panels,
        seams,
        bodies: vec![lady()],
        solids: Vec::new(),
        attachments,
        pins: Vec::new(),
        schedule: vec![
            Phase::Sew { gap: 1e-3, span: None },
            Phase::Settle { speed: 2e-3, within: 20.0, span: None },
        ],
        pictures: vec![picture()],
    }
}

/// Front, side and back.
pub fn picture() -> Picture {
    Picture {
        views: vec![View::Front, View::ThreeQuarter, View::Back],
        size: [1200, 800],
        light: Light::Studio,
    }
}

fn wrapped(landmark: &str, side: Side, anchor: f64, gap: f64) -> Placement {
    Placement::Wrapped { body: 0, landmark: landmark.to_owned(), level: None, side, anchor, gap }
}

/// An A-line skirt of two equal panels, `flare` m wider at the hem than at the hip on each side.
pub fn skirt(flare: f64) -> Garment {
    let corners = [
        [-0.186, 0.0],
        [-0.255, -0.20],
        [-0.255 - flare, -0.60],
        [0.255 + flare, -0.60],
        [0.255, -0.20],
        [0.186, 0.0],
    ];
    let names = ["right_hip", "right_side", "hem", "left_side", "left_hip", "waist"];
    let panels = vec![
        polygon("front", &corners, &names, wrapped("waist", Side::Before, 0.0, 0.03)),
        polygon("back", &corners, &names, wrapped("waist", Side::Behind, 0.0, 0.03)),
    ];
    // The front's drawing has the wearer's left at x > 0, the back's has it at x < 0.
    let seams = [("left_hip", "right_hip"), ("left_side", "right_side")]
        .into_iter()
        .flat_map(|(l, r)| {
            [
                seam(l, run(&panels, 0, l, true), run(&panels, 1, r, false)),
                seam(r, run(&panels, 0, r, true), run(&panels, 1, l, false)),
            ]
        })
        .collect();
    let attachment = Attachment {
        span: Span::default(),
        runs: vec![run(&panels, 0, "waist", true), run(&panels, 1, "waist", true)],
        body: 0,
        landmark: "waist".to_owned(),
    };
    garment("skirt", panels, seams, vec![attachment])
}
