//! Movements of whole stretches of cloth: a second, coarse level for the gradients. Warp and weft
//! threads see what is stiff, this sees what is wide: how a skirt swings or a sleeve turns as a
//! whole takes the threads alone hundreds of iterations to find out.
//!
//! Over every panel lies a coarse lattice; a knot follows the four nodes round it by bilinear
//! weights, a sewn knot those of all its panels in equal shares. The matrix of the nodes is PᵀAP
//! (Galerkin), its inverse is added to the preconditioner (additive Schwarz, Dryja and
//! Widlund 1987).

use super::Extra;
use crate::drape::grid::product::Three;
use crate::drape::weld::Weld;
use crate::mesh::compiled::Compiled;
use pulp::Arch;
use std::collections::{BTreeMap, BTreeSet};

/// Most nodes: the factor has the square of it.
const MOST: usize = 160;

/// More nodes than this, of very many small pieces, are not worth their factor: there is no coarse
/// level then.
const TOO_MANY: usize = 2 * MOST;

/// Least distance of nodes, in cells.
const LEAST: f64 = 6.0;

/// A node whose knots together follow it less than this is left out.
const SLIGHT: f32 = 0.5;

/// Iterations of a step that are worth a coarse level.
const EFFORT: usize = 25;

/// Steps for which it is kept, the matrix changing slowly.
const KEPT: usize = 10;

/// The coarse level of a cloth.
#[derive(Clone, Debug, Default)]
pub struct Coarse {
    /// Whether it has been laid over the cloth.
    laid: bool,
    follows: Follows,
    /// Nodes whose neighbourhoods do not meet, colour by colour, with each slot's one of them.
    colours: Vec<Colour>,
    nodes: usize,
    /// Rows of the lower factor, one after the other in full.
    lower: Vec<f32>,
    ready: bool,
    right: Vec<f32>,
    /// Steps since it was factored.
    age: usize,
}

/// Which nodes the knots follow.
#[derive(Clone, Debug, Default)]
struct Follows {
    /// Slots of the knots, ascending.
    slots: Vec<u32>,
    /// Where the nodes of each begin, and the end.
    start: Vec<u32>,
    /// Nodes and weights.
    nodes: Vec<(u32, f32)>,
}

impl Follows {
    fn of(&self, i: usize) -> &[(u32, f32)] {
        &self.nodes[self.start[i] as usize..self.start[i + 1] as usize]
    }

    /// Nodes of a slot.
    fn at(&self, slot: u32) -> &[(u32, f32)] {
        self.slots.binary_search(&slot).map_or(&[], |i| self.of(i))
    }
}

#[derive(Clone, Debug, Default)]
struct Colour {
    /// Slot, node, weight of what is moved.
    moved: Vec<(u32, u32, f32)>,
    /// Slot and node of what may feel it.
    felt: Vec<(u32, u32)>,
}

