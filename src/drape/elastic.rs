//! The cloth's own forces and stiffness, gathered in the system matrix.

use super::bending::Fold;
use super::cloth::Cloth;
use super::matrix::{Matrix, ROWS, add, add_scalar};
use super::shear::ENDS;
use nalgebra::{Matrix3, Vector3};
use rayon::prelude::*;

/// Where the knots are, m.
pub type Places = [Vector3<f64>];

/// Elastic energy, J: tension, shear and bending of the whole cloth.
pub fn energy(cloth: &Cloth, x: &Places) -> f64 {
    let at = |k: u32| x[k as usize];
    let springs: f64 = cloth.springs.iter().map(|s| s.energy(&at(s.ends[0]), &at(s.ends[1]))).sum();
    let cells: f64 = cloth.cells.iter().map(|c| c.energy(&c.corners.map(at))).sum();
    let triangles: f64 = cloth.triangles.iter().map(|t| t.energy(&t.corners.map(at))).sum();
    let folds: f64 = cloth
        .folds
        .iter()
        .zip(0..)
        .map(|(f, number)| {
            let bend = f.bend(x);
            let blunt = number < cloth.regular[2] || f.creased;
            let sharp = if blunt { 1.0 } else { Fold::sharpness(&bend) };
            0.5 * f.stiffness * bend.norm_squared() * sharp
        })
        .sum();
    let creases: f64 = cloth.creases.iter().map(|crease| crease.energy(x)).sum();
    springs + cells + triangles + folds + creases
}

/// Sets the blocks off the diagonal of `matrix`, which is over the given knots, to the stiffness of
/// the rim's elements times `scale`, and adds their forces.
pub fn assemble(
    cloth: &Cloth,
    knots: &[u32],
    x: &Places,
    scale: f64,
    matrix: &mut Matrix,
    force: &mut [Vector3<f64>],
) {
    bend(cloth, knots, x, scale, matrix, force);
    let [springs, cells, _] = cloth.regular;
    let (rim_springs, rim_cells) = (&cloth.springs[springs..], &cloth.cells[cells..]);
    let at = |k: u32| x[k as usize];
    let springs: Vec<_> = rim_springs
        .par_iter()
        .with_min_len(ROWS)
        .map(|s| {
            let (f, k) = s.pull(&at(s.ends[0]), &at(s.ends[1]));
            (f, k * scale)
        })
        .collect();
    for (s, (f, k)) in rim_springs.iter().zip(&springs) {
        let [a, b] = s.ends.map(|k| k as usize);
        let Some([ab, ba]) = s.slots else { continue };
        force[a] += f;
        force[b] -= f;
        let k = -k;
        add(&mut matrix.off[ab as usize], &k);
        add(&mut matrix.off[ba as usize], &k);
    }
    let loads: Vec<_> = rim_cells
        .par_iter()
        .with_min_len(ROWS)
        .map(|c| {
            let mut load = c.load(&c.corners.map(at));
            for k in &mut load.stiffness {
                *k *= scale;
            }
            load
        })
        .collect();
    for (c, load) in rim_cells.iter().zip(&loads) {
        let crossed = load.stiffness[2].transpose();
        let mut slots = c.slots.iter();
        for (i, (di, si)) in ENDS.into_iter().enumerate() {
            let knot = c.corners[i] as usize;
            force[knot] += load.force[di] * si;
            for (j, (dj, sj)) in ENDS.into_iter().enumerate() {
                if i == j {
                    continue;
                }
                let k = match (di, dj) {
                    (0, 1) => &load.stiffness[2],
                    (1, 0) => &crossed,
                    (d, _) => &load.stiffness[d],
                };
                place(matrix, slots.next(), &(k * (si * sj)));
            }
        }
    }
    let loads: Vec<_> = cloth
        .triangles
        .par_iter()
        .with_min_len(ROWS)
        .map(|t| {
            let (f, mut k) = t.load(&t.corners.map(at));
            for k in &mut k {
                *k *= scale;
            }
            (f, k)
        })
        .collect();
    for (t, (f, k)) in cloth.triangles.iter().zip(&loads) {
        let mut slots = t.slots.iter();
        for i in 0..3 {
            let knot = t.corners[i] as usize;
            force[knot] += f[i];
            for j in (0..3).filter(|&j| j != i) {
                let block = &k[2 + i + j];
                let block = if i < j { *block } else { block.transpose() };
                place(matrix, slots.next(), &block);
            }
        }
    }
}

/// Adds a block off the diagonal. There is none between corners that a weld has made one knot.
fn place(matrix: &mut Matrix, slot: Option<&Option<u32>>, k: &Matrix3<f64>) {
    if let Some(&Some(slot)) = slot {
        add(&mut matrix.off[slot as usize], k);
    }
}

/// Bending: its stiffness never changes, its force is the stiffness times the places.
fn bend(
    cloth: &Cloth,
    knots: &[u32],
    x: &Places,
    scale: f64,
    matrix: &mut Matrix,
    force: &mut [Vector3<f64>],
) {
    let pattern = &matrix.pattern;
    matrix.off.par_iter_mut().zip(&cloth.fold_off).with_min_len(ROWS).for_each(|(block, s)| {
        *block = [[0.0; 4]; 3];
        add_scalar(block, s * scale);
    });
    let bent: Vec<Vector3<f64>> = knots
        .par_iter()
        .enumerate()
        .with_min_len(ROWS)
        .map(|(i, knot)| {
            // Differences to the knot itself, so that the far place of the cloth does not count.
            let range = pattern.row(i);
            let here = x[*knot as usize];
            let mut sum = Vector3::zeros();
            for (s, &j) in cloth.fold_off[range.clone()].iter().zip(&pattern.columns()[range]) {
                sum += (x[knots[j as usize] as usize] - here) * *s;
            }
            sum
        })
        .collect();
    for (knot, sum) in knots.iter().zip(bent) {
        force[*knot as usize] -= sum;
    }
    sharpen(cloth, knots, x, scale, matrix, force);
}

/// What sharp folds of the rim resist more than their linear terms say; see [`Fold::firmness`].
fn sharpen(
    cloth: &Cloth,
    knots: &[u32],
    x: &Places,
    scale: f64,
    matrix: &mut Matrix,
    force: &mut [Vector3<f64>],
) {
    let folds = &cloth.folds[cloth.regular[2]..];
    let bent: Vec<Vector3<f64>> =
        folds.par_iter().with_min_len(ROWS).map(|fold| fold.bend(x)).collect();
    let row = |knot: u32| knots.binary_search(&knot).map_or(u32::MAX, |i| i as u32);
    for (fold, bend) in folds.iter().zip(bent) {
        let more = fold.stiffness * (Fold::firmness(&bend) - 1.0);
        if fold.creased || more < 1e-3 * fold.stiffness {
            continue;
        }
        for (i, wi) in fold.terms() {
            force[i as usize] -= bend * (more * wi);
            for (j, wj) in fold.terms().filter(|(j, _)| *j != i) {
                if let Some(slot) = matrix.pattern.slot(row(i), row(j)) {
                    add_scalar(&mut matrix.off[slot as usize], more * wi * wj * scale);
                }
            }
        }
    }
}
