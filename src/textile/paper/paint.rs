//! A sheet as a picture of pixels.

use super::{Area, Shape, Sheet, digit};
use crate::textile::Colour;
use image::{Rgba, RgbaImage};

/// Paints a sheet on white. Edges between pixels are blended by the area they cover.
pub fn paint(sheet: &Sheet) -> RgbaImage {
    let white = Rgba([255; 4]);
    let mut canvas = Canvas(RgbaImage::from_pixel(sheet.width, sheet.height, white));
    for shape in &sheet.shapes {
        canvas.draw(shape);
    }
    canvas.0
}

struct Canvas(RgbaImage);

impl Canvas {
    fn draw(&mut self, shape: &Shape) {
        match shape {
            Shape::Fill { area, colour } => self.fill(*area, *colour),
            Shape::Marks { corner, cell, inset, runs, colour } => {
                for [column, row, length] in runs {
                    let area = Area {
                        x: corner[0] + f64::from(*column) * cell + inset,
                        y: corner[1] + f64::from(*row) * cell + inset,
                        width: f64::from(*length) * cell - 2.0 * inset,
                        height: cell - 2.0 * inset,
                    };
                    self.fill(area, *colour);
                }
            }
            Shape::Ties { corner, cell, cells, crosses, colour } => {
                for [column, row] in cells {
                    let middle = [
                        corner[0] + (f64::from(*column) + 0.5) * cell + 0.5,
                        corner[1] + (f64::from(*row) + 0.5) * cell + 0.5,
                    ];
                    self.tie(middle, *cell, *crosses, *colour);
                }
            }
            Shape::Thread { area, upright, colour, dips } => {
                self.thread(*area, *upright, *colour, *dips);
            }
            Shape::Line { points, thick, colour } => self.line(points, *thick, *colour),
            Shape::Polygon { points, colour } => self.polygon(points, *colour),
            Shape::Digits { middle, height, text, colour } => {
                self.digits(*middle, *height, text, *colour);
            }
        }
    }

    fn fill(&mut self, area: Area, colour: Colour) {
        self.shade(area, |_, _| (colour.0, 1.0));
    }

    /// Colours each pixel that an area covers: `colour` gives colour and opacity for the middle
    /// of what is covered.
    fn shade(&mut self, area: Area, colour: impl Fn(f64, f64) -> ([u8; 4], f64)) {
        let (right, bottom) = (area.x + area.width, area.y + area.height);
        let (width, height) = self.0.dimensions();
        let from = |start: f64| start.floor().max(0.0) as u32;
        let to = |end: f64, most: u32| (end.ceil().max(0.0) as u32).min(most);
        for y in from(area.y)..to(bottom, height) {
            let (above, below) = (area.y.max(f64::from(y)), bottom.min(f64::from(y + 1)));
            for x in from(area.x)..to(right, width) {
                let (before, behind) = (area.x.max(f64::from(x)), right.min(f64::from(x + 1)));
                let share = (below - above).max(0.0) * (behind - before).max(0.0);
                if share <= 0.0 {
                    continue;
                }
                let (new, opacity) = colour((before + behind) / 2.0, (above + below) / 2.0);
                self.blend(x, y, new, share * opacity);
            }
        }
    }

    fn blend(&mut self, x: u32, y: u32, new: [u8; 4], share: f64) {
        let Some(Rgba(old)) = self.0.get_pixel_mut_checked(x, y) else { return };
        for (old, new) in old.iter_mut().zip(new).take(3) {
            let mixed = f64::from(*old) * (1.0 - share) + f64::from(new) * share;
            *old = (mixed + 0.5) as u8;
        }
    }

