//! Words of a garment: sewing, placing, draping, pictures.

use super::panel::{FACING, HEM, INTERFACING, PLACKET};
use super::{Form, Kind, Vocabulary, Word, action, item, opening, property};

/// Words of a garment that a block has not: they say how it is worn, shown and sized.
pub(super) const WORN: &[&str] = &["drape", "picture", "grade", "grid", "fabric", "allowance"];

/// A rule of the writer's own.
pub(super) const REQUIRE: Word = action(
    "require",
    "CONDITION [ because TEXT ]",
    "an error unless it holds: `require intake < 8cm because \"a deeper dart stands off\"`",
);

/// A parameter of a block, by its name.
static SETTING: Word = Word {
    name: "PARAMETER",
    form: Form::Property,
    pattern: "VALUE",
    help: "a parameter of the block, by its name",
    block: None,
};

/// Words for placing and holding that garments and scenes share are repeated in `scene`.
pub(super) const TABLES: &[Vocabulary] = &[
    Vocabulary {
        kind: Kind::Garment,
        words: &[
            item("wearer", "NAME = BODY", Kind::Wearer, "who wears it; measures may be set"),
            item(
                "panel",
                "NAME [ of FABRIC ] [ = PANEL ] [ with ]",
                Kind::Panel,
                "a piece of cloth; `panel b = a with { … }` copies the text of `a`, lines with the same name replace",
            ),
            item(
                "part",
                "NAME = BLOCK [ of FABRIC ] [ with ]",
                Kind::Part,
                "the panels and seams of a block, with its parameters set: `part cuffs = cuff { around: 25cm }`",
            ),
            action(
                "seam",
                "[ EDGE->… ] [ points PARTICLE->… | near PIECE->… ] [ within LENGTH ] [ notches NUMBER ] [ ease LENGTH | gathered RATIO | stretched SHARE ] [ open LENGTH | zip LENGTH ] [ from EDGE ] [ stitch plain|felled|french|overlock ] [ reversed ]",
                "sews edges together; lengths that differ must be eased, gathered or stretched; or particle to particle, `seam points front(3, 4) -> back(0, 4)`, or rims where they lie near each other, `seam near a.end -> b.start within 1cm`",
            ),
            action(
                "button",
                "EDGE over EDGE count NUMBER [ every LENGTH ] [ inset LENGTH ]",
                "buttons through two edges, the first over the second, closed by `close`; 15mm from both edges unless said otherwise",
            ),
            action(
                "hook",
                "EDGE over EDGE count NUMBER [ every LENGTH ] [ inset LENGTH ]",
                "hooks and eyes, as buttons; at the edges themselves unless said otherwise",
            ),
            action(
                "patch",
                "PIECE on PIECE ( at POINT | along MARK ) [ turn ANGLE ] [ open EDGE,… ]",
                "sews a piece flat on another along its edges, but for the open ones; (0, 0) of its drawing comes to the point of the other's, or its first open edge along a mark: `patch pocket on front.left at (14cm, -22cm) open top`",
            ),
            action(
                "elastic",
                "in EDGE,… to LENGTH [ width LENGTH ]",
                "a band that stretches, 1cm wide unless said otherwise, sewn along edges and so long at rest: `elastic in skirt.top to 64cm`",
            ),
            action(
                "drawstring",
                "through EDGE,… to LENGTH",
                "a cord through edges that draws them together to a length: `drawstring through skirt.top to 70cm`",
            ),
            action(
                "tie",
                "PLACE to PLACE [ length LENGTH ]",
                "ties a place to a place with a cord of that length, closed by `close`; without a length they lie on each other",
            ),
            action(
                "place",
                "PIECE ( before PLACE | behind PLACE | around PLACE | beside PLACE | at POINT ) [ level PLACE ] [ gap LENGTH ] [ turn ANGLES ]",
                "where a piece begins; gap 3cm unless said otherwise",
            ),
            HEM,
            FACING,
            INTERFACING,
            PLACKET,
            action("attach", "EDGE,… to PLACE", "holds edges to the body where they come to lie"),
            action(
                "pin",
                "PIECE,… [ at PLACE ]",
                "holds an edge or a corner at a place, or where it is",
            ),
            action("fix", "PIECE,…", "holds an edge or a corner where it is when the drape begins"),
            action("check", "VALUE [ = VALUE ] [ within LENGTH ]", "an error unless it holds"),
            REQUIRE,
            opening("drape", "", Kind::Drape, "what the workshop does, in order"),
            opening("picture", "[ NAME ]", Kind::Picture, "a picture of the dressed figure"),
            property(
                "grid",
                "LENGTH",
                "side of the cells of all panels, unless they say otherwise =8mm",
            ),
            property("fabric", "FABRIC", "the fabric of panels that name none"),
            property("allowance", "LENGTH", "seam allowance of panels that say none =1cm"),
            property(
                "grade",
                "…",
                "sizes for which the pattern is drawn besides its own: `EU 34, EU 36`, or `all`",
            ),
        ],
        rows: None,
    },
    Vocabulary { kind: Kind::Part, words: &[], rows: Some(&SETTING) },
    Vocabulary {
        kind: Kind::Drape,
        words: &[
            action(
                "sew",
                "until CONDITION",
                "draws the seams together without gravity: `sew until gap < 1mm`",
            ),
            action("close", "", "closes buttons and hooks, and holds them from then on"),
            action(
                "settle",
                "until CONDITION [ within TIME ]",
                "lets it come to rest: `settle until speed < 2mm/s`; within 20s",
            ),
            action("run", "TIME [ at RATE ]", "lets time pass: `run 2s at 60fps`"),
        ],
        rows: None,
    },
    Vocabulary {
        kind: Kind::Picture,
        words: &[
            property("of", "NAME", "what is shown; only for pictures outside a garment"),
            property(
                "views",
                "front|side|back|three_quarter|top,…",
                "from where, side by side =front",
            ),
            property("size", "COUNT x COUNT", "pixels across and down =900 x 1200"),
            property("light", "studio|daylight|overcast", "the light =studio"),
            property(
                "shading",
                "gouraud|smooth|textured|velvet|satin|woven|woven_satin|knitted|knitted_yarns",
                "how all cloth is shown; each fabric as what it is unless said",
            ),
            property("quality", "draft|normal|fine", "how much care is taken =normal"),
            property("background", "paper|none", "what stands behind =paper"),
            property("turn", "ANGLE", "how far the camera goes round, towards the wearer's left"),
            property("field", "LENGTH", "height of what a view shows, for pictures from near by"),
            property("show", "worn|on_line|flat", "how a sari is shown =on_line"),
        ],
        rows: None,
    },
];
