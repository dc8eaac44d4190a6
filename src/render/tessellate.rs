//! Curved triangles: the mesh as smooth as its normals say.
//!
//! Each triangle becomes the cubic patch that its corners and their normals ask for (A. Vlachos et
//! al., "Curved PN Triangles", 2001) and is divided until the pieces are small on the picture. The
//! outline is round, and no shadow falls on a facet that the shading takes for curved.

use super::Vector;

/// A curved triangle, by its ten control points.
#[derive(Clone, Copy, Debug)]
pub struct Patch {
    corners: [Vector; 3],
    /// On the edge from corner a to b, a third of the way: 01, 10, 12, 21, 20, 02.
    thirds: [Vector; 6],
    middle: Vector,
}

/// Where a piece lies in its triangle: column and row among `parts`, upright or turned.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Piece {
    column: u8,
    row: u8,
    parts: u8,
    turned: bool,
}

impl Patch {
    /// Over the corners and their unit normals.
    pub fn over(corners: [Vector; 3], normals: [Vector; 3]) -> Self {
        let third = |a: usize, b: usize| {
            let edge = corners[b] - corners[a];
            // A normal that leans along the edge would throw the curve far out: at a crease.
            let limit = 0.3 * edge.norm();
            let rise = edge.dot(&normals[a]).clamp(-limit, limit);
            corners[a] + (edge - normals[a] * rise) / 3.0
        };
        let thirds = [third(0, 1), third(1, 0), third(1, 2), third(2, 1), third(2, 0), third(0, 2)];
        let edges = thirds.iter().fold(Vector::zeros(), |sum, point| sum + point) / 6.0;
        let flat = (corners[0] + corners[1] + corners[2]) / 3.0;
        Patch { corners, thirds, middle: edges + (edges - flat) * 0.5 }
    }

    /// The place with the shares `u` of the second and `v` of the third corner.
    pub fn place(&self, u: f32, v: f32) -> Vector {
        let w = 1.0 - u - v;
        let [a, b, c] = &self.corners;
        let [ab, ba, bc, cb, ca, ac] = &self.thirds;
        a * (w * w * w)
            + b * (u * u * u)
            + c * (v * v * v)
            + (ab * (w * w * u) + ba * (w * u * u)) * 3.0
            + (bc * (u * u * v) + cb * (u * v * v)) * 3.0
            + (ca * (v * v * w) + ac * (v * w * w)) * 3.0
            + self.middle * (6.0 * u * v * w)
    }

    /// The same moved by `away` along the normals, for the normals of the corners.
    pub fn place_off(&self, normals: &[Vector; 3], away: f32, u: f32, v: f32) -> Vector {
        let normal = normals[0] * (1.0 - u - v) + normals[1] * u + normals[2] * v;
        let length = normal.norm().max(1e-6);
        self.place(u, v) + normal * (away / length)
    }

    /// Divides every edge into `parts` and hands over each piece with its corners.
    pub fn divide(&self, parts: u8, take: impl FnMut(Piece, [Vector; 3])) {
        divide(parts, |u, v| self.place(u, v), take);
    }
}

/// Divides every edge of a triangle, whose places are `place` by the shares of the second and third
/// corner, into `parts` and hands over each piece with its corners.
pub fn divide(
    parts: u8,
    place: impl Fn(f32, f32) -> Vector,
    mut take: impl FnMut(Piece, [Vector; 3]),
) {
    {
        let step = 1.0 / f32::from(parts.max(1));
        let at = |i: u8, j: u8| place(f32::from(i) * step, f32::from(j) * step);
        for row in 0..parts {
            for column in 0..parts - row {
                let (i, j) = (column, row);
                let upright = Piece { column, row, parts, turned: false };
                take(upright, [at(i, j), at(i + 1, j), at(i, j + 1)]);
                if column + row + 1 < parts {
                    let turned = Piece { turned: true, ..upright };
                    take(turned, [at(i + 1, j + 1), at(i, j + 1), at(i + 1, j)]);
                }
            }
        }
    }
}

impl Piece {
    /// Shares of the triangle's second and third corner from those of the piece.
    pub fn shares(&self, u: f32, v: f32) -> [f32; 2] {
        let step = 1.0 / f32::from(self.parts.max(1));
        let (i, j) = (f32::from(self.column), f32::from(self.row));
        if self.turned {
            [(i + 1.0 - u) * step, (j + 1.0 - v) * step]
        } else {
            [(i + u) * step, (j + v) * step]
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A triangle of a ball of radius 1, its corners 30° apart.
    fn cap() -> Patch {
        let lean = 0.3;
        let corners = [[0.0, 1.0], [-0.866, -0.5], [0.866, -0.5]]
            .map(|[x, y]| Vector::new(x * lean, y * lean, 1.0).normalize());
        Patch::over(corners, corners)
    }

    #[test]
    fn a_piece_of_a_ball_is_nearly_round() {
        let mut furthest: f32 = 0.0;
        cap().divide(8, |_, [a, _, _]| furthest = furthest.max((a.norm() - 1.0).abs()));
        // The flat triangle lies 1 − 1/√1.09 = 0.042 too deep in the middle.
        assert!(furthest < 0.003, "{furthest}");
    }

    #[test]
    fn pieces_cover_the_triangle_and_know_their_place() {
        let patch = cap();
        let mut area = 0.0;
        let mut count = 0;
        patch.divide(5, |piece, [a, b, c]| {
            let place = |u, v| {
                let [u, v] = piece.shares(u, v);
                patch.place(u, v)
            };
            assert!((place(0.0, 0.0) - a).norm() < 1e-5);
            assert!((place(1.0, 0.0) - b).norm() < 1e-5);
            assert!((place(0.0, 1.0) - c).norm() < 1e-5);
            let normal = (b - a).cross(&(c - a));
            assert!(normal.dot(&a) > 0.0, "turned inside out");
            area += 0.5 * normal.norm();
            count += 1;
        });
        assert_eq!(count, 25);
        // A little more than the flat triangle of circumradius 0.3 / √1.09.
        let flat = 0.75 * 3.0_f32.sqrt() * 0.09 / 1.09;
        assert!(area > flat && area < flat * 1.1, "{area}");
    }
}
