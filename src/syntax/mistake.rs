//! What was probably meant by text that makes no sense.

use super::grammar::{self, Rule};
use super::lookalike;
use super::reader::Reader;
use super::tree::Name;
use crate::diagnostic::{Diagnostic, Span};

/// Words that cannot be names.
pub(super) const RESERVED: [&str; 11] =
    ["use", "let", "param", "fn", "if", "then", "else", "and", "or", "not", "for"];

/// Units that are likely to be written apart from their number. `in` is not among them: it is
/// a word too.
const UNITS: [&str; 41] = [
    "um", "mm", "cm", "m", "km", "ft", "yd", "deg", "rad", "turn", "turns", "ms", "s", "min", "h",
    "Hz", "fps", "mg", "g", "kg", "oz", "lb", "N", "mN", "cN", "kN", "gf", "kgf", "Pa", "kPa",
    "tex", "dtex", "ktex", "denier", "den", "Ne", "Nm", "gsm", "inch", "inches", "percent",
];

/// Whether a word is a unit.
pub(super) fn is_unit(word: &str) -> bool {
    UNITS.contains(&word)
}

/// What to say of a word that stands right behind a number, if it was meant to be its unit.
/// `before` is the place of what stands before the word; its number ends there.
pub(super) fn apart(text: &str, before: Span, word: &Name) -> Option<Diagnostic> {
    let gap = text.get(before.end as usize..word.span.start as usize)?;
    let written = text.get(before.start as usize..before.end as usize)?;
    let number = written
        .rsplit(|c: char| !(c.is_ascii_digit() || c == '.'))
        .next()
        .filter(|digits| digits.ends_with(|c: char| c.is_ascii_digit()))?;
    let start = before.end - u32::try_from(number.len()).ok()?;
    let whole = Span { start, ..before }.to(word.span);
    if gap.is_empty() {
        let plain: String = word
            .text
            .chars()
            .map(|c| lookalike::meant(c).map_or(c.to_string(), str::to_owned))
            .collect();
        return Some(if plain == word.text {
            Diagnostic::new("E0101", format!("`{}` is stuck to a number", word.text))
                .at(whole, "here")
                .help("names do not begin with a digit; units are Latin letters")
        } else {
            unlike(whole, &format!("{number}{}", word.text), &format!("{number}{plain}"))
        });
    }
    let blank = gap.bytes().all(|byte| matches!(byte, b' ' | b'\t'));
    (blank && (is_unit(&word.text) || word.text == "%")).then(|| {
        Diagnostic::new("E0102", "a unit is written against its number")
            .at(whole, format!("write `{number}{}`", word.text))
    })
}

/// What to say of a number written with a comma.
pub(super) fn decimal_comma(reader: &Reader, at: Span) -> Diagnostic {
    let written = reader.slice(at.start as usize, at.end as usize);
    Diagnostic::new("E0109", "a decimal point is a point, not a comma")
        .at(at, format!("write `{}`", written.replace(',', ".")))
        .help("two numbers in a row are written with a blank after the comma")
}

/// What to say of a reserved word where a name is wanted.
pub(super) fn reserved(word: &str, at: Span) -> Diagnostic {
    Diagnostic::new("E0116", format!("`{word}` is a word of the language itself"))
        .at(at, "not a name")
        .help("choose another name")
}

/// What to say of an operator with a blank on one side only.
pub(super) fn uneven(at: Span, sign: &str) -> Diagnostic {
    let told =
        Diagnostic::new("E0105", format!("`{sign}` has a blank on one side only")).at(at, "here");
    if matches!(sign, "+" | "-") {
        told.help(format!(
            "write `a {sign} b` or `a{sign}b` for one value, `a, {sign}b` or `(…)` for two"
        ))
    } else {
        told.help(format!("write `a {sign} b` or `a{sign}b`"))
    }
}

fn unlike(at: Span, written: &str, meant: &str) -> Diagnostic {
    let label = match (meant, written) {
        ("x", "\u{D7}") => "write `x` between sizes, `*` to multiply".to_owned(),
        (" " | "", _) => "write a plain blank, or nothing".to_owned(),
        _ => format!("write `{meant}`"),
    };
    let message = if written.chars().all(|c| c.is_alphanumeric() || c.is_ascii_graphic()) {
        format!("`{written}` is not what it looks like")
    } else {
        let codes: Vec<String> = written
            .chars()
            .filter(|c| !c.is_ascii())
            .map(|c| format!("U+{:04X}", u32::from(c)))
            .collect();
        format!("this character, {}, is not one of the language", codes.join(" "))
    };
    Diagnostic::new("E0110", message)
        .at(at, label)
        .help("names may use every script; numbers, units and signs are ASCII")
}

