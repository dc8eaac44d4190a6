//! The linear system of an implicit step: its matrix, and the factors of every warp and weft thread
//! with which the gradients solve it.
//!
//! # References
//! Baraff and Witkin 1998 for the step; Hestenes and Stiefel 1952 for the gradients. Threads as
//! preconditioner follow from the grid: the stiff directions of woven cloth are its lines.

mod coarse;
mod gradients;
mod sweep;

use super::cloth::Cloth;
use super::grid::assemble::{Diagonal, Load};
use super::grid::lanes::LANES;
use super::grid::layout::Layout;
use super::grid::product::Three;
use super::grid::strips::Strips;
use super::grid::thread::{FactorWarp, FactorWeft, Threads, split};
use super::grid::{BLOCK, Grid, STIFF};
use super::rim::{Rim, place};
use crate::mesh::compiled::Compiled;
use coarse::Coarse;
use nalgebra::{Matrix3, Vector3};
use pulp::Arch;
use rayon::prelude::*;

/// A symmetric term outside of the cloth, such as the contact of two layers.
pub trait Extra {
    /// `y += E x`, both by slots; gives the scalar product of x with what was added.
    fn multiply(&self, x: &Three, y: &mut Three) -> f64;

    /// The same term for a coarse level: `follows` gives nodes and weights of a slot, `add` takes
    /// the block of two nodes.
    fn gather<'a>(
        &self,
        follows: &dyn Fn(u32) -> &'a [(u32, f32)],
        add: &mut dyn FnMut(u32, u32, [[f32; 3]; 3]),
    );
}

/// Nothing besides the cloth.
impl Extra for () {
    fn multiply(&self, _: &Three, _: &mut Three) -> f64 {
        0.0
    }

    fn gather<'a>(
        &self,
        _: &dyn Fn(u32) -> &'a [(u32, f32)],
        _: &mut dyn FnMut(u32, u32, [[f32; 3]; 3]),
    ) {
    }
}

/// When to stop.
#[derive(Clone, Copy, Debug)]
pub struct Aim {
    /// Share of the first residual, in the preconditioned norm.
    pub tolerance: f64,
    /// Most iterations.
    pub most: usize,
}

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
    x: Three,
    r: Three,
    z: Three,
    /// Solutions of the warp threads, by blocks of columns.
    risen: Vec<f32>,
    p: Three,
    q: Three,
    /// Its coarse level.
    coarse: Coarse,
}

fn three(n: usize) -> Three {
    std::array::from_fn(|_| vec![0.0; n])
}

fn read(v: &Three) -> [&[f32]; 3] {
    [&v[0], &v[1], &v[2]]
}

