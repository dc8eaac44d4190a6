//! What is shown of a text: messages, values, figures, symbols, colours, its layout.

use crate::client::{Client, examples, marked};
use serde_json::{Value, json};

const SKIRT: &str = "garment skirt {
    /// wearing ease at the waist
    param ease = 2cm in 0cm..6cm
    wearer lady = female { size: EU 38 }
    let quarter = (lady.waist + ease) / 4
    panel front of denim {
        outline from (0, 0) {
            waist: line to (quarter, 0)
            side:  line to (quarter + 6cm, -50cm)
            hem:   line to (0, -50cm)
            fold:  line to start
        }
        shaping: dart on waist at 50% width 2cm depth 9cm
        unfold across fold
    }
    panel back = front with { shaping: dart on waist at 45% width 3cm depth 10cm }
    seam front.side -> back.side
    place front.waist before lady.waist
    place back.waist behind lady.waist
}
";

/// The text of a hover over the mark.
fn hover(client: &mut Client, text: &str) -> String {
    let (text, place) = marked(text);
    client.change("skirt.garment", &text);
    let found = client.at("textDocument/hover", "skirt.garment", place);
    found["contents"]["value"].as_str().unwrap_or("").to_owned()
}

/// The text with a mark behind the first `before` that stands in front of `after`.
fn mark(before: &str, after: &str) -> String {
    let whole = format!("{before}{after}");
    assert!(SKIRT.contains(&whole), "{whole}");
    SKIRT.replacen(&whole, &format!("{before}§{after}"), 1)
}

#[test]
fn names_show_what_they_are_worth() {
    let mut client = Client::start(&[]);
    assert_eq!(client.open("skirt.garment", SKIRT), Vec::<Value>::new());
    let ease = hover(&mut client, &mark("(lady.waist + ea", "se)"));
    assert!(ease.contains("param ease = 2cm in 0cm..6cm"), "{ease}");
    assert!(ease.contains("**2 cm**") && ease.contains("wearing ease at the waist"), "{ease}");
    let waist = hover(&mut client, &mark("(lady.wai", "st + ease"));
    assert!(waist.contains("`lady.waist` = **72 cm**"), "{waist}");
    let quarter = hover(&mut client, &mark("let quar", "ter"));
    assert!(quarter.contains("value `quarter` = **18.5 cm**"), "{quarter}");
    // An edge is told as sewn and as cut, unfolded; the copy has a wider dart.
    let edge = hover(&mut client, &mark("place front.wa", "ist"));
    assert!(edge.contains("edge `waist`"), "{edge}");
    assert!(edge.contains("**front 33 cm (37 cm flat), back 31 cm (37 cm flat)**"), "{edge}");
    let denim = hover(&mut client, &mark("front of den", "im"));
    assert!(denim.contains("fabric `denim`") && denim.contains("from `std::fabric`"), "{denim}");
}

#[test]
fn words_show_their_usage() {
    let mut client = Client::start(&[]);
    client.open("skirt.garment", SKIRT);
    let dart = hover(&mut client, &mark("shaping: da", "rt on waist at 50%"));
    assert!(dart.contains("```garment\ndart ") && dart.contains("a wedge"), "{dart}");
    let width = hover(&mut client, &mark("at 50% wid", "th"));
    assert!(width.contains("a wedge"), "{width}");
    let param = hover(&mut client, &mark("par", "am ease"));
    assert!(param.contains("its default and what it may lie in"), "{param}");
    let number = hover(&mut client, &SKIRT.replacen("6cm, -50cm", "12i§n, -50cm", 1));
    assert!(number.contains("a length = **30.48 cm**"), "{number}");
}

#[test]
fn messages_stand_at_their_places_and_go_when_it_is_put_right() {
    let mut client = Client::start(&[]);
    let wrong = SKIRT.replacen("width 2cm", "widht 2cm", 1);
    let told = client.open("skirt.garment", &wrong);
    assert_eq!(told.len(), 1, "{told:#?}");
    assert_eq!(told[0]["code"], "E0203");
    assert_eq!(told[0]["source"], "darzi");
    assert_eq!(told[0]["range"]["start"], json!({ "line": 12, "character": 38 }));
    assert!(told[0]["message"].as_str().unwrap().contains("did you mean `width`?"));
    assert_eq!(client.change("skirt.garment", SKIRT), Vec::<Value>::new());
    // A message that speaks of two places names the other one.
    let clash = SKIRT.replacen("let quarter =", "let ease = 1cm\n    let quarter =", 1);
    let told = client.change("skirt.garment", &clash);
    assert_eq!(told[0]["code"], "E0205");
    assert_eq!(told[0]["relatedInformation"].as_array().unwrap().len(), 1);
}

