//! The symbols of knitters' charts.

use super::Stitch;
use serde::{Deserialize, Serialize};

/// The way a stitch slants, as seen on the face.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
#[allow(missing_docs)]
pub enum Lean {
    Left,
    Right,
}

/// Stitches that change places.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Cable {
    /// Stitches that cross in front.
    pub front: u8,
    /// Stitches that cross behind.
    pub behind: u8,
    /// The way those in front go.
    pub lean: Lean,
    /// Whether those behind are purled.
    pub purl: bool,
}

impl Cable {
    /// Stitches that one side of a cable may have.
    pub const MOST: u8 = 12;

    /// Columns it covers.
    pub fn width(self) -> usize {
        usize::from(self.front) + usize::from(self.behind)
    }

    /// Whether the stitch that comes to lie in this column of the cable is one of those in front.
    pub fn is_front(self, column: usize) -> bool {
        match self.lean {
            Lean::Left => column < usize::from(self.front),
            Lean::Right => column >= usize::from(self.behind),
        }
    }
}

/// A cell of a chart as seen on the face; a cable is the same symbol in each of its columns.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Symbol {
    /// Drawn through to the face.
    Knit,
    /// Drawn through to the back.
    Purl,
    /// Moved over unworked, the yarn behind it.
    Slip,
    /// The yarn laid over the loop, to be worked with it in the next row.
    Tuck,
    /// A new loop of yarn laid over the needle, which leaves a hole.
    YarnOver,
    /// Two or three worked as one.
    Together {
        /// Two or three.
        stitches: u8,
        /// The way it slants.
        lean: Lean,
        /// Whether they are purled.
        purl: bool,
    },
    /// Three worked as one, the middle one on top.
    Centred,
    /// A new loop from the strand between two stitches.
    Made(Lean),
    /// Several stitches out of one, knitted to and fro and worked as one again.
    Bobble,
    /// No stitch at all: the chart only keeps its columns.
    NoStitch,
    /// Stitches that change places.
    Cable(Cable),
}

/// The symbols that a word names, with the word as knitters write it, what it is and whether it
/// belongs to rows seen from the face only.
const WORDS: [(&str, Symbol, &str); 17] = [
    ("knit", Symbol::Knit, "knit"),
    ("purl", Symbol::Purl, "purl"),
    ("slip", Symbol::Slip, "slip"),
    ("tuck", Symbol::Tuck, "tuck"),
    ("yo", Symbol::YarnOver, "yarn over"),
    ("k2tog", together(2, Lean::Right, false), "knit 2 together"),
    ("ssk", together(2, Lean::Left, false), "slip, slip, knit"),
    ("k3tog", together(3, Lean::Right, false), "knit 3 together"),
    ("sssk", together(3, Lean::Left, false), "slip 3, knit together"),
    ("p2tog", together(2, Lean::Right, true), "purl 2 together"),
    ("ssp", together(2, Lean::Left, true), "slip, slip, purl"),
    ("p3tog", together(3, Lean::Right, true), "purl 3 together"),
    ("cdd", Symbol::Centred, "centred double decrease"),
    ("m1l", Symbol::Made(Lean::Left), "make 1 left"),
    ("m1r", Symbol::Made(Lean::Right), "make 1 right"),
    ("bobble", Symbol::Bobble, "bobble"),
    ("no_stitch", Symbol::NoStitch, "no stitch"),
];

const fn together(stitches: u8, lean: Lean, purl: bool) -> Symbol {
    Symbol::Together { stitches, lean, purl }
}

impl Symbol {
    /// The symbol of that word: `k2tog`, `yo`, `no_stitch`; `face` and `back` are knit and purl.
    pub fn named(word: &str) -> Option<Symbol> {
        match word {
            "face" => return Some(Symbol::Knit),
            "back" => return Some(Symbol::Purl),
            _ => {}
        }
        WORDS.iter().find(|(known, ..)| *known == word).map(|(_, symbol, _)| *symbol)
    }

