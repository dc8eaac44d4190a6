//! A session with one client: messages in, answers out.
//!
//! One queue brings what the client says and what the worker has found. A question that needs
//! the facts of a document waits for them a moment, and is answered with older ones, or with
//! what the text alone shows, if they take longer. Nothing that a client sends ends the session
//! except `exit`.

use super::document::{Document, Folders, plain};
use super::study::{Event, Job, Study, Worker, queue};
use super::text::{Encoding, Text};
use super::{
    actions, complete, definition, hints, hover, layout, problems, signature, symbols, tokens, uri,
};
use crate::diagnostic::Diagnostic as Told;
use gen_lsp_types::{
    Diagnostic, DidChangeTextDocumentParams, DidOpenTextDocumentParams, DocumentHighlight,
    InitializeResult, Position, PublishDiagnosticsParams, Range, ServerCapabilities, ServerInfo,
    TextDocumentPositionParams, Uri,
};
use lsp_server::{Connection, ErrorCode, Message, Notification, Request, Response};
use serde::Deserialize;
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::rc::Rc;
use std::sync::Arc;
use std::sync::mpsc::RecvTimeoutError;
use std::time::{Duration, Instant};

/// How long an answer waits for the facts of the present text.
const PATIENCE: Duration = Duration::from_millis(20);

/// How long it waits where older facts would do harm.
const CARE: Duration = Duration::from_secs(5);

/// Why a request is not answered.
pub(super) type Refused = (ErrorCode, String);

/// Serves a client on standard input and output until it says `exit`. `library` is the folder
/// in which the files of the library lie for reading, if there is one.
///
/// # Errors
/// Why the session could not begin, or that it ended without `shutdown`.
pub fn run(library: Option<PathBuf>) -> Result<(), String> {
    let (connection, threads) = Connection::stdio();
    let (id, params) = connection.initialize_start().map_err(|error| error.to_string())?;
    let encoding = encoding(&params);
    let result = InitializeResult {
        capabilities: capabilities(encoding),
        server_info: Some(ServerInfo {
            name: "darzi".to_owned(),
            version: Some(env!("CARGO_PKG_VERSION").to_owned()),
        }),
    };
    let result = serde_json::to_value(result).map_err(|error| error.to_string())?;
    connection.initialize_finish(id, result).map_err(|error| error.to_string())?;

    let (events, queue) = queue();
    let messages = connection.receiver.clone();
    let theirs = events.clone();
    std::thread::spawn(move || {
        for message in &messages {
            if theirs.send(Event::Message(message)).is_err() {
                return;
            }
        }
        // Nobody listens when the session is over.
        let _ = theirs.send(Event::Gone);
    });
    let worker = Worker::start(move |event| {
        let _ = events.send(event);
    });
    let worker = worker.map_err(|error| format!("there is no room to work: {error}"))?;
    let mut session = Session {
        connection: &connection,
        worker,
        folders: Folders { workspace: workspace(&params), library },
        encoding,
        refreshes: asks_for_refresh(&params),
        documents: BTreeMap::new(),
        foreign: BTreeMap::new(),
        waiting: Vec::new(),
        state: 0,
        asked: 0,
        over: false,
    };
    session.watch(&params);
    let shut_down = session.serve(&queue);
    drop(session);
    drop(connection);
    // The client may be gone before it has read everything.
    let _ = threads.join();
    if shut_down { Ok(()) } else { Err("the client left without `shutdown`".to_owned()) }
}

/// How the client counts columns: in bytes if it can.
fn encoding(params: &Value) -> Encoding {
    let offered = params.pointer("/capabilities/general/positionEncodings");
    let utf8 =
        offered.and_then(Value::as_array).is_some_and(|all| all.iter().any(|e| e == "utf-8"));
    if utf8 { Encoding::Utf8 } else { Encoding::Utf16 }
}

/// The folders of the workspace, outermost spelling first.
fn workspace(params: &Value) -> Vec<PathBuf> {
    let folders = params.get("workspaceFolders").and_then(Value::as_array);
    let named = folders.into_iter().flatten().filter_map(|folder| folder.get("uri"));
    let root = params.get("rootUri").filter(|_| folders.is_none_or(Vec::is_empty));
    named
        .chain(root)
        .filter_map(|address| uri::path(address.as_str()?))
        .map(|path| plain(&path))
        .collect()
}

/// Whether the client shows hints anew when it is asked to.
fn asks_for_refresh(params: &Value) -> bool {
    let at = params.pointer("/capabilities/workspace/inlayHint/refreshSupport");
    at.and_then(Value::as_bool).unwrap_or(false)
}

