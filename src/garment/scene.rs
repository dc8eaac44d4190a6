//! What surrounds the cloth: wearers, solids, where panels begin, what the drape does, pictures.
//!
//! World: metres, y up, z towards the viewer, x towards the wearer's left. Wearers stand on
//! y = 0 and face +z.

use crate::diagnostic::Span;
use crate::textile::fabric::Structure;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A wearer asked for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BodyRequest {
    /// Its name in the text, `lady`.
    pub name: String,
    /// Where it is declared.
    pub span: Span,
    /// The figure it starts from.
    pub figure: Figure,
    /// Measures by the names of ISO 8559-1 as far as it has them, m. Every measure that the
    /// library's table of this figure names is present.
    pub measures: BTreeMap<String, f64>,
}

/// The figures that can be made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
#[allow(missing_docs)]
pub enum Figure {
    Female,
    Male,
}

/// A solid thing in the scene; cloth slides on it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Solid {
    /// Its name in the text.
    pub name: String,
    /// Where it is declared.
    pub span: Span,
    /// Its shape about its own origin.
    pub shape: Shape,
    /// Its origin in the world, m.
    pub at: [f64; 3],
    /// Turns about x, then y, then z, rad.
    pub turn: [f64; 3],
    /// Coulomb friction; the cloth's own where none is given.
    pub friction: Option<f64>,
}

/// Shapes of solids, m.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Shape {
    /// A ball about the origin.
    Sphere {
        /// Radius.
        radius: f64,
    },
    /// A cylinder about the y axis, standing on the origin.
    Cylinder {
        /// Radius.
        radius: f64,
        /// Height.
        height: f64,
    },
    /// A box standing on the origin: width along x, height along y, depth along z.
    Box {
        /// Width, height, depth.
        size: [f64; 3],
    },
    /// A table: a top of the given size whose upper face lies at `size[1]`, on four legs.
    Table {
        /// Width, height, depth.
        size: [f64; 3],
        /// Thickness of the top.
        thickness: f64,
    },
    /// The ground y = 0.
    Plane,
}

/// Where a panel begins.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Placement {
    /// Flat in the world: the drawing's (0, 0) lies at `at`; undisturbed, the drawing's x is the
    /// world's x, its y the world's y and its outside faces +z. Then turned about x, y, z (rad).
    Flat {
        /// Origin in the world, m.
        at: [f64; 3],
        /// Turns about x, then y, then z, rad.
        turn: [f64; 3],
    },
    /// Wrapped round a part of the body at a distance.
    Wrapped {
        /// Number of the body.
        body: usize,
        /// The ring whose height or station the anchor takes: `waist`, `neck`, `arm.left` …
        landmark: String,
        /// For limbs, the landmark that gives the station along the limb (`level man.shoulder`).
        level: Option<String>,
        /// Which side of it the drawing's x = 0 line lies on.
        side: Side,
        /// The drawing's y that comes to the landmark, m.
        anchor: f64,
        /// Distance from the skin, m.
        gap: f64,
    },
    /// Nothing said: it begins where its seams lead it.
    Led,
}

/// Sides of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Side {
    /// In front of the trunk.
    Before,
    /// Behind the trunk.
    Behind,
    /// All round; x = 0 lies in front (trunk) or outermost (limb).
    Around,
    /// On the wearer's left or right, by the half that the panel is.
    Beside,
}

/// One line of a drape schedule.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Phase {
    /// Draw the seams together without gravity, then weld them.
    Sew {
        /// Welded when no pair is further apart than this, m.
        gap: f64,
        /// Where it is said.
        span: Option<Span>,
    },
    /// Draw buttons and hooks together, then hold them.
    Close {
        /// Held when no pair is further apart than this, m.
        gap: f64,
        /// Where it is said.
        span: Option<Span>,
    },
    /// Let it come to rest.
    Settle {
        /// At rest when nothing moves faster, m/s.
        speed: f64,
        /// Longest time of the cloth's own clock, s.
        within: f64,
        /// Where it is said.
        span: Option<Span>,
    },
    /// Let time pass.
    Run {
        /// How long, s.
        time: f64,
        /// Frames per second that are kept.
        rate: f64,
        /// Where it is said.
        span: Option<Span>,
    },
}

