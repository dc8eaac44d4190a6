//! The evaluated model: what a text says, with every name resolved and every quantity in SI
//! units (metres, radians, kilograms, seconds).
//!
//! A [`Garment`] is whatever can be sewn and draped: a garment on its wearer, or a scene of
//! cloth and solids. Numbers of panels, bodies, solids and fabrics are positions in its lists.

pub mod cloth;
pub mod panel;
pub mod sari;
pub mod scene;
pub mod seam;

use crate::diagnostic::Span;
use crate::textile::fabric::Fabric;
use serde::{Deserialize, Serialize};

/// Everything one drape needs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Garment {
    /// Its name in the text.
    pub name: String,
    /// Where it is declared.
    pub span: Span,
    /// Fabrics used by the panels.
    pub fabrics: Vec<Fabric>,
    /// Pieces of cloth; pairs and unfolded pieces are already copied.
    pub panels: Vec<panel::Panel>,
    /// What is sewn to what, darts included, in the order of sewing.
    pub seams: Vec<seam::Seam>,
    /// Points sewn to points, and buttons.
    pub stitches: Vec<seam::Stitches>,
    /// Rims sewn where they lie near each other.
    pub nearby: Vec<seam::Nearby>,
    /// Pieces sewn flat on others.
    pub patches: Vec<seam::Patch>,
    /// What draws edges together.
    pub cords: Vec<seam::Cord>,
    /// Cords from place to place.
    pub ties: Vec<seam::Tie>,
    /// Wearers.
    pub bodies: Vec<scene::BodyRequest>,
    /// Balls, tables and the like.
    pub solids: Vec<scene::Solid>,
    /// Edges held to a body.
    pub attachments: Vec<seam::Attachment>,
    /// Edges and corners held in space or at a place of a body.
    pub pins: Vec<seam::Pin>,
    /// What the drape does, in order; never empty.
    pub schedule: Vec<scene::Phase>,
    /// Pictures asked for; may be empty.
    pub pictures: Vec<scene::Picture>,
    /// Sizes for which the pattern is drawn besides its own.
    pub grade: Vec<String>,
}
