//! The program as a user calls it: exit codes, messages, whole files or none.

#![allow(clippy::disallowed_methods, clippy::print_stdout)]

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

fn darzi(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_darzi"))
        .args(arguments)
        .current_dir(folder)
        .env("XDG_CACHE_HOME", folder.join("cache"))
        .output()
        .expect("the program starts")
}

fn code(output: &Output) -> i32 {
    output.status.code().expect("the program ends by itself")
}

fn told(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn example(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples").join(name);
    path.to_string_lossy().into_owned()
}

fn files(folder: &Path) -> Vec<PathBuf> {
    let mut found: Vec<PathBuf> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    found.sort();
    found
}

#[test]
fn a_new_file_is_sound_and_is_not_written_over() {
    let folder = tempfile::tempdir().unwrap();
    let made = darzi(folder.path(), &["new", "picnic"]);
    assert_eq!(code(&made), 0, "{}", told(&made));
    let checked = darzi(folder.path(), &["check", "picnic.garment"]);
    assert_eq!(code(&checked), 0, "{}", told(&checked));
    assert!(
        checked.stdout.is_empty() && checked.stderr.is_empty(),
        "a sound file is met with silence"
    );
    let again = darzi(folder.path(), &["new", "picnic"]);
    assert_eq!(code(&again), 2);
    assert!(told(&again).contains("there already"));
    assert_eq!(code(&darzi(folder.path(), &["new", "../picnic"])), 2);
}

#[test]
fn wrong_calls_end_with_2_and_write_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let skirt = example("a_line_skirt.garment");
    for call in [
        vec!["render", &skirt],
        vec!["render", &skirt, "-o", "x.jpg"],
        vec!["render", &skirt, "-o", "nowhere/x.png"],
        vec!["render", &skirt, "-o", "x.png", "--size", "900"],
        vec!["render", &skirt, "-o", "x.png", "--view", "below"],
        vec!["render", &skirt, "-o", "x.png", "--shading", "volume"],
        vec!["render", &skirt, "-o", "x.png", "--quality", "best"],
        vec!["render", &skirt, "-o", "x.png", "--background", "green"],
        vec!["render", &skirt, "-o", "x.png", "--field", "1mm"],
        vec!["render", &skirt, "-o", "x.png", "--turn", "400deg"],
        vec!["render", &skirt, "-o", "x.png", "--turntable", "1"],
        vec!["render", &skirt, "-o", "x.png", "--passes", "heat"],
        vec!["drape", &skirt, "-o", "x.fbx"],
        vec!["drape", &skirt, "-o", "x.glb", "--resolution", "5"],
        vec!["check", &skirt, "--name", "trousers", "--nonsense"],
        vec!["compile", &skirt, "-o", "out", "--name", "trousers"],
        vec!["check", "README.md"],
    ] {
        let output = darzi(folder.path(), &call);
        assert_eq!(code(&output), 2, "{call:?}: {}", told(&output));
        assert!(!told(&output).is_empty());
    }
    assert_eq!(files(folder.path()), Vec::<PathBuf>::new());
}

#[test]
fn a_wrong_file_ends_with_1_and_every_mistake_has_its_place() {
    let folder = tempfile::tempdir().unwrap();
    let text = "\
scene wrong {
    cloth c of cottn { size: 1m x 1m }
    solid ball { shape: sphere radius 25 }
    drape { settle until speed < 2mm }
}
";
    std::fs::write(folder.path().join("wrong.garment"), text).unwrap();
    let human = darzi(folder.path(), &["render", "wrong.garment", "-o", "x.png"]);
    assert_eq!(code(&human), 1, "{}", told(&human));
    let places = ["wrong.garment:2:", "wrong.garment:3:", "wrong.garment:4:"].map(|place| {
        told(&human).find(place).unwrap_or_else(|| panic!("no {place} in the report"))
    });
    assert!(places.is_sorted(), "in the order of the text:\n{}", told(&human));
    assert!(told(&human).contains("`cotton`"), "the likely word is named");
    let json = darzi(folder.path(), &["check", "wrong.garment", "--message-format", "json"]);
    assert_eq!(code(&json), 1);
    let messages: Vec<serde_json::Value> = told(&json)
        .lines()
        .map(|line| serde_json::from_str(line).expect("a line of JSON"))
        .collect();
    assert!(messages.len() >= 3);
    assert!(messages.is_sorted_by_key(|message| message["labels"][0]["start"].as_u64()));
    for message in messages {
        assert!(message["code"].as_str().is_some_and(|c| c.starts_with('E')));
        assert!(message["labels"][0]["line"].as_u64().is_some_and(|n| n >= 1));
    }
    let absent = darzi(folder.path(), &["check", "absent.garment"]);
    assert_eq!(code(&absent), 1);
    assert!(told(&absent).contains("E0903"));
    assert_eq!(files(folder.path()), [folder.path().join("wrong.garment")]);
}

