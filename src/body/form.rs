//! The skin of a figure as the zero of a smooth function: lofts and swellings that flow into one
//! another.

use super::figure::{FOOT, LimbRow, STATIONS, Swelling, Template, template};
use super::loft::{Curve, Frame, Loft, Row};
use super::measures::Measures;
use super::surface::BodyPart;
use crate::diagnostic::Diagnostic;
use crate::garment::scene::{BodyRequest, Figure};
use nalgebra::{Point3, Vector3};
use std::collections::BTreeMap;

/// Beyond this distance from a part's box, the part cannot touch any fillet, m: more than
/// the widest fillet of the tallest body.
const FAR: f64 = 0.085;

/// How far a breast moves to the front for a unit of its correction, m.
pub(super) const BREAST_STAND: f64 = 0.1;

/// What the tapes correct: a factor for each girth, 1 at first.
pub(super) type Corrections = BTreeMap<&'static str, f64>;

/// A ball-like shape with its own radius upwards.
#[derive(Clone, Debug)]
struct Egg {
    middle: Point3<f64>,
    radii: Vector3<f64>,
    up: f64,
}

impl Egg {
    /// About the distance to its skin, m.
    fn value(&self, p: Point3<f64>) -> f64 {
        let d = p - self.middle;
        let tall = if d.y > 0.0 { self.up } else { self.radii.y };
        let radii = Vector3::new(self.radii.x, tall, self.radii.z);
        let (inner, outer) =
            (d.component_div(&radii), d.component_div(&radii.component_mul(&radii)));
        let (k, l) = (inner.norm(), outer.norm());
        if l < 1e-9 { -radii.min() } else { k * (k - 1.0) / l }
    }
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

/// A part with the box that lets far points skip it.
#[derive(Clone, Debug)]
struct Part<T> {
    shape: T,
    bounds: Bounds,
}

impl Part<Loft> {
    fn loft(shape: Loft) -> Self {
        let bounds = Bounds::of(shape.corners());
        Part { shape, bounds }
    }

    fn value(&self, p: Point3<f64>) -> f64 {
        let gap = self.bounds.gap(p);
        if gap > FAR { gap } else { self.shape.value(p) }
    }
}

impl Part<Egg> {
    fn egg(shape: Egg) -> Self {
        let (r, m) = (shape.radii, shape.middle);
        let top = Vector3::new(r.x, shape.up, r.z);
        Part { bounds: Bounds::of([m - r, m + top]), shape }
    }

    fn value(&self, p: Point3<f64>) -> f64 {
        let gap = self.bounds.gap(p);
        if gap > FAR { gap } else { self.shape.value(p) }
    }
}

/// The lesser of two, with a fillet of reach `k` where they meet; smooth to the second derivative.
///
/// # References
/// Quílez 2013, "smooth minimum" (cubic polynomial).
fn join(a: f64, b: f64, k: f64) -> f64 {
    let h = (k - (a - b).abs()).max(0.0) / k;
    a.min(b) - h * h * h * k / 6.0
}

/// A figure's skin as a function of space.
#[derive(Clone, Debug)]
pub(super) struct Form {
    trunk: Part<Loft>,
    neck: Part<Loft>,
    skull: Part<Egg>,
    face: Part<Egg>,
    chest: Part<Egg>,
    chest_blend: f64,
    seat: Part<Egg>,
    seat_blend: f64,
    leg: Part<Loft>,
    foot: Part<Loft>,
    arm: Part<Loft>,
    thumb: Part<Loft>,
    /// Size against the reference body.
    pub(super) size: f64,
    /// Heights of the stations, m.
    pub(super) levels: [f64; STATIONS],
    /// Tip of the left acromion before the arm is joined on.
    pub(super) acromion: Point3<f64>,
    /// Ways along the arm from the joint: middle of the upper arm, elbow, wrist.
    pub(super) arm_places: [f64; 3],
    /// Heights of thigh, knee, calf and ankle.
    pub(super) leg_levels: [f64; 4],
    /// Middle and upward direction of the neck's ring.
    pub(super) neck_plane: (Point3<f64>, Vector3<f64>),
    /// Height of the whole figure.
    pub(super) height: f64,
    /// Height of the widest section of the head.
    pub(super) brow: f64,
    /// Height of the seventh neck vertebra.
    pub(super) nape: f64,
    /// Half the distance between the bust points.
    pub(super) bust_half: f64,
}

impl Form {
    /// The form of a figure with its measures and the corrections found so far.
    ///
    /// # Errors
    /// E0309 where the heights of the trunk do not follow one another.
    pub(super) fn new(
        request: &BodyRequest,
        measures: &Measures,
        corrections: &Corrections,
    ) -> Result<Form, Vec<Diagnostic>> {
        let table = template(request.figure);
        let size = measures.get("height") / table.height;
        let levels = levels(request, measures, table, size)?;
        let reference: BTreeMap<&str, f64> = table.girths.iter().copied().collect();
        // How much wider than on the reference body.
        let scale = |name: &'static str| {
            let drawn = reference.get(name).copied().unwrap_or(1.0);
            measures.get(name) / drawn * corrections.get(name).copied().unwrap_or(1.0)
        };
        let nape = measures.nape();
        let height = measures.get("height");

