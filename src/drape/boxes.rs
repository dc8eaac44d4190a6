//! Which faces of a cloth come near each other: a hierarchy of boxes, built anew when needed.

use nalgebra::Vector3;
use rayon::prelude::*;

/// A box along the axes.
#[derive(Clone, Copy, Debug)]
pub struct Extent {
    low: Vector3<f64>,
    high: Vector3<f64>,
}

impl Extent {
    /// The box that holds nothing.
    pub fn nothing() -> Self {
        Extent { low: Vector3::repeat(f64::INFINITY), high: Vector3::repeat(f64::NEG_INFINITY) }
    }

    /// Grows to hold a place.
    pub fn hold(&mut self, place: &Vector3<f64>) {
        self.low = self.low.inf(place);
        self.high = self.high.sup(place);
    }

    /// Grows by a margin on all sides.
    pub fn widen(&mut self, margin: f64) {
        self.low -= Vector3::repeat(margin);
        self.high += Vector3::repeat(margin);
    }

    fn join(&self, other: &Extent) -> Extent {
        Extent { low: self.low.inf(&other.low), high: self.high.sup(&other.high) }
    }

    fn meets(&self, other: &Extent) -> bool {
        (0..3).all(|k| self.low[k] <= other.high[k] && other.low[k] <= self.high[k])
    }
}

/// Faces in a leaf.
const LEAF: usize = 4;

/// All pairs (a, b), a < b, of boxes that meet and that `wanted` lets through, in ascending order.
pub fn pairs(boxes: &[Extent], wanted: &(dyn Fn(u32, u32) -> bool + Sync)) -> Vec<[u32; 2]> {
    if boxes.len() < 2 {
        return Vec::new();
    }
    let order = in_space(boxes);
    let leaves = boxes.len().div_ceil(LEAF).next_power_of_two();
    // A complete tree: node 1 is the root, node k has children 2k and 2k + 1.
    let mut nodes = vec![Extent::nothing(); 2 * leaves];
    for (leaf, members) in order.chunks(LEAF).enumerate() {
        nodes[leaves + leaf] =
            members.iter().fold(Extent::nothing(), |e, &f| e.join(&boxes[f as usize]));
    }
    for k in (1..leaves).rev() {
        nodes[k] = nodes[2 * k].join(&nodes[2 * k + 1]);
    }
    let found: Vec<Vec<[u32; 2]>> = (0..boxes.len() as u32)
        .into_par_iter()
        .with_min_len(256)
        .map(|a| {
            let own = &boxes[a as usize];
            let mut found = Vec::new();
            let mut stack = vec![1usize];
            while let Some(node) = stack.pop() {
                if !nodes[node].meets(own) {
                    continue;
                }
                if node < leaves {
                    stack.extend([2 * node, 2 * node + 1]);
                    continue;
                }
                let first = (node - leaves) * LEAF;
                for &b in order.iter().skip(first).take(LEAF) {
                    if b > a && boxes[b as usize].meets(own) && wanted(a, b) {
                        found.push([a, b]);
                    }
                }
            }
            found.sort_unstable();
            found
        })
        .collect();
    found.concat()
}

/// Numbers of the boxes along a curve that fills space (Morton 1966).
fn in_space(boxes: &[Extent]) -> Vec<u32> {
    let mut all = Extent::nothing();
    for b in boxes {
        all.hold(&((b.low + b.high) * 0.5));
    }
    let size = (all.high - all.low).max().max(1e-12);
    let spread = |v: f64| {
        let mut n = ((v / size) * 1023.0).clamp(0.0, 1023.0) as u32;
        n = (n | (n << 16)) & 0x0300_00ff;
        n = (n | (n << 8)) & 0x0300_f00f;
        n = (n | (n << 4)) & 0x030c_30c3;
        (n | (n << 2)) & 0x0924_9249
    };
    let mut keyed: Vec<(u32, u32)> = boxes
        .iter()
        .enumerate()
        .map(|(i, b)| {
            let p = (b.low + b.high) * 0.5 - all.low;
            (spread(p.x) | (spread(p.y) << 1) | (spread(p.z) << 2), i as u32)
        })
        .collect();
    keyed.par_sort_unstable();
    keyed.into_iter().map(|(_, i)| i).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against all pairs tried one by one.
    #[test]
    fn no_pair_is_lost() {
        let boxes: Vec<Extent> = (0..200u32)
            .map(|i| {
                let f = f64::from(i);
                let mut e = Extent::nothing();
                e.hold(&Vector3::new((f * 0.37) % 1.0, (f * 0.73) % 1.0, (f * 0.11) % 1.0));
                e.widen(0.02 + 0.001 * f);
                e
            })
            .collect();
        let found = pairs(&boxes, &|a, b| (a + b) % 3 != 0);
        let mut expected = Vec::new();
        for a in 0..200u32 {
            for b in a + 1..200 {
                if boxes[a as usize].meets(&boxes[b as usize]) && (a + b) % 3 != 0 {
                    expected.push([a, b]);
                }
            }
        }
        assert!(expected.len() > 100);
        assert_eq!(found, expected);
    }
}
