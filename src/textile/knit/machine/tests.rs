use super::*;
use crate::diagnostic::FileId;
use crate::textile::knitout::{Content, Outcome, read, run, write};
use proptest::prelude::*;

/// The chart of these rows, top row first.
fn chart(rows: &[&str]) -> Chart {
    let symbol = |c| match c {
        'k' => Symbol::Knit,
        'p' => Symbol::Purl,
        's' => Symbol::Slip,
        't' => Symbol::Tuck,
        'o' => Symbol::YarnOver,
        '/' => Symbol::named("k2tog").unwrap(),
        '\\' => Symbol::named("ssk").unwrap(),
        'P' => Symbol::named("p2tog").unwrap(),
        'A' => Symbol::Centred,
        'm' => Symbol::Made(Lean::Left),
        ' ' => Symbol::NoStitch,
        '<' => Symbol::Cable(Cable { front: 2, behind: 2, lean: Lean::Left, purl: false }),
        '>' => Symbol::Cable(Cable { front: 2, behind: 1, lean: Lean::Right, purl: true }),
        _ => panic!("{c}"),
    };
    let rows = rows.iter().rev().map(|row| row.chars().map(symbol).collect()).collect();
    Chart::new(rows, None).unwrap()
}

/// What comes of the panel on the machine, which must find nothing wrong, as text too.
#[track_caller]
fn knitted(chart: &Chart) -> (Program, Outcome) {
    let program = panel(chart, "test", None).unwrap();
    let text = write(&program);
    let (again, told) = read(FileId(0), &text);
    assert_eq!(told, [], "{text}");
    let (outcome, told) = run(FileId(0), &again.unwrap());
    assert_eq!(told, [], "{text}");
    assert_eq!(outcome.left(), 0, "{text}");
    (program, outcome)
}

/// How many loops of the rows are made on each bed and laid as tucks: what the chart says.
fn wanted(chart: &Chart) -> ([u64; 2], u64) {
    let (mut knitted, mut tucked) = ([0, 0], 0);
    for row in 0..chart.height() {
        for (symbol, _, width) in chart.placed(row) {
            match symbol {
                Symbol::Slip | Symbol::NoStitch => {}
                Symbol::Tuck | Symbol::YarnOver | Symbol::Made(_) => tucked += 1,
                _ => (0..width).for_each(|at| {
                    knitted[usize::from(symbol.stitch(at) == Stitch::Back)] += 1;
                }),
            }
        }
    }
    (knitted, tucked)
}

#[track_caller]
fn counts(chart: &Chart) {
    let (_, outcome) = knitted(chart);
    let (mut knits, tucks) = wanted(chart);
    // The cast-on lays loops; the bind-off knits each loop once and the last one twice more.
    knits[0] += chart.leaves(chart.height() - 1) as u64 + 2;
    assert_eq!(outcome.knitted, knits);
    assert_eq!(outcome.tucked, tucks + chart.uses(0) as u64);
    assert_eq!(outcome.dropped, 1);
}

#[test]
fn panels_have_the_loops_of_their_charts() {
    for rows in [
        &["kkkkkk", "kkkkkk"][..],
        &["kpkpkp", "kpkpkp", "pkpkpk"],
        &["kkkkkkk", "ko/k\\ok", "kkkkkkk"],
        &["koAok", "kkkkk"],
        &["k<<<<p", "kkkkkp"],
        &["kkp>>>", "pkkppk"],
        &["kskskt", "tkkkks"],
        &["k/  ", "k/k ", "kkkk"],
        &["kmmk", "kk  "],
        &["kPko", "pkpk"],
    ] {
        counts(&chart(rows));
    }
}

#[test]
fn a_rib_changes_no_bed_between_its_rows() {
    let (program, _) = knitted(&chart(&["kpkp", "kpkp", "kpkp"]));
    let over = program.operations().filter(|it| matches!(it, Operation::Xfer(..))).count();
    // Two columns to the back after the cast-on, two to the front before the bind-off, which
    // takes two for each of three loops.
    assert_eq!(over, 2 + 2 + 6);
}

#[test]
fn a_left_cross_brings_its_right_stitches_over_first() {
    let (program, _) = knitted(&chart(&["<<<<", "kkkk"]));
    let racks: Vec<f64> = program
        .operations()
        .filter_map(|it| if let Operation::Rack(far) = it { Some(*far) } else { None })
        .take(3)
        .collect();
    assert_eq!(racks, [-2.0, 2.0, 0.0]);
}

#[test]
fn colours_have_carriers_that_come_back_from_where_they_wait() {
    let [red, blue] = [Colour([200, 0, 0, 255]), Colour([0, 0, 200, 255])].map(Some);
    let colours = vec![vec![red; 3], vec![red, blue, red], vec![blue; 3], vec![red, red, blue]];
    let chart = Chart::new(vec![vec![Symbol::Knit; 3]; 4], Some(colours)).unwrap();
    let (program, outcome) = knitted(&chart);
    assert_eq!(program.header("Yarn-2"), Some("#0000c8"));
    assert_eq!(outcome.carriers[0].loops, 3 + 3 + 2 + 2 + 3 + 2);
    assert_eq!(outcome.carriers[1].loops, 1 + 3 + 1);
    let of_blue: Vec<char> = program
        .lines
        .iter()
        .filter_map(|line| match &line.content {
            Content::Operation(Operation::Make { direction, carriers, .. }) if carriers == &[1] => {
                Some(direction.sign())
            }
            _ => None,
        })
        .take(5)
        .collect();
    assert_eq!(of_blue, ['-', '+', '+', '+', '-']);
}

#[test]
fn what_no_machine_does_is_told() {
    let bobble = Chart::new(vec![vec![Symbol::Bobble]], None).unwrap();
    assert_eq!(
        panel(&bobble, "", None).unwrap_err().to_string(),
        "row 1 has a bobble, which a machine does not make in one row"
    );
    let wrong = panel(&chart(&["kkk", "kk "]), "", None).unwrap_err();
    assert_eq!(wrong, MachineError::Unbalanced { row: 2, uses: 3, left: 2 });
    let far = panel(&chart(&["          k", "k          "]), "", None).unwrap_err();
    assert_eq!(far, MachineError::TooFar { row: 2, needles: 10 });
}

proptest! {
    #[test]
    fn any_chart_that_adds_up_is_knitted(
        rows in prop::collection::vec(prop::collection::vec(0usize..5, 6), 1..6),
        pattern in prop::collection::vec(prop::sample::select(vec![
            "kkkkkk", "ko/\\ok", "<<<<kp", "p<<<<p", ">>>>>>", "koAokk", "kpPokk", "tskpts",
        ]), 0..4),
    ) {
        let plain = |row: &Vec<usize>| -> String {
            row.iter().map(|&n| ['k', 'p', 's', 't', 'k'][n]).collect()
        };
        let mut all: Vec<String> = rows.iter().map(plain).collect();
        all.extend(pattern.iter().map(|row| (*row).to_owned()));
        let all: Vec<&str> = all.iter().map(String::as_str).collect();
        let chart = chart(&all);
        prop_assert!(chart.imbalances().is_empty());
        counts(&chart);
    }
}
