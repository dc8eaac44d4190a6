//! A body or a solid as a closed surface of triangles with the places that a tailor names.

use nalgebra::{Point3, Vector3};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A closed surface, m, with outward normals.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Surface {
    /// Name, such as `lady` or `ball`; exported as `body.NAME`.
    pub name: String,
    /// Vertices.
    pub vertices: Vec<Point3<f64>>,
    /// Unit normals of the vertices, outwards.
    pub normals: Vec<Vector3<f64>>,
    /// Triangles, anticlockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Places by name; sided ones end in `.left` or `.right`.
    pub landmarks: BTreeMap<String, Landmark>,
    /// What it is: decides material and how panels are wrapped.
    pub kind: SurfaceKind,
    /// Coulomb friction, where it has one of its own.
    pub friction: Option<f64>,
    /// Which part each vertex belongs to, for wrapping panels; empty for solids.
    pub parts: Vec<BodyPart>,
}

/// What a surface is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum SurfaceKind {
    /// A mannequin.
    Body,
    /// Any other thing.
    #[default]
    Solid,
}

/// Parts of a body that panels are wrapped round.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[allow(missing_docs)]
pub enum BodyPart {
    Trunk,
    Neck,
    Head,
    LeftArm,
    RightArm,
    LeftLeg,
    RightLeg,
}

/// A place on a body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Landmark {
    /// A point of the skin: `navel`, `shoulder.left`, `knee`.
    Point(Point3<f64>),
    /// A closed line on the skin, anticlockwise seen from above (from the hand, for arms):
    /// `waist`, `hip`, `bust`, `neck`, `upper_arm.left`, `wrist.left`.
    Ring {
        /// Middle of the ring.
        centre: Point3<f64>,
        /// Along the trunk upwards, or along the limb towards the trunk; unit length.
        axis: Vector3<f64>,
        /// Points of the line.
        points: Vec<Point3<f64>>,
    },
    /// The middle line of a limb, from the trunk outwards: `arm.left`, `leg.right`.
    Limb {
        /// Points from the shoulder or hip joint to the wrist or ankle.
        points: Vec<Point3<f64>>,
        /// Radius of the limb at each point.
        radii: Vec<f64>,
    },
}
