//! Pieces sewn flat on others: where they lie, and what can be wrong with them.

use crate::garments::{sound, told};
use darzi::garment::seam::Patch;

/// Two fronts, an unfolded back and a pocket, with a patch line.
fn text(pocket: &str, patch: &str) -> String {
    format!(
        "garment g {{ wearer l = female {{ size: EU 38 }}
         panel front of cotton {{
             outline from (0, 0) {{
                 top: line to (30cm, 0); side: line to (30cm, -60cm)
                 hem: line to (0, -60cm); edge: line to start }}
             pair as left, right }}
         panel back of cotton {{
             outline from (0, 0) {{
                 top: line to (30cm, 0); side: line to (30cm, -60cm)
                 hem: line to (0, -60cm); fold: line to start }}
             unfold across fold as left, right }}
         panel pocket of cotton {{ rectangle 10cm x 12cm; {pocket} }}
         place front before l.waist; place back behind l.waist
         {patch} }}"
    )
}

/// Where a place of the patch comes to lie on its host, mm.
fn lies(patch: &Patch, [x, y]: [f64; 2]) -> [i64; 2] {
    let [a, b, c, d, e, f] = patch.map;
    [a * x + c * y + e, b * x + d * y + f].map(|v| (v * 1e3).round() as i64)
}

#[test]
fn a_patch_lies_where_it_is_said_and_is_sewn_along_its_closed_edges() {
    let text = text("", "patch pocket on front.left at (15cm, -40cm) turn 90deg open top");
    let garment = sound(&text, &[]).remove(0);
    let patch = &garment.patches[0];
    let name = |panel: usize| garment.panels[panel].name.as_str();
    assert_eq!((name(patch.panel), name(patch.host)), ("pocket", "front.left"));
    // A quarter turn: what is above in the pocket lies to the left.
    assert_eq!(lies(patch, [0.0, 0.0]), [150, -400]);
    assert_eq!(lies(patch, [0.0, 0.12]), [30, -400]);
    assert_eq!(lies(patch, [0.05, 0.0]), [150, -350]);
    let sewn: f64 = patch.runs.iter().map(|on| on.run.length()).sum();
    assert!((sewn - 0.34).abs() < 1e-9, "{sewn}");
    assert_eq!(garment.panels[patch.panel].layer, garment.panels[patch.host].layer + 1);
}

#[test]
fn a_pair_of_patches_goes_to_the_halves_of_its_names() {
    let paired = |on: &str| {
        let patch = format!("patch pocket on {on} at (15cm, -40cm) open top");
        sound(&text("pair as left, right", &patch), &[]).remove(0)
    };
    // On two pieces: the second of each is a mirror image.
    let fronts = paired("front");
    assert_eq!(fronts.patches.len(), 2);
    assert_eq!(lies(&fronts.patches[0], [0.05, 0.0]), [200, -400]);
    assert_eq!(lies(&fronts.patches[1], [0.05, 0.0]), [-100, -400]);
    assert_ne!(fronts.patches[0].host, fronts.patches[1].host);
    // On the halves of one piece: the image lies beyond the fold, its face outside too.
    let back = paired("back");
    assert_eq!(back.patches[0].host, back.patches[1].host);
    assert_eq!(lies(&back.patches[1], [0.05, 0.0]), [-100, -400]);
    for patch in fronts.patches.iter().chain(&back.patches) {
        let [a, b, c, d, ..] = patch.map;
        assert!((a * d - b * c - 1.0).abs() < 1e-12);
    }
}

#[test]
fn a_flap_may_lie_on_a_pocket_but_nothing_on_itself() {
    let flap = "panel flap of cotton { rectangle 10cm x 4cm }
        patch pocket on front.left at (15cm, -40cm) open top
        patch flap on pocket at (0, 7cm) open bottom";
    let garment = sound(&text("", flap), &[]).remove(0);
    let layers: Vec<i32> = garment.panels.iter().map(|panel| panel.layer).collect();
    assert_eq!(layers.iter().max(), Some(&2));
    let ring = "panel other = pocket
        patch pocket on other at (0, 0); patch other on pocket at (0, 0)";
    assert_eq!(told(&text("", ring)), ["E0206"]);
    assert_eq!(told(&text("", "patch pocket on pocket at (0, 0)")), ["E0206"]);
}

#[test]
fn every_way_to_be_wrong_is_told() {
    let wrong = |patch: &str| told(&text("", patch));
    assert_eq!(wrong("patch pocket on front.left at (2cm, -40cm)"), ["E0506"]);
    assert_eq!(wrong("patch pocket on front at (15cm, -40cm)"), ["E0505"]);
    assert_eq!(wrong("patch pocket on front.left at (15cm, -40cm) open tpo"), ["E0204"]);
    assert_eq!(
        wrong("patch pocket on front.left at (15cm, -40cm) open top, end, bottom, start"),
        ["E0207"]
    );
    assert_eq!(
        wrong(
            "patch pocket on front.left at (15cm, -40cm)
             patch pocket on front.right at (-15cm, -40cm)"
        ),
        ["E0209"]
    );
    assert_eq!(
        wrong("patch pocket on front.left at (15cm, -40cm); place pocket before l.hip"),
        ["E0209"]
    );
    assert_eq!(wrong("patch pocket on l at (15cm, -40cm)"), ["E0304"]);
    assert_eq!(
        wrong(
            "panel strip of cotton { rectangle 10cm x 5cm }
             seam pocket.top -> strip.bottom
             patch pocket on front.left at (15cm, -40cm)"
        ),
        ["E0503"]
    );
}
