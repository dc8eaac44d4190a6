//! Pleats and tucks: edges laid in folds.
//!
//! Every kind is made of knife pleats. Of a knife pleat the first fold turns the cloth back beneath
//! the edge, the second forward again: three layers, of which one is seen, and twice the depth of
//! the edge is taken up. A box pleat is two knife pleats of half the depth with their folds away
//! from each other and the box between them; an inverted pleat has them face to face.

use super::super::Evaluator;
use super::super::fields::{Fields, Phrase};
use super::crease;
use super::mouth::{Beneath, Cut, Form};
use super::shape::SIZE;
use super::sheet::{CORNER, Crease, Drawn};
use crate::diagnostic::Diagnostic;
use crate::geometry::curve;
use crate::units::{self, Dimension};

/// Pleats of one line at most.
const MOST: i64 = 500;

/// The kinds of pleat.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Knife,
    Box,
    Inverted,
}

impl Kind {
    /// Length of the flat edge that one takes, in depths: what is folded away, and the box.
    fn width(self) -> f64 {
        if self == Kind::Box { 3.0 } else { 2.0 }
    }

    /// Its knife pleats: where they begin and how deep they are, in depths, and what they lie
    /// beneath.
    fn knives(self, facing: Beneath) -> Vec<(f64, f64, Beneath)> {
        match self {
            Kind::Knife => vec![(0.0, 1.0, facing)],
            Kind::Box => vec![(0.0, 0.5, Beneath::After), (2.0, 0.5, Beneath::Before)],
            Kind::Inverted => vec![(0.0, 0.5, Beneath::Before), (1.0, 0.5, Beneath::After)],
        }
    }
}

impl<'t> Evaluator<'t> {
    /// Adds the mouths of all pleats and tucks to those of their edges, and their creases; false if one is wrong.
    pub(super) fn pleats(
        &mut self,
        fields: &Fields<'t>,
        rings: &[Vec<Drawn>],
        cuts: &mut [Vec<Vec<Cut>>],
        creases: &mut Vec<Crease>,
    ) -> bool {
        let mut sound = true;
        for (number, phrase) in fields.phrases.iter().enumerate() {
            let found = match phrase.word.name {
                "pleat" => self.pleat(phrase, rings),
                "tuck" => self.tuck(phrase, rings),
                _ => continue,
            };
            let pressed = self.pressed(phrase);
            let (Some((ring, place, mouths)), Some(pressed)) = (found, pressed) else {
                sound = false;
                continue;
            };
            let before = fields.phrases.iter().take(number);
            let before = before.filter(|p| p.word.name == phrase.word.name).count();
            let label = phrase.label.map_or_else(
                || format!("{}{}", phrase.word.name, before + 1),
                |label| label.text.clone(),
            );
            for (mouth, form) in mouths {
                let cut = Cut { name: label.clone(), span: phrase.span, mouth, form };
                let folds = crease::of_mouth(&rings[ring][place], &cut, &pressed, rings);
                if !self.stitched_on_cloth(&folds, &pressed) {
                    sound = false;
                    break;
                }
                creases.extend(folds);
                cuts[ring][place].push(cut);
            }
        }
        sound
    }

