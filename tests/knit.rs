//! `darzi knit` on the files of other programs, on damaged ones, and on knits of texts.

#![allow(clippy::disallowed_methods, clippy::print_stdout)]

use darzi::diagnostic::FileId;
use darzi::textile::knit::knitscape;
use darzi::textile::knitout;
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::time::Instant;

fn data() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/knit")
}

fn knit(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_darzi"))
        .arg("knit")
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
    let output = knit(folder, &[arguments, &["--stats"]].concat());
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", told(&output));
    serde_json::from_slice(&output.stdout).expect("one JSON object")
}

/// The names of the files that end so, and their texts.
fn files(end: &str) -> Vec<(String, String)> {
    let mut found: Vec<(String, String)> = std::fs::read_dir(data())
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| name.ends_with(end))
        .map(|name| {
            let text = std::fs::read_to_string(data().join(&name)).unwrap();
            (name, text)
        })
        .collect();
    found.sort();
    found
}

/// Lines of a text that begin with this word.
fn count(text: &str, word: &str) -> u64 {
    text.lines().filter(|line| line.split_whitespace().next() == Some(word)).count() as u64
}

#[test]
fn programs_of_others_are_followed() {
    let programs = files(".k");
    assert_eq!(programs.len(), 6);
    for (name, text) in programs {
        let (program, wrong) = knitout::read(FileId(0), &text);
        assert_eq!(wrong, [], "{name}");
        let (outcome, wrong) = knitout::run(FileId(0), &program.unwrap());
        let errors: Vec<_> = wrong.iter().filter(|it| it.is_error()).collect();
        assert!(errors.is_empty(), "{name}: {errors:#?}");
        let found = stats(&data(), &[&name]);
        let number = |key: &str| found[key].as_u64().unwrap();
        assert_eq!(
            number("knitted_front") + number("knitted_back"),
            count(&text, "knit"),
            "{name}"
        );
        assert_eq!(number("tucked"), count(&text, "tuck"), "{name}");
        assert_eq!(number("missed"), count(&text, "miss"), "{name}");
        assert!(number("transferred") <= count(&text, "xfer"), "{name}");
        // Each loop lies on a needle, fell, or was knitted through.
        assert!(outcome.left() + outcome.dropped <= outcome.loops(), "{name}");
    }
    let example = stats(&data(), &["knitout_spec_example.k"]);
    assert_eq!((&example["loops"], &example["loops_left"]), (&30.into(), &10.into()));
    assert_eq!((&example["rows"], &example["machine"]), (&2.into(), &"SWG091N2".into()));
    assert_eq!(example["carriers_used"][0]["yarn"], "50-50 Rust");
}

#[test]
fn what_is_read_is_written_without_loss() {
    for (name, text) in files(".k") {
        let program = knitout::read(FileId(0), &text).0.unwrap();
        // The sign of `rack +1` says nothing.
        assert_eq!(knitout::write(&program), text.replace("rack +", "rack "), "{name}");
    }
    let folder = tempfile::tempdir().unwrap();
    let path = data().join("knitoutex_Tutorial2_rib1x1.k");
    let output = knit(folder.path(), &[path.to_str().unwrap(), "--knitout", "out.k"]);
    assert_eq!(output.status.code(), Some(0), "{}", told(&output));
    assert_eq!(
        stats(folder.path(), &["out.k"])["loops"],
        stats(&data(), &["knitoutex_Tutorial2_rib1x1.k"])["loops"]
    );
}

#[test]
fn charts_of_knitscape_are_read() {
    let lace = stats(&data(), &["knitscape_birdseye_lace.json"]);
    assert_eq!((&lace["stitches"], &lace["rows"]), (&4.into(), &8.into()));
    // Two needles of four are out of work; on the others each tuck of the bitmap is one.
    assert_eq!(lace["symbols"]["no_stitch"], 16);
    assert_eq!(lace["symbols"]["tuck"], 8);
    assert_eq!(lace["colours"], serde_json::json!(["#00254d", "#ffae00", "#f51e0f"]));
    let basket = stats(&data(), &["knitscape_basketweave.json"]);
    assert_eq!((&basket["stitches"], &basket["rows"]), (&20.into(), &24.into()));
    let slips = files(".json")[0].1.split("\"repeat\"").nth(1).unwrap().matches('2').count();
    // The width and height of the bitmap are written with that digit too.
    assert_eq!(basket["symbols"]["slip"].as_u64().unwrap() as usize, slips - 2);
}

