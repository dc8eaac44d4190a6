//! Tables of sizes, bodies and wearers, from their blocks.

use super::Evaluator;
use super::fields::{Fields, Phrase};
use super::item::{ItemId, Made};
use super::words::Kind;
use crate::diagnostic::{Diagnostic, Span};
use crate::garment::scene::{BodyRequest, Figure};
use crate::syntax::tree::{Expr, ExprKind, Item};
use crate::units::Dimension;
use std::collections::BTreeMap;

/// A table of sizes.
#[derive(Clone, Debug, PartialEq)]
pub struct Sizes {
    /// What the columns are.
    pub measures: Vec<String>,
    /// Sizes by name, with a length for each column, m.
    pub rows: Vec<(String, Vec<f64>)>,
}

/// A figure with its measures.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// The figure it starts from.
    pub figure: Figure,
    /// Measures by name, m.
    pub measures: BTreeMap<String, f64>,
    /// The table in which its sizes stand.
    pub sizes: Option<ItemId>,
}

/// Columns a table of sizes may have, and rows.
const LARGEST: usize = 1_000;

/// A measure may lie between these, m; what a body can really be is for the body to say.
const MEASURES: (f64, f64) = (0.001, 5.0);

/// A table of sizes.
pub(super) fn sizes(ev: &mut Evaluator<'_>, id: ItemId) -> Option<Sizes> {
    let fields = ev.open_item(id)?;
    let columns = ev.required(&fields, "measures")?.clone();
    let mut measures: Vec<String> = Vec::new();
    for arg in columns.args().into_iter().take(LARGEST) {
        let name = ev.name_of(arg)?;
        if measures.contains(&name.text) {
            ev.tell(
                Diagnostic::new("E0209", format!("`{}` is said twice", name.text))
                    .at(name.span, "here"),
            );
            return None;
        }
        measures.push(name.text.clone());
    }
    let mut rows: Vec<(String, Vec<f64>)> = Vec::new();
    let mut good = true;
    let lines: Vec<Phrase<'_>> = fields.rows().take(LARGEST).cloned().collect();
    for line in &lines {
        let name = one_spaced(&line.key.text);
        if rows.iter().any(|(other, _)| *other == name) {
            ev.tell(
                Diagnostic::new("E0209", format!("size `{name}` is said twice"))
                    .at(line.key.span, "here"),
            );
            good = false;
            continue;
        }
        let args = line.args();
        if args.len() != measures.len() {
            ev.tell(
                Diagnostic::new(
                    "E0306",
                    format!(
                        "`{name}` has {} values, `measures` names {}",
                        args.len(),
                        measures.len()
                    ),
                )
                .at(line.span, format!("{} values", args.len()))
                .at(columns.span, format!("{} measures", measures.len())),
            );
            good = false;
            continue;
        }
        let mut values = Vec::with_capacity(args.len());
        for arg in args {
            match ev.within_range(arg, Dimension::LENGTH, MEASURES.0, MEASURES.1) {
                Some(value) => values.push(value),
                None => good = false,
            }
        }
        rows.push((name, values));
    }
    if rows.is_empty() && good {
        ev.tell(
            Diagnostic::new("E0208", format!("{} has no sizes", fields.title))
                .at(fields.span, "rows are missing here")
                .help("such as `\"EU 38\": 88cm, 72cm, 97cm`"),
        );
        return None;
    }
    good.then_some(Sizes { measures, rows })
}

/// A body.
pub(super) fn body(ev: &mut Evaluator<'_>, id: ItemId) -> Option<Body> {
    let fields = ev.open_item(id)?;
    let figure = match ev.required(&fields, "figure")?.choice(0) {
        Some("male") => Figure::Male,
        _ => Figure::Female,
    };
    let table = match fields.value("sizes") {
        Some(arg) => Some(ev.item_named(arg, Kind::Sizes)?),
        None => None,
    };
    let mut measures = BTreeMap::new();
    if let Some(phrase) = fields.get("size").cloned() {
        measures.extend(size(ev, &fields, &phrase, table)?);
    }
    let own = own_measures(ev, &fields, None)?;
    measures.extend(own);
    Some(Body { figure, measures, sizes: table })
}

