//! The library of the language: everything in it can be made, and is documented.

use darzi::diagnostic::render;
use darzi::evaluate::{Options, evaluate};
use darzi::syntax::parse;
use darzi::syntax::tree::StatementKind;
use darzi::world::{Memory, World, library};

#[test]
fn every_file_of_the_library_is_sound() {
    for name in library::names() {
        let mut world = Memory::default();
        let file = world.open(name).unwrap();
        let (_, told) = evaluate(&mut world, file, &Options::default());
        assert!(told.is_empty(), "{}", render::report(&told, &world, false, 100));
    }
}

#[test]
fn every_item_of_the_library_is_documented() {
    for name in library::names() {
        let mut world = Memory::default();
        let file = world.open(name).unwrap();
        let (tree, _) = parse(file, library::text(name).unwrap());
        for statement in &tree.statements {
            if let StatementKind::Line { word, phrase, .. } = &statement.kind {
                assert!(!statement.doc.is_empty(), "{name}: {} {phrase:?}", word.text);
            }
        }
    }
}
