//! Quantities with dimensions.
