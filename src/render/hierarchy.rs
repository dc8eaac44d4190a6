//! A hierarchy of boxes over triangles, and the rays that go through it.
//!
//! The `bvh` crate splits the triangles by surface area. Its binary tree is then folded into nodes
//! of four boxes and leaves of four triangles, stored component by component, so that one pass
//! of the processor's vector unit tests all four.

use super::Vector;
use bvh::aabb::{Aabb, Bounded};
use bvh::bounding_hierarchy::{BHShape, BoundingHierarchy};
use bvh::bvh::{Bvh, BvhNode};
use nalgebra::Point3;

/// A straight line of light.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    /// Where it starts, m.
    pub origin: Vector,
    /// Where it goes; unit length.
    pub direction: Vector,
    /// How far it goes, m.
    pub reach: f32,
}

/// Where a ray meets a triangle.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    /// Distance along the ray, m.
    pub distance: f32,
    /// Number of the triangle.
    pub triangle: u32,
    /// Share of its second corner.
    pub u: f32,
    /// Share of its third corner.
    pub v: f32,
    packet: u32,
    lane: u32,
}

/// Room for the nodes that are still to be visited; one for each worker.
pub type Stack = Vec<(f32, u32)>;

/// Four boxes and what is in them.
#[derive(Clone, Debug)]
struct Node {
    low: [[f32; 4]; 3],
    high: [[f32; 4]; 3],
    child: [u32; 4],
}

/// Four triangles: a corner and two edges, component by component.
#[derive(Clone, Debug, Default)]
struct Packet {
    corner: [[f32; 4]; 3],
    first: [[f32; 4]; 3],
    second: [[f32; 4]; 3],
    number: [u32; 4],
}

/// Marks a child that is a packet.
const LEAF: u32 = 1 << 31;

/// Nothing there.
const NONE: u32 = u32::MAX;

/// Triangles in a leaf.
const WIDTH: usize = 4;

/// Slack in the shares of the corners, so that rounding opens no crack between neighbours: the
/// rounding of a place some metres from the origin against an edge of a millimetre.
const SLACK: f32 = 5e-4;

/// The hierarchy.
#[derive(Clone, Debug, Default)]
pub struct Hierarchy {
    nodes: Vec<Node>,
    packets: Vec<Packet>,
}

/// A triangle as the `bvh` crate wants it.
struct Boxed {
    bounds: Aabb<f32, 3>,
    node: usize,
}

impl Bounded<f32, 3> for Boxed {
    fn aabb(&self) -> Aabb<f32, 3> {
        self.bounds
    }
}

impl BHShape<f32, 3> for Boxed {
    fn set_bh_node_index(&mut self, index: usize) {
        self.node = index;
    }

    fn bh_node_index(&self) -> usize {
        self.node
    }
}

impl Hierarchy {
    /// Over `triangles`, each of three finite places. A triangle's number is its place in the list.
    pub fn over(triangles: &[[Vector; 3]]) -> Self {
        let mut boxed: Vec<Boxed> = triangles
            .iter()
            .map(|[a, b, c]| Boxed {
                bounds: Aabb::with_bounds(
                    Point3::from(a.inf(b).inf(c)),
                    Point3::from(a.sup(b).sup(c)),
                ),
                node: 0,
            })
            .collect();
        let binary = Bvh::build_par(&mut boxed);
        let mut hierarchy = Hierarchy::default();
        if !binary.nodes.is_empty() {
            let mut fold = Fold { binary: &binary.nodes, triangles, hierarchy: &mut hierarchy };
            fold.root();
        }
        hierarchy
    }

    /// The nearest triangle on the ray's way for which `solid` holds (it is given the triangle's
    /// number, the shares of its second and third corner, and the distance). The last for which
    /// it was asked and held is the one.
    pub fn nearest(
        &self,
        ray: &Ray,
        stack: &mut Stack,
        mut solid: impl FnMut(u32, f32, f32, f32) -> bool,
    ) -> Option<Hit> {
        let mut best: Option<Hit> = None;
        let mut reach = ray.reach;
        self.visit(ray, stack, &mut |index, packet| {
            let met = packet.meet(ray, reach);
            let mut open = [true; WIDTH];
            loop {
                // The nearest of the lanes that have not been found open.
                let mut lane = WIDTH;
                for l in 0..WIDTH {
                    if open[l] && met.distance[l] < reach {
                        let nearer = lane == WIDTH || met.distance[l] < met.distance[lane];
                        if nearer {
                            lane = l;
                        }
                    }
                }
                if lane == WIDTH {
                    return Some(reach);
                }
                if solid(packet.number[lane], met.u[lane], met.v[lane], met.distance[lane]) {
                    reach = met.distance[lane];
                    best = Some(Hit {
                        distance: reach,
                        triangle: packet.number[lane],
                        u: met.u[lane],
                        v: met.v[lane],
                        packet: index,
                        lane: lane as u32,
                    });
                    return Some(reach);
                }
                open[lane] = false;
            }
        });
        best
    }

