//! Motifs: by picture, by paths, from an image, made of others.

use super::chart::{self, Keys};
use crate::diagnostic::{Diagnostic, Span};
use crate::evaluate::Evaluator;
use crate::evaluate::fields::{Arg, Fields, Phrase, bare};
use crate::evaluate::item::{ItemId, Made};
use crate::evaluate::words::Kind;
use crate::syntax::tree::{Expr, ExprKind, Item};
use crate::textile::Colour;
use crate::textile::fabric::Structure;
use crate::textile::motif::Motif;
use crate::textile::motif::image;
use crate::textile::motif::raster::{self, FillRule};
use crate::textile::motif::tile::{self, Repeat};
use crate::units::Dimension;
use kurbo::Rect;

/// The words that say what a motif is; a motif has one of them, of paths any number.
const WAYS: [&str; 5] = ["picture", "path", "image", "of", "border"];
/// What goes with which of them.
const COMPANIONS: [(&str, &[&str]); 9] = [
    ("legend", &["picture"]),
    ("size", &["picture", "path", "image"]),
    ("threads", &["path", "image"]),
    ("on", &["path", "image"]),
    ("frame", &["path"]),
    ("colors", &["image"]),
    ("ground", &["image"]),
    ("repeat", &["of"]),
    ("times", &["of", "border"]),
];
/// Columns or rows of a motif.
const LARGEST: usize = 4_096;
/// Cells that count as one step of evaluation.
const CELLS: usize = 8;

type Rows = Vec<Vec<Option<Colour>>>;

/// A motif.
pub(in crate::evaluate) fn motif(ev: &mut Evaluator<'_>, id: ItemId) -> Option<Motif> {
    let fields = ev.open_item(id)?;
    let way = way(ev, &fields)?;
    for (word, of) in COMPANIONS {
        if let Some(phrase) = fields.get(word).filter(|_| !of.contains(&way.word.name)) {
            let message = format!("`{word}` does not go with `{}`", way.word.name);
            let help = format!("it belongs to {}", crate::diagnostic::either(of));
            ev.tell(Diagnostic::new("E0207", message).at(phrase.span, "here").help(help));
            return None;
        }
    }
    let name = ev.item(id).name.clone();
    let made = match way.word.name {
        "of" | "border" => return made_of(ev, &fields, &way, name),
        "picture" => {
            let rows = drawn(ev, &fields, &way);
            let size = size(ev, &fields);
            rows.zip(size)
        }
        way_word => {
            let size = size(ev, &fields)?;
            let cells = threads(ev, &fields, size)?;
            if !ev.step((cells[0] * cells[1] / CELLS) as u64, way.span) {
                return None;
            }
            let rows = match way_word {
                "path" => of_paths(ev, &fields, size, cells),
                _ => of_image(ev, &fields, &way, cells),
            };
            rows.map(|rows| (rows, size))
        }
    };
    let (rows, size) = made?;
    if rows.iter().flatten().all(Option::is_none) {
        ev.tell(
            Diagnostic::new("W0605", format!("{} shows nothing but ground", fields.title))
                .at(fields.span, "here"),
        );
    }
    Some(Motif { name, rows, size })
}

/// The line that says what it is.
fn way<'t>(ev: &mut Evaluator<'t>, fields: &Fields<'t>) -> Option<Phrase<'t>> {
    let said = fields.phrases.iter().filter(|phrase| WAYS.contains(&phrase.word.name));
    let mut said = said.cloned();
    let Some(first) = said.next() else {
        ev.required(fields, "picture");
        return None;
    };
    if let Some(second) = said.find(|it| it.word.name != "path" || first.word.name != "path") {
        ev.tell(
            Diagnostic::new("E0209", format!("{} is drawn in two ways", fields.title))
                .at(second.span, "here")
                .at(first.span, "and here")
                .help("keep one"),
        );
        return None;
    }
    Some(first)
}

fn size<'t>(ev: &mut Evaluator<'t>, fields: &Fields<'t>) -> Option<[f64; 2]> {
    let size = ev.required(fields, "size").cloned()?;
    let mut side =
        |n| size.arg(n).and_then(|arg| ev.within_range(arg, Dimension::LENGTH, 1e-4, 5.0));
    let (width, height) = (side(0), side(1));
    Some([width?, height?])
}