/// A wearer: a body with a size and single measures set.
pub(super) fn wearer(ev: &mut Evaluator<'_>, id: ItemId) -> Option<BodyRequest> {
    let phrase = ev.item(id).phrase.clone();
    let arg = phrase.value("=")?;
    let base = ev.item_named(arg, Kind::Body)?;
    let Made::Body(body) = ev.make(base, arg.expr.span)? else { return None };
    let fields = ev.open_item(id)?;
    // A block that no part uses is nobody's in particular.
    let asked = match ev.size.zip(body.sizes).filter(|_| !ev.is_lone(fields.scope)) {
        Some((asked, table)) => {
            Some(row(ev, table, asked, (phrase.span, "another size is asked for"))?)
        }
        None => None,
    };
    // Where a size or a measure is wrong, the body's own serve to look for further mistakes.
    let mut measures = body.measures.clone();
    if let Some(phrase) = fields.get("size").cloned() {
        measures.extend(size(ev, &fields, &phrase, body.sizes).unwrap_or_default());
    }
    let known: Vec<String> = measures.keys().cloned().collect();
    let body_name = ev.item(base).name.clone();
    let own = own_measures(ev, &fields, Some((&body_name, &known)));
    measures.extend(own.unwrap_or_default());
    if let Some(asked) = asked {
        // Another size is another person: the measures of the one in the text do not count.
        measures = body.measures.clone();
        measures.extend(asked);
    }
    if measures.is_empty() {
        return None;
    }
    let item = ev.item(id);
    Some(BodyRequest { name: item.name.clone(), span: item.span, figure: body.figure, measures })
}

/// The measures that a block sets by name. Where the body is known, it must have them.
fn own_measures<'t>(
    ev: &mut Evaluator<'t>,
    fields: &Fields<'t>,
    known: Option<(&str, &[String])>,
) -> Option<BTreeMap<String, f64>> {
    let mut measures = BTreeMap::new();
    let mut good = true;
    let lines: Vec<Phrase<'t>> = fields.rows().cloned().collect();
    for line in &lines {
        let name = &line.key.text;
        if let Some((body, known)) = known
            && !known.is_empty()
            && !known.contains(name)
        {
            let twin = match name.as_str() {
                "chest" => Some("bust"),
                "bust" => Some("chest"),
                _ => None,
            };
            let label = match twin.filter(|twin| known.iter().any(|known| known == twin)) {
                Some(twin) => format!("did you mean `{twin}`?"),
                None => ev.meant(name, known.iter().map(String::as_str)),
            };
            ev.tell(
                Diagnostic::new("E0204", format!("`{body}` has no measure `{name}`"))
                    .at(line.key.span, label)
                    .help(format!("its measures are {}", known.join(", "))),
            );
            good = false;
            continue;
        }
        let value = line
            .arg(0)
            .and_then(|arg| ev.within_range(arg, Dimension::LENGTH, MEASURES.0, MEASURES.1));
        match value {
            Some(value) => {
                measures.insert(name.clone(), value);
            }
            None => good = false,
        }
    }
    good.then_some(measures)
}

