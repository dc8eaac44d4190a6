//! Blocks and parts: pieces and seams drafted once, with parameters, and used in garments.
//!
//! A part opens the block it names anew, so that two parts of one block share nothing: the names
//! of the block stand in a scope of their own, its parameters are what the part sets, and its
//! wearer is the garment's. The garment takes over all lines of its parts.

use super::Evaluator;
use super::block::Setting;
use super::fields::{Fields, Phrase, bare};
use super::garment::Making;
use super::item::{ItemId, Made, root};
use super::panel::edge::{EdgeRef, Which};
use super::scope::{ScopeId, Waiting, What};
use super::value::Value;
use super::words::Kind;
use crate::diagnostic::{Diagnostic, Span, either};
use crate::syntax::tree::{Expr, ExprKind, Name, StatementKind};

/// Parts of parts of parts.
const NESTING: usize = 16;

/// Parts that one text may open.
const PARTS: usize = 1_000;

impl<'t> Evaluator<'t> {
    /// Opens the block of a part; its names stand in the scope that is given back.
    pub(super) fn open_part(&mut self, id: ItemId) -> Option<ScopeId> {
        let phrase = self.item(id).phrase.clone();
        let base = self.item_named(phrase.value("=")?, Kind::Block)?;
        self.ends(id, base)?;
        let given = self.read_settings(id, &phrase);
        let merged = self.merged(base, 0)?;
        let parameters: Vec<&'t Name> = merged
            .statements
            .iter()
            .filter_map(|statement| match &statement.kind {
                StatementKind::Param { name, .. } => Some(name),
                _ => None,
            })
            .collect();
        let known: Vec<&str> = parameters.iter().map(|name| name.text.as_str()).collect();
        for setting in &given {
            let declared = parameters.iter().filter(|name| name.text == setting.name.text);
            self.note_places(setting.name.span, declared.map(|name| name.span));
            if !known.contains(&setting.name.text.as_str()) {
                let block = self.item(base).name.clone();
                let message = format!("`{block}` has no parameter `{}`", setting.name.text);
                let label = self.meant(&setting.name.text, known.iter().copied());
                let mut told = Diagnostic::new("E0204", message).at(setting.name.span, label);
                if !known.is_empty() {
                    told = told.help(format!("it has {}", known.join(", ")));
                }
                self.tell(told);
            }
        }
        let mut merged = merged;
        merged.settings.splice(0..0, given);
        let (parent, span) = (self.item(base).phrase.scope, self.item(id).span);
        self.step(super::OPENING, span);
        let scope = self.new_scope(Some(parent));
        self.parts.insert(scope, id);
        let title = format!("part `{}`", self.item(id).name);
        let before = self.within.replace((scope, self.waiting.len()));
        let fields = self.read_block(Kind::Block, span, title, &merged, scope);
        self.within = before;
        self.stand(&fields);
        self.opened.insert(id, fields);
        Some(scope)
    }

    /// Tells blocks that are made of themselves.
    fn ends(&mut self, id: ItemId, base: ItemId) -> Option<()> {
        let mut chain = vec![id];
        let mut at = Some(self.item(id).scope);
        while let Some(part) = at.and_then(|scope| self.part_around(scope)) {
            chain.push(part);
            at = Some(self.item(part).scope);
        }
        let block_of = |part: &ItemId| self.blocks.get(part).copied();
        let again = chain.iter().skip(1).position(|part| block_of(part) == Some(base));
        if let Some(again) = again {
            let name = self.item(base).name.clone();
            let mut told = Diagnostic::new("E0206", format!("block `{name}` is made of itself"))
                .at(self.item(id).span, format!("`{name}` is asked for"));
            for part in chain.iter().skip(1).take(again).take(6) {
                told = told.at(self.item(*part).span, "in this part");
            }
            let told = told.at(self.item(base).span, "inside the block itself");
            self.tell(told.help("a block may use others, but none that uses it"));
            return None;
        }
        if chain.len() > NESTING {
            self.tell(
                Diagnostic::new("E0211", format!("more than {NESTING} parts inside each other"))
                    .at(self.item(id).span, "here"),
            );
            return None;
        }
        if self.blocks.len() >= PARTS {
            if !std::mem::replace(&mut self.exhausted, true) {
                self.tell(
                    Diagnostic::new("E0210", format!("this text opens more than {PARTS} parts"))
                        .at(self.item(id).span, "the last of them here")
                        .help("parts of parts multiply; let blocks use fewer"),
                );
            }
            return None;
        }
        self.blocks.insert(id, base);
        Some(())
    }

