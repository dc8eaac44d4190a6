//! Files of a project on the disk.

use super::{Opened, World};
use crate::diagnostic::place::Lines;
use crate::diagnostic::{FileId, Texts};
use std::io::Read;
use std::path::{Path, PathBuf};

/// The files below one folder. Nothing outside it is read, links included.
#[derive(Clone, Debug)]
pub struct Disk {
    root: PathBuf,
    opened: Opened,
}

/// The longest file that is read, in bytes; one more than a text may have, so that the reader of
/// texts can tell where it is too long.
const LONGEST_FILE: u64 = (8 << 20) + 1;

/// The longest file of a weaving or knitting program. A lift plan of a thousand shafts is long, and
/// quickly read.
const LONGEST_DRAFT: u64 = (32 << 20) + 1;

/// The longest picture.
const LONGEST_PICTURE: u64 = (64 << 20) + 1;

impl Disk {
    /// The project in the folder `root`.
    pub fn new(root: impl Into<PathBuf>) -> Self {
        Disk { root: root.into(), opened: Opened::default() }
    }

    /// The bytes of a picture below `root`.
    pub(super) fn read_bytes(root: &Path, path: &str) -> Result<Vec<u8>, String> {
        Self::read_up_to(root, path, LONGEST_PICTURE)
    }

    fn read_up_to(root: &Path, path: &str, longest: u64) -> Result<Vec<u8>, String> {
        let said = |error: std::io::Error| match error.kind() {
            std::io::ErrorKind::NotFound => format!("there is no `{path}`{}", near(root, path)),
            std::io::ErrorKind::PermissionDenied => format!("`{path}` may not be read"),
            _ => format!("`{path}` cannot be read: {error}"),
        };
        let place = root.join(path).canonicalize().map_err(said)?;
        let root = root.canonicalize().map_err(said)?;
        if !place.starts_with(&root) {
            return Err(format!("`{path}` is a link that leaves the project"));
        }
        // Pipes and devices could keep a reader waiting for ever.
        if !place.metadata().map_err(said)?.is_file() {
            return Err(format!("`{path}` is not a file"));
        }
        let mut bytes = Vec::new();
        let file = std::fs::File::open(&place).map_err(said)?;
        file.take(longest).read_to_end(&mut bytes).map_err(said)?;
        if bytes.len() as u64 == longest {
            return Err(format!("`{path}` is longer than {} MB", longest >> 20));
        }
        Ok(bytes)
    }

    /// The text of a file below `root`.
    pub(super) fn read(root: &Path, path: &str) -> Result<String, String> {
        let draft = super::path::is_draft(path);
        let knitting = super::path::is_knitting(path);
        let longest = if draft || knitting { LONGEST_DRAFT } else { LONGEST_FILE };
        let bytes = Self::read_up_to(root, path, longest)?;
        if draft {
            return Ok(letters(bytes));
        }
        String::from_utf8(bytes).map_err(|error| {
            let at = error.utf8_error().valid_up_to();
            let sound = error.as_bytes().get(..at).unwrap_or_default();
            let sound = String::from_utf8_lossy(sound);
            let place = Lines::of(&sound).place(&sound, at);
            format!(
                "`{path}` is not UTF-8 text: byte {at}, in line {}, column {}, belongs to no character",
                place.line, place.column
            )
        })
    }
}

/// The bytes of a weaving file: UTF-8, UTF-16 by its mark, or else Latin-1, in which every byte is
/// a letter, as older programs write it.
fn letters(bytes: Vec<u8>) -> String {
    let wide = |of: fn([u8; 2]) -> u16| {
        let pairs: Vec<u16> =
            bytes.chunks_exact(2).skip(1).map(|two| of([two[0], two[1]])).collect();
        String::from_utf16_lossy(&pairs)
    };
    match bytes.as_slice() {
        [0xff, 0xfe, ..] => return wide(u16::from_le_bytes),
        [0xfe, 0xff, ..] => return wide(u16::from_be_bytes),
        _ => {}
    }
    match String::from_utf8(bytes) {
        Ok(text) => text,
        Err(error) => error.as_bytes().iter().map(|&byte| char::from(byte)).collect(),
    }
}

