//! A wearer as a closed surface.

use super::check;
use super::extract::extract;
use super::fit::fit;
use super::landmark::landmarks;
use super::measures::{Measures, cm};
use super::surface::{Surface, SurfaceKind};
use crate::diagnostic::Diagnostic;
use crate::garment::scene::BodyRequest;
use std::collections::BTreeMap;

/// Cells of the extraction grid up the height of a body.
const FINENESS: f64 = 155.0;

/// Makes a full-length mannequin whose girths are the asked ones within 3 mm.
///
/// It stands on y = 0, faces +z, holds its arms away from its sides; closed, one piece, with
/// landmarks and the part that each vertex belongs to. Measures that are not given follow from
/// the others (see the tables in `measures`).
///
/// # Errors
/// E0308: a measure that no body has. E0309: measures that do not go together.
pub fn mannequin(request: &BodyRequest) -> Result<Surface, Vec<Diagnostic>> {
    let measures = Measures::new(request)?;
    let form = fit(request, &measures)?;
    let cell = form.height / FINENESS;
    for shift in [0.0, 0.37, 0.71, 0.19] {
        let mesh = extract(
            form.bounds(),
            cell,
            |k, at| form.step(k, at) * cell,
            shift,
            |p| form.value(p),
            |p| form.slope(p),
        );
        let mut surface = Surface {
            name: request.name.clone(),
            parts: mesh.vertices.iter().map(|p| form.part(*p)).collect(),
            vertices: mesh.vertices,
            normals: mesh.normals,
            triangles: mesh.triangles,
            landmarks: BTreeMap::new(),
            kind: SurfaceKind::Body,
            friction: None,
        };
        if check::defects(&surface).is_empty() && check::euler(&surface) == 2 {
            surface.landmarks = landmarks(request.figure, &form, &surface);
            return Ok(surface);
        }
    }
    let message =
        format!("`{}` has measures that leave no room between arms, legs and trunk", request.name);
    let help = format!(
        "smaller `thigh` (now {}) or `upper_arm` (now {}) keep them apart",
        cm(measures.get("thigh")),
        cm(measures.get("upper_arm"))
    );
    Err(vec![Diagnostic::new("E0309", message).at(request.span, "this wearer").help(help)])
}
