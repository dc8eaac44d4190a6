//! The figures of a knit, for programs and for people.

use super::source::{Charted, Programmed, Source};
use crate::textile::Colour;
use crate::textile::knit::{Chart, Symbol, loop_length};
use crate::textile::knitout::{self, Outcome};
use crate::units::{length, trimmed};
use serde_json::{Value, json};
use sha2::{Digest, Sha256};
use std::fmt::Write;

/// One JSON object.
pub(super) fn json(source: &Source) -> Value {
    match source {
        Source::Charted(it) => of_chart(it),
        Source::Programmed(it) => of_program(it),
    }
}

/// A few lines to be read.
pub(super) fn summary(source: &Source) -> String {
    match source {
        Source::Charted(it) => chart_in_words(it),
        Source::Programmed(it) => program_in_words(it),
    }
}

/// Yarn of one repeat of a chart.
struct Need {
    /// Stitches that take yarn: all that are left but those slipped.
    worked: usize,
    /// Yarn in a stitch, m.
    each: f64,
    /// Mass of a metre of yarn, kg, where the yarn is known.
    count: Option<f64>,
}

impl Need {
    fn of(it: &Charted) -> Option<Need> {
        let each = loop_length(it.gauge?);
        let worked = worked(&it.chart);
        Some(Need { worked, each, count: it.yarn.as_ref().map(|yarn| yarn.count) })
    }

    fn length(&self) -> f64 {
        self.worked as f64 * self.each
    }
}

fn worked(chart: &Chart) -> usize {
    let takes = |symbol: &&Symbol| symbol.leaves() > 0 && **symbol != Symbol::Slip;
    chart.rows().iter().flatten().filter(takes).count()
}

fn cables(chart: &Chart) -> usize {
    let is_cable = |(symbol, _): &(&Symbol, &usize)| matches!(symbol, Symbol::Cable(_));
    chart.counts().iter().filter(is_cable).map(|(_, count)| count).sum()
}

fn of_chart(it: &Charted) -> Value {
    let chart = &it.chart;
    let symbols: serde_json::Map<String, Value> =
        chart.counts().iter().map(|(symbol, count)| (symbol.word(), (*count).into())).collect();
    let colours: Vec<Value> = chart.palette().iter().map(|it| it.map(hex).into()).collect();
    let float = chart.longest_float();
    // Of what no machine has needles for nobody wants the program.
    const MOST: usize = 1 << 20;
    let small = chart.width() * chart.height() <= MOST;
    let machine = match small.then(|| it.program()) {
        None => Value::Null,
        Some(Ok(program)) => {
            let (outcome, _) = knitout::run(crate::diagnostic::FileId(0), &program);
            loops(&outcome)
        }
        Some(Err(told)) => json!({ "refused": told.message }),
    };
    json!({
        "title": it.title,
        "from": it.from,
        "stitches": chart.width(),
        "rows": chart.height(),
        "worked": if chart.round { "round" } else { "flat" },
        "symbols": symbols,
        "cables": cables(chart),
        "cast_on": chart.uses(0),
        "left": chart.leaves(chart.height() - 1),
        "repeats": chart.closes(),
        "colours": colours,
        "longest_float": float.map_or(0, |float| float.stitches),
        "patches": chart.patches(),
        "gauge": it.gauge.map(|[wales, courses]| json!({
            "stitches_per_10cm": wales / 10.0,
            "rows_per_10cm": courses / 10.0,
        })),
        "yarn": Need::of(it).map(|need| json!({
            "stitches": need.worked,
            "stitch_mm": need.each * 1e3,
            "metres": need.length(),
            "grams": need.count.map(|count| need.length() * count * 1e3),
        })),
        "knitout": machine,
        "chart_sha256": fingerprint(chart),
    })
}

fn loops(outcome: &Outcome) -> Value {
    json!({
        "loops": outcome.loops(),
        "knitted_front": outcome.knitted[0],
        "knitted_back": outcome.knitted[1],
        "tucked": outcome.tucked,
        "split": outcome.split,
        "missed": outcome.missed,
        "transferred": outcome.transferred,
        "dropped": outcome.dropped,
        "loops_left": outcome.left(),
        "most_on_needle": outcome.most_on_needle,
        "passes": outcome.passes.len(),
        "courses": outcome.courses,
    })
}

