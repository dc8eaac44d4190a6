//! The grid of a panel: which lattice points lie in the cloth, and which cells stay intact.

use crate::geometry::polygon::{Place, distance_to_side, sides};

/// Lattice points are told from points of the outline to this share of a cell.
const SAME: f64 = 1e-6;
/// Distances from the outline are known up to this many cells.
pub const FAR: f32 = 4.0;

/// A square lattice aligned with weft (u) and warp (v).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lattice {
    /// Place of point (0, 0), m.
    pub origin: Place,
    /// Side of a cell, m.
    pub cell: f64,
    /// Points along u and along v.
    pub count: [usize; 2],
}

impl Lattice {
    /// The lattice over a polygon whose middle is the middle of the polygon's box, so that a
    /// symmetrical panel gets a symmetrical grid, with as many cells along each side of the box
    /// as come nearest to it.
    pub fn over(ring: &[Place], cell: f64) -> Self {
        let mut lattice = Lattice { origin: [0.0; 2], cell, count: [1; 2] };
        for axis in 0..2 {
            let low = ring.iter().map(|place| place[axis]).fold(f64::INFINITY, f64::min);
            let high = ring.iter().map(|place| place[axis]).fold(f64::NEG_INFINITY, f64::max);
            let cells = ((high - low) / cell).round().max(1.0);
            // Where whole cells fill the box the first line lies on its edge to the last bit.
            lattice.origin[axis] = if ((high - low) / cell - cells).abs() < SAME {
                low
            } else {
                (low + high) / 2.0 - cells * cell / 2.0
            };
            lattice.count[axis] = cells as usize + 1;
        }
        lattice
    }

    /// Number of points.
    pub fn points(&self) -> usize {
        self.count[0] * self.count[1]
    }

    /// Number of the point (i, j), row by row.
    pub fn number(&self, i: usize, j: usize) -> usize {
        j * self.count[0] + i
    }

    /// Column and row of a point.
    pub fn column_row(&self, number: usize) -> [usize; 2] {
        [number % self.count[0], number / self.count[0]]
    }

    /// Its place, m.
    pub fn place(&self, number: usize) -> Place {
        let [i, j] = self.column_row(number);
        [self.line(0, i), self.line(1, j)]
    }

    fn line(&self, axis: usize, number: usize) -> f64 {
        self.origin[axis] + number as f64 * self.cell
    }

    /// The point that lies at a place to within a millionth of a cell.
    pub fn point_at(&self, place: Place) -> Option<usize> {
        let mut at = [0; 2];
        for axis in 0..2 {
            let x = (place[axis] - self.origin[axis]) / self.cell;
            let nearest = x.round();
            if (x - nearest).abs() > SAME || nearest < 0.0 {
                return None;
            }
            at[axis] = nearest as usize;
            if at[axis] >= self.count[axis] {
                return None;
            }
        }
        Some(self.number(at[0], at[1]))
    }

    /// Lines of an axis from `low` to `high`, m, as a range of numbers.
    fn lines(&self, axis: usize, low: f64, high: f64) -> std::ops::Range<usize> {
        let most = self.count[axis] as f64;
        let first = ((low - self.origin[axis]) / self.cell).ceil().clamp(0.0, most);
        let last = ((high - self.origin[axis]) / self.cell).floor().clamp(-1.0, most - 1.0);
        first as usize..(last + 1.0) as usize
    }
}

/// What the lattice points and cells of a panel are.
#[derive(Clone, Debug)]
pub struct Ground {
    /// The lattice.
    pub lattice: Lattice,
    /// Distance of each point from the outline in cells, at most [`FAR`]; negative outside.
    pub depth: Vec<f32>,
    /// The outline point that lies on a lattice point, `u32::MAX` where there is none.
    pub on_outline: Vec<u32>,
    /// Whether the cell whose lower left corner the point is stays intact.
    pub intact: Vec<bool>,
}

impl Ground {
    /// Lays the lattice under closed lines (the outline anticlockwise, holes clockwise) and
    /// keeps the cells whose corners lie at least `margin` cells inside, or are points of the
    /// outline themselves.
    pub fn new(lattice: Lattice, rings: &[Vec<Place>], margin: f32) -> Self {
        let points = lattice.points();
        let mut ground = Ground {
            lattice,
            depth: vec![-FAR; points],
            on_outline: vec![u32::MAX; points],
            intact: vec![false; points],
        };
        ground.fill(rings);
        let mut cut = vec![false; points];
        ground.measure(rings, &mut cut);
        ground.find_intact(rings, &cut, margin);
        ground
    }

