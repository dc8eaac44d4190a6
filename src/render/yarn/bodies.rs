//! The yarns of a tile, sorted into fields, and the rays that go through them.

use crate::mesh::atlas::{Laid, Skin, Strand};
use crate::render::Vector;
use crate::textile::fabric::{Fabric, Structure};

/// The yarns of a fabric.
#[derive(Clone, Debug)]
pub struct Bodies {
    /// Extent of the tile along u and v, m.
    pub size: [f32; 2],
    /// Fields across and up.
    fields: [usize; 2],
    /// For each field where its pieces begin in the list; those of the last end with it.
    begins: Vec<u32>,
    list: Vec<u32>,
    pieces: Vec<Piece>,
    /// Length of each strand in the tile, m.
    lengths: Vec<f32>,
    /// Which yarn each strand is.
    yarns: Vec<usize>,
    /// How their surfaces look.
    pub skins: Vec<Skin>,
    /// From the middle of the cloth to the top of the highest yarn, m.
    pub height: f32,
    /// Distance of the closest threads, m; half a wale in a knit.
    pub pitch: f32,
    /// By how much light that yarns keep from each other is too little: what enters one leaves
    /// through its neighbours.
    pub gain: f32,
}

/// A piece of a yarn between two nodes: a round bar with round ends in a space that is stretched
/// upright until the yarn is round.
#[derive(Clone, Copy, Debug)]
struct Piece {
    from: Vector,
    along: Vector,
    /// Directions of the yarn at both ends.
    ways: [Vector; 2],
    radius: f32,
    /// Stretch of the space.
    stretch: f32,
    /// Length of yarn from the start of the strand to both ends, m.
    lengths: [f32; 2],
    strand: u32,
}

/// Where a ray meets a yarn. Directions are along u, v and w.
#[derive(Clone, Copy, Debug)]
pub struct Struck {
    /// Distance along the ray.
    pub distance: f32,
    /// Outwards; unit length.
    pub normal: Vector,
    /// Along the yarn; unit length.
    pub way: Vector,
    /// Number of the strand.
    pub strand: u32,
    /// Place along the strand as a share of its length in the tile.
    pub share: f32,
}

/// A straight piece of a ray in the space of the cloth, u and v without end, w from its middle.
#[derive(Clone, Copy, Debug)]
pub struct Line {
    /// Where it is at distance 0.
    pub origin: Vector,
    /// Where it goes in one unit of distance.
    pub direction: Vector,
}

impl Bodies {
    /// Of a fabric; none where its repeat is too large to be held.
    pub fn of(fabric: &Fabric) -> Option<Self> {
        let laid = Laid::of(&fabric.structure)?;
        let size = laid.size.map(|length| length as f32);
        let step = [0, 1].map(|k| size[k] / laid.threads[k] as f32);
        let knitted = matches!(fabric.structure, Structure::Knitted { .. });
        let per_thread = if knitted { 3.0 } else { 2.0 };
        let fields = [0, 1].map(|k| ((size[k] / step[k] * per_thread).round() as usize).max(1));
        let mut pieces = Vec::new();
        let mut height: f32 = 1e-6;
        for (number, strand) in laid.strands.iter().enumerate() {
            add(strand, number as u32, size, &mut pieces);
            let flat = strand.flatness;
            height =
                strand.nodes.iter().fold(height, |most, n| most.max(n.at[2].abs() + n.half * flat));
        }
        let mut bodies = Bodies {
            size,
            fields,
            begins: Vec::new(),
            list: Vec::new(),
            pieces,
            lengths: laid.strands.iter().map(|strand| strand.length).collect(),
            yarns: laid.strands.iter().map(|strand| strand.yarn).collect(),
            skins: laid.looks,
            height: height * 1.02,
            pitch: Self::pitch_of(fabric),
            gain: 1.0,
        };
        bodies.sort();
        bodies.gain = bodies.shaded();
        Some(bodies)
    }

