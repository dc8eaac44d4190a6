//! Whether a cloth hangs together.
//!
//! Of two crossing threads one lies on top. Threads that can be lifted off as a whole lie on top
//! of all others at every crossing; a cloth hangs together when there are none such (Clapham
//! 1980, Enns 1984). With an arc from the upper to the lower thread of every crossing, what hangs
//! together are the strongly connected parts, and they lie upon each other in one order.

use super::drawdown::{Cloth, System};

/// The parts of a cloth, from the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Layers {
    /// Ends and picks of each part, rising.
    pub parts: Vec<Part>,
}

/// Threads that hang together.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Part {
    /// Its ends, from 0.
    pub ends: Vec<usize>,
    /// Its picks, from 0.
    pub picks: Vec<usize>,
}

impl Layers {
    /// Finds the parts of a cloth.
    pub fn of(cloth: &Cloth) -> Layers {
        let walk = Walk::new(cloth);
        let mut left = Unseen::all(cloth);
        let mut done = Vec::with_capacity(walk.ends + walk.picks);
        for start in 0..walk.ends + walk.picks {
            walk.follow(start, true, &mut left, |thread| done.push(thread));
        }
        let mut left = Unseen::all(cloth);
        let mut parts = Vec::new();
        for &start in done.iter().rev() {
            let mut part = Part::default();
            walk.follow(start, false, &mut left, |thread| match thread.checked_sub(walk.ends) {
                None => part.ends.push(thread),
                Some(pick) => part.picks.push(pick),
            });
            part.ends.sort_unstable();
            part.picks.sort_unstable();
            if !part.ends.is_empty() || !part.picks.is_empty() {
                parts.push(part);
            }
        }
        Layers { parts }
    }

    /// Parts that are cloth: ends and picks that hold each other.
    pub fn cloths(&self) -> impl Iterator<Item = &Part> {
        self.parts.iter().filter(|part| !part.ends.is_empty() && !part.picks.is_empty())
    }

    /// How many cloths lie upon each other.
    pub fn count(&self) -> usize {
        self.cloths().count()
    }
}

/// Threads that were not seen yet, a bit each.
struct Unseen {
    ends: Vec<u64>,
    picks: Vec<u64>,
}

impl Unseen {
    fn all(cloth: &Cloth) -> Unseen {
        let bits = |count: usize| {
            let mut words = vec![u64::MAX; count.div_ceil(64)];
            if let (Some(last), false) = (words.last_mut(), count.is_multiple_of(64)) {
                *last = (1 << (count % 64)) - 1;
            }
            words
        };
        Unseen { ends: bits(cloth.picks.ends()), picks: bits(cloth.picks.picks()) }
    }

    /// Takes a thread out; whether it was there.
    fn take(words: &mut [u64], number: usize) -> bool {
        let Some(word) = words.get_mut(number / 64) else { return false };
        let bit = 1 << (number % 64);
        let there = *word & bit != 0;
        *word &= !bit;
        there
    }
}

/// The threads of a cloth as a graph: ends first, then picks.
struct Walk<'a> {
    cloth: &'a Cloth,
    ends: usize,
    picks: usize,
}

impl<'a> Walk<'a> {
    fn new(cloth: &'a Cloth) -> Self {
        Walk { cloth, ends: cloth.picks.ends(), picks: cloth.picks.picks() }
    }

    /// Goes from a thread to all unseen ones that lie below those it comes to, or above them, and
    /// says each when all beyond it are said.
    fn follow(&self, start: usize, below: bool, left: &mut Unseen, mut leave: impl FnMut(usize)) {
        let fresh = match start.checked_sub(self.ends) {
            None => Unseen::take(&mut left.ends, start),
            Some(pick) => Unseen::take(&mut left.picks, pick),
        };
        if !fresh {
            return;
        }
        // A thread, and the word of its row from which it looks for the next.
        let mut path = vec![(start, 0)];
        while let Some((thread, word)) = path.last_mut() {
            let (system, number) = match thread.checked_sub(self.ends) {
                None => (System::Warp, *thread),
                Some(pick) => (System::Weft, pick),
            };
            let (rows, on_top) = self.cloth.threads(system);
            let row = rows.row(number);
            let across = match system {
                System::Warp => &mut left.picks,
                System::Weft => &mut left.ends,
            };
            let wanted = |row: u64| if on_top == below { row } else { !row };
            let mut next = None;
            while next.is_none() && *word < row.len() {
                let open = wanted(row[*word]) & across[*word];
                if open == 0 {
                    *word += 1;
                } else {
                    next = Some(*word * 64 + open.trailing_zeros() as usize);
                }
            }
            match next {
                None => {
                    leave(*thread);
                    path.pop();
                }
                Some(number) => {
                    Unseen::take(across, number);
                    let thread = match system {
                        System::Warp => self.ends + number,
                        System::Weft => number,
                    };
                    path.push((thread, 0));
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::textile::drawdown::Drawdown;
    use crate::textile::weave::Weave;
    use crate::textile::yarn::Twist;
    use proptest::prelude::*;

    fn layers(rows: &[Vec<bool>]) -> Layers {
        let weave = Weave::matrix(rows.to_vec()).unwrap();
        Layers::of(&Cloth::new(Drawdown::of_weave(&weave)))
    }

    fn drawn(rows: &[&str]) -> Vec<Vec<bool>> {
        rows.iter().map(|row| row.chars().map(|c| c == '1').collect()).collect()
    }

    #[test]
    fn usual_weaves_hang_together() {
        for weave in [
            Weave::plain(),
            Weave::satin(8, 3).unwrap(),
            Weave::twill(&[3, 1], Twist::Z, 1).unwrap(),
            Weave::basket(3).unwrap(),
        ] {
            assert_eq!(layers(&weave.rows).parts.len(), 1, "{}", weave.name);
        }
    }

    #[test]
    fn a_double_cloth_is_two() {
        // Odd ends and picks are the upper plain weave, even ones the lower.
        let double = layers(&drawn(&["1000", "1110", "0010", "1011"]));
        assert_eq!(double.count(), 2);
        assert_eq!(double.parts[0], Part { ends: vec![0, 2], picks: vec![0, 2] });
        assert_eq!(double.parts[1], Part { ends: vec![1, 3], picks: vec![1, 3] });
    }

    #[test]
    fn a_thread_that_is_never_bound_is_a_part_of_its_own() {
        let loose = layers(&drawn(&["101", "011"]));
        assert_eq!(loose.count(), 1);
        assert_eq!(loose.parts[0], Part { ends: vec![2], picks: vec![] });
    }

    proptest! {
        #[test]
        fn every_part_lies_wholly_above_the_next(
            rows in (1_usize..80, 1_usize..8).prop_flat_map(|(ends, picks)| {
                prop::collection::vec(prop::collection::vec(any::<bool>(), ends), picks)
            }),
        ) {
            let found = layers(&rows);
            let mut seen = 0;
            for (above, part) in found.parts.iter().enumerate() {
                seen += part.ends.len() + part.picks.len();
                for below in &found.parts[above + 1..] {
                    for &end in &part.ends {
                        prop_assert!(below.picks.iter().all(|&pick| rows[pick][end]));
                    }
                    for &pick in &part.picks {
                        prop_assert!(below.ends.iter().all(|&end| !rows[pick][end]));
                    }
                }
            }
            prop_assert_eq!(seen, rows.len() + rows[0].len());
        }
    }
}
