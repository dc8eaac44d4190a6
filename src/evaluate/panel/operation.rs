//! A panel from its words: shape, darts, notches, then folds and copies.

use super::super::Evaluator;
use super::super::fields::{Arg, Phrase, bare};
use super::super::item::ItemId;
use super::super::words::Kind;
use super::mark::Line;
use super::outline::Course;
use super::sheet::{self, Drawn, Edge, Leg, Sheet};
use super::{Counted, CutEdge, CutJoin, CutPiece, Draft, Instance, InstanceId, Standing};
use crate::diagnostic::{Diagnostic, Span};
use crate::garment::panel::{Crease, Piece, Run, Shut};
use crate::geometry::{crossing, curve};
use crate::syntax::tree::Name;
use crate::units::{self, Dimension};
use kurbo::{Affine, BezPath, Shape};

/// Shapes of which a panel has one.
pub(in super::super) const SHAPES: &[&str] = &["outline", "rectangle", "circle", "ring", "size"];

impl<'t> Evaluator<'t> {
    /// Draws and cuts the panel of an instance.
    pub(super) fn cut_out(&mut self, id: InstanceId) -> Option<Draft> {
        let Instance { item, fields, outline, drawn, .. } = self.instances.get(id.0)?;
        let (item, fields, outline, blocks) =
            (*item, fields.clone(), outline.clone(), drawn.clone());
        let name = self.item(item).name.clone();
        let span = self.item(item).span;
        let fabric = self.fabric_of(item, 0);
        let grain = self.quantity_or(&fields, "grain", Dimension::ANGLE, 0.0);
        let plies = match fields.value("plies") {
            Some(arg) => self.whole_number(arg, 1, 20).map(|plies| plies as u32),
            None => Some(1),
        };
        let bands = self.bands(&fields);
        let allowances = self.allowances(&fields, bands.as_deref().unwrap_or_default());
        let layer = match fields.value("layer") {
            None => Some((0, false)),
            Some(arg) if bare(arg.expr).is_some_and(|word| word.text == "inside") => {
                Some((0, true))
            }
            Some(arg) if self.unknown_word(arg, &["inside"]) => None,
            Some(arg) => self.whole_number(arg, -100, 100).map(|layer| (layer as i32, false)),
        };
        let shapes: Vec<&Phrase<'t>> =
            fields.phrases.iter().filter(|p| SHAPES.contains(&p.word.name)).collect();
        let shape = match shapes.as_slice() {
            [one] => *one,
            [] if SHAPES.iter().any(|word| fields.spoils(word)) => return None,
            [] => {
                self.tell(
                    Diagnostic::new("E0208", format!("panel `{name}` has no shape"))
                        .at(span, "missing here")
                        .help("draw it: `outline from (0, 0) { … }`, `rectangle W x H`, `circle radius R` or `ring inner R outer R`"),
                );
                return None;
            }
            [first, second, ..] => {
                self.tell(
                    Diagnostic::new("E0209", format!("panel `{name}` has two shapes"))
                        .at(second.span, "here")
                        .at(first.span, "and here"),
                );
                return None;
            }
        };
        let by_particles = match shape.word.name {
            "size" => self.counted(&fields, shape, &name),
            _ => self.rings_of(shape, outline.as_ref(), &name).map(|rings| (rings, None)),
        };
        let Some((mut rings, counted)) = by_particles else {
            self.look_over(&fields, shape, outline.as_ref());
            return None;
        };
        let cell = self.side_of_cells(&fields, shape, counted);
        // A piece of which a line is not known says nothing to those that are sewn to it.
        let mut sound = fields.spoiled.is_empty();
        let marks = self.marks(&fields, &blocks, &format!("`{name}`"));
        sound &= marks.is_some();
        let mut marks = marks.unwrap_or_default();
        sound &= self.trimmed(&fields, &mut rings, &mut marks);
        sound &= self.marks_on_cloth(&marks, &rings);
        for (number, phrase) in fields.phrases.iter().enumerate() {
            if phrase.word.name == "hole" {
                let read = blocks.iter().find(|(n, _)| *n == number).map(|(_, read)| read);
                let ring = self.hole(phrase, read, &name);
                match ring.filter(|ring| self.within_outline(ring, &rings, phrase.span)) {
                    Some(ring) => rings.push(ring),
                    None => sound = false,
                }
            }
        }
        let marked = |line: &Line| Drawn {
            name: Some(line.name.clone()),
            span: line.span,
            path: line.path.clone(),
        };
        let drawn: Vec<Drawn> =
            rings.iter().flatten().cloned().chain(marks.iter().map(marked)).collect();
        let mut sheet = self.darted(&fields, &rings, &name).unwrap_or_else(|| {
            // Without its darts the piece still shows its other mistakes.
            sound = false;
            let mut plain = Sheet::default();
            rings.iter().for_each(|ring| plain.add_ring(ring, &[]));
            plain
        });
        sheet.lines = marks;
        sound &= self.notched(&fields, &rings, &mut sheet);
        sound &= self.creased(&fields, &rings, &mut sheet);
        for phrase in &fields.phrases {
            let map = match phrase.word.name {
                "rotate" => self.rotation(phrase),
                "mirror" => self.mirroring(phrase),
                "scale" => self.scaling(phrase, &sheet),
                _ => continue,
            };
            match map {
                Some(map) => sheet = sheet.mapped(map),
                None => sound = false,
            }
        }
        let (mut sheet, halves) = self.folded(&fields, sheet, item)?;
        sound &= self.slits(&fields, &mut sheet);
        let pieces = self.copies(&fields, sheet, halves.as_ref())?;
        // The other piece of a pair is a mirror image, and what a fit only tries is not cut: the
        // piece with the value that was found is looked at.
        if let Some(piece) = pieces.first().filter(|_| !self.is_trial(fields.scope)) {
            sound &= self.sound_piece(piece, &name, span);
        }
        let (grain, cell, (layer, inside)) = (grain?, cell?, layer?);
        let (plies, allowances, bands) = (plies?, allowances?, bands?);
        sound &= self.allowed_edges(&fields, &pieces);
        sound.then_some(Draft {
            item,
            name,
            span,
            scope: fields.scope,
            fabric,
            grain,
            cell,
            layer,
            inside,
            plies,
            allowances,
            bands,
            counted,
            drawn,
            pieces,
        })
    }

