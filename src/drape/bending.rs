//! Bending along warp and weft, twist, and bending across the edges of bands and seams.
//!
//! Cloth hardly stretches, and then the curvature is a linear function of the positions: every
//! term here is ½ s |Σ cᵢ xᵢ|² with fixed weights that add up to zero, so the stiffness never
//! changes (Bergou, Wardetzky, Harmon, Zorin and Grinspun 2006).
//!
//! - Between two cells of the grid that share an edge, the second difference of the three knots
//!   along each of the two lines that cross it: ½ B κ² on half of the cell's width.
//! - In a cell, the mixed difference: the energy B(1 − ν) κ²_uv of a plate, with the mean of B.
//! - Across any other edge with a face on both sides, a hinge: ½ B |e|² / (A₁ + A₂) θ², exact for
//!   a strip of equal triangles bent across their edges (Seung and Nelson 1988 for equilateral
//!   ones), where a cell counts as the triangle whose tip is the middle of its far edge.

use super::crease::Crease;
use super::doubled;
use super::weld::Weld;
use crate::mesh::compiled::Compiled;
use nalgebra::Vector3;
use std::collections::BTreeMap;

/// One term of bending.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fold {
    /// Knots, the first `count` of them used.
    pub knots: [u32; 6],
    /// Their weights, 1/m.
    pub weights: [f64; 6],
    /// How many.
    pub count: usize,
    /// Stiffness s, N·m.
    pub stiffness: f64,
    /// Whether the cloth is creased here; see [`super::crease`].
    pub creased: bool,
}

impl Fold {
    fn new(terms: &[(u32, f64)], stiffness: f64) -> Self {
        let mut fold =
            Fold { knots: [0; 6], weights: [0.0; 6], count: 0, stiffness, creased: false };
        for &(knot, weight) in terms {
            match fold.knots[..fold.count].iter().position(|&k| k == knot) {
                Some(same) => fold.weights[same] += weight,
                None if fold.count < 6 => {
                    fold.knots[fold.count] = knot;
                    fold.weights[fold.count] = weight;
                    fold.count += 1;
                }
                None => {}
            }
        }
        fold
    }

    /// How far it is bent, Σ cᵢ xᵢ: twice the sine of half the angle for one that is not stretched.
    pub fn bend(&self, x: &[Vector3<f64>]) -> Vector3<f64> {
        self.terms().fold(Vector3::zeros(), |sum, (k, w)| sum + x[k as usize] * w)
    }

    /// By how much the energy of a fold is greater than ½ s |Σ cᵢ xᵢ|²: to its angle θ belongs
    /// 2 s tan² θ/2 (Grinspun, Hirani, Desbrun and Schröder 2003, in the form of Tamstorf and
    /// Grinspun 2013), which lets no fold lie flat on itself, where the linear term for all its
    /// size has lost its grip.
    pub fn sharpness(bend: &Vector3<f64>) -> f64 {
        let square = bend.norm_squared() / 4.0;
        if square <= SHARPEST {
            return 1.0 / (1.0 - square);
        }
        // From here on the energy grows as its slope was.
        let rest = 1.0 - SHARPEST;
        (SHARPEST / rest + (square - SHARPEST) / (rest * rest)) / square
    }

    /// The slope of that energy as a multiple of the linear term's.
    pub fn firmness(bend: &Vector3<f64>) -> f64 {
        let rest = 1.0 - (bend.norm_squared() / 4.0).min(SHARPEST);
        1.0 / (rest * rest)
    }

    /// Its knots and weights.
    pub fn terms(&self) -> impl Iterator<Item = (u32, f64)> + Clone + '_ {
        self.knots.iter().copied().zip(self.weights).take(self.count)
    }
}

/// Width of the cloth in which a pressed crease bends, m.
const PRESSED: f64 = 2e-3;

/// Square of the sine of half the angle up to which a fold becomes firmer: 127°.
const SHARPEST: f64 = 0.8;

