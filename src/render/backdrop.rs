//! The paper behind the figure: a seamless light grey that comes forward as the floor.

use super::Light3;

/// Light of the empty paper at a point of the whole sheet, 0 to 1 from the left and from the top.
/// It is brightest behind the figures and falls off smoothly upwards and, less, to the sides: one
/// sweep behind all views.
pub fn paper(x: f32, y: f32) -> Light3 {
    let (across, down) = ((x - 0.5) * 0.75, (y - 0.60) * 1.05);
    let away = across * across + down * down;
    let glow = 1.0 / (1.0 + 0.85 * away);
    Light3::new(0.690, 0.692, 0.696) * glow
}
