//! `darzi check`: what is wrong with a file, in its own size and in all of its `grade`.

use super::project::Project;
use super::{Input, Stop, graded};
use crate::mesh;
use rayon::prelude::*;

#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  darzi check skirt.garment
  darzi check skirt.garment --set length=70cm
  darzi check skirt.garment --for \"EU 42\"
  darzi check skirt.garment --message-format json")]
pub(super) struct Check {
    #[command(flatten)]
    input: Input,
}

impl Check {
    pub(super) fn run(self) -> Result<(), Stop> {
        let mut project = Project::open(&self.input)?;
        let (garments, mut told) = project.evaluate(&self.input);
        let found: Vec<_> = garments.par_iter().map(mesh::examine).collect();
        told.extend(found.into_iter().filter_map(Result::err).flatten());
        if self.input.fit.is_none() {
            let sizes = graded::sizes(&mut project, &self.input, &garments, mesh::examine);
            told.extend(graded::beyond(&told, &sizes));
        }
        project.tell_all(told)
    }
}
