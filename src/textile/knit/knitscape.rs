//! Charts of KnitScape, a charting program for knitting machines, as it saves them.
//!
//! A file is a JSON object: `repeat` is a bitmap of stitches (0 knit, 1 purl, 2 slip, 3 tuck)
//! whose first row is the top one; `yarns` is a column of colours by number in `yarnPalette`,
//! the first row knitted first, repeated up the cloth; `needles` is a row of needles, 1 where one
//! is out of work, repeated across.

use super::chart::Chart;
use super::symbol::Symbol;
use crate::diagnostic::{Diagnostic, FileId, Span};
use crate::textile::Colour;
use crate::textile::told::Told;
use serde::Deserialize;

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
struct Saved {
    yarn_palette: Option<Vec<String>>,
    needles: Option<Bitmap>,
    repeat: Option<Bitmap>,
    yarns: Option<Bitmap>,
    /// Later versions save several repeats or blocks instead.
    repeats: Option<serde::de::IgnoredAny>,
    blocks: Option<serde::de::IgnoredAny>,
}

#[derive(Debug, Deserialize)]
struct Bitmap {
    pixels: Vec<f64>,
    width: f64,
    height: f64,
}

/// Pixels of a bitmap that is sound.
struct Pixels {
    codes: Vec<usize>,
    width: usize,
    height: usize,
}

impl Pixels {
    /// The pixel in this column and row, counted round the bitmap.
    fn at(&self, column: usize, row: usize) -> usize {
        self.codes[(row % self.height) * self.width + column % self.width]
    }
}

/// Reads a chart of KnitScape, whole: so many rows and columns that stitches, colours and needles
/// repeat together. E0641 tells a text that is none, E0642 what in it cannot be used.
pub fn read(file: FileId, text: &str) -> (Option<Chart>, Vec<Diagnostic>) {
    let mut told = Told::new(file);
    let chart = whole(file, text, &mut told);
    let chart = if told.refused() { None } else { chart };
    (chart, told.all())
}

fn whole(file: FileId, text: &str, told: &mut Told) -> Option<Chart> {
    let saved: Saved = match serde_json::from_str(text.trim_start_matches('\u{FEFF}')) {
        Ok(saved) => saved,
        Err(error) => {
            let at = offset(text, error.line(), error.column());
            let message = format!("this is no chart of KnitScape: {}", why(&error));
            let help = "it is a JSON object with `repeat`, `yarns`, `needles` and `yarnPalette`";
            let span = Span::new(file, at, at);
            told.say_with("E0641", "json", span, message, "here", Some(help));
            return None;
        }
    };
    let Some(repeat) = saved.repeat else {
        let several = saved.repeats.is_some() || saved.blocks.is_some();
        let (message, help) = match several {
            true => (
                "a workspace of several repeats or blocks is not one chart",
                "save each repeat by itself",
            ),
            false => (
                "this is no chart of KnitScape: it has no `repeat`",
                "`repeat` is the bitmap of its stitches",
            ),
        };
        told.of_file("E0641", message.to_owned(), help);
        return None;
    };
    let key = |name: &str| {
        let quoted = format!("\"{name}\"");
        let at = text.find(&quoted);
        at.map_or(Span::new(file, 0, 0), |at| Span::new(file, at, at + quoted.len()))
    };
    let repeat = pixels(repeat, "repeat", 4, "a stitch: 0 knit, 1 purl, 2 slip, 3 tuck", key, told);
    let palette = colours(&saved.yarn_palette.unwrap_or_default(), key("yarnPalette"), told);
    let yarns = saved.yarns.map(|yarns| {
        let what = format!("a colour of the {} in `yarnPalette`", palette.len());
        pixels(yarns, "yarns", palette.len(), &what, key, told)
    });
    let needles = saved.needles.map(|needles| {
        pixels(needles, "needles", 2, "a needle: 0 in work, 1 out of work", key, told)
    });
    let repeat = repeat?;
    let (yarns, needles) = (flat(yarns)?, flat(needles)?);
    let [width, height] = [
        together(repeat.width, needles.as_ref().map_or(1, |needles| needles.width)),
        together(repeat.height, yarns.as_ref().map_or(1, |yarns| yarns.height)),
    ];
    if width.max(height) > Chart::LARGEST {
        let message = format!("stitches, colours and needles repeat after {width} by {height}");
        let help = format!("a chart has at most {0} by {0}", Chart::LARGEST);
        told.say_with("E0642", "repeat", key("repeat"), message, "here", Some(&help));
        return None;
    }
    let symbol = |column: usize, row: usize| {
        if needles.as_ref().is_some_and(|needles| needles.at(column, 0) == 1) {
            return Symbol::NoStitch;
        }
        // The first row of pixels is the top one.
        match repeat.at(column, repeat.height - 1 - row % repeat.height) {
            0 => Symbol::Knit,
            1 => Symbol::Purl,
            2 => Symbol::Slip,
            _ => Symbol::Tuck,
        }
    };
    let rows: Vec<Vec<Symbol>> =
        (0..height).map(|row| (0..width).map(|column| symbol(column, row)).collect()).collect();
    let yarn = |row: usize| palette.get(yarns.as_ref()?.at(0, row)).copied();
    let colours = cells(&rows, yarn);
    match Chart::new(rows, Some(colours)) {
        Ok(chart) => Some(chart),
        Err(error) => {
            told.say("E0642", "repeat", key("repeat"), format!("`repeat`: {error}"));
            None
        }
    }
}

