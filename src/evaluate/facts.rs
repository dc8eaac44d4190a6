//! What an evaluation learns about a text besides its garments: what its names are, where they
//! are used, what they and the values around them are worth, how long edges are and what seams
//! take in. For editors. Nothing is noted, and nothing is paid for it, unless it is asked for.

use super::Evaluator;
use super::item::{Item, ItemId, Made, State};
use super::scope::{BindingId, ScopeId, What};
use super::value::{Value, Vector};
use super::words::Kind;
use crate::diagnostic::Span;
use crate::syntax::tree::{Expr, ExprKind, Name};
use crate::units::{self, Dimension, Quantity};
use std::collections::{BTreeMap, BTreeSet};

/// Different values that are kept of one place; a text in a copy or a function has several.
const SEVERAL: usize = 4;

/// What an evaluation learned. Places are those of the texts of its world.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Facts {
    /// Every name that is given, in the order of the texts.
    pub definitions: Vec<Definition>,
    /// Where a name is used, and where what it means is declared.
    pub uses: BTreeMap<Span, BTreeSet<Span>>,
    /// What expressions are worth.
    pub values: BTreeMap<Span, Vec<Worth>>,
    /// Names that are one name because a line of a copy replaces a line of the original.
    pub alike: BTreeSet<(Span, Span)>,
    /// Edges of cut panels, in the order in which they were drawn.
    pub edges: Vec<Edge>,
    /// Seams whose lengths are known.
    pub seams: Vec<Sewn>,
}

/// A name with what is known of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Definition {
    /// The name.
    pub name: String,
    /// Where it is given. Edges of a shape stand where the shape stands.
    pub span: Span,
    /// What it is.
    pub sort: Sort,
    /// What it is worth.
    pub worth: Vec<Worth>,
    /// What may stand behind its point.
    pub members: Vec<Member>,
}

/// What a name is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Sort {
    /// `let`, a fitted name, the counter of a loop or an argument.
    Value,
    /// A parameter.
    Parameter,
    /// A function.
    Function,
    /// A panel, a fabric, a wearer, …
    Item(Kind),
    /// An edge.
    Edge,
    /// The label of an action.
    Label,
}

/// A value as it is shown.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Worth {
    /// The panel in whose copy of the text it holds.
    pub of: Option<String>,
    /// The value, such as `18.5 cm`.
    pub text: String,
}

/// What stands behind the point of a name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Member {
    /// Its name.
    pub name: String,
    /// What it is: an edge, a half, a measure, a place.
    pub what: &'static str,
    /// How long it is, where it has a length.
    pub text: String,
}

/// An edge of a piece.
#[derive(Clone, Debug, PartialEq)]
pub struct Edge {
    /// Where its name is given.
    pub span: Span,
    /// Its name.
    pub name: String,
    /// Its panel.
    pub panel: String,
    /// Its length as sewn, m.
    pub length: f64,
    /// Its length before darts, m.
    pub flat: f64,
}

/// A seam.
#[derive(Clone, Debug, PartialEq)]
pub struct Sewn {
    /// Its line.
    pub span: Span,
    /// The length of its first side, m.
    pub a: f64,
    /// The length of its second side, m.
    pub b: f64,
}

/// What is noted while a text is worked out.
#[derive(Debug, Default)]
pub(super) struct Notes {
    uses: BTreeMap<Span, BTreeSet<Span>>,
    /// Uses of edges, with the lines that draw them.
    edges: BTreeMap<Span, (String, BTreeSet<Span>)>,
    /// Uses of names whose files are perhaps not read yet.
    waiting: BTreeMap<Span, BTreeSet<BindingId>>,
    values: BTreeMap<Span, Noted>,
    alike: BTreeSet<(Span, Span)>,
    seams: Vec<Sewn>,
    /// Panels by the scopes in which they were opened.
    opened: BTreeMap<ScopeId, ItemId>,
}

/// Values of one place.
#[derive(Debug, Default)]
struct Noted {
    settled: Vec<(Option<ItemId>, Shown)>,
    /// The last one while a fit was tried.
    tried: Option<Shown>,
}