    /// `grid: 5mm`, or `grid: 40 x 60` with a size: the side of the cells, m.
    fn side_of_cells(
        &mut self,
        fields: &super::Fields<'t>,
        shape: &Phrase<'t>,
        counted: Option<Counted>,
    ) -> Option<Option<f64>> {
        let Some(phrase) = fields.get("grid") else {
            return Some(counted.map(|counted| counted.cell[0].min(counted.cell[1])));
        };
        if phrase.arg(1).is_none() {
            return self.within_range(phrase.arg(0)?, Dimension::LENGTH, 1e-4, 1.0).map(Some);
        }
        if shape.word.name != "size" || fields.get("mask").is_some() {
            self.tell(
                Diagnostic::new("E0207", "cells are counted on a panel with a `size`")
                    .at(phrase.span, "this panel's grid has a side")
                    .help("such as `grid: 8mm`"),
            );
            return None;
        }
        let [across, up] = [shape.arg(0)?, shape.arg(1)?];
        let extent =
            [self.quantity(across, Dimension::LENGTH)?, self.quantity(up, Dimension::LENGTH)?];
        self.cells(fields, extent)
    }

    /// The outline of a panel from its shape.
    fn rings_of(
        &mut self,
        shape: &Phrase<'t>,
        outline: Option<&super::Fields<'t>>,
        name: &str,
    ) -> Option<Vec<Vec<Drawn>>> {
        if shape.word.name != "outline" {
            return self.shape(shape);
        }
        let from = shape.value("from")?;
        let start = self.point(from);
        // Without its start an outline still shows the mistakes of its edges.
        let drawn = self.draw(
            outline?,
            start.unwrap_or_default(),
            from.expr.span,
            &format!("`{name}`"),
            Course::Closed,
        );
        start.and(drawn).map(|ring| vec![ring])
    }

    /// The fabric said behind `of`, by the panel or by the one it copies, or as a property.
    fn fabric_of(&mut self, item: ItemId, depth: usize) -> Option<ItemId> {
        let phrase = self.item(item).phrase.clone();
        let own = self.instances.iter().rev().find(|instance| instance.item == item);
        let property = own.and_then(|instance| instance.fields.value("fabric"));
        if let Some(arg) = property.or_else(|| phrase.value("of")) {
            return self.item_among(arg, &[Kind::Fabric]);
        }
        let base = phrase.value("=").filter(|_| depth < 64)?;
        let base = self.item_named(base, Kind::Panel)?;
        self.fabric_of(base, depth + 1)
    }