/// The colour that is seen in each cell: of the yarn of its row, or, where a stitch is slipped, of
/// the stitch below, counted round the repeat.
fn cells(rows: &[Vec<Symbol>], yarn: impl Fn(usize) -> Option<Colour>) -> Vec<Vec<Option<Colour>>> {
    let mut seen: Vec<Vec<Option<Colour>>> = Vec::with_capacity(rows.len());
    let width = rows.first().map_or(0, Vec::len);
    let mut held: Vec<Option<Colour>> = (0..width)
        .map(|column| {
            let last = (0..rows.len()).rev().find(|&row| rows[row][column] != Symbol::Slip);
            last.and_then(&yarn)
        })
        .collect();
    for (number, row) in rows.iter().enumerate() {
        for (column, symbol) in row.iter().enumerate() {
            if *symbol != Symbol::Slip {
                held[column] = yarn(number);
            }
        }
        let bare = |(symbol, colour): (&Symbol, &Option<Colour>)| {
            if *symbol == Symbol::NoStitch { None } else { *colour }
        };
        seen.push(row.iter().zip(&held).map(bare).collect());
    }
    seen
}

/// None where a bitmap is there and unsound.
#[allow(clippy::option_option)]
fn flat(bitmap: Option<Option<Pixels>>) -> Option<Option<Pixels>> {
    match bitmap {
        Some(None) => None,
        Some(sound) => Some(sound),
        None => Some(None),
    }
}

/// The pixels of a bitmap, each below `codes`.
fn pixels(
    bitmap: Bitmap,
    name: &str,
    codes: usize,
    what: &str,
    key: impl Fn(&str) -> Span,
    told: &mut Told,
) -> Option<Pixels> {
    let mut wrong = |message: String| {
        told.say("E0642", name, key(name), message);
        None
    };
    let side = |length: f64| {
        let sound = length.fract() == 0.0 && (1.0..=Chart::LARGEST as f64).contains(&length);
        sound.then_some(length as usize)
    };
    let (Some(width), Some(height)) = (side(bitmap.width), side(bitmap.height)) else {
        let most = Chart::LARGEST;
        let (width, height) = (bitmap.width, bitmap.height);
        return wrong(format!("`{name}` is {width} by {height}; sides go from 1 to {most}"));
    };
    if bitmap.pixels.len() != width * height {
        let found = bitmap.pixels.len();
        return wrong(format!("`{name}` has {found} pixels, not {width} by {height}"));
    }
    let mut found = Vec::with_capacity(bitmap.pixels.len());
    for (number, &code) in bitmap.pixels.iter().enumerate() {
        if code.fract() != 0.0 || !(0.0..codes as f64).contains(&code) {
            let place = format!("column {}, row {}", number % width + 1, number / width + 1);
            return wrong(format!("`{name}`, {place} from the top: {code} is not {what}"));
        }
        found.push(code as usize);
    }
    Some(Pixels { codes: found, width, height })
}

