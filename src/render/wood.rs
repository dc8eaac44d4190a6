//! Planed wood: the year rings of logs cut along their length.

use super::{Light3, Vector};
use crate::garment::scene::{Shape, Solid};
use nalgebra::Rotation3;

/// Distance of year rings as they show on a plank, m.
const RINGS: f32 = 0.013;

/// The wood of one solid.
#[derive(Clone, Copy, Debug)]
pub struct Wood {
    /// From the world into the solid.
    turn: Rotation3<f32>,
    at: Vector,
    /// Axis of the grain.
    grain: usize,
    /// Below this height its pieces stand upright: legs.
    legs: f32,
}

impl Wood {
    /// The wood that a solid is made of; none for balls and the ground.
    pub fn of(solid: &Solid) -> Option<Self> {
        let (grain, legs) = match solid.shape {
            Shape::Sphere { .. } | Shape::Plane => return None,
            Shape::Cylinder { .. } => (1, f64::NEG_INFINITY),
            Shape::Box { size } => {
                let longest = (0..3).fold(0, |best, k| if size[k] > size[best] { k } else { best });
                (longest, f64::NEG_INFINITY)
            }
            Shape::Table { size, thickness } => {
                (if size[0] >= size[2] { 0 } else { 2 }, size[1] - 1.02 * thickness)
            }
        };
        let [x, y, z] = solid.turn.map(|angle| angle as f32);
        Some(Wood {
            turn: Rotation3::from_euler_angles(x, y, z).inverse(),
            at: Vector::from(solid.at.map(|c| c as f32)),
            grain,
            legs: legs as f32,
        })
    }

    /// Its colour at a place of the world, seen through a window `wide` m wide.
    pub fn colour(&self, place: &Vector, wide: f32) -> Light3 {
        let own = self.turn * (place - self.at);
        let grain = if own.y < self.legs { 1 } else { self.grain };
        let (along, a, b) = (own[grain], own[(grain + 1) % 3], own[(grain + 2) % 3]);
        // The heart of the log lies well outside the piece; it sways along the grain.
        let sway =
            libm::sinf(along * 2.3 + 1.3) * 0.006 + libm::sinf(along * 6.1 + a * 9.0) * 0.002;
        let (x, y) = (a + 0.31 + sway, b + 0.17 + 1.6 * sway);
        let out = (x * x + 2.6 * y * y).sqrt();
        let ring = out / RINGS * std::f32::consts::TAU;
        let uneven = libm::sinf(ring * 0.23 + 0.9) * 1.1 + libm::sinf(ring * 0.071);
        let late = 0.5 + 0.5 * libm::sinf(ring + uneven);
        // Rings finer than the window even out.
        let sharp = 1.0 / (1.0 + (wide / RINGS) * (wide / RINGS) * 12.0);
        let late = 0.3 + (late * late * late - 0.3) * sharp;
        let pores = libm::sinf(a * 2600.0) * libm::sinf(b * 2900.0 + along * 14.0);
        let pores = 1.0 + 0.02 * pores / (1.0 + wide * wide * 4e6);
        Light3::new(0.45, 0.315, 0.20) * ((1.0 - 0.17 * late) * pores)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grain_runs_along_legs_and_along_the_top() {
        let table = Solid {
            name: "table".into(),
            span: Default::default(),
            shape: Shape::Table { size: [1.2, 0.7, 0.8], thickness: 0.03 },
            at: [0.0; 3],
            turn: [0.0; 3],
            friction: None,
        };
        let wood = Wood::of(&table).expect("tables are of wood");
        let change = |from: [f32; 3], way: [f32; 3]| {
            let (from, way) = (Vector::from(from), Vector::from(way));
            (0..40)
                .map(|k| {
                    let at = |k: f32| wood.colour(&(from + way * k), 1e-4).x;
                    (at(k as f32 + 1.0) - at(k as f32)).abs()
                })
                .sum::<f32>()
        };
        let step = 1e-3;
        let top = [0.1, 0.7, 0.1];
        assert!(change(top, [0.0, 0.0, step]) > 2.0 * change(top, [step, 0.0, 0.0]));
        let leg = [0.5, 0.3, 0.35];
        assert!(change(leg, [0.0, 0.0, step]) > 2.0 * change(leg, [0.0, step, 0.0]));
    }
}
