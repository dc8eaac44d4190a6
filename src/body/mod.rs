//! Mannequins from measurements: smooth, closed, with named landmarks.

pub mod check;
pub mod distance;
pub mod solid;
pub mod surface;

pub use solid::solid;
