//! Hems weigh what their cloth weighs.

use crate::patch::draped;
use darzi::drape::cloth::Cloth;
use darzi::drape::weld::Weld;

const TEXT: &str = "garment hanging {
    fabric: cotton
    grid: 1cm
    panel cloth { rectangle 40cm x 50cm
        HEM }
    place cloth at (0, 1m, 0)
    pin cloth.top
    drape { settle until speed < 5mm/s within 20s } }";

#[test]
fn a_hem_adds_the_mass_of_its_plies() {
    let weight = |hem: &str| {
        let (compiled, _) = draped(&TEXT.replace("HEM", hem));
        let weld = Weld::new(compiled.particles.len(), std::iter::empty());
        let mass: f64 = Cloth::new(&compiled, weld).mass.iter().sum();
        mass / compiled.fabrics[0].mass
    };
    let plain = weight("");
    assert!((plain - 0.2).abs() < 1e-6, "{plain}");
    // 40 cm of 5 cm, turned once and twice; its border is found to a quarter of a cell.
    for (hem, plies) in [("hem on bottom depth 5cm", 1.0), ("hem on bottom depth 5cm double", 2.0)]
    {
        let more = weight(hem) - plain;
        assert!((more - plies * 0.02).abs() < plies * 0.4 * 0.0025, "{more}");
    }
}
