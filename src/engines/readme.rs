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
    readme(deck, &first, files)
}

/// A README whose first two lines are given; what is not to be relied on of the grains ends it.
pub(super) fn readme(deck: &Deck, first: &str, files: &str) -> InputFile<'static> {
    let material = &deck.material;
    let doubts = deck.kinds.iter().flat_map(|kind| {
        let name = &kind.name;
        kind.doubts
            .iter()
            .map(move |doubt| format!("{name}: {doubt}\n"))
    });
    InputFile::new(
        "README",
        format!(
            "{first}\n{files}\nSI units (m, kg, s); density {} kg/m³, Young's modulus {:e} Pa, Poisson's ratio {}, friction \
             {}, restitution {}; mass and inertia are those of the grain, not sums over its spheres.\n{}",
            given(material.density),
            material.youngs_modulus,
            given(material.poissons_ratio),
            given(material.friction),
            given(material.restitution),
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
