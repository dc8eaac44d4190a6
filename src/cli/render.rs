//! `darzi render`: the picture.

use super::bar::Bar;
use super::project::Project;
use super::{Input, Stop, Work, drape, output};
use crate::garment::scene::{Background, Picture, Quality, Shading, View};
use crate::mesh::compiled::Compiled;
use crate::render::{Options, Pass};
use std::path::PathBuf;

#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  darzi render skirt.garment -o skirt.png
  darzi render skirt.garment -o skirt.png --view front,back --size 1600x1200
  darzi render skirt.garment -o long.png --set length=80cm
  darzi render skirt.garment -o cloth.png --field 3cm --quality fine
  darzi render skirt.garment -o turn.png --turntable 36 --background none
  darzi render skirt.garment -o skirt.png --passes depth,strain")]
pub(super) struct Render {
    #[command(flatten)]
    input: Input,

    /// The picture, OUT.png
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,

    /// front, side, back, three_quarter or top; several with commas make a sheet
    /// [default: the file's own, else three_quarter]
    #[arg(long, value_name = "VIEW", value_delimiter = ',', value_parser = view)]
    view: Vec<View>,

    /// Pixels of the whole picture [default: the file's own, else 900x1200]
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<[u32; 2]>,

    /// How all cloth is shown: gouraud, smooth, textured, velvet, satin, woven, woven_satin,
    /// knitted or knitted_yarns [default: the file's own, else each fabric as what it is]
    #[arg(long, value_name = "NAME", value_parser = shading)]
    shading: Option<Shading>,

    /// draft, normal or fine [default: the file's own, else normal]
    #[arg(long, value_name = "NAME", value_parser = quality)]
    quality: Option<Quality>,

    /// paper, or none for a transparent picture [default: the file's own, else paper]
    #[arg(long, value_name = "NAME", value_parser = background)]
    background: Option<Background>,

    /// Show only so much of the cloth, up and down: 4cm [default: the file's own, else all]
    #[arg(long, value_name = "LENGTH", value_parser = field)]
    field: Option<f64>,

    /// Go so far round the figure, towards the wearer's left: 30deg [default: the file's own]
    #[arg(long, value_name = "ANGLE", value_parser = angle, allow_hyphen_values = true)]
    turn: Option<f64>,

    /// So many pictures on the way once round, OUT.000.png, OUT.001.png …, not OUT.png itself
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(2..=999))]
    turntable: Option<u16>,

    /// Beside the picture, figures for every pixel as OUT.NAME.png: depth (0.1 mm), normal, fabric
    /// (its number), strain (0.01 %); several with commas
    #[arg(long, value_name = "NAME", value_delimiter = ',', value_parser = pass)]
    passes: Vec<Pass>,

    #[command(flatten)]
    work: Work,
}

fn pass(text: &str) -> Result<Pass, String> {
    Pass::ALL
        .into_iter()
        .find(|pass| pass.name() == text)
        .ok_or_else(|| format!("passes are {}", Pass::ALL.map(Pass::name).join(", ")))
}

fn angle(text: &str) -> Result<f64, String> {
    let degrees = text.strip_suffix("deg").and_then(|number| number.trim().parse::<f64>().ok());
    match degrees {
        Some(degrees) if degrees.abs() <= 360.0 => Ok(degrees.to_radians()),
        Some(_) => Err("a turn goes once round at most".to_owned()),
        None => Err(format!("`{text}` is not an angle; write it as 30deg")),
    }
}

fn shading(text: &str) -> Result<Shading, String> {
    Shading::named(text).ok_or_else(|| {
        format!("ways of shading are {}", Shading::ALL.map(Shading::name).join(", "))
    })
}

fn quality(text: &str) -> Result<Quality, String> {
    Ok(match text {
        "draft" => Quality::Draft,
        "normal" => Quality::Normal,
        "fine" => Quality::Fine,
        _ => return Err("qualities are draft, normal, fine".to_owned()),
    })
}

fn background(text: &str) -> Result<Background, String> {
    Ok(match text {
        "paper" => Background::Paper,
        "none" => Background::None,
        _ => return Err("backgrounds are paper, none".to_owned()),
    })
}

