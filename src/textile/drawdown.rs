//! Which thread lies on top at every crossing of a cloth, a bit a crossing, and what can be
//! counted there.

use super::weave::Weave;
use std::collections::BTreeSet;

/// The drawdown of a draft. Pick 0 is the first pick, end 0 the first end.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Drawdown {
    ends: usize,
    picks: usize,
    /// Words of 64 ends that a row takes.
    words: usize,
    rows: Vec<u64>,
}

/// Ends or picks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[allow(missing_docs)]
pub enum System {
    Warp,
    Weft,
}

/// The side of the cloth on which a thread lies on top.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[allow(missing_docs)]
pub enum Side {
    Face,
    Back,
}

/// A stretch of threads of the other system that a thread passes on one side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Float {
    /// The thread that floats, counted from 0.
    pub thread: usize,
    /// The first thread of the other system that it passes.
    pub from: usize,
    /// How many it passes.
    pub length: usize,
}

impl Drawdown {
    /// A drawdown with all ends down.
    pub fn new(ends: usize, picks: usize) -> Drawdown {
        let words = ends.div_ceil(64);
        Drawdown { ends, picks, words, rows: vec![0; words * picks] }
    }

    /// One repeat of a weave.
    pub fn of_weave(weave: &Weave) -> Drawdown {
        let mut drawn = Drawdown::new(weave.ends(), weave.picks());
        for (pick, row) in weave.rows.iter().enumerate() {
            for (end, _) in row.iter().enumerate().filter(|(_, up)| **up) {
                drawn.raise(end, pick);
            }
        }
        drawn
    }

    /// Ends.
    pub fn ends(&self) -> usize {
        self.ends
    }

    /// Picks.
    pub fn picks(&self) -> usize {
        self.picks
    }

    /// The bits of a pick, end 0 lowest; bits beyond the last end are 0.
    pub fn row(&self, pick: usize) -> &[u64] {
        self.rows.get(pick * self.words..(pick + 1) * self.words).unwrap_or(&[])
    }

    /// Puts an end above a pick.
    pub(super) fn raise(&mut self, end: usize, pick: usize) {
        if end < self.ends && pick < self.picks {
            self.rows[pick * self.words + end / 64] |= 1 << (end % 64);
        }
    }

    /// Whether the warp is on top where they cross.
    pub fn up(&self, end: usize, pick: usize) -> bool {
        self.row(pick).get(end / 64).is_some_and(|word| word >> (end % 64) & 1 == 1)
    }

    /// Turns every crossing over.
    pub(super) fn turn(&mut self) {
        self.rows.iter_mut().for_each(|word| *word = !*word);
        let beyond = self.words * 64 - self.ends;
        if beyond > 0 {
            for last in self.rows.iter_mut().skip(self.words - 1).step_by(self.words) {
                *last &= u64::MAX >> beyond;
            }
        }
    }

    /// The crossings as rows, first pick first.
    pub fn matrix(&self) -> Vec<Vec<bool>> {
        (0..self.picks).map(|pick| (0..self.ends).map(|end| self.up(end, pick)).collect()).collect()
    }

    /// Ends and picks change places; an end that was up is a pick that is up.
    #[must_use]
    pub fn transposed(&self) -> Drawdown {
        let mut turned = Drawdown::new(self.picks, self.ends);
        for pick in 0..self.picks {
            let (at, bit) = (pick / 64, 1 << (pick % 64));
            for (number, &word) in self.row(pick).iter().enumerate() {
                let mut word = word;
                while word != 0 {
                    let end = number * 64 + word.trailing_zeros() as usize;
                    turned.rows[end * turned.words + at] |= bit;
                    word &= word - 1;
                }
            }
        }
        turned
    }

    /// The first ends and picks alone.
    #[must_use]
    pub fn cropped(&self, ends: usize, picks: usize) -> Drawdown {
        let mut part = Drawdown::new(ends.min(self.ends), picks.min(self.picks));
        let beyond = part.words * 64 - part.ends;
        for pick in 0..part.picks {
            let row = part.words * pick..part.words * (pick + 1);
            if let Some(own) = part.rows.get_mut(row) {
                own.copy_from_slice(&self.row(pick)[..part.words]);
                if let (Some(last), 1..) = (own.last_mut(), beyond) {
                    *last &= u64::MAX >> beyond;
                }
            }
        }
        part
    }

    /// Crossings with the warp on top.
    pub fn warp_up(&self) -> u64 {
        self.rows.iter().map(|word| u64::from(word.count_ones())).sum()
    }