    /// Distance of the closest threads of a fabric, m; half a wale in a knit.
    pub fn pitch_of(fabric: &Fabric) -> f32 {
        match &fabric.structure {
            Structure::Woven { warp, weft, .. } => warp.spacing.min(weft.spacing) as f32,
            Structure::Knitted { knit, .. } => (0.5 / knit.wales.max(1e-3)) as f32,
        }
    }

    /// The yarn that a strand is.
    pub fn yarn(&self, strand: u32) -> usize {
        self.yarns
            .get(strand as usize)
            .copied()
            .unwrap_or(0)
            .min(self.skins.len().saturating_sub(1))
    }

    /// Length of a strand in the tile, m.
    pub fn length(&self, strand: u32) -> f32 {
        self.lengths.get(strand as usize).copied().unwrap_or(1.0)
    }

    /// Sorts the pieces into the fields that they touch.
    fn sort(&mut self) {
        let [columns, rows] = self.fields;
        let field = [self.size[0] / columns as f32, self.size[1] / rows as f32];
        let mut in_field: Vec<Vec<u32>> = vec![Vec::new(); columns * rows];
        for (number, piece) in self.pieces.iter().enumerate() {
            let to = piece.from + piece.along;
            let span = |k: usize, count: usize| {
                let low = piece.from[k].min(to[k]) - piece.radius;
                let high = piece.from[k].max(to[k]) + piece.radius;
                let first = (low / field[k]).floor().max(0.0) as usize;
                let last = ((high / field[k]).floor().max(-1.0) + 1.0) as usize;
                first..last.min(count)
            };
            for row in span(1, rows) {
                for column in span(0, columns) {
                    in_field[row * columns + column].push(number as u32);
                }
            }
        }
        self.begins.clear();
        for list in &in_field {
            self.begins.push(self.list.len() as u32);
            self.list.extend(list);
        }
        self.begins.push(self.list.len() as u32);
    }

    /// The first yarn on a line, from `start` to `end` along it.
    pub fn first(&self, line: &Line, start: f32, end: f32) -> Option<Struck> {
        let [columns, rows] = self.fields.map(|n| n as i64);
        let field = [self.size[0] / columns as f32, self.size[1] / rows as f32];
        let at = line.origin + line.direction * start;
        let mut cell = [0, 1].map(|k| (at[k] / field[k]).floor() as i64);
        let mut step = [0_i64; 2];
        let mut next = [f32::INFINITY; 2];
        let mut gap = [f32::INFINITY; 2];
        for k in 0..2 {
            let d = line.direction[k];
            if d.abs() > 1e-9 {
                step[k] = if d > 0.0 { 1 } else { -1 };
                let edge = (cell[k] + i64::from(d > 0.0)) as f32 * field[k];
                next[k] = start + (edge - at[k]) / d;
                gap[k] = field[k] / d.abs();
            }
        }
        let mut best: Option<(f32, u32)> = None;
        let mut here = start;
        // Longer ways than this are those of rays that run within the cloth.
        for _ in 0..96 {
            let tile = [cell[0].div_euclid(columns), cell[1].div_euclid(rows)];
            let origin = Vector::new(
                line.origin.x - tile[0] as f32 * self.size[0],
                line.origin.y - tile[1] as f32 * self.size[1],
                line.origin.z,
            );
            let number = cell[1].rem_euclid(rows) * columns + cell[0].rem_euclid(columns);
            let list =
                self.begins[number as usize] as usize..self.begins[number as usize + 1] as usize;
            for &number in &self.list[list] {
                let piece = &self.pieces[number as usize];
                if let Some(distance) = piece.meet(&origin, &line.direction) {
                    let nearer = best.is_none_or(|(least, _)| distance < least);
                    if distance > start && distance < end && nearer {
                        best = Some((distance, number));
                    }
                }
            }
            let axis = usize::from(next[1] < next[0]);
            here = here.max(next[axis]);
            if best.is_some_and(|(distance, _)| distance <= here) || here >= end {
                break;
            }
            cell[axis] += step[axis];
            next[axis] += gap[axis];
        }
        let (distance, number) = best?;
        let piece = &self.pieces[number as usize];
        // Pieces lie in one tile: the place in it is found anew.
        let mut at = line.origin + line.direction * distance - piece.from;
        for k in 0..2 {
            at[k] -= ((at[k] - 0.5 * piece.along[k]) / self.size[k]).round() * self.size[k];
        }
        // Between the planes that cut the yarn upright at both nodes, so that one piece goes over
        // into the next without a step.
        let before = at.dot(&piece.ways[0]);
        let after = (piece.along - at).dot(&piece.ways[1]);
        let span = before + after;
        let share = if span > 1e-12 { (before / span).clamp(-0.6, 1.6) } else { 0.5 };
        let off = at - piece.along * share;
        let square = piece.stretch * piece.stretch;
        let normal = Vector::new(off.x, off.y, off.z * square);
        let way = piece.ways[0] * (1.0 - share) + piece.ways[1] * share;
        let way = way.try_normalize(1e-12).unwrap_or_else(Vector::x);
        // The joints of pieces are smoothed: the normal stands on the bent way of the yarn.
        let normal = normal - way * normal.dot(&way);
        let normal = normal.try_normalize(1e-12).unwrap_or_else(Vector::z);
        let length = piece.lengths[0] + (piece.lengths[1] - piece.lengths[0]) * share;
        let share = length / self.length(piece.strand).max(1e-9);
        Some(Struck { distance, normal, way, strand: piece.strand, share })
    }

