//! Where a draft comes from.

use crate::cli::project::Project;
use crate::cli::{MessageFormat, Stop};
use crate::diagnostic::spelling::nearest;
use crate::evaluate::catalogue::{self, Woven};
use crate::textile::draft::{Draft, Shedding, Threads};
use crate::textile::drawdown::Cloth;
use crate::textile::fabric::{Structure, Thread};
use crate::textile::objection::{Loom, Spot, beyond_loom, objections};
use crate::textile::wif;
use crate::world::path::is_draft;
use std::path::Path;

/// A draft that was read.
pub(super) struct Source {
    pub draft: Draft,
    /// Who says so: the program that wrote the file, or the text it stands in.
    pub from: String,
    /// Whether it is a repeat, which weavers draw more than once, or a whole piece.
    pub repeat: bool,
    /// Its cloth.
    pub cloth: Cloth,
    /// The part of the cloth in which ends and picks do something.
    pub worked: Cloth,
}

/// Reads the draft of a file.
///
/// # Errors
/// [`Stop::Input`] if the file is wrong, [`Stop::Call`] where it has no weave of that name.
pub(super) fn read(
    file: &Path,
    name: Option<&str>,
    loom: &Loom,
    format: MessageFormat,
) -> Result<Source, Stop> {
    if file.to_str().is_some_and(is_draft) {
        if name.is_some() {
            return Err(Stop::Call("a .wif file holds one draft; leave out --name".to_owned()));
        }
        return of_weaver(file, loom, format);
    }
    of_garment(file, name, loom, format)
}

fn of_weaver(file: &Path, loom: &Loom, format: MessageFormat) -> Result<Source, Stop> {
    let project = Project::named(file, format)?;
    let (id, text) = project.text();
    let (found, mut told) = wif::read(id, text);
    let Some(found) = found else {
        project.tell_all(told)?;
        return Err(Stop::Input);
    };
    let place = |spot: Spot| {
        let at = &found.place;
        match spot {
            Spot::End(end) => at.ends.get(end).copied().unwrap_or(at.warp),
            Spot::Pick(pick) => at.picks.get(pick).copied().unwrap_or(at.weft),
            Spot::Shafts => at.shafts,
            Spot::Treadles => at.treadles,
            Spot::Warp => at.warp,
            Spot::Weft => at.weft,
        }
    };
    let source = Source::new(found.draft, found.program, false)?;
    told.extend(beyond_loom(&source.draft, loom, place));
    told.extend(objections(&source.draft, &source.worked, place));
    project.tell_all(told)?;
    Ok(source)
}

fn of_garment(
    file: &Path,
    name: Option<&str>,
    loom: &Loom,
    format: MessageFormat,
) -> Result<Source, Stop> {
    let mut project = Project::at(file, format)?;
    let (mut woven, told) =
        project.with(|world, root| catalogue::woven(world, root, &Default::default()));
    project.tell_all(told)?;
    let found = match name {
        Some(name) => woven.iter().position(|it| it.name == name).ok_or_else(|| {
            let near = nearest(name, woven.iter().map(|it| it.name.as_str()));
            let hint = near.map_or(String::new(), |near| format!("; did you mean `{near}`?"));
            Stop::Call(format!("there is no weave and no woven fabric `{name}`{hint}"))
        })?,
        None => {
            let own: Vec<usize> = (0..woven.len()).filter(|&at| woven[at].own).collect();
            match own.as_slice() {
                &[only] => only,
                [] => {
                    return Err(Stop::Call(format!(
                        "`{}` has no weave of its own; name one of the library with --name",
                        file.display()
                    )));
                }
                several => {
                    let names: Vec<&str> = several.iter().map(|&at| &*woven[at].name).collect();
                    return Err(Stop::Call(format!(
                        "this file has {}; say which with --name",
                        names.join(", ")
                    )));
                }
            }
        }
    };
    let found = woven.swap_remove(found);
    let source = Source::new(draft(&found), found.home, true)?;
    project.tell_all(beyond_loom(&source.draft, loom, |_| found.at))?;
    Ok(source)
}

/// The draft of a weave, with the threads of its fabric.
fn draft(woven: &Woven) -> Draft {
    let mut draft = Draft::of_weave(&woven.weave);
    draft.title.clone_from(&woven.name);
    if let Some(Structure::Woven { warp, weft, .. }) = &woven.structure {
        let threads = |thread: &Thread, count: usize| Threads {
            colours: Some(vec![thread.colour; count]),
            spacing: Some(vec![wif::nanometres(thread.spacing); count]),
            thickness: Some(vec![wif::nanometres(thread.yarn.diameter); count]),
        };
        draft.warp = threads(warp, draft.ends());
        draft.weft = threads(weft, draft.picks());
    }
    draft
}

impl Source {
    fn new(draft: Draft, from: String, repeat: bool) -> Result<Source, Stop> {
        let drawn = draft.drawdown().map_err(|error| Stop::Call(error.to_string()))?;
        let (ends, picks) = draft.worked();
        let worked = Cloth::new(drawn.cropped(ends, picks));
        Ok(Source { draft, from, repeat, cloth: Cloth::new(drawn), worked })
    }

    /// The draft as it is drawn, with its cloth: a small repeat several times.
    pub fn drawn(&self) -> Result<Source, Stop> {
        const FEW: usize = 16;
        let times = |count: usize| if self.repeat { FEW.div_ceil(count.max(1)) } else { 1 };
        let draft = self.draft.repeated(times(self.draft.ends()), times(self.draft.picks()));
        Source::new(draft, self.from.clone(), self.repeat)
    }

    /// Which part of the file says what the picks lift.
    pub fn way(&self) -> &'static str {
        match self.draft.shedding {
            Shedding::Treadled { .. } => "treadling",
            Shedding::Lifted { .. } => "liftplan",
        }
    }
}
