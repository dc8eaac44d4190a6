//! The index of all words, and whether the pages explain them.
//!
//! A word is explained where it stands in code in the first cell of a row of a table, or in a
//! heading, of one of the pages of its kind of block.

use crate::page::{Page, anchor};
use darzi::evaluate::words::{Element, Form, Kind, Word, tables};
use darzi::evaluate::{functions, kinds, places};
use std::collections::BTreeMap;

/// Where the index lies.
pub const PATH: &str = "docs/language/words.md";

/// Words of the language itself, with the page that explains them.
const LANGUAGE: &[(&str, &str)] = &[
    ("use", "modules"),
    ("as", "modules"),
    ("let", "values"),
    ("param", "values"),
    ("in", "values"),
    ("fn", "values"),
    ("if", "values"),
    ("then", "values"),
    ("else", "values"),
    ("for", "values"),
    ("match", "values"),
    ("otherwise", "values"),
    ("and", "values"),
    ("or", "values"),
    ("not", "values"),
    ("with", "panels"),
    ("omit", "panels"),
];

/// The pages that explain the words of a kind of block.
fn pages_of(kind: Kind) -> &'static [&'static str] {
    match kind {
        Kind::File => &["modules", "values", "textiles", "sari", "measures", "scene"],
        Kind::Garment | Kind::Block => {
            &["garment", "panels", "seams", "scene", "measures", "values", "modules"]
        }
        Kind::Part => &["modules"],
        Kind::Panel => &["panels", "shaping", "cutting", "seams", "values"],
        Kind::Outline => &["panels"],
        Kind::Wearer | Kind::Body | Kind::Sizes => &["measures"],
        Kind::Scene | Kind::Cloth | Kind::Solid | Kind::Drape | Kind::Picture => &["scene"],
        Kind::Yarn
        | Kind::Fabric
        | Kind::Kes
        | Kind::Fast
        | Kind::Weave
        | Kind::Knit
        | Kind::Motif
        | Kind::Legend => &["textiles"],
        Kind::Sari | Kind::Ang | Kind::Kath | Kind::Padar => &["sari"],
    }
}

/// The name of a page: `panels`.
fn name(page: &Page) -> &str {
    page.path.rsplit('/').next().unwrap_or("").trim_end_matches(".md")
}

/// What stands in code in a line.
fn code(line: &str) -> impl Iterator<Item = &str> {
    line.split('`').skip(1).step_by(2)
}

/// The words at whose head `code` begins: `dart on EDGE` is of `dart`, `waist:` of `waist`.
fn head(code: &str) -> &str {
    let end = code.find(|sign: char| !(sign.is_alphanumeric() || sign == '_' || sign == '"'));
    &code[..end.unwrap_or(code.len())]
}

/// Where a page explains a word: the anchors of the headings above. Words of the table stand at
/// the head of what is written, those of the language (`is`) anywhere in it.
fn explained(page: &Page, word: &str, is: fn(&str, &str) -> bool) -> Vec<String> {
    let mut found = Vec::new();
    let mut above = String::new();
    for (_, line) in page.prose() {
        let cell = line.strip_prefix("| ").and_then(|row| row.split(" |").next());
        let heading = line.strip_prefix('#');
        if let Some(heading) = heading {
            above = anchor(heading.trim_start_matches('#').trim());
        }
        if heading.or(cell).is_some_and(|text| code(text).any(|code| is(code, word))) {
            found.push(above.clone());
        }
    }
    found
}

fn begins(code: &str, word: &str) -> bool {
    head(code) == word
}

fn holds(code: &str, word: &str) -> bool {
    code.split(|sign: char| !(sign.is_alphanumeric() || sign == '_')).any(|part| part == word)
}

/// The pages that explain a word, as links; of several places on a page the one below a heading
/// of its kind of block, else the first.
fn links(
    pages: &[Page],
    word: &str,
    among: &[&str],
    kind: &str,
    is: fn(&str, &str) -> bool,
) -> Vec<String> {
    let kind = kind.split(' ').next().unwrap_or("").to_lowercase();
    among
        .iter()
        .filter_map(|wanted| pages.iter().find(|page| name(page) == *wanted))
        .filter_map(|page| {
            let found = explained(page, word, is);
            let own = found.iter().find(|anchor| anchor.split('-').any(|part| part == kind));
            let at = own.or(found.first())?;
            Some(format!("[{0}]({0}.md#{at})", name(page)))
        })
        .collect()
}

/// Words of the clauses and choices of a line.
fn inner(word: &Word) -> Vec<&'static str> {
    let pattern = word.read();
    let clauses = pattern.clauses.iter();
    let mut found: Vec<&'static str> = clauses.clone().map(|clause| clause.word).collect();
    for element in pattern.head.iter().chain(clauses.flat_map(|clause| &clause.elements)) {
        match element {
            Element::Literal(word) => found.push(word),
            Element::Operand { choice, .. } => found.extend(choice),
            Element::Rest => {}
        }
    }
    found.retain(|word| word.chars().all(|sign| sign.is_alphanumeric() || sign == '_'));
    found
}