    /// `unfold across E`: the sheet with its mirror image, and the names of the halves.
    fn folded(
        &mut self,
        fields: &super::Fields<'t>,
        sheet: Sheet,
        item: ItemId,
    ) -> Option<(Sheet, Option<[String; 2]>)> {
        let Some(phrase) = fields.get("unfold") else { return Some((sheet, None)) };
        let arg = phrase.value("across")?;
        let name: &'t Name = self.name_of(arg)?;
        let Some(edge) = sheet.edges.iter().find(|edge| edge.name == name.text) else {
            let known: Vec<String> = sheet.edges.iter().map(|edge| edge.name.clone()).collect();
            self.no_member("this panel", name, known.iter().map(String::as_str));
            return None;
        };
        self.note_edge(name, [edge.span]);
        let straight = match edge.stretches.as_slice() {
            [one] if one.ring == 0 => sheet.rings[0].get(one.piece).filter(|path| {
                let ends = curve::end(path) - curve::start(path);
                curve::length(path) - libm::hypot(ends.x, ends.y) < 1e-7
            }),
            _ => None,
        };
        let (Some(line), Some(fold)) = (straight, edge.stretches.first().map(|s| s.piece)) else {
            self.tell(
                Diagnostic::new("E0409", "cloth folds along a straight edge without darts")
                    .at(arg.expr.span, "this one is not")
                    .at(edge.span, "drawn here"),
            );
            return None;
        };
        // Which side of the fold the drawing lies on, seen from outside.
        let body = sheet::closed(&sheet.rings[0]).bounding_box().center();
        let drawn_right = body.x > curve::start(line).midpoint(curve::end(line)).x;
        let names = match phrase.values("as").as_slice() {
            [first, second] => {
                [self.name_of(*first)?.text.clone(), self.name_of(*second)?.text.clone()]
            }
            [] => {
                let standing = self.sides.get(&item).copied();
                if standing == Some(Standing::Unknown) {
                    return None;
                }
                let Some(standing) = standing else {
                    let name = self.item(item).name.clone();
                    self.tell(
                        Diagnostic::new(
                            "E0801",
                            format!("`{name}` is unfolded, but which half is the wearer's left?"),
                        )
                        .at(phrase.span, "unfolded here")
                        .help(format!(
                            "place it before or behind the wearer, or name the halves: `unfold across {} as left, right`",
                            arg.of_text(self)
                        )),
                    );
                    return None;
                };
                // Seen from the front the wearer's left is at the viewer's right.
                let drawn_left = drawn_right == (standing == Standing::Before);
                if drawn_left {
                    ["left".to_owned(), "right".to_owned()]
                } else {
                    ["right".to_owned(), "left".to_owned()]
                }
            }
            [first, ..] => {
                self.tell(
                    Diagnostic::new("E0306", "an unfolded piece has two halves")
                        .at(first.expr.span, "two names are wanted"),
                );
                return None;
            }
        };
        Some((sheet.unfolded(fold), Some(names)))
    }

    /// `pair as a, b`: the piece once or twice, its rings turned and measured.
    fn copies(
        &mut self,
        fields: &super::Fields<'t>,
        mut sheet: Sheet,
        halves: Option<&[String; 2]>,
    ) -> Option<Vec<CutPiece>> {
        let Some(phrase) = fields.get("pair") else {
            sheet.orient();
            return Some(vec![cut_piece(&sheet, None, halves)]);
        };
        let names = phrase.values("as");
        let [first, second] = names.as_slice() else {
            self.tell(
                Diagnostic::new("E0306", "`pair` wants two names")
                    .at(phrase.span, "here")
                    .help("`pair as left, right`: the first is the piece as drawn"),
            );
            return None;
        };
        let (first, second) = (self.name_of(*first)?, self.name_of(*second)?);
        if first.text == second.text {
            self.tell(
                Diagnostic::new("E0205", "both pieces of a pair have one name")
                    .at(second.span, "here"),
            );
            return None;
        }
        let mut other = sheet.mapped(Affine::new([-1.0, 0.0, 0.0, 1.0, 0.0, 0.0]));
        sheet.orient();
        other.orient();
        Some(vec![
            cut_piece(&sheet, Some(first.text.clone()), halves),
            cut_piece(&other, Some(second.text.clone()), halves),
        ])
    }

