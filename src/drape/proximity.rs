//! The nearest places of a point and a triangle, and of two segments (Ericson 2004, chapter 5).

use nalgebra::Vector3;

type V = Vector3<f64>;

/// Distance below which features come no nearer, m: a thousandth of the thickness of cloth, a million
/// times what rounding makes of places.
const FLOOR: f64 = 1e-6;

/// Two features of a cloth: a point and a triangle, or two edges. Knots: point, then the
/// triangle's three; or the first edge's two, then the second's two.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Pair {
    /// A point over a triangle.
    Point([u32; 4]),
    /// An edge across an edge.
    Edges([u32; 4]),
}

impl Pair {
    /// Its knots.
    pub fn knots(&self) -> [u32; 4] {
        match self {
            Pair::Point(k) | Pair::Edges(k) => *k,
        }
    }

    /// How many of its knots belong to the first feature.
    pub fn split(&self) -> usize {
        if matches!(self, Pair::Point(_)) { 1 } else { 2 }
    }

    /// Whether the two features have no knot in common.
    pub fn is_apart(&self) -> bool {
        let knots = self.knots();
        let (first, second) = knots.split_at(self.split());
        !first.iter().any(|k| second.contains(k))
    }

    /// Weights of its knots such that the weighted sum of their places is the shortest way from
    /// the second feature to the first.
    pub fn weights(&self, x: &[V; 4]) -> [f64; 4] {
        match self {
            Pair::Point(_) => {
                let w = on_triangle(&x[0], &x[1], &x[2], &x[3]);
                [1.0, -w[0], -w[1], -w[2]]
            }
            Pair::Edges(_) => {
                let [s, t] = on_segments(&x[0], &x[1], &x[2], &x[3]);
                [1.0 - s, s, t - 1.0, -t]
            }
        }
    }

    /// The shortest way from the second feature to the first.
    pub fn way(&self, x: &[V; 4]) -> V {
        let w = self.weights(x);
        x[0] * w[0] + x[1] * w[1] + x[2] * w[2] + x[3] * w[3]
    }

    /// The share of a movement from x to x + dx that can be made while the distance stays above
    /// `keep` times what it is at the start; conservative advancement (Li, Kaufman and
    /// Jiang 2021, additive form). 1 if all of it can. Features within a micrometre of each other come no
    /// nearer at all: by a share of the distance in every step they would come to lie in each other,
    /// and rounding would decide where they go from there.
    pub fn advance(&self, x: &[V; 4], dx: &[V; 4], keep: f64) -> f64 {
        let (share, start) = self.approach(x, dx, keep);
        let near =
            start < FLOOR && self.way(&[0, 1, 2, 3].map(|k| x[k] + dx[k] * share)).norm() < start;
        if near { 0.0 } else { share }
    }

    /// The share without regard to the floor, and the distance at the start.
    fn approach(&self, x: &[V; 4], dx: &[V; 4], keep: f64) -> (f64, f64) {
        let mean = (dx[0] + dx[1] + dx[2] + dx[3]) * 0.25;
        let d = dx.map(|d| d - mean);
        let [a, b, c, e] = d.map(|d| d.norm());
        let reach = match self {
            Pair::Point(_) => a + b.max(c).max(e),
            Pair::Edges(_) => a.max(b) + c.max(e),
        };
        let start = self.way(x).norm();
        let least = keep * start;
        if reach <= start - least {
            return (1.0, start);
        }
        let mut time = 0.0;
        let mut distance = start;
        for _ in 0..64 {
            let step = 0.95 * (distance - least) / reach;
            if time + step >= 1.0 {
                return (1.0, start);
            }
            time += step;
            let at = [0, 1, 2, 3].map(|k| x[k] + d[k] * time);
            distance = self.way(&at).norm();
            // Close enough to the least distance to be called a hit.
            if distance - least < 0.05 * (start - least) {
                return (time, start);
            }
        }
        (time, start)
    }
}

