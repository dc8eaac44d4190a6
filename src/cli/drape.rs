//! `darzi drape`: the dressed figure as .glb or .obj. Also the way from a garment to its drape
//! that `render` shares.

use super::bar::Bar;
use super::cache::Cache;
use super::project::Project;
use super::{Input, Stop, Work, output};
use crate::diagnostic::Diagnostic;
use crate::drape::draped::{Draped, Verdict};
use crate::garment::Garment;
use crate::mesh::compiled::Compiled;
use crate::{export, mesh};
use std::path::PathBuf;
use std::time::Instant;

#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  darzi drape skirt.garment -o skirt.glb
  darzi drape skirt.garment -o skirt.obj --with-body --stats skirt.json
  darzi drape skirt.garment -o skirt.glb --resolution 5mm --threads 1")]
pub(super) struct Drape {
    #[command(flatten)]
    input: Input,

    /// OUT.glb (textured, metres, y up) or OUT.obj (with OUT.mtl and OUT.TEXTILE.png beside it)
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,

    /// Write the wearer and the solids too
    #[arg(long)]
    with_body: bool,

    #[command(flatten)]
    work: Work,
}

impl Drape {
    pub(super) fn run(self) -> Result<(), Stop> {
        let kind = self.output.extension().and_then(|e| e.to_str()).unwrap_or_default().to_owned();
        if !matches!(kind.as_str(), "glb" | "obj") {
            return Err(Stop::Call("the output must end in .glb or .obj".to_owned()));
        }
        output::expect_folder(&self.output)?;
        let mut project = Project::open(&self.input)?;
        let garment = project.garment(&self.input)?;
        let (compiled, draped) = dress(&project, &garment, &self.work)?;
        if kind == "glb" {
            let bytes = export::glb::write(&compiled, &draped, self.with_body);
            output::write(&self.output, |out| out.write_all(&bytes))?;
        } else {
            self.write_obj(&compiled, &draped)?;
        }
        verdict(&project, &garment, &draped)
    }

    fn write_obj(&self, compiled: &Compiled, draped: &Draped) -> Result<(), Stop> {
        let stem = self.output.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let files = export::obj::write(compiled, draped, self.with_body, &stem);
        for (name, picture) in &files.pictures {
            output::write(&self.output.with_file_name(name), |out| out.write_all(picture))?;
        }
        output::write(&self.output.with_extension("mtl"), |out| out.write_all(&files.mtl))?;
        output::write(&self.output, |out| out.write_all(&files.obj))
    }
}

/// Grids that the drape climbs, coarse to fine, as multiples of the finest cell.
const RUNGS: [f64; 3] = [4.0, 2.0, 1.0];

/// Coarsest cell on which a garment is still recognisable, m.
const COARSEST: f64 = 0.031;

/// Compiles and drapes `garment`, or takes the drape from the cache; writes `--stats`.
pub(super) fn dress(
    project: &Project,
    garment: &Garment,
    work: &Work,
) -> Result<(Compiled, Draped), Stop> {
    if let Some(path) = &work.stats {
        output::expect_folder(path)?;
    }
    if let Some(threads) = work.threads {
        rayon::ThreadPoolBuilder::new()
            .num_threads(usize::from(threads))
            .build_global()
            .map_err(|e| Stop::Call(format!("cannot start {threads} threads: {e}")))?;
    }
    let start = Instant::now();
    let compile = |coarsen: f64| {
        let options = mesh::Options { cell: work.resolution, coarsen, atlas: coarsen <= 1.0 };
        mesh::compile(garment, &options)
    };
    let compiled = compile(1.0).map_err(|diagnostics| {
        project.tell(&diagnostics);
        Stop::Input
    })?;
    let compile_seconds = start.elapsed().as_secs_f64();

    let cache = if work.no_cache { None } else { Cache::of(&compiled) };
    let draped = match cache.as_ref().and_then(|c| c.load(&compiled)) {
        Some(draped) => draped,
        None => {
            let largest = compiled.panels.iter().map(|p| p.cell).fold(0.0, f64::max);
            let mut rungs = Vec::new();
            for coarsen in RUNGS {
                if coarsen > 1.0 && coarsen * largest <= COARSEST {
                    // A coarse grid may be too coarse for a small piece; the finer ones do.
                    rungs.extend(compile(coarsen).ok());
                }
            }
            rungs.push(compiled.clone());
            let mut draped = crate::drape::drape(&rungs, &Default::default(), &mut Bar::new())
                .map_err(|diagnostics| {
                    project.tell(&diagnostics);
                    Stop::Input
                })?;
            draped.stats.seconds.insert("compile".to_owned(), compile_seconds);
            if let Some(cache) = &cache {
                cache.keep(&draped);
            }
            draped
        }
    };
    if let Some(path) = &work.stats {
        output::write(path, |out| {
            serde_json::to_writer_pretty(&mut *out, &draped.stats)?;
            out.write_all(b"\n")
        })?;
    }
    Ok((compiled, draped))
}

/// Tells what the file asked of the drape and did not come to pass.
///
/// # Errors
/// [`Stop::Drape`] if there is such a thing.
pub(super) fn verdict(project: &Project, garment: &Garment, draped: &Draped) -> Result<(), Stop> {
    let stats = &draped.stats;
    let found = match stats.verdict {
        Verdict::Penetrating => Some(("E0802", "cloth is left inside a body")),
        Verdict::FellOff => Some(("E0809", "the garment fell off")),
        Verdict::Tangled => Some(("E0808", "the cloth passes through itself")),
        Verdict::Settled | Verdict::StillMoving => None,
    };
    // The reason may be what was found, in more words, or something else that came before it.
    let reason = stats.reason.as_deref();
    let (fuller, other) = match (found, reason) {
        (Some((_, found)), Some(reason)) if reason.starts_with(found) => (Some(reason), None),
        _ => (None, reason),
    };
    let missed = other.map(|reason| ("E0803", reason));
    let found = found.map(|(code, found)| (code, fuller.unwrap_or(found)));
    let told: Vec<Diagnostic> = missed
        .into_iter()
        .chain(found)
        .map(|(code, what)| {
            let message = format!("the drape did not reach what the file asks: {what}");
            let help = match code {
                "E0802" => "give it more ease, or place its pieces with a wider `gap`",
                "E0808" => "place its pieces with a wider `gap`, or take a finer `grid`",
                "E0809" => "hold it with `attach`, `pin` or `elastic`",
                _ => "place what is sewn together nearer, or give it longer: `within`",
            };
            Diagnostic::new(code, message).at(garment.span, "draped here").help(help)
        })
        .collect();
    project.tell(&told);
    if told.is_empty() { Ok(()) } else { Err(Stop::Drape) }
}