        let root = Point3::new(0.0, nape - 0.05 * size, -0.038 * size);
        let across = measures.get("shoulder") * libm::cos(table.slope);
        let side_of_neck = measures.get("neck") / std::f64::consts::TAU * 1.02;
        let acromion =
            Point3::new(side_of_neck + across, levels[6], (table.shoulder()[4] + 0.002) * size);

        let trunk = trunk(request.figure, table, &levels, measures, &scale, acromion.x, size);
        let neck = neck(table, root, scale("neck"), size, height - nape);
        let (skull, face) = head(height, nape, scale("head"), size);
        let chest = chest(request.figure, table, &levels, measures, &trunk, corrections, size);
        let seat = seat(table, &levels, scale("hip"), size);
        let (leg, leg_levels) = leg(table, measures, &scale, size);
        let foot = foot(&leg, height / 1.68, size);
        let widest = trunk.reach_at(levels[4])[0];
        let (arm, arm_places, thumb) =
            arm(table, measures, &scale, acromion, widest, levels[4], size);
        // Where a shirt's collar lies: square to the neck, above the slope of the shoulders.
        let tilt = table.lean + 0.08;
        let upward = Vector3::new(0.0, libm::cos(tilt), libm::sin(tilt));
        let middle = neck.centre(0.078 * size);
        Ok(Form {
            trunk: Part::loft(trunk),
            neck: Part::loft(neck),
            brow: skull.middle.y + 0.012 * size,
            nape,
            bust_half: measures.get("bust_gap").max(0.18 * measures.get("chest")) / 2.0,
            skull: Part::egg(skull),
            face: Part::egg(face),
            chest: Part::egg(chest),
            chest_blend: table.chest.blend * size,
            seat: Part::egg(seat),
            seat_blend: table.seat.blend * size,
            leg: Part::loft(leg),
            foot: Part::loft(foot),
            arm: Part::loft(arm),
            thumb: Part::loft(thumb),
            size,
            levels,
            acromion,
            arm_places,
            leg_levels,
            neck_plane: (middle, upward),
            height,
        })
    }

    /// The body without its arms: negative inside, about metres near the skin.
    pub(super) fn without_arms(&self, p: Point3<f64>) -> f64 {
        // Mirrored without a crease at the middle plane.
        let soft = 0.008 * self.size;
        let q = Point3::new((p.x * p.x + soft * soft).sqrt(), p.y, p.z);
        let size = self.size;
        let mut value = self.trunk.value(p) + self.furrow(p);
        // The trunk ends in a rounded bottom between the legs.
        value = -join(-value, p.y - self.levels[0], 0.075 * size);
        value = join(value, self.chest.value(q), self.chest_blend);
        value = join(value, self.seat.value(q), self.seat_blend);
        value = join(value, self.neck.value(p), 0.035 * size);
        let head = join(self.skull.value(p), self.face.value(p), 0.045 * size);
        value = join(value, head, 0.02 * size);
        value = join(value, self.left_leg(q), 0.032 * size);
        // Flat soles.
        -join(-value, p.y, 0.014 * size)
    }

