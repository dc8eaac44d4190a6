//! A client of the language server: the real program, over its standard input and output.

use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::{Duration, Instant};

/// An answer that takes longer has been forgotten.
const LONGEST: Duration = Duration::from_secs(30);

/// A running server with a folder of its own.
pub struct Client {
    child: Child,
    input: ChildStdin,
    output: Receiver<Value>,
    asked: i64,
    version: i64,
    /// Messages that came and were not waited for yet.
    told: Vec<Value>,
    pub folder: tempfile::TempDir,
    pub begun: Value,
}

fn read(input: &mut impl BufRead) -> Option<Value> {
    let mut length = 0;
    loop {
        let mut line = String::new();
        if input.read_line(&mut line).ok()? == 0 {
            return None;
        }
        let line = line.trim();
        if line.is_empty() {
            break;
        }
        if let Some(number) = line.strip_prefix("Content-Length: ") {
            length = number.parse().ok()?;
        }
    }
    let mut body = vec![0; length];
    input.read_exact(&mut body).ok()?;
    serde_json::from_slice(&body).ok()
}

impl Client {
    /// Starts a server for a folder with these files.
    pub fn start(files: &[(&str, &str)]) -> Client {
        Client::with(files, json!({}))
    }

    /// Starts a server for a client that can do these things.
    pub fn with(files: &[(&str, &str)], capabilities: Value) -> Client {
        let folder = tempfile::tempdir().unwrap();
        let root = folder.path().canonicalize().unwrap();
        for (name, text) in files {
            let place = root.join("project").join(name);
            std::fs::create_dir_all(place.parent().unwrap()).unwrap();
            std::fs::write(place, text).unwrap();
        }
        let mut child = Command::new(env!("CARGO_BIN_EXE_darzi"))
            .arg("lsp")
            .env("XDG_CACHE_HOME", root.join("cache"))
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::inherit())
            .spawn()
            .unwrap();
        let input = child.stdin.take().unwrap();
        let mut from = BufReader::new(child.stdout.take().unwrap());
        let (sender, output) = channel();
        std::thread::spawn(move || {
            while let Some(message) = read(&mut from) {
                if sender.send(message).is_err() {
                    return;
                }
            }
        });
        let (asked, version, told) = (0, 0, Vec::new());
        let mut client =
            Client { child, input, output, asked, version, told, folder, begun: Value::Null };
        let uri = client.uri("");
        let project = uri.trim_end_matches('/');
        let begun = client.ask(
            "initialize",
            json!({
                "processId": null,
                "rootUri": project,
                "workspaceFolders": [{ "uri": project, "name": "project" }],
                "capabilities": capabilities,
            }),
        );
        client.begun = begun.unwrap();
        client.tell("initialized", json!({}));
        client
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().canonicalize().unwrap().join("project").join(name)
    }

    /// The address of a file of the project.
    pub fn uri(&self, name: &str) -> String {
        format!("file://{}", self.path(name).display())
    }

    fn send(&mut self, message: &Value) {
        let body = message.to_string();
        write!(self.input, "Content-Length: {}\r\n\r\n{body}", body.len()).unwrap();
        self.input.flush().unwrap();
    }

    /// A notification.
    pub fn tell(&mut self, method: &str, params: Value) {
        self.send(&json!({ "jsonrpc": "2.0", "method": method, "params": params }));
    }

    /// Sends a request and does not wait for its answer.
    pub fn ask_only(&mut self, method: &str, params: Value) -> i64 {
        self.asked += 1;
        let id = self.asked;
        self.send(&json!({ "jsonrpc": "2.0", "id": id, "method": method, "params": params }));
        id
    }

    /// The answer to a request.
    pub fn answer(&mut self, id: i64) -> Result<Value, Value> {
        let is = |message: &Value| message["id"] == id && message.get("method").is_none();
        let message = self.wait(is, "an answer");
        match message.get("error") {
            Some(error) => Err(error.clone()),
            None => Ok(message["result"].clone()),
        }
    }

    pub fn ask(&mut self, method: &str, params: Value) -> Result<Value, Value> {
        let id = self.ask_only(method, params);
        self.answer(id)
    }

    /// The first message that fits, of those that came and those that come.
    fn wait(&mut self, fits: impl Fn(&Value) -> bool, what: &str) -> Value {
        if let Some(at) = self.told.iter().position(&fits) {
            return self.told.remove(at);
        }
        let until = Instant::now() + LONGEST;
        loop {
            let left = until.saturating_duration_since(Instant::now());
            match self.output.recv_timeout(left) {
                Ok(message) if fits(&message) => return message,
                Ok(message) => self.told.push(message),
                Err(RecvTimeoutError::Timeout) => panic!("waited in vain for {what}"),
                Err(RecvTimeoutError::Disconnected) => {
                    panic!("the server ended: {:?}", self.child.wait())
                }
            }
        }
    }

    /// Opens a document and waits for its messages.
    pub fn open(&mut self, name: &str, text: &str) -> Vec<Value> {
        let uri = self.uri(name);
        self.open_uri(&uri, text)
    }

    pub fn open_uri(&mut self, uri: &str, text: &str) -> Vec<Value> {
        self.version += 1;
        let item = json!({
            "uri": uri, "languageId": "garment", "version": self.version, "text": text
        });
        self.tell("textDocument/didOpen", json!({ "textDocument": item }));
        self.problems(uri)
    }

    /// Puts a new text in the place of the old one and waits for its messages.
    pub fn change(&mut self, name: &str, text: &str) -> Vec<Value> {
        let uri = self.uri(name);
        self.edit(&uri, json!([{ "text": text }]));
        self.problems(&uri)
    }

    /// Changes a document.
    pub fn edit(&mut self, uri: &str, changes: Value) {
        self.version += 1;
        let document = json!({ "uri": uri, "version": self.version });
        let params = json!({ "textDocument": document, "contentChanges": changes });
        self.tell("textDocument/didChange", params);
    }

    /// The messages about the newest version of a document.
    pub fn problems(&mut self, uri: &str) -> Vec<Value> {
        let version = self.version;
        let fits = |message: &Value| {
            message["method"] == "textDocument/publishDiagnostics"
                && message["params"]["uri"] == uri
                && message["params"]["version"] == version
        };
        let message = self.wait(fits, "diagnostics");
        message["params"]["diagnostics"].as_array().unwrap().clone()
    }

    /// The messages about a file, whatever its version.
    pub fn problems_of_any_version(&mut self, uri: &str) -> Vec<Value> {
        let fits = |message: &Value| {
            message["method"] == "textDocument/publishDiagnostics"
                && message["params"]["uri"] == uri
        };
        let message = self.wait(fits, "diagnostics");
        message["params"]["diagnostics"].as_array().unwrap().clone()
    }

    /// Asks something at a place of a document.
    pub fn at(&mut self, method: &str, name: &str, (line, character): (u64, u64)) -> Value {
        let params = self.place(name, (line, character));
        self.ask(method, params).unwrap()
    }

    pub fn place(&self, name: &str, (line, character): (u64, u64)) -> Value {
        json!({
            "textDocument": { "uri": self.uri(name) },
            "position": { "line": line, "character": character },
        })
    }

    /// Whether it runs still.
    pub fn runs(&mut self) -> bool {
        self.child.try_wait().unwrap().is_none()
    }

    /// Ends the session as the protocol wants it; the exit code.
    pub fn end(mut self) -> Option<i32> {
        assert_eq!(self.ask("shutdown", Value::Null), Ok(Value::Null));
        self.tell("exit", Value::Null);
        self.child.wait().unwrap().code()
    }
}

impl Drop for Client {
    fn drop(&mut self) {
        // A test that failed leaves no process behind.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Line and column of a mark in a text, in units of UTF-16, and the text without it.
pub fn marked(text: &str) -> (String, (u64, u64)) {
    let at = text.find('§').expect("a text with a mark");
    let before = &text[..at];
    let line = before.matches('\n').count() as u64;
    let start = before.rfind('\n').map_or(0, |end| end + 1);
    let column = before[start..].encode_utf16().count() as u64;
    (text.replacen('§', "", 1), (line, column))
}

/// The examples of the repository.
pub fn examples() -> Vec<(String, String)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    let mut found: Vec<(String, String)> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|end| end == "garment"))
        .map(|path| {
            let name = path.file_name().unwrap().to_string_lossy().into_owned();
            (name, std::fs::read_to_string(&path).unwrap())
        })
        .collect();
    found.sort();
    found
}