#[test]
fn the_same_source_compiles_to_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let skirt = example("a_line_skirt.garment");
    for (out, threads) in [("a", "1"), ("b", "2")] {
        let output = Command::new(env!("CARGO_BIN_EXE_darzi"))
            .args(["compile", &skirt, "-o", out])
            .current_dir(folder.path())
            .env("RAYON_NUM_THREADS", threads)
            .output()
            .unwrap();
        assert_eq!(code(&output), 0, "{}", told(&output));
    }
    for file in ["mesh.json", "atlas.png"] {
        let [a, b] =
            ["a", "b"].map(|out| std::fs::read(folder.path().join(out).join(file)).unwrap());
        assert!(!a.is_empty() && a == b, "{file} differs from run to run");
    }
}

#[test]
fn a_drape_is_kept_told_and_the_same_on_any_number_of_threads() {
    let folder = tempfile::tempdir().unwrap();
    let cloth = example("handkerchief.garment");
    let call = |out: &str, threads: &str, extra: &[&str]| {
        let mut call =
            vec!["drape", &cloth, "-o", out, "--resolution", "25mm", "--threads", threads];
        call.extend(extra);
        let output = darzi(folder.path(), &call);
        assert_eq!(code(&output), 0, "{}", told(&output));
        assert!(output.stdout.is_empty() && output.stderr.is_empty(), "quiet in a pipe");
        std::fs::read(folder.path().join(out)).unwrap()
    };
    let one = call("one.glb", "1", &["--no-cache", "--stats", "one.json"]);
    assert!(!folder.path().join("cache").exists(), "--no-cache keeps nothing");
    let two = call("two.glb", "2", &[]);
    let known = call("known.glb", "2", &[]);
    assert!(one == two && two == known);
    let stats: serde_json::Value =
        serde_json::from_slice(&std::fs::read(folder.path().join("one.json")).unwrap()).unwrap();
    for figure in [
        "particles",
        "triangles",
        "seam_pairs",
        "threads",
        "seconds",
        "steps",
        "largest_warp_strain",
        "largest_weft_strain",
        "mean_warp_strain",
        "mean_weft_strain",
        "largest_seam_gap",
        "deepest_penetration",
        "self_intersections",
        "largest_speed",
        "verdict",
    ] {
        assert!(!stats[figure].is_null(), "{figure} is missing");
    }
    assert_eq!(stats["threads"], 1);
    assert_eq!(stats["verdict"], "settled");
}

#[test]
fn a_condition_that_is_not_met_ends_with_3_and_its_reason() {
    let folder = tempfile::tempdir().unwrap();
    let text = "\
scene hasty {
    cloth c of cotton { size: 20cm x 20cm  grid: 10 x 10  at: (0, 1m, 0)  facing: up }
    solid ball { shape: sphere radius 5cm  at: (0, 0, 0) }
    drape { settle until speed < 1mm/s within 0.2s }
}
";
    std::fs::write(folder.path().join("hasty.garment"), text).unwrap();
    let output =
        darzi(folder.path(), &["drape", "hasty.garment", "-o", "x.obj", "--stats", "s.json"]);
    assert_eq!(code(&output), 3, "{}", told(&output));
    assert!(told(&output).contains("E0803"), "{}", told(&output));
    assert!(told(&output).contains("the drape did not reach what the file asks: not at rest"));
    let stats = std::fs::read_to_string(folder.path().join("s.json")).unwrap();
    assert!(stats.contains("\"reason\": \""));
}

const UNTIDY: &str = "scene s{cloth c of cotton{size:1m x 1m}}\n";
const TIDY: &str = "scene s { cloth c of cotton { size: 1m x 1m } }\n";

