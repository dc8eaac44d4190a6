//! The only door to pest.

use pest::Parser;
use pest::error::InputLocation;
use pest::iterators::Pair;
use std::num::NonZeroUsize;
use std::sync::{Mutex, PoisonError};

#[derive(pest_derive::Parser)]
#[grammar = "../grammar/garment.pest"]
struct Garment;

/// A stretch of text that matched a rule.
pub(super) type Part<'t> = Pair<'t, Rule>;

/// Why and where reading stopped.
pub(super) struct Stop {
    /// The furthest byte that was looked at in vain.
    pub at: usize,
}

/// Calls of the generated parser that one byte of text may cost. Sound text needs about 60, the
/// worst damaged text seen 200.
const CALLS_PER_BYTE: usize = 1_000;

/// pest's limit of calls is one for the whole process and is taken over when a parse begins, so
/// parses take turns.
static TURN: Mutex<()> = Mutex::new(());

/// Matches all of `text` against `rule`.
pub(super) fn read(rule: Rule, text: &str) -> Result<Part<'_>, Stop> {
    let _turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
    pest::set_call_limit(NonZeroUsize::new((text.len() + 100).saturating_mul(CALLS_PER_BYTE)));
    match Garment::parse(rule, text) {
        Ok(mut parts) => parts.next().ok_or(Stop { at: 0 }),
        Err(error) => {
            let at = match error.location {
                InputLocation::Pos(at) | InputLocation::Span((at, _)) => at,
            };
            Err(Stop { at })
        }
    }
}
