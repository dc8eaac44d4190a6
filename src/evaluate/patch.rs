//! Pieces sewn flat on others: `patch pocket on front.left at (5cm, -30cm) open top`.

use super::Evaluator;
use super::fields::{Arg, Phrase, bare};
use super::garment::Making;
use super::item::ItemId;
use super::panel::edge::{EdgeRef, Which};
use super::panel::{CutPiece, Draft};
use super::value::Value;
use super::words::Kind;
use crate::diagnostic::{Diagnostic, Span};
use crate::garment::panel::{Panel, Run};
use crate::garment::scene::Placement;
use crate::garment::seam::{PanelRun, Patch};
use crate::geometry::curve;
use crate::geometry::polygon::{Place, contains, distance_to_side, sides};
use crate::units::{self, Dimension};
use kurbo::{Affine, Point, Vec2};
use std::f64::consts::PI;
use std::rc::Rc;

/// Its edge may lie so far outside of the cloth below, m.
const BEYOND: f64 = 1e-3;

/// Places of its edge are looked at every so often, m.
const STRIDE: f64 = 5e-3;

/// Left and right of a drawing exchanged, as the second of a pair is drawn.
const MIRROR: Affine = Affine::new([-1.0, 0.0, 0.0, 1.0, 0.0, 0.0]);

/// A piece, or a half of it, with the name that tells it from the other.
#[derive(Clone)]
struct Ground {
    piece: usize,
    /// From the drawing of the panel to this piece of it.
    map: Affine,
    tag: Option<String>,
}

/// The mirror image about the fold of an unfolded piece, from two halves of one edge.
fn unfolding(piece: &CutPiece) -> Option<Affine> {
    piece.edges.iter().find_map(|edge| {
        edge.half.as_ref()?;
        let other = |e: &&_| {
            let e: &super::panel::CutEdge = e;
            e.name == edge.name && e.half.is_some() && e.half != edge.half
        };
        let twin = piece.edges.iter().find(other)?;
        let ends = |e: &super::panel::CutEdge| {
            let runs: Vec<Run> = e.runs.iter().map(|(run, _)| *run).collect();
            piece.ends(&runs)
        };
        let ((a, b), (p, q)) = (ends(edge)?, ends(twin)?);
        let (a, p) = if (p - a).hypot() > (q - b).hypot() { (a, p) } else { (b, q) };
        let (middle, way) = (a.midpoint(p), p - a);
        Some(curve::mirror(middle, middle + kurbo::Vec2::new(-way.y, way.x)))
    })
}

/// The pieces of a panel that are meant, or their halves where only one is.
fn grounds(draft: &Draft, Which(names): &Which, halves: bool) -> Vec<Ground> {
    let said = |name: &Option<String>| name.as_ref().is_some_and(|name| names.contains(name));
    let any = draft.pieces.iter().any(|piece| said(&piece.side));
    let chosen = draft.pieces.iter().enumerate().filter(|(_, piece)| !any || said(&piece.side));
    let mut grounds = Vec::new();
    for (number, piece) in chosen {
        let copied = if number > 0 { MIRROR } else { Affine::IDENTITY };
        let whole = Ground { piece: number, map: copied, tag: piece.side.clone() };
        // The half as drawn comes first.
        let mut parts: Vec<&String> = Vec::new();
        for half in piece.edges.iter().filter_map(|edge| edge.half.as_ref()) {
            if !parts.contains(&half) {
                parts.push(half);
            }
        }
        let image = draft.pieces.first().and_then(unfolding);
        match (parts.as_slice(), image) {
            ([drawn, other], Some(image)) => {
                let half = |name: &String, map: Affine| Ground {
                    piece: number,
                    map,
                    tag: Some(piece.side.clone().unwrap_or_else(|| name.clone())),
                };
                let both = [half(drawn, copied), half(other, copied * image)];
                match (names.contains(drawn), names.contains(other)) {
                    (true, false) => grounds.extend(both.into_iter().take(1)),
                    (false, true) => grounds.extend(both.into_iter().skip(1)),
                    _ if halves && piece.side.is_none() => grounds.extend(both),
                    _ => grounds.push(whole),
                }
            }
            _ => grounds.push(whole),
        }
    }
    grounds
}

/// The closed lines of a panel as straight sides.
fn lines(panel: &Panel) -> Vec<Vec<Place>> {
    let ring = |ring: &crate::garment::panel::Loop| {
        let mut points: Vec<Place> = Vec::new();
        for piece in &ring.pieces {
            kurbo::flatten(&piece.path, 1e-4, |element| {
                points.extend(element.end_point().map(|p| [p.x, p.y]));
            });
        }
        points.dedup();
        points
    };
    panel.loops.iter().map(ring).collect()
}

