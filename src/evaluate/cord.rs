//! What draws cloth together: `elastic`, `drawstring`, `tie`.

use super::Evaluator;
use super::fields::{Fields, Phrase};
use super::garment::Making;
use crate::diagnostic::Diagnostic;
use crate::garment::seam::{Cord, CordKind, PanelRun, Stitches, Tie};
use crate::units::{self, Dimension};

/// The width of an elastic where nothing else is said, m.
const ELASTIC: f64 = 0.01;

/// The narrowest and the widest elastic, m.
const WIDTH: (f64, f64) = (1e-3, 0.2);

/// To so much of their length edges are drawn together at most.
const LEAST: f64 = 0.1;

/// The longest tie, m.
const LONGEST: f64 = 5.0;

impl<'t> Evaluator<'t> {
    /// All lines that draw cloth together; false if one is wrong.
    pub(super) fn cords(&mut self, fields: &Fields<'t>, making: &mut Making) -> bool {
        let mut sound = true;
        for phrase in &fields.phrases {
            self.within = Some((phrase.scope, self.waiting.len()));
            sound &= match phrase.word.name {
                "elastic" | "drawstring" => self.cord(phrase, making).is_some(),
                "tie" => self.tie(phrase, making).is_some(),
                _ => true,
            };
        }
        self.within = None;
        sound
    }

    /// `elastic in E, F to L width L`, `drawstring through E, F to L`
    fn cord(&mut self, phrase: &Phrase<'t>, making: &mut Making) -> Option<()> {
        let elastic = phrase.word.name == "elastic";
        let mut runs: Vec<PanelRun> = Vec::new();
        let mut names = Vec::new();
        for arg in phrase.values(if elastic { "in" } else { "through" }) {
            runs.extend(self.held_runs(arg, making)?);
            names.push(self.snippet(arg.expr.span).to_owned());
        }
        let to = phrase.value("to")?;
        let length = self.quantity(to, Dimension::LENGTH)?;
        let width = match phrase.value("width") {
            Some(arg) => self.within_range(arg, Dimension::LENGTH, WIDTH.0, WIDTH.1)?,
            None => ELASTIC,
        };
        let edges: f64 = runs.iter().map(|on| on.run.length()).sum();
        if !(length >= LEAST * edges && length <= edges) {
            let what = if elastic { "an elastic" } else { "a drawstring" };
            let (title, help) = if length > edges {
                (format!("{what} longer than its edge draws nothing together"), "make it shorter")
            } else {
                ("so much cloth is not drawn so close together".to_owned(), "at most to a tenth")
            };
            self.tell(
                Diagnostic::new("E0303", title)
                    .at(to.expr.span, units::length(length))
                    .at(phrase.span, format!("the edges are {} long", units::length(edges)))
                    .help(help),
            );
            return None;
        }
        let kind = if elastic { CordKind::Elastic } else { CordKind::Drawstring };
        let name = format!("{} {}", phrase.word.name, names.join(", "));
        making.garment.cords.push(Cord { name, span: phrase.span, kind, runs, length, width });
        Some(())
    }

    /// `tie P to P length L`
    fn tie(&mut self, phrase: &Phrase<'t>, making: &mut Making) -> Option<()> {
        let (first, second) = (phrase.arg(0)?, phrase.value("to")?);
        let sides = [self.spots(first, making)?, self.spots(second, making)?];
        let span = phrase.span;
        if sides[0].len() != sides[1].len() {
            self.tell(
                Diagnostic::new("E0505", "which halves are tied together?")
                    .at(span, "one is cut once, the other twice")
                    .help("name the half: `front.left.edge.start`"),
            );
            return None;
        }
        let pairs: Vec<_> = sides[0].iter().zip(&sides[1]).map(|(a, b)| [*a, *b]).collect();
        let name =
            format!("{} to {}", self.snippet(first.expr.span), self.snippet(second.expr.span));
        if let Some(same) = pairs.iter().find(|[a, b]| a == b) {
            let panel = making.garment.panels.get(same[0].0).map_or("", |panel| &panel.name);
            self.tell(
                Diagnostic::new("E0207", format!("a place of `{panel}` is tied to itself"))
                    .at(first.expr.span, "this")
                    .at(second.expr.span, "and this are one"),
            );
            return None;
        }
        match phrase.value("length") {
            Some(arg) => {
                let length = self.within_range(arg, Dimension::LENGTH, 1e-3, LONGEST)?;
                making.garment.ties.push(Tie { name, span, pairs, length });
            }
            None => making.garment.stitches.push(Stitches { name, span, closure: true, pairs }),
        }
        Some(())
    }

    /// Whether anything is closed by `close`.
    pub(super) fn closes(making: &Making) -> bool {
        let garment = &making.garment;
        !garment.ties.is_empty() || garment.stitches.iter().any(|stitch| stitch.closure)
    }
}
