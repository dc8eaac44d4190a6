//! Shear between warp and weft inside the cells of the grid.
//!
//! With the mean threads a, b of a cell (per rest length) the shear is γ = a·b, which from the
//! diagonals d₁, d₂ is (|d₁|² − |d₂|²) / 4h²; the energy is ½ G h² γ².

use nalgebra::{Matrix3, Vector3};

/// A cell as it resists shear.
#[derive(Clone, Copy, Debug)]
pub struct Cell {
    /// Its corners, anticlockwise.
    pub corners: [u32; 4],
    /// Where its blocks stand in the matrix, row by row, diagonal blocks left out.
    pub slots: [Option<u32>; 12],
    /// Its side, m.
    pub side: f64,
    /// Shear stiffness G, N/m.
    pub modulus: f64,
}

/// Forces and stiffness on the two diagonals of a cell; the second end of each feels the
/// force as given, its first end the opposite.
#[derive(Clone, Copy, Debug)]
pub struct Load {
    /// Forces on the far ends of the diagonals 0–2 and 3–1, N.
    pub force: [Vector3<f64>; 2],
    /// Stiffness of the first diagonal, of the second, and between them, N/m.
    pub stiffness: [Matrix3<f64>; 3],
}

impl Cell {
    fn diagonals(x: &[Vector3<f64>; 4]) -> [Vector3<f64>; 2] {
        [x[2] - x[0], x[1] - x[3]]
    }

    fn angle(&self, d: &[Vector3<f64>; 2]) -> f64 {
        (d[0] - d[1]).dot(&(d[0] + d[1])) / (4.0 * self.side * self.side)
    }

    /// Its energy, J.
    pub fn energy(&self, x: &[Vector3<f64>; 4]) -> f64 {
        let shear = self.angle(&Self::diagonals(x));
        0.5 * self.modulus * self.side * self.side * shear * shear
    }

    /// Its forces and stiffness; the stiffness leaves out what is not positive.
    pub fn load(&self, x: &[Vector3<f64>; 4]) -> Load {
        let d = Self::diagonals(x);
        let shear = self.angle(&d);
        let half = 0.5 * self.modulus * shear;
        let g = self.modulus / (4.0 * self.side * self.side);
        let identity = Matrix3::identity();
        Load {
            force: [-d[0] * half, d[1] * half],
            stiffness: [
                d[0] * d[0].transpose() * g + identity * half.max(0.0),
                d[1] * d[1].transpose() * g + identity * (-half).max(0.0),
                -d[0] * d[1].transpose() * g,
            ],
        }
    }
}

/// Which diagonal a corner ends, and whether at its far end.
pub const ENDS: [(usize, f64); 4] = [(0, -1.0), (1, 1.0), (0, 1.0), (1, -1.0)];
