//! Seams: which edge runs against which, and whether their lengths agree.
//!
//! Nobody writes the direction of a seam. Walked along a sewing line, the cloth of one side lies
//! to the left and the cloth of the other to the right, for then the face of one runs on into
//! the face of the other (inside layers and `reversed` turn this round). A row of edges is
//! walked in the order in which it is named; whether its cloth then lies to the left follows
//! from how its edges join, on the panel or through other seams. Where that leaves both ways
//! open (a ring of two), the other side of the seam decides, so that the first named meets the
//! first named; if then what is high in one drawing would meet what is low in the other, the
//! seam is twisted.

use super::Evaluator;
use super::fields::{Arg, Phrase, bare};
use super::garment::Making;
use super::notch;
use super::panel::edge::EdgeRef;
use super::row::{Corner, Corners, Element, Line, length, rise, same, share};
use super::value::Value;
use crate::diagnostic::{Diagnostic, Span};
use crate::garment::panel::Run;
use crate::garment::seam::{PanelRun, Seam, SeamKind};
use crate::units::{self, Dimension};
use std::collections::{BTreeMap, BTreeSet};

/// Lengths may differ by so much, m, or by this share of the longer one.
const TOLERANCE: (f64, f64) = (1e-3, 2e-3);

/// Rows of a ring that bend by so much, m, one upwards and one downwards, are twisted.
const TWIST: f64 = 0.02;

/// Whether a seam brings the two ends of a mouth of an edge together.
fn closes_a_mouth(seam: &Seam) -> bool {
    matches!(seam.kind, SeamKind::Dart | SeamKind::Pleat)
}

/// A seam of two sides that is yet to be directed.
struct Pending<'p, 't> {
    phrase: &'p Phrase<'t>,
    /// Whether side a was sewn by an earlier arm of the same statement.
    again: bool,
    spans: (Span, Span),
    a: Vec<Element>,
    b: Vec<Element>,
}

/// The ways in which a row can be walked: with its cloth to the left, and to the right.
fn ways(row: &[Element], corners: &Corners) -> (bool, bool) {
    match row {
        [_] => (true, true),
        row => (corners.chains(row, true), corners.chains(row, false)),
    }
}

/// The corners that meet in a seam whose rows join one way only.
fn links(seam: &Pending<'_, '_>, corners: &Corners) -> Option<[(Corner, Corner); 2]> {
    let turned = seam.phrase.says("reversed");
    let (a, b) = (ways(&seam.a, corners), ways(&seam.b, corners));
    let b = if turned { b } else { (b.1, b.0) };
    let left = match (a.0 && b.0, a.1 && b.1) {
        (true, false) => true,
        (false, true) => false,
        _ => return None,
    };
    let ends = |row: &[Element], left: bool| {
        Some((row.first()?.walked(left).0, row.last()?.walked(left).1))
    };
    let ((start, end), (from, to)) = (ends(&seam.a, left)?, ends(&seam.b, left == turned)?);
    Some([(start, from), (end, to)])
}

