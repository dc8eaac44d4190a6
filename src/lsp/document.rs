//! Open documents, and what is known of them.

use super::outline::{self, Outline};
use super::study::{Place, Study};
use super::text::{Shift, Text};
use super::uri;
use crate::diagnostic::{FileId, Span, Texts};
use crate::evaluate::facts::{Definition, Edge, Sewn, Worth};
use std::cell::OnceCell;
use std::path::{Component, Path, PathBuf};
use std::rc::Rc;
use std::sync::Arc;

/// A document that is open in the editor.
pub struct Document {
    /// Its address, as the client writes it.
    pub uri: String,
    /// Where it stands.
    pub place: Place,
    /// The client's number of its state.
    pub version: i32,
    /// Its text.
    pub text: Text,
    /// The state of all documents at its last change, or at that of a file it uses.
    pub state: u64,
    /// The newest study of it, perhaps of an older text.
    pub study: Option<Rc<Study>>,
    outline: OnceCell<Rc<Outline>>,
}

impl Document {
    /// A document that was opened.
    pub fn new(uri: String, place: Place, version: i32, text: Text) -> Self {
        let outline = OnceCell::new();
        Document { uri, place, version, text, state: 0, study: None, outline }
    }

    /// Its statements.
    pub fn outline(&self) -> Rc<Outline> {
        self.outline.get_or_init(|| Rc::new(outline::read(&self.text.text))).clone()
    }

    /// Takes in a new text.
    pub fn set(&mut self, text: Text, version: i32) {
        self.text = text;
        self.version = version;
        self.outline = OnceCell::new();
    }

    /// Whether what is known of it holds for its text and those of all files it uses.
    pub fn is_known(&self) -> bool {
        self.study.as_ref().is_some_and(|study| study.job.state >= self.state)
    }

    /// What is known of it, its places as they are now.
    pub fn known(&self) -> Option<Known> {
        let study = self.study.clone()?;
        let shift = Shift::between(study.text(), &self.text.text);
        Some(Known { study, shift })
    }
}

/// What is known of a document, with its places turned into those of its present text.
pub struct Known {
    /// The study.
    pub study: Rc<Study>,
    shift: Shift,
}

impl Known {
    /// The place `start..end` of the present text, as the study knows it.
    pub fn old(&self, start: usize, end: usize) -> Option<Span> {
        self.shift.older(Span::new(self.study.root, start, end))
    }

    /// Where a place of the study is now; places in other files stay.
    pub fn now(&self, span: Span) -> Option<Span> {
        if span.file == self.study.root { self.shift.newer(span) } else { Some(span) }
    }

    /// What the name at `start..end` means.
    pub fn definitions(&self, start: usize, end: usize, name: &str) -> Vec<&Definition> {
        let Some(span) = self.old(start, end) else { return Vec::new() };
        let places = self.study.declared(span);
        let all = places.into_iter().flat_map(|place| self.study.definitions(place));
        let found: Vec<&Definition> = all.collect();
        // Several names may be declared at one place; an alias has another name.
        if found.iter().any(|definition| definition.name == name) {
            found.into_iter().filter(|definition| definition.name == name).collect()
        } else {
            found
        }
    }

    /// What the shortest expression is worth that ends where a name ends and holds it.
    pub fn worth(&self, start: usize, end: usize) -> &[Worth] {
        let Some(span) = self.old(start, end) else { return &[] };
        let exact = self.study.facts.values.get(&span);
        let found = exact.or_else(|| {
            let first = Span { start: span.start.saturating_sub(400), end: 0, ..span };
            let around = self.study.facts.values.range(first..=span);
            around.rev().find(|(other, _)| other.end == span.end).map(|(_, worth)| worth)
        });
        found.map_or(&[], Vec::as_slice)
    }

    /// Edges of this document, with where their names stand now.
    pub fn edges(&self) -> impl Iterator<Item = (Span, &Edge)> {
        let own = self.study.facts.edges.iter().filter(|e| e.span.file == self.study.root);
        own.filter_map(|edge| Some((self.now(edge.span)?, edge)))
    }

