//! Smooth tubes: oval sections that change along an axis, as a distance-like field.

use super::part::Shape;
use nalgebra::{Point3, Vector3};

/// Spacing of the sections that a loft is stored as, m.
const STEP: f64 = 0.003;

/// Bound on the square of the slope by which a distance is shortened.
const MOST_STEEP: f64 = 6.0;

/// A section given by the figure's table, in the loft's own frame, m.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row {
    /// Place along the axis.
    pub(super) t: f64,
    /// Reach to +u and −u from the section's centre.
    pub(super) u: [f64; 2],
    /// Reach to +v and −v from the section's centre.
    pub(super) v: [f64; 2],
    /// Centre of the section off the axis, along u and v.
    pub(super) centre: [f64; 2],
    /// How much fuller than an ellipse the oval is between its axes, as a share of its reach.
    pub(super) fullness: f64,
}

/// Numbers in a row beside `t`.
const COLUMNS: usize = 7;

impl Row {
    fn columns(&self) -> [f64; COLUMNS] {
        let ([a, b], [c, d], [e, f]) = (self.u, self.v, self.centre);
        [a, b, c, d, e, f, self.fullness]
    }
}

/// Where a loft stands: its axis runs along `along` from `origin`; `u × v = along` or its
/// opposite, all unit and square to each other.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    /// Place of t = 0, m.
    pub(super) origin: Point3<f64>,
    /// First direction of a section.
    pub(super) u: Vector3<f64>,
    /// Second direction of a section.
    pub(super) v: Vector3<f64>,
    /// Direction of the axis.
    pub(super) along: Vector3<f64>,
}

impl Frame {
    /// Coordinates of `p`: along u, v and the axis.
    pub(super) fn inward(&self, p: Point3<f64>) -> [f64; 3] {
        let d = p - self.origin;
        [d.dot(&self.u), d.dot(&self.v), d.dot(&self.along)]
    }

    /// The point with the given coordinates along u, v and the axis.
    pub(super) fn outward(&self, [u, v, t]: [f64; 3]) -> Point3<f64> {
        self.origin + self.u * u + self.v * v + self.along * t
    }
}

/// A tube with rounded ends.
#[derive(Clone, Debug)]
pub(super) struct Loft {
    /// Where it stands.
    pub(super) frame: Frame,
    first: f64,
    last: f64,
    /// Length of the rounding beyond the first and last section, m.
    caps: [f64; 2],
    /// Control values of uniform cubic B-splines along the axis.
    table: Vec<[f64; COLUMNS]>,
}

impl Loft {
    /// A loft through `rows` (at least one, rising in `t`), rounded along the axis over the width
    /// that `smooth` gives for each `t` (m), with ends rounded over `caps` m.
    pub(super) fn new(
        frame: Frame,
        rows: &[Row],
        smooth: impl Fn(f64) -> f64,
        caps: [f64; 2],
    ) -> Loft {
        let first = rows.first().map_or(0.0, |r| r.t);
        let last = rows.last().map_or(0.0, |r| r.t).max(first + STEP);
        let count = ((last - first) / STEP).ceil() as usize + 1;
        let places: Vec<f64> = rows.iter().map(|r| r.t).collect();
        let widths: Vec<f64> = (0..count).map(|i| smooth(first + STEP * i as f64)).collect();
        let mut table = vec![[0.0; COLUMNS]; count];
        for column in 0..COLUMNS {
            let values: Vec<f64> = rows.iter().map(|r| r.columns()[column]).collect();
            let curve = Curve::new(&places, &values);
            let mut line: Vec<f64> =
                (0..count).map(|i| curve.at(first + STEP * i as f64)).collect();
            soften(&mut line, &widths);
            for (row, value) in table.iter_mut().zip(line) {
                row[column] = value;
            }
        }
        Loft { frame, first, last, caps, table }
    }

    /// Section numbers at `t` and their slopes along the axis.
    fn section(&self, t: f64) -> ([f64; COLUMNS], [f64; COLUMNS]) {
        let x = ((t - self.first) / STEP).clamp(0.0, (self.table.len() - 1) as f64);
        let i = x.floor();
        let s = x - i;
        let (s2, s3) = (s * s, s * s * s);
        let weights = [
            (1.0 - 3.0 * s + 3.0 * s2 - s3) / 6.0,
            (4.0 - 6.0 * s2 + 3.0 * s3) / 6.0,
            (1.0 + 3.0 * s + 3.0 * s2 - 3.0 * s3) / 6.0,
            s3 / 6.0,
        ];
        let slopes = [
            (-1.0 + 2.0 * s - s2) / 2.0,
            (-4.0 * s + 3.0 * s2) / 2.0,
            (1.0 + 2.0 * s - 3.0 * s2) / 2.0,
            s2 / 2.0,
        ];
        let (mut value, mut slope) = ([0.0; COLUMNS], [0.0; COLUMNS]);
        for k in 0..4 {
            let row = self.row(i as isize + k as isize - 1);
            for c in 0..COLUMNS {
                value[c] += weights[k] * row[c];
                slope[c] += slopes[k] * row[c] / STEP;
            }
        }
        (value, slope)
    }

