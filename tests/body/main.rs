//! Mannequins, from outside.

#![allow(clippy::disallowed_methods, clippy::print_stdout)]

mod figure;
mod preview;
