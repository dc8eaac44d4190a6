//! Weaves as matrices of warp-up and weft-up, and the notations that make them.
//!
//! Row 0 is the first pick and the bottom of the face, column 0 the left end. A twill whose lines
//! rise to the right is called Z after the middle stroke of the letter, one that rises to the
//! left S.

use super::yarn::Twist;
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// One repeat of a weave.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Weave {
    /// Its name in the text.
    pub name: String,
    /// `rows[pick][end]`: true where the warp end lies on the weft pick. Every row is equally
    /// long and there is at least one row and one column.
    pub rows: Vec<Vec<bool>>,
}

/// Why a notation gives no weave.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum WeaveError {
    /// No rows, or rows without cells.
    #[error("a weave needs at least one pick and one end")]
    Empty,
    /// Rows of different lengths.
    #[error("pick {row} has {found} cells, the first has {expected}")]
    Ragged {
        /// Number of the row, from 1.
        row: usize,
        /// Its cells.
        found: usize,
        /// Cells of the first row.
        expected: usize,
    },
    /// A repeat beyond [`Weave::LARGEST_REPEAT`].
    #[error("the repeat is larger than {} threads", Weave::LARGEST_REPEAT)]
    TooLarge,
    /// Runs of a twill that do not alternate up and down.
    #[error("a twill is written in pairs of warp up and warp down, such as 2/1 or 3/1/1/1")]
    Runs,
    /// A move of a twill that is a whole repeat, so that every pick would be the same.
    #[error("a move of {step} in a repeat of {repeat} makes every pick the same")]
    Standstill {
        /// The move.
        step: u32,
        /// The repeat.
        repeat: u32,
    },
    /// A honeycomb of few threads or an odd number of them.
    #[error("a honeycomb has an even number of threads, 6 or more")]
    Honeycomb,
    /// A satin that does not exist.
    #[error("there is no satin of {repeat} with move {step}")]
    NoSatin {
        /// The repeat.
        repeat: u32,
        /// The move.
        step: u32,
        /// Moves that do make a satin of this repeat; empty for 6 and below 5.
        moves: Vec<u32>,
    },
}

/// Longest floats round the repeat, in threads crossed. `None`: a thread is never bound.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Floats {
    /// Warp floats on the face: picks in a row that an end lies on.
    pub warp_on_face: Option<usize>,
    /// Warp floats on the back.
    pub warp_on_back: Option<usize>,
    /// Weft floats on the face: ends in a row that a pick lies on.
    pub weft_on_face: Option<usize>,
    /// Weft floats on the back.
    pub weft_on_back: Option<usize>,
}

impl Floats {
    /// The longest of the four; `None` where some thread is never bound.
    pub fn longest(self) -> Option<usize> {
        let pairs = [self.warp_on_face, self.warp_on_back, self.weft_on_face, self.weft_on_back];
        pairs.into_iter().try_fold(0, |longest, float| float.map(|f| longest.max(f)))
    }
}

impl Weave {
    /// Threads a repeat may have in one direction.
    pub const LARGEST_REPEAT: usize = 4096;

    /// Plain weave, 1/1.
    pub fn plain() -> Weave {
        Weave { name: "plain".into(), rows: vec![vec![true, false], vec![false, true]] }
    }

    /// A weave from its point paper, bottom row first.
    ///
    /// # Errors
    /// [`WeaveError::Empty`], [`WeaveError::Ragged`], [`WeaveError::TooLarge`].
    pub fn matrix(rows: Vec<Vec<bool>>) -> Result<Weave, WeaveError> {
        let expected = rows.first().map_or(0, Vec::len);
        if expected == 0 {
            return Err(WeaveError::Empty);
        }
        if rows.len() > Self::LARGEST_REPEAT || expected > Self::LARGEST_REPEAT {
            return Err(WeaveError::TooLarge);
        }
        for (row, cells) in rows.iter().enumerate() {
            if cells.len() != expected {
                return Err(WeaveError::Ragged { row: row + 1, found: cells.len(), expected });
            }
        }
        Ok(Weave { name: "matrix".into(), rows })
    }

