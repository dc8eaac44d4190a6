//! Threads solved exactly: every warp and every weft thread of a grid as a chain of 3 × 3 blocks.
//!
//! Cloth is stiffest along its threads, so that the sum of both families of exact solutions is a good
//! preconditioner for the whole. Threads that run side by side are solved several at a time.
//!
//! Along a thread with diagonal blocks D and edges of stiffness K = m mᵀ + b the factor is
//! D'ₙ = Dₙ − Kₙ₋₁ D'ₙ₋₁⁻¹ Kₙ₋₁; kept are D'⁻¹, m and b.

use super::lanes::{F, LANES, V};
use super::product::{chunk, times};
use super::{BLOCK, Block, Columns, Grid, Group, Part, STIFF};
use pulp::{Simd, WithSimd};

/// Numbers of a link of a chain: the inverse block, m and b of the edge to the next.
const LINK: usize = BLOCK + 4;

/// The factors of all threads.
#[derive(Clone, Debug, Default)]
pub struct Threads {
    /// Weft threads: by group of rows and column, [`LINK`] numbers for [`LANES`] rows.
    weft: Vec<f32>,
    /// Warp threads: by block of columns and row.
    warp: Vec<f32>,
    /// Where each group begins in `weft`, in links, and where the last ends.
    starts: Vec<usize>,
}

impl Threads {
    /// Room for the threads of a grid.
    pub fn new(grid: &Grid) -> Self {
        let mut starts = vec![0];
        for group in &grid.groups {
            starts.push(starts.last().copied().unwrap_or(0) + group.stride);
        }
        let links = starts.last().copied().unwrap_or(0);
        let rising: usize = grid.blocks.iter().map(|b| b.rows).sum();
        Threads {
            weft: vec![0.0; links * LINK * LANES],
            warp: vec![0.0; rising * LINK * LANES],
            starts,
        }
    }

    /// The lists of weft factors for each part of the rows, to be filled.
    pub fn weft_parts(&mut self, parts: &[Part]) -> Vec<&mut [f32]> {
        split(&mut self.weft, parts.iter().map(|p| self.starts[p.groups.end] * LINK * LANES))
    }

    /// The lists of warp factors for each part of the columns, to be filled.
    pub fn warp_parts(&mut self, columns: &[Columns]) -> Vec<&mut [f32]> {
        split(&mut self.warp, columns.iter().map(|c| c.end * LINK * LANES))
    }

    /// The weft factor of one group of rows.
    pub fn weft_of(&self, group: usize) -> &[f32] {
        &self.weft[self.starts[group] * LINK * LANES..self.starts[group + 1] * LINK * LANES]
    }

    /// The warp factor of one block of columns.
    pub fn warp_of(&self, block: &Block) -> &[f32] {
        let links = block.first / LANES;
        &self.warp[links * LINK * LANES..(links + block.rows) * LINK * LANES]
    }
}

/// Cuts a list at given ends.
pub fn split<T>(mut list: &mut [T], ends: impl Iterator<Item = usize>) -> Vec<&mut [T]> {
    let mut cut = 0;
    let mut parts = Vec::new();
    for end in ends {
        let (part, rest) = std::mem::take(&mut list).split_at_mut(end - cut);
        parts.push(part);
        list = rest;
        cut = end;
    }
    parts
}

/// Inverse of a positive block; pivots that rounding has spoilt are kept above a share of the
/// block's own diagonal.
#[inline(always)]
fn inverse<S: Simd>(s: S, m: &[F<S>; BLOCK], own: &[F<S>; BLOCK]) -> [F<S>; BLOCK] {
    let one = F::splat(s, 1.0);
    let firm = F::splat(s, 1e-6);
    let p = one.over(m[0].max(own[0] * firm));
    let (b, c) = (m[1] * p, m[2] * p);
    let q = one.over(b.fnma(m[1], m[3]).max(own[3] * firm));
    let rest = b.fnma(m[2], m[4]);
    let e = rest * q;
    let r = one.over(e.fnma(rest, c.fnma(m[2], m[5])).max(own[5] * firm));
    // Rows of the inverse of L = [1; b 1; c e 1].
    let (l10, l21) = (-b, -e);
    let l20 = b * e - c;
    [
        l20.fma(l20 * r, l10.fma(l10 * q, p)),
        l20.fma(l21 * r, l10 * q),
        l20 * r,
        l21.fma(l21 * r, q),
        l21 * r,
        r,
    ]
}