/// The colours of a palette: `#rrggbb`, with or without opacity.
fn colours(palette: &[String], at: Span, told: &mut Told) -> Vec<Colour> {
    let mut found = Vec::with_capacity(palette.len());
    for text in palette {
        let digits = text.strip_prefix('#').filter(|digits| matches!(digits.len(), 6 | 8));
        let code = digits
            .filter(|digits| digits.bytes().all(|byte| byte.is_ascii_hexdigit()))
            .and_then(|digits| u32::from_str_radix(digits.get(..6)?, 16).ok());
        let Some(code) = code else {
            let shown: String = text.chars().take(24).collect();
            let message = format!("`yarnPalette`: `{shown}` is no colour such as `#f3120d`");
            told.say("E0642", "palette", at, message);
            found.push(Colour([0, 0, 0, 255]));
            continue;
        };
        let [_, red, green, blue] = code.to_be_bytes();
        found.push(Colour([red, green, blue, 255]));
    }
    found
}

/// The least number that both divide.
fn together(one: usize, other: usize) -> usize {
    let (mut a, mut b) = (one, other);
    while b != 0 {
        (a, b) = (b, a % b);
    }
    one / a.max(1) * other
}

/// Where a line and column of serde are in the text.
fn offset(text: &str, line: usize, column: usize) -> usize {
    let start =
        text.split_inclusive('\n').take(line.saturating_sub(1)).map(str::len).sum::<usize>();
    let mut at = (start + column.saturating_sub(1)).min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

/// What serde says, without the place, which is shown.
fn why(error: &serde_json::Error) -> String {
    let said = error.to_string();
    said.rsplit_once(" at line ").map_or(said.clone(), |(what, _)| what.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn saved(repeat: &str, rest: &str) -> String {
        format!("{{\"repeat\":{repeat},\"yarnPalette\":[\"#ff0000\",\"#0000ffff\"]{rest}}}")
    }

    const TWO: &str = r#"{"pixels":[2,0,1,3],"width":2,"height":2}"#;

    #[test]
    fn the_last_row_of_pixels_is_knitted_first() {
        let yarns = r#","yarns":{"pixels":[0,1],"width":1,"height":2}"#;
        let (chart, told) = read(FileId(0), &saved(TWO, yarns));
        assert_eq!(told, []);
        let chart = chart.unwrap();
        assert_eq!(chart.rows()[0], [Symbol::Purl, Symbol::Tuck]);
        assert_eq!(chart.rows()[1], [Symbol::Slip, Symbol::Knit]);
        // The slipped stitch is seen in the colour of the row below.
        let [red, blue] = [Colour([255, 0, 0, 255]), Colour([0, 0, 255, 255])];
        assert_eq!((chart.colour(0, 1), chart.colour(1, 1)), (Some(red), Some(blue)));
    }

    #[test]
    fn stitches_colours_and_needles_repeat_together() {
        let rest = r#","yarns":{"pixels":[0,1,1],"width":1,"height":3},
                      "needles":{"pixels":[0,1,0],"width":3,"height":1}"#;
        let (chart, _) = read(FileId(0), &saved(TWO, rest));
        let chart = chart.unwrap();
        assert_eq!((chart.width(), chart.height()), (6, 6));
        assert_eq!(chart.rows()[3][4], Symbol::NoStitch);
    }

    #[test]
    fn what_is_damaged_is_told() {
        for (text, wanted) in [
            ("{".to_owned(), "E0641 this is no chart of KnitScape: EOF"),
            ("[1]".to_owned(), "E0641"),
            ("{\"a\": 1}".to_owned(), "E0641 this is no chart of KnitScape: it has no"),
            ("{\"blocks\": []}".to_owned(), "E0641 a workspace of several"),
            (saved(r#"{"pixels":[0],"width":2,"height":1}"#, ""), "E0642 `repeat` has 1 pixels"),
            (saved(r#"{"pixels":[],"width":0,"height":1}"#, ""), "E0642 `repeat` is 0 by 1"),
            (saved(r#"{"pixels":[9],"width":1,"height":1}"#, ""), "E0642 `repeat`, column 1"),
            (
                saved(r#"{"pixels":[1],"width":1e9,"height":1e9}"#, ""),
                "E0642 `repeat` is 1000000000",
            ),
            (
                saved(TWO, r#","yarns":{"pixels":[2],"width":1,"height":1}"#),
                "E0642 `yarns`, column 1, row 1 from the top: 2 is not a colour",
            ),
            (saved(TWO, "").replace("#ff0000", "red"), "E0642 `yarnPalette`: `red`"),
        ] {
            let (chart, told) = read(FileId(0), &text);
            assert_eq!(chart, None);
            let said = format!("{} {}", told[0].code, told[0].message);
            assert!(said.starts_with(wanted), "{said}");
        }
    }
}
