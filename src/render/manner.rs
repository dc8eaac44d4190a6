//! How cloth is shown: as what each fabric is, or in one named way.

use super::finish::Look;
use crate::garment::scene::Shading;
use crate::textile::fabric::{Fabric, Finish};

/// What a named way of shading keeps and what it leaves out.
#[derive(Clone, Copy, Debug)]
pub struct Manner {
    /// Whether triangles are curved by their normals.
    pub curved: bool,
    /// Whether light is found at the corners only and drawn out between them.
    pub at_corners: bool,
    /// What of the textile is seen.
    pub textile: Textile,
    /// How far fibres are seen on yarns that are near; none where yarns are never shown as bodies.
    pub fibres: Option<f32>,
    /// How light leaves it; none as the fabric's own finish says.
    gloss: Option<Gloss>,
}

/// What of a textile is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Textile {
    /// One colour.
    Colour,
    /// Motifs and stripes, but no thread.
    Pattern,
    /// Threads and loops.
    Threads,
}

/// How light leaves cloth that is shown otherwise than its finish says.
#[derive(Clone, Copy, Debug)]
enum Gloss {
    /// Without any.
    None,
    /// As after this finish.
    As(Finish),
}

/// Through a window of this width threads are too fine to be told from each other, m.
pub const BLURRED: f32 = 2.5e-3;

impl Manner {
    /// Of a named way, or of none.
    pub fn of(shading: Option<Shading>) -> Self {
        let own = Manner {
            curved: true,
            at_corners: false,
            textile: Textile::Threads,
            fibres: Some(1.0),
            gloss: None,
        };
        let matte = Some(Gloss::None);
        match shading {
            None | Some(Shading::KnittedYarns) => own,
            Some(Shading::Knitted) => Manner { fibres: Some(0.0), ..own },
            Some(Shading::Gouraud) => {
                let textile = Textile::Colour;
                Manner { curved: false, at_corners: true, textile, fibres: None, gloss: matte }
            }
            Some(Shading::Smooth) => {
                Manner { textile: Textile::Colour, fibres: None, gloss: matte, ..own }
            }
            Some(Shading::Textured) => Manner { fibres: None, gloss: matte, ..own },
            Some(Shading::Velvet) => {
                let gloss = Some(Gloss::As(Finish::Velvet));
                Manner { textile: Textile::Pattern, fibres: None, gloss, ..own }
            }
            Some(Shading::Satin) => {
                let gloss = Some(Gloss::As(Finish::Satin));
                Manner { textile: Textile::Pattern, fibres: None, gloss, ..own }
            }
            Some(Shading::Woven) => Manner { gloss: Some(Gloss::As(Finish::Matte)), ..own },
            Some(Shading::WovenSatin) => Manner { gloss: Some(Gloss::As(Finish::Satin)), ..own },
        }
    }

    /// The look of a side of a fabric.
    pub fn look(&self, fabric: &Fabric, back: bool) -> Look {
        match self.gloss {
            None => Look::of_fabric(fabric, fabric.finish, back),
            Some(Gloss::As(finish)) => Look::of_fabric(fabric, finish, back),
            Some(Gloss::None) => Look::matte(fabric),
        }
    }

    /// The looks of the yarns of a fabric, warp and weft.
    pub fn yarn_looks(&self, fabric: &Fabric) -> [Look; 2] {
        let finish = match self.gloss {
            Some(Gloss::As(finish)) => finish,
            _ => fabric.finish,
        };
        [0, 1].map(|thread| Look::of_yarn(fabric, finish, thread))
    }
}
