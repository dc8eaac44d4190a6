//! The linear system of an implicit step, and its solution by conjugate gradients preconditioned with
//! exact solutions along every warp and weft thread.
//!
//! # References
//! Baraff and Witkin 1998 for the step; Hestenes and Stiefel 1952 for the gradients. Threads as
//! preconditioner follow from the grid: the stiff directions of woven cloth are its lines.

use super::cloth::Cloth;
use super::grid::assemble::{self, Diagonal, Load};
use super::grid::lanes::{F, LANES, Sum, V};
use super::grid::layout::Layout;
use super::grid::product::{self, Multiply, Three};
use super::grid::strips::Strips;
use super::grid::thread::{FactorWarp, FactorWeft, SolveWarp, SolveWeft, Threads, split};
use super::grid::{BLOCK, Grid, STIFF};
use super::rim::{Rim, place};
use nalgebra::{Matrix3, Vector3};
use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;
use std::ops::Range;

/// A symmetric term outside of the cloth, such as the contact of two layers.
pub trait Extra {
    /// `y += E x`, both by slots; gives the scalar product of x with what was added.
    fn multiply(&self, x: &Three, y: &mut Three) -> f64;
}

/// When to stop.
#[derive(Clone, Copy, Debug)]
pub struct Aim {
    /// Share of the first residual, in the preconditioned norm.
    pub tolerance: f64,
    /// Most iterations.
    pub most: usize,
}

/// A residual this small against the right-hand side is noise of single precision.
const NOISE: f64 = 1e-6;

/// The system of a cloth.
#[derive(Clone, Debug, Default)]
pub struct System {
    /// Its regular part.
    pub grid: Grid,
    /// Its irregular part.
    pub rim: Rim,
    /// What acts on each knot alone, [`BLOCK`] numbers a slot in chunks of [`LANES`] slots.
    pub own: Vec<f32>,
    /// The same with what is only for the preconditioner to see.
    firm: Vec<f32>,
    threads: Threads,
    free: Vec<f32>,
    place: [Vec<f64>; 3],
    slide: Three,
    scale: f32,
    arch: Arch,
    strips: Vec<Strips>,
    columns: Vec<Vec<f32>>,
    b: Three,
    x: Three,
    r: Three,
    z: Three,
    /// Solutions of the warp threads, by blocks of columns.
    risen: Vec<f32>,
    p: Three,
    q: Three,
}

fn three(n: usize) -> Three {
    std::array::from_fn(|_| vec![0.0; n])
}

fn read(v: &Three) -> [&[f32]; 3] {
    [&v[0], &v[1], &v[2]]
}

/// Cuts the slots of all rows at the ends of parts; the lists begin with the first row.
fn cut<'a>(v: &'a mut Three, start: usize, ends: &[usize]) -> Vec<[&'a mut [f32]; 3]> {
    let mut lists = v.iter_mut().map(|l| split(&mut l[start..], ends.iter().map(|e| e - start)));
    let (Some(a), Some(b), Some(c)) = (lists.next(), lists.next(), lists.next()) else {
        return Vec::new();
    };
    a.into_iter().zip(b).zip(c).map(|((a, b), c)| [a, b, c]).collect()
}

fn each<T: Send>(parts: Vec<T>, work: impl Fn(T) + Sync + Send) {
    if parts.len() == 1 {
        parts.into_iter().for_each(work);
    } else {
        parts.into_par_iter().for_each(work);
    }
}

impl System {
    /// The system of a cloth; `sewn` are pairs of open seams. Elements of the cloth are told whether
    /// they belong to the grid or to the rim.
    pub fn new(layout: Layout, cloth: &mut Cloth, sewn: &[[u32; 2]], held: &[bool]) -> Self {
        let (grid, taken) = Grid::new(layout, cloth);
        let n = grid.layout.slots;
        let rim = Rim::new(cloth, &taken, &grid.layout, sewn);
        let risen: usize = grid.blocks.iter().map(|b| b.rows).sum();
        let mut free = vec![0.0; n];
        for (slot, held) in grid.layout.slot.iter().zip(held) {
            free[*slot as usize] = if *held { 0.0 } else { 1.0 };
        }
        System {
            threads: Threads::new(&grid),
            own: vec![0.0; n * BLOCK],
            firm: vec![0.0; n * BLOCK],
            free,
            place: std::array::from_fn(|_| vec![0.0; n]),
            slide: three(n),
            scale: 1.0,
            arch: Arch::new(),
            b: three(n),
            x: three(n),
            r: three(n),
            z: three(n),
            risen: vec![0.0; risen * 3 * LANES],
            p: three(n),
            q: three(n),
            grid,
            rim,
            ..System::default()
        }
    }