/// A value, without what it is made of.
#[derive(Clone, Debug, PartialEq)]
enum Shown {
    Quantity(Quantity),
    Vector(Vector),
    Range(Quantity, Quantity),
    Text(String),
    Edges(f64, f64),
    Measure(ItemId, String),
    Item(ItemId),
}

impl Shown {
    fn of(value: &Value) -> Option<Shown> {
        Some(match value {
            Value::Quantity(quantity) => Shown::Quantity(*quantity),
            Value::Vector(vector) => Shown::Vector(vector.clone()),
            Value::Range(low, high) => Shown::Range(*low, *high),
            Value::Bool(yes) => Shown::Text(if *yes { "yes" } else { "no" }.to_owned()),
            Value::Word(chosen) => Shown::Text(chosen.word.clone()),
            Value::Text(text) => Shown::Text(format!("\"{text}\"")),
            Value::Colour(colour) => {
                let [r, g, b, _] = colour.0;
                Shown::Text(format!("#{r:02x}{g:02x}{b:02x}"))
            }
            Value::List(values) => Shown::Text(format!("a list of {}", values.len())),
            Value::Record(fields) => {
                let names: Vec<&str> = fields.iter().map(|(name, _)| name.as_str()).collect();
                Shown::Text(format!("a record of {}", names.join(", ")))
            }
            Value::Edges(edges) => Shown::Edges(
                edges.iter().map(|edge| edge.length()).sum(),
                edges.iter().map(|edge| edge.flat_length()).sum(),
            ),
            Value::Mark(mark) => {
                Shown::Vector(Vector { dimension: Dimension::LENGTH, parts: mark.at.to_vec() })
            }
            Value::Measure { wearer, name } => Shown::Measure(*wearer, name.clone()),
            Value::Item(id) => Shown::Item(*id),
            Value::Half(id, _) => Shown::Item(*id),
            Value::Poison | Value::Items(_) => return None,
        })
    }
}

/// Expressions whose value is not plain from how they are written.
fn telling(expr: &Expr) -> bool {
    !matches!(
        expr.kind,
        ExprKind::Unread
            | ExprKind::Number { .. }
            | ExprKind::Colour(_)
            | ExprKind::Text(_)
            | ExprKind::List(_)
            | ExprKind::Record(_)
    )
}

impl<'t> Evaluator<'t> {
    /// Notes what an expression is worth.
    pub(super) fn note_value(&mut self, expr: &Expr, scope: ScopeId, value: &Value) {
        if self.notes.is_none() || !telling(expr) {
            return;
        }
        let Some(shown) = Shown::of(value) else { return };
        let trial = self.is_trial(scope);
        let owner = self.owner(scope);
        let Some(notes) = &mut self.notes else { return };
        let noted = notes.values.entry(expr.span).or_default();
        if trial {
            noted.tried = Some(shown);
        } else if noted.settled.len() < SEVERAL && !noted.settled.contains(&(owner, shown.clone()))
        {
            noted.settled.push((owner, shown));
        }
    }

    /// The panel in whose block a scope lies.
    fn owner(&self, scope: ScopeId) -> Option<ItemId> {
        let opened = &self.notes.as_ref()?.opened;
        let mut at = Some(scope);
        while let Some(id) = at {
            if let Some(panel) = opened.get(&id) {
                return Some(*panel);
            }
            at = self.scopes.get(id.0)?.parent;
        }
        None
    }

    /// Notes that a panel was opened in a scope.
    pub(super) fn note_opened(&mut self, scope: ScopeId, panel: ItemId) {
        if let Some(notes) = &mut self.notes {
            notes.opened.insert(scope, panel);
        }
    }

    /// Notes that a name is used for what a binding declares.
    pub(super) fn note_use(&mut self, at: Span, binding: BindingId) {
        if let Some(notes) = &mut self.notes {
            notes.waiting.entry(at).or_default().insert(binding);
        }
    }

    /// Notes that a name is used for what is declared at these places.
    pub(super) fn note_places(&mut self, at: Span, declared: impl IntoIterator<Item = Span>) {
        if let Some(notes) = &mut self.notes {
            notes.uses.entry(at).or_default().extend(declared);
        }
    }