    /// One over the share of even light from the half space above that reaches what is seen from
    /// above, held within bounds.
    fn shaded(&self) -> f32 {
        const PLACES: u32 = 1024;
        let (mut met, mut lit) = (0.0, 0.0_f32);
        for path in 0..PLACES {
            let mut sampler = crate::render::sample::Sampler::new(0, [0, 0], path, PLACES);
            let ([x, y], pair) = (sampler.pair(), sampler.pair());
            let origin = Vector::new(x * self.size[0], y * self.size[1], self.height);
            let line = Line { origin, direction: -Vector::z() };
            let Some(struck) = self.first(&line, 0.0, 2.0 * self.height) else { continue };
            met += 1.0;
            let out = crate::render::sample::cosine_about(&struck.normal, pair);
            if out.z <= 0.02 {
                continue;
            }
            let origin = origin - Vector::z() * struck.distance + struck.normal * self.lift();
            let end = (self.height - origin.z) / out.z;
            let line = Line { origin, direction: out };
            if self.first(&line, 0.0, end).is_none() {
                lit += 1.0;
            }
        }
        (met / lit.max(1.0)).clamp(1.0, 2.2)
    }

    /// Rays start so far off a yarn, m.
    pub fn lift(&self) -> f32 {
        0.004 * self.pitch
    }
}

impl Piece {
    /// The distance at which a ray meets it. (Ray and capsule, as
    /// in C. Ericson, "Real-Time Collision Detection", 2005, section 5.3.7.)
    #[inline(always)]
    fn meet(&self, origin: &Vector, direction: &Vector) -> Option<f32> {
        let s = self.stretch;
        let (ox, oy, oz) =
            (origin.x - self.from.x, origin.y - self.from.y, (origin.z - self.from.z) * s);
        let (dx, dy, dz) = (direction.x, direction.y, direction.z * s);
        let (bx, by, bz) = (self.along.x, self.along.y, self.along.z * s);
        let bb = bx * bx + by * by + bz * bz;
        let bd = bx * dx + by * dy + bz * dz;
        let bo = bx * ox + by * oy + bz * oz;
        let dd = dx * dx + dy * dy + dz * dz;
        let od = ox * dx + oy * dy + oz * dz;
        let oo = ox * ox + oy * oy + oz * oz;
        let rr = self.radius * self.radius;
        let a = bb * dd - bd * bd;
        let b = bb * od - bo * bd;
        let c = bb * (oo - rr) - bo * bo;
        let h = b * b - a * c;
        if h < 0.0 {
            return None;
        }
        if a > 1e-9 * bb * dd {
            let distance = (-b - h.sqrt()) / a;
            let y = bo + distance * bd;
            if y >= 0.0 && y <= bb {
                return Some(distance);
            }
            let (ox, oy, oz) = if y < 0.0 { (ox, oy, oz) } else { (ox - bx, oy - by, oz - bz) };
            let b = ox * dx + oy * dy + oz * dz;
            let h = b * b - dd * (ox * ox + oy * oy + oz * oz - rr);
            return (h >= 0.0).then(|| (-b - h.sqrt()) / dd);
        }
        None
    }
}

