//! Names, numbers, colours and strings.

use super::grammar::{Part, Rule};
use super::lookalike;
use super::mistake;
use super::reader::Reader;
use super::tree::{ExprKind, Name};
use crate::diagnostic::{Diagnostic, Span};
use unicode_normalization::UnicodeNormalization;

impl Reader<'_> {
    /// A name, in normal form C.
    pub(super) fn name(&mut self, part: &Part) -> Name {
        let span = self.span(part);
        let text: String = if part.as_str().is_ascii() {
            part.as_str().to_owned()
        } else {
            part.as_str().nfc().collect()
        };
        if let Some(plain) = lookalike::latin(&text) {
            self.tell(
                Diagnostic::new(
                    "E0110",
                    format!("`{text}` mixes letters of two alphabets that look alike"),
                )
                .at(span, format!("write `{plain}`")),
            );
        }
        Name { text, span }
    }

    /// A name that is being given to something.
    pub(super) fn new_name(&mut self, part: &Part) -> Name {
        let name = self.name(part);
        if mistake::RESERVED.contains(&name.text.as_str()) {
            self.tell(mistake::reserved(&name.text, name.span));
        }
        name
    }

    /// What stands before a colon: a name, `2HB`, or a string.
    pub(super) fn key(&mut self, part: Part) -> Name {
        let span = self.span(&part);
        let string = part.clone().into_inner().find(|inner| inner.as_rule() == Rule::string);
        match string {
            Some(string) => Name { text: self.string(string).nfc().collect(), span },
            None => self.name(&part),
        }
    }

    /// `12`, `1.3e-5N.m`, `1 3/8in`
    pub(super) fn number(&mut self, part: Part) -> ExprKind {
        let span = self.span(&part);
        let mut value = f64::NAN;
        let mut unit = None;
        for inner in part.into_inner() {
            match inner.as_rule() {
                Rule::unit => {
                    // The micro sign and the Greek letter both stand for the `u` of `um`.
                    let text = inner.as_str().replace(['\u{B5}', '\u{3BC}'], "u");
                    unit = Some(Name { text, span: self.span(&inner) });
                }
                _ => value = decimal(inner.as_str()),
            }
        }
        if let Some(sign) = unit.as_ref().and_then(stuck_sign) {
            self.tell(
                Diagnostic::new("E0105", "`x` between two sizes stands between blanks")
                    .at(sign, "write ` x `")
                    .help("such as `20cm x 30cm`"),
            );
            return ExprKind::Unread;
        }
        if value.is_finite() {
            return ExprKind::Number { value, unit };
        }
        self.tell(
            Diagnostic::new("E0115", "this number is out of reach")
                .at(span, "here")
                .help("numbers go up to about 1.8e308, and nothing is divided by 0"),
        );
        ExprKind::Unread
    }

    /// The text of a string, escapes resolved.
    pub(super) fn string(&mut self, part: Part) -> String {
        let span = self.span(&part);
        let raw = part.into_inner().next();
        let (text, sound) = unescaped(raw.as_ref().map_or("", |raw| raw.as_str()));
        if !sound {
            self.tell(
                Diagnostic::new("E0113", "this string names a character that does not exist")
                    .at(span, "here")
                    .help("`\\u{…}` takes the number of a Unicode character, such as `\\u{e9}`"),
            );
        }
        text
    }
}

/// The `x` of `20cmx30cm` or `128x128`, which was read as part of a unit.
fn stuck_sign(unit: &Name) -> Option<Span> {
    let at = unit.text.find('x')?;
    let (before, after) = (unit.text.get(..at)?, unit.text.get(at + 1..)?);
    let sizes = after.starts_with(|c: char| c.is_ascii_digit())
        && (before.is_empty() || mistake::is_unit(before));
    let start = unit.span.start + u32::try_from(at).ok()?;
    sizes.then_some(Span { start, end: start + 1, ..unit.span })
}

/// The value of digits as the grammar lets them through; NaN or infinite where it has none.
fn decimal(text: &str) -> f64 {
    let (whole, fraction) = match text.split_once(' ') {
        Some((whole, fraction)) => (whole.parse().unwrap_or(f64::NAN), fraction),
        None => (0.0, text),
    };
    let rest: f64 = match fraction.split_once('/') {
        Some((above, below)) => {
            above.parse().unwrap_or(f64::NAN) / below.parse().unwrap_or(f64::NAN)
        }
        None => fraction.parse().unwrap_or(f64::NAN),
    };
    whole + rest
}

/// `#rgb`, `#rrggbb`, `#rrggbbaa`, the grammar having counted the digits.
pub(super) fn colour(text: &str) -> ExprKind {
    let digits: Vec<u8> = text.chars().filter_map(|c| u8::try_from(c.to_digit(16)?).ok()).collect();
    match digits[..] {
        [r, g, b] => ExprKind::Colour([r * 17, g * 17, b * 17, 255]),
        [r, s, g, h, b, c] => ExprKind::Colour([r * 16 + s, g * 16 + h, b * 16 + c, 255]),
        [r, s, g, h, b, c, a, d] => {
            ExprKind::Colour([r * 16 + s, g * 16 + h, b * 16 + c, a * 16 + d])
        }
        _ => ExprKind::Unread,
    }
}

/// A string without its escapes, and whether every escape names a character.
fn unescaped(raw: &str) -> (String, bool) {
    let mut text = String::with_capacity(raw.len());
    let mut sound = true;
    let mut rest = raw.chars();
    while let Some(c) = rest.next() {
        if c != '\\' {
            text.push(c);
            continue;
        }
        match rest.next() {
            Some('n') => text.push('\n'),
            Some('t') => text.push('\t'),
            Some('u') => {
                let digits: String =
                    rest.by_ref().skip(1).take_while(|&digit| digit != '}').collect();
                match u32::from_str_radix(&digits, 16).ok().and_then(char::from_u32) {
                    Some(named) => text.push(named),
                    None => sound = false,
                }
            }
            Some(other) => text.push(other),
            None => sound = false,
        }
    }
    (text, sound)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inches_come_in_fractions() {
        assert_eq!(decimal("1 3/8"), 1.375);
        assert_eq!(decimal("3/8"), 0.375);
        assert_eq!(decimal("1.3e-5"), 1.3e-5);
        assert!(!decimal("1/0").is_finite());
        assert!(!decimal("1e999").is_finite());
    }

    #[test]
    fn short_colours_double_their_digits() {
        assert_eq!(colour("#fa0"), ExprKind::Colour([0xff, 0xaa, 0x00, 0xff]));
        assert_eq!(colour("#12345678"), ExprKind::Colour([0x12, 0x34, 0x56, 0x78]));
    }

    #[test]
    fn escapes_are_resolved() {
        assert_eq!(unescaped(r#"a\"b\\\u{e9}\n"#), ("a\"b\\é\n".to_owned(), true));
        assert!(!unescaped(r"\u{d800}").1);
    }
}
