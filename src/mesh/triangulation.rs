//! A constrained Delaunay triangulation of the band, told apart from what lies beside it.

use crate::geometry::polygon::Place;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation as _};

/// What a fixed side borders; all have the cloth on their left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The cut line: band on its left, nothing on its right.
    Outline,
    /// An intact cell on its left, band on its right.
    Cell,
    /// An intact cell that reaches the cut line on its left, nothing on its right.
    CellAtOutline,
}

/// No triangle lies across this side.
pub const NONE: u32 = u32::MAX;

/// The triangles of a band, anticlockwise.
#[derive(Clone, Debug, Default)]
pub struct Triangulation {
    /// Corners.
    pub triangles: Vec<[u32; 3]>,
    /// The triangle across the side from corner k to corner k + 1; [`NONE`] at fixed sides.
    pub across: Vec<[u32; 3]>,
}

impl Triangulation {
    /// The Delaunay triangulation of `places` in which the given directed sides are kept,
    /// without the triangles that lie outside or on intact cells; `None` when places coincide or
    /// sides cross.
    pub fn new(places: &[Place], sides: &[([u32; 2], Side)]) -> Option<Self> {
        let points = places.iter().map(|&[x, y]| {
            // Denormal coordinates are refused by the triangulator.
            let flush = |x: f64| if x.abs() < 1e-100 { 0.0 } else { x };
            Point2::new(flush(x), flush(y))
        });
        let kept: Vec<_> = sides.iter().map(|(ends, _)| ends.map(|end| end as usize)).collect();
        let mut crossed = false;
        let delaunay = ConstrainedDelaunayTriangulation::<Point2<f64>>::try_bulk_load_cdt(
            points.collect(),
            kept,
            |_| crossed = true,
        )
        .ok()?;
        if crossed || delaunay.num_vertices() != places.len() {
            return None;
        }
        let all: Vec<[u32; 3]> = delaunay
            .inner_faces()
            .map(|face| face.vertices().map(|corner| corner.fix().index() as u32))
            .collect();
        Some(keep_band(all, sides))
    }
}

/// The sides of triangles, sorted: (from, to, triangle, side).
fn sorted_sides(triangles: &[[u32; 3]]) -> Vec<(u32, u32, u32, u32)> {
    let mut sides = Vec::with_capacity(triangles.len() * 3);
    for (number, corners) in triangles.iter().enumerate() {
        for k in 0..3 {
            sides.push((corners[k], corners[(k + 1) % 3], number as u32, k as u32));
        }
    }
    sides.sort_unstable();
    sides
}

fn find(sides: &[(u32, u32, u32, u32)], from: u32, to: u32) -> Option<(u32, u32)> {
    let at = sides.partition_point(|side| (side.0, side.1) < (from, to));
    sides.get(at).filter(|side| (side.0, side.1) == (from, to)).map(|side| (side.2, side.3))
}

fn keep_band(all: Vec<[u32; 3]>, fixed: &[([u32; 2], Side)]) -> Triangulation {
    let sorted = sorted_sides(&all);
    let mut across = vec![[NONE; 3]; all.len()];
    for &(from, to, triangle, side) in &sorted {
        if let Some((other, _)) = find(&sorted, to, from) {
            across[triangle as usize][side as usize] = other;
        }
    }
    // Fixed sides part the plane; what lies left and right of them is known.
    let mut band: Vec<Option<bool>> = vec![None; all.len()];
    let mut waiting = Vec::new();
    for &([from, to], side) in fixed {
        for (from, to, in_band) in
            [(from, to, side == Side::Outline), (to, from, side == Side::Cell)]
        {
            if let Some((triangle, k)) = find(&sorted, from, to) {
                across[triangle as usize][k as usize] = NONE;
                waiting.push((triangle, in_band));
            }
        }
    }
    while let Some((triangle, in_band)) = waiting.pop() {
        let known = &mut band[triangle as usize];
        if known.is_some() {
            continue;
        }
        *known = Some(in_band);
        let others = across[triangle as usize].into_iter().filter(|&other| other != NONE);
        waiting.extend(others.map(|other| (other, in_band)));
    }
    let mut number = vec![NONE; all.len()];
    let mut kept = Triangulation::default();
    for (triangle, corners) in all.iter().enumerate() {
        if band[triangle] == Some(true) {
            number[triangle] = kept.triangles.len() as u32;
            kept.triangles.push(*corners);
        }
    }
    for triangle in (0..all.len()).filter(|&t| number[t] != NONE) {
        kept.across.push(across[triangle].map(|other| match other {
            NONE => NONE,
            other => number[other as usize],
        }));
    }
    kept
}
