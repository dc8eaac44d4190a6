//! The syntax file for Vim and Neovim, made from the program's own tables.

use super::grammar::{LANGUAGE, words};
use std::fmt::Write;

/// The whole file.
pub fn syntax() -> String {
    let words = words();
    let units: Vec<&str> = darzi::units::known().collect();
    let functions: Vec<&str> = darzi::evaluate::functions().map(|(name, _)| name).collect();
    let mut out = String::from(
        "\" Made from the tables of darzi by `UPDATE=1 cargo test --test editors`.\n\
         if exists(\"b:current_syntax\")\n  finish\nendif\n\n\
         syn match garmentName \"\\<\\K\\k*\"\n",
    );
    let mut list = |group: &str, found: &mut dyn Iterator<Item = &str>| {
        for word in found {
            // A keyword would win over every match; a word of the table may also be a name.
            let _ = writeln!(out, "syn match {group} \"\\<{word}\\>\"");
        }
    };
    list("garmentChoice", &mut words.choices.iter().copied());
    list("garmentClause", &mut words.clauses.iter().copied());
    list("garmentLanguage", &mut LANGUAGE.iter().copied());
    let functions = functions.join("\\|");
    let _ = writeln!(out, "syn match garmentFunction \"\\<\\%({functions}\\)\\ze(\"");
    for word in words.heads.iter().chain(&words.items) {
        let _ = writeln!(out, "syn match garmentHead \"\\%(^\\|[;{{:]\\)\\s*\\zs{word}\\>\"");
    }
    let units = units.join("\\|");
    out.push_str(
        "syn match garmentName \"\\%(\\<\\%(let\\|param\\)\\s\\+\\)\\@<=\\K\\k*\"\n\
         syn match garmentMember \"\\.\\@<=\\K\\k*\"\n\
         syn match garmentKey \"\\%(\\d\\?\\K\\k*\\|\\\"[^\\\"]*\\\"\\)\\ze\\s*:\\%([^:]\\|$\\)\"\n\
         syn match garmentNumber \"\\<\\d\\+\\%(\\.\\d\\+\\)\\?\\%([eE][+-]\\?\\d\\+\\)\\?\" nextgroup=garmentUnit\n",
    );
    let _ = writeln!(
        out,
        "syn match garmentUnit contained \"%\\|/\\?\\%({units}\\)\\d*\\%([./]\\%({units}\\)\\d*\\)*\""
    );
    out.push_str(
        "syn match garmentColour \"#\\x\\+\"\n\
         syn match garmentRow \"|.*|\"\n\
         syn match garmentText \"\\\"\\%([^\\\"\\\\]\\|\\\\.\\)*\\\"\\%(\\s*:\\)\\@!\"\n\
         syn match garmentComment \"//.*$\" contains=@Spell\n\
         syn match garmentDoc \"///\\%([^/].*\\)\\?$\" contains=@Spell\n\n",
    );
    for (group, like) in [
        ("Language", "Keyword"),
        ("Head", "Statement"),
        ("Clause", "Statement"),
        ("Choice", "Constant"),
        ("Function", "Function"),
        ("Key", "Identifier"),
        ("Number", "Number"),
        ("Unit", "Type"),
        ("Colour", "Constant"),
        ("Row", "String"),
        ("Text", "String"),
        ("Comment", "Comment"),
        ("Doc", "SpecialComment"),
    ] {
        let _ = writeln!(out, "hi def link garment{group} {like}");
    }
    out.push_str(
        "if has(\"nvim\")\n  hi def link @lsp.type.unit.garment Type\nendif\n\n\
         let b:current_syntax = \"garment\"\n",
    );
    out
}
