//! The measures of a fabric in the units of those who measure them.

use crate::evaluate::catalogue::Entry;
use crate::textile::origin::Origin;
use crate::textile::{clo, fast, kes};
use serde_json::{Map, Value, json};
use std::fmt::Write;

/// In whose units.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum Units {
    /// SI, as darzi works with them
    Si,
    /// Of the KES-F sheets
    Kes,
    /// Of the FAST sheets
    Fast,
    /// Of CLO and Marvelous Designer
    Clo,
}

impl Units {
    pub(super) const ALL: [Units; 4] = [Units::Si, Units::Kes, Units::Fast, Units::Clo];

    fn title(self) -> &'static str {
        match self {
            Units::Si => "SI",
            Units::Kes => "KES-F",
            Units::Fast => "FAST",
            Units::Clo => "CLO",
        }
    }
}

/// A measure in one unit: one value, or warp and weft.
#[derive(Clone, Debug)]
struct Shown {
    units: Units,
    /// Its name on the sheet; empty where it has none of its own.
    name: &'static str,
    unit: &'static str,
    values: Vec<f64>,
    /// Why it is no exact image of the measure.
    note: &'static str,
}

/// A measure of a fabric.
#[derive(Clone, Debug)]
pub(super) struct Measure {
    name: &'static str,
    pub(super) origin: Origin,
    shown: Vec<Shown>,
}

/// A curve is kept as the straight line through its point at the load of wear.
const STRAIGHT: &str = "straight line";

fn measure(name: &'static str, origin: Origin, values: &[f64], unit: &'static str) -> Measure {
    let measure = Measure { name, origin, shown: Vec::new() };
    measure.or(Units::Si, "", unit, values, |v| v)
}

impl Measure {
    /// The same in other units.
    fn or(
        mut self,
        units: Units,
        name: &'static str,
        unit: &'static str,
        values: &[f64],
        into: impl Fn(f64) -> f64,
    ) -> Self {
        let values = values.iter().map(|&v| into(v)).collect();
        self.shown.push(Shown { units, name, unit, values, note: "" });
        self
    }

    /// Says that what was added last holds on a straight line only.
    fn straight(mut self) -> Self {
        if let Some(last) = self.shown.last_mut() {
            last.note = STRAIGHT;
        }
        self
    }
}

/// All measures of a fabric.
pub(super) fn measures(entry: &Entry) -> Vec<Measure> {
    let (fabric, from) = (&entry.fabric, &entry.origins);
    let (mass, thickness, shear) = ([fabric.mass], [fabric.thickness], [fabric.shear]);
    let friction = [fabric.friction];
    let bending = &fabric.bending;
    let tensile = &fabric.tensile;
    let mut bent = measure("bending rigidity", from.bending, bending, "N·m")
        .or(Units::Kes, "B", "gf·cm²/cm", bending, |b| b / kes::BENDING)
        .or(Units::Fast, "B", "µN·m", bending, |b| b * 1e6);
    if from.mass != Origin::Assumed {
        bent = bent
            .or(Units::Fast, "C", "mm", bending, |b| fast::bending_length(fabric.mass, b) * 1e3);
    }
    let bent = bent.or(Units::Clo, "", "g·mm²/s²", bending, |b| b / clo::BENDING);
    let percent = |load: f64| move |k: f64| load / k * 100.0;
    let [load_5, load_20, load_100] = fast::LOADS;
    // A cloth without resistance to shear has no bias extension.
    let sheared: &[f64] = if fabric.shear > 0.0 { &shear } else { &[] };
    vec![
        measure("mass per area", from.mass, &mass, "kg/m²")
            .or(Units::Kes, "W", "mg/cm²", &mass, |w| w / kes::MASS)
            .or(Units::Fast, "W", "g/m²", &mass, |w| w * 1e3)
            .or(Units::Clo, "", "g/m²", &mass, |w| w * 1e3),
        measure("thickness", from.thickness, &thickness, "m")
            .or(Units::Kes, "T0", "mm", &thickness, |t| t * 1e3)
            .or(Units::Fast, "T2", "mm", &thickness, |t| t * 1e3)
            .or(Units::Clo, "", "mm", &thickness, |t| t * 1e3),
        bent,
        measure("tension per strain", from.tensile, tensile, "N/m")
            .or(Units::Kes, "EM", "%", tensile, |k| kes::straight_extension(k) * 100.0)
            .straight()
            .or(Units::Fast, "E5", "%", tensile, percent(load_5))
            .straight()
            .or(Units::Fast, "E20", "%", tensile, percent(load_20))
            .or(Units::Fast, "E100", "%", tensile, percent(load_100))
            .straight()
            .or(Units::Clo, "", "g/s²", tensile, |k| k / clo::STRETCH),
        measure("shear stiffness", from.shear, &shear, "N/m/rad")
            .or(Units::Kes, "G", "gf/cm/deg", &shear, |g| g / kes::SHEAR)
            .or(Units::Fast, "G", "N/m", &shear, |g| g)
            .or(Units::Fast, "EB5", "%", sheared, |g| fast::bias_extension(g) * 100.0)
            .or(Units::Clo, "", "g/s²", &shear, |g| g / clo::STRETCH),
        measure("friction", from.friction, &friction, "")
            .or(Units::Kes, "MIU", "", &friction, |mu| mu)
            .or(Units::Clo, "", "", &friction, |mu| mu),
        measure("Poisson's ratio", from.poisson, &[fabric.poisson], ""),
        measure("damping", from.damping, &[fabric.damping], ""),
    ]
}

