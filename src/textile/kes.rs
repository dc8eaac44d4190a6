//! The KES-F instruments (Kawabata, The Standardization and Analysis of Hand Evaluation, 1980):
//! what their sheets say in SI units, and what a fabric would show on them.

/// The load at which the tensile test ends, 500 gf/cm, N/m.
pub const LOAD: f64 = 500.0 * GF_PER_CM;

/// One gf/cm, N/m.
pub const GF_PER_CM: f64 = 0.980_665;

/// One gf·cm²/cm, N·m: the unit of B.
pub const BENDING: f64 = 9.806_65e-5;

/// One gf/cm/deg, N/m/rad: the unit of G.
pub const SHEAR: f64 = GF_PER_CM * 180.0 / std::f64::consts::PI;

/// One mg/cm², kg/m²: the unit of W.
pub const MASS: f64 = 0.01;

/// The load at which a tensile curve is made a straight line, 20 gf/cm, N/m: about what a
/// garment's own weight and its wearer's movements put on the cloth, far below the 500 gf/cm at
/// which the test ends.
pub const WORN_LOAD: f64 = 20.0 * GF_PER_CM;

/// Linearity LT from extension EM and tensile energy WT, J/m²: WT = LT · ½ F_m ε_m.
pub fn linearity(extension: f64, energy: f64) -> f64 {
    (2.0 * energy / (LOAD * extension)).clamp(0.05, 1.9)
}

/// Extension EM from linearity LT and tensile energy WT, J/m².
pub fn extension(linearity: f64, energy: f64) -> f64 {
    2.0 * energy / (LOAD * linearity)
}

/// Tension per strain at the load of wear, N/m. The curve is F = F_m (ε/ε_m)ⁿ with ε_m = EM and
/// n = 2/LT − 1, whose energy is the sheet's.
pub fn worn_secant(extension: f64, linearity: f64) -> f64 {
    let power = 2.0 / linearity - 1.0;
    let strain = extension * libm::pow(WORN_LOAD / LOAD, 1.0 / power);
    WORN_LOAD / strain.max(1e-9)
}

/// EM of a cloth whose tension grows by `tensile` per strain, N/m, in a straight line (LT = 1).
pub fn straight_extension(tensile: f64) -> f64 {
    LOAD / tensile
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_straight_curve_has_the_same_stiffness_at_every_load() {
        assert!((worn_secant(0.04, 1.0) / (LOAD / 0.04) - 1.0).abs() < 1e-12);
        assert!((straight_extension(LOAD / 0.04) - 0.04).abs() < 1e-12);
    }

    #[test]
    fn a_crimped_cloth_is_softer_when_worn_than_when_torn() {
        // LT = 2/3: n = 2, so at 1/25 of the load a fifth of the extension is reached.
        let worn = worn_secant(0.04, 2.0 / 3.0);
        assert!((worn - WORN_LOAD / (0.04 / 5.0)).abs() < 1e-6 * worn);
    }

    #[test]
    fn of_extension_linearity_and_energy_any_two_give_the_third() {
        let energy = 0.6 * LOAD * 0.045 / 2.0;
        assert!((linearity(0.045, energy) - 0.6).abs() < 1e-12);
        assert!((extension(0.6, energy) - 0.045).abs() < 1e-12);
    }
}
