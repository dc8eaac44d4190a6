//! Where panels begin: laid flat in the world, wrapped round trunk or limb at a distance, let
//! down as a cone, or led by their seams to a neighbour.
//!
//! Wrapped panels keep their widths: every row of the drawing is laid along a closed line round
//! the body whose length is at least the width of all that hangs there, so that seams begin
//! nearly closed and nothing begins inside the body.

mod cone;
mod led;
mod limb;
mod section;
mod trunk;

use crate::body::surface::{Landmark, Surface};
use crate::garment::scene::{Placement, Side};
use crate::mesh::compiled::{Compiled, MeshPanel};
use nalgebra::{Point3, Rotation3, Vector3};

/// First positions of all particles, in the order of the mesh, m.
///
/// `bodies` are the wearers in the order of [`Compiled::bodies`]. A panel whose landmark the body
/// does not have is laid flat before the body, so that the result is always complete.
pub fn place(compiled: &Compiled, bodies: &[Surface]) -> Vec<Point3<f64>> {
    let mut positions = vec![Point3::origin(); compiled.particles.len()];
    let mut done = vec![false; compiled.panels.len()];
    let mut wrapped = Vec::new();
    for (number, panel) in compiled.panels.iter().enumerate() {
        match &panel.placement {
            Placement::Flat { at, turn } => {
                let turn = Rotation3::from_euler_angles(turn[0], turn[1], turn[2]);
                for (k, [x, y]) in drawing(compiled, panel) {
                    let local = turn * Vector3::new(x, y, 0.0);
                    positions[k] = Point3::new(at[0], at[1], at[2]) + local;
                }
                done[number] = true;
            }
            Placement::Wrapped { body, landmark, level, side, anchor, gap } => {
                let Some(body) = bodies.get(*body) else { continue };
                wrapped.push(Wrapped {
                    number,
                    body,
                    landmark,
                    level: level.as_deref(),
                    side: *side,
                    anchor: *anchor,
                    gap: *gap,
                });
            }
            Placement::Led => {}
        }
    }
    for each in &wrapped {
        if each.is_cone(compiled) {
            cone::lay(compiled, each, &mut positions);
            done[each.number] = true;
        }
    }
    let trunk: Vec<&Wrapped> =
        wrapped.iter().filter(|w| !done[w.number] && w.limb().is_none()).collect();
    trunk::wrap(compiled, &trunk, &mut positions);
    for each in &trunk {
        done[each.number] = true;
    }
    for each in &wrapped {
        if let Some(limb) = each.limb() {
            limb::wrap(compiled, each, limb, &done, &mut positions);
        }
    }
    for each in &wrapped {
        done[each.number] = true;
    }
    led::follow(compiled, &mut done, &mut positions);
    positions
}

/// A panel to be wrapped.
struct Wrapped<'a> {
    number: usize,
    body: &'a Surface,
    landmark: &'a str,
    level: Option<&'a str>,
    side: Side,
    anchor: f64,
    gap: f64,
}

impl Wrapped<'_> {
    fn panel<'c>(&self, compiled: &'c Compiled) -> &'c MeshPanel {
        &compiled.panels[self.number]
    }

    /// The middle line and radii of its limb, if the landmark is one.
    fn limb(&self) -> Option<(&[Point3<f64>], &[f64])> {
        match self.body.landmarks.get(self.landmark) {
            Some(Landmark::Limb { points, radii }) if points.len() > 1 => Some((points, radii)),
            _ => None,
        }
    }

    /// A piece laid all round with a hole in it: a circular skirt, a cloak.
    fn is_cone(&self, compiled: &Compiled) -> bool {
        self.side == Side::Around && self.limb().is_none() && self.panel(compiled).loops.len() > 1
    }

    /// Height of the landmark, m.
    fn height(&self) -> f64 {
        centre(self.body, self.landmark).y
    }
}

/// Middle of a landmark; a body's own middle where it has no such place.
fn centre(body: &Surface, landmark: &str) -> Point3<f64> {
    match body.landmarks.get(landmark) {
        Some(Landmark::Point(point)) => *point,
        Some(Landmark::Ring { centre, .. }) => *centre,
        Some(Landmark::Limb { points, .. }) => points.first().copied().unwrap_or_default(),
        None => {
            let top = body.vertices.iter().map(|v| v.y).fold(0.0, f64::max);
            Point3::new(0.0, 0.6 * top, 0.0)
        }
    }
}

/// Particle numbers of a panel with their places in its drawing, m.
fn drawing<'a>(
    compiled: &'a Compiled,
    panel: &'a MeshPanel,
) -> impl Iterator<Item = (usize, [f64; 2])> + 'a {
    let (sin, cos) = (libm::sin(panel.grain), libm::cos(panel.grain));
    panel.particles.range().map(move |k| {
        let [u, v] = compiled.particles[k];
        (k, [u * cos - v * sin, u * sin + v * cos])
    })
}
