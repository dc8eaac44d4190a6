//! Garments for the trials, put together by hand as `evaluate` would.

use darzi::diagnostic::Span;
use darzi::garment::Garment;
use darzi::garment::cloth::Surface;
use darzi::garment::panel::{Loop, NamedEdge, Panel, Piece, Run};
use darzi::garment::scene::{BodyRequest, Figure, Phase, Picture, Placement, Side, View};
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
            allowance: 0.01,
            corner: Default::default(),
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
        allowance: 0.01,
        creases: Vec::new(),
        marks: Vec::new(),
        notches: Vec::new(),
        bands: Vec::new(),
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
        stitches: Vec::new(),
        nearby: Vec::new(),
        patches: Vec::new(),
        cords: Vec::new(),
        ties: Vec::new(),
        bodies: vec![lady()],
        solids: Vec::new(),
        attachments,
        pins: Vec::new(),
        schedule: vec![
            Phase::Sew { gap: 1e-3, span: None },
            Phase::Settle { speed: 2e-3, within: 20.0, span: None },
        ],
        pictures: vec![picture()],
        grade: Vec::new(),
    }
}

/// Front, side and back.
pub fn picture() -> Picture {
    Picture {
        views: vec![View::Front, View::ThreeQuarter, View::Back],
        size: [1200, 800],
        ..Picture::default()
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

/// The path through the given places, one straight piece each.
fn straight(corners: &[[f64; 2]]) -> Vec<BezPath> {
    corners
        .windows(2)
        .map(|w| {
            let mut path = BezPath::new();
            path.move_to(Point::from((w[0][0], w[0][1])));
            path.line_to(Point::from((w[1][0], w[1][1])));
            path
        })
        .collect()
}

/// A tunic with short sleeves: front, back, two sleeves.
pub fn tunic() -> Garment {
    // Right half of a body piece from the hem's end upwards, mirrored for the other half.
    let body = |neck: f64| {
        let right = [
            [0.30, -0.75],
            [0.25, -0.24],
            [0.20, -0.20],
            [0.185, -0.13],
            [0.205, -0.045],
            [0.085, 0.0],
            [0.05, -0.7 * neck],
            [0.0, -neck],
        ];
        let mut corners: Vec<[f64; 2]> = right.to_vec();
        corners.extend(right.iter().rev().skip(1).map(|[x, y]| [-x, *y]));
        corners.push(right[0]);
        straight(&corners)
    };
    let names = [
        "side_r",
        "arm_r0",
        "arm_r1",
        "arm_r2",
        "shoulder_r",
        "neck_r0",
        "neck_r1",
        "neck_l1",
        "neck_l0",
        "shoulder_l",
        "arm_l2",
        "arm_l1",
        "arm_l0",
        "side_l",
        "hem",
    ];
    let cap = [
        [-0.17, -0.22],
        [0.17, -0.22],
        [0.19, 0.0],
        [0.1, 0.075],
        [0.0, 0.115],
        [-0.1, 0.075],
        [-0.19, 0.0],
        [-0.17, -0.22],
    ];
    let sleeve_names = ["hem", "under_r", "cap_r0", "cap_r1", "cap_l1", "cap_l0", "under_l"];
    let arm = |side: &str| Placement::Wrapped {
        body: 0,
        landmark: format!("arm.{side}"),
        level: Some(format!("shoulder.{side}")),
        side: Side::Around,
        anchor: 0.115,
        gap: 0.02,
    };
    let panels = vec![
        outline("front", body(0.09), &names, wrapped("neck", Side::Before, 0.0, 0.04)),
        outline("back", body(0.03), &names, wrapped("neck", Side::Behind, 0.0, 0.04)),
        outline("sleeve.left", straight(&cap), &sleeve_names, arm("left")),
        outline("sleeve.right", straight(&cap), &sleeve_names, arm("right")),
    ];
    let mut seams = Vec::new();
    for (l, r) in [("side_r", "side_l"), ("shoulder_r", "shoulder_l")] {
        // The wearer's left lies at x > 0 in front, at x < 0 behind.
        seams.push(seam(l, run(&panels, 0, l, true), run(&panels, 1, r, false)));
        seams.push(seam(r, run(&panels, 0, r, true), run(&panels, 1, l, false)));
    }
    // Front armhole of a side, from the underarm up, and the sleeve's cap from the underarm up. On
    // the left arm x < 0 of the sleeve lies in front, on the right arm x > 0.
    let left = ["arm_r0", "arm_r1", "arm_r2"];
    let right = ["arm_l0", "arm_l1", "arm_l2"];
    for (sleeve, front, back, front_cap, back_cap) in [
        (2, left, right, ["cap_l0", "cap_l1"], ["cap_r0", "cap_r1"]),
        (3, right, left, ["cap_r0", "cap_r1"], ["cap_l0", "cap_l1"]),
    ] {
        for (panel, hole, cap) in [(0, front, front_cap), (1, back, back_cap)] {
            seams.push(Seam {
                name: format!("armhole {panel} {sleeve}"),
                span: Span::default(),
                kind: SeamKind::Plain,
                a: hole.map(|name| run(&panels, panel, name, name.starts_with("arm_r"))).to_vec(),
                b: cap.map(|name| run(&panels, sleeve, name, name.starts_with("cap_r"))).to_vec(),
            });
        }
        seams.push(seam(
            "underarm",
            run(&panels, sleeve, "under_r", true),
            run(&panels, sleeve, "under_l", false),
        ));
    }
    garment("tunic", panels, seams, Vec::new())
}
