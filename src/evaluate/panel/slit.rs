//! `slit along MARK`: the cloth is cut open along a line. One that begins at the rim opens the
//! outline; one inside is a hole without width.

use super::super::Evaluator;
use super::super::fields::{Fields, Phrase};
use super::mark::{self, Line, REACH};
use super::sheet::{self, CORNER, Edge, Leg, Sheet, Stretch};
use crate::diagnostic::Diagnostic;
use crate::geometry::curve;
use kurbo::{Affine, BezPath, Point, Shape};

/// A slit gapes so wide where it is widest, m: less than any seam is sewn to, so that its lips are
/// two lines for the compiler and one for everybody else.
const GAPE: f64 = 2e-4;

/// Shorter slits are none, m.
const SHORTEST: f64 = 2e-3;

/// The names of the lips that a slit gives: the label, or the mark, with 1 and 2.
pub(super) fn lips(phrase: &Phrase<'_>) -> Option<[String; 2]> {
    let along = phrase.value("along").and_then(|arg| super::super::fields::bare(arg.expr));
    let name = phrase.label.or(along)?;
    Some([1, 2].map(|number| format!("{}{number}", name.text)))
}

impl<'t> Evaluator<'t> {
    /// Cuts a sheet open along all marks that `slit` names; false if one cannot be cut.
    pub(super) fn slits(&mut self, fields: &Fields<'t>, sheet: &mut Sheet) -> bool {
        let mut sound = true;
        for phrase in fields.all("slit") {
            let lines = sheet.lines.clone();
            let (Some(number), Some(names)) = (self.marked(phrase, &lines), lips(phrase)) else {
                sound = false;
                continue;
            };
            let name = &lines[number].name;
            for line in lines.iter().filter(|line| line.name == *name) {
                if let Err(wrong) = sheet.slit(line, &names) {
                    self.tell(
                        Diagnostic::new(wrong.code(), wrong.title(name))
                            .at(phrase.span, "cut open here")
                            .at(line.span, wrong.label())
                            .help(wrong.help()),
                    );
                    sound = false;
                    break;
                }
            }
        }
        sound
    }
}

/// Why there is no slit along a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Wrong {
    Short,
    Through,
    Outside,
}

impl Wrong {
    fn code(self) -> &'static str {
        match self {
            Wrong::Short => "E0404",
            Wrong::Through => "E0413",
            Wrong::Outside => "E0412",
        }
    }

    fn title(self, name: &str) -> String {
        match self {
            Wrong::Short => "this slit has no length".to_owned(),
            Wrong::Through => format!("a slit along `{name}` would cut the piece in two"),
            Wrong::Outside => format!("`{name}` does not run through the cloth"),
        }
    }

    fn label(self) -> &'static str {
        match self {
            Wrong::Short => "its ends lie on each other",
            Wrong::Through => "it goes from rim to rim",
            Wrong::Outside => "no cloth in its middle",
        }
    }

    fn help(self) -> &'static str {
        match self {
            Wrong::Short => "a slit is 2 mm long at least",
            Wrong::Through => "let it end inside, or cut one side off: `trim along MARK keep SIDE`",
            Wrong::Outside => "draw the mark on the piece",
        }
    }
}

/// A path swung about a point by an angle, rad.
fn swung(path: &BezPath, about: Point, angle: f64) -> BezPath {
    let there = Affine::translate(about.to_vec2());
    curve::mapped(path, there * curve::turning(angle) * there.inverse())
}

impl Sheet {
    /// Cuts it open along a line. The first lip lies to the left of the line's course, the second
    /// to the right; both run along it.
    fn slit(&mut self, line: &Line, names: &[String; 2]) -> Result<(), Wrong> {
        let ends = [curve::start(&line.path), curve::end(&line.path)];
        if ends[0].distance(ends[1]) < SHORTEST {
            return Err(Wrong::Short);
        }
        let length = curve::length(&line.path);
        let middle = curve::at(&line.path, length / 2.0).0;
        let within = |ring: &Vec<BezPath>| sheet::closed(ring).winding(middle) != 0;
        let mut rings = self.rings.iter();
        if !rings.next().is_some_and(within) || rings.any(within) {
            return Err(Wrong::Outside);
        }
        let on_rim = ends.map(|end| self.on_rim(end));
        match on_rim {
            [Some(_), Some(_)] => Err(Wrong::Through),
            [None, None] => {
                self.open_inside(line, names);
                Ok(())
            }
            [Some((ring, piece, arc)), None] => {
                self.open_rim(line, names, (ring, piece, arc), false);
                Ok(())
            }
            [None, Some((ring, piece, arc))] => {
                self.open_rim(line, names, (ring, piece, arc), true);
                Ok(())
            }
        }
    }

    /// Ring, piece and arc length where a point lies on a rim.
    fn on_rim(&self, point: Point) -> Option<(usize, usize, f64)> {
        self.rings.iter().enumerate().find_map(|(ring, pieces)| {
            let found = mark::nearest(pieces.iter(), point)?;
            (found.away <= REACH).then_some((ring, found.edge, found.arc))
        })
    }

    fn lip(&mut self, line: &Line, name: &str, stretches: Vec<Stretch>) {
        let flat = stretches.last().map_or(0.0, |last| last.flat.1);
        self.edges.push(Edge {
            name: name.to_owned(),
            half: line.half,
            span: line.span,
            stretches,
            flat,
        });
    }

