//! The files for editors agree with the program: the TextMate grammar is made from its tables,
//! reads all examples as the program does, and the settings are sound.
//!
//! After a change of the table of words: `UPDATE=1 cargo test --test editors`.

mod grammar;
mod vim;

use darzi::diagnostic::FileId;
use darzi::evaluate::words::{Form, tables};
use darzi::lsp::{Sort, scan};
use darzi::syntax::parse;
use darzi::syntax::tree::{Block, Statement, StatementKind};
use fancy_regex::Regex;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).to_owned()
}

fn read(path: &str) -> String {
    std::fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

const VIM: &str = "editors/neovim/syntax/garment.vim";
const GRAMMAR: &str = "editors/vscode/syntaxes/garment.tmLanguage.json";

/// The examples, the library, and texts of the documentation that are right.
fn texts() -> Vec<(String, String)> {
    let mut found = Vec::new();
    for folder in ["examples", "stdlib"] {
        for entry in std::fs::read_dir(root().join(folder)).unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_some_and(|end| end == "garment") {
                found.push((path.display().to_string(), std::fs::read_to_string(&path).unwrap()));
            }
        }
    }
    found.sort();
    assert!(found.len() > 10);
    found
}

#[test]
fn what_colours_is_made_from_the_tables() {
    let made = serde_json::to_string_pretty(&grammar::grammar()).unwrap() + "\n";
    for (path, made) in [(GRAMMAR, made), (VIM, vim::syntax())] {
        if std::env::var_os("UPDATE").is_some() {
            std::fs::write(root().join(path), &made).unwrap();
        }
        assert!(read(path) == made, "run `UPDATE=1 cargo test --test editors`");
    }
}

/// A rule of the grammar with the names of its parts.
struct Rule {
    pattern: Regex,
    /// Of the whole, or of its parts by number.
    names: BTreeMap<usize, String>,
}

fn rules() -> Vec<Rule> {
    let grammar: Value = serde_json::from_str(&read(GRAMMAR)).unwrap();
    let rules = grammar["patterns"].as_array().unwrap();
    rules
        .iter()
        .map(|rule| {
            let pattern = Regex::new(rule["match"].as_str().unwrap()).unwrap();
            let mut names = BTreeMap::new();
            if let Some(name) = rule["name"].as_str() {
                names.insert(0, name.to_owned());
            }
            for (number, part) in rule["captures"].as_object().into_iter().flatten() {
                let name = part["name"].as_str().unwrap().to_owned();
                names.insert(number.parse().unwrap(), name);
            }
            Rule { pattern, names }
        })
        .collect()
}

/// What a TextMate reader makes of a line: of all rules the one that fits earliest counts, of
/// these the first. Gives ranges of bytes with their names; what no rule takes has none.
fn scopes(rules: &[Rule], line: &str) -> Vec<(usize, usize, String)> {
    let mut found = Vec::new();
    let mut at = 0;
    while at < line.len() {
        let fits = rules.iter().enumerate().filter_map(|(n, rule)| {
            let captures = rule.pattern.captures_from_pos(line, at).unwrap()?;
            Some((captures.get(0)?.start(), n, captures))
        });
        let Some((_, n, captures)) = fits.min_by_key(|(start, n, _)| (*start, *n)) else { break };
        let whole = captures.get(0).unwrap();
        assert!(!whole.as_str().is_empty(), "a rule takes nothing: {line}");
        for (part, name) in &rules[n].names {
            if let Some(piece) = captures.get(*part) {
                found.push((piece.start(), piece.end(), name.clone()));
            }
        }
        at = whole.end();
    }
    found
}

/// Names of all bytes of a text.
fn named(rules: &[Rule], text: &str) -> Vec<Option<String>> {
    let mut names = vec![None; text.len()];
    let mut start = 0;
    for line in text.split('\n') {
        for (from, to, name) in scopes(rules, line) {
            names[start + from..start + to].fill(Some(name));
        }
        start += line.len() + 1;
    }
    names
}

#[test]
fn every_word_of_every_example_gets_a_name() {
    let rules = rules();
    for (path, text) in texts() {
        let names = named(&rules, &text);
        for (at, c) in text.char_indices() {
            assert!(
                c.is_whitespace() || names[at].is_some(),
                "{path}: nothing takes {c:?} in {:?}",
                text[at..].lines().next()
            );
        }
    }
}

