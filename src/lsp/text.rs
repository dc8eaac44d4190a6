//! Texts of open documents: lines and columns as the protocol counts them, and edits.

use crate::diagnostic::Span;
use gen_lsp_types::{Position, Range, TextDocumentContentChangeEvent};
use std::sync::Arc;

/// How columns are counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Encoding {
    /// In bytes.
    Utf8,
    /// In units of UTF-16, which every client knows.
    #[default]
    Utf16,
}

/// A text with the places at which its lines begin.
#[derive(Clone, Debug)]
pub struct Text {
    /// The text.
    pub text: Arc<str>,
    starts: Arc<[usize]>,
    encoding: Encoding,
}

impl Text {
    /// Finds the lines of a text. They end as the protocol says: with LF, CRLF or CR.
    pub fn new(text: impl Into<Arc<str>>, encoding: Encoding) -> Self {
        let text: Arc<str> = text.into();
        let bytes = text.as_bytes();
        let ends = bytes.iter().enumerate().filter(|&(at, byte)| match byte {
            b'\n' => true,
            b'\r' => bytes.get(at + 1) != Some(&b'\n'),
            _ => false,
        });
        let starts = std::iter::once(0).chain(ends.map(|(at, _)| at + 1)).collect();
        Text { text, starts, encoding }
    }

    /// How its columns are counted.
    pub fn encoding(&self) -> Encoding {
        self.encoding
    }

    /// The place of byte `at`; one beyond the end is the end.
    pub fn position(&self, at: usize) -> Position {
        let at = self.text.floor_char_boundary(at.min(self.text.len()));
        let line = self.starts.partition_point(|&start| start <= at).saturating_sub(1);
        let start = self.starts.get(line).copied().unwrap_or(0);
        let before = self.text.get(start..at).unwrap_or("");
        let column = match self.encoding {
            Encoding::Utf8 => before.len(),
            Encoding::Utf16 => before.encode_utf16().count(),
        };
        Position { line: number(line), character: number(column) }
    }

    /// The byte at a place. A column beyond its line is the end of the line, a line beyond the
    /// text is the end of the text, and the middle of a character is its beginning.
    pub fn offset(&self, place: Position) -> usize {
        let line = usize::try_from(place.line).unwrap_or(usize::MAX);
        let Some(&start) = self.starts.get(line) else { return self.text.len() };
        let end = self.starts.get(line.saturating_add(1)).map_or(self.text.len(), |&next| next);
        let line = self.text.get(start..end).unwrap_or("").trim_end_matches(['\n', '\r']);
        let column = usize::try_from(place.character).unwrap_or(usize::MAX);
        let mut left = column;
        for (at, c) in line.char_indices() {
            let width = match self.encoding {
                Encoding::Utf8 => c.len_utf8(),
                Encoding::Utf16 => c.len_utf16(),
            };
            if left < width {
                return start + at;
            }
            left -= width;
        }
        start + line.len()
    }

    /// The range of bytes `start..end`.
    pub fn range(&self, start: usize, end: usize) -> Range {
        Range { start: self.position(start), end: self.position(end.max(start)) }
    }

    /// The range of a place in this text.
    pub fn span(&self, span: Span) -> Range {
        self.range(span.start as usize, span.end as usize)
    }

    /// The text after a change. A range with its ends exchanged is put right.
    #[must_use]
    pub fn changed(&self, change: TextDocumentContentChangeEvent) -> Text {
        let new = match change {
            TextDocumentContentChangeEvent::TextDocumentContentChangeWholeDocument(whole) => {
                whole.text
            }
            TextDocumentContentChangeEvent::TextDocumentContentChangePartial(part) => {
                let (a, b) = (self.offset(part.range.start), self.offset(part.range.end));
                let (start, end) = (a.min(b), a.max(b));
                let mut new = String::with_capacity(self.text.len() + part.text.len());
                new.push_str(self.text.get(..start).unwrap_or(""));
                new.push_str(&part.text);
                new.push_str(self.text.get(end..).unwrap_or(""));
                new
            }
        };
        Text::new(new, self.encoding)
    }
}

fn number(n: usize) -> u32 {
    u32::try_from(n).unwrap_or(u32::MAX)
}

/// Where the places of an older text lie in a newer one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shift {
    /// Bytes that both begin with.
    prefix: usize,
    old_end: usize,
    new_end: usize,
}

