//! Garments and scenes: everything one drape needs, from the lines of their blocks.

use super::Evaluator;
use super::fields::{Fields, Phrase};
use super::item::{ItemId, Made, root};
use super::panel::{Draft, Standing};
use super::words::Kind;
use crate::diagnostic::{Diagnostic, Span};
use crate::garment::Garment;
use crate::garment::cloth::Surface;
use crate::garment::panel::{Corner, NamedEdge, Panel, Run};
use crate::garment::scene::{Phase, Placement};
use crate::garment::seam::{PanelRun, Seam};
use crate::textile::fabric::Fabric;
use crate::units::Dimension;
use std::collections::BTreeMap;
use std::rc::Rc;

/// Panels one garment may have.
const PANELS: usize = 2_000;

/// Seam allowance where nothing else is said, m.
const ALLOWANCE: f64 = 0.01;

/// A garment while it is put together.
pub(super) struct Making {
    pub garment: Garment,
    /// Where each piece of a panel stands in the garment.
    pub numbers: BTreeMap<(ItemId, usize), usize>,
    pub drafts: BTreeMap<ItemId, Rc<Draft>>,
    /// Where each wearer stands in the garment.
    pub bodies: BTreeMap<ItemId, usize>,
    /// The fabric of panels that name none.
    pub cloth: Option<ItemId>,
    /// The fabric of the first panel, from which parts are cut if nothing else is said.
    pub first_cloth: Option<ItemId>,
    /// Whether a fabric was named that is none, which has been told.
    pub clothless: bool,
    /// Seam allowance of panels that say none, m.
    pub allowance: f64,
    fabrics: BTreeMap<ItemId, usize>,
    /// Whether a part of it is wrong, which has been told. It is looked at all the same, so that
    /// its other mistakes are told too, but not given out.
    pub broken: bool,
}

impl Making {
    pub(super) fn new(name: &str, span: Span) -> Self {
        Making {
            garment: Garment {
                name: name.to_owned(),
                span,
                fabrics: Vec::new(),
                panels: Vec::new(),
                seams: Vec::new(),
                stitches: Vec::new(),
                nearby: Vec::new(),
                patches: Vec::new(),
                cords: Vec::new(),
                ties: Vec::new(),
                bodies: Vec::new(),
                solids: Vec::new(),
                attachments: Vec::new(),
                pins: Vec::new(),
                schedule: Vec::new(),
                pictures: Vec::new(),
                grade: Vec::new(),
            },
            numbers: BTreeMap::new(),
            drafts: BTreeMap::new(),
            bodies: BTreeMap::new(),
            cloth: None,
            first_cloth: None,
            clothless: false,
            allowance: ALLOWANCE,
            fabrics: BTreeMap::new(),
            broken: false,
        }
    }
}

/// The fabric of that number in several plies, as a fabric of its own: everything adds up, and the
/// plies slide on each other when they are bent.
fn plied(number: usize, plies: u32, making: &mut Making) -> usize {
    let fabrics = &mut making.garment.fabrics;
    let Some(single) = fabrics.get(number).filter(|_| plies > 1).cloned() else { return number };
    let name = format!("{} x {plies}", single.name);
    if let Some(known) = fabrics.iter().position(|fabric| fabric.name == name) {
        return known;
    }
    let count = f64::from(plies);
    fabrics.push(Fabric {
        name,
        mass: single.mass * count,
        thickness: single.thickness * count,
        bending: single.bending.map(|b| b * count),
        tensile: single.tensile.map(|k| k * count),
        shear: single.shear * count,
        ..single
    });
    fabrics.len() - 1
}

