//! Values: from the flat chain of operands and operators that the grammar gives to a tree, by
//! precedence climbing.

use super::grammar::{Part, Rule};
use super::literal::colour;
use super::nesting::{self, DEEPEST_VALUE};
use super::reader::Reader;
use super::tree::{Argument, BinaryOp, Expr, ExprKind, Field, Name, UnaryOp};
use crate::diagnostic::Span;
use std::iter::Peekable;

/// A value and the height of its tree.
struct Tall {
    expr: Expr,
    height: u32,
}

/// The rank of `not`: it takes a whole comparison.
const NOT: u8 = 3;

/// How tight an operator holds its operands.
fn rank(op: BinaryOp) -> u8 {
    match op {
        BinaryOp::Or => 1,
        BinaryOp::And => 2,
        BinaryOp::Equal
        | BinaryOp::Unequal
        | BinaryOp::Less
        | BinaryOp::Greater
        | BinaryOp::AtMost
        | BinaryOp::AtLeast => NOT,
        BinaryOp::To => 4,
        BinaryOp::Plus | BinaryOp::Minus => 5,
        BinaryOp::Times | BinaryOp::Over => 6,
        BinaryOp::At => 7,
    }
}

fn operator(text: &str) -> Option<BinaryOp> {
    Some(match text {
        "@" => BinaryOp::At,
        "*" => BinaryOp::Times,
        "/" => BinaryOp::Over,
        "+" => BinaryOp::Plus,
        "-" => BinaryOp::Minus,
        ".." => BinaryOp::To,
        "==" => BinaryOp::Equal,
        "!=" => BinaryOp::Unequal,
        "<" => BinaryOp::Less,
        ">" => BinaryOp::Greater,
        "<=" => BinaryOp::AtMost,
        ">=" => BinaryOp::AtLeast,
        "and" => BinaryOp::And,
        "or" => BinaryOp::Or,
        _ => return None,
    })
}