impl<'t> Evaluator<'t> {
    /// Makes the seams of a garment; false if one of them is wrong.
    pub(super) fn sew(&mut self, phrases: &[Phrase<'t>], making: &mut Making) -> bool {
        let mut pending: Vec<Pending<'_, 't>> = Vec::new();
        let mut sound = true;
        for phrase in phrases {
            self.within = Some((phrase.scope, self.waiting.len()));
            if phrase.head.is_empty() {
                self.tell(
                    Diagnostic::new("E0208", "`seam` wants edges")
                        .at(phrase.span, "missing here")
                        .help(phrase.word.usage()),
                );
                sound = false;
                continue;
            }
            if let Some(within) = phrase.clause("within") {
                self.tell(
                    Diagnostic::new("E0207", "`within` goes with `near`").at(within.span, "here"),
                );
                sound = false;
                continue;
            }
            let lines: Option<Vec<Line>> =
                phrase.args().into_iter().map(|arg| self.line_of(arg, making)).collect();
            match lines {
                Some(lines) => self.arms(phrase, &lines, &mut pending),
                None => sound = false,
            }
        }
        // Seams of single edges know their direction; they join the corners of rows.
        let mut corners = Corners::default();
        for dart in making.garment.seams.iter().filter(|seam| closes_a_mouth(seam)) {
            let mouth = |runs: &[PanelRun]| -> Option<Corner> {
                let first = runs.first()?;
                let panel = making.garment.panels.get(first.panel)?;
                let piece = panel.loops.get(first.run.ring)?.pieces.get(first.run.piece)?;
                Some((first.panel, crate::geometry::curve::at(&piece.path, first.run.from).0))
            };
            corners.links.extend(mouth(&dart.a).zip(mouth(&dart.b)));
        }
        for seam in &pending {
            if let ([a], [b]) = (seam.a.as_slice(), seam.b.as_slice()) {
                let (start, end) = a.walked(true);
                let (from, to) = b.walked(seam.phrase.says("reversed"));
                corners.links.extend([(start, from), (end, to)]);
            }
        }
        // Rows that join one way only know theirs then, and join the corners of further rows.
        let mut rows: Vec<&Pending<'_, 't>> =
            pending.iter().filter(|seam| seam.a.len() > 1 || seam.b.len() > 1).collect();
        loop {
            let before = rows.len();
            rows.retain(|seam| match links(seam, &corners) {
                Some(more) => {
                    corners.links.extend(more);
                    false
                }
                None => true,
            });
            if rows.len() == before {
                break;
            }
        }
        let mut sewn: Vec<(PanelRun, Span)> = Vec::new();
        let mut wrong: Vec<(Span, Span)> = Vec::new();
        for seam in pending {
            // What is wrong with the left is not told again of the right.
            let spans = seam.spans;
            self.within = Some((seam.phrase.scope, self.waiting.len()));
            if !wrong.contains(&spans)
                && self.finish_seam(seam, &corners, making, &mut sewn).is_none()
            {
                wrong.push(spans);
            }
        }
        self.sewn_twice(&sewn, making);
        let ordered = self.seams_lie_in_order(making);
        sound && ordered && wrong.is_empty()
    }

    /// The edges named on one side of a seam.
    fn line_of(&mut self, arg: Arg<'t>, making: &Making) -> Option<Line> {
        let edges = match self.eval(arg.expr, arg.scope) {
            Value::Poison => return None,
            Value::Edges(edges) => edges,
            other => {
                self.wrong(&other, "an edge", arg.expr.span);
                return None;
            }
        };
        if !self.all_on_rim(&edges, arg) {
            return None;
        }
        let mut elements = Vec::new();
        for edge in edges {
            let mut alternatives = Vec::new();
            for found in edge.find() {
                let panel = *making.numbers.get(&(edge.draft.item, found.piece))?;
                let runs = edge.runs(&found);
                let piece = edge.draft.pieces.get(found.piece)?;
                let ends = piece.ends(&runs)?;
                let first = runs.first()?;
                alternatives.push(Element {
                    panel,
                    length: runs.iter().map(Run::length).sum(),
                    left: (first.to > first.from) != edge.draft.inside,
                    ends,
                    tag: (!found.tag.is_empty()).then(|| found.tag.join(".")),
                    written: edge.written(&found),
                    edge: edge.clone(),
                    runs,
                });
            }
            if alternatives.is_empty() {
                return None;
            }
            elements.push(alternatives);
        }
        Some(Line { span: arg.expr.span, elements })
    }

    /// `A -> B -> C`: each further edge is paired with the first; edges of which a half was not
    /// said make one seam for each half.
    fn arms<'p>(
        &mut self,
        phrase: &'p Phrase<'t>,
        lines: &[Line],
        pending: &mut Vec<Pending<'p, 't>>,
    ) {
        let mut tags: Vec<String> = Vec::new();
        let all = lines.iter().flat_map(|line| &line.elements);
        for alternatives in all.filter(|alternatives| alternatives.len() > 1) {
            let own: Vec<String> = alternatives.iter().filter_map(|e| e.tag.clone()).collect();
            if tags.is_empty() {
                tags = own;
            } else if own.iter().any(|tag| !tags.contains(tag)) || own.len() != tags.len() {
                let first = lines.first().map_or(phrase.span, |line| line.span);
                self.tell(
                    Diagnostic::new("E0505", "which halves are sewn together?")
                        .at(first, format!("here are {}", tags.join(", ")))
                        .at(phrase.span, format!("and here {}", own.join(", ")))
                        .help("name the halves on both sides"),
                );
                return;
            }
        }
        let choices: Vec<Option<String>> =
            if tags.is_empty() { vec![None] } else { tags.into_iter().map(Some).collect() };
        let Some((first, others)) = lines.split_first() else { return };
        for tag in choices {
            let pick = |line: &Line| -> Vec<Element> {
                line.elements
                    .iter()
                    .filter_map(|alternatives| match alternatives.as_slice() {
                        [only] => Some(only.clone()),
                        many => many.iter().find(|element| element.tag == tag).cloned(),
                    })
                    .collect()
            };
            for (number, other) in others.iter().enumerate() {
                pending.push(Pending {
                    phrase,
                    again: number > 0,
                    spans: (first.span, other.span),
                    a: pick(first),
                    b: pick(other),
                });
            }
        }
    }

