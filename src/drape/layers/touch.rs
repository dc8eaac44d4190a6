//! Contacts of layers as forces and as a term of the linear system.

use crate::drape::grid::product::Three;
use crate::drape::system::Extra;
use nalgebra::{Matrix3, Vector3};

type V = Vector3<f64>;

/// A contact of the step under way.
#[derive(Clone, Copy, Debug)]
pub struct Touch {
    /// Its knots.
    pub knots: [u32; 4],
    /// Their weights in the shortest way from one layer to the other.
    pub weights: [f64; 4],
    /// Direction of that way.
    pub normal: V,
    /// Gap beyond the distance kept, m.
    pub gap: f64,
    /// Stiffness along the normal, N/m.
    pub stiffness: f64,
    /// Stiffness across, of friction, N/m.
    pub grip: f64,
}

/// Contacts of a step as a term of the linear system.
#[derive(Clone, Debug, Default)]
pub struct Touches(pub Vec<Touch>);

impl Touch {
    fn block(&self) -> Matrix3<f64> {
        let along = self.normal * self.normal.transpose();
        along * (self.stiffness - self.grip) + Matrix3::identity() * self.grip
    }
}

impl Touches {
    /// Adds the forces, N.
    pub fn push(&self, force: &mut [V]) {
        for t in &self.0 {
            let f = t.normal * (-t.stiffness * t.gap);
            for (k, w) in t.knots.iter().zip(t.weights) {
                force[*k as usize] += f * w;
            }
        }
    }

    /// Blocks on the diagonal, by knots, for the preconditioner to see.
    pub fn diagonal(&self) -> impl Iterator<Item = (u32, Matrix3<f64>)> + '_ {
        self.0.iter().flat_map(|t| {
            let block = t.block();
            t.knots.into_iter().zip(t.weights).map(move |(k, w)| (k, block * (w * w)))
        })
    }

    /// Contacts as a term of a linear system whose numbers stand in the given slots.
    pub fn term(&self, slot: &[u32]) -> Term {
        #[allow(clippy::cast_possible_truncation)]
        let single = |t: &Touch| Single {
            slots: t.knots.map(|k| slot[k as usize]),
            weights: t.weights.map(|w| w as f32),
            normal: [t.normal.x as f32, t.normal.y as f32, t.normal.z as f32],
            along: (t.stiffness - t.grip) as f32,
            grip: t.grip as f32,
        };
        Term(self.0.iter().map(single).collect())
    }

    /// How many.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

/// Contacts as a term of the linear system, in single precision.
#[derive(Clone, Debug, Default)]
pub struct Term(Vec<Single>);

#[derive(Clone, Copy, Debug)]
struct Single {
    slots: [u32; 4],
    weights: [f32; 4],
    normal: [f32; 3],
    along: f32,
    grip: f32,
}

impl Extra for Term {
    fn multiply(&self, x: &Three, y: &mut Three) -> f64 {
        let mut total = 0.0;
        for t in &self.0 {
            let mut way = [0.0f32; 3];
            for (s, w) in t.slots.iter().zip(t.weights) {
                for c in 0..3 {
                    way[c] += x[c][*s as usize] * w;
                }
            }
            let n = t.normal;
            let along = t.along * (n[0] * way[0] + n[1] * way[1] + n[2] * way[2]);
            let f = [0, 1, 2].map(|c| n[c] * along + way[c] * t.grip);
            for (s, w) in t.slots.iter().zip(t.weights) {
                for c in 0..3 {
                    y[c][*s as usize] += f[c] * w;
                }
            }
            total += f64::from(f[0] * way[0] + f[1] * way[1] + f[2] * way[2]);
        }
        total
    }

    fn gather<'a>(
        &self,
        follows: &dyn Fn(u32) -> &'a [(u32, f32)],
        add: &mut dyn FnMut(u32, u32, [[f32; 3]; 3]),
    ) {
        for t in &self.0 {
            let mut nodes: Vec<(u32, f32)> = Vec::new();
            for (s, w) in t.slots.iter().zip(t.weights) {
                for (node, share) in follows(*s) {
                    match nodes.iter_mut().find(|n| n.0 == *node) {
                        Some(had) => had.1 += w * share,
                        None => nodes.push((*node, w * share)),
                    }
                }
            }
            for (i, a) in &nodes {
                for (j, b) in &nodes {
                    let block = std::array::from_fn(|d| {
                        std::array::from_fn(|c| {
                            let own = if c == d { t.grip } else { 0.0 };
                            a * b * (t.normal[d] * t.normal[c] * t.along + own)
                        })
                    });
                    add(*i, *j, block);
                }
            }
        }
    }
}
