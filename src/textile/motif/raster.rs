//! Paths of SVG on the grid of threads: a cell is woven where its middle lies inside.

use kurbo::{Affine, BezPath, PathEl, Point, Rect, Shape};

/// What lies inside a path that crosses itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FillRule {
    /// What it runs round an odd number of times.
    EvenOdd,
    /// What it runs round more often one way than the other.
    NonZero,
}

/// Coordinates a path may have, in its own units.
const FARTHEST: f64 = 1e9;
/// How far a path may reach beyond the grid, in its columns or rows.
const BEYOND: f64 = 64.0;
/// Crossings of paths with rows that are worked out at most.
const CROSSINGS: usize = 1 << 24;
/// Parts of a cell to which curves are true.
const FINE: f64 = 32.0;

/// The path of such data: SVG 1.1, section 8.3.
///
/// # Errors
/// What is wrong with it, in a few words.
pub fn path(data: &str) -> Result<BezPath, String> {
    let path = BezPath::from_svg(data).map_err(|error| error.to_string())?;
    let bounds = path.control_box();
    let far = [bounds.x0, bounds.y0, bounds.x1, bounds.y1];
    if path.elements().is_empty() {
        return Err("it has no points".to_owned());
    }
    if !far.iter().all(|at| at.abs() <= FARTHEST) {
        return Err("its coordinates are out of reach".to_owned());
    }
    Ok(path)
}

/// The smallest upright rectangle round all paths.
pub fn bounds(paths: &[BezPath]) -> Rect {
    let mut boxes = paths.iter().map(Shape::bounding_box);
    let first = boxes.next().unwrap_or(Rect::ZERO);
    boxes.fold(first, |all, one| all.union(one))
}

/// How a frame of the paths' own units is laid on a motif: as large as it fits, in the middle, its
/// proportions kept. `size` is that of the motif and `cells` its columns and rows; the result maps
/// to cells, the first row at the bottom, though paths count downwards.
pub fn fitted(frame: Rect, size: [f64; 2], cells: [usize; 2]) -> Option<Affine> {
    if !(frame.width() > 0.0 && frame.height() > 0.0) {
        return None;
    }
    // So much longer is one unit of the path on the motif, m.
    let scale = (size[0] / frame.width()).min(size[1] / frame.height());
    let pitch = [size[0] / cells[0] as f64, size[1] / cells[1] as f64];
    let middle = frame.center();
    let place = Affine::translate((cells[0] as f64 / 2.0, cells[1] as f64 / 2.0))
        * Affine::scale_non_uniform(scale / pitch[0], -scale / pitch[1])
        * Affine::translate((-middle.x, -middle.y));
    place.as_coeffs().iter().all(|it| it.is_finite()).then_some(place)
}