    /// Notes that a name is used for the edge that is drawn by these lines.
    pub(super) fn note_edge(&mut self, at: &Name, drawn: impl IntoIterator<Item = Span>) {
        if let Some(notes) = &mut self.notes {
            let entry = notes.edges.entry(at.span);
            let (_, lines) = entry.or_insert_with(|| (at.text.clone(), BTreeSet::new()));
            lines.extend(drawn);
        }
    }

    /// Notes that a name of a copy replaces one of the original.
    pub(super) fn note_replaced(&mut self, new: &Name, old: &Name) {
        if let Some(notes) = &mut self.notes {
            notes.alike.insert((new.span, old.span));
        }
    }

    /// Notes the lengths of both sides of a seam.
    pub(super) fn note_seam(&mut self, span: Span, a: f64, b: f64) {
        if let Some(notes) = &mut self.notes {
            // The two halves of a garment are sewn by one line.
            let again = notes.seams.iter().rev().take(8).any(|seam| {
                seam.span == span && (seam.a - a).abs() < 1e-5 && (seam.b - b).abs() < 1e-5
            });
            if !again {
                notes.seams.push(Sewn { span, a, b });
            }
        }
    }

    /// What was noted, put in order.
    pub(super) fn facts(&mut self) -> Facts {
        let Some(notes) = self.notes.take() else { return Facts::default() };
        let mut uses = notes.uses;
        for (at, bindings) in notes.waiting {
            let places: Vec<Span> =
                bindings.into_iter().map(|id| self.bindings[self.behind(id).0].span).collect();
            uses.entry(at).or_default().extend(places);
        }
        let labels = self.labels();
        for (at, (name, lines)) in notes.edges {
            let places = lines.into_iter().map(|line| label(&labels, line, &name));
            uses.entry(at).or_default().extend(places);
        }
        let mut values = BTreeMap::new();
        for (span, noted) in notes.values {
            let mut worth: Vec<Worth> = Vec::new();
            for (owner, shown) in &noted.settled {
                self.add_worth(&mut worth, *owner, shown);
            }
            if let (true, Some(shown)) = (worth.is_empty(), &noted.tried) {
                self.add_worth(&mut worth, None, shown);
            }
            if !worth.is_empty() {
                values.insert(span, alone(worth));
            }
        }
        let mut facts = Facts {
            uses,
            values,
            alike: notes.alike,
            edges: self.edge_facts(&labels),
            seams: notes.seams,
            definitions: Vec::new(),
        };
        self.definitions(&notes.opened, &mut facts);
        facts
    }

    /// The binding that an alias leads to.
    fn behind(&self, id: BindingId) -> BindingId {
        let mut at = id;
        for _ in 0..64 {
            let What::Alias { scope, name } = &self.bindings[at.0].what else { break };
            match self.find(*scope, name) {
                Some(next) if next != at => at = next,
                _ => break,
            }
        }
        at
    }

    fn add_worth(&self, worth: &mut Vec<Worth>, owner: Option<ItemId>, shown: &Shown) {
        let Some(text) = self.shown_text(shown) else { return };
        let of = owner.map(|id| self.item(id).name.clone());
        let new = Worth { of, text };
        if worth.len() < SEVERAL && !worth.contains(&new) {
            worth.push(new);
        }
    }

    fn shown_text(&self, shown: &Shown) -> Option<String> {
        Some(match shown {
            Shown::Quantity(quantity) => quantity.to_string(),
            Shown::Vector(vector) => {
                let parts: Vec<String> = vector
                    .parts
                    .iter()
                    .map(|part| Quantity::new(*part, vector.dimension).to_string())
                    .collect();
                format!("({})", parts.join(", "))
            }
            Shown::Range(low, high) => format!("{low} to {high}"),
            Shown::Text(text) => text.clone(),
            Shown::Edges(length, flat) => long(*length, *flat),
            Shown::Measure(wearer, name) => match &self.item(*wearer).made {
                State::Done(Some(Made::Wearer(request))) => {
                    request.measures.get(name).map(|length| units::length(*length))?
                }
                _ => return None,
            },
            Shown::Item(id) => {
                let item = self.item(*id);
                format!("{} `{}`", item.kind.noun(), item.name)
            }
        })
    }

