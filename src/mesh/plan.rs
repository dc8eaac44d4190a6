//! Everything that runs along the cut lines: breakpoints, seams, named edges, what is held.

use super::breakpoint::{Rings, Walk};
use super::grading::grade;
use super::matching::{Classes, Match, Side, carry_breaks};
use super::outline::Outline;
use super::spacing::{self, Address, Spacing};
use crate::diagnostic::Diagnostic;
use crate::garment::Garment;
use crate::garment::panel::Run;
use crate::garment::seam::{PanelRun, Pinned};
use crate::geometry::polygon::Place;

/// Breakpoints of sewing partners this near to each other are sewn to each other, in cells.
const REACH: f64 = 0.15;

/// Breakpoints and walks of everything that runs along the cut lines.
pub struct Plan {
    /// Loops with their breakpoints.
    pub rings: Rings,
    /// Seams; `None` for one without length.
    pub seams: Vec<Option<Match>>,
    /// Walks of each attachment.
    pub attachments: Vec<Vec<Walk>>,
    /// Walks of each cord.
    pub cords: Vec<Vec<Walk>>,
    /// Walks of each pin that holds runs.
    pub pins: Vec<Vec<Walk>>,
    /// Walks of the sewn edges of each patch.
    pub patches: Vec<Vec<Walk>>,
    /// Walks of the named edges, by panel and edge.
    pub edges: Vec<Vec<Vec<Walk>>>,
    /// Which stretches between breakpoints share their count of steps.
    pub classes: Classes,
}

fn runs(list: &[PanelRun]) -> impl Iterator<Item = (usize, Run)> + '_ {
    list.iter().map(|on| (on.panel, on.run))
}

impl Plan {
    /// Collects the breakpoints and carries them through the seams. `cells` are the sides of the
    /// panels' grid cells, m.
    ///
    /// # Errors
    /// E0814 for seams that cannot be matched.
    pub fn new(
        garment: &Garment,
        outlines: &[Vec<Outline>],
        cells: &[f64],
    ) -> Result<Self, Vec<Diagnostic>> {
        let mut rings = Rings::new(outlines);
        let sewn: Vec<[Vec<Walk>; 2]> = garment
            .seams
            .iter()
            .map(|seam| [&seam.a, &seam.b].map(|side| rings.walks(outlines, runs(side))))
            .collect();
        let held = garment.attachments.iter().map(|held| rings.walks(outlines, runs(&held.runs)));
        let attachments = held.collect();
        let cords = garment.cords.iter().map(|cord| rings.walks(outlines, runs(&cord.runs)));
        let cords = cords.collect();
        let pins = garment.pins.iter().map(|pin| match &pin.what {
            Pinned::Runs(list) => rings.walks(outlines, runs(list)),
            Pinned::Point { .. } => Vec::new(),
        });
        let pins = pins.collect();
        let patches = garment.patches.iter().map(|on| rings.walks(outlines, runs(&on.runs)));
        let patches = patches.collect();
        let mut edges = Vec::new();
        for (number, panel) in garment.panels.iter().enumerate() {
            let walks = panel
                .edges
                .iter()
                .map(|edge| rings.walks(outlines, edge.runs.iter().map(|run| (number, *run))));
            edges.push(walks.collect());
        }
        let mut seams: Vec<Option<Match>> =
            sewn.into_iter().map(|[a, b]| Match::new(Side::new(a), Side::new(b))).collect();
        let reach = |number: usize| {
            let seam = garment.seams.get(number);
            let sides = seam.map(|seam| seam.a.iter().chain(&seam.b)).into_iter().flatten();
            let panels = sides.filter_map(|on| cells.get(on.panel));
            REACH * panels.copied().fold(f64::INFINITY, f64::min)
        };
        let matched = carry_breaks(&mut rings, &mut seams, reach)
            .and_then(|()| grade(&mut rings, &mut seams, outlines, cells));
        let classes = matched.map_err(|numbers| {
            let seams = numbers.iter().filter_map(|&number| garment.seams.get(number));
            let said = seams.map(|seam| {
                let message = format!("the points of `{}` cannot be matched", seam.name);
                Diagnostic::new("E0814", message)
                    .at(seam.span, "its sides share edges so that their points never come to rest")
                    .help("sew edges that do not overlap each other")
            });
            said.collect::<Vec<_>>()
        })?;
        Ok(Plan { rings, seams, attachments, cords, pins, patches, edges, classes })
    }

    /// The cut lines of one panel as points, and their addresses.
    pub fn lines(
        &self,
        panel: usize,
        outlines: &[Outline],
        spacing: &Spacing,
    ) -> (Vec<Vec<Place>>, Vec<Address>) {
        let mut lines = Vec::new();
        let mut addresses = Vec::new();
        for (number, outline) in outlines.iter().enumerate() {
            if let Some(ring) = self.rings.number(panel, number) {
                let (places, mut of_ring) =
                    spacing::points(ring, &self.rings, &self.classes, spacing, outline);
                lines.push(places);
                addresses.append(&mut of_ring);
            }
        }
        (lines, addresses)
    }

    /// The class of the interval that a point lies on.
    pub fn class(&self, (ring, interval, _): Address) -> usize {
        self.classes.class[self.classes.first[ring] + interval]
    }
}
