//! The layout of a knitter's chart: the face of the cloth, the first row below; stitches counted
//! from the right at the bottom, rows on the face numbered at the right and rows on the wrong side
//! at the left, as the hands go; below it the symbols and colours that are in it. Symbols are
//! those of the Craft Yarn Council where it has one.

use super::{Area, Shape, Sheet, digit};
use crate::textile::Colour;
use crate::textile::knit::{Cable, Chart, Lean, Symbol};

/// Height of a cell, pixels, where there is room.
const CELL: f64 = 22.0;
/// Pixels that the longer side of the grid takes at most, as far as its cells have any.
const LONGEST: f64 = 6000.0;
/// Height of letters.
const LETTER: f64 = 7.0;

const INK: Colour = Colour([34, 34, 40, 255]);
const PALE: Colour = Colour([248, 248, 246, 255]);
const PAPER: Colour = Colour([255, 255, 255, 255]);
const LINE: Colour = Colour([188, 192, 200, 255]);
const STRONG: Colour = Colour([96, 102, 114, 255]);
const NOTHING: Colour = Colour([176, 178, 184, 255]);

/// Draws a chart. `aspect` is the height of a stitch over its width; `yarn` the colour of cells
/// for which the chart says none, white paper where nobody says it.
pub fn chart(chart: &Chart, title: &str, aspect: f64, yarn: Option<Colour>) -> Sheet {
    let (columns, rows) = (chart.width(), chart.height());
    let aspect = if aspect.is_finite() { aspect.clamp(0.4, 2.0) } else { 1.0 };
    let fits = (LONGEST / columns as f64 * aspect).min(LONGEST / rows as f64);
    let high = fits.min(CELL).floor().max(3.0);
    let wide = (high / aspect).round().max(3.0);
    let margin = 16.0;
    let beside = digit::width(&rows.to_string(), LETTER) + 10.0;
    let grid = Area {
        x: margin + beside,
        y: margin,
        width: columns as f64 * wide,
        height: rows as f64 * high,
    };
    let mut page = Page { shapes: Vec::new(), wide, high };

    let colour = |column: usize, row: usize| chart.colour(column, row).or(yarn);
    for row in 0..rows {
        let y = grid.y + (rows - 1 - row) as f64 * high;
        for (symbol, column, width) in chart.placed(row) {
            for at in column..column + width {
                let ground = match symbol {
                    Symbol::NoStitch => Some(NOTHING),
                    _ => colour(at, row),
                };
                if let Some(ground) = ground {
                    let x = grid.x + at as f64 * wide;
                    page.fill(x, y, wide, high, ground);
                }
            }
        }
    }
    page.lines(&grid, columns, rows);
    for row in 0..rows {
        let y = grid.y + (rows - 1 - row) as f64 * high;
        for (symbol, column, width) in chart.placed(row) {
            let ground = colour(column, row).unwrap_or(PAPER);
            page.symbol(symbol, grid.x + column as f64 * wide, y, width, ground);
        }
    }
    numbers(&mut page, chart, &grid);
    let below = grid.y + grid.height + 12.0 + LETTER;
    let [right, bottom] = legend(&mut page, chart, yarn, [grid.x, below + 14.0]);
    let size = |pixels: f64| (pixels + margin).ceil() as u32;
    Sheet {
        title: title.to_owned(),
        width: size((grid.x + grid.width + beside).max(right)),
        height: size(bottom),
        shapes: page.shapes,
    }
}

