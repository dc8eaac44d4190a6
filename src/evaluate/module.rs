//! Files: a text with everything it uses, read once before anything is worked out.

use super::drafts::{Drafts, drafts};
use super::scope::{ScopeId, What};
use super::words::Kind;
use super::{Evaluator, block::Merged, record};
use crate::diagnostic::{Diagnostic, FileId, Span};
use crate::syntax::{
    parse,
    tree::{Expr, File, Name, Source, SourcePath, Statement, StatementKind},
};
use crate::world::World;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

/// Files one text may use, one through another.
const FILES: usize = 1_000;

/// The library's modules whose names are known by kind.
const LIBRARY: &[&str] = &[
    "std::color",
    "std::yarn",
    "std::weave",
    "std::knit",
    "std::motif",
    "std::fabric",
    "std::body",
    "std::ang",
    "std::kath",
    "std::padar",
];

/// The library's modules of blocks, read only where a text may have parts.
pub(super) const BLOCKS: &[&str] =
    &["std::bodice", "std::collar", "std::indian", "std::skirt", "std::sleeve", "std::trousers"];

/// A file that was read.
#[derive(Debug)]
pub(super) struct Loaded {
    pub id: FileId,
    /// How it was asked for: a path from the project's root, or `std::fabric`.
    pub path: String,
    pub text: String,
    pub tree: Arc<File>,
    /// What its `use` lines point to.
    uses: Vec<Option<FileId>>,
    /// The weaving files that it names, by the places of their paths; those that cannot be read
    /// are told and left out.
    pub drafts: Drafts,
}

/// A parameter set from outside.
#[derive(Debug)]
pub(super) struct Asked {
    pub name: Name,
    pub value: Expr,
}

/// All sources that a file's `use` statements name.
fn sources(tree: &File) -> impl Iterator<Item = &Source> {
    tree.statements.iter().flat_map(|statement| match &statement.kind {
        StatementKind::Use(sources) => sources.as_slice(),
        _ => &[],
    })
}

/// The file a source lies in: for `std::body::female` the module `std::body`.
fn path_of(source: &Source, from: &str) -> Option<String> {
    match &source.from {
        SourcePath::File(name) => {
            let folder = from.rfind('/').map_or("", |end| from.get(..=end).unwrap_or(""));
            Some(format!("{folder}{}", name.text))
        }
        SourcePath::Path(names) => {
            let texts: Vec<&str> = names.iter().take(2).map(|name| name.text.as_str()).collect();
            (texts.first() == Some(&"std")).then(|| texts.join("::"))
        }
    }
}

/// A text that was read, with what it says wrong.
struct Read {
    text: String,
    tree: Arc<File>,
    told: Vec<Diagnostic>,
}

/// Texts that were read, by their names and numbers: an editor asks for the library and all files
/// beside its own again after every letter, and a garment is drafted anew for each of its sizes.
static READ: Mutex<BTreeMap<(String, FileId), Read>> = Mutex::new(BTreeMap::new());

/// So long may they be together, in bytes.
const KEPT: usize = 4 << 20;

/// Reads a file, unless its text is still known.
fn read(id: FileId, path: &str, text: &str) -> (Arc<File>, Vec<Diagnostic>) {
    let key = (path.to_owned(), id);
    {
        let kept = READ.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = kept.get(&key).filter(|known| known.text == text) {
            return (known.tree.clone(), known.told.clone());
        }
    }
    let (mut tree, told) = parse(id, text);
    record::read_settings(&mut tree.statements);
    let tree = Arc::new(tree);
    let mut kept = READ.lock().unwrap_or_else(PoisonError::into_inner);
    kept.remove(&key);
    let length: usize = kept.values().map(|known| known.text.len()).sum();
    if length + text.len() > KEPT {
        kept.clear();
    }
    if text.len() <= KEPT {
        let read = Read { text: text.to_owned(), tree: tree.clone(), told: told.clone() };
        kept.insert(key, read);
    }
    (tree, told)
}

