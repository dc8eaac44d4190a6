//! Point sewn to point: `seam points`, `seam near`, buttons and hooks.

use super::Evaluator;
use super::fields::{Arg, Phrase};
use super::garment::Making;
use super::item::ItemId;
use super::panel::edge::EdgeRef;
use super::value::Value;
use crate::diagnostic::Diagnostic;
use crate::garment::panel::{Band, BandKind, Run};
use crate::garment::scene::Placement;
use crate::garment::seam::{Nearby, Stitches};
use crate::syntax::tree::{Expr, ExprKind};
use crate::units::{self, Dimension};

/// How far from their edges buttons are set, m, where nothing else is said.
const INSET: f64 = 0.015;
/// Closures of one line at most.
const MOST: i64 = 200;
/// How much farther out than the edge below it an edge that lies over it begins, m.
const OVER: f64 = 0.006;

/// A panel of the garment and a place in its drawing.
type Spot = (usize, [f64; 2]);

impl<'t> Evaluator<'t> {
    /// One line that sews point to point; none if it is wrong.
    pub(super) fn stitch(&mut self, phrase: &Phrase<'t>, making: &mut Making) -> Option<()> {
        match phrase.word.name {
            "seam" if !phrase.head.is_empty() => {
                let said = phrase.clause("points").or(phrase.clause("near"));
                self.tell(
                    Diagnostic::new("E0207", "a seam of edges needs no `points` and no `near`")
                        .at(said.map_or(phrase.span, |said| said.span), "here"),
                );
                None
            }
            "seam" if phrase.says("points") => self.points(phrase, making),
            "seam" => self.near(phrase, making),
            _ => self.closures(phrase, making),
        }
    }

    /// `seam points front(3, 4) -> back(0, 4)`
    fn points(&mut self, phrase: &Phrase<'t>, making: &mut Making) -> Option<()> {
        let args = phrase.values("points");
        let mut spots: Vec<Vec<Spot>> = Vec::new();
        for arg in &args {
            spots.push(self.spots(*arg, making)?);
        }
        let (first, others) = spots.split_first()?;
        let mut pairs = Vec::new();
        for other in others {
            if other.len() != first.len() {
                self.tell(
                    Diagnostic::new("E0505", "which halves are sewn together?")
                        .at(phrase.span, "one is cut once, the other twice")
                        .help("name the half: `front.left(3, 4)`"),
                );
                return None;
            }
            pairs.extend(first.iter().zip(other).map(|(a, b)| [*a, *b]));
        }
        let texts: Vec<&str> = args.iter().map(|arg| self.snippet(arg.expr.span)).collect();
        let name = texts.join(" -> ");
        making.garment.stitches.push(Stitches { name, span: phrase.span, closure: false, pairs });
        Some(())
    }

    /// The places that `front(3, 4)` or `front.side.start` names, one for each copy of the piece.
    pub(super) fn spots(&mut self, arg: Arg<'t>, making: &Making) -> Option<Vec<Spot>> {
        let ExprKind::Call(base, nodes) = &arg.expr.kind else {
            return match self.eval(arg.expr, arg.scope) {
                Value::Poison => None,
                Value::Mark(mark) => {
                    Some(vec![(*making.numbers.get(&(mark.draft.item, mark.piece))?, mark.at)])
                }
                other => {
                    self.wrong(
                        &other,
                        "a particle such as `front(3, 4)`, or a corner",
                        arg.expr.span,
                    );
                    None
                }
            };
        };
        let node = self.node(nodes.iter().map(|node| &node.value).collect(), arg)?;
        let pieces = self.placed_pieces(Arg { expr: base, ..arg })?;
        let mut spots = Vec::new();
        for (id, numbers, _) in pieces {
            let draft = self.panel(id, arg.expr.span)?;
            let Some(grid) = draft.counted else {
                self.tell(
                    Diagnostic::new(
                        "E0304",
                        format!("the grid of `{}` is not counted", draft.name),
                    )
                    .at(arg.expr.span, "which particle is this?")
                    .help("give it a `size` and `grid: 40 x 60`, or a `mask`"),
                );
                return None;
            };
            if !grid.has(node) {
                let [across, up] = grid.count;
                self.tell(
                    Diagnostic::new("E0303", format!("`{}` has no such particle", draft.name))
                        .at(arg.expr.span, format!("they go from (0, 0) to ({across}, {up})")),
                );
                return None;
            }
            let [x, y] = grid.place(node);
            for number in numbers {
                // The second of a pair is the mirror image.
                let x = if number > 0 { -x } else { x };
                spots.push((*making.numbers.get(&(id, number))?, [x, y]));
            }
        }
        Some(spots)
    }

