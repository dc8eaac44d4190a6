//! The preconditioner: incomplete block Cholesky without fill, over fixed runs of knots.
//!
//! Knots are numbered along the threads, so that the factor carries each thread's stiffness
//! exactly as far as its own run goes. Runs are cut by the number of knots alone and each is
//! factored and solved apart from the others, so that the answer does not depend on threads.
//!
//! # References
//! Meijerink and van der Vorst 1977; block form as in Saad 2003, section 10.3.

use super::matrix::{Block, Lane, Matrix, apply, apply_transposed};
use rayon::prelude::*;

/// A factor `(W + D) D⁻¹ (W + D)ᵀ` of the matrix, W strictly lower.
#[derive(Clone, Debug, Default)]
pub struct Factor {
    runs: Vec<Run>,
    length: usize,
}

/// The factor of one run of knots.
#[derive(Clone, Debug, Default)]
struct Run {
    first: usize,
    /// First lower block of each row, and one past the last row's.
    start: Vec<u32>,
    /// Columns within the run.
    column: Vec<u32>,
    /// Where each lower block stands in the matrix.
    slot: Vec<u32>,
    lower: Vec<Block>,
    inverse: Vec<Block>,
    /// Working space of a solve.
    carried: Vec<Lane>,
}

impl Factor {
    /// Lays out the runs of a matrix's pattern; no numbers yet.
    pub fn new(matrix: &Matrix) -> Self {
        let n = matrix.pattern.rows();
        let length = n.div_ceil(4).max(2048);
        let runs = (0..n.div_ceil(length))
            .map(|r| {
                let first = r * length;
                let last = (first + length).min(n);
                let mut run = Run { first, start: vec![0], ..Run::default() };
                for i in first..last {
                    for slot in matrix.pattern.row(i) {
                        let j = matrix.pattern.columns()[slot] as usize;
                        if j >= first && j < i {
                            run.column.push((j - first) as u32);
                            run.slot.push(slot as u32);
                        }
                    }
                    run.start.push(run.column.len() as u32);
                }
                run.lower = vec![[[0.0; 4]; 3]; run.column.len()];
                run.inverse = vec![[[0.0; 4]; 3]; last - first];
                run.carried = vec![[0.0; 4]; last - first];
                run
            })
            .collect();
        Factor { runs, length }
    }

    /// Factors the matrix anew.
    pub fn refresh(&mut self, matrix: &Matrix) {
        self.runs.par_iter_mut().for_each(|run| run.factor(matrix));
    }

    /// `z = M⁻¹ r`.
    pub fn solve(&mut self, r: &[Lane], z: &mut [Lane]) {
        self.runs
            .par_iter_mut()
            .zip(z.par_chunks_mut(self.length.max(1)))
            .zip(r.par_chunks(self.length.max(1)))
            .for_each(|((run, z), r)| run.solve(r, z));
    }
}

impl Run {
    fn factor(&mut self, matrix: &Matrix) {
        for i in 0..self.inverse.len() {
            let (begin, end) = (self.start[i] as usize, self.start[i + 1] as usize);
            let own = &matrix.diagonal[self.first + i];
            let mut pivot = *own;
            for e in begin..end {
                let j = self.column[e] as usize;
                let mut w = matrix.off[self.slot[e] as usize];
                let (mut a, mut b) = (begin, self.start[j] as usize);
                let stop = self.start[j + 1] as usize;
                while a < e && b < stop {
                    let (ka, kb) = (self.column[a], self.column[b]);
                    if ka == kb {
                        let scaled = product(&self.lower[a], &self.inverse[ka as usize]);
                        subtract_by_transposed(&mut w, &scaled, &self.lower[b]);
                    }
                    a += usize::from(ka <= kb);
                    b += usize::from(kb <= ka);
                }
                self.lower[e] = w;
                let scaled = product(&w, &self.inverse[j]);
                subtract_by_transposed(&mut pivot, &scaled, &w);
            }
            // Pivots that leaving out the fill has made too small would spoil the whole run; the
            // matrix's own block keeps the factor positive.
            let firm = decompose(own).map(|own| own.pivots.map(|p| FIRM * p));
            self.inverse[i] = decompose(&pivot)
                .filter(|d| firm.is_some_and(|f| (0..3).all(|k| d.pivots[k] > f[k])))
                .or_else(|| decompose(own))
                .map_or([[0.0; 4]; 3], |d| d.inverse());
        }
    }

