//! What is wrong with the cloth of a document. Cutting takes longer than working it out, so it
//! waits for a pause in writing, and is given up when the writer goes on.

use crate::diagnostic::Diagnostic;
use crate::garment::Garment;
use crate::mesh::limit::{MOST_PARTICLES, estimate};
use crate::mesh::{self, Options};

/// Particles that a garment is cut into at most; it is cut coarser than it asks for where that
/// would be more.
const PARTICLES: f64 = 1e5;

/// What is said when garments are cut; none if that was given up, which `goes_on` is asked before
/// each of them.
pub fn mistakes(garments: &[Garment], goes_on: impl Fn() -> bool) -> Option<Vec<Diagnostic>> {
    let mut told = Vec::new();
    for garment in garments {
        if goes_on() {
            return None;
        }
        let many = estimate(garment);
        // Far too many are told of at once.
        let coarsen = if many > MOST_PARTICLES { 1.0 } else { (many / PARTICLES).sqrt().max(1.0) };
        let cut = |coarsen: f64| {
            mesh::compile(garment, &Options { coarsen, atlas: false, ..Options::default() }).err()
        };
        let mut found = cut(coarsen);
        // It may have been the coarse cells that did not fit.
        if found.is_some() && coarsen > 1.0 {
            found = cut(1.0);
        }
        told.extend(found.into_iter().flatten());
    }
    Some(told)
}
