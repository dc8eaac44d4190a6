//! Blocks and lines as the table of words sees them: a block becomes [`Fields`], a line of words
//! a [`Phrase`].

use super::Evaluator;
use super::item::ItemId;
use super::scope::ScopeId;
use super::words::{Kind, Word};
use crate::diagnostic::{Diagnostic, Span};
use crate::syntax::tree::{Block, Expr, ExprKind, Item, Name, Row};

/// A value of a phrase, with what is needed to evaluate it and to complain about it.
#[derive(Clone, Copy, Debug)]
pub struct Arg<'t> {
    /// The value as written.
    pub expr: &'t Expr,
    /// Where its names are looked up.
    pub scope: ScopeId,
    /// The word that wants it.
    pub of: &'t str,
}

/// A clause that was said.
#[derive(Clone, Debug)]
pub struct Said<'t> {
    /// Its word.
    pub word: &'static str,
    /// Where the word stands.
    pub span: Span,
    /// Its values, in order.
    pub args: Vec<&'t Expr>,
    /// What follows, where the clause takes whatever follows.
    pub rest: &'t [Item],
}

/// A property or action of a block, matched against its pattern.
#[derive(Clone, Debug)]
pub struct Phrase<'t> {
    /// The word of the table.
    pub word: &'static Word,
    /// The word, or the key of a free row, as it stands in the text.
    pub key: &'t Name,
    /// The label before an action.
    pub label: Option<&'t Name>,
    /// From the first word to the last value.
    pub span: Span,
    /// Where its names are looked up.
    pub scope: ScopeId,
    /// The values at its head.
    pub head: Vec<&'t Expr>,
    /// The clauses that were said, in the order of the text.
    pub clauses: Vec<Said<'t>>,
    /// What follows, where the pattern takes whatever follows.
    pub rest: &'t [Item],
    /// The block at its end.
    pub block: Option<&'t Block>,
    /// The chart after its colon.
    pub drawing: &'t [Row],
    /// The item it declares.
    pub item: Option<ItemId>,
}

impl<'t> Phrase<'t> {
    /// The `n`th value at the head.
    pub fn arg(&self, n: usize) -> Option<Arg<'t>> {
        self.head.get(n).map(|&expr| Arg { expr, scope: self.scope, of: &self.key.text })
    }

    /// All values at the head.
    pub fn args(&self) -> Vec<Arg<'t>> {
        (0..self.head.len()).filter_map(|n| self.arg(n)).collect()
    }

    /// The clause of that word, if it was said.
    pub fn clause(&self, word: &str) -> Option<&Said<'t>> {
        self.clauses.iter().find(|said| said.word == word)
    }

    /// Whether the clause of that word was said.
    pub fn says(&self, word: &str) -> bool {
        self.clause(word).is_some()
    }

    /// The first value of a clause.
    pub fn value(&self, word: &str) -> Option<Arg<'t>> {
        self.values(word).into_iter().next()
    }

    /// The word chosen in a clause.
    pub fn word_of(&self, word: &str) -> Option<&'t str> {
        let said = self.clause(word)?;
        said.args.first().and_then(|expr| bare(expr)).map(|name| name.text.as_str())
    }

    /// All values of a clause.
    pub fn values(&self, word: &str) -> Vec<Arg<'t>> {
        let Some(said) = self.clause(word) else { return Vec::new() };
        let of = if said.word == "=" { self.key.text.as_str() } else { said.word };
        said.args.iter().map(|&expr| Arg { expr, scope: self.scope, of }).collect()
    }

    /// The choice made at the head, if it is a bare word.
    pub fn choice(&self, n: usize) -> Option<&'t str> {
        self.head.get(n).and_then(|expr| bare(expr)).map(|name| name.text.as_str())
    }
}

/// A line of a block that could not be matched, which has been told.
#[derive(Clone, Copy, Debug)]
pub struct Spoiled<'t> {
    /// The word of the table that it says, or probably means.
    pub word: Option<&'static Word>,
    /// The label before it.
    pub label: Option<&'t Name>,
}

/// The properties and actions of a block, in the order of the text.
#[derive(Clone, Debug)]
pub struct Fields<'t> {
    /// The kind of block.
    pub kind: Kind,
    /// What is complained of when something is missing: the block's name or word.
    pub span: Span,
    /// How messages call it: `panel front`.
    pub title: String,
    /// Its own scope.
    pub scope: ScopeId,
    /// Its lines.
    pub phrases: Vec<Phrase<'t>>,
    /// Lines that cannot be used. Nobody complains that what they say is missing.
    pub spoiled: Vec<Spoiled<'t>>,
}

impl<'t> Fields<'t> {
    /// The property or action of that word; the last one counts.
    pub fn get(&self, word: &str) -> Option<&Phrase<'t>> {
        self.phrases.iter().rev().find(|phrase| phrase.word.name == word)
    }

    /// All phrases of that word.
    pub fn all<'a>(&'a self, word: &'a str) -> impl Iterator<Item = &'a Phrase<'t>> {
        self.phrases.iter().filter(move |phrase| phrase.word.name == word)
    }

    /// Whether a line says that word, be it in a way that cannot be used.
    pub fn mentions(&self, word: &str) -> bool {
        self.get(word).is_some() || self.spoils(word)
    }

    /// Whether a line says that word in a way that cannot be used.
    pub fn spoils(&self, word: &str) -> bool {
        self.spoiled.iter().any(|line| line.word.is_some_and(|known| known.name == word))
    }

    /// The first value of a property.
    pub fn value(&self, word: &str) -> Option<Arg<'t>> {
        self.get(word).and_then(|phrase| phrase.arg(0))
    }

    /// Lines with keys of the writer's own.
    pub fn rows(&self) -> impl Iterator<Item = &Phrase<'t>> {
        self.phrases.iter().filter(|phrase| phrase.key.text != phrase.word.name)
    }
}

/// A name that stands alone.
pub fn bare(expr: &Expr) -> Option<&Name> {
    match &expr.kind {
        ExprKind::Path(names) if names.len() == 1 => names.first(),
        _ => None,
    }
}

impl<'t> Evaluator<'t> {
    /// What a misspelt word may have been meant to be, as the text of a label.
    pub fn meant<'a>(&self, word: &str, known: impl Iterator<Item = &'a str>) -> String {
        match crate::diagnostic::spelling::nearest(word, known) {
            Some(near) => format!("did you mean `{near}`?"),
            None => "not known here".to_owned(),
        }
    }

    /// A property that must be given; its absence is told, unless it is there but spoiled.
    pub fn required<'f>(&mut self, fields: &'f Fields<'t>, word: &str) -> Option<&'f Phrase<'t>> {
        let found = fields.get(word);
        if found.is_none() && !fields.spoils(word) {
            let help = super::words::vocabulary(fields.kind)
                .words
                .iter()
                .find(|known| known.name == word)
                .map(|known| format!("{}    {}", known.usage(), known.help));
            let mut told =
                Diagnostic::new("E0208", format!("{} must be given `{word}`", fields.title))
                    .at(fields.span, "missing here");
            told.help = help;
            self.tell(told);
        }
        found
    }

    /// A quantity property; `otherwise` where it is not given, none where it is wrong.
    pub fn quantity_or(
        &mut self,
        fields: &Fields<'t>,
        word: &str,
        dimension: crate::units::Dimension,
        otherwise: f64,
    ) -> Option<f64> {
        match fields.value(word) {
            Some(arg) => self.quantity(arg, dimension),
            None => Some(otherwise),
        }
    }
}
