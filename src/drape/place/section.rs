//! Closed convex lines round a trunk, height by height.

use crate::body::surface::{BodyPart, Surface};
use nalgebra::Point3;

/// Heights between two sections, m.
const STEP: f64 = 0.01;
/// Half the slab of skin that one section encloses, m; smooths the way from height to height.
const SLAB: f64 = 0.04;
/// Cloth that begins no further below the neck than this goes round it and not round the trunk, m.
const COLLAR: f64 = 0.06;
/// Half the length of line over which its direction is taken, m.
const TANGENT: f64 = 0.02;
/// Corners of the disc by which a section is widened.
const ROUND: usize = 48;

/// The height on which a collar stands, at the sides of the neck, m; `None` if cloth that reaches down
/// to `low` is none.
pub(super) fn collar_base(body: &Surface, low: f64) -> Option<f64> {
    let neck = body.landmarks.get("neck").map(|_| super::centre(body, "neck").y)?;
    let side =
        body.landmarks.get("neck_side.left").map(|_| super::centre(body, "neck_side.left").y);
    (low > neck - COLLAR).then_some(side.unwrap_or(neck))
}

/// Convex sections of trunk, neck and legs at equal steps of height, not yet widened.
pub(super) struct Sections {
    low: f64,
    hulls: Vec<Vec<[f64; 2]>>,
}

impl Sections {
    /// Sections of `body` from `low` to `high`. Of cloth that reaches over the bust every section
    /// above also encloses the one at the bust, of cloth that reaches over the hip every one below,
    /// so that it hangs straight there; what reaches neither, a band or a flounce, is straight.
    pub(super) fn new(body: &Surface, low: f64, high: f64) -> Self {
        let count = ((high - low) / STEP).ceil().clamp(1.0, 1000.0) as usize + 1;
        // A collar or a hood goes round neck and head.
        let collar = collar_base(body, low).is_some();
        let keep = |part: BodyPart| match part {
            BodyPart::Neck => true,
            BodyPart::Head => collar,
            BodyPart::Trunk | BodyPart::LeftLeg | BodyPart::RightLeg => !collar,
            BodyPart::LeftArm | BodyPart::RightArm => false,
        };
        let mut slabs: Vec<Vec<[f64; 2]>> = vec![Vec::new(); count];
        for (k, vertex) in body.vertices.iter().enumerate() {
            if !body.parts.get(k).copied().is_none_or(keep) {
                continue;
            }
            let first = ((vertex.y - SLAB - low) / STEP).ceil().max(0.0) as usize;
            let last = ((vertex.y + SLAB - low) / STEP).floor();
            if last < 0.0 {
                continue;
            }
            for slab in slabs.iter_mut().take(last as usize + 1).skip(first) {
                slab.push([vertex.x, vertex.z]);
            }
        }
        let mut hulls: Vec<Vec<[f64; 2]>> = slabs.into_iter().map(hull).collect();
        let level = |name: &str| {
            let height = super::centre(body, name).y;
            (body.landmarks.contains_key(name) && (low..=high).contains(&height))
                .then(|| ((height - low) / STEP).round().clamp(0.0, (count - 1) as f64) as usize)
        };
        let (bust, hip) = (level("bust").or_else(|| level("chest")), level("hip"));
        if bust.is_none() && hip.is_none() {
            let whole = hull(hulls.concat());
            hulls.fill(whole);
        }
        if let Some(bust) = bust {
            for k in bust + 1..count {
                let mut both = hulls[k].clone();
                both.extend_from_slice(&hulls[k - 1]);
                hulls[k] = hull(both);
            }
        }
        if let Some(hip) = hip {
            for k in (0..hip).rev() {
                let mut both = hulls[k].clone();
                both.extend_from_slice(&hulls[k + 1]);
                hulls[k] = hull(both);
            }
        }
        // Heights without skin (above the head) take the nearest section below.
        for k in 1..count {
            if hulls[k].len() < 3 {
                hulls[k] = hulls[k - 1].clone();
            }
        }
        for k in (0..count - 1).rev() {
            if hulls[k].len() < 3 {
                hulls[k] = hulls[k + 1].clone();
            }
        }
        Sections { low, hulls }
    }