    /// A hole without width: both lips gape in the middle of the line.
    fn open_inside(&mut self, line: &Line, names: &[String; 2]) {
        let length = curve::length(&line.path);
        let halves = [(0.0, length / 2.0), (length / 2.0, length)];
        let [first, second] = halves.map(|(from, to)| curve::part(&line.path, from, to));
        let (start, end) = (curve::start(&line.path), curve::end(&line.path));
        let middle = curve::end(&first);
        let lip = |sense: f64| {
            let turn = |tip: Point| sense * 0.5 * GAPE / tip.distance(middle).max(SHORTEST / 4.0);
            let a = swung(&first, start, turn(start));
            let mut b = swung(&second, end, -turn(end));
            curve::start_at(&mut b, curve::end(&a));
            [a, b]
        };
        let ([a, b], [c, d]) = (lip(1.0), lip(-1.0));
        let ring = self.rings.len();
        self.rings.push(vec![a, b, curve::reversed(&d), curve::reversed(&c)]);
        let stretch = |half: usize, piece: usize, reversed: bool| Stretch {
            ring,
            piece,
            reversed,
            flat: halves[half],
        };
        self.lip(line, &names[0], vec![stretch(0, 0, false), stretch(1, 1, false)]);
        self.lip(line, &names[1], vec![stretch(0, 3, true), stretch(1, 2, true)]);
    }

    /// Opens a ring at a place of a piece; `backward` where the line ends there.
    fn open_rim(
        &mut self,
        line: &Line,
        names: &[String; 2],
        (ring, piece, arc): (usize, usize, f64),
        backward: bool,
    ) {
        let inward = if backward { curve::reversed(&line.path) } else { line.path.clone() };
        let tip = curve::end(&inward);
        let turn = 0.5 * GAPE / tip.distance(curve::start(&inward));
        // Beginning farther to the left, and farther to the right.
        let (left, right) = (swung(&inward, tip, -turn), swung(&inward, tip, turn));
        let area = sheet::closed(&self.rings[ring]).area();
        let cloth_left = (area > 0.0) == (ring == 0);
        let (into, out) = if cloth_left { (left, right) } else { (right, left) };
        let whole = self.rings[ring][piece].clone();
        let length = curve::length(&whole);
        let parted = arc > CORNER && arc < length - CORNER;
        let mut pieces: Vec<BezPath> = Vec::new();
        // Where the lips stand among the pieces.
        let at = if parted || arc >= length - CORNER { piece + 1 } else { piece };
        for (number, path) in self.rings[ring].iter().enumerate() {
            if number == piece && parted {
                pieces.push(curve::part(&whole, 0.0, arc));
                pieces.extend([into.clone(), curve::reversed(&out)]);
                pieces.push(curve::part(&whole, arc, length));
                continue;
            }
            if number == at && !parted {
                pieces.extend([into.clone(), curve::reversed(&out)]);
            }
            pieces.push(path.clone());
        }
        if at == self.rings[ring].len() && !parted {
            pieces.extend([into.clone(), curve::reversed(&out)]);
        }
        // The rim goes on to the lips, not the lips to the rim: these are equally long.
        let n = pieces.len();
        curve::end_at(&mut pieces[(at + n - 1) % n], curve::start(&into));
        curve::start_at(&mut pieces[(at + 2) % n], curve::start(&out));
        self.rings[ring] = pieces;
        let more = if parted { 3 } else { 2 };
        let moved = |old: usize| match old {
            old if parted && old > piece => old + more,
            old if !parted && old >= at => old + more,
            old => old,
        };
        for edge in &mut self.edges {
            let old = std::mem::take(&mut edge.stretches);
            for stretch in old {
                if stretch.ring != ring || stretch.piece != piece || !parted {
                    let here = stretch.ring == ring;
                    let piece = if here { moved(stretch.piece) } else { stretch.piece };
                    edge.stretches.push(Stretch { piece, ..stretch });
                    continue;
                }
                let (from, to) = stretch.flat;
                let share = if stretch.reversed { 1.0 - arc / length } else { arc / length };
                let cut = from + share * (to - from);
                let [first, second] =
                    if stretch.reversed { [piece + more, piece] } else { [piece, piece + more] };
                edge.stretches.push(Stretch { piece: first, flat: (from, cut), ..stretch.clone() });
                edge.stretches.push(Stretch { piece: second, flat: (cut, to), ..stretch });
            }
        }
        for side in self.joins.iter_mut().flat_map(|join| &mut join.sides) {
            let old: Vec<Leg> = std::mem::take(side);
            for leg in old {
                match leg {
                    (on, number, back) if on == ring && number == piece && parted => {
                        let both = [(ring, piece, back), (ring, piece + more, back)];
                        side.extend(if back { [both[1], both[0]] } else { both });
                    }
                    (on, number, back) if on == ring => side.push((on, moved(number), back)),
                    other => side.push(other),
                }
            }
        }
        let length = curve::length(&line.path);
        let stretch = |piece: usize, reversed: bool| {
            vec![Stretch { ring, piece, reversed: reversed != backward, flat: (0.0, length) }]
        };
        let (first, second) = (stretch(at, false), stretch(at + 1, true));
        // To the left of the way in, and to the left of the line's course.
        let in_is_left = cloth_left != backward;
        let [left, right] = if in_is_left { [first, second] } else { [second, first] };
        self.lip(line, &names[0], left);
        self.lip(line, &names[1], right);
    }
}