    /// Depth of the furrow along the spine at `p`, m.
    fn furrow(&self, p: Point3<f64>) -> f64 {
        let [_, hip, .., underarm, acromion, _] = self.levels;
        let (low, high) = (hip + 0.05 * self.size, (underarm + acromion) / 2.0);
        if p.z > -0.02 * self.size || p.y < low || p.y > high {
            return 0.0;
        }
        let along = (p.y - low) / (high - low);
        let across = p.x / (0.022 * self.size);
        let bell = libm::exp(-across * across);
        let rise = 16.0 * along * along * (1.0 - along) * (1.0 - along);
        let back = ((-p.z / self.size - 0.02) / 0.03).min(1.0);
        0.006 * self.size * bell * rise * back
    }

    /// The left leg alone.
    pub(super) fn left_leg(&self, p: Point3<f64>) -> f64 {
        join(self.leg.value(p), self.foot.value(p), 0.035 * self.size)
    }

    /// The left arm alone.
    pub(super) fn left_arm(&self, p: Point3<f64>) -> f64 {
        join(self.arm.value(p), self.thumb.value(p), 0.02 * self.size)
    }

    /// The whole body: negative inside, about metres near the skin.
    pub(super) fn value(&self, p: Point3<f64>) -> f64 {
        let arm = self.left_arm(Point3::new(p.x.abs(), p.y, p.z));
        join(self.without_arms(p), arm, 0.05 * self.size)
    }

    /// Value and gradient at `p`, by the four corners of a small tetrahedron.
    pub(super) fn slope(&self, p: Point3<f64>) -> (f64, Vector3<f64>) {
        let h = 4e-4;
        let (mut mean, mut gradient) = (0.0, Vector3::zeros());
        for corner in [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]] {
            let way = Vector3::from(corner);
            let value = self.value(p + way * h);
            mean += value / 4.0;
            gradient += way * (value / (4.0 * h));
        }
        (mean, gradient)
    }

    /// The part of the body that a point of the skin belongs to.
    pub(super) fn part(&self, p: Point3<f64>) -> BodyPart {
        let q = Point3::new(p.x.abs(), p.y, p.z);
        let left = p.x >= 0.0;
        if self.left_arm(q) < self.without_arms(p) {
            return if left { BodyPart::LeftArm } else { BodyPart::RightArm };
        }
        if p.y < self.levels[0] {
            return if left { BodyPart::LeftLeg } else { BodyPart::RightLeg };
        }
        let (middle, upward) = self.neck_plane;
        let neck = self.neck.value(p);
        if p.y > self.levels[6] && self.skull.value(p).min(self.face.value(p)) < neck {
            BodyPart::Head
        } else if (p - middle).dot(&upward) > 0.0 && neck < self.trunk.value(p) {
            BodyPart::Neck
        } else {
            BodyPart::Trunk
        }
    }

    /// The box round the whole body, m.
    pub(super) fn bounds(&self) -> Bounds {
        let low = |b: &Bounds| [b.low, b.high];
        let mut points: Vec<Point3<f64>> = Vec::new();
        points.extend(low(&self.trunk.bounds));
        points.extend(low(&self.skull.bounds));
        points.extend(low(&self.face.bounds));
        points.extend(low(&self.chest.bounds));
        points.extend(low(&self.seat.bounds));
        points.extend(low(&self.leg.bounds));
        points.extend(low(&self.foot.bounds));
        points.extend(low(&self.arm.bounds));
        points.extend(low(&self.thumb.bounds));
        let both = points.iter().flat_map(|p| [*p, Point3::new(-p.x, p.y, p.z)]);
        Bounds::of(both)
    }

    /// Middle of the left leg at height `y`.
    pub(super) fn leg_centre(&self, y: f64) -> Point3<f64> {
        self.leg.shape.centre(y)
    }

    /// Middle of the left arm at `way` m from the shoulder joint.
    pub(super) fn arm_centre(&self, way: f64) -> Point3<f64> {
        self.arm.shape.centre(way)
    }

    /// Direction of the left arm, from the shoulder to the hand.
    pub(super) fn arm_direction(&self) -> Vector3<f64> {
        self.arm.shape.frame.along
    }

    /// Middle of the trunk at height `y`.
    pub(super) fn trunk_centre(&self, y: f64) -> Point3<f64> {
        self.trunk.shape.centre(y)
    }
}

