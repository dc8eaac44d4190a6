//! Rows in words, as knitters write and read them: `row 1: k2, *p1, k1; repeat from * to end`.
//!
//! There is no standard; what is read here is the usage of printed patterns that KnitSpeak
//! formalised. A row begins with the numbers of the rows that are worked so, and perhaps with the
//! side: odd rows are worked on the face and even ones on the wrong side, where a knitter purls
//! what is seen as knitted; in the round all are worked on the face. Then come stitches with their
//! numbers, `[…] 3 times`, and at most one repeat that goes as often as the stitches allow:
//! `*…; repeat from * to last 2 sts`, or short `*…*`. `repeat rows 1-4` works rows again.

mod words;

use super::chart::Chart;
use super::symbol::{Cable, Lean, Symbol};
use std::ops::Range;
use words::{Reader, Token};

/// What is wrong with a row.
#[derive(Clone, Debug, PartialEq)]
pub struct Objection {
    /// The code of the message.
    pub code: &'static str,
    /// Which of the texts.
    pub line: usize,
    /// Where in it, in bytes.
    pub at: Range<usize>,
    /// What is wrong.
    pub message: String,
    /// What to do.
    pub help: String,
}

/// How a pattern is worked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Way {
    /// Stitches cast on, where the text says it.
    pub stitches: Option<usize>,
    /// In the round: every row on the face.
    pub round: bool,
}

/// Reads rows in words, as they are charted: first row first, all equally wide; narrower ones
/// begin with columns without stitch.
///
/// # Errors
/// The first thing that is wrong: E0607 what cannot be read, E0603 stitches that do not add up,
/// E0208 stitches that must be known, E0601 a chart too large.
pub fn written(lines: &[&str], way: Way) -> Result<Vec<Vec<Symbol>>, Objection> {
    // Rows as the hands work them, from the right on the face, by number from 1.
    let mut rows: Vec<Vec<Symbol>> = Vec::new();
    let mut live = way.stitches;
    for (line, text) in lines.iter().enumerate() {
        let mut reader = Reader { line, text, at: 0 };
        if reader.rest().trim().is_empty() {
            continue;
        }
        match reader.head(rows.len(), way.round)? {
            Head::Again { rows: again, times } => {
                let block: Vec<Vec<Symbol>> = rows[again.clone()].to_vec();
                let first = rows.get(again.start).map_or(0, |row| uses(row));
                for _ in 0..times {
                    if live.is_some_and(|live| live != first) {
                        let message = format!(
                            "row {} works {first} stitches, {} are left by the row below",
                            again.start + 1,
                            live.unwrap_or(0)
                        );
                        let help = "rows can be worked again where as many stitches are left as they began with";
                        return Err(reader.objection("E0603", 0..text.len(), message, help));
                    }
                    if rows.len() + block.len() > Chart::LARGEST {
                        return Err(reader.too_large());
                    }
                    rows.extend(block.iter().cloned());
                    live = rows.last().map(|row| leaves(row));
                }
            }
            Head::Rows { numbers, wrong_side } => {
                let body = reader.at;
                let parts = reader.parts(None)?;
                if parts.is_empty() {
                    let help = "such as `k2, p2`";
                    let message = "the row works no stitch".to_owned();
                    return Err(reader.objection("E0607", body..text.len(), message, help));
                }
                for (number, wrong_side) in numbers.zip(std::iter::repeat(wrong_side)) {
                    let worked = reader.worked(number, &parts, live, body)?;
                    live = Some(leaves(&worked));
                    let wrong_side = wrong_side.unwrap_or(!way.round && number % 2 == 0);
                    rows.push(match wrong_side {
                        // Worked from the left as seen on the face; kept as if from the right.
                        true => worked.into_iter().rev().map(Symbol::from_wrong_side).collect(),
                        false => worked,
                    });
                    if rows.len() > Chart::LARGEST {
                        return Err(reader.too_large());
                    }
                }
            }
        }
    }
    let width = rows.iter().map(Vec::len).max().unwrap_or(0);
    for row in &mut rows {
        row.resize(width, Symbol::NoStitch);
        row.reverse();
    }
    Ok(rows)
}

fn uses(row: &[Symbol]) -> usize {
    row.iter().map(|symbol| symbol.uses()).sum()
}

fn leaves(row: &[Symbol]) -> usize {
    row.iter().map(|symbol| symbol.leaves()).sum()
}

