//! Paths as the language writes them: relative, with `/`, inside the project.

/// The path `to` as written in the file `from`, seen from the project. Library paths
/// (`std::fabric`) stand for themselves.
///
/// # Errors
/// A sentence where the path is absolute or leaves the project.
pub fn beside(from: &str, to: &str) -> Result<String, String> {
    if to.starts_with("std::") {
        return normal(to);
    }
    match from.rsplit_once('/') {
        Some((folder, _)) if !to.starts_with('/') => normal(&format!("{folder}/{to}")),
        _ => normal(to),
    }
}

/// The path without `.` and `..`.
///
/// # Errors
/// A sentence where the path is absolute, empty, leaves the project, or holds signs that mean
/// different things on different systems.
pub fn normal(path: &str) -> Result<String, String> {
    if path.starts_with("std::") {
        return Ok(path.to_owned());
    }
    if path.starts_with('/') || path.contains(['\\', ':', '\0']) {
        return Err(format!(
            "`{path}` is not a path inside the project; write it with `/`, relative to this file"
        ));
    }
    let mut parts: Vec<&str> = Vec::new();
    for part in path.split('/') {
        match part {
            "" | "." => {}
            ".." => {
                if parts.pop().is_none() {
                    return Err(format!("`{path}` leaves the project"));
                }
            }
            part => parts.push(part),
        }
    }
    if parts.is_empty() {
        return Err(format!("`{path}` names no file"));
    }
    Ok(parts.join("/"))
}

/// Whether a path names a weaving file: `.wif` in any case, or `.plm`, as PixeLoom calls it.
pub fn is_draft(path: &str) -> bool {
    let end = path.rsplit_once('.').map_or("", |(_, end)| end);
    ["wif", "plm"].iter().any(|known| end.eq_ignore_ascii_case(known))
}

/// Whether a path names a file of a knitting program: knitout (`.k`), or a chart of KnitScape
/// (`.json`).
pub fn is_knitting(path: &str) -> bool {
    let end = path.rsplit_once('.').map_or("", |(_, end)| end);
    ["k", "json"].iter().any(|known| end.eq_ignore_ascii_case(known))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_relative_to_the_file_they_stand_in() {
        assert_eq!(
            beside("parts/collar.garment", "stand.garment"),
            Ok("parts/stand.garment".into())
        );
        assert_eq!(beside("parts/collar.garment", "../a.garment"), Ok("a.garment".into()));
        assert_eq!(beside("a.garment", "parts/./b.garment"), Ok("parts/b.garment".into()));
        assert_eq!(beside("parts/a.garment", "std::fabric"), Ok("std::fabric".into()));
    }

    #[test]
    fn nothing_leaves_the_project() {
        for path in ["../x", "a/../../x", "/etc/passwd", "c:\\x", "", ".", "a/.."] {
            assert!(normal(path).is_err(), "{path}");
        }
        assert!(beside("a/b.garment", "/etc/passwd").is_err());
    }
}
