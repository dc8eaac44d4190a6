//! The formatter: what it makes of a text means the same, keeps its comments, and is left as it
//! is the next time.

#![allow(clippy::disallowed_methods, clippy::print_stdout)]

use darzi::diagnostic::{Diagnostic, FileId};
use darzi::syntax::format::format;
use darzi::syntax::parse;
use meaning::meaning;
use proptest::prelude::*;
use proptest::sample::select;
use proptest::strategy::Union;
use std::fs;
use std::path::{Path, PathBuf};

#[path = "fuzz/meaning.rs"]
mod meaning;

/// Formats a sound text and checks what must hold of every one.
fn formatted(text: &str) -> String {
    let new = format(FileId(0), text).unwrap_or_else(|told| panic!("{told:?} in\n{text}"));
    let meant = meaning(text);
    assert!(meant.is_some(), "mistakes in\n{text}");
    assert_eq!(meant, meaning(&new), "from\n{text}\nto\n{new}");
    let again = format(FileId(0), &new).unwrap();
    assert_eq!(new, again, "formatted twice from\n{text}");
    for line in new.lines() {
        assert_eq!(line, line.trim_end(), "blanks at the end of a line of\n{new}");
    }
    assert!(!new.contains("\n\n\n") && !new.starts_with('\n') && !new.ends_with("\n\n"), "{new:?}");
    new
}

/// The text with its lines ended as on other systems.
fn with_line_ends(text: &str) -> String {
    text.replace('\n', "\r\n")
}

fn files(folders: &[&str]) -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut found: Vec<PathBuf> = folders
        .iter()
        .flat_map(|folder| fs::read_dir(root.join(folder)).unwrap())
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|end| end == "garment"))
        .collect();
    found.sort();
    found
}

#[test]
fn all_texts_of_the_project_keep_their_meaning() {
    let mut sound = 0;
    let folders =
        ["examples", "stdlib", "tests/data/tour", "tests/data/words", "tests/data/mistakes"];
    for path in files(&folders) {
        let text = fs::read_to_string(&path).unwrap();
        let (_, told) = parse(FileId(0), &text);
        if told.iter().any(Diagnostic::is_error) {
            assert_eq!(format(FileId(0), &text), Err(told), "{}", path.display());
            continue;
        }
        let new = formatted(&text);
        assert_eq!(notes(&text), notes(&new), "{}", path.display());
        assert_eq!(formatted(&with_line_ends(&text)), with_line_ends(&new));
        sound += 1;
    }
    assert!(sound > 40, "only {sound} texts were formatted");
}

/// `darzi fmt examples stdlib` changes nothing. The texts of pages are looked at in `tests/manual`.
#[test]
fn the_examples_and_the_library_are_formatted() {
    for path in files(&["examples", "stdlib"]) {
        let text = fs::read_to_string(&path).unwrap();
        assert_eq!(formatted(&text), text, "run `darzi fmt {}`", path.display());
    }
}

#[test]
fn a_text_with_mistakes_in_its_shape_is_told_and_not_formatted() {
    for path in files(&["tests/data/errors"]) {
        let text = fs::read_to_string(&path).unwrap();
        let told = format(FileId(0), &text).expect_err("every one of them has mistakes");
        assert!(told.iter().any(Diagnostic::is_error), "{}", path.display());
    }
}

/// The comments of a text without `//` in its strings and charts.
fn notes(text: &str) -> Vec<&str> {
    text.lines().filter_map(|line| line.find("//").map(|at| line[at..].trim_end())).collect()
}

/// The comments of a generated text, which are all numbered.
fn numbered(text: &str) -> Vec<&str> {
    text.split("note").skip(1).map(|rest| rest.split_whitespace().next().unwrap()).collect()
}

type Text = BoxedStrategy<String>;

fn words(words: &'static [&'static str]) -> Text {
    select(words).prop_map(str::to_owned).boxed()
}

fn name() -> Text {
    words(&["a", "waist", "front_side", "काठ", "düğme", "x", "in", "lady", "B2"])
}

fn blank() -> Text {
    words(&[" ", " ", "  ", "\t "])
}

/// A comment up to the end of its line.
fn note() -> Text {
    (0..1000, words(&["//", "// ", "////"]))
        .prop_map(|(n, open)| format!("{open}note{n} \"|{{;\n"))
        .boxed()
}

/// A place where a line may end.
fn may_end() -> Text {
    Union::new_weighted(vec![
        (6, words(&["", " "])),
        (1, words(&["\n", "\n\n   ", " \n\t"])),
        (1, note().prop_map(|note| format!(" {note}  ")).boxed()),
        (1, note().prop_map(|note| format!("\n  {note}\n ")).boxed()),
    ])
    .boxed()
}

fn comma(ends: &Text) -> Text {
    (words(&["", " "]), ends.clone()).prop_map(|(before, end)| format!("{before}, {end}")).boxed()
}

