//! Edges as curves: between directions, through points, as bows of a circle; measuring and
//! cutting them by arc length. Lengths in metres, directions in radians from +x anticlockwise.

use kurbo::{
    Affine, BezPath, CubicBez, ParamCurve, ParamCurveArclen, ParamCurveDeriv, PathEl, PathSeg,
    Point, Vec2,
};
use std::f64::consts::{PI, TAU};

/// Accuracy of arc lengths, m.
const LENGTH_ACCURACY: f64 = 1e-9;

/// Largest arc that one cubic stands for, rad. The error of a cubic grows with the sixth power
/// of its angle; at 22.5° it is 7e-8 of the radius.
const ARC_STEP: f64 = PI / 8.0;

/// The direction of a vector.
pub fn direction(v: Vec2) -> f64 {
    libm::atan2(v.y, v.x)
}

/// A unit vector in a direction.
pub fn unit(direction: f64) -> Vec2 {
    Vec2::new(libm::cos(direction), libm::sin(direction))
}

/// An angle brought into (−π, π].
pub fn turned(angle: f64) -> f64 {
    let rest = angle - TAU * libm::floor(angle / TAU);
    if rest > PI { rest - TAU } else { rest }
}

/// Length of the handle at the end that makes the angle `theta` with the chord, as a share of
/// the chord, where the other end makes `phi` (Hobby 1986, "Smooth, easy to compute
/// interpolating splines", section 4).
fn handle(theta: f64, phi: f64) -> f64 {
    let (st, ct) = (libm::sin(theta), libm::cos(theta));
    let (sp, cp) = (libm::sin(phi), libm::cos(phi));
    let root5 = libm::sqrt(5.0);
    let above = 2.0 + libm::sqrt(2.0) * (st - sp / 16.0) * (sp - st / 16.0) * (ct - cp);
    let below = 3.0 * (1.0 + 0.5 * (root5 - 1.0) * ct + 0.5 * (3.0 - root5) * cp);
    // Directions that point straight back make the formula run away; tailors' curves never do.
    if below < 0.3 { (above / 0.3).clamp(0.0, 4.0) } else { (above / below).clamp(0.0, 4.0) }
}

/// The curve from `a` to `b` that leaves and arrives in given directions. Handles follow Hobby's
/// formula, or are the given shares of the chord.
pub fn between(a: Point, b: Point, leaving: f64, arriving: f64, pull: Option<[f64; 2]>) -> BezPath {
    let chord = b - a;
    let (length, along) = (libm::hypot(chord.x, chord.y), direction(chord));
    let theta = turned(leaving - along);
    let phi = turned(along - arriving);
    let [first, second] = pull.unwrap_or_else(|| [handle(theta, phi), handle(phi, theta)]);
    cubic(a, a + unit(leaving) * (first * length), b - unit(arriving) * (second * length), b)
}

/// A single cubic.
pub fn cubic(a: Point, b: Point, c: Point, d: Point) -> BezPath {
    let mut path = BezPath::new();
    path.move_to(a);
    path.curve_to(b, c, d);
    path
}

/// A single quadratic.
pub fn quadratic(a: Point, b: Point, c: Point) -> BezPath {
    let mut path = BezPath::new();
    path.move_to(a);
    path.quad_to(b, c);
    path
}

/// The turn by an angle about (0, 0), rad; anticlockwise if positive.
pub fn turning(angle: f64) -> Affine {
    let Vec2 { x, y } = unit(angle);
    Affine::new([x, y, -y, x, 0.0, 0.0])
}

/// A straight line.
pub fn line(a: Point, b: Point) -> BezPath {
    let mut path = BezPath::new();
    path.move_to(a);
    path.line_to(b);
    path
}

/// The arc that begins at `a` and turns by `angle` about `centre`; anticlockwise if positive.
pub fn arc(a: Point, centre: Point, angle: f64) -> BezPath {
    let arm = a - centre;
    let (radius, start) = (libm::hypot(arm.x, arm.y), direction(arm));
    let steps = libm::ceil(angle.abs() / ARC_STEP).clamp(1.0, 4096.0);
    let step = angle / steps;
    // Handles of the cubic that agrees with the arc at its ends, its middle and its directions.
    let reach = 4.0 / 3.0 * libm::tan(step / 4.0) * radius;
    let at = |direction: f64| centre + unit(direction) * radius;
    let mut path = BezPath::new();
    path.move_to(a);
    let mut from = a;
    for i in 1..=steps as usize {
        let (d0, d1) = (start + step * (i - 1) as f64, start + step * i as f64);
        let to = at(d1);
        path.curve_to(from + unit(d0 + PI / 2.0) * reach, to - unit(d1 + PI / 2.0) * reach, to);
        from = to;
    }
    path
}

