//! What a weaver would object to in a draft.
//!
//! Each kind is said once, of the first thread it holds for, with how many there are.

use super::draft::{Draft, Shedding, Threads};
use super::drawdown::{Cloth, Float, Side, System};
use super::layers::Layers;
use super::sett::{self, Lie};
use crate::diagnostic::Diagnostic;
use crate::diagnostic::Span;
use crate::units::{length, trimmed};
use std::collections::BTreeSet;

/// A place of a draft; threads are counted from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Spot {
    End(usize),
    Pick(usize),
    Shafts,
    Treadles,
    Warp,
    Weft,
}

/// What a loom has; nothing where any number will do.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Loom {
    /// Shafts.
    pub shafts: Option<usize>,
    /// Treadles.
    pub treadles: Option<usize>,
}

/// Floats are told to be long beyond this many threads,
const LONG: usize = 5;
/// and this length, m,
const LONG_METRES: f64 = 6e-3;
/// or beyond this many threads where nobody says how far apart they lie.
const LONG_UNMEASURED: usize = 9;

/// What a draft asks of a loom that has less: W0623.
pub fn beyond_loom(draft: &Draft, loom: &Loom, place: impl Fn(Spot) -> Span) -> Vec<Diagnostic> {
    let different = |lists: &[Vec<u32>]| lists.iter().flatten().collect::<BTreeSet<_>>().len();
    let shafts = different(&draft.threading);
    let treadles = match &draft.shedding {
        Shedding::Treadled { treadling, .. } => different(treadling),
        Shedding::Lifted { .. } => 0,
    };
    let mut told = Vec::new();
    for (needed, has, spot, what) in [
        (shafts, loom.shafts, Spot::Shafts, "shafts"),
        (treadles, loom.treadles, Spot::Treadles, "treadles"),
    ] {
        if let Some(has) = has.filter(|has| needed > *has) {
            let message = format!("the draft wants {needed} {what}, the loom has {has}");
            told.push(Diagnostic::new("W0623", message).at(place(spot), "here").help(match spot {
                Spot::Shafts => "ends that work alike can share a shaft",
                _ => "two treadles can be pressed at once, or the draft woven from its lift plan",
            }));
        }
    }
    told
}

/// What a weaver would object to in the cloth of a draft: ends and picks that take no part (W0622),
/// threads that are never bound and cloth that falls apart (W0603), long floats (W0601), edges
/// that do not hold the weft (W0624), threads too close (W0625). `cloth` is what
/// [works](Draft::worked) of it.
pub fn objections(draft: &Draft, cloth: &Cloth, place: impl Fn(Spot) -> Span) -> Vec<Diagnostic> {
    let mut told = Vec::new();
    told.extend(on_no_shaft(draft, &place));
    told.extend(idle_picks(draft, &place));
    // That an end on no shaft is not bound either is said already.
    let idle = |spot: &Spot| match spot {
        Spot::End(end) => draft.threading.get(*end).is_some_and(Vec::is_empty),
        _ => false,
    };
    let apart = falls_apart(cloth).filter(|(spot, ..)| !idle(spot));
    told.extend(apart.map(|(spot, message, help)| {
        Diagnostic::new("W0603", message).at(place(spot), "here").help(help)
    }));
    for system in [System::Warp, System::Weft] {
        told.extend(long_floats(draft, cloth, system, &place));
    }
    told.extend(selvedge(cloth, &place));
    told.extend(too_close(draft, cloth, &place));
    told
}

/// `end 3`, with further ones.
fn named(word: &str, first: usize, count: usize) -> String {
    match count {
        1 => format!("{word} {}", first + 1),
        2 => format!("{word} {} and one more", first + 1),
        _ => format!("{word} {} and {} more", first + 1, count - 1),
    }
}

fn on_no_shaft(draft: &Draft, place: &impl Fn(Spot) -> Span) -> Option<Diagnostic> {
    let idle = || (0..draft.ends()).filter(|&end| draft.threading[end].is_empty());
    let (first, count) = (idle().next()?, idle().count());
    let message = if first == draft.worked().0 {
        format!("of {} ends the first {first} hang on shafts", draft.ends())
    } else {
        let verb = if count == 1 { "hangs" } else { "hang" };
        format!("{} {verb} on no shaft", named("end", first, count))
    };
    Some(
        Diagnostic::new("W0622", message)
            .at(place(Spot::End(first)), "here")
            .help("nothing moves such an end, and it is not bound; thread it, or leave it out"),
    )
}

