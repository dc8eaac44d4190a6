//! Charts: rows of text between bars, cut into cells by the keys of a legend.

use crate::diagnostic::{Diagnostic, Span};
use crate::evaluate::Evaluator;
use crate::evaluate::fields::{Fields, Phrase};
use crate::evaluate::poison::unread;
use crate::evaluate::words::Kind;
use crate::syntax::tree::{Name, Row};

/// Cells of one row or column a chart may have.
const LARGEST: usize = 4_096;

/// What the cells of a chart can be: keys with their meaning. A longer key goes before a shorter
/// one, an own key before a built-in one.
pub(super) struct Keys<T> {
    keys: Vec<(String, T)>,
}

impl<T: Copy> Keys<T> {
    pub(super) fn new(built_in: &[(&str, T)]) -> Self {
        Keys { keys: built_in.iter().map(|(key, cell)| ((*key).to_owned(), *cell)).collect() }
    }

    /// Adds a key of a legend, or gives a built-in one another meaning.
    pub(super) fn set(&mut self, key: &str, cell: T) {
        self.keys.retain(|(known, _)| known != key);
        self.keys.push((key.to_owned(), cell));
    }

    /// The longest key that `text` begins with, and its meaning.
    fn first(&self, text: &str) -> Option<(usize, T)> {
        self.keys
            .iter()
            .filter(|(key, _)| text.starts_with(key.as_str()))
            .max_by_key(|(key, _)| key.len())
            .map(|(key, cell)| (key.len(), *cell))
    }
}

/// The lines of a legend: key, phrase of its meaning.
pub(super) fn legend<'t>(ev: &mut Evaluator<'t>, fields: &Fields<'t>) -> Vec<Phrase<'t>> {
    let Some(phrase) = fields.get("legend") else { return Vec::new() };
    let Some(block) = phrase.block else { return Vec::new() };
    let lines = ev.read_plain(Kind::Legend, block, "the legend", phrase.scope);
    for line in &lines.phrases {
        if line.key.text.is_empty() {
            ev.tell(
                Diagnostic::new("E0602", "a key of a legend has at least one letter")
                    .at(line.key.span, "here"),
            );
        }
    }
    lines.phrases.into_iter().filter(|line| !line.key.text.is_empty()).collect()
}

/// A key of a legend that means something unknown.
pub(super) fn unknown_meaning(ev: &mut Evaluator<'_>, line: &Phrase<'_>, known: &[&str]) {
    if unread(line.rest) {
        return;
    }
    let place =
        line.rest.first().map_or(line.span, |first| Span { end: line.span.end, ..first.span() });
    let word = ev.snippet(place).to_owned();
    let label = ev.meant(&word, known.iter().copied());
    ev.tell(
        Diagnostic::new("E0602", format!("`{word}` is nothing that a cell can be"))
            .at(place, label)
            .help(format!("a cell can be {}", known.join(", "))),
    );
}

/// The cells of a drawing, bottom row first; see [`rows`].
pub(super) fn cells<T: Copy>(
    ev: &mut Evaluator<'_>,
    phrase: &Phrase<'_>,
    keys: &Keys<T>,
    known: &str,
) -> Option<Vec<Vec<T>>> {
    let rows = rows(ev, phrase, keys, known)?;
    Some(rows.into_iter().map(|(cells, _)| cells).collect())
}

/// The cells of a drawing with the places of its rows, bottom row first. Rows of unequal length (E0601), unknown signs
/// (E0602) and drawings without cells are told.
pub(super) fn rows<T: Copy>(
    ev: &mut Evaluator<'_>,
    phrase: &Phrase<'_>,
    keys: &Keys<T>,
    known: &str,
) -> Option<Vec<(Vec<T>, Span)>> {
    let mut rows: Vec<(Vec<T>, &Row)> = Vec::new();
    let mut good = true;
    for row in phrase.drawing {
        match cut(row, keys) {
            Ok(cells) if cells.is_empty() => {}
            Ok(cells) => rows.push((cells, row)),
            Err(sign) => {
                good = false;
                let start = sign.span.start;
                ev.tell(
                    Diagnostic::new("E0602", format!("no key for `{}`", sign.text))
                        .at(Span { start, ..sign.span }, "here")
                        .help(known.to_owned()),
                );
            }
        }
    }
    let Some((first, top)) = rows.first() else {
        if good {
            let told = Diagnostic::new("E0208", format!("`{}` has no rows", phrase.key.text))
                .at(phrase.key.span, "rows of a chart stand here, between bars")
                .help("such as `|1100|0011|`, or each row on a line of its own");
            ev.tell(told);
        }
        return None;
    };
    let width = first.len();
    if width > LARGEST || rows.len() > LARGEST {
        ev.tell(
            Diagnostic::new("E0601", format!("a chart has at most {LARGEST} rows and columns"))
                .at(phrase.key.span, format!("here are {} and {width}", rows.len())),
        );
        return None;
    }
    let (usual, sample) = common_width(&rows).unwrap_or((width, top.span));
    let count = rows.len();
    for (at, (cells, row)) in rows.iter().enumerate() {
        if cells.len() != usual {
            good = false;
            // Rows count from the bottom, as the cloth grows.
            let number = count - at;
            ev.tell(
                Diagnostic::new(
                    "E0601",
                    format!("row {number} has {} cells, the others {usual}", cells.len()),
                )
                .at(row.span, format!("{} cells", cells.len()))
                .at(sample, format!("{usual} cells"))
                .help("rows count from the bottom; all rows of a chart are equally long"),
            );
        }
    }
    good.then(|| rows.into_iter().rev().map(|(cells, row)| (cells, row.span)).collect())
}

/// The cells of a mask, bottom row first: true for cloth.
pub(in super::super) fn mask(
    ev: &mut Evaluator<'_>,
    phrase: &Phrase<'_>,
) -> Option<Vec<Vec<bool>>> {
    let keys = Keys::new(&[("#", true), (".", false)]);
    cells(ev, phrase, &keys, "`#` is cloth, `.` is none")
}

/// The length that most rows have, and a row that has it.
fn common_width<T>(rows: &[(Vec<T>, &Row)]) -> Option<(usize, Span)> {
    let of = |width: usize| rows.iter().filter(|(cells, _)| cells.len() == width).count();
    let mut best: Option<(usize, usize, Span)> = None;
    for (cells, row) in rows.iter().take(64) {
        let votes = of(cells.len());
        if best.is_none_or(|(most, ..)| votes > most) {
            best = Some((votes, cells.len(), row.span));
        }
    }
    best.map(|(_, width, span)| (width, span))
}

/// The cells of a row, or the sign that is no key. Blanks count only where they are a key.
fn cut<T: Copy>(row: &Row, keys: &Keys<T>) -> Result<Vec<T>, Name> {
    let mut cells = Vec::new();
    let mut at = 0;
    while let Some(rest) = row.text.get(at..).filter(|rest| !rest.is_empty()) {
        if let Some((length, cell)) = keys.first(rest) {
            // A key of n letters covers n cells.
            let letters = rest.get(..length).map_or(1, |key| key.chars().count());
            cells.extend(std::iter::repeat_n(cell, letters));
            at += length;
            continue;
        }
        let sign = rest.chars().next().unwrap_or(' ');
        let length = sign.len_utf8();
        if !matches!(sign, ' ' | '\t') {
            let start = row.span.start + u32::try_from(at).unwrap_or(0);
            let end = start + u32::try_from(length).unwrap_or(1);
            let text = sign.to_string();
            return Err(Name { text, span: Span { start, end, ..row.span } });
        }
        at += length;
    }
    Ok(cells)
}
