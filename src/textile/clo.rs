//! The units in which CLO and Marvelous Designer give a fabric: forces counted in g·mm/s².

/// One g/s², N/m: the unit of stretch and shear.
pub const STRETCH: f64 = 1e-3;

/// One g·mm²/s², N·m: the unit of bending.
pub const BENDING: f64 = 1e-9;
