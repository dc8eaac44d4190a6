//! Where two texts differ, shown in few lines.

use std::fmt::Write;

/// Places that are shown.
const PLACES: usize = 3;

/// Lines of a place that are shown of each text.
const LINES: usize = 6;

/// How far ahead the texts are searched for a line that they share.
const AHEAD: usize = 100;

/// The first differences between the old and the new text of the file `path`: each with its line
/// in the old text, `-` before old lines and `+` before new ones.
pub(super) fn shown(path: &str, old: &str, new: &str) -> String {
    let (old, new): (Vec<&str>, Vec<&str>) = (old.lines().collect(), new.lines().collect());
    let mut out = String::new();
    let (mut at, mut to) = (0, 0);
    let mut places = 0;
    while at < old.len() || to < new.len() {
        if let (Some(a), Some(b)) = (old.get(at), new.get(to))
            && a == b
        {
            (at, to) = (at + 1, to + 1);
            continue;
        }
        let (gone, come) = until_alike(&old[at..], &new[to..]);
        places += 1;
        if places <= PLACES {
            // Writing to a string cannot fail.
            let _ = writeln!(out, "{path}:{}", at + 1);
            lines(&mut out, '-', &old[at..at + gone]);
            lines(&mut out, '+', &new[to..to + come]);
        }
        (at, to) = (at + gone, to + come);
    }
    match places {
        0 => {
            let _ = writeln!(out, "{path}: the ends of its lines");
        }
        more if more > PLACES => {
            let _ = writeln!(out, "{path}: and {} more", more - PLACES);
        }
        _ => {}
    }
    out
}

fn lines(out: &mut String, sign: char, lines: &[&str]) {
    for line in lines.iter().take(LINES) {
        let _ = writeln!(out, "  {sign} {line}");
    }
    if lines.len() > LINES {
        let _ = writeln!(out, "  {sign} … {} lines more", lines.len() - LINES);
    }
}

/// How many lines of each text come before the next that they share; all where none is near.
/// Blank lines and lone braces are everywhere and show nothing.
fn until_alike(old: &[&str], new: &[&str]) -> (usize, usize) {
    for sum in 1..=2 * AHEAD {
        for gone in sum.saturating_sub(AHEAD)..=sum.min(AHEAD) {
            let come = sum - gone;
            if let (Some(a), Some(b)) = (old.get(gone), new.get(come))
                && a == b
                && a.trim().len() > 1
            {
                return (gone, come);
            }
        }
    }
    (old.len(), new.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_told_with_both_texts() {
        let old = "let a=1\nlet b = 2\nlet c = 3; let d = 4\nlet e = 5\n";
        let new = "let a = 1\nlet b = 2\nlet c = 3\nlet d = 4\nlet e = 5\n";
        assert_eq!(
            shown("x", old, new),
            "x:1\n  - let a=1\n  + let a = 1\nx:3\n  - let c = 3; let d = 4\n  + let c = 3\n  + let d = 4\n"
        );
    }

    #[test]
    fn what_is_long_is_cut_short() {
        let old: String = (0..20).map(|n| format!("a{n}\nsame{n}\n")).collect();
        let new = old.replace('a', "b").replace("sbme", "same");
        let told = shown("x", &old, &new);
        assert_eq!(told.lines().count(), PLACES * 3 + 1);
        assert!(told.ends_with("x: and 17 more\n"), "{told}");
        let other = "c\n".repeat(500);
        assert_eq!(shown("x", &old, &other).lines().count(), 2 * LINES + 3);
    }

    #[test]
    fn line_ends_alone_are_told() {
        assert_eq!(shown("x", "a\r\nb\n", "a\r\nb\r\n"), "x: the ends of its lines\n");
    }
}
