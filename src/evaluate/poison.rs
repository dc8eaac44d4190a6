//! Lines that a block does not know, and lines that cannot be used.
//!
//! A line that is wrong is told once. What it would have said or declared is noted as spoiled
//! and its names are poisoned, so that nobody complains on top of it that something is missing.

use super::Evaluator;
use super::choice::MATCH;
use super::fields::{Fields, Spoiled};
use super::item::{declares, root};
use super::scope::{ScopeId, What};
use super::value::Value;
use super::words::{self, Kind, Word, vocabulary};
use crate::diagnostic::{Diagnostic, either, spelling};
use crate::syntax::tree::{Block, Expr, ExprKind, Item, Name, Statement, StatementKind};

/// Whether part of a phrase could not be read, which the reader has told already.
pub(super) fn unread(phrase: &[Item]) -> bool {
    phrase.iter().any(|item| matches!(item, Item::Expr(Expr { kind: ExprKind::Unread, .. })))
}

impl<'t> Evaluator<'t> {
    /// Notes a line that cannot be used and poisons the name that it would have declared.
    pub(super) fn poison_line(
        &mut self,
        word: Option<&'static Word>,
        label: Option<&'t Name>,
        phrase: &'t [Item],
        out: &mut Fields<'t>,
    ) {
        out.spoiled.push(Spoiled { word, label });
        let names =
            word.is_some_and(|word| declares(word.form) || matches!(word.name, "fit" | "mark"));
        if let (true, Some(Item::Expr(first))) = (names, phrase.first()) {
            self.poison_name(root(first), out.scope);
        }
    }

    /// Makes a name known whose value nobody will ever complain of.
    pub(super) fn poison_name(&mut self, name: Option<&'t Name>, scope: ScopeId) {
        if let Some(name) = name.filter(|name| self.find(scope, &name.text).is_none()) {
            self.declare(scope, &name.text, name.span, scope, What::Given(Value::Poison));
        }
    }

    /// Notes all lines of a loop or a choice of which it is not known whether they are said.
    pub(super) fn poison(&mut self, statements: &'t [Statement], out: &mut Fields<'t>) {
        let table = vocabulary(out.kind);
        let inside = |block: &'t Block| block.statements.as_slice();
        for statement in statements {
            match &statement.kind {
                StatementKind::For { body, .. } => self.poison(inside(body), out),
                StatementKind::If { then, otherwise, .. } => {
                    self.poison(inside(then), out);
                    self.poison(otherwise.as_ref().map_or(&[], inside), out);
                }
                StatementKind::Line { word, block: Some(block), .. } if word.text == MATCH => {
                    self.poison_arms(block, out);
                }
                StatementKind::Line { word, phrase, .. } => {
                    self.poison_line(table.find(&word.text, false), None, phrase, out);
                }
                StatementKind::Property { key, phrase, .. } => {
                    let action = match phrase.first() {
                        Some(Item::Expr(first)) => root(first),
                        _ => None,
                    };
                    let word = table.find(&key.text, true);
                    let word = word.or_else(|| table.find(&action?.text, false));
                    out.spoiled.push(Spoiled { word, label: Some(key) });
                }
                _ => {}
            }
        }
    }

    /// Tells a property that the block does not know. Gives the word that was probably meant.
    pub(super) fn tell_unknown_property(
        &mut self,
        kind: Kind,
        key: &Name,
        action: Option<&Name>,
    ) -> Option<&'static Word> {
        self.once_unknown(kind, key, |ev| ev.unknown_property(kind, key, action))
    }

    /// Tells a line that the block does not know. Gives the word that was probably meant.
    pub(super) fn tell_unknown_line(&mut self, kind: Kind, name: &Name) -> Option<&'static Word> {
        self.once_unknown(kind, name, |ev| ev.unknown_line(kind, name))
    }

    /// Looks for what was meant the first time that a line is read: blocks in loops and panels
    /// with fits are read over and over.
    fn once_unknown(
        &mut self,
        kind: Kind,
        name: &Name,
        tell: impl FnOnce(&mut Self) -> Option<&'static Word>,
    ) -> Option<&'static Word> {
        if let Some(&meant) = self.unknown.get(&(name.span, kind)) {
            return meant;
        }
        let meant = tell(self);
        self.unknown.insert((name.span, kind), meant);
        meant
    }

    fn unknown_property(
        &mut self,
        kind: Kind,
        key: &Name,
        action: Option<&Name>,
    ) -> Option<&'static Word> {
        let table = vocabulary(kind);
        if let Some(word) = table.find(&key.text, false) {
            self.tell(
                Diagnostic::new("E0207", format!("`{}` takes no colon", key.text))
                    .at(key.span, "here")
                    .help(word.usage()),
            );
            return Some(word);
        }
        // `shaping: pleet on …`: the label may be any name, the word after it is wrong; unless
        // the label itself is nearly a property of the block.
        let own = near(table.words, key);
        let wrong = action.filter(|_| kind == Kind::Outline || own.is_none()).unwrap_or(key);
        self.tell_unknown_word(kind, wrong)
    }

    fn unknown_line(&mut self, kind: Kind, name: &Name) -> Option<&'static Word> {
        let table = vocabulary(kind);
        if let Some(word) = table.find(&name.text, true) {
            self.tell(
                Diagnostic::new("E0202", format!("`{}` is a property", name.text))
                    .at(name.span, "a colon is missing after it")
                    .help(word.usage()),
            );
            return Some(word);
        }
        let elsewhere: Vec<&str> = words::tables()
            .filter(|other| other.kind != kind && other.find(&name.text, false).is_some())
            .map(|other| other.kind.title())
            .collect();
        if elsewhere.is_empty() || near(table.words, name).is_some() {
            return self.tell_unknown_word(kind, name);
        }
        self.tell(
            Diagnostic::new("E0202", format!("{} has no `{}`", kind.title(), name.text))
                .at(name.span, format!("it belongs into {}", either(&elsewhere)))
                .help(word_list(table.words)),
        );
        None
    }

    fn tell_unknown_word(&mut self, kind: Kind, name: &Name) -> Option<&'static Word> {
        let words = vocabulary(kind).words;
        let label = self.meant(&name.text, words.iter().map(|word| word.name));
        self.tell(
            Diagnostic::new("E0203", format!("`{}` is not a word of {}", name.text, kind.title()))
                .at(name.span, label)
                .help(word_list(words)),
        );
        near(words, name)
    }
}

/// The word that a name was probably meant to be.
fn near(words: &'static [Word], name: &Name) -> Option<&'static Word> {
    let found = spelling::nearest(&name.text, words.iter().map(|word| word.name))?;
    words.iter().find(|word| word.name == found)
}

fn word_list(words: &[Word]) -> String {
    if words.is_empty() {
        return "it has no words".to_owned();
    }
    let mut names: Vec<&str> = words.iter().map(|word| word.name).collect();
    names.dedup();
    format!("its words are {}", names.join(", "))
}
