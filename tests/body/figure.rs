//! Mannequins of many sizes: sound surfaces, girths as asked, places where a tailor looks for them.

use darzi::body::surface::{BodyPart, Landmark, Surface};
use darzi::body::{check, mannequin, tape};
use darzi::diagnostic::{FileId, Span};
use darzi::garment::scene::{BodyRequest, Figure};
use nalgebra::{Point3, Vector3};

/// Measures by name.
type Asked = &'static [(&'static str, f64)];

fn request(figure: Figure, measures: &[(&str, f64)]) -> BodyRequest {
    BodyRequest {
        name: "wearer".into(),
        span: Span::new(FileId(0), 10, 20),
        figure,
        measures: measures.iter().map(|(n, cm)| ((*n).to_owned(), cm / 100.0)).collect(),
    }
}

const EU_38: &[(&str, f64)] = &[
    ("bust", 88.0),
    ("underbust", 75.0),
    ("waist", 72.0),
    ("hip", 97.0),
    ("neck", 36.0),
    ("shoulder", 12.2),
    ("back_length", 41.0),
    ("bust_depth", 27.5),
    ("bust_gap", 19.0),
    ("upper_arm", 28.0),
    ("arm_length", 59.0),
    ("waist_to_hip", 20.0),
    ("waist_to_floor", 105.0),
];

const EU_50: &[(&str, f64)] = &[
    ("chest", 100.0),
    ("waist", 88.0),
    ("hip", 103.0),
    ("neck", 40.0),
    ("shoulder", 15.5),
    ("armhole_depth", 24.0),
    ("upper_arm", 31.0),
    ("arm_length", 65.0),
    ("wrist", 17.5),
    ("body_rise", 27.0),
    ("inseam", 82.0),
];

/// Rows of the library's tables: every measure given.
const WOMEN: &[&str] = &[
    "height",
    "bust",
    "underbust",
    "waist",
    "hip",
    "neck",
    "shoulder",
    "back_length",
    "armhole_depth",
    "bust_depth",
    "bust_gap",
    "upper_arm",
    "elbow",
    "wrist",
    "arm_length",
    "waist_to_hip",
    "waist_to_floor",
    "body_rise",
    "thigh",
    "knee",
    "calf",
    "ankle",
    "head",
];
const EU_34: [f64; 23] = [
    167.0, 80.0, 68.0, 64.0, 89.0, 34.4, 11.9, 40.2, 19.6, 26.1, 17.8, 25.6, 22.6, 15.0, 58.4,
    19.6, 104.4, 26.7, 51.4, 34.6, 33.4, 21.0, 55.0,
];
const EU_46: [f64; 23] = [
    170.0, 104.0, 89.0, 88.0, 113.0, 39.2, 12.8, 42.6, 21.4, 30.3, 21.4, 32.8, 27.9, 17.4, 60.2,
    20.8, 106.2, 29.1, 65.8, 42.5, 41.0, 24.7, 56.2,
];
const MEN: &[&str] = &[
    "height",
    "chest",
    "waist",
    "hip",
    "neck",
    "shoulder",
    "back_length",
    "armhole_depth",
    "upper_arm",
    "elbow",
    "wrist",
    "arm_length",
    "waist_to_hip",
    "waist_to_floor",
    "body_rise",
    "inseam",
    "thigh",
    "knee",
    "calf",
    "ankle",
    "head",
];
const EU_44: [f64; 21] = [
    174.0, 88.0, 76.0, 91.0, 37.0, 14.6, 43.5, 22.5, 27.7, 24.5, 16.3, 62.6, 20.0, 105.3, 26.1,
    79.2, 51.0, 34.3, 33.4, 20.6, 56.6,
];
const EU_56: [f64; 21] = [
    183.0, 112.0, 102.0, 115.0, 43.0, 16.4, 46.2, 25.5, 34.3, 30.1, 18.7, 66.5, 21.3, 110.8, 28.2,
    82.6, 64.4, 43.1, 42.0, 25.8, 58.1,
];

