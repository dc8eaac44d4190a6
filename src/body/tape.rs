//! The tape measure: sections of a surface by a plane, and the girth round them.

use super::surface::Surface;
use nalgebra::{Point3, Vector3};
use std::collections::BTreeMap;

/// Length of a tight tape round points in a plane (the edge of their convex hull), m.
pub fn girth(points: &[[f64; 2]]) -> f64 {
    let hull = hull(points);
    (0..hull.len())
        .map(|k| {
            let (a, b) = (hull[k], hull[(k + 1) % hull.len()]);
            ((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1])).sqrt()
        })
        .sum()
}

/// Convex hull, anticlockwise.
///
/// # References
/// Andrew 1979, "Another efficient algorithm for convex hulls in two dimensions".
pub fn hull(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    sorted.dedup();
    if sorted.len() < 3 {
        return sorted;
    }
    let turn = |o: [f64; 2], a: [f64; 2], b: [f64; 2]| {
        (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])
    };
    let half = |points: &mut dyn Iterator<Item = [f64; 2]>| {
        let mut chain: Vec<[f64; 2]> = Vec::new();
        for p in points {
            while chain.len() >= 2 && turn(chain[chain.len() - 2], chain[chain.len() - 1], p) <= 0.0
            {
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut lower = half(&mut sorted.iter().copied());
    lower.extend(half(&mut sorted.iter().rev().copied()));
    lower
}

/// The closed lines in which a plane through `centre` cuts a closed surface, each anticlockwise
/// about `axis`.
pub fn cuts(surface: &Surface, centre: Point3<f64>, axis: Vector3<f64>) -> Vec<Vec<Point3<f64>>> {
    let heights: Vec<f64> = surface.vertices.iter().map(|p| (p - centre).dot(&axis)).collect();
    let height = |i: u32| heights.get(i as usize).copied().unwrap_or(0.0);
    // In each cut triangle the line runs from the edge where it comes in to the one where it
    // leaves; an edge is left by exactly one triangle of a closed surface.
    let mut next: BTreeMap<(u32, u32), (u32, u32)> = BTreeMap::new();
    for [a, b, c] in &surface.triangles {
        let (mut enter, mut leave) = (None, None);
        for (i, j) in [(*a, *b), (*b, *c), (*c, *a)] {
            let key = (i.min(j), i.max(j));
            match (height(i) >= 0.0, height(j) >= 0.0) {
                (true, false) => leave = Some(key),
                (false, true) => enter = Some(key),
                _ => {}
            }
        }
        if let (Some(enter), Some(leave)) = (enter, leave) {
            next.insert(leave, enter);
        }
    }
    let place = |(i, j): (u32, u32)| {
        let (f, g) = (height(i), height(j));
        let share = if (f - g).abs() > 0.0 { f / (f - g) } else { 0.5 };
        let (p, q) = (surface.vertices[i as usize], surface.vertices[j as usize]);
        p + (q - p) * share
    };
    let mut loops = Vec::new();
    while let Some((first, mut to)) = next.pop_first() {
        let mut line = vec![place(first)];
        while to != first {
            line.push(place(to));
            match next.remove(&to) {
                Some(further) => to = further,
                None => break,
            }
        }
        loops.push(line);
    }
    loops
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::solid;
    use crate::diagnostic::Span;
    use crate::garment::scene::{Shape, Solid};
    use std::f64::consts::TAU;

    #[test]
    fn the_tape_bridges_hollows() {
        let square = [[0.0, 0.0], [1.0, 0.0], [0.5, 0.2], [1.0, 1.0], [0.0, 1.0], [0.5, 0.5]];
        assert!((girth(&square) - 4.0).abs() < 1e-12);
        assert_eq!(girth(&[]), 0.0);
    }

    #[test]
    fn a_cut_ball_is_a_circle_and_runs_anticlockwise() {
        let ball = solid(&Solid {
            name: "ball".into(),
            span: Span::default(),
            shape: Shape::Sphere { radius: 0.25 },
            at: [0.0, 0.3, 0.0],
            turn: [0.0; 3],
            friction: None,
        });
        let centre = Point3::new(0.0, 0.45, 0.0);
        let loops = cuts(&ball, centre, Vector3::y());
        assert_eq!(loops.len(), 1);
        let points: Vec<[f64; 2]> = loops[0].iter().map(|p| [p.x, p.z]).collect();
        assert!((girth(&points) / (TAU * 0.2) - 1.0).abs() < 1e-3);
        let area: Vector3<f64> = (0..loops[0].len())
            .map(|k| {
                let (p, q) = (loops[0][k] - centre, loops[0][(k + 1) % loops[0].len()] - centre);
                p.cross(&q) / 2.0
            })
            .sum();
        assert!((area.y / (TAU / 2.0 * 0.04) - 1.0).abs() < 2e-3);
        assert!(cuts(&ball, Point3::new(0.0, 2.0, 0.0), Vector3::y()).is_empty());
    }
}