/// Numbers of rows and stitches.
fn numbers(page: &mut Page, chart: &Chart, grid: &Area) {
    let step = |room: f64, cell: f64| {
        [1, 2, 5, 10, 50, 100, 500].into_iter().find(|&n| n as f64 * cell >= room).unwrap_or(1000)
    };
    let counted = |most: usize, step: usize| {
        (1..=most).filter(move |number| *number == 1 || number.is_multiple_of(step))
    };
    for row in counted(chart.height(), step(LETTER + 3.0, page.high)) {
        let text = row.to_string();
        let half = digit::width(&text, LETTER) / 2.0;
        let y = grid.y + grid.height - (row as f64 - 0.5) * page.high;
        // The hands come from the right on the face, from the left on the wrong side.
        let x = match chart.round || row % 2 == 1 {
            true => grid.x + grid.width + 6.0 + half,
            false => grid.x - 6.0 - half,
        };
        page.text([x, y], text);
    }
    let room = digit::width(&chart.width().to_string(), LETTER) + 4.0;
    for stitch in counted(chart.width(), step(room, page.wide)) {
        let x = grid.x + grid.width - (stitch as f64 - 0.5) * page.wide;
        page.text([x, grid.y + grid.height + 6.0 + LETTER / 2.0], stitch.to_string());
    }
}

/// The symbols and colours of the chart with what they are; gives how far it reaches.
fn legend(page: &mut Page, chart: &Chart, yarn: Option<Colour>, corner: [f64; 2]) -> [f64; 2] {
    let [x, mut y] = corner;
    let mut right: f64 = x;
    // In a dense chart the legend keeps its size.
    let (wide, high) = (page.wide.max(16.0), page.high.max(16.0));
    let mut small = Page { shapes: Vec::new(), wide, high };
    let counts = chart.counts();
    let widest = |cable: &Cable| cable.width();
    let columns = counts.keys().filter_map(|symbol| match symbol {
        Symbol::Cable(cable) => Some(widest(cable)),
        _ => None,
    });
    let beside = columns.max().unwrap_or(1) as f64 * wide + 10.0;
    let mut row = |small: &mut Page, text: String, draw: &dyn Fn(&mut Page, f64)| {
        draw(small, y);
        let width = digit::width(&text, LETTER);
        small.text([x + beside + width / 2.0, y + high / 2.0], text);
        right = right.max(x + beside + width);
        y += high + 6.0;
    };
    for symbol in counts.keys() {
        let width = if let Symbol::Cable(cable) = symbol { cable.width() } else { 1 };
        let (word, meaning) = (symbol.word().replace('_', " "), symbol.meaning());
        let text = if word == meaning { word } else { format!("{word}  {meaning}") };
        row(&mut small, text, &|small, y| {
            let ground = if *symbol == Symbol::NoStitch { NOTHING } else { PAPER };
            small.fill(x, y, wide * width as f64, high, ground);
            let area = Area { x, y, width: wide * width as f64, height: high };
            small.lines(&area, width, 1);
            small.symbol(*symbol, x, y, width, PAPER);
        });
    }
    // A picture of a thousand colours explains itself.
    const COLOURS: usize = 64;
    let mut colours: Vec<Colour> =
        chart.palette().into_iter().filter_map(|colour| colour.or(yarn)).collect();
    colours.truncate(COLOURS);
    for colour in colours {
        let [red, green, blue, _] = colour.0;
        row(&mut small, format!("#{red:02x}{green:02x}{blue:02x}"), &|small, y| {
            small.fill(x, y, wide, high, colour);
            small.lines(&Area { x, y, width: wide, height: high }, 1, 1);
        });
    }
    page.shapes.append(&mut small.shapes);
    [right, y - 6.0]
}

/// Shapes in the making, and the size of a cell.
struct Page {
    shapes: Vec<Shape>,
    wide: f64,
    high: f64,
}

impl Page {
    fn fill(&mut self, x: f64, y: f64, width: f64, height: f64, colour: Colour) {
        self.shapes.push(Shape::Fill { area: Area { x, y, width, height }, colour });
    }

    fn text(&mut self, middle: [f64; 2], text: String) {
        self.shapes.push(Shape::Digits { middle, height: LETTER, text, colour: INK });
    }

    /// The lines of a grid; every fifth is stronger, counted from the right and from the bottom.
    fn lines(&mut self, grid: &Area, columns: usize, rows: usize) {
        let (right, bottom) = (grid.x + grid.width, grid.y + grid.height);
        let strong =
            |number: usize, last: usize| number == 0 || number == last || number.is_multiple_of(5);
        for pass in [LINE, STRONG] {
            for column in (0..=columns).filter(|&n| strong(n, columns) == (pass == STRONG)) {
                let x = right - column as f64 * self.wide;
                self.fill(x, grid.y, 1.0, grid.height + 1.0, pass);
            }
            for row in (0..=rows).filter(|&n| strong(n, rows) == (pass == STRONG)) {
                let y = bottom - row as f64 * self.high;
                self.fill(grid.x, y, grid.width + 1.0, 1.0, pass);
            }
        }
    }

