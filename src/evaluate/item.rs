//! Items: named things with a block, made when they are first needed.

use super::fields::{Arg, Fields, Phrase, bare};
use super::panel::Draft;
use super::scope::{ScopeId, Waiting};
use super::value::Value;
use super::words::{Form, Kind};
use super::{Evaluator, figure, textile};
use crate::diagnostic::{Diagnostic, Span, either};
use crate::garment::sari::Sari;
use crate::garment::scene::BodyRequest;
use crate::syntax::tree::{Expr, ExprKind};
use crate::textile::fabric::Fabric;
use crate::textile::origin::Origins;
use crate::textile::{knit::Knit, motif::Motif, weave::Weave, yarn::Yarn};
use std::rc::Rc;

/// Number of an item.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct ItemId(pub(super) usize);

/// How far something is worked out.
#[derive(Clone, Debug)]
pub(super) enum State<T> {
    Pending,
    Running,
    Done(T),
}

/// A named thing with a block.
#[derive(Debug)]
pub struct Item<'t> {
    /// What it is.
    pub kind: Kind,
    /// Its name, with its number if it has one: `gore[2]`.
    pub name: String,
    /// Where the name stands.
    pub span: Span,
    /// Its line.
    pub phrase: Phrase<'t>,
    /// Where it is declared.
    pub scope: ScopeId,
    pub(super) made: State<Option<Made>>,
}

/// An item worked out.
#[derive(Clone, Debug)]
#[allow(missing_docs)]
pub enum Made {
    Yarn(Rc<Yarn>),
    /// A fabric, and where its measures come from.
    Fabric(Rc<Fabric>, Rc<Origins>),
    Weave(Rc<Weave>),
    Knit(Rc<Knit>),
    Motif(Rc<Motif>),
    /// A part of a sari, before a sari gives it its length.
    Part(Rc<super::sari::Draft>),
    /// A sari and the item of its fabric.
    Sari(Rc<Sari>, ItemId),
    Sizes(Rc<figure::Sizes>),
    /// A body: the figure with its measures.
    Body(Rc<figure::Body>),
    /// A wearer: the request, and the body it was made from.
    Wearer(Rc<BodyRequest>),
    Panel(Rc<Draft>),
    /// A part: the scope in which the names of its block stand.
    Opened(ScopeId),
}

