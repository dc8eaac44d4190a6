//! Better triangles for the band: free points are moved, put in and taken out, and cells next
//! to the band given up, until no angle is too sharp.
//!
//! Every change is judged by the sharpest angle before and after, as its cosine
//! ([`sharpest`]): the triangulation is Delaunay's, which has the largest smallest angle for
//! its points (Lawson 1977), so only the points have to be chosen. Where to put a point in is
//! the idea of Ruppert (1995); the cut line is never split, because sewing partners count on it.

use super::band::{Band, Drawn, Role};
use super::triangulation::NONE;
use crate::geometry::polygon::{Place, between, distance, sharpest, turn};

/// cos 20°: triangles may not be sharper.
pub const LIMIT: f64 = 0.939_692_620_785_908_4;
/// cos 23°: what is aimed at.
const AIM: f64 = 0.920_504_853_452_440_4;
/// cos 30°: free points of triangles sharper than this are moved at first.
const EASE: f64 = 0.866_025_403_784_438_6;
/// Rounds of changes at most.
const ROUNDS: usize = 24;
/// Rounds of moving before the first of them.
const MOVES: usize = 3;

/// Improves the band and draws it; `None` when its outline cannot be triangulated.
pub fn improve(band: &mut Band) -> Option<Drawn> {
    let mut drawn = band.draw()?;
    for round in 0..ROUNDS {
        // The first rounds polish; the later ones only mend what may not stay.
        let (aim, ease_from, moves) = match round {
            0 => (AIM, EASE, MOVES),
            1..=3 => (AIM, AIM, 1),
            _ => (LIMIT, LIMIT, 1),
        };
        for _ in 0..moves {
            if !ease(band, &mut drawn, ease_from) {
                break;
            }
            drawn = band.draw()?;
        }
        if !mend(band, &drawn, aim, round % 2 == 1) {
            break;
        }
        drawn = band.draw()?;
    }
    Some(drawn)
}

/// The triangles around each point: numbers in one list, and where each point's begin.
struct Stars {
    first: Vec<usize>,
    triangles: Vec<u32>,
}

impl Stars {
    fn new(drawn: &Drawn) -> Self {
        let mut first = vec![0; drawn.places.len() + 1];
        for &corner in drawn.mesh.triangles.iter().flatten() {
            first[corner as usize + 1] += 1;
        }
        for point in 0..drawn.places.len() {
            first[point + 1] += first[point];
        }
        let mut next = first.clone();
        let mut triangles = vec![0; drawn.mesh.triangles.len() * 3];
        for (number, corners) in drawn.mesh.triangles.iter().enumerate() {
            for &corner in corners {
                triangles[next[corner as usize]] = number as u32;
                next[corner as usize] += 1;
            }
        }
        Stars { first, triangles }
    }

    fn around(&self, point: usize) -> &[u32] {
        &self.triangles[self.first[point]..self.first[point + 1]]
    }
}

fn sharpness(drawn: &Drawn, triangle: u32) -> f64 {
    let [a, b, c] = drawn.mesh.triangles[triangle as usize].map(|k| drawn.places[k as usize]);
    sharpest(a, b, c)
}

/// The sharpest angle of the fan from `hub` to sides.
fn fan(hub: Place, sides: &[(Place, Place)]) -> f64 {
    sides.iter().map(|&(a, b)| sharpest(a, b, hub)).fold(-1.0, f64::max)
}

/// Searches around `start` for the place from which the fan to `sides` is least sharp.
fn best_place(start: Place, reach: f64, sides: &[(Place, Place)]) -> (Place, f64) {
    let (mut place, mut worst) = (start, fan(start, sides));
    let mut step = reach;
    // Ever smaller gains are not followed for ever.
    for _ in 0..24 {
        if step <= reach / 40.0 {
            break;
        }
        let diagonal = step * std::f64::consts::FRAC_1_SQRT_2;
        let ways = [
            [step, 0.0],
            [diagonal, diagonal],
            [0.0, step],
            [-diagonal, diagonal],
            [-step, 0.0],
            [-diagonal, -diagonal],
            [0.0, -step],
            [diagonal, -diagonal],
        ];
        let mut moved = false;
        for way in ways {
            let there = [place[0] + way[0], place[1] + way[1]];
            let sharp = fan(there, sides);
            if sharp < worst {
                (place, worst, moved) = (there, sharp, true);
            }
        }
        if !moved {
            step /= 2.0;
        }
    }
    (place, worst)
}

