use super::triangle::nearest;
use super::*;
use crate::body::solid;
use crate::diagnostic::Span;
use crate::garment::scene::{Shape, Solid};

fn make(shape: Shape, at: [f64; 3]) -> Surface {
    let turn = [0.3, -0.7, 0.2];
    solid(&Solid { name: "thing".into(), span: Span::default(), shape, at, turn, friction: None })
}

/// Points strewn through a box by a linear congruential sequence.
fn strewn(count: usize, half: f64) -> Vec<Point3<f64>> {
    let mut state = 1_u64;
    let mut next = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        ((state >> 11) as f64 / (1_u64 << 53) as f64 * 2.0 - 1.0) * half
    };
    (0..count).map(|_| Point3::new(next(), next(), next())).collect()
}

#[test]
fn agrees_with_asking_every_triangle() {
    let surface = make(Shape::Table { size: [0.5, 0.4, 0.3], thickness: 0.05 }, [0.1, 0.0, 0.0]);
    let field = Field::new(std::slice::from_ref(&surface));
    for p in strewn(200, 0.6) {
        let brute = surface
            .triangles
            .iter()
            .map(|t| (nearest(p, t.map(|i| surface.vertices[i as usize])).0 - p).norm())
            .fold(f64::INFINITY, f64::min);
        let probe = field.probe(p).unwrap();
        assert!((probe.distance.abs() - brute).abs() < 1e-14);
        let corners = surface.triangles[probe.triangle as usize];
        let rebuilt = (0..3).fold(Vector3::zeros(), |sum, k| {
            sum + surface.vertices[corners[k] as usize].coords * probe.weights[k]
        });
        assert!((rebuilt - probe.point.coords).norm() < 1e-12);
        assert!((probe.point - (p - probe.normal * probe.distance)).norm() < 1e-12);
    }
}

#[test]
fn a_ball_has_the_distance_of_a_ball() {
    let (radius, middle) = (0.25, Point3::new(0.0, 0.1, 0.0));
    let field = Field::new(&[make(Shape::Sphere { radius }, [0.0, 0.1, 0.0])]);
    for p in strewn(500, 0.5) {
        let exact = (p - middle).norm() - radius;
        let probe = field.probe(p).unwrap();
        // Facets of edge e ≤ 1.3 r / 2⁵ lie at most e² / 6r inside the ball.
        assert!((probe.distance - exact).abs() < 2.8e-4 * radius, "{p} {exact}");
        assert!(probe.normal.dot(&(p - middle)) > 0.0);
    }
}

#[test]
fn a_guess_and_a_reach_change_nothing() {
    let field = Field::new(&[
        make(Shape::Sphere { radius: 0.2 }, [0.0; 3]),
        make(Shape::Box { size: [0.3, 0.2, 0.1] }, [0.25, 0.0, 0.0]),
        make(Shape::Cylinder { radius: 0.1, height: 0.3 }, [-0.1, 0.1, 0.1]),
    ]);
    let mut guess = field.probe(Point3::origin()).unwrap();
    for p in strewn(500, 0.6) {
        let plain = field.probe(p).unwrap();
        assert_eq!(field.probe_from(p, &guess).unwrap().distance, plain.distance);
        let within = field.probe_within(p, 0.05);
        assert_eq!(within, (plain.distance <= 0.05).then_some(plain));
        guess = plain;
    }
}

#[test]
fn inside_the_union_is_inside() {
    let two = [
        make(Shape::Sphere { radius: 0.2 }, [0.0; 3]),
        make(Shape::Sphere { radius: 0.2 }, [0.3, 0.0, 0.0]),
    ];
    let field = Field::new(&two);
    // 0.05 m inside both balls.
    let probe = field.probe(Point3::new(0.15, 0.0, 0.0)).unwrap();
    assert!((probe.distance + 0.05).abs() < 1e-3);
    // Deep in the first, beyond the skin of the second.
    assert!(field.probe(Point3::new(-0.1, 0.0, 0.0)).unwrap().distance < -0.09);
    assert_eq!(field.probe(Point3::new(0.3, 0.1, 0.0)).unwrap().surface, 1);
}

#[test]
fn nothing_gives_nothing() {
    assert!(Field::new(&[]).is_empty());
    assert_eq!(Field::new(&[]).probe(Point3::origin()), None);
    assert_eq!(Field::new(&[Surface::default()]).probe(Point3::origin()), None);
    let ball = Field::new(&[make(Shape::Sphere { radius: 0.2 }, [0.0; 3])]);
    assert_eq!(ball.probe(Point3::new(f64::NAN, 0.0, 0.0)), None);
}
