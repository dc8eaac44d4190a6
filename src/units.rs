//! Quantities with dimensions. Inside darzi every number is in SI units (metre, kilogram,
//! second, radian); units exist only in texts and messages.

use serde::{Deserialize, Serialize};
use std::fmt;

/// Exponents of length, mass, time and angle. Angle is a dimension of its own, so that a
/// stiffness per degree is not mistaken for one per radian.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize,
)]
pub struct Dimension {
    /// Exponent of the metre.
    pub length: i8,
    /// Exponent of the kilogram.
    pub mass: i8,
    /// Exponent of the second.
    pub time: i8,
    /// Exponent of the radian.
    pub angle: i8,
}

impl Dimension {
    const fn of(length: i8, mass: i8, time: i8, angle: i8) -> Self {
        Dimension { length, mass, time, angle }
    }
    /// Pure numbers and shares.
    pub const NUMBER: Self = Self::of(0, 0, 0, 0);
    /// m
    pub const LENGTH: Self = Self::of(1, 0, 0, 0);
    /// m²
    pub const AREA: Self = Self::of(2, 0, 0, 0);
    /// rad
    pub const ANGLE: Self = Self::of(0, 0, 0, 1);
    /// s
    pub const TIME: Self = Self::of(0, 0, 1, 0);
    /// 1/s: frames per second, drag
    pub const RATE: Self = Self::of(0, 0, -1, 0);
    /// m/s
    pub const SPEED: Self = Self::of(1, 0, -1, 0);
    /// m/s²
    pub const ACCELERATION: Self = Self::of(1, 0, -2, 0);
    /// kg
    pub const MASS: Self = Self::of(0, 1, 0, 0);
    /// kg/m²: mass of a cloth
    pub const MASS_PER_AREA: Self = Self::of(-2, 1, 0, 0);
    /// kg/m: count of a yarn
    pub const COUNT: Self = Self::of(-1, 1, 0, 0);
    /// 1/m: threads, stitches or turns per length
    pub const PER_LENGTH: Self = Self::of(-1, 0, 0, 0);
    /// rad/m: twist said in `turns/m`
    pub const ANGLE_PER_LENGTH: Self = Self::of(-1, 0, 0, 1);
    /// N: a force, and the hysteresis of bending
    pub const FORCE: Self = Self::of(1, 1, -2, 0);
    /// N/m: tension of a cloth, energy per area
    pub const TENSION: Self = Self::of(0, 1, -2, 0);
    /// Pa
    pub const PRESSURE: Self = Self::of(-1, 1, -2, 0);
    /// N·m: bending rigidity of a cloth
    pub const BENDING: Self = Self::of(2, 1, -2, 0);
    /// N/m/rad: shear stiffness of a cloth
    pub const SHEAR: Self = Self::of(0, 1, -2, -1);

    /// Dimension of a product.
    #[must_use]
    pub fn times(self, other: Self) -> Self {
        Self::of(
            self.length.saturating_add(other.length),
            self.mass.saturating_add(other.mass),
            self.time.saturating_add(other.time),
            self.angle.saturating_add(other.angle),
        )
    }

    /// Dimension of a quotient.
    #[must_use]
    pub fn over(self, other: Self) -> Self {
        Self::of(
            self.length.saturating_sub(other.length),
            self.mass.saturating_sub(other.mass),
            self.time.saturating_sub(other.time),
            self.angle.saturating_sub(other.angle),
        )
    }

    /// Dimension of a square root, where there is one.
    pub fn root(self) -> Option<Self> {
        let even = |n: i8| n % 2 == 0;
        (even(self.length) && even(self.mass) && even(self.time) && even(self.angle))
            .then(|| Self::of(self.length / 2, self.mass / 2, self.time / 2, self.angle / 2))
    }

    /// Whether it is a pure number.
    pub fn is_number(self) -> bool {
        self == Self::NUMBER
    }

