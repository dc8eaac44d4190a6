//! What opens an edge: the mouths of darts, pleats and tucks. They part it into the stretches that
//! are left to see, and into lines that are sewn to each other.

use super::sheet::{Join, Leg, Stretch};
use crate::diagnostic::Span;
use crate::garment::seam::SeamKind;
use crate::geometry::curve;
use kurbo::{Affine, BezPath, Point};

/// Shorter stretches are none, m.
const NOTHING: f64 = 1e-7;

/// A mouth on a flat edge.
#[derive(Clone, Debug)]
pub struct Cut {
    pub name: String,
    pub span: Span,
    /// Arc lengths of its ends, m.
    pub mouth: (f64, f64),
    pub form: Form,
}

/// What closes a mouth.
#[derive(Clone, Copy, Debug)]
pub enum Form {
    /// A wedge is cut out. Its legs begin on the edge, or as far from the tip as each other
    /// beside it.
    Wedge { corners: (Point, Point), tip: Point },
    /// The cloth is folded: both halves of the mouth lie on each other, and beneath the edge
    /// where it says so.
    Fold { beneath: Option<Beneath> },
}

/// On which side of its mouth a pleat lies beneath the edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Beneath {
    /// Before it: the outer fold faces the end of the edge.
    Before,
    /// After it: the outer fold faces the start.
    After,
}

impl Cut {
    fn depth(&self) -> f64 {
        0.5 * (self.mouth.1 - self.mouth.0)
    }
}

/// The stretches of an edge that are left to see, as arc lengths of the flat edge.
fn visible(length: f64, cuts: &[Cut]) -> Vec<(f64, f64)> {
    let starts = std::iter::once(0.0).chain(cuts.iter().map(|cut| cut.mouth.1));
    let ends = cuts.iter().map(|cut| cut.mouth.0).chain([length]);
    starts.zip(ends).collect()
}

/// Where a pleat lies beneath the edge, by the way along what is left to see: from its outer fold
/// and away from it.
fn covered(number: usize, cuts: &[Cut], seen: &[(f64, f64)]) -> Option<(f64, f64)> {
    let cut = cuts.get(number)?;
    let Form::Fold { beneath: Some(beneath) } = cut.form else { return None };
    let fold: f64 = seen.iter().take(number + 1).map(|(a, b)| b - a).sum();
    let sense = if beneath == Beneath::Before { -1.0 } else { 1.0 };
    Some((fold, fold + sense * cut.depth()))
}

/// The first pleat that is deeper than the edge beside it, with the length that there is, m.
pub fn too_deep(length: f64, cuts: &[Cut]) -> Option<(&Cut, f64)> {
    let seen = visible(length, cuts);
    let whole: f64 = seen.iter().map(|(a, b)| b - a).sum();
    cuts.iter().enumerate().find_map(|(number, cut)| {
        let (fold, far) = covered(number, cuts, &seen)?;
        let room = if far < fold { fold } else { whole - fold };
        ((far - fold).abs() > room + 1e-6).then_some((cut, room))
    })
}

