//! Saris and their parts, from their blocks.

use super::Evaluator;
use super::fields::{Arg, Fields, Phrase, bare};
use super::item::{Item as Declared, ItemId, Made, State};
use super::words::Kind;
use crate::diagnostic::{Diagnostic, Span};
use crate::garment::sari::{Band, BandFill, Part, Repeat, Sari, Spots, Stripe};
use crate::syntax::tree::{BinaryOp, Expr, ExprKind, Item};
use crate::textile::Colour;
use crate::textile::motif::Motif;
use crate::units::{self, Dimension};
use std::rc::Rc;

/// A part as its block says it, before a sari gives it its length.
#[derive(Clone, Debug, PartialEq)]
pub struct Draft {
    /// How it looks. The pitch of its repeats is still as written.
    pub part: Part,
    /// Whether its block says a ground of its own.
    pub grounded: bool,
    /// Width of a kath or length of a padar, m.
    pub extent: Option<f64>,
    /// Where that is said.
    pub extent_span: Option<Span>,
}

/// Lengths of a sari's cloth, m: from a doll's to nine yards and more.
const LENGTHS: (f64, f64) = (0.2, 20.0);
/// Widths of a sari's cloth, m.
const WIDTHS: (f64, f64) = (0.1, 3.0);
/// Motifs or spots of one statement; more are threads, not figures.
const MOST: f64 = 200_000.0;

/// A part with its width (kath) or length (padar).
pub(super) fn part(ev: &mut Evaluator<'_>, id: ItemId) -> Option<Draft> {
    let fields = ev.open_item(id)?;
    let ground = match fields.value("ground") {
        Some(arg) => Some(ev.colour(arg)?),
        None => None,
    };
    let shot = match fields.value("shot") {
        Some(arg) => Some(ev.colour(arg)?),
        None => None,
    };
    let weave = match fields.value("weave") {
        Some(arg) => {
            let id = ev.item_named(arg, Kind::Weave)?;
            match ev.make(id, arg.expr.span)? {
                Made::Weave(weave) => Some((*weave).clone()),
                _ => None,
            }
        }
        None => None,
    };
    let (word, idle) = match fields.kind {
        Kind::Kath => (Some("width"), "length"),
        Kind::Padar => (Some("length"), "width"),
        _ => (None, "width"),
    };
    for stray in [Some(idle), word.is_none().then_some("length")].into_iter().flatten() {
        if let Some(phrase) = fields.get(stray) {
            ev.tell(
                Diagnostic::new(
                    "E0207",
                    format!("{} has no `{stray}` of its own", fields.kind.title()),
                )
                .at(phrase.span, "here")
                .help("a kath has a width, a padar a length, an ang what is left"),
            );
        }
    }
    let stated = word.and_then(|word| fields.value(word));
    let extent = match stated {
        Some(arg) => Some(ev.within_range(arg, Dimension::LENGTH, 1e-3, LENGTHS.1)?),
        None => None,
    };
    let name = ev.item(id).name.clone();
    let mut part = Part {
        name,
        ground: ground.unwrap_or(Colour([0xe8, 0xe4, 0xda, 0xff])),
        shot,
        weave,
        bands: bands(ev, &fields)?,
        stripes: Vec::new(),
        repeats: Vec::new(),
        spots: Vec::new(),
        edges: Vec::new(),
    };
    let mut good = true;
    for phrase in fields.phrases.clone() {
        let done = match phrase.word.name {
            "stripe" => stripe(ev, &phrase, &mut part.stripes),
            "repeat" => repeat(ev, &phrase).map(|it| part.repeats.push(it)),
            "edge" => repeat(ev, &phrase).map(|it| part.edges.push(it)),
            "spot" => spots(ev, &phrase).map(|it| part.spots.push(it)),
            _ => Some(()),
        };
        good &= done.is_some();
    }
    // Of a part of which a line is not known nobody says that something is missing.
    good &= fields.spoiled.is_empty();
    good &= fits_height(ev, &fields, &part, extent, stated);
    good.then_some(Draft {
        part,
        grounded: ground.is_some(),
        extent,
        extent_span: stated.map(|arg| arg.expr.span),
    })
}

