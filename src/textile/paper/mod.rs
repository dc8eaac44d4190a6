//! Point paper: drafts as weavers draw them, with a simulation of the cloth beside them, and
//! charts as knitters do.
//!
//! A [`Sheet`] is a list of shapes in pixels, x to the right and y down, drawn in their order. It
//! is written as SVG or painted; both show the same.

mod chart;
mod cloth;
mod digit;
mod draft;
mod paint;
mod svg;

pub use chart::chart;
pub use draft::{Drawing, drawing};
pub use paint::paint;
pub use svg::svg;

use super::Colour;

/// A drawing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sheet {
    /// What it shows.
    pub title: String,
    /// Width, pixels.
    pub width: u32,
    /// Height, pixels.
    pub height: u32,
    /// What is on it, from the lowest.
    pub shapes: Vec<Shape>,
}

/// A rectangle in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs)]
pub struct Area {
    pub x: f64,
    pub y: f64,
    pub width: f64,
    pub height: f64,
}

/// A shape of a sheet.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A filled rectangle.
    Fill {
        /// Where.
        area: Area,
        /// In which colour.
        colour: Colour,
    },
    /// Marks in the cells of a grid.
    Marks {
        /// The corner of the grid, left and top.
        corner: [f64; 2],
        /// Side of a cell.
        cell: f64,
        /// What is left free on each side of a mark.
        inset: f64,
        /// Column, row from the top, and number of cells to the right that are marked.
        runs: Vec<[u32; 3]>,
        /// In which colour.
        colour: Colour,
    },
    /// Rings or crosses in the cells of a grid, as tie-ups are marked.
    Ties {
        /// The corner of the grid, left and top.
        corner: [f64; 2],
        /// Side of a cell.
        cell: f64,
        /// Column and row from the top.
        cells: Vec<[u32; 2]>,
        /// Crosses, for a sinking shed, instead of rings.
        crosses: bool,
        /// In which colour.
        colour: Colour,
    },
    /// A stretch of thread, round and lit from above the cloth.
    Thread {
        /// Where.
        area: Area,
        /// Whether it runs up and down.
        upright: bool,
        /// Its colour.
        colour: Colour,
        /// How far it dips under others at its ends, in pixels of its length.
        dips: [f64; 2],
    },
    /// A line from point to point.
    Line {
        /// Its points.
        points: Vec<[f64; 2]>,
        /// How thick it is.
        thick: f64,
        /// In which colour.
        colour: Colour,
    },
    /// A filled polygon that does not cross itself.
    Polygon {
        /// Its corners.
        points: Vec<[f64; 2]>,
        /// In which colour.
        colour: Colour,
    },
    /// Digits, Latin letters and a few signs.
    Digits {
        /// The middle of the text.
        middle: [f64; 2],
        /// Height of a digit.
        height: f64,
        /// What is written.
        text: String,
        /// In which colour.
        colour: Colour,
    },
}