    /// The parameters that a part sets.
    fn read_settings(&mut self, id: ItemId, phrase: &Phrase<'t>) -> Vec<Setting<'t>> {
        let Some(block) = phrase.block else { return Vec::new() };
        let title = format!("part `{}`", self.item(id).name);
        let fields = self.read_plain(Kind::Part, block, &title, phrase.scope);
        let rows = fields.phrases.iter();
        rows.filter_map(|row| {
            let value = row.head.first()?;
            Some(Setting { name: row.key, value, scope: Some(row.scope) })
        })
        .collect()
    }

    /// The part in whose block a scope lies.
    pub(super) fn part_around(&self, scope: ScopeId) -> Option<ItemId> {
        self.outwards(scope).find_map(|scope| self.parts.get(&scope).copied())
    }

    /// Whether a scope lies in a block.
    pub(super) fn in_block(&self, scope: ScopeId) -> bool {
        self.outwards(scope).any(|at| self.parts.contains_key(&at) || self.lone.contains(&at))
    }

    /// Whether a scope lies in a block that no part uses.
    pub(super) fn is_lone(&self, scope: ScopeId) -> bool {
        self.outwards(scope).any(|at| self.lone.contains(&at))
    }

    fn outwards(&self, scope: ScopeId) -> impl Iterator<Item = ScopeId> + '_ {
        std::iter::successors(Some(scope), |at| self.scopes.get(at.0)?.parent)
    }

    /// The wearer that a part takes over from around it.
    fn wearer_around(&self, part: ItemId) -> Option<ItemId> {
        let mut scope = self.item(part).scope;
        loop {
            let names = self.scopes.get(scope.0)?.names.values();
            let wearers = names.filter_map(|binding| match self.bindings[binding.0].what {
                What::Item(id) if self.item(id).kind == Kind::Wearer => Some(id),
                _ => None,
            });
            if let Some(first) = wearers.min() {
                return Some(first);
            }
            scope = self.item(*self.parts.get(&scope)?).scope;
        }
    }

    /// Whether the wearer of a block stands for the one around its part; then its name does.
    pub(super) fn inherits_wearer(&mut self, scope: ScopeId, phrase: Option<&Phrase<'t>>) -> bool {
        let around = self.parts.get(&scope).and_then(|&part| self.wearer_around(part));
        let name = phrase.and_then(|phrase| phrase.head.first()).and_then(|head| bare(head));
        let (Some(wearer), Some(name)) = (around, name) else { return false };
        self.declare(scope, &name.text, name.span, scope, What::Item(wearer));
        true
    }

    /// `cuffs.top`: a panel, a name or an edge of a part.
    pub(super) fn part_member(&mut self, part: ItemId, name: &'t Name, at: Span) -> Value {
        let Some(Made::Opened(scope)) = self.make(part, at) else { return Value::Poison };
        if let Some(binding) = self.own_name(scope, &name.text) {
            self.note_use(name.span, binding);
            return self.binding_value(binding, name.span);
        }
        let mut edges: Vec<(ItemId, Value)> = Vec::new();
        let mut known: Vec<String> = Vec::new();
        for panel in self.panels_of(part) {
            // A panel that cannot be drawn has told why; the edge may be one of its.
            let Some(draft) = self.panel(panel, name.span) else { return Value::Poison };
            let found = if draft.has_line(&name.text) {
                let (draft, edge) = (draft.clone(), name.text.clone());
                self.note_edge(name, draft.declared(&edge));
                let which = Which::default();
                Some(Value::Edges(vec![EdgeRef { draft, which, edge, part: None }]))
            } else if draft.parts().contains(&name.text.as_str()) {
                Some(Value::Half(panel, Which(vec![name.text.clone()])))
            } else {
                None
            };
            edges.extend(found.map(|value| (panel, value)));
            let lines = draft.edge_names().into_iter().chain(draft.mark_names());
            known.extend(lines.map(str::to_owned));
        }
        let title = self.item(part).name.clone();
        if let [(_, value)] = edges.as_slice() {
            return value.clone();
        }
        if edges.len() > 1 {
            let several: Vec<String> = edges
                .iter()
                .map(|(panel, _)| format!("`{}.{}`", self.item(*panel).name, name.text))
                .collect();
            let message = format!("part `{title}` has more than one edge `{}`", name.text);
            self.tell(
                Diagnostic::new("E0204", message)
                    .at(name.span, "which?")
                    .help(format!("write {}", either(&several))),
            );
            return Value::Poison;
        }
        known.extend(self.own_names(scope));
        known.sort();
        known.dedup();
        let label = self.meant(&name.text, known.iter().map(String::as_str));
        self.tell(
            Diagnostic::new("E0204", format!("part `{title}` has no edge `{}`", name.text))
                .at(name.span, label)
                .help(format!("it has {}", known.join(", "))),
        );
        Value::Poison
    }

