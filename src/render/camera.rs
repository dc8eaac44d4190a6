//! Where the picture is taken from: named views through a long lens, with upright lines upright.

use super::Vector;
use super::hierarchy::Ray;
use super::lamp::Stand;
use crate::garment::scene::View;

/// A camera.
#[derive(Clone, Copy, Debug)]
pub struct Camera {
    /// Where it stands, m.
    pub eye: Vector,
    /// How far it is from what it looks at, m.
    pub away: f32,
    /// The axes of the picture: right, up; and away from the figure towards the camera.
    pub axes: [Vector; 3],
    /// What it looks at: left, bottom, right, top, each over the distance along its axis.
    pub window: Window,
    /// The lights that belong to it.
    pub stand: Stand,
}

/// A rectangle of the film at distance 1: left, bottom, right, top.
pub type Window = [f32; 4];

/// Distance of the camera in half extents of what is shown: a standing person is taken from some
/// five metres, as with a 135 mm lens.
const AWAY: f32 = 5.6;

/// Height of the eye above the feet of a wearer, as a share of the figure's height.
const BREAST: f32 = 0.66;

/// Turn about the vertical of a view, rad. A turn of 0 looks the wearer in the face; it grows
/// towards the wearer's left.
fn turn(view: View) -> f32 {
    match view {
        View::Front | View::Top => 0.0,
        View::Side => std::f32::consts::FRAC_PI_2,
        View::Back => std::f32::consts::PI,
        View::ThreeQuarter => 0.70,
    }
}

/// How far the camera looks down. Elevations are level, as a drawing has them; a thing that lies
/// on others shows its upper side when it is turned.
fn rise(view: View, size: &Vector, worn: bool) -> f32 {
    match view {
        View::Top => std::f32::consts::FRAC_PI_2,
        View::ThreeQuarter if !worn => {
            let depth = size.x.min(size.z) / size.y.max(1e-6);
            0.06 + 0.34 * depth.min(1.0)
        }
        _ => 0.0,
    }
}

impl Camera {
    /// Cameras for views of things at `places`, all at one distance, each looking at just what
    /// there is to see. With `further` they have gone so far round, rad, and look at what is to
    /// be seen from all round.
    pub fn around(
        places: &[Vector],
        views: &[View],
        worn: bool,
        further: Option<f32>,
    ) -> Vec<Self> {
        let nothing = (Vector::repeat(f32::INFINITY), Vector::repeat(f32::NEG_INFINITY));
        let (low, high) =
            places.iter().fold(nothing, |(low, high), place| (low.inf(place), high.sup(place)));
        let (low, high) = if places.is_empty() {
            (Vector::repeat(-0.5), Vector::repeat(0.5))
        } else {
            (low, high)
        };
        let middle = (low + high) * 0.5;
        let extent = ((high - low).max() * 0.5).max(1e-3);
        let up = if worn { (BREAST - 0.5) * (high.y - low.y) } else { 0.0 };
        let make = |view: &View| {
            let turn = turn(*view) + further.unwrap_or(0.0);
            let rise = rise(*view, &(high - low), worn);
            let front = Vector::new(libm::sinf(turn), 0.0, libm::cosf(turn));
            let right = Vector::new(front.z, 0.0, -front.x);
            let back = front * libm::cosf(rise) + Vector::y() * libm::sinf(rise);
            let lift = if *view == View::Top { 0.0 } else { up };
            let mut camera = Camera {
                eye: middle + back * (AWAY * extent) + Vector::y() * lift,
                away: AWAY * extent,
                axes: [right, back.cross(&right), back],
                window: [-1.0, -1.0, 1.0, 1.0],
                stand: Stand { middle, extent, right, front },
            };
            camera.window = camera.seen(places);
            if further.is_some() {
                camera.window = camera.swept(places);
            }
            camera
        };
        views.iter().map(make).collect()
    }

    /// The same from so near that it shows a field of the given height, m, about the first thing
    /// that stands before it on the way from its eye to `aim`. `meets` tells how far along a ray
    /// that is. The lamps stay where they are.
    pub fn close_up(
        mut self,
        aim: &Vector,
        field: f32,
        meets: impl Fn(&Ray) -> Option<f32>,
    ) -> Self {
        let direction = (aim - self.eye).normalize();
        let ray = Ray { origin: self.eye, direction, reach: f32::INFINITY };
        let target = meets(&ray).map_or(*aim, |distance| self.eye + direction * distance);
        self.away = AWAY * 0.5 * field;
        self.eye = target + self.axes[2] * self.away;
        // The height of the field at distance 1 is 2 / AWAY.
        self.window = [-1.0, -1.0, 1.0, 1.0].map(|edge: f32| edge / AWAY);
        self
    }

    /// The window that just holds the places.
    fn seen(&self, places: &[Vector]) -> Window {
        let nothing = [f32::INFINITY, f32::INFINITY, f32::NEG_INFINITY, f32::NEG_INFINITY];
        let seen = places
            .iter()
            .filter_map(|place| self.film(place))
            .fold(nothing, |w, [x, y]| [w[0].min(x), w[1].min(y), w[2].max(x), w[3].max(y)]);
        if seen[0] <= seen[2] { seen } else { [-0.1, -0.1, 0.1, 0.1] }
    }

