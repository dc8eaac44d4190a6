//! A cloth as the solver sees it: knots with mass, threads, shearing cells, band triangles, folds.

use super::bending::{self, Fold};
use super::cord;
use super::crease::Crease;
use super::doubled::{self, More};
use super::gather::Gathers;
use super::grid::Taken;
use super::matrix::Pattern;
use super::membrane::{self, Triangle};
use super::shear::Cell;
use super::tension::Spring;
use super::weld::Weld;
use crate::mesh::compiled::Compiled;

/// The mechanics of a cloth at one state of its seams.
#[derive(Clone, Debug, Default)]
pub struct Cloth {
    /// Which particles are one.
    pub weld: Weld,
    /// Mass of each knot, kg.
    pub mass: Vec<f64>,
    /// Area of each knot, m².
    pub area: Vec<f64>,
    /// Thickness of the cloth at each knot, m.
    pub thickness: Vec<f64>,
    /// Coulomb friction of the cloth at each knot.
    pub friction: Vec<f64>,
    /// Stretches of thread.
    pub springs: Vec<Spring>,
    /// Cells in shear.
    pub cells: Vec<Cell>,
    /// Triangles of the bands.
    pub triangles: Vec<Triangle>,
    /// Bending.
    pub folds: Vec<Fold>,
    /// What rests folded.
    pub creases: Vec<Crease>,
    /// How many of the springs, cells and folds, the first ones, belong to the grid; the others
    /// belong to the rim.
    pub regular: [usize; 3],
    /// All faces as triangles of knots, cells cut in two; anticlockwise seen from outside.
    pub faces: Vec<[u32; 3]>,
    /// How much farther from the skin than others a knot is to lie, m, so that the chords of the
    /// cloth beside it do not cut through a sharp edge.
    pub raise: Vec<f64>,
    /// Panel of each face and the rectangle `[u0, v0, u1, v1]` of its plane that it (or the cell
    /// whose half it is) takes, m.
    pub face_places: Vec<(u32, [f32; 4])>,
    /// Shortest edge at each knot, m.
    pub spacing: Vec<f64>,
    /// Shortest side of a grid cell, m.
    pub cell: f64,
    /// Stiffness of the rim's bending off the diagonal, in the order of its matrix's blocks, N/m.
    pub fold_off: Vec<f64>,
    /// Seconds of damping per stiffness: the viscous share of every elastic force is this times
    /// its rate (Rayleigh's second coefficient).
    pub damping: f64,
}

/// Frequency at which a fabric's share of critical damping holds, rad/s: folds of a skirt swing
/// about twice a second.
const SWING: f64 = 12.0;