/// The sizes that the tests go through: standard rows, children, tall and large people.
fn people() -> Vec<(&'static str, BodyRequest)> {
    let female = |m: &[(&str, f64)]| request(Figure::Female, m);
    let male = |m: &[(&str, f64)]| request(Figure::Male, m);
    let row = |figure, names: &[&'static str], values: &[f64]| {
        let measures: Vec<_> = names.iter().copied().zip(values.iter().copied()).collect();
        request(figure, &measures)
    };
    vec![
        ("EU 38", female(EU_38)),
        ("EU 50", male(EU_50)),
        ("EU 34", row(Figure::Female, WOMEN, &EU_34)),
        ("EU 46", row(Figure::Female, WOMEN, &EU_46)),
        ("EU 44", row(Figure::Male, MEN, &EU_44)),
        ("EU 56", row(Figure::Male, MEN, &EU_56)),
        (
            "large",
            female(&[("bust", 128.0), ("underbust", 108.0), ("waist", 114.0), ("hip", 134.0)]),
        ),
        ("child", female(&[("height", 116.0), ("bust", 60.0), ("waist", 54.0), ("hip", 64.0)])),
        ("tall", female(&[("height", 188.0), ("bust", 90.0), ("waist", 72.0), ("hip", 100.0)])),
        ("boy", male(&[("height", 128.0), ("chest", 64.0), ("waist", 58.0), ("hip", 68.0)])),
        ("stout", male(&[("height", 176.0), ("chest", 124.0), ("waist", 122.0), ("hip", 122.0)])),
        ("slim", male(&[("height", 190.0), ("chest", 92.0), ("waist", 76.0), ("hip", 94.0)])),
    ]
}

/// Length of a tight tape round a ring, m.
fn girth(surface: &Surface, name: &str) -> f64 {
    let Some(Landmark::Ring { axis, points, centre }) = surface.landmarks.get(name) else {
        panic!("no ring {name}");
    };
    let u = if axis.y.abs() > 0.5 { Vector3::x() } else { Vector3::z() };
    let u = (u - axis * axis.dot(&u)).normalize();
    let v = axis.cross(&u);
    let flat: Vec<[f64; 2]> =
        points.iter().map(|p| [(p - centre).dot(&u), (p - centre).dot(&v)]).collect();
    tape::girth(&flat)
}

fn point(surface: &Surface, name: &str) -> Point3<f64> {
    match surface.landmarks.get(name) {
        Some(Landmark::Point(p)) => *p,
        other => panic!("{name} is {other:?}"),
    }
}

#[test]
fn every_size_is_sound_and_has_the_asked_girths() {
    for (size, request) in people() {
        let body = mannequin(&request).unwrap_or_else(|wrong| panic!("{size}: {wrong:#?}"));
        assert_eq!(check::defects(&body), Vec::<String>::new(), "{size}");
        assert_eq!(check::euler(&body), 2, "{size}");
        let crossed: Vec<Point3<f64>> = check::crossings(&body)
            .iter()
            .map(|[t, _]| body.vertices[body.triangles[*t][0] as usize])
            .collect();
        assert!(crossed.is_empty(), "{size} crosses itself at {crossed:.3?}");
        assert!((15_000..80_000).contains(&body.triangles.len()), "{size}");
        assert_eq!(body.parts.len(), body.vertices.len());
        let mut off = Vec::new();
        for name in [
            "bust",
            "chest",
            "underbust",
            "waist",
            "hip",
            "neck",
            "head",
            "upper_arm",
            "elbow",
            "wrist",
            "thigh",
            "knee",
            "calf",
            "ankle",
        ] {
            let Some(asked) = request.measures.get(name) else { continue };
            let rings = match name {
                "upper_arm" | "elbow" | "wrist" | "thigh" | "knee" | "calf" | "ankle" => {
                    vec![format!("{name}.left"), format!("{name}.right")]
                }
                _ => vec![name.to_owned()],
            };
            for ring in rings {
                let found = girth(&body, &ring);
                if (found - asked).abs() > 0.003 {
                    off.push((ring, *asked, found));
                }
            }
        }
        assert!(off.is_empty(), "{size}: {off:?}");
    }
}

