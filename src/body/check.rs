//! Whether a surface is closed, one piece and free of itself.

use super::surface::Surface;
use nalgebra::{Point3, Vector3};
use std::collections::BTreeMap;

/// What is wrong with a surface as the boundary of a body: edges without exactly two triangles,
/// triangles that turn the wrong way, missing vertices. Empty for a closed surface. At most 20.
pub fn defects(surface: &Surface) -> Vec<String> {
    let mut found = Vec::new();
    let mut edges: BTreeMap<(u32, u32), (u32, i32)> = BTreeMap::new();
    for (number, [a, b, c]) in surface.triangles.iter().enumerate() {
        if a == b || b == c || c == a {
            found.push(format!("triangle {number} names a vertex twice"));
        }
        for (i, j) in [(*a, *b), (*b, *c), (*c, *a)] {
            if surface.vertices.get(i as usize).is_none() {
                found.push(format!("triangle {number} names the missing vertex {i}"));
            }
            let entry = edges.entry((i.min(j), i.max(j))).or_insert((0, 0));
            entry.0 += 1;
            entry.1 += if i < j { 1 } else { -1 };
        }
    }
    for ((i, j), (count, turn)) in edges {
        if count != 2 || turn != 0 {
            found.push(format!("edge {i}-{j} has {count} triangles, turning {turn}"));
        }
    }
    if surface.normals.len() != surface.vertices.len() {
        found.push("vertices and normals differ in number".into());
    }
    let finite = |v: &Vector3<f64>| v.iter().all(|c| c.is_finite());
    if !surface.vertices.iter().all(|p| finite(&p.coords)) || !surface.normals.iter().all(finite) {
        found.push("a vertex or normal is not finite".into());
    }
    found.truncate(20);
    found
}

/// Vertices − edges + triangles of a closed surface: 2 for each piece without handles.
/// Vertices that no triangle names do not count.
pub fn euler(surface: &Surface) -> i64 {
    let mut named = vec![false; surface.vertices.len()];
    let mut edges = std::collections::BTreeSet::new();
    for [a, b, c] in &surface.triangles {
        for (i, j) in [(*a, *b), (*b, *c), (*c, *a)] {
            if let Some(n) = named.get_mut(i as usize) {
                *n = true;
            }
            edges.insert((i.min(j), i.max(j)));
        }
    }
    let count = |n: usize| i64::try_from(n).unwrap_or(i64::MAX);
    count(named.iter().filter(|n| **n).count()) - count(edges.len())
        + count(surface.triangles.len())
}

/// Volume inside a closed surface, m³; negative if it is turned inside out.
pub fn volume(surface: &Surface) -> f64 {
    let vertex = |i: u32| surface.vertices.get(i as usize).copied().unwrap_or_else(Point3::origin);
    surface
        .triangles
        .iter()
        .map(|t| {
            let [a, b, c] = t.map(|i| vertex(i).coords);
            a.dot(&b.cross(&c)) / 6.0
        })
        .sum()
}

/// Pairs of triangles without a common vertex that cross, by number: none for a surface free of
/// itself.
pub fn crossings(surface: &Surface) -> Vec<[usize; 2]> {
    let vertex = |i: u32| surface.vertices.get(i as usize).copied().unwrap_or_else(Point3::origin);
    let corners: Vec<[Point3<f64>; 3]> = surface.triangles.iter().map(|t| t.map(vertex)).collect();
    // Boxes of the triangles, swept along y.
    let span = |t: &[Point3<f64>; 3], k: usize| {
        let (a, b, c) = (t[0][k], t[1][k], t[2][k]);
        (a.min(b).min(c), a.max(b).max(c))
    };
    let mut order: Vec<usize> = (0..corners.len()).collect();
    order.sort_by(|a, b| span(&corners[*a], 1).0.total_cmp(&span(&corners[*b], 1).0));
    let mut found = Vec::new();
    for (place, i) in order.iter().enumerate() {
        let (low, high) = (
            [0, 1, 2].map(|k| span(&corners[*i], k).0),
            [0, 1, 2].map(|k| span(&corners[*i], k).1),
        );
        for j in &order[place + 1..] {
            let other = &corners[*j];
            if span(other, 1).0 > high[1] {
                break;
            }
            let apart = [0, 2].iter().any(|k| {
                let (l, h) = span(other, *k);
                l > high[*k] || h < low[*k]
            });
            let (s, t) = (surface.triangles[*i], surface.triangles[*j]);
            if apart || s.iter().any(|v| t.contains(v)) {
                continue;
            }
            let edge = |c: &[Point3<f64>; 3], k: usize| [c[k], c[(k + 1) % 3]];
            let one = &corners[*i];
            if (0..3).any(|k| pierces(edge(one, k), other) || pierces(edge(other, k), one)) {
                found.push([*i, *j]);
            }
        }
    }
    found
}

/// Whether the segment goes through the inside of the triangle.
fn pierces([p, q]: [Point3<f64>; 2], [a, b, c]: &[Point3<f64>; 3]) -> bool {
    let side = |p: &Point3<f64>, a: &Point3<f64>, b: &Point3<f64>, c: &Point3<f64>| {
        (a - p).dot(&(b - p).cross(&(c - p)))
    };
    let (above, below) = (side(&p, a, b, c), side(&q, a, b, c));
    if above * below >= 0.0 {
        return false;
    }
    let turns = [(a, b), (b, c), (c, a)].map(|(e, f)| side(&p, e, f, &q));
    turns.iter().all(|t| *t > 0.0) || turns.iter().all(|t| *t < 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A tetrahedron with its corner at `at`.
    fn tetrahedron(at: f64) -> (Vec<Point3<f64>>, Vec<[u32; 3]>) {
        let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let points = corners.map(|c| Point3::from(c) + Vector3::repeat(at)).to_vec();
        (points, vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    }

    fn surface(vertices: Vec<Point3<f64>>, triangles: Vec<[u32; 3]>) -> Surface {
        let normals = vec![Vector3::y(); vertices.len()];
        Surface { vertices, normals, triangles, ..Surface::default() }
    }

    #[test]
    fn a_hole_a_flip_and_a_crossing_are_found() {
        let (points, faces) = tetrahedron(0.0);
        let sound = surface(points.clone(), faces.clone());
        assert!(defects(&sound).is_empty());
        assert_eq!((euler(&sound), crossings(&sound).len()), (2, 0));
        assert!((volume(&sound) - 1.0 / 6.0).abs() < 1e-15);

        assert_eq!(defects(&surface(points.clone(), faces[1..].to_vec())).len(), 3);
        let mut flipped = faces.clone();
        flipped[3].swap(0, 1);
        assert_eq!(defects(&surface(points.clone(), flipped)).len(), 3);

        let (more, again) = tetrahedron(0.2);
        let both: Vec<_> = points.into_iter().chain(more).collect();
        let two = faces.into_iter().chain(again.iter().map(|t| t.map(|i| i + 4))).collect();
        assert!(!crossings(&surface(both, two)).is_empty());
    }
}
