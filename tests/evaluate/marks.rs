//! Lines drawn on a piece: what lies on them, and what is cut along them.

use crate::garments::{length, sound, told as codes};
use darzi::garment::Garment;
use darzi::garment::panel::{BandKind, Panel};
use darzi::geometry::curve;
use darzi::mesh::{Options, compile, validate::validate};

/// A garment of one panel with the given lines, and what else is said.
fn garment(panel: &str, more: &str) -> Garment {
    let text = format!(
        "garment g {{ wearer l = female {{ size: EU 38 }}
         panel p of cotton {{ grid: 1cm; {panel} }}
         place p before l.waist; {more} }}"
    );
    sound(&text, &[]).remove(0)
}

fn told(panel: &str, more: &str) -> Vec<String> {
    codes(&format!(
        "garment g {{ wearer l = female {{ size: EU 38 }}
         panel p of cotton {{ {panel} }}
         place p before l.waist; {more} }}"
    ))
}

fn names(panel: &Panel) -> Vec<&str> {
    panel.edges.iter().map(|edge| edge.name.as_str()).collect()
}

fn edge(panel: &Panel, name: &str) -> f64 {
    let edge = panel.edges.iter().find(|edge| edge.name == name);
    length(&edge.unwrap_or_else(|| panic!("{name} of {:?}", names(panel))).runs)
}

fn area(panel: &Panel) -> f64 {
    use kurbo::Shape;
    let ring = |ring: &darzi::garment::panel::Loop| -> f64 {
        let mut path = kurbo::BezPath::new();
        for (number, piece) in ring.pieces.iter().enumerate() {
            path.extend(piece.path.iter().skip(usize::from(number > 0)));
        }
        path.close_path();
        path.area()
    };
    panel.loops.iter().map(ring).sum()
}

/// Compiled, it is sound, and both lips have as many points, each within 0.2 mm of its fellow.
fn lips_meet(garment: &Garment, lips: [&str; 2]) {
    let options = Options { atlas: false, ..Options::default() };
    let compiled = compile(garment, &options).unwrap_or_else(|said| panic!("{said:?}"));
    validate(&compiled).unwrap_or_else(|flaws| panic!("{flaws:?}"));
    let points = lips.map(|name| {
        let mesh = &compiled.panels[0];
        &mesh.edges.iter().find(|edge| edge.name == name).unwrap().points
    });
    assert_eq!(points[0].len(), points[1].len());
    assert!(points[0].len() > 5);
    for (a, b) in points[0].iter().zip(points[1]) {
        let [p, q] = [a, b].map(|k| compiled.particles[*k as usize]);
        assert!((p[0] - q[0]).hypot(p[1] - q[1]) < 2.1e-4, "{p:?} {q:?}");
    }
}

#[test]
fn a_mark_has_a_length_and_places_and_no_edge() {
    let right = garment(
        "rectangle 40cm x 60cm
         mark pocket from (3cm, 40cm) { line to (13cm, 40cm); line to (13cm, 45cm) }",
        "check p.pocket.length = 15cm within 1um
         check distance(p.pocket.at(5cm), p.pocket.end) = 7.0710678cm within 1um",
    );
    let panel = &right.panels[0];
    assert_eq!(names(panel), ["bottom", "end", "top", "start"]);
    assert_eq!(panel.marks.len(), 1);
    assert!((curve::length(&panel.marks[0].path) - 0.15).abs() < 1e-9);
    // On an unfolded piece there are two, each by its half; one from fold to side is one.
    let shape = "outline from (0, 0) { hem: line to (20cm, 0); side: line to (20cm, 50cm)
                 top: line to (0, 50cm); fold: line to start }
                 unfold across fold";
    let both = garment(
        &format!(
            "{shape}; mark pocket from (5cm, 20cm) {{ line to (15cm, 20cm) }}
             mark yoke from (0, 30cm) {{ curve to (20cm, 35cm) bulge 1cm }}"
        ),
        "check p.left.pocket.length = 10cm within 1um; check p.yoke.length > 40cm",
    );
    let marks: Vec<&str> = both.panels[0].marks.iter().map(|mark| mark.name.as_str()).collect();
    assert_eq!(marks, ["left.pocket", "right.pocket", "yoke"]);
}