impl<'t> Evaluator<'t> {
    /// Works out the whole file: every item, so that all mistakes are told, and of these the
    /// garments, scenes and pictured saris that are wanted.
    pub(super) fn file(&mut self, names: &[String]) -> Vec<Garment> {
        let (_, fields) = self.open_files();
        let mut garments = Vec::new();
        let mut known: Vec<String> = Vec::new();
        for phrase in &fields.phrases {
            if let Some(id) = phrase.item {
                let name = self.item(id).name.clone();
                // In another size only those are drawn that are wanted: others may have none.
                let passed_over =
                    self.size.is_some() && !names.is_empty() && !names.contains(&name);
                if matches!(phrase.word.name, "garment" | "scene") {
                    known.push(name);
                    if passed_over {
                        continue;
                    }
                }
            }
            let before = self.errors();
            let made = match (phrase.word.name, phrase.item) {
                ("garment", Some(id)) => self.garment(id),
                ("scene", Some(id)) => self.scene(id),
                ("picture", _) => self.pictured(phrase),
                _ => continue,
            };
            garments.extend(made.filter(|_| self.errors() == before));
        }
        self.make_all(self.root);
        self.look_at_lone_blocks();
        self.requirements(&fields);
        self.check_names(self.size.is_none() || names.is_empty());
        self.allow();
        if names.is_empty() {
            return garments;
        }
        known.extend(garments.iter().map(|garment| garment.name.clone()));
        for name in names {
            if !known.contains(name) {
                let label = self.meant(name, known.iter().map(String::as_str));
                self.tell(
                    Diagnostic::new("E0204", format!("this file has no garment or scene `{name}`"))
                        .at(Span::new(self.root, 0, 0), label),
                );
            }
        }
        garments.retain(|garment| names.contains(&garment.name));
        garments
    }

    fn errors(&self) -> usize {
        self.told.iter().filter(|diagnostic| diagnostic.is_error()).count()
    }

    fn garment(&mut self, id: ItemId) -> Option<Garment> {
        let mut fields = self.open_item(id)?;
        let (name, span) = (self.item(id).name.clone(), self.item(id).span);
        let mut making = Making::new(&name, span);
        self.stand(&fields);
        if let Some(arg) = fields.value("fabric") {
            making.cloth = self.item_named(arg, Kind::Fabric);
            making.clothless = making.cloth.is_none();
            making.broken |= making.clothless;
        }
        if let Some(arg) = fields.value("allowance") {
            match self.within_range(arg, Dimension::LENGTH, 0.0, 0.5) {
                Some(allowance) => making.allowance = allowance,
                None => making.broken = true,
            }
        }
        making.garment.grade = self.grade(&fields);
        making.broken |= !self.take_parts(&mut fields);
        let cell = match fields.value("grid") {
            Some(arg) => self.within_range(arg, Dimension::LENGTH, 1e-4, 1.0),
            None => None,
        };
        let (drawn, sewn) = self.assemble(&fields, cell, &mut making);
        if making.garment.panels.is_empty() && !fields.mentions("panel") && !fields.mentions("part")
        {
            self.tell(
                Diagnostic::new("E0208", format!("garment `{name}` has no panels"))
                    .at(span, "here")
                    .help("such as `panel front of denim { … }`"),
            );
        }
        let clear = ["panel", "part", "place", "seam", "patch"]
            .into_iter()
            .all(|word| !fields.spoils(word));
        self.schedule(&fields, &mut making);
        self.pictures(&fields, &mut making);
        if drawn && sewn && clear {
            self.led(&mut making);
            self.held(&making, &fields);
        }
        (!making.broken).then_some(making.garment)
    }

    /// Puts the pieces of a garment or a block together; whether all are drawn, and whether all
    /// is sewn.
    pub(super) fn assemble(
        &mut self,
        fields: &Fields<'t>,
        cell: Option<f64>,
        making: &mut Making,
    ) -> (bool, bool) {
        self.wearers(fields, making);
        for phrase in fields.all("panel") {
            let Some(panel) = phrase.item else { continue };
            self.add_panel(panel, cell, making);
        }
        let drawn = fields
            .all("panel")
            .all(|phrase| phrase.item.is_some_and(|panel| making.drafts.contains_key(&panel)));
        making.broken |= !drawn || !fields.spoiled.is_empty();
        self.places(fields, making);
        making.broken |= !self.bands_of_garment(fields, making);
        let sewn = self.seams(fields, making) & self.cords(fields, making);
        self.holds(fields, making);
        self.checks(fields);
        self.requirements(fields);
        making.broken |= !sewn;
        (drawn, sewn)
    }

