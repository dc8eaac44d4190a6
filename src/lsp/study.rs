//! What is known of a document after it was worked out: facts, messages and the files read. The
//! work is done by a thread of its own, so that a text that takes long keeps nobody waiting.

use super::cutting::mistakes;
use crate::diagnostic::{Diagnostic, FileId, Span, Texts};
use crate::evaluate::facts::{Definition, Facts};
use crate::evaluate::{self, Options};
use crate::garment::Garment;
use crate::world::{Desk, World};
use std::collections::{BTreeMap, BTreeSet};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::time::Duration;

/// Where a document stands: a project, and its path there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// The folder of the project; none for a text that is not saved, or of the library.
    pub folder: Option<PathBuf>,
    /// The path in the project, or `std::fabric`.
    pub path: String,
}

/// A document that is to be worked out, with the texts that lie open.
#[derive(Clone, Debug)]
pub struct Job {
    /// The address of the document.
    pub uri: String,
    /// Where it stands.
    pub place: Place,
    /// The state of all documents for which this holds.
    pub state: u64,
    /// Open texts of its project by their paths.
    pub open: Arc<BTreeMap<String, Arc<str>>>,
}

/// A document worked out.
#[derive(Debug)]
pub struct Study {
    /// What was asked.
    pub job: Job,
    /// The texts that were read.
    pub desk: Desk,
    /// The document among them.
    pub root: FileId,
    /// What is known of the texts.
    pub facts: Facts,
    /// What is wrong with them.
    pub told: Vec<Diagnostic>,
    /// The garments of the document, until they are cut.
    pub garments: Vec<Garment>,
}

impl Study {
    /// Works a document out. None if it cannot even be opened.
    pub fn of(job: Job) -> Option<Study> {
        let mut desk = Desk::new(job.place.folder.clone(), job.open.clone());
        let root = desk.open(&job.place.path).ok()?;
        let (garments, told, facts) = evaluate::study(&mut desk, root, &Options::default());
        Some(Study { job, desk, root, facts, told, garments })
    }

    /// The document's own text, as it was.
    pub fn text(&self) -> &str {
        self.desk.text(self.root)
    }

    /// What is known of the names at a place.
    pub fn definitions(&self, span: Span) -> impl Iterator<Item = &Definition> {
        let all = &self.facts.definitions;
        let first = all.partition_point(|definition| definition.span < span);
        all.get(first..).unwrap_or(&[]).iter().take_while(move |d| d.span == span)
    }

    /// Where the names that stand at a place are declared; the place itself if it declares one.
    pub fn declared(&self, span: Span) -> BTreeSet<Span> {
        let mut places = self.facts.uses.get(&span).cloned().unwrap_or_default();
        if self.definitions(span).next().is_some() {
            places.insert(span);
        }
        places
    }

    /// All places of the name that is declared at some places, with the declarations: those that
    /// a copy replaces are one name with the original.
    pub fn places(&self, declared: &BTreeSet<Span>) -> BTreeSet<Span> {
        let mut found = declared.clone();
        loop {
            let before = found.len();
            for (new, old) in &self.facts.alike {
                if found.contains(new) || found.contains(old) {
                    found.extend([*new, *old]);
                }
            }
            for (at, targets) in &self.facts.uses {
                // An edge that is traced keeps its name: there a use declares it anew.
                let anew = found.contains(at) && self.definitions(*at).next().is_some();
                if anew {
                    found.extend(targets.iter().copied());
                } else if targets.iter().any(|target| found.contains(target)) {
                    found.insert(*at);
                }
            }
            if found.len() == before {
                return found;
            }
        }
    }
}

/// Declarations by the paths of their files and their bytes there, by which other documents that
/// use these files find them too.
pub type Anchors = BTreeSet<(String, u32, u32)>;

impl Study {
    /// The declarations among some places.
    pub fn anchors(&self, places: &BTreeSet<Span>) -> Anchors {
        let declared = places.iter().filter(|span| self.definitions(**span).next().is_some());
        declared.map(|s| (self.desk.path(s.file).to_owned(), s.start, s.end)).collect()
    }

    /// The places of declarations that another study found.
    pub fn anchored(&self, anchors: &Anchors) -> BTreeSet<Span> {
        let place = |(path, start, end): &(String, u32, u32)| {
            let (file, ..) = self.desk.files().find(|(_, known, _)| known == path)?;
            Some(Span { file, start: *start, end: *end })
        };
        anchors.iter().filter_map(place).collect()
    }
}

