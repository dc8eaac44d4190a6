//! Knits: by chart, in words, from a file, of a motif.

use super::chart::{self, Keys};
use super::weave::quotients;
use crate::diagnostic::{Diagnostic, Span};
use crate::evaluate::Evaluator;
use crate::evaluate::fields::{Arg, Fields, Phrase, bare};
use crate::evaluate::item::{ItemId, Made};
use crate::evaluate::poison::unread;
use crate::evaluate::words::Kind;
use crate::syntax::tree::{Expr, ExprKind, Item};
use crate::textile::Colour;
use crate::textile::knit::{
    Cable, Chart, ChartError, Colourwork, Float, Knit, Lean, Symbol, Way, knitscape, written,
};
use crate::units::{Dimension, length};

/// Wales or courses a metre may have: cobweb and machine lace below, fishing nets above.
const GAUGES: (f64, f64) = (5.0, 20_000.0);
/// The words that say what a knit is; a knit has one of them.
const WAYS: [&str; 4] = ["chart", "written", "knitscape", "motif"];
/// Floats are told to be long beyond this many stitches
const LONG: usize = 5;
/// and this length, m: a finger catches in them (an inch is the usual rule).
const LONG_METRES: f64 = 0.025;

/// Cells that count as one step of evaluation.
const CELLS: usize = 4;

/// A cell of a chart: what it is, and in which colour where that is said.
type Cell = (Symbol, Option<Colour>);

/// A knit.
pub(in crate::evaluate) fn knit(ev: &mut Evaluator<'_>, id: ItemId) -> Option<Knit> {
    let fields = ev.open_item(id)?;
    let gauge = gauge(ev, &fields);
    let made = way(ev, &fields).and_then(|way| Some((made(ev, &fields, &way)?, way)));
    let ([wales, courses], (chart, way)) = (gauge?, made?);
    if !ev.step((chart.width() * chart.height() / CELLS) as u64, way.span) {
        return None;
    }
    let mut chart = chart;
    chart.round = fields.get("worked").and_then(|it| it.choice(0)) == Some("round");
    if fields.get("colors").and_then(|it| it.choice(0)) == Some("intarsia") {
        chart.colourwork = Colourwork::Intarsia;
    }
    if let Some(face) = fields.get("face").filter(|face| face.choice(0) == Some("back")) {
        let Some(behind) = chart.behind() else {
            ev.tell(
                Diagnostic::new("E0207", "this chart cannot be turned over")
                    .at(face.span, "it shows the back")
                    .help("cables, bobbles and double decreases are charted as seen on the face"),
            );
            return None;
        };
        chart = behind;
    }
    if let Some(float) = chart.longest_float() {
        long_float(ev, float, wales, way.span);
    }
    match Knit::new(ev.item(id).name.clone(), chart, wales, courses) {
        Ok(knit) => Some(knit),
        Err(error) => {
            ev.tell(Diagnostic::new("E0303", error.to_string()).at(fields.span, "here"));
            None
        }
    }
}

/// The line that says what it is.
fn way<'t>(ev: &mut Evaluator<'t>, fields: &Fields<'t>) -> Option<Phrase<'t>> {
    let ways: Vec<&Phrase<'_>> =
        fields.phrases.iter().filter(|phrase| WAYS.contains(&phrase.word.name)).collect();
    match ways.as_slice() {
        [] => {
            ev.required(fields, "chart");
            None
        }
        [way] => Some((*way).clone()),
        [first, second, ..] => {
            ev.tell(
                Diagnostic::new("E0209", format!("{} is knitted in two ways", fields.title))
                    .at(second.span, "here")
                    .at(first.span, "and here")
                    .help("keep one"),
            );
            None
        }
    }
}

fn gauge<'t>(ev: &mut Evaluator<'t>, fields: &Fields<'t>) -> Option<[f64; 2]> {
    let said = ev.required(fields, "gauge")?.clone();
    let per = ev.positive(said.value("per")?, Dimension::LENGTH);
    let wales = said.arg(0).and_then(|arg| ev.positive(arg, Dimension::NUMBER));
    let courses = said.arg(1).and_then(|arg| ev.positive(arg, Dimension::NUMBER));
    let gauge = [wales? / per?, courses? / per?];
    if gauge.iter().all(|count| (GAUGES.0..=GAUGES.1).contains(count)) {
        return Some(gauge);
    }
    ev.tell(Diagnostic::new("E0303", "no yarn can be knitted at this gauge").at(said.span, "here"));
    None
}

