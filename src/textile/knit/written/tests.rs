use super::*;

/// The rows from the left, one letter a stitch.
fn rows(lines: &[&str], way: Way) -> Vec<String> {
    let letter = |symbol: &Symbol| match symbol {
        Symbol::Knit => 'k',
        Symbol::Purl => 'p',
        Symbol::YarnOver => 'o',
        Symbol::NoStitch => ' ',
        Symbol::Together { lean: Lean::Right, .. } => '/',
        Symbol::Together { .. } => '\\',
        Symbol::Cable(_) => 'c',
        _ => '?',
    };
    let found = written(lines, way).unwrap_or_else(|told| panic!("{told:?}"));
    found.iter().map(|row| row.iter().map(letter).collect()).collect()
}

const FLAT: Way = Way { stitches: None, round: false };

fn cast_on(stitches: usize) -> Way {
    Way { stitches: Some(stitches), round: false }
}

#[test]
fn rows_are_charted_as_seen_on_the_face() {
    let rib = ["row 1 (RS): k2, *p1, k1; repeat from * to end", "row 2: *p1, k1* p2"];
    assert_eq!(rows(&rib, cast_on(8)), ["kpkpkpkk", "kpkpkpkk"]);
    let seed = ["Rows 1-3: [k1, p1] 2 times"];
    assert_eq!(rows(&seed, FLAT), ["pkpk"; 3]);
    let round = ["round 1: k", "rnd 2: p across"];
    assert_eq!(rows(&round, Way { stitches: Some(3), round: true }), ["kkk", "ppp"]);
}

#[test]
fn lace_and_cables_count() {
    let lace = ["row 1: k1, *k2tog, yo; rep from * to last 2 sts, ssk", "row 2: p to end"];
    assert_eq!(rows(&lace, cast_on(9)), ["\\o/o/o/k", "kkkkkkkk"]);
    let narrow = ["row 1: k1, k2tog", "row 2: p2"];
    assert_eq!(rows(&narrow, FLAT), ["/k", "kk"]);
    let narrower = ["row 1: k3", "row 2: p1, p2tog", "row 3: k2tog"];
    assert_eq!(rows(&narrower, FLAT), ["kkk", " k/", "  /"]);
    let cable = ["row 1: p1, 2/2 LC, p1", "row 2: k1, p4, k1", "repeat rows 1-2 twice"];
    let found = rows(&cable, FLAT);
    assert_eq!((found.len(), &*found[0], &*found[5]), (6, "pccccp", "pkkkkp"));
}

#[test]
fn what_cannot_be_read_is_told_where_it_stands() {
    for (lines, wanted, piece) in [
        (&["k2, p2"][..], "E0607", "k2"),
        (&["row 2: k"], "E0607", " 2"),
        (&["row 1: k2, q2"], "E0607", "q2"),
        (&["row 1: [k2, p2"], "E0607", "["),
        (&["row 1: 2/2 XC"], "E0607", "2/2 XC"),
        (&["row 1: *k1*, *p1*"], "E0607", " *k1*, *p1*"),
        (&["row 1: k2, p2", "row 2: k3"], "E0603", " k3"),
        (&["row 1: k1, p"], "", ""),
        (&["row 1: *k1, p1*"], "E0208", " *k1, p1*"),
        (&["row 1: k4", "row 2: *k3*"], "E0603", " *k3*"),
        (&["row 1: k999999999999999999999"], "E0607", "k999999999999999999999"),
        (&["row 1: [[k1] 9 times] 9 times"], "E0607", "["),
        (&["rows 1-99999: k"], "E0601", "rows 1-99999: k"),
    ] {
        match written(lines, FLAT) {
            Ok(_) => assert_eq!(wanted, "", "{lines:?}"),
            Err(told) => {
                assert_eq!(told.code, wanted, "{told:?}");
                assert_eq!(&lines[told.line][told.at.clone()], piece, "{told:?}");
            }
        }
    }
}

proptest::proptest! {
    #[test]
    fn any_row_is_read_or_refused(
        words in proptest::collection::vec(proptest::sample::select(vec![
            "row", "rows", "1", "2", ":", "k", "p2", "*", "repeat", "from", "to", "last",
            "sts", "end", "[", "]", "(", ")", "3", "times", "twice", "yo", "k2tog", "2/2",
            "lc", ",", ";", "é", "x3", "-",
        ]), 0..24),
        stitches in 0usize..20,
    ) {
        let line = words.join(" ");
        let lines = [&*line, &format!("row 1: {line}"), "row 2: p"];
        for lines in [&lines[..1], &lines[1..]] {
            match written(lines, cast_on(stitches)) {
                Ok(found) => {
                    let width = found.first().map_or(0, Vec::len);
                    proptest::prop_assert!(found.iter().all(|row| row.len() == width));
                }
                Err(told) => {
                    proptest::prop_assert!(lines[told.line].get(told.at).is_some());
                }
            }
        }
    }
}