    /// Tells outlines that cross themselves (E0402); false if one does.
    fn sound_piece(&mut self, piece: &CutPiece, name: &str, span: Span) -> bool {
        let loops: Vec<Vec<BezPath>> = piece
            .loops
            .iter()
            .map(|ring| ring.pieces.iter().map(|piece| piece.path.clone()).collect())
            .collect();
        let Some(found) = crossing::first_crossing(&loops) else { return true };
        let place = |on: crossing::OnPiece| {
            piece
                .edges
                .iter()
                .find(|edge| {
                    edge.runs.iter().any(|(run, _)| run.ring == on.ring && run.piece == on.piece)
                })
                .map(|edge| edge.span)
                .or_else(|| {
                    piece
                        .joins
                        .iter()
                        .find(|join| {
                            let mut runs = join.sides.iter().flatten();
                            runs.any(|run| run.ring == on.ring && run.piece == on.piece)
                        })
                        .map(|join| join.span)
                })
                .unwrap_or(span)
        };
        let at = format!(
            "they meet at ({}, {})",
            units::length(found.at[0]),
            units::length(found.at[1])
        );
        let (a, b) = (place(found.a), place(found.b));
        let mut told = Diagnostic::new("E0402", format!("the outline of `{name}` crosses itself"))
            .at(a, if a == b { at.clone() } else { "this edge".to_owned() });
        if a != b {
            told = told.at(b, format!("and this one; {at}"));
        }
        self.tell(told);
        false
    }
}

impl<'t> Arg<'t> {
    /// The value as it stands in the text.
    fn of_text(&self, ev: &Evaluator<'t>) -> &'t str {
        ev.snippet(self.expr.span)
    }
}

/// A sheet, its rings turned already, as a piece with measured runs.
pub(in super::super) fn cut_piece(
    sheet: &Sheet,
    side: Option<String>,
    halves: Option<&[String; 2]>,
) -> CutPiece {
    let loops = sheet.loops();
    let half_name =
        |half: Option<usize>| half.and_then(|half| halves.map(|names| names[half.min(1)].clone()));
    let edge = |edge: &Edge| CutEdge {
        name: edge.name.clone(),
        half: half_name(edge.half),
        span: edge.span,
        runs: edge
            .stretches
            .iter()
            .map(|s| (sheet::run(&loops, s.ring, s.piece, s.reversed), s.flat))
            .collect(),
        flat: edge.flat,
    };
    let edges = sheet.edges.iter().map(edge).collect();
    let lines: Vec<Piece> = sheet
        .lines
        .iter()
        .map(|line| Piece { path: line.path.clone(), length: curve::length(&line.path) })
        .collect();
    let mark = |(number, line): (usize, &Line)| {
        let length = lines.get(number).map_or(0.0, |line| line.length);
        let run = Run { ring: loops.len(), piece: number, from: 0.0, to: length };
        CutEdge {
            name: line.name.clone(),
            half: half_name(line.half),
            span: line.span,
            runs: vec![(run, (0.0, length))],
            flat: length,
        }
    };
    let marks = sheet.lines.iter().enumerate().map(mark).collect();
    let joins = sheet
        .joins
        .iter()
        .map(|join| CutJoin {
            name: half_name(join.half)
                .map_or_else(|| join.name.clone(), |half| format!("{half}.{}", join.name)),
            kind: join.kind,
            span: join.span,
            sides: join.sides.each_ref().map(|side| {
                let run = |&(ring, piece, back): &Leg| sheet::run(&loops, ring, piece, back);
                side.iter().map(run).collect()
            }),
        })
        .collect();
    let creases = sheet
        .creases
        .iter()
        .map(|crease| Crease {
            span: crease.span,
            from: [crease.from.x, crease.from.y],
            to: [crease.to.x, crease.to.y],
            angle: crease.angle,
            shut: crease.shut.map(|[across, along]| Shut {
                across: [across.x, across.y],
                along: [along.x, along.y],
            }),
        })
        .collect();
    let notches = sheet.notch_marks();
    CutPiece { side, edges, marks, lines, joins, creases, notches, loops }
}