    /// Slot of a knot.
    pub fn slot(&self, knot: u32) -> u32 {
        self.grid.layout.slot[knot as usize]
    }

    fn set(&self, from: &[Vector3<f64>], to: &mut Three) {
        for (slot, v) in self.grid.layout.slot.iter().zip(from) {
            for k in 0..3 {
                #[allow(clippy::cast_possible_truncation)]
                let value = v[k] as f32;
                to[k][*slot as usize] = value;
            }
        }
    }

    /// Sets the stiffness to the cloth's own at places x, times `scale`, and gives its forces, N.
    /// `slide` is the movement in the last step.
    pub fn assemble(
        &mut self,
        cloth: &Cloth,
        x: &[Vector3<f64>],
        slide: &[Vector3<f64>],
        scale: f64,
    ) -> Vec<Vector3<f64>> {
        #[allow(clippy::cast_possible_truncation)]
        let single = scale as f32;
        self.scale = single;
        for (slot, v) in self.grid.layout.slot.iter().zip(x) {
            for k in 0..3 {
                self.place[k][*slot as usize] = v[k];
            }
        }
        let mut moved = std::mem::take(&mut self.slide);
        self.set(slide, &mut moved);
        self.slide = moved;
        let shares = self.grid.shares();
        let start = self.grid.start();
        self.strips.resize(shares.len(), Strips::default());
        let ends: Vec<usize> = shares.iter().map(|g| self.grid.slots(g).end).collect();
        let mut stiff = std::mem::take(&mut self.grid.stiff);
        let grid = &self.grid;
        let parts: Vec<Load<'_, '_>> = if grid.groups.is_empty() {
            Vec::new()
        } else {
            let forces = cut(&mut self.q, start, &ends);
            let lists =
                split(&mut stiff[start * STIFF..], ends.iter().map(|e| (e - start) * STIFF));
            let strips = self.strips.iter_mut();
            shares
                .iter()
                .zip(forces)
                .zip(lists)
                .zip(strips)
                .map(|(((groups, force), stiff), strips)| Load {
                    grid,
                    scale: single,
                    x: [&self.place[0], &self.place[1], &self.place[2]],
                    slide: read(&self.slide),
                    part: assemble::Part {
                        rows: rows(grid, groups),
                        start: grid.slots(groups).start,
                        force,
                        stiff,
                        strips,
                    },
                })
                .collect()
        };
        each(parts, |part| self.arch.dispatch(part));
        self.grid.stiff = stiff;
        let mut force: Vec<Vector3<f64>> = self
            .grid
            .layout
            .slot
            .iter()
            .map(|slot| {
                let s = *slot as usize;
                if s >= self.grid.layout.loose {
                    return Vector3::zeros();
                }
                Vector3::new(
                    f64::from(self.q[0][s]),
                    f64::from(self.q[1][s]),
                    f64::from(self.q[2][s]),
                )
            })
            .collect();
        self.rim.assemble(cloth, x, scale, &mut force);
        force
    }

    /// Sets what acts on each knot alone.
    pub fn set_own(&mut self, blocks: impl Iterator<Item = Matrix3<f64>>) {
        for (slot, m) in self.grid.layout.slot.iter().zip(blocks) {
            put(&mut self.own, *slot as usize, &m);
        }
    }