    /// The window that holds the places whichever way they are turned about the upright line
    /// through their middle.
    fn swept(&self, places: &[Vector]) -> Window {
        places.iter().fold(self.window, |window, place| {
            let off = place - self.stand.middle;
            let out = (off.x * off.x + off.z * off.z).sqrt();
            let mut window = window;
            for step in 0..16 {
                let (sine, cosine) = libm::sincosf(step as f32 * std::f32::consts::PI / 8.0);
                let turned = Vector::new(out * sine, off.y, out * cosine) + self.stand.middle;
                if let Some([x, y]) = self.film(&turned) {
                    window =
                        [window[0].min(x), window[1].min(y), window[2].max(x), window[3].max(y)];
                }
            }
            window
        })
    }

    /// Where a place comes to lie on the film at distance 1, if it is before the camera.
    pub fn film(&self, place: &Vector) -> Option<[f32; 2]> {
        let from = place - self.eye;
        let depth = -from.dot(&self.axes[2]);
        let near = 0.004 * self.away;
        (depth > near).then(|| [0, 1].map(|k| from.dot(&self.axes[k]) / depth))
    }

    /// The ray through a point of the picture: 0 to 1 from the left and from the top, less or
    /// more beside it.
    pub fn ray(&self, x: f32, y: f32) -> Ray {
        let [left, bottom, right, top] = self.window;
        let across = left + (right - left) * x;
        let rise = top + (bottom - top) * y;
        let direction = (self.axes[0] * across + self.axes[1] * rise - self.axes[2]).normalize();
        Ray { origin: self.eye, direction, reach: f32::INFINITY }
    }

    /// Where a place comes to lie in the picture, as given to [`Camera::ray`].
    pub fn picture(&self, place: &Vector) -> Option<[f32; 2]> {
        let [x, y] = self.film(place)?;
        let [left, bottom, right, top] = self.window;
        Some([(x - left) / (right - left), (top - y) / (top - bottom)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The corners of a box as large as a person.
    fn person() -> Vec<Vector> {
        let mut places = Vec::new();
        for x in [-0.4, 0.4] {
            for y in [0.0, 1.7] {
                for z in [-0.2, 0.25] {
                    places.push(Vector::new(x, y, z));
                }
            }
        }
        places
    }

    const ALL: [View; 5] = [View::Front, View::Side, View::Back, View::ThreeQuarter, View::Top];

    #[test]
    fn the_figure_just_fills_every_window() {
        for camera in Camera::around(&person(), &ALL, true, None) {
            let places: Vec<[f32; 2]> =
                person().iter().filter_map(|place| camera.picture(place)).collect();
            assert_eq!(places.len(), 8);
            for k in 0..2 {
                let low = places.iter().map(|p| p[k]).fold(f32::INFINITY, f32::min);
                let high = places.iter().map(|p| p[k]).fold(f32::NEG_INFINITY, f32::max);
                assert!(low.abs() < 1e-3 && (high - 1.0).abs() < 1e-3, "{low} {high}");
            }
        }
    }

    #[test]
    fn what_is_upright_and_flat_stays_square() {
        let corners =
            [[-0.2, 0.5], [0.2, 0.5], [-0.2, 1.1], [0.2, 1.1]].map(|[x, y]| Vector::new(x, y, 0.0));
        for worn in [false, true] {
            let camera = Camera::around(&corners, &[View::Front], worn, None)[0];
            let [a, b, c, d] = corners.map(|p| camera.film(&p).unwrap_or_default());
            assert!((a[0] - c[0]).abs() < 1e-6 && (b[0] - d[0]).abs() < 1e-6);
            assert!((a[1] - b[1]).abs() < 1e-6 && (c[1] - d[1]).abs() < 1e-6);
        }
    }

    #[test]
    fn feet_stand_on_one_line_in_upright_views() {
        let cameras = Camera::around(&person(), &ALL[..4], true, None);
        let foot = Vector::new(0.0, 0.0, 0.025);
        let lines: Vec<f32> =
            cameras.iter().map(|camera| camera.film(&foot).unwrap_or_default()[1]).collect();
        assert!(lines.iter().all(|y| (y - lines[0]).abs() < 1e-3), "{lines:?}");
    }

    #[test]
    fn the_wearers_left_is_to_the_right_in_front_and_to_the_left_behind() {
        let cameras = Camera::around(&person(), &ALL, true, None);
        let left = Vector::new(0.3, 1.2, 0.0);
        let across = |k: usize, place: &Vector| cameras[k].picture(place).unwrap_or_default()[0];
        assert!(across(0, &left) > 0.6);
        assert!(across(2, &left) < 0.4);
        // From the wearer's left the face looks to the left of the picture.
        assert!(across(1, &Vector::new(0.0, 1.2, 0.2)) < 0.5);
    }

    #[test]
    fn rays_go_where_the_picture_says() {
        let place = Vector::new(0.2, 0.7, 0.1);
        for camera in Camera::around(&person(), &ALL, true, None) {
            let [x, y] = camera.picture(&place).unwrap_or_default();
            let ray = camera.ray(x, y);
            let along = (place - ray.origin).normalize();
            assert!((along - ray.direction).norm() < 1e-4);
        }
    }
}
