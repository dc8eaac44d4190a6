use super::*;
use crate::diagnostic::FileId;
use crate::textile::Colour;
use crate::textile::draft::{Shedding, Threads};
use proptest::prelude::*;

/// A file with its sections filled as a sound one has them; those given replace them.
fn file(sections: &[(&str, &str)]) -> String {
    let mut all = vec![
        ("WIF", "Version=1.1\nSource Program=test"),
        ("WEAVING", "Shafts=4\nTreadles=4\nRising Shed=true"),
        ("WARP", "Threads=4"),
        ("WEFT", "Threads=4"),
        ("THREADING", "1=1\n2=2\n3=3\n4=4"),
        ("TIEUP", "1=1,2\n2=2,3\n3=3,4\n4=1,4"),
        ("TREADLING", "1=1\n2=2\n3=3\n4=4"),
    ];
    for &(name, lines) in sections {
        match all.iter_mut().find(|(known, _)| *known == name) {
            Some(known) => known.1 = lines,
            None => all.push((name, lines)),
        }
    }
    all.retain(|(_, lines)| *lines != "-");
    all.iter().map(|(name, lines)| format!("[{name}]\n{lines}\n")).collect()
}

/// The rows of a draft, first pick first, and the codes and messages of what was said.
fn rows(text: &str) -> (Option<String>, Vec<String>) {
    let (found, told) = read(FileId(0), text);
    let spelt = found.map(|found| {
        let mut bytes = Vec::new();
        found.draft.drawdown().unwrap().spell(|row| bytes.extend_from_slice(row));
        String::from_utf8(bytes).unwrap()
    });
    (spelt, told.iter().map(|told| format!("{} {}", told.code, told.message)).collect())
}

#[track_caller]
fn refused(sections: &[(&str, &str)], wanted: &str) {
    let (rows, told) = rows(&file(sections));
    assert_eq!(rows, None);
    assert!(told.iter().any(|told| told.starts_with(wanted)), "{told:#?}");
}

#[track_caller]
fn mended(sections: &[(&str, &str)], wanted: &str, drawn: &str) {
    let (rows, told) = rows(&file(sections));
    assert_eq!(rows.as_deref(), Some(drawn), "{told:#?}");
    if wanted.is_empty() {
        assert!(told.is_empty(), "{told:#?}");
    } else {
        assert!(told.iter().all(|told| told.starts_with("W0621")), "{told:#?}");
        assert!(told.iter().any(|told| told.contains(wanted)), "{told:#?}");
    }
}

const TWILL: &str = "1100\n0110\n0011\n1001";

#[test]
fn what_programs_leave_out_or_put_in_is_read() {
    mended(&[], "", TWILL);
    mended(&[("WEAVING", "Shafts=4\nTreadles=4")], "", TWILL);
    mended(&[("CONTENTS", "THREADING=no"), ("WARP SPACING", ""), ("NOTES", "")], "", TWILL);
    mended(&[("WARP", "; ends\nThreads = 4 ; four\nColor=0")], "", TWILL);
    mended(&[("THREADING", ";[4]abcd\n4=4\n01=0 1\n3=3,\n2= 2 ;x")], "", TWILL);
    mended(&[("LIFTPLAN", "1=0\n2=")], "", TWILL);
    mended(
        &[("TIEUP", "-"), ("TREADLING", "-"), ("LIFTPLAN", "1=1,2,0\n3=3,4\n2=2,3\n4=1,4")],
        "",
        TWILL,
    );
    mended(&[("TIEUP", "1=0\n2="), ("LIFTPLAN", "1=1,2\n2=2,3\n3=3,4\n4=1,4")], "", TWILL);
    mended(&[("TREADLING", "1=1,3\n2=\n3=0,3")], "", "1111\n0000\n0011\n0000");
    mended(&[("WEAVING", "Shafts=4\nTreadles=4\nRising Shed=no")], "", "0011\n1001\n1100\n0110");
    mended(&[("PRIVATE TEST DATA", "no key here\n=\n1=x")], "", TWILL);
}

