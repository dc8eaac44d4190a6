//! The sheet's layout: views beside one another in rows, all at one scale, each just as wide as
//! its figure needs, the upright ones of a row on one ground line.

use super::camera::{Camera, Window};
use crate::garment::scene::View;

/// A view's rectangle on the sheet: left, top, width, height, pixels.
pub type Frame = [u32; 4];

/// Room round each figure, as a share of the largest extent of any.
const MARGIN: f32 = 0.055;

/// What a further row must gain in scale.
const LARGER: f32 = 1.15;

/// Frames for all views, and how many pixels a figure's unit of [`Window`] takes.
#[derive(Clone, Debug)]
pub struct Layout {
    /// The rectangles; they cover the sheet without overlap.
    pub frames: Vec<Frame>,
    /// Pixels to a window of width 1.
    pub scale: f32,
}

/// One row while its scale is sought.
struct Row {
    first: usize,
    last: usize,
    width: f32,
    height: f32,
}

impl Layout {
    /// The division into rows with the largest scale, or nearly so with fewer rows; opens the windows of the
    /// cameras to all of their frames.
    pub fn of(cameras: &mut [Camera], views: &[View], size: [u32; 2]) -> Self {
        let mut best: Option<(f32, Vec<Row>)> = None;
        let margin = MARGIN * cameras.iter().fold(1e-6_f32, |most, c| most.max(extent(&c.window)));
        level(cameras, views);
        for columns in (1..=cameras.len()).rev() {
            let rows = rows(cameras, columns);
            let widest = rows.iter().fold(0.0_f32, |most, row| {
                most.max(row.width + margin * (row.last - row.first + 1) as f32)
            });
            let high =
                rows.iter().map(|row| row.height).sum::<f32>() + margin * (rows.len() + 1) as f32;
            let scale = (size[0] as f32 / widest).min(size[1] as f32 / high);
            // Views belong in one row, unless more rows show the figure much larger.
            if best.as_ref().is_none_or(|(most, _)| scale > most * LARGER) {
                best = Some((scale, rows));
            }
        }
        let Some((scale, rows)) = best else { return Layout { frames: Vec::new(), scale: 1.0 } };
        let mut frames = Vec::with_capacity(cameras.len());
        let high: f32 = rows.iter().map(|row| row.height).sum();
        let spare = (size[1] as f32 / scale - high) / rows.len() as f32;
        let mut down = 0.0;
        for row in &rows {
            let top = edge(down * scale, size[1]);
            down += row.height + spare;
            let bottom = edge(down * scale, size[1]);
            let free = (size[0] as f32 / scale - row.width) / (row.last - row.first) as f32;
            let mut across = 0.0;
            for camera in &mut cameras[row.first..row.last] {
                let left = edge(across * scale, size[0]);
                across += width(&camera.window) + free;
                let right = edge(across * scale, size[0]);
                camera.window = opened(&camera.window, [right - left, bottom - top], scale);
                frames.push([left, top, right - left, bottom - top]);
            }
        }
        Layout { frames, scale }
    }
}

fn width(window: &Window) -> f32 {
    window[2] - window[0]
}

fn extent(window: &Window) -> f32 {
    width(window).max(window[3] - window[1])
}

/// A place along the sheet in whole pixels.
fn edge(place: f32, whole: u32) -> u32 {
    (place.round().max(0.0) as u32).min(whole)
}

/// Gives the upright views one bottom and one top, so that feet and shoulders stay level from
/// view to view.
fn level(cameras: &mut [Camera], views: &[View]) {
    let upright = |view: Option<&View>| view.is_some_and(|view| *view != View::Top);
    let (mut bottom, mut top) = (f32::INFINITY, f32::NEG_INFINITY);
    for (k, camera) in cameras.iter().enumerate() {
        if upright(views.get(k)) {
            (bottom, top) = (bottom.min(camera.window[1]), top.max(camera.window[3]));
        }
    }
    for (k, camera) in cameras.iter_mut().enumerate() {
        if upright(views.get(k)) {
            (camera.window[1], camera.window[3]) = (bottom, top);
        }
    }
}