/// E0706: motifs of a kath are not higher than the kath is wide.
fn fits_height(
    ev: &mut Evaluator<'_>,
    fields: &Fields<'_>,
    part: &Part,
    extent: Option<f64>,
    stated: Option<Arg<'_>>,
) -> bool {
    let (Kind::Kath, Some(width), Some(stated)) = (fields.kind, extent, stated) else {
        return true;
    };
    let mut good = true;
    let repeats = fields.all("repeat").zip(&part.repeats);
    let edges = fields.all("edge").zip(&part.edges);
    for (phrase, repeat) in repeats.chain(edges) {
        let height = repeat.motif.size[1];
        if height <= width * (1.0 + 1e-9) {
            continue;
        }
        good = false;
        let share = (width / height * 100.0).floor();
        ev.tell(
            Diagnostic::new(
                "E0706",
                format!(
                    "`{}` is {} high, the border {}",
                    repeat.motif.name,
                    units::length(height),
                    units::length(width)
                ),
            )
            .at(phrase.span, "motif")
            .at(stated.expr.span, "width")
            .help(format!("scale it: `{} * {share}%`", repeat.motif.name)),
        );
    }
    good
}

/// A motif as written: `peacock`, or `peacock * 80%`.
fn motif<'t>(ev: &mut Evaluator<'t>, arg: Arg<'t>) -> Option<Motif> {
    let (name, scale) = match &arg.expr.kind {
        ExprKind::Group(inner) => return motif(ev, Arg { expr: inner, ..arg }),
        ExprKind::Binary { op: BinaryOp::Times, left, right, .. } => (&**left, Some(&**right)),
        _ => (arg.expr, None),
    };
    let id = ev.item_named(Arg { expr: name, ..arg }, Kind::Motif)?;
    let Made::Motif(made) = ev.make(id, name.span)? else { return None };
    match scale {
        Some(expr) => {
            let by = ev.within_range(Arg { expr, ..arg }, Dimension::NUMBER, 0.01, 100.0)?;
            Some(made.scaled(by))
        }
        None => Some((*made).clone()),
    }
}

/// `repeat MOTIF every LENGTH [in COLOUR] [flip]`
fn repeat<'t>(ev: &mut Evaluator<'t>, phrase: &Phrase<'t>) -> Option<Repeat> {
    let made = phrase.arg(0).and_then(|arg| motif(ev, arg));
    let pitch = phrase
        .value("every")
        .and_then(|arg| ev.within_range(arg, Dimension::LENGTH, 1e-3, LENGTHS.1));
    let colour = match phrase.value("in") {
        Some(arg) => Some(ev.colour(arg)?),
        None => None,
    };
    let made = made?;
    let made = colour.map_or(made.clone(), |colour| made.in_colour(colour));
    Some(Repeat { motif: made, pitch: pitch?, flip: phrase.says("flip") })
}

/// `stripe COLOUR LENGTH [at LENGTH]`; a stripe without a place lies on the one before.
fn stripe<'t>(
    ev: &mut Evaluator<'t>,
    phrase: &Phrase<'t>,
    stripes: &mut Vec<Stripe>,
) -> Option<()> {
    let colour = ev.colour(phrase.arg(0)?);
    let width = ev.within_range(phrase.arg(1)?, Dimension::LENGTH, 1e-4, WIDTHS.1);
    let offset = match phrase.value("at") {
        Some(arg) => ev.within_range(arg, Dimension::LENGTH, 0.0, WIDTHS.1),
        None => Some(stripes.last().map_or(0.0, |last| last.offset + last.width)),
    };
    stripes.push(Stripe { colour: colour?, offset: offset?, width: width? });
    Some(())
}

