//! One step in time: linearised implicit Euler (Baraff and Witkin 1998).
//!
//! With the stiffness K at the beginning of the step, (M/dt² + C/dt + K) dx = M v/dt + f. The
//! movement is solved for, not the change of speed, so that a held knot is simply one that does
//! not move. Contact that the first solution would run into is added, and the step solved again.

use super::air;
use super::cloth::Cloth;
use super::elastic;
use super::grid::layout::Layout;
use super::hold::Holds;
use super::layers::Layers;
use super::layers::touch::Touches;
use super::matrix::add_scalar;
use super::patch::Patches;
use super::sewing::{self, Sewing};
use super::skin::{self, Contact, Push, Skin};
use super::system::{Aim, System};
use super::weld::Weld;
use crate::body::surface::Surface;
use crate::mesh::compiled::Compiled;
use nalgebra::{Matrix3, Vector3};

/// How a step is taken.
#[derive(Clone, Copy, Debug)]
pub struct Manner {
    /// Length of the step, s.
    pub dt: f64,
    /// Acceleration downwards, m/s².
    pub gravity: f64,
    /// Density of the air, kg/m³.
    pub air: f64,
    /// Rate at which all movement dies away, 1/s.
    pub calm: f64,
    /// Share of friction that counts.
    pub grip: f64,
    /// Strength of open seams, as a share of their ordinary pull.
    pub sewing: f64,
    /// How far along an open seam its cloth may pass through itself, m.
    pub room: f64,
    /// Farthest movement of a knot near skin in one step, m.
    pub near: f64,
    /// Whether layers of cloth are kept apart.
    pub layers: bool,
    /// When the linear solution is good enough.
    pub aim: Aim,
}

impl Default for Manner {
    fn default() -> Self {
        Manner {
            dt: 1.0 / 120.0,
            gravity: 9.80665,
            air: 1.2,
            calm: 0.0,
            grip: 1.0,
            sewing: 0.0,
            room: 0.0,
            near: 0.01,
            layers: true,
            aim: Aim { tolerance: 1e-2, most: 400 },
        }
    }
}

/// What a step did.
#[derive(Clone, Copy, Debug, Default)]
pub struct Taken {
    /// Time that passed, s; less than asked where the step had to be cut.
    pub time: f64,
    /// Largest speed of a knot, m/s.
    pub speed: f64,
    /// Iterations of the linear solver.
    pub iterations: usize,
    /// Whether all pins are in their places.
    pub pinned: bool,
    /// Contacts of cloth with cloth.
    pub touches: usize,
    /// Knots whose movement was cut short lest cloth pass through cloth.
    pub cut: usize,
}

/// No step however short gave finite numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stuck;

/// A cloth in movement.
pub struct Workshop<'a> {
    compiled: &'a Compiled,
    /// Its mechanics.
    pub cloth: Cloth,
    /// Places of the knots, m.
    pub x: Vec<Vector3<f64>>,
    /// Speeds of the knots, m/s.
    pub v: Vec<Vector3<f64>>,
    /// Movement of the knots in the last step, m.
    last: Vec<Vector3<f64>>,
    /// Open seams.
    pub sewing: Sewing,
    /// What is sewn on the face of other cloth.
    pub patches: Patches,
    /// What is held.
    pub holds: Holds,
    /// Contact with skin.
    pub contact: Contact,
    /// Contact of cloth with cloth; taken up with the first step that asks for it.
    layers: Option<Layers>,
    skin: &'a dyn Skin,
    system: System,
    /// Iterations of the last step.
    iterations: usize,
}

/// Most times a step is halved.
const HALVINGS: u32 = 8;

/// Most times a step is solved again for contact it ran into.
const PASSES: usize = 3;

