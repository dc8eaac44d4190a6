//! Files of other programs that a text names (`wif`, `knitscape`, `image`), read together with the text.

use super::Evaluator;
use super::fields::Phrase;
use crate::diagnostic::{Diagnostic, FileId, Span};
use crate::syntax::tree::{Expr, ExprKind, File, Item, Statement, StatementKind};
use crate::world::{World, path::beside};
use std::collections::BTreeMap;
use std::sync::Arc;

/// The words that name such files.
pub(crate) const NAMING: [&str; 3] = ["wif", "knitscape", "image"];

/// Files by the places where their paths are written.
#[derive(Debug, Default)]
pub(super) struct Drafts {
    texts: BTreeMap<Span, (FileId, Arc<str>)>,
    pictures: BTreeMap<Span, Arc<[u8]>>,
}

/// Reads the files that a text names so; what cannot be read is told.
pub(super) fn drafts(
    world: &mut dyn World,
    path: &str,
    tree: &File,
    told: &mut Vec<Diagnostic>,
) -> Drafts {
    let mut found = Drafts::default();
    let mut texts: BTreeMap<FileId, Arc<str>> = BTreeMap::new();
    let mut pictures: BTreeMap<String, Arc<[u8]>> = BTreeMap::new();
    let mut waiting: Vec<&Statement> = tree.statements.iter().collect();
    while let Some(statement) = waiting.pop() {
        let blocks = match &statement.kind {
            StatementKind::Line { word, phrase, block } => {
                let named = NAMING.contains(&word.text.as_str()).then_some(phrase.as_slice());
                if let Some([Item::Expr(Expr { span, kind: ExprKind::Text(named) })]) = named {
                    let read = match beside(path, named) {
                        Ok(wanted) if word.text == "image" => match pictures.get(&wanted) {
                            Some(known) => Ok(known.clone()),
                            None => world.bytes(&wanted).map(Arc::from),
                        }
                        .map(|bytes: Arc<[u8]>| {
                            pictures.insert(wanted, bytes.clone());
                            found.pictures.insert(*span, bytes);
                        }),
                        Ok(wanted) => world.open(&wanted).map(|id| {
                            let text = texts.entry(id).or_insert_with(|| world.text(id).into());
                            found.texts.insert(*span, (id, text.clone()));
                        }),
                        Err(why) => Err(why),
                    };
                    if let Err(why) = read {
                        told.push(Diagnostic::new("E0903", why).at(*span, "here"));
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
    /// The text file that a phrase of [`NAMING`] names; told where it names none. That a file
    /// cannot be read is told already.
    pub(super) fn file_of(&mut self, phrase: &Phrase<'t>) -> Option<(FileId, &'t str)> {
        let at = self.path_of(phrase)?;
        let file = self.files.iter().find(|file| file.id == at.file)?;
        file.drafts.texts.get(&at).map(|(id, text)| (*id, &**text))
    }

    /// The picture that such a phrase names.
    pub(super) fn picture_of(&mut self, phrase: &Phrase<'t>) -> Option<Arc<[u8]>> {
        let at = self.path_of(phrase)?;
        let file = self.files.iter().find(|file| file.id == at.file)?;
        file.drafts.pictures.get(&at).cloned()
    }

    /// Where the path of a phrase stands.
    fn path_of(&mut self, phrase: &Phrase<'t>) -> Option<Span> {
        let path = phrase.arg(0)?.expr;
        match path.kind {
            ExprKind::Text(_) => Some(path.span),
            ExprKind::Unread => None,
            _ => {
                let word = phrase.word.name;
                let told = Diagnostic::new("E0304", format!("`{word}` wants the path of a file"))
                    .at(path.span, "not a text in quotation marks");
                self.tell(told.help(phrase.word.help));
                None
            }
        }
    }
}
