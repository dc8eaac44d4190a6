//! The manual tells the truth. Every `garment` block of the documentation is read and cut: whole
//! texts and fragments in their frames give no messages, those with codes give these codes, and a
//! listing below them is what the program prints. Links lead somewhere, calls of the program are
//! known, and every word of the language is explained.
//!
//! Behind `garment` at the head of a block may stand: codes that it gives; `in NAME`, the frame in
//! which it is read, and `frame NAME` at a frame; `picture NAME`, the drawing of its pieces; the
//! path of a file that the page's other texts may use; `of PATH` at an excerpt of a file;
//! `--set NAME=VALUE` and `--for SIZE`.
//!
//! After a change of messages or words: `UPDATE=1 cargo test --test manual`.

#![allow(clippy::disallowed_methods)]

mod commands;
mod drawing;
mod index;
mod page;

use darzi::diagnostic::{Diagnostic, FileId, codes, render};
use darzi::evaluate::{Options, evaluate};
use darzi::garment::Garment;
use darzi::garment::panel::Panel;
use darzi::mesh;
use darzi::syntax::format::format;
use darzi::world::{Memory, World};
use page::{Block, HOLE, Page};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// How wide the program writes where nobody looks.
const WIDTH: usize = 100;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).to_owned()
}

fn update() -> bool {
    std::env::var_os("UPDATE").is_some()
}

/// The pages of a folder, in the order of their names.
fn pages_in(folder: &str) -> Vec<Page> {
    let mut paths: Vec<String> = std::fs::read_dir(root().join(folder))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| name.ends_with(".md"))
        .map(|name| format!("{folder}/{name}"))
        .collect();
    paths.sort();
    paths.iter().map(|path| Page::read(&root(), path)).collect()
}

/// The pages of the manual.
fn manual() -> Vec<Page> {
    pages_in("docs/language")
}

/// All pages of which the texts are tried. Those of `docs/errors` are tried in `tests/explain.rs`.
fn documentation() -> Vec<Page> {
    let mut pages = manual();
    pages.extend(pages_in("docs"));
    pages.push(Page::read(&root(), "README.md"));
    pages
}

/// The frames that pages name, each with the lines in it of which one is the hole.
fn frames(pages: &[Page]) -> BTreeMap<String, String> {
    let mut frames = BTreeMap::new();
    for block in pages.iter().flat_map(|page| &page.blocks) {
        if let Some(name) = &block.names {
            let before = frames.insert(name.clone(), block.text.clone());
            assert!(before.is_none(), "two frames are called `{name}`");
        }
    }
    frames
}

/// A fragment in its frame, set in as far as the hole.
fn framed(block: &Block, frames: &BTreeMap<String, String>) -> String {
    let Some(name) = &block.frame else { return block.text.clone() };
    let frame = frames.get(name).unwrap_or_else(|| panic!("no frame is called `{name}`"));
    let mut text = String::new();
    for line in frame.lines() {
        let Some((indent, _)) = line.split_once(HOLE) else {
            text.push_str(line);
            text.push('\n');
            continue;
        };
        for line in block.text.lines() {
            let line = format!("{indent}{line}\n");
            text.push_str(if line.trim().is_empty() { "\n" } else { &line });
        }
    }
    text
}

/// What the program makes of a text and says of it, with the files of its page at hand.
fn told(block: &Block, text: &str, files: &[&Block]) -> (Memory, Vec<Garment>, Vec<Diagnostic>) {
    let name = block.file.as_deref().unwrap_or("main.garment");
    let others = files.iter().filter_map(|other| Some((other.file.as_deref()?, &*other.text)));
    let others = others.filter(|(other, _)| *other != name);
    let mut world = Memory::new(others.chain([(name, text)]));
    let root = world.open(name).unwrap();
    let options =
        Options { set: block.set.clone(), size: block.size.clone(), ..Options::default() };
    let (garments, mut told) = evaluate(&mut world, root, &options);
    for garment in &garments {
        let options = mesh::Options { atlas: false, ..mesh::Options::default() };
        told.extend(mesh::compile(garment, &options).err().unwrap_or_default());
    }
    (world, garments, told)
}

