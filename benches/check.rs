//! How long `darzi check` and `darzi fmt` take for texts of 1,000, 3,000 and 10,000 lines, as
//! whole processes, and of which stages that time is made. `cargo bench --bench check`

#![allow(clippy::disallowed_methods)]

use darzi::diagnostic::FileId;
use darzi::evaluate::{Options, evaluate};
use darzi::garment::Garment;
use darzi::world::{Memory, World};
use darzi::{mesh, syntax};
use divan::Bencher;
use divan::counter::ItemsCount;
use std::process::Command;

fn main() {
    divan::main();
}

/// The lengths of the texts, in lines.
const LINES: [usize; 3] = [1_000, 3_000, 10_000];

/// Examples under new names, one after the other, until the lines are full.
fn text(lines: usize, examples: &[(&str, &str)]) -> String {
    let mut text = String::new();
    let mut full = 0;
    for (number, (name, example)) in examples.iter().cycle().enumerate() {
        if full >= lines {
            break;
        }
        text.push_str(&example.replace(&format!(" {name} {{"), &format!(" {name}_{number} {{")));
        full += example.lines().count();
    }
    text
}

/// Garments and cloths whose figures are all given.
fn drawn(lines: usize) -> String {
    text(
        lines,
        &[
            ("circular_skirt", include_str!("../examples/circular_skirt.garment")),
            ("apron", include_str!("../examples/apron.garment")),
            ("tablecloth", include_str!("../examples/tablecloth.garment")),
            ("handkerchief", include_str!("../examples/handkerchief.garment")),
        ],
    )
}

/// Garments with curves fitted to each other; every other one is drafted in several sizes.
fn fitted(lines: usize) -> String {
    text(
        lines,
        &[
            ("a_line_skirt", include_str!("../examples/a_line_skirt.garment")),
            ("tunic", include_str!("../examples/tunic.garment")),
        ],
    )
}

fn worked_out(text: &str) -> Vec<Garment> {
    let mut world = Memory::new([("bench.garment", text)]);
    let root = world.open("bench.garment").expect("a text in memory");
    evaluate(&mut world, root, &Options::default()).0
}

/// Runs the program on a text in a file of its own.
fn program(bencher: Bencher, lines: usize, text: &str, arguments: &[&str]) {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("bench.garment");
    std::fs::write(&file, text).expect("a file");
    bencher.counter(ItemsCount::new(lines)).bench(|| {
        let mut call = Command::new(env!("CARGO_BIN_EXE_darzi"));
        call.args(arguments).arg(&file).output().expect("the program runs")
    });
}

#[divan::bench(args = LINES)]
fn check(bencher: Bencher, lines: usize) {
    program(bencher, lines, &drawn(lines), &["check"]);
}

#[divan::bench(args = LINES)]
fn check_with_fits(bencher: Bencher, lines: usize) {
    program(bencher, lines, &fitted(lines), &["check"]);
}

#[divan::bench(args = LINES)]
fn fmt(bencher: Bencher, lines: usize) {
    program(bencher, lines, &fitted(lines), &["fmt", "--check"]);
}

/// The least that a call takes.
#[divan::bench]
fn check_small(bencher: Bencher) {
    let example = include_str!("../examples/circular_skirt.garment");
    program(bencher, example.lines().count(), example, &["check"]);
}

#[divan::bench(args = LINES)]
fn reading(bencher: Bencher, lines: usize) {
    let text = drawn(lines);
    bencher.counter(ItemsCount::new(lines)).bench(|| syntax::parse(FileId(0), &text));
}

#[divan::bench(args = LINES)]
fn working_out(bencher: Bencher, lines: usize) {
    let text = drawn(lines);
    bencher.counter(ItemsCount::new(lines)).bench(|| worked_out(&text).len());
}

#[divan::bench(args = LINES)]
fn working_out_fits(bencher: Bencher, lines: usize) {
    let text = fitted(lines);
    bencher.counter(ItemsCount::new(lines)).bench(|| worked_out(&text).len());
}

#[divan::bench(args = LINES)]
fn examining(bencher: Bencher, lines: usize) {
    let garments = worked_out(&drawn(lines));
    bencher
        .counter(ItemsCount::new(lines))
        .bench(|| garments.iter().map(mesh::examine).filter(Result::is_err).count());
}
