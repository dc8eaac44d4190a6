//! Where panels begin: laid flat in the world, wrapped round trunk or limb at a distance, put on
//! like trousers, let down as a cone, or led by their seams to a neighbour.
//!
//! Pieces that seams join at their sides are first laid side by side in the plane (`layplan`),
//! then rolled round the trunk together (`trunk`); what hangs on them by its upper or lower edge,
//! a flounce, a waistband, makes a round of its own at its height, turned towards its partner.
//!
//! Wrapped panels keep their widths: every row of the drawing is laid along a closed line round
//! the body whose length is at least the width of all that hangs there, so that seams begin
//! nearly closed and nothing begins inside the body.

mod cone;
mod family;
mod joins;
mod layplan;
mod led;
mod leg;
mod limb;
mod ripple;
mod section;
mod trunk;

use crate::body::surface::{Landmark, Surface};
use crate::garment::scene::{Placement, Side};
use crate::mesh::compiled::{Compiled, MeshPanel};
use cone::Whole;
use family::{Families, Family};
use joins::Joins;
use nalgebra::{Point3, Rotation3, Vector3};

/// How far above the side of the neck fronts and backs begin, m.
const ABOVE: f64 = 0.065;

/// First positions of all particles, in the order of the mesh, m.
///
/// `bodies` are the wearers in the order of [`Compiled::bodies`]. A panel whose landmark the body
/// does not have is laid flat before the body, so that the result is always complete.
pub fn place(compiled: &Compiled, bodies: &[Surface]) -> Vec<Point3<f64>> {
    let joins = Joins::new(compiled);
    let mut positions = vec![Point3::origin(); compiled.particles.len()];
    let mut done = vec![false; compiled.panels.len()];
    let mut wrapped = Vec::new();
    for (number, panel) in compiled.panels.iter().enumerate() {
        match &panel.placement {
            Placement::Flat { at, turn } => {
                let turn = Rotation3::from_euler_angles(turn[0], turn[1], turn[2]);
                for (k, [x, y]) in drawing(compiled, panel) {
                    let local = turn * Vector3::new(x, y, 0.0);
                    positions[k] = Point3::new(at[0], at[1], at[2]) + local;
                }
                done[number] = true;
            }
            Placement::Wrapped { body, landmark, level, side, anchor, gap } => {
                let Some(body) = bodies.get(*body) else { continue };
                let mut each = Wrapped {
                    number,
                    body,
                    landmark,
                    level: level.as_deref(),
                    side: *side,
                    anchor: *anchor,
                    gap: *gap,
                    whole: None,
                };
                if *side == Side::Around && each.limb().is_none() {
                    each.whole = Whole::of(compiled, &joins, number);
                }
                wrapped.push(each);
            }
            Placement::Led => {}
        }
    }
    let legs: Vec<&Wrapped> = wrapped.iter().filter(|w| leg::is_leg(compiled, w)).collect();
    leg::wrap(compiled, &joins, &legs, &mut positions);
    for each in &legs {
        done[each.number] = true;
    }
    let Families { trunk, limbs, .. } = Families::new(compiled, &joins, &wrapped);
    let mut waiting = trunk;
    while !waiting.is_empty() {
        let mut family = waiting.remove(next(&joins, &waiting, &done));
        match &family.root.whole {
            Some(whole) if !family.hung => {
                cone::let_down(compiled, &joins, (family.root, whole), &done, &mut positions);
            }
            _ => trunk::roll(compiled, &joins, &mut family, &done, &mut positions),
        }
        for member in &family.members {
            done[member.panel] = true;
        }
    }
    let clear_of = done.clone();
    for sleeve in &limbs {
        limb::wrap(compiled, &joins, sleeve, &clear_of, &mut positions);
        done[sleeve.root.number] = true;
        for (panel, _) in &sleeve.led {
            done[*panel] = true;
        }
    }
    led::follow(compiled, &joins, &mut done, &mut positions);
    positions
}

/// Which family to lay next: fronts and backs first, then what is sewn to something that lies, then
/// what is placed for itself.
fn next(joins: &Joins, waiting: &[Family], done: &[bool]) -> usize {
    let placed = |f: &Family| {
        f.members.iter().any(|m| matches!(m.side, Side::Before | Side::Behind)) && !f.hung
    };
    let led = |f: &Family| f.members.iter().any(|m| joins.of(m.panel).any(|s| done[s.other]));
    let first = |is: &dyn Fn(&Family) -> bool| waiting.iter().position(is);
    first(&placed).or_else(|| first(&led)).or_else(|| first(&|f| !f.hung)).unwrap_or(0)
}