/// The block of a formatted text that stands in the frame's place, without its indentation.
fn unframed(block: &Block, formatted: &str, frames: &BTreeMap<String, String>) -> String {
    let Some(frame) = block.frame.as_ref().and_then(|name| frames.get(name)) else {
        return formatted.to_owned();
    };
    let before = frame.lines().position(|line| line.contains(HOLE)).unwrap();
    let indent = frame.lines().nth(before).and_then(|line| line.find(HOLE)).unwrap();
    let count = formatted.lines().count() + 1 - frame.lines().count();
    let lines = formatted.lines().skip(before).take(count);
    lines.map(|line| format!("{}\n", line.get(indent..).unwrap_or(""))).collect()
}

/// The first line of an excerpt that does not stand in its file, behind the one before it.
fn foreign_line(excerpt: &str, file: &str) -> Option<String> {
    let text = std::fs::read_to_string(root().join(file)).unwrap();
    let mut lines = text.lines().map(str::trim);
    let mut wanted = excerpt.lines().map(str::trim).filter(|line| !line.is_empty());
    wanted.find(|wanted| !lines.any(|line| line == *wanted)).map(str::to_owned)
}

/// Whether a page shows the drawing of a text as it is now.
fn drawn(page: &Page, name: &str, made: &str) -> Option<String> {
    let file = format!("{}/{name}.svg", drawing::FOLDER);
    if update() {
        std::fs::write(root().join(&file), made).unwrap();
    }
    if std::fs::read_to_string(root().join(&file)).unwrap_or_default() != made {
        return Some(format!("{}: {file} is another, `UPDATE=1` draws it anew", page.path));
    }
    let shown = page.text.contains(&format!("](pictures/{name}.svg)"));
    (!shown).then(|| format!("{}: {file} is not shown", page.path))
}

/// Tries the blocks of a page: what is wrong with it, and the page with its listings and the layout
/// of its texts made anew.
fn tried(page: &Page, frames: &BTreeMap<String, String>) -> (Vec<String>, String) {
    let mut wrong = Vec::new();
    let mut renewed: Vec<String> = page.text.lines().map(str::to_owned).collect();
    let mut renewals = Vec::new();
    for (number, block) in page.blocks.iter().enumerate() {
        if block.language != "garment" || block.names.is_some() {
            continue;
        }
        // A file of another program is tried by the text that uses it.
        if block.file.as_ref().is_some_and(|file| !file.ends_with(".garment")) {
            continue;
        }
        let place = format!("{}:{}", page.path, block.line);
        if let Some(file) = &block.source {
            if let Some(line) = foreign_line(&block.text, file) {
                wrong.push(format!("{place}: `{line}` is not in {file}, or not in this order"));
            }
            if format(FileId(0), &block.text).as_deref() != Ok(&block.text) {
                wrong.push(format!("{place} is not laid out"));
            }
            continue;
        }
        let files: Vec<&Block> = page.blocks.iter().filter(|other| other.file.is_some()).collect();
        let text = framed(block, frames);
        let (world, garments, said) = told(block, &text, &files);
        let report = render::report(&said, &world, false, WIDTH);
        let codes: Vec<&str> = said.iter().map(|said| &*said.code).collect();
        if codes != block.codes {
            wrong.push(format!("{place} gives {codes:?}, not {:?}\n{report}", block.codes));
        }
        if let Some(name) = &block.picture {
            let panels: Vec<Panel> = garments.into_iter().flat_map(|it| it.panels).collect();
            wrong.extend(drawn(page, name, &drawing::drawing(&panels)));
        }
        if block.codes.is_empty() {
            let formatted = format(FileId(0), &text);
            if formatted.as_deref() != Ok(&text) {
                let formatted = formatted.unwrap_or_default();
                wrong.push(format!("{place} is not laid out; it should be\n{formatted}"));
                if !formatted.is_empty() {
                    let text = unframed(block, &formatted, frames);
                    renewals.push((block.line, block.text.lines().count(), text));
                }
            }
            continue;
        }
        if let Some(listing) = page.listing(number) {
            let report = format!("{report}`darzi explain {}` says more", block.codes[0]);
            if listing.text.trim_end() != report {
                wrong.push(format!("{place}: the listing is another; it should be\n{report}"));
            }
            renewals.push((listing.line, listing.text.lines().count(), report));
        }
    }
    for (line, count, text) in renewals.into_iter().rev() {
        renewed.splice(line..line + count, [text.trim_end().to_owned()]);
    }
    (wrong, renewed.join("\n") + "\n")
}

