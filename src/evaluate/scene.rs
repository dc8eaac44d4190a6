//! Scenes: cloths and solids; and a sari hung over a line.

use super::Evaluator;
use super::fields::Fields;
use super::garment::Making;
use super::item::{ItemId, Made};
use super::panel::operation::cut_piece;
use super::panel::shape::rectangle;
use super::panel::sheet::{Drawn, Sheet};
use super::panel::{CutPiece, Draft};
use super::words::Kind;
use crate::diagnostic::{Diagnostic, Span};
use crate::garment::Garment;
use crate::garment::cloth::Surface;
use crate::garment::panel::{Corner, NamedEdge, Panel};
use crate::garment::scene::{Placement, Shape, Solid};
use crate::geometry::curve;
use crate::units::{self, Dimension};
use kurbo::Point;
use std::f64::consts::{FRAC_PI_2, TAU};
use std::rc::Rc;

/// Cells along one side of a cloth at most.
const CELLS: i64 = 4096;
/// Largest cloth or solid, m.
const SIZE: f64 = 100.0;
/// Thickness of a table's top where nothing else is said, m.
const TABLE_TOP: f64 = 0.03;
/// Height and radius of the line on which a sari hangs, m.
const LINE: [f64; 2] = [2.8, 0.008];

impl<'t> Evaluator<'t> {
    pub(super) fn scene(&mut self, id: ItemId) -> Option<Garment> {
        let fields = self.open_item(id)?;
        let (name, span) = (self.item(id).name.clone(), self.item(id).span);
        let mut making = Making::new(&name, span);
        self.wearers(&fields, &mut making);
        for phrase in &fields.phrases {
            let Some(item) = phrase.item else { continue };
            match phrase.word.name {
                "cloth" => making.broken |= self.add_cloth(item, &mut making).is_none(),
                "solid" => {
                    let solid = self.solid(item);
                    making.broken |= solid.is_none();
                    making.garment.solids.extend(solid);
                }
                _ => {}
            }
        }
        if !fields.mentions("cloth") {
            self.tell(
                Diagnostic::new("E0208", format!("scene `{name}` has no cloth"))
                    .at(span, "here")
                    .help("such as `cloth square of cotton { size: 1m x 1m  at: (0, 1m, 0) }`"),
            );
        }
        self.holds(&fields, &mut making);
        self.checks(&fields);
        self.schedule(&fields, &mut making);
        self.pictures(&fields, &mut making);
        making.broken |= !fields.spoiled.is_empty();
        (!making.broken).then_some(making.garment)
    }

    /// Adds a cloth to the scene.
    fn add_cloth(&mut self, id: ItemId, making: &mut Making) -> Option<()> {
        let span = self.item(id).span;
        let draft = self.panel(id, span)?;
        let fields = self.opened(id)?.clone();
        let of = self.item(id).phrase.value("of")?;
        let stuff = self.item_among(of, &[Kind::Fabric, Kind::Sari])?;
        let (surface, fabric) = match self.make(stuff, of.expr.span)? {
            Made::Sari(sari, fabric) => (Surface::Sari(Box::new((*sari).clone())), fabric),
            _ => (Surface::Fabric, stuff),
        };
        let fabric = self.fabric_number(fabric, of.expr.span, making)?;
        let at = match fields.value("at") {
            Some(arg) => self.place_in_space(arg)?,
            None => [0.0; 3],
        };
        let facing = match fields.get("facing").and_then(|phrase| phrase.choice(0)) {
            // The outside of the undisturbed drawing faces +z.
            Some("front") => [0.0; 3],
            Some("down") => [FRAC_PI_2, 0.0, 0.0],
            Some("side") => [0.0, FRAC_PI_2, 0.0],
            _ => [-FRAC_PI_2, 0.0, 0.0],
        };
        let turn = match fields.value("turn") {
            Some(arg) => {
                let turn = self.turns_in_space(arg)?;
                [facing[0] + turn[0], facing[1] + turn[1], facing[2] + turn[2]]
            }
            None => facing,
        };
        making.numbers.insert((id, 0), making.garment.panels.len());
        let piece = draft.pieces.first()?;
        making.garment.panels.push(panel(&draft, piece, fabric, surface, at, turn));
        making.drafts.insert(id, draft);
        Some(())
    }

