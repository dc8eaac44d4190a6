//! darzi: a garment written down as text, compiled into cloth, sewn, hung on a body and shown.
//!
//! Five verbs, five plain values:
//!
//! ```text
//! text ──parse──▶ Syntax ──evaluate──▶ Garment ──compile──▶ Compiled ──drape──▶ Draped ──render──▶ pictures
//! ```
//!
//! Each verb is a pure function of values that serialise and know nothing of the stage after them.
//! The modules stand in the order of the line; none imports one that stands below it.

// Closed forms in tests may use the plain functions; nothing they give is written to a file.
#![cfg_attr(test, allow(clippy::disallowed_methods, clippy::print_stdout))]

pub mod units;

pub mod progress;

pub mod diagnostic;

pub mod world;

pub mod geometry;

pub mod textile;

pub mod garment;

pub mod syntax;

pub mod evaluate;

pub mod mesh;

pub mod lsp;

pub mod body;

pub mod drape;

pub mod laboratory;

pub mod render;

pub mod export;

pub mod cli;