#[test]
fn damaged_programs_are_refused_with_line_and_column() {
    let folder = tempfile::tempdir().unwrap();
    let head =
        ";!knitout-2\n;;Carriers: 1 2 3\ninhook 1\ntuck - f2 1\ntuck - f1 1\nreleasehook 1\n";
    for (name, text, code, place) in [
        ("magic.k", "knit + f1 1\n".to_owned(), "E0631", "magic.k:1:1:"),
        ("none.k", ";!knitout-2\nin 1\n".to_owned(), "E0632", "none.k:2:1:"),
        ("word.k", format!("{head}nit + f1 1\n"), "E0633", "word.k:7:1:"),
        ("needle.k", format!("{head}knit + g1 1\n"), "E0633", "needle.k:7:8:"),
        ("carrier.k", format!("{head}knit + f1 4\n"), "E0634", "carrier.k:7:11:"),
        ("out.k", format!("{head}knit + f1 2\n"), "E0635", "out.k:7:1:"),
        ("apart.k", format!("{head}  xfer f1 b2\n"), "E0636", "apart.k:7:1:"),
        ("slider.k", format!("{head}xfer f1 bs1\nknit + bs1 1\n"), "E0637", "slider.k:8:1:"),
    ] {
        std::fs::write(folder.path().join(name), text).unwrap();
        let output = knit(folder.path(), &[name, "--stats", "--message-format", "short"]);
        assert_eq!(output.status.code(), Some(1), "{name}");
        assert!(output.stdout.is_empty());
        let said = told(&output);
        assert!(said.starts_with(place) && said.contains(code), "{said}");
    }
    // What can be done though it is probably not meant is a warning.
    std::fs::write(folder.path().join("empty.k"), format!("{head}xfer f9 b9\nouthook 1\n"))
        .unwrap();
    let output = knit(folder.path(), &["empty.k"]);
    assert_eq!(output.status.code(), Some(0));
    assert!(told(&output).contains("W0632"), "{}", told(&output));
}

/// Every file cut off anywhere, with any line left out or doubled, with signs changed: read or
/// refused, never worse.
#[test]
fn wounded_files_do_no_harm() {
    let wounded = |text: &str, step: usize| -> Vec<String> {
        let mut found: Vec<String> = (0..text.len())
            .step_by(step)
            .filter(|&at| text.is_char_boundary(at))
            .map(|at| text[..at].to_owned())
            .collect();
        let lines: Vec<&str> = text.lines().collect();
        for at in (0..lines.len()).step_by(step.div_ceil(16)) {
            let mut left = lines.clone();
            left.remove(at);
            found.push(left.join("\n"));
            left.insert(at, lines[at]);
            left.insert(at, lines[at]);
            found.push(left.join("\r\n"));
        }
        for (number, sign) in [" ", "-", "9", "\u{fffd}", "f", "\"", "["].iter().enumerate() {
            for at in (number..text.len().saturating_sub(1)).step_by(7 * step) {
                if text.is_char_boundary(at) && text.is_char_boundary(at + 1) {
                    let mut changed = text.to_owned();
                    changed.replace_range(at..=at, sign);
                    found.push(changed);
                }
            }
        }
        found
    };
    for (name, text) in files(".k") {
        let text = &text[..text.len().min(6000)];
        for text in wounded(text, 61) {
            let (program, told) = knitout::read(FileId(0), &text);
            assert_eq!(program.is_none(), told.iter().any(|it| it.is_error()), "{name}: {text}");
            if let Some(program) = program {
                knitout::run(FileId(0), &program);
            }
        }
    }
    for (name, text) in files(".json") {
        for text in wounded(&text, 5) {
            let (chart, told) = knitscape::read(FileId(0), &text);
            assert_eq!(chart.is_none(), told.iter().any(|it| it.is_error()), "{name}: {text}");
        }
    }
}

/// Ten times the lines take about ten times as long; a quadratic reader would take a hundred.
#[test]
fn long_programs_take_time_in_proportion() {
    let text = |rows: usize| {
        let mut text = ";!knitout-2\n;;Carriers: 1\nin 1\n".to_owned();
        for row in 0..rows {
            // Loops pile up on one needle and go to and fro; nothing is ever taken out.
            text += &format!("tuck + f1 1\ntuck - f{row} 1\nxfer f1 b1\nxfer b1 f1\nknit + f2 9\n");
        }
        text
    };
    let took = |text: &str| {
        let start = Instant::now();
        let (program, told) = knitout::read(FileId(0), text);
        assert!(program.is_none() && told.len() == 5);
        let sound = text.replace(" 9\n", " 1\n");
        let (program, _) = knitout::read(FileId(0), &sound);
        knitout::run(FileId(0), &program.unwrap());
        start.elapsed().as_secs_f64()
    };
    let (short, long) = (text(2_000), text(20_000));
    took(&short);
    let (short, long) = (took(&short), took(&long));
    assert!(long < 40.0 * short + 0.5, "{short} s, {long} s");
}

