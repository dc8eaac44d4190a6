//! The table of words: which properties and actions each kind of block knows, how they are
//! written, and what they are for. Checking, suggestions and help all read this one table.
//!
//! A word's pattern is its usage line and its grammar at once. `UPPER` stands for an operand,
//! `a|b` for one word of a choice, other words for themselves; a word with its operands is a
//! clause, and clauses may come in any order after the operands at the head. `[…]` may be left
//! out; of `(… | …)` exactly one is said, of `[… | …]` at most one. `UPPER, …` is a list with
//! commas, `UPPER -> …` one with arrows. `…` alone takes whatever follows.

mod figure;
mod file;
mod garment;
mod panel;
mod pattern;
mod scene;
mod textile;

pub use pattern::{Clause, Element, Many, Pattern};

use std::collections::BTreeMap;
use std::sync::{LazyLock, OnceLock};

/// Kinds of block, and of the things they make.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[allow(missing_docs)]
pub enum Kind {
    File,
    Garment,
    Block,
    Part,
    Scene,
    Panel,
    Outline,
    Wearer,
    Sizes,
    Body,
    Cloth,
    Solid,
    Drape,
    Picture,
    Yarn,
    Fabric,
    Kes,
    Fast,
    Weave,
    Knit,
    Motif,
    Legend,
    Sari,
    Ang,
    Kath,
    Padar,
}

impl Kind {
    /// With its article: `a panel`.
    pub fn title(self) -> &'static str {
        match self {
            Kind::File => "a file",
            Kind::Garment => "a garment",
            Kind::Block => "a block",
            Kind::Part => "a part",
            Kind::Scene => "a scene",
            Kind::Panel => "a panel",
            Kind::Outline => "an outline",
            Kind::Wearer => "a wearer",
            Kind::Sizes => "a table of sizes",
            Kind::Body => "a body",
            Kind::Cloth => "a cloth",
            Kind::Solid => "a solid",
            Kind::Drape => "a drape",
            Kind::Picture => "a picture",
            Kind::Yarn => "a yarn",
            Kind::Fabric => "a fabric",
            Kind::Kes => "a KES-F sheet",
            Kind::Fast => "a FAST sheet",
            Kind::Weave => "a weave",
            Kind::Knit => "a knit",
            Kind::Motif => "a motif",
            Kind::Legend => "a legend",
            Kind::Sari => "a sari",
            Kind::Ang => "an ang",
            Kind::Kath => "a kath",
            Kind::Padar => "a padar",
        }
    }

    /// Without article: `panel`.
    pub fn noun(self) -> &'static str {
        let title = self.title();
        title.split_once(' ').map_or(title, |(_, noun)| noun)
    }

    /// The library modules whose names are known where this kind is wanted.
    pub fn libraries(self) -> &'static [&'static str] {
        match self {
            Kind::Fabric => &["std::fabric"],
            Kind::Yarn => &["std::yarn"],
            Kind::Weave => &["std::weave"],
            Kind::Knit => &["std::knit"],
            Kind::Motif => &["std::motif"],
            Kind::Body | Kind::Sizes => &["std::body"],
            Kind::Kath => &["std::kath"],
            Kind::Padar => &["std::padar"],
            Kind::Ang => &["std::ang"],
            Kind::Block => super::module::BLOCKS,
            _ => &[],
        }
    }
}

/// How a word stands in the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// `word: value`
    Property,
    /// `word …`, perhaps with a label before it.
    Action,
    /// `word NAME …`: declares a name.
    Item,
}

/// A word of a block.
#[derive(Clone, Copy, Debug)]
pub struct Word {
    /// The word.
    pub name: &'static str,
    /// How it stands.
    pub form: Form,
    /// What follows it; see the module.
    pub pattern: &'static str,
    /// One line: what it is for, its default.
    pub help: &'static str,
    /// The kind of block at its end, if it may have one.
    pub block: Option<Kind>,
}

impl Word {
    /// The word with its pattern, to be shown as help.
    pub fn usage(&self) -> String {
        let colon = if self.form == Form::Property { ":" } else { "" };
        let block = if self.block.is_some() { " { … }" } else { "" };
        let gap = if self.pattern.is_empty() { "" } else { " " };
        let pattern = self
            .pattern
            .replace("( ", "(")
            .replace(" )", ")")
            .replace("[ ", "[")
            .replace(" ]", "]")
            .replace(",…", ", …")
            .replace("->…", " -> …");
        format!("{}{colon}{gap}{pattern}{block}", self.name)
    }

