//! Changes that know what a text is made of: lines, words, numbers and brackets. Left to bytes
//! alone nearly every text would end at its first letter.

#[path = "../../tests/damage/wound.rs"]
#[allow(dead_code)]
mod wound;

use darzi::diagnostic::page::pages;
use libfuzzer_sys::fuzzer_mutate;
use std::sync::OnceLock;
use wound::Chance;

/// Every line of the texts in the pages that explain the codes: small, and of every kind.
fn lines() -> &'static [&'static str] {
    static LINES: OnceLock<Vec<&str>> = OnceLock::new();
    LINES.get_or_init(|| {
        let pages: Vec<_> = pages().collect();
        pages.iter().flat_map(|page| page.examples()).flat_map(|text| text.text.lines()).collect()
    })
}

/// Changes the first `size` of `bytes` into at most `most`; gives how many they are then.
pub fn mutate(bytes: &mut [u8], size: usize, most: usize, seed: u32) -> usize {
    let mut chance = Chance(u64::from(seed));
    let text = String::from_utf8_lossy(&bytes[..size]).into_owned();
    let changed = match chance.below(8) {
        0 | 1 => return fuzzer_mutate(bytes, size, most),
        2 | 3 => graft(&text, &[*chance.one(lines())], &mut chance),
        4 | 5 => wound::copy(&text, u64::from(seed) << 1 | 1),
        _ => wound::damaged(&text, u64::from(seed)),
    };
    put(bytes, &changed, most)
}

/// Some lines of `other` among those of `one`.
pub fn cross(one: &[u8], other: &[u8], out: &mut [u8], seed: u32) -> usize {
    let mut chance = Chance(u64::from(seed));
    let (one, other) = (String::from_utf8_lossy(one), String::from_utf8_lossy(other));
    let other: Vec<&str> = other.lines().collect();
    let from = chance.below(other.len());
    let to = (from + 1 + chance.below(8)).min(other.len());
    let crossed = graft(&one, other.get(from..to).unwrap_or(&[]), &mut chance);
    let most = out.len();
    put(out, &crossed, most)
}

/// The lines `grafts` at some place between or instead of lines of `text`.
fn graft(text: &str, grafts: &[&str], chance: &mut Chance) -> String {
    let mut lines: Vec<&str> = text.lines().collect();
    let at = chance.below(lines.len() + 1);
    let end = (at + chance.below(2)).min(lines.len());
    lines.splice(at..end, grafts.iter().copied());
    lines.join("\n")
}

fn put(bytes: &mut [u8], text: &str, most: usize) -> usize {
    let size = text.len().min(most).min(bytes.len());
    bytes[..size].copy_from_slice(&text.as_bytes()[..size]);
    size
}
