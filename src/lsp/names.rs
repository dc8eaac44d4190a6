//! Names that are known at a place, as far as the words of the text show it.

use super::outline::{Outline, Statement};
use super::scan::Sort as Piece;
use crate::evaluate::facts::Sort;
use crate::evaluate::words::{Form, Kind};
use std::collections::BTreeSet;

/// Copies of copies that are followed.
const COPIES: usize = 8;

/// A name that a statement gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Given<'t> {
    /// The name.
    pub name: &'t str,
    /// Its token.
    pub token: usize,
    /// What it is.
    pub sort: Sort,
    /// The statement.
    pub statement: usize,
}

/// The name that a statement gives, in the block it stands in.
pub fn given<'t>(outline: &Outline, text: &'t str, number: usize) -> Option<Given<'t>> {
    let statement = outline.statements.get(number)?;
    let head = statement.head?;
    let at = |token: usize, sort: Sort| {
        let is_word = outline.tokens.get(token)?.sort == Piece::Word;
        let inside = statement.tokens.contains(&token);
        (is_word && inside).then(|| Given {
            name: outline.slice(text, token),
            token,
            sort,
            statement: number,
        })
    };
    if let Some(word) = statement.word {
        return match (word.form, statement.key) {
            (Form::Item, _) => at(head + 1, Sort::Item(word.block.unwrap_or(Kind::File))),
            (Form::Property, _) => None,
            (Form::Action, Some(key)) => {
                let kind = outline.blocks.get(statement.within)?.kind;
                let edge = kind == Some(Kind::Outline) || word.name == "hole";
                at(key, if edge { Sort::Edge } else { Sort::Label })
            }
            (Form::Action, None) => match word.name {
                "fit" => at(head + 1, Sort::Value),
                "mark" => at(head + 1, Sort::Edge),
                _ => None,
            },
        };
    }
    match outline.slice(text, head) {
        _ if statement.key.is_some() => None,
        "let" => at(head + 1, Sort::Value),
        "param" => at(head + 1, Sort::Parameter),
        "fn" => at(head + 1, Sort::Function),
        _ => None,
    }
}

/// All names that are known at a byte of a text, the nearest first.
pub fn visible<'t>(outline: &Outline, text: &'t str, at: usize) -> Vec<Given<'t>> {
    let mut found = Vec::new();
    let children = children(outline);
    let inner = outline.block_at(at);
    for block in outline.around(inner) {
        collect(outline, text, &children, block, 0, &mut found);
        if let Some(opener) = outline.blocks.get(block).and_then(|block| block.opener) {
            found.extend(counter(outline, text, opener));
        }
    }
    if let Some(number) = outline.statement_at(at) {
        formals(outline, text, number, &mut found);
    }
    let mut seen = BTreeSet::new();
    found.retain(|given| seen.insert(given.name));
    found
}

/// Statements by the block they stand in.
fn children(outline: &Outline) -> Vec<Vec<usize>> {
    let mut children = vec![Vec::new(); outline.blocks.len()];
    for (number, statement) in outline.statements.iter().enumerate() {
        if let Some(list) = children.get_mut(statement.within) {
            list.push(number);
        }
    }
    children
}

/// Names of one block: its own, those of its outline, those it copies.
fn collect<'t>(
    outline: &Outline,
    text: &'t str,
    children: &[Vec<usize>],
    block: usize,
    depth: usize,
    found: &mut Vec<Given<'t>>,
) {
    if depth > COPIES {
        return;
    }
    for &number in children.get(block).into_iter().flatten() {
        found.extend(given(outline, text, number));
        let Some(statement) = outline.statements.get(number) else { continue };
        let Some(inner) = statement.block else { continue };
        let kind = outline.blocks.get(inner).and_then(|inner| inner.kind);
        // Names in loops and choices are known around them.
        if kind == Some(Kind::Outline) || statement.word.is_none() {
            collect(outline, text, children, inner, depth + 1, found);
        }
    }
    let opener = outline.blocks.get(block).and_then(|block| block.opener);
    if let Some(base) = opener.and_then(|opener| base(outline, text, opener)) {
        collect(outline, text, children, base, depth + 1, found);
    }
}

