//! How a session begins, goes on under odd clients, and ends.

use crate::client::Client;
use serde_json::{Value, json};

#[test]
fn a_session_begins_and_ends_as_the_protocol_wants_it() {
    let client = Client::start(&[]);
    assert_eq!(client.begun["serverInfo"]["name"], "darzi");
    let able = &client.begun["capabilities"];
    assert_eq!(able["positionEncoding"], "utf-16");
    for provider in [
        "hoverProvider",
        "definitionProvider",
        "referencesProvider",
        "renameProvider",
        "completionProvider",
        "signatureHelpProvider",
        "documentFormattingProvider",
        "documentSymbolProvider",
        "codeActionProvider",
        "inlayHintProvider",
        "semanticTokensProvider",
    ] {
        assert!(!able[provider].is_null(), "{provider}");
    }
    assert_eq!(client.end(), Some(0));
}

#[test]
fn columns_are_counted_as_the_client_asks() {
    let text = "let काठ = 1cm + 2deg\n";
    let column = |client: &mut Client| {
        let told = client.open("a.garment", text);
        assert_eq!(told[0]["code"], "E0301");
        told[0]["range"]["start"]["character"].as_u64().unwrap()
    };
    let mut client = Client::start(&[]);
    let units = column(&mut client);
    let offered = json!({ "general": { "positionEncodings": ["utf-8", "utf-16"] } });
    let mut client = Client::with(&[], offered);
    assert_eq!(client.begun["capabilities"]["positionEncoding"], "utf-8");
    // Three letters of three bytes each.
    assert_eq!(column(&mut client), units + 6);
}

/// What `check` says of the cloth is shown when the writer pauses, and goes with the mistake.
#[test]
fn what_cannot_be_cut_is_told_in_a_pause() {
    let scene = |grid: &str| {
        format!("scene sheet {{ cloth square of cotton {{ size: 2m x 2m; grid: {grid} }} }}\n")
    };
    let codes = |told: &[Value]| -> Vec<String> {
        told.iter().map(|told| told["code"].as_str().unwrap().to_owned()).collect()
    };
    let mut client = Client::start(&[]);
    let uri = client.uri("a.garment");
    assert_eq!(client.open("a.garment", &scene("0.5mm")), Vec::<Value>::new());
    assert_eq!(codes(&client.problems(&uri)), ["E0811"]);
    assert_eq!(client.change("a.garment", &scene("2cm")), Vec::<Value>::new());
    // Much is cut coarser than it is asked for; a small piece in it is no mistake.
    let small = "cloth patch of cotton { size: 8mm x 8mm; grid: 5mm }";
    let both = format!(
        "scene sheet {{ cloth square of cotton {{ size: 2m x 2m; grid: 1.5mm }}; {small} }}"
    );
    assert_eq!(client.change("a.garment", &both), Vec::<Value>::new());
    let tiny = "scene sheet { cloth patch of cotton { size: 5mm x 5mm; grid: 2cm } }";
    assert_eq!(client.change("a.garment", tiny), Vec::<Value>::new());
    assert_eq!(codes(&client.problems(&uri)), ["E0812"]);
    assert_eq!(client.end(), Some(0));
}

