//! The skin of a figure as the zero of a smooth function: lofts that flow into one another, with
//! gentle rises and hollows on them.

use super::arm::Arm;
use super::figure::{STATIONS, Template, template};
use super::head::Head;
use super::leg::Leg;
use super::loft::Loft;
use super::measures::Measures;
use super::part::{Bounds, Bump, Part, cut, join};
use super::surface::BodyPart;
use super::trunk;
use crate::diagnostic::Diagnostic;
use crate::garment::scene::{BodyRequest, Figure};
use nalgebra::{Point3, Vector3};
use std::collections::BTreeMap;

/// What the tapes correct: a factor for each girth, 1 at first.
pub(super) type Corrections = BTreeMap<&'static str, f64>;

/// How much wider than on the reference body the form is drawn, by measure.
pub(super) struct Scales<'a> {
    table: &'a Template,
    measures: &'a Measures,
    corrections: &'a Corrections,
}

impl Scales<'_> {
    /// The factor for a girth.
    pub(super) fn get(&self, name: &str) -> f64 {
        let drawn = self.table.girths.iter().find(|(n, _)| *n == name).map_or(1.0, |(_, g)| *g);
        self.measures.get(name) / drawn * self.correction(name)
    }

    /// The tape's correction alone.
    pub(super) fn correction(&self, name: &str) -> f64 {
        self.corrections.get(name).copied().unwrap_or(1.0)
    }
}

/// A figure's skin as a function of space.
#[derive(Clone, Debug)]
pub(super) struct Form {
    trunk: Part<Loft>,
    head: Head,
    leg: Leg,
    arm: Arm,
    bumps: Vec<Bump>,
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
    /// Middle of the widest section of the head.
    pub(super) brow: Point3<f64>,
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
        let levels = trunk::levels(request, measures, table, size)?;
        let scales = Scales { table, measures, corrections };
        let nape = measures.nape();