const ARAN: &str = "knit aran {
    legend { \"<<<<\": cable 2/2 left   \"=\": purl }
    chart:
        |==....==./o.=|
        |==<<<<==.o/.=|
        |==....==....=|
        |==....==....=|
    gauge: 20 x 28 per 10cm
}
yarn w { count: 250tex   fibre: wool   color: ivory }
knit dots {
    legend { \"x\": crimson   \".\": ivory }
    chart: |x...x...|........|
    gauge: 22 x 26 per 10cm
}
fabric jersey { structure: dots   yarn: w }
";

#[test]
fn knits_of_texts_are_charts() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("p.garment"), ARAN).unwrap();
    let several = knit(folder.path(), &["p.garment"]);
    assert_eq!(several.status.code(), Some(2));
    assert!(told(&several).contains("aran, dots, jersey"), "{}", told(&several));
    let aran = stats(folder.path(), &["p.garment", "--name", "aran"]);
    assert_eq!((&aran["stitches"], &aran["rows"]), (&13.into(), &4.into()));
    assert_eq!((&aran["cables"], &aran["symbols"]["yo"]), (&1.into(), &2.into()));
    assert_eq!(aran["gauge"]["stitches_per_10cm"], 20.0);
    assert_eq!(aran["chart_sha256"].as_str().unwrap().len(), 64);
    let jersey = stats(folder.path(), &["p.garment", "--name", "jersey"]);
    assert_eq!(jersey["longest_float"], 3);
    assert_eq!(jersey["colours"].as_array().unwrap().len(), 2);
    // 16 stitches of the yarn's 0.25 g a metre.
    let yarn = &jersey["yarn"];
    let (metres, grams) = (yarn["metres"].as_f64().unwrap(), yarn["grams"].as_f64().unwrap());
    assert!((grams - metres * 0.25).abs() < 1e-9 && (0.2..0.5).contains(&metres), "{yarn}");
    let unknown = knit(folder.path(), &["p.garment", "--name", "basketweav"]);
    assert!(told(&unknown).contains("did you mean `basketweave`"), "{}", told(&unknown));
}

#[test]
fn charts_become_programs_that_machines_can_run() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("p.garment"), ARAN).unwrap();
    for (name, repeat, stitches) in [("aran", "1x1", 13), ("dots", "3x4", 24), ("rib_2", "6x9", 24)]
    {
        let call = ["p.garment", "--name", name, "--repeat", repeat, "--knitout", "out.k"];
        let output = knit(folder.path(), &call);
        assert_eq!(output.status.code(), Some(0), "{}", told(&output));
        let output = knit(folder.path(), &["out.k", "--stats"]);
        assert!(output.stderr.is_empty(), "{}", told(&output));
        let found: Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!(found["stitches"], stitches, "{name}");
        assert_eq!(found["loops_left"], 0);
        // It is the program that `--stats` speaks of.
        let chart = stats(folder.path(), &["p.garment", "--name", name, "--repeat", repeat]);
        for key in ["loops", "knitted_back", "transferred", "passes"] {
            assert_eq!(chart["knitout"][key], found[key], "{name}: {key}");
        }
    }
    let bobble = "knit b { chart: |.B.|   gauge: 20 x 28 per 10cm }\n";
    std::fs::write(folder.path().join("b.garment"), bobble).unwrap();
    let output = knit(folder.path(), &["b.garment", "--knitout", "b.k"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(told(&output).contains("E0651"), "{}", told(&output));
    assert!(!folder.path().join("b.k").exists());
    let narrow = "knit n { chart: |./#|...|   gauge: 20 x 28 per 10cm }\n";
    std::fs::write(folder.path().join("n.garment"), narrow).unwrap();
    let output = knit(folder.path(), &["n.garment", "--repeat", "1x2"]);
    assert!(told(&output).contains("cannot go on above itself"), "{}", told(&output));
}

#[test]
fn charts_are_drawn() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("p.garment"), ARAN).unwrap();
    for (file, name) in [("p.garment", "a.png"), ("p.garment", "a.SVG")] {
        let output = knit(folder.path(), &[file, "--name", "aran", "--chart", name]);
        assert_eq!(output.status.code(), Some(0), "{}", told(&output));
        assert!(output.stdout.is_empty(), "a drawing is met with silence");
    }
    let text = std::fs::read_to_string(folder.path().join("a.SVG")).unwrap();
    assert!(text.starts_with("<svg ") && text.contains("cable 2 over 2 to the left"));
    let bytes = std::fs::read(folder.path().join("a.png")).unwrap();
    knit(folder.path(), &["p.garment", "--name", "aran", "--chart", "a.png"]);
    assert_eq!(bytes, std::fs::read(folder.path().join("a.png")).unwrap(), "the same every time");
    for (file, _) in files(".json").into_iter().chain(files(".k")) {
        let path = data().join(file);
        let output = knit(folder.path(), &[path.to_str().unwrap(), "--chart", "other.png"]);
        assert_eq!(output.status.code(), Some(0), "{}", told(&output));
        assert!(image::open(folder.path().join("other.png")).unwrap().width() > 60);
    }
    let wrong = knit(folder.path(), &["p.garment", "--chart", "a.jpg"]);
    assert_eq!(wrong.status.code(), Some(2));
}
