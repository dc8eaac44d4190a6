//! The command line: one file a command.
//!
//! Exit codes: 0 done; 1 the input is wrong; 2 the call is wrong; 3 the drape did not reach what
//! the file asks.

mod bar;
mod cache;
mod check;
mod compile;
mod difference;
mod drape;
mod expected;
mod explain;
mod fabric;
mod fmt;
mod graded;
mod knit;
mod lsp;
mod new;
mod output;
mod project;
mod render;
mod test;
mod weave;

use crate::units::Quantity;
use clap::{Parser, Subcommand, ValueEnum};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// A garment is written down as text; darzi cuts it, sews it, hangs it on a body and shows it.
#[derive(Debug, Parser)]
#[command(name = "darzi", version, about, propagate_version = true, max_term_width = 100)]
#[command(after_help = "Examples:
  darzi new skirt                                  write a commented starter file, skirt.garment
  darzi check skirt.garment                        say what is wrong with it, if anything
  darzi render skirt.garment -o skirt.png          sew it, drape it, draw it

Exit codes: 0 done; 1 the input is wrong; 2 the call is wrong; 3 the drape did not reach what the
file asks, with the reason.")]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Read a file and say what is wrong with it
    Check(check::Check),
    /// Compare files with the figures that are kept beside them
    Test(test::Test),
    /// Give files their one layout
    Fmt(fmt::Fmt),
    /// Cut a garment into particles and seams: mesh.json and atlas.png
    Compile(compile::Compile),
    /// Sew a garment and hang it on its wearer: a .glb or .obj
    Drape(drape::Drape),
    /// Draw a garment as it is worn: a .png
    Render(render::Render),
    /// Fabrics as a laboratory sees them: measures, units, tests
    Fabric(fabric::Fabric),
    /// Drafts of weavers: .wif files and the weaves of a text, checked, drawn, written
    Weave(weave::Weave),
    /// Charts of knitters: programs of machines, KnitScape files and the knits of a text
    Knit(knit::Knit),
    /// Write a commented starter file
    New(new::New),
    /// Say what the code of a message means
    Explain(explain::Explain),
    /// Serve an editor: messages, completion, names, layout
    Lsp(lsp::Lsp),
}

/// What every command that reads a `.garment` file takes.
#[derive(Debug, clap::Args)]
struct Input {
    /// The .garment file
    #[arg(value_name = "FILE")]
    file: PathBuf,

    /// Which garment or scene of the file, where it has several
    #[arg(long, value_name = "NAME")]
    name: Option<String>,

    /// Set a parameter: --set length=70cm (may be given more than once)
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = setting)]
    set: Vec<(String, String)>,

    /// Draft it for this size of the wearer's table, not for the wearer's own: --for "EU 42"
    #[arg(long = "for", value_name = "SIZE")]
    fit: Option<String>,

    /// How messages are written
    #[arg(long, value_enum, default_value_t = MessageFormat::Human)]
    message_format: MessageFormat,
}

/// What every command that drapes takes.
#[derive(Debug, clap::Args)]
struct Work {
    /// Side of the grid cells, such as 5mm (finer is slower); the file's own where not given
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    resolution: Option<f64>,

    /// Threads to work with; the result is the same for any number [default: all cores]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,

    /// Write figures of the drape (strain, gaps, penetration, verdict) as JSON
    #[arg(long, value_name = "FILE")]
    stats: Option<PathBuf>,

    /// Drape anew even if the same drape is known already, and keep nothing
    #[arg(long)]
    no_cache: bool,
}

/// How messages are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum MessageFormat {
    /// With the lines they speak of
    Human,
    /// One line a message: file:line:column: code: text
    Short,
    /// One JSON object a line
    Json,
}

fn setting(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((name, value)) if !name.trim().is_empty() && !value.trim().is_empty() => {
            Ok((name.trim().to_owned(), value.trim().to_owned()))
        }
        _ => Err("write NAME=VALUE, such as length=70cm".to_owned()),
    }
}

fn length(text: &str) -> Result<f64, String> {
    let metres = metres(text)?;
    if (2e-4..=0.5).contains(&metres) {
        Ok(metres)
    } else {
        Err("a grid cell lies between 0.2mm and 50cm".to_owned())
    }
}

/// Whether a path ends in one of these, in any case.
fn ends_with(path: &Path, ends: &[&str]) -> bool {
    let end = path.extension().and_then(|end| end.to_str());
    end.is_some_and(|end| ends.iter().any(|known| end.eq_ignore_ascii_case(known)))
}

/// A length with its unit, m.
fn metres(text: &str) -> Result<f64, String> {
    let split = text.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(text.len());
    let (number, unit) = text.split_at(split);
    number
        .parse()
        .ok()
        .zip(crate::units::unit(unit).ok())
        .and_then(|(number, unit): (f64, _)| unit.quantity(number))
        .filter(|quantity| quantity.fits(Quantity::length(1.0).dimension))
        .map(|quantity| quantity.value)
        .ok_or_else(|| format!("`{text}` is not a length; write it with its unit, such as 5mm"))
}

/// Why a command ended early.
enum Stop {
    /// The input is wrong; already told.
    Input,
    /// The call is wrong, or a file cannot be written.
    Call(String),
    /// The drape did not reach what the file asks; already told.
    Drape,
    /// A specimen did not come to what its test asks.
    Test(String),
}

/// Writes to standard output. A reader that has seen enough is no failure.
fn say(text: &str) -> Result<(), Stop> {
    let mut out = std::io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(Stop::Call(format!("cannot write to standard output: {error}")))
        }
        _ => Ok(()),
    }
}

/// Runs the program with the arguments of the process.
pub fn main() -> ExitCode {
    let result = match Cli::parse().command {
        Command::Check(it) => it.run(),
        Command::Test(it) => it.run(),
        Command::Fmt(it) => it.run(),
        Command::Compile(it) => it.run(),
        Command::Drape(it) => it.run(),
        Command::Render(it) => it.run(),
        Command::Fabric(it) => it.run(),
        Command::Weave(it) => it.run(),
        Command::Knit(it) => it.run(),
        Command::New(it) => it.run(),
        Command::Explain(it) => it.run(),
        Command::Lsp(it) => it.run(),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(Stop::Input) => ExitCode::from(1),
        Err(Stop::Call(why)) => {
            eprintln!("error: {why}");
            ExitCode::from(2)
        }
        Err(Stop::Drape) => ExitCode::from(3),
        Err(Stop::Test(why)) => {
            eprintln!("the test did not come to its end: {why}");
            ExitCode::from(3)
        }
    }
}
