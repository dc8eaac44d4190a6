//! Choices among the options of a parameter: `kind == box`, `match kind { … }`, and
//! `match(kind, knife: 2, box: 4)`. Every option must have its case.

use super::Evaluator;
use super::fields::{Arg, Fields, bare};
use super::scope::ScopeId;
use super::value::{Chosen, LARGEST, LETTERS, Value};
use crate::diagnostic::{Diagnostic, Span, codes, either};
use crate::syntax::tree::{Argument, BinaryOp, Block, Expr, Item, Name, Statement, StatementKind};

/// The word of a choice.
pub(super) const MATCH: &str = "match";

/// The case for all options that have none of their own.
const OTHERWISE: &str = "otherwise";

impl<'t> Evaluator<'t> {
    /// `kind == box`, where `kind` is a parameter with options and `box` one of them; none if
    /// this is another comparison.
    pub(super) fn option_compared(
        &mut self,
        op: BinaryOp,
        (left, right): (&'t Expr, &'t Expr),
        scope: ScopeId,
    ) -> Option<Value> {
        for (known, option) in [(left, right), (right, left)] {
            let Some(option) = bare(option) else { continue };
            let Some(name) = bare(known) else { continue };
            if self.find(scope, &name.text).is_none() {
                continue;
            }
            let Value::Word(chosen) = self.eval(known, scope) else { continue };
            if chosen.options.contains(&option.text) {
                let same = chosen.word == option.text;
                return Some(Value::Bool(same == (op == BinaryOp::Equal)));
            }
            if self.find(scope, &option.text).is_none() {
                return Some(self.no_option(&chosen, option));
            }
        }
        None
    }

    fn no_option(&mut self, chosen: &Chosen, option: &Name) -> Value {
        let message = format!("`{}` has no option `{}`", chosen.name, option.text);
        let label = self.meant(&option.text, chosen.options.iter().map(String::as_str));
        self.tell(
            Diagnostic::new("E0303", message)
                .at(option.span, label)
                .help(format!("its options are {}", chosen.options.join(", "))),
        );
        Value::Poison
    }

    /// The option that a choice goes by.
    fn chosen(&mut self, arg: Arg<'t>) -> Option<std::rc::Rc<Chosen>> {
        match self.eval(arg.expr, arg.scope) {
            Value::Poison => None,
            Value::Word(chosen) => Some(chosen),
            other => {
                self.wrong(&other, "a parameter with options", arg.expr.span);
                None
            }
        }
    }

