//! The way of a ray through the shell of a cloth.

use super::bodies::{Bodies, Line, Struck};
use crate::render::Vector;

/// The cloth at the place where a ray comes near, and the ray as the cloth sees it.
#[derive(Clone, Copy, Debug)]
pub struct Course {
    /// Place along weft and warp, and height over the middle of the cloth, m.
    pub origin: Vector,
    /// Weft, warp and normal there: how far the world goes in a metre of each.
    pub axes: [Vector; 3],
    /// How the normal turns along weft and warp, 1/m.
    pub bends: [Vector; 2],
}

/// Where a ray meets a yarn of the cloth, in the world.
#[derive(Clone, Copy, Debug)]
pub struct Met {
    /// Distance along the ray from where the course begins, m.
    pub distance: f32,
    /// What it meets.
    pub struck: Struck,
}

/// Straight stretches into which the way through a bent shell is divided.
const STRETCHES: usize = 6;

impl Course {
    /// A direction of the world along weft, warp and normal.
    pub fn inwards(&self, direction: &Vector) -> Option<Vector> {
        let [a, b, c] = &self.axes;
        let volume = a.dot(&b.cross(c));
        if volume.abs() < 1e-9 {
            return None;
        }
        let solve = |p: &Vector, q: &Vector| direction.dot(&p.cross(q)) / volume;
        Some(Vector::new(solve(b, c), solve(c, a), solve(a, b)))
    }

    /// A normal of the space of the cloth in the world; unit length.
    pub fn normal_outwards(&self, normal: &Vector) -> Vector {
        let [a, b, c] = &self.axes;
        // Normals go with the inverse transpose: the cofactors, up to their scale.
        let sign = if a.dot(&b.cross(c)) < 0.0 { -1.0 } else { 1.0 };
        let sum = b.cross(c) * normal.x + c.cross(a) * normal.y + a.cross(b) * normal.z;
        (sum * sign).try_normalize(1e-12).unwrap_or(*c)
    }

    /// A direction of the space of the cloth in the world; unit length.
    pub fn outwards(&self, way: &Vector) -> Vector {
        let [a, b, c] = &self.axes;
        (a * way.x + b * way.y + c * way.z).try_normalize(1e-12).unwrap_or(*a)
    }

    /// The first yarn on the way of a ray that leaves the origin in a direction of the world.
    ///
    /// The cloth bends away from the straight ray: over a distance s by ½ κ s², κ its curvature
    /// in that direction (F. Policarpo and M. M. Oliveira 2005). The bent way is divided into a
    /// few straight ones.
    pub fn first(&self, bodies: &Bodies, direction: &Vector) -> Option<Met> {
        let own = self.inwards(direction)?;
        let turned = self.bends[0] * own.x + self.bends[1] * own.y;
        let flat = direction - self.axes[2] * direction.dot(&self.axes[2]);
        let most = 0.25 / bodies.height;
        let bend = turned.dot(&flat).clamp(-most, most);
        let height = bodies.height * 1.001;
        let farthest = 40.0 * bodies.pitch.max(bodies.height);
        let end = leaves(self.origin.z, own.z, bend, height).min(farthest);
        // Where the cloth hardly bends on the way the ray is one straight line.
        let parts = if (0.5 * bend * end * end).abs() < 0.02 * height { 1 } else { STRETCHES };
        for part in 0..parts {
            let (from, to) =
                (end * part as f32 / parts as f32, end * (part + 1) as f32 / parts as f32);
            let middle = if parts == 1 { 0.0 } else { 0.5 * (from + to) };
            let slope = own.z + bend * middle;
            let level = self.origin.z + own.z * middle + 0.5 * bend * middle * middle;
            let line = Line {
                origin: Vector::new(self.origin.x, self.origin.y, level - slope * middle),
                direction: Vector::new(own.x, own.y, slope),
            };
            if let Some(struck) = bodies.first(&line, from, to) {
                return Some(Met { distance: struck.distance, struck });
            }
        }
        None
    }

    /// Where the ray is after a distance.
    pub fn after(&self, direction: &Vector, distance: f32) -> Vector {
        let Some(own) = self.inwards(direction) else { return self.origin };
        self.origin + own * distance
    }
}

/// The distance at which w = w₀ + s w′ + ½ κ s² leaves −h to h, after it was inside.
fn leaves(start: f32, slope: f32, bend: f32, height: f32) -> f32 {
    let mut least = f32::INFINITY;
    for edge in [height, -height] {
        let c = start - edge;
        let half = 0.5 * bend;
        let roots = if half.abs() < 1e-9 {
            [if slope.abs() > 1e-9 { -c / slope } else { f32::INFINITY }, f32::INFINITY]
        } else {
            let square = slope * slope - 4.0 * half * c;
            if square < 0.0 {
                continue;
            }
            let root = square.sqrt();
            [(-slope - root) / (2.0 * half), (-slope + root) / (2.0 * half)]
        };
        for root in roots {
            // The edge at which the ray came in is left behind.
            if root > 1e-4 * height && root < least {
                least = root;
            }
        }
    }
    least
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ray_leaves_a_flat_shell_below_and_a_bent_one_above() {
        // Straight down from the top: through both heights.
        assert!((leaves(1.0, -1.0, 0.0, 1.0) - 2.0).abs() < 1e-5);
        // Grazing a cloth that bends away: s/10 down, s²/20 up, back at the top after 2 m.
        assert!((leaves(1.0, -0.1, 0.1, 1.0) - 2.0).abs() < 1e-4);
        // From within it goes on to the nearer side.
        assert!((leaves(0.0, 0.5, 0.0, 1.0) - 2.0).abs() < 1e-5);
    }

    #[test]
    fn directions_and_normals_go_to_the_world_as_the_cloth_is_drawn() {
        // Sheared by half along the weft.
        let axes = [Vector::x(), Vector::new(0.5, 1.0, 0.0), Vector::z()];
        let course = Course { origin: Vector::zeros(), axes, bends: [Vector::zeros(); 2] };
        let warp = course.outwards(&Vector::y());
        assert!((warp - Vector::new(0.5, 1.0, 0.0).normalize()).norm() < 1e-6);
        // The side of a warp thread still stands on it.
        let side = course.normal_outwards(&Vector::x());
        assert!(side.dot(&warp).abs() < 1e-6 && side.x > 0.8);
        let own = course.inwards(&axes[1]).unwrap();
        assert!((own - Vector::y()).norm() < 1e-6);
    }
}
