//! Panels cut by their particles: a counted grid, lines from particle to particle, masks drawn in
//! characters, and what is done to single particles of the rim.
//!
//! Cuts come first, in the order of the text, then smoothing and moving. Durupınar 2004, 3.2.2 to
//! 3.2.5, has the same by hand.

use super::super::Evaluator;
use super::super::fields::{Fields, Phrase};
use super::super::textile::mask;
use super::Counted;
use super::raster::{self, Node, Outcome, Region, Ring};
use super::shape::SIZE;
use super::sheet::Drawn;
use crate::diagnostic::{Diagnostic, Span};
use crate::geometry::curve;
use crate::units::Dimension;
use kurbo::{BezPath, Point, Vec2};
use std::collections::BTreeMap;

/// Cells of a counted grid along a side at most: each is looked at in every cut.
const CELLS: i32 = 2_000;

/// The names of the edges that a cut makes: its label, or `cut`, with the number of the mark at
/// which they begin.
pub(super) fn cut_edges(phrase: &Phrase<'_>) -> Vec<String> {
    let label = phrase.label.map_or("cut", |label| label.text.as_str());
    (1..=phrase.values("along").len()).map(|number| format!("{label}{number}")).collect()
}

impl<'t> Evaluator<'t> {
    /// The cut lines of a panel with a counted grid, and the grid.
    pub(super) fn counted(
        &mut self,
        fields: &Fields<'t>,
        size: &Phrase<'t>,
        name: &str,
    ) -> Option<(Vec<Vec<Drawn>>, Option<Counted>)> {
        let extent = [
            self.within_range(size.arg(0)?, Dimension::LENGTH, 1e-3, SIZE)?,
            self.within_range(size.arg(1)?, Dimension::LENGTH, 1e-3, SIZE)?,
        ];
        let (region, count) = match fields.get("mask") {
            Some(drawing) => {
                let rows = mask(self, drawing)?;
                let count = [rows.first().map_or(0, Vec::len) as i32, rows.len() as i32];
                let Some((region, fallen)) = Region::of_mask(&rows) else {
                    self.tell(
                        Diagnostic::new("E0813", format!("the mask of `{name}` keeps no cloth"))
                            .at(drawing.key.span, "no `#` stands in it"),
                    );
                    return None;
                };
                self.tell_fallen(fallen, drawing.key.span);
                (region, count)
            }
            None => {
                let across = fields.get("grid").and_then(|grid| grid.arg(0).zip(grid.arg(1)));
                let Some((across, up)) = across else {
                    return self.uncounted(fields, extent, size.span);
                };
                let across = self.whole_number(across, 1, i64::from(CELLS))? as i32;
                let up = self.whole_number(up, 1, i64::from(CELLS))? as i32;
                (Region { rings: vec![raster::rectangle([across, up])] }, [across, up])
            }
        };
        let cell = [extent[0] / f64::from(count[0]), extent[1] / f64::from(count[1])];
        let counted = Counted { origin: [-extent[0] / 2.0, 0.0], cell, count };
        let mut region = region;
        for phrase in fields.all("cut") {
            region = self.cut(phrase, region, &counted)?;
        }
        let mut moved: BTreeMap<Node, Vec2> = BTreeMap::new();
        for phrase in &fields.phrases {
            match phrase.word.name {
                "smooth" => self.smooth(phrase, &mut region)?,
                "move" => self.shift(phrase, &region, &mut moved)?,
                _ => {}
            }
        }
        let place = |node: Node| {
            let [x, y] = counted.place(node);
            Point::new(x, y) + moved.get(&node).copied().unwrap_or_default()
        };
        let rings = region.rings.iter().map(|ring| drawn(ring, &place, size.span)).collect();
        Some((rings, Some(counted)))
    }