impl Cloth {
    /// Builds the cloth.
    pub fn new(compiled: &Compiled, weld: Weld) -> Self {
        let n = weld.count;
        let (folds, creases) = bending::folds(compiled, &weld);
        let mut cloth = Cloth {
            mass: vec![0.0; n],
            area: vec![0.0; n],
            thickness: vec![0.0; n],
            friction: vec![0.0; n],
            spacing: vec![f64::INFINITY; n],
            raise: vec![0.0; n],
            cell: f64::INFINITY,
            folds,
            creases,
            weld,
            ..Cloth::default()
        };
        let more = doubled::more(compiled);
        let gathers = Gathers::new(compiled);
        let mut damping = 0.0;
        #[allow(clippy::cast_possible_truncation)]
        let plane = |particles: &[u32]| {
            let mut plane = [f32::INFINITY, f32::INFINITY, f32::NEG_INFINITY, f32::NEG_INFINITY];
            for p in particles.iter().map(|p| compiled.particles[*p as usize]) {
                for k in 0..2 {
                    plane[k] = plane[k].min(p[k] as f32);
                    plane[k + 2] = plane[k + 2].max(p[k] as f32);
                }
            }
            plane
        };
        for (number, panel) in compiled.panels.iter().enumerate() {
            let number = number as u32;
            let fabric = &compiled.fabrics[panel.fabric];
            let h = panel.cell;
            cloth.cell = cloth.cell.min(h);
            let mut lump = |cloth: &mut Cloth, knots: &[u32], area: f64, more: &More| {
                let mass = fabric.mass.max(1e-4) + more.mass;
                let share = area / knots.len() as f64;
                for &k in knots {
                    let k = k as usize;
                    cloth.area[k] += share;
                    cloth.mass[k] += share * mass;
                    cloth.thickness[k] = cloth.thickness[k].max(fabric.thickness + more.thickness);
                    cloth.friction[k] = cloth.friction[k].max(fabric.friction);
                }
                damping += area * mass * fabric.damping.clamp(0.0, 1.0);
            };
            let mut edges: Vec<([u32; 2], bool, f64)> = Vec::new();
            for c in panel.cells.range() {
                let (particles, more) = (compiled.cells[c], &more[c]);
                let corners = particles.map(|p| cloth.weld.knot[p as usize]);
                lump(&mut cloth, &corners, h * h, more);
                cloth.cells.push(Cell {
                    corners,
                    slots: [None; 12],
                    side: h,
                    modulus: fabric.shear.max(0.0) + more.shear,
                });
                cloth.faces.push([corners[0], corners[1], corners[2]]);
                cloth.faces.push([corners[0], corners[2], corners[3]]);
                cloth.face_places.extend([(number, plane(&particles)); 2]);
                for k in corners {
                    let k = &mut cloth.spacing[k as usize];
                    *k = k.min(h);
                }
                let [a, b, c, d] = particles;
                let [warp, weft] = more.tensile;
                edges.extend([([a, b], false, weft), ([d, c], false, weft)]);
                edges.extend([([b, c], true, warp), ([a, d], true, warp)]);
            }
            edges.sort_by_key(|edge| (edge.0, edge.1));
            for same in edges.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
                let ([a, b], warp, _) = same[0];
                let more: f64 = same.iter().map(|edge| edge.2).sum();
                let modulus = fabric.tensile[usize::from(!warp)].max(1e-3);
                cloth.springs.push(Spring {
                    ends: [a, b].map(|p| cloth.weld.knot[p as usize]),
                    slots: None,
                    rest: h * gathers.share(a, b).unwrap_or(1.0),
                    stiffness: 0.5 * modulus * same.len() as f64 + 0.5 * more,
                    warp,
                    most: None,
                });
            }
            for t in panel.triangles.range() {
                let particles = compiled.triangles[t];
                let more = &more[compiled.cells.len() + t];
                let corners = particles.map(|p| cloth.weld.knot[p as usize]);
                let uv = particles.map(|p| compiled.particles[p as usize]);
                cloth.faces.push(corners);
                cloth.face_places.push((number, plane(&particles)));
                for k in 0..3 {
                    let (a, b) = (uv[k], uv[(k + 1) % 3]);
                    let length = libm::hypot(a[0] - b[0], a[1] - b[1]);
                    for knot in [corners[k], corners[(k + 1) % 3]] {
                        let s = &mut cloth.spacing[knot as usize];
                        *s = s.min(length);
                    }
                }
                let uv = gathers.draw_in(particles, uv);
                let Some((gradient, area)) = membrane::rest(uv) else { continue };
                lump(&mut cloth, &corners, area, more);
                cloth.triangles.push(Triangle {
                    corners,
                    slots: [None; 6],
                    gradient,
                    area,
                    tensile: [0, 1].map(|k| fabric.tensile[k].max(1e-3) + more.tensile[k]),
                    shear: fabric.shear.max(0.0) + more.shear,
                });
            }
        }
        cord::pucker(compiled, &cloth.weld, &mut cloth.springs, &mut cloth.triangles);
        let cords = cord::springs(compiled, &cloth.weld, &mut cloth.mass);
        cloth.springs.extend(cords);
        // A particle of no face at all still needs a mass to be solved for.
        let total: f64 = cloth.mass.iter().sum();
        for m in &mut cloth.mass {
            if !(*m > 0.0) {
                *m = 1e-6;
            }
        }
        if !cloth.cell.is_finite() {
            cloth.cell = 0.01;
        }
        cloth.damping = if total > 0.0 { 2.0 * damping / total / SWING } else { 0.0 };
        cloth
    }

    /// Number of knots.
    pub fn knots(&self) -> usize {
        self.mass.len()
    }

    /// Leaves to the rim what the grid has not taken, and gives the pairs of knots that it joins,
    /// the given further ones included.
    pub fn leave(&mut self, taken: &Taken, sewn: &[[u32; 2]]) -> Vec<[u32; 2]> {
        self.regular = [
            first(&mut self.springs, &taken.springs),
            first(&mut self.cells, &taken.cells),
            first(&mut self.folds, &taken.folds),
        ];
        let [springs, cells, folds] = self.regular;
        let springs = self.springs[springs..].iter().map(|s| s.ends);
        let cells = self.cells[cells..].iter().flat_map(|c| pairs(&c.corners));
        let triangles = self.triangles.iter().flat_map(|t| pairs(&t.corners));
        let folds = self.folds[folds..].iter().flat_map(|f| pairs(&f.knots[..f.count]));
        springs.chain(cells).chain(triangles).chain(folds).chain(sewn.iter().copied()).collect()
    }

    /// Finds the places of the rim's elements in its matrix. `number` gives the row of each knot.
    pub fn lay_out(&mut self, pattern: &Pattern, number: &[u32]) {
        let slot = |a: u32, b: u32| pattern.slot(number[a as usize], number[b as usize]);
        let [springs, cells, folds] = self.regular;
        for s in &mut self.springs[springs..] {
            let [a, b] = s.ends;
            s.slots = match (slot(a, b), slot(b, a)) {
                (Some(ab), Some(ba)) => Some([ab, ba]),
                _ => None,
            };
        }
        for c in &mut self.cells[cells..] {
            let mut k = 0;
            for i in 0..4 {
                for j in (0..4).filter(|&j| j != i) {
                    c.slots[k] = slot(c.corners[i], c.corners[j]);
                    k += 1;
                }
            }
        }
        for t in &mut self.triangles {
            let mut k = 0;
            for i in 0..3 {
                for j in (0..3).filter(|&j| j != i) {
                    t.slots[k] = slot(t.corners[i], t.corners[j]);
                    k += 1;
                }
            }
        }
        self.fold_off = vec![0.0; pattern.blocks()];
        for fold in &self.folds[folds..] {
            for (i, wi) in fold.terms() {
                for (j, wj) in fold.terms() {
                    let value = fold.stiffness * wi * wj;
                    if let Some(slot) = slot(i, j) {
                        self.fold_off[slot as usize] += value;
                    }
                }
            }
        }
    }
}

/// Brings the marked elements to the front, each kind in its order; gives how many there are.
fn first<T: Copy>(list: &mut [T], marked: &[bool]) -> usize {
    let chosen = |which: bool| list.iter().zip(marked).filter(move |m| *m.1 == which).map(|m| *m.0);
    let front: Vec<T> = chosen(true).collect();
    let sorted: Vec<T> = front.iter().copied().chain(chosen(false)).collect();
    list.copy_from_slice(&sorted);
    front.len()
}

fn pairs(knots: &[u32]) -> impl Iterator<Item = [u32; 2]> + '_ {
    (0..knots.len()).flat_map(move |i| (0..i).map(move |j| [knots[i], knots[j]]))
}
