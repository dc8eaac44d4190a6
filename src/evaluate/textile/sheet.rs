//! Sheets of the KES-F and FAST instruments, turned into the quantities of a fabric.

use crate::diagnostic::{Diagnostic, Span};
use crate::evaluate::Evaluator;
use crate::evaluate::fields::{Fields, Phrase};
use crate::evaluate::words::Kind;
use crate::units::{Dimension, GRAVITY};

/// A quantity with the place where it is said.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stated<T> {
    pub value: T,
    pub span: Span,
}

/// What a sheet says of a fabric, SI units; pairs are warp, weft.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sheet {
    pub bending: Option<Stated<[f64; 2]>>,
    pub tensile: Option<Stated<[f64; 2]>>,
    pub shear: Option<Stated<f64>>,
    pub thickness: Option<Stated<f64>>,
    pub mass: Option<Stated<f64>>,
    pub friction: Option<Stated<f64>>,
}

/// The load of the KES-F tensile test, 500 gf/cm, N/m.
const KES_LOAD: f64 = 500.0 * 0.980665;

/// The load at which a tensile curve is made a straight line, 20 gf/cm, N/m: about what a
/// garment's own weight and its wearer's movements put on the cloth, far below the 500 gf/cm at
/// which the test ends.
const WORN_LOAD: f64 = 20.0 * 0.980665;

/// Two quantities, warp and weft; one stands for both. More are told.
pub(super) fn pair<'t>(
    ev: &mut Evaluator<'t>,
    phrase: &Phrase<'t>,
    dimension: Dimension,
    low: f64,
    high: f64,
) -> Option<Stated<[f64; 2]>> {
    let args = phrase.args();
    let mut values = Vec::with_capacity(2);
    for arg in &args {
        values.push(ev.within_range(*arg, dimension, low, high)?);
    }
    let value = match values.as_slice() {
        [both] => [*both, *both],
        [warp, weft] => [*warp, *weft],
        more => {
            ev.tell(
                Diagnostic::new(
                    "E0306",
                    format!("`{}` has {} values", phrase.key.text, more.len()),
                )
                .at(phrase.span, "one for both directions, or warp and weft"),
            );
            return None;
        }
    };
    Some(Stated { value, span: phrase.span })
}

/// Reads a row of a sheet where it is given; `Err` where it is wrong.
fn row<'t>(
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

fn mean(of: Stated<[f64; 2]>) -> Stated<f64> {
    Stated { value: (of.value[0] + of.value[1]) / 2.0, span: of.span }
}

/// The KES-F sheet in the block of `phrase` (Kawabata 1980; units of the sheet).
///
/// The tensile curve is F = F_m (ε/ε_m)ⁿ with n = 2/LT − 1, F_m = 500 gf/cm, ε_m = EM; its
/// stiffness is taken as the secant at the load of wear. Without LT the curve is straight.
pub(super) fn kes<'t>(ev: &mut Evaluator<'t>, phrase: &Phrase<'t>) -> Option<Sheet> {
    let block = phrase.block?;
    let fields = ev.read_plain(Kind::Kes, block, "the KES-F sheet", phrase.scope);
    kes_rows(ev, &fields).ok()
}

fn kes_rows<'t>(ev: &mut Evaluator<'t>, fields: &Fields<'t>) -> Result<Sheet, ()> {
    let extension = row(ev, fields, "EM", Dimension::NUMBER, 1e-5, 5.0)?;
    let linearity = row(ev, fields, "LT", Dimension::NUMBER, 0.05, 1.9)?;
    let energy = row(ev, fields, "WT", Dimension::TENSION, 0.0, 1e4)?;
    // Read for their dimensions; the elastic cloth has no use for them.
    row(ev, fields, "RT", Dimension::NUMBER, 0.0, 2.0)?;
    row(ev, fields, "2HG", Dimension::TENSION, 0.0, 1e4)?;
    row(ev, fields, "2HG5", Dimension::TENSION, 0.0, 1e4)?;
    row(ev, fields, "2HB", Dimension::FORCE, 0.0, 1e2)?;
    row(ev, fields, "Tm", Dimension::LENGTH, 0.0, 0.1)?;
    row(ev, fields, "LC", Dimension::NUMBER, 0.0, 2.0)?;
    row(ev, fields, "MMD", Dimension::NUMBER, 0.0, 2.0)?;
    row(ev, fields, "SMD", Dimension::LENGTH, 0.0, 0.01)?;
    let shear = row(ev, fields, "G", Dimension::SHEAR, 0.0, 1e5)?;
    let bending = row(ev, fields, "B", Dimension::BENDING, 1e-9, 0.1)?;
    let thickness = row(ev, fields, "T0", Dimension::LENGTH, 1e-5, 0.05)?;
    let friction = row(ev, fields, "MIU", Dimension::NUMBER, 0.0, 2.0)?;
    let mass = row(ev, fields, "W", Dimension::MASS_PER_AREA, 1e-3, 5.0)?;
    let straight = Stated { value: [1.0, 1.0], span: fields.span };
    // WT = LT · ½ F_m ε_m: of extension, linearity and energy any two give the third.
    let curve = match (extension, linearity, energy) {
        (Some(em), Some(lt), _) => Some((em, lt)),
        (Some(em), None, Some(wt)) => {
            let lt =
                [0, 1].map(|i| (2.0 * wt.value[i] / (KES_LOAD * em.value[i])).clamp(0.05, 1.9));
            Some((em, Stated { value: lt, span: wt.span }))
        }
        (Some(em), None, None) => Some((em, straight)),
        (None, Some(lt), Some(wt)) => {
            let em = [0, 1].map(|i| 2.0 * wt.value[i] / (KES_LOAD * lt.value[i]));
            Some((Stated { value: em, span: wt.span }, lt))
        }
        _ => None,
    };
    let tensile = curve.map(|(em, lt)| Stated {
        value: [0, 1].map(|i| worn_secant(em.value[i], lt.value[i])),
        span: em.span,
    });
    Ok(Sheet {
        bending,
        tensile,
        shear: shear.map(mean),
        thickness: thickness.map(mean),
        mass: mass.map(mean),
        friction: friction.map(mean),
    })
}

