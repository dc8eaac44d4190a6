//! The band between the cut line of a panel and its intact cells, as triangles.
//!
//! All places here are in cells: metres divided by the side of a cell.

use super::lattice::Ground;
use super::triangulation::{Side, Triangulation};
use crate::geometry::polygon::Place;

/// Free lattice points this near to the outline, in cells, are left out.
const NEAREST: f32 = 0.55;

/// What a point of the band may do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// It is a point of the outline.
    Outline,
    /// It is a corner of an intact cell: this lattice point.
    Corner(usize),
    /// It is free, and still lies on this lattice point.
    Lattice(usize),
    /// It is free: this one of the loose points.
    Loose(usize),
}

impl Role {
    /// Whether the point may be moved and taken out.
    pub fn free(self) -> bool {
        matches!(self, Role::Lattice(_) | Role::Loose(_))
    }
}

/// The band of one panel.
#[derive(Debug)]
pub struct Band {
    /// Lattice and intact cells.
    pub ground: Ground,
    /// Points of the outline, ring after ring, in cells.
    pub outline: Vec<Place>,
    /// For each point of the outline the next one of its ring.
    pub next: Vec<usize>,
    /// Free points off the lattice, in cells; `None` for those taken out again.
    pub loose: Vec<Option<Place>>,
    /// Lattice points inside and near the outline.
    near: Vec<usize>,
    /// Whether a lattice point without intact cells belongs to the band; by place in `near`.
    kept: Vec<bool>,
    /// Number of each lattice point in `near`, or `u32::MAX`.
    place_in_near: Vec<u32>,
}

/// The points of the band at one moment, and the triangles between them.
#[derive(Debug)]
pub struct Drawn {
    /// Places in cells.
    pub places: Vec<Place>,
    /// What each may do.
    pub roles: Vec<Role>,
    /// The triangles.
    pub mesh: Triangulation,
}

impl Band {
    /// The band of a panel whose outline points lie at `rings` (in cells).
    pub fn new(ground: Ground, rings: &[Vec<Place>]) -> Self {
        let mut outline = Vec::new();
        let mut next = Vec::new();
        for ring in rings {
            let first = outline.len();
            outline.extend_from_slice(ring);
            next.extend((0..ring.len()).map(|k| first + (k + 1) % ring.len()));
        }
        let mut band = Band {
            place_in_near: vec![u32::MAX; ground.depth.len()],
            ground,
            outline,
            next,
            loose: Vec::new(),
            near: Vec::new(),
            kept: Vec::new(),
        };
        for point in 0..band.ground.depth.len() {
            let depth = band.ground.depth[point];
            let on_outline = band.ground.on_outline[point] != u32::MAX;
            if on_outline || (0.0..super::lattice::FAR).contains(&depth) {
                band.place_in_near[point] = band.near.len() as u32;
                band.near.push(point);
                band.kept.push(!on_outline && depth >= NEAREST);
            }
        }
        band
    }

    /// Place of a lattice point in cells.
    fn lattice_place(&self, point: usize) -> Place {
        self.ground.lattice.place(point).map(|x| x / self.ground.lattice.cell)
    }

    fn intact_around(&self, point: usize) -> usize {
        self.ground.cells_around(point).filter(|&cell| self.ground.intact[cell]).count()
    }

