//! Blocks: declarations hoisted, loops and choices unrolled, copies merged.

use super::Evaluator;
use super::choice::MATCH;
use super::fields::{Arg, Fields, Phrase, bare};
use super::item::{ItemId, declares};
use super::panel::operation::SHAPES;
use super::phrase::Written;
use super::poison::unread;
use super::scope::{ScopeId, What};
use super::value::Value;
use super::words::{self, Kind, Word, vocabulary};
use crate::diagnostic::{Diagnostic, Span};
use crate::syntax::tree::{Block, Expr, Item, Name, Statement, StatementKind};

/// Turns of loops a file may take.
const TURNS: usize = 100_000;

/// Copies of copies of copies.
const COPIES: usize = 64;

/// The statements of an item with those it copies.
#[derive(Debug, Default)]
pub(super) struct Merged<'t> {
    /// What is evaluated, in order.
    pub statements: Vec<&'t Statement>,
    /// Edges that replace edges of a copied outline, by label.
    pub edges: Vec<&'t Statement>,
    /// Parameters that the copy sets.
    pub settings: Vec<Setting<'t>>,
}

/// A parameter set by a copy or by a part.
#[derive(Clone, Copy, Debug)]
pub(super) struct Setting<'t> {
    pub name: &'t Name,
    pub value: &'t Expr,
    /// Where its names are looked up; around the copy if nothing is said.
    pub scope: Option<ScopeId>,
}

/// The name by which a line of a copy replaces a line of the original.
fn replaces(statement: &Statement) -> Option<&str> {
    match &statement.kind {
        StatementKind::Let { name, .. }
        | StatementKind::Param { name, .. }
        | StatementKind::Function { name, .. } => Some(&name.text),
        StatementKind::Property { key, .. } => Some(&key.text),
        StatementKind::Line { word, phrase, .. } => match word.text.as_str() {
            "fit" | "mark" => match phrase.first() {
                Some(Item::Expr(expr)) => bare(expr).map(|name| name.text.as_str()),
                _ => None,
            },
            shape if SHAPES.contains(&shape) => Some("outline"),
            "unfold" => Some("unfold"),
            "pair" => Some("pair"),
            // Of a copied block, the items by their names.
            "panel" | "part" | "wearer" => match phrase.first() {
                Some(Item::Expr(expr)) => bare(expr).map(|name| name.text.as_str()),
                _ => None,
            },
            _ => None,
        },
        _ => None,
    }
}

/// The name that a line gives.
fn named(statement: &Statement) -> Option<&Name> {
    match &statement.kind {
        StatementKind::Let { name, .. }
        | StatementKind::Param { name, .. }
        | StatementKind::Function { name, .. } => Some(name),
        StatementKind::Property { key, .. } => Some(key),
        StatementKind::Line { word, phrase, .. }
            if matches!(word.text.as_str(), "fit" | "mark") =>
        {
            labelled(phrase)
        }
        _ => None,
    }
}

/// The first word of a labelled action: `shaping: dart on …`.
fn labelled(phrase: &[Item]) -> Option<&Name> {
    match phrase.first() {
        Some(Item::Expr(expr)) => bare(expr),
        _ => None,
    }
}

