//! The left leg and its foot.

use super::figure::{FOOT, Template};
use super::form::Scales;
use super::loft::{Curve, Frame, Loft, Row};
use super::measures::Measures;
use super::part::{Bounds, Bump, Part, join};
use nalgebra::{Point3, Vector3};

/// Half the room that is left between the thighs, m.
const APART: f64 = 0.0125;

/// Leg and foot, with knee cap and ankle bones.
#[derive(Clone, Debug)]
pub(super) struct Leg {
    leg: Part<Loft>,
    foot: Part<Loft>,
    bumps: Vec<Bump>,
    size: f64,
}

impl Leg {
    /// The leg, and the heights of thigh, knee, calf and ankle.
    pub(super) fn new(
        table: &Template,
        measures: &Measures,
        scales: &Scales,
        size: f64,
    ) -> (Self, [f64; 4]) {
        let crotch = measures.get("waist_to_floor") - measures.get("body_rise");
        let places = [0.0, 0.12, 0.43, 0.6, 0.92, 1.1];
        let (thigh, ankle) = (scales.get("thigh"), scales.get("ankle"));
        let (calf, knee) = (scales.get("calf"), scales.get("knee"));
        let wide = Curve::new(&places, &[ankle, ankle, calf, knee, thigh, thigh]);
        let mut rows: Vec<Row> = table
            .leg
            .iter()
            .map(|[s, a, b, c, d, e, f]| {
                let w = wide.at(*s);
                Row {
                    t: s * crotch,
                    u: [a * w, b * w],
                    v: [c * w, d * w],
                    centre: [e * size, f * size],
                    fullness: 0.0,
                }
            })
            .collect();
        // Thighs stay apart: the legs stand wider where they are thick, the more the higher.
        let wider = rows
            .iter()
            .filter(|row| row.t > 0.55 * crotch && row.t <= crotch)
            .map(|row| row.u[1] + APART * size - row.centre[0])
            .fold(0.0, f64::max);
        for row in &mut rows {
            let share = (0.35 + 0.65 * row.t / crotch).min(1.0);
            row.centre[0] += wider * share;
        }
        for row in &mut rows {
            row.centre[0] = row.centre[0].max(row.u[1] + APART * size);
        }
        let frame = Frame {
            origin: Point3::origin(),
            u: Vector3::x(),
            v: Vector3::z(),
            along: Vector3::y(),
        };
        let loft = Loft::new(frame, &rows, |_| 0.014 * size, [0.02 * size, 0.05 * size]);
        let foot = foot(&loft, measures.get("height") / 1.68, size);
        let bumps = bones(&loft, crotch, size);
        let leg = Leg { leg: Part::new(loft), foot: Part::new(foot), bumps, size };
        (leg, [0.92, 0.6, 0.43, 0.12].map(|s| s * crotch))
    }

    /// About the distance to the skin, m; negative inside.
    pub(super) fn value(&self, p: Point3<f64>) -> f64 {
        let value = join(self.leg.value(p), self.foot.value(p), 0.035 * self.size);
        if value.abs() > 0.05 {
            return value;
        }
        value - self.bumps.iter().map(|bump| bump.rise(p)).sum::<f64>()
    }

    /// Boxes that hold the whole leg.
    pub(super) fn bounds(&self) -> [Bounds; 2] {
        [self.leg.bounds, self.foot.bounds]
    }

    /// Middle of the leg at height `y`.
    pub(super) fn centre(&self, y: f64) -> Point3<f64> {
        self.leg.shape.centre(y)
    }
}

/// Knee cap and ankle bones.
fn bones(leg: &Loft, crotch: f64, size: f64) -> Vec<Bump> {
    let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
    let on = |s: f64, way: Vector3<f64>, side: usize| {
        let y = s * crotch;
        leg.centre(y) + way * leg.reach_at(y)[side]
    };
    let knee = on(0.615, Vector3::z(), 2);
    let outer = on(0.098, Vector3::x(), 0);
    let inner = on(0.108, -Vector3::x(), 1);
    let ball = [[0.026 * size; 2]; 3];
    vec![
        Bump::new(
            knee,
            axes,
            [[0.040 * size; 2], [0.050 * size; 2], [0.036 * size; 2]],
            0.0045 * size,
        ),
        Bump::new(outer, axes, ball, 0.0045 * size),
        Bump::new(inner, axes, ball, 0.0045 * size),
    ]
}

/// The left foot, turned out a little.
fn foot(leg: &Loft, grown: f64, size: f64) -> Loft {
    let ankle = leg.centre(0.05 * size);
    let out: f64 = 0.14;
    let along = Vector3::new(libm::sin(out), 0.0, libm::cos(out));
    let frame = Frame {
        origin: Point3::new(ankle.x, 0.0, ankle.z),
        u: Vector3::new(along.z, 0.0, -along.x),
        v: Vector3::y(),
        along,
    };
    let rows: Vec<Row> = FOOT
        .iter()
        .map(|[t, outer, inner, top, side]| {
            let middle = top * 0.36;
            Row {
                t: t * grown,
                u: [outer * grown, inner * grown],
                v: [(top - middle) * grown, (middle + 0.010) * grown],
                centre: [side * grown, middle * grown],
                fullness: 0.04,
            }
        })
        .collect();
    Loft::new(frame, &rows, |_| 0.009 * size, [0.026 * grown, 0.022 * grown])
}
