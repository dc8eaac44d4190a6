//! Rows of edges in a seam: how they are walked, and whether they join end to end.

use super::panel::edge::EdgeRef;
use crate::diagnostic::Span;
use crate::garment::panel::Run;
use crate::garment::seam::PanelRun;
use kurbo::Point;

/// Ends of edges nearer than this are one corner, m.
const CORNER: f64 = 1e-4;

/// An edge of one piece in a seam.
#[derive(Clone, Debug)]
pub(super) struct Element {
    pub panel: usize,
    /// In the direction of drawing.
    pub runs: Vec<Run>,
    pub length: f64,
    /// Whether the cloth lies to the left when it is walked as drawn.
    pub left: bool,
    pub ends: (Point, Point),
    /// Half or copy that was not said: the seam is made once for each.
    pub tag: Option<String>,
    pub written: String,
    pub edge: EdgeRef,
}

/// A corner of a piece.
pub(super) type Corner = (usize, Point);

/// One side of a seam.
pub(super) struct Line {
    pub span: Span,
    pub elements: Vec<Vec<Element>>,
}

pub(super) fn same(a: Corner, b: Corner) -> bool {
    a.0 == b.0 && libm::hypot(a.1.x - b.1.x, a.1.y - b.1.y) < CORNER
}

impl Element {
    /// Start and end when walked with the cloth to the left (or to the right).
    pub(super) fn walked(&self, cloth_left: bool) -> (Corner, Corner) {
        let (a, b) = ((self.panel, self.ends.0), (self.panel, self.ends.1));
        if self.left == cloth_left { (a, b) } else { (b, a) }
    }

    pub(super) fn runs(&self, cloth_left: bool) -> Vec<PanelRun> {
        let panel = self.panel;
        if self.left == cloth_left {
            self.runs.iter().map(|&run| PanelRun { panel, run }).collect()
        } else {
            let turn = |run: &Run| Run { from: run.to, to: run.from, ..*run };
            self.runs.iter().rev().map(|run| PanelRun { panel, run: turn(run) }).collect()
        }
    }
}

/// Corners that seams bring together.
#[derive(Default)]
pub(super) struct Corners {
    pub links: Vec<(Corner, Corner)>,
}

impl Corners {
    /// Whether two corners are one, on the panel or through seams.
    pub(super) fn joined(&self, a: Corner, b: Corner) -> bool {
        let mut reached = vec![a];
        let mut next = 0;
        while let Some(&at) = reached.get(next) {
            if same(at, b) {
                return true;
            }
            next += 1;
            for &(p, q) in &self.links {
                for (p, q) in [(p, q), (q, p)] {
                    if same(at, p) && !reached.iter().any(|known| same(*known, q)) {
                        reached.push(q);
                    }
                }
            }
        }
        false
    }

    /// Whether a row joins end to end when walked with the cloth on that side.
    pub(super) fn chains(&self, row: &[Element], cloth_left: bool) -> bool {
        row.windows(2)
            .all(|pair| self.joined(pair[0].walked(cloth_left).1, pair[1].walked(cloth_left).0))
    }
}

/// How much higher, in the drawings, the inner corners of a row lie than its ends, m; 0 for a
/// single edge.
pub(super) fn rise(row: &[Element], cloth_left: bool) -> f64 {
    let (Some((last, others)), Some(first)) = (row.split_last(), row.first()) else { return 0.0 };
    if others.is_empty() {
        return 0.0;
    }
    let inner: f64 = others.iter().map(|element| element.walked(cloth_left).1.1.y).sum();
    let ends = first.walked(cloth_left).0.1.y + last.walked(cloth_left).1.1.y;
    inner / others.len() as f64 - ends / 2.0
}

pub(super) fn length(row: &[Element]) -> f64 {
    row.iter().map(|element| element.length).sum()
}

/// The runs between two shares of a row's length.
pub(super) fn share(runs: &[PanelRun], from: f64, to: f64) -> Vec<PanelRun> {
    let whole: f64 = runs.iter().map(|run| run.run.length()).sum();
    let (low, high) = (from * whole, to * whole);
    let mut passed = 0.0;
    let mut out = Vec::new();
    for part in runs {
        let run = part.run;
        let length = run.length();
        let (a, b) = ((low - passed).max(0.0), (high - passed).min(length));
        passed += length;
        if b - a < 1e-7 {
            continue;
        }
        let sense = if run.to > run.from { 1.0 } else { -1.0 };
        let start = if a <= 1e-9 { run.from } else { run.from + sense * a };
        let end = if b >= length - 1e-9 { run.to } else { run.from + sense * b };
        out.push(PanelRun { panel: part.panel, run: Run { from: start, to: end, ..run } });
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(piece: usize, from: f64, to: f64) -> PanelRun {
        PanelRun { panel: 0, run: Run { ring: 0, piece, from, to } }
    }

    #[test]
    fn a_share_of_a_row_crosses_its_runs() {
        let row = [run(0, 0.0, 1.0), run(3, 2.0, 0.0)];
        let total = |runs: &[PanelRun]| runs.iter().map(|r| r.run.length()).sum::<f64>();
        assert_eq!(share(&row, 0.0, 1.0), row);
        let part = share(&row, 0.2, 0.5);
        assert_eq!(part.len(), 2);
        assert!((total(&part) - 0.9).abs() < 1e-12);
        // The second run goes against its piece, so it is cut from its far end.
        assert_eq!(part[1].run.from, 2.0);
        assert!((part[1].run.to - 1.5).abs() < 1e-12);
    }

    #[test]
    fn corners_join_through_seams() {
        let at = |x: f64| Point::new(x, 0.0);
        let corners =
            Corners { links: vec![((0, at(0.0)), (1, at(5.0))), ((1, at(5.0)), (2, at(1.0)))] };
        assert!(corners.joined((0, at(0.0)), (2, at(1.0))));
        assert!(!corners.joined((0, at(0.0)), (2, at(2.0))));
    }
}
