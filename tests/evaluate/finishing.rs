//! What is laid, drawn and tied when the pieces are sewn: bands over several panels, plackets, folds
//! sewn shut, elastics, drawstrings, ties.

use crate::garments::{sound, told};
use darzi::garment::Garment;
use darzi::garment::panel::BandKind;
use darzi::garment::scene::Phase;
use darzi::garment::seam::CordKind;
use darzi::mesh::{Options, compile, compiled::Compiled};

/// Two fronts and an unfolded back.
fn text(panel: &str, more: &str) -> String {
    format!(
        "garment g {{ wearer l = female {{ size: EU 38 }}
         fabric: cotton; grid: 1cm
         panel front {{
             outline from (0, 0) {{
                 top: line to (26cm, 0); side: line to (26cm, -60cm)
                 hem: line to (0, -60cm); edge: line to start }}
             pair as left, right; {panel} }}
         panel back {{
             outline from (0, 0) {{
                 top: line to (26cm, 0); side: line to (26cm, -60cm)
                 hem: line to (0, -60cm); fold: line to start }}
             unfold across fold }}
         seam front.side -> back.side
         place front before l.waist; place back behind l.waist
         {more} }}"
    )
}

fn garment(panel: &str, more: &str) -> Garment {
    sound(&text(panel, more), &[]).remove(0)
}

fn compiled(garment: &Garment) -> Compiled {
    compile(garment, &Options { atlas: false, ..Options::default() }).expect("compiles")
}

/// Allowances of the edges of a name, mm, and the widths of the bands of all panels, mm.
fn allowances(garment: &Garment, name: &str) -> Vec<i64> {
    let edges = garment.panels.iter().flat_map(|panel| &panel.edges);
    let named = edges.filter(|edge| edge.name.ends_with(name));
    named.map(|edge| (edge.allowance * 1e3).round() as i64).collect()
}

#[test]
fn a_hem_of_a_garment_runs_over_several_panels() {
    let hemmed = garment("", "hem on front.hem, back.hem depth 2cm double");
    assert_eq!(allowances(&hemmed, "hem"), [40, 40, 40]);
    let bands: Vec<_> = hemmed.panels.iter().map(|panel| panel.bands.len()).collect();
    assert_eq!(bands, [1, 1, 1]);
    assert!(hemmed.panels.iter().flat_map(|panel| &panel.bands).all(|band| band.plies == 2));
    // The same as said in each panel, and what a panel says of its own edge goes first.
    let each = garment("hem on hem depth 2cm double", "hem on back.hem depth 2cm double");
    assert_eq!(allowances(&each, "hem"), [40, 40, 40]);
    let own = garment("leave 3cm on hem", "hem on front.hem, back.hem depth 2cm");
    assert_eq!(allowances(&own, "hem"), [30, 30, 20]);
    // A facing goes along parts too and adds nothing to the edge.
    let faced = garment("", "facing on front.left.edge[0cm..20cm], back.top width 5cm of poplin");
    assert_eq!(allowances(&faced, "edge"), [10, 10]);
    let bands: Vec<_> = faced.panels.iter().map(|panel| panel.bands.len()).collect();
    assert_eq!(bands, [1, 0, 1]);
    let length: f64 = faced.panels[0].bands[0].runs.iter().map(|run| run.length()).sum();
    assert!((length - 0.2).abs() < 1e-9);
    for (more, code) in [
        ("hem on front.hem[0cm..9cm] depth 2cm", "E0304"),
        ("hem on front depth 2cm", "E0304"),
        ("hem on front.hem depth 2m", "E0303"),
        ("facing on front.rim width 2cm", "E0204"),
    ] {
        assert_eq!(told(&text("", more)), [code], "{more}");
    }
}

#[test]
fn closures_lie_in_the_middle_of_a_placket() {
    let more = "placket on front.edge width 3cm
                button front.left.edge over front.right.edge count 5 every 9cm";
    let shut = garment("", more);
    let band = &shut.panels[0].bands[0];
    assert_eq!((band.kind, band.plies), (BandKind::Placket, 2));
    // Cut on and turned in twice.
    assert_eq!(allowances(&shut, "edge"), [60, 60]);
    for [(_, a), (_, b)] in &shut.stitches[0].pairs {
        assert!((a[0].abs() - 0.015).abs() < 1e-9 && (b[0].abs() - 0.015).abs() < 1e-9);
    }
    let button = "button front.left.edge over front.right.edge count 5 every 9cm";
    let wide = garment("placket on edge width 5cm", button);
    let [(_, a), _] = wide.stitches[0].pairs[0];
    assert!((a[0].abs() - 0.025).abs() < 1e-9);
    // Sewn on of another fabric; and `inset` has the last word.
    let sewn = garment("", &format!("{} inset 4mm", more.replace("3cm", "3cm of poplin")));
    assert_eq!(allowances(&sewn, "edge"), [10, 10]);
    let [(_, a), _] = sewn.stitches[0].pairs[0];
    assert!((a[0].abs() - 0.004).abs() < 1e-9);
}

