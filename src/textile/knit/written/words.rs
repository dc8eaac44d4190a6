//! The words, numbers and signs of a row.

use super::Objection;
use crate::textile::knit::Chart;
use std::ops::Range;

/// A row that is read from its left.
pub(super) struct Reader<'t> {
    /// Which of the texts it is.
    pub line: usize,
    pub text: &'t str,
    /// How far it is read, in bytes.
    pub at: usize,
}

/// A word or sign of a row.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Token {
    pub text: String,
    pub at: Range<usize>,
}

impl Reader<'_> {
    pub fn rest(&self) -> &str {
        self.text.get(self.at..).unwrap_or("")
    }

    pub fn objection(
        &self,
        code: &'static str,
        at: Range<usize>,
        message: String,
        help: &str,
    ) -> Objection {
        Objection { code, line: self.line, at, message, help: help.to_owned() }
    }

    pub fn too_large(&self) -> Objection {
        let message = format!("a chart has at most {0} rows and stitches", Chart::LARGEST);
        self.objection("E0601", 0..self.text.len(), message, "leave some out")
    }

    /// The next word, number or sign, which is passed.
    pub fn next(&mut self) -> Option<Token> {
        let token = self.peek()?;
        self.at = token.at.end;
        Some(token)
    }

    pub fn peek(&self) -> Option<Token> {
        let mut letters = self.rest().char_indices();
        let (start, first) = letters.find(|(_, c)| !c.is_whitespace())?;
        let start = self.at + start;
        let word = |c: char| c.is_ascii_alphanumeric() || c == '/' || c == '_';
        let length = if word(first) {
            let rest = self.text.get(start..).unwrap_or("");
            rest.find(|c| !word(c)).unwrap_or(rest.len())
        } else {
            first.len_utf8()
        };
        let text = self.text.get(start..start + length).unwrap_or("").to_lowercase();
        Some(Token { text, at: start..start + length })
    }

    /// Passes the next token if it is one of these.
    pub fn passes(&mut self, words: &[&str]) -> bool {
        let found = self.peek().filter(|token| words.contains(&&*token.text));
        if let Some(token) = &found {
            self.at = token.at.end;
        }
        found.is_some()
    }

    pub fn number(&mut self) -> Option<usize> {
        let token = self.peek()?;
        let number: usize = token.text.parse().ok()?;
        self.at = token.at.end;
        Some(number.min(1_000_000))
    }

    pub fn wanted(&self, what: &str, help: &str) -> Objection {
        let (found, at) = match self.peek() {
            Some(token) => (format!("`{}`", token.text), token.at),
            None => ("the end of the row".to_owned(), self.text.len()..self.text.len()),
        };
        self.objection("E0607", at, format!("{what} is wanted, here is {found}"), help)
    }
}