    /// The block of a cloth, read once.
    fn opened(&mut self, id: ItemId) -> Option<&Fields<'t>> {
        if !self.cloths.contains_key(&id) {
            let fields = self.open_item(id)?;
            self.cloths.insert(id, fields);
        }
        self.cloths.get(&id)
    }

    /// A cloth as a panel: its middle at (0, 0), or for a sari its inner lower corner there.
    pub(super) fn cloth(&mut self, id: ItemId) -> Option<Draft> {
        let fields = self.opened(id)?.clone();
        let span = self.item(id).span;
        let name = self.item(id).name.clone();
        let of = self.item(id).phrase.value("of")?;
        let stuff = self.item_among(of, &[Kind::Fabric, Kind::Sari])?;
        let mut grain = self.quantity_or(&fields, "grain", Dimension::ANGLE, 0.0)?;
        let size = match fields.get("size") {
            Some(phrase) => Some([
                self.within_range(phrase.arg(0)?, Dimension::LENGTH, 1e-3, SIZE)?,
                self.within_range(phrase.arg(1)?, Dimension::LENGTH, 1e-3, SIZE)?,
            ]),
            None => None,
        };
        let round = fields.get("shape").and_then(|phrase| phrase.choice(0)) == Some("circle");
        let (edges, extent): (Vec<Drawn>, [f64; 2]) = if self.item(stuff).kind == Kind::Sari {
            let Some(Made::Sari(sari, _)) = self.make(stuff, of.expr.span) else { return None };
            for word in ["size", "shape", "grain"] {
                if let Some(said) = fields.get(word) {
                    self.tell(
                        Diagnostic::new("E0207", format!("a sari brings its own {word}"))
                            .at(said.span, "remove this"),
                    );
                    return None;
                }
            }
            grain = -FRAC_PI_2;
            (sari_edges([sari.length, sari.width], span), [sari.length, sari.width])
        } else if round {
            let radius = fields.get("shape").and_then(|phrase| phrase.value("radius"));
            let Some(radius) = radius else {
                let at = fields.get("shape").map_or(span, |phrase| phrase.span);
                self.tell(
                    Diagnostic::new("E0208", "a circle must be given its radius")
                        .at(at, "missing here")
                        .help("such as `shape: circle radius 15cm`"),
                );
                return None;
            };
            let radius = self.within_range(radius, Dimension::LENGTH, 1e-3, SIZE)?;
            let from = Point::new(0.0, -radius);
            let mut path = curve::arc(from, Point::ZERO, TAU);
            curve::end_at(&mut path, from);
            let rim = Drawn { name: Some("rim".to_owned()), span, path };
            (vec![rim], [2.0 * radius, 2.0 * radius])
        } else {
            let Some([width, height]) = size else {
                self.required(&fields, "size");
                return None;
            };
            let (x, y) = (width / 2.0, height / 2.0);
            (rectangle([-x, -y], [x, y], span), [width, height])
        };
        let cell = self.cells(&fields, extent)?;
        let mut sheet = Sheet::default();
        sheet.add_ring(&edges, &[]);
        sheet.orient();
        Some(Draft {
            item: id,
            name,
            span,
            scope: fields.scope,
            fabric: None,
            grain,
            cell,
            layer: 0,
            inside: false,
            plies: 1,
            allowances: Vec::new(),
            bands: Vec::new(),
            counted: None,
            pieces: vec![cut_piece(&sheet, None, None)],
            drawn: edges,
        })
    }

    /// `grid: 128 x 128` or `grid: 5mm`.
    pub(super) fn cells(&mut self, fields: &Fields<'t>, extent: [f64; 2]) -> Option<Option<f64>> {
        let Some(phrase) = fields.get("grid") else { return Some(None) };
        let first = phrase.arg(0)?;
        let Some(second) = phrase.arg(1) else {
            return Some(Some(self.within_range(first, Dimension::LENGTH, 1e-4, 1.0)?));
        };
        let across = self.whole_number(first, 1, CELLS)?;
        let up = self.whole_number(second, 1, CELLS)?;
        let (a, b) = (extent[0] / across as f64, extent[1] / up as f64);
        if (a / b - 1.0).abs() > 0.005 {
            self.tell(
                Diagnostic::new("E0303", "the cells of a grid are square")
                    .at(phrase.span, format!("{} x {}", units::length(a), units::length(b)))
                    .help(format!(
                        "such as `grid: {across} x {}`",
                        libm::round(extent[1] / a).max(1.0)
                    )),
            );
            return None;
        }
        Some(Some(a))
    }

    fn solid(&mut self, id: ItemId) -> Option<Solid> {
        let fields = self.open_item(id)?;
        let (name, span) = (self.item(id).name.clone(), self.item(id).span);
        let phrase = self.required(&fields, "shape")?.clone();
        let length = |ev: &mut Self, word: &str| -> Option<f64> {
            match phrase.value(word) {
                Some(arg) => ev.within_range(arg, Dimension::LENGTH, 1e-3, SIZE),
                None => {
                    ev.tell(
                        Diagnostic::new("E0208", format!("this solid must be given its {word}"))
                            .at(phrase.span, "missing here")
                            .help(phrase.word.help),
                    );
                    None
                }
            }
        };
        let size = |ev: &mut Self| -> Option<[f64; 3]> {
            let args = phrase.values("size");
            let [a, b, c] = args.as_slice() else {
                length(ev, "size");
                return None;
            };
            Some([
                ev.within_range(*a, Dimension::LENGTH, 1e-3, SIZE)?,
                ev.within_range(*b, Dimension::LENGTH, 1e-3, SIZE)?,
                ev.within_range(*c, Dimension::LENGTH, 1e-3, SIZE)?,
            ])
        };
        let shape = match phrase.choice(0)? {
            "sphere" => Shape::Sphere { radius: length(self, "radius")? },
            "cylinder" => {
                Shape::Cylinder { radius: length(self, "radius")?, height: length(self, "height")? }
            }
            "box" => Shape::Box { size: size(self)? },
            "table" => {
                let size = size(self)?;
                let thickness = match phrase.value("thickness") {
                    Some(arg) => self.within_range(arg, Dimension::LENGTH, 1e-3, size[1])?,
                    None => TABLE_TOP.min(size[1]),
                };
                Shape::Table { size, thickness }
            }
            _ => Shape::Plane,
        };
        let at = match fields.value("at") {
            Some(arg) => self.place_in_space(arg)?,
            None => [0.0; 3],
        };
        let turn = match fields.value("turn") {
            Some(arg) => self.turns_in_space(arg)?,
            None => [0.0; 3],
        };
        let friction = match fields.value("friction") {
            Some(arg) => Some(self.within_range(arg, Dimension::NUMBER, 0.0, 10.0)?),
            None => None,
        };
        Some(Solid { name, span, shape, at, turn, friction })
    }

    /// A sari laid half over a line, or flat on the ground, as a garment of its own.
    pub(super) fn hung(&mut self, id: ItemId, span: Span, on_line: bool) -> Option<Making> {
        let Made::Sari(sari, fabric) = self.make(id, span)? else { return None };
        let name = self.item(id).name.clone();
        let mut making = Making::new(&name, self.item(id).span);
        let fabric = self.fabric_number(fabric, span, &mut making)?;
        let edges = sari_edges([sari.length, sari.width], span);
        let mut sheet = Sheet::default();
        sheet.add_ring(&edges, &[]);
        sheet.orient();
        let draft = Rc::new(Draft {
            item: id,
            name,
            span,
            scope: self.item(id).scope,
            fabric: None,
            grain: -FRAC_PI_2,
            cell: None,
            layer: 0,
            inside: false,
            plies: 1,
            allowances: Vec::new(),
            bands: Vec::new(),
            counted: None,
            pieces: vec![cut_piece(&sheet, None, None)],
            drawn: edges,
        });
        let surface = Surface::Sari(Box::new((*sari).clone()));
        // Lying level with u along −z over the line, the padar end in front.
        let height = if on_line { LINE[0] + LINE[1] + 0.01 } else { 0.01 };
        let at = [-sari.width / 2.0, height, -sari.length / 2.0];
        let turn = [-FRAC_PI_2, 0.0, 0.0];
        let turn = if on_line { [turn[0], -FRAC_PI_2, turn[2]] } else { turn };
        let at = if on_line { at } else { [-sari.length / 2.0, height, sari.width / 2.0] };
        let piece = draft.pieces.first()?;
        making.garment.panels.push(panel(&draft, piece, fabric, surface, at, turn));
        let solid = |name: &str, shape: Shape, at: [f64; 3], turn: [f64; 3]| Solid {
            name: name.to_owned(),
            span,
            shape,
            at,
            turn,
            friction: None,
        };
        if on_line {
            let long = sari.width + 0.6;
            making.garment.solids.push(solid(
                "line",
                Shape::Cylinder { radius: LINE[1], height: long },
                [-long / 2.0, LINE[0], 0.0],
                [0.0, 0.0, -FRAC_PI_2],
            ));
        } else {
            making.garment.solids.push(solid("ground", Shape::Plane, [0.0; 3], [0.0; 3]));
        }
        Some(making)
    }
}