/// `picture:` with its legend.
fn drawn<'t>(ev: &mut Evaluator<'t>, fields: &Fields<'t>, way: &Phrase<'t>) -> Option<Rows> {
    let mut keys: Keys<Option<Colour>> = Keys::new(&[(".", None)]);
    let mut good = true;
    for line in chart::legend(ev, fields) {
        let cell = match line.rest {
            [Item::Expr(expr)] => match bare(expr).map(|name| name.text.as_str()) {
                Some("none") => Some(None),
                _ => ev.colour(Arg { expr, scope: line.scope, of: "legend" }).map(Some),
            },
            [Item::Expr(Expr { kind: ExprKind::Unread, .. }), ..] => None,
            _ => {
                chart::unknown_meaning(ev, &line, &["none", "a colour", "a yarn"]);
                None
            }
        };
        match cell {
            Some(cell) => keys.set(&line.key.text, cell),
            None => {
                // The key is known all the same; its colour has been told of.
                good = false;
                keys.set(&line.key.text, None);
            }
        }
    }
    let known = "`.` is the ground; name the other signs in the legend: \
                 `legend { \"*\": gold }`";
    chart::cells(ev, way, &keys, known).filter(|_| good)
}

/// Columns and rows: as many threads as are said, or as the cloth has.
fn threads<'t>(ev: &mut Evaluator<'t>, fields: &Fields<'t>, size: [f64; 2]) -> Option<[usize; 2]> {
    if let Some(said) = fields.get("threads").cloned() {
        if let Some(on) = fields.get("on") {
            ev.tell(
                Diagnostic::new("E0209", "the threads are counted in two ways")
                    .at(on.span, "here")
                    .at(said.span, "and here")
                    .help("keep one"),
            );
            return None;
        }
        let mut side = |n| ev.whole_number(said.arg(n)?, 1, LARGEST as i64).map(|it| it as usize);
        let (columns, rows) = (side(0), side(1));
        return Some([columns?, rows?]);
    }
    let Some(on) = fields.get("on").cloned() else {
        if !fields.spoils("threads") && !fields.spoils("on") {
            ev.tell(
                Diagnostic::new("E0208", format!("{} must say its threads", fields.title))
                    .at(fields.span, "missing here")
                    .help("`on: silk`, the cloth it is for, or `threads: 48 x 40`, columns x rows"),
            );
        }
        return None;
    };
    let arg = on.arg(0)?;
    let id = ev.item_named(arg, Kind::Fabric)?;
    let Made::Fabric(fabric, _) = ev.make(id, arg.expr.span)? else { return None };
    let pitch = match &fabric.structure {
        Structure::Woven { warp, weft, .. } => [warp.spacing, weft.spacing],
        Structure::Knitted { knit, .. } => [1.0 / knit.wales, 1.0 / knit.courses],
    };
    let cells = [0, 1].map(|axis| (size[axis] / pitch[axis]).round().max(1.0));
    if cells.iter().any(|count| !(*count <= LARGEST as f64)) {
        let message = format!("{} by {} threads are too many", cells[0], cells[1]);
        let told = Diagnostic::new("E0303", message).at(on.span, "here");
        ev.tell(told.help(format!("a motif has at most {LARGEST} columns and rows")));
        return None;
    }
    Some(cells.map(|count| count as usize))
}

/// `path "M0 0 …" gold evenodd` lines; later ones lie on top.
fn of_paths<'t>(
    ev: &mut Evaluator<'t>,
    fields: &Fields<'t>,
    size: [f64; 2],
    cells: [usize; 2],
) -> Option<Rows> {
    let mut paths = Vec::new();
    let mut layers = Vec::new();
    let mut good = true;
    let lines: Vec<Phrase<'t>> = fields.all("path").cloned().collect();
    for line in &lines {
        let colour = line.arg(1).and_then(|arg| ev.colour(arg));
        let data = line.arg(0).and_then(|arg| text(ev, arg, "the data of an SVG path"));
        let (Some(colour), Some((data, at))) = (colour, data) else {
            good = false;
            continue;
        };
        let rule = if line.says("evenodd") { FillRule::EvenOdd } else { FillRule::NonZero };
        match raster::path(data) {
            Ok(path) => {
                paths.push(path);
                layers.push((colour, rule, at));
            }
            Err(why) => {
                good = false;
                unreadable(ev, at, &why);
            }
        }
    }
    let frame = match fields.get("frame").cloned() {
        Some(said) => {
            let mut side = |n| ev.positive(said.arg(n)?, Dimension::NUMBER);
            let (width, height) = (side(0), side(1));
            Rect::new(0.0, 0.0, width?, height?)
        }
        None => raster::bounds(&paths),
    };
    if !good {
        return None;
    }
    let mut rows: Rows = vec![vec![None; cells[0]]; cells[1]];
    let Some(place) = raster::fitted(frame, size, cells) else {
        let at = layers.first().map_or(fields.span, |layer| layer.2);
        unreadable(ev, at, "it encloses nothing");
        return None;
    };
    for (path, (colour, rule, at)) in paths.into_iter().zip(layers) {
        let weight = path.elements().len().saturating_mul(cells[1]) / CELLS;
        if !ev.step(weight as u64, at) {
            return None;
        }
        match raster::raster(&(place * path), cells, rule) {
            Ok(inside) => {
                for (row, inside) in rows.iter_mut().zip(inside) {
                    for (cell, _) in row.iter_mut().zip(inside).filter(|(_, inside)| *inside) {
                        *cell = Some(colour);
                    }
                }
            }
            Err(why) => {
                unreadable(ev, at, why);
                return None;
            }
        }
    }
    Some(rows)
}

