//! From a name to where it is declared, and to all places where it is used.

use super::document::{Document, Folders, Known, text_of};
use super::names;
use super::outline::Outline;
use super::scan::Sort;
use crate::diagnostic::Span;
use gen_lsp_types::{Location, Position, Range, Uri};
use std::collections::BTreeSet;

/// The word at a place, as the token that stands there.
pub fn word_at(document: &Document, outline: &Outline, place: Position) -> Option<usize> {
    let number = outline.token_at(document.text.offset(place))?;
    outline.tokens.get(number).is_some_and(|token| token.sort == Sort::Word).then_some(number)
}

/// Where the name at a place is declared.
pub fn definition(
    document: &Document,
    known: Option<&Known>,
    folders: &Folders,
    place: Position,
) -> Vec<Location> {
    let (outline, text) = (document.outline(), &*document.text.text);
    let at = document.text.offset(place);
    let Some(number) = outline.token_at(at) else { return Vec::new() };
    let Some(token) = outline.tokens.get(number).copied() else { return Vec::new() };
    if let Some(known) = known {
        if token.sort == Sort::Text {
            return used_file(document, &outline, known, folders, number).into_iter().collect();
        }
        let old = known.old(token.start, token.end);
        let places = old.map(|old| known.study.declared(old)).unwrap_or_default();
        let found = locations(document, known, folders, places);
        if !found.is_empty() {
            return found;
        }
    }
    if token.sort != Sort::Word {
        return Vec::new();
    }
    let name = outline.slice(text, number);
    let given = names::visible(&outline, text, token.start);
    let given = given.iter().find(|given| given.name == name);
    let span = given.and_then(|given| outline.tokens.get(given.token));
    let here = |span: &super::scan::Token| Location {
        uri: Uri(document.uri.clone()),
        range: document.text.range(span.start, span.end),
    };
    span.map(here).into_iter().collect()
}

/// The beginning of a file that is used by its path.
fn used_file(
    document: &Document,
    outline: &Outline,
    known: &Known,
    folders: &Folders,
    number: usize,
) -> Option<Location> {
    let text = &*document.text.text;
    let names_a_file = |head: usize| {
        let word = outline.slice(text, head);
        word == "use" || crate::evaluate::drafts::NAMING.contains(&word)
    };
    let around = outline.statements.iter().filter(|s| s.tokens.contains(&number));
    around.filter_map(|statement| statement.head).find(|head| names_a_file(*head))?;
    let written = outline.slice(text, number).trim_matches('"');
    let path = crate::world::path::beside(&known.study.job.place.path, written).ok()?;
    let (file, ..) = known.study.desk.files().find(|(_, known, _)| *known == path)?;
    Some(Location { uri: Uri(folders.address(&known.study, file)?), range: Range::default() })
}

/// Places of a study as the client knows them, in the order of the texts.
pub fn locations(
    document: &Document,
    known: &Known,
    folders: &Folders,
    places: BTreeSet<Span>,
) -> Vec<Location> {
    let mut found = Vec::new();
    for span in places {
        let Some(place) = known.now(span) else { continue };
        let Some(uri) = folders.address(&known.study, span.file) else { continue };
        let range = if span.file == known.study.root {
            document.text.span(place)
        } else {
            text_of(&known.study, span.file, &document.text).span(place)
        };
        found.push(Location { uri: Uri(uri), range });
    }
    found
}

/// All places of the name at a place of a document, declarations among them if they are wanted.
pub fn occurrences(
    document: &Document,
    known: &Known,
    place: Position,
    with_declarations: bool,
) -> BTreeSet<Span> {
    let outline = document.outline();
    let Some(number) = word_at(document, &outline, place) else { return BTreeSet::new() };
    let Some(token) = outline.tokens.get(number) else { return BTreeSet::new() };
    let Some(old) = known.old(token.start, token.end) else { return BTreeSet::new() };
    let declared = known.study.declared(old);
    let mut found = known.study.places(&declared);
    if !with_declarations {
        found.retain(|span| known.study.definitions(*span).next().is_none());
    }
    found
}
