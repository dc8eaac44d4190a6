//! The surface of a yarn: plies twisted round each other, fibres twisted in them.

use super::bodies::{Bodies, Struck};
use crate::mesh::atlas::{Skin, noise};
use crate::render::Vector;
use std::f32::consts::PI;

/// What the twist and the fibres of a yarn make of a place of it.
#[derive(Clone, Copy, Debug)]
pub struct Surface {
    /// Share of the light that is left there, about 1.
    pub light: f32,
    /// Outwards, with grooves and fibres; unit length.
    pub normal: Vector,
    /// Along the fibres; unit length.
    pub way: Vector,
}

/// Fibres that are told apart round a yarn.
const AROUND: u32 = 72;

/// Depth of the groove between plies over the radius, as far as it turns the normal.
const GROOVE: f32 = 0.5;

/// The same of fibres.
const RIDGE: f32 = 0.022;

impl Surface {
    /// At a place of a yarn. `up` stands on the cloth; `twist` and `fine` from 0 to 1 are how far
    /// plies and fibres are seen; from afar fibres are finer than a pixel.
    pub fn of(bodies: &Bodies, struck: &Struck, up: &Vector, twist: f32, fine: f32) -> Self {
        let skin = &bodies.skins[bodies.yarn(struck.strand)];
        let (normal, way) = (struck.normal, struck.way);
        let side = way.cross(up).try_normalize(1e-6).unwrap_or_else(Vector::x);
        let top = side.cross(&way);
        // Round the yarn, in whole turns from its top.
        let angle = libm::atan2f(normal.dot(&side), normal.dot(&top)) / (2.0 * PI);
        let place = Place { skin, strand: struck.strand, twist, fine };
        let (turn, step) = (0.004, 0.3 / (AROUND as f32 * skin.turns.max(8) as f32));
        let here = place.level(angle, struck.share);
        let round = (place.level(angle + turn, struck.share) - here) / turn;
        let along = (place.level(angle, struck.share + step) - here) / step;
        // Heights are in radii; a turn is 2π radii round, a share of the tile many along.
        let about = way.cross(&normal);
        let radii = bodies.length(struck.strand) / (0.35 * bodies.pitch.max(1e-9));
        let bumped = normal - about * (round / (2.0 * PI)) - way * (along / radii);
        let lean = -skin.slant * 2.0 * PI * skin.turns as f32 / radii;
        Surface {
            light: place.light(angle, struck.share),
            normal: bumped.try_normalize(1e-6).unwrap_or(normal),
            way: (way + about * (0.5 * lean).clamp(-1.0, 1.0)).normalize(),
        }
    }
}

/// One yarn of the tile.
struct Place<'a> {
    skin: &'a Skin,
    strand: u32,
    twist: f32,
    fine: f32,
}

impl Place<'_> {
    /// The angle with the twist taken off.
    fn turned(&self, angle: f32, share: f32) -> f32 {
        angle + self.skin.slant * self.skin.turns as f32 * share
    }

    /// 0 on the back of a ply to 1 in the groove between two.
    fn groove(&self, turned: f32) -> f32 {
        if self.skin.plies < 2 {
            return 0.0;
        }
        let phase = turned * self.skin.plies as f32;
        2.0 * (phase - phase.floor() - 0.5).abs()
    }

    /// Fibres, from −1 to 1: two layers of them, the coarser the longer.
    fn fibres(&self, turned: f32, share: f32) -> f32 {
        let seed = 0x5eed ^ self.strand;
        let cells = self.skin.turns.max(8);
        let fine =
            noise::plane(seed, turned * AROUND as f32, share * cells as f32, [AROUND, cells]);
        let coarse = AROUND / 3;
        let long = cells / 2;
        let broad =
            noise::plane(seed ^ 0xf1b, turned * coarse as f32, share * long as f32, [coarse, long]);
        0.7 * fine + 0.4 * broad
    }

    /// Height over the round yarn, in radii.
    fn level(&self, angle: f32, share: f32) -> f32 {
        let turned = self.turned(angle, share);
        let groove = self.groove(turned);
        // Two round plies meet in a sharp groove: the rise of a circle.
        let ply = -GROOVE * groove * groove / (self.skin.plies.max(2) as f32).sqrt();
        self.twist * ply + RIDGE * self.fine * (self.skin.fibre / 0.2) * self.fibres(turned, share)
    }

    /// Share of the light.
    fn light(&self, angle: f32, share: f32) -> f32 {
        let turned = self.turned(angle, share);
        let groove = self.groove(turned);
        let shade =
            if self.skin.plies > 1 { 0.10 - 0.45 * groove * groove * groove * groove } else { 0.0 };
        let tone = noise::signed(0x70e, self.strand, 0);
        let slow = noise::line(0x5eed ^ self.strand ^ 0xabc, share * 5.0, 5);
        let fibre = 0.9 * self.skin.fibre * self.fine * self.fibres(turned, share);
        (1.0 + self.twist * shade + fibre + self.skin.uneven * (0.7 * tone + 0.5 * slow)).max(0.1)
    }
}
