//! The lines of a drape schedule: sew, settle, run.

use super::step::{Manner, Stuck, Workshop};
use super::system::Aim;
use crate::progress::Progress;

/// How a line of the schedule went.
#[derive(Clone, Copy, Debug, Default)]
pub struct Course {
    /// Steps taken.
    pub steps: usize,
    /// Time of the cloth that passed, s.
    pub time: f64,
    /// Largest speed at the end, m/s.
    pub speed: f64,
    /// Whether what was asked for came to pass.
    pub reached: bool,
    /// Iterations of the linear solver, all steps together.
    pub iterations: usize,
}

/// Most steps to close the seams.
const SEWING_STEPS: usize = 600;

/// Gap at which body and sleeves count as closed before the sleeves are set in, m, and most steps
/// until then.
const TACKED: f64 = 5e-3;
const TACKING_STEPS: usize = 200;

/// How far along an open seam its cloth may pass through itself, m; then all along it, where it
/// would not close otherwise.
const ROOM: [f64; 2] = [0.05, f64::INFINITY];

/// Gap from which on it must no longer pass, m.
const NEARLY: f64 = 0.012;

/// Strength at which a seam that does not come nearer is given more room.
const STALLED: f64 = 10.0;

/// Most steps to press them, and the speed at which they are flat, m/s.
const PRESSING_STEPS: usize = 90;
const PRESSED: f64 = 0.01;

/// Most steps to smooth stiff cloth out.
const SMOOTHING_STEPS: usize = 30;

/// Time for which falling is left to itself, s, so that folds form as they would.
const FREE: f64 = 0.8;

/// Time over which a speed is measured, s.
const WINDOW: f64 = 0.25;

/// Draws the seams together, without gravity, until no pair is wider apart than `gap`, m. With
/// `layers` the cloth is kept apart meanwhile.
///
/// As a tailor does, `in_turn` first the body and the sleeves each for themselves, then the sleeves
/// are set in: drawn all at once, fronts and backs may get caught on the wrong side of a sleeve.
///
/// # Errors
/// [`Stuck`] from the step.
pub fn sew(
    shop: &mut Workshop<'_>,
    gap: f64,
    in_turn: bool,
    layers: bool,
    progress: &mut dyn Progress,
) -> Result<Course, Stuck> {
    let mut course = Course::default();
    if in_turn && shop.sewing.has_turns() {
        shop.sewing.waiting = true;
        draw_together(shop, (TACKED, TACKING_STEPS), layers, &mut course, progress)?;
        shop.sewing.waiting = false;
    }
    draw_together(shop, (gap, SEWING_STEPS), layers, &mut course, progress)?;
    Ok(course)
}

fn draw_together(
    shop: &mut Workshop<'_>,
    (gap, most): (f64, usize),
    layers: bool,
    course: &mut Course,
    progress: &mut dyn Progress,
) -> Result<(), Stuck> {
    let mut strength = 1.0f64;
    let first = shop.sewing.gap(&shop.x).0;
    let mut least = f64::INFINITY;
    let mut since = 0;
    let mut room = 0;
    course.reached = false;
    for _ in 0..most {
        let (widest, _) = shop.sewing.gap(&shop.x);
        if widest <= gap {
            course.reached = true;
            break;
        }
        progress.share(
            1.0 - (widest - gap) / (first - gap).max(1e-9),
            &format!("gap {:.1} mm", widest * 1e3),
        );
        // A seam that no longer comes nearer is drawn harder.
        if widest < 0.97 * least {
            least = widest;
            since = 0;
        } else {
            since += 1;
            if since >= 8 {
                strength = (strength * 1.6).min(200.0);
                since = 0;
                if strength > STALLED && room + 1 < ROOM.len() {
                    (strength, room) = (1.0, room + 1);
                }
            }
        }
        let taken = shop.step(&Manner {
            dt: 1.0 / 30.0,
            gravity: 0.0,
            air: 0.0,
            calm: 10.0,
            grip: 0.05,
            sewing: strength,
            room: if room == 0 && widest < NEARLY { 0.0 } else { ROOM[room] },
            near: 0.008,
            layers,
            aim: Aim { tolerance: 2e-2, most: 200 },
        })?;
        add(course, taken);
    }
    Ok(())
}

