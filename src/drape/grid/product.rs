//! The product of the step's matrix with a vector, the grid's share of it.

use super::lanes::{F, LANES, Sum, V};
use super::strips::{Flow, Law, Strips};
use super::{BLOCK, Grid, Part, STIFF};
use pulp::{Simd, WithSimd};

/// Lists of the three components.
pub type Three = [Vec<f32>; 3];

/// `y = A x` for a part of the rows.
pub struct Multiply<'a, 'b> {
    /// The grid.
    pub grid: &'a Grid,
    /// What acts on each knot alone, [`BLOCK`] numbers a slot.
    pub own: &'a [f32],
    /// By how much bending is to be multiplied.
    pub scale: f32,
    /// The vector.
    pub x: [&'a [f32]; 3],
    /// The part.
    pub part: &'a Part,
    /// Its share of the result.
    pub y: [&'b mut [f32]; 3],
    /// Scalar product of each of its rows with the result.
    pub dots: &'b mut [f64],
    /// Working space.
    pub strips: &'b mut Strips,
}

struct Product<'a, 'b, S: Simd> {
    grid: &'a Grid,
    own: &'a [f32],
    x: [&'a [f32]; 3],
    scale: F<S>,
    y: [&'b mut [f32]; 3],
    start: usize,
    sum: Sum,
    /// Slot at which the row in hand ends, and its dot products so far.
    dots: &'b mut [f64],
    first: usize,
    row: usize,
}

/// The numbers of slot `at` on in a list by chunks.
#[inline(always)]
pub fn chunk<S: Simd, const N: usize>(s: S, list: &[f32], at: usize) -> [F<S>; N] {
    let first = at / LANES * LANES * N + at % LANES;
    let list = &list[first..];
    std::array::from_fn(|k| F::load(s, list, k * LANES))
}

/// Symmetric block times vector.
#[inline(always)]
pub fn times<S: Simd>(m: &[F<S>; BLOCK], v: V<S>) -> V<S> {
    V(
        m[2].fma(v.2, m[1].fma(v.1, m[0] * v.0)),
        m[4].fma(v.2, m[3].fma(v.1, m[1] * v.0)),
        m[5].fma(v.2, m[4].fma(v.1, m[2] * v.0)),
    )
}

impl<S: Simd> Law<S> for Product<'_, '_, S> {
    #[inline(always)]
    fn flow(&mut self, s: S, _row: usize, at: usize, stride: usize) -> Flow<S> {
        let k: [F<S>; STIFF] = chunk(s, &self.grid.stiff, at);
        let x = |at: usize| V::load(s, self.x, at);
        let (lower_left, lower_right) = (x(at), x(at + 1));
        let (upper_left, upper_right) = (x(at + stride), x(at + stride + 1));
        // An edge with stiffness m mᵀ + b draws its ends together as far as they part.
        let edge = |m: V<S>, b: F<S>, way: V<S>| -(m.fma(m.dot(way), way.scale(b)));
        let weft = edge(V(k[0], k[1], k[2]), k[3], lower_right - lower_left);
        let warp = edge(V(k[4], k[5], k[6]), k[7], upper_left - lower_left);
        let (d1, d2) = (V(k[8], k[9], k[10]), V(k[11], k[12], k[13]));
        let (w1, w2) = (upper_right - lower_left, lower_right - upper_left);
        let shear = d1.dot(w1) - d2.dot(w2);
        let p1 = d1.fma(shear, w1.scale(k[14]));
        let p2 = d2.fnma(shear, w2.scale(k[15]));
        let twist = F::load(s, &self.grid.twist, at) * self.scale;
        let t = ((lower_left - lower_right) + (upper_right - upper_left)).scale(twist);
        let bend = F::load(s, &self.grid.bend_weft, at) * self.scale;
        let two = F::splat(s, 2.0);
        let bend = lower_left.fnma(two, x(at - 1) + lower_right).scale(bend);
        Flow { weft, warp, corners: [t - p1, p2 - t, p1 + t, -(p2 + t)], bend }
    }

    #[inline(always)]
    fn bend(&self, s: S, at: usize, stride: usize) -> V<S> {
        let x = |at: usize| V::load(s, self.x, at);
        let bend = F::load(s, &self.grid.bend_warp, at) * self.scale;
        let two = F::splat(s, 2.0);
        x(at).fnma(two, x(at - stride) + x(at + stride)).scale(bend)
    }

    #[inline(always)]
    fn take(&mut self, s: S, at: usize, sum: V<S>) {
        let x = V::load(s, self.x, at);
        let y = sum + times(&chunk(s, self.own, at), x);
        let here = at - self.start;
        y.0.store(self.y[0], here);
        y.1.store(self.y[1], here);
        y.2.store(self.y[2], here);
        self.sum.add(s, at, x, y);
        let row = &self.grid.layout.rows[self.row];
        if at + F::<S>::COUNT == row.base + row.stride {
            self.dots[self.row - self.first] = self.sum.total();
            self.sum = Sum::zero();
            self.row += 1;
        }
    }
}

impl WithSimd for Multiply<'_, '_> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: Simd>(self, s: S) {
        let Multiply { grid, own, scale, x, part, y, dots, strips } = self;
        let mut law = Product {
            grid,
            own,
            x,
            scale: F::splat(s, scale),
            y,
            start: part.slots.start,
            sum: Sum::zero(),
            dots,
            first: part.rows.start,
            row: part.rows.start,
        };
        strips.pass(s, &grid.layout.rows, part.rows.clone(), &mut law);
    }
}
