//! What is done to a piece after it is drawn, against lengths known in closed form.

use crate::garments::{sound, told as codes};
use darzi::garment::Garment;
use darzi::garment::panel::{Crease, Panel, Run};
use darzi::garment::seam::{PanelRun, SeamKind};

/// A garment of one panel with the given lines, and what else is said.
fn garment(panel: &str, more: &str) -> Garment {
    let text = format!(
        "garment g {{ wearer l = female {{ size: EU 38 }}
         panel p of cotton {{ {panel} }}
         place p before l.waist; {more} }}"
    );
    sound(&text, &[]).remove(0)
}

fn told(panel: &str) -> Vec<String> {
    let text = format!(
        "garment g {{ wearer l = female {{ size: EU 38 }}
         panel p of cotton {{ {panel} }}
         place p before l.waist }}"
    );
    codes(&text)
}

fn edge(panel: &Panel, name: &str) -> f64 {
    let edge = panel.edges.iter().find(|edge| edge.name == name).unwrap();
    edge.runs.iter().map(Run::length).sum()
}

fn side(runs: &[PanelRun]) -> f64 {
    runs.iter().map(|run| run.run.length()).sum()
}

/// The places of creases along x, mm, with their angles in half turns.
fn folds(creases: &[Crease]) -> Vec<(i64, i64)> {
    let half_turns = |angle: f64| (angle / std::f64::consts::PI).round() as i64;
    let mut folds: Vec<(i64, i64)> = creases
        .iter()
        .map(|crease| ((crease.from[0] * 1e3).round() as i64, half_turns(crease.angle)))
        .collect();
    folds.sort_unstable();
    folds
}

#[test]
fn a_knife_pleat_takes_twice_its_depth_and_lies_beneath_the_edge() {
    // Bottom runs from x = -30 cm to 30 cm; its end is the side called `end`.
    let right = garment(
        "rectangle 60cm x 40cm; pleat on bottom from 10cm to 50cm count 4 depth 3cm facing end",
        "check p.bottom.length = 36cm within 1um; check p.bottom.flat_length = 60cm within 1um",
    );
    let panel = &right.panels[0];
    assert!((edge(panel, "bottom") - 0.36).abs() < 1e-9);
    // Each slot of 10 cm: 4 cm to be seen, then the outer fold, which faces the end of the edge,
    // and 3 cm further on the inner one.
    let wanted = (0..4).flat_map(|i| [(-160 + 100 * i, -1), (-130 + 100 * i, 1)]);
    assert_eq!(folds(&panel.creases), wanted.collect::<Vec<_>>());
    assert!(panel.creases.iter().all(|crease| (crease.to[1] - 0.4).abs() < 1e-9));
    // Two seams each: the halves of the mouth, and the layer beneath with what covers it.
    assert_eq!(right.seams.len(), 8);
    for seam in &right.seams {
        assert_eq!(seam.kind, SeamKind::Pleat);
        assert!((side(&seam.a) - 0.03).abs() < 1e-9 && (side(&seam.b) - 0.03).abs() < 1e-9);
    }
    // The other way round it is the mirror image.
    let left = garment(
        "rectangle 60cm x 40cm; pleat on bottom from 10cm to 50cm count 4 depth 3cm facing start",
        "",
    );
    let mut mirrored: Vec<_> =
        folds(&left.panels[0].creases).into_iter().map(|(x, turn)| (-x, turn)).collect();
    mirrored.sort_unstable();
    assert_eq!(mirrored, folds(&panel.creases));
}

