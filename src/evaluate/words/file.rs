//! Words at the level of a file.

use super::garment::REQUIRE;
use super::{Kind, Vocabulary, action, item, opening};

pub(super) const TABLES: &[Vocabulary] = &[Vocabulary {
    kind: Kind::File,
    words: &[
        item("garment", "NAME", Kind::Garment, "pieces, how they are sewn, and who wears them"),
        item(
            "block",
            "NAME [ = BLOCK ] [ with ]",
            Kind::Block,
            "pieces and seams with parameters, for use as a part of garments",
        ),
        item("scene", "NAME", Kind::Scene, "cloth and solids, for study and for measuring"),
        item("yarn", "NAME [ = YARN ] [ with ]", Kind::Yarn, "a yarn: count, plies, twist, fibre"),
        item(
            "fabric",
            "NAME [ = FABRIC ] [ with ]",
            Kind::Fabric,
            "a cloth: structure, yarns, mass, mechanics",
        ),
        item("weave", "NAME [ = WEAVE ] [ with ]", Kind::Weave, "how warp and weft cross"),
        item("knit", "NAME [ = KNIT ] [ with ]", Kind::Knit, "a chart of loops and its gauge"),
        item("motif", "NAME [ = MOTIF ] [ with ]", Kind::Motif, "a small chart of coloured cells"),
        item(
            "sari",
            "NAME [ of FABRIC ] [ = SARI ] [ with ]",
            Kind::Sari,
            "one cloth of up to four parts",
        ),
        item("ang", "NAME [ = ANG ] [ with ]", Kind::Ang, "the field of a sari"),
        item("kath", "NAME [ = KATH ] [ with ]", Kind::Kath, "a border of a sari"),
        item("padar", "NAME [ = PADAR ] [ with ]", Kind::Padar, "the end piece of a sari"),
        item("sizes", "NAME [ of BODY ]", Kind::Sizes, "a table of bodies"),
        item("body", "NAME [ = BODY ] [ with ]", Kind::Body, "a figure with its measures"),
        REQUIRE,
        action("allow", "CODE,…", "warnings that this file does without: `allow W0601`"),
        opening("picture", "[ NAME ]", Kind::Picture, "a picture of what `of:` names"),
    ],
    rows: None,
}];
