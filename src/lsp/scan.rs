//! The tokens of a text, found again after every keystroke, however broken the text is.
//!
//! The parser tells what is wrong; here a text is only cut into pieces to be coloured, completed
//! and explained. What makes no sense becomes a [`Sort::Mark`].

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sort {
    /// A name or a word of the language.
    Word,
    /// Digits with a fraction and an exponent, without their unit.
    Number,
    /// The unit written against a number.
    Unit,
    /// `"…"`
    Text,
    /// `#rrggbb`
    Colour,
    /// `// …`
    Comment,
    /// `/// …`
    Doc,
    /// A row of a chart between bars.
    Row,
    /// An operator, `->` or `..`.
    Operator,
    /// A bracket, a comma, a point, a colon.
    Mark,
    /// The end of a line.
    Newline,
}

/// A piece of a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Token {
    /// First byte.
    pub start: usize,
    /// One past the last byte.
    pub end: usize,
    /// What it is.
    pub sort: Sort,
}

/// Signs of more than one character, and single ones that stand between values.
const OPERATORS: &[&str] =
    &["->", "..", "==", "!=", "<=", ">=", "<", ">", "+", "-", "*", "/", "@", "="];

/// Cuts a text into tokens; blanks are left out.
pub fn tokens(text: &str) -> Vec<Token> {
    let mut scanner = Scanner { text, at: 0, found: Vec::new() };
    while let Some(c) = scanner.rest().chars().next() {
        scanner.next(c);
    }
    scanner.found
}

struct Scanner<'t> {
    text: &'t str,
    at: usize,
    found: Vec<Token>,
}

/// Whether a character may stand in a name. Marks above and below letters belong to them.
pub fn in_word(c: char) -> bool {
    c == '_' || c.is_alphanumeric() || (!c.is_ascii() && !c.is_whitespace() && !is_sign(c))
}

fn is_sign(c: char) -> bool {
    matches!(c, '\u{80}'..='\u{bf}' | '×' | '÷' | '\u{2000}'..='\u{206f}' | '\u{2190}'..='\u{2bff}')
        || c == '\u{feff}'
}

/// Letters of units.
fn in_unit(c: char) -> bool {
    c.is_ascii_alphabetic() || matches!(c, '\u{b5}' | '\u{3bc}')
}

impl<'t> Scanner<'t> {
    fn rest(&self) -> &'t str {
        self.text.get(self.at..).unwrap_or("")
    }

    fn push(&mut self, sort: Sort, length: usize) {
        let start = self.at;
        self.at += length.max(1);
        self.found.push(Token { start, end: self.at, sort });
    }

    /// Whether nothing but marks that open something stands before this on its line.
    fn leads(&self) -> bool {
        self.found.last().is_none_or(|last| {
            last.sort == Sort::Newline
                || matches!(self.text.get(last.start..last.end), Some(":" | ";" | "{" | "|"))
        })
    }

    fn next(&mut self, c: char) {
        let rest = self.rest();
        let line = || rest.find(['\n', '\r']).unwrap_or(rest.len());
        let run =
            |belongs: fn(char) -> bool| rest.find(|c: char| !belongs(c)).unwrap_or(rest.len());
        match c {
            '\n' => self.push(Sort::Newline, 1),
            '\r' => self.push(Sort::Newline, if rest.starts_with("\r\n") { 2 } else { 1 }),
            c if c.is_whitespace() || c == '\u{feff}' => self.at += c.len_utf8(),
            '/' if rest.starts_with("///") && !rest.starts_with("////") => {
                self.push(Sort::Doc, line());
            }
            '/' if rest.starts_with("//") => self.push(Sort::Comment, line()),
            '"' => self.push(Sort::Text, string(rest.get(..line()).unwrap_or(""))),
            '|' if self.leads() => {
                self.push(Sort::Row, row(rest.get(..line()).unwrap_or("")));
            }
            '#' => {
                let digits = rest.bytes().skip(1).take_while(u8::is_ascii_hexdigit).count();
                self.push(if digits > 0 { Sort::Colour } else { Sort::Mark }, 1 + digits);
            }
            '0'..='9' => self.number(rest),
            c if in_word(c) => self.push(Sort::Word, run(in_word)),
            c => match OPERATORS.iter().find(|sign| rest.starts_with(**sign)) {
                Some(sign) => self.push(Sort::Operator, sign.len()),
                None => self.push(Sort::Mark, c.len_utf8()),
            },
        }
    }

    fn number(&mut self, rest: &str) {
        let digits = |text: &str| text.bytes().take_while(u8::is_ascii_digit).count();
        let after = |at: usize| rest.get(at..).unwrap_or("");
        let mut end = digits(rest);
        let next = |at: usize, sign: char| after(at).strip_prefix(sign).map_or(0, digits);
        let below = next(end, '/');
        if below > 0 && after(end + 1 + below).starts_with(in_unit) {
            end += 1 + below;
        } else if next(end, '.') > 0 {
            end += 1 + next(end, '.');
        }
        if let Some(power) = after(end).strip_prefix(['e', 'E']) {
            let sign = usize::from(power.starts_with(['+', '-']));
            let length = digits(power.get(sign..).unwrap_or(""));
            if length > 0 {
                end += 1 + sign + length;
            }
        }
        let unit = unit(after(end));
        self.push(Sort::Number, end);
        if unit > 0 {
            self.push(Sort::Unit, unit);
        }
    }
}

