//! Where outlines cross themselves or each other.

use super::nearby::Nearby;
use super::polygon::{Place, between, distance, from_to, meeting};
use kurbo::{BezPath, ParamCurve, ParamCurveArclen, ParamCurveDeriv, PathSeg, Rect};

/// Places nearer to each other than this touch, m.
const TOUCH: f64 = 1e-9;
/// Curves are replaced by chords that keep this near to them, m.
const CHORD: f64 = 1e-6;
/// Chords of one curve segment at most.
const MOST_CHORDS: f64 = 1024.0;
/// Curves up to which each chord is compared with the boxes around all of them.
const MOST_BOXES: usize = 100;

/// A piece of a loop, and a place on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OnPiece {
    /// Number of the loop.
    pub ring: usize,
    /// Number of the piece in its loop.
    pub piece: usize,
    /// Arc length from the start of the piece, m.
    pub arc: f64,
}

/// Two pieces that meet where they should not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// The place on the piece that comes first.
    pub a: OnPiece,
    /// The place on the other, which may be the same piece.
    pub b: OnPiece,
    /// Where they meet, m.
    pub at: Place,
}

struct Chord {
    ring: usize,
    piece: usize,
    segment: usize,
    /// Parameters of the segment at both ends.
    share: (f64, f64),
    ends: (Place, Place),
}

/// The first place, in the order of loops and pieces and along them, where closed lines cross
/// or touch themselves or each other. Each loop is a list of pieces, each of which ends where
/// the next one begins.
///
/// # Accuracy
/// Crossings shallower than 1 µm may be missed; the place of a crossing is exact to 1 nm where
/// the two curves meet at an angle.
pub fn first_crossing(loops: &[Vec<BezPath>]) -> Option<Crossing> {
    let (chords, ends) = chorded(loops);
    // Most chords lie where no other curve can be; they are not asked about.
    let asked = doubtful(loops, &chords);
    crossing_among(loops, &chords, &ends, &asked)
}

/// All chords, and for each the first and the last one of its loop.
fn chorded(loops: &[Vec<BezPath>]) -> (Vec<Chord>, Vec<(usize, usize)>) {
    let mut chords = Vec::new();
    let mut last_of_loop = Vec::new();
    for (ring, pieces) in loops.iter().enumerate() {
        let first = chords.len();
        for (piece, path) in pieces.iter().enumerate() {
            for (segment, curve) in path.segments().enumerate() {
                chord(&mut chords, (ring, piece, segment), curve);
            }
        }
        last_of_loop.resize(chords.len(), (first, chords.len().saturating_sub(1)));
    }
    (chords, last_of_loop)
}

/// The first meeting of these chords.
fn crossing_among(
    loops: &[Vec<BezPath>],
    chords: &[Chord],
    ends: &[(usize, usize)],
    asked: &[usize],
) -> Option<Crossing> {
    let places: Vec<_> = asked.iter().map(|&number| chords[number].ends).collect();
    let near = Nearby::new(&places);
    let mut others = Vec::new();
    for &number in asked {
        let chord = &chords[number];
        let mut met: Option<(f64, usize, f64)> = None;
        near.around(chord.ends, TOUCH, &mut others);
        for &other in &others {
            let other = asked[other as usize];
            let (first, last) = ends[number];
            // Neighbours share an end, and lie on each other only if the line turns back.
            let next = if number == last { first } else { number + 1 };
            let found = if other <= number {
                None
            } else if other == next {
                turns_back(chord.ends, chords[other].ends).then_some((1.0, 0.0))
            } else if number == first && other == last {
                turns_back(chords[other].ends, chord.ends).then_some((0.0, 1.0))
            } else {
                meeting(chord.ends, chords[other].ends, TOUCH)
            };
            if let Some((s, t)) = found
                && met.is_none_or(|(best, ..)| s < best)
            {
                met = Some((s, other, t));
            }
        }
        if let Some((s, other, t)) = met {
            return Some(refine(loops, chord, &chords[other], (s, t)));
        }
    }
    None
}

/// The numbers of chords that may meet a chord which is not their neighbour: those within the
/// box around the control points of another curve, and those of curves that may turn back.
fn doubtful(loops: &[Vec<BezPath>], chords: &[Chord]) -> Vec<usize> {
    let mut boxes: Vec<((usize, usize, usize), Rect, bool)> = Vec::new();
    for (ring, pieces) in loops.iter().enumerate() {
        for (piece, path) in pieces.iter().enumerate() {
            for (segment, curve) in path.segments().enumerate() {
                let (hull, onward) = hull(curve);
                boxes.push(((ring, piece, segment), hull, onward));
            }
        }
    }
    if boxes.len() > MOST_BOXES {
        return (0..chords.len()).collect();
    }
    let mut found = Vec::new();
    let mut first = 0;
    for &(own, around, own_onward) in &boxes {
        let of_curve = |chord: &&Chord| (chord.ring, chord.piece, chord.segment) == own;
        let count = chords[first..].iter().take_while(of_curve).count();
        // A box away from that around the whole curve is away from all its chords.
        let near: Vec<Rect> = boxes
            .iter()
            .filter(|&&(of, hull, _)| of != own && hull.overlaps(around))
            .map(|&(_, hull, _)| hull)
            .collect();
        for number in first..first + count {
            let (a, b) = chords[number].ends;
            let around = Rect::from_points((a[0], a[1]), (b[0], b[1])).inflate(TOUCH, TOUCH);
            if !own_onward || near.iter().any(|hull| hull.overlaps(around)) {
                found.push(number);
            }
        }
        first += count;
    }
    found
}

