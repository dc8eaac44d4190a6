//! The trunk from the crotch to the side of the neck, and what rises on it: breasts, buttocks,
//! shoulder blades, collar bones.

use super::figure::{Rise, STATIONS, Side, Template};
use super::fit::skin;
use super::form::Scales;
use super::loft::{Curve, Frame, Loft, Row};
use super::measures::Measures;
use super::part::{Bump, Shape};
use crate::diagnostic::Diagnostic;
use crate::garment::scene::{BodyRequest, Figure};
use nalgebra::{Point3, Vector3};

/// How far a breast moves to the front for a unit of its correction, m.
pub(super) const BREAST_STAND: f64 = 0.1;

/// How deep a bump of the trunk reaches into it and beyond, m.
const DEEP: f64 = 0.16;

/// Heights of the stations.
///
/// # Errors
/// E0309 where they do not follow one another.
pub(super) fn levels(
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

/// The height at each station and in between.
fn heights(levels: &[f64; STATIONS]) -> Curve {
    let stations: Vec<f64> = (0..STATIONS).map(|k| k as f64).collect();
    Curve::new(&stations, levels)
}

/// The trunk without its bumps.
pub(super) fn loft(
    figure: Figure,
    table: &Template,
    levels: &[f64; STATIONS],
    measures: &Measures,
    scales: &Scales,
    acromion: f64,
    size: f64,
) -> Loft {
    let stations: Vec<f64> = (0..STATIONS).map(|k| k as f64).collect();
    let height = heights(levels);
    let shoulders = (acromion - 0.028 * size) / table.shoulder()[1];
    let (hip, waist, neck) = (scales.get("hip"), scales.get("waist"), scales.get("neck"));
    let (rib, chest) = match figure {
        Figure::Female => {
            // A fuller bust is carried by a fuller trunk, in part.
            let ribs = scales.get("underbust");
            let fuller = measures.get("bust") / measures.get("underbust") * (0.75 / 0.88);
            (ribs, ribs * fuller.sqrt())
        }
        Figure::Male => ((scales.get("chest") + waist) / 2.0, scales.get("chest")),
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

/// What rises on the left half of the trunk.
pub(super) fn bumps(
    figure: Figure,
    table: &Template,
    levels: &[f64; STATIONS],
    measures: &Measures,
    scales: &Scales,
    trunk: &Loft,
    size: f64,
) -> Vec<Bump> {
    let height = heights(levels);
    let mut bumps: Vec<Bump> = table
        .rises
        .iter()
        .map(|rise| {
            let wide = if rise.station < 1.5 { scales.get("hip") } else { size };
            let y = height.at(rise.station) + rise.up * size;
            let radii = [
                [rise.radii[0] * wide, rise.radii[1] * wide],
                [rise.radii[2] * size, rise.radii[3] * size],
            ];
            on_skin(trunk, rise, [rise.x * wide, y], radii, rise.height * wide, size)
        })
        .collect();
    if figure == Figure::Female {
        bumps.push(breast(table, levels, measures, scales, trunk, size));
    }
    bumps
}

/// A breast. Its size follows what the bust has more than the ribs; how far it stands out is left
/// to the tape.
fn breast(
    table: &Template,
    levels: &[f64; STATIONS],
    measures: &Measures,
    scales: &Scales,
    trunk: &Loft,
    size: f64,
) -> Bump {
    let gain = (measures.get("bust") - measures.get("underbust")) / 0.13;
    let round = libm::cbrt(gain.clamp(0.3, 3.0)) * (measures.get("underbust") / 0.75).sqrt();
    let breast = &table.breast;
    let stand = breast.height + (scales.correction("bust") - 1.0) * BREAST_STAND;
    let [out, inner, up, down] = breast.radii;
    let x = measures.get("bust_gap") / 2.0 + breast.x * size;
    let y = levels[4] + breast.up * size;
    // Downwards it ends above the tape of the underbust.
    let radii = [[out * round, inner * round], [up * round, down * size.max(round.min(1.05))]];
    on_skin(trunk, breast, [x, y], radii, stand, size)
}

/// A bump whose middle lies on the skin of the bare trunk.
fn on_skin(
    trunk: &Loft,
    rise: &Rise,
    [x, y]: [f64; 2],
    [across, upright]: [[f64; 2]; 2],
    height: f64,
    size: f64,
) -> Bump {
    let way = match rise.side {
        Side::Front => Vector3::z(),
        Side::Back => -Vector3::z(),
    };
    let from = Point3::new(x, y, trunk.centre(y).z);
    let at = from + way * skin(&|p| trunk.value(p), from, way, 0.02 * size);
    let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
    Bump::new(at, axes, [across, upright, [DEEP * size; 2]], height)
}

/// The ridge of the left collar bone, from the pit of the neck to the shoulder.
pub(super) fn collar_bone(acromion: Point3<f64>, nape: f64, size: f64) -> Bump {
    let inner = Point3::new(0.020 * size, nape - 0.058 * size, 0.012 * size);
    let outer = acromion + Vector3::new(-0.012, -0.004, 0.022) * size;
    let along = (outer - inner).normalize();
    let up =
        (Vector3::new(0.0, 0.8, 0.6) - along * along.dot(&Vector3::new(0.0, 0.8, 0.6))).normalize();
    let half = (outer - inner).norm() / 2.0;
    let axes = [along, up, along.cross(&up)];
    let radii = [[half * 1.5; 2], [0.024 * size; 2], [0.06 * size; 2]];
    Bump::new(inner + (outer - inner) / 2.0, axes, radii, 0.0045 * size)
}