    /// Basket (hopsack, panama) of `n`: plain weave with `n` ends and `n` picks as one.
    ///
    /// # Errors
    /// [`WeaveError::Empty`] for 0, [`WeaveError::TooLarge`].
    pub fn basket(n: u32) -> Result<Weave, WeaveError> {
        Self::grouped(n, n, format!("basket {n}"))
    }

    /// Warp rib (cords across the cloth): plain weave with `n` picks in each shed.
    ///
    /// # Errors
    /// [`WeaveError::Empty`] for 0, [`WeaveError::TooLarge`].
    pub fn warp_rib(n: u32) -> Result<Weave, WeaveError> {
        Self::grouped(1, n, format!("warp rib {n}"))
    }

    /// Weft rib (cords along the cloth): plain weave with `n` ends working as one.
    ///
    /// # Errors
    /// [`WeaveError::Empty`] for 0, [`WeaveError::TooLarge`].
    pub fn weft_rib(n: u32) -> Result<Weave, WeaveError> {
        Self::grouped(n, 1, format!("weft rib {n}"))
    }

    fn grouped(ends: u32, picks: u32, name: String) -> Result<Weave, WeaveError> {
        if ends == 0 || picks == 0 {
            return Err(WeaveError::Empty);
        }
        let (ends, picks) = (ends as usize, picks as usize);
        let half = Self::LARGEST_REPEAT / 2;
        if ends > half || picks > half {
            return Err(WeaveError::TooLarge);
        }
        let row = |pick: usize| -> Vec<bool> {
            (0..2 * ends).map(|end| (end / ends + pick / picks).is_multiple_of(2)).collect()
        };
        Ok(Weave { name, rows: (0..2 * picks).map(row).collect() })
    }

    /// Twill from its runs, warp up first: `[2, 1]` lies over two and under one. Each pick moves
    /// the runs by `step` ends, to the right for Z, to the left for S.
    ///
    /// # Errors
    /// [`WeaveError::Runs`] where the runs do not come in pairs or one is 0,
    /// [`WeaveError::Standstill`], [`WeaveError::TooLarge`].
    pub fn twill(runs: &[u32], slant: Twist, step: u32) -> Result<Weave, WeaveError> {
        if runs.is_empty() || !runs.len().is_multiple_of(2) || runs.contains(&0) {
            return Err(WeaveError::Runs);
        }
        let ends: u64 = runs.iter().map(|&run| u64::from(run)).sum();
        if ends > Self::LARGEST_REPEAT as u64 {
            return Err(WeaveError::TooLarge);
        }
        let ends = ends as usize;
        let step_ends = step as usize % ends;
        if step_ends == 0 {
            return Err(WeaveError::Standstill { step, repeat: ends as u32 });
        }
        let first: Vec<bool> = runs
            .iter()
            .enumerate()
            .flat_map(|(i, &run)| std::iter::repeat_n(i % 2 == 0, run as usize))
            .collect();
        let picks = ends / common_divisor(ends, step_ends);
        let rows = (0..picks)
            .map(|pick| {
                let shift = pick * step_ends % ends;
                (0..ends)
                    .map(|end| match slant {
                        Twist::Z => first[(end + ends - shift) % ends],
                        Twist::S => first[(end + shift) % ends],
                    })
                    .collect()
            })
            .collect();
        let written: Vec<String> = runs.iter().map(u32::to_string).collect();
        Ok(Weave { name: format!("twill {} {slant:?}", written.join("/")), rows })
    }

