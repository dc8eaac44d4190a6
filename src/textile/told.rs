//! What is to be said of a file of another program, bounded: one mistake in each of ten thousand
//! lines is told a few times.

use crate::diagnostic::{Diagnostic, FileId, Span};
use std::collections::BTreeMap;

/// Messages of one code about one subject.
const ALIKE: usize = 5;

/// The messages so far.
#[derive(Debug)]
pub(super) struct Told {
    file: FileId,
    all: Vec<Diagnostic>,
    /// Whether what was said last is among them.
    shown: bool,
    /// How many there are of a code about a subject.
    count: BTreeMap<(&'static str, String), Count>,
}

#[derive(Debug)]
struct Count {
    all: usize,
    /// Those that are told at most.
    most: usize,
    /// The last that is told.
    last: usize,
}

impl Told {
    pub fn new(file: FileId) -> Told {
        Told { file, all: Vec::new(), shown: false, count: BTreeMap::new() }
    }

    /// Says something of a place.
    pub fn say(&mut self, code: &'static str, subject: &str, at: Span, message: String) {
        self.say_with(code, subject, at, message, "here", None);
    }

    /// Says something of a place, with a label and what to do.
    pub fn say_with(
        &mut self,
        code: &'static str,
        subject: &str,
        at: Span,
        message: String,
        label: &str,
        help: Option<&str>,
    ) {
        self.say_up_to(ALIKE, code, subject, at, message, label, help);
    }

    /// Says something of a place, so many times of one subject at most.
    pub fn say_up_to(
        &mut self,
        most: usize,
        code: &'static str,
        subject: &str,
        at: Span,
        message: String,
        label: &str,
        help: Option<&str>,
    ) {
        let none = Count { all: 0, most, last: 0 };
        let count = self.count.entry((code, subject.to_owned())).or_insert(none);
        count.all += 1;
        self.shown = count.all <= most;
        if !self.shown {
            return;
        }
        count.last = self.all.len();
        let mut told = Diagnostic::new(code, message).at(at, label);
        told.help = help.map(str::to_owned);
        self.all.push(told);
    }

    /// Adds a further place to what was said last.
    pub fn and_at(&mut self, at: Span, label: &str) {
        if let Some(told) = self.all.last_mut().filter(|_| self.shown) {
            *told = std::mem::replace(told, Diagnostic::new("", "")).at(at, label);
        }
    }

    /// Whether another message of this code about this subject would be shown.
    pub fn shows(&self, code: &'static str, subject: &str) -> bool {
        self.count.get(&(code, subject.to_owned())).is_none_or(|count| count.all < count.most)
    }

    /// Says something of the whole file.
    pub fn of_file(&mut self, code: &'static str, message: String, help: &str) {
        let place = Span::new(self.file, 0, 0);
        self.all.push(Diagnostic::new(code, message).at(place, "").help(help));
    }

    /// Whether something is so wrong that the file cannot be used.
    pub fn refused(&self) -> bool {
        self.all.iter().any(Diagnostic::is_error)
    }

    /// All messages, with a word about those that were left out.
    pub fn all(self) -> Vec<Diagnostic> {
        let mut all = self.all;
        for Count { all: count, most, last } in self.count.into_values() {
            let Some(more) = count.checked_sub(most).filter(|more| *more > 0) else { continue };
            if let Some(last) = all.get_mut(last) {
                last.message.push_str(&format!(", and {more} more like this"));
            }
        }
        all
    }
}