#[test]
fn a_message_brings_its_remedy() {
    let mut client = Client::start(&[]);
    let wrong = SKIRT.replacen("width 2cm", "widht 2cm", 1);
    client.open("skirt.garment", &wrong);
    let params = json!({
        "textDocument": { "uri": client.uri("skirt.garment") },
        "range": {
            "start": { "line": 12, "character": 40 }, "end": { "line": 12, "character": 40 }
        },
        "context": { "diagnostics": [] },
    });
    let found = client.ask("textDocument/codeAction", params).unwrap();
    assert_eq!(found[0]["title"], "write `width`");
    assert_eq!(found[0]["kind"], "quickfix");
    let edit = &found[0]["edit"]["changes"][client.uri("skirt.garment")][0];
    assert_eq!(edit["newText"], "width");
    assert_eq!(edit["range"]["start"], json!({ "line": 12, "character": 38 }));
    assert_eq!(edit["range"]["end"], json!({ "line": 12, "character": 43 }));
}

#[test]
fn a_seam_that_differs_can_be_eased() {
    let mut client = Client::start(&[]);
    let wrong = SKIRT.replacen(
        "shaping: dart on waist at 45% width 3cm depth 10cm",
        "side: line to (quarter + 6cm, -51cm)",
        1,
    );
    let told = client.open("skirt.garment", &wrong);
    let seam = told.iter().find(|told| told["code"] == "E0501").expect("a seam that differs");
    let params = json!({
        "textDocument": { "uri": client.uri("skirt.garment") },
        "range": seam["range"],
        "context": { "diagnostics": [] },
    });
    let found = client.ask("textDocument/codeAction", params).unwrap();
    let edit = &found[0]["edit"]["changes"][client.uri("skirt.garment")][0];
    assert_eq!(edit["newText"], " ease 1cm", "{found:#}");
    let line = wrong.lines().position(|line| line.contains("seam front.side")).unwrap();
    assert_eq!(edit["range"]["start"]["line"], line);
}

#[test]
fn lengths_stand_beside_edges_and_seams() {
    let mut client = Client::start(&[]);
    client.open("skirt.garment", &SKIRT.replacen("-> back.side", "-> back.side ease 5mm", 1));
    let params = json!({
        "textDocument": { "uri": client.uri("skirt.garment") },
        "range": { "start": { "line": 0, "character": 0 }, "end": { "line": 99, "character": 0 } },
    });
    let found = client.ask("textDocument/inlayHint", params).unwrap();
    let hints: Vec<(u64, String)> = found
        .as_array()
        .unwrap()
        .iter()
        .map(|hint| {
            let label = hint["label"].as_str().unwrap().to_owned();
            (hint["position"]["line"].as_u64().unwrap(), label)
        })
        .collect();
    let on = |line| hints.iter().find(|(at, _)| *at == line).map(|(_, said)| said.as_str());
    assert_eq!(on(8), Some("50.36 cm"), "{hints:?}");
    assert_eq!(on(9), Some("49 cm"), "{hints:?}");
    assert_eq!(on(16), Some("50.36 cm"), "{hints:?}");
    assert!(on(7).unwrap().starts_with("front "), "{hints:?}");
}

#[test]
fn the_layout_is_one_edit_and_a_broken_text_is_left_alone() {
    let mut client = Client::start(&[]);
    client.open("a.garment", "let a = 1\nlet   b=2\nlet c = 3\n");
    let params = json!({ "textDocument": { "uri": client.uri("a.garment") }, "options": {
        "tabSize": 4, "insertSpaces": true } });
    let found = client.ask("textDocument/formatting", params.clone()).unwrap();
    assert_eq!(found.as_array().unwrap().len(), 1);
    assert_eq!(found[0]["newText"], "let b = 2\n");
    assert_eq!(found[0]["range"]["start"]["line"], 1);
    assert_eq!(found[0]["range"]["end"], json!({ "line": 2, "character": 0 }));
    client.change("a.garment", "let a = (\n");
    assert_eq!(client.ask("textDocument/formatting", params).unwrap(), json!([]));
}

