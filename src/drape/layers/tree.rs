//! Which faces of a cloth may meet: a tree over the faces of each panel in the order of its plane, fitted
//! anew to their places when needed, never built anew.
//!
//! A piece of cloth whose normals all lie within a cone does not meet itself, and neither do two
//! pieces that border on each other and share such a cone (Volino and Magnenat-Thalmann 1994); most
//! of a cloth is passed over by that. The normals are taken at both ends of the movement looked at,
//! and the cone leaves room for what turns in between. That the rim of a piece does not cut itself
//! while its normals are so much alike is taken for granted.

use crate::drape::cloth::Cloth;
use nalgebra::Vector3;
use rayon::prelude::*;

type V = Vector3<f64>;

/// Faces that belong together: the two halves of a cell, or a triangle of a band.
const LEAF: usize = 2;

/// Least share of a common direction that all normals of a piece must have: 60° leave 30° for what
/// turns while a list of near pairs is kept.
const CONE: f32 = 0.5;

/// A box along the axes: lowest and highest of each.
#[derive(Clone, Copy, Debug)]
pub struct Extent {
    low: [f32; 3],
    high: [f32; 3],
}

impl Extent {
    const NOTHING: Extent = Extent { low: [f32::INFINITY; 3], high: [f32::NEG_INFINITY; 3] };

    fn hold(&mut self, place: [f32; 3]) {
        for k in 0..3 {
            self.low[k] = self.low[k].min(place[k]);
            self.high[k] = self.high[k].max(place[k]);
        }
    }

    /// The box that holds both.
    #[inline]
    pub fn join(&self, other: &Extent) -> Extent {
        let mut joined = *self;
        joined.hold(other.low);
        joined.hold(other.high);
        joined
    }

    /// Whether two boxes have a place in common.
    #[inline]
    pub fn meets(&self, other: &Extent) -> bool {
        let mut meets = true;
        for k in 0..3 {
            meets &= self.low[k] <= other.high[k] && other.low[k] <= self.high[k];
        }
        meets
    }

    /// The box of a way between two places, widened by a margin.
    #[allow(clippy::cast_possible_truncation)]
    pub fn of_way(from: &V, way: &V, margin: f64) -> Extent {
        let mut e = Extent::NOTHING;
        // Rounding to single precision is covered by the margin's last part.
        let margin = margin + 1e-6;
        for k in 0..3 {
            let (a, b) = (from[k], from[k] + way[k]);
            e.low[k] = (a.min(b) - margin) as f32;
            e.high[k] = (a.max(b) + margin) as f32;
        }
        e
    }

    /// Whether the directions in this box (of unit vectors) lie within the cone.
    #[inline]
    fn is_narrow(&self) -> bool {
        let mut middle = [0.0f32; 3];
        let mut square = 0.0;
        for k in 0..3 {
            middle[k] = 0.5 * (self.low[k] + self.high[k]);
            square += middle[k] * middle[k];
        }
        let mut spread = 0.0;
        for k in 0..3 {
            spread += 0.5 * (self.high[k] - self.low[k]) * middle[k].abs();
        }
        // (|c|² − Σ half |c|) / |c| > CONE
        square > spread && (square - spread) * (square - spread) > CONE * CONE * square
    }
}

/// A node of the tree.
#[derive(Clone, Copy, Debug)]
struct Node {
    /// Children, or the first face and one past the last of a leaf.
    range: [u32; 2],
    leaf: bool,
    /// Its panel; `u32::MAX` for nodes above the panels.
    panel: u32,
    /// `[u0, v0, u1, v1]` of its faces, m.
    plane: [f32; 4],
    /// Faces below it.
    size: u32,
}

/// The tree over all faces of a cloth.
#[derive(Clone, Debug, Default)]
pub struct Tree {
    /// Children come after their parents.
    nodes: Vec<Node>,
    /// Faces in the order of the leaves.
    order: Vec<u32>,
    boxes: Vec<Extent>,
    normals: Vec<Extent>,
}

