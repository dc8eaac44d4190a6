//! What a garment is expected to be: the figures that a pattern maker checks, kept in a file
//! beside the text, and what has changed against them.

use crate::garment::Garment;
use crate::garment::panel::{Loop, Run};
use crate::garment::seam::{PanelRun, SeamKind};
use crate::mesh::{self, compiled::Compiled};
use kurbo::{BezPath, Shape};
use serde::{Deserialize, Serialize};
use std::fmt::Write;

/// Version of the file.
const VERSION: u32 = 1;

/// The file `NAME.expected.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Expected {
    #[serde(rename = "darzi-expected")]
    version: u32,
    /// Garments and scenes in the order of the text, each in its own size and then in those of
    /// its `grade`.
    cuts: Vec<Cut>,
}

/// A garment in one size.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Cut {
    garment: String,
    /// None for the size of the wearer in the text.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    size: Option<String>,
    /// Of the cut and sewn cloth, not of its colours, mechanics or pictures.
    mesh: String,
    particles: usize,
    panels: Vec<Panel>,
    seams: Vec<Seam>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Panel {
    name: String,
    fabric: String,
    area_cm2: f64,
    /// Lengths of named edges as sewn, cm, in the order of drawing.
    #[serde(with = "in_order")]
    edges_cm: Vec<(String, f64)>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Seam {
    name: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    kind: Option<SeamKind>,
    lengths_cm: [f64; 2],
}

/// A list of named figures written as an object, so that each stands on a line of its own.
mod in_order {
    use serde::de::{MapAccess, Visitor};
    use serde::ser::SerializeMap;
    use serde::{Deserializer, Serializer};

    pub(super) fn serialize<S: Serializer>(
        list: &[(String, f64)],
        out: S,
    ) -> Result<S::Ok, S::Error> {
        let mut map = out.serialize_map(Some(list.len()))?;
        for (name, value) in list {
            map.serialize_entry(name, value)?;
        }
        map.end()
    }

    pub(super) fn deserialize<'d, D: Deserializer<'d>>(
        text: D,
    ) -> Result<Vec<(String, f64)>, D::Error> {
        struct Pairs;
        impl<'d> Visitor<'d> for Pairs {
            type Value = Vec<(String, f64)>;

            fn expecting(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                out.write_str("lengths by the names of their edges")
            }

            fn visit_map<A: MapAccess<'d>>(self, mut map: A) -> Result<Self::Value, A::Error> {
                let mut list = Vec::new();
                while let Some(entry) = map.next_entry()? {
                    list.push(entry);
                }
                Ok(list)
            }
        }
        text.deserialize_map(Pairs)
    }
}

/// A figure with two digits behind the point: tenths of a millimetre, hundredths of a cm².
fn rounded(value: f64) -> f64 {
    (value * 100.0).round() / 100.0 + 0.0
}

/// The area that an outline encloses without its holes, cm².
fn area(loops: &[Loop]) -> f64 {
    let enclosed = |ring: &Loop| {
        let mut path = BezPath::new();
        for (number, piece) in ring.pieces.iter().enumerate() {
            path.extend(piece.path.iter().skip(usize::from(number > 0)));
        }
        path.close_path();
        path.area()
    };
    rounded(loops.iter().map(enclosed).sum::<f64>() * 1e4)
}

fn length<'a>(runs: impl Iterator<Item = &'a Run>) -> f64 {
    rounded(runs.map(Run::length).sum::<f64>() * 100.0)
}

impl Cut {
    /// The figures of a garment.
    pub(super) fn of(garment: &Garment, size: Option<&str>, compiled: &Compiled) -> Cut {
        let panels = garment.panels.iter().map(|panel| Panel {
            name: panel.name.clone(),
            fabric: garment.fabrics.get(panel.fabric).map_or(String::new(), |f| f.name.clone()),
            area_cm2: area(&panel.loops),
            edges_cm: panel
                .edges
                .iter()
                .map(|edge| (edge.name.clone(), length(edge.runs.iter())))
                .collect(),
        });
        let side = |runs: &[PanelRun]| length(runs.iter().map(|run| &run.run));
        let seams = garment.seams.iter().map(|seam| Seam {
            name: seam.name.clone(),
            kind: (seam.kind != SeamKind::Plain).then_some(seam.kind),
            lengths_cm: [side(&seam.a), side(&seam.b)],
        });
        Cut {
            garment: garment.name.clone(),
            size: size.map(str::to_owned),
            mesh: hash(compiled),
            particles: compiled.particles.len(),
            panels: panels.collect(),
            seams: seams.collect(),
        }
    }

    fn title(&self) -> String {
        match &self.size {
            Some(size) => format!("{} in {size}", self.garment),
            None => self.garment.clone(),
        }
    }

