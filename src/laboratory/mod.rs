//! The tests of a textile laboratory, done with the workshop itself: a specimen is cut, mounted and
//! hung, and what an operator would read off is read off.
//!
//! A test knows the fabric only by what hangs there, so that its figures are a check of the cloth
//! as it is worked out: what comes back must be what the fabric was given.

pub mod cantilever;
pub mod cusick;
mod specimen;

pub use specimen::{Failure, Hung};
