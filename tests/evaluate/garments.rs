//! From text to garment: what the examples are worked out to, and what is said of mistakes.

use darzi::diagnostic::{Diagnostic, render};
use darzi::evaluate::{Options, evaluate};
use darzi::garment::Garment;
use darzi::garment::panel::Run;
use darzi::world::{Memory, World};
use std::fmt::Write;
use std::fs;
use std::path::Path;

pub fn worked(text: &str, set: &[(&str, &str)]) -> (Memory, Vec<Garment>, Vec<Diagnostic>) {
    let mut world = Memory::new([("main.garment", text)]);
    let root = world.open("main.garment").unwrap();
    let set = set.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned())).collect();
    let (garments, told) = evaluate(&mut world, root, &Options { set, ..Options::default() });
    (world, garments, told)
}

pub fn sound(text: &str, set: &[(&str, &str)]) -> Vec<Garment> {
    let (world, garments, told) = worked(text, set);
    assert!(told.is_empty(), "{}", render::report(&told, &world, false, 100));
    garments
}

/// The codes of what is said of a text.
pub fn told(text: &str) -> Vec<String> {
    worked(text, &[]).2.into_iter().map(|told| told.code).collect()
}

pub fn length<'a>(runs: impl IntoIterator<Item = &'a Run>) -> f64 {
    runs.into_iter().map(Run::length).sum()
}

/// Edges with their lengths in cm, seams with both lengths.
fn summary(garments: &[Garment]) -> String {
    let mut out = String::new();
    for garment in garments {
        let fabrics: Vec<&str> =
            garment.fabrics.iter().map(|fabric| fabric.name.as_str()).collect();
        writeln!(out, "{} of {}", garment.name, fabrics.join(", ")).unwrap();
        for panel in &garment.panels {
            let pieces: Vec<usize> = panel.loops.iter().map(|ring| ring.pieces.len()).collect();
            writeln!(out, "  {} {pieces:?} grain {:.1}", panel.name, panel.grain.to_degrees())
                .unwrap();
            for edge in &panel.edges {
                writeln!(out, "    {:<14} {:8.3}", edge.name, length(&edge.runs) * 100.0).unwrap();
            }
        }
        for seam in &garment.seams {
            let side = |runs: &[darzi::garment::seam::PanelRun]| {
                length(runs.iter().map(|run| &run.run)) * 100.0
            };
            writeln!(
                out,
                "  {:?} {}  {:.3} / {:.3}",
                seam.kind,
                seam.name,
                side(&seam.a),
                side(&seam.b)
            )
            .unwrap();
        }
        writeln!(
            out,
            "  {} bodies, {} solids, {} attachments, {} pins, {} phases, {} pictures",
            garment.bodies.len(),
            garment.solids.len(),
            garment.attachments.len(),
            garment.pins.len(),
            garment.schedule.len(),
            garment.pictures.len()
        )
        .unwrap();
    }
    out
}

#[test]
fn the_examples_are_worked_out() {
    insta::glob!(concat!(env!("CARGO_MANIFEST_DIR"), "/examples"), "*.garment", |path| {
        let text = fs::read_to_string(path).unwrap();
        let garments = sound(&text, &[]);
        assert!(!garments.is_empty(), "nothing is made and nothing is said");
        insta::assert_snapshot!(summary(&garments));
    });
}

#[test]
fn the_starter_is_sound() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("stdlib/starter.garment");
    let garments = sound(&fs::read_to_string(path).unwrap(), &[("length", "75cm")]);
    assert_eq!(garments.len(), 1);
}

/// Each file of mistakes begins with the codes it must be given, `//~ E0501`.
#[test]
fn mistakes_are_told_by_their_codes() {
    insta::glob!(
        concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/mistakes"),
        "*.garment",
        |path| {
            let text = fs::read_to_string(path).unwrap();
            let (world, _, told) = worked(&text, &[]);
            let first = text.lines().next().unwrap();
            let mut wanted: Vec<&str> =
                first.strip_prefix("//~").expect("codes").split_whitespace().collect();
            let mut found: Vec<&str> = told.iter().map(|told| told.code.as_str()).collect();
            wanted.sort_unstable();
            found.sort_unstable();
            let report = render::report(&told, &world, false, 100);
            assert_eq!(wanted, found, "{report}");
            insta::assert_snapshot!(report);
        }
    );
}