/// A panel to be wrapped.
struct Wrapped<'a> {
    number: usize,
    body: &'a Surface,
    landmark: &'a str,
    level: Option<&'a str>,
    side: Side,
    anchor: f64,
    gap: f64,
    /// The ring that it is most of, if it is laid all round the trunk: a circular skirt, a cloak.
    whole: Option<Whole>,
}

impl Wrapped<'_> {
    fn panel<'c>(&self, compiled: &'c Compiled) -> &'c MeshPanel {
        &compiled.panels[self.number]
    }

    /// The middle line and radii of its limb, if the landmark is one.
    fn limb(&self) -> Option<(&[Point3<f64>], &[f64])> {
        match self.body.landmarks.get(self.landmark) {
            Some(Landmark::Limb { points, radii }) if points.len() > 1 => Some((points, radii)),
            _ => None,
        }
    }

    /// Whether two pieces may lie side by side: on one body in one layer, and neither a ring.
    fn may_adjoin(&self, other: &Wrapped, compiled: &Compiled) -> bool {
        std::ptr::eq(self.body, other.body)
            && self.panel(compiled).layer == other.panel(compiled).layer
            && self.whole.is_none()
            && other.whole.is_none()
    }

    /// Height of the landmark, m; fronts and backs come down from above the side of the neck, or
    /// they would be pushed up against it in a fold.
    fn height(&self) -> f64 {
        let hangs = self.landmark == "neck" && matches!(self.side, Side::Before | Side::Behind);
        match self.body.landmarks.get("neck_side.left").filter(|_| hangs) {
            Some(Landmark::Point(point)) => point.y + ABOVE,
            _ => centre(self.body, self.landmark).y,
        }
    }
}

/// Middle of a landmark; a body's own middle where it has no such place.
fn centre(body: &Surface, landmark: &str) -> Point3<f64> {
    match body.landmarks.get(landmark) {
        Some(Landmark::Point(point)) => *point,
        Some(Landmark::Ring { centre, .. }) => *centre,
        Some(Landmark::Limb { points, .. }) => points.first().copied().unwrap_or_default(),
        None => {
            let top = body.vertices.iter().map(|v| v.y).fold(0.0, f64::max);
            Point3::new(0.0, 0.6 * top, 0.0)
        }
    }
}