    /// All words that [`Symbol::named`] knows.
    pub fn words() -> impl Iterator<Item = &'static str> {
        WORDS.iter().map(|(word, ..)| *word).chain(["face", "back"])
    }

    /// As it is written in words: `k2tog`, `2/2 LC`.
    pub fn word(self) -> String {
        if let Symbol::Cable(cable) = self {
            let side = if cable.lean == Lean::Left { "L" } else { "R" };
            let purl = if cable.purl { "P" } else { "" };
            return format!("{}/{} {side}{purl}C", cable.front, cable.behind);
        }
        self.known().map_or_else(String::new, |(word, ..)| (*word).to_owned())
    }

    /// What it is, in a few words.
    pub fn meaning(self) -> String {
        if let Symbol::Cable(cable) = self {
            let side = if cable.lean == Lean::Left { "left" } else { "right" };
            let purl = if cable.purl { ", purled behind" } else { "" };
            return format!("cable {} over {} to the {side}{purl}", cable.front, cable.behind);
        }
        self.known().map_or_else(String::new, |(.., meaning)| (*meaning).to_owned())
    }

    fn known(self) -> Option<&'static (&'static str, Symbol, &'static str)> {
        WORDS.iter().find(|(_, symbol, _)| *symbol == self)
    }

    /// Stitches of the row below that it works.
    pub fn uses(self) -> usize {
        match self {
            Symbol::YarnOver | Symbol::Made(_) | Symbol::NoStitch => 0,
            Symbol::Together { stitches, .. } => usize::from(stitches),
            Symbol::Centred => 3,
            _ => 1,
        }
    }

    /// Stitches it leaves to the row above.
    pub fn leaves(self) -> usize {
        usize::from(self != Symbol::NoStitch)
    }

    /// The loop that is seen in this column of it, of a cable counted from its left.
    pub fn stitch(self, column: usize) -> Stitch {
        match self {
            Symbol::Purl | Symbol::Together { purl: true, .. } => Stitch::Back,
            Symbol::Cable(cable) if cable.purl && !cable.is_front(column) => Stitch::Back,
            _ => Stitch::Face,
        }
    }

    /// How the same stitch is charted from behind, where it is.
    pub fn behind(self) -> Option<Symbol> {
        let other = |lean| if lean == Lean::Left { Lean::Right } else { Lean::Left };
        match self {
            Symbol::Knit => Some(Symbol::Purl),
            Symbol::Purl => Some(Symbol::Knit),
            Symbol::Together { stitches, lean, purl } if stitches == 2 => {
                Some(together(stitches, other(lean), !purl))
            }
            Symbol::Made(lean) => Some(Symbol::Made(other(lean))),
            Symbol::Slip | Symbol::Tuck | Symbol::YarnOver | Symbol::NoStitch => Some(self),
            Symbol::Together { .. } | Symbol::Centred | Symbol::Bobble | Symbol::Cable(_) => None,
        }
    }

    /// What is charted where this is worked on the wrong side: what a knitter purls there is seen
    /// as knitted.
    pub fn from_wrong_side(self) -> Symbol {
        match self {
            Symbol::Knit => Symbol::Purl,
            Symbol::Purl => Symbol::Knit,
            Symbol::Together { stitches, lean, purl } if self != together(3, Lean::Left, false) => {
                together(stitches, lean, !purl)
            }
            _ => self,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_word_names_its_symbol() {
        for (word, symbol, _) in WORDS {
            assert_eq!(Symbol::named(word), Some(symbol));
            assert_eq!(symbol.word(), word);
        }
        let cable = Symbol::Cable(Cable { front: 2, behind: 1, lean: Lean::Left, purl: true });
        assert_eq!(cable.word(), "2/1 LPC");
        let seen: Vec<Stitch> = (0..3).map(|column| cable.stitch(column)).collect();
        assert_eq!(seen, [Stitch::Face, Stitch::Face, Stitch::Back]);
    }

    #[test]
    fn what_is_seen_from_behind_twice_is_itself() {
        for (_, symbol, _) in WORDS {
            if let Some(behind) = symbol.behind() {
                assert_eq!(behind.behind(), Some(symbol));
                assert_eq!((behind.uses(), behind.leaves()), (symbol.uses(), symbol.leaves()));
            }
        }
    }
}