#[test]
fn box_and_inverted_pleats_are_knife_pleats_of_half_the_depth() {
    let of = |kind: &str| {
        garment(
            &format!("rectangle 60cm x 40cm; pleat on bottom count 3 depth 4cm kind {kind}"),
            "",
        )
    };
    let (boxes, inverted) = (of("box"), of("inverted"));
    for garment in [&boxes, &inverted] {
        assert!((edge(&garment.panels[0], "bottom") - 0.36).abs() < 1e-9);
        assert_eq!(garment.seams.len(), 12);
    }
    // Slots of 20 cm. A box takes 12 cm: 2 + 2 folded, 4 seen, 2 + 2 folded; its outer folds are
    // the ends of the box.
    assert_eq!(
        folds(&boxes.panels[0].creases)[..4],
        [(-240, 1), (-220, -1), (-180, -1), (-160, 1)]
    );
    // An inverted one takes 8 cm; its outer folds lie on each other, 4 + 4 cm apart on the flat.
    assert_eq!(
        folds(&inverted.panels[0].creases)[..4],
        [(-240, -1), (-220, 1), (-180, 1), (-160, -1)]
    );
}

#[test]
fn pleats_beneath_each_other_still_find_what_covers_them() {
    // 2 cm seen between pleats of 3 cm: the layer beneath reaches under two others.
    let tight = garment("rectangle 60cm x 40cm; pleat on bottom from 20cm count 5 depth 3cm", "");
    assert!((edge(&tight.panels[0], "bottom") - 0.30).abs() < 1e-9);
    let covers = tight.seams.iter().filter(|seam| seam.a.len() > 1).count();
    assert_eq!(covers, 5);
    for seam in &tight.seams {
        assert!((side(&seam.a) - side(&seam.b)).abs() < 1e-9);
    }
}

#[test]
fn a_pleated_edge_is_sewn_as_long_as_it_is_folded() {
    let text = "garment g { wearer l = female { size: EU 38 }
        panel skirt of cotton {
            outline from (0, 0) {
                waist: line to (50cm, 0); side: line to (55cm, -40cm)
                hem: line to (0, -40cm); fold: line to start }
            pleat on waist from 5cm to 45cm count 5 depth 3cm facing side
            unfold across fold }
        panel band of cotton { rectangle 40cm x 4cm }
        seam skirt.waist -> band.bottom
        place skirt before l.waist }";
    let garment = sound(text, &[]).remove(0);
    let sewn = garment.seams.iter().find(|seam| seam.kind == SeamKind::Plain).unwrap();
    assert!((side(&sewn.a) - 0.4).abs() < 1e-9 && (side(&sewn.b) - 0.4).abs() < 1e-9);
    let long = text.replace("rectangle 40cm", "rectangle 42cm");
    assert_eq!(codes(&long), ["E0501"]);
}

#[test]
fn tucks_stand_on_their_edge() {
    let tucked = garment(
        "rectangle 60cm x 40cm; tuck on bottom at 20cm depth 1cm count 3 every 6cm pressed 5cm",
        "check p.bottom.length = 54cm within 1um",
    );
    assert_eq!(folds(&tucked.panels[0].creases), [(-100, -1), (-40, -1), (20, -1)]);
    assert!(tucked.panels[0].creases.iter().all(|c| (c.to[1] - 0.05).abs() < 1e-9));
    assert_eq!(tucked.seams.len(), 3);
}

#[test]
fn a_dart_with_two_tips_is_sewn_from_tip_to_tip() {
    let darted =
        garment("rectangle 60cm x 40cm; dart at (5cm, 20cm) width 3cm above 8cm below 11cm", "");
    let (upper, lower) = (0.015f64.hypot(0.08), 0.015f64.hypot(0.11));
    let seam = &darted.seams[0];
    assert_eq!((darted.panels[0].loops.len(), seam.kind), (2, SeamKind::Dart));
    for runs in [&seam.a, &seam.b] {
        let lengths: Vec<f64> = runs.iter().map(|run| run.run.length()).collect();
        assert!((lengths[0] - upper).abs() < 1e-9 && (lengths[1] - lower).abs() < 1e-9);
    }
    assert_eq!(
        told("rectangle 60cm x 40cm; dart at (5cm, 20cm) width 3cm above 8cm below 21cm"),
        ["E0406"]
    );
    assert_eq!(told("rectangle 60cm x 40cm; dart at (5cm, 20cm) width 3cm above 8cm"), ["E0208"]);
}