#[test]
fn what_is_mended_is_told() {
    mended(
        &[("WEAVING", "Shafts=2\nTreadles=4")],
        "[WEAVING] Shafts: 2 are declared, shaft 4",
        TWILL,
    );
    mended(&[("WEAVING", "Shafts=4\nTreadles=2")], "[WEAVING] Treadles: 2 are declared", TWILL);
    mended(&[("THREADING", "1=1\n2=2\n3=3\n4=4\n4=4")], "[THREADING] 4: is given twice", TWILL);
    mended(&[("THREADING", "1=1\n2=2\n3=3\n4=4\n5=1")], "[THREADING] 5: there are 4 ends", TWILL);
    mended(&[("WARP", "Threads=4\nThreads=4")], "[WARP] Threads: is given twice", TWILL);
    mended(&[("WARP", "Threads=4\nnonsense")], "[WARP] holds a line without `=`", TWILL);
    mended(&[("WARP", "Threads=4\nColor=3")], "[WARP] Color: colour 3 is named", TWILL);
    mended(&[("WEAVING", "-")], "[WEAVING] is missing", TWILL);
    mended(&[("WIF", "-")], "[WIF] is missing", TWILL);
    mended(&[("COLOR TABLE", "1=0,0,0")], "[COLOR PALETTE] is missing", TWILL);
    mended(&[("WARP", "Threads=4\nSpacing=0.1")], "[WARP] Spacing: is taken to be in cent", TWILL);
    mended(
        &[("TREADLING", "1=9\n2=1"), ("LIFTPLAN", "1=1,2\n2=2,3\n3=3,4\n4=1,4")],
        "[TREADLING] 1: there is no treadle 9",
        TWILL,
    );
    mended(&[("COLOR PALETTE", "Range=x")], "[COLOR PALETTE] Range: is no range", TWILL);
    mended(&[("COLOR TABLE", "1=0,0\n2=1,1,1")], "[COLOR TABLE] 1: is no colour", TWILL);
    mended(&[("WARP", "Threads=4\nSpacing=wide")], "[WARP] Spacing: is no number", TWILL);
    mended(&[("WARP", "Threads=4\nUnits=ells\nSpacing=1")], "[WARP] Units: is no unit", TWILL);
    mended(&[("WEFT", "Threads=4\nSpacing=9000")], "[WEFT] Spacing: is no thread", TWILL);
    mended(&[("CONTENTS", "WARP COLORS=yes")], "[CONTENTS] WARP COLORS: is promised", TWILL);
    mended(
        &[("LIFTPLAN", "1=1,2\n2=2,3\n3=3,4\n4=3")],
        "[LIFTPLAN] 4: tie-up and treadling lift other shafts",
        TWILL,
    );
}

