//! What is known while a text is being read, and the reading of a whole file.

use super::grammar::{self, Part, Rule, Stop};
use super::{nesting, tree};
use crate::diagnostic::place::Lines;
use crate::diagnostic::{Diagnostic, FileId, Span};

/// Turns the parts that the grammar found into the tree.
pub(super) struct Reader<'t> {
    pub(super) file: FileId,
    pub(super) text: &'t str,
    lines: Lines,
    /// Levels of value that are open at the moment.
    pub(super) depth: u32,
    /// `else if`s that are open at the moment.
    pub(super) choices: usize,
    /// Every block, in the order in which they close.
    pub(super) blocks: Vec<Braces>,
    /// Where the last message about the rest of a line was; nothing more is told of that line
    /// until it ends or a `;` begins something new.
    pub(super) rest_told: Option<usize>,
    /// Stray texts that were explained so far.
    pub(super) explained: usize,
    told: Vec<Diagnostic>,
}

/// Where a block begins and ends.
#[derive(Clone, Copy)]
pub(super) struct Braces {
    /// The `{`.
    pub(super) open: usize,
    /// The `}`; none where the text ends before it.
    pub(super) close: Option<usize>,
}

/// Reads a text that is not too long and not nested too deep.
pub(super) fn read(file: FileId, text: &str) -> (tree::File, Vec<Diagnostic>) {
    let mut reader = Reader {
        file,
        text,
        lines: Lines::of(text),
        depth: 0,
        choices: 0,
        blocks: Vec::new(),
        rest_told: None,
        explained: 0,
        told: Vec::new(),
    };
    let statements = match grammar::read(Rule::file, text) {
        Ok(parts) => reader.statements(parts.into_inner()),
        // The grammar takes any text; only its limits on depth and work stop it.
        Err(Stop { at, tired }) => {
            let place = reader.place(at, at + 1);
            reader.tell(if tired { senseless(place) } else { nesting::told(place) });
            Vec::new()
        }
    };
    reader.tell_open_blocks();
    let mut told = reader.told;
    told.sort_by_key(|diagnostic| diagnostic.labels.first().map(|label| label.span));
    (tree::File { statements }, told)
}

fn senseless(at: Span) -> Diagnostic {
    Diagnostic::new("E0118", "most of this text makes no sense")
        .at(at, "reading was given up here")
        .help("is it a `.garment` file at all?")
}

impl<'t> Reader<'t> {
    pub(super) fn tell(&mut self, diagnostic: Diagnostic) {
        self.told.push(diagnostic);
    }

    /// Tells of a word as part of something larger, and no more of the word alone.
    pub(super) fn tell_instead(&mut self, diagnostic: Diagnostic, word: Span) {
        self.told.pop_if(|last| last.labels.first().is_some_and(|label| label.span == word));
        self.tell(diagnostic);
    }

    /// The place of a part.
    pub(super) fn span(&self, part: &Part) -> Span {
        let span = part.as_span();
        Span::new(self.file, span.start(), span.end())
    }

    /// The place `start..end`, kept within the text and between characters.
    pub(super) fn place(&self, start: usize, end: usize) -> Span {
        let start = self.text.floor_char_boundary(start);
        let end = self.text.ceil_char_boundary(end).max(start);
        Span::new(self.file, start, end)
    }

    /// The end of the text.
    pub(super) fn end(&self) -> Span {
        self.place(self.text.len(), self.text.len())
    }

    /// The text of a place; nothing where the place lies outside.
    pub(super) fn slice(&self, start: usize, end: usize) -> &'t str {
        self.text.get(start..end).unwrap_or("")
    }

    /// Tells of blocks without `}`, all at once, and where the brace was probably forgotten.
    fn tell_open_blocks(&mut self) {
        let open: Vec<usize> = self
            .blocks
            .iter()
            .filter(|block| block.close.is_none())
            .map(|block| block.open)
            .collect();
        let Some(&innermost) = open.first() else { return };
        let message = match open.len() {
            1 => "this block is not closed".to_owned(),
            n => format!("{n} blocks are not closed"),
        };
        let mut told = Diagnostic::new("E0103", message)
            .at(self.place(innermost, innermost + 1), "opened here");
        if let Some(doubtful) = self.doubtful_block()
            && let Some(close) = doubtful.close
        {
            told = told.at(self.place(doubtful.open, doubtful.open + 1), "or is it this one").at(
                self.place(close, close + 1),
                "that is closed here by a brace of another block",
            );
        }
        self.tell(told.help("every `{` wants its `}`"));
    }

    /// The first block whose braces stand in lines that are indented differently.
    fn doubtful_block(&self) -> Option<Braces> {
        self.blocks.iter().copied().find(|block| {
            block.close.is_some_and(|close| {
                self.leads_line(close) && self.indent(close) != self.indent(block.open)
            })
        })
    }

    /// The blanks before the first character of the line of `at`.
    pub(super) fn indent(&self, at: usize) -> usize {
        let line = self.lines.start(at);
        let rest = self.slice(line, self.text.len());
        rest.bytes().take_while(|byte| matches!(byte, b' ' | b'\t')).count()
    }

    /// Whether only blanks stand before `at` on its line.
    pub(super) fn leads_line(&self, at: usize) -> bool {
        self.slice(self.lines.start(at), at).trim_matches([' ', '\t', '\u{FEFF}']).is_empty()
    }
}