#[test]
fn folds_that_do_not_fit_are_told() {
    let plain = "rectangle 60cm x 40cm;";
    for (line, code) in [
        // The pleats themselves take 36 cm, beneath each other.
        ("pleat on bottom from 10cm to 40cm count 6 depth 3cm", "E0411"),
        // Nothing before the first of them to lie beneath.
        ("pleat on bottom to 30cm count 5 depth 3cm", "E0411"),
        ("pleat on bottom count 4 depth 2cm kind box facing end", "E0207"),
        ("pleat on bottom count 4 depth 2cm facing top", "E0504"),
        ("pleat on bottom count 4 depth 2cm facing rim", "E0204"),
        ("pleat on bottom count 2.5 depth 2cm", "E0303"),
        ("pleat on bottom count 4 depth 2cm kind pinch", "E0203"),
        ("pleat on bottom count 4", "E0208"),
        ("tuck on bottom at 1cm depth 2cm", "E0411"),
        ("tuck on bottom at 10cm depth 2cm count 3", "E0208"),
        ("tuck on bottom at 10cm depth 2cm; tuck on bottom at 12cm depth 2cm", "E0411"),
        ("fold along 120% by 90deg", "E0303"),
        ("fold along 50% by 200deg", "E0303"),
        ("fold from (0, 0) by 90deg", "E0208"),
    ] {
        assert_eq!(told(&format!("{plain} {line}")), [code], "{line}");
    }
}

/// Area of a panel, cm², from the straight lines of its loops.
fn area(panel: &Panel) -> f64 {
    use kurbo::Shape;
    let pieces = panel.loops.iter().flat_map(|ring| &ring.pieces);
    let area: f64 = pieces.flat_map(|piece| piece.path.segments()).map(|s| s.area()).sum();
    (area * 1e8).round() / 1e4
}

#[test]
fn a_counted_grid_is_cut_along_particles() {
    let grid = "size: 40cm x 60cm; grid: 20 x 30;";
    // A trapezoid from the whole lower rim up to columns 4 to 16 of row 30: the left line climbs
    // 30 rows over 4 columns.
    let kept = garment(
        &format!("{grid} cut along (0, 0), (20, 0), (16, 30), (4, 30) keep inside (10, 15)"),
        "check p.cut1.length = 40cm within 1um; check p.cut3.length = 24cm within 1um",
    );
    assert_eq!(area(&kept.panels[0]), 1920.0);
    assert_eq!(kept.panels[0].cell, Some(0.02));
    // What was cut away by two cuts one after the other is the same.
    let twice = garment(
        &format!(
            "{grid} cut along (0, 0), (4, 30), (0, 30) keep outside (10, 15)
             right: cut along (20, 0), (20, 30), (16, 30) keep outside (10, 15)"
        ),
        "",
    );
    assert_eq!(area(&twice.panels[0]), 1920.0);
    // The first rows of the line lie on the rim and cut nothing.
    assert!(edge(&twice.panels[0], "right3") > 0.5);
    assert!((edge(&twice.panels[0], "bottom") - 0.4).abs() < 1e-12);
    let hole =
        garment(&format!("{grid} cut along (5, 5), (15, 5), (10, 15) keep outside (1, 1)"), "");
    assert_eq!(hole.panels[0].loops.len(), 2);
    for (line, code) in [
        ("cut along (5, 5), (15, 5), (10, 15) keep inside (1, 1)", "E0407"),
        ("cut along (5, 5), (15, 5), (10, 15) keep inside (5, 5)", "E0407"),
        ("cut along (5, 5), (15, 5) keep inside (7, 5)", "E0404"),
        ("cut along (5, 5), (15, 5), (25, 15) keep inside (7, 6)", "E0303"),
        ("cut along (5, 5), (15, 15), (15, 5), (5, 15) keep inside (6, 6)", "E0402"),
        ("cut along (5, 5), (15, 5), (10, 15) keep (7, 6)", "E0203"),
        ("cut along (5, 5), (15, 5), (10, 15.5) keep inside (7, 6)", "E0303"),
        ("smooth (5, 5), (6, 6), (7, 7)", "E0204"),
        ("smooth (0, 0), (20, 0)", "E0306"),
        ("move (5, 5) by (1cm, 0)", "E0204"),
    ] {
        assert_eq!(told(&format!("{grid} {line}")), [code], "{line}");
    }
    assert_eq!(
        told("size: 40cm x 60cm; cut along (0, 0), (1, 0), (0, 1) keep inside (1, 1)"),
        ["E0208"]
    );
}

