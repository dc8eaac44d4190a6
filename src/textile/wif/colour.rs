//! Colours and the table they are looked up in.

use super::ini::{Entry, Lines, number_part};
use super::number::{Reader, short, whole};
use crate::textile::Colour;
use crate::textile::told::Told;
use std::collections::BTreeMap;

/// The colours of a file by their numbers.
#[derive(Debug, Default)]
pub(super) struct Table {
    /// Whether the file has a table at all.
    pub present: bool,
    colours: BTreeMap<u64, Colour>,
    range: Option<(f64, f64)>,
}

/// The largest number of a colour that is kept.
const COLOURS: usize = 1 << 20;

impl Table {
    /// Reads `[COLOR PALETTE]` and `[COLOR TABLE]`.
    pub fn read(lines: &Lines<'_>, told: &mut Told) -> Table {
        let mut table = Table::default();
        if let Some(section) = lines.section("COLOR PALETTE") {
            let mut reader = Reader { section, told };
            if let Some(entry) = reader.entry("Range").filter(|entry| !entry.is_empty()) {
                let ends: Vec<Option<f64>> =
                    number_part(entry.value).split(',').map(|n| n.trim().parse().ok()).collect();
                match ends.as_slice() {
                    [Some(low), Some(high)] if low.is_finite() && high > low => {
                        table.range = Some((*low, *high));
                    }
                    _ => reader.unused(&entry, "is no range such as 0,255"),
                }
            }
        }
        let Some(section) = lines.section("COLOR TABLE") else { return table };
        let mut reader = Reader { section, told };
        let mut outside = None;
        for entry in &section.entries {
            if entry.is_empty() {
                continue;
            }
            let Some(number) = whole(entry.key).filter(|n| (1..=COLOURS as u64).contains(n)) else {
                reader.unused(entry, "is not the number of a colour");
                continue;
            };
            match table.colour(entry.value) {
                Some((colour, inside)) => {
                    table.colours.insert(number, colour);
                    if !inside {
                        outside.get_or_insert(*entry);
                    }
                }
                None => reader.unused(entry, "is no colour such as 255,0,0"),
            }
        }
        if let Some(entry) = outside {
            reader.unused(&entry, "a colour lies outside the range of the palette");
        }
        table.present = !table.colours.is_empty();
        table
    }

    /// A colour as it is written, and whether it lies in the palette's range.
    fn colour(&self, value: &str) -> Option<(Colour, bool)> {
        let parts: Vec<f64> = number_part(value)
            .split(',')
            .map(|part| part.trim().parse().ok().filter(|n: &f64| n.is_finite()))
            .collect::<Option<_>>()?;
        let &[red, green, blue] = parts.as_slice() else { return None };
        let (low, high) = self.range.unwrap_or((0.0, 255.0));
        let inside = [red, green, blue].iter().all(|n| (low..=high).contains(n));
        let byte = |n: f64| (((n - low) / (high - low)).clamp(0.0, 1.0) * 255.0).round() as u8;
        Some((Colour([byte(red), byte(green), byte(blue), 255]), inside))
    }

    /// The colour that a thread is given: a number of the table, `number,R,G,B` or `R,G,B`.
    /// Nothing for 0; `grave` says whether a colour that is not there is an error.
    pub fn of_thread(
        &self,
        reader: &mut Reader<'_, '_>,
        entry: &Entry<'_>,
        grave: bool,
    ) -> Option<Colour> {
        let value = number_part(entry.value);
        let (number, rest) = match value.split_once(',') {
            Some((number, rest)) => (number.trim(), Some(rest)),
            None => (value, None),
        };
        if value.matches(',').count() == 2 {
            let found = self.colour(value).map(|(colour, _)| colour);
            if found.is_none() {
                reader.wrong(entry, "the number of a colour");
            }
            return found;
        }
        let Some(index) = whole(number) else {
            reader.wrong(entry, "the number of a colour");
            return None;
        };
        if let Some(&colour) = self.colours.get(&index) {
            return Some(colour);
        }
        if let Some((colour, _)) = rest.and_then(|rest| self.colour(rest)) {
            return Some(colour);
        }
        if index == 0 {
            return None;
        }
        let (section, key) = (&reader.section.name, short(entry.key));
        let (message, help) = if self.present {
            let most = self.colours.keys().next_back().copied().unwrap_or(0);
            (
                format!("[{section}] {key}: there is no colour {index}"),
                format!("[COLOR TABLE] goes to {most}"),
            )
        } else {
            (
                format!("[{section}] {key}: colour {index} is named, but [COLOR TABLE] is missing"),
                "[COLOR TABLE] says what the colours are, such as `1=255,0,0`".to_owned(),
            )
        };
        let code = if grave { "E0623" } else { "W0621" };
        reader.told.say_with(code, section, entry.span, message, "here", Some(&help));
        None
    }
}
