//! The library's blocks: each drafts itself to the smallest and the largest body, and what is sewn
//! to it fits.

use super::garments::codes;
use darzi::diagnostic::render;
use darzi::evaluate::{Options, evaluate};
use darzi::syntax::parse;
use darzi::syntax::tree::StatementKind;
use darzi::world::{Memory, World, library};
use std::collections::BTreeSet;

/// A garment of parts, whose wearer is `{wearer}`: lines of its block.
const WOMEN: &[&str] = &[
    "part a = straight_skirt",
    "part a = a_line_skirt { spread: 14deg }",
    "part a = circle_skirt",
    "part a = circle_skirt { sweep: three_quarters }
     part b = waistband { around: a.inner.length   overlap: 3cm }
     seam a.inner -> b.lower",
    "part a = circle_skirt { sweep: half }",
    "part a = gored_skirt { gores: 7 }",
    "part a = fitted_bodice
     part b = set_in_sleeve { armhole: a.scye.length }
     seam a.scye -> b.cap ease 1cm",
    "part a = loose_body { girth: w.bust }
     part b = set_in_sleeve { armhole: a.scye.length   ease: 0cm   biceps: w.upper_arm + 12cm }
     seam a.scye -> b.cap",
    "part a = choli_body
     part b = set_in_sleeve { armhole: a.scye.length   ease: 15mm   biceps: w.upper_arm + 5cm   reach: 20cm }
     seam a.scye -> b.cap ease 15mm",
    "part a = petticoat_body { gores: 4 }",
    "part a = salwar_body
     part b = waistband { around: w.waist + 2cm   closing: sewn }
     seam b.lower -> a.waistline gathered 3",
    "panel cape { ring inner 7cm outer 60cm sweep 300deg }
     part a = band_collar { around: cape.inner.length }
     seam cape.inner -> a.neck
     place cape around w.neck",
];

const MEN: &[&str] = &[
    "part a = shirt_body { girth: w.chest }
     part b = set_in_sleeve { armhole: a.scye.length   biceps: w.upper_arm + 14cm }
     part c = cuff { around: b.hem.length }
     part d = collar_with_stand { around: a.neck_ring.length }
     seam a.scye -> b.cap ease 15mm
     seam b.hem -> c.top
     seam a.neck_ring -> d.neck",
    "part a = straight_trousers
     part b = waistband { around: a.ring.length }
     seam a.ring -> b.lower",
    "part a = kurta_body",
    "part a = loose_body { girth: w.chest }
     part b = straight_sleeve { armhole: a.scye.length }
     seam a.scye -> b.top",
];

#[test]
fn every_block_fits_the_smallest_and_the_largest() {
    for (body, texts, sizes) in
        [("female", WOMEN, ["EU 34", "EU 46"]), ("male", MEN, ["EU 44", "EU 56"])]
    {
        for lines in texts {
            let text = format!("garment g {{ fabric: cotton; wearer w = {body}\n{lines}\n}}");
            let mut world = Memory::new([("main.garment", text)]);
            let root = world.open("main.garment").unwrap();
            for size in sizes {
                let options = Options { size: Some(size.to_owned()), ..Options::default() };
                let (garments, told) = evaluate(&mut world, root, &options);
                let report = render::report(&told, &world, false, 100);
                assert!(told.is_empty(), "{size}, {lines}\n{report}");
                assert_eq!(garments.len(), 1);
            }
        }
    }
}

#[test]
fn every_block_is_tried() {
    let tried = [WOMEN, MEN].concat().join("\n");
    let mut blocks = BTreeSet::new();
    for name in library::names() {
        let mut world = Memory::default();
        let file = world.open(name).unwrap();
        for statement in &parse(file, library::text(name).unwrap()).0.statements {
            if let StatementKind::Line { word, phrase, .. } = &statement.kind
                && word.text == "block"
            {
                let span = phrase[0].span();
                let text = library::text(name).unwrap();
                blocks.insert(&text[span.start as usize..span.end as usize]);
            }
        }
    }
    assert!(blocks.len() >= 17, "{blocks:?}");
    for block in blocks {
        assert!(tried.contains(&format!("= {block}")), "{block} is not tried");
    }
}

/// A mistake in the library's text is told at the part that brings it about.
#[test]
fn the_library_is_not_blamed() {
    let text = "garment g {
        fabric: cotton
        wearer w = female
        part a = gored_skirt { foot: 100cm }
        part b = fitted_bodice { drop: 40cm }
    }";
    let mut world = Memory::new([("main.garment", text)]);
    let root = world.open("main.garment").unwrap();
    let (_, told) = evaluate(&mut world, root, &Options::default());
    assert_eq!(codes(&told), ["E0807", "E0303"]);
    for told in told {
        assert_eq!(told.labels[0].span.file, root, "{}", told.message);
    }
}
