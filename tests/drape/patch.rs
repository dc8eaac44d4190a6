//! A piece sewn on another, from text to rest.

use darzi::drape::draped::{Draped, Verdict};
use darzi::drape::{Options, drape};
use darzi::mesh::compiled::Compiled;
use darzi::mesh::{self, compile};
use darzi::progress::Quiet;
use darzi::world::{Memory, World};

/// A text compiled and draped.
pub fn draped(text: &str) -> (Compiled, Draped) {
    let mut world = Memory::new([("main.garment", text)]);
    let root = world.open("main.garment").expect("is there");
    let (garments, told) = darzi::evaluate::evaluate(&mut world, root, &Default::default());
    assert!(told.is_empty(), "{told:?}");
    let options = mesh::Options { atlas: false, ..Default::default() };
    let compiled = compile(&garments[0], &options).expect("compiles");
    let rungs = [compiled];
    let draped = drape(&rungs, &Options::default(), &mut Quiet).expect("drapes");
    let [compiled] = rungs;
    (compiled, draped)
}

/// Turned against the grid of its host, so that no two of their points agree.
const POCKET: &str = "garment hanging {
    fabric: cotton
    grid: 2cm
    panel cloth { rectangle 50cm x 60cm }
    panel pocket { grid: 15mm; rectangle 16cm x 18cm }
    patch pocket on cloth at (7cm, 20cm) turn 20deg open top
    place cloth at (0, 1m, 0)
    pin cloth.top
    drape { settle until speed < 5mm/s within 20s } }";

#[test]
fn a_pocket_is_held_to_the_cloth_below_its_edges() {
    let (compiled, draped) = draped(POCKET);
    darzi::mesh::validate::validate(&compiled).expect("is sound");
    let patch = &compiled.patches[0];
    let [a, b, c, d, e, f] = patch.map;
    for stitch in &patch.stitches {
        // The point of the face is where the map says.
        let [u, v] = compiled.particles[stitch.particle as usize];
        let wanted = [a * u + c * v + e, b * u + d * v + f];
        let mut found = [0.0; 2];
        for (corner, weight) in stitch.corners.iter().zip(stitch.weights) {
            assert!(weight > -1e-9);
            found[0] += weight * compiled.particles[*corner as usize][0];
            found[1] += weight * compiled.particles[*corner as usize][1];
        }
        assert!((found[0] - wanted[0]).hypot(found[1] - wanted[1]) < 1e-9);
    }
    let stats = &draped.stats;
    assert_eq!(stats.verdict, Verdict::Settled, "{:?}", stats.reason);
    assert_eq!(stats.self_intersections, 0);
    assert!(stats.largest_seam_gap < 1e-4, "{}", stats.largest_seam_gap);
    assert!(stats.largest_warp_strain.max(stats.largest_weft_strain) < 2e-3);
    // All of the pocket lies in front of the cloth, which hangs in one plane.
    let z = |panel: usize| {
        compiled.panels[panel].particles.range().map(|k| draped.positions[k].z).collect::<Vec<_>>()
    };
    let front = z(patch.host).into_iter().fold(f64::NEG_INFINITY, f64::max);
    let behind = z(patch.panel).into_iter().fold(f64::INFINITY, f64::min);
    assert!(behind - front > 0.5e-3, "{behind} {front}");
}
