//! Places that a tailor names: rings round the body, points of the skin, middle lines of limbs.

use super::fit::skin;
use super::form::Form;
use super::surface::{Landmark, Surface};
use super::tape::{cuts, hull};
use crate::garment::scene::Figure;
use nalgebra::{Point3, Vector3};
use std::collections::BTreeMap;

/// What a station's tape goes round.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Zone {
    /// The trunk, neck or head.
    Trunk,
    /// The left leg.
    Leg,
    /// The left arm.
    Arm,
}

/// A plane in which a tape lies.
#[derive(Clone, Copy, Debug)]
pub(super) struct Station {
    /// Name of the ring.
    pub(super) name: &'static str,
    /// The measure that it takes, if any.
    pub(super) measure: Option<&'static str>,
    /// What it goes round.
    pub(super) zone: Zone,
    /// A point inside.
    pub(super) centre: Point3<f64>,
    /// Upwards along the trunk, or along the limb towards the trunk.
    pub(super) axis: Vector3<f64>,
}

/// The stations of a form; limbs on the left only.
pub(super) fn stations(figure: Figure, form: &Form) -> Vec<Station> {
    let up = Vector3::y();
    let [_, hip, waist, underbust, bust, ..] = form.levels;
    let chest = match figure {
        Figure::Female => "bust",
        Figure::Male => "chest",
    };
    let (neck, upward) = form.neck_plane;
    let trunk = |name, y: f64, measured: bool| Station {
        name,
        measure: measured.then_some(name),
        zone: Zone::Trunk,
        centre: form.trunk_centre(y),
        axis: up,
    };
    let mut all = vec![
        trunk("hip", hip, true),
        trunk("abdomen", (hip + waist) / 2.0, false),
        trunk("waist", waist, true),
        trunk("underbust", underbust, figure == Figure::Female),
        trunk(chest, bust, true),
        Station { axis: upward, centre: neck, ..trunk("neck", neck.y, true) },
        Station { centre: form.brow, ..trunk("head", form.levels[7], true) },
    ];
    for (name, y) in ["thigh", "knee", "calf", "ankle"].into_iter().zip(form.leg_levels) {
        let centre = form.leg_centre(y);
        all.push(Station { name, measure: Some(name), zone: Zone::Leg, centre, axis: up });
    }
    for (name, way) in ["upper_arm", "elbow", "wrist"].into_iter().zip(form.arm_places) {
        all.push(Station {
            name,
            measure: Some(name),
            zone: Zone::Arm,
            centre: form.arm_centre(way),
            axis: -form.arm_direction(),
        });
    }
    all
}

/// All landmarks of a finished surface.
pub(super) fn landmarks(
    figure: Figure,
    form: &Form,
    surface: &Surface,
) -> BTreeMap<String, Landmark> {
    let mut found = BTreeMap::new();
    for station in stations(figure, form) {
        match station.zone {
            Zone::Trunk => {
                add_ring(&mut found, surface, station.name.to_owned(), station, 1.0);
            }
            Zone::Leg | Zone::Arm => {
                for (side, sign) in [("left", 1.0), ("right", -1.0)] {
                    let name = format!("{}.{side}", station.name);
                    add_ring(&mut found, surface, name, station, sign);
                }
            }
        }
        if station.zone == Zone::Leg {
            add_both(&mut found, station.name);
        }
    }
    add_armholes(&mut found, form, surface);
    add_points(&mut found, form);
    add_limbs(&mut found, form);
    found
}

/// `v` on the left, its mirror image on the right.
fn sided(v: Vector3<f64>, sign: f64) -> Vector3<f64> {
    Vector3::new(v.x * sign, v.y, v.z)
}

/// Adds the ring at a station: of the lines cut there, the one round the station's centre.
fn add_ring(
    found: &mut BTreeMap<String, Landmark>,
    surface: &Surface,
    name: String,
    station: Station,
    sign: f64,
) {
    let centre = Point3::from(sided(station.centre.coords, sign));
    let axis = sided(station.axis, sign);
    // Arms run anticlockwise seen from the hand, so about the outward direction.
    let about = if station.zone == Zone::Arm { -axis } else { axis };
    let middle = |line: &[Point3<f64>]| {
        line.iter().map(|p| p.coords).sum::<Vector3<f64>>() / line.len().max(1) as f64
    };
    let nearest =
        cuts(surface, centre, about).into_iter().filter(|line| line.len() >= 3).min_by(|a, b| {
            let off = |line: &[Point3<f64>]| (middle(line) - centre.coords).norm();
            off(a).total_cmp(&off(b))
        });
    if let Some(points) = nearest {
        let centre = Point3::from(middle(&points));
        found.insert(name, Landmark::Ring { centre, axis, points });
    }
}

/// Adds the ring round both legs, under the name without a side.
fn add_both(found: &mut BTreeMap<String, Landmark>, name: &str) {
    let mut flat = Vec::new();
    let mut level = 0.0;
    for side in ["left", "right"] {
        if let Some(Landmark::Ring { points, .. }) = found.get(&format!("{name}.{side}")) {
            flat.extend(points.iter().map(|p| [p.z, p.x]));
            level = points.first().map_or(level, |p| p.y);
        }
    }
    // Anticlockwise in (z, x) is anticlockwise seen from above.
    let points: Vec<Point3<f64>> =
        hull(&flat).into_iter().map(|[z, x]| Point3::new(x, level, z)).collect();
    if points.len() >= 3 {
        let sum: Vector3<f64> = points.iter().map(|p| p.coords).sum();
        let centre = Point3::from(sum / points.len() as f64);
        found.insert(name.to_owned(), Landmark::Ring { centre, axis: Vector3::y(), points });
    }
}