    /// Factors the threads for the stiffness and the blocks in hand. `more` are blocks at slots
    /// that only the preconditioner is to see.
    pub fn factor(&mut self, more: impl Iterator<Item = (u32, Matrix3<f64>)>) {
        self.firm.copy_from_slice(&self.own);
        self.rim.close(&mut self.firm);
        for (slot, m) in more {
            let at = place(slot as usize);
            for (k, value) in six(&m).into_iter().enumerate() {
                self.firm[at + k * LANES] += value;
            }
        }
        let shares = self.grid.shares();
        let start = self.grid.start();
        let ends: Vec<usize> = shares.iter().map(|g| self.grid.slots(g).end).collect();
        let mut diagonal = std::mem::take(&mut self.grid.diagonal);
        // Loose knots have no elements in the grid.
        let loose = self.grid.layout.loose * BLOCK;
        diagonal[loose..].copy_from_slice(&self.firm[loose..]);
        if !self.grid.groups.is_empty() {
            let lists =
                split(&mut diagonal[start * BLOCK..], ends.iter().map(|e| (e - start) * BLOCK));
            let (grid, own, free) = (&self.grid, &self.firm[..], &self.free[..]);
            let parts = shares.iter().zip(lists).map(|(groups, diagonal)| Diagonal {
                grid,
                own,
                free,
                scale: self.scale,
                groups: groups.clone(),
                start: grid.slots(groups).start,
                diagonal,
            });
            each(parts.collect(), |part| self.arch.dispatch(part));
        }
        self.grid.diagonal = diagonal;
        let (grid, free) = (&self.grid, &self.free[..]);
        if !grid.groups.is_empty() {
            let lists = self.threads.weft_parts(&shares);
            let parts = shares.iter().zip(lists).map(|(groups, links)| FactorWeft {
                grid,
                free,
                groups: groups.clone(),
                links,
            });
            each(parts.collect(), |part| self.arch.dispatch(part));
            let shares = grid.column_shares();
            let lists = self.threads.warp_parts(grid, &shares);
            let parts = shares.iter().zip(lists).map(|(blocks, links)| FactorWarp {
                grid,
                free,
                blocks: blocks.clone(),
                links,
            });
            each(parts.collect(), |part| self.arch.dispatch(part));
        }
        self.rim.refresh(&self.grid.diagonal, &self.free);
    }

    /// `q = A p`; gives p · q.
    fn multiply(&mut self, extra: &dyn Extra) -> f64 {
        let shares = self.grid.shares();
        let start = self.grid.start();
        let ends: Vec<usize> = shares.iter().map(|g| self.grid.slots(g).end).collect();
        self.strips.resize(shares.len(), Strips::default());
        let mut dots = vec![0.0; self.grid.layout.rows.len()];
        let grid = &self.grid;
        if !grid.groups.is_empty() {
            let lists = cut(&mut self.q, start, &ends);
            let row_ends = shares.iter().map(|g| rows(grid, g).end);
            let row_dots = split(&mut dots, row_ends);
            let strips = self.strips.iter_mut();
            let parts = shares.iter().zip(lists).zip(row_dots).zip(strips).map(
                |(((groups, y), dots), strips)| Multiply {
                    grid,
                    own: &self.own,
                    scale: self.scale,
                    x: read(&self.p),
                    part: product::Part {
                        rows: rows(grid, groups),
                        start: grid.slots(groups).start,
                        y,
                        dots,
                        strips,
                    },
                },
            );
            each(parts.collect(), |part| self.arch.dispatch(part));
        }
        let mut sum: f64 = dots.iter().sum();
        for slot in self.loose() {
            let at = place(slot);
            let k: [f32; BLOCK] = std::array::from_fn(|k| self.own[at + k * LANES]);
            let p = [0, 1, 2].map(|c| self.p[c][slot]);
            let q = [
                k[0] * p[0] + k[1] * p[1] + k[2] * p[2],
                k[1] * p[0] + k[3] * p[1] + k[4] * p[2],
                k[2] * p[0] + k[4] * p[1] + k[5] * p[2],
            ];
            for c in 0..3 {
                self.q[c][slot] = q[c];
                sum += f64::from(p[c]) * f64::from(q[c]);
            }
        }
        sum += self.rim.multiply(&self.p, &mut self.q);
        sum + extra.multiply(&self.p, &mut self.q)
    }

    fn loose(&self) -> Range<usize> {
        let count = self.grid.layout.slot.iter();
        let last = count.max().map_or(0, |s| *s as usize + 1);
        self.grid.layout.loose..last.max(self.grid.layout.loose)
    }

