//! Cloth on cloth: layers are kept apart and never pass through each other.
//!
//! Points over triangles and edges across edges that come nearer than the cloth is thick are
//! pushed apart by springs along their shortest way, taken implicitly with friction. What the
//! solution would still let through is found by conservative advancement; it becomes a contact
//! and the step is solved again, and as the last resort the movement of its knots is cut short.
//!
//! Every knot and every edge belongs to one of its faces, so that each pair of features is met
//! once, in the pair of faces that own it (Curtis, Tamstorf and Manocha 2008). Faces that cut each
//! other already keep no distance, there being no right side of them to push to, but are drawn
//! apart by the line in which they cut (see `untangle`).

mod open;
pub mod touch;
pub mod tree;
mod untangle;

use super::cloth::Cloth;
use super::hold::Pull;
use super::proximity::Pair;
use super::sewing::Stitch;
use nalgebra::Vector3;
use open::Open;
use rayon::prelude::*;
use std::collections::BTreeSet;
use touch::{Touch, Touches};
use tree::{Extent, Tree};

type V = Vector3<f64>;

/// Least distance of two layers' middles, m, however thin the cloth.
const THIN: f64 = 1.0e-3;

/// The same as a share of the shortest edge at a knot: more would make a sheet repel itself.
const SHARE: f64 = 0.3;

/// Greatest slack of a list of near pairs, as a share of the grid's cell: neighbours in a flat
/// sheet do not come on it.
const SLACK: f64 = 0.2;

/// Contact stiffness per area, N/m³: 0.1 mm carries 20 Pa, the weight of a dozen layers of cloth.
const STIFFNESS: f64 = 2.0e5;

/// Most of the way that layers too near each other are pushed apart in one step, as a share of the
/// distance kept. A contact found late would otherwise throw its layers apart.
const RECOVER: f64 = 0.1;

/// Largest factor by which a contact stiffens as its layers come near each other.
const STIFFEST: f64 = 100.0;

/// Share of the distance of a pair that a step must leave.
const KEEP: f64 = 0.2;

/// Times that a movement is cut by what its hits allow, and then times that knots which still hit
/// are stopped altogether.
const SOFT: usize = 6;
const HARD: usize = 40;

/// Steps in which faces that cut each other must become fewer, or they are left alone; and the steps
/// after which they are then looked for again.
const PATIENCE: u32 = 100;
const SELDOM: u32 = 10;

/// Slide in a step from which friction is full, m.
const PLAY: f64 = 2.0e-5;

/// Distance that a knot's cloth keeps from others, m.
pub fn apart(cloth: &Cloth, knot: u32) -> f64 {
    distance(cloth.thickness[knot as usize], cloth.spacing[knot as usize])
}

/// The same for cloth of some thickness whose edges are at least `space` long, m.
pub fn distance(thickness: f64, space: f64) -> f64 {
    thickness.max(THIN).min(SHARE * space)
}

/// Features that may come near each other.
#[derive(Clone, Copy, Debug)]
struct Near {
    pair: Pair,
    /// Their distance when the list was made, m.
    distance: f32,
}

/// What is known of the layers of one cloth.
#[derive(Clone, Debug, Default)]
pub struct Layers {
    faces: Vec<[u32; 3]>,
    /// Which corners, and which edges (from corner k to the next), a face owns.
    owned: Vec<[bool; 6]>,
    tree: Tree,
    /// Distance kept at each knot, m.
    apart: Vec<f64>,
    /// Greatest slack, m.
    widest: f64,
    /// Pairs of features that may come near each other while the knots stay in their boxes.
    list: Vec<Near>,
    /// Places for which the list was made.
    at: Vec<V>,
    /// Movement from there that was expected, besides moving all together.
    way: Vec<V>,
    /// How far from that way a knot may be, m.
    slack: f64,
    /// Knots of faces that cut each other.
    tangled: Vec<bool>,
    /// Pairs of faces that cut each other.
    cuts: Vec<[[u32; 3]; 2]>,
    /// The fewest there were, and how often they have been looked for since.
    fewest: usize,
    tried: u32,
    /// Seams still open: their edges must come together.
    open: Open,
}

