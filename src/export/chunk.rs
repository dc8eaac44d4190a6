//! The binary part of a glTF file: views of one buffer and the accessors that read them.

use serde_json::{Value, json};

/// `ARRAY_BUFFER` of glTF.
const VERTICES: u32 = 34962;
/// `ELEMENT_ARRAY_BUFFER` of glTF.
const INDICES: u32 = 34963;

/// A buffer being filled.
#[derive(Default)]
pub struct Chunk {
    /// Its bytes.
    pub bytes: Vec<u8>,
    /// `bufferViews` of the file.
    pub views: Vec<Value>,
    /// `accessors` of the file.
    pub accessors: Vec<Value>,
}

impl Chunk {
    /// Adds bytes, aligned to four; gives the number of their view.
    pub fn view(&mut self, bytes: &[u8], target: Option<u32>) -> usize {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let mut view =
            json!({ "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len() });
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        self.bytes.extend_from_slice(bytes);
        self.views.push(view);
        self.views.len() - 1
    }

    /// Adds vectors of single precision; gives the number of their accessor, which states their
    /// bounds.
    pub fn vectors<const N: usize>(&mut self, vectors: &[[f32; N]]) -> usize {
        let bytes: Vec<u8> =
            vectors.iter().flatten().flat_map(|value| value.to_le_bytes()).collect();
        let view = self.view(&bytes, Some(VERTICES));
        let bound = |pick: fn(f32, f32) -> f32, start: f32| -> Vec<f64> {
            let over = |axis: usize| vectors.iter().map(|v| v[axis]).fold(start, pick);
            (0..N).map(|axis| f64::from(over(axis))).collect()
        };
        self.accessors.push(json!({
            "bufferView": view,
            "componentType": 5126,
            "count": vectors.len(),
            "type": format!("VEC{N}"),
            "min": bound(f32::min, f32::INFINITY),
            "max": bound(f32::max, f32::NEG_INFINITY),
        }));
        self.accessors.len() - 1
    }

    /// Adds the corners of triangles; gives the number of their accessor.
    pub fn triangles(&mut self, triangles: &[[u32; 3]]) -> usize {
        let bytes: Vec<u8> =
            triangles.iter().flatten().flat_map(|corner| corner.to_le_bytes()).collect();
        let view = self.view(&bytes, Some(INDICES));
        self.accessors.push(json!({
            "bufferView": view,
            "componentType": 5125,
            "count": 3 * triangles.len(),
            "type": "SCALAR",
        }));
        self.accessors.len() - 1
    }
}
