//! How long an editor waits: from an edit in a file of 2,000 lines to its messages, and to what
//! may be written at the cursor.

#![allow(clippy::disallowed_methods)]

use darzi::evaluate::{Options, evaluate, study};
use darzi::world::{Memory, World};
use divan::Bencher;
use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Read, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

fn main() {
    divan::main();
}

/// The lines of the file.
const LINES: usize = 2_000;

/// Examples under new names, one after the other, until the lines are full. With curves fitted
/// by bisection and without.
fn text(examples: &[(&str, &str)]) -> String {
    let mut text = String::new();
    let mut number = 0;
    while text.lines().count() < LINES {
        let (name, example) = examples[number % examples.len()];
        text.push_str(
            &example.replace(&format!("garment {name}"), &format!("garment {name}_{number}")),
        );
        number += 1;
    }
    text
}

fn plain() -> String {
    text(&[("circular_skirt", include_str!("../examples/circular_skirt.garment"))])
}

fn fitted() -> String {
    text(&[
        ("a_line_skirt", include_str!("../examples/a_line_skirt.garment")),
        ("tunic", include_str!("../examples/tunic.garment")),
    ])
}

/// What the evaluation takes of it, without and with the notes for editors.
#[divan::bench(args = [false, true])]
fn evaluation(bencher: Bencher, noted: bool) {
    evaluated(bencher, plain(), noted);
}

#[divan::bench(args = [false, true])]
fn evaluation_with_fits(bencher: Bencher, noted: bool) {
    evaluated(bencher, fitted(), noted);
}

fn evaluated(bencher: Bencher, text: String, noted: bool) {
    let options = Options::default();
    bencher.bench(|| {
        let mut world = Memory::new([("bench.garment", text.as_str())]);
        let root = world.open("bench.garment").expect("a text in memory");
        if noted {
            study(&mut world, root, &options).1.len()
        } else {
            evaluate(&mut world, root, &options).1.len()
        }
    });
}

#[divan::bench]
fn reading(bencher: Bencher) {
    let text = fitted();
    bencher.bench(|| darzi::syntax::parse(darzi::diagnostic::FileId(0), &text));
}

struct Server {
    child: Child,
    input: ChildStdin,
    output: BufReader<ChildStdout>,
    version: i64,
}

impl Server {
    /// A server with the text open, worked out once.
    fn with(text: &str) -> Server {
        let mut child = Command::new(env!("CARGO_BIN_EXE_darzi"))
            .arg("lsp")
            .env("XDG_CACHE_HOME", std::env::temp_dir().join("darzi-bench"))
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .expect("the program runs");
        let input = child.stdin.take().expect("its input");
        let output = BufReader::new(child.stdout.take().expect("its output"));
        let mut server = Server { child, input, output, version: 1 };
        server.send(json!({ "id": 0, "method": "initialize", "params": { "capabilities": {} } }));
        server.wait(|message| message["id"] == 0);
        server.send(json!({ "method": "initialized", "params": {} }));
        let item = json!({
            "uri": "untitled:bench", "languageId": "garment", "version": 1, "text": text
        });
        let params = json!({ "textDocument": item });
        server.send(json!({ "method": "textDocument/didOpen", "params": params }));
        server.problems();
        server
    }

    fn send(&mut self, mut message: Value) {
        message["jsonrpc"] = json!("2.0");
        let body = message.to_string();
        write!(self.input, "Content-Length: {}\r\n\r\n{body}", body.len()).expect("it listens");
        self.input.flush().expect("it listens");
    }

    fn wait(&mut self, fits: impl Fn(&Value) -> bool) -> Value {
        loop {
            let mut length = 0;
            loop {
                let mut line = String::new();
                self.output.read_line(&mut line).expect("it speaks");
                match line.trim().strip_prefix("Content-Length: ") {
                    Some(number) => length = number.parse().expect("a number"),
                    None if line.trim().is_empty() => break,
                    None => {}
                }
            }
            let mut body = vec![0; length];
            self.output.read_exact(&mut body).expect("it speaks");
            let message: Value = serde_json::from_slice(&body).expect("JSON");
            if fits(&message) {
                return message;
            }
        }
    }

    fn problems(&mut self) {
        let version = self.version;
        self.wait(|message| message["params"]["version"] == version);
    }

    /// Puts a blank line into the middle, or takes it out again.
    fn edit(&mut self, (line, column): (usize, usize), new: &str, old: usize) {
        self.version += 1;
        let place = |column: usize| json!({ "line": line, "character": column });
        let range = json!({ "start": place(column), "end": place(column + old) });
        let document = json!({ "uri": "untitled:bench", "version": self.version });
        let changes = json!([{ "range": range, "text": new }]);
        let params = json!({ "textDocument": document, "contentChanges": changes });
        self.send(json!({ "method": "textDocument/didChange", "params": params }));
    }

    fn ask(&mut self, method: &str, (line, column): (usize, usize)) -> Value {
        let place = json!({ "line": line, "character": column });
        let document = json!({ "uri": "untitled:bench" });
        let range = json!({ "start": { "line": 0, "character": 0 }, "end": place });
        let params = json!({ "textDocument": document, "position": place, "range": range });
        let method = format!("textDocument/{method}");
        self.send(json!({ "id": self.version, "method": method, "params": params }));
        let version = self.version;
        self.wait(|message| message["id"] == version && message.get("method").is_none())
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// A place in the middle behind the value of a `param`, where digits may be typed.
fn place(text: &str) -> (usize, usize) {
    let lines = text.lines().enumerate().skip(LINES / 2);
    let (line, text) =
        lines.into_iter().find(|(_, line)| line.contains("param ")).expect("a param");
    (line, text.find(" in ").expect("a range") + " in ".len())
}

/// Edits that are typed and taken back, each followed by a wait for what is measured.
fn typed(bencher: Bencher, text: &str, after: impl Fn(&mut Server, (usize, usize))) {
    let place = place(text);
    let mut server = Server::with(text);
    let mut written = false;
    bencher.bench_local(|| {
        if written {
            server.edit(place, "", 1)
        } else {
            server.edit(place, "0", 0)
        }
        written = !written;
        after(&mut server, place);
    });
}

#[divan::bench]
fn edit_to_messages(bencher: Bencher) {
    typed(bencher, &plain(), |server, _| server.problems());
}

#[divan::bench]
fn edit_to_messages_with_fits(bencher: Bencher) {
    typed(bencher, &fitted(), |server, _| server.problems());
}

#[divan::bench]
fn edit_to_completion(bencher: Bencher) {
    typed(bencher, &plain(), |server, place| drop(server.ask("completion", place)));
}

#[divan::bench]
fn edit_to_completion_with_fits(bencher: Bencher) {
    typed(bencher, &fitted(), |server, place| drop(server.ask("completion", place)));
}

#[divan::bench]
fn edit_to_hover_with_fits(bencher: Bencher) {
    typed(bencher, &fitted(), |server, (line, column)| {
        server.ask("hover", (line, column.saturating_sub(12)));
    });
}

#[divan::bench]
fn edit_to_hints_with_fits(bencher: Bencher) {
    typed(bencher, &fitted(), |server, _| drop(server.ask("inlayHint", (LINES, 0))));
}

#[divan::bench]
fn edit_to_colours_with_fits(bencher: Bencher) {
    typed(bencher, &fitted(), |server, place| drop(server.ask("semanticTokens/full", place)));
}
