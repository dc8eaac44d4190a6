//! Outlines: lines, curves and arcs from point to point, with directions that may depend on
//! their neighbours.

use super::super::Evaluator;
use super::super::fields::{Arg, Fields, Phrase, bare};
use super::super::value::Value;
use super::sheet::{CORNER, Drawn};
use crate::diagnostic::{Diagnostic, Span};
use crate::geometry::curve;
use crate::units::{self, Dimension};
use kurbo::{Affine, BezPath, Point};
use std::f64::consts::PI;

/// Farthest that a pattern may reach, m.
const REACH: f64 = 1e3;

/// A direction at an end of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Heading {
    /// Mirrors the other end about the chord.
    Free,
    /// Said, rad.
    Said(f64),
    /// That of the neighbour.
    Smooth,
    /// At right angles to the neighbour.
    Square,
}

/// How an edge goes from its start to its end.
#[derive(Clone, Debug)]
enum Way {
    /// By directions at its ends.
    Curve { leaving: Heading, arriving: Heading, pull: Option<[f64; 2]> },
    /// Through points, with directions where they are said.
    Through { points: Vec<Point>, leaving: Heading, arriving: Heading },
    /// A bow: how high above the chord, outwards.
    Bow { outward: f64 },
    /// A bow of that length; true if it lies outside the chord.
    Measuring { length: f64, outward: bool },
    /// A bow of that radius; true if it lies outside the chord.
    Radius { radius: f64, outward: bool },
    /// Known already.
    Path(BezPath),
}

/// Whether a line comes back to where it began.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Course {
    Closed,
    Open,
}

struct Step {
    name: Option<String>,
    span: Span,
    from: Point,
    to: Point,
    way: Way,
    /// Directions at both ends, once they are known.
    leaving: Option<f64>,
    arriving: Option<f64>,
}

fn chord(step: &Step) -> f64 {
    curve::direction(step.to - step.from)
}

impl<'t> Evaluator<'t> {
    /// Draws the edges of an outline or a hole, or those of a line that stays open. None if it
    /// cannot be drawn, which is told.
    pub(super) fn draw(
        &mut self,
        fields: &Fields<'t>,
        from: [f64; 2],
        from_span: Span,
        of: &str,
        course: Course,
    ) -> Option<Vec<Drawn>> {
        let start = Point::new(from[0], from[1]);
        let mut at = start;
        let mut steps: Vec<Step> = Vec::new();
        let mut sound = true;
        for phrase in &fields.phrases {
            if !self.step(50, phrase.span) {
                return None;
            }
            let made = match phrase.word.name {
                "trace" => self.traced(phrase, at),
                "line" => self.line_step(phrase, at, start).map(|step| vec![step]),
                "curve" => self.curve_step(phrase, at, start).map(|step| vec![step]),
                "arc" => self.arc_step(phrase, at, start).map(|step| vec![step]),
                _ => continue,
            };
            match made {
                Some(made) => {
                    at = made.last().map_or(at, |step| step.to);
                    steps.extend(made);
                }
                None => sound = false,
            }
        }
        // Where an edge is not known, nobody can say whether the outline closes.
        if !sound || !fields.spoiled.is_empty() {
            return None;
        }
        let Some(last) = steps.last() else {
            let line = if course == Course::Closed { "the outline of " } else { "" };
            self.tell(
                Diagnostic::new("E0401", format!("{line}{of} has no edges"))
                    .at(fields.span, "here")
                    .help("such as `hem: line to (30cm, 0)`"),
            );
            return None;
        };
        let gap = last.to - start;
        let missing = libm::hypot(gap.x, gap.y);
        if course == Course::Closed && missing > CORNER {
            let shown = |p: Point| format!("({}, {})", units::length(p.x), units::length(p.y));
            self.tell(
                Diagnostic::new(
                    "E0401",
                    format!(
                        "the outline of {of} does not close: {} are missing",
                        units::length(missing)
                    ),
                )
                .at(from_span, format!("starts at {}", shown(start)))
                .at(last.span, format!("ends at {}", shown(last.to)))
                .help("let the last edge go `to start`"),
            );
            return None;
        }
        if let Some(last) = steps.last_mut().filter(|_| missing <= CORNER) {
            last.to = start;
            if let Way::Path(path) = &mut last.way {
                curve::end_at(path, start);
            }
        }
        if let Some(far) = steps.iter().find(|s| !(s.to.x.abs() <= REACH && s.to.y.abs() <= REACH))
        {
            self.tell(
                Diagnostic::new("E0404", "this point lies more than a kilometre away")
                    .at(far.span, "here"),
            );
            return None;
        }
        self.bend(&mut steps, course)?;
        self.finish(steps, of)
    }

