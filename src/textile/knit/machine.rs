//! From a chart to a program of a knitting machine with two beds.
//!
//! The panel is knitted from right to left and back, each column of the chart on a needle of its
//! own number. Knitted loops are made on the front bed and purled ones on the back bed; loops
//! change beds, and places for decreases and cables, by transfers between the rows. Each colour
//! has a carrier, which begins and waits at the side where it stopped. The cast-on lays loops on
//! every second needle and on the others on the way back; the bind-off draws each loop through its
//! neighbour.

use super::Stitch;
use super::chart::{Chart, Placed};
use super::symbol::{Cable, Lean, Symbol};
use crate::textile::Colour;
use crate::textile::knitout::{Carrier, Direction, Line, Making, Needle, Operation, Program, Yarn};
use std::collections::BTreeSet;
use thiserror::Error;

/// Needles by which beds are racked against each other at most; machines with a racking of two
/// inches at a middling gauge reach it.
const FARTHEST: usize = 8;
/// Carriers that machines have.
const CARRIERS: usize = 16;
/// Carriers that a program speaks of at least, as small machines have them.
const USUAL: usize = 6;

/// Why a chart cannot be knitted so.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum MachineError {
    /// A row works other stitches than the row below leaves.
    #[error("row {row} works {uses} stitches, the row below leaves {left}")]
    Unbalanced {
        /// Number of the row, from 1.
        row: usize,
        /// Stitches that it works.
        uses: usize,
        /// Stitches that the row below leaves.
        left: usize,
    },
    /// A symbol that is not made by one row of a machine.
    #[error("row {row} has a {}, which a machine does not make in one row", Symbol::meaning(*.symbol))]
    Symbol {
        /// Number of the row, from 1.
        row: usize,
        /// The symbol.
        symbol: Symbol,
    },
    /// A loop that would have to go too far.
    #[error("row {row} moves a loop over {needles} needles, machines reach {FARTHEST}")]
    TooFar {
        /// Number of the row, from 1.
        row: usize,
        /// How far.
        needles: usize,
    },
    /// More colours than carriers.
    #[error("the chart has {0} colours, machines have {CARRIERS} carriers")]
    Colours(usize),
    /// A row that leaves nothing, or a first row that works nothing.
    #[error("row {0} has no stitches on the needles")]
    Bare(usize),
}

/// The program of a panel, knitted once from the first row of the chart to the last, in the
/// `yarn`'s colour where the chart says none. `name` is written above it.
///
/// # Errors
/// Any [`MachineError`].
pub fn panel(chart: &Chart, name: &str, yarn: Option<Colour>) -> Result<Program, MachineError> {
    let palette = chart.palette();
    if palette.len() > CARRIERS {
        return Err(MachineError::Colours(palette.len()));
    }
    if let Some(found) = chart.imbalances().first() {
        let (row, uses, left) = (found.row, found.uses, found.left);
        return Err(MachineError::Unbalanced { row, uses, left });
    }
    let cast_on = chart.uses(0);
    let bare = (0..chart.height()).find(|&row| chart.leaves(row) == 0);
    if let Some(row) = bare.or((cast_on == 0).then_some(0)) {
        return Err(MachineError::Bare(row + 1));
    }
    let mut knitter = Knitter {
        lines: Vec::new(),
        loops: Vec::new(),
        sides: vec![None; palette.len()],
        racking: 0,
    };
    knitter.header(name, &palette, yarn);
    let first = chart.worked_colours(0).first().and_then(|it| carrier(&palette, *it)).unwrap_or(0);
    knitter.cast_on(cast_on, first);
    for row in 0..chart.height() {
        knitter.row(chart, row, &palette)?;
    }
    knitter.bind_off();
    let carriers = (1..=palette.len().max(USUAL)).map(|number| number.to_string()).collect();
    Ok(Program { version: 2, carriers, lines: knitter.lines })
}

fn carrier(palette: &[Option<Colour>], colour: Option<Colour>) -> Option<Carrier> {
    palette.iter().position(|known| *known == colour).and_then(|at| Carrier::try_from(at).ok())
}

struct Knitter {
    lines: Vec<Line>,
    /// The needles that hold loops, from the left.
    loops: Vec<Needle>,
    /// The side on which each carrier waits; none before it is called in.
    sides: Vec<Option<Direction>>,
    racking: i32,
}

impl Knitter {
    fn does(&mut self, operation: Operation) {
        self.lines.push(Line::of(operation));
    }

    fn says(&mut self, text: String) {
        self.lines.push(Line::comment(text));
    }

    fn header(&mut self, name: &str, palette: &[Option<Colour>], yarn: Option<Colour>) {
        let carriers: Vec<String> =
            (1..=palette.len().max(USUAL)).map(|number| number.to_string()).collect();
        self.lines.push(Line::header("Carriers", carriers.join(" ")));
        for (number, colour) in palette.iter().enumerate() {
            if let Some(Colour([red, green, blue, _])) = colour.or(yarn) {
                let value = format!("#{red:02x}{green:02x}{blue:02x}");
                self.lines.push(Line::header(&format!("Yarn-{}", number + 1), value));
            }
        }
        // A name may hold line ends; a comment may not.
        let name: String = name.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
        self.says(format!(" {name}"));
    }

