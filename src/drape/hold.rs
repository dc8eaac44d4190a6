//! What is held: edges attached to a body, and pins.

use super::cloth::Cloth;
use super::skin::MARGIN;
use crate::body::surface::{Landmark, Surface};
use crate::garment::seam::PinTarget;
use crate::mesh::compiled::Compiled;
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::TAU;

/// Stiffness of an attachment per area of the knot held, N/m³; a band 1 cm wide that carries 1 kg
/// over 70 cm gives 0.4 mm.
const STIFFNESS: f64 = 4.0e6;

/// Largest force of an attachment per area, N/m²: while an edge is still far from its place it is
/// drawn there gently.
const PULL: f64 = 4.0e3;

/// Fastest way of a pin to its place, m/s.
const PIN_SPEED: f64 = 0.6;

/// An edge held near a line of the skin; free to slide along it, friction holds it there.
#[derive(Clone, Debug)]
pub struct Attachment {
    knots: Vec<u32>,
    place: Place,
}

#[derive(Clone, Debug)]
enum Place {
    /// A closed line with its axis, and how far outside of it the edge lies, m.
    Ring { points: Vec<Vector3<f64>>, axis: Vector3<f64>, off: f64 },
    /// A way for each knot to a place of its own.
    Points(Vec<Vector3<f64>>),
}

/// A knot that is moved, not solved for.
#[derive(Clone, Copy, Debug)]
pub struct Pin {
    /// Its knot.
    pub knot: u32,
    /// Where it is to be.
    pub target: Vector3<f64>,
}

/// Force on a knot and its stiffness.
pub type Pull = (u32, Vector3<f64>, Matrix3<f64>);

/// Everything held.
#[derive(Clone, Debug, Default)]
pub struct Holds {
    attachments: Vec<Attachment>,
    /// Pins.
    pub pins: Vec<Pin>,
    /// Which knots are pinned.
    pub held: Vec<bool>,
}

impl Holds {
    /// The holds of a cloth whose knots are at `x`. Surfaces: the bodies first, as in `compiled`.
    pub fn new(
        compiled: &Compiled,
        surfaces: &[Surface],
        cloth: &Cloth,
        x: &[Vector3<f64>],
    ) -> Self {
        let mut holds = Holds { held: vec![false; cloth.knots()], ..Holds::default() };
        let bodies = &surfaces[..compiled.bodies.len().min(surfaces.len())];
        let mark = |body: usize, name: &str| bodies.get(body).and_then(|b| b.landmarks.get(name));
        let knots = |points: &[u32]| {
            let mut knots: Vec<u32> = points.iter().map(|&p| cloth.weld.knot[p as usize]).collect();
            knots.sort_unstable();
            knots.dedup();
            knots
        };
        let middle = |knots: &[u32]| {
            let sum: Vector3<f64> = knots.iter().map(|&k| x[k as usize]).sum();
            sum / knots.len().max(1) as f64
        };
        for a in &compiled.attachments {
            let knots = knots(&a.points);
            let shifted = |to: Vector3<f64>| {
                let from = middle(&knots);
                Place::Points(knots.iter().map(|&k| x[k as usize] - from + to).collect())
            };
            let place = match mark(a.body, &a.landmark) {
                Some(Landmark::Ring { axis, points, .. }) if points.len() > 2 => {
                    let points: Vec<Vector3<f64>> = points.iter().map(|p| p.coords).collect();
                    let off = stand_off(edge_length(compiled, &a.points), &points);
                    Place::Ring { points, axis: *axis, off }
                }
                Some(Landmark::Ring { centre, .. }) => shifted(centre.coords),
                Some(Landmark::Point(p)) => shifted(p.coords),
                Some(Landmark::Limb { points, .. }) => match points.first() {
                    Some(p) => shifted(p.coords),
                    None => continue,
                },
                None => continue,
            };
            holds.attachments.push(Attachment { knots, place });
        }
        for pin in &compiled.pins {
            let knots = knots(&pin.points);
            let to = match &pin.to {
                PinTarget::Here => middle(&knots),
                PinTarget::Place(p) => Vector3::from(*p),
                PinTarget::Landmark { body, name } => match mark(*body, name) {
                    Some(Landmark::Point(p)) => p.coords,
                    Some(Landmark::Ring { centre, .. }) => centre.coords,
                    Some(Landmark::Limb { points, .. }) => match points.first() {
                        Some(p) => p.coords,
                        None => continue,
                    },
                    None => continue,
                },
            };
            // Several points are moved as one, their middle to the place.
            let way = to - middle(&knots);
            for k in knots {
                if !std::mem::replace(&mut holds.held[k as usize], true) {
                    holds.pins.push(Pin { knot: k, target: x[k as usize] + way });
                }
            }
        }
        holds
    }

    /// Whether anything is attached to a body.
    pub fn attached(&self) -> bool {
        !self.attachments.is_empty()
    }

    /// Moves pins towards their places for a time of `dt`, s; gives whether all are there.
    pub fn move_pins(&self, dt: f64, x: &mut [Vector3<f64>], v: &mut [Vector3<f64>]) -> bool {
        let mut there = true;
        for pin in &self.pins {
            let k = pin.knot as usize;
            let way = pin.target - x[k];
            let far = way.norm();
            let most = PIN_SPEED * dt;
            x[k] = if far > most { x[k] + way * (most / far) } else { pin.target };
            there &= far <= most;
            v[k] = Vector3::zeros();
        }
        there
    }

