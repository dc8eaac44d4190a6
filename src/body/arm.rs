//! The left arm and its hand: closed fingers, a thumb.

use super::figure::Template;
use super::form::Scales;
use super::loft::{Curve, Frame, Loft, Row};
use super::measures::Measures;
use super::part::{Bounds, Bump, Part, join};
use nalgebra::{Point3, Vector3};

/// How far from upright the arm hangs, if the trunk leaves it room, rad.
const HANGS: f64 = 0.80;

/// How far the hand is turned so that its back shows in front, rad.
const TURNED: f64 = 0.30;

/// Arm and hand.
#[derive(Clone, Debug)]
pub(super) struct Arm {
    arm: Part<Loft>,
    hand: Part<Loft>,
    thumb: Part<Loft>,
    elbow: Bump,
    size: f64,
}

impl Arm {
    /// The arm from a joint under the acromion, and the ways to the middle of the upper arm, the
    /// elbow and the wrist. `widest` gives levels of the trunk with its half breadth there, which
    /// the arm leaves free.
    pub(super) fn new(
        table: &Template,
        measures: &Measures,
        scales: &Scales,
        acromion: Point3<f64>,
        widest: &[(f64, f64)],
        size: f64,
    ) -> (Self, [f64; 3]) {
        let joint = acromion + Vector3::new(-0.021, -0.051, 0.002) * size;
        let length = measures.get("arm_length") - 0.02 * size;
        let thick = measures.get("upper_arm") / std::f64::consts::TAU;
        let mut angle = HANGS;
        for _ in 0..40 {
            let free = widest.iter().all(|(level, half)| {
                let drop = joint.y - level;
                let inner = joint.x + drop * libm::tan(angle) - thick / libm::cos(angle);
                inner > half + 0.03 * size
            });
            if free {
                break;
            }
            angle += 0.02;
        }
        let (sin, cos) = (libm::sin(angle), libm::cos(angle));
        let frame = Frame {
            origin: joint,
            u: Vector3::z(),
            v: Vector3::new(cos, sin, 0.0),
            along: Vector3::new(sin, -cos, 0.0),
        };
        let upper = scales.get("upper_arm");
        let places = [0.0, 0.3, 0.56, 1.0];
        let wide = Curve::new(&places, &[upper, upper, scales.get("elbow"), scales.get("wrist")]);
        let rows: Vec<Row> = table
            .arm
            .iter()
            .map(|[s, a, b, c, d, e, f]| {
                let w = wide.at(*s);
                Row {
                    t: s * length,
                    u: [a * w, b * w],
                    v: [c * w, d * w],
                    centre: [e * size, f * size],
                    fullness: 0.0,
                }
            })
            .collect();
        let arm = Loft::new(frame, &rows, |_| 0.013 * size, [0.046 * upper, 0.02 * size]);
        let broad = (scales.get("wrist") + measures.get("height") / table.height) / 2.0;
        let hand = 0.18 * measures.get("height") / 1.68;
        let [closed, thumb] = self::hand(table, &arm, length, hand, broad, size);
        let tip = 0.57 * length;
        let elbow = Bump::new(
            arm.centre(tip) - frame.u * arm.reach_at(tip)[1],
            [frame.u, frame.v, frame.along],
            [[0.029 * size; 2], [0.029 * size; 2], [0.040 * size; 2]],
            0.004 * size,
        );
        let arm = Arm {
            arm: Part::new(arm),
            hand: Part::new(closed),
            thumb: Part::new(thumb),
            elbow,
            size,
        };
        (arm, [0.3, 0.56, 1.0].map(|s| s * length))
    }

    /// About the distance to the skin, m; negative inside.
    pub(super) fn value(&self, p: Point3<f64>) -> f64 {
        let size = self.size;
        let hand = join(self.hand.value(p), self.thumb.value(p), 0.014 * size);
        join(self.arm.value(p), hand, 0.030 * size) - self.elbow.rise(p)
    }

    /// Boxes that hold the whole arm.
    pub(super) fn bounds(&self) -> [Bounds; 3] {
        [self.arm.bounds, self.hand.bounds, self.thumb.bounds]
    }

    /// Middle of the arm at `way` m from the shoulder joint.
    pub(super) fn centre(&self, way: f64) -> Point3<f64> {
        self.arm.shape.centre(way)
    }

    /// From the shoulder to the hand.
    pub(super) fn direction(&self) -> Vector3<f64> {
        self.arm.shape.frame.along
    }
}

/// The hand with its closed fingers, and the thumb, on the wrist of an arm.
fn hand(table: &Template, arm: &Loft, length: f64, hand: f64, broad: f64, size: f64) -> [Loft; 2] {
    let (before, wrist) = (arm.centre(0.85 * length), arm.centre(length));
    // The hand goes on as the forearm does, a little straighter down.
    let along = ((wrist - before).normalize() - Vector3::y() * 0.12).normalize();
    let thumbwards = turned(arm.frame.u, along, TURNED);
    let palm = Frame { origin: wrist, u: thumbwards, v: along.cross(&thumbwards), along };
    // v points to the back of the hand: outwards.
    let palm = if palm.v.x < 0.0 { Frame { v: -palm.v, ..palm } } else { palm };
    let make = |frame: Frame, rows: &[[f64; 7]], caps: [f64; 2]| {
        let rows: Vec<Row> = rows
            .iter()
            .map(|[s, a, b, c, d, e, f]| Row {
                t: s * hand,
                u: [a * broad, b * broad],
                v: [c * broad, d * broad],
                centre: [e * broad, f * broad],
                fullness: 0.06,
            })
            .collect();
        Loft::new(frame, &rows, |_| 0.006 * size, caps)
    };
    let tips = (1.0 - table.hand.last().map_or(0.0, |row| row[0])) * hand;
    let closed = make(palm, table.hand, [0.02 * size, tips]);
    let way = (palm.u * 0.50 + along * 0.85 - palm.v * 0.22).normalize();
    let base = palm.outward([0.016 * broad, -0.004 * broad, 0.17 * hand]);
    let across = (palm.u - way * palm.u.dot(&way)).normalize();
    let frame = Frame { origin: base, u: across, v: way.cross(&across), along: way };
    let thumb = make(frame, table.thumb, [0.014 * size, 0.010 * broad]);
    [closed, thumb]
}

/// `v` turned about the unit `axis`, made square to it first.
fn turned(v: Vector3<f64>, axis: Vector3<f64>, angle: f64) -> Vector3<f64> {
    let flat = (v - axis * axis.dot(&v)).try_normalize(1e-9).unwrap_or(v);
    flat * libm::cos(angle) + axis.cross(&flat) * libm::sin(angle)
}
