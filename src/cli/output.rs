//! Files are written whole or not at all: first beside their place, then renamed into it.

use super::Stop;
use std::io::Write;
use std::path::Path;

/// Writes `path` through `fill`.
pub(super) fn write(
    path: &Path,
    fill: impl FnOnce(&mut dyn Write) -> std::io::Result<()>,
) -> Result<(), Stop> {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let done = || -> std::io::Result<()> {
        let mut file = tempfile::Builder::new().prefix(".darzi-").tempfile_in(folder)?;
        {
            let mut buffer = std::io::BufWriter::with_capacity(1 << 20, file.as_file_mut());
            fill(&mut buffer)?;
            buffer.flush()?;
        }
        match std::fs::metadata(path) {
            Ok(old) => file.as_file().set_permissions(old.permissions())?,
            Err(_) => open_to_all(file.as_file())?,
        }
        file.persist(path)?;
        Ok(())
    };
    done().map_err(|e| Stop::Call(format!("cannot write `{}`: {e}", path.display())))
}

/// Gives a new file the rights that other programs give theirs; a temporary file is private.
#[cfg(unix)]
fn open_to_all(file: &std::fs::File) -> std::io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    file.set_permissions(std::fs::Permissions::from_mode(0o644))
}

#[cfg(not(unix))]
fn open_to_all(_file: &std::fs::File) -> std::io::Result<()> {
    Ok(())
}

/// Writes a picture as PNG.
pub(super) fn write_png(path: &Path, picture: impl Into<image::DynamicImage>) -> Result<(), Stop> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    picture
        .into()
        .write_to(&mut bytes, image::ImageFormat::Png)
        .map_err(|e| Stop::Call(format!("cannot encode `{}`: {e}", path.display())))?;
    write(path, |out| out.write_all(bytes.get_ref()))
}

/// Whether the folder of an output exists; told before hours of work, not after.
pub(super) fn expect_folder(path: &Path) -> Result<(), Stop> {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() && !folder.is_dir() => {
            Err(Stop::Call(format!("there is no folder `{}`", folder.display())))
        }
        _ if path.is_dir() => Err(Stop::Call(format!("`{}` is a folder", path.display()))),
        _ => Ok(()),
    }
}