    /// Number of sections.
    pub(super) fn count(&self) -> usize {
        self.hulls.len()
    }

    /// The number of the section at a height, with its fraction.
    pub(super) fn at(&self, height: f64) -> (usize, f64) {
        let t = ((height - self.low) / STEP).clamp(0.0, (self.hulls.len() - 1) as f64);
        let k = (t as usize).min(self.hulls.len().saturating_sub(2));
        (k, t - k as f64)
    }

    /// Length round section `k`, m.
    pub(super) fn girth(&self, k: usize) -> f64 {
        perimeter(&self.hulls[k])
    }

    /// Section `k` widened by `gap` all round.
    pub(super) fn ring(&self, k: usize, gap: f64) -> Ring {
        Ring::new(widen(&self.hulls[k], gap.max(1e-3)))
    }
}

/// A closed convex line in the plane of x and z, walked by arc length from its middle in front
/// towards the wearer's left.
pub(super) struct Ring {
    points: Vec<[f64; 2]>,
    lengths: Vec<f64>,
}

impl Ring {
    fn new(hull: Vec<[f64; 2]>) -> Self {
        // The hull runs anticlockwise in (x, z): from +x (left) to +z (front). Turn it round and
        // begin where it crosses x = middle in front.
        let middle = {
            let low = hull.iter().map(|p| p[0]).fold(f64::INFINITY, f64::min);
            let high = hull.iter().map(|p| p[0]).fold(f64::NEG_INFINITY, f64::max);
            if low.is_finite() { 0.5 * (low + high) } else { 0.0 }
        };
        let n = hull.len();
        let turned: Vec<[f64; 2]> = hull.into_iter().rev().collect();
        let mut points = Vec::with_capacity(n + 2);
        for k in 0..n {
            let (a, b) = (turned[k], turned[(k + 1) % n]);
            if a[0] <= middle && b[0] > middle {
                let t = (middle - a[0]) / (b[0] - a[0]);
                points.push([middle, a[1] + t * (b[1] - a[1])]);
                points.extend((1..=n).map(|j| turned[(k + j) % n]));
                let first = points[0];
                points.push(first);
                break;
            }
        }
        if points.is_empty() {
            points = vec![[0.0, 0.1], [0.1, 0.0], [0.0, -0.1], [-0.1, 0.0], [0.0, 0.1]];
        }
        let mut lengths = vec![0.0];
        for pair in points.windows(2) {
            let last = lengths[lengths.len() - 1];
            lengths.push(last + libm::hypot(pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]));
        }
        Ring { points, lengths }
    }

    /// Its length, m.
    pub(super) fn girth(&self) -> f64 {
        self.lengths[self.lengths.len() - 1]
    }

    /// Which part of the round lies nearest to a place, from 0 to 1.
    pub(super) fn share(&self, place: &Point3<f64>) -> f64 {
        let mut nearest = (f64::INFINITY, 0.0);
        for (k, pair) in self.points.windows(2).enumerate() {
            let (a, b) = (pair[0], pair[1]);
            let (d, p) = ([b[0] - a[0], b[1] - a[1]], [place.x - a[0], place.z - a[1]]);
            let square = d[0] * d[0] + d[1] * d[1];
            let t = if square > 0.0 { (p[0] * d[0] + p[1] * d[1]) / square } else { 0.0 };
            let t = t.clamp(0.0, 1.0);
            let far = libm::hypot(p[0] - t * d[0], p[1] - t * d[1]);
            if far < nearest.0 {
                let span = self.lengths[k + 1] - self.lengths[k];
                nearest = (far, self.lengths[k] + t * span);
            }
        }
        nearest.1 / self.girth().max(1e-9)
    }

    /// The point `out` outside of the one at arc length `s`, m.
    pub(super) fn beside(&self, s: f64, out: f64) -> [f64; 2] {
        let [x, z] = self.point(s);
        if out == 0.0 {
            return [x, z];
        }
        let (a, b) = (self.point(s - TANGENT), self.point(s + TANGENT));
        let length = libm::hypot(b[0] - a[0], b[1] - a[1]).max(1e-9);
        // It runs from the front to the wearer's left: outside is at its left seen from below.
        [x - out * (b[1] - a[1]) / length, z + out * (b[0] - a[0]) / length]
    }

    /// The point at arc length `s` (any number; it goes round) as x and z.
    pub(super) fn point(&self, s: f64) -> [f64; 2] {
        let girth = self.girth();
        let s = s - girth * (s / girth).floor();
        let k = self.lengths.partition_point(|&l| l <= s).clamp(1, self.points.len() - 1);
        let (a, b) = (self.points[k - 1], self.points[k]);
        let span = self.lengths[k] - self.lengths[k - 1];
        let t = if span > 0.0 { (s - self.lengths[k - 1]) / span } else { 0.0 };
        [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])]
    }
}