    /// Satin of `n` with move `step`, warp on the face: on pick p the weft shows at the end
    /// p · step mod n only. A satin exists where n and the move share no factor and the move is
    /// neither 1 nor n − 1 (those are twills); there is none of 6 and none below 5.
    ///
    /// # Errors
    /// [`WeaveError::NoSatin`] with the moves that do exist, [`WeaveError::TooLarge`].
    pub fn satin(n: u32, step: u32) -> Result<Weave, WeaveError> {
        if n as usize > Self::LARGEST_REPEAT {
            return Err(WeaveError::TooLarge);
        }
        let moves = Self::satin_moves(n);
        if !moves.contains(&step) {
            return Err(WeaveError::NoSatin { repeat: n, step, moves });
        }
        let (ends, step) = (n as usize, step as usize);
        let rows = (0..ends)
            .map(|pick| (0..ends).map(|end| end != pick * step % ends).collect())
            .collect();
        Ok(Weave { name: format!("satin {n} move {step}"), rows })
    }

    /// Sateen of `n`: [`Weave::satin`] with the weft on the face.
    ///
    /// # Errors
    /// As [`Weave::satin`].
    pub fn sateen(n: u32, step: u32) -> Result<Weave, WeaveError> {
        let mut weave = Self::satin(n, step)?.inverted();
        weave.name = format!("sateen {n} move {step}");
        Ok(weave)
    }

    /// Honeycomb of `n` ends and picks, an even number from 6: a pointed twill whose one diamond is
    /// filled with warp, so that ridges of long floats stand about hollow cells.
    ///
    /// # Errors
    /// [`WeaveError::Honeycomb`], [`WeaveError::TooLarge`].
    pub fn honeycomb(n: u32) -> Result<Weave, WeaveError> {
        if n < 6 || !n.is_multiple_of(2) {
            return Err(WeaveError::Honeycomb);
        }
        let n = n as usize;
        if n > Self::LARGEST_REPEAT {
            return Err(WeaveError::TooLarge);
        }
        // Threads from the middle of the filled diamond, round the repeat.
        let far = |at: usize| at.min(n - at);
        let up = |end: usize, pick: usize| {
            let away = far(end) + far(pick);
            away <= n / 2 - 2 || away == n / 2
        };
        let rows = (0..n).map(|pick| (0..n).map(|end| up((end + n / 2) % n, pick)).collect());
        Ok(Weave { name: format!("honeycomb {n}"), rows: rows.collect() })
    }

    /// The moves that make a satin of `n`, in rising order.
    pub fn satin_moves(n: u32) -> Vec<u32> {
        (2..n.saturating_sub(1))
            .filter(|&step| common_divisor(n as usize, step as usize) == 1)
            .collect()
    }

    /// The same weave under another name.
    #[must_use]
    pub fn named(self, name: impl Into<String>) -> Weave {
        Weave { name: name.into(), ..self }
    }

    /// Ends in one repeat.
    pub fn ends(&self) -> usize {
        self.rows.first().map_or(0, Vec::len)
    }

    /// Picks in one repeat.
    pub fn picks(&self) -> usize {
        self.rows.len()
    }

    /// Whether the warp is on top where this end crosses this pick; any thread of the cloth.
    pub fn warp_up(&self, end: usize, pick: usize) -> bool {
        let row = self.rows.get(pick % self.picks().max(1));
        row.is_some_and(|row| row.get(end % row.len().max(1)).copied().unwrap_or(false))
    }

    /// Warp and weft change places on the face.
    #[must_use]
    pub fn inverted(&self) -> Weave {
        let rows = self.rows.iter().map(|row| row.iter().map(|up| !up).collect()).collect();
        Weave { name: self.name.clone(), rows }
    }

    /// Left and right change places.
    #[must_use]
    pub fn mirrored(&self) -> Weave {
        let rows = self.rows.iter().map(|row| row.iter().rev().copied().collect()).collect();
        Weave { name: self.name.clone(), rows }
    }

    /// The weave as seen from behind: inverted and mirrored.
    #[must_use]
    pub fn back(&self) -> Weave {
        self.inverted().mirrored()
    }

    /// Share of crossings with the warp on top.
    pub fn warp_share(&self) -> f64 {
        let up = self.rows.iter().flatten().filter(|&&up| up).count();
        up as f64 / (self.ends() * self.picks()).max(1) as f64
    }