impl Reader<'_> {
    /// A value.
    pub(super) fn expr(&mut self, part: Part) -> Expr {
        self.tall(part).expr
    }

    fn tall(&mut self, part: Part) -> Tall {
        let span = self.span(&part);
        self.deeper(span, |reader| match part.as_rule() {
            Rule::record => reader.record(span, part),
            _ => reader.climb(&mut part.into_inner().peekable(), 0),
        })
    }

    /// `{ width: 12cm, depth: 3cm }`
    fn record(&mut self, span: Span, part: Part) -> Tall {
        let mut fields = Vec::new();
        let mut height = 0;
        for field in part.into_inner() {
            let mut inner = field.into_inner();
            if let (Some(name), Some(value)) = (inner.next(), inner.next()) {
                let name = self.name(&name);
                let value = self.tall(value);
                height = height.max(value.height);
                fields.push(Field { name, value: value.expr });
            }
        }
        self.grown(span, ExprKind::Record(fields), height)
    }

    /// Goes one level down, unless that is too deep.
    fn deeper(&mut self, span: Span, read: impl FnOnce(&mut Self) -> Tall) -> Tall {
        if self.depth >= DEEPEST_VALUE {
            self.tell(nesting::told(Span { end: span.start + 1, ..span }));
            return Tall { expr: self.unread(span), height: 0 };
        }
        self.depth += 1;
        let tall = read(self);
        self.depth -= 1;
        tall
    }

    /// Reads operands joined by operators of at least the rank `least`.
    fn climb<'t, I>(&mut self, parts: &mut Peekable<I>, least: u8) -> Tall
    where
        I: Iterator<Item = Part<'t>>,
    {
        let mut left = self.operand(parts);
        while let Some((op, op_span)) = parts.peek().and_then(|part| self.infix(part)) {
            if rank(op) < least {
                break;
            }
            parts.next();
            let right = self.climb(parts, rank(op) + 1);
            let span = left.expr.span.to(right.expr.span);
            let height = left.height.max(right.height);
            let kind = ExprKind::Binary {
                op,
                op_span,
                left: Box::new(left.expr),
                right: Box::new(right.expr),
            };
            left = self.grown(span, kind, height);
        }
        left
    }

    /// The operator in an `infix`.
    fn infix(&self, part: &Part) -> Option<(BinaryOp, Span)> {
        let op = part.clone().into_inner().find(|inner| inner.as_rule() == Rule::op)?;
        Some((operator(op.as_str())?, self.span(&op)))
    }

    /// A chain with the signs before it.
    fn operand<'t, I>(&mut self, parts: &mut Peekable<I>) -> Tall
    where
        I: Iterator<Item = Part<'t>>,
    {
        let Some(part) = parts.next() else {
            return Tall { expr: self.unread(self.end()), height: 0 };
        };
        if part.as_rule() != Rule::prefix {
            return self.chain(part);
        }
        let start = self.span(&part);
        let (op, inner) = if part.as_str().starts_with('-') {
            (UnaryOp::Minus, self.deeper(start, |reader| reader.operand(parts)))
        } else {
            (UnaryOp::Not, self.deeper(start, |reader| reader.climb(parts, NOT)))
        };
        let span = start.to(inner.expr.span);
        self.grown(span, ExprKind::Unary(op, Box::new(inner.expr)), inner.height)
    }

    /// A primary value and what hangs on it: members, calls, indices.
    fn chain(&mut self, part: Part) -> Tall {
        let whole = self.span(&part);
        let mut parts = part.into_inner();
        let Some(first) = parts.next() else {
            return Tall { expr: self.unread(whole), height: 0 };
        };
        let mut left = self.primary(first);
        for part in parts {
            let end = self.span(&part);
            let span = left.expr.span.to(end);
            let target = Box::new(left.expr);
            let rule = part.as_rule();
            let inner = part.into_inner();
            let (kind, height) = match rule {
                Rule::member => {
                    let mut inner = inner;
                    match inner.next() {
                        Some(name) => (ExprKind::Member(target, self.name(&name)), 0),
                        None => (ExprKind::Unread, 0),
                    }
                }
                Rule::within => {
                    let mut inner = inner;
                    match inner.next() {
                        Some(group) => {
                            let group = self.primary(group);
                            (ExprKind::Within(target, Box::new(group.expr)), group.height)
                        }
                        None => (ExprKind::Unread, 0),
                    }
                }
                Rule::call => {
                    let (arguments, height) = self.arguments(inner);
                    (ExprKind::Call(target, arguments), height)
                }
                _ => {
                    let (places, from, height) = self.places(inner);
                    (ExprKind::Index(target, places, from), height)
                }
            };
            left = self.grown(span, kind, left.height.max(height));
        }
        left
    }

    /// The arguments of a call.
    fn arguments<'t>(&mut self, parts: impl Iterator<Item = Part<'t>>) -> (Vec<Argument>, u32) {
        let mut arguments: Vec<Argument> = Vec::new();
        let mut height = 0;
        for part in parts {
            let mut name = None;
            for inner in part.into_inner() {
                if inner.as_rule() == Rule::name {
                    name = Some(self.name(&inner));
                } else {
                    let value = self.tall(inner);
                    height = height.max(value.height);
                    if let (Some(before), None) = (arguments.last_mut(), &name)
                        && let Some(mended) = self.decimal_comma(&before.value, &value.expr, false)
                    {
                        before.value = mended;
                        continue;
                    }
                    arguments.push(Argument { name: name.take(), value: value.expr });
                }
            }
        }
        (arguments, height)
    }

    /// What stands in the brackets of an index.
    fn places<'t>(
        &mut self,
        parts: impl Iterator<Item = Part<'t>>,
    ) -> (Vec<Expr>, Option<Name>, u32) {
        let mut places = Vec::new();
        let mut from = None;
        let mut height = 0;
        for part in parts {
            match part.as_rule() {
                Rule::expr => {
                    let place = self.tall(part);
                    height = height.max(place.height);
                    places.push(place.expr);
                }
                Rule::name => from = Some(self.name(&part)),
                _ => {}
            }
        }
        (places, from, height)
    }

    /// A number, colour, string, group, list, choice or path.
    fn primary(&mut self, part: Part) -> Tall {
        let span = self.span(&part);
        let leaf = |kind| Tall { expr: Expr { span, kind }, height: 1 };
        match part.as_rule() {
            Rule::number => leaf(self.number(part)),
            Rule::colour => leaf(colour(part.as_str().trim_start_matches('#'))),
            Rule::string => leaf(ExprKind::Text(self.string(part))),
            Rule::path => {
                let names = part.into_inner().map(|name| self.name(&name)).collect();
                leaf(ExprKind::Path(names))
            }
            rule => {
                let (mut values, height) = self.values(part);
                let kind = match (rule, values.len()) {
                    (Rule::list, _) => ExprKind::List(values),
                    (Rule::group, 1) => match values.pop() {
                        Some(value) => ExprKind::Group(Box::new(value)),
                        None => ExprKind::Unread,
                    },
                    (Rule::group, _) => ExprKind::Point(values),
                    (_, 3) => match (values.pop(), values.pop(), values.pop()) {
                        (Some(otherwise), Some(then), Some(condition)) => ExprKind::Choice {
                            condition: Box::new(condition),
                            then: Box::new(then),
                            otherwise: Box::new(otherwise),
                        },
                        _ => ExprKind::Unread,
                    },
                    _ => ExprKind::Unread,
                };
                self.grown(span, kind, height)
            }
        }
    }

    /// The values inside a bracket or a choice; a decimal comma among them is told.
    fn values(&mut self, part: Part) -> (Vec<Expr>, u32) {
        let mut values: Vec<Expr> = Vec::new();
        let mut height = 0;
        for inner in part.into_inner() {
            if !matches!(inner.as_rule(), Rule::expr | Rule::record) {
                continue;
            }
            let value = self.tall(inner);
            height = height.max(value.height);
            if let Some(before) = values.last_mut()
                && let Some(mended) = self.decimal_comma(before, &value.expr, false)
            {
                *before = mended;
                continue;
            }
            values.push(value.expr);
        }
        (values, height)
    }

    /// A node one level above its highest child, or a diagnostic where that is too high.
    fn grown(&mut self, span: Span, kind: ExprKind, height: u32) -> Tall {
        if height < DEEPEST_VALUE {
            return Tall { expr: Expr { span, kind }, height: height + 1 };
        }
        self.tell(nesting::told(Span { start: span.end.saturating_sub(1), ..span }));
        Tall { expr: self.unread(span), height: 0 }
    }

    /// A value that could not be read.
    pub(super) fn unread(&self, span: Span) -> Expr {
        Expr { span, kind: ExprKind::Unread }
    }
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::FileId;
    use crate::syntax::parse;
    use crate::syntax::tree::{Expr, ExprKind, StatementKind, UnaryOp};

    /// The value of `let x = …`, fully bracketed.
    fn bracketed(value: &str) -> String {
        let (file, told) = parse(FileId(0), &format!("let x = {value}"));
        assert_eq!(told, [], "{value}");
        match &file.statements[..] {
            [only] => match &only.kind {
                StatementKind::Let { value, .. } => show(value),
                other => panic!("{other:?}"),
            },
            other => panic!("{other:?}"),
        }
    }

    fn show(expr: &Expr) -> String {
        match &expr.kind {
            ExprKind::Number { value, unit } => {
                format!("{value}{}", unit.as_ref().map_or("", |unit| unit.text.as_str()))
            }
            ExprKind::Path(names) => {
                names.iter().map(|name| name.text.clone()).collect::<Vec<_>>().join("::")
            }
            ExprKind::Group(inner) => show(inner),
            ExprKind::Unary(UnaryOp::Minus, inner) => format!("(-{})", show(inner)),
            ExprKind::Unary(UnaryOp::Not, inner) => format!("(not {})", show(inner)),
            ExprKind::Member(of, name) => format!("{}.{}", show(of), name.text),
            ExprKind::Binary { op, left, right, .. } => {
                format!("({} {op:?} {})", show(left), show(right))
            }
            other => format!("{other:?}"),
        }
    }

    #[test]
    fn operators_bind_as_the_language_says() {
        assert_eq!(bracketed("a + b * c"), "(a Plus (b Times c))");
        assert_eq!(bracketed("a - b - c"), "((a Minus b) Minus c)");
        assert_eq!(bracketed("p + 5cm @ 30deg"), "(p Plus (5cm At 30deg))");
        assert_eq!(bracketed("2 * 5cm @ 30deg"), "(2 Times (5cm At 30deg))");
        assert_eq!(bracketed("-90deg + spread"), "((-90deg) Plus spread)");
        assert_eq!(bracketed("0cm..a + 1cm"), "(0cm To (a Plus 1cm))");
        assert_eq!(
            bracketed("a < b and not c == d or e"),
            "(((a Less b) And (not (c Equal d))) Or e)"
        );
        assert_eq!(bracketed("a/2"), "(a Over 2)");
        assert_eq!(bracketed("600/m"), "600/m");
        assert_eq!(bracketed("1 3/8in"), "1.375in");
        assert_eq!(bracketed("3µm"), "3um");
    }

    #[test]
    fn a_value_goes_on_after_an_operator_at_the_end_of_a_line() {
        assert_eq!(bracketed("a +\n    b"), "(a Plus b)");
    }

    #[test]
    fn places_are_exact() {
        let text = "let x = (a  +  b).y";
        let (file, _) = parse(FileId(0), text);
        let [statement] = &file.statements[..] else { panic!("one statement") };
        let StatementKind::Let { value, .. } = &statement.kind else { panic!("a let") };
        assert_eq!(&text[value.span.start as usize..value.span.end as usize], "(a  +  b).y");
    }
}
