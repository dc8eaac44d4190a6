//! What may be written at the cursor: words of the block, clauses of the word, names, edges of a
//! panel, measures of a wearer, things of the library, units behind a number.

use super::clause::{self, Wanted};
use super::describe;
use super::document::{Document, Known};
use super::members::members;
use super::names::{self, Given};
use super::outline::{Outline, Statement};
use super::scan::Sort as Piece;
use crate::evaluate::facts::Sort;
use crate::evaluate::words::{Element, Form, Kind, Vocabulary, Word, vocabulary};
use crate::units::{self, Dimension};
use gen_lsp_types::{
    CompletionItem, CompletionItemKind, CompletionItemTextEdit, Documentation, MarkupContent,
    MarkupKind, Position, Range, TextEdit,
};
use std::collections::BTreeSet;

/// What is found, best first.
pub(super) struct Found {
    items: Vec<CompletionItem>,
    seen: BTreeSet<String>,
    range: Range,
}

impl Found {
    /// Adds a name unless it is there; a lower rank stands first.
    pub(super) fn add(
        &mut self,
        rank: u8,
        kind: CompletionItemKind,
        name: &str,
        detail: &str,
        doc: String,
    ) {
        if name.is_empty() || !self.seen.insert(name.to_owned()) {
            return;
        }
        let documentation = (!doc.is_empty()).then_some({
            Documentation::MarkupContent(MarkupContent { kind: MarkupKind::Markdown, value: doc })
        });
        self.items.push(CompletionItem {
            label: name.to_owned(),
            kind: Some(kind),
            detail: (!detail.is_empty()).then(|| detail.to_owned()),
            documentation,
            sort_text: Some(format!("{rank}{:03}", self.items.len().min(999))),
            text_edit: Some(CompletionItemTextEdit::TextEdit(TextEdit {
                range: self.range,
                new_text: name.to_owned(),
            })),
            ..CompletionItem::default()
        });
    }

    /// A word with which a line begins; a property with its colon.
    fn word(&mut self, rank: u8, word: &Word) {
        let before = self.items.len();
        let property = word.form == Form::Property;
        let kind =
            if property { CompletionItemKind::Property } else { CompletionItemKind::Keyword };
        self.add(rank, kind, word.name, &word.usage(), describe::word(word));
        if let (true, Some(item)) = (property, self.items.get_mut(before)) {
            item.text_edit = Some(CompletionItemTextEdit::TextEdit(TextEdit {
                range: self.range,
                new_text: format!("{}: ", word.name),
            }));
        }
    }
}

/// What may be written at a place.
pub fn complete(
    document: &Document,
    known: Option<&Known>,
    place: Position,
) -> Vec<CompletionItem> {
    let (outline, text) = (document.outline(), &*document.text.text);
    let at = document.text.offset(place);
    // The token that the cursor is in or behind, and the first one behind what is being typed.
    let touching = outline.tokens.iter().rposition(|token| token.start < at && at <= token.end);
    let here = touching.and_then(|number| Some((number, *outline.tokens.get(number)?)));
    let (until, start) = match here {
        Some((number, token)) => match token.sort {
            Piece::Comment | Piece::Doc | Piece::Text | Piece::Row | Piece::Colour
                if at > token.start
                    && (at < token.end || !closed(text, token.start, token.end)) =>
            {
                return Vec::new();
            }
            Piece::Number | Piece::Unit => return after_number(document, &outline, number, at),
            Piece::Word => (number, token.start),
            _ => (number + 1, at),
        },
        None => (outline.tokens.partition_point(|token| token.start < at), at),
    };
    let range = document.text.range(start, at);
    let mut found = Found { items: Vec::new(), seen: BTreeSet::new(), range };
    let before = until.checked_sub(1);
    let last = before.map_or("", |before| outline.slice(text, before));
    let touches = before.and_then(|b| outline.tokens.get(b)).is_some_and(|b| b.end == start);
    if last == "." && touches {
        members(document, known, &outline, until - 1, &mut found);
        return found.items;
    }
    // Inside `front.( … )` the names are those of the panel.
    if let Some(open) = open_bracket(&outline, text, until)
        && open > 0
        && outline.slice(text, open - 1) == "."
    {
        members(document, known, &outline, open - 1, &mut found);
        return found.items;
    }
    if last == ":" && touches && before.is_some_and(|b| b > 0 && outline.slice(text, b - 1) == ":")
    {
        library_path(&outline, text, until, &mut found);
        return found.items;
    }
    let block = outline.block_at(at);
    let kind = outline.blocks.get(block).and_then(|block| block.kind);
    let table = kind.map(vocabulary);
    let visible = names::visible(&outline, text, at);
    let statement = outline
        .statement_at(at)
        .and_then(|number| outline.statements.get(number))
        .filter(|statement| statement.tokens.start < until);
    match statement {
        None => beginning(&outline, text, block, table, &mut found),
        Some(statement) => {
            let label = statement.key.is_some_and(|key| key + 2 == until && last == ":");
            let property = statement.word.is_some_and(|word| word.form == Form::Property);
            if label && !property {
                for word in table.into_iter().flat_map(|table| table.words) {
                    if word.form == Form::Action {
                        found.word(1, word);
                    }
                }
                return found.items;
            }
            let word =
                statement.word.is_some() || !fresh(&outline, text, statement, until, &mut found);
            if word {
                let wanted = clause::wanted(&outline, text, statement, until);
                in_phrase(document, known, &visible, wanted.as_ref(), &mut found);
            }
        }
    }
    found.items
}

