//! The figures of a draft, for programs and for people.

use super::source::Source;
use crate::textile::drawdown::{Drawdown, Longest, Side, System};
use crate::textile::layers::Layers;
use crate::units::{length, trimmed};
use serde_json::{Value, json};
use sha2::{Digest, Sha256};
use std::fmt::Write;

/// What there is to count of a draft.
pub(super) struct Figures<'a> {
    source: &'a Source,
    floats: [Longest; 2],
    layers: Layers,
}

impl<'a> Figures<'a> {
    pub fn of(source: &'a Source) -> Self {
        let floats = [System::Warp, System::Weft].map(|system| source.cloth.longest(system));
        Figures { source, floats, layers: Layers::of(&source.worked) }
    }

    /// The longest float; 0 where the system never lies on that side.
    fn float(&self, system: System, side: Side, round: bool) -> usize {
        let longest = match system {
            System::Warp => &self.floats[0],
            System::Weft => &self.floats[1],
        };
        longest.on(side, round).map_or(0, |float| float.length)
    }

    /// One JSON object. Floats are counted within the draft as it stands; those of
    /// `round_the_repeat` run on where the draft is woven again.
    pub fn json(&self) -> Value {
        let draft = &self.source.draft;
        let (ends, picks) = draft.worked();
        let crossings = (draft.ends() * draft.picks()).max(1) as f64;
        let up = self.source.cloth.picks.warp_up();
        json!({
            "title": draft.title,
            "from": self.source.from,
            "ends": draft.ends(),
            "picks": draft.picks(),
            "worked_ends": ends,
            "worked_picks": picks,
            "shafts": draft.shafts,
            "treadles": draft.treadles,
            "highest_shaft": draft.highest_shaft(),
            "highest_treadle": draft.highest_treadle(),
            "rising": draft.rising,
            "source": self.source.way(),
            "warp_up": up,
            "warp_share": up as f64 / crossings,
            "longest_warp_float": self.float(System::Warp, Side::Face, false),
            "longest_weft_float": self.float(System::Weft, Side::Face, false),
            "longest_warp_float_back": self.float(System::Warp, Side::Back, false),
            "longest_weft_float_back": self.float(System::Weft, Side::Back, false),
            "round_the_repeat": {
                "longest_warp_float": self.float(System::Warp, Side::Face, true),
                "longest_weft_float": self.float(System::Weft, Side::Face, true),
                "longest_warp_float_back": self.float(System::Warp, Side::Back, true),
                "longest_weft_float_back": self.float(System::Weft, Side::Back, true),
                "warp_interlacings": self.source.cloth.changes(System::Warp),
                "weft_interlacings": self.source.cloth.changes(System::Weft),
            },
            "layers": self.layers.count(),
            "drawdown_sha256": fingerprint(&self.source.cloth.picks),
        })
    }

    /// A few lines to be read.
    pub fn summary(&self) -> String {
        let draft = &self.source.draft;
        let mut out = String::new();
        let title = if draft.title.is_empty() { "a draft" } else { &draft.title };
        let from = match self.source.from.as_str() {
            "" => String::new(),
            from => format!("  ({from})"),
        };
        // Writing to a string cannot fail.
        let _ = writeln!(out, "{title}{from}");
        let worked = draft.worked();
        for (word, count, worked, threads) in [
            ("ends", draft.ends(), worked.0, &draft.warp),
            ("picks", draft.picks(), worked.1, &draft.weft),
        ] {
            let mut line = format!("{word:<12}{count}");
            if worked < count {
                let _ = write!(line, ", of which {worked} work");
            }
            if let Some(spacing) = &threads.spacing {
                let mean = spacing.iter().sum::<f64>() / spacing.len().max(1) as f64;
                let _ = write!(line, ", {} a cm", trimmed(0.01 / mean, 1));
            }
            if let Some(&thickness) = threads.thickness.as_ref().and_then(|list| list.first()) {
                let _ = write!(line, ", {} thick", length(thickness));
            }
            let _ = writeln!(out, "{line}");
        }
        let shed = if draft.rising { "rising shed" } else { "sinking shed" };
        let way = match self.source.way() {
            "treadling" => format!("{} treadles", draft.treadles),
            _ => "lift plan".to_owned(),
        };
        let _ = writeln!(out, "{:<12}{}, {way}, {shed}", "shafts", draft.shafts);
        // What works of the cloth is what people mean by it.
        let worked = &self.source.worked;
        let floats = |system| {
            let longest = worked.longest(system);
            let [face, back] = [Side::Face, Side::Back]
                .map(|side| longest.on(side, true).map_or(0, |float| float.length));
            format!("{face} on the face, {back} on the back")
        };
        let _ = writeln!(out, "{:<12}warp {}", "floats", floats(System::Warp));
        let _ = writeln!(out, "{:<12}weft {}", "", floats(System::Weft));
        let crossings = (worked.picks.ends() * worked.picks.picks()).max(1) as f64;
        let share = worked.picks.warp_up() as f64 / crossings;
        let _ = writeln!(out, "{:<12}{}% of the face", "warp", trimmed(share * 100.0, 1));
        if self.layers.count() > 1 {
            let _ = writeln!(out, "{:<12}{}", "layers", self.layers.count());
        }
        out
    }
}

/// SHA-256 of the rows of 0 and 1, first pick first, with a line end between them.
fn fingerprint(drawn: &Drawdown) -> String {
    let mut hash = Sha256::new();
    drawn.spell(|row| hash.update(row));
    hash.finalize().iter().fold(String::new(), |mut text, byte| {
        let _ = write!(text, "{byte:02x}");
        text
    })
}
