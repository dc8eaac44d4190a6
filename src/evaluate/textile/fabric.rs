//! Fabrics: structure, yarns, and mechanics stated, measured or estimated.

use super::sheet::{self, Sheet, Stated, pair};
use super::yarn::NATURAL;
use crate::diagnostic::{Diagnostic, Span};
use crate::evaluate::Evaluator;
use crate::evaluate::fields::{Fields, Phrase};
use crate::evaluate::item::{ItemId, Made};
use crate::evaluate::words::Kind;
use crate::textile::fabric::{Fabric, Finish, Structure, Thread};
use crate::textile::objection::too_close_by;
use crate::textile::origin::{Origin, Origins};
use crate::textile::sett::{self, Lie};
use crate::textile::weave::Weave;
use crate::textile::yarn::{Fibre, Twist, Yarn};
use crate::units::{self, Dimension};

/// What a fabric is assumed to be where neither the text nor a sheet says it.
///
/// The bending rigidity is that of the cotton measured by Bricis (1995, table 6.2) for its mass.
/// Tension and shear are in the middle of what KES-F sheets of plain woven cottons show at the
/// load of wear (EM 2 to 5 %, LT 0.7; G 0.5 to 1.5 gf/cm/deg), for knits of single jerseys.
struct Usual {
    mass: f64,
    bending: [f64; 2],
    tensile: [f64; 2],
    shear: f64,
}

const COTTON: Usual = Usual {
    mass: 0.2578,
    bending: [1.998595e-5, 1.587697e-5],
    tensile: [4_000.0, 3_000.0],
    shear: 45.0,
};

const JERSEY: Usual =
    Usual { mass: 0.2, bending: [4.0e-6, 3.0e-6], tensile: [400.0, 200.0], shear: 25.0 };

impl Usual {
    /// For another mass: tension and shear grow with the fibres in the section, bending with
    /// them and with the freedom that a thicker cloth takes from them, to the power 3/2.
    fn of_mass(&self, mass: f64) -> Usual {
        let share = mass / self.mass;
        let stiffer = share * share.sqrt();
        Usual {
            mass,
            bending: self.bending.map(|b| b * stiffer),
            tensile: self.tensile.map(|t| t * share),
            shear: self.shear * share,
        }
    }
}

/// Threads per metre of a cloth whose text names no yarns.
const PLAIN_SETT: f64 = 2_400.0;