#[test]
fn requests_that_make_no_sense_are_refused_and_the_session_goes_on() {
    let mut client = Client::start(&[]);
    client.open("a.garment", "let a = 1\n");
    let uri = client.uri("a.garment");
    let code = |answer: Result<Value, Value>| answer.unwrap_err()["code"].as_i64().unwrap();
    assert_eq!(code(client.ask("textDocument/nothing", json!({}))), -32601);
    assert_eq!(code(client.ask("textDocument/hover", json!({}))), -32602);
    assert_eq!(code(client.ask("textDocument/hover", json!([1, 2]))), -32602);
    assert_eq!(code(client.ask("textDocument/hover", Value::Null)), -32602);
    let other = json!({
        "textDocument": { "uri": "file:///nowhere.garment" },
        "position": { "line": 0, "character": 0 },
    });
    assert_eq!(code(client.ask("textDocument/hover", other)), -32602);
    let negative = json!({
        "textDocument": { "uri": uri }, "position": { "line": -1, "character": 0 },
    });
    assert_eq!(code(client.ask("textDocument/hover", negative)), -32602);
    let far = json!({
        "textDocument": { "uri": uri }, "position": { "line": 4294967295_u32, "character": 7 },
    });
    assert_eq!(client.ask("textDocument/hover", far), Ok(Value::Null));
    // Notifications without sense are passed over.
    client.tell("textDocument/didChange", json!({ "textDocument": 3 }));
    client.tell("textDocument/didClose", json!({}));
    client.tell("textDocument/didOpen", json!([]));
    client.tell("$/cancelRequest", json!({ "id": 77 }));
    client.tell("who/knows", Value::Null);
    client.edit("file:///nowhere.garment", json!([{ "text": "x" }]));
    assert_eq!(client.change("a.garment", "let a = 2\n"), Vec::<Value>::new());
    assert_eq!(client.end(), Some(0));
}

#[test]
fn documents_that_are_no_files_are_served() {
    let mut client = Client::start(&[]);
    for uri in ["untitled:Untitled-1", "git:/a/b.garment?x=1", "x", "", "file:", "file:///%zz"] {
        let told = client.open_uri(uri, "panel front of denim {}\nlet a = 2cm\n");
        assert_eq!(told.len(), 1, "{uri}: {told:#?}");
        let params = json!({
            "textDocument": { "uri": uri }, "position": { "line": 1, "character": 4 },
        });
        let hover = client.ask("textDocument/hover", params).unwrap();
        assert!(hover["contents"]["value"].as_str().unwrap().contains("2 cm"), "{uri}: {hover}");
    }
    let told = client.open_uri("untitled:2", "use \"a.garment\"\n");
    assert!(told[0]["message"].as_str().unwrap().contains("not saved"), "{told:#?}");
}

#[test]
fn a_question_before_an_edit_is_answered_for_the_text_before_it() {
    let mut client = Client::start(&[]);
    client.open("a.garment", "let a = 2cm\nlet b = a\n");
    let uri = client.uri("a.garment");
    client.edit(&uri, json!([{ "text": "let long = 2cm\nlet b = long\n" }]));
    let place = client.place("a.garment", (1, 9));
    let first = client.ask_only("textDocument/hover", place.clone());
    client.edit(&uri, json!([{ "text": "\n" }]));
    let second = client.ask_only("textDocument/hover", place);
    assert!(client.answer(first).unwrap()["contents"]["value"].as_str().unwrap().contains("long"));
    assert_eq!(client.answer(second), Ok(Value::Null));
}

#[test]
fn a_text_that_takes_long_keeps_nobody_waiting() {
    let mut client = Client::start(&[]);
    // Each function calls the one before it ten times: the limit of steps ends it after seconds.
    let mut text = "fn f0(x: number): number = x + 1\n".to_owned();
    for n in 1..12 {
        let calls = vec![format!("f{}(x)", n - 1); 10].join(" + ");
        text.push_str(&format!("fn f{n}(x: number): number = {calls}\n"));
    }
    text.push_str("let slow = f11(1)\nlet quick = 2cm\n");
    let uri = client.uri("a.garment");
    let item = json!({ "uri": uri, "languageId": "garment", "version": 1, "text": text });
    client.tell("textDocument/didOpen", json!({ "textDocument": item }));
    let began = std::time::Instant::now();
    let place = client.place("a.garment", (13, 6));
    let hover = client.ask("textDocument/hover", place).unwrap();
    assert!(hover["contents"]["value"].as_str().unwrap().contains("let quick = 2cm"), "{hover}");
    // Far below the time the work takes, with room for a busy machine.
    assert!(began.elapsed() < std::time::Duration::from_secs(2), "{:?}", began.elapsed());
    let told = client.problems_of_any_version(&uri);
    assert!(told.iter().any(|told| told["code"] == "E0210"), "{told:#?}");
}
