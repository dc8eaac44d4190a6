//! From text to garment: what is read, what is worked out, and what is said of mistakes.

#![allow(clippy::disallowed_methods, clippy::print_stdout)]

mod blocks;
mod errors;
mod finishing;
mod garments;
mod library;
mod marks;
mod operations;
mod parts;
mod patches;
mod records;
mod tour;