#[test]
fn files_and_folders_are_formatted_and_checked() {
    let folder = tempfile::tempdir().unwrap();
    let write = |path: &str, text: &str| std::fs::write(folder.path().join(path), text).unwrap();
    let read = |path: &str| std::fs::read_to_string(folder.path().join(path)).unwrap();
    std::fs::create_dir_all(folder.path().join("all/deep")).unwrap();
    std::fs::create_dir_all(folder.path().join("all/.hidden")).unwrap();
    write("a.garment", UNTIDY);
    for path in ["all/b.garment", "all/deep/c.garment", "all/.hidden/d.garment", "all/e.txt"] {
        write(path, UNTIDY);
    }
    write("all/tidy.garment", TIDY);

    let check = darzi(folder.path(), &["fmt", "--check", "a.garment", "all"]);
    assert_eq!(code(&check), 1);
    let said = String::from_utf8_lossy(&check.stdout);
    for line in
        ["a.garment:1", "all/b.garment:1", "all/deep/c.garment:1", "  - scene s{", "  + scene s {"]
    {
        assert!(said.contains(line), "{line} is missing in\n{said}");
    }
    assert!(!said.contains("tidy") && !said.contains("hidden"), "{said}");
    assert_eq!(read("a.garment"), UNTIDY, "--check writes nothing");

    let done = darzi(folder.path(), &["fmt", "a.garment", "all"]);
    assert_eq!(code(&done), 0, "{}", told(&done));
    assert!(done.stdout.is_empty() && done.stderr.is_empty());
    for (path, text) in [
        ("a.garment", TIDY),
        ("all/b.garment", TIDY),
        ("all/deep/c.garment", TIDY),
        ("all/tidy.garment", TIDY),
        ("all/.hidden/d.garment", UNTIDY),
        ("all/e.txt", UNTIDY),
    ] {
        assert_eq!(read(path), text, "{path}");
    }
    assert_eq!(code(&darzi(folder.path(), &["fmt", "--check", "a.garment", "all"])), 0);
}

#[test]
fn a_file_with_mistakes_in_its_shape_is_left_alone() {
    let folder = tempfile::tempdir().unwrap();
    let broken = "scene s{ size: 3 cm\n";
    std::fs::write(folder.path().join("broken.garment"), broken).unwrap();
    std::fs::write(folder.path().join("other.garment"), UNTIDY).unwrap();
    let output = darzi(
        folder.path(),
        &["fmt", "--message-format", "short", "broken.garment", "other.garment"],
    );
    assert_eq!(code(&output), 1);
    assert!(told(&output).contains("broken.garment:1:16: E0102: "), "{}", told(&output));
    let read = |path: &str| std::fs::read_to_string(folder.path().join(path)).unwrap();
    assert_eq!(read("broken.garment"), broken);
    assert_eq!(read("other.garment"), TIDY, "the others are formatted all the same");
    for call in [&["fmt"][..], &["fmt", "--stdin", "other.garment"], &["fmt", "README.md"]] {
        assert_eq!(code(&darzi(folder.path(), call)), 2, "{call:?}");
    }
    assert_eq!(code(&darzi(folder.path(), &["fmt", "absent.garment"])), 1);
    std::fs::create_dir(folder.path().join("empty")).unwrap();
    assert_eq!(code(&darzi(folder.path(), &["fmt", "empty"])), 2);
}

#[cfg(unix)]
#[test]
fn a_formatted_file_keeps_its_rights_and_its_link() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("a.garment");
    std::fs::write(&file, UNTIDY).unwrap();
    std::fs::set_permissions(&file, PermissionsExt::from_mode(0o640)).unwrap();
    symlink("a.garment", folder.path().join("link.garment")).unwrap();
    assert_eq!(code(&darzi(folder.path(), &["fmt", "link.garment"])), 0);
    assert_eq!(std::fs::read_to_string(&file).unwrap(), TIDY);
    assert_eq!(std::fs::metadata(&file).unwrap().permissions().mode() & 0o777, 0o640);
    assert!(folder.path().join("link.garment").is_symlink());

    std::fs::write(&file, UNTIDY).unwrap();
    std::fs::set_permissions(&file, PermissionsExt::from_mode(0o440)).unwrap();
    assert_eq!(code(&darzi(folder.path(), &["fmt", "a.garment"])), 2);
    assert_eq!(std::fs::read_to_string(&file).unwrap(), UNTIDY);
}