/// Parts an edge at its mouths: appends the pieces to those of its ring and what is sewn to the
/// joins, and gives the stretches that are left to see.
pub fn part(
    path: &BezPath,
    cuts: &[Cut],
    ring: usize,
    pieces: &mut Vec<BezPath>,
    joins: &mut Vec<Join>,
) -> Vec<Stretch> {
    let length = curve::length(path);
    let seen = visible(length, cuts);
    let cover: Vec<Option<(f64, f64)>> =
        (0..cuts.len()).map(|number| covered(number, cuts, &seen)).collect();
    let mut stretches: Vec<Stretch> = Vec::new();
    // By the way along what is left to see: pieces with their ends.
    let mut ways: Vec<(f64, f64, usize)> = Vec::new();
    let mut folds: Vec<(usize, [Leg; 2])> = Vec::new();
    let mut way = 0.0;
    for (number, &(from, to)) in seen.iter().enumerate() {
        let corner = |cut: Option<&Cut>, first: bool| match cut.map(|cut| cut.form) {
            Some(Form::Wedge { corners, .. }) => Some(if first { corners.0 } else { corners.1 }),
            _ => None,
        };
        let begin = number.checked_sub(1).and_then(|before| corner(cuts.get(before), false));
        let end = corner(cuts.get(number), true);
        if to - from > NOTHING {
            let whole = match (begin, end) {
                _ if cuts.is_empty() => path.clone(),
                (None, None) => curve::part(path, from, to),
                _ => trued(path, (from, to), begin, end),
            };
            // It is parted where the layer beneath it ends.
            let mut places: Vec<f64> = cover
                .iter()
                .flatten()
                .map(|(_, far)| from + far - way)
                .filter(|place| *place > from + NOTHING && *place < to - NOTHING)
                .collect();
            places.sort_by(f64::total_cmp);
            places.dedup_by(|later, earlier| *later - *earlier < NOTHING);
            places.insert(0, from);
            places.push(to);
            let share = curve::length(&whole) / (to - from);
            for flat in places.windows(2).map(|ends| (ends[0], ends[1])) {
                let piece = pieces.len();
                stretches.push(Stretch { ring, piece, reversed: false, flat });
                ways.push((way + flat.0 - from, way + flat.1 - from, piece));
                pieces.push(if places.len() == 2 {
                    whole.clone()
                } else {
                    curve::part(&whole, share * (flat.0 - from), share * (flat.1 - from))
                });
            }
        }
        way += to - from;
        let Some(cut) = cuts.get(number) else { continue };
        let first = pieces.len();
        let sides = [(ring, first, false), (ring, first + 1, true)];
        let kind = match cut.form {
            Form::Wedge { corners, tip } => {
                pieces.push(curve::line(corners.0, tip));
                pieces.push(curve::line(tip, corners.1));
                SeamKind::Dart
            }
            Form::Fold { .. } => {
                let middle = cut.mouth.0 + cut.depth();
                pieces.push(curve::part(path, cut.mouth.0, middle));
                pieces.push(curve::part(path, middle, cut.mouth.1));
                folds.push((number, sides));
                SeamKind::Pleat
            }
        };
        let (name, span) = (cut.name.clone(), cut.span);
        let sides = sides.map(|leg| vec![leg]);
        joins.push(Join { name, kind, half: None, span, sides });
    }
    for (number, [first, second]) in folds {
        let (Some(Some((fold, far))), Some(cut)) = (cover.get(number), cuts.get(number)) else {
            continue;
        };
        let (low, high) = (fold.min(*far) - NOTHING, fold.max(*far) + NOTHING);
        let above = ways.iter().filter(|(a, b, _)| *a >= low && *b <= high);
        let above = above.map(|&(_, _, piece)| piece);
        let (above, beneath): (Vec<Leg>, Leg) = if far < fold {
            (above.rev().map(|piece| (ring, piece, true)).collect(), first)
        } else {
            (above.map(|piece| (ring, piece, false)).collect(), second)
        };
        joins.push(Join {
            name: cut.name.clone(),
            kind: SeamKind::Pleat,
            half: None,
            span: cut.span,
            sides: [above, vec![beneath]],
        });
    }
    stretches
}

/// The part of an edge between two places, swung and stretched a little so that it goes from
/// `start` to `end`, where these are given: an edge is trued to the ends of the legs of its darts.
fn trued(
    path: &BezPath,
    (from, to): (f64, f64),
    start: Option<Point>,
    end: Option<Point>,
) -> BezPath {
    let part = curve::part(path, from, to);
    let (a, b) = (curve::start(&part), curve::end(&part));
    let (start, end) = (start.unwrap_or(a), end.unwrap_or(b));
    let (old, new) = (b - a, end - start);
    let squared = old.x * old.x + old.y * old.y;
    let mut part = if squared > 1e-12 {
        // new = z · old as complex numbers.
        let (re, im) =
            ((new.x * old.x + new.y * old.y) / squared, (new.y * old.x - new.x * old.y) / squared);
        let map = Affine::new([
            re,
            im,
            -im,
            re,
            start.x - re * a.x + im * a.y,
            start.y - im * a.x - re * a.y,
        ]);
        curve::mapped(&part, map)
    } else {
        part
    };
    curve::start_at(&mut part, start);
    curve::end_at(&mut part, end);
    part
}
