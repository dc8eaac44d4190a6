//! Polygons of the plane: areas, sides, distances, angles of triangles.

/// A place of the plane, m.
pub type Place = [f64; 2];

/// Difference `b − a`.
pub fn from_to(a: Place, b: Place) -> Place {
    [b[0] - a[0], b[1] - a[1]]
}

/// Length of the straight way from `a` to `b`, m.
pub fn distance(a: Place, b: Place) -> f64 {
    let [x, y] = from_to(a, b);
    (x * x + y * y).sqrt()
}

/// Twice the signed area of the triangle `a b c`, m²: positive when it runs anticlockwise.
pub fn turn(a: Place, b: Place, c: Place) -> f64 {
    let ([x, y], [p, q]) = (from_to(a, b), from_to(a, c));
    x * q - y * p
}

/// Area within a closed line of straight sides, m²; negative when it runs clockwise.
pub fn signed_area(ring: &[Place]) -> f64 {
    let Some(&origin) = ring.first() else { return 0.0 };
    ring.windows(2).map(|side| turn(origin, side[0], side[1])).sum::<f64>() / 2.0
}

/// Whether `place` lies within closed lines taken together by the even-odd rule. Places on a
/// line itself may be told either way.
pub fn contains(rings: &[Vec<Place>], place: Place) -> bool {
    let mut inside = false;
    for (a, b) in rings.iter().flat_map(|ring| sides(ring)) {
        if (a[1] <= place[1]) != (b[1] <= place[1]) {
            let share = (place[1] - a[1]) / (b[1] - a[1]);
            inside ^= a[0] + share * (b[0] - a[0]) > place[0];
        }
    }
    inside
}

/// The sides of a closed line, the last one back to the first corner.
pub fn sides(ring: &[Place]) -> impl Iterator<Item = (Place, Place)> + '_ {
    ring.iter().copied().zip(ring.iter().copied().cycle().skip(1))
}

/// The place of the stretch `a b` nearest to `place`, as a share of the way from `a` to `b`.
pub fn nearest_share(place: Place, a: Place, b: Place) -> f64 {
    let (way, to) = (from_to(a, b), from_to(a, place));
    let square = way[0] * way[0] + way[1] * way[1];
    if square > 0.0 { ((way[0] * to[0] + way[1] * to[1]) / square).clamp(0.0, 1.0) } else { 0.0 }
}

/// The place that lies the given share of the way from `a` to `b`.
pub fn between(a: Place, b: Place, share: f64) -> Place {
    [a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])]
}

/// Distance of `place` from the stretch `a b`, m.
pub fn distance_to_side(place: Place, a: Place, b: Place) -> f64 {
    distance(place, between(a, b, nearest_share(place, a, b)))
}

/// Where two stretches meet, as shares of the ways `a b` and `c d`; `None` when they pass each
/// other at more than `tolerance` (m).
///
/// Stretches that lie on each other meet at the first place of `a b` that touches `c d`.
pub fn meeting(
    (a, b): (Place, Place),
    (c, d): (Place, Place),
    tolerance: f64,
) -> Option<(f64, f64)> {
    let (ab, cd) = (from_to(a, b), from_to(c, d));
    // Most stretches that are asked about lie beside each other.
    let slack = tolerance.max(1e-9 * (ab[0].abs() + ab[1].abs() + cd[0].abs() + cd[1].abs()));
    let apart = |axis: usize| {
        a[axis].max(b[axis]) + slack < c[axis].min(d[axis])
            || c[axis].max(d[axis]) + slack < a[axis].min(b[axis])
    };
    if apart(0) || apart(1) {
        return None;
    }
    let cross = ab[0] * cd[1] - ab[1] * cd[0];
    if cross != 0.0 {
        let ac = from_to(a, c);
        let s = (ac[0] * cd[1] - ac[1] * cd[0]) / cross;
        let t = (ac[0] * ab[1] - ac[1] * ab[0]) / cross;
        let met = (0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t);
        // Of stretches along one line rounding alone decides where they would cross.
        let gap = distance(between(a, b, s), between(c, d, t));
        if met && gap <= tolerance.max(1e-9 * distance(a, b).max(distance(c, d))) {
            return Some((s, t));
        }
    }
    let mut touches = [
        (0.0, nearest_share(a, c, d)),
        (1.0, nearest_share(b, c, d)),
        (nearest_share(c, a, b), 0.0),
        (nearest_share(d, a, b), 1.0),
    ];
    touches.sort_by(|x, y| x.0.total_cmp(&y.0));
    touches.into_iter().find(|&(s, t)| distance(between(a, b, s), between(c, d, t)) <= tolerance)
}

