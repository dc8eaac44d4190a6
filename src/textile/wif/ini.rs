//! The lines of a weaving file: sections, keys and values, each with its place.
//!
//! A line whose first sign is `;` is a comment. Names of sections and keys are read without
//! regard to case, and lines may end in CR, LF or both, mixed as programs leave them.

use crate::diagnostic::{FileId, Span};
use std::collections::BTreeMap;

/// A key with its value.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entry<'t> {
    /// The key as written.
    pub key: &'t str,
    /// The value, without blanks at its ends.
    pub value: &'t str,
    /// The whole line.
    pub span: Span,
}

impl Entry<'_> {
    /// Whether the value says nothing.
    pub fn is_empty(&self) -> bool {
        number_part(self.value).is_empty()
    }

    /// Whether this is the key of that name.
    pub fn is(&self, name: &str) -> bool {
        self.key.eq_ignore_ascii_case(name)
    }
}

/// A section.
#[derive(Clone, Debug)]
pub(super) struct Section<'t> {
    /// Its name in capitals, with single blanks.
    pub name: String,
    /// Its first header.
    pub span: Span,
    /// Its lines, in the order of the file.
    pub entries: Vec<Entry<'t>>,
}

/// What the lines of a file are.
#[derive(Clone, Debug, Default)]
pub(super) struct Lines<'t> {
    /// The sections, in the order of the file; one that is opened twice is one section.
    pub sections: Vec<Section<'t>>,
    /// Further headers of sections that were open before, by the number of the section.
    pub reopened: Vec<(usize, Span)>,
    /// Lines that are neither header nor comment nor key and value, and the section they stand in.
    pub stray: Vec<(usize, Span)>,
    /// Headers without their closing bracket.
    pub unclosed: Vec<Span>,
}

impl<'t> Lines<'t> {
    /// The section of that name.
    pub fn section(&self, name: &str) -> Option<&Section<'t>> {
        self.sections.iter().find(|section| section.name == name)
    }
}

/// What counts of a value that is a number or a list of them: a `;` begins a comment.
pub(super) fn number_part(value: &str) -> &str {
    value.split(';').next().unwrap_or("").trim()
}

/// Reads the lines of a text.
pub(super) fn lines(file: FileId, text: &str) -> Lines<'_> {
    let mut found = Lines::default();
    let mut numbers: BTreeMap<String, usize> = BTreeMap::new();
    let mut current: Option<usize> = None;
    let mut at = 0;
    for piece in text.split_inclusive(['\n', '\r']) {
        let start = at;
        at += piece.len();
        let line = piece.trim_matches(|c: char| c.is_whitespace() || c == '\u{FEFF}' || c == '\0');
        // Programs of DOS end a text with this sign.
        let line = line.trim_end_matches('\u{1A}');
        if line.is_empty() || line.starts_with(';') {
            continue;
        }
        let begin = start + piece.find(line).unwrap_or(0);
        let span = Span::new(file, begin, begin + line.len());
        if let Some(rest) = line.strip_prefix('[') {
            let Some((name, _)) = rest.split_once(']') else {
                found.unclosed.push(span);
                current = None;
                continue;
            };
            let words: Vec<&str> = name.split_whitespace().collect();
            let name = words.join(" ").to_uppercase();
            current = Some(match numbers.get(&name) {
                Some(&known) => {
                    found.reopened.push((known, span));
                    known
                }
                None => {
                    numbers.insert(name.clone(), found.sections.len());
                    found.sections.push(Section { name, span, entries: Vec::new() });
                    found.sections.len() - 1
                }
            });
            continue;
        }
        // What stands before the first section belongs to none.
        let Some(number) = current else { continue };
        match line.split_once('=') {
            Some((key, value)) => {
                let entry = Entry { key: key.trim(), value: value.trim(), span };
                found.sections[number].entries.push(entry);
            }
            None => found.stray.push((number, span)),
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_read_as_programs_leave_them() {
        let text = "\u{FEFF}; a comment\r\n[ Warp ]\rThreads = 4 ; so many\n\n\n [color  table]\n1=2\n[WARP]\r\nRising Shed=yes\n5\n";
        let found = lines(FileId(0), text);
        let names: Vec<&str> = found.sections.iter().map(|s| s.name.as_str()).collect();
        assert_eq!(names, ["WARP", "COLOR TABLE"]);
        let warp = found.section("WARP").unwrap();
        assert_eq!(warp.entries.len(), 2);
        assert!(warp.entries[0].is("THREADS"));
        assert_eq!(number_part(warp.entries[0].value), "4");
        assert_eq!((found.reopened.len(), found.stray.len()), (1, 1));
        let span = warp.entries[1].span;
        assert_eq!(&text[span.start as usize..span.end as usize], "Rising Shed=yes");
    }
}
