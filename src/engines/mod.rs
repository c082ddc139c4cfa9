//! Inputs for engines of the discrete element method: a folder for each that runs as it is.
//!
//! Lengths are in metres, masses in kg, times in s. Each engine has a function that takes a [`Deck`] and gives the files
//! of its folder; [`Settled`] reads what LAMMPS leaves there.

mod anm;
mod deck;
mod engine;
mod error;
mod file;
mod kind;
mod lammps;
mod liggghts;
mod material;
mod mercury;
mod readme;
mod superellipsoid;
#[cfg(test)]
mod tests;
mod yade;

pub use anm::{AnmExpansion, InvalidAnm, anm_files, write_anm};
pub use deck::{Deck, GRAVITY, Placed};
pub use engine::Engine;
pub use error::InvalidDeck;
pub use file::InputFile;
pub use kind::{InvalidKind, Kind};
pub use lammps::{Settled, SettledError};
pub use material::GrainMaterial;
