//! Lines drawn on a piece: `mark NAME from P { edges }`, and `trim along MARK keep SIDE`, which cuts
//! the piece along one of them.

use super::super::Evaluator;
use super::super::fields::{Arg, Fields, Phrase, bare};
use super::outline::Course;
use super::sheet::{self, Drawn};
use crate::diagnostic::{Diagnostic, Span};
use crate::geometry::curve;
use crate::syntax::tree::Name;
use crate::units;
use kurbo::{BezPath, ParamCurve, ParamCurveArclen, PathSeg, Point, Shape};

/// An end this near to the rim lies on it, m.
pub(super) const REACH: f64 = 1e-3;

/// What is measured along curves, m.
const ACCURACY: f64 = 1e-9;

/// Places of a segment that are looked at first, and how often the way between two of them is cut
/// to two thirds.
const PLACES: u32 = 32;
const THIRDS: usize = 60;

/// A line drawn on a piece.
#[derive(Clone, Debug, PartialEq)]
pub(in super::super) struct Line {
    pub name: String,
    /// 0 for the half as drawn, 1 for its mirror image, none for a line that is one.
    pub half: Option<usize>,
    pub span: Span,
    pub path: BezPath,
}

/// A place on the edges of a ring.
#[derive(Clone, Copy, Debug)]
pub(super) struct OnRim {
    /// Number of the edge.
    pub edge: usize,
    /// Arc length along it, m.
    pub arc: f64,
    /// How far away it is, m.
    pub away: f64,
    pub point: Point,
}

/// The place on a row of edges that lies nearest to a point.
pub(super) fn nearest<'p>(edges: impl Iterator<Item = &'p BezPath>, point: Point) -> Option<OnRim> {
    let mut best: Option<OnRim> = None;
    for (edge, path) in edges.enumerate() {
        let mut before = 0.0;
        for segment in path.segments() {
            let share = nearest_share(segment, point);
            let there = segment.eval(share);
            let away = there.distance(point);
            if best.is_none_or(|best| away < best.away) {
                let part = segment.subsegment(0.0..share).arclen(ACCURACY);
                best = Some(OnRim { edge, arc: before + part, away, point: there });
            }
            before += segment.arclen(ACCURACY);
        }
    }
    best
}

/// The parameter at which a segment comes nearest to a point: the best of some places, closed in on
/// by thirds.
fn nearest_share(segment: PathSeg, point: Point) -> f64 {
    let away = |share: f64| segment.eval(share).distance_squared(point);
    let step = 1.0 / f64::from(PLACES);
    let places = (0..=PLACES).map(|place| f64::from(place) * step);
    let near = places.min_by(|a, b| away(*a).total_cmp(&away(*b))).unwrap_or(0.0);
    let (mut low, mut high) = ((near - step).max(0.0), (near + step).min(1.0));
    for _ in 0..THIRDS {
        let third = (high - low) / 3.0;
        if away(low + third) <= away(high - third) { high -= third } else { low += third }
    }
    let middle = 0.5 * (low + high);
    // The ends are met to the last bit.
    [0.0, 1.0, middle].into_iter().min_by(|a, b| away(*a).total_cmp(&away(*b))).unwrap_or(middle)
}

/// The name that a `mark` line gives.
pub(super) fn name<'t>(phrase: &Phrase<'t>) -> Option<&'t Name> {
    phrase.head.first().and_then(|expr| bare(expr))
}

