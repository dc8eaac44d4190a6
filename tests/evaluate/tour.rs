//! The tour of the language is read without a word of complaint.

use darzi::diagnostic::render;
use darzi::syntax::parse;
use darzi::world::{Memory, World};
use std::fs;

#[test]
fn every_text_of_the_tour_is_sound() {
    insta::glob!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/tour"), "*.garment", |path| {
        let text = fs::read_to_string(path).unwrap();
        let mut world = Memory::new([("tour.garment", text.as_str())]);
        let file = world.open("tour.garment").unwrap();
        let (tree, told) = parse(file, &text);
        assert!(told.is_empty(), "{}", render::report(&told, &world, false, 100));
        assert!(!tree.statements.is_empty());
    });
}