/// The box around the control points of a curve, a little wider, and whether each of its steps
/// leads onward along the line between its ends, so that it cannot meet itself.
fn hull(curve: PathSeg) -> (Rect, bool) {
    let points: Vec<kurbo::Point> = match curve {
        PathSeg::Line(l) => vec![l.p0, l.p1],
        PathSeg::Quad(q) => vec![q.p0, q.p1, q.p2],
        PathSeg::Cubic(c) => vec![c.p0, c.p1, c.p2, c.p3],
    };
    let mut around = Rect::from_points(curve.start(), curve.end());
    for point in &points {
        around = around.union_pt(*point);
    }
    let whole = curve.end() - curve.start();
    let steps = points.windows(2).map(|pair| pair[1] - pair[0]);
    let onward = steps.map(|step| step.dot(whole)).all(|along| along > 0.0);
    (around.inflate(2.0 * TOUCH, 2.0 * TOUCH), onward)
}

/// Whether the stretch after `before` lies on it in the opposite sense.
fn turns_back(before: (Place, Place), after: (Place, Place)) -> bool {
    let (p, q) = (from_to(before.0, before.1), from_to(after.0, after.1));
    let (dot, cross) = (p[0] * q[0] + p[1] * q[1], p[0] * q[1] - p[1] * q[0]);
    let shorter = distance(before.0, before.1).min(distance(after.0, after.1));
    let longer = distance(before.0, before.1).max(distance(after.0, after.1));
    dot < 0.0 && cross.abs() <= TOUCH * longer && shorter > TOUCH
}

fn chord(chords: &mut Vec<Chord>, (ring, piece, segment): (usize, usize, usize), curve: PathSeg) {
    let bend = match curve {
        PathSeg::Line(_) => 0.0,
        PathSeg::Quad(q) => 2.0 * ((q.p0 - q.p1) + (q.p2 - q.p1)).hypot(),
        PathSeg::Cubic(c) => {
            let first = (c.p0 - c.p1) + (c.p2 - c.p1);
            let second = (c.p1 - c.p2) + (c.p3 - c.p2);
            6.0 * first.hypot().max(second.hypot())
        }
    };
    // A chord over the share 1/n keeps within |second derivative| / 8n² of its curve.
    let count = (bend / (8.0 * CHORD)).sqrt().ceil().clamp(1.0, MOST_CHORDS) as usize;
    let mut start = place(curve.eval(0.0));
    chords.reserve(count);
    for step in 0..count {
        let share = (step as f64 / count as f64, (step + 1) as f64 / count as f64);
        let end = place(curve.eval(share.1));
        // Chords too short to tell from a touch are left to their neighbours.
        if distance(start, end) > 2.0 * TOUCH {
            chords.push(Chord { ring, piece, segment, share, ends: (start, end) });
            start = end;
        }
    }
}

fn place(point: kurbo::Point) -> Place {
    [point.x, point.y]
}

/// Newton's method from the meeting of two chords to that of their curves.
fn refine(loops: &[Vec<BezPath>], a: &Chord, b: &Chord, (s, t): (f64, f64)) -> Crossing {
    let inside = |chord: &Chord, share: f64| {
        chord.share.0 + share.clamp(0.0, 1.0) * (chord.share.1 - chord.share.0)
    };
    let chord_at = between(a.ends.0, a.ends.1, s);
    let rough = (inside(a, s), inside(b, t));
    let (mut exact, mut at) = (rough, chord_at);
    let curve = |chord: &Chord| loops[chord.ring][chord.piece].get_seg(chord.segment + 1);
    if let (Some(p), Some(q)) = (curve(a), curve(b)) {
        for _ in 0..8 {
            let (here, there) = (p.eval(exact.0), q.eval(exact.1));
            let (along, across) = (slope(p, exact.0), slope(q, exact.1));
            let gap = there - here;
            let cross = along.cross(across);
            // A curve that stands still at its end has no slope there.
            if cross.abs() <= 1e-9 * along.hypot() * across.hypot() {
                break;
            }
            let step = (gap.cross(across) / cross, gap.cross(along) / cross);
            exact = ((exact.0 + step.0).clamp(0.0, 1.0), (exact.1 + step.1).clamp(0.0, 1.0));
        }
        let (here, there) = (p.eval(exact.0), q.eval(exact.1));
        if (there - here).hypot() > TOUCH || distance(place(here), chord_at) > 10.0 * CHORD {
            exact = rough;
        }
        at = place(p.eval(exact.0));
    }
    let on = |chord: &Chord, share: f64| OnPiece {
        ring: chord.ring,
        piece: chord.piece,
        arc: arc_length(&loops[chord.ring][chord.piece], chord.segment, share),
    };
    Crossing { a: on(a, exact.0), b: on(b, exact.1), at }
}