fn capabilities(encoding: Encoding) -> ServerCapabilities {
    let counted = match encoding {
        Encoding::Utf8 => "utf-8",
        Encoding::Utf16 => "utf-16",
    };
    let all = json!({
        "positionEncoding": counted,
        "textDocumentSync": { "openClose": true, "change": 2 },
        "hoverProvider": true,
        "definitionProvider": true,
        "referencesProvider": true,
        "documentHighlightProvider": true,
        "documentSymbolProvider": true,
        "documentFormattingProvider": true,
        "inlayHintProvider": true,
        "codeActionProvider": { "codeActionKinds": ["quickfix"] },
        "renameProvider": { "prepareProvider": true },
        "completionProvider": { "triggerCharacters": [".", ":", " "] },
        "signatureHelpProvider": { "triggerCharacters": [" ", "(", ","] },
        "semanticTokensProvider": { "legend": tokens::legend(), "full": true },
        "workspace": { "workspaceFolders": { "supported": true, "changeNotifications": true } },
    });
    serde_json::from_value(all).unwrap_or_default()
}

/// A request that waits for the facts of a document.
struct Waiting {
    request: Request,
    uri: String,
    until: Instant,
}

pub(super) struct Session<'c> {
    connection: &'c Connection,
    worker: Worker,
    pub(super) folders: Folders,
    pub(super) encoding: Encoding,
    refreshes: bool,
    pub(super) documents: BTreeMap<String, Document>,
    /// Messages that the study of a document has about each file.
    foreign: BTreeMap<String, BTreeMap<String, Vec<Diagnostic>>>,
    waiting: Vec<Waiting>,
    /// Counts the changes of documents.
    state: u64,
    /// Counts the requests to the client.
    asked: u32,
    over: bool,
}