/// Stray texts of a file that are looked at closely; nobody reads more explanations.
const EXPLAINED: usize = 200;

/// Letters of a broken record that are looked at.
const RECORD: usize = 2_000;

/// Explains the stray text `junk`; the statement it belongs to begins at `from`. Behind it a
/// `block` may stand, which may have been meant for a record.
pub(super) fn explain(
    reader: &mut Reader,
    from: usize,
    junk: Span,
    block: Option<Span>,
) -> Diagnostic {
    let (start, end) = (junk.start as usize, junk.end as usize);
    reader.explained += 1;
    if reader.explained > EXPLAINED {
        return Diagnostic::new("E0101", "this text makes no sense here").at(junk, "here");
    }
    let reader = &*reader;
    let text = reader.slice(from, end);
    let stop = match grammar::read(Rule::probe, text) {
        Ok(_) => start,
        Err(stop) => from + stop.at,
    };
    // Blanks are looked at on the way to what stands behind them.
    let rest = reader.slice(stop, end);
    let at = (end - rest.trim_start_matches([' ', '\t']).len()).max(start.min(stop));
    let site = Site { reader, from, junk, at, rest: reader.slice(at, end) };
    if let (true, Some(block)) = (site.rest.is_empty(), block)
        && let Some(told) = site.record(block)
    {
        return told;
    }
    site.invisible()
        .or_else(|| site.doc())
        .or_else(|| site.string())
        .or_else(|| site.colour())
        .or_else(|| site.unit_apart())
        .or_else(|| site.decimal_comma())
        .or_else(|| site.value_sign())
        .or_else(|| site.operator())
        .or_else(|| site.chart())
        .or_else(|| site.reserved())
        .or_else(|| site.bracket())
        .unwrap_or_else(|| site.unexpected())
}

/// A place at which a statement stops making sense.
struct Site<'r, 't> {
    reader: &'r Reader<'t>,
    /// Where the statement begins.
    from: usize,
    /// The text left over.
    junk: Span,
    /// The first byte that makes no sense.
    at: usize,
    /// The line from there on.
    rest: &'t str,
}

