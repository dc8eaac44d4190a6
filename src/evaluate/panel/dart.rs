//! Darts and notches: places along drawn edges, wedges cut out of them and out of the cloth.

use super::super::Evaluator;
use super::super::fields::{Arg, Fields, Phrase, bare};
use super::super::words::Form;
use super::instance::shape_edges;
use super::mouth::{Cut, Form as Closing, too_deep};
use super::operation::SHAPES;
use super::shape::SIZE;
use super::sheet::{self, Drawn, Join, Sheet};
use crate::diagnostic::{Diagnostic, Span};
use crate::garment::seam::SeamKind;
use crate::geometry::curve;
use crate::syntax::tree::Name;
use crate::units::{self, Dimension};
use kurbo::{BezPath, Point, Shape, Vec2};
use std::f64::consts::PI;

/// Mouths may touch, m.
const OVERLAP: f64 = 1e-9;

/// A dart with two tips: its upper tip, then round anticlockwise.
struct Diamond {
    name: String,
    span: Span,
    corners: [Point; 4],
}

/// Whether a point lies in the cloth of rings.
pub(super) fn within(bodies: &[BezPath], p: Point) -> bool {
    bodies.first().is_some_and(|outline| outline.winding(p) != 0)
        && bodies.iter().skip(1).all(|hole| hole.winding(p) == 0)
}

