//! How close threads can lie.
//!
//! Peirce (1937) takes yarns as round. Where two systems interlace, a thread of one climbs over a
//! thread of the other, and with D the sum of the two diameters and p₁, p₂ the distances of
//! neighbouring threads at their crossings a plain weave is jammed both ways when
//! √(1 − (p₁/D)²) + √(1 − (p₂/D)²) = 1. In other weaves threads that float lie side by side, a
//! diameter apart, and only those between which the weave changes sides are further apart (Love
//! 1954). Yarns of a square plain weave come to lie 1.73 diameters apart so; the setting of
//! Ashenhurst, which leaves a whole diameter between them, is 2.

use super::fabric::Structure;
use super::weave::Weave;

/// One system of threads: diameter and mean distance, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lie {
    /// Thickness of a thread.
    pub diameter: f64,
    /// Distance from thread to thread.
    pub spacing: f64,
}

/// How closely set warp and weft are: 1 where the cloth is jammed, more where it cannot be
/// woven. `interlacing` is how often the threads change sides as a share of plain weave, along
/// the warp and along the weft, as [`Weave::interlacing`] gives it.
pub fn tightness(warp: Lie, weft: Lie, interlacing: [f64; 2]) -> f64 {
    let together = warp.diameter + weft.diameter;
    // Ends lie apart where a pick changes sides, picks where an end does.
    let bend = |lie: Lie, share: f64| {
        if share <= 0.0 || together <= 0.0 {
            return 0.0;
        }
        let apart = (lie.spacing - (1.0 - share) * lie.diameter) / share;
        let slope = (apart / together).clamp(0.0, 1.0);
        (1.0 - slope * slope).sqrt()
    };
    let [along_warp, along_weft] = interlacing;
    bend(warp, along_weft) + bend(weft, along_warp)
}

/// By how much both spacings must grow for the cloth to be just jammed; 1 where it is looser.
pub fn room_wanted(warp: Lie, weft: Lie, interlacing: [f64; 2]) -> f64 {
    let grown = |by: f64| {
        let of = |lie: Lie| Lie { spacing: lie.spacing * by, ..lie };
        tightness(of(warp), of(weft), interlacing)
    };
    if grown(1.0) <= 1.0 {
        return 1.0;
    }
    let (mut low, mut high) = (1.0, 2.0);
    while grown(high) > 1.0 && high < 1e6 {
        high *= 2.0;
    }
    for _ in 0..40 {
        let middle = (low + high) / 2.0;
        if grown(middle) > 1.0 { low = middle } else { high = middle }
    }
    high
}

/// The same of a woven structure; 1 for knits.
pub fn room_of(structure: &Structure) -> f64 {
    let Structure::Woven { weave, warp, weft } = structure else { return 1.0 };
    let [warp, weft] = [warp, weft].map(|t| Lie { diameter: t.yarn.diameter, spacing: t.spacing });
    room_wanted(warp, weft, Weave::interlacing(weave))
}

/// Cloth is told to be too dense beyond this growth: yarns flatten where they are pressed.
pub const GIVE: f64 = 1.2;

#[cfg(test)]
mod tests {
    use super::*;

    const PLAIN: [f64; 2] = [1.0, 1.0];

    fn lie(spacing: f64) -> Lie {
        Lie { diameter: 1.0, spacing }
    }

    #[test]
    fn a_square_plain_weave_jams_at_the_root_of_three() {
        let jammed = 3_f64.sqrt();
        assert!((tightness(lie(jammed), lie(jammed), PLAIN) - 1.0).abs() < 1e-12);
        assert!((room_wanted(lie(1.0), lie(1.0), PLAIN) - jammed).abs() < 1e-9);
        assert_eq!(room_wanted(lie(1.8), lie(1.8), PLAIN), 1.0);
    }

    #[test]
    fn one_system_may_be_closer_where_the_other_is_open() {
        assert_eq!(tightness(lie(1.0), lie(2.0), PLAIN), 0.75_f64.sqrt());
        assert_eq!(tightness(lie(1.0), lie(1.0), [0.0, 0.0]), 0.0);
        // A satin of eight floats over seven: of eight ends two lie apart.
        let satin = [0.25, 0.25];
        assert!(room_wanted(lie(1.25), lie(1.25), satin) < 1.0 + 1e-9);
        assert!(room_wanted(lie(1.1), lie(1.1), satin) > 1.0);
    }
}