/// A fabric, and where its measures come from.
pub(in crate::evaluate) fn fabric(ev: &mut Evaluator<'_>, id: ItemId) -> Option<(Fabric, Origins)> {
    let fields = ev.open_item(id)?;
    let mass = stated(ev, &fields, "mass", Dimension::MASS_PER_AREA, 1e-3, 5.0);
    let kes = fields.get("kes").cloned().map(|phrase| sheet::kes_sheet(ev, &phrase));
    let own_mass = mass.ok().flatten().map(|mass| mass.value);
    // A bending length wants a mass, wherever it is said.
    let told_mass = own_mass.or(kes.iter().flatten().find_map(|s| s.mass).map(|mass| mass.value));
    let fast = fields.get("fast").cloned().map(|phrase| sheet::fast_sheet(ev, &phrase, told_mass));
    let thickness = stated(ev, &fields, "thickness", Dimension::LENGTH, 1e-5, 0.05);
    let bending = both(ev, &fields, "bending", Dimension::BENDING, 1e-9, 0.1);
    let tensile = both(ev, &fields, "tensile", Dimension::TENSION, 1.0, 1e7);
    let shear = stated(ev, &fields, "shear", Dimension::SHEAR, 0.0, 1e5);
    let friction = stated(ev, &fields, "friction", Dimension::NUMBER, 0.0, 2.0);
    let poisson = stated(ev, &fields, "poisson", Dimension::NUMBER, 0.0, 0.49);
    let damping = stated(ev, &fields, "damping", Dimension::NUMBER, 0.0, 1.0);
    // Read for their dimensions; the elastic cloth has no hysteresis, and panels no roll yet.
    let idle = both(ev, &fields, "bending_hysteresis", Dimension::FORCE, 0.0, 1e2).is_ok()
        & stated(ev, &fields, "shear_hysteresis", Dimension::TENSION, 0.0, 1e4).is_ok()
        & stated(ev, &fields, "width", Dimension::LENGTH, 0.05, 10.0).is_ok();
    let structure = structure(ev, &fields, own_mass).filter(|_| idle);
    let sheets: Vec<Sheet> = [kes, fast].into_iter().flatten().collect::<Option<Vec<Sheet>>>()?;
    let mut one = |name: &str, own: Option<Span>, told: &[Option<Span>]| {
        let mut places: Vec<Span> = own.into_iter().chain(told.iter().copied().flatten()).collect();
        places.dedup();
        if let [first, second, ..] = places[..] {
            ev.tell(
                Diagnostic::new("E0605", format!("{name} is given twice"))
                    .at(second, "here")
                    .at(first, "and here")
                    .help("keep one"),
            );
        }
    };
    let (mass, thickness, bending) = (mass.ok()?, thickness.ok()?, bending.ok()?);
    let (tensile, shear, friction) = (tensile.ok()?, shear.ok()?, friction.ok()?);
    let span1 = |of: Option<Stated<f64>>| of.map(|it| it.span);
    let span2 = |of: Option<Stated<[f64; 2]>>| of.map(|it| it.span);
    let of = |pick: &dyn Fn(&Sheet) -> Option<Span>| -> Vec<Option<Span>> {
        sheets.iter().map(pick).collect()
    };
    one("mass", span1(mass), &of(&|s| span1(s.mass)));
    one("thickness", span1(thickness), &of(&|s| span1(s.thickness)));
    one("bending", span2(bending), &of(&|s| span2(s.bending)));
    one("tensile", span2(tensile), &of(&|s| span2(s.tensile)));
    one("shear", span1(shear), &of(&|s| span1(s.shear)));
    one("friction", span1(friction), &of(&|s| span1(s.friction)));
    let structure = structure?;
    let made = if ["warp", "weft", "yarn"].iter().any(|word| fields.get(word).is_some()) {
        Origin::Yarns
    } else {
        Origin::Assumed
    };
    let single = |own: Option<Stated<f64>>, pick: &dyn Fn(&Sheet) -> Option<Stated<f64>>| {
        chosen(own, &sheets, pick)
    };
    let pairs = |own: Option<Stated<[f64; 2]>>,
                 pick: &dyn Fn(&Sheet) -> Option<Stated<[f64; 2]>>| {
        chosen(own, &sheets, pick)
    };
    let said = mass.or(sheets.iter().find_map(|s| s.mass));
    let mass = single(mass, &|s| s.mass).unwrap_or_else(|| (structure.mass(), made));
    let usual = match structure {
        Structure::Woven { .. } => COTTON.of_mass(mass.0),
        Structure::Knitted { .. } => JERSEY.of_mass(mass.0),
    };
    let thickness =
        single(thickness, &|s| s.thickness).unwrap_or_else(|| (structure.thickness(), made));
    let bending = pairs(bending, &|s| s.bending).unwrap_or((usual.bending, Origin::Assumed));
    let tensile = pairs(tensile, &|s| s.tensile).unwrap_or((usual.tensile, Origin::Assumed));
    let shear = single(shear, &|s| s.shear).unwrap_or((usual.shear, Origin::Assumed));
    let friction = single(friction, &|s| s.friction).unwrap_or((0.3, Origin::Assumed));
    let poisson = single(poisson.ok()?, &|_| None).unwrap_or((0.25, Origin::Assumed));
    let damping = single(damping.ok()?, &|_| None).unwrap_or((0.02, Origin::Assumed));
    let origins = Origins {
        mass: mass.1,
        thickness: thickness.1,
        bending: bending.1,
        tensile: tensile.1,
        shear: shear.1,
        poisson: poisson.1,
        friction: friction.1,
        damping: damping.1,
        readings: sheets.iter().flat_map(|sheet| sheet.readings.iter().cloned()).collect(),
    };
    let fabric = Fabric {
        name: ev.item(id).name.clone(),
        mass: mass.0,
        thickness: thickness.0,
        bending: bending.0,
        tensile: tensile.0,
        shear: shear.0,
        poisson: poisson.0,
        friction: friction.0,
        damping: damping.0,
        finish: finish(&fields),
        structure,
    };
    check_mass(ev, &fields, &fabric, said);
    check_threads(ev, &fields, &fabric);
    Some((fabric, origins))
}

/// A measure as the text says it, or else a sheet, and which.
fn chosen<T>(
    own: Option<Stated<T>>,
    sheets: &[Sheet],
    pick: &dyn Fn(&Sheet) -> Option<Stated<T>>,
) -> Option<(T, Origin)> {
    match own {
        Some(own) => Some((own.value, Origin::Stated)),
        None => sheets.iter().find_map(|s| pick(s).map(|it| (it.value, s.origin))),
    }
}

