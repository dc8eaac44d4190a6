//! Pieces with a hole that the body stands in: circular skirts and cloaks (Bricis 1995, 5.3:
//! rows along rays from the waist slice).
//!
//! They begin as a cone let down from the landmark, clear of the arms. A cone is narrower than
//! the flat ring it is made of; ripples take up the difference, none at the hole, most at the
//! hem, so that the cloth begins nearly unstretched.

use super::section::Sections;
use super::{Wrapped, drawing};
use crate::mesh::compiled::Compiled;
use nalgebra::{Point3, Vector3};
use std::f64::consts::{PI, TAU};

/// Slope of the cone below the horizontal, rad.
const SLOPE: f64 = 0.65;
/// Number of ripples round the cone.
const RIPPLES: f64 = 10.0;

pub(super) fn lay(compiled: &Compiled, wrapped: &Wrapped, positions: &mut [Point3<f64>]) {
    let panel = wrapped.panel(compiled);
    let places: Vec<(usize, [f64; 2])> = drawing(compiled, panel).collect();
    let of_particle = |k: u32| {
        places.get((k - panel.particles.start) as usize).map_or([0.0; 2], |(_, place)| *place)
    };
    let hole: Vec<[f64; 2]> = panel.loops[1].iter().map(|k| of_particle(*k)).collect();
    let n = hole.len() as f64;
    let middle =
        [hole.iter().map(|p| p[0]).sum::<f64>() / n, hole.iter().map(|p| p[1]).sum::<f64>() / n];
    let girth: f64 = (0..hole.len())
        .map(|k| {
            let (a, b) = (hole[k], hole[(k + 1) % hole.len()]);
            libm::hypot(b[0] - a[0], b[1] - a[1])
        })
        .sum();
    let inner = girth / TAU;
    let height = wrapped.height();
    let sections = Sections::new(wrapped.body, height - 0.02, height + 0.02);
    let (k, _) = sections.at(height);
    let ring = sections.ring(k, wrapped.gap.max(0.005));
    let clear = ring.girth() / TAU;

    for (particle, [x, y]) in &places {
        let (dx, dy) = (x - middle[0], y - middle[1]);
        // Seen from above with the front below: the drawing's -y is the front, +x the left.
        let angle = libm::atan2(dx, -dy);
        let radius = libm::hypot(dx, dy);
        let out = (radius - inner).max(0.0);
        let here = ring.point(angle / TAU * ring.girth());
        let next = ring.point((angle + 1e-3) / TAU * ring.girth());
        let last = ring.point((angle - 1e-3) / TAU * ring.girth());
        // Outwards is the walk's direction (towards the left) turned by a right angle.
        let along = Vector3::new(next[0] - last[0], 0.0, next[1] - last[1]).normalize();
        let outward = Vector3::new(-along.z, 0.0, along.x);
        let outward = if outward.dot(&Vector3::new(here[0], 0.0, here[1])) < 0.0 {
            -outward
        } else {
            outward
        };
        let (cos, sin) = (libm::cos(SLOPE), libm::sin(SLOPE));
        let around = clear + out * cos;
        let excess = ((inner + out) / around - 1.0).max(0.0);
        let ripple = 2.0 * around / RIPPLES * excess.sqrt();
        let wave = ripple * libm::cos(RIPPLES * angle + PI);
        let normal = outward * sin + Vector3::y() * cos;
        positions[*particle] = Point3::new(here[0], height, here[1])
            + (outward * cos - Vector3::y() * sin) * out
            + normal * wave;
    }
}