    /// Where an edge ends: `to P`, `to start`, `by V`.
    fn end_of(&mut self, phrase: &Phrase<'t>, at: Point, start: Point) -> Option<Point> {
        if let Some(to) = phrase.value("to") {
            if bare(to.expr).is_some_and(|name| name.text == "start") {
                return Some(start);
            }
            if self.unknown_word(to, &["start"]) {
                return None;
            }
            let [x, y] = self.point(to)?;
            return Some(Point::new(x, y));
        }
        let [x, y] = self.point(phrase.value("by")?)?;
        Some(Point::new(at.x + x, at.y + y))
    }

    fn line_step(&mut self, phrase: &Phrase<'t>, at: Point, start: Point) -> Option<Step> {
        let to = self.end_of(phrase, at, start)?;
        Some(step(phrase, at, to, Way::Path(curve::line(at, to))))
    }

    fn heading(&mut self, phrase: &Phrase<'t>, word: &str) -> Option<Heading> {
        let Some(arg) = phrase.value(word) else { return Some(Heading::Free) };
        match bare(arg.expr).map(|name| name.text.as_str()) {
            Some("smooth") => Some(Heading::Smooth),
            Some("square") => Some(Heading::Square),
            _ if self.unknown_word(arg, &["smooth", "square"]) => None,
            _ => self.quantity(arg, Dimension::ANGLE).map(Heading::Said),
        }
    }

    fn points_of(&mut self, args: Vec<Arg<'t>>) -> Option<Vec<Point>> {
        args.into_iter().map(|arg| self.point(arg).map(|[x, y]| Point::new(x, y))).collect()
    }

    fn curve_step(&mut self, phrase: &Phrase<'t>, at: Point, start: Point) -> Option<Step> {
        let to = self.end_of(phrase, at, start)?;
        let leaving = self.heading(phrase, "leaving")?;
        let arriving = self.heading(phrase, "arriving")?;
        let directed = leaving != Heading::Free || arriving != Heading::Free;
        let way = if phrase.says("controls") {
            let points = self.points_of(phrase.values("controls"))?;
            let path = match points.as_slice() {
                [one] => curve::quadratic(at, *one, to),
                [one, two] => curve::cubic(at, *one, *two, to),
                _ => {
                    let said = phrase.clause("controls").map_or(phrase.span, |said| said.span);
                    self.tell(
                        Diagnostic::new("E0306", "a Bézier curve has one or two controls")
                            .at(said, format!("{} are given", points.len()))
                            .help("for more points use `through`"),
                    );
                    return None;
                }
            };
            Way::Path(path)
        } else if phrase.says("through") {
            let points = self.points_of(phrase.values("through"))?;
            Way::Through { points, leaving, arriving }
        } else if let Some(way) = self.bow_of(phrase)? {
            way
        } else {
            let pull = match phrase.values("pull").as_slice() {
                [] => None,
                [both] => {
                    let share = self.within_range(*both, Dimension::NUMBER, 0.0, 4.0)?;
                    Some([share, share])
                }
                [first, second] => Some([
                    self.within_range(*first, Dimension::NUMBER, 0.0, 4.0)?,
                    self.within_range(*second, Dimension::NUMBER, 0.0, 4.0)?,
                ]),
                [_, _, third, ..] => {
                    self.tell(
                        Diagnostic::new("E0306", "`pull` takes one or two shares")
                            .at(third.expr.span, "one too many"),
                    );
                    return None;
                }
            };
            return Some(step(phrase, at, to, Way::Curve { leaving, arriving, pull }));
        };
        let settled = !matches!(way, Way::Through { .. });
        if settled && directed {
            let said = phrase.clause("leaving").or(phrase.clause("arriving"));
            self.tell(
                Diagnostic::new("E0209", "this curve is said in two ways")
                    .at(said.map_or(phrase.span, |said| said.span), "its direction here")
                    .at(phrase.span, "and its form")
                    .help("keep the directions, or the bow, or the controls"),
            );
            return None;
        }
        Some(step(phrase, at, to, way))
    }

