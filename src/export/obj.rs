//! Wavefront OBJ with its materials: metres, y up, the wearer facing +z.
//!
//! Vertices are the particles in the order of `mesh.json`, so vertex k is particle k − 1; each
//! panel is an object of its name. `vt` counts widths and heights of the picture of the textile,
//! from the lower left corner: pictures repeat, and times their size in metres, which the
//! material file states, `vt` is the rest shape. Wearer and solids follow as `body.NAME`.

use super::material::{bare, cutting, plain};
use super::normal::normals;
use super::patch::patches;
use crate::body::surface::SurfaceKind;
use crate::drape::draped::Draped;
use crate::mesh::compiled::Compiled;
use crate::textile::Colour;
use nalgebra::{Point3, Vector3};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::{self, Write};

/// The files of one export.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ObjFiles {
    /// The `.obj`.
    pub obj: Vec<u8>,
    /// The `.mtl`.
    pub mtl: Vec<u8>,
    /// Pictures that the `.mtl` names: file name beside it, PNG.
    pub pictures: Vec<(String, Vec<u8>)>,
}

/// The dressed figure; wearer and solids only `with_body`. `stem` is the name of the files
/// without its ending.
pub fn write(compiled: &Compiled, draped: &Draped, with_body: bool, stem: &str) -> ObjFiles {
    let mut materials = Materials::default();
    let obj = text(|out| objects(out, compiled, draped, with_body, stem, &mut materials));
    let mut files = ObjFiles { obj, ..ObjFiles::default() };
    files.mtl = text(|out| materials.write(out, compiled, stem, &mut files.pictures));
    files
}

/// What `fill` writes. Writing to memory does not fail.
fn text(fill: impl FnOnce(&mut String) -> fmt::Result) -> Vec<u8> {
    let mut text = String::new();
    let filled = fill(&mut text);
    debug_assert!(filled.is_ok());
    text.into_bytes()
}

fn objects(
    out: &mut String,
    compiled: &Compiled,
    draped: &Draped,
    with_body: bool,
    stem: &str,
    materials: &mut Materials,
) -> fmt::Result {
    writeln!(out, "# {} by darzi", line(&compiled.name))?;
    writeln!(out, "# unit: metre; up: +y; front: +z; one object a panel")?;
    writeln!(out, "# vertex k is particle k - 1 of mesh.json; vt counts repeats of the picture")?;
    writeln!(out, "mtllib {}.mtl", line(stem))?;
    let count = draped.positions.len();
    let normals = normals(compiled, &draped.positions);
    let mut written = 0;
    let mut marks = 0usize;
    for panel in &compiled.panels {
        writeln!(out, "o {}", word(&panel.name))?;
        let end = panel.particles.range().end.min(count);
        vertices(out, draped.positions.iter().zip(&normals).take(end).skip(written))?;
        written = written.max(end);
        for patch in patches(compiled, panel) {
            let inside = |corners: &[u32]| corners.iter().all(|&c| (c as usize) < count);
            let cells: Vec<&[u32; 4]> = patch.cells.iter().filter(|c| inside(*c)).collect();
            let triangles: Vec<&[u32; 3]> = patch.triangles.iter().filter(|c| inside(*c)).collect();
            let mut used = BTreeMap::new();
            for &corner in
                cells.iter().copied().flatten().chain(triangles.iter().copied().flatten())
            {
                used.insert(corner, 0usize);
            }
            for (particle, mark) in &mut used {
                marks += 1;
                *mark = marks;
                let [right, up] = patch.on_region(compiled, *particle);
                writeln!(out, "vt {right:.6} {up:.6}")?;
            }
            let material = materials.textile(compiled, panel.fabric, patch.region);
            writeln!(out, "usemtl {material}")?;
            let cells = cells.iter().map(|cell| cell.as_slice());
            for corners in cells.chain(triangles.iter().map(|triangle| triangle.as_slice())) {
                out.push('f');
                for corner in corners {
                    let k = corner + 1;
                    write!(out, " {k}/{}/{k}", used.get(corner).copied().unwrap_or(1))?;
                }
                out.push('\n');
            }
        }
    }
    // Particles of no panel: there are none, but numbers must stay right.
    vertices(out, draped.positions.iter().zip(&normals).skip(written))?;
    if with_body {
        let mut first = count + 1;
        for surface in &draped.surfaces {
            writeln!(out, "o body.{}", word(&surface.name))?;
            for place in &surface.vertices {
                vertex(out, "v", [place.x, place.y, place.z])?;
            }
            let smooth = surface.normals.len() == surface.vertices.len();
            for normal in surface.normals.iter().filter(|_| smooth) {
                vertex(out, "vn", [normal.x, normal.y, normal.z])?;
            }
            writeln!(out, "usemtl {}", materials.body(surface.kind))?;
            for corners in &surface.triangles {
                let [a, b, c] = corners.map(|corner| first + corner as usize);
                if smooth {
                    writeln!(out, "f {a}//{a} {b}//{b} {c}//{c}")?;
                } else {
                    writeln!(out, "f {a} {b} {c}")?;
                }
            }
            first += surface.vertices.len();
        }
    }
    Ok(())
}

