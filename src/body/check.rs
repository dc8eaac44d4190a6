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
