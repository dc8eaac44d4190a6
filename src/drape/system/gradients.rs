//! Conjugate gradients (Hestenes and Stiefel 1952), preconditioned with the sum of all warp and weft
//! threads solved exactly, of an incomplete factor of the rim, and of the coarse level.

use super::sweep::{Advance, Rise, Turn};
use super::{Aim, Extra, System, cut, each, read};
use crate::drape::grid::BLOCK;
use crate::drape::grid::lanes::LANES;
use crate::drape::grid::product::{Multiply, Three};
use crate::drape::grid::thread::split;
use crate::drape::rim::place;
use nalgebra::Vector3;

/// A residual this small against the right-hand side is noise of single precision.
const NOISE: f64 = 1e-6;

impl System {
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
        for list in [&mut self.x, &mut self.p, &mut self.q] {
            list.iter_mut().for_each(|l| l.fill(0.0));
        }
        self.grid.layout.set(b, &mut self.r);
        mask(&mut self.r, &self.free);
        // How large a residual of nothing done would be.
        let whole = self.advance(0.0);
        for (start, all) in [(guess, true), (way, false)] {
            self.grid.layout.set(start, &mut self.p);
            mask(&mut self.p, &self.free);
            let stiff = self.multiply(extra);
            let best = if stiff > 0.0 { dot(&self.p, &self.r) / stiff } else { 0.0 };
            self.step(if all { 1.0 } else { best.clamp(0.0, 1.0) });
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
        (self.grid.layout.get(&self.x), taken)
    }

    /// `q = A p`; gives p · q.
    pub(super) fn multiply(&mut self, extra: &dyn Extra) -> f64 {
        let grid = &self.grid;
        let mut dots = vec![0.0; grid.layout.rows.len()];
        let lists = cut(&mut self.q, grid);
        let row_dots = split(&mut dots, grid.parts.iter().map(|p| p.rows.end));
        let parts = grid.parts.iter().zip(lists).zip(row_dots).zip(&mut self.strips).map(
            |(((part, y), dots), strips)| Multiply {
                grid,
                own: &self.own,
                scale: self.scale,
                x: read(&self.p),
                part,
                y,
                dots,
                strips,
            },
        );
        each(parts.collect(), |part| self.arch.dispatch(part));
        let mut sum: f64 = dots.iter().sum();
        for slot in grid.layout.loose_slots() {
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

    /// `x += α p`, `r −= α q` for knots that are free.
    fn step(&mut self, alpha: f64) {
        #[allow(clippy::cast_possible_truncation)]
        let alpha = alpha as f32;
        for c in 0..3 {
            for (x, p) in self.x[c].iter_mut().zip(&self.p[c]) {
                *x += alpha * p;
            }
            for ((r, q), f) in self.r[c].iter_mut().zip(&self.q[c]).zip(&self.free) {
                *r -= alpha * q * f;
            }
        }
    }

    /// The same and `z = M⁻¹ r`; gives r · z.
    fn advance(&mut self, alpha: f64) -> f64 {
        #[allow(clippy::cast_possible_truncation)]
        let alpha = alpha as f32;
        let grid = &self.grid;
        let mut dots = vec![0.0; grid.groups.len()];
        let lists = cut(&mut self.x, grid).into_iter().zip(cut(&mut self.r, grid));
        let lists = lists.zip(cut(&mut self.z, grid));
        let group_dots = split(&mut dots, grid.parts.iter().map(|p| p.groups.end));
        let parts = grid.parts.iter().zip(lists).zip(group_dots).zip(&mut self.columns).map(
            |(((part, ((x, r), z)), dots), space)| Advance {
                grid,
                threads: &self.threads,
                alpha,
                free: &self.free,
                p: read(&self.p),
                q: read(&self.q),
                part,
                x,
                r,
                z,
                dots,
                space,
            },
        );
        each(parts.collect(), |part| self.arch.dispatch(part));
        for slot in grid.layout.loose_slots() {
            for c in 0..3 {
                self.x[c][slot] += alpha * self.p[c][slot];
                self.r[c][slot] -= alpha * self.q[c][slot] * self.free[slot];
                self.z[c][slot] = 0.0;
            }
        }
        let mut rising = vec![0.0; grid.blocks.len()];
        let lists = split(&mut self.risen, grid.columns.iter().map(|c| c.end * 3 * LANES));
        let block_dots = split(&mut rising, grid.columns.iter().map(|c| c.blocks.end));
        let parts = grid.columns.iter().zip(lists).zip(block_dots).map(|((columns, z), dots)| {
            Rise { grid, threads: &self.threads, columns, r: read(&self.r), z, dots }
        });
        each(parts.collect(), |part| self.arch.dispatch(part));
        let sum = dots.iter().sum::<f64>() + rising.iter().sum::<f64>();
        let sum = sum + self.rim.precondition(&self.r, &mut self.z);
        sum + self.coarse.precondition(self.arch, &self.r, &mut self.z)
    }

    /// `p = z + β p`.
    fn turn(&mut self, beta: f64) {
        #[allow(clippy::cast_possible_truncation)]
        let beta = beta as f32;
        let grid = &self.grid;
        let parts = grid.parts.iter().zip(cut(&mut self.p, grid));
        let parts = parts.map(|(part, p)| Turn {
            grid,
            beta,
            part,
            z: read(&self.z),
            risen: &self.risen,
            p,
        });
        each(parts.collect(), |part| self.arch.dispatch(part));
        for slot in grid.layout.loose_slots() {
            for c in 0..3 {
                self.p[c][slot] = self.z[c][slot] + beta * self.p[c][slot];
            }
        }
    }
}

fn mask(v: &mut Three, free: &[f32]) {
    for list in v {
        for (v, f) in list.iter_mut().zip(free) {
            *v *= f;
        }
    }
}

fn dot(a: &Three, b: &Three) -> f64 {
    let list = |a: &[f32], b: &[f32]| -> f64 {
        a.iter().zip(b).map(|(a, b)| f64::from(*a) * f64::from(*b)).sum()
    };
    (0..3).map(|c| list(&a[c], &b[c])).sum()
}