/// The views in rows of up to `columns`.
fn rows(cameras: &[Camera], columns: usize) -> Vec<Row> {
    let mut rows = Vec::new();
    for first in (0..cameras.len()).step_by(columns.max(1)) {
        let last = (first + columns).min(cameras.len());
        let windows = cameras[first..last].iter().map(|camera| &camera.window);
        rows.push(Row {
            first,
            last,
            width: windows.clone().map(width).sum(),
            height: windows.fold(0.0, |most, w| most.max(w[3] - w[1])),
        });
    }
    rows
}

/// A window about the same middle that is as large as a frame.
fn opened(window: &Window, size: [u32; 2], scale: f32) -> Window {
    let middle = [0.5 * (window[0] + window[2]), 0.5 * (window[1] + window[3])];
    let half = size.map(|n| n as f32 / (2.0 * scale));
    [middle[0] - half[0], middle[1] - half[1], middle[0] + half[0], middle[1] + half[1]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::Vector;

    const VIEWS: [View; 5] = [View::Front, View::Side, View::Back, View::ThreeQuarter, View::Top];

    fn laid(views: &[View], size: [u32; 2]) -> (Layout, Vec<Camera>) {
        let person = [Vector::new(-0.35, 0.0, -0.2), Vector::new(0.35, 1.7, 0.2)];
        let mut cameras = Camera::around(&person, views, true, None);
        let layout = Layout::of(&mut cameras, views, size);
        (layout, cameras)
    }

    #[test]
    fn frames_cover_the_sheet_without_overlap() {
        for (count, size) in [(4, [1200, 1601]), (3, [1000, 700]), (5, [907, 600]), (2, [1, 1])] {
            let frames = laid(&VIEWS[..count], size).0.frames;
            assert_eq!(frames.len(), count);
            for (k, a) in frames.iter().enumerate() {
                assert!(a[0] + a[2] <= size[0] && a[1] + a[3] <= size[1]);
                for b in &frames[k + 1..] {
                    let apart = a[0] + a[2] <= b[0]
                        || b[0] + b[2] <= a[0]
                        || a[1] + a[3] <= b[1]
                        || b[1] + b[3] <= a[1];
                    assert!(apart, "{a:?} {b:?}");
                }
            }
            assert_eq!(frames.iter().map(|f| f[2] * f[3]).sum::<u32>(), size[0] * size[1]);
        }
    }

    #[test]
    fn tall_figures_stand_in_a_row_on_a_wide_sheet_and_in_two_rows_on_a_tall_one() {
        let rows =
            |size| laid(&VIEWS[..4], size).0.frames.iter().filter(|frame| frame[0] == 0).count();
        assert_eq!(rows([2000, 1000]), 1);
        assert_eq!(rows([1200, 2400]), 2);
    }

    #[test]
    fn a_figure_fills_its_frame_but_for_a_margin_and_all_have_one_scale() {
        for size in [[600, 1200], [1600, 1000], [400, 400]] {
            let (layout, cameras) = laid(&VIEWS[..3], size);
            let mut least = f32::INFINITY;
            for (frame, camera) in layout.frames.iter().zip(&cameras) {
                let [left, bottom, right, top] = camera.window;
                assert!(((right - left) * layout.scale - frame[2] as f32).abs() < 0.01);
                assert!(((top - bottom) * layout.scale - frame[3] as f32).abs() < 0.01);
                for place in [Vector::new(-0.35, 0.0, -0.2), Vector::new(0.35, 1.7, 0.2)] {
                    let [x, y] = camera.picture(&place).unwrap_or_default();
                    least = least.min(x).min(1.0 - x).min(y).min(1.0 - y);
                }
            }
            assert!((0.015..0.08).contains(&least), "{least}");
        }
    }

    #[test]
    fn the_side_takes_less_room_than_the_front() {
        let (layout, _) = laid(&VIEWS[..2], [1600, 1000]);
        assert!(layout.frames[1][2] < layout.frames[0][2]);
    }
}