    /// Whether a triangle for which `solid` holds stands in the ray's way.
    pub fn blocked(
        &self,
        ray: &Ray,
        stack: &mut Stack,
        solid: impl Fn(u32, f32, f32, f32) -> bool,
    ) -> bool {
        let mut blocked = false;
        self.visit(ray, stack, &mut |_, packet| {
            let met = packet.meet(ray, ray.reach);
            for l in 0..WIDTH {
                let (number, distance) = (packet.number[l], met.distance[l]);
                if distance < ray.reach && solid(number, met.u[l], met.v[l], distance) {
                    blocked = true;
                    return None;
                }
            }
            Some(ray.reach)
        });
        blocked
    }

    /// The place of a hit and the unit normal of its triangle (by the order of its corners).
    pub fn place(&self, hit: &Hit) -> (Vector, Vector) {
        let packet = &self.packets[hit.packet as usize];
        let l = hit.lane as usize;
        let take = |a: &[[f32; 4]; 3]| Vector::new(a[0][l], a[1][l], a[2][l]);
        let (first, second) = (take(&packet.first), take(&packet.second));
        let normal = first.cross(&second);
        let length = normal.norm();
        (take(&packet.corner) + first * hit.u + second * hit.v, normal / length.max(1e-30))
    }

    /// Hands the packets along the ray to `meet`, nearest boxes first; `meet` answers how far the
    /// ray still goes, or none to stop.
    fn visit(
        &self,
        ray: &Ray,
        stack: &mut Stack,
        meet: &mut impl FnMut(u32, &Packet) -> Option<f32>,
    ) {
        stack.clear();
        if self.nodes.is_empty() {
            return;
        }
        let slab = Slab::new(ray);
        let mut reach = ray.reach;
        let mut next = 0_u32;
        loop {
            if next & LEAF != 0 {
                let index = next & !LEAF;
                match meet(index, &self.packets[index as usize]) {
                    Some(left) => reach = left,
                    None => return,
                }
            } else {
                let node = &self.nodes[next as usize];
                let near = slab.enter(node, reach);
                let from = stack.len();
                for l in 0..WIDTH {
                    if near[l] < reach {
                        stack.push((near[l], node.child[l]));
                        // Nearest last: it is taken next.
                        let mut at = stack.len() - 1;
                        while at > from && stack[at - 1].0 < stack[at].0 {
                            stack.swap(at - 1, at);
                            at -= 1;
                        }
                    }
                }
            }
            loop {
                match stack.pop() {
                    None => return,
                    Some((near, child)) if near < reach => {
                        next = child;
                        break;
                    }
                    Some(_) => {}
                }
            }
        }
    }
}

/// A ray prepared for boxes.
struct Slab {
    origin: [f32; 3],
    inverse: [f32; 3],
}

impl Slab {
    fn new(ray: &Ray) -> Self {
        let mut slab = Slab { origin: [0.0; 3], inverse: [0.0; 3] };
        for axis in 0..3 {
            let d = ray.direction[axis];
            // A ray along a face must not make 0 · ∞.
            let d = if d.abs() < 1e-12 { if d < 0.0 { -1e-12 } else { 1e-12 } } else { d };
            slab.origin[axis] = ray.origin[axis];
            slab.inverse[axis] = 1.0 / d;
        }
        slab
    }

    /// Where the ray enters each box; infinity for those that it misses.
    #[inline(always)]
    fn enter(&self, node: &Node, reach: f32) -> [f32; 4] {
        let mut near = [0.0_f32; 4];
        let mut far = [reach; 4];
        for axis in 0..3 {
            let (origin, inverse) = (self.origin[axis], self.inverse[axis]);
            let (enter, leave) = if inverse < 0.0 {
                (&node.high[axis], &node.low[axis])
            } else {
                (&node.low[axis], &node.high[axis])
            };
            for l in 0..4 {
                let a = (enter[l] - origin) * inverse;
                let b = (leave[l] - origin) * inverse;
                near[l] = if a > near[l] { a } else { near[l] };
                far[l] = if b < far[l] { b } else { far[l] };
            }
        }
        let mut at = [f32::INFINITY; 4];
        for l in 0..4 {
            // A hair of slack for the rounding of the products.
            at[l] = if near[l] <= far[l] * 1.000_001 { near[l] } else { f32::INFINITY };
        }
        at
    }
}

/// Distances and corner shares of four triangles; infinity for those that are missed.
struct Met {
    distance: [f32; 4],
    u: [f32; 4],
    v: [f32; 4],
}