    /// Column and row in the brackets behind a panel.
    fn node(&mut self, parts: Vec<&'t Expr>, arg: Arg<'t>) -> Option<[i32; 2]> {
        let [column, row] = parts.as_slice() else {
            self.tell(
                Diagnostic::new("E0306", "a particle is counted by its column and its row")
                    .at(arg.expr.span, "such as `front(3, 4)`"),
            );
            return None;
        };
        let mut whole = |expr: &'t Expr| {
            self.whole_number(Arg { expr, ..arg }, 0, 1_000_000).map(|number| number as i32)
        };
        Some([whole(column)?, whole(row)?])
    }

    /// `seam near A -> B within 1cm`
    fn near(&mut self, phrase: &Phrase<'t>, making: &mut Making) -> Option<()> {
        let Some(within) = phrase.value("within") else {
            self.tell(
                Diagnostic::new("E0208", "`near` wants `within`")
                    .at(phrase.span, "how near?")
                    .help("`seam near a.end -> b.start within 1cm`"),
            );
            return None;
        };
        let within = self.within_range(within, Dimension::LENGTH, 1e-4, 1.0)?;
        let args = phrase.values("near");
        let mut rims = Vec::new();
        for arg in &args {
            rims.push(self.rims(*arg, making)?);
        }
        let (first, others) = rims.split_first()?;
        for (other, arg) in others.iter().zip(args.iter().skip(1)) {
            let name = format!(
                "{} -> {}",
                self.snippet(args.first()?.expr.span),
                self.snippet(arg.expr.span)
            );
            let sides = [first.clone(), other.clone()];
            making.garment.nearby.push(Nearby { name, span: phrase.span, sides, within });
        }
        Some(())
    }

    /// Panels, with the edges where edges are named.
    fn rims(&mut self, arg: Arg<'t>, making: &Making) -> Option<Vec<(usize, Option<usize>)>> {
        let mut rims = Vec::new();
        let number = |id: ItemId, piece: usize| making.numbers.get(&(id, piece)).copied();
        if let Value::Edges(edges) = self.eval(arg.expr, arg.scope) {
            if !self.all_on_rim(&edges, arg) {
                return None;
            }
            for edge in &edges {
                if edge.part.is_some() {
                    self.tell(
                        Diagnostic::new("E0304", "`near` goes along whole edges")
                            .at(arg.expr.span, "this is a part"),
                    );
                    return None;
                }
                for found in edge.find() {
                    rims.push((number(edge.draft.item, found.piece)?, Some(found.edge)));
                }
            }
            return Some(rims);
        }
        for (id, pieces, _) in self.placed_pieces(arg)? {
            for piece in pieces {
                rims.push((number(id, piece)?, None));
            }
        }
        Some(rims)
    }

    /// `button E over E count N every L inset L`
    fn closures(&mut self, phrase: &Phrase<'t>, making: &mut Making) -> Option<()> {
        let upper = self.closed_edge(phrase.arg(0)?)?;
        let lower = self.closed_edge(phrase.value("over")?)?;
        let count = self.whole_number(phrase.value("count")?, 1, MOST)?;
        let inset = match phrase.value("inset") {
            Some(arg) => Some(self.within_range(arg, Dimension::LENGTH, 0.0, 0.5)?),
            None => None,
        };
        let usual = if phrase.word.name == "hook" { 0.0 } else { INSET };
        let [above, below] = [&upper, &lower]
            .map(|edge| inset.unwrap_or_else(|| on_placket(edge, making).unwrap_or(usual)));
        let length = upper.length().min(lower.length());
        let every = match phrase.value("every") {
            Some(arg) => self.within_range(arg, Dimension::LENGTH, 1e-3, 10.0)?,
            None => length / count as f64,
        };
        let taken = every * (count - 1) as f64;
        if taken > length {
            self.tell(
                Diagnostic::new(
                    "E0303",
                    format!(
                        "{count} of them every {} take {}",
                        units::length(every),
                        units::length(taken)
                    ),
                )
                .at(phrase.span, format!("the edges are {} long", units::length(length)))
                .help("fewer, or nearer to each other"),
            );
            return None;
        }
        let mut pairs = Vec::new();
        for number in 0..count {
            let way = 0.5 * (length - taken) + every * number as f64;
            let a = spot(&upper, way, above, making)?;
            let b = spot(&lower, way, below, making)?;
            pairs.push([a, b]);
        }
        // What lies over begins farther out.
        let [(above, _), (below, _)] = pairs.first()?;
        let gap_below = match making.garment.panels.get(*below)?.placement {
            Placement::Wrapped { gap, .. } => Some(gap),
            _ => None,
        };
        if let (Some(below), Some(Placement::Wrapped { gap, .. })) =
            (gap_below, making.garment.panels.get_mut(*above).map(|panel| &mut panel.placement))
        {
            *gap = gap.max(below + OVER);
        }
        let (first, second) = (phrase.arg(0)?, phrase.value("over")?);
        let name =
            format!("{} over {}", self.snippet(first.expr.span), self.snippet(second.expr.span));
        making.garment.stitches.push(Stitches { name, span: phrase.span, closure: true, pairs });
        Some(())
    }

    /// The one edge of one piece that is closed.
    fn closed_edge(&mut self, arg: Arg<'t>) -> Option<EdgeRef> {
        match self.eval(arg.expr, arg.scope) {
            Value::Poison => None,
            Value::Edges(edges) => match edges.as_slice() {
                [edge] if edge.find().len() == 1 => Some(edge.clone()),
                _ => {
                    self.tell(
                        Diagnostic::new("E0505", "one edge of one piece is closed")
                            .at(arg.expr.span, "these are several")
                            .help("name the half: `front.left.edge`"),
                    );
                    None
                }
            },
            other => {
                self.wrong(&other, "an edge", arg.expr.span);
                None
            }
        }
    }
}