/// Reads `root`, the library, and every file that is used from there.
pub(super) fn load(
    world: &mut dyn World,
    root: FileId,
    set: &[(String, String)],
) -> (Vec<Loaded>, Vec<Asked>, Vec<Diagnostic>) {
    let mut told = Vec::new();
    let mut files: Vec<Loaded> = Vec::new();
    let mut waiting: Vec<(FileId, String)> = Vec::new();
    for module in LIBRARY {
        // A library without a module is no mistake of the text; its names will be unknown.
        if let Ok(id) = world.open(module) {
            waiting.push((id, (*module).to_owned()));
        }
    }
    let root_path = world.path(root).to_owned();
    waiting.push((root, root_path));
    while let Some((id, path)) = waiting.pop() {
        if files.iter().any(|file| file.id == id) {
            continue;
        }
        let text = world.text(id).to_owned();
        if text.contains("part") && !path.starts_with("std::") {
            for module in BLOCKS {
                if let Ok(id) = world.open(module) {
                    waiting.push((id, (*module).to_owned()));
                }
            }
        }
        let (tree, mistakes) = read(id, &path, &text);
        told.extend(mistakes);
        let mut uses = Vec::new();
        for source in sources(&tree) {
            let Some(wanted) = path_of(source, &path) else {
                let said = match &source.from {
                    SourcePath::Path(names) => names.first().map_or("", |name| &name.text),
                    SourcePath::File(name) => &name.text,
                };
                let path = said.strip_suffix(".garment").unwrap_or(said);
                told.push(
                    Diagnostic::new("E0901", "only the library is used without quotation marks")
                        .at(source.span, "not found")
                        .help(format!("a file is used by its path: `use \"{path}.garment\"`")),
                );
                uses.push(None);
                continue;
            };
            match world.open(&wanted) {
                Ok(used) if files.len() + waiting.len() < FILES => {
                    uses.push(Some(used));
                    waiting.push((used, wanted));
                }
                Ok(_) => {
                    told.push(
                        Diagnostic::new("E0903", format!("more than {FILES} files are used"))
                            .at(source.span, "here"),
                    );
                    uses.push(None);
                }
                Err(reason) => {
                    told.push(Diagnostic::new("E0903", reason).at(source.span, "here"));
                    uses.push(None);
                }
            }
        }
        let drafts = drafts(world, &path, &tree, &mut told);
        files.push(Loaded { id, path, text, tree, uses, drafts });
    }
    tell_rings(&files, &mut told);
    let asked = set.iter().filter_map(|pair| ask(world, pair, &mut files, &mut told)).collect();
    (files, asked, told)
}

/// Reads `--set name=value` as a text of its own, so that its mistakes have their places.
fn ask(
    world: &mut dyn World,
    (name, value): &(String, String),
    files: &mut Vec<Loaded>,
    told: &mut Vec<Diagnostic>,
) -> Option<Asked> {
    let text = format!("let {name} = {value}");
    let id = world.take_in("--set", &text);
    let (tree, mistakes) = parse(id, &text);
    let asked = match tree.statements.as_slice() {
        [Statement { kind: StatementKind::Let { name, value }, .. }] if mistakes.is_empty() => {
            Some(Asked { name: name.clone(), value: value.clone() })
        }
        _ => {
            if mistakes.is_empty() {
                told.push(
                    Diagnostic::new("E0212", format!("`{name}` cannot be set to this"))
                        .at(Span::new(id, 0, text.len()), "one value is wanted")
                        .help(format!("such as `{name}=3cm`")),
                );
            }
            None
        }
    };
    told.extend(mistakes);
    files.push(Loaded {
        id,
        path: "--set".to_owned(),
        text,
        tree: Arc::default(),
        uses: Vec::new(),
        drafts: Drafts::default(),
    });
    asked
}

/// Files that use each other are told (E0902), each ring once.
fn tell_rings(files: &[Loaded], told: &mut Vec<Diagnostic>) {
    let find = |id: FileId| files.iter().position(|file| file.id == id);
    let mut state = vec![0_u8; files.len()];
    for start in 0..files.len() {
        // Depth first with a stack of (file, next use).
        let mut path: Vec<(usize, usize)> = Vec::new();
        if state[start] == 0 {
            state[start] = 1;
            path.push((start, 0));
        }
        while let Some((file, next)) = path.pop() {
            let Some(used) = files[file].uses.get(next) else {
                state[file] = 2;
                continue;
            };
            path.push((file, next + 1));
            let Some(other) = used.and_then(&find) else { continue };
            if state[other] == 0 {
                state[other] = 1;
                path.push((other, 0));
            } else if state[other] == 1 {
                let mut ring = Diagnostic::new("E0902", "these files use each other")
                    .help("move what both need into a third");
                let from = path.iter().position(|(at, _)| *at == other).unwrap_or(0);
                for (at, next) in path.iter().skip(from) {
                    let source = sources(&files[*at].tree).nth(next.saturating_sub(1));
                    if let Some(source) = source {
                        let target = files[*at].uses.get(next.saturating_sub(1)).copied();
                        let name = target
                            .flatten()
                            .and_then(&find)
                            .map_or("", |index| files[index].path.as_str());
                        ring = ring.at(source.span, format!("uses {name}"));
                    }
                }
                told.push(ring);
            }
        }
    }
}

