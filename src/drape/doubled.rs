//! What further cloth along edges adds to the faces it lies under: a hem is not simulated as a layer
//! of its own, but the cloth there is as heavy and as stiff as its plies together, which slide on
//! each other when they are bent.

use crate::mesh::compiled::Compiled;

/// What is added to a face; units as in [`crate::textile::fabric::Fabric`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[allow(missing_docs)]
pub struct More {
    pub mass: f64,
    pub thickness: f64,
    pub bending: [f64; 2],
    pub tensile: [f64; 2],
    pub shear: f64,
}

/// What is added to each face: to the cells, then to the triangles.
pub fn more(compiled: &Compiled) -> Vec<More> {
    let mut list = vec![More::default(); compiled.cells.len() + compiled.triangles.len()];
    for band in &compiled.bands {
        let Some(fabric) = compiled.fabrics.get(band.fabric) else { continue };
        for (&face, share) in band.faces.iter().zip(&band.shares) {
            let Some(more) = list.get_mut(face as usize) else { continue };
            let plies = share * f64::from(band.plies);
            more.mass += plies * fabric.mass;
            more.thickness += plies * fabric.thickness;
            more.shear += plies * fabric.shear.max(0.0);
            for k in 0..2 {
                more.bending[k] += plies * fabric.bending[k].max(0.0);
                more.tensile[k] += plies * fabric.tensile[k].max(0.0);
            }
        }
    }
    list
}