/// `spot MOTIF every LENGTH x LENGTH [half_drop] [thinning 100% -> 25% from padar]`
fn spots<'t>(ev: &mut Evaluator<'t>, phrase: &Phrase<'t>) -> Option<Spots> {
    let made = phrase.arg(0).and_then(|arg| motif(ev, arg));
    let mut pitch = [0.0; 2];
    let sides = phrase.values("every");
    for (side, arg) in pitch.iter_mut().zip(&sides) {
        *side = ev.within_range(*arg, Dimension::LENGTH, 2e-3, LENGTHS.1)?;
    }
    let thinning = match phrase.clause("thinning") {
        Some(said) => thinning(ev, phrase, said.rest, said.span)?,
        None => [1.0, 1.0],
    };
    Some(Spots { motif: made?, pitch, half_drop: phrase.says("half_drop"), thinning })
}

/// `100% -> 25% from padar`: the shares kept at the padar and at the inner end.
fn thinning<'t>(
    ev: &mut Evaluator<'t>,
    phrase: &Phrase<'t>,
    rest: &'t [Item],
    span: Span,
) -> Option<[f64; 2]> {
    let share = |ev: &mut Evaluator<'t>, expr: &'t Expr| {
        let arg = Arg { expr, scope: phrase.scope, of: "thinning" };
        ev.within_range(arg, Dimension::NUMBER, 0.0, 1.0)
    };
    let word = |expr: &Expr| bare(expr).map(|name| name.text.clone()).unwrap_or_default();
    let shares = match rest {
        [Item::Expr(near), Item::Arrow(_), Item::Expr(far), more @ ..] => {
            let shares = [share(ev, near)?, share(ev, far)?];
            match more {
                [] => return Some(shares),
                [Item::Expr(from), Item::Expr(place)]
                    if word(from) == "from" && word(place) == "padar" =>
                {
                    return Some(shares);
                }
                _ => None,
            }
        }
        _ => None,
    };
    let unread =
        rest.iter().any(|item| matches!(item, Item::Expr(Expr { kind: ExprKind::Unread, .. })));
    if shares.is_none() && !unread {
        let at = rest.last().map_or(span, |last| match last {
            Item::Expr(expr) => span.to(expr.span),
            _ => span,
        });
        ev.tell(
            Diagnostic::new("E0203", "`thinning` is written in another way").at(at, "here").help(
                "`thinning 100% -> 25% from padar`: shares kept at the padar and at the inner end",
            ),
        );
    }
    shares
}

/// `bands: gold 2cm, lotus 14cm, …`
fn bands<'t>(ev: &mut Evaluator<'t>, fields: &Fields<'t>) -> Option<Vec<Band>> {
    let Some(phrase) = fields.get("bands").cloned() else { return Some(Vec::new()) };
    if fields.kind != Kind::Padar {
        ev.tell(
            Diagnostic::new("E0207", format!("{} has no bands", fields.kind.title()))
                .at(phrase.span, "here")
                .help("bands go across a padar; along a kath run stripes"),
        );
        return None;
    }
    let mut found = Vec::new();
    for group in phrase.rest.split(|item| matches!(item, Item::Comma(_))) {
        let [Item::Expr(fill), Item::Expr(length)] = group else {
            let unread = group
                .iter()
                .any(|item| matches!(item, Item::Expr(Expr { kind: ExprKind::Unread, .. })));
            if !unread {
                let at = match group.first() {
                    Some(Item::Expr(expr)) => expr.span,
                    _ => phrase.span,
                };
                ev.tell(
                    Diagnostic::new("E0306", "a band is a colour or a motif and a length")
                        .at(at, "here")
                        .help("such as `bands: gold 2cm, lotus 14cm`"),
                );
            }
            return None;
        };
        let length = Arg { expr: length, scope: phrase.scope, of: "bands" };
        let length = ev.within_range(length, Dimension::LENGTH, 1e-4, LENGTHS.1);
        let fill = band_fill(ev, Arg { expr: fill, scope: phrase.scope, of: "bands" });
        found.push(Band { fill: fill?, length: length? });
    }
    let stated = ev.required(fields, "length")?.arg(0)?;
    let whole = ev.quantity(stated, Dimension::LENGTH)?;
    let sum: f64 = found.iter().map(|band| band.length).sum();
    if (sum - whole).abs() > 5e-4 {
        ev.tell(
            Diagnostic::new(
                "E0702",
                format!(
                    "the bands make {}, the padar is {}",
                    units::length(sum),
                    units::length(whole)
                ),
            )
            .at(phrase.span, units::length(sum))
            .at(stated.expr.span, units::length(whole))
            .help("bands fill the padar from its field side to its end"),
        );
        return None;
    }
    Some(found)
}

