//! Bands of further cloth along edges: which faces they cover, and what share of each.

use super::compiled::{Compiled, MeshBand};
use super::outline::Grain;
use crate::garment::Garment;
use crate::garment::panel::{Band, Panel};
use crate::geometry::curve;
use crate::geometry::polygon::{Place, between, distance, distance_to_side};

/// A cell is looked at in so many places along each side, and a triangle in as many.
const PLACES: usize = 4;

/// The bands of all panels.
pub fn bands(garment: &Garment, compiled: &Compiled) -> Vec<MeshBand> {
    let all = garment.panels.iter().enumerate();
    all.flat_map(|(number, panel)| {
        panel.bands.iter().map(move |band| covered(compiled, number, panel, band))
    })
    .collect()
}

fn covered(compiled: &Compiled, number: usize, panel: &Panel, band: &Band) -> MeshBand {
    let line = line(panel, band);
    let near =
        |place: Place, most: f64| line.iter().any(|&(a, b)| distance_to_side(place, a, b) <= most);
    let (mut faces, mut shares) = (Vec::new(), Vec::new());
    let mut look = |face: usize, corners: &[u32]| {
        let corners: Vec<Place> = corners.iter().map(|&k| compiled.particles[k as usize]).collect();
        let Some((&first, others)) = corners.split_first() else { return };
        let reach = others.iter().map(|p| distance(first, *p)).fold(0.0, f64::max);
        if !near(first, band.width + reach) {
            return;
        }
        let places = places(&corners);
        let inside = places.iter().filter(|place| near(**place, band.width)).count();
        if inside > 0 {
            faces.push(face as u32);
            shares.push(inside as f64 / places.len() as f64);
        }
    };
    if let Some(cut) = compiled.panels.get(number) {
        for cell in cut.cells.range() {
            look(cell, &compiled.cells[cell]);
        }
        for triangle in cut.triangles.range() {
            look(compiled.cells.len() + triangle, &compiled.triangles[triangle]);
        }
    }
    MeshBand { fabric: band.fabric, plies: band.plies, faces, shares }
}

/// The edge in the plane of warp and weft, as straight sides.
fn line(panel: &Panel, band: &Band) -> Vec<(Place, Place)> {
    let grain = Grain::new(panel.grain);
    let mut sides = Vec::new();
    for run in &band.runs {
        let piece = panel.loops.get(run.ring).and_then(|ring| ring.pieces.get(run.piece));
        let Some(piece) = piece else { continue };
        let part = curve::part(&piece.path, run.from.min(run.to), run.from.max(run.to));
        let mut before: Option<Place> = None;
        kurbo::flatten(&part, 1e-4, |element| {
            if let Some(end) = element.end_point() {
                let here = grain.to_cloth([end.x, end.y]);
                sides.extend(before.map(|before| (before, here)));
                before = Some(here);
            }
        });
    }
    sides
}

/// Places spread evenly over a cell or a triangle.
fn places(corners: &[Place]) -> Vec<Place> {
    let n = PLACES as f64;
    let share = |i: usize, part: f64| (i as f64 + part) / n;
    let mut places = Vec::new();
    match *corners {
        [a, b, c, d] => {
            for i in 0..PLACES {
                for j in 0..PLACES {
                    let (s, t) = (share(i, 0.5), share(j, 0.5));
                    places.push(between(between(a, b, s), between(d, c, s), t));
                }
            }
        }
        [a, b, c] => {
            let at = |s: f64, t: f64| [0, 1].map(|k| a[k] + s * (b[k] - a[k]) + t * (c[k] - a[k]));
            for i in 0..PLACES {
                for j in 0..PLACES - i {
                    let (third, two) = (1.0 / 3.0, 2.0 / 3.0);
                    places.push(at(share(i, third), share(j, third)));
                    if i + j + 1 < PLACES {
                        places.push(at(share(i, two), share(j, two)));
                    }
                }
            }
        }
        _ => {}
    }
    places
}