impl Layers {
    /// Takes up a cloth, of whose seams the given stitches are still open; the faces are looked
    /// through for such as cut each other already.
    pub fn new(cloth: &Cloth, stitches: &[Stitch], x: &[V]) -> Self {
        let faces = cloth.faces.clone();
        let mut knot_taken = vec![false; cloth.knots()];
        let mut edge_taken: BTreeSet<[u32; 2]> = BTreeSet::new();
        let owned = faces
            .iter()
            .map(|f| {
                let mut owned = [false; 6];
                if f[0] == f[1] || f[1] == f[2] || f[2] == f[0] {
                    return owned;
                }
                for k in 0..3 {
                    let (a, b) = (f[k], f[(k + 1) % 3]);
                    owned[k] = !std::mem::replace(&mut knot_taken[a as usize], true);
                    owned[3 + k] = edge_taken.insert([a.min(b), a.max(b)]);
                }
                owned
            })
            .collect();
        let mut layers = Layers {
            faces,
            owned,
            tree: Tree::new(cloth),
            apart: (0..cloth.knots() as u32).map(|k| apart(cloth, k)).collect(),
            widest: SLACK * cloth.cell,
            tangled: vec![false; cloth.knots()],
            open: Open::new(cloth.knots(), stitches),
            fewest: usize::MAX,
            ..Layers::default()
        };
        layers.find_tangles(x);
        layers
    }

    /// Looks again for faces that cut each other, if any did; seldom where they would not come free.
    pub fn look_for_tangles(&mut self, x: &[V]) {
        if self.any_tangled() {
            self.tried += 1;
            if self.tried <= PATIENCE || self.tried.is_multiple_of(SELDOM) {
                self.find_tangles(x);
            }
        }
    }

    /// Finds the faces that cut each other.
    fn find_tangles(&mut self, x: &[V]) {
        let still = vec![V::zeros(); x.len()];
        let reach: Vec<Extent> = x.iter().map(|x| Extent::of_way(x, &V::zeros(), 0.0)).collect();
        self.tree.fit(&self.faces, x, &still, &reach);
        let faces = &self.faces;
        let cut = self.tree.pairs(|first, second, found: &mut Vec<[[u32; 3]; 2]>| {
            for a in first {
                for b in second {
                    let (f, g) = (&faces[*a as usize], &faces[*b as usize]);
                    let corners = |f: &[u32; 3]| f.map(|k| x[k as usize]);
                    if !f.iter().any(|k| g.contains(k))
                        && super::crossing::cut(&corners(f), &corners(g))
                    {
                        found.push([*f, *g]);
                    }
                }
            }
        });
        self.tangled.fill(false);
        for k in cut.iter().flatten().flatten() {
            self.tangled[*k as usize] = true;
        }
        if cut.len() < self.fewest {
            self.fewest = cut.len();
            self.tried = 0;
        }
        if cut.is_empty() {
            self.fewest = usize::MAX;
        }
        self.cuts = cut;
        // The tree stands for these places now.
        self.at.clear();
        self.list.clear();
    }

    /// Lets cloth of open seams touch as far along each seam as `room`, m.
    pub fn make_room(&mut self, room: f64) {
        self.open.room = room;
    }

    /// Whether any faces cut each other when last looked through.
    fn any_tangled(&self) -> bool {
        !self.cuts.is_empty()
    }

    /// Pulls that draw faces which cut each other apart; none any more where they did not help.
    pub fn untangle(&self, cloth: &Cloth, x: &[V]) -> Vec<Pull> {
        if self.tried > PATIENCE {
            return Vec::new();
        }
        let stiffness = |k: u32| STIFFNESS * cloth.area[k as usize];
        untangle::pulls(&self.cuts, x, stiffness, |k| self.apart[k as usize])
    }

    /// Whether a pair is to be kept apart at all.
    fn free(&self, pair: &Pair) -> bool {
        let knots = pair.knots();
        if self.any_tangled() && knots.iter().any(|k| self.tangled[*k as usize]) {
            return false;
        }
        let (first, second) = knots.split_at(pair.split());
        !self.open.meet(first, second)
    }

    /// Distance that a pair is to keep, m.
    fn apart(&self, pair: &Pair) -> f64 {
        pair.knots().iter().map(|k| self.apart[*k as usize]).fold(f64::INFINITY, f64::min)
    }