/// Particle numbers of a panel with their places in its drawing, m.
fn drawing<'a>(
    compiled: &'a Compiled,
    panel: &'a MeshPanel,
) -> impl Iterator<Item = (usize, [f64; 2])> + 'a {
    let (sin, cos) = (libm::sin(panel.grain), libm::cos(panel.grain));
    panel.particles.range().map(move |k| {
        let [u, v] = compiled.particles[k];
        (k, [u * cos - v * sin, u * sin + v * cos])
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::surface::{BodyPart, SurfaceKind};
    use crate::mesh::compiled::{MeshSeam, Stretch};

    /// An upright post of radius 0.1 m and height 1.5 m that calls its middle the waist.
    fn post() -> Surface {
        let mut post = Surface { kind: SurfaceKind::Body, ..Default::default() };
        for k in 0..150 {
            for j in 0..36 {
                let angle = std::f64::consts::TAU * f64::from(j) / 36.0;
                let y = f64::from(k) * 0.01;
                post.vertices.push(Point3::new(0.1 * libm::cos(angle), y, 0.1 * libm::sin(angle)));
                post.parts.push(BodyPart::Trunk);
            }
        }
        let waist = Landmark::Ring {
            centre: Point3::new(0.0, 1.0, 0.0),
            axis: Vector3::y(),
            points: Vec::new(),
        };
        post.landmarks.insert("waist".to_owned(), waist);
        let limb = Landmark::Limb {
            points: vec![Point3::new(0.1, 1.4, 0.0), Point3::new(0.4, 1.0, 0.0)],
            radii: vec![0.05, 0.03],
        };
        post.landmarks.insert("arm.left".to_owned(), limb);
        post
    }

    /// Adds a rectangle `width × height` centred on x = 0, hanging down from y = 0.
    fn rectangle(mesh: &mut Compiled, size: [f64; 2], placement: Placement) {
        let (cell, start) = (0.02, mesh.particles.len() as u32);
        let (n, m) = ((size[0] / cell).round() as i32, (size[1] / cell).round() as i32);
        for j in 0..=m {
            for i in 0..=n {
                mesh.particles
                    .push([f64::from(i) * cell - size[0] / 2.0, f64::from(j) * cell - size[1]]);
                mesh.lattice.push([i, j]);
            }
        }
        let at = |i: i32, j: i32| start + (j * (n + 1) + i) as u32;
        let sides: [Vec<u32>; 4] = [
            (0..n).map(|i| at(i, 0)).collect(),
            (0..m).map(|j| at(n, j)).collect(),
            (1..=n).rev().map(|i| at(i, m)).collect(),
            (1..=m).rev().map(|j| at(0, j)).collect(),
        ];
        let outline = sides.concat();
        mesh.panels.push(MeshPanel {
            name: format!("p{}", mesh.panels.len()),
            fabric: 0,
            cell,
            layer: 0,
            grain: 0.0,
            placement,
            particles: Stretch { start, end: mesh.particles.len() as u32 },
            cells: Stretch::default(),
            triangles: Stretch::default(),
            loops: vec![outline],
            edges: Vec::new(),
            surfaces: Vec::new(),
        });
    }

    fn wrapped(side: Side, landmark: &str) -> Placement {
        Placement::Wrapped {
            body: 0,
            landmark: landmark.to_owned(),
            level: None,
            side,
            anchor: 0.0,
            gap: 0.03,
        }
    }

    #[test]
    fn fronts_and_backs_begin_outside_the_body_with_their_widths_kept() {
        let mut mesh = Compiled::default();
        rectangle(&mut mesh, [0.5, 0.4], wrapped(Side::Before, "waist"));
        rectangle(&mut mesh, [0.5, 0.4], wrapped(Side::Behind, "waist"));
        let positions = place(&mesh, &[post()]);
        for p in &positions {
            assert!(libm::hypot(p.x, p.z) > 0.12, "{p} begins in the post");
            assert!((0.6 - 1e-9..=1.0 + 1e-9).contains(&p.y));
        }
        // Where the line round the post turns a corner of at most 10°, a chord falls short of the
        // way by at most 1 − cos 5° = 0.4 %.
        for k in 0..25 {
            let chord = (positions[k + 1] - positions[k]).norm();
            assert!((chord / 0.02 - 1.0).abs() < 4e-3, "row edge {k} measures {chord}");
        }
        // The left edge of the front and of the back meet at the wearer's left.
        let (front_left, back_left) = (positions[25], positions[26 * 21]);
        assert!(front_left.x > 0.1 && back_left.x > 0.1);
        assert!((front_left - back_left).norm() < 0.03);
        assert!(positions[12].z > 0.1, "the middle of the front lies in front");
    }

    #[test]
    fn a_sleeve_goes_round_its_arm_clear_of_the_trunk_cloth() {
        let mut mesh = Compiled::default();
        rectangle(&mut mesh, [0.5, 0.6], wrapped(Side::Around, "waist"));
        rectangle(&mut mesh, [0.4, 0.3], wrapped(Side::Around, "arm.left"));
        let positions = place(&mesh, &[post()]);
        let (start, axis) = (Point3::new(0.1, 1.4, 0.0), Vector3::new(0.6, -0.8, 0.0));
        for k in mesh.panels[1].particles.range() {
            let out = positions[k] - start;
            let away = (out - axis * out.dot(&axis)).norm();
            assert!(away > 0.06, "the sleeve lies {away} from the arm's middle line");
            for j in mesh.panels[0].particles.range() {
                assert!((positions[k] - positions[j]).norm() > 0.01);
            }
        }
    }

    #[test]
    fn a_panel_nobody_places_goes_on_where_its_neighbour_ends() {
        let mut mesh = Compiled::default();
        let flat = Placement::Flat { at: [0.0, 1.0, 0.2], turn: [0.0; 3] };
        rectangle(&mut mesh, [0.2, 0.1], flat);
        rectangle(&mut mesh, [0.2, 0.1], Placement::Led);
        // The lower edge of the first (row 0) to the upper edge of the second (row 5).
        let second = mesh.panels[1].particles.start;
        let pairs = (0..=10).map(|i| [i, second + 5 * 11 + i]).collect();
        mesh.seams.push(MeshSeam { name: "a -> b".to_owned(), pairs });
        let positions = place(&mesh, &[]);
        for [a, b] in &mesh.seams[0].pairs {
            assert!((positions[*a as usize] - positions[*b as usize]).norm() < 1e-6);
        }
        let low = positions[second as usize];
        assert!((low.y - 0.8).abs() < 1e-6, "it hangs on below the first: {low}");
    }

    /// Sews the right edge of one rectangle to the left edge of another; both have 21 rows.
    fn sew_sides(mesh: &mut Compiled, from: usize, to: usize) {
        let (a, b) = (mesh.panels[from].particles, mesh.panels[to].particles);
        let columns = |p: Stretch| (p.end - p.start) / 21;
        let pairs = (0..21)
            .map(|row| [a.start + (row + 1) * columns(a) - 1, b.start + row * columns(b)])
            .collect();
        mesh.seams.push(MeshSeam { name: format!("{from} -> {to}"), pairs });
    }

    #[test]
    fn gores_sewn_in_a_round_each_take_their_own_part_of_it() {
        let mut mesh = Compiled::default();
        for _ in 0..6 {
            rectangle(&mut mesh, [0.2, 0.4], wrapped(Side::Around, "waist"));
        }
        for gore in 0..6 {
            sew_sides(&mut mesh, gore, (gore + 1) % 6);
        }
        let positions = place(&mesh, &[post()]);
        for (gore, panel) in mesh.panels.iter().enumerate() {
            let middle: Vector3<f64> =
                panel.particles.range().map(|k| positions[k].coords).sum::<Vector3<f64>>()
                    / panel.particles.range().len() as f64;
            let angle = libm::atan2(middle.x, middle.z) / std::f64::consts::TAU;
            let off = angle - gore as f64 / 6.0;
            assert!((off - off.round()).abs() < 0.01, "gore {gore} lies at {angle} of the round");
        }
        for seam in &mesh.seams {
            for [a, b] in &seam.pairs {
                // Chords of the round are shorter than it; nothing lies on its neighbour.
                let gap = (positions[*a as usize] - positions[*b as usize]).norm();
                assert!((1e-3..0.03).contains(&gap), "{}: {gap}", seam.name);
            }
        }
    }

    #[test]
    fn side_pieces_close_the_round_between_a_front_and_a_back() {
        let mut mesh = Compiled::default();
        rectangle(&mut mesh, [0.3, 0.4], wrapped(Side::Before, "waist"));
        rectangle(&mut mesh, [0.2, 0.4], Placement::Led);
        rectangle(&mut mesh, [0.3, 0.4], wrapped(Side::Behind, "waist"));
        sew_sides(&mut mesh, 0, 1);
        sew_sides(&mut mesh, 1, 2);
        let positions = place(&mesh, &[post()]);
        let side = mesh.panels[1].particles.range();
        let middle: Vector3<f64> = side.clone().map(|k| positions[k].coords).sum();
        assert!(middle.x > 0.0, "it lies at the wearer's left");
        for k in side {
            let p = positions[k];
            assert!(libm::hypot(p.x, p.z) > 0.12 && (0.6 - 1e-9..=1.0 + 1e-9).contains(&p.y));
        }
        for [a, b] in mesh.seams.iter().flat_map(|seam| &seam.pairs) {
            assert!((positions[*a as usize] - positions[*b as usize]).norm() < 0.02);
        }
    }

    #[test]
    fn a_waistband_that_nobody_places_goes_round_above_its_skirt() {
        let mut mesh = Compiled::default();
        rectangle(&mut mesh, [0.36, 0.4], wrapped(Side::Before, "waist"));
        rectangle(&mut mesh, [0.36, 0.4], wrapped(Side::Behind, "waist"));
        rectangle(&mut mesh, [0.72, 0.04], Placement::Led);
        let band = mesh.panels[2].particles.start;
        // The upper edges of front and back to the lower edge of the band.
        for (panel, first) in [(0, 0), (1, 18)] {
            let top = mesh.panels[panel].particles.start + 20 * 19;
            let pairs = (0..19).map(|i| [top + i, band + first + i]).collect();
            mesh.seams.push(MeshSeam { name: "band".to_owned(), pairs });
        }
        let positions = place(&mesh, &[post()]);
        for k in mesh.panels[2].particles.range() {
            let p = positions[k];
            assert!(libm::hypot(p.x, p.z) > 0.1, "{p} begins in the post");
            assert!((1.0 - 1e-6..1.05).contains(&p.y), "{p} is not above the skirt");
        }
        for seam in &mesh.seams {
            for [a, b] in &seam.pairs {
                let gap = positions[*a as usize] - positions[*b as usize];
                assert!(gap.norm() < 0.06, "the band is turned away from its skirt: {gap}");
            }
        }
    }
}