    /// A symbol whose left upper corner is there, on a ground of that colour.
    fn symbol(&mut self, symbol: Symbol, x: f64, y: f64, columns: usize, ground: Colour) {
        let ink = against(ground);
        let thick = (self.high / 13.0).max(1.0);
        let (wide, high) = (self.wide, self.high);
        // A place in the cell, from its left upper corner; the lines take the first pixel.
        let at = |u: f64, v: f64| [x + 0.5 + u * wide, y + 0.5 + v * high];
        let line = |page: &mut Page, points: Vec<[f64; 2]>| {
            page.shapes.push(Shape::Line { points, thick, colour: ink });
        };
        let round = |radius: f64| {
            let radius = radius * wide.min(high);
            let middle = at(0.5, 0.5);
            (0..=24).map(move |n| {
                let angle = f64::from(n) / 24.0 * std::f64::consts::TAU;
                [middle[0] + radius * libm::cos(angle), middle[1] + radius * libm::sin(angle)]
            })
        };
        // What leans to the left is what leans to the right in a mirror.
        let side = |lean: Lean, u: f64| if lean == Lean::Right { u } else { 1.0 - u };
        match symbol {
            Symbol::Knit | Symbol::NoStitch => {}
            Symbol::Purl => line(self, vec![at(0.28, 0.5), at(0.72, 0.5)]),
            Symbol::Slip => line(self, vec![at(0.25, 0.22), at(0.5, 0.78), at(0.75, 0.22)]),
            Symbol::Tuck => {
                let arch = [(0.25, 0.8), (0.25, 0.42), (0.36, 0.25), (0.5, 0.2)];
                let back = [(0.64, 0.25), (0.75, 0.42), (0.75, 0.8)];
                line(self, arch.iter().chain(&back).map(|(u, v)| at(*u, *v)).collect());
            }
            Symbol::YarnOver => line(self, round(0.28).collect()),
            Symbol::Bobble => {
                self.shapes.push(Shape::Polygon { points: round(0.3).collect(), colour: ink });
            }
            Symbol::Together { stitches, lean, purl } => {
                line(self, vec![at(side(lean, 0.22), 0.8), at(side(lean, 0.78), 0.2)]);
                if stitches > 2 {
                    line(self, vec![at(side(lean, 0.22), 0.5), at(side(lean, 0.5), 0.5)]);
                }
                if purl {
                    let u = side(lean, 0.72);
                    line(self, vec![at(u - 0.12, 0.78), at(u + 0.12, 0.78)]);
                }
            }
            Symbol::Centred => {
                line(self, vec![at(0.2, 0.8), at(0.5, 0.2), at(0.8, 0.8)]);
                line(self, vec![at(0.5, 0.2), at(0.5, 0.8)]);
            }
            Symbol::Made(lean) => {
                line(self, vec![at(side(lean, 0.4), 0.8), at(side(lean, 0.4), 0.2)]);
                line(self, vec![at(side(lean, 0.4), 0.55), at(side(lean, 0.75), 0.2)]);
            }
            Symbol::Cable(cable) => self.cable(cable, [x, y], columns, ground),
        }
    }

