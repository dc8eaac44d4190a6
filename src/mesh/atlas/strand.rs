//! Strands of yarn laid into a square of cloth that closes on itself: from their middle lines to
//! what is seen from above in each pixel.
//!
//! Lengths are pixels of the field, x to the right, y **up**, z towards the viewer. A strand that
//! leaves the field on one side comes in on the other, so whatever is laid out periodically
//! tiles by construction.

use rayon::prelude::*;

/// A point of a strand's middle line.
#[derive(Clone, Copy, Debug)]
pub struct Node {
    /// Place, px.
    pub at: [f32; 3],
    /// Half the strand's width here, px.
    pub half: f32,
    /// Length of yarn from the strand's first node, px.
    pub along: f32,
}

/// A strand: its middle line from its first node to the first node's image in the next tile.
#[derive(Clone, Debug)]
pub struct Strand {
    /// Its nodes.
    pub nodes: Vec<Node>,
    /// Half its height over half its width: 1 is round, less is flattened.
    pub flatness: f32,
    /// Which of the cloth's yarns it is.
    pub yarn: usize,
    /// Length of yarn in the tile, px; more than that of its nodes where it is a stretch of a
    /// course. The twist of the yarn is laid out over it.
    pub length: f32,
}

/// Length of yarn up to the last of these nodes, px.
pub fn length(nodes: &[Node]) -> f32 {
    nodes.last().map_or(1.0, |node| node.along)
}

/// What is seen in one pixel of a field.
#[derive(Clone, Copy, Debug)]
pub struct Seen {
    /// Height of the surface, px; [`GAP`] where there is none.
    pub height: f32,
    /// Place across the strand, −1 at its left edge to 1 at its right, looking along it.
    pub across: f32,
    /// Place along the strand, px of yarn.
    pub along: f32,
    /// Number of the strand.
    pub strand: u32,
}

/// Height where no strand lies.
pub const GAP: f32 = f32::NEG_INFINITY;

/// Rows of a field that one task draws.
const BAND: usize = 32;

/// Lays strands into a field of `width` × `height` px and gives what is seen, bottom row first: the
/// highest surface, and of equal ones the first.
pub fn lay(strands: &[Strand], width: usize, height: usize) -> Vec<Seen> {
    let nothing = Seen { height: GAP, across: 0.0, along: 0.0, strand: 0 };
    let mut field = vec![nothing; width * height];
    if width == 0 || height == 0 {
        return field;
    }
    let bands = height.div_ceil(BAND);
    let mut pieces: Vec<Vec<(u32, u32)>> = vec![Vec::new(); bands];
    for (number, strand) in strands.iter().enumerate() {
        for (piece, ends) in strand.nodes.windows(2).enumerate() {
            let [low, high] = rows_of(ends);
            // A piece taller than the field would come round again; none is.
            let high = high.min(low + height as i64 - 1);
            let mut last = usize::MAX;
            for row in low..=high {
                let band = row.rem_euclid(height as i64) as usize / BAND;
                if band != last {
                    pieces[band].push((number as u32, piece as u32));
                    last = band;
                }
            }
        }
    }
    field.par_chunks_mut(BAND * width).zip(&pieces).enumerate().for_each(
        |(band, (rows, pieces))| {
            let window = Window { first: band * BAND, width, height };
            for &(number, piece) in pieces {
                let strand = &strands[number as usize];
                let ends = &strand.nodes[piece as usize..piece as usize + 2];
                window.lay_piece(rows, strand, number, ends);
            }
        },
    );
    field
}

/// How far a piece is drawn beyond its ends, as a share of its half width, so that no wedge is
/// left open where two pieces meet at an angle.
const OVERLAP: f32 = 0.35;

/// The box that a piece fills: least and greatest x, least and greatest y.
fn bounds(ends: &[Node]) -> [f32; 4] {
    let [a, b] = [ends[0], ends[1]];
    let (dx, dy) = (b.at[0] - a.at[0], b.at[1] - a.at[1]);
    let length = (dx * dx + dy * dy).sqrt().max(1e-6);
    let half = a.half.max(b.half);
    let reach = |along: f32, aside: f32| half * (OVERLAP * along.abs() + aside.abs()) / length;
    let (x, y) = (reach(dx, dy), reach(dy, dx));
    [
        a.at[0].min(b.at[0]) - x,
        a.at[0].max(b.at[0]) + x,
        a.at[1].min(b.at[1]) - y,
        a.at[1].max(b.at[1]) + y,
    ]
}

