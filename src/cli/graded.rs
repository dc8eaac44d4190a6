//! One text, many sizes: a garment drafted anew for each size of its `grade`.

use super::Input;
use super::project::Project;
use crate::diagnostic::{Diagnostic, Label};
use crate::evaluate::Options;
use crate::garment::Garment;
use rayon::prelude::*;

/// The garments of a file in one size.
pub(super) struct Size<T> {
    /// Its name, `EU 38`.
    pub name: String,
    /// The garments that are cut in this size, with what was cut; those with mistakes are left
    /// out.
    pub cut: Vec<(Garment, T)>,
    /// What there is to say.
    pub told: Vec<Diagnostic>,
}

impl<T> Size<T> {
    /// Its name as that of a folder: `EU-38`.
    pub(super) fn folder(&self) -> String {
        let sign = |c: char| if c.is_alphanumeric() || c == '_' { c } else { '-' };
        self.name.chars().map(sign).collect()
    }
}

/// Drafts these garments in every size that they name, in the order in which the sizes are named
/// first, and cuts them with `cut`.
pub(super) fn sizes<T: Send>(
    project: &mut Project,
    input: &Input,
    garments: &[Garment],
    cut: impl Fn(&Garment) -> Result<T, Vec<Diagnostic>> + Sync,
) -> Vec<Size<T>> {
    let mut names: Vec<&str> = Vec::new();
    for size in garments.iter().flat_map(|garment| &garment.grade) {
        if !names.contains(&size.as_str()) {
            names.push(size);
        }
    }
    names
        .into_iter()
        .map(|size| {
            let wanted = garments.iter().filter(|garment| garment.grade.iter().any(|g| g == size));
            let asked = Options {
                set: input.set.clone(),
                names: wanted.map(|garment| garment.name.clone()).collect(),
                size: Some(size.to_owned()),
            };
            let (drafted, mut told) = project.evaluate_as(&asked);
            let results: Vec<_> = drafted.par_iter().map(&cut).collect();
            let mut sound = Vec::new();
            for (garment, result) in drafted.into_iter().zip(results) {
                match result {
                    Ok(result) => sound.push((garment, result)),
                    Err(wrong) => told.extend(wrong),
                }
            }
            Size { name: size.to_owned(), cut: sound, told }
        })
        .collect()
}

/// What the sizes say beyond what is said already. What several sizes say of one place is one
/// message, that of the first of them.
pub(super) fn beyond<T>(said: &[Diagnostic], sizes: &[Size<T>]) -> Vec<Diagnostic> {
    let mut found: Vec<(Diagnostic, Vec<&str>)> = Vec::new();
    let place = |told: &Diagnostic| told.labels.first().map(|label: &Label| label.span);
    for size in sizes {
        for told in size.told.iter().filter(|told| !said.contains(told)) {
            let same = found.iter_mut().find(|(other, _)| {
                other.code == told.code && place(other).is_some() && place(other) == place(told)
            });
            match same {
                Some((_, names)) if names.last() == Some(&size.name.as_str()) => {}
                Some((_, names)) => names.push(&size.name),
                None => found.push((told.clone(), vec![&size.name])),
            }
        }
    }
    found
        .into_iter()
        .map(|(told, names)| {
            let message = match names.as_slice() {
                [first] => format!("in size {first}: {}", told.message),
                [first, others @ ..] => {
                    format!("in size {first}, and in {}: {}", others.join(", "), told.message)
                }
                [] => told.message,
            };
            Diagnostic { message, ..told }
        })
        .collect()
}
