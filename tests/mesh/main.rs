//! Panels and seams as they are compiled.

mod awkward;
mod outlines;
mod seams;
mod sewing;
