//! Words of scenes: cloths and solids.

use super::{Kind, Vocabulary, action, item, opening, property};

pub(super) const TABLES: &[Vocabulary] = &[
    Vocabulary {
        kind: Kind::Scene,
        words: &[
            item("cloth", "NAME of FABRIC", Kind::Cloth, "a plain piece of cloth, or a sari"),
            item("solid", "NAME", Kind::Solid, "a thing on which cloth lies"),
            item("wearer", "NAME = BODY", Kind::Wearer, "a figure standing in the scene"),
            action(
                "pin",
                "PIECE,… [ at PLACE ]",
                "holds an edge or a corner at a place, or where it is",
            ),
            action("fix", "PIECE,…", "holds an edge or a corner where it is when the drape begins"),
            action("check", "VALUE [ = VALUE ] [ within LENGTH ]", "an error unless it holds"),
            opening("drape", "", Kind::Drape, "what the workshop does, in order"),
            opening("picture", "[ NAME ]", Kind::Picture, "a picture of the scene"),
        ],
        rows: None,
    },
    Vocabulary {
        kind: Kind::Cloth,
        words: &[
            property("size", "LENGTH x LENGTH", "weft x warp; a sari brings its own"),
            property("shape", "rectangle|circle [ radius LENGTH ]", "its shape =rectangle"),
            property(
                "grid",
                "CELLS [ x CELLS ]",
                "cells across and up, or the side of a cell =8mm",
            ),
            property("at", "POINT", "where its middle begins =(0, 0, 0)"),
            property("facing", "up|front|side|down", "where its outside looks =up"),
            property("turn", "ANGLES", "turns about x, then y, then z, after facing"),
            property("grain", "ANGLE", "turns the cloth under its shape =0deg"),
        ],
        rows: None,
    },
    Vocabulary {
        kind: Kind::Solid,
        words: &[
            property(
                "shape",
                "sphere|cylinder|box|table|plane [ radius LENGTH ] [ height LENGTH ] [ size LENGTH x LENGTH x LENGTH ] [ thickness LENGTH ]",
                "its shape: sphere radius; cylinder radius height; box size width x height x depth; table size, thickness 3cm; plane",
            ),
            property("at", "POINT", "middle of a sphere, foot of the others =(0, 0, 0)"),
            property("turn", "ANGLES", "turns about x, then y, then z"),
            property("facing", "up", "planes look up"),
            property("friction", "NUMBER", "Coulomb friction; the cloth's own unless said"),
        ],
        rows: None,
    },
];
