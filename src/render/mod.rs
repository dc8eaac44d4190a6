//! Drape to pictures: camera, light, ray tracing, the look of textiles.
