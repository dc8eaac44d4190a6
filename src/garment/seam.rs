//! What is sewn, attached and pinned.

use super::panel::Run;
use crate::diagnostic::Span;
use serde::{Deserialize, Serialize};

/// A run on a panel.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PanelRun {
    /// Number of the panel.
    pub panel: usize,
    /// The run.
    pub run: Run,
}

/// Two lines of runs that are sewn to each other. Both are walked in the same sense: the start
/// of `a` meets the start of `b`, and each share of `a`'s length meets the same share of `b`'s.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Seam {
    /// As written, `front.left.side -> back.left.side`, or `front.shaping` for a dart.
    pub name: String,
    /// Where it is declared.
    pub span: Span,
    /// What it is.
    pub kind: SeamKind,
    /// One side.
    pub a: Vec<PanelRun>,
    /// The other side.
    pub b: Vec<PanelRun>,
}

/// What is sewn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum SeamKind {
    /// Edge to edge.
    Plain,
    /// The two legs of a dart.
    Dart,
    /// The layers of a pleat or tuck at its edge.
    Pleat,
    /// Closed by a zip: sewn like a seam.
    Zip,
}

/// An edge held to a body where it comes to lie.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Attachment {
    /// Where it is declared.
    pub span: Span,
    /// The runs held.
    pub runs: Vec<PanelRun>,
    /// Number of the body.
    pub body: usize,
    /// A ring or point among the body's landmarks, such as `waist`.
    pub landmark: String,
}

/// Points held still.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pin {
    /// Where it is declared.
    pub span: Span,
    /// What is held.
    pub what: Pinned,
    /// Where it is held.
    pub to: PinTarget,
}

/// What a pin holds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Pinned {
    /// All points of these runs.
    Runs(Vec<PanelRun>),
    /// The particle nearest to this place of the panel's drawing, m.
    Point {
        /// Number of the panel.
        panel: usize,
        /// Place in its drawing.
        at: [f64; 2],
    },
}

/// Where a pin holds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PinTarget {
    /// Where it lies when the drape begins.
    Here,
    /// At a place in the world, m.
    Place([f64; 3]),
    /// At a landmark of a body.
    Landmark {
        /// Number of the body.
        body: usize,
        /// The landmark's name.
        name: String,
    },
}

/// Point sewn to point.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stitches {
    /// As written, `front(3, 4) -> back(0, 4)`, `front.left.edge over front.right.edge`.
    pub name: String,
    /// Where it is declared.
    pub span: Span,
    /// Whether it is a button or hook, closed by `close`, and not sewn.
    pub closure: bool,
    /// What is sewn to what: panel and place in its drawing, m. The particle nearest to it is meant.
    pub pairs: Vec<[(usize, [f64; 2]); 2]>,
}

/// Particles of two rims to be sewn where they lie near each other when the drape begins.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Nearby {
    /// As written.
    pub name: String,
    /// Where it is declared.
    pub span: Span,
    /// Panels with the number of the edge that is meant, or their whole rim; one side and the
    /// other.
    pub sides: [Vec<(usize, Option<usize>)>; 2],
    /// How far apart two particles may lie to be sewn, m.
    pub within: f64,
}

/// A piece sewn flat on the face of another along its edges: a pocket.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Patch {
    /// As written, `pocket on front.left`.
    pub name: String,
    /// Where it is declared.
    pub span: Span,
    /// Number of the panel that lies on top.
    pub panel: usize,
    /// Number of the panel below it.
    pub host: usize,
    /// Takes a place (x, y) of its drawing to one of the host's, `(m0 x + m2 y + m4, m1 x + m3 y +
    /// m5)`; a turn and a shift, m.
    pub map: [f64; 6],
    /// The edges that are sewn.
    pub runs: Vec<PanelRun>,
}

/// What runs along edges and draws them together.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cord {
    /// As written, `drawstring skirt.top`.
    pub name: String,
    /// Where it is declared.
    pub span: Span,
    /// What it is.
    pub kind: CordKind,
    /// The runs it goes along.
    pub runs: Vec<PanelRun>,
    /// Its length at rest, m.
    pub length: f64,
    /// The width of an elastic, m.
    pub width: f64,
}

/// What a cord is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum CordKind {
    /// A band that stretches.
    Elastic,
    /// A cord in a casing, which hardly does.
    Drawstring,
    /// A cord from place to place.
    Tie,
}

/// A cord from one place to another, tied when all is closed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tie {
    /// As written, `front.edge.start to back.edge.end`.
    pub name: String,
    /// Where it is declared.
    pub span: Span,
    /// What is tied to what: panel and place in its drawing, m. The particle nearest to it is meant.
    pub pairs: Vec<[(usize, [f64; 2]); 2]>,
    /// Its length, m.
    pub length: f64,
}
