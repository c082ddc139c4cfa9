//! LAMMPS: clumps as rigid bodies, and superellipsoids for versions that know them.
//!
//! Clumps are written as the versions of 2021 and those of 2025 read them: no overlap keywords, no kinetic energy of
//! atoms.

mod rest;
mod script;
mod settled;
mod superellipsoid;

use super::deck::{Deck, Placed};
use super::file::{InputFile, row};
use super::kind::Kind;
use super::readme::runs;
use crate::measure::Ball;
use nalgebra::Vector3;
use script::script;
pub use settled::{Settled, SettledError};
use std::io::{self, Write};
pub(super) use superellipsoid::remarks;

/// Radius of the second particle of a grain of one sphere, and how far from the middle it is, over the radius of the sphere: deep in
/// it, where it touches nothing.
const COMPANION: f64 = 1e-3;
const ASIDE: f64 = 0.1;

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
    if deck
        .grains
        .iter()
        .any(|grain| companion(kind(deck, grain)).is_some())
    {
        told += " A grain of one sphere has a tiny one within it, for LAMMPS moves bodies of two and more. These come last in \
                 data.clumps, and touch nothing.";
    }
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

fn kind<'a>(deck: &'a Deck, grain: &Placed) -> &'a Kind {
    &deck.kinds[grain.kind]
}

/// The second particle of a kind of one sphere.
fn companion(kind: &Kind) -> Option<Ball> {
    let [Ball { centre, radius }] = kind.spheres[..] else {
        return None;
    };
    Some(Ball {
        centre: centre + Vector3::x() * (ASIDE * radius),
        radius: COMPANION * radius,
    })
}

/// The spheres, and then the companions of those that are alone, each of the molecule of its grain. Their density is the material's: what moves has mass and inertia of
/// `bodies.in`.
fn data(deck: &Deck, file: &mut dyn Write) -> io::Result<()> {
    let [low, high] = match deck.cylinder {
        None => [[0.0; 2], deck.floor],
        Some(radius) => [[-radius; 2], [radius; 2]],
    };
    let height = deck.height;
    let grains = || deck.grains.iter().enumerate();
    let balls = || {
        let own = grains().flat_map(|(index, grain)| {
            let balls = kind(deck, grain).spheres.iter();
            balls.map(move |ball| (index, grain, *ball))
        });
        let companions = grains().filter_map(|(index, grain)| {
            let ball = companion(kind(deck, grain))?;
            Some((index, grain, ball))
        });
        own.chain(companions).enumerate()
    };
    let count = balls().count();
    write!(
        file,
        "# clumps by grainform, SI units\n\n{count} atoms\n1 atom types\n{:e} {:e} xlo xhi\n{:e} {:e} ylo yhi\n\
         0 {height:e} zlo zhi\n\nAtoms # sphere\n\n",
        low[0], high[0], low[1], high[1],
    )?;
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
        let kind = kind(deck, grain);
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
