//! Seams still open: which cloth is to come together, and may touch meanwhile.

use super::super::sewing::Stitch;
use super::super::weld::Weld;

/// The knots of open seams.
#[derive(Clone, Debug, Default)]
pub struct Open {
    /// For each knot the point that it will be part of, if it is on an open seam.
    point: Vec<Option<u32>>,
    /// The seams that end in each point, in order, each with how far along it the point lies, m.
    seams: Vec<Vec<(u32, f64)>>,
    /// Farthest way along a seam between cloth that may touch, m.
    pub room: f64,
}

impl Open {
    /// Takes up the stitches of all seams that are open, of a cloth of `knots` knots.
    pub fn new(knots: usize, stitches: &[Stitch]) -> Self {
        let closed = Weld::new(knots, stitches.iter().map(|s| s.knots));
        let mut seams: Vec<Vec<(u32, f64)>> =
            vec![Vec::new(); if stitches.is_empty() { 0 } else { closed.count }];
        let mut point = vec![None; knots];
        let (mut seam, mut along) = (usize::MAX, 0.0);
        for stitch in stitches {
            if stitch.seam != seam {
                (seam, along) = (stitch.seam, 0.0);
            }
            along += stitch.length;
            for knot in stitch.knots {
                let p = closed.knot[knot as usize];
                point[knot as usize] = Some(p);
                seams[p as usize].push((stitch.seam as u32, along));
            }
        }
        for of in &mut seams {
            of.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
            of.dedup();
        }
        Open { point, seams, room: 0.0 }
    }

    /// Whether two features have knots that will be points of one seam, no farther from each other
    /// than its room.
    pub fn meet(&self, first: &[u32], second: &[u32]) -> bool {
        if self.seams.is_empty() {
            return false;
        }
        let points = |knots: &[u32]| knots.iter().filter_map(|k| self.point[*k as usize]).next();
        if points(first).is_none() || points(second).is_none() {
            return false;
        }
        let of = |k: &u32| self.point[*k as usize].map(|p| &self.seams[p as usize]);
        let share = |a: &Vec<(u32, f64)>, b: &Vec<(u32, f64)>| {
            a.iter().any(|s| b.iter().any(|t| s.0 == t.0 && (s.1 - t.1).abs() <= self.room))
        };
        first.iter().filter_map(of).any(|a| second.iter().filter_map(of).any(|b| share(a, b)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Where four corners meet at a fork, all may touch; a knot further along one seam and one
    /// further along another may not.
    #[test]
    fn only_cloth_of_one_seam_may_touch() {
        let stitch = |a, b, seam| Stitch {
            knots: [a, b],
            length: 0.01,
            seam,
            slots: [0; 2],
            sets_in: false,
        };
        // Seams 0 (0-1, 2-3) and 1 (4-5, 6-7), joined at their ends by seam 2 (2-4).
        let stitches = [stitch(0, 1, 0), stitch(2, 3, 0), stitch(4, 5, 1), stitch(6, 7, 1)];
        let mut open = Open::new(9, &[&stitches[..], &[stitch(2, 4, 2)]].concat());
        assert!(open.meet(&[0], &[1]), "of one stitch");
        assert!(open.meet(&[3], &[5]), "corners of one point");
        assert!(open.meet(&[8, 0], &[1, 8]), "a feature of several knots");
        assert!(!open.meet(&[0], &[2]), "of two stitches");
        assert!(!open.meet(&[0], &[6]), "of two seams");
        assert!(!open.meet(&[8], &[8]), "of none");
        open.room = 0.015;
        assert!(open.meet(&[0], &[2]), "of stitches near each other");
    }
}