/// Values, whose lines may end where `ends` says.
fn value(ends: Text) -> Text {
    let leaf = Union::new([
        words(&["12cm", "0.5", "1 3/8in", "50%", "1.3e-5N.m", "3µm", "600/m", "7", "2", "-90deg"]),
        words(&["#fa0", "#12345678", "\"a // b\"", "\"é \\\" {|\"", "\"\""]),
        words(&["std::body::female", "width", "काठ", "lady.waist", "-depth"]),
    ]);
    leaf.prop_recursive(4, 24, 4, move |inner| {
        let (end, comma) = (ends.clone(), comma(&ends));
        let many = (inner.clone(), proptest::collection::vec((comma.clone(), inner.clone()), 0..4))
            .prop_map(|(first, rest)| {
                rest.into_iter().fold(first, |all, (comma, next)| all + &comma + &next)
            });
        let inside =
            (end.clone(), many, end.clone()).prop_map(|(a, all, b)| format!("{a}{all}{b}"));
        let inside = inside.boxed();
        Union::new([
            inside.clone().prop_map(|all| format!("({all})")).boxed(),
            inside.clone().prop_map(|all| format!("[{all}]")).boxed(),
            end.clone().prop_map(|end| format!("[{end}]")).boxed(),
            (name(), inside.clone()).prop_map(|(of, all)| format!("{of}({all})")).boxed(),
            (end.clone(), inner.clone(), comma.clone(), inner.clone(), end.clone())
                .prop_map(|(a, v, comma, w, b)| format!("({{{a}side :{v}{comma}काठ: {w}{b}}})"))
                .boxed(),
            (name(), inner.clone()).prop_map(|(of, v)| format!("{of}(p: {v})")).boxed(),
            (name(), inside.clone()).prop_map(|(of, all)| format!("{of}.side[{all}]")).boxed(),
            (name(), inner.clone()).prop_map(|(of, v)| format!("{of}[{v}  from hem]")).boxed(),
            (name(), inner.clone()).prop_map(|(of, v)| format!("{of}.( {v}).end")).boxed(),
            inner.clone().prop_map(|v| format!("(not  {v})")).boxed(),
            (inner.clone(), blank(), inner.clone(), inner.clone())
                .prop_map(|(a, b, c, d)| format!("(if{b}{a}{b}then {c} else{b}{d})"))
                .boxed(),
            (inner.clone(), operator(), inner).prop_map(|(a, op, b)| format!("{a}{op}{b}")).boxed(),
        ])
    })
    .boxed()
}

fn operator() -> Text {
    words(&[
        " + ",
        "+",
        "  -  ",
        " * ",
        " / ",
        " @ ",
        "@",
        "..",
        " .. ",
        " == ",
        "!=",
        " < ",
        " >= ",
        " and ",
        "  or ",
        " +\n   ",
        " ..\n",
        " and\n\n ",
    ])
}

/// Words and values after the first word.
fn phrase(ends: Text) -> Text {
    let value = value(ends.clone());
    let clause = (words(&["to", "leaving", "at", "from", "x", "of"]), blank(), value)
        .prop_map(|(word, blank, value)| format!("{word}{blank}{value}"))
        .boxed();
    let joint = Union::new_weighted(vec![
        (4, blank()),
        (2, comma(&ends)),
        (1, ends.prop_map(|end| format!(" ->{end} ")).boxed()),
        (1, words(&[" = "])),
    ]);
    (clause.clone(), proptest::collection::vec((joint, clause), 0..3), words(&["", "", "", ","]))
        .prop_map(|(first, rest, end)| {
            rest.into_iter().fold(first, |all, (joint, next)| all + &joint + &next) + &end
        })
        .boxed()
}

fn rows() -> Text {
    words(&["|..*..|", "|1100|0011|", "|//|", "| a |", "|\"{|", "|.-|;|"])
}

/// Rows of a chart on lines of their own.
fn drawing() -> Text {
    let end =
        Union::new([words(&["\n", "\n\n\n  "]), note().prop_map(|n| format!(" {n}")).boxed()]);
    (may_end(), rows(), proptest::collection::vec((end, rows()), 0..4))
        .prop_map(|(start, first, rest)| {
            rest.into_iter().fold(format!("{start}{first}"), |all, (end, row)| all + &end + &row)
        })
        .boxed()
}

/// What may stand between two statements on different lines.
fn between() -> Text {
    Union::new_weighted(vec![
        (4, words(&["\n", "\n\n", "\n\n\n\n", ";", " ; ", ";\n"])),
        (1, note().prop_map(|n| format!("  {n}")).boxed()),
        (1, note().prop_map(|n| format!("\n\n {n}\n\n")).boxed()),
        (1, (0..1000).prop_map(|n| format!("\n  ///  note{n}  \n")).boxed()),
    ])
    .boxed()
}