/// Four significant figures.
pub(super) fn figure(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    let size = libm::floor(libm::log10(value.abs())) as i32;
    if (-4..7).contains(&size) {
        format!("{value:.*}", (3 - size).max(0) as usize)
    } else {
        format!("{value:.3e}")
    }
}

/// A table of measures, a line for each unit, warp and weft apart.
pub(super) fn table(measures: &[Measure], units: &[Units]) -> String {
    let mut out = String::new();
    for it in measures {
        let mut head = it.name;
        let mut origin = it.origin.word();
        for units in units {
            for shown in it.shown.iter().filter(|s| s.units == *units && !s.values.is_empty()) {
                let values: Vec<String> = shown.values.iter().map(|&v| figure(v)).collect();
                let (warp, weft) = match values.as_slice() {
                    [warp, weft] => (warp.as_str(), weft.as_str()),
                    [one] => (one.as_str(), ""),
                    _ => continue,
                };
                let line = format!(
                    "{head:18}  {:5}  {:4}  {warp:>10}  {weft:>10}  {:9}  {:13}  {origin}",
                    units.title(),
                    shown.name,
                    shown.unit,
                    shown.note,
                );
                let _ = writeln!(out, "{}", line.trim_end());
                (head, origin) = ("", "");
            }
        }
    }
    out
}

/// The head of the table.
pub(super) fn head() -> String {
    let line = format!(
        "{:18}  {:5}  {:4}  {:>10}  {:>10}  {:9}  {:13}  {}",
        "", "", "", "warp", "weft", "", "", "comes from"
    );
    format!("{}\n", line.trim_end())
}

/// The measures as JSON, by their names.
pub(super) fn json(measures: &[Measure], units: &[Units]) -> Value {
    let mut all = Map::new();
    for it in measures {
        let shown: Vec<Value> = it
            .shown
            .iter()
            .filter(|s| units.contains(&s.units) && !s.values.is_empty())
            .map(|s| {
                let mut row = json!({ "units": s.units.title(), "unit": s.unit });
                if !s.name.is_empty() {
                    row["name"] = s.name.into();
                }
                if !s.note.is_empty() {
                    row["holds_on"] = s.note.into();
                }
                match s.values.as_slice() {
                    [warp, weft] => {
                        row["warp"] = (*warp).into();
                        row["weft"] = (*weft).into();
                    }
                    values => row["value"] = values.first().copied().into(),
                }
                row
            })
            .collect();
        if !shown.is_empty() {
            all.insert(it.name.to_owned(), json!({ "from": it.origin, "in": shown }));
        }
    }
    all.into()
}
