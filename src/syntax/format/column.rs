//! Columns: cells of neighbouring lines that stand below each other.
//!
//! A column reaches over lines that follow each other without a blank line between them; remarks
//! between them do no harm. It stands where most of the lines can have it without a cell being
//! stretched too far; what is longer sticks out, what is much shorter stays as it is. Only the
//! cells themselves decide, so that aligning twice changes nothing.

use super::line::{Edge, Kind, Line};

/// How far a cell may be stretched, in columns.
const STRETCH: usize = 16;

/// How far a comment at the end of a line may move away from it.
const COMMENT_STRETCH: usize = 40;

/// Blanks before a comment at the end of a line, at least.
const COMMENT_GAP: usize = 2;

/// Columns of comments are multiples of this, so that a change of one letter moves few of them.
const COMMENT_STEP: usize = 4;

/// Aligns cells, then comments.
pub(super) fn align(lines: &mut [Line]) {
    let mut group = Vec::new();
    for at in 0..=lines.len() {
        if lines.get(at).is_none_or(|line| line.blank_before) {
            cells(lines, group.clone());
            comments(lines, &group);
            group.clear();
        }
        if lines.get(at).is_some_and(|line| !line.remark) {
            group.push(at);
        }
    }
}

/// Stretches like cells of the lines `group` to like widths, column by column.
fn cells(lines: &mut [Line], group: Vec<usize>) {
    // Lines that agree in all columns before the given one.
    let mut open = vec![(group, 0)];
    while let Some((group, column)) = open.pop() {
        let like = |&a: &usize, &b: &usize| are_like(&lines[a], &lines[b], column);
        let runs: Vec<&[usize]> = group.chunk_by(like).filter(|run| run.len() > 1).collect();
        for run in runs {
            let widths: Vec<usize> =
                run.iter().map(|&at| lines[at].cells[column].width()).collect();
            let limit = match lines[run[0]].cells[column].edge {
                Edge::Column => usize::MAX,
                _ => STRETCH,
            };
            let widest = common(&widths, limit);
            let mut aligned = Vec::with_capacity(run.len());
            for (&at, width) in run.iter().zip(widths) {
                if width <= widest && widest - width <= limit {
                    lines[at].cells[column].gap += widest - width;
                    aligned.push(at);
                }
            }
            open.push((aligned, column + 1));
        }
    }
}

/// Whether two lines may have their cells in the same column.
fn are_like(a: &Line, b: &Line, column: usize) -> bool {
    let (Some(one), Some(other)) = (a.cells.get(column), b.cells.get(column)) else {
        return false;
    };
    a.indent == b.indent
        && one.kind != Kind::Plain
        && one.edge != Edge::End
        && (one.kind, one.edge) == (other.kind, other.edge)
}

/// The width to which most of `widths` can be stretched by at most `limit`; the least of several.
fn common(widths: &[usize], limit: usize) -> usize {
    let mut sorted = widths.to_vec();
    sorted.sort_unstable();
    let (mut best, mut most) = (0, 0);
    let mut first = 0;
    for (at, &width) in sorted.iter().enumerate() {
        while width - sorted[first] > limit {
            first += 1;
        }
        if at + 1 - first > most {
            (best, most) = (width, at + 1 - first);
        }
    }
    best
}

/// Sets the comments at the ends of the lines `group` below each other.
fn comments(lines: &mut [Line], group: &[usize]) {
    let both = |&a: &usize, &b: &usize| lines[a].comment.is_some() && lines[b].comment.is_some();
    let runs: Vec<&[usize]> = group.chunk_by(both).collect();
    for run in runs {
        let widths: Vec<usize> = run.iter().map(|&at| lines[at].width()).collect();
        let widest = common(&widths, COMMENT_STRETCH);
        for (&at, width) in run.iter().zip(widths) {
            let near = width <= widest && widest - width <= COMMENT_STRETCH;
            let from = if near { widest } else { width };
            let column = (from + COMMENT_GAP).next_multiple_of(COMMENT_STEP);
            lines[at].comment_gap = column - width;
        }
    }
}
