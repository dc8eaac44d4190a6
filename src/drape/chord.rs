//! Middles of the long edges of sleeves against skin: on a coarse grid a thumb is thinner than a cell
//! and would slip through between knots, never to come back when the grid becomes finer.

use super::cloth::Cloth;
use super::skin::{Contact, GIVE, Push, Skin, Touch};
use nalgebra::Vector3;
use rayon::prelude::*;

/// Grids whose cells are longer than this have middles that touch, m: half the breadth of the
/// hand at its thumb.
const LONG: f64 = 0.025;

/// Edges whose middles touch skin.
#[derive(Clone, Debug, Default)]
pub struct Chords {
    ends: Vec<[u32; 2]>,
    touches: Vec<Touch>,
}

impl Chords {
    /// The edges of a coarse cloth whose knots are both on an arm; none of a finer cloth.
    pub fn new(cloth: &Cloth, x: &[Vector3<f64>], on_arm: &[bool]) -> Self {
        if cloth.cell < LONG {
            return Chords::default();
        }
        let mut ends = edges(cloth);
        ends.retain(|ends| ends.iter().all(|k| on_arm[*k as usize]));
        let touches = ends.iter().map(|e| Touch::new(middle(x, e))).collect();
        Chords { ends, touches }
    }

    /// Brings distances up to date.
    pub fn look(&mut self, cloth: &Cloth, skin: &dyn Skin, x: &[Vector3<f64>]) {
        self.touches.par_iter_mut().zip(&self.ends).with_min_len(64).for_each(|(touch, ends)| {
            touch.look(skin, &middle(x, ends), seat(cloth, ends), cloth.friction[ends[0] as usize]);
        });
    }

    /// Adds to the pushes of the knots what the middles between them get, half to each; the
    /// stiffness between the two counts as theirs. Without friction, which the knots have.
    pub fn push(
        &mut self,
        cloth: &Cloth,
        x: &[Vector3<f64>],
        ahead: &[Vector3<f64>],
        pushes: &mut [Option<Push>],
    ) {
        let found: Vec<Option<Push>> = self
            .touches
            .par_iter_mut()
            .zip(&self.ends)
            .with_min_len(64)
            .map(|(touch, ends)| {
                let area = ends.map(|k| cloth.area[k as usize]).iter().sum::<f64>() / 6.0;
                let (at, ahead) = (middle(x, ends), middle(ahead, ends));
                touch.push(seat(cloth, ends), area, &at, &ahead, &Vector3::zeros(), 0.0)
            })
            .collect();
        for (ends, push) in self.ends.iter().zip(found) {
            let Some((force, stiffness)) = push else { continue };
            for k in ends {
                let (f, s) = pushes[*k as usize].get_or_insert_with(Default::default);
                *f += force * 0.5;
                *s += stiffness * 0.5;
            }
        }
    }
}

/// All edges of the faces, each once.
pub fn edges(cloth: &Cloth) -> Vec<[u32; 2]> {
    let mut edges: Vec<[u32; 2]> = Vec::new();
    for f in &cloth.faces {
        edges.extend([0, 1, 2].map(|k| {
            let (a, b) = (f[k], f[(k + 1) % 3]);
            [a.min(b), a.max(b)]
        }));
    }
    edges.sort_unstable();
    edges.dedup();
    edges.retain(|[a, b]| a != b);
    edges
}

fn middle(x: &[Vector3<f64>], [a, b]: &[u32; 2]) -> Vector3<f64> {
    (x[*a as usize] + x[*b as usize]) * 0.5
}

/// Middles may lie a little deeper than knots: a chord of a limb does.
fn seat(cloth: &Cloth, ends: &[u32; 2]) -> f64 {
    0.5 * ends.map(|k| Contact::seat(cloth, k as usize)).iter().sum::<f64>() - GIVE
}