#[test]
fn places_lie_where_a_tailor_looks_for_them() {
    for figure in [Figure::Female, Figure::Male] {
        let body = mannequin(&request(figure, &[])).unwrap();
        let at = |name: &str| point(&body, name);
        assert!(at("navel").z > 0.05 && at("back_waist").z < -0.05);
        assert!(at("neck_front").y < at("neck_back").y && at("neck_front").z > at("neck_back").z);
        assert!(at("shoulder.left").x > at("neck_side.left").x);
        assert!(at("shoulder.left").y < at("neck_side.left").y);
        assert!(at("underarm.left").y < at("shoulder.left").y - 0.08);
        assert!(at("crotch").y < at("hip.left").y && at("head_top").y > at("neck_back").y + 0.2);
        // Left is +x, and the right side is its mirror image.
        for name in ["shoulder", "hip", "bust_point", "neck_side"] {
            let (l, r) = (at(&format!("{name}.left")), at(&format!("{name}.right")));
            assert!(l.x > 0.0 && (l.x + r.x).abs() < 1e-3 && (l.y - r.y).abs() < 1e-3, "{name}");
        }
        // Every point lies on the skin.
        let field = darzi::body::distance::Field::new(std::slice::from_ref(&body));
        for (name, landmark) in &body.landmarks {
            match landmark {
                Landmark::Point(p) => {
                    let off = field.probe(*p).unwrap().distance;
                    // Facets of 1 cm on the sharpest places (neck, armpit) lie a little inside.
                    assert!(off.abs() < 4e-3, "{name} is {off} m off the skin");
                }
                Landmark::Ring { points, axis, centre } => {
                    assert!(points.len() > 12, "{name}");
                    let area: Vector3<f64> = (0..points.len())
                        .map(|k| {
                            let next = points[(k + 1) % points.len()];
                            (points[k] - centre).cross(&(next - centre)) / 2.0
                        })
                        .sum();
                    let arm = ["arm", "elbow", "wrist"].iter().any(|n| name.contains(n));
                    assert_eq!(area.dot(axis) > 0.0, !arm, "{name} runs the wrong way");
                }
                Landmark::Limb { points, radii } => {
                    assert_eq!(points.len(), radii.len());
                    assert!(radii.iter().all(|r| (0.02..0.15).contains(r)), "{name} {radii:?}");
                    assert!(points[0].y > points[points.len() - 1].y, "{name}");
                }
            }
        }
        for ring in ["thigh", "knee", "calf", "ankle", "upper_arm", "elbow", "wrist", "armhole"] {
            let (l, r) = (format!("{ring}.left"), format!("{ring}.right"));
            assert!((girth(&body, &l) - girth(&body, &r)).abs() < 2e-3, "{ring}");
        }
        for part in [BodyPart::Trunk, BodyPart::Neck, BodyPart::Head, BodyPart::LeftLeg] {
            assert!(body.parts.contains(&part), "{part:?}");
        }
        for (p, part) in body.vertices.iter().zip(&body.parts) {
            match part {
                BodyPart::LeftArm | BodyPart::LeftLeg => assert!(p.x > -1e-9),
                BodyPart::RightArm | BodyPart::RightLeg => assert!(p.x < 1e-9),
                BodyPart::Head => assert!(p.y > 1.3),
                BodyPart::Trunk | BodyPart::Neck => {}
            }
        }
    }
}

/// Below her waist a woman widens soon: half way down to the hip her girth has gained 60 to 85 % of the
/// difference, which is why skirts take darts (the high hip of size tables such as ASTM D5585).
#[test]
fn a_woman_widens_soon_below_her_waist() {
    for size in ["EU 34", "EU 38", "EU 46"] {
        let (_, asked) = people().into_iter().find(|(name, _)| *name == size).unwrap();
        let lady = mannequin(&asked).unwrap();
        let level = |name: &str| match lady.landmarks.get(name) {
            Some(Landmark::Ring { centre, .. }) => centre.y,
            other => panic!("{name} is {other:?}"),
        };
        let middle = 0.5 * (level("waist") + level("hip"));
        let band: Vec<[f64; 2]> = lady
            .vertices
            .iter()
            .filter(|p| (p.y - middle).abs() < 0.004 && p.x.abs() < 0.3)
            .map(|p| [p.x, p.z])
            .collect();
        let [waist, hip] = ["waist", "hip"].map(|name| girth(&lady, name));
        let gained = (tape::girth(&band) - waist) / (hip - waist);
        assert!((0.6..0.85).contains(&gained), "{size}: {gained}");
    }
}