    /// Seams of this document, with where their lines stand now.
    pub fn seams(&self) -> impl Iterator<Item = (Span, &Sewn)> {
        let own = self.study.facts.seams.iter().filter(|s| s.span.file == self.study.root);
        own.filter_map(|seam| Some((self.now(seam.span)?, seam)))
    }
}

/// Folders that the session knows.
#[derive(Debug, Default)]
pub struct Folders {
    /// Folders of the workspace.
    pub workspace: Vec<PathBuf>,
    /// Where the library lies for reading.
    pub library: Option<PathBuf>,
}

impl Folders {
    /// Where a document stands. A file in a folder of the workspace belongs to that project, any
    /// other file to its own folder.
    pub fn place(&self, address: &str) -> Place {
        let Some(path) = uri::path(address).map(|path| plain(&path)) else {
            // Untitled, or of a scheme that only the client can read.
            let name: String = address
                .chars()
                .map(|c| if c.is_alphanumeric() || "-_.".contains(c) { c } else { '_' })
                .take(200)
                .collect();
            return Place { folder: None, path: format!("untitled_{name}") };
        };
        if let Some(module) = self.module(&path) {
            return Place { folder: None, path: module };
        }
        let around = self.workspace.iter().filter(|folder| path.starts_with(folder));
        let around = around.max_by_key(|folder| folder.components().count());
        let folder = around.cloned().or_else(|| path.parent().map(Path::to_path_buf));
        let inside = folder.as_ref().and_then(|folder| path.strip_prefix(folder).ok());
        let parts: Option<Vec<&str>> =
            inside.map(|inside| inside.iter().map(|part| part.to_str()).collect()).unwrap_or(None);
        match parts {
            Some(parts) if !parts.is_empty() => Place { folder, path: parts.join("/") },
            _ => Place { folder: None, path: "untitled".to_owned() },
        }
    }

    /// The name of a library file that is open for reading.
    fn module(&self, path: &Path) -> Option<String> {
        let inside = path.strip_prefix(self.library.as_ref()?).ok()?;
        let stem = inside.to_str()?.strip_suffix(".garment")?;
        let name = format!("std::{stem}");
        crate::world::library::text(&name).map(|_| name)
    }

    /// The address of a file that a study has read, if it can be opened.
    pub fn address(&self, study: &Study, file: FileId) -> Option<String> {
        if file == study.root {
            return Some(study.job.uri.clone());
        }
        let path = study.desk.path(file);
        match path.strip_prefix("std::") {
            Some(name) => uri::of(&self.library.as_ref()?.join(format!("{name}.garment"))),
            None => uri::of(&study.job.place.folder.as_ref()?.join(path)),
        }
    }
}

/// A path without `.` and `..`.
pub fn plain(path: &Path) -> PathBuf {
    let mut out = PathBuf::new();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir => {
                out.pop();
            }
            part => out.push(part),
        }
    }
    out
}

/// The text of a file of a study, for its places.
pub fn text_of(study: &Study, file: FileId, like: &Text) -> Text {
    Text::new(Arc::from(study.desk.text(file)), like.encoding())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[cfg(not(windows))]
    fn a_file_belongs_to_the_nearest_folder_of_the_workspace() {
        let folders = Folders {
            workspace: vec!["/home".into(), "/home/skirts".into()],
            library: Some("/cache/library".into()),
        };
        let place = |uri| {
            let Place { folder, path } = folders.place(uri);
            (folder.map(|folder| folder.display().to_string()), path)
        };
        let some = |text: &str| Some(text.to_owned());
        assert_eq!(place("file:///home/a.garment"), (some("/home"), "a.garment".into()));
        assert_eq!(
            place("file:///home/skirts/x/../b.garment"),
            (some("/home/skirts"), "b.garment".into())
        );
        assert_eq!(place("file:///else/c.garment"), (some("/else"), "c.garment".into()));
        assert_eq!(place("file:///cache/library/fabric.garment"), (None, "std::fabric".into()));
        assert_eq!(place("untitled:U-1").0, None);
        assert_eq!(place("file:///").0, None);
    }
}
