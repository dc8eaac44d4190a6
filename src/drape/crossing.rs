//! How many faces of a cloth cut each other: a count of its own, with a search and a test that
//! the contact of layers does not use for keeping them apart.

use super::weld::Weld;
use crate::mesh::compiled::Compiled;
use nalgebra::Vector3;
use rayon::prelude::*;
use std::collections::BTreeMap;

type V = Vector3<f64>;

/// How many pairs of triangles (cells cut in two) cut each other. Triangles with a corner in common,
/// sewn and buttoned corners included, do not count.
pub fn count(compiled: &Compiled, x: &[V]) -> usize {
    pairs(compiled, x).len()
}

/// Names of the two panels, or twice of the one, of which most faces cut each other.
pub fn worst<'a>(compiled: &'a Compiled, x: &[V]) -> Option<[&'a str; 2]> {
    let of = |f: &[u32; 3]| {
        compiled.panels.iter().position(|p| p.particles.range().contains(&(f[0] as usize)))
    };
    let mut counts: BTreeMap<[usize; 2], usize> = BTreeMap::new();
    for [f, g] in pairs(compiled, x) {
        let (Some(a), Some(b)) = (of(&f), of(&g)) else { continue };
        *counts.entry([a.min(b), a.max(b)]).or_default() += 1;
    }
    let most = counts.values().copied().max()?;
    let (panels, _) = counts.iter().find(|(_, count)| **count == most)?;
    Some(panels.map(|p| compiled.panels[p].name.as_str()))
}

/// The pairs of triangles that cut each other.
fn pairs(compiled: &Compiled, x: &[V]) -> Vec<[[u32; 3]; 2]> {
    let sewn = compiled.seams.iter().chain(&compiled.closures);
    let seams = sewn.flat_map(|s| s.pairs.iter().copied());
    let weld = Weld::new(compiled.particles.len(), seams);
    let halves = compiled.cells.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]);
    let mut faces: Vec<(f64, f64, [u32; 3])> = halves
        .chain(compiled.triangles.iter().copied())
        .map(|f| {
            let ys = f.map(|k| x[k as usize].y);
            let low = ys.into_iter().fold(f64::INFINITY, f64::min);
            let high = ys.into_iter().fold(f64::NEG_INFINITY, f64::max);
            (low, high, f)
        })
        .collect();
    faces.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.2.cmp(&b.2)));
    // Sweep upwards: each face against those that begin before it ends.
    (0..faces.len())
        .into_par_iter()
        .flat_map_iter(|i| {
            let (_, high, f) = faces[i];
            let own = f.map(|k| x[k as usize]);
            let (weld, after) = (&weld, &faces[i + 1..]);
            after
                .iter()
                .take_while(move |g| g.0 <= high)
                .filter(move |(_, _, g)| {
                    let other = g.map(|k| x[k as usize]);
                    overlap(&own, &other, 0)
                        && overlap(&own, &other, 2)
                        && !f.iter().any(|a| {
                            g.iter().any(|b| weld.knot[*a as usize] == weld.knot[*b as usize])
                        })
                        && cut(&own, &other)
                })
                .map(move |(_, _, g)| [f, *g])
        })
        .collect()
}

fn overlap(a: &[V; 3], b: &[V; 3], axis: usize) -> bool {
    let span = |t: &[V; 3]| {
        let [p, q, r] = [t[0][axis], t[1][axis], t[2][axis]];
        (p.min(q).min(r), p.max(q).max(r))
    };
    let ((l1, h1), (l2, h2)) = (span(a), span(b));
    l1 <= h2 && l2 <= h1
}

/// Whether two triangles cut each other: an edge of one goes through the inside of the other.
pub fn cut(a: &[V; 3], b: &[V; 3]) -> bool {
    (0..3).any(|k| {
        let m = (k + 1) % 3;
        pierces(&a[k], &a[m], b) || pierces(&b[k], &b[m], a)
    })
}

/// Whether the segment p–q goes through the triangle, by the signs of five volumes.
fn pierces(p: &V, q: &V, t: &[V; 3]) -> bool {
    let volume = |a: &V, b: &V, c: &V, d: &V| (b - a).cross(&(c - a)).dot(&(d - a));
    let (above, below) = (volume(&t[0], &t[1], &t[2], p), volume(&t[0], &t[1], &t[2], q));
    if !(above * below < 0.0) {
        return false;
    }
    let u = volume(p, q, &t[0], &t[1]);
    let v = volume(p, q, &t[1], &t[2]);
    let w = volume(p, q, &t[2], &t[0]);
    (u > 0.0 && v > 0.0 && w > 0.0) || (u < 0.0 && v < 0.0 && w < 0.0)
}

#[cfg(test)]
mod tests {
    use super::super::swatch::{fabric, rectangles};
    use super::*;

    /// Two crossed strips of cells, one upright through the other: each row of the upright one is
    /// cut once by the plane, on both halves of the cells where it passes.
    #[test]
    fn crossed_strips_are_counted_and_parted_ones_are_not() {
        let compiled = rectangles(2, [4, 4], 0.01, fabric(1e-5));
        let half = compiled.particles.len() / 2;
        let place = |gap: f64| -> Vec<V> {
            compiled
                .particles
                .iter()
                .enumerate()
                .map(|(i, [u, v])| {
                    if i < half {
                        V::new(*u, 0.0, *v)
                    } else {
                        V::new(0.0113 + 0.1 * (v - 0.0211), v - 0.0211 + gap, 0.003 + 0.7 * u)
                    }
                })
                .collect()
        };
        assert!(count(&compiled, &place(0.0)) >= 4);
        assert_eq!(count(&compiled, &place(0.05)), 0);
    }
}