/// The measures of a size: `size: EU 38`.
fn size<'t>(
    ev: &mut Evaluator<'t>,
    fields: &Fields<'t>,
    phrase: &Phrase<'t>,
    table: Option<ItemId>,
) -> Option<BTreeMap<String, f64>> {
    let wanted = match phrase.rest {
        [Item::Expr(expr)] => match &expr.kind {
            ExprKind::Unread => return None,
            ExprKind::Text(text) => one_spaced(text),
            _ => one_spaced(ev.snippet(expr.span)),
        },
        [Item::Expr(first), .., Item::Expr(last)] => {
            if matches!(last.kind, ExprKind::Unread) {
                return None;
            }
            one_spaced(ev.snippet(first.span.to(last.span)))
        }
        _ => String::new(),
    };
    if wanted.is_empty() {
        ev.tell(
            Diagnostic::new("E0208", "`size` must be given a size")
                .at(phrase.span, "missing here")
                .help("such as `size: EU 38`"),
        );
        return None;
    }
    let Some(table) = table else {
        ev.tell(
            Diagnostic::new("E0305", format!("{} has no table of sizes", fields.title))
                .at(phrase.span, "so it has no size")
                .help("`sizes: NAME` in its body names one"),
        );
        return None;
    };
    row(ev, table, &wanted, (phrase.span, "here"))
}

/// The measures of a size in a table.
fn row(
    ev: &mut Evaluator<'_>,
    table: ItemId,
    wanted: &str,
    (at, label): (Span, &str),
) -> Option<BTreeMap<String, f64>> {
    let Made::Sizes(sizes) = ev.make(table, at)? else { return None };
    let wanted = one_spaced(wanted);
    let Some((_, values)) = sizes.rows.iter().find(|(name, _)| *name == wanted) else {
        let names: Vec<&str> = sizes.rows.iter().map(|(name, _)| name.as_str()).collect();
        let title = ev.item(table).name.clone();
        ev.tell(
            Diagnostic::new("E0305", format!("there is no size `{wanted}` in `{title}`"))
                .at(at, label)
                .help(format!("there are {}", names.join(", "))),
        );
        return None;
    };
    Some(sizes.measures.iter().cloned().zip(values.iter().copied()).collect())
}

impl<'t> Evaluator<'t> {
    /// The sizes for which a garment is drawn: `grade: EU 34, EU 36`, or `all` of the table.
    pub(super) fn grade(&mut self, fields: &Fields<'t>) -> Vec<String> {
        let Some(phrase) = fields.get("grade").cloned() else { return Vec::new() };
        let wearer = fields.all("wearer").find_map(|phrase| phrase.item);
        let base = wearer.and_then(|id| self.item(id).phrase.value("="));
        let Some(base) = base.and_then(|arg| self.item_named(arg, Kind::Body)) else {
            if wearer.is_none() && !fields.spoils("wearer") {
                self.tell(
                    Diagnostic::new("E0208", "`grade` wants a wearer whose sizes they are")
                        .at(phrase.span, "here")
                        .help("such as `wearer lady = female { size: EU 38 }`"),
                );
            }
            return Vec::new();
        };
        let Some(Made::Body(body)) = self.make(base, phrase.span) else { return Vec::new() };
        let Some(table) = body.sizes else {
            let name = self.item(base).name.clone();
            self.tell(
                Diagnostic::new("E0305", format!("`{name}` has no table of sizes"))
                    .at(phrase.span, "so it has none of these")
                    .help("`sizes: NAME` in the body names one"),
            );
            return Vec::new();
        };
        let Some(Made::Sizes(sizes)) = self.make(table, phrase.span) else { return Vec::new() };
        let mut wanted: Vec<String> = Vec::new();
        for item in phrase.rest.split(|item| matches!(item, Item::Comma(_))) {
            let (Some(first), Some(last)) = (item.first(), item.last()) else { continue };
            let span = first.span().to(last.span());
            let name = match first {
                Item::Expr(Expr { kind: ExprKind::Unread, .. }) => continue,
                Item::Expr(Expr { kind: ExprKind::Text(text), .. }) => one_spaced(text),
                _ => one_spaced(self.snippet(span)),
            };
            if name == "all" {
                wanted.extend(sizes.rows.iter().map(|(name, _)| name.clone()));
            } else if row(self, table, &name, (span, "here")).is_some() {
                wanted.push(name);
            }
        }
        let mut seen = std::collections::BTreeSet::new();
        wanted.retain(|name| seen.insert(name.clone()));
        wanted
    }
}

/// Words with one blank between them.
fn one_spaced(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
