//! A document in its one layout.

use super::document::Document;
use crate::diagnostic::FileId;
use crate::syntax::format::format;
use gen_lsp_types::TextEdit;

/// The edit that lays a document out; none where it has mistakes in its shape, which are told
/// anyway. Lines at the beginning and at the end that stay are left alone.
pub fn layout(document: &Document) -> Vec<TextEdit> {
    let old = &*document.text.text;
    let Ok(new) = format(FileId(0), old) else { return Vec::new() };
    if new == old {
        return Vec::new();
    }
    let (a, b): (Vec<&str>, Vec<&str>) =
        (old.split_inclusive('\n').collect(), new.split_inclusive('\n').collect());
    let head = a.iter().zip(&b).take_while(|(a, b)| a == b).count();
    let most = a.len().min(b.len()) - head;
    let tail = a.iter().rev().zip(b.iter().rev()).take(most).take_while(|(a, b)| a == b).count();
    let bytes = |lines: &[&str]| lines.iter().map(|line| line.len()).sum::<usize>();
    let start = bytes(a.get(..head).unwrap_or(&[]));
    let end = old.len() - bytes(a.get(a.len() - tail..).unwrap_or(&[]));
    let text = b.get(head..b.len() - tail).unwrap_or(&[]).concat();
    vec![TextEdit { range: document.text.range(start, end), new_text: text }]
}
