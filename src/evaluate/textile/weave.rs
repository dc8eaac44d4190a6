//! Weaves: by name, by matrix, by draft.

use super::chart::{self, Keys};
use super::{compound, draft};
use crate::diagnostic::{Diagnostic, Span};
use crate::evaluate::Evaluator;
use crate::evaluate::fields::{Arg, Fields, Phrase, bare};
use crate::evaluate::item::ItemId;
use crate::syntax::tree::{BinaryOp, Expr, ExprKind, Item};
use crate::textile::drawdown::{Cloth, Drawdown};
use crate::textile::objection::falls_apart;
use crate::textile::twill;
use crate::textile::weave::{Weave, WeaveError};
use crate::textile::yarn::Twist;

/// The words that say what a weave is; a weave has one of them.
const WAYS: [&str; 16] = [
    "plain",
    "basket",
    "rib",
    "twill",
    "herringbone",
    "point",
    "broken",
    "satin",
    "sateen",
    "honeycomb",
    "matrix",
    "threading",
    "wif",
    "upper",
    "profile",
    "figure",
];

/// Crossings of a repeat that count as one step of evaluation.
const CROSSINGS: usize = 16;

/// A weave.
pub(in crate::evaluate) fn weave(ev: &mut Evaluator<'_>, id: ItemId) -> Option<Weave> {
    let fields = ev.open_item(id)?;
    let ways: Vec<&Phrase<'_>> =
        fields.phrases.iter().filter(|phrase| WAYS.contains(&phrase.word.name)).collect();
    let way = match ways.as_slice() {
        // What cannot be read was meant to say it.
        [] if !fields.spoiled.is_empty() => return None,
        [] => {
            ev.tell(
                Diagnostic::new("E0208", format!("{} must say how it is woven", fields.title))
                    .at(fields.span, "missing here")
                    .help("`plain`, `basket 2`, `twill 2/2 Z`, `satin 8 move 3`, `matrix:` or `threading:`"),
            );
            return None;
        }
        [way] => *way,
        [first, second, ..] => {
            ev.tell(
                Diagnostic::new("E0209", format!("{} is woven in two ways", fields.title))
                    .at(second.span, "here")
                    .at(first.span, "and here")
                    .help("keep one"),
            );
            return None;
        }
    };
    let made = made(ev, &fields, way)?;
    let name = ev.item(id).name.clone();
    let weave = match made {
        Ok(weave) => weave.named(name),
        Err(error) => {
            tell(ev, &error, way.span);
            return None;
        }
    };
    // A large repeat is worked out in no time; many of them would fill the memory.
    if !ev.step((weave.ends() * weave.picks() / CROSSINGS) as u64, way.span) {
        return None;
    }
    // Two cloths are two unless they are stitched.
    let meant = way.word.name == "upper" && fields.get("stitch").is_none();
    let apart = if meant { None } else { falls_apart(&Cloth::new(Drawdown::of_weave(&weave))) };
    if let Some((_, why, help)) = apart {
        let message = format!("`{}`: {why}", weave.name);
        ev.tell(Diagnostic::new("W0603", message).at(way.span, "here").help(help));
    }
    Some(weave)
}