/// Places, then normals.
fn vertices<'a>(
    out: &mut String,
    vertices: impl Iterator<Item = (&'a Point3<f64>, &'a Vector3<f64>)> + Clone,
) -> fmt::Result {
    for (place, _) in vertices.clone() {
        vertex(out, "v", [place.x, place.y, place.z])?;
    }
    for (_, normal) in vertices {
        vertex(out, "vn", [normal.x, normal.y, normal.z])?;
    }
    Ok(())
}

/// One line of three numbers; what is no number is written as 0.
fn vertex(out: &mut String, what: &str, values: [f64; 3]) -> fmt::Result {
    let [x, y, z] = values.map(|value| if value.is_finite() { value } else { 0.0 });
    writeln!(out, "{what} {x:.6} {y:.6} {z:.6}")
}

/// A name without what would end the line.
fn line(name: &str) -> String {
    name.chars().map(|c| if c.is_control() { ' ' } else { c }).collect()
}

/// A name as one word.
fn word(name: &str) -> String {
    let kept = |c: char| c.is_alphanumeric() || "._-[]".contains(c);
    let word: String = name.chars().map(|c| if kept(c) { c } else { '_' }).collect();
    if word.is_empty() { "_".to_owned() } else { word }
}

/// Materials by name, in the order of first use.
#[derive(Default)]
struct Materials {
    textiles: BTreeMap<(Option<usize>, usize), String>,
    order: Vec<(String, Source)>,
    names: BTreeSet<String>,
}

/// Where a material has its colour from.
#[derive(Clone, Copy)]
enum Source {
    Region(usize),
    Fabric(usize),
    Plain(SurfaceKind),
}

impl Materials {
    fn textile(&mut self, compiled: &Compiled, fabric: usize, region: Option<usize>) -> String {
        if let Some(known) = self.textiles.get(&(region, fabric)) {
            return known.clone();
        }
        let shown = region.and_then(|number| Some((number, compiled.atlas.regions.get(number)?)));
        let (name, source) = match (shown, compiled.fabrics.get(fabric)) {
            (Some((number, region)), _) => (region.name.as_str(), Source::Region(number)),
            (None, Some(cloth)) => (cloth.name.as_str(), Source::Fabric(fabric)),
            (None, None) => ("cloth", Source::Fabric(fabric)),
        };
        let name = self.add(word(name), source);
        self.textiles.insert((region, fabric), name.clone());
        name
    }

    fn body(&mut self, kind: SurfaceKind) -> String {
        let name = match kind {
            SurfaceKind::Body => "wearer",
            SurfaceKind::Solid => "solid",
        };
        let same =
            |(_, source): &&(String, Source)| matches!(source, Source::Plain(k) if *k == kind);
        match self.order.iter().find(same) {
            Some((name, _)) => name.clone(),
            None => self.add(name.to_owned(), Source::Plain(kind)),
        }
    }

    /// Adds a material under this name, or one like it that is free.
    fn add(&mut self, wish: String, source: Source) -> String {
        let mut name = wish.clone();
        let mut number = 2;
        while !self.names.insert(name.clone()) {
            name = format!("{wish}_{number}");
            number += 1;
        }
        self.order.push((name.clone(), source));
        name
    }

    fn write(
        &self,
        out: &mut String,
        compiled: &Compiled,
        stem: &str,
        pictures: &mut Vec<(String, Vec<u8>)>,
    ) -> fmt::Result {
        writeln!(out, "# materials of {}", line(&compiled.name))?;
        for (name, source) in &self.order {
            writeln!(out, "newmtl {name}")?;
            let mut colour = [1.0; 3];
            let mut picture = None;
            match *source {
                Source::Region(number) => {
                    if let Some(region) = compiled.atlas.regions.get(number) {
                        let [width, height] = region.size;
                        writeln!(out, "# the picture is {width:.6} m wide and {height:.6} m high")?;
                        picture = cutting(compiled, region);
                    }
                }
                Source::Fabric(fabric) => colour = srgb(bare(compiled, fabric)),
                Source::Plain(kind) => colour = plain(kind).map(|code| f64::from(code) / 255.0),
            }
            let [red, green, blue] = colour;
            writeln!(out, "Kd {red:.4} {green:.4} {blue:.4}")?;
            writeln!(out, "Ks 0 0 0\nd 1\nillum 1")?;
            if let Some(cutting) = picture {
                let file = format!("{}.{name}.png", line(stem));
                writeln!(out, "map_Kd {file}")?;
                if cutting.open {
                    writeln!(out, "map_d {file}")?;
                }
                pictures.push((file, cutting.png));
            }
        }
        Ok(())
    }
}

/// Linear light as the codes that readers of `.mtl` take, 0 to 1.
fn srgb(light: [f64; 3]) -> [f64; 3] {
    let [red, green, blue, _] = Colour::from_linear(light).0;
    [red, green, blue].map(|code| f64::from(code) / 255.0)
}
