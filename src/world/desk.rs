//! Texts that lie open in an editor, before the files of a project on the disk.

use super::{Disk, Opened, World};
use crate::diagnostic::{FileId, Texts};
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

/// The files of a project as an editor has them: what is open there counts, saved or not.
#[derive(Clone, Debug, Default)]
pub struct Desk {
    folder: Option<PathBuf>,
    open: Arc<BTreeMap<String, Arc<str>>>,
    opened: Opened,
}

impl Desk {
    /// The project in `folder`, if it has one, with the open texts by their paths in the project.
    pub fn new(folder: Option<PathBuf>, open: Arc<BTreeMap<String, Arc<str>>>) -> Self {
        Desk { folder, open, opened: Opened::default() }
    }

    /// Paths and texts of all files read so far, in the order of their numbers.
    pub fn files(&self) -> impl Iterator<Item = (FileId, &str, &str)> {
        let files = self.opened.files.iter();
        files.zip(0..).map(|((path, text), number)| (FileId(number), path.as_str(), text.as_str()))
    }
}

impl Texts for Desk {
    fn path(&self, file: FileId) -> &str {
        self.opened.path(file)
    }

    fn text(&self, file: FileId) -> &str {
        self.opened.text(file)
    }
}

impl World for Desk {
    fn open(&mut self, path: &str) -> Result<FileId, String> {
        let (folder, open) = (&self.folder, &self.open);
        self.opened.open(path, |path| match (open.get(path), folder) {
            (Some(text), _) => Ok(text.to_string()),
            (None, Some(folder)) => Disk::read(folder, path),
            (None, None) => Err(format!("this text is not saved yet, so `{path}` is not found")),
        })
    }

    fn bytes(&mut self, path: &str) -> Result<Vec<u8>, String> {
        let path = super::path::normal(path)?;
        match (self.open.get(&path), &self.folder) {
            (Some(text), _) => Ok(text.as_bytes().to_vec()),
            (None, Some(folder)) => Disk::read_bytes(folder, &path),
            (None, None) => Err(format!("this text is not saved yet, so `{path}` is not found")),
        }
    }

    fn take_in(&mut self, title: &str, text: &str) -> FileId {
        self.opened.take_in(title, text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_open_text_goes_before_the_file() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("a.garment"), "let a = 1").unwrap();
        std::fs::write(folder.path().join("b.garment"), "let b = 1").unwrap();
        let open = BTreeMap::from([("a.garment".to_owned(), Arc::from("let a = 2"))]);
        let mut desk = Desk::new(Some(folder.path().to_owned()), Arc::new(open));
        let (a, b) = (desk.open("a.garment").unwrap(), desk.open("b.garment").unwrap());
        assert_eq!((desk.text(a), desk.text(b)), ("let a = 2", "let b = 1"));
        assert!(desk.open("c.garment").is_err());
        assert_eq!(desk.files().count(), 2);
    }

    #[test]
    fn a_text_without_a_place_still_has_the_library() {
        let open = BTreeMap::from([("Untitled-1".to_owned(), Arc::from("let a = 2"))]);
        let mut desk = Desk::new(None, Arc::new(open));
        assert!(desk.open("Untitled-1").is_ok());
        assert!(desk.open("std::fabric").is_ok());
        assert!(desk.open("b.garment").unwrap_err().contains("not saved"));
    }
}
