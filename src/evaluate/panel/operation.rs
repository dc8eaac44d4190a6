//! Operations on a panel: shapes, darts, holes, folds, copies.

use super::super::Evaluator;
use super::super::fields::{Arg, Phrase, bare};
use super::super::item::ItemId;
use super::super::words::Kind;
use super::sheet::{self, Cut, Drawn, Edge, Sheet};
use super::{CutDart, CutEdge, CutPiece, Draft, Instance, InstanceId, Standing};
use crate::diagnostic::{Diagnostic, Span};
use crate::geometry::{crossing, curve};
use crate::syntax::tree::Name;
use crate::units::{self, Dimension};
use kurbo::{Affine, BezPath, Point, Shape, Vec2};
use std::f64::consts::{PI, TAU};

/// Shapes of which a panel has one.
const SHAPES: &[&str] = &["outline", "rectangle", "circle", "ring"];

/// A pattern piece may be so large, m.
const SIZE: f64 = 100.0;

impl<'t> Evaluator<'t> {
    /// Draws and cuts the panel of an instance.
    pub(super) fn cut_out(&mut self, id: InstanceId) -> Option<Draft> {
        let Instance { item, fields, outline, holes, .. } = self.instances.get(id.0)?;
        let (item, fields, outline, holes) =
            (*item, fields.clone(), outline.clone(), holes.clone());
        let name = self.item(item).name.clone();
        let span = self.item(item).span;
        let shapes: Vec<&Phrase<'t>> =
            fields.phrases.iter().filter(|p| SHAPES.contains(&p.word.name)).collect();
        let shape = match shapes.as_slice() {
            [one] => *one,
            [] => {
                self.tell(
                    Diagnostic::new("E0208", format!("panel `{name}` has no shape"))
                        .at(span, "missing here")
                        .help("draw it: `outline from (0, 0) { … }`, `rectangle W x H`, `circle radius R` or `ring inner R outer R`"),
                );
                return None;
            }
            [first, second, ..] => {
                self.tell(
                    Diagnostic::new("E0209", format!("panel `{name}` has two shapes"))
                        .at(second.span, "here")
                        .at(first.span, "and here"),
                );
                return None;
            }
        };
        let mut rings: Vec<Vec<Drawn>> = if shape.word.name == "outline" {
            let from = shape.value("from")?;
            let start = self.point(from)?;
            let read = outline?;
            vec![self.draw(&read, start, from.expr.span, &format!("`{name}`"))?]
        } else {
            self.shape(shape)?
        };
        let mut sound = true;
        for (number, phrase) in fields.phrases.iter().enumerate() {
            if phrase.word.name == "hole" {
                let read = holes.iter().find(|(n, _)| *n == number).map(|(_, read)| read);
                match self.hole(phrase, read, &name) {
                    Some(ring) => rings.push(ring),
                    None => sound = false,
                }
            }
        }
        let drawn: Vec<Drawn> = rings.iter().flatten().cloned().collect();
        let mut sheet = self.darted(&fields, &rings, &name).or_else(|| {
            sound = false;
            None
        })?;
        sound &= self.notched(&fields, &rings, &mut sheet).is_some();
        for phrase in fields.all("rotate") {
            let angle = self.quantity(phrase.value("by")?, Dimension::ANGLE)?;
            let about = match phrase.value("about") {
                Some(arg) => self.point(arg)?,
                None => [0.0, 0.0],
            };
            sheet = sheet.mapped(Affine::rotate_about(angle, Point::new(about[0], about[1])));
        }
        let (sheet, halves) = self.folded(&fields, sheet, item)?;
        let pieces = self.copies(&fields, sheet, halves.as_ref())?;
        for piece in &pieces {
            sound &= self.sound_piece(piece, &name, span);
        }
        let fabric = self.fabric_of(item, 0);
        let grain = self.quantity_or(&fields, "grain", Dimension::ANGLE, 0.0)?;
        let cell = match fields.value("grid") {
            Some(arg) => Some(self.within_range(arg, Dimension::LENGTH, 1e-4, 1.0)?),
            None => None,
        };
        let (layer, inside) = match fields.value("layer") {
            None => (0, false),
            Some(arg) if bare(arg.expr).is_some_and(|word| word.text == "inside") => (0, true),
            Some(arg) => (self.whole_number(arg, -100, 100)? as i32, false),
        };
        sound.then_some(Draft {
            item,
            name,
            span,
            scope: fields.scope,
            fabric,
            grain,
            cell,
            layer,
            inside,
            drawn,
            pieces,
        })
    }

