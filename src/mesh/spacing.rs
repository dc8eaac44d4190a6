//! How many steps each stretch of the cut lines is divided into.

use super::breakpoint::Rings;
use super::matching::Classes;
use super::outline::Outline;
use super::sharpness::NarrowCorners;
use crate::geometry::nearby::Nearby;
use crate::geometry::polygon::{
    Place, between, distance, distance_to_side, meeting, nearest_share, sides, turn,
};

/// A step turns by no more than this, rad (an eighth of a circle).
const TURN: f64 = std::f64::consts::FRAC_PI_4;
/// Cloth narrower than this share of the steps along it asks for shorter ones.
const SLENDER: f64 = 0.6;
/// Steps are not made shorter than this for the sake of narrow cloth, in cells.
const SHORTEST: f64 = 0.25;
/// Sides this far apart along the line, measured by their distance across, face each other over
/// narrow cloth; nearer ones stand at a corner.
const APART: f64 = 3.0;

/// Steps of every class of intervals.
#[derive(Clone, Debug, PartialEq)]
pub struct Spacing {
    /// By the number of the class; 0 where no class has that number.
    steps: Vec<usize>,
    /// More steps than these are not taken.
    most: Vec<usize>,
}

impl Spacing {
    /// Divides every class as evenly as its members allow: into steps whose geometric mean over
    /// the longest and the shortest member comes nearest to a cell, and which turn little.
    /// `cell` gives the side of a cell of each panel, m.
    pub fn new(rings: &Rings, classes: &Classes, outlines: &[Vec<Outline>], cell: &[f64]) -> Self {
        let count = classes.class.len();
        let (mut longest, mut shortest) = (vec![0.0f64; count], vec![f64::INFINITY; count]);
        let mut turns = vec![0usize; count];
        for (number, ring) in rings.rings.iter().enumerate() {
            let outline = &outlines[ring.panel][ring.loop_number];
            for interval in 0..ring.breaks.len() {
                let class = classes.class[classes.first[number] + interval];
                let (from, to) = ring.interval(interval);
                let cells = (to - from) / cell[ring.panel];
                longest[class] = longest[class].max(cells);
                shortest[class] = shortest[class].min(cells);
                // Not more than a point every hundredth of a cell, however it wriggles.
                let most = (cells * 100.0).ceil();
                let bends = (outline.turning(from, to) / TURN - 1e-6).ceil().clamp(0.0, most);
                turns[class] = turns[class].max(bends as usize);
            }
        }
        let steps: Vec<usize> = (0..count)
            .map(|class| {
                if longest[class] == 0.0 {
                    return 0;
                }
                nearest_count((longest[class] * shortest[class]).sqrt()).max(turns[class])
            })
            .collect();
        let most = |class: usize| steps[class].max((longest[class] / SHORTEST).ceil() as usize);
        Spacing { most: (0..count).map(most).collect(), steps }
    }

    /// Steps of a class.
    pub fn steps(&self, class: usize) -> usize {
        self.steps[class]
    }

    /// Makes the steps of a class shorter by a factor, as far as they may be; tells whether that
    /// changed anything.
    pub fn refine(&mut self, class: usize, factor: f64) -> bool {
        let steps = self.steps[class];
        let wanted = ((steps as f64 * factor).ceil() as usize).max(steps + 1);
        self.steps[class] = wanted.min(self.most[class]);
        self.steps[class] > steps
    }
}

/// The count n for which `cells / n` comes nearest to 1, by ratio.
fn nearest_count(cells: f64) -> usize {
    let low = cells.floor().max(1.0);
    // cells / low and (low + 1) / cells are equal where cells² = low (low + 1).
    (if cells * cells > low * (low + 1.0) { low + 1.0 } else { low }) as usize
}

/// A point of a ring: the number of its ring, of its interval, and of its step.
pub type Address = (usize, usize, usize);

/// The points of one ring and their addresses.
pub fn points(
    ring_number: usize,
    rings: &Rings,
    classes: &Classes,
    spacing: &Spacing,
    outline: &Outline,
) -> (Vec<Place>, Vec<Address>) {
    let mut places = Vec::new();
    let mut addresses = Vec::new();
    let ring = &rings.rings[ring_number];
    for interval in 0..ring.breaks.len() {
        let (from, to) = ring.interval(interval);
        let steps = spacing.steps(classes.class[classes.first[ring_number] + interval]);
        for step in 0..steps {
            let arc = from + (to - from) * (step as f64 / steps as f64);
            if let Some(place) = outline.at(arc) {
                places.push(place);
                addresses.push((ring_number, interval, step));
            }
        }
    }
    (places, addresses)
}

/// What is wrong with the steps along a panel's cut lines.
#[derive(Clone, Debug, Default)]
pub struct Fault {
    /// Points that begin steps too long for the width of the cloth, and how much shorter they
    /// should be.
    pub slender: Vec<(usize, f64)>,
    /// Points that begin steps which cross or touch others.
    pub crossing: Vec<usize>,
}

/// Looks for steps that cross each other and for cloth too narrow for the steps along it.
pub fn faults(rings: &[Vec<Place>]) -> Fault {
    let mut fault = Fault::default();
    let mut stretches: Vec<(Place, Place)> = Vec::new();
    let mut ends = Vec::new();
    // Way along its ring to the middle of each step, and the length of the ring.
    let mut ways = Vec::new();
    for (number, ring) in rings.iter().enumerate() {
        let first = stretches.len();
        let mut way = 0.0;
        for (a, b) in sides(ring) {
            let length = distance(a, b);
            stretches.push((a, b));
            ways.push((number, way + length / 2.0));
            way += length;
        }
        ends.resize(stretches.len(), (first, stretches.len(), way));
    }
    let near = Nearby::new(&stretches);
    let narrow = NarrowCorners::new(rings);
    let mut others = Vec::new();
    for (number, &(a, b)) in stretches.iter().enumerate() {
        let (first, end, around) = ends[number];
        let next = if number + 1 == end { first } else { number + 1 };
        let before = if number == first { end - 1 } else { number - 1 };
        let length = distance(a, b);
        let reach = SLENDER * length;
        let middle = between(a, b, 0.5);
        let mut width = f64::INFINITY;
        near.around((a, b), reach, &mut others);
        for &other in &others {
            let other = other as usize;
            if other == number || other == next || other == before {
                continue;
            }
            let (c, d) = stretches[other];
            if meeting((a, b), (c, d), 1e-7 * length).is_some() {
                fault.crossing.push(number);
            }
            let across = distance_to_side(middle, c, d);
            let facing = between(c, d, nearest_share(middle, c, d));
            let same_ring = ways[number].0 == ways[other].0;
            let along = (ways[number].1 - ways[other].1).abs();
            let along = if same_ring { along.min(around - along) } else { f64::INFINITY };
            if turn(a, b, facing) > 0.0 && along > APART * across {
                width = width.min(across);
            }
        }
        // Shorter steps do not make a narrow corner wider.
        if width < reach && !narrow.reach(middle) {
            fault.slender.push((number, (reach / width.max(0.01 * reach)).min(4.0)));
        }
    }
    fault.crossing.dedup();
    fault
}
