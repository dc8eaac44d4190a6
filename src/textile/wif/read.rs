//! From the lines of a weaving file to a draft.

use super::colour::Table;
use super::ini::{self, Lines, Section};
use super::nanometres;
use super::number::Reader;
use crate::diagnostic::{Diagnostic, FileId, Span};
use crate::textile::Colour;
use crate::textile::draft::{Draft, Shedding, Threads};
use crate::textile::told::Told;

/// What was read.
#[derive(Clone, Debug)]
pub struct Read {
    /// The draft.
    pub draft: Draft,
    /// Where it says what.
    pub place: Place,
    /// The program that wrote the file, as it names itself; may be empty.
    pub program: String,
}

/// Where a file speaks of its threads.
#[derive(Clone, Debug)]
pub struct Place {
    /// The lines of `[THREADING]` by the number of the end from 0; the header for ends without.
    pub ends: Vec<Span>,
    /// The lines of `[TREADLING]` or `[LIFTPLAN]` by the number of the pick from 0.
    pub picks: Vec<Span>,
    /// `[WEAVING] Shafts`, or where it should stand.
    pub shafts: Span,
    /// `[WEAVING] Treadles`, or where it should stand.
    pub treadles: Span,
    /// `[WARP]`.
    pub warp: Span,
    /// `[WEFT]`.
    pub weft: Span,
}

/// Reads a weaving file. Where anything is so wrong that it could not be woven there is no draft,
/// and the messages say why: E0621 a section or key that is missing, E0622 a value that cannot be
/// read, E0623 a treadle or colour that is used but not there, E0624 a draft too large, E0625 a
/// text that is no weaving file. W0621 tells what was mended.
pub fn read(file: FileId, text: &str) -> (Option<Read>, Vec<Diagnostic>) {
    let lines = ini::lines(file, text);
    let mut told = Told::new(file);
    let found = whole(&lines, &mut told);
    let found = if told.refused() { None } else { found };
    (found, told.all())
}

/// Sections of which a draft is made.
const OWN: [&str; 10] = [
    "WEAVING",
    "WARP",
    "WEFT",
    "THREADING",
    "TIEUP",
    "TREADLING",
    "LIFTPLAN",
    "COLOR TABLE",
    "WARP COLORS",
    "WEFT COLORS",
];

