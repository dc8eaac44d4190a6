//! `darzi check`: what is wrong with a file, in its own size and in all of its `grade`.

use super::project::Project;
use super::{Input, Stop, graded};

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
        // Nothing can be wrong with the picture of the textiles.
        let options = crate::mesh::Options { atlas: false, ..Default::default() };
        for garment in &garments {
            let compiled = crate::mesh::compile(garment, &options);
            told.extend(compiled.err().into_iter().flatten());
        }
        if self.input.fit.is_none() {
            let sizes = graded::sizes(&mut project, &self.input, &garments, &options);
            told.extend(graded::beyond(&told, &sizes));
        }
        project.tell_all(told)
    }
}