#[test]
fn what_nobody_could_weave_is_refused_with_section_and_key() {
    refused(&[("THREADING", "-")], "E0621 [THREADING] is missing");
    refused(&[("THREADING", "1=0")], "E0621 [THREADING] is empty");
    refused(&[("TIEUP", "-")], "E0621 [TIEUP] is missing");
    refused(&[("TREADLING", "-")], "E0621 [TREADLING] is missing");
    refused(&[("TIEUP", "-"), ("TREADLING", "-")], "E0621 [LIFTPLAN] is missing");
    refused(&[("WARP", "-")], "E0621 [WARP] is missing");
    refused(&[("WEFT", "Color=1")], "E0621 [WEFT] Threads is missing");
    refused(&[("WEFT", "Threads=many")], "E0622 [WEFT] Threads: `many` is not a whole number");
    refused(&[("WEFT", "Threads=0")], "E0622 [WEFT] Threads: `0` is not a number of threads");
    refused(&[("WARP", "Threads=2000000000")], "E0624 [WARP] Threads: 2000000000 threads");
    refused(&[("WARP", "Threads=100000"), ("WEFT", "Threads=100000")], "E0624 [WARP] Threads");
    refused(&[("THREADING", "1=1\n2=two")], "E0622 [THREADING] 2: `two` is not a list of shafts");
    refused(&[("THREADING", "1=99999999999999999999999")], "E0622 [THREADING] 1");
    refused(&[("THREADING", "1=-1")], "E0622 [THREADING] 1: `-1`");
    refused(&[("TREADLING", "1=1\n2=7")], "E0623 [TREADLING] 2: there is no treadle 7");
    refused(
        &[("WARP COLORS", "3=2")],
        "E0623 [WARP COLORS] 3: colour 2 is named, but [COLOR TABLE]",
    );
    refused(
        &[("COLOR TABLE", "1=0,0,0"), ("WEFT COLORS", "3=2")],
        "E0623 [WEFT COLORS] 3: there is no colour 2",
    );
    refused(
        &[("COLOR TABLE", "1=0,0"), ("WARP COLORS", "1=1")],
        "E0623 [WARP COLORS] 1: colour 1 is named",
    );
    for text in ["", "GIF89a", "[NOTES]\n1=x", "garment x { }"] {
        let (rows, told) = rows(text);
        assert!(rows.is_none() && told[0].starts_with("E0625"), "{told:?}");
    }
}

#[test]
fn a_mistake_in_every_line_is_told_a_few_times() {
    let many: String = (1..=5000).map(|n| format!("{n}=x\n")).collect();
    let text = file(&[("WARP", "Threads=5000"), ("THREADING", &many)]);
    let (rows, told) = rows(&text);
    assert!(rows.is_none() && told.len() < 20, "{told:?}");
    assert!(told.iter().any(|told| told.ends_with("and 4995 more like this")), "{told:?}");
}

#[test]
fn colours_and_lengths_are_those_of_the_threads() {
    let text = file(&[
        ("COLOR PALETTE", "Range=0,999\nEntries=3"),
        ("COLOR TABLE", "1=999,0,0\n2=0,500,999\n3=0,0,0"),
        ("WARP", "Threads=4\nColor=1\nUnits=Inches\nSpacing=0.1\nThickness=0,05"),
        ("WARP COLORS", "2=2\n3=\n4=7,0,0,999"),
        ("WARP SPACING", "2=0.2"),
        ("WEFT", "Threads=4\nUnits=decipoints\nSpacing=72"),
        ("NOTES", "2=second\n1=first\n3="),
        ("TEXT", "Title=Half; and half\nAuthor=weaver"),
    ]);
    let (found, told) = read(FileId(0), &text);
    assert!(told.is_empty(), "{told:?}");
    let draft = found.unwrap().draft;
    let colour = |red, green, blue| Colour([red, green, blue, 255]);
    assert_eq!(
        draft.warp.colours.unwrap(),
        [colour(255, 0, 0), colour(0, 128, 255), colour(255, 0, 0), colour(0, 0, 255)]
    );
    assert_eq!(draft.warp.spacing.unwrap(), [2.54e-3, 5.08e-3, 2.54e-3, 2.54e-3]);
    assert_eq!(draft.warp.thickness.unwrap(), [1.27e-3; 4]);
    assert_eq!(draft.weft, Threads { spacing: Some(vec![2.54e-3; 4]), ..Threads::default() });
    assert_eq!((draft.title.as_str(), draft.notes.len()), ("Half; and half", 2));
}

fn numbers(most: u32) -> impl Strategy<Value = Vec<u32>> {
    prop::collection::btree_set(1..=most, 0..4).prop_map(|set| set.into_iter().collect())
}

