//! `darzi compile`: mesh.json and atlas.png.

use super::project::Project;
use super::{Input, Stop, graded, output};
use crate::mesh::{self, compiled::Compiled};
use std::path::{Path, PathBuf};

#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  darzi compile skirt.garment -o out               writes out/mesh.json and out/atlas.png
  darzi compile skirt.garment -o out --resolution 4mm
  darzi compile skirt.garment -o out --grade       writes out/EU-36/mesh.json, out/EU-38/mesh.json, …")]
pub(super) struct Compile {
    #[command(flatten)]
    input: Input,

    /// Folder for mesh.json and atlas.png; made if it is not there
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,

    /// Side of the grid cells, such as 5mm; the file's own where not given
    #[arg(long, value_name = "LENGTH", value_parser = super::length)]
    resolution: Option<f64>,

    /// Write one mesh for each size that the garment's `grade` names, into folders such as DIR/EU-38
    #[arg(long, conflicts_with = "fit")]
    grade: bool,
}

impl Compile {
    pub(super) fn run(self) -> Result<(), Stop> {
        let mut project = Project::open(&self.input)?;
        let garment = project.garment(&self.input)?;
        let options = mesh::Options { cell: self.resolution, ..Default::default() };
        if self.grade {
            if garment.grade.is_empty() {
                return Err(Stop::Call(format!(
                    "`{}` names no sizes; give it some, such as `grade: EU 36, EU 38`",
                    garment.name
                )));
            }
            let sizes = graded::sizes(&mut project, &self.input, &[garment], |garment| {
                mesh::compile(garment, &options)
            });
            project.tell_all(graded::beyond(&[], &sizes))?;
            for size in &sizes {
                for (_, compiled) in &size.cut {
                    keep(&self.output.join(size.folder()), compiled)?;
                }
            }
            return Ok(());
        }
        let compiled = mesh::compile(&garment, &options).map_err(|diagnostics| {
            project.tell(&diagnostics);
            Stop::Input
        })?;
        keep(&self.output, &compiled)
    }
}

/// Writes a mesh and the picture of its textiles into a folder, made if it is not there.
fn keep(folder: &Path, compiled: &Compiled) -> Result<(), Stop> {
    std::fs::create_dir_all(folder)
        .map_err(|e| Stop::Call(format!("cannot make the folder `{}`: {e}", folder.display())))?;
    let atlas = &compiled.atlas;
    if let Some(picture) =
        image::RgbaImage::from_raw(atlas.width, atlas.height, atlas.pixels.clone())
    {
        output::write_png(&folder.join("atlas.png"), picture)?;
    }
    output::write(&folder.join("mesh.json"), |out| mesh::json::write(compiled, out))
}
