//! `darzi test`: texts against the figures that are kept beside them.

use super::expected::{Cut, Expected};
use super::project::{Project, report};
use super::{Input, MessageFormat, Stop, graded, output, say};
use crate::diagnostic::{Diagnostic, in_order};
use crate::mesh;
use rayon::prelude::*;
use std::fmt::Write;
use std::path::{Path, PathBuf};

#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  darzi test                                       all .garment files in this folder and below
  darzi test collection/skirt.garment
  darzi test collection --accept                   keeps the figures as they are now

Beside skirt.garment lies skirt.expected.json: areas, lengths of edges and seams, ease, counts.
A text whose first line is `//~ E0501` is expected to be told just that. Exit codes: 0 all is as
expected; 1 something changed, is new or is wrong; 2 the call is wrong.")]
pub(super) struct Test {
    /// .garment files, and folders whose .garment files are meant [default: this folder]
    #[arg(value_name = "PATH")]
    paths: Vec<PathBuf>,

    /// Keep the figures as they are now
    #[arg(long)]
    accept: bool,

    /// How messages are written
    #[arg(long, value_enum, default_value_t = MessageFormat::Human)]
    message_format: MessageFormat,
}

/// What came of one file.
enum Outcome {
    Same,
    /// Nothing is cut, and nothing is wrong.
    Sound,
    /// The mistakes that were expected.
    AsWarned,
    Accepted,
    Changed(Vec<String>),
    New,
    /// It has mistakes, or its file of figures cannot be read.
    Wrong(String),
}

impl Test {
    pub(super) fn run(self) -> Result<(), Stop> {
        let mut files = Vec::new();
        let here = [PathBuf::from(".")];
        let paths = if self.paths.is_empty() { here.as_slice() } else { &self.paths };
        for path in paths {
            if path.is_dir() {
                super::fmt::collect(path, &mut files)?;
            } else if path.exists() {
                files.push(path.clone());
            } else {
                return Err(Stop::Call(format!("there is no `{}`", path.display())));
            }
        }
        if files.is_empty() {
            return Err(Stop::Call("there is no .garment file to test".to_owned()));
        }
        let outcomes: Vec<(&PathBuf, Result<Outcome, Stop>)> =
            files.par_iter().map(|file| (file, self.file(file))).collect();
        let mut out = String::new();
        let (mut good, mut changed, mut new, mut wrong) = (0, 0, 0, 0);
        for (file, outcome) in &outcomes {
            let file = file.display();
            // Writing to a string cannot fail.
            let _ = match outcome {
                Ok(Outcome::Same | Outcome::Sound | Outcome::AsWarned) => {
                    good += 1;
                    writeln!(out, "ok       {file}")
                }
                Ok(Outcome::Accepted) => {
                    good += 1;
                    writeln!(out, "accepted {file}")
                }
                Ok(Outcome::Changed(lines)) => {
                    changed += 1;
                    writeln!(out, "changed  {file}\n    {}", lines.join("\n    "))
                }
                Ok(Outcome::New) => {
                    new += 1;
                    writeln!(out, "new      {file}: nothing is kept to compare it with")
                }
                Ok(Outcome::Wrong(why)) => {
                    wrong += 1;
                    writeln!(out, "wrong    {file}\n{}", why.trim_end())
                }
                Err(Stop::Call(why)) => {
                    wrong += 1;
                    writeln!(out, "wrong    {file}: {why}")
                }
                Err(_) => {
                    wrong += 1;
                    writeln!(out, "wrong    {file}")
                }
            };
        }
        let counts = [(good, "as expected"), (changed, "changed"), (new, "new"), (wrong, "wrong")];
        let counts: Vec<String> = counts
            .iter()
            .filter(|(count, _)| *count > 0)
            .map(|(count, what)| format!("{count} {what}"))
            .collect();
        let _ = writeln!(out, "{}", counts.join(", "));
        if changed + new > 0 {
            let _ = writeln!(out, "`darzi test --accept` keeps the figures as they are now");
        }
        say(&out)?;
        if changed + new + wrong > 0 { Err(Stop::Input) } else { Ok(()) }
    }

    fn file(&self, path: &Path) -> Result<Outcome, Stop> {
        let input = Input {
            file: path.to_owned(),
            name: None,
            set: Vec::new(),
            fit: None,
            message_format: self.message_format,
        };
        let mut project = Project::open(&input)?;
        let (root, text) = project.text();
        let first = text.lines().next().and_then(|line| line.strip_prefix("//~"));
        let warned: Option<Vec<String>> =
            first.map(|codes| codes.split_whitespace().map(str::to_owned).collect());
        let (garments, mut told) = project.evaluate(&input);
        let options = mesh::Options { atlas: false, ..mesh::Options::default() };
        let sizes = graded::sizes(&mut project, &input, &garments, |garment| {
            mesh::compile(garment, &options)
        });
        let mut cuts = Vec::new();
        for garment in &garments {
            match mesh::compile(garment, &options) {
                Ok(compiled) => cuts.push(Cut::of(garment, None, &compiled)),
                Err(more) => told.extend(more),
            }
            for size in &sizes {
                let cut = size.cut.iter().filter(|(other, _)| other.name == garment.name);
                cuts.extend(
                    cut.map(|(garment, compiled)| Cut::of(garment, Some(&size.name), compiled)),
                );
            }
        }
        told.extend(graded::beyond(&told, &sizes));
        in_order(root, &mut told);
        if let Some(mut wanted) = warned {
            let mut found: Vec<&str> = told.iter().map(|told| told.code.as_str()).collect();
            found.sort_unstable();
            wanted.sort_unstable();
            if wanted == found {
                return Ok(Outcome::AsWarned);
            }
            let report = report(&told, project.texts(), self.message_format, false);
            return Ok(Outcome::Wrong(format!(
                "    {} is expected, {} is told\n{report}",
                listed(&wanted),
                listed(&found)
            )));
        }
        if told.iter().any(Diagnostic::is_error) {
            let report = report(&told, project.texts(), self.message_format, false);
            return Ok(Outcome::Wrong(report));
        }
        let found = Expected::of(cuts);
        let beside = path.with_extension("expected.json");
        let old = match std::fs::read_to_string(&beside) {
            Ok(text) => Some(text),
            Err(why) if why.kind() == std::io::ErrorKind::NotFound => None,
            Err(why) => {
                return Err(Stop::Call(format!("cannot read `{}`: {why}", beside.display())));
            }
        };
        if old.is_none() && found.is_empty() {
            return Ok(Outcome::Sound);
        }
        let outcome = match old.as_deref().map(Expected::read) {
            None => Outcome::New,
            Some(Ok(old)) if old == found => return Ok(Outcome::Same),
            Some(Ok(old)) => Outcome::Changed(found.against(&old)),
            Some(Err(why)) => {
                Outcome::Wrong(format!("    `{}` cannot be used: {why}", beside.display()))
            }
        };
        if !self.accept {
            return Ok(outcome);
        }
        let text = found.text().map_err(|why| Stop::Call(why.to_string()))?;
        output::write(&beside, |out| out.write_all(text.as_bytes()))?;
        Ok(Outcome::Accepted)
    }
}

fn listed(codes: &[impl AsRef<str>]) -> String {
    let codes: Vec<&str> = codes.iter().map(AsRef::as_ref).collect();
    if codes.is_empty() { "nothing".to_owned() } else { codes.join(" ") }
}