fn made<'t>(ev: &mut Evaluator<'t>, fields: &Fields<'t>, way: &Phrase<'t>) -> Option<Chart> {
    if let Some(stitches) = fields.get("stitches").filter(|_| way.word.name != "written") {
        let told = Diagnostic::new("E0207", "the stitches are those of the chart");
        ev.tell(told.at(stitches.span, "`stitches` is for rows in words"));
    }
    match way.word.name {
        "written" => in_words(ev, fields, way),
        "knitscape" => {
            let (file, text) = ev.file_of(way)?;
            let (found, told) = knitscape::read(file, text);
            told.into_iter().for_each(|told| ev.tell(told));
            found
        }
        "motif" => of_motif(ev, way),
        _ => charted(ev, fields, way),
    }
}

/// `chart:` with its legend.
fn charted<'t>(ev: &mut Evaluator<'t>, fields: &Fields<'t>, way: &Phrase<'t>) -> Option<Chart> {
    let named = |word: &str| (Symbol::named(word).unwrap_or(Symbol::Knit), None);
    let mut keys: Keys<Cell> = Keys::new(&[
        (".", named("knit")),
        ("k", named("knit")),
        ("R", named("knit")),
        ("-", named("purl")),
        ("p", named("purl")),
        ("L", named("purl")),
        ("o", named("yo")),
        ("O", named("yo")),
        ("/", named("k2tog")),
        ("\\", named("ssk")),
        ("^", named("cdd")),
        ("V", named("slip")),
        ("B", named("bobble")),
        ("#", named("no_stitch")),
    ]);
    for line in chart::legend(ev, fields) {
        // The key is known even where its meaning is wrong, which has been told of.
        let cell = meaning(ev, &line).unwrap_or((Symbol::Knit, None));
        keys.set(&line.key.text, cell);
    }
    let known = "known are `.` knit, `-` purl, `o` yo, `/` k2tog, `\\` ssk, `^` cdd, `V` slip, \
                 `B` bobble, `#` no_stitch; name other signs in `legend`";
    let rows = chart::rows(ev, way, &keys, known)?;
    let symbols = rows.iter().map(|(row, _)| row.iter().map(|cell| cell.0).collect()).collect();
    let colours = rows.iter().map(|(row, _)| row.iter().map(|cell| cell.1).collect()).collect();
    let place = |row: usize| rows.get(row - 1).map_or(way.span, |(_, span)| *span);
    sound(ev, Chart::new(symbols, Some(colours)), way, place)
}

/// What a line of the legend says: `knit`, `purl red`, `cable 2/2 left`, `crimson`.
fn meaning<'t>(ev: &mut Evaluator<'t>, line: &Phrase<'t>) -> Option<Cell> {
    let (symbol, rest) = match line.rest {
        [Item::Expr(first), rest @ ..] => match bare(first).map(|name| name.text.as_str()) {
            Some("cable") => return cable(ev, line, rest),
            Some(word) => match Symbol::named(word) {
                Some(symbol) => (symbol, rest),
                None => (Symbol::Knit, line.rest),
            },
            None => (Symbol::Knit, line.rest),
        },
        _ => (Symbol::Knit, line.rest),
    };
    let colour = match rest {
        [] if line.rest.is_empty() => {
            unknown(ev, line);
            return None;
        }
        [] => None,
        [Item::Expr(Expr { kind: ExprKind::Unread, .. }), ..] => return None,
        // A misspelt symbol is no colour.
        [Item::Expr(expr)] if rest.len() == line.rest.len() && misspelt(ev, line, expr) => {
            return None;
        }
        [Item::Expr(expr)] => Some(ev.colour(Arg { expr, scope: line.scope, of: "legend" })?),
        _ => {
            unknown(ev, line);
            return None;
        }
    };
    Some((symbol, colour))
}

/// Tells a word of a legend that is nearly a symbol and names nothing else.
fn misspelt<'t>(ev: &mut Evaluator<'t>, line: &Phrase<'t>, expr: &'t Expr) -> bool {
    let Some(name) = bare(expr) else { return false };
    if ev.knows(&name.text, line.scope) {
        return false;
    }
    unknown(ev, line);
    true
}

/// `cable 2/2 left`, `cable 2/1 right purl`, perhaps with a colour.
fn cable<'t>(ev: &mut Evaluator<'t>, line: &Phrase<'t>, items: &'t [Item]) -> Option<Cell> {
    if unread(items) {
        return None;
    }
    let word = |item: &'t Item| match item {
        Item::Expr(expr) => bare(expr).map(|name| name.text.as_str()),
        _ => None,
    };
    let [Item::Expr(sides), lean, rest @ ..] = items else {
        unknown(ev, line);
        return None;
    };
    let lean = match word(lean) {
        Some("left") => Lean::Left,
        Some("right") => Lean::Right,
        _ => {
            unknown(ev, line);
            return None;
        }
    };
    let mut parts = Vec::new();
    quotients(sides, &mut parts);
    let [front, behind] = parts.as_slice() else {
        unknown(ev, line);
        return None;
    };
    let mut side = |expr| {
        let arg = Arg { expr, scope: line.scope, of: "cable" };
        ev.whole_number(arg, 1, Cable::MOST.into()).and_then(|count| u8::try_from(count).ok())
    };
    let (front, behind) = (side(front)?, side(behind)?);
    let (purl, rest) = match rest {
        [first, rest @ ..] if word(first) == Some("purl") => (true, rest),
        rest => (false, rest),
    };
    let colour = match rest {
        [] => None,
        [Item::Expr(expr)] => Some(ev.colour(Arg { expr, scope: line.scope, of: "legend" })?),
        _ => {
            unknown(ev, line);
            return None;
        }
    };
    Some((Symbol::Cable(Cable { front, behind, lean, purl }), colour))
}

