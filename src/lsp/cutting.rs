//! What is wrong with the cloth of a document. Cutting may take longer than working it out, so
//! it waits for a pause in writing, and is given up when the writer goes on.

use crate::diagnostic::Diagnostic;
use crate::garment::Garment;
use crate::mesh;

/// What is said when garments are cut; none if that was given up, which `goes_on` is asked before
/// each of them.
pub fn mistakes(garments: &[Garment], goes_on: impl Fn() -> bool) -> Option<Vec<Diagnostic>> {
    let mut told = Vec::new();
    for garment in garments {
        if goes_on() {
            return None;
        }
        told.extend(mesh::examine(garment).err().into_iter().flatten());
    }
    Some(told)
}
