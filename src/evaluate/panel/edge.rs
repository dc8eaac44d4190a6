//! References to edges and to places on panels: `front.left.side[0cm..9cm from hem]`.

use super::super::Evaluator;
use super::super::fields::{Arg, bare};
use super::super::item::ItemId;
use super::super::scope::{ScopeId, What};
use super::super::value::Value;
use super::super::words::Kind;
use super::sheet::{CORNER, Drawn};
use super::{CutEdge, CutPiece, Draft};
use crate::diagnostic::{Diagnostic, Span};
use crate::garment::panel::Run;
use crate::syntax::tree::{BinaryOp, Expr, ExprKind, Name};
use crate::units::{self, Dimension};
use kurbo::Point;
use std::rc::Rc;

/// Which half or copy is meant; empty for all.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Which(pub Vec<String>);

/// An edge of a panel, or a part of it.
#[derive(Clone, Debug, PartialEq)]
pub struct EdgeRef {
    /// The panel.
    pub draft: Rc<Draft>,
    /// Which half or copy.
    pub which: Which,
    /// The edge's name.
    pub edge: String,
    /// From where to where on the flat edge, m.
    pub part: Option<(f64, f64)>,
}

/// A place on a panel.
#[derive(Clone, Debug, PartialEq)]
pub struct Mark {
    /// The panel.
    pub draft: Rc<Draft>,
    /// Number of its piece.
    pub piece: usize,
    /// Place in its drawing, m.
    pub at: [f64; 2],
}

/// An edge found on a piece.
#[derive(Clone, Debug)]
pub struct Found {
    /// Number of the piece.
    pub piece: usize,
    /// Number of the edge on the piece, its marks counted on behind its edges.
    pub edge: usize,
    /// Names of the half and the copy that were not said.
    pub tag: Vec<String>,
}

impl EdgeRef {
    /// All edges that are meant.
    pub fn find(&self) -> Vec<Found> {
        let Which(names) = &self.which;
        let mut found = Vec::new();
        for (number, piece) in self.draft.pieces.iter().enumerate() {
            for (place, edge) in piece.edges.iter().chain(&piece.marks).enumerate() {
                if edge.name != self.edge {
                    continue;
                }
                let parts: Vec<&String> = piece.side.iter().chain(edge.half.iter()).collect();
                // Names that this edge could carry must be those that were said.
                let said = |name: &String| names.contains(name);
                let open: Vec<String> =
                    parts.iter().filter(|name| !said(name)).map(|n| (*n).clone()).collect();
                let excluded = (piece.side.as_ref().is_some_and(|side| !said(side))
                    && self.draft.pieces.iter().any(|p| p.side.as_ref().is_some_and(said)))
                    || (edge.half.as_ref().is_some_and(|half| !said(half))
                        && piece.halves().any(said));
                if !excluded {
                    found.push(Found { piece: number, edge: place, tag: open });
                }
            }
        }
        found
    }

    /// The edge as drawn, if all of it is meant.
    pub(super) fn as_drawn(&self) -> Option<&Drawn> {
        if self.part.is_some() {
            return None;
        }
        self.draft.drawn.iter().find(|drawn| drawn.name.as_deref() == Some(self.edge.as_str()))
    }

    /// The runs of one edge that was found, in the direction of drawing.
    pub fn runs(&self, found: &Found) -> Vec<Run> {
        let Some(edge) = self.cut_edge(found) else { return Vec::new() };
        let (from, to) = self.part.unwrap_or((0.0, edge.flat));
        edge.runs
            .iter()
            .filter_map(|(run, (start, end))| {
                let (a, b) = (from.max(*start), to.min(*end));
                if b - a < 1e-7 {
                    return None;
                }
                // An edge trued to a dart is a little longer or shorter than it was on the flat.
                let sense = (run.to - run.from) / (end - start);
                // Whole ends stay as they are to the last bit.
                let cut_from = if a <= *start { run.from } else { run.from + sense * (a - start) };
                let cut_to = if b >= *end { run.to } else { run.from + sense * (b - start) };
                Some(Run { from: cut_from, to: cut_to, ..*run })
            })
            .collect()
    }

    fn cut_edge(&self, found: &Found) -> Option<&CutEdge> {
        self.draft.pieces.get(found.piece)?.line(found.edge)
    }

    /// Whether it is a line inside the piece and no edge of it.
    pub fn is_mark(&self) -> bool {
        self.draft.mark_names().contains(&self.edge.as_str())
    }

    /// Its length as sewn, m; of the first of several halves.
    pub fn length(&self) -> f64 {
        self.find().first().map_or(0.0, |found| self.runs(found).iter().map(Run::length).sum())
    }