/// A face as the tree is built from it.
#[derive(Clone, Copy)]
struct Item {
    face: u32,
    middle: [f32; 2],
    plane: [f32; 4],
}

impl Tree {
    /// Builds the tree.
    pub fn new(cloth: &Cloth) -> Self {
        let mut tree = Tree::default();
        let mut panels: Vec<Vec<Item>> = Vec::new();
        for (face, (panel, plane)) in cloth.face_places.iter().enumerate() {
            let panel = *panel as usize;
            if panels.len() <= panel {
                panels.resize(panel + 1, Vec::new());
            }
            let [a, b, c] = cloth.faces[face];
            if a == b || b == c || c == a {
                continue;
            }
            let middle = [0.5 * (plane[0] + plane[2]), 0.5 * (plane[1] + plane[3])];
            panels[panel].push(Item { face: face as u32, middle, plane: *plane });
        }
        let mut groups: Vec<(u32, Vec<Item>)> =
            panels.into_iter().enumerate().map(|(p, items)| (p as u32, items)).collect();
        groups.retain(|g| !g.1.is_empty());
        if !groups.is_empty() {
            tree.above(&mut groups);
        }
        tree.boxes = vec![Extent::NOTHING; tree.nodes.len()];
        tree.normals = vec![Extent::NOTHING; tree.nodes.len()];
        tree
    }

    fn push(&mut self, node: Node) -> usize {
        self.nodes.push(node);
        self.nodes.len() - 1
    }

    fn above(&mut self, groups: &mut [(u32, Vec<Item>)]) -> usize {
        if let [(panel, items)] = groups {
            return self.below(*panel, items);
        }
        let size = groups.iter().map(|g| g.1.len()).sum::<usize>() as u32;
        let node = Node { range: [0; 2], leaf: false, panel: u32::MAX, plane: [0.0; 4], size };
        let own = self.push(node);
        let (left, right) = groups.split_at_mut(groups.len() / 2);
        let children = [self.above(left), self.above(right)];
        self.nodes[own].range = children.map(|c| c as u32);
        own
    }

    fn below(&mut self, panel: u32, items: &mut [Item]) -> usize {
        let mut plane = [f32::INFINITY, f32::INFINITY, f32::NEG_INFINITY, f32::NEG_INFINITY];
        let mut middles = plane;
        for item in items.iter() {
            for k in 0..2 {
                plane[k] = plane[k].min(item.plane[k]);
                plane[k + 2] = plane[k + 2].max(item.plane[k + 2]);
                middles[k] = middles[k].min(item.middle[k]);
                middles[k + 2] = middles[k + 2].max(item.middle[k]);
            }
        }
        let size = items.len() as u32;
        let first = self.order.len() as u32;
        let node = Node { range: [first, first + size], leaf: true, panel, plane, size };
        let own = self.push(node);
        if items.len() <= LEAF {
            self.order.extend(items.iter().map(|i| i.face));
            return own;
        }
        let axis = usize::from(middles[3] - middles[1] > middles[2] - middles[0]);
        items.sort_by(|a, b| a.middle[axis].total_cmp(&b.middle[axis]).then(a.face.cmp(&b.face)));
        // Halves of the plane rather than of the number keep the pieces square; the two halves
        // of a cell have one middle and stay together.
        let half = 0.5 * (middles[axis] + middles[axis + 2]);
        let mut cut = items.partition_point(|i| i.middle[axis] < half);
        if cut == 0 || cut == items.len() {
            cut = items.len() / 2;
        }
        let (left, right) = items.split_at_mut(cut);
        let children = [self.below(panel, left), self.below(panel, right)];
        let node = &mut self.nodes[own];
        node.leaf = false;
        node.range = children.map(|c| c as u32);
        own
    }

