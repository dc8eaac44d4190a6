//! The layout of a draft: threading above, tie-up in the corner, treadling beside, drawdown; the
//! cloth to the right of all. End 1 is at the left, pick 1 at the bottom: the cloth grows upwards
//! as a chart of the language does. Shaft 1 is next to the cloth, treadle 1 at the left.

use super::cloth::{self, Lengths, NATURAL};
use super::{Area, Shape, Sheet, digit};
use crate::textile::Colour;
use crate::textile::draft::{Draft, Shedding};
use crate::textile::drawdown::Cloth;

/// A draft on paper.
#[derive(Clone, Debug)]
pub struct Drawing {
    /// The sheet.
    pub sheet: Sheet,
    /// Ends and picks that are drawn; the first ones where there are more.
    pub shown: (usize, usize),
}

/// Ends or picks that are drawn at most.
const MOST: usize = 3000;
/// Pixels that the longer side of a drawdown takes at most, as far as its cells have any.
const LONGEST: usize = 3000;
/// Side of a cell, pixels.
const CELL: usize = 14;
/// Cells from here on have lines between them.
const LINED: f64 = 5.0;

const INK: Colour = Colour([34, 34, 40, 255]);
const LINE: Colour = Colour([205, 208, 214, 255]);
const STRONG: Colour = Colour([130, 136, 148, 255]);
const TIE: Colour = Colour([150, 40, 40, 255]);

/// A grid on the sheet.
#[derive(Clone, Copy)]
struct Grid {
    x: f64,
    y: f64,
    columns: usize,
    rows: usize,
    cell: f64,
}

impl Grid {
    fn right(&self) -> f64 {
        self.x + self.columns as f64 * self.cell
    }

    fn bottom(&self) -> f64 {
        self.y + self.rows as f64 * self.cell
    }
}

