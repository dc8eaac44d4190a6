//! Knits.

use super::chart::{self, Keys};
use crate::diagnostic::Diagnostic;
use crate::evaluate::Evaluator;
use crate::evaluate::fields::bare;
use crate::evaluate::item::ItemId;
use crate::syntax::tree::Item;
use crate::textile::knit::{Knit, Stitch};
use crate::units::Dimension;

/// Wales or courses a metre may have: cobweb and machine lace below, fishing nets above.
const GAUGES: (f64, f64) = (5.0, 20_000.0);

/// A knit.
pub(in crate::evaluate) fn knit(ev: &mut Evaluator<'_>, id: ItemId) -> Option<Knit> {
    let fields = ev.open_item(id)?;
    let mut keys = Keys::new(&[
        (".", Stitch::Face),
        ("k", Stitch::Face),
        ("R", Stitch::Face),
        ("-", Stitch::Back),
        ("p", Stitch::Back),
        ("L", Stitch::Back),
    ]);
    for line in chart::legend(ev, &fields) {
        let word = match line.rest {
            [Item::Expr(expr)] => bare(expr).map(|name| name.text.as_str()),
            _ => None,
        };
        match word {
            Some("face" | "knit") => keys.set(&line.key.text, Stitch::Face),
            Some("back" | "purl") => keys.set(&line.key.text, Stitch::Back),
            _ => {
                chart::unknown_meaning(ev, &line, &["face", "back", "knit", "purl"]);
                // The key is known all the same; its meaning has been told of.
                keys.set(&line.key.text, Stitch::Face);
            }
        }
    }
    let known = "`.` `k` `R` are loops drawn to the face, `-` `p` `L` to the back; \
                 name other signs in `legend`";
    let rows = match ev.required(&fields, "chart").cloned() {
        Some(chart) => chart::cells(ev, &chart, &keys, known),
        None => None,
    };
    let gauge = ev.required(&fields, "gauge").cloned().and_then(|said| {
        let per = ev.positive(said.value("per")?, Dimension::LENGTH);
        let wales = said.arg(0).and_then(|arg| ev.positive(arg, Dimension::NUMBER));
        let courses = said.arg(1).and_then(|arg| ev.positive(arg, Dimension::NUMBER));
        let gauge = [wales? / per?, courses? / per?];
        if gauge.iter().all(|count| (GAUGES.0..=GAUGES.1).contains(count)) {
            return Some(gauge);
        }
        ev.tell(
            Diagnostic::new("E0303", "no yarn can be knitted at this gauge").at(said.span, "here"),
        );
        None
    });
    let (rows, [wales, courses]) = (rows?, gauge?);
    let knit = match Knit::chart(ev.item(id).name.clone(), rows, wales, courses) {
        Ok(knit) => knit,
        Err(error) => {
            ev.tell(Diagnostic::new("E0601", error.to_string()).at(fields.span, "here"));
            return None;
        }
    };
    let shows_back = fields.get("face").and_then(|phrase| phrase.choice(0)) == Some("back");
    Some(if shows_back { knit.back() } else { knit })
}