/// Tension per strain at the load of wear on the curve of extension EM and linearity LT, N/m.
fn worn_secant(extension: f64, linearity: f64) -> f64 {
    let power = 2.0 / linearity - 1.0;
    let strain = extension * libm::pow(WORN_LOAD / KES_LOAD, 1.0 / power);
    WORN_LOAD / strain.max(1e-9)
}

/// The FAST sheet in the block of `phrase` (De Boos and Tester 1994). `stated` is the mass that
/// the fabric itself gives, for bending rigidity from bending length.
pub(super) fn fast<'t>(
    ev: &mut Evaluator<'t>,
    phrase: &Phrase<'t>,
    stated: Option<f64>,
) -> Option<Sheet> {
    let block = phrase.block?;
    let fields = ev.read_plain(Kind::Fast, block, "the FAST sheet", phrase.scope);
    fast_rows(ev, &fields, stated).ok()
}

fn fast_rows<'t>(
    ev: &mut Evaluator<'t>,
    fields: &Fields<'t>,
    stated: Option<f64>,
) -> Result<Sheet, ()> {
    let share = (Dimension::NUMBER, 1e-5, 5.0);
    let at_5 = row(ev, fields, "E5", share.0, 0.0, share.2)?;
    let at_20 = row(ev, fields, "E20", share.0, share.1, share.2)?;
    let at_100 = row(ev, fields, "E100", share.0, share.1, share.2)?;
    let bias = row(ev, fields, "EB5", share.0, share.1, share.2)?;
    let length = row(ev, fields, "C", Dimension::LENGTH, 1e-3, 0.5)?;
    let rigidity = row(ev, fields, "B", Dimension::BENDING, 1e-9, 0.1)?;
    let shear = row(ev, fields, "G", Dimension::TENSION, 0.0, 1e5)?;
    let thickness = row(ev, fields, "T2", Dimension::LENGTH, 1e-5, 0.05)?;
    row(ev, fields, "T100", Dimension::LENGTH, 0.0, 0.05)?;
    let mass = row(ev, fields, "W", Dimension::MASS_PER_AREA, 1e-3, 5.0)?.map(mean);
    // The loads are 5, 20 and 100 gf/cm; 20 is the load of wear, else the nearest that was tested.
    let secant = |row: Stated<[f64; 2]>, load: f64| Stated {
        value: row.value.map(|strain| load * 0.980665 / strain.max(1e-6)),
        span: row.span,
    };
    let tensile = at_20
        .map(|row| secant(row, 20.0))
        .or(at_100.map(|row| secant(row, 100.0)))
        .or(at_5.map(|row| secant(row, 5.0)));
    let bending = match (rigidity, length) {
        (Some(rigidity), _) => Some(rigidity),
        (None, Some(length)) => {
            let Some(mass) = mass.map(|mass| mass.value).or(stated) else {
                ev.tell(
                    Diagnostic::new("E0208", "bending length `C` wants the mass `W` beside it")
                        .at(length.span, "here")
                        .help("bending rigidity is mass × gravity × length³"),
                );
                return Err(());
            };
            let value = length.value.map(|c| mass * GRAVITY * c * c * c);
            Some(Stated { value, span: length.span })
        }
        (None, None) => None,
    };
    // FAST: G = 123 / EB5 with EB5 in percent and G in N/m.
    let shear = shear.map(mean).or(bias.map(|row| {
        let mean = mean(row);
        Stated { value: 1.23 / mean.value, span: mean.span }
    }));
    Ok(Sheet { bending, tensile, shear, thickness: thickness.map(mean), mass, friction: None })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_straight_curve_has_the_same_stiffness_at_every_load() {
        let at_the_end = KES_LOAD / 0.04;
        assert!((worn_secant(0.04, 1.0) / at_the_end - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_crimped_cloth_is_softer_when_worn_than_when_torn() {
        // LT = 2/3: n = 2, so at 1/25 of the load a fifth of the extension is reached.
        let worn = worn_secant(0.04, 2.0 / 3.0);
        assert!((worn - WORN_LOAD / (0.04 / 5.0)).abs() < 1e-6 * worn);
    }
}
