//! `darzi fabric test`: a test of the laboratory, on the fabric as it is worked out.

use super::measure::figure;
use super::{Source, say_json};
use crate::cli::bar::Bar;
use crate::cli::{Stop, length, output, say};
use crate::diagnostic::Diagnostic;
use crate::garment::scene::{Picture, View};
use crate::laboratory::cantilever::{self, Direction, SLOPE};
use crate::laboratory::{Failure, Hung, cusick};
use crate::textile::fabric::Fabric;
use serde_json::json;
use std::fmt::Write;
use std::path::PathBuf;

#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  darzi fabric test cantilever wool
  darzi fabric test cusick wool -o wool.png
  darzi fabric test cusick jersey --specimen 24cm --json")]
pub(super) struct Test {
    /// The test
    #[arg(value_enum, value_name = "TEST")]
    test: Kind,

    /// The fabric's name
    #[arg(value_name = "FABRIC")]
    fabric: String,

    #[command(flatten)]
    source: Source,

    /// Diameter of the specimen of cusick: 24cm for limp cloths, 30cm, 36cm for stiff ones
    /// [default: 30cm]
    #[arg(long, value_name = "LENGTH", value_parser = specimen)]
    specimen: Option<f64>,

    /// Side of the grid cells, such as 2.5mm [default: 5mm for cusick, 20 cells of overhang for
    /// cantilever]
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    resolution: Option<f64>,

    /// A picture of the specimen, OUT.png
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,

    /// As JSON, SI units
    #[arg(long)]
    json: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Kind {
    /// Overhang, bending length and flexural rigidity (ISO 9073-7, ASTM D1388)
    Cantilever,
    /// Drape coefficient and nodes (ISO 9073-9)
    Cusick,
}

fn specimen(text: &str) -> Result<f64, String> {
    let metres = length(text)?;
    if cusick::SPECIMENS.iter().any(|known| (known - metres).abs() < 1e-6) {
        Ok(metres)
    } else {
        Err("specimens are cut with a diameter of 24cm, 30cm or 36cm".to_owned())
    }
}

impl Test {
    pub(super) fn run(self) -> Result<(), Stop> {
        if let Some(path) = &self.output {
            if path.extension().is_none_or(|e| e != "png") {
                return Err(Stop::Call("the output must end in .png".to_owned()));
            }
            output::expect_folder(path)?;
        }
        if self.specimen.is_some() && self.test != Kind::Cusick {
            return Err(Stop::Call("`--specimen` is for cusick".to_owned()));
        }
        let entry = self.source.fabric(&self.fabric)?;
        let hung = match self.test {
            Kind::Cantilever => self.cantilever(&entry.fabric)?,
            Kind::Cusick => self.cusick(&entry.fabric)?,
        };
        let Some(path) = &self.output else { return Ok(()) };
        let picture =
            Picture { views: vec![View::ThreeQuarter], size: [900, 900], ..Picture::default() };
        let Hung { compiled, draped } = &hung;
        let options = Default::default();
        let sheet = crate::render::render(compiled, draped, &picture, &options, &mut Bar::new());
        output::write_png(path, sheet)
    }

    fn cantilever(&self, fabric: &Fabric) -> Result<Hung, Stop> {
        let mut bar = Bar::new();
        let mut strip = |direction| {
            cantilever::test(fabric, direction, self.resolution, &mut bar).map_err(stop)
        };
        let (warp, hung) = strip(Direction::Warp)?;
        let (weft, _) = strip(Direction::Weft)?;
        drop(bar);
        let whole = (warp.rigidity * weft.rigidity).sqrt();
        if self.json {
            say_json(&json!({
                "test": "cantilever", "fabric": fabric.name, "slope": SLOPE,
                "strips": [warp, weft], "overall_rigidity": whole,
            }))?;
            return Ok(hung);
        }
        let mut out = format!(
            "cantilever  {}  strips of 25 mm, slope of {SLOPE}°\n\n{:18}{:>10}{:>10}\n",
            fabric.name, "", "warp", "weft"
        );
        let mut row = |name: &str, unit: &str, of: &dyn Fn(&cantilever::Reading) -> f64| {
            let [a, b] = [figure(of(&warp)), figure(of(&weft))];
            let _ = writeln!(out, "{}", format!("{name:18}{a:>10}{b:>10}  {unit}").trim_end());
        };
        row("overhang", "mm", &|it| it.overhang * 1e3);
        row("bending length", "mm", &|it| it.bending_length * 1e3);
        row("flexural rigidity", "µN·m", &|it| it.rigidity * 1e6);
        row("the fabric's B", "µN·m", &|it| it.given * 1e6);
        row("difference", "%", &|it| (it.rigidity / it.given - 1.0) * 100.0);
        let _ = writeln!(out, "{:18}{:>10}{:>10}  µN·m", "overall", figure(whole * 1e6), "");
        say(&out)?;
        Ok(hung)
    }

    fn cusick(&self, fabric: &Fabric) -> Result<Hung, Stop> {
        let diameter = self.specimen.unwrap_or(0.30);
        let mut bar = Bar::new();
        let (it, hung) = cusick::test(fabric, diameter, self.resolution, &mut bar).map_err(stop)?;
        drop(bar);
        if self.json {
            say_json(&json!({ "test": "cusick", "fabric": fabric.name, "specimen": it }))?;
            return Ok(hung);
        }
        let [least, greatest] = it.radius.map(|r| figure(r * 1e3));
        say(&format!(
            "cusick  {}  specimen of {} mm on a stage of {} mm\n\n\
             drape coefficient  {:>8.1}  %\n\
             nodes              {:>8}\n\
             shadow             {:>8}  cm²\n\
             radius             {:>8}  to {greatest} mm\n",
            fabric.name,
            figure(it.specimen * 1e3),
            figure(it.stage * 1e3),
            it.drape_coefficient * 100.0,
            it.nodes,
            figure(it.shadow * 1e4),
            least,
        ))?;
        Ok(hung)
    }
}

fn stop(failure: Failure) -> Stop {
    match failure {
        Failure::Unfit(why) => Stop::Test(why),
        // A specimen is cut by the program's own text: what is wrong is the call.
        Failure::Cut(told) => {
            let why = told.first().map_or("", |it: &Diagnostic| &it.message);
            Stop::Call(format!("the specimen cannot be cut: {why}"))
        }
    }
}
