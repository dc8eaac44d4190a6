//! Wounds: what can happen to a text between a sound one and one that nobody meant.

use std::ops::Range;

/// A small generator of chance with a seed (Steele, Lea and Flood 2014, "SplitMix").
pub struct Chance(pub u64);

impl Chance {
    pub fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)) as usize % n.max(1)
    }

    pub fn one<'a, T>(&mut self, of: &'a [T]) -> &'a T {
        &of[self.below(of.len())]
    }
}

/// The copy of that number: every other one has only its figures changed.
pub fn copy(text: &str, seed: u64) -> String {
    if seed.is_multiple_of(2) { damaged(text, seed) } else { exaggerated(text, seed) }
}

/// One to four wounds of any kind: the copy can rarely be read without a mistake.
pub fn damaged(text: &str, seed: u64) -> String {
    let mut chance = Chance(seed);
    let mut bytes = text.as_bytes().to_vec();
    for _ in 0..=chance.below(4) {
        if bytes.is_empty() {
            break;
        }
        match chance.below(3) {
            0 => letters(&mut bytes, &mut chance),
            1 => lines(&mut bytes, &mut chance),
            _ => figures(&mut bytes, &mut chance),
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

/// One or two figures changed: the copy can often be read, and asks for something odd.
fn exaggerated(text: &str, seed: u64) -> String {
    let mut chance = Chance(seed);
    let mut bytes = text.as_bytes().to_vec();
    for _ in 0..=chance.below(2) {
        figures(&mut bytes, &mut chance);
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Bytes, brackets or words, deleted, doubled or exchanged, or the end cut off.
fn letters(bytes: &mut Vec<u8>, chance: &mut Chance) {
    const MARKS: &[u8] = b"{}()[]\"|;:,.-+*/@=<>#\n\r\\";
    let at = chance.below(bytes.len());
    match chance.below(9) {
        0 => drop(bytes.remove(at)),
        1 => bytes.insert(at, bytes[at]),
        2 => {
            let other = chance.below(bytes.len());
            bytes.swap(at, other);
        }
        3 => bytes[at] = (chance.below(95) + 32) as u8,
        4 => bytes[at] = chance.below(256) as u8,
        5 => bytes.insert(at, *chance.one(MARKS)),
        6 => bytes.truncate(at),
        7 => {
            let brackets = runs(bytes, |byte| b"{}()[]".contains(&byte));
            let Some(place) = pick(&brackets, chance) else { return };
            if chance.below(2) == 0 {
                bytes.remove(place.start);
            } else {
                bytes[place.start] = *chance.one(b"{}()[]");
            }
        }
        _ => {
            let words = runs(bytes, |byte| byte.is_ascii_alphabetic() || byte == b'_');
            let (Some(a), Some(b)) = (pick(&words, chance), pick(&words, chance)) else { return };
            let word = bytes[b].to_vec();
            bytes.splice(a, word);
        }
    }
}

/// Lines deleted, moved, doubled or exchanged.
fn lines(bytes: &mut Vec<u8>, chance: &mut Chance) {
    let mut lines: Vec<Vec<u8>> = bytes.split(|b| *b == b'\n').map(<[u8]>::to_vec).collect();
    let (a, b) = (chance.below(lines.len()), chance.below(lines.len()));
    match chance.below(4) {
        0 => drop(lines.remove(a)),
        1 => {
            let line = lines.remove(a);
            lines.insert(b.min(lines.len()), line);
        }
        2 => lines.insert(b, lines[a].clone()),
        _ => lines.swap(a, b),
    }
    *bytes = lines.join(&b'\n');
}

/// A digit, a number or a unit changed.
fn figures(bytes: &mut Vec<u8>, chance: &mut Chance) {
    const UNITS: &[&str] = &["", "um", "mm", "cm", "m", "km", "deg", "%", "g/m2", "s", "x"];
    let numbers = runs(bytes, |byte| byte.is_ascii_digit() || byte == b'.');
    let Some(place) = pick(&numbers, chance) else { return };
    let end = place.end;
    let written = String::from_utf8_lossy(&bytes[place.clone()]).into_owned();
    let number: f64 = written.parse().unwrap_or(1.0);
    let changed = match chance.below(9) {
        0 => format!("{}", number * 1e6),
        1 => format!("{}", number * 1e-6),
        2 => format!("{}", number * 30.0),
        3 => format!("{}", number / 30.0),
        4 => format!("-{written}"),
        5 => "0".to_owned(),
        6 => format!("{written}{}", chance.below(10)),
        7 => {
            let mut digits = written.into_bytes();
            let digit = chance.below(digits.len());
            digits[digit] = b'0' + chance.below(10) as u8;
            String::from_utf8_lossy(&digits).into_owned()
        }
        _ => {
            let tail = bytes[end..].iter().take_while(|byte| byte.is_ascii_alphabetic()).count();
            bytes.splice(end..end + tail, chance.one(UNITS).bytes());
            return;
        }
    };
    bytes.splice(place, changed.bytes());
}

/// Stretches of bytes that belong together.
fn runs(bytes: &[u8], belongs: impl Fn(u8) -> bool) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    let mut at = 0;
    while at < bytes.len() {
        let length = bytes[at..].iter().take_while(|byte| belongs(**byte)).count();
        if length > 0 {
            found.push(at..at + length);
        }
        at += length + 1;
    }
    found
}

fn pick(places: &[Range<usize>], chance: &mut Chance) -> Option<Range<usize>> {
    (!places.is_empty()).then(|| chance.one(places).clone())
}