fn made<'t>(
    ev: &mut Evaluator<'t>,
    fields: &Fields<'t>,
    way: &Phrase<'t>,
) -> Option<Result<Weave, WeaveError>> {
    Some(match way.word.name {
        "plain" => Ok(Weave::plain()),
        "basket" => Weave::basket(threads(ev, way)?),
        "rib" => {
            let count = threads(ev, way)?;
            if way.says("weft") { Weave::weft_rib(count) } else { Weave::warp_rib(count) }
        }
        "satin" | "sateen" => {
            let count = threads(ev, way)?;
            let step = small(ev, way.value("move")?, 0)?;
            if way.word.name == "satin" {
                Weave::satin(count, step)
            } else {
                Weave::sateen(count, step)
            }
        }
        "twill" | "herringbone" | "point" | "broken" => {
            let said = twill(ev, way)?;
            let made = Weave::twill(&said.runs, said.slant, said.step);
            made.and_then(|made| match (way.word.name, said.every) {
                ("herringbone", every) => twill::herringbone(&made, every.unwrap_or(8)),
                ("point", every) => twill::pointed(&made, every.unwrap_or(made.ends() as u32)),
                ("broken", _) => twill::broken(&made),
                _ => Ok(made),
            })
        }
        "matrix" => {
            let keys = Keys::new(&[("1", true), ("#", true), ("0", false), (".", false)]);
            let known = "`1` or `#`: the warp lies on top; `0` or `.`: the weft does";
            let mut rows = chart::cells(ev, way, &keys, known)?;
            if downwards(fields) {
                rows.reverse();
            }
            Weave::matrix(rows)
        }
        "wif" => draft::of_file(ev, way)?,
        "honeycomb" => Weave::honeycomb(threads(ev, way)?),
        "upper" => compound::double(ev, fields, way)?,
        "profile" => compound::profile(ev, fields, way)?,
        "figure" => compound::figure(ev, fields, way)?,
        _ => {
            let mut rows = draft::drawdown(ev, fields, way)?;
            if downwards(fields) {
                rows.reverse();
            }
            Weave::matrix(rows)
        }
    })
}

pub(super) fn downwards(fields: &Fields<'_>) -> bool {
    fields.get("rows").and_then(|phrase| phrase.choice(0)) == Some("downwards")
}

/// A number of threads.
fn threads<'t>(ev: &mut Evaluator<'t>, way: &Phrase<'t>) -> Option<u32> {
    small(ev, way.arg(0)?, 1)
}

pub(super) fn small<'t>(ev: &mut Evaluator<'t>, arg: Arg<'t>, least: i64) -> Option<u32> {
    let most = i64::try_from(Weave::LARGEST_REPEAT).unwrap_or(i64::MAX);
    u32::try_from(ev.whole_number(arg, least, most)?).ok()
}

/// What is said of a twill.
struct Said {
    runs: Vec<u32>,
    slant: Twist,
    step: u32,
    /// Ends after which it turns.
    every: Option<u32>,
}

/// `2/2 Z`, `2/1/1/2 S move 1`, `2/2 every 8`
fn twill<'t>(ev: &mut Evaluator<'t>, way: &Phrase<'t>) -> Option<Said> {
    let of = way.word.name;
    let turns = matches!(of, "herringbone" | "point");
    let words = if turns { &["Z", "S", "move", "every"][..] } else { &["Z", "S", "move"] };
    let usage = usage(of);
    let mut items = way.rest.iter();
    let Some(Item::Expr(runs)) = items.next() else {
        ev.tell(
            Diagnostic::new("E0208", format!("`{of}` must be given its runs"))
                .at(way.span, "missing here")
                .help(usage),
        );
        return None;
    };
    let mut said = Said { runs: Vec::new(), slant: Twist::Z, step: 1, every: None };
    let mut parts = Vec::new();
    quotients(runs, &mut parts);
    for expr in parts {
        said.runs.push(small(ev, Arg { expr, scope: way.scope, of }, 1)?);
    }
    while let Some(item) = items.next() {
        let word = match item {
            Item::Expr(expr) => bare(expr).map(|name| name.text.as_str()),
            _ => None,
        };
        match word.and_then(|word| words.iter().find(|known| **known == word)) {
            Some(&"Z") => said.slant = Twist::Z,
            Some(&"S") => said.slant = Twist::S,
            Some(&word) => match items.next() {
                Some(Item::Expr(expr)) if word == "move" => {
                    said.step = small(ev, Arg { expr, scope: way.scope, of: word }, 1)?;
                }
                Some(Item::Expr(expr)) => {
                    said.every = Some(small(ev, Arg { expr, scope: way.scope, of: word }, 2)?);
                }
                _ => {
                    ev.tell(
                        Diagnostic::new("E0208", format!("`{word}` must be given a number"))
                            .at(way.span, "missing here")
                            .help(usage),
                    );
                    return None;
                }
            },
            None => {
                if let Item::Expr(Expr { kind: ExprKind::Unread, .. }) = item {
                    return None;
                }
                let span = span_of(item);
                let text = ev.snippet(span).to_owned();
                let label = ev.meant(&text, words.iter().copied());
                ev.tell(
                    Diagnostic::new("E0203", format!("`{text}` is not a word of `{of}`"))
                        .at(span, label)
                        .help(usage),
                );
                return None;
            }
        }
    }
    Some(said)
}

