//! The irregular part of a cloth: bands along cut edges, seams, folds across them, open seams. A sparse
//! matrix over the knots that any such element touches.

use super::cloth::Cloth;
use super::elastic;
use super::grid::lanes::LANES;
use super::grid::layout::Layout;
use super::grid::{BLOCK, Taken};
use super::matrix::{Lane, Matrix, Pattern};
use super::precondition::Factor;
use nalgebra::Vector3;

/// The irregular part.
#[derive(Clone, Debug, Default)]
pub struct Rim {
    /// Its knots, ascending.
    pub knots: Vec<u32>,
    /// Their slots.
    slots: Vec<u32>,
    /// Its stiffness, over its knots in order.
    pub matrix: Matrix,
    factor: Factor,
    /// Number in `knots` of each knot; `u32::MAX` for others.
    number: Vec<u32>,
    x: Vec<Lane>,
    y: Vec<Lane>,
    held: Vec<bool>,
}

impl Rim {
    /// The rim of a cloth of which a grid has taken up the rest; `sewn` are pairs of open seams.
    pub fn new(cloth: &mut Cloth, taken: &Taken, layout: &Layout, sewn: &[[u32; 2]]) -> Self {
        let slot = &layout.slot;
        let pairs = cloth.leave(taken, sewn);
        let mut knots: Vec<u32> = pairs.iter().flatten().copied().collect();
        // A knot that stands in no grid is solved for here even if nothing but mass is at it.
        let loose = |k: &u32| slot[*k as usize] as usize >= layout.loose;
        knots.extend((0..slot.len() as u32).filter(loose));
        knots.sort_unstable();
        knots.dedup();
        let mut number = vec![u32::MAX; slot.len()];
        for (i, k) in knots.iter().enumerate() {
            number[*k as usize] = i as u32;
        }
        let at = |k: u32| number[k as usize];
        let pattern = Pattern::new(knots.len(), pairs.iter().map(|p| p.map(at)));
        cloth.lay_out(&pattern, &number);
        let matrix = Matrix::new(pattern);
        let n = knots.len();
        Rim {
            slots: knots.iter().map(|k| slot[*k as usize]).collect(),
            factor: Factor::new(&matrix),
            matrix,
            number,
            knots,
            x: vec![[0.0; 4]; n],
            y: vec![[0.0; 4]; n],
            held: vec![false; n],
        }
    }

    /// Place of a pair of knots in the matrix.
    pub fn slot(&self, a: u32, b: u32) -> Option<u32> {
        let [a, b] = [a, b].map(|k| self.number[k as usize]);
        if a == u32::MAX || b == u32::MAX { None } else { self.matrix.pattern.slot(a, b) }
    }

    /// Sets the stiffness to that of the loose elements and adds their forces.
    pub fn assemble(
        &mut self,
        cloth: &Cloth,
        x: &[Vector3<f64>],
        scale: f64,
        f: &mut [Vector3<f64>],
    ) {
        elastic::assemble(cloth, &self.knots, x, scale, &mut self.matrix, f);
    }

    /// Sums up the diagonal and adds it to the blocks of all slots.
    pub fn close(&mut self, blocks: &mut [f32]) {
        self.matrix.close();
        for (slot, d) in self.slots.iter().zip(&self.matrix.diagonal) {
            let at = place(*slot as usize);
            let six = [d[0][0], d[0][1], d[0][2], d[1][1], d[1][2], d[2][2]];
            for (k, value) in six.into_iter().enumerate() {
                blocks[at + k * LANES] += value;
            }
        }
    }

    /// Factors the matrix with the whole diagonal of all slots.
    pub fn refresh(&mut self, diagonal: &[f32], free: &[f32]) {
        for ((slot, d), held) in
            self.slots.iter().zip(&mut self.matrix.diagonal).zip(&mut self.held)
        {
            *held = free[*slot as usize] == 0.0;
            if *held {
                // The grid knows nothing of a held knot; its neighbours' stiffness needs one to match.
                *d = d.map(|column| column.map(|v| 1.5 * v));
                for l in 0..3 {
                    d[l][l] += 1.0;
                }
                continue;
            }
            let at = place(*slot as usize);
            let k: [f32; BLOCK] = std::array::from_fn(|k| diagonal[at + k * LANES]);
            *d = [[k[0], k[1], k[2], 0.0], [k[1], k[3], k[4], 0.0], [k[2], k[4], k[5], 0.0]];
        }
        self.factor.refresh(&self.matrix);
    }

    fn gather(&mut self, x: &[Vec<f32>; 3]) {
        for (slot, l) in self.slots.iter().zip(&mut self.x) {
            let s = *slot as usize;
            *l = [x[0][s], x[1][s], x[2][s], 0.0];
        }
    }

    fn scatter(&self, y: &mut [Vec<f32>; 3]) {
        for (slot, l) in self.slots.iter().zip(&self.y) {
            for k in 0..3 {
                y[k][*slot as usize] += l[k];
            }
        }
    }

    /// `y += A x`; gives the scalar product of x with what was added.
    pub fn multiply(&mut self, x: &[Vec<f32>; 3], y: &mut [Vec<f32>; 3]) -> f64 {
        if self.knots.is_empty() {
            return 0.0;
        }
        self.gather(x);
        self.matrix.multiply(&self.x, &mut self.y);
        self.scatter(y);
        dot(&self.x, &self.y)
    }

    /// `z += M⁻¹ r`; gives the scalar product of r with what was added.
    pub fn precondition(&mut self, r: &[Vec<f32>; 3], z: &mut [Vec<f32>; 3]) -> f64 {
        if self.knots.is_empty() {
            return 0.0;
        }
        self.gather(r);
        self.factor.solve(&self.x, &mut self.y);
        for (y, held) in self.y.iter_mut().zip(&self.held) {
            if *held {
                *y = [0.0; 4];
            }
        }
        self.scatter(z);
        dot(&self.x, &self.y)
    }
}

/// Where the block of a slot begins in a list by chunks.
pub fn place(slot: usize) -> usize {
    slot / LANES * LANES * BLOCK + slot % LANES
}

fn dot(a: &[Lane], b: &[Lane]) -> f64 {
    let products = a
        .iter()
        .zip(b)
        .map(|(a, b)| (0..3).map(|l| f64::from(a[l]) * f64::from(b[l])).sum::<f64>());
    products.sum()
}
