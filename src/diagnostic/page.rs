//! Pages that explain the codes, carried inside the program: what a code means, a wrong text and
//! a right one. They are written in Markdown under `docs/errors`, a group of codes in a file.
//!
//! A page begins with `## CODE: title`. Its examples are fenced: `garment wrong` and
//! `garment right`, followed by the name of the file if it is not the main one, or by
//! `--set NAME=VALUE` if it is called so.

/// The pages of each group of codes.
const GROUPS: [&str; 10] = [
    include_str!("../../docs/errors/text.md"),
    include_str!("../../docs/errors/names.md"),
    include_str!("../../docs/errors/values.md"),
    include_str!("../../docs/errors/outlines.md"),
    include_str!("../../docs/errors/seams.md"),
    include_str!("../../docs/errors/textiles.md"),
    include_str!("../../docs/errors/saris.md"),
    include_str!("../../docs/errors/draping.md"),
    include_str!("../../docs/errors/files.md"),
    include_str!("../../docs/errors/warnings.md"),
];

/// Begins the line of an example's fence.
const FENCE: &str = "```garment ";

/// The page of a code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Page {
    /// The code.
    pub code: &'static str,
    /// The title, the one of the table of codes.
    pub title: &'static str,
    /// What stands below the title, in Markdown.
    pub text: &'static str,
}

/// A text of a page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Example {
    /// Whether it is right.
    pub right: bool,
    /// The name of its file; none for the main one.
    pub file: Option<&'static str>,
    /// `NAME=VALUE` that is set from outside.
    pub set: Option<&'static str>,
    /// The text.
    pub text: &'static str,
}

/// All pages, in the order of their codes.
pub fn pages() -> impl Iterator<Item = Page> {
    GROUPS.into_iter().flat_map(|group| group.split("\n## ").skip(1)).filter_map(|page| {
        let (head, text) = page.split_once('\n')?;
        let (code, title) = head.split_once(": ")?;
        Some(Page { code, title, text: text.trim() })
    })
}

/// The page of a code.
pub fn page(code: &str) -> Option<Page> {
    pages().find(|page| page.code == code)
}

impl Page {
    /// Its examples.
    pub fn examples(&self) -> impl Iterator<Item = Example> {
        self.text.split(FENCE).skip(1).filter_map(|rest| {
            let (head, rest) = rest.split_once('\n')?;
            let (text, _) = rest.split_once("```")?;
            let (kind, rest) = head.split_once(' ').unwrap_or((head, ""));
            let set = rest.strip_prefix("--set ");
            let file = (set.is_none() && !rest.is_empty()).then_some(rest);
            Some(Example { right: kind == "right", file, set, text })
        })
    }

    /// The page for a terminal: the examples are indented below a line that says what they are.
    pub fn shown(&self) -> String {
        let mut out = format!("{}: {}\n\n", self.code, self.title);
        let mut inside = false;
        for line in self.text.lines() {
            if let Some(head) = line.strip_prefix(FENCE) {
                let (kind, rest) = head.split_once(' ').unwrap_or((head, ""));
                let title = if kind == "right" { "Right" } else { "Wrong" };
                let with = match rest.strip_prefix("--set ") {
                    Some(set) => format!(", with `--set {set}`"),
                    None if rest.is_empty() => String::new(),
                    None => format!(", in `{rest}`"),
                };
                out.push_str(&format!("{title}{with}:\n\n"));
                inside = true;
            } else if line.starts_with("```") {
                inside = false;
            } else if inside && !line.is_empty() {
                out.push_str(&format!("    {line}\n"));
            } else if inside {
                out.push('\n');
            } else {
                out.push_str(&format!("{}\n", line.trim_matches('*')));
            }
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostic::codes::CODES;

    #[test]
    fn every_code_has_its_page_and_every_page_its_code() {
        let written: Vec<_> = pages().map(|page| (page.code, page.title)).collect();
        let known: Vec<_> = CODES.iter().map(|code| (code.code, code.title)).collect();
        assert_eq!(written, known);
        for page in pages() {
            assert!(page.text.len() > 80, "{} explains nothing", page.code);
            assert!(page.text.lines().all(|line| line.chars().count() <= 100), "{}", page.code);
        }
    }

    #[test]
    fn a_page_is_shown_without_its_fences() {
        let page = page("E0212").unwrap();
        assert_eq!(page.examples().next().and_then(|wrong| wrong.set), Some("side=30cm;x:2cm"));
        let shown = page.shown();
        assert!(shown.starts_with("E0212: a value set from outside that cannot be read\n\n"));
        assert!(shown.contains("\nWrong, with `--set side=30cm;x:2cm`:\n\n    param side = 40cm"));
        assert!(!shown.contains("```"));
    }
}
