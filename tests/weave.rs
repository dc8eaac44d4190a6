//! `darzi weave` on the files of other programs, on damaged ones, and on weaves of texts.

#![allow(clippy::disallowed_methods, clippy::print_stdout)]

use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn data() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/wif")
}

fn weave(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_darzi"))
        .arg("weave")
        .args(arguments)
        .current_dir(folder)
        .output()
        .expect("the program starts")
}

fn told(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// The figures of a call that must go well.
#[track_caller]
fn stats(folder: &Path, arguments: &[&str]) -> Value {
    let output = weave(folder, &[arguments, &["--stats"]].concat());
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", told(&output));
    serde_json::from_slice(&output.stdout).expect("one JSON object")
}

fn files(start: &str) -> Vec<String> {
    let mut names: Vec<String> = std::fs::read_dir(data())
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| name.starts_with(start) && name.ends_with(".wif"))
        .collect();
    names.sort();
    names
}

fn expected() -> serde_json::Map<String, Value> {
    let text = std::fs::read_to_string(data().join("expected.json")).unwrap();
    serde_json::from_str(&text).unwrap()
}

const SAME: [(&str, &str); 9] = [
    ("ends", "ends"),
    ("picks", "picks"),
    ("shafts", "shafts"),
    ("treadles", "treadles"),
    ("rising", "rising"),
    ("warp_up", "warp_up"),
    ("longest_warp_float", "longest_warp_float_face"),
    ("longest_weft_float", "longest_weft_float_face"),
    ("drawdown_sha256", "sha256"),
];

#[test]
fn files_of_real_programs_are_read() {
    let expected = expected();
    assert_eq!(expected.len(), 12);
    for (name, wanted) in expected {
        let found = stats(&data(), &[&name]);
        for (ours, theirs) in SAME {
            assert_eq!(found[ours], wanted[theirs], "{name}: {ours}");
        }
        assert_eq!(found["source"], wanted["source"], "{name}");
    }
}

#[test]
fn what_is_written_is_the_same_cloth_to_other_readers() {
    let folder = tempfile::tempdir().unwrap();
    for (name, wanted) in expected() {
        let path = data().join(&name);
        let out = folder.path().join("out.wif");
        let made = weave(folder.path(), &[path.to_str().unwrap(), "--wif", "out.wif"]);
        assert_eq!(made.status.code(), Some(0), "{}", told(&made));
        let found = stats(folder.path(), &["out.wif"]);
        assert_eq!(found["drawdown_sha256"], wanted["sha256"], "{name}");
        let text = std::fs::read_to_string(&out).unwrap();
        for wanted in ["[WIF]\r\nVersion=1.1\r\n", "[CONTENTS]", "Rising Shed=", "[LIFTPLAN]"] {
            assert!(text.contains(wanted), "{name}: {wanted}\n{text}");
        }
        // What is written again does not change any more.
        let made = weave(folder.path(), &["out.wif", "--wif", "again.wif"]);
        assert_eq!(made.status.code(), Some(0), "{}", told(&made));
        assert_eq!(text, std::fs::read_to_string(folder.path().join("again.wif")).unwrap());
    }
}

#[test]
fn damaged_files_are_refused_with_section_and_key() {
    let damage = [
        ("missing_color_table_warp", "E0623", "[WARP COLORS] 1"),
        ("missing_liftplan", "E0621", "[LIFTPLAN]"),
        ("missing_tieup", "E0621", "[TIEUP]"),
        ("too_many_treadles_in_treadline", "E0623", "[TREADLING] 1"),
        ("warp_color_too_big", "E0623", "[WEFT COLORS] 6"),
    ];
    assert_eq!(files("dtx_bad").len(), damage.len());
    for (name, code, place) in damage {
        let file = format!("dtx_bad_wif_{name}.wif");
        let output = weave(&data(), &[&file, "--stats", "--message-format", "short"]);
        assert_eq!(output.status.code(), Some(1), "{file}");
        assert!(output.stdout.is_empty());
        let said = told(&output);
        assert!(said.contains(code) && said.contains(place), "{said}");
        assert!(said.starts_with(&format!("{file}:")), "with its line: {said}");
    }
}

/// Every file cut off anywhere, and with any line left out: read or refused, never worse.
#[test]
fn wounded_files_do_no_harm() {
    use darzi::diagnostic::FileId;
    let good: Vec<String> =
        files("dtx_desired").into_iter().filter(|n| !n.contains("multi-byte")).collect();
    assert!(good.len() >= 6);
    for name in good {
        let text = std::fs::read_to_string(data().join(&name)).unwrap();
        let mut wounded: Vec<String> =
            (0..text.len()).step_by(3).map(|at| text[..at].to_owned()).collect();
        let lines: Vec<&str> = text.lines().collect();
        for at in 0..lines.len() {
            let mut left = lines.clone();
            left.remove(at);
            wounded.push(left.join("\n"));
            let mut twice = lines.clone();
            twice.insert(at, lines[at]);
            wounded.push(twice.join("\r"));
        }
        for text in wounded {
            let (found, told) = darzi::textile::wif::read(FileId(0), &text);
            assert_eq!(found.is_none(), told.iter().any(|told| told.is_error()), "{text}");
            if let Some(found) = found {
                found.draft.drawdown().unwrap();
            }
        }
    }
}

