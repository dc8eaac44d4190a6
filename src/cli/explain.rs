//! `darzi explain`: what a code means.

use super::{Stop, say};
use crate::diagnostic::codes::CODES;
use crate::diagnostic::page::page;
use crate::diagnostic::spelling::nearest;

#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  darzi explain E0501                              what it means, a wrong text and a right one
  darzi explain                                    all codes")]
pub(super) struct Explain {
    /// The code of a message, such as E0501; all codes are listed where it is not given
    code: Option<String>,
}

impl Explain {
    pub(super) fn run(self) -> Result<(), Stop> {
        let Some(asked) = self.code else {
            let lines: String =
                CODES.iter().map(|c| format!("{}  {}\n", c.code, c.title)).collect();
            return say(&lines);
        };
        let code = asked.to_uppercase();
        match page(&code) {
            Some(page) => say(&page.shown()),
            None => {
                let near = nearest(&code, CODES.iter().map(|known| known.code));
                let hint = near.map_or("`darzi explain` lists all".to_owned(), |near| {
                    format!("did you mean {near}? `darzi explain` lists all")
                });
                Err(Stop::Call(format!("there is no code `{asked}`; {hint}")))
            }
        }
    }
}
