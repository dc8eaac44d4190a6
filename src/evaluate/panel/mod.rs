//! Panels: from the words of a panel to cut pieces with named edges.

mod allowance;
mod band;
mod crease;
mod dart;
pub mod edge;
mod fit;
mod instance;
mod mark;
mod mouth;
pub(super) mod operation;
mod outline;
mod particle;
mod pleat;
mod raster;
pub(super) mod shape;
pub(super) mod sheet;
mod slit;
mod transform;

use super::Evaluator;
use super::fields::Fields;
use super::item::{ItemId, State};
use super::scope::ScopeId;
use crate::diagnostic::Span;
use crate::garment::panel::{Band, Corner, Crease, Loop, Mark, Notch, Piece, Run};
use crate::garment::seam::SeamKind;
pub use band::Banded;
use kurbo::{BezPath, Point};
use sheet::Drawn;
use std::rc::Rc;

/// Number of an instance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct InstanceId(pub(super) usize);

/// A panel's block opened with certain values of its fitted names.
#[derive(Debug)]
pub(super) struct Instance<'t> {
    pub item: ItemId,
    pub fields: Fields<'t>,
    /// The block of its outline, and those of its holes and marks by the number of their phrase.
    pub outline: Option<Fields<'t>>,
    pub drawn: Vec<(usize, Fields<'t>)>,
    pub draft: State<Option<Rc<Draft>>>,
}

/// How a panel stands to the wearer, which names the halves of an unfolded piece.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Standing {
    Before,
    Behind,
    /// The line that might say it cannot be read.
    Unknown,
}

/// A panel drawn and cut.
#[derive(Clone, Debug)]
pub struct Draft {
    /// The panel.
    pub item: ItemId,
    /// Its name.
    pub name: String,
    /// Where it is declared.
    pub span: Span,
    /// Its own scope, for names of rows of edges.
    pub(super) scope: ScopeId,
    /// Its fabric, or the sari it is.
    pub fabric: Option<ItemId>,
    /// Angle from +y to the warp, rad.
    pub grain: f64,
    /// Side of its grid cells, m.
    pub cell: Option<f64>,
    /// Contact order.
    pub layer: i32,
    /// Whether its face lies towards the wearer.
    pub inside: bool,
    /// Plies of cloth of which it is made.
    pub plies: u32,
    /// Seam allowances, the last that fits an edge counts: its name, or all edges; m.
    pub allowances: Vec<(Option<String>, f64, Corner)>,
    /// Further cloth along its edges.
    pub bands: Vec<Banded>,
    /// Its particles, where they are counted.
    pub counted: Option<Counted>,
    /// Edges as drawn, before folds and darts.
    pub(super) drawn: Vec<Drawn>,
    /// The pieces that are cut: one, or one for each name of `pair`.
    pub pieces: Vec<CutPiece>,
}

impl PartialEq for Draft {
    fn eq(&self, other: &Self) -> bool {
        self.item == other.item && self.pieces == other.pieces
    }
}

/// The particles of a panel whose grid is said in cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Counted {
    /// Particle (0, 0) in the drawing, m.
    pub origin: [f64; 2],
    /// Width and height of a cell, m.
    pub cell: [f64; 2],
    /// Number of cells.
    pub count: [i32; 2],
}

impl Counted {
    /// The place of a particle in the drawing, m.
    pub fn place(&self, node: [i32; 2]) -> [f64; 2] {
        [0, 1].map(|axis| self.origin[axis] + f64::from(node[axis]) * self.cell[axis])
    }

    /// Whether there is such a particle in the whole grid.
    pub fn has(&self, node: [i32; 2]) -> bool {
        (0..2).all(|axis| (0..=self.count[axis]).contains(&node[axis]))
    }
}

/// A piece of cloth as it is cut.
#[derive(Clone, Debug, PartialEq)]
pub struct CutPiece {
    /// Which of a pair: `left`.
    pub side: Option<String>,
    /// Outline and holes.
    pub loops: Vec<Loop>,
    /// Named edges.
    pub edges: Vec<CutEdge>,
    /// Named lines inside, of which the runs go along `lines`: their loop is the one behind the last.
    pub marks: Vec<CutEdge>,
    /// What the marks run along.
    pub lines: Vec<Piece>,
    /// What of it is sewn to itself: darts, pleats.
    pub joins: Vec<CutJoin>,
    /// Lines along which it is folded.
    pub creases: Vec<Crease>,
    /// Match marks.
    pub notches: Vec<Notch>,
}

/// A named edge of a cut piece.
#[derive(Clone, Debug, PartialEq)]
pub struct CutEdge {
    /// Its name.
    pub name: String,
    /// Which half of an unfolded piece: `left`.
    pub half: Option<String>,
    /// Where it is declared.
    pub span: Span,
    /// Runs in the direction of drawing, with the places they take on the flat edge, m.
    pub runs: Vec<(Run, (f64, f64))>,
    /// Its length before darts, m.
    pub flat: f64,
}

