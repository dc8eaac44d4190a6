//! What is shown over a word: what it means, what it is worth, what is written above it.

use super::describe;
use super::document::{Document, Known};
use super::names;
use super::outline::Outline;
use super::scan::Sort;
use crate::evaluate::words::{Element, Word};
use gen_lsp_types::{Contents, Hover, MarkupContent, MarkupKind, Position};

/// What is to be shown over a place.
pub fn hover(document: &Document, known: Option<&Known>, place: Position) -> Option<Hover> {
    let (outline, text) = (document.outline(), &*document.text.text);
    let at = document.text.offset(place);
    let number = outline.token_at(at)?;
    let token = *outline.tokens.get(number)?;
    let said = match token.sort {
        Sort::Word => word(document, known, &outline, number)?,
        Sort::Number | Sort::Unit => {
            let first = if token.sort == Sort::Unit { number.checked_sub(1)? } else { number };
            describe::number(outline.slice(text, first), outline.slice(text, first + 1))?
        }
        _ => return None,
    };
    let contents = MarkupContent { kind: MarkupKind::Markdown, value: said };
    Some(Hover {
        contents: Contents::MarkupContent(contents),
        range: Some(document.text.range(token.start, token.end)),
    })
}

fn word(
    document: &Document,
    known: Option<&Known>,
    outline: &Outline,
    number: usize,
) -> Option<String> {
    let text = &*document.text.text;
    let token = *outline.tokens.get(number)?;
    let name = outline.slice(text, number);
    let mut said: Vec<String> = Vec::new();
    if let Some(known) = known {
        for definition in known.definitions(token.start, token.end, name).into_iter().take(4) {
            said.push(describe::definition(&known.study, definition));
        }
        let worth = describe::worth(known.worth(token.start, token.end));
        // A name that is worth what it stands for is not said twice.
        if !worth.is_empty() && !said.iter().any(|said| said.contains(&worth)) {
            let start = chain_start(outline, text, number);
            let whole = outline.tokens.get(start).and_then(|t| text.get(t.start..token.end));
            said.push(format!("`{}` = **{worth}**", whole.unwrap_or(name)));
        }
    }
    if said.is_empty() {
        let statement = outline.statements.iter().find(|s| s.tokens.contains(&number));
        let word = statement.and_then(|statement| {
            let word = statement.word?;
            let says = statement.head == Some(number) || says(word, name);
            says.then_some(word)
        });
        if let Some(word) = word {
            return Some(describe::word(word));
        }
        let given = names::visible(outline, text, token.start);
        if let Some(given) = given.iter().find(|given| given.name == name) {
            return Some(describe::given(outline, text, given));
        }
        if let Some((usage, help)) = describe::of_language(name) {
            return Some(describe::usage(usage, help));
        }
        let mut own = crate::evaluate::functions();
        if let Some((_, usage)) = own.find(|(own, _)| *own == name) {
            return Some(describe::fenced(usage));
        }
    }
    (!said.is_empty()).then(|| said.join("\n\n---\n\n"))
}

/// Whether a word of the table has a clause or a choice of that name.
pub fn says(word: &Word, name: &str) -> bool {
    let pattern = word.read();
    let chosen = |element: &Element| match element {
        Element::Literal(word) => *word == name,
        Element::Operand { choice, .. } => choice.contains(&name),
        Element::Rest => false,
    };
    pattern.clause(name).is_some()
        || pattern.head.iter().any(chosen)
        || pattern.clauses.iter().any(|clause| clause.elements.iter().any(chosen))
}

/// The first token of a row such as `front.left.side`, of which a token is a part.
fn chain_start(outline: &Outline, text: &str, number: usize) -> usize {
    let mut at = number;
    while at >= 2
        && outline.slice(text, at - 1) == "."
        && outline.tokens.get(at - 2).is_some_and(|token| token.sort == Sort::Word)
    {
        at -= 2;
    }
    at
}
