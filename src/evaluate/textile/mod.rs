//! Yarns, fabrics, weaves, knits and motifs, from their blocks.

mod chart;
mod compound;
mod draft;
mod fabric;
mod knit;
mod motif;
mod sheet;
mod weave;
mod yarn;

pub(super) use chart::mask;
pub(super) use fabric::fabric;
pub(super) use knit::knit;
pub(super) use motif::motif;
pub(super) use weave::weave;
pub(super) use yarn::yarn;

#[cfg(test)]
mod tests;