impl Coarse {
    /// The coarse level over the free knots of a cloth. `slot` is the place of each knot, `near`
    /// are groups of knots that feel each other directly.
    pub fn new(
        compiled: &Compiled,
        weld: &Weld,
        slot: &[u32],
        free: &[f32],
        near: impl Iterator<Item = Vec<u32>>,
    ) -> Self {
        let cells = compiled.cells.len().max(1) as f64;
        let step = LEAST.max((cells / MOST as f64).sqrt() * 1.25);
        let mut numbers: BTreeMap<(usize, i64, i64), u32> = BTreeMap::new();
        let mut shares: Vec<BTreeMap<u32, f64>> = vec![BTreeMap::new(); weld.count];
        let mut count = vec![0u32; weld.count];
        for (panel, p) in compiled.panels.iter().enumerate() {
            let side = step * p.cell;
            for k in p.particles.range() {
                let knot = weld.knot[k] as usize;
                count[knot] += 1;
                let at = compiled.particles[k].map(|c| c / side);
                let low = at.map(f64::floor);
                let part = [at[0] - low[0], at[1] - low[1]];
                for (i, j) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
                    let weight = [i, j]
                        .iter()
                        .zip(part)
                        .fold(1.0, |w, (far, t)| w * if *far == 1 { t } else { 1.0 - t });
                    if weight > 0.0 {
                        let key = (panel, low[0] as i64 + i, low[1] as i64 + j);
                        let next = numbers.len() as u32;
                        let node = *numbers.entry(key).or_insert(next);
                        *shares[knot].entry(node).or_default() += weight;
                    }
                }
            }
        }
        // What hardly anything follows is left out, the others are counted anew.
        let mut weight = vec![0.0f32; numbers.len()];
        for (knot, share) in shares.iter().enumerate() {
            for (node, w) in share {
                weight[*node as usize] +=
                    (*w as f32) / count[knot] as f32 * free[slot[knot] as usize];
            }
        }
        let mut nodes = 0;
        let number: Vec<Option<u32>> = weight
            .iter()
            .map(|w| {
                (*w > SLIGHT).then(|| {
                    nodes += 1;
                    nodes - 1
                })
            })
            .collect();
        let nodes = nodes as usize;
        if nodes > TOO_MANY {
            return Coarse { laid: true, ..Coarse::default() };
        }
        let mut lists: Vec<(u32, Vec<(u32, f32)>)> = Vec::new();
        let mut support: Vec<Vec<(u32, f32)>> = vec![Vec::new(); nodes];
        for (knot, share) in shares.iter().enumerate() {
            if free[slot[knot] as usize] == 0.0 {
                continue;
            }
            let of: Vec<(u32, f32)> = share
                .iter()
                .filter_map(|(node, w)| {
                    Some((number[*node as usize]?, *w as f32 / count[knot] as f32))
                })
                .collect();
            for (node, w) in &of {
                support[*node as usize].push((knot as u32, *w));
            }
            if !of.is_empty() {
                lists.push((slot[knot], of));
            }
        }
        lists.sort_by_key(|l| l.0);
        let mut follows = Follows { start: vec![0], ..Follows::default() };
        for (slot, of) in lists {
            follows.slots.push(slot);
            follows.nodes.extend(of);
            follows.start.push(follows.nodes.len() as u32);
        }
        // Which knots feel which: those of a common element.
        let mut felt: Vec<Vec<u32>> = vec![Vec::new(); weld.count];
        for group in near {
            for a in &group {
                felt[*a as usize].extend(group.iter().filter(|b| *b != a));
            }
        }
        for list in &mut felt {
            list.sort_unstable();
            list.dedup();
        }
        let mut colours: Vec<(Colour, Vec<bool>)> = Vec::new();
        for (node, knots) in support.iter().enumerate() {
            let reach: BTreeSet<u32> = knots
                .iter()
                .flat_map(|(k, _)| std::iter::once(*k).chain(felt[*k as usize].iter().copied()))
                .collect();
            let fits = colours
                .iter()
                .position(|(_, taken)| !reach.iter().any(|k| taken[*k as usize]))
                .unwrap_or_else(|| {
                    colours.push((Colour::default(), vec![false; weld.count]));
                    colours.len() - 1
                });
            let (colour, taken) = &mut colours[fits];
            for k in &reach {
                taken[*k as usize] = true;
                colour.felt.push((slot[*k as usize], node as u32));
            }
            let moved = knots.iter().map(|(k, w)| (slot[*k as usize], node as u32, *w));
            colour.moved.extend(moved);
        }
        Coarse {
            laid: true,
            follows,
            colours: colours.into_iter().map(|c| c.0).collect(),
            nodes,
            lower: Vec::new(),
            ready: false,
            right: vec![0.0; 3 * nodes],
            age: 0,
        }
    }

    /// Whether it has been laid over the cloth: a cloth that is solved without effort goes without.
    pub fn is_laid(&self) -> bool {
        self.laid
    }

    /// Counts a step, the last of which took some iterations; whether the level is to be made anew.
    pub fn is_due(&mut self, iterations: usize) -> bool {
        self.age += 1;
        iterations > EFFORT && (!self.laid || self.age >= KEPT)
    }

    /// Makes the matrix of the nodes and factors it. `multiply` gives the product of the system's
    /// matrix with a vector by slots; `extra` are further terms.
    pub fn refresh(
        &mut self,
        arch: Arch,
        [p, q]: [&mut Three; 2],
        extra: &dyn Extra,
        mut multiply: impl FnMut(&mut Three, &mut Three),
    ) {
        let n = 3 * self.nodes;
        let mut matrix = vec![0.0f64; n * n];
        for colour in &self.colours {
            for c in 0..3 {
                p.iter_mut().for_each(|list| list.fill(0.0));
                for (slot, _, w) in &colour.moved {
                    p[c][*slot as usize] = *w;
                }
                multiply(p, q);
                for (slot, node) in &colour.felt {
                    let column = 3 * *node as usize + c;
                    for (other, w) in self.follows.at(*slot) {
                        for d in 0..3 {
                            let row = 3 * *other as usize + d;
                            matrix[row * n + column] += f64::from(w * q[d][*slot as usize]);
                        }
                    }
                }
            }
        }
        extra.gather(&|slot| self.follows.at(slot), &mut |i, j, block| {
            for (d, line) in block.iter().enumerate() {
                for (c, value) in line.iter().enumerate() {
                    matrix[(3 * i as usize + d) * n + 3 * j as usize + c] += f64::from(*value);
                }
            }
        });
        self.ready = arch.dispatch(|| factor(&mut matrix, n));
        self.age = 0;
        self.lower.clear();
        #[allow(clippy::cast_possible_truncation)]
        self.lower.extend(matrix.iter().map(|v| *v as f32));
    }

    /// `z += P (PᵀAP)⁻¹ Pᵀ r`; gives the scalar product of r with what was added.
    pub fn precondition(&mut self, arch: Arch, r: &Three, z: &mut Three) -> f64 {
        if !self.ready {
            return 0.0;
        }
        let Coarse { follows, right, lower, .. } = self;
        arch.dispatch(|| {
            right.fill(0.0);
            for (i, slot) in follows.slots.iter().enumerate() {
                let s = *slot as usize;
                let v = [r[0][s], r[1][s], r[2][s]];
                for (node, w) in follows.of(i) {
                    for (x, v) in right[3 * *node as usize..][..3].iter_mut().zip(v) {
                        *x += w * v;
                    }
                }
            }
            let before = right.clone();
            solve(lower, right);
            for (i, slot) in follows.slots.iter().enumerate() {
                let mut sum = [0.0; 3];
                for (node, w) in follows.of(i) {
                    for (x, v) in sum.iter_mut().zip(&right[3 * *node as usize..][..3]) {
                        *x += w * v;
                    }
                }
                for (list, x) in z.iter_mut().zip(sum) {
                    list[*slot as usize] += x;
                }
            }
            before.iter().zip(right.iter()).map(|(a, b)| f64::from(*a) * f64::from(*b)).sum()
        })
    }
}

