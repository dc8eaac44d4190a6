//! How long a weaver's draft of 2,000 ends and 2,000 picks takes: read, worked out, counted, and
//! all of it as a process. `cargo bench --bench weave`

#![allow(clippy::disallowed_methods)]

use darzi::diagnostic::FileId;
use darzi::textile::drawdown::{Cloth, Side, System};
use darzi::textile::layers::Layers;
use darzi::textile::wif;
use divan::Bencher;
use std::fmt::Write;
use std::process::Command;

fn main() {
    divan::main();
}

/// Threads in each direction.
const THREADS: usize = 2_000;
const SHAFTS: usize = 24;

/// A draft with scattered threading, by a tie-up or by a lift plan.
fn draft(lifted: bool) -> String {
    let mut text = format!(
        "[WIF]\r\nVersion=1.1\r\n[WEAVING]\r\nShafts={SHAFTS}\r\nTreadles={SHAFTS}\r\n\
         Rising Shed=yes\r\n[WARP]\r\nThreads={THREADS}\r\n[WEFT]\r\nThreads={THREADS}\r\n"
    );
    let mut section = |name: &str, count: usize, value: &dyn Fn(usize) -> String| {
        let _ = write!(text, "[{name}]\r\n");
        for number in 1..=count {
            let _ = write!(text, "{number}={}\r\n", value(number));
        }
    };
    let scattered = |n: usize| (n * 7919 + n / 5 * 31) % SHAFTS + 1;
    let half = |n: usize| {
        let shafts: Vec<String> =
            (0..SHAFTS / 2).map(|k| ((n + 2 * k) % SHAFTS + 1).to_string()).collect();
        shafts.join(",")
    };
    section("THREADING", THREADS, &|n| scattered(n).to_string());
    if lifted {
        section("LIFTPLAN", THREADS, &half);
    } else {
        section("TIEUP", SHAFTS, &half);
        section("TREADLING", THREADS, &|n| scattered(n + 5).to_string());
    }
    text
}

#[divan::bench(args = [false, true])]
fn read(bencher: Bencher, lifted: bool) {
    let text = draft(lifted);
    bencher.bench(|| wif::read(FileId(0), &text));
}

#[divan::bench(args = [false, true])]
fn work_out(bencher: Bencher, lifted: bool) {
    let draft = wif::read(FileId(0), &draft(lifted)).0.map(|found| found.draft).unwrap_or_default();
    bencher.bench(|| draft.drawdown());
}

#[divan::bench]
fn count(bencher: Bencher) {
    let draft = wif::read(FileId(0), &draft(false)).0.map(|found| found.draft).unwrap_or_default();
    let Ok(drawn) = draft.drawdown() else { return };
    bencher.bench(|| {
        let cloth = Cloth::new(drawn.clone());
        let float = cloth.longest(System::Warp).on(Side::Face, true);
        (float, Layers::of(&cloth).count())
    });
}

/// `darzi weave FILE --stats`, from the file to the printed figures.
#[divan::bench]
fn process(bencher: Bencher) {
    let Ok(folder) = tempfile::tempdir() else { return };
    let path = folder.path().join("draft.wif");
    if std::fs::write(&path, draft(false)).is_err() {
        return;
    }
    bencher.bench(|| {
        Command::new(env!("CARGO_BIN_EXE_darzi")).arg("weave").arg(&path).arg("--stats").output()
    });
}
