//! Drawings of the pieces that a text makes: outlines with the names of their edges, the direction
//! in which these run, folds and match marks. Darts show as the wedges that are cut out.

use darzi::garment::panel::{NamedEdge, Panel};
use darzi::geometry::curve;
use kurbo::{Affine, BezPath, PathEl, Point, Rect, Shape, Vec2};
use std::fmt::Write;

/// Where drawings lie, beside the pages.
pub const FOLDER: &str = "docs/language/pictures";

/// Units of the drawing in a metre of the longest piece's height.
const HEIGHT: f64 = 360.0;
/// Room round a piece for names.
const MARGIN: f64 = 60.0;

/// A drawing of all pieces side by side, in true proportion to each other.
pub fn drawing(panels: &[Panel]) -> String {
    let areas: Vec<Rect> = panels.iter().map(area).collect();
    let tallest =
        areas.iter().map(|area| area.height().max(0.6 * area.width())).fold(0.0, f64::max);
    let scale = HEIGHT / tallest;
    let high = areas.iter().map(Rect::height).fold(0.0, f64::max) * scale + 2.0 * MARGIN;
    let mut out = String::new();
    let mut left = 0.0;
    for (panel, area) in panels.iter().zip(&areas) {
        // y up in the piece, down on the page.
        let place = Affine::new([
            scale,
            0.0,
            0.0,
            -scale,
            left + MARGIN - scale * area.x0,
            MARGIN + scale * area.y1,
        ]);
        piece(&mut out, panel, place);
        left += scale * area.width() + 2.0 * MARGIN;
    }
    let wide = left;
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" \
         font-family=\"sans-serif\" font-size=\"13\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n{out}</svg>\n",
        wide.round(),
        high.round()
    )
}

fn area(panel: &Panel) -> Rect {
    let pieces = panel.loops.iter().flat_map(|ring| &ring.pieces);
    let boxes = pieces.map(|piece| piece.path.bounding_box());
    boxes.reduce(|a, b| a.union(b)).unwrap_or_default()
}

fn piece(out: &mut String, panel: &Panel, place: Affine) {
    let mut whole = BezPath::new();
    for ring in &panel.loops {
        for (number, piece) in ring.pieces.iter().enumerate() {
            let skip = usize::from(number > 0);
            whole.extend(piece.path.elements().iter().skip(skip).copied());
        }
        whole.push(PathEl::ClosePath);
    }
    let path = outline(&(place * whole));
    writeln!(out, "<path d=\"{path}\" fill=\"#f3efe6\" stroke=\"#333333\" fill-rule=\"evenodd\"/>")
        .unwrap();
    for crease in &panel.creases {
        let ends = [crease.from, crease.to].map(|[x, y]| place * Point::new(x, y));
        line(out, ends, " stroke-dasharray=\"6 4\"");
    }
    for mark in &panel.marks {
        let path = outline(&(place * mark.path.clone()));
        writeln!(
            out,
            "<path d=\"{path}\" fill=\"none\" stroke=\"#a8321e\" stroke-dasharray=\"2 3\"/>"
        )
        .unwrap();
        let (at, _) = curve::at(&mark.path, curve::length(&mark.path) / 2.0);
        text(out, place * at + Vec2::new(8.0, 4.0), "start", "#a8321e", &mark.name);
    }
    for notch in &panel.notches {
        let at = Point::new(notch.at[0], notch.at[1]);
        let inward = Vec2::new(notch.inward[0], -notch.inward[1]) * 8.0;
        line(out, [place * at, place * at + inward], "");
    }
    let origin = place * Point::ZERO;
    for arm in [Vec2::new(5.0, 0.0), Vec2::new(0.0, 5.0)] {
        line(out, [origin - arm, origin + arm], " stroke-opacity=\"0.5\"");
    }
    let middle = place * area(panel).center();
    text(out, middle, "middle", "#333333", &panel.name);
    panel.edges.iter().for_each(|edge| name(out, panel, edge, place));
}

/// The name of an edge beside its longest run, and an arrow the way it was drawn.
fn name(out: &mut String, panel: &Panel, edge: &NamedEdge, place: Affine) {
    let longest = edge.runs.iter().reduce(|a, b| if b.length() > a.length() { b } else { a });
    let Some(run) = longest else { return };
    let Some(piece) = panel.loops.get(run.ring).and_then(|ring| ring.pieces.get(run.piece)) else {
        return;
    };
    let (at, direction) = curve::at(&piece.path, (run.from + run.to) / 2.0);
    let along = curve::unit(direction);
    // The cloth lies to the left of a piece.
    let outward = Vec2::new(along.y, along.x);
    let forward = Vec2::new(along.x, -along.y) * if run.to >= run.from { 1.0 } else { -1.0 };
    let at = place * at;
    let (tip, back) = (at + forward * 6.0, at - forward * 4.0);
    let side = Vec2::new(-forward.y, forward.x) * 4.0;
    let corners = [tip, back + side, back - side].map(|p| format!("{},{}", round(p.x), round(p.y)));
    writeln!(out, "<polygon points=\"{}\" fill=\"#333333\"/>", corners.join(" ")).unwrap();
    let anchor = match outward.x {
        x if x > 0.4 => "start",
        x if x < -0.4 => "end",
        _ => "middle",
    };
    text(out, at + outward * 16.0 + Vec2::new(0.0, 4.0), anchor, "#a8321e", &edge.name);
}

fn line(out: &mut String, [a, b]: [Point; 2], more: &str) {
    let [ax, ay, bx, by] = [a.x, a.y, b.x, b.y].map(round);
    writeln!(
        out,
        "<line x1=\"{ax}\" y1=\"{ay}\" x2=\"{bx}\" y2=\"{by}\" stroke=\"#333333\"{more}/>"
    )
    .unwrap();
}

fn text(out: &mut String, at: Point, anchor: &str, color: &str, text: &str) {
    let (x, y) = (round(at.x), round(at.y));
    writeln!(
        out,
        "<text x=\"{x}\" y=\"{y}\" text-anchor=\"{anchor}\" fill=\"{color}\">{text}</text>"
    )
    .unwrap();
}

/// A path with tenths of a unit.
fn outline(path: &BezPath) -> String {
    let shown = |p: Point| format!("{} {}", round(p.x), round(p.y));
    let element = |element: &PathEl| match *element {
        PathEl::MoveTo(p) => format!("M{}", shown(p)),
        PathEl::LineTo(p) => format!("L{}", shown(p)),
        PathEl::QuadTo(p, q) => format!("Q{} {}", shown(p), shown(q)),
        PathEl::CurveTo(p, q, r) => format!("C{} {} {}", shown(p), shown(q), shown(r)),
        PathEl::ClosePath => "Z".to_owned(),
    };
    path.elements().iter().map(element).collect()
}

/// To a tenth, without a negative zero.
fn round(value: f64) -> f64 {
    (value * 10.0).round() / 10.0 + 0.0
}
