//! The fabrics, weaves and knits that a file may name: its own, those of the files it uses, the
//! library's.

use super::item::{ItemId, Made};
use super::words::Kind;
use super::{Evaluator, Options, work};
use crate::diagnostic::{Diagnostic, FileId, Span};
use crate::textile::fabric::{Fabric, Structure};
use crate::textile::knit::Knit;
use crate::textile::origin::Origins;
use crate::textile::weave::Weave;
use crate::textile::yarn::Yarn;
use crate::world::World;

/// A fabric of the catalogue.
#[derive(Clone, Debug)]
pub struct Entry {
    /// The file in which it stands, or `std::fabric`.
    pub home: String,
    /// What the text says of it, without its slashes; empty if nothing.
    pub doc: String,
    /// The fabric.
    pub fabric: Fabric,
    /// Where its measures come from.
    pub origins: Origins,
}

/// All sound fabrics that `root` may name: its own first, then those of other files, then the
/// library's, each in the order of the text; and what is wrong with the others.
pub fn fabrics(
    world: &mut dyn World,
    root: FileId,
    options: &Options,
) -> (Vec<Entry>, Vec<Diagnostic>) {
    work(world, root, options, |evaluator| evaluator.catalogue())
}

/// A weave of the catalogue, or a woven fabric.
#[derive(Clone, Debug)]
pub struct Woven {
    /// Its name.
    pub name: String,
    /// The file in which it stands, or `std::weave`.
    pub home: String,
    /// Where its name stands.
    pub at: Span,
    /// Whether it stands in the file itself.
    pub own: bool,
    /// The weave.
    pub weave: Weave,
    /// The structure of a fabric, with its threads.
    pub structure: Option<Structure>,
}

/// All sound weaves and woven fabrics that `root` may name: its own first, then those of other
/// files, then the library's; and what is wrong with the others.
pub fn woven(
    world: &mut dyn World,
    root: FileId,
    options: &Options,
) -> (Vec<Woven>, Vec<Diagnostic>) {
    work(world, root, options, |evaluator| evaluator.woven())
}

/// A knit of the catalogue, or a knitted fabric.
#[derive(Clone, Debug)]
pub struct Knitted {
    /// Its name.
    pub name: String,
    /// The file in which it stands, or `std::knit`.
    pub home: String,
    /// Where its name stands.
    pub at: Span,
    /// Whether it stands in the file itself.
    pub own: bool,
    /// The knit.
    pub knit: Knit,
    /// The yarn of a fabric.
    pub yarn: Option<Yarn>,
}

/// All sound knits and knitted fabrics that `root` may name: its own first, then those of other
/// files, then the library's; and what is wrong with the others.
pub fn knitted(
    world: &mut dyn World,
    root: FileId,
    options: &Options,
) -> (Vec<Knitted>, Vec<Diagnostic>) {
    work(world, root, options, |evaluator| evaluator.knitted())
}

impl Evaluator<'_> {
    fn knitted(&mut self) -> Vec<Knitted> {
        self.open_files();
        let mut ranked: Vec<(u8, Knitted)> = Vec::new();
        for number in 0..self.items.len() {
            let id = ItemId(number);
            let (kind, at, name) =
                (self.item(id).kind, self.item(id).span, self.item(id).name.clone());
            if !matches!(kind, Kind::Knit | Kind::Fabric) {
                continue;
            }
            let (knit, yarn) = match self.make(id, at) {
                Some(Made::Knit(knit)) => ((*knit).clone(), None),
                Some(Made::Fabric(fabric, _)) => match &fabric.structure {
                    Structure::Knitted { knit, yarn } => (knit.clone(), Some(yarn.clone())),
                    Structure::Woven { .. } => continue,
                },
                _ => continue,
            };
            let Some((rank, home)) = self.home(at.file) else { continue };
            ranked.push((rank, Knitted { name, home, at, own: rank == 0, knit, yarn }));
        }
        ranked.sort_by_key(|(rank, _)| *rank);
        ranked.into_iter().map(|(_, entry)| entry).collect()
    }

    fn woven(&mut self) -> Vec<Woven> {
        self.open_files();
        let mut ranked: Vec<(u8, Woven)> = Vec::new();
        for number in 0..self.items.len() {
            let id = ItemId(number);
            let (kind, at, name) =
                (self.item(id).kind, self.item(id).span, self.item(id).name.clone());
            if !matches!(kind, Kind::Weave | Kind::Fabric) {
                continue;
            }
            let (weave, structure) = match self.make(id, at) {
                Some(Made::Weave(weave)) => ((*weave).clone(), None),
                Some(Made::Fabric(fabric, _)) => match &fabric.structure {
                    Structure::Woven { weave, .. } => {
                        (weave.clone(), Some(fabric.structure.clone()))
                    }
                    Structure::Knitted { .. } => continue,
                },
                _ => continue,
            };
            let Some((rank, home)) = self.home(at.file) else { continue };
            ranked.push((rank, Woven { name, home, at, own: rank == 0, weave, structure }));
        }
        ranked.sort_by_key(|(rank, _)| *rank);
        ranked.into_iter().map(|(_, entry)| entry).collect()
    }

    /// How near a file is to the one in hand, and its path: 0 itself, 1 another file of the
    /// project, 2 the library.
    fn home(&self, id: FileId) -> Option<(u8, String)> {
        let file = self.files.iter().find(|file| file.id == id)?;
        let rank = match () {
            () if file.id == self.root => 0,
            () if file.path.starts_with("std::") => 2,
            () => 1,
        };
        Some((rank, file.path.clone()))
    }

    fn catalogue(&mut self) -> Vec<Entry> {
        self.open_files();
        let mut ranked: Vec<(u8, Entry)> = Vec::new();
        for number in 0..self.items.len() {
            let id = ItemId(number);
            let (kind, span) = (self.item(id).kind, self.item(id).span);
            if kind != Kind::Fabric {
                continue;
            }
            let Some(Made::Fabric(fabric, origins)) = self.make(id, span) else { continue };
            let Some(file) = self.files.iter().find(|file| file.id == span.file) else { continue };
            let Some((rank, home)) = self.home(span.file) else { continue };
            let statement = file
                .tree
                .statements
                .iter()
                .find(|it| it.span.start <= span.start && span.end <= it.span.end);
            let doc = statement.map_or(String::new(), |it| it.doc.trim().to_owned());
            let entry = Entry { home, doc, fabric: (*fabric).clone(), origins: (*origins).clone() };
            ranked.push((rank, entry));
        }
        ranked.sort_by_key(|(rank, _)| *rank);
        ranked.into_iter().map(|(_, entry)| entry).collect()
    }
}
