//! Drafts as weavers write them: which shaft each end hangs on, which shafts each pick moves,
//! and the threads themselves.

use super::Colour;
use super::drawdown::Drawdown;
use super::weave::Weave;
use serde::{Deserialize, Serialize};

/// A draft. Ends, picks, shafts and treadles are counted from 1 in the lists, as weavers do.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Draft {
    /// What it is called.
    pub title: String,
    /// Who drew it up.
    pub author: String,
    /// Lines of notes.
    pub notes: Vec<String>,
    /// Whether a treadle or a peg lifts its shafts; otherwise it lowers them.
    pub rising: bool,
    /// Shafts of the loom.
    pub shafts: usize,
    /// Treadles of the loom.
    pub treadles: usize,
    /// The shafts of each end, first end first; rising, each once, none where it hangs on none.
    pub threading: Vec<Vec<u32>>,
    /// What each pick moves.
    pub shedding: Shedding,
    /// The ends.
    pub warp: Threads,
    /// The picks.
    pub weft: Threads,
}

/// How the sheds are made. All lists are rising, each number once.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Shedding {
    /// By treadles that are tied to shafts.
    Treadled {
        /// The shafts of each treadle.
        tieup: Vec<Vec<u32>>,
        /// The treadles of each pick.
        treadling: Vec<Vec<u32>>,
    },
    /// By a lift plan (peg plan): the shafts of each pick.
    Lifted {
        /// The plan.
        plan: Vec<Vec<u32>>,
    },
}

impl Default for Shedding {
    fn default() -> Self {
        Shedding::Lifted { plan: Vec::new() }
    }
}

/// The threads of one system. A list that is there has an entry for every thread.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Threads {
    /// Their colours.
    pub colours: Option<Vec<Colour>>,
    /// Distance of each from the one before it, middle to middle, m.
    pub spacing: Option<Vec<f64>>,
    /// Their thicknesses, m.
    pub thickness: Option<Vec<f64>>,
}

/// A draft that cannot be worked out: it has more crossings than [`Draft::LARGEST_AREA`], or its
/// lists are so entangled that they would take as long.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the draft has too many crossings to be worked out")]
pub struct TooLarge;

impl Draft {
    /// Threads a draft may have in one direction.
    pub const LARGEST: usize = 100_000;

    /// Crossings it may have.
    pub const LARGEST_AREA: usize = 1 << 28;

    /// The draft of a weave: ends that work alike hang on one shaft, picks that are alike are
    /// trodden with one treadle; both are numbered in the order in which they appear.
    pub fn of_weave(weave: &Weave) -> Draft {
        let columns = (0..weave.ends())
            .map(|end| weave.rows.iter().map(|row| row[end]).collect::<Vec<bool>>());
        let (threading, shafts) = alike(columns);
        let (treadling, treadles) = alike(weave.rows.iter().cloned());
        let mut first = vec![0; shafts.len()];
        for (end, shaft) in threading.iter().enumerate().rev() {
            first[*shaft as usize - 1] = end;
        }
        let tieup = treadles
            .iter()
            .map(|row: &Vec<bool>| {
                (1..).zip(&first).filter(|(_, end)| row[**end]).map(|(s, _)| s).collect()
            })
            .collect();
        let single = |numbers: Vec<u32>| numbers.into_iter().map(|n| vec![n]).collect();
        Draft {
            title: weave.name.clone(),
            rising: true,
            shafts: shafts.len(),
            treadles: treadles.len(),
            shedding: Shedding::Treadled { tieup, treadling: single(treadling) },
            threading: single(threading),
            ..Draft::default()
        }
    }

