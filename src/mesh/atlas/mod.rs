//! The atlas: every textile of a garment as a picture at true scale.
//!
//! [`draw`] gives each fabric a tile of its face and one of its back, drawn thread by thread
//! from the weave matrix or loop by loop from the knit chart, and each part of a sari a picture
//! of its own; it packs them into one image and says which of them each panel shows. The bytes
//! depend on the garment alone.

mod figure;
mod knitted;
mod laid;
mod light;
pub mod noise;
mod pack;
mod painter;
mod repeat;
mod sari;
mod strand;
mod tile;
mod woven;

pub use laid::Laid;
pub use strand::{Node, Strand};
pub use tile::Look as Skin;

use super::compiled::{Atlas, Compiled, Region, Surface};
use crate::garment::{Garment, cloth};
use crate::textile::Colour;
use crate::textile::fabric::{Fabric, Structure};
use crate::textile::yarn::Fibre;
use rayon::prelude::*;
use repeat::Repeat;

/// Pixels round a region that repeat the far side of a tile, or the edge of what lies once.
pub const GUTTER: usize = 4;

/// A region before it has its place.
struct Plan<'a> {
    name: String,
    pixels: [usize; 2],
    size: [f64; 2],
    tiles: bool,
    detail: Option<usize>,
    shot: Option<[[u8; 4]; 2]>,
    subject: Subject<'a>,
}

/// What a region shows.
enum Subject<'a> {
    /// A tile of a fabric.
    Fabric { fabric: &'a Fabric, repeat: Repeat, back: bool },
    /// The tile of a sari's threads, without colour.
    Detail { fabric: Fabric, repeat: Repeat, back: bool },
    /// A part of a sari, or a length of it.
    Part(painter::Sheet),
}

impl Subject<'_> {
    fn draw(&self, pixels: [usize; 2]) -> Vec<u8> {
        match self {
            Subject::Fabric { fabric, repeat, back } => repeat.draw(fabric, *back, None),
            Subject::Detail { fabric, repeat, back } => {
                let grey = Colour([128, 128, 128, 255]);
                let mut picture = repeat.draw(fabric, *back, Some([grey; 2]));
                picture.chunks_exact_mut(4).for_each(|pixel| pixel[3] = 255);
                picture
            }
            Subject::Part(sheet) => sheet.draw(pixels),
        }
    }
}

/// Draws the textiles of `garment` into `compiled.atlas` and fills the surfaces of each panel.
///
/// Panels of the two are matched by name. Where all pictures together are larger than an image
/// may be, all are drawn with fewer pixels.
pub fn draw(garment: &Garment, compiled: &mut Compiled) {
    let mut scale = 1.0;
    loop {
        let (plans, surfaces) = plan(garment, compiled, scale);
        let outer: Vec<[usize; 2]> =
            plans.iter().map(|plan| plan.pixels.map(|n| n + 2 * GUTTER)).collect();
        // Below this a region is a few pixels and only its number can be too large.
        let packed = pack::shelves(&outer);
        if packed.is_none() && scale > 0.02 {
            scale *= 0.8;
            continue;
        }
        let (places, size) = packed.unwrap_or_default();
        compiled.atlas = assemble(&plans, &places, size);
        for (panel, surfaces) in compiled.panels.iter_mut().zip(surfaces) {
            panel.surfaces = if places.is_empty() { Vec::new() } else { surfaces };
        }
        return;
    }
}

