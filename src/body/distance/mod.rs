//! How far a point is from the bodies and solids, and on which side.

mod tree;
mod triangle;

use crate::body::surface::Surface;
use nalgebra::{Point3, Vector3};
use tree::{Hit, Tree};

/// What is nearest to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Probe {
    /// Distance to the skin, m; negative inside.
    pub distance: f64,
    /// Unit vector away from the body: the gradient of the distance.
    pub normal: Vector3<f64>,
    /// Nearest place on the skin, m.
    pub point: Point3<f64>,
    /// Number of the surface, in the order given to [`Field::new`].
    pub surface: usize,
    /// Triangle of that surface on which the nearest place lies.
    pub triangle: u32,
    /// Weights of the nearest place at the triangle's corners.
    pub weights: [f64; 3],
}

/// Exact signed distance to the union of closed surfaces; made once, asked from many threads.
#[derive(Clone, Debug)]
pub struct Field {
    trees: Vec<Tree>,
}

impl Field {
    /// Prepares the surfaces. They must be closed with outward triangles, else the sign means
    /// nothing (the distance still holds).
    pub fn new(surfaces: &[Surface]) -> Field {
        Field { trees: surfaces.iter().map(Tree::new).collect() }
    }

    /// Whether there is no surface at all.
    pub fn is_empty(&self) -> bool {
        self.trees.is_empty()
    }

    /// The nearest skin. `None` only where there is no surface with a triangle or `p` is not
    /// finite.
    ///
    /// Inside several surfaces at once the deepest counts.
    pub fn probe(&self, p: Point3<f64>) -> Option<Probe> {
        self.search(p, None)
    }

    /// The nearest skin if `p` lies inside or within `reach` (m) outside; much faster than
    /// [`Field::probe`] where most points are far away.
    ///
    /// Points further inside than `reach` are found all the same.
    pub fn probe_within(&self, p: Point3<f64>, reach: f64) -> Option<Probe> {
        if !self.trees.iter().any(|tree| tree.may_hold(p, reach)) {
            return None;
        }
        self.probe(p).filter(|probe| probe.distance <= reach)
    }

    /// As [`Field::probe`], with the answer for a nearby point as a first guess. The distance is
    /// the same with any guess.
    pub fn probe_from(&self, p: Point3<f64>, guess: &Probe) -> Option<Probe> {
        self.search(p, Some(guess))
    }

    fn search(&self, p: Point3<f64>, guess: Option<&Probe>) -> Option<Probe> {
        if !p.coords.iter().all(|c| c.is_finite()) {
            return None;
        }
        let mut best: Option<Probe> = None;
        for (surface, tree) in self.trees.iter().enumerate() {
            let hint = guess.filter(|g| g.surface == surface).map(|g| g.triangle);
            // Another surface matters only if it is nearer, or if `p` is inside it too; the
            // latter only where its box holds `p`.
            let limit = match &best {
                Some(b) if !tree.may_hold(p, 0.0) => b.distance.max(0.0).powi(2),
                _ => f64::INFINITY,
            };
            let Some(hit) = tree.nearest(p, limit, hint) else { continue };
            let probe = signed(p, surface, tree, &hit);
            if best.as_ref().is_none_or(|b| probe.distance < b.distance) {
                best = Some(probe);
            }
        }
        best
    }
}

/// Gives a hit its sign and normal.
fn signed(p: Point3<f64>, surface: usize, tree: &Tree, hit: &Hit) -> Probe {
    let away = p - hit.at;
    let side = tree.pseudonormal(hit);
    let distance = hit.square.sqrt();
    let outside = away.dot(&side) >= 0.0;
    // On the skin itself the direction to it is lost; the pseudonormal takes its place.
    let normal = if distance > 1e-9 {
        if outside { away / distance } else { -away / distance }
    } else {
        side.try_normalize(0.0).unwrap_or_else(Vector3::y)
    };
    Probe {
        distance: if outside { distance } else { -distance },
        normal,
        point: hit.at,
        surface,
        triangle: hit.triangle,
        weights: hit.weights,
    }
}

#[cfg(test)]
mod tests;