/// The arc of a circle from `a` to `b` whose middle lies `height` to the left of the chord
/// (negative: to the right). None if it would turn by nearly a whole turn or more.
pub fn bow(a: Point, b: Point, height: f64) -> Option<BezPath> {
    let chord = b - a;
    let length = libm::hypot(chord.x, chord.y);
    if height.abs() < 1e-9 * length {
        return Some(line(a, b));
    }
    // Half the angle at the centre is four times the arctangent of … of the half chord.
    let half = 2.0 * libm::atan(2.0 * height.abs() / length);
    bow_by_angle(a, b, half * height.signum())
}

/// The arc from `a` to `b` that turns by twice `half`, lying to the left of the chord if `half`
/// is positive (walked clockwise).
fn bow_by_angle(a: Point, b: Point, half: f64) -> Option<BezPath> {
    if half.abs() > 0.98 * PI {
        return None;
    }
    let chord = b - a;
    let length = libm::hypot(chord.x, chord.y);
    let radius = length / (2.0 * libm::sin(half.abs()));
    // The centre lies on the perpendicular bisector, on the other side of a shallow bow.
    let left = unit(direction(chord) + PI / 2.0) * half.signum();
    let centre = a.midpoint(b) - left * (radius * libm::cos(half));
    let mut path = arc(a, centre, -2.0 * half);
    end_at(&mut path, b);
    Some(path)
}

/// The bow from `a` to `b` with the given radius; its lesser arc.
pub fn bow_of_radius(a: Point, b: Point, radius: f64, left: bool) -> Option<BezPath> {
    let chord = b - a;
    let share = libm::hypot(chord.x, chord.y) / (2.0 * radius);
    if !(0.0..=1.0 + 1e-9).contains(&share) {
        return None;
    }
    let half = libm::asin(share.min(1.0));
    bow_by_angle(a, b, if left { half } else { -half })
}

/// The bow from `a` to `b` that is `wanted` long; none if the chord is longer, or the bow more
/// than three quarters of a circle.
pub fn bow_of_length(a: Point, b: Point, wanted: f64, left: bool) -> Option<BezPath> {
    let chord = b - a;
    let length = libm::hypot(chord.x, chord.y);
    if wanted < length * (1.0 - 1e-9) {
        return None;
    }
    if wanted < length * (1.0 + 1e-9) {
        return Some(line(a, b));
    }
    // half / sin(half) = wanted / length grows with half; bisect.
    let (mut low, mut high) = (0.0, 0.75 * PI);
    if high / libm::sin(high) < wanted / length {
        return None;
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if middle / libm::sin(middle) < wanted / length { low = middle } else { high = middle }
    }
    bow_by_angle(a, b, if left { low } else { -low })
}

/// Moves the last point of a path, for ends that must agree to the last bit.
pub fn end_at(path: &mut BezPath, to: Point) {
    if let Some(last) = path.elements_mut().last_mut() {
        match last {
            PathEl::MoveTo(p)
            | PathEl::LineTo(p)
            | PathEl::QuadTo(_, p)
            | PathEl::CurveTo(_, _, p) => {
                *p = to;
            }
            PathEl::ClosePath => {}
        }
    }
}

/// Moves the first point of a path.
pub fn start_at(path: &mut BezPath, from: Point) {
    if let Some(PathEl::MoveTo(p)) = path.elements_mut().first_mut() {
        *p = from;
    }
}