    /// What a tailor calls it: `a length`, `a bending rigidity`.
    pub fn name(self) -> &'static str {
        NAMES.iter().find(|row| row.0 == self).map_or("a compound quantity", |row| row.1)
    }

    /// Quantities of this dimension as they may be typed: `12cm`.
    pub fn example(self) -> &'static str {
        NAMES.iter().find(|row| row.0 == self).map_or("", |row| row.2)
    }
}

/// Dimensions that have a name, with examples to type.
const NAMES: &[(Dimension, &str, &str)] = &[
    (Dimension::NUMBER, "a number", "`0.3` or `30%`"),
    (Dimension::LENGTH, "a length", "`12cm`, `3mm`, `3/8in`"),
    (Dimension::AREA, "an area", "`20cm2`"),
    (Dimension::ANGLE, "an angle", "`30deg`"),
    (Dimension::TIME, "a time", "`2s`"),
    (Dimension::RATE, "a rate", "`60fps`, `0.5/s`"),
    (Dimension::SPEED, "a speed", "`2mm/s`"),
    (Dimension::ACCELERATION, "an acceleration", "`9.80665m/s2`"),
    (Dimension::MASS, "a mass", "`20g`"),
    (Dimension::MASS_PER_AREA, "a mass per area", "`120g/m2`"),
    (Dimension::COUNT, "a yarn count", "`30Ne`, `20tex`, `150denier`"),
    (Dimension::PER_LENGTH, "a number per length", "`24/cm`, `600/m`"),
    (Dimension::ANGLE_PER_LENGTH, "a twist", "`600turns/m`"),
    (Dimension::FORCE, "a force", "`0.01N`, `0.05gf.cm/cm`"),
    (Dimension::TENSION, "a tension per width", "`500N/m`, `12gf/cm`"),
    (Dimension::PRESSURE, "a pressure", "`2kPa`"),
    (Dimension::BENDING, "a bending rigidity", "`1.3e-5N.m`, `0.1gf.cm2/cm`"),
    (Dimension::SHEAR, "a shear stiffness", "`0.5gf/cm/deg`, `30N/m/rad`"),
];

/// A number with its dimension, in SI units.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Quantity {
    /// In SI units.
    pub value: f64,
    /// Its dimension.
    pub dimension: Dimension,
}

impl Quantity {
    /// A quantity of `value` SI units.
    pub fn new(value: f64, dimension: Dimension) -> Self {
        Quantity { value, dimension }
    }

    /// A pure number.
    pub fn number(value: f64) -> Self {
        Quantity { value, dimension: Dimension::NUMBER }
    }

    /// A length in metres.
    pub fn length(value: f64) -> Self {
        Quantity { value, dimension: Dimension::LENGTH }
    }

    /// Whether it can stand where `dimension` is wanted; a bare 0 can stand anywhere.
    pub fn fits(self, dimension: Dimension) -> bool {
        self.dimension == dimension || (self.dimension.is_number() && self.value == 0.0)
    }
}

impl fmt::Display for Quantity {
    /// As a tailor reads it: lengths in mm, cm or m, angles in degrees.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let shown: (f64, &str) = match self.dimension {
            Dimension::NUMBER => (self.value, ""),
            Dimension::LENGTH => return f.write_str(&length(self.value)),
            Dimension::ANGLE => return f.write_str(&angle(self.value)),
            Dimension::AREA => (self.value * 1e4, " cm²"),
            Dimension::TIME => (self.value, " s"),
            Dimension::RATE => (self.value, " /s"),
            Dimension::SPEED if self.value.abs() < 0.1 => (self.value * 1e3, " mm/s"),
            Dimension::SPEED => (self.value, " m/s"),
            Dimension::ACCELERATION => (self.value, " m/s²"),
            Dimension::MASS => (self.value * 1e3, " g"),
            Dimension::MASS_PER_AREA => (self.value * 1e3, " g/m²"),
            Dimension::COUNT => (self.value * 1e6, " tex"),
            Dimension::PER_LENGTH => (self.value * 1e-2, " /cm"),
            Dimension::FORCE => (self.value, " N"),
            Dimension::TENSION => (self.value, " N/m"),
            Dimension::BENDING => (self.value * 1e6, " µN·m"),
            Dimension::SHEAR => (self.value, " N/m/rad"),
            other => {
                let mut text = trimmed(self.value, 6);
                for (unit, power) in [
                    ("m", other.length),
                    ("kg", other.mass),
                    ("s", other.time),
                    ("rad", other.angle),
                ] {
                    match power {
                        0 => {}
                        1 => text.push_str(&format!(" {unit}")),
                        n => text.push_str(&format!(" {unit}^{n}")),
                    }
                }
                return f.write_str(&text);
            }
        };
        write!(f, "{}{}", trimmed(shown.0, 4), shown.1)
    }
}

