//! Match marks made from the seams: at thirds of every longer seam and where a part of one begins,
//! on both partners.

use super::garment::Making;
use crate::garment::panel::{Notch, Run};
use crate::garment::scene::{Placement, Side};
use crate::garment::seam::{PanelRun, Seam, SeamKind};
use crate::geometry::curve;
use kurbo::{BezPath, Point, Vec2};
use std::f64::consts::FRAC_PI_2;

/// Shorter seams need no marks, m.
const LONG: f64 = 0.2;

/// A point and the direction into the cloth, some way along a run and so far inside of it, m. The
/// cloth lies to the left of a piece.
pub(super) fn inside(path: &BezPath, run: &Run, way: f64) -> (Point, Vec2) {
    let sense = if run.to >= run.from { 1.0 } else { -1.0 };
    let (at, direction) = curve::at(path, run.from + sense * way.min(run.length()));
    (at, curve::unit(direction + FRAC_PI_2))
}

/// The place of [`inside`], moved into the cloth.
pub(super) fn place(path: &BezPath, run: &Run, way: f64, inset: f64) -> Point {
    let (at, inward) = inside(path, run, way);
    at + inward * inset
}

/// The mark some way along a side of a seam, with its panel.
fn mark(side: &[PanelRun], way: f64, making: &Making) -> Option<(usize, Notch)> {
    let mut rest = way;
    for on in side {
        let length = on.run.length();
        if rest > length + 1e-9 {
            rest -= length;
            continue;
        }
        let panel = making.garment.panels.get(on.panel)?;
        let path = &panel.loops.get(on.run.ring)?.pieces.get(on.run.piece)?.path;
        let (at, inward) = inside(path, &on.run, rest);
        let notch = Notch { at: [at.x, at.y], inward: [inward.x, inward.y], count: 1 };
        return Some((on.panel, notch));
    }
    None
}

/// Marks both sides of a seam at shares of its length: `count` of them evenly, or at thirds where
/// it is long.
pub(super) fn mark_seam(seam: &Seam, count: Option<u32>, making: &mut Making) {
    if !matches!(seam.kind, SeamKind::Plain | SeamKind::Zip) {
        return;
    }
    let length = |side: &[PanelRun]| side.iter().map(|on| on.run.length()).sum::<f64>();
    let (a, b) = (length(&seam.a), length(&seam.b));
    let count = count.unwrap_or(if a.max(b) > LONG { 2 } else { 0 });
    for number in 1..=count {
        let share = f64::from(number) / f64::from(count + 1);
        let marks = [mark(&seam.a, share * a, making), mark(&seam.b, share * b, making)];
        // One cut where a front piece takes part, two where only a back piece does.
        let stands = |side: Side| {
            marks.iter().flatten().any(|(panel, _)| {
                making.garment.panels.get(*panel).is_some_and(|panel| {
                    matches!(panel.placement, Placement::Wrapped { side: on, .. } if on == side)
                })
            })
        };
        let cuts = if stands(Side::Behind) && !stands(Side::Before) { 2 } else { 1 };
        for (panel, notch) in marks.into_iter().flatten() {
            if let Some(panel) = making.garment.panels.get_mut(panel) {
                panel.notches.push(Notch { count: cuts, ..notch });
            }
        }
    }
}
