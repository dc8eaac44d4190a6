//! `darzi knit`: charts and programs of knitting machines.

mod source;
mod stats;

use super::{MessageFormat, Stop, ends_with, output, say};
use crate::textile::{knitout, paper};
use source::Source;
use std::path::{Path, PathBuf};

#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  darzi knit scarf.k                               what a program of a machine makes, and what is wrong
  darzi knit lace.json --chart lace.png            a chart of KnitScape, drawn
  darzi knit pullover.garment --name aran --chart aran.svg
  darzi knit pullover.garment --name aran --repeat 3x4 --knitout aran.k
  darzi knit pullover.garment --name moss --stats  a knit of the library, its figures as JSON")]
pub(super) struct Knit {
    /// A .k file, a .json file of KnitScape, or a .garment file
    #[arg(value_name = "FILE")]
    file: PathBuf,

    /// Which knit or knitted fabric of the .garment file or the library
    #[arg(long, value_name = "NAME")]
    name: Option<String>,

    /// Draw the chart with its legend; of a program, what each pass of the carriage makes
    #[arg(long, value_name = "FILE.png|.svg")]
    chart: Option<PathBuf>,

    /// Write a program that a knitting machine with two beds can run
    #[arg(long, value_name = "FILE.k")]
    knitout: Option<PathBuf>,

    /// Knit a chart so many times side by side and above itself
    #[arg(long, value_name = "ACROSSxUP", value_parser = times)]
    repeat: Option<[usize; 2]>,

    /// Print its figures as one JSON object
    #[arg(long)]
    stats: bool,

    /// How messages are written
    #[arg(long, value_enum, default_value_t = MessageFormat::Human)]
    message_format: MessageFormat,
}

fn times(text: &str) -> Result<[usize; 2], String> {
    let count = |text: &str| text.trim().parse::<usize>().ok().filter(|count| *count > 0);
    let both = text.split_once(['x', '×']).and_then(|(a, b)| Some([count(a)?, count(b)?]));
    both.ok_or_else(|| "write ACROSSxUP, such as 3x4".to_owned())
}

impl Knit {
    pub(super) fn run(self) -> Result<(), Stop> {
        if let Some(path) = &self.knitout {
            if !ends_with(path, &["k"]) {
                return Err(Stop::Call(format!("`{}` is not a .k file", path.display())));
            }
            output::expect_folder(path)?;
        }
        if let Some(path) = &self.chart {
            if !ends_with(path, &["png", "svg"]) {
                let path = path.display();
                return Err(Stop::Call(format!("`{path}` is neither a .png nor a .svg file")));
            }
            output::expect_folder(path)?;
        }
        let source =
            source::read(&self.file, self.name.as_deref(), self.repeat, self.message_format)?;
        if let Some(path) = &self.knitout {
            let text = knitout::write(&source.program()?);
            output::write(path, |out| out.write_all(text.as_bytes()))?;
        }
        if let Some(path) = &self.chart {
            draw(path, &source)?;
        }
        if self.stats {
            return say(&format!("{:#}\n", stats::json(&source)));
        }
        if self.knitout.is_none() && self.chart.is_none() {
            return say(&stats::summary(&source));
        }
        Ok(())
    }
}

fn draw(path: &Path, source: &Source) -> Result<(), Stop> {
    let (chart, aspect, yarn, whole) = source.chart()?;
    if !whole {
        let (stitches, rows) = (chart.width(), chart.height());
        say(&format!("{}: the first {stitches} needles and {rows} passes\n", path.display()))?;
    }
    let sheet = paper::chart(&chart, source.title(), aspect, yarn);
    if ends_with(path, &["svg"]) {
        let text = paper::svg(&sheet);
        return output::write(path, |out| out.write_all(text.as_bytes()));
    }
    output::write_png(path, paper::paint(&sheet))
}
