use super::*;
use crate::diagnostic::FileId;
use proptest::prelude::*;

/// A program with carriers 1 to 3 and these lines.
fn text(lines: &str) -> String {
    format!(";!knitout-2\n;;Carriers: 1 2 3\n{lines}")
}

/// What is said of a text, read and run: codes and messages.
fn said(text: &str) -> Vec<String> {
    let (program, mut told) = read(FileId(0), text);
    if let Some(program) = program {
        told.extend(run(FileId(0), &program).1);
    }
    told.iter().map(|told| format!("{} {}", told.code, told.message)).collect()
}

#[track_caller]
fn tells(lines: &str, wanted: &str) {
    let told = said(&text(lines));
    assert!(told.iter().any(|told| told.starts_with(wanted)), "{told:#?}");
}

/// What comes of lines that nobody objects to.
#[track_caller]
fn sound(lines: &str) -> Outcome {
    let (program, told) = read(FileId(0), &text(lines));
    assert_eq!(told, []);
    let (outcome, told) = run(FileId(0), &program.unwrap());
    assert_eq!(told, []);
    outcome
}

#[test]
fn a_tube_of_two_rounds_is_followed_loop_by_loop() {
    let outcome = sound(
        "inhook 2 ; the yarn\ntuck - f2 2\ntuck - f1 2\ntuck + b1 2\ntuck + b2 2\n\
         knit - f2 2\nknit - f1 2\nreleasehook 2\nknit + b1 2\nknit + b2 2\nouthook 2\n",
    );
    assert_eq!((outcome.knitted, outcome.tucked, outcome.passes.len()), ([2, 2], 4, 4));
    assert_eq!((outcome.left(), outcome.reach), (4, Some([1, 2])));
    assert_eq!(outcome.carriers[1], Work { loops: 8, longest_float: 0 });
    assert_eq!((outcome.courses, outcome.most_on_needle), (2, 1));
}

#[test]
fn loops_go_over_where_needles_face_each_other() {
    let cast_on = "in 1\ntuck + f1 1\ntuck + f2 1\n";
    let outcome = sound(&format!(
        "{cast_on}xfer f1 b1\nrack 1\nxfer b1 f2\nrack 0\nsplit - f2 b2 1\ndrop b2\nout 1\n"
    ));
    assert_eq!((outcome.transferred, outcome.split, outcome.dropped), (3, 1, 2));
    assert_eq!((outcome.most_on_needle, outcome.left()), (2, 1));
    for (line, wanted) in [
        ("xfer f1 b2", "E0636 loops cannot go from f1 to b2"),
        ("xfer f1 f2", "E0636 loops cannot go from f1 to f2"),
        ("rack 0.25\nxfer f1 b1", "E0636 loops cannot go from f1 to b1"),
        ("xfer f4 b4", "W0632 f4 holds no loop, nothing goes over"),
        ("drop b2", "W0632 b2 holds no loop, nothing falls"),
        ("rack 1\nxfer f2 bs1\nrack 0\nknit + bs1 1", "E0637 the slider bs1"),
    ] {
        tells(&format!("{cast_on}{line}\n"), wanted);
    }
}

#[test]
fn carriers_go_in_and_out_in_order() {
    for (lines, wanted) in [
        ("knit + f1 1", "E0635 `knit` with carrier 1, which is not in action"),
        ("in 1\nin 1", "E0635 carrier 1 is in action already"),
        ("inhook 1\ninhook 2", "E0635 the inserting hook still holds carrier 1"),
        ("inhook 1\nreleasehook 2", "E0635 the inserting hook holds carrier 1, not 2"),
        ("in 1\nreleasehook 1", "E0635 the inserting hook holds no yarn"),
        ("out 3", "E0635 `out` with carrier 3"),
        ("in 1", "W0633 carrier 1 is still in action at the end"),
        ("inhook 1\ntuck + f1 1", "W0633 the inserting hook holds carrier 1 to the end"),
    ] {
        tells(lines, wanted);
    }
}

