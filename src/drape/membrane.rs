//! Tension and shear of the band along cut edges: triangles of constant strain with the cloth's
//! own moduli along warp and weft.
//!
//! With the images a, b of the unit vectors along weft and warp the energy per area is
//! ½ k_weft (|a| − 1)² + ½ k_warp (|b| − 1)² + ½ G (a·b)² (after Baraff and Witkin 1998).

use super::tension::SLACK;
use nalgebra::{Matrix3, Vector3};

/// A triangle of the band.
#[derive(Clone, Copy, Debug)]
pub struct Triangle {
    /// Its corners, anticlockwise.
    pub corners: [u32; 3],
    /// Where its blocks stand in the matrix, row by row, diagonal blocks left out.
    pub slots: [Option<u32>; 6],
    /// Change of the weights of the corners along weft and warp, 1/m.
    pub gradient: [[f64; 2]; 3],
    /// Its area at rest, m².
    pub area: f64,
    /// Tensile stiffness along warp, along weft, N/m.
    pub tensile: [f64; 2],
    /// Shear stiffness, N/m.
    pub shear: f64,
}

/// The weights' gradients and the area of a flat triangle; `None` without area.
pub fn rest(uv: [[f64; 2]; 3]) -> Option<([[f64; 2]; 3], f64)> {
    let [a, b, c] = uv;
    let twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    if !(twice.abs() > 1e-14) {
        return None;
    }
    let gradient = |p: [f64; 2], q: [f64; 2]| [(p[1] - q[1]) / twice, (q[0] - p[0]) / twice];
    Some(([gradient(b, c), gradient(c, a), gradient(a, b)], 0.5 * twice.abs()))
}

impl Triangle {
    fn threads(&self, x: &[Vector3<f64>; 3]) -> [Vector3<f64>; 2] {
        let mut a = Vector3::zeros();
        let mut b = Vector3::zeros();
        for k in 1..3 {
            let d = x[k] - x[0];
            a += d * self.gradient[k][0];
            b += d * self.gradient[k][1];
        }
        [a, b]
    }

    /// Its strains along warp and weft.
    pub fn strains(&self, x: &[Vector3<f64>; 3]) -> [f64; 2] {
        let [a, b] = self.threads(x);
        [b.norm() - 1.0, a.norm() - 1.0]
    }

    /// Its energy, J.
    pub fn energy(&self, x: &[Vector3<f64>; 3]) -> f64 {
        let [a, b] = self.threads(x);
        let (weft, warp, shear) = (a.norm() - 1.0, b.norm() - 1.0, a.dot(&b));
        0.5 * self.area
            * (self.tensile[1] * weft * weft
                + self.tensile[0] * warp * warp
                + self.shear * shear * shear)
    }

    /// Forces on its corners, N, and its stiffness blocks (0,0) (1,1) (2,2) (0,1) (0,2) (1,2), N/m.
    pub fn load(&self, x: &[Vector3<f64>; 3]) -> ([Vector3<f64>; 3], [Matrix3<f64>; 6]) {
        let [a, b] = self.threads(x);
        let shear = self.shear * a.dot(&b);
        let (pa, ha) = stretch(&a, self.tensile[1]);
        let (pb, hb) = stretch(&b, self.tensile[0]);
        let pa = (pa + b * shear) * self.area;
        let pb = (pb + a * shear) * self.area;
        let haa = (ha + b * b.transpose() * self.shear) * self.area;
        let hbb = (hb + a * a.transpose() * self.shear) * self.area;
        let hab = b * a.transpose() * (self.shear * self.area);
        let g = &self.gradient;
        let block = |i: usize, j: usize| {
            haa * (g[i][0] * g[j][0])
                + hbb * (g[i][1] * g[j][1])
                + hab * (g[i][0] * g[j][1])
                + hab.transpose() * (g[i][1] * g[j][0])
        };
        let force = |i: usize| -(pa * g[i][0] + pb * g[i][1]);
        (
            [force(0), force(1), force(2)],
            [block(0, 0), block(1, 1), block(2, 2), block(0, 1), block(0, 2), block(1, 2)],
        )
    }
}

fn stretch(a: &Vector3<f64>, modulus: f64) -> (Vector3<f64>, Matrix3<f64>) {
    let length = a.norm();
    if length < 1e-9 {
        return (Vector3::zeros(), Matrix3::identity() * (SLACK * modulus));
    }
    let n = a / length;
    let lateral = (1.0 - 1.0 / length).max(SLACK);
    (
        n * (modulus * (length - 1.0)),
        (n * n.transpose() * (1.0 - lateral) + Matrix3::identity() * lateral) * modulus,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample() -> (Triangle, [Vector3<f64>; 3]) {
        let (gradient, area) = rest([[0.0, 0.0], [0.01, 0.002], [0.003, 0.008]]).unwrap();
        let triangle = Triangle {
            corners: [0, 1, 2],
            slots: [None; 6],
            gradient,
            area,
            tensile: [900.0, 600.0],
            shear: 40.0,
        };
        let x = [
            Vector3::new(0.1, 0.2, 0.0),
            Vector3::new(0.1105, 0.2035, 0.001),
            Vector3::new(0.104, 0.2085, -0.001),
        ];
        (triangle, x)
    }

    /// Forces are the slope of the energy; central differences over 1e-7 m of an energy with
    /// curvature k A / L² ≈ 1e3 are good to 1e-6 of the force.
    #[test]
    fn forces_are_the_slope_of_the_energy() {
        let (t, x) = sample();
        let (force, _) = t.load(&x);
        for i in 0..3 {
            for l in 0..3 {
                let (mut p, mut q) = (x, x);
                p[i][l] += 1e-7;
                q[i][l] -= 1e-7;
                let slope = (t.energy(&p) - t.energy(&q)) / 2e-7;
                assert!((slope + force[i][l]).abs() < 1e-6, "{slope} {}", force[i][l]);
            }
        }
    }
}
