//! A panel's block opened: its names declared, its outline read.

use super::super::Evaluator;
use super::super::block::Merged;
use super::super::fields::{Phrase, bare};
use super::super::item::{ItemId, State};
use super::super::scope::{BindingId, ScopeId, What};
use super::super::value::Value;
use super::super::words::{Kind, vocabulary};
use super::edge::{EdgeRef, Which};
use super::operation::SHAPES;
use super::{Draft, Instance, InstanceId};
use super::{mark, particle, slit};
use crate::diagnostic::{Diagnostic, Span};
use crate::syntax::tree::{Expr, ExprKind, Name, Statement, StatementKind};
use crate::units::Quantity;
use std::collections::BTreeMap;
use std::rc::Rc;

/// Names of the edges of a shape.
pub(super) fn shape_edges(phrase: &Phrase<'_>) -> &'static [&'static str] {
    match phrase.word.name {
        "rectangle" => &["bottom", "end", "top", "start"],
        "circle" => &["rim"],
        "ring" if phrase.says("sweep") => &["inner", "end", "outer", "start"],
        "ring" => &["inner", "outer"],
        "size" => &["bottom", "end", "top", "start"],
        _ => &[],
    }
}

/// Names of edges that a `trace` brings along, as far as its words show them.
fn traced_names<'t>(expr: &'t Expr, out: &mut Vec<&'t Name>, inside: bool) {
    match &expr.kind {
        ExprKind::Member(_, name) => out.push(name),
        ExprKind::Within(_, inner) => traced_names(inner, out, true),
        ExprKind::Group(inner) => traced_names(inner, out, inside),
        ExprKind::Binary { left, right, .. } => {
            traced_names(left, out, inside);
            traced_names(right, out, inside);
        }
        ExprKind::Path(_) if inside => out.extend(bare(expr)),
        _ => {}
    }
}

impl<'t> Evaluator<'t> {
    /// Works a panel out: its fits first, then its outline with the values found.
    pub(in super::super) fn draft(&mut self, id: ItemId) -> Option<Draft> {
        let merged = self.merged(id, 0)?;
        let values = self.fit_all(id, &merged)?;
        let instance = self.open_panel(id, &merged, values);
        let draft = self.instance_draft(instance, self.item(id).span)?;
        if let Some(opened) = self.instances.get(instance.0) {
            let fields = opened.fields.clone();
            self.requirements(&fields);
        }
        Some((*draft).clone())
    }

    /// Opens the block of a panel with the given values of its fitted names.
    pub(super) fn open_panel(
        &mut self,
        id: ItemId,
        merged: &Merged<'t>,
        values: BTreeMap<String, Quantity>,
    ) -> InstanceId {
        let item = self.item(id);
        let (span, parent) = (item.span, item.phrase.scope);
        let title = format!("{} `{}`", item.kind.noun(), item.name);
        self.step(super::super::OPENING, span);
        let scope = self.new_scope(Some(parent));
        self.fits.insert(scope, values);
        self.note_opened(scope, id);
        let instance = InstanceId(self.instances.len());
        // Conditions in the block may draw other panels meanwhile; the place is taken first.
        let empty = super::Fields {
            kind: Kind::Panel,
            span,
            title: title.clone(),
            scope,
            phrases: Vec::new(),
            spoiled: Vec::new(),
        };
        self.instances.push(Instance {
            item: id,
            fields: empty,
            outline: None,
            drawn: Vec::new(),
            draft: State::Pending,
        });
        let fields = self.read_block(Kind::Panel, span, title, merged, scope);
        let mut outline = None;
        let mut drawn = Vec::new();
        let mut shaped = false;
        for (number, phrase) in fields.phrases.iter().enumerate() {
            // Of two shapes, which are told of, the first names the edges.
            if SHAPES.contains(&phrase.word.name) && std::mem::replace(&mut shaped, true) {
                continue;
            }
            match phrase.word.name {
                "outline" => {
                    let read = self.read_outline(phrase, &merged.edges, scope, instance);
                    outline = read.or(outline);
                }
                "hole" if phrase.block.is_some() => {
                    if let Some(read) = self.read_outline(phrase, &[], scope, instance) {
                        drawn.push((number, read));
                    }
                }
                "hole" => {
                    if let Some(label) = phrase.label {
                        let names = if phrase.says("slit") {
                            vec![format!("{}1", label.text), format!("{}2", label.text)]
                        } else {
                            vec![label.text.clone()]
                        };
                        for name in names {
                            self.declare(scope, &name, label.span, scope, What::Edge(instance));
                        }
                    }
                }
                "mark" => {
                    if let Some(name) = mark::name(phrase) {
                        self.declare(scope, &name.text, name.span, scope, What::Edge(instance));
                    }
                    if let Some(read) = self.read_outline(phrase, &[], scope, instance) {
                        drawn.push((number, read));
                    }
                }
                "slit" => {
                    for name in slit::lips(phrase).into_iter().flatten() {
                        self.declare(scope, &name, phrase.span, scope, What::Edge(instance));
                    }
                }
                "mask" => {
                    self.declare(scope, "rim", phrase.key.span, scope, What::Edge(instance));
                }
                "cut" => {
                    for name in particle::cut_edges(phrase) {
                        self.declare(scope, &name, phrase.span, scope, What::Edge(instance));
                    }
                }
                "smooth" => {
                    if let Some(label) = phrase.label {
                        self.declare(scope, &label.text, label.span, scope, What::Edge(instance));
                    }
                }
                _ => {
                    for name in shape_edges(phrase) {
                        self.declare(scope, name, phrase.span, scope, What::Edge(instance));
                    }
                }
            }
        }
        if outline.is_none() && !fields.spoils("outline") {
            for edge in &merged.edges {
                self.tell_no_edge(edge, &[]);
            }
        }
        if let Some(place) = self.instances.get_mut(instance.0) {
            place.fields = fields;
            place.outline = outline;
            place.drawn = drawn;
        }
        instance
    }