#[test]
fn a_slit_at_the_rim_opens_the_outline_and_one_inside_is_a_hole() {
    let mark = "mark vent from (5cm, 0) { line to (5cm, 20cm) }";
    let open = garment(&format!("rectangle 40cm x 60cm; {mark}; slit along vent"), "");
    let panel = &open.panels[0];
    assert_eq!(panel.loops.len(), 1);
    assert_eq!(names(panel), ["bottom", "end", "top", "start", "vent1", "vent2"]);
    // What is cut open has no width to speak of.
    assert!((edge(panel, "bottom") - 0.4).abs() < 2.1e-4);
    assert!((edge(panel, "vent1") - 0.2).abs() < 1e-6);
    assert!((edge(panel, "vent1") - edge(panel, "vent2")).abs() < 1e-9);
    assert!((area(panel) - 0.24).abs() < 2.1e-5);
    lips_meet(&open, ["vent1", "vent2"]);
    // The first lip lies to the left of its course, whichever way it was drawn.
    for (mark, left) in [(mark, true), ("mark vent from (5cm, 20cm) { line to (5cm, 0) }", false)] {
        let panel = garment(&format!("rectangle 40cm x 60cm; {mark}; slit along vent"), "");
        let panel = &panel.panels[0];
        let lip = panel.edges.iter().find(|edge| edge.name == "vent1").unwrap();
        let run = &lip.runs[0];
        let path = &panel.loops[run.ring].pieces[run.piece].path;
        let at = |arc: f64| curve::at(path, arc).0;
        assert_eq!(at(run.from).y < at(run.to).y, left);
        let rim = if left { run.from } else { run.to };
        assert_eq!(at(rim).x < 0.05, left, "{:?}", at(rim));
    }
    let inside = garment(
        "rectangle 40cm x 60cm; mark cut from (0, 30cm) { curve to (10cm, 40cm) bulge 2cm }
         pocket: slit along cut facing 3cm",
        "",
    );
    let panel = &inside.panels[0];
    assert_eq!(panel.loops.len(), 2);
    assert!((edge(panel, "pocket1") - edge(panel, "pocket2")).abs() < 2e-4);
    assert_eq!(panel.bands.len(), 2);
    lips_meet(&inside, ["pocket1", "pocket2"]);
}

#[test]
fn a_slit_along_the_fold_parts_an_unfolded_piece_in_its_middle() {
    let text = "outline from (0, 0) { hem: line to (20cm, 0); side: line to (22cm, 50cm)
                 neck: curve to (0, 46cm) leaving square arriving square; fold: line to start }
                 unfold across fold
                 mark opening from (0, 46cm) { line to (0, 26cm) }
                 slit along opening facing 4cm";
    let open = garment(text, "button p.opening1 over p.opening2 count 3 inset 0mm");
    let panel = &open.panels[0];
    assert_eq!(panel.loops.len(), 1);
    assert!((edge(panel, "opening1") - 0.2).abs() < 1e-9);
    lips_meet(&open, ["opening1", "opening2"]);
    // The neckline runs on from one side of the slit to the other.
    let whole = garment(&text.replace("slit along opening facing 4cm", ""), "");
    assert!((edge(panel, "neck") - edge(&whole.panels[0], "neck")).abs() < 2.1e-4);
    // Off the fold both halves are slit; on both pieces of a pair too.
    let two = garment(
        &text.replace("(0, 46cm) { line to (0, 26cm)", "(10cm, 0) { line to (10cm, 9cm)"),
        "",
    );
    let lips: Vec<&str> = names(&two.panels[0]);
    assert!(lips.contains(&"left.opening1") && lips.contains(&"right.opening2"), "{lips:?}");
    lips_meet(&two, ["left.opening1", "left.opening2"]);
    lips_meet(&two, ["right.opening1", "right.opening2"]);
}

