//! Sheets of the KES-F and FAST instruments, turned into the quantities of a fabric.

use crate::diagnostic::{Diagnostic, Span};
use crate::evaluate::Evaluator;
use crate::evaluate::fields::{Fields, Phrase};
use crate::evaluate::words::Kind;
use crate::textile::origin::{Origin, Reading};
use crate::textile::{fast, kes};
use crate::units::Dimension;

/// A quantity with the place where it is said.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stated<T> {
    pub value: T,
    pub span: Span,
}

/// What a sheet says of a fabric, SI units; pairs are warp, weft.
#[derive(Clone, Debug, Default)]
pub(super) struct Sheet {
    pub origin: Origin,
    pub readings: Vec<Reading>,
    pub bending: Option<Stated<[f64; 2]>>,
    pub tensile: Option<Stated<[f64; 2]>>,
    pub shear: Option<Stated<f64>>,
    pub thickness: Option<Stated<f64>>,
    pub mass: Option<Stated<f64>>,
    pub friction: Option<Stated<f64>>,
}

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

/// The rows of a sheet, read one by one and kept as they are written.
struct Rows<'e, 't, 'f> {
    ev: &'e mut Evaluator<'t>,
    fields: &'f Fields<'t>,
    sheet: Origin,
    readings: Vec<Reading>,
}

impl Rows<'_, '_, '_> {
    /// A row where it is given; `Err` where it is wrong.
    fn read(
        &mut self,
        name: &'static str,
        dimension: Dimension,
        low: f64,
        high: f64,
    ) -> Result<Option<Stated<[f64; 2]>>, ()> {
        let Some(phrase) = self.fields.get(name).cloned() else { return Ok(None) };
        let row = pair(self.ev, &phrase, dimension, low, high).ok_or(())?;
        self.readings.push(Reading { sheet: self.sheet, name, dimension, value: row.value });
        Ok(Some(row))
    }
}

fn mean(of: Stated<[f64; 2]>) -> Stated<f64> {
    Stated { value: (of.value[0] + of.value[1]) / 2.0, span: of.span }
}

/// The KES-F sheet in the block of `phrase`.
///
/// The stiffness of the tensile curve is its [secant at the load of wear](kes::worn_secant).
/// Without LT the curve is straight.
pub(super) fn kes_sheet<'t>(ev: &mut Evaluator<'t>, phrase: &Phrase<'t>) -> Option<Sheet> {
    let block = phrase.block?;
    let fields = ev.read_plain(Kind::Kes, block, "the KES-F sheet", phrase.scope);
    kes_rows(ev, &fields).ok()
}

fn kes_rows<'t>(ev: &mut Evaluator<'t>, fields: &Fields<'t>) -> Result<Sheet, ()> {
    let mut rows = Rows { ev, fields, sheet: Origin::Kes, readings: Vec::new() };
    let extension = rows.read("EM", Dimension::NUMBER, 1e-5, 5.0)?;
    let linearity = rows.read("LT", Dimension::NUMBER, 0.05, 1.9)?;
    let energy = rows.read("WT", Dimension::TENSION, 0.0, 1e4)?;
    // Read for their dimensions; the elastic cloth has no use for them.
    rows.read("RT", Dimension::NUMBER, 0.0, 2.0)?;
    rows.read("2HG", Dimension::TENSION, 0.0, 1e4)?;
    rows.read("2HG5", Dimension::TENSION, 0.0, 1e4)?;
    rows.read("2HB", Dimension::FORCE, 0.0, 1e2)?;
    rows.read("Tm", Dimension::LENGTH, 0.0, 0.1)?;
    rows.read("LC", Dimension::NUMBER, 0.0, 2.0)?;
    rows.read("MMD", Dimension::NUMBER, 0.0, 2.0)?;
    rows.read("SMD", Dimension::LENGTH, 0.0, 0.01)?;
    let shear = rows.read("G", Dimension::SHEAR, 0.0, 1e5)?;
    let bending = rows.read("B", Dimension::BENDING, 1e-9, 0.1)?;
    let thickness = rows.read("T0", Dimension::LENGTH, 1e-5, 0.05)?;
    let friction = rows.read("MIU", Dimension::NUMBER, 0.0, 2.0)?;
    let mass = rows.read("W", Dimension::MASS_PER_AREA, 1e-3, 5.0)?;
    let straight = Stated { value: [1.0, 1.0], span: fields.span };
    // WT = LT · ½ F_m ε_m: of extension, linearity and energy any two give the third.
    let curve = match (extension, linearity, energy) {
        (Some(em), Some(lt), _) => Some((em, lt)),
        (Some(em), None, Some(wt)) => {
            let lt = [0, 1].map(|i| kes::linearity(em.value[i], wt.value[i]));
            Some((em, Stated { value: lt, span: wt.span }))
        }
        (Some(em), None, None) => Some((em, straight)),
        (None, Some(lt), Some(wt)) => {
            let em = [0, 1].map(|i| kes::extension(lt.value[i], wt.value[i]));
            Some((Stated { value: em, span: wt.span }, lt))
        }
        _ => None,
    };
    let tensile = curve.map(|(em, lt)| Stated {
        value: [0, 1].map(|i| kes::worn_secant(em.value[i], lt.value[i])),
        span: em.span,
    });
    Ok(Sheet {
        origin: Origin::Kes,
        readings: rows.readings,
        bending,
        tensile,
        shear: shear.map(mean),
        thickness: thickness.map(mean),
        mass: mass.map(mean),
        friction: friction.map(mean),
    })
}

