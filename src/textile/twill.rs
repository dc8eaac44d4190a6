//! Twills whose ends are drawn in another order: herringbone, point, broken.

use super::weave::{Weave, WeaveError};

/// A twill turned every so many ends, with a clean cut: at each turn a warp float lies beside a
/// weft float, as far as the twill is even.
///
/// # Errors
/// [`WeaveError::Empty`] for groups of no ends, [`WeaveError::TooLarge`].
pub fn herringbone(twill: &Weave, every: u32) -> Result<Weave, WeaveError> {
    let (ends, every) = (twill.ends(), every as usize);
    if every == 0 || ends == 0 {
        return Err(WeaveError::Empty);
    }
    if 2 * every > Weave::LARGEST_REPEAT {
        return Err(WeaveError::TooLarge);
    }
    // How far along the twill the end lies that differs most from one; of several the middle one.
    let differing = |by: usize| {
        (0..twill.picks()).filter(|&pick| twill.warp_up(0, pick) != twill.warp_up(by, pick)).count()
    };
    let middling = |by: usize| by.min(ends - by);
    let cut = (0..ends).max_by_key(|&by| (differing(by), middling(by), ends - by)).unwrap_or(0);
    // Upwards from the first end; then from across the cut downwards, which ends at `cut`, and
    // the first end lies across from that again.
    let up = 0..every;
    let down = (0..every).map(|n| cut + every - 1 - n);
    drawn(twill, &up.chain(down).collect::<Vec<usize>>())
}

/// A twill drawn to a point and back: ends 1 to `every`, and back without repeating the last and
/// the first.
///
/// # Errors
/// [`WeaveError::Empty`] for points of fewer than two ends, [`WeaveError::TooLarge`].
pub fn pointed(twill: &Weave, every: u32) -> Result<Weave, WeaveError> {
    let every = every as usize;
    if every < 2 {
        return Err(WeaveError::Empty);
    }
    if 2 * every > Weave::LARGEST_REPEAT {
        return Err(WeaveError::TooLarge);
    }
    drawn(twill, &(0..every).chain((1..every - 1).rev()).collect::<Vec<usize>>())
}

/// A twill whose line is broken in the middle of its repeat: the second half of the ends runs
/// back. Of 3/1 it is what weavers call a satin of four.
///
/// # Errors
/// [`WeaveError::TooLarge`].
pub fn broken(twill: &Weave) -> Result<Weave, WeaveError> {
    let ends = twill.ends();
    let half = ends.div_ceil(2);
    drawn(twill, &(0..half).chain((half..ends).rev()).collect::<Vec<usize>>())
}

/// The ends of a weave in another order.
fn drawn(weave: &Weave, order: &[usize]) -> Result<Weave, WeaveError> {
    let row = |pick| order.iter().map(|&end| weave.warp_up(end, pick)).collect();
    Weave::matrix((0..weave.picks()).map(row).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::textile::draft::Draft;
    use crate::textile::yarn::Twist;

    fn twill(runs: &[u32]) -> Weave {
        Weave::twill(runs, Twist::Z, 1).unwrap()
    }

    /// Shafts of a threading, by the order in which they appear.
    fn threading(weave: &Weave) -> Vec<u32> {
        Draft::of_weave(weave).threading.concat()
    }

    #[test]
    fn a_herringbone_is_cut_clean_at_every_turn() {
        let serge = twill(&[2, 2]);
        let herringbone = herringbone(&serge, 8).unwrap();
        assert_eq!(threading(&herringbone), [1, 2, 3, 4, 1, 2, 3, 4, 2, 1, 4, 3, 2, 1, 4, 3]);
        for every in 3..12 {
            let cut = super::herringbone(&twill(&[3, 3]), every).unwrap();
            for (edge, before) in [(0, 2 * every - 1), (every, every - 1)] {
                for pick in 0..6 {
                    let up = |end: u32| cut.warp_up(end as usize, pick);
                    assert_ne!(up(edge), up(before), "{every}");
                }
            }
        }
        assert_eq!(super::herringbone(&serge, 0), Err(WeaveError::Empty));
        assert_eq!(super::herringbone(&serge, 3000), Err(WeaveError::TooLarge));
    }

    #[test]
    fn a_point_turns_without_doubling_an_end() {
        assert_eq!(threading(&pointed(&twill(&[2, 2]), 4).unwrap()), [1, 2, 3, 4, 3, 2]);
        let long = threading(&pointed(&twill(&[2, 2]), 6).unwrap());
        assert_eq!(long, [1, 2, 3, 4, 1, 2, 1, 4, 3, 2]);
        assert_eq!(pointed(&twill(&[2, 2]), 1), Err(WeaveError::Empty));
    }

    #[test]
    fn a_broken_twill_of_four_is_the_satin_of_four() {
        let crow = broken(&twill(&[3, 1])).unwrap();
        assert_eq!(threading(&crow), [1, 2, 3, 4]);
        let down = |pick| (0..4).find(|&end| !crow.warp_up(end, pick));
        assert_eq!([0, 1, 2, 3].map(down), [Some(2), Some(0), Some(1), Some(3)]);
        assert_eq!(crow.floats().weft_on_face, Some(1));
    }
}