    /// How often the threads change sides, as a share of plain weave where they do at every
    /// crossing: the mean over warp, the mean over weft.
    pub fn interlacing(&self) -> [f64; 2] {
        let cells = (self.ends() * self.picks()).max(1) as f64;
        let mut changes = [0usize; 2];
        for pick in 0..self.picks() {
            for end in 0..self.ends() {
                let up = self.warp_up(end, pick);
                changes[0] += usize::from(up != self.warp_up(end, pick + 1));
                changes[1] += usize::from(up != self.warp_up(end + 1, pick));
            }
        }
        changes.map(|n| n as f64 / cells)
    }

    /// The longest floats on both sides, counted round the repeat.
    pub fn floats(&self) -> Floats {
        let ends = || {
            (0..self.ends()).map(|end| (0..self.picks()).map(move |pick| self.warp_up(end, pick)))
        };
        let picks = || self.rows.iter().map(|row| row.iter().copied());
        Floats {
            warp_on_face: longest_run(ends(), true),
            warp_on_back: longest_run(ends(), false),
            weft_on_face: longest_run(picks(), false),
            weft_on_back: longest_run(picks(), true),
        }
    }
}

/// The longest run of `side` in any of these closed rings; `None` where a ring holds nothing
/// else.
fn longest_run(
    rings: impl Iterator<Item = impl Iterator<Item = bool> + Clone>,
    side: bool,
) -> Option<usize> {
    let mut longest = 0;
    for ring in rings {
        let mut length = 0;
        let mut bound = false;
        let mut run = 0;
        for up in ring.clone() {
            length += 1;
            bound |= up != side;
        }
        if length > 0 && !bound {
            return None;
        }
        for up in ring.clone().chain(ring) {
            run = if up == side { run + 1 } else { 0 };
            longest = longest.max(run);
        }
    }
    Some(longest)
}

