//! What people read when a text is wrong: one transcript for each kind of mistake.

use darzi::diagnostic::{Diagnostic, json, render};
use darzi::evaluate::{Options, evaluate};
use darzi::syntax::parse;
use darzi::world::{Memory, World};
use std::fs;
use std::path::Path;

fn told(path: &Path) -> (Memory, Vec<Diagnostic>) {
    let name = path.file_name().unwrap().to_str().unwrap().to_owned();
    let mut world = Memory::new([(name.clone(), fs::read_to_string(path).unwrap())]);
    let file = world.open(&name).unwrap();
    let (_, told) = parse(file, darzi::diagnostic::Texts::text(&world, file));
    (world, told)
}

#[test]
fn transcripts() {
    insta::glob!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/errors"), "*.garment", |path| {
        let (world, told) = told(path);
        insta::assert_snapshot!(render::report(&told, &world, false, 80));
    });
}

#[test]
fn transcripts_of_words() {
    insta::glob!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/words"), "*.garment", |path| {
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        let mut world = Memory::new([(name.clone(), fs::read_to_string(path).unwrap())]);
        let file = world.open(&name).unwrap();
        let (_, told) = evaluate(&mut world, file, &Options::default());
        insta::assert_snapshot!(render::report(&told, &world, false, 100));
    });
}

#[test]
fn the_same_as_json() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/errors");
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let (world, told) = told(&path);
        let lines = json::lines(&told, &world);
        assert_eq!(lines.lines().count(), told.len());
        for (line, told) in lines.lines().zip(&told) {
            let read: serde_json::Value = serde_json::from_str(line).unwrap();
            assert_eq!(read["code"], told.code.as_str());
            assert_eq!(read["labels"].as_array().unwrap().len(), told.labels.len());
        }
    }
}