    /// What is different in `self` against `old`, a line each.
    fn against(&self, old: &Cut, out: &mut Vec<String>) {
        let title = self.title();
        let before = out.len();
        for panel in &self.panels {
            let Some(was) = old.panels.iter().find(|was| was.name == panel.name) else {
                out.push(format!("{title}: panel {} is new", panel.name));
                continue;
            };
            let name = format!("{title}: {}", panel.name);
            if panel.fabric != was.fabric {
                out.push(format!("{name} is of {}, was of {}", panel.fabric, was.fabric));
            }
            for (edge, length) in &panel.edges_cm {
                match was.edges_cm.iter().find(|(other, _)| other == edge) {
                    Some((_, old)) => changed(out, &format!("{name}.{edge}"), *old, *length, "cm"),
                    None => out.push(format!("{name}.{edge} is new, {length} cm")),
                }
            }
            for (edge, _) in &was.edges_cm {
                if !panel.edges_cm.iter().any(|(other, _)| other == edge) {
                    out.push(format!("{name}.{edge} is gone"));
                }
            }
            changed(out, &format!("{name}, area"), was.area_cm2, panel.area_cm2, "cm²");
        }
        for was in &old.panels {
            if !self.panels.iter().any(|panel| panel.name == was.name) {
                out.push(format!("{title}: panel {} is gone", was.name));
            }
        }
        let kind = |seam: &Seam| seam.kind.unwrap_or(SeamKind::Plain);
        // Open and zipped parts of one seam share its name; they are told apart by their order.
        let key = |seams: &[Seam], number: usize| {
            let name = seams.get(number).map(|seam| seam.name.clone()).unwrap_or_default();
            let earlier = seams.iter().take(number).filter(|seam| seam.name == name).count();
            (name, earlier)
        };
        let find = |seams: &[Seam], wanted: &(String, usize)| {
            (0..seams.len()).find(|number| key(seams, *number) == *wanted)
        };
        for (number, seam) in self.seams.iter().enumerate() {
            let found = find(&old.seams, &key(&self.seams, number));
            let Some(was) = found.and_then(|found| old.seams.get(found)) else {
                out.push(format!("{title}: seam {} is new", seam.name));
                continue;
            };
            let name = format!("{title}: seam {}", seam.name);
            if kind(seam) != kind(was) {
                out.push(format!("{name} is {:?}, was {:?}", kind(seam), kind(was)).to_lowercase());
            }
            let ([a, b], [c, d]) = (was.lengths_cm, seam.lengths_cm);
            if [a, b] != [c, d] {
                let ease = |a: f64, b: f64| rounded((a - b).abs() * 10.0);
                out.push(format!(
                    "{name}: {a} to {b} cm, ease {} mm → {c} to {d} cm, ease {} mm",
                    ease(a, b),
                    ease(c, d)
                ));
            }
        }
        for (number, was) in old.seams.iter().enumerate() {
            if find(&self.seams, &key(&old.seams, number)).is_none() {
                out.push(format!("{title}: seam {} is gone", was.name));
            }
        }
        if self.particles != old.particles {
            out.push(format!("{title}: {} particles → {}", old.particles, self.particles));
        }
        if out.len() == before && self != old {
            let what = if self.mesh == old.mesh { "the order of its parts" } else { "its mesh" };
            out.push(format!("{title}: {what} differs, though no figure of this list does"));
        }
    }
}

fn changed(out: &mut Vec<String>, what: &str, old: f64, new: f64, unit: &str) {
    if old != new {
        let sign = if new > old { "+" } else { "−" };
        let by = rounded((new - old).abs());
        out.push(format!("{what} {old} → {new} {unit} ({sign}{by})"));
    }
}

/// A short name for the shape of the cloth and its seams.
fn hash(compiled: &Compiled) -> String {
    let mut cloth = compiled.clone();
    cloth.atlas = Default::default();
    cloth.fabrics.clear();
    cloth.bodies.clear();
    cloth.schedule.clear();
    cloth.pictures.clear();
    for panel in &mut cloth.panels {
        panel.surfaces.clear();
    }
    let mut hasher = blake3::Hasher::new();
    // A hasher takes all that is written.
    let _ = mesh::json::write(&cloth, &mut hasher);
    hasher.finalize().to_hex().chars().take(16).collect()
}

impl Expected {
    /// The figures of all garments of a file.
    pub(super) fn of(cuts: Vec<Cut>) -> Expected {
        Expected { version: VERSION, cuts }
    }

    /// Whether the file makes nothing that is cut.
    pub(super) fn is_empty(&self) -> bool {
        self.cuts.is_empty()
    }

    /// Reads a file of figures.
    ///
    /// # Errors
    /// A sentence saying why it is none.
    pub(super) fn read(text: &str) -> Result<Expected, String> {
        let read: Expected = serde_json::from_str(text).map_err(|why| why.to_string())?;
        if read.version == VERSION {
            Ok(read)
        } else {
            Err(format!("its version is {}, this darzi writes {VERSION}", read.version))
        }
    }

    /// As a text, one figure a line.
    ///
    /// # Errors
    /// What serde says of a figure that JSON has no word for.
    pub(super) fn text(&self) -> Result<String, serde_json::Error> {
        // The two lengths of a seam share a line.
        let mut out = serde_json::to_string_pretty(self)?;
        while let Some(at) = out.find("\"lengths_cm\": [\n") {
            let from = at + "\"lengths_cm\": [".len();
            let to = out[from..].find(']').map_or(from, |length| from + length);
            let inner = out[from..to].split_whitespace().collect::<Vec<_>>().join(" ");
            out.replace_range(from..to, &inner);
        }
        let _ = writeln!(out);
        Ok(out)
    }

    /// What is different in `self` against `old`, a line each.
    pub(super) fn against(&self, old: &Expected) -> Vec<String> {
        let mut out = Vec::new();
        let same = |a: &Cut, b: &Cut| a.garment == b.garment && a.size == b.size;
        for cut in &self.cuts {
            let before = out.len();
            match old.cuts.iter().find(|was| same(was, cut)) {
                Some(was) => cut.against(was, &mut out),
                None => out.push(format!("{} is new", cut.title())),
            }
            // What a change does is seen in the first size; the others are counted.
            let many = out.len().saturating_sub(before);
            if cut.size.is_some() && many > 1 && before > 0 {
                out.truncate(before);
                out.push(format!("{}: {many} figures changed", cut.title()));
            }
        }
        for was in &old.cuts {
            if !self.cuts.iter().any(|cut| same(was, cut)) {
                out.push(format!("{} is gone", was.title()));
            }
        }
        if out.is_empty() && self != old {
            out.push("the order of the garments is another".to_owned());
        }
        out
    }
}
