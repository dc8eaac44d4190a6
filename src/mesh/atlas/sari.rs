//! A sari's parts on one cloth: where grounds, bands, stripes, repeats, spots and edges lie, and
//! into which regions of the atlas they are cut.
//!
//! x runs along the sari from the inner end, y across it from the lower edge. Borders are mirror
//! images of each other: figures of the lower one stand on the hem, those of the upper one on the
//! upper edge. Figures of the field stand on the lower border; those of the padar hang as the
//! padar does when worn, their tops towards the field.

use super::figure::Figure;
use super::light::Code;
use super::painter::{Design, Frame, Mark, Rect, Sheet};
use super::repeat::Repeat;
use super::{Plan, Subject, noise, side};
use crate::garment::sari::{BandFill, Part, Repeat as Row, Sari, Spots};
use crate::mesh::compiled::Surface;
use crate::textile::Colour;
use crate::textile::fabric::{Fabric, Structure};
use crate::textile::motif::Motif;
use crate::textile::weave::Weave;
use std::sync::Arc;

/// How far the pictures go beyond the cloth, so that points on its very edge lie within, m.
const MARGIN: f64 = 2e-3;
/// Pixels of the face of a whole sari, about.
const PIXELS: f64 = 6.0e6;
/// Longest side of a region, px.
const LONGEST: f64 = 4096.0;
/// Figures in one row or column at most; closer ones would be finer than the picture.
const MOST: f64 = 2000.0;

/// One of the four parts as it lies on the sari.
struct Place<'a> {
    role: &'static str,
    part: &'a Part,
    /// The part without margins.
    area: Rect,
    /// The way to the right and up of figures set in the part.
    right: [f64; 2],
    up: [f64; 2],
    /// Resolution against that of the field.
    fineness: f64,
}

/// The parts in the order in which they are painted.
fn places(sari: &Sari) -> Vec<Place<'_>> {
    let low = sari.lower_kath.as_ref().map_or(0.0, |(_, width)| *width);
    let high = sari.width - sari.upper_kath.as_ref().map_or(0.0, |(_, width)| *width);
    let end = sari.length - sari.padar.as_ref().map_or(0.0, |(_, length)| *length);
    let mut places = vec![Place {
        role: "ang",
        part: &sari.ang,
        area: [0.0, low, end, high],
        right: [1.0, 0.0],
        up: [0.0, 1.0],
        fineness: 1.0,
    }];
    if let Some((part, _)) = &sari.padar {
        places.push(Place {
            role: "padar",
            part,
            area: [end, low, sari.length, high],
            right: [0.0, 1.0],
            up: [-1.0, 0.0],
            fineness: 1.4,
        });
    }
    if let Some((part, _)) = &sari.lower_kath {
        places.push(Place {
            role: "kath.lower",
            part,
            area: [0.0, 0.0, sari.length, low],
            right: [1.0, 0.0],
            up: [0.0, 1.0],
            fineness: 1.4,
        });
    }
    if let Some((part, _)) = &sari.upper_kath {
        places.push(Place {
            role: "kath.upper",
            part,
            area: [0.0, high, sari.length, sari.width],
            right: [1.0, 0.0],
            up: [0.0, -1.0],
            fineness: 1.4,
        });
    }
    places
}