/// A face at an edge, as bending sees it.
#[derive(Clone, Copy, Debug)]
struct Side {
    /// The edge by its knots, the lower first.
    edge: [u32; 2],
    /// The face: cells count from 0, triangles after them.
    face: u32,
    /// Knots opposite to the two ends; for triangles both are the tip.
    far: [u32; 2],
    panel: u32,
    is_cell: bool,
    /// Whether the face lies to the left of the edge, seen from outside.
    left: bool,
    /// Length of the edge, height of the tip over it, and the foot of that height as a share of
    /// the way from the lower knot.
    length: f64,
    height: f64,
    foot: f64,
    /// Direction across the edge: share along the warp, squared.
    warp: f64,
}

/// All terms of bending of a cloth, and its creases.
pub fn folds(compiled: &Compiled, weld: &Weld) -> (Vec<Fold>, Vec<Crease>) {
    let mut folds = Vec::new();
    let mut creases = Vec::new();
    let mut pressed: BTreeMap<[u32; 2], f64> = BTreeMap::new();
    for crease in &compiled.creases {
        let [a, b] = crease.side.map(|p| weld.knot[p as usize]);
        *pressed.entry([a.min(b), a.max(b)]).or_insert(0.0) += crease.angle;
    }
    let mut sides = Vec::new();
    let more = doubled::more(compiled);
    for (number, panel) in compiled.panels.iter().enumerate() {
        let fabric = &compiled.fabrics[panel.fabric];
        let h = panel.cell;
        for c in panel.cells.range() {
            let corners = compiled.cells[c].map(|p| weld.knot[p as usize]);
            let [warp, weft] = [0, 1].map(|k| fabric.bending[k].max(0.0) + more[c].bending[k]);
            let mean = (warp * weft).sqrt();
            let twist = [
                (corners[0], 1.0 / h),
                (corners[1], -1.0 / h),
                (corners[2], 1.0 / h),
                (corners[3], -1.0 / h),
            ];
            folds.push(Fold::new(&twist, 2.0 * mean * (1.0 - fabric.poisson.clamp(-0.5, 0.95))));
            for e in 0..4 {
                let (a, b) = (corners[e], corners[(e + 1) % 4]);
                let (fa, fb) = (corners[(e + 3) % 4], corners[(e + 2) % 4]);
                let (edge, far) = if a <= b { ([a, b], [fa, fb]) } else { ([b, a], [fb, fa]) };
                sides.push(Side {
                    edge,
                    face: c as u32,
                    far,
                    panel: number as u32,
                    left: a <= b,
                    is_cell: true,
                    length: h,
                    height: h,
                    foot: 0.5,
                    warp: if e % 2 == 0 { 1.0 } else { 0.0 },
                });
            }
        }
        for t in panel.triangles.range() {
            let particles = compiled.triangles[t];
            for e in 0..3 {
                let [p, q, r] = [particles[e], particles[(e + 1) % 3], particles[(e + 2) % 3]];
                let [a, b, tip] = [p, q, r].map(|p| weld.knot[p as usize]);
                let left = a <= b;
                let (p, q) = if left { (p, q) } else { (q, p) };
                let [p, q, r] = [p, q, r].map(|p| compiled.particles[p as usize]);
                let along = [q[0] - p[0], q[1] - p[1]];
                let up = [r[0] - p[0], r[1] - p[1]];
                let square = along[0] * along[0] + along[1] * along[1];
                let length = square.sqrt();
                if !(length > 0.0) {
                    continue;
                }
                let height = (along[0] * up[1] - along[1] * up[0]).abs() / length;
                if !(height > 1e-9) {
                    continue;
                }
                sides.push(Side {
                    edge: [a.min(b), a.max(b)],
                    face: (compiled.cells.len() + t) as u32,
                    far: [tip, tip],
                    panel: number as u32,
                    left,
                    is_cell: false,
                    length,
                    height,
                    foot: (along[0] * up[0] + along[1] * up[1]) / square,
                    warp: along[0] * along[0] / square,
                });
            }
        }
    }
    sides.sort_by_key(|s| (s.edge, s.face));
    for group in sides.chunk_by(|a, b| a.edge == b.edge) {
        for pair in group.windows(2) {
            let [a, b] = pair else { continue };
            if a.edge[0] == a.edge[1] || a.face == b.face {
                continue;
            }
            let rigidity = |s: &Side| {
                let panel = &compiled.panels[s.panel as usize];
                let own = compiled.fabrics[panel.fabric].bending.map(|b| b.max(0.0));
                let further = more[s.face as usize].bending;
                let [warp, weft] = [0, 1].map(|k| own[k] + further[k]);
                warp * s.warp + weft * (1.0 - s.warp)
            };
            // A seam is no crease, even where a crease of one of its panels ends on it.
            let angle = pressed.get(&a.edge).filter(|_| a.panel == b.panel);
            let mut add = |fold: Fold, far: [u32; 2]| match angle {
                Some(&angle) => {
                    // What is bent at a crease is no wider than the crease, however wide the cells.
                    let firmer = (0.5 * (a.height + b.height) / PRESSED).max(1.0);
                    let stiffness = fold.stiffness * firmer;
                    let fold = Fold { creased: true, stiffness, ..fold };
                    creases.push(Crease::new(fold, a.edge, a.left, far, angle));
                    folds.push(fold);
                }
                None => folds.push(fold),
            };
            if a.is_cell && b.is_cell && a.panel == b.panel {
                let h = a.length;
                for end in 0..2 {
                    let terms =
                        [(a.far[end], 1.0 / h), (a.edge[end], -2.0 / h), (b.far[end], 1.0 / h)];
                    let fold = Fold::new(&terms, 0.25 * (rigidity(a) + rigidity(b)));
                    add(fold, [a.far[end], b.far[end]]);
                }
            } else {
                let areas = [a, b].map(|s| 0.5 * s.length * s.height);
                let total = areas[0] + areas[1];
                let rigidity = (rigidity(a) * areas[0] + rigidity(b) * areas[1]) / total;
                let length = 0.5 * (a.length + b.length);
                let mut terms = [(0, 0.0); 8];
                for (k, s) in [a, b].into_iter().enumerate() {
                    let w = 1.0 / s.height;
                    terms[4 * k] = (s.far[0], 0.5 * w);
                    terms[4 * k + 1] = (s.far[1], 0.5 * w);
                    terms[4 * k + 2] = (s.edge[0], -(1.0 - s.foot) * w);
                    terms[4 * k + 3] = (s.edge[1], -s.foot * w);
                }
                let fold = Fold::new(&terms, rigidity * length * length / total);
                add(fold, [a.far[0], b.far[0]]);
            }
        }
    }
    (folds, creases)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Up to the sharpest angle the energy is 2 s tan² θ/2, and everywhere the force is its slope:
    /// central differences over 1e-6 of the way are good to 1e-9 of a smooth energy of order 1.
    #[test]
    fn a_sharp_fold_resists_by_the_tangent() {
        let energy = |bend: f64| {
            let bend = Vector3::new(bend, 0.0, 0.0);
            0.5 * bend.norm_squared() * Fold::sharpness(&bend)
        };
        for degrees in [5.0f64, 60.0, 120.0, 140.0, 175.0] {
            let half = (0.5 * degrees).to_radians();
            let bend = 2.0 * libm::sin(half);
            if degrees < 126.0 {
                assert!((energy(bend) / (2.0 * libm::tan(half).powi(2)) - 1.0).abs() < 1e-12);
            }
            let slope = (energy(bend + 1e-6) - energy(bend - 1e-6)) / 2e-6;
            let force = bend * Fold::firmness(&Vector3::new(bend, 0.0, 0.0));
            assert!((slope / force - 1.0).abs() < 1e-8, "{degrees} {slope} {force}");
        }
    }
}