impl<'t> Evaluator<'t> {
    /// The item of that number.
    pub fn item(&self, id: ItemId) -> &Item<'t> {
        &self.items[id.0]
    }

    /// Declares the item of a phrase such as `panel NAME …`; none if it has no usable name.
    pub(super) fn declare_item(
        &mut self,
        into: ScopeId,
        kind: Kind,
        mut phrase: Phrase<'t>,
    ) -> Option<Phrase<'t>> {
        let scope = phrase.scope;
        let head = *phrase.head.first()?;
        let (name, number) = match &head.kind {
            ExprKind::Path(_) => (bare(head)?, None),
            ExprKind::Index(base, numbers, None) if numbers.len() == 1 => {
                let number = numbers.first()?;
                let arg = Arg { expr: number, scope, of: "a number of an item" };
                (bare(base)?, Some(self.whole_number(arg, -1_000_000, 1_000_000)?))
            }
            ExprKind::Unread => return None,
            _ => {
                self.tell(
                    Diagnostic::new("E0201", format!("{} wants a name of its own", kind.title()))
                        .at(head.span, "here"),
                );
                return None;
            }
        };
        let shown = number.map_or(name.text.clone(), |n| format!("{}[{n}]", name.text));
        let shown = match self.parts.get(&into) {
            Some(&part) => format!("{}.{shown}", self.item(part).name),
            None => shown,
        };
        let id = ItemId(self.items.len());
        self.items.push(Item {
            kind,
            name: shown,
            span: head.span,
            phrase: phrase.clone(),
            scope: into,
            made: State::Pending,
        });
        match number {
            None => {
                self.declare(into, &name.text, name.span, scope, super::scope::What::Item(id));
            }
            Some(number) => self.declare_member(into, name, number, id, scope),
        }
        phrase.item = Some(id);
        Some(phrase)
    }

    /// The statements of an item's block, those of the item it copies first, with what the copy
    /// replaces or omits taken out; and where they are to be evaluated.
    pub(super) fn open_item(&mut self, id: ItemId) -> Option<Fields<'t>> {
        let scope = self.new_scope(Some(self.item(id).phrase.scope));
        let merged = self.merged(id, 0)?;
        let item = self.item(id);
        let (kind, span, title) =
            (item.kind, item.span, format!("{} `{}`", item.kind.noun(), item.name));
        Some(self.read_block(kind, span, title, &merged, scope))
    }

    /// The item named where one of a kind is wanted: own names first, then the library's.
    pub fn item_named(&mut self, arg: Arg<'t>, kind: Kind) -> Option<ItemId> {
        self.item_among(arg, &[kind])
    }

    /// As [`Self::item_named`], for one of several kinds.
    pub fn item_among(&mut self, arg: Arg<'t>, kinds: &[Kind]) -> Option<ItemId> {
        let libraries: Vec<&str> =
            kinds.iter().flat_map(|kind| kind.libraries()).copied().collect();
        let value = self.eval_with(arg, &libraries);
        match value {
            Value::Poison => None,
            Value::Item(id) if kinds.contains(&self.item(id).kind) => Some(id),
            other => {
                let found = other.describe(|id| self.item(id).kind);
                let wanted: Vec<&str> = kinds.iter().map(|kind| kind.title()).collect();
                let text = self.snippet(arg.expr.span).to_owned();
                self.tell(
                    Diagnostic::new("E0304", format!("`{text}` is {found}"))
                        .at(arg.expr.span, format!("{} is wanted", either(&wanted))),
                );
                None
            }
        }
    }

    /// Works an item out, once. Items that need each other are told.
    pub fn make(&mut self, id: ItemId, from: Span) -> Option<Made> {
        match &self.item(id).made {
            State::Done(made) => return made.clone(),
            State::Running => {
                self.tell_cycle(&Waiting::Item(id), from);
                return None;
            }
            State::Pending => {}
        }
        self.items[id.0].made = State::Running;
        self.waiting.push((Waiting::Item(id), from));
        let kind = self.item(id).kind;
        let made = self.deeper_item(from, |ev| match kind {
            Kind::Yarn => textile::yarn(ev, id).map(|it| Made::Yarn(Rc::new(it))),
            Kind::Fabric => textile::fabric(ev, id)
                .map(|(fabric, origins)| Made::Fabric(Rc::new(fabric), Rc::new(origins))),
            Kind::Weave => textile::weave(ev, id).map(|it| Made::Weave(Rc::new(it))),
            Kind::Knit => textile::knit(ev, id).map(|it| Made::Knit(Rc::new(it))),
            Kind::Motif => textile::motif(ev, id).map(|it| Made::Motif(Rc::new(it))),
            Kind::Ang | Kind::Kath | Kind::Padar => {
                super::sari::part(ev, id).map(|it| Made::Part(Rc::new(it)))
            }
            Kind::Sari => {
                super::sari::sari(ev, id).map(|(sari, fabric)| Made::Sari(Rc::new(sari), fabric))
            }
            Kind::Sizes => figure::sizes(ev, id).map(|it| Made::Sizes(Rc::new(it))),
            Kind::Body => figure::body(ev, id).map(|it| Made::Body(Rc::new(it))),
            Kind::Wearer => figure::wearer(ev, id).map(|it| Made::Wearer(Rc::new(it))),
            Kind::Cloth => ev.cloth(id).map(|it| Made::Panel(Rc::new(it))),
            Kind::Panel => ev.draft(id).map(|it| Made::Panel(Rc::new(it))),
            Kind::Part => ev.open_part(id).map(Made::Opened),
            _ => None,
        });
        self.waiting.pop();
        self.items[id.0].made = State::Done(made.clone());
        made
    }

    /// The wearer of that number, worked out.
    pub fn wearer(&mut self, id: ItemId, from: Span) -> Option<Rc<BodyRequest>> {
        match self.make(id, from)? {
            Made::Wearer(request) => Some(request),
            _ => None,
        }
    }

    /// The fabric of that number, worked out.
    pub fn fabric(&mut self, id: ItemId, from: Span) -> Option<Rc<Fabric>> {
        match self.make(id, from)? {
            Made::Fabric(fabric, _) => Some(fabric),
            _ => None,
        }
    }

    /// Works out all items of the given kinds that stand in a file, so that their mistakes are
    /// told even where nobody uses them.
    pub(super) fn make_all(&mut self, file: crate::diagnostic::FileId) {
        let mut at = 0;
        while let Some(item) = self.items.get(at) {
            let span = item.span;
            if span.file == file {
                self.make(ItemId(at), span);
            }
            at += 1;
        }
    }
}

/// Whether a word of the table declares an item of its block's kind.
pub(super) fn declares(form: Form) -> bool {
    form == Form::Item
}

/// The name under which an expression such as `gore[i]` or `front.left` starts.
pub(super) fn root(expr: &Expr) -> Option<&crate::syntax::tree::Name> {
    match &expr.kind {
        ExprKind::Path(_) => bare(expr),
        ExprKind::Member(base, _) | ExprKind::Within(base, _) | ExprKind::Index(base, ..) => {
            root(base)
        }
        ExprKind::Group(inner) => root(inner),
        ExprKind::Binary { left, .. } => root(left),
        _ => None,
    }
}