    /// `bulge L`, `hollow L`, `measuring L`, `radius L`; none if none of them is said.
    fn bow_of(&mut self, phrase: &Phrase<'t>) -> Option<Option<Way>> {
        let outward = !phrase.says("inward");
        let found = ["bulge", "hollow", "measuring", "radius"]
            .into_iter()
            .find_map(|word| phrase.value(word).map(|arg| (word, arg)));
        let Some((word, arg)) = found else {
            if let Some(said) = phrase.clause("inward") {
                self.tell(
                    Diagnostic::new("E0207", "`inward` goes with `measuring` or `radius`")
                        .at(said.span, "here"),
                );
                return None;
            }
            return Some(None);
        };
        let value = self.quantity(arg, Dimension::LENGTH)?;
        Some(Some(match word {
            "bulge" => Way::Bow { outward: value },
            "hollow" => Way::Bow { outward: -value },
            "measuring" => Way::Measuring { length: value, outward },
            _ => Way::Radius { radius: value, outward },
        }))
    }

    fn arc_step(&mut self, phrase: &Phrase<'t>, at: Point, start: Point) -> Option<Step> {
        if let Some(around) = phrase.value("around") {
            let [x, y] = self.point(around)?;
            let centre = Point::new(x, y);
            let Some(by) = phrase.value("by") else {
                self.tell(
                    Diagnostic::new("E0208", "an arc around a point must be told how far")
                        .at(phrase.span, "`by ANGLE` is missing")
                        .help("such as `arc around (0, 23cm) by -180deg`"),
                );
                return None;
            };
            let angle = self.quantity(by, Dimension::ANGLE)?;
            if angle.abs() > 2.0 * PI + 1e-9 || libm::hypot(at.x - x, at.y - y) < CORNER {
                self.tell(
                    Diagnostic::new("E0404", "this arc turns further than once, or about itself")
                        .at(by.expr.span, units::angle(angle)),
                );
                return None;
            }
            let path = curve::arc(at, centre, angle);
            let to = curve::end(&path);
            return Some(step(phrase, at, to, Way::Path(path)));
        }
        if phrase.says("by") {
            self.tell(
                Diagnostic::new("E0208", "an arc by an angle goes around a point")
                    .at(phrase.span, "`around POINT` is missing")
                    .help("such as `arc around (0, 23cm) by -180deg`"),
            );
            return None;
        }
        let to = self.end_of(phrase, at, start)?;
        match self.bow_of(phrase)? {
            Some(way) => Some(step(phrase, at, to, way)),
            None => {
                self.tell(
                    Diagnostic::new("E0208", "this arc wants its height or its radius")
                        .at(phrase.span, "`bulge`, `hollow` or `radius` is missing"),
                );
                None
            }
        }
    }