    /// Makes the list of pairs for places x that move by about `ahead`.
    fn look(&mut self, x: &[V], ahead: &[V]) {
        let drift = mean(ahead);
        self.way.clear();
        self.way.extend(ahead.iter().map(|d| d - drift));
        let fastest = self.way.iter().map(|d| d.norm()).fold(0.0, f64::max);
        let thinnest = self.apart.iter().copied().fold(f64::INFINITY, f64::min);
        self.slack = (0.5 * fastest).clamp(0.5 * thinnest.min(self.widest), self.widest);
        self.at.clear();
        self.at.extend_from_slice(x);
        let reach: Vec<Extent> = (0..x.len())
            .map(|k| Extent::of_way(&x[k], &self.way[k], self.slack + 0.5 * self.apart[k]))
            .collect();
        self.tree.fit(&self.faces, x, &self.way, &reach);
        let (faces, owned) = (&self.faces, &self.owned);
        let span = |knots: &[u32]| {
            let mut e = reach[knots[0] as usize];
            for k in &knots[1..] {
                e = e.join(&reach[*k as usize]);
            }
            e
        };
        let pairs = self.tree.pairs(|first, second, found: &mut Vec<Pair>| {
            for (one, other) in [(first, second), (second, first)] {
                for &b in other {
                    let g = faces[b as usize];
                    let whole = span(&g);
                    for &a in one {
                        let f = faces[a as usize];
                        for k in (0..3).filter(|k| owned[a as usize][*k]) {
                            if !g.contains(&f[k]) && reach[f[k] as usize].meets(&whole) {
                                found.push(Pair::Point([f[k], g[0], g[1], g[2]]));
                            }
                        }
                    }
                }
            }
            for &a in first {
                let f = faces[a as usize];
                for k in (0..3).filter(|k| owned[a as usize][3 + k]) {
                    let e = [f[k], f[(k + 1) % 3]];
                    let whole = span(&e);
                    for &b in second {
                        let g = faces[b as usize];
                        for m in (0..3).filter(|m| owned[b as usize][3 + m]) {
                            let h = [g[m], g[(m + 1) % 3]];
                            if !e.contains(&h[0]) && !e.contains(&h[1]) && whole.meets(&span(&h)) {
                                found.push(Pair::Edges([e[0], e[1], h[0], h[1]]));
                            }
                        }
                    }
                }
            }
        });
        let far: Vec<f32> = self.way.iter().map(length).collect();
        let slack = self.slack;
        self.list = pairs
            .into_par_iter()
            .with_min_len(1024)
            .filter_map(|pair| {
                let distance = pair.way(&pair.knots().map(|k| x[k as usize])).norm();
                let most = f64::from(most(&pair, &far)) + 2.0 * slack + self.apart(&pair);
                #[allow(clippy::cast_possible_truncation)]
                let near = Near { pair, distance: distance as f32 };
                (distance <= most).then_some(near)
            })
            .collect();
    }

    /// How far each knot is from where it was when the list was made, all moving together left
    /// out, after a further movement; nothing if one has left its box.
    fn moved(&self, x: &[V], dx: Option<&[V]>) -> Option<Vec<f32>> {
        if self.at.len() != x.len() {
            return None;
        }
        let drift = mean(x) - mean(&self.at) + dx.map_or(V::zeros(), mean);
        let mut inside = true;
        let moved = (0..x.len())
            .map(|k| {
                let off = x[k] - self.at[k] - drift + dx.map_or(V::zeros(), |d| d[k]);
                let way = self.way[k];
                for c in 0..3 {
                    inside &= off[c] >= way[c].min(0.0) - self.slack
                        && off[c] <= way[c].max(0.0) + self.slack;
                }
                length(&off)
            })
            .collect();
        inside.then_some(moved)
    }

    /// Contacts at places x, of which `ahead` is the movement expected and `slide` the one by
    /// which friction is judged.
    pub fn touch(&mut self, cloth: &Cloth, x: &[V], ahead: &[V], slide: &[V]) -> Touches {
        let moved = match self.moved(x, None).filter(|_| self.moved(x, Some(ahead)).is_some()) {
            Some(moved) => moved,
            None => {
                self.look(x, ahead);
                vec![0.0; x.len()]
            }
        };
        let touches = self
            .list
            .par_iter()
            .with_min_len(1024)
            .filter_map(|near| {
                let least = near.distance - most(&near.pair, &moved);
                let apart = self.apart(&near.pair);
                if f64::from(least) > apart {
                    return None;
                }
                self.contact(cloth, &near.pair, x, slide, false)
            })
            .collect();
        Touches(touches)
    }

