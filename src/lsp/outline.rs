//! Statements and blocks of a text, as far as its tokens show them. It needs no sound text:
//! braces, words of the table and the ends of lines are enough.

use super::scan::{self, Sort, Token};
use crate::evaluate::words::{Form, Kind, Word, vocabulary};
use std::ops::Range;

/// A text cut into statements.
#[derive(Debug, Default)]
pub struct Outline {
    /// All tokens.
    pub tokens: Vec<Token>,
    /// All statements, in the order in which they begin.
    pub statements: Vec<Statement>,
    /// All blocks; the first is the file.
    pub blocks: Vec<Block>,
}

/// One statement, without the block at its end.
#[derive(Debug)]
pub struct Statement {
    /// Its tokens.
    pub tokens: Range<usize>,
    /// The block it stands in.
    pub within: usize,
    /// The token of its label or key, the one before `:`.
    pub key: Option<usize>,
    /// The token of its first word behind a label; the key of a property.
    pub head: Option<usize>,
    /// The word of the table.
    pub word: Option<&'static Word>,
    /// The block at its end.
    pub block: Option<usize>,
    /// Doc tokens above it.
    pub docs: Range<usize>,
}

/// A block with what opens it.
#[derive(Debug)]
pub struct Block {
    /// Its kind, where the table tells it.
    pub kind: Option<Kind>,
    /// The block around it.
    pub parent: Option<usize>,
    /// The statement it belongs to.
    pub opener: Option<usize>,
    /// From behind its `{` to its `}` or the end of the text.
    pub span: Range<usize>,
}

/// Words that stand at the head of a statement whatever the block.
pub const HEADS: &[&str] = &["use", "let", "param", "fn", "for", "if", "else", "match"];

/// Reads a text.
pub fn read(text: &str) -> Outline {
    let tokens = scan::tokens(text);
    let mut reader = Reader {
        text,
        out: Outline { tokens, statements: Vec::new(), blocks: Vec::new() },
        open: vec![0],
        docs: 0..0,
    };
    reader.out.blocks.push(Block {
        kind: Some(Kind::File),
        parent: None,
        opener: None,
        span: 0..text.len(),
    });
    reader.read();
    reader.out
}

struct Reader<'t> {
    text: &'t str,
    out: Outline,
    open: Vec<usize>,
    docs: Range<usize>,
}