#[test]
fn what_cannot_be_read_is_told_with_its_place() {
    for (lines, wanted) in [
        ("nit + f1 1", "E0633 there is no operation `nit`"),
        ("knit f1 1", "E0633 `f1` is not a direction"),
        ("knit +", "E0633 `knit` wants DIRECTION NEEDLE"),
        ("knit + g1 1", "E0633 `g1` is not a needle"),
        ("knit + f99999999999 1", "E0633 `f99999999999` is not a needle"),
        ("knit + f1 1 1", "E0633 carrier 1 is named twice"),
        ("knit + f1 7", "E0634 there is no carrier 7"),
        ("xfer f1", "E0633 `xfer` wants two needles"),
        ("rack nan", "E0633 `nan` is not a number"),
        ("stitch 1", "E0633 `stitch` wants two numbers"),
        ("x-what 3", "W0631 `x-what` is not known"),
    ] {
        tells(lines, wanted);
    }
    for (text, wanted) in [
        ("knit + f1 1\n", "E0631 this is not knitout"),
        (";!knitout-new\n", "E0631 the first line names no version"),
        (";!knitout-9\n;;Carriers: 1\n", "W0631 version 9"),
        (";!knitout-2\nknit + f1 1\n", "E0632 no header says the carriers"),
        (";!knitout-2\n", "E0632 no header says the carriers"),
        (";!knitout-2\n;;Carriers:\n", "E0632 no carrier is named"),
        (";!knitout-2\r\n;;Carriers: 1\r\n", "W0631 lines end in carriage returns"),
    ] {
        let told = said(text);
        assert_eq!(told.len(), 1, "{told:?}");
        assert!(told[0].starts_with(wanted), "{told:?}");
    }
    let (_, told) = read(FileId(0), &text("in 1\n knit + f1 9 ; so\n"));
    let span = told[0].labels[0].span;
    assert_eq!(&text("in 1\n knit + f1 9 ; so\n")[span.start as usize..span.end as usize], "9");
}

#[test]
fn what_is_written_reads_back() {
    let whole = ";!knitout-2\n;;Machine: SWG091N2\n;;X-Note:  two  blanks \n;;Carriers: A 2\n\n\
                 \x20;;Gauge: 15 is no header here\n; a word\nin A ;first\nstitch 7.5 -2\nrack -0.75\nrack 0\nmiss - fs3 A\n\
                 split + f1 b1 A 2\namiss f1\npause look here\nx-stitch-number 101\n;;late: 1\n";
    let (program, _) = read(FileId(0), whole);
    let program = program.unwrap();
    assert_eq!(write(&program), whole);
    assert_eq!(program.header("Machine"), Some("SWG091N2"));
}

#[test]
fn a_mistake_in_every_line_is_told_a_few_times() {
    let lines: String = (0..2000).map(|n| format!("knit + f1 c{n}\nx-{n}\n")).collect();
    let told = said(&text(&lines));
    assert_eq!(told.len(), 10);
    assert!(told.iter().any(|told| told.contains("and 1995 more like this")), "{told:#?}");
}

/// Words of which damaged programs are made.
fn word() -> impl Strategy<Value = String> {
    let known = [
        "knit",
        "tuck",
        "xfer",
        "split",
        "miss",
        "drop",
        "rack",
        "in",
        "inhook",
        "releasehook",
        "out",
        "outhook",
        "stitch",
        "x-a",
        "+",
        "-",
        "f1",
        "b1",
        "f2",
        "b2",
        "fs1",
        "bs2",
        "1",
        "2",
        "3",
        "0.5",
        ";",
        ";;Carriers: 1 2",
        "\n",
        "\n",
        "\n",
        "\r",
    ];
    prop_oneof![9 => prop::sample::select(known.to_vec()).prop_map(str::to_owned), 1 => ".{0,4}"]
}

proptest! {
    #[test]
    fn any_text_is_read_or_refused(words in prop::collection::vec(word(), 0..80)) {
        let text = text(&words.join(" "));
        let (program, told) = read(FileId(0), &text);
        prop_assert_eq!(program.is_none(), told.iter().any(|told| told.is_error()));
        for told in &told {
            let span = told.labels[0].span;
            prop_assert!(text.get(span.start as usize..span.end as usize).is_some());
        }
        if let Some(program) = program {
            let (outcome, _) = run(FileId(0), &program);
            // No loop is lost: what was made lies on needles, was knitted through or fell.
            let made = outcome.loops();
            prop_assert!(outcome.left() + outcome.dropped <= made);
            let (mut again, _) = read(FileId(0), &write(&program));
            for (one, other) in again.iter_mut().flat_map(|it| &mut it.lines).zip(&program.lines) {
                one.span = other.span;
            }
            prop_assert_eq!(again, Some(program));
        }
    }
}
