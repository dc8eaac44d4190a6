//! `darzi compile`: mesh.json and atlas.png.

use super::project::Project;
use super::{Input, Stop, output};
use crate::mesh;
use std::path::PathBuf;

#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  darzi compile skirt.garment -o out               writes out/mesh.json and out/atlas.png
  darzi compile skirt.garment -o out --resolution 4mm")]
pub(super) struct Compile {
    #[command(flatten)]
    input: Input,

    /// Folder for mesh.json and atlas.png; made if it is not there
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,

    /// Side of the grid cells, such as 5mm; the file's own where not given
    #[arg(long, value_name = "LENGTH", value_parser = super::length)]
    resolution: Option<f64>,
}

impl Compile {
    pub(super) fn run(self) -> Result<(), Stop> {
        let mut project = Project::open(&self.input)?;
        let garment = project.garment(&self.input)?;
        let options = mesh::Options { cell: self.resolution, ..Default::default() };
        let compiled = mesh::compile(&garment, &options).map_err(|diagnostics| {
            project.tell(&diagnostics);
            Stop::Input
        })?;
        std::fs::create_dir_all(&self.output).map_err(|e| {
            Stop::Call(format!("cannot make the folder `{}`: {e}", self.output.display()))
        })?;
        let atlas = &compiled.atlas;
        if let Some(picture) =
            image::RgbaImage::from_raw(atlas.width, atlas.height, atlas.pixels.clone())
        {
            output::write_png(&self.output.join("atlas.png"), &picture)?;
        }
        output::write(&self.output.join("mesh.json"), |out| mesh::json::write(&compiled, out))
    }
}