    /// A round thread: bright along its middle, dark at its sides and where it dips under others.
    fn thread(&mut self, area: Area, upright: bool, colour: Colour, dips: [f64; 2]) {
        let light = colour.linear();
        let round = |part: f64| (1.0 - part * part).max(0.0).sqrt();
        self.shade(area, |x, y| {
            let (across, along, thick, length) = match upright {
                true => (x - area.x, y - area.y, area.width, area.height),
                false => (y - area.y, x - area.x, area.height, area.width),
            };
            // The light comes from above and a little from the left.
            let part = 2.0 * across / thick - 1.0;
            let mut shade = 0.28 + 0.72 * round(part * 0.96 + 0.04);
            for (dip, far) in [(dips[0], along), (dips[1], length - along)] {
                if far < dip {
                    let sunk = 1.0 - far / dip;
                    shade *= 1.0 - 0.5 * sunk * sunk;
                }
            }
            let gleam = 0.05 * (1.0 - (part + 0.25).abs()).max(0.0) * shade;
            (Colour::from_linear(light.map(|it| it * shade + gleam)).0, 1.0)
        });
    }

    /// A ring for a shaft that rises, a cross for one that sinks.
    fn tie(&mut self, middle: [f64; 2], cell: f64, cross: bool, colour: Colour) {
        let half = cell * 0.28;
        let thick = (cell / 7.0).max(1.0);
        let reach = half + thick;
        let area = Area {
            x: middle[0] - reach,
            y: middle[1] - reach,
            width: 2.0 * reach,
            height: 2.0 * reach,
        };
        self.shade(area, |x, y| {
            let (x, y) = (x - middle[0], y - middle[1]);
            let far = if cross {
                let beyond = (x.abs().max(y.abs()) - half).max(0.0);
                let beside = (x.abs() - y.abs()).abs() / std::f64::consts::SQRT_2;
                beside.max(beyond + thick / 2.0 * f64::from(u8::from(beyond > 0.0)))
            } else {
                (libm::hypot(x, y) - half).abs()
            };
            (colour.0, (thick / 2.0 + 0.5 - far).clamp(0.0, 1.0))
        });
    }

    /// The box round points, widened by `more`.
    fn around(points: &[[f64; 2]], more: f64) -> Area {
        let low = |axis: usize| points.iter().map(|at| at[axis]).fold(f64::INFINITY, f64::min);
        let high = |axis: usize| points.iter().map(|at| at[axis]).fold(f64::NEG_INFINITY, f64::max);
        let (x, y) = (low(0) - more, low(1) - more);
        Area { x, y, width: high(0) + more - x, height: high(1) + more - y }
    }

    fn line(&mut self, points: &[[f64; 2]], thick: f64, colour: Colour) {
        if points.len() < 2 {
            return;
        }
        self.shade(Self::around(points, thick / 2.0 + 1.0), |x, y| {
            let far = points.windows(2).map(|ends| distance([x, y], ends[0], ends[1]));
            let far = far.fold(f64::INFINITY, f64::min);
            (colour.0, (thick / 2.0 + 0.5 - far).clamp(0.0, 1.0))
        });
    }

