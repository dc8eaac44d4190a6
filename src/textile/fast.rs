//! The FAST instruments (De Boos and Tester, SiroFAST: a system for fabric objective measurement,
//! CSIRO WT92.02, 1994): what their sheets say in SI units, and what a fabric would show on them.

use super::kes::GF_PER_CM;
use crate::units::GRAVITY;

/// Loads of the extension test E5, E20 and E100, N/m.
pub const LOADS: [f64; 3] = [5.0 * GF_PER_CM, 20.0 * GF_PER_CM, 100.0 * GF_PER_CM];

/// G = 123 / EB5, with EB5 in percent and G in N/m; here EB5 is a share. A strip cut on the bias
/// that is drawn by F is sheared by F / 4ε.
const BIAS: f64 = 1.23;

/// Bending rigidity B from bending length C, m, and mass per area, kg/m²: B = W g C³ (Peirce 1930),
/// in the units of the sheet 9.81·10⁻⁶ · W g/m² · (C mm)³ µN·m.
pub fn rigidity(mass: f64, length: f64) -> f64 {
    mass * GRAVITY * length * length * length
}

/// Bending length C, m, from bending rigidity, N·m, and mass per area, kg/m².
pub fn bending_length(mass: f64, rigidity: f64) -> f64 {
    libm::cbrt(rigidity / (mass * GRAVITY))
}

/// Shear rigidity G, N/m per radian, from the bias extension EB5, a share.
pub fn shear(bias: f64) -> f64 {
    BIAS / bias
}

/// Bias extension EB5, a share, from the shear rigidity G, N/m per radian.
pub fn bias_extension(shear: f64) -> f64 {
    BIAS / shear
}

/// Tension per strain, N/m, of a cloth that a load draws out by `strain`, a share.
pub fn secant(strain: f64, load: f64) -> f64 {
    load / strain.max(1e-6)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sheets_own_constants_come_out() {
        // 213.8 g/m² of bending length 18.5 mm: 9.81e-6 · 213.8 · 18.5³ = 13.28 µN·m.
        let rigid = rigidity(0.2138, 0.0185);
        assert!((rigid * 1e6 / (9.81e-6 * 213.8 * 18.5f64.powi(3)) - 1.0).abs() < 1e-3);
        assert!((bending_length(0.2138, rigid) - 0.0185).abs() < 1e-12);
        // EB5 = 4.1 %: G = 123 / 4.1 = 30 N/m.
        assert!((shear(0.041) - 30.0).abs() < 1e-9);
        assert!((bias_extension(30.0) - 0.041).abs() < 1e-12);
    }
}