/// A length, m, as a tailor reads it: `8.4 mm`, `59.41 cm`, `5.5 m`.
pub fn length(metres: f64) -> String {
    let size = metres.abs();
    if size == 0.0 {
        "0 cm".to_owned()
    } else if size < 0.00995 {
        format!("{} mm", trimmed(metres * 1e3, 2))
    } else if size < 1.99995 {
        format!("{} cm", trimmed(metres * 1e2, 2))
    } else {
        format!("{} m", trimmed(metres, 3))
    }
}

/// An angle, rad, in degrees: `8°`.
pub fn angle(radians: f64) -> String {
    format!("{}°", trimmed(radians.to_degrees(), 2))
}

/// A number with at most `places` decimals and no idle zeros.
pub fn trimmed(value: f64, places: usize) -> String {
    if value != 0.0 && (value.abs() >= 1e12 || value.abs() < 0.5 * 10f64.powi(-(places as i32))) {
        return format!("{value:e}");
    }
    let text = format!("{value:.places$}");
    let text = if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.')
    } else {
        text.as_str()
    };
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// A unit as written against a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    /// SI units in one of it.
    pub scale: f64,
    /// Its dimension.
    pub dimension: Dimension,
    /// Whether the SI value is `scale / number`: yarn counts in length per mass (`Ne`, `Nm`).
    pub reciprocal: bool,
}

impl Unit {
    /// `number` of this unit as a quantity; none when it has no finite value (`0Ne`).
    pub fn quantity(self, number: f64) -> Option<Quantity> {
        let value = if self.reciprocal { self.scale / number } else { number * self.scale };
        value.is_finite().then(|| Quantity::new(value, self.dimension))
    }
}

/// kg per pound.
const POUND: f64 = 0.453_592_37;
/// m per inch.
const INCH: f64 = 0.0254;
/// Standard gravity, m/s², which makes a mass a force in `gf`, `kgf`, `lbf`.
pub const GRAVITY: f64 = 9.80665;

