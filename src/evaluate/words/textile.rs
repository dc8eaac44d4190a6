//! Words of yarns, fabrics, weaves, knits, motifs and saris.

use super::{Form, Kind, Vocabulary, Word, action, opening, property};

/// A key of a legend.
static KEY: Word = Word {
    name: "\"*\"",
    form: Form::Property,
    pattern: "…",
    help: "what a cell of the chart with this key is",
    block: None,
};

/// What every part of a sari knows.
const PART: &[Word] = &[
    property("ground", "COLOUR", "colour or yarn of the ground"),
    property("shot", "COLOUR", "colour of the weft where it differs"),
    property("weave", "WEAVE", "its weave, where it is not the fabric's"),
    property("width", "LENGTH", "across the part, for a kath"),
    property("length", "LENGTH", "along the sari, for a padar"),
    property("bands", "…", "bands that fill a padar: `gold 2cm, lotus 14cm, …`"),
    action(
        "repeat",
        "MOTIF every LENGTH [ in COLOUR ] [ flip ]",
        "a motif in a row along the part",
    ),
    action("edge", "MOTIF every LENGTH [ in COLOUR ]", "a row of motifs towards the field"),
    action("stripe", "COLOUR LENGTH [ at LENGTH ]", "a stripe along the part"),
    action(
        "spot",
        "MOTIF every LENGTH x LENGTH [ half_drop ] [ thinning … ]",
        "scattered motifs: `thinning 100% -> 25% from padar`",
    ),
];

