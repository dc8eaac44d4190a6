//! The cloth in true proportions: threads with their distances, thicknesses and colours, repeated
//! to fill a panel.

use super::{Area, Shape};
use crate::textile::Colour;
use crate::textile::draft::{Draft, Threads};
use crate::textile::drawdown::{Cloth, System};

/// Distances and thicknesses of the threads of a system, m; or in units of one distance where
/// nobody says them.
pub(super) struct Lengths {
    spacing: Vec<f64>,
    thickness: Vec<f64>,
    measured: bool,
}

/// What a thread takes of its room where its thickness is not said, or is said to be as much or
/// more.
const USUAL: f64 = 0.86;

impl Lengths {
    pub(super) fn of(threads: &Threads, count: usize) -> Lengths {
        let spacing: Option<Vec<f64>> =
            threads.spacing.as_ref().map(|list| list.iter().copied().take(count).collect());
        let measured = spacing.is_some();
        let spacing = spacing.unwrap_or_else(|| vec![1.0; count]);
        let thickness = spacing
            .iter()
            .enumerate()
            .map(|(number, &room)| {
                let said = threads.thickness.as_ref().and_then(|list| list.get(number));
                said.copied().filter(|said| measured && *said < 0.98 * room).unwrap_or(USUAL * room)
            })
            .collect();
        Lengths { spacing, thickness, measured }
    }

    fn mean(&self) -> f64 {
        self.spacing.iter().sum::<f64>() / self.spacing.len().max(1) as f64
    }
}

/// A thread in the panel: which it is, where its room begins and how wide that is, pixels.
#[derive(Clone, Copy)]
struct Lane {
    thread: usize,
    from: f64,
    room: f64,
    thick: f64,
}

/// Pixels from thread to thread: at least so many, at most so many.
const FINE: f64 = 5.0;
const COARSE: f64 = 14.0;

/// How dark a thread is where another lies on it.
const BELOW: f64 = 0.35;

const SHADOW: Colour = Colour([46, 42, 40, 255]);
/// The colours of warp and weft where nobody says them.
pub(super) const NATURAL: [Colour; 2] = [Colour([66, 84, 122, 255]), Colour([232, 226, 212, 255])];

/// Puts the threads of a panel on a sheet; gives the pixels of a centimetre where distances are
/// known.
pub(super) fn threads(
    draft: &Draft,
    cloth: &Cloth,
    lengths: &[Lengths; 2],
    panel: Area,
    shapes: &mut Vec<Shape>,
) -> Option<f64> {
    let [warp, weft] = lengths;
    if warp.spacing.is_empty() || weft.spacing.is_empty() {
        return None;
    }
    let measured = warp.measured && weft.measured;
    // Without distances of both, threads lie on squares.
    let means = if measured { [warp.mean(), weft.mean()] } else { [1.0, 1.0] };
    let relative = |system: &Lengths| if measured { 1.0 } else { 1.0 / system.mean() };
    let across: f64 = warp.spacing.iter().sum::<f64>() * relative(warp);
    let along: f64 = weft.spacing.iter().sum::<f64>() * relative(weft);
    let fitting = (panel.width / across).min(panel.height / along);
    let smaller = means[0].min(means[1]);
    let scale = fitting.clamp(FINE / smaller, COARSE / smaller);
    let ends = lanes(warp, scale * relative(warp), panel.width);
    let picks = lanes(weft, scale * relative(weft), panel.height);

    shapes.push(Shape::Fill { area: panel, colour: SHADOW });
    let bottom = panel.y + panel.height;
    let colour = |system: System, thread: usize| {
        let (list, usual) = match system {
            System::Warp => (&draft.warp.colours, NATURAL[0]),
            System::Weft => (&draft.weft.colours, NATURAL[1]),
        };
        match list {
            Some(list) => list.get(thread).copied().unwrap_or(usual),
            None => usual,
        }
    };
    let top = |system: System, own: Lane, other: Lane| {
        let up = match system {
            System::Warp => cloth.picks.up(own.thread, other.thread),
            System::Weft => cloth.picks.up(other.thread, own.thread),
        };
        up == (system == System::Warp)
    };
    // What shows in the gaps first, then all that lies on top.
    for on_top in [false, true] {
        for system in [System::Weft, System::Warp] {
            let (own, others) = match system {
                System::Warp => (&ends, &picks),
                System::Weft => (&picks, &ends),
            };
            for &lane in own {
                let mut at = 0;
                while at < others.len() {
                    let start = at;
                    while at < others.len() && top(system, lane, others[at]) == on_top {
                        at += 1;
                    }
                    if at == start {
                        at += 1;
                        continue;
                    }
                    let (first, last) = (others[start], others[at - 1]);
                    let [from, to] = [first.from, last.from + last.room];
                    let side = lane.from + (lane.room - lane.thick) / 2.0;
                    let area = match system {
                        System::Warp => Area {
                            x: panel.x + side,
                            y: bottom - to,
                            width: lane.thick,
                            height: to - from,
                        },
                        System::Weft => Area {
                            x: panel.x + from,
                            y: bottom - side - lane.thick,
                            width: to - from,
                            height: lane.thick,
                        },
                    };
                    let mut colour = colour(system, lane.thread);
                    if !on_top {
                        colour = dark(colour);
                        shapes.push(Shape::Fill { area, colour });
                        continue;
                    }
                    // At the border of the panel nothing says where the thread goes.
                    let dip = |lane: Lane, ends: bool| if ends { lane.room / 2.0 } else { 0.0 };
                    let dips = [dip(first, start > 0), dip(last, at < others.len())];
                    let upright = system == System::Warp;
                    let dips = if upright { [dips[1], dips[0]] } else { dips };
                    shapes.push(Shape::Thread { area, upright, colour, dips });
                }
            }
        }
    }
    measured.then_some(0.01 * scale).filter(|bar| *bar < panel.width - 50.0)
}

/// The threads that fill so many pixels, over and over.
fn lanes(lengths: &Lengths, scale: f64, pixels: f64) -> Vec<Lane> {
    let mut found = Vec::new();
    let mut from = 0.0;
    let mut number = 0;
    while from < pixels - 0.01 {
        let thread = number % lengths.spacing.len();
        let room = (lengths.spacing[thread] * scale).max(0.5);
        let thick = lengths.thickness[thread] * scale;
        // The last is cut by the border.
        let left = pixels - from;
        let (room, thick) = if room > left { (left, thick.min(left)) } else { (room, thick) };
        found.push(Lane { thread, from, room, thick });
        from += room;
        number += 1;
    }
    found
}

fn dark(colour: Colour) -> Colour {
    Colour::from_linear(colour.linear().map(|light| light * BELOW))
}