/// The smooth curve through points in order (Hobby 1986, section 5), with directions at its
/// ends where they are given and curl 1 where not.
pub fn through(points: &[Point], leaving: Option<f64>, arriving: Option<f64>) -> BezPath {
    let spans: Vec<Vec2> = points.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let n = spans.len();
    if let (1, None, None) = (n, leaving, arriving) {
        return line(points[0], points[1]);
    }
    let lengths: Vec<f64> =
        spans.iter().map(|v| libm::hypot(v.x, v.y).max(f64::MIN_POSITIVE)).collect();
    let alongs: Vec<f64> = spans.iter().map(|v| direction(*v)).collect();
    // psi[k]: turn of the polygon at point k, for inner points.
    let psi: Vec<f64> = (0..=n)
        .map(|k| if k == 0 || k == n { 0.0 } else { turned(alongs[k] - alongs[k - 1]) })
        .collect();
    // Tridiagonal equations for theta[k], the angle of the curve with span k at point k.
    let (mut sub, mut dia, mut sup, mut rhs) =
        (vec![0.0; n + 1], vec![1.0; n + 1], vec![0.0; n + 1], vec![0.0; n + 1]);
    match leaving {
        Some(d) => rhs[0] = turned(d - alongs[0]),
        None => {
            // Curl 1: the curvature at the end equals that at its neighbour, mock curvature.
            dia[0] = 1.0;
            sup[0] = 1.0;
            rhs[0] = -psi[1.min(n)];
        }
    }
    for k in 1..n {
        let (a, b) = (1.0 / lengths[k - 1], 1.0 / lengths[k]);
        sub[k] = a;
        dia[k] = 2.0 * (a + b);
        sup[k] = b;
        rhs[k] = -(2.0 * psi[k] * a + psi[k + 1] * b);
    }
    match arriving {
        // theta[n] stands for the direction of arrival against the last span.
        Some(d) => rhs[n] = turned(d - alongs[n - 1]),
        None => {
            sub[n] = 1.0;
            dia[n] = 1.0;
        }
    }
    for k in 1..=n {
        let factor = sub[k] / dia[k - 1];
        dia[k] -= factor * sup[k - 1];
        rhs[k] -= factor * rhs[k - 1];
    }
    let mut theta = vec![0.0; n + 1];
    theta[n] = rhs[n] / dia[n];
    for k in (0..n).rev() {
        theta[k] = (rhs[k] - sup[k] * theta[k + 1]) / dia[k];
    }
    let mut path = BezPath::new();
    path.move_to(points[0]);
    for k in 0..n {
        let leave = alongs[k] + theta[k];
        let arrive = if k + 1 == n { alongs[k] + theta[n] } else { alongs[k + 1] + theta[k + 1] };
        let piece = between(points[k], points[k + 1], leave, arrive, None);
        if let Some(PathEl::CurveTo(b, c, d)) = piece.elements().get(1) {
            path.curve_to(*b, *c, *d);
        }
    }
    path
}

/// Length of a path.
pub fn length(path: &BezPath) -> f64 {
    path.segments().map(|segment| segment.arclen(LENGTH_ACCURACY)).sum()
}

/// First point of a path.
pub fn start(path: &BezPath) -> Point {
    match path.elements().first() {
        Some(PathEl::MoveTo(p)) => *p,
        _ => Point::ZERO,
    }
}

/// Last point of a path.
pub fn end(path: &BezPath) -> Point {
    path.elements().last().and_then(PathEl::end_point).unwrap_or(Point::ZERO)
}

/// Direction in which a path leaves its first point.
pub fn leaving(path: &BezPath) -> f64 {
    let from = start(path);
    let points = path.segments().flat_map(controls);
    direction(points.map(|p| p - from).find(|v| far(*v)).unwrap_or(Vec2::new(1.0, 0.0)))
}

/// Direction in which a path arrives at its last point.
pub fn arriving(path: &BezPath) -> f64 {
    let to = end(path);
    let points: Vec<Point> = path.segments().flat_map(controls).collect();
    let back = points.iter().rev().map(|p| to - *p).find(|v| far(*v));
    direction(back.unwrap_or(Vec2::new(1.0, 0.0)))
}

fn far(v: Vec2) -> bool {
    v.x.abs() + v.y.abs() > 1e-9
}

fn controls(segment: PathSeg) -> Vec<Point> {
    match segment {
        PathSeg::Line(line) => vec![line.p0, line.p1],
        PathSeg::Quad(quad) => vec![quad.p0, quad.p1, quad.p2],
        PathSeg::Cubic(CubicBez { p0, p1, p2, p3 }) => vec![p0, p1, p2, p3],
    }
}

/// The parameter of a curve at an arc length from its start, m, where the whole is `length` long:
/// Newton's method, which the speed of the curve leads there in a few steps, kept within what is
/// known to lie on either side.
pub fn share_at(curve: PathSeg, arc: f64, length: f64) -> f64 {
    if arc <= 0.0 || arc >= length {
        return if arc <= 0.0 { 0.0 } else { 1.0 };
    }
    let guess = arc / length;
    let speed = |share: f64| match curve {
        PathSeg::Line(_) => length,
        PathSeg::Quad(quad) => quad.deriv().eval(share).to_vec2().hypot(),
        PathSeg::Cubic(cubic) => cubic.deriv().eval(share).to_vec2().hypot(),
    };
    let way = |from: f64, to: f64| match curve {
        PathSeg::Line(_) => length * (to - from),
        _ if to < from => -curve.subsegment(to..from).arclen(LENGTH_ACCURACY),
        _ => curve.subsegment(from..to).arclen(LENGTH_ACCURACY),
    };
    let (mut low, mut high) = (0.0, 1.0);
    let (mut share, mut passed) = (guess, way(0.0, guess));
    // Halving alone comes to the end of the numbers in so many steps.
    for _ in 0..60 {
        let missing = arc - passed;
        if missing.abs() <= 1e-2 * LENGTH_ACCURACY {
            break;
        }
        if missing > 0.0 {
            low = share
        } else {
            high = share
        }
        let step = share + missing / speed(share);
        let next = if step > low && step < high { step } else { 0.5 * (low + high) };
        passed += way(share, next);
        share = next;
    }
    share
}

