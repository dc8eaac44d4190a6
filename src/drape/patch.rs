//! Patches, and folds sewn shut: particles held to points of the face below them.
//!
//! A patch lies on its host at the distance that layers keep, so that the stitch and the contact of
//! the two want the same. A stitch is a spring in every direction between a knot and a point of a
//! triangle, taken implicitly as a contact is; the direction in which the face looks is that of the
//! step's beginning.

use super::cloth::Cloth;
use super::layers;
use super::layers::touch::Touch;
use crate::mesh::compiled::{Compiled, MeshStitch};
use nalgebra::Vector3;

type V = Vector3<f64>;

/// Stiffness per length of seam, N/m²: a stitch of 1 cm gives 0.1 mm under 20 g, a tenth of the
/// weight of a full pocket.
const STIFFNESS: f64 = 2.0e5;

/// Largest force per length of seam, N/m; what begins farther away is drawn there gently.
const PULL: f64 = 100.0;

/// A knot held to a point of a triangle.
#[derive(Clone, Copy, Debug)]
struct Stitch {
    /// The knot, then the corners.
    knots: [u32; 4],
    /// 1, and less the shares of the corners.
    weights: [f64; 4],
    /// How far in front of the face it lies, m; behind it where negative.
    off: f64,
    /// Length of seam that it stands for, m.
    length: f64,
}

/// All patches of a cloth.
#[derive(Clone, Debug, Default)]
pub struct Patches {
    stitches: Vec<Stitch>,
}

impl Patches {
    /// The patches and the shut folds of a cloth.
    pub fn new(compiled: &Compiled, cloth: &Cloth) -> Self {
        let mut stitches = Vec::new();
        for patch in &compiled.patches {
            let Some(panel) = compiled.panels.get(patch.panel) else { continue };
            let held = patch.stitches.iter();
            stitches.extend(held.filter_map(|s| Stitch::new(s, cloth, panel.cell)));
        }
        for fold in &compiled.shut {
            let Some(panel) = compiled.panels.get(fold.panel) else { continue };
            let side = if fold.face_on_face { 1.0 } else { -1.0 };
            stitches.extend(fold.stitches.iter().filter_map(|s| {
                let stitch = Stitch::new(s, cloth, panel.cell)?;
                Some(Stitch { off: side * stitch.off, ..stitch })
            }));
        }
        Patches { stitches }
    }

    /// The springs of the stitches at places x.
    pub fn touches<'a>(&'a self, x: &'a [V]) -> impl Iterator<Item = Touch> + 'a {
        self.stitches.iter().map(|s| {
            let way = s.way(x);
            let far = way.norm();
            let normal = if far > 1e-12 { way / far } else { V::y() };
            let stiffness = (STIFFNESS * s.length).min(PULL * s.length / far.max(1e-9));
            let (knots, weights) = (s.knots, s.weights);
            Touch { knots, weights, normal, gap: far, stiffness, grip: stiffness }
        })
    }

    /// How far the worst stitch is from its place, m.
    pub fn gap(&self, x: &[V]) -> f64 {
        self.stitches.iter().map(|s| s.way(x).norm()).fold(0.0, f64::max)
    }
}

impl Stitch {
    /// A particle in front of a point of a face; none where another seam has made it part of the
    /// face, which needs no holding.
    fn new(s: &MeshStitch, cloth: &Cloth, length: f64) -> Option<Self> {
        let knot = |p: u32| cloth.weld.knot[p as usize];
        let [a, b, c] = s.corners.map(knot);
        let knots = [knot(s.particle), a, b, c];
        if knots[1..].contains(&knots[0]) || a == b || b == c || c == a {
            return None;
        }
        let [p, q, r] = s.weights.map(|w| -w);
        let off = knots.map(|k| layers::apart(cloth, k)).into_iter().fold(1.0, f64::min);
        Some(Stitch { knots, weights: [1.0, p, q, r], off, length })
    }

    /// The way to the knot from where it is to lie.
    fn way(&self, x: &[V]) -> V {
        let [p, a, b, c] = self.knots.map(|k| x[k as usize]);
        let [_, u, v, w] = self.weights;
        let out = (b - a).cross(&(c - a));
        let out = out / out.norm().max(1e-12);
        p + a * u + b * v + c * w - out * self.off
    }
}
