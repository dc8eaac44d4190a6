//! Names: where they are declared, what they stand for, and who waits for whom.

use super::Evaluator;
use super::item::{ItemId, State};
use super::panel::InstanceId;
use super::value::Value;
use crate::diagnostic::{Diagnostic, Span};
use crate::syntax::tree::{Expr, Formal, Name};
use std::collections::BTreeMap;

/// Number of a scope.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct ScopeId(pub(super) usize);

/// Number of a binding.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct BindingId(pub(super) usize);

/// The names of one block.
#[derive(Debug, Default)]
pub(super) struct Scope {
    pub parent: Option<ScopeId>,
    pub names: BTreeMap<String, BindingId>,
}

/// What a name stands for.
#[derive(Clone, Debug)]
pub(super) enum What<'t> {
    /// `let w = …`
    Let(&'t Expr),
    /// `param ease = … in …`, with what was set from outside.
    Param {
        kind: Option<&'t Name>,
        default: Option<&'t Expr>,
        range: Option<&'t Expr>,
        set: Option<(&'t Expr, ScopeId)>,
    },
    /// `fn f(a: length) = …`
    Function { formals: &'t [Formal], kind: Option<&'t Name>, value: &'t Expr },
    /// An item.
    Item(ItemId),
    /// Items of one name with numbers, `gore[1]`.
    Family(BTreeMap<i64, ItemId>),
    /// An edge of the panel whose block this is.
    Edge(InstanceId),
    /// The label of an action.
    Label,
    /// A name of another file.
    Alias { scope: ScopeId, name: String },
    /// A value known from outside: a counter, an argument, a fitted name.
    Given(Value),
}

impl What<'_> {
    /// What it is, for messages.
    fn title(&self) -> &'static str {
        match self {
            What::Let(_) => "a name here",
            What::Param { .. } => "a parameter here",
            What::Function { .. } => "a function here",
            What::Item(_) | What::Family(_) => "an item here",
            What::Edge(_) => "an edge here",
            What::Label => "a label here",
            What::Alias { .. } => "used from another file here",
            What::Given(_) => "a name here",
        }
    }
}

/// A name with what it stands for.
#[derive(Debug)]
pub(super) struct Binding<'t> {
    pub name: String,
    pub span: Span,
    pub scope: ScopeId,
    pub what: What<'t>,
    pub state: State<Value>,
}

impl<'t> Evaluator<'t> {
    pub(super) fn new_scope(&mut self, parent: Option<ScopeId>) -> ScopeId {
        self.scopes.push(Scope { parent, names: BTreeMap::new() });
        ScopeId(self.scopes.len() - 1)
    }

    /// Makes a name known in a scope. A name that has a meaning there or around it is told
    /// (E0205), and the first meaning stays.
    pub(super) fn declare(
        &mut self,
        into: ScopeId,
        name: &str,
        span: Span,
        evaluated_in: ScopeId,
        what: What<'t>,
    ) -> BindingId {
        if let Some(before) = self.find(into, name) {
            let other = &self.bindings[before.0];
            // An own name goes before one brought in from another file.
            let hides_alias = matches!(other.what, What::Alias { .. })
                && self.scopes[into.0].names.get(name) != Some(&before);
            if !hides_alias {
                let told = Diagnostic::new("E0205", format!("`{name}` is used for two things"))
                    .at(other.span, other.what.title())
                    .at(span, what.title())
                    .help(
                        "rename one; a name keeps one meaning in a block and in all blocks inside it",
                    );
                self.tell(told);
                return before;
            }
        }
        let id = BindingId(self.bindings.len());
        self.bindings.push(Binding {
            name: name.to_owned(),
            span,
            scope: evaluated_in,
            what,
            state: State::Pending,
        });
        self.scopes[into.0].names.insert(name.to_owned(), id);
        id
    }

    /// The binding of a name, looked up outwards.
    pub(super) fn find(&self, scope: ScopeId, name: &str) -> Option<BindingId> {
        let mut at = Some(scope);
        while let Some(id) = at {
            let scope = self.scopes.get(id.0)?;
            if let Some(found) = scope.names.get(name) {
                return Some(*found);
            }
            at = scope.parent;
        }
        None
    }