/// The edges of a sari: lower, outer (the padar end), upper, inner.
fn sari_edges([length, width]: [f64; 2], span: Span) -> Vec<Drawn> {
    let mut edges = rectangle([0.0, 0.0], [length, width], span);
    for (edge, name) in edges.iter_mut().zip(["lower", "outer", "upper", "inner"]) {
        edge.name = Some(name.to_owned());
    }
    edges
}

/// A flat panel of one piece.
fn panel(
    draft: &Draft,
    piece: &CutPiece,
    fabric: usize,
    surface: Surface,
    at: [f64; 3],
    turn: [f64; 3],
) -> Panel {
    Panel {
        name: draft.name.clone(),
        span: draft.span,
        fabric,
        grain: draft.grain,
        cell: draft.cell,
        layer: draft.layer,
        loops: piece.loops.clone(),
        edges: piece
            .edges
            .iter()
            .map(|edge| NamedEdge {
                name: edge.name.clone(),
                span: edge.span,
                allowance: 0.0,
                corner: Corner::default(),
                runs: edge.runs.iter().map(|(run, _)| *run).collect(),
            })
            .collect(),
        allowance: 0.0,
        creases: piece.creases.clone(),
        marks: piece.drawn_marks(),
        notches: piece.notches.clone(),
        bands: Vec::new(),
        surface,
        placement: Placement::Flat { at, turn: turn.map(curve::turned) },
    }
}