/// How far inside of an edge the middle of its placket lies, m; that over a slit lies on its lips.
fn on_placket(edge: &EdgeRef, making: &Making) -> Option<f64> {
    let found = edge.find().into_iter().next()?;
    let number = making.numbers.get(&(edge.draft.item, found.piece))?;
    let runs = edge.runs(&found);
    let mut bands = making.garment.panels.get(*number)?.bands.iter();
    let inset = |band: &Band| {
        let same = |run: &Run| runs.iter().any(|r| (r.ring, r.piece) == (run.ring, run.piece));
        match band.kind {
            BandKind::Placket if band.runs.iter().any(same) => Some(band.width / 2.0),
            BandKind::Strip if band.runs.iter().any(same) => Some(0.0),
            _ => None,
        }
    };
    bands.find_map(inset)
}

/// The place inside an edge, `way` along it as sewn and `inset` from it, m.
fn spot(edge: &EdgeRef, way: f64, inset: f64, making: &Making) -> Option<Spot> {
    let found = edge.find().into_iter().next()?;
    let piece = edge.draft.pieces.get(found.piece)?;
    let runs = edge.runs(&found);
    let mut rest = way;
    let run = runs
        .iter()
        .find(|run| {
            let here = rest <= run.length() + 1e-9;
            if !here {
                rest -= run.length();
            }
            here
        })
        .or(runs.last())?;
    let place = super::notch::place(piece.path(run)?, run, rest, inset);
    Some((*making.numbers.get(&(edge.draft.item, found.piece))?, [place.x, place.y]))
}