#[test]
fn endless_numbers_take_no_memory() {
    let folder = tempfile::tempdir().unwrap();
    let text = "[WIF]\n[WARP]\nThreads=2000000000\n[WEFT]\nThreads=99999999999999999999\n\
                [THREADING]\n4000000000=4000000000\n1=1\n[LIFTPLAN]\n1=1\n";
    std::fs::write(folder.path().join("big.WIF"), text).unwrap();
    let output = weave(folder.path(), &["big.WIF"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(told(&output).contains("E0624"), "{}", told(&output));
}

#[test]
fn weaves_of_texts_are_drafts() {
    let folder = tempfile::tempdir().unwrap();
    let text = "weave serge { twill 2/2 Z }\n\
                yarn w20 { count: 20tex   fibre: wool }\n\
                fabric suiting { structure: serge   warp: w20 at 26/cm color charcoal   weft: w20 at 23/cm }\n";
    std::fs::write(folder.path().join("suit.garment"), text).unwrap();
    let several = weave(folder.path(), &["suit.garment"]);
    assert_eq!(several.status.code(), Some(2));
    assert!(told(&several).contains("serge, suiting"), "{}", told(&several));
    let serge = stats(folder.path(), &["suit.garment", "--name", "serge"]);
    assert_eq!((&serge["shafts"], &serge["treadles"]), (&4.into(), &4.into()));
    assert_eq!(serge["round_the_repeat"]["longest_warp_float"], 2);
    // A weave of the library: point threading of four shafts.
    let birdseye = stats(folder.path(), &["suit.garment", "--name", "birdseye"]);
    assert_eq!((&birdseye["ends"], &birdseye["shafts"]), (&6.into(), &4.into()));
    let made = weave(folder.path(), &["suit.garment", "--name", "suiting", "--wif", "suit.wif"]);
    assert_eq!(made.status.code(), Some(0), "{}", told(&made));
    let back = stats(folder.path(), &["suit.wif"]);
    assert_eq!(back["drawdown_sha256"], serge["drawdown_sha256"]);
    assert!(
        std::fs::read_to_string(folder.path().join("suit.wif")).unwrap().contains("Spacing=0.03")
    );
    // And back into a text.
    std::fs::write(folder.path().join("again.garment"), "weave serge { wif \"suit.wif\" }\n")
        .unwrap();
    let again = stats(folder.path(), &["again.garment"]);
    assert_eq!(again["drawdown_sha256"], serge["drawdown_sha256"]);
    let unknown = weave(folder.path(), &["suit.garment", "--name", "birdsey"]);
    assert!(told(&unknown).contains("did you mean `birdseye`"), "{}", told(&unknown));
}

/// What is said of a call, one code each.
fn codes(folder: &Path, arguments: &[&str]) -> Vec<String> {
    let output = weave(folder, &[arguments, &["--message-format", "json"]].concat());
    told(&output)
        .lines()
        .map(|line| {
            serde_json::from_str::<Value>(line).unwrap()["code"].as_str().unwrap().to_owned()
        })
        .collect()
}

#[test]
fn a_weavers_objections_are_told_of_files_and_texts() {
    assert_eq!(codes(&data(), &["dtx_desired_basic_wif_two_color_liftplan.wif"]), [""; 0]);
    let long = codes(&data(), &["dtx_desired_basic_wif_multi-byte_multi_treadled.wif"]);
    assert_eq!(long, ["W0624", "W0601"]);
    let call = ["thunderloom_2229.wif", "--shafts", "2", "--treadles", "3"];
    assert_eq!(codes(&data(), &call), ["W0623", "W0623", "W0624"]);
    let folder = tempfile::tempdir().unwrap();
    let text = "weave loose { matrix: |1000|1110|0010|1011| }\n";
    std::fs::write(folder.path().join("double.garment"), text).unwrap();
    assert_eq!(codes(folder.path(), &["double.garment"]), ["W0603"]);
    std::fs::write(folder.path().join("none.garment"), "\n").unwrap();
    for name in ["satin_8", "honeycomb", "crepe", "basket_3", "poplin", "denim"] {
        assert_eq!(codes(folder.path(), &["none.garment", "--name", name]), [""; 0], "{name}");
    }
}

#[test]
fn drafts_are_drawn() {
    let folder = tempfile::tempdir().unwrap();
    let file = data().join("dtx_desired_basic_wif_many_color_liftplan_and_zeros.wif");
    let file = file.to_str().unwrap();
    for name in ["draft.png", "draft.SVG"] {
        let output = weave(folder.path(), &[file, "--draft", name]);
        assert_eq!(output.status.code(), Some(0), "{}", told(&output));
        assert!(output.stdout.is_empty(), "a drawing is met with silence");
    }
    let picture = image::open(folder.path().join("draft.png")).unwrap().to_rgb8();
    // The colours of its threads: the first end green, the first pick magenta.
    for colour in [[0, 255, 0], [255, 20, 255]] {
        assert!(picture.pixels().any(|pixel| pixel.0 == colour), "{colour:?}");
    }
    let text = std::fs::read_to_string(folder.path().join("draft.SVG")).unwrap();
    assert!(text.starts_with("<svg ") && text.contains("many color liftplan and zeros"));
    let wrong = weave(folder.path(), &[file, "--draft", "draft.jpg"]);
    assert_eq!(wrong.status.code(), Some(2));
    assert!(told(&wrong).contains("neither a .png nor a .svg"));
    // The same bytes every time.
    let before = std::fs::read(folder.path().join("draft.png")).unwrap();
    weave(folder.path(), &[file, "--draft", "draft.png"]);
    assert_eq!(before, std::fs::read(folder.path().join("draft.png")).unwrap());
}