#[test]
fn a_mask_is_drawn_in_characters() {
    let mask = |rows: &str| format!("size: 30cm x 20cm\n mask:\n{rows}\n");
    let ring = garment(&mask("|######|\n|##..##|\n|##..##|\n|######|"), "");
    // 20 of 24 cells of 5 cm.
    assert_eq!((area(&ring.panels[0]), ring.panels[0].loops.len()), (500.0, 2));
    assert_eq!(edge(&ring.panels[0], "rim"), 1.0);
    assert_eq!(told(&mask("|###..#|\n|######|\n|######|\n|#...##|")), Vec::<String>::new());
    assert_eq!(told(&mask("|######|\n|......|\n|######|\n|######|")), ["W0401"]);
    assert_eq!(told(&mask("|##x###|\n|######|")), ["E0602"]);
    assert_eq!(told(&mask("|######|\n|#####|\n|######|")), ["E0601"]);
    assert_eq!(told(&mask("|......|\n|......|")), ["E0813"]);
}

#[test]
fn particles_of_the_rim_are_smoothed_and_moved() {
    let grid = "size: 40cm x 40cm; grid: 20 x 20;";
    let moved = garment(&format!("{grid} move (0, 20), (20, 20) by (0, 5cm)"), "");
    // Both upper corners alone: the rest of the upper rim stays.
    assert_eq!(area(&moved.panels[0]), 1600.0 + 2.0 * 2.0 * 5.0 / 2.0);
    let smoothed = garment(
        &format!("{grid} move (10, 20) by (0, 4cm); bow: smooth (20, 20), (10, 20), (0, 20)"),
        "",
    );
    // A curve through three points of a circle of radius (20² + 4²) / 8 = 52 cm, which Hobby's
    // curve keeps to well within a millimetre: an arc of 2 · 52 · asin(20 / 52) cm.
    let arc = 2.0 * 0.52 * (20.0f64 / 52.0).asin();
    assert!((edge(&smoothed.panels[0], "bow") - arc).abs() < 2e-4, "{arc}");
}

#[test]
fn drawings_are_mirrored_and_resized() {
    let corner = |lines: &str| {
        let made = garment(&format!("rectangle 20cm x 10cm; {lines}"), "");
        let pieces = made.panels[0].loops[0].pieces.iter();
        let points = pieces.flat_map(|piece| piece.path.elements().to_vec());
        let points = points.filter_map(|element| element.end_point());
        let (x, y) = points
            .fold((f64::NEG_INFINITY, f64::NEG_INFINITY), |(x, y), p| (x.max(p.x), y.max(p.y)));
        ((x * 1e5).round() / 1e3, (y * 1e5).round() / 1e3)
    };
    assert_eq!(corner("scale by 1.5"), (15.0, 15.0));
    assert_eq!(corner("scale by 1.5 x 2"), (15.0, 20.0));
    assert_eq!(corner("scale width 30cm"), (15.0, 10.0));
    assert_eq!(corner("scale height 30cm"), (10.0, 30.0));
    assert_eq!(corner("scale to 15cm on end"), (15.0, 15.0));
    assert_eq!(corner("scale by 2 about (10cm, 0)"), (10.0, 20.0));
    assert_eq!(corner("mirror about (15cm, 0)"), (40.0, 10.0));
    assert_eq!(corner("mirror; rotate by 90deg"), (0.0, 10.0));
    let plain = "rectangle 20cm x 10cm;";
    assert_eq!(told(&format!("{plain} scale to 15cm")), ["E0208"]);
    assert_eq!(told(&format!("{plain} scale by 0")), ["E0303"]);
    assert_eq!(told(&format!("{plain} scale by 2 width 3cm")), ["E0209"]);
}