/// Adds the rings where the arms join the trunk, and the points of acromion and underarm.
fn add_armholes(found: &mut BTreeMap<String, Landmark>, form: &Form, surface: &Surface) {
    let value = |p: Point3<f64>| form.value(p);
    let tip = form.acromion;
    // The hollow of the armpit: the highest free place between arm and trunk.
    let mut hollow = tip;
    let mut y = form.levels[6];
    'fall: while y > form.levels[3] {
        let mut x = form.trunk_centre(y).x.max(0.4 * tip.x);
        let end = tip.x + 0.12 * form.size;
        while x < end {
            let p = Point3::new(x, y, form.arm_centre(0.1 * form.size).z);
            if value(p) > 0.0 {
                // Free sky above the shoulder does not count.
                let above = p + Vector3::y() * 0.02 * form.size;
                if value(above) < 0.0 {
                    hollow = p;
                    break 'fall;
                }
            }
            x += 0.002 * form.size;
        }
        y -= 0.002 * form.size;
    }
    let inner = tip - Vector3::y() * (0.03 * form.size);
    let top = inner + Vector3::y() * skin(&value, inner, Vector3::y(), 0.005 * form.size);
    let below = hollow + form.arm_direction() * (0.008 * form.size);
    let chord = top - below;
    let out = Vector3::new(chord.y, -chord.x, 0.0).try_normalize(1e-9).unwrap_or_else(Vector3::x);
    let centre = below + chord / 2.0;
    let station = Station { name: "armhole", measure: None, zone: Zone::Arm, centre, axis: -out };
    for (side, sign) in [("left", 1.0), ("right", -1.0)] {
        add_ring(found, surface, format!("armhole.{side}"), station, sign);
        let point = |p: Point3<f64>| Landmark::Point(Point3::from(sided(p.coords, sign)));
        found.insert(format!("shoulder.{side}"), point(top));
        found.insert(format!("underarm.{side}"), point(hollow));
    }
}

/// Adds the points of the skin.
fn add_points(found: &mut BTreeMap<String, Landmark>, form: &Form) {
    let value = |p: Point3<f64>| form.without_arms(p);
    let stride = 0.01 * form.size;
    let mut put = |name: &str, p: Point3<f64>| {
        found.insert(name.to_owned(), Landmark::Point(p));
    };
    let out = |from: Point3<f64>, way: Vector3<f64>| from + way * skin(&value, from, way, stride);
    let [crotch, hip, waist, _, bust, ..] = form.levels;
    let front = |y: f64| out(form.trunk_centre(y), Vector3::z());
    put("navel", front(waist - 0.02 * form.size));
    put("back_waist", out(form.trunk_centre(waist), -Vector3::z()));
    let (neck, _) = form.neck_plane;
    // From the neck's middle down its axis to the level of each point.
    put("neck_back", out(Point3::new(0.0, form.nape, neck.z - 0.02 * form.size), -Vector3::z()));
    put("neck_front", out(Point3::new(0.0, form.nape - 0.055 * form.size, neck.z), Vector3::z()));
    for (side, sign) in [("left", 1.0), ("right", -1.0)] {
        let across = Vector3::x() * sign;
        let level = Point3::new(0.0, form.levels[7], neck.z - 0.01 * form.size);
        put(&format!("neck_side.{side}"), out(level, across));
        put(&format!("hip.{side}"), out(form.trunk_centre(hip), across));
        put(&format!("waist.{side}"), out(form.trunk_centre(waist), across));
        let x = form.bust_half * sign;
        let from = Point3::new(x, bust, form.trunk_centre(bust).z);
        put(&format!("bust_point.{side}"), out(from, Vector3::z()));
        let knee = form.leg_centre(form.leg_levels[1]);
        put(
            &format!("knee_front.{side}"),
            out(Point3::new(knee.x * sign, knee.y, knee.z), Vector3::z()),
        );
    }
    // From between the legs up to the skin.
    let under = form.trunk_centre(crotch + 0.05 * form.size);
    put("crotch", out(under, -Vector3::y()));
    put("head_top", out(form.brow, Vector3::y()));
}

/// Adds the middle lines of arms and legs.
fn add_limbs(found: &mut BTreeMap<String, Landmark>, form: &Form) {
    let lines = |from: f64, to: f64, centre: &dyn Fn(f64) -> Point3<f64>| {
        (0..=12).map(|k| centre(from + (to - from) * f64::from(k) / 12.0)).collect::<Vec<_>>()
    };
    let arm = lines(0.0, form.arm_places[2], &|t| form.arm_centre(t));
    let leg = lines(form.levels[0], form.leg_levels[3], &|y| form.leg_centre(y));
    let down = -Vector3::y();
    for (name, line, axis) in [("arm", arm, form.arm_direction()), ("leg", leg, down)] {
        let u = super::fit::any_across(axis);
        let v = axis.cross(&u);
        let radii: Vec<f64> = line
            .iter()
            .map(|p| {
                // The mean of the reach to eight sides; inside the trunk the limb's own reach.
                let value = |q: Point3<f64>| {
                    if name == "arm" { form.left_arm(q) } else { form.left_leg(q) }
                };
                (0..8)
                    .map(|k| {
                        let angle = std::f64::consts::FRAC_PI_4 * f64::from(k);
                        let way = u * libm::cos(angle) + v * libm::sin(angle);
                        skin(&value, *p, way, 0.01 * form.size)
                    })
                    .sum::<f64>()
                    / 8.0
            })
            .collect();
        for (side, sign) in [("left", 1.0), ("right", -1.0)] {
            let points = line.iter().map(|p| Point3::new(p.x * sign, p.y, p.z)).collect();
            found.insert(format!("{name}.{side}"), Landmark::Limb { points, radii: radii.clone() });
        }
    }
}
