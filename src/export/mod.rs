//! Drape to files that other programs read.