/// The default that the help of a property ends with: `side of the cells =8mm`.
fn default_of(word: &Word) -> Option<&'static str> {
    let (_, rest) = word.help.split_once(" =").filter(|_| word.form == Form::Property)?;
    if rest.starts_with(' ') {
        return None;
    }
    let end = if rest.starts_with('(') { rest.find(')')? + 1 } else { rest.len() };
    Some(rest[..end].split([';', ':']).next().unwrap_or(rest))
}

/// Whether a row of a word says its default.
fn says_default(page: &Page, word: &str, default: &str) -> bool {
    page.prose().any(|(_, line)| {
        let cell = line.strip_prefix("| ").and_then(|row| row.split(" |").next());
        cell.is_some_and(|cell| code(cell).any(|code| begins(code, word)))
            && line.replace('`', "").contains(default)
    })
}

/// Everything the program knows that the manual does not explain.
pub fn unexplained(pages: &[Page]) -> Vec<String> {
    let mut wrong = Vec::new();
    let find = |wanted: &str| pages.iter().find(|page| name(page) == wanted);
    for table in tables() {
        let among = pages_of(table.kind);
        // A word of a clause may stand anywhere in code, in prose or in an example.
        let mut spoken: Vec<&str> = Vec::new();
        for page in among.iter().filter_map(|page| find(page)) {
            let prose = page.prose().flat_map(|(_, line)| code(line));
            let blocks = page.blocks.iter().map(|block| &*block.text);
            let words = prose
                .chain(blocks)
                .flat_map(|text| text.split(|sign: char| !(sign.is_alphanumeric() || sign == '_')));
            spoken.extend(words);
        }
        for word in table.words {
            let of = table.kind.title();
            if links(pages, word.name, among, table.kind.noun(), begins).is_empty() {
                wrong.push(format!("`{}` of {of} is explained in none of {among:?}", word.name));
            }
            if let Some(default) = default_of(word)
                && !among
                    .iter()
                    .filter_map(|page| find(page))
                    .any(|page| says_default(page, word.name, default))
            {
                wrong.push(format!("the default of `{}` of {of} is {default}", word.name));
            }
            for clause in inner(word).into_iter().filter(|clause| !spoken.contains(clause)) {
                wrong
                    .push(format!("`{clause}` of `{}` of {of} is in none of {among:?}", word.name));
            }
        }
    }
    let mut want = |word: &str, page: &str| {
        if find(page).is_none_or(|page| explained(page, word, holds).is_empty()) {
            wrong.push(format!("`{word}` is not explained in {page}.md"));
        }
    };
    LANGUAGE.iter().for_each(|(word, page)| want(word, page));
    functions().for_each(|(function, _)| want(function, "values"));
    kinds().for_each(|kind| want(kind, "values"));
    darzi::units::known().for_each(|unit| want(unit, "text"));
    let sided = |place: &String| !place.starts_with("left_") && !place.starts_with("right_");
    places().filter(sided).for_each(|place| want(&place, "measures"));
    wrong
}

/// The page of all words.
pub fn index(pages: &[Page]) -> String {
    let mut rows: BTreeMap<(&str, String, String), (Vec<&str>, Vec<String>)> = BTreeMap::new();
    for table in tables() {
        for word in table.words {
            // A bar would end the cell of the table.
            let usage = word.usage().replace('|', "\\|");
            let row = (word.name, usage, word.help.replace('|', "\\|"));
            let (of, links_of) = rows.entry(row).or_default();
            let kind = table.kind.noun();
            of.push(kind);
            links_of.extend(links(pages, word.name, pages_of(table.kind), kind, begins));
        }
    }
    for (word, page) in LANGUAGE {
        let links = links(pages, word, &[page], "", holds);
        let row = (*word, (*word).to_owned(), "a word of the language itself".to_owned());
        rows.insert(row, (vec!["any block"], links));
    }
    for (function, usage) in functions() {
        let links = links(pages, function, &["values"], "", begins);
        let row = (function, usage.to_owned(), "a function".to_owned());
        rows.entry(row).or_insert((vec!["value"], links));
    }
    let mut text = String::from(
        "# All words\n\n\
         Made from the program's own table of words by `UPDATE=1 cargo test --test manual`.\n\n\
         `[…]` may be left out; of `(a | b)` one must be said, of `[a | b]` one may be said; words \
         in CAPITALS stand\nfor values; clauses may come in any order.\n\n\
         | word | in | written | what it does | explained in |\n|---|---|---|---|---|\n",
    );
    for ((word, usage, help), (of, mut links)) in rows {
        links.sort();
        links.dedup();
        let (of, links) = (of.join(", "), links.join(", "));
        text.push_str(&format!("| `{word}` | {of} | `{usage}` | {help} | {links} |\n"));
    }
    text
}
