//! Figures by pixel: how far, which way, which fabric, how much drawn.

use super::figure::{Coat, Face, Figure};
use super::hierarchy::Stack;
use super::sheet::Stage;
use crate::garment::scene::Picture;
use image::{DynamicImage, ImageBuffer, Luma, Rgb};
use rayon::prelude::*;

/// What is told of each pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pass {
    /// Distance from the camera along its own axis, in 0.1 mm: 16 bits, 0 where nothing is.
    Depth,
    /// Direction of the surface, to the right, up and towards the camera, −1 to 1 as 0 to 255 in
    /// red, green and blue; black where nothing is.
    Normal,
    /// Number of the fabric from 1 as in `mesh.json`, 254 for solids, 255 for bodies, 0 where
    /// nothing is.
    Fabric,
    /// The strain of the cloth that differs most from 0, in 0.01 % from 32768: 16 bits, 0 where no
    /// cloth is.
    Strain,
}

impl Pass {
    /// All of them.
    pub const ALL: [Pass; 4] = [Pass::Depth, Pass::Normal, Pass::Fabric, Pass::Strain];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Pass::Depth => "depth",
            Pass::Normal => "normal",
            Pass::Fabric => "fabric",
            Pass::Strain => "strain",
        }
    }
}

/// What the middle of a pixel shows.
#[derive(Clone, Copy, Debug, Default)]
struct Shown {
    depth: u16,
    normal: [u8; 3],
    fabric: u8,
    strain: u16,
}

/// The passes of a picture, in the order asked for.
pub fn passes(figure: &Figure, picture: &Picture, wanted: &[Pass]) -> Vec<DynamicImage> {
    let Stage { cameras, frames, set, size } = Stage::of(figure, picture);
    let width = size[0] as usize;
    let mut shown = vec![Shown::default(); width * size[1] as usize];
    for (camera, &[left, top, wide, high]) in cameras.iter().zip(&frames) {
        let place = |at: usize| {
            let (x, y) = ((at % width) as u32, (at / width) as u32);
            let inside = (left..left + wide).contains(&x) && (top..top + high).contains(&y);
            inside.then(|| [x - left, y - top])
        };
        shown.par_iter_mut().enumerate().with_min_len(256).for_each_init(
            Stack::new,
            |stack, (at, shown)| {
                let Some([x, y]) = place(at) else { return };
                let ray =
                    camera.ray((x as f32 + 0.5) / wide as f32, (y as f32 + 0.5) / high as f32);
                let Some(hit) = set.hierarchy.nearest(&ray, stack, |_, _, _, _| true) else {
                    return;
                };
                let seen = set.place(&hit, &ray, None);
                let depth = -(ray.direction * hit.distance).dot(&camera.axes[2]);
                let number = set.face(&hit);
                let face = &figure.faces[number as usize];
                *shown = Shown {
                    depth: (depth * 1e4 + 0.5).clamp(1.0, 65_535.0) as u16,
                    normal: camera.axes.map(|axis| {
                        ((seen.threads.normal.dot(&axis) * 0.5 + 0.5) * 255.0 + 0.5) as u8
                    }),
                    fabric: number_of(figure, face),
                    strain: strain(figure, face)
                        .map_or(0, |strain| (32_768.0 + strain * 1e4).clamp(1.0, 65_535.0) as u16),
                };
            },
        );
    }
    let gray = |value: fn(&Shown) -> u16| {
        let values = shown.iter().map(value).collect();
        let image = ImageBuffer::<Luma<u16>, Vec<u16>>::from_raw(size[0], size[1], values);
        DynamicImage::ImageLuma16(image.unwrap_or_default())
    };
    wanted
        .iter()
        .map(|pass| match pass {
            Pass::Depth => gray(|shown| shown.depth),
            Pass::Strain => gray(|shown| shown.strain),
            Pass::Fabric => {
                let values = shown.iter().map(|shown| shown.fabric).collect();
                let image = ImageBuffer::<Luma<u8>, Vec<u8>>::from_raw(size[0], size[1], values);
                DynamicImage::ImageLuma8(image.unwrap_or_default())
            }
            Pass::Normal => {
                let values = shown.iter().flat_map(|shown| shown.normal).collect();
                let image = ImageBuffer::<Rgb<u8>, Vec<u8>>::from_raw(size[0], size[1], values);
                DynamicImage::ImageRgb8(image.unwrap_or_default())
            }
        })
        .collect()
}

/// The number that stands for what covers a face.
fn number_of(figure: &Figure, face: &Face) -> u8 {
    match &figure.coats[face.coat as usize] {
        Coat::Cloth(panel) => (panel.fabric + 1).min(253) as u8,
        Coat::Wood { .. } => 254,
        Coat::Plain { body, .. } => {
            if *body {
                255
            } else {
                254
            }
        }
    }
}

/// The larger of the two main strains of a triangle of cloth, counted by their size.
fn strain(figure: &Figure, face: &Face) -> Option<f32> {
    let inner = face.corners.iter().all(|corner| *corner < figure.cloth);
    if !inner || !matches!(figure.coats[face.coat as usize], Coat::Cloth(_)) {
        return None;
    }
    let [a, b, c] = face.corners.map(|corner| &figure.corners[corner as usize]);
    let [weft, warp] = super::near::along(&[a, b, c], b.place - a.place, c.place - a.place)?;
    // Main stretches: roots of the main values of the metric.
    let (e, f, g) = (weft.norm_squared(), weft.dot(&warp), warp.norm_squared());
    let (middle, half) = (0.5 * (e + g), (0.25 * (e - g) * (e - g) + f * f).sqrt());
    let [low, high] = [middle - half, middle + half].map(|value| value.max(0.0).sqrt() - 1.0);
    Some(if high.abs() >= low.abs() { high } else { low })
}
