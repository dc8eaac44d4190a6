//! Completion in whole and in broken texts.

use crate::client::{Client, marked};

const BEFORE: &str = "garment skirt {
    /// at the waist
    param ease = 2cm in 0cm..6cm
    wearer lady = female { size: EU 38 }
    place front.waist before lady.waist
    panel front of denim {
        let intake = 2cm
        outline from (0, 0) {
            waist: line to (18cm, 0)
            side:  line to (24cm, -50cm)
            hem:   line to (0, -50cm)
            fold:  line to start
        }
        unfold across fold
    }
";

/// What is offered at the mark in a text that begins with the skirt.
fn offered(client: &mut Client, rest: &str) -> Vec<String> {
    whole(client, &format!("{BEFORE}{rest}"))
}

fn whole(client: &mut Client, text: &str) -> Vec<String> {
    let (text, place) = marked(text);
    client.change("skirt.garment", &text);
    let found = client.at("textDocument/completion", "skirt.garment", place);
    let mut items: Vec<(String, String)> = found
        .as_array()
        .unwrap()
        .iter()
        .map(|item| {
            let text = |key: &str| item[key].as_str().unwrap_or("").to_owned();
            (text("sortText"), text("label"))
        })
        .collect();
    items.sort();
    items.into_iter().map(|(_, label)| label).collect()
}

fn has(found: &[String], wanted: &[&str]) {
    for word in wanted {
        assert!(found.iter().any(|label| label == word), "no `{word}` in {found:?}");
    }
}

fn lacks(found: &[String], unwanted: &[&str]) {
    for word in unwanted {
        assert!(!found.iter().any(|label| label == word), "`{word}` in {found:?}");
    }
}

fn client() -> Client {
    let mut client = Client::start(&[]);
    client.open("skirt.garment", BEFORE);
    client
}

#[test]
fn a_line_begins_with_the_words_of_its_block() {
    let mut client = client();
    let found = offered(&mut client, "    §\n}");
    has(&found, &["panel", "seam", "place", "drape", "picture", "let", "param"]);
    lacks(&found, &["dart", "use", "weft", "garment"]);
    let found = offered(&mut client, "    panel back of denim {\n        §\n    }\n}");
    has(&found, &["outline", "dart", "fabric", "grid", "rectangle"]);
    // The braces of the blocks around may be missing still.
    let found = offered(&mut client, "    panel back of denim {\n        da§");
    has(&found, &["dart"]);
    lacks(&found, &["seam"]);
    let found = whole(&mut client, "§");
    has(&found, &["garment", "fabric", "use", "scene"]);
}

#[test]
fn a_label_is_followed_by_an_action() {
    let mut client = client();
    let found = offered(&mut client, "    panel back of denim { shaping: §");
    has(&found, &["dart", "notch"]);
    lacks(&found, &["fabric", "intake"]);
}

#[test]
fn edges_and_halves_stand_behind_the_point_of_a_panel() {
    let mut client = client();
    let found = offered(&mut client, "    seam front.§");
    has(&found, &["waist", "side", "hem", "left", "right"]);
    lacks(&found, &["ease", "panel"]);
    has(&offered(&mut client, "    seam front.left.§\n}"), &["waist", "side"]);
    has(&offered(&mut client, "    seam front.(side + §\n}"), &["waist", "hem"]);
    has(&offered(&mut client, "    check front.side.§\n}"), &["length", "start", "at"]);
    // A panel with a mistake still has the names that stand in its outline.
    let broken = BEFORE.replacen("line to (24cm", "line tu (24cm", 1);
    has(&whole(&mut client, &format!("{broken}    seam front.§\n}}")), &["waist", "side"]);
}

#[test]
fn measures_stand_behind_the_point_of_a_wearer() {
    let mut client = client();
    let found = offered(&mut client, "    let w = lady.§\n}");
    has(&found, &["waist", "hip", "bust", "shoulder", "left_knee"]);
    lacks(&found, &["length", "ease"]);
}

#[test]
fn values_stand_behind_the_point_of_a_record() {
    let mut client = client();
    let text = "    let box = { wide: 12cm, deep: 3cm }\n    let a = box.§\n}\n";
    let found = offered(&mut client, text);
    has(&found, &["wide", "deep"]);
    lacks(&found, &["length", "x"]);
}