    /// The numbered items of that name in a part: `row.pocket[2]`.
    pub(super) fn part_family(
        &mut self,
        base: &'t Expr,
        scope: ScopeId,
    ) -> Option<(&'t Name, std::collections::BTreeMap<i64, ItemId>)> {
        let ExprKind::Member(inner, name) = &base.kind else { return None };
        let first = self.find(scope, &root(inner)?.text)?;
        let part = match &self.bindings[first.0].what {
            What::Item(id) => *id,
            What::Family(members) => *members.values().next()?,
            _ => return None,
        };
        if self.item(part).kind != Kind::Part {
            return None;
        }
        let Value::Item(part) = self.eval(inner, scope) else { return None };
        let Some(Made::Opened(scope)) = self.make(part, inner.span) else { return None };
        let binding = self.own_name(scope, &name.text)?;
        self.note_use(name.span, binding);
        match &self.bindings[binding.0].what {
            What::Family(members) => Some((name, members.clone())),
            _ => None,
        }
    }

    /// A name that a block gives away.
    pub(super) fn own_name(&self, scope: ScopeId, name: &str) -> Option<super::scope::BindingId> {
        let binding = *self.scopes.get(scope.0)?.names.get(name)?;
        self.gives_away(binding).then_some(binding)
    }

    pub(super) fn own_names(&self, scope: ScopeId) -> Vec<String> {
        let names = self.scopes.get(scope.0).map(|scope| &scope.names);
        let given = names.into_iter().flatten().filter(|(_, id)| self.gives_away(**id));
        given.map(|(name, _)| name.clone()).collect()
    }

    fn gives_away(&self, binding: super::scope::BindingId) -> bool {
        match &self.bindings[binding.0].what {
            What::Let(_) | What::Param { .. } | What::Family(_) | What::Given(_) => true,
            What::Item(id) => self.item(*id).kind != Kind::Wearer,
            _ => false,
        }
    }

    /// The panels of a part itself.
    fn panels_of(&self, part: ItemId) -> Vec<ItemId> {
        let fields = self.opened.get(&part);
        fields.into_iter().flat_map(|fields| fields.all("panel")).filter_map(|p| p.item).collect()
    }

    /// Takes the lines of all parts over into the block that has them; false if one is wrong.
    pub(super) fn take_parts(&mut self, fields: &mut Fields<'t>) -> bool {
        let own: Vec<Phrase<'t>> = fields.all("part").cloned().collect();
        let mut sound = true;
        for phrase in own {
            let Some(id) = phrase.item else { continue };
            let Some(Made::Opened(_)) = self.make(id, phrase.span) else {
                sound = false;
                continue;
            };
            let Some(mut inner) = self.opened.get(&id).cloned() else { continue };
            sound &= self.take_parts(&mut inner);
            fields.phrases.extend(inner.phrases);
            fields.spoiled.extend(inner.spoiled);
        }
        sound
    }