fn slope(curve: PathSeg, share: f64) -> kurbo::Vec2 {
    match curve {
        PathSeg::Line(line) => line.p1 - line.p0,
        PathSeg::Quad(quad) => quad.deriv().eval(share).to_vec2(),
        PathSeg::Cubic(cubic) => cubic.deriv().eval(share).to_vec2(),
    }
}

fn arc_length(path: &BezPath, segment: usize, share: f64) -> f64 {
    let before: f64 = path.segments().take(segment).map(|curve| curve.arclen(TOUCH)).sum();
    let within = path.segments().nth(segment).map_or(0.0, |curve| {
        if share > 0.0 { curve.subsegment(0.0..share).arclen(TOUCH) } else { 0.0 }
    });
    before + within
}

#[cfg(test)]
mod tests {
    use super::*;
    use kurbo::Shape;

    use proptest::prelude::*;

    proptest! {
        /// Nothing that matters is left out.
        #[test]
        fn chords_far_from_other_curves_do_not_matter(
            points in prop::collection::vec((-4i8..5, -4i8..5), 9..22),
        ) {
            let at = |n: usize| {
                let (x, y) = points[n % points.len()];
                kurbo::Point::new(f64::from(x), f64::from(y))
            };
            let count = points.len() / 3;
            let outline: Vec<BezPath> = (0..count)
                .map(|n| {
                    let mut path = BezPath::new();
                    path.move_to(at(3 * n));
                    let end = if n + 1 == count { at(0) } else { at(3 * n + 3) };
                    if n % 2 == 0 {
                        path.line_to(end);
                    } else {
                        path.curve_to(at(3 * n + 1), at(3 * n + 2), end);
                    }
                    path
                })
                .collect();
            let loops = [outline];
            let (chords, ends) = chorded(&loops);
            let all: Vec<usize> = (0..chords.len()).collect();
            let whole = crossing_among(&loops, &chords, &ends, &all);
            prop_assert_eq!(first_crossing(&loops), whole);
        }
    }

    fn pieces(corners: &[(f64, f64)]) -> Vec<BezPath> {
        let closed = corners.iter().zip(corners.iter().cycle().skip(1));
        closed
            .map(|(&from, &to)| {
                let mut path = BezPath::new();
                path.move_to(from);
                path.line_to(to);
                path
            })
            .collect()
    }

    #[test]
    fn a_plain_outline_crosses_nothing() {
        let outline = pieces(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.5, 0.2), (0.0, 1.0)]);
        let hole = pieces(&[(0.2, 0.1), (0.2, 0.15), (0.3, 0.15)]);
        assert_eq!(first_crossing(&[outline, hole]), None);
        let circle = vec![kurbo::Circle::new((0.0, 0.0), 0.3).to_path(1e-4)];
        assert_eq!(first_crossing(&[circle]), None);
    }

    #[test]
    fn a_bow_tie_crosses_in_its_middle() {
        let bow = pieces(&[(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)]);
        let crossing = first_crossing(&[bow]).expect("the bow tie crosses itself");
        assert_eq!((crossing.a.piece, crossing.b.piece), (0, 2));
        assert!(distance(crossing.at, [0.5, 0.5]) < 1e-12);
        assert!((crossing.a.arc - 0.5f64.sqrt()).abs() < 1e-9);
    }

    #[test]
    fn a_curve_through_a_straight_edge_is_placed_exactly() {
        let mut outline = pieces(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]);
        // A parabola y = 1 − 4.8 x (1 − x) dips below the lower edge.
        let mut dip = BezPath::new();
        dip.move_to((1.0, 1.0));
        dip.quad_to((0.5, -1.4), (0.0, 1.0));
        outline[2] = dip;
        let crossing = first_crossing(&[outline]).expect("the dip crosses the lower edge");
        assert_eq!((crossing.a.piece, crossing.b.piece), (0, 2));
        let exact = 0.5 - (0.25 - 1.0 / 4.8f64).sqrt();
        assert!((crossing.at[0] - exact).abs() < 1e-9 && crossing.at[1].abs() < 1e-9);
    }

    #[test]
    fn touching_and_turning_back_count() {
        let touching = pieces(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.5, 0.0), (0.0, 1.0)]);
        assert!(first_crossing(&[touching]).is_some());
        let spike = pieces(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (1.0, 0.5), (0.0, 1.0)]);
        assert!(first_crossing(&[spike]).is_some());
    }

    #[test]
    fn a_hole_that_leaves_the_panel_crosses() {
        let outline = pieces(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]);
        let hole = pieces(&[(0.8, 0.4), (0.8, 0.6), (1.2, 0.5)]);
        let crossing = first_crossing(&[outline, hole]).expect("the hole leaves the panel");
        assert_eq!((crossing.a.ring, crossing.b.ring), (0, 1));
    }
}
