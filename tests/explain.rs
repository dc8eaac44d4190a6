//! The pages of `darzi explain` tell the truth: the wrong texts give their code, the right ones
//! none.

#![allow(clippy::disallowed_methods, clippy::print_stdout)]

use darzi::diagnostic::page::{Example, Page, pages};
use darzi::diagnostic::{Diagnostic, FileId, render};
use darzi::evaluate::{Options, evaluate};
use darzi::syntax::format::format;
use darzi::world::{Memory, World};
use darzi::{body, mesh};
use std::fs;
use std::path::Path;

/// Marks the pages of codes that `darzi check` does not tell.
const OF_BODIES: &str = "*Told when the body is made";
/// Marks the pages of codes that are kept for what is not there yet.
const NOT_YET: &str = "*Not told yet";
/// Marks the pages of codes whose texts are not shown.
const NO_EXAMPLE: &str = "*No example";

/// What `darzi check` says of the wrong or the right text of a page, and what is said of its
/// bodies.
fn told(page: &Page, right: bool) -> (Memory, Vec<Diagnostic>) {
    let texts: Vec<Example> = page.examples().filter(|example| example.right == right).collect();
    let path = |example: &Example| example.file.unwrap_or("main.garment");
    let mut world = Memory::new(texts.iter().map(|example| (path(example), example.text)));
    let root = world.open("main.garment").unwrap();
    let set = texts
        .iter()
        .filter_map(|example| example.set?.split_once('='))
        .map(|(name, value)| (name.to_owned(), value.to_owned()))
        .collect();
    let options = Options { set, ..Options::default() };
    let (garments, mut told) = evaluate(&mut world, root, &options);
    for garment in &garments {
        // A cloth that is a little coarser is cut as a fine one is, without the picture of its
        // textiles; where the grid itself is the matter it is the one of the command.
        let coarsen = if page.code.starts_with("E081") { 1.0 } else { 1.001 };
        let options = mesh::Options { coarsen, ..mesh::Options::default() };
        told.extend(mesh::compile(garment, &options).err().unwrap_or_default());
        if page.text.contains(OF_BODIES) {
            let bodies = garment.bodies.iter().filter_map(|body| body::mannequin(body).err());
            told.extend(bodies.flatten());
        }
    }
    (world, told)
}

#[test]
fn wrong_texts_give_their_code_and_right_texts_none() {
    let mut wrong = Vec::new();
    for page in pages().filter(|page| page.examples().next().is_some()) {
        let (world, said) = told(&page, false);
        if said.first().is_none_or(|first| first.code != page.code) {
            let report = render::report(&said, &world, false, 100);
            wrong.push(format!("the wrong text of {} gives\n{report}", page.code));
        }
        let (world, said) = told(&page, true);
        if !said.is_empty() {
            let report = render::report(&said, &world, false, 100);
            wrong.push(format!("the right text of {} gives\n{report}", page.code));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Texts with mistakes: those of the pages, and those whose messages are kept.
fn mistaken() -> Vec<(String, String)> {
    let mut texts: Vec<(String, String)> = pages()
        .filter_map(|page| {
            let mut wrong = page.examples().filter(|example| !example.right);
            let first = wrong.next().filter(|example| example.file.is_none())?;
            wrong.next().is_none().then(|| (page.code.to_owned(), first.text.to_owned()))
        })
        .collect();
    for folder in ["tests/data/errors", "tests/data/mistakes"] {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
        let mut paths: Vec<_> =
            fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
        paths.sort();
        for path in paths.iter().filter(|path| path.extension().is_some_and(|e| e == "garment")) {
            texts.push((path.display().to_string(), fs::read_to_string(path).unwrap()));
        }
    }
    texts
}

/// What a message says to write is right: typed in its place, that message is gone. Editors type
/// it for the writer.
#[test]
fn what_a_label_says_to_write_helps() {
    let told = |text: &str| {
        let mut world = Memory::new([("main.garment", text)]);
        let root = world.open("main.garment").unwrap();
        (root, evaluate(&mut world, root, &Options::default()).1)
    };
    let mut typed = 0;
    let mut wrong = Vec::new();
    for (name, text) in mistaken() {
        let (root, before) = told(&text);
        for diagnostic in &before {
            for label in diagnostic.labels.iter().filter(|label| label.span.file == root) {
                let Some(new) = label.suggestion() else { continue };
                let mut text = text.clone();
                text.replace_range(label.span.start as usize..label.span.end as usize, new);
                let (_, after) = told(&text);
                let same = |all: &[Diagnostic]| {
                    let alike = |d: &&Diagnostic| {
                        (&d.code, &d.message) == (&diagnostic.code, &diagnostic.message)
                    };
                    all.iter().filter(alike).count()
                };
                if same(&after) >= same(&before) {
                    let said = &diagnostic.message;
                    wrong.push(format!("{name}: `{new}` does not help where {said}"));
                }
                typed += 1;
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(typed > 50, "only {typed} messages say what to write");
}

#[test]
fn pages_without_examples_say_why() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut sources = String::new();
    gather(&root.join("src"), &mut sources);
    for page in pages() {
        let examples = page.examples().count();
        let [yet, no] = [NOT_YET, NO_EXAMPLE].map(|mark| page.text.contains(mark));
        assert_eq!(examples == 0, yet || no, "{}", page.code);
        assert_ne!((yet, no), (true, true), "{}", page.code);
        let quoted = sources.contains(&format!("\"{}\"", page.code));
        assert_eq!(quoted, !yet, "{}: is it told by now, or no more?", page.code);
    }
}

/// All sources but the table of codes.
fn gather(folder: &Path, sources: &mut String) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            gather(&path, sources);
        } else if !path.ends_with("codes.rs") {
            sources.push_str(&fs::read_to_string(&path).unwrap());
        }
    }
}

#[test]
fn texts_that_are_too_long_to_be_shown_are_told_all_the_same() {
    let blank = " ".repeat(9 << 20);
    let senseless = "a:\n".repeat(100_000);
    let links = (0..20_000).map(|i| format!("let a{i} = a{} + 1cm\n", i + 1));
    let chain = links.collect::<String>() + "let a20000 = 1cm";
    let texts = [("E0112", blank), ("E0118", senseless), ("E0211", chain)];
    let long = pages().filter(|page| page.text.contains("*No example: it would be too long"));
    assert!(long.map(|page| page.code).eq(texts.iter().map(|(code, _)| *code)));
    for (code, text) in texts {
        let mut world = Memory::new([("main.garment", text)]);
        let root = world.open("main.garment").unwrap();
        let (_, told) = evaluate(&mut world, root, &Options::default());
        assert!(told.iter().any(|told| told.code == code), "{code}");
    }
}

#[test]
fn right_texts_are_formatted() {
    for page in pages() {
        let garment =
            |example: &Example| example.file.is_none_or(|file| file.ends_with(".garment"));
        let right = page.examples().filter(|example| example.right && garment(example));
        for Example { text, .. } in right {
            assert_eq!(format(FileId(0), text).as_deref(), Ok(text), "{}", page.code);
        }
    }
}