    /// Its length before darts, m.
    pub fn flat_length(&self) -> f64 {
        let whole = self
            .find()
            .first()
            .and_then(|found| self.cut_edge(found))
            .map_or(0.0, |edge| edge.flat);
        self.part.map_or(whole, |(from, to)| to - from)
    }

    /// A place on the flat edge as a point of the drawing; of the first of several halves.
    fn place(&self, flat: f64) -> Option<Mark> {
        let found = self.find().into_iter().next()?;
        let edge = self.cut_edge(&found)?;
        let piece = self.draft.pieces.get(found.piece)?;
        let at = flat + self.part.map_or(0.0, |(from, _)| from);
        let (run, (start, end)) = edge
            .runs
            .iter()
            .find(|(_, (_, end))| at <= *end + 1e-9)
            .or_else(|| edge.runs.last())?;
        let along = (at - start).clamp(0.0, end - start);
        let sense = (run.to - run.from) / (end - start);
        let point = piece.point(run, run.from + sense * along);
        Some(Mark { draft: self.draft.clone(), piece: found.piece, at: [point.x, point.y] })
    }

    /// How it is written: `front.left.side`.
    pub fn written(&self, found: &Found) -> String {
        let mut text = self.draft.name.clone();
        if let Some(piece) = self.draft.pieces.get(found.piece) {
            let half = piece.line(found.edge).and_then(|edge| edge.half.as_ref());
            for name in piece.side.iter().chain(half) {
                text.push('.');
                text.push_str(name);
            }
        }
        text.push('.');
        text.push_str(&self.edge);
        if let Some((from, to)) = self.part {
            text.push_str(&format!("[{}..{}]", units::length(from), units::length(to)));
        }
        text
    }
}

fn same(a: Point, b: Point) -> bool {
    libm::hypot(a.x - b.x, a.y - b.y) < CORNER
}

/// The corner in which two edges of a piece meet.
fn corner(piece: &CutPiece, a: &[Run], b: &[Run]) -> Option<Point> {
    let (a0, a1) = piece.ends(a)?;
    let (b0, b1) = piece.ends(b)?;
    [a0, a1].into_iter().find(|p| same(*p, b0) || same(*p, b1))
}

impl<'t> Evaluator<'t> {
    /// `front.side`, `sleeve.left`: a member of a panel or of a part of one.
    pub(in super::super) fn panel_member(
        &mut self,
        id: ItemId,
        which: Option<Which>,
        name: &'t Name,
        at: Span,
    ) -> Value {
        let Some(draft) = self.panel(id, at) else { return Value::Poison };
        let mut chosen = which.unwrap_or_default();
        if draft.parts().contains(&name.text.as_str()) {
            chosen.0.push(name.text.clone());
            return Value::Half(id, chosen);
        }
        if draft.has_line(&name.text) {
            let edge = name.text.clone();
            self.note_edge(name, draft.declared(&edge));
            return Value::Edges(vec![EdgeRef { draft, which: chosen, edge, part: None }]);
        }
        // Names of rows of edges and of lengths, given by `let` in the panel.
        let own = self.scopes.get(draft.scope.0).and_then(|scope| scope.names.get(&name.text));
        if let Some(&binding) = own {
            if matches!(self.bindings[binding.0].what, What::Let(_) | What::Given(_)) {
                self.note_use(name.span, binding);
                return match self.binding_value(binding, name.span) {
                    Value::Edges(edges) => Value::Edges(
                        edges
                            .into_iter()
                            .map(|edge| EdgeRef { which: chosen.clone(), ..edge })
                            .collect(),
                    ),
                    other => other,
                };
            }
        }
        let title = format!("`{}`", draft.name);
        let mut known = draft.edge_names();
        known.extend(draft.mark_names());
        known.extend(draft.parts());
        let label = self.meant(&name.text, known.iter().copied());
        self.tell(
            Diagnostic::new("E0204", format!("{title} has no edge `{}`", name.text))
                .at(name.span, label)
                .help(format!("it has {}", known.join(", "))),
        );
        Value::Poison
    }

    /// `gore[1..6].hem`: the edges of several panels, one after the other.
    pub(in super::super) fn members_of_panels(
        &mut self,
        ids: &[ItemId],
        name: &'t Name,
        at: Span,
    ) -> Value {
        let mut all = Vec::new();
        for id in ids {
            let found = match self.item(*id).kind {
                Kind::Part => self.part_member(*id, name, at),
                _ => self.panel_member(*id, None, name, at),
            };
            match found {
                Value::Edges(edges) => all.extend(edges),
                Value::Poison => return Value::Poison,
                other => return self.wrong(&other, "an edge", name.span),
            }
        }
        Value::Edges(all)
    }

