//! Cloth and bodies to a drape: sewing, contact, gravity, rest.

pub mod draped;
pub mod place;