/// Whether a token such as a string ends by itself and not with its line.
fn closed(text: &str, start: usize, end: usize) -> bool {
    text.get(start..end).is_some_and(|token| {
        token.len() > 1 && token.starts_with('"') && token.ends_with('"')
            || token.starts_with('#') && token.len() > 3
            || token.starts_with('|') && token.ends_with('|') && token.len() > 1
    })
}

/// The bracket that is open before a token in the same statement.
fn open_bracket(outline: &Outline, text: &str, until: usize) -> Option<usize> {
    let mut depth = 0_usize;
    for at in (0..until).rev() {
        match outline.slice(text, at) {
            ")" | "]" => depth += 1,
            "(" | "[" if depth > 0 => depth -= 1,
            "(" => return Some(at),
            "[" | "{" | "}" | ";" => return None,
            _ if outline.tokens.get(at).is_some_and(|t| t.sort == Piece::Newline) && depth == 0 => {
                return None;
            }
            _ => {}
        }
    }
    None
}

/// Words with which a statement begins.
fn beginning(
    outline: &Outline,
    text: &str,
    block: usize,
    table: Option<&'static Vocabulary>,
    found: &mut Found,
) {
    // A property is said once; what a block has already comes last.
    let has: BTreeSet<&str> = outline
        .statements
        .iter()
        .filter(|statement| statement.within == block)
        .filter_map(|statement| Some(statement.word?.name))
        .collect();
    for word in table.into_iter().flat_map(|table| table.words) {
        let again = word.form == Form::Property && has.contains(word.name);
        found.word(if again { 4 } else { 1 }, word);
    }
    for name in ["let", "param", "fn", "for", "if", "match"] {
        if let Some((usage, help)) = describe::of_language(name) {
            let doc = describe::usage(usage, help);
            found.add(3, CompletionItemKind::Keyword, name, usage, doc);
        }
    }
    if block == 0 {
        let usage = describe::of_language("use").map_or("", |(usage, _)| usage);
        found.add(3, CompletionItemKind::Keyword, "use", usage, String::new());
    }
    // A copy may set parameters and drop or replace lines of its original.
    let opener = outline.blocks.get(block).and_then(|block| block.opener);
    if let Some(base) = opener.and_then(|opener| names::base(outline, text, opener)) {
        // A part sets parameters of its block, and replaces nothing.
        let part = outline.blocks.get(block).is_some_and(|block| block.kind == Some(Kind::Part));
        if !part {
            let usage = describe::of_language("omit").map_or("", |(usage, _)| usage);
            found.add(2, CompletionItemKind::Keyword, "omit", usage, String::new());
        }
        let inside = outline.blocks.get(base).map(|base| base.span.clone()).unwrap_or_default();
        for given in names::visible(outline, text, inside.end) {
            let within = outline.tokens.get(given.token).is_some_and(|t| inside.contains(&t.start));
            let sets = given.sort == Sort::Parameter;
            if within && (sets || !part) {
                let what = if sets { "sets" } else { "replaces" };
                found.add(2, kind_of(given.sort), given.name, what, String::new());
            }
        }
    }
}

/// Behind `let`, `param`, `fn` and `use`: true if what was found is all there is.
fn fresh(
    outline: &Outline,
    text: &str,
    statement: &Statement,
    until: usize,
    found: &mut Found,
) -> bool {
    let head = statement.head.map_or("", |head| outline.slice(text, head));
    let last = outline.slice(text, until.saturating_sub(1));
    match head {
        // A new name.
        "let" | "param" | "fn" | "for" if until == statement.tokens.start + 1 => true,
        "use" => {
            found.add(1, CompletionItemKind::Module, "std", "the library", String::new());
            true
        }
        "param" | "fn" if last == ":" => {
            for kind in crate::evaluate::kinds() {
                found.add(1, CompletionItemKind::TypeParameter, kind, "", String::new());
            }
            true
        }
        "param"
            if !outline
                .tokens
                .get(until.saturating_sub(1))
                .is_some_and(|t| t.sort == Piece::Operator) =>
        {
            found.add(2, CompletionItemKind::Keyword, "in", "in RANGE", String::new());
            false
        }
        _ => false,
    }
}

