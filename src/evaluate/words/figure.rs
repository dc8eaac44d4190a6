//! Words of wearers, bodies and tables of sizes.

use super::{Form, Kind, Vocabulary, Word, property};

/// A measure by its name, or a row of a table by its key.
static MEASURE: Word = Word {
    name: "MEASURE",
    form: Form::Property,
    pattern: "LENGTH",
    help: "a measure of the body, by its name",
    block: None,
};

static ROW: Word = Word {
    name: "\"EU 38\"",
    form: Form::Property,
    pattern: "LENGTH,…",
    help: "a size: its measures in the order of `measures`",
    block: None,
};

pub(super) const TABLES: &[Vocabulary] = &[
    Vocabulary {
        kind: Kind::Wearer,
        words: &[property("size", "…", "a row of the body's table of sizes: `EU 38`")],
        rows: Some(&MEASURE),
    },
    Vocabulary {
        kind: Kind::Body,
        words: &[
            property("figure", "female|male", "the figure it starts from"),
            property("sizes", "NAME", "its table of sizes"),
            property("size", "…", "the size if nobody asks for another"),
        ],
        rows: Some(&MEASURE),
    },
    Vocabulary {
        kind: Kind::Sizes,
        words: &[property("measures", "WORD,…", "what the columns are")],
        rows: Some(&ROW),
    },
];