    /// The fabric said behind `of`, by the panel or by the one it copies, or as a property.
    fn fabric_of(&mut self, item: ItemId, depth: usize) -> Option<ItemId> {
        let phrase = self.item(item).phrase.clone();
        let own = self.instances.iter().rev().find(|instance| instance.item == item);
        let property = own.and_then(|instance| instance.fields.value("fabric"));
        if let Some(arg) = property.or_else(|| phrase.value("of")) {
            return self.item_among(arg, &[Kind::Fabric]);
        }
        let base = phrase.value("=").filter(|_| depth < 64)?;
        let base = self.item_named(base, Kind::Panel)?;
        self.fabric_of(base, depth + 1)
    }

    /// A rectangle, disc or ring as drawn edges.
    fn shape(&mut self, phrase: &Phrase<'t>) -> Option<Vec<Vec<Drawn>>> {
        let positive = |ev: &mut Self, arg: Option<Arg<'t>>| {
            ev.within_range(arg?, Dimension::LENGTH, 1e-4, SIZE)
        };
        let span = phrase.span;
        let edge = |name: &str, path: BezPath| Drawn { name: Some(name.to_owned()), span, path };
        let circle = |radius: f64, name: &str| {
            let mut path = curve::arc(Point::new(0.0, -radius), Point::ZERO, TAU);
            curve::end_at(&mut path, Point::new(0.0, -radius));
            vec![edge(name, path)]
        };
        match phrase.word.name {
            "rectangle" => {
                let width = positive(self, phrase.arg(0))?;
                let height = positive(self, phrase.arg(1))?;
                Some(vec![rectangle([-width / 2.0, 0.0], [width / 2.0, height], span)])
            }
            "circle" => {
                let radius = positive(self, phrase.value("radius"))?;
                Some(vec![circle(radius, "rim")])
            }
            _ => {
                let inner = positive(self, phrase.value("inner"))?;
                let outer = positive(self, phrase.value("outer"))?;
                if outer <= inner + 1e-4 {
                    self.tell(
                        Diagnostic::new("E0303", "the outer radius of a ring is the greater one")
                            .at(
                                span,
                                format!("{} and {}", units::length(inner), units::length(outer)),
                            ),
                    );
                    return None;
                }
                let sweep = match phrase.value("sweep") {
                    Some(arg) => self.within_range(arg, Dimension::ANGLE, 0.01, TAU)?,
                    None => TAU,
                };
                if sweep > TAU - 1e-6 {
                    return Some(vec![circle(outer, "outer"), circle(inner, "inner")]);
                }
                // The middle of the ring lies below the centre, as a skirt hangs.
                let from = -PI / 2.0 - sweep / 2.0;
                let at = |radius: f64, angle: f64| Point::ZERO + curve::unit(angle) * radius;
                let (a, b) = (at(inner, from), at(outer, from));
                let outer_arc = curve::arc(b, Point::ZERO, sweep);
                let c = curve::end(&outer_arc);
                let d = at(inner, from + sweep);
                let mut inner_arc = curve::arc(d, Point::ZERO, -sweep);
                curve::end_at(&mut inner_arc, a);
                Some(vec![vec![
                    edge("start", curve::line(a, b)),
                    edge("outer", outer_arc),
                    edge("end", curve::line(c, d)),
                    edge("inner", inner_arc),
                ]])
            }
        }
    }

    fn hole(
        &mut self,
        phrase: &Phrase<'t>,
        read: Option<&super::Fields<'t>>,
        name: &str,
    ) -> Option<Vec<Drawn>> {
        if phrase.says("circle") {
            let (Some(at), Some(radius)) = (phrase.value("at"), phrase.value("radius")) else {
                self.tell(
                    Diagnostic::new("E0208", "a round hole wants `at POINT radius LENGTH`")
                        .at(phrase.span, "missing here"),
                );
                return None;
            };
            let [x, y] = self.point(at)?;
            let radius = self.within_range(radius, Dimension::LENGTH, 1e-4, SIZE)?;
            let from = Point::new(x, y - radius);
            let mut path = curve::arc(from, Point::new(x, y), TAU);
            curve::end_at(&mut path, from);
            let name = phrase.label.map(|label| label.text.clone());
            return Some(vec![Drawn { name, span: phrase.span, path }]);
        }
        let (Some(from), Some(read)) = (phrase.value("from"), read) else {
            self.tell(
                Diagnostic::new("E0208", "a hole wants its edges")
                    .at(phrase.span, "here")
                    .help("`hole from P { edges }` or `hole circle at P radius L`"),
            );
            return None;
        };
        let start = self.point(from)?;
        self.draw(read, start, from.expr.span, &format!("a hole in `{name}`"))
    }

    /// The drawn edge that a phrase names.
    fn drawn_edge<'d>(
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
        let length = curve::length(&edge.path);
        let arg = phrase.value("at")?;
        let place = self.quantity_of(arg, &[Dimension::LENGTH, Dimension::NUMBER])?;
        let mut at = if place.dimension.is_number() { place.value * length } else { place.value };
        if !(-1e-9..=length + 1e-9).contains(&at) {
            self.tell(
                Diagnostic::new("E0303", format!("this edge is {} long", units::length(length)))
                    .at(arg.expr.span, format!("{} lies beyond its ends", units::length(at)))
                    .at(edge.span, "the edge"),
            );
            return None;
        }
        at = at.clamp(0.0, length);
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

    /// The sheet with its darts cut out.
    fn darted(
        &mut self,
        fields: &super::Fields<'t>,
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
        for (number, phrase) in fields.all("dart").enumerate() {
            let label = phrase
                .label
                .map_or_else(|| format!("dart{}", number + 1), |label| label.text.clone());
            match self.dart(phrase, rings, &bodies, label) {
                Some((ring, place, cut)) => cuts[ring][place].push(cut),
                None => sound = false,
            }
        }
        for (edge, list) in rings.iter().flatten().zip(cuts.iter_mut().flatten()) {
            list.sort_by(|a, b| a.mouth.0.total_cmp(&b.mouth.0));
            for pair in list.windows(2) {
                if pair[0].mouth.1 > pair[1].mouth.0 - 1e-6 {
                    self.tell(
                        Diagnostic::new("E0406", format!("two darts of `{name}` overlap"))
                            .at(pair[1].span, "this one")
                            .at(pair[0].span, "and this one")
                            .at(edge.span, "on this edge"),
                    );
                    sound = false;
                }
            }
        }
        if !sound {
            return None;
        }
        let mut sheet = Sheet::default();
        for (ring, list) in rings.iter().zip(&cuts) {
            sheet.add_ring(ring, list);
        }
        Some(sheet)
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
        let inside = |p: Point| {
            bodies.first().is_some_and(|outline| outline.winding(p) != 0)
                && bodies.iter().skip(1).all(|hole| hole.winding(p) == 0)
        };
        let fits = |a: f64, b: f64| a >= 1e-4 && b <= length - 1e-4;
        let beyond = |ev: &mut Self| {
            ev.tell(
                Diagnostic::new("E0406", "this dart is wider than the edge at its place")
                    .at(phrase.span, format!("{} wide", units::length(width)))
                    .at(edge.span, format!("{} long", units::length(length)))
                    .help("a dart must leave at least 0.1 mm of the edge on both sides"),
            );
        };
        let (mouth, tip) = if let Some(to) = phrase.value("to") {
            let [x, y] = self.point(to)?;
            let tip = Point::new(x, y);
            // Slide the mouth along the edge until both legs are equal.
            let legs = |a: f64| {
                let (p, _) = curve::at(&edge.path, a);
                let (q, _) = curve::at(&edge.path, a + width);
                libm::hypot(p.x - x, p.y - y) - libm::hypot(q.x - x, q.y - y)
            };
            let (mut low, mut high) = (middle - width, middle);
            if !fits(low, high + width) || legs(low) * legs(high) > 0.0 {
                // Near a corner, or a tip far to one side: keep the mouth about its middle.
                low = middle - width / 2.0;
                high = low;
                if !fits(low, low + width) {
                    beyond(self);
                    return None;
                }
                if legs(low).abs() > 1e-3 {
                    self.tell(
                        Diagnostic::new("E0406", "the legs of this dart cannot be made equal")
                            .at(
                                phrase.span,
                                format!("they differ by {}", units::length(legs(low).abs())),
                            )
                            .at(to.expr.span, "the tip")
                            .help("move the tip nearer to the middle of the mouth, or use `depth`"),
                    );
                    return None;
                }
            }
            let falling = legs(low) > 0.0;
            for _ in 0..60 {
                let half = 0.5 * (low + high);
                if (legs(half) > 0.0) == falling { low = half } else { high = half }
            }
            ((low, low + width), tip)
        } else {
            let depth = self.within_range(phrase.value("depth")?, Dimension::LENGTH, 1e-3, SIZE)?;
            let mouth = (middle - width / 2.0, middle + width / 2.0);
            if !fits(mouth.0, mouth.1) {
                beyond(self);
                return None;
            }
            let (a, _) = curve::at(&edge.path, mouth.0);
            let (b, _) = curve::at(&edge.path, mouth.1);
            let across = b - a;
            let size = libm::hypot(across.x, across.y).max(f64::MIN_POSITIVE);
            let left = Vec2::new(-across.y / size, across.x / size);
            let foot = a.midpoint(b);
            let near = foot + left * 1e-3;
            let inward = if inside(near) { left } else { -left };
            (mouth, foot + inward * depth)
        };
        if !inside(tip) {
            self.tell(
                Diagnostic::new("E0406", "the tip of this dart lies outside the cloth")
                    .at(phrase.span, "here")
                    .help("make it less deep, or move it along the edge"),
            );
            return None;
        }
        Some((ring, place, Cut { name, span: phrase.span, mouth, tip }))
    }

    fn notched(
        &mut self,
        fields: &super::Fields<'t>,
        rings: &[Vec<Drawn>],
        sheet: &mut Sheet,
    ) -> Option<()> {
        let outline = sheet.rings.first().map(|pieces| sheet::closed(pieces))?;
        for phrase in fields.all("notch") {
            let (_, _, edge) = self.drawn_edge(phrase.value("on")?, rings)?;
            let place = self.along(phrase, rings, edge)?;
            let (at, direction) = curve::at(&edge.path, place);
            let left = curve::unit(direction + PI / 2.0);
            let inward = if outline.winding(at + left * 1e-4) != 0 { left } else { -left };
            sheet.notches.push((at, inward));
        }
        Some(())
    }

    /// `unfold across E`: the sheet with its mirror image, and the names of the halves.
    fn folded(
        &mut self,
        fields: &super::Fields<'t>,
        sheet: Sheet,
        item: ItemId,
    ) -> Option<(Sheet, Option<[String; 2]>)> {
        let Some(phrase) = fields.get("unfold") else { return Some((sheet, None)) };
        let arg = phrase.value("across")?;
        let name: &'t Name = self.name_of(arg)?;
        let Some(edge) = sheet.edges.iter().find(|edge| edge.name == name.text) else {
            let known: Vec<String> = sheet.edges.iter().map(|edge| edge.name.clone()).collect();
            self.no_member("this panel", name, known.iter().map(String::as_str));
            return None;
        };
        let straight = match edge.stretches.as_slice() {
            [one] if one.ring == 0 => sheet.rings[0].get(one.piece).filter(|path| {
                let ends = curve::end(path) - curve::start(path);
                curve::length(path) - libm::hypot(ends.x, ends.y) < 1e-7
            }),
            _ => None,
        };
        let (Some(line), Some(fold)) = (straight, edge.stretches.first().map(|s| s.piece)) else {
            self.tell(
                Diagnostic::new("E0409", "cloth folds along a straight edge without darts")
                    .at(arg.expr.span, "this one is not")
                    .at(edge.span, "drawn here"),
            );
            return None;
        };
        // Which side of the fold the drawing lies on, seen from outside.
        let body = sheet::closed(&sheet.rings[0]).bounding_box().center();
        let drawn_right = body.x > curve::start(line).midpoint(curve::end(line)).x;
        let names = match phrase.values("as").as_slice() {
            [first, second] => {
                [self.name_of(*first)?.text.clone(), self.name_of(*second)?.text.clone()]
            }
            [] => {
                let standing = self.sides.get(&item).copied();
                let Some(standing) = standing else {
                    let name = self.item(item).name.clone();
                    self.tell(
                        Diagnostic::new(
                            "E0801",
                            format!("`{name}` is unfolded, but which half is the wearer's left?"),
                        )
                        .at(phrase.span, "unfolded here")
                        .help(format!(
                            "place it before or behind the wearer, or name the halves: `unfold across {} as left, right`",
                            arg.of_text(self)
                        )),
                    );
                    return None;
                };
                // Seen from the front the wearer's left is at the viewer's right.
                let drawn_left = drawn_right == (standing == Standing::Before);
                if drawn_left {
                    ["left".to_owned(), "right".to_owned()]
                } else {
                    ["right".to_owned(), "left".to_owned()]
                }
            }
            [first, ..] => {
                self.tell(
                    Diagnostic::new("E0306", "an unfolded piece has two halves")
                        .at(first.expr.span, "two names are wanted"),
                );
                return None;
            }
        };
        Some((sheet.unfolded(fold), Some(names)))
    }

    /// `pair as a, b`: the piece once or twice, its rings turned and measured.
    fn copies(
        &mut self,
        fields: &super::Fields<'t>,
        mut sheet: Sheet,
        halves: Option<&[String; 2]>,
    ) -> Option<Vec<CutPiece>> {
        let Some(phrase) = fields.get("pair") else {
            sheet.orient();
            return Some(vec![cut_piece(&sheet, None, halves)]);
        };
        let names = phrase.values("as");
        let [first, second] = names.as_slice() else {
            self.tell(
                Diagnostic::new("E0306", "`pair` wants two names")
                    .at(phrase.span, "here")
                    .help("`pair as left, right`: the first is the piece as drawn"),
            );
            return None;
        };
        let (first, second) = (self.name_of(*first)?, self.name_of(*second)?);
        if first.text == second.text {
            self.tell(
                Diagnostic::new("E0205", "both pieces of a pair have one name")
                    .at(second.span, "here"),
            );
            return None;
        }
        let mut other = sheet.mapped(Affine::new([-1.0, 0.0, 0.0, 1.0, 0.0, 0.0]));
        sheet.orient();
        other.orient();
        Some(vec![
            cut_piece(&sheet, Some(first.text.clone()), halves),
            cut_piece(&other, Some(second.text.clone()), halves),
        ])
    }

    /// Tells outlines that cross themselves (E0402); false if one does.
    fn sound_piece(&mut self, piece: &CutPiece, name: &str, span: Span) -> bool {
        let loops: Vec<Vec<BezPath>> = piece
            .loops
            .iter()
            .map(|ring| ring.pieces.iter().map(|piece| piece.path.clone()).collect())
            .collect();
        let Some(found) = crossing::first_crossing(&loops) else { return true };
        let place = |on: crossing::OnPiece| {
            piece
                .edges
                .iter()
                .find(|edge| {
                    edge.runs.iter().any(|(run, _)| run.ring == on.ring && run.piece == on.piece)
                })
                .map(|edge| edge.span)
                .or_else(|| {
                    piece
                        .darts
                        .iter()
                        .find(|dart| {
                            dart.legs.iter().any(|leg| leg.ring == on.ring && leg.piece == on.piece)
                        })
                        .map(|dart| dart.span)
                })
                .unwrap_or(span)
        };
        let at = format!(
            "they meet at ({}, {})",
            units::length(found.at[0]),
            units::length(found.at[1])
        );
        let (a, b) = (place(found.a), place(found.b));
        let mut told = Diagnostic::new("E0402", format!("the outline of `{name}` crosses itself"))
            .at(a, if a == b { at.clone() } else { "this edge".to_owned() });
        if a != b {
            told = told.at(b, format!("and this one; {at}"));
        }
        self.tell(told);
        false
    }
}

