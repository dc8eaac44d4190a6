//! Motifs made of others: repeats, and borders that turn round corners.

use super::Motif;
use crate::textile::Colour;

/// How the next motif lies beside the one before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Repeat {
    /// As it does.
    Straight,
    /// Half its height lower, every second column.
    HalfDrop,
    /// As in a mirror, to the side and upwards.
    Mirrored,
    /// Turned by half a turn.
    Rotated,
}

/// Cells in which a motif and its parts are read.
fn cell(motif: &Motif, column: usize, row: usize) -> Option<Colour> {
    motif.rows.get(row)?.get(column).copied().flatten()
}

/// A motif so many times side by side and above itself.
pub fn repeated(motif: &Motif, repeat: Repeat, across: usize, up: usize) -> Motif {
    let (wide, high) = (motif.width(), motif.height());
    let at = |x: usize, y: usize| {
        let (column, row) = (x / wide, y / high);
        let (u, v) = (x % wide, y % high);
        match repeat {
            Repeat::Straight => cell(motif, u, v),
            // What falls out below comes in above.
            Repeat::HalfDrop if column % 2 == 1 => cell(motif, u, (y + high / 2) % high),
            Repeat::HalfDrop => cell(motif, u, v),
            Repeat::Mirrored => {
                let u = if column % 2 == 1 { wide - 1 - u } else { u };
                let v = if row % 2 == 1 { high - 1 - v } else { v };
                cell(motif, u, v)
            }
            Repeat::Rotated if (column + row) % 2 == 1 => cell(motif, wide - 1 - u, high - 1 - v),
            Repeat::Rotated => cell(motif, u, v),
        }
    };
    let rows = (0..high * up).map(|y| (0..wide * across).map(|x| at(x, y)).collect()).collect();
    let size = [motif.size[0] * across as f64, motif.size[1] * up as f64];
    Motif { name: motif.name.clone(), rows, size }
}

/// A frame of a border: so many motifs along its lower and upper side and so many along the others,
/// each standing with its foot outwards. At the corners the two sides meet on the diagonal, as
/// boards do in a mitre, and the border runs on into it from both.
pub fn framed(border: &Motif, across: usize, up: usize) -> Motif {
    let (wide, high) = (border.width(), border.height());
    let (columns, rows) = (across * wide + 2 * high, up * wide + 2 * high);
    let at = |x: usize, y: usize| {
        let (left, right, below, above) = (x, columns - 1 - x, y, rows - 1 - y);
        let depth = left.min(right).min(below).min(above);
        if depth >= high {
            return None;
        }
        // How far along the side, as one looks from outside.
        // A corner belongs to the side that ends there.
        let along = match depth {
            _ if depth == below && left > depth => x,
            _ if depth == right && below > depth => y,
            _ if depth == above && right > depth => right,
            _ => above,
        };
        // The first whole motif begins behind the corner.
        let along = (along + wide * high - high) % wide;
        cell(border, along, depth)
    };
    let cells = (0..rows).map(|y| (0..columns).map(|x| at(x, y)).collect()).collect();
    let pitch = [border.size[0] / wide as f64, border.size[1] / high as f64];
    let size = [pitch[0] * columns as f64, pitch[1] * rows as f64];
    Motif { name: border.name.clone(), rows: cells, size }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOLD: Colour = Colour([200, 160, 60, 255]);

    /// A motif of these rows, top row first.
    fn motif(rows: &[&str]) -> Motif {
        let cell = |c| (c != '.').then_some(Colour([c as u8, 0, 0, 255]));
        let rows: Vec<Vec<_>> = rows.iter().rev().map(|r| r.chars().map(cell).collect()).collect();
        let size = [rows[0].len() as f64, rows.len() as f64];
        Motif { name: "m".into(), rows, size }
    }

    fn shown(motif: &Motif) -> Vec<String> {
        let letter = |cell: &Option<Colour>| cell.map_or('.', |it| char::from(it.0[0]));
        motif.rows.iter().rev().map(|row| row.iter().map(letter).collect()).collect()
    }

    #[test]
    fn motifs_repeat_in_four_ways() {
        let leaf = motif(&["ab", "c."]);
        let shown = |repeat| shown(&repeated(&leaf, repeat, 2, 2));
        assert_eq!(shown(Repeat::Straight), ["abab", "c.c.", "abab", "c.c."]);
        assert_eq!(shown(Repeat::HalfDrop), ["abc.", "c.ab", "abc.", "c.ab"]);
        assert_eq!(shown(Repeat::Mirrored), ["c..c", "abba", "abba", "c..c"]);
        assert_eq!(shown(Repeat::Rotated), [".cab", "bac.", "ab.c", "c.ba"]);
        assert_eq!(repeated(&leaf, Repeat::Straight, 3, 2).size, [6.0, 4.0]);
    }

    #[test]
    fn a_frame_turns_its_corners_on_the_diagonal() {
        let border = motif(&["b.", "aa"]);
        let frame = framed(&border, 1, 1);
        let wanted = ["aaaaaa", "ab.bba", "ab...a", "a...ba", "abb.ba", "aaaaaa"];
        assert_eq!(shown(&frame), wanted);
        // Each side seen from outside is the border: a quarter turn gives the same frame.
        let rows = &frame.rows;
        let turned: Vec<Vec<_>> =
            (0..6).map(|y| (0..6).map(|x| rows[5 - x][y]).collect()).collect();
        assert_eq!(*rows, turned);
        assert_eq!(rows[2][2], None);
        assert_eq!(frame.size, [6.0, 6.0]);
        let plain = Motif { rows: vec![vec![Some(GOLD)]], size: [1.0, 1.0], ..border };
        let ring = framed(&plain, 3, 2);
        assert_eq!((ring.width(), ring.height()), (5, 4));
        let gold = ring.rows.iter().flatten().filter(|cell| cell.is_some()).count();
        assert_eq!(gold, 2 * 5 + 2 * 2);
    }
}
