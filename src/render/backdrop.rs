//! The paper behind the figure: a seamless light grey that comes forward as the floor.

use super::Light3;

/// Light of the empty paper at a point of the picture, 0 to 1 from the left and from the top.
/// It is brightest behind the figure's middle and falls off smoothly, as from a lamp on the wall.
pub fn paper(x: f32, y: f32) -> Light3 {
    let (across, down) = ((x - 0.5) * 1.1, (y - 0.46) * 1.25);
    let away = across * across + down * down;
    // Nearest white in the middle; half as wide again as the picture to fall to 2/3.
    let glow = 1.0 / (1.0 + 0.95 * away);
    Light3::new(0.800, 0.803, 0.808) * glow
}
