//! The only door to pest.

use pest::Parser;
use pest::error::{ErrorVariant, InputLocation};
use pest::iterators::Pair;
use std::num::NonZeroUsize;
use std::sync::{Mutex, PoisonError};

#[derive(pest_derive::Parser)]
#[grammar = "../grammar/garment.pest"]
struct Garment;

/// A stretch of text that matched a rule.
pub(super) type Part<'t> = Pair<'t, Rule>;

/// Where and why reading stopped.
pub(super) struct Stop {
    /// The furthest byte that was looked at in vain.
    pub at: usize,
    /// Whether the work that a text of this length may cost was used up.
    pub tired: bool,
}

/// Calls of the generated parser that one byte of text may cost. Sound text needs up to 20.
const CALLS_PER_BYTE: usize = 40;

/// Calls that any text may cost besides; damaged text needs up to 150 a byte.
const CALLS: usize = 10_000_000;

/// pest's limit of calls is one for the whole process and is taken over when a parse begins, so
/// parses take turns.
static TURN: Mutex<()> = Mutex::new(());

/// Matches all of `text` against `rule`.
pub(super) fn read(rule: Rule, text: &str) -> Result<Part<'_>, Stop> {
    let _turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
    pest::set_call_limit(NonZeroUsize::new(
        text.len().saturating_mul(CALLS_PER_BYTE).saturating_add(CALLS),
    ));
    match Garment::parse(rule, text) {
        Ok(mut parts) => parts.next().ok_or(Stop { at: 0, tired: false }),
        Err(error) => {
            let at = match error.location {
                InputLocation::Pos(at) | InputLocation::Span((at, _)) => at,
            };
            let tired = match error.variant {
                ErrorVariant::CustomError { message } => message == "call limit reached",
                ErrorVariant::ParsingError { .. } => false,
            };
            Err(Stop { at, tired })
        }
    }
}
