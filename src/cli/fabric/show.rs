//! `darzi fabric show`: one fabric with all its measures.

use super::measure::{self, Units};
use super::{Source, say_json};
use crate::cli::{Stop, say};
use crate::evaluate::catalogue::Entry;
use crate::textile::fabric::Structure;
use crate::textile::origin::Reading;
use crate::units::{Quantity, trimmed};
use std::fmt::Write;

#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  darzi fabric show wool
  darzi fabric show lining skirt.garment
  darzi fabric show wool --units kes,fast
  darzi fabric show wool --json")]
pub(super) struct Show {
    /// The fabric's name
    #[arg(value_name = "FABRIC")]
    fabric: String,

    #[command(flatten)]
    source: Source,

    /// In whose units; several with commas [default: all]
    #[arg(long, value_enum, value_delimiter = ',')]
    units: Vec<Units>,

    /// As JSON
    #[arg(long)]
    json: bool,
}

impl Show {
    pub(super) fn run(self) -> Result<(), Stop> {
        let entry = self.source.fabric(&self.fabric)?;
        let units = if self.units.is_empty() { &Units::ALL[..] } else { &self.units };
        let measures = measure::measures(&entry);
        if self.json {
            let readings: Vec<_> = entry
                .origins
                .readings
                .iter()
                .map(|it| {
                    serde_json::json!({
                        "sheet": it.sheet, "name": it.name,
                        "warp": it.value[0], "weft": it.value[1],
                    })
                })
                .collect();
            return say_json(&serde_json::json!({
                "name": entry.fabric.name, "home": entry.home, "doc": entry.doc,
                "made": made(&entry),
                "measures": measure::json(&measures, units),
                "readings": readings,
            }));
        }
        let mut out = format!("{}  {}\n", entry.fabric.name, entry.home);
        for line in entry.doc.lines() {
            let _ = writeln!(out, "{}", line.trim());
        }
        let _ = writeln!(out, "{}\n", made(&entry));
        out.push_str(&measure::head());
        out.push_str(&measure::table(&measures, units));
        if !entry.origins.readings.is_empty() {
            out.push_str("\nas written\n");
            for it in &entry.origins.readings {
                let _ = writeln!(out, "{:18}  {:4}  {}", it.sheet.word(), it.name, written(it));
            }
        }
        say(&out)
    }
}

/// A row of a sheet.
fn written(reading: &Reading) -> String {
    let [warp, weft] =
        reading.value.map(|value| Quantity::new(value, reading.dimension).to_string());
    if warp == weft { warp } else { format!("{warp}, {weft}") }
}

/// How the fabric is made, in one line.
fn made(entry: &Entry) -> String {
    match &entry.fabric.structure {
        Structure::Woven { weave, warp, weft } => {
            let [warp, weft] = [warp, weft].map(|thread| {
                format!(
                    "{} {} tex at {}/cm",
                    thread.yarn.name,
                    trimmed(thread.yarn.count * 1e6, 1),
                    trimmed(0.01 / thread.spacing, 1)
                )
            });
            format!("{}: warp {warp}, weft {weft}", weave.name)
        }
        Structure::Knitted { knit, yarn } => format!(
            "{}: {} {} tex, {} x {} loops in 10 cm",
            knit.name,
            yarn.name,
            trimmed(yarn.count * 1e6, 1),
            trimmed(knit.wales / 10.0, 1),
            trimmed(knit.courses / 10.0, 1)
        ),
    }
}
