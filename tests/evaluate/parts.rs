//! Blocks and parts, choices among options, requirements, texts with names in them.

use super::garments::{codes as told_codes, length, sound, worked};
use darzi::evaluate::{Options, evaluate};
use darzi::world::{Memory, World};

const CUFF: &str = "
    block cuff {
        param around: length
        param depth = 6cm in 2cm..12cm
        panel band { rectangle around x depth; pair as left, right }
        seam band.start -> band.end
    }";

/// A part brings its panels and seams along, under its own name; two parts of one block share
/// nothing; parts stand in loops and in blocks.
#[test]
fn parts_are_copies_of_a_block() {
    let text = format!(
        "{CUFF}
        block pair_of_cuffs {{
            param around = 20cm
            part upper = cuff {{ around: around }}
            part lower = cuff {{ around: around + 2cm   depth: 3cm }}
            seam upper.bottom -> lower.top ease 2cm
        }}
        garment g {{
            wearer lady = female {{ size: EU 38 }}
            panel sleeve of poplin {{ rectangle 26cm x 40cm; pair as left, right }}
            seam sleeve.start -> sleeve.end
            part cuffs = cuff {{ around: sleeve.bottom.length }}
            seam sleeve.bottom -> cuffs.top
            part both = pair_of_cuffs
            for i in 1..2 {{
                part more[i] = cuff of denim {{ around: 20cm + i * 5cm }}
                place more[i].band around lady.wrist
            }}
            place sleeve around lady.arm level lady.shoulder
            place both.upper.band around lady.wrist
            check more[2].top.length = 30cm
            check both.lower.depth = 3cm
            check more[1..2].bottom.length = 55cm
        }}"
    );
    let garment = sound(&text, &[]).remove(0);
    let names: Vec<&str> = garment.panels.iter().map(|panel| panel.name.as_str()).collect();
    assert_eq!(
        names,
        [
            "sleeve.left",
            "sleeve.right",
            "cuffs.band.left",
            "cuffs.band.right",
            "both.upper.band.left",
            "both.upper.band.right",
            "both.lower.band.left",
            "both.lower.band.right",
            "more[1].band.left",
            "more[1].band.right",
            "more[2].band.left",
            "more[2].band.right",
        ]
    );
    // Parts are cut from the cloth of the first panel unless they name one.
    let fabric = |panel: usize| garment.fabrics[garment.panels[panel].fabric].name.as_str();
    assert_eq!(
        (fabric(0), fabric(2), fabric(4), fabric(8)),
        ("poplin", "poplin", "poplin", "denim")
    );
    let top = |panel: usize| {
        let edges = &garment.panels[panel].edges;
        length(&edges.iter().find(|edge| edge.name == "top").unwrap().runs)
    };
    assert!((top(2) - 0.26).abs() < 1e-12);
    assert!((top(10) - 0.30).abs() < 1e-12);
    assert_eq!(garment.seams.len(), 2 * (1 + 1 + 5 + 1));
}

/// The wearer of a block is the garment's, whatever it is called there; what the garment does
/// not say, the block's own wearer says.
#[test]
fn a_part_sees_the_wearer_of_its_garment() {
    let text = |wearer: &str| {
        format!(
            "block belt {{
                wearer someone = female {{ size: EU 46 }}
                let girth = someone.waist
                panel band {{ rectangle girth x 4cm }}
                seam band.start -> band.end
                place band around someone.waist
            }}
            garment g {{
                fabric: denim
                {wearer}
                part belt_of_hers = belt
            }}"
        )
    };
    let girth = |wearer: &str| {
        let garment = sound(&text(wearer), &[]).remove(0);
        assert_eq!(garment.bodies.len(), 1);
        length(&garment.panels[0].edges[0].runs)
    };
    assert!((girth("wearer lady = female { size: EU 38 }") - 0.72).abs() < 1e-12);
    assert!((girth("") - 0.88).abs() < 1e-12);
}

/// What a garment says of where a panel of a part stands goes before what the block says: it
/// names the halves.
#[test]
fn halves_of_a_part_are_named_by_its_place() {
    let text = |place: &str| {
        format!(
            "block back {{
                wearer w = female
                panel body {{
                    outline from (0, 0) {{
                        waist: line to (20cm, 1cm)
                        side: line to (22cm, -30cm)
                        hem: line to (0, -30cm)
                        fold: line to start
                    }}
                    unfold across fold
                }}
                place body behind w.waist
            }}
            garment g {{
                fabric: cotton
                wearer lady = female {{ size: EU 38 }}
                part p = back
                panel tag {{ rectangle 31cm x 2cm }}
                seam p.left.side -> tag.top ease 1cm
                {place}
            }}"
        )
    };
    let x = |place: &str| {
        let garment = sound(&text(place), &[]).remove(0);
        let panel = garment.panels.iter().find(|panel| panel.name == "p.body").unwrap();
        let edge = panel.edges.iter().find(|edge| edge.name == "left.side").unwrap();
        let path = &panel.loops[0].pieces[edge.runs[0].piece].path;
        path.elements()[0].end_point().unwrap().x
    };
    assert!(x("") < 0.0, "behind the body the half at x < 0 is the left one");
    let (_, _, told) = worked(&text("place p.body before lady.waist"), &[]);
    assert_eq!(told_codes(&told), ["E0209"], "it cannot stand in two places");
}