/// Single units: name, SI units in one of it, dimension, whether reciprocal.
const UNITS: &[(&str, f64, Dimension, bool)] = &[
    ("um", 1e-6, Dimension::LENGTH, false),
    ("mm", 1e-3, Dimension::LENGTH, false),
    ("cm", 1e-2, Dimension::LENGTH, false),
    ("m", 1.0, Dimension::LENGTH, false),
    ("km", 1e3, Dimension::LENGTH, false),
    ("in", INCH, Dimension::LENGTH, false),
    ("ft", 12.0 * INCH, Dimension::LENGTH, false),
    ("yd", 36.0 * INCH, Dimension::LENGTH, false),
    ("deg", std::f64::consts::PI / 180.0, Dimension::ANGLE, false),
    ("rad", 1.0, Dimension::ANGLE, false),
    ("turn", std::f64::consts::TAU, Dimension::ANGLE, false),
    ("turns", std::f64::consts::TAU, Dimension::ANGLE, false),
    ("ms", 1e-3, Dimension::TIME, false),
    ("s", 1.0, Dimension::TIME, false),
    ("min", 60.0, Dimension::TIME, false),
    ("h", 3600.0, Dimension::TIME, false),
    ("Hz", 1.0, Dimension::RATE, false),
    ("fps", 1.0, Dimension::RATE, false),
    ("mg", 1e-6, Dimension::MASS, false),
    ("g", 1e-3, Dimension::MASS, false),
    ("kg", 1.0, Dimension::MASS, false),
    ("oz", POUND / 16.0, Dimension::MASS, false),
    ("lb", POUND, Dimension::MASS, false),
    ("gsm", 1e-3, Dimension::MASS_PER_AREA, false),
    ("uN", 1e-6, Dimension::FORCE, false),
    ("mN", 1e-3, Dimension::FORCE, false),
    ("cN", 1e-2, Dimension::FORCE, false),
    ("N", 1.0, Dimension::FORCE, false),
    ("kN", 1e3, Dimension::FORCE, false),
    ("gf", 1e-3 * GRAVITY, Dimension::FORCE, false),
    ("kgf", GRAVITY, Dimension::FORCE, false),
    ("dyn", 1e-5, Dimension::FORCE, false),
    ("lbf", POUND * GRAVITY, Dimension::FORCE, false),
    ("Pa", 1.0, Dimension::PRESSURE, false),
    ("kPa", 1e3, Dimension::PRESSURE, false),
    ("MPa", 1e6, Dimension::PRESSURE, false),
    ("J", 1.0, Dimension::BENDING, false),
    ("tex", 1e-6, Dimension::COUNT, false),
    ("dtex", 1e-7, Dimension::COUNT, false),
    ("ktex", 1e-3, Dimension::COUNT, false),
    ("denier", 1e-3 / 9000.0, Dimension::COUNT, false),
    // English cotton count: hanks of 840 yd in a pound. Metric count: metres in a gram.
    ("Ne", POUND / (840.0 * 36.0 * INCH), Dimension::COUNT, true),
    ("Nm", 1e-3, Dimension::COUNT, true),
];

/// Reads a unit: `cm`, `%`, `gf.cm2/cm`, `/m`, `N/m/rad`.
///
/// # Errors
/// The part of the text that is no unit.
pub fn unit(text: &str) -> Result<Unit, String> {
    if text == "%" {
        return Ok(Unit { scale: 0.01, dimension: Dimension::NUMBER, reciprocal: false });
    }
    let mut whole = Unit { scale: 1.0, dimension: Dimension::NUMBER, reciprocal: false };
    let mut rest = text;
    let mut divide = false;
    let mut atoms = 0;
    if let Some(after) = rest.strip_prefix('/') {
        divide = true;
        rest = after;
    }
    loop {
        let end = rest.find(['.', '/']).unwrap_or(rest.len());
        let (atom, after) = rest.split_at(end);
        let part = single(atom).ok_or_else(|| atom.to_owned())?;
        atoms += 1;
        if part.reciprocal {
            if text != atom {
                return Err(text.to_owned());
            }
            return Ok(part);
        }
        if divide {
            whole.scale /= part.scale;
            whole.dimension = whole.dimension.over(part.dimension);
        } else {
            whole.scale *= part.scale;
            whole.dimension = whole.dimension.times(part.dimension);
        }
        if !whole.scale.is_finite() || whole.scale == 0.0 || atoms > 8 {
            return Err(text.to_owned());
        }
        match after.chars().next() {
            None => return Ok(whole),
            Some(mark) => {
                divide = mark == '/';
                rest = after.get(1..).unwrap_or("");
            }
        }
    }
}

/// One unit with its exponent: `cm2`.
fn single(atom: &str) -> Option<Unit> {
    let letters = atom.trim_end_matches(|c: char| c.is_ascii_digit());
    let digits = atom.get(letters.len()..).unwrap_or("");
    let power: i32 = if digits.is_empty() { 1 } else { digits.parse().ok()? };
    if !(1..=8).contains(&power) {
        return None;
    }
    let plain = letters.replace(['\u{b5}', '\u{3bc}'], "u");
    let &(_, scale, dimension, reciprocal) = UNITS.iter().find(|row| row.0 == plain)?;
    if reciprocal && power != 1 {
        return None;
    }
    let mut whole = Unit { scale: 1.0, dimension: Dimension::NUMBER, reciprocal };
    for _ in 0..power {
        whole.scale *= scale;
        whole.dimension = whole.dimension.times(dimension);
    }
    Some(whole)
}