    /// Forces of the attachments.
    pub fn pull(&self, cloth: &Cloth, x: &[Vector3<f64>]) -> Vec<Pull> {
        let mut pulls = Vec::new();
        for a in &self.attachments {
            for (i, &k) in a.knots.iter().enumerate() {
                let here = x[k as usize];
                let area = cloth.area[k as usize];
                let (way, free) = match &a.place {
                    Place::Ring { points, axis, off } => to_ring(points, axis, *off, &here),
                    Place::Points(to) => (to[i] - here, Vector3::zeros()),
                };
                let far = way.norm();
                let k_full = STIFFNESS * area;
                let stiffness = if far * k_full > PULL * area { PULL * area / far } else { k_full };
                let block = (Matrix3::identity() - free * free.transpose()) * stiffness;
                pulls.push((k, way * stiffness, block));
            }
        }
        pulls
    }
}

/// Farthest that an edge stands off its ring, m, which takes up 9 cm of ease; what is longer is
/// gathered on to the ring.
const STAND_OFF: f64 = 0.015;

/// How far outside of a ring an edge of some length lies: with ease it stands off evenly all round,
/// where held to the skin it would throw the ease into folds.
fn stand_off(length: f64, ring: &[Vector3<f64>]) -> f64 {
    let around: f64 = (0..ring.len()).map(|i| (ring[(i + 1) % ring.len()] - ring[i]).norm()).sum();
    ((length - around) / TAU).clamp(MARGIN, STAND_OFF)
}

/// Length at rest of the outline between neighbours that are both among the given particles, m.
fn edge_length(compiled: &Compiled, points: &[u32]) -> f64 {
    let mut among = points.to_vec();
    among.sort_unstable();
    let held = |p: &u32| among.binary_search(p).is_ok();
    let step = |p: u32, q: u32| {
        let [p, q] = [p, q].map(|p| compiled.particles[p as usize]);
        libm::hypot(p[0] - q[0], p[1] - q[1])
    };
    let sides = compiled
        .panels
        .iter()
        .flat_map(|panel| &panel.loops)
        .flat_map(|ring| (0..ring.len()).map(|i| (ring[i], ring[(i + 1) % ring.len()])));
    sides.filter(|(p, q)| held(p) && held(q)).map(|(p, q)| step(p, q)).sum()
}

/// The way from a place to its seat outside of a ring, and the direction along the ring.
fn to_ring(
    points: &[Vector3<f64>],
    axis: &Vector3<f64>,
    off: f64,
    place: &Vector3<f64>,
) -> (Vector3<f64>, Vector3<f64>) {
    let mut best = (f64::INFINITY, Vector3::zeros(), Vector3::zeros());
    for (i, p) in points.iter().enumerate() {
        let q = points[(i + 1) % points.len()];
        let along = q - p;
        let square = along.norm_squared();
        if square < 1e-16 {
            continue;
        }
        let share = ((place - p).dot(&along) / square).clamp(0.0, 1.0);
        let near = p + along * share;
        let far = (place - near).norm_squared();
        if far < best.0 {
            best = (far, near, along / square.sqrt());
        }
    }
    let (_, near, tangent) = best;
    // The ring runs anticlockwise about its axis, so outwards is to the right of its course.
    let out = tangent.cross(axis);
    let seat = near + out * off;
    let way = seat - place;
    (way - tangent * way.dot(&tangent), tangent)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A hoop of radius 10 cm: 2 cm of ease lie 3.2 mm off it (less 0.02 % for its 100 corners), none
    /// at the least distance, a gathered edge at the greatest.
    #[test]
    fn ease_stands_off_evenly() {
        let hoop: Vec<_> = (0..100)
            .map(|i| libm::sincos(f64::from(i) * TAU / 100.0))
            .map(|(s, c)| Vector3::new(0.1 * s, 1.0, 0.1 * c))
            .collect();
        assert!((stand_off(0.1 * TAU + 0.02, &hoop) - 0.02 / TAU).abs() < 1e-4);
        assert_eq!(stand_off(0.1 * TAU, &hoop), MARGIN);
        assert_eq!(stand_off(2.0, &hoop), STAND_OFF);
    }

    #[test]
    fn the_seat_lies_just_outside_the_ring() {
        let ring: Vec<_> = [(1.0, 0.0), (0.0, -1.0), (-1.0, 0.0), (0.0, 1.0)]
            .map(|(x, z)| Vector3::new(x, 1.0, z))
            .into();
        let (way, along) = to_ring(&ring, &Vector3::y(), MARGIN, &Vector3::new(0.6, 1.2, -0.6));
        let seat = Vector3::new(0.6, 1.2, -0.6) + way;
        assert!((seat.y - 1.0).abs() < 1e-12);
        let out = (seat.x - seat.z) / 2f64.sqrt();
        assert!((out - 0.5f64.sqrt() - MARGIN).abs() < 1e-9, "{out}");
        assert!(along.y.abs() < 1e-12);
    }
}