fn perimeter(hull: &[[f64; 2]]) -> f64 {
    (0..hull.len())
        .map(|k| {
            let (a, b) = (hull[k], hull[(k + 1) % hull.len()]);
            libm::hypot(b[0] - a[0], b[1] - a[1])
        })
        .sum()
}

/// The convex hull, anticlockwise (monotone chain, Andrew 1979).
fn hull(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    points.dedup();
    if points.len() < 3 {
        return points;
    }
    let turn = |o: [f64; 2], a: [f64; 2], b: [f64; 2]| {
        (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])
    };
    let half = |points: &mut dyn Iterator<Item = [f64; 2]>| {
        let mut chain: Vec<[f64; 2]> = Vec::new();
        for p in points {
            while chain.len() > 1 && turn(chain[chain.len() - 2], chain[chain.len() - 1], p) <= 0.0
            {
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut lower = half(&mut points.iter().copied());
    lower.extend(half(&mut points.iter().rev().copied()));
    lower
}

/// The convex line at distance `gap` outside a hull (its Minkowski sum with a disc).
fn widen(hull_points: &[[f64; 2]], gap: f64) -> Vec<[f64; 2]> {
    let mut all = Vec::with_capacity(hull_points.len() * ROUND);
    for p in hull_points {
        for k in 0..ROUND {
            let angle = std::f64::consts::TAU * k as f64 / ROUND as f64;
            all.push([p[0] + gap * libm::cos(angle), p[1] + gap * libm::sin(angle)]);
        }
    }
    hull(all)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_widened_square_gains_the_girth_of_the_disc() {
        let square = vec![[-0.1, -0.1], [0.1, -0.1], [0.1, 0.1], [-0.1, 0.1]];
        let ring = Ring::new(widen(&square, 0.05));
        // A polygon of 48 corners is short of the circle by (π/48)²/6 of its length.
        let exact = 0.8 + std::f64::consts::TAU * 0.05;
        assert!((ring.girth() - exact).abs() < 1e-3 * exact);
        let front = ring.point(0.0);
        assert!(front[0].abs() < 1e-12 && (front[1] - 0.15).abs() < 1e-12);
        let left = ring.point(ring.girth() / 4.0);
        assert!(left[0] > 0.14, "a quarter round lies at the wearer's left: {left:?}");
        assert!(
            (ring.beside(0.0, 0.02)[1] - 0.17).abs() < 1e-9,
            "outside of the front lies before it"
        );
        let back = ring.point(-ring.girth() / 2.0);
        assert!(back[0].abs() < 1e-3 && back[1] < -0.14);
    }
}
