//! Families of pieces rolled round the trunk: row by row along closed lines that are long enough
//! for all that hangs there.

use super::family::{Family, Member};
use super::joins::{Joins, reach};
use super::layplan::{MEETING, middle};
use super::ripple::Ripple;
use super::section::{self, Ring, Sections};
use crate::garment::scene::Side;
use crate::mesh::compiled::Compiled;
use nalgebra::Point3;
use std::f64::consts::TAU;

/// Height of the rows whose widths are compared, m.
const ROW: f64 = 0.01;

/// Rolls a family round its body. What is sewn to panels that are `done` turns towards them, unless
/// it is placed in front or behind.
pub(super) fn roll(
    compiled: &Compiled,
    joins: &Joins,
    family: &mut Family,
    done: &[bool],
    positions: &mut [Point3<f64>],
) {
    if family.hung {
        hang(joins, family, done, positions);
    }
    let Some([mut low, mut high]) = family.heights(compiled, joins) else { return };
    if let Some(base) = section::collar_base(family.root.body, low) {
        // A collar stands on the shoulders.
        let up = (base - low).max(0.0);
        for member in &mut family.members {
            member.lay.origin[1] += up;
        }
        (low, high) = (low + up, high + up);
    }
    let sections = Sections::new(family.root.body, low, high);
    let gap = family.gap;
    turn_beside(joins, family, done, positions, &sections, gap);
    let ripple = gathers(joins, family, done, positions);
    let share = ripple.as_ref().map_or(1.0, Ripple::share);
    let wanted: Vec<f64> = girths(compiled, joins, &family.members, low, sections.count())
        .into_iter()
        .map(|girth| girth * share)
        .collect();
    let gaps: Vec<f64> =
        (0..sections.count()).map(|k| gap.max((wanted[k] - sections.girth(k)) / TAU)).collect();
    let gaps = if family.members.len() == 1 {
        // A band keeps its length from row to row.
        let longest =
            (0..sections.count()).map(|k| sections.girth(k) + TAU * gaps[k]).fold(0.0, f64::max);
        (0..sections.count()).map(|k| (longest - sections.girth(k)) / TAU).collect()
    } else {
        smooth_from_above(&gaps)
    };
    let rings: Vec<Ring> = (0..sections.count()).map(|k| sections.ring(k, gaps[k])).collect();
    if family.members.iter().all(|m| m.side == Side::Around) {
        let mut turns = Vec::new();
        for member in &family.members {
            for [own, other] in pairs(joins, member.panel, done) {
                let [x, height] = member.lay.at(joins.drawn[own]);
                let ring = &rings[sections.at(height).0];
                let x = x * share / ring.girth();
                turns.push(ring.share(&positions[other]) - member.lay.part - x);
            }
        }
        let turn = mean_turn(turns.into_iter());
        for member in &mut family.members {
            member.lay.part += turn.unwrap_or(0.0);
        }
    }
    for member in &family.members {
        for particle in compiled.panels[member.panel].particles.range() {
            let [x, height] = member.lay.at(joins.drawn[particle]);
            let (k, t) = sections.at(height);
            let [x, out] = ripple.as_ref().map_or([x, 0.0], |ripple| ripple.at(x));
            let walk = |ring: &Ring| ring.beside(member.lay.part * ring.girth() + x, out);
            let (a, b) = (walk(&rings[k]), walk(&rings[(k + 1).min(rings.len() - 1)]));
            positions[particle] =
                Point3::new(a[0] + t * (b[0] - a[0]), height, a[1] + t * (b[1] - a[1]));
        }
    }
}

/// The waves in which a single piece begins that is longer than the edge it hangs on.
fn gathers(
    joins: &Joins,
    family: &Family,
    done: &[bool],
    positions: &[Point3<f64>],
) -> Option<Ripple> {
    let [member] = &family.members[..] else { return None };
    let (mut own, mut theirs) = (0.0, 0.0);
    for seen in joins.of(member.panel).filter(|s| family.hung && done[s.other]) {
        let pairs: Vec<[usize; 2]> = seen.pairs().collect();
        for w in pairs.windows(2) {
            let (a, b) = (joins.drawn[w[0][0]], joins.drawn[w[1][0]]);
            own += libm::hypot(b[0] - a[0], b[1] - a[1]);
            theirs += (positions[w[1][1]] - positions[w[0][1]]).norm();
        }
    }
    Ripple::new(own, theirs / own)
}

