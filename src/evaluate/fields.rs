//! Statements matched against the table of words: a block becomes [`Fields`], a line of words
//! a [`Phrase`].

use super::Evaluator;
use super::item::ItemId;
use super::scope::ScopeId;
use super::words::{Clause, Element, Kind, Many, Pattern, Word};
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

fn place(item: &Item) -> Span {
    match item {
        Item::Comma(span) | Item::Arrow(span) | Item::Equals(span) => *span,
        Item::Expr(expr) => expr.span,
    }
}

/// A word or sign that may begin a clause.
fn sign(item: &Item) -> Option<&str> {
    match item {
        Item::Equals(_) => Some("="),
        Item::Expr(expr) => bare(expr).map(|name| name.text.as_str()),
        _ => None,
    }
}

/// Reads the items of one phrase.
struct Reader<'e, 't> {
    ev: &'e mut Evaluator<'t>,
    word: &'static Word,
    pattern: &'static Pattern,
    items: &'t [Item],
    at: usize,
    end: Span,
}

impl<'t> Reader<'_, 't> {
    fn next_sign(&self) -> Option<&'t str> {
        self.items.get(self.at).and_then(sign)
    }

    fn begins_clause(&self) -> bool {
        self.next_sign().is_some_and(|word| self.pattern.clause(word).is_some())
    }

    /// Values for the elements of the head or of a clause; false if something is missing.
    fn elements(
        &mut self,
        of: &str,
        elements: &[Element],
        args: &mut Vec<&'t Expr>,
        rest: &mut &'t [Item],
    ) -> bool {
        let mut skipped = false;
        for (n, element) in elements.iter().enumerate() {
            match element {
                Element::Rest => {
                    *rest = self.items.get(self.at..).unwrap_or(&[]);
                    self.at = self.items.len();
                }
                Element::Literal(word) => {
                    if self.next_sign() == Some(word) {
                        self.at += 1;
                    } else if matches!(
                        elements.get(n + 1),
                        Some(Element::Operand { required: false, .. })
                    ) {
                        skipped = true;
                    } else {
                        let found = self.items.get(self.at).map_or(self.end, place);
                        self.ev.tell(
                            Diagnostic::new("E0306", format!("`{of}` wants `{word}` here"))
                                .at(found, format!("`{word}` is missing"))
                                .help(self.word.usage()),
                        );
                        return false;
                    }
                }
                Element::Operand { name, choice, many, required } => {
                    if skipped {
                        skipped = false;
                        continue;
                    }
                    if !required
                        && (self.begins_clause()
                            || !matches!(self.items.get(self.at), Some(Item::Expr(_))))
                    {
                        continue;
                    }
                    if !self.operand(of, name, choice, *many, args) {
                        return false;
                    }
                }
            }
        }
        true
    }

    fn operand(
        &mut self,
        of: &str,
        name: &str,
        choice: &[&'static str],
        many: Many,
        args: &mut Vec<&'t Expr>,
    ) -> bool {
        let mut count = 0;
        loop {
            let Some(Item::Expr(expr)) = self.items.get(self.at) else {
                let found = self.items.get(self.at).map_or(self.end, place);
                let wanted =
                    if choice.is_empty() { name.to_lowercase() } else { choice.join(", ") };
                self.ev.tell(
                    Diagnostic::new("E0208", format!("`{of}` must be given a value"))
                        .at(found, format!("missing here: {wanted}"))
                        .help(self.word.usage()),
                );
                return false;
            };
            if !choice.is_empty() {
                let said = bare(expr).map(|name| name.text.as_str());
                if !said.is_some_and(|said| choice.contains(&said)) {
                    if matches!(expr.kind, ExprKind::Unread) {
                        return false;
                    }
                    let text = self.ev.snippet(expr.span).to_owned();
                    let label = self.ev.meant(&text, choice.iter().copied());
                    self.ev.tell(
                        Diagnostic::new("E0203", format!("no {of} `{text}`"))
                            .at(expr.span, label)
                            .help(format!("`{of}` may be {}", choice.join(", "))),
                    );
                    return false;
                }
            }
            args.push(expr);
            count += 1;
            self.at += 1;
            let more = match (many, self.items.get(self.at)) {
                (Many::Commas, Some(Item::Comma(_))) => true,
                (Many::Arrows, Some(Item::Arrow(_))) => true,
                (Many::Arrows, next) if count < 2 => {
                    let found = next.map_or(self.end, place);
                    self.ev.tell(
                        Diagnostic::new("E0208", format!("`{of}` wants `->` and another edge"))
                            .at(found, "missing here")
                            .help(self.word.usage()),
                    );
                    return false;
                }
                _ => false,
            };
            if !more {
                return true;
            }
            self.at += 1;
        }
    }

    fn clause(&mut self, clause: &'static Clause, clauses: &mut Vec<Said<'t>>) -> bool {
        let span = self.items.get(self.at).map_or(self.end, place);
        self.at += 1;
        if let Some(before) = clauses.iter().find(|said| {
            self.pattern.clause(said.word).is_some_and(|other| other.group == clause.group)
        }) {
            let message = if before.word == clause.word {
                format!("`{}` is said twice", clause.word)
            } else {
                format!("`{}` and `{}` cannot both be said", before.word, clause.word)
            };
            self.ev.tell(
                Diagnostic::new("E0209", message)
                    .at(span, "here")
                    .at(before.span, "and here")
                    .help(self.word.usage()),
            );
            return false;
        }
        let mut said = Said { word: clause.word, span, args: Vec::new(), rest: &[] };
        let mut rest: &'t [Item] = &[];
        let good = self.elements(clause.word, &clause.elements, &mut said.args, &mut rest);
        said.rest = rest;
        clauses.push(said);
        good
    }

    /// Complains of what is no word of this phrase and goes on at the next clause.
    fn stray(&mut self) {
        let Some(item) = self.items.get(self.at) else { return };
        let span = place(item);
        if !matches!(item, Item::Expr(Expr { kind: ExprKind::Unread, .. })) {
            let text = self.ev.snippet(span).to_owned();
            let meant = self.ev.meant(&text, self.pattern.words().into_iter());
            self.ev.tell(
                Diagnostic::new(
                    "E0203",
                    if sign(item).is_some() {
                        format!("`{text}` is not a word of `{}`", self.word.name)
                    } else {
                        format!("`{}` does not know what to do with `{text}`", self.word.name)
                    },
                )
                .at(span, meant)
                .help(self.word.usage()),
            );
        }
        self.at += 1;
        while self.at < self.items.len() && !self.begins_clause() {
            self.at += 1;
        }
    }
}

