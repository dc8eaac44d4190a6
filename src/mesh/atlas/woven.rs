//! Threads of a woven tile: warp and weft as strands that rise over each other as the matrix
//! says.

use super::noise;
use super::strand::{self, Node, Strand};
use super::tile::{Grid, Look};
use crate::textile::fabric::Thread;
use crate::textile::weave::Weave;
use crate::textile::yarn::Fibre;

/// Numbers of the two yarns in [`Strand::yarn`].
pub const WARP: usize = 0;
/// See [`WARP`].
pub const WEFT: usize = 1;

/// What the strands are laid out for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// The picture of a tile.
    Picture,
    /// Bodies in space.
    Bodies,
}

impl Form {
    /// Height of a thread that lies over one crossing only, as a share of that of a float: the
    /// shorter the stretch, the more it is held down. Bodies touch at their crossings and hardly
    /// press into each other.
    fn single(self) -> f32 {
        match self {
            Form::Picture => 0.6,
            Form::Bodies => 0.9,
        }
    }

    /// Nodes from crossing to crossing, which are `step` px apart.
    fn parts(self, step: f32) -> usize {
        match self {
            Form::Picture if step > 5.0 => 4,
            Form::Picture => 2,
            Form::Bodies => 8,
        }
    }
}

/// How much wider than round a yarn is pressed in cloth.
const PRESSED: f64 = 1.45;

/// Unevenness of a spun thread, as a share of its width.
fn slub(fibre: Fibre) -> f32 {
    match fibre {
        Fibre::Linen | Fibre::Jute => 0.2,
        Fibre::Wool => 0.1,
        Fibre::Cotton | Fibre::Viscose => 0.08,
        Fibre::Silk => 0.05,
        Fibre::Polyester | Fibre::Nylon | Fibre::Metal => 0.025,
    }
}

/// Share of the spacing that a thread fills in the plane of the cloth.
pub fn filled(thread: &Thread) -> f64 {
    (PRESSED * thread.yarn.diameter / thread.spacing).clamp(0.12, 1.04)
}

/// The look of a thread of this kind, `length` m of it a tile.
pub fn look(thread: &Thread, length: f64) -> Look {
    Look::of(&thread.yarn, thread.colour, length)
}

/// The strands of a tile of `threads` ends and picks, warp first.
pub fn strands(
    weave: &Weave,
    warp: &Thread,
    weft: &Thread,
    threads: [usize; 2],
    grid: &Grid,
    form: Form,
) -> Vec<Strand> {
    let pitch = [grid.width as f32 / threads[0] as f32, grid.height as f32 / threads[1] as f32];
    let width = [filled(warp) as f32 * pitch[0] / 2.0, filled(weft) as f32 * pitch[1] / 2.0];
    // Both systems share one height so that neither hides the other at its own crossing.
    let thick = 0.42 * (width[0] + width[1]) * 0.5;
    let mut strands = Vec::with_capacity(threads[0] + threads[1]);
    for end in 0..threads[0] {
        let up = |pick: usize| weave.warp_up(end, pick);
        let course = Course {
            number: end,
            crossings: threads[1],
            step: pitch[1],
            middle: (end as f32 + 0.5) * pitch[0],
            stray: 0.035 * pitch[0],
            half: width[0],
            thick,
            form,
            slub: slub(warp.yarn.fibre),
            seed: 11,
        };
        let nodes = course.nodes(up, |along, aside| [aside, along]);
        let length = strand::length(&nodes);
        strands.push(Strand { nodes, flatness: thick / width[0], yarn: WARP, length });
    }
    for pick in 0..threads[1] {
        let up = |end: usize| !weave.warp_up(end, pick);
        let course = Course {
            number: pick,
            crossings: threads[0],
            step: pitch[0],
            middle: (pick as f32 + 0.5) * pitch[1],
            stray: 0.035 * pitch[1],
            half: width[1],
            thick,
            form,
            slub: slub(weft.yarn.fibre),
            seed: 12,
        };
        let nodes = course.nodes(up, |along, aside| [along, aside]);
        let length = strand::length(&nodes);
        strands.push(Strand { nodes, flatness: thick / width[1], yarn: WEFT, length });
    }
    strands
}

/// The course of one thread across the tile, px.
struct Course {
    number: usize,
    crossings: usize,
    step: f32,
    middle: f32,
    stray: f32,
    half: f32,
    thick: f32,
    form: Form,
    slub: f32,
    seed: u32,
}

impl Course {
    /// Nodes from the middle of the first crossing to its image a tile further on. `up` says at
    /// which crossings the thread lies on top.
    fn nodes(&self, up: impl Fn(usize) -> bool, place: impl Fn(f32, f32) -> [f32; 2]) -> Vec<Node> {
        let (parts, single) = (self.form.parts(self.step), self.form.single());
        let number = self.number as u32;
        let rise = |crossing: usize| {
            let side = up(crossing);
            let before = up((crossing + self.crossings - 1) % self.crossings);
            let after = up((crossing + 1) % self.crossings);
            let height = if side == before || side == after { 1.0 } else { single };
            if side { height } else { -height }
        };
        // Wavelengths of about six and nine threads, fitted to the tile.
        let bends = (self.crossings as u32 / 6).max(1);
        let swells = (self.crossings as u32 / 9).max(1);
        let count = self.crossings * parts;
        (0..=count)
            .map(|n| {
                let (crossing, part) = (n / parts % self.crossings, n % parts);
                let share = n as f32 / count as f32;
                let fraction = part as f32 / parts as f32;
                let here = rise(crossing);
                let next = rise((crossing + 1) % self.crossings);
                let level = here + (next - here) * noise::ease(fraction);
                // A float lies freely and spreads; where a thread is bound it is drawn in.
                let spread = 0.2 * ((level - single) / (1.0 - single)).clamp(0.0, 1.0);
                let drawn_in = 1.0 - 0.16 * (1.0 - level.abs());
                let bend = noise::line(self.seed ^ (number << 8), share * bends as f32, bends);
                let swell =
                    noise::line(self.seed ^ (number << 8) ^ 0x55, share * swells as f32, swells);
                let along = (n as f32 / parts as f32 + 0.5) * self.step;
                let [x, y] = place(along, self.middle + self.stray * bend);
                Node {
                    at: [x, y, level * self.thick],
                    half: self.half * (drawn_in + spread) * (1.0 + self.slub * swell),
                    along: n as f32 / parts as f32 * self.step,
                }
            })
            .collect()
    }
}
