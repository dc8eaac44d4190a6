//! Panels and seams as they are compiled.

#![allow(clippy::disallowed_methods, clippy::print_stdout)]

mod atlas;
mod awkward;
mod golden;
mod outlines;
mod seams;
mod sewing;