/// Plans the regions of a sari and says which rectangles of its panel show them. In the panel's
/// plane u = −y and v = x.
pub fn plan(sari: &Sari, fabric: &Fabric, scale: f64, plans: &mut Vec<Plan<'_>>) -> Vec<Surface> {
    let places = places(sari);
    let design = Arc::new(design(&places, sari));
    let cloth = [0.0, 0.0, sari.length, sari.width];
    let pixel = (sari.length * sari.width / PIXELS).sqrt().clamp(2.5e-4, 2e-3) / scale;
    let mut surfaces = Vec::new();
    for place in &places {
        let [x0, y0, x1, y1] = extended(place.area, cloth);
        if !(x1 > x0 && y1 > y0) {
            continue;
        }
        let details = details(place, sari, fabric, scale, plans);
        let pixel = (pixel / place.fineness).max((y1 - y0) / LONGEST);
        let lengths = ((x1 - x0) / pixel / LONGEST).ceil().max(1.0) as usize;
        for n in 0..lengths {
            let cut = |n: usize| x0 + (x1 - x0) * n as f64 / lengths as f64;
            let area = [cut(n), y0, cut(n + 1), y1];
            let length = if lengths > 1 { format!(".{}", n + 1) } else { String::new() };
            let first = plans.len();
            for back in [false, true] {
                // Nobody studies the back.
                let pixel = if back { 2.0 * pixel } else { pixel };
                let count = |length: f64| ((length / pixel).round() as usize).max(1);
                plans.push(Plan {
                    name: format!("{}.{}{length}.{}", sari.name, place.role, side(back)),
                    pixels: [count(area[3] - area[1]), count(area[2] - area[0])],
                    size: [area[3] - area[1], area[2] - area[0]],
                    tiles: false,
                    detail: Some(details[usize::from(back)]),
                    shot: place.part.shot.map(|weft| [place.part.ground.0, weft.0]),
                    subject: Subject::Part(Sheet { design: Arc::clone(&design), area, back }),
                });
            }
            let area = Some([-area[3], area[0], -area[1], area[2]]);
            surfaces.push(Surface { area, face: first, back: first + 1 });
        }
    }
    surfaces
}

/// The rectangle, widened where it lies on the edge of the cloth.
fn extended(area: Rect, cloth: Rect) -> Rect {
    let mut wide = area;
    for n in 0..4 {
        if area[n] == cloth[n] {
            wide[n] += if n < 2 { -MARGIN } else { MARGIN };
        }
    }
    wide
}

/// Numbers of the tiles that show a part's threads, face and back; parts of one weave share them.
fn details(
    place: &Place<'_>,
    sari: &Sari,
    fabric: &Fabric,
    scale: f64,
    plans: &mut Vec<Plan<'_>>,
) -> [usize; 2] {
    let mut own = fabric.clone();
    if let (Some(of_part), Structure::Woven { weave, .. }) = (&place.part.weave, &mut own.structure)
    {
        *weave = of_part.clone();
    }
    [false, true].map(|looked_back| {
        let same = plans.iter().position(|plan| {
            matches!(&plan.subject, Subject::Detail { fabric, back, .. }
                if *back == looked_back && fabric.structure == own.structure)
        });
        same.unwrap_or_else(|| {
            let repeat = Repeat::of(&own.structure, scale);
            plans.push(Plan {
                name: format!("{}.{}.threads.{}", sari.name, place.role, side(looked_back)),
                pixels: repeat.pixels,
                size: repeat.size,
                tiles: true,
                detail: None,
                shot: None,
                subject: Subject::Detail { fabric: own.clone(), repeat, back: looked_back },
            });
            plans.len() - 1
        })
    })
}

