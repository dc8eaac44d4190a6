//! A piece of cloth while it is cut: rings of pieces and the edges that run along them; darts,
//! folds and copies as operations on them.

use super::mark::Line;
use super::mouth::{self, Cut};
use crate::diagnostic::Span;
use crate::garment::panel::{Loop, Notch, Piece, Run};
use crate::garment::seam::SeamKind;
use crate::geometry::curve;
use kurbo::{Affine, BezPath, Point, Shape, Vec2};

/// Ends nearer than this are the same corner, m.
pub const CORNER: f64 = 1e-5;

/// An edge or a part of it along one piece.
#[derive(Clone, Debug, PartialEq)]
pub struct Stretch {
    pub ring: usize,
    pub piece: usize,
    /// Against the sense of the ring.
    pub reversed: bool,
    /// From where to where on the flat edge, dart intakes counted, m.
    pub flat: (f64, f64),
}

/// A named edge.
#[derive(Clone, Debug, PartialEq)]
pub struct Edge {
    pub name: String,
    /// 0 for the half as drawn, 1 for its mirror image, none for an edge that is one.
    pub half: Option<usize>,
    pub span: Span,
    pub stretches: Vec<Stretch>,
    /// Its length before darts, m.
    pub flat: f64,
}

/// A piece of a ring, and whether it is walked against the ring.
pub type Leg = (usize, usize, bool);

/// Lines of one piece of cloth that are sewn to each other, walked in the same sense: the legs of
/// a dart from its mouth to its tip, the layers of a pleat at its edge.
#[derive(Clone, Debug, PartialEq)]
pub struct Join {
    pub name: String,
    pub kind: SeamKind,
    pub half: Option<usize>,
    pub span: Span,
    pub sides: [Vec<Leg>; 2],
}

/// A line along which the cloth is folded.
#[derive(Clone, Debug, PartialEq)]
pub struct Crease {
    pub span: Span,
    pub from: Point,
    pub to: Point,
    /// The angle at which it rests, rad; positive towards the face.
    pub angle: f64,
    /// Where it is sewn shut: from its start across to the line that is sewn, and along that.
    pub shut: Option<[Vec2; 2]>,
}

/// Rings of pieces with edges; ring 0 is the outline. A piece ends where the next begins.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sheet {
    pub rings: Vec<Vec<BezPath>>,
    pub edges: Vec<Edge>,
    pub joins: Vec<Join>,
    pub creases: Vec<Crease>,
    pub notches: Vec<(Point, Vec2)>,
    /// Lines drawn on it.
    pub lines: Vec<Line>,
}

/// An edge as drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    pub name: Option<String>,
    pub span: Span,
    pub path: BezPath,
}

/// The closed path of a ring.
pub fn closed(pieces: &[BezPath]) -> BezPath {
    let mut path = BezPath::new();
    for (i, piece) in pieces.iter().enumerate() {
        path.extend(piece.iter().skip(usize::from(i > 0)));
    }
    path.close_path();
    path
}

impl Sheet {
    /// Adds a ring of drawn edges with the darts of each.
    pub fn add_ring(&mut self, drawn: &[Drawn], cuts: &[Vec<Cut>]) {
        let ring = self.rings.len();
        let mut pieces: Vec<BezPath> = Vec::new();
        let mut edges: Vec<Edge> = Vec::new();
        for (place, edge) in drawn.iter().enumerate() {
            let none = Vec::new();
            let length = curve::length(&edge.path);
            let cuts = cuts.get(place).unwrap_or(&none);
            let stretches = if cuts.is_empty() && curve::start(&edge.path) == curve::end(&edge.path)
            {
                // A closed edge gets four corners that are none, so that it begins nowhere.
                let quarters = (0..4_u8).map(|quarter| {
                    let flat =
                        (length * f64::from(quarter) / 4.0, length * f64::from(quarter + 1) / 4.0);
                    pieces.push(curve::part(&edge.path, flat.0, flat.1));
                    Stretch { ring, piece: pieces.len() - 1, reversed: false, flat }
                });
                quarters.collect()
            } else {
                mouth::part(&edge.path, cuts, ring, &mut pieces, &mut self.joins)
            };
            if let Some(name) = &edge.name {
                edges.push(Edge {
                    name: name.clone(),
                    half: None,
                    span: edge.span,
                    stretches,
                    flat: length,
                });
            }
        }
        self.edges.extend(run_on(edges));
        join(&mut pieces);
        self.rings.push(pieces);
    }

