//! Cloth on cloth: layers are kept apart and never pass through each other.
//!
//! Points over triangles and edges across edges that come nearer than the cloth is thick are
//! pushed apart by springs along their shortest way, taken implicitly with friction. What the
//! solution would still let through is found by conservative advancement; it becomes a contact
//! and the step is solved again, and as the last resort the movement of its knots is cut short.
//!
//! Every knot and every edge belongs to one of its faces, so that each pair of features is met
//! once, in the pair of faces that own it (Curtis, Tamstorf and Manocha 2008). Faces that cut each
//! other already are left alone until they have come free: there is no right side of them to push
//! to.

use super::boxes::{self, Extent};
use super::cloth::Cloth;
use super::grid::product::Three;
use super::proximity::Pair;
use super::system::Extra;
use nalgebra::{Matrix3, Vector3};
use rayon::prelude::*;
use std::collections::BTreeMap;

type V = Vector3<f64>;

/// Least distance of two layers' middles, m, however thin the cloth.
const THIN: f64 = 1.0e-3;

/// The same as a share of the grid's cell: more would make a sheet repel itself.
const SHARE: f64 = 0.3;

/// Greatest slack of a list of near pairs, as a share of the grid's cell: neighbours in a flat
/// sheet do not come on it.
const SLACK: f64 = 0.2;

/// Contact stiffness per area, N/m³.
const STIFFNESS: f64 = 1.0e6;

/// Largest factor by which a contact stiffens as its layers come near each other.
const STIFFEST: f64 = 100.0;

/// Share of the distance of a pair that a step must leave.
const KEEP: f64 = 0.2;

/// Times that a movement is cut by what its hits allow, and then times that knots which still hit
/// are stopped altogether.
const SOFT: usize = 6;
const HARD: usize = 40;

/// Slide in a step from which friction is full, m.
const PLAY: f64 = 2.0e-5;

/// A contact of the step under way.
#[derive(Clone, Copy, Debug)]
pub struct Touch {
    knots: [u32; 4],
    weights: [f64; 4],
    normal: V,
    /// Gap beyond the distance kept, m.
    gap: f64,
    stiffness: f64,
    /// Stiffness across, of friction.
    grip: f64,
}

/// Contacts of a step as a term of the linear system.
#[derive(Clone, Debug, Default)]
pub struct Touches(Vec<Touch>);

impl Touch {
    fn block(&self) -> Matrix3<f64> {
        let along = self.normal * self.normal.transpose();
        along * (self.stiffness - self.grip) + Matrix3::identity() * self.grip
    }
}

impl Touches {
    /// Adds the forces, N.
    pub fn push(&self, force: &mut [V]) {
        for t in &self.0 {
            let f = t.normal * (-t.stiffness * t.gap);
            for (k, w) in t.knots.iter().zip(t.weights) {
                force[*k as usize] += f * w;
            }
        }
    }

    /// Blocks on the diagonal, by knots, for the preconditioner to see.
    pub fn diagonal(&self) -> impl Iterator<Item = (u32, Matrix3<f64>)> + '_ {
        self.0.iter().flat_map(|t| {
            let block = t.block();
            t.knots.into_iter().zip(t.weights).map(move |(k, w)| (k, block * (w * w)))
        })
    }

    /// Contacts as a term of a linear system whose numbers stand in the given slots.
    pub fn term(&self, slot: &[u32]) -> Term {
        #[allow(clippy::cast_possible_truncation)]
        let single = |t: &Touch| Single {
            slots: t.knots.map(|k| slot[k as usize]),
            weights: t.weights.map(|w| w as f32),
            normal: [t.normal.x as f32, t.normal.y as f32, t.normal.z as f32],
            along: (t.stiffness - t.grip) as f32,
            grip: t.grip as f32,
        };
        Term(self.0.iter().map(single).collect())
    }

    /// How many.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

/// Contacts as a term of the linear system, in single precision.
#[derive(Clone, Debug, Default)]
pub struct Term(Vec<Single>);

