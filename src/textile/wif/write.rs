//! A draft as a weaving file.

use crate::textile::Colour;
use crate::textile::draft::{Draft, Shedding, Threads};
use crate::units::trimmed;
use std::collections::BTreeMap;
use std::fmt::Write;

/// Writes a draft as WIF 1.1: all that the format demands, the lift plan always, tie-up and
/// treadling where the draft has treadles. Lines end as on the systems for which most weaving
/// programs are written; letters beyond ASCII are UTF-8. [`read`](super::read) gives the same
/// draft back; threads without colours come back black and white, for many readers want some.
pub fn write(draft: &Draft) -> String {
    let mut sections: Vec<(String, String)> = Vec::new();
    let mut section = |name: &str, lines: Lines| {
        if !lines.0.is_empty() {
            sections.push((name.to_owned(), lines.0));
        }
    };
    let palette = Palette::of(draft);

    let mut weaving = Lines::default();
    weaving.line("Shafts", draft.shafts.max(1));
    weaving.line("Treadles", draft.treadles.max(1));
    weaving.line("Rising Shed", if draft.rising { "true" } else { "false" });
    section("WEAVING", weaving);

    let mut text = Lines::default();
    for (key, value) in [("Title", &draft.title), ("Author", &draft.author)] {
        if !value.is_empty() {
            text.line(key, one_line(value));
        }
    }
    section("TEXT", text);
    let mut notes = Lines::default();
    for (number, line) in (1..).zip(&draft.notes) {
        notes.line(number, one_line(line));
    }
    section("NOTES", notes);

    let systems = [("WARP", draft.ends(), &draft.warp), ("WEFT", draft.picks(), &draft.weft)];
    for (name, count, threads) in systems {
        let mut own = Lines::default();
        own.line("Threads", count);
        let colour = threads.colours.as_ref().and_then(|list| usual(list, |colour| colour.0));
        let plain = if name == "WARP" { BLACK } else { WHITE };
        if let Some(number) = palette.number(colour.unwrap_or(plain)) {
            own.line("Color", number);
        }
        let mut single: Vec<(&str, Lines)> = Vec::new();
        own.line("Units", "Centimeters");
        for (key, list) in [("Spacing", &threads.spacing), ("Thickness", &threads.thickness)] {
            let Some(list) = list else { continue };
            let base = usual(list, f64::to_bits);
            let mut lines = Lines::default();
            for (number, length) in (1..).zip(list) {
                if Some(*length) == base {
                    continue;
                }
                lines.line(number, centimetres(*length));
            }
            if let Some(base) = base {
                own.line(key, centimetres(base));
            }
            single.push((key, lines));
        }
        section(name, own);
        section(&format!("{name} COLORS"), colours(threads, colour, &palette));
        for (key, lines) in single {
            section(&format!("{name} {}", key.to_uppercase()), lines);
        }
    }
    let (range, table) = palette.lines();
    section("COLOR PALETTE", range);
    section("COLOR TABLE", table);

    section("THREADING", lists(&draft.threading));
    if let Shedding::Treadled { tieup, treadling } = &draft.shedding {
        section("TIEUP", lists(tieup));
        section("TREADLING", lists(treadling));
    }
    let plan: Vec<Vec<u32>> = (0..draft.picks()).map(|pick| draft.moved(pick)).collect();
    section("LIFTPLAN", lists(&plan));

    let mut head = Lines::default();
    head.line("Version", "1.1");
    // The format wants these two as they stand.
    head.line("Date", "April 20, 1997");
    head.line("Developers", "wif@mhsoft.com");
    head.line("Source Program", "darzi");
    head.line("Source Version", env!("CARGO_PKG_VERSION"));
    let mut contents = Lines::default();
    let treadled = matches!(draft.shedding, Shedding::Treadled { .. });
    for (name, _) in &sections {
        // Tie-up and treadling count where there are both, and there are readers that fail where
        // both are announced; those that look for a lift plan look for its section.
        contents.line(name, !(treadled && name == "LIFTPLAN"));
    }
    let head = [("WIF".to_owned(), head.0), ("CONTENTS".to_owned(), contents.0)];
    let mut out = String::new();
    for (name, lines) in head.into_iter().chain(sections) {
        // Writing to a string cannot fail.
        let _ = write!(out, "[{name}]\r\n{lines}\r\n");
    }
    out
}

const BLACK: Colour = Colour([0, 0, 0, 255]);
const WHITE: Colour = Colour([255, 255, 255, 255]);

/// Lines of a section.
#[derive(Default)]
struct Lines(String);

impl Lines {
    fn line(&mut self, key: impl std::fmt::Display, value: impl std::fmt::Display) {
        let _ = write!(self.0, "{key}={value}\r\n");
    }
}

/// A text that stays on its line.
fn one_line(text: &str) -> String {
    text.split(['\r', '\n']).map(str::trim).collect::<Vec<_>>().join(" ").trim().to_owned()
}

fn centimetres(metres: f64) -> String {
    trimmed(metres * 100.0, 7)
}

/// The lists that are not empty, by their numbers.
fn lists(lists: &[Vec<u32>]) -> Lines {
    let mut lines = Lines::default();
    for (number, list) in (1..).zip(lists) {
        if !list.is_empty() {
            let list: Vec<String> = list.iter().map(u32::to_string).collect();
            lines.line(number, list.join(","));
        }
    }
    lines
}

/// The colours of all threads, where not all have the usual one.
fn colours(threads: &Threads, usual: Option<Colour>, palette: &Palette) -> Lines {
    let mut lines = Lines::default();
    let list = threads.colours.iter().flatten();
    if list.clone().any(|colour| Some(*colour) != usual) {
        for (number, &colour) in (1..).zip(list) {
            if let Some(index) = palette.number(colour) {
                lines.line(number, index);
            }
        }
    }
    lines
}

/// What most of a list is; the first of several. `key` says what is alike.
fn usual<T: Copy, K: Ord>(list: &[T], key: impl Fn(T) -> K) -> Option<T> {
    let mut count: BTreeMap<K, usize> = BTreeMap::new();
    for &thing in list {
        *count.entry(key(thing)).or_insert(0) += 1;
    }
    let most = count.values().copied().max()?;
    list.iter().copied().find(|&thing| count.get(&key(thing)) == Some(&most))
}

/// The colours of a draft, numbered in the order in which warp and weft show them.
struct Palette {
    numbers: BTreeMap<[u8; 4], usize>,
    order: Vec<Colour>,
}

impl Palette {
    fn of(draft: &Draft) -> Palette {
        let mut palette = Palette { numbers: BTreeMap::new(), order: Vec::new() };
        let of = |threads: &Threads, usual: Colour| {
            threads.colours.clone().unwrap_or_else(|| vec![usual])
        };
        for colour in [of(&draft.warp, BLACK), of(&draft.weft, WHITE)].concat() {
            let next = palette.order.len() + 1;
            if *palette.numbers.entry(colour.0).or_insert(next) == next {
                palette.order.push(colour);
            }
        }
        palette
    }

    fn number(&self, colour: Colour) -> Option<usize> {
        self.numbers.get(&colour.0).copied()
    }

    /// `[COLOR PALETTE]` and `[COLOR TABLE]`.
    fn lines(&self) -> (Lines, Lines) {
        let (mut range, mut table) = (Lines::default(), Lines::default());
        range.line("Entries", self.order.len());
        range.line("Range", "0,255");
        range.line("Form", "RGB");
        for (number, Colour([red, green, blue, _])) in (1..).zip(&self.order) {
            table.line(number, format!("{red},{green},{blue}"));
        }
        (range, table)
    }
}