fn whole(lines: &Lines<'_>, told: &mut Told) -> Option<Read> {
    let known = |section: &Section<'_>| section.name == "WIF" || OWN.contains(&&*section.name);
    if !lines.sections.iter().any(known) {
        told.of_file(
            "E0625",
            "this is not a weaving file: it has none of its sections".to_owned(),
            "a .wif file begins with [WIF] and has [WARP], [WEFT] and [THREADING]",
        );
        return None;
    }
    tell_lines(lines, told);
    if lines.section("WIF").is_none() {
        missing_all_the_same(lines, told, "WIF", "a weaving file begins with it");
    }
    if lines.section("COLOR TABLE").is_some() && lines.section("COLOR PALETTE").is_none() {
        missing_all_the_same(lines, told, "COLOR PALETTE", "colours are taken to go from 0 to 255");
    }
    let table = Table::read(lines, told);
    let (warp, warp_at) = system(lines, told, &table, ["WARP", "end"]);
    let (weft, weft_at) = system(lines, told, &table, ["WEFT", "pick"]);
    let [declared_shafts, declared_treadles] = ["Shafts", "Treadles"].map(|key| {
        let section = lines.section("WEAVING")?;
        Reader { section, told }.count(key, &key.to_lowercase())
    });
    let rising =
        lines.section("WEAVING").and_then(|section| Reader { section, told }.flag("Rising Shed"));
    let ends = warp.as_ref().map_or(0, |(count, _)| *count);
    let picks = weft.as_ref().map_or(0, |(count, _)| *count);

    let threading = rows(lines, told, "THREADING", ends, ["end", "shaft"]);
    let tieup = rows(lines, told, "TIEUP", Draft::LARGEST, ["treadle", "shaft"]);
    let treadling = rows(lines, told, "TREADLING", picks, ["pick", "treadle"]);
    let plan = rows(lines, told, "LIFTPLAN", picks, ["pick", "shaft"]);
    let (Some(threading), Some(mut tieup), Some(treadling), Some(plan)) =
        (threading, tieup, treadling, plan)
    else {
        return None;
    };
    // What is wrong with the numbers of threads is told; the rest would only follow from it.
    let ((_, warp), (_, weft)) = (warp?, weft?);
    if threading.is_empty() {
        missing(lines, told, "THREADING", "it says on which shaft each end hangs");
    }
    let treadles = last_used(&tieup.lists).max(declared_treadles.unwrap_or(0) as usize);
    tieup.lists.resize(treadles, Vec::new());
    let mut treadled = !tieup.is_empty() && !treadling.is_empty();
    match (treadled, tieup.is_empty(), treadling.is_empty(), plan.is_empty()) {
        (true, ..) | (.., false) => {}
        (_, true, false, _) => missing(
            lines,
            told,
            "TIEUP",
            "[TREADLING] names treadles, and nothing says which shafts they move",
        ),
        (_, false, true, _) => {
            missing(lines, told, "TREADLING", "it says which treadles each pick presses");
        }
        _ => missing(
            lines,
            told,
            "LIFTPLAN",
            "a draft needs [LIFTPLAN], or [TIEUP] and [TREADLING], with at least one shaft moved",
        ),
    }
    if treadled && !used_treadles(told, &treadling, tieup.lists.len(), plan.is_empty()) {
        treadled = false;
    }
    if told.refused() {
        return None;
    }
    let place = Place {
        ends: threading.spans,
        picks: if treadled { treadling.spans.clone() } else { plan.spans.clone() },
        shafts: at(lines, "WEAVING", "Shafts"),
        treadles: at(lines, "WEAVING", "Treadles"),
        warp: warp_at,
        weft: weft_at,
    };
    let shedding = if treadled {
        Shedding::Treadled { tieup: tieup.lists, treadling: treadling.lists }
    } else {
        Shedding::Lifted { plan: plan.lists.clone() }
    };
    let mut draft = Draft {
        title: said(lines, "TEXT", "Title"),
        author: said(lines, "TEXT", "Author"),
        notes: notes(lines),
        rising: rising.unwrap_or(true),
        shafts: 0,
        treadles: 0,
        threading: threading.lists,
        shedding,
        warp,
        weft,
    };
    if lines.section("WEAVING").is_none() {
        missing_all_the_same(lines, told, "WEAVING", "shafts and treadles are those that are used");
    }
    draft.shafts = counted(told, &place.shafts, declared_shafts, draft.highest_shaft(), "shaft");
    // The header of a lift plan often names the treadles of another loom, or none.
    let highest = draft.highest_treadle();
    draft.treadles = counted(told, &place.treadles, declared_treadles, highest, "treadle");
    if !treadled && draft.treadles == 0 {
        draft.treadles = draft.shafts;
    }
    if draft.ends().saturating_mul(draft.picks()) > Draft::LARGEST_AREA {
        let (ends, picks) = (draft.ends(), draft.picks());
        let message = format!("[WARP] Threads: {ends} ends by {picks} picks are too many");
        let help = "about 16000 by 16000 can be worked with";
        told.say_with("E0624", "WARP", warp_at, message, "here", Some(help));
        return None;
    }
    if treadled && !plan.is_empty() && rising != Some(false) {
        compare(told, &draft, &plan);
    }
    let program = [said(lines, "WIF", "Source Program"), said(lines, "WIF", "Source Version")]
        .join(" ")
        .trim()
        .to_owned();
    forget_made_up_geometry(&mut draft, &program);
    Some(Read { draft, place, program })
}

/// Lists by number from 1, each with its place.
struct Rows {
    lists: Vec<Vec<u32>>,
    spans: Vec<Span>,
}

impl Rows {
    /// Whether no line says anything.
    fn is_empty(&self) -> bool {
        self.lists.iter().all(Vec::is_empty)
    }
}

fn last_used(lists: &[Vec<u32>]) -> usize {
    lists.iter().rposition(|list| !list.is_empty()).map_or(0, |last| last + 1)
}

