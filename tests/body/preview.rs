//! Pictures of the mannequins without the renderer, for looking at their shape. They are written
//! into the target's `tmp` folder; the test holds that a figure stands free and is symmetric.

use darzi::body::mannequin;
use darzi::body::surface::Surface;
use darzi::diagnostic::Span;
use darzi::garment::scene::{BodyRequest, Figure};
use image::{Rgb, RgbImage};
use nalgebra::{Point3, Vector3};

const WIDTH: u32 = 520;
const HEIGHT: u32 = 760;

/// Measures by name.
type Asked = &'static [(&'static str, f64)];

fn request(figure: Figure, measures: &[(&str, f64)]) -> BodyRequest {
    BodyRequest {
        name: "lady".into(),
        span: Span::default(),
        figure,
        measures: measures.iter().map(|(n, v)| ((*n).to_owned(), *v)).collect(),
    }
}

/// Parallel projection, seen from `turn` rad to the wearer's left of the front; `None` where
/// nothing is.
fn picture(surface: &Surface, turn: f64, middle: [f64; 2], scale: f64) -> Vec<Option<f64>> {
    let (sin, cos) = (libm::sin(turn), libm::cos(turn));
    let look = |v: Vector3<f64>| Vector3::new(v.x * cos - v.z * sin, v.y, v.x * sin + v.z * cos);
    let screen = |p: Point3<f64>| {
        let q = look(p.coords);
        [
            f64::from(WIDTH) / 2.0 + (q.x - middle[0]) * scale,
            f64::from(HEIGHT) / 2.0 - (q.y - middle[1]) * scale,
            q.z,
        ]
    };
    let light = Vector3::new(-0.45, 0.6, 0.66).normalize();
    let mut depth = vec![f64::NEG_INFINITY; (WIDTH * HEIGHT) as usize];
    let mut shade = vec![None; (WIDTH * HEIGHT) as usize];
    for t in &surface.triangles {
        let [a, b, c] = t.map(|i| screen(surface.vertices[i as usize]));
        let n = t.map(|i| look(surface.normals[i as usize]));
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        if area.abs() < 1e-9 {
            continue;
        }
        let low = |k: usize| a[k].min(b[k]).min(c[k]).floor().max(0.0) as u32;
        let high = |k: usize, end: u32| (a[k].max(b[k]).max(c[k]).ceil().max(0.0) as u32).min(end);
        for y in low(1)..high(1, HEIGHT) {
            for x in low(0)..high(0, WIDTH) {
                let (px, py) = (f64::from(x) + 0.5, f64::from(y) + 0.5);
                let side = |p: [f64; 3], q: [f64; 3]| {
                    ((q[0] - p[0]) * (py - p[1]) - (q[1] - p[1]) * (px - p[0])) / area
                };
                let w = [side(b, c), side(c, a), side(a, b)];
                if w.iter().any(|w| *w < -1e-9) {
                    continue;
                }
                let z = a[2] * w[0] + b[2] * w[1] + c[2] * w[2];
                let slot = (y * WIDTH + x) as usize;
                if z > depth[slot] {
                    depth[slot] = z;
                    let normal = (n[0] * w[0] + n[1] * w[1] + n[2] * w[2]).normalize();
                    let half = (light + Vector3::z()).normalize();
                    shade[slot] = Some(
                        0.16 + 0.62 * normal.dot(&light).max(0.0)
                            + 0.12 * (0.5 + 0.5 * normal.y)
                            + 0.18 * normal.dot(&half).max(0.0).powi(24)
                            + 0.15 * (1.0 - normal.z.abs()).powi(3),
                    );
                }
            }
        }
    }
    shade
}

fn sheet(surface: &Surface, name: &str, middle: f64, span: f64) -> Vec<Vec<Option<f64>>> {
    let scale = f64::from(HEIGHT) / span;
    let turns = [0.0, 0.7, std::f64::consts::FRAC_PI_2, std::f64::consts::PI, 3.9];
    let views: Vec<_> = turns.iter().map(|t| picture(surface, *t, [0.0, middle], scale)).collect();
    let mut image = RgbImage::from_pixel(WIDTH * 5, HEIGHT, Rgb([236, 234, 230]));
    for (k, view) in views.iter().enumerate() {
        for (i, shade) in view.iter().enumerate() {
            if let Some(s) = shade {
                let (x, y) = (i as u32 % WIDTH, i as u32 / WIDTH);
                let tone = |c: f64| (255.0 * libm::pow((c * s).clamp(0.0, 1.0), 1.0 / 1.6)) as u8;
                image.put_pixel(k as u32 * WIDTH + x, y, Rgb([tone(0.98), tone(0.9), tone(0.82)]));
            }
        }
    }
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR"));
    image.save(folder.join(format!("{name}.png"))).unwrap();
    views
}

#[test]
fn other_sizes_keep_their_shape() {
    let people: [(&str, Figure, Asked); 4] = [
        (
            "large",
            Figure::Female,
            &[("bust", 1.28), ("underbust", 1.08), ("waist", 1.14), ("hip", 1.34)],
        ),
        (
            "child",
            Figure::Female,
            &[("height", 1.16), ("bust", 0.6), ("waist", 0.54), ("hip", 0.64)],
        ),
        (
            "stout",
            Figure::Male,
            &[("height", 1.76), ("chest", 1.24), ("waist", 1.22), ("hip", 1.22)],
        ),
        ("slim", Figure::Male, &[("height", 1.9), ("chest", 0.92), ("waist", 0.76), ("hip", 0.94)]),
    ];
    for (name, figure, measures) in people {
        let body = mannequin(&request(figure, measures)).unwrap();
        let views = sheet(&body, name, 0.95, 2.05);
        // The trunk is one filled stretch at the waist, whatever the size.
        let row = HEIGHT / 2;
        let front = &views[0][(row * WIDTH) as usize..((row + 1) * WIDTH) as usize];
        assert!(front[WIDTH as usize / 2].is_some(), "{name}");
    }
}

#[test]
fn figures_stand_free_and_are_symmetric() {
    for (figure, name) in [(Figure::Female, "female"), (Figure::Male, "male")] {
        let clock = std::time::Instant::now();
        let body = mannequin(&request(figure, &[])).unwrap();
        eprintln!("{name}: {} triangles, {:?}", body.triangles.len(), clock.elapsed());
        let views = sheet(&body, name, 0.88, 1.9);
        sheet(&body, &format!("{name}_trunk"), 1.2, 0.95);
        sheet(&body, &format!("{name}_legs"), 0.45, 1.0);
        let front = &views[0];
        let filled = |x: u32, y: u32| front[(y * WIDTH + x) as usize].is_some();
        assert!((0..WIDTH).all(|x| !filled(x, 0) && !filled(x, HEIGHT - 1)));
        let uneven = (0..WIDTH * HEIGHT)
            .filter(|i| filled(i % WIDTH, i / WIDTH) != filled(WIDTH - 1 - i % WIDTH, i / WIDTH))
            .count();
        let all = front.iter().filter(|s| s.is_some()).count();
        assert!(uneven * 200 < all, "{uneven} of {all}");
    }
}
