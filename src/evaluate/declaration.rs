//! Parameters and numbered items.

use super::Evaluator;
use super::fields::{Arg, bare};
use super::item::ItemId;
use super::scope::{Binding, BindingId, ScopeId, What};
use super::value::{Chosen, Value};
use crate::diagnostic::{Diagnostic, Span};
use crate::syntax::tree::{Expr, ExprKind, Name};
use crate::units::Quantity;
use std::collections::BTreeMap;
use std::rc::Rc;

impl<'t> Evaluator<'t> {
    /// Adds `name[number]` to the items of that name.
    pub(super) fn declare_member(
        &mut self,
        into: ScopeId,
        name: &'t Name,
        number: i64,
        item: ItemId,
        scope: ScopeId,
    ) {
        let known = self.scopes.get(into.0).and_then(|scope| scope.names.get(&name.text)).copied();
        if let Some(id) = known {
            if let Some(Binding { what: What::Family(members), .. }) = self.bindings.get_mut(id.0) {
                let before = members.insert(number, item);
                if let Some(before) = before {
                    let first = self.item(before).span;
                    self.tell(
                        Diagnostic::new(
                            "E0205",
                            format!("`{}[{number}]` is used for two things", name.text),
                        )
                        .at(first, "an item here")
                        .at(name.span, "an item here"),
                    );
                }
                return;
            }
        }
        let members = BTreeMap::from([(number, item)]);
        self.declare(into, &name.text, name.span, scope, What::Family(members));
    }

    /// `gore[2]`, `gore[1..6]`
    pub(super) fn family_members(
        &mut self,
        name: &'t Name,
        members: &BTreeMap<i64, ItemId>,
        numbers: &'t [Expr],
        scope: ScopeId,
    ) -> Value {
        let [number] = numbers else {
            self.tell(
                Diagnostic::new("E0306", format!("`{}[…]` wants one number", name.text))
                    .at(name.span, "here"),
            );
            return Value::Poison;
        };
        let whole = |value: f64| (value.fract() == 0.0).then_some(value as i64);
        let value = self.eval(number, scope);
        let wanted = match &value {
            Value::Poison => return Value::Poison,
            Value::Quantity(q) if q.dimension.is_number() => whole(q.value).map(|n| (n, n)),
            Value::Range(a, b) if a.dimension.is_number() => whole(a.value).zip(whole(b.value)),
            _ => None,
        };
        let Some((first, last)) = wanted else {
            return self.wrong(&value, "a whole number or a range of them", number.span);
        };
        let (low, high) = (
            members.keys().next().copied().unwrap_or(0),
            members.keys().next_back().copied().unwrap_or(0),
        );
        if first < low || last > high || first > last || !members.contains_key(&first) {
            self.tell(
                Diagnostic::new("E0204", format!("there is no `{}[{first}..{last}]`", name.text))
                    .at(number.span, format!("{low} to {high} are there")),
            );
            return Value::Poison;
        }
        if first == last {
            return members.get(&first).map_or(Value::Poison, |id| Value::Item(*id));
        }
        Value::Items(members.range(first..=last).map(|(_, id)| *id).collect())
    }