/// Bytes of the unit that a text begins with.
fn unit(text: &str) -> usize {
    if text.starts_with('%') {
        return 1;
    }
    let atom = |text: &str| {
        let letters = text.find(|c| !in_unit(c)).unwrap_or(text.len());
        let rest = text.get(letters..).unwrap_or("");
        if letters == 0 { 0 } else { letters + rest.bytes().take_while(u8::is_ascii_digit).count() }
    };
    let mut end = usize::from(text.starts_with('/'));
    let first = atom(text.get(end..).unwrap_or(""));
    if first == 0 {
        return 0;
    }
    end += first;
    while text.get(end..).is_some_and(|rest| rest.starts_with(['.', '/'])) {
        match atom(text.get(end + 1..).unwrap_or("")) {
            0 => break,
            more => end += 1 + more,
        }
    }
    end
}

/// Bytes of the string that a line begins with; an open one takes the line.
fn string(line: &str) -> usize {
    let mut escaped = false;
    for (at, c) in line.char_indices().skip(1) {
        match c {
            '"' if !escaped => return at + 1,
            '\\' => escaped = !escaped,
            _ => escaped = false,
        }
    }
    line.len()
}

/// Bytes of the row that a line begins with: from its first bar to its last.
fn row(line: &str) -> usize {
    let mut end = None;
    for (at, _) in line.match_indices('|').skip(1) {
        end = Some(at + 1);
        let after = line.get(at + 1..).unwrap_or("");
        let next = after.trim_start_matches([' ', '\t']);
        let apart = next.len() < after.len();
        let key = || {
            let word = next.find(|c: char| !in_word(c)).unwrap_or(next.len());
            word > 0 && next.get(word..).is_some_and(|rest| rest.trim_start().starts_with(':'))
        };
        if next.starts_with([';', '}']) || (apart && (next.starts_with("//") || key())) {
            break;
        }
    }
    end.unwrap_or(line.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cut(text: &str) -> Vec<(&str, Sort)> {
        tokens(text).into_iter().map(|t| (&text[t.start..t.end], t.sort)).collect()
    }

    #[test]
    fn numbers_have_their_units() {
        use Sort::{Number, Operator, Unit, Word};
        assert_eq!(cut("1.3e-5N.m"), [("1.3e-5", Number), ("N.m", Unit)]);
        assert_eq!(cut("3/8in"), [("3/8", Number), ("in", Unit)]);
        assert_eq!(cut("600/m"), [("600", Number), ("/m", Unit)]);
        assert_eq!(cut("7..10"), [("7", Number), ("..", Operator), ("10", Number)]);
        assert_eq!(cut("50%"), [("50", Number), ("%", Unit)]);
        assert_eq!(cut("2/n"), [("2", Number), ("/n", Unit)]);
        assert_eq!(cut("a/2"), [("a", Word), ("/", Operator), ("2", Number)]);
    }

    #[test]
    fn names_may_be_of_any_script() {
        assert_eq!(cut("काठ्_1 é"), [("काठ्_1", Sort::Word), ("é", Sort::Word)]);
    }

    #[test]
    fn rows_are_whole() {
        let rows: Vec<_> = cut("chart: |a.b| .|  size: 3\n|  | // x\n|open")
            .into_iter()
            .filter(|(_, sort)| *sort == Sort::Row)
            .collect();
        assert_eq!(rows, [("|a.b| .|", Sort::Row), ("|  |", Sort::Row), ("|open", Sort::Row)]);
    }

    #[test]
    fn comments_and_strings_end_with_the_line() {
        assert_eq!(
            cut("\"a\\\"b\" //x\n\"open\n///d"),
            [
                ("\"a\\\"b\"", Sort::Text),
                ("//x", Sort::Comment),
                ("\n", Sort::Newline),
                ("\"open", Sort::Text),
                ("\n", Sort::Newline),
                ("///d", Sort::Doc)
            ]
        );
    }
}
