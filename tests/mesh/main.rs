//! Panels and seams as they are compiled.

mod awkward;
mod golden;
mod outlines;
mod seams;
mod sewing;