    /// So many repeats of the draft side by side and above each other, as one draft.
    #[must_use]
    pub fn repeated(&self, across: usize, upwards: usize) -> Draft {
        let threads = |threads: &Threads, times: usize| Threads {
            colours: threads.colours.as_ref().map(|list| list.repeat(times)),
            spacing: threads.spacing.as_ref().map(|list| list.repeat(times)),
            thickness: threads.thickness.as_ref().map(|list| list.repeat(times)),
        };
        let shedding = match &self.shedding {
            Shedding::Treadled { tieup, treadling } => {
                Shedding::Treadled { tieup: tieup.clone(), treadling: again(treadling, upwards) }
            }
            Shedding::Lifted { plan } => Shedding::Lifted { plan: again(plan, upwards) },
        };
        Draft {
            threading: again(&self.threading, across),
            shedding,
            warp: threads(&self.warp, across),
            weft: threads(&self.weft, upwards),
            ..self.clone()
        }
    }

    /// Ends.
    pub fn ends(&self) -> usize {
        self.threading.len()
    }

    /// Picks.
    pub fn picks(&self) -> usize {
        match &self.shedding {
            Shedding::Treadled { treadling, .. } => treadling.len(),
            Shedding::Lifted { plan } => plan.len(),
        }
    }

    /// Ends and picks up to the last that does anything. Programs often declare a loom's full
    /// width and thread a part of it.
    pub fn worked(&self) -> (usize, usize) {
        let last = |lists: &[Vec<u32>]| lists.iter().rposition(|list| !list.is_empty());
        let moved = match &self.shedding {
            Shedding::Treadled { treadling, .. } => last(treadling),
            Shedding::Lifted { plan } => last(plan),
        };
        [last(&self.threading), moved].map(|last| last.map_or(0, |last| last + 1)).into()
    }

    /// The shafts that a pick moves, the pick counted from 0; rising, each once.
    pub fn moved(&self, pick: usize) -> Vec<u32> {
        match &self.shedding {
            Shedding::Lifted { plan } => plan.get(pick).cloned().unwrap_or_default(),
            Shedding::Treadled { tieup, treadling } => {
                let pressed = treadling.get(pick).map_or(&[][..], Vec::as_slice);
                let tied = |treadle: &u32| tieup.get((*treadle as usize).wrapping_sub(1));
                match pressed {
                    [one] => tied(one).cloned().unwrap_or_default(),
                    many => {
                        let mut moved: Vec<u32> =
                            many.iter().filter_map(tied).flatten().copied().collect();
                        moved.sort_unstable();
                        moved.dedup();
                        moved
                    }
                }
            }
        }
    }

    /// The highest shaft that anything names, at least the number of shafts of the loom.
    pub fn highest_shaft(&self) -> u32 {
        let of = |lists: &[Vec<u32>]| lists.iter().filter_map(|l| l.last().copied()).max();
        let moved = match &self.shedding {
            Shedding::Treadled { tieup, .. } => of(tieup),
            Shedding::Lifted { plan } => of(plan),
        };
        moved.max(of(&self.threading)).unwrap_or(0).max(self.shafts as u32)
    }

    /// The highest treadle that anything names, at least the number of treadles of the loom.
    pub fn highest_treadle(&self) -> u32 {
        let used = match &self.shedding {
            Shedding::Treadled { tieup, treadling } => {
                let pressed = treadling.iter().filter_map(|l| l.last().copied()).max();
                pressed.max(Some(tieup.len() as u32))
            }
            Shedding::Lifted { .. } => None,
        };
        used.unwrap_or(0).max(self.treadles as u32)
    }

    /// Works out which thread lies on top at every crossing: an end is up where the pick lifts
    /// one of its shafts, with a sinking shed where it lowers none.
    ///
    /// # Errors
    /// [`TooLarge`].
    pub fn drawdown(&self) -> Result<Drawdown, TooLarge> {
        let (ends, picks) = (self.ends(), self.picks());
        if ends.saturating_mul(picks) > Self::LARGEST_AREA {
            return Err(TooLarge);
        }
        let mut hanging: Vec<Vec<u32>> = vec![Vec::new(); self.highest_shaft() as usize + 1];
        for (end, shafts) in (0..).zip(&self.threading) {
            for &shaft in shafts {
                if let Some(list) = hanging.get_mut(shaft as usize) {
                    list.push(end);
                }
            }
        }
        // What remains to be done is bounded beforehand: lists may name threads over and over.
        let mut left = 8 * Self::LARGEST_AREA;
        let mut drawn = Drawdown::new(ends, picks);
        for pick in 0..picks {
            for shaft in self.moved(pick) {
                let list = hanging.get(shaft as usize).map_or(&[][..], Vec::as_slice);
                left = left.checked_sub(list.len() + 1).ok_or(TooLarge)?;
                for &end in list {
                    drawn.raise(end as usize, pick);
                }
            }
        }
        if !self.rising {
            drawn.turn();
        }
        Ok(drawn)
    }
}

