//! Edits at random, on copies of the examples that are broken more and more: every request is
//! answered, and the server runs to the end.

use crate::client::{Client, examples};
use serde_json::{Value, json};

/// A small generator of chance with a seed (Steele, Lea and Flood 2014, "SplitMix").
struct Chance(u64);

impl Chance {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)) as usize % n.max(1)
    }
}

const PIECES: &[&str] = &[
    "",
    "",
    "",
    "{",
    "}",
    "(",
    ")",
    "[",
    "]",
    "\"",
    "|",
    ";",
    ":",
    "::",
    ",",
    "->",
    ".",
    "..",
    "=",
    "\n",
    "\r",
    "\r\n",
    "//",
    "///",
    "/",
    " ",
    "\t",
    "1",
    "12cm",
    "1e",
    "3/",
    "#",
    "#f",
    "let ",
    "use ",
    "param ",
    "fn f(",
    "for i in ",
    "if ",
    "panel p of ",
    "seam a -> ",
    "outline from (0, 0) {",
    "dart on ",
    "front.",
    "std::",
    "काठ",
    "𝄞",
    "\u{FEFF}",
    "\u{0}",
    "\u{94d}",
    "é",
    "with {",
    "= front with {",
    "line to (",
    "|.x.|",
    "|..",
];

fn place(chance: &mut Chance, text: &str) -> Value {
    let lines: Vec<&str> = text.split('\n').collect();
    let line = chance.below(lines.len() + 2);
    let width = lines.get(line).map_or(3, |line| line.len());
    json!({ "line": line, "character": chance.below(width + 4) })
}

/// Asks everything there is to ask at one place, and waits for all answers.
fn ask_all(client: &mut Client, uri: &str, at: &Value, end: &Value) {
    let document = json!({ "uri": uri });
    let point = json!({ "textDocument": document, "position": at });
    let range = json!({ "start": at, "end": end });
    let mut asked = Vec::new();
    for method in
        ["hover", "completion", "signatureHelp", "definition", "documentHighlight", "prepareRename"]
    {
        asked.push(client.ask_only(&format!("textDocument/{method}"), point.clone()));
    }
    for method in ["documentSymbol", "semanticTokens/full"] {
        let params = json!({ "textDocument": document });
        asked.push(client.ask_only(&format!("textDocument/{method}"), params));
    }
    let options = json!({ "tabSize": 4, "insertSpaces": true });
    asked.push(client.ask_only(
        "textDocument/formatting",
        json!({ "textDocument": document, "options": options }),
    ));
    for method in ["inlayHint", "codeAction"] {
        asked.push(client.ask_only(
            &format!("textDocument/{method}"),
            json!({ "textDocument": document, "range": range, "context": { "diagnostics": [] } }),
        ));
    }
    asked.push(client.ask_only(
        "textDocument/references",
        json!({ "textDocument": document, "position": at, "context": { "includeDeclaration": true } }),
    ));
    asked.push(client.ask_only(
        "textDocument/rename",
        json!({ "textDocument": document, "position": at, "newName": "another" }),
    ));
    for id in asked {
        if let Err(error) = client.answer(id) {
            // A rename may be refused; nothing may break.
            assert_ne!(error["code"], -32603, "{error}");
        }
    }
}

fn run(edits: usize, seed: u64) {
    let mut chance = Chance(seed);
    let mut client = Client::start(&[]);
    for (name, text) in examples() {
        client.open(&name, &text);
        let uri = client.uri(&name);
        // The server's text is not read back; lengths of the original serve for places.
        for round in 0..edits {
            let (a, b) = (place(&mut chance, &text), place(&mut chance, &text));
            let near = json!({
                "line": a["line"], "character": a["character"].as_u64().unwrap() + 3
            });
            let piece = PIECES[chance.below(PIECES.len())];
            let change = match chance.below(12) {
                0 => json!({ "range": { "start": a, "end": b }, "text": piece }),
                1 => {
                    let mut end = chance.below(text.len());
                    while !text.is_char_boundary(end) {
                        end -= 1;
                    }
                    json!({ "text": format!("{}{piece}", &text[..end]) })
                }
                2 => json!({ "text": text }),
                3 => json!({ "range": { "start": a, "end": near }, "text": "" }),
                _ => json!({ "range": { "start": a, "end": a }, "text": piece }),
            };
            client.edit(&uri, json!([change]));
            if round % 3 == 0 {
                ask_all(&mut client, &uri, &a, &b);
            }
        }
        client.problems(&uri);
        ask_all(
            &mut client,
            &uri,
            &json!({ "line": 5, "character": 9 }),
            &json!({ "line": 9, "character": 0 }),
        );
        client.tell("textDocument/didClose", json!({ "textDocument": { "uri": uri } }));
    }
    assert!(client.runs());
    assert_eq!(client.end(), Some(0));
}

#[test]
fn every_request_is_answered_on_damaged_texts() {
    run(18, 1);
}

/// Several thousand edits: `cargo test --release --test lsp -- --ignored`.
#[test]
#[ignore = "takes minutes with --release"]
fn every_request_is_answered_on_thousands_of_damaged_texts() {
    for seed in 2..12 {
        run(150, seed);
    }
}