impl<'a> Workshop<'a> {
    /// Takes up a cloth with the given welds; particles are at `positions` and at rest. A knot
    /// of several particles lies in their middle.
    pub fn new(
        compiled: &'a Compiled,
        surfaces: &[Surface],
        skin: &'a dyn Skin,
        weld: Weld,
        positions: &[Vector3<f64>],
    ) -> Self {
        let mut x = vec![Vector3::zeros(); weld.count];
        let mut count = vec![0u32; weld.count];
        for (&knot, p) in weld.knot.iter().zip(positions) {
            x[knot as usize] += p;
            count[knot as usize] += 1;
        }
        for (x, c) in x.iter_mut().zip(&count) {
            *x /= f64::from((*c).max(1));
        }
        let mut sewing = Sewing::new(compiled, &weld);
        let open: Vec<[u32; 2]> = sewing.pairs.iter().map(|s| s.knots).collect();
        let layout = Layout::new(compiled, &weld);
        let mut cloth = Cloth::new(compiled, weld);
        let holds = Holds::new(compiled, surfaces, &cloth, &x);
        let patches = Patches::new(compiled, &cloth);
        let system = System::new(layout, &mut cloth, &open, &holds.held);
        sewing.lay_out(&system.rim);
        let mut on_arm = vec![false; x.len()];
        // Cloth that is being sewn would be caught by its edges on its way past the body.
        if sewing.pairs.is_empty() {
            for (particle, is) in sewing::on_arms(compiled).into_iter().enumerate() {
                on_arm[cloth.weld.knot[particle] as usize] |= is;
            }
        }
        let contact = Contact::new(&cloth, skin, &x, &on_arm);
        Workshop {
            compiled,
            system,
            iterations: 0,
            last: vec![Vector3::zeros(); x.len()],
            v: vec![Vector3::zeros(); x.len()],
            cloth,
            x,
            sewing,
            patches,
            holds,
            contact,
            layers: None,
            skin,
        }
    }

