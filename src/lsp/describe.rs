//! What is said of a name, a word or a unit.

use super::names::{self, Given};
use super::outline::{self, Outline};
use super::study::Study;
use crate::diagnostic::{Span, Texts};
use crate::evaluate::facts::{Definition, Sort, Worth};
use crate::evaluate::words::Word;
use crate::units;

/// Characters of a line of text that are shown.
const SHOWN: usize = 120;

/// The words of the language that stand in every block, and what they are for.
const LANGUAGE: &[(&str, &str, &str)] = &[
    ("use", "use \"FILE\"::{NAME, …} or std::MODULE::NAME [as NAME]", "brings names from a file"),
    ("let", "let NAME = VALUE", "gives a value a name"),
    (
        "param",
        "param NAME [: KIND] [= VALUE] [in RANGE]",
        "a value that may be set from outside, with its default and what it may lie in",
    ),
    ("fn", "fn NAME(NAME: KIND, …)[: KIND] = VALUE", "a function"),
    ("for", "for NAME in RANGE { … }", "repeats its block for every value"),
    ("if", "if CONDITION { … } [else { … }], if CONDITION then VALUE else VALUE", "a choice"),
    (
        "match",
        "match PARAMETER { OPTION: { … } … }, match(PARAMETER, OPTION: VALUE, …)",
        "a choice by the option of a parameter; `otherwise` stands for all others",
    ),
    ("then", "if CONDITION then VALUE else VALUE", "a choice between values"),
    ("else", "if CONDITION { … } else { … }", "the other side of a choice"),
    ("and", "CONDITION and CONDITION", "both hold"),
    ("or", "CONDITION or CONDITION", "one of them holds"),
    ("not", "not CONDITION", "it does not hold"),
    ("omit", "omit NAME, …", "drops lines of the copied text by name, label or word"),
];

/// What a word of the language is for, as usage and help.
pub fn of_language(word: &str) -> Option<(&'static str, &'static str)> {
    LANGUAGE.iter().find(|(name, ..)| *name == word).map(|(_, usage, help)| (*usage, *help))
}

/// What a word of the table is for, in Markdown.
pub fn word(word: &Word) -> String {
    usage(&word.usage(), word.help)
}

/// A usage line with its help, in Markdown.
pub fn usage(usage: &str, help: &str) -> String {
    let (help, default) = match help.rsplit_once(" =") {
        Some((help, default)) => (help, format!("  \nunless said otherwise: `{default}`")),
        None => (help, String::new()),
    };
    format!("{}\n{help}{default}", fenced(usage))
}

/// A line of the language, in Markdown.
pub fn fenced(text: &str) -> String {
    format!("```garment\n{text}\n```")
}

/// What a sort of name is called.
pub fn sort(sort: Sort) -> &'static str {
    match sort {
        Sort::Value => "value",
        Sort::Parameter => "parameter",
        Sort::Function => "function",
        Sort::Item(kind) => kind.noun(),
        Sort::Edge => "edge",
        Sort::Label => "label",
    }
}

/// Values in a line: `20 cm`, or `front 20 cm, back 21.5 cm`.
pub fn worth(worth: &[Worth]) -> String {
    let one = |worth: &Worth| match &worth.of {
        Some(of) => format!("{of} {}", worth.text),
        None => worth.text.clone(),
    };
    worth.iter().map(one).collect::<Vec<_>>().join(", ")
}

/// What is known of a definition, in Markdown: its line, its value, what is written above it.
pub fn definition(study: &Study, definition: &Definition) -> String {
    let text = study.desk.text(definition.span.file);
    let outline = outline::read(text);
    let (line, doc) = line_of(&outline, text, definition.span);
    let mut said = Vec::new();
    if !line.is_empty() {
        said.push(fenced(&line));
    }
    let mut about = format!("{} `{}`", sort(definition.sort), definition.name);
    let worth = worth(&definition.worth);
    if !worth.is_empty() {
        about.push_str(&format!(" = **{worth}**"));
    }
    let path = study.desk.path(definition.span.file);
    if definition.span.file != study.root && !path.is_empty() {
        about.push_str(&format!("  \nfrom `{path}`"));
    }
    said.push(about);
    if !doc.is_empty() {
        said.push(doc);
    }
    said.join("\n\n")
}

/// What the text alone shows of a name, in Markdown.
pub fn given(outline: &Outline, text: &str, given: &Given) -> String {
    let Some(token) = outline.tokens.get(given.token) else { return String::new() };
    let span = Span::new(Default::default(), token.start, token.end);
    let (line, doc) = line_of(outline, text, span);
    format!("{}\n{} `{}`\n\n{doc}", fenced(&line), sort(given.sort), given.name)
}

/// The statement that gives a name, its first line only, and what is written above it.
pub fn line_of(outline: &Outline, text: &str, span: Span) -> (String, String) {
    let at = span.start as usize;
    let number = outline.statements.iter().position(|statement| {
        let tokens = outline.tokens.get(statement.tokens.clone()).unwrap_or(&[]);
        tokens.iter().any(|token| token.start == at)
    });
    let Some(statement) = number.and_then(|number| outline.statements.get(number)) else {
        return (String::new(), String::new());
    };
    let tokens = outline.tokens.get(statement.tokens.clone()).unwrap_or(&[]);
    let (Some(first), Some(last)) = (tokens.first(), tokens.last()) else {
        return (String::new(), String::new());
    };
    let line = text.get(first.start..last.end).unwrap_or("");
    let line = line.lines().next().unwrap_or("");
    let mut shown: String = line.chars().take(SHOWN).collect();
    if shown.len() < line.len() {
        shown.push('…');
    }
    (shown, outline.doc(text, statement))
}

/// What a number with a unit is in the units of the workshop: `12in` is 30.48 cm.
pub fn number(number: &str, unit: &str) -> Option<String> {
    let value: f64 = match number.split_once('/') {
        Some((above, below)) => above.parse::<f64>().ok()? / below.parse::<f64>().ok()?,
        None => number.parse().ok()?,
    };
    let plain = unit.replace(['\u{b5}', '\u{3bc}'], "u");
    let quantity = units::unit(&plain).ok()?.quantity(value)?;
    Some(format!("{} = **{quantity}**", quantity.dimension.name()))
}

/// The names that a file of the library declares at its level, with their lines.
pub fn of_module(module: &str) -> Vec<(String, Sort, String)> {
    let Some(text) = crate::world::library::text(module) else { return Vec::new() };
    let outline = outline::read(text);
    (0..outline.statements.len())
        .filter(|number| outline.statements.get(*number).is_some_and(|s| s.within == 0))
        .filter_map(|number| {
            let given = names::given(&outline, text, number)?;
            let doc = outline.statements.get(number).map(|s| outline.doc(text, s))?;
            Some((given.name.to_owned(), given.sort, doc))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_library_is_listed_with_its_kinds() {
        let fabrics = of_module("std::fabric");
        assert!(fabrics.iter().any(|(name, sort, _)| {
            name == "denim" && *sort == Sort::Item(crate::evaluate::words::Kind::Fabric)
        }));
        assert!(!of_module("std::color").is_empty());
        assert!(of_module("std::nothing").is_empty());
    }

    #[test]
    fn numbers_are_turned_into_the_units_of_the_workshop() {
        assert_eq!(number("12", "in").unwrap(), "a length = **30.48 cm**");
        assert_eq!(number("1/2", "in").unwrap(), "a length = **1.27 cm**");
        assert_eq!(number("0", "Ne"), None);
        assert_eq!(number("1", "xyz"), None);
    }
}
