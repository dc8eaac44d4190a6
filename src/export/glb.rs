//! glTF 2.0 in its binary form: metres, y up, the wearer facing +z.
//!
//! Each panel is a node with a mesh of its name; each body or solid, if asked for, one named
//! `body.NAME`. The textiles are embedded as one PNG a region. Texture coordinates count widths
//! and heights of a region, so tiles repeat at true scale; a sari's parts lie once.

use super::chunk::Chunk;
use super::material::{bare, cutting, plain};
use super::normal::normals;
use super::patch::{Patch, patches};
use crate::body::surface::{Surface, SurfaceKind};
use crate::drape::draped::Draped;
use crate::mesh::compiled::Compiled;
use crate::textile::Colour;
use crate::textile::fabric::Finish;
use nalgebra::{Point3, Vector3};
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// Wrapping of a texture that repeats, and of one that does not.
const REPEAT: u32 = 10497;
/// See [`REPEAT`].
const CLAMP: u32 = 33071;

/// The dressed figure as a `.glb` file; wearer and solids only `with_body`.
pub fn write(compiled: &Compiled, draped: &Draped, with_body: bool) -> Vec<u8> {
    let mut scene = Scene::default();
    let normals = normals(compiled, &draped.positions);
    for panel in &compiled.panels {
        let primitives: Vec<Value> = patches(compiled, panel)
            .iter()
            .filter_map(|patch| {
                let material = scene.textile(compiled, panel.fabric, patch.region);
                scene.patch(compiled, draped, &normals, patch, material)
            })
            .collect();
        scene.node(&panel.name, primitives);
    }
    if with_body {
        for surface in &draped.surfaces {
            let primitives = scene.surface(surface).into_iter().collect();
            scene.node(&format!("body.{}", surface.name), primitives);
        }
    }
    scene.finish(&compiled.name)
}

/// A file being put together.
#[derive(Default)]
struct Scene {
    chunk: Chunk,
    nodes: Vec<Value>,
    meshes: Vec<Value>,
    materials: Vec<Value>,
    textures: Vec<Value>,
    images: Vec<Value>,
    /// Wrapping of each sampler.
    wraps: Vec<u32>,
    /// Materials of fabrics and regions already made.
    textiles: BTreeMap<(usize, Option<usize>), usize>,
    bodies: BTreeMap<bool, usize>,
    sheen: bool,
}

impl Scene {
    /// The material of a fabric as it shows a region.
    fn textile(&mut self, compiled: &Compiled, fabric: usize, region: Option<usize>) -> usize {
        if let Some(&known) = self.textiles.get(&(fabric, region)) {
            return known;
        }
        let shown = region.and_then(|number| compiled.atlas.regions.get(number));
        let picture = shown.and_then(|region| Some((region, cutting(compiled, region)?)));
        let finish = compiled.fabrics.get(fabric).map_or(Finish::Matte, |fabric| fabric.finish);
        let name = match (&picture, compiled.fabrics.get(fabric)) {
            (Some((region, _)), _) => region.name.clone(),
            (None, Some(fabric)) => fabric.name.clone(),
            (None, None) => "cloth".to_owned(),
        };
        let mut surface = json!({ "metallicFactor": 0.0, "roughnessFactor": roughness(finish) });
        let mut material = json!({ "name": name, "doubleSided": true });
        if let Some((region, cutting)) = picture {
            let view = self.chunk.view(&cutting.png, None);
            self.images.push(json!({
                "name": region.name, "bufferView": view, "mimeType": "image/png"
            }));
            let wrap = if region.tiles { REPEAT } else { CLAMP };
            let sampler = self.wraps.iter().position(|&known| known == wrap).unwrap_or_else(|| {
                self.wraps.push(wrap);
                self.wraps.len() - 1
            });
            self.textures.push(json!({ "sampler": sampler, "source": self.images.len() - 1 }));
            surface["baseColorTexture"] = json!({ "index": self.textures.len() - 1 });
            if cutting.open {
                material["alphaMode"] = json!("MASK");
                material["alphaCutoff"] = json!(0.5);
            }
        } else {
            let [red, green, blue] = bare(compiled, fabric);
            surface["baseColorFactor"] = json!([red, green, blue, 1.0]);
        }
        material["pbrMetallicRoughness"] = surface;
        if let Some(sheen) = sheen(finish) {
            self.sheen = true;
            material["extensions"] = json!({ "KHR_materials_sheen": {
                "sheenColorFactor": [sheen, sheen, sheen], "sheenRoughnessFactor": 0.6
            } });
        }
        self.materials.push(material);
        self.textiles.insert((fabric, region), self.materials.len() - 1);
        self.materials.len() - 1
    }

