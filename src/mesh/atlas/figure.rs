//! A motif as it is woven: the cells of its chart grown together into soft figures, sharp at any
//! size.

use crate::textile::motif::Motif;

/// A motif ready to be painted: its colours in linear light.
#[derive(Clone, Debug)]
pub struct Figure {
    width: usize,
    height: usize,
    cells: Vec<Option<[f32; 3]>>,
    /// Leftmost and rightmost woven column of each row.
    spans: Vec<Option<[usize; 2]>>,
}

/// What a figure shows at one place.
#[derive(Clone, Copy, Debug)]
pub struct Shown {
    /// Its colour, linear light.
    pub light: [f32; 3],
    /// Share of the pixel that it covers.
    pub cover: f32,
    /// How deep inside the figure: ½ on its outline, 1 well inside, 0 well outside.
    pub depth: f32,
}

impl Figure {
    /// The figure of a motif.
    pub fn of(motif: &Motif) -> Figure {
        let (width, height) = (motif.width(), motif.height());
        let mut cells = Vec::with_capacity(width * height);
        let mut spans = Vec::with_capacity(height);
        for row in 0..height {
            let mut span: Option<[usize; 2]> = None;
            for column in 0..width {
                let cell = motif.cell(column as i64, row as i64);
                if cell.is_some() {
                    span = Some([span.map_or(column, |span| span[0]), column]);
                }
                cells.push(cell.map(super::light::Code::linear));
            }
            spans.push(span);
        }
        Figure { width, height, cells, spans }
    }

    /// Columns and rows of its chart.
    pub fn chart(&self) -> [usize; 2] {
        [self.width, self.height]
    }

    fn cell(&self, column: i64, row: i64) -> Option<[f32; 3]> {
        let inside =
            (0..self.width as i64).contains(&column) && (0..self.height as i64).contains(&row);
        inside.then(|| self.cells[row as usize * self.width + column as usize]).flatten()
    }

    /// What shows at `at`, counted in cells from the lower left corner of the chart, in a pixel
    /// of `pixel` cells each way.
    pub fn at(&self, at: [f32; 2], pixel: [f32; 2]) -> Shown {
        // Where cells are finer than a pixel, the pixel takes the mean of several places.
        let times = pixel.map(|size| (size.ceil().clamp(1.0, 6.0)) as usize);
        if times == [1, 1] {
            return self.place(at, pixel[0].max(pixel[1]));
        }
        let fine = [pixel[0] / times[0] as f32, pixel[1] / times[1] as f32];
        let mut mean = Shown { light: [0.0; 3], cover: 0.0, depth: 0.0 };
        for j in 0..times[1] {
            for i in 0..times[0] {
                let x = at[0] + (i as f32 + 0.5) * fine[0] - 0.5 * pixel[0];
                let y = at[1] + (j as f32 + 0.5) * fine[1] - 0.5 * pixel[1];
                let shown = self.place([x, y], fine[0].max(fine[1]));
                mean.cover += shown.cover;
                mean.depth += shown.depth;
                for (sum, light) in mean.light.iter_mut().zip(shown.light) {
                    *sum += shown.cover * light;
                }
            }
        }
        let count = (times[0] * times[1]) as f32;
        let light = mean.light.map(|sum| sum / mean.cover.max(1e-6));
        Shown { light, cover: mean.cover / count, depth: mean.depth / count }
    }

    /// The field of each colour is its cells blended by smooth steps between the four nearest
    /// middles: ½ on the straight edge of a block of cells, a disc about a single cell, and a
    /// bridge between cells that touch by a corner.
    fn place(&self, at: [f32; 2], pixel: f32) -> Shown {
        let [x, y] = [at[0] - 0.5, at[1] - 0.5];
        let (column, row) = (x.floor(), y.floor());
        let (s, t) = (super::noise::ease(x - column), super::noise::ease(y - row));
        let (column, row) = (column as i64, row as i64);
        let corners = [
            ((1.0 - s) * (1.0 - t), self.cell(column, row)),
            (s * (1.0 - t), self.cell(column + 1, row)),
            ((1.0 - s) * t, self.cell(column, row + 1)),
            (s * t, self.cell(column + 1, row + 1)),
        ];
        let mut depth = 0.0;
        let mut light = [0.0; 3];
        let mut weights = 0.0;
        for (share, cell) in corners {
            let Some(colour) = cell else { continue };
            depth += share;
            // The field of this colour: corners that hold the same.
            let field: f32 = corners
                .iter()
                .filter(|(_, other)| *other == Some(colour))
                .map(|(share, _)| share)
                .sum();
            let weight = (share * field).powi(4);
            weights += weight;
            for (sum, value) in light.iter_mut().zip(colour) {
                *sum += weight * value;
            }
        }
        // The steps are 1.5 steep at the outline.
        let cover = ((depth - 0.5) / (1.5 * pixel.max(1e-3)) + 0.5).clamp(0.0, 1.0);
        let cover = if depth > 0.0 { cover } else { 0.0 };
        Shown { light: light.map(|sum| sum / weights.max(1e-20)), cover, depth }
    }

    /// The thread that floats across the back at this height of the chart, if one does: its
    /// colour, between the outermost cells of the row.
    pub fn float(&self, at: [f32; 2]) -> Option<[f32; 3]> {
        let row = usize::try_from(at[1].floor() as i64).ok()?;
        let [left, right] = (*self.spans.get(row)?)?;
        let inside = at[0] >= left as f32 && at[0] <= right as f32 + 1.0;
        inside.then(|| self.cells[row * self.width + left]).flatten()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::textile::Colour;

    fn figure(rows: &[&str]) -> Figure {
        let cell = |c: char| (c == '*').then_some(Colour([255, 255, 255, 255]));
        let rows = rows.iter().rev().map(|row| row.chars().map(cell).collect()).collect();
        Figure::of(&Motif { name: "test".into(), rows, size: [0.01, 0.01] })
    }

    #[test]
    fn a_block_ends_at_its_cells_and_a_single_cell_is_a_disc() {
        let block = figure(&["****", "****", "****", "****"]);
        let fine = [0.01; 2];
        for edge in [0.0, 4.0] {
            assert!((block.at([edge, 2.0], fine).depth - 0.5).abs() < 1e-6);
        }
        assert_eq!(block.at([2.0, 2.0], fine).cover, 1.0);
        assert_eq!(block.at([-0.1, 2.0], fine).cover, 0.0);
        let dot = figure(&["*"]);
        let radius = |angle: f32| {
            let step = |n: usize| n as f32 * 0.005;
            (0..200)
                .map(step)
                .find(|r| dot.at([0.5 + r * angle.cos(), 0.5 + r * angle.sin()], fine).depth < 0.5)
        };
        for angle in [0.0, 0.4, std::f32::consts::FRAC_PI_4] {
            // Exactly ½ along the axes, 0.505 along the diagonal.
            assert!((radius(angle).unwrap() - 0.5).abs() < 0.02, "{angle}");
        }
    }

    #[test]
    fn cells_that_touch_by_a_corner_are_joined() {
        let steps = figure(&[".*", "*."]);
        assert!((steps.at([1.0, 1.0], [0.01; 2]).depth - 0.5).abs() < 1e-6);
    }

    #[test]
    fn a_figure_far_away_keeps_its_share_of_the_area() {
        let stripes = figure(&["*.*.*.*.", "*.*.*.*."]);
        let shown = stripes.at([4.0, 1.0], [8.0, 2.0]);
        assert!((shown.cover - 0.5).abs() < 0.07, "{}", shown.cover);
    }
}