    /// `front.(side + flare)`: names inside the brackets are members of what stands before.
    pub(in super::super) fn within(&mut self, base: &Value, inner: &'t Expr, at: Span) -> Value {
        if *base == Value::Poison || !self.step(1, inner.span) {
            return Value::Poison;
        }
        match &inner.kind {
            ExprKind::Group(group) => self.within(base, group, at),
            ExprKind::Path(_) => match bare(inner) {
                Some(name) => self.member(base.clone(), name, at),
                None => Value::Poison,
            },
            ExprKind::Member(before, name) => {
                let value = self.within(base, before, at);
                self.member(value, name, before.span)
            }
            ExprKind::Binary { op: BinaryOp::Plus, left, right, .. } => {
                let first = self.within(base, left, at);
                let second = self.within(base, right, at);
                match (first, second) {
                    (Value::Edges(mut first), Value::Edges(second)) => {
                        first.extend(second);
                        Value::Edges(first)
                    }
                    (Value::Poison, _) | (_, Value::Poison) => Value::Poison,
                    (Value::Edges(_), other) => self.wrong(&other, "an edge", right.span),
                    (other, _) => self.wrong(&other, "an edge", left.span),
                }
            }
            ExprKind::Unread => Value::Poison,
            _ => {
                self.tell(
                    Diagnostic::new(
                        "E0304",
                        "in these brackets stand names of edges, joined by `+`",
                    )
                    .at(inner.span, "not this")
                    .help("such as `front.(side + flare)`"),
                );
                Value::Poison
            }
        }
    }

    /// `edge.length`, `edge.start`, `s.outer.lower`
    pub(in super::super) fn edge_member(
        &mut self,
        edges: Vec<EdgeRef>,
        name: &'t Name,
        at: Span,
    ) -> Value {
        let flat: f64 = edges.iter().map(EdgeRef::flat_length).sum();
        match name.text.as_str() {
            "length" => Value::length(edges.iter().map(EdgeRef::length).sum()),
            "flat_length" => Value::length(flat),
            "start" => self.mark_at(&edges, 0.0),
            "middle" => self.mark_at(&edges, flat / 2.0),
            "end" => self.mark_at(&edges, flat),
            other => {
                // The corner with another edge.
                if let [edge] = edges.as_slice() {
                    let neighbour = EdgeRef {
                        edge: other.to_owned(),
                        part: None,
                        which: edge.which.clone(),
                        draft: edge.draft.clone(),
                    };
                    for found in edge.find() {
                        for next in neighbour.find().iter().filter(|n| n.piece == found.piece) {
                            let piece = edge.draft.pieces.get(found.piece);
                            let point = piece.and_then(|piece| {
                                corner(piece, &edge.runs(&found), &neighbour.runs(next))
                            });
                            if let Some(point) = point {
                                self.note_edge(name, edge.draft.declared(other));
                                return Value::Mark(Mark {
                                    draft: edge.draft.clone(),
                                    piece: found.piece,
                                    at: [point.x, point.y],
                                });
                            }
                        }
                    }
                }
                let title = self.snippet(at).to_owned();
                let known = ["length", "flat_length", "start", "middle", "end", "at(…)"];
                self.no_member(&format!("the edge `{title}`"), name, known.into_iter())
            }
        }
    }

    /// A place along a row of edges, counted on the flat.
    fn mark_at(&mut self, edges: &[EdgeRef], distance: f64) -> Value {
        let mut rest = distance;
        for (i, edge) in edges.iter().enumerate() {
            let length = edge.flat_length();
            if rest <= length + 1e-9 || i + 1 == edges.len() {
                return edge.place(rest.clamp(0.0, length)).map_or(Value::Poison, Value::Mark);
            }
            rest -= length;
        }
        Value::Poison
    }

    /// `edge.at(30%)`
    pub(in super::super) fn edge_at(&mut self, edges: &[EdgeRef], arg: Arg<'t>, at: Span) -> Value {
        let whole: f64 = edges.iter().map(EdgeRef::flat_length).sum();
        let Some(place) = self.along_flat(arg, whole, at) else { return Value::Poison };
        self.mark_at(edges, place)
    }