/// Why a cloth does not hang together, the thread to be shown, and what to do; nothing where it
/// does.
pub fn falls_apart(cloth: &Cloth) -> Option<(Spot, String, &'static str)> {
    const HELP: &str = "every end and every pick changes sides somewhere in the repeat";
    for (system, word) in [(System::Warp, "end"), (System::Weft, "pick")] {
        let loose = cloth.never_bound(system);
        if let Some(&(first, side)) = loose.first() {
            let spot = match system {
                System::Warp => Spot::End(first),
                System::Weft => Spot::Pick(first),
            };
            let side = match side {
                Side::Face => "face",
                Side::Back => "back",
            };
            let threads = named(word, first, loose.len());
            let message = match loose.len() {
                1 => format!("{threads} is never bound and lies loose on the {side}"),
                _ => format!("{threads} are never bound; the first lies loose on the {side}"),
            };
            return Some((spot, message, HELP));
        }
    }
    let layers = Layers::of(cloth);
    let [top, .., last] = layers.parts.as_slice() else { return None };
    let shown = [top, last].into_iter().min_by_key(|part| part.ends.len() + part.picks.len())?;
    let spot = match (shown.ends.first(), shown.picks.first()) {
        (Some(&end), _) => Spot::End(end),
        (None, Some(&pick)) => Spot::Pick(pick),
        (None, None) => return None,
    };
    Some(match layers.count() {
        0 | 1 => {
            let what = match spot {
                Spot::Pick(pick) => format!("pick {}", pick + 1),
                Spot::End(end) => format!("end {}", end + 1),
                _ => return None,
            };
            (spot, format!("{what} changes sides, but nothing holds it to the cloth"), HELP)
        }
        count => (
            spot,
            format!(
                "the cloth falls apart into {count} layers; this thread belongs to one of them"
            ),
            "stitch them: lift an end of the lower layer over a pick of the upper",
        ),
    })
}

/// Picks behind the last that moves a shaft.
fn idle_picks(draft: &Draft, place: &impl Fn(Spot) -> Span) -> Option<Diagnostic> {
    let (picks, worked) = (draft.picks(), draft.worked().1);
    (worked < picks).then(|| {
        Diagnostic::new("W0622", format!("of {picks} picks the first {worked} move shafts"))
            .at(place(Spot::Pick(worked)), "here")
            .help("the others are left out where the cloth is looked at")
    })
}

fn long_floats(
    draft: &Draft,
    cloth: &Cloth,
    system: System,
    place: &impl Fn(Spot) -> Span,
) -> Option<Diagnostic> {
    let across = match system {
        System::Warp => &draft.weft,
        System::Weft => &draft.warp,
    };
    let loose: BTreeSet<usize> = cloth.never_bound(system).into_iter().map(|it| it.0).collect();
    let longest = cloth.longest_bound(system, &loose);
    let (side, float) = [Side::Face, Side::Back]
        .into_iter()
        .filter_map(|side| Some((side, longest.on(side, true)?)))
        .max_by_key(|(side, float)| (float.length, *side == Side::Face))?;
    let metres = float_length(&float, cloth, system, across);
    let long = match metres {
        Some(metres) => float.length > LONG && metres > LONG_METRES,
        None => float.length > LONG_UNMEASURED,
    };
    if !long {
        return None;
    }
    let (word, other, spot) = match system {
        System::Warp => ("end", "picks", Spot::End(float.thread)),
        System::Weft => ("pick", "ends", Spot::Pick(float.thread)),
    };
    let side = match side {
        Side::Face => "face",
        Side::Back => "back",
    };
    let far = metres.map_or(String::new(), |metres| format!(" ({})", length(metres)));
    Some(
        Diagnostic::new(
            "W0601",
            format!(
                "{word} {} floats over {} {other}{far} on the {side}, from {} {}",
                float.thread + 1,
                float.length,
                other.trim_end_matches('s'),
                float.from + 1
            ),
        )
        .at(place(spot), "this thread")
        .help("long floats catch; bind more often or set the threads closer"),
    )
}

/// How far a float reaches, m; nothing where nobody says how far apart the threads lie.
fn float_length(float: &Float, cloth: &Cloth, system: System, across: &Threads) -> Option<f64> {
    let spacing = across.spacing.as_ref()?;
    let (rows, _) = cloth.threads(system);
    let count = rows.ends().min(spacing.len()).max(1);
    Some((0..float.length).map(|n| spacing.get((float.from + n) % count).unwrap_or(&0.0)).sum())
}