fn of_program(it: &Programmed) -> Value {
    let mut figures = loops(&it.outcome);
    let carriers: Vec<Value> = it
        .outcome
        .carriers
        .iter()
        .zip(&it.program.carriers)
        .filter(|(work, _)| work.loops > 0)
        .map(|(work, name)| {
            let yarn = it.program.header(&format!("Yarn-{name}"));
            let (loops, float) = (work.loops, work.longest_float);
            json!({ "name": name, "yarn": yarn, "loops": loops, "longest_float": float })
        })
        .collect();
    let more = json!({
        "title": it.title,
        "from": format!("knitout {}", it.program.version),
        "machine": it.program.header("Machine"),
        "gauge": it.program.header("Gauge"),
        "carriers": it.program.carriers.len(),
        "carriers_used": carriers,
        "operations": it.program.operations().count(),
        "needles": it.outcome.reach,
        "stitches": it.outcome.reach.map_or(0, |[low, high]| high.abs_diff(low) + 1),
        "rows": it.outcome.courses,
    });
    if let (Value::Object(figures), Value::Object(more)) = (&mut figures, more) {
        figures.extend(more);
    }
    figures
}

fn chart_in_words(it: &Charted) -> String {
    let chart = &it.chart;
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = writeln!(out, "{}  ({})", it.title, it.from);
    let way = if chart.round { ", in the round" } else { "" };
    let _ = writeln!(out, "{:<12}{}", "stitches", chart.width());
    let _ = writeln!(out, "{:<12}{}{way}", "rows", chart.height());
    let mut label = "symbols";
    for (symbol, count) in chart.counts() {
        let _ = writeln!(out, "{label:<12}{} {}", count, symbol.meaning());
        label = "";
    }
    if chart.palette().iter().any(Option::is_some) {
        let colours: Vec<String> =
            chart.palette().iter().map(|it| it.map_or("the yarn's".to_owned(), hex)).collect();
        let _ = writeln!(out, "{:<12}{}", "colours", colours.join(", "));
    }
    if let Some(float) = chart.longest_float() {
        let _ = writeln!(
            out,
            "{:<12}{} stitches, in row {}",
            "longest float", float.stitches, float.row
        );
    }
    if let Some([wales, courses]) = it.gauge {
        let (wales, courses) = (trimmed(wales / 10.0, 1), trimmed(courses / 10.0, 1));
        let _ = writeln!(out, "{:<12}{wales} stitches, {courses} rows in 10 cm", "gauge");
    }
    if let Some(need) = Need::of(it) {
        let mass = need.count.map_or(String::new(), |count| {
            format!(", {} g", trimmed(need.length() * count * 1e3, 2))
        });
        let _ = writeln!(
            out,
            "{:<12}{}{mass}, of {} a stitch",
            "yarn",
            length(need.length()),
            length(need.each)
        );
    }
    out
}

fn program_in_words(it: &Programmed) -> String {
    let outcome = &it.outcome;
    let mut out = String::new();
    let machine = it.program.header("Machine").map_or(String::new(), |name| format!(", {name}"));
    let _ = writeln!(out, "{}  (knitout {}{machine})", it.title, it.program.version);
    if let Some([low, high]) = outcome.reach {
        let _ = writeln!(out, "{:<12}{low} to {high}", "needles");
    }
    let _ = writeln!(out, "{:<12}{}", "rows", outcome.courses);
    let _ = writeln!(
        out,
        "{:<12}{}: {} knitted in front, {} behind, {} tucked, {} split",
        "loops",
        outcome.loops(),
        outcome.knitted[0],
        outcome.knitted[1],
        outcome.tucked,
        outcome.split
    );
    let _ = writeln!(
        out,
        "{:<12}{} transferred, {} dropped, {} left on the needles",
        "",
        outcome.transferred,
        outcome.dropped,
        outcome.left()
    );
    let _ = writeln!(out, "{:<12}{}", "passes", outcome.passes.len());
    let mut label = "carriers";
    for (work, name) in outcome.carriers.iter().zip(&it.program.carriers) {
        if work.loops > 0 {
            let _ = writeln!(out, "{label:<12}{name}: {} loops", work.loops);
            label = "";
        }
    }
    out
}

fn hex(Colour([red, green, blue, _]): Colour) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

/// SHA-256 of the rows of the chart, first row first, cells from the left: the words of the
/// symbols, each followed by its colour where it has one, with blanks between cells and a line end
/// between rows.
fn fingerprint(chart: &Chart) -> String {
    let mut hash = Sha256::new();
    for (number, row) in chart.rows().iter().enumerate() {
        if number > 0 {
            hash.update("\n");
        }
        for (column, symbol) in row.iter().enumerate() {
            if column > 0 {
                hash.update(" ");
            }
            hash.update(symbol.word());
            if let Some(colour) = chart.colour(column, number) {
                hash.update(hex(colour));
            }
        }
    }
    hash.finalize().iter().fold(String::new(), |mut text, byte| {
        let _ = write!(text, "{byte:02x}");
        text
    })
}
