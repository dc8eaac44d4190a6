//! A new name for a thing, in all files that name it. What would be wrong afterwards is found by
//! working the changed texts out before anything is changed.

use super::study::{Job, Study};
use crate::diagnostic::{Diagnostic, FileId, Span, Texts};
use crate::syntax::tree::StatementKind;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// Edits by the path of the file: place and new name.
pub type Edits = BTreeMap<String, BTreeSet<(u32, u32)>>;

/// Whether a text can be a name.
///
/// # Errors
/// Why not.
pub fn is_name(name: &str) -> Result<(), String> {
    let text = format!("let {name} = 1");
    let (tree, told) = crate::syntax::parse(FileId(0), &text);
    let one = match tree.statements.as_slice() {
        [statement] => matches!(&statement.kind, StatementKind::Let { name: read, value }
            if read.span.end - read.span.start == u32::try_from(name.len()).unwrap_or(0)
                && value.span.end as usize == text.len()),
        _ => false,
    };
    match told.first() {
        Some(told) => Err(told.message.clone()),
        None if one => Ok(()),
        None => Err(format!("`{name}` is no name")),
    }
}

/// The places of a study at which a name is written, by the paths of their files. Under another
/// name, as `as` gives it, a thing keeps that.
///
/// # Errors
/// Why it cannot be given another name.
pub fn edits(study: &Study, places: &BTreeSet<Span>, name: &str) -> Result<Edits, String> {
    let mut edits = Edits::new();
    for span in places {
        let written =
            study.desk.text(span.file).get(span.start as usize..span.end as usize).unwrap_or("");
        let path = study.desk.path(span.file);
        let declares = study.definitions(*span).next().is_some();
        if path.starts_with("std::") {
            if declares {
                return Err(format!("`{name}` belongs to the library"));
            }
            continue;
        }
        if written == name {
            edits.entry(path.to_owned()).or_default().insert((span.start, span.end));
        } else if declares && study.definitions(*span).any(|d| d.name == name) {
            return Err(format!("`{name}` gets its name from a word of the language"));
        }
    }
    Ok(edits)
}

/// The text with a new name at some places.
pub fn renamed(text: &str, places: &BTreeSet<(u32, u32)>, new: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut at = 0;
    for &(start, end) in places {
        let (start, end) = (start as usize, end as usize);
        if start < at {
            continue;
        }
        out.push_str(text.get(at..start).unwrap_or(""));
        out.push_str(new);
        at = end;
    }
    out.push_str(text.get(at..).unwrap_or(""));
    out
}

/// Works a document out as it would be afterwards.
///
/// # Errors
/// The first message that is there afterwards and not before.
pub fn try_out(before: &Study, edits: &Edits, new: &str) -> Result<(), String> {
    let mut open: BTreeMap<String, Arc<str>> = (*before.job.open).clone();
    for (_, path, text) in before.desk.files() {
        if let Some(places) = edits.get(path) {
            open.insert(path.to_owned(), Arc::from(renamed(text, places, new)));
        }
    }
    let job = Job { open: Arc::new(open), ..before.job.clone() };
    let after = Study::of(job).ok_or_else(|| "the document cannot be read".to_owned())?;
    let count = |told: &[Diagnostic]| {
        let mut counts: BTreeMap<String, usize> = BTreeMap::new();
        for told in told {
            *counts.entry(told.code.clone()).or_default() += 1;
        }
        counts
    };
    let (old, now) = (count(&before.told), count(&after.told));
    let worse = now.iter().find(|(code, n)| old.get(*code).is_none_or(|before| before < n));
    match worse {
        None => Ok(()),
        Some((code, _)) => {
            let told = after.told.iter().find(|told| {
                told.code == *code && !before.told.iter().any(|old| old.message == told.message)
            });
            let told = told.or_else(|| after.told.iter().find(|told| told.code == *code));
            let said = told.map_or("", |told| told.message.as_str());
            Err(format!("under this name it would not work: {said}"))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_told_from_what_is_none() {
        for good in ["a", "front_side", "काठ", "düğme"] {
            assert_eq!(is_name(good), Ok(()), "{good}");
        }
        for bad in ["", "1a", "a b", "let", "if", "a = 2; let b", "a.b", "a\n", "-", " a"] {
            assert!(is_name(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn several_places_are_renamed_at_once() {
        let places = BTreeSet::from([(0, 1), (4, 5)]);
        assert_eq!(renamed("a + a + b", &places, "cd"), "cd + cd + b");
    }
}