    fn finish_seam(
        &mut self,
        seam: Pending<'_, 't>,
        corners: &Corners,
        making: &mut Making,
        sewn: &mut Vec<(PanelRun, Span)>,
    ) -> Option<()> {
        let a_left = self.direction(&seam, corners)?;
        let b_left = a_left == seam.phrase.says("reversed");
        if !self.lengths_agree(&seam) {
            return None;
        }
        let rows = |row: &[Element], left: bool| -> Vec<PanelRun> {
            row.iter().flat_map(|element| element.runs(left)).collect()
        };
        let (a, b) = (rows(&seam.a, a_left), rows(&seam.b, b_left));
        let names = |row: &[Element]| {
            row.iter().map(|element| element.written.as_str()).collect::<Vec<_>>().join(" + ")
        };
        let name = format!("{} -> {}", names(&seam.a), names(&seam.b));
        let parts = self.opened_parts(&seam, a_left)?;
        let notches = match seam.phrase.value("notches") {
            Some(arg) => Some(self.whole_number(arg, 0, 50)? as u32),
            None => None,
        };
        for (from, to, kind) in parts {
            let (a, b) = (share(&a, from, to), share(&b, from, to));
            if a.is_empty() || b.is_empty() {
                continue;
            }
            if !seam.again {
                sewn.extend(a.iter().map(|run| (*run, seam.spans.0)));
            }
            sewn.extend(b.iter().map(|run| (*run, seam.spans.1)));
            let made = Seam { name: name.clone(), span: seam.phrase.span, kind, a, b };
            notch::mark_seam(&made, notches, making);
            making.garment.seams.push(made);
        }
        Some(())
    }

    /// Whether the cloth of side a lies to the left when it is walked as named.
    fn direction(&mut self, seam: &Pending<'_, 't>, corners: &Corners) -> Option<bool> {
        let ways = |row: &[Element]| ways(row, corners);
        for (row, span) in [(&seam.a, seam.spans.0), (&seam.b, seam.spans.1)] {
            if ways(row) == (false, false) {
                let gap = row
                    .windows(2)
                    .find(|pair| {
                        ![true, false].into_iter().any(|left| {
                            corners.joined(pair[0].walked(left).1, pair[1].walked(left).0)
                        })
                    })
                    .map(|pair| (pair[0].written.clone(), pair[1].written.clone()));
                let message = match gap {
                    Some((a, b)) => format!("`{a}` and `{b}` do not join end to end"),
                    None => "these edges do not follow each other one way round".to_owned(),
                };
                self.tell(
                    Diagnostic::new("E0504", message).at(span, "in this row").help(
                        "name edges in the order in which they follow each other, on the piece or through seams of single edges",
                    ),
                );
                return None;
            }
        }
        let turned = seam.phrase.says("reversed");
        let (a, b) = (ways(&seam.a), ways(&seam.b));
        // Side b as it asks side a to be.
        let b = if turned { b } else { (b.1, b.0) };
        let found = match (a.0 && b.0, a.1 && b.1) {
            (true, _) => Some(true),
            (false, true) => Some(false),
            (false, false) => None,
        };
        // A ring of two joins either way; the side seam and the shoulder tell them apart by
        // height alone.
        let upright = found.is_none_or(|left| {
            let ring = a == (true, true) || b == (true, true);
            let (a, b) = (rise(&seam.a, left), rise(&seam.b, left == turned));
            !ring || a * b > -TWIST * TWIST || a.abs() < TWIST || b.abs() < TWIST
        });
        match found {
            Some(left) if upright => Some(left),
            _ => {
                let (first, last) = (seam.a.first()?, seam.b.last()?);
                self.tell(
                    Diagnostic::new(
                        "E0502",
                        format!(
                            "this seam would twist: with both faces outside, `{}` meets `{}`",
                            first.written, last.written
                        ),
                    )
                    .at(seam.spans.0, "this row")
                    .at(seam.spans.1, "runs against this one")
                    .help("exchange the names of `pair` or the order of one row; if a piece is meant to be inside out, add `reversed` to the seam"),
                );
                None
            }
        }
    }

