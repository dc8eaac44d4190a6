//! Cloth and bodies to a drape: sewing, contact, gravity, rest.

pub mod air;
pub mod bending;
pub mod chord;
pub mod cloth;
pub mod cord;
pub mod crease;
pub mod crossing;
pub mod doubled;
pub mod draped;
pub mod elastic;
pub mod gather;
pub mod grid;
pub mod hold;
pub mod iron;
pub mod ladder;
pub mod lay;
pub mod layers;
pub mod matrix;
pub mod membrane;
pub mod nearby;
pub mod patch;
pub mod place;
pub mod precondition;
pub mod proximity;
pub mod rim;
pub mod schedule;
pub mod sewing;
pub mod shear;
pub mod skin;
pub mod stats;
pub mod step;
pub mod system;
pub mod tension;
pub mod weld;

#[cfg(test)]
mod swatch;
#[cfg(test)]
mod trials;

use crate::body;
use crate::body::surface::{Surface, SurfaceKind};
use crate::diagnostic::Diagnostic;
use crate::garment::scene::Phase;
use crate::mesh::compiled::Compiled;
use crate::progress::Progress;
use draped::{Draped, Stats, Verdict};
use nalgebra::{Point3, Vector3};
use schedule::Course;
use skin::{Figures, Skin};
use std::time::Instant;
use step::{Stuck, Workshop};
use weld::Weld;

/// What can be asked of a drape besides what the garment's own schedule says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Density of the air, kg/m³; none at 0.
    pub air: f64,
}

impl Default for Options {
    fn default() -> Self {
        Options { air: 1.2 }
    }
}

/// Sews the garment, dresses the body, lets it come to rest.
///
/// `rungs` is one garment compiled on ever finer grids; the last is the one asked for. The seams
/// are closed and the cloth first settled on the coarsest.
///
/// # Errors
/// What is wrong with the bodies asked for; E0805 if there is no mesh at all.
pub fn drape(
    rungs: &[Compiled],
    options: &Options,
    progress: &mut dyn Progress,
) -> Result<Draped, Vec<Diagnostic>> {
    let Some(finest) = rungs.last() else {
        return Err(vec![Diagnostic::new("E0805", "there is no cloth to drape")]);
    };
    let mut surfaces = Vec::new();
    let mut wrong = Vec::new();
    for request in &finest.bodies {
        match body::mannequin(request) {
            Ok(surface) => surfaces.push(surface),
            Err(diagnostics) => wrong.extend(diagnostics),
        }
    }
    if wrong.iter().any(Diagnostic::is_error) {
        return Err(wrong);
    }
    let bodies = surfaces.len();
    surfaces.extend(finest.solids.iter().map(body::solid));
    let skin = Figures::new(&surfaces);
    let place = |compiled: &Compiled| -> Vec<Vector3<f64>> {
        let mut places = place::place(compiled, &surfaces[..bodies]);
        lay::patches(compiled, &mut places);
        places.iter().map(|p| p.coords).collect()
    };
    let near: Vec<Compiled>;
    let rungs = if rungs.iter().any(|compiled| !compiled.nearby.is_empty()) {
        near = rungs.iter().map(|compiled| nearby::sewn(compiled, &place(compiled))).collect();
        &near[..]
    } else {
        rungs
    };
    // Among the threads from the start: to be called to them for every small piece of work costs more
    // than the work.
    let (positions, stats) =
        rayon::scope(|_| dress(rungs, &surfaces, &skin, &place, options, progress));
    Ok(Draped { positions: positions.into_iter().map(Point3::from).collect(), surfaces, stats })
}

/// Share of the wearer's height under which a garment's middle does not hang but lie.
const LOW: f64 = 0.1;

/// Times that a cloth at rest is raised off sharp edges and brought to rest again, and the longest
/// that each may take, s.
const RAISINGS: usize = 3;
const AGAIN: f64 = 5.0;

/// A cloth whose seams have been closed and pressed.
struct SewnUp<'a> {
    shop: Workshop<'a>,
    course: Result<Course, Stuck>,
    /// The widest gap that was left, m, and its seam; none if all were closed.
    open: Option<(f64, usize)>,
    /// How many pairs of faces cut each other.
    cuts: usize,
}

impl SewnUp<'_> {
    /// The lower the better.
    fn rank(&self) -> (bool, bool, usize) {
        (self.course.is_err(), self.open.is_some(), self.cuts)
    }
}

