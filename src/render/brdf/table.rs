//! A figure for every direction of a half sphere, for what is alike in its four quarters.

use crate::render::Vector;

/// Steps from the horizon to the normal.
const TILTS: usize = 40;

/// Steps from along the threads to across.
const TURNS: usize = 10;

/// The table.
#[derive(Clone, Debug)]
pub struct Table(Vec<f32>);

impl Table {
    /// Of `what` at the directions of one quarter. The steps of the height are squares, so that
    /// they are finest near the horizon, where most changes.
    pub fn of(what: impl Fn(&Vector) -> f32) -> Self {
        let mut values = Vec::with_capacity((TILTS + 1) * (TURNS + 1));
        for tilt in 0..=TILTS {
            let root = tilt as f32 / TILTS as f32;
            // The horizon itself is approached, not touched.
            let z = (root * root).max(1e-4);
            for turn in 0..=TURNS {
                let share = turn as f32 / TURNS as f32;
                let flat = Vector::new(1.0 - share, share, 0.0).normalize();
                values.push(what(&(flat * (1.0 - z * z).max(0.0).sqrt() + Vector::z() * z)));
            }
        }
        Table(values)
    }

    /// The figure for a direction, drawn out between those of the table.
    pub fn at(&self, direction: &Vector) -> f32 {
        let (x, y) = (direction.x.abs(), direction.y.abs());
        let share = if x + y > 1e-6 { y / (x + y) } else { 0.5 };
        let tilt = direction.z.clamp(0.0, 1.0).sqrt() * TILTS as f32;
        let turn = share * TURNS as f32;
        let (i, j) = ((tilt as usize).min(TILTS - 1), (turn as usize).min(TURNS - 1));
        let (s, t) = (tilt - i as f32, turn - j as f32);
        let row = |i: usize| {
            let at = i * (TURNS + 1) + j;
            self.0[at] * (1.0 - t) + self.0[at + 1] * t
        };
        row(i) * (1.0 - s) + row(i + 1) * s
    }

    /// Its mean over the half sphere, weighed by the cosine of the height, and over its quarter.
    pub fn mean(&self) -> f32 {
        let (mut sum, mut weights) = (0.0, 0.0);
        for tilt in 0..TILTS * 4 {
            let z = (tilt as f32 + 0.5) / (TILTS * 4) as f32;
            for turn in 0..TURNS {
                let (sine, cosine) =
                    libm::sincosf((turn as f32 + 0.5) / TURNS as f32 * std::f32::consts::FRAC_PI_2);
                let flat = (1.0 - z * z).sqrt();
                sum += z * self.at(&Vector::new(flat * cosine, flat * sine, z));
                weights += z;
            }
        }
        sum / weights
    }
}
