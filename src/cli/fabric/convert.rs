//! `darzi fabric convert`: rows of a sheet in all units.

use super::measure::{self, Units};
use super::{read, say_json};
use crate::cli::project::Project;
use crate::cli::{MessageFormat, Stop, say};
use crate::textile::origin::Origin;
use std::fmt::Write;

#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  darzi fabric convert B=0.134gf.cm2/cm            bending rigidity
  darzi fabric convert C=18.5mm W=213.8g/m2        bending length to rigidity: B = W·g·C³
  darzi fabric convert EB5=4.1%                    bias extension to shear: G = 123/EB5
  darzi fabric convert EM=4.3%,9% LT=0.6 WT=12gf.cm/cm2,25gf.cm/cm2
  darzi fabric convert bending=13uN.m --units kes

Names are those of the KES-F and FAST sheets, and of the properties of a fabric; two values with
a comma are warp and weft.")]
pub(super) struct Convert {
    /// A row with its unit, such as B=0.134gf.cm2/cm
    #[arg(value_name = "NAME=VALUE", required = true, value_parser = crate::cli::setting)]
    rows: Vec<(String, String)>,

    /// In whose units; several with commas [default: all]
    #[arg(long, value_enum, value_delimiter = ',')]
    units: Vec<Units>,

    /// As JSON
    #[arg(long)]
    json: bool,

    /// How messages are written
    #[arg(long, value_enum, default_value_t = MessageFormat::Human)]
    message_format: MessageFormat,
}

/// Rows that only the FAST sheet has.
const FAST: [&str; 7] = ["E5", "E20", "E100", "EB5", "C", "T2", "T100"];

/// The rows as a fabric of the language, so that they are read and checked as those of a file.
fn text(rows: &[(String, String)]) -> String {
    let mut own = String::new();
    let mut kes = String::new();
    let mut fast = String::new();
    for (name, value) in rows {
        let block = match name.as_str() {
            name if FAST.contains(&name) => &mut fast,
            // In gf/cm/deg it is the G of KES-F, in N/m that of FAST.
            "G" if !["/deg", "/rad"].iter().any(|unit| value.contains(unit)) => &mut fast,
            name if name.starts_with(|c: char| c.is_ascii_lowercase()) => &mut own,
            _ => &mut kes,
        };
        // Writing to a string cannot fail.
        let _ = writeln!(block, "    {name}: {value}");
    }
    for (name, rows) in [("kes", kes), ("fast", fast)] {
        if !rows.is_empty() {
            let _ = writeln!(own, "    {name} {{\n{rows}    }}");
        }
    }
    format!("fabric given {{\n{own}}}\n")
}

impl Convert {
    pub(super) fn run(self) -> Result<(), Stop> {
        let project = Project::of_text("convert", &text(&self.rows), self.message_format);
        let fabrics = read(project)?;
        let Some(entry) = fabrics.first().filter(|it| it.fabric.name == "given") else {
            return Err(Stop::Call("these rows make no fabric".to_owned()));
        };
        let units = if self.units.is_empty() { &Units::ALL[..] } else { &self.units };
        let mut measures = measure::measures(entry);
        measures.retain(|it| it.origin != Origin::Assumed);
        if measures.is_empty() {
            return Err(Stop::Call(
                "nothing follows from these rows; EM wants no other, LT wants EM or WT".to_owned(),
            ));
        }
        if self.json {
            return say_json(&measure::json(&measures, units));
        }
        say(&format!("{}{}", measure::head(), measure::table(&measures, units)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_stand_on_the_sheet_that_knows_them() {
        let row = |name: &str, value: &str| (name.to_owned(), value.to_owned());
        let rows = [row("EM", "4%"), row("EB5", "4%"), row("G", "30N/m"), row("mass", "200g/m2")];
        let text = text(&rows);
        assert_eq!(
            text,
            "fabric given {\n    mass: 200g/m2\n    kes {\n    EM: 4%\n    }\n    fast {\n    \
             EB5: 4%\n    G: 30N/m\n    }\n}\n"
        );
    }
}