    /// Marks the points within the outline, row by row.
    fn fill(&mut self, rings: &[Vec<Place>]) {
        let lattice = self.lattice;
        let mut crossings: Vec<Vec<f64>> = vec![Vec::new(); lattice.count[1]];
        for (a, b) in rings.iter().flat_map(|ring| sides(ring)) {
            let (low, high) = (a[1].min(b[1]), a[1].max(b[1]));
            // A little more than the side's own rows, against rounding; the next lines decide.
            let slack = SAME * lattice.cell;
            for j in lattice.lines(1, low - slack, high + slack) {
                let v = lattice.line(1, j);
                if (a[1] <= v) != (b[1] <= v) {
                    crossings[j].push(a[0] + (v - a[1]) / (b[1] - a[1]) * (b[0] - a[0]));
                }
            }
        }
        for (j, row) in crossings.iter_mut().enumerate() {
            row.sort_by(f64::total_cmp);
            for pair in row.chunks_exact(2) {
                let inside = lattice.lines(0, pair[0], pair[1]);
                let (start, end) = (inside.start, inside.end.max(inside.start));
                self.depth[lattice.number(start, j)..lattice.number(end, j)].fill(FAR);
            }
        }
    }

    /// Measures distances near the outline, finds the points on it and the cells it cuts.
    fn measure(&mut self, rings: &[Vec<Place>], cut: &mut [bool]) {
        let lattice = self.lattice;
        let cell = lattice.cell;
        let mut number = 0;
        for ring in rings {
            for (a, b) in sides(ring) {
                let reach = f64::from(FAR) * cell;
                let range = |axis: usize, reach: f64| {
                    let (low, high) = (a[axis].min(b[axis]), a[axis].max(b[axis]));
                    lattice.lines(axis, low - reach, high + reach)
                };
                for j in range(1, reach) {
                    for i in range(0, reach) {
                        let point = lattice.number(i, j);
                        let away = (distance_to_side(lattice.place(point), a, b) / cell) as f32;
                        let depth = &mut self.depth[point];
                        *depth = if *depth < 0.0 { -away.min(-*depth) } else { away.min(*depth) };
                    }
                }
                // Cells that the side enters, or on whose rim an outline point lies off the grid.
                let on_grid = lattice.point_at(a);
                if let Some(point) = on_grid {
                    self.on_outline[point] = number;
                }
                for j in range(1, 1.5 * cell) {
                    for i in range(0, 1.5 * cell) {
                        let corner = lattice.place(lattice.number(i, j));
                        let hanging = on_grid.is_none() && reaches(corner, cell, SAME, (a, a));
                        if hanging || reaches(corner, cell, -SAME, (a, b)) {
                            cut[lattice.number(i, j)] = true;
                        }
                    }
                }
                number += 1;
            }
        }
    }

    fn find_intact(&mut self, rings: &[Vec<Place>], cut: &[bool], margin: f32) {
        let lattice = self.lattice;
        let holds = |point: usize| self.on_outline[point] != u32::MAX;
        for j in 0..lattice.count[1].saturating_sub(1) {
            for i in 0..lattice.count[0].saturating_sub(1) {
                let corners = self.corners(i, j);
                let number = corners[0];
                let mut inside = false;
                let fit = corners.iter().all(|&point| {
                    let deep = self.depth[point] >= margin;
                    inside |= deep;
                    deep || holds(point)
                });
                if fit && !cut[number] {
                    let middle = [0, 1].map(|axis| {
                        (lattice.place(corners[0])[axis] + lattice.place(corners[2])[axis]) / 2.0
                    });
                    let inside = inside || crate::geometry::polygon::contains(rings, middle);
                    self.intact[number] = inside;
                }
            }
        }
    }

    /// The corners of the cell at column i, row j, anticlockwise.
    pub fn corners(&self, i: usize, j: usize) -> [usize; 4] {
        let lattice = &self.lattice;
        [
            lattice.number(i, j),
            lattice.number(i + 1, j),
            lattice.number(i + 1, j + 1),
            lattice.number(i, j + 1),
        ]
    }

    /// The cells around a point that are on the lattice, by their lower left corners.
    pub fn cells_around(&self, point: usize) -> impl Iterator<Item = usize> + '_ {
        let [i, j] = self.lattice.column_row(point);
        let [columns, rows] = self.lattice.count;
        [(0, 0), (1, 0), (1, 1), (0, 1)].into_iter().filter_map(move |(left, down)| {
            let (i, j) = (i.checked_sub(left)?, j.checked_sub(down)?);
            (i + 1 < columns && j + 1 < rows).then(|| self.lattice.number(i, j))
        })
    }
}

/// Whether a stretch comes into the square at `corner`, grown by `slack` cells on each side.
fn reaches(corner: Place, cell: f64, slack: f64, (a, b): (Place, Place)) -> bool {
    // Clip the stretch by the four sides in turn.
    let (mut from, mut to) = (0.0f64, 1.0f64);
    for axis in 0..2 {
        let (low, high) = (corner[axis] - slack * cell, corner[axis] + (1.0 + slack) * cell);
        let way = b[axis] - a[axis];
        if way == 0.0 {
            if a[axis] < low || a[axis] > high {
                return false;
            }
        } else {
            let (p, q) = ((low - a[axis]) / way, (high - a[axis]) / way);
            from = from.max(p.min(q));
            to = to.min(p.max(q));
        }
    }
    from <= to
}
