//! What a document is made of: items, parameters, edges, in the order of the text.

use super::describe;
use super::document::Document;
use super::names::given;
use super::outline::Outline;
use crate::evaluate::facts::Sort;
use crate::evaluate::words::Kind;
use gen_lsp_types::{DocumentSymbol, SymbolKind};

/// Levels of symbols that are given; a client may take each by a call of its own.
const DEPTH: usize = 64;

/// The symbols of a document.
pub fn symbols(document: &Document) -> Vec<DocumentSymbol> {
    let outline = document.outline();
    let mut within: Vec<Vec<usize>> = vec![Vec::new(); outline.blocks.len()];
    for (number, statement) in outline.statements.iter().enumerate() {
        if let Some(list) = within.get_mut(statement.within) {
            list.push(number);
        }
    }
    level(document, &outline, &within, 0, 0)
}

fn level(
    document: &Document,
    outline: &Outline,
    within: &[Vec<usize>],
    block: usize,
    depth: usize,
) -> Vec<DocumentSymbol> {
    let mut found = Vec::new();
    if depth > DEPTH {
        return found;
    }
    for &number in within.get(block).into_iter().flatten() {
        let Some(statement) = outline.statements.get(number) else { continue };
        let inner = match statement.block {
            Some(inner) => level(document, outline, within, inner, depth + 1),
            None => Vec::new(),
        };
        match symbol(document, outline, number) {
            Some(mut symbol) => {
                symbol.children = (!inner.is_empty()).then_some(inner);
                found.push(symbol);
            }
            // What stands in a loop or a choice is shown as if it stood outside.
            None => found.extend(inner),
        }
    }
    found
}

#[allow(deprecated)]
fn symbol(document: &Document, outline: &Outline, number: usize) -> Option<DocumentSymbol> {
    let text = &*document.text.text;
    let statement = outline.statements.get(number)?;
    let opens = statement.block.is_some() && statement.word.is_some();
    let (name, token, kind, detail) = match given(outline, text, number) {
        Some(given) => (given.name, given.token, kind_of(given.sort), describe::sort(given.sort)),
        None if opens => {
            let head = statement.head?;
            (outline.slice(text, head), head, SymbolKind::Namespace, "")
        }
        None => return None,
    };
    let first = outline.tokens.get(statement.tokens.start)?;
    let last = outline.tokens.get(statement.tokens.end.checked_sub(1)?)?;
    let end = statement
        .block
        .and_then(|block| outline.blocks.get(block))
        .map_or(last.end, |block| (block.span.end + 1).min(text.len()));
    let place = outline.tokens.get(token)?;
    Some(DocumentSymbol {
        name: name.to_owned(),
        detail: (!detail.is_empty()).then(|| detail.to_owned()),
        kind,
        tags: None,
        deprecated: None,
        range: document.text.range(first.start, end.max(last.end)),
        selection_range: document.text.range(place.start, place.end),
        children: None,
    })
}

fn kind_of(sort: Sort) -> SymbolKind {
    match sort {
        Sort::Value => SymbolKind::Variable,
        Sort::Parameter => SymbolKind::Constant,
        Sort::Function => SymbolKind::Function,
        Sort::Edge => SymbolKind::Field,
        Sort::Label => SymbolKind::Event,
        Sort::Item(Kind::Garment | Kind::Scene | Kind::Block) => SymbolKind::Module,
        Sort::Item(Kind::Panel | Kind::Cloth) => SymbolKind::Class,
        Sort::Item(_) => SymbolKind::Struct,
    }
}
