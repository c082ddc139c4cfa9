//! The README of a folder: what runs it, what is in it, what its numbers mean.

use super::deck::Deck;
use super::file::InputFile;

/// Three lines.
pub(super) fn readme(deck: &Deck, needs: &str, command: &str, files: &str) -> InputFile {
    let kinds: Vec<String> = deck
        .kinds
        .iter()
        .map(|kind| {
            format!(
                "{} ({} spheres, {:.6e} kg)",
                kind.name,
                kind.spheres.len(),
                kind.mass
            )
        })
        .collect();
    let material = &deck.material;
    InputFile::new(
        "README",
        format!(
            "{} grains of {} fall into a box: run `{command}` in this folder ({needs}).\n{files}\nSI units (m, kg, s); \
             density {} kg/m³, Young's modulus {:e} Pa, Poisson's ratio {}, friction {}, restitution {}; mass, centre \
             and inertia are those of the grain, not of its spheres.\n",
            deck.grains.len(),
            kinds.join(", "),
            material.density,
            material.youngs_modulus,
            material.poissons_ratio,
            material.friction,
            material.restitution,
        ),
    )
}
