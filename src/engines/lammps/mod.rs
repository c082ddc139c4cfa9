//! LAMMPS: clumps as rigid bodies, and superellipsoids for versions that know them.
//!
//! Clumps are written as the versions of 2021 and those of 2025 read them: no overlap keywords, no kinetic energy of
//! atoms.

mod rest;
mod script;
mod settled;
mod superellipsoid;

use super::deck::Deck;
use super::file::{InputFile, row};
use super::readme::runs;
use script::script;
pub use settled::{Settled, SettledError};
use std::io::{self, Write};
pub(super) use superellipsoid::remarks;

pub(super) fn files(deck: &Deck) -> Vec<InputFile<'_>> {
    let mut files = vec![
        InputFile::streamed("data.clumps", |file| data(deck, file)),
        InputFile::streamed("bodies.in", |file| bodies(deck, file)),
        InputFile::new("in.settle", script(deck)),
    ];
    let mut told = String::from(
        "data.clumps holds the spheres, bodies.in mass, centre and inertia of each grain, in.settle the run; \
         frames shows the grains as they fall, settled.dump is where the spheres lie at the end, grains.dump the \
         grains, contacts.dump which spheres touch and how hard.",
    );
    if let Some((more, of_them)) = superellipsoid::files(deck) {
        files.extend(more);
        told += &format!(" {of_them}");
    }
    files.push(runs(
        deck,
        "LAMMPS with the packages GRANULAR and RIGID",
        "`lmp -in in.settle`, or `mpirun -n 4 lmp -in in.settle`,",
        &told,
    ));
    files
}

/// The spheres, each of the molecule of its grain. Their density is the material's: what moves has mass and inertia of
/// `bodies.in`.
fn data(deck: &Deck, file: &mut dyn Write) -> io::Result<()> {
    let count = deck.spheres();
    let [low, high] = match deck.cylinder {
        None => [[0.0; 2], deck.floor],
        Some(radius) => [[-radius; 2], [radius; 2]],
    };
    let height = deck.height;
    write!(
        file,
        "# clumps by grainform, SI units\n\n{count} atoms\n1 atom types\n{:e} {:e} xlo xhi\n{:e} {:e} ylo yhi\n\
         0 {height:e} zlo zhi\n\nAtoms # sphere\n\n",
        low[0], high[0], low[1], high[1],
    )?;
    let balls = || {
        let grains = deck.grains.iter().enumerate();
        let balls = grains.flat_map(|(index, grain)| {
            let own = deck.kinds[grain.kind].spheres.iter();
            own.map(move |ball| (index, grain, ball))
        });
        balls.enumerate()
    };
    for (at, (_, grain, ball)) in balls() {
        let place = grain.centre + grain.turn * ball.centre.coords;
        let numbers = [2.0 * ball.radius, deck.material.density];
        let numbers = row(numbers.into_iter().chain(place.iter().copied()));
        writeln!(file, "{} 1 {numbers}", at + 1)?;
    }
    writeln!(file, "\nMolecules\n")?;
    for (at, (index, ..)) in balls() {
        writeln!(file, "{} {}", at + 1, index + 1)?;
    }
    Ok(())
}

/// Of each grain: mass, centre of mass, inertia xx yy zz xy xz yz in space, velocity, angular momentum, image flags.
fn bodies(deck: &Deck, file: &mut dyn Write) -> io::Result<()> {
    writeln!(file, "{}", deck.grains.len())?;
    for (index, grain) in deck.grains.iter().enumerate() {
        let kind = &deck.kinds[grain.kind];
        let inertia = kind.inertia(&grain.turn);
        let tensor = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)].map(|at| inertia[at]);
        let numbers = [kind.mass]
            .into_iter()
            .chain(grain.centre.iter().copied())
            .chain(tensor)
            .chain(grain.velocity.iter().copied());
        writeln!(file, "{} {} 0 0 0 0 0 0", index + 1, row(numbers))?;
    }
    Ok(())
}
