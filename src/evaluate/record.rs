//! Records: values with names, `{ width: 12cm, depth: 3cm }`.

use super::Evaluator;
use super::scope::ScopeId;
use super::value::Value;
use super::words::{Kind, vocabulary};
use crate::diagnostic::{Diagnostic, Span};
use crate::syntax::tree::{Block, Expr, ExprKind, Field, Item, Name, Statement, StatementKind};
use std::collections::BTreeMap;

impl<'t> Evaluator<'t> {
    /// A record: names of its own, each once.
    pub(super) fn record(&mut self, fields: &'t [Field], scope: ScopeId) -> Value {
        let mut found: Vec<(String, Value)> = Vec::with_capacity(fields.len());
        let mut first: BTreeMap<&str, Span> = BTreeMap::new();
        for Field { name, value } in fields {
            let value = self.eval(value, scope);
            if let Some(&before) = first.get(name.text.as_str()) {
                self.tell(
                    Diagnostic::new(
                        "E0209",
                        format!("`{}` stands twice in this record", name.text),
                    )
                    .at(name.span, "and here")
                    .at(before, "here")
                    .help("a name has one value"),
                );
                continue;
            }
            first.insert(&name.text, name.span);
            found.push((name.text.clone(), value));
        }
        Value::Record(found.into())
    }

    /// `record.name`
    pub(super) fn field(&mut self, fields: &[(String, Value)], name: &Name) -> Value {
        match fields.iter().find(|(own, _)| *own == name.text) {
            Some((_, value)) => value.clone(),
            None => {
                let known = fields.iter().map(|(own, _)| own.as_str());
                self.no_member("this record", name, known)
            }
        }
    }
}

/// Where a parameter of a block or of a copied panel is set, what the grammar takes for a block
/// is a record: `part cuffs = cuff { size: { width: 12cm, depth: 3cm } }`.
pub(super) fn read_settings(statements: &mut [Statement]) {
    for statement in statements {
        match &mut statement.kind {
            StatementKind::For { body, .. } => read_settings(&mut body.statements),
            StatementKind::If { then, otherwise, .. } => {
                read_settings(&mut then.statements);
                otherwise.iter_mut().for_each(|block| read_settings(&mut block.statements));
            }
            StatementKind::Line { word, block: Some(block), .. } => {
                let kind = match word.text.as_str() {
                    "part" => Some(Kind::Part),
                    "panel" => Some(Kind::Panel),
                    _ => None,
                };
                if let Some(kind) = kind {
                    block.statements.iter_mut().for_each(|setting| read_setting(kind, setting));
                }
                read_settings(&mut block.statements);
            }
            _ => {}
        }
    }
}

/// Reads a block behind a key that is no word of the table.
fn read_setting(kind: Kind, statement: &mut Statement) {
    let StatementKind::Property { key, phrase, drawing, block } = &mut statement.kind else {
        return;
    };
    if !phrase.is_empty() || !drawing.is_empty() || vocabulary(kind).find(&key.text, true).is_some()
    {
        return;
    }
    if let Some(record) = block.as_ref().and_then(as_record) {
        phrase.push(Item::Expr(record));
        *block = None;
    }
}

/// The record that a block looks like: values behind names, with commas between.
fn as_record(block: &Block) -> Option<Expr> {
    let last = block.statements.len().checked_sub(1)?;
    let mut fields = Vec::with_capacity(block.statements.len());
    for (number, statement) in block.statements.iter().enumerate() {
        let StatementKind::Property { key, phrase, drawing, block } = &statement.kind else {
            return None;
        };
        let value = match (phrase.as_slice(), block) {
            _ if !drawing.is_empty() => return None,
            ([Item::Expr(value)], None) if number == last => value.clone(),
            ([Item::Expr(value), Item::Comma(_)], None) if number < last => value.clone(),
            ([], Some(block)) if number == last => as_record(block)?,
            _ => return None,
        };
        fields.push(Field { name: key.clone(), value });
    }
    Some(Expr { span: block.span, kind: ExprKind::Record(fields) })
}