fn finish(fields: &Fields<'_>) -> Finish {
    match fields.get("finish").and_then(|phrase| phrase.choice(0)) {
        Some("satin") => Finish::Satin,
        Some("velvet") => Finish::Velvet,
        Some("wool") => Finish::Wool,
        Some("raised") => Finish::Raised,
        _ => Finish::Matte,
    }
}

/// A quantity where it is given; `Err` where it is wrong and told.
fn stated<'t>(
    ev: &mut Evaluator<'t>,
    fields: &Fields<'t>,
    word: &str,
    dimension: Dimension,
    low: f64,
    high: f64,
) -> Result<Option<Stated<f64>>, ()> {
    match fields.value(word) {
        Some(arg) => ev
            .within_range(arg, dimension, low, high)
            .map(|value| Some(Stated { value, span: arg.expr.span }))
            .ok_or(()),
        None => Ok(None),
    }
}

fn both<'t>(
    ev: &mut Evaluator<'t>,
    fields: &Fields<'t>,
    word: &str,
    dimension: Dimension,
    low: f64,
    high: f64,
) -> Result<Option<Stated<[f64; 2]>>, ()> {
    match fields.get(word).cloned() {
        Some(phrase) => pair(ev, &phrase, dimension, low, high).map(Some).ok_or(()),
        None => Ok(None),
    }
}

/// How it is made. `mass` is what the text says, for yarns that it does not name.
fn structure<'t>(
    ev: &mut Evaluator<'t>,
    fields: &Fields<'t>,
    mass: Option<f64>,
) -> Option<Structure> {
    let made = match fields.value("structure") {
        Some(arg) => {
            let id = ev.item_among(arg, &[Kind::Weave, Kind::Knit])?;
            Some(ev.make(id, arg.expr.span)?)
        }
        None => None,
    };
    match made {
        Some(Made::Knit(knit)) => {
            let wrong = ["warp", "weft"].into_iter().find_map(|word| fields.get(word));
            if let Some(phrase) = wrong {
                ev.tell(
                    Diagnostic::new("E0207", format!("a knit has no {}", phrase.key.text))
                        .at(phrase.span, "here")
                        .help("a knit is made of one yarn: `yarn: NAME`"),
                );
            }
            if let Some(phrase) = fields.get("structure").filter(|_| !knit.chart.closes()) {
                let (first, last) = (knit.chart.uses(0), knit.chart.height() - 1);
                let message = format!(
                    "`{}` does not go on above itself: row 1 works {first} stitches, row {} leaves {}",
                    knit.name,
                    last + 1,
                    knit.chart.leaves(last)
                );
                let told =
                    Diagnostic::new("W0606", message).at(phrase.span, "repeated over the cloth");
                ev.tell(told.help("a chart for a cloth leaves as many stitches as it begins with"));
            }
            let phrase = ev.required(fields, "yarn")?.clone();
            let yarn = thread(ev, &phrase)?.yarn;
            Some(Structure::Knitted { knit: (*knit).clone(), yarn })
        }
        other => {
            if let Some(phrase) = fields.get("yarn") {
                ev.tell(
                    Diagnostic::new("E0207", "a woven cloth has a `warp` and a `weft`")
                        .at(phrase.span, "`yarn` is for knits")
                        .help("`structure:` names a knit, or write `warp:` and `weft:`"),
                );
                return None;
            }
            let weave = match other {
                Some(Made::Weave(weave)) => (*weave).clone(),
                _ => Weave::plain(),
            };
            let warp = fields.get("warp").cloned().map(|phrase| thread(ev, &phrase));
            let weft = fields.get("weft").cloned().map(|phrase| thread(ev, &phrase));
            let (warp, weft) = match (warp, weft) {
                (Some(warp), Some(weft)) => (warp?, weft?),
                (Some(one), None) | (None, Some(one)) => {
                    let one = one?;
                    (one.clone(), one)
                }
                (None, None) => {
                    let thread = unnamed(&weave, mass);
                    (thread.clone(), thread)
                }
            };
            Some(Structure::Woven { weave, warp, weft })
        }
    }
}

/// `w20 at 24/cm color #aabbcc`
fn thread<'t>(ev: &mut Evaluator<'t>, phrase: &Phrase<'t>) -> Option<Thread> {
    let arg = phrase.arg(0)?;
    let yarn = ev.item_named(arg, Kind::Yarn).and_then(|id| ev.make(id, arg.expr.span));
    let sett = match phrase.value("at") {
        Some(arg) => ev.within_range(arg, Dimension::PER_LENGTH, 10.0, 100_000.0),
        None => Some(PLAIN_SETT),
    };
    let colour = match phrase.value("color") {
        Some(arg) => Some(ev.colour(arg)?),
        None => None,
    };
    let Some(Made::Yarn(yarn)) = yarn else { return None };
    let mut yarn = (*yarn).clone();
    if let Some(colour) = colour {
        yarn.colour = colour;
    }
    Some(Thread { spacing: 1.0 / sett?, colour: yarn.colour, yarn })
}

