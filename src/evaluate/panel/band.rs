//! Further cloth along the edges of a piece: `hem`, `facing`, `interfacing`, `placket`, said in a panel
//! or of edges of several panels in a garment; facings and plackets of slits.

use super::super::Evaluator;
use super::super::fields::{Fields, Phrase};
use super::super::garment::Making;
use super::super::item::ItemId;
use super::super::value::Value;
use super::super::words::Kind;
use super::edge::EdgeRef;
use super::slit;
use crate::diagnostic::{Diagnostic, Span};
use crate::garment::panel::{Band, BandKind};
use crate::units::Dimension;

/// The words that lay further cloth along edges.
pub(in super::super) const BANDS: &[&str] = &["hem", "facing", "interfacing", "placket"];

/// Plies of the placket of a slit on each lip: two strips that lie over each other, both doubled.
const STRIPS: u32 = 4;

/// The narrowest and the widest band, m.
const WIDTH: (f64, f64) = (1e-3, 0.5);

/// Further cloth along edges, by their names.
#[derive(Clone, Debug)]
pub struct Banded {
    /// The edges.
    pub edges: Vec<String>,
    /// What is laid along them.
    pub cloth: Cloth,
}

/// The cloth of a band.
#[derive(Clone, Copy, Debug)]
pub struct Cloth {
    /// Where it is said.
    pub span: Span,
    /// What it is.
    pub kind: BandKind,
    /// How far it reaches into the piece, m.
    pub width: f64,
    /// Its plies.
    pub plies: u32,
    /// Its fabric, where it is not the piece's own.
    pub fabric: Option<ItemId>,
}

impl Cloth {
    /// How much of it is cut on to the edge, m: a hem and a placket without a fabric of its own are
    /// turned in ply by ply.
    pub fn cut_on(&self) -> Option<f64> {
        let turned = match self.kind {
            BandKind::Hem => true,
            BandKind::Placket => self.fabric.is_none(),
            BandKind::Facing | BandKind::Interfacing | BandKind::Strip => false,
        };
        turned.then(|| self.width * f64::from(self.plies))
    }
}

impl<'t> Evaluator<'t> {
    /// All bands of a panel.
    pub(super) fn bands(&mut self, fields: &Fields<'t>) -> Option<Vec<Banded>> {
        let mut bands = Vec::new();
        for phrase in fields.phrases.iter().filter(|p| BANDS.contains(&p.word.name)) {
            let cloth = self.band_cloth(phrase)?;
            let mut edges = Vec::new();
            for arg in phrase.values("on") {
                edges.push(self.name_of(arg)?.text.clone());
            }
            bands.push(Banded { edges, cloth });
        }
        for phrase in fields.all("slit") {
            let (facing, placket) = (phrase.value("facing"), phrase.value("placket"));
            let Some(said) = facing.or(placket) else { continue };
            let width = self.within_range(said, Dimension::LENGTH, WIDTH.0, WIDTH.1)?;
            let edges = slit::lips(phrase).into_iter().flatten().collect();
            // A placket lies over the slit, half of it on each lip.
            let (kind, width, plies) = match facing {
                Some(_) => (BandKind::Facing, width, 1),
                None => (BandKind::Strip, 0.5 * width, STRIPS),
            };
            let fabric = self.band_fabric(phrase)?;
            bands.push(Banded {
                edges,
                cloth: Cloth { span: phrase.span, kind, width, plies, fabric },
            });
        }
        Some(bands)
    }

    /// The cloth that one line lays along edges.
    fn band_cloth(&mut self, phrase: &Phrase<'t>) -> Option<Cloth> {
        let width = phrase.value("depth").or(phrase.value("width"))?;
        let width = self.within_range(width, Dimension::LENGTH, WIDTH.0, WIDTH.1)?;
        let fabric = self.band_fabric(phrase)?;
        let kind = match phrase.word.name {
            "hem" => BandKind::Hem,
            "facing" => BandKind::Facing,
            "placket" => BandKind::Placket,
            _ => BandKind::Interfacing,
        };
        // A hem that is turned twice lies double, and a placket always does.
        let plies = if phrase.says("double") || kind == BandKind::Placket { 2 } else { 1 };
        Some(Cloth { span: phrase.span, kind, width, plies, fabric })
    }

    /// The fabric that a line names behind `of`, if it does; nothing where there is no such fabric.
    fn band_fabric(&mut self, phrase: &Phrase<'t>) -> Option<Option<ItemId>> {
        match phrase.value("of") {
            Some(arg) => self.item_among(arg, &[Kind::Fabric]).map(Some),
            None => Some(None),
        }
    }

    /// Lays the bands of a garment along the edges of its panels; false if one is wrong.
    pub(in super::super) fn bands_of_garment(
        &mut self,
        fields: &Fields<'t>,
        making: &mut Making,
    ) -> bool {
        let mut sound = true;
        for phrase in fields.phrases.iter().filter(|p| BANDS.contains(&p.word.name)) {
            self.within = Some((phrase.scope, self.waiting.len()));
            sound &= self.band_of_garment(phrase, making).is_some();
        }
        self.within = None;
        sound
    }

    fn band_of_garment(&mut self, phrase: &Phrase<'t>, making: &mut Making) -> Option<()> {
        let cloth = self.band_cloth(phrase);
        let mut all: Vec<EdgeRef> = Vec::new();
        for arg in phrase.values("on") {
            let edges = match self.eval(arg.expr, arg.scope) {
                Value::Poison => return None,
                Value::Edges(edges) => edges,
                other => {
                    self.wrong(&other, "edges", arg.expr.span);
                    return None;
                }
            };
            if !self.all_on_rim(&edges, arg) {
                return None;
            }
            let cut_on = cloth.is_some_and(|cloth| cloth.cut_on().is_some());
            if cut_on && edges.iter().any(|edge| edge.part.is_some()) {
                let text = format!("what a `{}` takes is cut on to whole edges", phrase.word.name);
                self.tell(
                    Diagnostic::new("E0304", text)
                        .at(arg.expr.span, "this is a part")
                        .help("`facing` goes along parts too"),
                );
                return None;
            }
            all.extend(edges);
        }
        let cloth = cloth?;
        let fabric = match cloth.fabric {
            Some(fabric) => Some(self.fabric_number(fabric, cloth.span, making)?),
            None => None,
        };
        for edge in &all {
            for found in edge.find() {
                let number = *making.numbers.get(&(edge.draft.item, found.piece))?;
                let panel = making.garment.panels.get_mut(number)?;
                panel.bands.push(Band {
                    span: cloth.span,
                    kind: cloth.kind,
                    runs: edge.runs(&found),
                    width: cloth.width,
                    fabric: fabric.unwrap_or(panel.fabric),
                    plies: cloth.plies,
                });
                // What the panel says of its own edge goes first.
                let said = edge.draft.allowances.iter();
                let said = said.filter(|(name, ..)| name.as_deref() == Some(&edge.edge)).count();
                if let (Some(more), 0, Some(edge)) =
                    (cloth.cut_on(), said, panel.edges.get_mut(found.edge))
                {
                    edge.allowance = more;
                }
            }
        }
        Some(())
    }
}
