//! What darzi has to say about a text: coded messages with their places.
//!
//! A [`Diagnostic`] is data. It is shown by [`render`] (a report for people, through miette), by
//! [`short`] (one line each) or by [`json`] (a line of JSON for programs). Messages state the fact, labels say where,
//! the help says what to type.

use serde::{Deserialize, Serialize};

pub mod codes;
pub mod json;
pub mod page;
pub mod place;
pub mod render;
pub mod short;
pub mod spelling;

/// The texts that diagnostics speak of.
pub trait Texts {
    /// The path under which `file` was opened, as messages show it.
    fn path(&self, file: FileId) -> &str;

    /// The text of `file`; empty for a number that was never given out.
    fn text(&self, file: FileId) -> &str;
}

/// A file known to a [`crate::world::World`], by its number in the order of first use.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize,
)]
pub struct FileId(pub u32);

/// A stretch of bytes `start..end` in one file.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize,
)]
pub struct Span {
    /// The file it lies in.
    pub file: FileId,
    /// First byte.
    pub start: u32,
    /// One past the last byte.
    pub end: u32,
}

impl Span {
    /// The stretch `start..end` of `file`.
    pub fn new(file: FileId, start: usize, end: usize) -> Self {
        let clamp = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
        Span { file, start: clamp(start), end: clamp(end) }
    }

    /// The smallest stretch that holds both; `other` must lie in the same file, or `self` is
    /// given back.
    pub fn to(self, other: Span) -> Span {
        if self.file != other.file {
            return self;
        }
        Span { file: self.file, start: self.start.min(other.start), end: self.end.max(other.end) }
    }
}

/// How grave a message is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// The text cannot be used as it is.
    Error,
    /// The text can be used, but is probably not what was meant.
    Warning,
}

/// A place with what is to be said of it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Label {
    /// Where.
    pub span: Span,
    /// What stands there; may be empty.
    pub text: String,
}

impl Label {
    /// What it says to write in its place: the `width` of `` did you mean `width`? `` or the
    /// `3cm` of `` write `3cm` ``.
    pub fn suggestion(&self) -> Option<&str> {
        let meant = || self.text.strip_prefix("did you mean `")?.strip_suffix("`?");
        let written = || self.text.strip_prefix("write `")?.strip_suffix('`');
        meant().or_else(written).filter(|new| !new.contains(['`', '\n']))
    }
}

/// One message about a text.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Diagnostic {
    /// Stable code, such as `E0501`; `W…` for warnings. Listed in [`codes`].
    pub code: String,
    /// Error or warning.
    pub severity: Severity,
    /// The fact, in one sentence without a full stop.
    pub message: String,
    /// Places; the first is the main one. Places in another file than the first are shown apart.
    pub labels: Vec<Label>,
    /// What to type instead.
    pub help: Option<String>,
}

impl Diagnostic {
    /// An error (`E…`) or warning (`W…`) of the given code.
    pub fn new(code: &str, message: impl Into<String>) -> Self {
        let severity = if code.starts_with('W') { Severity::Warning } else { Severity::Error };
        Diagnostic {
            code: code.to_owned(),
            severity,
            message: message.into(),
            labels: Vec::new(),
            help: None,
        }
    }

    /// Adds a place.
    #[must_use]
    pub fn at(mut self, span: Span, text: impl Into<String>) -> Self {
        self.labels.push(Label { span, text: text.into() });
        self
    }

    /// Says what to type instead.
    #[must_use]
    pub fn help(mut self, text: impl Into<String>) -> Self {
        self.help = Some(text.into());
        self
    }

    /// Whether it is an error.
    pub fn is_error(&self) -> bool {
        self.severity == Severity::Error
    }
}

/// `a, b or c`
pub fn either(names: &[impl AsRef<str>]) -> String {
    let names: Vec<&str> = names.iter().map(AsRef::as_ref).collect();
    match names.as_slice() {
        [many @ .., before, last] if !many.is_empty() => {
            format!("{}, {before} or {last}", many.join(", "))
        }
        few => few.join(" or "),
    }
}

/// Puts messages in the order of the text, by the start of their main place; those of `root`
/// come first, then those of the files it uses in the order in which they were opened. Messages
/// without a place stand before all others: they speak of the call or of the machine. Messages
/// of one place keep their order.
pub fn in_order(root: FileId, told: &mut [Diagnostic]) {
    told.sort_by_key(|diagnostic| {
        let main = diagnostic.labels.first();
        main.map(|Label { span, .. }| (span.file != root, span.file, span.start))
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_label_says_what_to_write() {
        let label = |text: &str| Label { span: Span::default(), text: text.to_owned() };
        assert_eq!(label("did you mean `width`?").suggestion(), Some("width"));
        assert_eq!(label("write `3cm`").suggestion(), Some("3cm"));
        assert_eq!(label("write `x` between sizes, `*` to multiply").suggestion(), None);
        assert_eq!(label("here").suggestion(), None);
    }

    #[test]
    fn messages_follow_the_text_and_the_file_in_hand_comes_first() {
        let told = |name: &str, file: u32, start: usize| {
            Diagnostic::new(name, "").at(Span::new(FileId(file), start, start + 1), "")
        };
        let mut all = vec![
            told("E0204", 0, 9),
            told("E0205", 2, 30),
            told("E0206", 2, 5).at(Span::new(FileId(0), 0, 1), "a further place does not count"),
            told("E0207", 1, 5),
            told("E0208", 2, 5),
            Diagnostic::new("E0209", "without a place"),
        ];
        in_order(FileId(2), &mut all);
        let codes: Vec<&str> = all.iter().map(|told| told.code.as_str()).collect();
        assert_eq!(codes, ["E0209", "E0206", "E0208", "E0205", "E0204", "E0207"]);
    }
}
