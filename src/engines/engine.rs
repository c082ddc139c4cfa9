//! Which engines there are, and what each is given.

use super::deck::Deck;
use super::file::InputFile;
use super::{lammps, liggghts, mercury, yade};
use std::str::FromStr;

/// An engine that grains are written for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Engine {
    /// LAMMPS, from 2021 on: clumps as rigid bodies, with a data file, their inertia and an input script; of superquadrics
    /// of equal octants a second script and data file, for versions from 30 March 2026 on.
    Lammps,
    /// YADE: clumps, and a script that is run by it.
    Yade,
    /// LIGGGHTS: multispheres; of superquadrics of equal octants a second script.
    Liggghts,
    /// MercuryDPM: clumps as its `ClumpInput.h` reads them.
    MercuryDpm,
}

impl Engine {
    /// The files that let the engine run a deck, and a README that says how.
    pub fn files(self, deck: &Deck) -> Vec<InputFile<'_>> {
        match self {
            Self::Lammps => lammps::files(deck),
            Self::Yade => yade::files(deck),
            Self::Liggghts => liggghts::files(deck),
            Self::MercuryDpm => mercury::files(deck),
        }
    }

    /// What the grains of a deck lose in the files, beside what they lose as clumps: in sentences.
    pub fn remarks(self, deck: &Deck) -> Vec<String> {
        match self {
            Self::Lammps => lammps::remarks(deck),
            Self::Liggghts => liggghts::remarks(deck),
            Self::Yade | Self::MercuryDpm => Vec::new(),
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
