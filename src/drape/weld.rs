//! Which particles have become one: sewn pairs, chains of them, and points where three meet.

/// The knots of a cloth: particles, those welded together counted once. Knots are numbered in
/// the order of their first particle.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Weld {
    /// Knot of each particle.
    pub knot: Vec<u32>,
    /// Number of knots.
    pub count: usize,
}

impl Weld {
    /// The knots of `particles` particles in which the two of each pair are one.
    pub fn new(particles: usize, pairs: impl Iterator<Item = [u32; 2]>) -> Self {
        let mut parent: Vec<u32> = (0..particles as u32).collect();
        for [a, b] in pairs {
            let (a, b) = (root(&mut parent, a), root(&mut parent, b));
            let (low, high) = (a.min(b), a.max(b));
            parent[high as usize] = low;
        }
        let mut knot = vec![u32::MAX; particles];
        let mut count = 0u32;
        for p in 0..particles as u32 {
            let r = root(&mut parent, p);
            if r == p {
                knot[p as usize] = count;
                count += 1;
            } else {
                knot[p as usize] = knot[r as usize];
            }
        }
        Weld { knot, count: count as usize }
    }
}

fn root(parent: &mut [u32], start: u32) -> u32 {
    let mut p = start;
    while parent[p as usize] != p {
        parent[p as usize] = parent[parent[p as usize] as usize];
        p = parent[p as usize];
    }
    p
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chains_and_triple_points_become_one_knot() {
        let weld = Weld::new(6, [[4, 2], [2, 5], [1, 1]].into_iter());
        assert_eq!(weld.knot, vec![0, 1, 2, 3, 2, 2]);
        assert_eq!(weld.count, 4);
    }
}
