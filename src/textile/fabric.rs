//! A fabric: structure, yarns, mass and mechanics, all in SI units, warp and weft apart.

use super::{Colour, knit::Knit, weave::Weave, yarn::Yarn};
use serde::{Deserialize, Serialize};

/// How a fabric is made.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Structure {
    /// Warp and weft.
    Woven {
        /// The weave.
        weave: Weave,
        /// Lengthwise thread.
        warp: Thread,
        /// Crosswise thread.
        weft: Thread,
    },
    /// Loops of one yarn. Wales run along the warp direction of the panel, courses along the
    /// weft direction.
    Knitted {
        /// The chart.
        knit: Knit,
        /// The yarn.
        yarn: Yarn,
    },
}

/// A system of parallel threads.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Thread {
    /// What it is.
    pub yarn: Yarn,
    /// Distance from thread to thread, m (one over the sett).
    pub spacing: f64,
    /// Its colour in this fabric.
    pub colour: Colour,
}

/// What was done to the cloth last; it decides how light leaves it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
#[allow(missing_docs)]
pub enum Finish {
    Matte,
    Satin,
    Velvet,
    Wool,
    Raised,
}

/// A fabric. Pairs are warp, weft.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Fabric {
    /// Its name in the text.
    pub name: String,
    /// How it is made.
    pub structure: Structure,
    /// Mass per area, kg/m².
    pub mass: f64,
    /// Thickness, m.
    pub thickness: f64,
    /// Bending rigidity per width, N·m, of the cloth bent along warp, along weft.
    pub bending: [f64; 2],
    /// Tension per width and strain, N/m, along warp, along weft.
    pub tensile: [f64; 2],
    /// Shear force per width and radian of shear, N/m.
    pub shear: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// Coulomb friction, cloth on body and cloth on cloth.
    pub friction: f64,
    /// Share of critical damping in the cloth's own deformations.
    pub damping: f64,
    /// The finish.
    pub finish: Finish,
}

impl Structure {
    /// Mass per area of the yarns alone, kg/m²: for a weave each system's sett × count × (1 +
    /// crimp), for a knit the yarn of a loop times the loops per area.
    pub fn mass(&self) -> f64 {
        match self {
            Structure::Woven { warp, weft, .. } => {
                let [warp_crimp, weft_crimp] = self.crimp();
                warp.yarn.count / warp.spacing * (1.0 + warp_crimp)
                    + weft.yarn.count / weft.spacing * (1.0 + weft_crimp)
            }
            Structure::Knitted { knit, yarn } => {
                yarn.count * knit.loop_length() * knit.wales * knit.courses
            }
        }
    }

    /// Thickness by the yarns, m: in a weave the two systems lie on each other, in a knit two
    /// yarns do.
    pub fn thickness(&self) -> f64 {
        match self {
            Structure::Woven { warp, weft, .. } => warp.yarn.diameter + weft.yarn.diameter,
            Structure::Knitted { yarn, .. } => 2.0 * yarn.diameter,
        }
    }

    /// Share by which warp and weft are longer than the cloth; zero in a knit, whose loops say
    /// it themselves. Peirce 1937: h = ⁴⁄₃ p √c, where both systems rise by half the sum of the
    /// diameters, less often where the weave floats.
    pub fn crimp(&self) -> [f64; 2] {
        let Structure::Woven { weave, warp, weft } = self else {
            return [0.0; 2];
        };
        let rise = (warp.yarn.diameter + weft.yarn.diameter) / 2.0;
        let [along_warp, along_weft] = weave.interlacing();
        let crimp = |spacing: f64| {
            let slope = rise / spacing;
            // Beyond this slope the yarns flatten rather than climb.
            (9.0 / 16.0 * slope * slope).min(0.25)
        };
        [crimp(weft.spacing) * along_warp, crimp(warp.spacing) * along_weft]
    }

    /// Share of the area that threads cover, warp and weft (the cover factors of Peirce, as
    /// shares); a knit is covered by its own loops.
    pub fn cover(&self) -> [f64; 2] {
        match self {
            Structure::Woven { warp, weft, .. } => {
                [warp, weft].map(|thread| (thread.yarn.diameter / thread.spacing).min(1.0))
            }
            Structure::Knitted { .. } => [1.0; 2],
        }
    }
}

impl Fabric {
    /// The colour of its face from far, linear light: warp and weft by the share of crossings at
    /// which each lies on top.
    pub fn light(&self) -> [f64; 3] {
        match &self.structure {
            Structure::Woven { weave, warp, weft } => {
                let share = weave.warp_share();
                let (warp, weft) = (warp.colour.linear(), weft.colour.linear());
                [0, 1, 2].map(|n| share * warp[n] + (1.0 - share) * weft[n])
            }
            Structure::Knitted { knit, yarn } => {
                knit.chart.mean_light(yarn.colour).unwrap_or_else(|| yarn.colour.linear())
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::textile::{
        knit::Stitch,
        yarn::{Fibre, Twist},
    };

    fn yarn(tex: f64, fibre: Fibre) -> Yarn {
        Yarn {
            name: "yarn".into(),
            count: tex * 1e-6,
            plies: 1,
            twist: 600.0,
            direction: Twist::Z,
            fibre,
            colour: Colour([232, 228, 218, 255]),
            diameter: Yarn::diameter_of(tex * 1e-6, fibre),
        }
    }

    fn thread(tex: f64, per_cm: f64) -> Thread {
        let yarn = yarn(tex, Fibre::Cotton);
        Thread { spacing: 0.01 / per_cm, colour: yarn.colour, yarn }
    }

    #[test]
    fn poplin_weighs_what_its_yarns_weigh() {
        // 44 × 32 per cm of 14.5 tex: 63.8 + 46.4 = 110.2 g/m² without crimp, and the crimp of a
        // plain weave is a few percent.
        let woven =
            |weave| Structure::Woven { weave, warp: thread(14.5, 44.0), weft: thread(14.5, 32.0) };
        let plain = woven(Weave::plain());
        let mass = plain.mass() * 1000.0;
        assert!((112.0..138.0).contains(&mass), "{mass} g/m²");
        assert!(plain.crimp()[1] > plain.crimp()[0], "the weft climbs over the denser warp");
        let satin = woven(Weave::satin(5, 2).unwrap());
        assert!(satin.mass() < plain.mass());
        // The diameters of cotton of 14.5 tex: 142.5 µm each.
        assert!((plain.thickness() - 2.85e-4).abs() < 1e-6);
    }

    #[test]
    fn a_double_knitting_jersey_weighs_about_320_grams() {
        let knit = Knit::of_loops("stocking", vec![vec![Stitch::Face]], 220.0, 300.0).unwrap();
        let jersey = Structure::Knitted { knit, yarn: yarn(250.0, Fibre::Wool) };
        // 66 000 loops of 18.1 mm: 1194 m of 250 tex.
        assert!((jersey.mass() - 0.2985).abs() < 1e-3, "{}", jersey.mass());
    }
}