impl<'t> Evaluator<'t> {
    /// The text of an item with the text it copies (`panel back = front with { … }`).
    pub(super) fn merged(&mut self, id: ItemId, depth: usize) -> Option<Merged<'t>> {
        let item = self.item(id);
        let (kind, phrase, span) = (item.kind, item.phrase.clone(), item.span);
        let own: Vec<&'t Statement> =
            phrase.block.map(|block| block.statements.iter().collect()).unwrap_or_default();
        if kind == Kind::Wearer || !phrase.says("=") {
            return Some(Merged { statements: own, ..Merged::default() });
        }
        let base = self.item_named(phrase.value("=")?, kind)?;
        if depth >= COPIES || base == id {
            self.tell(
                Diagnostic::new("E0206", format!("`{}` copies itself", self.item(id).name))
                    .at(span, "here"),
            );
            return None;
        }
        let mut merged = self.merged(base, depth + 1)?;
        let mut added = Vec::new();
        for statement in own {
            if let StatementKind::Line { word, phrase, .. } = &statement.kind {
                if word.text == "omit" {
                    self.omit(&mut merged, phrase);
                    continue;
                }
            }
            if let StatementKind::Property { key, phrase, .. } = &statement.kind {
                let parameter = merged.statements.iter().any(|old| {
                    matches!(&old.kind, StatementKind::Param { name, .. } if name.text == key.text)
                });
                if parameter {
                    if let [Item::Expr(value)] = phrase.as_slice() {
                        let names = merged.statements.iter().filter_map(|old| named(old));
                        let declared: Vec<Span> = names
                            .filter(|name| name.text == key.text)
                            .map(|name| name.span)
                            .collect();
                        self.note_places(key.span, declared);
                        merged.settings.push(Setting { name: key, value, scope: None });
                        continue;
                    }
                }
                let outline_word = labelled(phrase)
                    .is_some_and(|w| vocabulary(Kind::Outline).find(&w.text, false).is_some());
                if kind == Kind::Panel && outline_word {
                    merged.edges.push(statement);
                    continue;
                }
            }
            let name = replaces(statement);
            let place =
                merged.statements.iter().position(|old| name.is_some() && replaces(old) == name);
            match place {
                Some(place) => {
                    if let Some((new, old)) =
                        named(statement).zip(merged.statements.get(place).and_then(|s| named(s)))
                        && new.text == old.text
                    {
                        self.note_replaced(new, old);
                    }
                    merged.statements[place] = statement;
                }
                None => added.push(statement),
            }
        }
        merged.statements.extend(added);
        Some(merged)
    }

    /// `omit a, b`: drops lines by name, label or word.
    fn omit(&mut self, merged: &mut Merged<'t>, phrase: &'t [Item]) {
        for item in phrase {
            let Item::Expr(expr) = item else { continue };
            let Some(name) = bare(expr) else {
                self.tell(
                    Diagnostic::new("E0201", "`omit` wants names of lines")
                        .at(expr.span, "this is no name"),
                );
                continue;
            };
            let before = merged.statements.len();
            merged.statements.retain(|old| {
                let word = match &old.kind {
                    StatementKind::Line { word, .. } => Some(word.text.as_str()),
                    _ => None,
                };
                replaces(old) != Some(name.text.as_str()) && word != Some(name.text.as_str())
            });
            if merged.statements.len() == before {
                let known: Vec<&str> =
                    merged.statements.iter().filter_map(|old| replaces(old)).collect();
                let label = self.meant(&name.text, known.into_iter());
                self.tell(
                    Diagnostic::new("E0204", format!("there is no `{}` to omit", name.text))
                        .at(name.span, label),
                );
            }
        }
    }

    /// Reads a block: declares its names in `scope`, unrolls loops and choices, matches its
    /// lines against the table.
    pub(super) fn read_block(
        &mut self,
        kind: Kind,
        span: Span,
        title: String,
        merged: &Merged<'t>,
        scope: ScopeId,
    ) -> Fields<'t> {
        self.settings.insert(scope, merged.settings.clone());
        let (phrases, spoiled) = (Vec::new(), Vec::new());
        let mut fields = Fields { kind, span, title, scope, phrases, spoiled };
        self.walk(&merged.statements, scope, &mut fields);
        self.once(&fields.phrases);
        fields
    }

    /// Reads a block that stands by itself, such as `drape { … }`.
    pub fn read_plain(
        &mut self,
        kind: Kind,
        block: &'t Block,
        title: &str,
        scope: ScopeId,
    ) -> Fields<'t> {
        let inner = self.new_scope(Some(scope));
        let merged = Merged { statements: block.statements.iter().collect(), ..Merged::default() };
        let span = Span { end: block.span.start.saturating_add(1), ..block.span };
        self.read_block(kind, span, title.to_owned(), &merged, inner)
    }

    /// Properties stand once in a block.
    fn once(&mut self, phrases: &[Phrase<'t>]) {
        for (i, phrase) in phrases.iter().enumerate() {
            if phrase.word.form != words::Form::Property {
                continue;
            }
            let twin = phrases.iter().take(i).find(|other| {
                other.word.form == words::Form::Property && other.key.text == phrase.key.text
            });
            if let Some(other) = twin {
                self.tell(
                    Diagnostic::new("E0209", format!("`{}` is said twice", phrase.key.text))
                        .at(phrase.key.span, "here")
                        .at(other.key.span, "and here")
                        .help("keep one"),
                );
            }
        }
    }

    /// Reads statements of a block into its fields. `inner` is the scope of these statements;
    /// items and labels are known in the scope of the whole block.
    fn walk(&mut self, statements: &[&'t Statement], inner: ScopeId, out: &mut Fields<'t>) {
        // First all names, so that they may be declared in any order.
        let mut matched: Vec<Vec<Phrase<'t>>> = Vec::with_capacity(statements.len());
        for statement in statements {
            matched.push(self.declare_statement(statement, inner, out));
        }
        for (statement, phrases) in statements.iter().zip(matched) {
            match &statement.kind {
                StatementKind::For { name, over, body } => {
                    let Some(turns) = self.turns_of(over, inner) else {
                        self.poison(&body.statements, out);
                        continue;
                    };
                    let lines: Vec<&'t Statement> = body.statements.iter().collect();
                    for value in turns {
                        self.turns += 1;
                        if self.turns > TURNS {
                            self.tell(
                                Diagnostic::new(
                                    "E0210",
                                    format!("the loops of this file take more than {TURNS} turns"),
                                )
                                .at(over.span, "the last of them here"),
                            );
                            break;
                        }
                        if !self.step(super::LINE * lines.len() as u64, over.span) {
                            break;
                        }
                        let turn = self.new_scope(Some(inner));
                        self.declare(turn, &name.text, name.span, turn, What::Given(value));
                        self.walk(&lines, turn, out);
                    }
                }
                StatementKind::If { condition, then, otherwise } => {
                    let arg = Arg { expr: condition, scope: inner, of: "if" };
                    let block = match self.condition(arg) {
                        Some(true) => Some(then),
                        Some(false) => otherwise.as_ref(),
                        None => {
                            for block in [Some(then), otherwise.as_ref()].into_iter().flatten() {
                                self.poison(&block.statements, out);
                            }
                            None
                        }
                    };
                    if let Some(block) = block {
                        let lines: Vec<&'t Statement> = block.statements.iter().collect();
                        let branch = self.new_scope(Some(inner));
                        self.walk(&lines, branch, out);
                    }
                }
                StatementKind::Line { word, phrase, block: Some(block) } if word.text == MATCH => {
                    match self.arm(word, phrase, block, inner) {
                        Some(lines) => {
                            let branch = self.new_scope(Some(inner));
                            self.walk(&lines, branch, out);
                        }
                        None => self.poison_arms(block, out),
                    }
                }
                _ => out.phrases.extend(phrases),
            }
        }
    }

    /// The value found for a fitted name of this block.
    fn fitted(&self, block: ScopeId, name: &str) -> Option<What<'t>> {
        let value = self.fits.get(&block)?.get(name)?;
        Some(What::Given(Value::Quantity(*value)))
    }

    /// What was set for a parameter of this block: by a copy, or from outside.
    fn setting(&mut self, name: &Name, block: ScopeId) -> Option<(&'t Expr, ScopeId)> {
        let by_copy = self.settings.get(&block).and_then(|settings| {
            settings.iter().find(|setting| setting.name.text == name.text).copied()
        });
        if let Some(Setting { value, scope, .. }) = by_copy {
            let around = self.scopes.get(block.0).and_then(|scope| scope.parent);
            return Some((value, scope.or(around).unwrap_or(block)));
        }
        if name.span.file != self.root || self.in_block(block) {
            return None;
        }
        let asked = self.options.iter().find(|asked| asked.name.text == name.text)?;
        self.asked_for.insert(asked.name.text.clone());
        Some((&asked.value, block))
    }

    /// The values a loop goes through; none where that is not known.
    fn turns_of(&mut self, over: &'t Expr, scope: ScopeId) -> Option<Vec<Value>> {
        match self.eval(over, scope) {
            Value::Poison => None,
            Value::List(values) => Some(values.to_vec()),
            Value::Range(from, to)
                if from.dimension.is_number()
                    && to.dimension.is_number()
                    && from.value.fract() == 0.0
                    && to.value.fract() == 0.0 =>
            {
                let count = (to.value - from.value + 1.0).clamp(0.0, (TURNS + 1) as f64) as usize;
                Some((0..count).map(|i| Value::number(from.value + i as f64)).collect())
            }
            other => {
                let message = match &other {
                    Value::Range(from, to) => {
                        format!("`for` goes through whole numbers, not from {from} to {to}")
                    }
                    other => {
                        let found = other.describe(|id| self.item(id).kind);
                        format!("`for` cannot go through {found}")
                    }
                };
                self.tell(
                    Diagnostic::new("E0304", message)
                        .at(over.span, "a range of whole numbers or a list is wanted")
                        .help("such as `1..6` or `[2cm, 5cm]`"),
                );
                None
            }
        }
    }

    /// Makes the names of a statement known and matches it against the table. What cannot be
    /// used is told and noted as spoiled.
    fn declare_statement(
        &mut self,
        statement: &'t Statement,
        inner: ScopeId,
        out: &mut Fields<'t>,
    ) -> Vec<Phrase<'t>> {
        let (kind, outer) = (out.kind, out.scope);
        match &statement.kind {
            StatementKind::Let { name, value } => {
                let what = self.fitted(outer, &name.text).unwrap_or(What::Let(value));
                self.declare(inner, &name.text, name.span, inner, what);
                Vec::new()
            }
            StatementKind::Param { name, kind: said, default, range } => {
                let set = self.setting(name, outer);
                let what = What::Param {
                    kind: said.as_ref(),
                    default: default.as_ref(),
                    range: range.as_ref(),
                    set,
                };
                let what = self.fitted(outer, &name.text).unwrap_or(what);
                let id = self.declare(inner, &name.text, name.span, inner, what);
                if !self.in_block(outer) {
                    self.parameters.push(id);
                }
                Vec::new()
            }
            StatementKind::Function { name, formals, kind: said, value } => {
                let what = What::Function { formals, kind: said.as_ref(), value };
                self.declare(inner, &name.text, name.span, inner, what);
                Vec::new()
            }
            StatementKind::Use(sources) => {
                if kind != Kind::File {
                    for source in sources {
                        self.tell(
                            Diagnostic::new("E0202", "`use` stands at the level of the file")
                                .at(source.span, "not here")
                                .help("move it to the top of the file"),
                        );
                    }
                }
                Vec::new()
            }
            StatementKind::For { .. } | StatementKind::If { .. } => Vec::new(),
            StatementKind::Line { word, block: Some(_), .. } if word.text == MATCH => Vec::new(),
            StatementKind::Property { key, phrase, drawing, block } => {
                let table = vocabulary(kind);
                let written = |key, label, items, drawing| Written {
                    key,
                    label,
                    items,
                    drawing,
                    block: block.as_ref(),
                    scope: inner,
                };
                if let Some(word) = table.find(&key.text, true) {
                    return self.take(word, written(key, None, phrase, drawing), out);
                }
                let action = labelled(phrase).filter(|_| drawing.is_empty());
                if let Some(name) = action {
                    if let Some(word) = table.find(&name.text, false) {
                        let items = phrase.get(1..).unwrap_or(&[]);
                        let found = self.take(word, written(name, Some(key), items, &[]), out);
                        // Labels of edges, and of round holes, are names of edges.
                        let round = found.first().is_some_and(|phrase| match phrase.word.name {
                            "hole" => phrase.block.is_none() && !phrase.says("slit"),
                            word => word == "smooth",
                        });
                        if kind != Kind::Outline && !round {
                            self.declare(outer, &key.text, key.span, inner, What::Label);
                        }
                        return found;
                    }
                }
                if let Some(word) = table.rows {
                    return self.take(word, written(key, None, phrase, drawing), out);
                }
                let action = action.filter(|_| phrase.len() > 1);
                let word = if unread(phrase) {
                    None
                } else {
                    self.tell_unknown_property(kind, key, action)
                };
                self.poison_line(word, Some(key), phrase, out);
                Vec::new()
            }
            StatementKind::Line { word: name, phrase, block } => {
                let Some(word) = vocabulary(kind).find(&name.text, false) else {
                    let word =
                        if unread(phrase) { None } else { self.tell_unknown_line(kind, name) };
                    self.poison_line(word, None, phrase, out);
                    return Vec::new();
                };
                let written = Written {
                    key: name,
                    label: None,
                    items: phrase,
                    drawing: &[],
                    block: block.as_ref(),
                    scope: inner,
                };
                self.take(word, written, out)
            }
        }
    }

    /// Matches a line, and those that follow it on the same line of the text.
    fn take(
        &mut self,
        word: &'static Word,
        written: Written<'t>,
        out: &mut Fields<'t>,
    ) -> Vec<Phrase<'t>> {
        let mut found = Vec::new();
        let mut next = Some((word, written));
        while let Some((word, written)) = next {
            let (label, items, inner) = (written.label, written.items, written.scope);
            let matched = self.match_phrase(out.kind, word, written);
            let mut phrase = matched.phrase;
            if let (Some(phrase), true) = (&phrase, word.name == "fit") {
                if let Some(name) = phrase.head.first().and_then(|expr| bare(expr)) {
                    let what = self.fitted(out.scope, &name.text);
                    let what = what.unwrap_or(What::Given(Value::Poison));
                    self.declare(inner, &name.text, name.span, inner, what);
                }
            }
            if let (Some(kind), true) = (word.block, declares(word.form)) {
                if kind == Kind::Wearer && self.inherits_wearer(out.scope, phrase.as_ref()) {
                    next = matched.next;
                    continue;
                }
                phrase = phrase.and_then(|phrase| self.declare_item(out.scope, kind, phrase));
            }
            if phrase.is_none() {
                self.poison_line(Some(word), label, items, out);
            }
            found.extend(phrase);
            next = matched.next;
        }
        found
    }
}
