//! Stretches of the plane sorted into square boxes, so that those near a place are found
//! without asking all of them.

use super::polygon::Place;

/// Rows and columns of boxes are counted from the lower left; no more than this many of each.
const MOST_BOXES: f64 = 4096.0;

/// Straight stretches in boxes.
#[derive(Clone, Debug)]
pub struct Nearby {
    origin: Place,
    side: f64,
    count: [i64; 2],
    /// (column, number of the stretch), row after row, sorted in each row.
    entries: Vec<(u32, u32)>,
    /// Where each row begins in the entries, and where the last one ends.
    rows: Vec<u32>,
}

impl Nearby {
    /// Sorts the stretches, given by their ends (m), into boxes about as large as they are.
    /// Stretches that are not finite are left out.
    pub fn new(stretches: &[(Place, Place)]) -> Self {
        let finite = |place: Place| place.iter().all(|x| x.is_finite());
        let (mut low, mut high, mut length) = ([f64::MAX; 2], [f64::MIN; 2], 0.0);
        for &(a, b) in stretches.iter().filter(|&&(a, b)| finite(a) && finite(b)) {
            for axis in 0..2 {
                low[axis] = low[axis].min(a[axis]).min(b[axis]);
                high[axis] = high[axis].max(a[axis]).max(b[axis]);
            }
            length += super::polygon::distance(a, b);
        }
        let mut found = Nearby {
            origin: [0.0; 2],
            side: 1.0,
            count: [0; 2],
            entries: Vec::new(),
            rows: Vec::new(),
        };
        if low[0] > high[0] {
            return found;
        }
        let widest = (high[0] - low[0]).max(high[1] - low[1]);
        let mean = length / stretches.len() as f64;
        let side = mean.max(widest / MOST_BOXES).max(f64::MIN_POSITIVE);
        let boxes = |axis: usize| ((high[axis] - low[axis]) / side) as i64 + 1;
        (found.origin, found.side, found.count) = (low, side, [boxes(0), boxes(1)]);
        let mut entered: Vec<(u32, u32, u32)> = Vec::with_capacity(2 * stretches.len());
        for (number, &(a, b)) in stretches.iter().enumerate() {
            if finite(a) && finite(b) {
                found.boxes_of((a, b), |row, column| entered.push((row, column, number as u32)));
            }
        }
        found.sort(&entered);
        found
    }

    /// Puts what was entered, by row, column and number, in order.
    fn sort(&mut self, entered: &[(u32, u32, u32)]) {
        let mut next = vec![0_u32; self.count[1] as usize + 1];
        for &(row, ..) in entered {
            next[row as usize + 1] += 1;
        }
        for row in 1..next.len() {
            next[row] += next[row - 1];
        }
        self.rows = next.clone();
        self.entries = vec![(0, 0); entered.len()];
        for &(row, column, number) in entered {
            self.entries[next[row as usize] as usize] = (column, number);
            next[row as usize] += 1;
        }
        for row in self.rows.windows(2) {
            self.entries[row[0] as usize..row[1] as usize].sort_unstable();
        }
    }

    fn place_in_boxes(&self, x: f64, axis: usize) -> i64 {
        let at = ((x - self.origin[axis]) / self.side) as i64;
        at.clamp(0, (self.count[axis] - 1).max(0))
    }

    /// Gives the rows and columns of the boxes in which a stretch lies.
    fn boxes_of(&self, (a, b): (Place, Place), mut give: impl FnMut(u32, u32)) {
        let (lower, upper) = if a[1] <= b[1] { (a, b) } else { (b, a) };
        let rise = upper[1] - lower[1];
        for row in self.place_in_boxes(lower[1], 1)..=self.place_in_boxes(upper[1], 1) {
            // The part of the stretch within this row, a little widened against rounding.
            let at = |y: f64| {
                if rise > 0.0 { ((y - lower[1]) / rise).clamp(0.0, 1.0) } else { 0.0 }
            };
            let bottom = self.origin[1] + row as f64 * self.side;
            let (from, mut to) = (at(bottom), at(bottom + self.side));
            if rise <= 0.0 {
                to = 1.0;
            }
            let x = |share: f64| lower[0] + share * (upper[0] - lower[0]);
            let slack = self.side * 1e-6;
            let (left, right) = (x(from).min(x(to)) - slack, x(from).max(x(to)) + slack);
            for column in self.place_in_boxes(left, 0)..=self.place_in_boxes(right, 0) {
                give(row as u32, column as u32);
            }
        }
    }

    /// Puts into `found` the numbers of all stretches that may come within `reach` (m) of the
    /// stretch `a b`, ascending; some of them may be further away.
    pub fn around(&self, (a, b): (Place, Place), reach: f64, found: &mut Vec<u32>) {
        found.clear();
        let reach = reach + self.side * 1e-6;
        let range = |axis: usize| {
            let (low, high) = (a[axis].min(b[axis]) - reach, a[axis].max(b[axis]) + reach);
            (self.place_in_boxes(low, axis), self.place_in_boxes(high, axis))
        };
        if self.entries.is_empty() {
            return;
        }
        let ((left, right), (bottom, top)) = (range(0), range(1));
        let (left, right) = (left as u32, right as u32);
        for row in self.rows[bottom as usize..=top as usize + 1].windows(2) {
            let row = &self.entries[row[0] as usize..row[1] as usize];
            // A row holds few entries, unless a line runs along it.
            let start = if row.len() > 16 {
                row.partition_point(|entry| entry.0 < left)
            } else {
                row.iter().take_while(|entry| entry.0 < left).count()
            };
            let within = row[start..].iter().take_while(|entry| entry.0 <= right);
            found.extend(within.map(|entry| entry.1));
        }
        found.sort_unstable();
        found.dedup();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::polygon::distance_to_side;
    use proptest::prelude::*;

    proptest! {
        /// Whatever lies within reach is found.
        #[test]
        fn none_is_missed(
            ends in prop::collection::vec((-2.0..2.0f64, -2.0..2.0f64), 2..60),
            probe in (-2.5..2.5f64, -2.5..2.5f64),
            reach in 0.0..0.5f64,
        ) {
            let stretches: Vec<_> =
                ends.windows(2).map(|w| ([w[0].0, w[0].1], [w[1].0, w[1].1])).collect();
            let at = [probe.0, probe.1];
            let mut found = Vec::new();
            Nearby::new(&stretches).around((at, at), reach, &mut found);
            for (number, &(a, b)) in stretches.iter().enumerate() {
                if distance_to_side(at, a, b) <= reach {
                    prop_assert!(found.contains(&(number as u32)));
                }
            }
        }
    }
}
