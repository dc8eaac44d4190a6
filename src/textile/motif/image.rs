//! Pictures on the grid of threads: each cell takes the yarn that looks most like its part of the
//! picture.

use crate::textile::Colour;
use std::io::Cursor;

/// Pixels across or down that a picture may have.
pub const LARGEST: u32 = 4096;
/// Memory that decoding may take, bytes.
const MOST_BYTES: u64 = 256 << 20;

/// A picture as linear light with opacity, the light multiplied by it.
#[derive(Clone, Debug)]
pub struct Picture {
    pixels: Vec<[f32; 4]>,
    width: usize,
    height: usize,
}

/// Decodes a PNG, or a picture of the PNM family.
///
/// # Errors
/// What is wrong with it, in a few words.
pub fn decoded(bytes: &[u8]) -> Result<Picture, String> {
    let mut reader = image::ImageReader::new(Cursor::new(bytes))
        .with_guessed_format()
        .map_err(|error| error.to_string())?;
    if reader.format().is_none() {
        return Err("it is neither a PNG nor a PNM picture".to_owned());
    }
    let mut limits = image::Limits::default();
    limits.max_image_width = Some(LARGEST);
    limits.max_image_height = Some(LARGEST);
    limits.max_alloc = Some(MOST_BYTES);
    reader.limits(limits);
    let decoded = reader.decode().map_err(|error| error.to_string())?.into_rgba8();
    let (width, height) = (decoded.width() as usize, decoded.height() as usize);
    if width == 0 || height == 0 {
        return Err("it has no pixels".to_owned());
    }
    let pixel = |image::Rgba([red, green, blue, alpha]): &image::Rgba<u8>| {
        let opacity = f32::from(*alpha) / 255.0;
        let light = Colour([*red, *green, *blue, 255]).linear();
        let [red, green, blue] = light.map(|it| it as f32 * opacity);
        [red, green, blue, opacity]
    };
    let pixels = decoded.pixels().map(pixel).collect();
    Ok(Picture { pixels, width, height })
}

impl Picture {
    /// Its width and height in pixels.
    pub fn size(&self) -> [usize; 2] {
        [self.width, self.height]
    }

    /// The picture in so many columns and rows, bottom row first: each cell is the colour of
    /// `yarns` nearest to the mean light of what it covers, by the distance in CIELAB (CIE 1976,
    /// white D65); none where more than half of it is transparent, or where the ground is nearest.
    pub fn quantised(
        &self,
        cells: [usize; 2],
        yarns: &[Colour],
        ground: Option<Colour>,
    ) -> Vec<Vec<Option<Colour>>> {
        let [columns, rows] = cells;
        let of_yarn = |yarn: &Colour| (Some(*yarn), lab(yarn.linear()));
        // The ground goes before a yarn of its colour.
        let mut known: Vec<(Option<Colour>, [f64; 3])> = Vec::new();
        known.extend(ground.map(|ground| (None, lab(ground.linear()))));
        known.extend(yarns.iter().map(of_yarn));
        let nearest = |light: [f64; 3]| {
            let seen = lab(light);
            let far = |other: &[f64; 3]| -> f64 {
                (0..3).map(|n| (seen[n] - other[n]) * (seen[n] - other[n])).sum()
            };
            let mut best: Option<(Option<Colour>, f64)> = None;
            for (yarn, place) in &known {
                let far = far(place);
                if best.is_none_or(|(_, least)| far < least) {
                    best = Some((*yarn, far));
                }
            }
            best.and_then(|(yarn, _)| yarn)
        };
        // Rows of the picture count downwards.
        (0..rows)
            .rev()
            .map(|row| {
                (0..columns)
                    .map(|column| {
                        let [red, green, blue, opacity] = self.mean(
                            [column as f64 / columns as f64, (column + 1) as f64 / columns as f64],
                            [row as f64 / rows as f64, (row + 1) as f64 / rows as f64],
                        );
                        if opacity < 0.5 {
                            return None;
                        }
                        nearest([red, green, blue].map(|light| light / opacity))
                    })
                    .collect()
            })
            .collect()
    }

