//! Drape to files that other programs read: [`obj`] and [`glb`]. Both are written from the
//! particles in the order of `mesh.json`, in metres, y up.

pub mod glb;
pub mod obj;

mod chunk;
mod material;
mod normal;
mod patch;