/// The point at an arc length of a curve `length` long, and the direction there.
fn on(segment: PathSeg, arc: f64, length: f64) -> (Point, f64) {
    let t = share_at(segment, arc, length);
    let (near, far) = ((t - 1e-4).max(0.0), (t + 1e-4).min(1.0));
    (segment.eval(t), direction(segment.eval(far) - segment.eval(near)))
}

/// A path measured once, for looking at many of its places.
#[derive(Clone, Debug)]
pub struct Measured {
    /// Curves with the arc length before each and of each, m.
    curves: Vec<(PathSeg, f64, f64)>,
    start: Point,
}

impl Measured {
    /// Measures a path.
    pub fn new(path: &BezPath) -> Self {
        let mut before = 0.0;
        let curves = path.segments().map(|curve| {
            let length = curve.arclen(LENGTH_ACCURACY);
            before += length;
            (curve, before - length, length)
        });
        Measured { curves: curves.collect(), start: start(path) }
    }

    /// The point at an arc length from the start.
    pub fn at(&self, distance: f64) -> Point {
        let distance = distance.max(0.0);
        let number = self.curves.partition_point(|(_, before, length)| before + length < distance);
        match self.curves.get(number).or(self.curves.last()) {
            Some(&(curve, before, length)) => {
                curve.eval(share_at(curve, distance - before, length))
            }
            None => self.start,
        }
    }
}

/// The point at an arc length from the start, and the direction there.
pub fn at(path: &BezPath, distance: f64) -> (Point, f64) {
    let mut rest = distance.max(0.0);
    let mut last = None;
    for segment in path.segments() {
        let length = segment.arclen(LENGTH_ACCURACY);
        if rest <= length {
            return on(segment, rest, length);
        }
        rest -= length;
        last = Some((segment, length));
    }
    last.map_or((start(path), 0.0), |(segment, length)| on(segment, length, length))
}

/// The part of a path between two arc lengths, `from < to`.
pub fn part(path: &BezPath, from: f64, to: f64) -> BezPath {
    let mut out = BezPath::new();
    let mut passed = 0.0;
    for segment in path.segments() {
        let length = segment.arclen(LENGTH_ACCURACY);
        let (a, b) = ((from - passed).max(0.0), (to - passed).min(length));
        // Crumbs at the joints of segments are left out.
        if b - a > 1e-10 {
            let cut =
                segment.subsegment(share_at(segment, a, length)..share_at(segment, b, length));
            if out.elements().is_empty() {
                out.move_to(cut.start());
            }
            match cut {
                PathSeg::Line(line) => out.line_to(line.p1),
                PathSeg::Quad(quad) => out.quad_to(quad.p1, quad.p2),
                PathSeg::Cubic(cubic) => out.curve_to(cubic.p1, cubic.p2, cubic.p3),
            }
        }
        passed += length;
    }
    if out.elements().is_empty() {
        let (p, _) = at(path, from);
        out = line(p, p);
    }
    out
}

/// A path walked the other way.
pub fn reversed(path: &BezPath) -> BezPath {
    path.reverse_subpaths()
}

/// A path moved by an affine map; −0 becomes 0.
pub fn mapped(path: &BezPath, map: Affine) -> BezPath {
    let clean = |p: Point| {
        let p = map * p;
        Point::new(p.x + 0.0, p.y + 0.0)
    };
    path.iter()
        .map(|element| match element {
            PathEl::MoveTo(p) => PathEl::MoveTo(clean(p)),
            PathEl::LineTo(p) => PathEl::LineTo(clean(p)),
            PathEl::QuadTo(p, q) => PathEl::QuadTo(clean(p), clean(q)),
            PathEl::CurveTo(p, q, r) => PathEl::CurveTo(clean(p), clean(q), clean(r)),
            PathEl::ClosePath => PathEl::ClosePath,
        })
        .collect()
}