    /// How panels stand to the wearer, read from the words of the `place` lines before any panel
    /// is drawn: it names the halves of unfolded pieces.
    pub(super) fn stand(&mut self, fields: &Fields<'t>) {
        for phrase in fields.all("place") {
            let standing = if phrase.says("before") {
                Standing::Before
            } else if phrase.says("behind") {
                Standing::Behind
            } else {
                continue;
            };
            let Some(name) = phrase.head.first().and_then(|expr| root(expr)) else { continue };
            let Some(binding) = self.find(phrase.scope, &name.text) else { continue };
            let ids: Vec<ItemId> = match &self.bindings[binding.0].what {
                super::scope::What::Item(id) => vec![*id],
                super::scope::What::Family(members) => members.values().copied().collect(),
                _ => continue,
            };
            if ids.iter().any(|id| self.item(*id).kind == Kind::Part) {
                // What the garment says of a part's panel goes before what its block says.
                let Some(&head) = phrase.head.first() else { continue };
                for id in self.placed_in_part(head, phrase.scope) {
                    self.sides.insert(id, standing);
                }
                continue;
            }
            for id in ids {
                self.sides.entry(id).or_insert(standing);
            }
        }
        if fields.spoils("place") {
            for id in fields.all("panel").filter_map(|phrase| phrase.item) {
                self.sides.entry(id).or_insert(Standing::Unknown);
            }
        }
    }

    pub(super) fn wearers(&mut self, fields: &Fields<'t>, making: &mut Making) {
        for phrase in fields.all("wearer") {
            let Some(id) = phrase.item else { continue };
            if let Some(request) = self.wearer(id, phrase.span) {
                making.bodies.insert(id, making.garment.bodies.len());
                making.garment.bodies.push((*request).clone());
            }
        }
    }

    /// Adds the pieces of a panel to the garment.
    fn add_panel(&mut self, id: ItemId, cell: Option<f64>, making: &mut Making) {
        let span = self.item(id).span;
        let Some(draft) = self.panel(id, span) else { return };
        let says = self.says_fabric(id);
        let fabric = match draft.fabric {
            None if !says => self.fabric_around(id, making),
            own => own,
        };
        making.clothless |= draft.fabric.is_none() && says;
        if fabric.is_none() && !making.clothless && !self.is_lone(self.item(id).scope) {
            self.tell(
                Diagnostic::new("E0208", format!("panel `{}` must be given a fabric", draft.name))
                    .at(span, "missing here")
                    .help(format!("`panel {} of cotton {{ … }}`", draft.name)),
            );
        }
        // A piece without its fabric is still sewn, to see whether its seams are right.
        making.first_cloth = making.first_cloth.or(fabric);
        let fabric = fabric
            .and_then(|fabric| self.fabric_number(fabric, span, making))
            .map(|number| plied(number, draft.plies, making));
        making.broken |= fabric.is_none();
        let fabric = fabric.unwrap_or_default();
        let mut bands: Vec<(&super::panel::Banded, usize)> = Vec::new();
        for band in &draft.bands {
            let number = match band.cloth.fabric {
                Some(other) => self.fabric_number(other, band.cloth.span, making),
                None => Some(fabric),
            };
            making.broken |= number.is_none();
            bands.extend(number.map(|number| (band, number)));
        }
        let plain = making.allowance;
        let allowance = |edge: &str| -> (f64, Corner) {
            let fits = |name: &Option<String>| name.as_ref().is_none_or(|name| name == edge);
            let said = draft.allowances.iter().rev().find(|(name, ..)| fits(name));
            said.map_or((plain, Corner::default()), |(_, width, corner)| (*width, *corner))
        };
        for (number, piece) in draft.pieces.iter().enumerate() {
            if making.garment.panels.len() >= PANELS {
                self.tell(
                    Diagnostic::new("E0210", format!("more than {PANELS} pieces in one garment"))
                        .at(span, "here"),
                );
                return;
            }
            making.numbers.insert((id, number), making.garment.panels.len());
            let edges = piece
                .edges
                .iter()
                .map(|edge| NamedEdge {
                    name: edge.full_name(),
                    span: edge.span,
                    allowance: allowance(&edge.name).0,
                    corner: allowance(&edge.name).1,
                    runs: edge.runs.iter().map(|(run, _)| *run).collect(),
                })
                .collect();
            let mirrored = number > 0;
            making.garment.panels.push(Panel {
                name: draft.piece_name(piece),
                span,
                fabric,
                grain: if mirrored { -draft.grain } else { draft.grain },
                cell: draft.cell.or(cell),
                layer: draft.layer,
                loops: piece.loops.clone(),
                edges,
                allowance: allowance("").0,
                creases: piece.creases.clone(),
                marks: piece.drawn_marks(),
                notches: piece.notches.clone(),
                bands: bands.iter().flat_map(|(band, fabric)| piece.bands(band, *fabric)).collect(),
                surface: Surface::Fabric,
                placement: Placement::Led,
            });
        }
        making.drafts.insert(id, draft);
    }

