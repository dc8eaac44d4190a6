//! The words that the fuzzer puts into texts, made from the program's own tables.
//!
//! After a change of the tables: `UPDATE=1 cargo test --test fuzz`.

use darzi::evaluate::words::{Element, tables};
use std::collections::BTreeSet;
use std::path::Path;

/// Signs and words that stand in no table.
const SIGNS: &[&str] = &[
    "->", "..", "==", "!=", "<=", ">=", " @ ", " { ", " }", "::", "///", "//", "|", "; ", ": ",
    " = ", " * ", " / ", " + ", " - ", "(0, 0)", "EU 38", "female", "cotton", "100%", "45deg",
    "1cm", "use", "let", "param", "fn", "for", "if", "then", "else", "and", "or", "not", "from",
];

/// One entry a line, in quotation marks.
fn dictionary() -> String {
    let mut found: BTreeSet<&str> = SIGNS.iter().copied().collect();
    for word in tables().flat_map(|table| table.words) {
        found.insert(word.name);
        let pattern = word.read();
        let clauses = pattern.clauses.iter();
        found.extend(clauses.clone().map(|clause| clause.word));
        for element in pattern.head.iter().chain(clauses.flat_map(|clause| &clause.elements)) {
            match element {
                Element::Literal(word) => drop(found.insert(word)),
                Element::Operand { choice, .. } => found.extend(choice),
                Element::Rest => {}
            }
        }
    }
    found.extend(darzi::units::known());
    found.extend(darzi::evaluate::functions().map(|(name, _)| name));
    found.extend(darzi::evaluate::kinds());
    let mut out = String::from("# Made from the tables by `UPDATE=1 cargo test --test fuzz`.\n");
    for word in found.iter().filter(|word| word.is_ascii()) {
        out += &format!("\"{}\"\n", word.replace('\\', "\\\\").replace('"', "\\\""));
    }
    out
}

#[test]
fn the_dictionary_is_made_from_the_tables() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/garment.dict");
    let made = dictionary();
    if std::env::var_os("UPDATE").is_some() {
        std::fs::write(&path, &made).unwrap();
    }
    let kept = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(kept == made, "run `UPDATE=1 cargo test --test fuzz`");
}