#[derive(Clone, Copy, Debug)]
struct Single {
    slots: [u32; 4],
    weights: [f32; 4],
    normal: [f32; 3],
    along: f32,
    grip: f32,
}

impl Extra for Term {
    fn multiply(&self, x: &Three, y: &mut Three) -> f64 {
        let mut total = 0.0;
        for t in &self.0 {
            let mut way = [0.0f32; 3];
            for (s, w) in t.slots.iter().zip(t.weights) {
                for c in 0..3 {
                    way[c] += x[c][*s as usize] * w;
                }
            }
            let n = t.normal;
            let along = t.along * (n[0] * way[0] + n[1] * way[1] + n[2] * way[2]);
            let f = [0, 1, 2].map(|c| n[c] * along + way[c] * t.grip);
            for (s, w) in t.slots.iter().zip(t.weights) {
                for c in 0..3 {
                    y[c][*s as usize] += f[c] * w;
                }
            }
            total += f64::from(f[0] * way[0] + f[1] * way[1] + f[2] * way[2]);
        }
        total
    }
}

/// What is known of the layers of one cloth.
#[derive(Clone, Debug, Default)]
pub struct Layers {
    faces: Vec<[u32; 3]>,
    /// Which corners, and which edges (from corner k to the next), a face owns.
    owned: Vec<[bool; 6]>,
    /// Distance kept, m.
    apart: f64,
    /// Greatest slack, m.
    widest: f64,
    /// Pairs of features that may come near each other, while the knots have not moved on.
    pairs: Vec<Pair>,
    /// Places for which the pairs were found.
    at: Vec<V>,
    /// How far a knot may move from there, m, besides moving with all others.
    slack: f64,
    /// Knots of faces that cut each other.
    tangled: Vec<bool>,
    any_tangled: bool,
}

impl Layers {
    /// Takes up a cloth; the faces are looked through for such as cut each other already.
    pub fn new(cloth: &Cloth, x: &[V]) -> Self {
        let faces: Vec<[u32; 3]> =
            cloth.faces.iter().copied().filter(|[a, b, c]| a != b && b != c && c != a).collect();
        let mut knot_taken = vec![false; cloth.knots()];
        let mut edge_taken: BTreeMap<[u32; 2], ()> = BTreeMap::new();
        let owned = faces
            .iter()
            .map(|f| {
                let mut owned = [false; 6];
                for k in 0..3 {
                    let (a, b) = (f[k], f[(k + 1) % 3]);
                    owned[k] = !std::mem::replace(&mut knot_taken[a as usize], true);
                    owned[3 + k] = edge_taken.insert([a.min(b), a.max(b)], ()).is_none();
                }
                owned
            })
            .collect();
        let thickest = cloth.thickness.iter().copied().fold(0.0, f64::max);
        let mut layers = Layers {
            faces,
            owned,
            apart: thickest.max(THIN).min(SHARE * cloth.cell),
            widest: SLACK * cloth.cell,
            slack: -1.0,
            tangled: vec![false; cloth.knots()],
            ..Layers::default()
        };
        layers.find_tangles(x);
        layers
    }

    /// Marks the knots of faces that cut each other. Gives how many pairs of faces do.
    pub fn find_tangles(&mut self, x: &[V]) -> usize {
        let faces = &self.faces;
        let boxes: Vec<Extent> = faces.iter().map(|f| extent(f, x, None, 0.0)).collect();
        let apart = |a: u32, b: u32| {
            let (f, g) = (&faces[a as usize], &faces[b as usize]);
            !f.iter().any(|k| g.contains(k))
        };
        let cut: Vec<[u32; 2]> = boxes::pairs(&boxes, &apart)
            .into_par_iter()
            .filter(|[a, b]| {
                let corners = |f: u32| faces[f as usize].map(|k| x[k as usize]);
                super::crossing::cut(&corners(*a), &corners(*b))
            })
            .collect();
        self.tangled.fill(false);
        for pair in &cut {
            for f in pair {
                for k in faces[*f as usize] {
                    self.tangled[k as usize] = true;
                }
            }
        }
        self.any_tangled = !cut.is_empty();
        cut.len()
    }