    /// The case that is meant; cases that are missing, unknown or said twice are told.
    fn case<'c, T>(
        &mut self,
        chosen: &Chosen,
        cases: &'c [(&'t Name, T)],
        of: Span,
    ) -> Option<&'c T> {
        let mut sound = true;
        for (number, (name, _)) in cases.iter().enumerate() {
            if let Some((twin, _)) = cases.iter().take(number).find(|(n, _)| n.text == name.text) {
                self.tell(
                    Diagnostic::new("E0209", format!("`{}` is said twice", name.text))
                        .at(name.span, "here")
                        .at(twin.span, "and here"),
                );
                sound = false;
            }
            if name.text != OTHERWISE && !chosen.options.contains(&name.text) {
                self.no_option(chosen, name);
                sound = false;
            }
        }
        let find = |word: &str| cases.iter().find(|(name, _)| name.text == word);
        let missing: Vec<String> = chosen
            .options
            .iter()
            .filter(|option| find(option).is_none())
            .map(|option| format!("`{option}`"))
            .collect();
        if find(OTHERWISE).is_none() && !missing.is_empty() && sound {
            let message = format!("this `match` says nothing of {}", either(&missing));
            self.tell(
                Diagnostic::new("E0208", message)
                    .at(of, "a case is missing for it")
                    .help(format!("add it, or `{OTHERWISE}` for all that are not named")),
            );
            sound = false;
        }
        let found = find(&chosen.word).or_else(|| find(OTHERWISE)).filter(|_| sound);
        found.map(|(_, case)| case)
    }

    /// The lines of the case that `match kind { knife: { … } box: { … } }` means.
    pub(super) fn arm(
        &mut self,
        word: &'t Name,
        phrase: &'t [Item],
        block: &'t Block,
        scope: ScopeId,
    ) -> Option<Vec<&'t Statement>> {
        let [Item::Expr(expr)] = phrase else {
            self.tell(
                Diagnostic::new("E0208", "`match` must be given one parameter with options")
                    .at(word.span, "here")
                    .help("such as `match kind { knife: { … }  box: { … } }`"),
            );
            return None;
        };
        let chosen = self.chosen(Arg { expr, scope, of: MATCH })?;
        let mut cases: Vec<(&'t Name, &'t Block)> = Vec::new();
        for statement in &block.statements {
            match &statement.kind {
                StatementKind::Property { key, phrase, block: Some(inner), .. }
                    if phrase.is_empty() =>
                {
                    cases.push((key, inner));
                }
                _ => {
                    self.tell(
                        Diagnostic::new("E0202", "in a `match` stand options with their blocks")
                            .at(statement.span, "not this")
                            .help("such as `box: { … }`"),
                    );
                    return None;
                }
            }
        }
        let case = self.case(&chosen, &cases, word.span)?;
        Some(case.statements.iter().collect())
    }

    /// Notes the lines of all cases, of which it is not known whether they are said.
    pub(super) fn poison_arms(&mut self, block: &'t Block, out: &mut Fields<'t>) {
        for statement in &block.statements {
            if let StatementKind::Property { block: Some(inner), .. } = &statement.kind {
                self.poison(&inner.statements, out);
            }
        }
    }

    /// `match(kind, knife: 2, box: 4)`: the value of the case that is meant.
    pub(super) fn match_value(
        &mut self,
        arguments: &'t [Argument],
        scope: ScopeId,
        span: Span,
    ) -> Value {
        let usage = "match(NAME, OPTION: VALUE, OPTION: VALUE, …)";
        let (head, cases) = match arguments.split_first() {
            Some((head, cases)) if head.name.is_none() && !cases.is_empty() => (head, cases),
            _ => {
                self.tell(
                    Diagnostic::new("E0306", "`match` is not called so")
                        .at(span, "here")
                        .help(usage),
                );
                return Value::Poison;
            }
        };
        let mut named: Vec<(&'t Name, &'t Expr)> = Vec::with_capacity(cases.len());
        for case in cases {
            let Some(name) = &case.name else {
                self.tell(
                    Diagnostic::new("E0306", "which option is this value for?")
                        .at(case.value.span, "here")
                        .help(usage),
                );
                return Value::Poison;
            };
            named.push((name, &case.value));
        }
        let Some(chosen) = self.chosen(Arg { expr: &head.value, scope, of: MATCH }) else {
            return Value::Poison;
        };
        match self.case(&chosen, &named, span) {
            Some(value) => self.eval(value, scope),
            None => Value::Poison,
        }
    }

    /// Drops the warnings that a file does without: `allow W0601`.
    pub(super) fn allow(&mut self) {
        let mut allowed: Vec<(crate::diagnostic::FileId, &str)> = Vec::new();
        let files = self.files;
        for statement in files.iter().flat_map(|file| &file.tree.statements) {
            let StatementKind::Line { word, phrase, .. } = &statement.kind else { continue };
            if word.text != "allow" {
                continue;
            }
            for item in phrase {
                let Item::Expr(expr) = item else { continue };
                let Some(name) = bare(expr) else { continue };
                if name.text.starts_with('W') && codes::title(&name.text).is_some() {
                    allowed.push((name.span.file, &name.text));
                    continue;
                }
                let warnings = codes::CODES.iter().map(|known| known.code);
                let warnings: Vec<&str> = warnings.filter(|code| code.starts_with('W')).collect();
                let told = if codes::title(&name.text).is_some() {
                    Diagnostic::new("E0304", format!("`{}` is an error", name.text))
                        .at(name.span, "only warnings can be allowed")
                } else {
                    let label = self.meant(&name.text, warnings.iter().copied());
                    Diagnostic::new("E0204", format!("there is no warning `{}`", name.text))
                        .at(name.span, label)
                };
                self.tell(told.help(format!("warnings are {}", warnings.join(", "))));
            }
        }
        self.told.retain(|told| {
            let place = told.labels.first().map(|label| label.span.file);
            !allowed.iter().any(|(file, code)| place == Some(*file) && told.code == *code)
        });
    }

    /// A text with `{name}` replaced by what the name is worth; `{{` and `}}` are braces.
    pub(super) fn filled(&mut self, text: &str, scope: ScopeId, span: Span) -> Value {
        let mut out = String::with_capacity(text.len());
        let mut rest = text;
        while let Some(at) = rest.find(['{', '}']) {
            out.push_str(&rest[..at]);
            let brace = &rest[at..=at];
            rest = &rest[at + 1..];
            if let Some(after) = rest.strip_prefix(brace) {
                out.push_str(brace);
                rest = after;
                continue;
            }
            let named = (brace == "{").then(|| rest.split_once('}')).flatten();
            let Some((name, after)) = named else {
                self.tell(
                    Diagnostic::new("E0113", format!("`{brace}` stands alone in this text"))
                        .at(span, "here")
                        .help("`{name}` is replaced by its value; a brace itself is written twice"),
                );
                return Value::Poison;
            };
            rest = after;
            let Some(worth) = self.named_in_text(name.trim(), scope, span) else {
                return Value::Poison;
            };
            out.push_str(&worth);
            if out.len() > LETTERS * LARGEST {
                // It is told by whoever asked for it.
                return Value::Text(out);
            }
        }
        out.push_str(rest);
        Value::Text(out)
    }

    fn named_in_text(&mut self, name: &str, scope: ScopeId, span: Span) -> Option<String> {
        let Some(id) = self.find(scope, name) else {
            let known = self.visible(scope);
            let label = self.meant(name, known.iter().map(String::as_str));
            self.tell(
                Diagnostic::new("E0201", format!("nothing here is called `{name}`"))
                    .at(span, label)
                    .help("between the braces stands a name; give other values one by `let`"),
            );
            return None;
        };
        match self.binding_value(id, span) {
            Value::Poison => None,
            Value::Text(text) => Some(text),
            Value::Word(chosen) => Some(chosen.word.clone()),
            Value::Bool(yes) => Some(if yes { "yes" } else { "no" }.to_owned()),
            Value::Item(id) => Some(self.item(id).name.clone()),
            other => self.as_quantity(other, span).map(|quantity| quantity.to_string()),
        }
    }
}