    /// Whether a panel or one it copies names a fabric, right or wrong.
    fn says_fabric(&mut self, id: ItemId) -> bool {
        let mut copied = Some(id);
        // A copy that could be drawn is none of itself.
        while let Some(arg) = copied.and_then(|id| self.item(id).phrase.value("=")) {
            let base = self.item_named(arg, Kind::Panel);
            if base.is_none_or(|base| self.item(base).phrase.says("of")) {
                return true;
            }
            copied = base;
        }
        let item = self.item(id);
        let opened = self.instances.iter().rev().find(|instance| instance.item == id);
        item.phrase.says("of") || opened.is_some_and(|instance| instance.fields.mentions("fabric"))
    }

    /// The number of a fabric in the garment.
    pub(super) fn fabric_number(
        &mut self,
        id: ItemId,
        at: Span,
        making: &mut Making,
    ) -> Option<usize> {
        if let Some(number) = making.fabrics.get(&id) {
            return Some(*number);
        }
        let fabric = self.fabric(id, at)?;
        let number = making.garment.fabrics.len();
        making.garment.fabrics.push((*fabric).clone());
        making.fabrics.insert(id, number);
        Some(number)
    }

    fn places(&mut self, fields: &Fields<'t>, making: &mut Making) {
        let mut said: BTreeMap<(ItemId, usize), Span> = BTreeMap::new();
        let bodies = making.bodies.clone();
        for phrase in fields.all("place") {
            self.within = Some((phrase.scope, self.waiting.len()));
            let Some(placed) = self.placements(phrase, &|id| bodies.get(&id).copied()) else {
                // The piece is not told to be placed nowhere on top of this mistake.
                self.note_place(phrase, making, &mut said);
                continue;
            };
            for (piece, placement) in placed {
                if let Some(before) = said.insert(piece, phrase.span) {
                    let name = self.item(piece.0).name.clone();
                    self.tell(
                        Diagnostic::new("E0209", format!("`{name}` is placed twice"))
                            .at(phrase.span, "here")
                            .at(before, "and here"),
                    );
                }
                if let Some(number) = making.numbers.get(&piece) {
                    if let Some(panel) = making.garment.panels.get_mut(*number) {
                        panel.placement = placement;
                    }
                }
            }
        }
    }

    /// Marks the panel of a wrong `place` line as placed.
    fn note_place(
        &self,
        phrase: &Phrase<'t>,
        making: &mut Making,
        said: &mut BTreeMap<(ItemId, usize), Span>,
    ) {
        let name = phrase.head.first().and_then(|expr| root(expr));
        let binding = name.and_then(|name| self.find(phrase.scope, &name.text));
        let Some(binding) = binding else { return };
        if let super::scope::What::Item(id) = &self.bindings[binding.0].what {
            for number in 0..2 {
                said.insert((*id, number), phrase.span);
                if let Some(panel) = making
                    .numbers
                    .get(&(*id, number))
                    .and_then(|number| making.garment.panels.get_mut(*number))
                {
                    panel.placement = Placement::Flat { at: [0.0; 3], turn: [0.0; 3] };
                }
            }
        }
    }

    /// Pieces that no `place` line and no row of seams leads anywhere are told (E0801).
    fn led(&mut self, making: &mut Making) {
        let garment = &making.garment;
        let mut reached: Vec<bool> =
            garment.panels.iter().map(|panel| panel.placement != Placement::Led).collect();
        loop {
            let mut moved = false;
            for stitch in &garment.stitches {
                for [a, b] in &stitch.pairs {
                    for (from, to) in [(a.0, b.0), (b.0, a.0)] {
                        if reached[from] && !std::mem::replace(&mut reached[to], true) {
                            moved = true;
                        }
                    }
                }
            }
            for patch in &garment.patches {
                for (from, to) in [(patch.host, patch.panel), (patch.panel, patch.host)] {
                    if reached[from] && !std::mem::replace(&mut reached[to], true) {
                        moved = true;
                    }
                }
            }
            for seam in &garment.seams {
                let any = seam
                    .a
                    .iter()
                    .chain(&seam.b)
                    .any(|run| reached.get(run.panel).copied().unwrap_or(false));
                if any {
                    for run in seam.a.iter().chain(&seam.b) {
                        if let Some(reached) = reached.get_mut(run.panel).filter(|r| !**r) {
                            *reached = true;
                            moved = true;
                        }
                    }
                }
            }
            if !moved {
                break;
            }
        }
        let lost: Vec<(String, Span)> = garment
            .panels
            .iter()
            .zip(&reached)
            .filter(|(_, reached)| !**reached)
            .map(|(panel, _)| (panel.name.clone(), panel.span))
            .collect();
        for (name, span) in lost {
            self.tell(
                Diagnostic::new("E0801", format!("`{name}` is placed nowhere"))
                    .at(span, "no seam leads to a placed panel")
                    .help(format!("such as `place {name} before lady.waist gap 3cm`")),
            );
        }
    }