    fn contact(
        &self,
        cloth: &Cloth,
        pair: &Pair,
        x: &[V],
        ahead: &[V],
        hit: bool,
    ) -> Option<Touch> {
        let knots = pair.knots();
        let places = knots.map(|k| x[k as usize]);
        let apart = self.apart(pair);
        let weights = pair.weights(&places);
        let way = (0..4).fold(V::zeros(), |s, k| s + places[k] * weights[k]);
        let distance = way.norm();
        if !(distance > 1e-9) || (!hit && distance > apart) || !self.free(pair) {
            return None;
        }
        let normal = way / distance;
        let area = knots.iter().map(|k| cloth.area[*k as usize]).sum::<f64>() * 0.25;
        let stiff = (apart / distance).powi(2).clamp(1.0, STIFFEST);
        let stiffness = STIFFNESS * area * stiff;
        let slide = (0..4).fold(V::zeros(), |s, k| s + ahead[knots[k] as usize] * weights[k]);
        let slide = (slide - normal * slide.dot(&normal)).norm();
        let gap = (distance - apart).max(-RECOVER * apart);
        let load = stiffness * (-gap).max(0.0);
        let friction = knots.iter().map(|k| cloth.friction[*k as usize]).sum::<f64>() * 0.25;
        let grip = (friction * load / slide.max(PLAY)).min(stiffness);
        Some(Touch { knots, weights, normal, gap, stiffness, grip })
    }

    /// Pairs of features that a movement would bring through each other or nearly so, with the
    /// share of it that they allow.
    fn hits(&self, x: &[V], dx: &[V]) -> Vec<(Pair, f64)> {
        // The list was made for these places or for a movement within its boxes.
        let before = self.moved(x, None).unwrap_or_else(|| vec![f32::INFINITY; x.len()]);
        let after = self.moved(x, Some(dx)).unwrap_or_else(|| vec![f32::INFINITY; x.len()]);
        #[allow(clippy::cast_possible_truncation)]
        let keep = KEEP as f32;
        self.list
            .par_iter()
            .with_min_len(1024)
            .filter_map(|near| {
                let p = &near.pair;
                // In between no knot is farther from its first place than at one of the ends.
                let (m, n) = (most(p, &before), most(p, &after));
                if near.distance - m.max(n) > keep * (near.distance + m) {
                    return None;
                }
                let k = p.knots();
                let d = k.map(|k| dx[k as usize]);
                if d.iter().all(|d| *d == V::zeros()) || !self.free(p) {
                    return None;
                }
                let share = p.advance(&k.map(|k| x[k as usize]), &d, KEEP);
                (share < 1.0).then_some((*p, share))
            })
            .collect()
    }

    /// Looks again where a movement leaves the boxes of the list.
    fn watch(&mut self, x: &[V], dx: &[V]) {
        if self.moved(x, Some(dx)).is_none() {
            self.look(x, dx);
        }
    }

    /// Adds to the contacts what a movement would run into. Gives whether there is anything new.
    pub fn catch(&mut self, cloth: &Cloth, x: &[V], dx: &[V], touches: &mut Touches) -> bool {
        self.watch(x, dx);
        let hits = self.hits(x, dx);
        let had: BTreeSet<[u32; 4]> = touches.0.iter().map(|t| t.knots).collect();
        let before = touches.0.len();
        for (pair, _) in &hits {
            if !had.contains(&pair.knots()) {
                touches.0.extend(self.contact(cloth, pair, x, dx, true));
            }
        }
        touches.0.len() > before
    }

    /// Cuts a movement so that nothing passes through. Gives how many knots were cut short.
    pub fn guard(&mut self, x: &[V], dx: &mut [V]) -> usize {
        let mut share = vec![1.0f64; dx.len()];
        let full = dx.to_vec();
        for round in 0..SOFT + HARD {
            self.watch(x, dx);
            let hits = self.hits(x, dx);
            if hits.is_empty() {
                break;
            }
            for (pair, allowed) in &hits {
                // A share of all movement together is safe for the pair itself; others that one of
                // its knots meets are looked at again, in the end with no movement at all.
                let factor = 0.9 * allowed;
                for k in pair.knots() {
                    let s = &mut share[k as usize];
                    *s = if round < SOFT { *s * factor } else { 0.0 };
                }
            }
            for ((d, f), s) in dx.iter_mut().zip(&full).zip(&share) {
                *d = f * *s;
            }
        }
        share.iter().filter(|s| **s < 1.0).count()
    }
}

#[allow(clippy::cast_possible_truncation)]
fn length(v: &V) -> f32 {
    v.norm() as f32 + 1e-7
}

/// The most by which the features of a pair can have come nearer, of how far each knot moved.
fn most(pair: &Pair, moved: &[f32]) -> f32 {
    let [a, b, c, d] = pair.knots().map(|k| moved[k as usize]);
    match pair {
        Pair::Point(_) => a + b.max(c).max(d),
        Pair::Edges(_) => a.max(b) + c.max(d),
    }
}

fn mean(v: &[V]) -> V {
    v.iter().sum::<V>() / v.len().max(1) as f64
}
