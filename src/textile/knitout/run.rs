//! A machine on which a program is followed loop by loop.
//!
//! The state of the machine is what the format defines: how many loops each needle of the two
//! beds (and each slider) holds, which carriers are in action and where they stand, and how far
//! the beds are racked. Loops are counted, not drawn, so that a program takes time in proportion
//! to its length.

use super::program::{Carrier, Content, Direction, Making, Needle, Operation, Program, Yarn};
use crate::diagnostic::{Diagnostic, FileId, Span};
use crate::textile::told::Told;
use std::collections::BTreeMap;

/// What a carrier did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Loops made with its yarn.
    pub loops: u64,
    /// Needles between two loops in one pass of the carriage, at most.
    pub longest_float: u32,
}

/// A pass of the carriage in which loops are made.
#[derive(Clone, Debug, PartialEq)]
pub struct Pass {
    /// The way it goes.
    pub direction: Direction,
    /// The carriers it takes along.
    pub carriers: Vec<Carrier>,
    /// The loops it makes, in their order; a split is a knitted loop.
    pub loops: Vec<(Needle, Making)>,
}

/// What came of a program.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outcome {
    /// Loops drawn through others, on the front and on the back bed.
    pub knitted: [u64; 2],
    /// Loops laid beside others.
    pub tucked: u64,
    /// Loops drawn through others that went over to another needle.
    pub split: u64,
    /// Times that carriers passed a needle without a loop.
    pub missed: u64,
    /// Times that a needle gave its loops to another.
    pub transferred: u64,
    /// Loops that fell off their needles.
    pub dropped: u64,
    /// Passes of the carriage that make loops: a new one where the way, the carriers or the order
    /// of needles change.
    pub passes: Vec<Pass>,
    /// The lowest and the highest number of a needle that made or held a loop.
    pub reach: Option<[i32; 2]>,
    /// Loops drawn through others at one number of needle, at most: the rows of the piece.
    pub courses: u64,
    /// Loops on one needle, at most.
    pub most_on_needle: u64,
    /// The needles that hold loops at the end, and how many.
    pub left: BTreeMap<Needle, u64>,
    /// What each carrier did, in the order of [`Program::carriers`].
    pub carriers: Vec<Work>,
}

impl Outcome {
    /// Loops of all kinds that were made.
    pub fn loops(&self) -> u64 {
        self.knitted[0] + self.knitted[1] + self.tucked + self.split
    }

    /// Loops left on the needles at the end.
    pub fn left(&self) -> u64 {
        self.left.values().sum()
    }
}

/// Follows a program. Told are E0635 a carrier that is not in action, or is already; E0636 loops
/// that cannot go over, since the needles do not face each other; E0637 what a slider cannot do;
/// W0632 work on a needle without loops; W0633 yarns that are left in action.
pub fn run(file: FileId, program: &Program) -> (Outcome, Vec<Diagnostic>) {
    let mut machine = Machine::new(file, program);
    for line in &program.lines {
        if let Content::Operation(operation) = &line.content {
            machine.at = line.span;
            machine.follow(operation);
        }
    }
    machine.end()
}

/// Where a carrier stands.
#[derive(Clone, Copy, Debug, PartialEq)]
enum State {
    /// At the gripper.
    Out,
    /// Called in by this line.
    In(Span),
}

struct Machine<'p> {
    program: &'p Program,
    told: Told,
    at: Span,
    outcome: Outcome,
    needles: BTreeMap<Needle, u64>,
    states: Vec<State>,
    /// The carriers whose yarns the inserting hook holds, and whether they have made a loop since.
    hook: Option<(Vec<Carrier>, Span)>,
    racking: f64,
    /// The number of the last loop of each carrier in the pass in hand.
    last: BTreeMap<Carrier, i32>,
    /// Loops drawn through others, by number of needle.
    courses: BTreeMap<i32, u64>,
}

impl<'p> Machine<'p> {
    fn new(file: FileId, program: &'p Program) -> Self {
        let carriers = program.carriers.len();
        Machine {
            program,
            told: Told::new(file),
            at: Span::default(),
            outcome: Outcome { carriers: vec![Work::default(); carriers], ..Outcome::default() },
            needles: BTreeMap::new(),
            states: vec![State::Out; carriers],
            hook: None,
            racking: 0.0,
            last: BTreeMap::new(),
            courses: BTreeMap::new(),
        }
    }

    fn name(&self, carrier: Carrier) -> &str {
        self.program.carriers.get(usize::from(carrier)).map_or("?", String::as_str)
    }

    fn names(&self, carriers: &[Carrier]) -> String {
        let names: Vec<&str> = carriers.iter().map(|&carrier| self.name(carrier)).collect();
        names.join(" ")
    }

