//! A piece of cloth: its outline as named edges, its fabric, where it begins.

use super::cloth::Surface;
use super::scene::Placement;
use crate::diagnostic::Span;
use kurbo::BezPath;
use serde::{Deserialize, Serialize};

/// A piece of cloth, cut and marked. The drawing plane has x to the right and y up, in metres,
/// as the piece is seen from outside on the dressed body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Panel {
    /// Its name, such as `front` or `sleeve.left`; no two panels of a garment share it.
    pub name: String,
    /// Where it is declared.
    pub span: Span,
    /// Number of its fabric.
    pub fabric: usize,
    /// Angle from the drawing's +y to the warp, anticlockwise, rad.
    pub grain: f64,
    /// Side of a grid cell, m, where the text asks for one.
    pub cell: Option<f64>,
    /// Contact order: greater lies further from the skin.
    pub layer: i32,
    /// `loops[0]` is the outline, anticlockwise; the others are holes, clockwise. Darts are cut
    /// out of the outline already: their legs are pieces of it.
    pub loops: Vec<Loop>,
    /// Edges by name. Names of copies carry their half: `left.side`.
    pub edges: Vec<NamedEdge>,
    /// Seam allowance of edges without a name, m.
    pub allowance: f64,
    /// Lines along which it is folded.
    pub creases: Vec<Crease>,
    /// Lines drawn on it.
    pub marks: Vec<Mark>,
    /// Match marks on the outline, for the cutter.
    pub notches: Vec<Notch>,
    /// Further cloth along its edges.
    pub bands: Vec<Band>,
    /// What is woven, knitted or printed where.
    pub surface: Surface,
    /// Where it begins.
    pub placement: Placement,
}

/// A closed line. Piece `i` ends exactly where piece `i + 1` begins, the last where the first
/// begins.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Loop {
    /// Its pieces in order; at least one.
    pub pieces: Vec<Piece>,
}

/// A stretch of outline without a corner inside.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Piece {
    /// One `MoveTo`, then lines, quadratics and cubics; smooth inside, in the sense of its loop.
    pub path: BezPath,
    /// Its length, m.
    pub length: f64,
}

/// A named edge: pieces one after the other, in the direction in which the edge was drawn.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NamedEdge {
    /// Its name.
    pub name: String,
    /// Where it is declared.
    pub span: Span,
    /// Cloth left beyond it, m.
    pub allowance: f64,
    /// How the allowance is cut at its ends.
    pub corner: Corner,
    /// The pieces it runs along. Where a dart is cut out of it, the runs do not touch on the
    /// flat; sewn they do.
    pub runs: Vec<Run>,
}

/// A line drawn on a piece, for the cutter and for what is sewn on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Mark {
    /// Its name; that of a copy carries its half, as an edge does.
    pub name: String,
    /// Where it is declared.
    pub span: Span,
    /// The line, in the direction in which it was drawn.
    pub path: BezPath,
}

/// How seam allowances meet in a corner.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Corner {
    /// Both go on to their meeting point.
    #[default]
    Mitre,
    /// Square to the end of the edge.
    Square,
    /// An arc about the corner.
    Round,
}

/// A part of one piece, walked from `from` to `to`; `from > to` goes against the loop.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// Number of the loop.
    pub ring: usize,
    /// Number of the piece in the loop.
    pub piece: usize,
    /// Arc length from the start of the piece, m.
    pub from: f64,
    /// Arc length from the start of the piece, m.
    pub to: f64,
}

impl Run {
    /// Its length, m.
    pub fn length(&self) -> f64 {
        (self.to - self.from).abs()
    }
}

/// A straight line along which cloth is folded; what of it lies outside the cloth does not count.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Crease {
    /// Where it is declared.
    pub span: Span,
    /// One end in the drawing, m.
    pub from: [f64; 2],
    /// The other end, m.
    pub to: [f64; 2],
    /// The angle at which the cloth rests, rad, −π to π: positive where its face is folded on
    /// itself.
    pub angle: f64,
    /// Where the fold is sewn shut.
    pub shut: Option<Shut>,
}

/// A fold sewn shut: the cloth along a line beside the crease is sewn to its mirror image about the
/// crease. The line begins at `across` from the crease's start and goes by `along`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Shut {
    /// From the start of the crease to that of the line, square to the crease, m.
    pub across: [f64; 2],
    /// From the start of the line to its end, m.
    pub along: [f64; 2],
}

/// Further cloth sewn down along an edge: a hem turned up, a facing, an interfacing. It is no piece
/// of the drape; the cloth there is as heavy and as stiff as all its plies.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Band {
    /// Where it is declared.
    pub span: Span,
    /// What it is.
    pub kind: BandKind,
    /// The edge.
    pub runs: Vec<Run>,
    /// How far it reaches into the piece, m.
    pub width: f64,
    /// Number of its fabric.
    pub fabric: usize,
    /// Its plies.
    pub plies: u32,
}

/// What a band of further cloth is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum BandKind {
    /// Turned up and sewn down.
    Hem,
    /// Sewn on beneath.
    Facing,
    /// Stiffer cloth beneath.
    Interfacing,
    /// Doubled cloth on which closures lie.
    Placket,
    /// Half of the two doubled strips that lie over a slit, on one of its lips.
    Strip,
}

/// A mark on the outline.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Notch {
    /// Its place in the drawing, m.
    pub at: [f64; 2],
    /// Unit vector into the cloth.
    pub inward: [f64; 2],
    /// How many cuts side by side: 1, or 2 on seams that only back pieces have.
    pub count: u8,
}
