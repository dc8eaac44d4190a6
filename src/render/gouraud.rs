//! Light found at the corners of triangles and drawn out between them (H. Gouraud 1971).

use super::camera::Camera;
use super::figure::Figure;
use super::sample::Sampler;
use super::trace::Tracer;
use super::{Light3, Vector};
use rayon::prelude::*;

/// Paths at each side of each corner.
const PATHS: u32 = 48;

/// Matte light at the corners of a figure, as from a white surface, on the side of the normal and
/// on the other.
#[derive(Clone, Debug)]
pub struct CornerLight(Vec<[Light3; 2]>);

impl CornerLight {
    /// Finds it, as it is seen by a camera.
    pub fn found<'a>(
        tracer: impl Fn() -> Tracer<'a> + Sync + Send,
        figure: &'a Figure<'a>,
        camera: &Camera,
        view: u32,
    ) -> Self {
        let mut coats = vec![None; figure.corners.len()];
        for face in &figure.faces {
            for corner in face.corners {
                coats[corner as usize] = Some(face.coat);
            }
        }
        let light = (0..figure.corners.len())
            .into_par_iter()
            .with_min_len(64)
            .map_init(tracer, |tracer, number| {
                let Some(coat) = coats[number] else { return [Light3::zeros(); 2] };
                let corner = &figure.corners[number];
                [1.0, -1.0].map(|side: f32| {
                    let normal: Vector = corner.normal * side;
                    let mut sum = Light3::zeros();
                    for path in 0..PATHS {
                        let place = [number as u32 & 0xffff, number as u32 >> 16];
                        let mut sampler = Sampler::new(view ^ 0x6075_a0d1, place, path, PATHS);
                        sum +=
                            tracer.corner(&corner.place, &normal, coat, &camera.eye, &mut sampler);
                    }
                    sum / PATHS as f32
                })
            })
            .collect();
        CornerLight(light)
    }

    /// At a place between three corners with their shares, on the side of the normals or behind.
    pub fn between(&self, corners: [u32; 3], shares: [f32; 3], behind: bool) -> Light3 {
        let side = usize::from(behind);
        corners.iter().zip(shares).fold(Light3::zeros(), |sum, (corner, share)| {
            sum + self.0.get(*corner as usize).map_or(Light3::zeros(), |both| both[side]) * share
        })
    }
}