    /// Whether any faces cut each other when last looked through.
    pub fn any_tangled(&self) -> bool {
        self.any_tangled
    }

    /// Pairs of features of faces whose boxes, moved by `dx` and widened, meet.
    fn find(&self, x: &[V], dx: Option<&[V]>, margin: f64) -> Vec<Pair> {
        let boxes: Vec<Extent> =
            self.faces.par_iter().with_min_len(512).map(|f| extent(f, x, dx, margin)).collect();
        let found = boxes::pairs(&boxes, &|a, b| {
            let (f, g) = (&self.faces[a as usize], &self.faces[b as usize]);
            f.iter().filter(|k| g.contains(k)).count() < 3
        });
        found
            .par_iter()
            .with_min_len(256)
            .flat_map_iter(|[a, b]| {
                let (a, b) = (*a as usize, *b as usize);
                let (f, g) = (self.faces[a], self.faces[b]);
                let (of, og) = (self.owned[a], self.owned[b]);
                let mut pairs = Vec::new();
                for k in 0..3 {
                    if of[k] {
                        pairs.push(Pair::Point([f[k], g[0], g[1], g[2]]));
                    }
                    if og[k] {
                        pairs.push(Pair::Point([g[k], f[0], f[1], f[2]]));
                    }
                    for m in (0..3).filter(|m| of[3 + k] && og[3 + m]) {
                        pairs.push(Pair::Edges([f[k], f[(k + 1) % 3], g[m], g[(m + 1) % 3]]));
                    }
                }
                pairs.retain(Pair::is_apart);
                pairs
            })
            .collect()
    }

    /// Whether a pair is to be kept apart at all.
    fn free(&self, pair: &Pair) -> bool {
        !self.any_tangled || !pair.knots().iter().any(|k| self.tangled[*k as usize])
    }

    /// Contacts at places x, of which `ahead` is the movement expected.
    pub fn touch(&mut self, cloth: &Cloth, x: &[V], ahead: &[V]) -> Touches {
        let drift = mean(x, &self.at);
        let moved = if self.at.len() == x.len() {
            x.iter().zip(&self.at).map(|(x, a)| (x - a - drift).norm()).fold(0.0, f64::max)
        } else {
            f64::INFINITY
        };
        if self.slack < 0.0 || moved > self.slack {
            let step = fastest(ahead);
            self.slack = (4.0 * step).clamp(0.5 * self.apart, self.widest);
            let reach = self.apart + 2.0 * self.slack;
            self.pairs = self.find(x, None, 0.5 * reach);
            self.pairs = std::mem::take(&mut self.pairs)
                .into_par_iter()
                .with_min_len(1024)
                .filter(|p| p.way(&p.knots().map(|k| x[k as usize])).norm() <= reach)
                .collect();
            self.at = x.to_vec();
        }
        let touches = self
            .pairs
            .par_iter()
            .with_min_len(1024)
            .filter_map(|p| self.contact(cloth, p, x, ahead, false))
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
        let reach = self.apart;
        // A quick look along the axes before the exact one.
        if !hit {
            let (mut gap, split) = (0.0f64, pair.split());
            for k in 0..3 {
                let (mut l1, mut h1, mut l2, mut h2) =
                    (f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY);
                for (i, p) in places.iter().enumerate() {
                    if i < split {
                        l1 = l1.min(p[k]);
                        h1 = h1.max(p[k]);
                    } else {
                        l2 = l2.min(p[k]);
                        h2 = h2.max(p[k]);
                    }
                }
                gap = gap.max(l1 - h2).max(l2 - h1);
            }
            if gap > reach {
                return None;
            }
        }
        let weights = pair.weights(&places);
        let way = (0..4).fold(V::zeros(), |s, k| s + places[k] * weights[k]);
        let distance = way.norm();
        if !(distance > 1e-9) || (!hit && distance > reach) || !self.free(pair) {
            return None;
        }
        let normal = way / distance;
        let area = knots.iter().map(|k| cloth.area[*k as usize]).sum::<f64>() * 0.25;
        let stiff = (self.apart / distance).powi(2).clamp(1.0, STIFFEST);
        let stiffness = STIFFNESS * area * stiff;
        let slide = (0..4).fold(V::zeros(), |s, k| s + ahead[knots[k] as usize] * weights[k]);
        let slide = (slide - normal * slide.dot(&normal)).norm();
        let gap = distance - self.apart;
        let load = stiffness * (-gap).max(0.0);
        let friction = knots.iter().map(|k| cloth.friction[*k as usize]).sum::<f64>() * 0.25;
        let grip = (friction * load / slide.max(PLAY)).min(stiffness);
        Some(Touch { knots, weights, normal, gap, stiffness, grip })
    }