    /// Fits the tree to knots at `x` that move by `way`; `reach` are the knots' boxes.
    #[allow(clippy::cast_possible_truncation)]
    pub fn fit(&mut self, faces: &[[u32; 3]], x: &[V], way: &[V], reach: &[Extent]) {
        for n in (0..self.nodes.len()).rev() {
            let node = self.nodes[n];
            if node.leaf {
                let (mut e, mut normals) = (Extent::NOTHING, Extent::NOTHING);
                for &f in &self.order[node.range[0] as usize..node.range[1] as usize] {
                    let corners = faces[f as usize].map(|k| k as usize);
                    for k in corners {
                        e = e.join(&reach[k]);
                    }
                    let [a, b, c] = corners.map(|k| x[k]);
                    let [p, q, r] = corners.map(|k| x[k] + way[k]);
                    for normal in [(b - a).cross(&(c - a)), (q - p).cross(&(r - p))] {
                        let n = normal / normal.norm().max(1e-30);
                        normals.hold([n.x as f32, n.y as f32, n.z as f32]);
                    }
                }
                (self.boxes[n], self.normals[n]) = (e, normals);
            } else {
                let [a, b] = node.range.map(|c| c as usize);
                self.boxes[n] = self.boxes[a].join(&self.boxes[b]);
                self.normals[n] = self.normals[a].join(&self.normals[b]);
            }
        }
    }

    /// Whether a node cannot meet itself.
    fn is_calm(&self, n: usize) -> bool {
        self.nodes[n].panel != u32::MAX && self.normals[n].is_narrow()
    }

    /// Whether two nodes border on each other and cannot meet.
    fn is_smooth(&self, a: usize, b: usize) -> bool {
        let (p, q) = (&self.nodes[a], &self.nodes[b]);
        if p.panel != q.panel || p.panel == u32::MAX {
            return false;
        }
        let slack = 1e-6;
        let borders = (0..2)
            .all(|k| p.plane[k] <= q.plane[k + 2] + slack && q.plane[k] <= p.plane[k + 2] + slack);
        borders && self.normals[a].join(&self.normals[b]).is_narrow()
    }

    /// One step down from a pair of nodes; gives whether it is a pair of leaves that may meet.
    fn step(&self, (a, b): (u32, u32), to: &mut Vec<(u32, u32)>) -> bool {
        let (i, j) = (a as usize, b as usize);
        if a == b {
            let node = &self.nodes[i];
            if !node.leaf && !self.is_calm(i) {
                let [l, r] = node.range;
                to.extend([(r, r), (l, r), (l, l)]);
            }
            return false;
        }
        if !self.boxes[i].meets(&self.boxes[j]) || self.is_smooth(i, j) {
            return false;
        }
        let (p, q) = (&self.nodes[i], &self.nodes[j]);
        if p.leaf && q.leaf {
            return true;
        }
        if q.leaf || (!p.leaf && p.size >= q.size) {
            to.extend([(p.range[1], b), (p.range[0], b)]);
        } else {
            to.extend([(a, q.range[1]), (a, q.range[0])]);
        }
        false
    }

    /// Calls `found` for all pairs of leaves that may meet, with the faces of both, and gives
    /// what it found in an order that does not depend on threads.
    pub fn pairs<T: Send>(&self, found: impl Fn(&[u32], &[u32], &mut Vec<T>) + Sync) -> Vec<T> {
        if self.nodes.is_empty() {
            return Vec::new();
        }
        let leaf = |n: u32| {
            let [first, last] = self.nodes[n as usize].range;
            &self.order[first as usize..last as usize]
        };
        // A front of pairs wide enough to be shared out.
        let mut front = vec![(0u32, 0u32)];
        let mut below = Vec::new();
        for _ in 0..16 {
            if front.len() >= 64 {
                break;
            }
            let mut next = Vec::new();
            for pair in front {
                below.clear();
                if self.step(pair, &mut below) {
                    next.push(pair);
                } else {
                    next.extend(below.iter().rev());
                }
            }
            front = next;
        }
        let parts: Vec<Vec<T>> = front
            .into_par_iter()
            .map(|seed| {
                let mut stack = vec![seed];
                let mut list = Vec::new();
                while let Some(pair) = stack.pop() {
                    if self.step(pair, &mut stack) {
                        found(leaf(pair.0), leaf(pair.1), &mut list);
                    }
                }
                list
            })
            .collect();
        parts.into_iter().flatten().collect()
    }
}
