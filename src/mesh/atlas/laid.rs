//! The yarns of a tile as bodies in space, for pictures from so near that they are seen: the same
//! strands from which the tile is drawn.

use super::repeat::Repeat;
use super::strand::{Node, Strand};
use super::tile::{Grid, Look};
use super::{knitted, woven};
use crate::textile::fabric::Structure;

/// The yarns of one tile.
#[derive(Clone, Debug)]
pub struct Laid {
    /// Extent of the tile along u and v, m.
    pub size: [f64; 2],
    /// Threads, or wales and courses, in it.
    pub threads: [usize; 2],
    /// The yarns, from their first node to its image in the next tile: x along u, y along v,
    /// z towards the face, m.
    pub strands: Vec<Strand>,
    /// How the surface of each kind of yarn looks; [`Strand::yarn`] counts them.
    pub looks: Vec<Look>,
}

/// Nodes that a tile may have: 32 bytes each.
const MOST: usize = 6_000_000;

/// Samples to the narrower distance of threads, as the unit of lengths.
const FINE: f64 = 40.0;

impl Laid {
    /// The yarns of this structure; none where its repeat has more crossings than can be held.
    pub fn of(structure: &Structure) -> Option<Laid> {
        let repeat = Repeat::of(structure, 1.0);
        let threads = repeat.threads;
        if threads[0].saturating_mul(threads[1]).saturating_mul(40) > MOST {
            return None;
        }
        let spacing = [0, 1].map(|k| repeat.size[k] / threads[k] as f64);
        let pixel = spacing[0].min(spacing[1]) / FINE;
        let across = |k: usize| ((repeat.size[k] / pixel).round() as usize).clamp(1, 1 << 24);
        let grid = Grid { width: across(0), height: across(1) };
        let (strands, looks) = match &structure {
            Structure::Woven { weave, warp, weft } => (
                woven::strands(weave, warp, weft, threads, &grid, woven::Form::Bodies),
                vec![woven::look(warp, repeat.size[1]), woven::look(weft, repeat.size[0])],
            ),
            Structure::Knitted { knit, yarn } => (
                knitted::strands(knit, &knit.loops(), yarn, threads, &grid),
                knitted::looks(knit, yarn, threads[0]),
            ),
        };
        let scale = [repeat.size[0] / grid.width as f64, repeat.size[1] / grid.height as f64]
            .map(|scale| scale as f32);
        let strands = strands
            .into_iter()
            .map(|strand| {
                let place = |node: &Node| Node {
                    at: [node.at[0] * scale[0], node.at[1] * scale[1], node.at[2] * scale[0]],
                    half: node.half * scale[0],
                    along: node.along * scale[0],
                };
                let nodes = strand.nodes.iter().map(place).collect();
                Strand { nodes, length: strand.length * scale[0], ..strand }
            })
            .collect();
        Some(Laid { size: repeat.size, threads, strands, looks })
    }
}
