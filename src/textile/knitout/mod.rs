//! knitout: programs of knitting machines with two beds of needles, as text.
//!
//! A text of version 2 begins with `;!knitout-2`, says its carriers in a header, and has one
//! operation a line (McCann, *The Knitout File Format*, versions 0.4 and 0.6). [`read`] tells a
//! sound text from a damaged one, [`run`] follows the loops on the needles and tells what no
//! machine could do, [`write()`] gives a text back with its comments.

mod program;
mod read;
mod run;
mod write;

pub use program::{
    Bed, Carrier, Content, Direction, Line, Making, Needle, Operation, Program, Yarn,
};
pub use read::read;
pub use run::{Outcome, Pass, Work, run};
pub use write::write;

#[cfg(test)]
mod tests;
