//! Where the picture is taken from: named views, a long lens, the figure well inside the frame.

use super::Vector;
use super::hierarchy::Ray;
use super::lamp::Stand;
use crate::garment::scene::View;

/// A camera.
#[derive(Clone, Copy, Debug)]
pub struct Camera {
    /// Where it stands, m.
    pub eye: Vector,
    /// The axes of the picture: right, up; and away from the figure towards the camera.
    pub axes: [Vector; 3],
    /// Half the width and height of the picture at distance 1.
    pub half: [f32; 2],
    /// What the picture's middle is moved by, in halves.
    pub shift: [f32; 2],
    /// The lights that belong to it.
    pub stand: Stand,
}

/// The cameras of one sheet: all at one distance, on one ground line.
#[derive(Clone, Debug)]
pub struct Framing {
    /// One for each view.
    pub cameras: Vec<Camera>,
    /// Height of the picture at the middle of the figure, m.
    pub height: f32,
}

/// Half the longer side of the film over the focal length: 36 mm film, 85 mm lens.
const LENS: f32 = 18.0 / 85.0;

/// Share of the picture's half that the figure fills.
const FILL: [f32; 2] = [0.86, 0.89];

/// Turn about the vertical and rise above the horizon of a view, rad. A turn of 0 looks the
/// wearer in the face; it grows towards the wearer's left.
fn turn_and_rise(view: View, rise: f32) -> (f32, f32) {
    match view {
        View::Front => (0.0, rise),
        View::Side => (std::f32::consts::FRAC_PI_2, rise),
        View::Back => (std::f32::consts::PI, rise),
        View::ThreeQuarter => (0.70, rise + 0.06),
        View::Top => (0.0, std::f32::consts::FRAC_PI_2),
    }
}

/// How far the camera stands above the horizon: people are taken from breast height, things that
/// lie on others from above, what hangs flat straight on.
fn rise_for(size: &Vector, worn: bool) -> f32 {
    if worn {
        return 0.07;
    }
    let depth = size.x.min(size.z) / size.y.max(1e-6);
    0.34 * depth.min(1.0)
}

impl Framing {
    /// Cameras for the views of things at `places`, each picture `aspect` times as wide as high.
    pub fn around(places: &[Vector], views: &[View], worn: bool, aspect: f32) -> Self {
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
        let rise = rise_for(&(high - low), worn);
        let half = if aspect > 1.0 { [LENS, LENS / aspect] } else { [LENS * aspect, LENS] };
        let mut cameras: Vec<Camera> = views
            .iter()
            .map(|view| Camera::towards(turn_and_rise(*view, rise), middle, extent, half))
            .collect();
        // Far enough for every view; then each is moved so that the figure stands in the middle,
        // sideways each by itself, up and down all alike but the one from above.
        let upright =
            |view: &View| !matches!(view, View::Top) || views.iter().all(|v| *v == View::Top);
        let mut distance = extent;
        for _ in 0..4 {
            distance = extent * 0.1;
            for camera in &cameras {
                for place in places {
                    distance = distance.max(camera.distance_for(middle, place));
                }
            }
            let (mut bottom, mut top) = (f32::INFINITY, f32::NEG_INFINITY);
            for (camera, view) in cameras.iter_mut().zip(views) {
                let (mut left, mut right) = (f32::INFINITY, f32::NEG_INFINITY);
                let (mut down, mut up) = (f32::INFINITY, f32::NEG_INFINITY);
                for place in places {
                    let [x, y] = camera.film(middle, distance, place);
                    (left, right) = (left.min(x), right.max(x));
                    (down, up) = (down.min(y), up.max(y));
                }
                if left <= right {
                    camera.shift[0] = (left + right) * 0.5;
                }
                if upright(view) {
                    (bottom, top) = (bottom.min(down), top.max(up));
                } else if down <= up {
                    camera.shift[1] = (down + up) * 0.5;
                }
            }
            if bottom <= top {
                for (camera, view) in cameras.iter_mut().zip(views) {
                    if upright(view) {
                        camera.shift[1] = (bottom + top) * 0.5;
                    }
                }
            }
        }
        for camera in &mut cameras {
            camera.eye = middle + camera.axes[2] * distance;
        }
        Framing { cameras, height: 2.0 * half[1] * distance }
    }
}

