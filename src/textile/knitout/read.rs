//! From the lines of a text to a program.

use super::program::{
    Bed, Carrier, Content, Direction, Line, Making, Needle, Operation, Program, Yarn,
};
use crate::diagnostic::spelling::nearest;
use crate::diagnostic::{Diagnostic, FileId, Span};
use crate::textile::told::Told;
use std::collections::BTreeMap;

/// The version that is read; later ones are read as if they were this one.
const VERSION: u32 = 2;
/// Carriers that a machine may have.
const MOST_CARRIERS: usize = 1_000;
/// Needles lie within this of needle 0: no bed has a tenth of so many.
const FARTHEST: i32 = 100_000;

/// The words of operations.
const WORDS: [&str; 16] = [
    "in",
    "inhook",
    "releasehook",
    "out",
    "outhook",
    "stitch",
    "rack",
    "knit",
    "tuck",
    "miss",
    "split",
    "drop",
    "amiss",
    "xfer",
    "pause",
    "x-",
];

/// Extensions whose meaning is known though nothing follows from it here.
const KNOWN: [&str; 12] = [
    "x-stitch-number",
    "x-speed-number",
    "x-presser-mode",
    "x-sub-roller-number",
    "x-roller-advance",
    "x-add-roller-advance",
    "x-xfer-stitch-number",
    "x-carrier-spacing",
    "x-carrier-stopping-distance",
    "x-vis-color",
    "x-auto-kickbacks",
    "x-pickup",
];

/// Reads a text of knitout. Where it cannot be understood there is no program, and the messages
/// say why: E0631 a text that is no knitout, E0632 carriers that are not said, E0633 an operation
/// that cannot be read, E0634 a carrier that the header does not have. W0631 tells what departs
/// from the format and does no harm.
pub fn read(file: FileId, text: &str) -> (Option<Program>, Vec<Diagnostic>) {
    let mut told = Told::new(file);
    let program = Reader { file, told: &mut told, carriers: BTreeMap::new() }.whole(text);
    let program = if told.refused() { None } else { program };
    (program, told.all())
}

struct Reader<'a> {
    file: FileId,
    told: &'a mut Told,
    carriers: BTreeMap<String, Carrier>,
}

/// A word of an operation with its place.
#[derive(Clone, Copy)]
struct Token<'t> {
    text: &'t str,
    span: Span,
}