    fn follow(&mut self, operation: &Operation) {
        match operation {
            Operation::Yarn(yarn, carriers) => self.yarn(*yarn, carriers),
            Operation::Rack(racking) => self.racking = *racking,
            Operation::Make { making, direction, needle, carriers } => {
                self.make(*making, *direction, *needle, carriers);
            }
            Operation::Split { direction, from, to, carriers } => {
                self.split(*direction, *from, *to, carriers);
            }
            Operation::Drop(needle) => self.make(Making::Knit, Direction::Right, *needle, &[]),
            Operation::Amiss(needle) => self.make(Making::Tuck, Direction::Right, *needle, &[]),
            Operation::Xfer(from, to) => self.split(Direction::Right, *from, *to, &[]),
            Operation::Stitch(_) | Operation::Pause(_) | Operation::Extension(..) => {}
        }
    }

    /// Carriers go in or out of action.
    fn yarn(&mut self, yarn: Yarn, carriers: &[Carrier]) {
        match yarn {
            Yarn::In | Yarn::Inhook => {
                for &carrier in carriers {
                    if let Some(State::In(before)) = self.states.get(usize::from(carrier)).copied()
                    {
                        let message =
                            format!("carrier {} is in action already", self.name(carrier));
                        let help = format!("take it out before: `outhook {}`", self.name(carrier));
                        self.wrong("E0635", message, Some(&help));
                        self.told_before(before, "called in here");
                    }
                    if let Some(state) = self.states.get_mut(usize::from(carrier)) {
                        *state = State::In(self.at);
                    }
                }
                if yarn == Yarn::Inhook {
                    if let Some((held, since)) = self.hook.take() {
                        let names = self.names(&held);
                        let message = format!("the inserting hook still holds carrier {names}");
                        let help = format!("let it go before: `releasehook {names}`");
                        self.wrong("E0635", message, Some(&help));
                        self.told_before(since, "held since here");
                    }
                    self.hook = Some((carriers.to_vec(), self.at));
                }
            }
            Yarn::Releasehook => match self.hook.take() {
                Some((held, _)) if alike(&held, carriers) => {}
                Some((held, since)) => {
                    let message = format!(
                        "the inserting hook holds carrier {}, not {}",
                        self.names(&held),
                        self.names(carriers)
                    );
                    self.wrong("E0635", message, None);
                    self.told_before(since, "called in here");
                }
                None => {
                    let message = "the inserting hook holds no yarn".to_owned();
                    let names = self.names(carriers);
                    let help = format!("`inhook {names}` must come before");
                    self.wrong("E0635", message, Some(&help));
                }
            },
            Yarn::Out | Yarn::Outhook => {
                for &carrier in carriers {
                    self.in_action(carrier, yarn.word());
                    if let Some(state) = self.states.get_mut(usize::from(carrier)) {
                        *state = State::Out;
                    }
                }
                // A yarn that is taken away is held no more.
                if self.hook.as_ref().is_some_and(|(held, _)| alike(held, carriers)) {
                    self.hook = None;
                }
            }
        }
    }

    /// Tells a carrier that is used though it is out, once.
    fn in_action(&mut self, carrier: Carrier, word: &str) {
        if self.states.get(usize::from(carrier)) != Some(&State::Out) {
            return;
        }
        let name = self.name(carrier);
        let message = format!("`{word}` with carrier {name}, which is not in action");
        let help = format!("call it in before: `inhook {name}` or `in {name}`");
        self.wrong("E0635", message, Some(&help));
        if let Some(state) = self.states.get_mut(usize::from(carrier)) {
            *state = State::In(self.at);
        }
    }

    fn make(&mut self, making: Making, direction: Direction, needle: Needle, carriers: &[Carrier]) {
        for &carrier in carriers {
            self.in_action(carrier, making.word());
        }
        if making == Making::Miss {
            self.outcome.missed += 1;
            return;
        }
        if needle.bed.is_slider() && !carriers.is_empty() {
            let message = format!("the slider {needle} cannot make a loop");
            let help = "sliders hold loops; transfer them to a needle to knit them";
            self.wrong("E0637", message, Some(help));
            return;
        }
        if carriers.is_empty() {
            if making == Making::Knit {
                let held = self.needles.remove(&needle).unwrap_or(0);
                if held == 0 {
                    self.empty(needle, "nothing falls");
                }
                self.outcome.dropped += held;
            }
            return;
        }
        self.pass(direction, needle, making, carriers);
        let held = self.needles.entry(needle).or_default();
        *held = if making == Making::Knit { 1 } else { *held + 1 };
        self.outcome.most_on_needle = self.outcome.most_on_needle.max(*held);
        if making == Making::Knit {
            self.outcome.knitted[usize::from(!needle.bed.is_front())] += 1;
            self.course(needle.number);
        } else {
            self.outcome.tucked += 1;
        }
        self.reached(needle.number);
    }