#[test]
fn standard_input_is_formatted_to_standard_output() {
    let pipe = |text: &[u8], arguments: &[&str]| {
        let mut child = Command::new(env!("CARGO_BIN_EXE_darzi"))
            .args(arguments)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        child.stdin.take().unwrap().write_all(text).unwrap();
        child.wait_with_output().unwrap()
    };
    let output = pipe(UNTIDY.as_bytes(), &["fmt", "--stdin"]);
    assert_eq!((code(&output), output.stdout.as_slice()), (0, TIDY.as_bytes()));
    let output = pipe(TIDY.as_bytes(), &["fmt", "--stdin", "--check"]);
    assert_eq!((code(&output), output.stdout.len()), (0, 0));
    let output = pipe(UNTIDY.as_bytes(), &["fmt", "--stdin", "--check"]);
    assert!(code(&output) == 1 && output.stdout.starts_with(b"<stdin>:1\n"));
    let output = pipe(b"a }", &["fmt", "--stdin"]);
    assert!(code(&output) == 1 && output.stdout.is_empty() && told(&output).contains("E0106"));
    let output = pipe(b"a \xff", &["fmt", "--stdin"]);
    assert!(code(&output) == 1 && told(&output).contains("E0903"));
}

#[test]
fn short_messages_are_one_line_each() {
    let folder = tempfile::tempdir().unwrap();
    let text = "scene wrong {\n    cloth c of cottn { size: 1m x 1m }\n    solid b { shape: sphere radius 25 }\n}\n";
    std::fs::write(folder.path().join("wrong.garment"), text).unwrap();
    let output = darzi(folder.path(), &["check", "wrong.garment", "--message-format", "short"]);
    assert_eq!(code(&output), 1);
    let lines: Vec<String> = told(&output).lines().map(str::to_owned).collect();
    assert!(lines[0].starts_with("wrong.garment:2:16: E0201: "), "{lines:?}");
    assert!(lines[1].starts_with("wrong.garment:3:36: E0302: "), "{lines:?}");
    assert_eq!(lines.len(), 2);
}

#[test]
fn codes_are_explained() {
    let folder = tempfile::tempdir().unwrap();
    let said = |arguments: &[&str]| {
        let output = darzi(folder.path(), arguments);
        let text = String::from_utf8_lossy(&output.stdout).into_owned() + &told(&output);
        (code(&output), text)
    };
    let (end, page) = said(&["explain", "e0501"]);
    assert_eq!(end, 0);
    assert!(page.starts_with("E0501: lengths of a seam that do not agree\n"), "{page}");
    assert!(page.contains("\nWrong:\n\n    garment") && page.contains("\nRight:\n"), "{page}");
    let (end, list) = said(&["explain"]);
    assert_eq!(end, 0);
    assert_eq!(list.lines().count(), darzi::diagnostic::codes::CODES.len());
    assert!(list.lines().any(|line| line == "E0102  a unit stands apart from its number"));
    let (end, why) = said(&["explain", "E0571"]);
    assert!(end == 2 && why.contains("did you mean E0501?"), "{why}");
    let (end, why) = said(&["explain", "seams"]);
    assert!(end == 2 && why.contains("did you mean seam? `darzi explain` lists all"), "{why}");

    let (end, words) = said(&["explain", "width"]);
    assert_eq!(end, 0);
    assert_eq!(
        words,
        "width: LENGTH\n    in a fabric: width of the roll =150cm\n\n\
         width: LENGTH\n    in an ang, a kath, a padar: across the part, for a kath\n"
    );
    let (_, words) = said(&["explain", "meet"]);
    assert!(words.starts_with("meet(P, ANGLE, Q, ANGLE)"), "{words}");

    std::fs::write(folder.path().join("a.garment"), "let a = 3 cm\n").unwrap();
    let (end, report) = said(&["check", "a.garment"]);
    assert!(end == 1 && report.ends_with("`darzi explain E0102` says more\n"), "{report}");
}

const SKIRT: &str = "garment skirt {
    param length = 60cm in 40cm..90cm
    wearer lady = female { size: EU 38 }
    grade: EU 38, EU 46
    panel front of denim {
        fit wide in 30cm..60cm until waist.length = (lady.waist + 2cm) / 2
        grid: 2cm
        outline from (0, 0) {
            waist: line to (wide, 0)
            side: line by (0, -length)
            hem: line to (0, -length)
            other: line to start
        }
    }
    panel back = front
    seam front.side -> back.side
    seam front.other -> back.other zip 18cm from waist
    place front before lady.waist
    place back behind lady.waist
}
";