impl<'t> Evaluator<'t> {
    /// The marks of a panel; none if one of them cannot be drawn.
    pub(super) fn marks(
        &mut self,
        fields: &Fields<'t>,
        read: &[(usize, Fields<'t>)],
        of: &str,
    ) -> Option<Vec<Line>> {
        let mut lines: Vec<Line> = Vec::new();
        let mut sound = true;
        for (number, phrase) in fields.phrases.iter().enumerate() {
            if phrase.word.name != "mark" {
                continue;
            }
            let block = read.iter().find(|(n, _)| *n == number).map(|(_, read)| read);
            match block.and_then(|block| self.mark(phrase, block, of)) {
                Some(line) => lines.push(line),
                None => sound = false,
            }
        }
        sound.then_some(lines)
    }

    fn mark(&mut self, phrase: &Phrase<'t>, block: &Fields<'t>, of: &str) -> Option<Line> {
        let name: &'t Name = self.name_of(phrase.arg(0)?)?;
        if let Some(label) = block.phrases.iter().find_map(|edge| edge.label) {
            self.tell(
                Diagnostic::new("E0207", format!("`{}` is one line with one name", name.text))
                    .at(label.span, "this name has no place here")
                    .help("draw another `mark` where a part of it needs a name of its own"),
            );
            return None;
        }
        let from = phrase.value("from")?;
        let start = self.point(from)?;
        let title = format!("the line `{}` of {of}", name.text);
        let drawn = self.draw(block, start, from.expr.span, &title, Course::Open)?;
        let mut path = BezPath::new();
        for (number, edge) in drawn.iter().enumerate() {
            path.extend(edge.path.iter().skip(usize::from(number > 0)));
        }
        Some(Line { name: name.text.clone(), half: None, span: phrase.span, path })
    }

    /// Tells of marks no part of which lies on the cloth.
    pub(super) fn marks_on_cloth(&mut self, lines: &[Line], rings: &[Vec<Drawn>]) -> bool {
        let Some(outline) = rings.first() else { return true };
        let paths: Vec<BezPath> = outline.iter().map(|edge| edge.path.clone()).collect();
        let cloth = sheet::closed(&paths);
        let mut sound = true;
        for line in lines {
            let length = curve::length(&line.path);
            let on = [0.0, 0.25, 0.5, 0.75, 1.0].iter().any(|share| {
                let point = curve::at(&line.path, share * length).0;
                cloth.winding(point) != 0
                    || nearest(paths.iter(), point).is_some_and(|on| on.away < REACH)
            });
            if !on {
                self.tell(
                    Diagnostic::new("E0412", format!("`{}` lies beside the cloth", line.name))
                        .at(line.span, "no part of it lies on the piece")
                        .help("a mark is drawn in the same place as the outline: move it on to it"),
                );
                sound = false;
            }
        }
        sound
    }

    /// The mark that a phrase names behind `along`.
    pub(super) fn marked(&mut self, phrase: &Phrase<'t>, lines: &[Line]) -> Option<usize> {
        let name: &'t Name = self.name_of(phrase.value("along")?)?;
        let found = lines.iter().position(|line| line.name == name.text);
        match found {
            Some(number) => self.note_edge(name, [lines[number].span]),
            None => {
                let known = lines.iter().map(|line| line.name.as_str());
                let label = self.meant(&name.text, known.clone());
                let known: Vec<&str> = known.collect();
                let help = match known.as_slice() {
                    [] => "draw it: `mark NAME from P { line to Q }`".to_owned(),
                    known => format!("its marks are {}", known.join(", ")),
                };
                self.tell(
                    Diagnostic::new(
                        "E0204",
                        format!("no line `{}` is marked on this panel", name.text),
                    )
                    .at(name.span, label)
                    .help(help),
                );
            }
        }
        found
    }

    /// Cuts the outline along all marks that `trim` names, and takes these out of the marks: they
    /// are edges then. False if one cannot be cut.
    pub(super) fn trimmed(
        &mut self,
        fields: &Fields<'t>,
        rings: &mut [Vec<Drawn>],
        lines: &mut Vec<Line>,
    ) -> bool {
        let mut sound = true;
        for phrase in fields.all("trim") {
            let Some(number) = self.marked(phrase, lines) else {
                sound = false;
                continue;
            };
            let line = lines.remove(number);
            let cut = rings.first().and_then(|ring| self.trim(phrase, ring, &line));
            match (cut, rings.first_mut()) {
                (Some(cut), Some(ring)) => *ring = cut,
                _ => sound = false,
            }
        }
        sound
    }

    /// `trim along MARK keep SIDE`: the outline of what is kept.
    fn trim(&mut self, phrase: &Phrase<'t>, ring: &[Drawn], line: &Line) -> Option<Vec<Drawn>> {
        let along = phrase.value("along")?.expr.span;
        let ends = [curve::start(&line.path), curve::end(&line.path)];
        let mut places = Vec::new();
        for (end, word) in ends.into_iter().zip(["begins", "ends"]) {
            let place = nearest(ring.iter().map(|edge| &edge.path), end)?;
            if place.away > REACH {
                let away = units::length(place.away);
                self.tell(
                    Diagnostic::new(
                        "E0413",
                        format!("`{}` does not cut the piece in two", line.name),
                    )
                    .at(along, "cut along here")
                    .at(line.span, format!("it {word} {away} from the rim"))
                    .help(
                        "a line to cut along goes from rim to rim; `slit` opens one that does not",
                    ),
                );
                return None;
            }
            places.push(place);
        }
        let [from, to] = places[..] else { return None };
        let mut cut = line.path.clone();
        curve::start_at(&mut cut, from.point);
        curve::end_at(&mut cut, to.point);
        // Of a line along the rim itself nothing is cut off.
        let middle = curve::at(&cut, curve::length(&cut) / 2.0).0;
        let paths: Vec<BezPath> = ring.iter().map(|edge| edge.path.clone()).collect();
        let on_rim = nearest(paths.iter(), middle).is_some_and(|near| near.away < REACH);
        if on_rim || sheet::closed(&paths).winding(middle) == 0 {
            self.tell(
                Diagnostic::new("E0413", format!("`{}` does not cut the piece in two", line.name))
                    .at(along, "cut along here")
                    .at(line.span, "it does not run through the cloth"),
            );
            return None;
        }
        let edge = |path: BezPath| Drawn { name: Some(line.name.clone()), span: line.span, path };
        let sides = [
            rest(ring, to, from, edge(cut.clone())),
            rest(ring, from, to, edge(curve::reversed(&cut))),
        ];
        let kept = self.kept(phrase.value("keep")?, ring, &sides, line)?;
        let [first, second] = sides;
        Some(if kept == 0 { first } else { second })
    }

    /// Which of both sides has the edge or the point behind `keep`.
    fn kept(
        &mut self,
        keep: Arg<'t>,
        ring: &[Drawn],
        sides: &[Vec<Drawn>; 2],
        line: &Line,
    ) -> Option<usize> {
        let edge = bare(keep.expr).and_then(|name| {
            ring.iter()
                .find(|edge| edge.name.as_deref() == Some(&name.text))
                .map(|edge| (name, edge))
        });
        let Some((name, edge)) = edge else {
            if let Some(name) = bare(keep.expr)
                && self.find(keep.scope, &name.text).is_none()
            {
                let known = ring.iter().filter_map(|edge| edge.name.as_deref());
                self.no_member("this panel", name, known);
                return None;
            }
            let [x, y] = self.point(keep)?;
            let inside = |side: &Vec<Drawn>| {
                let paths: Vec<BezPath> = side.iter().map(|edge| edge.path.clone()).collect();
                sheet::closed(&paths).winding(Point::new(x, y)) != 0
            };
            let found = sides.iter().position(inside);
            if found.is_none() {
                self.tell(
                    Diagnostic::new("E0413", "this point does not say which side is kept")
                        .at(keep.expr.span, "it lies beside the cloth")
                        .help("take a point of what is kept, or an edge of it"),
                );
            }
            return found;
        };
        self.note_edge(name, [edge.span]);
        let has = |side: &Vec<Drawn>| {
            side.iter().any(|other| other.name == edge.name && other.span == edge.span)
        };
        match [has(&sides[0]), has(&sides[1])] {
            [true, false] => Some(0),
            [false, true] => Some(1),
            _ => {
                self.tell(
                    Diagnostic::new(
                        "E0413",
                        format!("`{}` is on both sides of the cut", name.text),
                    )
                    .at(keep.expr.span, "which part of it is kept?")
                    .at(line.span, "the cut goes through it")
                    .help("name an edge that lies on one side, or a point, `keep (0, -10cm)`"),
                );
                None
            }
        }
    }
}

/// The ring that goes from one place of a ring on to another, and back along a cut. It begins with
/// the edge behind that of the first place, so that what is left of one edge follows itself.
fn rest(ring: &[Drawn], from: OnRim, to: OnRim, cut: Drawn) -> Vec<Drawn> {
    let part = |edge: &Drawn, low: f64, high: f64| {
        (high - low > sheet::CORNER)
            .then(|| Drawn { path: curve::part(&edge.path, low, high), ..edge.clone() })
    };
    let length = |number: usize| curve::length(&ring[number].path);
    let mut kept: Vec<Drawn> = Vec::new();
    if from.edge == to.edge && from.arc < to.arc {
        kept.extend(part(&ring[from.edge], from.arc, to.arc));
        kept.push(cut);
    } else {
        let n = ring.len();
        let between = (to.edge + n - from.edge) % n;
        let between = if between == 0 { n } else { between };
        kept.extend((1..between).map(|step| ring[(from.edge + step) % n].clone()));
        kept.extend(part(&ring[to.edge], 0.0, to.arc));
        kept.push(cut);
        kept.extend(part(&ring[from.edge], from.arc, length(from.edge)));
    }
    // Corners come out to the last bit.
    let ends: Vec<Point> = kept.iter().map(|edge| curve::end(&edge.path)).collect();
    let n = kept.len();
    for (number, edge) in kept.iter_mut().enumerate() {
        if let Some(end) = ends.get((number + n - 1) % n) {
            curve::start_at(&mut edge.path, *end);
        }
    }
    kept
}