impl Packet {
    /// Meets four triangles at once (T. Möller and B. Trumbore 1997).
    #[inline(always)]
    fn meet(&self, ray: &Ray, reach: f32) -> Met {
        let (o, d) = (ray.origin, ray.direction);
        let mut met = Met { distance: [f32::INFINITY; 4], u: [0.0; 4], v: [0.0; 4] };
        let ([ax, ay, az], [bx, by, bz], [cx, cy, cz]) = (&self.corner, &self.first, &self.second);
        for l in 0..WIDTH {
            let px = d.y * cz[l] - d.z * cy[l];
            let py = d.z * cx[l] - d.x * cz[l];
            let pz = d.x * cy[l] - d.y * cx[l];
            let scale = 1.0 / (bx[l] * px + by[l] * py + bz[l] * pz);
            let (sx, sy, sz) = (o.x - ax[l], o.y - ay[l], o.z - az[l]);
            let qx = sy * bz[l] - sz * by[l];
            let qy = sz * bx[l] - sx * bz[l];
            let qz = sx * by[l] - sy * bx[l];
            let u = (sx * px + sy * py + sz * pz) * scale;
            let v = (d.x * qx + d.y * qy + d.z * qz) * scale;
            let t = (cx[l] * qx + cy[l] * qy + cz[l] * qz) * scale;
            let inside = (u >= -SLACK) & (v >= -SLACK) & (u + v <= 1.0 + SLACK);
            let inside = inside & (t > 0.0) & (t < reach);
            met.distance[l] = if inside { t } else { f32::INFINITY };
            met.u[l] = u;
            met.v[l] = v;
        }
        met
    }
}

/// Folds the binary tree four wide.
struct Fold<'a> {
    binary: &'a [BvhNode<f32, 3>],
    triangles: &'a [[Vector; 3]],
    hierarchy: &'a mut Hierarchy,
}

impl Fold<'_> {
    fn root(&mut self) {
        self.hierarchy.nodes.push(empty_node());
        let all = [0, usize::MAX, usize::MAX, usize::MAX];
        let children = if self.count(0) <= WIDTH { all } else { self.wide(0) };
        self.hierarchy.nodes[0] = self.node(children).0;
    }

    /// Triangles under a binary node, counted no further than is of interest.
    fn count(&self, mut at: usize) -> usize {
        let mut count = 0;
        loop {
            match &self.binary[at] {
                BvhNode::Leaf { .. } => return count + 1,
                BvhNode::Node { child_l_index, child_r_index, .. } => {
                    // The left subtree of k triangles takes 2k − 1 places.
                    count += (child_r_index - child_l_index).div_ceil(2);
                    if count > WIDTH {
                        return count;
                    }
                    at = *child_r_index;
                }
            }
        }
    }

    /// Up to four subtrees of a binary node, the largest opened first.
    fn wide(&self, at: usize) -> [usize; 4] {
        let mut children = [usize::MAX; 4];
        children[0] = at;
        let mut used = 1;
        while used < WIDTH {
            let mut pick: Option<(usize, f32)> = None;
            for (slot, &child) in children.iter().enumerate().take(used) {
                if self.count(child) <= WIDTH {
                    continue;
                }
                if let BvhNode::Node { child_l_aabb, child_r_aabb, .. } = &self.binary[child] {
                    let area = child_l_aabb.join(child_r_aabb).surface_area();
                    if pick.is_none_or(|(_, most)| area > most) {
                        pick = Some((slot, area));
                    }
                }
            }
            let Some((slot, _)) = pick else { break };
            if let BvhNode::Node { child_l_index, child_r_index, .. } = &self.binary[children[slot]]
            {
                children[slot] = *child_l_index;
                children[used] = *child_r_index;
                used += 1;
            }
        }
        children
    }

    /// A node over the given subtrees, and its box.
    fn node(&mut self, children: [usize; 4]) -> (Node, [Vector; 2]) {
        let mut node = empty_node();
        let mut whole = nothing();
        for (l, &child) in children.iter().enumerate() {
            if child == usize::MAX {
                continue;
            }
            let bounds = if self.count(child) <= WIDTH {
                let (index, bounds) = self.packet(child);
                node.child[l] = index | LEAF;
                bounds
            } else {
                let index = self.hierarchy.nodes.len();
                self.hierarchy.nodes.push(empty_node());
                let (below, bounds) = self.node(self.wide(child));
                self.hierarchy.nodes[index] = below;
                node.child[l] = index as u32;
                bounds
            };
            for axis in 0..3 {
                node.low[axis][l] = bounds[0][axis];
                node.high[axis][l] = bounds[1][axis];
            }
            whole = [whole[0].inf(&bounds[0]), whole[1].sup(&bounds[1])];
        }
        (node, whole)
    }

    /// A packet of the triangles under a binary node, and its box.
    fn packet(&mut self, at: usize) -> (u32, [Vector; 2]) {
        let mut found = Vec::with_capacity(WIDTH);
        self.gather(at, &mut found);
        let mut packet = Packet { number: [NONE; 4], ..Packet::default() };
        let mut whole = nothing();
        for (l, &number) in found.iter().enumerate() {
            let [a, b, c] = &self.triangles[number];
            for axis in 0..3 {
                packet.corner[axis][l] = a[axis];
                packet.first[axis][l] = b[axis] - a[axis];
                packet.second[axis][l] = c[axis] - a[axis];
            }
            packet.number[l] = number as u32;
            whole = [whole[0].inf(a).inf(b).inf(c), whole[1].sup(a).sup(b).sup(c)];
        }
        self.hierarchy.packets.push(packet);
        ((self.hierarchy.packets.len() - 1) as u32, whole)
    }

    fn gather(&self, at: usize, found: &mut Vec<usize>) {
        match &self.binary[at] {
            BvhNode::Leaf { shape_index, .. } => found.push(*shape_index),
            BvhNode::Node { child_l_index, child_r_index, .. } => {
                self.gather(*child_l_index, found);
                self.gather(*child_r_index, found);
            }
        }
    }
}

