//! How many threads or stitches make a tile, and how many pixels.

use super::tile::{FINE, Grid};
use super::tile::{Look, Shading, draw};
use super::{knitted, woven};
use crate::textile::Colour;
use crate::textile::fabric::{Fabric, Finish, Structure};

/// A tile that is yet to be drawn.
#[derive(Clone, Debug)]
pub struct Repeat {
    /// Threads across and along, or wales and courses; whole repeats of the structure.
    pub threads: [usize; 2],
    /// Pixels across and down.
    pub pixels: [usize; 2],
    /// Extent along u and v, m.
    pub size: [f64; 2],
}

/// Pixels that a tile is given where its repeat leaves the choice.
const USUAL: f64 = 640.0;
/// Pixels that a tile may have.
const MOST: f64 = 2048.0;
/// Pixels to a thread, and to a wale or course.
const PER_THREAD: f64 = 10.0;
/// See [`PER_THREAD`].
const PER_STITCH: f64 = 34.0;

impl Repeat {
    /// The tile of this structure, its pixels `scale` times the usual.
    pub fn of(structure: &Structure, scale: f64) -> Repeat {
        match structure {
            Structure::Woven { weave, warp, weft } => {
                let spacing = [warp.spacing, weft.spacing];
                Self::fitted([weave.ends(), weave.picks()], spacing, PER_THREAD * scale)
            }
            Structure::Knitted { knit, .. } => {
                let spacing = [1.0 / knit.wales, 1.0 / knit.courses];
                Self::fitted([knit.width(), knit.height()], spacing, PER_STITCH * scale)
            }
        }
    }

    fn fitted(repeat: [usize; 2], spacing: [f64; 2], per_thread: f64) -> Repeat {
        let spacing = spacing.map(|length| length.clamp(1e-6, 1.0));
        let pixel = spacing[0].min(spacing[1]) / per_thread;
        let mut fitted = Repeat { threads: [1; 2], pixels: [FINE; 2], size: [0.0; 2] };
        for axis in 0..2 {
            let repeat = repeat[axis].max(1);
            // Pixels need not be square where one system is far sparser than the other.
            let per_thread = (spacing[axis] / pixel).min(4.0 * per_thread);
            let once = repeat as f64 * per_thread;
            let times = (USUAL / once).round().max(1.0);
            let threads = repeat as f64 * times;
            fitted.threads[axis] = threads as usize;
            fitted.pixels[axis] = (threads * per_thread).round().clamp(16.0, MOST) as usize;
            fitted.size[axis] = threads * spacing[axis];
        }
        fitted
    }

    fn grid(&self) -> Grid {
        Grid { width: FINE * self.pixels[0], height: FINE * self.pixels[1] }
    }

    /// Draws the face, or the back as it lies behind the face, not mirrored. With `colours`, warp
    /// and weft are of these instead of their own.
    pub fn draw(&self, fabric: &Fabric, back: bool, colours: Option<[Colour; 2]>) -> Vec<u8> {
        let grid = self.grid();
        let pitch = [
            grid.width as f32 / self.threads[0] as f32,
            grid.height as f32 / self.threads[1] as f32,
        ];
        match &fabric.structure {
            Structure::Woven { weave, warp, weft } => {
                let weave = if back { weave.inverted() } else { weave.clone() };
                let mut yarns = [woven::look(warp, self.size[1]), woven::look(weft, self.size[0])];
                if let Some(colours) = colours {
                    for (yarn, colour) in yarns.iter_mut().zip(colours) {
                        yarn.light = super::light::Code::linear(colour);
                    }
                }
                let strands =
                    woven::strands(&weave, warp, weft, self.threads, &grid, woven::Form::Picture);
                let shading = Shading {
                    thread: (pitch[0] + pitch[1]) / 2.0,
                    relief: relief(fabric.finish),
                    fuzz: fuzz(fabric.finish),
                };
                draw(&strands, &yarns, grid, shading)
            }
            Structure::Knitted { knit, yarn } => {
                let mut loops = knit.loops();
                if back {
                    loops.iter_mut().flatten().for_each(|stitch| *stitch = stitch.turned());
                }
                let yarns: Vec<Look> = knitted::looks(knit, yarn, self.threads[0]);
                let strands = knitted::strands(knit, &loops, yarn, self.threads, &grid);
                let shading = Shading {
                    thread: 0.5 * pitch[0],
                    relief: relief(fabric.finish),
                    fuzz: fuzz(fabric.finish),
                };
                draw(&strands, &yarns, grid, shading)
            }
        }
    }
}

/// How much of the threads' form is left to see.
fn relief(finish: Finish) -> f32 {
    match finish {
        Finish::Matte => 0.9,
        Finish::Satin => 0.75,
        Finish::Wool => 0.75,
        Finish::Raised => 0.5,
        Finish::Velvet => 0.2,
    }
}

/// How much stands off the surface.
fn fuzz(finish: Finish) -> f32 {
    match finish {
        Finish::Matte | Finish::Satin => 0.0,
        Finish::Wool => 0.35,
        Finish::Raised => 0.8,
        Finish::Velvet => 1.0,
    }
}