impl Session<'_> {
    /// Answers until the end; whether the client said `shutdown` before.
    fn serve(&mut self, queue: &std::sync::mpsc::Receiver<Event>) -> bool {
        loop {
            let now = Instant::now();
            let until = self.waiting.iter().map(|waiting| waiting.until).min();
            let event = match until {
                None => queue.recv().map_err(|_| RecvTimeoutError::Disconnected),
                Some(until) => queue.recv_timeout(until.saturating_duration_since(now)),
            };
            match event {
                Ok(Event::Message(Message::Request(request))) => self.asked(request),
                Ok(Event::Message(Message::Notification(told))) => {
                    if told.method == "exit" {
                        return self.over;
                    }
                    let done = catch_unwind(AssertUnwindSafe(|| self.told(told)));
                    if done.is_err() {
                        self.waiting.clear();
                    }
                }
                Ok(Event::Message(Message::Response(_))) | Err(RecvTimeoutError::Timeout) => {}
                Ok(Event::Studied(study, job)) => self.studied(study.map(|study| *study), &job),
                Ok(Event::Cut(told, job)) => self.cut(&told, &job),
                Ok(Event::Gone) | Err(RecvTimeoutError::Disconnected) => return self.over,
            }
            self.answer_waiting(|_| false);
        }
    }

    fn send(&self, message: impl Into<Message>) {
        // A client that is gone is noticed when its messages end.
        let _ = self.connection.sender.send(message.into());
    }

    fn request(&mut self, method: &str, params: Value) {
        self.asked += 1;
        let id = format!("darzi-{}", self.asked).into();
        self.send(Request { id, method: method.to_owned(), params });
    }

    /// Asks to be told of files that change on the disk, if the client does that.
    fn watch(&mut self, params: &Value) {
        let at = "/capabilities/workspace/didChangeWatchedFiles/dynamicRegistration";
        if params.pointer(at).and_then(Value::as_bool) == Some(true) {
            let watchers = json!([{ "globPattern": "**/*.garment" }]);
            let registration = json!({ "registrations": [{
                "id": "darzi-files",
                "method": "workspace/didChangeWatchedFiles",
                "registerOptions": { "watchers": watchers },
            }] });
            self.request("client/registerCapability", registration);
        }
    }

    // What the client tells.

    fn told(&mut self, told: Notification) {
        let params = told.params;
        match told.method.as_str() {
            "textDocument/didOpen" => {
                if let Ok(opened) = DidOpenTextDocumentParams::deserialize(params) {
                    let item = opened.text_document;
                    self.answer_waiting(|waiting| waiting.uri == item.uri.0);
                    let text = Text::new(item.text, self.encoding);
                    let place = self.folders.place(&item.uri.0);
                    let uri = item.uri.0;
                    let document = Document::new(uri.clone(), place, item.version, text);
                    self.documents.insert(uri.clone(), document);
                    self.changed(&uri);
                }
            }
            "textDocument/didChange" => {
                if let Ok(changed) = DidChangeTextDocumentParams::deserialize(params) {
                    let uri = changed.text_document.text_document_identifier.uri.0;
                    // A question was asked of the text before this change.
                    self.answer_waiting(|waiting| waiting.uri == uri);
                    let Some(document) = self.documents.get_mut(&uri) else { return };
                    let mut text = document.text.clone();
                    for change in changed.content_changes {
                        text = text.changed(change);
                    }
                    document.set(text, changed.text_document.version);
                    self.changed(&uri);
                }
            }
            "textDocument/didClose" => {
                let uri = params.pointer("/textDocument/uri").and_then(Value::as_str);
                let Some(uri) = uri.map(str::to_owned) else { return };
                self.answer_waiting(|waiting| waiting.uri == uri);
                if self.documents.remove(&uri).is_some() {
                    let gone = self.foreign.remove(&uri).unwrap_or_default();
                    self.changed(&uri);
                    for address in gone.keys().chain([&uri]) {
                        self.publish(address);
                    }
                }
            }
            "workspace/didChangeWatchedFiles" => self.all_changed(),
            "workspace/didChangeWorkspaceFolders" => {
                let folders = |name: &str| -> Vec<PathBuf> {
                    let list = params.pointer(&format!("/event/{name}")).and_then(Value::as_array);
                    let uris = list.into_iter().flatten().filter_map(|f| f.get("uri")?.as_str());
                    uris.filter_map(uri::path).map(|path| plain(&path)).collect()
                };
                let gone = folders("removed");
                self.folders.workspace.retain(|folder| !gone.contains(folder));
                self.folders.workspace.extend(folders("added"));
                for (uri, document) in &mut self.documents {
                    document.place = self.folders.place(uri);
                }
                self.all_changed();
            }
            "$/cancelRequest" => {
                let Some(id) = params.get("id") else { return };
                let same = |waiting: &Waiting| {
                    serde_json::to_value(&waiting.request.id).is_ok_and(|other| other == *id)
                };
                let found = self.waiting.iter().position(same);
                if let Some(waiting) = found.map(|at| self.waiting.remove(at)) {
                    let code = ErrorCode::RequestCanceled as i32;
                    self.send(Response::new_err(waiting.request.id, code, "cancelled".to_owned()));
                }
            }
            _ => {}
        }
    }

    /// A document changed, was opened or closed: it and all that use it are worked out anew.
    fn changed(&mut self, uri: &str) {
        self.state += 1;
        let state = self.state;
        let path = match self.documents.get(uri) {
            Some(document) => document.place.path.clone(),
            None => self.folders.place(uri).path,
        };
        let mut again = Vec::new();
        for (other, document) in &mut self.documents {
            let uses = document.study.as_ref().is_some_and(|study| {
                study.desk.files().any(|(_, known, _)| known == path)
                    || study.told.iter().any(|told| told.code == "E0903")
            });
            if other != uri && uses {
                document.state = state;
                again.push(other.clone());
            }
        }
        if let Some(document) = self.documents.get_mut(uri) {
            document.state = state;
            // The worker takes the last question first.
            again.push(uri.to_owned());
        }
        for uri in again {
            self.ask(&uri);
        }
    }

    fn all_changed(&mut self) {
        self.state += 1;
        let uris: Vec<String> = self.documents.keys().cloned().collect();
        for uri in &uris {
            if let Some(document) = self.documents.get_mut(uri) {
                document.state = self.state;
            }
            self.ask(uri);
        }
    }

    /// The question to the worker about a document.
    pub(super) fn job(&self, document: &Document) -> Job {
        let place = &document.place;
        let beside = |other: &&Document| match &place.folder {
            Some(_) => other.place.folder == place.folder,
            None => other.place == *place,
        };
        let open = self.documents.values().filter(beside);
        let open = open.map(|other| (other.place.path.clone(), other.text.text.clone())).collect();
        Job {
            uri: document.uri.clone(),
            place: place.clone(),
            state: document.state,
            open: Arc::new(open),
        }
    }

    fn ask(&self, uri: &str) {
        if let Some(document) = self.documents.get(uri) {
            self.worker.ask(self.job(document));
        }
    }

    /// Takes in what the worker found.
    fn studied(&mut self, study: Option<Study>, job: &Job) {
        let Some(document) = self.documents.get_mut(&job.uri) else { return };
        let Some(study) = study else {
            // Nothing is known of it; nobody shall wait for more.
            self.answer_waiting(|waiting| waiting.uri == job.uri);
            return;
        };
        let newer = document.study.as_ref().is_none_or(|old| old.job.state <= study.job.state);
        if !newer {
            return;
        }
        let study = Rc::new(study);
        document.study = Some(study.clone());
        // Messages of an older text would stand at the wrong places.
        if document.is_known() {
            let found = problems::problems(&study, &study.told, &self.folders, document);
            self.show(&job.uri, found);
            if self.refreshes {
                self.request("workspace/inlayHint/refresh", Value::Null);
            }
        }
    }

    /// Takes in what was wrong when the garments of a document were cut.
    fn cut(&mut self, told: &[Told], job: &Job) {
        let Some(document) = self.documents.get(&job.uri).filter(|d| d.is_known()) else { return };
        let study = document.study.clone().filter(|study| study.job.state == job.state);
        let Some(study) = study.filter(|_| !told.is_empty()) else { return };
        let all: Vec<Told> = study.told.iter().chain(told).cloned().collect();
        let found = problems::problems(&study, &all, &self.folders, document);
        self.show(&job.uri, found);
    }

    /// Tells the client what a study has found about each file.
    fn show(&mut self, uri: &str, found: BTreeMap<String, Vec<Diagnostic>>) {
        let before = self.foreign.insert(uri.to_owned(), found).unwrap_or_default();
        let now = self.foreign.get(uri).cloned().unwrap_or_default();
        let touched: BTreeSet<&String> = before.keys().chain(now.keys()).collect();
        for address in touched {
            self.publish(address);
        }
    }

    /// Tells the client all messages about a file.
    fn publish(&self, address: &str) {
        let mut all: Vec<Diagnostic> = Vec::new();
        let own = self.foreign.get(address).into_iter();
        let others = self.foreign.iter().filter(|(uri, _)| *uri != address).map(|(_, f)| f);
        for found in own.chain(others).filter_map(|found| found.get(address)) {
            for told in found {
                if !all.contains(told) {
                    all.push(told.clone());
                }
            }
        }
        let version = self.documents.get(address).map(|document| document.version);
        let params =
            PublishDiagnosticsParams { uri: Uri(address.to_owned()), version, diagnostics: all };
        self.send(Notification::new("textDocument/publishDiagnostics".to_owned(), params));
    }

    // What the client asks.

    fn asked(&mut self, request: Request) {
        if request.method == "shutdown" {
            self.over = true;
            self.answer_waiting(|_| true);
            self.send(Response::new_ok(request.id, Value::Null));
            return;
        }
        if self.over {
            let code = ErrorCode::InvalidRequest as i32;
            self.send(Response::new_err(request.id, code, "the session is over".to_owned()));
            return;
        }
        let uri = request.params.pointer("/textDocument/uri").and_then(Value::as_str);
        let uri = uri.unwrap_or("").to_owned();
        let patience = match request.method.as_str() {
            "textDocument/hover"
            | "textDocument/definition"
            | "textDocument/documentHighlight"
            | "textDocument/inlayHint"
            | "textDocument/codeAction"
            | "textDocument/completion"
            | "textDocument/prepareRename" => PATIENCE,
            "textDocument/references" | "textDocument/rename" => CARE,
            _ => Duration::ZERO,
        };
        let document = self.documents.get(&uri);
        // What may be written follows from the text; figures beside it may be a moment old.
        let enough = request.method == "textDocument/completion"
            && document.is_some_and(|document| document.study.is_some());
        let known = document.is_none_or(Document::is_known);
        if known || enough || patience.is_zero() {
            self.answer(request);
        } else {
            self.waiting.push(Waiting { request, uri, until: Instant::now() + patience });
        }
    }

    /// Answers what has waited long enough, what can be answered now, and what is chosen.
    fn answer_waiting(&mut self, chosen: impl Fn(&Waiting) -> bool) {
        let now = Instant::now();
        let ready = |waiting: &mut Waiting, documents: &BTreeMap<String, Document>| {
            waiting.until <= now
                || chosen(waiting)
                || documents.get(&waiting.uri).is_none_or(Document::is_known)
        };
        let documents = &self.documents;
        let requests: Vec<Request> = self
            .waiting
            .extract_if(.., |waiting| ready(waiting, documents))
            .map(|waiting| waiting.request)
            .collect();
        for request in requests {
            self.answer(request);
        }
    }

    fn answer(&mut self, request: Request) {
        let Request { id, method, params } = request;
        // The session outlives a mistake of the program's own.
        let result = catch_unwind(AssertUnwindSafe(|| self.reply(&method, params)));
        let response = match result {
            Ok(Ok(value)) => Response::new_ok(id, value),
            Ok(Err((code, why))) => Response::new_err(id, code as i32, why),
            Err(_) => {
                let code = ErrorCode::InternalError as i32;
                Response::new_err(id, code, format!("darzi could not answer `{method}`"))
            }
        };
        self.send(response);
    }

    fn reply(&self, method: &str, params: Value) -> Result<Value, Refused> {
        match method {
            "textDocument/hover" => {
                let (document, place) = self.at(&params)?;
                shown(hover::hover(document, document.known().as_ref(), place))
            }
            "textDocument/completion" => {
                let (document, place) = self.at(&params)?;
                shown(complete::complete(document, document.known().as_ref(), place))
            }
            "textDocument/signatureHelp" => {
                let (document, place) = self.at(&params)?;
                shown(signature::signature(document, document.known().as_ref(), place))
            }
            "textDocument/definition" => {
                let (document, place) = self.at(&params)?;
                let known = document.known();
                shown(definition::definition(document, known.as_ref(), &self.folders, place))
            }
            "textDocument/references" => {
                let (document, place) = self.at(&params)?;
                let with = params.pointer("/context/includeDeclaration").and_then(Value::as_bool);
                shown(self.references(document, place, with.unwrap_or(true)))
            }
            "textDocument/documentHighlight" => {
                let (document, place) = self.at(&params)?;
                let known = document.known();
                let spans = known.as_ref().map(|known| {
                    definition::occurrences(document, known, place, true)
                        .into_iter()
                        .filter(|span| span.file == known.study.root)
                        .filter_map(|span| known.now(span))
                        .map(|span| document.text.span(span))
                        .map(|range| DocumentHighlight { range, kind: None })
                        .collect::<Vec<_>>()
                });
                shown(spans)
            }
            "textDocument/prepareRename" => {
                let (document, place) = self.at(&params)?;
                shown(self.renameable(document, place)?)
            }
            "textDocument/rename" => {
                let (document, place) = self.at(&params)?;
                let new = params.get("newName").and_then(Value::as_str).unwrap_or("");
                shown(self.rename(document, place, new)?)
            }
            "textDocument/documentSymbol" => shown(symbols::symbols(self.document(&params)?)),
            "textDocument/formatting" => shown(layout::layout(self.document(&params)?)),
            "textDocument/semanticTokens/full" => shown(tokens::tokens(self.document(&params)?)),
            "textDocument/inlayHint" => {
                let (document, range) = self.within(&params)?;
                let known = document.known();
                shown(known.map(|known| hints::hints(document, &known, range)))
            }
            "textDocument/codeAction" => {
                let (document, range) = self.within(&params)?;
                let known = document.known();
                shown(known.map(|known| actions::actions(document, &known, range)))
            }
            _ => Err((ErrorCode::MethodNotFound, format!("darzi does not know `{method}`"))),
        }
    }

    fn document(&self, params: &Value) -> Result<&Document, Refused> {
        let uri = params.pointer("/textDocument/uri").and_then(Value::as_str);
        let uri = uri.ok_or_else(|| wrong("a `textDocument` with its `uri` is wanted"))?;
        self.documents.get(uri).ok_or_else(|| wrong(&format!("`{uri}` is not open")))
    }

    /// The document and the place of a question.
    fn at(&self, params: &Value) -> Result<(&Document, Position), Refused> {
        let place = TextDocumentPositionParams::deserialize(params);
        let place = place.map_err(|error| wrong(&error.to_string()))?.position;
        Ok((self.document(params)?, place))
    }

    /// The document and the range of a question.
    fn within(&self, params: &Value) -> Result<(&Document, Range), Refused> {
        let range = params.get("range").map(Range::deserialize);
        match range {
            Some(Ok(range)) => Ok((self.document(params)?, range)),
            _ => Err(wrong("a `range` is wanted")),
        }
    }
}

fn wrong(why: &str) -> Refused {
    (ErrorCode::InvalidParams, why.to_owned())
}

fn shown(result: impl serde::Serialize) -> Result<Value, Refused> {
    serde_json::to_value(result).map_err(|error| (ErrorCode::InternalError, error.to_string()))
}