    /// `x += α p`, `r −= α q` for knots that are free, `z = M⁻¹ r`; gives r · z.
    fn advance(&mut self, alpha: f64) -> f64 {
        #[allow(clippy::cast_possible_truncation)]
        let alpha = alpha as f32;
        let shares = self.grid.shares();
        let start = self.grid.start();
        let ends: Vec<usize> = shares.iter().map(|g| self.grid.slots(g).end).collect();
        self.columns.resize(shares.len(), Vec::new());
        let mut dots = vec![0.0; self.grid.groups.len()];
        let (grid, threads) = (&self.grid, &self.threads);
        if !grid.groups.is_empty() {
            let x = cut(&mut self.x, start, &ends);
            let r = cut(&mut self.r, start, &ends);
            let z = cut(&mut self.z, start, &ends);
            let group_dots = split(&mut dots, shares.iter().map(|g| g.end));
            let space = self.columns.iter_mut();
            let parts = shares.iter().zip(x).zip(r).zip(z).zip(group_dots).zip(space).map(
                |(((((groups, x), r), z), dots), space)| Advance {
                    grid,
                    threads,
                    alpha,
                    free: &self.free,
                    p: read(&self.p),
                    q: read(&self.q),
                    groups: groups.clone(),
                    x,
                    r,
                    z,
                    dots,
                    space,
                },
            );
            each(parts.collect(), |part| self.arch.dispatch(part));
        }
        for slot in self.loose() {
            for c in 0..3 {
                self.x[c][slot] += alpha * self.p[c][slot];
                self.r[c][slot] -= alpha * self.q[c][slot] * self.free[slot];
                self.z[c][slot] = 0.0;
            }
        }
        let grid = &self.grid;
        let mut rising = vec![0.0; grid.blocks.len()];
        if !grid.blocks.is_empty() {
            let shares = grid.column_shares();
            let block_ends = |width: usize| {
                shares.iter().map(move |b| {
                    let last = grid.blocks[..b.end].last();
                    last.map_or(0, |b| b.first / LANES + b.rows) * width
                })
            };
            let lists = split(&mut self.risen, block_ends(3 * LANES));
            let dots = split(&mut rising, shares.iter().map(|b| b.end));
            let parts = shares.iter().zip(lists).zip(dots).map(|((blocks, z), dots)| Rise {
                grid,
                threads: &self.threads,
                blocks: blocks.clone(),
                r: read(&self.r),
                z,
                dots,
            });
            each(parts.collect(), |part| self.arch.dispatch(part));
        }
        let sum = dots.iter().sum::<f64>() + rising.iter().sum::<f64>();
        sum + self.rim.precondition(&self.r, &mut self.z)
    }

    /// `p = z + β p`.
    fn turn(&mut self, beta: f64) {
        #[allow(clippy::cast_possible_truncation)]
        let beta = beta as f32;
        let shares = self.grid.shares();
        let start = self.grid.start();
        let ends: Vec<usize> = shares.iter().map(|g| self.grid.slots(g).end).collect();
        let grid = &self.grid;
        if !grid.groups.is_empty() {
            let lists = cut(&mut self.p, start, &ends);
            let parts = shares.iter().zip(lists).map(|(groups, p)| Turn {
                grid,
                beta,
                groups: groups.clone(),
                z: read(&self.z),
                risen: &self.risen,
                p,
            });
            each(parts.collect(), |part| self.arch.dispatch(part));
        }
        for slot in self.loose() {
            for c in 0..3 {
                self.p[c][slot] = self.z[c][slot] + beta * self.p[c][slot];
            }
        }
    }