#[test]
fn heights_are_as_asked() {
    let body = mannequin(&request(Figure::Female, EU_38)).unwrap();
    let low = body.vertices.iter().map(|p| p.y).fold(f64::INFINITY, f64::min);
    assert!(low.abs() < 2e-3, "stands at {low}");
    let Some(Landmark::Ring { centre, .. }) = body.landmarks.get("waist") else { panic!() };
    assert!((centre.y - 1.05).abs() < 1e-3);
    let Some(Landmark::Ring { centre, .. }) = body.landmarks.get("hip") else { panic!() };
    assert!((centre.y - 0.85).abs() < 1e-3);
    let (neck, tip) = (point(&body, "neck_side.left"), point(&body, "shoulder.left"));
    assert!(((tip - neck).norm() - 0.122).abs() < 0.012, "{}", (tip - neck).norm());
    let tall = mannequin(&request(Figure::Male, &[("height", 185.0)])).unwrap();
    assert!((point(&tall, "head_top").y - 1.85).abs() < 3e-3);
}

#[test]
fn the_same_body_comes_out_on_any_number_of_threads() {
    let make = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| mannequin(&request(Figure::Female, EU_38)).unwrap())
    };
    assert_eq!(make(1), make(3));
}

#[test]
fn impossible_measures_are_told_with_a_way_out() {
    let cases: &[(Figure, Asked, &str, &str)] = &[
        (Figure::Female, &[("waist", -10.0)], "E0308", "waist"),
        (Figure::Female, &[("waist", f64::NAN)], "E0308", "waist"),
        (Figure::Female, &[("height", 3000.0)], "E0308", "height"),
        (Figure::Male, &[("height", 40.0)], "E0308", "tall"),
        (Figure::Female, &[("hip", 85.0), ("waist", 180.0)], "E0309", "waist"),
        (Figure::Female, &[("bust", 90.0), ("underbust", 95.0)], "E0309", "bust"),
        (Figure::Female, &[("height", 150.0), ("waist_to_floor", 105.0)], "E0309", "add up"),
        (Figure::Female, &[("height", 168.0), ("bust_depth", 42.0)], "E0309", "bust_depth"),
        (Figure::Male, &[("thigh", 90.0), ("hip", 100.0)], "E0309", "thigh"),
    ];
    for (figure, measures, code, word) in cases {
        let wrong = mannequin(&request(*figure, measures)).unwrap_err();
        let told = wrong.iter().find(|d| d.code == *code);
        let told = told.unwrap_or_else(|| panic!("{measures:?} gave {wrong:#?}"));
        let text = format!("{} {}", told.message, told.help.clone().unwrap_or_default());
        assert!(text.contains(word), "{text}");
        assert_eq!(told.labels[0].span, Span::new(FileId(0), 10, 20));
        assert!(told.help.is_some());
    }
}

/// Whatever is asked, the answer is a sound surface or a diagnostic.
#[test]
fn single_measures_pulled_out_of_shape_never_break_the_mesh() {
    let mut made = 0;
    for (figure, base) in [(Figure::Female, EU_38), (Figure::Male, EU_50)] {
        for (k, (name, value)) in base.iter().enumerate().filter(|(k, _)| k % 3 != 1) {
            let factor = if k % 2 == 0 { 1.22 } else { 0.8 };
            let mut request = request(figure, base);
            request.measures.insert((*name).to_owned(), value / 100.0 * factor);
            if let Ok(body) = mannequin(&request) {
                made += 1;
                assert_eq!(check::defects(&body), Vec::<String>::new(), "{name} {factor}");
                assert_eq!(check::euler(&body), 2, "{name} {factor}");
            }
        }
    }
    assert!(made > 5, "only {made} could be made");
}