    /// A share or a length as a place on a flat edge of the given length.
    fn along_flat(&mut self, arg: Arg<'t>, whole: f64, at: Span) -> Option<f64> {
        let place = self.quantity_of(arg, &[Dimension::LENGTH, Dimension::NUMBER])?;
        let value = if place.dimension.is_number() { place.value * whole } else { place.value };
        if (-1e-9..=whole + 1e-9).contains(&value) {
            return Some(value.clamp(0.0, whole));
        }
        self.tell(
            Diagnostic::new("E0303", format!("this edge is {} long", units::length(whole)))
                .at(arg.expr.span, format!("{} lies beyond its ends", units::length(value)))
                .at(at, "the edge"),
        );
        None
    }

    /// `side[20cm..35cm]`, `side[0cm..9cm from hem]`
    pub(in super::super) fn edge_part(
        &mut self,
        edges: Vec<EdgeRef>,
        number: &'t Expr,
        from: Option<&'t Name>,
        scope: ScopeId,
        span: Span,
    ) -> Value {
        let [edge] = edges.as_slice() else {
            self.tell(
                Diagnostic::new("E0304", "only a single edge has parts")
                    .at(span, "this is a row of edges"),
            );
            return Value::Poison;
        };
        let ExprKind::Binary { op: BinaryOp::To, left, right, .. } = &number.kind else {
            if !matches!(number.kind, ExprKind::Unread) {
                self.tell(
                    Diagnostic::new("E0304", "a part goes from a place to a place")
                        .at(number.span, "here")
                        .help("such as `[20cm..35cm]` or `[0cm..50%]`"),
                );
            }
            return Value::Poison;
        };
        let whole = edge.flat_length();
        let a = self.along_flat(Arg { expr: left, scope, of: "[ ]" }, whole, span);
        let b = self.along_flat(Arg { expr: right, scope, of: "[ ]" }, whole, span);
        let (Some(mut a), Some(mut b)) = (a, b) else { return Value::Poison };
        if b - a < 1e-4 {
            self.tell(
                Diagnostic::new("E0303", "this part of the edge has no length")
                    .at(number.span, format!("{} to {}", units::length(a), units::length(b))),
            );
            return Value::Poison;
        }
        if let Some(name) = from {
            match self.touching_end(edge, name) {
                Some(true) => {}
                Some(false) => (a, b) = (whole - b, whole - a),
                None => return Value::Poison,
            }
        }
        let offset = edge.part.map_or(0.0, |(from, _)| from);
        let part = Some((a + offset, b + offset));
        Value::Edges(vec![EdgeRef { part, ..edge.clone() }])
    }

    /// Whether all of these run along the rim of their pieces; a mark that does not is told.
    pub(in super::super) fn all_on_rim(&mut self, edges: &[EdgeRef], arg: Arg<'t>) -> bool {
        let Some(mark) = edges.iter().find(|edge| edge.is_mark()) else { return true };
        let declared = mark.draft.declared(&mark.edge);
        let mut told = Diagnostic::new(
            "E0304",
            format!("`{}` is a line on `{}`; `{}` wants edges", mark.edge, mark.draft.name, arg.of),
        )
        .at(arg.expr.span, "here")
        .help(format!(
            "what is sewn on the face of a piece is a `patch`; `slit along {}` and `trim along {}` make edges of it",
            mark.edge, mark.edge
        ));
        for span in declared.into_iter().take(1) {
            told = told.at(span, "drawn here");
        }
        self.tell(told);
        false
    }

    /// Whether the start (true) or the end of an edge touches the edge of that name on its panel.
    pub(in super::super) fn touching_end(&mut self, edge: &EdgeRef, name: &Name) -> Option<bool> {
        let mut neighbour = EdgeRef { edge: name.text.clone(), part: None, ..edge.clone() };
        let mut others = neighbour.find();
        if others.is_empty() {
            neighbour.which = Which::default();
            others = neighbour.find();
        }
        if others.is_empty() {
            let title = format!("`{}`", edge.draft.name);
            let draft = edge.draft.clone();
            self.no_member(&title, name, draft.edge_names().into_iter());
            return None;
        }
        self.note_edge(name, edge.draft.declared(&name.text));
        let whole = EdgeRef { part: None, ..edge.clone() };
        for found in whole.find() {
            let Some(piece) = edge.draft.pieces.get(found.piece) else { continue };
            let Some((start, end)) = piece.ends(&whole.runs(&found)) else { continue };
            for other in others.iter().filter(|other| other.piece == found.piece) {
                let Some((p, q)) = piece.ends(&neighbour.runs(other)) else { continue };
                if same(start, p) || same(start, q) {
                    return Some(true);
                }
                if same(end, p) || same(end, q) {
                    return Some(false);
                }
            }
        }
        self.tell(
            Diagnostic::new("E0504", format!("`{}` and `{}` do not touch", edge.edge, name.text))
                .at(name.span, "counted from here"),
        );
        None
    }
}
