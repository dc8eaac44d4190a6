//! Places on bodies, and where panels begin.

use super::Evaluator;
use super::fields::{Arg, Phrase};
use super::item::ItemId;
use super::panel::Draft;
use super::panel::edge::EdgeRef;
use super::value::Value;
use super::words::Kind;
use crate::diagnostic::{Diagnostic, Span};
use crate::garment::scene::{Placement, Side};
use crate::geometry::curve::Measured;
use crate::syntax::tree::Name;
use crate::units::Dimension;
use std::rc::Rc;

/// Places that every body has once.
const SINGLE: &[&str] = &[
    "waist",
    "hip",
    "bust",
    "chest",
    "underbust",
    "neck",
    "abdomen",
    "navel",
    "back_waist",
    "neck_front",
    "neck_back",
    "crotch",
    "head_top",
];

/// Places on both sides of a body, `left_knee` or `knee.left`.
const SIDED: &[&str] = &[
    "arm",
    "leg",
    "shoulder",
    "neck_side",
    "bust_point",
    "armhole",
    "underarm",
    "upper_arm",
    "elbow",
    "wrist",
    "thigh",
    "knee",
    "calf",
    "ankle",
    "hip",
];

/// Distance from the skin where none is said, m.
const GAP: f64 = 0.03;

/// A place on a body as a garment asks for it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Landmark {
    /// The wearer.
    pub wearer: ItemId,
    /// Its name as the body knows it; without a side where it goes with a pair.
    pub name: String,
}

impl Landmark {
    /// The name for one piece of a pair.
    fn on(&self, side: Option<&str>) -> String {
        match side {
            Some(side @ ("left" | "right")) if SIDED.contains(&self.name.as_str()) => {
                if self.name == "hip" { self.name.clone() } else { format!("{}.{side}", self.name) }
            }
            _ => self.name.clone(),
        }
    }

    /// Whether it stands for two places.
    fn is_pair(&self) -> bool {
        self.name != "hip" && SIDED.contains(&self.name.as_str())
    }
}

/// Names of the places of every body, as a text writes them.
pub(super) fn places() -> impl Iterator<Item = String> {
    let single = SINGLE.iter().map(|place| (*place).to_owned());
    let sided = SIDED.iter().filter(|place| **place != "hip").flat_map(|place| {
        ["", "left_", "right_"].into_iter().map(move |side| format!("{side}{place}"))
    });
    single.chain(sided)
}

impl<'t> Evaluator<'t> {
    /// `lady.waist`: a measure or a place.
    pub(super) fn measure(&mut self, wearer: ItemId, name: &'t Name) -> Value {
        let sided = |text: &str| {
            ["left", "right"].into_iter().find_map(|side| {
                let place = text.strip_prefix(side)?.strip_prefix('_')?;
                SIDED.contains(&place).then(|| format!("{place}.{side}"))
            })
        };
        if let Some(name) = sided(&name.text) {
            return Value::Measure { wearer, name };
        }
        let Some(request) = self.wearer(wearer, name.span) else { return Value::Poison };
        let text = name.text.as_str();
        let other_figure = |place: &str| {
            // Each figure names its own measures: a bust is not a chest.
            matches!(place, "bust" | "chest" | "underbust" | "bust_point")
                && !request.measures.contains_key(if place == "bust_point" {
                    "bust"
                } else {
                    place
                })
        };
        let is_place = SINGLE.contains(&text) || SIDED.contains(&text);
        if request.measures.contains_key(text) || (is_place && !other_figure(text)) {
            return Value::Measure { wearer, name: text.to_owned() };
        }
        let mut known: Vec<&str> = request.measures.keys().map(String::as_str).collect();
        let others = SINGLE.iter().chain(SIDED).copied().filter(|place| !other_figure(place));
        for place in others {
            if !known.contains(&place) {
                known.push(place);
            }
        }
        let twin = match text {
            "bust" => Some("chest"),
            "chest" => Some("bust"),
            _ => None,
        };
        let label = match twin.filter(|twin| request.measures.contains_key(*twin)) {
            Some(twin) => format!("did you mean `{twin}`?"),
            None => self.meant(text, known.iter().copied()),
        };
        self.tell(
            Diagnostic::new("E0204", format!("`{}` has no measure `{text}`", request.name))
                .at(name.span, label)
                .help(format!("it has {}", known.join(", "))),
        );
        Value::Poison
    }

    /// `lady.knee.left`
    pub(super) fn measure_member(&mut self, wearer: ItemId, place: &str, name: &'t Name) -> Value {
        if SIDED.contains(&place) && matches!(name.text.as_str(), "left" | "right") {
            return Value::Measure { wearer, name: format!("{place}.{}", name.text) };
        }
        let sides: &[&str] = if SIDED.contains(&place) { &["left", "right"] } else { &[] };
        self.no_member(&format!("the place `{place}`"), name, sides.iter().copied())
    }