/// The loops are closed to the last bit, the outline runs anticlockwise, holes clockwise, and
/// pieces are as long as they say.
#[test]
fn outlines_are_closed_and_turned() {
    use kurbo::Shape;
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    for entry in fs::read_dir(folder).unwrap() {
        let text = fs::read_to_string(entry.unwrap().path()).unwrap();
        for panel in sound(&text, &[]).iter().flat_map(|garment| &garment.panels) {
            for (number, ring) in panel.loops.iter().enumerate() {
                let mut whole = kurbo::BezPath::new();
                let ends: Vec<_> = ring
                    .pieces
                    .iter()
                    .map(|piece| {
                        let points: Vec<_> =
                            piece.path.elements().iter().filter_map(|e| e.end_point()).collect();
                        whole.extend(
                            piece.path.iter().skip(usize::from(!whole.elements().is_empty())),
                        );
                        (points[0], points[points.len() - 1])
                    })
                    .collect();
                for (i, (_, end)) in ends.iter().enumerate() {
                    assert_eq!(*end, ends[(i + 1) % ends.len()].0, "{} {i}", panel.name);
                }
                whole.close_path();
                assert_eq!(whole.area() > 0.0, number == 0, "{} loop {number}", panel.name);
                for piece in &ring.pieces {
                    assert!((piece.path.perimeter(1e-9) - piece.length).abs() < 1e-8);
                }
            }
        }
    }
}

/// Both halves of an unfolded piece are mirror images, whichever way round it was drawn.
#[test]
fn unfolding_does_not_depend_on_the_sense_of_drawing() {
    let garment = |outline: &str| {
        let text = format!(
            "garment g {{ wearer l = female {{ size: EU 38 }}
             panel p of cotton {{ outline from (0, 0) {{ {outline} }}; unfold across fold }}
             place p before l.waist }}"
        );
        sound(&text, &[]).remove(0)
    };
    let there = garment(
        "waist: line to (20cm, 1cm); side: line to (25cm, -50cm); hem: line to (0, -51cm); fold: line to start",
    );
    let back = garment(
        "fold: line to (0, -51cm); hem: line to (25cm, -50cm); side: line to (20cm, 1cm); waist: line to start",
    );
    for name in ["waist", "left.side", "right.side", "hem"] {
        let of = |garment: &Garment| {
            let panel = &garment.panels[0];
            let edge = panel.edges.iter().find(|edge| edge.name == name).unwrap();
            length(&edge.runs)
        };
        assert!((of(&there) - of(&back)).abs() < 1e-12);
    }
    // The wearer's left is at x > 0, before the body.
    for garment in [&there, &back] {
        let panel = &garment.panels[0];
        let edge = panel.edges.iter().find(|edge| edge.name == "left.side").unwrap();
        let path = &panel.loops[0].pieces[edge.runs[0].piece].path;
        assert!(path.elements().iter().filter_map(|e| e.end_point()).all(|p| p.x > 0.1));
    }
}

/// `--set` reaches parameters, and their ranges hold.
#[test]
fn parameters_are_set_from_outside() {
    let text = "param side = 40cm in 10cm..60cm
        scene s { cloth c of cotton { size: side x side } }";
    let edge = |garments: &[Garment]| length(&garments[0].panels[0].edges[0].runs);
    assert!((edge(&sound(text, &[])) - 0.4).abs() < 1e-12);
    assert!((edge(&sound(text, &[("side", "1/2ft")])) - 0.1524).abs() < 1e-12);
    for (set, code) in [
        (("side", "70cm"), "E0303"),
        (("side", "30"), "E0301"),
        (("sied", "30cm"), "E0204"),
        (("side", "30cm)"), "E0101"),
        (("side", "30 cm"), "E0102"),
        (("side", "30cm; let more = 1"), "E0212"),
    ] {
        let (_, garments, told) = worked(text, &[set]);
        assert_eq!(told.iter().map(|t| t.code.as_str()).collect::<Vec<_>>(), [code], "{set:?}");
        assert!(garments.is_empty() || !matches!(code, "E0301" | "E0303"));
    }
    // What is set is shown as a text of its own.
    let (world, _, told) = worked(text, &[("side", "30"), ("sied", "30 cm")]);
    insta::assert_snapshot!(render::report(&told, &world, false, 100));
}