    /// The faces of one patch with their own vertices, in the order of the particles.
    fn patch(
        &mut self,
        compiled: &Compiled,
        draped: &Draped,
        normals: &[Vector3<f64>],
        patch: &Patch,
        material: usize,
    ) -> Option<Value> {
        let inside = |corner: &u32| (*corner as usize) < draped.positions.len();
        let triangles: Vec<[u32; 3]> =
            patch.all_triangles().filter(|corners| corners.iter().all(inside)).collect();
        let mut used: Vec<u32> = triangles.iter().flatten().copied().collect();
        used.sort_unstable();
        used.dedup();
        let number: BTreeMap<u32, u32> = used.iter().copied().zip(0u32..).collect();
        let triangles: Vec<[u32; 3]> =
            triangles.iter().map(|corners| corners.map(|corner| number[&corner])).collect();
        let on_picture: Vec<[f32; 2]> = used
            .iter()
            .map(|&particle| {
                // Texture coordinates of glTF count downwards.
                let [right, up] = patch.on_region(compiled, particle);
                [right as f32, (1.0 - up) as f32]
            })
            .collect();
        let places: Vec<Point3<f64>> =
            used.iter().map(|&particle| draped.positions[particle as usize]).collect();
        let normals: Vec<Vector3<f64>> =
            used.iter().map(|&particle| normals[particle as usize]).collect();
        self.primitive(&places, &normals, Some(&on_picture), &triangles, material)
    }

    /// A body or a solid.
    fn surface(&mut self, surface: &Surface) -> Option<Value> {
        let body = surface.kind == SurfaceKind::Body;
        let material = *self.bodies.entry(body).or_insert_with(|| {
            let [red, green, blue] = plain(surface.kind);
            let [red, green, blue] = Colour([red, green, blue, 255]).linear();
            self.materials.push(json!({
                "name": if body { "body" } else { "solid" },
                "pbrMetallicRoughness": {
                    "baseColorFactor": [red, green, blue, 1.0],
                    "metallicFactor": 0.0,
                    "roughnessFactor": 0.85,
                },
            }));
            self.materials.len() - 1
        });
        let count = surface.vertices.len() as u32;
        let inside = |corners: &&[u32; 3]| corners.iter().all(|&corner| corner < count);
        let triangles: Vec<[u32; 3]> = surface.triangles.iter().filter(inside).copied().collect();
        let normals = (surface.normals.len() == surface.vertices.len())
            .then_some(surface.normals.as_slice())?;
        self.primitive(&surface.vertices, normals, None, &triangles, material)
    }

    /// One primitive; none without a triangle.
    fn primitive(
        &mut self,
        places: &[Point3<f64>],
        normals: &[Vector3<f64>],
        on_picture: Option<&[[f32; 2]]>,
        triangles: &[[u32; 3]],
        material: usize,
    ) -> Option<Value> {
        if triangles.is_empty() {
            return None;
        }
        let single = |values: [f64; 3]| {
            values.map(|value| if value.is_finite() { value as f32 } else { 0.0 })
        };
        let places: Vec<[f32; 3]> = places.iter().map(|p| single([p.x, p.y, p.z])).collect();
        let normals: Vec<[f32; 3]> = normals
            .iter()
            .map(|n| {
                let unit = single([n.x, n.y, n.z]);
                let length = unit.iter().map(|v| v * v).sum::<f32>().sqrt();
                if length > 0.1 { unit.map(|v| v / length) } else { [0.0, 1.0, 0.0] }
            })
            .collect();
        let mut attributes = json!({
            "POSITION": self.chunk.vectors(&places),
            "NORMAL": self.chunk.vectors(&normals),
        });
        if let Some(on_picture) = on_picture {
            attributes["TEXCOORD_0"] = json!(self.chunk.vectors(on_picture));
        }
        let indices = self.chunk.triangles(triangles);
        Some(json!({ "attributes": attributes, "indices": indices, "material": material }))
    }

