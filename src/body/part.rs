//! Parts of a form as fields of space: negative inside, about metres near the skin.

use nalgebra::{Point3, Vector3};

/// Beyond this distance from a part's box, the part cannot touch any fillet, m: more than
/// the widest fillet of the tallest body.
const FAR: f64 = 0.085;

/// Something with a skin.
pub(super) trait Shape {
    /// About the distance to the skin, m; negative inside.
    fn value(&self, p: Point3<f64>) -> f64;
    /// Points whose box holds the whole shape.
    fn corners(&self) -> Vec<Point3<f64>>;
}

/// A box round a part.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    pub(super) low: Point3<f64>,
    pub(super) high: Point3<f64>,
}

impl Bounds {
    /// The box of points.
    pub(super) fn of(points: impl IntoIterator<Item = Point3<f64>>) -> Bounds {
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for p in points {
            for k in 0..3 {
                low[k] = low[k].min(p[k]);
                high[k] = high[k].max(p[k]);
            }
        }
        Bounds { low: low.into(), high: high.into() }
    }

    /// Distance from `p` to the box, m; 0 inside.
    fn gap(&self, p: Point3<f64>) -> f64 {
        let mut sum = 0.0;
        for k in 0..3 {
            let d = (self.low[k] - p[k]).max(p[k] - self.high[k]).max(0.0);
            sum += d * d;
        }
        sum.sqrt()
    }
}

/// A shape with the box that lets far points skip it.
#[derive(Clone, Debug)]
pub(super) struct Part<S> {
    pub(super) shape: S,
    pub(super) bounds: Bounds,
}

impl<S: Shape> Part<S> {
    pub(super) fn new(shape: S) -> Self {
        Part { bounds: Bounds::of(shape.corners()), shape }
    }

    /// The value of the shape; far away the distance to its box.
    pub(super) fn value(&self, p: Point3<f64>) -> f64 {
        let gap = self.bounds.gap(p);
        if gap > FAR { gap } else { self.shape.value(p) }
    }
}

/// The lesser of two, with a fillet of reach `k` where they meet; smooth to the second derivative.
///
/// # References
/// Quílez 2013, "smooth minimum" (cubic polynomial).
pub(super) fn join(a: f64, b: f64, k: f64) -> f64 {
    let h = (k - (a - b).abs()).max(0.0) / k;
    a.min(b) - h * h * h * k / 6.0
}

/// The greater of two, rounded in the same way.
pub(super) fn cut(a: f64, b: f64, k: f64) -> f64 {
    -join(-a, -b, k)
}

/// A gentle rise or hollow of the skin: breast, buttock, shoulder blade, the pit above a collar
/// bone. It moves the skin by `height` at its middle and by nothing outside its radii.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bump {
    middle: Point3<f64>,
    axes: [Vector3<f64>; 3],
    /// Radii along each axis and against it, squared.
    squares: [[f64; 2]; 3],
    /// Square of the longest radius.
    reach: f64,
    height: f64,
}

impl Bump {
    /// About `middle`, with radii along and against each of three unit axes square to each other.
    pub(super) fn new(
        middle: Point3<f64>,
        axes: [Vector3<f64>; 3],
        radii: [[f64; 2]; 3],
        height: f64,
    ) -> Self {
        let squares = radii.map(|pair| pair.map(|r| (r * r).max(1e-8)));
        let reach = squares.iter().flatten().copied().fold(0.0, f64::max);
        Bump { middle, axes, squares, reach, height }
    }

    /// How far the skin is moved outwards at `p`, m.
    pub(super) fn rise(&self, p: Point3<f64>) -> f64 {
        let d = p - self.middle;
        if d.norm_squared() > self.reach {
            return 0.0;
        }
        let mut sum = 0.0;
        for (axis, [along, against]) in self.axes.iter().zip(&self.squares) {
            let c = d.dot(axis);
            sum += c * c / if c > 0.0 { *along } else { *against };
        }
        let left = (1.0 - sum).max(0.0);
        self.height * left * left * left
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fillet_ends_where_it_reaches() {
        assert_eq!(join(0.1, 0.3, 0.2), 0.1);
        assert!(join(0.1, 0.1, 0.2) < 0.1 && cut(0.1, 0.1, 0.2) > 0.1);
    }

    #[test]
    fn a_bump_rises_at_its_middle_and_ends_at_its_radii() {
        let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
        let bump =
            Bump::new(Point3::new(0.0, 1.0, 0.0), axes, [[0.1, 0.2], [0.3; 2], [0.1; 2]], 0.02);
        assert_eq!(bump.rise(Point3::new(0.0, 1.0, 0.0)), 0.02);
        assert_eq!(bump.rise(Point3::new(0.1, 1.0, 0.0)), 0.0);
        assert!(bump.rise(Point3::new(-0.1, 1.0, 0.0)) > 0.0);
    }
}