/// The cells of a path that is given in cells, bottom row first: true inside. Takes time in
/// proportion to the cells and to what the path crosses of them.
///
/// # Errors
/// Why the path is too large for the grid.
pub fn raster(
    path: &BezPath,
    cells: [usize; 2],
    rule: FillRule,
) -> Result<Vec<Vec<bool>>, &'static str> {
    let [columns, rows] = cells;
    let reach = path.control_box();
    let beyond = |at: f64, length: usize| !(at.abs() <= BEYOND * (length as f64 + 1.0));
    if [reach.x0, reach.x1].iter().any(|&at| beyond(at, columns))
        || [reach.y0, reach.y1].iter().any(|&at| beyond(at, rows))
    {
        return Err("it reaches far beyond its frame");
    }
    if path.elements().len().saturating_mul(rows) > CROSSINGS {
        return Err("it has too many pieces for so many rows");
    }
    // Where the middle line of each row is crossed, and which way.
    let mut crossed: Vec<Vec<(f64, i32)>> = vec![Vec::new(); rows];
    let mut edge = |from: Point, to: Point| {
        let (low, high, way) = if from.y < to.y { (from, to, 1) } else { (to, from, -1) };
        // Middles are counted from the low end on and without the high end.
        let first = (low.y - 0.5).ceil().max(0.0);
        let last = (high.y - 0.5).ceil().min(rows as f64);
        let mut row = first;
        while row < last {
            let share = (row + 0.5 - low.y) / (high.y - low.y);
            crossed[row as usize].push((low.x + share * (high.x - low.x), way));
            row += 1.0;
        }
    };
    let mut start = Point::ZERO;
    let mut last = Point::ZERO;
    kurbo::flatten(path, 1.0 / FINE, |element| match element {
        PathEl::MoveTo(to) => {
            // A part that is not closed is closed by a straight line.
            edge(last, start);
            (start, last) = (to, to);
        }
        PathEl::LineTo(to) => {
            edge(last, to);
            last = to;
        }
        PathEl::ClosePath => {
            edge(last, start);
            last = start;
        }
        // Curves come as lines.
        PathEl::QuadTo(_, to) | PathEl::CurveTo(_, _, to) => {
            edge(last, to);
            last = to;
        }
    });
    edge(last, start);
    let filled = crossed
        .into_iter()
        .map(|mut row| {
            row.sort_by(|one, other| one.0.total_cmp(&other.0));
            let mut places = row.into_iter().peekable();
            let (mut round, mut times) = (0, 0);
            (0..columns)
                .map(|column| {
                    while let Some((_, way)) = places.next_if(|(at, _)| *at <= column as f64 + 0.5)
                    {
                        round += way;
                        times += 1;
                    }
                    match rule {
                        FillRule::EvenOdd => times % 2 == 1,
                        FillRule::NonZero => round != 0,
                    }
                })
                .collect()
        })
        .collect();
    Ok(filled)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The cells as text, top row first.
    fn drawn(data: &str, rule: FillRule, frame: [f64; 2], cells: [usize; 2]) -> Vec<String> {
        let frame = Rect::new(0.0, 0.0, frame[0], frame[1]);
        let place = fitted(frame, [cells[0] as f64, cells[1] as f64], cells).unwrap();
        let rows = raster(&(place * path(data).unwrap()), cells, rule).unwrap();
        let row = |row: &Vec<bool>| row.iter().map(|&it| if it { '#' } else { '.' }).collect();
        rows.iter().rev().map(row).collect()
    }

    #[test]
    fn a_triangle_stands_on_its_base() {
        let found = drawn("M0 4 L8 4 L4 0 Z", FillRule::NonZero, [8.0, 4.0], [8, 4]);
        // A middle that lies on the line counts at the left and not at the right.
        assert_eq!(found, ["...#....", "..###...", ".#####..", "#######."]);
        // Without its end it is closed all the same.
        assert_eq!(drawn("M0 4 H8 L4 0", FillRule::EvenOdd, [8.0, 4.0], [8, 4]), found);
    }

    #[test]
    fn a_square_in_a_square_is_a_hole_or_not() {
        let data = "M0 0 H6 V6 H0 Z M2 2 H4 V4 H2 Z";
        let odd = drawn(data, FillRule::EvenOdd, [6.0, 6.0], [6, 6]);
        assert_eq!(odd[2], "##..##");
        assert!(drawn(data, FillRule::NonZero, [6.0, 6.0], [6, 6]).iter().all(|r| r == "######"));
        let back = "M0 0 H6 V6 H0 Z M2 2 V4 H4 V2 Z";
        assert_eq!(drawn(back, FillRule::NonZero, [6.0, 6.0], [6, 6]), odd);
    }

    #[test]
    fn a_circle_covers_its_area() {
        let data = "M0 50 A50 50 0 0 1 100 50 A50 50 0 0 1 0 50 Z";
        let rows = drawn(data, FillRule::NonZero, [100.0, 100.0], [200, 200]);
        let inside = rows.iter().map(|row| row.matches('#').count()).sum::<usize>();
        // The boundary passes about 8 r cells, of which each errs by less than a half.
        let area = std::f64::consts::PI * 100.0 * 100.0;
        assert!((inside as f64 - area).abs() < 400.0, "{inside}");
    }

    #[test]
    fn what_is_no_path_is_told() {
        assert!(path("M0 0 X5").is_err());
        assert!(path("").is_err());
        assert!(path("M0 0 L1e300 0").is_err());
        assert_eq!(fitted(Rect::new(0.0, 0.0, 0.0, 5.0), [1.0, 1.0], [4, 4]), None);
    }
}