/// Adds the pieces of a strand, and their images where the tile is repeated beside itself.
fn add(strand: &Strand, number: u32, size: [f32; 2], pieces: &mut Vec<Piece>) {
    let nodes = &strand.nodes;
    let count = nodes.len();
    if count < 2 {
        return;
    }
    let place = |k: usize| Vector::from(nodes[k].at);
    // A whole strand goes on in the next tile as it began in this one; a stretch of a course ends
    // where the yarn of the next colour takes over.
    let span = place(count - 1) - place(0);
    let whole = (0..2).any(|axis| (span[axis].abs() - size[axis]).abs() < 1e-3 * size[axis]);
    let way = |k: usize| {
        let before = match k {
            0 if whole => place(count - 2) - span,
            0 => place(0),
            _ => place(k - 1),
        };
        let after = match k + 1 {
            next if next < count => place(next),
            _ if whole => place(1) + span,
            _ => place(k),
        };
        (after - before).try_normalize(1e-12).unwrap_or_else(Vector::x)
    };
    let stretch = 1.0 / strand.flatness.max(0.05);
    for k in 0..count - 1 {
        let (from, to) = (place(k), place(k + 1));
        let radius = 0.5 * (nodes[k].half + nodes[k + 1].half);
        let piece = Piece {
            from,
            along: to - from,
            ways: [way(k), way(k + 1)],
            radius,
            stretch,
            lengths: [nodes[k].along, nodes[k + 1].along],
            strand: number,
        };
        for across in -1..=1 {
            for up in -1..=1 {
                let shift = [across as f32 * size[0], up as f32 * size[1]];
                let inside = (0..2).all(|axis| {
                    let low = from[axis].min(to[axis]) + shift[axis] - radius;
                    let high = from[axis].max(to[axis]) + shift[axis] + radius;
                    high >= 0.0 && low <= size[axis]
                });
                if inside {
                    let from = from + Vector::new(shift[0], shift[1], 0.0);
                    pieces.push(Piece { from, ..piece });
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::textile::Colour;
    use crate::textile::fabric::{Finish, Thread};
    use crate::textile::knit::{Knit, Stitch};
    use crate::textile::weave::Weave;
    use crate::textile::yarn::{Fibre, Twist, Yarn};

    fn fabric(structure: impl FnOnce(Yarn) -> Structure) -> Fabric {
        let yarn = Yarn {
            name: "yarn".to_owned(),
            count: 40e-6,
            plies: 2,
            twist: 500.0,
            direction: Twist::S,
            fibre: Fibre::Cotton,
            colour: Colour([200, 200, 200, 255]),
            diameter: 0.24e-3,
        };
        Fabric {
            name: "cloth".to_owned(),
            structure: structure(yarn),
            mass: 0.2,
            thickness: 0.5e-3,
            bending: [1e-5; 2],
            tensile: [500.0; 2],
            shear: 30.0,
            poisson: 0.2,
            friction: 0.3,
            damping: 0.1,
            finish: Finish::Matte,
        }
    }

    fn woven(rows: Vec<Vec<bool>>) -> Bodies {
        let cloth = fabric(|yarn| {
            let thread = Thread { spacing: 0.5e-3, colour: yarn.colour, yarn };
            let weave = Weave { name: "weave".to_owned(), rows };
            Structure::Woven { weave, warp: thread.clone(), weft: thread }
        });
        Bodies::of(&cloth).expect("a small repeat")
    }

    /// What is met straight from above (1) or from below (−1) at a place.
    fn from(bodies: &Bodies, side: f32, [u, v]: [f32; 2]) -> Option<Struck> {
        let origin = Vector::new(u, v, side * bodies.height);
        let line = Line { origin, direction: Vector::new(0.0, 0.0, -side) };
        bodies.first(&line, 0.0, 2.0 * bodies.height)
    }

    #[test]
    fn the_drawdown_is_seen_from_above_and_its_opposite_from_below() {
        // A twill 3/1, turned by one more so that no row is like the next.
        let rows: Vec<Vec<bool>> =
            (0..4).map(|pick| (0..4).map(|end| (end + 4 - pick) % 4 != 0).collect()).collect();
        let bodies = woven(rows.clone());
        for pick in 0..9 {
            for end in 0..9 {
                let at = [(end as f32 + 0.5) * 0.5e-3, (pick as f32 + 0.5) * 0.5e-3];
                let up = rows[pick % 4][end % 4];
                for side in [1.0, -1.0] {
                    let struck = from(&bodies, side, at).expect("threads cross here");
                    let warp = bodies.yarn(struck.strand) == 0;
                    assert_eq!(warp, up == (side > 0.0), "end {end}, pick {pick}, side {side}");
                    // Warp runs along v, weft along u, the top of a thread looks up.
                    assert!(struck.way[usize::from(warp)].abs() > 0.8);
                    assert!(struck.normal.z * side > 0.8);
                }
            }
        }
    }

    #[test]
    fn threads_repeat_without_end_and_leave_gaps_between_them() {
        let bodies = woven(vec![vec![true, false], vec![false, true]]);
        let far = 1000.0 * bodies.size[0];
        let at = [0.21e-3, 0.27e-3];
        let (here, there) = (from(&bodies, 1.0, at), from(&bodies, 1.0, [at[0] - far, at[1]]));
        let [here, there] = [here, there].map(|struck| struck.expect("a thread").distance);
        // At 20 m from the origin single precision tells 2 µm apart.
        assert!((here - there).abs() < 4e-6, "{here} {there}");
        // Threads 0.35 mm wide stand 0.5 mm apart: 9 % of the cloth is open.
        let mut open = 0;
        for n in 0..10_000 {
            let at = [(n % 100) as f32 * 1e-5, (n / 100) as f32 * 1e-5];
            open += usize::from(from(&bodies, 1.0, at).is_none());
        }
        assert!((300..1600).contains(&open), "{open}");
    }

    #[test]
    fn a_face_loop_shows_its_legs_and_a_back_loop_its_heads() {
        let legs = |stitch: Stitch, side: f32| {
            let knit = Knit::of_loops("knit", vec![vec![stitch]], 200.0, 280.0).expect("a knit");
            let cloth =
                fabric(|yarn| Structure::Knitted { knit, yarn: Yarn { diameter: 1.2e-3, ..yarn } });
            let bodies = Bodies::of(&cloth).expect("a small repeat");
            let mut upright = 0;
            let mut all = 0;
            for n in 0..2500 {
                let at = [(n % 50) as f32 * 2e-4, (n / 50) as f32 * 1.4e-4];
                if let Some(struck) = from(&bodies, side, at) {
                    all += 1;
                    upright += usize::from(struck.way.y.abs() > struck.way.x.abs());
                }
            }
            upright as f32 / all as f32
        };
        let (front, back) = (legs(Stitch::Face, 1.0), legs(Stitch::Face, -1.0));
        assert!(front > back + 0.25, "{front} in front, {back} behind");
        // A back loop is a face loop from behind.
        assert!((legs(Stitch::Back, 1.0) - back).abs() < 0.1);
    }

    #[test]
    fn yarns_take_light_from_each_other() {
        let bodies = woven(vec![vec![true, false], vec![false, true]]);
        assert!((1.05..2.0).contains(&bodies.gain), "{}", bodies.gain);
    }
}
