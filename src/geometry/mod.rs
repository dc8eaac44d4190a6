//! Curves, outlines, polygons and their intersections in the drawing plane.

pub mod crossing;
pub mod curve;
pub mod nearby;
pub mod polygon;