    /// The length of a measure, m; a place that has none is told.
    pub(super) fn measure_length(&mut self, wearer: ItemId, name: &str, at: Span) -> Option<f64> {
        let request = self.wearer(wearer, at)?;
        if let Some(length) = request.measures.get(name) {
            return Some(*length);
        }
        let near: Vec<&str> = request
            .measures
            .keys()
            .map(String::as_str)
            .filter(|key| key.contains(name) || name.contains(*key))
            .collect();
        let mut told =
            Diagnostic::new("E0304", format!("`{}.{name}` is a place, not a length", request.name))
                .at(at, "a length is wanted");
        told = told.help(if near.is_empty() {
            let all: Vec<&str> = request.measures.keys().map(String::as_str).collect();
            format!("lengths of `{}` are {}", request.name, all.join(", "))
        } else {
            format!("lengths near it: {}", near.join(", "))
        });
        self.tell(told);
        None
    }

    /// A value where a place on a body is wanted.
    pub(super) fn landmark(&mut self, arg: Arg<'t>) -> Option<Landmark> {
        match self.eval(arg.expr, arg.scope) {
            Value::Poison => None,
            Value::Measure { wearer, name } => {
                let base = name.split('.').next().unwrap_or("");
                if SINGLE.contains(&base) || SIDED.contains(&base) {
                    return Some(Landmark { wearer, name });
                }
                let text = self.snippet(arg.expr.span).to_owned();
                self.tell(
                    Diagnostic::new("E0304", format!("`{text}` is a length, not a place"))
                        .at(arg.expr.span, "a place on the body is wanted")
                        .help(format!("places are {}, {}", SINGLE.join(", "), SIDED.join(", "))),
                );
                None
            }
            Value::Item(id) if self.item(id).kind == Kind::Wearer => {
                let name = self.item(id).name.clone();
                self.tell(
                    Diagnostic::new("E0304", format!("`{name}` is a wearer"))
                        .at(arg.expr.span, "a place on a body is wanted")
                        .help(format!("such as `{name}.waist`")),
                );
                None
            }
            other => {
                self.wrong(&other, "a place on a body", arg.expr.span);
                None
            }
        }
    }

    /// The panels named where a piece is placed, each with the edge that comes to the place.
    pub(super) fn placed_pieces(
        &mut self,
        arg: Arg<'t>,
    ) -> Option<Vec<(ItemId, Vec<usize>, Option<EdgeRef>)>> {
        let value = self.eval(arg.expr, arg.scope);
        let all = |draft: &Draft| (0..draft.pieces.len()).collect::<Vec<_>>();
        let is_panel =
            |ev: &Self, id: ItemId| matches!(ev.item(id).kind, Kind::Panel | Kind::Cloth);
        match value {
            Value::Poison => None,
            Value::Item(id) if is_panel(self, id) => {
                let draft = self.panel(id, arg.expr.span)?;
                Some(vec![(id, all(&draft), None)])
            }
            Value::Items(ids) if ids.iter().all(|id| is_panel(self, *id)) => {
                let mut pieces = Vec::new();
                for id in ids {
                    let draft = self.panel(id, arg.expr.span)?;
                    pieces.push((id, all(&draft), None));
                }
                Some(pieces)
            }
            Value::Half(id, which) => {
                let draft = self.panel(id, arg.expr.span)?;
                let chosen: Vec<usize> = draft
                    .pieces
                    .iter()
                    .enumerate()
                    .filter(|(_, piece)| {
                        piece.side.as_ref().is_some_and(|side| which.0.contains(side))
                    })
                    .map(|(number, _)| number)
                    .collect();
                let chosen = if chosen.is_empty() { all(&draft) } else { chosen };
                Some(vec![(id, chosen, None)])
            }
            Value::Edges(edges) => {
                let edge = edges.into_iter().next()?;
                let mut pieces: Vec<usize> =
                    edge.find().into_iter().map(|found| found.piece).collect();
                pieces.dedup();
                Some(vec![(edge.draft.item, pieces, Some(edge))])
            }
            other => {
                self.wrong(&other, "a panel or an edge", arg.expr.span);
                None
            }
        }
    }

