//! The fabrics that a file may name: its own, those of the files it uses, the library's.

use super::item::{ItemId, Made};
use super::words::Kind;
use super::{Evaluator, Options, work};
use crate::diagnostic::{Diagnostic, FileId};
use crate::textile::fabric::Fabric;
use crate::textile::origin::Origins;
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

impl Evaluator<'_> {
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
            let rank = match () {
                () if file.id == self.root => 0,
                () if file.path.starts_with("std::") => 2,
                () => 1,
            };
            let statement = file
                .tree
                .statements
                .iter()
                .find(|it| it.span.start <= span.start && span.end <= it.span.end);
            let doc = statement.map_or(String::new(), |it| it.doc.trim().to_owned());
            let entry = Entry {
                home: file.path.clone(),
                doc,
                fabric: (*fabric).clone(),
                origins: (*origins).clone(),
            };
            ranked.push((rank, entry));
        }
        ranked.sort_by_key(|(rank, _)| *rank);
        ranked.into_iter().map(|(_, entry)| entry).collect()
    }
}
