//! Mannequins from measurements: smooth, closed, with named landmarks.

pub mod surface;
