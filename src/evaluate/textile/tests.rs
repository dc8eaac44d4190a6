//! What the words of textiles, saris and bodies make.

use crate::evaluate::item::{ItemId, Made};
use crate::evaluate::{Evaluator, module};
use crate::garment::sari::{BandFill, Sari};
use crate::garment::scene::BodyRequest;
use crate::textile::Colour;
use crate::textile::fabric::{Fabric, Structure};
use crate::textile::knit::{Cable, Knit, Lean, Stitch, Symbol};
use crate::textile::motif::Motif;
use crate::textile::weave::Weave;
use crate::textile::yarn::Twist;
use crate::world::{Memory, World};

/// The last item of a text, made, and the codes of what was told.
fn made(text: &str) -> (Option<Made>, Vec<String>) {
    let mut world = Memory::new([("test.garment", text)]);
    let root = world.open("test.garment").unwrap();
    let (files, asked, mut told) = module::load(&mut world, root, &[]);
    let mut ev = Evaluator::new(&files, &asked, root, None);
    ev.file(&[]);
    let last = (0..ev.items.len())
        .map(ItemId)
        .filter(|id| ev.item(*id).span.file == root)
        .rfind(|id| !["ang", "lower kath", "upper kath", "padar"].contains(&&*ev.item(*id).name));
    let made = last.and_then(|id| {
        let span = ev.item(id).span;
        ev.make(id, span)
    });
    told.extend(std::mem::take(&mut ev.told));
    (made, told.into_iter().map(|told| told.code).collect())
}

/// The last item of a text that is sound.
fn sound(text: &str) -> Made {
    let (made, told) = made(text);
    assert!(told.is_empty(), "{told:?} in {text}");
    made.unwrap_or_else(|| panic!("nothing made of {text}"))
}

fn fabric(text: &str) -> Fabric {
    match sound(text) {
        Made::Fabric(fabric, _) => (*fabric).clone(),
        other => panic!("{other:?}"),
    }
}

fn weave(text: &str) -> Weave {
    match sound(&format!("weave w {{ {text} }}")) {
        Made::Weave(weave) => (*weave).clone(),
        other => panic!("{other:?}"),
    }
}

fn sari(text: &str) -> Sari {
    match sound(text) {
        Made::Sari(sari, _) => (*sari).clone(),
        other => panic!("{other:?}"),
    }
}

fn near(found: f64, wanted: f64) {
    assert!((found - wanted).abs() <= 1e-9 * wanted.abs(), "{found} is not {wanted}");
}

#[test]
fn a_yarn_has_si_units_and_the_defaults_of_the_language() {
    let Made::Yarn(yarn) = sound("yarn y { count: 30Ne   twist: 600turns/m S   fibre: wool }")
    else {
        panic!("a yarn")
    };
    // A pound in 840 yards is 590.54 tex.
    assert!((yarn.count * 1e6 - 590.541 / 30.0).abs() < 1e-3);
    near(yarn.twist, 600.0);
    assert_eq!((yarn.direction, yarn.plies), (Twist::S, 1));
    let Made::Yarn(same) = sound("yarn y { count: 20tex   twist: 600/m }") else {
        panic!("a yarn")
    };
    near(same.twist, 600.0);
    assert_eq!(same.direction, Twist::Z);
}