/// What a line begins with.
enum Head {
    /// Rows that are worked so, by number from 1, and their side where it is said.
    Rows { numbers: std::vec::IntoIter<usize>, wrong_side: Option<bool> },
    /// Rows, from 0, that are worked again.
    Again { rows: Range<usize>, times: usize },
}

/// A part of a row.
#[derive(Clone, Debug, PartialEq)]
enum Part {
    /// So many of a stitch; none where nothing is said, as in `row 2: p`.
    Stitch(Symbol, Option<usize>),
    /// A stitch as far as `to last 3 sts` or to the end.
    Filled(Symbol, Option<usize>),
    /// Parts so many times.
    Times(Vec<Part>, usize),
    /// Parts as often as there is room, but for the last stitches where that is said.
    Open(Vec<Part>, Option<usize>),
}

const STITCHES: &str = "stitches are k, p, sl, yo, k2tog, ssk, k3tog, sssk, p2tog, ssp, p3tog, \
                        cdd, m1l, m1r, mb, tuck, and cables such as `2/2 LC` and `2/1 RPC`";

impl Reader<'_> {
    /// `row 1 (RS):`, `rows 2, 4 and 6:`, `rounds 1-3:`, `repeat rows 1-4 twice`. `before` rows
    /// are known.
    fn head(&mut self, before: usize, round: bool) -> Result<Head, Objection> {
        const HELP: &str = "a row begins with its number: `row 1: k2, p2`";
        const ROWS: [&str; 6] = ["row", "rows", "round", "rounds", "rnd", "rnds"];
        if self.passes(&["repeat", "rep", "work"]) {
            if !self.passes(&ROWS) {
                return Err(self.wanted("`rows`", "such as `repeat rows 1-4 twice`"));
            }
            let from = self.at;
            let first = self.number().ok_or_else(|| self.wanted("a row", "such as `1-4`"))?;
            let last = if self.passes(&["-", "–", "to"]) {
                self.number().ok_or_else(|| self.wanted("a row", "such as `1-4`"))?
            } else {
                first
            };
            if first == 0 || first > last || last > before {
                let message = format!("rows {first} to {last} are not known here");
                let help = format!("rows 1 to {before} stand above");
                return Err(self.objection("E0607", from..self.at, message, &help));
            }
            let times = self.times()?.unwrap_or(1);
            self.passes(&["."]);
            if self.peek().is_some() {
                return Err(self.wanted("the end of the row", "a row goes on a line of its own"));
            }
            return Ok(Head::Again { rows: first - 1..last, times });
        }
        if !self.passes(&ROWS) {
            return Err(self.wanted("`row` with its number", HELP));
        }
        let from = self.at;
        let mut numbers = Vec::new();
        loop {
            let first = self.number().ok_or_else(|| self.wanted("the number of a row", HELP))?;
            let last = if self.passes(&["-", "–", "to"]) {
                self.number().ok_or_else(|| self.wanted("the number of a row", HELP))?
            } else {
                first
            };
            if last < first || last > Chart::LARGEST {
                return Err(self.too_large());
            }
            numbers.extend(first..=last);
            if numbers.len() > Chart::LARGEST {
                return Err(self.too_large());
            }
            if !self.passes(&[",", "and", "&"]) {
                break;
            }
            self.passes(&["and"]);
        }
        let wanted = before + 1..before + 1 + numbers.len();
        if !numbers.iter().copied().eq(wanted.clone()) {
            let message = format!("row {} is to be said here", wanted.start);
            let help = "rows are said from the first, each once; rows that are alike in a run: \
                        `rows 1-4: k`";
            return Err(self.objection("E0607", from..self.at, message, help));
        }
        let mut wrong_side = None;
        if self.passes(&["("]) {
            wrong_side = match self.next().map(|token| token.text).as_deref() {
                Some("rs") => Some(false),
                Some("ws") if !round => Some(true),
                _ => return Err(self.wanted("`(RS)` or `(WS)`", "in the round all is `(RS)`")),
            };
            if !self.passes(&[")"]) {
                return Err(self.wanted("`)`", HELP));
            }
        }
        if !self.passes(&[":"]) {
            return Err(self.wanted("`:`", HELP));
        }
        Ok(Head::Rows { numbers: numbers.into_iter(), wrong_side })
    }

    /// `3 times`, `x3`, `twice`.
    fn times(&mut self) -> Result<Option<usize>, Objection> {
        if self.passes(&["once"]) {
            return Ok(Some(1));
        }
        if self.passes(&["twice"]) {
            return Ok(Some(2));
        }
        let start = self.at;
        let by_sign = self.passes(&["x", "×"]);
        if !by_sign {
            if let Some(token) = self.peek().filter(|it| it.text.starts_with('x')) {
                if let Ok(number) = token.text[1..].parse::<usize>() {
                    self.at = token.at.end;
                    return self.bounded(number, start).map(Some);
                }
            }
        }
        let Some(number) = self.number() else {
            return match by_sign {
                true => Err(self.wanted("a number", "such as `[k2, p2] x 3`")),
                false => Ok(None),
            };
        };
        if !self.passes(&["times", "x", "×"]) && !by_sign {
            self.at = start;
            return Ok(None);
        }
        self.passes(&["more"]);
        self.bounded(number, start).map(Some)
    }

    fn bounded(&self, number: usize, start: usize) -> Result<usize, Objection> {
        if number == 0 || number > Chart::LARGEST {
            let message = format!("{number} times is not done");
            return Err(self.objection("E0607", start..self.at, message, "from once on"));
        }
        Ok(number)
    }

    /// Parts up to a closing sign or the end of the row.
    fn parts(&mut self, open: Option<(char, usize)>) -> Result<Vec<Part>, Objection> {
        let mut parts = Vec::new();
        loop {
            if self.passes(&[",", ";", "."]) {
                continue;
            }
            let Some(token) = self.peek() else {
                return match open {
                    // `*` may be closed by `repeat from *`, which its caller looks for.
                    None => Ok(parts),
                    Some((sign, from)) => {
                        let message = format!("`{sign}` is not closed");
                        let help = match sign {
                            '*' => "such as `*k2, p2*`, or `*k2, p2; repeat from *`",
                            _ => "such as `[k2, p2] 3 times`",
                        };
                        Err(self.objection("E0607", from..from + 1, message, help))
                    }
                };
            };
            match token.text.as_str() {
                "]" | ")" if open.is_some_and(|(sign, _)| sign != '*') => return Ok(parts),
                "*" | "repeat" | "rep" if open.is_some_and(|(sign, _)| sign == '*') => {
                    return Ok(parts);
                }
                "[" | "(" | "*" if open.is_some_and(|(sign, _)| sign != '*') => {
                    let message = "a repeat stands in another".to_owned();
                    let help = "write the inner one out";
                    return Err(self.objection("E0607", token.at, message, help));
                }
                "[" | "(" => {
                    self.at = token.at.end;
                    let sign = if token.text == "[" { '[' } else { '(' };
                    let inner = self.parts(Some((sign, token.at.start)))?;
                    self.passes(&["]", ")"]);
                    let times = self.times()?.unwrap_or(1);
                    parts.push(Part::Times(inner, times));
                }
                "*" => {
                    self.at = token.at.end;
                    let inner = self.parts(Some(('*', token.at.start)))?;
                    let last = self.closed_star()?;
                    parts.push(match last {
                        Closed::Times(times) => Part::Times(inner, times),
                        Closed::Open(last) => Part::Open(inner, last),
                    });
                }
                _ => {
                    let part = self.stitch()?;
                    parts.push(part);
                }
            }
        }
    }

    /// What follows the parts of a repeat: `*`, `* 3 times`, `; repeat from * to last 2 sts`.
    fn closed_star(&mut self) -> Result<Closed, Objection> {
        const HELP: &str = "such as `*k2, p2; repeat from * to last 2 sts`";
        let short = self.passes(&["*"]);
        if short {
            if let Some(times) = self.times()? {
                return Ok(Closed::Times(times));
            }
            // `*k2, p2* repeat` and `*k2, p2*; repeat from *` are said too.
            let start = self.at;
            while self.passes(&[",", ";"]) {}
            if !self.passes(&["repeat", "rep"]) {
                self.at = start;
                return Ok(Closed::Open(self.to()?.flatten()));
            }
        } else {
            self.passes(&["repeat", "rep"]);
        }
        if self.passes(&["from"]) && !self.passes(&["*"]) {
            return Err(self.wanted("`*`", HELP));
        }
        if let Some(times) = self.times()? {
            // The parts are worked once before they are repeated.
            return Ok(Closed::Times(times + 1));
        }
        Ok(Closed::Open(self.to()?.flatten()))
    }

    /// `to end`, `to last 3 sts`, `across`: none where nothing is said.
    #[allow(clippy::option_option)]
    fn to(&mut self) -> Result<Option<Option<usize>>, Objection> {
        const HELP: &str = "such as `to end` or `to last 3 sts`";
        if self.passes(&["across", "around"]) {
            return Ok(Some(None));
        }
        if !self.passes(&["to"]) {
            return Ok(None);
        }
        self.passes(&["the"]);
        if self.passes(&["end"]) {
            if self.passes(&["of"]) {
                self.passes(&["the"]);
                self.passes(&["row", "round", "rnd"]);
            }
            return Ok(Some(None));
        }
        if !self.passes(&["last"]) {
            return Err(self.wanted("`end` or `last`", HELP));
        }
        let number = self.number();
        if !self.passes(&["st", "sts", "stitch", "stitches"]) {
            return Err(self.wanted("`sts`", HELP));
        }
        Ok(Some(Some(number.unwrap_or(1))))
    }

    /// A stitch with its number.
    fn stitch(&mut self) -> Result<Part, Objection> {
        let Some(token) = self.next() else { return Err(self.wanted("a stitch", STITCHES)) };
        let word = token.text.as_str();
        let unknown = || {
            let message = format!("`{word}` is no stitch that is known");
            self.objection("E0607", token.at.clone(), message, STITCHES)
        };
        if word.contains('/') {
            return self.cable(&token);
        }
        if let Some(symbol) = short(word).or_else(|| Symbol::named(word)) {
            if symbol == Symbol::Slip {
                self.passes(&["wyib", "wyif"]);
            }
            return Ok(match self.to()? {
                Some(last) => Part::Filled(symbol, last),
                None => Part::Stitch(symbol, None),
            });
        }
        let stem = word.trim_end_matches(|c: char| c.is_ascii_digit());
        let count: usize = match word[stem.len()..].parse() {
            Ok(count) => count,
            Err(_) => return Err(unknown()),
        };
        let Some(symbol) = short(stem).or_else(|| Symbol::named(stem)) else {
            return Err(unknown());
        };
        if count == 0 || count > Chart::LARGEST {
            return Err(unknown());
        }
        if symbol == Symbol::Slip {
            self.passes(&["wyib", "wyif"]);
        }
        Ok(Part::Stitch(symbol, Some(count)))
    }

    /// `2/2 LC`, `2/1 RPC`.
    fn cable(&mut self, token: &Token) -> Result<Part, Objection> {
        let cut = token.text.find(|c: char| c != '/' && !c.is_ascii_digit());
        let (numbers, kind) = token.text.split_at(cut.unwrap_or(token.text.len()));
        let kind = match kind {
            "" => self.next().map_or_else(String::new, |token| token.text),
            kind => kind.to_owned(),
        };
        let side =
            |text: &str| text.parse::<u8>().ok().filter(|count| (1..=Cable::MOST).contains(count));
        let sides = numbers.split_once('/').and_then(|(a, b)| Some((side(a)?, side(b)?)));
        let lean = match kind.as_str() {
            "lc" => Some((Lean::Left, false)),
            "rc" => Some((Lean::Right, false)),
            "lpc" => Some((Lean::Left, true)),
            "rpc" => Some((Lean::Right, true)),
            _ => None,
        };
        let (Some((front, behind)), Some((lean, purl))) = (sides, lean) else {
            let message = format!("`{}` is no cable", &self.text[token.at.start..self.at]);
            let help = "cables are such as `2/2 LC`: two in front go to the left of two behind; \
                        RC to the right, LPC and RPC purl those behind";
            return Err(self.objection("E0607", token.at.start..self.at, message, help));
        };
        Ok(Part::Stitch(Symbol::Cable(Cable { front, behind, lean, purl }), Some(1)))
    }

    /// The stitches of a row, from the right of the hands, where `live` are left by the row below.
    fn worked(
        &self,
        number: usize,
        parts: &[Part],
        live: Option<usize>,
        body: usize,
    ) -> Result<Vec<Symbol>, Objection> {
        let at = body..self.text.len();
        let sole = parts.len() == 1;
        let open: Vec<usize> = (0..parts.len())
            .filter(|&n| match &parts[n] {
                Part::Open(..) | Part::Filled(..) => true,
                Part::Stitch(_, None) => sole,
                _ => false,
            })
            .collect();
        if let [_, _, ..] = open.as_slice() {
            let message = "two repeats of a row go on to its end".to_owned();
            let help = "say how often one is worked: `[k2, p2] 3 times`";
            return Err(self.objection("E0607", at, message, help));
        }
        let mut fixed = Vec::new();
        for (n, part) in parts.iter().enumerate() {
            fixed.push(if open.contains(&n) { Vec::new() } else { self.fixed(part)? });
        }
        let counted: usize = fixed.iter().map(|row| uses(row)).sum();
        if let Some(&n) = open.first() {
            let (body_row, last) = match &parts[n] {
                Part::Open(inner, last) => {
                    let mut row = Vec::new();
                    for part in inner {
                        row.extend(self.fixed(part)?);
                    }
                    (row, *last)
                }
                Part::Filled(symbol, last) => (vec![*symbol], *last),
                Part::Stitch(symbol, _) => (vec![*symbol], None),
                Part::Times(..) => (Vec::new(), None),
            };
            let Some(live) = live else {
                let message = format!("row {number} goes on to its end, and nothing says where");
                let help = "say how many stitches are cast on: `stitches: 24`";
                return Err(self.objection("E0208", at, message, help));
            };
            let after: usize = fixed[n + 1..].iter().map(|row| uses(row)).sum();
            if let Some(last) = last.filter(|last| *last != after) {
                let message = format!("row {number} leaves {last} stitches and then works {after}");
                let help = format!("`to last {after} sts` is meant, or other stitches at the end");
                return Err(self.objection("E0603", at, message, &help));
            }
            let once = uses(&body_row);
            let room = live.checked_sub(counted);
            let Some(times) =
                room.filter(|room| once > 0 && room % once == 0).map(|room| room / once)
            else {
                let message = format!(
                    "row {number} works {counted} stitches and {once} over and over, \
                     {live} are left by the row below"
                );
                let help = format!("a multiple of {once} and {counted} more are wanted");
                return Err(self.objection("E0603", at, message, &help));
            };
            if body_row.len().saturating_mul(times) > Chart::LARGEST {
                return Err(self.too_large());
            }
            fixed[n] = body_row.repeat(times);
        } else if let Some(live) = live.filter(|live| *live != counted) {
            let below = if number == 1 { "cast on" } else { "left by the row below" };
            let message = format!("row {number} works {counted} stitches, {live} are {below}");
            let help = "each stitch of a row is worked once by the row above";
            return Err(self.objection("E0603", at, message, help));
        }
        let row: Vec<Symbol> = fixed.concat();
        if row.len() > Chart::LARGEST {
            return Err(self.too_large());
        }
        Ok(row)
    }

    /// The stitches of a part that is worked a known number of times.
    fn fixed(&self, part: &Part) -> Result<Vec<Symbol>, Objection> {
        let row = match part {
            Part::Stitch(symbol, count) => match symbol {
                Symbol::Cable(cable) => vec![*symbol; cable.width()],
                _ => vec![*symbol; count.unwrap_or(1)],
            },
            Part::Times(inner, times) => {
                let mut row = Vec::new();
                for part in inner {
                    row.extend(self.fixed(part)?);
                }
                if row.len().saturating_mul(*times) > Chart::LARGEST {
                    return Err(self.too_large());
                }
                row.repeat(*times)
            }
            Part::Open(..) | Part::Filled(..) => {
                let message = "a part that goes on to the end stands in another".to_owned();
                let help = "say how many stitches it works";
                return Err(self.objection("E0607", 0..self.text.len(), message, help));
            }
        };
        Ok(row)
    }
}

/// How a repeat between `*` ends.
enum Closed {
    Times(usize),
    Open(Option<usize>),
}

/// The short words of written rows.
fn short(word: &str) -> Option<Symbol> {
    Some(match word {
        "k" => Symbol::Knit,
        "p" => Symbol::Purl,
        "sl" => Symbol::Slip,
        "mb" => Symbol::Bobble,
        "cdd" | "s2kp" | "sk2p" => Symbol::Centred,
        "m1" => Symbol::Made(Lean::Left),
        "skp" => return Symbol::named("ssk"),
        _ => return None,
    })
}

#[cfg(test)]
mod tests;
