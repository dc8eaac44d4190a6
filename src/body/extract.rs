//! From a function of space to a closed mesh of its zero.
//!
//! Dual contouring on a grid along the axes with one vertex for each sheet of the surface in a cell,
//! then moves along the surface that even out the triangles, each followed by a step back on to
//! the exact zero.
//!
//! # References
//! Nielson 2004, "Dual marching cubes" (a vertex for each sheet); Gibson 1998, "Constrained
//! elastic surface nets" (the smoothing).

use super::part::Bounds;
use nalgebra::{Point3, Vector3};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Rounds of evening out.
const ROUNDS: usize = 5;
/// Nodes along the side of a block that is passed over as a whole where the skin is far.
const BLOCK: usize = 4;
/// Share of the way to the neighbours' middle that a vertex moves in a round.
const MOVE: f64 = 0.5;

/// A mesh of a zero surface.
#[derive(Clone, Debug, Default)]
pub(super) struct Extract {
    /// Vertices, m.
    pub(super) vertices: Vec<Point3<f64>>,
    /// Unit normals from the function's gradient.
    pub(super) normals: Vec<Vector3<f64>>,
    /// Triangles, anticlockwise from outside.
    pub(super) triangles: Vec<[u32; 3]>,
}

/// Corners of a cell: bit 0 is x, bit 1 is y, bit 2 is z.
const EDGES: [[usize; 2]; 12] = [
    [0, 1],
    [2, 3],
    [4, 5],
    [6, 7],
    [0, 2],
    [1, 3],
    [4, 6],
    [5, 7],
    [0, 4],
    [1, 5],
    [2, 6],
    [3, 7],
];

/// Faces of a cell as rings of corners.
const FACES: [[usize; 4]; 6] =
    [[0, 2, 6, 4], [1, 3, 7, 5], [0, 1, 5, 4], [2, 3, 7, 6], [0, 1, 3, 2], [4, 5, 7, 6]];

/// The edge between two corners.
fn edge_between(a: usize, b: usize) -> usize {
    EDGES.iter().position(|e| *e == [a.min(b), a.max(b)]).unwrap_or(0)
}

/// For each choice of inside corners, the sheet that each crossed edge belongs to. On a face with
/// four crossings the inside corners are kept apart, so that both cells at it agree.
fn sheets() -> Vec<[u8; 12]> {
    (0..256_usize)
        .map(|mask| {
            let inside = |corner: usize| mask >> corner & 1 == 1;
            let mut group: [u8; 12] = std::array::from_fn(|e| e as u8);
            let mut link = |a: usize, b: usize| {
                let (from, to) = (group[a].max(group[b]), group[a].min(group[b]));
                for g in &mut group {
                    if *g == from {
                        *g = to;
                    }
                }
            };
            for face in FACES {
                let crossed: Vec<usize> = (0..4)
                    .filter(|k| inside(face[*k]) != inside(face[(k + 1) % 4]))
                    .map(|k| edge_between(face[k], face[(k + 1) % 4]))
                    .collect();
                match crossed[..] {
                    [a, b] => link(a, b),
                    [_, _, _, _] => {
                        for k in (0..4).filter(|k| inside(face[*k])) {
                            let before = edge_between(face[(k + 3) % 4], face[k]);
                            link(before, edge_between(face[k], face[(k + 1) % 4]));
                        }
                    }
                    _ => {}
                }
            }
            group
        })
        .collect()
}

/// Nodes of a grid along the axes with the function's values.
struct Grid {
    /// Places of the nodes along each axis, rising, m.
    lines: [Vec<f64>; 3],
    count: [usize; 3],
    values: Vec<f64>,
}

