//! What is to be said of a weaving file, bounded: one mistake in each of ten thousand lines is
//! told a few times.

use crate::diagnostic::{Diagnostic, FileId, Span};
use std::collections::BTreeMap;

/// Messages of one code about one section.
const ALIKE: usize = 5;

/// The messages so far.
#[derive(Debug)]
pub(super) struct Told {
    file: FileId,
    all: Vec<Diagnostic>,
    count: BTreeMap<(&'static str, String), usize>,
}

impl Told {
    pub fn new(file: FileId) -> Told {
        Told { file, all: Vec::new(), count: BTreeMap::new() }
    }

    /// Says something of a place in a section.
    pub fn say(&mut self, code: &'static str, section: &str, at: Span, message: String) {
        self.say_with(code, section, at, message, "here", None);
    }

    /// Says something of a place in a section, with a label and what to do.
    pub fn say_with(
        &mut self,
        code: &'static str,
        section: &str,
        at: Span,
        message: String,
        label: &str,
        help: Option<&str>,
    ) {
        let count = self.count.entry((code, section.to_owned())).or_insert(0);
        *count += 1;
        if *count > ALIKE {
            return;
        }
        let mut told = Diagnostic::new(code, message).at(at, label);
        told.help = help.map(str::to_owned);
        self.all.push(told);
    }

    /// Says something of the whole file.
    pub fn of_file(&mut self, code: &'static str, message: String, help: &str) {
        let place = Span::new(self.file, 0, 0);
        self.all.push(Diagnostic::new(code, message).at(place, "").help(help));
    }

    /// Whether something is so wrong that there is no draft.
    pub fn refused(&self) -> bool {
        self.all.iter().any(Diagnostic::is_error)
    }

    /// All messages, with a word about those that were left out.
    pub fn all(self) -> Vec<Diagnostic> {
        let mut all = self.all;
        for ((code, section), count) in self.count {
            let Some(more) = count.checked_sub(ALIKE).filter(|more| *more > 0) else { continue };
            if let Some(last) = all
                .iter_mut()
                .rev()
                .find(|told| told.code == code && told.message.starts_with(&format!("[{section}]")))
            {
                last.message.push_str(&format!(", and {more} more like this"));
            }
        }
        all
    }
}