/// Heights of the stations.
fn levels(
    request: &BodyRequest,
    m: &Measures,
    table: &Template,
    size: f64,
) -> Result<[f64; STATIONS], Vec<Diagnostic>> {
    let waist = m.get("waist_to_floor");
    let (hip, crotch) = (waist - m.get("waist_to_hip"), waist - m.get("body_rise"));
    let nape = m.nape();
    let underarm = nape - m.get("armhole_depth");
    let bust = match request.figure {
        // The tape runs from the side of the neck over the breast, about 22° from upright.
        Figure::Female => nape + 0.016 * size - 0.95 * m.get("bust_depth"),
        Figure::Male => underarm - 0.022 * size,
    };
    let underbust = match request.figure {
        Figure::Female => bust - 0.075 * size,
        Figure::Male => waist + 0.5 * (bust - waist),
    };
    // The side of the neck lies above the seventh vertebra: the back of a bodice rises to it.
    let side = nape + 0.016 * size;
    let acromion = side - m.get("shoulder") * libm::sin(table.slope);
    let levels = [crotch, hip, waist, underbust, bust, underarm, acromion, side];
    let names = [
        "body_rise",
        "waist_to_hip",
        "waist_to_floor",
        "back_length",
        "bust_depth",
        "armhole_depth",
        "shoulder",
        "back_length",
    ];
    for k in 1..STATIONS {
        let apart = levels[k] - levels[k - 1];
        if apart < 0.012 * size {
            let message = format!(
                "the heights of `{}` do not follow one another: `{}` and `{}` leave no room",
                request.name,
                names[k - 1],
                names[k]
            );
            let help = "change one of the two, or `back_length`";
            return Err(vec![
                Diagnostic::new("E0309", message).at(request.span, "this wearer").help(help),
            ]);
        }
    }
    Ok(levels)
}

