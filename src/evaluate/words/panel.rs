//! Words of a panel and of its outline.

use super::garment::REQUIRE;
use super::{Kind, Vocabulary, Word, action, opening, property};

/// Words for further cloth along edges, which a garment has too, for edges of several panels.
pub(super) const HEM: Word = action(
    "hem",
    "on EDGE,… depth LENGTH [ double ]",
    "cloth turned up and sewn down: it is cut on to the edge, and the band is as heavy and stiff as two plies, turned twice with `double` as three",
);
pub(super) const FACING: Word = action(
    "facing",
    "on EDGE,… width LENGTH [ of FABRIC ]",
    "a band of further cloth beneath edges, of the same fabric unless said otherwise",
);
pub(super) const INTERFACING: Word = action(
    "interfacing",
    "on EDGE,… width LENGTH of FABRIC",
    "a band of stiffer cloth beneath edges",
);
pub(super) const PLACKET: Word = action(
    "placket",
    "on EDGE,… width LENGTH [ of FABRIC ]",
    "a band of doubled cloth at an opening, cut on and turned in twice, or sewn on where it is of another fabric; buttons and hooks lie in its middle",
);

pub(super) const TABLES: &[Vocabulary] = &[
    Vocabulary {
        kind: Kind::Panel,
        words: &[
            opening(
                "outline",
                "from POINT",
                Kind::Outline,
                "the edges, either way round, as seen from outside",
            ),
            action(
                "rectangle",
                "LENGTH x LENGTH",
                "width x height; x = 0 in the middle, edges bottom, end, top, start",
            ),
            action("circle", "radius LENGTH", "a disc about (0, 0); its edge is `rim`"),
            action(
                "ring",
                "inner LENGTH outer LENGTH [ sweep ANGLE ]",
                "a ring about (0, 0): edges inner and outer, and start and end where sweep is less than 360deg",
            ),
            action(
                "dart",
                "[ on EDGE ] at PLACE [ from EDGE ] width LENGTH [ depth LENGTH | to POINT ] [ above LENGTH ] [ below LENGTH ] [ turn ANGLE ]",
                "a wedge with equal legs, cut out and sewn: `dart on EDGE at PLACE width L depth L`; with two tips `dart at POINT width L above L below L`",
            ),
            action(
                "pleat",
                "on EDGE [ from PLACE ] [ to PLACE ] count NUMBER depth LENGTH [ kind knife|box|inverted ] [ facing EDGE ] [ pressed LENGTH ] [ stitched LENGTH ]",
                "evenly spread folds between two places of an edge; each takes twice its depth, is pressed right across unless said otherwise, and sewn shut as far as is said =knife, facing the edge's end",
            ),
            action(
                "tuck",
                "on EDGE at PLACE depth LENGTH [ count NUMBER ] [ every LENGTH ] [ pressed LENGTH ] [ stitched LENGTH ]",
                "folds that stand out from the face, sewn together at the edge and from there as far as is said; each takes twice its depth",
            ),
            action(
                "fold",
                "[ along PLACE ] [ from POINT ] [ to POINT ] by ANGLE",
                "pressed to rest at an angle, positive towards the face: `fold along 50% by 180deg` at a share of the height, or `fold from POINT to POINT by ANGLE`",
            ),
            opening(
                "hole",
                "[ circle | ellipse | slit ] [ from POINT ] [ to POINT ] [ at POINT ] [ turn ANGLE ] [ radius LENGTH [ x LENGTH ] ]",
                Kind::Outline,
                "a closed inner outline: `hole from P { edges }`, `hole circle at P radius L`, `hole ellipse at P radius L x L`, `hole slit from P to P`",
            ),
            opening(
                "mark",
                "NAME from POINT",
                Kind::Outline,
                "a line drawn on the piece, with a name: `mark pocket from P { line to Q }`",
            ),
            action(
                "slit",
                "along MARK [ facing LENGTH | placket LENGTH ] [ of FABRIC ]",
                "cuts the cloth open along a mark; its lips are edges by the name of the mark, or the label, with 1 at the left of its course and 2 at the right; `facing` lays a band of further cloth along both, `placket` two doubled strips over the slit",
            ),
            action(
                "trim",
                "along MARK keep SIDE",
                "cuts the piece along a mark from rim to rim and keeps the side of an edge or of a point; the cut is an edge by the name of the mark",
            ),
            action("notch", "on EDGE at POSITION [ from EDGE ]", "a match mark"),
            action(
                "leave",
                "LENGTH on EDGE,… [ corner mitre|square|round ]",
                "the seam allowance beyond some edges, and how it is cut at their ends =mitre",
            ),
            HEM,
            FACING,
            INTERFACING,
            PLACKET,
            action("unfold", "across EDGE [ as NAME,… ]", "adds the mirror image; the fold goes"),
            action(
                "pair",
                "as NAME,…",
                "cuts the piece twice; the first name is the piece as drawn",
            ),
            action("rotate", "by ANGLE [ about POINT ]", "turns the drawing"),
            action(
                "mirror",
                "[ about POINT ]",
                "exchanges left and right of the drawing, about x = 0 or the upright line through a point",
            ),
            action(
                "scale",
                "[ about POINT ] [ on EDGE ] ( width LENGTH | height LENGTH | to LENGTH | by RATIO [ x RATIO ] )",
                "resizes the drawing: `by 1.1`, `by 1.1 x 1`, to a width or a height, or `to 36cm on waist`",
            ),
            action(
                "cut",
                "along PARTICLE,… keep inside|outside PARTICLE",
                "on a counted grid: cuts along the closed line through particles and keeps the side on which one lies; edges cut1, cut2, … or by its label",
            ),
            action(
                "smooth",
                "PARTICLE,…",
                "on a counted grid: the cut line from the first to the last particle becomes a Bézier curve through them",
            ),
            action(
                "move",
                "PARTICLE,… by POINT",
                "on a counted grid: shifts particles of the cut line",
            ),
            action(
                "fit",
                "NAME in RANGE until VALUE = VALUE",
                "finds the value of a name that makes two lengths equal",
            ),
            REQUIRE,
            property("fabric", "FABRIC", "its fabric"),
            property("grain", "ANGLE", "turns the cloth under the drawing =0deg: warp along +y"),
            property(
                "size",
                "LENGTH x LENGTH",
                "a rectangle, width x height, x = 0 in its middle; with `grid: 40 x 60` or a mask its particles are counted",
            ),
            property("mask", "", "the cells that are cloth, `#`, and those that are not, `.`"),
            property(
                "grid",
                "CELLS [ x CELLS ]",
                "side of the grid cells, or with a size their number across and up",
            ),
            property("plies", "COUNT", "plies of cloth on each other =1"),
            property("allowance", "LENGTH", "cloth left beyond the cut lines =1cm"),
            property(
                "layer",
                "LAYER",
                "order of contact, greater lies further out =0; `inside` for linings",
            ),
        ],
        rows: None,
    },
    Vocabulary {
        kind: Kind::Outline,
        words: &[
            action("line", "( to END | by VECTOR )", "a straight edge"),
            action(
                "curve",
                "( to END | by VECTOR ) [ leaving DIRECTION ] [ arriving DIRECTION ] [ pull SHARE,… ] [ through POINT,… | controls POINT,… | bulge LENGTH | hollow LENGTH | measuring LENGTH ] [ inward ]",
                "a curved edge, by directions, by points, or as a bow",
            ),
            action(
                "arc",
                "( to END | by ANGLE ) [ around POINT ] [ bulge LENGTH | hollow LENGTH | radius LENGTH ] [ inward ]",
                "a part of a circle: `arc around P by A`, `arc to P bulge L`, `arc to P radius L`",
            ),
            action(
                "trace",
                "EDGE [ mirrored ] [ reversed ]",
                "repeats edges of another panel from here, names kept",
            ),
        ],
        rows: None,
    },
];