impl<'t> Evaluator<'t> {
    /// The drawn edge that a phrase names.
    pub(super) fn drawn_edge<'d>(
        &mut self,
        arg: Arg<'t>,
        rings: &'d [Vec<Drawn>],
    ) -> Option<(usize, usize, &'d Drawn)> {
        let name: &'t Name = self.name_of(arg)?;
        for (ring, edges) in rings.iter().enumerate() {
            let found = edges
                .iter()
                .enumerate()
                .find(|(_, edge)| edge.name.as_deref() == Some(name.text.as_str()));
            if let Some((place, edge)) = found {
                self.note_edge(name, [edge.span]);
                return Some((ring, place, edge));
            }
        }
        let known = rings.iter().flatten().filter_map(|edge| edge.name.as_deref());
        self.no_member("this panel", name, known);
        None
    }

    /// A place along an edge: a share or a length from its start, or from the end that touches
    /// the edge named behind `from`.
    fn along(&mut self, phrase: &Phrase<'t>, rings: &[Vec<Drawn>], edge: &Drawn) -> Option<f64> {
        let at = self.place_on(phrase.value("at")?, edge)?;
        let length = curve::length(&edge.path);
        let Some(from) = phrase.value("from") else { return Some(at) };
        let (_, _, neighbour) = self.drawn_edge(from, rings)?;
        let ends = [curve::start(&neighbour.path), curve::end(&neighbour.path)];
        let touches =
            |p: Point| ends.iter().any(|end| libm::hypot(end.x - p.x, end.y - p.y) < sheet::CORNER);
        if touches(curve::start(&edge.path)) {
            Some(at)
        } else if touches(curve::end(&edge.path)) {
            Some(length - at)
        } else {
            self.tell(
                Diagnostic::new("E0504", "these edges do not touch")
                    .at(from.expr.span, "counted from here")
                    .at(phrase.span, "on this edge"),
            );
            None
        }
    }

    /// A share of an edge or a length from its start, as arc length, m.
    pub(super) fn place_on(&mut self, arg: Arg<'t>, edge: &Drawn) -> Option<f64> {
        let length = curve::length(&edge.path);
        let place = self.quantity_of(arg, &[Dimension::LENGTH, Dimension::NUMBER])?;
        let at = if place.dimension.is_number() { place.value * length } else { place.value };
        if !(-1e-9..=length + 1e-9).contains(&at) {
            let mut told =
                Diagnostic::new("E0303", format!("this edge is {} long", units::length(length)))
                    .at(arg.expr.span, format!("{} lies beyond its ends", units::length(at)))
                    .at(edge.span, "the edge");
            let bare = place.dimension.is_number() && !self.snippet(arg.expr.span).contains('%');
            if bare && place.value > 1.0 {
                let n = place.value;
                told = told.help(format!(
                    "a number without a unit counts whole edges; write `{n}%` or `{n}cm`"
                ));
            }
            self.tell(told);
            return None;
        }
        Some(at.clamp(0.0, length))
    }

    /// The sheet with its darts cut out and its edges laid in pleats.
    pub(super) fn darted(
        &mut self,
        fields: &Fields<'t>,
        rings: &[Vec<Drawn>],
        name: &str,
    ) -> Option<Sheet> {
        let mut cuts: Vec<Vec<Vec<Cut>>> =
            rings.iter().map(|ring| ring.iter().map(|_| Vec::new()).collect()).collect();
        let bodies: Vec<BezPath> = rings
            .iter()
            .map(|ring| {
                sheet::closed(&ring.iter().map(|edge| edge.path.clone()).collect::<Vec<_>>())
            })
            .collect();
        let mut sound = true;
        let mut diamonds: Vec<Diamond> = Vec::new();
        for (number, phrase) in fields.all("dart").enumerate() {
            let label = phrase
                .label
                .map_or_else(|| format!("dart{}", number + 1), |label| label.text.clone());
            if phrase.says("on") {
                match self.dart(phrase, rings, &bodies, label) {
                    Some((ring, place, cut)) => cuts[ring][place].push(cut),
                    None => sound = false,
                }
            } else {
                match self.diamond(phrase, &bodies, label) {
                    Some(diamond) => diamonds.push(diamond),
                    None => sound = false,
                }
            }
        }
        let mut creases = Vec::new();
        sound &= self.pleats(fields, rings, &mut cuts, &mut creases);
        for (edge, list) in rings.iter().flatten().zip(cuts.iter_mut().flatten()) {
            list.sort_by(|a, b| a.mouth.0.total_cmp(&b.mouth.0));
            for pair in list.windows(2) {
                let [first, second] = pair else { continue };
                if first.mouth.1 > second.mouth.0 + OVERLAP {
                    let wedge = |cut: &Cut| matches!(cut.form, Closing::Wedge { .. });
                    let (code, what) = if wedge(first) && wedge(second) {
                        ("E0406", "darts")
                    } else {
                        ("E0411", "folds of an edge")
                    };
                    self.tell(
                        Diagnostic::new(code, format!("two {what} of `{name}` overlap"))
                            .at(second.span, "this one")
                            .at(first.span, "and this one")
                            .at(edge.span, "on this edge"),
                    );
                    sound = false;
                }
            }
            if let Some((cut, room)) = too_deep(curve::length(&edge.path), list) {
                self.tell(
                    Diagnostic::new("E0411", "this pleat has no cloth to lie beneath")
                        .at(cut.span, format!("{} are left beside it", units::length(room)))
                        .at(edge.span, "on this edge")
                        .help("make it less deep, move it away from the end, or let it face the other way"),
                );
                sound = false;
            }
        }
        if !sound {
            return None;
        }
        let mut sheet = Sheet { creases, ..Sheet::default() };
        for (ring, list) in rings.iter().zip(&cuts) {
            sheet.add_ring(ring, list);
        }
        for diamond in diamonds {
            let ring = sheet.rings.len();
            let [a, b, c, d] = diamond.corners;
            sheet.rings.push(vec![
                curve::line(a, b),
                curve::line(b, c),
                curve::line(c, d),
                curve::line(d, a),
            ]);
            sheet.joins.push(Join {
                name: diamond.name,
                kind: SeamKind::Dart,
                half: None,
                span: diamond.span,
                sides: [
                    vec![(ring, 0, false), (ring, 1, false)],
                    vec![(ring, 3, true), (ring, 2, true)],
                ],
            });
        }
        Some(sheet)
    }

    /// `dart at P width L above L below L`: a dart with two tips inside the cloth.
    fn diamond(
        &mut self,
        phrase: &Phrase<'t>,
        bodies: &[BezPath],
        name: String,
    ) -> Option<Diamond> {
        let (Some(above), Some(below)) = (phrase.value("above"), phrase.value("below")) else {
            self.tell(
                Diagnostic::new("E0208", "a dart is said by its edge, or by its two tips")
                    .at(phrase.span, "`on` or `above` and `below` are missing here")
                    .help("`dart on waist at 50% width 2cm depth 9cm` or `dart at (8cm, -2cm) width 2cm above 9cm below 12cm`"),
            );
            return None;
        };
        for word in ["from", "depth", "to"] {
            if let Some(said) = phrase.clause(word) {
                self.tell(
                    Diagnostic::new("E0207", format!("`{word}` goes with a dart `on` an edge"))
                        .at(said.span, "here"),
                );
                return None;
            }
        }
        let at = self.point(phrase.value("at")?);
        let width = self.within_range(phrase.value("width")?, Dimension::LENGTH, 1e-4, SIZE);
        let above = self.within_range(above, Dimension::LENGTH, 1e-3, SIZE);
        let below = self.within_range(below, Dimension::LENGTH, 1e-3, SIZE);
        let turn = match phrase.value("turn") {
            Some(arg) => self.quantity(arg, Dimension::ANGLE),
            None => Some(0.0),
        };
        let ([x, y], width, above, below, turn) = (at?, width?, above?, below?, turn?);
        let (across, along) = (curve::unit(turn), curve::unit(turn + PI / 2.0));
        let middle = Point::new(x, y);
        let corners = [
            middle + along * above,
            middle - across * (width / 2.0),
            middle - along * below,
            middle + across * (width / 2.0),
        ];
        if !corners.iter().all(|corner| within(bodies, *corner)) {
            self.tell(
                Diagnostic::new("E0406", "this dart does not lie within the cloth")
                    .at(phrase.span, "here")
                    .help("a dart that ends at an edge is said `on` that edge"),
            );
            return None;
        }
        Some(Diamond { name, span: phrase.span, corners })
    }

    fn dart(
        &mut self,
        phrase: &Phrase<'t>,
        rings: &[Vec<Drawn>],
        bodies: &[BezPath],
        name: String,
    ) -> Option<(usize, usize, Cut)> {
        let (ring, place, edge) = self.drawn_edge(phrase.value("on")?, rings)?;
        let middle = self.along(phrase, rings, edge)?;
        let width = self.within_range(phrase.value("width")?, Dimension::LENGTH, 1e-4, SIZE)?;
        let length = curve::length(&edge.path);
        let inside = |p: Point| within(bodies, p);
        let fits = |a: f64, b: f64| a >= 1e-4 && b <= length - 1e-4;
        let beyond = |ev: &mut Self| {
            ev.tell(
                Diagnostic::new("E0406", "this dart is wider than the edge at its place")
                    .at(phrase.span, format!("{} wide", units::length(width)))
                    .at(edge.span, format!("{} long", units::length(length)))
                    .help("a dart must leave at least 0.1 mm of the edge on both sides"),
            );
        };
        let mouth = (middle - width / 2.0, middle + width / 2.0);
        if !fits(mouth.0, mouth.1) {
            beyond(self);
            return None;
        }
        let (a, _) = curve::at(&edge.path, mouth.0);
        let (b, _) = curve::at(&edge.path, mouth.1);
        let (corners, tip) = if let Some(to) = phrase.value("to") {
            let [x, y] = self.point(to)?;
            let tip = Point::new(x, y);
            // Both legs get the mean of their lengths; the edge is trued to them.
            let (first, second) = (a - tip, b - tip);
            let (p, q) = (libm::hypot(first.x, first.y), libm::hypot(second.x, second.y));
            let leg = 0.5 * (p + q);
            if leg < 1e-3 || (p - q).abs() > 0.4 * leg.min(length) {
                self.tell(
                    Diagnostic::new("E0406", "the legs of this dart cannot be made equal")
                        .at(phrase.span, format!("they differ by {}", units::length((p - q).abs())))
                        .at(to.expr.span, "the tip")
                        .help("move the tip nearer to the middle of the mouth, or use `depth`"),
                );
                return None;
            }
            ((tip + first * (leg / p), tip + second * (leg / q)), tip)
        } else {
            let Some(depth) = phrase.value("depth") else {
                self.tell_no_tip(phrase);
                return None;
            };
            let depth = self.within_range(depth, Dimension::LENGTH, 1e-3, SIZE)?;
            let across = b - a;
            let size = libm::hypot(across.x, across.y).max(f64::MIN_POSITIVE);
            let left = Vec2::new(-across.y / size, across.x / size);
            let foot = a.midpoint(b);
            let near = foot + left * 1e-3;
            let inward = if inside(near) { left } else { -left };
            ((a, b), foot + inward * depth)
        };
        if !inside(tip) {
            self.tell(
                Diagnostic::new("E0406", "the tip of this dart lies outside the cloth")
                    .at(phrase.span, "here")
                    .help("make it less deep, or move it along the edge"),
            );
            return None;
        }
        let form = Closing::Wedge { corners, tip };
        Some((ring, place, Cut { name, span: phrase.span, mouth, form }))
    }

    fn tell_no_tip(&mut self, phrase: &Phrase<'t>) {
        self.tell(
            Diagnostic::new("E0208", "`dart` must be given `depth` or `to`")
                .at(phrase.span, "missing here")
                .help(phrase.word.usage()),
        );
    }

    pub(super) fn notched(
        &mut self,
        fields: &Fields<'t>,
        rings: &[Vec<Drawn>],
        sheet: &mut Sheet,
    ) -> bool {
        let outline = sheet.rings.first().map(|pieces| sheet::closed(pieces)).unwrap_or_default();
        let mut sound = true;
        for phrase in fields.all("notch") {
            let edge = phrase.value("on").and_then(|on| self.drawn_edge(on, rings));
            let place =
                edge.and_then(|(_, _, edge)| Some((edge, self.along(phrase, rings, edge)?)));
            let Some((edge, place)) = place else {
                sound = false;
                continue;
            };
            let (at, direction) = curve::at(&edge.path, place);
            let left = curve::unit(direction + PI / 2.0);
            let inward = if outline.winding(at + left * 1e-4) != 0 { left } else { -left };
            sheet.notches.push((at, inward));
        }
        sound
    }

    /// Looks over the operations of a panel whose edges could not be drawn, for mistakes of
    /// their own.
    pub(super) fn look_over(
        &mut self,
        fields: &Fields<'t>,
        shape: &Phrase<'t>,
        outline: Option<&Fields<'t>>,
    ) {
        let mut names: Vec<&str> = shape_edges(shape).to_vec();
        if let Some(outline) = outline {
            let labels = outline.phrases.iter().filter_map(|edge| edge.label);
            let spoiled = outline.spoiled.iter().filter_map(|edge| edge.label);
            names.extend(labels.chain(spoiled).map(|label| label.text.as_str()));
        }
        // Traced edges bring names of their own.
        let all_known = outline.is_none_or(|outline| !outline.mentions("trace"));
        let lines = fields.phrases.iter().filter(|line| line.word.form == Form::Action);
        for line in lines.filter(|line| !SHAPES.contains(&line.word.name)) {
            for arg in ["on", "from", "across"].into_iter().filter_map(|word| line.value(word)) {
                let Some(name) = bare(arg.expr) else { continue };
                if all_known && !names.contains(&name.text.as_str()) {
                    self.no_member("this panel", name, names.iter().copied());
                }
            }
            let lengths = ["width", "depth", "radius"];
            for arg in lengths.into_iter().filter_map(|word| line.value(word)) {
                self.quantity(arg, Dimension::LENGTH);
            }
            if let ("dart" | "notch" | "tuck", Some(at)) =
                (line.word.name, line.value("at").filter(|_| line.says("on")))
            {
                self.quantity_of(at, &[Dimension::LENGTH, Dimension::NUMBER]);
            }
            if let ("dart" | "fold", Some(to)) = (line.word.name, line.value("to")) {
                self.point(to);
            }
            let tipless = !line.says("depth") && !line.says("to") && line.says("on");
            if line.word.name == "dart" && tipless {
                self.tell_no_tip(line);
            }
        }
    }
}