/// A list so many times.
fn again(lists: &[Vec<u32>], times: usize) -> Vec<Vec<u32>> {
    std::iter::repeat_n(lists, times).flatten().cloned().collect()
}

/// Numbers equal things alike, from 1, in the order in which they appear; and the things.
fn alike<T: Clone + Ord>(things: impl Iterator<Item = T>) -> (Vec<u32>, Vec<T>) {
    let mut known = std::collections::BTreeMap::new();
    let mut different = Vec::new();
    let numbers = things
        .map(|thing| {
            *known.entry(thing.clone()).or_insert_with(|| {
                different.push(thing);
                different.len() as u32
            })
        })
        .collect();
    (numbers, different)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::textile::yarn::Twist;

    fn one(numbers: &[u32]) -> Vec<Vec<u32>> {
        numbers.iter().map(|&n| vec![n]).collect()
    }

    #[test]
    fn a_twill_is_threaded_straight() {
        let weave = Weave::twill(&[2, 2], Twist::Z, 1).unwrap();
        let draft = Draft::of_weave(&weave);
        assert_eq!((draft.shafts, draft.treadles), (4, 4));
        assert_eq!(draft.threading, one(&[1, 2, 3, 4]));
        let Shedding::Treadled { tieup, treadling } = &draft.shedding else { panic!() };
        assert_eq!(treadling, &one(&[1, 2, 3, 4]));
        assert_eq!(tieup[..2], [vec![1, 2], vec![2, 3]]);
        assert_eq!(draft.drawdown().unwrap().matrix(), weave.rows);
    }

    #[test]
    fn a_sinking_shed_shows_the_other_side() {
        let mut draft = Draft::of_weave(&Weave::satin(5, 2).unwrap());
        let face = draft.drawdown().unwrap();
        draft.rising = false;
        let back = draft.drawdown().unwrap();
        assert_eq!(face.warp_up() + back.warp_up(), 25);
    }

    #[test]
    fn treadles_pressed_together_lift_together() {
        let draft = Draft {
            rising: true,
            threading: one(&[1, 2, 3]),
            shedding: Shedding::Treadled {
                tieup: vec![vec![1], vec![1, 3]],
                treadling: vec![vec![1, 2], vec![], vec![2], vec![9]],
            },
            ..Draft::default()
        };
        let rows = draft.drawdown().unwrap().matrix();
        assert_eq!(rows[0], [true, false, true]);
        assert_eq!(rows[1], [false; 3]);
        assert_eq!(rows[3], [false; 3]);
    }

    #[test]
    fn what_would_take_for_ever_is_refused() {
        let wide = Draft {
            rising: true,
            threading: vec![vec![1]; Draft::LARGEST],
            shedding: Shedding::Lifted { plan: vec![vec![1]; Draft::LARGEST] },
            ..Draft::default()
        };
        assert_eq!(wide.drawdown(), Err(TooLarge));
        let all: Vec<u32> = (1..=20_000).collect();
        let tangled = Draft {
            rising: true,
            threading: vec![all.clone(); 100],
            shedding: Shedding::Treadled { tieup: vec![all], treadling: one(&[1; 100_000]) },
            ..Draft::default()
        };
        assert_eq!(tangled.drawdown(), Err(TooLarge));
    }
}
