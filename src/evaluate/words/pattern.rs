//! Usage lines read as patterns.

use std::sync::OnceLock;

/// How often an operand may stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Many {
    /// Once.
    One,
    /// A list with commas, at least one.
    Commas,
    /// A list with arrows, at least two.
    Arrows,
}

/// One part of a pattern.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Element {
    /// The word itself, or `=`.
    Literal(&'static str),
    /// A value.
    Operand {
        /// Its name in the usage line: `LENGTH`; empty for a choice.
        name: &'static str,
        /// The words it may be; empty for a value.
        choice: Vec<&'static str>,
        /// How often.
        many: Many,
        /// Whether it must be given.
        required: bool,
    },
    /// Whatever follows.
    Rest,
}

/// A word with its operands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Clause {
    /// The word that begins it, or `=`.
    pub word: &'static str,
    /// What follows the word.
    pub elements: Vec<Element>,
    /// Number of its group in [`Pattern::groups`].
    pub group: usize,
}

/// A usage line taken apart.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Pattern {
    /// Operands before the first clause.
    pub head: Vec<Element>,
    /// Clauses, in any order.
    pub clauses: Vec<Clause>,
    /// Of each group at most one clause may be said; where true, one must be.
    pub groups: Vec<bool>,
}

/// The pattern of a word that stands alone.
pub(super) fn empty() -> &'static Pattern {
    static EMPTY: OnceLock<Pattern> = OnceLock::new();
    EMPTY.get_or_init(Pattern::default)
}

impl Pattern {
    /// Takes a usage line apart. The lines are the program's own and a test reads them all.
    pub(super) fn read(line: &'static str) -> Pattern {
        let mut pattern = Pattern::default();
        // Within brackets: the group, once it has a clause, and whether it is required.
        let mut bracket: Option<(Option<usize>, bool)> = None;
        let mut fresh = true;
        for token in line.split(' ').filter(|token| !token.is_empty()) {
            match token {
                "[" | "(" => {
                    bracket = Some((None, token == "("));
                    fresh = true;
                }
                "]" | ")" => {
                    bracket = None;
                    fresh = true;
                }
                "|" => fresh = true,
                "x" => pattern.push(Element::Literal("x")),
                "…" => pattern.push(Element::Rest),
                _ => {
                    let lower = token.starts_with(|c: char| !c.is_uppercase());
                    if lower && !token.contains('|') {
                        let group = match bracket {
                            Some((Some(group), _)) => group,
                            Some((None, required)) => {
                                pattern.groups.push(required);
                                bracket = Some((Some(pattern.groups.len() - 1), required));
                                pattern.groups.len() - 1
                            }
                            None => {
                                pattern.groups.push(true);
                                pattern.groups.len() - 1
                            }
                        };
                        pattern.clauses.push(Clause { word: token, elements: Vec::new(), group });
                        fresh = false;
                    } else {
                        let required = !(fresh && matches!(bracket, Some((None, false))));
                        pattern.push(operand(token, required));
                        // A bracket that begins with an operand belongs to the clause before it.
                    }
                }
            }
        }
        pattern
    }

    fn push(&mut self, element: Element) {
        match self.clauses.last_mut() {
            Some(clause) => clause.elements.push(element),
            None => self.head.push(element),
        }
    }

    /// The clause that a word begins.
    pub fn clause(&self, word: &str) -> Option<&Clause> {
        self.clauses.iter().find(|clause| clause.word == word)
    }

    /// Words that may be said here, for suggestions.
    pub fn words(&self) -> Vec<&'static str> {
        self.clauses.iter().map(|clause| clause.word).collect()
    }
}

/// Reads `LENGTH`, `EDGE,…`, `EDGE->…` or `knife|box`.
fn operand(token: &'static str, required: bool) -> Element {
    let (name, many) = if let Some(name) = token.strip_suffix(",…") {
        (name, Many::Commas)
    } else if let Some(name) = token.strip_suffix("->…") {
        (name, Many::Arrows)
    } else {
        (token, Many::One)
    };
    if name.contains('|') {
        Element::Operand { name: "", choice: name.split('|').collect(), many, required }
    } else {
        Element::Operand { name, choice: Vec::new(), many, required }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_usage_line_is_a_grammar() {
        let dart = Pattern::read(
            "on EDGE at POSITION width LENGTH ( depth LENGTH | to POINT ) [ pressed EDGE ]",
        );
        assert!(dart.head.is_empty());
        assert_eq!(dart.words(), ["on", "at", "width", "depth", "to", "pressed"]);
        let group =
            |word| dart.clause(word).map(|clause| (clause.group, dart.groups[clause.group]));
        assert_eq!(group("depth"), group("to"));
        assert_eq!(group("depth").map(|g| g.1), Some(true));
        assert_eq!(group("pressed").map(|g| g.1), Some(false));
    }

    #[test]
    fn sizes_and_lists_belong_to_their_operands() {
        let size = Pattern::read("LENGTH x LENGTH [ at PLACE ] [ through POINT,… ]");
        assert_eq!(size.head.len(), 3);
        assert!(matches!(
            size.clause("through").and_then(|clause| clause.elements.first()),
            Some(Element::Operand { many: Many::Commas, .. })
        ));
        let wearer = Pattern::read("[ NAME ] = FIGURE");
        assert!(matches!(wearer.head.first(), Some(Element::Operand { required: false, .. })));
        assert_eq!(wearer.words(), ["="]);
    }
}
