//! What holds of every text, sound or not. The fuzz targets under `fuzz/` try it on texts that
//! nobody thought of, the test beside this file on the best of them.

use darzi::diagnostic::{Diagnostic, FileId, Texts, json, render};
use darzi::evaluate::{Options, evaluate};
use darzi::garment::Garment;
use darzi::garment::panel::Panel;
use darzi::mesh::{self, limit};
use darzi::syntax::format::format;
use darzi::syntax::parse;
use darzi::world::{Memory, World};
use meaning::meaning;

#[path = "meaning.rs"]
mod meaning;

/// Particles that a garment is cut into, more or less, so that it takes milliseconds.
const PARTICLES: f64 = 500.0;

struct One<'t>(&'t str);

impl Texts for One<'_> {
    fn path(&self, _: FileId) -> &str {
        "one.garment"
    }
    fn text(&self, _: FileId) -> &str {
        self.0
    }
}

/// Every place told of lies in the text, and every message can be shown.
fn shown(told: &[Diagnostic], texts: &dyn Texts) {
    for label in told.iter().flat_map(|told| &told.labels) {
        let (start, end) = (label.span.start as usize, label.span.end as usize);
        assert!(texts.text(label.span.file).get(start..end).is_some(), "{label:?}");
    }
    let report = render::report(told, texts, false, 80);
    assert!(!report.contains("Failed to read"), "{report}");
    assert_eq!(json::lines(told, texts).lines().count(), told.len());
}

/// A text is read; formatted it means the same, and formatted again it stays.
pub fn read(text: &str) {
    let (_, told) = parse(FileId(0), text);
    shown(&told, &One(text));
    let Some(meant) = meaning(text) else { return };
    let new = format(FileId(0), text).unwrap();
    assert_eq!(Some(meant), meaning(&new), "from\n{text}\nto\n{new}");
    assert_eq!(format(FileId(0), &new).as_ref(), Ok(&new), "formatted twice from\n{text}");
}

/// A text is worked out, and its garments are cut, or it is said why they cannot be.
pub fn cut(text: &str) {
    let mut world = Memory::new([("one.garment", text)]);
    let root = world.open("one.garment").unwrap();
    let (garments, told) = evaluate(&mut world, root, &Options::default());
    shown(&told, &world);
    for garment in &garments {
        let coarsen = (particles(garment) / PARTICLES).sqrt().max(1.0);
        let options = mesh::Options { coarsen, atlas: false, ..mesh::Options::default() };
        if let Err(told) = mesh::compile(garment, &options) {
            assert!(told.iter().any(Diagnostic::is_error));
            shown(&told, &world);
        }
    }
}

/// Particles of a garment, more or less, with cells as it asks for them.
fn particles(garment: &Garment) -> f64 {
    let of_panel = |panel: &Panel| {
        let cell = panel.cell.unwrap_or(mesh::DEFAULT_CELL);
        panel.loops.iter().map(limit::area).sum::<f64>() / (cell * cell)
    };
    garment.panels.iter().map(of_panel).sum()
}