/// `D − K D'⁻¹ K` with K = m mᵀ + b.
#[inline(always)]
fn reduce<S: Simd>(
    s: S,
    d: &[F<S>; BLOCK],
    inverse: &[F<S>; BLOCK],
    m: V<S>,
    b: F<S>,
) -> [F<S>; BLOCK] {
    let u = times(inverse, m);
    // m (c m + b u)ᵀ + b u mᵀ + b² D'⁻¹, the first two taken as halves to stay symmetric.
    let c = m.dot(u) * F::splat(s, 0.5);
    let w = V(c.fma(m.0, b * u.0), c.fma(m.1, b * u.1), c.fma(m.2, b * u.2));
    let bb = b * b;
    let two = F::splat(s, 2.0);
    let (m0, m1, m2) = (m.0, m.1, m.2);
    [
        inverse[0].fnma(bb, (m0 * w.0).fnma(two, d[0])),
        inverse[1].fnma(bb, m1.fnma(w.0, m0.fnma(w.1, d[1]))),
        inverse[2].fnma(bb, m2.fnma(w.0, m0.fnma(w.2, d[2]))),
        inverse[3].fnma(bb, (m1 * w.1).fnma(two, d[3])),
        inverse[4].fnma(bb, m2.fnma(w.1, m1.fnma(w.2, d[4]))),
        inverse[5].fnma(bb, (m2 * w.2).fnma(two, d[5])),
    ]
}

/// The chain in hand: what the last link hands on.
struct Chain<S: Simd> {
    inverse: [F<S>; BLOCK],
    m: V<S>,
    b: F<S>,
}

impl<S: Simd> Chain<S> {
    #[inline(always)]
    fn new(s: S) -> Self {
        let zero = F::splat(s, 0.0);
        Chain { inverse: [zero; BLOCK], m: V(zero, zero, zero), b: zero }
    }

    #[inline(always)]
    fn add(&mut self, s: S, d: &[F<S>; BLOCK], m: V<S>, b: F<S>, link: &mut [f32]) {
        let reduced = reduce(s, d, &self.inverse, self.m, self.b);
        self.inverse = inverse(s, &reduced, d);
        (self.m, self.b) = (m, b);
        for (k, number) in self.inverse.into_iter().enumerate() {
            number.store(link, k * LANES);
        }
        m.0.store(link, BLOCK * LANES);
        m.1.store(link, (BLOCK + 1) * LANES);
        m.2.store(link, (BLOCK + 2) * LANES);
        b.store(link, (BLOCK + 3) * LANES);
    }
}

/// Factors the warp threads of a part of the blocks of columns.
pub struct FactorWarp<'a, 'b> {
    /// The grid, with its diagonal.
    pub grid: &'a Grid,
    /// 1 for knots that are solved for.
    pub free: &'a [f32],
    /// The part of the columns.
    pub columns: &'a Columns,
    /// Their factors.
    pub links: &'b mut [f32],
}

impl WithSimd for FactorWarp<'_, '_> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: Simd>(self, s: S) {
        let mut links = self.links.chunks_exact_mut(LINK * LANES);
        for block in &self.grid.blocks[self.columns.blocks.clone()] {
            let mut own: Vec<&mut [f32]> = links.by_ref().take(block.rows).collect();
            for lane in (0..LANES).step_by(F::<S>::COUNT) {
                let mut chain = Chain::new(s);
                for (row, link) in own.iter_mut().enumerate() {
                    let at = block.base + row * block.stride + lane;
                    let d = chunk(s, &self.grid.diagonal, at);
                    let k: [F<S>; STIFF] = chunk(s, &self.grid.stiff, at);
                    let both = F::load(s, self.free, at) * F::load(s, self.free, at + block.stride);
                    let m = V(k[4], k[5], k[6]).scale(both);
                    chain.add(s, &d, m, k[7] * both, &mut link[lane..]);
                }
            }
        }
    }
}

/// Factors the weft threads of a part of the groups of rows.
pub struct FactorWeft<'a, 'b> {
    /// The grid, with its diagonal.
    pub grid: &'a Grid,
    /// 1 for knots that are solved for.
    pub free: &'a [f32],
    /// The part of the rows.
    pub part: &'a Part,
    /// Their factors.
    pub links: &'b mut [f32],
}

impl WithSimd for FactorWeft<'_, '_> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: Simd>(self, s: S) {
        let mut links = self.links.chunks_exact_mut(LINK * LANES);
        for group in &self.grid.groups[self.part.groups.clone()] {
            let mut own: Vec<&mut [f32]> = links.by_ref().take(group.stride).collect();
            // First the numbers are brought from rows into lanes.
            for (column, link) in own.iter_mut().enumerate() {
                link.fill(0.0);
                for k in [0, 3, 5] {
                    link[k * LANES..(k + 1) * LANES].fill(1.0);
                }
                for row in 0..group.rows {
                    let at = group.base + row * group.stride + column;
                    let (chunk, lane) = (at / LANES, at % LANES);
                    for k in 0..BLOCK {
                        link[k * LANES + row] =
                            self.grid.diagonal[(chunk * BLOCK + k) * LANES + lane];
                    }
                    let both = self.free[at] * self.free[at + 1];
                    for k in 0..4 {
                        link[(BLOCK + k) * LANES + row] =
                            self.grid.stiff[(chunk * STIFF + k) * LANES + lane] * both;
                    }
                }
            }
            for lane in (0..LANES).step_by(F::<S>::COUNT) {
                let mut chain = Chain::new(s);
                for link in &mut own {
                    let numbers: [F<S>; LINK] =
                        std::array::from_fn(|k| F::load(s, link, k * LANES + lane));
                    let [d0, d1, d2, d3, d4, d5, m0, m1, m2, b] = numbers;
                    let d = [d0, d1, d2, d3, d4, d5];
                    chain.add(s, &d, V(m0, m1, m2), b, &mut link[lane..]);
                }
            }
        }
    }
}

