//! The drag of the air on a moving cloth.
//!
//! Air resists the movement of a patch along its normal, ½ ρ C A |vₙ| vₙ, and hardly that along
//! itself. The step takes it implicitly with the speed at its beginning.

use nalgebra::{Matrix3, Vector3};

/// Drag coefficient of a plate across the stream.
const PLATE: f64 = 1.2;

/// Area-weighted normals of all knots, m²: twice the area of the faces around each, a third of it.
pub fn normals(faces: &[[u32; 3]], x: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
    let mut normals = vec![Vector3::zeros(); x.len()];
    for f in faces {
        let [a, b, c] = f.map(|k| x[k as usize]);
        let n = (b - a).cross(&(c - a));
        for k in f {
            normals[*k as usize] += n;
        }
    }
    normals
}

/// Damping of a knot, N·s/m: force = −damping · velocity. `density` of the air, kg/m³.
pub fn damping(density: f64, area: f64, normal: &Vector3<f64>, v: &Vector3<f64>) -> Matrix3<f64> {
    let size = normal.norm_squared();
    if !(size > 0.0) {
        return Matrix3::zeros();
    }
    let n = normal / size.sqrt();
    let coefficient = 0.5 * density * PLATE * area * v.dot(&n).abs();
    n * n.transpose() * coefficient
}