impl Grid {
    fn new(lines: [Vec<f64>; 3], cell: f64, value: &(impl Fn(Point3<f64>) -> f64 + Sync)) -> Grid {
        let count: [usize; 3] = std::array::from_fn(|k| lines[k].len());
        let at = |place: [usize; 3]| Point3::from(std::array::from_fn(|k| lines[k][place[k]]));
        // Blocks far from the skin take their middle's value: only its sign is used.
        let blocks = count.map(|n| n.div_ceil(BLOCK));
        let half = (BLOCK - 1) as f64 / 2.0;
        let far = 2.2 * half.max(1.0) * cell * 3.0_f64.sqrt();
        let slabs: Vec<Vec<f64>> = (0..blocks[2])
            .into_par_iter()
            .map(|bz| {
                let layers = BLOCK.min(count[2] - bz * BLOCK);
                let mut slab = vec![0.0; layers * count[1] * count[0]];
                for by in 0..blocks[1] {
                    for bx in 0..blocks[0] {
                        let start = [bx * BLOCK, by * BLOCK, bz * BLOCK];
                        let end: [usize; 3] =
                            std::array::from_fn(|k| (start[k] + BLOCK).min(count[k]));
                        let middle = value(nalgebra::center(&at(start), &at(end.map(|n| n - 1))));
                        for z in 0..layers {
                            for y in start[1]..end[1] {
                                for x in start[0]..end[0] {
                                    slab[(z * count[1] + y) * count[0] + x] = if middle.abs() > far
                                    {
                                        middle
                                    } else {
                                        value(at([x, y, start[2] + z]))
                                    };
                                }
                            }
                        }
                    }
                }
                slab
            })
            .collect();
        let values = slabs.concat();
        Grid { lines, count, values }
    }

    fn index(&self, [x, y, z]: [usize; 3]) -> usize {
        (z * self.count[1] + y) * self.count[0] + x
    }

    fn corner(&self, cell: [usize; 3], corner: usize) -> [usize; 3] {
        std::array::from_fn(|k| cell[k] + (corner >> k & 1))
    }

    fn inside(&self, place: [usize; 3]) -> bool {
        self.values[self.index(place)] < 0.0
    }

    fn point(&self, place: [usize; 3]) -> Point3<f64> {
        Point3::from(std::array::from_fn(|k| self.lines[k][place[k]]))
    }
}

/// Quads of the zero surface with vertices near it.
fn quads(grid: &Grid) -> (Vec<Point3<f64>>, Vec<[u32; 4]>) {
    let sheets = sheets();
    let mut vertices: Vec<Point3<f64>> = Vec::new();
    let mut known: BTreeMap<(usize, u8), u32> = BTreeMap::new();
    let cells = grid.count.map(|n| n - 1);
    for z in 0..cells[2] {
        for y in 0..cells[1] {
            for x in 0..cells[0] {
                let cell = [x, y, z];
                let mask = (0..8)
                    .fold(0, |mask, c| mask | usize::from(grid.inside(grid.corner(cell, c))) << c);
                if mask == 0 || mask == 255 {
                    continue;
                }
                let mut sums: BTreeMap<u8, (Vector3<f64>, f64)> = BTreeMap::new();
                for (e, [a, b]) in EDGES.iter().enumerate() {
                    let (p, q) = (grid.corner(cell, *a), grid.corner(cell, *b));
                    if grid.inside(p) != grid.inside(q) {
                        let (f, g) = (grid.values[grid.index(p)], grid.values[grid.index(q)]);
                        let at = grid.point(p) + (grid.point(q) - grid.point(p)) * (f / (f - g));
                        let sum = sums.entry(sheets[mask][e]).or_default();
                        sum.0 += at.coords;
                        sum.1 += 1.0;
                    }
                }
                for (sheet, (sum, n)) in sums {
                    let number = u32::try_from(vertices.len()).unwrap_or(u32::MAX);
                    known.insert((grid.index(cell), sheet), number);
                    vertices.push(Point3::from(sum / n));
                }
            }
        }
    }
    let mut quads = Vec::new();
    for z in 1..cells[2] {
        for y in 1..cells[1] {
            for x in 1..cells[0] {
                for axis in 0..3 {
                    let here = [x, y, z];
                    let mut there = here;
                    there[axis] += 1;
                    let inside = grid.inside(here);
                    if inside == grid.inside(there) {
                        continue;
                    }
                    // The four cells round the edge, anticlockwise seen against the axis.
                    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
                    let mut quad = [0_u32; 4];
                    let mut whole = true;
                    for (slot, (du, dv)) in quad.iter_mut().zip([(1, 1), (0, 1), (0, 0), (1, 0)]) {
                        let mut cell = here;
                        cell[u] -= du;
                        cell[v] -= dv;
                        // Corner of that cell at which the edge begins.
                        let start = du << u | dv << v;
                        let edge = edge_between(start, start | 1 << axis);
                        let mask = (0..8).fold(0, |mask, c| {
                            mask | usize::from(grid.inside(grid.corner(cell, c))) << c
                        });
                        match known.get(&(grid.index(cell), sheets[mask][edge])) {
                            Some(vertex) => *slot = *vertex,
                            None => whole = false,
                        }
                    }
                    if !inside {
                        quad.reverse();
                    }
                    if whole {
                        quads.push(quad);
                    }
                }
            }
        }
    }
    (vertices, quads)
}