/// Closes the seams until none is wider than the gap, in turn or all at once, and presses them.
fn sew_up<'a>(
    mut shop: Workshop<'a>,
    (surfaces, skin): (&[Surface], &'a dyn Skin),
    (gap, in_turn): (f64, bool),
    progress: &mut dyn Progress,
) -> SewnUp<'a> {
    let compiled = shop.compiled();
    let course = schedule::sew(&mut shop, gap, in_turn, true, progress);
    let open = course.is_ok_and(|c| !c.reached).then(|| shop.sewing.gap(&shop.x));
    let closed = shop.positions();
    let seams = compiled.seams.iter().flat_map(|s| s.pairs.iter().copied());
    let weld = Weld::new(compiled.particles.len(), seams);
    let ironed = iron::iron(compiled, (surfaces, skin), &weld, closed.clone());
    let (places, ironing) = ironed.unwrap_or((closed, 0));
    let mut shop = Workshop::new(compiled, surfaces, skin, weld, &places);
    // Cloth that still cuts itself smooths out better without layers in the way.
    let apart = crossing::count(compiled, &places) == 0;
    let pressed = schedule::press(&mut shop, apart);
    let course = course.and_then(|course| {
        pressed.map(|p| Course { steps: course.steps + ironing + p.steps, ..course })
    });
    let cuts = crossing::count(compiled, &shop.positions());
    SewnUp { shop, course, open, cuts }
}