    /// Where edges get their names.
    fn labels(&self) -> Labels {
        let mut labels = Labels::new();
        for binding in &self.bindings {
            if matches!(binding.what, What::Edge(_)) {
                labels.entry(binding.name.clone()).or_default().insert(binding.span);
            }
        }
        labels
    }

    /// The lengths of all edges of all panels that could be cut.
    fn edge_facts(&self, labels: &Labels) -> Vec<Edge> {
        let mut edges: Vec<Edge> = Vec::new();
        for item in &self.items {
            let State::Done(Some(Made::Panel(draft))) = &item.made else { continue };
            let Some(piece) = draft.pieces.first() else { continue };
            let mut seen: BTreeSet<(Span, &str)> = BTreeSet::new();
            for edge in &piece.edges {
                if seen.insert((edge.span, &edge.name)) {
                    edges.push(Edge {
                        span: label(labels, edge.span, &edge.name),
                        name: edge.name.clone(),
                        panel: draft.name.clone(),
                        length: edge.runs.iter().map(|(run, _)| run.length()).sum(),
                        flat: edge.flat,
                    });
                }
            }
        }
        edges
    }

    /// All names, each place once, with what they are worth.
    fn definitions(&mut self, opened: &BTreeMap<ScopeId, ItemId>, facts: &mut Facts) {
        let mut found: BTreeMap<(Span, String), Definition> = BTreeMap::new();
        let mut lengths: BTreeMap<(Span, &str), Vec<Worth>> = BTreeMap::new();
        for edge in &facts.edges {
            let text = long(edge.length, edge.flat);
            let worth = Worth { of: Some(edge.panel.clone()), text };
            lengths.entry((edge.span, &edge.name)).or_default().push(worth);
        }
        for number in 0..self.bindings.len() {
            let binding = &self.bindings[number];
            let (sort, value) = match &binding.what {
                What::Let(_) => (Sort::Value, done(&binding.state)),
                What::Given(value) => (Sort::Value, Some(value)),
                What::Param { .. } => (Sort::Parameter, done(&binding.state)),
                What::Function { .. } => (Sort::Function, None),
                What::Item(id) => (Sort::Item(self.item(*id).kind), None),
                What::Family(members) => {
                    let Some(id) = members.values().next() else { continue };
                    (Sort::Item(self.item(*id).kind), None)
                }
                What::Edge(_) => (Sort::Edge, None),
                What::Label => (Sort::Label, None),
                What::Alias { .. } => {
                    // The name in a `use` line is a use of what it brings.
                    let target = self.bindings[self.behind(BindingId(number)).0].span;
                    if target.file != binding.span.file {
                        facts.uses.entry(binding.span).or_default().insert(target);
                    }
                    continue;
                }
            };
            let key = (binding.span, binding.name.clone());
            let fields = match value {
                Some(Value::Record(fields)) => self.fields(fields),
                _ => Vec::new(),
            };
            let shown = value.and_then(Shown::of).filter(|_| !self.is_trial(binding.scope));
            let entry = found.entry(key).or_insert_with(|| Definition {
                name: binding.name.clone(),
                span: binding.span,
                sort,
                worth: Vec::new(),
                members: Vec::new(),
            });
            if let Some(shown) = shown {
                let owner = around(&self.scopes, opened, binding.scope);
                self.add_worth(&mut entry.worth, owner, &shown);
            }
            if entry.members.is_empty() {
                entry.members = match &binding.what {
                    What::Item(id) => self.members(self.item(*id), facts),
                    What::Family(members) => members
                        .values()
                        .next()
                        .map_or(Vec::new(), |id| self.members(self.item(*id), facts)),
                    _ => fields,
                };
            }
        }
        for definition in found.values_mut() {
            if definition.sort == Sort::Edge {
                let key = (definition.span, definition.name.as_str());
                definition.worth = lengths.remove(&key).unwrap_or_default();
                definition.worth.truncate(SEVERAL);
            }
            definition.worth = alone(std::mem::take(&mut definition.worth));
        }
        facts.definitions = found.into_values().collect();
    }