impl<'t> Evaluator<'t> {
    /// One `patch` line; none if it is wrong.
    pub(super) fn patch(&mut self, phrase: &Phrase<'t>, making: &mut Making) -> Option<()> {
        // All values are looked at, so that one run tells of all.
        let top = phrase.arg(0).and_then(|arg| self.patched(arg));
        let host = phrase.value("on").and_then(|arg| self.patched(arg));
        let at = phrase.value("at").map(|arg| self.point(arg));
        let turn = match phrase.value("turn") {
            Some(arg) => self.quantity(arg, Dimension::ANGLE),
            None => Some(0.0),
        };
        let ((top, top_which), (host, host_which)) = (top?, host?);
        let open = self.open_edges(phrase, &top)?;
        let laid = match at {
            Some(at) => {
                let ([x, y], turn) = (at?, turn?);
                Affine::translate((x, y)) * curve::turning(turn)
            }
            None => self.laid_along(phrase, &top, &open, &host)?,
        };
        let tops = grounds(&top, &top_which, false);
        let below = grounds(&host, &host_which, tops.len() > 1);
        let spans = (phrase.arg(0)?.expr.span, phrase.value("on")?.expr.span);
        for (a, b) in self.paired(&tops, &below, spans)? {
            let map = b.map * laid;
            // What is laid on a mirror image is turned round itself, so that its face stays outside.
            let map = if map.determinant() < 0.0 { map * MIRROR } else { map };
            let piece = top.pieces.get(a.piece)?;
            let panel = *making.numbers.get(&(top.item, a.piece))?;
            let host_panel = *making.numbers.get(&(host.item, b.piece))?;
            let mut patch = Patch {
                name: String::new(),
                span: phrase.span,
                panel,
                host: host_panel,
                map: map.as_coeffs(),
                runs: Vec::new(),
            };
            let closed: Vec<Run> = open
                .iter()
                .flat_map(|edge| {
                    edge.find()
                        .into_iter()
                        .filter(|found| found.piece == a.piece)
                        .flat_map(|found| edge.runs(&found))
                        .collect::<Vec<_>>()
                })
                .collect();
            patch.runs = sewn(piece, &closed).map(|run| PanelRun { panel, run }).collect();
            self.finish_patch(patch, spans, making)?;
        }
        Some(())
    }

    /// Looks at a patch and takes it up.
    fn finish_patch(
        &mut self,
        mut patch: Patch,
        spans: (Span, Span),
        making: &mut Making,
    ) -> Option<()> {
        let garment = &mut making.garment;
        let (top, host) = (garment.panels.get(patch.panel)?, garment.panels.get(patch.host)?);
        let name = top.name.clone();
        patch.name = format!("{name} on {}", host.name);
        let told = if patch.runs.is_empty() {
            Some(
                Diagnostic::new("E0207", format!("all edges of `{name}` are open"))
                    .at(patch.span, "nothing of it is sewn"),
            )
        } else if let Some(twin) = garment.patches.iter().find(|p| p.panel == patch.panel) {
            Some(
                Diagnostic::new("E0209", format!("`{name}` is sewn on twice"))
                    .at(patch.span, "here")
                    .at(twin.span, "and here")
                    .help("a second pocket is a panel of its own: `panel other = pocket`"),
            )
        } else if top.placement != Placement::Led {
            Some(
                Diagnostic::new("E0209", format!("`{name}` is placed twice"))
                    .at(patch.span, "it begins where it is sewn on")
                    .help("drop its `place` line"),
            )
        } else if lies_on_itself(&patch, &garment.patches) {
            Some(
                Diagnostic::new("E0206", format!("`{name}` would lie on itself"))
                    .at(spans.0, "this lies")
                    .at(spans.1, "on this, which lies on it"),
            )
        } else {
            None
        };
        if let Some(told) = told {
            self.tell(told);
            return None;
        }
        let taken = garment.seams.iter().find(|seam| {
            let mut sides = seam.a.iter().chain(&seam.b);
            sides.any(|on| patch.runs.iter().any(|run| overlap(run, on)))
        });
        if let Some(seam) = taken {
            self.tell(
                Diagnostic::new("E0503", format!("an edge of `{name}` is sewn twice"))
                    .at(patch.span, "here")
                    .at(seam.span, "and here")
                    .help("leave it open where it is sewn to something else: `open side`"),
            );
            return None;
        }
        if let Some((beyond, at)) = beyond(&patch, top, host) {
            let [x, y] = at.map(units::length);
            self.tell(
                Diagnostic::new("E0506", format!("`{name}` reaches beyond `{}`", host.name))
                    .at(
                        patch.span,
                        format!("by {}, at ({x}, {y}) of its drawing", units::length(beyond)),
                    )
                    .at(spans.1, "no cloth there")
                    .help("`at` is where (0, 0) of the patch lies in the drawing below it"),
            );
            return None;
        }
        let layer = host.layer + 1;
        if let Some(top) = garment.panels.get_mut(patch.panel) {
            top.layer = top.layer.max(layer);
        }
        garment.patches.push(patch);
        Some(())
    }

