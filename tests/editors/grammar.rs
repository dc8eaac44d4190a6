//! The TextMate grammar, made from the program's own tables so that it never drifts.

use darzi::evaluate::words::{Element, Form, tables};
use serde_json::{Value, json};
use std::collections::BTreeSet;

/// Words of the language that stand in every block.
pub const LANGUAGE: &[&str] = &[
    "use", "let", "param", "fn", "for", "if", "then", "else", "match", "and", "or", "not", "in",
    "as", "omit", "from",
];

/// A letter that may stand in a name, and one that may not begin it.
const START: &str = r"[\p{L}_]";
const REST: &str = r"[\p{L}\p{M}\p{N}_]";

/// Words of the table at the head of a line, of properties, of clauses, and of choices.
pub struct Words {
    pub heads: BTreeSet<&'static str>,
    pub items: BTreeSet<&'static str>,
    pub properties: BTreeSet<&'static str>,
    pub clauses: BTreeSet<&'static str>,
    pub choices: BTreeSet<&'static str>,
}

pub fn words() -> Words {
    let mut found = Words {
        heads: BTreeSet::new(),
        items: BTreeSet::new(),
        properties: BTreeSet::new(),
        clauses: BTreeSet::new(),
        choices: BTreeSet::new(),
    };
    for word in tables().flat_map(|table| table.words) {
        match word.form {
            Form::Item => found.items.insert(word.name),
            Form::Action => found.heads.insert(word.name),
            Form::Property => found.properties.insert(word.name),
        };
        let pattern = word.read();
        let clauses = pattern.clauses.iter();
        let elements = pattern.head.iter().chain(clauses.clone().flat_map(|c| &c.elements));
        for element in elements {
            match element {
                Element::Literal(word) => drop(found.clauses.insert(word)),
                Element::Operand { choice, .. } => found.choices.extend(choice),
                Element::Rest => {}
            }
        }
        found.clauses.extend(clauses.map(|clause| clause.word));
    }
    // Signs have a rule of their own.
    found.clauses.retain(|word| word.chars().all(|c| c.is_alphanumeric() || c == '_'));
    found
}

/// `a|bc|…`, longer words first so that none hides another.
fn any<'a>(words: impl IntoIterator<Item = &'a str>) -> String {
    let mut words: Vec<&str> = words.into_iter().collect();
    words.sort_by_key(|word| (std::cmp::Reverse(word.len()), *word));
    words.dedup();
    words.join("|")
}

fn rule(name: &str, pattern: &str) -> Value {
    json!({ "name": format!("{name}.garment"), "match": pattern })
}

/// A rule whose parts have names of their own.
fn parts(pattern: &str, names: &[&str]) -> Value {
    let captures: serde_json::Map<String, Value> = names
        .iter()
        .enumerate()
        .map(|(n, name)| ((n + 1).to_string(), json!({ "name": format!("{name}.garment") })))
        .collect();
    json!({ "match": pattern, "captures": captures })
}

/// The whole grammar.
pub fn grammar() -> Value {
    let words = words();
    let units = any(darzi::units::known());
    let name = format!("{START}{REST}*");
    let unit = format!(r"%|/?(?:{units})\d*(?:[./](?:{units})\d*)*");
    let alone = format!(r"(?!{REST})");
    let fresh = r"(?<![.\p{L}\p{M}\p{N}_])";
    // A range such as `0cm..6cm` has a number behind its points.
    let apart = format!(r"(?<!{REST})");
    // At the beginning of a line, or behind `;`, `{` or the `:` of a label.
    let begins = r"(?:^\s*|(?<=[;{:])\s*)";
    let no_key = r"(?!\s*:(?!:))";
    let functions = any(darzi::evaluate::functions().map(|(name, _)| name));
    json!({
        "$schema": "https://raw.githubusercontent.com/martinring/tmlanguage/master/tmlanguage.json",
        "name": "Garment",
        "scopeName": "source.garment",
        "fileTypes": ["garment"],
        "patterns": [
            rule("comment.line.documentation", r"///(?!/).*$"),
            rule("comment.line.double-slash", r"//.*$"),
            parts(
                &format!(r#"(\d?{name}|\d{REST}+|"(?:[^"\\]|\\.)*")\s*(:)(?!:)"#),
                &["variable.other.property", "punctuation.separator.key-value"],
            ),
            rule("string.quoted.double", r#""(?:[^"\\]|\\.)*(?:"|$)"#),
            rule("string.unquoted.row", r"\|(?:[^|]*\|)+|\|.*$"),
            rule("constant.other.color", r"#[0-9A-Fa-f]+"),
            parts(
                &format!(
                    r"{apart}((?:\d+ )?\d+/\d+(?=[A-Za-zµμ])|\d+(?:\.\d+)?(?:[eE][+-]?\d+)?)({unit}){alone}"
                ),
                &["constant.numeric", "keyword.other.unit"],
            ),
            rule("constant.numeric", r"\d+(?:\.\d+)?(?:[eE][+-]?\d+)?"),
            parts(
                &format!(r"{begins}({}){alone}{no_key}\s+({name})", any(words.items.clone())),
                &["keyword.other", "entity.name.type"],
            ),
            parts(
                &format!(r"{begins}({}){alone}{no_key}", any(words.heads.clone())),
                &["keyword.other"],
            ),
            parts(
                &format!(r"{fresh}(let|param)\s+({name})"),
                &["keyword.control", "variable.other.constant"],
            ),
            rule("keyword.control", &format!(r"{fresh}(?:{}){alone}", any(LANGUAGE.iter().copied()))),
            rule("support.function", &format!(r"{fresh}(?:{functions})(?=\()")),
            rule("entity.name.function", &format!(r"{fresh}{name}(?=\()")),
            rule("entity.name.namespace", &format!(r"{fresh}{name}(?=::)")),
            rule(
                "keyword.other.clause",
                &format!(r"{fresh}(?:{}){alone}", any(words.clauses.clone())),
            ),
            rule(
                "constant.language",
                &format!(r"{fresh}(?:{}){alone}", any(words.choices.clone())),
            ),
            parts(&format!(r"(\.)({name})"), &["punctuation.accessor", "variable.other.member"]),
            rule("keyword.operator", r"->|\.\.|==|!=|<=|>=|[-+*/@<>=]"),
            rule("punctuation", r"::|[{}()\[\],;:.]"),
            rule("variable.other", &name),
        ],
    })
}