/// Inside a phrase: the words it takes, and values.
fn in_phrase(
    document: &Document,
    known: Option<&Known>,
    visible: &[Given],
    wanted: Option<&Wanted>,
    found: &mut Found,
) {
    let operand = match wanted.and_then(|wanted| wanted.element) {
        Some(Element::Operand { name, choice, .. }) => {
            for word in choice {
                found.add(0, CompletionItemKind::EnumMember, word, "", String::new());
            }
            if !choice.is_empty() && choice.iter().all(|word| !word.is_empty()) {
                return;
            }
            *name
        }
        Some(Element::Literal(word)) => {
            found.add(0, CompletionItemKind::Keyword, word, "", String::new());
            ""
        }
        _ => "",
    };
    if let Some(wanted) = wanted.filter(|wanted| !wanted.open) {
        let pattern = wanted.word.read();
        let taken: Vec<usize> =
            wanted.said.iter().filter_map(|word| Some(pattern.clause(word)?.group)).collect();
        // Where a value is wanted, words follow it later.
        let rank = if operand.is_empty() || operand == "NAME" { 1 } else { 4 };
        for clause in pattern.clauses.iter().filter(|clause| !taken.contains(&clause.group)) {
            let usage = std::iter::once(clause.word.to_owned())
                .chain(clause.elements.iter().map(clause::shown))
                .collect::<Vec<_>>()
                .join(" ");
            found.add(rank, CompletionItemKind::Keyword, clause.word, &usage, String::new());
        }
    }
    if operand == "END" {
        found.add(
            0,
            CompletionItemKind::Keyword,
            "start",
            "where the outline begins",
            String::new(),
        );
    }
    if operand == "DIRECTION" {
        for word in ["smooth", "square"] {
            found.add(0, CompletionItemKind::Keyword, word, "to the neighbour edge", String::new());
        }
    }
    let kinds = kinds_of(operand);
    for given in visible {
        let fits = match given.sort {
            Sort::Item(kind) => kinds.contains(&kind) || (kinds.is_empty() && reaches(kind)),
            Sort::Edge => kinds.is_empty(),
            Sort::Label => false,
            _ => kinds.is_empty(),
        };
        let wanted_edge = matches!(operand, "EDGE" | "PIECE");
        let rank = match given.sort {
            Sort::Edge if wanted_edge => 0,
            Sort::Item(kind) if wanted_edge && kind == Kind::Panel => 0,
            Sort::Item(kind) if kinds.contains(&kind) => 0,
            _ => 2,
        };
        if fits {
            let (detail, doc) = about(document, known, given);
            found.add(rank, kind_of(given.sort), given.name, &detail, doc);
        }
    }
    for kind in kinds {
        for module in kind.libraries() {
            library(module, Some(*kind), found);
        }
    }
    if matches!(operand, "COLOUR") {
        library("std::color", None, found);
    }
    let values = kinds.is_empty() && !matches!(operand, "NAME" | "COLOUR");
    if values {
        for (name, usage) in crate::evaluate::functions() {
            found.add(5, CompletionItemKind::Function, name, usage, String::new());
        }
        for name in ["if", "then", "else"] {
            found.add(6, CompletionItemKind::Keyword, name, "", String::new());
        }
    }
}

/// Kinds of thing that an operand of the table names.
fn kinds_of(operand: &str) -> &'static [Kind] {
    match operand {
        "FABRIC" => &[Kind::Fabric, Kind::Sari],
        "YARN" => &[Kind::Yarn],
        "WEAVE" => &[Kind::Weave],
        "KNIT" => &[Kind::Knit],
        "STRUCTURE" => &[Kind::Weave, Kind::Knit],
        "MOTIF" => &[Kind::Motif],
        "BODY" | "FIGURE" => &[Kind::Body],
        "PANEL" => &[Kind::Panel],
        "BLOCK" => &[Kind::Block],
        "SARI" => &[Kind::Sari],
        "ANG" => &[Kind::Ang],
        "KATH" => &[Kind::Kath],
        "PADAR" => &[Kind::Padar],
        _ => &[],
    }
}

/// Whether a thing of a kind has members, so that its name begins a value.
fn reaches(kind: Kind) -> bool {
    matches!(kind, Kind::Panel | Kind::Cloth | Kind::Wearer | Kind::Sari | Kind::Part)
}

