//! A tree of boxes over the triangles of one closed surface.

use super::triangle::{Feature, nearest};
use crate::body::surface::Surface;
use nalgebra::{Point3, Vector3};
use std::collections::BTreeMap;

/// Most triangles in a leaf.
const LEAF: usize = 4;

/// One box: either two children, or triangles `start..start + count`.
#[derive(Clone, Debug)]
struct Node {
    low: [f64; 3],
    high: [f64; 3],
    /// Leaves: first triangle. Others: number of the right child (the left one follows directly).
    start: u32,
    /// Triangles in a leaf; 0 for the others.
    count: u32,
}

/// A nearest place on the surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hit {
    /// Square of the distance, m².
    pub(super) square: f64,
    /// Place, m.
    pub(super) at: Point3<f64>,
    /// Number of the triangle as the surface counts it.
    pub(super) triangle: u32,
    /// Weights at its corners.
    pub(super) weights: [f64; 3],
    /// Position in the tree's own order.
    slot: usize,
    feature: Feature,
}

/// Boxes, triangles in the order of the leaves, and the normals that decide inside or outside.
#[derive(Clone, Debug)]
pub(super) struct Tree {
    nodes: Vec<Node>,
    corners: Vec<[Point3<f64>; 3]>,
    numbers: Vec<u32>,
    /// Slot of each triangle of the surface.
    slots: Vec<u32>,
    /// Per slot: normals of the face, its three edges, its three corners.
    normals: Vec<[Vector3<f64>; 7]>,
}

impl Tree {
    /// Builds the tree; triangles that name missing vertices are left out.
    pub(super) fn new(surface: &Surface) -> Tree {
        let vertex = |i: u32| surface.vertices.get(i as usize).copied();
        let mut items: Vec<(u32, [Point3<f64>; 3], Point3<f64>)> = Vec::new();
        for (number, [a, b, c]) in surface.triangles.iter().enumerate() {
            if let (Some(a), Some(b), Some(c)) = (vertex(*a), vertex(*b), vertex(*c)) {
                let middle = Point3::from((a.coords + b.coords + c.coords) / 3.0);
                items.push((u32::try_from(number).unwrap_or(u32::MAX), [a, b, c], middle));
            }
        }
        let pseudo = pseudonormals(surface);
        let mut nodes = Vec::with_capacity(items.len());
        if !items.is_empty() {
            build(&mut items, 0, &mut nodes);
        }
        let mut slots = vec![u32::MAX; surface.triangles.len()];
        for (slot, (number, ..)) in items.iter().enumerate() {
            slots[*number as usize] = u32::try_from(slot).unwrap_or(u32::MAX);
        }
        Tree {
            nodes,
            normals: items.iter().map(|(number, ..)| pseudo[*number as usize]).collect(),
            numbers: items.iter().map(|(number, ..)| *number).collect(),
            corners: items.into_iter().map(|(_, corners, _)| corners).collect(),
            slots,
        }
    }

    /// The nearest place to `p` that is nearer than the root of `limit` (m²). `hint` is a triangle
    /// that is likely to be near and makes the search shorter; it does not change the distance.
    pub(super) fn nearest(&self, p: Point3<f64>, limit: f64, hint: Option<u32>) -> Option<Hit> {
        let mut best: Option<Hit> = None;
        let mut bound = limit;
        let mut try_slot = |slot: usize, bound: &mut f64| {
            let (at, weights, feature) = nearest(p, self.corners[slot]);
            let square = (p - at).norm_squared();
            // Ties go to the lower number, so the answer does not hang on the hint.
            let number = self.numbers[slot];
            let better = square < *bound
                || (square == *bound && best.is_some_and(|b: Hit| number < b.triangle));
            if better {
                *bound = square;
                best = Some(Hit { square, at, triangle: number, weights, slot, feature });
            }
        };
        if let Some(slot) = hint.and_then(|h| self.slots.get(h as usize))
            && *slot != u32::MAX
        {
            try_slot(*slot as usize, &mut bound);
        }
        let mut stack = [(0_u32, 0.0_f64); 96];
        let mut depth = 0;
        if let Some(root) = self.nodes.first() {
            stack[0] = (0, root.gap(p));
            depth = 1;
        }
        while depth > 0 {
            depth -= 1;
            let (index, gap) = stack[depth];
            if gap > bound {
                continue;
            }
            let node = &self.nodes[index as usize];
            if node.count > 0 {
                let start = node.start as usize;
                for slot in start..start + node.count as usize {
                    try_slot(slot, &mut bound);
                }
                continue;
            }
            let (left, right) = (index + 1, node.start);
            let (gap_left, gap_right) =
                (self.nodes[left as usize].gap(p), self.nodes[right as usize].gap(p));
            let (near, far) = if gap_left <= gap_right {
                ((left, gap_left), (right, gap_right))
            } else {
                ((right, gap_right), (left, gap_left))
            };
            // The halves are split at the middle item, so the depth stays below 2 log2(2³²).
            for entry in [far, near] {
                if entry.1 <= bound {
                    stack[depth] = entry;
                    depth += 1;
                }
            }
        }
        best
    }

