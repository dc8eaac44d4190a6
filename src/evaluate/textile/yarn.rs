//! Yarns.

use crate::evaluate::Evaluator;
use crate::evaluate::item::ItemId;
use crate::textile::Colour;
use crate::textile::yarn::{Fibre, Twist, Yarn};
use crate::units::Dimension;

/// Undyed cotton.
pub(super) const NATURAL: Colour = Colour([0xe8, 0xe4, 0xda, 0xff]);

/// The finest and the coarsest yarn, kg/m: a hundredth of a denier and a rope of 100 ktex.
const COUNTS: (f64, f64) = (1e-9, 0.1);

/// A yarn.
pub(in crate::evaluate) fn yarn(ev: &mut Evaluator<'_>, id: ItemId) -> Option<Yarn> {
    let fields = ev.open_item(id)?;
    let count = match ev.required(&fields, "count")?.arg(0) {
        Some(arg) => ev.within_range(arg, Dimension::COUNT, COUNTS.0, COUNTS.1),
        None => None,
    };
    let plies = match fields.value("plies") {
        Some(arg) => ev.whole_number(arg, 1, 1_000),
        None => Some(1),
    };
    let twist = match fields.value("twist") {
        Some(arg) => {
            let wanted = [Dimension::ANGLE_PER_LENGTH, Dimension::PER_LENGTH];
            ev.quantity_of(arg, &wanted).map(|found| match found.dimension {
                Dimension::ANGLE_PER_LENGTH => found.value / std::f64::consts::TAU,
                _ => found.value,
            })
        }
        None => Some(0.0),
    };
    let direction = match fields.get("twist").and_then(|phrase| phrase.choice(1)) {
        Some("S") => Twist::S,
        _ => Twist::Z,
    };
    let fibre = match fields.get("fibre").and_then(|phrase| phrase.choice(0)) {
        Some("silk") => Fibre::Silk,
        Some("wool") => Fibre::Wool,
        Some("linen") => Fibre::Linen,
        Some("jute") => Fibre::Jute,
        Some("viscose") => Fibre::Viscose,
        Some("polyester") => Fibre::Polyester,
        Some("nylon") => Fibre::Nylon,
        Some("metal") => Fibre::Metal,
        _ => Fibre::Cotton,
    };
    let colour = match fields.value("color") {
        Some(arg) => ev.colour(arg),
        None => Some(NATURAL),
    };
    // Read for their dimensions; the pictures draw every yarn alike smooth.
    for word in ["hairiness", "friction"] {
        if let Some(arg) = fields.value(word) {
            ev.within_range(arg, Dimension::NUMBER, 0.0, 2.0)?;
        }
    }
    let count = count?;
    let diameter = match fields.value("diameter") {
        Some(arg) => ev.within_range(arg, Dimension::LENGTH, 1e-6, 0.05),
        None => Some(Yarn::diameter_of(count, fibre)),
    };
    Some(Yarn {
        name: ev.item(id).name.clone(),
        count,
        plies: u32::try_from(plies?).unwrap_or(1),
        twist: twist?,
        direction,
        fibre,
        colour: colour?,
        diameter: diameter?,
    })
}