    /// Edges of another panel from here, names kept.
    fn traced(&mut self, phrase: &Phrase<'t>, at: Point) -> Option<Vec<Step>> {
        let arg = phrase.arg(0)?;
        let edges = match self.eval(arg.expr, arg.scope) {
            Value::Poison => return None,
            Value::Edges(edges) => edges,
            other => {
                self.wrong(&other, "edges", arg.expr.span);
                return None;
            }
        };
        let mut paths: Vec<(Option<String>, BezPath)> = Vec::new();
        for edge in &edges {
            let Some(drawn) = edge.as_drawn() else {
                self.tell(
                    Diagnostic::new("E0304", "only whole edges can be traced")
                        .at(arg.expr.span, "this is a part"),
                );
                return None;
            };
            let map = if phrase.says("mirrored") {
                Affine::new([-1.0, 0.0, 0.0, 1.0, 0.0, 0.0])
            } else {
                Affine::IDENTITY
            };
            paths.push((drawn.name.clone(), curve::mapped(&drawn.path, map)));
        }
        if phrase.says("reversed") {
            paths.reverse();
            for (_, path) in &mut paths {
                *path = curve::reversed(path);
            }
        }
        let mut steps = Vec::new();
        let mut from = at;
        for (name, path) in paths {
            let shift = from - curve::start(&path);
            let mut path = curve::mapped(&path, Affine::translate(shift));
            curve::start_at(&mut path, from);
            let to = curve::end(&path);
            steps.push(Step {
                name,
                span: phrase.span,
                from,
                to,
                way: Way::Path(path),
                leaving: None,
                arriving: None,
            });
            from = to;
        }
        Some(steps)
    }

    /// Settles bows and the directions at the ends of curves.
    fn bend(&mut self, steps: &mut [Step], course: Course) -> Option<()> {
        // Which way round: outwards is to the right of an anticlockwise outline, and of a line that
        // encloses nothing.
        let mut corners: Vec<[f64; 2]> = Vec::new();
        for step in steps.iter() {
            corners.push([step.from.x, step.from.y]);
            match &step.way {
                Way::Through { points, .. } => {
                    corners.extend(points.iter().map(|p| [p.x, p.y]));
                }
                Way::Path(path) => {
                    corners.extend(
                        path.elements()
                            .iter()
                            .filter_map(|element| element.end_point())
                            .map(|p| [p.x, p.y]),
                    );
                }
                _ => {}
            }
        }
        let clockwise =
            course == Course::Closed && crate::geometry::polygon::signed_area(&corners) < 0.0;
        for step in steps.iter_mut() {
            let left = |outward: bool| outward == clockwise;
            let bowed = match step.way {
                Way::Bow { outward } => {
                    curve::bow(step.from, step.to, if clockwise { outward } else { -outward })
                }
                Way::Measuring { length, outward } => {
                    curve::bow_of_length(step.from, step.to, length, left(outward))
                }
                Way::Radius { radius, outward } => {
                    curve::bow_of_radius(step.from, step.to, radius, left(outward))
                }
                _ => continue,
            };
            let Some(path) = bowed else {
                let gap = step.to - step.from;
                let straight = units::length(libm::hypot(gap.x, gap.y));
                self.tell(
                    Diagnostic::new("E0404", "no bow goes from here to there")
                        .at(step.span, format!("its ends are {straight} apart"))
                        .help("a bow is longer than its chord, its radius at least half of it, its height less than ten times as much"),
                );
                return None;
            };
            step.way = Way::Path(path);
        }
        for step in steps.iter_mut() {
            if let Way::Path(path) = &step.way {
                step.leaving = Some(curve::leaving(path));
                step.arriving = Some(curve::arriving(path));
            }
        }
        self.turn(steps, course)
    }

