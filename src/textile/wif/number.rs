//! Numbers, lists and yes or no.

use super::bearable;
use super::ini::{Entry, Section, number_part};
use crate::textile::told::Told;

/// A section while its values are read.
pub(super) struct Reader<'a, 't> {
    pub section: &'a Section<'t>,
    pub told: &'a mut Told,
}

impl<'t> Reader<'_, 't> {
    /// The last line of that key that says something.
    pub fn entry(&self, key: &str) -> Option<Entry<'t>> {
        let all = self.section.entries.iter().rev().filter(|entry| entry.is(key));
        all.clone().find(|entry| !entry.is_empty()).or(all.clone().next()).copied()
    }

    /// Says that a value cannot be read.
    pub fn wrong(&mut self, entry: &Entry<'_>, wanted: &str) {
        let message = format!(
            "[{}] {}: `{}` is not {wanted}",
            self.section.name,
            short(entry.key),
            short(number_part(entry.value))
        );
        self.told.say("E0622", &self.section.name, entry.span, message);
    }

    /// Says that a value is not used, and why.
    pub fn unused(&mut self, entry: &Entry<'_>, why: &str) {
        let message = format!("[{}] {}: {why}", self.section.name, short(entry.key));
        self.told.say("W0621", &self.section.name, entry.span, message);
    }

    /// Yes or no; nothing where it is not said or cannot be read.
    pub fn flag(&mut self, key: &str) -> Option<bool> {
        let entry = self.entry(key).filter(|entry| !entry.is_empty())?;
        match number_part(entry.value).to_ascii_lowercase().as_str() {
            "true" | "on" | "yes" | "1" | "-1" => Some(true),
            "false" | "off" | "no" | "0" => Some(false),
            _ => {
                self.wrong(&entry, "yes or no");
                None
            }
        }
    }

    /// A whole number of things, at most [`bearable`]; nothing where it is not said or is told
    /// to be wrong.
    pub fn count(&mut self, key: &str, what: &str) -> Option<u32> {
        let entry = self.entry(key).filter(|entry| !entry.is_empty())?;
        match whole(number_part(entry.value)) {
            Some(number) if bearable(number) => u32::try_from(number).ok(),
            Some(number) => {
                let message = format!("[{}] {}: {number} {what}", self.section.name, entry.key);
                let help = "at most 100000 can be worked with";
                let name = &self.section.name;
                self.told.say_with("E0624", name, entry.span, message, "here", Some(help));
                None
            }
            None => {
                self.wrong(&entry, "a whole number");
                None
            }
        }
    }

    /// The number of the thread, shaft or treadle that a line is about. `most` is how many there
    /// are; lines about others are told once and left out.
    pub fn number_of(&mut self, entry: &Entry<'_>, most: usize, what: &str) -> Option<usize> {
        let told = match whole(entry.key) {
            Some(0) => format!("there is no {what} 0"),
            Some(number) if number <= most as u64 => return usize::try_from(number).ok(),
            Some(_) => format!("there are {most} {what}s; the line is left out"),
            None => format!("`{}` is not the number of a {what}", short(entry.key)),
        };
        if !entry.is_empty() && !zeros(entry.value) {
            self.unused(entry, &told);
        }
        None
    }

    /// A list of numbers of shafts or treadles: rising, each once, without zeros. Nothing where
    /// it is told to be wrong.
    pub fn list(&mut self, entry: &Entry<'_>, what: &str) -> Option<Vec<u32>> {
        let mut found = Vec::new();
        let parts = number_part(entry.value).split(|c: char| c == ',' || c.is_whitespace());
        for part in parts {
            match whole(part) {
                _ if part.is_empty() => {}
                Some(0) => {}
                Some(number) if bearable(number) => found.push(number as u32),
                _ => {
                    self.wrong(entry, &format!("a list of {what}s"));
                    return None;
                }
            }
        }
        found.sort_unstable();
        found.dedup();
        Some(found)
    }

    /// A number that may be broken. A comma is read as its point where it is the only one, as
    /// programs of many countries write it.
    pub fn real(&mut self, entry: &Entry<'_>) -> Option<f64> {
        let text = number_part(entry.value);
        let pointed = match text.matches([',', '.']).count() {
            1 => text.replace(',', "."),
            _ => text.to_owned(),
        };
        let number = pointed.parse().ok().filter(|number: &f64| number.is_finite());
        if number.is_none() {
            self.unused(entry, "is no number; it is left out");
        }
        number
    }
}

/// A whole number of no sign; `4.0` is one too.
pub(super) fn whole(text: &str) -> Option<u64> {
    let text = text.trim();
    // Nearly all are like this, and there may be millions.
    if (1..=9).contains(&text.len()) && text.bytes().all(|byte| byte.is_ascii_digit()) {
        return Some(text.bytes().fold(0, |sum, byte| sum * 10 + u64::from(byte - b'0')));
    }
    let text = match text.split_once('.') {
        Some((text, zeros)) if zeros.bytes().all(|byte| byte == b'0') => text,
        Some(_) => return None,
        None => text,
    };
    let digits = text.strip_prefix('+').unwrap_or(text);
    if digits.is_empty() || !digits.bytes().all(|byte| byte.is_ascii_digit()) {
        return None;
    }
    // A number too long to be held is simply very large.
    Some(digits.parse().unwrap_or(u64::MAX))
}

/// Whether a list holds nothing but zeros.
pub(super) fn zeros(value: &str) -> bool {
    number_part(value).split(',').all(|part| matches!(part.trim(), "" | "0"))
}

/// The beginning of a text that may be endless.
pub(super) fn short(text: &str) -> String {
    const MOST: usize = 40;
    let mut shown: String = text.chars().take(MOST).collect();
    if text.chars().nth(MOST).is_some() {
        shown.push('…');
    }
    shown
}
