//! What may stand behind a point: edges of a panel, measures of a wearer, places of an edge.

use super::complete::Found;
use super::document::{Document, Known};
use super::names::{self, Given};
use super::outline::Outline;
use super::scan::Sort as Piece;
use crate::evaluate::facts::{Definition, Sort};
use crate::evaluate::words::Kind;
use gen_lsp_types::CompletionItemKind;

/// What may stand behind a point.
pub(super) fn members(
    document: &Document,
    known: Option<&Known>,
    outline: &Outline,
    dot: usize,
    found: &mut Found,
) {
    let text = &*document.text.text;
    let chain = chain(outline, text, dot);
    let Some((&root, rest)) = chain.split_first() else { return };
    let Some(token) = outline.tokens.get(root).copied() else { return };
    let name = outline.slice(text, root);
    let visible = names::visible(outline, text, token.start);
    let given = visible.iter().find(|given| given.name == name);
    let definition =
        known.and_then(|known| meaning(known, outline, given, (token.start, token.end), name));
    let mut of_panel: Vec<(String, &str, String)> = Vec::new();
    if let Some(definition) = definition {
        for member in &definition.members {
            of_panel.push((member.name.clone(), member.what, member.text.clone()));
        }
    }
    // A panel that cannot be cut still shows the names of its edges.
    let item = given.and_then(|given| outline.statements.get(given.statement)?.block);
    if of_panel.is_empty()
        && let Some(block) = item
    {
        let inside = outline.blocks.get(block).map(|block| block.span.clone()).unwrap_or_default();
        for given in names::visible(outline, text, inside.end) {
            if given.sort == Sort::Edge {
                of_panel.push((given.name.to_owned(), "edge", String::new()));
            }
        }
    }
    let is = |name: &str, what: &str| of_panel.iter().any(|(own, w, _)| own == name && *w == what);
    let names: Vec<&str> = rest.iter().map(|token| outline.slice(text, *token)).collect();
    let edge = given.is_some_and(|given| given.sort == Sort::Edge);
    let worth = definition.and_then(|d| d.worth.first()).map_or("", |worth| worth.text.as_str());
    match names.last().copied() {
        None if edge => edge_members(&[], found),
        None if worth.starts_with('(') => point_members(worth, found),
        None if of_panel.is_empty() => edge_members(&[], found),
        None => panel_members(&of_panel, found),
        Some(last) if is(last, "half") => {
            let edges: Vec<_> =
                of_panel.iter().filter(|(_, what, _)| *what == "edge").cloned().collect();
            panel_members(&edges, found);
        }
        Some(last) if is(last, "edge") => edge_members(&of_panel, found),
        Some("start" | "middle" | "end") => point_members("", found),
        Some(last) => {
            let sided = of_panel.iter().any(|(own, ..)| *own == format!("left_{last}"));
            if sided {
                for side in ["left", "right"] {
                    found.add(0, CompletionItemKind::Field, side, "", String::new());
                }
            } else if definition.is_none_or(|d| d.sort != Sort::Item(Kind::Wearer)) {
                edge_members(&[], found);
            }
        }
    }
}

fn panel_members(members: &[(String, &str, String)], found: &mut Found) {
    for (name, what, text) in members {
        let detail = if text.is_empty() { (*what).to_owned() } else { format!("{what}, {text}") };
        let (rank, kind) = match *what {
            "half" => (1, CompletionItemKind::Module),
            "place" => (1, CompletionItemKind::Reference),
            _ => (0, CompletionItemKind::Field),
        };
        found.add(rank, kind, name, &detail, String::new());
    }
}

fn edge_members(edges: &[(String, &str, String)], found: &mut Found) {
    for (name, about) in [
        ("length", "as sewn"),
        ("flat_length", "before darts"),
        ("start", "a place"),
        ("middle", "a place"),
        ("end", "a place"),
        ("at", "at(30%), a place"),
    ] {
        found.add(0, CompletionItemKind::Field, name, about, String::new());
    }
    for (name, what, _) in edges {
        if *what == "edge" {
            found.add(1, CompletionItemKind::Field, name, "the corner with it", String::new());
        }
    }
}

fn point_members(worth: &str, found: &mut Found) {
    let axes = if worth.matches(", ").count() == 2 { &["x", "y", "z"][..] } else { &["x", "y"] };
    for axis in axes {
        found.add(0, CompletionItemKind::Field, axis, "", String::new());
    }
}

/// What a name means: as it stands there, or as the name given in this text.
fn meaning<'k>(
    known: &'k Known,
    outline: &Outline,
    given: Option<&Given>,
    (start, end): (usize, usize),
    name: &str,
) -> Option<&'k Definition> {
    let own = given
        .and_then(|given| outline.tokens.get(given.token))
        .and_then(|token| known.definitions(token.start, token.end, name).into_iter().next());
    own.or_else(|| known.definitions(start, end, name).into_iter().next()).or_else(|| {
        // Brought in by `use`, in a line that is being written.
        let all = &known.study.facts.definitions;
        let found = |file: bool| {
            all.iter().find(|d| {
                d.name == name && !d.members.is_empty() && (d.span.file == known.study.root) == file
            })
        };
        found(true).or_else(|| found(false))
    })
}

/// The words of `front.left.side.` before its last point, from the first.
fn chain(outline: &Outline, text: &str, dot: usize) -> Vec<usize> {
    let mut found = Vec::new();
    let mut at = dot;
    while at > 0 && outline.slice(text, at) == "." {
        let mut before = at - 1;
        // `gore[2].hem`
        while matches!(outline.slice(text, before), "]" | ")") {
            let mut depth = 0_usize;
            loop {
                match outline.slice(text, before) {
                    "]" | ")" => depth += 1,
                    "[" | "(" => depth = depth.saturating_sub(1),
                    _ => {}
                }
                if depth == 0 || before == 0 {
                    break;
                }
                before -= 1;
            }
            let Some(next) = before.checked_sub(1) else { break };
            before = next;
        }
        if outline.tokens.get(before).is_some_and(|token| token.sort == Piece::Word) {
            found.push(before);
        }
        match before.checked_sub(1) {
            Some(next) => at = next,
            None => break,
        }
    }
    found.reverse();
    found
}