    /// The stitches behind cross first, those in front over them.
    fn cable(&mut self, cable: Cable, corner: [f64; 2], columns: usize, ground: Colour) {
        let ink = against(ground);
        let thick = (self.high / 13.0).max(1.0);
        let (front, behind) = (f64::from(cable.front), f64::from(cable.behind));
        let all = columns as f64;
        let at = |u: f64, v: f64| {
            let u = if cable.lean == Lean::Right { u } else { all - u };
            [corner[0] + 0.5 + u * self.wide, corner[1] + 0.5 + v * self.high]
        };
        // Leaning to the right: those in front go from the left below to the right above.
        let (low, high) = (0.94, 0.06);
        let strand = |from: f64, to: f64, width: f64| {
            let gap = 0.12;
            [
                at(from + gap, low),
                at(to + gap, high),
                at(to + width - gap, high),
                at(from + width - gap, low),
            ]
        };
        let back = strand(front, 0.0, behind);
        let over = strand(0.0, behind, front);
        let ground = if cable.purl { PALE } else { ground };
        let mut shapes = Vec::new();
        for (corners, colour) in [(back, LINE), (over, ground)] {
            if corners == over || cable.purl {
                let points = corners.to_vec();
                shapes.push(Shape::Polygon { points, colour });
            }
            for pair in [[0, 1], [3, 2]] {
                let points = pair.map(|n| corners[n]).to_vec();
                shapes.push(Shape::Line { points, thick, colour: ink });
            }
        }
        self.shapes.append(&mut shapes);
    }
}

/// Ink on light grounds, white on dark ones.
fn against(ground: Colour) -> Colour {
    let [red, green, blue] = ground.linear();
    let light = 0.2126 * red + 0.7152 * green + 0.0722 * blue;
    if light > 0.18 { INK } else { PAPER }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::textile::paper::{paint, svg};

    fn shown(rows: &[&[Symbol]]) -> Sheet {
        let rows = rows.iter().map(|row| row.to_vec()).collect();
        chart(&Chart::new(rows, None).unwrap(), "test", 0.75, None)
    }

    #[test]
    fn rows_on_the_face_are_numbered_at_the_right() {
        let sheet = shown(&[&[Symbol::Knit; 4], &[Symbol::Purl; 4]]);
        let numbers: Vec<(String, f64, f64)> = sheet
            .shapes
            .iter()
            .filter_map(|shape| match shape {
                Shape::Digits { middle, text, .. } => Some((text.clone(), middle[0], middle[1])),
                _ => None,
            })
            .collect();
        let [one, two, first, .., fourth] = &numbers[..6] else { panic!() };
        assert!(one.1 > two.1 && one.2 > two.2, "row 1 at the right below row 2 at the left");
        assert_eq!((&*first.0, &*fourth.0), ("1", "4"));
        assert!(first.1 > fourth.1, "stitches count from the right");
    }

    #[test]
    fn every_symbol_leaves_its_mark_and_is_explained() {
        let cable = Symbol::Cable(Cable { front: 2, behind: 1, lean: Lean::Left, purl: true });
        let mut all: Vec<Symbol> = Symbol::words().filter_map(Symbol::named).collect();
        all.extend([cable; 3]);
        let sheet = shown(&[&all]);
        let explained = |word: &str| {
            sheet
                .shapes
                .iter()
                .any(|shape| matches!(shape, Shape::Digits { text, .. } if text.starts_with(word)))
        };
        for symbol in &all {
            assert!(explained(&symbol.word().replace('_', " ")), "{symbol:?}");
            let blank = shown(&[&[Symbol::Knit; 3]]);
            let one = shown(&[&vec![*symbol; 3][..]]);
            let marks = |sheet: &Sheet| {
                let picture = paint(sheet);
                let inside = picture.enumerate_pixels().filter(|(_, y, _)| *y < 38);
                inside.filter(|(.., pixel)| pixel.0[0] < 150).count()
            };
            let drawn = marks(&one) > marks(&blank);
            assert_eq!(drawn, !matches!(symbol, Symbol::Knit | Symbol::NoStitch), "{symbol:?}");
        }
        let text = svg(&sheet);
        assert!(!text.contains("NaN") && !text.contains("inf"));
        let glyphs = sheet.shapes.iter().filter_map(|shape| match shape {
            Shape::Digits { text, .. } => Some(text.clone()),
            _ => None,
        });
        for sign in glyphs.flat_map(|text| text.chars().collect::<Vec<_>>()) {
            assert!(digit::glyph(sign).is_some(), "`{sign}`");
        }
    }
}
