//! A tree of boxes over the triangles of one closed surface.

use super::triangle::{Feature, nearest};
use crate::body::surface::Surface;
use nalgebra::{Point3, Vector3};
use std::collections::BTreeMap;

/// Most triangles in a leaf.
const LEAF: usize = 4;

/// A box as its lower and upper corner, rounded outwards to single precision.
type Extent = [f32; 6];

/// Two children with their boxes, in one line of the cache.
#[derive(Clone, Copy, Debug)]
struct Node {
    extents: [Extent; 2],
    children: [Child; 2],
}

/// A node by its number, or a leaf: the slots from `start` on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Child {
    start: u32,
    /// Triangles in a leaf; 0 for a node.
    count: u32,
}

/// A triangle on its way into the tree: its number, its corners, its middle.
type Item = (u32, [Point3<f64>; 3], Point3<f64>);

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
    root: Option<(Extent, Child)>,
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
        let mut items: Vec<Item> = Vec::new();
        for (number, [a, b, c]) in surface.triangles.iter().enumerate() {
            if let (Some(a), Some(b), Some(c)) = (vertex(*a), vertex(*b), vertex(*c)) {
                let middle = Point3::from((a.coords + b.coords + c.coords) / 3.0);
                items.push((u32::try_from(number).unwrap_or(u32::MAX), [a, b, c], middle));
            }
        }
        let pseudo = pseudonormals(surface);
        let mut nodes = Vec::with_capacity(items.len());
        let root = (!items.is_empty()).then(|| build(&mut items, 0, &mut nodes));
        let mut slots = vec![u32::MAX; surface.triangles.len()];
        for (slot, (number, ..)) in items.iter().enumerate() {
            slots[*number as usize] = u32::try_from(slot).unwrap_or(u32::MAX);
        }
        Tree {
            root,
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
        // The halves are split at the middle item, so the tree is no deeper than 32.
        let mut stack = [(Child { start: 0, count: 0 }, 0.0_f64); 40];
        let mut depth = 0;
        if let Some((extent, child)) = &self.root {
            stack[0] = (*child, gap(extent, p));
            depth = 1;
        }
        while depth > 0 {
            depth -= 1;
            let (child, near) = stack[depth];
            if near > bound {
                continue;
            }
            if child.count > 0 {
                let start = child.start as usize;
                for slot in start..start + child.count as usize {
                    try_slot(slot, &mut bound);
                }
                continue;
            }
            let node = &self.nodes[child.start as usize];
            let gaps = [gap(&node.extents[0], p), gap(&node.extents[1], p)];
            let first = usize::from(gaps[1] < gaps[0]);
            for k in [1 - first, first] {
                if gaps[k] <= bound {
                    stack[depth] = (node.children[k], gaps[k]);
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
        self.root.is_some_and(|(extent, _)| gap(&extent, p) <= margin * margin)
    }
}

/// Square of the distance from `p` to a box, m².
fn gap(extent: &Extent, p: Point3<f64>) -> f64 {
    let mut sum = 0.0;
    for k in 0..3 {
        let (low, high) = (f64::from(extent[k]), f64::from(extent[k + 3]));
        let d = (low - p[k]).max(p[k] - high).max(0.0);
        sum += d * d;
    }
    sum
}

/// The box of some triangles.
fn extent(items: &[Item]) -> Extent {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for corner in items.iter().flat_map(|(_, corners, _)| corners) {
        for k in 0..3 {
            low[k] = low[k].min(corner[k]);
            high[k] = high[k].max(corner[k]);
        }
    }
    std::array::from_fn(|k| {
        if k < 3 { (low[k] as f32).next_down() } else { (high[k - 3] as f32).next_up() }
    })
}

/// Splits the items at the middle of the longest side of their centres' box.
fn build(items: &mut [Item], offset: usize, nodes: &mut Vec<Node>) -> (Extent, Child) {
    let extent = extent(items);
    let count = items.len();
    let number = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
    if count <= LEAF {
        return (extent, Child { start: number(offset), count: number(count) });
    }
    let (mut first, mut last) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for (_, _, middle) in items.iter() {
        for k in 0..3 {
            first[k] = first[k].min(middle[k]);
            last[k] = last[k].max(middle[k]);
        }
    }
    let axis = (0..3)
        .max_by(|a, b| (last[*a] - first[*a]).total_cmp(&(last[*b] - first[*b])))
        .unwrap_or(0);
    let half = count / 2;
    items.select_nth_unstable_by(half, |a, b| a.2[axis].total_cmp(&b.2[axis]).then(a.0.cmp(&b.0)));
    let index = nodes.len();
    let nothing = Child { start: 0, count: 0 };
    nodes.push(Node { extents: [extent; 2], children: [nothing; 2] });
    let (left, right) = items.split_at_mut(half);
    let (left_extent, left_child) = build(left, offset, nodes);
    let (right_extent, right_child) = build(right, offset + half, nodes);
    nodes[index] =
        Node { extents: [left_extent, right_extent], children: [left_child, right_child] };
    (extent, Child { start: number(index), count: 0 })
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