/// All single units, for suggestions.
pub fn known() -> impl Iterator<Item = &'static str> {
    UNITS.iter().map(|row| row.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn si(number: f64, text: &str) -> f64 {
        unit(text).ok().and_then(|unit| unit.quantity(number)).map_or(f64::NAN, |q| q.value)
    }

    #[test]
    fn units_of_the_sheet_become_si() {
        let near = |a: f64, b: f64| assert!((a - b).abs() <= 1e-12 * b.abs(), "{a} is not {b}");
        near(si(1.0, "gf.cm2/cm"), 9.80665e-5); // 1 gf·cm²/cm = 0.980665e-4 N·m²/m
        near(si(1.0, "gf/cm/deg"), 0.980665 * 180.0 / std::f64::consts::PI);
        near(si(120.0, "g/m2"), 0.12);
        near(si(600.0, "/m"), 600.0);
        // Tables give tex · Ne = 590.54, rounded; 1 Ne is 840 yd (768.096 m) a pound.
        near(si(30.0, "Ne"), 0.453_592_37 / 768.096 / 30.0);
        assert!((si(30.0, "Ne") * 1e6 * 30.0 - 590.54).abs() < 0.005);
        near(si(40.0, "Nm"), 25e-6);
        near(si(150.0, "denier"), 150.0 / 9e6);
        near(si(1.0, "\u{b5}N.m"), 1e-6);
        near(si(50.0, "%"), 0.5);
    }

    #[test]
    fn a_newton_metre_is_no_metric_count() {
        assert_eq!(unit("N.m").map(|u| u.dimension), Ok(Dimension::BENDING));
        assert_eq!(unit("Nm").map(|u| u.dimension), Ok(Dimension::COUNT));
        assert_eq!(unit("N.m2/m").map(|u| u.dimension), Ok(Dimension::BENDING));
        assert_eq!(unit("gf.cm/cm").map(|u| u.dimension), Ok(Dimension::FORCE));
        assert_eq!(unit("cmm"), Err("cmm".to_owned()));
        assert_eq!(unit("m9999"), Err("m9999".to_owned()));
    }

    #[test]
    fn lengths_read_as_on_a_tape() {
        assert_eq!(length(0.0084), "8.4 mm");
        assert_eq!(length(0.5941), "59.41 cm");
        assert_eq!(length(5.5), "5.5 m");
        assert_eq!(length(-0.01), "-1 cm");
        assert_eq!(length(0.0), "0 cm");
        assert_eq!(Quantity::new(2e-3, Dimension::SPEED).to_string(), "2 mm/s");
    }

    proptest! {
        /// Exponents add in products and cancel in quotients, whatever the units.
        #[test]
        fn dimensions_follow_the_algebra(a in 0..UNITS.len(), b in 0..UNITS.len()) {
            let (a, b) = (UNITS[a], UNITS[b]);
            prop_assume!(!a.3 && !b.3);
            let product = unit(&format!("{}.{}", a.0, b.0)).unwrap();
            prop_assert_eq!(product.dimension, a.2.times(b.2));
            prop_assert!((product.scale / (a.1 * b.1) - 1.0).abs() < 1e-12);
            let quotient = unit(&format!("{}.{}/{}", a.0, b.0, b.0)).unwrap();
            prop_assert_eq!(quotient.dimension, a.2);
            prop_assert!((quotient.scale / a.1 - 1.0).abs() < 1e-12);
        }

        /// No text makes the reader of units fail in any other way than by saying so.
        #[test]
        fn any_text_is_a_unit_or_is_not(text in ".{0,12}") {
            let _ = unit(&text);
        }
    }
}
