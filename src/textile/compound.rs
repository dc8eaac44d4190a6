//! Weaves made of weaves: blocks of a profile, two cloths woven at once, figures of extra threads
//! on a ground.

use super::weave::{Weave, WeaveError};

/// A weave whose blocks stand as the cells of a profile, bottom row first: each cell is one repeat
/// of its weave, or as many as make all weaves come out even.
///
/// # Errors
/// [`WeaveError::Empty`] where a cell names no weave, [`WeaveError::Ragged`],
/// [`WeaveError::TooLarge`].
pub fn profile(cells: &[Vec<usize>], weaves: &[Weave]) -> Result<Weave, WeaveError> {
    let used: Vec<&Weave> = cells
        .iter()
        .flatten()
        .map(|&cell| weaves.get(cell).ok_or(WeaveError::Empty))
        .collect::<Result<_, _>>()?;
    let ends = common(used.iter().map(|weave| weave.ends()))?;
    let picks = common(used.iter().map(|weave| weave.picks()))?;
    let width = cells.first().map_or(0, Vec::len);
    if width * ends > Weave::LARGEST_REPEAT || cells.len() * picks > Weave::LARGEST_REPEAT {
        return Err(WeaveError::TooLarge);
    }
    let row = |pick: usize| -> Vec<bool> {
        let block = |&cell: &usize| {
            let weave = &weaves[cell];
            (0..ends).map(move |end| weave.warp_up(end, pick % picks))
        };
        cells[pick / picks].iter().flat_map(block).collect()
    };
    Weave::matrix((0..cells.len() * picks).map(row).collect())
}

/// A weave and its turn, for the blocks of a damask: warp and weft have changed places, and where
/// the two meet a warp float lies against a weft float on every thread (a clean cut). For that the
/// weave is set off along the pick until it is the same upside down, which every satin can be.
pub fn turned(weave: &Weave) -> [Weave; 2] {
    let (ends, picks) = (weave.ends(), weave.picks());
    let up = |set_off: usize, end: usize, pick: usize| weave.warp_up(end + set_off, pick);
    let same_upside_down = |set_off: usize| {
        (0..picks).all(|pick| {
            (0..ends)
                .all(|end| up(set_off, end, pick) == up(set_off, ends - 1 - end, picks - 1 - pick))
        })
    };
    // Nobody turns a weave of thousands of threads; to try them all would take too long.
    let tried = if ends * ends * picks <= 1 << 26 { ends } else { 0 };
    let set_off = (0..tried).find(|&set_off| same_upside_down(set_off)).unwrap_or(0);
    let row = |pick: usize| (0..ends).map(|end| up(set_off, end, pick)).collect();
    let face = Weave { name: weave.name.clone(), rows: (0..picks).map(row).collect() };
    let back = face.back();
    [face, back]
}

/// Two cloths woven at once, one above the other: ends and picks belong to the upper and the lower
/// in turn. When a pick of the lower is woven all upper ends are lifted out of its way, when one
/// of the upper is woven all lower ends stay down. With `stitch`, on every so many upper picks one
/// lower end is lifted over the pick, which ties the two together, where upper ends beside it
/// hide it.
///
/// # Errors
/// [`WeaveError::Empty`] for a stitch every 0 picks, [`WeaveError::TooLarge`].
pub fn double(upper: &Weave, lower: &Weave, stitch: Option<u32>) -> Result<Weave, WeaveError> {
    let ends = common([upper.ends(), lower.ends()].into_iter())?;
    let mut picks = common([upper.picks(), lower.picks()].into_iter())?;
    if let Some(every) = stitch {
        picks = common([picks, every as usize].into_iter())?;
    }
    if 2 * ends.max(picks) > Weave::LARGEST_REPEAT {
        return Err(WeaveError::TooLarge);
    }
    let mut rows = vec![vec![false; 2 * ends]; 2 * picks];
    for pick in 0..picks {
        for end in 0..ends {
            rows[2 * pick][2 * end] = upper.warp_up(end, pick);
            rows[2 * pick + 1][2 * end] = true;
            rows[2 * pick + 1][2 * end + 1] = lower.warp_up(end, pick);
        }
    }
    let Some(every) = stitch else { return Weave::matrix(rows) };
    for (count, pick) in (0..picks).step_by(every as usize).enumerate() {
        // The lower end between two upper ones that lie on this pick, itself up before or after.
        let hidden = |end: usize| {
            let beside = [upper.warp_up(end, pick), upper.warp_up(end + 1, pick)];
            let own = [lower.warp_up(end, pick + picks - 1), lower.warp_up(end, pick)];
            2 * beside.into_iter().filter(|up| *up).count()
                + own.into_iter().filter(|up| *up).count()
        };
        // Of equally hidden ones another each time, so that no line of them shows.
        let first = count * (ends / 2 + 1) % ends;
        let around = (first..first + ends).map(|end| end % ends);
        let best = around.rev().max_by_key(|&end| hidden(end)).unwrap_or(0);
        rows[2 * pick][2 * best + 1] = true;
    }
    Weave::matrix(rows)
}