/// Sews and drapes over given skin, from given first places.
pub fn dress(
    rungs: &[Compiled],
    surfaces: &[Surface],
    skin: &dyn Skin,
    place: &(dyn Fn(&Compiled) -> Vec<Vector3<f64>> + Sync),
    options: &Options,
    progress: &mut dyn Progress,
) -> (Vec<Vector3<f64>>, Stats) {
    let Some(finest) = rungs.last() else { return (Vec::new(), Stats::default()) };
    let prefix = finest.schedule.iter().take_while(|p| !matches!(p, Phase::Run { .. })).count();
    // What runs by the clock begins where the text puts it; only rest is sought coarse to fine.
    let rungs = if prefix == 0 { &rungs[rungs.len() - 1..] } else { rungs };
    let mut seconds = std::collections::BTreeMap::new();
    let mut steps = 0;
    let mut reason: Option<String> = None;
    let mut last = Course { reached: true, ..Course::default() };
    let mut carried: Option<(Vec<Vector3<f64>>, bool, bool)> = None;
    let mut result = Vec::new();
    let mut asked_rest = false;
    let mut held = true;
    for (rung, compiled) in rungs.iter().enumerate() {
        let fine = rung + 1 == rungs.len();
        let (start, sewn, mut shut) = match carried.take() {
            Some(carried) => carried,
            None => (place(compiled), false, false),
        };
        let seams = || compiled.seams.iter().flat_map(|s| s.pairs.iter().copied());
        let closures = || compiled.closures.iter().flat_map(|s| s.pairs.iter().copied());
        let held_together = seams().filter(|_| sewn).chain(closures().filter(|_| shut));
        let weld = Weld::new(compiled.particles.len(), held_together);
        let tied: Compiled;
        let whole = if compiled.ties.is_empty() {
            compiled
        } else {
            tied = cord::tied(compiled);
            &tied
        };
        let now = if shut { whole } else { compiled };
        let mut shop = Workshop::new(now, surfaces, skin, weld, &start);
        let mut fresh = rung == 0;
        let mut sewn = sewn;
        let phases = if fine { &finest.schedule[..] } else { &finest.schedule[..prefix] };
        for phase in phases {
            let clock = Instant::now();
            let (name, course) = match *phase {
                Phase::Sew { gap, .. } => {
                    if sewn || shop.sewing.pairs.is_empty() {
                        continue;
                    }
                    progress.stage("sew");
                    let gap = gap.max(1e-5);
                    let turns = shop.sewing.has_turns();
                    let figures = (surfaces, skin);
                    let mut sewn_up = sew_up(shop, figures, (gap, true), progress);
                    if turns && !(sewn_up.open.is_none() && sewn_up.cuts == 0) {
                        // All at once it may go better.
                        let weld = Weld::new(compiled.particles.len(), std::iter::empty());
                        let again = Workshop::new(compiled, surfaces, skin, weld, &start);
                        let other = sew_up(again, figures, (gap, false), progress);
                        if other.rank() < sewn_up.rank() {
                            sewn_up = other;
                        }
                    }
                    if let Some((gap, seam)) = sewn_up.open {
                        let name = compiled.seams.get(seam).map_or("", |s| s.name.as_str());
                        reason.get_or_insert(format!(
                            "the seam `{name}` did not close: {:.1} mm are left",
                            gap * 1e3
                        ));
                    }
                    shop = sewn_up.shop;
                    sewn = true;
                    let course = sewn_up.course;
                    ("sew", course)
                }
                Phase::Close { gap, .. } => {
                    if shut || (compiled.closures.is_empty() && compiled.ties.is_empty()) {
                        continue;
                    }
                    progress.stage("close");
                    // Two layers that are kept apart never come to one button.
                    let places = shop.positions();
                    let weld = Weld::new(compiled.particles.len(), seams().filter(|_| sewn));
                    let mut open = compiled.clone();
                    open.seams.append(&mut open.closures);
                    shop = Workshop::new(&open, surfaces, skin, weld, &places);
                    let course = schedule::sew(&mut shop, gap.max(1e-5), false, false, progress);
                    if course.is_ok_and(|c| !c.reached) {
                        let (gap, _) = shop.sewing.gap(&shop.x);
                        reason.get_or_insert(format!(
                            "the buttons did not close: {:.1} mm are left",
                            gap * 1e3
                        ));
                    }
                    let places = shop.positions();
                    let weld = Weld::new(
                        compiled.particles.len(),
                        seams().filter(|_| sewn).chain(closures()),
                    );
                    shop = Workshop::new(whole, surfaces, skin, weld, &places);
                    shut = true;
                    ("close", course)
                }
                Phase::Settle { speed, within, .. } => {
                    progress.stage("settle");
                    let (speed, within) = if fine {
                        asked_rest = true;
                        (speed, within)
                    } else {
                        (speed * 5.0, within.min(6.0))
                    };
                    let mut course =
                        schedule::settle(&mut shop, (speed, within), fresh, options.air, progress);
                    // Chords that still cut through a sharp edge: once more, with their knots raised.
                    for _ in 0..RAISINGS {
                        let Ok(so_far) = course else { break };
                        if !fine || !shop.raise() {
                            break;
                        }
                        let pace = (speed, within.min(AGAIN));
                        course = schedule::settle(&mut shop, pace, false, options.air, progress)
                            .map(|c| Course { steps: c.steps + so_far.steps, ..c });
                    }
                    if let (true, Ok(course)) = (fine, course)
                        && !course.reached
                    {
                        reason.get_or_insert(format!(
                            "not at rest after {within} s: {:.1} mm/s are left",
                            course.speed * 1e3
                        ));
                    }
                    fresh = false;
                    ("settle", course)
                }
                Phase::Run { time, rate, .. } => {
                    progress.stage("run");
                    asked_rest = false;
                    ("run", schedule::run(&mut shop, time, rate, options.air, progress))
                }
            };
            *seconds.entry(name.to_owned()).or_insert(0.0) += clock.elapsed().as_secs_f64();
            match course {
                Ok(course) => {
                    steps += course.steps;
                    last = course;
                }
                Err(Stuck) => {
                    reason.get_or_insert("the cloth could not be moved any further".to_owned());
                    last.reached = false;
                }
            }
        }
        if fine {
            held = shop.is_held();
            shop.clear();
        }
        let places = shop.positions();
        if let Some(next) = rungs.get(rung + 1) {
            let mut places: Vec<Point3<f64>> =
                ladder::carry(compiled, &places, next).into_iter().map(Point3::from).collect();
            // Each carried by itself a patch and its host would cut each other.
            lay::patches(next, &mut places);
            carried = Some((places.iter().map(|p| p.coords).collect(), sewn, shut));
        } else {
            result = places;
        }
    }
    let mut stats = stats::measure(finest, &result, skin);
    stats.seconds = seconds;
    stats.steps = steps;
    stats.largest_speed = last.speed;
    let at_rest = asked_rest && last.reached;
    let height = surfaces
        .iter()
        .filter(|s| s.kind == SurfaceKind::Body)
        .flat_map(|s| s.vertices.iter().map(|v| v.y))
        .fold(0.0, f64::max);
    let middle = result.iter().map(|x| x.y).sum::<f64>() / result.len().max(1) as f64;
    // Nothing holds it, or it lies about the wearer's ankles.
    let fell = !held || middle < LOW * height;
    if fell && stats.deepest_penetration <= 1e-3 {
        reason.get_or_insert("the garment fell off".to_owned());
    }
    let cuts = stats.self_intersections;
    if cuts > 0 && !fell && stats.deepest_penetration <= 1e-3 {
        let most = match crossing::worst(finest, &result) {
            Some([a, b]) if a == b => format!("of `{a}`"),
            Some([a, b]) => format!("of `{a}` and `{b}`"),
            None => String::new(),
        };
        reason.get_or_insert(format!(
            "the cloth passes through itself: {cuts} pairs of faces cut each other, most of them \
             {most}"
        ));
    }
    stats.verdict = if stats.deepest_penetration > 1e-3 {
        Verdict::Penetrating
    } else if fell {
        Verdict::FellOff
    } else if cuts > 0 {
        Verdict::Tangled
    } else if at_rest {
        Verdict::Settled
    } else {
        Verdict::StillMoving
    };
    stats.reason = reason;
    (result, stats)
}