/// The FAST sheet in the block of `phrase`. `stated` is the mass that
/// the fabric itself gives, for bending rigidity from bending length.
pub(super) fn fast_sheet<'t>(
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
    let mut rows = Rows { ev, fields, sheet: Origin::Fast, readings: Vec::new() };
    let share = (Dimension::NUMBER, 1e-5, 5.0);
    let at_5 = rows.read("E5", share.0, 0.0, share.2)?;
    let at_20 = rows.read("E20", share.0, share.1, share.2)?;
    let at_100 = rows.read("E100", share.0, share.1, share.2)?;
    let bias = rows.read("EB5", share.0, share.1, share.2)?;
    let length = rows.read("C", Dimension::LENGTH, 1e-3, 0.5)?;
    let rigidity = rows.read("B", Dimension::BENDING, 1e-9, 0.1)?;
    let shear = rows.read("G", Dimension::TENSION, 0.0, 1e5)?;
    let thickness = rows.read("T2", Dimension::LENGTH, 1e-5, 0.05)?;
    rows.read("T100", Dimension::LENGTH, 0.0, 0.05)?;
    let mass = rows.read("W", Dimension::MASS_PER_AREA, 1e-3, 5.0)?.map(mean);
    // The loads are 5, 20 and 100 gf/cm; 20 is the load of wear, else the nearest that was tested.
    let [load_5, load_20, load_100] = fast::LOADS;
    let secant = |row: Stated<[f64; 2]>, load: f64| Stated {
        value: row.value.map(|strain| fast::secant(strain, load)),
        span: row.span,
    };
    let tensile = at_20
        .map(|row| secant(row, load_20))
        .or(at_100.map(|row| secant(row, load_100)))
        .or(at_5.map(|row| secant(row, load_5)));
    let bending = match (rigidity, length) {
        (Some(rigidity), _) => Some(rigidity),
        (None, Some(length)) => {
            let Some(mass) = mass.map(|mass| mass.value).or(stated) else {
                rows.ev.tell(
                    Diagnostic::new("E0208", "bending length `C` wants the mass `W` beside it")
                        .at(length.span, "here")
                        .help("bending rigidity is mass × gravity × length³"),
                );
                return Err(());
            };
            let value = length.value.map(|c| fast::rigidity(mass, c));
            Some(Stated { value, span: length.span })
        }
        (None, None) => None,
    };
    let shear = shear.map(mean).or(bias.map(|row| {
        let mean = mean(row);
        Stated { value: fast::shear(mean.value), span: mean.span }
    }));
    Ok(Sheet {
        origin: Origin::Fast,
        readings: rows.readings,
        bending,
        tensile,
        shear,
        thickness: thickness.map(mean),
        mass,
        friction: None,
    })
}
