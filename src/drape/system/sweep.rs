//! What an iteration of the gradients does to the grid's share of the vectors, part by part.

use crate::drape::grid::lanes::{F, LANES, Sum, V};
use crate::drape::grid::thread::{SolveWarp, SolveWeft, Threads};
use crate::drape::grid::{Columns, Grid, Part};
use pulp::{Simd, WithSimd};

/// A step along p for a part of the groups, and the weft threads of the new residual.
pub(super) struct Advance<'a, 'b> {
    pub(super) grid: &'a Grid,
    pub(super) threads: &'a Threads,
    pub(super) alpha: f32,
    pub(super) free: &'a [f32],
    pub(super) p: [&'a [f32]; 3],
    pub(super) q: [&'a [f32]; 3],
    pub(super) part: &'a Part,
    pub(super) x: [&'b mut [f32]; 3],
    pub(super) r: [&'b mut [f32]; 3],
    pub(super) z: [&'b mut [f32]; 3],
    pub(super) dots: &'b mut [f64],
    pub(super) space: &'b mut Vec<f32>,
}

impl WithSimd for Advance<'_, '_> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: Simd>(mut self, s: S) {
        let alpha = F::splat(s, self.alpha);
        let start = self.part.slots.start;
        for (number, dots) in self.part.groups.clone().zip(self.dots) {
            let group = self.grid.groups[number];
            let slots = group.base - start..group.base - start + group.rows * group.stride;
            if self.alpha != 0.0 {
                for here in slots.clone().step_by(F::<S>::COUNT) {
                    let at = start + here;
                    let free = F::load(s, self.free, at);
                    for c in 0..3 {
                        let (x, r) = (&mut *self.x[c], &mut *self.r[c]);
                        F::load(s, self.p[c], at).fma(alpha, F::load(s, x, here)).store(x, here);
                        let q = F::load(s, self.q[c], at) * free;
                        q.fnma(alpha, F::load(s, r, here)).store(r, here);
                    }
                }
            }
            let [r0, r1, r2] = &self.r;
            let r = [&r0[slots.clone()], &r1[slots.clone()], &r2[slots.clone()]];
            let [z0, z1, z2] = &mut self.z;
            let z = [&mut z0[slots.clone()], &mut z1[slots.clone()], &mut z2[slots.clone()]];
            SolveWeft { links: self.threads.weft_of(number), group, r, z, space: self.space }
                .with_simd(s);
            let mut sum = Sum::zero();
            for here in slots.step_by(F::<S>::COUNT) {
                let at = |v: &[&mut [f32]; 3]| {
                    V(F::load(s, v[0], here), F::load(s, v[1], here), F::load(s, v[2], here))
                };
                sum.add(s, here, at(&self.r), at(&self.z));
            }
            *dots = sum.total();
        }
    }
}

/// The warp threads of a part of the blocks of columns.
pub(super) struct Rise<'a, 'b> {
    pub(super) grid: &'a Grid,
    pub(super) threads: &'a Threads,
    pub(super) columns: &'a Columns,
    pub(super) r: [&'a [f32]; 3],
    pub(super) z: &'b mut [f32],
    pub(super) dots: &'b mut [f64],
}

impl WithSimd for Rise<'_, '_> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: Simd>(self, s: S) {
        let mut rest = self.z;
        let blocks = &self.grid.blocks[self.columns.blocks.clone()];
        for (block, dots) in blocks.iter().zip(self.dots) {
            let (z, after) = rest.split_at_mut(block.rows * 3 * LANES);
            rest = after;
            SolveWarp { links: self.threads.warp_of(block), block: *block, r: self.r, z: &mut *z }
                .with_simd(s);
            let mut sum = Sum::zero();
            for (row, cell) in z.chunks_exact(3 * LANES).enumerate() {
                for lane in (0..LANES).step_by(F::<S>::COUNT) {
                    let r = V::load(s, self.r, block.base + row * block.stride + lane);
                    let z = V(
                        F::load(s, cell, lane),
                        F::load(s, cell, LANES + lane),
                        F::load(s, cell, 2 * LANES + lane),
                    );
                    sum.add(s, lane, r, z);
                }
            }
            *dots = sum.total();
        }
    }
}

/// The next direction for a part of the groups.
pub(super) struct Turn<'a, 'b> {
    pub(super) grid: &'a Grid,
    pub(super) beta: f32,
    pub(super) part: &'a Part,
    pub(super) z: [&'a [f32]; 3],
    pub(super) risen: &'a [f32],
    pub(super) p: [&'b mut [f32]; 3],
}

impl WithSimd for Turn<'_, '_> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: Simd>(self, s: S) {
        let beta = F::splat(s, self.beta);
        let start = self.part.slots.start;
        let [p0, p1, p2] = self.p;
        for group in &self.grid.groups[self.part.groups.clone()] {
            for row in 0..group.rows {
                for column in (0..group.stride).step_by(F::<S>::COUNT) {
                    let at = group.base + row * group.stride + column;
                    let block = &self.grid.blocks[group.block + column / LANES];
                    let cell = (block.first / LANES + group.within + row) * 3 * LANES;
                    let cell = &self.risen[cell + column % LANES..];
                    let here = at - start;
                    for (c, p) in [&mut *p0, &mut *p1, &mut *p2].into_iter().enumerate() {
                        let z = F::load(s, self.z[c], at) + F::load(s, cell, c * LANES);
                        F::load(s, p, here).fma(beta, z).store(p, here);
                    }
                }
            }
        }
    }
}
