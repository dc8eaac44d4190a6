//! Which clause and which operand of a word stands at the cursor.

use super::outline::{Outline, Statement};
use super::scan::Sort;
use crate::evaluate::words::{Clause, Element, Many, Word};

/// What a phrase wants at the cursor.
#[derive(Debug)]
pub struct Wanted {
    /// The word of the table.
    pub word: &'static Word,
    /// The clause in which the cursor stands; none for the head.
    pub clause: Option<&'static Clause>,
    /// The operand that stands there or should.
    pub element: Option<&'static Element>,
    /// Clauses said before.
    pub said: Vec<&'static str>,
    /// Whether a value is open, so that no word may follow: behind an operator or in brackets.
    pub open: bool,
}

/// What the phrase of a statement wants before the token `until`.
pub fn wanted(
    outline: &Outline,
    text: &str,
    statement: &Statement,
    until: usize,
) -> Option<Wanted> {
    let word = statement.word?;
    let pattern = word.read();
    let head = statement.head?;
    // Behind `key:` stand the values of a property.
    let colon = usize::from(outline.slice(text, head + 1) == ":") * 2;
    let mut wanted = Wanted { word, clause: None, element: None, said: Vec::new(), open: false };
    let (mut depth, mut values, mut listed) = (0_usize, 0_usize, false);
    let mut before: Option<usize> = None;
    for at in (head + 1.max(colon))..until.min(statement.tokens.end) {
        let (Some(token), slice) = (outline.tokens.get(at), outline.slice(text, at)) else { break };
        if matches!(token.sort, Sort::Newline | Sort::Comment | Sort::Doc) {
            continue;
        }
        let joined = before.is_some_and(|before| {
            let last = outline.slice(text, before);
            let touches = outline.tokens.get(before).is_some_and(|b| b.end == token.start);
            matches!(last, "." | "::" | ":")
                || (outline.tokens.get(before).is_some_and(|b| b.sort == Sort::Operator)
                    && !matches!(last, "->" | "="))
                || matches!(last, "and" | "or" | "not")
                || (touches && matches!(slice, "(" | "[" | ":" | "."))
                || token.sort == Sort::Unit
        });
        match slice {
            "(" | "[" => {
                if depth == 0 && !joined && !listed {
                    values += 1;
                }
                listed = false;
                depth += 1;
            }
            ")" | "]" => depth = depth.saturating_sub(1),
            _ if depth > 0 => {}
            "," | "->" => listed = true,
            _ if token.sort == Sort::Operator && slice != "=" => {}
            _ if matches!(slice, "." | ":") => {}
            _ => {
                let clause = pattern.clause(slice).filter(|_| !joined && !listed);
                // The first operand of the head may be called like a word.
                let named = values == 0
                    && wanted.clause.is_none()
                    && matches!(
                        pattern.head.first(),
                        Some(Element::Operand { name: "NAME", required: true, .. })
                    );
                if let Some(clause) = clause.filter(|_| !named) {
                    wanted.said.push(clause.word);
                    wanted.clause = Some(clause);
                    values = 0;
                } else if !joined && !listed {
                    values += 1;
                }
                listed = false;
            }
        }
        before = Some(at);
    }
    let last = before.map_or("", |before| outline.slice(text, before));
    let sign = before
        .and_then(|before| outline.tokens.get(before))
        .is_some_and(|token| token.sort == Sort::Operator && !matches!(last, "->" | "="));
    wanted.open = depth > 0 || sign || matches!(last, "and" | "or" | "not" | "." | "::");
    let elements = wanted.clause.map_or(&pattern.head, |clause| &clause.elements);
    let going_on = wanted.open || listed;
    let place = if going_on { values.saturating_sub(1) } else { values };
    wanted.element = place_of(elements, place);
    Some(wanted)
}

/// The operand at a place; signs between operands count as values that were read.
fn place_of(elements: &'static [Element], place: usize) -> Option<&'static Element> {
    elements.get(place).or_else(|| {
        elements.last().filter(|last| {
            matches!(last, Element::Rest | Element::Operand { many: Many::Commas, .. })
        })
    })
}

/// An operand as a usage line shows it.
pub fn shown(element: &Element) -> String {
    match element {
        Element::Literal(word) => (*word).to_owned(),
        Element::Rest => "…".to_owned(),
        Element::Operand { name, choice, many, .. } => {
            let name = if choice.is_empty() { (*name).to_owned() } else { choice.join("|") };
            match many {
                Many::One => name,
                Many::Commas => format!("{name}, …"),
                Many::Arrows => format!("{name} -> …"),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::outline::read;
    use super::*;

    fn at_end(line: &str) -> String {
        let text = format!("garment g {{\n panel p of c {{\n  {line}");
        let outline = read(&text);
        let statement = outline.statements.last().unwrap();
        let wanted = wanted(&outline, &text, statement, statement.tokens.end).unwrap();
        let clause = wanted.clause.map_or("", |clause| clause.word);
        let element = wanted.element.map(shown).unwrap_or_default();
        format!("{}|{clause}|{element}|{}", wanted.word.name, wanted.open)
    }

    #[test]
    fn the_operand_at_the_cursor_is_known() {
        assert_eq!(at_end("dart on"), "dart|on|EDGE|false");
        assert_eq!(at_end("dart on waist"), "dart|on||false");
        assert_eq!(at_end("dart on waist at 50% width"), "dart|width|LENGTH|false");
        assert_eq!(at_end("dart on waist at 50% width (a + "), "dart|width|LENGTH|true");
        assert_eq!(at_end("shaping: dart on waist at 3cm +"), "dart|at|PLACE|true");
        assert_eq!(at_end("allowance:"), "allowance||LENGTH|false");
        assert_eq!(at_end("grid:"), "grid||CELLS|false");
        assert_eq!(at_end("rectangle 3cm"), "rectangle||x|false");
        assert_eq!(at_end("rectangle 3cm x"), "rectangle||LENGTH|false");
        assert_eq!(at_end("unfold across e as left,"), "unfold|as|NAME, …|false");
    }
}