#[test]
fn weaves_are_made_of_weaves() {
    let damask = weave("turn: satin_8   profile: |#.|.#|");
    assert_eq!((damask.ends(), damask.picks(), damask.warp_share()), (16, 16, 0.5));
    let left = |pick| (0..8).filter(|&end| damask.warp_up(end, pick)).count();
    assert_eq!((left(0), left(8)), (1, 7), "the bottom row is woven first");
    let blocks = weave("legend { \"o\": plain   \"x\": basket }   profile: |xxo|");
    assert_eq!((blocks.ends(), blocks.picks()), (12, 4));
    let double = weave("upper: plain   lower: twill_2_2");
    assert_eq!((double.ends(), double.picks()), (8, 8));
    let (_, told) = made("weave w { matrix: |1011|0010|1110|1000| }");
    assert_eq!(told, ["W0603"], "two layers are no mistake only where they are asked for");
    assert_eq!(weave("upper: plain   lower: basket   stitch: 8").picks(), 16);
    let broad = format!("weave w {{ turn: satin_8   profile: |{}| }}", "#".repeat(600));
    assert_eq!(made(&broad).1, ["E0303"]);
    let brocade = weave("ground: plain   bind: 4   figure: |.####.|..##..|......|......|");
    // Four ground picks, and one more where the figure has a row.
    assert_eq!((brocade.ends(), brocade.picks()), (6, 6));
    let borders = weave("ground: twill_2_2   extra: warp   figure: |.#|#.|");
    assert_eq!((borders.ends(), borders.picks()), (8, 4));
    let turned = weave(
        "threading: 1..4, 1..4, 2, 1, 4, 3, 2, 1, 4, 3   tieup: [1, 2], [2, 3], [3, 4], [4, 1]   treadling: 1..4",
    );
    let backwards = weave("herringbone 2/2 S every 8");
    assert_eq!(turned.ends(), backwards.ends());
    assert_eq!(weave("herringbone 2/2 every 8").floats(), turned.floats());
    assert_eq!((weave("point 2/2").ends(), weave("point 2/2 every 9").ends()), (6, 16));
    assert_eq!(weave("broken 3/1").floats().warp_on_face, Some(3));
    assert_eq!(weave("honeycomb 8").floats().warp_on_face, Some(5));
}

#[test]
fn a_matrix_reads_as_it_hangs_and_a_draft_gives_the_same_cloth() {
    let matrix = weave("matrix: |1000|0100|0010|0001|");
    assert_eq!(matrix.rows[0], [false, false, false, true], "the bottom row is the first pick");
    let turned = weave("rows: downwards   matrix: |0001|0010|0100|1000|");
    assert_eq!(matrix.rows, turned.rows);
    let draft = weave("threading: 1..4   tieup: [4], [3], [2], [1]   treadling: 1..4");
    assert_eq!(draft.rows, matrix.rows);
    let plan = weave("threading: 4..1   liftplan: [1], [2], [3], [4]");
    assert_eq!(plan.rows, matrix.rows);
    assert_eq!(weave("twill 2/1/1/2 S move 1").ends(), 6);
    assert_eq!(weave("let n = 3; basket n").ends(), 6);
    assert_eq!(weave("satin 8 move 3").rows, Weave::satin(8, 3).unwrap().rows);
}

#[test]
fn a_sheet_of_measurements_becomes_si_units() {
    let kes = fabric(
        "fabric f { kes { B: 0.032gf.cm2/cm, 0.028gf.cm2/cm   G: 0.28gf/cm/deg   EM: 2.1%, 4.4% \
         LT: 1   MIU: 0.17   W: 6.5mg/cm2   T0: 0.16mm   2HB: 0.011gf.cm/cm   RT: 62% } }",
    );
    near(kes.bending[0], 0.032 * 9.80665e-5);
    near(kes.bending[1], 0.028 * 9.80665e-5);
    near(kes.shear, 0.28 * 0.980665 * 180.0 / std::f64::consts::PI);
    // A straight curve (LT = 1) reaches 500 gf/cm at EM.
    near(kes.tensile[0], 490.3325 / 0.021);
    near(kes.friction, 0.17);
    near(kes.mass, 0.065);
    near(kes.thickness, 0.16e-3);
    let fast = fabric("fabric f { fast { W: 200g/m2   C: 20mm   E20: 1%   EB5: 3% } }");
    // B = W g C³: 200 g/m² and 20 mm make 15.69 µN·m; E20 is the strain at 19.6 N/m.
    near(fast.bending[0], 0.2 * 9.80665 * 8e-6);
    near(fast.tensile[1], 1961.33);
    near(fast.shear, 41.0);
}