#[test]
fn a_placket_lies_over_a_slit_and_its_buttons_on_the_lips() {
    let text = "rectangle 50cm x 60cm; mark opening from (0, 60cm) { line to (0, 34cm) }
                slit along opening placket 3cm of denim";
    let open = garment(text, "button p.opening1 over p.opening2 count 4 every 6cm");
    let panel = &open.panels[0];
    for (band, lip) in panel.bands.iter().zip(["opening1", "opening2"]) {
        assert_eq!((band.kind, band.plies, band.width), (BandKind::Strip, 4, 0.015));
        assert_eq!(open.fabrics[band.fabric].name, "denim");
        assert!((length(&band.runs) - edge(panel, lip)).abs() < 1e-9);
    }
    assert_eq!(panel.bands.len(), 2);
    assert!(panel.edges.iter().all(|edge| edge.allowance == 0.01), "nothing is cut on");
    // Each button joins two places a slit's width apart.
    let pairs = &open.stitches[0].pairs;
    assert_eq!(pairs.len(), 4);
    for [(_, a), (_, b)] in pairs {
        assert!((a[0] - b[0]).abs() < 2.1e-4 && (a[1] - b[1]).abs() < 1e-3, "{a:?} {b:?}");
    }
    lips_meet(&open, ["opening1", "opening2"]);
    let slit = "rectangle 50cm x 60cm; mark m from (0, 60cm) { line to (0, 34cm) }; slit along m ";
    assert_eq!(told(&format!("{slit}placket 80cm"), ""), ["E0303"]);
    assert_eq!(told(&format!("{slit}placket 3cm facing 3cm"), ""), ["E0209"]);
}

#[test]
fn a_piece_sewn_to_a_patch_is_led_by_it() {
    let text = |seam: &str| {
        codes(&format!(
            "garment g {{ fabric: cotton; wearer l = female {{ size: EU 38 }}
             panel front {{ rectangle 50cm x 60cm }}
             panel pocket {{ rectangle 16cm x 18cm }}
             panel frill {{ rectangle 16cm x 5cm }}
             patch pocket on front at (8cm, 20cm) open top
             {seam}; place front before l.waist }}"
        ))
    };
    assert_eq!(text("seam pocket.top -> frill.bottom"), Vec::<String>::new());
    assert_eq!(text(""), ["E0801"]);
}

#[test]
fn a_piece_is_trimmed_along_a_mark_from_rim_to_rim() {
    let of = |keep: &str| {
        garment(
            &format!(
                "rectangle 40cm x 60cm; mark yoke from (-20cm, 40cm) {{ line to (20cm, 50cm) }}
                 trim along yoke keep {keep}"
            ),
            "",
        )
        .panels
        .remove(0)
    };
    let (low, high) = (of("bottom"), of("top"));
    assert_eq!(names(&low), ["bottom", "end", "yoke", "start"]);
    assert!((area(&low) - 0.4 * 0.45).abs() < 1e-9 && (area(&high) - 0.4 * 0.15).abs() < 1e-9);
    assert!((edge(&low, "start") - 0.4).abs() < 1e-9 && (edge(&high, "start") - 0.2).abs() < 1e-9);
    assert!((edge(&low, "yoke") - 0.4_f64.hypot(0.1)).abs() < 1e-9);
    assert!(low.marks.is_empty());
    assert!((area(&of("(0, 10cm)")) - 0.18).abs() < 1e-9);
    // A bite out of one edge leaves one edge of that name.
    let bitten = garment(
        "rectangle 40cm x 60cm
         mark scye from (20cm, 50cm) { curve to (20cm, 30cm) leaving 180deg arriving 0deg }
         trim along scye keep bottom",
        "check p.end.flat_length = 40cm within 1um",
    );
    let panel = &bitten.panels[0];
    assert_eq!(panel.edges.iter().filter(|edge| edge.name == "end").count(), 1);
    assert!(area(panel) < 0.24 && area(panel) > 0.2);
    // And of a closed edge too.
    let disc = garment(
        "circle radius 20cm; mark low from (-12cm, -16cm) { line to (12cm, -16cm) }
         trim along low keep (0, 0)",
        "",
    );
    assert_eq!(names(&disc.panels[0]), ["rim", "low"]);
    let angle = 2.0 * 0.6_f64.asin();
    assert!((edge(&disc.panels[0], "rim") - 0.2 * (std::f64::consts::TAU - angle)).abs() < 1e-6);
}