    /// Its pattern, read once.
    pub fn read(&self) -> &'static Pattern {
        let empty = pattern::empty();
        patterns().get(self.pattern).unwrap_or(empty)
    }
}

/// A property `name: pattern`.
pub(crate) const fn property(
    name: &'static str,
    pattern: &'static str,
    help: &'static str,
) -> Word {
    Word { name, form: Form::Property, pattern, help, block: None }
}

/// An action `name pattern`.
pub(crate) const fn action(name: &'static str, pattern: &'static str, help: &'static str) -> Word {
    Word { name, form: Form::Action, pattern, help, block: None }
}

/// An action that ends with a block.
pub(crate) const fn opening(
    name: &'static str,
    pattern: &'static str,
    block: Kind,
    help: &'static str,
) -> Word {
    Word { name, form: Form::Action, pattern, help, block: Some(block) }
}

/// An item `name NAME … { block }`.
pub(crate) const fn item(
    name: &'static str,
    pattern: &'static str,
    block: Kind,
    help: &'static str,
) -> Word {
    Word { name, form: Form::Item, pattern, help, block: Some(block) }
}

/// What a kind of block knows.
#[derive(Debug)]
pub struct Vocabulary {
    /// The kind.
    pub kind: Kind,
    /// Its words.
    pub words: &'static [Word],
    /// The pattern of lines with a key of the writer's own (`"EU 38": …`), where they are allowed.
    pub rows: Option<&'static Word>,
}

impl Vocabulary {
    /// The word of this name that stands as a property, or as a line.
    pub fn find(&self, name: &str, as_property: bool) -> Option<&'static Word> {
        self.words
            .iter()
            .find(|word| word.name == name && (word.form == Form::Property) == as_property)
    }
}

/// The vocabulary of a kind of block.
pub fn vocabulary(kind: Kind) -> &'static Vocabulary {
    static EMPTY: Vocabulary = Vocabulary { kind: Kind::File, words: &[], rows: None };
    tables().find(|table| table.kind == kind).unwrap_or(&EMPTY)
}

/// All vocabularies.
pub fn tables() -> impl Iterator<Item = &'static Vocabulary> {
    [file::TABLES, garment::TABLES, panel::TABLES, scene::TABLES, figure::TABLES, textile::TABLES]
        .into_iter()
        .flatten()
        .chain([&*BLOCK])
}

/// What a block knows: all that a garment does, but for what belongs to its wearing.
static BLOCK: LazyLock<Vocabulary> = LazyLock::new(|| {
    let garment = garment::TABLES.iter().find(|table| table.kind == Kind::Garment);
    let words = garment.map_or(&[][..], |table| table.words).iter();
    let own = words.filter(|word| !garment::WORN.contains(&word.name)).copied();
    Vocabulary { kind: Kind::Block, words: own.collect::<Vec<_>>().leak(), rows: None }
});

/// The patterns of the whole table, read on first use.
fn patterns() -> &'static BTreeMap<&'static str, Pattern> {
    static READ: OnceLock<BTreeMap<&'static str, Pattern>> = OnceLock::new();
    READ.get_or_init(|| {
        tables()
            .flat_map(|table| table.words.iter().chain(table.rows))
            .map(|word| (word.pattern, Pattern::read(word.pattern)))
            .collect()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_word_stands_once_and_has_help() {
        for table in tables() {
            for (i, word) in table.words.iter().enumerate() {
                assert!(!word.help.is_empty(), "{} of {:?} has no help", word.name, table.kind);
                let twin = table.words[..i].iter().any(|other| {
                    other.name == word.name
                        && (other.form == Form::Property) == (word.form == Form::Property)
                });
                assert!(!twin, "{} stands twice in {:?}", word.name, table.kind);
            }
        }
    }

    #[test]
    fn each_kind_has_one_table() {
        let mut kinds: Vec<Kind> = tables().map(|table| table.kind).collect();
        let before = kinds.len();
        kinds.sort();
        kinds.dedup();
        assert_eq!(kinds.len(), before);
        for word in tables().flat_map(|table| table.words) {
            if let Some(kind) = word.block {
                assert!(kinds.contains(&kind), "{kind:?} has no table");
            }
        }
    }
}