#[test]
fn holes_are_round_long_or_slits() {
    let cut = |hole: &str| garment(&format!("rectangle 40cm x 40cm; {hole}"), "").panels.remove(0);
    let ellipse = cut("hole ellipse at (0, 20cm) radius 6cm x 3cm turn 30deg");
    assert!((area(&ellipse) - (1600.0 - std::f64::consts::PI * 18.0)).abs() < 0.05);
    let slit = cut("open: hole slit from (0, 10cm) to (0, 30cm)");
    assert!((edge(&slit, "open1") - edge(&slit, "open2")).abs() < 1e-12);
    assert!((edge(&slit, "open1") - 0.2).abs() < 1e-4);
    let plain = "rectangle 40cm x 40cm;";
    for (hole, code) in [
        ("hole circle at (0, 20cm) radius 6cm x 3cm", "E0207"),
        ("hole ellipse at (0, 20cm)", "E0208"),
        ("hole slit from (0, 20cm)", "E0208"),
        ("hole slit from (0, 20cm) to (0, 20cm)", "E0404"),
        ("hole slit from (30cm, 20cm) to (30cm, 30cm)", "E0410"),
    ] {
        assert_eq!(told(&format!("{plain} {hole}")), [code], "{hole}");
    }
}

/// Two plain pieces, before and behind, sewn at both sides.
fn tube(panel: &str, more: &str) -> String {
    format!(
        "garment g {{ wearer l = female {{ size: EU 38 }}
         panel front of cotton {{ size: 50cm x 60cm; grid: 50 x 60; {panel} }}
         panel back = front with {{ }}
         seam front.end -> back.start; seam front.start -> back.end notches 1
         place front before l.waist; place back behind l.waist
         {more} }}"
    )
}

#[test]
fn seams_are_notched_on_both_partners() {
    let garment = sound(&tube("", ""), &[]).remove(0);
    let places = |panel: &Panel| -> Vec<(i64, i64, u8)> {
        let mm = |x: f64| (x * 1e3).round() as i64;
        panel.notches.iter().map(|n| (mm(n.at[0]), mm(n.at[1]), n.count)).collect()
    };
    // Thirds of 60 cm, and the one that the other seam asks for; the mark looks into the cloth.
    let [front, back] = garment.panels.as_slice() else { panic!("two pieces") };
    assert_eq!(places(front), [(250, 200, 1), (250, 400, 1), (-250, 300, 1)]);
    let mut behind = places(back);
    behind.sort_unstable();
    assert_eq!(behind, [(-250, 200, 1), (-250, 400, 1), (250, 300, 1)]);
    for (notch, x) in front.notches.iter().zip([-1.0, -1.0, 1.0]) {
        assert!((notch.inward[0] - x).abs() < 1e-9 && notch.inward[1].abs() < 1e-9);
    }
    // Between two back pieces there are two cuts.
    let text = "garment g { wearer l = female { size: EU 38 }
        panel back of cotton { rectangle 20cm x 60cm; pair as left, right }
        seam back.left.start -> back.right.start
        place back behind l.waist }";
    let backs = sound(text, &[]).remove(0);
    assert!(backs.panels.iter().all(|panel| panel.notches.iter().all(|n| n.count == 2)));
    assert_eq!(backs.panels[0].notches.len(), 2);
}

#[test]
fn allowances_and_plies_are_said_by_panel_and_edge() {
    use darzi::garment::panel::Corner;
    let more = "allowance: 12mm";
    let panel = "allowance: 15mm; plies: 2; leave 4cm on bottom, top corner square";
    let made = garment(&format!("rectangle 20cm x 10cm; {panel}"), more);
    let said: Vec<(&str, f64, Corner)> = made.panels[0]
        .edges
        .iter()
        .map(|edge| (edge.name.as_str(), edge.allowance, edge.corner))
        .collect();
    assert_eq!(
        said,
        [
            ("bottom", 0.04, Corner::Square),
            ("end", 0.015, Corner::Mitre),
            ("top", 0.04, Corner::Square),
            ("start", 0.015, Corner::Mitre),
        ]
    );
    let plain = garment("rectangle 20cm x 10cm", more);
    assert_eq!(plain.panels[0].edges[0].allowance, 0.012);
    let mass = |made: &Garment| made.fabrics[made.panels[0].fabric].mass;
    assert!((mass(&made) - 2.0 * mass(&plain)).abs() < 1e-12);
    assert_eq!(told("rectangle 20cm x 10cm; leave 4cm on botom"), ["E0204"]);
    assert_eq!(told("rectangle 20cm x 10cm; plies: 0"), ["E0303"]);
}