/// A motif, a yarn or a colour.
fn band_fill<'t>(ev: &mut Evaluator<'t>, arg: Arg<'t>) -> Option<BandFill> {
    let colour_first = match bare(arg.expr) {
        Some(name) => !ev.knows_item(arg.scope, &name.text, Kind::Motif),
        None => !matches!(arg.expr.kind, ExprKind::Binary { .. } | ExprKind::Group(_)),
    };
    if colour_first {
        ev.colour(arg).map(BandFill::Colour)
    } else {
        motif(ev, arg).map(BandFill::Motif)
    }
}

impl<'t> Evaluator<'t> {
    /// Whether a name stands for an item of the kind, own or of the library, without asking
    /// what it is worth.
    fn knows_item(&mut self, scope: super::scope::ScopeId, name: &str, kind: Kind) -> bool {
        let own = self.find(scope, name);
        let of_library = || {
            let library = self.libraries.get(*kind.libraries().first()?)?;
            self.scopes.get(library.0)?.names.get(name).copied()
        };
        let Some(found) = own.or_else(of_library) else { return false };
        let span = self.bindings.get(found.0).map(|binding| binding.span).unwrap_or_default();
        match self.binding_value(found, span) {
            super::value::Value::Item(id) => self.item(id).kind == kind,
            _ => false,
        }
    }

    /// The part that a line of a sari's block writes, as an item of its own.
    fn inner_part(&mut self, phrase: &Phrase<'t>, kind: Kind, name: &str) -> Option<Rc<Draft>> {
        let id = ItemId(self.items.len());
        self.items.push(Declared {
            kind,
            name: name.to_owned(),
            span: phrase.key.span,
            phrase: phrase.clone(),
            scope: phrase.scope,
            made: State::Pending,
        });
        match self.make(id, phrase.span)? {
            Made::Part(draft) => Some(draft),
            _ => None,
        }
    }

    /// The fabric of a sari: its own, or that of the sari it copies.
    fn fabric_of_sari(&mut self, id: ItemId, depth: usize) -> Option<ItemId> {
        let phrase = self.item(id).phrase.clone();
        if let Some(arg) = phrase.value("of") {
            return self.item_named(arg, Kind::Fabric);
        }
        if let Some(arg) = phrase.value("=").filter(|_| depth < 64) {
            let base = self.item_named(arg, Kind::Sari)?;
            return self.fabric_of_sari(base, depth + 1);
        }
        let name = self.item(id).name.clone();
        self.tell(
            Diagnostic::new("E0208", format!("sari `{name}` must be given its fabric"))
                .at(phrase.span, "missing here")
                .help(format!("`sari {name} of silk {{ … }}`")),
        );
        None
    }
}