/// The lists of a section. `count` is how many there are; of `[TIEUP]` as many as are named.
fn rows(
    lines: &Lines<'_>,
    told: &mut Told,
    name: &str,
    count: usize,
    [of, what]: [&str; 2],
) -> Option<Rows> {
    let Some(section) = lines.section(name) else {
        let count = if name == "TIEUP" { 0 } else { count };
        let span = lines.sections.first().map_or(Span::default(), |section| section.span);
        return Some(Rows { lists: vec![Vec::new(); count], spans: vec![span; count] });
    };
    let mut reader = Reader { section, told };
    let mut found = Rows { lists: Vec::new(), spans: Vec::new() };
    if name != "TIEUP" {
        found.lists.resize(count, Vec::new());
        found.spans.resize(count, section.span);
    }
    let mut seen = vec![false; found.lists.len()];
    let mut sound = true;
    for entry in &section.entries {
        let Some(number) = reader.number_of(entry, count, of) else { continue };
        if number > found.lists.len() {
            found.lists.resize(number, Vec::new());
            found.spans.resize(number, section.span);
            seen.resize(number, false);
        }
        let Some(list) = reader.list(entry, what) else {
            sound = false;
            continue;
        };
        if seen[number - 1] {
            reader.unused(entry, "is given twice; the last that says something counts");
            if list.is_empty() {
                continue;
            }
        }
        seen[number - 1] = true;
        found.lists[number - 1] = list;
        found.spans[number - 1] = entry.span;
    }
    sound.then_some(found)
}

/// The number of threads of a system and what they are like; where its section stands.
fn system(
    lines: &Lines<'_>,
    told: &mut Told,
    table: &Table,
    [name, of]: [&str; 2],
) -> (Option<(usize, Threads)>, Span) {
    let Some(section) = lines.section(name) else {
        missing(lines, told, name, "it says how many threads there are");
        return (None, Span::default());
    };
    let mut reader = Reader { section, told };
    let told_before = reader.entry("Threads");
    let Some(count) = reader.count("Threads", "threads").map(|count| count as usize) else {
        if told_before.is_none_or(|entry| entry.is_empty()) {
            let message = format!("[{name}] Threads is missing");
            let help = "it says how many threads there are, such as `Threads=120`";
            reader.told.say_with("E0621", name, section.span, message, "here", Some(help));
        }
        return (None, section.span);
    };
    if count == 0 {
        if let Some(entry) = told_before {
            reader.wrong(&entry, "a number of threads");
        }
        return (None, section.span);
    }
    let base = reader
        .entry("Color")
        .filter(|entry| !entry.is_empty())
        .and_then(|entry| table.of_thread(&mut reader, &entry, false));
    let scale = units(&mut reader);
    let mut lengths = |key: &str| {
        let own = Reader { section, told: &mut *told }
            .entry(key)
            .filter(|entry| !entry.is_empty())
            .and_then(|entry| length(&mut Reader { section, told: &mut *told }, &entry, scale));
        let section = lines.section(&format!("{name} {}", key.to_uppercase()));
        each(section, told, count, of, own, |reader, entry| length(reader, entry, scale))
    };
    let (spacing, thickness) = (lengths("Spacing"), lengths("Thickness"));
    let colours =
        each(lines.section(&format!("{name} COLORS")), told, count, of, base, |reader, entry| {
            table.of_thread(reader, entry, true)
        });
    let colours = colours.map(|list| {
        let usual = if name == "WARP" { INK } else { PAPER };
        list.into_iter().map(|colour| colour.unwrap_or(usual)).collect()
    });
    let threads = Threads { colours, spacing: gaps(spacing), thickness: gaps(thickness) };
    (Some((count, threads)), section.span)
}

/// The colours of threads whose colour is not said, though that of others is.
const INK: Colour = Colour([0, 0, 0, 255]);
const PAPER: Colour = Colour([255, 255, 255, 255]);

