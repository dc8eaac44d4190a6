//! `darzi render`: the picture.

use super::bar::Bar;
use super::project::Project;
use super::{Input, Stop, Work, drape, output};
use crate::garment::scene::{Light, Picture, View};
use std::path::PathBuf;

#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  darzi render skirt.garment -o skirt.png
  darzi render skirt.garment -o skirt.png --view front,back --size 1600x1200
  darzi render skirt.garment -o long.png --set length=80cm")]
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

    #[command(flatten)]
    work: Work,
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
        let asked = garment.pictures.first();
        let picture = Picture {
            views: match (self.view.is_empty(), asked) {
                (false, _) => self.view,
                (true, Some(asked)) if !asked.views.is_empty() => asked.views.clone(),
                _ => vec![View::ThreeQuarter],
            },
            size: self.size.or(asked.map(|p| p.size)).unwrap_or([900, 1200]),
            light: asked.map_or(Light::Studio, |p| p.light),
        };
        let sheet = crate::render::render(
            &compiled,
            &draped,
            &picture,
            &Default::default(),
            &mut Bar::new(),
        );
        output::write_png(&self.output, &sheet)?;
        drape::verdict(&project, &garment, &draped)
    }
}