/// Presses seams that have just been sewn: without weight and without friction on the skin the cloth
/// smooths out what closing them has folded over. With `layers` it is kept apart meanwhile.
///
/// # Errors
/// [`Stuck`] from the step.
pub fn press(shop: &mut Workshop<'_>, layers: bool) -> Result<Course, Stuck> {
    ease(shop, layers, PRESSING_STEPS)
}

/// Lets stiff cloth open out, through itself where it must.
///
/// # Errors
/// [`Stuck`] from the step.
pub fn smooth(shop: &mut Workshop<'_>) -> Result<Course, Stuck> {
    ease(shop, false, SMOOTHING_STEPS)
}

fn ease(shop: &mut Workshop<'_>, layers: bool, most: usize) -> Result<Course, Stuck> {
    let mut course = Course::default();
    while course.steps < most {
        let taken = shop.step(&Manner {
            dt: 1.0 / 30.0,
            gravity: 0.0,
            air: 0.0,
            calm: 3.0,
            grip: 0.0,
            layers,
            aim: Aim { tolerance: 1e-2, most: 200 },
            ..Manner::default()
        })?;
        add(&mut course, taken);
        if taken.speed < PRESSED {
            course.reached = true;
            break;
        }
    }
    Ok(course)
}

/// Lets the cloth come to rest: until nothing moves faster than `speed`, m/s, for half a second, or `within` seconds of its own time have passed. `fresh` cloth has not hung yet.
///
/// # Errors
/// [`Stuck`] from the step.
pub fn settle(
    shop: &mut Workshop<'_>,
    (speed, within): (f64, f64),
    fresh: bool,
    air: f64,
    progress: &mut dyn Progress,
) -> Result<Course, Stuck> {
    let mut course = Course::default();
    let most = ((within * 60.0) as usize).clamp(1, 40_000) * 2;
    // Speeds are taken from the way made in a while, in which what only trembles does not count.
    let mut mark = (0.0, shop.x.clone());
    let mut small = 0;
    let mut speed_now = f64::INFINITY;
    while course.time < within && course.steps < most {
        let free = fresh && course.time < FREE;
        let taken = shop.step(&Manner {
            dt: if free { 1.0 / 60.0 } else { 1.0 / 30.0 },
            air,
            calm: if free { 0.5 } else { 3.0 },
            sewing: 1.0,
            // A looser aim leaves soft folds trembling: the cloth never comes to rest.
            aim: Aim { tolerance: if free { 1e-2 } else { 3e-3 }, most: 300 },
            ..Manner::default()
        })?;
        add(&mut course, taken);
        if course.time - mark.0 >= WINDOW {
            let far = shop.x.iter().zip(&mark.1).map(|(x, m)| (x - m).norm()).fold(0.0, f64::max);
            speed_now = far / (course.time - mark.0);
            mark = (course.time, shop.x.clone());
            small = if speed_now < speed && taken.pinned && !free { small + 1 } else { 0 };
            if small >= 2 {
                course.reached = true;
                break;
            }
        }
        let slow = (speed_now / speed.max(1e-5)).clamp(1.0, 1e6);
        progress.share(
            (course.time / within).max(1.0 - (libm::log(slow) / 8.0).min(1.0)).min(1.0),
            &format!("{:.1} mm/s", speed_now.min(taken.speed) * 1e3),
        );
    }
    course.speed = course.speed.min(speed_now);
    Ok(course)
}

/// Lets time pass.
///
/// # Errors
/// [`Stuck`] from the step.
pub fn run(
    shop: &mut Workshop<'_>,
    time: f64,
    rate: f64,
    air: f64,
    progress: &mut dyn Progress,
) -> Result<Course, Stuck> {
    let mut course = Course::default();
    let rate = if rate.is_finite() { rate.clamp(1.0, 1000.0) } else { 60.0 };
    // At least 120 steps a second, and a whole number of them a frame.
    let dt = 1.0 / (rate * (120.0 / rate).ceil().max(1.0));
    let most = ((time / dt) as usize).min(200_000) * 4 + 8;
    while course.time < time - 1e-9 && course.steps < most {
        let taken = shop.step(&Manner {
            dt: dt.min(time - course.time),
            air,
            sewing: 1.0,
            ..Manner::default()
        })?;
        add(&mut course, taken);
        progress.share(course.time / time, &format!("{:.2} s", course.time));
    }
    course.reached = course.time >= time - 1e-9;
    Ok(course)
}

fn add(course: &mut Course, taken: super::step::Taken) {
    course.steps += 1;
    course.time += taken.time;
    course.speed = taken.speed;
    course.iterations += taken.iterations;
}