    /// The mean over a part of the picture, given in shares of its width and height.
    fn mean(&self, across: [f64; 2], down: [f64; 2]) -> [f64; 4] {
        let spread = |[from, to]: [f64; 2], length: usize| {
            let (from, to) = (from * length as f64, to * length as f64);
            let first = from.floor() as usize;
            let last = (to.ceil() as usize).clamp(first + 1, length);
            (first.min(length - 1)..last).map(move |at| {
                let covered = to.min(at as f64 + 1.0) - from.max(at as f64);
                (at, covered.max(0.0))
            })
        };
        let mut sum = [0.0; 4];
        let mut all = 0.0;
        for (y, high) in spread(down, self.height) {
            for (x, wide) in spread(across, self.width) {
                let pixel = self.pixels[y * self.width + x];
                let weight = high * wide;
                all += weight;
                for (sum, part) in sum.iter_mut().zip(pixel) {
                    *sum += weight * f64::from(part);
                }
            }
        }
        if all > 0.0 { sum.map(|part| part / all) } else { sum }
    }
}

/// CIELAB of linear sRGB light: L 0 to 100, a and b about −100 to 100 (CIE 15:2004; the matrix of
/// IEC 61966-2-1, white D65).
pub fn lab([red, green, blue]: [f64; 3]) -> [f64; 3] {
    let x = 0.412_4 * red + 0.357_6 * green + 0.180_5 * blue;
    let y = 0.212_6 * red + 0.715_2 * green + 0.072_2 * blue;
    let z = 0.019_3 * red + 0.119_2 * green + 0.950_5 * blue;
    let f = |share: f64| {
        if share > 216.0 / 24389.0 {
            libm::cbrt(share)
        } else {
            (24389.0 / 27.0 * share + 16.0) / 116.0
        }
    };
    let [x, y, z] = [f(x / 0.950_47), f(y), f(z / 1.088_83)];
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_is_a_hundred_and_red_is_where_it_is_measured() {
        let near = |found: [f64; 3], wanted: [f64; 3]| {
            found.iter().zip(wanted).all(|(found, wanted)| (found - wanted).abs() < 0.05)
        };
        assert!(near(lab([1.0; 3]), [100.0, 0.0, 0.0]));
        assert!(near(lab([0.0; 3]), [0.0; 3]));
        // The red of sRGB: 53.24, 80.09, 67.20 (Lindbloom).
        assert!(near(lab([1.0, 0.0, 0.0]), [53.24, 80.09, 67.20]), "{:?}", lab([1.0, 0.0, 0.0]));
    }

    #[test]
    fn cells_take_the_nearest_yarn() {
        let ppm = b"P3 4 2 255  250 10 10  250 10 10  0 0 0  255 255 255\n\
                    10 10 240  10 10 240  0 0 0  255 255 255\n";
        let picture = decoded(ppm).unwrap();
        let [red, blue, grey] =
            [[200, 0, 0, 255], [0, 0, 200, 255], [188, 188, 188, 255]].map(Colour);
        let cells = picture.quantised([2, 2], &[red, blue, grey], None);
        // Half black and half white light is a middle grey.
        assert_eq!(cells, [[Some(blue), Some(grey)], [Some(red), Some(grey)]]);
        let cells = picture.quantised([2, 2], &[red, blue], Some(grey));
        assert_eq!(cells[0], [Some(blue), None]);
        // Finer than the picture: each pixel is seen in several cells.
        let fine = picture.quantised([8, 4], &[red, blue, grey], None);
        assert_eq!(fine[3][..4], [Some(red); 4]);
    }

    #[test]
    fn what_is_no_picture_is_told() {
        assert!(decoded(b"hello").is_err());
        assert!(decoded(b"P3 4 2 255 1 2").is_err());
        assert!(decoded(b"P3 99999 99999 255 1 2 3").is_err());
        assert!(decoded(b"\x89PNG\r\n\x1a\n").is_err());
    }
}
