//! What the workshop does, and the pictures it takes.

use super::Evaluator;
use super::fields::{Arg, Fields, bare};
use super::garment::Making;
use super::words::Kind;
use crate::diagnostic::Diagnostic;
use crate::garment::Garment;
use crate::garment::scene::{Background, Light, Phase, Picture, Quality, Shading, View};
use crate::syntax::tree::{BinaryOp, Expr, ExprKind};
use crate::units::Dimension;

/// Seams are welded when no pair is further apart, m, where nothing else is said.
const GAP: f64 = 1e-3;
/// Buttons are held when no pair is further apart, m: two layers of cloth lie between, which are
/// kept apart.
const CLOSED: f64 = 5e-3;
/// At rest when nothing moves faster, m/s, where nothing else is said.
const SPEED: f64 = 2e-3;
/// Longest time to come to rest, s, where nothing else is said.
const WITHIN: f64 = 20.0;
/// Frames per second that are kept, where nothing else is said.
const RATE: f64 = 60.0;
/// How far a camera may go round, rad.
const TURN: f64 = 2.0 * std::f64::consts::PI;
/// Heights of what a view may show, m.
const FIELD: [f64; 2] = [2e-3, 10.0];

impl<'t> Evaluator<'t> {
    /// The schedule of a garment or scene: what its `drape` says, else sew (where there are
    /// seams) and settle.
    pub(super) fn schedule(&mut self, fields: &Fields<'t>, making: &mut Making) {
        let blocks: Vec<_> = fields.all("drape").cloned().collect();
        if let [first, second, ..] = blocks.as_slice() {
            self.tell(
                Diagnostic::new("E0209", "`drape` is said twice")
                    .at(second.key.span, "here")
                    .at(first.key.span, "and here"),
            );
        }
        let mut phases = Vec::new();
        if let Some((phrase, block)) = blocks.first().and_then(|p| p.block.map(|b| (p, b))) {
            let lines = self.read_plain(Kind::Drape, block, "the drape", phrase.scope);
            for line in &lines.phrases {
                let span = Some(line.span);
                let phase = match line.word.name {
                    "sew" => line
                        .value("until")
                        .and_then(|arg| self.below(arg, "gap", Dimension::LENGTH))
                        .map(|gap| Phase::Sew { gap, span }),
                    "close" => {
                        if phases.iter().any(|phase| matches!(phase, Phase::Close { .. })) {
                            self.tell(
                                Diagnostic::new("E0209", "`close` is said twice")
                                    .at(line.span, "everything is closed already"),
                            );
                        }
                        Some(Phase::Close { gap: CLOSED, span })
                    }
                    "settle" => {
                        let speed = line
                            .value("until")
                            .and_then(|arg| self.below(arg, "speed", Dimension::SPEED));
                        let within = match line.value("within") {
                            Some(arg) => self.within_range(arg, Dimension::TIME, 0.01, 600.0),
                            None => Some(WITHIN),
                        };
                        speed.zip(within).map(|(speed, within)| Phase::Settle {
                            speed,
                            within,
                            span,
                        })
                    }
                    "run" => {
                        let time = line
                            .arg(0)
                            .and_then(|arg| self.within_range(arg, Dimension::TIME, 1e-3, 600.0));
                        let rate = match line.value("at") {
                            Some(arg) => self.within_range(arg, Dimension::RATE, 0.1, 1e4),
                            None => Some(RATE),
                        };
                        time.zip(rate).map(|(time, rate)| Phase::Run { time, rate, span })
                    }
                    _ => None,
                };
                if let (Some(Phase::Sew { .. }), Some(before)) = (&phase, phases.last()) {
                    if !matches!(before, Phase::Sew { .. }) {
                        self.tell(
                            Diagnostic::new("E0804", "`sew` comes first")
                                .at(line.span, "here the cloth is hanging already")
                                .help("let `sew` be the first line of `drape`"),
                        );
                    }
                }
                phases.extend(phase);
            }
        }
        if phases.is_empty() {
            let sewn = making.garment.stitches.iter().any(|stitch| !stitch.closure);
            let near = !making.garment.nearby.is_empty();
            if !making.garment.seams.is_empty() || sewn || near {
                phases.push(Phase::Sew { gap: GAP, span: None });
            }
            if Self::closes(making) {
                phases.push(Phase::Close { gap: CLOSED, span: None });
            }
            phases.push(Phase::Settle { speed: SPEED, within: WITHIN, span: None });
        }
        making.garment.schedule = phases;
    }

