//! Names in several files: where they are declared, where they are used, new names for them.

use crate::client::{Client, marked};
use serde_json::{Value, json};

const CLOTHS: &str = "let wide = 12cm\nfabric twilled = denim with { width: wide }\n";

const SKIRT: &str = "use \"parts/cloths.garment\"::{twilled, wide}
garment skirt {
    panel front of twilled {
        outline from (0, 0) {
            waist: line to (wide, 0)
            side:  line to (wide, -50cm)
            hem:   line to (0, -50cm)
            fold:  line to start
        }
        notch on side at 50%
    }
    panel back = front with { side: line to (wide, -50cm) }
    seam front.side -> back.side
    seam front.fold -> back.fold
    place front at (0, 1m, 0)
    wearer lady = female { size: EU 38 }
}
";

fn client() -> Client {
    let mut client = Client::start(&[("parts/cloths.garment", CLOTHS), ("skirt.garment", SKIRT)]);
    assert_eq!(client.open("skirt.garment", SKIRT), Vec::<Value>::new());
    client
}

fn place(before: &str, after: &str) -> (u64, u64) {
    let whole = format!("{before}{after}");
    marked(&SKIRT.replacen(&whole, &format!("{before}§{after}"), 1)).1
}

/// `file:line:column` of every location.
fn shown(client: &Client, locations: &Value) -> Vec<String> {
    let root = client.uri("");
    let mut found: Vec<String> = locations
        .as_array()
        .unwrap()
        .iter()
        .map(|l| {
            let uri = l["uri"].as_str().unwrap();
            let start = &l["range"]["start"];
            let file = uri.strip_prefix(&root).unwrap_or_else(|| uri.rsplit('/').next().unwrap());
            format!("{file}:{}:{}", start["line"], start["character"])
        })
        .collect();
    found.sort();
    found
}

#[test]
fn a_name_leads_to_where_it_is_declared() {
    let mut client = client();
    let found = client.at("textDocument/definition", "skirt.garment", place("seam front.si", "de"));
    assert_eq!(shown(&client, &found), ["skirt.garment:5:12"]);
    // The copy has a line of its own for this edge.
    let found = client.at("textDocument/definition", "skirt.garment", place("-> back.si", "de"));
    assert_eq!(shown(&client, &found), ["skirt.garment:11:30"]);
    let found =
        client.at("textDocument/definition", "skirt.garment", place("line to (wi", "de, 0)"));
    assert_eq!(shown(&client, &found), ["parts/cloths.garment:0:4"]);
    let found = client.at("textDocument/definition", "skirt.garment", place("\"parts", "/cloths"));
    assert_eq!(shown(&client, &found), ["parts/cloths.garment:0:0"]);
}

#[test]
fn a_name_of_the_library_leads_to_a_file_for_reading() {
    let mut client = client();
    client.open("parts/cloths.garment", CLOTHS);
    let (_, at) = marked("let wide = 12cm\nfabric twilled = den§im");
    let found = client.at("textDocument/definition", "parts/cloths.garment", at);
    let uri = found[0]["uri"].as_str().unwrap().to_owned();
    assert!(uri.ends_with("/fabric.garment"), "{uri}");
    let path = uri.strip_prefix("file://").unwrap();
    let text = std::fs::read_to_string(path).unwrap();
    assert!(std::fs::metadata(path).unwrap().permissions().readonly());
    // What is opened there is worked out like any document, and its names lead on.
    assert_eq!(client.open_uri(&uri, &text), Vec::<Value>::new());
    let line = text.lines().position(|line| line.starts_with("fabric denim")).unwrap();
    assert_eq!(found[0]["range"]["start"]["line"], line);
    let params = json!({
        "textDocument": { "uri": uri },
        "position": { "line": line, "character": 9 },
    });
    let hover = client.ask("textDocument/hover", params).unwrap();
    assert!(hover["contents"]["value"].as_str().unwrap().contains("denim"), "{hover}");
}

#[test]
fn uses_are_found_in_all_files() {
    let mut client = client();
    client.open("parts/cloths.garment", CLOTHS);
    let mut params = client.place("parts/cloths.garment", (0, 5));
    params["context"] = json!({ "includeDeclaration": true });
    let found = client.ask("textDocument/references", params.clone()).unwrap();
    let all = shown(&client, &found);
    assert_eq!(
        all,
        [
            "parts/cloths.garment:0:4",
            "parts/cloths.garment:1:37",
            "skirt.garment:0:38",
            "skirt.garment:11:45",
            "skirt.garment:4:28",
            "skirt.garment:5:28",
        ]
    );
    params["context"] = json!({ "includeDeclaration": false });
    let found = client.ask("textDocument/references", params.clone()).unwrap();
    assert_eq!(found.as_array().unwrap().len(), all.len() - 1);
    // A file that is not open is read from the disk.
    client.tell(
        "textDocument/didClose",
        json!({ "textDocument": { "uri": client.uri("skirt.garment") } }),
    );
    params["context"] = json!({ "includeDeclaration": true });
    let found = client.ask("textDocument/references", params).unwrap();
    assert_eq!(shown(&client, &found), all);
}

