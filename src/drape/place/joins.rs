//! Which panels are sewn to which.

use super::drawing;
use crate::mesh::compiled::Compiled;
use nalgebra::Point3;

/// The stitches of one seam between two panels.
pub(super) struct Join {
    /// The panels; the first of each pair of particles is of the first.
    panels: [usize; 2],
    pairs: Vec<[u32; 2]>,
}

/// All joins of a garment.
pub(super) struct Joins {
    list: Vec<Join>,
    /// Place of each particle in the drawing of its panel, m.
    pub drawn: Vec<[f64; 2]>,
    owner: Vec<usize>,
}

/// A join as one of its panels sees it.
pub(super) struct Seen<'a> {
    /// The other panel.
    pub other: usize,
    join: &'a Join,
    first: bool,
}

impl Seen<'_> {
    /// Particles of this panel with those of the other.
    pub fn pairs(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        self.join.pairs.iter().map(|&[a, b]| {
            if self.first { [a as usize, b as usize] } else { [b as usize, a as usize] }
        })
    }

    /// Number of pairs.
    pub fn count(&self) -> usize {
        self.join.pairs.len()
    }
}

impl Joins {
    /// Looks through the seams; those of a panel with itself are left out.
    pub fn new(compiled: &Compiled) -> Self {
        let mut owner = vec![0; compiled.particles.len()];
        let mut drawn = vec![[0.0; 2]; compiled.particles.len()];
        for (number, panel) in compiled.panels.iter().enumerate() {
            for (k, place) in drawing(compiled, panel) {
                owner[k] = number;
                drawn[k] = place;
            }
        }
        let mut list: Vec<Join> = Vec::new();
        for seam in &compiled.seams {
            let begin = list.len();
            for &[a, b] in &seam.pairs {
                let (mut pair, mut panels) = ([a, b], [owner[a as usize], owner[b as usize]]);
                if panels[0] > panels[1] {
                    pair.reverse();
                    panels.reverse();
                }
                if panels[0] == panels[1] {
                    continue;
                }
                match list[begin..].iter_mut().find(|j| j.panels == panels) {
                    Some(join) => join.pairs.push(pair),
                    None => list.push(Join { panels, pairs: vec![pair] }),
                }
            }
        }
        Joins { list, drawn, owner }
    }

    /// The joins of a panel.
    pub fn of(&self, panel: usize) -> impl Iterator<Item = Seen<'_>> {
        self.list.iter().filter_map(move |join| {
            let first = join.panels[0] == panel;
            (first || join.panels[1] == panel).then(|| Seen {
                other: join.panels[usize::from(first)],
                join,
                first,
            })
        })
    }

    /// The panel of a particle.
    pub fn owner(&self, particle: usize) -> usize {
        self.owner[particle]
    }
}

/// A place in the plane into which a panel is moved.
pub(super) type Move<'a> = &'a dyn Fn([f64; 2]) -> [f64; 2];

/// How far each row of a panel reaches, as least and greatest first coordinate of its outline where
/// `at` moves it; rows are `row` high and begin at `low`.
pub(super) fn reach(
    compiled: &Compiled,
    joins: &Joins,
    panel: usize,
    at: Move,
    (low, row, rows): (f64, f64, usize),
) -> Vec<Option<[f64; 2]>> {
    let mut reach: Vec<Option<[f64; 2]>> = vec![None; rows];
    let Some(ring) = compiled.panels[panel].loops.first() else { return reach };
    let of = |k: u32| at(joins.drawn[k as usize]);
    for (i, k) in ring.iter().enumerate() {
        // Every row that a side of the outline passes.
        let (p, q) = (of(*k), of(ring[(i + 1) % ring.len()]));
        let (a, b) = (p[1], q[1]);
        let (from, to) = ((a.min(b) - low) / row, (a.max(b) - low) / row);
        for n in from.floor().max(0.0) as usize..=(to.ceil().max(0.0) as usize).min(rows - 1) {
            let t = if (b - a).abs() > 1e-9 {
                ((low + n as f64 * row - a) / (b - a)).clamp(0.0, 1.0)
            } else {
                0.5
            };
            let x = p[0] + t * (q[0] - p[0]);
            let r = reach[n].get_or_insert([x, x]);
            *r = [r[0].min(x), r[1].max(x)];
        }
    }
    reach
}

/// Mean of places.
pub(super) fn mean(points: &[Point3<f64>]) -> Point3<f64> {
    let sum = points.iter().fold(nalgebra::Vector3::zeros(), |sum, p| sum + p.coords);
    Point3::from(sum / points.len().max(1) as f64)
}
