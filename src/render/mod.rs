//! Drape to pictures: camera, light, ray tracing, the look of textiles.
//!
//! [`render`] sets the figure on a turntable in a studio, traces paths of light over a hierarchy
//! of triangles and gives back one sheet with all the views asked for. The same values give the
//! same bytes, on one thread or many: every pixel draws its own numbers from its place.

mod backdrop;
mod brdf;
mod camera;
mod coat;
mod figure;
mod finish;
mod floor;
mod gouraud;
mod hierarchy;
mod lamp;
mod layout;
mod manner;
mod near;
mod pass;
mod pixel;
mod rim;
mod sample;
mod selvage;
mod set;
mod sheet;
mod slub;
mod smooth;
mod swatch;
mod tessellate;
mod tone;
mod trace;
mod wood;
mod yarn;

pub use pass::Pass;

use crate::drape::draped::Draped;
use crate::garment::scene::{Picture, Quality, Shading};
use crate::mesh::compiled::Compiled;
use crate::progress::Progress;
use image::{DynamicImage, RgbaImage};

/// A vector or point of the pictures, m.
type Vector = nalgebra::Vector3<f32>;

/// A colour in linear light, Rec. 709 primaries.
type Light3 = nalgebra::Vector3<f32>;

/// How much care is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// Paths a pixel of cloth or body, at least 1.
    pub paths: u32,
    /// Times that light goes on from surface to surface after the first.
    pub bounces: u32,
    /// Whether the grain that is left is smoothed away along the surfaces.
    pub smooth: bool,
}

impl Default for Options {
    /// A clean picture in seconds.
    fn default() -> Self {
        Options::of(Quality::Normal)
    }
}

impl Options {
    /// What a quality by name means.
    pub fn of(quality: Quality) -> Self {
        let (paths, bounces) = match quality {
            Quality::Draft => (4, 1),
            Quality::Normal => (16, 2),
            Quality::Fine => (96, 4),
        };
        Options { paths, bounces, smooth: true }
    }
}

/// The picture asked for: one sheet with all its views, at one scale and on one ground line.
///
/// `picture.size` is taken as it stands, at least 1 × 1; no views at all show the front.
/// Panels whose region of the atlas is missing are shown in the colour of their yarns, places
/// that are not numbers are left out; nothing here fails.
pub fn render(
    compiled: &Compiled,
    draped: &Draped,
    picture: &Picture,
    options: &Options,
    progress: &mut dyn Progress,
) -> RgbaImage {
    progress.stage("render");
    progress.share(0.0, "building");
    let figure = figure::Figure::of(compiled, draped, manner::Manner::of(picture.shading));
    sheet::print(&figure, picture, options, progress)
}

/// Figures for every pixel of the picture that [`render`] makes of the same values, one image for
/// each of `wanted`.
pub fn passes(
    compiled: &Compiled,
    draped: &Draped,
    picture: &Picture,
    wanted: &[Pass],
) -> Vec<DynamicImage> {
    // Yarns as bodies would make holes between threads: the cloth is taken as a smooth sheet.
    let manner = manner::Manner::of(Some(Shading::Smooth));
    let figure = figure::Figure::of(compiled, draped, manner);
    pass::passes(&figure, picture, wanted)
}