/// Texts that would run for ever, or too deep, end with a message.
#[test]
fn every_text_ends() {
    let chain: String =
        (0..20_000).map(|i| format!("let a{i} = a{} + 1cm\n", i + 1)).collect::<String>()
            + "let a20000 = 1cm";
    let doubling: String = "fn f0(x: number): number = x\n".to_owned()
        + &(1..60)
            .map(|i| format!("fn f{i}(x: number): number = f{0}(x) + f{0}(x)\n", i - 1))
            .collect::<String>()
        + "let big = f59(1)";
    let cases = [
        (chain.as_str(), "E0211"),
        (doubling.as_str(), "E0210"),
        ("fn f(x: number): number = f(x)\nlet a = f(1)", "E0206"),
        ("for i in 1..100000000 { let a = i }", "E0210"),
        ("for i in 1..1000 { for j in 1..1000 { let b = j } }", "E0210"),
        ("let a = b\nlet b = c\nlet c = a", "E0206"),
        ("fabric a = b with { }\nfabric b = a with { }", "E0206"),
        ("let a = 1e300m * 1e300m", "E0310"),
        // What a loop does wrong in each turn is said a few times only.
        (
            "scene s { cloth c of cotton { size: 1m x 1m }; for i in 1..50000 { check i = 0 } }",
            "E0806",
        ),
        (
            "garment g { wearer l = female { size: EU 38 }
             panel a of cotton { rectangle 10cm x 10cm }; place a before l.waist
             for i in 1..50000 { seam a.start -> a.end } }",
            "E0503",
        ),
    ];
    for (text, code) in cases {
        let (_, _, told) = worked(text, &[]);
        let codes: Vec<&str> = told.iter().map(|told| told.code.as_str()).collect();
        assert!(codes.contains(&code), "{codes:?} for {}", &text[..60.min(text.len())]);
        assert!(told.len() < 50, "{} messages", told.len());
    }
}

pub fn codes(told: &[Diagnostic]) -> Vec<&str> {
    told.iter().map(|told| told.code.as_str()).collect()
}

/// Names come from other files by `use`; what is missing there, and files that use each other,
/// are told.
#[test]
fn files_use_each_other_in_one_direction() {
    let main = "use \"parts/cloth.garment\"::{wool_check, side as_was}
        use \"parts/cloth.garment\"::side as edge
        use std::fabric::wool as plain_wool
        scene s { cloth a of wool_check { size: edge x edge }
                  cloth b of plain_wool { size: 10cm x 10cm } }";
    let main = main.replace(", side as_was", "");
    let cloth = "let side = 30cm\nfabric wool_check = wool with { friction: 0.5 }";
    let mut world = Memory::new([("main.garment", main.as_str()), ("parts/cloth.garment", cloth)]);
    let root = world.open("main.garment").unwrap();
    let (garments, told) = evaluate(&mut world, root, &Options::default());
    assert!(told.is_empty(), "{}", render::report(&told, &world, false, 100));
    assert_eq!(garments[0].fabrics.len(), 2);
    assert!((garments[0].fabrics[0].friction - 0.5).abs() < 1e-12);
    assert!((length(&garments[0].panels[0].edges[0].runs) - 0.3).abs() < 1e-12);

    let mut world = Memory::new([
        ("a.garment", "use \"b.garment\"::{y, nothing}\nlet x = 1cm"),
        ("b.garment", "use \"a.garment\"::x, \"c.garment\"\nlet y = x"),
    ]);
    let root = world.open("a.garment").unwrap();
    let (_, told) = evaluate(&mut world, root, &Options::default());
    let mut found = codes(&told);
    found.sort_unstable();
    assert_eq!(found, ["E0901", "E0902", "E0903"]);
}

/// Names of files that cannot be used are not told once more where they are needed.
#[test]
fn what_a_missing_file_would_have_brought_is_silent() {
    let text = "use \"gone.garment\"::collar
        use std::fabrik::denim as cloth
        use parts/hood.garment::{hood}
        use \"gone too.garment\"
        let a = collar + hood
        let b = something
        scene s { cloth c of cloth { size: 1m x 1m } }";
    let (_, _, told) = worked(text, &[]);
    assert_eq!(codes(&told), ["E0903", "E0903", "E0901", "E0903"]);
}

