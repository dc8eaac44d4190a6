//! What the workshop gives back: positions, and a frank account of how it went.

use crate::body::surface::Surface;
use nalgebra::Point3;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The dressed figure.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Draped {
    /// Place of each particle of the mesh, in its order, m.
    pub positions: Vec<Point3<f64>>,
    /// Bodies and solids it lies on.
    pub surfaces: Vec<Surface>,
    /// How it went.
    pub stats: Stats,
}

/// Figures of a drape, as written by `--stats`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Stats {
    /// The garment.
    pub name: String,
    /// Particles of the mesh.
    pub particles: usize,
    /// Triangles, cells counted as two.
    pub triangles: usize,
    /// Pairs of particles sewn together, and particles sewn to faces.
    pub seam_pairs: usize,
    /// Threads that worked.
    pub threads: usize,
    /// Wall seconds of each stage, by its name.
    pub seconds: BTreeMap<String, f64>,
    /// Time steps taken.
    pub steps: usize,
    /// Largest strain of a grid edge along the warp, as a share.
    pub largest_warp_strain: f64,
    /// Largest strain of a grid edge along the weft, as a share.
    pub largest_weft_strain: f64,
    /// Mean size of strain along the warp, as a share.
    pub mean_warp_strain: f64,
    /// Mean size of strain along the weft, as a share.
    pub mean_weft_strain: f64,
    /// Largest distance of a seam pair, or of a patch's edge from its place, m.
    pub largest_seam_gap: f64,
    /// Deepest place of a particle inside a body or solid, m; 0 if none.
    pub deepest_penetration: f64,
    /// Pairs of cloth triangles that cut each other.
    pub self_intersections: usize,
    /// Largest speed at the end, m/s.
    pub largest_speed: f64,
    /// The verdict.
    pub verdict: Verdict,
    /// Why the file's own condition is not met, if it is not.
    pub reason: Option<String>,
}

/// How a drape ended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Verdict {
    /// At rest.
    #[serde(rename = "settled")]
    Settled,
    /// Not at rest, or stopped by the clock as asked.
    #[default]
    #[serde(rename = "still moving")]
    StillMoving,
    /// No longer held by the body.
    #[serde(rename = "fell off")]
    FellOff,
    /// Cloth is left inside a body.
    #[serde(rename = "penetrating")]
    Penetrating,
    /// Cloth passes through cloth.
    #[serde(rename = "tangled")]
    Tangled,
}