    /// Everything moved by a map; a mirror image keeps the sense in which edges were drawn.
    #[must_use]
    pub fn mapped(&self, map: Affine) -> Sheet {
        let rings = self
            .rings
            .iter()
            .map(|pieces| pieces.iter().map(|piece| curve::mapped(piece, map)).collect())
            .collect();
        let notches = self
            .notches
            .iter()
            .map(|(at, inward)| {
                let to = map * (*at + *inward);
                (map * *at, to - map * *at)
            })
            .collect();
        let creases = self
            .creases
            .iter()
            .map(|crease| Crease {
                from: map * crease.from,
                to: map * crease.to,
                shut: crease
                    .shut
                    .map(|ways| ways.map(|way| map * (crease.from + way) - map * crease.from)),
                ..*crease
            })
            .collect();
        let lines = self
            .lines
            .iter()
            .map(|line| Line { path: curve::mapped(&line.path, map), ..line.clone() })
            .collect();
        Sheet { rings, notches, creases, lines, ..self.clone() }
    }

    /// The sheet with its mirror image about the fold, which is piece `fold` of the outline.
    #[must_use]
    pub fn unfolded(&self, fold: usize) -> Sheet {
        let Some(outline) = self.rings.first() else { return self.clone() };
        let Some(line) = outline.get(fold) else { return self.clone() };
        let n = outline.len();
        let map = curve::mirror(curve::start(line), curve::end(line));
        let mirrored = self.mapped(map);
        // New outline: what follows the fold, round to what comes before it, then the mirror
        // image of all that backwards.
        let kept = n - 1;
        let place = |piece: usize| (piece + n - fold - 1) % n;
        let order: Vec<usize> = (0..kept).map(|i| (fold + 1 + i) % n).collect();
        let mut pieces: Vec<BezPath> = order.iter().map(|&i| outline[i].clone()).collect();
        for &i in order.iter().rev() {
            pieces.push(curve::reversed(&mirrored.rings[0][i]));
        }
        join(&mut pieces);
        let mut rings = vec![pieces];
        let holes = self.rings.len() - 1;
        rings.extend(self.rings.iter().skip(1).cloned());
        rings.extend(mirrored.rings.iter().skip(1).cloned());
        // Where a stretch and its mirror image come to lie.
        let drawn = |s: &Stretch| match s.ring {
            0 => Stretch { piece: place(s.piece), ..s.clone() },
            _ => s.clone(),
        };
        let image = |s: &Stretch| match s.ring {
            0 => {
                Stretch { piece: 2 * kept - 1 - place(s.piece), reversed: !s.reversed, ..s.clone() }
            }
            _ => Stretch { ring: s.ring + holes, ..s.clone() },
        };
        let first = order.first().copied();
        let last = order.last().copied();
        let mut edges = Vec::new();
        for edge in &self.edges {
            let ends = (edge.stretches.first(), edge.stretches.last());
            let (Some(head), Some(tail)) = ends else { continue };
            if head.ring == 0 && head.piece == fold {
                continue;
            }
            let begins_on_fold = head.ring == 0 && Some(head.piece) == first;
            let ends_on_fold = tail.ring == 0 && Some(tail.piece) == last;
            let forward: Vec<Stretch> = edge.stretches.iter().map(drawn).collect();
            let backward: Vec<Stretch> = edge
                .stretches
                .iter()
                .rev()
                .map(|s| {
                    let image = image(s);
                    // The mirror image is walked the other way.
                    Stretch {
                        reversed: !image.reversed,
                        flat: (edge.flat - s.flat.1, edge.flat - s.flat.0),
                        ..image
                    }
                })
                .collect();
            let shifted = |list: Vec<Stretch>| -> Vec<Stretch> {
                list.into_iter()
                    .map(|s| Stretch { flat: (s.flat.0 + edge.flat, s.flat.1 + edge.flat), ..s })
                    .collect()
            };
            if begins_on_fold || ends_on_fold {
                let stretches = if begins_on_fold {
                    backward.into_iter().chain(shifted(forward)).collect()
                } else {
                    forward.into_iter().chain(shifted(backward)).collect()
                };
                edges.push(Edge { stretches, flat: 2.0 * edge.flat, ..edge.clone() });
            } else {
                edges.push(Edge { half: Some(0), stretches: forward, ..edge.clone() });
                edges.push(Edge {
                    half: Some(1),
                    stretches: edge.stretches.iter().map(image).collect(),
                    ..edge.clone()
                });
            }
        }
        let mut joins = Vec::new();
        for join in &self.joins {
            let leg = |&(ring, piece, reversed): &Leg, mirror: bool| {
                let s = Stretch { ring, piece, reversed, flat: (0.0, 0.0) };
                let s = if mirror { image(&s) } else { drawn(&s) };
                (s.ring, s.piece, s.reversed)
            };
            for half in 0..2 {
                let side = |side: &Vec<Leg>| side.iter().map(|l| leg(l, half == 1)).collect();
                joins.push(Join {
                    half: Some(half),
                    sides: join.sides.each_ref().map(side),
                    ..join.clone()
                });
            }
        }
        let mut creases = self.creases.clone();
        creases.extend(mirrored.creases);
        let mut notches = self.notches.clone();
        notches.extend(mirrored.notches);
        let lines = unfolded_lines(&self.lines, &mirrored.lines, line);
        Sheet { rings, edges, joins, creases, notches, lines }
    }