    /// The limit in `gap < 1mm` or `speed < 2mm/s`.
    fn below(&mut self, arg: Arg<'t>, name: &'static str, wanted: Dimension) -> Option<f64> {
        let told = |ev: &mut Self, expr: &Expr| {
            if !matches!(expr.kind, ExprKind::Unread) {
                let example = if name == "gap" { "gap < 1mm" } else { "speed < 2mm/s" };
                ev.tell(
                    Diagnostic::new("E0304", format!("`{}` wants `{name} < …`", arg.of))
                        .at(expr.span, "not this")
                        .help(format!("such as `{example}`")),
                );
            }
            None
        };
        let ExprKind::Binary { op: BinaryOp::Less | BinaryOp::AtMost, left, right, .. } =
            &arg.expr.kind
        else {
            return told(self, arg.expr);
        };
        if bare(left).is_none_or(|word| word.text != name) {
            return told(self, left);
        }
        let limit = Arg { expr: right, scope: arg.scope, of: name };
        let quantity = self.any_quantity(limit)?;
        if quantity.dimension != wanted {
            self.tell(
                Diagnostic::new(
                    "E0301",
                    format!(
                        "{} and {} cannot be compared",
                        wanted.name(),
                        quantity.dimension.name()
                    ),
                )
                .at(arg.expr.span, "here")
                .help(if name == "gap" {
                    "such as `1mm`"
                } else {
                    "such as `2mm/s`"
                }),
            );
            return None;
        }
        self.within_range(limit, wanted, 1e-6, 10.0)
    }

    /// The pictures of a garment or scene.
    pub(super) fn pictures(&mut self, fields: &Fields<'t>, making: &mut Making) {
        for phrase in fields.all("picture") {
            let Some(block) = phrase.block else { continue };
            let inner = self.read_plain(Kind::Picture, block, "the picture", phrase.scope);
            for word in ["of", "show"] {
                if let Some(said) = inner.get(word) {
                    self.tell(
                        Diagnostic::new(
                            "E0207",
                            format!("`{word}` is only for pictures outside a garment"),
                        )
                        .at(said.span, "here")
                        .help("remove it"),
                    );
                }
            }
            let picture = self.picture(&inner);
            self.suits(&inner, picture.as_ref(), &making.garment);
            making.garment.pictures.extend(picture);
        }
    }

    /// A picture block.
    pub(super) fn picture(&mut self, fields: &Fields<'t>) -> Option<Picture> {
        let mut views = Vec::new();
        if let Some(phrase) = fields.get("views") {
            for n in 0..phrase.head.len() {
                views.push(match phrase.choice(n)? {
                    "front" => View::Front,
                    "side" => View::Side,
                    "back" => View::Back,
                    "top" => View::Top,
                    _ => View::ThreeQuarter,
                });
            }
        } else {
            views.push(View::Front);
        }
        let size = match fields.get("size") {
            Some(phrase) => {
                let width = self.whole_number(phrase.arg(0)?, 16, 16_384)?;
                let height = self.whole_number(phrase.arg(1)?, 16, 16_384)?;
                [width as u32, height as u32]
            }
            None => Picture::default().size,
        };
        let light = match fields.get("light").and_then(|phrase| phrase.choice(0)) {
            Some("daylight") => Light::Daylight,
            Some("overcast") => Light::Overcast,
            _ => Light::Studio,
        };
        let shading = fields.get("shading").and_then(|phrase| phrase.choice(0));
        let quality = match fields.get("quality").and_then(|phrase| phrase.choice(0)) {
            Some("draft") => Quality::Draft,
            Some("fine") => Quality::Fine,
            _ => Quality::Normal,
        };
        let background = match fields.get("background").and_then(|phrase| phrase.choice(0)) {
            Some("none") => Background::None,
            _ => Background::Paper,
        };
        let field = match fields.value("field") {
            Some(arg) => Some(self.within_range(arg, Dimension::LENGTH, FIELD[0], FIELD[1])?),
            None => None,
        };
        let turn = match fields.value("turn") {
            Some(arg) => Some(self.within_range(arg, Dimension::ANGLE, -TURN, TURN)?),
            None => None,
        };
        let shading = shading.and_then(Shading::named);
        Some(Picture { views, size, light, shading, quality, background, field, turn })
    }

    /// Whether all cloth can be shown as the picture asks.
    pub(super) fn suits(
        &mut self,
        fields: &Fields<'t>,
        picture: Option<&Picture>,
        garment: &Garment,
    ) {
        let Some((phrase, shading)) = fields.get("shading").zip(picture.and_then(|p| p.shading))
        else {
            return;
        };
        let shown = garment.panels.iter().filter_map(|panel| garment.fabrics.get(panel.fabric));
        let Some(other) = shown.into_iter().find(|fabric| !shading.suits(&fabric.structure)) else {
            return;
        };
        let [is, wants] = match shading {
            Shading::Knitted | Shading::KnittedYarns => ["woven", "loops"],
            _ => ["knitted", "threads of warp and weft"],
        };
        self.tell(
            Diagnostic::new(
                "E0815",
                format!("`{}` cannot be shown as `{}`", other.name, shading.name()),
            )
            .at(phrase.span, format!("it has no {wants}: it is {is}"))
            .help("leave out `shading` to show every fabric as what it is"),
        );
    }
}