    fn lengths_agree(&mut self, seam: &Pending<'_, 't>) -> bool {
        let (a, b) = (length(&seam.a), length(&seam.b));
        self.note_seam(seam.phrase.span, a, b);
        let (long, short) = (a.max(b), a.min(b));
        let tolerance = TOLERANCE.0.max(TOLERANCE.1 * long);
        let phrase = seam.phrase;
        let allowed = if let Some(arg) = phrase.value("ease") {
            self.within_range(arg, Dimension::LENGTH, 0.0, 10.0).map(|ease| short + ease)
        } else if let Some(arg) = phrase.value("gathered") {
            self.within_range(arg, Dimension::NUMBER, 1.0, 20.0).map(|times| short * times)
        } else if let Some(arg) = phrase.value("stretched") {
            self.within_range(arg, Dimension::NUMBER, 0.0, 5.0).map(|share| short * (1.0 + share))
        } else {
            Some(short)
        };
        let Some(allowed) = allowed else { return false };
        if long <= allowed + tolerance {
            return true;
        }
        let given = allowed - short;
        let message = if given > 0.0 {
            format!(
                "these edges are sewn together but differ by {}; {} are allowed",
                units::length(long - short),
                units::length(given + tolerance)
            )
        } else {
            format!(
                "these edges are sewn together but differ by {}; {} are allowed",
                units::length(long - short),
                units::length(tolerance)
            )
        };
        // Whole millimetres upwards; 2 cm stay 2 cm though their last bit is too much.
        let ease = libm::ceil((long - short) * 1e3 - 1e-6);
        let follow = match (seam.a.as_slice(), seam.b.as_slice()) {
            ([a], [b]) => format!(
                "let one follow the other: `fit NAME in LOW..HIGH until {}.length = {}.length`; ",
                a.edge.edge, b.written
            ),
            _ => "let one follow the other; ".to_owned(),
        };
        self.tell(
            Diagnostic::new("E0501", message)
                .at(seam.spans.0, units::length(a))
                .at(seam.spans.1, units::length(b))
                .help(format!(
                    "{follow}or have it eased in: `ease {}`",
                    if ease >= 10.0 {
                        format!("{}cm", units::trimmed(ease / 10.0, 1))
                    } else {
                        format!("{ease}mm")
                    }
                )),
        );
        false
    }

    /// Shares of the seam's length with what each of them is: `open` and `zip`.
    fn opened_parts(
        &mut self,
        seam: &Pending<'_, 't>,
        a_left: bool,
    ) -> Option<Vec<(f64, f64, SeamKind)>> {
        let phrase = seam.phrase;
        let said = phrase.value("open").map(|arg| (arg, true));
        let Some((arg, open)) = said.or(phrase.value("zip").map(|arg| (arg, false))) else {
            if let Some(from) = phrase.clause("from") {
                self.tell(
                    Diagnostic::new("E0207", "`from` goes with `open` or `zip`")
                        .at(from.span, "here"),
                );
                return None;
            }
            return Some(vec![(0.0, 1.0, SeamKind::Plain)]);
        };
        let whole = length(&seam.a);
        let quantity = self.quantity_of(arg, &[Dimension::LENGTH, Dimension::NUMBER])?;
        let part =
            if quantity.dimension.is_number() { quantity.value } else { quantity.value / whole };
        if !(0.0..=1.0 + 1e-9).contains(&part) {
            self.tell(
                Diagnostic::new("E0303", format!("this seam is {} long", units::length(whole)))
                    .at(arg.expr.span, "it cannot be open any further")
                    .at(seam.spans.0, "the seam"),
            );
            return None;
        }
        let part = part.min(1.0);
        let from_start = match phrase.value("from") {
            Some(from) => self.from_start(seam, a_left, from)?,
            None => true,
        };
        let (inner, rest) = if from_start {
            ((0.0, part), (part, 1.0))
        } else {
            ((1.0 - part, 1.0), (0.0, 1.0 - part))
        };
        let mut parts = Vec::new();
        if !open && inner.1 - inner.0 > 1e-9 {
            parts.push((inner.0, inner.1, SeamKind::Zip));
        }
        if rest.1 - rest.0 > 1e-9 {
            parts.push((rest.0, rest.1, SeamKind::Plain));
        }
        parts.sort_by(|a, b| a.0.total_cmp(&b.0));
        Some(parts)
    }

