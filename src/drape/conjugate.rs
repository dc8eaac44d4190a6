//! Preconditioned conjugate gradients (Hestenes and Stiefel 1952) with held knots.

use super::matrix::{Lane, Matrix};
use super::precondition::Factor;
use rayon::prelude::*;

/// A symmetric term outside the pattern of the matrix, such as the contact of two layers.
pub trait Extra: Sync {
    /// `y += E x`.
    fn multiply(&self, x: &[Lane], y: &mut [Lane]);
}

impl Extra for () {
    fn multiply(&self, _x: &[Lane], _y: &mut [Lane]) {}
}

/// When to stop.
#[derive(Clone, Copy, Debug)]
pub struct Aim {
    /// Share of the first residual, in the preconditioned norm.
    pub tolerance: f64,
    /// Most iterations.
    pub most: usize,
}

/// Working space.
#[derive(Clone, Debug, Default)]
pub struct Space {
    r: Vec<Lane>,
    z: Vec<Lane>,
    p: Vec<Lane>,
    q: Vec<Lane>,
}

/// Numbers that are summed together; sums of such runs are added in order.
const RUN: usize = 1024;

/// The scalar product, the same for any number of threads.
pub fn dot(a: &[Lane], b: &[Lane]) -> f64 {
    let parts: Vec<f64> = a
        .par_chunks(RUN)
        .zip(b.par_chunks(RUN))
        .map(|(a, b)| {
            let mut sum = [0.0f64; 3];
            for (a, b) in a.iter().zip(b) {
                for l in 0..3 {
                    sum[l] += f64::from(a[l]) * f64::from(b[l]);
                }
            }
            sum[0] + sum[1] + sum[2]
        })
        .collect();
    parts.iter().sum()
}

#[allow(clippy::cast_possible_truncation)]
fn axpy(a: f64, x: &[Lane], y: &mut [Lane]) {
    let a = a as f32;
    y.par_chunks_mut(RUN).zip(x.par_chunks(RUN)).for_each(|(y, x)| {
        for (y, x) in y.iter_mut().zip(x) {
            for l in 0..4 {
                y[l] += a * x[l];
            }
        }
    });
}

/// A residual this small against the right-hand side is noise of single precision.
const NOISE: f64 = 1e-6;

/// Solves `(A + E) x = b` for the knots that are not `held`; those keep x = 0. Begins from the
/// given x, moved along `way` as far as is best; the better that is, the more exact the answer,
/// since the aim is a share of the first residual. Gives the number of iterations.
pub fn solve<E: Extra>(
    matrix: &Matrix,
    extra: &E,
    factor: &mut Factor,
    held: &[bool],
    b: &[Lane],
    way: &[Lane],
    x: &mut [Lane],
    space: &mut Space,
    aim: Aim,
) -> usize {
    let n = b.len();
    for v in [&mut space.r, &mut space.z, &mut space.p, &mut space.q] {
        v.resize(n, [0.0; 4]);
    }
    let Space { r, z, p, q } = space;
    let mask = |v: &mut [Lane]| {
        for (v, &h) in v.iter_mut().zip(held) {
            if h {
                *v = [0.0; 4];
            }
        }
    };
    mask(x);
    r.copy_from_slice(b);
    mask(r);
    factor.solve(r, z);
    mask(z);
    let whole = dot(r, z);
    matrix.multiply(x, q);
    extra.multiply(x, q);
    mask(q);
    axpy(-1.0, q, r);
    p.copy_from_slice(way);
    mask(p);
    matrix.multiply(p, q);
    extra.multiply(p, q);
    mask(q);
    let stiff = dot(p, q);
    if stiff > 0.0 {
        let far = (dot(p, r) / stiff).clamp(0.0, 1.0);
        axpy(far, p, x);
        axpy(-far, q, r);
    }
    factor.solve(r, z);
    mask(z);
    p.copy_from_slice(z);
    let mut rz = dot(r, z);
    let goal = (rz * aim.tolerance * aim.tolerance).max(whole * NOISE * NOISE);
    for step in 0..aim.most {
        if !(rz > goal) || rz <= 0.0 {
            return step;
        }
        matrix.multiply(p, q);
        extra.multiply(p, q);
        mask(q);
        let pq = dot(p, q);
        if !(pq > 0.0) {
            return step;
        }
        let alpha = rz / pq;
        axpy(alpha, p, x);
        axpy(-alpha, q, r);
        factor.solve(r, z);
        mask(z);
        let next = dot(r, z);
        let beta = next / rz;
        rz = next;
        #[allow(clippy::cast_possible_truncation)]
        let beta = beta as f32;
        p.par_chunks_mut(RUN).zip(z.par_chunks(RUN)).for_each(|(p, z)| {
            for (p, z) in p.iter_mut().zip(z) {
                for l in 0..4 {
                    p[l] = z[l] + beta * p[l];
                }
            }
        });
    }
    aim.most
}