    /// Pairs of features that a movement would bring through each other or nearly so, with the
    /// share of it that they allow.
    fn hits(&self, x: &[V], dx: &[V], among: &[Pair]) -> Vec<(Pair, f64)> {
        among
            .par_iter()
            .with_min_len(1024)
            .filter_map(|p| {
                let k = p.knots();
                let d = k.map(|k| dx[k as usize]);
                let at = k.map(|k| x[k as usize]);
                if d.iter().all(|d| *d == V::zeros()) || !self.free(p) {
                    return None;
                }
                let share = p.advance(&at, &d, KEEP);
                (share < 1.0).then_some((*p, share))
            })
            .collect()
    }

    /// Pairs to be watched for a movement.
    fn watched(&self, x: &[V], dx: &[V]) -> Option<Vec<Pair>> {
        let drift = mean(x, &self.at) + mean_of(dx);
        let moved = x
            .iter()
            .zip(&self.at)
            .zip(dx)
            .map(|((x, a), d)| (x + d - a - drift).norm())
            .fold(0.0, f64::max);
        // The pairs at hand hold all that can meet as long as no knot has left its slack.
        if moved <= self.slack + 0.25 * self.apart {
            return None;
        }
        let drift = mean_of(dx);
        let own: Vec<V> = dx.iter().map(|d| d - drift).collect();
        Some(self.find(x, Some(&own), 0.1 * self.apart))
    }

    /// Adds to the contacts what a movement would run into. Gives whether there is anything new.
    pub fn catch(&self, cloth: &Cloth, x: &[V], dx: &[V], touches: &mut Touches) -> bool {
        let watched = self.watched(x, dx);
        let hits = self.hits(x, dx, watched.as_deref().unwrap_or(&self.pairs));
        let had: std::collections::BTreeSet<[u32; 4]> = touches.0.iter().map(|t| t.knots).collect();
        let before = touches.0.len();
        for (pair, _) in &hits {
            if !had.contains(&pair.knots()) {
                touches.0.extend(self.contact(cloth, pair, x, dx, true));
            }
        }
        touches.0.len() > before
    }

    /// Cuts a movement so that nothing passes through. Gives how many knots were cut short.
    pub fn guard(&self, x: &[V], dx: &mut [V]) -> usize {
        let watched = self.watched(x, dx);
        let among = watched.as_deref().unwrap_or(&self.pairs);
        let mut share = vec![1.0f64; dx.len()];
        let full = dx.to_vec();
        for round in 0..SOFT + HARD {
            let hits = self.hits(x, dx, among);
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

fn extent(face: &[u32; 3], x: &[V], dx: Option<&[V]>, margin: f64) -> Extent {
    let mut e = Extent::nothing();
    for k in face {
        let p = x[*k as usize];
        e.hold(&p);
        if let Some(dx) = dx {
            e.hold(&(p + dx[*k as usize]));
        }
    }
    e.widen(margin);
    e
}

fn mean_of(dx: &[V]) -> V {
    dx.iter().sum::<V>() / dx.len().max(1) as f64
}

fn mean(x: &[V], at: &[V]) -> V {
    if x.len() == at.len() { mean_of(x) - mean_of(at) } else { V::zeros() }
}

fn fastest(dx: &[V]) -> f64 {
    let drift = mean_of(dx);
    dx.iter().map(|d| (d - drift).norm()).fold(0.0, f64::max)
}
