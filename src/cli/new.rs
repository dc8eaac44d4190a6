//! `darzi new`: a commented starter file.

use super::{Stop, output};
use std::path::PathBuf;

const STARTER: &str = include_str!("../../stdlib/starter.garment");

#[derive(Debug, clap::Args)]
#[command(after_help = "Example:
  darzi new skirt                                  writes skirt.garment")]
pub(super) struct New {
    /// Name of the garment: letters, digits and _; it becomes the name of the file
    name: String,
}

impl New {
    pub(super) fn run(self) -> Result<(), Stop> {
        let name = self.name.strip_suffix(".garment").unwrap_or(&self.name);
        let good = name.chars().next().is_some_and(|c| c.is_ascii_alphabetic() || c == '_')
            && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
            && name.len() <= 64;
        if !good {
            return Err(Stop::Call(format!(
                "`{name}` cannot name a garment; use letters, digits and _, a letter first"
            )));
        }
        let path = PathBuf::from(format!("{name}.garment"));
        if path.exists() {
            return Err(Stop::Call(format!("`{}` is there already", path.display())));
        }
        let text = STARTER.replace("my_skirt", name);
        output::write(&path, |out| out.write_all(text.as_bytes()))?;
        eprintln!("wrote {name}.garment; try: darzi render {name}.garment -o {name}.png");
        Ok(())
    }
}