/// Moves free points of triangles sharper than `from`; tells whether any was.
fn ease(band: &mut Band, drawn: &mut Drawn, from: f64) -> bool {
    let stars = Stars::new(drawn);
    let mut moved = vec![false; drawn.places.len()];
    for point in 0..drawn.places.len() {
        if !drawn.roles[point].free() {
            continue;
        }
        let star = stars.around(point);
        let worst = star.iter().map(|&t| sharpness(drawn, t)).fold(-1.0, f64::max);
        if worst <= from {
            continue;
        }
        let rim = rim(drawn, star, point);
        let shortest = rim
            .iter()
            .map(|&(a, _)| distance(a, drawn.places[point]))
            .fold(f64::INFINITY, f64::min);
        let (place, sharp) = best_place(drawn.places[point], shortest / 2.0, &rim);
        if sharp < worst - 1e-3 {
            drawn.places[point] = place;
            moved[point] = true;
        }
    }
    let mut any = false;
    for point in (0..drawn.places.len()).filter(|&point| moved[point]) {
        band.move_to(drawn.roles[point], drawn.places[point]);
        any = true;
    }
    any
}

/// The sides opposite a point in its star.
fn rim(drawn: &Drawn, star: &[u32], point: usize) -> Vec<(Place, Place)> {
    let place = |corner: u32| drawn.places[corner as usize];
    star.iter()
        .filter_map(|&t| {
            let corners = drawn.mesh.triangles[t as usize];
            let k = corners.iter().position(|&corner| corner as usize == point)?;
            Some((place(corners[(k + 1) % 3]), place(corners[(k + 2) % 3])))
        })
        .collect()
}

enum Change {
    PutIn(Place),
    TakeOut(usize),
}

/// Changes the points around triangles sharper than `aim`, and with `boldly` gives up cells even
/// where a change of points would help a little; tells whether anything was changed.
fn mend(band: &mut Band, drawn: &Drawn, aim: f64, boldly: bool) -> bool {
    let count = drawn.mesh.triangles.len() as u32;
    let mut sharp: Vec<(f64, u32)> =
        (0..count).map(|t| (sharpness(drawn, t), t)).filter(|&(worst, _)| worst > aim).collect();
    sharp.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    if sharp.is_empty() {
        return false;
    }
    let stars = Stars::new(drawn);
    let mut touched = vec![false; drawn.places.len()];
    let mut changed = false;
    for (worst, triangle) in sharp {
        let corners = drawn.mesh.triangles[triangle as usize].map(|k| k as usize);
        if corners.iter().any(|&corner| touched[corner]) {
            continue;
        }
        let mut best: Option<(f64, Change, Vec<u32>)> = None;
        let mut offer = |sharp: f64, change: Change, area: Vec<u32>| {
            if sharp < worst - 1e-3 && best.as_ref().is_none_or(|b| sharp < b.0) {
                best = Some((sharp, change, area));
            }
        };
        if let Some((place, sharp, area)) = put_in(drawn, triangle) {
            offer(sharp, Change::PutIn(place), area);
        }
        for &corner in corners.iter().filter(|&&corner| drawn.roles[corner].free()) {
            let star = stars.around(corner);
            if let Some(sharp) = without(drawn, star, corner) {
                offer(sharp, Change::TakeOut(corner), star.to_vec());
            }
        }
        let good = best.as_ref().is_some_and(|b| b.0 <= aim);
        if !good && boldly || best.is_none() {
            // Nothing here helps while the cells stand where they do.
            let mut released = false;
            for corner in corners {
                if let Role::Corner(point) = drawn.roles[corner] {
                    released |= band.release(point);
                }
            }
            if released {
                for &t in corners.iter().flat_map(|&corner| stars.around(corner)) {
                    for k in drawn.mesh.triangles[t as usize] {
                        touched[k as usize] = true;
                    }
                }
                changed = true;
                continue;
            }
        }
        let Some((_, change, area)) = best else { continue };
        let reached = || area.iter().flat_map(|&t| drawn.mesh.triangles[t as usize]);
        if reached().any(|corner| touched[corner as usize]) {
            continue;
        }
        match change {
            Change::PutIn(place) => band.loose.push(Some(place)),
            Change::TakeOut(corner) => band.remove(drawn.roles[corner]),
        }
        reached().for_each(|corner| touched[corner as usize] = true);
        changed = true;
    }
    changed
}

/// The best place for a new point near a sharp triangle, the sharpest angle it would leave, and
/// the triangles it would replace.
fn put_in(drawn: &Drawn, triangle: u32) -> Option<(Place, f64, Vec<u32>)> {
    let [a, b, c] = drawn.mesh.triangles[triangle as usize].map(|k| drawn.places[k as usize]);
    let centre = circumcentre(a, b, c)?;
    let middle = [(a[0] + b[0] + c[0]) / 3.0, (a[1] + b[1] + c[1]) / 3.0];
    let mut best: Option<(Place, f64, Vec<u32>)> = None;
    for share in [1.0, 0.7, 0.4, 0.0] {
        let start = between(middle, centre, share);
        let Some(home) = walk(drawn, triangle, middle, start) else { continue };
        let area = cavity(drawn, home, start);
        let sides = hull(drawn, &area);
        let reach = sides.iter().map(|&(p, _)| distance(p, start)).fold(f64::INFINITY, f64::min);
        let (place, sharp) = best_place(start, reach / 2.0, &sides);
        if best.as_ref().is_none_or(|b| sharp < b.1) {
            best = Some((place, sharp, area));
        }
    }
    best
}

