//! Matching of seams: sewing partners receive the same breakpoints and the same counts of
//! points.
//!
//! Each seam maps one side on to the other, piecewise in proportion between its links. A link
//! joins a breakpoint of one side to one of the other. Breakpoints without a link are carried
//! over, through all seams, until none is left; then every interval between breakpoints has its
//! partners, and one count of steps serves them all.

use super::breakpoint::{MERGE, Rings, Walk};

/// Links nearer to each other than this are the same, m.
const SAME: f64 = 1e-8;
/// More breakpoints than this mean that seams carry each other's breakpoints round endlessly.
const MOST_BREAKS: usize = 20_000;

/// One side of a seam: walks one after the other.
#[derive(Clone, Debug, Default)]
pub struct Side {
    /// The walks.
    pub walks: Vec<Walk>,
    /// Way before each walk, and at the end the whole, m.
    before: Vec<f64>,
}

impl Side {
    /// A side of the given walks.
    pub fn new(walks: Vec<Walk>) -> Self {
        let mut before = vec![0.0];
        let mut way = 0.0;
        for walk in &walks {
            way += walk.length();
            before.push(way);
        }
        Side { walks, before }
    }

    /// Its length, m.
    pub fn length(&self) -> f64 {
        self.before.last().copied().unwrap_or(0.0)
    }

    /// The walk on which a way from the start lies, with the way left on it.
    fn walk_at(&self, way: f64) -> Option<(Walk, f64)> {
        let after = self.before.partition_point(|&before| before <= way);
        let number = after.saturating_sub(1).min(self.walks.len().checked_sub(1)?);
        Some((*self.walks.get(number)?, way - self.before.get(number)?))
    }

    /// The breakpoints on this side, by the way from its start, ascending.
    fn breaks(&self, rings: &Rings) -> Vec<f64> {
        let mut ways = Vec::new();
        for (walk, before) in self.walks.iter().zip(&self.before) {
            let (low, high) = walk.span();
            if let Some(ring) = rings.rings.get(walk.ring) {
                ways.extend(ring.breaks_within(low, high).map(|arc| before + walk.way(arc)));
            }
        }
        ways.sort_by(f64::total_cmp);
        ways.dedup_by(|later, earlier| *later - *earlier < SAME);
        ways
    }
}

/// Two sides that are sewn, with the links found between them.
#[derive(Clone, Debug)]
pub struct Match {
    /// The two sides.
    pub sides: [Side; 2],
    /// Ways from the start of both sides, ascending in both.
    pub links: Vec<[f64; 2]>,
}

impl Match {
    /// Two sides linked at both ends; `None` when one of them has no length.
    pub fn new(a: Side, b: Side) -> Option<Self> {
        let ends = [a.length(), b.length()];
        let sewn = ends.iter().all(|&length| length > MERGE);
        sewn.then(|| Match { sides: [a, b], links: vec![[0.0; 2], ends] })
    }

    /// Number of the first link that does not lie before `way` on a side.
    fn link_from(&self, side: usize, way: f64) -> usize {
        self.links.partition_point(|link| link[side] < way - SAME)
    }

    fn linked(&self, side: usize, way: f64) -> bool {
        self.links
            .get(self.link_from(side, way))
            .is_some_and(|link| (link[side] - way).abs() <= SAME)
    }

    /// Carries a breakpoint of one side to the other: to a breakpoint there that waits for a
    /// partner within `reach`, else to a new one. Tells whether one was added; `Err` when there
    /// is no room for one.
    fn carry(&mut self, side: usize, way: f64, reach: f64, rings: &mut Rings) -> Result<bool, ()> {
        let other = 1 - side;
        let after = self.link_from(side, way);
        let (Some(low), Some(high)) =
            (after.checked_sub(1).and_then(|i| self.links.get(i)), self.links.get(after))
        else {
            return Err(());
        };
        let share = (way - low[side]) / (high[side] - low[side]);
        let (near, far) = (low[other], high[other]);
        let image = near + share * (far - near);
        let waiting = self.sides[other].breaks(rings).into_iter().filter(|&there| {
            there > near + SAME && there < far - SAME && (there - image).abs() <= reach
        });
        let nearest = waiting.min_by(|x, y| (x - image).abs().total_cmp(&(y - image).abs()));
        let partner = nearest.unwrap_or(image);
        if partner - near <= 10.0 * SAME || far - partner <= 10.0 * SAME {
            return Err(());
        }
        if nearest.is_none() {
            let (walk, left) = self.sides[other].walk_at(image).ok_or(())?;
            rings.rings.get_mut(walk.ring).ok_or(())?.insert(walk.at(left));
        }
        let mut link = [way; 2];
        link[other] = partner;
        self.links.insert(after, link);
        Ok(nearest.is_none())
    }
}