    /// Triangulates the band as it stands; `None` when outline points coincide or sides cross.
    pub fn draw(&self) -> Option<Drawn> {
        let mut places = self.outline.clone();
        let mut roles = vec![Role::Outline; places.len()];
        let mut slot = vec![u32::MAX; self.near.len()];
        for (k, &point) in self.near.iter().enumerate() {
            let on_outline = self.ground.on_outline[point];
            let role = match self.intact_around(point) {
                _ if on_outline != u32::MAX => {
                    slot[k] = on_outline;
                    continue;
                }
                0 if self.kept[k] => Role::Lattice(point),
                1..=3 => Role::Corner(point),
                _ => continue,
            };
            slot[k] = places.len() as u32;
            places.push(self.lattice_place(point));
            roles.push(role);
        }
        for (number, place) in self.loose.iter().enumerate() {
            if let Some(place) = place {
                places.push(*place);
                roles.push(Role::Loose(number));
            }
        }
        let mut cells: Vec<usize> =
            self.near.iter().flat_map(|&point| self.ground.cells_around(point)).collect();
        cells.sort_unstable();
        cells.dedup();
        let mut stairs: Vec<[u32; 2]> =
            cells.into_iter().flat_map(|cell| self.open_sides(cell, &slot)).collect();
        stairs.sort_unstable();
        let mut sides = Vec::with_capacity(stairs.len() + self.next.len());
        for (a, &b) in self.next.iter().enumerate() {
            let side = [a as u32, b as u32];
            sides.push(match stairs.binary_search(&side) {
                Ok(cell) => (stairs.remove(cell), Side::CellAtOutline),
                Err(_) => (side, Side::Outline),
            });
        }
        sides.extend(stairs.into_iter().map(|side| (side, Side::Cell)));
        let mesh = Triangulation::new(&places, &sides)?;
        Some(Drawn { places, roles, mesh })
    }

    /// Sides of an intact cell, by points of the band, that no other intact cell shares.
    fn open_sides(&self, cell: usize, slot: &[u32]) -> Vec<[u32; 2]> {
        let mut open = Vec::new();
        if !self.ground.intact[cell] {
            return open;
        }
        let [i, j] = self.ground.lattice.column_row(cell);
        let corners = self.ground.corners(i, j);
        let intact = |i: Option<usize>, j: Option<usize>| match (i, j) {
            (Some(i), Some(j)) => self.ground.intact[self.ground.lattice.number(i, j)],
            _ => false,
        };
        // The last row and column hold no cells, so i + 1 and j + 1 stay on the lattice.
        let beyond = [
            intact(Some(i), j.checked_sub(1)),
            intact(Some(i + 1), Some(j)),
            intact(Some(i), Some(j + 1)),
            intact(i.checked_sub(1), Some(j)),
        ];
        for (side, beyond) in beyond.into_iter().enumerate() {
            let ends = [corners[side], corners[(side + 1) % 4]];
            let points = ends.map(|end| {
                let near = self.place_in_near[end];
                slot.get(near as usize).copied().unwrap_or(u32::MAX)
            });
            if !beyond && points.iter().all(|&point| point != u32::MAX) {
                open.push(points);
            }
        }
        open
    }

    /// Moves a free point.
    pub fn move_to(&mut self, role: Role, place: Place) {
        match role {
            Role::Lattice(_) => {
                self.remove(role);
                self.loose.push(Some(place));
            }
            Role::Loose(number) => self.loose[number] = Some(place),
            Role::Outline | Role::Corner(_) => {}
        }
    }

    /// Takes a free point out.
    pub fn remove(&mut self, role: Role) {
        match role {
            Role::Lattice(point) => {
                if let Some(kept) = self.kept.get_mut(self.place_in_near[point] as usize) {
                    *kept = false;
                }
            }
            Role::Loose(number) => self.loose[number] = None,
            Role::Outline | Role::Corner(_) => {}
        }
    }

    /// Gives up the intact cells around a lattice point, as far as they lie near the outline;
    /// tells whether there were any.
    pub fn release(&mut self, point: usize) -> bool {
        let cells: Vec<usize> = self.ground.cells_around(point).collect();
        let mut released = false;
        for cell in cells {
            let [i, j] = self.ground.lattice.column_row(cell);
            let corners = self.ground.corners(i, j);
            let near = corners.iter().all(|&corner| self.place_in_near[corner] != u32::MAX);
            if self.ground.intact[cell] && near {
                self.ground.intact[cell] = false;
                released = true;
                for corner in corners {
                    let k = self.place_in_near[corner] as usize;
                    self.kept[k] = self.ground.on_outline[corner] == u32::MAX;
                }
            }
        }
        released
    }

    /// Lattice points that belong to the panel: corners of intact cells and free ones in place.
    pub fn lattice_points(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.ground.depth.len()).filter(|&point| {
            let near = self.place_in_near[point] as usize;
            self.ground.on_outline[point] != u32::MAX
                || self.kept.get(near).copied().unwrap_or(false)
                || self.intact_around(point) > 0
        })
    }
}
