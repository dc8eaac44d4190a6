//! Damaged copies of sound texts: whatever is deleted, doubled or exchanged, reading ends in
//! time and in good order, and every place that is told of lies in the text.

#![allow(clippy::disallowed_methods, clippy::print_stdout)]

mod program;
mod wound;

use darzi::diagnostic::{FileId, Texts, json, render};
use darzi::evaluate::{Options, evaluate};
use darzi::mesh;
use darzi::syntax::format::format;
use darzi::syntax::{parse, tree};
use darzi::world::{Memory, World};
use std::fs;
use std::path::Path;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};
use wound::damaged;

/// Only one test reads at a time, so that the times measured are those of one reader.
static TURN: Mutex<()> = Mutex::new(());

/// Damaged copies of each text.
const COPIES: u64 = 30;

/// Damaged copies of each text, and of each example, that are worked out and cut.
const CUT_COPIES: u64 = 10;
const EXAMPLE_COPIES: u64 = 60;

struct One(String);

impl Texts for One {
    fn path(&self, _: FileId) -> &str {
        "damaged.garment"
    }
    fn text(&self, _: FileId) -> &str {
        &self.0
    }
}

fn texts() -> Vec<(String, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut found = Vec::new();
    for folder in ["tests/data/tour", "tests/data/errors", "stdlib", "examples"] {
        let Ok(entries) = fs::read_dir(root.join(folder)) else { continue };
        for entry in entries {
            let path = entry.unwrap().path();
            if path.extension().is_some_and(|end| end == "garment") {
                found.push((path.display().to_string(), fs::read_to_string(path).unwrap()));
            }
        }
    }
    found.sort();
    assert!(found.len() > 20, "the texts have moved");
    found
}

fn walk(statements: &[tree::Statement], length: u32) {
    for statement in statements {
        assert!(statement.span.start <= statement.span.end && statement.span.end <= length);
        match &statement.kind {
            tree::StatementKind::For { body, .. } => walk(&body.statements, length),
            tree::StatementKind::If { then, otherwise, .. } => {
                walk(&then.statements, length);
                walk(otherwise.as_ref().map_or(&[], |block| &block.statements), length);
            }
            tree::StatementKind::Property { block, .. }
            | tree::StatementKind::Line { block, .. } => {
                walk(block.as_ref().map_or(&[], |block| &block.statements), length);
            }
            _ => {}
        }
    }
}

#[test]
fn damaged_texts_are_read_and_told_of() {
    let _turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
    for (number, (name, text)) in texts().into_iter().enumerate() {
        for copy in 0..COPIES {
            let seed = (number as u64) << 32 | copy;
            let bad = One(damaged(&text, seed));
            let length = u32::try_from(bad.0.len()).unwrap();
            let began = Instant::now();
            let (tree, told) = parse(FileId(0), &bad.0);
            let took = began.elapsed();
            assert!(took < Duration::from_secs(2), "{name}, seed {seed}: {took:?}");
            walk(&tree.statements, length);
            for label in told.iter().flat_map(|told| &told.labels) {
                let (start, end) = (label.span.start as usize, label.span.end as usize);
                assert!(bad.0.get(start..end).is_some(), "{name}, seed {seed}: {label:?}");
            }
            if !told.iter().any(|told| told.is_error()) {
                let new = format(FileId(0), &bad.0).unwrap();
                assert_eq!(format(FileId(0), &new).as_ref(), Ok(&new), "{name}, seed {seed}");
            }
            if copy % 8 == 0 {
                let report = render::report(&told, &bad, false, 80);
                assert!(!report.contains("Failed to read"), "{name}, seed {seed}:\n{report}");
                assert_eq!(json::lines(&told, &bad).lines().count(), told.len());
            }
        }
    }
}