    /// The normal that tells the sides apart at a hit: of its face, edge or corner.
    pub(super) fn pseudonormal(&self, hit: &Hit) -> Vector3<f64> {
        let normals = &self.normals[hit.slot];
        match hit.feature {
            Feature::Face => normals[0],
            Feature::Edge(k) => normals[1 + k],
            Feature::Corner(k) => normals[4 + k],
        }
    }

    /// Whether a box round everything, grown by `margin`, holds `p`.
    pub(super) fn may_hold(&self, p: Point3<f64>, margin: f64) -> bool {
        self.nodes.first().is_some_and(|root| root.gap(p) <= margin * margin)
    }
}

impl Node {
    /// Square of the distance from `p` to the box, m².
    fn gap(&self, p: Point3<f64>) -> f64 {
        let mut sum = 0.0;
        for k in 0..3 {
            let d = (self.low[k] - p[k]).max(p[k] - self.high[k]).max(0.0);
            sum += d * d;
        }
        sum
    }
}

/// Splits the items at the middle of the longest side of their centres' box.
fn build(
    items: &mut [(u32, [Point3<f64>; 3], Point3<f64>)],
    offset: usize,
    nodes: &mut Vec<Node>,
) -> usize {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    let (mut first, mut last) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for (_, corners, middle) in items.iter() {
        for k in 0..3 {
            for corner in corners {
                low[k] = low[k].min(corner[k]);
                high[k] = high[k].max(corner[k]);
            }
            first[k] = first[k].min(middle[k]);
            last[k] = last[k].max(middle[k]);
        }
    }
    let index = nodes.len();
    let count = items.len();
    nodes.push(Node {
        low,
        high,
        start: u32::try_from(offset).unwrap_or(u32::MAX),
        count: if count <= LEAF { u32::try_from(count).unwrap_or(u32::MAX) } else { 0 },
    });
    if count > LEAF {
        let axis = (0..3)
            .max_by(|a, b| (last[*a] - first[*a]).total_cmp(&(last[*b] - first[*b])))
            .unwrap_or(0);
        let half = count / 2;
        items.select_nth_unstable_by(half, |a, b| {
            a.2[axis].total_cmp(&b.2[axis]).then(a.0.cmp(&b.0))
        });
        let (left, right) = items.split_at_mut(half);
        build(left, offset, nodes);
        let right_index = build(right, offset + half, nodes);
        nodes[index].start = u32::try_from(right_index).unwrap_or(u32::MAX);
    }
    index
}

/// Normals of each triangle's face, edges and corners whose side decides inside and outside.
///
/// # References
/// Bærentzen and Aanæs 2005, "Signed distance computation using the angle weighted pseudonormal".
fn pseudonormals(surface: &Surface) -> Vec<[Vector3<f64>; 7]> {
    let vertex = |i: u32| surface.vertices.get(i as usize).copied().unwrap_or_default();
    let mut at_corner = vec![Vector3::zeros(); surface.vertices.len()];
    let mut at_edge: BTreeMap<(u32, u32), Vector3<f64>> = BTreeMap::new();
    let mut faces = Vec::with_capacity(surface.triangles.len());
    for triangle in &surface.triangles {
        let [a, b, c] = triangle.map(vertex);
        let normal = (b - a).cross(&(c - a)).try_normalize(0.0).unwrap_or_else(Vector3::zeros);
        faces.push(normal);
        let corners = [a, b, c];
        for k in 0..3 {
            let (i, j) = (triangle[k], triangle[(k + 1) % 3]);
            *at_edge.entry((i.min(j), i.max(j))).or_insert_with(Vector3::zeros) += normal;
            let (to, from) = (corners[(k + 1) % 3] - corners[k], corners[(k + 2) % 3] - corners[k]);
            let angle = libm::atan2(to.cross(&from).norm(), to.dot(&from));
            if let Some(sum) = at_corner.get_mut(i as usize) {
                *sum += normal * angle;
            }
        }
    }
    surface
        .triangles
        .iter()
        .zip(faces)
        .map(|(triangle, face)| {
            let edge = |k: usize| {
                let (i, j) = (triangle[k], triangle[(k + 1) % 3]);
                at_edge.get(&(i.min(j), i.max(j))).copied().unwrap_or(face)
            };
            let corner = |k: usize| at_corner.get(triangle[k] as usize).copied().unwrap_or(face);
            [face, edge(0), edge(1), edge(2), corner(0), corner(1), corner(2)]
        })
        .collect()
}