impl Reader<'_> {
    fn slice(&self, at: usize) -> &str {
        self.out.tokens.get(at).map_or("", |t| self.text.get(t.start..t.end).unwrap_or(""))
    }

    fn read(&mut self) {
        let mut at = 0;
        while let Some(token) = self.out.tokens.get(at).copied() {
            match (token.sort, self.slice(at)) {
                (Sort::Newline | Sort::Comment, _) | (_, ";" | ",") => at += 1,
                (Sort::Doc, _) => {
                    let begins = self.docs.end + 2 < at || self.docs.is_empty();
                    self.docs = if begins { at..at + 1 } else { self.docs.start..at + 1 };
                    at += 1;
                }
                (_, "{") => {
                    self.open_block(token.end, None);
                    at += 1;
                }
                (_, "}") => {
                    self.close_block(token.start);
                    at += 1;
                }
                _ => at = self.statement(at),
            }
        }
    }

    fn open_block(&mut self, start: usize, opener: Option<usize>) {
        let parent = self.open.last().copied();
        let around = parent.and_then(|parent| self.out.blocks.get(parent)).and_then(|b| b.kind);
        let statement = opener.and_then(|opener| self.out.statements.get(opener));
        let kind = match statement {
            // Loops and choices, and the cases of a choice, hold lines of the block around them.
            Some(Statement { head: Some(head), key, .. })
                if matches!(self.slice(*head), "for" | "if" | "else" | "match")
                    || (key.is_some() && parent.is_some_and(|parent| self.chooses(parent))) =>
            {
                around
            }
            Some(Statement { word: Some(word), .. }) => word.block,
            _ => None,
        };
        let number = self.out.blocks.len();
        self.out.blocks.push(Block { kind, parent, opener, span: start..self.text.len() });
        if let Some(statement) = opener.and_then(|opener| self.out.statements.get_mut(opener)) {
            statement.block = Some(number);
        }
        self.open.push(number);
    }

    /// Whether a block holds the cases of a `match`.
    fn chooses(&self, block: usize) -> bool {
        let opener = self.out.blocks.get(block).and_then(|block| block.opener);
        let head = opener.and_then(|opener| self.out.statements.get(opener)?.head);
        head.is_some_and(|head| self.slice(head) == "match")
    }

    fn close_block(&mut self, end: usize) {
        if self.open.len() > 1
            && let Some(block) = self.open.pop().and_then(|number| self.out.blocks.get_mut(number))
        {
            block.span.end = end;
        }
    }

    /// Whether a `name:` begins here.
    fn key_at(&self, at: usize) -> bool {
        let colon = match self.out.tokens.get(at).map(|token| token.sort) {
            Some(Sort::Word | Sort::Text) => at + 1,
            // `2HB:` is a key too.
            Some(Sort::Number)
                if self.out.tokens.get(at + 1).is_some_and(|unit| unit.sort == Sort::Unit) =>
            {
                at + 2
            }
            _ => return false,
        };
        self.slice(colon) == ":" && !self.joined(colon)
    }

    /// Whether a colon is half of `::`.
    fn joined(&self, at: usize) -> bool {
        let Some(token) = self.out.tokens.get(at) else { return false };
        let touches = |other: usize, here: usize| {
            self.slice(other) == ":"
                && self.out.tokens.get(other).is_some_and(|o| o.start == here || o.end == here)
        };
        touches(at + 1, token.end) || (at > 0 && touches(at - 1, token.start))
    }

    /// Reads the statement that begins at a token; gives the token behind it.
    fn statement(&mut self, first: usize) -> usize {
        let within = self.open.last().copied().unwrap_or(0);
        let kind = self.out.blocks.get(within).and_then(|block| block.kind);
        let mut key = None;
        let mut head = first;
        if self.key_at(first) {
            key = Some(first);
            let wide = self.out.tokens.get(first).is_some_and(|t| t.sort == Sort::Number);
            head = first + if wide { 3 } else { 2 };
        }
        let table = kind.map(vocabulary);
        let find = |at: usize, property: bool| {
            table.and_then(|table| table.find(self.slice(at), property))
        };
        let (word, head) = match key {
            Some(key) => match (find(key, true), find(head, false)) {
                (Some(word), _) => (Some(word), key),
                (None, Some(word)) => (Some(word), head),
                (None, None) => (table.and_then(|table| table.rows), key),
            },
            None => (find(first, false), first),
        };
        let (end, brace) = self.end_of(first, key.is_some());
        let is_end =
            |at: usize| self.out.tokens.get(at).is_some_and(|token| token.sort == Sort::Newline);
        let mut last = end;
        while last > first + 1 && is_end(last - 1) {
            last -= 1;
        }
        let number = self.out.statements.len();
        let docs = if self.docs.is_empty() { 0..0 } else { self.docs.clone() };
        self.docs = 0..0;
        self.out.statements.push(Statement {
            tokens: first..last,
            within,
            key,
            head: Some(head),
            word,
            block: None,
            docs,
        });
        if brace {
            let start = self.out.tokens.get(end).map_or(self.text.len(), |brace| brace.end);
            self.open_block(start, Some(number));
            return end + 1;
        }
        end
    }

    /// The token behind a statement, and whether it is the `{` of its block.
    fn end_of(&self, first: usize, keyed: bool) -> (usize, bool) {
        let mut depth = 0_usize;
        let mut at = first + 1;
        // The braces of `use "…"::{a, b}` hold names.
        let uses = self.slice(first) == "use" && !keyed;
        while let Some(token) = self.out.tokens.get(at) {
            match (token.sort, self.slice(at)) {
                (Sort::Newline, _) => {
                    // A line goes on behind these, in brackets, and between rows of a chart.
                    let before = self.slice(at - 1);
                    let joins =
                        matches!(self.out.tokens.get(at - 1).map(|t| t.sort), Some(Sort::Operator))
                            || matches!(before, "," | "and" | "or");
                    let row =
                        |n: usize| self.out.tokens.get(n).is_some_and(|t| t.sort == Sort::Row);
                    let drawn = row(at + 1) && (row(at - 1) || before == ":");
                    if depth == 0 && !joins && !drawn {
                        return (at, false);
                    }
                    // Neither an open bracket nor an open end swallows the next statement.
                    if self.begins_line(at + 1) {
                        return (at, false);
                    }
                }
                (Sort::Doc, _) => return (at, false),
                (_, "(" | "[") => depth += 1,
                (_, ")" | "]") => depth = depth.saturating_sub(1),
                (_, "{") if uses => depth += 1,
                (_, "}") if uses && depth > 0 => depth -= 1,
                (_, "{") => return (at, true),
                (_, "}" | ";") => return (at, false),
                _ if depth == 0 && at > first + 1 && self.key_at(at) => return (at, false),
                _ => {}
            }
            at += 1;
        }
        (at, false)
    }

    /// Whether a line begins like a statement: with a word of the language or a `name:`.
    fn begins_line(&self, at: usize) -> bool {
        HEADS.iter().any(|head| *head == self.slice(at)) || self.key_at(at) || {
            let within = self.open.last().copied().unwrap_or(0);
            let kind = self.out.blocks.get(within).and_then(|block| block.kind);
            let table = kind.map(vocabulary);
            let word = table.and_then(|table| table.find(self.slice(at), false));
            word.is_some_and(|word| word.form == Form::Item || word.pattern.len() > 6)
        }
    }
}