/// A cotton thread, as coarse as the cloth's mass wants it.
fn unnamed(weave: &Weave, mass: Option<f64>) -> Thread {
    let of = |count: f64| {
        let yarn = Yarn {
            name: "cotton".to_owned(),
            count,
            plies: 1,
            twist: 600.0,
            direction: Twist::Z,
            fibre: Fibre::Cotton,
            colour: NATURAL,
            diameter: Yarn::diameter_of(count, Fibre::Cotton),
        };
        Thread { spacing: 1.0 / PLAIN_SETT, colour: NATURAL, yarn }
    };
    let Some(mass) = mass else { return of(20e-6) };
    let woven = |count: f64| {
        let thread = of(count);
        Structure::Woven { weave: weave.clone(), warp: thread.clone(), weft: thread }.mass()
    };
    // Mass grows with the count; halving the interval 40 times is finer than any balance.
    let (mut fine, mut coarse) = (1e-9, 1e-2);
    for _ in 0..40 {
        let middle = (fine + coarse) / 2.0;
        if woven(middle) < mass { fine = middle } else { coarse = middle }
    }
    of(coarse)
}

/// W0602: what the yarns weigh and what the text says.
fn check_mass(
    ev: &mut Evaluator<'_>,
    fields: &Fields<'_>,
    fabric: &Fabric,
    said: Option<Stated<f64>>,
) {
    let named = ["warp", "weft", "yarn"].into_iter().find_map(|word| fields.get(word));
    let (Some(said), Some(named)) = (said, named) else { return };
    let yarns = fabric.structure.mass();
    let share = yarns / said.value;
    // Sizing, finishing and crimp may well make a third of the difference.
    if (0.65..=1.45).contains(&share) {
        return;
    }
    let shown = |mass: f64| format!("{} g/m²", units::trimmed(mass * 1e3, 0));
    ev.tell(
        Diagnostic::new(
            "W0602",
            format!("the yarns make {}, the fabric says {}", shown(yarns), shown(said.value)),
        )
        .at(said.span, "stated")
        .at(named.span, "the yarns")
        .help("check sett, count or mass"),
    );
}

/// W0604: threads closer than they are thick. W0601: floats longer than 6 mm. W0625: threads too
/// close for the weave.
fn check_threads(ev: &mut Evaluator<'_>, fields: &Fields<'_>, fabric: &Fabric) {
    let Structure::Woven { weave, warp, weft } = &fabric.structure else { return };
    let floats = weave.floats();
    let mut overfull = false;
    for (word, thread, across, float) in [
        ("warp", warp, weft, floats.warp_on_face.max(floats.warp_on_back)),
        ("weft", weft, warp, floats.weft_on_face.max(floats.weft_on_back)),
    ] {
        let Some(phrase) = fields.get(word) else { continue };
        if thread.yarn.diameter > thread.spacing * 1.02 {
            overfull = true;
            ev.tell(
                Diagnostic::new(
                    "W0604",
                    format!(
                        "{} threads a cm leave {}, the yarn is {} thick",
                        units::trimmed(0.01 / thread.spacing, 1),
                        units::length(thread.spacing),
                        units::length(thread.yarn.diameter)
                    ),
                )
                .at(phrase.span, "sett and yarn")
                .help(format!(
                    "at most {}/cm",
                    units::trimmed((0.01 / thread.yarn.diameter).floor(), 0)
                )),
            );
        }
        let length = float.map_or(0.0, |crossed| crossed as f64 * across.spacing);
        if length > 6e-3 {
            ev.tell(
                Diagnostic::new(
                    "W0601",
                    format!("the {word} floats over {} without being bound", units::length(length)),
                )
                .at(phrase.span, "this thread")
                .help("floats of more than 6 mm catch; bind more often or set the threads closer"),
            );
        }
    }
    let wanted = sett::room_of(&fabric.structure);
    if let (true, false, Some(phrase)) =
        (wanted > sett::GIVE, overfull, fields.get("warp").or(fields.get("weft")))
    {
        let [warp, weft] =
            [warp, weft].map(|t| Lie { diameter: t.yarn.diameter, spacing: t.spacing });
        ev.tell(too_close_by(warp, weft, wanted).at(phrase.span, "sett and yarn"));
    }
}