pub(super) const TABLES: &[Vocabulary] = &[
    Vocabulary {
        kind: Kind::Yarn,
        words: &[
            property("count", "COUNT", "its fineness, such as `30Ne`, `20tex`, `150denier`"),
            property("plies", "NUMBER", "strands twisted together =1"),
            property("twist", "TWIST [ S|Z ]", "turns per length and direction =0turns/m Z"),
            property(
                "fibre",
                "cotton|silk|wool|linen|jute|viscose|polyester|nylon|metal",
                "what it is spun from =cotton",
            ),
            property("color", "COLOUR", "its colour =#e8e4da"),
            property("diameter", "LENGTH", "in the cloth; from count and fibre unless said"),
            property("hairiness", "SHARE", "stray fibres =20%"),
            property("friction", "NUMBER", "yarn on yarn =0.3"),
        ],
        rows: None,
    },
    Vocabulary {
        kind: Kind::Fabric,
        words: &[
            property("structure", "STRUCTURE", "a weave or a knit =plain"),
            property("warp", "YARN [ at SETT ] [ color COLOUR ]", "lengthwise threads"),
            property("weft", "YARN [ at SETT ] [ color COLOUR ]", "crosswise threads"),
            property("yarn", "YARN [ color COLOUR ]", "the yarn of a knit"),
            property("mass", "MASS", "mass per area; from the yarns unless said"),
            property("thickness", "LENGTH", "from the yarns unless said"),
            property(
                "bending",
                "BENDING,…",
                "bending rigidity, warp and weft, such as `1.3e-5N.m`",
            ),
            property("bending_hysteresis", "FORCE,…", "warp and weft, such as `0.05gf.cm/cm`"),
            property(
                "tensile",
                "TENSION,…",
                "tension per strain, warp and weft, such as `2000N/m`",
            ),
            property("shear", "SHEAR", "shear stiffness, such as `0.5gf/cm/deg`"),
            property("shear_hysteresis", "TENSION", "such as `1gf/cm`"),
            property("friction", "NUMBER", "Coulomb friction =0.3"),
            property("poisson", "NUMBER", "Poisson's ratio =0.25"),
            property("damping", "SHARE", "share of critical damping =2%"),
            property("width", "LENGTH", "width of the roll =150cm"),
            property("finish", "matte|satin|velvet|wool|raised", "what was done to it last =matte"),
            opening("kes", "", Kind::Kes, "a sheet of the KES-F instruments"),
            opening("fast", "", Kind::Fast, "a sheet of the FAST instruments"),
        ],
        rows: None,
    },
    Vocabulary {
        kind: Kind::Kes,
        words: &[
            property("EM", "SHARE,…", "extension at 500 gf/cm"),
            property("LT", "NUMBER,…", "linearity of the tensile curve"),
            property("WT", "TENSION,…", "tensile energy"),
            property("RT", "SHARE,…", "tensile resilience"),
            property("G", "SHEAR,…", "shear stiffness"),
            property("2HG", "TENSION,…", "shear hysteresis at 0.5 degrees"),
            property("2HG5", "TENSION,…", "shear hysteresis at 5 degrees"),
            property("B", "BENDING,…", "bending rigidity"),
            property("2HB", "FORCE,…", "bending hysteresis"),
            property("T0", "LENGTH", "thickness at 0.5 gf/cm2"),
            property("Tm", "LENGTH", "thickness at 50 gf/cm2"),
            property("LC", "NUMBER", "linearity of compression"),
            property("MIU", "NUMBER,…", "coefficient of friction"),
            property("MMD", "NUMBER,…", "its mean deviation"),
            property("SMD", "LENGTH,…", "roughness"),
            property("W", "MASS", "mass per area"),
        ],
        rows: None,
    },
    Vocabulary {
        kind: Kind::Fast,
        words: &[
            property("E5", "SHARE,…", "extension at 5 gf/cm"),
            property("E20", "SHARE,…", "extension at 20 gf/cm"),
            property("E100", "SHARE,…", "extension at 100 gf/cm"),
            property("EB5", "SHARE", "bias extension at 5 gf/cm"),
            property("C", "LENGTH,…", "bending length"),
            property("B", "BENDING,…", "bending rigidity"),
            property("G", "TENSION", "shear rigidity"),
            property("T2", "LENGTH", "thickness at 2 gf/cm2"),
            property("T100", "LENGTH", "thickness at 100 gf/cm2"),
            property("W", "MASS", "mass per area"),
        ],
        rows: None,
    },
    Vocabulary {
        kind: Kind::Weave,
        words: &[
            action("plain", "", "one over, one under"),
            action("basket", "NUMBER", "plain with so many threads together"),
            action("rib", "NUMBER [ warp | weft ]", "plain with so many threads together one way"),
            action("twill", "…", "`twill 2/2 Z`, `twill 2/1/1/2 S move 1`: warp up / down"),
            action("satin", "NUMBER move NUMBER", "warp satin"),
            action("sateen", "NUMBER move NUMBER", "weft satin"),
            property("matrix", "", "1 = warp on top, as drawn on point paper"),
            action("wif", "PATH", "a weaver's file: `wif \"serge.wif\"`"),
            property("rows", "upwards|downwards", "where the first pick stands =upwards"),
            property("threading", "…", "shafts of the ends: `1..4, 3, 2`"),
            property("tieup", "…", "shafts of the treadles: `[1, 2], [2, 3]`"),
            property("treadling", "…", "treadles of the picks: `1..4`"),
            property("liftplan", "…", "shafts of the picks: `[1, 2], …`"),
        ],
        rows: None,
    },
    Vocabulary {
        kind: Kind::Knit,
        words: &[
            property("chart", "", "rows of loops as seen on the face"),
            property("gauge", "NUMBER x NUMBER per LENGTH", "wales x courses in a length"),
            property("worked", "flat|round", "how it is worked =flat"),
            property("face", "front|back", "which side the chart shows =front"),
            opening("legend", "", Kind::Legend, "what the keys of the chart are"),
        ],
        rows: None,
    },
    Vocabulary {
        kind: Kind::Motif,
        words: &[
            opening("legend", "", Kind::Legend, "what the keys of the picture are"),
            property("picture", "", "the drawing"),
            property("size", "LENGTH x LENGTH", "width x height of one motif"),
        ],
        rows: None,
    },
    Vocabulary { kind: Kind::Legend, words: &[], rows: Some(&KEY) },
    Vocabulary {
        kind: Kind::Sari,
        words: &[
            property("size", "LENGTH x LENGTH", "length x width"),
            opening("ang", "[ = ANG ] [ with ]", Kind::Ang, "the field"),
            opening("kath", "lower|upper [ = KATH ] [ with ]", Kind::Kath, "a border"),
            opening("padar", "[ = PADAR ] [ with ]", Kind::Padar, "the end piece"),
        ],
        rows: None,
    },
    Vocabulary { kind: Kind::Ang, words: PART, rows: None },
    Vocabulary { kind: Kind::Kath, words: PART, rows: None },
    Vocabulary { kind: Kind::Padar, words: PART, rows: None },
];