/// Which threads make a figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Extra {
    Warp,
    Weft,
}

/// A figure of extra threads on a ground (brocade): beside every thread of the ground that a row
/// of the figure crosses lies a further one, on the face where the figure has a mark and on the
/// back elsewhere. With `bind` a figure thread dips under one thread after every so many, in rows
/// set off against each other. Rows of a figure of warp are its columns; `marks` stand bottom row
/// first.
///
/// # Errors
/// [`WeaveError::Empty`] without a mark or with a binding every 0 or 1 threads,
/// [`WeaveError::Ragged`], [`WeaveError::TooLarge`].
pub fn figure(
    ground: &Weave,
    marks: &[Vec<bool>],
    extra: Extra,
    bind: Option<u32>,
) -> Result<Weave, WeaveError> {
    // A figure thread to a row, and whether it lies on top, is the same for warp and weft.
    let turned = |rows: &[Vec<bool>]| -> Vec<Vec<bool>> {
        let width = rows.first().map_or(0, Vec::len);
        (0..width).map(|n| rows.iter().map(|row| row[n]).collect()).collect()
    };
    let marks = Weave::matrix(marks.to_vec())?.rows;
    let (base, marks) = match extra {
        Extra::Weft => (ground.inverted().rows, marks),
        Extra::Warp => (turned(&ground.rows), turned(&marks)),
    };
    if !marks.iter().flatten().any(|mark| *mark) || bind.is_some_and(|every| every < 2) {
        return Err(WeaveError::Empty);
    }
    let threads = common([base.len(), marks.len()].into_iter())?;
    let width = |rows: &[Vec<bool>]| rows.first().map_or(0, Vec::len);
    let across = common([width(&base), width(&marks)].into_iter())?;
    let mut rows = Vec::new();
    let mut figured = 0;
    for thread in 0..threads {
        let around = |row: &Vec<bool>| row.iter().copied().cycle().take(across).collect();
        rows.push(around(&base[thread % base.len()]));
        let row = &marks[thread % marks.len()];
        if row.iter().any(|mark| *mark) {
            let row: Vec<bool> = around(row);
            rows.push(match bind {
                Some(every) => bound(&row, every as usize, figured),
                None => row,
            });
            figured += 1;
        }
    }
    match extra {
        Extra::Weft => Ok(Weave::matrix(rows)?.inverted()),
        Extra::Warp => Weave::matrix(turned(&rows)),
    }
}

/// A row of a figure that dips under a thread after every so many, never at the ends of a float.
fn bound(row: &[bool], every: usize, number: usize) -> Vec<bool> {
    let set_off = number % 2 * (every / 2);
    let mut run = 0;
    let mut bound = row.to_vec();
    for at in 0..row.len() {
        run = if row[at] { run + 1 } else { 0 };
        let inside = run > 1 && row.get(at + 1) == Some(&true);
        if inside && (run + set_off).is_multiple_of(every) {
            bound[at] = false;
        }
    }
    bound
}

/// The least number that all of these divide, as far as a repeat may go.
fn common(numbers: impl Iterator<Item = usize>) -> Result<usize, WeaveError> {
    let mut all = 1;
    for number in numbers {
        if number == 0 {
            return Err(WeaveError::Empty);
        }
        all *= number / divisor(all, number);
        if all > Weave::LARGEST_REPEAT {
            return Err(WeaveError::TooLarge);
        }
    }
    Ok(all)
}