/// The cosine of the smallest angle of the triangle `a b c`; 1 for a triangle without an area
/// or turned over. The smaller the cosine, the better the triangle.
pub fn sharpest(a: Place, b: Place, c: Place) -> f64 {
    let area = turn(a, b, c);
    let (ab, bc, ca) = (distance(a, b), distance(b, c), distance(c, a));
    if area <= 0.0 || ab * bc * ca == 0.0 {
        return 1.0;
    }
    // The smallest angle stands opposite the shortest side.
    let (near, p, q) = if ab <= bc && ab <= ca {
        (ab, bc, ca)
    } else if bc <= ca {
        (bc, ca, ab)
    } else {
        (ca, ab, bc)
    };
    (((p * p + q * q) - near * near) / (2.0 * p * q)).clamp(-1.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: [Place; 4] = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];

    #[test]
    fn area_has_the_sign_of_the_sense() {
        assert_eq!(signed_area(&SQUARE), 4.0);
        let mut clockwise = SQUARE;
        clockwise.reverse();
        assert_eq!(signed_area(&clockwise), -4.0);
        assert_eq!(signed_area(&[]), 0.0);
    }

    #[test]
    fn a_hole_is_outside() {
        let hole = vec![[0.5, 0.5], [0.5, 1.5], [1.5, 1.5], [1.5, 0.5]];
        let rings = [SQUARE.to_vec(), hole];
        assert!(contains(&rings, [0.25, 1.0]));
        assert!(!contains(&rings, [1.0, 1.0]));
        assert!(!contains(&rings, [3.0, 1.0]));
    }

    #[test]
    fn stretches_meet_or_pass() {
        let cross = meeting(([0.0, 0.0], [2.0, 0.0]), ([0.5, -1.0], [0.5, 1.0]), 0.0);
        assert_eq!(cross, Some((0.25, 0.5)));
        let apart = (([0.0, 0.0], [1.0, 0.0]), ([0.0, 0.1], [1.0, 0.1]));
        assert_eq!(meeting(apart.0, apart.1, 0.09), None);
        assert_eq!(meeting(apart.0, apart.1, 0.11), Some((0.0, 0.0)));
        // Two stretches of one slanting line, which do not reach each other.
        let slanting = |from: f64, to: f64| ([from * 0.56, from * 0.83], [to * 0.56, to * 0.83]);
        assert_eq!(meeting(slanting(0.1, 0.2), slanting(0.3, 0.4), 1e-9), None);
        assert_eq!(meeting(slanting(0.3, 0.7), slanting(0.9, 1.1), 1e-9), None);
        // Two stretches of one line, the second reaching into the first.
        let lying = meeting(([0.0, 0.0], [1.0, 0.0]), ([0.5, 0.0], [2.0, 0.0]), 1e-12);
        assert_eq!(lying, Some((0.5, 0.0)));
    }

    #[test]
    fn the_sharpest_angle_is_found() {
        let half = 0.5;
        let even = sharpest([0.0, 0.0], [1.0, 0.0], [half, 0.75f64.sqrt()]);
        assert!((even - 0.5).abs() < 1e-15, "60 degrees, got the cosine {even}");
        let right = sharpest([0.0, 0.0], [1.0, 0.0], [1.0, 1.0]);
        assert!((right - half.sqrt()).abs() < 1e-15, "45 degrees, got the cosine {right}");
        assert_eq!(sharpest([0.0, 0.0], [1.0, 1.0], [1.0, 0.0]), 1.0, "turned over");
    }
}