/// The mirror map about the line through `a` and `b`.
pub fn mirror(a: Point, b: Point) -> Affine {
    let v = b - a;
    let squared = v.x * v.x + v.y * v.y;
    // Reflection: p ↦ a + 2 (d·(p − a)) d − (p − a), with d the unit vector along the line.
    let (xx, yy, xy) = (
        2.0 * v.x * v.x / squared - 1.0,
        2.0 * v.y * v.y / squared - 1.0,
        2.0 * v.x * v.y / squared,
    );
    Affine::new([xx, xy, xy, yy, a.x - xx * a.x - xy * a.y, a.y - xy * a.x - yy * a.y])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(a: f64, b: f64, tolerance: f64) {
        assert!((a - b).abs() <= tolerance, "{a} is not {b} within {tolerance}");
    }

    #[test]
    fn hobbys_handles_make_a_quarter_circle_nearly_round() {
        // For a quarter circle (theta = phi = 45°) the radius errs by less than 0.1 %.
        let path = between(Point::new(1.0, 0.0), Point::new(0.0, 1.0), PI / 2.0, PI, None);
        for i in 0..=20 {
            let (p, _) = at(&path, length(&path) * f64::from(i) / 20.0);
            near(libm::hypot(p.x, p.y), 1.0, 1e-3);
        }
    }

    #[test]
    fn bows_have_their_height_length_and_radius() {
        let (a, b) = (Point::new(0.0, 0.0), Point::new(0.1, 0.0));
        let shallow = bow(a, b, 0.01).unwrap();
        let (top, _) = at(&shallow, length(&shallow) / 2.0);
        near(top.y, 0.01, 1e-9);
        near(top.x, 0.05, 1e-9);
        let long = bow_of_length(a, b, 0.13, false).unwrap();
        near(length(&long), 0.13, 1e-8); // cubics of 22.5° err by 7e-8 of the radius
        assert!(at(&long, 0.065).0.y < 0.0);
        let round = bow_of_radius(a, b, 0.05, true).unwrap();
        near(length(&round), 0.05 * PI, 1e-8);
        assert!(bow_of_radius(a, b, 0.04, true).is_none());
        assert!(bow_of_length(a, b, 0.09, true).is_none());
        assert_eq!(end(&long), b);
    }

    #[test]
    fn arcs_turn_about_their_centre() {
        let path = arc(Point::new(2.0, 0.0), Point::ZERO, -PI);
        near(length(&path), 2.0 * PI, 1e-6);
        near(end(&path).x, -2.0, 1e-12);
        assert!(at(&path, PI).0.y < 0.0);
    }

    #[test]
    fn splines_pass_their_points_smoothly() {
        let points = [
            Point::new(0.0, 0.0),
            Point::new(0.1, 0.05),
            Point::new(0.2, -0.03),
            Point::new(0.3, 0.0),
        ];
        let path = through(&points, Some(0.3), None);
        near(leaving(&path), 0.3, 1e-12);
        let segments: Vec<PathSeg> = path.segments().collect();
        assert_eq!(segments.len(), 3);
        for (segment, pair) in segments.iter().zip(points.windows(2)) {
            assert_eq!((segment.start(), segment.end()), (pair[0], pair[1]));
        }
        for pair in segments.windows(2) {
            let (PathSeg::Cubic(a), PathSeg::Cubic(b)) = (pair[0], pair[1]) else { panic!() };
            near(turned(direction(a.p3 - a.p2) - direction(b.p1 - b.p0)), 0.0, 1e-12);
        }
        // Two points and no directions: the straight line.
        let straight = through(&points[..2], None, None);
        near(length(&straight), libm::hypot(0.1, 0.05), 1e-12);
    }

    #[test]
    fn parts_of_a_path_add_up() {
        let path = through(
            &[Point::new(0.0, 0.0), Point::new(0.1, 0.05), Point::new(0.2, -0.03)],
            None,
            None,
        );
        let whole = length(&path);
        let cut = 0.37 * whole;
        let (a, b) = (part(&path, 0.0, cut), part(&path, cut, whole));
        near(length(&a) + length(&b), whole, 1e-8);
        near(length(&a), cut, 1e-8);
        near((end(&a) - start(&b)).hypot(), 0.0, 1e-9);
    }

    #[test]
    fn mirroring_twice_changes_nothing() {
        let map = mirror(Point::new(0.1, 0.0), Point::new(0.3, 0.4));
        let p = Point::new(0.7, -0.2);
        near((map * (map * p) - p).hypot(), 0.0, 1e-15);
        assert_eq!(
            mirror(Point::ZERO, Point::new(0.0, -1.0)) * Point::new(0.0, 3.0),
            Point::new(0.0, 3.0)
        );
    }
}
