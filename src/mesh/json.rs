//! `mesh.json`: a [`Compiled`] for other programs. The schema is described in
//! `docs/mesh-format.md`.
//!
//! Long lists are written by hand in compact form, a list of numbers after each other; the rest
//! is what serde writes. Numbers are the shortest that read back as the same 64-bit number, so
//! the same mesh gives the same bytes.

use super::compiled::{Compiled, MeshPanel};
use rayon::prelude::*;
use serde::Serialize;
use serde_json::ser::{CompactFormatter, Formatter};
use std::io::{self, Write};

/// Version of the schema.
pub const VERSION: u32 = 1;
/// Numbers that one task turns into text.
const CHUNK: usize = 1 << 15;
/// Particles off the grid have this for their column and row.
const OFF_GRID: i32 = -1;

/// Writes a mesh.
///
/// # Errors
/// What the writer says, or a number that JSON has no word for.
pub fn write(compiled: &Compiled, mut out: impl Write) -> io::Result<()> {
    let out = &mut out;
    write!(out, "{{\"darzi-mesh\":{VERSION},\"name\":")?;
    value(out, &compiled.name)?;
    write!(out, ",\n\"panels\":[")?;
    for (number, panel) in compiled.panels.iter().enumerate() {
        write!(out, "{}", if number == 0 { "\n" } else { ",\n" })?;
        write_panel(out, panel)?;
    }
    write!(out, "],\n\"particles\":[")?;
    list(out, &compiled.particles, |text, place| {
        // Negative zero would be written with its sign.
        place.map(|x| Number::Real(x + 0.0)).into_iter().try_for_each(|x| x.write(text))
    })?;
    write!(out, "],\n\"lattice\":[")?;
    list(out, &compiled.lattice, |text, &at| {
        let at = if at[0] == i32::MIN { [OFF_GRID; 2] } else { at };
        at.map(|k| Number::Whole(i64::from(k))).into_iter().try_for_each(|x| x.write(text))
    })?;
    write!(out, "],\n\"cells\":[")?;
    list(out, &compiled.cells, |text, corners| whole(text, corners))?;
    write!(out, "],\n\"triangles\":[")?;
    list(out, &compiled.triangles, |text, corners| whole(text, corners))?;
    write!(out, "],\n\"seams\":[")?;
    for (number, seam) in compiled.seams.iter().enumerate() {
        write!(out, "{}{{\"name\":", if number == 0 { "\n" } else { ",\n" })?;
        value(out, &seam.name)?;
        write!(out, ",\"pairs\":[")?;
        list(out, &seam.pairs, |text, pair| whole(text, pair))?;
        write!(out, "]}}")?;
    }
    write!(out, "],\n\"closures\":")?;
    value(out, &compiled.closures)?;
    write!(out, ",\n\"nearby\":")?;
    value(out, &compiled.nearby)?;
    write!(out, ",\n\"patches\":")?;
    value(out, &compiled.patches)?;
    write!(out, ",\n\"shut\":")?;
    value(out, &compiled.shut)?;
    write!(out, ",\n\"creases\":")?;
    value(out, &compiled.creases)?;
    write!(out, ",\n\"bands\":")?;
    value(out, &compiled.bands)?;
    write!(out, ",\n\"cords\":")?;
    value(out, &compiled.cords)?;
    write!(out, ",\n\"ties\":")?;
    value(out, &compiled.ties)?;
    write!(out, ",\n\"attachments\":")?;
    value(out, &compiled.attachments)?;
    write!(out, ",\n\"pins\":")?;
    value(out, &compiled.pins)?;
    write!(out, ",\n\"atlas\":")?;
    value(out, &compiled.atlas)?;
    write!(out, ",\n\"fabrics\":")?;
    value(out, &compiled.fabrics)?;
    write!(out, ",\n\"bodies\":")?;
    value(out, &compiled.bodies)?;
    write!(out, ",\n\"solids\":")?;
    value(out, &compiled.solids)?;
    write!(out, ",\n\"schedule\":")?;
    value(out, &compiled.schedule)?;
    write!(out, ",\n\"pictures\":")?;
    value(out, &compiled.pictures)?;
    writeln!(out, "}}")
}

fn write_panel(out: &mut impl Write, panel: &MeshPanel) -> io::Result<()> {
    write!(out, "{{\"name\":")?;
    value(out, &panel.name)?;
    write!(out, ",\"fabric\":{},\"cell\":", panel.fabric)?;
    value(out, &panel.cell)?;
    write!(out, ",\"layer\":{},\"grain\":", panel.layer)?;
    value(out, &panel.grain)?;
    write!(out, ",\"placement\":")?;
    value(out, &panel.placement)?;
    for (name, stretch) in
        [("particles", panel.particles), ("cells", panel.cells), ("triangles", panel.triangles)]
    {
        write!(out, ",\"{name}\":[{},{}]", stretch.start, stretch.end)?;
    }
    write!(out, ",\"loops\":")?;
    value(out, &panel.loops)?;
    write!(out, ",\"edges\":")?;
    value(out, &panel.edges)?;
    write!(out, ",\"surfaces\":")?;
    value(out, &panel.surfaces)?;
    write!(out, "}}")
}

fn value(out: &mut impl Write, value: &impl Serialize) -> io::Result<()> {
    Ok(serde_json::to_writer(out, value)?)
}

enum Number {
    Real(f64),
    Whole(i64),
}

impl Number {
    /// Writes the number and a comma.
    fn write(self, text: &mut Vec<u8>) -> io::Result<()> {
        match self {
            Number::Real(x) if !x.is_finite() => {
                return Err(io::Error::new(io::ErrorKind::InvalidData, "not a number"));
            }
            Number::Real(x) => CompactFormatter.write_f64(text, x)?,
            Number::Whole(x) => CompactFormatter.write_i64(text, x)?,
        }
        text.push(b',');
        Ok(())
    }
}

fn whole(text: &mut Vec<u8>, numbers: &[u32]) -> io::Result<()> {
    numbers.iter().try_for_each(|&k| Number::Whole(i64::from(k)).write(text))
}

/// Writes the numbers of all items in one list, chunk by chunk on all threads; the bytes do not
/// depend on how many there are.
fn list<T: Sync>(
    out: &mut impl Write,
    items: &[T],
    item: impl Fn(&mut Vec<u8>, &T) -> io::Result<()> + Sync,
) -> io::Result<()> {
    // A few chunks at a time, so that the text of a large mesh does not stand whole in memory.
    for batch in items.chunks(CHUNK * 64) {
        let texts: Vec<io::Result<Vec<u8>>> = batch
            .par_chunks(CHUNK)
            .map(|chunk| {
                let mut text = Vec::with_capacity(chunk.len() * 24);
                chunk.iter().try_for_each(|one| item(&mut text, one))?;
                Ok(text)
            })
            .collect();
        let last = std::ptr::eq(batch.as_ptr_range().end, items.as_ptr_range().end);
        let count = texts.len();
        for (number, text) in texts.into_iter().enumerate() {
            let mut text = text?;
            if last && number + 1 == count {
                // No comma after the last number.
                text.pop();
            }
            out.write_all(&text)?;
        }
    }
    Ok(())
}
