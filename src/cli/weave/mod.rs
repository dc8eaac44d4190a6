//! `darzi weave`: drafts, from a weaver's file or a garment's text.

mod source;
mod stats;

use super::{MessageFormat, Stop, ends_with, output, say};
use crate::textile::objection::Loom;
use crate::textile::{paper, wif};
use source::Source;
use std::path::{Path, PathBuf};

#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  darzi weave blanket.wif                          what it is, and what a weaver would object to
  darzi weave blanket.wif --stats                  its figures as JSON
  darzi weave blanket.wif --draft blanket.png      the draft on paper, and the cloth
  darzi weave suit.garment --name serge --wif serge.wif
  darzi weave suit.garment --name birdseye         a weave of the library")]
pub(super) struct Weave {
    /// A .wif file, or a .garment file
    #[arg(value_name = "FILE")]
    file: PathBuf,

    /// Which weave or fabric of the .garment file or the library
    #[arg(long, value_name = "NAME")]
    name: Option<String>,

    /// Draw the draft, with the cloth beside it
    #[arg(long, value_name = "FILE.png|.svg")]
    draft: Option<PathBuf>,

    /// Write it as a weaving file that other programs read
    #[arg(long, value_name = "FILE")]
    wif: Option<PathBuf>,

    /// Shafts of your loom; told where the draft wants more
    #[arg(long, value_name = "N")]
    shafts: Option<usize>,

    /// Treadles of your loom; told where the draft wants more
    #[arg(long, value_name = "N")]
    treadles: Option<usize>,

    /// Print its figures as one JSON object
    #[arg(long)]
    stats: bool,

    /// How messages are written
    #[arg(long, value_enum, default_value_t = MessageFormat::Human)]
    message_format: MessageFormat,
}

impl Weave {
    pub(super) fn run(self) -> Result<(), Stop> {
        if let Some(path) = &self.wif {
            if !ends_with(path, &["wif"]) {
                let path = path.display();
                return Err(Stop::Call(format!("`{path}` is not a .wif file")));
            }
            output::expect_folder(path)?;
        }
        if let Some(path) = &self.draft {
            if !ends_with(path, &["png", "svg"]) {
                let path = path.display();
                return Err(Stop::Call(format!("`{path}` is neither a .png nor a .svg file")));
            }
            output::expect_folder(path)?;
        }
        let loom = Loom { shafts: self.shafts, treadles: self.treadles };
        let source = source::read(&self.file, self.name.as_deref(), &loom, self.message_format)?;
        if let Some(path) = &self.wif {
            let text = wif::write(&source.draft);
            output::write(path, |out| out.write_all(text.as_bytes()))?;
        }
        if let Some(path) = &self.draft {
            draw(path, &source)?;
        }
        let figures = stats::Figures::of(&source);
        if self.stats {
            return say(&format!("{:#}\n", figures.json()));
        }
        if self.wif.is_none() && self.draft.is_none() {
            return say(&figures.summary());
        }
        Ok(())
    }
}

fn draw(path: &Path, source: &Source) -> Result<(), Stop> {
    let source = source.drawn()?;
    let drawing = paper::drawing(&source.draft, &source.worked);
    let whole = (source.worked.picks.ends(), source.worked.picks.picks());
    if drawing.shown != whole {
        let (ends, picks) = drawing.shown;
        say(&format!("{}: the first {ends} ends and {picks} picks\n", path.display()))?;
    }
    if ends_with(path, &["svg"]) {
        let text = paper::svg(&drawing.sheet);
        return output::write(path, |out| out.write_all(text.as_bytes()));
    }
    output::write_png(path, paper::paint(&drawing.sheet))
}