    /// Writes the rows as `0` and `1`, first pick first, first end first, a line end between
    /// rows.
    pub fn spell(&self, mut write: impl FnMut(&[u8])) {
        let mut line = Vec::with_capacity(self.ends + 1);
        for pick in 0..self.picks {
            line.clear();
            if pick > 0 {
                line.push(b'\n');
            }
            for (number, &word) in self.row(pick).iter().enumerate() {
                let bits = (self.ends - number * 64).min(64);
                line.extend((0..bits).map(|bit| b'0' + (word >> bit & 1) as u8));
            }
            write(&line);
        }
    }

    /// The stretches of equal crossings along a row: the first end, how many, whether warp up.
    fn stretches(&self, pick: usize) -> impl Iterator<Item = (usize, usize, bool)> {
        let row = self.row(pick);
        let ends = self.ends;
        let mut end = 0;
        std::iter::from_fn(move || {
            if end >= ends {
                return None;
            }
            let from = end;
            let up = row[end / 64] >> (end % 64) & 1 == 1;
            loop {
                let word = row[end / 64] >> (end % 64);
                let room = (64 - end % 64).min(ends - end);
                let same = if up { word.trailing_ones() } else { word.trailing_zeros() };
                let same = (same as usize).min(room);
                end += same;
                if same < room || end >= ends {
                    return Some((from, end - from, up));
                }
            }
        })
    }

    /// The longest stretches along these rows.
    fn longest(&self, rows: impl Iterator<Item = usize>) -> Stretches {
        let mut longest = Stretches::default();
        for pick in rows {
            let mut first = None;
            let mut last = None;
            for (from, length, up) in self.stretches(pick) {
                let float = Float { thread: pick, from, length };
                longest.offer(up, false, float);
                first.get_or_insert((up, float));
                last = Some((up, float));
                longest.offer(up, true, float);
            }
            if let (Some((up, first)), Some((same, last))) = (first, last) {
                if up == same && first.from != last.from {
                    longest.offer(up, true, Float { length: first.length + last.length, ..last });
                }
            }
        }
        longest
    }
}

/// The longest stretches of equal crossings, the first of equally long ones: warp down, warp up;
/// as the rows stand, closed to rings.
#[derive(Clone, Copy, Debug, Default)]
struct Stretches([[Option<Float>; 2]; 2]);

impl Stretches {
    fn offer(&mut self, up: bool, ring: bool, float: Float) {
        let longest = &mut self.0[usize::from(up)][usize::from(ring)];
        if longest.is_none_or(|longest| float.length > longest.length) {
            *longest = Some(float);
        }
    }
}

/// The longest floats of a system of threads, on the face and on the back. None where no thread
/// ever lies there.
#[derive(Clone, Copy, Debug)]
pub struct Longest {
    stretches: Stretches,
    on_top: bool,
}

impl Longest {
    /// On that side; as the cloth stands, or `round` its repeat.
    pub fn on(&self, side: Side, round: bool) -> Option<Float> {
        let up = self.on_top == (side == Side::Face);
        self.stretches.0[usize::from(up)][usize::from(round)]
    }
}

/// A drawdown by rows and by columns.
#[derive(Clone, Debug)]
pub struct Cloth {
    /// A row a pick.
    pub picks: Drawdown,
    /// A row an end.
    pub ends: Drawdown,
}

impl Cloth {
    /// Looks at a drawdown from both directions.
    pub fn new(drawn: Drawdown) -> Cloth {
        Cloth { ends: drawn.transposed(), picks: drawn }
    }

    /// The threads of a system, a row each, and whether a set bit has it on top.
    pub(super) fn threads(&self, system: System) -> (&Drawdown, bool) {
        match system {
            System::Warp => (&self.ends, true),
            System::Weft => (&self.picks, false),
        }
    }

    /// The longest floats of a system.
    pub fn longest(&self, system: System) -> Longest {
        self.longest_bound(system, &BTreeSet::new())
    }

    /// The longest floats among the threads of a system that are bound, which those in `loose`
    /// are not.
    pub fn longest_bound(&self, system: System, loose: &BTreeSet<usize>) -> Longest {
        let (rows, on_top) = self.threads(system);
        let bound = (0..rows.picks()).filter(|thread| !loose.contains(thread));
        Longest { stretches: rows.longest(bound), on_top }
    }

    /// Threads of a system that never change sides, and the side on which they stay.
    pub fn never_bound(&self, system: System) -> Vec<(usize, Side)> {
        let (rows, on_top) = self.threads(system);
        let across = rows.ends();
        (0..rows.picks())
            .filter_map(|thread| {
                let set: usize = rows.row(thread).iter().map(|w| w.count_ones() as usize).sum();
                let up = set == across;
                (across > 0 && (up || set == 0))
                    .then_some((thread, if up == on_top { Side::Face } else { Side::Back }))
            })
            .collect()
    }

