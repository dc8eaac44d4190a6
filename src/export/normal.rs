//! Normals of the draped cloth, smooth over its seams.

use crate::drape::weld::Weld;
use crate::mesh::compiled::Compiled;
use nalgebra::{Point3, Vector3};

/// Seam partners within this are sewn, m.
const SEWN: f64 = 2e-3;

/// Unit normals of the particles: the mean of the faces round each, weighed by area, taken over
/// all that is sewn together unless the cloth is folded by more than 60° along the seam.
pub fn normals(compiled: &Compiled, places: &[Point3<f64>]) -> Vec<Vector3<f64>> {
    let mut own = vec![Vector3::zeros(); places.len()];
    let halves = compiled.cells.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
    for corners in halves.chain(compiled.triangles.iter().copied()) {
        let [Some(a), Some(b), Some(c)] = corners.map(|corner| places.get(corner as usize)) else {
            continue;
        };
        let area = (b - a).cross(&(c - a));
        for corner in corners {
            own[corner as usize] += area;
        }
    }
    let sewn = compiled.seams.iter().flat_map(|seam| seam.pairs.iter().copied()).filter(|pair| {
        let [a, b] = pair.map(|particle| places.get(particle as usize));
        matches!((a, b), (Some(a), Some(b)) if (a - b).norm() < SEWN)
    });
    let weld = Weld::new(places.len(), sewn);
    let mut joint = vec![Vector3::zeros(); weld.count];
    for (normal, knot) in own.iter().zip(&weld.knot) {
        joint[*knot as usize] += normal;
    }
    let unit = |normal: &Vector3<f64>| {
        let length = normal.norm();
        if length.is_finite() && length > 1e-18 { normal / length } else { Vector3::y() }
    };
    own.iter()
        .zip(&weld.knot)
        .map(|(own, knot)| {
            let (own, joint) = (unit(own), unit(&joint[*knot as usize]));
            if own.dot(&joint) > 0.5 { joint } else { own }
        })
        .collect()
}
