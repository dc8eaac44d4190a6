//! What a text means, apart from how it is laid out.

use darzi::diagnostic::{Diagnostic, FileId};
use darzi::syntax::parse;
use serde_json::Value;

/// The tree of a text without its places; none where it has mistakes in its shape.
pub fn meaning(text: &str) -> Option<Value> {
    let (tree, told) = parse(FileId(0), text);
    if told.iter().any(Diagnostic::is_error) {
        return None;
    }
    let mut tree = serde_json::to_value(tree).unwrap();
    forget_places(&mut tree);
    Some(tree)
}

fn forget_places(value: &mut Value) {
    match value {
        Value::Object(fields)
            if ["file", "start", "end"].iter().all(|f| fields.contains_key(*f)) =>
        {
            *value = Value::Null;
        }
        Value::Object(fields) => fields.values_mut().for_each(forget_places),
        Value::Array(values) => values.iter_mut().for_each(forget_places),
        _ => {}
    }
}