/// A picture asked for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Picture {
    /// The views, side by side.
    pub views: Vec<View>,
    /// Pixels of the whole sheet: width, height.
    pub size: [u32; 2],
    /// The light.
    pub light: Light,
    /// How all cloth is shown; none shows each fabric as what it is.
    #[serde(default)]
    pub shading: Option<Shading>,
    /// How much care is taken.
    #[serde(default)]
    pub quality: Quality,
    /// What stands behind the figure.
    #[serde(default)]
    pub background: Background,
    /// Height of what each view shows, m, about the middle of the cloth; none shows all.
    #[serde(default)]
    pub field: Option<f64>,
    /// How far the camera has gone round the figure, rad, towards the wearer's left. Where it is
    /// said all turns show the figure at one scale.
    #[serde(default)]
    pub turn: Option<f64>,
}

impl Default for Picture {
    /// The front in the studio, 900 × 1200.
    fn default() -> Self {
        Picture {
            views: vec![View::Front],
            size: [900, 1200],
            light: Light::Studio,
            shading: None,
            quality: Quality::Normal,
            background: Background::Paper,
            field: None,
            turn: None,
        }
    }
}

/// Named ways to show cloth, those of Durupınar 2004 (sections 4.4 and 6.2) and of Athale 2004
/// (section 6.2.1).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Shading {
    /// Plain triangles, lit at their corners.
    Gouraud,
    /// Triangles curved by their normals, in one colour.
    Smooth,
    /// The picture of the textile on matte curved triangles.
    Textured,
    /// Upright pile.
    Velvet,
    /// The gloss of crossed threads, no thread shown.
    Satin,
    /// Matte threads.
    Woven,
    /// Threads with the gloss of satin.
    WovenSatin,
    /// Loops of an even yarn.
    Knitted,
    /// Loops of a yarn with its twist and fibres.
    KnittedYarns,
}

impl Shading {
    /// Its name in the text.
    pub fn name(self) -> &'static str {
        match self {
            Shading::Gouraud => "gouraud",
            Shading::Smooth => "smooth",
            Shading::Textured => "textured",
            Shading::Velvet => "velvet",
            Shading::Satin => "satin",
            Shading::Woven => "woven",
            Shading::WovenSatin => "woven_satin",
            Shading::Knitted => "knitted",
            Shading::KnittedYarns => "knitted_yarns",
        }
    }

    /// All of them.
    pub const ALL: [Shading; 9] = [
        Shading::Gouraud,
        Shading::Smooth,
        Shading::Textured,
        Shading::Velvet,
        Shading::Satin,
        Shading::Woven,
        Shading::WovenSatin,
        Shading::Knitted,
        Shading::KnittedYarns,
    ];

    /// That of a name.
    pub fn named(name: &str) -> Option<Shading> {
        Self::ALL.into_iter().find(|shading| shading.name() == name)
    }

    /// Whether cloth of this structure can be shown so: loops need a knit, threads a weave.
    pub fn suits(self, structure: &Structure) -> bool {
        match self {
            Shading::Woven | Shading::WovenSatin => matches!(structure, Structure::Woven { .. }),
            Shading::Knitted | Shading::KnittedYarns => {
                matches!(structure, Structure::Knitted { .. })
            }
            _ => true,
        }
    }
}

/// How much care is taken of a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Quality {
    /// A look in a moment.
    Draft,
    /// A clean picture.
    #[default]
    Normal,
    /// For print.
    Fine,
}

/// What stands behind the figure.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Background {
    /// Light grey paper, with the figure's shadow on it.
    #[default]
    Paper,
    /// Nothing: the picture is transparent there.
    None,
}

/// Named views.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[allow(missing_docs)]
pub enum View {
    Front,
    Side,
    Back,
    ThreeQuarter,
    Top,
}

/// Named lights.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[allow(missing_docs)]
pub enum Light {
    Studio,
    Daylight,
    Overcast,
}
