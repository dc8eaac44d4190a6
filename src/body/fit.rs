//! Fitting: the form is measured with a tape and corrected until every girth is the asked one.

use super::form::{Corrections, Form};
use super::landmark::{Station, Zone, stations};
use super::measures::{Measures, cm};
use super::tape::girth;
use super::trunk::BREAST_STAND;
use crate::diagnostic::Diagnostic;
use crate::garment::scene::{BodyRequest, Figure};
use nalgebra::{Point3, Vector3};
use rayon::prelude::*;
use std::f64::consts::TAU;

/// Rounds of measuring and correcting.
const ROUNDS: usize = 20;
/// A girth within this of the asked one is right, m.
const CLOSE: f64 = 2e-4;
/// A girth further off than this is refused, m.
const WRONG: f64 = 2e-3;
/// Directions in which a section is felt for.
const RAYS: u32 = 120;

/// Finds the form whose girths are those of `measures`.
///
/// # Errors
/// E0309 where heights or girths do not go together.
pub(super) fn fit(request: &BodyRequest, measures: &Measures) -> Result<Form, Vec<Diagnostic>> {
    let names: Vec<&'static str> = match request.figure {
        Figure::Female => vec![
            "hip",
            "waist",
            "underbust",
            "bust",
            "neck",
            "head",
            "thigh",
            "knee",
            "calf",
            "ankle",
            "upper_arm",
            "elbow",
            "wrist",
        ],
        Figure::Male => vec![
            "hip",
            "waist",
            "chest",
            "neck",
            "head",
            "thigh",
            "knee",
            "calf",
            "ankle",
            "upper_arm",
            "elbow",
            "wrist",
        ],
    };
    let mut corrections: Corrections = names.iter().map(|name| (*name, 1.0)).collect();
    let mut form = Form::new(request, measures, &corrections)?;
    let mut last = None;
    for round in 0..=ROUNDS {
        let all = stations(request.figure, &form);
        let found: Vec<(&'static str, f64)> = names
            .par_iter()
            .filter_map(|name| {
                let station = all.iter().find(|s| s.measure == Some(*name))?;
                Some((*name, felt(&form, station)))
            })
            .collect();
        let off = |name: &str, girth: f64| measures.get(name) - girth;
        if found.iter().all(|(name, girth)| off(name, *girth).abs() < CLOSE) {
            return Ok(form);
        }
        if round == ROUNDS {
            return refuse(request, measures, &found).map_or(Ok(form), |wrong| Err(vec![wrong]));
        }
        for (name, girth) in found {
            let Some(factor) = corrections.get_mut(name) else { continue };
            if name == "bust" {
                // Moving the front out by one lengthens the tape by about two; the last move
                // tells how much here.
                let gain = last.map_or(1.8, |(stood, taped): (f64, f64)| {
                    (girth - taped) / ((*factor - stood) * BREAST_STAND)
                });
                last = Some((*factor, girth));
                let gain = if gain.is_finite() { gain.clamp(0.4, 4.0) } else { 1.8 };
                *factor = (*factor + off(name, girth) / (gain * BREAST_STAND)).clamp(0.0, 2.5);
            } else {
                let ratio = (measures.get(name) / girth.max(1e-3)).clamp(0.6, 1.6);
                *factor = (*factor * libm::pow(ratio, 1.15)).clamp(0.3, 3.0);
            }
        }
        form = Form::new(request, measures, &corrections)?;
    }
    Ok(form)
}

/// What to say where a girth cannot be reached.
fn refuse(
    request: &BodyRequest,
    measures: &Measures,
    found: &[(&'static str, f64)],
) -> Option<Diagnostic> {
    let (name, girth) = found
        .iter()
        .max_by(|a, b| {
            let off = |(name, girth): &(&str, f64)| (measures.get(name) - girth).abs();
            off(a).total_cmp(&off(b))
        })
        .filter(|(name, girth)| (measures.get(name) - girth).abs() > WRONG)?;
    let message = format!(
        "no body has `{}.{name}` of {} with its other measures",
        request.name,
        cm(measures.get(name))
    );
    let help = format!("{} would fit; change `{name}` or its neighbours", cm(*girth));
    Some(Diagnostic::new("E0309", message).at(request.span, "this wearer").help(help))
}

/// Girth of the form at a station, m.
fn felt(form: &Form, station: &Station) -> f64 {
    let value = |p: Point3<f64>| match station.zone {
        Zone::Trunk => form.without_arms(p),
        // The other leg lies beyond the middle plane.
        Zone::Leg => form.without_arms(p).max(-p.x),
        Zone::Arm => form.left_arm(p),
    };
    let u = any_across(station.axis);
    let v = station.axis.cross(&u);
    let points: Vec<[f64; 2]> = (0..RAYS)
        .map(|k| {
            let angle = TAU * f64::from(k) / f64::from(RAYS);
            let (sin, cos) = (libm::sin(angle), libm::cos(angle));
            let way = u * cos + v * sin;
            let reach = skin(&value, station.centre, way, 0.02 * form.size);
            [reach * cos, reach * sin]
        })
        .collect();
    girth(&points)
}

/// Distance from an inner point to the skin along `way`, m: strides outwards until outside, then
/// false position.
///
/// # References
/// Dowell and Jarratt 1971, "A modified regula falsi method" (the Illinois rule).
pub(super) fn skin(
    value: &impl Fn(Point3<f64>) -> f64,
    from: Point3<f64>,
    way: Vector3<f64>,
    stride: f64,
) -> f64 {
    let at = |reach: f64| value(from + way * reach);
    let (mut inner, mut outer) = (0.0, stride);
    let (mut f, mut g) = (at(inner), at(outer));
    while g < 0.0 && outer < 2.0 {
        (inner, f) = (outer, g);
        outer += stride;
        g = at(outer);
    }
    for _ in 0..40 {
        if outer - inner < 1e-7 || f >= 0.0 {
            break;
        }
        let middle = (inner + (outer - inner) * (f / (f - g))).clamp(inner, outer);
        let h = at(middle);
        if h.abs() < 1e-8 {
            return middle;
        }
        // The end that stays weighs half, so that neither end stays for long.
        if h < 0.0 {
            (inner, f, g) = (middle, h, g / 2.0);
        } else {
            (outer, g, f) = (middle, h, f / 2.0);
        }
    }
    (inner + outer) / 2.0
}

/// A unit vector square to `axis`.
pub(super) fn any_across(axis: Vector3<f64>) -> Vector3<f64> {
    let other = if axis.x.abs() < 0.8 { Vector3::x() } else { Vector3::z() };
    (other - axis * axis.dot(&other)).normalize()
}