/// The slots of each part of the rows.
fn cut<'a>(v: &'a mut Three, grid: &Grid) -> Vec<[&'a mut [f32]; 3]> {
    let ends = || grid.parts.iter().map(|p| p.slots.end - grid.start);
    let [a, b, c] = v.each_mut().map(|list| split(&mut list[grid.start..], ends()));
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
            strips: vec![Strips::default(); grid.parts.len()],
            columns: vec![Vec::new(); grid.parts.len()],
            own: vec![0.0; n * BLOCK],
            firm: vec![0.0; n * BLOCK],
            free,
            place: std::array::from_fn(|_| vec![0.0; n]),
            slide: three(n),
            scale: 1.0,
            arch: Arch::new(),
            x: three(n),
            r: three(n),
            z: three(n),
            risen: vec![0.0; risen * 3 * LANES],
            p: three(n),
            q: three(n),
            coarse: Coarse::default(),
            grid,
            rim,
        }
    }

    /// Lays the coarse level over the cloth.
    fn lay_coarse(
        &mut self,
        compiled: &Compiled,
        cloth: &Cloth,
        sewn: impl Iterator<Item = [u32; 2]>,
    ) {
        let springs = cloth.springs.iter().map(|s| s.ends.to_vec());
        let cells = cloth.cells.iter().map(|c| c.corners.to_vec());
        let triangles = cloth.triangles.iter().map(|t| t.corners.to_vec());
        let folds = cloth.folds.iter().map(|f| f.knots[..f.count].to_vec());
        let sewn = sewn.map(|s| s.to_vec());
        let near = springs.chain(cells).chain(triangles).chain(folds).chain(sewn);
        let slot = &self.grid.layout.slot;
        self.coarse = Coarse::new(compiled, &cloth.weld, slot, &self.free, near);
    }

    /// Brings the coarse level up to the matrix in hand, `extra` included, if that is worth it after
    /// a step of so many iterations; `sewn` are pairs of open seams.
    pub fn refresh_coarse(
        &mut self,
        (compiled, cloth): (&Compiled, &Cloth),
        sewn: impl Iterator<Item = [u32; 2]>,
        extra: &dyn Extra,
        iterations: usize,
    ) {
        if !self.coarse.is_due(iterations) {
            return;
        }
        if !self.coarse.is_laid() {
            self.lay_coarse(compiled, cloth, sewn);
        }
        let mut coarse = std::mem::take(&mut self.coarse);
        let (mut p, mut q) = (three(self.free.len()), three(self.free.len()));
        coarse.refresh(self.arch, [&mut p, &mut q], extra, |p, q| {
            std::mem::swap(p, &mut self.p);
            self.multiply(&());
            std::mem::swap(p, &mut self.p);
            std::mem::swap(q, &mut self.q);
        });
        self.coarse = coarse;
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
        self.grid.layout.set(slide, &mut self.slide);
        let mut stiff = std::mem::take(&mut self.grid.stiff);
        let grid = &self.grid;
        let lists = split(
            &mut stiff[grid.start * STIFF..],
            grid.parts.iter().map(|p| (p.slots.end - grid.start) * STIFF),
        );
        let forces = cut(&mut self.q, grid);
        let parts = grid.parts.iter().zip(forces).zip(lists).zip(&mut self.strips).map(
            |(((part, force), stiff), strips)| Load {
                grid,
                scale: single,
                x: [&self.place[0], &self.place[1], &self.place[2]],
                slide: read(&self.slide),
                part,
                force,
                stiff,
                strips,
            },
        );
        each(parts.collect(), |part| self.arch.dispatch(part));
        self.grid.stiff = stiff;
        // Nothing of the grid pulls at loose knots.
        let loose = self.grid.layout.loose_slots();
        self.q.iter_mut().for_each(|list| list[loose.clone()].fill(0.0));
        let mut force = self.grid.layout.get(&self.q);
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
        let mut diagonal = std::mem::take(&mut self.grid.diagonal);
        // Loose knots have no elements in the grid.
        let loose = self.grid.layout.loose * BLOCK;
        diagonal[loose..].copy_from_slice(&self.firm[loose..]);
        let (grid, own, free) = (&self.grid, &self.firm[..], &self.free[..]);
        let lists = split(
            &mut diagonal[grid.start * BLOCK..],
            grid.parts.iter().map(|p| (p.slots.end - grid.start) * BLOCK),
        );
        let parts = grid.parts.iter().zip(lists).map(|(part, diagonal)| Diagonal {
            grid,
            own,
            free,
            scale: self.scale,
            part,
            diagonal,
        });
        each(parts.collect(), |part| self.arch.dispatch(part));
        self.grid.diagonal = diagonal;
        let grid = &self.grid;
        let lists = self.threads.weft_parts(&grid.parts);
        let parts = grid.parts.iter().zip(lists);
        let parts = parts.map(|(part, links)| FactorWeft { grid, free, part, links });
        each(parts.collect(), |part| self.arch.dispatch(part));
        let lists = self.threads.warp_parts(&grid.columns);
        let parts = grid.columns.iter().zip(lists);
        let parts = parts.map(|(columns, links)| FactorWarp { grid, free, columns, links });
        each(parts.collect(), |part| self.arch.dispatch(part));
        self.rim.refresh(&self.grid.diagonal, &self.free);
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
