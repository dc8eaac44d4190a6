//! Outlines of all kinds become exact cells and well shaped triangles.

use crate::sewing::{cases, circle, garment, panel, polygon, rectangle};
use darzi::garment::panel::{Loop, Panel};
use darzi::mesh::compiled::Compiled;
use darzi::mesh::validate::{Facts, validate};
use darzi::mesh::{Options, compile};
use proptest::prelude::*;

fn compiled(panel: Panel) -> (Compiled, Facts) {
    let compiled = compile(&garment(vec![panel], Vec::new()), &Options::default())
        .unwrap_or_else(|said| panic!("{said:?}"));
    let facts = validate(&compiled).unwrap_or_else(|flaws| panic!("{flaws:?}"));
    (compiled, facts[0])
}

#[test]
fn a_square_of_whole_cells_has_no_band() {
    let (mesh, facts) = compiled(panel("cloth", vec![rectangle(1.0, 1.0)], 1.0 / 128.0));
    assert_eq!(mesh.particles.len(), 129 * 129);
    assert_eq!(mesh.cells.len(), 128 * 128);
    assert_eq!(mesh.triangles.len(), 0);
    assert!((facts.area - 1.0).abs() < 1e-12);
    assert_eq!(mesh.panels[0].edges[0].points.len(), 129);
    assert_eq!(mesh.panels[0].edges[0].points[..3], [0, 1, 2]);
}

#[test]
fn a_rectangle_takes_the_nearest_cell_that_fits() {
    // 50 cm and 30 cm are both whole multiples of 10 cm / 13, and 3.8 % from 8 mm.
    let (mesh, _) = compiled(panel("cloth", vec![rectangle(0.5, 0.3)], 8e-3));
    assert_eq!((mesh.cells.len(), mesh.triangles.len()), (65 * 39, 0));
    assert!((mesh.panels[0].cell - 0.1 / 13.0).abs() < 1e-15);
}

#[test]
fn a_disc_with_a_hole_is_a_ring() {
    let loops = vec![circle([0.0, 0.0], 0.2, true), circle([0.01, 0.0], 0.07, false)];
    let (mesh, facts) = compiled(panel("ring", loops, 5e-3));
    assert!(facts.smallest_angle >= 20.0, "{facts:?}");
    for (ring, (centre, radius)) in mesh.panels[0].loops.iter().zip([(0.0, 0.2), (0.01, 0.07)]) {
        for &k in ring {
            let [u, v] = mesh.particles[k as usize];
            // Four cubic arcs keep within 1e-7 of a circle.
            assert!(((u - centre).hypot(v) - radius).abs() < 2e-7);
        }
    }
}

fn turned(mut panel: Panel, grain: f64) -> Panel {
    panel.grain = grain;
    panel
}

/// A star: radii by equal angles about the origin.
fn star(radii: &[f64]) -> Loop {
    let step = std::f64::consts::TAU / radii.len() as f64;
    let corners: Vec<[f64; 2]> = radii
        .iter()
        .enumerate()
        .map(|(k, r)| [r * (k as f64 * step).cos(), r * (k as f64 * step).sin()])
        .collect();
    polygon(&corners)
}

fn check(panel: Panel) -> Result<(), TestCaseError> {
    let compiled = compile(&garment(vec![panel], Vec::new()), &Options::default())
        .map_err(|said| TestCaseError::fail(format!("{said:?}")))?;
    let facts = validate(&compiled).map_err(|flaws| TestCaseError::fail(format!("{flaws:?}")))?[0];
    prop_assert_eq!(facts.sharp, 0, "{:?}", facts);
    Ok(())
}

proptest! {
    #![proptest_config(cases(200))]

    #[test]
    fn rectangles_at_any_grain(w in 0.02..0.4f64, h in 0.02..0.4f64, grain in -1.6..1.6f64) {
        check(turned(panel("r", vec![rectangle(w, h)], 8e-3), grain))?;
    }

    #[test]
    fn stars(radii in prop::collection::vec(0.08..0.3f64, 5..9), grain in -1.6..1.6f64) {
        check(turned(panel("s", vec![star(&radii)], 8e-3), grain))?;
    }

    #[test]
    fn discs_with_holes(r in 0.1..0.3f64, q in 0.2..0.85f64, x in -0.1..0.1f64) {
        let hole = circle([x * r, 0.02 * r], q * r, false);
        check(panel("d", vec![circle([0.0, 0.0], r, true), hole], 8e-3))?;
    }

    #[test]
    fn bent_shapes(w in 0.05..0.3f64, h in 0.05..0.3f64, a in 0.2..0.8f64, b in 0.2..0.8f64, grain in -1.6..1.6f64) {
        let corners = [[0.0, 0.0], [w, 0.0], [w, h], [a * w, h], [a * w, b * h], [0.0, b * h]];
        check(turned(panel("l", vec![polygon(&corners)], 8e-3), grain))?;
    }
}