    /// How often the threads of a system change sides round the repeat, over all of them.
    pub fn changes(&self, system: System) -> u64 {
        let (rows, _) = self.threads(system);
        let mut changes = 0;
        for thread in 0..rows.picks() {
            let row = rows.row(thread);
            let Some(last) = rows.ends().checked_sub(1) else { continue };
            let mut before = u64::from(rows.up(last, thread));
            for (number, &word) in row.iter().enumerate() {
                let bits = (rows.ends() - number * 64).min(64);
                let turned = word ^ (word << 1 | before);
                let kept = if bits == 64 { turned } else { turned & ((1 << bits) - 1) };
                changes += u64::from(kept.count_ones());
                before = word >> 63;
            }
        }
        changes
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::textile::yarn::Twist;
    use proptest::prelude::*;

    fn of_rows(rows: &[Vec<bool>]) -> Drawdown {
        Drawdown::of_weave(&Weave::matrix(rows.to_vec()).unwrap())
    }

    /// The longest run, counted the slow way.
    fn slow(lines: &[Vec<bool>], side: bool, ring: bool) -> usize {
        let mut longest = 0;
        for line in lines {
            let laps = if ring { 2 } else { 1 };
            let mut run = 0;
            for &cell in line.iter().cycle().take(laps * line.len()) {
                run = if cell == side { run + 1 } else { 0 };
                longest = longest.max(run.min(line.len()));
            }
        }
        longest
    }

    #[test]
    fn a_satin_is_counted() {
        let cloth = Cloth::new(Drawdown::of_weave(&Weave::satin(8, 3).unwrap()));
        let length = |system, side, round| cloth.longest(system).on(side, round).map(|f| f.length);
        assert_eq!(length(System::Warp, Side::Face, true), Some(7));
        assert_eq!(length(System::Weft, Side::Back, true), Some(7));
        assert_eq!(length(System::Weft, Side::Face, false), Some(1));
        assert_eq!(cloth.picks.warp_up(), 56);
        assert_eq!(cloth.changes(System::Warp), 16);
        assert!(cloth.never_bound(System::Warp).is_empty());
        let mut spelt = Vec::new();
        Drawdown::of_weave(&Weave::plain()).spell(|row| spelt.extend_from_slice(row));
        assert_eq!(spelt, b"10\n01");
    }

    #[test]
    fn threads_that_are_never_bound_are_found() {
        let cloth = Cloth::new(of_rows(&[vec![true, true, false], vec![true, false, false]]));
        assert_eq!(cloth.never_bound(System::Warp), [(0, Side::Face), (2, Side::Back)]);
        assert!(cloth.never_bound(System::Weft).is_empty());
        let twill = Cloth::new(Drawdown::of_weave(&Weave::twill(&[2, 2], Twist::S, 1).unwrap()));
        assert!(twill.never_bound(System::Weft).is_empty());
    }

    proptest! {
        #[test]
        fn words_count_as_cells_do(
            rows in (1_usize..150, 1_usize..9).prop_flat_map(|(ends, picks)| {
                let cell = prop_oneof![4 => Just(true), 1 => Just(false)];
                prop::collection::vec(prop::collection::vec(cell, ends), picks)
            }),
        ) {
            let drawn = of_rows(&rows);
            prop_assert_eq!(&drawn.matrix(), &rows);
            let cloth = Cloth::new(drawn);
            let columns = cloth.ends.matrix();
            for ring in [false, true] {
                let length = |system, side| {
                    let rows = match system { System::Warp => &columns, System::Weft => &rows };
                    let float = cloth.longest(system).on(side, ring);
                    if let Some(float) = float {
                        let row = &rows[float.thread];
                        let side = row[float.from];
                        for n in 0..float.length {
                            assert_eq!(row[(float.from + n) % row.len()], side);
                        }
                    }
                    float.map_or(0, |float| float.length)
                };
                prop_assert_eq!(length(System::Warp, Side::Face), slow(&columns, true, ring));
                prop_assert_eq!(length(System::Warp, Side::Back), slow(&columns, false, ring));
                prop_assert_eq!(length(System::Weft, Side::Face), slow(&rows, false, ring));
                prop_assert_eq!(length(System::Weft, Side::Back), slow(&rows, true, ring));
            }
            let weave = Weave::matrix(rows.clone()).unwrap();
            let cells = (weave.ends() * weave.picks()) as f64;
            let [warp, weft] = weave.interlacing();
            prop_assert!((warp * cells - cloth.changes(System::Warp) as f64).abs() < 1e-6);
            prop_assert!((weft * cells - cloth.changes(System::Weft) as f64).abs() < 1e-6);
            let mut turned = cloth.picks.clone();
            turned.turn();
            prop_assert_eq!(turned.warp_up() + cloth.picks.warp_up(), cells as u64);
        }
    }
}