fn nothing() -> [Vector; 2] {
    [Vector::repeat(f32::INFINITY), Vector::repeat(f32::NEG_INFINITY)]
}

fn empty_node() -> Node {
    Node { low: [[f32::INFINITY; 4]; 3], high: [[f32::NEG_INFINITY; 4]; 3], child: [NONE; 4] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::sample::Sampler;

    /// Triangles strewn through a cube of 2 m, each some centimetres large.
    fn strewn(count: u32) -> Vec<[Vector; 3]> {
        let place = |i: u32, k: u32| {
            let [x, y] = Sampler::new(k, [i, 0], 0, 1).pair();
            let [z, _] = Sampler::new(k, [i, 9], 0, 1).pair();
            Vector::new(2.0 * x - 1.0, 2.0 * y - 1.0, 2.0 * z - 1.0)
        };
        (0..count)
            .map(|i| {
                let a = place(i, 0);
                [a, a + place(i, 1) * 0.1, a + place(i, 2) * 0.1]
            })
            .collect()
    }

    #[test]
    fn the_hierarchy_finds_what_a_look_at_every_triangle_finds() {
        for count in [0, 1, 3, 4, 5, 9, 700] {
            let triangles = strewn(count);
            let hierarchy = Hierarchy::over(&triangles);
            let mut stack = Stack::new();
            for path in 0..300 {
                let mut sampler = Sampler::new(9, [9, 9], path, 300);
                let ([a, b], [c, d]) = (sampler.pair(), sampler.pair());
                let origin = Vector::new(3.0 * a - 1.5, 3.0 * b - 1.5, 3.0);
                let direction = Vector::new(c - 0.5, d - 0.5, -1.5).normalize();
                let ray = Ray { origin, direction, reach: 100.0 };
                let mut nearest = f32::INFINITY;
                for [a, b, c] in &triangles {
                    let single = Hierarchy::over(&[[*a, *b, *c]]);
                    if let Some(hit) = single.nearest(&ray, &mut stack, |_, _, _, _| true) {
                        nearest = nearest.min(hit.distance);
                    }
                }
                let found = hierarchy.nearest(&ray, &mut stack, |_, _, _, _| true);
                assert_eq!(found.map_or(f32::INFINITY, |hit| hit.distance), nearest);
                let blocked = hierarchy.blocked(&ray, &mut stack, |_, _, _, _| true);
                assert_eq!(blocked, found.is_some());
            }
        }
    }

    #[test]
    fn a_ray_passes_what_is_not_solid() {
        let sheet = |z: f32| {
            [Vector::new(-1.0, -1.0, z), Vector::new(2.0, -1.0, z), Vector::new(-1.0, 2.0, z)]
        };
        let hierarchy = Hierarchy::over(&[sheet(0.0), sheet(1.0), sheet(2.0)]);
        let origin = Vector::new(0.0, 0.0, 5.0);
        let ray = Ray { origin, direction: -Vector::z(), reach: 10.0 };
        let mut stack = Stack::new();
        let hit = hierarchy.nearest(&ray, &mut stack, |number, _, _, _| number < 2);
        let (place, normal) = hit.map(|hit| hierarchy.place(&hit)).unwrap_or_default();
        assert_eq!(place, Vector::new(0.0, 0.0, 1.0));
        assert_eq!(normal, Vector::z());
        assert!(!hierarchy.blocked(&ray, &mut stack, |_, _, _, _| false));
    }
}
