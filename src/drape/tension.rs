//! Tension along warp and weft: the edges of the grid's cells as springs.
//!
//! A cell of side h carries, on each of its two edges along a thread direction, half of the
//! tensile stiffness of its width: an edge inside the cloth has k (N/m per width times h over
//! length h), one on the rim half of it.

use nalgebra::{Matrix3, Vector3};

/// Least lateral stiffness of a slack thread, as a share of its stiffness.
///
/// A thread under compression has negative lateral stiffness, which an implicit step may not
/// take; with none at all a fold swings freely for the length of the step and overshoots.
/// It stands in the matrix only, the force is exact.
pub const SLACK: f64 = 0.001;

/// A stretch of thread between two knots.
#[derive(Clone, Copy, Debug)]
pub struct Spring {
    /// Its knots.
    pub ends: [u32; 2],
    /// Where its blocks (0, 1) and (1, 0) stand in the matrix; none if both ends are one knot.
    pub slots: Option<[u32; 2]>,
    /// Length at rest, m.
    pub rest: f64,
    /// Force per elongation, N/m.
    pub stiffness: f64,
    /// Along the warp; else along the weft.
    pub warp: bool,
    /// The largest force of a cord, N, which takes none in compression.
    pub most: Option<f64>,
}

impl Spring {
    /// Its strain between two places.
    pub fn strain(&self, a: &Vector3<f64>, b: &Vector3<f64>) -> f64 {
        ((b - a).norm() - self.rest) / self.rest
    }

    /// Its energy, J.
    pub fn energy(&self, a: &Vector3<f64>, b: &Vector3<f64>) -> f64 {
        let stretch = (b - a).norm() - self.rest;
        match self.most {
            Some(_) if stretch < 0.0 => 0.0,
            Some(most) if stretch * self.stiffness > most => {
                most * (stretch - 0.5 * most / self.stiffness)
            }
            _ => 0.5 * self.stiffness * stretch * stretch,
        }
    }

    /// The force on its first end, N, and the stiffness between that end and itself, N/m.
    pub fn pull(&self, a: &Vector3<f64>, b: &Vector3<f64>) -> (Vector3<f64>, Matrix3<f64>) {
        let d = b - a;
        let length = d.norm();
        if length < 1e-9 * self.rest {
            return (Vector3::zeros(), Matrix3::identity() * (SLACK * self.stiffness));
        }
        let n = d / length;
        let stretch = (length * length - self.rest * self.rest) / (length + self.rest);
        if let Some(most) = self.most {
            if stretch <= 0.0 {
                return (Vector3::zeros(), Matrix3::identity() * (SLACK * self.stiffness));
            }
            if stretch * self.stiffness > most {
                // The secant, as of an open seam.
                return (n * most, Matrix3::identity() * (most / length));
            }
        }
        let lateral = (stretch / length).max(SLACK);
        let along = n * n.transpose() * (1.0 - lateral);
        (n * (self.stiffness * stretch), (along + Matrix3::identity() * lateral) * self.stiffness)
    }
}