    /// Reads the block of an outline; its labels become names of edges.
    fn read_outline(
        &mut self,
        phrase: &Phrase<'t>,
        replaced: &[&'t Statement],
        scope: ScopeId,
        instance: InstanceId,
    ) -> Option<super::Fields<'t>> {
        let block = phrase.block?;
        let label = |statement: &'t Statement| match &statement.kind {
            StatementKind::Property { key, .. } => Some(key.text.as_str()),
            _ => None,
        };
        let mut statements: Vec<&'t Statement> = block.statements.iter().collect();
        for edge in replaced {
            match statements.iter().position(|old| label(old) == label(edge)) {
                Some(place) => {
                    if let (StatementKind::Property { key, .. }, Some(old)) =
                        (&edge.kind, statements.get(place))
                        && let StatementKind::Property { key: replaced, .. } = &old.kind
                    {
                        self.note_replaced(key, replaced);
                    }
                    statements[place] = edge;
                }
                None => {
                    let known: Vec<&str> = statements.iter().filter_map(|s| label(s)).collect();
                    self.tell_no_edge(edge, &known);
                }
            }
        }
        let inner = self.new_scope(Some(scope));
        let merged = Merged { statements, ..Merged::default() };
        let span = Span { end: block.span.start.saturating_add(1), ..block.span };
        let fields = self.read_block(Kind::Outline, span, "the outline".to_owned(), &merged, inner);
        for line in &fields.spoiled {
            self.poison_name(line.label, scope);
        }
        for edge in &fields.phrases {
            let mut names: Vec<&'t Name> = edge.label.into_iter().collect();
            if edge.word.name == "trace" {
                if let Some(arg) = edge.arg(0) {
                    traced_names(arg.expr, &mut names, false);
                }
            }
            for name in names {
                self.declare(scope, &name.text, name.span, scope, What::Edge(instance));
            }
        }
        Some(fields)
    }

    fn tell_no_edge(&mut self, edge: &'t Statement, known: &[&str]) {
        if let StatementKind::Property { key, .. } = &edge.kind {
            let label = self.meant(&key.text, known.iter().copied());
            self.tell(
                Diagnostic::new(
                    "E0204",
                    format!("the copied outline has no edge `{}` to replace", key.text),
                )
                .at(key.span, label)
                .help(format!(
                    "edges are drawn inside `outline {{ … }}`; in a panel stand {}",
                    vocabulary(Kind::Panel)
                        .words
                        .iter()
                        .map(|word| word.name)
                        .collect::<Vec<_>>()
                        .join(", ")
                )),
            );
        }
    }

    /// The draft of an instance, worked out once.
    pub(super) fn instance_draft(&mut self, id: InstanceId, from: Span) -> Option<Rc<Draft>> {
        match &self.instances.get(id.0)?.draft {
            State::Done(draft) => return draft.clone(),
            State::Running => {
                let item = self.instances.get(id.0)?.item;
                let name = self.item(item).name.clone();
                self.tell(
                    Diagnostic::new(
                        "E0206",
                        format!("the outline of `{name}` needs an edge of its own"),
                    )
                    .at(from, "this edge is not drawn yet")
                    .help("draw it from points and lengths that are known before it"),
                );
                return None;
            }
            State::Pending => {}
        }
        self.instances.get_mut(id.0)?.draft = State::Running;
        let draft = self.deeper_item(from, |ev| ev.cut_out(id)).map(Rc::new);
        self.instances.get_mut(id.0)?.draft = State::Done(draft.clone());
        draft
    }

    /// The value of an edge's name inside its own panel.
    pub(in super::super) fn own_edge(&mut self, instance: InstanceId, binding: BindingId) -> Value {
        let (name, span) = {
            let binding = &self.bindings[binding.0];
            (binding.name.clone(), binding.span)
        };
        let from = self.waiting.last().map_or(span, |(_, from)| *from);
        match self.instance_draft(instance, from) {
            Some(draft) if draft.has_line(&name) => Value::Edges(vec![EdgeRef {
                draft,
                which: Which::default(),
                edge: name,
                part: None,
            }]),
            Some(draft) => {
                self.tell(
                    Diagnostic::new(
                        "E0304",
                        format!("`{name}` is no edge of `{}` any more", draft.name),
                    )
                    .at(from, "it is unfolded across this edge, or has been cut away"),
                );
                Value::Poison
            }
            None => Value::Poison,
        }
    }
}
