//! Panels that nobody should draw end in cloth or in a message, never in a panic.

use crate::sewing::{cases, circle, curve, garment, line, panel, polygon};
use darzi::garment::panel::{Loop, Panel};
use darzi::mesh::validate::validate;
use darzi::mesh::{Options, compile, examine};
use proptest::prelude::*;

/// Compiles and, if that succeeds, checks; gives the number of needlessly sharp triangles. What
/// compiling refuses is also found without cutting.
fn survives(panel: Panel) -> Result<usize, TestCaseError> {
    let garment = garment(vec![panel], Vec::new());
    let cut = compile(&garment, &Options::default());
    prop_assert_eq!(examine(&garment).err(), cut.as_ref().err().cloned());
    match cut {
        Err(said) => {
            prop_assert!(said.iter().all(|one| one.code.starts_with('E')), "{said:?}");
            Ok(0)
        }
        Ok(mesh) => {
            let facts =
                validate(&mesh).map_err(|flaws| TestCaseError::fail(format!("{flaws:?}")))?;
            Ok(facts[0].sharp)
        }
    }
}

fn shallow(code: &str, panel: Panel) {
    let said = compile(&garment(vec![panel], Vec::new()), &Options::default());
    assert_eq!(said.expect_err("a message")[0].code, code);
}

#[test]
fn limits_are_told() {
    shallow("E0811", panel("wide", vec![polygon(&[[0.0, 0.0], [9.0, 0.0], [9.0, 9.0]])], 1e-3));
    shallow("E0812", panel("small", vec![circle([0.0, 0.0], 1e-3, true)], 8e-3));
    shallow("E0813", panel("flat", vec![polygon(&[[0.0, 0.0], [1.0, 0.0], [0.5, 0.0]])], 8e-3));
    shallow("E0813", panel("nothing", vec![polygon(&[[0.2, 0.2]])], 8e-3));
    let bow = polygon(&[[0.0, 0.0], [0.3, 0.25], [0.3, 0.0], [0.0, 0.2]]);
    shallow("E0813", panel("bow", vec![bow], 8e-3));
    shallow("E0813", panel("nan", vec![polygon(&[[0.0, 0.0], [f64::NAN, 0.0], [0.5, 1.0]])], 8e-3));
    let touching = circle([0.05, 0.0], 0.05, false);
    shallow("E0813", panel("crescent", vec![circle([0.0, 0.0], 0.1, true), touching], 8e-3));
}

proptest! {
    #![proptest_config(cases(100))]

    #[test]
    fn any_curves(points in prop::collection::vec((-0.2..0.2f64, -0.2..0.2f64), 9), grain in -4.0..4.0f64) {
        let at = |k: usize| [points[k % 9].0, points[k % 9].1];
        let pieces = (0..3).map(|k| curve(at(3 * k), at(3 * k + 1), at(3 * k + 2), at(3 * k + 3)));
        let mut ring = Loop { pieces: pieces.collect() };
        let area: f64 = darzi::mesh::limit::area(&ring);
        if area < 0.0 {
            let pieces = (0..3).rev().map(|k| {
                curve(at(3 * k + 3), at(3 * k + 2), at(3 * k + 1), at(3 * k))
            });
            ring = Loop { pieces: pieces.collect() };
        }
        let mut any = panel("any", vec![ring], 8e-3);
        any.grain = grain;
        survives(any)?;
    }

    /// Short pieces between long ones: down to fractions of a cell and of a micrometre.
    #[test]
    fn short_pieces(power in 2.0..8.0f64, at in 0.2..0.8f64, turn in -1.2..1.2f64, grain in -1.6..1.6f64) {
        let short = 10.0f64.powf(-power);
        let (x, y) = (0.2 * at, 0.15);
        let step = [x - short * turn.cos(), y + short * turn.sin()];
        let corners = [[0.0, 0.0], [0.2, 0.0], [0.2, y], [x, y], step, [0.0, y]];
        let mut jog = panel("jog", vec![polygon(&corners)], 8e-3);
        jog.grain = grain;
        let sharp = survives(jog)?;
        prop_assert!(sharp == 0, "{sharp} sharp triangles");
    }

    #[test]
    fn narrow_strips(width in 1e-3..2e-2f64, length in 0.05..0.5f64, grain in -1.6..1.6f64) {
        let corners = [[0.0, 0.0], [length, 0.0], [length, width], [0.0, width]];
        let mut strip = panel("strip", vec![polygon(&corners)], 8e-3);
        strip.grain = grain;
        let sharp = survives(strip)?;
        prop_assert!(sharp == 0, "{sharp} sharp triangles");
    }

    #[test]
    fn sharp_corners(rise in 0.005..0.2f64, grain in -1.6..1.6f64) {
        let mut wedge = panel("wedge", vec![polygon(&[[0.0, 0.0], [0.3, 0.0], [0.3, rise]])], 8e-3);
        wedge.grain = grain;
        let sharp = survives(wedge)?;
        prop_assert!(sharp == 0, "{sharp} sharp triangles");
    }

    #[test]
    fn holes_near_the_edge(gap in -8.0..-1.5f64, radius in 0.005..0.05f64) {
        let gap = 10.0f64.powf(gap);
        let hole = circle([0.1 - radius - gap, 0.0], radius, false);
        let holed = panel("holed", vec![circle([0.0, 0.0], 0.1, true), hole], 8e-3);
        let sharp = survives(holed)?;
        // A neck of less than a millimetre is as sharp as it is drawn.
        prop_assert!(sharp == 0 || gap < 1e-3, "{sharp} sharp triangles");
    }

    /// A curve whose handles cross or coincide with its ends.
    #[test]
    fn cusps(a in -0.3..0.3f64, b in -0.3..0.3f64, lift in 0.0..0.2f64) {
        let ring = Loop {
            pieces: vec![
                line([0.0, 0.0], [0.2, 0.0]),
                line([0.2, 0.0], [0.2, 0.1]),
                curve([0.2, 0.1], [0.2 + a, 0.1 + lift], [b, 0.1 + lift], [0.0, 0.1]),
                line([0.0, 0.1], [0.0, 0.0]),
            ],
        };
        survives(panel("cusp", vec![ring], 8e-3))?;
    }
}
