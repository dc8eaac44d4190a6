//! Mannequins from measurements: smooth, closed, with named landmarks.

pub mod check;
pub mod distance;
mod extract;
mod figure;
mod fit;
mod form;
mod landmark;
mod loft;
mod mannequin;
mod measures;
pub mod solid;
pub mod surface;
pub mod tape;

pub use mannequin::mannequin;
pub use solid::solid;