/// One text, a mesh for each size; what is wrong in one size only is told with its name.
#[test]
fn a_garment_is_cut_in_all_its_sizes() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("skirt.garment");
    std::fs::write(&file, SKIRT).unwrap();
    let call = |arguments: &[&str]| darzi(folder.path(), arguments);
    let made = call(&["compile", "skirt.garment", "-o", "out", "--grade"]);
    assert_eq!(code(&made), 0, "{}", told(&made));
    let own = call(&["compile", "skirt.garment", "-o", "own", "--for", "EU  46"]);
    assert_eq!(code(&own), 0, "{}", told(&own));
    let read = |path: &str| std::fs::read(folder.path().join(path)).unwrap();
    assert_eq!(read("own/mesh.json"), read("out/EU-46/mesh.json"));
    assert_ne!(read("out/EU-38/mesh.json"), read("out/EU-46/mesh.json"));

    // 88 cm and 2 cm are more than the range of the fit allows.
    std::fs::write(&file, SKIRT.replace("30cm..60cm", "30cm..44cm")).unwrap();
    let checked = call(&["check", "skirt.garment", "--message-format", "short"]);
    assert_eq!(code(&checked), 1);
    assert_eq!(told(&checked).lines().count(), 1, "{}", told(&checked));
    assert!(
        told(&checked).contains("E0405") && told(&checked).contains("in size EU 46: no `wide`")
    );
    assert_eq!(code(&call(&["check", "skirt.garment", "--for", "EU 38"])), 0);
    let unknown = call(&["check", "skirt.garment", "--for", "EU 47"]);
    assert!(told(&unknown).contains("E0305") && code(&unknown) == 1);

    std::fs::write(&file, SKIRT.replace("grade: EU 38, EU 46", "")).unwrap();
    assert_eq!(code(&call(&["compile", "skirt.garment", "-o", "out", "--grade"])), 2);
}

/// Figures kept beside a text: new, as expected, changed, wrong.
#[test]
fn collections_are_tested_against_the_figures_that_are_kept() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    let test = |arguments: &[&str]| {
        let output = darzi(folder.path(), &[&["test"], arguments].concat());
        (code(&output), String::from_utf8(output.stdout).unwrap())
    };
    write("b_skirt.garment", SKIRT);
    write("a_cloth.garment", "fabric cloth = cotton with { friction: 0.4 }");
    write("c_warned.garment", "//~ E0201\nlet x = y");
    let (ends, said) = test(&[]);
    assert_eq!(ends, 1);
    assert_eq!(
        said,
        "ok       ./a_cloth.garment
new      ./b_skirt.garment: nothing is kept to compare it with
ok       ./c_warned.garment
2 as expected, 1 new
`darzi test --accept` keeps the figures as they are now
"
    );
    assert_eq!(test(&["--accept"]).0, 0);
    assert_eq!(test(&[]).0, 0);
    let kept = std::fs::read_to_string(folder.path().join("b_skirt.expected.json")).unwrap();
    assert!(kept.contains("\"waist\": 37.0"), "{kept}");
    assert!(kept.contains("\"lengths_cm\": [60.0, 60.0]"), "{kept}");

    write("b_skirt.garment", &SKIRT.replace("length = 60cm", "length = 62cm"));
    let (ends, said) = test(&["b_skirt.garment"]);
    assert_eq!(ends, 1);
    for line in [
        "skirt: front.side 60 → 62 cm (+2)",
        "skirt: front, area 2220 → 2294 cm² (+74)",
        "skirt: seam front.side -> back.side: 60 to 60 cm, ease 0 mm → 62 to 62 cm, ease 0 mm",
        "skirt in EU 46: 9 figures changed",
    ] {
        assert!(said.contains(line), "{line} in\n{said}");
    }
    write("b_skirt.garment", &SKIRT.replace("denim", "denin"));
    write("c_warned.garment", "//~ E0201\nlet x = 3cm");
    let (ends, said) = test(&[]);
    assert_eq!(ends, 1);
    assert!(said.contains("did you mean `denim`?") && said.contains("E0201 is expected, nothing"));
    assert_eq!(test(&["nowhere"]).0, 2);
    let kept_again = std::fs::read_to_string(folder.path().join("b_skirt.expected.json")).unwrap();
    assert_eq!(kept, kept_again, "nothing is accepted unasked");
}

