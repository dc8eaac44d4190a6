//! What the compiler makes: particles, cells, seams, and the picture of the textiles.

use crate::garment::scene::{BodyRequest, Phase, Picture, Placement, Solid};
use crate::garment::seam::{CordKind, PinTarget};
use crate::textile::fabric::Fabric;
use serde::{Deserialize, Serialize};

/// The cloth of a garment, cut but not yet sewn. All lengths in metres.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Compiled {
    /// Its name in the text.
    pub name: String,
    /// Panels; the particles, cells, triangles of one panel stand together.
    pub panels: Vec<MeshPanel>,
    /// Rest place of each particle: along the weft (u), along the warp (v).
    pub particles: Vec<[f64; 2]>,
    /// Place of each particle in its panel's grid, `[i, j]` along weft and warp; `i = i32::MIN`
    /// for particles that lie on the outline and not on the grid.
    pub lattice: Vec<[i32; 2]>,
    /// Intact h × h cells: the corners (i, j), (i+1, j), (i+1, j+1), (i, j+1); anticlockwise
    /// seen from outside.
    pub cells: Vec<[u32; 4]>,
    /// Triangles of the boundary bands; anticlockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Seams, in the order of sewing.
    pub seams: Vec<MeshSeam>,
    /// Buttons and hooks, closed after the seams.
    pub closures: Vec<MeshSeam>,
    /// Rims sewn where they lie near each other when the drape begins.
    pub nearby: Vec<MeshNearby>,
    /// Panels sewn flat on others.
    pub patches: Vec<MeshPatch>,
    /// Folds sewn shut.
    pub shut: Vec<MeshShut>,
    /// Sides of cells and triangles along which the cloth is folded.
    pub creases: Vec<MeshCrease>,
    /// Further cloth along edges.
    pub bands: Vec<MeshBand>,
    /// Cords along edges.
    pub cords: Vec<MeshCord>,
    /// Cords from place to place, tied when all is closed.
    pub ties: Vec<MeshCord>,
    /// Edges held to a body.
    pub attachments: Vec<MeshAttachment>,
    /// Particles held still.
    pub pins: Vec<MeshPin>,
    /// The textiles as a picture.
    pub atlas: Atlas,
    /// Fabrics of the panels.
    pub fabrics: Vec<Fabric>,
    /// Wearers.
    pub bodies: Vec<BodyRequest>,
    /// Solids.
    pub solids: Vec<Solid>,
    /// What the drape does.
    pub schedule: Vec<Phase>,
    /// Pictures asked for.
    pub pictures: Vec<Picture>,
}

/// A half-open range of numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Stretch {
    /// First.
    pub start: u32,
    /// One past the last.
    pub end: u32,
}

impl Stretch {
    /// As a range of `usize`.
    pub fn range(self) -> std::ops::Range<usize> {
        self.start as usize..self.end as usize
    }
}

/// One panel of the mesh.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MeshPanel {
    /// Its name.
    pub name: String,
    /// Number of its fabric.
    pub fabric: usize,
    /// Side of its grid cells, m.
    pub cell: f64,
    /// Contact order.
    pub layer: i32,
    /// Angle from the drawing's +y to the warp, rad: drawing = rotation by `grain` of (u, v).
    pub grain: f64,
    /// Where it begins.
    pub placement: Placement,
    /// Its particles.
    pub particles: Stretch,
    /// Its cells.
    pub cells: Stretch,
    /// Its triangles.
    pub triangles: Stretch,
    /// Its boundary: the outline anticlockwise, then holes clockwise; particle numbers, each
    /// loop closed by returning to its first.
    pub loops: Vec<Vec<u32>>,
    /// Named edges: particle numbers in the direction of drawing, both ends included.
    pub edges: Vec<MeshEdge>,
    /// How it looks: rectangles of its (u, v) plane and the atlas regions shown there; the first
    /// that holds a point counts, and one without a rectangle holds all.
    pub surfaces: Vec<Surface>,
}

/// A named edge of a panel.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MeshEdge {
    /// Its name.
    pub name: String,
    /// Its particles in order.
    pub points: Vec<u32>,
}

/// A seam as pairs of particles.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MeshSeam {
    /// As in the text.
    pub name: String,
    /// Pairs to be sewn; the two of a pair may be the same particle (the tip of a dart).
    pub pairs: Vec<[u32; 2]>,
}