impl Outline {
    /// The innermost block that holds a byte.
    pub fn block_at(&self, at: usize) -> usize {
        let holds = |block: &Block| block.span.start <= at && at <= block.span.end;
        self.blocks.iter().rposition(holds).unwrap_or(0)
    }

    /// The statement at a byte: the last one that begins before it, on whose tokens, or right
    /// behind them on the same line, it lies.
    pub fn statement_at(&self, at: usize) -> Option<usize> {
        let number = self.statements.partition_point(|statement| {
            self.tokens.get(statement.tokens.start).is_some_and(|first| first.start < at)
        });
        let number = number.checked_sub(1)?;
        let statement = self.statements.get(number)?;
        if let Some(next) = self.tokens.get(statement.tokens.end) {
            let over = match next.sort {
                Sort::Newline => next.start < at,
                _ => next.end <= at || next.start < at,
            };
            if over {
                return None;
            }
        }
        Some(number)
    }

    /// The token that holds or touches a byte; of two a word counts before a mark.
    pub fn token_at(&self, at: usize) -> Option<usize> {
        let after = self.tokens.partition_point(|token| token.end < at);
        let touching = (after..self.tokens.len())
            .take_while(|n| self.tokens.get(*n).is_some_and(|token| token.start <= at))
            .take(2);
        let rank = |n: &usize| match self.tokens.get(*n).map(|token| token.sort) {
            Some(Sort::Word) => 3,
            Some(Sort::Newline) | None => 0,
            Some(Sort::Mark | Sort::Operator) => 1,
            _ => 2,
        };
        touching.max_by_key(rank)
    }

    /// A token's text.
    pub fn slice<'t>(&self, text: &'t str, token: usize) -> &'t str {
        self.tokens.get(token).and_then(|token| text.get(token.start..token.end)).unwrap_or("")
    }

    /// A block and those around it, from the inside out.
    pub fn around(&self, block: usize) -> impl Iterator<Item = usize> {
        std::iter::successors(Some(block), |number| {
            self.blocks.get(*number).and_then(|block| block.parent)
        })
    }

    /// The `///` lines above a statement, joined.
    pub fn doc(&self, text: &str, statement: &Statement) -> String {
        let lines = statement.docs.clone().filter_map(|number| {
            let token = self.tokens.get(number).filter(|token| token.sort == Sort::Doc)?;
            Some(text.get(token.start..token.end)?.trim_start_matches('/').trim())
        });
        lines.collect::<Vec<_>>().join("\n")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One line a statement: its kind of block, its key, its word.
    fn shown(text: &str) -> Vec<String> {
        let outline = read(text);
        outline
            .statements
            .iter()
            .map(|s| {
                let kind = outline.blocks[s.within].kind.map_or("?", Kind::noun);
                let key = s.key.map_or("", |key| outline.slice(text, key));
                let word = s.word.map_or("", |word| word.name);
                let first = outline.tokens[s.tokens.start].start;
                let last = outline.tokens[s.tokens.end - 1].end;
                format!("{kind}|{key}|{word}|{}", &text[first..last])
            })
            .collect()
    }

    #[test]
    fn statements_end_where_the_grammar_ends_them() {
        let text = "panel front of denim {\n  fabric: cotton  grid: 8mm\n  shaping: dart on\n}\n\
                    use \"a\"::{b,\n c}, std::x\nlet a = (1 +\n 2) +\n 3; let b = 4";
        assert_eq!(
            shown(text),
            [
                "file|||panel front of denim",
                "?|fabric||fabric: cotton",
                "?|grid||grid: 8mm",
                "?|shaping||shaping: dart on",
                "file|||use \"a\"::{b,\n c}, std::x",
                "file|||let a = (1 +\n 2) +\n 3",
                "file|||let b = 4",
            ]
        );
    }

    #[test]
    fn an_open_bracket_ends_with_the_next_statement() {
        let text = "garment g {\n wearer lady = female\n panel p of c {\n  outline from (0, {\n  \
                    a: line to (0,\n  b: line to start\n }\n }\n seam p.a ->\n}";
        let found = shown(text);
        assert!(found.contains(&"outline|a|line|a: line to (0,".to_owned()), "{found:#?}");
        assert!(found.contains(&"outline|b|line|b: line to start".to_owned()), "{found:#?}");
        assert!(found.contains(&"garment||seam|seam p.a ->".to_owned()), "{found:#?}");
    }

    #[test]
    fn a_statement_is_found_from_behind_its_last_word() {
        let text = "let a = 1\n\nlet b";
        let outline = read(text);
        assert_eq!(outline.statement_at(9), Some(0));
        assert_eq!(outline.statement_at(10), None);
        assert_eq!(outline.statement_at(text.len()), Some(1));
        assert_eq!(outline.statement_at(0), None);
    }
}