    /// A row of the table; beyond its ends it goes on as it ended.
    fn row(&self, at: isize) -> [f64; COLUMNS] {
        let last = self.table.len() - 1;
        let on = |end: usize, inner: usize| {
            let (end, inner) = (&self.table[end], &self.table[inner]);
            std::array::from_fn(|c| 2.0 * end[c] - inner[c])
        };
        match usize::try_from(at) {
            Err(_) => on(0, 1.min(last)),
            Ok(at) if at > last => on(last, last.saturating_sub(1)),
            Ok(at) => self.table[at],
        }
    }

    /// Centre of the section at `t`, m.
    pub(super) fn centre(&self, t: f64) -> Point3<f64> {
        let (s, _) = self.section(t);
        self.frame.outward([s[4], s[5], t])
    }

    /// Reach of the section at `t` to +u, −u, +v, −v from its centre, m.
    pub(super) fn reach_at(&self, t: f64) -> [f64; 4] {
        let ([a, b, c, d, ..], _) = self.section(t);
        [a, b, c, d]
    }
}

impl Shape for Loft {
    fn corners(&self) -> Vec<Point3<f64>> {
        let mut points = Vec::new();
        for (i, row) in self.table.iter().enumerate() {
            let mut at = vec![self.first + STEP * i as f64];
            if i == 0 {
                at.push(self.first - self.caps[0]);
            }
            if i + 1 == self.table.len() {
                at.push(self.last + self.caps[1]);
            }
            for t in at {
                for u in [row[4] + row[0], row[4] - row[1]] {
                    for v in [row[5] + row[2], row[5] - row[3]] {
                        points.push(self.frame.outward([u, v, t]));
                    }
                }
            }
        }
        points
    }

    // Exact in sign, and with a slope near 1 close to the skin.
    fn value(&self, p: Point3<f64>) -> f64 {
        let [u, v, t] = self.frame.inward(p);
        let inner = t.clamp(self.first, self.last);
        let over = t - inner;
        let cap = self.caps[usize::from(over > 0.0)].max(1e-4);
        let (mut s, slope) = self.section(inner);
        if over != 0.0 {
            // A cap goes on as the end section was changing, for its own length at most.
            let on = over.clamp(-cap, cap);
            for c in 0..6 {
                s[c] += slope[c] * on;
            }
        }
        let (x, y) = (u - s[4], v - s[5]);
        let across = (x * x + y * y).sqrt();
        let side_u = usize::from(x < 0.0);
        let side_v = 2 + usize::from(y < 0.0);
        let (a, b) = (s[side_u].max(1e-3), s[side_v].max(1e-3));
        if across < 1e-6 {
            return (t - inner).abs() - a.min(b);
        }
        let (cos, sin) = (x / across, y / across);
        let (ca, sb) = (cos * cos / (a * a), sin * sin / (b * b));
        let square = 1.0 / (ca + sb);
        // An ellipse, blown up between its axes.
        let reach = square.sqrt() * (1.0 + s[6] * 4.0 * ca * sb * square * square);
        // Slopes of the ellipse's reach along the axis and round the section.
        let along = reach * square * (ca / a * slope[side_u] + sb / b * slope[side_v]);
        let shift = cos * slope[4] + sin * slope[5];
        let round = square * cos * sin * (1.0 / (a * a) - 1.0 / (b * b));
        let steep = along + shift;
        // Bounded: where a tube opens like a dish, its rim is nearer than its slope.
        let steep = steep * steep / (1.0 + steep * steep / MOST_STEEP);
        let slant = (1.0 + steep + round * round).sqrt();
        if over == 0.0 {
            return (across - reach) / slant;
        }
        // Half an ellipsoid over the end section, by the usual estimate of its distance.
        let (i, j) = (over / cap, across / reach);
        let k = (i * i + j * j).sqrt();
        let (i, j) = (i / cap, j / reach);
        let steepest = i * i + j * j;
        // The slant of the end section counts sideways, not beyond the tip.
        let slant = 1.0 + (slant - 1.0) * j * j / steepest;
        k * (k - 1.0) / (steepest.sqrt() * slant)
    }
}

