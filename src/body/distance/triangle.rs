//! The nearest place of one triangle.

use nalgebra::Point3;

/// Which feature of a triangle a nearest place lies on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Feature {
    /// Within the face.
    Face,
    /// On the edge from corner `k` to corner `(k + 1) % 3`.
    Edge(usize),
    /// At corner `k`.
    Corner(usize),
}

/// The place of triangle `abc` nearest to `p`, its weights at a, b, c and the feature it lies on.
///
/// # References
/// Ericson 2005, *Real-Time Collision Detection*, section 5.1.5 (regions of Voronoi).
pub(super) fn nearest(
    p: Point3<f64>,
    [a, b, c]: [Point3<f64>; 3],
) -> (Point3<f64>, [f64; 3], Feature) {
    let (ab, ac) = (b - a, c - a);
    let ap = p - a;
    let (d1, d2) = (ab.dot(&ap), ac.dot(&ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return (a, [1.0, 0.0, 0.0], Feature::Corner(0));
    }
    let bp = p - b;
    let (d3, d4) = (ab.dot(&bp), ac.dot(&bp));
    if d3 >= 0.0 && d4 <= d3 {
        return (b, [0.0, 1.0, 0.0], Feature::Corner(1));
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        let t = share(d1, d1 - d3);
        return (a + ab * t, [1.0 - t, t, 0.0], Feature::Edge(0));
    }
    let cp = p - c;
    let (d5, d6) = (ab.dot(&cp), ac.dot(&cp));
    if d6 >= 0.0 && d5 <= d6 {
        return (c, [0.0, 0.0, 1.0], Feature::Corner(2));
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        let t = share(d2, d2 - d6);
        return (a + ac * t, [1.0 - t, 0.0, t], Feature::Edge(2));
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        let t = share(d4 - d3, (d4 - d3) + (d5 - d6));
        return (b + (c - b) * t, [0.0, 1.0 - t, t], Feature::Edge(1));
    }
    let sum = va + vb + vc;
    let (v, w) = (share(vb, sum), share(vc, sum));
    (a + ab * v + ac * w, [1.0 - v - w, v, w], Feature::Face)
}

/// `part / whole`, 0 where the whole is 0 (a triangle without area).
fn share(part: f64, whole: f64) -> f64 {
    if whole > 0.0 { part / whole } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangle() -> [Point3<f64>; 3] {
        [Point3::origin(), Point3::new(1.0, 0.0, 0.0), Point3::new(0.0, 1.0, 0.0)]
    }

    #[test]
    fn each_region_gives_its_feature() {
        let cases = [
            ([0.2, 0.2, 3.0], [0.2, 0.2, 0.0], Feature::Face),
            ([-1.0, -1.0, 0.5], [0.0, 0.0, 0.0], Feature::Corner(0)),
            ([2.0, -0.5, 0.0], [1.0, 0.0, 0.0], Feature::Corner(1)),
            ([-0.5, 2.0, 0.0], [0.0, 1.0, 0.0], Feature::Corner(2)),
            ([0.4, -1.0, 0.0], [0.4, 0.0, 0.0], Feature::Edge(0)),
            ([1.0, 1.0, 0.0], [0.5, 0.5, 0.0], Feature::Edge(1)),
            ([-1.0, 0.4, 0.0], [0.0, 0.4, 0.0], Feature::Edge(2)),
        ];
        for (p, q, feature) in cases {
            let (at, weights, found) = nearest(Point3::from(p), triangle());
            assert_eq!(found, feature);
            assert!((at - Point3::from(q)).norm() < 1e-15);
            assert!((weights.iter().sum::<f64>() - 1.0).abs() < 1e-15);
        }
    }

    #[test]
    fn a_triangle_without_area_still_answers() {
        let p = Point3::new(0.0, 1.0, 0.0);
        let (at, _, _) = nearest(p, [Point3::new(1.0, 1.0, 0.0); 3]);
        assert!((at - p).norm() - 1.0 < 1e-15);
    }
}
