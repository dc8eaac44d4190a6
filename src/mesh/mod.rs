//! Garment to cloth: [`compile`] cuts every panel into a regular grid of particles aligned with
//! warp and weft, a triangulated band along its edges, matched seams, and the texture atlas.

pub mod compiled;

pub mod atlas;
