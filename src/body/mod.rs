//! Mannequins from measurements: smooth, closed, with named landmarks.

mod arm;
pub mod check;
pub mod distance;
mod extract;
mod figure;
mod fit;
mod form;
mod head;
mod landmark;
mod leg;
mod loft;
mod mannequin;
mod measures;
mod part;
pub mod solid;
pub mod surface;
pub mod tape;
mod trunk;

pub use mannequin::mannequin;
pub use solid::solid;