#[test]
fn points_are_sewn_to_points() {
    let line = "seam points front(3, 4) -> back(0, 4) -> back(0, 5); button front.top over back.top count 3 every 10cm";
    let garment = sound(&tube("", line), &[]).remove(0);
    let [points, buttons] = garment.stitches.as_slice() else { panic!("two lines") };
    let mm = |at: [f64; 2]| at.map(|x| (x * 1e3).round() as i64);
    let pairs: Vec<_> = points.pairs.iter().map(|p| p.map(|(n, at)| (n, mm(at)))).collect();
    assert_eq!(pairs, [[(0, [-220, 40]), (1, [-250, 40])], [(0, [-220, 40]), (1, [-250, 50])]]);
    // The upper rim runs from x = 25 cm backwards; 15 mm below it.
    let pairs: Vec<_> = buttons.pairs.iter().map(|p| p.map(|(_, at)| mm(at))).collect();
    assert_eq!(pairs, [[[100, 585]; 2], [[0, 585]; 2], [[-100, 585]; 2]]);
    assert!(buttons.closure && !points.closure);
    for (line, code) in [
        ("seam points front(3, 4) -> back(60, 4)", "E0303"),
        ("seam points front(3) -> back(0, 4)", "E0306"),
        ("seam points front.side -> back(0, 4)", "E0204"),
        ("seam points (3cm, 4cm) -> back(0, 4)", "E0304"),
        ("seam near front.top -> back.top", "E0208"),
        ("seam front.top -> back.top within 1cm", "E0207"),
        ("seam within 1cm", "E0208"),
        ("button front.top over back.top count 30 every 10cm", "E0303"),
        ("button front over back.top count 3", "E0304"),
        ("drape { settle until speed < 2mm/s; sew until gap < 1mm; close; close }", "E0804"),
    ] {
        assert_eq!(codes(&tube("", line)).first().map(String::as_str), Some(code), "{line}");
    }
}

#[test]
fn a_hem_is_cut_on_and_lies_under_its_edge() {
    let hemmed = garment(
        "rectangle 60cm x 40cm; hem on bottom depth 3cm double; facing on top width 5cm of denim
         interfacing on top width 4cm of denim",
        "",
    );
    let panel = &hemmed.panels[0];
    let allowance = |name: &str| {
        panel.edges.iter().find(|edge| edge.name == name).map(|edge| edge.allowance).unwrap()
    };
    // Turned twice, it takes twice its depth and adds two plies.
    assert!((allowance("bottom") - 0.06).abs() < 1e-12);
    assert!((allowance("top") - 0.01).abs() < 1e-12);
    let bands: Vec<_> = panel
        .bands
        .iter()
        .map(|band| {
            let fabric = hemmed.fabrics[band.fabric].name.as_str();
            (fabric, band.plies, (band.width * 1e3).round() as i64, band.runs.len())
        })
        .collect();
    assert_eq!(bands, [("cotton", 2, 30, 1), ("denim", 1, 50, 1), ("denim", 1, 40, 1)]);
    assert_eq!(told("rectangle 60cm x 40cm; hem on botom depth 3cm"), ["E0204"]);
    assert_eq!(told("rectangle 60cm x 40cm; hem on bottom depth 3m"), ["E0303"]);
    assert_eq!(told("rectangle 60cm x 40cm; facing on bottom width 3cm of cottn"), ["E0201"]);
}
