//! Files of other programs that a text names (`wif`, `knitscape`), read together with the text.

use super::Evaluator;
use super::fields::Phrase;
use crate::diagnostic::{Diagnostic, FileId, Span};
use crate::syntax::tree::{Expr, ExprKind, File, Item, Statement, StatementKind};
use crate::world::{World, path::beside};
use std::collections::BTreeMap;
use std::sync::Arc;

/// The words that name such files.
pub(crate) const NAMING: [&str; 2] = ["wif", "knitscape"];

/// Files by the places where their paths are written.
pub(super) type Drafts = BTreeMap<Span, (FileId, Arc<str>)>;

/// Reads the files that a text names so; what cannot be read is told.
pub(super) fn drafts(
    world: &mut dyn World,
    path: &str,
    tree: &File,
    told: &mut Vec<Diagnostic>,
) -> Drafts {
    let mut found = Drafts::new();
    let mut texts: BTreeMap<FileId, Arc<str>> = BTreeMap::new();
    let mut waiting: Vec<&Statement> = tree.statements.iter().collect();
    while let Some(statement) = waiting.pop() {
        let blocks = match &statement.kind {
            StatementKind::Line { word, phrase, block } => {
                let named = NAMING.contains(&word.text.as_str()).then_some(phrase.as_slice());
                if let Some([Item::Expr(Expr { span, kind: ExprKind::Text(named) })]) = named {
                    match beside(path, named).and_then(|wanted| world.open(&wanted)) {
                        Ok(id) => {
                            let text = texts.entry(id).or_insert_with(|| world.text(id).into());
                            found.insert(*span, (id, text.clone()));
                        }
                        Err(why) => told.push(Diagnostic::new("E0903", why).at(*span, "here")),
                    }
                }
                [block.as_ref(), None]
            }
            StatementKind::Property { block, .. } => [block.as_ref(), None],
            StatementKind::For { body, .. } => [Some(body), None],
            StatementKind::If { then, otherwise, .. } => [Some(then), otherwise.as_ref()],
            _ => [None, None],
        };
        waiting.extend(blocks.into_iter().flatten().flat_map(|block| &block.statements));
    }
    found
}

impl<'t> Evaluator<'t> {
    /// The file that a phrase of [`NAMING`] names, and its text; told where it names none. That a
    /// file cannot be read is told already.
    pub(super) fn file_of(&mut self, phrase: &Phrase<'t>) -> Option<(FileId, &'t str)> {
        let path = phrase.arg(0)?.expr;
        let found = self.named_file(path.span);
        if found.is_none() && !matches!(path.kind, ExprKind::Text(_) | ExprKind::Unread) {
            let word = phrase.word.name;
            let told = Diagnostic::new("E0304", format!("`{word}` wants the path of a file"))
                .at(path.span, "not a text in quotation marks");
            self.tell(told.help(phrase.word.help));
        }
        found
    }

    /// The file of another program whose path stands there, and its text.
    fn named_file(&self, at: Span) -> Option<(FileId, &'t str)> {
        let file = self.files.iter().find(|file| file.id == at.file)?;
        file.drafts.get(&at).map(|(id, text)| (*id, &**text))
    }
}