    /// Solves `(A + E) x = b` for the knots that are free; the others keep x = 0. Begins from
    /// `guess`, moved along `way` as far as is best; the better that is, the more exact the answer,
    /// since the aim is a share of the first residual. Gives the solution and the iterations taken.
    pub fn solve(
        &mut self,
        extra: &dyn Extra,
        b: &[Vector3<f64>],
        (guess, way): (&[Vector3<f64>], &[Vector3<f64>]),
        aim: Aim,
    ) -> (Vec<Vector3<f64>>, usize) {
        let mut list = std::mem::take(&mut self.b);
        self.set(b, &mut list);
        self.b = list;
        // How large a residual of nothing done would be.
        let mask = |v: &mut Three, free: &[f32]| {
            for list in v {
                for (v, f) in list.iter_mut().zip(free) {
                    *v *= f;
                }
            }
        };
        for c in 0..3 {
            self.r[c].copy_from_slice(&self.b[c]);
            self.x[c].fill(0.0);
            self.p[c].fill(0.0);
            self.q[c].fill(0.0);
        }
        mask(&mut self.r, &self.free);
        let whole = self.advance(0.0);
        for (start, all) in [(guess, true), (way, false)] {
            let mut list = std::mem::take(&mut self.p);
            self.set(start, &mut list);
            self.p = list;
            mask(&mut self.p, &self.free);
            let stiff = self.multiply(extra);
            let far = if all {
                1.0
            } else if stiff > 0.0 {
                (dot(&self.p, &self.r) / stiff).clamp(0.0, 1.0)
            } else {
                0.0
            };
            #[allow(clippy::cast_possible_truncation)]
            let far = far as f32;
            for c in 0..3 {
                for (x, p) in self.x[c].iter_mut().zip(&self.p[c]) {
                    *x += far * p;
                }
                for ((r, q), f) in self.r[c].iter_mut().zip(&self.q[c]).zip(&self.free) {
                    *r -= far * q * f;
                }
            }
        }
        let mut rz = self.advance(0.0);
        self.turn(0.0);
        let goal = (rz * aim.tolerance * aim.tolerance).max(whole * NOISE * NOISE);
        let mut taken = 0;
        while taken < aim.most && rz > goal {
            let pq = self.multiply(extra);
            if !(pq > 0.0) {
                break;
            }
            let next = self.advance(rz / pq);
            self.turn(next / rz);
            rz = next;
            taken += 1;
        }
        let solution = self.grid.layout.slot.iter().map(|slot| {
            let s = *slot as usize;
            Vector3::new(f64::from(self.x[0][s]), f64::from(self.x[1][s]), f64::from(self.x[2][s]))
        });
        (solution.collect(), taken)
    }
}

/// Rows of a range of groups.
fn rows(grid: &Grid, groups: &Range<usize>) -> Range<usize> {
    match grid.groups[groups.clone()] {
        [] => 0..0,
        [first, ..] => {
            let last = &grid.groups[groups.end - 1];
            first.row..last.row + last.rows
        }
    }
}

#[allow(clippy::cast_possible_truncation)]
fn six(m: &Matrix3<f64>) -> [f32; BLOCK] {
    [m[(0, 0)], m[(0, 1)], m[(0, 2)], m[(1, 1)], m[(1, 2)], m[(2, 2)]].map(|v| v as f32)
}

fn put(blocks: &mut [f32], slot: usize, m: &Matrix3<f64>) {
    let at = place(slot);
    for (k, value) in six(m).into_iter().enumerate() {
        blocks[at + k * LANES] = value;
    }
}

fn dot(a: &Three, b: &Three) -> f64 {
    let list = |a: &[f32], b: &[f32]| -> f64 {
        a.iter().zip(b).map(|(a, b)| f64::from(*a) * f64::from(*b)).sum()
    };
    (0..3).map(|c| list(&a[c], &b[c])).sum()
}

/// A step along p for a part of the groups, and the weft threads of the new residual.
struct Advance<'a, 'b> {
    grid: &'a Grid,
    threads: &'a Threads,
    alpha: f32,
    free: &'a [f32],
    p: [&'a [f32]; 3],
    q: [&'a [f32]; 3],
    groups: Range<usize>,
    x: [&'b mut [f32]; 3],
    r: [&'b mut [f32]; 3],
    z: [&'b mut [f32]; 3],
    dots: &'b mut [f64],
    space: &'b mut Vec<f32>,
}

impl WithSimd for Advance<'_, '_> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: Simd>(mut self, s: S) {
        let alpha = F::splat(s, self.alpha);
        let start = self.grid.slots(&self.groups).start;
        for (number, dots) in self.groups.clone().zip(self.dots) {
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
struct Rise<'a, 'b> {
    grid: &'a Grid,
    threads: &'a Threads,
    blocks: Range<usize>,
    r: [&'a [f32]; 3],
    z: &'b mut [f32],
    dots: &'b mut [f64],
}

impl WithSimd for Rise<'_, '_> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: Simd>(self, s: S) {
        let mut rest = self.z;
        for (block, dots) in self.grid.blocks[self.blocks].iter().zip(self.dots) {
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
struct Turn<'a, 'b> {
    grid: &'a Grid,
    beta: f32,
    groups: Range<usize>,
    z: [&'a [f32]; 3],
    risen: &'a [f32],
    p: [&'b mut [f32]; 3],
}

impl WithSimd for Turn<'_, '_> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: Simd>(self, s: S) {
        let beta = F::splat(s, self.beta);
        let start = self.grid.slots(&self.groups).start;
        let [p0, p1, p2] = self.p;
        for group in &self.grid.groups[self.groups] {
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
