//! Curves, outlines, polygons and their intersections in the drawing plane.

pub mod crossing;
pub mod nearby;
pub mod polygon;