    /// A garment without wearer of which nothing is pinned is told of (W0801).
    fn held(&mut self, making: &Making, fields: &Fields<'t>) {
        let garment = &making.garment;
        let said = ["wearer", "part", "pin", "fix", "attach"];
        let sound = !making.broken && !garment.panels.is_empty();
        if sound && garment.bodies.is_empty() && !said.iter().any(|word| fields.mentions(word)) {
            self.tell(
                Diagnostic::new("W0801", format!("nothing holds `{}`", garment.name))
                    .at(garment.span, "no wearer, and no `pin` or `fix`")
                    .help("such as `wearer lady = female { size: EU 38 }`"),
            );
        }
    }

    /// Seams of the darts and pleats of all panels, then those that the text says; false if one is wrong.
    fn seams(&mut self, fields: &Fields<'t>, making: &mut Making) -> bool {
        for (id, draft) in &making.drafts {
            for (number, piece) in draft.pieces.iter().enumerate() {
                let Some(&panel) = making.numbers.get(&(*id, number)) else { continue };
                for join in &piece.joins {
                    let on = |&run: &Run| PanelRun { panel, run };
                    let [a, b] = join.sides.each_ref().map(|side| side.iter().map(on).collect());
                    making.garment.seams.push(Seam {
                        name: format!("{}.{}", draft.piece_name(piece), join.name),
                        span: join.span,
                        kind: join.kind,
                        a,
                        b,
                    });
                }
            }
        }
        let (by_points, phrases): (Vec<Phrase<'t>>, Vec<Phrase<'t>>) =
            fields.all("seam").cloned().partition(|p| p.says("points") || p.says("near"));
        let mut sewn = self.sew(&phrases, making);
        for phrase in by_points.iter().chain(fields.all("button")).chain(fields.all("hook")) {
            self.within = Some((phrase.scope, self.waiting.len()));
            sewn &= self.stitch(phrase, making).is_some();
        }
        for phrase in fields.all("patch") {
            self.within = Some((phrase.scope, self.waiting.len()));
            sewn &= self.patch(phrase, making).is_some();
        }
        self.within = None;
        sewn
    }

    /// A garment that a top-level `picture { of: … }` asks for: a sari over a line, or flat.
    fn pictured(&mut self, phrase: &Phrase<'t>) -> Option<Garment> {
        let block = phrase.block?;
        let fields = self.read_plain(Kind::Picture, block, "the picture", phrase.scope);
        let of = self.required(&fields, "of")?.arg(0)?;
        let id = self.item_among(of, &[Kind::Sari, Kind::Garment, Kind::Scene])?;
        let picture = self.picture(&fields)?;
        if self.item(id).kind != Kind::Sari {
            self.tell(
                Diagnostic::new("E0207", "a picture of a garment stands inside the garment")
                    .at(of.expr.span, "this is no sari")
                    .help("move the picture into its block and drop `of`"),
            );
            return None;
        }
        let Some(Made::Sari(..)) = self.make(id, of.expr.span) else { return None };
        let on_line = fields.get("show").and_then(|show| show.choice(0)) != Some("flat");
        let mut making = self.hung(id, phrase.span, on_line)?;
        self.suits(&fields, Some(&picture), &making.garment);
        making.garment.pictures.push(picture);
        if making.garment.schedule.is_empty() {
            making.garment.schedule.push(Phase::Settle { speed: 2e-3, within: 20.0, span: None });
        }
        Some(making.garment)
    }
}
