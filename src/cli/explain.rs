//! `darzi explain`: what a code means, and how a word of the language is written.

use super::{Stop, say};
use crate::diagnostic::codes::CODES;
use crate::diagnostic::page::page;
use crate::diagnostic::spelling::nearest;
use crate::evaluate::functions;
use crate::evaluate::words::tables;

#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  darzi explain E0501                              what it means, a wrong text and a right one
  darzi explain dart                               how a word is written, and in which blocks
  darzi explain                                    all codes")]
pub(super) struct Explain {
    /// The code of a message, such as E0501, or a word of the language; all codes are listed where
    /// neither is given
    what: Option<String>,
}

impl Explain {
    pub(super) fn run(self) -> Result<(), Stop> {
        let Some(asked) = self.what else {
            let lines: String =
                CODES.iter().map(|c| format!("{}  {}\n", c.code, c.title)).collect();
            return say(&lines);
        };
        let code = asked.to_uppercase();
        if let Some(page) = page(&code) {
            return say(&page.shown());
        }
        if let Some(shown) = word(&asked) {
            return say(&shown);
        }
        let codes = CODES.iter().map(|known| known.code);
        let words = tables().flat_map(|table| table.words).map(|word| word.name);
        let words = words.chain(functions().map(|(name, _)| name));
        let hint = nearest(&code, codes)
            .or_else(|| nearest(&asked, words))
            .map_or(String::new(), |near| format!("did you mean {near}? "));
        Err(Stop::Call(format!(
            "there is no code and no word `{asked}`; {hint}`darzi explain` lists all codes"
        )))
    }
}

/// How a word is written, what it does, and where it may stand; none if the language has no such
/// word.
fn word(name: &str) -> Option<String> {
    let mut rows: Vec<(String, &str, Vec<&str>)> = Vec::new();
    for table in tables() {
        for word in table.words.iter().filter(|word| word.name == name) {
            let (usage, kind) = (word.usage(), table.kind.title());
            match rows.iter_mut().find(|(known, help, _)| *known == usage && *help == word.help) {
                Some((.., kinds)) => kinds.push(kind),
                None => rows.push((usage, word.help, vec![kind])),
            }
        }
    }
    let rows = rows.into_iter().map(|(usage, help, kinds)| {
        let kinds = kinds.join(", ");
        format!("{usage}\n    in {kinds}: {help}\n")
    });
    let own = functions().filter(|(own, _)| *own == name);
    let own = own.map(|(_, usage)| format!("{usage}\n    a function\n"));
    let shown: Vec<String> = rows.chain(own).collect();
    (!shown.is_empty()).then(|| shown.join("\n"))
}
