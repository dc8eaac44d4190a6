//! The sparse part of the matrix of an implicit step: 3 × 3 blocks, one row a knot, in single
//! precision.
//!
//! Every row stores all its neighbours (both halves of the symmetric matrix), so that a product
//! is a map over rows and comes out the same for any number of threads.
//!
//! Cloth is a million times stiffer against stretching than its inertia against being moved as a
//! whole, more than single precision can hold in one number. Forces inside the cloth do not
//! change when all of it moves, so what a block off the diagonal does to a knot depends on the
//! difference of two movements only; products are taken in that form, and inertia, contact and
//! holds, each knot's own, are kept elsewhere.

use nalgebra::{Matrix3, Vector3};
use rayon::prelude::*;

/// A 3-vector in four lanes; the last is zero.
pub type Lane = [f32; 4];

/// A 3 × 3 block by columns, each in four lanes.
pub type Block = [Lane; 3];

/// Rows worked on by one task at a time.
pub const ROWS: usize = 2048;

/// Which blocks off the diagonal can differ from zero.
#[derive(Clone, Debug, Default)]
pub struct Pattern {
    /// First neighbour of each row, and one past the last row's.
    start: Vec<u32>,
    /// Neighbours of each row, ascending.
    column: Vec<u32>,
}

impl Pattern {
    /// The pattern of `n` rows in which the two of each pair are neighbours.
    pub fn new(n: usize, pairs: impl Iterator<Item = [u32; 2]>) -> Self {
        let mut both: Vec<[u32; 2]> =
            pairs.filter(|[a, b]| a != b).flat_map(|[a, b]| [[a, b], [b, a]]).collect();
        both.par_sort_unstable();
        both.dedup();
        let mut start = vec![0u32; n + 1];
        for [a, _] in &both {
            start[*a as usize + 1] += 1;
        }
        for i in 0..n {
            start[i + 1] += start[i];
        }
        Pattern { start, column: both.into_iter().map(|[_, b]| b).collect() }
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.start.len().saturating_sub(1)
    }

    /// Number of blocks off the diagonal.
    pub fn blocks(&self) -> usize {
        self.column.len()
    }

    /// Places of row `i`'s blocks.
    pub fn row(&self, i: usize) -> std::ops::Range<usize> {
        self.start[i] as usize..self.start[i + 1] as usize
    }

    /// Neighbours, in the order of the blocks.
    pub fn columns(&self) -> &[u32] {
        &self.column
    }

    /// Place of block (i, j). Pairs outside the pattern, and `i = j`, have none.
    pub fn slot(&self, i: u32, j: u32) -> Option<u32> {
        let row = self.row(i as usize);
        let found = self.column[row.clone()].binary_search(&j).ok()?;
        u32::try_from(row.start + found).ok()
    }
}

/// A symmetric matrix of 3 × 3 blocks.
#[derive(Clone, Debug, Default)]
pub struct Matrix {
    /// Where the blocks stand.
    pub pattern: Pattern,
    /// Blocks of the diagonal: the opposite of all others of the row. Set by [`Matrix::close`].
    pub diagonal: Vec<Block>,
    /// Other blocks, in the order of the pattern.
    pub off: Vec<Block>,
}

impl Matrix {
    /// A zero matrix of the given pattern.
    pub fn new(pattern: Pattern) -> Self {
        let (n, m) = (pattern.rows(), pattern.blocks());
        let zero = [[0.0; 4]; 3];
        Matrix { pattern, diagonal: vec![zero; n], off: vec![zero; m] }
    }

    /// Sets the diagonal from the other blocks.
    pub fn close(&mut self) {
        let (pattern, off) = (&self.pattern, &self.off);
        self.diagonal.par_iter_mut().enumerate().with_min_len(ROWS).for_each(|(i, diagonal)| {
            let mut sum = [[0.0; 4]; 3];
            for block in &off[pattern.row(i)] {
                for (s, b) in sum.iter_mut().zip(block) {
                    for l in 0..4 {
                        s[l] -= b[l];
                    }
                }
            }
            // Rounding may leave the two halves of the block unequal.
            for r in 0..3 {
                for c in 0..r {
                    let mean = 0.5 * (sum[c][r] + sum[r][c]);
                    (sum[c][r], sum[r][c]) = (mean, mean);
                }
            }
            *diagonal = sum;
        });
    }