    /// One `place` line: which pieces begin where.
    pub(super) fn placements(
        &mut self,
        phrase: &Phrase<'t>,
        body_number: &dyn Fn(ItemId) -> Option<usize>,
    ) -> Option<Vec<((ItemId, usize), Placement)>> {
        // All values are looked at, so that one run tells of all.
        let pieces = phrase.arg(0).and_then(|arg| self.placed_pieces(arg));
        let gap = match phrase.value("gap") {
            Some(arg) => self.within_range(arg, Dimension::LENGTH, 0.0, 2.0),
            None => Some(GAP),
        };
        let turn = match phrase.value("turn") {
            Some(arg) => self.turns_in_space(arg).map(|turn| Some((turn, arg.expr.span))),
            None => Some(None),
        };
        let level = match phrase.value("level") {
            Some(arg) => self.landmark(arg).map(Some),
            None => Some(None),
        };
        let mut out = Vec::new();
        if let Some(at) = phrase.value("at") {
            let at = self.place_in_space(at);
            let (pieces, at, turn) = (pieces?, at?, turn?);
            for (id, numbers, _) in pieces {
                let turn = turn.map_or([0.0; 3], |(turn, _)| turn);
                for number in numbers {
                    out.push(((id, number), Placement::Flat { at, turn }));
                }
            }
            return Some(out);
        }
        if let Some(Some((_, span))) = turn {
            self.tell(
                Diagnostic::new("E0207", "`turn` goes with `at`")
                    .at(span, "here the body gives the direction"),
            );
            return None;
        }
        let sides = [
            ("before", Side::Before),
            ("behind", Side::Behind),
            ("around", Side::Around),
            ("beside", Side::Beside),
        ];
        let (arg, side) =
            sides.into_iter().find_map(|(word, side)| phrase.value(word).map(|arg| (arg, side)))?;
        let mark = self.landmark(arg);
        let (pieces, gap, level, mark) = (pieces?, gap?, level?, mark?);
        let Some(body) = body_number(mark.wearer) else {
            self.tell(
                Diagnostic::new("E0304", "this wearer stands in another garment")
                    .at(arg.expr.span, "here"),
            );
            return None;
        };
        for (id, numbers, edge) in pieces {
            let draft = self.panel(id, arg.expr.span)?;
            for number in numbers {
                let side_name = draft.pieces.get(number).and_then(|piece| piece.side.clone());
                if mark.is_pair() && !matches!(side_name.as_deref(), Some("left" | "right")) {
                    let name = mark.name.clone();
                    self.tell(
                        Diagnostic::new(
                            "E0304",
                            format!("`{name}` is on both sides, `{}` is one piece", draft.name),
                        )
                        .at(arg.expr.span, "which side?")
                        .help(format!(
                            "write `left_{name}` or `right_{name}`, or cut the piece with `pair as left, right`"
                        )),
                    );
                    return None;
                }
                out.push((
                    (id, number),
                    Placement::Wrapped {
                        body,
                        landmark: mark.on(side_name.as_deref()),
                        level: level.as_ref().map(|level| level.on(side_name.as_deref())),
                        side,
                        anchor: if mark.name == "neck"
                            && matches!(side, Side::Before | Side::Behind)
                        {
                            // It hangs from the side of the neck, however deep it is in the middle.
                            top(&draft, number, edge.as_ref())
                        } else {
                            middle(&draft, number, edge.as_ref())
                        },
                        gap,
                    },
                ));
            }
        }
        Some(out)
    }
}

/// The y of the drawing where the named edge comes nearest to the line x = 0; without an edge the
/// top of the piece.
fn middle(draft: &Rc<Draft>, number: usize, edge: Option<&EdgeRef>) -> f64 {
    let Some(edge) = edge else { return top(draft, number, None) };
    let nearest = walk(draft, number, edge).fold((f64::INFINITY, 0.0), |best, p| {
        if p.x.abs() < best.0 - 1e-9 { (p.x.abs(), p.y) } else { best }
    });
    nearest.1
}

/// The highest y of the drawing that the named edge, or the whole piece, reaches.
fn top(draft: &Rc<Draft>, number: usize, edge: Option<&EdgeRef>) -> f64 {
    let Some(edge) = edge else {
        let Some(piece) = draft.pieces.get(number) else { return 0.0 };
        let points = piece.loops.first().map_or(&[][..], |ring| &ring.pieces);
        return points
            .iter()
            .map(|piece| kurbo::Shape::bounding_box(&piece.path).y1)
            .fold(f64::NEG_INFINITY, f64::max);
    };
    let top = walk(draft, number, edge).map(|p| p.y).fold(f64::NEG_INFINITY, f64::max);
    if top.is_finite() { top } else { 0.0 }
}

/// Points along an edge of a piece.
fn walk(draft: &Rc<Draft>, number: usize, edge: &EdgeRef) -> impl Iterator<Item = kurbo::Point> {
    let mut points = Vec::new();
    let Some(piece) = draft.pieces.get(number) else { return points.into_iter() };
    for found in edge.find().iter().filter(|found| found.piece == number) {
        for run in edge.runs(found) {
            let Some(path) = piece.path(&run) else { continue };
            let line = Measured::new(path);
            let arc = |i: u32| run.from + (run.to - run.from) * f64::from(i) / 64.0;
            points.extend((0..=64).map(|i| line.at(arc(i))));
        }
    }
    points.into_iter()
}
