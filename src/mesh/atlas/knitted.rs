//! Loops of a knitted tile. Each course is one strand; its middle line is the closed form of
//! plain knitting, γ(t) = (t + a sin 2t, h cos t, d cos 2t) (Crane 2023, "snug" figures a = 3/2,
//! h = 4, course to course h + 1/2, wale to wale 2π), with the depth led by the chart: legs come
//! forward in a face loop and go back in a back loop, and the head of a loop lies behind or
//! before the legs drawn through it in the course above.

use super::noise;
use super::strand::{Node, Strand};
use super::tile::{Grid, Look};
use crate::textile::knit::{Knit, Stitch};
use crate::textile::yarn::{Fibre, Yarn};
use std::collections::BTreeMap;
use std::f32::consts::PI;

/// Sideways swing of the loop.
const SWING: f32 = 1.5;
/// Half the height of a loop over the distance of courses.
const RISE: f32 = 4.0 / 4.5;

/// The looks of the yarns over the `wales` of a tile, one for each colour of the chart in the order
/// of its [palette](crate::textile::knit::Chart::palette); cells without a colour have the yarn's.
pub fn looks(knit: &Knit, yarn: &Yarn, wales: usize) -> Vec<Look> {
    let length = knit.loop_length() * wales as f64;
    let palette = knit.chart.palette();
    palette.iter().map(|it| Look::of(yarn, it.unwrap_or(yarn.colour), length)).collect()
}

/// Width of the yarn over the distance of wales: as thick as it is, but neither so thin that the
/// loops do not meet nor so thick that they cannot pass each other.
pub fn filled(knit: &Knit, yarn: &Yarn) -> f64 {
    (1.6 * yarn.diameter * knit.wales).clamp(0.33, 0.42)
}

/// The strands of a tile of `stitches` wales and courses: the stretches of one colour of each
/// course. `seen` are the loops of the side that is drawn.
pub fn strands(
    knit: &Knit,
    seen: &[Vec<Stitch>],
    yarn: &Yarn,
    stitches: [usize; 2],
    grid: &Grid,
) -> Vec<Strand> {
    let [wales, courses] = stitches;
    let wale = grid.width as f32 / wales as f32;
    let course = grid.height as f32 / courses as f32;
    let parts = ((wale * 0.7) as usize).clamp(12, 36);
    let half = filled(knit, yarn) as f32 * wale / 2.0;
    let uneven = match yarn.fibre {
        Fibre::Wool | Fibre::Linen | Fibre::Jute => 1.0,
        _ => 0.6,
    };
    let relief = Relief::of(seen);
    let palette = knit.chart.palette();
    let numbers: BTreeMap<_, usize> =
        palette.iter().map(|colour| colour.map(|it| it.0)).zip(0..).collect();
    (0..courses)
        .flat_map(|row| {
            let loops = Loops { seen, wale, course, row, half, uneven, stitches };
            let number = |wale: usize| {
                let colour = knit.chart.colour(wale % knit.width(), row % knit.height());
                numbers.get(&colour.map(|it| it.0)).copied().unwrap_or(0)
            };
            let mut strands: Vec<Strand> = Vec::new();
            let mut along = 0.0;
            let mut last: Option<Node> = None;
            for n in 0..=wales * parts {
                let t = (n % parts) as f32 / parts as f32 * 2.0 * PI - PI;
                let mut at = loops.at((n / parts) as i64, t);
                at[2] += wale * relief.at(n as f32 / parts as f32 - 0.5, row);
                if let Some(last) = last {
                    let d = [0, 1, 2].map(|axis| at[axis] - last.at[axis]);
                    along += (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt();
                }
                let share = n as f32 / (wales * parts) as f32;
                let swell =
                    noise::line(77 ^ ((row as u32) << 8), share * wales as f32, wales as u32);
                let node = Node { at, half: half * (1.0 + 0.05 * uneven * swell), along };
                last = Some(node);
                let within = n / parts < wales;
                if let Some(strand) = strands.last_mut() {
                    strand.nodes.push(node);
                    let yarn = if within { number(n / parts) } else { strand.yarn };
                    if strand.yarn == yarn {
                        continue;
                    }
                }
                // A yarn of another colour takes over at the foot where the two loops meet.
                if within {
                    let yarn = number(n / parts);
                    let nodes = vec![node];
                    strands.push(Strand { nodes, flatness: 0.8, yarn, length: 0.0 });
                }
            }
            strands.iter_mut().for_each(|strand| strand.length = along);
            strands
        })
        .collect()
}

/// The loops of one course.
struct Loops<'a> {
    seen: &'a [Vec<Stitch>],
    wale: f32,
    course: f32,
    row: usize,
    half: f32,
    uneven: f32,
    stitches: [usize; 2],
}