    fn make(&mut self, making: Making, direction: Direction, needle: Needle, with: Carrier) {
        self.does(Operation::Make { making, direction, needle, carriers: vec![with] });
    }

    /// Calls a carrier in if it is not; gives the way it goes next.
    fn way(&mut self, with: Carrier) -> (Direction, bool) {
        let slot = &mut self.sides[usize::from(with)];
        match slot {
            Some(side) => (opposite(*side), false),
            None => {
                *slot = Some(Direction::Right);
                self.does(Operation::Yarn(Yarn::Inhook, vec![with]));
                (Direction::Left, true)
            }
        }
    }

    fn cast_on(&mut self, stitches: usize, with: Carrier) {
        self.says(" cast on".to_owned());
        self.way(with);
        let last = stitches as i32;
        let every = |start: i32| (1..=last).rev().skip(start as usize).step_by(2);
        for number in every(0) {
            self.make(Making::Tuck, Direction::Left, Needle::front(number), with);
        }
        let mut rest: Vec<i32> = every(1).collect();
        rest.reverse();
        for number in rest {
            self.make(Making::Tuck, Direction::Right, Needle::front(number), with);
        }
        self.does(Operation::Yarn(Yarn::Releasehook, vec![with]));
        self.loops = (1..=last).map(Needle::front).collect();
    }

    fn row(
        &mut self,
        chart: &Chart,
        row: usize,
        palette: &[Option<Colour>],
    ) -> Result<(), MachineError> {
        let number = row + 1;
        self.says(format!(" row {number}"));
        let placed = chart.placed(row);
        if let Some((symbol, ..)) = placed.iter().find(|(it, ..)| *it == Symbol::Bobble) {
            return Err(MachineError::Symbol { row: number, symbol: *symbol });
        }
        self.arrange(&placed, number)?;
        let colours = chart.worked_colours(row);
        for colour in colours {
            let Some(with) = carrier(palette, colour) else { continue };
            let (direction, new) = self.way(with);
            let mut made: Vec<(Making, Needle)> = Vec::new();
            for (symbol, column, width) in &placed {
                if chart.colour(*column, row) != colour {
                    continue;
                }
                let making = match symbol {
                    Symbol::Slip | Symbol::NoStitch => continue,
                    Symbol::Tuck | Symbol::YarnOver | Symbol::Made(_) => Making::Tuck,
                    _ => Making::Knit,
                };
                made.extend((0..*width).map(|at| (making, target(*symbol, *column, at))));
            }
            if direction == Direction::Left {
                made.reverse();
            }
            for (making, needle) in made {
                self.make(making, direction, needle, with);
            }
            self.sides[usize::from(with)] = Some(direction);
            if new {
                self.does(Operation::Yarn(Yarn::Releasehook, vec![with]));
            }
        }
        let left = placed.iter().filter(|(symbol, ..)| symbol.leaves() > 0);
        self.loops = left
            .flat_map(|&(symbol, column, width)| (0..width).map(move |at| (symbol, column, at)))
            .map(|(symbol, column, at)| target(symbol, column, at))
            .collect();
        Ok(())
    }