#[test]
fn a_stitched_fold_is_sewn_to_its_mirror_image_about_the_crease() {
    let one = |line: &str| {
        let text = format!(
            "garment g {{ wearer l = female {{ size: EU 38 }}
             panel p of cotton {{ grid: 1cm; rectangle 60cm x 40cm; {line} }}
             place p before l.waist }}"
        );
        let garment = sound(&text, &[]).remove(0);
        let compiled = compiled(&garment);
        (garment, compiled)
    };
    for (line, count, face_on_face, width) in [
        ("pleat on top from 10cm to 50cm count 4 depth 3cm stitched 12cm", 4, true, 3e-2),
        ("pleat on top count 2 depth 4cm kind box stitched 12cm", 4, true, 2e-2),
        ("tuck on top at 50% depth 2cm stitched 12cm", 1, false, 2e-2),
    ] {
        let (garment, compiled) = one(line);
        assert_eq!(compiled.shut.len(), count, "{line}");
        for (fold, crease) in
            compiled.shut.iter().zip(garment.panels[0].creases.iter().filter(|c| c.shut.is_some()))
        {
            assert_eq!(fold.face_on_face, face_on_face);
            // Some 12 of them, one a cell; each lies as far from the crease as what it is sewn to.
            assert!((9..=26).contains(&fold.stitches.len()), "{line}: {}", fold.stitches.len());
            for stitch in &fold.stitches {
                let place = compiled.particles[stitch.particle as usize];
                let mut image = [0.0; 2];
                for (corner, weight) in stitch.corners.iter().zip(stitch.weights) {
                    for (k, x) in image.iter_mut().enumerate() {
                        *x += weight * compiled.particles[*corner as usize][k];
                    }
                }
                assert!((place[0] + image[0] - 2.0 * crease.from[0]).abs() < 1e-9, "{line}");
                assert!((place[1] - image[1]).abs() < 1e-9);
                assert!((0.279..=0.401).contains(&place[1]), "{line}: {place:?}");
                assert!(((place[0] - crease.from[0]).abs() - width).abs() < 5.1e-3, "{line}");
            }
        }
    }
    assert!(one("tuck on top at 50% depth 2cm").1.shut.is_empty());
    // Unpressed but sewn; and no farther than the cloth goes.
    assert_eq!(one("tuck on top at 50% depth 2cm pressed 0cm stitched 5cm").1.shut.len(), 1);
    let far = text("tuck on top at 50% depth 2cm stitched 80cm", "");
    assert_eq!(told(&far), ["E0411"]);
}

#[test]
fn cords_share_their_length_out_over_their_edges() {
    let more = "elastic in front.top, back.top to 80cm width 25mm
                drawstring through front.left.hem to 20cm";
    let drawn = garment("", more);
    let [elastic, string] = &drawn.cords[..] else { panic!("{:?}", drawn.cords) };
    assert_eq!((elastic.kind, string.kind), (CordKind::Elastic, CordKind::Drawstring));
    let compiled = compiled(&drawn);
    for (cord, wanted, edges) in [(0, 0.8, 1.04), (1, 0.2, 0.26)] {
        let cord = &compiled.cords[cord];
        let rest: f64 = cord.rests.iter().sum();
        assert!((rest - wanted).abs() < 1e-9);
        for (pair, rest) in cord.pairs.iter().zip(&cord.rests) {
            let [a, b] = pair.map(|k| compiled.particles[k as usize]);
            let flat = (a[0] - b[0]).hypot(a[1] - b[1]);
            assert!((rest / flat - wanted / edges).abs() < 1e-9);
        }
    }
    for (more, code) in [
        ("elastic in front.top to 60cm", "E0303"),
        ("drawstring through back.top to 4cm", "E0303"),
        ("elastic in back.top to 40cm width 1m", "E0303"),
        ("elastic in back to 40cm", "E0304"),
        ("drawstring through back.top to 4", "E0302"),
    ] {
        assert_eq!(told(&text("", more)), [code], "{more}");
    }
}

#[test]
fn a_tie_is_closed_when_all_is() {
    let tied = garment("", "tie front.left.edge.start to front.right.edge.start length 12cm");
    let closes = |garment: &Garment| {
        garment.schedule.iter().any(|phase| matches!(phase, Phase::Close { .. }))
    };
    assert!(closes(&tied));
    let compiled = compiled(&tied);
    assert_eq!(compiled.ties.len(), 1);
    assert_eq!(compiled.ties[0].rests, [0.12]);
    // Without a length the places lie on each other, as under a button.
    let knotted = garment("", "tie front.left.edge.start to front.right.edge.start");
    assert!(closes(&knotted) && knotted.ties.is_empty());
    assert!(knotted.stitches[0].closure);
    for (more, code) in [
        ("tie front.left.edge.start to front.left.edge.start", "E0207"),
        ("tie front.left.edge to front.right.edge", "E0304"),
        ("tie front.left.edge.start to front.right.edge.start length 9m", "E0303"),
    ] {
        assert_eq!(told(&text("", more)), [code], "{more}");
    }
}
