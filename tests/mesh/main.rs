//! Panels and seams as they are compiled.

mod outlines;
mod sewing;
