//! Names, units, parameters: the tree of a text becomes garments.
//!
//! [`evaluate`] reads a file with all it uses and works out every garment, scene and sari in it.
//! Values are worked out when they are first needed, so declarations may stand in any order; a
//! value that is wrong is told once and poisons silently whatever is made of it, so that one run
//! tells all mistakes. Everything is bounded: no recursion, loops over finite ranges, a limit of
//! steps for the whole text.

mod block;
pub mod catalogue;
mod choice;
mod cord;
mod declaration;
pub(crate) mod drafts;
mod drape;
mod expression;
pub mod facts;
pub mod fields;
pub mod figure;
mod function;
mod garment;
mod hold;
pub mod item;
mod module;
mod notch;
mod operator;
mod order;
pub mod panel;
mod part;
mod patch;
mod phrase;
mod place;
mod poison;
mod read;
mod record;
mod row;
pub mod sari;
mod scene;
pub mod scope;
mod seam;
mod stitch;
pub mod textile;
pub mod value;
pub mod words;

use crate::diagnostic::{Diagnostic, FileId, Span, in_order};
use crate::garment::Garment;
use crate::syntax::tree::Expr;
use crate::units::Quantity;
use crate::world::World;
use facts::{Facts, Notes};
pub use function::functions;
use item::{Item, ItemId};
use module::{Asked, Loaded};
pub use read::kinds;
use scope::{Binding, BindingId, Scope, ScopeId, Waiting};
use std::collections::{BTreeMap, BTreeSet};

/// What is asked for besides the text.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// Parameters set from outside, `("ease", "3cm")`.
    pub set: Vec<(String, String)>,
    /// Names of the garments and scenes that are wanted; empty for all.
    pub names: Vec<String>,
    /// The size of wearers instead of their own, `EU 42`.
    pub size: Option<String>,
}

/// Steps of evaluation one text may take; an ordinary garment takes some ten thousand.
const STEPS: u64 = 10_000_000;

/// Steps that one call of a function stands for, one line in one turn of a loop, and one opening
/// of a panel: all leave names behind, so that the limit of steps also bounds memory.
const CALL: u64 = 100;
const LINE: u64 = 50;
const OPENING: u64 = 300;

/// Messages of one code at one place.
const ALIKE: usize = 10;

/// How deep values may hang on each other.
const DEPTH: usize = 3_000;

/// Stack for that depth, in bytes.
const STACK: usize = 512 << 20;

/// Names of the places of every body, as a text writes them: `waist`, `left_knee`.
pub fn places() -> impl Iterator<Item = String> {
    place::places()
}

/// Works out all garments and scenes of a file. Where a diagnostic is an error, the garment it
/// belongs to is left out. Diagnostics stand [in the order of the text](in_order).
pub fn evaluate(
    world: &mut dyn World,
    root: FileId,
    options: &Options,
) -> (Vec<Garment>, Vec<Diagnostic>) {
    work(world, root, options, |evaluator| evaluator.file(&options.names))
}

/// As [`evaluate()`], and notes on the way what there is to know about the text.
pub fn study(
    world: &mut dyn World,
    root: FileId,
    options: &Options,
) -> (Vec<Garment>, Vec<Diagnostic>, Facts) {
    let ((garments, facts), told) = work(world, root, options, |evaluator| {
        evaluator.notes = Some(Box::default());
        (evaluator.file(&options.names), evaluator.facts())
    });
    (garments, told, facts)
}

/// Reads a file with all it uses and does a piece of work on it.
fn work<T: Default + Send>(
    world: &mut dyn World,
    root: FileId,
    options: &Options,
    job: impl FnOnce(&mut Evaluator<'_>) -> T + Send,
) -> (T, Vec<Diagnostic>) {
    let (files, asked, mut told) = module::load(world, root, &options.set);
    // Values nest as deep as the text makes them; the work gets a stack that holds the limit.
    let worked = std::thread::scope(|scope| {
        std::thread::Builder::new()
            .stack_size(STACK)
            .spawn_scoped(scope, || {
                let mut evaluator = Evaluator::new(&files, &asked, root, options.size.as_deref());
                let result = job(&mut evaluator);
                (result, evaluator.told)
            })
            .map(std::thread::ScopedJoinHandle::join)
    });
    let result = match worked {
        Ok(Ok((result, more))) => {
            told.extend(more);
            result
        }
        Ok(Err(panic)) => std::panic::resume_unwind(panic),
        Err(error) => {
            told.push(
                Diagnostic::new("E0911", format!("there is no room to work: {error}"))
                    .at(Span::new(root, 0, 0), ""),
            );
            T::default()
        }
    };
    in_order(root, &mut told);
    (result, told)
}

/// Everything known while a file is worked out.
pub struct Evaluator<'t> {
    files: &'t [Loaded],
    options: &'t [Asked],
    root: FileId,
    scopes: Vec<Scope>,
    bindings: Vec<Binding<'t>>,
    items: Vec<Item<'t>>,
    instances: Vec<panel::Instance<'t>>,
    /// Blocks of cloths, read once.
    cloths: BTreeMap<ItemId, fields::Fields<'t>>,
    /// Values of fitted names, by the scope of the panel they belong to.
    fits: BTreeMap<ScopeId, BTreeMap<String, Quantity>>,
    /// Scopes of panels opened only to try a value of a fit.
    trials: BTreeSet<ScopeId>,
    /// Parameters set by copies, by the scope of the copy.
    settings: BTreeMap<ScopeId, Vec<block::Setting<'t>>>,
    /// Parts by the scopes in which the names of their blocks stand, and what they hold.
    parts: BTreeMap<ScopeId, ItemId>,
    opened: BTreeMap<ItemId, fields::Fields<'t>>,
    /// The block of each part.
    blocks: BTreeMap<ItemId, ItemId>,
    /// Scopes of blocks that are looked at although no part uses them.
    lone: BTreeSet<ScopeId>,
    /// Where a line of a block is worked out, while so many wait.
    within: Option<(ScopeId, usize)>,
    /// The size that was asked for instead of the wearers' own.
    size: Option<&'t str>,
    /// Scopes of the library's modules, by their paths.
    libraries: BTreeMap<String, ScopeId>,
    parameters: Vec<BindingId>,
    asked_for: BTreeSet<String>,
    /// Names of halves by panel, from the places of the garment being worked out.
    sides: BTreeMap<ItemId, panel::Standing>,
    waiting: Vec<(Waiting, Span)>,
    /// Bodies of the functions being called.
    calling: Vec<&'t Expr>,
    told: Vec<Diagnostic>,
    /// Lines whose words their blocks do not know, with the words that were probably meant.
    unknown: BTreeMap<(Span, words::Kind), Option<&'static words::Word>>,
    /// Numbers of what was told, by main place and code.
    told_at: BTreeMap<(Option<Span>, String), Vec<usize>>,
    /// What is noted for editors, if that is asked for.
    notes: Option<Box<Notes>>,
    depth: usize,
    steps: u64,
    turns: usize,
    exhausted: bool,
    /// Whether a file could not be used that would have brought names nobody knows.
    blind: bool,
}