/// `--set` reaches the parameters of the file and its garments, not those of blocks.
#[test]
fn parameters_of_blocks_are_set_by_parts_alone() {
    let text = format!(
        "{CUFF}
        garment g {{
            fabric: cotton
            wearer lady = female {{ size: EU 38 }}
            param depth_of_cuffs = 5cm
            part c = cuff {{ around: 20cm   depth: depth_of_cuffs }}
            place c.band around lady.wrist
        }}"
    );
    let (_, _, told) = worked(&text, &[("depth", "3cm")]);
    assert_eq!(told_codes(&told), ["E0204"]);
    let garment = sound(&text, &[("depth_of_cuffs", "3cm")]).remove(0);
    let end = garment.panels[0].edges.iter().find(|edge| edge.name == "end").unwrap();
    assert!((length(&end.runs) - 0.03).abs() < 1e-12);
}

/// Parts of parts end, however many there are.
#[test]
fn parts_of_parts_end() {
    let doubling: String = "block b0 { panel p { rectangle 1cm x 1cm } }\n".to_owned()
        + &(1..40)
            .map(|i| format!("block b{i} {{ part x = b{0}; part y = b{0} }}\n", i - 1))
            .collect::<String>();
    let deep = format!("{doubling} garment g {{ fabric: cotton; part a = b39 }}");
    let wide = format!("{doubling} garment g {{ fabric: cotton; part a = b13 }}");
    let ring = "block a { part x = b }\nblock b { part x = c }\nblock c { part x = a }
        garment g { part p = a }";
    let through =
        "block a { param w = 1cm; let v = x.v; part x = a { w: v } }\ngarment g { part p = a }";
    for (text, code) in
        [(deep.as_str(), "E0211"), (&wide, "E0210"), (ring, "E0206"), (through, "E0206")]
    {
        let (_, _, told) = worked(text, &[]);
        assert!(told_codes(&told).contains(&code), "{:?}", told_codes(&told));
        assert!(told.len() < 60, "{} messages", told.len());
    }
}

/// The cases of a `match` and comparisons with an option.
#[test]
fn options_choose() {
    let text = "
        param kind = box in [knife, box]
        param other = kind in [knife, box, inverted]
        let times = match(kind, knife: 2, box: 4)
        let even = if kind == knife then 1 else 3
        let odd = if other != box then 1 else 3
        let list = [1cm, 2cm, 3cm]
        let note = \"{kind} {times} {{}}\"
        scene s {
            match kind {
                knife: { cloth a of cotton { size: 10cm x 10cm } }
                otherwise: { cloth b of cotton { size: 20cm x (times * 10cm) } }
            }
            check even = 3
            check odd = 3
            check list.count = 3
            check list[list.count] = 3cm
        }
        require note == \"box 4 {{}}\"";
    let garments = sound(text, &[]);
    assert_eq!(garments[0].panels[0].name, "b");
    let (_, garments, told) = worked(text, &[("kind", "knife")]);
    assert!(garments.is_empty());
    assert_eq!(told_codes(&told), ["E0806", "E0806", "E0807"]);
}

/// Names that begin with `_` stay in their file.
#[test]
fn names_may_be_kept_in_their_file() {
    let mut world = Memory::new([
        ("a.garment", "use \"b.garment\"::{side, _half}\nlet x = side"),
        ("b.garment", "let side = _half * 2\nlet _half = 3cm"),
    ]);
    let root = world.open("a.garment").unwrap();
    let (_, told) = evaluate(&mut world, root, &Options::default());
    assert_eq!(told_codes(&told), ["E0901"]);
    assert!(told[0].message.contains("keeps"));
}

/// A warning that a file allows is not told.
#[test]
fn warnings_may_be_allowed() {
    let text = "weave long { satin 12 move 5 }\nyarn thin { count: 40Ne }
        fabric loose { structure: long  warp: thin at 10/cm  weft: thin at 10/cm }";
    let (_, _, told) = worked(text, &[]);
    assert_eq!(told_codes(&told), ["W0601", "W0601"]);
    sound(&format!("allow W0601\n{text}"), &[]);
}