impl<'t> Evaluator<'t> {
    /// Declares the names of every file: its own first, then those it uses.
    pub(super) fn open_files(&mut self) -> (ScopeId, super::fields::Fields<'t>) {
        let files = self.files;
        let mut scopes: BTreeMap<FileId, ScopeId> = BTreeMap::new();
        for file in files {
            let scope = self.new_scope(None);
            scopes.insert(file.id, scope);
            if file.path.starts_with("std::") {
                self.libraries.insert(file.path.clone(), scope);
            }
        }
        let mut root = None;
        for file in files {
            let Some(&scope) = scopes.get(&file.id) else { continue };
            let used = sources(&file.tree).zip(&file.uses);
            for (source, target) in used {
                let Some(target) = target else {
                    self.lost(source, scope);
                    continue;
                };
                let Some((&inner, other)) =
                    scopes.get(target).zip(files.iter().find(|file| file.id == *target))
                else {
                    continue;
                };
                self.bring(source, scope, inner, other);
            }
            let statements: Vec<&'t Statement> = file.tree.statements.iter().collect();
            let merged = Merged { statements, ..Merged::default() };
            let span = Span::new(file.id, 0, 0);
            let fields =
                self.read_block(Kind::File, span, format!("`{}`", file.path), &merged, scope);
            if file.id == self.root {
                root = Some((scope, fields));
            }
        }
        root.unwrap_or_else(|| {
            let scope = self.new_scope(None);
            let fields = super::fields::Fields {
                kind: Kind::File,
                span: Span::new(self.root, 0, 0),
                title: String::new(),
                scope,
                phrases: Vec::new(),
                spoiled: Vec::new(),
            };
            (scope, fields)
        })
    }

    /// Names that a file which cannot be used would have brought are not told to be unknown.
    fn lost(&mut self, source: &'t Source, into: ScopeId) {
        match (&source.alias, &source.from) {
            (Some(alias), _) => self.poison_name(Some(alias), into),
            (None, SourcePath::Path(path)) => self.poison_name(path.get(2), into),
            (None, SourcePath::File(_)) => {}
        }
        source.names.iter().for_each(|name| self.poison_name(Some(name), into));
        self.blind |= source.names.is_empty() && source.alias.is_none();
    }

    /// Makes names of another file known.
    fn bring(&mut self, source: &'t Source, into: ScopeId, from: ScopeId, other: &Loaded) {
        let mut names: Vec<&'t Name> = source.names.iter().collect();
        if let SourcePath::Path(path) = &source.from {
            names.extend(path.get(2));
            if let Some(extra) = path.get(3) {
                self.tell(
                    Diagnostic::new("E0901", "this path goes too deep")
                        .at(extra.span, "not found")
                        .help("such as `std::fabric::denim`"),
                );
            }
        }
        let declared: Vec<&Name> = declared_names(&other.tree);
        let (hidden, declared): (Vec<&Name>, Vec<&Name>) =
            declared.into_iter().partition(|name| name.text.starts_with('_'));
        if names.is_empty() {
            for name in declared {
                self.alias(into, from, &name.text, &name.text, source.span);
            }
            return;
        }
        let single = names.len() == 1;
        for name in names {
            if declared.iter().any(|known| known.text == name.text) {
                let (alias, span) = match &source.alias {
                    Some(alias) if single => (alias.text.as_str(), alias.span),
                    _ => (name.text.as_str(), name.span),
                };
                self.alias(into, from, alias, &name.text, span);
            } else if hidden.iter().any(|known| known.text == name.text) {
                let message = format!("`{}` keeps `{}` to itself", other.path, name.text);
                self.tell(
                    Diagnostic::new("E0901", message)
                        .at(name.span, "names that begin with `_` are for their own file")
                        .help("give it a name without `_` there, or use another"),
                );
                self.poison_name(Some(name), into);
            } else {
                let label = self.meant(&name.text, declared.iter().map(|name| name.text.as_str()));
                self.tell(
                    Diagnostic::new("E0901", format!("`{}` has no `{}`", other.path, name.text))
                        .at(name.span, label),
                );
                self.poison_name(Some(name), into);
            }
        }
        if let (Some(alias), false) = (&source.alias, single) {
            self.tell(
                Diagnostic::new("E0901", "`as` renames one name")
                    .at(alias.span, "here several are used")
                    .help("use each in a line of its own"),
            );
        }
    }

    fn alias(&mut self, into: ScopeId, from: ScopeId, alias: &str, name: &str, span: Span) {
        let what = What::Alias { scope: from, name: name.to_owned() };
        self.declare(into, alias, span, into, what);
    }
}

/// Names that a file declares at its level.
fn declared_names(tree: &File) -> Vec<&Name> {
    let items = super::words::vocabulary(Kind::File);
    tree.statements
        .iter()
        .filter_map(|statement| match &statement.kind {
            StatementKind::Let { name, .. }
            | StatementKind::Param { name, .. }
            | StatementKind::Function { name, .. } => Some(name),
            StatementKind::Line { word, phrase, .. } => {
                items.find(&word.text, false).filter(|word| super::item::declares(word.form))?;
                match phrase.first() {
                    Some(crate::syntax::tree::Item::Expr(expr)) => super::item::root(expr),
                    _ => None,
                }
            }
            _ => None,
        })
        .collect()
}