#[test]
fn texts_are_right_or_give_their_codes() {
    let pages = documentation();
    let frames = frames(&pages);
    let results: Vec<_> = pages.par_iter().map(|page| tried(page, &frames)).collect();
    let mut all = Vec::new();
    for (page, (wrong, renewed)) in pages.iter().zip(results) {
        if update() && renewed != page.text {
            std::fs::write(root().join(&page.path), renewed).unwrap();
        }
        all.extend(wrong);
    }
    assert!(
        all.is_empty(),
        "{}\n\n`UPDATE=1` renews listings, layout and drawings",
        all.join("\n")
    );
}

#[test]
fn links_lead_somewhere() {
    let mut pages = documentation();
    pages.extend(pages_in("docs/errors"));
    pages.push(Page::read(&root(), "CONTRIBUTING.md"));
    let mut wrong = Vec::new();
    for page in &pages {
        let folder = Path::new(&page.path).parent().unwrap();
        for (line, target) in page.links() {
            if target.contains("://") {
                continue;
            }
            let place = format!("{}:{line}", page.path);
            let (path, anchor) = target.split_once('#').unwrap_or((target, ""));
            let path = if path.is_empty() {
                page.path.clone()
            } else {
                folder.join(path).display().to_string()
            };
            if !root().join(&path).exists() {
                wrong.push(format!("{place}: there is no `{target}`"));
            } else if !anchor.is_empty()
                && !Page::read(&root(), &path).anchors().iter().any(|known| known == anchor)
            {
                wrong.push(format!("{place}: `{path}` has no heading `#{anchor}`"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn calls_that_are_shown_are_known() {
    let wrong = commands::unknown(&documentation());
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn codes_that_are_named_exist() {
    for page in documentation() {
        for (line, text) in page.prose() {
            let words = text.split(|sign: char| !sign.is_ascii_alphanumeric());
            let named = words.filter(|word| {
                word.len() == 5
                    && word.starts_with(['E', 'W'])
                    && word[1..].bytes().all(|sign| sign.is_ascii_digit())
            });
            for code in named {
                let known = codes::CODES.iter().any(|known| known.code == code);
                assert!(known, "{}:{line}: there is no code {code}", page.path);
            }
        }
    }
}

#[test]
fn every_word_is_explained() {
    let pages = manual();
    let wrong = index::unexplained(&pages);
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn the_index_is_made_from_the_words() {
    let pages = manual();
    let made = index::index(&pages);
    let path = root().join(index::PATH);
    if update() {
        std::fs::write(&path, &made).unwrap();
    }
    let kept = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(kept == made, "run `UPDATE=1 cargo test --test manual`");
}

#[test]
fn every_page_stands_in_the_contents() {
    let pages = manual();
    let contents = pages.iter().find(|page| page.path.ends_with("/README.md")).unwrap();
    let linked: Vec<&str> = contents.links().into_iter().map(|(_, target)| target).collect();
    for page in &pages {
        let name = page.path.rsplit('/').next().unwrap();
        let known = name == "README.md" || linked.contains(&name);
        assert!(known, "docs/language/README.md does not lead to {name}");
    }
}