impl Shift {
    /// Compares two texts by what they begin and end with.
    pub fn between(old: &str, new: &str) -> Shift {
        let (a, b) = (old.as_bytes(), new.as_bytes());
        let prefix = a.iter().zip(b).take_while(|(x, y)| x == y).count();
        let most = a.len().min(b.len()) - prefix;
        let suffix =
            a.iter().rev().zip(b.iter().rev()).take(most).take_while(|(x, y)| x == y).count();
        Shift { prefix, old_end: a.len() - suffix, new_end: b.len() - suffix }
    }

    /// Where `start..end` of the old text lies in the new one; none if it was touched.
    pub fn newer(&self, span: Span) -> Option<Span> {
        self.moved(span, self.old_end, self.new_end)
    }

    /// Where `start..end` of the new text lay in the old one; none if it is new.
    pub fn older(&self, span: Span) -> Option<Span> {
        self.moved(span, self.new_end, self.old_end)
    }

    fn moved(&self, span: Span, from: usize, to: usize) -> Option<Span> {
        let (start, end) = (span.start as usize, span.end as usize);
        // What touches the change may have grown into another word.
        if end < self.prefix || (from == to && from == self.prefix) {
            return Some(span);
        }
        (start > from).then(|| Span::new(span.file, start + to - from, end + to - from))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostic::FileId;
    use gen_lsp_types::{TextDocumentContentChangePartial, TextDocumentContentChangeWholeDocument};
    use proptest::prelude::*;

    fn at(line: u32, character: u32) -> Position {
        Position { line, character }
    }

    #[test]
    fn columns_are_units_of_utf16() {
        let text = Text::new("a𝄞b\r\nकाठ\rx", Encoding::Utf16);
        assert_eq!(text.offset(at(0, 3)), 5);
        assert_eq!(text.offset(at(0, 2)), 1, "inside a character is its beginning");
        assert_eq!(text.position(5), at(0, 3));
        assert_eq!(text.offset(at(1, 3)), "a𝄞b\r\nकाठ".len());
        assert_eq!(text.offset(at(0, 99)), 6, "before the end of the line");
        assert_eq!(text.position(text.text.len()), at(2, 1));
        assert_eq!(text.offset(at(7, 0)), text.text.len());
        let bytes = Text::new("a𝄞b", Encoding::Utf8);
        assert_eq!(bytes.offset(at(0, 5)), 5);
    }

    #[test]
    fn edits_outside_the_text_are_put_inside() {
        let text = Text::new("ab\ncd", Encoding::Utf16);
        let part = |start, end, new: &str| {
            text.changed(TextDocumentContentChangeEvent::TextDocumentContentChangePartial(
                TextDocumentContentChangePartial::new(Range { start, end }, None, new.to_owned()),
            ))
            .text
        };
        assert_eq!(&*part(at(0, 1), at(1, 1), "-"), "a-d");
        assert_eq!(&*part(at(1, 1), at(0, 1), "-"), "a-d");
        assert_eq!(&*part(at(9, 9), at(99, 0), "-"), "ab\ncd-");
        let whole = TextDocumentContentChangeWholeDocument::new("x".to_owned());
        assert_eq!(&*text.changed(whole.into()).text, "x");
    }

    #[test]
    fn places_move_with_an_edit() {
        let shift = Shift::between("let a = 1\nlet b = 2", "let a = 12cm\nlet b = 2");
        let span = |start, end| Span::new(FileId(0), start, end);
        assert_eq!(shift.newer(span(4, 5)), Some(span(4, 5)));
        assert_eq!(shift.newer(span(14, 15)), Some(span(17, 18)));
        assert_eq!(shift.newer(span(8, 9)), None);
        assert_eq!(shift.older(span(17, 18)), Some(span(14, 15)));
    }

    proptest! {
        #[test]
        fn every_byte_is_found_again(text in "[a-c𝄞é\r\n]{0,20}") {
            let text = Text::new(text, Encoding::Utf16);
            for (at, c) in text.text.char_indices() {
                if !matches!(c, '\n' | '\r') {
                    prop_assert_eq!(text.offset(text.position(at)), at);
                }
            }
        }

        #[test]
        fn what_is_left_alone_reads_the_same(
            a in "[ab]{0,6}", old in "[ab]{0,4}", new in "[ab]{0,4}", z in "[ab]{0,6}",
            start in 0usize..16, length in 0usize..4,
        ) {
            let (old, new) = (format!("{a}{old}{z}"), format!("{a}{new}{z}"));
            let span = Span::new(FileId(0), start.min(old.len()), (start + length).min(old.len()));
            if let Some(moved) = Shift::between(&old, &new).newer(span) {
                let (from, to) = (span.start as usize, span.end as usize);
                prop_assert_eq!(&old[from..to], &new[moved.start as usize..moved.end as usize]);
            }
        }
    }
}