#[test]
fn a_patch_hangs_from_a_mark() {
    let text = |on: &str, mark: &str| {
        format!(
            "garment g {{ wearer l = female {{ size: EU 38 }}
             panel p of cotton {{ rectangle 40cm x 60cm; mark mouth from {mark} }}
             panel pocket of cotton {{ rectangle 10cm x 12cm }}
             patch pocket on p along {on} open top
             place p before l.waist }}"
        )
    };
    let lies = |text: &str, x: f64, y: f64| {
        let map = kurbo::Affine::new(sound(text, &[])[0].patches[0].map);
        let p = map * kurbo::Point::new(x, y);
        [p.x, p.y].map(|v| (v * 1e4).round() as i64)
    };
    // Its upper edge, 12 cm up, comes to the line; whichever way this was drawn.
    for mark in ["(4cm, 40cm) { line to (16cm, 40cm) }", "(16cm, 40cm) { line to (4cm, 40cm) }"] {
        for on in ["mouth", "p.mouth"] {
            assert_eq!(lies(&text(on, mark), 0.0, 0.12), [1000, 4000]);
            assert_eq!(lies(&text(on, mark), 0.05, 0.0), [1500, 2800]);
        }
    }
    let slanting = text("mouth", "(4cm, 40cm) { line to (12cm, 46cm) }");
    assert_eq!(lies(&slanting, 0.0, 0.12), [800, 4300]);
    assert_eq!(lies(&slanting, 0.05, 0.12), [1200, 4600]);
}

#[test]
fn what_can_be_wrong_with_marks_is_told() {
    let on = |more: &str| told(&format!("rectangle 40cm x 60cm; {more}"), "");
    let mark = "mark m from (0, 30cm) { line to (5cm, 40cm) };";
    for (text, code) in [
        ("mark m from (0, 80cm) { line to (5cm, 90cm) }".to_owned(), "E0412"),
        (format!("{mark} trim along m keep top"), "E0413"),
        (format!("{mark} slit along n"), "E0204"),
        ("mark m from (-20cm, 9cm) { line to (20cm, 9cm) }; slit along m".to_owned(), "E0413"),
        ("mark m from (0, 9cm) { line to (1mm, 9cm) }; slit along m".to_owned(), "E0404"),
        (
            "mark m from (-20cm, 9cm) { line to (20cm, 9cm) }; trim along m keep end".to_owned(),
            "E0413",
        ),
        (
            "mark m from (-20cm, 9cm) { line to (20cm, 9cm) }; trim along m keep (1m, 1m)"
                .to_owned(),
            "E0413",
        ),
        (
            "mark m from (-20cm, 9cm) { line to (20cm, 9cm) }; trim along m keep tip".to_owned(),
            "E0204",
        ),
        ("mark m from (-20cm, 0) { line to (20cm, 0) }; trim along m keep top".to_owned(), "E0413"),
        ("mark m from (0, 9cm) { a: line to (9cm, 9cm) }".to_owned(), "E0207"),
        ("mark m from (0, 9cm) { }".to_owned(), "E0401"),
        ("mark top from (0, 9cm) { line to (9cm, 9cm) }".to_owned(), "E0205"),
        ("mark m from (0, 9cm) { curve to (9cm, 9cm) leaving smooth }".to_owned(), "E0403"),
    ] {
        assert_eq!(on(&text), [code], "{text}");
    }
    for more in ["attach p.m to l.waist", "fix p.m", "seam p.m -> p.top"] {
        assert_eq!(told(&format!("rectangle 40cm x 60cm; {mark}"), more), ["E0304"], "{more}");
    }
}