/// Pairs of a panel with panels that are `done`.
fn pairs<'a>(
    joins: &'a Joins,
    panel: usize,
    done: &'a [bool],
) -> impl Iterator<Item = [usize; 2]> + 'a {
    joins
        .of(panel)
        .filter(|seen| done[seen.other])
        .flat_map(|seen| seen.pairs().collect::<Vec<_>>())
}

/// Lifts a family to the height of what it is sewn to.
fn hang(joins: &Joins, family: &mut Family, done: &[bool], positions: &[Point3<f64>]) {
    let (mut sum, mut count) = (0.0, 0.0);
    for member in &family.members {
        for [own, other] in pairs(joins, member.panel, done) {
            sum += positions[other].y - member.lay.at(joins.drawn[own])[1];
            count += 1.0;
        }
    }
    for member in &mut family.members {
        member.lay.origin[1] += sum / f64::max(count, 1.0);
    }
}

/// Turns pieces placed beside the body towards what they are sewn to; to their own side where that
/// is nothing.
fn turn_beside(
    joins: &Joins,
    family: &mut Family,
    done: &[bool],
    positions: &[Point3<f64>],
    sections: &Sections,
    gap: f64,
) {
    for member in family.members.iter_mut().filter(|m| m.side == Side::Beside) {
        let seam: Vec<[usize; 2]> = pairs(joins, member.panel, done).collect();
        let own: Vec<[f64; 2]> =
            seam.iter().map(|[own, _]| member.lay.at(joins.drawn[*own])).collect();
        let turn = mean_turn(seam.iter().zip(&own).map(|([_, other], place)| {
            let (k, _) = sections.at(place[1]);
            sections.ring(k, gap).share(&positions[*other])
        }));
        if let Some(turn) = turn {
            member.lay.part = turn;
            member.lay.origin[0] -= middle(&own)[0];
        }
    }
}

/// The length that each row's line must have for its pieces to lie side by side, m.
fn girths(
    compiled: &Compiled,
    joins: &Joins,
    members: &[Member],
    low: f64,
    rows: usize,
) -> Vec<f64> {
    // The pieces of one part of the round count as one.
    let mut parts: Vec<(f64, Vec<Option<[f64; 2]>>)> = Vec::new();
    for member in members {
        let part = member.lay.part - member.lay.part.floor();
        let own = reach(compiled, joins, member.panel, &|p| member.lay.at(p), (low, ROW, rows));
        match parts.iter_mut().find(|(p, _)| *p == part) {
            Some((_, rows)) => {
                for (row, own) in rows.iter_mut().zip(own) {
                    *row = match (*row, own) {
                        (Some(a), Some(b)) => Some([a[0].min(b[0]), a[1].max(b[1])]),
                        (a, b) => a.or(b),
                    };
                }
            }
            None => parts.push((part, own)),
        }
    }
    parts.sort_by(|a, b| a.0.total_cmp(&b.0));
    let girth = |row: usize| {
        let here: Vec<(f64, [f64; 2])> =
            parts.iter().filter_map(|(part, rows)| Some((*part, rows[row]?))).collect();
        let mut girth = 0.0f64;
        for (n, (part, own)) in here.iter().enumerate() {
            let (next, theirs) = here[(n + 1) % here.len()];
            let share = if n + 1 < here.len() { next - part } else { next + 1.0 - part };
            girth = girth.max((own[1] - theirs[0] + MEETING) / share);
        }
        girth
    };
    (0..rows).map(girth).collect()
}

/// Mean of turns, each as a share of the whole round.
pub(super) fn mean_turn(turns: impl Iterator<Item = f64>) -> Option<f64> {
    let (mut x, mut y) = (0.0, 0.0);
    for turn in turns {
        x += libm::cos(turn * TAU);
        y += libm::sin(turn * TAU);
    }
    (libm::hypot(x, y) > 1e-9).then(|| libm::atan2(y, x) / TAU)
}

/// Widens gaps until none differs from its neighbour by more than a slope of one half: cloth
/// then begins without steps. Only ever widens, so nothing comes to lie in the body.
fn smooth_from_above(gaps: &[f64]) -> Vec<f64> {
    let slope = 0.5 * ROW;
    let mut out = gaps.to_vec();
    for k in 1..out.len() {
        out[k] = out[k].max(out[k - 1] - slope);
    }
    for k in (0..out.len().saturating_sub(1)).rev() {
        out[k] = out[k].max(out[k + 1] - slope);
    }
    out
}
