//! Curves, outlines, polygons and their intersections in the drawing plane.