fn unknown<'t>(ev: &mut Evaluator<'t>, line: &Phrase<'t>) {
    let words: Vec<&str> = Symbol::words().chain(["cable 2/2 left", "a colour"]).collect();
    chart::unknown_meaning(ev, line, &words);
}

/// `motif:` with a stitch for each of its cells, in its colour.
fn of_motif<'t>(ev: &mut Evaluator<'t>, way: &Phrase<'t>) -> Option<Chart> {
    let arg = way.arg(0)?;
    let id = ev.item_named(arg, Kind::Motif)?;
    let Made::Motif(motif) = ev.make(id, arg.expr.span)? else { return None };
    let symbols = motif.rows.iter().map(|row| vec![Symbol::Knit; row.len()]).collect();
    sound(ev, Chart::new(symbols, Some(motif.rows.clone())), way, |_| way.span)
}

/// `written:` rows.
fn in_words<'t>(ev: &mut Evaluator<'t>, fields: &Fields<'t>, way: &Phrase<'t>) -> Option<Chart> {
    let stitches = match fields.value("stitches") {
        Some(arg) => Some(ev.whole_number(arg, 1, Chart::LARGEST as i64)? as usize),
        None if fields.spoils("stitches") => return None,
        None => None,
    };
    let round = fields.get("worked").and_then(|it| it.choice(0)) == Some("round");
    let lines: Vec<&str> = way.drawing.iter().map(|row| row.text.as_str()).collect();
    let rows = match written(&lines, Way { stitches, round }) {
        Ok(rows) => rows,
        Err(told) => {
            let at = way.drawing.get(told.line).map_or(way.span, |row| {
                let offset = |at: usize| row.span.start + u32::try_from(at).unwrap_or(0);
                Span { start: offset(told.at.start), end: offset(told.at.end), ..row.span }
            });
            ev.tell(Diagnostic::new(told.code, told.message).at(at, "here").help(told.help));
            return None;
        }
    };
    sound(ev, Chart::new(rows, None), way, |_| way.span)
}

/// The chart, if its rows are sound and each works what the row below leaves; told where not.
fn sound<'t>(
    ev: &mut Evaluator<'t>,
    chart: Result<Chart, ChartError>,
    way: &Phrase<'t>,
    place: impl Fn(usize) -> Span,
) -> Option<Chart> {
    let chart = match chart {
        Ok(chart) => chart,
        Err(ChartError::Cable { row, found, cable }) => {
            let error = ChartError::Cable { row, found, cable };
            let told = Diagnostic::new("E0603", error.to_string()).at(place(row), "here");
            ev.tell(told.help("a sign of several letters covers as many cells"));
            return None;
        }
        Err(error) => {
            ev.tell(Diagnostic::new("E0601", error.to_string()).at(way.span, "here"));
            return None;
        }
    };
    let wrong = chart.imbalances();
    for found in wrong.iter().take(5) {
        let below = found.row - 1;
        let message = format!(
            "row {} works {} stitches, row {below} leaves {}",
            found.row, found.uses, found.left
        );
        ev.tell(
            Diagnostic::new("E0603", message)
                .at(place(found.row), format!("works {}", found.uses))
                .at(place(below), format!("leaves {}", found.left))
                .help(
                    "a yarn over or `m1l` adds a stitch, a decrease takes one away; `no_stitch` \
                     keeps a column that has none",
                ),
        );
    }
    wrong.is_empty().then_some(chart)
}

/// Tells a yarn that runs far behind the stitches of others: W0607.
fn long_float(ev: &mut Evaluator<'_>, float: Float, wales: f64, at: Span) {
    let metres = float.stitches as f64 / wales;
    if float.stitches <= LONG || metres <= LONG_METRES {
        return;
    }
    let yarn = match float.colour {
        Some(Colour([red, green, blue, _])) => format!("#{red:02x}{green:02x}{blue:02x}"),
        None => "the yarn".to_owned(),
    };
    let message = format!(
        "row {} carries {yarn} behind {} stitches ({})",
        float.row,
        float.stitches,
        length(metres)
    );
    ev.tell(
        Diagnostic::new("W0607", message)
            .at(at, "here")
            .help("fingers catch in it; work it in on the way, or give each patch its own yarn: `colors: intarsia`"),
    );
}