/// The text of a file after a rename.
fn renamed(
    client: &mut Client,
    at: (u64, u64),
    new: &str,
) -> Result<Vec<(String, String)>, String> {
    let mut params = client.place("skirt.garment", at);
    params["newName"] = json!(new);
    let found = client
        .ask("textDocument/rename", params)
        .map_err(|error| error["message"].as_str().unwrap().to_owned())?;
    let mut texts = Vec::new();
    for (name, text) in [("parts/cloths.garment", CLOTHS), ("skirt.garment", SKIRT)] {
        let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
        let mut edits: Vec<Value> =
            found["changes"][client.uri(name)].as_array().cloned().unwrap_or_default();
        edits.sort_by_key(|edit| {
            let start = &edit["range"]["start"];
            std::cmp::Reverse((start["line"].as_u64(), start["character"].as_u64()))
        });
        for edit in edits {
            let number =
                |end: &str, what: &str| edit["range"][end][what].as_u64().unwrap() as usize;
            let line = &mut lines[number("start", "line")];
            let range = number("start", "character")..number("end", "character");
            line.replace_range(range, edit["newText"].as_str().unwrap());
        }
        texts.push((name.to_owned(), lines.join("\n") + "\n"));
    }
    Ok(texts)
}

#[test]
fn an_edge_gets_a_new_name_with_the_lines_that_replace_it() {
    let mut client = client();
    let texts = renamed(&mut client, place("seam front.si", "de"), "flank").unwrap();
    assert_eq!(texts[0].1, CLOTHS);
    assert_eq!(texts[1].1, SKIRT.replace("side", "flank"));
    assert_eq!(client.change("skirt.garment", &texts[1].1), Vec::<Value>::new());
}

#[test]
fn a_parameter_gets_a_new_name_with_the_lines_that_set_it() {
    let text = "block cuff {
    param around: length
    panel band { rectangle around x 6cm }
}
garment g {
    wearer lady = female
    part a = cuff of denim { around: 20cm }
    place a.band around lady.left_wrist
}
";
    let mut client = client();
    assert_eq!(client.open("cuff.garment", text), Vec::<Value>::new());
    let mut params = client.place("cuff.garment", (6, 31));
    params["newName"] = json!("girth");
    let found = client.ask("textDocument/rename", params).unwrap();
    let edits = found["changes"][client.uri("cuff.garment")].as_array().unwrap();
    let mut lines: Vec<u64> =
        edits.iter().map(|edit| edit["range"]["start"]["line"].as_u64().unwrap()).collect();
    lines.sort_unstable();
    assert_eq!(lines, [1, 2, 6]);
}

#[test]
fn a_name_gets_a_new_one_in_all_files() {
    let mut client = client();
    let texts = renamed(&mut client, place("line to (wi", "de, 0)"), "breadth").unwrap();
    assert_eq!(texts[0].1, CLOTHS.replace("wide", "breadth"));
    assert_eq!(texts[1].1, SKIRT.replace("wide", "breadth"));
}

#[test]
fn a_new_name_that_would_not_work_is_refused() {
    let mut client = client();
    let at = place("seam front.si", "de");
    for (new, why) in
        [("hem", "would not work"), ("1side", "1side"), ("let", "word"), ("a b", ""), ("", "")]
    {
        let told = renamed(&mut client, at, new).unwrap_err();
        assert!(told.contains(why), "{new}: {told}");
    }
    // What belongs to the library keeps its name.
    client.open("parts/cloths.garment", CLOTHS);
    let (_, at) = marked("let wide = 12cm\nfabric twilled = den§im");
    let mut params = client.place("parts/cloths.garment", at);
    params["newName"] = json!("jeans");
    let told = client.ask("textDocument/rename", params).unwrap_err();
    assert!(told["message"].as_str().unwrap().contains("library"), "{told}");
}

#[test]
fn a_change_of_one_file_is_seen_in_those_that_use_it() {
    let mut client = client();
    client.open("parts/cloths.garment", CLOTHS);
    let uri = client.uri("parts/cloths.garment");
    client.edit(&uri, json!([{ "text": CLOTHS.replace("wide", "broad") }]));
    // The skirt does not find the name any more, though its own text did not change.
    let skirt = client.uri("skirt.garment");
    let mut told = client.problems_of_any_version(&skirt);
    while told.is_empty() {
        told = client.problems_of_any_version(&skirt);
    }
    assert_eq!(told[0]["code"], "E0901", "{told:#?}");
}

#[test]
fn a_weaving_file_is_read_and_its_mistakes_are_its_own() {
    const TEXT: &str = "weave serge { wif \"drafts/serge.wif\" }\n";
    let good = "[WIF]\n[WEAVING]\nShafts=2\nTreadles=2\n[WARP]\nThreads=2\n[WEFT]\nThreads=2\n\
                [THREADING]\n1=1\n2=2\n[LIFTPLAN]\n1=1\n2=2\n";
    let mut client = Client::start(&[("drafts/serge.wif", good), ("suit.garment", TEXT)]);
    assert_eq!(client.open("suit.garment", TEXT), Vec::<Value>::new());
    let (_, at) = marked("weave serge { wif \"drafts§/serge.wif\" }");
    let found = client.at("textDocument/definition", "suit.garment", at);
    assert_eq!(shown(&client, &found), ["drafts/serge.wif:0:0"]);
    let cut = good.split("[LIFTPLAN]").next().unwrap();
    let mut client = Client::start(&[("drafts/serge.wif", cut), ("suit.garment", TEXT)]);
    client.open("suit.garment", TEXT);
    let told = client.problems_of_any_version(&client.uri("drafts/serge.wif"));
    assert_eq!(told[0]["code"], "E0621", "{told:#?}");
}

#[test]
fn messages_of_a_file_that_is_not_open_are_told_too() {
    let mut client = Client::start(&[("a.garment", "let a = 1cm + 2deg\n")]);
    client.open("b.garment", "use \"a.garment\"::a\nlet b = a\n");
    let a = client.uri("a.garment");
    let told = client.problems_of_any_version(&a);
    assert_eq!(told[0]["code"], "E0301");
    let b = client.uri("b.garment");
    client.tell("textDocument/didClose", json!({ "textDocument": { "uri": b } }));
    assert_eq!(client.problems_of_any_version(&a), Vec::<Value>::new());
}