/// The block of the item that an item copies: `panel back = front with { … }`.
pub fn base(outline: &Outline, text: &str, opener: usize) -> Option<usize> {
    let statement = outline.statements.get(opener)?;
    let word = statement.word.filter(|word| word.form == Form::Item)?;
    let mut tokens = statement.tokens.clone();
    let sign = tokens.find(|token| outline.slice(text, *token) == "=")?;
    let name = outline.slice(text, sign + 1);
    outline.statements.iter().enumerate().find_map(|(number, other)| {
        // A part opens a block.
        let wanted = if word.block == Some(Kind::Part) { Some(Kind::Block) } else { word.block };
        let same = number != opener
            && other.word.is_some_and(|w| w.form == Form::Item && w.block == wanted)
            && other.head.is_some_and(|head| outline.slice(text, head + 1) == name);
        if same { other.block } else { None }
    })
}

/// The counting name of `for i in … { … }`.
fn counter<'t>(outline: &Outline, text: &'t str, opener: usize) -> Option<Given<'t>> {
    let statement = outline.statements.get(opener)?;
    let head = statement.head.filter(|head| outline.slice(text, *head) == "for")?;
    let name = outline.tokens.get(head + 1).filter(|token| token.sort == Piece::Word)?;
    let name = text.get(name.start..name.end)?;
    Some(Given { name, token: head + 1, sort: Sort::Value, statement: opener })
}

/// Names in the brackets of `fn f(a: length, b: length = 1cm) = …`.
fn formals<'t>(outline: &Outline, text: &'t str, number: usize, found: &mut Vec<Given<'t>>) {
    let Some(statement) = outline.statements.get(number) else { return };
    if statement.head.is_none_or(|head| outline.slice(text, head) != "fn") {
        return;
    }
    for token in names_before_colons(outline, text, statement) {
        let name = outline.slice(text, token);
        found.push(Given { name, token, sort: Sort::Value, statement: number });
    }
}

/// Tokens of the formals of a function.
pub fn names_before_colons(outline: &Outline, text: &str, statement: &Statement) -> Vec<usize> {
    let tokens = statement.tokens.clone().skip(2);
    let end = |token: &usize| outline.slice(text, *token) != ")";
    tokens
        .take_while(end)
        .filter(|token| {
            outline.tokens.get(*token).is_some_and(|t| t.sort == Piece::Word)
                && outline.slice(text, *token + 1) == ":"
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::outline::read;
    use super::*;

    fn at_mark(text: &str) -> Vec<String> {
        let at = text.find('§').unwrap();
        let text = text.replace('§', "");
        let outline = read(&text);
        visible(&outline, &text, at).iter().map(|given| given.name.to_owned()).collect()
    }

    #[test]
    fn names_of_blocks_around_are_known_and_those_of_others_are_not() {
        let text = "let a = 1\ngarment g {\n param b = 2cm\n wearer lady = female\n \
                    panel front of denim {\n  let c = 3\n  outline from (0, 0) {\n   \
                    hem: line to (§\n  }\n  shaping: dart on hem\n }\n \
                    panel back of denim { let d = 4 }\n}";
        assert_eq!(at_mark(text), ["hem", "c", "shaping", "b", "lady", "front", "back", "a", "g"]);
    }

    #[test]
    fn a_copy_knows_the_names_of_its_original() {
        let text = "garment g {\n panel front of denim {\n  let c = 3\n  outline from (0, 0) {\n   \
                    hem: line to start\n  }\n }\n panel back = front with {\n  §\n }\n}";
        assert_eq!(at_mark(text), ["c", "hem", "front", "back", "g"]);
    }

    #[test]
    fn loops_count_and_functions_have_arguments() {
        assert_eq!(at_mark("for i in 1..3 {\n let a = §\n}"), ["a", "i"]);
        assert_eq!(at_mark("fn half(w: length): length = § / 2"), ["half", "w"]);
    }
}