/// The rows that a piece touches.
fn rows_of(ends: &[Node]) -> [i64; 2] {
    let [_, _, low, high] = bounds(ends);
    [low.floor() as i64, high.ceil() as i64]
}

/// A few rows of the field.
struct Window {
    first: usize,
    width: usize,
    height: usize,
}

impl Window {
    fn lay_piece(&self, rows: &mut [Seen], strand: &Strand, number: u32, ends: &[Node]) {
        let [a, b] = [ends[0], ends[1]];
        let [left, right, low, high] = bounds(ends);
        let (dx, dy) = (b.at[0] - a.at[0], b.at[1] - a.at[1]);
        let square = (dx * dx + dy * dy).max(1e-12);
        let length = square.sqrt();
        let beyond = OVERLAP * a.half.max(b.half) / length;
        let (left, right) = (left.floor() as i64, right.ceil() as i64);
        let peak = a.at[2].max(b.at[2]) + a.half.max(b.half) * strand.flatness;
        let left_column = left.rem_euclid(self.width as i64) as usize;
        for row in low.floor() as i64..=high.ceil() as i64 {
            let place = row.rem_euclid(self.height as i64) as usize;
            let Some(line) = place.checked_sub(self.first).filter(|&line| line < BAND) else {
                continue;
            };
            let Some(row_seen) = rows.get_mut(line * self.width..(line + 1) * self.width) else {
                continue;
            };
            let y = row as f32 + 0.5 - a.at[1];
            let mut at = left_column;
            for column in left..=right {
                let seen = &mut row_seen[at];
                at = if at + 1 == self.width { 0 } else { at + 1 };
                if peak <= seen.height {
                    continue;
                }
                let x = column as f32 + 0.5 - a.at[0];
                let t = (x * dx + y * dy) / square;
                if t < -beyond || t > 1.0 + beyond {
                    continue;
                }
                let t = t.clamp(0.0, 1.0);
                let half = a.half + (b.half - a.half) * t;
                let (off_x, off_y) = (x - dx * t, y - dy * t);
                let q = (off_x * off_x + off_y * off_y) / (half * half);
                let z = a.at[2] + (b.at[2] - a.at[2]) * t;
                let top = half * strand.flatness;
                if q >= 1.0 || z + top <= seen.height {
                    continue;
                }
                let height = z + top * (1.0 - q).sqrt();
                if height > seen.height {
                    *seen = Seen {
                        height,
                        across: q.sqrt().copysign(x * dy - y * dx),
                        along: a.along + (b.along - a.along) * t,
                        strand: number,
                    };
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn across(y: f32, z: f32) -> Strand {
        let node = |x: f32| Node { at: [x, y, z], half: 3.0, along: x };
        let nodes = vec![node(-4.0), node(30.0), node(60.0)];
        Strand { nodes, flatness: 1.0, yarn: 0, length: 64.0 }
    }

    #[test]
    fn the_higher_strand_is_seen_and_the_lower_beside_it() {
        let field = lay(&[across(10.0, 0.0), across(12.0, 1.0)], 64, 40);
        let at = |x: usize, y: usize| field[y * 64 + x];
        assert_eq!(at(20, 12).strand, 1);
        assert_eq!(at(20, 7).strand, 0);
        assert_eq!(at(20, 25).height, GAP);
        // Just above the axis of a round strand of radius 3 the surface is 3 high.
        assert!((at(20, 12).height - (1.0 + 3.0 * (1.0f32 - 0.25 / 9.0).sqrt())).abs() < 1e-5);
    }

    #[test]
    fn a_strand_leaves_on_one_side_and_comes_in_on_the_other() {
        let field = lay(&[across(39.0, 0.0)], 64, 40);
        assert!(field[20].height > GAP, "row 0 shows the part beyond the top");
        assert!(field[39 * 64 + 63].height > GAP, "x = −4 … 0 lies at the right edge");
    }
}
