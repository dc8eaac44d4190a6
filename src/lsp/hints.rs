//! Figures shown beside the text: lengths of edges, what seams take in, what a fit has found.

use super::describe;
use super::document::{Document, Known};
use super::outline::Outline;
use crate::evaluate::facts::{Edge, Sort};
use crate::units;
use gen_lsp_types::{InlayHint, InlayHintKind, Label, Range};
use std::collections::{BTreeMap, BTreeSet};

/// Panels of which a line's edge is shown.
const PANELS: usize = 3;

/// A side that is this much longer than the other, m, is eased in.
const EASED: f64 = 5e-5;

/// The hints within a range.
pub fn hints(document: &Document, known: &Known, within: Range) -> Vec<InlayHint> {
    let outline = document.outline();
    let text = &document.text;
    let shown = text.offset(within.start)..text.offset(within.end).saturating_add(1);
    let mut at: BTreeMap<usize, String> = BTreeMap::new();
    let mut edges: BTreeMap<usize, Vec<&Edge>> = BTreeMap::new();
    for (span, edge) in known.edges() {
        edges.entry(span.start as usize).or_default().push(edge);
    }
    for (start, edges) in edges {
        if let Some(end) = end_of(&outline, start).filter(|end| shown.contains(end)) {
            at.insert(end, lengths(&edges));
        }
    }
    for (span, seam) in known.seams() {
        let end = end_of(&outline, span.start as usize).filter(|end| shown.contains(end));
        let Some(end) = end else { continue };
        let said = at.entry(end).or_default();
        let one = sides(seam.a, seam.b);
        if !said.is_empty() && *said != one {
            *said = format!("{said}; {one}");
        } else {
            *said = one;
        }
    }
    let fits: BTreeSet<usize> = outline
        .statements
        .iter()
        .filter(|statement| statement.word.is_some_and(|word| word.name == "fit"))
        .filter_map(|statement| Some(outline.tokens.get(statement.head? + 1)?.start))
        .collect();
    for definition in &known.study.facts.definitions {
        let own = definition.span.file == known.study.root && definition.sort == Sort::Value;
        let Some(span) = known.now(definition.span).filter(|_| own) else { continue };
        let start = span.start as usize;
        let worth = describe::worth(&definition.worth);
        if fits.contains(&start)
            && !worth.is_empty()
            && let Some(end) = end_of(&outline, start).filter(|end| shown.contains(end))
        {
            at.insert(end, format!("{} = {worth}", definition.name));
        }
    }
    at.into_iter()
        .map(|(end, said)| InlayHint {
            position: text.position(end),
            label: Label::String(said),
            kind: Some(InlayHintKind::Type),
            text_edits: None,
            tooltip: None,
            padding_left: Some(true),
            padding_right: None,
            data: None,
        })
        .collect()
}

/// Where the statement ends whose tokens a byte lies in.
fn end_of(outline: &Outline, start: usize) -> Option<usize> {
    let number = outline.statements.partition_point(|statement| {
        outline.tokens.get(statement.tokens.start).is_some_and(|first| first.start <= start)
    });
    let statement = outline.statements.get(number.checked_sub(1)?)?;
    let last = outline.tokens.get(statement.tokens.end.checked_sub(1)?)?;
    (start <= last.end).then_some(last.end)
}

/// `bottom 40 cm, end 60 cm`, with their panels where several have a line.
fn lengths(edges: &[&Edge]) -> String {
    let one_name = edges.windows(2).all(|pair| pair[0].name == pair[1].name);
    let one_panel = edges.windows(2).all(|pair| pair[0].panel == pair[1].panel);
    let long = |edge: &Edge| units::length(edge.length);
    let same = edges.windows(2).all(|pair| long(pair[0]) == long(pair[1]));
    if one_name && (one_panel || same) {
        return edges.first().map_or(String::new(), |edge| long(edge));
    }
    let mut said: Vec<String> = edges
        .iter()
        .take(if one_panel { 8 } else { PANELS })
        .map(|edge| match (one_name, one_panel) {
            (true, _) => format!("{} {}", edge.panel, long(edge)),
            (false, true) => format!("{} {}", edge.name, long(edge)),
            (false, false) => format!("{}.{} {}", edge.panel, edge.name, long(edge)),
        })
        .collect();
    if said.len() < edges.len() {
        said.push("…".to_owned());
    }
    said.join(", ")
}

/// `59.7 cm on 59.4 cm, 2.8 mm eased in`
fn sides(a: f64, b: f64) -> String {
    if (a - b).abs() < EASED {
        return units::length(a);
    }
    let ease = units::length((a - b).abs());
    format!("{} on {}, {ease} taken in", units::length(a.max(b)), units::length(a.min(b)))
}
