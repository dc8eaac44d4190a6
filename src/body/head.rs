//! Neck and head: a skull with a jaw and a chin, without a face.

use super::figure::Template;
use super::form::Scales;
use super::loft::{Frame, Loft, Row};
use super::measures::Measures;
use super::part::Part;
use nalgebra::{Point3, Vector3};

/// Height of the head from chin to crown, as a share of its girth.
const TALL: f64 = 0.396;

/// Height of the widest section above the chin, as a share of the head's.
const BROW: f64 = 0.63;

/// Neck and head.
#[derive(Clone, Debug)]
pub(super) struct Head {
    pub(super) neck: Part<Loft>,
    pub(super) skull: Part<Loft>,
}

/// Height of the head, m: half by its girth, half by the room above the nape.
fn tall(measures: &Measures) -> f64 {
    let above = measures.get("height") - measures.nape();
    (0.5 * (TALL * measures.get("head") + 0.93 * above)).min(0.97 * above)
}

impl Head {
    pub(super) fn new(table: &Template, measures: &Measures, scales: &Scales, size: f64) -> Self {
        let (height, nape) = (measures.get("height"), measures.nape());
        let above = height - nape;
        Head {
            neck: Part::new(neck(
                table,
                nape,
                [scales.get("neck"), scales.get("head")],
                size,
                above,
            )),
            skull: Part::new(skull(table, height, tall(measures), scales.get("head"), size)),
        }
    }

    /// Middle of the widest section, m.
    pub(super) fn brow(&self, measures: &Measures) -> Point3<f64> {
        self.skull.shape.centre(BROW * tall(measures))
    }

    /// Middle and upward direction of the ring where a shirt's collar lies: square to the neck,
    /// above the slope of the shoulders.
    pub(super) fn collar(&self, table: &Template, size: f64) -> (Point3<f64>, Vector3<f64>) {
        let tilt = table.lean + 0.08;
        let upward = Vector3::new(0.0, libm::cos(tilt), libm::sin(tilt));
        (self.neck.shape.centre(0.070 * size), upward)
    }
}

/// The neck, from inside the trunk into the head.
fn neck(table: &Template, nape: f64, [neck, head]: [f64; 2], size: f64, above: f64) -> Loft {
    let length = 0.74 * above;
    let rows: Vec<Row> = table
        .neck
        .iter()
        .map(|[s, a, b, c, d, e, f]| {
            // Above the collar it goes over into the head.
            let girth = neck + (0.6 * (head - neck).max(0.0)) * ((s - 0.45) / 0.55).max(0.0);
            Row {
                t: s * length,
                u: [a * girth, b * girth],
                v: [c * girth, d * girth],
                centre: [e * size, f * size],
                fullness: 0.0,
            }
        })
        .collect();
    let (sin, cos) = (libm::sin(table.lean), libm::cos(table.lean));
    let frame = Frame {
        origin: Point3::new(0.0, nape - 0.05 * size, table.root * size),
        u: Vector3::x(),
        v: Vector3::new(0.0, -sin, cos),
        along: Vector3::new(0.0, cos, sin),
    };
    Loft::new(frame, &rows, |_| 0.012 * size, [0.03 * size, 0.03 * size])
}

/// The head from the chin to the crown.
fn skull(table: &Template, height: f64, tall: f64, girth: f64, size: f64) -> Loft {
    let rows: Vec<Row> = table
        .head
        .iter()
        .map(|[s, half, front, back, middle]| Row {
            t: s * tall,
            u: [half * girth; 2],
            v: [(front - middle) * girth, (middle - back) * girth],
            centre: [0.0, table.ahead * size + middle * girth],
            fullness: 0.02,
        })
        .collect();
    let chin = rows.first().map_or(0.0, |row| row.t);
    let crown = tall - rows.last().map_or(0.0, |row| row.t);
    let frame = Frame {
        origin: Point3::new(0.0, height - tall, 0.0),
        u: Vector3::x(),
        v: Vector3::z(),
        along: Vector3::y(),
    };
    Loft::new(frame, &rows, |_| 0.007 * size, [chin, crown])
}
