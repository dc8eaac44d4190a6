//! What each word is, for editors that colour by meaning.

use super::document::Document;
use super::hover::says;
use super::names::given;
use super::outline::{HEADS, Outline, Statement};
use super::scan::Sort;
use crate::evaluate::facts;
use crate::evaluate::words::Form;
use gen_lsp_types::{SemanticToken, SemanticTokens, SemanticTokensLegend};

/// The kinds of token, in the order of their numbers. `unit` is our own; editors that do not
/// know it leave such words as they are.
const TYPES: &[&str] = &[
    "keyword",
    "property",
    "function",
    "variable",
    "parameter",
    "number",
    "unit",
    "string",
    "comment",
    "operator",
    "type",
    "enumMember",
    "namespace",
];

/// What may be true of a token besides, in the order of the bits.
const MODIFIERS: &[&str] = &["declaration", "documentation"];

const DECLARATION: u32 = 1;
const DOCUMENTATION: u32 = 2;

/// The names of all kinds, for the client.
pub fn legend() -> SemanticTokensLegend {
    SemanticTokensLegend {
        token_types: TYPES.iter().map(|name| (*name).to_owned()).collect(),
        token_modifiers: MODIFIERS.iter().map(|name| (*name).to_owned()).collect(),
    }
}

/// All tokens of a document.
pub fn tokens(document: &Document) -> SemanticTokens {
    let (outline, text) = (document.outline(), &*document.text.text);
    let mut meant: Vec<Option<(&str, u32)>> = vec![None; outline.tokens.len()];
    for (number, statement) in outline.statements.iter().enumerate() {
        of_statement(&outline, text, number, statement, &mut meant);
    }
    let mut data = Vec::new();
    let (mut line, mut column) = (0, 0);
    for (number, token) in outline.tokens.iter().enumerate() {
        let plain = match token.sort {
            Sort::Number => Some(("number", 0)),
            Sort::Unit => Some(("unit", 0)),
            Sort::Text | Sort::Row | Sort::Colour => Some(("string", 0)),
            Sort::Comment => Some(("comment", 0)),
            Sort::Doc => Some(("comment", DOCUMENTATION)),
            Sort::Operator => Some(("operator", 0)),
            Sort::Word => Some(("variable", 0)),
            Sort::Mark | Sort::Newline => None,
        };
        let found = meant.get(number).copied().flatten().or(plain);
        let Some((name, modifiers)) = found else { continue };
        let Some(kind) = TYPES.iter().position(|known| *known == name) else { continue };
        let range = document.text.range(token.start, token.end);
        if range.start.line != range.end.line {
            continue;
        }
        let first = if range.start.line == line { column } else { 0 };
        data.push(SemanticToken {
            delta_line: range.start.line - line,
            delta_start: range.start.character.saturating_sub(first),
            length: range.end.character - range.start.character,
            token_type: u32::try_from(kind).unwrap_or(0),
            token_modifiers_bitset: modifiers,
        });
        (line, column) = (range.start.line, range.start.character);
    }
    SemanticTokens { result_id: None, data }
}

fn of_statement<'n>(
    outline: &Outline,
    text: &str,
    number: usize,
    statement: &Statement,
    meant: &mut [Option<(&'n str, u32)>],
) {
    let mut set = |token: usize, name: &'n str, modifiers: u32| {
        if let Some(place) = meant.get_mut(token) {
            *place = Some((name, modifiers));
        }
    };
    let given = given(outline, text, number);
    let head = statement.head;
    for at in statement.tokens.clone() {
        let Some(token) = outline.tokens.get(at) else { break };
        if token.sort != Sort::Word {
            // `2HB:` and `"EU 38":` are keys.
            if statement.key.is_some_and(|key| at == key || at == key + 1) {
                if matches!(token.sort, Sort::Number | Sort::Unit | Sort::Text) {
                    set(at, "property", 0);
                }
            }
            continue;
        }
        let word = outline.slice(text, at);
        let before = at.checked_sub(1).map_or("", |before| outline.slice(text, before));
        let after = outline.slice(text, at + 1);
        let touches = outline.tokens.get(at + 1).is_some_and(|next| next.start == token.end);
        if let Some(given) = given.filter(|given| given.token == at) {
            let name = match given.sort {
                facts::Sort::Parameter => "parameter",
                facts::Sort::Function => "function",
                facts::Sort::Item(_) => "type",
                _ => "variable",
            };
            set(at, name, DECLARATION);
        } else if before == "." {
            set(at, "property", 0);
        } else if head == Some(at) && statement.word.is_some() {
            let property = statement.word.is_some_and(|word| word.form == Form::Property);
            set(at, if property { "property" } else { "keyword" }, 0);
        } else if statement.key == Some(at) {
            set(at, "property", 0);
        } else if head == Some(at) && HEADS.contains(&word)
            || matches!(word, "if" | "then" | "else" | "and" | "or" | "not")
            || (statement.word.is_none() && matches!(word, "in" | "as" | "omit"))
        {
            set(at, "keyword", 0);
        } else if touches && after == "(" {
            set(at, "function", 0);
        } else if touches && after == ":" && outline.slice(text, at + 2) == ":" {
            set(at, "namespace", 0);
        } else if statement.word.is_some_and(|table| says(table, word)) {
            let choice = statement.word.is_some_and(|table| table.read().clause(word).is_none());
            set(at, if choice { "enumMember" } else { "keyword" }, 0);
        }
    }
}