/// Solves with the lower factor and its transpose.
#[inline(always)]
fn solve(lower: &[f32], x: &mut [f32]) {
    let n = x.len();
    for i in 0..n {
        let row = &lower[i * n..i * n + i + 1];
        x[i] = (x[i] - dot32(&row[..i], &x[..i])) / row[i];
    }
    for i in (0..n).rev() {
        let row = &lower[i * n..i * n + i + 1];
        let value = x[i] / row[i];
        x[i] = value;
        for (x, l) in x[..i].iter_mut().zip(row) {
            *x -= value * l;
        }
    }
}

/// Cholesky factor in place of the lower triangle; whether there is one.
#[inline(always)]
fn factor(matrix: &mut [f64], n: usize) -> bool {
    for i in 0..n {
        let (above, here) = matrix.split_at_mut(i * n);
        let row = &mut here[..n];
        for j in 0..i {
            let other = &above[j * n..j * n + j + 1];
            row[j] = (row[j] - dot64(&row[..j], &other[..j])) / other[j];
        }
        let own = row[i] - dot64(&row[..i], &row[..i]);
        if !(own > 0.0) {
            return false;
        }
        row[i] = own.sqrt();
    }
    n > 0
}

/// Scalar product as eight sums side by side, always in the same order.
#[inline(always)]
fn dot64(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0f64; 8];
    let (left, right) = (a.chunks_exact(8), b.chunks_exact(8));
    let rest: f64 = left.remainder().iter().zip(right.remainder()).map(|(a, b)| a * b).sum();
    for (a, b) in left.zip(right) {
        for k in 0..8 {
            sums[k] += a[k] * b[k];
        }
    }
    sums.iter().sum::<f64>() + rest
}

/// The same in single precision, sixteen at a time.
#[inline(always)]
fn dot32(a: &[f32], b: &[f32]) -> f32 {
    let mut sums = [0.0f32; 16];
    let (left, right) = (a.chunks_exact(16), b.chunks_exact(16));
    let rest: f32 = left.remainder().iter().zip(right.remainder()).map(|(a, b)| a * b).sum();
    for (a, b) in left.zip(right) {
        for k in 0..16 {
            sums[k] += a[k] * b[k];
        }
    }
    sums.iter().sum::<f32>() + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The factor of the second differences of 40 knots held at both ends, plus one: the solution
    /// of a right-hand side made from a known one is that, to single precision.
    #[test]
    fn a_factor_gives_back_the_solution() {
        let n = 40;
        let mut matrix = vec![0.0; n * n];
        for i in 0..n {
            matrix[i * n + i] = 3.0;
            if i > 0 {
                matrix[i * n + i - 1] = -1.0;
                matrix[(i - 1) * n + i] = -1.0;
            }
        }
        let known: Vec<f32> = (0..n).map(|i| (i % 7) as f32 - 3.0).collect();
        let mut x: Vec<f32> =
            (0..n).map(|i| (0..n).map(|j| matrix[i * n + j] as f32 * known[j]).sum()).collect();
        assert!(factor(&mut matrix, n));
        let lower: Vec<f32> = matrix.iter().map(|v| *v as f32).collect();
        solve(&lower, &mut x);
        assert!(x.iter().zip(&known).all(|(x, k)| (x - k).abs() < 1e-5), "{x:?}");
        assert!(!factor(&mut [-1.0], 1), "no factor of what is not positive");
    }
}
