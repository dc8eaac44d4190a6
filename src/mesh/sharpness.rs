//! Which triangles may be sharp: those where the outline itself is.

use super::improve::LIMIT;
use super::outline::corner;
use crate::geometry::polygon::{Place, distance, sharpest};

/// Corners with less cloth than this between their sides excuse sharp triangles, rad (40°).
const NARROW: f64 = 0.698_131_700_797_731_8;

/// The narrow corners of an outline and how far each reaches.
#[derive(Clone, Debug, Default)]
pub struct NarrowCorners {
    /// Place, and radius within which the cloth is narrower than its points are apart.
    corners: Vec<(Place, f64)>,
}

impl NarrowCorners {
    /// Finds the narrow corners of closed lines with the cloth on their left.
    pub fn new(rings: &[Vec<Place>]) -> Self {
        let mut corners = Vec::new();
        for ring in rings {
            let count = ring.len();
            for k in 0..count {
                let (a, b, c) = (ring[(k + count - 1) % count], ring[k], ring[(k + 1) % count]);
                let angle = corner(a, b, c);
                if angle < NARROW {
                    // At distance x from the tip the cloth is 2x sin(angle/2) wide; from about
                    // half the spacing of points on, triangles with 20° fit.
                    let spacing = distance(a, b).max(distance(b, c));
                    let reach = 0.25 / libm::sin(angle.max(1e-3) / 2.0) + 1.5;
                    corners.push((b, reach * spacing));
                }
            }
        }
        NarrowCorners { corners }
    }

    /// Whether a place lies where a narrow corner is narrower than its points are apart.
    pub fn reach(&self, place: Place) -> bool {
        self.corners.iter().any(|&(tip, reach)| distance(place, tip) <= reach)
    }

    /// Whether a triangle is sharper than 20° without a narrow corner near by.
    pub fn blames(&self, triangle: [Place; 3]) -> bool {
        let [a, b, c] = triangle;
        sharpest(a, b, c) > LIMIT + 1e-9
            && !self
                .corners
                .iter()
                .any(|&(tip, reach)| triangle.iter().all(|&place| distance(place, tip) <= reach))
    }
}
