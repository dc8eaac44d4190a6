//! Contact of cloth with bodies and solids, with dry friction.
//!
//! Each knot keeps its distance from the nearest skin. Closer than the cloth's place on the skin
//! a stiff spring along the normal pushes it away, taken implicitly; deeper than a margin it is
//! lifted at once as far as other cloth lets it, so that nothing stays inside. Friction is Coulomb's with a memory: a knot that
//! touches is held to the point of the skin where it came to rest by a spring that gives
//! 0.1 mm before it slips, so that cloth at rest does not creep.

use super::chord::{self, Chords};
use super::cloth::Cloth;
use super::matrix::ROWS;
use crate::body::distance::Field;
use nalgebra::{Matrix3, Point3, Vector3};
use rayon::prelude::*;

/// Space between the skin and the middle of the cloth besides half its thickness, m: chords of
/// the cloth between two knots must not show the skin.
pub const MARGIN: f64 = 1.8e-3;

/// How far a loaded knot may press into that space, m.
pub(super) const GIVE: f64 = 1.0e-3;

/// Contact stiffness per area, N/m³: the pressure of a tight waistband, 800 Pa, presses 0.4 mm.
const STIFFNESS: f64 = 2.0e6;

/// Elastic play of a sticking contact, m.
const PLAY: f64 = 1.0e-4;

/// Knots farther from their seat on the skin than this are not looked at until they have come
/// nearer, m; more than the farthest movement of a step near skin.
const REACH: f64 = 0.02;

/// Within this way the skin counts as flat, m: a chord of it on a limb of radius 4 cm is 1 µm
/// deep.
const TURN: f64 = 3.0e-4;

/// Least distance from skin that knots, middles of edges and middles of faces have in the end, m.
const CLEAR: f64 = 2.0e-4;

/// Rounds of moving them there.
const CLEARINGS: usize = 8;

/// Answer to the question how far a place is from all skin.
#[derive(Clone, Copy, Debug)]
pub struct Nearest {
    /// Distance, m; negative inside.
    pub distance: f64,
    /// Unit normal, outwards.
    pub normal: Vector3<f64>,
    /// Coulomb friction of the thing itself, where it has one.
    pub friction: Option<f64>,
}

/// Something that cloth lies on.
pub trait Skin: Sync {
    /// The nearest skin to a place; `None` if there is none at all.
    fn nearest(&self, place: &Vector3<f64>) -> Option<Nearest>;
}

/// Bodies and solids of a scene.
pub struct Figures {
    field: Field,
    friction: Vec<Option<f64>>,
}

impl Figures {
    /// Takes the surfaces.
    pub fn new(surfaces: &[crate::body::surface::Surface]) -> Self {
        Figures {
            field: Field::new(surfaces),
            friction: surfaces.iter().map(|s| s.friction).collect(),
        }
    }
}

impl Skin for Figures {
    fn nearest(&self, place: &Vector3<f64>) -> Option<Nearest> {
        let probe = self.field.probe(Point3::from(*place))?;
        Some(Nearest {
            distance: probe.distance,
            normal: probe.normal,
            friction: self.friction.get(probe.surface).copied().flatten(),
        })
    }
}

/// What one knot knows of the skin.
#[derive(Clone, Copy, Debug)]
pub struct Touch {
    /// Whether it was ever looked at.
    known: bool,
    /// Place it was looked at.
    at: Vector3<f64>,
    /// Distance found there, m.
    pub distance: f64,
    /// Normal found there.
    pub normal: Vector3<f64>,
    /// Friction of the pair.
    friction: f64,
    /// Where it sticks.
    anchor: Option<Vector3<f64>>,
    /// Normal force at the end of the last step, N.
    load: f64,
    /// Stiffness along the normal in the step that is under way; zero if not in contact.
    active: f64,
}

/// Contact of all knots.
#[derive(Clone, Debug, Default)]
pub struct Contact {
    touches: Vec<Touch>,
    chords: Chords,
    any: bool,
}

