//! `darzi fmt`: files in their one layout.

use super::project::{Project, tell};
use super::{MessageFormat, Stop, difference, output, say};
use crate::diagnostic::Diagnostic;
use crate::syntax::LONGEST_TEXT;
use crate::syntax::format::format;
use crate::world::{Memory, World};
use std::io::Read;
use std::path::{Path, PathBuf};

#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  darzi fmt skirt.garment                          lays the file out anew
  darzi fmt --check examples stdlib                says which files would change; exit code 1 if any
  darzi fmt --stdin < skirt.garment                for editors: from standard input to output

A file with mistakes in its shape is left as it is; they are told, and the exit code is 1.")]
pub(super) struct Fmt {
    /// .garment files, and folders whose .garment files are meant
    #[arg(value_name = "FILE", required_unless_present = "stdin")]
    paths: Vec<PathBuf>,

    /// Write nothing; say what would change
    #[arg(long)]
    check: bool,

    /// Read standard input and write to standard output
    #[arg(long, conflicts_with = "paths")]
    stdin: bool,

    /// How messages are written
    #[arg(long, value_enum, default_value_t = MessageFormat::Human)]
    message_format: MessageFormat,
}

impl Fmt {
    pub(super) fn run(self) -> Result<(), Stop> {
        if self.stdin {
            return self.pipe();
        }
        let mut files = Vec::new();
        for path in &self.paths {
            if path.is_dir() {
                let before = files.len();
                collect(path, &mut files)?;
                if files.len() == before {
                    let path = path.display();
                    return Err(Stop::Call(format!("there is no .garment file in `{path}`")));
                }
            } else {
                files.push(path.clone());
            }
        }
        let mut result = Ok(());
        for file in &files {
            match self.file(file) {
                Ok(()) => {}
                Err(Stop::Input) => result = Err(Stop::Input),
                Err(stop) => return Err(stop),
            }
        }
        result
    }

    /// Formats one file, or says what would change.
    fn file(&self, path: &Path) -> Result<(), Stop> {
        let project = Project::at(path, self.message_format)?;
        let (id, text) = project.text();
        let new = format(id, text).map_err(|told| {
            project.tell(&told);
            Stop::Input
        })?;
        if new == text {
            return Ok(());
        }
        if self.check {
            say(&difference::shown(&path.display().to_string(), text, &new))?;
            return Err(Stop::Input);
        }
        let refused = |why: &dyn std::fmt::Display| {
            Stop::Call(format!("cannot write `{}`: {why}", path.display()))
        };
        // The file behind a link is meant, not the link.
        let place = path.canonicalize().map_err(|error| refused(&error))?;
        if place.metadata().is_ok_and(|data| data.permissions().readonly()) {
            return Err(refused(&"it may only be read"));
        }
        output::write(&place, |out| out.write_all(new.as_bytes()))
    }

    /// Formats standard input.
    fn pipe(&self) -> Result<(), Stop> {
        let mut text = String::new();
        // One byte more than a text may have, so that a longer one is told.
        let input = std::io::stdin().take(LONGEST_TEXT as u64 + 1).read_to_string(&mut text);
        if let Err(why) = input {
            let told = Diagnostic::new("E0903", "cannot read standard input").help(why.to_string());
            tell(&[told], &Memory::default(), self.message_format);
            return Err(Stop::Input);
        }
        let mut world = Memory::new([("<stdin>", text.as_str())]);
        let id = world.open("<stdin>").map_err(Stop::Call)?;
        let new = format(id, &text).map_err(|told| {
            tell(&told, &world, self.message_format);
            Stop::Input
        })?;
        match self.check {
            true if new == text => Ok(()),
            true => say(&difference::shown("<stdin>", &text, &new)).and(Err(Stop::Input)),
            false => say(&new),
        }
    }
}

/// The `.garment` files in a folder and in the folders below it, in the order of their names.
/// Hidden folders and links to folders are left out.
pub(super) fn collect(folder: &Path, files: &mut Vec<PathBuf>) -> Result<(), Stop> {
    let failed = |error: std::io::Error| {
        Stop::Call(format!("cannot read the folder `{}`: {error}", folder.display()))
    };
    let mut entries = std::fs::read_dir(folder)
        .and_then(Iterator::collect::<std::io::Result<Vec<_>>>)
        .map_err(failed)?;
    entries.sort_by_key(std::fs::DirEntry::file_name);
    for entry in entries {
        let path = entry.path();
        if entry.file_name().to_string_lossy().starts_with('.') {
            continue;
        }
        if entry.file_type().map_err(failed)?.is_dir() {
            collect(&path, files)?;
        } else if path.extension().is_some_and(|end| end == "garment") && path.is_file() {
            files.push(path);
        }
    }
    Ok(())
}
