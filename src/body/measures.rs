//! The measures of a body: which there are, what stands in for one that is missing, and which
//! cannot be.

use crate::diagnostic::Diagnostic;
use crate::garment::scene::{BodyRequest, Figure};
use std::collections::BTreeMap;

/// What stands in for a measure that is not given. Where there are two shares, the first is that
/// of grown people, the second that of a child 1.15 m tall; between 1.5 m and 1.15 m they mix.
#[derive(Clone, Copy, Debug)]
enum Stand {
    /// A share of the height.
    Height(f64, f64),
    /// A share of another measure, named earlier in the table.
    Of(&'static str, f64, f64),
    /// A share of another measure and a share of the height: grows slower than the measure.
    Mixed(&'static str, f64, f64),
    /// A fixed length and a share of the height.
    Grown(f64, f64),
    /// The sum of two measures named earlier.
    Sum(&'static str, &'static str),
}

/// A measure: its name, its stand-in, and the least and most that it may be as shares of the
/// height.
type Entry = (&'static str, Stand, f64, f64);

/// Measures of the female figure. Shares: the sizes of the language's own reference body (EU 38)
/// where it has them, for the rest the means of ANSUR II (Gordon et al. 2014, women) as shares of
/// stature, hip or upper arm, rounded.
const FEMALE: &[Entry] = &[
    ("waist_to_floor", Stand::Height(0.625, 0.594), 0.5, 0.72),
    ("back_length", Stand::Height(0.244, 0.236), 0.17, 0.34),
    ("waist_to_hip", Stand::Height(0.119, 0.119), 0.06, 0.19),
    ("body_rise", Stand::Height(0.164, 0.164), 0.11, 0.24),
    ("armhole_depth", Stand::Height(0.12, 0.12), 0.08, 0.19),
    ("bust", Stand::Height(0.524, 0.524), 0.36, 1.1),
    ("underbust", Stand::Of("bust", 0.852, 0.96), 0.3, 1.0),
    ("waist", Stand::Of("bust", 0.818, 0.93), 0.28, 1.1),
    ("hip", Stand::Of("bust", 1.102, 1.07), 0.38, 1.2),
    ("neck", Stand::Mixed("bust", 0.19, 0.1148), 0.15, 0.36),
    ("shoulder", Stand::Height(0.0726, 0.0726), 0.05, 0.11),
    ("bust_depth", Stand::Of("back_length", 0.671, 0.671), 0.1, 0.26),
    ("bust_gap", Stand::Of("bust", 0.216, 0.216), 0.06, 0.22),
    ("upper_arm", Stand::Of("bust", 0.317, 0.317), 0.1, 0.4),
    ("elbow", Stand::Of("upper_arm", 0.87, 0.87), 0.09, 0.32),
    ("wrist", Stand::Of("upper_arm", 0.565, 0.565), 0.06, 0.18),
    ("arm_length", Stand::Height(0.351, 0.351), 0.26, 0.44),
    ("thigh", Stand::Of("hip", 0.58, 0.58), 0.2, 0.62),
    ("knee", Stand::Of("hip", 0.385, 0.385), 0.13, 0.42),
    ("calf", Stand::Of("hip", 0.372, 0.372), 0.12, 0.42),
    ("ankle", Stand::Of("hip", 0.23, 0.23), 0.08, 0.24),
    ("head", Stand::Grown(0.42, 0.08), 0.25, 0.55),
];

/// Measures of the male figure; shares from EU 50 and ANSUR II (men) in the same way.
const MALE: &[Entry] = &[
    ("inseam", Stand::Height(0.4556, 0.43), 0.34, 0.56),
    ("body_rise", Stand::Height(0.15, 0.16), 0.1, 0.24),
    ("waist_to_floor", Stand::Sum("inseam", "body_rise"), 0.5, 0.72),
    ("back_length", Stand::Height(0.25, 0.24), 0.17, 0.34),
    ("waist_to_hip", Stand::Height(0.115, 0.115), 0.06, 0.19),
    ("armhole_depth", Stand::Height(0.1333, 0.1333), 0.08, 0.19),
    ("chest", Stand::Height(0.556, 0.556), 0.36, 1.1),
    ("waist", Stand::Of("chest", 0.88, 0.94), 0.3, 1.1),
    ("hip", Stand::Of("chest", 1.03, 1.05), 0.38, 1.1),
    ("neck", Stand::Mixed("chest", 0.2, 0.1111), 0.15, 0.36),
    ("shoulder", Stand::Height(0.0861, 0.0861), 0.05, 0.12),
    ("upper_arm", Stand::Of("chest", 0.31, 0.31), 0.1, 0.4),
    ("elbow", Stand::Of("upper_arm", 0.88, 0.88), 0.09, 0.32),
    ("wrist", Stand::Of("upper_arm", 0.565, 0.565), 0.06, 0.18),
    ("arm_length", Stand::Height(0.361, 0.361), 0.26, 0.44),
    ("thigh", Stand::Of("hip", 0.56, 0.56), 0.2, 0.62),
    ("knee", Stand::Of("hip", 0.375, 0.375), 0.13, 0.42),
    ("calf", Stand::Of("hip", 0.365, 0.365), 0.12, 0.42),
    ("ankle", Stand::Of("hip", 0.225, 0.225), 0.08, 0.24),
    ("head", Stand::Grown(0.42, 0.085), 0.25, 0.55),
];

/// Pairs that must fit together: the first measure is at least the third number and at most the
/// fourth, as a share of the second.
const PAIRS: &[(&str, &str, f64, f64)] = &[
    ("bust", "underbust", 1.02, 1.45),
    ("bust", "hip", 0.6, 1.45),
    ("chest", "hip", 0.65, 1.5),
    ("underbust", "waist", 0.65, 1.5),
    ("chest", "waist", 0.75, 1.6),
    ("waist", "hip", 0.5, 1.3),
    ("thigh", "hip", 0.42, 0.7),
    ("knee", "thigh", 0.45, 1.0),
    ("calf", "knee", 0.65, 1.35),
    ("ankle", "calf", 0.4, 0.9),
    ("elbow", "upper_arm", 0.6, 1.2),
    ("wrist", "elbow", 0.4, 0.95),
    ("neck", "bust", 0.25, 0.6),
    ("neck", "chest", 0.25, 0.6),
    ("bust_gap", "bust", 0.14, 0.3),
    ("body_rise", "waist_to_hip", 1.1, 2.4),
    ("bust_depth", "back_length", 0.45, 0.9),
    ("armhole_depth", "back_length", 0.35, 0.7),
];

/// Height of the seventh neck vertebra as a share of the body's height.
const NAPE: f64 = 0.862;
/// Height gained along the back by a unit of its length: the back is curved.
pub(super) const BACK_RISE: f64 = 0.976;

/// All measures of a body, m, none missing.
#[derive(Clone, Debug)]
pub(super) struct Measures {
    values: BTreeMap<&'static str, f64>,
}

impl Measures {
    /// Fills in what the request leaves out and refuses what no body can be.
    ///
    /// # Errors
    /// E0308: a measure is not a length a body can have, or is one no body has. E0309: two
    /// measures do not go together.
    pub(super) fn new(request: &BodyRequest) -> Result<Measures, Vec<Diagnostic>> {
        let table = match request.figure {
            Figure::Female => FEMALE,
            Figure::Male => MALE,
        };
        let mut wrong = Vec::new();
        for (name, value) in &request.measures {
            if !value.is_finite() || *value < 0.005 || *value > 3.0 {
                let message =
                    format!("`{}.{name}` of {} is no measure of a body", request.name, cm(*value));
                let help = "measures of a body lie between 0.5 cm and 3 m";
                wrong.push(
                    Diagnostic::new("E0308", message).at(request.span, "this wearer").help(help),
                );
            }
        }
        if !wrong.is_empty() {
            return Err(wrong);
        }
        let given = |name: &str| request.measures.get(name).copied();
        let height = given("height").unwrap_or_else(|| {
            let floor =
                given("waist_to_floor").or_else(|| Some(given("inseam")? + given("body_rise")?));
            match (floor, given("back_length")) {
                (Some(floor), Some(back)) => (floor + BACK_RISE * back) / NAPE,
                (Some(floor), None) => floor / 0.62,
                _ => match request.figure {
                    Figure::Female => 1.68,
                    Figure::Male => 1.8,
                },
            }
        });
        let mut values = BTreeMap::from([("height", height)]);
        if !(0.6..=2.5).contains(&height) {
            let message = format!("`{}` would be {} tall", request.name, cm(height));
            return Err(vec![
                Diagnostic::new("E0308", message)
                    .at(request.span, "this wearer")
                    .help("figures can be made from 60 cm to 250 cm tall; check `height`"),
            ]);
        }
        let youth = ((1.5 - height) / 0.35).clamp(0.0, 1.0);
        let mix = |grown: f64, child: f64| grown + (child - grown) * youth;
        for (name, stand, least, most) in table {
            let known = |other: &str| values.get(other).copied().unwrap_or(height);
            let value = given(name).unwrap_or_else(|| match stand {
                Stand::Height(grown, child) => mix(*grown, *child) * height,
                Stand::Of(other, grown, child) => mix(*grown, *child) * known(other),
                Stand::Mixed(other, share, tall) => share * known(other) + tall * height,
                Stand::Grown(fixed, share) => fixed + share * height,
                Stand::Sum(first, second) => known(first) + known(second),
            });
            values.insert(name, value);
            if !(least * height..=most * height).contains(&value) {
                let message = format!(
                    "`{}.{name}` of {} does not fit a height of {}",
                    request.name,
                    cm(value),
                    cm(height)
                );
                let help = format!(
                    "a figure of this height has {} to {}; change `{name}` or `height`",
                    cm(least * height),
                    cm(most * height)
                );
                wrong.push(
                    Diagnostic::new("E0308", message).at(request.span, "this wearer").help(help),
                );
            }
        }
        for (one, other, least, most) in PAIRS {
            let (Some(a), Some(b)) = (values.get(one), values.get(other)) else { continue };
            if !(least * b..=most * b).contains(a) {
                let message = format!(
                    "`{}.{one}` of {} and `{other}` of {} do not go together",
                    request.name,
                    cm(*a),
                    cm(*b)
                );
                let help = format!(
                    "with this `{other}`, `{one}` can be {} to {}",
                    cm(least * b),
                    cm(most * b)
                );
                wrong.push(
                    Diagnostic::new("E0309", message).at(request.span, "this wearer").help(help),
                );
            }
        }
        let measures = Measures { values };
        let nape = measures.nape();
        if wrong.is_empty() && !(0.105..=0.215).contains(&(1.0 - nape / height)) {
            let message = format!(
                "the heights of `{}` do not add up: {} to the waist and a back of {} leave {} \
                 for neck and head",
                request.name,
                cm(measures.get("waist_to_floor")),
                cm(measures.get("back_length")),
                cm(height - nape)
            );
            let help = format!(
                "a `height` of {} to {} fits, or change `waist_to_floor` or `back_length`",
                cm(nape / 0.89),
                cm(nape / 0.79)
            );
            wrong
                .push(Diagnostic::new("E0309", message).at(request.span, "this wearer").help(help));
        }
        if wrong.is_empty() { Ok(measures) } else { Err(wrong) }
    }

    /// A measure by name, m; 0 for a name that the figure does not have.
    pub(super) fn get(&self, name: &str) -> f64 {
        self.values.get(name).copied().unwrap_or(0.0)
    }

    /// Height of the seventh neck vertebra, m.
    pub(super) fn nape(&self) -> f64 {
        self.get("waist_to_floor") + BACK_RISE * self.get("back_length")
    }
}

/// A length as people read it.
pub(super) fn cm(length: f64) -> String {
    let text = format!("{:.1}", length * 100.0);
    format!("{} cm", text.strip_suffix(".0").unwrap_or(&text))
}
