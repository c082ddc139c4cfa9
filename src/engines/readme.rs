//! The README of a folder: what is done with it, what is in it, what its numbers mean.

use super::deck::Deck;
use super::file::InputFile;
use crate::digits::{given, plural};

/// The README of a folder that an engine runs, in three lines.
pub(super) fn runs(deck: &Deck, needs: &str, command: &str, files: &str) -> InputFile<'static> {
    let count = deck.grains.len();
    let kinds = kinds(deck);
    let first = format!(
        "{count} grains of {kinds} fall into a box: run {command} in this folder ({needs})."
    );
    let material = &deck.material;
    let rolling = match material.rolling_friction > 0.0 {
        true => format!(", rolling friction {}", given(material.rolling_friction)),
        false => String::new(),
    };
    let contact = format!(
        ", Young's modulus {:e} Pa, Poisson's ratio {}, friction {}{rolling}, restitution {}",
        material.youngs_modulus,
        given(material.poissons_ratio),
        given(material.friction),
        given(material.restitution),
    );
    readme(deck, &first, files, &contact)
}

/// A README whose first two lines are given, and what follows the density; what is not to be relied on of the grains ends it.
pub(super) fn readme(deck: &Deck, first: &str, files: &str, contact: &str) -> InputFile<'static> {
    let density = given(deck.material.density);
    let doubts = deck.kinds.iter().flat_map(|kind| {
        let name = &kind.name;
        kind.doubts
            .iter()
            .map(move |doubt| format!("{name}: {doubt}\n"))
    });
    InputFile::new(
        "README",
        format!(
            "{first}\n{files}\nSI units (m, kg, s); density {density} kg/m³{contact}; mass and inertia are those of the grain, not \
             sums over its spheres.\n{}",
            doubts.collect::<String>(),
        ),
    )
}

/// What the kinds are called, and how many spheres and how much mass each has.
pub(super) fn kinds(deck: &Deck) -> String {
    let kinds = deck.kinds.iter().map(|kind| {
        let spheres = plural(kind.spheres.len(), "sphere");
        format!("{} ({spheres}, {:.6e} kg)", kind.name, kind.mass)
    });
    kinds.collect::<Vec<_>>().join(", ")
}