#[test]
fn a_fabric_is_shown_in_the_units_of_its_instruments() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(
        folder.path().join("suit.garment"),
        "/// A suiting from its FAST sheet.\nfabric suiting {\n    structure: twill_2_2\n    fast {\n        \
         C: 20mm, 18mm\n        W: 200g/m2\n        EB5: 4.1%\n        E20: 1%, 2%\n    }\n}\n",
    )
    .unwrap();
    let said = |call: &[&str]| {
        let output = darzi(folder.path(), call);
        (code(&output), String::from_utf8_lossy(&output.stdout).into_owned(), told(&output))
    };
    let (end, list, _) = said(&["fabric", "list", "suit.garment"]);
    assert_eq!(end, 0);
    assert!(list.starts_with("suiting"), "{list}");
    assert!(list.lines().any(|line| line.starts_with("denim")), "{list}");

    let (end, json, _) = said(&["fabric", "show", "suiting", "suit.garment", "--json"]);
    assert_eq!(end, 0);
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    let bending = &json["measures"]["bending rigidity"];
    assert_eq!(bending["from"], "fast");
    let near = |value: &serde_json::Value, wanted: f64| {
        let value = value.as_f64().unwrap();
        assert!((value / wanted - 1.0).abs() < 1e-9, "{value} is not {wanted}");
    };
    // B = W g C³, and back to C.
    near(&bending["in"][0]["warp"], 0.2 * 9.80665 * 8e-6);
    near(&bending["in"][0]["weft"], 0.2 * 9.80665 * 5.832e-6);
    near(&bending["in"][1]["warp"], 0.2 * 9.80665 * 8e-6 / 9.80665e-5);
    near(&bending["in"][3]["warp"], 20.0);
    // G = 123 / EB5, in gf/cm/deg.
    near(
        &json["measures"]["shear stiffness"]["in"][1]["value"],
        30.0 / (0.980665 * 180.0 / std::f64::consts::PI),
    );
    // 19.6133 N/m at 1 % and at 2 %.
    near(&json["measures"]["tension per strain"]["in"][0]["weft"], 19.6133 / 0.02);
    assert_eq!(json["measures"]["friction"]["from"], "assumed");
    assert_eq!(json["readings"].as_array().unwrap().len(), 4);

    let (end, table, _) = said(&["fabric", "convert", "B=0.134gf.cm2/cm", "W=20mg/cm2"]);
    assert_eq!(end, 0);
    assert!(table.contains("1.314e-5") && table.contains("18.85"), "{table}");
    assert!(!table.contains("assumed"), "only what follows from the rows: {table}");
    let (end, _, why) = said(&["fabric", "convert", "C=18.5mm", "W=213.8g/m2"]);
    assert_eq!(end, 0, "a bending length and a mass are enough: {why}");

    let (end, _, why) = said(&["fabric", "convert", "B=1mm"]);
    assert!(end == 1 && why.contains("E0302"), "{why}");
    let (end, _, why) = said(&["fabric", "convert", "LT=0.6"]);
    assert!(end == 2 && why.contains("nothing follows"), "{why}");
    let (end, _, why) = said(&["fabric", "show", "woool"]);
    assert!(end == 2 && why.contains("did you mean `wool`?"), "{why}");
}

#[test]
fn a_fabric_is_tested_as_in_a_laboratory() {
    let folder = tempfile::tempdir().unwrap();
    let call = ["fabric", "test", "cantilever", "wool", "--resolution", "4mm", "--json"];
    let output = darzi(folder.path(), &call);
    assert_eq!(code(&output), 0, "{}", told(&output));
    let json: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    for strip in json["strips"].as_array().unwrap() {
        let [found, given] = ["rigidity", "given"].map(|key| strip[key].as_f64().unwrap());
        // Coarser than by itself: some nine cells of overhang.
        assert!((found / given - 1.0).abs() < 0.05, "{strip}");
    }
    let wrong = ["fabric", "test", "cusick", "wool", "--specimen", "31cm"];
    let output = darzi(folder.path(), &wrong);
    assert!(
        code(&output) == 2 && told(&output).contains("24cm, 30cm or 36cm"),
        "{}",
        told(&output)
    );
    let wrong = ["fabric", "test", "cantilever", "wool", "-o", "wool.jpg"];
    assert_eq!(code(&darzi(folder.path(), &wrong)), 2);
}
