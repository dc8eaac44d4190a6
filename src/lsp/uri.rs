//! Addresses of documents: `file:///home/me/a%20skirt.garment` and places on the disk.

use std::fmt::Write;
use std::path::{Path, PathBuf};

/// The place of a `file:` address; none for any other address.
pub fn path(uri: &str) -> Option<PathBuf> {
    let rest = strip_scheme(uri)?;
    let rest = rest.split(['?', '#']).next().unwrap_or(rest);
    let local = match rest.strip_prefix("//") {
        // `file://host/…` names another machine.
        Some(after) => {
            let (host, _) = after.split_once('/')?;
            if !(host.is_empty() || host.eq_ignore_ascii_case("localhost")) {
                return None;
            }
            after.get(host.len()..)?
        }
        None => rest,
    };
    let plain = decoded(local)?;
    // `/C:/work` on systems with drives.
    let plain = match plain.as_bytes() {
        [b'/', letter, b':', ..] if cfg!(windows) && letter.is_ascii_alphabetic() => {
            plain.get(1..)?.to_owned()
        }
        _ => plain,
    };
    let path = PathBuf::from(plain);
    path.is_absolute().then_some(path)
}

fn strip_scheme(uri: &str) -> Option<&str> {
    let (scheme, rest) = uri.split_once(':')?;
    scheme.eq_ignore_ascii_case("file").then_some(rest)
}

fn decoded(text: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.bytes();
    while let Some(byte) = rest.next() {
        if byte != b'%' {
            bytes.push(byte);
            continue;
        }
        let high = char::from(rest.next()?).to_digit(16)?;
        let low = char::from(rest.next()?).to_digit(16)?;
        bytes.push(u8::try_from(high * 16 + low).ok()?);
    }
    String::from_utf8(bytes).ok().filter(|text| !text.contains('\0'))
}

/// The address of a place on the disk; none where it is not written in UTF-8.
pub fn of(path: &Path) -> Option<String> {
    let text = path.to_str()?;
    let mut uri = "file://".to_owned();
    if !text.starts_with('/') {
        uri.push('/');
    }
    for byte in text.bytes() {
        match byte {
            b'\\' if cfg!(windows) => uri.push('/'),
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'/' | b'-' | b'_' | b'.' | b'~' => {
                uri.push(char::from(byte));
            }
            _ => write!(uri, "%{byte:02X}").ok()?,
        }
    }
    Some(uri)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[cfg(not(windows))]
    fn places_and_addresses_go_both_ways() {
        for place in ["/a/b.garment", "/a b/काठ.garment", "/a%20b/c#d?e.garment"] {
            let uri = of(Path::new(place)).unwrap();
            assert_eq!(path(&uri), Some(PathBuf::from(place)), "{uri}");
        }
        assert_eq!(of(Path::new("/a b")).unwrap(), "file:///a%20b");
        assert_eq!(path("file:///a%20b"), Some(PathBuf::from("/a b")));
        assert_eq!(path("FILE:///a"), Some(PathBuf::from("/a")));
        assert_eq!(path("file://localhost/a"), Some(PathBuf::from("/a")));
    }

    #[test]
    fn other_addresses_are_no_places() {
        for uri in [
            "untitled:Untitled-1",
            "",
            "file:",
            "file://host/a",
            "file:///%",
            "file:///%ff",
            "file:///a%00b",
            "http://a/b",
            "relative.garment",
        ] {
            assert_eq!(path(uri), None, "{uri}");
        }
    }
}