/// Force on a knot and its stiffness.
pub type Push = (Vector3<f64>, Matrix3<f64>);

impl Contact {
    /// Looks for skin near all knots; of those that are `on_arm` the middles of long edges touch too.
    pub fn new(cloth: &Cloth, skin: &dyn Skin, x: &[Vector3<f64>], on_arm: &[bool]) -> Self {
        let touches = x.iter().map(|x| Touch::new(*x)).collect();
        let any = skin.nearest(&Vector3::zeros()).is_some();
        let chords = if any { Chords::new(cloth, x, on_arm) } else { Chords::default() };
        let mut contact = Contact { touches, chords, any };
        contact.look(cloth, skin, x);
        contact
    }

    /// Distance of the cloth's middle from the skin at a knot that lies on it, m.
    pub fn seat(cloth: &Cloth, knot: usize) -> f64 {
        0.5 * cloth.thickness[knot] + MARGIN + cloth.raise[knot]
    }

    /// Whether there is anything to touch.
    pub fn is_empty(&self) -> bool {
        !self.any
    }

    /// Whether any knot presses on skin.
    pub fn is_loaded(&self) -> bool {
        self.touches.iter().any(|t| t.load > 0.0)
    }

    /// Brings distances up to date where the skin may have come near or turned since.
    pub fn look(&mut self, cloth: &Cloth, skin: &dyn Skin, x: &[Vector3<f64>]) {
        if !self.any {
            return;
        }
        self.touches.par_iter_mut().zip(x).enumerate().with_min_len(64).for_each(
            |(i, (touch, x))| touch.look(skin, x, Self::seat(cloth, i), cloth.friction[i]),
        );
        self.chords.look(cloth, skin, x);
    }

    /// How far a knot may go in one step, m: beyond the reach of skin as far as skin is away,
    /// near it no further than `near`.
    pub fn leeway(&self, knot: usize, x: &Vector3<f64>, near: f64) -> f64 {
        if !self.any {
            return f64::INFINITY;
        }
        let touch = &self.touches[knot];
        let free = touch.distance - (x - touch.at).norm();
        (0.8 * free).max(near)
    }

    /// Contact and friction of a step from places x, of which `ahead` is the movement expected
    /// and `slide` the movement by which friction is judged. `grip` scales friction.
    pub fn push(
        &mut self,
        cloth: &Cloth,
        x: &[Vector3<f64>],
        ahead: &[Vector3<f64>],
        slide: &[Vector3<f64>],
        grip: f64,
    ) -> Vec<Option<Push>> {
        if !self.any {
            return Vec::new();
        }
        let mut pushes: Vec<Option<Push>> = self
            .touches
            .par_iter_mut()
            .zip(x)
            .zip(ahead)
            .zip(slide)
            .enumerate()
            .with_min_len(ROWS)
            .map(|(i, (((touch, x), ahead), slide))| {
                touch.push(Self::seat(cloth, i), cloth.area[i], x, ahead, slide, grip)
            })
            .collect();
        self.chords.push(cloth, x, ahead, &mut pushes);
        pushes
    }

    /// Bends an expected movement so that knots in contact come to lie on the skin, and takes
    /// from a second one what they will not do.
    pub fn guide(
        &self,
        cloth: &Cloth,
        x: &[Vector3<f64>],
        dx: &mut [Vector3<f64>],
        fall: &mut [Vector3<f64>],
    ) {
        for (i, touch) in self.touches.iter().enumerate().filter(|(_, t)| t.active > 0.0) {
            let n = touch.normal;
            let gap = touch.distance + (x[i] + dx[i] - touch.at).dot(&n) - Self::seat(cloth, i);
            dx[i] -= n * (gap + touch.load / touch.active);
            fall[i] = Vector3::zeros();
        }
    }

