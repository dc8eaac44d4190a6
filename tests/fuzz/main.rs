//! Texts that the fuzzer kept or stumbled over are read, worked out and cut as it does.
//!
//! `fuzz/corpus` holds the texts it found worth keeping, each another way through the program;
//! `fuzz/found` those that once made it panic, hang or eat memory.

#![allow(clippy::disallowed_methods, clippy::print_stdout)]

mod dictionary;
mod held;

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Longest time that one text may take, in the profile of the tests, which is some five times
/// slower than the program that is released.
const AT_ONCE: Duration = Duration::from_secs(5);

fn texts(folder: &str) -> Vec<(PathBuf, String)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz").join(folder);
    let mut found: Vec<(PathBuf, String)> = std::fs::read_dir(&folder)
        .unwrap_or_else(|error| panic!("{}: {error}", folder.display()))
        .map(|entry| entry.unwrap().path())
        .map(|path| {
            let bytes = std::fs::read(&path).unwrap();
            (path, String::from_utf8_lossy(&bytes).into_owned())
        })
        .collect();
    found.sort();
    found
}

/// Runs `held` on all texts of a folder, each in good time.
fn hold(folder: &str, least: usize, held: fn(&str)) {
    let texts = texts(folder);
    assert!(texts.len() >= least, "{folder} has moved");
    for (path, text) in texts {
        println!("{}", path.display());
        let began = Instant::now();
        held(&text);
        let took = began.elapsed();
        assert!(took < AT_ONCE, "{}: {took:?}", path.display());
    }
}

#[test]
fn what_the_fuzzer_kept_is_read() {
    hold("corpus/read", 100, held::read);
}

#[test]
fn what_the_fuzzer_kept_is_worked_out_and_cut() {
    hold("corpus/cut", 100, held::cut);
}

#[test]
fn what_the_fuzzer_found_is_mended() {
    hold("found", 4, |text| {
        held::read(text);
        held::cut(text);
    });
}