    /// The value of a parameter: what was set, or its default, if its range allows it.
    pub(super) fn param_value(
        &mut self,
        id: BindingId,
        kind: Option<&'t Name>,
        default: Option<&'t Expr>,
        range: Option<&'t Expr>,
        set: Option<(&'t Expr, ScopeId)>,
    ) -> Value {
        let binding = &self.bindings[id.0];
        let (name, span, scope) = (binding.name.clone(), binding.span, binding.scope);
        let options = range.and_then(options);
        let (expr, at) = match (set, default) {
            (Some((expr, at)), _) => (expr, at),
            (None, Some(expr)) => (expr, scope),
            (None, None) if self.is_lone(scope) => return Value::Poison,
            (None, None) => {
                let wanted =
                    kind.map_or("a value".to_owned(), |kind| super::read::kind_title(&kind.text));
                let told = match self.part_around(scope) {
                    Some(part) => {
                        let title = self.item(part).name.clone();
                        Diagnostic::new("E0208", format!("part `{title}` must be given `{name}`"))
                            .at(self.item(part).span, "missing here")
                            .at(span, format!("{wanted} is wanted"))
                            .help(format!("`part {title} = … {{ {name}: … }}`"))
                    }
                    None => Diagnostic::new("E0208", format!("`{name}` must be given"))
                        .at(span, format!("{wanted} is wanted"))
                        .help(format!("`param {name} = …`, or set it from outside")),
                };
                self.tell(told);
                return Value::Poison;
            }
        };
        if let Some(options) = options {
            let range = range.map_or(span, |range| range.span);
            return self.option((expr, at), &options, &name, range);
        }
        let of = self.snippet(span);
        let value = self.of_kind(Arg { expr, scope: at, of }, kind);
        let Some(range) = range else { return value };
        let allowed = self.eval(range, scope);
        let (low, high) = match allowed {
            Value::Range(low, high) if low.value > high.value => {
                self.tell(
                    Diagnostic::new("E0303", format!("the range of `{name}` goes downwards"))
                        .at(range.span, format!("from {low} to {high}"))
                        .help("the lower end stands first: `0cm..8cm`"),
                );
                return value;
            }
            Value::Range(low, high) => (low, high),
            Value::List(values) => {
                if value == Value::Poison || values.contains(&value) {
                    return value;
                }
                self.tell(
                    Diagnostic::new("E0303", format!("`{name}` is none of its options"))
                        .at(expr.span, "set here")
                        .at(range.span, "the options"),
                );
                return Value::Poison;
            }
            Value::Poison => return Value::Poison,
            other => return self.wrong(&other, "a range or a list", range.span),
        };
        let Some(quantity) = self.as_quantity(value, expr.span) else { return Value::Poison };
        if !quantity.fits(low.dimension) {
            self.tell(
                Diagnostic::new(
                    "E0301",
                    format!(
                        "{} and {} cannot be compared",
                        quantity.dimension.name(),
                        low.dimension.name()
                    ),
                )
                .at(expr.span, self.shown(quantity))
                .at(range.span, format!("a range of {}", low.dimension.name())),
            );
            return Value::Poison;
        }
        // A hair of slack, so that a limit said in another unit still counts as reached.
        let slack = 1e-9 * (low.value.abs() + high.value.abs());
        if quantity.value < low.value - slack || quantity.value > high.value + slack {
            let from_outside =
                self.options.iter().any(|asked| asked.value.span.file == expr.span.file);
            let here = if from_outside { span } else { expr.span };
            self.tell(
                Diagnostic::new(
                    "E0303",
                    format!("`{name}` is {quantity}; {low} to {high} are allowed"),
                )
                .at(here, if from_outside { "set from outside" } else { "set here" })
                .at(range.span, "range"),
            );
            return Value::Poison;
        }
        Value::Quantity(Quantity::new(quantity.value, low.dimension))
    }

    /// Whether a scope belongs to a panel that was opened only to try a value of a fit.
    pub(super) fn is_trial(&self, scope: ScopeId) -> bool {
        let mut at = Some(scope);
        while let Some(id) = at {
            if self.trials.contains(&id) {
                return true;
            }
            at = self.scopes.get(id.0).and_then(|scope| scope.parent);
        }
        false
    }

    /// A parameter with options: `param kind = knife in [knife, box]`.
    fn option(
        &mut self,
        (expr, scope): (&'t Expr, ScopeId),
        options: &[&'t Name],
        name: &str,
        range: Span,
    ) -> Value {
        let is_option = |word: &str| options.iter().any(|option| option.text == word);
        let chosen = |word: &str| {
            Value::Word(Rc::new(Chosen {
                word: word.to_owned(),
                options: options.iter().map(|option| option.text.clone()).collect(),
                name: name.to_owned(),
            }))
        };
        match bare(expr) {
            Some(word) if is_option(&word.text) => chosen(&word.text),
            // A parameter of the caller that is handed on.
            Some(word) if self.find(scope, &word.text).is_some() => match self.eval(expr, scope) {
                Value::Word(other) if is_option(&other.word) => chosen(&other.word),
                Value::Poison => Value::Poison,
                _ => {
                    self.tell(
                        Diagnostic::new("E0303", format!("`{name}` is none of its options"))
                            .at(expr.span, "this is none of them")
                            .at(range, "the options"),
                    );
                    Value::Poison
                }
            },
            found => {
                let text = found.map_or("", |name| name.text.as_str());
                let label = self.meant(text, options.iter().map(|option| option.text.as_str()));
                self.tell(
                    Diagnostic::new("E0303", format!("`{name}` is none of its options"))
                        .at(expr.span, label)
                        .at(range, "the options"),
                );
                Value::Poison
            }
        }
    }

    /// Works out every name of the file, so that a mistake is told although nobody needs the
    /// value, and, if the whole file was read, tells what was to be set and is not there.
    pub(super) fn check_names(&mut self, whole: bool) {
        let mut at = 0;
        while let Some(binding) = self.bindings.get(at) {
            let own = matches!(binding.what, What::Let(_) | What::Param { .. });
            let span = binding.span;
            if own && span.file == self.root && !self.is_trial(binding.scope) {
                self.binding_value(BindingId(at), span);
            }
            at += 1;
        }
        let mut names: Vec<String> = self
            .parameters
            .iter()
            .map(|id| &self.bindings[id.0])
            .filter(|binding| binding.span.file == self.root)
            .map(|binding| binding.name.clone())
            .collect();
        names.sort();
        names.dedup();
        for asked in self.options.iter().filter(|_| whole) {
            let Name { text, span } = &asked.name;
            if !self.asked_for.contains(text) {
                let label = self.meant(text, names.iter().map(String::as_str));
                let message = format!("this file has no parameter `{text}`");
                let mut told = Diagnostic::new("E0204", message).at(*span, label);
                if !names.is_empty() {
                    told = told.help(format!("it has {}", names.join(", ")));
                }
                self.tell(told);
            }
        }
    }
}

/// Options that are bare words: `[knife, box]`.
fn options(range: &Expr) -> Option<Vec<&Name>> {
    match &range.kind {
        ExprKind::List(parts) => parts.iter().map(bare).collect(),
        _ => None,
    }
}