    fn split(&mut self, direction: Direction, from: Needle, to: Needle, carriers: &[Carrier]) {
        for &carrier in carriers {
            self.in_action(carrier, "split");
        }
        if !from.faces(to, self.racking) {
            self.apart(from, to);
            return;
        }
        if from.bed.is_slider() && !carriers.is_empty() {
            let message = format!("the slider {from} cannot make a loop");
            self.wrong("E0637", message, None);
            return;
        }
        let moved = self.needles.remove(&from).unwrap_or(0);
        if moved > 0 {
            let held = self.needles.entry(to).or_default();
            *held += moved;
            self.outcome.most_on_needle = self.outcome.most_on_needle.max(*held);
            self.outcome.transferred += 1;
            self.reached(to.number);
        } else if carriers.is_empty() {
            self.empty(from, "nothing goes over");
        }
        if !carriers.is_empty() {
            self.pass(direction, from, Making::Knit, carriers);
            self.needles.insert(from, 1);
            self.outcome.split += 1;
            self.course(from.number);
            self.reached(from.number);
        }
    }

    /// Tells why loops cannot go from one needle to another.
    fn apart(&mut self, from: Needle, to: Needle) {
        let message = format!("loops cannot go from {from} to {to}");
        let racking = self.racking;
        let help = if from.bed.is_front() == to.bed.is_front() {
            "loops go over from one bed to the other".to_owned()
        } else if racking.fract() != 0.0 {
            format!("at racking {racking} no needles face each other; write `rack 0` before")
        } else {
            let wanted = match from.bed.is_front() {
                true => f64::from(from.number) - f64::from(to.number),
                false => f64::from(to.number) - f64::from(from.number),
            };
            format!("the beds are racked to {racking}; these needles face at `rack {wanted}`")
        };
        self.wrong("E0636", message, Some(&help));
    }

    /// Notes a loop of a pass.
    fn pass(&mut self, direction: Direction, needle: Needle, making: Making, carriers: &[Carrier]) {
        let number = needle.number;
        let onward = |pass: &Pass| {
            let further = pass.loops.last().is_none_or(|(last, _)| match direction {
                Direction::Right => last.number <= number,
                Direction::Left => last.number >= number,
            });
            further && pass.direction == direction && pass.carriers == carriers
        };
        match self.outcome.passes.last_mut() {
            Some(pass) if onward(pass) => pass.loops.push((needle, making)),
            _ => {
                let (carriers, loops) = (carriers.to_vec(), vec![(needle, making)]);
                self.outcome.passes.push(Pass { direction, carriers, loops });
                self.last.clear();
            }
        }
        for &carrier in carriers {
            let Some(work) = self.outcome.carriers.get_mut(usize::from(carrier)) else { continue };
            work.loops += 1;
            if let Some(last) = self.last.insert(carrier, number) {
                let float = last.abs_diff(number).saturating_sub(1);
                work.longest_float = work.longest_float.max(float);
            }
        }
    }

    fn course(&mut self, number: i32) {
        let count = self.courses.entry(number).or_default();
        *count += 1;
        self.outcome.courses = self.outcome.courses.max(*count);
    }

    fn reached(&mut self, number: i32) {
        let reach = self.outcome.reach.get_or_insert([number; 2]);
        *reach = [reach[0].min(number), reach[1].max(number)];
    }

    /// Tells work on a needle without loops; many programs let whole rows of needles fall to be
    /// sure, so it is told once.
    fn empty(&mut self, needle: Needle, what: &str) {
        let message = format!("{needle} holds no loop, {what}");
        self.told.say_up_to(1, "W0632", what, self.at, message, "here", None);
    }

    fn wrong(&mut self, code: &'static str, message: String, help: Option<&str>) {
        self.told.say_with(code, "", self.at, message, "here", help);
    }

    /// Adds to the last message where it began.
    fn told_before(&mut self, before: Span, label: &str) {
        self.told.and_at(before, label);
    }

    fn end(mut self) -> (Outcome, Vec<Diagnostic>) {
        self.outcome.left = std::mem::take(&mut self.needles);
        // Where something is wrong, what is left over only follows from it.
        if self.told.refused() {
            return (self.outcome, self.told.all());
        }
        for (number, state) in self.states.clone().into_iter().enumerate() {
            if let State::In(since) = state {
                let name = self.name(number as Carrier);
                let message = format!("carrier {name} is still in action at the end");
                let help = format!("`outhook {name}` takes it out");
                self.told.say_with("W0633", "", since, message, "called in here", Some(&help));
            }
        }
        if let Some((held, since)) = self.hook.take() {
            let names = self.names(&held);
            let message = format!("the inserting hook holds carrier {names} to the end");
            let help = format!("`releasehook {names}` lets it go, once a few loops are knitted");
            self.told.say_with("W0633", "", since, message, "called in here", Some(&help));
        }
        (self.outcome, self.told.all())
    }
}

/// Whether two sets of carriers are the same.
fn alike(one: &[Carrier], other: &[Carrier]) -> bool {
    one.len() == other.len() && one.iter().all(|carrier| other.contains(carrier))
}