/// Lines of a cut piece that are sewn to each other.
#[derive(Clone, Debug, PartialEq)]
pub struct CutJoin {
    /// Its label, with its half.
    pub name: String,
    /// What it is.
    pub kind: SeamKind,
    /// Where it is declared.
    pub span: Span,
    /// Both lines, walked in the same sense.
    pub sides: [Vec<Run>; 2],
}

impl CutEdge {
    /// Its name with its half: `left.side`.
    pub fn full_name(&self) -> String {
        self.half.as_ref().map_or_else(|| self.name.clone(), |half| format!("{half}.{}", self.name))
    }
}

impl CutPiece {
    /// A band along each edge of its names.
    pub(super) fn bands<'p>(
        &'p self,
        said: &'p Banded,
        fabric: usize,
    ) -> impl Iterator<Item = Band> + 'p {
        let edges = self.edges.iter().filter(|edge| said.edges.contains(&edge.name));
        edges.map(move |edge| Band {
            span: said.cloth.span,
            kind: said.cloth.kind,
            runs: edge.runs.iter().map(|(run, _)| *run).collect(),
            width: said.cloth.width,
            fabric,
            plies: said.cloth.plies,
        })
    }

    /// An edge by its number, or a mark: these are counted on behind the edges.
    pub fn line(&self, number: usize) -> Option<&CutEdge> {
        let marks = number.checked_sub(self.edges.len());
        marks.map_or_else(|| self.edges.get(number), |mark| self.marks.get(mark))
    }

    /// The marks as lines for the cutter.
    pub(super) fn drawn_marks(&self) -> Vec<Mark> {
        let path = |mark: &CutEdge| {
            let (run, _) = mark.runs.first()?;
            Some(Mark { name: mark.full_name(), span: mark.span, path: self.path(run)?.clone() })
        };
        self.marks.iter().filter_map(path).collect()
    }

    /// The halves of its edges and marks.
    pub(super) fn halves(&self) -> impl Iterator<Item = &String> {
        self.edges.iter().chain(&self.marks).filter_map(|edge| edge.half.as_ref())
    }

    /// The path of a run's piece.
    pub fn path(&self, run: &Run) -> Option<&BezPath> {
        let pieces = self.loops.get(run.ring).map_or(&self.lines, |ring| &ring.pieces);
        pieces.get(run.piece).map(|piece| &piece.path)
    }

    /// The point at an arc length of a piece.
    pub fn point(&self, run: &Run, arc: f64) -> Point {
        self.path(run).map_or(Point::ZERO, |path| crate::geometry::curve::at(path, arc).0)
    }

    /// First and last point of a row of runs.
    pub fn ends(&self, runs: &[Run]) -> Option<(Point, Point)> {
        let (first, last) = (runs.first()?, runs.last()?);
        Some((self.point(first, first.from), self.point(last, last.to)))
    }
}

impl Draft {
    /// The name of a piece as panel: `front`, `sleeve.left`.
    pub fn piece_name(&self, piece: &CutPiece) -> String {
        match &piece.side {
            Some(side) => format!("{}.{side}", self.name),
            None => self.name.clone(),
        }
    }

    /// Names of its edges, each once, in the order of drawing.
    pub fn edge_names(&self) -> Vec<&str> {
        let mut names: Vec<&str> = Vec::new();
        for edge in self.pieces.first().map_or(&[][..], |piece| &piece.edges) {
            if !names.contains(&edge.name.as_str()) {
                names.push(&edge.name);
            }
        }
        names
    }

    /// Names of the lines marked on it, each once, in the order of the text.
    pub fn mark_names(&self) -> Vec<&str> {
        let mut names: Vec<&str> = Vec::new();
        for mark in self.pieces.first().map_or(&[][..], |piece| &piece.marks) {
            if !names.contains(&mark.name.as_str()) {
                names.push(&mark.name);
            }
        }
        names
    }

    /// Whether it has an edge or a mark of that name.
    pub fn has_line(&self, name: &str) -> bool {
        self.edge_names().contains(&name) || self.mark_names().contains(&name)
    }

    /// Where the edges or marks of that name are declared.
    pub(super) fn declared(&self, edge: &str) -> Vec<Span> {
        let piece = self.pieces.first();
        let edges = piece.into_iter().flat_map(|piece| piece.edges.iter().chain(&piece.marks));
        edges.filter(|known| known.name == edge).map(|known| known.span).collect()
    }

    /// Names of its halves and copies.
    pub fn parts(&self) -> Vec<&str> {
        let mut names: Vec<&str> = Vec::new();
        for piece in &self.pieces {
            names.extend(piece.side.as_deref());
            names.extend(piece.halves().map(String::as_str));
        }
        let mut seen: Vec<&str> = Vec::new();
        for name in names {
            if !seen.contains(&name) {
                seen.push(name);
            }
        }
        seen
    }
}

impl<'t> Evaluator<'t> {
    /// The panel of that number, drawn.
    pub fn panel(&mut self, id: ItemId, from: Span) -> Option<Rc<Draft>> {
        match self.make(id, from)? {
            super::item::Made::Panel(draft) => Some(draft),
            _ => None,
        }
    }
}
