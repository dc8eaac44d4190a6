//! Drapes that are known already, by the content they were made from.

use crate::drape::draped::Draped;
use crate::mesh::compiled::Compiled;
use serde::Serialize;
use std::path::PathBuf;

/// The folder for files that can be made again; none where the system names none.
pub(super) fn folder() -> Option<PathBuf> {
    let folder = std::env::var_os("XDG_CACHE_HOME")
        .map(PathBuf::from)
        .or_else(|| std::env::var_os("HOME").map(|home| PathBuf::from(home).join(".cache")))?;
    Some(folder.join("darzi"))
}

/// The place of one drape.
pub(super) struct Cache {
    file: PathBuf,
}

impl Cache {
    /// The place for the drape of `compiled`; none where the system names no folder for such
    /// files. Pictures and colours do not enter: another view of the same drape finds it.
    pub(super) fn of(compiled: &Compiled) -> Option<Self> {
        let folder = folder()?;
        let mut mesh = compiled.clone();
        mesh.pictures.clear();
        mesh.atlas = Default::default();
        for panel in &mut mesh.panels {
            panel.surfaces.clear();
        }
        // Another build of the program may drape otherwise, so its own bytes enter too.
        let program = std::fs::read(std::env::current_exe().ok()?).ok()?;
        let key = Key { program: *blake3::hash(&program).as_bytes(), mesh: &mesh };
        let bytes = postcard::to_stdvec(&key).ok()?;
        let name = blake3::hash(&bytes).to_hex();
        Some(Cache { file: folder.join(format!("{}.drape", &name[..32])) })
    }

    /// The drape, if it is there and whole.
    pub(super) fn load(&self, compiled: &Compiled) -> Option<Draped> {
        let bytes = std::fs::read(&self.file).ok()?;
        let (sum, body) = bytes.split_at_checked(32)?;
        if blake3::hash(body).as_bytes() != sum {
            return None;
        }
        let draped: Draped = postcard::from_bytes(body).ok()?;
        (draped.positions.len() == compiled.particles.len()).then_some(draped)
    }

    /// Keeps a drape. What cannot be kept is only made again next time, so nothing is said.
    pub(super) fn keep(&self, draped: &Draped) {
        let Ok(body) = postcard::to_stdvec(draped) else { return };
        if let Some(folder) = self.file.parent() {
            let _ = std::fs::create_dir_all(folder);
        }
        let sum = blake3::hash(&body);
        let _ = super::output::write(&self.file, |out| {
            out.write_all(sum.as_bytes())?;
            out.write_all(&body)
        });
    }
}

#[derive(Serialize)]
struct Key<'a> {
    program: [u8; 32],
    mesh: &'a Compiled,
}