fn field(text: &str) -> Result<f64, String> {
    let metres = super::metres(text)?;
    if (2e-3..=10.0).contains(&metres) {
        Ok(metres)
    } else {
        Err("a field lies between 2mm and 10m".to_owned())
    }
}

fn view(text: &str) -> Result<View, String> {
    Ok(match text {
        "front" => View::Front,
        "side" => View::Side,
        "back" => View::Back,
        "three_quarter" => View::ThreeQuarter,
        "top" => View::Top,
        _ => return Err("views are front, side, back, three_quarter, top".to_owned()),
    })
}

fn size(text: &str) -> Result<[u32; 2], String> {
    let numbers = text.split_once('x').and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
    match numbers {
        Some([w, h]) if (16..=16384).contains(&w) && (16..=16384).contains(&h) => Ok([w, h]),
        Some(_) => Err("a picture is 16 to 16384 pixels wide and high".to_owned()),
        None => Err("write it as 900x1200".to_owned()),
    }
}

impl Render {
    pub(super) fn run(self) -> Result<(), Stop> {
        if self.output.extension().is_none_or(|e| e != "png") {
            return Err(Stop::Call("the output must end in .png".to_owned()));
        }
        output::expect_folder(&self.output)?;
        let mut project = Project::open(&self.input)?;
        let garment = project.garment(&self.input)?;
        let (compiled, draped) = drape::dress(&project, &garment, &self.work)?;
        let own = garment.pictures.first().cloned();
        let asked = own.as_ref();
        let usual = Picture::default();
        let shading = self.shading.or(asked.and_then(|p| p.shading));
        if let Some((shading, fabric)) = shading.and_then(|s| Some((s, unsuited(s, &compiled)?))) {
            return Err(Stop::Call(format!(
                "`{fabric}` cannot be shown as `{}` (`darzi explain E0815` says more)",
                shading.name()
            )));
        }
        let picture = Picture {
            views: match (self.view.is_empty(), asked) {
                (false, _) => self.view,
                (true, Some(asked)) if !asked.views.is_empty() => asked.views.clone(),
                _ => vec![View::ThreeQuarter],
            },
            size: self.size.or(asked.map(|p| p.size)).unwrap_or(usual.size),
            light: asked.map_or(usual.light, |p| p.light),
            shading,
            quality: self.quality.or(asked.map(|p| p.quality)).unwrap_or_default(),
            background: self.background.or(asked.map(|p| p.background)).unwrap_or_default(),
            field: self.field.or(asked.and_then(|p| p.field)),
            turn: self.turn.or(asked.and_then(|p| p.turn)),
        };
        let turns: Vec<Option<f64>> = match self.turntable {
            Some(count) => {
                let share = |k: u16| f64::from(k) / f64::from(count) * std::f64::consts::TAU;
                (0..count).map(|k| Some(picture.turn.unwrap_or(0.0) + share(k))).collect()
            }
            None => vec![picture.turn],
        };
        for (number, turn) in turns.into_iter().enumerate() {
            let picture = Picture { turn, ..picture.clone() };
            let path = match self.turntable {
                Some(_) => self.output.with_extension(format!("{number:03}.png")),
                None => self.output.clone(),
            };
            let options = Options::of(picture.quality);
            let sheet =
                crate::render::render(&compiled, &draped, &picture, &options, &mut Bar::new());
            output::write_png(&path, sheet)?;
            if !self.passes.is_empty() {
                let images = crate::render::passes(&compiled, &draped, &picture, &self.passes);
                for (pass, image) in self.passes.iter().zip(images) {
                    let end = format!("{}.png", pass.name());
                    output::write_png(&path.with_extension(end), image)?;
                }
            }
        }
        drape::verdict(&project, &garment, &draped)
    }
}

/// A fabric that is shown and cannot be shown so.
fn unsuited(shading: Shading, compiled: &Compiled) -> Option<String> {
    let shown = compiled.panels.iter().filter_map(|panel| compiled.fabrics.get(panel.fabric));
    let other = shown.into_iter().find(|fabric| !shading.suits(&fabric.structure))?;
    Some(other.name.clone())
}