/// Evaluates and cuts hundreds of copies as `check` does, in the profile of the tests, which is
/// some five times slower than the program that is released.
#[test]
fn damaged_texts_are_worked_out_and_cut() {
    let _turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
    let texts = texts();
    for (number, (name, text)) in texts.iter().enumerate() {
        let copies = if name.contains("/examples/") { EXAMPLE_COPIES } else { CUT_COPIES };
        for copy in 0..copies {
            let seed = 1 << 60 | (number as u64) << 32 | copy;
            // The files beside it stay sound, so that what it uses is found.
            let beside = texts.iter().map(|(path, text)| (file_name(path), text.clone()));
            let mut world =
                Memory::new(beside.chain([("bad.garment".into(), wound::copy(text, seed))]));
            let root = world.open("bad.garment").unwrap();
            let began = Instant::now();
            let (garments, told) = evaluate(&mut world, root, &Options::default());
            for garment in &garments {
                // A sound garment is cut, or it is said why it cannot be, before it is cut.
                let options = mesh::Options { atlas: false, ..mesh::Options::default() };
                let refused = mesh::compile(garment, &options).err();
                assert_eq!(mesh::examine(garment).err(), refused, "{name}, seed {seed}");
                if let Some(told) = refused {
                    assert!(told.iter().any(|told| told.is_error()), "{name}, seed {seed}");
                }
            }
            let took = began.elapsed();
            assert!(took < program::AT_ONCE, "{name}, seed {seed}: {took:?}");
            for label in told.iter().flat_map(|told| &told.labels) {
                let (start, end) = (label.span.start as usize, label.span.end as usize);
                let text = world.text(label.span.file);
                assert!(text.get(start..end).is_some(), "{name}, seed {seed}: {label:?}");
            }
        }
    }
}

fn file_name(path: &str) -> String {
    Path::new(path).file_name().unwrap().to_str().unwrap().to_owned()
}

/// Seconds to read `text`, the least of three.
fn seconds(text: &str) -> f64 {
    let time = || {
        let began = Instant::now();
        parse(FileId(0), text);
        began.elapsed().as_secs_f64()
    };
    (0..3).map(|_| time()).fold(f64::INFINITY, f64::min)
}

#[test]
fn time_grows_with_the_text() {
    let _turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
    // Texts made to be read twice: brackets and strings never closed, stray signs, blocks left
    // open, doc comments on nothing, a line without end.
    let pieces = [
        "f(",
        "f(a: {",
        "let a = { b: c, d: ",
        "((((",
        "[[",
        "{ a ",
        "a.(b",
        "\"",
        "///",
        "|..",
        "} ",
        "a: {",
        "if a then ",
        "- ",
        "a + ",
        "§ { b } ",
        "let x = (1 cm\n",
        "a:\n",
        "1 1/",
        "side: line to (3 cm, §\n",
        "not ",
        "x else if y { } ",
        "if x { } else ",
        "a::",
        "/// d\n",
        "use a::{b,",
        "#ff",
        "let a = b -c\n",
        "p(q: ",
        "1..",
        "\r",
        "\u{FEFF}",
    ];
    for piece in pieces {
        let small = piece.repeat(8_000 / piece.len());
        let large = piece.repeat(64_000 / piece.len());
        let (short, long) = (seconds(&small), seconds(&large));
        // Eight times the text, with room for a busy machine: quadratic reading would take 64
        // times as long, many seconds.
        assert!(long < 28.0 * short + 1.0, "{piece:?}: {short} s, then {long} s");
    }
}

#[test]
fn nesting_is_read_at_once_or_refused() {
    let _turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
    for (open, close) in [("(", ")"), ("[", "]"), ("f(", ")"), ("a[", "]"), ("a.(", ")")] {
        let deep = format!("let x = {}1{}", open.repeat(24), close.repeat(24));
        let began = Instant::now();
        let (_, told) = parse(FileId(0), &deep);
        assert!(told.is_empty(), "{open}: {told:?}");
        assert!(began.elapsed() < Duration::from_secs(1));
    }
    let sum = format!("let x = 1{}", " + 1".repeat(5_000));
    let signs = format!("let x = {}1", "-".repeat(5_000));
    let nots = format!("let x = {}a", "not ".repeat(5_000));
    let choices = format!("let x = {}1{}", "if a then ".repeat(3_000), " else 2".repeat(3_000));
    let members = format!("let x = a{}", ".b".repeat(5_000));
    let elses = format!("if a {{ }}{}", " else if a { }".repeat(5_000));
    let blocks = format!("{}{}", "a {\n".repeat(5_000), "}\n".repeat(5_000));
    for text in [sum, signs, nots, choices, members, elses, blocks] {
        let (_, told) = parse(FileId(0), &text);
        let head = &text[..30];
        assert!(told.iter().any(|told| told.code == "E0111"), "{head}: {told:?}");
    }
}

#[test]
fn a_text_that_is_too_long_is_refused() {
    let (tree, told) = parse(FileId(0), &" ".repeat(9 << 20));
    assert!(tree.statements.is_empty());
    assert_eq!(told[0].code, "E0112");
}
