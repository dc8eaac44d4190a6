//! Cutting by particles: closed lines of steps from particle to particle of a grid, with the cloth
//! on their left. The outline runs anticlockwise, holes run clockwise.
//!
//! A line between two particles is the 8-connected one that keeps nearest to the straight line
//! (Bresenham 1965); what it bounds is found by a fill that goes from a particle to its four
//! neighbours, so that it cannot slip through where the line goes across (Durupınar 2004, 3.2.2).

use std::collections::{BTreeMap, BTreeSet};

/// A particle: column and row.
pub type Node = [i32; 2];

/// The way from a particle to the next of its line.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    pub from: Node,
    pub name: Option<String>,
    /// Particles that a curve from here to the next step passes through, the last one left out.
    pub through: Option<Vec<Node>>,
}

impl Step {
    fn new(from: Node, name: Option<&str>) -> Self {
        Step { from, name: name.map(str::to_owned), through: None }
    }
}

/// A closed line.
pub type Ring = Vec<Step>;

/// The particles from one to another, the last left out; the same ones back.
fn between(from: Node, to: Node) -> Vec<Node> {
    if from > to {
        let inner = between(to, from).into_iter().skip(1).rev();
        return std::iter::once(from).chain(inner).collect();
    }
    let ([c, r], [to_c, to_r]) = (from, to);
    let (across, up) = (to_c - c, to_r - r);
    let count = across.abs().max(up.abs());
    let at = |way: i32, step: i32| {
        // Rounded to the nearest, halves away from the start.
        let (way, step, count) = (i64::from(way), i64::from(step), i64::from(count));
        ((2 * way * step + count).div_euclid(2 * count)) as i32
    };
    (0..count).map(|step| [c + at(across, step), r + at(up, step)]).collect()
}

/// The line through marked particles, closed, each part with its name.
pub fn line(marks: &[Node], names: &[String]) -> Ring {
    let mut ring = Ring::new();
    for (number, (&from, &to)) in marks.iter().zip(marks.iter().cycle().skip(1)).enumerate() {
        let name = names.get(number).map(String::as_str);
        ring.extend(between(from, to).into_iter().map(|node| Step::new(node, name)));
    }
    ring
}

/// The rim of a rectangle of cells.
pub fn rectangle([across, up]: Node) -> Ring {
    let names = ["bottom", "end", "top", "start"].map(str::to_owned);
    line(&[[0, 0], [across, 0], [across, up], [0, up]], &names)
}

/// Twice the area within a line, in cells; positive for one that runs anticlockwise.
pub fn area(ring: &[Step]) -> i64 {
    let next = ring.iter().cycle().skip(1);
    let part =
        |a: Node, b: Node| i64::from(a[0]) * i64::from(b[1]) - i64::from(b[0]) * i64::from(a[1]);
    ring.iter().zip(next).map(|(a, b)| part(a.from, b.from)).sum()
}

/// The line without what it goes there and back, as where it leaves a corner along the rim; `Err`
/// with a particle that it passes twice all the same.
pub fn simple(ring: &Ring) -> Result<Ring, Node> {
    let mut loops = chained(std::slice::from_ref(ring));
    let mut seen = BTreeSet::new();
    let twice = loops.iter().flatten().map(|step| step.from).find(|node| !seen.insert(*node));
    match (twice, loops.len()) {
        (Some(node), _) => Err(node),
        (None, 0) => Ok(Ring::new()),
        (None, 1) => Ok(loops.swap_remove(0)),
        // Parts that only a way there and back joined.
        _ => Err(ring.first().map_or([0; 2], |step| step.from)),
    }
}

/// The same line the other way round; a step keeps its name.
pub fn reversed(ring: &[Step]) -> Ring {
    let count = ring.len();
    (0..count)
        .map(|k| {
            // The step from b back to a has the name of the one from a to b.
            let end = ring[(count - k) % count].from;
            Step { from: end, ..ring[count - 1 - k].clone() }
        })
        .collect()
}

/// Whether a particle lies within a line or on it.
fn holds(ring: &[Step], [c, r]: Node) -> bool {
    if ring.iter().any(|step| step.from == [c, r]) {
        return true;
    }
    let mut inside = false;
    for (a, b) in ring.iter().zip(ring.iter().cycle().skip(1)) {
        let ([ac, ar], [bc, br]) = (a.from, b.from);
        if (ar <= r) != (br <= r) {
            // Steps go up by one row, so that they cross it at one of their ends.
            let cross = if ar == r { ac } else { bc };
            inside ^= cross > c;
        }
    }
    inside
}