/// Everything painted on the sari.
fn design(places: &[Place<'_>], sari: &Sari) -> Design {
    let mut design = Design::default();
    let cloth = [0.0, 0.0, sari.length, sari.width];
    for place in places {
        let ground = extended(place.area, cloth);
        design.marks.push(Mark::Fill { area: ground, light: ground_light(place.part) });
        bands(&mut design, place, ground);
        stripes(&mut design, place, ground);
        for row in &place.part.repeats {
            repeats(&mut design, place, row);
        }
        for (number, spots) in place.part.spots.iter().enumerate() {
            scatter(&mut design, place, spots, number as u32);
        }
    }
    // Teeth reach into the neighbouring part and therefore come last.
    for place in places {
        for row in &place.part.edges {
            edges(&mut design, place, row);
        }
    }
    design
}

/// The mean colour of the ground: of a shot one, warp and weft by the area in which each shows.
fn ground_light(part: &Part) -> [f32; 3] {
    let Some(shot) = part.shot else {
        return Code::linear(part.ground);
    };
    let share = part.weave.as_ref().map_or(0.5, Weave::warp_share) as f32;
    let (warp, weft) = (Code::linear(part.ground), Code::linear(shot));
    [0, 1, 2].map(|n| share * warp[n] + (1.0 - share) * weft[n])
}

/// A length that can be drawn.
fn sound(length: f64) -> bool {
    length.is_finite() && length > 0.0
}

/// A motif that can be drawn, as a figure of the design.
fn figure(design: &mut Design, motif: &Motif) -> Option<usize> {
    let drawable = motif.size.into_iter().all(sound) && motif.width() > 0 && motif.height() > 0;
    drawable.then(|| {
        design.figures.push(Figure::of(motif));
        design.figures.len() - 1
    })
}

/// Bands across the part, from its start. `ground` is the part with its margins.
fn bands(design: &mut Design, place: &Place<'_>, ground: Rect) {
    let [x0, y0, x1, y1] = place.area;
    let mut from = x0;
    for (number, band) in place.part.bands.iter().enumerate() {
        if !sound(band.length) {
            continue;
        }
        let to = from + band.length;
        // The outermost bands take the margins with them.
        let start = if number == 0 { ground[0] } else { from };
        let end = if number + 1 == place.part.bands.len() { ground[2] } else { to };
        let area = [start, ground[1], end.min(ground[2]), ground[3]];
        match &band.fill {
            BandFill::Colour(Colour(_)) if from >= x1 => {}
            BandFill::Colour(colour) => {
                design.marks.push(Mark::Fill { area, light: Code::linear(*colour) });
            }
            BandFill::Motif(motif) => {
                let Some(figure) = figure(design, motif) else { continue };
                let across = y1 - y0;
                let mut motif = motif.of_height(0.86 * band.length);
                if motif.size[0] > 0.96 * across {
                    motif = motif.scaled(0.96 * across / motif.size[0]);
                }
                let count = (across / (1.12 * motif.size[0])).floor().clamp(1.0, MOST);
                for n in 0..count as usize {
                    let y = y0 + across * (n as f64 + 0.5) / count;
                    let frame = Frame {
                        middle: [(from + to) / 2.0, y],
                        right: [0.0, 1.0],
                        up: [-1.0, 0.0],
                        size: motif.size,
                    };
                    design.marks.push(Mark::Figure { figure, frame });
                }
            }
        }
        from = to;
    }
}

/// Stripes along the part, counted from its outer edge.
fn stripes(design: &mut Design, place: &Place<'_>, ground: Rect) {
    let [_, y0, _, y1] = place.area;
    for stripe in &place.part.stripes {
        if !sound(stripe.width) || !stripe.offset.is_finite() {
            continue;
        }
        let [near, far] = [stripe.offset, stripe.offset + stripe.width];
        let [low, high] =
            if place.up[1] < 0.0 { [y1 - far, y1 - near] } else { [y0 + near, y0 + far] };
        let area = [ground[0], low.max(ground[1]), ground[2], high.min(ground[3])];
        design.marks.push(Mark::Fill { area, light: Code::linear(stripe.colour) });
    }
}

/// A row of motifs along the middle of the part.
fn repeats(design: &mut Design, place: &Place<'_>, row: &Row) {
    let [x0, y0, x1, y1] = place.area;
    let length = x1 - x0;
    let Some(figure) = figure(design, &row.motif) else { return };
    let Some(count) = counted(length, row.pitch) else { return };
    for n in 0..count {
        let x = x0 + length * (n as f64 + 0.5) / count as f64;
        let turn = if row.flip && n % 2 == 1 { -1.0 } else { 1.0 };
        let frame = Frame {
            middle: [x, (y0 + y1) / 2.0],
            right: place.right.map(|way| way * turn),
            up: place.up,
            size: row.motif.size,
        };
        design.marks.push(Mark::Figure { figure, frame });
    }
}

/// How many times `pitch` goes into `length`.
fn counted(length: f64, pitch: f64) -> Option<usize> {
    let count = (length / pitch).round();
    (sound(length) && sound(pitch)).then(|| count.clamp(1.0, 4.0 * MOST) as usize)
}

/// Motifs on a grid about the middle of the part, each kept or left out by fixed chance.
fn scatter(design: &mut Design, place: &Place<'_>, spots: &Spots, number: u32) {
    let [x0, y0, x1, y1] = place.area;
    let size = [x1 - x0, y1 - y0];
    if !spots.pitch.into_iter().chain(size).all(sound) {
        return;
    }
    let Some(figure) = figure(design, &spots.motif) else { return };
    let pitch = [0, 1].map(|axis| spots.pitch[axis].max(size[axis] / MOST));
    let count = [0, 1].map(|axis| (size[axis] / pitch[axis]).floor() as usize);
    let first = [0, 1].map(|axis| (size[axis] - count[axis] as f64 * pitch[axis]) / 2.0);
    for row in 0..count[1] {
        let shift = if spots.half_drop && row % 2 == 1 { 0.5 } else { 0.0 };
        for column in 0..count[0] {
            let x = x0 + first[0] + (column as f64 + 0.5 + shift) * pitch[0];
            let y = y0 + first[1] + (row as f64 + 0.5) * pitch[1];
            let towards_padar = (x - x0) / size[0];
            let kept = spots.thinning[1] + (spots.thinning[0] - spots.thinning[1]) * towards_padar;
            let lot = noise::chance(0x5a21 ^ (number << 16), column as u32, row as u32);
            let frame =
                Frame { middle: [x, y], right: place.right, up: place.up, size: spots.motif.size };
            let [a, b, c, d] = frame.area();
            let within = a >= x0 && b >= y0 && c <= x1 && d <= y1;
            if within && f64::from(lot) < kept {
                design.marks.push(Mark::Figure { figure, frame });
            }
        }
    }
}

/// Motifs along the edge towards the field, reaching into it; along both edges of the field
/// itself, within it.
fn edges(design: &mut Design, place: &Place<'_>, row: &Row) {
    let [x0, y0, x1, y1] = place.area;
    let Some(figure) = figure(design, &row.motif) else { return };
    let half = row.motif.size[1] / 2.0;
    let along = place.right[0] != 0.0;
    let length = if along { x1 - x0 } else { y1 - y0 };
    let Some(count) = counted(length, row.pitch) else { return };
    let lines: &[(f64, [f64; 2])] = match place.role {
        "ang" => &[(y0 + half, [0.0, 1.0]), (y1 - half, [0.0, -1.0])],
        "kath.lower" => &[(y1 + half, [0.0, 1.0])],
        "kath.upper" => &[(y0 - half, [0.0, -1.0])],
        _ => &[(x0 - half, [-1.0, 0.0])],
    };
    for &(line, up) in lines {
        for n in 0..count {
            let share = (n as f64 + 0.5) / count as f64;
            let turn = if row.flip && n % 2 == 1 { -1.0 } else { 1.0 };
            let middle =
                if along { [x0 + length * share, line] } else { [line, y0 + length * share] };
            let right = place.right.map(|way| way * turn);
            // Teeth of a sawtooth meet: each is as wide as its pitch, if it is nearly so.
            let width = length / count as f64;
            let near = (0.75..1.35).contains(&(row.motif.size[0] / width));
            let size = [if near { width } else { row.motif.size[0] }, row.motif.size[1]];
            design.marks.push(Mark::Figure { figure, frame: Frame { middle, right, up, size } });
        }
    }
}