#[test]
fn what_a_fabric_does_not_say_follows_from_its_yarns_and_mass() {
    let yarn = "yarn y { count: 20tex   color: #112233 }\n";
    let woven =
        fabric(&format!("{yarn}fabric f {{ warp: y at 24/cm   weft: y at 20/cm color red }}"));
    near(woven.mass, woven.structure.mass());
    let Structure::Woven { weave, warp, weft } = &woven.structure else { panic!("woven") };
    assert_eq!(weave.rows, Weave::plain().rows);
    near(warp.spacing, 0.01 / 24.0);
    assert_ne!(warp.colour, weft.colour);
    // A cloth without yarns gets a cotton thread that makes up its mass.
    let bare = fabric("fabric f { mass: 150g/m2 }");
    assert!((bare.structure.mass() - 0.15).abs() < 1e-6);
    // The default is the measured cotton, scaled: a quarter of its mass has an eighth of its B.
    let light = fabric("fabric f { mass: 64.45g/m2 }");
    near(light.bending[0], 1.998595e-5 / 8.0);
    let knit = fabric(&format!("{yarn}fabric f {{ structure: rib   yarn: y }}"));
    assert!(matches!(knit.structure, Structure::Knitted { .. }));
}

#[test]
fn a_copy_replaces_what_it_says_anew() {
    let copy = fabric("fabric warm = wool with { mass: 300g/m2   friction: 0.5 }");
    near(copy.mass, 0.3);
    near(copy.friction, 0.5);
    near(copy.bending[0], 1.319975e-5);
}

#[test]
fn charts_are_read_from_the_bottom_and_by_their_longest_keys() {
    let Made::Knit(knit) = sound("knit k { chart: |..--|....|   gauge: 22 x 30 per 10cm }") else {
        panic!("a knit")
    };
    assert_eq!(knit.loops()[0], [Stitch::Face; 4]);
    assert_eq!(knit.loops()[1][2], Stitch::Back);
    near(knit.wales, 220.0);
    near(knit.courses, 300.0);
    let Made::Motif(motif) = sound(
        "motif m { legend { \"*\": #ff0000   \"**\": #00ff00   \" \": none }
         picture: |* **|.  *|   size: 4mm x 2mm }",
    ) else {
        panic!("a motif")
    };
    let shown: Vec<Vec<u8>> = motif
        .rows
        .iter()
        .map(|row| {
            row.iter()
                .map(|cell| cell.map_or(b'.', |c| if c.0[0] > 0 { b'r' } else { b'g' }))
                .collect()
        })
        .collect();
    assert_eq!(shown, [b"...r".to_vec(), b"r.gg".to_vec()]);
}

#[test]
fn a_sari_has_one_of_six_layouts() {
    let parts = [
        "ang { ground: red }",
        "kath lower { width: 5cm }",
        "kath upper { width: 4cm }",
        "padar { length: 70cm }",
    ];
    for choice in 0..16_u32 {
        let said: Vec<&str> =
            (0..4).filter(|bit| choice >> bit & 1 == 1).map(|bit| parts[bit as usize]).collect();
        let text = format!(
            "fabric c {{ mass: 70g/m2 }}\nsari s of c {{ size: 5.5m x 1.1m; {} }}",
            said.join("; ")
        );
        let (ang, lower, upper) = (choice & 1 > 0, choice & 2 > 0, choice & 4 > 0);
        let (made, told) = made(&text);
        if ang && (lower || !upper) {
            assert!(told.is_empty() && made.is_some(), "{told:?} in {text}");
        } else {
            assert_eq!(told, ["E0701"], "{text}");
        }
    }
}

#[test]
fn a_sari_takes_its_parts_from_anywhere_and_divides_its_length_evenly() {
    let made = sari(
        "fabric c { warp: organzine at 44/cm color #3b1742   weft: tram at 40/cm color #7a1f3d   mass: 75g/m2 }
         kath mine { width: 10cm   ground: gold; repeat peacock every 18cm in red }
         sari s of c {
             size: 5.5m x 1.15m
             ang { spot buti every 9cm x 9cm half_drop thinning 100% -> 25% from padar }
             kath lower = mine
             kath upper = mine with { width: 9cm }
             padar = lotus_end
         }",
    );
    assert_eq!(made.ang.ground.0[..3], [0x3b, 0x17, 0x42], "the ground is the warp's colour");
    assert_eq!(made.ang.shot.map(|colour| colour.0[0]), Some(0x7a));
    assert_eq!(made.ang.spots[0].thinning, [1.0, 0.25]);
    let (lower, width) = made.lower_kath.clone().unwrap();
    near(width, 0.1);
    near(made.upper_kath.as_ref().unwrap().1, 0.09);
    // 5.5 m / 18 cm = 30.6: 31 peacocks of 17.74 cm.
    near(lower.repeats[0].pitch, 5.5 / 31.0);
    let (padar, length) = made.padar.unwrap();
    near(padar.bands.iter().map(|band| band.length).sum(), length);
    assert!(
        padar
            .bands
            .iter()
            .any(|band| matches!(&band.fill, BandFill::Motif(m) if m.name == "parrot"))
    );
}

