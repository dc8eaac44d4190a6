//! The tree of a `.garment` text, with places. The grammar knows a few shapes of statement and
//! no vocabulary; words are matched later against the table of words.

use crate::diagnostic::Span;
use serde::{Deserialize, Serialize};

/// A name with its place. Text is in Unicode normal form C.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Name {
    /// The name.
    pub text: String,
    /// Where it stands.
    pub span: Span,
}

/// A whole file.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct File {
    /// Its items, in the order of the text.
    pub statements: Vec<Statement>,
}

/// `{ … }`
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Block {
    /// From brace to brace.
    pub span: Span,
    /// What stands inside.
    pub statements: Vec<Statement>,
}

/// One statement.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Statement {
    /// The whole statement, blocks included.
    pub span: Span,
    /// The `///` lines above it, without the slashes, joined by newlines; empty if none.
    pub doc: String,
    /// What it is.
    pub kind: StatementKind,
}

/// The shapes of statement.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum StatementKind {
    /// `use "parts/collar.garment"::{collar, stand}, std::body::female as woman`
    Use(Vec<Source>),
    /// `let w = lady.waist / 4`
    Let {
        /// The new name.
        name: Name,
        /// Its value.
        value: Expr,
    },
    /// `param ease = 2cm in 0cm..8cm`, `param neck: length`
    Param {
        /// The new name.
        name: Name,
        /// The kind said after the colon.
        kind: Option<Name>,
        /// The value if nobody sets another.
        default: Option<Expr>,
        /// What it may lie in: a range or a list of options.
        range: Option<Expr>,
    },
    /// `fn quarter(girth: length, ease: length = 0cm): length = (girth + ease) / 4`
    Function {
        /// The new name.
        name: Name,
        /// Its formal parameters.
        formals: Vec<Formal>,
        /// The kind of the result.
        kind: Option<Name>,
        /// The body.
        value: Expr,
    },
    /// `for i in 1..6 { … }`
    For {
        /// The counting name.
        name: Name,
        /// A finite range or a list.
        over: Expr,
        /// What is repeated.
        body: Block,
    },
    /// `if hooded { … } else { … }`
    If {
        /// The condition.
        condition: Expr,
        /// When it holds.
        then: Block,
        /// When it does not; `else if` is an `If` alone in a block.
        otherwise: Option<Block>,
    },
    /// `key: value…`. The value may hold an action (`side: line by …`), a label's action
    /// (`shaping: dart on …`), a drawing, a block, or items followed by a block.
    Property {
        /// What stands before the colon: a name, a string such as `"EU 38"`, or `2HB`.
        key: Name,
        /// The items after it.
        phrase: Vec<Item>,
        /// Rows of a drawing between bars.
        drawing: Vec<Row>,
        /// A block at its end.
        block: Option<Block>,
    },
    /// A word with operands: an item (`panel front of denim { … }`) or an action
    /// (`dart on waist at 50% …`).
    Line {
        /// Its first word.
        word: Name,
        /// The items after it.
        phrase: Vec<Item>,
        /// A block at its end.
        block: Option<Block>,
    },
}

/// A file or a library module named by `use`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Source {
    /// The whole source.
    pub span: Span,
    /// A quoted path, or the names of `std::body::female`.
    pub from: SourcePath,
    /// The names in braces, or the one after `::` behind a quoted path; empty for all.
    pub names: Vec<Name>,
    /// `as woman`
    pub alias: Option<Name>,
}

/// Where a `use` points.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum SourcePath {
    /// `"parts/collar.garment"`
    File(Name),
    /// `std::body::female`
    Path(Vec<Name>),
}

/// A formal parameter of a function.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Formal {
    /// Its name.
    pub name: Name,
    /// Its kind.
    pub kind: Name,
    /// Its value if the caller gives none.
    pub default: Option<Expr>,
}

/// One part of a phrase.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Item {
    /// `,`
    Comma(Span),
    /// `->`
    Arrow(Span),
    /// `=`
    Equals(Span),
    /// A value, or a word (an [`ExprKind::Path`] of one name).
    Expr(Expr),
}

impl Item {
    /// Where it stands.
    pub fn span(&self) -> Span {
        match self {
            Item::Comma(span) | Item::Arrow(span) | Item::Equals(span) => *span,
            Item::Expr(expr) => expr.span,
        }
    }
}

/// One row of a chart or drawing: the raw text between its bars.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Row {
    /// The cells between two bars.
    pub text: String,
    /// Their place, bars excluded.
    pub span: Span,
}

/// A value as written.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Expr {
    /// Where.
    pub span: Span,
    /// What.
    pub kind: ExprKind,
}

/// The shapes of value.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum ExprKind {
    /// What stands here could not be read, and that has been told. Its value is unknown; whatever
    /// is made of it says nothing more.
    Unread,
    /// `12cm`, `1 3/8in`, `50%`, `7`
    Number {
        /// The number before its unit.
        value: f64,
        /// The unit written against it.
        unit: Option<Name>,
    },
    /// `#rrggbb`, as red, green, blue, alpha.
    Colour([u8; 4]),
    /// `"…"`, escapes resolved.
    Text(String),
    /// `(a)`
    Group(Box<Expr>),
    /// `(a, b)` or `(a, b, c)`
    Point(Vec<Expr>),
    /// `[a, b]`
    List(Vec<Expr>),
    /// `{ width: 12cm, depth: 3cm }`
    Record(Vec<Field>),
    /// `if c then a else b`
    Choice {
        /// The condition.
        condition: Box<Expr>,
        /// When it holds.
        then: Box<Expr>,
        /// When it does not.
        otherwise: Box<Expr>,
    },
    /// `width`, `std::body::female`
    Path(Vec<Name>),
    /// `front.side`
    Member(Box<Expr>, Name),
    /// `front.(side + flare)`
    Within(Box<Expr>, Box<Expr>),
    /// `sin(30deg)`
    Call(Box<Expr>, Vec<Argument>),
    /// `side[20cm..35cm from hem]`
    Index(Box<Expr>, Vec<Expr>, Option<Name>),
    /// `-a`, `not a`
    Unary(UnaryOp, Box<Expr>),
    /// `a + b`
    Binary {
        /// The operator.
        op: BinaryOp,
        /// Where it stands.
        op_span: Span,
        /// Before it.
        left: Box<Expr>,
        /// After it.
        right: Box<Expr>,
    },
}

/// A named value of a record.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Field {
    /// Its name.
    pub name: Name,
    /// Its value.
    pub value: Expr,
}

/// An argument of a call.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Argument {
    /// `name:` before it.
    pub name: Option<Name>,
    /// Its value.
    pub value: Expr,
}

/// Operators before a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum UnaryOp {
    /// `-`
    Minus,
    /// `not`
    Not,
}

/// Operators between values, tightest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum BinaryOp {
    /// `length @ direction`
    At,
    /// `*`
    Times,
    /// `/`
    Over,
    /// `+`
    Plus,
    /// `-`
    Minus,
    /// `..`
    To,
    /// `==`
    Equal,
    /// `!=`
    Unequal,
    /// `<`
    Less,
    /// `>`
    Greater,
    /// `<=`
    AtMost,
    /// `>=`
    AtLeast,
    /// `and`
    And,
    /// `or`
    Or,
}