/// Carries breakpoints through all seams until each has its partners. `reach(m)` is how far the
/// two breakpoints that seam `m` joins may lie from where proportion would put them, m.
///
/// # Errors
/// Numbers of the seams that cannot be matched.
pub fn carry_breaks(
    rings: &mut Rings,
    seams: &mut [Option<Match>],
    reach: impl Fn(usize) -> f64,
) -> Result<(), Vec<usize>> {
    loop {
        let mut added = false;
        let mut failed = Vec::new();
        for (number, seam) in seams.iter_mut().enumerate() {
            let Some(seam) = seam else { continue };
            for side in 0..2 {
                for way in seam.sides[side].breaks(rings) {
                    if seam.linked(side, way) {
                        continue;
                    }
                    match seam.carry(side, way, reach(number), rings) {
                        Ok(new) => added |= new,
                        Err(()) => failed.push(number),
                    }
                }
            }
            let breaks: usize = rings.rings.iter().map(|ring| ring.breaks.len()).sum();
            if breaks > MOST_BREAKS {
                failed.push(number);
            }
        }
        if !failed.is_empty() {
            failed.dedup();
            return Err(failed);
        }
        // A breakpoint may have come to a seam that was already asked.
        let waiting = seams.iter().flatten().any(|seam| {
            (0..2).any(|side| {
                seam.sides[side].breaks(rings).iter().any(|&way| !seam.linked(side, way))
            })
        });
        if !added && !waiting {
            return Ok(());
        }
    }
}

/// Which intervals share their count of steps.
#[derive(Clone, Debug)]
pub struct Classes {
    /// First interval of each ring among all intervals.
    pub first: Vec<usize>,
    /// The class of each interval: the least number of the intervals in it.
    pub class: Vec<usize>,
}

impl Classes {
    /// Joins the intervals that seams lay on each other.
    pub fn new(rings: &Rings, seams: &[Option<Match>]) -> Self {
        let mut first = Vec::new();
        let mut total = 0;
        for ring in &rings.rings {
            first.push(total);
            total += ring.breaks.len();
        }
        let mut classes = Classes { first, class: (0..total).collect() };
        for seam in seams.iter().flatten() {
            for link in seam.links.windows(2) {
                let interval = |side: usize| {
                    let middle = (link[0][side] + link[1][side]) / 2.0;
                    let (walk, left) = seam.sides[side].walk_at(middle)?;
                    let ring = rings.rings.get(walk.ring)?;
                    Some(classes.first.get(walk.ring)? + ring.interval_at(walk.at(left)))
                };
                if let (Some(a), Some(b)) = (interval(0), interval(1)) {
                    let (a, b) = (classes.root(a), classes.root(b));
                    classes.class[a.max(b)] = a.min(b);
                }
            }
        }
        for interval in 0..total {
            classes.class[interval] = classes.root(interval);
        }
        classes
    }

    fn root(&self, mut interval: usize) -> usize {
        while self.class[interval] != interval {
            interval = self.class[interval];
        }
        interval
    }
}

/// The points of a walk as (ring, interval, step), both ends included; step 0 is the
/// breakpoint at the start of the interval.
pub fn points_of(
    walk: &Walk,
    rings: &Rings,
    steps: impl Fn(usize, usize) -> usize,
) -> Vec<(usize, usize, usize)> {
    let mut points = Vec::new();
    let Some(ring) = rings.rings.get(walk.ring) else { return points };
    let (low, high) = walk.span();
    let mut last = None;
    for arc in ring.breaks_within(low - SAME, high - SAME) {
        let interval = ring.interval_at(arc);
        points.extend((0..steps(walk.ring, interval)).map(|step| (walk.ring, interval, step)));
        last = Some(interval);
    }
    if let Some(interval) = last {
        points.push((walk.ring, (interval + 1) % ring.breaks.len(), 0));
    }
    if walk.to < walk.from {
        points.reverse();
    }
    points
}

impl Match {
    /// The pairs of points that are sewn, from start to end. At the joint of two walks a point
    /// of one side may meet two of the other.
    pub fn pairs(
        &self,
        rings: &Rings,
        steps: impl Fn(usize, usize) -> usize + Copy,
    ) -> Vec<[(usize, usize, usize); 2]> {
        let mut pairs = Vec::new();
        for link in self.links.windows(2) {
            let stretch = |side: usize| {
                let (low, high) = (link[0][side], link[1][side]);
                let (walk, _) = self.sides[side].walk_at((low + high) / 2.0)?;
                let number = self.sides[side].walks.iter().position(|other| *other == walk)?;
                let before = self.sides[side].before.get(number)?;
                let part = Walk { from: walk.at(low - before), to: walk.at(high - before), ..walk };
                Some(points_of(&part, rings, steps))
            };
            if let (Some(a), Some(b)) = (stretch(0), stretch(1)) {
                pairs.extend(a.into_iter().zip(b).map(|(a, b)| [a, b]));
            }
        }
        pairs.dedup();
        pairs
    }
}