/// `; did you mean …` where the folder holds a file with a similar name.
fn near(root: &Path, path: &str) -> String {
    let (folder, name) = path.rsplit_once('/').unwrap_or(("", path));
    let Ok(entries) = std::fs::read_dir(root.join(folder)) else { return String::new() };
    let mut names: Vec<String> = entries
        .take(10_000)
        .flatten()
        .filter_map(|entry| entry.file_name().into_string().ok())
        .collect();
    names.sort_unstable();
    crate::diagnostic::spelling::nearest(name, names.iter().map(String::as_str)).map_or_else(
        String::new,
        |found| match folder {
            "" => format!("; did you mean `{found}`?"),
            folder => format!("; did you mean `{folder}/{found}`?"),
        },
    )
}

impl Texts for Disk {
    fn path(&self, file: FileId) -> &str {
        self.opened.path(file)
    }

    fn text(&self, file: FileId) -> &str {
        self.opened.text(file)
    }
}

impl World for Disk {
    fn open(&mut self, path: &str) -> Result<FileId, String> {
        let root = &self.root;
        self.opened.open(path, |path| Self::read(root, path))
    }

    fn bytes(&mut self, path: &str) -> Result<Vec<u8>, String> {
        Self::read_bytes(&self.root, &super::path::normal(path)?)
    }

    fn take_in(&mut self, title: &str, text: &str) -> FileId {
        self.opened.take_in(title, text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn project(files: &[(&str, &[u8])]) -> (tempfile::TempDir, Disk) {
        let folder = tempfile::tempdir().unwrap();
        for (path, bytes) in files {
            let place = folder.path().join("project").join(path);
            std::fs::create_dir_all(place.parent().unwrap()).unwrap();
            std::fs::write(place, bytes).unwrap();
        }
        let disk = Disk::new(folder.path().join("project"));
        (folder, disk)
    }

    #[test]
    fn one_path_has_one_number() {
        let (_folder, mut disk) = project(&[("parts/a.garment", b"let a = 1")]);
        let first = disk.open("parts/a.garment").unwrap();
        assert_eq!(disk.open("./parts/../parts/a.garment"), Ok(first));
        assert_eq!(disk.text(first), "let a = 1");
        assert_eq!(disk.path(first), "parts/a.garment");
    }

    #[test]
    fn says_why_a_file_cannot_be_read() {
        let (_folder, mut disk) =
            project(&[("skirt.garment", b""), ("bytes.garment", b"let a\n = \xff"), ("d/x", b"")]);
        let said = |disk: &mut Disk, path| disk.open(path).unwrap_err();
        assert!(said(&mut disk, "skrit.garment").contains("did you mean `skirt.garment`"));
        assert!(said(&mut disk, "bytes.garment").contains("line 2, column 4"));
        assert!(said(&mut disk, "d").contains("not a file"));
        assert!(said(&mut disk, "std::fabrik").contains("library"));
    }

    #[test]
    fn weaving_files_of_old_programs_are_latin() {
        let (_folder, mut disk) = project(&[
            ("a.WIF", b"K\xf6per"),
            ("b.wif", "Köper".as_bytes()),
            ("c.wif", b"\xff\xfeK\0\xf6\0p\0e\0r\0"),
            ("d.plm", b"\xfe\xff\0K\0\xf6\0p\0e\0r"),
        ]);
        for path in ["a.WIF", "b.wif", "c.wif", "d.plm"] {
            let id = disk.open(path).unwrap();
            assert_eq!(disk.text(id), "Köper");
        }
    }

    #[cfg(unix)]
    #[test]
    fn links_out_of_the_project_are_refused() {
        let (folder, mut disk) = project(&[("a.garment", b"")]);
        let outside = folder.path().join("secret");
        std::fs::write(&outside, b"x").unwrap();
        std::os::unix::fs::symlink(&outside, folder.path().join("project/b.garment")).unwrap();
        assert!(disk.open("b.garment").unwrap_err().contains("leaves the project"));
    }
}