/// How a twill is written.
const USAGE: &str = "twill UP/DOWN[/UP/DOWN …] [Z|S] [move NUMBER], such as `twill 2/2 Z`";

/// How a twill of that word is written.
fn usage(word: &str) -> &'static str {
    match word {
        "herringbone" => {
            "herringbone UP/DOWN[/UP/DOWN …] [every NUMBER], such as `herringbone 2/2 every 8`"
        }
        "point" => "point UP/DOWN[/UP/DOWN …] [every NUMBER], such as `point 2/2`",
        "broken" => "broken UP/DOWN[/UP/DOWN …], such as `broken 3/1`",
        _ => USAGE,
    }
}

/// The numbers of `a/b/c`, which the reader of values takes for divisions.
pub(super) fn quotients<'t>(expr: &'t Expr, out: &mut Vec<&'t Expr>) {
    match &expr.kind {
        ExprKind::Binary { op: BinaryOp::Over, left, right, .. } => {
            quotients(left, out);
            out.push(right);
        }
        _ => out.push(expr),
    }
}

pub(super) fn span_of(item: &Item) -> Span {
    match item {
        Item::Comma(span) | Item::Arrow(span) | Item::Equals(span) => *span,
        Item::Expr(expr) => expr.span,
    }
}

fn tell(ev: &mut Evaluator<'_>, error: &WeaveError, at: Span) {
    let told = match error {
        WeaveError::NoSatin { repeat, step, moves } => {
            let told = Diagnostic::new("E0604", error.to_string());
            let shared = shared_factor(*repeat, *step);
            let told = match shared {
                _ if moves.is_empty() => told.at(at, format!("{repeat} has no satin at all")),
                1 => told.at(at, "its binding points would touch"),
                factor => told.at(
                    at,
                    format!(
                        "{step} and {repeat} share the factor {factor}: only {} of the {repeat} \
                         ends would be bound",
                        repeat / factor
                    ),
                ),
            };
            let moves: Vec<String> = moves.iter().map(u32::to_string).collect();
            match moves.as_slice() {
                [] => told.help("satins have 5, 7, 8 or more ends"),
                [only] => told.help(format!("the move of a satin of {repeat} is {only}")),
                [most @ .., last] => told.help(format!(
                    "the moves of a satin of {repeat} are {} and {last}",
                    most.join(", ")
                )),
            }
        }
        WeaveError::Ragged { .. } => Diagnostic::new("E0601", error.to_string()).at(at, "here"),
        WeaveError::Runs => Diagnostic::new("E0306", error.to_string()).at(at, "here").help(USAGE),
        WeaveError::Standstill { .. } => {
            Diagnostic::new("E0303", error.to_string()).at(at, "here").help("the usual move is 1")
        }
        WeaveError::Honeycomb => {
            Diagnostic::new("E0303", error.to_string()).at(at, "here").help("such as `honeycomb 8`")
        }
        WeaveError::Empty | WeaveError::TooLarge => {
            Diagnostic::new("E0303", error.to_string()).at(at, "here")
        }
    };
    ev.tell(told);
}

fn shared_factor(a: u32, b: u32) -> u32 {
    let (mut a, mut b) = (a, b);
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a.max(1)
}
