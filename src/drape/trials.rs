//! Trials of the solver against what is known in closed form.

use super::skin::Skin;
use super::step::{Manner, Workshop};
use super::swatch::{Ball, Nothing, Slope, fabric, irregular, rectangles};
use super::system::Aim;
use super::weld::Weld;
use crate::garment::seam::PinTarget;
use crate::mesh::compiled::{Compiled, MeshPin};
use nalgebra::Vector3;

fn shop<'a>(compiled: &'a Compiled, skin: &'a dyn Skin, x: &[Vector3<f64>]) -> Workshop<'a> {
    let weld = Weld::new(compiled.particles.len(), std::iter::empty());
    Workshop::new(compiled, &[], skin, weld, x)
}

fn flat(compiled: &Compiled, place: impl Fn(f64, f64) -> [f64; 3]) -> Vec<Vector3<f64>> {
    compiled.particles.iter().map(|p| Vector3::from(place(p[0], p[1]))).collect()
}

fn rest(shop: &mut Workshop<'_>, dt: f64, calm: f64, speed: f64, most: usize) -> usize {
    let mut still = 0;
    for step in 0..most {
        let manner = Manner {
            dt,
            calm,
            air: 0.0,
            aim: Aim { tolerance: 1e-4, most: 2000 },
            ..Manner::default()
        };
        let taken = shop.step(&manner).expect("finite");
        if step % 300 == 299 {
            println!("{step} {:?}", taken);
        }
        // A swing is slow where it turns round, but not for long.
        still = if taken.speed < speed { still + 1 } else { 0 };
        if still == 10 {
            return step;
        }
    }
    panic!("not at rest");
}

/// Exact ½ g t² = 4.905 m; implicit Euler is ahead of it by the share dt / t.
#[test]
fn a_free_sheet_falls_as_galileo_says() {
    let compiled = rectangles(1, [8, 8], 0.02, fabric(1e-5));
    let mut shop = shop(&compiled, &Nothing, &flat(&compiled, |u, v| [u, 10.0, v]));
    let manner = Manner { air: 0.0, gravity: 9.81, ..Manner::default() };
    for _ in 0..120 {
        shop.step(&manner).unwrap();
    }
    for x in &shop.x {
        assert!((10.0 - x.y - 4.905 * (1.0 + 1.0 / 120.0)).abs() < 1e-4, "{}", 10.0 - x.y);
    }
}

/// Elongation of a strip hung by its end: w g L² / 2k, lumped masses give it with error h / L
/// times a bound of one; pins hold the top row.
#[test]
fn a_hanging_strip_stretches_by_its_weight() {
    let (n, m, h) = (4, 50, 0.02);
    let mut cloth = fabric(1e-5);
    cloth.tensile = [100.0; 2];
    let mut compiled = rectangles(1, [n, m], h, cloth);
    let top: Vec<u32> = (0..=n).map(|i| (m * (n + 1) + i) as u32).collect();
    compiled.pins.push(MeshPin { points: top, to: PinTarget::Here });
    let mut shop = shop(&compiled, &Nothing, &flat(&compiled, |u, v| [u, v, 0.0]));
    rest(&mut shop, 0.05, 2.0, 2e-4, 2000);
    let length = m as f64 * h;
    let expected = 0.15 * 9.80665 * length * length / (2.0 * 100.0);
    for i in 0..=n {
        let fall = -shop.x[i].y;
        assert!((fall / expected - 1.0).abs() < 0.02, "{fall} {expected}");
    }
}

/// The heavy cantilever: H / W of the tip, w g L³ / B = Γ. A mesh is clamped in the middle of the
/// last cell that is held by both ends: the turn at the last held knot stands for the curvature
/// of half a cell on either side of it.
fn cantilever(gamma: f64, cells: usize, triangles: bool) -> f64 {
    let length = 0.2;
    let h = length / (cells as f64 + 0.5);
    let bending = 0.15 * 9.80665 * length.powi(3) / gamma;
    let mut cloth = fabric(bending);
    cloth.poisson = 0.0;
    cloth.tensile = [5000.0; 2];
    let wide = 4;
    let clamp = 2;
    let counts = [cells + clamp, wide];
    let mut compiled = rectangles(1, counts, h, cloth);
    if triangles {
        compiled = irregular(compiled, counts, h);
    }
    let columns = counts[0] + 1;
    let held: Vec<u32> =
        (0..compiled.particles.len() as u32).filter(|p| (*p as usize % columns) <= clamp).collect();
    compiled.pins.push(MeshPin { points: held, to: PinTarget::Here });
    let mut shop = shop(&compiled, &Nothing, &flat(&compiled, |u, v| [u, 0.0, v]));
    let steps = rest(&mut shop, 0.05, 2.0, 2e-4, 3000);
    let tip = shop.x[(wide / 2) * columns + columns - 1];
    println!("steps {steps}");
    -tip.y / (tip.x - (clamp as f64 - 0.5) * h)
}