    /// A rectangle of which the grid is not counted: nothing can be cut by its particles.
    fn uncounted(
        &mut self,
        fields: &Fields<'t>,
        [width, height]: [f64; 2],
        span: Span,
    ) -> Option<(Vec<Vec<Drawn>>, Option<Counted>)> {
        let by_particles = ["cut", "smooth", "move"];
        if let Some(phrase) =
            fields.phrases.iter().find(|phrase| by_particles.contains(&phrase.word.name))
        {
            self.tell(
                Diagnostic::new("E0208", format!("`{}` wants a counted grid", phrase.word.name))
                    .at(phrase.span, "which particles are meant?")
                    .help("such as `grid: 40 x 60`, or a `mask`"),
            );
            return None;
        }
        let edges = super::shape::rectangle([-width / 2.0, 0.0], [width / 2.0, height], span);
        Some((vec![edges], None))
    }

    fn tell_fallen(&mut self, fallen: usize, at: Span) {
        if fallen > 0 {
            let pieces =
                if fallen == 1 { "a piece".to_owned() } else { format!("{fallen} pieces") };
            self.tell(
                Diagnostic::new("W0401", format!("{pieces} of cloth fall off"))
                    .at(at, "they are not joined to the piece that is kept")
                    .help("cells that touch by a corner only are not joined"),
            );
        }
    }

    /// The particles named by a phrase.
    fn particles(
        &mut self,
        args: Vec<super::super::fields::Arg<'t>>,
        grid: &Counted,
    ) -> Option<Vec<Node>> {
        let mut nodes = Vec::new();
        for arg in args {
            let node = self.particle(arg)?;
            if !grid.has(node) {
                let [across, up] = grid.count;
                self.tell(
                    Diagnostic::new("E0303", format!("there is no particle ({}, {})", node[0], node[1]))
                        .at(arg.expr.span, format!("they go from (0, 0) to ({across}, {up})"))
                        .help("particles stand at the corners of the cells, counted from the lower left one"),
                );
                return None;
            }
            nodes.push(node);
        }
        Some(nodes)
    }

    fn cut(&mut self, phrase: &Phrase<'t>, region: Region, grid: &Counted) -> Option<Region> {
        let marks = self.particles(phrase.values("along"), grid)?;
        let keep = phrase.values("keep");
        let inside = phrase.word_of("keep") == Some("inside");
        let seed = keep.get(1).copied()?;
        let seed_at = self.particles(vec![seed], grid)?;
        let line = raster::line(&marks, &cut_edges(phrase));
        let line = match raster::simple(&line) {
            Ok(line) => line,
            Err([c, r]) => {
                self.tell(
                    Diagnostic::new("E0402", "this cut crosses itself")
                        .at(phrase.span, format!("it passes ({c}, {r}) twice")),
                );
                return None;
            }
        };
        if marks.len() < 3 || raster::area(&line) == 0 {
            self.tell(
                Diagnostic::new("E0404", "this cut encloses no cloth")
                    .at(phrase.span, "here")
                    .help("mark at least three particles; the last is joined to the first"),
            );
            return None;
        }
        let off = line.iter().map(|step| step.from).find(|node| !region.has(*node));
        if let Some([c, r]) = off {
            self.tell(
                Diagnostic::new("E0410", "this cut runs where there is no cloth")
                    .at(phrase.span, format!("({c}, {r}) has been cut away"))
                    .help("cut along particles that are left"),
            );
            return None;
        }
        let word = if inside { "inside" } else { "outside" };
        match region.cut(&line, inside, *seed_at.first()?) {
            Outcome::Kept(region, fallen) => {
                self.tell_fallen(fallen, phrase.span);
                Some(region)
            }
            Outcome::Leaks([c, r]) => {
                self.tell(
                    Diagnostic::new("E0407", "the fill runs out of this cut")
                        .at(seed.expr.span, format!("from here it comes to ({c}, {r})"))
                        .help(format!("name a particle {word} the line, or keep the other side")),
                );
                None
            }
            Outcome::Nowhere => {
                self.tell(
                    Diagnostic::new("E0407", "no fill begins here")
                        .at(seed.expr.span, "on the line itself, or off the cloth")
                        .help(format!("name a particle {word} the line")),
                );
                None
            }
        }
    }