/// An edge end holds the weft where it lies on one side of the pick that goes out and on the
/// other of the one that comes back. The shuttle may start from either side.
fn selvedge(cloth: &Cloth, place: &impl Fn(Spot) -> Span) -> Option<Diagnostic> {
    let (ends, picks) = (cloth.picks.ends(), cloth.picks.picks());
    // Of bands, of samples of a repeat and of single picks there is nothing to say.
    if ends < 16 || picks < 2 {
        return None;
    }
    // Woven twice, for a repeat of an odd number of picks starts again from the other side.
    let missed = |right_first: usize| -> Vec<(usize, usize)> {
        (0..2 * picks - 1)
            .filter_map(|pick| {
                let end = if (pick + right_first).is_multiple_of(2) { ends - 1 } else { 0 };
                let held =
                    cloth.picks.up(end, pick % picks) != cloth.picks.up(end, (pick + 1) % picks);
                (!held).then_some((end, pick % picks))
            })
            .collect()
    };
    let misses = [missed(0), missed(1)].into_iter().min_by_key(Vec::len)?;
    let &(end, pick) = misses.first()?;
    Some(
        Diagnostic::new(
            "W0624",
            format!(
                "at {} of {} turns the edge does not hold the weft, first end {} after pick {}",
                misses.len(),
                2 * picks - 1,
                end + 1,
                pick + 1
            ),
        )
        .at(place(Spot::End(end)), "the edge")
        .help("add an end to each edge that is not threaded on the shafts, or that weaves plain"),
    )
}

fn too_close(draft: &Draft, cloth: &Cloth, place: &impl Fn(Spot) -> Span) -> Option<Diagnostic> {
    let [warp, weft] = [lie(&draft.warp)?, lie(&draft.weft)?];
    let crossings = (cloth.picks.ends() * cloth.picks.picks()).max(1) as f64;
    let interlacing =
        [System::Warp, System::Weft].map(|system| cloth.changes(system) as f64 / crossings);
    let wanted = sett::room_wanted(warp, weft, interlacing);
    if wanted <= sett::GIVE {
        return None;
    }
    Some(
        too_close_by(warp, weft, wanted)
            .at(place(Spot::Warp), "the warp")
            .at(place(Spot::Weft), "the weft"),
    )
}

/// W0625, without its place.
pub fn too_close_by(warp: Lie, weft: Lie, wanted: f64) -> Diagnostic {
    let sett = |lie: Lie, by: f64| trimmed(0.01 / (lie.spacing * by), 1);
    Diagnostic::new(
        "W0625",
        format!(
            "{} ends and {} picks a cm are more than threads of {} and {} can be woven to",
            sett(warp, 1.0),
            sett(weft, 1.0),
            length(warp.diameter),
            length(weft.diameter)
        ),
    )
    .help(format!(
        "the cloth is closed at {} ends and {} picks; a weave with longer floats takes more",
        sett(warp, wanted),
        sett(weft, wanted)
    ))
}

