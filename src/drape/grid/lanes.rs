//! Numbers taken several at a time, as wide as the processor allows.
//!
//! Every operation acts on each number apart and rounds as its single form does, so a result does not
//! depend on how many are taken at a time. Which instructions are used is found out at run time.

use pulp::Simd;
use std::ops::{Add, Mul, Neg, Sub};

/// Rows are padded to a multiple of this many numbers; no processor takes more at a time.
pub const LANES: usize = 16;

/// Several single-precision numbers.
#[derive(Clone, Copy)]
pub struct F<S: Simd>(S, S::f32s);

impl<S: Simd> F<S> {
    /// How many.
    pub const COUNT: usize = S::F32_LANES;

    /// The same number several times.
    #[inline(always)]
    pub fn splat(s: S, value: f32) -> Self {
        F(s, s.splat_f32s(value))
    }

    /// The numbers from place `at` on.
    #[inline(always)]
    pub fn load(s: S, from: &[f32], at: usize) -> Self {
        F(s, S::as_simd_f32s(&from[at..at + Self::COUNT]).0[0])
    }

    /// Writes the numbers from place `at` on.
    #[inline(always)]
    pub fn store(self, to: &mut [f32], at: usize) {
        S::as_mut_simd_f32s(&mut to[at..at + Self::COUNT]).0[0] = self.1;
    }

    /// `self · b + c`, rounded once.
    #[inline(always)]
    pub fn fma(self, b: Self, c: Self) -> Self {
        F(self.0, self.0.mul_add_f32s(self.1, b.1, c.1))
    }

    /// `c − self · b`, rounded once.
    #[inline(always)]
    pub fn fnma(self, b: Self, c: Self) -> Self {
        F(self.0, self.0.negate_mul_add_f32s(self.1, b.1, c.1))
    }

    /// Quotient.
    #[inline(always)]
    pub fn over(self, b: Self) -> Self {
        F(self.0, self.0.div_f32s(self.1, b.1))
    }

    /// Square root.
    #[inline(always)]
    pub fn sqrt(self) -> Self {
        F(self.0, self.0.sqrt_f32s(self.1))
    }

    /// The larger.
    #[inline(always)]
    pub fn max(self, b: Self) -> Self {
        F(self.0, self.0.max_f32s(self.1, b.1))
    }

    /// The smaller.
    #[inline(always)]
    pub fn min(self, b: Self) -> Self {
        F(self.0, self.0.min_f32s(self.1, b.1))
    }
}

impl<S: Simd> Add for F<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, b: Self) -> Self {
        F(self.0, self.0.add_f32s(self.1, b.1))
    }
}

impl<S: Simd> Sub for F<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, b: Self) -> Self {
        F(self.0, self.0.sub_f32s(self.1, b.1))
    }
}

impl<S: Simd> Mul for F<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, b: Self) -> Self {
        F(self.0, self.0.mul_f32s(self.1, b.1))
    }
}

impl<S: Simd> Neg for F<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        F(self.0, self.0.neg_f32s(self.1))
    }
}

/// Several vectors.
#[derive(Clone, Copy)]
pub struct V<S: Simd>(pub F<S>, pub F<S>, pub F<S>);

impl<S: Simd> V<S> {
    /// The vectors from place `at` of three lists on.
    #[inline(always)]
    pub fn load(s: S, from: [&[f32]; 3], at: usize) -> Self {
        V(F::load(s, from[0], at), F::load(s, from[1], at), F::load(s, from[2], at))
    }

    /// Writes the vectors from place `at` on.
    #[inline(always)]
    pub fn store(self, to: &mut [Vec<f32>; 3], at: usize) {
        self.0.store(&mut to[0], at);
        self.1.store(&mut to[1], at);
        self.2.store(&mut to[2], at);
    }

    /// Scalar products.
    #[inline(always)]
    pub fn dot(self, b: Self) -> F<S> {
        self.2.fma(b.2, self.1.fma(b.1, self.0 * b.0))
    }

    /// `self · k`.
    #[inline(always)]
    pub fn scale(self, k: F<S>) -> Self {
        V(self.0 * k, self.1 * k, self.2 * k)
    }

    /// `self · k + c`, each number rounded once.
    #[inline(always)]
    pub fn fma(self, k: F<S>, c: Self) -> Self {
        V(self.0.fma(k, c.0), self.1.fma(k, c.1), self.2.fma(k, c.2))
    }

    /// `c − self · k`, each number rounded once.
    #[inline(always)]
    pub fn fnma(self, k: F<S>, c: Self) -> Self {
        V(self.0.fnma(k, c.0), self.1.fnma(k, c.1), self.2.fnma(k, c.2))
    }
}

impl<S: Simd> Add for V<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, b: Self) -> Self {
        V(self.0 + b.0, self.1 + b.1, self.2 + b.2)
    }
}

impl<S: Simd> Sub for V<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, b: Self) -> Self {
        V(self.0 - b.0, self.1 - b.1, self.2 - b.2)
    }
}

impl<S: Simd> Neg for V<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        V(-self.0, -self.1, -self.2)
    }
}

/// Sums of products kept apart by place modulo [`LANES`], so that the order of the sum is the
/// same however many numbers are taken at a time.
#[derive(Clone, Copy)]
pub struct Sum([f32; LANES]);

impl Sum {
    /// Nothing.
    #[inline(always)]
    pub fn zero() -> Self {
        Sum([0.0; LANES])
    }

    /// Adds `a · b` of a place.
    #[inline(always)]
    pub fn add<S: Simd>(&mut self, s: S, at: usize, a: V<S>, b: V<S>) {
        let lane = at % LANES;
        let so_far = F::load(s, &self.0, lane);
        a.0.fma(b.0, a.1.fma(b.1, a.2.fma(b.2, so_far))).store(&mut self.0, lane);
    }

    /// The total, added up in order.
    pub fn total(&self) -> f64 {
        self.0.iter().map(|x| f64::from(*x)).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Work;

    impl pulp::WithSimd for Work {
        type Output = (Vec<f32>, f64);
        #[inline(always)]
        fn with_simd<S: Simd>(self, s: S) -> Self::Output {
            let a: Vec<f32> = (0..3 * LANES).map(|i| 1.0 / (i as f32 + 0.7)).collect();
            let mut y = vec![0.0; 3 * LANES];
            let mut sum = Sum::zero();
            for at in (0..3 * LANES).step_by(F::<S>::COUNT) {
                let x = F::load(s, &a, at);
                let r = x.fma(x, x.sqrt()).over(x + F::splat(s, 0.3)).max(-x).min(x + x);
                r.store(&mut y, at);
                sum.add(s, at, V(r, x, r), V(x, r, r));
            }
            (y, sum.total())
        }
    }

    /// The widest instructions of this machine against one number at a time, to the last bit.
    #[test]
    fn the_width_does_not_show_in_the_result() {
        use pulp::WithSimd;
        let wide = pulp::Arch::new().dispatch(Work);
        let single = Work.with_simd(pulp::Scalar);
        assert_eq!(wide, single);
    }
}