fn threads(count: usize) -> impl Strategy<Value = Threads> {
    let colour = prop::array::uniform3(prop::sample::select(vec![0_u8, 7, 128, 255]));
    let colour = colour.prop_map(|[r, g, b]| Colour([r, g, b, 255]));
    let length = (1_000_u32..20_000_000).prop_map(|n| nanometres(f64::from(n) * 1e-9));
    let lengths = prop::collection::vec(length, count);
    (
        prop::collection::vec(colour, count).prop_map(Some),
        prop::option::of(lengths.clone()),
        prop::option::of(lengths),
    )
        .prop_map(|(colours, spacing, thickness)| Threads { colours, spacing, thickness })
}

fn draft() -> impl Strategy<Value = Draft> {
    let size = (1_usize..20, 1_usize..20, 1_usize..9, 1_usize..9);
    size.prop_flat_map(|(ends, picks, shafts, treadles)| {
        let lists = |count, most: usize| prop::collection::vec(numbers(most as u32), count);
        let treadled = (lists(treadles, shafts), lists(picks, treadles))
            .prop_map(|(tieup, treadling)| Shedding::Treadled { tieup, treadling });
        let lifted = lists(picks, shafts).prop_map(|plan| Shedding::Lifted { plan });
        let shedding = prop_oneof![treadled, lifted];
        let text = prop::sample::select(vec!["", "Köper; 2/2", "a=b [c]"]);
        (lists(ends, shafts), shedding, threads(ends), threads(picks), any::<bool>(), text)
            .prop_map(move |(threading, shedding, warp, weft, rising, title)| Draft {
                title: title.to_owned(),
                author: String::new(),
                notes: Vec::new(),
                rising,
                shafts,
                treadles,
                threading,
                shedding,
                warp,
                weft,
            })
    })
}

/// Whether anything is threaded and moved; what is not cannot be woven and is not read.
fn weavable(draft: &Draft) -> bool {
    let any = |lists: &[Vec<u32>]| lists.iter().any(|list| !list.is_empty());
    any(&draft.threading)
        && match &draft.shedding {
            Shedding::Treadled { tieup, treadling } => any(tieup) && any(treadling),
            Shedding::Lifted { plan } => any(plan),
        }
}

#[test]
fn threads_without_colours_are_written_black_and_white() {
    let plain = Draft::of_weave(&crate::textile::weave::Weave::plain());
    let text = write(&plain);
    assert!(text.contains("[WARP]\r\nThreads=2\r\nColor=1\r\nUnits=Centimeters\r\n"), "{text}");
    assert!(text.contains("1=0,0,0\r\n2=255,255,255\r\n"), "{text}");
    assert!(
        text.contains("\r\nLIFTPLAN=false\r\n") && text.contains("[LIFTPLAN]\r\n1=1"),
        "{text}"
    );
    let back = read(FileId(0), &text).0.unwrap().draft;
    assert_eq!(back.shedding, plain.shedding);
    assert_eq!(back.weft.colours, Some(vec![Colour([255; 4]); 2]));
}

proptest! {
    #[test]
    fn what_is_written_reads_back(draft in draft().prop_filter("weavable", weavable)) {
        let text = write(&draft);
        let (found, told) = read(FileId(0), &text);
        prop_assert!(told.is_empty(), "{:?}\n{}", told, text);
        prop_assert_eq!(found.unwrap().draft, draft);
    }

    #[test]
    fn no_text_makes_the_reader_fail(
        text in "(\\[(WARP|WEFT|THREADING|TIEUP|TREADLING|LIFTPLAN|WEAVING|COLOR TABLE|WARP COLORS)\\]\r?\n|(Threads|Shafts|Color|Spacing|[0-9]{1,3})=[-0-9.,;x]{0,12}\n|.{0,8}\n){0,40}",
    ) {
        let (found, told) = read(FileId(0), &text);
        prop_assert_eq!(found.is_none(), told.iter().any(|told| told.is_error()));
        if let Some(found) = found {
            prop_assert!(found.draft.drawdown().is_ok());
        }
    }
}