/// The droop against the exact one of the elastica; the error falls with the square of the cell.
#[test]
fn a_cantilever_bends_as_the_elastica() {
    for (gamma, exact) in [(10.0, 1.06680), (50.0, 3.70556)] {
        let [coarse, fine] = [20, 40].map(|cells| cantilever(gamma, cells, false) / exact - 1.0);
        println!("{gamma} {coarse} {fine}");
        assert!(coarse.abs() < 0.01 && fine.abs() < 0.003, "{gamma} {coarse} {fine}");
    }
}

/// Hinges over triangles of irregular shape are not so exact: what they resist depends on how the
/// triangles lie. A band is a cell wide, so that a cloth which is all band is the worst there is.
#[test]
fn a_cantilever_of_band_triangles_bends_nearly_so() {
    let error = cantilever(10.0, 20, true) / 1.06680 - 1.0;
    println!("{error}");
    assert!(error.abs() < 0.1, "{error}");
}

/// Cloth stays on a slope of 15° (tan 0.268 < μ = 0.3) and slides on one of 25° with the
/// acceleration g (sin − μ cos).
#[test]
fn friction_holds_and_lets_go_on_a_slope() {
    for (degrees, slides) in [(15.0f64, false), (25.0, true)] {
        let angle = degrees.to_radians();
        let (s, c) = angle.sin_cos();
        let slope = Slope { normal: Vector3::new(s, c, 0.0) };
        let compiled = rectangles(1, [10, 10], 0.02, fabric(1e-5));
        let seat = 0.5 * 0.4e-3 + super::skin::MARGIN;
        let start = flat(&compiled, |u, v| [u * c + seat * s, -u * s + seat * c, v]);
        let mut shop = shop(&compiled, &slope, &start);
        let manner = Manner { air: 0.0, ..Manner::default() };
        for _ in 0..120 {
            shop.step(&manner).unwrap();
        }
        let way: f64 = shop
            .x
            .iter()
            .zip(&start)
            .map(|(x, s0)| (x - s0).dot(&Vector3::new(c, -s, 0.0)))
            .sum::<f64>()
            / start.len() as f64;
        let free = 0.5 * 9.80665 * (s - 0.3 * c);
        println!("{degrees} {way} {free}");
        if slides {
            assert!((way / free - 1.0).abs() < 0.1, "{way} {free}");
        } else {
            assert!(way < 3e-3, "{way}");
        }
    }
}

/// The scene of the handkerchief: 1 m square over a ball of radius 0.25 m.
fn handkerchief(cells: usize, seconds: f64) -> (Vec<Vector3<f64>>, Compiled) {
    let compiled = rectangles(1, [cells, cells], 1.0 / cells as f64, fabric(1e-5));
    let ball = Ball { centre: Vector3::zeros(), radius: 0.25 };
    let start = flat(&compiled, |u, v| [u - 0.5, 0.26, 0.5 - v]);
    let mut shop = shop(&compiled, &ball, &start);
    let manner = Manner { air: 0.0, ..Manner::default() };
    let clock = std::time::Instant::now();
    let (mut time, mut steps, mut its) = (0.0, 0, 0);
    while time < seconds {
        let taken = shop.step(&manner).unwrap();
        time += taken.time;
        steps += 1;
        its += taken.iterations;
        if steps % 40 == 0 {
            println!(
                "t {time:.3} speed {:.3} touches {} cut {} low {:.3}",
                taken.speed,
                taken.touches,
                taken.cut,
                shop.x.iter().map(|x| x.y).fold(9.0, f64::min)
            );
        }
    }
    let stats = super::stats::measure(&compiled, &shop.positions(), &ball);
    println!(
        "{cells}: steps {steps} its {} ms/step {:.2} strain {:.4} {:.4} pen {:.5}",
        its / steps,
        clock.elapsed().as_secs_f64() * 1e3 / steps as f64,
        stats.largest_warp_strain,
        stats.largest_weft_strain,
        stats.deepest_penetration
    );
    let lowest = shop.x.iter().map(|x| x.y).fold(f64::INFINITY, f64::min);
    assert!((-0.34..=-0.26).contains(&lowest), "{lowest}");
    assert_eq!(stats.self_intersections, 0);
    assert!(stats.largest_warp_strain.max(stats.largest_weft_strain) < 0.03);
    assert!(stats.deepest_penetration < 1e-4);
    (shop.positions(), compiled)
}

#[test]
fn a_handkerchief_hangs_over_a_ball() {
    for cells in [32, 64] {
        handkerchief(cells, 2.0);
    }
}
