//! Weaving files that a text names with `wif`, read together with the text.

use super::Evaluator;
use crate::diagnostic::{Diagnostic, FileId, Span};
use crate::syntax::tree::{Expr, ExprKind, File, Item, Statement, StatementKind};
use crate::world::{World, path::beside};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Weaving files by the places where their paths are written.
pub(super) type Drafts = BTreeMap<Span, (FileId, Arc<str>)>;

/// Reads the weaving files of a text; what cannot be read is told.
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
                if let ("wif", [Item::Expr(Expr { span, kind: ExprKind::Text(named) })]) =
                    (word.text.as_str(), phrase.as_slice())
                {
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
    /// The weaving file whose path stands there, and its text.
    pub(super) fn weaving_file(&self, at: Span) -> Option<(FileId, &'t str)> {
        let file = self.files.iter().find(|file| file.id == at.file)?;
        file.drafts.get(&at).map(|(id, text)| (*id, &**text))
    }
}