    /// The panel behind a name, and which of its halves or copies.
    fn patched(&mut self, arg: Arg<'t>) -> Option<(Rc<Draft>, Which)> {
        let is_panel = |ev: &Self, id: ItemId| ev.item(id).kind == Kind::Panel;
        match self.eval(arg.expr, arg.scope) {
            Value::Poison => None,
            Value::Item(id) if is_panel(self, id) => {
                Some((self.panel(id, arg.expr.span)?, Which::default()))
            }
            Value::Half(id, which) => Some((self.panel(id, arg.expr.span)?, which)),
            other => {
                self.wrong(&other, "a panel", arg.expr.span);
                None
            }
        }
    }

    /// `along MARK`: the first open edge of the patch lies along a line of the host, middle on middle,
    /// and the patch hangs from it as it is drawn; of a patch that is sewn all round its uppermost
    /// edge.
    fn laid_along(
        &mut self,
        phrase: &Phrase<'t>,
        top: &Rc<Draft>,
        open: &[EdgeRef],
        host: &Rc<Draft>,
    ) -> Option<Affine> {
        if let Some(turn) = phrase.clause("turn") {
            self.tell(
                Diagnostic::new("E0207", "a patch along a line is turned as the line is")
                    .at(turn.span, "this has no place here"),
            );
            return None;
        }
        let along = phrase.value("along")?;
        let line = match bare(along.expr).filter(|name| host.has_line(&name.text)) {
            Some(name) => {
                self.note_edge(name, host.declared(&name.text));
                whole(host, &name.text)
            }
            None => match self.eval(along.expr, along.scope) {
                Value::Poison => return None,
                Value::Edges(edges) => match <[EdgeRef; 1]>::try_from(edges) {
                    Ok([line]) if line.draft.item == host.item => line,
                    _ => {
                        let wanted = format!("`along` wants one line of `{}`", host.name);
                        self.tell(
                            Diagnostic::new("E0304", wanted)
                                .at(along.expr.span, "here")
                                .help("draw one in the panel: `mark pocket from P { line to Q }`"),
                        );
                        return None;
                    }
                },
                other => {
                    self.wrong(&other, "a mark", along.expr.span);
                    return None;
                }
            },
        };
        let edges = top.edge_names().into_iter();
        let own = edges.filter_map(|edge| middle_and_way(&whole(top, edge)));
        let uppermost = || own.reduce(|a, b| if b.0.y > a.0.y + 1e-9 { b } else { a });
        let (from, own_way) = open.first().and_then(middle_and_way).or_else(uppermost)?;
        let (to, way) = middle_and_way(&line)?;
        let turn = curve::direction(way) - curve::direction(own_way);
        // Whichever way both were drawn, the patch is turned by a right angle at most.
        let turn = turn - PI * (turn / PI).round();
        let there = Affine::translate(to.to_vec2());
        Some(there * curve::turning(turn) * Affine::translate(-from.to_vec2()))
    }

    /// The edges behind `open`: names of the patch's own, or any that are worked out.
    fn open_edges(&mut self, phrase: &Phrase<'t>, top: &Rc<Draft>) -> Option<Vec<EdgeRef>> {
        let mut open = Vec::new();
        for arg in phrase.values("open") {
            if let Some(name) = bare(arg.expr) {
                if !top.edge_names().contains(&name.text.as_str()) {
                    let title = format!("`{}`", top.name);
                    self.no_member(&title, name, top.edge_names().into_iter());
                    return None;
                }
                self.note_edge(name, top.declared(&name.text));
                open.push(whole(top, &name.text));
                continue;
            }
            match self.eval(arg.expr, arg.scope) {
                Value::Edges(edges) if edges.iter().all(|e| e.draft.item == top.item) => {
                    open.extend(edges);
                }
                other => {
                    let wanted = format!("an edge of `{}`", top.name);
                    self.wrong(&other, &wanted, arg.expr.span);
                    return None;
                }
            }
        }
        Some(open)
    }

