//! Yarns as bodies: the threads and loops of a fabric, met by rays one by one.
//!
//! The yarns of one tile are held once for a fabric ([`bodies`]). Cloth that is near stands in the
//! studio as a shell: its middle face, moved outwards and inwards by the height of its yarns. A
//! ray that enters the shell is followed through the tile, repeated without end, in the
//! directions of warp, weft and normal as they are there ([`shell`]), so that every thread goes
//! where the drape took its cell. What it meets is shaded by the twist and the fibres of the yarn
//! ([`skin`]).

mod bodies;
mod shell;
mod skin;

pub use bodies::Bodies;
pub use shell::{Course, Met};
pub use skin::Surface;
