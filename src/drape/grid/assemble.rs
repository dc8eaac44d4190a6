//! Forces and stiffness of the grid's elements at given places of the knots.
//!
//! Differences of places are taken in double precision, everything after them in single.

use super::lanes::{F, LANES, V};
use super::product::chunk;
use super::strips::{Flow, Law, Strips};
use super::{BLOCK, Grid, Part, STIFF};
use pulp::{Simd, WithSimd};

/// Least lateral stiffness of a thread, as a share of its stiffness: in movement and at rest.
///
/// A thread under compression has negative lateral stiffness, which an implicit step may not take; with none
/// at all a fold swings freely for the length of the step and overshoots, since a thread that is
/// turned by a large angle in a step becomes longer. The share follows that lengthening: half the
/// square of the angle by which the last step turned the thread. It stands in the matrix only, the
/// force is exact.
const SLACK: [f32; 2] = [0.02, 2.0e-4];

/// Forces and stiffness for a part of the rows.
pub struct Load<'a, 'b> {
    /// The grid.
    pub grid: &'a Grid,
    /// By how much stiffness is to be multiplied.
    pub scale: f32,
    /// Places, m.
    pub x: [&'a [f64]; 3],
    /// Movement in the last step, m.
    pub slide: [&'a [f32]; 3],
    /// The part.
    pub part: &'a Part,
    /// Its share of the forces, N.
    pub force: [&'b mut [f32]; 3],
    /// Its share of the stiffness.
    pub stiff: &'b mut [f32],
    /// Working space.
    pub strips: &'b mut Strips,
}

struct Loading<'a, 'b, S: Simd> {
    grid: &'a Grid,
    scale: F<S>,
    x: [&'a [f64]; 3],
    slide: [&'a [f32]; 3],
    force: [&'b mut [f32]; 3],
    stiff: &'b mut [f32],
    start: usize,
}

/// `Σ w x` of the places at several slots, as single precision.
#[inline(always)]
fn combine<S: Simd, const N: usize>(s: S, x: [&[f64]; 3], at: [(usize, f64); N]) -> V<S> {
    let component = |x: &[f64]| {
        let lists = at.map(|(from, w)| (&x[from..from + F::<S>::COUNT], w));
        let mut sum = [0.0f32; LANES];
        for i in 0..F::<S>::COUNT {
            let mut total = 0.0;
            for (list, w) in lists {
                total += list[i] * w;
            }
            sum[i] = total as f32;
        }
        F::load(s, &sum, 0)
    };
    V(component(x[0]), component(x[1]), component(x[2]))
}

/// The way from one slot to another and the square of its length less that of the rest.
#[inline(always)]
fn way<S: Simd>(s: S, x: [&[f64]; 3], from: usize, to: usize, rest: f64) -> (V<S>, F<S>) {
    let n = F::<S>::COUNT;
    let ends = x.map(|x| (&x[from..from + n], &x[to..to + n]));
    let mut d = [[0.0f32; LANES]; 3];
    let mut more = [0.0f32; LANES];
    for i in 0..n {
        let [a, b, c] = ends.map(|(from, to)| to[i] - from[i]);
        d[0][i] = a as f32;
        d[1][i] = b as f32;
        d[2][i] = c as f32;
        more[i] = (a * a + b * b + c * c - rest * rest) as f32;
    }
    (V(F::load(s, &d[0], 0), F::load(s, &d[1], 0), F::load(s, &d[2], 0)), F::load(s, &more, 0))
}

impl<S: Simd> Loading<'_, '_, S> {
    /// Force on the first end of an edge, and its stiffness as m and b.
    #[inline(always)]
    fn edge(&self, s: S, (from, to): (usize, usize), rest: f64, k: F<S>) -> (V<S>, V<S>, F<S>) {
        let (d, more) = way(s, self.x, from, to, rest);
        let (one, tiny) = (F::splat(s, 1.0), F::splat(s, 1e-12));
        let length = d.dot(d).max(tiny).sqrt();
        let rest = F::splat(s, rest as f32);
        let n = d.scale(one.over(length));
        let stretch = more.over(length + rest);
        let turn = V::load(s, self.slide, to) - V::load(s, self.slide, from);
        let along = turn.dot(n);
        let lateral = along.fnma(along, turn.dot(turn)).over(length * length);
        let least =
            (lateral * F::splat(s, 0.5)).max(F::splat(s, SLACK[1])).min(F::splat(s, SLACK[0]));
        let side = stretch.over(length).max(least).min(one);
        let full = k * self.scale;
        let m = n.scale((full * (one - side)).max(F::splat(s, 0.0)).sqrt());
        (n.scale(k * stretch), m, full * side)
    }
}

impl<S: Simd> Law<S> for Loading<'_, '_, S> {
    #[inline(always)]
    fn flow(&mut self, s: S, row: usize, at: usize, stride: usize) -> Flow<S> {
        let h = self.grid.layout.rows[row].cell;
        let (right, up) = (at + 1, at + stride);
        let (weft, m_weft, b_weft) = self.edge(s, (at, right), h, F::load(s, &self.grid.weft, at));
        let (warp, m_warp, b_warp) = self.edge(s, (at, up), h, F::load(s, &self.grid.warp, at));
        let modulus = F::load(s, &self.grid.shear, at);
        let diagonal = up + 1;
        let d1 = combine(s, self.x, [(diagonal, 1.0), (at, -1.0)]);
        let d2 = combine(s, self.x, [(right, 1.0), (up, -1.0)]);
        let less = combine(s, self.x, [(diagonal, 1.0), (at, -1.0), (right, -1.0), (up, 1.0)]);
        let quarter = F::splat(s, (0.25 / (h * h)) as f32);
        let half = less.dot(d1 + d2) * quarter * modulus * F::splat(s, 0.5);
        let (p1, p2) = (d1.scale(half), d2.scale(half));
        let twist = F::load(s, &self.grid.twist, at);
        let corners = [(at, 1.0), (right, -1.0), (diagonal, 1.0), (up, -1.0)];
        let t = combine(s, self.x, corners).scale(twist);
        let bend = F::load(s, &self.grid.bend_weft, at);
        let bend = -combine(s, self.x, [(at - 1, 1.0), (at, -2.0), (right, 1.0)]).scale(bend);
        if let Some(here) = at.checked_sub(self.start)
            && here * STIFF < self.stiff.len()
        {
            let root = (modulus * quarter * self.scale).sqrt();
            let (m1, m2) = (d1.scale(root), d2.scale(root));
            let nothing = F::splat(s, 0.0);
            let firm = half * self.scale;
            let numbers = [
                m_weft.0,
                m_weft.1,
                m_weft.2,
                b_weft,
                m_warp.0,
                m_warp.1,
                m_warp.2,
                b_warp,
                m1.0,
                m1.1,
                m1.2,
                m2.0,
                m2.1,
                m2.2,
                firm.max(nothing),
                (-firm).max(nothing),
            ];
            let list = &mut self.stiff[here / LANES * LANES * STIFF + here % LANES..];
            for (k, number) in numbers.into_iter().enumerate() {
                number.store(list, k * LANES);
            }
        }
        // Forces run against what the matrix does: diagonals too long are drawn in.
        let corners = [p1 - t, p2 + t, -(p1 + t), t - p2];
        Flow { weft, warp, corners, bend }
    }

    #[inline(always)]
    fn bend(&self, s: S, at: usize, stride: usize) -> V<S> {
        let bend = F::load(s, &self.grid.bend_warp, at);
        -combine(s, self.x, [(at - stride, 1.0), (at, -2.0), (at + stride, 1.0)]).scale(bend)
    }

    #[inline(always)]
    fn take(&mut self, _s: S, at: usize, sum: V<S>) {
        let here = at - self.start;
        sum.0.store(self.force[0], here);
        sum.1.store(self.force[1], here);
        sum.2.store(self.force[2], here);
    }
}

impl WithSimd for Load<'_, '_> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: Simd>(self, s: S) {
        let Load { grid, scale, x, slide, part, force, stiff, strips } = self;
        let mut law = Loading {
            grid,
            scale: F::splat(s, scale),
            x,
            slide,
            force,
            stiff,
            start: part.slots.start,
        };
        strips.pass(s, &grid.layout.rows, part.rows.clone(), &mut law);
    }
}

/// The diagonal blocks of a part of the slots: what acts on each knot alone, and what its elements do.
pub struct Diagonal<'a, 'b> {
    /// The grid.
    pub grid: &'a Grid,
    /// What acts on each knot alone, [`BLOCK`] numbers a slot.
    pub own: &'a [f32],
    /// 1 for knots that are solved for, 0 for all other slots.
    pub free: &'a [f32],
    /// By how much bending is to be multiplied.
    pub scale: f32,
    /// The part.
    pub part: &'a Part,
    /// Its share of the blocks.
    pub diagonal: &'b mut [f32],
}

/// Adds `m mᵀ + b` to a block.
#[inline(always)]
fn add<S: Simd>(block: &mut [F<S>; BLOCK], m: V<S>, b: F<S>) {
    block[0] = m.0.fma(m.0, block[0]) + b;
    block[1] = m.0.fma(m.1, block[1]);
    block[2] = m.0.fma(m.2, block[2]);
    block[3] = m.1.fma(m.1, block[3]) + b;
    block[4] = m.1.fma(m.2, block[4]);
    block[5] = m.2.fma(m.2, block[5]) + b;
}

/// Some of the stiffness numbers of the slots from `at` on, which need not begin a chunk.
#[inline(always)]
fn pick<S: Simd, const N: usize>(s: S, list: &[f32], at: usize, first: usize) -> [F<S>; N] {
    let n = F::<S>::COUNT;
    let (chunk, lane) = (at / LANES, at % LANES);
    let begin = chunk * LANES * STIFF + lane;
    if lane + n <= LANES {
        return std::array::from_fn(|k| F::load(s, list, begin + (first + k) * LANES));
    }
    std::array::from_fn(|k| {
        let mut numbers = [0.0; LANES];
        let here = LANES - lane;
        let from = begin + (first + k) * LANES;
        numbers[..here].copy_from_slice(&list[from..from + here]);
        let from = (chunk + 1) * LANES * STIFF + (first + k) * LANES;
        numbers[here..n].copy_from_slice(&list[from..from + n - here]);
        F::load(s, &numbers, 0)
    })
}

impl WithSimd for Diagonal<'_, '_> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: Simd>(self, s: S) {
        let stiff = &self.grid.stiff[..];
        let scale = F::splat(s, self.scale);
        for group in &self.grid.groups[self.part.groups.clone()] {
            let stride = group.stride;
            for at in (group.base..group.base + group.rows * stride).step_by(F::<S>::COUNT) {
                let mut block: [F<S>; BLOCK] = chunk(s, self.own, at);
                let bend = F::load(s, &self.grid.bend_own, at) * scale;
                let here: [F<S>; STIFF] = chunk(s, stiff, at);
                let edge = |k: &[F<S>]| (V(k[0], k[1], k[2]), k[3]);
                let (m, b) = edge(&here[0..4]);
                add(&mut block, m, b + bend);
                let (m, b) = edge(&here[4..8]);
                add(&mut block, m, b);
                add(&mut block, V(here[8], here[9], here[10]), here[14]);
                // Of the slot on the left: its weft edge, and its cell's lower right corner.
                let left: [F<S>; 4] = pick(s, stiff, at - 1, 0);
                let (m, b) = edge(&left);
                add(&mut block, m, b);
                let [x, y, z, _, b]: [F<S>; 5] = pick(s, stiff, at - 1, 11);
                add(&mut block, V(x, y, z), b);
                // Of the slot below: its warp edge, and its cell's upper left corner.
                let below: [F<S>; 12] = pick(s, stiff, at - stride, 4);
                let (m, b) = edge(&below[0..4]);
                add(&mut block, m, b);
                add(&mut block, V(below[7], below[8], below[9]), below[11]);
                // Of the slot below on the left: its cell's upper right corner.
                let [x, y, z, _, _, _, b]: [F<S>; 7] = pick(s, stiff, at - stride - 1, 8);
                add(&mut block, V(x, y, z), b);
                // Slots without a knot get the unit block.
                let free = F::load(s, self.free, at);
                let unit = F::splat(s, 1.0) - free;
                let list = at - self.part.slots.start;
                let list = &mut self.diagonal[list / LANES * LANES * BLOCK + list % LANES..];
                for (k, number) in block.into_iter().enumerate() {
                    let number = number * free;
                    let number = if matches!(k, 0 | 3 | 5) { number + unit } else { number };
                    number.store(list, k * LANES);
                }
            }
        }
    }
}