/// The greatest common divisor.
fn common_divisor(a: usize, b: usize) -> usize {
    if b == 0 { a } else { common_divisor(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Point paper, top row first, 1 = warp up.
    fn drawn(weave: &Weave) -> String {
        let row = |row: &Vec<bool>| row.iter().map(|&up| if up { '1' } else { '0' }).collect();
        weave.rows.iter().rev().map(row).collect::<Vec<String>>().join("/")
    }

    #[test]
    fn twill_of_two_over_one_rises_as_its_letter() {
        let z = Weave::twill(&[2, 1], Twist::Z, 1).unwrap();
        assert_eq!(drawn(&z), "101/011/110");
        assert_eq!(drawn(&Weave::twill(&[2, 1], Twist::S, 1).unwrap()), "011/101/110");
        assert_eq!(z.mirrored().warp_share(), 2.0 / 3.0);
        let broad = Weave::twill(&[2, 1, 1, 2], Twist::Z, 2).unwrap();
        assert_eq!((broad.ends(), broad.picks()), (6, 3));
    }

    #[test]
    fn twill_refuses_what_is_no_twill() {
        assert_eq!(Weave::twill(&[2], Twist::Z, 1), Err(WeaveError::Runs));
        assert_eq!(Weave::twill(&[2, 0], Twist::Z, 1), Err(WeaveError::Runs));
        let still = WeaveError::Standstill { step: 3, repeat: 3 };
        assert_eq!(Weave::twill(&[2, 1], Twist::S, 3), Err(still));
        assert_eq!(Weave::twill(&[u32::MAX, 1], Twist::S, 3), Err(WeaveError::TooLarge));
    }

    #[test]
    fn satin_moves_are_those_of_wolfensberger() {
        // Wolfensberger, Theory of Silk Weaving: one of each pair m, n − m.
        let table: [(u32, &[u32]); 9] = [
            (5, &[2]),
            (6, &[]),
            (7, &[2, 3]),
            (8, &[3]),
            (9, &[2, 4]),
            (10, &[3]),
            (12, &[5]),
            (14, &[3, 5]),
            (16, &[3, 5, 7]),
        ];
        for (n, moves) in table {
            let half: Vec<u32> = Weave::satin_moves(n).into_iter().filter(|m| 2 * m < n).collect();
            assert_eq!(half, moves, "satin of {n}");
        }
    }

    #[test]
    fn satin_floats_over_all_but_one() {
        let satin = Weave::satin(8, 3).unwrap();
        let floats = satin.floats();
        assert_eq!((floats.warp_on_face, floats.weft_on_face), (Some(7), Some(1)));
        assert_eq!((floats.warp_on_back, floats.weft_on_back), (Some(1), Some(7)));
        assert_eq!(satin.warp_share(), 7.0 / 8.0);
        assert_eq!(drawn(&Weave::sateen(5, 2).unwrap()), "00010/01000/00001/00100/10000");
        let none = WeaveError::NoSatin { repeat: 8, step: 2, moves: vec![3, 5] };
        assert_eq!(Weave::satin(8, 2), Err(none));
    }

    #[test]
    fn honeycomb_is_a_filled_diamond_between_its_lines() {
        let honeycomb = Weave::honeycomb(8).unwrap();
        assert_eq!(
            drawn(&honeycomb),
            "01011101/00101010/00010100/00001000/00010100/00101010/01011101/10111110"
        );
        let floats = honeycomb.floats();
        assert_eq!((floats.warp_on_face, floats.weft_on_face), (Some(5), Some(7)));
        assert_eq!(Weave::honeycomb(7), Err(WeaveError::Honeycomb));
        assert_eq!(Weave::honeycomb(4), Err(WeaveError::Honeycomb));
        assert_eq!(Weave::honeycomb(u32::MAX - 1), Err(WeaveError::TooLarge));
    }

    #[test]
    fn basket_and_ribs_group_the_threads_of_plain_weave() {
        assert_eq!(drawn(&Weave::basket(2).unwrap()), "0011/0011/1100/1100");
        assert_eq!(drawn(&Weave::warp_rib(2).unwrap()), "01/01/10/10");
        assert_eq!(drawn(&Weave::weft_rib(2).unwrap()), "0011/1100");
        assert_eq!(Weave::basket(1).unwrap().rows, Weave::plain().rows);
        assert_eq!(Weave::basket(0), Err(WeaveError::Empty));
    }

    #[test]
    fn the_back_of_the_back_is_the_face() {
        let twill = Weave::twill(&[3, 1], Twist::Z, 1).unwrap();
        assert_eq!(twill.back().back(), twill);
        // A 3/1 Z twill shows its weft behind, and its lines rise to the other side.
        let behind = Weave::twill(&[1, 3], Twist::S, 1).unwrap();
        let shifted: Vec<Vec<bool>> = (0..4)
            .map(|pick| (0..4).map(|end| twill.back().warp_up(end, pick)).collect())
            .collect();
        let same = (0..4)
            .any(|by| (0..4).all(|p| (0..4).all(|e| shifted[p][e] == behind.warp_up(e + by, p))));
        assert!(same, "{} against {}", drawn(&twill.back()), drawn(&behind));
    }

    #[test]
    fn floats_are_counted_round_the_repeat_and_loose_threads_told() {
        let split = Weave::matrix(vec![vec![true, false, false, true]; 1]).unwrap();
        assert_eq!(split.floats().weft_on_back, Some(2), "the run passes the repeat's edge");
        assert_eq!(split.floats().warp_on_face, None, "an end that is always up is not bound");
        assert_eq!(split.floats().longest(), None);
        assert_eq!(Weave::plain().floats().longest(), Some(1));
        assert_eq!(Weave::plain().interlacing(), [1.0, 1.0]);
        assert_eq!(Weave::basket(2).unwrap().interlacing(), [0.5, 0.5]);
    }

    #[test]
    fn ragged_point_paper_names_the_row() {
        let rows = vec![vec![true, false], vec![true]];
        let error = WeaveError::Ragged { row: 2, found: 1, expected: 2 };
        assert_eq!(Weave::matrix(rows), Err(error));
        assert_eq!(Weave::matrix(vec![vec![]]), Err(WeaveError::Empty));
    }
}