    /// `y = A x` for the part of A that feels differences only.
    pub fn multiply(&self, x: &[Lane], y: &mut [Lane]) {
        let row = |i: usize, y: &mut Lane| {
            let here = x[i];
            let mut sum = [0.0; 4];
            let range = self.pattern.row(i);
            for (block, &j) in self.off[range.clone()].iter().zip(&self.pattern.column[range]) {
                let v = &x[j as usize];
                let v = [v[0] - here[0], v[1] - here[1], v[2] - here[2]];
                for l in 0..4 {
                    sum[l] += block[0][l] * v[0] + block[1][l] * v[1] + block[2][l] * v[2];
                }
            }
            *y = sum;
        };
        y.par_chunks_mut(ROWS).enumerate().for_each(|(c, part)| {
            for (k, y) in part.iter_mut().enumerate() {
                row(c * ROWS + k, y);
            }
        });
    }
}

/// Block times vector.
#[inline]
pub fn apply(block: &Block, v: &Lane) -> Lane {
    let mut sum = [0.0; 4];
    for l in 0..4 {
        sum[l] = block[0][l] * v[0] + block[1][l] * v[1] + block[2][l] * v[2];
    }
    sum
}

/// Transposed block times vector.
#[inline]
pub fn apply_transposed(block: &Block, v: &Lane) -> Lane {
    let dot = |c: &Lane| c[0] * v[0] + c[1] * v[1] + c[2] * v[2];
    [dot(&block[0]), dot(&block[1]), dot(&block[2]), 0.0]
}

/// Adds a matrix to a block.
#[inline]
#[allow(clippy::cast_possible_truncation)]
pub fn add(block: &mut Block, m: &Matrix3<f64>) {
    for (c, column) in block.iter_mut().enumerate() {
        for r in 0..3 {
            column[r] += m[(r, c)] as f32;
        }
    }
}

/// Adds a multiple of the identity to a block.
#[inline]
#[allow(clippy::cast_possible_truncation)]
pub fn add_scalar(block: &mut Block, s: f64) {
    for (c, column) in block.iter_mut().enumerate() {
        column[c] += s as f32;
    }
}

/// A vector in lanes.
#[inline]
#[allow(clippy::cast_possible_truncation)]
pub fn lane(v: &Vector3<f64>) -> Lane {
    [v.x as f32, v.y as f32, v.z as f32, 0.0]
}

/// The vector of a lane.
#[inline]
pub fn vector(l: &Lane) -> Vector3<f64> {
    Vector3::new(f64::from(l[0]), f64::from(l[1]), f64::from(l[2]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_product_sees_both_halves() {
        let pattern = Pattern::new(3, [[0, 1], [2, 1], [1, 0]].into_iter());
        assert_eq!(pattern.blocks(), 4);
        assert_eq!(pattern.slot(0, 2), None);
        let mut a = Matrix::new(pattern);
        for b in &mut a.off {
            add_scalar(b, -1.0);
        }
        a.close();
        assert_eq!(a.diagonal.iter().map(|d| d[0][0]).collect::<Vec<_>>(), [1.0, 2.0, 1.0]);
        let x = [[1.0, 0.0, 2.0, 0.0], [3.0, 1.0, 0.0, 0.0], [5.0, 0.0, 0.0, 0.0]];
        let mut y = [[0.0; 4]; 3];
        a.multiply(&x, &mut y);
        assert_eq!(y, [[-2.0, -1.0, 2.0, 0.0], [0.0, 2.0, -2.0, 0.0], [2.0, -1.0, 0.0, 0.0]]);
    }
}