/// A sari and the item of its fabric.
pub(super) fn sari(ev: &mut Evaluator<'_>, id: ItemId) -> Option<(Sari, ItemId)> {
    let fields = ev.open_item(id)?;
    let cloth = ev.fabric_of_sari(id, 0);
    let size = ev.required(&fields, "size").cloned().and_then(|size| {
        let length =
            size.arg(0).map(|arg| ev.within_range(arg, Dimension::LENGTH, LENGTHS.0, LENGTHS.1));
        let width =
            size.arg(1).map(|arg| ev.within_range(arg, Dimension::LENGTH, WIDTHS.0, WIDTHS.1));
        Some((length??, width??))
    });
    let said = Said::of(ev, &fields)?;
    let layout = said.layout(ev, &fields);
    let ang = said.ang.as_ref().and_then(|at| ev.inner_part(at, Kind::Ang, "ang"));
    let lower = inner(ev, said.lower.as_ref(), Kind::Kath, "lower kath");
    let upper = inner(ev, said.upper.as_ref(), Kind::Kath, "upper kath");
    let padar = inner(ev, said.padar.as_ref(), Kind::Padar, "padar");
    layout?;
    let (cloth, (length, width)) = (cloth?, size?);
    let (ang, lower, upper, padar) = (ang?, lower?, upper?, padar?);
    let fabric = ev.fabric(cloth, fields.span)?;
    let (warp, shot) = match &fabric.structure {
        crate::textile::fabric::Structure::Woven { warp, weft, .. } => {
            (warp.colour, (warp.colour != weft.colour).then_some(weft.colour))
        }
        crate::textile::fabric::Structure::Knitted { yarn, .. } => (yarn.colour, None),
    };
    let mut field = ang.part.clone();
    if !ang.grounded {
        field.ground = warp;
        field.shot = field.shot.or(shot);
    }
    let lower = lower.map(|draft| on_ground(&draft, field.ground));
    let upper = upper.map(|draft| on_ground(&draft, field.ground));
    let padar = padar.map(|draft| on_ground(&draft, field.ground));
    let borders = lower.as_ref().map_or(0.0, |it| it.1) + upper.as_ref().map_or(0.0, |it| it.1);
    let end = padar.as_ref().map_or(0.0, |it| it.1);
    if borders >= width || end >= length {
        let (what, least) = if end >= length { ("padar", length) } else { ("borders", width) };
        let have = if end >= length { end } else { borders };
        ev.tell(
            Diagnostic::new(
                "E0303",
                format!(
                    "the {what} take {} of {}; nothing is left for the ang",
                    units::length(have),
                    units::length(least)
                ),
            )
            .at(fields.span, "this sari"),
        );
        return None;
    }
    let mut sari = Sari {
        name: ev.item(id).name.clone(),
        length,
        width,
        ang: field,
        lower_kath: lower,
        upper_kath: upper,
        padar,
    };
    even_pitches(&mut sari);
    count_figures(ev, &fields, &sari)?;
    Some((sari, cloth))
}

/// A part that may be absent: none where it is wrong, `Some(None)` where it is not there.
fn inner<'t>(
    ev: &mut Evaluator<'t>,
    at: Option<&Phrase<'t>>,
    kind: Kind,
    name: &str,
) -> Option<Option<Rc<Draft>>> {
    let Some(phrase) = at else { return Some(None) };
    let draft = ev.inner_part(phrase, kind, name)?;
    if draft.extent.is_none() {
        let word = if kind == Kind::Kath { "width" } else { "length" };
        ev.tell(
            Diagnostic::new("E0208", format!("{name} must be given `{word}`"))
                .at(phrase.span, "missing here")
                .help(format!("such as `{word}: 10cm`")),
        );
        return None;
    }
    Some(Some(draft))
}

fn on_ground(draft: &Draft, ground: Colour) -> (Part, f64) {
    let mut part = draft.part.clone();
    if !draft.grounded {
        part.ground = ground;
    }
    (part, draft.extent.unwrap_or(0.0))
}

/// The lines of a sari's block that write its parts.
struct Said<'t> {
    ang: Option<Phrase<'t>>,
    lower: Option<Phrase<'t>>,
    upper: Option<Phrase<'t>>,
    padar: Option<Phrase<'t>>,
}