/// Where a phrase stands, before it is matched.
pub(super) struct Written<'t> {
    pub key: &'t Name,
    pub label: Option<&'t Name>,
    pub items: &'t [Item],
    pub drawing: &'t [Row],
    pub block: Option<&'t Block>,
    pub scope: ScopeId,
}

impl<'t> Evaluator<'t> {
    /// Matches a phrase against the pattern of its word; what does not match is told.
    /// None if the phrase cannot be used.
    pub(super) fn match_phrase(
        &mut self,
        word: &'static Word,
        written: Written<'t>,
    ) -> Option<Phrase<'t>> {
        let pattern = word.read();
        let first = written.label.unwrap_or(written.key).span;
        let span = written.items.last().map_or(first, |item| first.to(place(item)));
        let end = Span { start: span.end.saturating_sub(1).max(span.start), ..span };
        let (head, clauses, rest, mut good) = {
            let mut reader = Reader { ev: self, word, pattern, items: written.items, at: 0, end };
            let mut head = Vec::new();
            let mut rest: &'t [Item] = &[];
            let mut good = reader.elements(&written.key.text, &pattern.head, &mut head, &mut rest);
            let mut clauses = Vec::new();
            while reader.at < reader.items.len() {
                let clause = reader.next_sign().and_then(|sign| pattern.clause(sign));
                match clause {
                    Some(clause) => good &= reader.clause(clause, &mut clauses),
                    None if good => {
                        reader.stray();
                        good = false;
                    }
                    // After a first complaint only known words are read on.
                    None => reader.at += 1,
                }
            }
            (head, clauses, rest, good)
        };
        if good {
            for (group, _) in pattern.groups.iter().enumerate().filter(|group| *group.1) {
                let members: Vec<_> =
                    pattern.clauses.iter().filter(|clause| clause.group == group).collect();
                if !clauses.iter().any(|said| members.iter().any(|c| c.word == said.word)) {
                    let names: Vec<_> =
                        members.iter().map(|clause| format!("`{}`", clause.word)).collect();
                    self.tell(
                        Diagnostic::new(
                            "E0208",
                            format!("`{}` must be given {}", word.name, names.join(" or ")),
                        )
                        .at(span, "missing here")
                        .help(word.usage()),
                    );
                    good = false;
                }
            }
        }
        if written.block.is_some() && word.block.is_none() {
            if let Some(block) = written.block {
                self.tell(
                    Diagnostic::new("E0202", format!("`{}` has no block", word.name))
                        .at(Span { end: block.span.start + 1, ..block.span }, "here")
                        .help(word.usage()),
                );
            }
            good = false;
        }
        good.then_some(Phrase {
            word,
            key: written.key,
            label: written.label,
            span,
            scope: written.scope,
            head,
            clauses,
            rest,
            block: written.block,
            drawing: written.drawing,
            item: None,
        })
    }

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