    /// The panel that a `place` line means, where it names one of a part's.
    pub(super) fn placed_in_part(&mut self, head: &'t Expr, scope: ScopeId) -> Vec<ItemId> {
        let mut at = head;
        // `cuffs.band.left.top`: the panel is the first that is reached.
        let mut names: Vec<&'t Name> = Vec::new();
        loop {
            match &at.kind {
                ExprKind::Member(base, name) => {
                    names.push(name);
                    at = base;
                }
                ExprKind::Index(base, ..) => at = base,
                _ => break,
            }
        }
        let Some(first) = bare(at).and_then(|name| self.find(scope, &name.text)) else {
            return Vec::new();
        };
        let mut found = match &self.bindings[first.0].what {
            What::Item(id) => vec![*id],
            What::Family(members) => members.values().copied().collect(),
            _ => return Vec::new(),
        };
        for name in names.into_iter().rev() {
            let mut inner = Vec::new();
            for &id in &found {
                if self.item(id).kind != Kind::Part {
                    continue;
                }
                let Some(Made::Opened(scope)) = self.make(id, head.span) else { continue };
                let own = self.scopes.get(scope.0).and_then(|scope| scope.names.get(&name.text));
                match own.map(|own| &self.bindings[own.0].what) {
                    Some(What::Item(id)) => inner.push(*id),
                    Some(What::Family(members)) => inner.extend(members.values().copied()),
                    _ => inner.extend(self.panels_of(id)),
                }
            }
            if inner.is_empty() {
                break;
            }
            found = inner;
        }
        found.retain(|id| self.item(*id).kind == Kind::Panel);
        found
    }

    /// The fabric of a panel that names none: its part's, or the garment's.
    pub(super) fn fabric_around(&mut self, panel: ItemId, making: &Making) -> Option<ItemId> {
        let mut part = self.part_around(self.item(panel).scope);
        let of_part = part.is_some();
        while let Some(id) = part {
            let phrase = self.item(id).phrase.clone();
            if let Some(arg) = phrase.value("of") {
                return self.item_named(arg, Kind::Fabric);
            }
            part = self.part_around(self.item(id).scope);
        }
        making.cloth.or(making.first_cloth.filter(|_| of_part))
    }

    /// Looks at the blocks of the file that no part uses, so that their mistakes are told. A
    /// parameter that must be given has no value then, and what needs it is passed over.
    pub(super) fn look_at_lone_blocks(&mut self) {
        let mut at = 0;
        while let Some(item) = self.items.get(at) {
            let id = ItemId(at);
            at += 1;
            let (kind, span) = (item.kind, item.span);
            if kind != Kind::Block
                || span.file != self.root
                || self.blocks.values().any(|used| *used == id)
            {
                continue;
            }
            let Some(merged) = self.merged(id, 0) else { continue };
            let scope = self.new_scope(Some(self.item(id).phrase.scope));
            self.lone.insert(scope);
            let title = format!("block `{}`", self.item(id).name);
            let mut fields = self.read_block(Kind::Block, span, title, &merged, scope);
            let name = self.item(id).name.clone();
            let mut making = Making::new(&name, span);
            self.stand(&fields);
            self.take_parts(&mut fields);
            self.assemble(&fields, None, &mut making);
        }
        self.make_all(self.root);
    }

    /// A message about a line of a block names the part for which it was read; one about the
    /// library stands at the part.
    pub(super) fn in_part(&self, mut told: Diagnostic) -> Diagnostic {
        let Some(place) = told.labels.first().map(|label| label.span) else { return told };
        let waiting = self.waiting.last().and_then(|(waiting, _)| match waiting {
            Waiting::Binding(id) => self.part_around(self.bindings[id.0].scope),
            Waiting::Item(id) => self.part_around(self.item(*id).scope),
        });
        let within = self.within.filter(|(_, waiting)| *waiting == self.waiting.len());
        let part = waiting.or_else(|| within.and_then(|(scope, _)| self.part_around(scope)));
        let Some(mut part) = part else { return told };
        // The part that the reader of the message has written: the outermost.
        while let Some(outer) = self.part_around(self.item(part).scope) {
            part = outer;
        }
        let at = self.item(part).span;
        if told.labels.iter().any(|label| label.span == at) {
            return told;
        }
        let file = self.files.iter().find(|file| file.id == place.file);
        let label = crate::diagnostic::Label {
            span: at,
            text: format!("in part `{}`", self.item(part).name),
        };
        if file.is_some_and(|file| file.path.starts_with("std::")) {
            told.labels.insert(0, label);
        } else {
            told.labels.push(label);
        }
        told
    }
}