#[test]
fn symbols_are_nested_as_the_blocks_are() {
    fn names(symbols: &Value) -> Vec<String> {
        let list = symbols.as_array().into_iter().flatten();
        list.flat_map(|symbol| {
            let name = symbol["name"].as_str().unwrap().to_owned();
            let inner = names(&symbol["children"]);
            std::iter::once(name.clone())
                .chain(inner.into_iter().map(move |inner| format!("{name}/{inner}")))
        })
        .collect()
    }
    let mut client = Client::start(&[]);
    client.open("skirt.garment", SKIRT);
    let params = json!({ "textDocument": { "uri": client.uri("skirt.garment") } });
    let found = names(&client.ask("textDocument/documentSymbol", params).unwrap());
    for name in [
        "skirt",
        "skirt/ease",
        "skirt/lady",
        "skirt/front",
        "skirt/front/outline/waist",
        "skirt/front/shaping",
        "skirt/back",
    ] {
        assert!(found.contains(&name.to_owned()), "{name}: {found:#?}");
    }
}

#[test]
fn words_are_coloured_by_what_they_mean() {
    let mut client = Client::start(&[]);
    let legend = &client.begun["capabilities"]["semanticTokensProvider"]["legend"]["tokenTypes"];
    let legend: Vec<String> =
        legend.as_array().unwrap().iter().map(|t| t.as_str().unwrap().to_owned()).collect();
    let mut seen = Vec::new();
    for (name, text) in
        examples().into_iter().chain([("skirt.garment".to_owned(), SKIRT.to_owned())])
    {
        client.open(&name, &text);
        let params = json!({ "textDocument": { "uri": client.uri(&name) } });
        let found = client.ask("textDocument/semanticTokens/full", params).unwrap();
        let data: Vec<u64> =
            found["data"].as_array().unwrap().iter().map(|n| n.as_u64().unwrap()).collect();
        let lines: Vec<Vec<u16>> =
            text.split('\n').map(|line| line.encode_utf16().collect()).collect();
        let (mut line, mut column) = (0, 0);
        for token in data.chunks(5) {
            column = if token[0] > 0 { token[1] } else { column + token[1] };
            line += token[0];
            let units = &lines[line as usize][column as usize..(column + token[2]) as usize];
            let word = String::from_utf16(units).unwrap();
            assert_eq!(word.trim(), word, "{name}: a token with blanks");
            seen.push((name.clone(), word, legend[token[3] as usize].clone()));
        }
    }
    let is = |word: &str, kind: &str| {
        seen.iter().any(|(name, w, k)| name == "skirt.garment" && w == word && k == kind)
    };
    for (word, kind) in [
        ("panel", "keyword"),
        ("front", "type"),
        ("ease", "parameter"),
        ("quarter", "variable"),
        ("2", "number"),
        ("cm", "unit"),
        ("waist", "property"),
        ("/// wearing ease at the waist", "comment"),
        ("depth", "keyword"),
    ] {
        assert!(is(word, kind), "{word} is no {kind}: {seen:#?}");
    }
}

#[test]
fn the_usage_line_marks_the_clause_in_hand() {
    let mut client = Client::start(&[]);
    let (text, place) = marked(&mark("at 50% width ", "2cm"));
    client.open("skirt.garment", &text);
    let found = client.at("textDocument/signatureHelp", "skirt.garment", place);
    let signature = &found["signatures"][0];
    assert!(signature["label"].as_str().unwrap().starts_with("dart "));
    let active = found["activeParameter"].as_u64().unwrap() as usize;
    assert_eq!(signature["parameters"][active]["label"], "width LENGTH");
    let (text, place) = marked("let a = between((0, 0), §");
    client.change("skirt.garment", &text);
    let found = client.at("textDocument/signatureHelp", "skirt.garment", place);
    assert_eq!(found["signatures"][0]["label"], "between(P, Q, 30%)");
    assert_eq!(found["activeParameter"], 1);
}
