//! Inputs for engines of the discrete element method: a folder for each that runs as it is.
//!
//! Lengths are in metres, masses in kg, times in s. Each engine has a function that takes a [`Deck`] and gives the files
//! of its folder; nothing is written here but text.

mod anm;
mod deck;
mod kind;
mod lammps;
mod liggghts;
mod mercury;
mod readme;
#[cfg(test)]
mod tests;
mod yade;

pub use anm::{AnmExpansion, anm_files, write_anm};
pub use deck::{Deck, GRAVITY, GrainMaterial, InvalidDeck, Placed};
pub use kind::{InvalidKind, Kind};

use std::str::FromStr;

/// An engine that spheres of clumps are written for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Engine {
    /// LAMMPS, from 2021 on: clumps as rigid bodies, with a data file, their inertia and an input script.
    Lammps,
    /// YADE: clumps, and a script that is run by it.
    Yade,
    /// LIGGGHTS: multispheres; of superquadrics of equal octants a second script.
    Liggghts,
    /// MercuryDPM: clumps as its tool MClump leaves them.
    MercuryDpm,
}

/// A file of a folder.
#[derive(Debug, Clone, PartialEq)]
pub struct InputFile {
    /// Its path in the folder, with `/` between names.
    pub path: String,
    /// What it says.
    pub text: String,
}

impl InputFile {
    fn new(path: impl Into<String>, text: impl Into<String>) -> Self {
        Self {
            path: path.into(),
            text: text.into(),
        }
    }
}

impl Engine {
    /// The files that let the engine run a deck, and a README that says how.
    pub fn files(self, deck: &Deck) -> Vec<InputFile> {
        match self {
            Self::Lammps => lammps::files(deck),
            Self::Yade => yade::files(deck),
            Self::Liggghts => liggghts::files(deck),
            Self::MercuryDpm => mercury::files(deck),
        }
    }
}

impl FromStr for Engine {
    type Err = &'static str;

    fn from_str(name: &str) -> Result<Self, Self::Err> {
        match name {
            "lammps" => Ok(Self::Lammps),
            "yade" => Ok(Self::Yade),
            "liggghts" => Ok(Self::Liggghts),
            "mercurydpm" => Ok(Self::MercuryDpm),
            _ => Err("expected lammps, yade, liggghts, mercurydpm or anm"),
        }
    }
}

/// Numbers with spaces between them, in the fewest digits that read back as the same.
fn row(numbers: impl IntoIterator<Item = f64>) -> String {
    let numbers: Vec<String> = numbers.into_iter().map(|x| format!("{x:e}")).collect();
    numbers.join(" ")
}