fn divisor(a: usize, b: usize) -> usize {
    if b == 0 { a } else { divisor(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::textile::drawdown::{Cloth, Drawdown};
    use crate::textile::layers::Layers;
    use crate::textile::yarn::Twist;

    /// Rows from the top, 1 = warp up.
    fn drawn(weave: &Weave) -> String {
        let row = |row: &Vec<bool>| row.iter().map(|&up| if up { '1' } else { '0' }).collect();
        weave.rows.iter().rev().map(row).collect::<Vec<String>>().join("/")
    }

    fn marks(rows: &[&str]) -> Vec<Vec<bool>> {
        rows.iter().rev().map(|row| row.chars().map(|c| c == '#').collect()).collect()
    }

    fn layers(weave: &Weave) -> usize {
        Layers::of(&Cloth::new(Drawdown::of_weave(weave))).parts.len()
    }

    #[test]
    fn blocks_of_a_profile_are_whole_repeats() {
        let satin = Weave::satin(5, 2).unwrap();
        let damask =
            profile(&[vec![0, 1], vec![1, 0]], &[satin.clone(), satin.inverted()]).unwrap();
        assert_eq!((damask.ends(), damask.picks()), (10, 10));
        assert_eq!(damask.warp_share(), 0.5);
        for (end, pick) in [(0, 0), (3, 2), (4, 4)] {
            assert_eq!(damask.warp_up(end, pick), satin.warp_up(end, pick));
            assert_eq!(damask.warp_up(end + 5, pick), !satin.warp_up(end, pick));
            assert_eq!(damask.warp_up(end + 5, pick + 5), satin.warp_up(end, pick));
        }
        // Weaves of two and three threads come out even at six.
        let twill = Weave::twill(&[2, 1], Twist::Z, 1).unwrap();
        let mixed = profile(&[vec![0, 1]], &[Weave::plain(), twill]).unwrap();
        assert_eq!((mixed.ends(), mixed.picks()), (12, 6));
        assert_eq!(profile(&[vec![2]], &[Weave::plain()]), Err(WeaveError::Empty));
        let broad = vec![vec![0; 3000]];
        assert_eq!(profile(&broad, &[Weave::plain()]), Err(WeaveError::TooLarge));
    }

    #[test]
    fn a_damask_is_cut_clean() {
        for satin in [(5, 2), (7, 3), (8, 3), (10, 7), (12, 5)] {
            let weaves = turned(&Weave::satin(satin.0, satin.1).unwrap());
            let n = satin.0 as usize;
            let damask = profile(&[vec![0, 1], vec![1, 0]], &weaves).unwrap();
            for at in 0..2 * n {
                for (edge, before) in [(0, 2 * n - 1), (n, n - 1)] {
                    assert_ne!(damask.warp_up(edge, at), damask.warp_up(before, at), "{satin:?}");
                    assert_ne!(damask.warp_up(at, edge), damask.warp_up(at, before), "{satin:?}");
                }
            }
            assert_eq!(damask.floats().warp_on_face, Some(n - 1));
        }
        // What is never the same upside down is turned all the same.
        let twill = Weave::matrix(vec![vec![true, true, false], vec![true, false, false]]).unwrap();
        assert_eq!(turned(&twill)[1].warp_share(), 1.0 - twill.warp_share());
    }

    #[test]
    fn a_double_cloth_is_two_until_it_is_stitched() {
        let plain = Weave::plain();
        let open = double(&plain, &plain, None).unwrap();
        assert_eq!(drawn(&open), "1011/0010/1110/1000");
        assert_eq!(layers(&open), 2);
        let tied = double(&plain, &plain, Some(4)).unwrap();
        assert_eq!((tied.ends(), tied.picks()), (4, 8));
        assert_eq!(layers(&tied), 1);
        // One crossing differs.
        assert_eq!(tied.warp_share() * 32.0, open.warp_share() * 32.0 + 1.0);
        assert_eq!(double(&plain, &plain, Some(0)), Err(WeaveError::Empty));
    }

    #[test]
    fn an_extra_weft_shows_where_its_figure_is() {
        let weave = figure(&Weave::plain(), &marks(&["....", ".##."]), Extra::Weft, None).unwrap();
        // Two ground picks; the figure's own pick follows the first, the empty row has none.
        assert_eq!(drawn(&weave), "0101/1001/1010");
        assert_eq!(layers(&weave), 1);
        let warp = figure(&Weave::plain(), &marks(&["#.", "#.", "..", ".."]), Extra::Warp, None);
        assert_eq!(drawn(&warp.unwrap()), "011/110/001/100");
        let none = figure(&Weave::plain(), &marks(&[".."]), Extra::Weft, None);
        assert_eq!(none, Err(WeaveError::Empty));
    }

    #[test]
    fn long_floats_of_a_figure_are_bound() {
        let long = vec![vec![true; 14], vec![true; 14]];
        let mut cells = long;
        for row in &mut cells {
            row.extend([false, false]);
        }
        let loose = figure(&Weave::plain(), &cells, Extra::Weft, None).unwrap();
        let tied = figure(&Weave::plain(), &cells, Extra::Weft, Some(4)).unwrap();
        let float = |weave: &Weave| weave.floats().weft_on_face;
        assert_eq!((float(&loose), float(&tied)), (Some(14), Some(4)));
    }
}