    fn pleat(&mut self, phrase: &Phrase<'t>, rings: &[Vec<Drawn>]) -> Option<Mouths> {
        let (ring, place, edge) = self.drawn_edge(phrase.value("on")?, rings)?;
        let length = curve::length(&edge.path);
        let from = phrase.value("from").map_or(Some(0.0), |arg| self.place_on(arg, edge));
        let to = phrase.value("to").map_or(Some(length), |arg| self.place_on(arg, edge));
        let count = self.whole_number(phrase.value("count")?, 1, MOST);
        let depth = self.within_range(phrase.value("depth")?, Dimension::LENGTH, 5e-4, SIZE);
        let kind = match phrase.word_of("kind") {
            Some("box") => Kind::Box,
            Some("inverted") => Kind::Inverted,
            _ => Kind::Knife,
        };
        let facing = match phrase.value("facing") {
            Some(arg) if kind != Kind::Knife => {
                self.tell(
                    Diagnostic::new("E0207", "only knife pleats face one way")
                        .at(arg.expr.span, "this has no place here")
                        .help("box and inverted pleats are the same from both sides"),
                );
                None
            }
            Some(arg) => self.facing(arg, edge, rings),
            None => Some(Beneath::Before),
        };
        let (from, to, count, depth, facing) = (from?, to?, count? as f64, depth?, facing?);
        let wanted = count * depth * kind.width();
        if wanted > to - from + 1e-6 {
            self.tell(
                Diagnostic::new(
                    "E0411",
                    format!("{count} pleats of {} do not fit here", units::length(depth)),
                )
                .at(phrase.span, format!("they take {}", units::length(wanted)))
                .at(edge.span, format!("between both places are {}", units::length(to - from)))
                .help("each takes twice its depth, a box pleat the width of its box as well"),
            );
            return None;
        }
        let pitch = (to - from) / count;
        // What is left to see stands over what is folded away.
        let share = match (kind, facing) {
            (Kind::Knife, Beneath::Before) => 1.0,
            (Kind::Knife, Beneath::After) => 0.0,
            _ => 0.5,
        };
        let gap = share * (pitch - depth * kind.width()).max(0.0);
        let mut mouths = Vec::new();
        for number in 0..count as usize {
            let start = from + pitch * number as f64 + gap;
            for (begin, deep, beneath) in kind.knives(facing) {
                let begin = start + begin * depth;
                let mouth = (begin, (begin + 2.0 * deep * depth).min(length));
                mouths.push((mouth, Form::Fold { beneath: Some(beneath) }));
            }
        }
        Some((ring, place, mouths))
    }

    /// Which way a pleat faces, by the neighbour of its edge.
    fn facing(
        &mut self,
        arg: super::super::fields::Arg<'t>,
        edge: &Drawn,
        rings: &[Vec<Drawn>],
    ) -> Option<Beneath> {
        let (_, _, neighbour) = self.drawn_edge(arg, rings)?;
        let ends = [curve::start(&neighbour.path), curve::end(&neighbour.path)];
        let touches = |p: kurbo::Point| ends.iter().any(|end| p.distance(*end) < CORNER);
        if touches(curve::end(&edge.path)) {
            Some(Beneath::Before)
        } else if touches(curve::start(&edge.path)) {
            Some(Beneath::After)
        } else {
            self.tell(
                Diagnostic::new("E0504", "these edges do not touch")
                    .at(arg.expr.span, "pleats face a neighbour of their edge")
                    .at(edge.span, "the edge"),
            );
            None
        }
    }

    fn tuck(&mut self, phrase: &Phrase<'t>, rings: &[Vec<Drawn>]) -> Option<Mouths> {
        let (ring, place, edge) = self.drawn_edge(phrase.value("on")?, rings)?;
        let at = self.place_on(phrase.value("at")?, edge);
        let depth = self.within_range(phrase.value("depth")?, Dimension::LENGTH, 5e-4, SIZE);
        let count = match phrase.value("count") {
            Some(arg) => self.whole_number(arg, 1, MOST),
            None => Some(1),
        };
        let every = match (phrase.value("every"), &count) {
            (Some(arg), _) => self.within_range(arg, Dimension::LENGTH, 1e-4, SIZE),
            (None, Some(2..)) => {
                self.tell(
                    Diagnostic::new("E0208", "several tucks want `every`")
                        .at(phrase.span, "missing here")
                        .help("`count 4 every 2cm`: from tuck to tuck on the flat edge"),
                );
                None
            }
            _ => Some(0.0),
        };
        let (at, depth, count, every) = (at?, depth?, count?, every?);
        let length = curve::length(&edge.path);
        let mut mouths = Vec::new();
        for number in 0..count as u32 {
            let middle = at + every * f64::from(number);
            let mouth = (middle - depth, middle + depth);
            if mouth.0 < -1e-9 || mouth.1 > length + 1e-9 {
                self.tell(
                    Diagnostic::new("E0411", "this tuck does not fit on its edge")
                        .at(
                            phrase.span,
                            format!(
                                "from {} to {}",
                                units::length(mouth.0),
                                units::length(mouth.1)
                            ),
                        )
                        .at(edge.span, format!("{} long", units::length(length)))
                        .help("a tuck takes its depth of the edge on both sides of its place"),
                );
                return None;
            }
            mouths.push(((mouth.0.max(0.0), mouth.1.min(length)), Form::Fold { beneath: None }));
        }
        Some((ring, place, mouths))
    }
}

/// Ring and place of an edge, and mouths on it with what closes them.
type Mouths = (usize, usize, Vec<((f64, f64), Form)>);