impl Camera {
    fn towards((turn, rise): (f32, f32), middle: Vector, extent: f32, half: [f32; 2]) -> Self {
        let front = Vector::new(libm::sinf(turn), 0.0, libm::cosf(turn));
        let right = Vector::new(front.z, 0.0, -front.x);
        let back = front * libm::cosf(rise) + Vector::y() * libm::sinf(rise);
        let up = back.cross(&right);
        let stand = Stand { middle, extent, right, front };
        Camera { eye: middle, axes: [right, up, back], half, shift: [0.0; 2], stand }
    }

    /// Place on the film, in halves of the picture, of a camera at `distance` that is not moved.
    fn film(&self, middle: Vector, distance: f32, place: &Vector) -> [f32; 2] {
        let from = place - middle;
        let depth = (distance - from.dot(&self.axes[2])).max(1e-3);
        [0, 1].map(|k| from.dot(&self.axes[k]) / (depth * self.half[k]))
    }

    /// The distance at which the place lies just inside the filled part of the moved picture.
    fn distance_for(&self, middle: Vector, place: &Vector) -> f32 {
        let from = place - middle;
        let near = from.dot(&self.axes[2]);
        let mut distance = near + 1e-2;
        for k in 0..2 {
            let off = from.dot(&self.axes[k]) / self.half[k];
            // |off / (distance − near) − shift| ≤ fill
            let room = if off >= 0.0 { FILL[k] + self.shift[k] } else { FILL[k] - self.shift[k] };
            distance = distance.max(near + off.abs() / room.max(0.05));
        }
        distance
    }

    /// The ray through a point of the picture: 0 to 1 from the left and from the top.
    pub fn ray(&self, x: f32, y: f32) -> Ray {
        let across = (2.0 * x - 1.0 + self.shift[0]) * self.half[0];
        let rise = (1.0 - 2.0 * y + self.shift[1]) * self.half[1];
        let direction = (self.axes[0] * across + self.axes[1] * rise - self.axes[2]).normalize();
        Ray { origin: self.eye, direction, reach: f32::INFINITY }
    }

    /// Where a point of the world comes to lie in the picture, as given to [`Camera::ray`].
    #[cfg(test)]
    pub fn picture(&self, place: &Vector) -> [f32; 2] {
        let from = place - self.eye;
        let depth = -from.dot(&self.axes[2]);
        let film = [0, 1].map(|k| from.dot(&self.axes[k]) / (depth * self.half[k]) - self.shift[k]);
        [0.5 + 0.5 * film[0], 0.5 - 0.5 * film[1]]
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
    fn the_figure_stands_inside_every_picture_and_fills_one() {
        for aspect in [0.4, 0.75, 1.0, 1.8] {
            let framing = Framing::around(&person(), &ALL, true, aspect);
            let mut most: f32 = 0.0;
            for camera in &framing.cameras {
                for place in person() {
                    let [x, y] = camera.picture(&place);
                    assert!((0.04..0.96).contains(&x) && (0.04..0.96).contains(&y), "{x} {y}");
                    most = most.max((2.0 * x - 1.0).abs() / FILL[0]);
                    most = most.max((2.0 * y - 1.0).abs() / FILL[1]);
                }
            }
            assert!((most - 1.0).abs() < 0.03, "{most}");
        }
    }

    #[test]
    fn feet_stand_on_one_line_in_upright_views() {
        let framing = Framing::around(&person(), &ALL, true, 0.6);
        let foot = Vector::new(0.0, 0.0, 0.025);
        let lines: Vec<f32> =
            framing.cameras[..3].iter().map(|camera| camera.picture(&foot)[1]).collect();
        assert!(lines.iter().all(|y| (y - lines[0]).abs() < 1e-3), "{lines:?}");
    }

    #[test]
    fn the_wearers_left_is_to_the_right_in_front_and_to_the_left_behind() {
        let framing = Framing::around(&person(), &ALL, true, 0.6);
        let left = Vector::new(0.3, 1.2, 0.0);
        assert!(framing.cameras[0].picture(&left)[0] > 0.6);
        assert!(framing.cameras[2].picture(&left)[0] < 0.4);
        // From the wearer's left the face looks to the left of the picture.
        assert!(framing.cameras[1].picture(&Vector::new(0.0, 1.2, 0.2))[0] < 0.5);
    }

    #[test]
    fn rays_go_where_the_picture_says() {
        let framing = Framing::around(&person(), &ALL, true, 0.8);
        let place = Vector::new(0.2, 0.7, 0.1);
        for camera in &framing.cameras {
            let [x, y] = camera.picture(&place);
            let ray = camera.ray(x, y);
            let along = (place - ray.origin).normalize();
            assert!((along - ray.direction).norm() < 1e-4);
        }
    }
}