/// Every form of edge, holes, darts to a point, copies in a loop, traced edges.
#[test]
fn all_forms_of_outline_are_drawn() {
    let text = "garment g {
        wearer lady = female { size: EU 38 }
        panel forms of cotton {
            outline from (0, 0) {
                hem:   line to (30cm, 0)
                side:  line by 12cm @ 80deg
                hip:   curve to (30cm, 30cm) leaving smooth arriving 95deg
                waist: curve to (20cm, 31cm) hollow 8mm
                dip:   curve to (15cm, 31cm) measuring 52mm inward
                cap:   curve to (5cm, 31cm) controls (12cm, 36cm), (8cm, 36cm)
                neck:  curve to (0, 26cm) through (4cm, 28cm), (2cm, 27cm)
                scye:  arc around (0, 23cm) by -180deg
                fold:  line to start
            }
            eye: hole circle at (15cm, 15cm) radius 2cm
            hole from (5cm, 5cm) { a: line to (8cm, 5cm); b: line to (8cm, 8cm); c: line to start }
            notch on hem at 30%
            dart on side at 5cm from hem width 15mm to (22cm, 8cm)
            pair as left, right
        }
        panel tube of cotton {
            outline from (0, 0) { trace forms.(hem + side); x: line to (0, 20cm); y: line to start }
        }
        for i in 1..3 {
            panel gore[i] of cotton { rectangle 10cm x 20cm }
            seam gore[i].end -> gore[mod(i, 3) + 1].start
        }
        seam gore[1..3].top -> tube.hem
        place forms before lady.waist; place tube before lady.hip
        check forms.dip.length = 52mm within 1um
        check forms.scye.length = arc(3cm, 180deg) within 1um
        check forms.eye.length = arc(2cm, 360deg) within 1um
        check tube.side.length = 12cm within 1um
    }";
    let garment = sound(text, &[]).remove(0);
    assert_eq!(garment.panels.len(), 6);
    let [left, right] = [&garment.panels[0], &garment.panels[1]];
    assert_eq!((left.name.as_str(), right.name.as_str()), ("forms.left", "forms.right"));
    for (a, b) in left.edges.iter().zip(&right.edges) {
        assert!((length(&a.runs) - length(&b.runs)).abs() < 1e-12, "{}", a.name);
    }
    // The legs of the dart are equal although its tip lies to one side.
    for seam in garment.seams.iter().filter(|seam| seam.name.contains("dart")) {
        let [a, b] = [&seam.a, &seam.b].map(|runs| length(runs.iter().map(|run| &run.run)));
        assert!((a - b).abs() < 1e-12);
    }
    assert_eq!(left.notches.len(), 1);
    assert!((left.notches[0].inward[1] - 1.0).abs() < 1e-9, "the hem's notch points up");
}

/// A sleeve sewn into its armhole: the front of the cap comes to the front, on both sides.
#[test]
fn the_faces_of_the_cloth_direct_a_seam() {
    let text =
        fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/tunic.garment"))
            .unwrap();
    let garment = sound(&text, &[]).remove(0);
    let name = |panel: usize| garment.panels[panel].name.as_str();
    for side in ["left", "right"] {
        let seam = garment
            .seams
            .iter()
            .find(|seam| seam.name.contains(&format!("back.{side}.armhole")))
            .unwrap();
        let sleeve = format!("sleeve.{side}");
        assert_eq!([name(seam.a[0].panel), name(seam.a[1].panel)], ["back", "front"]);
        assert!(seam.b.iter().all(|run| name(run.panel) == sleeve));
        // Walked together, the cloth of one lies to the left and of the other to the right.
        let left = |run: &Run| run.to > run.from;
        assert!(seam.a.iter().all(|run| left(&run.run) != left(&seam.b[0].run)));
    }
    // The same cap with its halves exchanged would twist.
    let (world, _, told) = worked(&text.replace("pair as right, left", "pair as left, right"), &[]);
    assert_eq!(codes(&told), ["E0502"], "{}", render::report(&told, &world, false, 100));
}
