//! From text to garment: what the examples are worked out to, and what is said of mistakes.

use darzi::diagnostic::{Diagnostic, render};
use darzi::evaluate::{Options, evaluate};
use darzi::garment::Garment;
use darzi::garment::panel::Run;
use darzi::world::{Memory, World};
use std::fmt::Write;
use std::fs;
use std::path::Path;

fn worked(text: &str, set: &[(&str, &str)]) -> (Memory, Vec<Garment>, Vec<Diagnostic>) {
    let mut world = Memory::new([("main.garment", text)]);
    let root = world.open("main.garment").unwrap();
    let set = set.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned())).collect();
    let (garments, told) = evaluate(&mut world, root, &Options { set, names: Vec::new() });
    (world, garments, told)
}

fn sound(text: &str, set: &[(&str, &str)]) -> Vec<Garment> {
    let (world, garments, told) = worked(text, set);
    assert!(told.is_empty(), "{}", render::report(&told, &world, false, 100));
    garments
}

fn length<'a>(runs: impl IntoIterator<Item = &'a Run>) -> f64 {
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
        insta::assert_snapshot!(summary(&sound(&text, &[])));
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
    insta::glob!("data/mistakes/*.garment", |path| {
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
    });
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
        (("side", "30cm)"), "E0212"),
    ] {
        let (_, garments, told) = worked(text, &[set]);
        assert_eq!(told.iter().map(|t| t.code.as_str()).collect::<Vec<_>>(), [code], "{set:?}");
        assert!(garments.is_empty() || code == "E0204" || code == "E0212");
    }
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
    ];
    for (text, code) in cases {
        let (_, _, told) = worked(text, &[]);
        let codes: Vec<&str> = told.iter().map(|told| told.code.as_str()).collect();
        assert!(codes.contains(&code), "{codes:?} for {}", &text[..60.min(text.len())]);
        assert!(told.len() < 50, "{} messages", told.len());
    }
}