impl<'t> Arg<'t> {
    /// The value as it stands in the text.
    fn of_text(&self, ev: &Evaluator<'t>) -> &'t str {
        ev.snippet(self.expr.span)
    }
}

/// The edges of a rectangle between two corners: bottom, end, top, start.
pub(in super::super) fn rectangle(low: [f64; 2], high: [f64; 2], span: Span) -> Vec<Drawn> {
    let corners = [
        Point::new(low[0], low[1]),
        Point::new(high[0], low[1]),
        Point::new(high[0], high[1]),
        Point::new(low[0], high[1]),
    ];
    ["bottom", "end", "top", "start"]
        .iter()
        .enumerate()
        .map(|(i, name)| Drawn {
            name: Some((*name).to_owned()),
            span,
            path: curve::line(corners[i], corners[(i + 1) % 4]),
        })
        .collect()
}

/// A sheet, its rings turned already, as a piece with measured runs.
pub(in super::super) fn cut_piece(
    sheet: &Sheet,
    side: Option<String>,
    halves: Option<&[String; 2]>,
) -> CutPiece {
    let loops = sheet.loops();
    let half_name =
        |half: Option<usize>| half.and_then(|half| halves.map(|names| names[half.min(1)].clone()));
    let edge = |edge: &Edge| CutEdge {
        name: edge.name.clone(),
        half: half_name(edge.half),
        span: edge.span,
        runs: edge
            .stretches
            .iter()
            .map(|s| (sheet::run(&loops, s.ring, s.piece, s.reversed), s.flat))
            .collect(),
        flat: edge.flat,
    };
    let edges = sheet.edges.iter().map(edge).collect();
    let darts = sheet
        .darts
        .iter()
        .map(|dart| CutDart {
            name: half_name(dart.half)
                .map_or_else(|| dart.name.clone(), |half| format!("{half}.{}", dart.name)),
            span: dart.span,
            legs: dart.legs.map(|(ring, piece, back)| sheet::run(&loops, ring, piece, back)),
        })
        .collect();
    CutPiece { side, edges, darts, notches: sheet.marks(), loops }
}
