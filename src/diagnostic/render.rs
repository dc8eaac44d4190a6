//! Diagnostics for people, drawn by miette: the line in question with its neighbours, the place
//! underlined, what to type instead.

use super::place::Lines;
use super::{Diagnostic, FileId, Label, Severity, Texts};
use miette::{GraphicalReportHandler, GraphicalTheme, LabeledSpan, MietteError, SourceCode};
use miette::{MietteSpanContents, SourceSpan, SpanContents, ThemeCharacters, ThemeStyles};
use std::collections::BTreeMap;
use std::fmt;

/// Messages that are shown; the others are counted.
const MOST: usize = 100;

/// A line is shown for this many bytes about a place.
const WINDOW: usize = 400;

/// The diagnostics as text of at most about `width` columns, with a line of counts at the end.
/// Empty where there is nothing to say.
pub fn report(diagnostics: &[Diagnostic], texts: &dyn Texts, color: bool, width: usize) -> String {
    let mut snippets: BTreeMap<FileId, Snippets> = BTreeMap::new();
    for label in diagnostics.iter().take(MOST).flat_map(|diagnostic| &diagnostic.labels) {
        let file = label.span.file;
        snippets.entry(file).or_insert_with(|| Snippets::of(texts.path(file), texts.text(file)));
    }
    let theme = GraphicalTheme {
        characters: ThemeCharacters::unicode(),
        styles: if color { ThemeStyles::ansi() } else { ThemeStyles::none() },
    };
    let handler = GraphicalReportHandler::new_themed(theme)
        .with_width(width.clamp(40, 500))
        .with_context_lines(1)
        .without_syntax_highlighting()
        .with_links(false);
    let mut out = String::new();
    for diagnostic in diagnostics.iter().take(MOST) {
        let shown = Shown::of(diagnostic, &snippets);
        // Writing to a string fails only where miette cannot find a place; then the sentence
        // alone is better than nothing.
        let before = out.len();
        if handler.render_report(&mut out, &shown).is_err() {
            out.truncate(before);
            out.push_str(&format!("{} {}\n", diagnostic.code, clean(&diagnostic.message)));
        }
        out.push('\n');
    }
    out.push_str(&counts(diagnostics));
    out
}

/// `3 errors, 1 warning`
fn counts(diagnostics: &[Diagnostic]) -> String {
    let errors = diagnostics.iter().filter(|diagnostic| diagnostic.is_error()).count();
    let warnings = diagnostics.len() - errors;
    let told = |n: usize, what: &str| match n {
        0 => None,
        1 => Some(format!("1 {what}")),
        n => Some(format!("{n} {what}s")),
    };
    let mut parts: Vec<String> =
        [told(errors, "error"), told(warnings, "warning")].into_iter().flatten().collect();
    if diagnostics.len() > MOST {
        parts.push(format!("the first {MOST} are shown"));
    }
    if parts.is_empty() { String::new() } else { format!("{}\n", parts.join(", ")) }
}

/// A text as miette reads it: by lines, without characters that could upset a terminal.
struct Snippets {
    path: String,
    text: String,
    lines: Lines,
}

impl Snippets {
    fn of(path: &str, text: &str) -> Self {
        Snippets { path: clean(path), text: clean(text), lines: Lines::of(text) }
    }
}

/// Replaces control characters and marks that turn the direction of writing by signs of equal
/// length in bytes, so that places stay true.
pub(super) fn clean(text: &str) -> String {
    text.chars()
        .zip(text.chars().skip(1).map(Some).chain([None]))
        .map(|(c, next)| match c {
            '\n' | '\t' => c,
            '\r' if next == Some('\n') => c,
            '\u{0}'..='\u{1F}' | '\u{7F}' => '?',
            '\u{80}'..='\u{9F}' => '\u{BF}',
            '\u{202A}'..='\u{202E}'
            | '\u{2066}'..='\u{2069}'
            | '\u{200E}'
            | '\u{200F}'
            | '\u{2028}'
            | '\u{2029}' => '\u{FFFD}',
            _ => c,
        })
        .collect()
}