    /// Brings the loops of the row below to the needles on which this row works them.
    fn arrange(&mut self, placed: &[Placed], row: usize) -> Result<(), MachineError> {
        // Where each loop goes, from the left, and whether it must come in front of others.
        let mut goes: Vec<(Needle, Needle, bool)> = Vec::new();
        let mut held = self.loops.iter().copied();
        for &(symbol, column, width) in placed {
            if let Symbol::Cable(cable) = symbol {
                for at in 0..width {
                    let Some(from) = held.next() else { continue };
                    let (to, front) = crossed(cable, at);
                    goes.push((from, target(symbol, column, to), front));
                }
                continue;
            }
            let used = symbol.uses();
            for n in 0..used {
                let Some(from) = held.next() else { continue };
                // Which loop arrives first lies in front of the others, and says the lean.
                let front = match symbol {
                    Symbol::Together { lean: Lean::Right, .. } => n + 1 < used,
                    Symbol::Together { lean: Lean::Left, .. } => n > 0,
                    Symbol::Centred => n == 1,
                    _ => false,
                };
                goes.push((from, target(symbol, column, 0), front));
            }
        }
        let farthest = goes.iter().map(|(from, to, _)| from.number.abs_diff(to.number)).max();
        if let Some(needles) = farthest.map(|far| far as usize).filter(|far| *far > FARTHEST) {
            return Err(MachineError::TooFar { row, needles });
        }
        let moving = |(from, to, _): &&(Needle, Needle, bool)| from.number != to.number;
        let arrivals: BTreeSet<i32> = goes.iter().filter(moving).map(|it| it.1.number).collect();
        // What moves waits on the back bed; what it will meet, on the front bed.
        for (from, ..) in goes.iter().filter(moving) {
            if from.bed.is_front() {
                self.transfer(*from, Needle::back(from.number), 0);
            }
        }
        let mut on_front: BTreeSet<i32> = BTreeSet::new();
        for (from, to, _) in goes.iter().filter(|it| !moving(it)) {
            let front = from.bed.is_front() || arrivals.contains(&to.number);
            if front && !from.bed.is_front() {
                self.transfer(*from, Needle::front(from.number), 0);
            }
            if front {
                on_front.insert(to.number);
            }
        }
        for in_front in [true, false] {
            let mut far: Vec<i32> = goes
                .iter()
                .filter(|(from, to, front)| from.number != to.number && *front == in_front)
                .map(|(from, to, _)| to.number - from.number)
                .collect();
            far.sort_unstable();
            far.dedup();
            for racking in far {
                for (from, to, front) in &goes {
                    if to.number - from.number == racking && *front == in_front && racking != 0 {
                        let needle = Needle::front(to.number);
                        self.transfer(Needle::back(from.number), needle, racking);
                        on_front.insert(to.number);
                    }
                }
            }
        }
        // Each to the bed on which it is worked.
        let mut done: BTreeSet<i32> = BTreeSet::new();
        for (_, to, _) in &goes {
            if !done.insert(to.number) {
                continue;
            }
            let here = on_front.contains(&to.number);
            if here != to.bed.is_front() {
                let from = if here { Needle::front(to.number) } else { Needle::back(to.number) };
                self.transfer(from, *to, 0);
            }
        }
        self.rack(0);
        Ok(())
    }

    fn transfer(&mut self, from: Needle, to: Needle, racking: i32) {
        self.rack(racking);
        self.does(Operation::Xfer(from, to));
    }

    fn rack(&mut self, racking: i32) {
        if self.racking != racking {
            self.racking = racking;
            self.does(Operation::Rack(f64::from(racking)));
        }
    }

    /// Draws each loop through its neighbour, with the carrier that knitted last.
    fn bind_off(&mut self) {
        self.says(" bind off".to_owned());
        let last = self.lines.iter().rev().find_map(|line| match &line.content {
            crate::textile::knitout::Content::Operation(Operation::Make {
                direction,
                carriers,
                ..
            }) => Some((*direction, carriers.first().copied().unwrap_or(0))),
            _ => None,
        });
        let Some((side, with)) = last else { return };
        for carrier in 0..self.sides.len() {
            let other = carrier as Carrier;
            if other != with && self.sides[carrier].is_some() {
                self.does(Operation::Yarn(Yarn::Outhook, vec![other]));
            }
        }
        for needle in std::mem::take(&mut self.loops) {
            if !needle.bed.is_front() {
                self.transfer(needle, Needle::front(needle.number), 0);
            }
            self.loops.push(Needle::front(needle.number));
        }
        let direction = opposite(side);
        let mut needles = self.loops.clone();
        if direction == Direction::Left {
            needles.reverse();
        }
        for pair in 0..needles.len() {
            let needle = needles[pair];
            self.make(Making::Knit, direction, needle, with);
            if let Some(next) = needles.get(pair + 1) {
                // Over columns without stitches it goes by steps.
                let mut from = needle;
                while from != *next {
                    let far = (next.number - from.number).clamp(-1, 1);
                    let back = Needle::back(from.number);
                    self.transfer(from, back, 0);
                    from = Needle::front(from.number + far);
                    self.transfer(back, from, far);
                }
                self.rack(0);
            }
        }
        if let Some(end) = needles.last() {
            // A few loops more keep the end from running until it is drawn through by hand.
            self.make(Making::Knit, side, *end, with);
            self.make(Making::Knit, direction, *end, with);
            self.does(Operation::Yarn(Yarn::Outhook, vec![with]));
            self.does(Operation::Drop(*end));
        }
    }
}

fn opposite(direction: Direction) -> Direction {
    match direction {
        Direction::Left => Direction::Right,
        Direction::Right => Direction::Left,
    }
}

/// The needle on which a column of a symbol is worked.
fn target(symbol: Symbol, column: usize, at: usize) -> Needle {
    let number = (column + at + 1) as i32;
    match symbol.stitch(at) {
        Stitch::Face => Needle::front(number),
        Stitch::Back => Needle::back(number),
    }
}

/// The column of a cable to which its `at`th stitch from the left goes, and whether in front.
fn crossed(cable: Cable, at: usize) -> (usize, bool) {
    let (front, behind) = (usize::from(cable.front), usize::from(cable.behind));
    match cable.lean {
        // Those in front stand at the right and go to the left.
        Lean::Left if at >= behind => (at - behind, true),
        Lean::Left => (at + front, false),
        Lean::Right if at < front => (at + behind, true),
        Lean::Right => (at - front, false),
    }
}

#[cfg(test)]
mod tests;