impl<'t> Evaluator<'t> {
    fn new(files: &'t [Loaded], options: &'t [Asked], root: FileId, size: Option<&'t str>) -> Self {
        Evaluator {
            files,
            options,
            root,
            scopes: Vec::new(),
            bindings: Vec::new(),
            items: Vec::new(),
            instances: Vec::new(),
            cloths: BTreeMap::new(),
            fits: BTreeMap::new(),
            trials: BTreeSet::new(),
            settings: BTreeMap::new(),
            parts: BTreeMap::new(),
            opened: BTreeMap::new(),
            blocks: BTreeMap::new(),
            lone: BTreeSet::new(),
            within: None,
            size,
            libraries: BTreeMap::new(),
            parameters: Vec::new(),
            asked_for: BTreeSet::new(),
            sides: BTreeMap::new(),
            waiting: Vec::new(),
            calling: Vec::new(),
            told: Vec::new(),
            unknown: BTreeMap::new(),
            told_at: BTreeMap::new(),
            notes: None,
            depth: 0,
            steps: 0,
            turns: 0,
            exhausted: false,
            blind: false,
        }
    }

    /// Says something about the text, once. What a loop does wrong at one place in each of its
    /// turns is said a few times only.
    pub fn tell(&mut self, diagnostic: Diagnostic) {
        let place = diagnostic.labels.first().map(|label| label.span);
        let same = self.told_at.entry((place, diagnostic.code.clone())).or_default();
        // What was told may name the part of which it was told besides.
        let known = |told: &Diagnostic| {
            told.message == diagnostic.message
                && told.help == diagnostic.help
                && diagnostic.labels.iter().all(|label| told.labels.contains(label))
        };
        if same.len() < ALIKE && same.iter().all(|&number| !known(&self.told[number])) {
            same.push(self.told.len());
            let diagnostic = self.in_part(diagnostic);
            self.told.push(diagnostic);
        }
    }

    /// Whether this was said of a place already.
    fn was_told(&self, code: &str, at: Span, message: &str) -> bool {
        let same = self.told_at.get(&(Some(at), code.to_owned())).into_iter().flatten();
        same.into_iter().any(|&number| self.told[number].message == message)
    }

    /// The text of a place.
    pub fn snippet(&self, span: Span) -> &'t str {
        self.files
            .iter()
            .find(|file| file.id == span.file)
            .and_then(|file| file.text.get(span.start as usize..span.end as usize))
            .unwrap_or("")
    }

    /// Counts steps; false once the text has taken more than it may, which is told once.
    fn step(&mut self, steps: u64, at: Span) -> bool {
        self.steps = self.steps.saturating_add(steps);
        if self.steps <= STEPS {
            return true;
        }
        if !self.exhausted {
            self.exhausted = true;
            self.tell(
                Diagnostic::new("E0210", "this text takes too long to work out")
                    .at(at, "stopped here")
                    .help("call fewer functions from functions, or go through shorter ranges"),
            );
        }
        false
    }

    /// Works something out one level deeper; too deep is told.
    fn deeper(&mut self, at: Span, work: impl FnOnce(&mut Self) -> value::Value) -> value::Value {
        self.nested(1, at, work).unwrap_or(value::Value::Poison)
    }

    /// Works an item out; it takes more stack than a value.
    fn deeper_item<T>(&mut self, at: Span, work: impl FnOnce(&mut Self) -> Option<T>) -> Option<T> {
        self.nested(10, at, work).flatten()
    }

    fn nested<T>(
        &mut self,
        levels: usize,
        at: Span,
        work: impl FnOnce(&mut Self) -> T,
    ) -> Option<T> {
        if self.depth + levels > DEPTH {
            self.tell(
                Diagnostic::new("E0211", "these values hang on each other too deep")
                    .at(at, "here")
                    .help("shorten the chain of names"),
            );
            return None;
        }
        self.depth += levels;
        let result = work(self);
        self.depth -= levels;
        Some(result)
    }
}