    /// Whether the edge behind `from` touches the start of side a as it is walked.
    fn from_start(&mut self, seam: &Pending<'_, 't>, a_left: bool, from: Arg<'t>) -> Option<bool> {
        let (first, last) = (seam.a.first()?, seam.a.last()?);
        let (start, end) = (first.walked(a_left).0, last.walked(a_left).1);
        let name = bare(from.expr);
        let touching = |element: &Element, corner: Corner, ev: &mut Self| -> Option<bool> {
            let neighbour = match name {
                Some(name) if element.edge.draft.edge_names().contains(&name.text.as_str()) => {
                    vec![EdgeRef {
                        edge: name.text.clone(),
                        part: None,
                        which: Default::default(),
                        draft: element.edge.draft.clone(),
                    }]
                }
                Some(_) => return Some(false),
                None => match ev.eval(from.expr, from.scope) {
                    Value::Edges(edges) => edges,
                    Value::Poison => return None,
                    other => {
                        ev.wrong(&other, "an edge", from.expr.span);
                        return None;
                    }
                },
            };
            Some(neighbour.iter().any(|edge| {
                edge.find().iter().any(|found| {
                    let ends = edge
                        .draft
                        .pieces
                        .get(found.piece)
                        .and_then(|piece| piece.ends(&edge.runs(found)));
                    ends.is_some_and(|(p, q)| {
                        [p, q].into_iter().any(|p| same((corner.0, p), corner))
                    }) && edge.draft.item == element.edge.draft.item
                })
            }))
        };
        if touching(first, start, self)? {
            return Some(true);
        }
        if touching(last, end, self)? {
            return Some(false);
        }
        let known = first.edge.draft.edge_names().join(", ");
        let text = self.snippet(from.expr.span).to_owned();
        self.tell(
            Diagnostic::new("E0504", format!("this seam does not end at `{text}`"))
                .at(from.expr.span, "neither its start nor its end touches this")
                .at(seam.spans.0, "the seam")
                .help(format!("edges of `{}` are {known}", first.edge.draft.name)),
        );
        None
    }

    /// Places of edges that two seams take (E0503), told once for each two seams.
    fn sewn_twice(&mut self, sewn: &[(PanelRun, Span)], making: &Making) {
        // The runs along each piece, by where they begin.
        let mut along: BTreeMap<(usize, usize, usize), Vec<(f64, f64, Span)>> = BTreeMap::new();
        for (PanelRun { panel, run }, at) in sewn {
            let (from, to) = (run.from.min(run.to), run.from.max(run.to));
            along.entry((*panel, run.ring, run.piece)).or_default().push((from, to, *at));
        }
        let mut told: BTreeSet<[Span; 2]> = BTreeSet::new();
        for ((panel, ring, piece), runs) in &mut along {
            runs.sort_by(|a, b| a.0.total_cmp(&b.0));
            let mut longest: Option<(f64, Span)> = None;
            for &(from, to, at) in runs.iter() {
                if let Some((end, before)) = longest
                    && end.min(to) - from >= 1e-5
                    && told.insert([at.min(before), at.max(before)])
                {
                    let on = (*panel, *ring, *piece);
                    self.tell_sewn_twice(on, end.min(to) - from, [at, before], making);
                }
                if longest.is_none_or(|(end, _)| to > end) {
                    longest = Some((to, at));
                }
            }
        }
    }

    fn tell_sewn_twice(
        &mut self,
        (panel, ring, piece): (usize, usize, usize),
        length: f64,
        at: [Span; 2],
        making: &Making,
    ) {
        let Some(panel) = making.garment.panels.get(panel) else { return };
        let edge = panel
            .edges
            .iter()
            .find(|edge| edge.runs.iter().any(|run| run.ring == ring && run.piece == piece))
            .map_or("", |edge| edge.name.as_str());
        let message =
            format!("`{}.{edge}` is sewn twice, along {}", panel.name, units::length(length));
        self.tell(
            Diagnostic::new("E0503", message)
                .at(at[0].max(at[1]), "here")
                .at(at[0].min(at[1]), "and here")
                .help("sew a part of the edge: `side[0cm..20cm]`"),
        );
    }
}