    /// Turns rings so that the outline runs anticlockwise and holes run clockwise.
    pub fn orient(&mut self) {
        for ring in 0..self.rings.len() {
            let area = closed(&self.rings[ring]).area();
            if (area > 0.0) == (ring == 0) {
                continue;
            }
            let pieces = &mut self.rings[ring];
            let n = pieces.len();
            *pieces = pieces.iter().rev().map(curve::reversed).collect();
            for edge in &mut self.edges {
                for stretch in edge.stretches.iter_mut().filter(|s| s.ring == ring) {
                    stretch.piece = n - 1 - stretch.piece;
                    stretch.reversed = !stretch.reversed;
                }
            }
            for join in &mut self.joins {
                for leg in join.sides.iter_mut().flatten().filter(|leg| leg.0 == ring) {
                    leg.1 = n - 1 - leg.1;
                    leg.2 = !leg.2;
                }
            }
        }
    }

    /// The rings as loops of measured pieces.
    pub fn loops(&self) -> Vec<Loop> {
        self.rings
            .iter()
            .map(|pieces| Loop {
                pieces: pieces
                    .iter()
                    .map(|path| Piece { path: path.clone(), length: curve::length(path) })
                    .collect(),
            })
            .collect()
    }

    /// The notches as unit marks.
    pub fn notch_marks(&self) -> Vec<Notch> {
        self.notches
            .iter()
            .map(|(at, inward)| {
                let size = libm::hypot(inward.x, inward.y).max(f64::MIN_POSITIVE);
                Notch { at: [at.x, at.y], inward: [inward.x / size, inward.y / size], count: 1 }
            })
            .collect()
    }
}

/// Lines with their mirror images about a fold: one line goes through the fold where it ends on it,
/// and one along the fold stays one.
fn unfolded_lines(drawn: &[Line], mirrored: &[Line], fold: &BezPath) -> Vec<Line> {
    let (from, along) = (curve::start(fold), curve::end(fold) - curve::start(fold));
    let on_fold = |point: Point| along.cross(point - from).abs() <= CORNER * along.hypot();
    let mut lines = Vec::new();
    for (line, image) in drawn.iter().zip(mirrored) {
        let (start, end) = (curve::start(&line.path), curve::end(&line.path));
        let middle = curve::at(&line.path, curve::length(&line.path) / 2.0).0;
        let through = |first: &BezPath, second: &BezPath| {
            let mut path = first.clone();
            path.extend(second.iter().skip(1));
            Line { path, ..line.clone() }
        };
        let turned = curve::reversed(&image.path);
        match [start, middle, end].map(on_fold) {
            [true, true, true] => lines.push(line.clone()),
            [true, ..] => lines.push(through(&turned, &line.path)),
            [.., true] => lines.push(through(&line.path, &turned)),
            _ => {
                lines.push(Line { half: Some(0), ..line.clone() });
                lines.push(Line { half: Some(1), ..image.clone() });
            }
        }
    }
    lines
}

/// Edges of one ring, of which those of one name are one.
fn run_on(list: Vec<Edge>) -> Vec<Edge> {
    let mut edges: Vec<Edge> = Vec::new();
    for edge in list {
        match edges.last_mut().filter(|before| before.name == edge.name) {
            Some(before) => append(before, edge),
            None => edges.push(edge),
        }
    }
    // The ring may have begun within an edge.
    if let [first, .., last] = edges.as_slice()
        && first.name == last.name
    {
        let first = edges.remove(0);
        if let Some(last) = edges.last_mut() {
            append(last, first);
        }
    }
    // A cut may have taken the middle out of one.
    let mut whole: Vec<Edge> = Vec::new();
    for edge in edges {
        match whole.iter_mut().find(|before| before.name == edge.name) {
            Some(before) => append(before, edge),
            None => whole.push(edge),
        }
    }
    whole
}

fn append(before: &mut Edge, edge: Edge) {
    let way = before.flat;
    let moved =
        edge.stretches.into_iter().map(|s| Stretch { flat: (s.flat.0 + way, s.flat.1 + way), ..s });
    before.stretches.extend(moved);
    before.flat += edge.flat;
}

/// Makes each piece begin exactly where the one before it ends.
fn join(pieces: &mut [BezPath]) {
    let ends: Vec<Point> = pieces.iter().map(curve::end).collect();
    let n = pieces.len();
    for (i, piece) in pieces.iter_mut().enumerate() {
        if let Some(end) = ends.get((i + n - 1) % n) {
            curve::start_at(piece, *end);
        }
    }
}

/// A stretch as a run on measured loops.
pub fn run(loops: &[Loop], ring: usize, piece: usize, reversed: bool) -> Run {
    let length =
        loops.get(ring).and_then(|ring| ring.pieces.get(piece)).map_or(0.0, |piece| piece.length);
    let (from, to) = if reversed { (length, 0.0) } else { (0.0, length) };
    Run { ring, piece, from, to }
}
