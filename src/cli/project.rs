//! From a file on disk to the garment a command works on.

use super::{Input, MessageFormat, Stop};
use crate::diagnostic::{Diagnostic, FileId, Texts, in_order, json, render, short};
use crate::evaluate;
use crate::garment::Garment;
use crate::world::{Disk, World};
use std::io::IsTerminal;
use std::path::{Component, Path};

/// A file that has been read, with the way its messages are told.
pub(super) struct Project {
    world: Disk,
    root: FileId,
    format: MessageFormat,
}

impl Project {
    /// Opens the file of `input`.
    pub(super) fn open(input: &Input) -> Result<Self, Stop> {
        Project::at(&input.file, input.message_format)
    }

    /// Opens a file.
    pub(super) fn at(path: &Path, format: MessageFormat) -> Result<Self, Stop> {
        if path.extension().is_none_or(|e| e != "garment") {
            return Err(Stop::Call(format!(
                "`{}` is not a .garment file; darzi reads files that end so",
                path.display()
            )));
        }
        Project::named(path, format)
    }

    /// Opens a file of any name.
    pub(super) fn named(path: &Path, format: MessageFormat) -> Result<Self, Stop> {
        // A file below the current folder is named as the caller named it, and may use files
        // beside its own folder; any other file has its own folder as its project.
        let below = path.is_relative()
            && path.components().all(|c| matches!(c, Component::Normal(_) | Component::CurDir));
        let (folder, name) = match (below, path.parent(), path.file_name()) {
            (false, Some(folder), Some(name)) => (folder, Path::new(name)),
            _ => (Path::new("."), path),
        };
        let Some(name) = name.to_str() else {
            return Err(Stop::Call(format!("`{}` is not written in UTF-8", path.display())));
        };
        let mut world = Disk::new(folder);
        match world.open(name) {
            Ok(root) => Ok(Project { world, root, format }),
            Err(why) => {
                let told =
                    Diagnostic::new("E0903", format!("cannot read `{}`", path.display())).help(why);
                tell(&[told], &world, format);
                Err(Stop::Input)
            }
        }
    }

    /// A text that is no file; it may use those of the current folder.
    pub(super) fn of_text(title: &str, text: &str, format: MessageFormat) -> Self {
        let mut world = Disk::new(Path::new("."));
        let root = world.take_in(title, text);
        Project { world, root, format }
    }

    /// Does a piece of work on the file.
    pub(super) fn with<T>(&mut self, job: impl FnOnce(&mut dyn World, FileId) -> T) -> T {
        job(&mut self.world, self.root)
    }

    /// The file and its text.
    pub(super) fn text(&self) -> (FileId, &str) {
        (self.root, self.world.text(self.root))
    }

    /// Evaluates the file: its sound garments, and what there is to say of the others.
    pub(super) fn evaluate(&mut self, input: &Input) -> (Vec<Garment>, Vec<Diagnostic>) {
        self.evaluate_as(&evaluate::Options {
            set: input.set.clone(),
            size: input.fit.clone(),
            ..Default::default()
        })
    }

    /// Evaluates the file as it is asked for.
    pub(super) fn evaluate_as(
        &mut self,
        options: &evaluate::Options,
    ) -> (Vec<Garment>, Vec<Diagnostic>) {
        evaluate::evaluate(&mut self.world, self.root, options)
    }

    /// Puts messages of several stages in the order of the text and tells them.
    ///
    /// # Errors
    /// [`Stop::Input`] if one of them is an error.
    pub(super) fn tell_all(&self, mut diagnostics: Vec<Diagnostic>) -> Result<(), Stop> {
        in_order(self.root, &mut diagnostics);
        self.tell(&diagnostics);
        if diagnostics.iter().any(Diagnostic::is_error) { Err(Stop::Input) } else { Ok(()) }
    }

    /// The one garment that `input` names, or the only one there is.
    ///
    /// # Errors
    /// [`Stop::Input`] if anything is wrong with the file.
    pub(super) fn garment(&mut self, input: &Input) -> Result<Garment, Stop> {
        let (mut garments, diagnostics) = self.evaluate(input);
        self.tell_all(diagnostics)?;
        let names: Vec<String> = garments.iter().map(|g| g.name.clone()).collect();
        let found = match &input.name {
            Some(name) => garments.iter().position(|g| g.name == *name).ok_or_else(|| {
                Stop::Call(format!("no `{name}` in this file; it has {}", names.join(", ")))
            })?,
            None if garments.len() == 1 => 0,
            None if garments.is_empty() => {
                self.tell(&[Diagnostic::new("E0209", "this file makes nothing that can be shown")
                    .help("it needs a `garment`, a `scene` or a `picture` of a sari")]);
                return Err(Stop::Input);
            }
            None => {
                return Err(Stop::Call(format!(
                    "this file has {}; say which with --name",
                    names.join(", ")
                )));
            }
        };
        Ok(garments.swap_remove(found))
    }

    /// The texts of which messages speak.
    pub(super) fn texts(&self) -> &dyn Texts {
        &self.world
    }

    /// Tells messages about the file.
    pub(super) fn tell(&self, diagnostics: &[Diagnostic]) {
        tell(diagnostics, &self.world, self.format);
    }
}

/// Tells messages about texts on standard error.
pub(super) fn tell(diagnostics: &[Diagnostic], texts: &dyn Texts, format: MessageFormat) {
    let Some(first) = diagnostics.first() else { return };
    let color = std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none();
    eprint!("{}", report(diagnostics, texts, format, color));
    if format == MessageFormat::Human {
        eprintln!("`darzi explain {}` says more", first.code);
    }
}

/// Messages about texts as they are asked for.
pub(super) fn report(
    diagnostics: &[Diagnostic],
    texts: &dyn Texts,
    format: MessageFormat,
    color: bool,
) -> String {
    match format {
        MessageFormat::Json => json::lines(diagnostics, texts),
        MessageFormat::Short => short::lines(diagnostics, texts),
        MessageFormat::Human => render::report(diagnostics, texts, color, 100),
    }
}
