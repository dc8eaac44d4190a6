//! Lines of words matched against the patterns of the table.

use super::Evaluator;
use super::fields::{Phrase, Said, bare};
use super::poison::unread;
use super::scope::ScopeId;
use super::words::{Clause, Element, Kind, Many, Pattern, Word, vocabulary};
use crate::diagnostic::{Diagnostic, Span, either, spelling};
use crate::syntax::tree::{BinaryOp, Block, Expr, ExprKind, Item, Name, Row};
use crate::syntax::two_on_a_line;

/// Words that people write where edges are joined by `->`.
const JOINING: &[&str] = &["to", "with", "on", "onto", "and", "at"];

/// Where a phrase stands, before it is matched.
pub(super) struct Written<'t> {
    pub key: &'t Name,
    pub label: Option<&'t Name>,
    pub items: &'t [Item],
    pub drawing: &'t [Row],
    pub block: Option<&'t Block>,
    pub scope: ScopeId,
}

/// What came of a line of words.
pub(super) struct Matched<'t> {
    /// The phrase; none if it cannot be used, which has been told.
    pub phrase: Option<Phrase<'t>>,
    /// A second statement on the same line, which has been told.
    pub next: Option<(&'static Word, Written<'t>)>,
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
    /// The kind of block in which the line stands.
    kind: Kind,
    word: &'static Word,
    pattern: &'static Pattern,
    items: &'t [Item],
    at: usize,
    end: Span,
    /// Where a second statement begins.
    next: Option<(&'static Word, usize)>,
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
                        self.tell_sizes(of, word, elements);
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

    /// Tells that of several values joined by a word, `40cm x 60cm`, not all are there.
    fn tell_sizes(&mut self, of: &str, word: &str, elements: &[Element]) {
        let item = self.items.get(self.at);
        let from = self.items.get(self.at.saturating_sub(1)..).unwrap_or(&[]);
        if unread(from.get(..2).unwrap_or(from)) {
            return;
        }
        let values = elements.iter().filter(|e| matches!(e, Element::Operand { .. })).count();
        let label = match item {
            Some(_) => format!("`{word}` is missing before this"),
            None => format!("`{word}` and another value are missing"),
        };
        self.ev.tell(
            Diagnostic::new("E0306", format!("`{of}` wants {values} values with `{word}` between"))
                .at(item.map_or(self.end, Item::span), label)
                .help(self.word.usage()),
        );
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
                let found = self.items.get(self.at).map_or(self.end, Item::span);
                let wanted =
                    if choice.is_empty() { name.to_lowercase() } else { choice.join(", ") };
                self.ev.tell(
                    Diagnostic::new("E0208", format!("`{of}` must be given a value"))
                        .at(found, format!("missing here: {wanted}"))
                        .help(self.word.usage()),
                );
                return false;
            };
            if count == 0 && name == "NAME" && self.nameless(expr) {
                return false;
            }
            if count > 0 && self.goes_on(of, expr) {
                return false;
            }
            if !choice.is_empty() {
                let said = bare(expr).map(|name| name.text.as_str());
                if !said.is_some_and(|said| choice.contains(&said)) {
                    if matches!(expr.kind, ExprKind::Unread) {
                        return false;
                    }
                    let text = self.ev.snippet(expr.span).to_owned();
                    let label = self.ev.meant(&text, choice.iter().copied());
                    // Of `views` one is a view.
                    let one = if many == Many::Commas { of.trim_end_matches('s') } else { of };
                    self.ev.tell(
                        Diagnostic::new("E0203", format!("no {one} `{text}`"))
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
                (Many::Arrows, _) if count < 2 => {
                    self.tell_unjoined(of, expr);
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

    /// Tells an item without a name of its own: `panel of denim { … }`.
    fn nameless(&mut self, expr: &'t Expr) -> bool {
        let after = self.items.get(self.at + 1);
        let nameless = bare(expr).is_some_and(|name| self.pattern.clause(&name.text).is_some())
            && matches!(after, Some(item @ Item::Expr(_))
                if sign(item).is_none_or(|word| self.pattern.clause(word).is_none()));
        if nameless {
            self.ev.tell(
                Diagnostic::new("E0208", format!("`{}` must be given a name", self.word.name))
                    .at(expr.span, "missing before this")
                    .help(self.word.usage()),
            );
        }
        nameless
    }

    /// Tells a list that ends with its sign, so that the next line was read on: `seam a ->`.
    fn goes_on(&mut self, of: &str, expr: &'t Expr) -> bool {
        let word = bare(expr).and_then(|name| vocabulary(self.kind).find(&name.text, false));
        let (Some(word), Some(Item::Expr(_))) = (word, self.items.get(self.at + 1)) else {
            return false;
        };
        let sign = self.items.get(self.at - 1).map_or(expr.span, Item::span);
        self.ev.tell(
            Diagnostic::new("E0208", format!("`{of}` must be given a value"))
                .at(sign, "missing behind this")
                .help("a line that ends so goes on in the next one"),
        );
        self.next = Some((word, self.at));
        self.at = self.items.len();
        true
    }

    /// Tells of an edge behind which no `->` follows.
    fn tell_unjoined(&mut self, of: &str, edge: &Expr) {
        let next = self.items.get(self.at);
        let (at, label) = match (&edge.kind, next) {
            (_, Some(Item::Expr(Expr { kind: ExprKind::Unread, .. }))) => return,
            (ExprKind::Binary { op, op_span, .. }, _) if *op != BinaryOp::Plus => {
                (*op_span, "write `->`")
            }
            (_, Some(Item::Comma(at) | Item::Equals(at))) => (*at, "write `->`"),
            (_, Some(item)) => match sign(item) {
                Some(word) if JOINING.contains(&word) => (item.span(), "write `->`"),
                Some(word) if self.pattern.clause(word).is_some() => {
                    (item.span(), "missing before this")
                }
                _ => (item.span(), "`->` is missing before this"),
            },
            (_, None) => (self.end, "missing here"),
        };
        self.ev.tell(
            Diagnostic::new("E0208", format!("`{of}` wants `->` and another edge"))
                .at(at, label)
                .help(self.word.usage()),
        );
    }

    fn clause(&mut self, clause: &'static Clause, clauses: &mut Vec<Said<'t>>) -> bool {
        let span = self.items.get(self.at).map_or(self.end, Item::span);
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

    /// Whether a second statement begins here, which is told.
    fn next_statement(&mut self) -> bool {
        let Some(item) = self.items.get(self.at) else { return false };
        let Some(word) = sign(item).and_then(|word| vocabulary(self.kind).find(word, false)) else {
            return false;
        };
        self.ev.tell(two_on_a_line(item.span()));
        self.next = Some((word, self.at));
        self.at = self.items.len();
        true
    }

    /// Complains of what is no word of this phrase and goes on at the next clause.
    fn stray(&mut self, clauses: &[Said<'t>]) {
        let Some(item) = self.items.get(self.at) else { return };
        if !matches!(item, Item::Expr(Expr { kind: ExprKind::Unread, .. })) {
            let told = self.stray_told(item, clauses).help(self.word.usage());
            self.ev.tell(told);
        }
        self.at += 1;
        while self.at < self.items.len() && !self.begins_clause() {
            self.at += 1;
        }
    }

    fn stray_told(&self, item: &Item, clauses: &[Said<'t>]) -> Diagnostic {
        let span = item.span();
        let text = self.ev.snippet(span);
        let word = sign(item);
        if matches!(item, Item::Comma(_)) && self.at > 0 {
            let of = clauses.last().map_or(self.word.name, |said| said.word);
            return Diagnostic::new("E0306", format!("`{of}` takes no list here"))
                .at(span, "a point or place stands in brackets, `(x, y)`");
        }
        // A value whose word was left out: `curve (1cm, 2cm)` for `curve to (1cm, 2cm)`.
        let near = word.and_then(|word| spelling::nearest(word, self.pattern.words()));
        let missing = self.missing(clauses).into_iter().next();
        if let (None, Some(names)) = (near, missing.filter(|_| clauses.is_empty())) {
            return Diagnostic::new("E0208", format!("`{}` must be given {names}", self.word.name))
                .at(span, "missing before this");
        }
        let message = match word {
            Some(_) => format!("`{text}` is not a word of `{}`", self.word.name),
            None => format!("`{}` does not know what to do with `{text}`", self.word.name),
        };
        Diagnostic::new("E0203", message)
            .at(span, self.ev.meant(text, self.pattern.words().into_iter()))
    }

    /// The groups of which one clause must be said and none was, as `` `depth` or `to` ``.
    fn missing(&self, clauses: &[Said<'t>]) -> Vec<String> {
        let mut found = Vec::new();
        for (group, _) in self.pattern.groups.iter().enumerate().filter(|(_, must)| **must) {
            let members: Vec<&Clause> =
                self.pattern.clauses.iter().filter(|clause| clause.group == group).collect();
            if !clauses.iter().any(|said| members.iter().any(|clause| clause.word == said.word)) {
                let names: Vec<String> =
                    members.iter().map(|clause| format!("`{}`", clause.word)).collect();
                found.push(either(&names));
            }
        }
        found
    }
}

impl<'t> Evaluator<'t> {
    /// Matches a line of a block of that kind against the pattern of its word; what does not
    /// match is told.
    pub(super) fn match_phrase(
        &mut self,
        kind: Kind,
        word: &'static Word,
        written: Written<'t>,
    ) -> Matched<'t> {
        let pattern = word.read();
        let first = written.label.unwrap_or(written.key).span;
        let span = written.items.last().map_or(first, |item| first.to(item.span()));
        let end = Span { start: span.end.saturating_sub(1).max(span.start), ..span };
        let items = written.items;
        let mut reader = Reader { ev: self, kind, word, pattern, items, at: 0, end, next: None };
        let mut head = Vec::new();
        let mut rest: &'t [Item] = &[];
        let mut good = reader.elements(&written.key.text, &pattern.head, &mut head, &mut rest);
        let mut clauses = Vec::new();
        while reader.at < reader.items.len() {
            let clause = reader.next_sign().and_then(|sign| pattern.clause(sign));
            match clause {
                Some(clause) => good &= reader.clause(clause, &mut clauses),
                None if reader.at > 0 && reader.next_statement() => {}
                None if good => {
                    reader.stray(&clauses);
                    good = false;
                }
                // After a first complaint only known words are read on.
                None => reader.at += 1,
            }
        }
        if good {
            for names in reader.missing(&clauses) {
                reader.ev.tell(
                    Diagnostic::new("E0208", format!("`{}` must be given {names}", word.name))
                        .at(span, "missing here")
                        .help(word.usage()),
                );
                good = false;
            }
        }
        let next = reader.next;
        let (block, behind) =
            if next.is_some() { (None, written.block) } else { (written.block, None) };
        good &= self.block_fits(word, block, span);
        let phrase = good.then_some(Phrase {
            word,
            key: written.key,
            label: written.label,
            span,
            scope: written.scope,
            head,
            clauses,
            rest,
            block,
            drawing: written.drawing,
            item: None,
        });
        let next = next.and_then(|(word, at)| {
            let Some(Item::Expr(first)) = items.get(at) else { return None };
            let (key, items) = (bare(first)?, items.get(at + 1..)?);
            let scope = written.scope;
            Some((word, Written { key, label: None, items, drawing: &[], block: behind, scope }))
        });
        Matched { phrase, next }
    }

    /// Whether there is a block where the word wants one, and none where it has none.
    fn block_fits(&mut self, word: &'static Word, block: Option<&'t Block>, span: Span) -> bool {
        let told = match (block, word.block) {
            (Some(block), None) => {
                Diagnostic::new("E0202", format!("`{}` has no block", word.name))
                    .at(Span { end: block.span.start + 1, ..block.span }, "here")
            }
            // Others may copy what they are from elsewhere, and a round hole needs none.
            (None, Some(Kind::Outline | Kind::Drape | Kind::Picture)) if word.name != "hole" => {
                Diagnostic::new("E0208", format!("`{}` must be given a block", word.name))
                    .at(span, "missing behind this")
            }
            _ => return true,
        };
        self.tell(told.help(word.usage()));
        false
    }
}