/// Draws a draft. `cloth` is what [works](Draft::worked) of it.
pub fn drawing(draft: &Draft, cloth: &Cloth) -> Drawing {
    let ends = cloth.picks.ends().min(MOST);
    let picks = cloth.picks.picks().min(MOST);
    let shafts = (highest(draft.threading.iter().take(ends)) as usize).max(1);
    let plan = Plan::of(draft, picks, shafts);
    let longest = (ends + plan.columns).max(picks + shafts).max(1);
    let cell = (LONGEST / longest).clamp(1, CELL) as f64;

    let digits = (cell * 0.6).clamp(7.0, 9.0);
    let margin = 16.0;
    let gap = (cell * 0.8).max(6.0);
    let strip = cell.max(6.0);
    let numbers = |most: usize| digit::width(&most.to_string(), digits) + 6.0;
    let left = margin + numbers(picks.max(shafts));
    let above = margin + digits + 4.0;

    let threading =
        Grid { x: left, y: above + strip + gap / 2.0, columns: ends, rows: shafts, cell };
    let drawdown = Grid { y: threading.bottom() + gap, rows: picks, ..threading };
    let tieup = Grid { x: threading.right() + gap, columns: plan.columns, ..threading };
    let treadling = Grid { y: drawdown.y, rows: picks, ..tieup };
    let weft = treadling.right() + gap / 2.0;

    let mut page = Page::default();
    page.grid(&threading);
    page.grid(&drawdown);
    page.grid(&tieup);
    page.grid(&treadling);

    // Warp and weft colours.
    let colour = |list: &Option<Vec<Colour>>, number: usize, usual: Colour| {
        list.as_ref().and_then(|list| list.get(number).copied()).unwrap_or(usual)
    };
    for end in 0..ends {
        let area =
            Area { x: threading.x + end as f64 * cell, y: above, width: cell, height: strip };
        page.strip(area, colour(&draft.warp.colours, end, NATURAL[0]));
    }
    for pick in 0..picks {
        let area = Area {
            x: weft,
            y: drawdown.bottom() - (pick + 1) as f64 * cell,
            width: strip,
            height: cell,
        };
        page.strip(area, colour(&draft.weft.colours, pick, NATURAL[1]));
    }

    // Marks.
    let cells = draft.threading.iter().take(ends).enumerate().flat_map(|(end, list)| {
        list.iter().map(move |&shaft| [end as u32, (shafts - shaft as usize) as u32, 1])
    });
    page.marks(&threading, cells.collect());
    let pressed = plan.pressed.iter().enumerate().flat_map(|(pick, list)| {
        list.iter().map(move |&column| [column - 1, (picks - 1 - pick) as u32, 1])
    });
    page.marks(&treadling, pressed.collect());
    page.marks(&drawdown, floats(cloth, ends, picks, cell < LINED));
    let ties = plan.ties.iter().enumerate().flat_map(|(column, list)| {
        list.iter()
            .filter(|&&shaft| shaft as usize <= shafts)
            .map(move |&shaft| [column as u32, (shafts - shaft as usize) as u32])
    });
    page.shapes.push(Shape::Ties {
        corner: [tieup.x, tieup.y],
        cell,
        cells: ties.collect(),
        crosses: !draft.rising,
        colour: TIE,
    });

    // Numbers.
    let step = |room: f64| [1, 5, 10, 50, 100, 500].into_iter().find(|&n| n as f64 * cell >= room);
    let wide = step(numbers(ends.max(plan.columns)) + 2.0).unwrap_or(1000).max(5);
    let high = step(digits + 3.0).unwrap_or(1000);
    let mut write = |x: f64, y: f64, number: usize| {
        page.shapes.push(Shape::Digits {
            middle: [x, y],
            height: digits,
            text: number.to_string(),
            colour: INK,
        });
    };
    let counted = |most: usize, step: usize| {
        (1..=most).filter(move |number| *number == 1 || number.is_multiple_of(step))
    };
    for end in counted(ends, wide) {
        write(threading.x + (end as f64 - 0.5) * cell, margin + digits / 2.0, end);
    }
    let few = if numbers(plan.columns) <= cell { 1 } else { wide };
    for column in counted(plan.columns, few) {
        write(tieup.x + (column as f64 - 0.5) * cell, above + strip - digits / 2.0, column);
    }
    let beside = |number: usize| left - 4.0 - digit::width(&number.to_string(), digits) / 2.0;
    for shaft in counted(shafts, high) {
        let y = threading.bottom() - (shaft as f64 - 0.5) * cell;
        write(beside(shaft), y, shaft);
    }
    for pick in counted(picks, high.max(5)) {
        write(beside(pick), drawdown.bottom() - (pick as f64 - 0.5) * cell, pick);
    }

    // The cloth.
    let height = (drawdown.bottom() - above).clamp(360.0, 1600.0);
    let panel = Area { x: weft + strip + 2.0 * gap + 8.0, y: above, width: height, height };
    let lengths = [
        Lengths::of(&draft.warp, cloth.picks.ends()),
        Lengths::of(&draft.weft, cloth.picks.picks()),
    ];
    let bar = cloth::threads(draft, cloth, &lengths, panel, &mut page.shapes);
    let mut bottom = panel.y + panel.height;
    if let Some(centimetre) = bar {
        let y = bottom + 6.0;
        let area = Area { x: panel.x, y, width: centimetre, height: 3.0 };
        page.shapes.push(Shape::Fill { area, colour: INK });
        page.shapes.push(Shape::Digits {
            middle: [panel.x + centimetre + 20.0, y + 2.0],
            height: 9.0,
            text: "1 cm".to_owned(),
            colour: INK,
        });
        bottom += 16.0;
    }
    let size = |pixels: f64| (pixels + margin).ceil() as u32;
    Drawing {
        sheet: Sheet {
            title: draft.title.clone(),
            width: size(panel.x + panel.width),
            height: size(bottom.max(drawdown.bottom())),
            shapes: page.shapes,
        },
        shown: (ends, picks),
    }
}

/// The highest number of lists that rise.
fn highest<'a>(lists: impl Iterator<Item = &'a Vec<u32>>) -> u32 {
    lists.filter_map(|list| list.last().copied()).max().unwrap_or(0)
}

/// Columns beside the cloth: treadles, or the shafts of a lift plan, each tied to itself.
struct Plan {
    columns: usize,
    ties: Vec<Vec<u32>>,
    pressed: Vec<Vec<u32>>,
}

impl Plan {
    fn of(draft: &Draft, picks: usize, shafts: usize) -> Plan {
        match &draft.shedding {
            Shedding::Treadled { tieup, treadling } => {
                let pressed: Vec<Vec<u32>> = treadling.iter().take(picks).cloned().collect();
                let columns = (highest(pressed.iter()) as usize).max(1);
                Plan { columns, ties: tieup.iter().take(columns).cloned().collect(), pressed }
            }
            Shedding::Lifted { plan } => {
                let within = |list: &Vec<u32>| {
                    list.iter().copied().filter(|&shaft| shaft as usize <= shafts).collect()
                };
                Plan {
                    columns: shafts,
                    ties: (1..=shafts as u32).map(|shaft| vec![shaft]).collect(),
                    pressed: plan.iter().take(picks).map(within).collect(),
                }
            }
        }
    }
}

