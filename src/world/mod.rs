//! Every read of a text goes through a [`World`]: the disk, the library inside the program,
//! or a table in memory for tests.

mod desk;
mod disk;
pub mod library;
mod memory;
pub mod path;

pub use desk::Desk;
pub use disk::Disk;
pub use memory::Memory;

use crate::diagnostic::{FileId, Texts};
use std::collections::BTreeMap;

/// Where the texts of `.garment` files come from.
pub trait World: Texts {
    /// The file at `path`: relative to the project (`parts/collar.garment`), or in the library
    /// (`std::fabric`). The same path gives the same number.
    ///
    /// # Errors
    /// A sentence saying why it cannot be read.
    fn open(&mut self, path: &str) -> Result<FileId, String>;

    /// The bytes of a file of the project that is no text, such as a picture.
    ///
    /// # Errors
    /// A sentence saying why it cannot be read.
    fn bytes(&mut self, path: &str) -> Result<Vec<u8>, String>;

    /// Takes in a text that is no file, such as an argument of the call, so that messages can
    /// show its places. `title` stands for its path; nothing can `use` it.
    fn take_in(&mut self, title: &str, text: &str) -> FileId;
}

/// The files opened so far.
#[derive(Clone, Debug, Default)]
struct Opened {
    files: Vec<(String, String)>,
    numbers: BTreeMap<String, FileId>,
}

impl Opened {
    /// The number of `path`, reading it with `read` the first time.
    fn open(
        &mut self,
        path: &str,
        read: impl FnOnce(&str) -> Result<String, String>,
    ) -> Result<FileId, String> {
        let path = path::normal(path)?;
        if let Some(&known) = self.numbers.get(&path) {
            return Ok(known);
        }
        let text = match library::text(&path) {
            Some(text) => text.to_owned(),
            None if path.starts_with("std::") => {
                let near = crate::diagnostic::spelling::nearest(&path, library::names());
                let near = near.map_or(String::new(), |near| format!("; did you mean `{near}`?"));
                return Err(format!("the library has no `{path}`{near}"));
            }
            None => read(&path)?,
        };
        let number = u32::try_from(self.files.len()).map_err(|_| "too many files".to_owned())?;
        self.files.push((path.clone(), text));
        self.numbers.insert(path, FileId(number));
        Ok(FileId(number))
    }

    /// A text that no path leads to.
    fn take_in(&mut self, title: &str, text: &str) -> FileId {
        let number = u32::try_from(self.files.len()).unwrap_or(u32::MAX);
        self.files.push((title.to_owned(), text.to_owned()));
        FileId(number)
    }

    fn get(&self, file: FileId) -> Option<&(String, String)> {
        self.files.get(usize::try_from(file.0).ok()?)
    }

    fn path(&self, file: FileId) -> &str {
        self.get(file).map_or("", |(path, _)| path)
    }

    fn text(&self, file: FileId) -> &str {
        self.get(file).map_or("", |(_, text)| text)
    }
}
