//! `darzi fabric`: the textile laboratory.

mod convert;
mod list;
mod measure;
mod show;
mod test;

use super::project::Project;
use super::{MessageFormat, Stop};
use crate::diagnostic::spelling::nearest;
use crate::evaluate::catalogue::{self, Entry};
use clap::Subcommand;
use std::path::{Path, PathBuf};

#[derive(Debug, clap::Args)]
pub(super) struct Fabric {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// The fabrics of the library, and of a file
    List(list::List),
    /// All measures of a fabric, in SI units and those of KES-F, FAST and CLO
    Show(show::Show),
    /// Rows of a KES-F or FAST sheet in all units
    Convert(convert::Convert),
    /// A test of the laboratory on the fabric as it is worked out
    Test(test::Test),
}

impl Fabric {
    pub(super) fn run(self) -> Result<(), Stop> {
        match self.command {
            Command::List(it) => it.run(),
            Command::Show(it) => it.run(),
            Command::Convert(it) => it.run(),
            Command::Test(it) => it.run(),
        }
    }
}

/// Which fabrics are meant.
#[derive(Debug, clap::Args)]
struct Source {
    /// A .garment file whose fabrics are meant too
    #[arg(value_name = "FILE")]
    file: Option<PathBuf>,

    /// How messages are written
    #[arg(long, value_enum, default_value_t = MessageFormat::Human)]
    message_format: MessageFormat,
}

impl Source {
    /// The fabrics of the file and of the library.
    ///
    /// # Errors
    /// [`Stop::Input`] if a fabric of the file is wrong.
    fn fabrics(&self) -> Result<Vec<Entry>, Stop> {
        read(match &self.file {
            Some(file) => Project::at(file, self.message_format)?,
            None => Project::of_text("fabric", "", self.message_format),
        })
    }

    /// The fabric of that name.
    ///
    /// # Errors
    /// [`Stop::Call`] where there is none.
    fn fabric(&self, name: &str) -> Result<Entry, Stop> {
        let mut fabrics = self.fabrics()?;
        if let Some(found) = fabrics.iter().position(|it| it.fabric.name == name) {
            return Ok(fabrics.swap_remove(found));
        }
        let near = nearest(name, fabrics.iter().map(|it| it.fabric.name.as_str()));
        let hint = near.map_or(String::new(), |near| format!("; did you mean `{near}`?"));
        let file = self.file.as_deref().unwrap_or(Path::new("")).display();
        Err(Stop::Call(format!(
            "there is no fabric `{name}`{hint}\n`darzi fabric list {file}` shows all"
        )))
    }
}

/// The fabrics that a text may name.
fn read(mut project: Project) -> Result<Vec<Entry>, Stop> {
    let (fabrics, told) =
        project.with(|world, root| catalogue::fabrics(world, root, &Default::default()));
    project.tell_all(told)?;
    Ok(fabrics)
}

/// Writes a value as JSON to standard output.
fn say_json(value: &serde_json::Value) -> Result<(), Stop> {
    super::say(&format!("{value:#}\n"))
}
