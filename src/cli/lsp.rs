//! `darzi lsp`: the language server for editors.

use super::{Stop, output};
use crate::world::library;
use std::path::PathBuf;

#[derive(Debug, clap::Args)]
#[command(
    after_help = "Editors start this by themselves and talk to it on standard input and output;
docs/editors.md says how to set up VS Code, Neovim, Helix and Emacs."
)]
pub(super) struct Lsp {
    /// Talk on standard input and output; the only way there is, so it may be left out
    #[arg(long)]
    stdio: bool,
}

impl Lsp {
    pub(super) fn run(self) -> Result<(), Stop> {
        // Names of the library lead to its files, where every editor can open them.
        crate::lsp::run(lay_out()).map_err(Stop::Call)
    }
}

/// Writes the library beside other files that can be made again, for reading, and gives its
/// folder; none where that is not possible.
fn lay_out() -> Option<PathBuf> {
    let folder = super::cache::folder()?.join("library").join(env!("CARGO_PKG_VERSION"));
    std::fs::create_dir_all(&folder).ok()?;
    for name in library::names() {
        let text = library::text(name)?;
        let file = folder.join(format!("{}.garment", name.strip_prefix("std::")?));
        if std::fs::read_to_string(&file).is_ok_and(|old| old == text) {
            continue;
        }
        output::write(&file, |out| out.write_all(text.as_bytes())).ok()?;
        let mut rights = file.metadata().ok()?.permissions();
        rights.set_readonly(true);
        std::fs::set_permissions(&file, rights).ok()?;
    }
    folder.canonicalize().ok()
}