#[test]
fn the_grammar_reads_numbers_comments_and_charts_as_the_program_does() {
    let rules = rules();
    for (path, text) in texts() {
        let names = named(&rules, &text);
        let line = |at: usize| text[at..].lines().next().unwrap_or("");
        for token in scan(&text) {
            let wanted = match token.sort {
                Sort::Number => "constant.numeric",
                Sort::Unit => "keyword.other.unit",
                Sort::Text => "string.quoted",
                Sort::Colour => "constant.other.color",
                Sort::Comment => "comment.line.double-slash",
                Sort::Doc => "comment.line.documentation",
                Sort::Row => "string.unquoted.row",
                _ => continue,
            };
            let found = names[token.start].as_deref().unwrap_or("");
            // `2HB:` and `"EU 38":` are keys.
            let key = found.starts_with("variable.other.property");
            assert!(
                found.starts_with(wanted) || (key && token.sort != Sort::Comment),
                "{path}: {wanted} is {found} in {:?}",
                line(token.start)
            );
        }
    }
}

/// Calls `look` for every statement.
fn walk(statements: &[Statement], look: &mut impl FnMut(&Statement)) {
    for statement in statements {
        look(statement);
        let blocks: Vec<&Block> = match &statement.kind {
            StatementKind::For { body, .. } => vec![body],
            StatementKind::If { then, otherwise, .. } => {
                std::iter::once(then).chain(otherwise).collect()
            }
            StatementKind::Property { block, .. } | StatementKind::Line { block, .. } => {
                block.iter().collect()
            }
            _ => Vec::new(),
        };
        blocks.into_iter().for_each(|block| walk(&block.statements, look));
    }
}

#[test]
fn the_grammar_reads_heads_and_keys_as_the_program_does() {
    let rules = rules();
    let is_word = |name: &str| {
        let mut words = tables().flat_map(|table| table.words);
        words.any(|word| word.name == name && word.form != Form::Property)
    };
    for (path, text) in texts() {
        let names = named(&rules, &text);
        let (tree, told) = parse(FileId(0), &text);
        assert!(told.is_empty(), "{path}: {told:?}");
        walk(&tree.statements, &mut |statement| {
            let (span, wanted) = match &statement.kind {
                StatementKind::Property { key, .. } => (key.span, "variable.other.property"),
                StatementKind::Line { word, .. } if is_word(&word.text) => {
                    (word.span, "keyword.other")
                }
                StatementKind::Let { name, .. } | StatementKind::Param { name, .. } => {
                    (name.span, "variable.other.constant")
                }
                _ => return,
            };
            let found = names[span.start as usize].as_deref().unwrap_or("");
            let line = text[span.start as usize..].lines().next();
            assert!(found.starts_with(wanted), "{path}: {wanted} is {found} in {line:?}");
        });
    }
}

#[test]
fn the_words_of_every_table_are_in_the_grammar() {
    let grammar = read(GRAMMAR);
    let words = grammar::words();
    let of_table = [&words.heads, &words.items, &words.clauses, &words.choices];
    let units: Vec<&str> = darzi::units::known().collect();
    let all = of_table.into_iter().flatten().copied().chain(units);
    for word in all.chain(grammar::LANGUAGE.iter().copied()) {
        let stands = grammar.match_indices(word).any(|(at, _)| {
            let edge = |c: Option<char>| c.is_none_or(|c| !c.is_alphanumeric() && c != '_');
            edge(grammar[..at].chars().next_back())
                && edge(grammar[at + word.len()..].chars().next())
        });
        assert!(stands, "`{word}` is missing");
    }
}

#[test]
fn broken_lines_are_read_to_their_end() {
    let rules = rules();
    for line in
        ["\"open", "|open", "1.", "12foo", "#zz", "}} ((", "a.", "..", "§ €", "1/2", "-> ->"]
    {
        scopes(&rules, line);
    }
}

#[test]
fn the_extension_names_files_that_are_there() {
    let package: Value = serde_json::from_str(&read("editors/vscode/package.json")).unwrap();
    let in_extension = |path: &Value| {
        let path = path.as_str().unwrap().trim_start_matches("./");
        assert!(root().join("editors/vscode").join(path).is_file(), "{path}");
    };
    in_extension(&package["main"]);
    let contributes = &package["contributes"];
    for grammar in contributes["grammars"].as_array().unwrap() {
        in_extension(&grammar["path"]);
        assert_eq!(grammar["scopeName"], "source.garment");
    }
    for language in contributes["languages"].as_array().unwrap() {
        in_extension(&language["configuration"]);
        assert_eq!(language["extensions"][0], ".garment");
    }
    assert_eq!(package["version"], env!("CARGO_PKG_VERSION"));
    let configuration = read("editors/vscode/language-configuration.json");
    let configuration: Value = serde_json::from_str(&configuration).unwrap();
    assert_eq!(configuration["comments"]["lineComment"], "//");
}