impl SourceCode for Snippets {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        before: usize,
        after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let text = &self.text;
        let start = text.floor_char_boundary(span.offset().min(text.len()));
        let end = text.ceil_char_boundary((span.offset() + span.len()).min(text.len()));
        let last = end.saturating_sub(1).max(start);
        let first_line = self.lines.number(start).saturating_sub(before);
        let last_line = self.lines.number(last) + after;
        let mut from =
            if before == 0 { start } else { self.lines.start_of(first_line).unwrap_or(0) };
        let mut to =
            if after == 0 { end } else { self.lines.start_of(last_line + 1).unwrap_or(text.len()) };
        let mut line = if before == 0 { self.lines.number(start) } else { first_line };
        // Of endless lines only what lies about the place is shown.
        if start - from > WINDOW {
            from = text.ceil_char_boundary(self.lines.start(start).max(start - WINDOW));
            line = self.lines.number(start);
        }
        if to.saturating_sub(end) > WINDOW {
            to = text.floor_char_boundary(end + WINDOW);
        }
        let to = to.max(from);
        let column = self.lines.place(text, from).column - 1;
        let data = text.get(from..to).unwrap_or("").as_bytes();
        Ok(Box::new(MietteSpanContents::new_named(
            self.path.clone(),
            data,
            (from, data.len()).into(),
            line,
            column,
            self.lines.number(to) + 1 - line,
        )))
    }
}

/// A diagnostic, or its places in one further file.
struct Shown<'a> {
    head: Option<&'a Diagnostic>,
    severity: Severity,
    message: String,
    source: Option<&'a Snippets>,
    labels: Vec<LabeledSpan>,
    related: Vec<Shown<'a>>,
}

impl<'a> Shown<'a> {
    fn of(diagnostic: &'a Diagnostic, snippets: &'a BTreeMap<FileId, Snippets>) -> Self {
        let main = diagnostic.labels.first().map(|label| label.span.file);
        let labels_in = |file: FileId| {
            diagnostic.labels.iter().filter(move |label| label.span.file == file).collect()
        };
        let mut others: Vec<FileId> = diagnostic
            .labels
            .iter()
            .map(|label| label.span.file)
            .filter(|file| Some(*file) != main)
            .collect();
        others.sort_unstable();
        others.dedup();
        let part = |head, message: String, file: Option<FileId>, related| {
            let source = file.and_then(|file| snippets.get(&file));
            let labels: Vec<&Label> = file.map(labels_in).unwrap_or_default();
            let labels = match source {
                Some(source) => marks(&labels, source),
                None => Vec::new(),
            };
            Shown { head, severity: diagnostic.severity, message, source, labels, related }
        };
        let related = others
            .into_iter()
            .map(|file| {
                let path = snippets.get(&file).map_or("", |snippets| &snippets.path);
                part(None, format!("and in {path}"), Some(file), Vec::new())
            })
            .collect();
        part(Some(diagnostic), clean(&diagnostic.message), main, related)
    }
}

/// The labels of one file as miette takes them. A place of several lines is shown by its first,
/// places out of the text by its end.
fn marks(labels: &[&Label], source: &Snippets) -> Vec<LabeledSpan> {
    let text = &source.text;
    labels
        .iter()
        .enumerate()
        .map(|(number, label)| {
            let start = text.floor_char_boundary((label.span.start as usize).min(text.len()));
            let end = text.ceil_char_boundary((label.span.end as usize).min(text.len()));
            let line = text.get(start..end.max(start)).unwrap_or("");
            let line = line.split(['\n', '\r']).next().unwrap_or("");
            let length = line.len().min(WINDOW);
            let told = (!label.text.is_empty()).then(|| clean(&label.text));
            if number == 0 {
                LabeledSpan::new_primary_with_span(told, (start, length))
            } else {
                LabeledSpan::new_with_span(told, (start, length))
            }
        })
        .collect()
}

impl fmt::Display for Shown<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl fmt::Debug for Shown<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl std::error::Error for Shown<'_> {}

impl miette::Diagnostic for Shown<'_> {
    fn code<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.head.map(|head| Box::new(&head.code) as Box<dyn fmt::Display>)
    }

    fn severity(&self) -> Option<miette::Severity> {
        Some(match (self.head, self.severity) {
            (None, _) => miette::Severity::Advice,
            (_, Severity::Error) => miette::Severity::Error,
            (_, Severity::Warning) => miette::Severity::Warning,
        })
    }

    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        let help = self.head?.help.as_deref()?;
        Some(Box::new(clean(help)))
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.source.map(|source| source as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        (!self.labels.is_empty()).then(|| Box::new(self.labels.iter().cloned()) as _)
    }

    fn related<'a>(&'a self) -> Option<Box<dyn Iterator<Item = &'a dyn miette::Diagnostic> + 'a>> {
        (!self.related.is_empty())
            .then(|| Box::new(self.related.iter().map(|part| part as &dyn miette::Diagnostic)) as _)
    }
}