/// The trunk from the crotch to the side of the neck.
fn trunk(
    figure: Figure,
    table: &Template,
    levels: &[f64; STATIONS],
    measures: &Measures,
    scale: &impl Fn(&'static str) -> f64,
    acromion: f64,
    size: f64,
) -> Loft {
    let stations: Vec<f64> = (0..STATIONS).map(|k| k as f64).collect();
    let height = Curve::new(&stations, levels);
    let shoulders = (acromion - 0.018 * size) / table.shoulder()[1];
    let (hip, waist, neck) = (scale("hip"), scale("waist"), scale("neck"));
    let (rib, chest) = match figure {
        Figure::Female => {
            // A fuller bust is carried by a fuller trunk, in part.
            let ribs = scale("underbust");
            let fuller = measures.get("bust") / measures.get("underbust") * (0.75 / 0.88);
            (ribs, ribs * fuller.sqrt())
        }
        Figure::Male => ((scale("chest") + waist) / 2.0, scale("chest")),
    };
    let broad = Curve::new(
        &stations,
        &[hip, hip, waist, rib, chest, (chest + shoulders) / 2.0, shoulders, neck],
    );
    let deep = Curve::new(&stations, &[hip, hip, waist, rib, chest, chest, chest, neck]);
    let rows: Vec<Row> = table
        .trunk
        .iter()
        .map(|[s, breadth, front, back, middle, fullness]| {
            // Stems beyond the stations end inside the neck and below the crotch.
            let beyond = s - s.clamp(0.0, (STATIONS - 1) as f64);
            let t = height.at(*s) + 0.1 * beyond * size;
            let (w, d) = (broad.at(*s), deep.at(*s));
            Row {
                t,
                u: [breadth * w; 2],
                v: [front * d, back * d],
                centre: [0.0, middle * size],
                fullness: *fullness,
            }
        })
        .collect();
    let frame =
        Frame { origin: Point3::origin(), u: Vector3::x(), v: Vector3::z(), along: Vector3::y() };
    // Soft along the ribs, sharper where the shoulders turn into the neck and where the seat
    // draws in between the legs.
    let sharp = Curve::new(
        &[levels[0] + 0.03 * size, levels[1] + 0.03 * size, levels[4], levels[6]],
        &[0.006 * size, 0.026 * size, 0.026 * size, 0.011 * size],
    );
    Loft::new(frame, &rows, |t| sharp.at(t), [0.03 * size, 0.03 * size])
}

/// The neck, from inside the trunk into the head.
fn neck(table: &Template, root: Point3<f64>, girth: f64, size: f64, above: f64) -> Loft {
    let length = 0.16 / 0.23 * above;
    let rows: Vec<Row> = limb_rows(table.neck, |s| (s * length, [girth; 2], size));
    let (sin, cos) = (libm::sin(table.lean), libm::cos(table.lean));
    let frame = Frame {
        origin: root,
        u: Vector3::x(),
        v: Vector3::new(0.0, -sin, cos),
        along: Vector3::new(0.0, cos, sin),
    };
    Loft::new(frame, &rows, |_| 0.01 * size, [0.03 * size, 0.03 * size])
}

/// Skull and face: an egg with a chin, without features.
fn head(height: f64, nape: f64, girth: f64, size: f64) -> (Egg, Egg) {
    let tall = (height - nape) / 0.23;
    // The head keeps its place above the neck when the body grows.
    let ahead = 0.012 * size;
    let skull = Egg {
        middle: Point3::new(0.0, height - 0.092 * tall, ahead),
        radii: Vector3::new(0.074 * girth, 0.088 * tall, 0.095 * girth),
        up: 0.092 * tall,
    };
    let face = Egg {
        middle: Point3::new(0.0, height - 0.130 * tall, ahead + 0.020 * girth),
        radii: Vector3::new(0.055 * girth, 0.073 * tall, 0.062 * girth),
        up: 0.08 * tall,
    };
    (skull, face)
}

/// A breast, or the great chest muscle; the left one.
fn chest(
    figure: Figure,
    table: &Template,
    levels: &[f64; STATIONS],
    measures: &Measures,
    trunk: &Loft,
    corrections: &Corrections,
    size: f64,
) -> Egg {
    let Swelling { station, middle, radii, up, .. } = table.chest;
    let level = levels[station];
    let front = trunk.centre(level).z + trunk.reach_at(level)[2];
    match figure {
        Figure::Female => {
            // Its size follows what the bust has more than the ribs; how far it stands out is
            // left to the tape.
            let gain = (measures.get("bust") - measures.get("underbust")) / 0.13;
            let round =
                libm::cbrt(gain.clamp(0.3, 3.0)) * (measures.get("underbust") / 0.75).sqrt();
            let stand = (corrections.get("bust").copied().unwrap_or(1.0) - 1.0) * BREAST_STAND;
            Egg {
                middle: Point3::new(
                    measures.get("bust_gap") / 2.0 - 0.012 * size,
                    level + middle[1] * size,
                    front + middle[2] * round + stand,
                ),
                // Downwards it ends above the tape of the underbust.
                radii: Vector3::new(radii[0] * round, radii[1] * round.min(1.05), radii[2] * round),
                up: up * round,
            }
        }
        Figure::Male => {
            let wide = measures.get("chest");
            Egg {
                middle: Point3::new(middle[0] * wide, level + middle[1] * size, front + middle[2]),
                radii: Vector3::new(radii[0] * wide, radii[1] * size, radii[2]),
                up: up * size,
            }
        }
    }
}

/// A buttock; the left one.
fn seat(table: &Template, levels: &[f64; STATIONS], hip: f64, size: f64) -> Egg {
    let Swelling { station, middle, radii, up, .. } = table.seat;
    Egg {
        middle: Point3::new(middle[0] * hip, levels[station] + middle[1] * size, middle[2] * hip),
        radii: Vector3::new(radii[0] * hip, radii[1] * size, radii[2] * hip),
        up: up * size,
    }
}

/// The left leg and the heights of thigh, knee, calf and ankle.
fn leg(
    table: &Template,
    measures: &Measures,
    scale: &impl Fn(&'static str) -> f64,
    size: f64,
) -> (Loft, [f64; 4]) {
    let crotch = measures.get("waist_to_floor") - measures.get("body_rise");
    let places = [0.0, 0.12, 0.43, 0.6, 0.92, 1.1];
    let (thigh, ankle) = (scale("thigh"), scale("ankle"));
    let wide = Curve::new(&places, &[ankle, ankle, scale("calf"), scale("knee"), thigh, thigh]);
    let mut rows = limb_rows(table.leg, |s| (s * crotch, [wide.at(s); 2], size));
    // Thighs stay apart: the legs stand wider where they are thick.
    let wider = rows
        .iter()
        .filter(|row| row.t <= crotch)
        .map(|row| row.u[1] + 0.017 * size - row.centre[0])
        .fold(0.0, f64::max);
    for row in &mut rows {
        row.centre[0] += wider;
    }
    let frame =
        Frame { origin: Point3::origin(), u: Vector3::x(), v: Vector3::z(), along: Vector3::y() };
    let loft = Loft::new(frame, &rows, |_| 0.014 * size, [0.02 * size, 0.05 * size]);
    (loft, [0.92, 0.6, 0.43, 0.12].map(|s| s * crotch))
}

/// The left foot, turned out a little.
fn foot(leg: &Loft, grown: f64, size: f64) -> Loft {
    let ankle = leg.centre(0.05 * size);
    let out: f64 = 0.12;
    let along = Vector3::new(libm::sin(out), 0.0, libm::cos(out));
    let frame = Frame {
        origin: Point3::new(ankle.x, 0.0, ankle.z),
        u: Vector3::new(along.z, 0.0, -along.x),
        v: Vector3::y(),
        along,
    };
    let rows: Vec<Row> = FOOT
        .iter()
        .map(|[t, half, top, side]| {
            let middle = top * 0.4;
            Row {
                t: t * grown,
                u: [half * grown; 2],
                v: [(top - middle) * grown, (middle + 0.012) * grown],
                centre: [side * grown, middle * grown],
                fullness: 0.05,
            }
        })
        .collect();
    Loft::new(frame, &rows, |_| 0.01 * size, [0.03 * grown, 0.032 * grown])
}

/// The left arm with its hand; ways to the middle of the upper arm, the elbow and the wrist; the
/// thumb.
fn arm(
    table: &Template,
    measures: &Measures,
    scale: &impl Fn(&'static str) -> f64,
    acromion: Point3<f64>,
    widest: f64,
    chest_level: f64,
    size: f64,
) -> (Loft, [f64; 3], Loft) {
    let joint = acromion + Vector3::new(-0.016, -0.045, 0.0) * size;
    let length = measures.get("arm_length") - 0.02 * size;
    let upper = scale("upper_arm");
    // The arm hangs far enough out to leave the widest part of the chest free.
    let thick = measures.get("upper_arm") / std::f64::consts::TAU;
    let mut angle: f64 = 0.64;
    for _ in 0..24 {
        let drop = joint.y - chest_level;
        let inner = joint.x + drop * libm::tan(angle) - thick / libm::cos(angle);
        if inner > widest + 0.03 * size {
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
    let places = [0.0, 0.3, 0.56, 1.0];
    let wide = Curve::new(&places, &[upper, upper, scale("elbow"), scale("wrist")]);
    let mut rows = limb_rows(table.arm, |s| (s * length, [wide.at(s); 2], size));
    let hand = 0.18 * measures.get("height") / 1.68;
    let broad = (scale("wrist") + measures.get("height") / table.height) / 2.0;
    rows.extend(limb_rows(table.hand, |s| (length + s * hand, [broad; 2], size)));
    let loft = Loft::new(frame, &rows, |_| 0.012 * size, [0.045 * upper, 0.12 * hand]);

    let way = (Vector3::z() * 0.55 + frame.along * 0.83).normalize();
    let base = frame.outward([0.052 * size, -0.002 * size, length + 0.32 * hand]);
    let across = (frame.along - way * frame.along.dot(&way)).normalize();
    let thumb_frame = Frame { origin: base, u: across, v: frame.v, along: way };
    let row = |t: f64, r: f64| Row {
        t: t * broad,
        u: [r * broad; 2],
        v: [r * broad; 2],
        centre: [0.0; 2],
        fullness: 0.0,
    };
    let thumb = Loft::new(
        thumb_frame,
        &[row(0.0, 0.0135), row(0.035, 0.0125), row(0.058, 0.0105)],
        |_| 0.005 * size,
        [0.013 * broad, 0.0105 * broad],
    );
    (loft, [0.3, 0.56, 1.0].map(|s| s * length), thumb)
}

/// Rows of a limb's table: `place` gives way along it, factors of breadth and depth, and of the
/// middle line.
fn limb_rows(table: &[LimbRow], place: impl Fn(f64) -> (f64, [f64; 2], f64)) -> Vec<Row> {
    table
        .iter()
        .map(|[s, a, b, c, d, e, f]| {
            let (t, [w, h], shift) = place(*s);
            Row {
                t,
                u: [a * w, b * w],
                v: [c * h, d * h],
                centre: [e * shift, f * shift],
                fullness: 0.0,
            }
        })
        .collect()
}
