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