/// The crossings with the warp up, rows from the top; a run of several as one where `joined`.
fn floats(cloth: &Cloth, ends: usize, picks: usize, joined: bool) -> Vec<[u32; 3]> {
    let mut runs: Vec<[u32; 3]> = Vec::new();
    for pick in 0..picks {
        let row = (picks - 1 - pick) as u32;
        for end in (0..ends).filter(|&end| cloth.picks.up(end, pick)) {
            match runs.last_mut() {
                Some([from, last, length])
                    if joined && *last == row && *from + *length == end as u32 =>
                {
                    *length += 1;
                }
                _ => runs.push([end as u32, row, 1]),
            }
        }
    }
    runs
}

/// Shapes in the making.
#[derive(Default)]
struct Page {
    shapes: Vec<Shape>,
}

impl Page {
    fn fill(&mut self, x: f64, y: f64, width: f64, height: f64, colour: Colour) {
        self.shapes.push(Shape::Fill { area: Area { x, y, width, height }, colour });
    }

    /// The lines of a grid, the fifth ones stronger, counted from the left and from the bottom.
    fn grid(&mut self, grid: &Grid) {
        let Grid { x, y, columns, rows, cell } = *grid;
        let (right, bottom) = (grid.right(), grid.bottom());
        let strong = |number: usize, last: usize| {
            number == 0 || number == last || (cell > 2.0 && number.is_multiple_of(5))
        };
        for pass in [LINE, STRONG] {
            for column in 0..=columns {
                if strong(column, columns) == (pass == STRONG) && (cell >= LINED || pass == STRONG)
                {
                    self.fill(x + column as f64 * cell, y, 1.0, bottom - y + 1.0, pass);
                }
            }
            for row in 0..=rows {
                if strong(row, rows) == (pass == STRONG) && (cell >= LINED || pass == STRONG) {
                    self.fill(x, bottom - row as f64 * cell, right - x + 1.0, 1.0, pass);
                }
            }
        }
    }

    fn marks(&mut self, grid: &Grid, runs: Vec<[u32; 3]>) {
        let lined = grid.cell >= LINED;
        self.shapes.push(Shape::Marks {
            corner: if lined { [grid.x + 0.5, grid.y + 0.5] } else { [grid.x, grid.y] },
            cell: grid.cell,
            inset: if lined { 0.5 } else { 0.0 },
            runs,
            colour: INK,
        });
    }

    /// One colour of a strip.
    fn strip(&mut self, area: Area, colour: Colour) {
        if area.width.min(area.height) < LINED {
            self.shapes.push(Shape::Fill { area, colour });
            return;
        }
        self.fill(area.x, area.y, area.width + 1.0, area.height + 1.0, STRONG);
        let Area { x, y, width, height } = area;
        self.fill(x + 1.0, y + 1.0, width - 1.0, height - 1.0, colour);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::textile::weave::Weave;
    use crate::textile::yarn::Twist;

    fn drawn(weave: &Weave) -> Drawing {
        let draft = Draft::of_weave(weave);
        let cloth = Cloth::new(draft.drawdown().unwrap());
        drawing(&draft, &cloth)
    }

    #[test]
    fn the_first_end_is_left_and_the_first_pick_below() {
        let drawn = drawn(&Weave::twill(&[1, 3], Twist::Z, 1).unwrap());
        let marks: Vec<&Vec<[u32; 3]>> = drawn
            .sheet
            .shapes
            .iter()
            .filter_map(|shape| match shape {
                Shape::Marks { runs, .. } => Some(runs),
                _ => None,
            })
            .collect();
        let [threading, treadling, drawdown] = marks.as_slice() else { panic!() };
        // Shaft 1 next to the cloth, so a straight draft rises to the right, as the twill does.
        let rising = vec![[0, 3, 1], [1, 2, 1], [2, 1, 1], [3, 0, 1]];
        assert_eq!(**threading, rising);
        assert_eq!(**treadling, rising);
        assert_eq!(**drawdown, rising);
    }

    #[test]
    fn large_drafts_stay_on_their_paper() {
        let rows = (0..2000).map(|p| (0..3500).map(|e| (e * 7 + p * 3) % 11 < 5).collect());
        let drawn = drawn(&Weave::matrix(rows.collect()).unwrap());
        assert_eq!(drawn.shown, (3000, 2000));
        assert!(drawn.sheet.width < 8000 && drawn.sheet.height < 4000);
    }
}
