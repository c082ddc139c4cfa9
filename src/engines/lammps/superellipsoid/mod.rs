//! LAMMPS: grains that are one superquadric each, as superellipsoids, for versions that know them.
//!
//! After the manual and the source of LAMMPS of 30 March 2026: `atom_style ellipsoid superellipsoid`, the pair style
//! `granular/superellipsoid`, and its examples. No wall of that version holds superellipsoids, and so walls are bodies
//! that do not move.

mod data;
mod law;
mod script;
#[cfg(test)]
mod tests;

use crate::engines::deck::Deck;
use crate::engines::file::InputFile;
use crate::engines::superellipsoid::{Superellipsoid, raised, superellipsoids};
use data::data;
use script::script;
use std::iter::once;

/// What the bodies are called.
const CALLED: &str = "superellipsoids";

/// The data file and the script, and what the README says of them; none unless [`bodies`] are.
pub(super) fn files(deck: &Deck) -> Option<([InputFile<'_>; 2], String)> {
    let bodies = bodies(deck)?;
    let (script, told) = (script(deck, &bodies), told(deck, &bodies));
    let files = [
        InputFile::streamed("data.superellipsoids", move |file| {
            data(deck, &bodies, file)
        }),
        InputFile::new("in.superellipsoids", script),
    ];
    Some((files, told))
}

fn told(deck: &Deck, bodies: &[Superellipsoid]) -> String {
    let told = "`lmp -in in.superellipsoids` is for LAMMPS of 30 March 2026 or later with ASPHERE, written after its manual \
                and not run here: the same grains as superellipsoids (data.superellipsoids) between walls that are five \
                more which do not move; the last of frames is where the grains lie.";
    let sentences: Vec<String> = once(told.into())
        .chain(raised(deck, bodies, CALLED))
        .collect();
    sentences.join(" ")
}

/// What the grains lose as superellipsoids, in sentences.
pub(in crate::engines) fn remarks(deck: &Deck) -> Vec<String> {
    let bodies = bodies(deck).unwrap_or_default();
    raised(deck, &bodies, CALLED)
}

/// The kinds, where each is one superquadric of equal octants and the walls are flat.
fn bodies(deck: &Deck) -> Option<Vec<Superellipsoid>> {
    let is_flat = deck.cylinder.is_none();
    is_flat.then(|| superellipsoids(deck)).flatten()
}
