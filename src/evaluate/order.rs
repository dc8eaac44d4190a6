//! The order of seams along edges: where two seams join the same two edges, they lie in the same
//! order along both.

use super::Evaluator;
use super::garment::Making;
use crate::diagnostic::Diagnostic;
use crate::garment::seam::{PanelRun, SeamKind};
use std::collections::BTreeMap;

/// A piece of an outline: panel, loop, number in the loop.
type Piece = (usize, usize, usize);

/// A seam from a stretch of one piece to a stretch of another.
struct Joined {
    /// The number of the seam.
    seam: usize,
    /// The middles of both stretches along their pieces, m.
    middles: (f64, f64),
    /// Whether the arc lengths of both grow in the same sense along the seam.
    alike: bool,
}

fn piece(on: &PanelRun) -> Piece {
    (on.panel, on.run.ring, on.run.piece)
}

fn middle(on: &PanelRun) -> f64 {
    0.5 * (on.run.from + on.run.to)
}

impl<'t> Evaluator<'t> {
    /// Tells of seams that cross each other (E0507): one joins the upper part of an edge to the
    /// lower part of another, and one the lower part to the upper. False if there are any.
    pub(super) fn seams_lie_in_order(&mut self, making: &Making) -> bool {
        let mut joined: BTreeMap<(Piece, Piece), Vec<Joined>> = BTreeMap::new();
        for (number, seam) in making.garment.seams.iter().enumerate() {
            let ([a], [b]) = (seam.a.as_slice(), seam.b.as_slice()) else { continue };
            if !matches!(seam.kind, SeamKind::Plain | SeamKind::Zip) || piece(a) == piece(b) {
                continue;
            }
            let (a, b) = if piece(a) < piece(b) { (a, b) } else { (b, a) };
            let alike = (a.run.to > a.run.from) == (b.run.to > b.run.from);
            let seam = Joined { seam: number, middles: (middle(a), middle(b)), alike };
            joined.entry((piece(a), piece(b))).or_default().push(seam);
        }
        let mut sound = true;
        for seams in joined.values_mut() {
            seams.sort_by(|a, b| a.middles.0.total_cmp(&b.middles.0).then(a.seam.cmp(&b.seam)));
            for pair in seams.windows(2) {
                let [one, other] = pair else { continue };
                let follows = (other.middles.1 > one.middles.1) == one.alike;
                if one.alike != other.alike || follows {
                    continue;
                }
                sound = false;
                let seam = |number: usize| making.garment.seams.get(number);
                let first = seam(one.seam.min(other.seam));
                let Some((first, second)) = first.zip(seam(one.seam.max(other.seam))) else {
                    continue;
                };
                self.tell(
                    Diagnostic::new("E0507", "these seams cross each other")
                        .at(second.span, format!("`{}`", second.name))
                        .at(first.span, format!("`{}`", first.name))
                        .help("exchange two of their sides: what comes first on one edge comes first on the other"),
                );
            }
        }
        sound
    }
}
