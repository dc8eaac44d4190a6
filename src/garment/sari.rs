//! A sari: one cloth of up to four symbolic parts (Athale 2004, section 6.1).
//!
//! u runs from the inner end (0) to the padar end along the warp, v from the lower edge (0) to
//! the upper edge. As a panel its drawing has x = u, y = v, and its grain is −90°.

use crate::textile::{Colour, motif::Motif, weave::Weave};
use serde::{Deserialize, Serialize};

/// The sari's parts; which may be absent follows the rule of the six layouts, already checked.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sari {
    /// Its name in the text.
    pub name: String,
    /// Length along the warp, m.
    pub length: f64,
    /// Width, m.
    pub width: f64,
    /// The field.
    pub ang: Part,
    /// The lower border and its width, m.
    pub lower_kath: Option<(Part, f64)>,
    /// The upper border and its width, m.
    pub upper_kath: Option<(Part, f64)>,
    /// The end piece and its length, m. It runs over the whole width between the borders.
    pub padar: Option<(Part, f64)>,
}

/// How one part looks. Drawn in this order: ground, bands, stripes, repeats, spots, edge.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Part {
    /// Its name in the text, `ang`, `peacock_border`.
    pub name: String,
    /// Colour of the ground.
    pub ground: Colour,
    /// Colour of the weft where it differs (shot).
    pub shot: Option<Colour>,
    /// Its weave, where it is not the fabric's.
    pub weave: Option<Weave>,
    /// Bands across the part's length, from its start, filling it.
    pub bands: Vec<Band>,
    /// Stripes along the part from its lower edge upwards: colour, offset and width, m.
    pub stripes: Vec<Stripe>,
    /// A motif repeated along the middle of the part, with its pitch, m.
    pub repeats: Vec<Repeat>,
    /// Motifs scattered on a grid.
    pub spots: Vec<Spots>,
    /// A motif repeated along the edge towards the field (sawtooth, temple).
    pub edges: Vec<Repeat>,
}

/// A band of colour or of motifs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Band {
    /// What fills it.
    pub fill: BandFill,
    /// Its extent along the part, m.
    pub length: f64,
}

/// What fills a band.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum BandFill {
    /// One colour.
    Colour(Colour),
    /// A motif, scaled to the band and repeated across it.
    Motif(Motif),
}

/// A stripe along a part.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stripe {
    /// Its colour.
    pub colour: Colour,
    /// From the part's outer edge, m.
    pub offset: f64,
    /// Its width, m.
    pub width: f64,
}

/// A motif in a row.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Repeat {
    /// The motif.
    pub motif: Motif,
    /// From motif to motif, m; already adjusted to divide the part's length evenly.
    pub pitch: f64,
    /// Every second one mirrored.
    pub flip: bool,
}

/// A motif on a grid.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Spots {
    /// The motif.
    pub motif: Motif,
    /// From motif to motif along u and v, m.
    pub pitch: [f64; 2],
    /// Every second row shifted by half a pitch.
    pub half_drop: bool,
    /// Share of spots kept at the padar end and at the inner end; spots are left out by a fixed
    /// hash of row and column. (1, 1) keeps all.
    pub thinning: [f64; 2],
}