fn kind_of(sort: Sort) -> CompletionItemKind {
    match sort {
        Sort::Value => CompletionItemKind::Variable,
        Sort::Parameter => CompletionItemKind::Constant,
        Sort::Function => CompletionItemKind::Function,
        Sort::Item(_) => CompletionItemKind::Class,
        Sort::Edge => CompletionItemKind::Field,
        Sort::Label => CompletionItemKind::Reference,
    }
}

/// What is known of a name of this text: its value in short, and all of it.
fn about(document: &Document, known: Option<&Known>, given: &Given) -> (String, String) {
    let outline = document.outline();
    let found = outline.tokens.get(given.token).and_then(|token| {
        let known = known?;
        let definitions = known.definitions(token.start, token.end, given.name);
        let definition = *definitions.first()?;
        let worth = describe::worth(&definition.worth);
        let detail = if worth.is_empty() { describe::sort(given.sort).to_owned() } else { worth };
        Some((detail, String::new()))
    });
    let (detail, mut doc) =
        found.unwrap_or_else(|| (describe::sort(given.sort).to_owned(), String::new()));
    if let Some(statement) = outline.statements.get(given.statement) {
        doc = outline.doc(&document.text.text, statement);
    }
    (detail, doc)
}

/// Names of a module of the library.
fn library(module: &str, kind: Option<Kind>, found: &mut Found) {
    for (name, sort, doc) in describe::of_module(module) {
        if kind.is_none_or(|kind| sort == Sort::Item(kind)) {
            found.add(1, kind_of(sort), &name, module, doc);
        }
    }
}

/// Behind `std::` and `std::fabric::`.
fn library_path(outline: &Outline, text: &str, until: usize, found: &mut Found) {
    let before = |back: usize| until.checked_sub(back).map_or("", |at| outline.slice(text, at));
    let first = before(3);
    if first == "std" {
        for module in crate::world::library::names() {
            let name = module.strip_prefix("std::").unwrap_or(module);
            found.add(0, CompletionItemKind::Module, name, module, String::new());
        }
    } else if before(6) == "std" {
        library(&format!("std::{first}"), None, found);
    }
}

/// Behind a number: the rest of its unit.
fn after_number(
    document: &Document,
    outline: &Outline,
    number: usize,
    at: usize,
) -> Vec<CompletionItem> {
    let text = &*document.text.text;
    let Some(token) = outline.tokens.get(number) else { return Vec::new() };
    let start = if token.sort == Piece::Unit { token.start } else { token.end };
    if at < start {
        return Vec::new();
    }
    let range = document.text.range(start, at);
    let mut found = Found { items: Vec::new(), seen: BTreeSet::new(), range };
    let statement = outline.statement_at(at).and_then(|n| outline.statements.get(n));
    let wanted = statement.and_then(|s| clause::wanted(outline, text, s, number));
    let operand = match wanted.as_ref().and_then(|wanted| wanted.element) {
        Some(Element::Operand { name, .. }) => *name,
        _ => "",
    };
    let best = dimension_of(operand);
    // Compound units of the wanted dimension, as the messages give them.
    for example in best.map_or("", Dimension::example).split('`').skip(1).step_by(2) {
        let unit = example.trim_start_matches(|c: char| c.is_ascii_digit() || ".e-".contains(c));
        if let (Ok(_), Some(best)) = (units::unit(unit), best) {
            found.add(0, CompletionItemKind::Unit, unit, best.name(), String::new());
        }
    }
    for unit in units::known() {
        let Ok(read) = units::unit(unit) else { continue };
        let rank = if Some(read.dimension) == best { 1 } else { 2 };
        found.add(rank, CompletionItemKind::Unit, unit, read.dimension.name(), String::new());
    }
    found.add(2, CompletionItemKind::Unit, "%", "a hundredth", String::new());
    found.items
}

/// The dimension that an operand of the table names.
fn dimension_of(operand: &str) -> Option<Dimension> {
    Some(match operand {
        "LENGTH" | "POINT" | "VECTOR" | "CELLS" => Dimension::LENGTH,
        "ANGLE" | "ANGLES" | "DIRECTION" => Dimension::ANGLE,
        "TIME" => Dimension::TIME,
        "RATE" => Dimension::RATE,
        "MASS" => Dimension::MASS_PER_AREA,
        "BENDING" => Dimension::BENDING,
        "TENSION" => Dimension::TENSION,
        "SHEAR" => Dimension::SHEAR,
        "FORCE" => Dimension::FORCE,
        "SETT" => Dimension::PER_LENGTH,
        "TWIST" => Dimension::ANGLE_PER_LENGTH,
        "COUNT" => Dimension::COUNT,
        _ => return None,
    })
}
