//! The program on damaged copies of the examples: it ends by itself, in time, with 0, 1 or 3.

use crate::TURN;
use crate::wound::copy;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Longest time that `check` and `compile` may take.
pub const AT_ONCE: Duration = Duration::from_secs(5);

/// Copies of each example that the quick and the long test make.
const FEW: u64 = 4;
const MANY: u64 = 600;

/// Of so many copies one is draped in the long test.
const DRAPED: u64 = 40;

/// Longest time that a coarse drape may take. A drape works for as long as the file asks, so
/// this is no promise to anybody; it finds what never ends.
const COARSE_DRAPE: Duration = Duration::from_secs(300);

fn examples() -> Vec<(String, String)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    let mut found: Vec<(String, String)> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|end| end == "garment"))
        .map(|path| {
            let name = path.file_stem().unwrap().to_string_lossy().into_owned();
            (name, fs::read_to_string(&path).unwrap())
        })
        .collect();
    found.sort();
    found
}

/// Runs one command; what is wrong with how it ended, and how long it took.
fn run(folder: &Path, arguments: &[&str], limit: Duration) -> (Duration, Option<String>) {
    let told = folder.join("told");
    let began = Instant::now();
    let mut child = Command::new(env!("CARGO_BIN_EXE_darzi"))
        .args(arguments)
        .current_dir(folder)
        .env("XDG_CACHE_HOME", folder.join("cache"))
        .stdout(Stdio::null())
        .stderr(fs::File::create(&told).unwrap())
        .spawn()
        .unwrap();
    let status = loop {
        if let Some(status) = child.try_wait().unwrap() {
            break Some(status);
        }
        if began.elapsed() > limit {
            child.kill().unwrap();
            child.wait().unwrap();
            break None;
        }
        std::thread::sleep(Duration::from_millis(2));
    };
    let took = began.elapsed();
    let wrong = match status {
        None => Some(format!("did not end within {limit:?}")),
        Some(status) if !matches!(status.code(), Some(0 | 1 | 3)) => {
            let told = fs::read_to_string(&told).unwrap_or_default();
            Some(format!("ended with {status}: {told}"))
        }
        Some(_) => None,
    };
    (took, wrong)
}

/// A copy, how long its slower command took that ends at once, and what went wrong.
struct Tried {
    name: String,
    seed: u64,
    took: Duration,
    wrong: Vec<String>,
}

/// The first garment or scene of an example, for commands that want one.
fn first_name(text: &str) -> Option<&str> {
    let lines = text.lines();
    let mut items = lines
        .filter_map(|line| line.strip_prefix("garment ").or_else(|| line.strip_prefix("scene ")));
    let first = items.next()?;
    items.next().and_then(|_| first.split_whitespace().next())
}

/// All commands on one copy.
fn attempt(folder: &Path, (name, text): &(String, String), seed: u64, drape: bool) -> Tried {
    fs::write(folder.join("bad.garment"), copy(text, seed)).unwrap();
    let compile = ["compile", "bad.garment", "-o", "out"];
    let draped = ["drape", "bad.garment", "-o", "out.glb", "--resolution", "25mm", "--no-cache"];
    let mut calls: Vec<(&[&str], Duration)> =
        vec![(&["check", "bad.garment"], AT_ONCE), (&compile, AT_ONCE)];
    if drape {
        calls.push((&draped, COARSE_DRAPE));
    }
    let mut tried = Tried { name: name.clone(), seed, took: Duration::ZERO, wrong: Vec::new() };
    for (number, (call, limit)) in calls.into_iter().enumerate() {
        let mut call = call.to_vec();
        if let Some(first) = first_name(text).filter(|_| number > 0) {
            call.extend(["--name", first]);
        }
        let (took, fault) = run(folder, &call, limit);
        if limit == AT_ONCE {
            tried.took = tried.took.max(took);
        }
        tried.wrong.extend(fault.map(|fault| format!("{} {fault}", call[0])));
    }
    tried
}

/// Tries so many copies of each example, so many at once, some of them draped, and tells the
/// slowest.
fn try_all(copies: u64, at_once: usize, draped: impl Fn(u64) -> bool + Sync) {
    let examples = examples();
    let next = AtomicUsize::new(0);
    let found: Mutex<Vec<Tried>> = Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        for _ in 0..at_once {
            scope.spawn(|| {
                let folder = tempfile::tempdir().unwrap();
                loop {
                    let number = next.fetch_add(1, Ordering::Relaxed);
                    let (example, copy) = (number / copies as usize, number as u64 % copies);
                    let Some(example) = examples.get(example) else { return };
                    let seed = (number as u64) << 32 | copy;
                    let tried = attempt(folder.path(), example, seed, draped(copy));
                    for fault in &tried.wrong {
                        println!("{}, seed {seed}: {fault}", tried.name);
                    }
                    found.lock().unwrap().push(tried);
                }
            });
        }
    });
    let mut found = found.into_inner().unwrap();
    found.sort_by_key(|tried| std::cmp::Reverse(tried.took));
    println!("{} copies; the slowest:", found.len());
    for tried in found.iter().take(5) {
        println!("  {:.1?} {}, seed {}", tried.took, tried.name, tried.seed);
    }
    let wrong = found.iter().filter(|tried| !tried.wrong.is_empty()).count();
    assert_eq!(wrong, 0, "{wrong} copies ended badly");
}

#[test]
fn the_program_ends_on_damaged_copies() {
    let _turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
    try_all(FEW, 1, |_| false);
}

/// Several thousand copies, some of them draped: `cargo test --release --test damage --
/// --ignored`.
#[test]
#[ignore = "takes a quarter of an hour with --release"]
fn the_program_ends_on_thousands_of_damaged_copies() {
    try_all(MANY, 2, |copy| copy % DRAPED < 2);
}