#[test]
fn the_library_is_offered_by_kind() {
    let mut client = client();
    let found = offered(&mut client, "    panel back of §");
    has(&found, &["denim", "cotton"]);
    lacks(&found, &["twill", "female", "ease", "sin"]);
    has(&whole(&mut client, "fabric a { structure: §"), &["herringbone"]);
    has(&whole(&mut client, "fabric a {\n    finish: §\n}"), &["matte", "satin"]);
    has(&offered(&mut client, "    wearer man = §"), &["female", "male"]);
    has(&whole(&mut client, "let a = std::§"), &["fabric", "weave", "body"]);
    has(&whole(&mut client, "let a = std::fabric::§"), &["denim"]);
}

#[test]
fn a_phrase_goes_on_with_its_words() {
    let mut client = client();
    let found = offered(&mut client, "    panel back of denim {\n        dart on waist §");
    has(&found, &["at", "width", "depth", "to"]);
    lacks(&found, &["on"]);
    let found = offered(&mut client, "    panel back = front with {\n        dart on §");
    assert!(
        found
            .first()
            .is_some_and(|first| ["waist", "side", "hem", "fold"].contains(&first.as_str())),
        "{found:?}"
    );
    has(&offered(&mut client, "    seam front.left.side -> front.right.side §"), &["ease", "zip"]);
    has(&offered(&mut client, "    seam front.side -> front.hem stitch §"), &["felled", "french"]);
}

#[test]
fn units_follow_a_number() {
    let mut client = client();
    let found = offered(&mut client, "    panel back of denim {\n        grid: 8§");
    assert!(["mm", "cm", "in", "um"].contains(&found[0].as_str()), "{found:?}");
    has(&found, &["mm", "cm", "deg", "%"]);
    has(&offered(&mut client, "    let a = 12c§"), &["cm"]);
    let found = whole(&mut client, "fabric a { bending: 1.3e-5§");
    assert_eq!(found[0], "N.m", "{found:?}");
}

#[test]
fn names_in_scope_are_offered_with_their_values() {
    let mut client = client();
    let (text, place) =
        marked(&format!("{BEFORE}    panel back of denim {{\n        let b = §\n    }}\n}}"));
    client.change("skirt.garment", &text);
    let found = client.at("textDocument/completion", "skirt.garment", place);
    let item = |name: &str| found.as_array().unwrap().iter().find(|item| item["label"] == name);
    assert_eq!(item("ease").unwrap()["detail"], "2 cm");
    assert!(item("front").is_some() && item("lady").is_some() && item("sin").is_some());
    // A name of another panel is not known here, and a new name is the writer's own.
    assert!(item("intake").is_none());
    assert_eq!(offered(&mut client, "    let §"), Vec::<String>::new());
}

#[test]
fn a_copy_is_offered_what_it_may_replace() {
    let mut client = client();
    let found = offered(&mut client, "    panel back = front with {\n        §\n    }\n}");
    has(&found, &["omit", "intake", "side", "dart"]);
}

#[test]
fn a_part_gives_away_its_names_and_sets_its_parameters() {
    let mut client = client();
    let block = "block cuff {
    param around: length
    param depth = 6cm in 2cm..12cm
    panel band { rectangle around x depth }
    seam band.start -> band.end
}
";
    let part =
        |rest: &str| format!("{block}garment g {{\n    wearer lady = female\n    {rest}\n}}");
    has(&whole(&mut client, &part("part a = §")), &["cuff"]);
    let found = whole(&mut client, &part("part a = cuff { § }"));
    has(&found, &["around", "depth"]);
    lacks(&found, &["band", "omit", "seam"]);
    let found = whole(&mut client, &part("part a = cuff { around: 20cm }; check a.§"));
    has(&found, &["band", "top", "bottom", "depth"]);
    lacks(&found, &["lady", "rectangle"]);
}

#[test]
fn nothing_is_offered_in_comments_and_strings() {
    let mut client = client();
    for rest in ["    // §", "    /// a §", "    let t = \"§", "    let t = \"a§b\""] {
        assert_eq!(offered(&mut client, rest), Vec::<String>::new(), "{rest}");
    }
}
