//! Every read of a text goes through a [`World`]: the disk, the library inside the program,
//! or a table in memory for tests.

use crate::diagnostic::FileId;

/// Where the texts of `.garment` files come from.
pub trait World {
    /// The file at `path`: relative to the project (`parts/collar.garment`), or in the library
    /// (`std::fabric`). The same path gives the same number.
    ///
    /// # Errors
    /// A sentence saying why it cannot be read.
    fn open(&mut self, path: &str) -> Result<FileId, String>;

    /// The path that was opened as `file`, for messages.
    fn path(&self, file: FileId) -> &str;

    /// The text of `file`.
    fn text(&self, file: FileId) -> &str;
}