/// Two rims of which particles are sewn that lie near each other when the drape begins.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MeshNearby {
    /// As in the text.
    pub name: String,
    /// The particles of both.
    pub sides: [Vec<u32>; 2],
    /// How far apart two of them may lie, m.
    pub within: f64,
}

/// A panel that lies flat on the face of another, sewn to it along its edges.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MeshPatch {
    /// As in the text.
    pub name: String,
    /// Number of the panel on top.
    pub panel: usize,
    /// Number of the panel below it.
    pub host: usize,
    /// Takes (u, v) of the one to (u, v) of the other, `(m0 u + m2 v + m4, m1 u + m3 v + m5)`.
    pub map: [f64; 6],
    /// Its particles that are sewn, each to a point of a face of the host.
    pub stitches: Vec<MeshStitch>,
}

/// A particle sewn to a point of a face.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MeshStitch {
    /// The particle.
    pub particle: u32,
    /// Three corners of a cell or triangle, anticlockwise.
    pub corners: [u32; 3],
    /// Their shares in the point; they add up to 1.
    pub weights: [f64; 3],
}

/// A fold sewn shut: particles of one ply, each sewn to a point of a face of the other.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MeshShut {
    /// Number of the panel.
    pub panel: usize,
    /// Whether the faces of the plies lie on each other, or their backs.
    pub face_on_face: bool,
    /// The stitches.
    pub stitches: Vec<MeshStitch>,
}

/// A side of two cells or triangles of a panel at which the cloth rests folded.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MeshCrease {
    /// The particles at its ends, the lower first.
    pub side: [u32; 2],
    /// The angle at which it rests, rad: 0 is flat, positive where the face is folded on itself.
    pub angle: f64,
}

/// Faces of a panel under which further cloth lies: a hem, a facing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MeshBand {
    /// Number of its fabric.
    pub fabric: usize,
    /// Its plies.
    pub plies: u32,
    /// The faces: cells by their numbers, triangles by theirs after the number of all cells.
    pub faces: Vec<u32>,
    /// Of each face the share that is covered.
    pub shares: Vec<f64>,
}

/// A cord as stretches between particles.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MeshCord {
    /// As in the text.
    pub name: String,
    /// What it is made of.
    pub kind: CordKind,
    /// Its width, m.
    pub width: f64,
    /// The particles at the ends of each stretch.
    pub pairs: Vec<[u32; 2]>,
    /// The length of each stretch at rest, m.
    pub rests: Vec<f64>,
}

/// Particles that follow a body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MeshAttachment {
    /// The particles.
    pub points: Vec<u32>,
    /// Number of the body.
    pub body: usize,
    /// Its landmark.
    pub landmark: String,
}

/// Particles held still.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MeshPin {
    /// The particles.
    pub points: Vec<u32>,
    /// Where.
    pub to: PinTarget,
}

/// A region of the atlas as it lies on a panel.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Surface {
    /// `[u0, v0, u1, v1]` of the panel, or all of it.
    pub area: Option<[f64; 4]>,
    /// Region shown on the outside. Its origin lies at (u0, v0), or at (0, 0) without an area.
    pub face: usize,
    /// Region shown on the inside; mirrored in u by the viewer's standpoint, not in the picture.
    pub back: usize,
}

/// The textiles as one picture.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Atlas {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// sRGB and opacity, rows from the top; `4 · width · height` bytes. Not part of `mesh.json`.
    #[serde(skip)]
    pub pixels: Vec<u8>,
    /// Its regions.
    pub regions: Vec<Region>,
}

/// A rectangle of the atlas: one repeat of a textile, or a part of a sari.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Region {
    /// Fabric or part, and face: `denim.face`, `paithani.padar.face`.
    pub name: String,
    /// Left, top, width, height in pixels, without the gutter that surrounds it (the gutter
    /// repeats the far side, so that filtering does not bleed).
    pub pixels: [u32; 4],
    /// Extent along u and v, m. Pixel rows run downwards, v upwards; columns run along u.
    pub size: [f64; 2],
    /// Whether it repeats endlessly (a tile) or lies once.
    pub tiles: bool,
    /// A tile of the thread structure to be multiplied on to this region near by; colours are
    /// relative to mid grey (128).
    pub detail: Option<usize>,
    /// Warp and weft colours of a cloth whose colour turns with the angle, sRGB.
    pub shot: Option<[[u8; 4]; 2]>,
}