/// The cloth as closed lines.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// The outline, then holes.
    pub rings: Vec<Ring>,
}

/// What becomes of a cut.
#[derive(Debug, PartialEq)]
pub enum Outcome {
    /// The cloth that is kept, and how many pieces fell off.
    Kept(Region, usize),
    /// The fill runs out to this particle.
    Leaks(Node),
    /// The fill begins on the line or off the cloth.
    Nowhere,
}

impl Region {
    /// Whether a particle is one of the cloth.
    pub fn has(&self, node: Node) -> bool {
        let Some((outline, holes)) = self.rings.split_first() else { return false };
        let on_rim = |hole: &Ring| hole.iter().any(|step| step.from == node);
        holds(outline, node) && holes.iter().all(|hole| !holds(hole, node) || on_rim(hole))
    }

    /// Cuts along a closed line and keeps what lies within it or outside of it, as a fill from
    /// `seed` finds it.
    pub fn cut(&self, line: &Ring, inside: bool, seed: Node) -> Outcome {
        let line = if area(line) < 0 { reversed(line) } else { line.clone() };
        let wall: BTreeSet<Node> = line.iter().map(|step| step.from).collect();
        if wall.contains(&seed) || !self.has(seed) {
            return Outcome::Nowhere;
        }
        let mut filled = BTreeSet::from([seed]);
        let mut waiting = vec![seed];
        while let Some([c, r]) = waiting.pop() {
            for next in [[c + 1, r], [c, r + 1], [c - 1, r], [c, r - 1]] {
                if !wall.contains(&next) && !filled.contains(&next) && self.has(next) {
                    filled.insert(next);
                    waiting.push(next);
                }
            }
        }
        if let Some(&leak) = filled.iter().find(|node| holds(&line, **node) != inside) {
            return Outcome::Leaks(leak);
        }
        if inside {
            let within = |hole: &&Ring| hole.iter().all(|step| holds(&line, step.from));
            let holes = self.rings.iter().skip(1).filter(within).cloned();
            return Outcome::Kept(
                Region { rings: std::iter::once(line.clone()).chain(holes).collect() },
                0,
            );
        }
        let lines: Vec<Ring> =
            self.rings.iter().cloned().chain(std::iter::once(reversed(&line))).collect();
        match joined(&lines, |outline| holds(outline, seed)) {
            Some((region, fallen)) => Outcome::Kept(region, fallen),
            None => Outcome::Nowhere,
        }
    }

    /// The cloth of a mask, its bottom row first, and how many pieces are not joined to the
    /// largest; none without any cell.
    pub fn of_mask(rows: &[Vec<bool>]) -> Option<(Region, usize)> {
        let mut lines = Vec::new();
        for (r, row) in rows.iter().enumerate() {
            for (c, _) in row.iter().enumerate().filter(|(_, kept)| **kept) {
                let (c, r) = (c as i32, r as i32);
                let corners = [[c, r], [c + 1, r], [c + 1, r + 1], [c, r + 1]];
                lines.push(corners.map(|corner| Step::new(corner, Some("rim"))).to_vec());
            }
        }
        joined(&lines, |_| true)
    }
}

/// The loops that closed lines bound together: steps there and back cancel.
fn chained(lines: &[Ring]) -> Vec<Ring> {
    let mut ways: BTreeMap<(Node, Node), Option<String>> = BTreeMap::new();
    for ring in lines {
        for (step, next) in ring.iter().zip(ring.iter().cycle().skip(1)) {
            if ways.remove(&(next.from, step.from)).is_none() {
                ways.insert((step.from, next.from), step.name.clone());
            }
        }
    }
    let mut loops: Vec<Ring> = Vec::new();
    while let Some(((start, mut at), name)) = ways.pop_first() {
        let mut ring = vec![Step { from: start, name, through: None }];
        let mut from = start;
        while at != start {
            let leaving = ways.range((at, [i32::MIN; 2])..=(at, [i32::MAX; 2]));
            // Keeping to the left keeps to the same piece where two touch in a particle.
            let next = leaving.max_by_key(|((_, to), _)| turn(from, at, *to));
            let Some((&way, name)) = next else { break };
            ring.push(Step { from: at, name: name.clone(), through: None });
            ways.remove(&way);
            (from, at) = (at, way.1);
        }
        loops.push(ring);
    }
    loops
}