    /// Whether a movement would press a knot that had no contact into the skin.
    pub fn runs_into(
        &self,
        cloth: &Cloth,
        x: &[Vector3<f64>],
        dx: &[Vector3<f64>],
        pushes: &[Option<Push>],
    ) -> bool {
        pushes.iter().enumerate().any(|(i, push)| {
            let touch = &self.touches[i];
            push.is_none()
                && touch.near(&x[i], Self::seat(cloth, i))
                && touch.distance + (x[i] + dx[i] - touch.at).dot(&touch.normal)
                    < Self::seat(cloth, i) - 0.3 * GIVE
        })
    }

    /// After a step from x to x + dx: loads and anchors for the next.
    pub fn settle(&mut self, cloth: &Cloth, x: &[Vector3<f64>], dx: &[Vector3<f64>]) {
        if !self.any {
            return;
        }
        for (i, ((touch, x), dx)) in self.touches.iter_mut().zip(x).zip(dx).enumerate() {
            touch.settle(Self::seat(cloth, i), x, dx);
        }
    }

    /// Takes the inward speed of knots that are deeper than the margin allows and gives their ways out
    /// to it, none at all if none is; to be called with distances up to date.
    pub fn ways_out(
        &self,
        cloth: &Cloth,
        x: &[Vector3<f64>],
        v: &mut [Vector3<f64>],
    ) -> Option<Vec<Vector3<f64>>> {
        if !self.any {
            return None;
        }
        let mut ways = None;
        for (i, touch) in self.touches.iter().enumerate() {
            if let Some(way) = touch.out(&x[i], Self::seat(cloth, i)) {
                ways.get_or_insert_with(|| vec![Vector3::zeros(); x.len()])[i] = way;
                let inward = v[i].dot(&touch.normal).min(0.0);
                v[i] -= touch.normal * inward;
            }
        }
        ways
    }
}

/// Moves cloth out of the skin for good: knots, and the knots around edges and faces whose
/// middles are under it. Gives the greatest depth that is left at any of those places, m.
pub fn clear(cloth: &Cloth, skin: &dyn Skin, x: &mut [Vector3<f64>]) -> f64 {
    let mut places: Vec<Vec<u32>> = (0..x.len() as u32).map(|k| vec![k]).collect();
    places.extend(chord::edges(cloth).into_iter().map(|e| e.to_vec()));
    places.extend(cloth.faces.iter().map(|f| f.to_vec()));
    let mut deepest = 0.0f64;
    for _ in 0..CLEARINGS {
        let out: Vec<Option<Vector3<f64>>> = places
            .par_iter()
            .with_min_len(64)
            .map(|knots| {
                let sum: Vector3<f64> = knots.iter().map(|k| x[*k as usize]).sum();
                let nearest = skin.nearest(&(sum / knots.len() as f64))?;
                (nearest.distance < CLEAR)
                    .then(|| nearest.normal * (1.2 * CLEAR - nearest.distance))
            })
            .collect();
        let mut moves: std::collections::BTreeMap<u32, Vector3<f64>> =
            std::collections::BTreeMap::new();
        deepest = 0.0;
        for (knots, out) in places.iter().zip(&out) {
            let Some(out) = out else { continue };
            deepest = deepest.max(out.norm() - 1.2 * CLEAR);
            for k in knots {
                let way = moves.entry(*k).or_insert_with(Vector3::zeros);
                if out.norm() > way.norm() {
                    *way = *out;
                }
            }
        }
        if moves.is_empty() {
            break;
        }
        for (k, way) in moves {
            x[k as usize] += way;
        }
    }
    deepest.max(0.0)
}

/// Most by which a knot is raised, m.
const RAISE: f64 = 0.01;

/// Raises the seats of knots that [`clear`] would have to move, so that the cloth can come to
/// rest where it is clear of the skin. Gives whether there were any.
pub fn raise(cloth: &mut Cloth, skin: &dyn Skin, x: &[Vector3<f64>]) -> bool {
    let mut cleared = x.to_vec();
    clear(cloth, skin, &mut cleared);
    let mut any = false;
    for (k, (from, to)) in x.iter().zip(&cleared).enumerate() {
        if (to - from).norm() < CLEAR {
            continue;
        }
        let Some(nearest) = skin.nearest(to) else { continue };
        let more = nearest.distance - Contact::seat(cloth, k);
        if more > 0.0 && cloth.raise[k] < RAISE {
            cloth.raise[k] = (cloth.raise[k] + more + CLEAR).min(RAISE);
            any = true;
        }
    }
    any
}

