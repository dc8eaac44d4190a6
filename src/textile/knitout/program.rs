//! A program of a flat knitting machine with two beds, line by line.

use crate::diagnostic::Span;

/// A row of needles.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Bed {
    /// The needles next to the knitter; loops are drawn towards them.
    Front,
    /// The needles behind.
    Back,
    /// The sliders of the front bed, which hold loops and cannot knit.
    FrontSlider,
    /// The sliders of the back bed.
    BackSlider,
}

impl Bed {
    /// Whether it belongs to the front.
    pub fn is_front(self) -> bool {
        matches!(self, Bed::Front | Bed::FrontSlider)
    }

    /// Whether it only holds loops.
    pub fn is_slider(self) -> bool {
        matches!(self, Bed::FrontSlider | Bed::BackSlider)
    }

    /// As it stands before the number of a needle.
    pub fn prefix(self) -> &'static str {
        match self {
            Bed::Front => "f",
            Bed::Back => "b",
            Bed::FrontSlider => "fs",
            Bed::BackSlider => "bs",
        }
    }
}

/// A needle by its number, which grows to the right and may be negative.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Needle {
    /// Its bed.
    pub bed: Bed,
    /// Its number.
    pub number: i32,
}

impl Needle {
    /// The needle of the front bed with this number.
    pub fn front(number: i32) -> Needle {
        Needle { bed: Bed::Front, number }
    }

    /// The needle of the back bed with this number.
    pub fn back(number: i32) -> Needle {
        Needle { bed: Bed::Back, number }
    }

    /// Whether loops can go over to another needle while the beds are racked so far: at racking R
    /// the back needle B faces the front needle B + R.
    pub fn faces(self, other: Needle, racking: f64) -> bool {
        let (front, back) = match (self.bed.is_front(), other.bed.is_front()) {
            (true, false) => (self, other),
            (false, true) => (other, self),
            _ => return false,
        };
        f64::from(front.number) == f64::from(back.number) + racking
    }
}

impl std::fmt::Display for Needle {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}{}", self.bed.prefix(), self.number)
    }
}

/// The way a carriage goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Direction {
    /// `-`, to smaller numbers.
    Left,
    /// `+`, to larger numbers.
    Right,
}

impl Direction {
    /// The sign in the text.
    pub fn sign(self) -> char {
        match self {
            Direction::Left => '-',
            Direction::Right => '+',
        }
    }
}

/// A carrier by its place in [`Program::carriers`].
pub type Carrier = u16;

/// What a carrier is told to do that is not knitting.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[allow(missing_docs)]
pub enum Yarn {
    In,
    Inhook,
    Releasehook,
    Out,
    Outhook,
}

impl Yarn {
    /// The word of the text.
    pub fn word(self) -> &'static str {
        match self {
            Yarn::In => "in",
            Yarn::Inhook => "inhook",
            Yarn::Releasehook => "releasehook",
            Yarn::Out => "out",
            Yarn::Outhook => "outhook",
        }
    }
}

/// How a loop is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Making {
    /// Drawn through the loops of the needle, which it lets go.
    Knit,
    /// Laid beside the loops of the needle.
    Tuck,
    /// No loop: the carriers only pass the needle.
    Miss,
}

impl Making {
    /// The word of the text.
    pub fn word(self) -> &'static str {
        match self {
            Making::Knit => "knit",
            Making::Tuck => "tuck",
            Making::Miss => "miss",
        }
    }
}

/// An operation.
#[derive(Clone, Debug, PartialEq)]
pub enum Operation {
    /// Carriers go in or out of action.
    Yarn(Yarn, Vec<Carrier>),
    /// How far needles pull before and after a loop, in units of the machine.
    Stitch([f64; 2]),
    /// How far the back bed stands to the right of the front bed, in needles.
    Rack(f64),
    /// A loop, or a carrier that passes.
    Make {
        /// Which.
        making: Making,
        /// The way of the carriage.
        direction: Direction,
        /// Where.
        needle: Needle,
        /// With what; none lets loops fall, or only pulls at them.
        carriers: Vec<Carrier>,
    },
    /// A loop drawn through those of a needle, which go over to another.
    Split {
        /// The way of the carriage.
        direction: Direction,
        /// Whose loops.
        from: Needle,
        /// Where they go.
        to: Needle,
        /// With what.
        carriers: Vec<Carrier>,
    },
    /// The loops of a needle fall.
    Drop(Needle),
    /// The loops of a needle are pulled at.
    Amiss(Needle),
    /// The loops of a needle go over to another.
    Xfer(Needle, Needle),
    /// The machine waits for its operator.
    Pause(String),
    /// An operation of some machines: its word, which begins with `x-`, and its operands.
    Extension(String, String),
}

/// What stands in a line before its comment.
#[derive(Clone, Debug, PartialEq)]
pub enum Content {
    /// Nothing.
    Nothing,
    /// `;;Name: value`, before the first operation.
    Header {
        /// Its name.
        name: String,
        /// Its value.
        value: String,
    },
    /// What the machine does.
    Operation(Operation),
}

/// A line.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// What is said in it.
    pub content: Content,
    /// What follows its `;`.
    pub comment: Option<String>,
    /// Where it stands; nowhere in a program that was not read from a text.
    pub span: Span,
}

impl Line {
    /// An operation that stands in no text.
    pub fn of(operation: Operation) -> Line {
        Line { content: Content::Operation(operation), comment: None, span: Span::default() }
    }

    /// A header that stands in no text.
    pub fn header(name: &str, value: impl Into<String>) -> Line {
        let content = Content::Header { name: name.to_owned(), value: value.into() };
        Line { content, comment: None, span: Span::default() }
    }

    /// A line with nothing but a comment that stands in no text.
    pub fn comment(text: impl Into<String>) -> Line {
        Line { content: Content::Nothing, comment: Some(text.into()), span: Span::default() }
    }
}

/// A program.
#[derive(Clone, Debug, PartialEq)]
pub struct Program {
    /// The version of the format.
    pub version: u32,
    /// The names of the carriers, from the front to the back.
    pub carriers: Vec<String>,
    /// All lines after the first.
    pub lines: Vec<Line>,
}

impl Program {
    /// The value of a header.
    pub fn header(&self, wanted: &str) -> Option<&str> {
        self.lines.iter().find_map(|line| match &line.content {
            Content::Header { name, value } if name == wanted => Some(value.as_str()),
            _ => None,
        })
    }

    /// The operations, in their order.
    pub fn operations(&self) -> impl Iterator<Item = &Operation> {
        self.lines.iter().filter_map(|line| match &line.content {
            Content::Operation(operation) => Some(operation),
            _ => None,
        })
    }
}
