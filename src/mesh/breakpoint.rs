//! Breakpoints of the cut lines: the places where a particle must lie.
//!
//! A [`Ring`] is one loop of one panel with its breakpoints by arc length: the ends of its
//! pieces, the ends of everything that is sewn, named, attached or pinned, and the images of
//! the breakpoints of sewing partners.

use super::outline::Outline;
use crate::garment::panel::Run;

/// Breakpoints nearer to each other than this along the line become one, m.
pub const MERGE: f64 = 1e-4;

/// A loop with its breakpoints.
#[derive(Clone, Debug)]
pub struct Ring {
    /// Number of the panel.
    pub panel: usize,
    /// Number of the loop in the panel.
    pub loop_number: usize,
    /// Length of the loop, m.
    pub length: f64,
    /// Breakpoints by arc length, ascending; the first is 0.
    pub breaks: Vec<f64>,
}

impl Ring {
    /// A loop with the ends of its pieces.
    pub fn new(panel: usize, loop_number: usize, outline: &Outline) -> Self {
        let mut ring = Ring { panel, loop_number, length: outline.length, breaks: vec![0.0] };
        for &start in &outline.pieces {
            ring.settle(start);
        }
        ring
    }

    /// The breakpoint nearest to `arc`, if it is no further than `reach`: its arc length as seen
    /// from there, so that the first one is given as 0 or as the whole length.
    pub fn near(&self, arc: f64, reach: f64) -> Option<f64> {
        let after = self.breaks.partition_point(|&at| at < arc);
        let next = self.breaks.get(after).copied().unwrap_or(self.length);
        let before = after.checked_sub(1).and_then(|i| self.breaks.get(i)).copied();
        let nearest = match before {
            Some(before) if arc - before <= next - arc => before,
            _ => next,
        };
        ((nearest - arc).abs() <= reach).then_some(nearest)
    }

    /// Makes sure of a breakpoint at `arc` or nearer to it than [`MERGE`], and gives its place.
    pub fn settle(&mut self, arc: f64) -> f64 {
        let arc = arc.clamp(0.0, self.length);
        match self.near(arc, MERGE) {
            Some(at) => at,
            None => {
                self.insert(arc);
                arc
            }
        }
    }

    /// Adds a breakpoint.
    pub fn insert(&mut self, arc: f64) {
        let after = self.breaks.partition_point(|&at| at < arc);
        self.breaks.insert(after, arc);
    }

    /// The breakpoints from `low` to `high`, both included when they are breakpoints.
    pub fn breaks_within(&self, low: f64, high: f64) -> impl Iterator<Item = f64> + '_ {
        let start = self.breaks.partition_point(|&at| at < low);
        let inside = self.breaks.iter().copied().skip(start).take_while(move |&at| at <= high);
        inside.chain((high >= self.length).then_some(self.length))
    }

    /// Number of the interval that holds `arc`; interval `i` begins at breakpoint `i`.
    pub fn interval_at(&self, arc: f64) -> usize {
        self.breaks.partition_point(|&at| at <= arc).saturating_sub(1)
    }

    /// Arc lengths of the ends of an interval, m.
    pub fn interval(&self, number: usize) -> (f64, f64) {
        let end = |i: usize| self.breaks.get(i).copied().unwrap_or(self.length);
        (end(number), end(number + 1))
    }
}

/// A stretch of a ring, walked from one breakpoint to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Walk {
    /// Number of the ring.
    pub ring: usize,
    /// Arc length where it starts, m.
    pub from: f64,
    /// Arc length where it ends, m; less than `from` when it goes against the loop.
    pub to: f64,
}

impl Walk {
    /// Its length, m.
    pub fn length(&self) -> f64 {
        (self.to - self.from).abs()
    }

    /// The arc length on the ring after walking `way`, m.
    pub fn at(&self, way: f64) -> f64 {
        let way = way.clamp(0.0, self.length());
        if self.to >= self.from { self.from + way } else { self.from - way }
    }

    /// How far one has walked at an arc length of the ring, m.
    pub fn way(&self, arc: f64) -> f64 {
        if self.to >= self.from { arc - self.from } else { self.from - arc }
    }

    /// Lower and upper arc length, m.
    pub fn span(&self) -> (f64, f64) {
        (self.from.min(self.to), self.from.max(self.to))
    }
}

/// All rings of a garment.
#[derive(Clone, Debug, Default)]
pub struct Rings {
    /// The rings, panel by panel.
    pub rings: Vec<Ring>,
    /// First ring of each panel.
    first: Vec<usize>,
}

impl Rings {
    /// The rings of the panels' loops.
    pub fn new(outlines: &[Vec<Outline>]) -> Self {
        let mut all = Rings::default();
        for (panel, loops) in outlines.iter().enumerate() {
            all.first.push(all.rings.len());
            let rings = loops.iter().enumerate();
            all.rings.extend(rings.map(|(number, outline)| Ring::new(panel, number, outline)));
        }
        all
    }

    /// Number of a panel's loop among all rings.
    pub fn number(&self, panel: usize, loop_number: usize) -> Option<usize> {
        let ring = self.first.get(panel)? + loop_number;
        self.rings.get(ring).filter(|found| found.panel == panel).map(|_| ring)
    }

    /// Turns runs of pieces into walks between breakpoints, adding these. Runs that are no
    /// longer than the merging distance fall away.
    pub fn walks(
        &mut self,
        outlines: &[Vec<Outline>],
        runs: impl IntoIterator<Item = (usize, Run)>,
    ) -> Vec<Walk> {
        let mut walks = Vec::new();
        for (panel, run) in runs {
            let Some(ring) = self.number(panel, run.ring) else { continue };
            let Some(outline) = outlines.get(panel).and_then(|loops| loops.get(run.ring)) else {
                continue;
            };
            let Some(&start) = outline.pieces.get(run.piece) else { continue };
            let end = outline.piece_end(run.piece);
            let Some(line) = self.rings.get_mut(ring) else { continue };
            let mut settle = |arc: f64| line.settle((start + arc).clamp(start, end));
            let walk = Walk { ring, from: settle(run.from), to: settle(run.to) };
            if walk.length() > 0.0 {
                walks.push(walk);
            }
        }
        walks
    }
}