fn circumcentre(a: Place, b: Place, c: Place) -> Option<Place> {
    let double = 2.0 * turn(a, b, c);
    if double <= 0.0 {
        return None;
    }
    let (p, q) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
    let (pp, qq) = (p[0] * p[0] + p[1] * p[1], q[0] * q[0] + q[1] * q[1]);
    Some([a[0] + (q[1] * pp - p[1] * qq) / double, a[1] + (p[0] * qq - q[0] * pp) / double])
}

/// The triangle that holds `to`, walking straight from `from` in `triangle`; `None` when a fixed
/// side stands between.
fn walk(drawn: &Drawn, mut triangle: u32, from: Place, to: Place) -> Option<u32> {
    let mut came_from = NONE;
    for _ in 0..drawn.mesh.triangles.len() {
        let corners = drawn.mesh.triangles[triangle as usize].map(|k| drawn.places[k as usize]);
        let across = drawn.mesh.across[triangle as usize];
        let exit = (0..3).find(|&k| {
            let (p, q) = (corners[k], corners[(k + 1) % 3]);
            let leaves = turn(p, q, to) < 0.0;
            let straddles = turn(from, to, p) <= 0.0 && turn(from, to, q) >= 0.0;
            leaves && straddles && (across[k] == NONE || across[k] != came_from)
        });
        match exit {
            None => {
                let holds = (0..3).all(|k| turn(corners[k], corners[(k + 1) % 3], to) >= 0.0);
                return holds.then_some(triangle);
            }
            Some(k) if across[k] == NONE => return None,
            Some(k) => {
                came_from = triangle;
                triangle = across[k];
            }
        }
    }
    None
}

/// The triangles whose circles hold `place`, from `home` as far as no fixed side stands between
/// (Bowyer 1981, Watson 1981).
fn cavity(drawn: &Drawn, home: u32, place: Place) -> Vec<u32> {
    let mut area = vec![home];
    let mut at = 0;
    while let Some(&triangle) = area.get(at) {
        at += 1;
        for other in drawn.mesh.across[triangle as usize] {
            if other != NONE && !area.contains(&other) {
                let [a, b, c] =
                    drawn.mesh.triangles[other as usize].map(|k| drawn.places[k as usize]);
                if circumcentre(a, b, c)
                    .is_some_and(|centre| distance(centre, place) < distance(centre, a))
                {
                    area.push(other);
                }
            }
        }
    }
    area
}

/// The sides around an area of triangles.
fn hull(drawn: &Drawn, area: &[u32]) -> Vec<(Place, Place)> {
    let mut sides = Vec::new();
    for &triangle in area {
        let corners = drawn.mesh.triangles[triangle as usize].map(|k| drawn.places[k as usize]);
        for (k, other) in drawn.mesh.across[triangle as usize].into_iter().enumerate() {
            if other == NONE || !area.contains(&other) {
                sides.push((corners[k], corners[(k + 1) % 3]));
            }
        }
    }
    sides
}

/// The sharpest angle of the best triangles in the place of a star, without its hub; `None` when
/// the star is not closed or too large to try.
fn without(drawn: &Drawn, star: &[u32], hub: usize) -> Option<f64> {
    let mut sides = rim(drawn, star, hub);
    let count = sides.len();
    if !(3..=12).contains(&count) {
        return None;
    }
    let (first, mut end) = sides.swap_remove(0);
    let mut ring = vec![first];
    while let Some(next) = sides.iter().position(|side| side.0 == end) {
        ring.push(end);
        end = sides.swap_remove(next).1;
    }
    if end != first || ring.len() != count {
        return None;
    }
    // The triangulation of a polygon with the least sharp angle, by sub-polygons from corner i
    // to corner j (Klincsek 1980).
    let mut sharp = vec![vec![-1.0f64; count]; count];
    for span in 2..count {
        for i in 0..count - span {
            let j = i + span;
            sharp[i][j] = (i + 1..j)
                .map(|k| sharpest(ring[i], ring[k], ring[j]).max(sharp[i][k]).max(sharp[k][j]))
                .fold(1.0, f64::min);
        }
    }
    Some(sharp[0][count - 1])
}