/// The thread that works documents out, the most recent question first, and cuts their garments
/// when nobody asks for more.
pub struct Worker {
    jobs: Arc<(Mutex<Jobs>, Condvar)>,
}

#[derive(Default)]
struct Jobs {
    waiting: Vec<Job>,
    over: bool,
}

/// Stack for reading a text, in bytes; working it out has a stack of its own.
const STACK: usize = 64 << 20;

/// How long nobody writes before garments are cut.
const PAUSE: Duration = Duration::from_millis(200);

/// What the worker does next.
enum Next {
    Study(Job),
    Cut,
    Stop,
}

impl Worker {
    /// Starts the thread; what it finds is given to `tell`.
    pub fn start(tell: impl Fn(Event) + Send + 'static) -> std::io::Result<Worker> {
        let jobs: Arc<(Mutex<Jobs>, Condvar)> = Arc::default();
        let theirs = jobs.clone();
        std::thread::Builder::new()
            .name("study".to_owned())
            .stack_size(STACK)
            .spawn(move || work(&theirs, tell))?;
        Ok(Worker { jobs })
    }

    /// Asks for a document; an older question for it that still waits is dropped.
    pub fn ask(&self, job: Job) {
        let (lock, bell) = &*self.jobs;
        let mut jobs = lock.lock().unwrap_or_else(PoisonError::into_inner);
        jobs.waiting.retain(|other| other.uri != job.uri);
        jobs.waiting.push(job);
        bell.notify_one();
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        let (lock, bell) = &*self.jobs;
        lock.lock().unwrap_or_else(PoisonError::into_inner).over = true;
        bell.notify_one();
    }
}

/// Works until there is no more to do. The server outlives a mistake of the program's own.
fn work(jobs: &(Mutex<Jobs>, Condvar), tell: impl Fn(Event)) {
    let mut uncut: BTreeMap<String, (Job, Vec<Garment>)> = BTreeMap::new();
    loop {
        match next(jobs, !uncut.is_empty()) {
            Next::Stop => return,
            Next::Study(job) => {
                let asked = job.clone();
                let study = catch_unwind(AssertUnwindSafe(|| Study::of(asked)));
                let mut study = study.unwrap_or(None).map(Box::new);
                uncut.remove(&job.uri);
                if let Some(study) = &mut study
                    && !study.garments.is_empty()
                {
                    let garments = std::mem::take(&mut study.garments);
                    uncut.insert(job.uri.clone(), (job.clone(), garments));
                }
                tell(Event::Studied(study, job));
            }
            Next::Cut => {
                let Some((uri, (job, garments))) = uncut.pop_first() else { continue };
                let busy = || {
                    let jobs = jobs.0.lock().unwrap_or_else(PoisonError::into_inner);
                    jobs.over || !jobs.waiting.is_empty()
                };
                let told = catch_unwind(AssertUnwindSafe(|| mistakes(&garments, busy)));
                match told {
                    Ok(Some(told)) => tell(Event::Cut(told, job)),
                    Ok(None) => drop(uncut.insert(uri, (job, garments))),
                    Err(_) => {}
                }
            }
        }
    }
}

/// Waits for a question, or, where something is left to cut, for a pause.
fn next((lock, bell): &(Mutex<Jobs>, Condvar), uncut: bool) -> Next {
    let mut jobs = lock.lock().unwrap_or_else(PoisonError::into_inner);
    loop {
        if jobs.over {
            return Next::Stop;
        }
        if let Some(job) = jobs.waiting.pop() {
            return Next::Study(job);
        }
        if !uncut {
            jobs = bell.wait(jobs).unwrap_or_else(PoisonError::into_inner);
            continue;
        }
        let (woken, waited) =
            bell.wait_timeout(jobs, PAUSE).unwrap_or_else(PoisonError::into_inner);
        jobs = woken;
        if waited.timed_out() && jobs.waiting.is_empty() && !jobs.over {
            return Next::Cut;
        }
    }
}

/// What the session hears of.
pub enum Event {
    /// A message of the client.
    Message(lsp_server::Message),
    /// A document was worked out, or could not be.
    Studied(Option<Box<Study>>, Job),
    /// What was wrong when its garments were cut.
    Cut(Vec<Diagnostic>, Job),
    /// The client is gone.
    Gone,
}

/// One queue for everything.
pub fn queue() -> (Sender<Event>, Receiver<Event>) {
    channel()
}