fn unreadable(ev: &mut Evaluator<'_>, at: Span, why: &str) {
    ev.tell(
        Diagnostic::new("E0608", format!("the path cannot be drawn: {why}"))
            .at(at, "here")
            .help("the data of an SVG path, such as `\"M0 10 L20 10 L10 0 Z\"`"),
    );
}

/// A text in quotation marks, and its place.
fn text<'t>(ev: &mut Evaluator<'t>, arg: Arg<'t>, what: &str) -> Option<(&'t str, Span)> {
    match &arg.expr.kind {
        ExprKind::Text(text) => Some((text, arg.expr.span)),
        ExprKind::Unread => None,
        _ => {
            let told = Diagnostic::new("E0304", format!("`{}` wants {what}", arg.of))
                .at(arg.expr.span, "not a text in quotation marks");
            ev.tell(told);
            None
        }
    }
}

/// `image "rose.png"` in the colours of its yarns.
fn of_image<'t>(
    ev: &mut Evaluator<'t>,
    fields: &Fields<'t>,
    way: &Phrase<'t>,
    cells: [usize; 2],
) -> Option<Rows> {
    let colours = ev.required(fields, "colors").cloned()?;
    let mut yarns = Vec::new();
    for arg in colours.args() {
        yarns.push(ev.colour(arg)?);
    }
    let ground = match fields.value("ground") {
        Some(arg) => Some(ev.colour(arg)?),
        None => None,
    };
    let bytes = ev.picture_of(way)?;
    match image::decoded(&bytes) {
        Ok(picture) => {
            let [width, height] = picture.size();
            let worked = ev.step((width * height / CELLS) as u64, way.span);
            worked.then(|| picture.quantised(cells, &yarns, ground))
        }
        Err(why) => {
            ev.tell(
                Diagnostic::new("E0609", format!("the picture cannot be read: {why}"))
                    .at(way.span, "here")
                    .help("PNG and PNM pictures are read, up to 4096 pixels across and down"),
            );
            None
        }
    }
}

/// `of:` a motif that is repeated, or `border:` one that goes round a frame.
fn made_of<'t>(
    ev: &mut Evaluator<'t>,
    fields: &Fields<'t>,
    way: &Phrase<'t>,
    name: String,
) -> Option<Motif> {
    let arg = way.arg(0)?;
    let id = ev.item_named(arg, Kind::Motif)?;
    let Made::Motif(part) = ev.make(id, arg.expr.span)? else { return None };
    let times = match fields.get("times").cloned() {
        Some(said) => {
            let mut side =
                |n| ev.whole_number(said.arg(n)?, 1, LARGEST as i64).map(|it| it as usize);
            let (across, up) = (side(0), side(1));
            [across?, up?]
        }
        None => [2, 2],
    };
    let [across, up] = times;
    let border = way.word.name == "border";
    let cells = match border {
        true => {
            let corner = 2 * part.height();
            [across * part.width() + corner, up * part.width() + corner]
        }
        false => [across * part.width(), up * part.height()],
    };
    if cells.iter().any(|count| *count > LARGEST || *count == 0) {
        let [columns, rows] = cells;
        let message = format!("{columns} columns and {rows} rows are too many");
        let told = Diagnostic::new("E0601", message).at(way.span, "here");
        ev.tell(told.help(format!("a motif has at most {LARGEST} columns and rows")));
        return None;
    }
    if !ev.step((cells[0] * cells[1] / CELLS) as u64, way.span) {
        return None;
    }
    let repeat = match fields.get("repeat").and_then(|phrase| phrase.choice(0)) {
        Some("half_drop") => Repeat::HalfDrop,
        Some("mirrored") => Repeat::Mirrored,
        Some("rotated") => Repeat::Rotated,
        _ => Repeat::Straight,
    };
    let made = match border {
        true => tile::framed(&part, across, up),
        false => tile::repeated(&part, repeat, across, up),
    };
    Some(Motif { name, ..made })
}