/// Weights of a triangle's corners at its nearest place to p.
fn on_triangle(p: &V, a: &V, b: &V, c: &V) -> [f64; 3] {
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let (d1, d2) = (ab.dot(&ap), ac.dot(&ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return [1.0, 0.0, 0.0];
    }
    let bp = p - b;
    let (d3, d4) = (ab.dot(&bp), ac.dot(&bp));
    if d3 >= 0.0 && d4 <= d3 {
        return [0.0, 1.0, 0.0];
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 && d1 > d3 {
        let v = d1 / (d1 - d3);
        return [1.0 - v, v, 0.0];
    }
    let cp = p - c;
    let (d5, d6) = (ab.dot(&cp), ac.dot(&cp));
    if d6 >= 0.0 && d5 <= d6 {
        return [0.0, 0.0, 1.0];
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 && d2 > d6 {
        let w = d2 / (d2 - d6);
        return [1.0 - w, 0.0, w];
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 && (d4 - d3) + (d5 - d6) > 0.0 {
        let w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return [0.0, 1.0 - w, w];
    }
    let whole = va + vb + vc;
    if !(whole.abs() > 0.0) {
        return [1.0, 0.0, 0.0];
    }
    let (v, w) = (vb / whole, vc / whole);
    [1.0 - v - w, v, w]
}

/// Shares of the way along the segments p–q and r–s of their nearest places.
fn on_segments(p: &V, q: &V, r: &V, s: &V) -> [f64; 2] {
    let (d1, d2, w) = (q - p, s - r, p - r);
    let (a, e, f) = (d1.norm_squared(), d2.norm_squared(), d2.dot(&w));
    if a <= 1e-24 && e <= 1e-24 {
        return [0.0, 0.0];
    }
    if a <= 1e-24 {
        return [0.0, (f / e).clamp(0.0, 1.0)];
    }
    let c = d1.dot(&w);
    if e <= 1e-24 {
        return [(-c / a).clamp(0.0, 1.0), 0.0];
    }
    let b = d1.dot(&d2);
    let denominator = a * e - b * b;
    let mut u = if denominator > 1e-12 * a * e {
        ((b * f - c * e) / denominator).clamp(0.0, 1.0)
    } else {
        0.5
    };
    let mut t = (b * u + f) / e;
    if t < 0.0 {
        t = 0.0;
        u = (-c / a).clamp(0.0, 1.0);
    } else if t > 1.0 {
        t = 1.0;
        u = ((b - c) / a).clamp(0.0, 1.0);
    }
    [u, t]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shortest_way_is_found() {
        let t = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(V::from);
        for (p, far) in [
            ([0.2, 0.2, 0.5], 0.5),
            ([-1.0, -1.0, 0.0], 2f64.sqrt()),
            ([1.0, 1.0, 0.0], 0.5f64.sqrt()),
        ] {
            let x = [V::from(p), t[0], t[1], t[2]];
            assert!((Pair::Point([0; 4]).way(&x).norm() - far).abs() < 1e-12);
        }
        let x = [[-1.0, 0.0, 0.3], [1.0, 0.0, 0.3], [0.0, -1.0, 0.0], [0.0, 2.0, 0.0]].map(V::from);
        assert!((Pair::Edges([0; 4]).way(&x) - V::new(0.0, 0.0, 0.3)).norm() < 1e-12);
    }

    /// A point that falls through a triangle is stopped above it, one that passes by is not.
    #[test]
    fn a_movement_is_cut_before_it_goes_through() {
        let x = [[0.2, 0.2, 0.1], [0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(V::from);
        let mut dx = [V::zeros(); 4];
        dx[0].z = -1.0;
        let share = Pair::Point([0; 4]).advance(&x, &dx, 0.2);
        assert!((0.05..=0.08).contains(&share), "{share}");
        dx[0] = V::new(-3.0, 0.0, 0.0);
        assert!(Pair::Point([0; 4]).advance(&x, &dx, 0.2) == 1.0);
    }

    /// However often a point is pressed against a triangle, it stays above; it may go any time.
    #[test]
    fn what_is_pressed_for_ever_does_not_come_through() {
        let mut x =
            [[0.2, 0.2, 0.1], [0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(V::from);
        let mut dx = [V::zeros(); 4];
        for _ in 0..200 {
            dx[0].z = -1.0;
            x[0] += dx[0] * Pair::Point([0; 4]).advance(&x, &dx, 0.2);
        }
        assert!((0.1 * FLOOR..FLOOR).contains(&x[0].z), "{}", x[0].z);
        dx[0].z = 1.0;
        assert!(Pair::Point([0; 4]).advance(&x, &dx, 0.2) == 1.0);
    }
}