#[inline(always)]
fn link<S: Simd>(s: S, links: &[f32], number: usize, lane: usize) -> ([F<S>; BLOCK], V<S>, F<S>) {
    let list = &links[number * LINK * LANES + lane..];
    let k: [F<S>; LINK] = std::array::from_fn(|k| F::load(s, list, k * LANES));
    let [d0, d1, d2, d3, d4, d5, m0, m1, m2, b] = k;
    ([d0, d1, d2, d3, d4, d5], V(m0, m1, m2), b)
}

/// Solves a chain in place: `v` holds the right-hand sides, 3 × [`LANES`] numbers a link.
#[inline(always)]
fn solve<S: Simd>(s: S, links: &[f32], v: &mut [f32], lane: usize) {
    let n = v.len() / (3 * LANES);
    let zero = F::splat(s, 0.0);
    let get = |v: &[f32], i: usize| {
        let at = i * 3 * LANES + lane;
        V(F::load(s, v, at), F::load(s, v, at + LANES), F::load(s, v, at + 2 * LANES))
    };
    let put = |v: &mut [f32], i: usize, x: V<S>| {
        let at = i * 3 * LANES + lane;
        x.0.store(v, at);
        x.1.store(v, at + LANES);
        x.2.store(v, at + 2 * LANES);
    };
    let mut handed = V(zero, zero, zero);
    for i in 0..n {
        let (inverse, m, b) = link(s, links, i, lane);
        let w = times(&inverse, get(v, i) + handed);
        put(v, i, w);
        handed = m.fma(m.dot(w), w.scale(b));
    }
    let mut next = V(zero, zero, zero);
    for i in (0..n).rev() {
        let (inverse, m, b) = link(s, links, i, lane);
        let back = m.fma(m.dot(next), next.scale(b));
        next = get(v, i) + times(&inverse, back);
        put(v, i, next);
    }
}

/// Solves the weft threads of one group of rows.
pub struct SolveWeft<'a, 'b> {
    /// Their factor.
    pub links: &'a [f32],
    /// The group.
    pub group: Group,
    /// Right-hand sides of the group's slots.
    pub r: [&'a [f32]; 3],
    /// Solutions of the group's slots.
    pub z: [&'b mut [f32]; 3],
    /// Working space.
    pub space: &'b mut Vec<f32>,
}

impl WithSimd for SolveWeft<'_, '_> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: Simd>(self, s: S) {
        let SolveWeft { links, group, r, z, space } = self;
        let Group { rows, stride, .. } = group;
        space.clear();
        space.resize(stride * 3 * LANES, 0.0);
        for k in 0..3 {
            for row in 0..rows {
                let from = &r[k][row * stride..(row + 1) * stride];
                for (cell, r) in space.chunks_exact_mut(3 * LANES).zip(from) {
                    cell[k * LANES + row] = *r;
                }
            }
        }
        for lane in (0..LANES).step_by(F::<S>::COUNT) {
            solve(s, links, space, lane);
        }
        for k in 0..3 {
            for row in 0..rows {
                let to = &mut z[k][row * stride..(row + 1) * stride];
                for (cell, z) in space.chunks_exact(3 * LANES).zip(to) {
                    *z = cell[k * LANES + row];
                }
            }
        }
    }
}

/// Solves the warp threads of one block of columns.
pub struct SolveWarp<'a, 'b> {
    /// Their factor.
    pub links: &'a [f32],
    /// The block.
    pub block: Block,
    /// Right-hand sides of all slots.
    pub r: [&'a [f32]; 3],
    /// Solutions, 3 × [`LANES`] numbers a row.
    pub z: &'b mut [f32],
}

impl WithSimd for SolveWarp<'_, '_> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: Simd>(self, s: S) {
        let SolveWarp { links, block, r, z } = self;
        for (row, cell) in z.chunks_exact_mut(3 * LANES).enumerate() {
            let at = block.base + row * block.stride;
            for k in 0..3 {
                cell[k * LANES..(k + 1) * LANES].copy_from_slice(&r[k][at..at + LANES]);
            }
        }
        for lane in (0..LANES).step_by(F::<S>::COUNT) {
            solve(s, links, z, lane);
        }
    }
}
