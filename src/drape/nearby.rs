//! Batch seaming: particles of two rims that lie near each other are sewn, the nearest first, each
//! to one other (Durupınar 2004, 3.2.4).

use crate::mesh::compiled::{Compiled, MeshSeam};
use nalgebra::Vector3;

/// The cloth with its near pairs as seams, for particles at the given places.
pub fn sewn(compiled: &Compiled, places: &[Vector3<f64>]) -> Compiled {
    let mut sewn = compiled.clone();
    for near in std::mem::take(&mut sewn.nearby) {
        let [a, b] = &near.sides;
        let mut candidates: Vec<(f64, [u32; 2])> = Vec::new();
        // Along one line, so that not every pair need be looked at.
        let mut along: Vec<u32> = b.clone();
        along.sort_by(|p, q| places[*p as usize].x.total_cmp(&places[*q as usize].x));
        for &p in a {
            let here = places[p as usize];
            let first = along.partition_point(|q| places[*q as usize].x < here.x - near.within);
            for &q in along.iter().skip(first) {
                let there = places[q as usize];
                if there.x > here.x + near.within {
                    break;
                }
                let gap = (there - here).norm();
                if gap <= near.within && p != q {
                    candidates.push((gap, [p, q]));
                }
            }
        }
        candidates.sort_by(|x, y| x.0.total_cmp(&y.0).then(x.1.cmp(&y.1)));
        // What another seam holds, such as a corner, is not drawn elsewhere.
        let mut taken = vec![false; compiled.particles.len()];
        for p in sewn.seams.iter().flat_map(|seam| seam.pairs.iter().flatten()) {
            taken[*p as usize] = true;
        }
        let mut pairs: Vec<[u32; 2]> = Vec::new();
        for (_, pair) in candidates {
            if pair.iter().all(|p| !taken[*p as usize]) {
                pair.iter().for_each(|p| taken[*p as usize] = true);
                pairs.push(pair);
            }
        }
        pairs.sort_unstable();
        sewn.seams.push(MeshSeam { name: near.name, pairs });
    }
    sewn
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drape::swatch::{fabric, rectangles};
    use crate::mesh::compiled::MeshNearby;

    #[test]
    fn each_particle_is_sewn_to_its_nearest_once() {
        let mut compiled = rectangles(2, [2, 3], 0.01, fabric(1e-5));
        let side = |panel: u32, column: u32| (0..4).map(|j| panel * 12 + j * 3 + column).collect();
        compiled.nearby.push(MeshNearby {
            name: "a -> b".to_owned(),
            sides: [side(0, 2), side(1, 0)],
            within: 0.006,
        });
        // The second stands 5 mm to the right of the first, and one row higher.
        let shift = |k: usize| if k < 12 { [0.0, 0.0] } else { [0.025, 0.01] };
        let places: Vec<Vector3<f64>> = compiled
            .particles
            .iter()
            .enumerate()
            .map(|(k, p)| Vector3::new(p[0] + shift(k)[0], p[1] + shift(k)[1], 0.0))
            .collect();
        let sewn = sewn(&compiled, &places);
        assert_eq!(sewn.seams[0].pairs, [[5, 12], [8, 15], [11, 18]]);
    }
}