/// Places of nodes over `bounds` with a margin, from its middle outwards; `step` gives their
/// distance along an axis at a place, and all are moved by `shift` of a step.
fn lines(bounds: Bounds, shift: f64, step: &impl Fn(usize, f64) -> f64) -> [Vec<f64>; 3] {
    std::array::from_fn(|k| {
        let middle = (bounds.low[k] + bounds.high[k]) / 2.0;
        let middle = middle + shift * step(k, middle);
        let outwards = |end: f64, way: f64| {
            let mut line = Vec::new();
            let mut at = middle;
            while (at - end) * way < 1.5 * step(k, at) {
                at += way * step(k, at + way * step(k, at) / 2.0).max(1e-4);
                line.push(at);
            }
            line
        };
        let mut line = outwards(bounds.low[k], -1.0);
        line.reverse();
        line.push(middle);
        line.extend(outwards(bounds.high[k], 1.0));
        line
    })
}

/// A mesh of the zero of a function within `bounds`, with triangles of up to about `cell` m.
///
/// `step` gives the distance of the grid's lines along an axis (0 to 2) at a place, no more than
/// `cell`. `shift` moves the grid by a share of a step: a second try where a first one has two
/// sheets too close together. `slope` gives value and gradient.
pub(super) fn extract(
    bounds: Bounds,
    cell: f64,
    step: impl Fn(usize, f64) -> f64,
    shift: f64,
    value: impl Fn(Point3<f64>) -> f64 + Sync,
    slope: impl Fn(Point3<f64>) -> (f64, Vector3<f64>) + Sync,
) -> Extract {
    let grid = Grid::new(lines(bounds, shift, &step), cell, &value);
    let (mut vertices, quads) = quads(&grid);
    let mut around: Vec<Vec<u32>> = vec![Vec::new(); vertices.len()];
    for quad in &quads {
        for k in 0..4 {
            around[quad[k] as usize].push(quad[(k + 1) % 4]);
        }
    }
    // One step of Newton's method along the gradient, no longer than a cell's half.
    let step = |p: Point3<f64>| {
        let (f, g) = slope(p);
        let way = g * (f / g.norm_squared().max(0.05));
        let long = way.norm();
        let way = if long > cell / 2.0 { way * (cell / 2.0 / long) } else { way };
        (p - way, g.try_normalize(1e-9).unwrap_or_else(Vector3::y))
    };
    let settle = |vertices: &[Point3<f64>]| -> Vec<(Point3<f64>, Vector3<f64>)> {
        vertices.par_iter().map(|p| step(*p)).collect()
    };
    let mut placed = settle(&vertices);
    for _ in 0..ROUNDS {
        vertices = placed.iter().map(|(p, _)| *p).collect();
        placed = (0..vertices.len())
            .into_par_iter()
            .map(|i| {
                let (p, normal) = placed[i];
                let count = around[i].len().max(1) as f64;
                let sum: Vector3<f64> = around[i].iter().map(|j| vertices[*j as usize] - p).sum();
                let way = sum / count;
                step(p + (way - normal * normal.dot(&way)) * MOVE)
            })
            .collect();
    }
    vertices = placed.iter().map(|(p, _)| *p).collect();
    let (vertices, normals): (Vec<_>, Vec<_>) = settle(&vertices).into_iter().unzip();
    let mut triangles = Vec::with_capacity(quads.len() * 2);
    for [a, b, c, d] in quads {
        let at = |i: u32| vertices[i as usize];
        // The diagonal whose triangles bend less, told by the normals, then the shorter one.
        let fold = |t: [u32; 3], s: [u32; 3]| {
            let normal = |[a, b, c]: [u32; 3]| {
                (at(b) - at(a)).cross(&(at(c) - at(a))).try_normalize(0.0).unwrap_or_default()
            };
            normal(t).dot(&normal(s))
        };
        let (ac, bd) = ((at(a) - at(c)).norm(), (at(b) - at(d)).norm());
        let first = fold([a, b, c], [a, c, d]) - ac / (ac + bd);
        let second = fold([b, c, d], [b, d, a]) - bd / (ac + bd);
        if first >= second {
            triangles.extend([[a, b, c], [a, c, d]]);
        } else {
            triangles.extend([[b, c, d], [b, d, a]]);
        }
    }
    Extract { vertices, normals, triangles }
}