        let across = measures.get("shoulder") * libm::cos(table.slope);
        let side_of_neck = measures.get("neck") / std::f64::consts::TAU * 1.02;
        let acromion =
            Point3::new(side_of_neck + across, levels[6], (table.shoulder()[4] + 0.002) * size);
        let torso =
            trunk::loft(request.figure, table, &levels, measures, &scales, acromion.x, size);
        let mut bumps =
            trunk::bumps(request.figure, table, &levels, measures, &scales, &torso, size);
        bumps.push(trunk::collar_bone(acromion, nape, size));
        let head = Head::new(table, measures, &scales, size);
        let (leg, leg_levels) = Leg::new(table, measures, &scales, size);
        let widest: Vec<(f64, f64)> = [levels[1], levels[2], levels[4]]
            .into_iter()
            .map(|level| (level, torso.reach_at(level)[0]))
            .collect();
        let (arm, arm_places) = Arm::new(table, measures, &scales, acromion, &widest, size);
        let full = match request.figure {
            Figure::Female => measures.get("bust_gap"),
            Figure::Male => 0.18 * measures.get("chest"),
        };
        Ok(Form {
            trunk: Part::new(torso),
            neck_plane: head.collar(table, size),
            brow: head.brow(measures),
            nape,
            bust_half: full / 2.0,
            head,
            leg,
            arm,
            bumps,
            size,
            levels,
            acromion,
            arm_places,
            leg_levels,
            height: measures.get("height"),
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
        value = cut(value, self.levels[0] - p.y, 0.062 * size);
        value = join(value, self.head.neck.value(p), 0.045 * size);
        value = join(value, self.head.skull.value(p), 0.030 * size);
        value = join(value, self.leg.value(q), 0.036 * size);
        // Bumps move the skin; far from it they say nothing.
        if value.abs() < 0.15 {
            value -= self.bumps.iter().map(|bump| bump.rise(q)).sum::<f64>();
        }
        // Flat soles.
        cut(value, -p.y, 0.010 * size)
    }

    /// Depth of the furrow along the spine at `p`, m.
    fn furrow(&self, p: Point3<f64>) -> f64 {
        let [_, hip, .., underarm, acromion, _] = self.levels;
        let (low, high) = (hip + 0.05 * self.size, (underarm + acromion) / 2.0);
        if p.z > -0.02 * self.size || p.y < low || p.y > high {
            return 0.0;
        }
        let along = (p.y - low) / (high - low);
        let across = p.x / (0.026 * self.size);
        let bell = libm::exp(-across * across);
        let rise = 16.0 * along * along * (1.0 - along) * (1.0 - along);
        let back = ((-p.z / self.size - 0.02) / 0.03).min(1.0);
        0.006 * self.size * bell * rise * back
    }

    /// The left leg alone.
    pub(super) fn left_leg(&self, p: Point3<f64>) -> f64 {
        self.leg.value(p)
    }

    /// The left arm alone.
    pub(super) fn left_arm(&self, p: Point3<f64>) -> f64 {
        self.arm.value(p)
    }

    /// The whole body: negative inside, about metres near the skin.
    pub(super) fn value(&self, p: Point3<f64>) -> f64 {
        let arm = self.left_arm(Point3::new(p.x.abs(), p.y, p.z));
        join(self.without_arms(p), arm, 0.056 * self.size)
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
        let neck = self.head.neck.value(p);
        if p.y > self.levels[6] && self.head.skull.value(p) < neck {
            BodyPart::Head
        } else if (p - middle).dot(&upward) > 0.0 && neck < self.trunk.value(p) {
            BodyPart::Neck
        } else {
            BodyPart::Trunk
        }
    }

    /// The box round the whole body, m.
    pub(super) fn bounds(&self) -> Bounds {
        let mut boxes = vec![self.trunk.bounds, self.head.skull.bounds];
        boxes.extend(self.leg.bounds());
        boxes.extend(self.arm.bounds());
        // Bumps stand out beyond the lofts.
        let room = Vector3::new(0.0, 0.0, 0.1 * self.size);
        let corners = boxes.iter().flat_map(|b| [b.low - room, b.high + room]);
        Bounds::of(corners.flat_map(|p| [p, Point3::new(-p.x, p.y, p.z)]))
    }

    /// How fine the skin is to be drawn along an axis at a place, as a share of the coarsest
    /// step: hands, feet and head have smaller forms than the trunk.
    pub(super) fn step(&self, axis: usize, at: f64) -> f64 {
        let wrist = self.arm_centre(self.arm_places[2]);
        let size = self.size;
        // From 0 to 1 over 4 cm beyond a place.
        let beyond = |past: f64| (past / (0.04 * size)).clamp(0.0, 1.0);
        match axis {
            0 => 1.0 - 0.50 * beyond(at.abs() - wrist.x + 0.05 * size),
            1 => {
                let foot = 0.38 * beyond(0.12 * size - at);
                let head = 0.30 * beyond(at - self.nape + 0.02 * size);
                let hand = (wrist.y + 0.02 * size - at).min(at - wrist.y + 0.24 * size);
                1.0 - foot - head - 0.45 * beyond(hand)
            }
            _ => {
                let thumb = wrist.z + 0.07 * size;
                let hand = (thumb + 0.03 * size - at).min(at - thumb + 0.11 * size);
                1.0 - 0.36 * beyond(hand)
            }
        }
    }

    /// Middle of the left leg at height `y`.
    pub(super) fn leg_centre(&self, y: f64) -> Point3<f64> {
        self.leg.centre(y)
    }

    /// Middle of the left arm at `way` m from the shoulder joint.
    pub(super) fn arm_centre(&self, way: f64) -> Point3<f64> {
        self.arm.centre(way)
    }

    /// Direction of the left arm, from the shoulder to the hand.
    pub(super) fn arm_direction(&self) -> Vector3<f64> {
        self.arm.direction()
    }

    /// Middle of the trunk at height `y`.
    pub(super) fn trunk_centre(&self, y: f64) -> Point3<f64> {
        self.trunk.shape.centre(y)
    }
}