impl Reader<'_> {
    fn whole(&mut self, text: &str) -> Option<Program> {
        let bare = text.strip_prefix('\u{FEFF}').unwrap_or(text);
        let mut at = text.len() - bare.len();
        let mut pieces = bare.split_inclusive('\n');
        let first = pieces.next().unwrap_or("");
        let version = self.magic(first, at)?;
        at += first.len();

        let mut program = Program { version, carriers: Vec::new(), lines: Vec::new() };
        let mut begun = false;
        let mut returns = first.trim_end_matches('\n').ends_with('\r').then_some(at - 1);
        for piece in pieces {
            let start = at;
            at += piece.len();
            let ended = piece.strip_suffix('\n').unwrap_or(piece);
            let line = ended.trim_end_matches('\r');
            if line.len() < ended.len() {
                returns.get_or_insert(start + line.len());
            }
            let span = Span::new(self.file, start, start + line.len());
            if let Some(header) = line.strip_prefix(";;").filter(|_| !begun) {
                if let Some((name, value)) = header.split_once(':') {
                    let value = value.strip_prefix(' ').unwrap_or(value);
                    self.header(&mut program, name, value, span);
                    continue;
                }
            }
            let (said, comment) = match line.split_once(';') {
                Some((said, comment)) => (said, Some(comment.to_owned())),
                None => (line, None),
            };
            let tokens = self.tokens(said, start);
            let content = match tokens.split_first() {
                None => Content::Nothing,
                Some((word, operands)) => {
                    if !begun && self.carriers.is_empty() {
                        self.no_carriers(span);
                    }
                    begun = true;
                    match self.operation(*word, operands) {
                        Some(operation) => Content::Operation(operation),
                        None => continue,
                    }
                }
            };
            program.lines.push(Line { content, comment, span });
        }
        if !begun && self.carriers.is_empty() {
            self.no_carriers(Span::new(self.file, 0, first.trim_end().len()));
        }
        if let Some(at) = returns {
            let span = Span::new(self.file, at, at + 1);
            let message = "lines end in carriage returns; knitout ends them in line feeds alone";
            self.told.say("W0631", "returns", span, message.to_owned());
        }
        Some(program)
    }

    /// The version in the first line.
    fn magic(&mut self, line: &str, at: usize) -> Option<u32> {
        let line = line.trim_end_matches(['\n', '\r']);
        let span = Span::new(self.file, at, at + line.len());
        let Some(number) = line.strip_prefix(";!knitout-") else {
            self.told.of_file(
                "E0631",
                "this is not knitout: its first line is not `;!knitout-2`".to_owned(),
                "a .k file begins with that line, then `;;Carriers: 1 2 3`, then operations",
            );
            return None;
        };
        let Ok(version) = number.trim_end().parse::<u32>() else {
            let message = "the first line names no version".to_owned();
            let help = "it is `;!knitout-2`";
            self.told.say_with("E0631", "version", span, message, "here", Some(help));
            return None;
        };
        if version > VERSION {
            let message = format!("version {version} is read as version {VERSION}");
            self.told.say("W0631", "version", span, message);
        }
        Some(version)
    }

    fn no_carriers(&mut self, span: Span) {
        let message = "no header says the carriers".to_owned();
        let help = "such as `;;Carriers: 1 2 3 4 5 6`, from the front to the back";
        self.told.say_with("E0632", "carriers", span, message, "before this", Some(help));
        // Said once, of the first operation.
        self.carriers.insert(String::new(), 0);
    }

    fn header(&mut self, program: &mut Program, name: &str, value: &str, span: Span) {
        if name == "Carriers" {
            if !program.carriers.is_empty() {
                let message = "carriers are said twice".to_owned();
                self.told.say("E0632", "carriers", span, message);
                return;
            }
            for name in value.split_whitespace() {
                if program.carriers.len() >= MOST_CARRIERS {
                    let message = format!("no machine has {MOST_CARRIERS} carriers");
                    self.told.say("E0632", "carriers", span, message);
                    return;
                }
                let number = program.carriers.len() as Carrier;
                if self.carriers.insert(name.to_owned(), number).is_some() {
                    let message = format!("carrier {} is named twice", short(name));
                    self.told.say("E0632", "carriers", span, message);
                }
                program.carriers.push(name.to_owned());
            }
            if program.carriers.is_empty() {
                let message = "no carrier is named".to_owned();
                self.told.say("E0632", "carriers", span, message);
                self.carriers.insert(String::new(), 0);
            }
        }
        let content = Content::Header { name: name.to_owned(), value: value.to_owned() };
        program.lines.push(Line { content, comment: None, span });
    }

    fn tokens<'t>(&self, said: &'t str, start: usize) -> Vec<Token<'t>> {
        let place = |word: &'t str| {
            // A word of a text lies in it.
            let at = start + (word.as_ptr() as usize - said.as_ptr() as usize);
            Token { text: word, span: Span::new(self.file, at, at + word.len()) }
        };
        said.split_whitespace().map(place).collect()
    }

    fn operation(&mut self, word: Token<'_>, operands: &[Token<'_>]) -> Option<Operation> {
        let yarn = [Yarn::In, Yarn::Inhook, Yarn::Releasehook, Yarn::Out, Yarn::Outhook];
        if let Some(yarn) = yarn.into_iter().find(|yarn| yarn.word() == word.text) {
            if operands.is_empty() {
                return self.wanted(word, "CARRIERS");
            }
            return Some(Operation::Yarn(yarn, self.carriers(operands)?));
        }
        let makings = [Making::Knit, Making::Tuck, Making::Miss];
        if let Some(making) = makings.into_iter().find(|making| making.word() == word.text) {
            let [direction, needle, carriers @ ..] = operands else {
                return self.wanted(word, "DIRECTION NEEDLE CARRIERS, such as `+ f12 3`");
            };
            let direction = self.direction(*direction);
            let needle = self.needle(*needle);
            let carriers = self.carriers(carriers);
            let (direction, needle) = (direction?, needle?);
            return Some(Operation::Make { making, direction, needle, carriers: carriers? });
        }
        match (word.text, operands) {
            ("stitch", &[leading, trailing]) => {
                let [leading, trailing] = [leading, trailing].map(|it| self.number(it));
                Some(Operation::Stitch([leading?, trailing?]))
            }
            ("stitch", _) => self.wanted(word, "two numbers, before and after the loop"),
            ("rack", &[racking]) => {
                let number = self.number(racking)?;
                if number.abs() > f64::from(FARTHEST) {
                    return self.unread(racking, "a racking in needles, such as `1` or `-0.75`");
                }
                Some(Operation::Rack(number))
            }
            ("rack", _) => self.wanted(word, "one number, in needles"),
            ("split", &[direction, from, to, ref carriers @ ..]) => {
                let direction = self.direction(direction);
                let [from, to] = [from, to].map(|it| self.needle(it));
                let carriers = self.carriers(carriers);
                let (direction, from, to) = (direction?, from?, to?);
                Some(Operation::Split { direction, from, to, carriers: carriers? })
            }
            ("split", _) => self.wanted(word, "DIRECTION NEEDLE NEEDLE CARRIERS"),
            ("drop", &[needle]) => Some(Operation::Drop(self.needle(needle)?)),
            ("amiss", &[needle]) => Some(Operation::Amiss(self.needle(needle)?)),
            ("drop" | "amiss", _) => self.wanted(word, "one needle, such as `f12`"),
            ("xfer", &[from, to]) => {
                let [from, to] = [from, to].map(|it| self.needle(it));
                Some(Operation::Xfer(from?, to?))
            }
            ("xfer", _) => self.wanted(word, "two needles, such as `f12 b12`"),
            ("pause", rest) => Some(Operation::Pause(joined(rest))),
            (extension, rest) if extension.starts_with("x-") => {
                if !KNOWN.contains(&extension) {
                    let message = format!("`{}` is not known and is passed over", short(extension));
                    self.told.say("W0631", "extension", word.span, message);
                }
                Some(Operation::Extension(extension.to_owned(), joined(rest)))
            }
            (unknown, _) => {
                let message = format!("there is no operation `{}`", short(unknown));
                let label = self.meant("E0633", "word", unknown, WORDS.into_iter());
                let help = "operations are knit, tuck, miss, split, xfer, drop, amiss, rack, \
                            stitch, in, inhook, releasehook, out, outhook, pause, x-…";
                self.told.say_with("E0633", "word", word.span, message, &label, Some(help));
                None
            }
        }
    }

    /// The label at a word that is not known; near ones are only looked for where it is shown.
    fn meant<'a>(
        &self,
        code: &'static str,
        subject: &str,
        word: &str,
        known: impl Iterator<Item = &'a str>,
    ) -> String {
        let near = if self.told.shows(code, subject) { nearest(word, known) } else { None };
        near.map_or("here".to_owned(), |near| format!("did you mean `{near}`?"))
    }

    /// Tells that the operands of an operation are too few or too many.
    fn wanted(&mut self, word: Token<'_>, what: &str) -> Option<Operation> {
        let message = format!("`{}` wants {what}", word.text);
        self.told.say("E0633", word.text, word.span, message);
        None
    }

    fn unread<T>(&mut self, token: Token<'_>, what: &str) -> Option<T> {
        let message = format!("`{}` is not {what}", short(token.text));
        self.told.say("E0633", what, token.span, message);
        None
    }

    fn direction(&mut self, token: Token<'_>) -> Option<Direction> {
        match token.text {
            "+" => Some(Direction::Right),
            "-" => Some(Direction::Left),
            _ => self.unread(token, "a direction, `+` or `-`"),
        }
    }

    fn needle(&mut self, token: Token<'_>) -> Option<Needle> {
        const WHAT: &str = "a needle, such as `f12`, `b-2` or `fs3`";
        let beds = [Bed::FrontSlider, Bed::BackSlider, Bed::Front, Bed::Back];
        let found = beds.into_iter().find_map(|bed| {
            let number: i32 = token.text.strip_prefix(bed.prefix())?.parse().ok()?;
            (number.abs() <= FARTHEST).then_some(Needle { bed, number })
        });
        match found {
            Some(needle) => Some(needle),
            None => self.unread(token, WHAT),
        }
    }

    fn number(&mut self, token: Token<'_>) -> Option<f64> {
        match token.text.parse::<f64>() {
            Ok(number) if number.is_finite() => Some(number),
            _ => self.unread(token, "a number"),
        }
    }

    fn carriers(&mut self, tokens: &[Token<'_>]) -> Option<Vec<Carrier>> {
        let mut found = Vec::with_capacity(tokens.len());
        let mut sound = true;
        for token in tokens {
            match self.carriers.get(token.text) {
                Some(carrier) if found.contains(carrier) => {
                    let message = format!("carrier {} is named twice", token.text);
                    self.told.say("E0633", "carrier", token.span, message);
                    sound = false;
                }
                Some(carrier) => found.push(*carrier),
                // That there are none is said already.
                None if self.carriers.contains_key("") => sound = false,
                None => {
                    let message = format!("there is no carrier {}", short(token.text));
                    let names = self.carriers.keys().map(String::as_str);
                    let label = self.meant("E0634", "", token.text, names);
                    let help = "the header `;;Carriers:` names those there are";
                    self.told.say_with("E0634", "", token.span, message, &label, Some(help));
                    sound = false;
                }
            }
        }
        sound.then_some(found)
    }
}

fn joined(tokens: &[Token<'_>]) -> String {
    let words: Vec<&str> = tokens.iter().map(|token| token.text).collect();
    words.join(" ")
}

/// So much of a word as fits into a message.
fn short(word: &str) -> String {
    const MOST: usize = 24;
    if word.chars().count() <= MOST {
        return word.to_owned();
    }
    word.chars().take(MOST).chain(['…']).collect()
}
