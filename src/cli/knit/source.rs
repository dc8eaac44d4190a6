//! Where a chart or a program comes from.

use crate::cli::project::Project;
use crate::cli::{MessageFormat, Stop, ends_with};
use crate::diagnostic::spelling::nearest;
use crate::diagnostic::{Diagnostic, Span};
use crate::evaluate::catalogue;
use crate::textile::Colour;
use crate::textile::knit::{Chart, Symbol, knitscape, panel};
use crate::textile::knitout::{self, Making, Outcome, Pass, Program};
use crate::textile::yarn::Yarn;
use std::path::Path;

/// What was read.
pub(super) enum Source {
    /// A chart.
    Charted(Charted),
    /// A program of a machine, and what comes of it.
    Programmed(Programmed),
}

/// A chart with what is known of its cloth.
pub(super) struct Charted {
    pub title: String,
    /// Where it stands.
    pub from: String,
    pub chart: Chart,
    /// Wales and courses per metre.
    pub gauge: Option<[f64; 2]>,
    pub yarn: Option<Yarn>,
    project: Project,
    at: Span,
}

/// A program that was followed.
pub(super) struct Programmed {
    pub title: String,
    pub program: Program,
    pub outcome: Outcome,
}

/// Reads a file.
///
/// # Errors
/// [`Stop::Input`] if the file is wrong, [`Stop::Call`] where it has no knit of that name.
pub(super) fn read(
    file: &Path,
    name: Option<&str>,
    repeat: Option<[usize; 2]>,
    format: MessageFormat,
) -> Result<Source, Stop> {
    let other = ends_with(file, &["k", "json"]);
    if other && name.is_some() {
        return Err(Stop::Call("such a file holds one piece; leave out --name".to_owned()));
    }
    let program = ends_with(file, &["k"]);
    if program && repeat.is_some() {
        return Err(Stop::Call("a program is knitted as it is; leave out --repeat".to_owned()));
    }
    let title = file.file_stem().map_or_else(String::new, |it| it.to_string_lossy().into_owned());
    if program {
        return of_machine(file, title, format).map(Source::Programmed);
    }
    let mut found = match other {
        true => of_knitscape(file, title, format)?,
        false => of_garment(file, name, format)?,
    };
    if let Some([across, up]) = repeat {
        if up > 1 && !found.chart.closes() {
            let (first, last) = (found.chart.uses(0), found.chart.leaves(found.chart.height() - 1));
            return Err(Stop::Call(format!(
                "`{}` cannot go on above itself: its first row works {first} stitches, its last \
                 leaves {last}",
                found.title
            )));
        }
        found.chart =
            found.chart.repeated(across, up).map_err(|error| Stop::Call(error.to_string()))?;
    }
    Ok(Source::Charted(found))
}

fn of_machine(file: &Path, title: String, format: MessageFormat) -> Result<Programmed, Stop> {
    let project = Project::named(file, format)?;
    let (id, text) = project.text();
    let (program, mut told) = knitout::read(id, text);
    let Some(program) = program else {
        project.tell_all(told)?;
        return Err(Stop::Input);
    };
    let (outcome, of_machine) = knitout::run(id, &program);
    told.extend(of_machine);
    project.tell_all(told)?;
    Ok(Programmed { title, program, outcome })
}

fn of_knitscape(file: &Path, title: String, format: MessageFormat) -> Result<Charted, Stop> {
    let project = Project::named(file, format)?;
    let (id, text) = project.text();
    let (chart, told) = knitscape::read(id, text);
    let at = Span::new(id, 0, 0);
    project.tell_all(told)?;
    let Some(chart) = chart else { return Err(Stop::Input) };
    let from = "KnitScape".to_owned();
    Ok(Charted { title, from, chart, gauge: None, yarn: None, project, at })
}

fn of_garment(file: &Path, name: Option<&str>, format: MessageFormat) -> Result<Charted, Stop> {
    let mut project = Project::at(file, format)?;
    let (mut knitted, told) =
        project.with(|world, root| catalogue::knitted(world, root, &Default::default()));
    project.tell_all(told)?;
    let found = match name {
        Some(name) => knitted.iter().position(|it| it.name == name).ok_or_else(|| {
            let near = nearest(name, knitted.iter().map(|it| it.name.as_str()));
            let hint = near.map_or(String::new(), |near| format!("; did you mean `{near}`?"));
            Stop::Call(format!("there is no knit and no knitted fabric `{name}`{hint}"))
        })?,
        None => {
            let own: Vec<usize> = (0..knitted.len()).filter(|&at| knitted[at].own).collect();
            match own.as_slice() {
                &[only] => only,
                [] => {
                    return Err(Stop::Call(format!(
                        "`{}` has no knit of its own; name one of the library with --name",
                        file.display()
                    )));
                }
                several => {
                    let names: Vec<&str> = several.iter().map(|&at| &*knitted[at].name).collect();
                    return Err(Stop::Call(format!(
                        "this file has {}; say which with --name",
                        names.join(", ")
                    )));
                }
            }
        }
    };
    let found = knitted.swap_remove(found);
    let gauge = Some([found.knit.wales, found.knit.courses]);
    let (title, from, chart) = (found.name, found.home, found.knit.chart);
    Ok(Charted { title, from, chart, gauge, yarn: found.yarn, project, at: found.at })
}