    /// All names visible from a scope, for suggestions.
    pub(super) fn visible(&self, scope: ScopeId) -> Vec<String> {
        let mut names = Vec::new();
        let mut at = Some(scope);
        while let Some(scope) = at.and_then(|id| self.scopes.get(id.0)) {
            names.extend(scope.names.keys().cloned());
            at = scope.parent;
        }
        names.sort();
        names.dedup();
        names
    }

    /// What a binding is worth. Bindings that need each other are told (E0206).
    pub(super) fn binding_value(&mut self, id: BindingId, from: Span) -> Value {
        match &self.bindings[id.0].state {
            State::Done(value) => return value.clone(),
            State::Running => {
                self.tell_cycle(&Waiting::Binding(id), from);
                return Value::Poison;
            }
            State::Pending => {}
        }
        let binding = &self.bindings[id.0];
        let (scope, what) = (binding.scope, binding.what.clone());
        match what {
            What::Item(item) => return Value::Item(item),
            What::Family(members) => return Value::Items(members.values().copied().collect()),
            What::Given(value) => return value,
            What::Alias { scope, name } => {
                return match self.find(scope, &name) {
                    Some(other) => self.deeper(from, |ev| ev.binding_value(other, from)),
                    None => Value::Poison,
                };
            }
            What::Label => {
                let name = self.bindings[id.0].name.clone();
                self.tell(
                    Diagnostic::new("E0304", format!("`{name}` is a label and has no value"))
                        .at(from, "here"),
                );
                return Value::Poison;
            }
            What::Function { .. } => {
                let name = self.bindings[id.0].name.clone();
                self.tell(
                    Diagnostic::new("E0304", format!("`{name}` is a function"))
                        .at(from, "here")
                        .help(format!("call it: `{name}(…)`")),
                );
                return Value::Poison;
            }
            What::Let(_) | What::Param { .. } | What::Edge(_) => {}
        }
        self.bindings[id.0].state = State::Running;
        self.waiting.push((Waiting::Binding(id), from));
        let value = self.deeper(from, |ev| match what {
            What::Let(expr) => ev.eval(expr, scope),
            What::Param { kind, default, range, set } => {
                ev.param_value(id, kind, default, range, set)
            }
            What::Edge(instance) => ev.own_edge(instance, id),
            _ => Value::Poison,
        });
        self.waiting.pop();
        self.bindings[id.0].state = State::Done(value.clone());
        value
    }

    /// Tells that `again` waits for itself, with the places on the way.
    pub(super) fn tell_cycle(&mut self, again: &Waiting, from: Span) {
        let start = self.waiting.iter().position(|(other, _)| other == again).unwrap_or(0);
        let ring: Vec<Waiting> =
            self.waiting.iter().skip(start).map(|(waiting, _)| *waiting).collect();
        let mut seen = Vec::new();
        for waiting in ring {
            let (name, span) = self.waiting_name(&waiting);
            if !seen.iter().any(|(other, _)| *other == name) {
                seen.push((name, span));
            }
        }
        let told = match seen.as_slice() {
            [] => return,
            [(only, span)] => Diagnostic::new("E0206", format!("`{only}` needs itself"))
                .at(*span, "declared here")
                .at(from, "and needed here")
                .help("give it a value that does not need it"),
            [first, second, ..] => {
                let mut told = Diagnostic::new(
                    "E0206",
                    if seen.len() == 2 {
                        format!("`{}` and `{}` need each other", first.0, second.0)
                    } else {
                        format!("`{}` and {} other names need each other", first.0, seen.len() - 1)
                    },
                )
                .help("give one of them a number");
                for (i, (_, span)) in seen.iter().enumerate().take(8) {
                    let next = seen.get((i + 1) % seen.len()).map_or("", |n| n.0.as_str());
                    told = told.at(*span, format!("needs `{next}`"));
                }
                told
            }
        };
        self.tell(told);
    }

    fn waiting_name(&self, waiting: &Waiting) -> (String, Span) {
        match waiting {
            Waiting::Binding(id) => {
                let binding = &self.bindings[id.0];
                (binding.name.clone(), binding.span)
            }
            Waiting::Item(id) => {
                let item = self.item(*id);
                (item.name.clone(), item.span)
            }
        }
    }
}

/// What is being worked out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Waiting {
    /// A name.
    Binding(BindingId),
    /// An item.
    Item(ItemId),
}