impl Touch {
    /// What a knot at a place knows before it has looked.
    pub(super) fn new(at: Vector3<f64>) -> Self {
        Touch {
            known: false,
            at,
            distance: 0.0,
            normal: Vector3::y(),
            friction: 0.0,
            anchor: None,
            load: 0.0,
            active: 0.0,
        }
    }

    /// Brings the distance up to date where the skin may have come near or turned since; `own` is
    /// the friction of the cloth.
    pub(super) fn look(&mut self, skin: &dyn Skin, x: &Vector3<f64>, seat: f64, own: f64) {
        let moved = (x - self.at).norm();
        let far = self.distance - moved > seat + REACH;
        if self.known && (far || moved < TURN) {
            return;
        }
        let Some(nearest) = skin.nearest(x) else { return };
        self.known = true;
        self.at = *x;
        self.distance = nearest.distance;
        self.normal = nearest.normal;
        self.friction = nearest.friction.unwrap_or(own).max(0.0);
    }

    /// The way out to the margin from deeper than it allows.
    pub(super) fn out(&self, x: &Vector3<f64>, seat: f64) -> Option<Vector3<f64>> {
        let least = seat - GIVE;
        let distance = self.distance + (x - self.at).dot(&self.normal);
        (self.near(x, seat) && distance < least).then(|| self.normal * (least - distance))
    }

    /// Whether skin is so near that a step may reach it.
    fn near(&self, x: &Vector3<f64>, seat: f64) -> bool {
        self.distance - (x - self.at).norm() <= seat + REACH
    }

    pub(super) fn push(
        &mut self,
        seat: f64,
        area: f64,
        x: &Vector3<f64>,
        ahead: &Vector3<f64>,
        slide: &Vector3<f64>,
        grip: f64,
    ) -> Option<Push> {
        self.active = 0.0;
        if !self.near(x, seat) {
            self.anchor = None;
            self.load = 0.0;
            return None;
        }
        let n = self.normal;
        let gap = self.distance + (x - self.at).dot(&n) - seat;
        if gap > 0.0 && gap + ahead.dot(&n) > 0.0 {
            if gap > GIVE {
                self.anchor = None;
                self.load = 0.0;
            }
            return None;
        }
        self.active = STIFFNESS * area;
        let along = n * n.transpose();
        let mut force = -n * (self.active * gap);
        let mut stiffness = along * self.active;
        let limit = grip * self.friction * self.load;
        let anchor = *self.anchor.get_or_insert(*x);
        if limit > 0.0 {
            let across = |d: Vector3<f64>| d - n * d.dot(&n);
            let slip = across(x - anchor);
            let expected = (slip + across(*slide)).norm().max(PLAY);
            let k = limit / expected;
            force -= slip * k;
            stiffness += (Matrix3::identity() - along) * k;
        }
        Some((force, stiffness))
    }

    fn settle(&mut self, seat: f64, x: &Vector3<f64>, dx: &Vector3<f64>) {
        if self.active == 0.0 {
            self.load = 0.0;
            return;
        }
        let n = self.normal;
        let place = x + dx;
        let gap = self.distance + (place - self.at).dot(&n) - seat;
        self.load = self.active * (-gap).max(0.0);
        if let Some(anchor) = &mut self.anchor {
            let off = place - *anchor;
            let normal = n * off.dot(&n);
            let slip = off - normal;
            let size = slip.norm();
            // The anchor follows the skin's normal freely and is dragged along once it slips.
            *anchor += normal;
            if size > PLAY {
                *anchor += slip * (1.0 - PLAY / size);
            }
        }
    }
}