    /// `smooth (c, r), …`: the rim from the first to the last of the particles becomes a curve
    /// through all of them.
    fn smooth(&mut self, phrase: &Phrase<'t>, region: &mut Region) -> Option<()> {
        let mut nodes = Vec::new();
        for arg in phrase.args() {
            nodes.push(self.particle(arg)?);
        }
        let (Some(&start), Some(&end)) = (nodes.first(), nodes.last()) else { return None };
        if nodes.len() < 3 {
            self.tell(
                Diagnostic::new("E0306", "smoothing wants at least three particles of the rim")
                    .at(phrase.span, "here"),
            );
            return None;
        }
        for ring in &mut region.rings {
            let at = |node: Node| ring.iter().position(|step| step.from == node);
            let (Some(a), Some(b)) = (at(start), at(end)) else { continue };
            // The way round that passes the second particle, or the shorter one where the curve
            // is led by particles beside the line.
            let count = ring.len();
            let length = (b + count - a) % count;
            let forward = match nodes.get(1).and_then(|second| at(*second)) {
                Some(second) => (second + count - a) % count < length,
                None => 2 * length <= count,
            };
            let (from, length) = if forward { (a, length) } else { (b, count - length) };
            if !forward {
                nodes.reverse();
            }
            let inner = nodes.get(1..nodes.len() - 1)?;
            ring.rotate_left(from);
            let mut smoothed = ring.first()?.clone();
            smoothed.through = Some(inner.to_vec());
            if let Some(label) = phrase.label {
                smoothed.name = Some(label.text.clone());
            }
            ring.splice(0..length, [smoothed]);
            return Some(());
        }
        let on_rim = |node: Node| region.rings.iter().flatten().any(|step| step.from == node);
        let lost = [start, end].into_iter().find(|node| !on_rim(*node));
        self.tell_off_rim(phrase, lost.unwrap_or(end));
        None
    }

    fn tell_off_rim(&mut self, phrase: &Phrase<'t>, [c, r]: Node) {
        self.tell(
            Diagnostic::new("E0204", format!("({c}, {r}) is no particle of this part of the rim"))
                .at(phrase.span, "here")
                .help("name particles of one cut line"),
        );
    }

    /// `move (c, r), … by V`: shifts particles of the rim.
    fn shift(
        &mut self,
        phrase: &Phrase<'t>,
        region: &Region,
        moved: &mut BTreeMap<Node, Vec2>,
    ) -> Option<()> {
        let [x, y] = self.point(phrase.value("by")?)?;
        for arg in phrase.args() {
            let node = self.particle(arg)?;
            let rim = region.rings.iter().flatten();
            let mut known = rim.flat_map(|step| {
                std::iter::once(step.from).chain(step.through.iter().flatten().copied())
            });
            if !known.any(|other| other == node) {
                self.tell_off_rim(phrase, node);
                return None;
            }
            *moved.entry(node).or_default() += Vec2::new(x, y);
        }
        Some(())
    }
}

/// A line as drawn edges: steps in one direction under one name are one straight edge.
fn drawn(ring: &Ring, place: &dyn Fn(Node) -> Point, span: Span) -> Vec<Drawn> {
    let mut edges: Vec<Drawn> = Vec::new();
    let mut straight = false;
    for (step, next) in ring.iter().zip(ring.iter().cycle().skip(1)) {
        let (a, b) = (place(step.from), place(next.from));
        let path: BezPath = match &step.through {
            Some(inner) => {
                let inner = inner.iter().map(|node| place(*node));
                let points: Vec<Point> = std::iter::once(a).chain(inner).chain([b]).collect();
                curve::through(&points, None, None)
            }
            None => curve::line(a, b),
        };
        let goes_on = straight && step.through.is_none();
        straight = step.through.is_none();
        if let Some(before) = edges.last_mut().filter(|edge| goes_on && edge.name == step.name) {
            let (from, to) = (curve::start(&before.path), curve::end(&before.path));
            if ((to - from).cross(b - from)).abs() < 1e-12 && (to - from).dot(b - a) > 0.0 {
                before.path = curve::line(from, b);
                continue;
            }
        }
        edges.push(Drawn { name: step.name.clone(), span, path });
    }
    edges
}