    fn solve(&mut self, r: &[Lane], z: &mut [Lane]) {
        let n = self.inverse.len();
        for i in 0..n {
            let mut y = r[i];
            let range = self.start[i] as usize..self.start[i + 1] as usize;
            for (w, &j) in self.lower[range.clone()].iter().zip(&self.column[range]) {
                let p = apply(w, &z[j as usize]);
                for l in 0..4 {
                    y[l] -= p[l];
                }
            }
            z[i] = apply(&self.inverse[i], &y);
        }
        self.carried.fill([0.0; 4]);
        for i in (0..n).rev() {
            let p = apply(&self.inverse[i], &self.carried[i]);
            for l in 0..4 {
                z[i][l] -= p[l];
            }
            let x = z[i];
            let range = self.start[i] as usize..self.start[i + 1] as usize;
            for (w, &j) in self.lower[range.clone()].iter().zip(&self.column[range]) {
                let p = apply_transposed(w, &x);
                let c = &mut self.carried[j as usize];
                for l in 0..4 {
                    c[l] += p[l];
                }
            }
        }
    }
}

#[inline]
fn product(a: &Block, b: &Block) -> Block {
    [apply(a, &b[0]), apply(a, &b[1]), apply(a, &b[2])]
}

/// `w −= a bᵀ`.
#[inline]
fn subtract_by_transposed(w: &mut Block, a: &Block, b: &Block) {
    for (c, column) in w.iter_mut().enumerate() {
        for l in 0..4 {
            column[l] -= a[0][l] * b[0][c] + a[1][l] * b[1][c] + a[2][l] * b[2][c];
        }
    }
}

/// Least share of a pivot of the matrix's own block that the factor may leave of it.
const FIRM: f32 = 0.02;

/// `L D Lᵀ` of a symmetric block, L = [1; b 1; c e 1].
#[derive(Clone, Copy)]
struct Decomposed {
    pivots: [f32; 3],
    b: f32,
    c: f32,
    e: f32,
}

/// The decomposition of a positive block; nothing for others.
fn decompose(m: &Block) -> Option<Decomposed> {
    let first = m[0][0];
    let (b, c) = (m[0][1] / first, m[0][2] / first);
    let second = m[1][1] - b * m[0][1];
    let rest = m[1][2] - b * m[0][2];
    let e = rest / second;
    let third = m[2][2] - c * m[0][2] - e * rest;
    let pivots = [first, second, third];
    pivots.iter().all(|p| *p > 0.0 && p.is_finite()).then_some(Decomposed { pivots, b, c, e })
}

impl Decomposed {
    fn inverse(self) -> Block {
        let (m10, m21, m20) = (-self.b, -self.e, self.b * self.e - self.c);
        let [p, q, r] = self.pivots.map(|p| 1.0 / p);
        let i00 = p + m10 * m10 * q + m20 * m20 * r;
        let i10 = m10 * q + m20 * m21 * r;
        let i20 = m20 * r;
        let i11 = q + m21 * m21 * r;
        let i21 = m21 * r;
        [[i00, i10, i20, 0.0], [i10, i11, i21, 0.0], [i20, i21, r, 0.0]]
    }
}

#[cfg(test)]
mod tests {
    use super::super::matrix::{Pattern, add_scalar};
    use super::*;

    /// On one thread of knots nothing is left out, so the factor is the matrix itself.
    #[test]
    fn a_single_thread_is_solved_exactly() {
        let n = 40u32;
        let mut a = Matrix::new(Pattern::new(n as usize, (1..n).map(|i| [i - 1, i])));
        for b in &mut a.off {
            add_scalar(b, -1.0);
        }
        a.close();
        let own = [[0.5, 0.1, 0.0, 0.0], [0.1, 0.5, 0.0, 0.0], [0.0, 0.0, 0.5, 0.0]];
        for d in &mut a.diagonal {
            for (column, own) in d.iter_mut().zip(own) {
                for l in 0..3 {
                    column[l] += own[l];
                }
            }
        }
        let x: Vec<Lane> = (0..n).map(|i| [i as f32 * 0.1, 1.0, (i % 3) as f32, 0.0]).collect();
        let mut r = vec![[0.0; 4]; n as usize];
        a.multiply(&x, &mut r);
        for (r, x) in r.iter_mut().zip(&x) {
            let own = apply(&own, x);
            for l in 0..3 {
                r[l] += own[l];
            }
        }
        let mut factor = Factor::new(&a);
        factor.refresh(&a);
        let mut z = vec![[0.0; 4]; n as usize];
        factor.solve(&r, &mut z);
        for (x, z) in x.iter().zip(&z) {
            for l in 0..3 {
                assert!((x[l] - z[l]).abs() < 1e-3, "{x:?} {z:?}");
            }
        }
    }
}