/// The region that closed lines bound together. Of several pieces the largest of those wanted is
/// kept; gives how many were not.
fn joined(lines: &[Ring], wanted: impl Fn(&Ring) -> bool) -> Option<(Region, usize)> {
    let (outlines, holes): (Vec<Ring>, Vec<Ring>) =
        chained(lines).into_iter().partition(|ring| area(ring) > 0);
    let pieces = outlines.len();
    let kept = outlines.into_iter().filter(|outline| wanted(outline));
    let outline = kept.max_by_key(|outline| area(outline))?;
    let own = holes.into_iter().filter(|hole| hole.iter().all(|step| holds(&outline, step.from)));
    let own: Vec<Ring> = own.collect();
    Some((Region { rings: std::iter::once(outline).chain(own).collect() }, pieces - 1))
}

/// How far a line turns to the left, in eighths of a circle, −4 to 3.
fn turn(a: Node, b: Node, c: Node) -> i32 {
    let eighth = |from: Node, to: Node| -> i32 {
        match [(to[0] - from[0]).signum(), (to[1] - from[1]).signum()] {
            [1, 0] => 0,
            [1, 1] => 1,
            [0, 1] => 2,
            [-1, 1] => 3,
            [-1, 0] => 4,
            [-1, -1] => 5,
            [0, -1] => 6,
            _ => 7,
        }
    };
    (eighth(b, c) - eighth(a, b) + 4).rem_euclid(8) - 4
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cut(marks: &[Node], inside: bool, seed: Node) -> Outcome {
        let names: Vec<String> = (1..=marks.len()).map(|n| format!("cut{n}")).collect();
        let region = Region { rings: vec![rectangle([10, 8])] };
        region.cut(&line(marks, &names), inside, seed)
    }

    fn areas(outcome: Outcome) -> (Vec<i64>, usize) {
        match outcome {
            Outcome::Kept(region, fallen) => {
                (region.rings.iter().map(|ring| area(ring)).collect(), fallen)
            }
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn a_line_keeps_near_the_straight_one() {
        assert_eq!(between([0, 0], [5, 2]), [[0, 0], [1, 0], [2, 1], [3, 1], [4, 2]]);
        assert_eq!(between([0, 0], [-2, -2]), [[0, 0], [-1, -1]]);
    }

    #[test]
    fn what_lies_within_is_kept_or_cut_out() {
        let square = [[2, 2], [6, 2], [6, 6], [2, 6]];
        assert_eq!(areas(cut(&square, true, [4, 4])), (vec![32], 0));
        assert_eq!(areas(cut(&square, false, [1, 1])), (vec![160, -32], 0));
        // The other way round it is the same cut.
        let back = [[2, 2], [2, 6], [6, 6], [6, 2]];
        assert_eq!(areas(cut(&back, false, [9, 1])), (vec![160, -32], 0));
    }

    #[test]
    fn a_cut_along_the_rim_takes_a_bite_or_a_part_off() {
        let bite = [[3, 0], [6, 0], [6, 4], [3, 4]];
        assert_eq!(areas(cut(&bite, false, [1, 1])), (vec![160 - 24], 0));
        let band = [[4, 0], [6, 0], [6, 8], [4, 8]];
        assert_eq!(areas(cut(&band, false, [1, 1])), (vec![64], 1));
        assert_eq!(areas(cut(&band, false, [9, 1])), (vec![64], 1));
    }

    #[test]
    fn a_fill_that_runs_out_is_found() {
        let square = [[2, 2], [6, 2], [6, 6], [2, 6]];
        assert!(matches!(cut(&square, true, [1, 1]), Outcome::Leaks(_)));
        assert!(matches!(cut(&square, false, [4, 4]), Outcome::Leaks(_)));
        assert_eq!(cut(&square, true, [2, 4]), Outcome::Nowhere);
        assert_eq!(cut(&square, true, [20, 4]), Outcome::Nowhere);
        // Across corners nothing slips through.
        let diamond = [[5, 1], [8, 4], [5, 7], [2, 4]];
        assert_eq!(areas(cut(&diamond, true, [5, 4])), (vec![36], 0));
    }

    #[test]
    fn a_mask_has_holes_and_loses_what_hangs_by_a_corner() {
        let rows: Vec<Vec<bool>> = ["####.", "#..#.", "####.", "....#"]
            .iter()
            .map(|row| row.chars().map(|sign| sign == '#').collect())
            .collect();
        let (region, fallen) = Region::of_mask(&rows).unwrap();
        assert_eq!(region.rings.iter().map(|ring| area(ring)).collect::<Vec<_>>(), [24, -4]);
        assert_eq!(fallen, 1);
    }
}