impl Loops<'_> {
    /// 1 where the loop in this wale, `up` courses above this one, is a face loop, −1 else.
    fn side(&self, wale: i64, up: usize) -> f32 {
        let wale = wale.rem_euclid(self.stitches[0] as i64) as usize;
        side(self.seen, wale, (self.row + up) % self.stitches[1])
    }

    /// A point of the loop in wale `wale` (which may be the image of the first in the next
    /// tile), px; t from −π, the foot on the left, through 0, the head, to π.
    fn at(&self, wale: i64, t: f32) -> [f32; 3] {
        let neighbour = if t < 0.0 { wale - 1 } else { wale + 1 };
        let leg = self.side(wale, 0);
        let end = if t.abs() < PI / 2.0 {
            -self.side(wale, 1)
        } else {
            -(leg + self.side(neighbour, 0)) / 2.0
        };
        let (sine, cosine) = (libm::sinf(2.0 * t), libm::cosf(2.0 * t));
        let forward = end + (leg - end) * (1.0 - cosine) / 2.0;
        let number = wale.rem_euclid(self.stitches[0] as i64) as u32;
        let chance = |what: u32| self.uneven * noise::signed(what, number, self.row as u32);
        // The unevenness of a loop vanishes at its feet, where it meets its neighbours.
        let middle = (1.0 + libm::cosf(t)) / 2.0;
        let x = wale as f32 + 0.5 + (t + SWING * sine) / (2.0 * PI) + 0.035 * chance(1) * middle;
        let y = self.row as f32
            + 0.5
            + RISE * libm::cosf(t) * (1.0 + 0.03 * chance(2) * middle)
            + 0.03 * chance(3) * middle;
        [x * self.wale, y * self.course, forward * self.half * 0.95]
    }
}

/// 1 where this wale and course, counted round the repeat, show a face loop, −1 else.
fn side(seen: &[Vec<Stitch>], wale: usize, course: usize) -> f32 {
    let row = &seen[course % seen.len()];
    match row[wale % row.len()] {
        Stitch::Face => 1.0,
        Stitch::Back => -1.0,
    }
}

/// How far the cloth itself comes forward, in wale widths: knit wales stand out beside purl
/// wales, purl courses beside knit courses.
struct Relief {
    rows: Vec<Vec<f32>>,
}

impl Relief {
    fn of(seen: &[Vec<Stitch>]) -> Relief {
        let (width, height) = (seen[0].len() as i64, seen.len() as i64);
        let side = |wale: i64, row: i64| {
            side(seen, wale.rem_euclid(width) as usize, row.rem_euclid(height) as usize)
        };
        const REACH: i64 = 3;
        let mean = |wale: i64, row: i64, step: [i64; 2]| {
            let sum: f32 =
                (-REACH..=REACH).map(|n| side(wale + n * step[0], row + n * step[1])).sum();
            sum / (2 * REACH + 1) as f32
        };
        let rows = (0..height)
            .map(|row| {
                (0..width)
                    .map(|wale| 0.16 * (mean(wale, row, [0, 1]) - mean(wale, row, [1, 0])))
                    .collect()
            })
            .collect();
        Relief { rows }
    }

    /// At a place counted in wales from the middle of the first.
    fn at(&self, place: f32, row: usize) -> f32 {
        let row = &self.rows[row % self.rows.len()];
        let cell = place.floor();
        let value = |n: i64| row[n.rem_euclid(row.len() as i64) as usize];
        let t = noise::ease(place - cell);
        value(cell as i64) * (1.0 - t) + value(cell as i64 + 1) * t
    }
}