/// The regions that the panels need, and what each panel shows.
fn plan<'a>(
    garment: &'a Garment,
    compiled: &Compiled,
    scale: f64,
) -> (Vec<Plan<'a>>, Vec<Vec<Surface>>) {
    let mut plans: Vec<Plan<'a>> = Vec::new();
    let mut tiles: Vec<Option<usize>> = vec![None; garment.fabrics.len()];
    let surfaces = compiled
        .panels
        .iter()
        .map(|mesh| {
            let Some(panel) = garment.panels.iter().find(|panel| panel.name == mesh.name) else {
                return Vec::new();
            };
            let Some(fabric) = garment.fabrics.get(panel.fabric) else {
                return Vec::new();
            };
            match &panel.surface {
                cloth::Surface::Fabric => {
                    let first = *tiles[panel.fabric].get_or_insert_with(|| {
                        plans.extend(fabric_tiles(fabric, scale));
                        plans.len() - 2
                    });
                    vec![Surface { area: None, face: first, back: first + 1 }]
                }
                cloth::Surface::Sari(sari) => sari::plan(sari, fabric, scale, &mut plans),
            }
        })
        .collect();
    (plans, surfaces)
}

/// Face and back of a fabric.
fn fabric_tiles(fabric: &Fabric, scale: f64) -> [Plan<'_>; 2] {
    let shot = shot(fabric);
    let tile = |back: bool| {
        let repeat = Repeat::of(&fabric.structure, scale);
        Plan {
            name: format!("{}.{}", fabric.name, side(back)),
            pixels: repeat.pixels,
            size: repeat.size,
            tiles: true,
            detail: None,
            shot,
            subject: Subject::Fabric { fabric, repeat, back },
        }
    };
    [tile(false), tile(true)]
}

fn side(back: bool) -> &'static str {
    if back { "back" } else { "face" }
}

/// Warp and weft colour of a cloth that is shot: lustrous yarns of two colours, both well seen.
fn shot(fabric: &Fabric) -> Option<[[u8; 4]; 2]> {
    let Structure::Woven { weave, warp, weft } = &fabric.structure else {
        return None;
    };
    let lustrous = [warp, weft].iter().all(|thread| {
        matches!(thread.yarn.fibre, Fibre::Silk | Fibre::Viscose | Fibre::Polyester | Fibre::Nylon)
    });
    let even = (0.35..=0.65).contains(&weave.warp_share());
    (lustrous && even && warp.colour != weft.colour).then_some([warp.colour.0, weft.colour.0])
}

/// Draws the regions and lays them into one image.
fn assemble(plans: &[Plan<'_>], places: &[[usize; 2]], size: [usize; 2]) -> Atlas {
    let [width, height] = size;
    let mut atlas = Atlas {
        width: width as u32,
        height: height as u32,
        pixels: vec![0; 4 * width * height],
        regions: Vec::with_capacity(plans.len()),
    };
    if width == 0 || height == 0 {
        return atlas;
    }
    for (plan, place) in plans.iter().zip(places) {
        let picture = plan.subject.draw(plan.pixels);
        let [w, h] = plan.pixels;
        let source = |n: usize, size: usize| {
            let n = n as i64 - GUTTER as i64;
            let last = size as i64 - 1;
            if plan.tiles { n.rem_euclid(last + 1) as usize } else { n.clamp(0, last) as usize }
        };
        let rows = &mut atlas.pixels[4 * width * place[1]..4 * width * (place[1] + h + 2 * GUTTER)];
        rows.par_chunks_mut(4 * width).enumerate().for_each(|(line, row)| {
            let from = &picture[4 * w * source(line, h)..][..4 * w];
            let row = &mut row[4 * place[0]..4 * (place[0] + w + 2 * GUTTER)];
            row[4 * GUTTER..4 * (GUTTER + w)].copy_from_slice(from);
            for n in (0..GUTTER).chain(GUTTER + w..2 * GUTTER + w) {
                let pixel = source(n, w);
                row[4 * n..4 * n + 4].copy_from_slice(&from[4 * pixel..4 * pixel + 4]);
            }
        });
        let [left, top] = place.map(|n| (n + GUTTER) as u32);
        atlas.regions.push(Region {
            name: plan.name.clone(),
            pixels: [left, top, w as u32, h as u32],
            size: plan.size,
            tiles: plan.tiles,
            detail: plan.detail,
            shot: plan.shot,
        });
    }
    atlas
}