fn wearer(inside: &str) -> BodyRequest {
    let text = format!("garment g {{ wearer lady = {inside} }}");
    match made(&text).0 {
        Some(Made::Wearer(request)) => (*request).clone(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_wearer_has_every_measure_of_her_size_and_her_own() {
    let usual = wearer("female");
    near(usual.measures["bust"], 0.88);
    near(usual.measures["waist_to_floor"], 1.05);
    let other = wearer("female { size: EU 42   hip: 111cm }");
    near(other.measures["bust"], 0.96);
    near(other.measures["hip"], 1.11);
    assert_eq!(usual.measures.len(), other.measures.len());
    let man = wearer("male { size: \"EU 50\" }");
    for (name, length) in [
        ("chest", 1.0),
        ("waist", 0.88),
        ("hip", 1.03),
        ("neck", 0.4),
        ("shoulder", 0.155),
        ("armhole_depth", 0.24),
        ("upper_arm", 0.31),
        ("arm_length", 0.65),
        ("wrist", 0.175),
        ("body_rise", 0.27),
        ("inseam", 0.82),
    ] {
        near(man.measures[name], length);
    }
}

fn knit(inside: &str) -> Knit {
    match sound(&format!("knit k {{ {inside}; gauge: 22 x 30 per 10cm }}")) {
        Made::Knit(knit) => (*knit).clone(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_legend_says_symbols_and_colours() {
    let text = "legend { \"<<<\": cable 2/1 left purl; \"m\": m1r red; \"x\": crimson }; \
                chart: |<<<.xV|mo/./.|......|";
    let knit = knit(text);
    let cable = Cable { front: 2, behind: 1, lean: Lean::Left, purl: true };
    assert_eq!(knit.chart.placed(2)[0], (Symbol::Cable(cable), 0, 3));
    let words: Vec<String> = knit.chart.rows()[1].iter().map(|it| it.word()).collect();
    assert_eq!(words, ["m1r", "yo", "k2tog", "knit", "k2tog", "knit"]);
    assert!(knit.chart.colour(0, 1).is_some() && knit.chart.colour(1, 1).is_none());
    assert_eq!(knit.chart.colour(4, 2), Some(Colour([156, 22, 49, 255])));
    assert!(!knit.chart.round);
}

#[test]
fn knits_are_said_in_words_or_shown_from_behind() {
    let knit_of = knit("written: |round 1: *k2, p1*|round 2: k|; stitches: 6; worked: round");
    let words: Vec<String> = knit_of.chart.rows()[0].iter().map(|it| it.word()).collect();
    assert_eq!(words, ["purl", "knit", "knit", "purl", "knit", "knit"]);
    assert!(knit_of.chart.round);
    let behind = knit("chart: |.\\o-|; face: back");
    let words: Vec<String> = behind.chart.rows()[0].iter().map(|it| it.word()).collect();
    assert_eq!(words, ["knit", "yo", "p2tog", "purl"]);
}

#[test]
fn what_is_wrong_with_a_knit_is_told() {
    for (text, wanted) in [
        ("chart: |.o..|....|", "E0603"),
        ("legend { \"<\": cable 2/2 left }; chart: |<<<.|", "E0603"),
        ("legend { \"x\": cable 2/99 left }; chart: |x|", "E0303"),
        ("legend { \"x\": cable 2 left }; chart: |x|", "E0602"),
        ("legend { \"x\": k2tgo }; chart: |x|", "E0602"),
        ("written: |row 1: k2, q|", "E0607"),
        ("written: |row 1: *k2*|", "E0208"),
        ("written: |row 1: k2|row 2: k3|", "E0603"),
        ("chart: |.|; written: |row 1: k|", "E0209"),
        ("chart: |.|; stitches: 4", "E0207"),
        ("chart: |.B|; face: back", "E0207"),
        ("legend { \"x\": red }; chart: |x.......|", "W0607"),
        ("face: front", "E0208"),
    ] {
        let text = format!("knit k {{ {text}; gauge: 22 x 30 per 10cm }}");
        assert_eq!(made(&text).1, [wanted], "{text}");
    }
    let own = "legend { \"x\": red }; chart: |x.......|; colors: intarsia";
    assert_eq!(knit(own).chart.patches(), 2);
    let fine = "knit k { legend { \"x\": red }; chart: |x.......|; gauge: 140 x 200 per 10cm }";
    assert_eq!(made(fine).1, [""; 0], "five millimetres are no long float");
}

fn motif(text: &str) -> Motif {
    match sound(text) {
        Made::Motif(motif) => (*motif).clone(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn motifs_are_drawn_by_paths_on_the_threads_of_a_cloth() {
    let path =
        "path \"M0 0 H10 V10 H0 Z M2 2 H8 V8 H2 Z\" gold evenodd; path \"M4 4 H6 V6 H4 Z\" red";
    let ring =
        motif(&format!("motif m {{ {path}; frame: 10 x 10; threads: 10 x 10; size: 1cm x 1cm }}"));
    let woven = ring.rows.iter().flatten().filter(|cell| cell.is_some()).count();
    assert_eq!(woven, 100 - 36 + 4);
    assert_ne!(ring.rows[0][0], ring.rows[4][4]);
    let cloth = "yarn y { count: 20tex }\nfabric f { warp: y at 20/cm   weft: y at 15/cm }\n";
    let fine = motif(&format!("{cloth}motif m {{ {path}; on: f; size: 1cm x 1cm }}"));
    assert_eq!((fine.width(), fine.height()), (20, 15));
}

#[test]
fn motifs_are_made_of_others_and_knitted() {
    let leaf = "motif leaf { legend { \"x\": red }; picture: |x.|xx|; size: 2mm x 2mm }\n";
    let field = motif(&format!("{leaf}motif m {{ of: leaf; repeat: half_drop; times: 3 x 2 }}"));
    assert_eq!((field.width(), field.height(), field.name.as_str()), (6, 4, "m"));
    near(field.size[0], 6e-3);
    let frame = motif(&format!("{leaf}motif m {{ border: leaf; times: 3 x 2 }}"));
    assert_eq!((frame.width(), frame.height()), (10, 8));
    let text = format!("{leaf}knit k {{ motif: leaf; gauge: 22 x 30 per 10cm }}");
    let Made::Knit(knit) = sound(&text) else { panic!("a knit") };
    assert_eq!(knit.chart.palette().len(), 2);
}

#[test]
fn what_is_wrong_with_a_motif_is_told() {
    let leaf = "motif leaf { legend { \"x\": red }; picture: |x.|; size: 2mm x 1mm }\n";
    for (text, wanted) in [
        ("path \"M0 0 H5\" gold; threads: 5 x 5; size: 5mm x 5mm", "E0608"),
        ("path \"M0 0 H5 V5 Z\" gold; threads: 5 x 5; size: 5mm x 5mm; of: leaf", "E0209"),
        ("path \"M0 0 H5 V5 Z\" gold; size: 5mm x 5mm", "E0208"),
        ("path \"M0 0 H1e8 V5 Z\" gold; frame: 5 x 5; threads: 5 x 5; size: 5mm x 5mm", "E0608"),
        ("image \"none.png\"; colors: red; threads: 5 x 5; size: 5mm x 5mm", "E0903"),
        ("of: leaf; size: 5mm x 5mm", "E0207"),
        ("of: leaf; times: 4000 x 2", "E0601"),
        ("border: m", "E0206"),
        ("times: 2 x 2", "E0208"),
    ] {
        let text = format!("{leaf}motif m {{ {text} }}");
        let told = made(&text).1;
        assert_eq!(told.first().map(String::as_str), Some(wanted), "{text}: {told:?}");
    }
}