    /// Which piece lies on which: one on one, or each on that of its name.
    fn paired(
        &mut self,
        tops: &[Ground],
        below: &[Ground],
        spans: (Span, Span),
    ) -> Option<Vec<(Ground, Ground)>> {
        if let ([a], [b]) = (tops, below) {
            return Some(vec![(a.clone(), b.clone())]);
        }
        let twin = |a: &Ground| below.iter().find(|b| b.tag == a.tag).cloned();
        let pairs: Vec<_> = tops.iter().filter_map(|a| Some((a.clone(), twin(a)?))).collect();
        if pairs.len() == tops.len() && tops.len() == below.len() {
            return Some(pairs);
        }
        let names = |list: &[Ground]| match list {
            [_] => "one piece".to_owned(),
            many => many.iter().filter_map(|g| g.tag.clone()).collect::<Vec<_>>().join(", "),
        };
        self.tell(
            Diagnostic::new("E0505", "which of them is sewn on which?")
                .at(spans.0, names(tops))
                .at(spans.1, names(below))
                .help(
                    "name the half, such as `front.left`, or cut both with `pair as left, right`",
                ),
        );
        None
    }
}

/// All of an edge or a mark.
fn whole(draft: &Rc<Draft>, edge: &str) -> EdgeRef {
    EdgeRef { draft: draft.clone(), which: Which::default(), edge: edge.to_owned(), part: None }
}

/// The middle of an edge or a mark on the piece as drawn, and the way from its start to its end.
fn middle_and_way(edge: &EdgeRef) -> Option<(Point, Vec2)> {
    let found = edge.find().into_iter().find(|found| found.piece == 0)?;
    let runs = edge.runs(&found);
    let piece = edge.draft.pieces.first()?;
    let (start, end) = piece.ends(&runs)?;
    let mut rest = runs.iter().map(Run::length).sum::<f64>() / 2.0;
    for run in &runs {
        if rest <= run.length() {
            let sense = if run.to < run.from { -1.0 } else { 1.0 };
            return Some((piece.point(run, run.from + sense * rest), end - start));
        }
        rest -= run.length();
    }
    None
}

/// The runs of a piece's outline that are sewn: all but the open ones and those sewn to itself.
fn sewn<'p>(piece: &'p CutPiece, open: &'p [Run]) -> impl Iterator<Item = Run> + 'p {
    let outline = piece.loops.first().map_or(&[][..], |ring| &ring.pieces);
    outline.iter().enumerate().flat_map(move |(number, line)| {
        let joined = piece.joins.iter().flat_map(|join| join.sides.iter().flatten());
        let mut free: Vec<(f64, f64)> = open
            .iter()
            .chain(joined)
            .filter(|run| run.ring == 0 && run.piece == number)
            .map(|run| (run.from.min(run.to), run.from.max(run.to)))
            .collect();
        free.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut runs = Vec::new();
        let mut from = 0.0;
        for (start, end) in free.into_iter().chain([(line.length, line.length)]) {
            if start - from > 1e-6 {
                runs.push(Run { ring: 0, piece: number, from, to: start });
            }
            from = end.max(from);
        }
        runs
    })
}

/// Whether two runs take the same stretch of a piece.
fn overlap(a: &PanelRun, b: &PanelRun) -> bool {
    let same = (a.panel, a.run.ring, a.run.piece) == (b.panel, b.run.ring, b.run.piece);
    let span = |run: &Run| (run.from.min(run.to), run.from.max(run.to));
    let ((p, q), (r, s)) = (span(&a.run), span(&b.run));
    same && q.min(s) - p.max(r) > 1e-5
}

/// Whether what lies below the patch lies on the patch itself.
fn lies_on_itself(patch: &Patch, others: &[Patch]) -> bool {
    let mut below = patch.host;
    for _ in 0..=others.len() {
        if below == patch.panel {
            return true;
        }
        match others.iter().find(|other| other.panel == below) {
            Some(other) => below = other.host,
            None => return false,
        }
    }
    false
}

/// How far, and where in the host's drawing, a sewn edge reaches beyond the host; the farthest.
fn beyond(patch: &Patch, top: &Panel, host: &Panel) -> Option<(f64, Place)> {
    let cloth = lines(host);
    let map = Affine::new(patch.map);
    let mut farthest: Option<(f64, Place)> = None;
    for PanelRun { run, .. } in &patch.runs {
        let Some(line) = top.loops.get(run.ring).and_then(|ring| ring.pieces.get(run.piece)) else {
            continue;
        };
        let steps = libm::ceil(run.length() / STRIDE).clamp(1.0, 1e4) as usize;
        for step in 0..=steps {
            let arc = run.from + (run.to - run.from) * step as f64 / steps as f64;
            let there: Point = map * curve::at(&line.path, arc).0;
            let place = [there.x, there.y];
            if contains(&cloth, place) {
                continue;
            }
            let away = cloth
                .iter()
                .flat_map(|ring| sides(ring))
                .map(|(a, b)| distance_to_side(place, a, b))
                .fold(f64::INFINITY, f64::min);
            if away > BEYOND && farthest.is_none_or(|(most, _)| away > most) {
                farthest = Some((away, place));
            }
        }
    }
    farthest
}