impl<'t> Site<'_, 't> {
    /// The statement up to the place.
    fn before(&self) -> &'t str {
        self.reader.slice(self.from, self.at)
    }

    /// The statement with all that is left over.
    fn all(&self) -> &'t str {
        self.reader.slice(self.from, self.junk.end as usize)
    }

    /// The word, number or sign at the place.
    fn token(&self) -> &'t str {
        let word = self
            .rest
            .find(|c: char| !(c.is_alphanumeric() || c == '_' || c == '.'))
            .unwrap_or(self.rest.len());
        let length =
            if word == 0 { self.rest.chars().next().map_or(0, char::len_utf8) } else { word };
        self.rest.get(..length).unwrap_or("")
    }

    fn span(&self, length: usize) -> Span {
        self.reader.place(self.at, self.at + length)
    }

    /// A character that looks like another.
    fn invisible(&self) -> Option<Diagnostic> {
        let first = self.rest.chars().next()?;
        let token = if lookalike::meant(first).is_some() && !first.is_alphanumeric() {
            self.rest.get(..first.len_utf8())?
        } else {
            let end = self
                .rest
                .find(|c: char| !(c.is_alphanumeric() || c == '_' || c == '.'))
                .unwrap_or(self.rest.len());
            self.rest.get(..end)?
        };
        if token.is_ascii() || !token.starts_with(|c: char| lookalike::meant(c).is_some()) {
            return None;
        }
        let meant: String = token
            .chars()
            .map(|c| lookalike::meant(c).map_or(c.to_string(), str::to_owned))
            .collect();
        Some(unlike(self.span(token.len()), token, &meant))
    }

    fn doc(&self) -> Option<Diagnostic> {
        self.rest.starts_with("///").then(|| {
            Diagnostic::new("E0108", "a `///` comment stands above what it describes")
                .at(self.span(self.rest.len()), "not at the end of a line")
                .help("put it on a line of its own above, or write `//` for a plain comment")
        })
    }

    /// A string without its end, or with an escape that does not exist.
    fn string(&self) -> Option<Diagnostic> {
        // The reader stops at the end of what it could take of a string, not at its beginning.
        let all = self.all();
        let open = unclosed_string(all)?;
        let at = self.from + open.at;
        if at < self.junk.start as usize {
            return None;
        }
        let span = |start, end| self.reader.place(start, end);
        Some(match open.escape {
            Some(escape) => {
                let place = self.from + escape;
                Diagnostic::new("E0113", "there is no such escape in a string")
                    .at(span(place, place + 2), "here")
                    .help("the escapes are `\\n` `\\t` `\\\"` `\\\\` and `\\u{e9}`")
            }
            None => Diagnostic::new("E0113", "this string does not end on its line")
                .at(span(at, self.junk.end as usize), "begins here")
                .help("close it with `\"`"),
        })
    }

    fn colour(&self) -> Option<Diagnostic> {
        let mark = self.all().get(..self.at - self.from + self.rest.len())?.rfind('#')?;
        let at = self.from + mark;
        let tail = self.reader.slice(at + 1, self.junk.end as usize);
        let length = 1 + tail.find(|c: char| !c.is_alphanumeric()).unwrap_or(tail.len());
        let touches = at <= self.at && self.at <= at + length;
        (touches && at >= self.junk.start as usize).then(|| {
            Diagnostic::new("E0114", "this is no colour")
                .at(self.reader.place(at, at + length), "here")
                .help("a colour has 3, 6 or 8 hexadecimal digits: `#f80`, `#ff8800`, `#ff8800c0`")
        })
    }

    /// `1,5cm` where one value is wanted.
    fn decimal_comma(&self) -> Option<Diagnostic> {
        let digits = |text: &str| text.bytes().take_while(u8::is_ascii_digit).count();
        let after = self.rest.strip_prefix(',').filter(|after| digits(after) > 0)?;
        let before = self.before();
        let number = before.trim_end_matches(|c: char| c.is_ascii_digit());
        if number.len() == before.len() {
            return None;
        }
        let unit = after.get(digits(after)..)?;
        let unit = unit.find(|c: char| !(c.is_alphanumeric() || c == '%')).unwrap_or(unit.len());
        let end = self.at + 1 + digits(after) + unit;
        Some(decimal_comma(self.reader, self.reader.place(self.from + number.len(), end)))
    }

    /// `let a : 3cm`, `let a == 3cm`: a name is given its value with `=`.
    fn value_sign(&self) -> Option<Diagnostic> {
        let all = self.all();
        let rest = all.strip_prefix("let").or_else(|| all.strip_prefix("param"))?;
        let name = rest.trim_start_matches([' ', '\t']);
        let sign = name.trim_start_matches(|c: char| c.is_alphanumeric() || c == '_');
        let sign = sign.trim_start_matches([' ', '\t']);
        let length = sign.bytes().take_while(|byte| matches!(byte, b':' | b'=')).count();
        let kind = sign.trim_start_matches([':', ' ']).starts_with(char::is_alphabetic);
        if length == 0 || sign.get(..length) == Some("=") || kind && all.starts_with("param") {
            return None;
        }
        let at = self.from + all.len() - sign.len();
        Some(
            Diagnostic::new("E0101", "a name is given its value with `=`")
                .at(self.reader.place(at, at + length), "write `=`"),
        )
    }

    /// A unit behind its number and a blank, inside brackets.
    fn unit_apart(&self) -> Option<Diagnostic> {
        let token = self.token();
        let word = Name { text: token.to_owned(), span: self.span(token.len()) };
        if token.is_empty() || token.starts_with(|c: char| !(c.is_alphabetic() || c == '%')) {
            return None;
        }
        let number = self.before().trim_end_matches([' ', '\t']);
        let before = Span { start: self.junk.start, end: 0, ..self.junk };
        let end = self.from + number.len();
        let start = (before.start as usize).min(self.from);
        apart(self.reader.text, self.reader.place(start, end), &word)
    }

    /// An operator with a blank on one side.
    fn operator(&self) -> Option<Diagnostic> {
        const SIGNS: [char; 9] = ['+', '-', '*', '/', '@', '<', '>', '=', '.'];
        // The place is the operator itself, or what follows it.
        let before = self.before();
        let own = self.rest.starts_with(SIGNS);
        let at = if own {
            self.at
        } else {
            let kept = before.trim_end_matches([' ', '\t']);
            self.from + kept.trim_end_matches(SIGNS).len()
        };
        let tail = self.reader.slice(at, self.junk.end as usize);
        let length = tail.find(|c: char| !SIGNS.contains(&c)).unwrap_or(tail.len());
        let sign = tail.get(..length).filter(|sign| {
            matches!(*sign, "+" | "-" | "*" | "/" | "@" | "<" | ">" | "==" | "<=" | ">=" | "..")
        })?;
        let blank = |c: Option<char>| c.is_none_or(|c| matches!(c, ' ' | '\t'));
        let left = blank(self.reader.slice(self.from, at).chars().next_back());
        let right = blank(tail.get(length..)?.chars().next());
        if left == right {
            return None;
        }
        Some(uneven(self.reader.place(at, at + length), sign))
    }

    fn chart(&self) -> Option<Diagnostic> {
        self.rest.starts_with('|').then(|| {
            Diagnostic::new("E0101", "rows of a chart stand only behind `name:`")
                .at(self.span(self.rest.len()), "here")
                .help("such as `matrix: |1100|0011|`, `chart:` or `picture:`")
        })
    }

    /// A reserved word where a name is wanted; not where it rightly begins the statement.
    fn reserved(&self) -> Option<Diagnostic> {
        let token = self.token();
        (RESERVED.contains(&token) && !self.begins(token))
            .then(|| reserved(token, self.span(token.len())))
    }

    /// A record that cannot be read, where a value is wanted at the end of the text left over.
    fn record(&self, block: Span) -> Option<Diagnostic> {
        let before = self.before().trim_end();
        let wanted = before.ends_with(['=', '(', '[', ',', ':'])
            || ["then", "else"].into_iter().any(|word| before.ends_with(word));
        if !wanted {
            return None;
        }
        let end = (block.end as usize).min(block.start as usize + RECORD);
        let end = self.reader.place(end, end).start as usize;
        let stop = grammar::read(Rule::probe, self.reader.slice(self.from, end)).err()?;
        let at = self.from + stop.at;
        let rest = self.reader.slice(at, end);
        let at = at + rest.len() - rest.trim_start_matches([' ', '\t']).len();
        let rest = self.reader.slice(at, end).lines().next().unwrap_or("");
        let site = Site { reader: self.reader, from: self.from, junk: self.junk, at, rest };
        let told = site.decimal_comma().or_else(|| site.unit_apart());
        Some(told.unwrap_or_else(|| {
            site.unexpected().help("a record is `{ NAME: VALUE, NAME: VALUE }`")
        }))
    }

    /// A bracket that is open at the place, the line being at its end.
    fn bracket(&self) -> Option<Diagnostic> {
        if !self.rest.is_empty() {
            return None;
        }
        let mut open = Vec::new();
        for (at, byte) in self.all().bytes().enumerate() {
            match byte {
                b'(' | b'[' => open.push(at),
                b')' | b']' => drop(open.pop()),
                _ => {}
            }
        }
        let at = self.from + open.pop()?;
        Some(
            Diagnostic::new("E0117", "this bracket is not closed")
                .at(self.reader.place(at, at + 1), "opened here")
                .help("a value goes on in the next line only inside brackets or after an operator"),
        )
    }

    /// Whether the place is the beginning of a statement that `token` may begin.
    fn begins(&self, token: &str) -> bool {
        const HEADS: [&str; 6] = ["use", "let", "param", "fn", "for", "if"];
        self.at == self.from && HEADS.contains(&token)
    }

    /// Nothing that is known: what stands there, and how such a statement looks.
    fn unexpected(&self) -> Diagnostic {
        let token = self.token();
        let told = if token.is_empty() {
            Diagnostic::new("E0101", "something is missing at the end of this line")
                .at(self.reader.place(self.at, self.at), "here")
        } else {
            let message = if self.begins(token) {
                format!("this `{token}` makes no sense")
            } else {
                format!("`{token}` cannot stand here")
            };
            Diagnostic::new("E0101", message).at(self.span(token.len()), "here")
        };
        told.help(match self.all().split([' ', '\t', '(']).next().unwrap_or("") {
            "let" => "a name for a value: `let NAME = VALUE`",
            "param" => "a parameter: `param NAME = VALUE in RANGE`",
            "fn" => "a function: `fn NAME(NAME: KIND, …): KIND = VALUE`",
            "for" => "a repetition: `for NAME in 1..6 { … }`",
            "if" | "else" => "a choice: `if CONDITION { … } else { … }`",
            "use" => "names of another file: `use \"FILE.garment\"::{NAME, NAME}`",
            _ => "a statement is `name: value`, or a word with operands and perhaps a block",
        })
    }
}

/// Where a string begins that has no end, or a wrong escape.
struct OpenString {
    at: usize,
    escape: Option<usize>,
}

fn unclosed_string(line: &str) -> Option<OpenString> {
    let bytes = line.as_bytes();
    let mut at = 0;
    while let Some(&byte) = bytes.get(at) {
        if byte == b'/' && bytes.get(at + 1) == Some(&b'/') {
            return None;
        }
        if byte == b'"' {
            let open = at;
            let mut escape = None;
            at += 1;
            loop {
                match bytes.get(at) {
                    None => return Some(OpenString { at: open, escape }),
                    Some(b'"') => break,
                    Some(b'\\') => {
                        if !bytes.get(at + 1).is_some_and(|next| b"nt\"\\u".contains(next)) {
                            escape = escape.or(Some(at));
                        }
                        at += 2;
                    }
                    Some(_) => at += 1,
                }
            }
            if escape.is_some() {
                return Some(OpenString { at: open, escape });
            }
        }
        at += 1;
    }
    None
}