impl<'t> Said<'t> {
    /// Finds them; a part that is written twice is told.
    fn of(ev: &mut Evaluator<'t>, fields: &Fields<'t>) -> Option<Said<'t>> {
        let mut said = Said { ang: None, lower: None, upper: None, padar: None };
        for phrase in &fields.phrases {
            let place = match (phrase.word.name, phrase.choice(0)) {
                ("ang", _) => &mut said.ang,
                ("padar", _) => &mut said.padar,
                ("kath", Some("upper")) => &mut said.upper,
                ("kath", _) => &mut said.lower,
                _ => continue,
            };
            if let Some(first) = place {
                ev.tell(
                    Diagnostic::new("E0209", "this part is written twice")
                        .at(phrase.span, "here")
                        .at(first.span, "and here")
                        .help("keep one"),
                );
                return None;
            }
            *place = Some(phrase.clone());
        }
        Some(said)
    }

    /// E0701: the six layouts are ang alone, with a lower kath, with both, each with or without
    /// a padar (Athale 2004, section 6.1).
    fn layout(&self, ev: &mut Evaluator<'t>, fields: &Fields<'t>) -> Option<()> {
        if ["ang", "kath", "padar"].into_iter().any(|word| fields.spoils(word)) {
            return None;
        }
        const HELP: &str = "the six layouts are ang, ang + lower kath, ang + lower + upper kath, \
                            each with or without padar";
        if self.ang.is_none() {
            ev.tell(
                Diagnostic::new("E0701", format!("{} has no ang", fields.title))
                    .at(fields.span, "missing here")
                    .help(HELP),
            );
            return None;
        }
        if let (Some(upper), None) = (&self.upper, &self.lower) {
            ev.tell(
                Diagnostic::new("E0701", "an upper kath needs a lower one")
                    .at(upper.span, "upper")
                    .help(HELP),
            );
            return None;
        }
        Some(())
    }
}

/// Lets every row of motifs divide its part's length evenly, by the pitch nearest to the one
/// that is asked for. Along a padar the rows run across the sari, between the borders.
fn even_pitches(sari: &mut Sari) {
    let end = sari.padar.as_ref().map_or(0.0, |(_, length)| *length);
    let (length, field) = (sari.length, sari.length - end);
    let even = |part: &mut Part, along: f64| {
        for repeat in part.repeats.iter_mut().chain(&mut part.edges) {
            repeat.pitch = along / (along / repeat.pitch).round().max(1.0);
        }
    };
    even(&mut sari.ang, field);
    for (part, _) in [&mut sari.lower_kath, &mut sari.upper_kath].into_iter().flatten() {
        even(part, length);
    }
    if let Some((part, own)) = &mut sari.padar {
        even(part, *own);
    }
}

/// Figures are counted, so that no text asks for millions of them.
fn count_figures(ev: &mut Evaluator<'_>, fields: &Fields<'_>, sari: &Sari) -> Option<()> {
    let parts = [Some(&sari.ang)]
        .into_iter()
        .chain(
            [&sari.lower_kath, &sari.upper_kath, &sari.padar]
                .map(|it| it.as_ref().map(|(part, _)| part)),
        )
        .flatten();
    for part in parts {
        let rows = part.repeats.iter().chain(&part.edges).map(|row| sari.length / row.pitch);
        let spots = part
            .spots
            .iter()
            .map(|spots| sari.length * sari.width / (spots.pitch[0] * spots.pitch[1]));
        let count: f64 = rows.chain(spots).sum();
        if count > MOST {
            ev.tell(
                Diagnostic::new(
                    "E0303",
                    format!("`{}` would hold {} figures", part.name, units::trimmed(count, 0)),
                )
                .at(fields.span, "this sari")
                .help(format!("at most {MOST} are drawn; set them further apart")),
            );
            return None;
        }
    }
    Some(())
}