    /// What it is a cloth of.
    pub fn compiled(&self) -> &'a Compiled {
        self.compiled
    }

    /// Places of all particles.
    pub fn positions(&self) -> Vec<Vector3<f64>> {
        self.cloth.weld.knot.iter().map(|&k| self.x[k as usize]).collect()
    }

    /// Energy of deformation and height (in the given gravity) and of movement, J.
    pub fn energy(&self, gravity: f64) -> [f64; 2] {
        let height: f64 = self.cloth.mass.iter().zip(&self.x).map(|(m, x)| m * gravity * x.y).sum();
        [elastic::energy(&self.cloth, &self.x) + height, self.movement()]
    }

    /// Takes all speed.
    pub fn stop(&mut self) {
        self.v.fill(Vector3::zeros());
    }

    /// Moves what is still under the skin out of it, as far as other cloth lets it; see
    /// [`skin::clear`].
    pub fn clear(&mut self) {
        let mut cleared = self.x.clone();
        skin::clear(&self.cloth, self.skin, &mut cleared);
        self.shift(cleared.iter().zip(&self.x).map(|(to, from)| to - from).collect());
    }

    /// Lifts knots that are too deep in skin.
    fn lift(&mut self) {
        if let Some(ways) = self.contact.ways_out(&self.cloth, &self.x, &mut self.v) {
            self.shift(ways);
        }
    }

    /// Moves knots at once, as far as that brings no cloth through other cloth.
    fn shift(&mut self, mut ways: Vec<Vector3<f64>>) {
        if let Some(layers) = &mut self.layers {
            layers.guard(&self.x, &mut ways);
        }
        for (x, way) in self.x.iter_mut().zip(&ways) {
            *x += way;
        }
    }

    /// Raises knots off sharp edges of the skin; see [`skin::raise`].
    pub fn raise(&mut self) -> bool {
        skin::raise(&mut self.cloth, self.skin, &self.x)
    }

    /// Whether cloth lies on skin anywhere, or something holds it.
    pub fn is_held(&self) -> bool {
        self.holds.attached() || !self.holds.pins.is_empty() || self.contact.is_loaded()
    }

    /// Energy of movement, J.
    pub fn movement(&self) -> f64 {
        self.cloth.mass.iter().zip(&self.v).map(|(m, v)| 0.5 * m * v.norm_squared()).sum()
    }

    /// Takes a step. Where it gives no finite numbers a shorter one is taken.
    ///
    /// # Errors
    /// [`Stuck`] if even a very short one gives none; the cloth is then as it was.
    pub fn step(&mut self, manner: &Manner) -> Result<Taken, Stuck> {
        self.layers = self.layers.take().filter(|_| manner.layers);
        if manner.layers && self.layers.is_none() {
            self.layers = Some(Layers::new(&self.cloth, &self.sewing.pairs, &self.x));
            self.lift();
        }
        let mut shorter = *manner;
        for _ in 0..HALVINGS {
            if let Some(taken) = self.attempt(&shorter) {
                return Ok(taken);
            }
            shorter.dt *= 0.5;
        }
        Err(Stuck)
    }

    fn attempt(&mut self, manner: &Manner) -> Option<Taken> {
        let dt = manner.dt;
        let down = Vector3::new(0.0, -manner.gravity, 0.0);
        let mut start = self.x.clone();
        let mut speeds = self.v.clone();
        let pinned = self.holds.move_pins(dt, &mut start, &mut speeds);
        let mut base = self.assemble(&start, &speeds, manner);
        let mut ahead: Vec<Vector3<f64>> =
            speeds.iter().map(|v| v * dt + down * (dt * dt)).collect();
        // Friction is judged by the last step's movement: gravity's own share is not slid yet.
        let mut slide: Vec<Vector3<f64>> = speeds.iter().map(|v| v * dt).collect();
        let mut touches = Touches::default();
        let mut layers = self.layers.take();
        if let Some(layers) = &mut layers {
            layers.make_room(manner.room);
            layers.look_for_tangles(&start);
            for (knot, pull, block) in layers.untangle(&self.cloth, &start) {
                base.0[knot as usize] += block;
                base.1[knot as usize] += pull;
            }
            touches = layers.touch(&self.cloth, &start, &ahead, &slide);
        }
        touches.0.extend(self.patches.touches(&start));
        let mut iterations = 0;
        for pass in 0..PASSES {
            let pushes = self.contact.push(&self.cloth, &start, &ahead, &slide, manner.grip);
            let b = self.load(&base, &pushes, &touches);
            // Solved from the last step's movement, and the fall as far as nothing holds it up.
            let fallen = if pass == 0 { down * (dt * dt) } else { Vector3::zeros() };
            let mut fall = vec![fallen; start.len()];
            let mut guess = slide.clone();
            self.contact.guide(&self.cloth, &start, &mut guess, &mut fall);
            let slots = &self.system.grid.layout.slot;
            let term = touches.term(slots);
            if pass == 0 {
                let more: Vec<_> =
                    touches.diagonal().map(|(k, block)| (slots[k as usize], block)).collect();
                self.system.factor(more.into_iter());
                let sewn = self.sewing.pairs.iter().map(|s| s.knots);
                let cloth = (self.compiled, &self.cloth);
                self.system.refresh_coarse(cloth, sewn, &term, self.iterations);
            }
            let (solution, taken) = self.system.solve(&term, &b, (&guess, &fall), manner.aim);
            iterations += taken;
            ahead = solution;
            if ahead.iter().any(|d| !d.iter().all(|c| c.is_finite())) {
                self.layers = layers;
                return None;
            }
            let on_skin = self.contact.runs_into(&self.cloth, &start, &ahead, &pushes);
            let on_cloth = pass + 1 < PASSES
                && layers
                    .as_mut()
                    .is_some_and(|l| l.catch(&self.cloth, &start, &ahead, &mut touches));
            if !on_skin && !on_cloth {
                break;
            }
            slide.copy_from_slice(&ahead);
        }
        let share = self.bound(&start, &mut ahead, manner);
        let dt = dt * share;
        let cut = layers.as_mut().map_or(0, |l| l.guard(&start, &mut ahead));
        self.layers = layers;
        self.contact.settle(&self.cloth, &start, &ahead);
        let mut speed = 0.0f64;
        for (i, dx) in ahead.iter().enumerate() {
            self.x[i] = start[i] + dx;
            self.v[i] = dx / dt;
        }
        self.last = ahead;
        self.contact.look(&self.cloth, self.skin, &self.x);
        self.lift();
        for v in &self.v {
            speed = speed.max(v.norm());
        }
        self.iterations = iterations;
        Some(Taken { time: dt, speed, iterations, pinned, touches: touches.len(), cut })
    }

    /// Shortens a movement that goes too far near skin: the whole of it as far as one knot
    /// demands, single knots where one would hold up all. Gives the share that is left.
    fn bound(&self, start: &[Vector3<f64>], dx: &mut [Vector3<f64>], manner: &Manner) -> f64 {
        let mut share = 1.0f64;
        let leeway: Vec<f64> =
            start.iter().enumerate().map(|(i, x)| self.contact.leeway(i, x, manner.near)).collect();
        for (d, most) in dx.iter().zip(&leeway) {
            let far = d.norm();
            if far > *most {
                share = share.min(most / far);
            }
        }
        let share = share.max(0.2);
        if share < 1.0 {
            for (d, most) in dx.iter_mut().zip(&leeway) {
                *d *= share;
                let far = d.norm();
                if far > *most {
                    *d *= most / far;
                }
            }
        }
        share
    }

    /// Everything but contact: fills the matrix, and gives the knots' own blocks and the
    /// right-hand side.
    fn assemble(
        &mut self,
        x: &[Vector3<f64>],
        v: &[Vector3<f64>],
        manner: &Manner,
    ) -> (Vec<Matrix3<f64>>, Vec<Vector3<f64>>) {
        let dt = manner.dt;
        let scale = 1.0 + self.cloth.damping / dt;
        let mut force = self.system.assemble(&self.cloth, x, &self.last, scale);
        self.cloth.creases.iter().for_each(|crease| crease.press(x, &mut force));
        let off = &mut self.system.rim.matrix.off;
        for stitch in self.sewing.drawn().filter(|_| manner.sewing > 0.0) {
            let [a, b] = stitch.knots.map(|k| k as usize);
            let way = x[b] - x[a];
            let k = stitch.stiffness(way.norm(), manner.sewing);
            force[a] += way * k;
            force[b] -= way * k;
            add_scalar(&mut off[stitch.slots[0] as usize], -k);
            add_scalar(&mut off[stitch.slots[1] as usize], -k);
        }
        let mut own = vec![Matrix3::zeros(); x.len()];
        for (knot, pull, k) in self.holds.pull(&self.cloth, x) {
            force[knot as usize] += pull;
            own[knot as usize] += k;
        }
        let normals =
            if manner.air > 0.0 { air::normals(&self.cloth.faces, x) } else { Vec::new() };
        for (i, (force, own)) in force.iter_mut().zip(&mut own).enumerate() {
            let mass = self.cloth.mass[i];
            force.y -= mass * manner.gravity;
            *force += v[i] * (mass / dt);
            *own += Matrix3::from_diagonal_element(mass / (dt * dt) + mass * manner.calm / dt);
            if let Some(normal) = normals.get(i) {
                *own += air::damping(manner.air, self.cloth.area[i], normal, &v[i]) / dt;
            }
        }
        (own, force)
    }

    /// Adds contact to what [`Workshop::assemble`] gave.
    fn load(
        &mut self,
        base: &(Vec<Matrix3<f64>>, Vec<Vector3<f64>>),
        pushes: &[Option<Push>],
        touches: &Touches,
    ) -> Vec<Vector3<f64>> {
        let mut force = base.1.clone();
        let mut own = base.0.clone();
        for (i, push) in pushes.iter().enumerate() {
            if let Some((f, k)) = push {
                own[i] += k;
                force[i] += f;
            }
        }
        self.system.set_own(own.into_iter());
        touches.push(&mut force);
        force
    }
}
