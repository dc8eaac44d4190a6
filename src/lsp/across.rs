//! Names in all files of a project: their uses, and new names for them.

use super::document::{Document, Known, text_of};
use super::session::{Refused, Session};
use super::study::{Anchors, Job, Place, Study};
use super::text::Text;
use super::{definition, rename, uri};
use gen_lsp_types::{Location, Position, Range, TextEdit, Uri, WorkspaceEdit};
use lsp_server::ErrorCode;
use std::collections::{BTreeSet, HashMap};
use std::path::{Path, PathBuf};
use std::rc::Rc;

/// Files of a workspace that are looked through for uses of a name.
const FILES: usize = 500;

impl Session<'_> {
    /// All documents and files of the project in which the name of some declarations may stand,
    /// worked out: those that lie open, and those on the disk that write the name.
    fn studies(&self, document: &Document, known: &Known, name: &str) -> Vec<Rc<Study>> {
        let mut found = vec![known.study.clone()];
        let Some(folder) = &document.place.folder else { return found };
        let job = self.job(document);
        let mut seen: BTreeSet<String> = BTreeSet::from([document.place.path.clone()]);
        for other in self.documents.values() {
            if other.place.folder.as_ref() == Some(folder) && seen.insert(other.place.path.clone())
            {
                let study = other.study.clone().filter(|_| other.is_known());
                let study = study.or_else(|| Study::of(self.job(other)).map(Rc::new));
                found.extend(study);
            }
        }
        for path in garments(folder) {
            let inside = path.strip_prefix(folder).ok().and_then(Path::to_str);
            let Some(inside) = inside.map(|inside| inside.replace('\\', "/")) else { continue };
            if !seen.insert(inside.clone()) {
                continue;
            }
            let text = std::fs::read_to_string(&path).unwrap_or_default();
            if !text.contains(name) || !text.contains("use") {
                continue;
            }
            let place = Place { folder: Some(folder.clone()), path: inside };
            let Some(uri) = uri::of(&path) else { continue };
            found.extend(Study::of(Job { uri, place, ..job.clone() }).map(Rc::new));
        }
        found
    }

    pub(super) fn references(
        &self,
        document: &Document,
        place: Position,
        with: bool,
    ) -> Vec<Location> {
        let Some(known) = document.known() else { return Vec::new() };
        let outline = document.outline();
        let Some(number) = definition::word_at(document, &outline, place) else {
            return Vec::new();
        };
        let name = outline.slice(&document.text.text, number);
        let places = definition::occurrences(document, &known, place, true);
        let anchors = known.study.anchors(&places);
        let mut found: Vec<Location> = Vec::new();
        for study in self.studies(document, &known, name) {
            let other = self.documents.get(&study.job.uri).and_then(Document::known);
            let home = self.documents.get(&study.job.uri);
            let (Some(home), Some(known)) = (home, other) else {
                // A file on the disk, just read.
                found.extend(self.in_file(&study, document, &anchors, with));
                continue;
            };
            let here = known.study.places(&known.study.anchored(&anchors));
            let here = here
                .into_iter()
                .filter(|span| with || known.study.definitions(*span).next().is_none())
                .collect();
            found.extend(definition::locations(home, &known, &self.folders, here));
        }
        let mut seen: Vec<Location> = Vec::new();
        for location in found {
            if !seen.contains(&location) {
                seen.push(location);
            }
        }
        seen
    }

    /// Uses in a file that is not open.
    fn in_file(
        &self,
        study: &Rc<Study>,
        like: &Document,
        anchors: &Anchors,
        with: bool,
    ) -> Vec<Location> {
        let places = study.places(&study.anchored(anchors));
        places
            .into_iter()
            .filter(|span| with || study.definitions(*span).next().is_none())
            .filter_map(|span| {
                let uri = Uri(self.folders.address(study, span.file)?);
                let text = text_of(study, span.file, &like.text);
                Some(Location { uri, range: text.span(span) })
            })
            .collect()
    }

    /// The range of a name that can be given another one.
    pub(super) fn renameable(
        &self,
        document: &Document,
        place: Position,
    ) -> Result<Option<Range>, Refused> {
        let outline = document.outline();
        let Some(number) = definition::word_at(document, &outline, place) else { return Ok(None) };
        let Some(token) = outline.tokens.get(number) else { return Ok(None) };
        let Some(known) = document.known() else { return Ok(None) };
        let places = definition::occurrences(document, &known, place, true);
        if places.is_empty() {
            return Ok(None);
        }
        let name = outline.slice(&document.text.text, number);
        rename::edits(&known.study, &places, name)
            .map_err(|why| (ErrorCode::RequestFailed, why))?;
        Ok(Some(document.text.range(token.start, token.end)))
    }

    pub(super) fn rename(
        &self,
        document: &Document,
        place: Position,
        new: &str,
    ) -> Result<Option<WorkspaceEdit>, Refused> {
        let refuse = |why: String| (ErrorCode::RequestFailed, why);
        rename::is_name(new).map_err(refuse)?;
        let Some(known) = document.known().filter(|_| document.is_known()) else {
            return Err(refuse("the document is still being worked out".to_owned()));
        };
        let outline = document.outline();
        let Some(number) = definition::word_at(document, &outline, place) else { return Ok(None) };
        let name = outline.slice(&document.text.text, number);
        let places = definition::occurrences(document, &known, place, true);
        if places.is_empty() {
            return Err(refuse(format!("`{name}` is no name of this text")));
        }
        let anchors = known.study.anchors(&places);
        let studies = self.studies(document, &known, name);
        let mut all = rename::Edits::new();
        for study in &studies {
            let places = study.places(&study.anchored(&anchors));
            for (path, found) in rename::edits(study, &places, name).map_err(refuse)? {
                all.entry(path).or_default().extend(found);
            }
        }
        let mut changes: HashMap<Uri, Vec<TextEdit>> = HashMap::new();
        for study in &studies {
            let touched = study.desk.files().any(|(_, path, _)| all.contains_key(path));
            if touched {
                rename::try_out(study, &all, new).map_err(refuse)?;
            }
            for (file, path, text) in study.desk.files() {
                let Some(places) = all.get(path) else { continue };
                let Some(uri) = self.folders.address(study, file) else { continue };
                let text = Text::new(text, self.encoding);
                let edits = places
                    .iter()
                    .map(|(start, end)| TextEdit {
                        range: text.range(*start as usize, *end as usize),
                        new_text: new.to_owned(),
                    })
                    .collect();
                changes.insert(Uri(uri), edits);
            }
        }
        Ok(Some(WorkspaceEdit { changes: Some(changes), ..WorkspaceEdit::default() }))
    }
}

/// The garment files in a folder and below, hidden folders left out; so many, in order.
fn garments(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![folder.to_path_buf()];
    let mut looked = 0;
    while let Some(folder) = folders.pop() {
        looked += 1;
        if looked > FILES || found.len() >= FILES {
            break;
        }
        let Ok(entries) = std::fs::read_dir(&folder) else { continue };
        let mut paths: Vec<PathBuf> =
            entries.take(10_000).flatten().map(|entry| entry.path()).collect();
        paths.sort();
        for path in paths {
            let name = path.file_name().and_then(std::ffi::OsStr::to_str).unwrap_or(".");
            let link = path.symlink_metadata().is_ok_and(|data| data.is_symlink());
            if name.starts_with('.') || name == "target" || name == "node_modules" {
                continue;
            }
            if path.is_dir() && !link {
                folders.push(path);
            } else if path.extension().is_some_and(|end| end == "garment") && path.is_file() {
                found.push(path);
            }
        }
    }
    found.truncate(FILES);
    found
}