    /// Directions that hang on neighbours, worked out until none is left.
    fn turn(&mut self, steps: &mut [Step], course: Course) -> Option<()> {
        let n = steps.len();
        let closed = course == Course::Closed;
        loop {
            let mut moved = false;
            let mut open = false;
            for i in 0..n {
                let before = steps[(i + n - 1) % n].arriving.filter(|_| closed || i > 0);
                let after = steps[(i + 1) % n].leaving.filter(|_| closed || i + 1 < n);
                let step = &steps[i];
                let (leaving, arriving, through) = match &step.way {
                    Way::Curve { leaving, arriving, .. } => (*leaving, *arriving, None),
                    Way::Through { points, leaving, arriving } => {
                        (*leaving, *arriving, Some(points))
                    }
                    _ => continue,
                };
                let along = chord(step);
                let (first, last) = match through {
                    Some(points) => (
                        points.first().map_or(along, |p| curve::direction(*p - step.from)),
                        points.last().map_or(along, |p| curve::direction(step.to - *p)),
                    ),
                    None => (along, along),
                };
                let mut a = step.leaving.or_else(|| settle(leaving, before, first));
                let mut b = step.arriving.or_else(|| settle(arriving, after, last));
                if through.is_none() {
                    if leaving == Heading::Free {
                        a = a.or(match arriving {
                            Heading::Free => Some(along),
                            _ => b.map(|b| 2.0 * along - b),
                        });
                    }
                    if arriving == Heading::Free {
                        b = b.or(a.map(|a| 2.0 * along - a));
                    }
                } else if let Way::Through { points, .. } = &step.way {
                    // A free end of a spline has the direction of the finished spline.
                    let waits = (leaving != Heading::Free && a.is_none())
                        || (arriving != Heading::Free && b.is_none());
                    if !waits && (a.is_none() || b.is_none()) {
                        let path = spline(step, points, a, b);
                        a = a.or(Some(curve::leaving(&path)));
                        b = b.or(Some(curve::arriving(&path)));
                    }
                }
                moved |= (a.is_some() && step.leaving.is_none())
                    || (b.is_some() && step.arriving.is_none());
                open |= a.is_none() || b.is_none();
                steps[i].leaving = a;
                steps[i].arriving = b;
            }
            if !open {
                return Some(());
            }
            if !moved {
                let mut told =
                    Diagnostic::new("E0403", "these curves wait for each other's directions")
                        .help("give one of them a direction, such as `leaving -80deg`");
                for step in steps.iter().filter(|s| s.leaving.is_none() || s.arriving.is_none()) {
                    told = told.at(step.span, "waits");
                }
                self.tell(told);
                return None;
            }
        }
    }

    fn finish(&mut self, steps: Vec<Step>, of: &str) -> Option<Vec<Drawn>> {
        let mut drawn = Vec::with_capacity(steps.len());
        for step in steps {
            let path = match &step.way {
                Way::Path(path) => path.clone(),
                Way::Through { points, leaving, arriving } => {
                    let end = |heading: &Heading, known| {
                        if *heading == Heading::Free { None } else { known }
                    };
                    spline(&step, points, end(leaving, step.leaving), end(arriving, step.arriving))
                }
                Way::Curve { pull, .. } => {
                    let (Some(a), Some(b)) = (step.leaving, step.arriving) else { return None };
                    curve::between(step.from, step.to, a, b, *pull)
                }
                _ => return None,
            };
            let length = curve::length(&path);
            if !(length > CORNER && length < REACH) {
                self.tell(
                    Diagnostic::new("E0404", format!("an edge of {of} has no length"))
                        .at(step.span, format!("it is {} long", units::length(length))),
                );
                return None;
            }
            drawn.push(Drawn { name: step.name, span: step.span, path });
        }
        Some(drawn)
    }
}

fn step(phrase: &Phrase<'_>, from: Point, to: Point, way: Way) -> Step {
    Step {
        name: phrase.label.map(|name| name.text.clone()),
        span: phrase.span,
        from,
        to,
        way,
        leaving: None,
        arriving: None,
    }
}

fn spline(step: &Step, points: &[Point], leaving: Option<f64>, arriving: Option<f64>) -> BezPath {
    let mut all = vec![step.from];
    all.extend(points);
    all.push(step.to);
    all.dedup();
    if all.len() < 2 {
        return curve::line(step.from, step.to);
    }
    curve::through(&all, leaving, arriving)
}

/// The direction at an end, if it is known: said, or from the neighbour's end that meets it.
/// Of the two directions square to the neighbour the one nearer to the chord is taken.
fn settle(heading: Heading, neighbour: Option<f64>, along: f64) -> Option<f64> {
    match heading {
        Heading::Free => None,
        Heading::Said(direction) => Some(direction),
        Heading::Smooth => neighbour,
        Heading::Square => neighbour.map(|direction| {
            let left = direction + PI / 2.0;
            if libm::cos(left - along) >= 0.0 { left } else { left - PI }
        }),
    }
}