    fn polygon(&mut self, points: &[[f64; 2]], colour: Colour) {
        if points.len() < 3 {
            return;
        }
        // Sixteen points of a pixel say how much of it is covered.
        const PARTS: usize = 4;
        let inside = |x: f64, y: f64| {
            let edges = points.iter().zip(points.iter().cycle().skip(1));
            let crossed = edges.filter(|(a, b)| {
                (a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
            });
            crossed.count() % 2 == 1
        };
        let mut area = Self::around(points, 0.0);
        // Whole pixels, so that each is shaded at its middle.
        let (right, bottom) = ((area.x + area.width).ceil(), (area.y + area.height).ceil());
        (area.x, area.y) = (area.x.floor(), area.y.floor());
        (area.width, area.height) = (right - area.x, bottom - area.y);
        self.shade(area, |x, y| {
            let at = |n: usize| (n as f64 + 0.5) / PARTS as f64 - 0.5;
            let all = (0..PARTS).flat_map(|i| (0..PARTS).map(move |j| [at(i), at(j)]));
            let covered = all.filter(|[i, j]| inside(x + i, y + j)).count();
            (colour.0, covered as f64 / (PARTS * PARTS) as f64)
        });
    }

    fn digits(&mut self, middle: [f64; 2], height: f64, text: &str, colour: Colour) {
        let point = height / digit::HEIGHT;
        // Whole pixels keep small digits clear.
        let clear = |at: f64| if point.fract() == 0.0 { at.round() } else { at };
        let left = clear(middle[0] - digit::width(text, height) / 2.0);
        let top = clear(middle[1] - height / 2.0);
        for (number, sign) in text.chars().enumerate() {
            let Some(rows) = digit::glyph(sign) else { continue };
            let from = left + number as f64 * digit::ADVANCE * point;
            for (row, bits) in rows.iter().enumerate() {
                for column in (0..5).filter(|column| bits >> (4 - column) & 1 == 1) {
                    let area = Area {
                        x: from + f64::from(column) * point,
                        y: top + row as f64 * point,
                        width: point,
                        height: point,
                    };
                    self.fill(area, colour);
                }
            }
        }
    }
}

/// How far a point lies from the line between two others.
fn distance(at: [f64; 2], from: [f64; 2], to: [f64; 2]) -> f64 {
    let along = [to[0] - from[0], to[1] - from[1]];
    let off = [at[0] - from[0], at[1] - from[1]];
    let square = along[0] * along[0] + along[1] * along[1];
    let part = if square > 0.0 {
        ((off[0] * along[0] + off[1] * along[1]) / square).clamp(0.0, 1.0)
    } else {
        0.0
    };
    libm::hypot(off[0] - part * along[0], off[1] - part * along[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_half_covered_is_half_coloured() {
        let area = Area { x: 1.0, y: 1.0, width: 1.5, height: 1.0 };
        let shapes = vec![Shape::Fill { area, colour: Colour([0, 0, 0, 255]) }];
        let picture = paint(&Sheet { width: 4, height: 3, shapes, ..Sheet::default() });
        let row: Vec<u8> = (0..4).map(|x| picture.get_pixel(x, 1).0[0]).collect();
        assert_eq!(row, [255, 0, 128, 255]);
        assert_eq!(picture.get_pixel(1, 0).0, [255; 4]);
    }

    #[test]
    fn a_thread_is_bright_in_its_middle_and_dark_where_it_dips() {
        let area = Area { x: 0.0, y: 0.0, width: 9.0, height: 40.0 };
        let colour = Colour([200, 40, 40, 255]);
        let shapes = vec![Shape::Thread { area, upright: true, colour, dips: [8.0, 0.0] }];
        let picture = paint(&Sheet { width: 9, height: 40, shapes, ..Sheet::default() });
        let red = |x, y| picture.get_pixel(x, y).0[0];
        assert!(red(4, 20) > 190 && red(0, 20) < 180 && red(8, 20) < 180);
        assert!(red(4, 0) < red(4, 4) && red(4, 4) < red(4, 8));
        assert_eq!(red(4, 39), red(4, 20));
    }

    #[test]
    fn lines_and_polygons_cover_what_they_should() {
        let colour = Colour([0, 0, 0, 255]);
        let points = vec![[1.0, 1.0], [5.0, 1.0], [5.0, 5.0], [1.0, 5.0]];
        let line = Shape::Line { points: vec![[0.0, 7.5], [8.0, 7.5]], thick: 1.0, colour };
        let shapes = vec![Shape::Polygon { points, colour }, line];
        let picture = paint(&Sheet { width: 8, height: 9, shapes, ..Sheet::default() });
        let dark = picture.pixels().filter(|pixel| pixel.0[0] == 0).count();
        assert_eq!(dark, 16 + 8);
        assert_eq!(picture.get_pixel(0, 0).0[0], 255);
    }

    #[test]
    fn what_lies_beyond_the_paper_is_cut() {
        let area = Area { x: -5.0, y: -5.0, width: 1e9, height: 7.0 };
        let shapes = vec![Shape::Fill { area, colour: Colour([0, 0, 0, 255]) }];
        let picture = paint(&Sheet { width: 3, height: 3, shapes, ..Sheet::default() });
        assert_eq!((picture.get_pixel(2, 1).0[0], picture.get_pixel(2, 2).0[0]), (0, 255));
    }
}
