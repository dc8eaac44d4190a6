//! The library of the language, carried inside the program.

/// A file of the library: its name in `use`, and its text.
const FILES: &[(&str, &str)] = &[
    ("std::ang", include_str!("../../stdlib/ang.garment")),
    ("std::bodice", include_str!("../../stdlib/bodice.garment")),
    ("std::body", include_str!("../../stdlib/body.garment")),
    ("std::collar", include_str!("../../stdlib/collar.garment")),
    ("std::color", include_str!("../../stdlib/color.garment")),
    ("std::fabric", include_str!("../../stdlib/fabric.garment")),
    ("std::indian", include_str!("../../stdlib/indian.garment")),
    ("std::kath", include_str!("../../stdlib/kath.garment")),
    ("std::knit", include_str!("../../stdlib/knit.garment")),
    ("std::motif", include_str!("../../stdlib/motif.garment")),
    ("std::padar", include_str!("../../stdlib/padar.garment")),
    ("std::skirt", include_str!("../../stdlib/skirt.garment")),
    ("std::sleeve", include_str!("../../stdlib/sleeve.garment")),
    ("std::trousers", include_str!("../../stdlib/trousers.garment")),
    ("std::weave", include_str!("../../stdlib/weave.garment")),
    ("std::yarn", include_str!("../../stdlib/yarn.garment")),
];

/// The text of a library file by its name, `std::fabric`.
pub fn text(name: &str) -> Option<&'static str> {
    FILES.iter().find(|(known, _)| *known == name).map(|(_, text)| *text)
}

/// The names of all library files, in order.
pub fn names() -> impl Iterator<Item = &'static str> {
    FILES.iter().map(|(name, _)| *name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    #[test]
    fn every_file_of_the_library_is_carried_along() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("stdlib");
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            // The starter is what `darzi new` writes, no module.
            if path.extension().is_none_or(|end| end != "garment")
                || path.ends_with("starter.garment")
            {
                continue;
            }
            let name = format!("std::{}", path.file_stem().unwrap().to_str().unwrap());
            let carried = text(&name).unwrap_or_else(|| panic!("add {name} to FILES"));
            assert_eq!(carried, std::fs::read_to_string(&path).unwrap());
        }
    }

    #[test]
    fn names_are_in_order() {
        let names: Vec<_> = names().collect();
        assert!(names.windows(2).all(|pair| pair[0] < pair[1]));
    }
}