    /// A node with a mesh of its own; a panel without a face has none.
    fn node(&mut self, name: &str, primitives: Vec<Value>) {
        if primitives.is_empty() {
            return;
        }
        self.meshes.push(json!({ "name": name, "primitives": primitives }));
        self.nodes.push(json!({ "name": name, "mesh": self.meshes.len() - 1 }));
    }

    /// The bytes of the file: a header, the description, the buffer.
    fn finish(mut self, name: &str) -> Vec<u8> {
        self.chunk.bytes.resize(self.chunk.bytes.len().next_multiple_of(4), 0);
        let generator = concat!("darzi ", env!("CARGO_PKG_VERSION"));
        let mut file = json!({
            "asset": { "version": "2.0", "generator": generator },
            "scene": 0,
            "scenes": [{ "name": name }],
        });
        let roots: Vec<usize> = (0..self.nodes.len()).collect();
        if !roots.is_empty() {
            file["scenes"][0]["nodes"] = json!(roots);
            file["buffers"] = json!([{ "byteLength": self.chunk.bytes.len() }]);
        }
        let sampler = |wrap: &u32| {
            // Linear between pixels, linear between the two nearest levels.
            json!({ "magFilter": 9729, "minFilter": 9987, "wrapS": wrap, "wrapT": wrap })
        };
        if self.sheen {
            file["extensionsUsed"] = json!(["KHR_materials_sheen"]);
        }
        // glTF knows no empty lists.
        for (key, list) in [
            ("nodes", self.nodes),
            ("meshes", self.meshes),
            ("materials", self.materials),
            ("textures", self.textures),
            ("images", self.images),
            ("samplers", self.wraps.iter().map(sampler).collect()),
            ("accessors", self.chunk.accessors),
            ("bufferViews", self.chunk.views),
        ] {
            if !list.is_empty() {
                file[key] = Value::Array(list);
            }
        }
        let mut text = file.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let buffer = self.chunk.bytes;
        let mut chunks = vec![(0x4e4f_534a_u32, text)];
        if !buffer.is_empty() {
            chunks.push((0x004e_4942, buffer));
        }
        let length: usize = 12 + chunks.iter().map(|(_, bytes)| 8 + bytes.len()).sum::<usize>();
        let mut glb = Vec::with_capacity(length);
        glb.extend_from_slice(b"glTF");
        glb.extend_from_slice(&2u32.to_le_bytes());
        glb.extend_from_slice(&(length as u32).to_le_bytes());
        for (kind, bytes) in chunks {
            glb.extend_from_slice(&(bytes.len() as u32).to_le_bytes());
            glb.extend_from_slice(&kind.to_le_bytes());
            glb.extend_from_slice(&bytes);
        }
        glb
    }
}

/// Roughness of a finish.
fn roughness(finish: Finish) -> f64 {
    match finish {
        Finish::Satin => 0.45,
        Finish::Matte => 0.9,
        Finish::Velvet | Finish::Wool | Finish::Raised => 1.0,
    }
}

/// Light that stands off a hairy surface at its rims.
fn sheen(finish: Finish) -> Option<f64> {
    match finish {
        Finish::Matte | Finish::Satin => None,
        Finish::Wool => Some(0.15),
        Finish::Raised => Some(0.25),
        Finish::Velvet => Some(0.5),
    }
}
