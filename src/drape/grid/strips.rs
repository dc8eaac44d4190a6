//! What the elements of a row do to its knots and to those of the row above, gathered so that
//! every knot is written once.

use super::lanes::{F, LANES, V};
use super::layout::Row;
use pulp::Simd;

/// What the elements at some slots do.
pub struct Flow<S: Simd> {
    /// On the first ends of the weft edges; the opposite on their second ends.
    pub weft: V<S>,
    /// On the first ends of the warp edges.
    pub warp: V<S>,
    /// On the four corners of the cells, anticlockwise.
    pub corners: [V<S>; 4],
    /// Bending along the weft, on the outer knots; twice the opposite on the middle one.
    pub bend: V<S>,
}

/// How elements answer to the state of the knots.
pub trait Law<S: Simd> {
    /// What the elements at the slots from `at` on do.
    fn flow(&mut self, s: S, row: usize, at: usize, stride: usize) -> Flow<S>;
    /// The same for bending along the warp.
    fn bend(&self, s: S, at: usize, stride: usize) -> V<S>;
    /// Takes the sum for the slots from `at` on.
    fn take(&mut self, s: S, at: usize, sum: V<S>);
}

/// Three lists of numbers along a row, with a margin before.
type Strip = [Vec<f32>; 3];

/// Working space of a pass over rows.
#[derive(Clone, Debug, Default)]
pub struct Strips {
    /// What the elements at a slot do to its own knot.
    own: Strip,
    /// What they do to the knot on the right.
    right: Strip,
    bend: Strip,
    /// What those of this row and of the one below, by turns, do to the knot above and to the
    /// one to the right of that.
    above: [[Strip; 2]; 2],
    /// Bending along the warp of three rows, by turns.
    rising: [Strip; 3],
}

fn fit(strip: &mut Strip, stride: usize) {
    for list in strip {
        list.clear();
        list.resize(stride + 2 * LANES, 0.0);
    }
}

fn read(strip: &Strip) -> [&[f32]; 3] {
    [&strip[0], &strip[1], &strip[2]]
}

impl Strips {
    fn fit(&mut self, stride: usize) {
        for strip in [&mut self.own, &mut self.right, &mut self.bend] {
            fit(strip, stride);
        }
        self.above.iter_mut().flatten().for_each(|s| fit(s, stride));
        self.rising.iter_mut().for_each(|s| fit(s, stride));
    }

    /// Goes over the rows `range` of `rows` and hands each slot's sum to the law.
    #[inline(always)]
    pub fn pass<S: Simd, L: Law<S>>(
        &mut self,
        s: S,
        rows: &[Row],
        range: std::ops::Range<usize>,
        law: &mut L,
    ) {
        let two = F::splat(s, 2.0);
        let mut begun = false;
        for r in range {
            let row = rows[r];
            let stride = row.stride;
            if row.first || !begun {
                self.fit(stride);
                if !row.first {
                    // The row below belongs to another thread; what it sends up is worked out anew.
                    self.fill(s, r - 1, rows[r - 1], law);
                    self.rise(s, r - 1, rows[r - 1], law);
                }
                self.rise(s, r, row, law);
                begun = true;
            }
            self.fill(s, r, row, law);
            match rows.get(r + 1) {
                Some(next) if !next.first => self.rise(s, r + 1, *next, law),
                _ => fit(&mut self.rising[(r + 1) % 3], stride),
            }
            let below = &self.above[(r + 1) % 2];
            for column in (0..stride).step_by(F::<S>::COUNT) {
                let here = LANES + column;
                let left = here - 1;
                let load = |strip: &Strip, at: usize| V::load(s, read(strip), at);
                let sum = load(&self.own, here)
                    + load(&self.right, left)
                    + (load(&below[0], here) + load(&below[1], left))
                    + (load(&self.bend, left) + load(&self.bend, here + 1))
                    + (load(&self.rising[(r + 2) % 3], here)
                        + load(&self.rising[(r + 1) % 3], here));
                let middle = load(&self.bend, here) + load(&self.rising[r % 3], here);
                law.take(s, row.base + column, middle.fnma(two, sum));
            }
        }
    }

    #[inline(always)]
    fn fill<S: Simd, L: Law<S>>(&mut self, s: S, r: usize, row: Row, law: &mut L) {
        let above = &mut self.above[r % 2];
        for column in (0..row.stride).step_by(F::<S>::COUNT) {
            let here = LANES + column;
            let flow = law.flow(s, r, row.base + column, row.stride);
            let [lower_left, lower_right, upper_right, upper_left] = flow.corners;
            (flow.weft + flow.warp + lower_left).store(&mut self.own, here);
            (lower_right - flow.weft).store(&mut self.right, here);
            (upper_left - flow.warp).store(&mut above[0], here);
            upper_right.store(&mut above[1], here);
            flow.bend.store(&mut self.bend, here);
        }
    }

    #[inline(always)]
    fn rise<S: Simd, L: Law<S>>(&mut self, s: S, r: usize, row: Row, law: &mut L) {
        for column in (0..row.stride).step_by(F::<S>::COUNT) {
            let bend = law.bend(s, row.base + column, row.stride);
            bend.store(&mut self.rising[r % 3], LANES + column);
        }
    }
}
