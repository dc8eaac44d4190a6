//! Panels wrapped round the trunk: fronts, backs and tubes.

use super::section::{Ring, Sections};
use super::{Wrapped, by_layer, drawing};
use crate::garment::scene::Side;
use crate::mesh::compiled::Compiled;
use nalgebra::Point3;

/// Room left between panels that meet at the side, m.
const MEETING: f64 = 0.01;
/// Height of the rows whose widths are compared, m.
const ROW: f64 = 0.01;

/// Wraps the panels, one body and one layer of cloth after the other.
pub(super) fn wrap(compiled: &Compiled, panels: &[&Wrapped], positions: &mut [Point3<f64>]) {
    for members in by_layer(compiled, panels) {
        wrap_together(compiled, &members, positions);
    }
}

/// How far a row reaches to both sides of the middle, m: towards the wearer's left, right.
#[derive(Clone, Copy, Default)]
struct Reach {
    left: f64,
    right: f64,
}

fn wrap_together(compiled: &Compiled, members: &[&Wrapped], positions: &mut [Point3<f64>]) {
    let Some(first) = members.first() else { return };
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for member in members {
        for (_, [_, y]) in drawing(compiled, member.panel(compiled)) {
            let height = member.height() + y - member.anchor;
            low = low.min(height);
            high = high.max(height);
        }
    }
    if low > high {
        return;
    }
    let sections = Sections::new(first.body, low, high);
    let rows = ((high - low) / ROW) as usize + 2;
    let mut front = vec![Reach::default(); rows];
    let mut back = vec![Reach::default(); rows];
    for member in members {
        for (_, [x, y]) in drawing(compiled, member.panel(compiled)) {
            let row = ((member.height() + y - member.anchor - low) / ROW) as usize;
            // Behind the body the viewer's right is the wearer's right.
            let (reach, x) = match member.side {
                Side::Behind => (&mut back[row], -x),
                _ => (&mut front[row], x),
            };
            reach.left = reach.left.max(x);
            reach.right = reach.right.max(-x);
        }
    }
    let gap = members.iter().map(|m| m.gap).fold(f64::INFINITY, f64::min);
    let gaps: Vec<f64> = (0..sections.count())
        .map(|k| {
            let row = k.min(rows - 1);
            let left = front[row].left + back[row].left + MEETING;
            let right = front[row].right + back[row].right + MEETING;
            let wanted = 2.0 * left.max(right);
            gap.max((wanted - sections.girth(k)) / std::f64::consts::TAU)
        })
        .collect();
    let gaps = smooth_from_above(&gaps);
    let rings: Vec<Ring> = (0..sections.count()).map(|k| sections.ring(k, gaps[k])).collect();
    for member in members {
        for (particle, [x, y]) in drawing(compiled, member.panel(compiled)) {
            let height = member.height() + y - member.anchor;
            let (k, t) = sections.at(height);
            let walk = |ring: &Ring| match member.side {
                Side::Behind => ring.point(ring.girth() / 2.0 + x),
                _ => ring.point(x),
            };
            let (a, b) = (walk(&rings[k]), walk(&rings[(k + 1).min(rings.len() - 1)]));
            positions[particle] =
                Point3::new(a[0] + t * (b[0] - a[0]), height, a[1] + t * (b[1] - a[1]));
        }
    }
}

/// Widens gaps until none differs from its neighbour by more than a slope of one half: cloth
/// then begins without steps. Only ever widens, so nothing comes to lie in the body.
fn smooth_from_above(gaps: &[f64]) -> Vec<f64> {
    let slope = 0.5 * ROW;
    let mut out = gaps.to_vec();
    for k in 1..out.len() {
        out[k] = out[k].max(out[k - 1] - slope);
    }
    for k in (0..out.len().saturating_sub(1)).rev() {
        out[k] = out[k].max(out[k + 1] - slope);
    }
    out
}
