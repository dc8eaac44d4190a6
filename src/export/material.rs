//! Materials: a region of the atlas as a picture of its own, or a plain colour.

use crate::body::surface::SurfaceKind;
use crate::mesh::compiled::{Compiled, Region};
use crate::textile::fabric::Fabric;
use image::ImageEncoder;
use image::codecs::png::PngEncoder;

/// Colour of bodies and of solids, sRGB.
pub fn plain(kind: SurfaceKind) -> [u8; 3] {
    match kind {
        SurfaceKind::Body => [222, 214, 203],
        SurfaceKind::Solid => [168, 158, 146],
    }
}

/// The colour of cloth of which there is no picture, linear light.
pub fn bare(compiled: &Compiled, fabric: usize) -> [f64; 3] {
    compiled.fabrics.get(fabric).map_or([0.5; 3], Fabric::light)
}

/// A region cut out of the atlas.
pub struct Cutting {
    /// The picture as PNG.
    pub png: Vec<u8>,
    /// Whether light comes through.
    pub open: bool,
}

/// The picture of a region; none where it does not lie inside the atlas.
pub fn cutting(compiled: &Compiled, region: &Region) -> Option<Cutting> {
    let atlas = &compiled.atlas;
    let [left, top, width, height] = region.pixels.map(|n| n as usize);
    let across = 4 * atlas.width as usize;
    let mut pixels = Vec::with_capacity(4 * width * height);
    for row in top..top.checked_add(height)? {
        let start = row.checked_mul(across)? + 4 * left;
        pixels.extend_from_slice(atlas.pixels.get(start..start + 4 * width)?);
    }
    if width == 0 || height == 0 || left + width > atlas.width as usize {
        return None;
    }
    let open = pixels.chunks_exact(4).any(|pixel| pixel[3] < 250);
    let colour = if open {
        image::ExtendedColorType::Rgba8
    } else {
        pixels = pixels.chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
        image::ExtendedColorType::Rgb8
    };
    let mut png = Vec::new();
    let (width, height) = (width as u32, height as u32);
    PngEncoder::new(&mut png).write_image(&pixels, width, height, colour).ok()?;
    Some(Cutting { png, open })
}
