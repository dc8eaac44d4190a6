//! `darzi fabric list`: what fabrics there are.

use super::{Source, say_json};
use crate::cli::{Stop, say};
use crate::evaluate::catalogue::Entry;
use std::fmt::Write;

#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  darzi fabric list                                the library's
  darzi fabric list skirt.garment                  those of the file first")]
pub(super) struct List {
    #[command(flatten)]
    source: Source,

    /// As JSON
    #[arg(long)]
    json: bool,
}

impl List {
    pub(super) fn run(self) -> Result<(), Stop> {
        let fabrics = self.source.fabrics()?;
        if self.json {
            let rows: Vec<_> = fabrics
                .iter()
                .map(|it| {
                    serde_json::json!({
                        "name": it.fabric.name, "home": it.home, "doc": it.doc,
                        "mass": it.fabric.mass,
                    })
                })
                .collect();
            return say_json(&rows.into());
        }
        let wide = |of: fn(&Entry) -> &str| {
            fabrics.iter().map(|it| of(it).chars().count()).max().unwrap_or(0)
        };
        let name = wide(|it| &it.fabric.name);
        let home = wide(|it| &it.home);
        let mut out = String::new();
        for it in &fabrics {
            let doc = it.doc.lines().next().unwrap_or("");
            let line = format!(
                "{:name$}  {:home$}  {:4.0} g/m²  {doc}",
                it.fabric.name,
                it.home,
                it.fabric.mass * 1e3
            );
            // Writing to a string cannot fail.
            let _ = writeln!(out, "{}", line.trim_end());
        }
        say(&out)
    }
}
