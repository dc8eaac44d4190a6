//! Texts that are at hand already.

use super::{Opened, World};
use crate::diagnostic::{FileId, Texts};
use std::collections::BTreeMap;

/// A project in memory.
#[derive(Clone, Debug, Default)]
pub struct Memory {
    texts: BTreeMap<String, String>,
    opened: Opened,
}

impl Memory {
    /// A project of these paths and texts.
    pub fn new<P: Into<String>, T: Into<String>>(files: impl IntoIterator<Item = (P, T)>) -> Self {
        let texts = files.into_iter().map(|(path, text)| (path.into(), text.into())).collect();
        Memory { texts, opened: Opened::default() }
    }
}

impl Texts for Memory {
    fn path(&self, file: FileId) -> &str {
        self.opened.path(file)
    }

    fn text(&self, file: FileId) -> &str {
        self.opened.text(file)
    }
}

impl World for Memory {
    fn open(&mut self, path: &str) -> Result<FileId, String> {
        let texts = &self.texts;
        self.opened.open(path, |path| {
            texts.get(path).cloned().ok_or_else(|| format!("there is no `{path}`"))
        })
    }

    fn bytes(&mut self, path: &str) -> Result<Vec<u8>, String> {
        let path = super::path::normal(path)?;
        let text = self.texts.get(&path).ok_or_else(|| format!("there is no `{path}`"))?;
        Ok(text.clone().into_bytes())
    }

    fn take_in(&mut self, title: &str, text: &str) -> FileId {
        self.opened.take_in(title, text)
    }
}