impl Source {
    /// What it is called.
    pub fn title(&self) -> &str {
        match self {
            Source::Charted(it) => &it.title,
            Source::Programmed(it) => &it.title,
        }
    }

    /// The program of it.
    ///
    /// # Errors
    /// [`Stop::Input`] where no machine can knit the chart.
    pub fn program(&self) -> Result<Program, Stop> {
        match self {
            Source::Programmed(it) => Ok(it.program.clone()),
            Source::Charted(it) => it.program().map_err(|told| {
                it.project.tell(&[told]);
                Stop::Input
            }),
        }
    }

    /// The chart as it is drawn, the height of a stitch over its width, the colour of the yarn, and
    /// whether it is whole.
    ///
    /// # Errors
    /// [`Stop::Call`] where a program makes no loop.
    pub fn chart(&self) -> Result<(Chart, f64, Option<Colour>, bool), Stop> {
        match self {
            Source::Charted(it) => {
                let aspect = it.gauge.map_or(0.75, |[wales, courses]| wales / courses);
                let colour = it.yarn.as_ref().map(|yarn| yarn.colour);
                Ok((it.chart.clone(), aspect, colour, true))
            }
            Source::Programmed(it) => {
                let (chart, whole) = it.passes().ok_or_else(|| {
                    Stop::Call("the program makes no loop; there is nothing to draw".to_owned())
                })?;
                Ok((chart, 0.75, None, whole))
            }
        }
    }
}

impl Charted {
    /// The program of a panel; an E0651 where there is none.
    pub fn program(&self) -> Result<Program, Diagnostic> {
        let colour = self.yarn.as_ref().map(|yarn| yarn.colour);
        panel(&self.chart, &self.title, colour).map_err(|error| {
            let message = format!("`{}` cannot be knitted by machine: {error}", self.title);
            Diagnostic::new("E0651", message)
                .at(self.at, "its chart")
                .help("change the chart there, or draw it with --chart for knitting by hand")
        })
    }
}

/// Colours of carriers whose yarns are not said.
const YARNS: [[u8; 3]; 8] = [
    [236, 226, 200],
    [124, 168, 204],
    [206, 128, 108],
    [140, 180, 130],
    [222, 186, 96],
    [170, 140, 190],
    [150, 150, 156],
    [226, 160, 180],
];

impl Programmed {
    /// The colour of the yarn in a carrier: that of its header, where it names one as `#rrggbb`.
    pub fn yarn(&self, carrier: usize) -> Colour {
        let name = self.program.carriers.get(carrier).map_or("", String::as_str);
        let said = self.program.header(&format!("Yarn-{name}")).and_then(|yarn| {
            let digits = yarn.split('#').nth(1)?.get(..6)?;
            u32::from_str_radix(digits, 16).ok()
        });
        match said {
            Some(code) => {
                let [_, red, green, blue] = code.to_be_bytes();
                Colour([red, green, blue, 255])
            }
            None => {
                let [red, green, blue] = YARNS[carrier % YARNS.len()];
                Colour([red, green, blue, 255])
            }
        }
    }

    /// A row for each pass: knitted where the front bed knits, purled where the back bed does.
    /// Where both knit at one place the back bed has a row of its own. Whether all are in it.
    fn passes(&self) -> Option<(Chart, bool)> {
        let [low, high] = self.outcome.reach?;
        let wide = (high.abs_diff(low) as usize + 1).min(Chart::LARGEST);
        let blank = vec![Symbol::NoStitch; wide];
        let (mut rows, mut colours) = (Vec::new(), Vec::new());
        let mut whole = wide == high.abs_diff(low) as usize + 1;
        for Pass { carriers, loops, .. } in &self.outcome.passes {
            let colour = carriers.first().map(|carrier| self.yarn(usize::from(*carrier)));
            let mut row = blank.clone();
            let mut behind = blank.clone();
            for (needle, making) in loops {
                let Some(at) = usize::try_from(needle.number - low).ok().filter(|at| *at < wide)
                else {
                    continue;
                };
                let symbol = match (making, needle.bed.is_front()) {
                    (Making::Tuck, _) => Symbol::Tuck,
                    (_, true) => Symbol::Knit,
                    (_, false) => Symbol::Purl,
                };
                let free = row[at] == Symbol::NoStitch;
                *(if free { &mut row[at] } else { &mut behind[at] }) = symbol;
            }
            for row in [row, behind] {
                if row == blank {
                    continue;
                }
                if rows.len() == Chart::LARGEST {
                    whole = false;
                    break;
                }
                let colour = |symbol: &Symbol| colour.filter(|_| *symbol != Symbol::NoStitch);
                colours.push(row.iter().map(colour).collect());
                rows.push(row);
            }
        }
        Chart::new(rows, Some(colours)).ok().map(|chart| (chart, whole))
    }
}