/// A value for each thread, from the general one and those of single threads; nothing where no
/// value is said at all.
fn each<T: Clone>(
    section: Option<&Section<'_>>,
    told: &mut Told,
    count: usize,
    of: &str,
    base: Option<T>,
    mut value: impl FnMut(&mut Reader<'_, '_>, &ini::Entry<'_>) -> Option<T>,
) -> Option<Vec<Option<T>>> {
    let mut any = base.is_some();
    let mut list = vec![base; count];
    if let Some(section) = section {
        let mut reader = Reader { section, told };
        for entry in section.entries.iter().filter(|entry| !entry.is_empty()) {
            let Some(number) = reader.number_of(entry, count, of) else { continue };
            if let Some(value) = value(&mut reader, entry) {
                any = true;
                list[number - 1] = Some(value);
            }
        }
    }
    any.then_some(list)
}

/// Lengths of all threads, where those of some are not said: theirs is that of the first that is.
fn gaps(list: Option<Vec<Option<f64>>>) -> Option<Vec<f64>> {
    let list = list?;
    let usual = list.iter().copied().flatten().next()?;
    Some(list.into_iter().map(|length| length.unwrap_or(usual)).collect())
}

/// Metres of one unit of a section's lengths.
fn units(reader: &mut Reader<'_, '_>) -> Option<f64> {
    const CENTIMETRE: f64 = 0.01;
    let Some(entry) = reader.entry("Units").filter(|entry| !entry.is_empty()) else {
        let measured = ["Spacing", "Thickness"].iter().find_map(|key| reader.entry(key));
        if let Some(entry) = measured.filter(|entry| !entry.is_empty()) {
            reader.unused(&entry, "is taken to be in centimeters, for `Units` is missing");
        }
        return Some(CENTIMETRE);
    };
    match ini::number_part(entry.value).to_ascii_lowercase().as_str() {
        "centimeters" | "centimeter" | "centimetres" | "centimetre" | "cm" => Some(CENTIMETRE),
        "millimeters" | "millimeter" | "millimetres" | "millimetre" | "mm" => Some(0.001),
        "inches" | "inch" | "in" => Some(0.0254),
        // A tenth of a point of 1/72 inch.
        "decipoints" | "decipoint" => Some(0.0254 / 720.0),
        _ => {
            reader.unused(&entry, "is no unit of length; spacing and thickness are left out");
            None
        }
    }
}

/// A length of thread or distance, m. Zero means nothing is said.
fn length(reader: &mut Reader<'_, '_>, entry: &ini::Entry<'_>, scale: Option<f64>) -> Option<f64> {
    let metres = nanometres(reader.real(entry)? * scale?);
    if metres == 0.0 {
        return None;
    }
    // A thread of a nanometre or a rope of a metre is a slip of units.
    if !(1e-7..=0.5).contains(&metres) {
        reader.unused(entry, "is no thread of this world; it is left out");
        return None;
    }
    Some(metres)
}

/// Tells a section that must be there and is not, or says nothing.
fn missing(lines: &Lines<'_>, told: &mut Told, name: &str, why: &str) {
    let there = lines.section(name);
    let span = there.or(lines.sections.first()).map_or(Span::default(), |section| section.span);
    let (message, label) = match there {
        Some(_) => (format!("[{name}] is empty"), "here"),
        None => (format!("[{name}] is missing"), "in this file"),
    };
    told.say_with("E0621", name, span, message, label, Some(why));
}

/// Tells a section that should be there and can be done without.
fn missing_all_the_same(lines: &Lines<'_>, told: &mut Told, name: &str, what: &str) {
    let span = lines.sections.first().map_or(Span::default(), |section| section.span);
    let message = format!("[{name}] is missing");
    told.say_with("W0621", name, span, message, "in this file", Some(what));
}

/// Whether all treadles that are pressed are tied or declared; told where not, as an error if
/// there is no lift plan to go by instead.
fn used_treadles(told: &mut Told, treadling: &Rows, most: usize, alone: bool) -> bool {
    let mut sound = true;
    for (pick, (list, span)) in treadling.lists.iter().zip(&treadling.spans).enumerate() {
        if let Some(treadle) = list.iter().find(|&&treadle| treadle as usize > most) {
            sound = false;
            let message = format!("[TREADLING] {}: there is no treadle {treadle}", pick + 1);
            let help = format!("[TIEUP] and [WEAVING] know {most} treadles");
            let (code, help) = match alone {
                true => ("E0623", help.as_str()),
                false => ("W0621", "the lift plan is used instead"),
            };
            told.say_with(code, "TREADLING", *span, message, "here", Some(help));
        }
    }
    sound
}

/// How many shafts or treadles a draft is said to have; told where it uses more.
fn counted(told: &mut Told, at: &Span, declared: Option<u32>, highest: u32, what: &str) -> usize {
    let most = match declared.filter(|declared| *declared > 0) {
        Some(declared) => {
            if highest > declared {
                let key = if what == "shaft" { "Shafts" } else { "Treadles" };
                let message =
                    format!("[WEAVING] {key}: {declared} are declared, {what} {highest} is used");
                told.say("W0621", "WEAVING", *at, message);
            }
            declared
        }
        None => highest,
    };
    most as usize
}

/// Tells where tie-up and treadling make other sheds than the lift plan.
fn compare(told: &mut Told, draft: &Draft, plan: &Rows) {
    for (pick, (list, span)) in plan.lists.iter().zip(&plan.spans).enumerate() {
        if draft.moved(pick) != *list {
            told.say_with(
                "W0621",
                "LIFTPLAN",
                *span,
                format!("[LIFTPLAN] {}: tie-up and treadling lift other shafts", pick + 1),
                "not used",
                Some("tie-up and treadling count where a file has both"),
            );
        }
    }
}

/// Lines that are no lines of a weaving file, sections opened twice, sections that were promised.
fn tell_lines(lines: &Lines<'_>, told: &mut Told) {
    let own = |name: &str| OWN.contains(&name);
    let name_of = |number: usize| lines.sections.get(number).map_or("", |it| &it.name);
    for (section, span) in &lines.stray {
        let name = name_of(*section);
        if own(name) {
            let message = format!("[{name}] holds a line without `=`");
            told.say_with("W0621", name, *span, message, "left out", None);
        }
    }
    for span in &lines.unclosed {
        let message = "[ opens the name of a section that is not closed".to_owned();
        told.say_with("W0621", "", *span, message, "`]` is missing", None);
    }
    for (section, span) in &lines.reopened {
        let name = name_of(*section);
        if own(name) {
            let message = format!("[{name}] stands here again");
            told.say_with("W0621", name, *span, message, "read as one with the first", None);
        }
    }
    for section in lines.sections.iter().filter(|section| own(&section.name)) {
        let mut keys = std::collections::BTreeSet::new();
        let rows = ["THREADING", "TIEUP", "TREADLING", "LIFTPLAN"].contains(&&*section.name);
        for entry in section.entries.iter().filter(|_| !rows) {
            if !keys.insert(entry.key.to_ascii_lowercase()) {
                let name = &section.name;
                let message =
                    format!("[{name}] {}: is given twice", super::number::short(entry.key));
                told.say_with("W0621", name, entry.span, message, "this one counts", None);
            }
        }
    }
    if let Some(contents) = lines.section("CONTENTS") {
        let mut reader = Reader { section: contents, told };
        for name in OWN {
            let Some(entry) = reader.entry(name) else { continue };
            if lines.section(name).is_none() && reader.flag(name) == Some(true) {
                reader.unused(&entry, "is promised, but there is no such section");
            }
        }
    }
}

/// Where a key stands, or else its section.
fn at(lines: &Lines<'_>, section: &str, key: &str) -> Span {
    let found = lines.section(section).or(lines.sections.first());
    let entry = found.and_then(|section| section.entries.iter().rev().find(|e| e.is(key)));
    entry.map(|entry| entry.span).or(found.map(|section| section.span)).unwrap_or_default()
}

/// A text of the file.
fn said(lines: &Lines<'_>, section: &str, key: &str) -> String {
    let found = lines.section(section).and_then(|section| {
        section.entries.iter().rev().find(|entry| entry.is(key)).map(|entry| entry.value)
    });
    found.unwrap_or("").to_owned()
}

/// The notes, by their numbers.
fn notes(lines: &Lines<'_>) -> Vec<String> {
    let Some(section) = lines.section("NOTES") else { return Vec::new() };
    let mut numbered: Vec<(u64, &str)> = section
        .entries
        .iter()
        .filter_map(|entry| Some((super::number::whole(entry.key)?, entry.value)))
        .collect();
    numbered.sort_by_key(|(number, _)| *number);
    numbered.dedup_by_key(|(number, _)| *number);
    let mut notes: Vec<String> = numbered.into_iter().map(|(_, line)| line.to_owned()).collect();
    while notes.last().is_some_and(String::is_empty) {
        notes.pop();
    }
    notes
}

/// The archive of Handweaving.net writes one spacing and one thickness into all its files, with
/// threads thicker than their distance.
fn forget_made_up_geometry(draft: &mut Draft, program: &str) {
    if program.to_ascii_lowercase().starts_with("handweaving.net") {
        for threads in [&mut draft.warp, &mut draft.weft] {
            threads.spacing = None;
            threads.thickness = None;
        }
    }
}