    /// What may stand behind the point of a record.
    fn fields(&self, fields: &[(String, Value)]) -> Vec<Member> {
        let text = |value| Shown::of(value).and_then(|shown| self.shown_text(&shown));
        let fields = fields.iter();
        fields
            .map(|(name, value)| Member {
                name: name.clone(),
                what: "value",
                text: text(value).unwrap_or_default(),
            })
            .collect()
    }

    /// What may stand behind the point of an item.
    fn members(&self, item: &Item<'t>, facts: &Facts) -> Vec<Member> {
        match &item.made {
            State::Done(Some(Made::Panel(draft))) => {
                let mut members: Vec<Member> = draft
                    .edge_names()
                    .into_iter()
                    .chain(draft.mark_names())
                    .map(|name| {
                        let edge = facts
                            .edges
                            .iter()
                            .find(|edge| edge.panel == draft.name && edge.name == name);
                        let text =
                            edge.map(|edge| long(edge.length, edge.flat)).unwrap_or_default();
                        Member { name: name.to_owned(), what: "edge", text }
                    })
                    .collect();
                members.extend(draft.parts().into_iter().map(|name| Member {
                    name: name.to_owned(),
                    what: "half",
                    text: String::new(),
                }));
                members
            }
            State::Done(Some(Made::Wearer(request))) => {
                let mut members: Vec<Member> = request
                    .measures
                    .iter()
                    .map(|(name, length)| Member {
                        name: name.clone(),
                        what: "measure",
                        text: units::length(*length),
                    })
                    .collect();
                for name in super::place::places() {
                    if !request.measures.contains_key(&name) {
                        members.push(Member { name, what: "place", text: String::new() });
                    }
                }
                members
            }
            State::Done(Some(Made::Opened(scope))) => self.given_away(*scope, facts),
            _ => Vec::new(),
        }
    }

    /// What a part gives away: names of its block, and edges of its panels.
    fn given_away(&self, scope: ScopeId, facts: &Facts) -> Vec<Member> {
        let mut members: Vec<Member> = Vec::new();
        for name in self.own_names(scope) {
            let binding = self.own_name(scope, &name).map(|id| &self.bindings[id.0]);
            let what = binding.and_then(|binding| match &binding.what {
                What::Item(id) => Some(self.item(*id).kind.noun()),
                _ => None,
            });
            members.push(Member { name, what: what.unwrap_or("value"), text: String::new() });
        }
        for item in self.items.iter().filter(|item| item.scope == scope) {
            if item.kind == Kind::Panel {
                for edge in self.members(item, facts) {
                    if members.iter().all(|other| other.name != edge.name) {
                        members.push(edge);
                    }
                }
            }
        }
        members
    }
}

/// Names of edges, with the places at which they are given.
type Labels = BTreeMap<String, BTreeSet<Span>>;

/// Where the edge of a name that a line draws gets its name.
fn label(labels: &Labels, line: Span, name: &str) -> Span {
    let places = labels
        .get(name)
        .into_iter()
        .flat_map(|places| places.range(Span { end: line.start, ..line }..));
    places
        .take_while(|place| place.file == line.file && place.start <= line.end)
        .find(|place| place.end <= line.end)
        .copied()
        .unwrap_or(line)
}

/// The panel in whose block a scope lies.
fn around(
    scopes: &[super::scope::Scope],
    opened: &BTreeMap<ScopeId, ItemId>,
    scope: ScopeId,
) -> Option<ItemId> {
    let mut at = Some(scope);
    while let Some(id) = at {
        if let Some(panel) = opened.get(&id) {
            return Some(*panel);
        }
        at = scopes.get(id.0)?.parent;
    }
    None
}

fn done(state: &State<Value>) -> Option<&Value> {
    match state {
        State::Done(value) => Some(value),
        _ => None,
    }
}

/// A length, and the length before darts where it differs.
fn long(length: f64, flat: f64) -> String {
    if (length - flat).abs() < 5e-5 {
        units::length(length)
    } else {
        format!("{} ({} flat)", units::length(length), units::length(flat))
    }
}

/// Values that are the same in all copies belong to none of them.
fn alone(mut worth: Vec<Worth>) -> Vec<Worth> {
    if worth.windows(2).all(|pair| pair[0].text == pair[1].text) {
        worth.truncate(1);
        worth.iter_mut().for_each(|one| one.of = None);
    }
    worth
}
