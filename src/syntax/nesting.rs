//! How deep brackets may stand in brackets. The limit keeps every later stage that walks the
//! tree within its stack.

use crate::diagnostic::{Diagnostic, Span};

/// Brackets and braces inside each other.
const DEEPEST_BRACKETS: usize = 128;

/// Levels of the tree of one value: brackets, operators, calls.
pub(super) const DEEPEST_VALUE: u32 = 256;

/// `else if` after `else if`.
pub(super) const LONGEST_CHOICE: usize = 128;

/// The diagnostic for a place that lies too deep.
pub(super) fn told(at: Span) -> Diagnostic {
    Diagnostic::new("E0111", "this is nested too deep to be read")
        .at(at, "here")
        .help("give the inner parts names with `let`, or close a bracket that was left open")
}

/// The first bracket that lies deeper than brackets may, outside comments, strings and charts.
pub(super) fn too_deep(text: &str) -> Option<usize> {
    let bytes = text.as_bytes();
    let mut depth = 0_usize;
    let mut at = 0;
    while let Some(&byte) = bytes.get(at) {
        match byte {
            b'(' | b'[' | b'{' => {
                depth += 1;
                if depth > DEEPEST_BRACKETS {
                    return Some(at);
                }
            }
            b')' | b']' | b'}' => depth = depth.saturating_sub(1),
            b'/' if bytes.get(at + 1) == Some(&b'/') => at = line_end(bytes, at),
            b'"' => at = string_end(bytes, at),
            b'|' => {
                let end = line_end(bytes, at);
                let line = bytes.get(at + 1..end).unwrap_or_default();
                at = line.iter().rposition(|&b| b == b'|').map_or(end, |last| at + 1 + last);
            }
            _ => {}
        }
        at += 1;
    }
    None
}

fn line_end(bytes: &[u8], from: usize) -> usize {
    let rest = bytes.get(from..).unwrap_or_default();
    rest.iter().position(|b| matches!(b, b'\n' | b'\r')).map_or(bytes.len(), |n| from + n)
}

/// The closing quotation mark, or the end of the line where there is none.
fn string_end(bytes: &[u8], open: usize) -> usize {
    let mut at = open + 1;
    while let Some(&byte) = bytes.get(at) {
        match byte {
            b'"' | b'\n' | b'\r' => return at,
            b'\\' => at += 2,
            _ => at += 1,
        }
    }
    bytes.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_only_brackets_that_are_open_at_once() {
        assert_eq!(too_deep(&"()".repeat(1_000)), None);
        assert_eq!(too_deep(&"(".repeat(DEEPEST_BRACKETS)), None);
        assert_eq!(too_deep(&"(".repeat(DEEPEST_BRACKETS + 1)), Some(DEEPEST_BRACKETS));
    }

    #[test]
    fn brackets_in_comments_strings_and_charts_do_not_count() {
        let many = "{".repeat(500);
        assert_eq!(too_deep(&format!("// {many}\nnote: \"{many}\\\"{many}\"\n|{many}|")), None);
    }
}
