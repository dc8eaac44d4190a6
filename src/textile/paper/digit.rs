//! Digits on five by seven points.

/// Points of a glyph: rows from the top, the left point highest of five bits.
pub(super) fn glyph(sign: char) -> Option<[u8; 7]> {
    Some(match sign {
        '0' => [0b01110, 0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b01110],
        '1' => [0b00100, 0b01100, 0b00100, 0b00100, 0b00100, 0b00100, 0b01110],
        '2' => [0b01110, 0b10001, 0b00001, 0b00110, 0b01000, 0b10000, 0b11111],
        '3' => [0b01110, 0b10001, 0b00001, 0b00110, 0b00001, 0b10001, 0b01110],
        '4' => [0b00010, 0b00110, 0b01010, 0b10010, 0b11111, 0b00010, 0b00010],
        '5' => [0b11111, 0b10000, 0b11110, 0b00001, 0b00001, 0b10001, 0b01110],
        '6' => [0b00110, 0b01000, 0b10000, 0b11110, 0b10001, 0b10001, 0b01110],
        '7' => [0b11111, 0b00001, 0b00010, 0b00010, 0b00100, 0b00100, 0b00100],
        '8' => [0b01110, 0b10001, 0b10001, 0b01110, 0b10001, 0b10001, 0b01110],
        '9' => [0b01110, 0b10001, 0b10001, 0b01111, 0b00001, 0b00010, 0b01100],
        'c' => [0b00000, 0b00000, 0b01110, 0b10000, 0b10000, 0b10001, 0b01110],
        'm' => [0b00000, 0b00000, 0b11010, 0b10101, 0b10101, 0b10101, 0b10101],
        ' ' => [0; 7],
        _ => return None,
    })
}

/// Points from the left of one glyph to the left of the next.
pub(super) const ADVANCE: f64 = 6.0;

/// Points of height.
pub(super) const HEIGHT: f64 = 7.0;

/// The width of a text in pixels, digits of this height.
pub(super) fn width(text: &str, height: f64) -> f64 {
    (text.chars().count() as f64 * ADVANCE - 1.0).max(0.0) * height / HEIGHT
}