/// Rounds a line of values by repeated means of neighbours, each place over its own width (m);
/// ends keep their value.
fn soften(line: &mut [f64], widths: &[f64]) {
    // Each pass adds a variance of half a step squared.
    let passes: Vec<usize> =
        widths.iter().map(|w| (2.0 * w * w / (STEP * STEP)).round() as usize).collect();
    let mut next = line.to_vec();
    let last = line.len().saturating_sub(1);
    for pass in 0..passes.iter().copied().max().unwrap_or(0) {
        for i in 0..line.len() {
            if passes[i] > pass {
                if i > 0 && i < last {
                    next[i] = (line[i - 1] + 2.0 * line[i] + line[i + 1]) / 4.0;
                }
            }
        }
        line.copy_from_slice(&next);
    }
}

/// A monotone cubic through points: it never leaves the range of two neighbours.
///
/// # References
/// Fritsch and Butland 1984, "A method for constructing local monotone piecewise cubic
/// interpolants" (slopes by weighted harmonic means).
#[derive(Clone, Debug)]
pub(super) struct Curve {
    x: Vec<f64>,
    y: Vec<f64>,
    slope: Vec<f64>,
}

impl Curve {
    /// A curve through `(x, y)`, `x` rising; level beyond its ends.
    pub(super) fn new(x: &[f64], y: &[f64]) -> Curve {
        let n = x.len().min(y.len());
        let mut slope = vec![0.0; n];
        for i in 1..n.saturating_sub(1) {
            let (h, k) = (x[i] - x[i - 1], x[i + 1] - x[i]);
            let (d, e) = ((y[i] - y[i - 1]) / h, (y[i + 1] - y[i]) / k);
            if d * e > 0.0 {
                let (w, z) = (2.0 * k + h, k + 2.0 * h);
                slope[i] = (w + z) / (w / d + z / e);
            }
        }
        if n > 1 {
            slope[0] = (y[1] - y[0]) / (x[1] - x[0]);
            slope[n - 1] = (y[n - 1] - y[n - 2]) / (x[n - 1] - x[n - 2]);
        }
        Curve { x: x[..n].to_vec(), y: y[..n].to_vec(), slope }
    }

    /// The value at `x`.
    pub(super) fn at(&self, x: f64) -> f64 {
        let (Some(first), Some(last)) = (self.x.first(), self.x.last()) else { return 0.0 };
        let x = x.clamp(*first, *last);
        let i = self.x.partition_point(|k| *k <= x).clamp(1, self.x.len().max(2) - 1) - 1;
        let Some(next) = self.x.get(i + 1) else { return self.y[i] };
        let h = next - self.x[i];
        let s = (x - self.x[i]) / h;
        let (p, q) = (self.y[i], self.y[i + 1]);
        let (m, n) = (self.slope[i] * h, self.slope[i + 1] * h);
        let (s2, s3) = (s * s, s * s * s);
        p * (2.0 * s3 - 3.0 * s2 + 1.0)
            + m * (s3 - 2.0 * s2 + s)
            + q * (3.0 * s2 - 2.0 * s3)
            + n * (s3 - s2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_passes_its_points_and_stays_between_them() {
        let (x, y) = ([0.0, 1.0, 1.5, 4.0], [2.0, 5.0, 5.0, 1.0]);
        let curve = Curve::new(&x, &y);
        for (x, y) in x.iter().zip(y) {
            assert!((curve.at(*x) - y).abs() < 1e-12);
        }
        let range = 1.0 - 1e-12..=5.0 + 1e-12;
        assert!((0..400).all(|i| range.contains(&curve.at(f64::from(i) * 0.01))));
        assert_eq!((curve.at(-3.0), curve.at(9.0)), (2.0, 1.0));
    }

    #[test]
    fn a_straight_tube_has_the_distance_of_a_tube() {
        let frame = Frame {
            origin: Point3::new(0.1, 0.2, 0.3),
            u: Vector3::x(),
            v: Vector3::z(),
            along: Vector3::y(),
        };
        let row = |t| Row { t, u: [0.05; 2], v: [0.05; 2], centre: [0.0; 2], fullness: 0.0 };
        let loft = Loft::new(frame, &[row(0.0), row(0.4)], |_| 0.01, [0.05; 2]);
        for (p, distance) in [
            (Point3::new(0.2, 0.4, 0.3), 0.05),
            (Point3::new(0.1, 0.4, 0.33), -0.02),
            (Point3::new(0.1, 0.0, 0.3), 0.15),
            (Point3::new(0.13, 0.66, 0.3), 0.0045_f64.sqrt() - 0.05),
        ] {
            assert!((loft.value(p) - distance).abs() < 1e-9, "{p}");
        }
    }
}