/// Statements with what stands between them; properties may share a line.
fn statements(statement: Text, between: Text) -> Text {
    let shared = (words(&["k", "\"EU 38\"", "2HB"]), value(words(&[""])))
        .prop_map(|(key, value)| format!("   {key}: {value}"));
    let property = (words(&["mass", "size"]), value(words(&[""])), proptest::option::of(shared))
        .prop_map(|(key, value, shared)| format!("{key}: {value}{}", shared.unwrap_or_default()));
    let statement = Union::new_weighted(vec![(3, statement), (1, property.boxed())]);
    (proptest::collection::vec((statement, between.clone()), 0..5), between)
        .prop_map(|(all, last)| {
            let text: String = all.into_iter().map(|(text, end)| text + &end).collect();
            text + if last.contains("///") { "" } else { &last }
        })
        .boxed()
}

/// Statements that take several lines, or one where `flat`.
fn statement(flat: bool) -> Text {
    let ends = if flat { words(&["", " "]) } else { may_end() };
    let between = if flat { words(&[";", "; ", " ;  "]) } else { between() };
    let (v, p) = (value(ends.clone()), phrase(ends.clone()));
    let start = if flat {
        words(&["", " "])
    } else {
        Union::new([words(&["", "\n", "\n\n "]), note().prop_map(|n| format!(" {n}")).boxed()])
            .boxed()
    };
    let leaf = Union::new([
        (name(), words(&["=", " = ", "  ="]), ends.clone(), v.clone())
            .prop_map(|(name, equals, end, value)| format!("let {name}{equals}{end} {value}"))
            .boxed(),
        (name(), words(&["", ": length", " :choice"]), v.clone(), v.clone())
            .prop_map(|(name, kind, value, range)| {
                format!("param  {name}{kind} = {value} in {range}")
            })
            .boxed(),
        words(&["param a", "param b:length", "param c in 1..2"]),
        (name(), ends.clone(), ends.clone(), v.clone())
            .prop_map(|(name, a, b, value)| {
                format!("fn {name} ({a}g:length,{b}e : length=2cm{a}):length={b}{value}")
            })
            .boxed(),
        (ends.clone(), ends.clone())
            .prop_map(|(a, b)| {
                format!("use \"a//b.garment\" :: {{{a}c ,{b}d{a}}},{b} std::x as y, \"z\"::{{w}}")
            })
            .boxed(),
        (words(&["place", "seam", "dart"]), blank(), p.clone())
            .prop_map(|(word, blank, phrase)| format!("{word}{blank}{phrase}"))
            .boxed(),
        words(&["plain", "close"]),
        (name(), words(&[":", " : "]), p.clone())
            .prop_map(|(key, colon, phrase)| format!("{key}{colon}{phrase}"))
            .boxed(),
        if flat { rows() } else { drawing() }.prop_map(|rows| format!("chart: {rows}")).boxed(),
    ]);
    leaf.prop_recursive(3, 24, 4, move |inner| {
        let block = (start.clone(), statements(inner, between.clone()))
            .prop_map(|(start, all)| format!("{{{start}{all}}}"))
            .boxed();
        Union::new([
            (words(&["panel", "yarn"]), name(), block.clone())
                .prop_map(|(word, name, block)| format!("{word} {name}{block}"))
                .boxed(),
            (name(), block.clone()).prop_map(|(key, block)| format!("{key}: {block}")).boxed(),
            (name(), p.clone(), block.clone())
                .prop_map(|(key, phrase, block)| format!("{key}: {phrase} {block}"))
                .boxed(),
            block.clone().prop_map(|block| format!("for i in 1..6 {block}")).boxed(),
            (v.clone(), block.clone(), block.clone(), block)
                .prop_map(|(v, a, b, c)| format!("if ({v}) {a}else if x{b}  else {c}"))
                .boxed(),
        ])
    })
    .boxed()
}

fn program() -> Text {
    let statement = Union::new_weighted(vec![(3, statement(false)), (1, statement(true))]).boxed();
    (words(&["", "\u{FEFF}", "\n\n", "  "]), statements(statement, between()))
        .prop_map(|(start, all)| start + &all)
        .boxed()
}

proptest! {
    #![proptest_config(ProptestConfig {
        failure_persistence: None,
        ..ProptestConfig::with_cases(300)
    })]

    #[test]
    fn any_program_keeps_its_meaning_and_its_comments(text in program()) {
        // A phrase that ends with a comma may swallow what was meant to be the next statement.
        let (_, told) = parse(FileId(0), &text);
        prop_assume!(!told.iter().any(Diagnostic::is_error));
        let new = formatted(&text);
        prop_assert_eq!(numbered(&text), numbered(&new), "from\n{}\nto\n{}", text, new);
        if text.contains('\n') {
            let ends = formatted(&with_line_ends(&text));
            prop_assert_eq!(ends, with_line_ends(&new));
        }
    }
}
