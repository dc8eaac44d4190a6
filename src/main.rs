//! The `darzi` program.

fn main() {}