/// How the threads of a system lie, where the draft says it. Programs that ask nobody write the
/// distance as the thickness.
fn lie(threads: &Threads) -> Option<Lie> {
    let mean = |list: &Option<Vec<f64>>| {
        let list = list.as_ref().filter(|list| !list.is_empty())?;
        Some(list.iter().sum::<f64>() / list.len() as f64)
    };
    let (spacing, diameter) = (mean(&threads.spacing)?, mean(&threads.thickness)?);
    (diameter < 0.98 * spacing).then_some(Lie { diameter, spacing })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::textile::weave::Weave;
    use crate::textile::yarn::Twist;

    fn codes(draft: &Draft) -> Vec<(String, String)> {
        let (ends, picks) = draft.worked();
        let cloth = Cloth::new(draft.drawdown().unwrap().cropped(ends, picks));
        let told = objections(draft, &cloth, |_| Span::default());
        told.into_iter().map(|told| (told.code, told.message)).collect()
    }

    #[track_caller]
    fn objected(draft: &Draft, code: &str, wanted: &str) {
        let told = codes(draft);
        assert!(
            told.iter().any(|(known, message)| known == code && message.contains(wanted)),
            "{told:#?}"
        );
    }

    /// So many repeats of a weave as one draft.
    fn cloth(weave: &Weave, times: usize) -> Draft {
        let (ends, picks) = (weave.ends() * times, weave.picks() * times);
        let rows = (0..picks).map(|p| (0..ends).map(|e| weave.warp_up(e, p)).collect()).collect();
        Draft::of_weave(&Weave::matrix(rows).unwrap())
    }

    fn rows(rows: &[&str]) -> Draft {
        let rows = rows.iter().map(|row| row.chars().map(|c| c == '1').collect()).collect();
        Draft::of_weave(&Weave::matrix(rows).unwrap())
    }

    fn measured(mut draft: Draft, spacing: f64, thickness: f64) -> Draft {
        let of = |count| Threads {
            spacing: Some(vec![spacing; count]),
            thickness: Some(vec![thickness; count]),
            ..Threads::default()
        };
        (draft.warp, draft.weft) = (of(draft.ends()), of(draft.picks()));
        draft
    }

    #[test]
    fn usual_cloth_meets_no_objection() {
        for weave in [
            Weave::plain(),
            Weave::basket(2).unwrap(),
            Weave::twill(&[2, 2], Twist::Z, 1).unwrap(),
            Weave::twill(&[3, 1], Twist::S, 1).unwrap(),
        ] {
            let told = codes(&measured(cloth(&weave, 8), 5e-4, 2.5e-4));
            let told: Vec<_> = told.iter().filter(|(code, _)| code != "W0624").collect();
            assert!(told.is_empty(), "{}: {told:?}", weave.name);
        }
        assert_eq!(codes(&cloth(&Weave::plain(), 10)), []);
        assert_eq!(codes(&cloth(&Weave::twill(&[2, 2], Twist::Z, 1).unwrap(), 8)), []);
    }

    #[test]
    fn loose_threads_and_layers_are_found() {
        objected(
            &rows(&["101", "110"]),
            "W0603",
            "end 1 is never bound and lies loose on the face",
        );
        objected(
            &rows(&["10", "01", "00"]),
            "W0603",
            "pick 3 is never bound and lies loose on the",
        );
        objected(&rows(&["1000", "1110", "0010", "1011"]), "W0603", "apart into 2 layers");
        let mut idle = cloth(&Weave::plain(), 2);
        idle.threading[1].clear();
        objected(&idle, "W0622", "end 2 hangs on no shaft");
        let Shedding::Treadled { treadling, .. } = &mut idle.shedding else { panic!() };
        treadling.resize(9, Vec::new());
        objected(&idle, "W0622", "of 9 picks the first 4 move shafts");
        idle.threading.resize(1200, Vec::new());
        idle.threading[1].push(2);
        objected(&idle, "W0622", "of 1200 ends the first 4 hang on shafts");
    }

    #[test]
    fn long_floats_are_measured_where_they_can_be() {
        let satin = Weave::satin(12, 5).unwrap();
        objected(&cloth(&satin, 2), "W0601", "floats over 11 picks on the face");
        objected(
            &measured(cloth(&satin, 2), 1e-3, 5e-4),
            "W0601",
            "over 11 picks (1.1 cm) on the face",
        );
        let fine = codes(&measured(cloth(&satin, 2), 3e-4, 2e-4));
        assert!(fine.iter().all(|(code, _)| code != "W0601"), "{fine:?}");
        // Round the repeat: 3 picks up at the end, 4 at the beginning of it.
        let column = ["1", "1", "1", "1", "1", "1", "0", "1", "1", "1", "1"];
        let split: Vec<String> = column.iter().map(|c| format!("{c}01")).collect();
        let split: Vec<&str> = split.iter().map(String::as_str).collect();
        objected(&rows(&split), "W0601", "end 1 floats over 10 picks");
    }

    #[test]
    fn edges_hold_the_weft() {
        let satin = cloth(&Weave::satin(5, 2).unwrap(), 4);
        objected(&satin, "W0624", "turns the edge does not hold the weft");
        assert_eq!(codes(&cloth(&Weave::plain(), 8)), []);
    }

    #[test]
    fn a_sett_beyond_what_can_be_woven_is_told() {
        let plain = cloth(&Weave::plain(), 8);
        objected(&measured(plain.clone(), 5e-4, 4.5e-4), "W0625", "20 ends and 20 picks a cm");
        assert_eq!(codes(&measured(plain.clone(), 5e-4, 2.5e-4)), []);
        // Thickness written as distance is what programs write that know neither.
        assert_eq!(codes(&measured(plain, 5e-4, 5e-4)), []);
    }

    #[test]
    fn a_loom_has_its_limits() {
        let satin = Draft::of_weave(&Weave::satin(8, 3).unwrap());
        let told = |shafts, treadles| {
            let loom = Loom { shafts, treadles };
            beyond_loom(&satin, &loom, |_| Span::default()).len()
        };
        assert_eq!((told(None, None), told(Some(8), Some(8)), told(Some(4), Some(6))), (0, 0, 2));
    }
}
